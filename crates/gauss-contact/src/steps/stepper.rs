//! One step after another.

use alloc::vec;
use alloc::vec::Vec;
use core::fmt;

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::contact::{ContactDynamics, ContactSystem};

use crate::error::{ContactError, ContactErrorKind};
use crate::law::carrier;
use crate::mode::{Mode, pushed};
use crate::residual::Residual;

use super::cones::{Laws, MOST, MOST_ROWS};
use super::impulses::{Found, Impulses};
use super::projection::Projection;

/// How a step takes the motion between impacts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum StepScheme {
    /// Moreau and Jean's, θ = ½: accelerations at half of the step, with the speeds before it. Of second order where
    /// forces depend on places alone, else of first.
    MoreauJean,
    /// The same with the speeds at half of the step, by the accelerations of the step before: of second order between
    /// impacts, for the same work but in steps after impacts, which are made twice.
    #[default]
    Midpoint,
}

/// What a step did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct StepReport {
    /// The worst residuals of all contacts, in the units of rates.
    pub residual: Residual,
    /// The largest gap below zero before the projection, as a positive number.
    pub penetration: f64,
    /// Contacts with an impulse.
    pub closed: usize,
    /// Corrections of the solver: systems of linear equations that were solved.
    pub corrections: u32,
    /// Sweeps of the solver, where corrections alone came to no end.
    pub sweeps: u32,
    /// The work of contact impulses, of friction too: negative where they take energy away. Newton's law with friction
    /// can give energy at an impact (T. R. Kane 1984); then it is positive.
    pub work: f64,
    /// In how many parts the step was made, where no impulses were found for all of it; else 0.
    pub parts: u32,
}

impl StepReport {
    /// Of two parts of a step.
    fn and(self, later: Self) -> Self {
        Self {
            residual: self.residual.worse(later.residual),
            penetration: self.penetration.max(later.penetration),
            closed: later.closed,
            corrections: self.corrections + later.corrections,
            sweeps: self.sweeps + later.sweeps,
            work: self.work + later.work,
            parts: self.parts.max(1) + later.parts.max(1),
        }
    }
}

/// A system on its way in steps; all that a step needs is in memory that was there before.
///
/// Impacts go by Newton's law, all of a step at once. `M` is the memory: `Vec<f64>`, or an array of at least
/// [`MEMORY`](Self::MEMORY) numbers for programs that do not allocate.
pub struct ContactStepper<'k, K: ContactSystem<Scalar = f64>, M = Vec<f64>> {
    pub(super) kernel: &'k K,
    pub(super) t: f64,
    pub(super) q: K::Configuration,
    pub(super) z: K::Speeds,
    pub(super) scheme: StepScheme,
    pub(super) tolerance: f64,
    pub(super) memory: M,
    pub(super) impulses: K::ContactRows,
    /// Whether contacts depended on one another in the last step.
    pub(super) dependent: bool,
    /// At the state.
    pub(super) gaps: K::Gaps,
    pub(super) rates: K::ContactRows,
    /// Of the last step, between impacts.
    pub(super) acceleration: Option<K::Speeds>,
    pub(super) modes: [Mode; MOST],
    /// Of the step that is being made.
    pub(super) next: [Mode; MOST],
    pub(super) report: StepReport,
}

/// How often a step is halved where no impulses are found for it.
const HALVINGS: u32 = 4;

impl<K: ContactSystem<Scalar = f64>, M> fmt::Debug for ContactStepper<'_, K, M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { t, q, z, report, .. } = self;
        f.debug_struct("ContactStepper").field("t", t).field("q", q).field("z", z).field("report", report).finish()
    }
}

impl<'k, K: ContactSystem<Scalar = f64>> ContactStepper<'k, K> {
    /// A system in the state (q, z) at a time.
    ///
    /// # Errors
    /// `NegativeGap`, `InvalidRestitution`, `NonFinite`: as runs from event to event.
    pub fn new(kernel: &'k K, t: f64, q: K::Configuration, z: K::Speeds) -> Result<Self, ContactError> {
        Self::with_memory(kernel, (t, q, z), vec![0.0; Self::MEMORY])
    }
}

