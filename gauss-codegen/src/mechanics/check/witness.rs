//! The definition at one state: what stationarity of C, (3.1) over all bodies and particles, asks of accelerations,
//! with positions as they were given and all further differentiation by dual numbers.

use std::cell::OnceCell;

use crate::algebra::{Evaluation, Expr, FlowDerivative, Map, Number, Rational, Tangents};

use crate::mechanics::kinematics::coordinate::Coordinate;
use crate::mechanics::kinematics::rotation::rotation_of_quaternion;
use crate::mechanics::kinematics::vector::Axes;
use crate::mechanics::links::link::{Link, Matter};
use crate::mechanics::loads::forces::Force;
use crate::mechanics::system::System;

/// A velocity field of a link: of O, and of the axes e as columns.
type Field<N> = [[N; 3]; 4];

/// A torque between two links as what it is on each of them, seen by the observer.
fn apart<'g>(links: &[Link<'g>], force: &Force<'g>) -> Vec<Force<'g>> {
    let Force::Between { links: [link, other], torque } = *force else { return vec![*force] };
    let none = [torque[0].graph().zero(); 3];
    let turned = links[link].axes().to_space(&torque);
    let on = |link, torque| Force::OnLink { link, at: none, force: none, torque, axes: Axes::Space };
    vec![on(link, turned), on(other, turned.map(|e| -e))]
}

