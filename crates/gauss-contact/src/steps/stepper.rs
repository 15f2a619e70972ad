//! One step after another.

use alloc::vec;
use alloc::vec::Vec;
use core::fmt;

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::contact::{ContactSystem, Each, ImpulseDynamics, ImpulseResponse};
use gauss_runtime::integrate::problem::state::TangentOf;
use gauss_runtime::real::Real;

use crate::error::{ContactError, ContactErrorKind};
use crate::lockstep::Lockstep;
use crate::mode::{Mode, after_impulses};
use crate::sensors::ContactForces;

use super::account::Account;
use super::bounds::{NotClosed, Touched, gaps_of};
use super::cones::Laws;
use super::impulses::{Impulses, memory};
use super::kept::Kept;
use super::linear::Place;
use super::motion::{self, Middle};
use super::outcome::{Attempt, End, Pushed, Refused, Solved, has_no_end, is_stiff};
use super::posed::Posed;
use super::projection::{Closed, Projection};
use super::relaxed::StepLaw;
use super::report::{StepReport, StepScheme};
use super::step::{Contacted, Decisions, Moved, Step, StepDynamics, Stopped};
use super::stiffness::LastForces;
use super::unknowns::Unknowns;
use super::watch::Watch;

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
    pub(super) law: StepLaw,
    pub(super) tolerance: f64,
    /// Whether a step is made in parts for what its impacts gain.
    pub(super) accounts: bool,
    pub(super) memory: M,
    pub(super) impulses: K::ContactRows,
    /// Whether contacts depended on one another in the last step.
    pub(super) dependent: bool,
    /// At the state.
    pub(super) gaps: K::Gaps,
    pub(super) rates: K::ContactRows,
    /// Forces of the last step.
    pub(super) last: LastForces<K::Speeds>,
    /// Account of the energy, where contacts stay the same from step to step.
    pub(super) account: Option<Account>,
    pub(super) modes: K::EachContact<Mode>,
    /// Contacts that are closed at the state and stay so.
    pub(super) rests: K::EachContact<bool>,
    /// Modes of the step that is being made.
    pub(super) next: K::EachContact<Mode>,
    pub(super) report: StepReport,
}

/// The number of times a step is halved, at most, where no impulses, or no places, are found for it, or where it is too
/// long for its forces.
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
    /// `NegativeGap`, `InvalidRestitution`, `NonFinite`: as runs from event to event. `States` where elements have
    /// states.
    pub fn new(kernel: &'k K, t: f64, q: K::Configuration, z: K::Speeds) -> Result<Self, ContactError> {
        Self::with_memory(kernel, (t, q, z), vec![0.0; Self::MEMORY])
    }
}

