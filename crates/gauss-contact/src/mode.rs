//! A system whose contacts have modes: each open, closed, sticking, or sliding along a direction.
//!
//! Between two events the modes stay, and the motion is smooth: that of the system with the forces of closed contacts,
//! `ż = ż₀ + A⁻¹Wᵀλ`. Closed gaps and slips that stick are constraints, on whose multipliers friction of sliding
//! contacts depends: `λ_T = −μ λ_N ŝ`.

use alloc::rc::Rc;
use alloc::vec;
use alloc::vec::Vec;
use core::fmt;

use gauss_runtime::chart::Chart;
use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::constraint::{ConstraintLevel, ProjectionError, ProjectionFailure};
use gauss_runtime::contact::{Contact, ContactDynamics, ContactSystem, impulse_terms, impulse_velocities};
use gauss_runtime::forces::Columns;
use gauss_runtime::integrate::problem::state::TangentOf;
use gauss_runtime::real::{Real, largest_derivative};
use gauss_runtime::system::{GaussSystem, Smoothness};

use crate::dense::{Decomposition, Matrix, dot, epsilon, norm, size, sum, value};
use crate::friction::Bounds;
use crate::impact::after;
use crate::law::carrier;
use crate::lockstep::{Lockstep, larger};

/// Mode of a contact during a part of a run. Dry friction sticks or slides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mode<T = f64> {
    /// The gap is open.
    Open,
    /// The gap is closed and stays so; there is no friction.
    Closed,
    /// The gap is closed, if there is one, and the slip is zero.
    Sticks,
    /// The gap is closed, if there is one, and the slip has this direction along the tangents and, with friction of
    /// drilling, the spin after them; of more than one row, at the start.
    Slides([T; 3]),
}

impl<T> Mode<T> {
    /// Whether the gap is closed; of dry friction always.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        !matches!(self, Self::Open)
    }
}

/// A system in given modes of its contacts. [`GaussSystem::project`] brings closed gaps, their rates, and slips that
/// stick to zero, in the metric of the kinetic energy.
pub struct InMode<'k, K: ContactSystem> {
    pub(crate) kernel: &'k K,
    pub(crate) modes: Rc<[Mode<K::Scalar>]>,
    least: Least,
}

/// The slips that have no direction of their own.
#[derive(Clone)]
pub(crate) struct Least {
    /// Slips that count as rest.
    pub(crate) rest: f64,
    /// The rounding of each row at the start, and what its acceleration, a sum as well, adds to it in a unit of time.
    pub(crate) rounding: Rc<[[f64; 2]]>,
    pub(crate) start: f64,
}

impl Least {
    /// The rounding of a row at a time. None is known of systems that are not those of a run.
    fn rounding(&self, row: usize, t: f64) -> f64 {
        self.rounding.get(row).map_or(0.0, |[at_start, grows]| (t - self.start).max(0.0).fma(*grows, *at_start))
    }
}

impl<K: ContactSystem> fmt::Debug for InMode<'_, K> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("InMode").field("modes", &self.modes).finish_non_exhaustive()
    }
}

impl<K: ContactSystem> Clone for InMode<'_, K> {
    fn clone(&self) -> Self {
        Self { kernel: self.kernel, modes: Rc::clone(&self.modes), least: self.least.clone() }
    }
}

/// Contact forces at a state.
pub(crate) struct Loads<K: ContactSystem> {
    pub(crate) dynamics: ContactDynamics<K>,
    /// λ, all rows.
    pub(crate) forces: Vec<K::Scalar>,
}

impl<K: ContactSystem> Loads<K> {
    /// ż with the contact forces.
    pub(crate) fn acceleration(&self) -> K::Speeds {
        pushed::<K>(&self.dynamics.acceleration, &self.dynamics.response.columns, &self.forces)
    }

