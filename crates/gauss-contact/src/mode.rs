//! A system whose contacts have modes: each open, closed, sticking, or sliding along a direction.
//!
//! Between two events the modes stay, and the motion is smooth: that of the system with the forces of closed contacts,
//! `ż = ż₀ + A⁻¹Wᵀλ`. Closed gaps and slips that stick are constraints, on whose multipliers friction of sliding
//! contacts depends: `λ_T = −μ λ_N ŝ`.

use alloc::rc::Rc;
use alloc::vec;
use alloc::vec::Vec;

use gauss_runtime::chart::Chart;
use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::constraint::ProjectionError;
use gauss_runtime::contact::{Contact, ContactDynamics, ContactSystem};
use gauss_runtime::forces::Columns;
use gauss_runtime::integrate::problem::state::TangentOf;
use gauss_runtime::real::Real;
use gauss_runtime::system::{GaussSystem, Smoothness};

use crate::dense::{Decomposition, Matrix, norm};
use crate::impact::after;

/// What a contact does during a part of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mode {
    /// The gap is open.
    Open,
    /// The gap is closed and stays so; there is no friction.
    Closed,
    /// The gap is closed, and the slip is zero.
    Sticks,
    /// The gap is closed, and the slip has this direction along the tangents; of two tangents, at the start.
    Slides([f64; 2]),
}

impl Mode {
    /// Whether the gap is closed.
    #[must_use]
    pub fn is_closed(self) -> bool {
        self != Self::Open
    }
}

/// A system in given modes of its contacts. [`GaussSystem::project`] brings closed gaps, their rates, and slips that
/// stick to zero, in the metric of the kinetic energy.
#[derive(Debug)]
pub struct InMode<'k, K> {
    pub(crate) kernel: &'k K,
    pub(crate) modes: Rc<[Mode]>,
}

impl<K> Clone for InMode<'_, K> {
    fn clone(&self) -> Self {
        Self { kernel: self.kernel, modes: Rc::clone(&self.modes) }
    }
}

/// Contact forces at a state.
pub(crate) struct Loads<K: ContactSystem> {
    pub(crate) dynamics: ContactDynamics<K>,
    /// λ, all rows.
    pub(crate) forces: Vec<f64>,
}

impl<K: ContactSystem<Scalar = f64>> Loads<K> {
    /// What rounding makes of the normal force of a contact: that of the terms of its acceleration.
    pub(crate) fn rounding(&self, contact: &Contact) -> f64 {
        let (normal, d) = (contact.normal, &self.dynamics.response.delassus);
        let each = self.forces.iter().enumerate().map(|(row, force)| (d[(normal, row)] * force).abs());
        let terms = each.fold(self.dynamics.bias.component(normal).abs(), |sum, term| sum + term);
        256.0 * f64::EPSILON * terms / Real::max(d[(normal, normal)], f64::MIN_POSITIVE)
    }
}

/// The rows of tangents.
pub(crate) fn tangents(contact: &Contact) -> core::ops::Range<usize> {
    contact.normal + 1..contact.normal + 1 + contact.tangents
}

/// The slip of a contact.
pub(crate) fn slip<V: VectorSpace<f64>>(contact: &Contact, rates: &V) -> [f64; 2] {
    let mut slip = [0.0; 2];
    tangents(contact).zip(&mut slip).for_each(|(row, s)| *s = rates.component(row));
    slip
}

/// The sizes of the terms of a rate together: what its rounding is relative to.
pub(crate) fn terms<V: VectorSpace<f64>>(column: &V, z: &V) -> f64 {
    (0..V::DIM).map(|j| (column.component(j) * z.component(j)).abs()).sum()
}

/// Where the slip of a contact with two tangents leads, as a smooth function beyond the line through zero that is
/// perpendicular to `reference`: mirrored there, so that a motion that stops passes on straight. What is across the
/// reference by rounding alone has no direction, however small the slip is.
fn direction(reference: [f64; 2], [x, y]: [f64; 2], rounding: f64) -> [f64; 2] {
    let along = x * reference[0] + y * reference[1];
    let across = y * reference[0] - x * reference[1];
    if across.abs() <= rounding {
        return reference;
    }
    let back = -2.0 * Real::min(along, 0.0);
    let slip = [back.fma(reference[0], x), back.fma(reference[1], y)];
    let size = norm(&slip);
    slip.map(|s| s / size)
}