impl<'k, K: ContactSystem<Scalar = f64>, M: AsMut<[f64]>> ContactStepper<'k, K, M> {
    const ROWS: usize = K::ContactRows::DIM;
    /// How many numbers steps need.
    pub const MEMORY: usize = Impulses::memory(Self::ROWS) + Projection::memory(Self::ROWS);

    /// Like [`new`](ContactStepper::new), in memory of one's own.
    ///
    /// # Errors
    /// As there.
    ///
    /// # Panics
    /// Where the memory has less than [`MEMORY`](Self::MEMORY) numbers.
    pub fn with_memory(
        kernel: &'k K,
        (t, q, z): (f64, K::Configuration, K::Speeds),
        mut memory: M,
    ) -> Result<Self, ContactError> {
        const {
            assert!(K::CONTACTS.len() <= MOST, "steps take up to 64 contacts");
            assert!(Self::ROWS <= MOST_ROWS, "steps take up to 256 rows of contacts");
        }
        assert!(memory.as_mut().len() >= Self::MEMORY, "steps of this system need {} numbers", Self::MEMORY);
        crate::start::check(kernel, t, &q, &z)?;
        let q = q.renormalise();
        let mut stepper = Self {
            kernel,
            t,
            q,
            z,
            scheme: StepScheme::default(),
            tolerance: 1e-8,
            memory,
            impulses: K::ContactRows::zero(),
            dependent: false,
            gaps: kernel.gaps(t, &q),
            rates: kernel.contact_rates(t, &q, &z),
            acceleration: None,
            modes: [Mode::Open; MOST],
            next: [Mode::Open; MOST],
            report: StepReport::default(),
        };
        stepper.find_closed();
        Ok(stepper)
    }

    /// How the motion between impacts is taken.
    #[must_use]
    pub fn scheme(mut self, scheme: StepScheme) -> Self {
        self.scheme = scheme;
        self
    }

    /// How far from the laws a solution may be, as a part of the largest rate, in place of 10⁻⁸. A ten thousandth of
    /// that is looked for first, and rounding is always allowed for; what was found is in the report.
    #[must_use]
    pub fn tolerance(mut self, tolerance: f64) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// The time.
    pub fn time(&self) -> f64 {
        self.t
    }

    /// The configuration.
    pub fn configuration(&self) -> &K::Configuration {
        &self.q
    }

    /// The quasi-velocities.
    pub fn speeds(&self) -> &K::Speeds {
        &self.z
    }

    /// The impulses of the last step, row by row: over the length of the step they are its mean forces.
    pub fn impulses(&self) -> &K::ContactRows {
        &self.impulses
    }

    /// What the contacts did in the last step.
    pub fn modes(&self) -> &[Mode] {
        &self.modes[..K::CONTACTS.len()]
    }

    /// What the last step did.
    pub fn report(&self) -> StepReport {
        self.report
    }

    /// What touches at the start: gaps of zero, to rounding, that do not open.
    pub(super) fn find_closed(&mut self) {
        let (gaps, rates) = (self.gaps, self.rates);
        let near = crate::decide::Rounding::of::<K>(&self.q).half_of_the_digits();
        for (i, contact) in K::CONTACTS.iter().enumerate() {
            if contact.has_gap() && gaps.component(i) <= near && rates.component(contact.normal) <= 0.0 {
                self.modes[i] = Mode::Closed;
            }
        }
    }

    /// One step of length `h`, under an input that stays. Where no impulses are found for it, it is made in up to 16
    /// parts. Where it is an error, the state is that before the step.
    ///
    /// # Errors
    /// `Unsolved` where no impulses were found that satisfy the laws, `InvalidFriction`, `NonFinite`, `Projection`.
    pub fn step(&mut self, h: f64, input: &K::Input) -> Result<StepReport, ContactError> {
        if !(h > 0.0 && h.is_finite()) {
            return Err(self.error(None, ContactErrorKind::InvalidInterval));
        }
        self.report = self.in_parts(h, input, HALVINGS)?;
        Ok(self.report)
    }