    /// The rate of a rate: (ġ, s)˙ = D λ + b in a row.
    pub(crate) fn row_acceleration(&self, row: usize) -> K::Scalar {
        let d = &self.dynamics.response.delassus;
        let each = self.forces.iter().enumerate();
        each.fold(self.dynamics.bias.component(row), |u, (j, force)| u + d[(row, j)] * *force)
    }

    /// Rounding of the normal force of a contact, or of dry friction: that of the terms of its acceleration.
    pub(crate) fn rounding(&self, contact: &Contact) -> f64 {
        let d = &self.dynamics.response.delassus;
        let of_row = |of: usize| {
            let each = self.forces.iter().enumerate().map(|(row, force)| value(d[(of, row)] * *force).abs());
            let terms = each.fold(value(self.dynamics.bias.component(of)).abs(), |sum, term| sum + term);
            256.0 * epsilon::<K::Scalar>() * terms / value(d[(of, of)]).max(f64::MIN_POSITIVE)
        };
        let rows = if contact.has_gap() { contact.normal..contact.normal + 1 } else { contact.rows() };
        rows.map(of_row).fold(0.0, f64::max)
    }

    /// The force that friction of a contact may not exceed, over the friction that it has.
    pub(crate) fn reserve(&self, contacts: &[Contact], contact: &Contact, bounds: Bounds<K::Scalar>) -> K::Scalar {
        let pressed = presses(contacts, contact).map_or(K::Scalar::one(), |normal| self.forces[normal]);
        bounds.largest * pressed - bounds.size(&self.forces[contact.friction_rows()])
    }
}

/// The rows of friction.
pub(crate) fn tangents(contact: &Contact) -> core::ops::Range<usize> {
    contact.friction_rows()
}

/// The row of the normal force that bounds friction; none of dry friction.
pub(crate) fn presses(contacts: &[Contact], contact: &Contact) -> Option<usize> {
    let carrier = contact.rolls_on().map_or(contact, |on| &contacts[on]);
    carrier.has_gap().then_some(carrier.normal)
}

/// The slip of a contact, with its spin.
pub(crate) fn slip<T: Real, V: VectorSpace<T>>(contact: &Contact, rates: &V) -> [T; 3] {
    let mut slip = [T::zero(); 3];
    tangents(contact).zip(&mut slip).for_each(|(row, s)| *s = rates.component(row));
    slip
}

/// The sizes of the terms of a rate together: what its rounding is relative to.
pub(crate) fn terms<T: Real, V: VectorSpace<T>>(column: &V, z: &V) -> f64 {
    (0..V::DIM).map(|j| value(column.component(j) * z.component(j)).abs()).sum()
}

/// Direction of the slip of a contact with several rows of friction, as a smooth function beyond the line or plane
/// through zero that is perpendicular to `reference`: mirrored there, so that a motion that stops passes on straight.
/// What is across the reference by rounding alone has no direction, however small the slip is. Slips of about `rest`
/// keep to the reference: they turn at a rate of friction over slip, without bound where the slip begins.
fn direction<T: Real>(reference: [T; 3], slip: [T; 3], rounding: f64, rest: f64) -> [T; 3] {
    let along = dot(&slip, &reference);
    let across = [(0, 1), (1, 2), (2, 0)].map(|(i, j)| slip[j] * reference[i] - slip[i] * reference[j]);
    let straight = size(&across) <= rounding;
    if straight && (!T::DERIVATIVES || value(along).abs() <= rounding) {
        return reference;
    }
    let back = (T::from_f64(-2.0) * along).max(T::zero()) + T::from_f64(rest);
    let slip: [T; 3] = core::array::from_fn(|k| back.fma(reference[k], slip[k]));
    let length = norm(&slip);
    let turned = slip.map(|s| s / length);
    // Derivatives are those of the slip.
    let kept = |k: usize| turned[k] + T::from_f64(value(reference[k]) - value(turned[k]));
    if straight { core::array::from_fn(kept) } else { turned }
}