impl<'k, K: ContactSystem<Scalar = f64>> InMode<'k, K> {
    pub(crate) fn new(kernel: &'k K, modes: &[Mode]) -> Self {
        Self { kernel, modes: modes.into() }
    }

    /// The mode of each contact.
    #[must_use]
    pub fn modes(&self) -> &[Mode] {
        &self.modes
    }

    fn closed(&self) -> impl Iterator<Item = (usize, &'static Contact, Mode)> {
        let each = K::CONTACTS.iter().zip(self.modes.iter()).enumerate();
        each.filter(|(_, (_, mode))| mode.is_closed()).map(|(i, (contact, mode))| (i, contact, *mode))
    }

    /// The rows of constraints: normals of closed contacts, tangents of those that stick where `velocities`.
    fn rows(&self, velocities: bool) -> Vec<usize> {
        let of = |(_, contact, mode): (usize, &Contact, Mode)| {
            let more = if velocities && mode == Mode::Sticks { contact.tangents } else { 0 };
            contact.normal..=contact.normal + more
        };
        self.closed().flat_map(of).collect()
    }

    /// The direction in which a contact slides that had another one at the start.
    pub(crate) fn direction(
        &self,
        contact: &Contact,
        reference: [f64; 2],
        (t, q, z): (f64, &K::Configuration, &K::Speeds),
    ) -> [f64; 2] {
        if contact.tangents < 2 {
            return reference;
        }
        let jacobian = self.kernel.contact_jacobian(t, q);
        let size: f64 = tangents(contact).filter_map(|row| jacobian.nth(row)).map(|column| terms(&column, z)).sum();
        let slip = slip(contact, &self.kernel.contact_rates(t, q, z));
        direction(reference, slip, 64.0 * f64::EPSILON * size)
    }

    /// λ at a state.
    pub(crate) fn loads(&self, t: f64, q: &K::Configuration, z: &K::Speeds, input: &K::Input) -> Loads<K> {
        let dynamics = self.kernel.contact_dynamics(t, q, z, input);
        let d = &dynamics.response.delassus;
        let mut forces = vec![0.0; K::ContactRows::DIM];
        let sliding = self.closed().any(|(.., mode)| matches!(mode, Mode::Slides(_)));
        let friction = sliding.then(|| self.kernel.friction(t, q, z, input));
        let mut rows = Vec::new();
        let mut with: Vec<Vec<(usize, f64)>> = Vec::new();
        for (i, contact, mode) in self.closed() {
            rows.push(contact.normal);
            let mut column = vec![(contact.normal, 1.0)];
            if let (Mode::Slides(reference), Some(friction)) = (mode, &friction) {
                let along = self.direction(contact, reference, (t, q, z));
                let mu = friction.component(i);
                column.extend(tangents(contact).zip(along).map(|(row, s)| (row, -mu * s)));
            }
            with.push(column);
            if mode == Mode::Sticks {
                tangents(contact).for_each(|row| {
                    rows.push(row);
                    with.push(vec![(row, 1.0)]);
                });
            }
        }
        let entry = |i: usize, j: usize| with[j].iter().map(|(row, part)| part * d[(rows[i], *row)]).sum();
        let factors = Decomposition::new(&Matrix::from_fn(rows.len(), entry), |i| d[(rows[i], rows[i])]);
        for _ in 0..2 {
            let rate = |&row: &usize| {
                forces.iter().enumerate().fold(dynamics.bias.component(row), |u, (j, f)| u + d[(row, j)] * f)
            };
            let left: Vec<f64> = rows.iter().map(|row| -rate(row)).collect();
            for (unknown, with) in factors.solve(&left).into_iter().zip(&with) {
                with.iter().for_each(|(row, part)| forces[*row] += part * unknown);
            }
        }
        Loads { dynamics, forces }
    }