    /// A step, or both halves of it.
    fn in_parts(&mut self, h: f64, input: &K::Input, halvings: u32) -> Result<StepReport, ContactError> {
        match self.whole(h, input) {
            Err(ContactError { kind: ContactErrorKind::Unsolved { .. }, .. }) if halvings > 0 => {
                let before = (self.t, self.q, self.z, self.gaps, self.rates, self.acceleration);
                let (modes, impulses) = (self.modes, self.impulses);
                let first = self.in_parts(0.5 * h, input, halvings - 1)?;
                let of_first = self.impulses;
                let second = self.in_parts(0.5 * h, input, halvings - 1).inspect_err(|_| {
                    (self.t, self.q, self.z, self.gaps, self.rates, self.acceleration) = before;
                    (self.modes, self.impulses) = (modes, impulses);
                })?;
                self.impulses = self.impulses.add_scaled(1.0, &of_first);
                Ok(first.and(second))
            }
            made => made,
        }
    }

    fn whole(&mut self, h: f64, input: &K::Input) -> Result<StepReport, ContactError> {
        let (t, q, z) = (self.t, self.q, self.z);
        let q = q.advance(&self.kernel.kinematics(t, &q, &z).scale(0.5 * h));
        let middle = |z: K::Speeds| Middle { t: t + 0.5 * h, q, z };
        let end = match (self.scheme, self.acceleration) {
            (StepScheme::MoreauJean, _) => self.attempt(h, &middle(z), input)?,
            (StepScheme::Midpoint, Some(acceleration)) => {
                self.attempt(h, &middle(z.add_scaled(0.5 * h, &acceleration)), input)?
            }
            // At the start and after impacts no acceleration is known: the step is made twice.
            (StepScheme::Midpoint, None) => match self.attempt(h, &middle(z), input)? {
                end if end.struck => end,
                end => self.attempt(h, &middle(z.add_scaled(1.0, &end.z).scale(0.5)), input)?,
            },
        };
        if !(end.q.is_finite() && end.z.is_finite()) {
            return Err(self.error(None, ContactErrorKind::NonFinite));
        }
        self.acceleration = (!end.struck).then(|| end.z.add_scaled(-1.0, &z).scale(1.0 / h));
        self.t = t + h;
        (self.q, self.z, self.impulses) = (end.q, end.z, end.impulses);
        if end.touches {
            core::mem::swap(&mut self.modes, &mut self.next);
        }
        (self.gaps, self.rates) = (end.gaps, end.rates);
        Ok(end.report)
    }

    fn attempt(&mut self, h: f64, middle: &Middle<K>, input: &K::Input) -> Result<End<K>, ContactError> {
        match self.flight(h, middle, input)? {
            Some(end) => Ok(end),
            None => self.touching(h, middle, input),
        }
    }

    fn error(&self, contact: Option<usize>, kind: ContactErrorKind) -> ContactError {
        ContactError { contact: contact.map(|i| K::CONTACTS[i].name), time: self.t, kind }
    }

    /// The gap with which a contact ends a step, given its rate there.
    fn gap_at_end(&self, h: f64, i: usize, rate: f64) -> f64 {
        self.gaps.component(i) + 0.5 * h * (self.rates.component(K::CONTACTS[i].normal) + rate)
    }

    /// The second half of a step, and what keeps bilateral constraints.
    fn second_half(
        &self,
        h: f64,
        middle: &Middle<K>,
        z: K::Speeds,
    ) -> Result<(K::Configuration, K::Speeds), ContactError> {
        let q = middle.q.advance(&self.kernel.kinematics(middle.t, &middle.q, &z).scale(0.5 * h));
        if !K::CONSTRAINED {
            return Ok((q, z));
        }
        let projected = self.kernel.project(self.t + h, &q, &z);
        projected.map_err(|cause| self.error(None, ContactErrorKind::Projection(cause)))
    }

