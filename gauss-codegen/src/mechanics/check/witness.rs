//! Every system against the definition, before code is written: C of (3.1) over all bodies and particles must be
//! stationary, with positions as they were given and all further differentiation by dual numbers, at a pseudo-random state.

use std::cell::OnceCell;
use std::fmt;

use crate::algebra::{Evaluation, Expr, Map, Number, Precise, Rational, Tangents};

use crate::mechanics::constraints::constraint::ConstraintKind;
use crate::mechanics::formula::{Formula, Method};
use crate::mechanics::kinematics::rotation::rotation_of_quaternion;
use crate::mechanics::kinematics::vector::Axes;
use crate::mechanics::links::link::{Link, Matter};
use crate::mechanics::loads::forces::Force;
use crate::mechanics::scene::Coordinate;
use crate::mechanics::system::System;

/// A formula does not satisfy the Gauss condition: an error of this crate, never of its user.
#[derive(Debug)]
pub struct Disagreement {
    method: Method,
    row: usize,
    residual: f64,
}

impl fmt::Display for Disagreement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { method, row, residual } = self;
        write!(f, "row {row} of {method:?} misses the Gauss condition by {residual:e}")
    }
}

/// What is found wrong with a system at a pseudo-random state.
#[derive(Debug)]
pub enum SystemFault {
    /// An error of this crate.
    Disagreement(Disagreement),
    /// A is singular: this speed moves nothing that the earlier ones do not move.
    DependentSpeed(usize),
    /// The constraint, by its index, says nothing that the earlier ones do not say.
    DependentConstraint(usize),
    /// No velocity satisfies the constraint together with the earlier ones.
    InconsistentConstraint(usize),
}

/// A velocity field of a link: of O, and of the axes e as columns.
type Field<N> = [[N; 3]; 4];

