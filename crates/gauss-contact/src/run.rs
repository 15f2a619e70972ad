//! Runs from event to event.

use alloc::rc::Rc;
use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::integrate::drive::simulation::NoControl;
use gauss_runtime::integrate::drive::tolerance::Tolerance;
use gauss_runtime::integrate::{
    Adaptive, Control, Crossing, Feedback, InputSource, IntegrationErrorKind, NoInput, Simulation,
};
use gauss_runtime::real::Real;
use gauss_runtime::system::GaussSystem;

use crate::decide::{Instant, Scales};
use crate::dense::{epsilon, value};
use crate::error::{ContactError, ContactErrorKind};
use crate::impact::Impact;
use crate::mode::{InMode, Mode, slip, tangents};
use crate::problem::InModeProblem;
use crate::rounding::Rounding;
use crate::trajectory::{ContactTrajectory, InputOf, Segment, integration};
use crate::witness::{Watched, Witness};

/// A run with contacts in preparation.
#[derive(Clone, Copy, Debug)]
#[must_use = "a run does nothing before `run`"]
pub struct ContactRun<'k, K, C = NoControl, I = NoInput> {
    pub(crate) kernel: &'k K,
    pub(crate) control: C,
    pub(crate) input: I,
    pub(crate) law: Impact,
    pub(crate) jams: bool,
    pub(crate) tolerance: Tolerance,
    pub(crate) limit: usize,
}

/// Events of a run unless it sets another limit.
const MOST_EVENTS: usize = 1_000_000;

impl<'k, K: ContactSystem> ContactRun<'k, K> {
    /// A run of a system, without inputs and with Newton's law of impact.
    pub fn new(kernel: &'k K) -> Self {
        const { assert!(K::Scalar::LANES == 1, "runs with contacts take one state at a time, no packs of numbers") }
        let tolerance = Tolerance { relative: 1e-9, absolute: 1e-9 };
        let (law, limit) = (Impact::Newton, MOST_EVENTS);
        Self { kernel, control: NoControl, input: NoInput, law, jams: false, tolerance, limit }
    }
}

impl<'k, K: ContactSystem, C, I> ContactRun<'k, K, C, I> {
    /// Steps as long as the tolerances allow: see [`Adaptive::new`]. They are those of [`tolerance`](Self::tolerance)
    /// as well.
    pub fn adaptive(self, relative: f64, absolute: f64) -> ContactRun<'k, K, Adaptive, I> {
        self.control(Adaptive::new(relative, absolute)).tolerance(relative, absolute)
    }

    /// Any method with its choice of steps.
    pub fn control<D>(self, control: D) -> ContactRun<'k, K, D, I> {
        let Self { kernel, input, law, jams, tolerance, limit, .. } = self;
        ContactRun { kernel, control, input, law, jams, tolerance, limit }
    }

    /// The speeds that count as rest where bounces pile up and where a slip of several rows of friction ends:
    /// `absolute`, plus `relative` times the largest speed at an event so far. Each such place adds an error of that
    /// size.
    pub fn tolerance(mut self, relative: f64, absolute: f64) -> Self {
        self.tolerance = Tolerance { relative, absolute };
        self
    }

    /// The input as a function of time and state, which should be smooth.
    pub fn input<G>(self, input: G) -> ContactRun<'k, K, C, Feedback<G>>
    where
        G: Fn(K::Scalar, &K::Configuration, &K::Speeds) -> K::Input,
    {
        let Self { kernel, control, law, jams, tolerance, limit, .. } = self;
        ContactRun { kernel, control, input: Feedback(input), law, jams, tolerance, limit }
    }

    /// The law of impacts.
    pub fn law(mut self, law: Impact) -> Self {
        self.law = law;
        self
    }

    /// At Painlevé's states without a motion ([`ContactErrorKind::Inconsistent`]) an impulse stops the slip, at a gap
    /// that is closed and does not close further: an impact without collision, the only solution of the laws for
    /// velocities but none at all (F. Génot & B. Brogliato 1999). Without this the run ends there.
    pub fn impact_without_collision(mut self) -> Self {
        self.jams = true;
        self
    }

    /// The most events before the run is given up, instead of a million.
    pub fn max_events(mut self, limit: usize) -> Self {
        self.limit = limit;
        self
    }

    /// Runs from (q₀, z₀) over the interval, forward in time.
    ///
    /// # Errors
    /// When the end is not reached; [`attempt`](Self::attempt) then gives the part that was made.
    pub fn run(
        self,
        q0: K::Configuration,
        z0: K::Speeds,
        interval: Range<K::Scalar>,
    ) -> Result<ContactTrajectory<'k, K>, ContactError>
    where
        C: Control<InMode<'k, K>> + Clone + 'k,
        I: InputSource<K> + 'k,
    {
        match self.attempt(q0, z0, interval) {
            (trajectory, None) => Ok(trajectory),
            (_, Some(error)) => Err(error),
        }
    }

    /// Like [`run`](Self::run), but gives the part that was made when the end is not reached, with the reason.
    pub fn attempt(
        self,
        q0: K::Configuration,
        z0: K::Speeds,
        interval: Range<K::Scalar>,
    ) -> (ContactTrajectory<'k, K>, Option<ContactError>)
    where
        C: Control<InMode<'k, K>> + Clone + 'k,
        I: InputSource<K> + 'k,
    {
        let Self { kernel, control, input, law, jams, tolerance, limit } = self;
        let input: InputOf<'k, K> = Rc::new(move |t, q, z| input.input(t, q, z));
        let run = ContactRun { kernel, control, input: NoInput, law, jams, tolerance, limit };
        run.attempt_with(input, None, (q0, z0), interval)
    }
}