    /// A step in which no gap closes: the motion without contacts is all that it needs.
    fn flight(&self, h: f64, middle: &Middle<K>, input: &K::Input) -> Result<Option<End<K>>, ContactError> {
        let is_open = |i: usize| K::CONTACTS[carrier(K::CONTACTS, i)].has_gap() && !self.modes[i].is_closed();
        if !(0..K::CONTACTS.len()).all(is_open) {
            return Ok(None);
        }
        let gaps_of = || (0..K::CONTACTS.len()).filter(|i| K::CONTACTS[*i].has_gap());
        let kernel = self.kernel;
        let z = self.z.add_scaled(h, &kernel.acceleration(middle.t, &middle.q, &middle.z, input));
        let after = kernel.contact_rates(middle.t, &middle.q, &z);
        if !gaps_of().all(|i| self.gap_at_end(h, i, after.component(K::CONTACTS[i].normal)) > 0.0) {
            return Ok(None);
        }
        let (q, z) = self.second_half(h, middle, z)?;
        let gaps = kernel.gaps(self.t + h, &q);
        if !gaps_of().all(|i| gaps.component(i) >= 0.0) {
            return Ok(None);
        }
        let rates = kernel.contact_rates(self.t + h, &q, &z);
        let (impulses, report) = (K::ContactRows::zero(), StepReport::default());
        Ok(Some(End { q, z, gaps, rates, impulses, touches: false, report, struck: false }))
    }

    /// A step in which contacts may act.
    fn touching(&mut self, h: f64, middle: &Middle<K>, input: &K::Input) -> Result<End<K>, ContactError> {
        let kernel = self.kernel;
        let friction = kernel.friction(middle.t, &middle.q, &middle.z, input);
        let laws = Laws::new::<K>(h, &friction).map_err(|(i, kind)| self.error(Some(i), kind))?;
        let dynamics = kernel.contact_dynamics(middle.t, &middle.q, &middle.z, input);
        let mut impulses = self.impulses;
        let free = self.z.add_scaled(h, &dynamics.acceleration);
        let known = self.dependent;
        let mut solved = self.solve(h, (&laws, &dynamics), self.free_rates(h, middle, &dynamics), &mut impulses);
        if solved.is_err() && self.dependent && !known {
            solved = self.solve(h, (&laws, &dynamics), self.free_rates(h, middle, &dynamics), &mut impulses);
        }
        let solved = solved.map_err(|kind| self.error(None, kind))?;
        let z = pushed_rows::<K>(&free, &dynamics.response.columns, &impulses);
        let (q, z) = self.second_half(h, middle, z)?;
        // What begins to rest is brought to zero to the last bit, and stays there.
        let kind = |mode: &Mode| core::mem::discriminant(mode);
        let changes = (0..K::CONTACTS.len()).any(|i| kind(&self.next[i]) != kind(&self.modes[i]));
        self.dependent &= !changes;
        let rounding = if changes { 0.0 } else { solved.found.residual.rounding };
        let (start, t) = (self.t, self.t + h);
        let failed = |cause| ContactError { contact: None, time: start, kind: ContactErrorKind::Projection(cause) };
        let of_projection = &mut self.memory.as_mut()[Impulses::memory(K::ContactRows::DIM)..];
        let mut projection = Projection::new(of_projection, K::ContactRows::DIM);
        let closed = projection.close(kernel, (t, q), &dynamics.response, &solved.rests);
        let (q, gaps, penetration) = closed.map_err(failed)?;
        let mode = |i: usize| if solved.rests[i] { self.next[i] } else { Mode::Open };
        let (z, rates) = projection.stop(kernel, (t, &q, z), &dynamics.response, (&mode, rounding));
        let report = StepReport {
            residual: solved.found.residual,
            penetration,
            closed: self.next[..K::CONTACTS.len()].iter().filter(|mode| mode.is_closed()).count(),
            corrections: solved.found.corrections,
            sweeps: solved.found.sweeps,
            work: solved.work,
            parts: 0,
        };
        Ok(End { q, z, gaps, rates, impulses, touches: true, report, struck: solved.struck })
    }

    /// Rates before a step, and at its end without contact impulses: to second order those there. Of contacts that
    /// depend on one another both are taken at half of the step, where they agree with one another to rounding; that is
    /// of first order.
    fn free_rates(&self, h: f64, middle: &Middle<K>, dynamics: &ContactDynamics<K>) -> [K::ContactRows; 2] {
        if !self.dependent {
            return [self.rates, self.rates.add_scaled(h, &dynamics.bias)];
        }
        let free = self.z.add_scaled(h, &dynamics.acceleration);
        [self.z, free].map(|z| self.kernel.contact_rates(middle.t, &middle.q, &z))
    }