    /// `x + Σ λ column`, where components that are no more than the rounding of their terms are 0: what rests does not
    /// creep.
    fn pushed(x: &K::Speeds, columns: &K::ContactColumns, forces: &[f64]) -> K::Speeds {
        let (mut sum, mut terms) = (*x, vec![0.0; K::Speeds::DIM]);
        (0..terms.len()).for_each(|i| terms[i] = x.component(i).abs());
        let mut count = 1;
        for (row, force) in forces.iter().enumerate().filter(|(_, force)| **force != 0.0) {
            let Some(column) = columns.nth(row) else { continue };
            sum = sum.add_scaled(*force, &column);
            (0..terms.len()).for_each(|i| terms[i] += (force * column.component(i)).abs());
            count += 1;
        }
        // Each term has roundings of its own, those of its factors and of the solution for λ.
        let part = 16.0 * f64::from(count) * f64::EPSILON;
        for (i, terms) in terms.iter().enumerate().filter(|_| count > 1) {
            if sum.component(i).abs() <= part * terms {
                sum.set_component(i, 0.0);
            }
        }
        sum
    }

    /// The impulses at these rows that cancel rates, all rows of contacts.
    fn cancelling(delassus: &K::Delassus, rows: &[usize], rates: &dyn Fn(usize) -> f64) -> Vec<f64> {
        let matrix = Matrix::from_fn(rows.len(), |i, j| delassus[(rows[i], rows[j])]);
        let left: Vec<f64> = rows.iter().map(|&row| -rates(row)).collect();
        let solved = Decomposition::new(&matrix, |i| matrix.at(i, i)).solve(&left);
        let mut impulses = vec![0.0; K::ContactRows::DIM];
        rows.iter().zip(solved).for_each(|(&row, impulse)| impulses[row] = impulse);
        impulses
    }

    /// Closed gaps brought to zero. ψ is affine in z: what an impulse adds to it is an increment of the configuration.
    fn close_gaps(&self, t: f64, mut q: K::Configuration) -> Result<K::Configuration, ProjectionError> {
        let contact = |row: usize| K::CONTACTS.iter().position(|contact| contact.normal == row);
        let rows = self.rows(false);
        let mut left = f64::INFINITY;
        for _ in 0..20 {
            let gaps = self.kernel.gaps(t, &q);
            let size =
                rows.iter().filter_map(|row| contact(*row)).fold(0.0_f64, |most, i| most.max(gaps.component(i).abs()));
            // Newton's method has nothing to gain where it no longer halves what is left.
            if size == 0.0 || size >= 0.5 * left {
                break;
            }
            left = size;
            let response = self.kernel.contact_response(t, &q);
            let gap = |row: usize| contact(row).map_or(0.0, |i| gaps.component(i));
            let impulses = Self::cancelling(&response.delassus, &rows, &gap);
            let zero = K::Speeds::zero();
            let moved = after::<K>(&response, &zero, &impulses);
            let still = self.kernel.kinematics(t, &q, &zero);
            let increment = self.kernel.kinematics(t, &q, &moved).add_scaled(-1.0, &still);
            q = q.retract(&increment).renormalise();
            if K::CONSTRAINED {
                q = self.kernel.project(t, &q, &zero)?.0;
            }
        }
        Ok(q)
    }

    /// Rates of closed gaps and slips that stick brought to zero.
    fn stop_rates(&self, t: f64, q: &K::Configuration, mut z: K::Speeds) -> K::Speeds {
        let rows = self.rows(true);
        let response = self.kernel.contact_response(t, q);
        // The second time takes away what the first one rounds; a third and fourth make zeros of what can be zero.
        for _ in 0..4 {
            let rates = self.kernel.contact_rates(t, q, &z);
            let impulses = Self::cancelling(&response.delassus, &rows, &|row| rates.component(row));
            if impulses.iter().all(|impulse| *impulse == 0.0) {
                break;
            }
            z = Self::pushed(&z, &response.columns, &impulses);
        }
        z
    }