impl<'k, K: ContactSystem, C> ContactRun<'k, K, C> {
    /// The same with a shared input; a run in which events pile up ends, if they are given, where there are more than
    /// so many within so long a time.
    pub(crate) fn attempt_with(
        self,
        input: InputOf<'k, K>,
        piles: Option<(usize, f64)>,
        (q0, z0): (K::Configuration, K::Speeds),
        interval: Range<K::Scalar>,
    ) -> (ContactTrajectory<'k, K>, Option<ContactError>)
    where
        C: Control<InMode<'k, K>> + Clone + 'k,
    {
        let Self { kernel, control, law, jams, tolerance, limit, .. } = self;
        let (segments, events, solves) = (Vec::new(), Vec::new(), Vec::new());
        let made = ContactTrajectory { segments, events, solves, input };
        let scales =
            Scales { tolerance, largest: 0.0, law, start: value(interval.start), epsilon: epsilon::<K::Scalar>() };
        let end = interval.end;
        let mut driver = Driver {
            kernel,
            control,
            made,
            scales,
            jams,
            end,
            limit,
            piles,
            recent: Vec::new(),
            last: f64::NEG_INFINITY,
            at_once: 0,
        };
        let error = driver.go((interval.start, q0.renormalise(), z0)).err();
        (driver.made, error)
    }
}

/// A run on its way.
struct Driver<'k, K: ContactSystem, C> {
    kernel: &'k K,
    control: C,
    made: ContactTrajectory<'k, K>,
    scales: Scales,
    end: K::Scalar,
    jams: bool,
    limit: usize,
    /// More than so many events within so long a time pile up.
    piles: Option<(usize, f64)>,
    /// The contacts of the events, where that is asked.
    recent: Vec<usize>,
    /// The time of the last event, and how many there were at it.
    last: f64,
    at_once: u32,
}

/// Events at one time before they count as endless: all contacts may have several of their own.
const AT_ONCE: u32 = 200;