/// Roundings of accelerations by which a slip may be across its direction as it begins.
const AMPLIFIED: f64 = 64.0;

/// Part of the derivatives of the configuration up to which the derivative of a closed gap is rounding.
pub(crate) const UNCLOSED: f64 = 1e-9;

/// The largest derivative in a configuration.
pub(crate) fn largest_derivative_of<Q: Configuration>(q: &Q) -> f64 {
    let components = q.components();
    (0..Q::Components::DIM).map(|i| largest_derivative(components.component(i))).fold(0.0, f64::max)
}

/// The least number of Newton's corrections of a state: each one that values do not need doubles the order up to which
/// derivatives are right.
fn corrections<T: Real>() -> usize {
    if T::DERIVATIVES { 3 } else { 0 }
}

/// Part of the largest speed, before or after impulses, below which a speed may be rounding: terms can be some 10⁴
/// times larger than it.
const NEAR: f64 = 1e-9;

/// The speeds `z + A⁻¹WᵀP` after impulses P, where components that are no more than the rounding of their terms are 0:
/// what rests does not creep. Terms are asked for where a speed is a small part of the largest.
pub(crate) fn after_impulses<K: ContactSystem>(
    lockstep: &Lockstep,
    kernel: &K,
    z: &K::Speeds,
    (factors, impulses): (&K::ImpulseFactors, &K::ContactRows),
) -> K::Speeds {
    let speeds = z.add_scaled(K::Scalar::one(), &kernel.impulse_velocities(factors, impulses));
    settled((z, 0.0), speeds, acting::<K>(lockstep, impulses), || kernel.impulse_terms(factors, impulses))
}

/// Speeds with components of zero for those that are rounding of so many terms, of given sizes; lane by lane. Terms are
/// asked for where a speed is a small part of the largest, or of a speed that is given.
fn settled<V: VectorSpace<T>, T: Real>(
    (z, given): (&V, f64),
    mut speeds: V,
    count: u32,
    terms: impl FnOnce() -> V,
) -> V {
    let (zero, one) = (T::zero(), T::one());
    let size = |v: &V, i: usize| v.component(i).abs();
    let sizes = |i: usize| larger(size(z, i), size(&speeds, i));
    let near = T::from_f64(NEAR) * (0..V::DIM).map(sizes).fold(T::from_f64(given), larger);
    // 1 in lanes with a speed that is small, but not zero.
    let small = |i: usize| T::select_lt(near, size(&speeds, i), zero, T::select_lt(zero, size(&speeds, i), one, zero));
    let asks = (0..V::DIM).map(small).fold(zero, larger);
    if count == 0 || !(0..T::LANES).any(|lane| asks.lane(lane) > 0.0) {
        return speeds;
    }
    let terms = terms();
    // Each term has roundings of its own, those of its factors and of the solution for λ.
    let part = T::from_f64(16.0 * f64::from(count + 1) * epsilon::<T>());
    for i in 0..V::DIM {
        let speed = speeds.component(i);
        let rounding = part * (size(z, i) + terms.component(i));
        let rounding = T::select_lt(zero, asks, rounding, -one);
        // Derivatives stay.
        let value = if T::DERIVATIVES { T::from_f64(value(speed)) } else { speed };
        speeds.set_component(i, T::select_lt(rounding, value.abs(), speed, speed - value));
    }
    speeds
}

/// `x + Σ λ column`, settled.
pub(crate) fn pushed<K: ContactSystem>(x: &K::Speeds, columns: &K::ContactColumns, forces: &[K::Scalar]) -> K::Speeds {
    let mut rows = K::ContactRows::zero();
    forces.iter().enumerate().for_each(|(row, force)| rows.set_component(row, *force));
    let speeds = x.add_scaled(K::Scalar::one(), &impulse_velocities::<K>(columns, &rows));
    settled((x, f64::INFINITY), speeds, acting::<K>(&Lockstep::default(), &rows), || impulse_terms::<K>(columns, &rows))
}