    /// Wᵀλ.
    fn generalised(&self, t: f64, q: &K::Configuration, forces: &[f64]) -> K::Speeds {
        let jacobian = self.kernel.contact_jacobian(t, q);
        let each = forces.iter().enumerate().filter_map(|(row, force)| Some((force, jacobian.nth(row)?)));
        each.fold(K::Speeds::zero(), |sum, (force, column)| sum.add_scaled(*force, &column))
    }
}

impl<K: ContactSystem<Scalar = f64>> GaussSystem for InMode<'_, K> {
    type Scalar = f64;
    type Configuration = K::Configuration;
    type Speeds = K::Speeds;
    type MassMatrix = K::MassMatrix;
    type Input = K::Input;

    const DOF: usize = K::DOF;
    const CHART: Chart = K::CHART;
    const CONSTRAINED: bool = true;
    const SMOOTHNESS: Smoothness = K::SMOOTHNESS;

    fn kinematics(&self, t: f64, q: &K::Configuration, z: &K::Speeds) -> TangentOf<Self> {
        self.kernel.kinematics(t, q, z)
    }

    fn acceleration(&self, t: f64, q: &K::Configuration, z: &K::Speeds, input: &K::Input) -> K::Speeds {
        if !self.modes.iter().any(|mode| mode.is_closed()) {
            return self.kernel.acceleration(t, q, z, input);
        }
        let Loads { dynamics, forces } = self.loads(t, q, z, input);
        Self::pushed(&dynamics.acceleration, &dynamics.response.columns, &forces)
    }

    fn momentum(&self, t: f64, q: &K::Configuration, z: &K::Speeds) -> K::Speeds {
        self.kernel.momentum(t, q, z)
    }

    fn velocity(&self, t: f64, q: &K::Configuration, p: &K::Speeds) -> K::Speeds {
        self.kernel.velocity(t, q, p)
    }

    fn momentum_rate(&self, t: f64, q: &K::Configuration, p: &K::Speeds, input: &K::Input) -> K::Speeds {
        let loads = self.loads(t, q, &self.kernel.velocity(t, q, p), input);
        let rate = self.kernel.momentum_rate(t, q, p, input);
        rate.add_scaled(1.0, &self.generalised(t, q, &loads.forces))
    }

    fn mass_matrix(&self, t: f64, q: &K::Configuration) -> K::MassMatrix {
        self.kernel.mass_matrix(t, q)
    }

    fn kinetic_energy(&self, t: f64, q: &K::Configuration, z: &K::Speeds) -> f64 {
        self.kernel.kinetic_energy(t, q, z)
    }

    fn potential_energy(&self, t: f64, q: &K::Configuration) -> f64 {
        self.kernel.potential_energy(t, q)
    }

    fn gauss_residual(
        &self,
        t: f64,
        q: &K::Configuration,
        z: &K::Speeds,
        acceleration: &K::Speeds,
        input: &K::Input,
    ) -> K::Speeds {
        let loads = self.loads(t, q, z, input);
        let residual = self.kernel.gauss_residual(t, q, z, acceleration, input);
        residual.add_scaled(-1.0, &self.generalised(t, q, &loads.forces))
    }

    fn constraint_function(
        &self,
        t: f64,
        q: &K::Configuration,
        z: &K::Speeds,
        acceleration: &K::Speeds,
        input: &K::Input,
    ) -> f64 {
        self.kernel.constraint_function(t, q, z, acceleration, input)
    }

    fn regularity(&self, t: f64, q: &K::Configuration) -> f64 {
        self.kernel.regularity(t, q)
    }

    fn project(
        &self,
        t: f64,
        q: &K::Configuration,
        z: &K::Speeds,
    ) -> Result<(K::Configuration, K::Speeds), ProjectionError> {
        let (q, z) = self.kernel.project(t, q, z)?;
        if !self.modes.iter().any(|mode| mode.is_closed()) {
            return Ok((q, z));
        }
        let q = self.close_gaps(t, q)?;
        Ok((q, self.stop_rates(t, &q, z)))
    }
}