impl<'k, K: ContactSystem<Scalar = f64>, M: AsMut<[f64]>> ContactStepper<'k, K, M> {
    const ROWS: usize = K::ContactRows::DIM;
    /// Number of numbers that steps need.
    pub const MEMORY: usize = memory(Self::ROWS) + Projection::<K>::MEMORY;

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
        const { assert!(Self::ROWS <= Place::MAX as usize, "steps number rows by two bytes") }
        assert!(memory.as_mut().len() >= Self::MEMORY, "steps of this system need {} numbers", Self::MEMORY);
        crate::start::check(kernel, t, &q, &z)?;
        let states = kernel.states();
        if states > 0 {
            let kind = ContactErrorKind::States { states };
            return Err(ContactError { contact: None, time: t, kind });
        }
        let q = q.renormalise();
        let mut stepper = Self {
            kernel,
            t,
            q,
            z,
            scheme: StepScheme::default(),
            law: StepLaw::default(),
            tolerance: 1e-8,
            accounts: true,
            memory,
            impulses: K::ContactRows::zero(),
            dependent: false,
            gaps: kernel.gaps(t, &q),
            rates: kernel.contact_rates(t, &q, &z),
            last: LastForces::default(),
            account: Some(Account::begun(kernel, (t, &q, &z))),
            modes: Each::from_fn(|_| Mode::Open),
            rests: Each::from_fn(|_| false),
            next: Each::from_fn(|_| Mode::Open),
            report: StepReport::default(),
        };
        stepper.find_closed();
        Ok(stepper)
    }

    /// Sets the scheme by which the motion between impacts is taken.
    #[must_use]
    pub fn scheme(mut self, scheme: StepScheme) -> Self {
        self.scheme = scheme;
        self
    }

    /// Which law of friction impulses satisfy.
    #[must_use]
    pub fn law(mut self, law: StepLaw) -> Self {
        self.law = law;
        self
    }

    /// Sets how far from the laws a solution may be, as a part of the largest rate, in place of 10⁻⁸. A ten thousandth
    /// of that is looked for first, and rounding is always allowed for; what was found is in the report.
    #[must_use]
    pub fn tolerance(mut self, tolerance: f64) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// The time.
    pub fn time(&self) -> f64 {
        self.t
    }

    /// Says what time it is, where sums of lengths have rounded it.
    pub(crate) fn at_time(&mut self, t: f64) {
        self.t = t;
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

    /// The mean forces of the last step, with what sensors at the contacts measure; zero before the first step.
    pub fn forces(&self) -> ContactForces<'k, K> {
        ContactForces::new(self.kernel, self.t, self.q, self.report.mean(&self.impulses))
    }

    /// Modes of the contacts in the last step.
    pub fn modes(&self) -> &[Mode] {
        self.modes.as_ref()
    }

    /// Report of the last step.
    pub fn report(&self) -> StepReport {
        self.report
    }

    /// Finds the contacts that touch at the start: gaps of zero, to rounding, that stay so. One that closes there is an
    /// impact of the first step: its jump is no acceleration.
    pub(super) fn find_closed(&mut self) {
        let (gaps, rates) = (self.gaps, self.rates);
        let near = crate::rounding::Rounding::of::<K>(&self.q).half_of_the_digits();
        let fastest = (0..K::ContactRows::DIM).map(|row| rates.component(row).abs()).fold(0.0, f64::max);
        let still = Real::sqrt(f64::EPSILON) * fastest;
        for (i, contact) in self.kernel.contacts().iter().enumerate() {
            let rate = || rates.component(contact.normal);
            if contact.has_gap() && gaps.component(i) <= near && (-still..=0.0).contains(&rate()) {
                self.modes[i] = Mode::Closed;
                self.rests[i] = true;
            }
        }
    }

    /// One step of length `h`, under an input that stays. Where no impulses are found for it, where its gaps contradict
    /// one another, or where it is too long for its forces, it is made in up to 16 parts. Where it is an error, the
    /// state is that before the step.
    ///
    /// # Errors
    /// `Unsolved` where no impulses were found that satisfy the laws, `Stiff` where forces depend on places or speeds
    /// more than the step can follow, `StiffSprings` where by `MoreauJean` they do on places, `EnergyFromNowhere` where
    /// an impact, or all steps so far, gain more than all that moves has, `InvalidFriction`, `NonFinite`, `Projection`,
    /// `Displacement`.
    pub fn step(&mut self, h: f64, input: &K::Input) -> Result<StepReport, ContactError> {
        self.watched(h, input, &mut ())
    }

    /// A step whose parts are watched.
    pub(super) fn watched<W: Watch<K>>(
        &mut self,
        h: f64,
        input: &K::Input,
        watch: &mut W,
    ) -> Result<StepReport, ContactError> {
        if !(h > 0.0 && h.is_finite()) {
            return Err(self.error(None, ContactErrorKind::InvalidInterval));
        }
        let made = self.in_parts(h, input, (HALVINGS, watch));
        self.report = made.map_err(|error| self.named(h / f64::from(1_u32 << HALVINGS), error, input))?;
        Ok(self.report)
    }

    /// All that a step changes, but memory.
    pub(super) fn kept(&self) -> Kept<K> {
        let Self { t, q, z, gaps, rates, impulses, last, account, dependent, modes, rests, report, .. } = *self;
        Kept { t, q, z, gaps, rates, impulses, last, account, dependent, modes, rests, report }
    }

    /// Back to what was kept.
    pub(super) fn restore(&mut self, kept: &Kept<K>) {
        (self.t, self.q, self.z) = (kept.t, kept.q, kept.z);
        (self.gaps, self.rates, self.impulses) = (kept.gaps, kept.rates, kept.impulses);
        (self.last, self.account, self.dependent) = (kept.last, kept.account, kept.dependent);
        (self.modes, self.rests, self.report) = (kept.modes, kept.rests, kept.report);
    }

    /// A step, or both halves of it.
    fn in_parts<W: Watch<K>>(
        &mut self,
        h: f64,
        input: &K::Input,
        (halvings, watch): (u32, &mut W),
    ) -> Result<StepReport, ContactError> {
        // Where a step is made in parts its end jumps: without a memory it is to be smooth in its start.
        let accounts = self.accounts && halvings > 0 && self.scheme == StepScheme::Midpoint;
        let cause = match self.whole(h, input, (watch, halvings == 0, accounts)) {
            Ok(report) => return Ok(report),
            Err(Refused::Gains(Some(cause))) if halvings == 0 => return Err(cause),
            Err(Refused::Error(cause)) if halvings == 0 || !(has_no_end(&cause) || is_stiff(&cause)) => {
                return Err(cause);
            }
            Err(cause) => cause,
        };
        let (before, parts) = (self.kept(), watch.parts());
        let both = self.both_halves(h, input, (halvings - 1, watch));
        both.or_else(|error| {
            self.restore(&before);
            let last = match &cause {
                Refused::Gains(_) => false,
                Refused::Error(cause) if is_stiff(cause) && has_no_end(&error) => true,
                Refused::Error(_) => return Err(error),
            };
            // Too long for its forces or its impacts, but its laws have a solution for the whole of it, if for any.
            watch.keep(parts);
            self.whole(h, input, (watch, last, false)).map_err(|again| match again {
                Refused::Error(again) if last && is_stiff(&again) => again,
                _ => error,
            })
        })
    }

    fn both_halves<W: Watch<K>>(
        &mut self,
        h: f64,
        input: &K::Input,
        (halvings, watch): (u32, &mut W),
    ) -> Result<StepReport, ContactError> {
        let first = self.in_parts(0.5 * h, input, (halvings, watch))?;
        let of_first = self.impulses;
        let second = self.in_parts(0.5 * h, input, (halvings, watch))?;
        self.impulses = self.impulses.add_scaled(1.0, &of_first);
        Ok(first.and(second))
    }

    /// Half of a step, given the rate of places before it, and whether its speeds are foreseen, not those before it.
    pub(super) fn middle(&self, h: f64, rate: &TangentOf<K>) -> (Middle<K>, bool) {
        let (z, known) = match (self.scheme, self.last.acceleration) {
            (StepScheme::Midpoint, Some(rate)) => (self.z.add_scaled(0.5 * h, &rate), true),
            _ => (self.z, false),
        };
        (Middle::new((self.t, h), motion::half_way::<K>(h, &self.q, rate), self.z, z), known)
    }

    /// Takes the end of a step as the state.
    pub(super) fn take(&mut self, h: f64, made: Attempt<K>) -> Result<StepReport, ContactError> {
        if !(made.end.q.is_finite() && made.end.z.is_finite()) {
            return Err(self.error(None, ContactErrorKind::NonFinite));
        }
        // A gap that is no number is neither open nor closed.
        if let Some((i, _)) = gaps_of(self.kernel).find(|(i, _)| !made.end.gaps.component(*i).is_finite()) {
            return Err(self.error(Some(i), ContactErrorKind::NonFinite));
        }
        self.account = self.accounted(h, &made)?;
        let Attempt { end, acceleration } = made;
        let changed = || end.z.add_scaled(-1.0, &self.z).scale(1.0 / h);
        self.last = self.last.then((h, acceleration), (!end.struck).then(changed));
        self.t += h;
        (self.q, self.z, self.impulses) = (end.q, end.z, end.impulses);
        if end.touches {
            core::mem::swap(&mut self.modes, &mut self.next);
            (0..self.kernel.contacts().len()).filter(|i| end.left[*i]).for_each(|i| self.modes[i] = Mode::Open);
        }
        (self.gaps, self.rates, self.rests) = (end.gaps, end.rates, end.rests);
        Ok(StepReport { length: h, ..end.report })
    }

    /// A step with forces that are taken at half of it.
    pub(super) fn attempt(&mut self, h: f64, middle: &Middle<K>, input: &K::Input) -> Result<Attempt<K>, ContactError> {
        let (kernel, z) = (self.kernel, self.z);
        let step = Step { kernel, h, end: self.t + h, z: &z, middle };
        if self.flies()
            && let Some((end, acceleration)) = step.flight(input, self)?
        {
            let gaps = kernel.gaps(step.end, &end.0);
            if !Self::is_below_zero(kernel, &gaps) {
                let rates = kernel.contact_rates(step.end, &end.0, &end.1);
                return Ok(Attempt { end: Self::flown(end, gaps, rates), acceleration });
            }
        }
        let Contacted { pushed, closed, stopped, acceleration } = step.touching(input, self)?;
        Ok(Attempt { end: self.end(pushed, closed, stopped), acceleration })
    }

    pub(super) fn error(&self, contact: Option<usize>, kind: ContactErrorKind) -> ContactError {
        ContactError { contact: contact.map(|i| self.kernel.contacts()[i].name), time: self.t, kind }
    }

    /// The end of a step in flight.
    pub(super) fn flown((q, z): (K::Configuration, K::Speeds), gaps: K::Gaps, rates: K::ContactRows) -> End<K> {
        let (impulses, report, rests) = (K::ContactRows::zero(), StepReport::default(), Each::from_fn(|_| false));
        let (left, opened) = (rests, rests);
        End {
            q,
            z,
            gaps,
            rates,
            impulses,
            rests,
            left,
            opened,
            touches: false,
            dependent: false,
            report,
            struck: false,
        }
    }

    /// Mode of a contact at the end of a step, whose rates are brought to zero.
    pub(super) fn mode_at_end(&self, pushed: &Pushed<K>, i: usize) -> Mode {
        if pushed.solved.rests[i] { self.next[i] } else { Mode::Open }
    }

    /// Whether contacts do something else in the step than before it.
    fn changes(&self) -> bool {
        let kind = |mode: &Mode| core::mem::discriminant(mode);
        (0..self.kernel.contacts().len()).any(|i| kind(&self.next[i]) != kind(&self.modes[i]))
    }

    /// Rounding of rates at the end of a step: what begins to rest is brought to zero to the last bit, and stays there.
    pub(super) fn rounding_at_end(&self, solved: &Solved<K>) -> f64 {
        if self.changes() { 0.0 } else { solved.found.residual.rounding }
    }

    /// The end of a step.
    pub(super) fn end(
        &mut self,
        pushed: Pushed<K>,
        closed: Closed<K>,
        (z, rates): (K::Speeds, K::ContactRows),
    ) -> End<K> {
        let Pushed { impulses, dependent, solved } = pushed;
        let Closed { q, gaps, penetration, closure, left } = closed;
        self.dependent &= !self.changes();
        let report = StepReport {
            residual: solved.found.residual,
            from_coulomb: solved.from_coulomb,
            penetration,
            closed: self.next.as_ref().iter().filter(|mode| mode.is_closed()).count(),
            corrections: solved.found.corrections,
            sweeps: solved.found.sweeps,
            work: solved.work,
            closure,
            impacts: solved.impacts,
            ..StepReport::default()
        };
        let Solved { rests, struck, .. } = solved;
        let opened = Each::from_fn(|i| self.may_bounce(i));
        End { q, z, gaps, rates, impulses, rests, left, opened, touches: true, dependent, report, struck }
    }

    /// The end of a step as the state, with the report.
    pub(super) fn made(&mut self, h: f64, made: Attempt<K>) -> Result<StepReport, ContactError> {
        self.report = self.take(h, made)?;
        Ok(self.report)
    }

    /// Impulses of a step, and its modes.
    fn solve(
        &mut self,
        h: f64,
        (laws, response): (&Laws<K>, &ImpulseResponse<K>),
        rates: [K::ContactRows; 2],
    ) -> Result<(Solved<K>, K::ContactRows), ContactErrorKind> {
        let mut unknowns = Unknowns::<K>::new();
        let Self { kernel, law, tolerance, gaps, impulses, dependent, .. } = *self;
        let (restitution, delassus, modes) = (kernel.restitution(), &response.delassus, self.modes.as_ref());
        let fastest = motion::fastest::<K>(&rates);
        let posed = Posed {
            kernel,
            h,
            law,
            tolerance,
            laws,
            delassus,
            restitution,
            gaps,
            rates,
            fastest,
            impulses,
            modes,
            dependent,
        };
        let memory = &mut self.memory.as_mut()[..memory(Self::ROWS)];
        let mut problem = Impulses::new(memory, unknowns.slices(kernel));
        let mut cones = posed.pose(&mut problem);
        let cones = &mut cones.as_mut()[..kernel.contacts().len()];
        // A contact that others press closed takes part as well.
        let closes = |i: usize, rate: f64| posed.gap_left_open(i, rate) < 0.0;
        let before = |row: usize| impulses.component(row) / laws.scales[row];
        let found = problem.solve_with_more(cones, tolerance, (closes, before));
        self.dependent = problem.dependent;
        if !found.holds {
            let finite = found.residual.worst().is_finite();
            let unsolved = ContactErrorKind::Unsolved { residual: found.residual };
            return Err(if finite { unsolved } else { ContactErrorKind::NonFinite });
        }
        posed.drive(&mut problem, cones);
        let answer = posed.answer(&problem, found, cones);
        let solved = posed.solved(&problem, (&answer, cones), (self.rests.as_ref(), self.next.as_mut()), 0);
        Ok((solved, posed.impulses(&problem)))
    }
}