/// Number of rows that act.
pub(crate) fn acting<K: ContactSystem>(lockstep: &Lockstep, rows: &K::ContactRows) -> u32 {
    let acts = |row: &usize| K::Scalar::DERIVATIVES || !lockstep.is_zero(rows.component(*row));
    (0..K::ContactRows::DIM).filter(acts).fold(0, |count, _| count + 1)
}

impl<'k, K: ContactSystem> InMode<'k, K> {
    /// A system whose contacts have these modes, in the order of [`ContactSystem::contacts`]; those left out are open.
    /// [`project`](GaussSystem::project) brings a state onto them.
    #[must_use]
    pub fn new(kernel: &'k K, modes: &[Mode<K::Scalar>]) -> Self {
        Self::with(kernel, modes, Least { rest: 0.0, rounding: Rc::new([]), start: 0.0 })
    }

    /// The system in these modes, with slips that have no direction of their own.
    pub(crate) fn with(kernel: &'k K, modes: &[Mode<K::Scalar>], least: Least) -> Self {
        Self { kernel, modes: modes.into(), least }
    }

    /// The mode of each contact.
    #[must_use]
    pub fn modes(&self) -> &[Mode<K::Scalar>] {
        &self.modes
    }

    /// Whether no gap is closed.
    pub(crate) fn is_open(&self) -> bool {
        !self.modes.iter().any(|mode| mode.is_closed())
    }

    pub(crate) fn closed(&self) -> impl Iterator<Item = (usize, &'static Contact, Mode<K::Scalar>)> {
        let each = self.kernel.contacts().iter().zip(self.modes.iter()).enumerate();
        // Where a contact is open, nothing resists rolling on it.
        let closed = |i: usize| self.modes.get(carrier(self.kernel.contacts(), i)).is_some_and(Mode::is_closed);
        let closed = each.filter(move |(i, (_, mode))| mode.is_closed() && closed(*i));
        closed.map(|(i, (contact, mode))| (i, contact, *mode))
    }

    /// The rows of constraints: normals of closed contacts, tangents of those that stick where `velocities`.
    fn rows(&self, velocities: bool) -> Vec<usize> {
        let of = |(_, contact, mode): (usize, &Contact, Mode<K::Scalar>)| {
            let all = contact.rows();
            if velocities && matches!(mode, Mode::Sticks) { all } else { all.start..contact.friction_rows().start }
        };
        self.closed().flat_map(of).collect()
    }

    /// The direction in which a contact slides that had another one at the start.
    pub(crate) fn direction(
        &self,
        contact: &Contact,
        reference: [K::Scalar; 3],
        (t, q, z): (K::Scalar, &K::Configuration, &K::Speeds),
    ) -> [K::Scalar; 3] {
        if contact.friction_rows().len() < 2 {
            return reference;
        }
        let jacobian = self.kernel.contact_jacobian(t, q);
        let size: f64 = tangents(contact).filter_map(|row| jacobian.nth(row)).map(|column| terms(&column, z)).sum();
        let slip = slip(contact, &self.kernel.contact_rates(t, q, z));
        // Explicit steps would feed what is rounding across a slow slip until it is an error of the size of the
        // tolerance, and friction that leads to and fro is too small along the slip.
        let so_far: f64 = tangents(contact).map(|row| self.least.rounding(row, value(t))).sum();
        direction(reference, slip, (64.0 * epsilon::<K::Scalar>() * size).max(so_far), self.least.rest)
    }