/// One state, and what (3.1) says at it.
pub struct Witness<'a, 'g, N> {
    pub system: &'a System<'g>,
    pub state: Map<u32, N>,
    /// v_P of every link: symbols of t, q and z.
    velocities: Vec<[[Expr<'g>; 3]; 4]>,
    still: OnceCell<RestTerms<N>>,
}

/// Terms of the condition at one state that do not depend on the accelerations.
struct RestTerms<N> {
    /// Derivatives of the fields of all links with respect to every speed.
    partials: Vec<Vec<N>>,
    gravity: [N; 3],
    links: Vec<Distribution<N>>,
    /// Buoyancy, the potential and forces: one row a speed.
    acting: Vec<N>,
}

impl<'a, 'g, N: Number> Witness<'a, 'g, N> {
    pub fn new(system: &'a System<'g>, state: Map<u32, N>) -> Self {
        let mut along = FlowDerivative::new(&system.scene.rates);
        let velocity = |link: &Link<'g>| {
            let origin = link.position.map(|e| along.derivative(e));
            let [e1, e2, e3] = [0, 1, 2].map(|j| [0, 1, 2].map(|i| along.derivative(link.rotation[i][j])));
            [origin, e1, e2, e3]
        };
        let velocities = system.scene.tree.links.iter().map(velocity).collect();
        Self { system, state, velocities, still: OnceCell::new() }
    }

    pub fn values<'e>(&self, outputs: impl IntoIterator<Item = &'e Expr<'g>>) -> Vec<N>
    where
        'g: 'e,
    {
        let mut evaluation = Evaluation::new(&self.state);
        outputs.into_iter().map(|e| evaluation.value(*e)).collect()
    }

    /// Derivatives of the expressions along a direction.
    pub fn along(&self, direction: &Map<u32, N>, outputs: &[Expr<'g>]) -> Vec<N> {
        let mut evaluation = Evaluation::new(&self.state);
        let mut tangents = Tangents::new(&mut evaluation, direction);
        outputs.iter().map(|e| tangents.along(*e)).collect()
    }

    /// Derivatives of the expressions with respect to every speed: one row a speed.
    pub fn partials(&self, outputs: &[Expr<'g>]) -> Vec<Vec<N>> {
        let one = N::number(1.0);
        self.system.scene.speeds.iter().map(|z| self.along(&Map::from_iter([(z.key(), one)]), outputs)).collect()
    }

    /// The direction in which t, q and z move.
    pub fn flow(&self, rates: &[N]) -> Map<u32, N> {
        let scene = &self.system.scene;
        let mut evaluation = Evaluation::new(&self.state);
        let mut direction: Map<u32, N> = scene.rates.iter().map(|(&key, e)| (key, evaluation.value(*e))).collect();
        direction.extend(scene.speeds.iter().zip(rates).map(|(z, rate)| (z.key(), *rate)));
        direction
    }

    /// `Σ ∫(a_P − g)·w_α dm + ∂(dU/dt)/∂z^α` at the given ż, with what the impulse of the fluid adds: one row a speed.
    pub fn stationarity(&self, rates: &[N]) -> Vec<N> {
        let flow = self.flow(rates);
        let accelerations = self.along(&flow, &self.fields());
        let RestTerms { partials, gravity, links, acting } = self.still.get_or_init(|| self.still());
        let mut rows = acting.clone();
        for (k, moments) in links.iter().enumerate() {
            let mut a = field(&accelerations, k);
            (0..3).for_each(|i| a[0][i] = a[0][i] - gravity[i]);
            for (row, partial) in rows.iter_mut().zip(partials) {
                *row = *row + moments.integral(&a, &field(partial, k));
            }
        }
        // Rotors: ∫a_P·w_α dm of matter on lines of their own.
        let tree = &self.system.scene.tree;
        for rotor in &tree.rotors {
            let (inertia, rate) = (self.values([&rotor.inertia])[0], self.along(&flow, &[rotor.rate])[0]);
            for (row, partial) in rows.iter_mut().zip(self.partials(&[rotor.rate])) {
                *row = *row + inertia * rate * partial[0];
            }
        }
        for (row, fluid) in rows.iter_mut().zip(self.fluid(&flow)) {
            *row = *row + fluid;
        }
        for (row, modes) in rows.iter_mut().zip(self.modes(&flow)) {
            *row = *row + modes;
        }
        rows
    }

    /// The fields of all links, component by component.
    fn fields(&self) -> Vec<Expr<'g>> {
        self.velocities.iter().flatten().flatten().copied().collect()
    }

    fn still(&self) -> RestTerms<N> {
        let scene = &self.system.scene;
        let partials = self.partials(&self.fields());
        let mut evaluation = Evaluation::new(&self.state);
        let zeros = [N::number(0.0); 3];
        let gravity = scene.tree.gravity.map_or(zeros, |g| g.map(|e| evaluation.value(e)));
        let links: Vec<_> = scene.tree.links.iter().map(|link| Distribution::of(link, &mut evaluation)).collect();
        let mut acting = vec![N::number(0.0); scene.speeds.len()];
        for (k, (mass, center)) in links.iter().enumerate().filter_map(|(k, link)| Some((k, link.buoyancy?))) {
            for (row, partial) in acting.iter_mut().zip(&partials) {
                let w = field(partial, k);
                let at = |i: usize| w[0][i] + sum((0..3).map(|j| center[j] * w[j + 1][i]));
                *row = *row + mass * sum((0..3).map(|i| gravity[i] * at(i)));
            }
        }
        if let Some(potential) = self.system.potential {
            let power = [potential.derivative(&scene.rates)];
            acting.iter_mut().zip(self.partials(&power)).for_each(|(row, partial)| *row = *row + partial[0]);
        }
        for (row, force) in acting.iter_mut().zip(self.forces(&partials)) {
            *row = *row - force;
        }
        RestTerms { partials, gravity, links, acting }
    }

    /// `Σ F·∂v/∂z^α` over all forces, with velocities differentiated from positions. `partials` are those of the links.
    fn forces(&self, partials: &[Vec<N>]) -> Vec<N> {
        let scene = &self.system.scene;
        let mut rows = vec![N::number(0.0); scene.speeds.len()];
        let dot = |a: &[N], b: &[N]| sum(a.iter().zip(b).map(|(a, b)| *a * *b));
        for force in self.system.forces.iter().flat_map(|force| apart(&scene.tree.links, force)) {
            match &force {
                Force::AtPoint { at, force } => {
                    let velocity = at.map(|e| e.derivative(&scene.rates));
                    let force = self.values(force);
                    let partials = self.partials(&velocity);
                    rows.iter_mut().zip(partials).for_each(|(row, w)| *row = *row + dot(&force, &w));
                }
                Force::Between { .. } => {}
                Force::OnRate { rate, force } => {
                    let force = self.values([force]);
                    let partials = self.partials(&[*rate]);
                    rows.iter_mut().zip(partials).for_each(|(row, w)| *row = *row + dot(&force, &w));
                }
                Force::Dissipation(function) => {
                    rows.iter_mut().zip(self.partials(&[*function])).for_each(|(row, w)| *row = *row - w[0]);
                }
                Force::OnLink { link, at, force, torque, axes } => {
                    let r: Vec<N> = self.values(scene.tree.links[*link].rotation.iter().flatten());
                    let in_space = |a: &[Expr<'g>; 3], axes: Axes| -> Vec<N> {
                        let a = self.values(a);
                        match axes {
                            Axes::Space => a,
                            Axes::Body => (0..3).map(|i| dot(&r[3 * i..3 * i + 3], &a)).collect(),
                        }
                    };
                    let (force, torque, at) = (in_space(force, *axes), in_space(torque, *axes), self.values(at));
                    let axis = |j: usize| [r[j], r[3 + j], r[6 + j]];
                    for (row, partial) in rows.iter_mut().zip(partials) {
                        let w = field(partial, *link);
                        let moved: Vec<N> =
                            (0..3).map(|i| w[0][i] + sum((0..3).map(|j| at[j] * w[j + 1][i]))).collect();
                        // o_α = ½ Σ e_j × ∂ė_j/∂z^α.
                        let turned = sum((0..3).map(|j| dot(&torque, &cross(&axis(j), &w[j + 1]))));
                        *row = *row + dot(&force, &moved) + N::number(0.5) * turned;
                    }
                }
            }
        }
        rows
    }

    /// `dQ/dt·a_α + (dΓ/dt + v_O × Q)·o_α` of the fluid's impulse, body axes: zero without fluid.
    fn fluid(&self, flow: &Map<u32, N>) -> Vec<N> {
        let scene = &self.system.scene;
        let mut rows = vec![N::number(0.0); scene.speeds.len()];
        for (k, link) in scene.tree.links.iter().enumerate() {
            let Some(added) = link.body().and_then(|body| body.added_mass.as_ref()) else { continue };
            // (u, ω): components of v_O and of RᵀṘ.
            let dot = |a: usize, b: &[Expr<'g>; 3]| (0..3).map(|i| link.rotation[i][a] * b[i]).sum::<Expr<'g>>();
            let [v, e1, e2, e3] = &self.velocities[k];
            let twist = [dot(0, v), dot(1, v), dot(2, v), dot(2, e2), dot(0, e3), dot(1, e1)];
            let impulse: Vec<Expr<'g>> =
                added.iter().map(|row| row.iter().zip(twist).map(|(m, t)| *m * t).sum::<Expr<'g>>()).collect();
            let (t, p) = (self.values(&twist), self.values(&impulse));
            let (rate, partials) = (self.along(flow, &impulse), self.partials(&twist));
            let (u, w, q, gamma) = (&t[..3], &t[3..], &p[..3], &p[3..]);
            let [turned, moved, lifted] = [cross(w, q), cross(w, gamma), cross(u, q)];
            for (row, partial) in rows.iter_mut().zip(partials) {
                let of = |i: usize| {
                    (rate[i] + turned[i]) * partial[i] + (rate[3 + i] + moved[i] + lifted[i]) * partial[3 + i]
                };
                *row = *row + sum((0..3).map(of));
            }
        }
        rows
    }
}

/// Matter that deforms.
impl<'g, N: Number> Witness<'_, 'g, N> {
    /// Terms of (3.4) of a body that deforms beyond the rigid one, from `T = ½ νᵀGν`: zero without modes. The twist is
    /// that of the positions, and a field of gravity acts with the acceleration of O.
    fn modes(&self, flow: &Map<u32, N>) -> Vec<N> {
        let scene = &self.system.scene;
        let mut rows = vec![N::number(0.0); scene.speeds.len()];
        for modes in &scene.tree.deformations {
            let link = &scene.tree.links[modes.link];
            let dot = |a: usize, b: &[Expr<'g>; 3]| (0..3).map(|i| link.rotation[i][a] * b[i]).sum::<Expr<'g>>();
            let [v, e1, e2, e3] = &self.velocities[modes.link];
            let mut rates = vec![dot(0, v), dot(1, v), dot(2, v), dot(2, e2), dot(0, e3), dot(1, e1)];
            rates.extend(modes.coordinates.iter().map(|eta| eta.derivative(&scene.rates)));
            let n = rates.len();
            let momentum = |i: usize| modes.matrix[i].iter().zip(&rates).map(|(g, rate)| *g * *rate).sum::<Expr<'g>>();
            let momenta: Vec<Expr<'g>> = (0..n).map(momentum).collect();
            let (nu, p, partials) = (self.values(&rates), self.values(&momenta), self.partials(&rates));
            let mut forces = self.along(flow, &momenta);
            let (u, w, q, gamma) = (&nu[..3], &nu[3..6], &p[..3], &p[3..6]);
            let [turned, moved, lifted] = [cross(w, q), cross(w, gamma), cross(u, q)];
            for i in 0..3 {
                forces[i] = forces[i] + turned[i];
                forces[3 + i] = forces[3 + i] + moved[i] + lifted[i];
            }
            let entries = modes.matrix.concat();
            for (k, eta) in modes.coordinates.iter().enumerate() {
                let change = self.along(&Map::from_iter([(eta.key(), N::number(1.0))]), &entries);
                let square = sum((0..n * n).map(|at| change[at] * nu[at / n] * nu[at % n]));
                forces[6 + k] = forces[6 + k] - N::number(0.5) * square;
            }
            if let Some(gravity) = scene.tree.gravity {
                let g = self.values(&[0, 1, 2].map(|a| dot(a, &gravity)));
                let matrix = self.values(&entries);
                for (i, force) in forces.iter_mut().enumerate() {
                    *force = *force - sum((0..3).map(|j| matrix[n * i + j] * g[j]));
                }
            }
            for (row, partial) in rows.iter_mut().zip(partials) {
                *row = *row + sum(forces.iter().zip(&partial).map(|(force, partial)| *force * *partial));
            }
        }
        rows
    }
}

pub fn sum<N: Number>(terms: impl Iterator<Item = N>) -> N {
    terms.fold(N::number(0.0), |sum, term| sum + term)
}

fn field<N: Number>(components: &[N], link: usize) -> Field<N> {
    std::array::from_fn(|a| std::array::from_fn(|i| components[12 * link + 3 * a + i]))
}

fn cross<N: Number>(a: &[N], b: &[N]) -> [N; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Moments of a link as it was given, before anything is regrouped.
struct Distribution<N> {
    mass: N,
    first: [N; 3],
    second: [[N; 3]; 3],
    /// Mass and centre of the displaced fluid.
    buoyancy: Option<(N, [N; 3])>,
}

impl<N: Number> Distribution<N> {
    fn of(link: &Link<'_>, evaluation: &mut Evaluation<'_, N>) -> Self {
        let zero = N::number(0.0);
        let nothing = Self { mass: zero, first: [zero; 3], second: [[zero; 3]; 3], buoyancy: None };
        match &link.matter {
            Matter::Nothing => nothing,
            Matter::Particle(mass) => Self { mass: evaluation.value(*mass), ..nothing },
            Matter::Body(body) => Self {
                mass: evaluation.value(body.mass),
                first: body.first_moment().map(|e| evaluation.value(e)),
                second: body.second_moment().map(|row| row.map(|e| evaluation.value(e))),
                buoyancy: body.displaced.map(|(m, c)| (evaluation.value(m), c.map(|e| evaluation.value(e)))),
            },
        }
    }

    /// `∫ f·h dm` of two fields that are affine in the body coordinates.
    fn integral(&self, f: &Field<N>, h: &Field<N>) -> N {
        let dot = |a: usize, b: usize| sum((0..3).map(|i| f[a][i] * h[b][i]));
        let linear = sum((0..3).map(|j| self.first[j] * (dot(0, j + 1) + dot(j + 1, 0))));
        let square = sum((0..9).map(|n| self.second[n / 3][n % 3] * dot(n / 3 + 1, n % 3 + 1)));
        self.mass * dot(0, 0) + linear + square
    }
}

/// ż of (3.1) at a state: C is made stationary, under the constraints.
#[cfg(test)]
pub fn acceleration_by_definition<N: Number>(system: &System<'_>, state: Map<u32, N>) -> Vec<N> {
    let n = system.scene.speeds.len();
    let witness = Witness::new(system, state);
    let (zero, one) = (N::number(0.0), N::number(1.0));
    let still = vec![zero; n];
    let at_rest = witness.stationarity(&still);
    let columns: Vec<Vec<N>> = (0..n)
        .map(|k| {
            let unit: Vec<N> = (0..n).map(|j| if j == k { one } else { zero }).collect();
            witness.stationarity(&unit).into_iter().zip(&at_rest).map(|(moved, still)| moved - *still).collect()
        })
        .collect();
    // One row a speed, then one a constraint.
    let jacobian = witness.partials(&system.constraints.on_velocities);
    let bias = witness.along(&witness.flow(&still), &system.constraints.on_velocities);
    let m = bias.len();
    let mut rows: Vec<Vec<N>> = (0..n)
        .map(|i| {
            let matrix = columns.iter().map(|column| column[i]);
            matrix.chain(jacobian[i].iter().copied()).chain([-at_rest[i]]).collect()
        })
        .collect();
    rows.extend((0..m).map(|k| {
        let of_constraint = jacobian.iter().map(|row| row[k]);
        of_constraint.chain((0..m).map(|_| zero)).chain([-bias[k]]).collect()
    }));
    eliminated(rows).into_iter().take(n).collect()
}

/// The unknowns of linear equations with their right-hand sides in the last column, by elimination with the largest
/// pivots.
#[cfg(test)]
fn eliminated<N: Number>(mut rows: Vec<Vec<N>>) -> Vec<N> {
    let n = rows.len();
    let size = |x: &N| x.to_f64().abs();
    for k in 0..n {
        let pivot = (k..n).max_by(|&i, &j| size(&rows[i][k]).total_cmp(&size(&rows[j][k]))).unwrap_or(k);
        rows.swap(k, pivot);
        for i in 0..n {
            if i != k {
                let factor = rows[i][k] / rows[k][k];
                for j in k..=n {
                    rows[i][j] = rows[i][j] - factor * rows[k][j];
                }
            }
        }
    }
    (0..n).map(|k| rows[k][n] / rows[k][k]).collect()
}

/// The size of the largest.
pub fn largest<N: Number>(values: impl Iterator<Item = N>) -> f64 {
    values.fold(0.0, |most: f64, x| most.max(x.to_f64().abs()))
}

/// Values of order one for all symbols; masses and moments of inertia dominate products of inertia, rotations are
/// rotations.
pub fn sample_state<N: Number>(system: &System<'_>, shift: u32) -> Map<u32, N> {
    let scene = &system.scene;
    let mut state: Map<u32, N> = Map::default();
    for (k, key) in scene.graph.symbol_keys().into_iter().enumerate() {
        // Multiples of the golden ratio are spread evenly and never equal.
        let fraction = ((k as f64 + 0.37 * f64::from(shift)) * 0.618_033_988_749_894_9).fract();
        state.insert(key, N::number(0.5 + fraction));
    }
    for parameter in scene.tree.links.iter().filter_map(Link::body).flat_map(|body| &body.parameters) {
        let value = &mut *state.or_insert_with(parameter.symbol.key(), || N::number(1.0));
        let diagonal = parameter.row == parameter.column;
        *value = if diagonal { N::number(4.0) + *value } else { N::number(0.3) * *value };
    }
    let none = Map::default();
    let mut evaluation = Evaluation::new(&none);
    for coordinate in &scene.coordinates {
        if let Coordinate::Plane { turn: [cosine, sine], .. } = coordinate {
            let [c, s, of] = if shift.is_multiple_of(2) { [3, 4, 5] } else { [5, 12, 13] };
            let part = |n| N::fraction(Rational::new(n, of));
            state.extend([(cosine.key(), part(c)), (sine.key(), part(s))]);
        }
    }
    for (k, rotation) in scene.coordinates.iter().filter_map(Coordinate::rotation).enumerate() {
        // (1, 5, −3, 1)/6 is a unit quaternion, and so are its permutations.
        let mut integers = [1, 5, -3, 1];
        integers.rotate_left((k + shift as usize) % 4);
        let quaternion = integers.map(|n| scene.graph.integer(n).scale(Rational::new(1, 6)));
        let entries = rotation_of_quaternion(scene.graph, quaternion);
        let pairs = rotation.iter().flatten().zip(entries.iter().flatten());
        state.extend(pairs.map(|(symbol, entry)| (symbol.key(), evaluation.value(*entry))));
    }
    state
}