    /// Impulses of a step, at first those of the step before, and its modes.
    fn solve(
        &mut self,
        h: f64,
        (laws, dynamics): (&Laws, &ContactDynamics<K>),
        [before, free]: [K::ContactRows; 2],
        impulses: &mut K::ContactRows,
    ) -> Result<Solved, ContactErrorKind> {
        let rows = K::ContactRows::DIM;
        let (gaps, e) = (self.gaps, self.kernel.restitution());
        let scales = laws.scales;
        let mut problem = Impulses::new(&mut self.memory.as_mut()[..Impulses::memory(rows)], rows);
        problem.dependent = self.dependent;
        let entry = |i: usize, j: usize| dynamics.response.delassus[(i, j)];
        problem.set_up(&scales, entry, |row| [free.component(row), impulses.component(row)]);
        // What an impact passes on is a part of the rate before it.
        let passed_on = |i: usize| -e.component(i) * before.component(K::CONTACTS[i].normal).min(0.0);
        let end = |i: usize, rate: f64| gaps.component(i) + 0.5 * h * (before.component(K::CONTACTS[i].normal) + rate);
        let mut cones = laws.cones;
        for (i, contact) in K::CONTACTS.iter().enumerate() {
            let free = problem.b[contact.normal];
            // Rolling resistance comes after the contact that it is of.
            cones[i].acts = match contact.rolls_on() {
                Some(on) => cones[on].acts,
                None => !contact.has_gap() || self.modes[i].is_closed() || end(i, free) <= 0.0,
            };
            if contact.has_gap() {
                problem.b[contact.normal] -= passed_on(i);
            }
        }
        let cones = &mut cones[..K::CONTACTS.len()];
        // A contact that others press closed takes part as well.
        let closes = |i: usize, rate: f64| end(i, rate + passed_on(i)) < 0.0;
        let found = problem.solve_with_more(cones, self.tolerance, closes);
        self.dependent = problem.dependent;
        if !found.holds {
            let finite = found.residual.worst().is_finite();
            let unsolved = ContactErrorKind::Unsolved { residual: found.residual };
            return Err(if finite { unsolved } else { ContactErrorKind::NonFinite });
        }
        // Half of the rates before and after the impulses, times these.
        let work = |row: usize| {
            let given = problem.rates[row] - problem.b[row];
            problem.impulses[row] * (scales[row] * free.component(row) + 0.5 * given)
        };
        let work = (0..rows).map(work).sum();
        let mut solved = Solved { found, rests: [false; MOST], struck: false, work };
        for (i, cone) in cones.iter().enumerate() {
            let was_open = !self.modes[i].is_closed();
            self.next[i] = problem.mode(cone, &scales, self.tolerance);
            let is_closed = self.next[i].is_closed();
            let closes = is_closed && K::CONTACTS[i].has_gap();
            solved.struck |= closes && was_open;
            let carries = carrier(K::CONTACTS, i);
            solved.rests[i] = is_closed && (!K::CONTACTS[carries].has_gap() || passed_on(carries) == 0.0);
        }
        (0..rows).for_each(|row| impulses.set_component(row, scales[row] * problem.impulses[row]));
        Ok(solved)
    }
}

/// The state at half of a step, with the speeds at which accelerations are taken.
struct Middle<K: ContactSystem> {
    t: f64,
    q: K::Configuration,
    z: K::Speeds,
}

/// The end of a step.
struct End<K: ContactSystem> {
    q: K::Configuration,
    z: K::Speeds,
    gaps: K::Gaps,
    rates: K::ContactRows,
    impulses: K::ContactRows,
    /// Whether contacts may have changed their modes.
    touches: bool,
    report: StepReport,
    /// Whether a gap has closed.
    struck: bool,
}

/// What the laws of a step came to.
struct Solved {
    found: Found,
    /// Contacts that are closed after the step.
    rests: [bool; MOST],
    /// Whether a gap has closed.
    struck: bool,
    /// Of the impulses.
    work: f64,
}

fn pushed_rows<K: ContactSystem<Scalar = f64>>(
    z: &K::Speeds,
    columns: &K::ContactColumns,
    rows: &K::ContactRows,
) -> K::Speeds {
    let mut all = [0.0; MOST_ROWS];
    let all = &mut all[..K::ContactRows::DIM];
    all.iter_mut().enumerate().for_each(|(row, impulse)| *impulse = rows.component(row));
    pushed::<K>(z, columns, all)
}