    /// The rounding of the acceleration of each row at a state. Where a slip begins it is along its direction by the
    /// laws: what is across by some roundings is what equations of contacts that depend on one another make of these.
    pub(crate) fn rounding_of_accelerations(
        &self,
        loads: &Loads<K>,
        (t, q, z): (K::Scalar, &K::Configuration, &K::Speeds),
    ) -> Vec<f64> {
        let (jacobian, d) = (self.kernel.contact_jacobian(t, q), &loads.dynamics.response.delassus);
        let of_row = |row: usize| {
            let free = jacobian.nth(row).map_or(0.0, |column| terms(&column, &loads.dynamics.acceleration));
            let each = loads.forces.iter().enumerate();
            64.0 * epsilon::<K::Scalar>() * each.fold(free, |sum, (j, force)| sum + value(d[(row, j)] * *force).abs())
        };
        let mut grows: Vec<f64> = (0..K::ContactRows::DIM).map(of_row).collect();
        let rates = self.kernel.contact_rates(t, q, z);
        for (contact, mode) in self.kernel.contacts().iter().zip(self.modes.iter()) {
            let Mode::Slides(reference) = mode else { continue };
            let terms: f64 =
                tangents(contact).filter_map(|row| jacobian.nth(row)).map(|column| terms(&column, z)).sum();
            if size(&slip(contact, &rates)) > 64.0 * epsilon::<K::Scalar>() * terms {
                continue;
            }
            let mut rate = [0.0; 3];
            tangents(contact).zip(&mut rate).for_each(|(row, u)| *u = value(loads.row_acceleration(row)));
            let reference = reference.map(value);
            let along = dot(&rate, &reference);
            let across = size(&[0, 1, 2].map(|k| rate[k] - along * reference[k]));
            if across <= AMPLIFIED * tangents(contact).map(|row| grows[row]).sum::<f64>() {
                tangents(contact).for_each(|row| grows[row] = grows[row].max(4.0 * across));
            }
        }
        grows
    }

    /// λ at a state.
    pub(crate) fn loads(&self, t: K::Scalar, q: &K::Configuration, z: &K::Speeds, input: &K::Input) -> Loads<K> {
        let one = K::Scalar::one();
        let dynamics = self.kernel.contact_dynamics(t, q, z, input);
        let d = &dynamics.response.delassus;
        let mut forces = vec![K::Scalar::zero(); K::ContactRows::DIM];
        let sliding = self.closed().any(|(.., mode)| matches!(mode, Mode::Slides(_)));
        let friction = sliding.then(|| self.kernel.friction(t, q, z, input));
        let mut rows = Vec::new();
        let mut with: Vec<Vec<(usize, K::Scalar)>> = Vec::new();
        for (_, contact, mode) in self.closed() {
            let mut against = Vec::new();
            if let (Mode::Slides(reference), Some(friction)) = (mode, &friction) {
                let along = self.direction(contact, reference, (t, q, z));
                against.extend(tangents(contact).zip(Bounds::of(contact, friction).against(along)));
            }
            if contact.has_gap() {
                rows.push(contact.normal);
                with.push(core::iter::once((contact.normal, one)).chain(against).collect());
            } else if let Some(normal) = presses(self.kernel.contacts(), contact) {
                let pressing = rows.iter().zip(&mut with).find(|(row, _)| **row == normal);
                if let Some((_, with)) = pressing {
                    with.extend(against);
                }
            } else {
                against.into_iter().for_each(|(row, force)| forces[row] = force);
            }
            if matches!(mode, Mode::Sticks) {
                tangents(contact).for_each(|row| {
                    rows.push(row);
                    with.push(vec![(row, one)]);
                });
            }
        }
        let entry = |i: usize, j: usize| sum(with[j].iter().map(|(row, part)| *part * d[(rows[i], *row)]));
        let factors = Decomposition::new(&Matrix::from_fn(rows.len(), entry), |i| d[(rows[i], rows[i])]);
        for _ in 0..2 {
            let rate = |&row: &usize| {
                forces.iter().enumerate().fold(dynamics.bias.component(row), |u, (j, f)| u + d[(row, j)] * *f)
            };
            let left: Vec<_> = rows.iter().map(|row| -rate(row)).collect();
            for (unknown, with) in factors.solve(&left).into_iter().zip(&with) {
                with.iter().for_each(|(row, part)| forces[*row] += *part * unknown);
            }
        }
        Loads { dynamics, forces }
    }