/// Decisions by the values of one state.
impl<K: ContactSystem<Scalar = f64>, M: AsMut<[f64]>> Decisions<K> for ContactStepper<'_, K, M> {
    type Pushed = Pushed<K>;
    type Refusal = ContactError;

    fn stays_open(
        &mut self,
        Step { kernel, h, z: before, middle, .. }: &Step<K>,
        z: &K::Speeds,
    ) -> Result<bool, ContactError> {
        let rates = kernel.contact_rates(middle.t, &middle.q, &motion::mean(before, z));
        Ok(!self.comes_to_zero(*h, &rates))
    }

    fn push(&mut self, at: &StepDynamics<K>) -> Result<(Pushed<K>, K::Speeds), ContactError> {
        let StepDynamics { step: Step { kernel, h, middle, .. }, friction, free, impulses } = at;
        let ImpulseDynamics { bias, response, .. } = impulses;
        let laws = Laws::new(*kernel, *h, friction).map_err(|(i, kind)| self.error(Some(i), kind))?;
        let known = self.dependent;
        let rates = |stepper: &Self| {
            let (dependent, bounces) = (stepper.dependent, |i: usize| stepper.may_bounce(i));
            motion::free_rates(*kernel, *h, middle, (&stepper.z, &stepper.rates), (free, bias), (dependent, bounces))
        };
        let mut solved = self.solve(*h, (&laws, response), rates(self));
        let again = solved.is_err() && self.dependent && !known;
        if again {
            solved = self.solve(*h, (&laws, response), rates(self));
        }
        let (solved, impulses) = solved.map_err(|kind| self.error(None, kind))?;
        let z = after_impulses(&Lockstep::default(), *kernel, free, (&response.factors, &impulses));
        Ok((Pushed { impulses, dependent: known || again, solved }, z))
    }

    fn project(&mut self, step: &Step<K>, (q, z): Moved<K>) -> Result<Moved<K>, ContactError> {
        let projected = step.kernel.project(step.end, &q, &z);
        projected.map_err(|cause| self.error(None, ContactErrorKind::Projection(cause)))
    }

    /// Closed gaps brought to zero; a contact that is left open rests no longer.
    fn close(
        &mut self,
        StepDynamics { step, impulses, .. }: &StepDynamics<K>,
        pushed: &mut Pushed<K>,
        (q, _): &Moved<K>,
    ) -> Result<Closed<K>, ContactError> {
        let (closed, rates) = (pushed.solved.rests.as_ref(), &self.rates);
        let touched = Touched { closed, impulses: &pushed.impulses, rates, h: step.h };
        let mut projection = Projection::new(step.kernel, &mut self.memory.as_mut()[memory(Self::ROWS)..]);
        let closed = projection.close((step.end, *q), &impulses.response, &touched);
        let closed = closed.map_err(|NotClosed { contact, kind }| self.error(contact, kind))?;
        (0..step.kernel.contacts().len()).filter(|i| closed.left[*i]).for_each(|i| pushed.solved.rests[i] = false);
        Ok(closed)
    }

    fn stop(
        &mut self,
        StepDynamics { step, impulses, .. }: &StepDynamics<K>,
        (pushed, closed): (&Pushed<K>, &Closed<K>),
        (z, rates): Stopped<K>,
    ) -> Result<Stopped<K>, ContactError> {
        let modes: K::EachContact<Mode> = Each::from_fn(|i| self.mode_at_end(pushed, i));
        let rounding = self.rounding_at_end(&pushed.solved);
        let mut projection = Projection::new(step.kernel, &mut self.memory.as_mut()[memory(Self::ROWS)..]);
        Ok(projection.stop((step.end, &closed.q, z, rates), &impulses.response, (|i| modes[i], rounding)))
    }
}