/// One state, and what (3.1) says at it.
struct Witness<'a, 'g, N> {
    system: &'a System<'g>,
    state: Map<u32, N>,
    /// v_P of every link: symbols of t, q and z.
    velocities: Vec<[[Expr<'g>; 3]; 4]>,
    still: OnceCell<Still<N>>,
}

/// What the condition at one state has whatever the accelerations are.
struct Still<N> {
    /// Derivatives of the fields of all links with respect to every speed.
    partials: Vec<Vec<N>>,
    gravity: [N; 3],
    links: Vec<Distribution<N>>,
    /// Buoyancy, the potential and forces: one row a speed.
    acting: Vec<N>,
}

impl<'a, 'g, N: Number> Witness<'a, 'g, N> {
    fn new(system: &'a System<'g>, state: Map<u32, N>) -> Self {
        let rates = &system.scene.rates;
        let velocity = |link: &Link<'g>| {
            let axis = |j: usize| std::array::from_fn(|i| link.rotation[i][j].derivative(rates));
            [link.position.map(|e| e.derivative(rates)), axis(0), axis(1), axis(2)]
        };
        let velocities = system.scene.tree.links.iter().map(velocity).collect();
        Self { system, state, velocities, still: OnceCell::new() }
    }

    fn values<'e>(&self, outputs: impl IntoIterator<Item = &'e Expr<'g>>) -> Vec<N>
    where
        'g: 'e,
    {
        let mut evaluation = Evaluation::new(&self.state);
        outputs.into_iter().map(|e| evaluation.value(*e)).collect()
    }

    /// Derivatives of the expressions along a direction.
    fn along(&self, direction: &Map<u32, N>, outputs: &[Expr<'g>]) -> Vec<N> {
        let mut evaluation = Evaluation::new(&self.state);
        let mut tangents = Tangents::new(&mut evaluation, direction);
        outputs.iter().map(|e| tangents.along(*e)).collect()
    }

    /// Derivatives of the expressions with respect to every speed: one row a speed.
    fn partials(&self, outputs: &[Expr<'g>]) -> Vec<Vec<N>> {
        let one = N::number(1.0);
        self.system.scene.speeds.iter().map(|z| self.along(&Map::from_iter([(z.key(), one)]), outputs)).collect()
    }

    /// The direction in which t, q and z move.
    fn flow(&self, rates: &[N]) -> Map<u32, N> {
        let scene = &self.system.scene;
        let mut evaluation = Evaluation::new(&self.state);
        let mut direction: Map<u32, N> = scene.rates.iter().map(|(&key, e)| (key, evaluation.value(*e))).collect();
        direction.extend(scene.speeds.iter().zip(rates).map(|(z, rate)| (z.key(), *rate)));
        direction
    }

    /// `Σ ∫(a_P − g)·w_α dm + ∂(dU/dt)/∂z^α` at the given ż, with what the impulse of the fluid adds: one row a speed.
    fn stationarity(&self, rates: &[N]) -> Vec<N> {
        let flow = self.flow(rates);
        let accelerations = self.along(&flow, &self.fields());
        let Still { partials, gravity, links, acting } = self.still.get_or_init(|| self.still());
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
        rows
    }

    /// The fields of all links, component by component.
    fn fields(&self) -> Vec<Expr<'g>> {
        self.velocities.iter().flatten().flatten().copied().collect()
    }

    fn still(&self) -> Still<N> {
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
        Still { partials, gravity, links, acting }
    }

    /// `Σ F·∂v/∂z^α` over what acts, with velocities differentiated from positions. `partials` are those of the links.
    fn forces(&self, partials: &[Vec<N>]) -> Vec<N> {
        let scene = &self.system.scene;
        let mut rows = vec![N::number(0.0); scene.speeds.len()];
        let dot = |a: &[N], b: &[N]| sum(a.iter().zip(b).map(|(a, b)| *a * *b));
        for force in &self.system.forces {
            match force {
                Force::AtPoint { at, force } => {
                    let velocity = at.map(|e| e.derivative(&scene.rates));
                    let force = self.values(force);
                    let partials = self.partials(&velocity);
                    rows.iter_mut().zip(partials).for_each(|(row, w)| *row = *row + dot(&force, &w));
                }
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

fn sum<N: Number>(terms: impl Iterator<Item = N>) -> N {
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

/// The unknowns of linear equations with their right-hand sides in the last column, by elimination with the largest pivots.
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

/// Evaluates the condition at one state, with the residual at any ż and with every arrangement's acceleration.
///
/// Where large terms cancel, right formulas disagree by the roundings of these, and a pivot that is small beside what it was formed of looks
/// like zero. Such a finding of double precision counts only if numbers of many digits confirm it: roundings are smaller there by sixty
/// decimal places, a wrong term and a dependent row are what they were.
pub fn check_system_against_definition<'g>(
    system: &System<'g>,
    formulas: &[Formula<'g>],
) -> Result<(), Vec<SystemFault>> {
    check_in::<f64>(system, formulas).or_else(|_| check_in::<Precise>(system, formulas))
}

fn check_in<'g, N: Number>(system: &System<'g>, formulas: &[Formula<'g>]) -> Result<(), Vec<SystemFault>> {
    let n = system.scene.speeds.len();
    let matrix: Vec<Expr<'g>> = system.matrix.iter().flatten().copied().collect();
    let arrangements =
        |method: Method| formulas.iter().filter(move |f| f.method == method).flat_map(|f| f.arrangements.iter());
    let arbitrary: Vec<N> = (0..n).map(|k| N::number(0.7 - 0.3 * (k % 4) as f64)).collect();
    // Roots and logarithms have domains: the first of a few states where everything has a value. Where there is none, the
    // programs are still checked against their expressions.
    let inside = |witness: &Witness<'_, 'g, N>| {
        let values = witness.values(matrix.iter().chain(arrangements(Method::Acceleration).flatten()));
        values.iter().chain(&witness.stationarity(&arbitrary)).all(|x| x.is_finite())
    };
    let states = || (0..16).map(|shift| Witness::new(system, sample_state(system, shift)));
    // A singular A, or dependent constraints, have no finite accelerations, so they are looked for first.
    let regular = |witness: &Witness<'_, 'g, N>| witness.values(&matrix).iter().all(|x| x.is_finite());
    let singular = states().find(regular).map(|witness| vanishing_pivots(witness.values(&matrix), n));
    let mut faults: Vec<SystemFault> =
        singular.unwrap_or_default().into_iter().map(SystemFault::DependentSpeed).collect();
    faults.extend(dependent_constraints(system, states()));
    if !faults.is_empty() {
        return Err(faults);
    }
    // A wrong term is wrong nearly everywhere, roundings grow large near singular states alone: only what disagrees at three
    // states is refused.
    let mut verdict = Ok(());
    for witness in states().filter(inside).take(3) {
        verdict = compare(witness, formulas, &arbitrary);
        if verdict.is_ok() {
            break;
        }
    }
    verdict.map_err(|error| vec![SystemFault::Disagreement(error)])
}

/// Residuals at the given ż and accelerations, against the definition.
fn compare<'g, N: Number>(
    mut witness: Witness<'_, 'g, N>,
    formulas: &[Formula<'g>],
    arbitrary: &[N],
) -> Result<(), Disagreement> {
    let system = witness.system;
    let arrangements =
        |method: Method| formulas.iter().filter(move |f| f.method == method).flat_map(|f| f.arrangements.iter());
    let unconstrained = witness.stationarity(arbitrary);
    let jacobian = witness.partials(&system.constraints.on_velocities);
    let with_forces = |witness: &Witness<'_, 'g, N>, rows: Vec<N>| -> Vec<N> {
        // Jᵀλ with the multipliers of the motion.
        let Some(multipliers) = arrangements(Method::Multipliers).next() else { return rows };
        let multipliers = witness.values(multipliers);
        let force = |row: &Vec<N>| sum(row.iter().zip(&multipliers).map(|(j, l)| *j * *l));
        rows.iter().zip(&jacobian).map(|(r, j)| *r - force(j)).collect()
    };
    witness.state.extend(system.scene.speed_rates.iter().zip(arbitrary).map(|(s, x)| (s.key(), *x)));
    let expected = with_forces(&witness, unconstrained);
    let mut evaluation = Evaluation::new(&witness.state);
    let mut values = |outputs: &[Expr<'g>]| -> Vec<N> { outputs.iter().map(|e| evaluation.value(*e)).collect() };
    for arrangement in arrangements(Method::GaussResidual) {
        agree(Method::GaussResidual, &values(arrangement), &expected)?;
    }
    let scale = largest(expected.iter().copied()).max(1.0);
    for arrangement in arrangements(Method::Acceleration) {
        let rates = values(arrangement);
        let found = with_forces(&witness, witness.stationarity(&rates));
        let relative: Vec<N> = found.iter().map(|x| *x / N::number(scale)).collect();
        agree(Method::Acceleration, &relative, &vec![N::number(0.0); relative.len()])?;
        // J ż = γ: what the constraints say of velocities goes on to hold.
        let flow = witness.flow(&rates);
        let drift = witness.along(&flow, &system.constraints.on_velocities);
        agree(Method::Acceleration, &drift, &vec![N::number(0.0); drift.len()])?;
    }
    Ok(())
}

/// Two evaluations of the same rows.
fn agree<N: Number>(method: Method, found: &[N], expected: &[N]) -> Result<(), Disagreement> {
    let scale = found.iter().chain(expected).fold(1.0_f64, |m, x| m.max(x.to_f64().abs()));
    for (row, (x, y)) in found.iter().zip(expected).enumerate() {
        // Numbers of order one and some hundreds of roundings; NaN is no agreement either.
        let residual = (*x - *y).to_f64();
        let close = residual.abs() <= 1e-8 * scale;
        if !close {
            return Err(Disagreement { method, row, residual });
        }
    }
    Ok(())
}

/// Positions that are sums of multiples of those before them, with the same factors wherever the system is: they say
/// nothing, as the components of a loop's position across the plane in which it moves. Symbols that stand for `literals` have
/// those values.
pub fn needless_constraints<'g>(system: &System<'g>, literals: &[(Rational, Expr<'g>)]) -> Vec<usize> {
    // Roundings of numbers, not of what is computed with them: planes of which each link has its own.
    const NEGLIGIBLE: f64 = 1e-12;
    // Roundings can look like a dependence, as for all that is checked.
    let alike = needless::<f64>(system, literals, 100.0 * f64::NEGLIGIBLE);
    if alike.is_empty() { alike } else { needless::<Precise>(system, literals, NEGLIGIBLE) }
}

fn needless<'g, N: Number>(system: &System<'g>, literals: &[(Rational, Expr<'g>)], negligible: f64) -> Vec<usize> {
    // The system elsewhere, its parameters as they were.
    let mut at: Map<u32, N> = sample_state(system, 0);
    at.extend(literals.iter().map(|(value, symbol)| (symbol.key(), N::fraction(*value))));
    let states = (0..16).map(|shift| {
        let mut state = at.clone();
        let other: Map<u32, N> = sample_state(system, shift);
        state.extend(system.scene.rates.keys().filter_map(|key| Some((*key, *other.get(key)?))));
        Witness::new(system, state)
    });
    let all = dependencies(system, states, negligible);
    all.into_iter().filter(|found| found.constant && !found.contradicts).map(|found| found.number).collect()
}

/// A constraint whose velocity is a combination of those before it.
struct Dependency {
    number: usize,
    /// Of positions, with the same coefficients everywhere.
    constant: bool,
    /// It does not hold together with them.
    contradicts: bool,
}

/// Constraints that say nothing new, or nothing that can hold with those before them.
fn dependent_constraints<'a, 'g, N: Number + 'a>(
    system: &'a System<'g>,
    states: impl Iterator<Item = Witness<'a, 'g, N>>,
) -> Vec<SystemFault> {
    let fault = |found: Dependency| match found.contradicts {
        true => SystemFault::InconsistentConstraint(found.number),
        false => SystemFault::DependentConstraint(found.number),
    };
    dependencies(system, states, 100.0 * N::NEGLIGIBLE).into_iter().map(fault).collect()
}

fn dependencies<'a, 'g, N: Number + 'a>(
    system: &'a System<'g>,
    states: impl Iterator<Item = Witness<'a, 'g, N>>,
    negligible: f64,
) -> Vec<Dependency> {
    let constraints = &system.constraints;
    let positions = constraints.on_positions();
    let usable = |witness: &Witness<'_, 'g, N>| {
        let finite = |values: Vec<N>| values.iter().all(|x| x.is_finite());
        finite(witness.values(constraints.on_velocities.iter().chain(&positions)))
            && witness.partials(&constraints.on_velocities).into_iter().all(finite)
    };
    let mut usable = states.filter(usable);
    let (Some(witness), other) = (usable.next(), usable.next()) else { return Vec::new() };
    // What constraints say of velocities, of a system at rest.
    let mut at_rest = Witness::new(system, witness.state.clone());
    let zero = N::number(0.0);
    at_rest.state.extend(system.scene.speeds.iter().map(|z| (z.key(), zero)));
    let moving = at_rest.values(&constraints.on_velocities);
    let elsewhere = other.map(|other| (dependent_rows(&other, negligible), other.values(&positions)));
    let combined =
        |coefficients: &[N], values: &[N]| sum(coefficients.iter().zip(values).map(|(c, value)| *c * *value));
    dependent_rows(&witness, negligible)
        .into_iter()
        .map(|(k, coefficients)| {
            // Positions can be compared where a combination with the same coefficients everywhere is constant.
            let of_positions = (0..=k)
                .all(|j| coefficients[j] == zero || system.scene.constraints[j].kind == ConstraintKind::Position);
            let constant = elsewhere.as_ref().and_then(|(rows, values)| {
                let (_, other) = rows.iter().find(|(row, _)| *row == k)?;
                let close = |a: N, b: N| (a - b).to_f64().abs() <= 1e-8 * (1.0 + a.to_f64().abs());
                let same = coefficients.iter().zip(other).all(|(a, b)| close(*a, *b));
                (of_positions && same).then(|| combined(other, values))
            });
            let values = [Some(combined(&coefficients, &moving)), constant].into_iter().flatten();
            let contradicts = values.into_iter().any(|value| value.to_f64().abs() > 1e-8);
            Dependency { number: k, constant: constant.is_some(), contradicts }
        })
        .collect()
}

/// Rows of J that are combinations of those before them, with the coefficients of the combination that vanishes.
/// What is smaller than the `negligible` part of a row is what elimination leaves of it.
fn dependent_rows<N: Number>(witness: &Witness<'_, '_, N>, negligible: f64) -> Vec<(usize, Vec<N>)> {
    let constraints = &witness.system.constraints;
    let columns = witness.partials(&constraints.on_velocities);
    let count = constraints.count();
    let mut rows: Vec<Vec<N>> = (0..count).map(|k| columns.iter().map(|c| c[k]).collect()).collect();
    let unit = |k: usize| (0..count).map(|j| N::number(f64::from(u8::from(j == k)))).collect::<Vec<N>>();
    let mut combinations: Vec<Vec<N>> = (0..count).map(unit).collect();
    let sizes: Vec<f64> = rows.iter().map(|row| largest(row.iter().copied())).collect();
    let mut dependent = Vec::new();
    for k in 0..count {
        let (pivot, size) = rows[k]
            .iter()
            .enumerate()
            .map(|(column, x)| (column, x.to_f64().abs()))
            .fold((0, 0.0_f64), |best, other| if other.1 > best.1 { other } else { best });
        if size <= negligible * sizes[k].max(1e-3) {
            dependent.push((k, combinations[k].clone()));
            continue;
        }
        for later in k + 1..count {
            let factor = rows[later][pivot] / rows[k][pivot];
            for column in 0..rows[k].len() {
                rows[later][column] = rows[later][column] - factor * rows[k][column];
            }
            for column in 0..count {
                combinations[later][column] = combinations[later][column] - factor * combinations[k][column];
            }
        }
    }
    dependent
}

/// The size of the largest.
fn largest<N: Number>(values: impl Iterator<Item = N>) -> f64 {
    values.fold(0.0, |most: f64, x| most.max(x.to_f64().abs()))
}

/// The unknowns whose pivots vanish while A is eliminated, beside what they were.
fn vanishing_pivots<N: Number>(mut a: Vec<N>, n: usize) -> Vec<usize> {
    let diagonal: Vec<f64> = (0..n).map(|k| a[k * n + k].to_f64().abs()).collect();
    let mut vanishing = Vec::new();
    for k in 0..n {
        let pivot = a[k * n + k];
        // Cancellation leaves roundings of the diagonal; a regular A of numbers of order one stays far above.
        if pivot.to_f64().abs() <= N::NEGLIGIBLE * diagonal[k] {
            vanishing.push(k);
            continue;
        }
        for i in k + 1..n {
            let factor = a[i * n + k] / pivot;
            for j in k..n {
                a[i * n + j] = a[i * n + j] - factor * a[k * n + j];
            }
        }
    }
    vanishing
}

/// Values of order one for all symbols; masses and moments of inertia dominate products of inertia, rotations are
/// rotations.
fn sample_state<N: Number>(system: &System<'_>, shift: u32) -> Map<u32, N> {
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