    /// The impulses at these rows that cancel rates, all rows of contacts.
    fn cancelling(delassus: &K::Delassus, rows: &[usize], rates: &dyn Fn(usize) -> K::Scalar) -> Vec<K::Scalar> {
        let matrix = Matrix::from_fn(rows.len(), |i, j| delassus[(rows[i], rows[j])]);
        let left: Vec<_> = rows.iter().map(|&row| -rates(row)).collect();
        let solved = Decomposition::new(&matrix, |i| matrix.at(i, i)).solve(&left);
        let mut impulses = vec![K::Scalar::zero(); K::ContactRows::DIM];
        rows.iter().zip(solved).for_each(|(&row, impulse)| impulses[row] = impulse);
        impulses
    }

    /// A configuration moved by what impulses add to speeds.
    // In a function of its own: with it in the loop of `close_gaps`, LLVM (20 and 22, optimisation 3) loses the old
    // value of the third of three coordinates in the sum, and a block that leans lies flat.
    #[inline(never)]
    fn moved_by(&self, t: K::Scalar, q: &K::Configuration, speeds: &K::Speeds) -> K::Configuration {
        let still = self.kernel.kinematics(t, q, &K::Speeds::zero());
        let increment = self.kernel.kinematics(t, q, speeds).add_scaled(-K::Scalar::one(), &still);
        q.retract(&increment).renormalise()
    }

    /// Closed gaps brought to zero. ψ is affine in z: what an impulse adds to it is an increment of the configuration.
    pub(crate) fn close_gaps(
        &self,
        t: K::Scalar,
        mut q: K::Configuration,
    ) -> Result<K::Configuration, ProjectionError> {
        let given = q;
        let contact =
            |row: usize| self.kernel.contacts().iter().position(|contact| contact.normal == row && contact.has_gap());
        let rows = self.rows(false);
        let mut left = f64::INFINITY;
        for n in 0..20 {
            let gaps = self.kernel.gaps(t, &q);
            let gap = |i: usize| value(gaps.component(i)).abs();
            let size = rows.iter().filter_map(|row| contact(*row)).fold(0.0_f64, |most, i| most.max(gap(i)));
            // Newton's method has nothing to gain where it no longer halves what is left.
            if n >= corrections::<K::Scalar>() && (size == 0.0 || size >= 0.5 * left) {
                break;
            }
            left = size;
            let response = self.kernel.contact_response(t, &q);
            let gap = |row: usize| contact(row).map_or(K::Scalar::zero(), |i| gaps.component(i));
            let impulses = Self::cancelling(&response.delassus, &rows, &gap);
            q = self.moved_by(t, &q, &after::<K>(&response, &K::Speeds::zero(), &impulses));
            if K::CONSTRAINED {
                q = self.kernel.project(t, &q, &K::Speeds::zero())?.0;
            }
        }
        // Gaps that depend on one another may close here, but not nearby.
        let open = |q: &K::Configuration| {
            let gaps = self.kernel.gaps(t, q);
            self.closed().map(|(i, ..)| largest_derivative(gaps.component(i))).fold(0.0, f64::max)
        };
        let size = (0..TangentOf::<K>::DIM).map(|i| q.magnitude(i)).fold(0.0, f64::max);
        let rounding = UNCLOSED * largest_derivative_of(&q).max(1e-3 * size);
        let (before, open) = (open(&given), open(&q));
        if open > rounding && open > 1e-3 * before {
            return Err(ProjectionError::new(ConstraintLevel::Position, ProjectionFailure::NotConverged, open));
        }
        Ok(q)
    }