impl<'k, K, C> Driver<'k, K, C>
where
    K: ContactSystem,
    C: Control<InMode<'k, K>> + Clone + 'k,
{
    fn go(&mut self, (t, q, z): (K::Scalar, K::Configuration, K::Speeds)) -> Result<(), ContactError> {
        self.check_start(t, &q, &z)?;
        let modes = vec![Mode::Open; K::CONTACTS.len()];
        let mut instant = Instant { kernel: self.kernel, t, q, z, modes, fired: None, first: true, jams: self.jams };
        loop {
            instant.decide(&mut self.scales, &mut self.made)?;
            let fired = self.segment(&instant)?;
            let Some(last) = self.made.last() else { return Ok(()) };
            instant = Instant { t: last.t, q: last.q, z: last.z, fired, first: false, ..instant };
            instant.fired = fired.or_else(|| self.touches(&instant));
            let Some(fired) = instant.fired else { return Ok(()) };
            self.count(value(last.t), fired)?;
        }
    }

    fn check_start(&self, t: K::Scalar, q: &K::Configuration, z: &K::Speeds) -> Result<(), ContactError> {
        if !(t.is_finite() && self.end.is_finite() && value(t) <= value(self.end)) {
            return Err(ContactError { contact: None, time: value(t), kind: ContactErrorKind::InvalidInterval });
        }
        crate::start::check(self.kernel, t, q, z)
    }

    /// Counts events that do not move the time.
    fn count(&mut self, t: f64, fired: Watched) -> Result<(), ContactError> {
        let stop = |kind| Err(ContactError { contact: Some(K::CONTACTS[fired.contact()].name), time: t, kind });
        self.at_once = if t - self.last <= 16.0 * self.scales.resolution(t) { self.at_once + 1 } else { 0 };
        self.last = t;
        if self.at_once > AT_ONCE {
            let count = self.at_once;
            return stop(match fired {
                Watched::Gap(_) => ContactErrorKind::Zeno { impacts: count },
                _ => ContactErrorKind::Chatter { changes: count },
            });
        }
        if let Some((events, span)) = self.piles {
            self.recent.push(fired.contact());
            if self.pile_up(t, events, span) {
                return stop(ContactErrorKind::EventsPile { events, span });
            }
        }
        if self.made.segments.len() >= self.limit {
            return stop(ContactErrorKind::TooManyEvents { limit: self.limit });
        }
        Ok(())
    }

    /// Whether the last event and so many before it are within so long a time. Bounces at one gap alone come to their
    /// end.
    fn pile_up(&self, t: f64, events: usize, span: f64) -> bool {
        let segments = &self.made.segments;
        // Segments start at events but for the first.
        let Some(first) = segments.len().checked_sub(events).filter(|first| *first > 0) else { return false };
        let last = &self.recent[self.recent.len().saturating_sub(events + 1)..];
        t - value(segments[first].trajectory.first().t) < span && last.iter().any(|contact| *contact != last[0])
    }

    /// One segment; what ended it, unless it reached the end of the run.
    fn segment(&mut self, from: &Instant<'k, K>) -> Result<Option<Watched>, ContactError> {
        let rounding = from.sizes(&self.scales).of_rate;
        let system = InMode::with(self.kernel, &from.modes, (self.scales.rest(), &rounding));
        let problem = InModeProblem::new(system.clone(), Rc::clone(&self.made.input));
        let witnesses = self.witnesses(from, &problem);
        let watched: Vec<Watched> = witnesses.iter().map(|witness| witness.watched).collect();
        let functions = witnesses
            .into_iter()
            .map(|witness| move |t: K::Scalar, q: &K::Configuration, z: &K::Speeds| witness.value(t, q, z));
        let simulation = Simulation::of(problem).control(self.control.clone());
        let simulation = simulation.until_each(Crossing::Falling, functions.collect());
        let (trajectory, error) = simulation.attempt(from.q, from.z, from.t..self.end);
        let stopped = trajectory.stopped_by().map(|n| watched[n]);
        let (last, end) = (*trajectory.last(), trajectory.last().t);
        self.made.segments.push(Segment { system, trajectory });
        if let Some(error) = error {
            let grazes = |event: usize, rate| ContactError {
                contact: Some(K::CONTACTS[watched[event].contact()].name),
                time: value(end),
                kind: ContactErrorKind::Grazes { rate },
            };
            return Err(match error.kind {
                IntegrationErrorKind::NoDerivative { event, rate } => grazes(event, rate),
                _ => integration(value(end), error),
            });
        }
        self.check_end(&from.modes, (end, &last.q, &last.z))?;
        Ok(stopped)
    }

    /// What the end of a run falls on to the resolution of its time: a gap that closes, a slip that ends.
    fn touches(&self, end: &Instant<'k, K>) -> Option<Watched> {
        // In a segment of no length nothing changes. The derivatives of an end that an event falls on are those of the
        // side from which it comes.
        let moves = |t: K::Scalar| !K::Scalar::DERIVATIVES && value(t) < value(end.t);
        let segment = self.made.segments.last().filter(|segment| moves(segment.trajectory.first().t))?;
        let (sizes, gaps) = (end.sizes(&self.scales), self.kernel.gaps(end.t, &end.q));
        let input = (self.made.input)(end.t, &end.q, &end.z);
        let loads = segment.system.loads(end.t, &end.q, &end.z, &input);
        let rate = |row: usize| value(sizes.rates.component(row));
        let stops = |row: usize| {
            let late = 4.0 * self.scales.resolution(value(end.t)) * value(loads.row_acceleration(row)).abs();
            rate(row).abs() <= sizes.of_rate[row] + late
        };
        let mut each = K::CONTACTS.iter().zip(&end.modes).enumerate();
        each.find_map(|(i, (contact, mode))| match mode {
            Mode::Open if contact.has_gap() && rate(contact.normal) < -sizes.of_rate[contact.normal] => {
                (value(gaps.component(i)) <= sizes.of_gap[i]).then_some(Watched::Gap(i))
            }
            Mode::Slides(_) => tangents(contact).all(stops).then_some(Watched::Slip(i)),
            _ => None,
        })
    }

    /// Refuses gaps and slips that have passed through zero unseen.
    fn check_end(
        &self,
        modes: &[Mode<K::Scalar>],
        (t, q, z): (K::Scalar, &K::Configuration, &K::Speeds),
    ) -> Result<(), ContactError> {
        let (gaps, rates) = (self.kernel.gaps(t, q), self.kernel.contact_rates(t, q, z));
        let t = value(t);
        let bound = Rounding::of::<K>(q).half_of_the_digits();
        for (i, (contact, mode)) in K::CONTACTS.iter().zip(modes).enumerate() {
            let stop = |kind| Err(ContactError { contact: Some(contact.name), time: t, kind });
            // Events are found to the resolution of the time.
            let late = 8.0 * self.scales.resolution(t) * value(rates.component(contact.normal)).abs();
            match mode {
                Mode::Open if value(gaps.component(i)) < -(bound + late) => {
                    return stop(ContactErrorKind::Penetration { gap: value(gaps.component(i)) });
                }
                Mode::Slides(reference) if tangents(contact).len() == 1 => {
                    let along = value(slip(contact, &rates)[0] * reference[0]);
                    if along < -self.scales.rest().max(bound) {
                        return stop(ContactErrorKind::Chatter { changes: 1 });
                    }
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// What ends the segment from here.
    fn witnesses(&self, from: &Instant<'k, K>, problem: &InModeProblem<'k, K>) -> Vec<Witness<'k, K>> {
        let mut found = Vec::new();
        // The run starts there: what brings closed gaps to zero moves others by rounding, and below zero none closes.
        let start = problem.system.project(from.t, &from.q, &from.z);
        let (q, z) = start.unwrap_or((from.q, from.z));
        let mut watch = |watched: Watched, shift: &dyn Fn(f64) -> f64| {
            let mut witness = Witness { problem: problem.clone(), watched, shift: 0.0 };
            witness.shift = shift(value(witness.bare(from.t, &q, &z)));
            found.push(witness);
        };
        let sizes = from.sizes(&self.scales);
        let loads = (!problem.system.is_open()).then(|| problem.loads(from.t, &from.q, &from.z));
        for (i, contact) in K::CONTACTS.iter().enumerate() {
            // Forces that are no more than rounding start above zero by as much.
            let least = loads.as_ref().map_or(0.0, |loads| loads.rounding(contact).max(f64::MIN_POSITIVE));
            let above = move |value: f64| if value > least { 0.0 } else { least - value };
            let from_zero = |bound: f64| move |value: f64| if value.abs() <= bound { -value } else { 0.0 };
            match from.modes[i] {
                Mode::Open if !contact.has_gap() => {}
                Mode::Open => {
                    // What others have pushed below zero, as they came to rest, starts from there: it would never fall
                    // to zero.
                    let opens = value(sizes.rates.component(contact.normal)) > sizes.of_rate[contact.normal];
                    let start = if opens { 0.0 } else { sizes.rounding[i] };
                    watch(Watched::Gap(i), &|gap| if gap <= sizes.of_gap[i] { start - gap } else { 0.0 });
                }
                Mode::Closed => watch(Watched::Force(i), &above),
                Mode::Sticks => {
                    if contact.has_gap() {
                        watch(Watched::Force(i), &above);
                    }
                    watch(Watched::Cone(i), &above);
                }
                Mode::Slides(_) => {
                    if contact.has_gap() {
                        watch(Watched::Force(i), &above);
                    }
                    let rounding = tangents(contact).map(|row| sizes.of_rate[row]).fold(0.0, f64::max);
                    watch(Watched::Slip(i), &from_zero(rounding));
                    if tangents(contact).len() > 1 {
                        watch(Watched::Speed(i, self.scales.rest()), &|_| 0.0);
                    }
                    if contact.has_gap() {
                        watch(Watched::Pushes(i), &|_| 0.0);
                    }
                }
            }
        }
        found
    }
}