    /// Rates of closed gaps and slips that stick brought to zero.
    fn stop_rates(&self, t: K::Scalar, q: &K::Configuration, mut z: K::Speeds) -> K::Speeds {
        let rows = self.rows(true);
        let response = self.kernel.contact_response(t, q);
        // The second time takes away what the first one rounds; a third and fourth make zeros of what can be zero.
        for _ in 0..4 {
            let rates = self.kernel.contact_rates(t, q, &z);
            let impulses = Self::cancelling(&response.delassus, &rows, &|row| rates.component(row));
            if !K::Scalar::DERIVATIVES && impulses.iter().all(|impulse| value(*impulse) == 0.0) {
                break;
            }
            z = pushed::<K>(&z, &response.columns, &impulses);
        }
        z
    }

    /// Wᵀλ.
    pub(crate) fn generalised(&self, t: K::Scalar, q: &K::Configuration, forces: &[K::Scalar]) -> K::Speeds {
        let jacobian = self.kernel.contact_jacobian(t, q);
        let each = forces.iter().enumerate().filter_map(|(row, force)| Some((force, jacobian.nth(row)?)));
        each.fold(K::Speeds::zero(), |sum, (force, column)| sum.add_scaled(*force, &column))
    }
}

impl<K: ContactSystem> GaussSystem for InMode<'_, K> {
    gauss_runtime::forward_system!(K => kernel: types motion momenta energies);

    const DOF: usize = K::DOF;
    const CHART: Chart = K::CHART;
    const CONSTRAINED: bool = true;
    const STATES: usize = K::STATES;
    const SMOOTHNESS: Smoothness = K::SMOOTHNESS;

    fn acceleration(&self, t: K::Scalar, q: &K::Configuration, z: &K::Speeds, input: &K::Input) -> K::Speeds {
        if self.is_open() {
            return self.kernel.acceleration(t, q, z, input);
        }
        self.loads(t, q, z, input).acceleration()
    }

    fn momentum_rate(&self, t: K::Scalar, q: &K::Configuration, p: &K::Speeds, input: &K::Input) -> K::Speeds {
        let loads = self.loads(t, q, &self.kernel.velocity(t, q, p), input);
        let rate = self.kernel.momentum_rate(t, q, p, input);
        rate.add_scaled(K::Scalar::one(), &self.generalised(t, q, &loads.forces))
    }

    fn gauss_residual(
        &self,
        t: K::Scalar,
        q: &K::Configuration,
        z: &K::Speeds,
        acceleration: &K::Speeds,
        input: &K::Input,
    ) -> K::Speeds {
        let loads = self.loads(t, q, z, input);
        let residual = self.kernel.gauss_residual(t, q, z, acceleration, input);
        residual.add_scaled(-K::Scalar::one(), &self.generalised(t, q, &loads.forces))
    }

    fn constraint_function(
        &self,
        t: K::Scalar,
        q: &K::Configuration,
        z: &K::Speeds,
        acceleration: &K::Speeds,
        input: &K::Input,
    ) -> K::Scalar {
        self.kernel.constraint_function(t, q, z, acceleration, input)
    }

    fn regularity(&self, t: K::Scalar, q: &K::Configuration) -> K::Scalar {
        self.kernel.regularity(t, q)
    }

    fn project(
        &self,
        t: K::Scalar,
        q: &K::Configuration,
        z: &K::Speeds,
    ) -> Result<(K::Configuration, K::Speeds), ProjectionError> {
        let (q, z) = self.kernel.project(t, q, z)?;
        if self.is_open() {
            return Ok((q, z));
        }
        let q = self.close_gaps(t, q)?;
        Ok((q, self.stop_rates(t, &q, z)))
    }

    fn dependence(&self, t: K::Scalar, q: &K::Configuration, z: &K::Speeds) -> K::Speeds {
        self.kernel.dependence(t, q, z)
    }
}
