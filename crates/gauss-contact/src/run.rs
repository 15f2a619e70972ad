//! Runs from event to event.

use alloc::rc::Rc;
use alloc::vec;
use alloc::vec::Vec;
use core::cell::RefCell;
use core::ops::Range;

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::integrate::drive::event::{Events, NoEvents};
use gauss_runtime::integrate::drive::run::Jumps;
use gauss_runtime::integrate::drive::simulation::NoControl;
use gauss_runtime::integrate::drive::task::SegmentEvents;
use gauss_runtime::integrate::drive::tolerance::Tolerance;
use gauss_runtime::integrate::{
    Adaptive, Control, Crossing, Feedback, InputSource, IntegrationErrorKind, NoInput, Sample, Simulation,
    SystemProblem,
};
use gauss_runtime::real::Real;
use gauss_runtime::system::GaussSystem;

use crate::decide::{Instant, Scales};
use crate::dense::value;
use crate::error::{ContactError, ContactErrorKind};
use crate::history::{Passage, SampledGap};
use crate::impact::Impact;
use crate::jumps::{self, Record};
use crate::mode::{InMode, Least, Mode, slip, tangents};
use crate::moving::MovingGaps;
use crate::problem::InModeProblem;
use crate::rounding::Rounding;
use crate::sampling::{self, Holds, with_holds};
use crate::settings::{Settings, TOLERANCE};
use crate::trajectory::{ContactTrajectory, InputOf, Segment, integration};
use crate::witness::{GapBound, Watched, Witness};

/// A run from event to event in preparation: that of
/// [`contact_events`](crate::WithContacts::contact_events) of a [`Simulation`].
#[derive(Clone, Copy, Debug)]
#[must_use = "a run does nothing before `run`"]
pub struct ContactRun<'k, K, C = NoControl, I = NoInput, E = NoEvents> {
    pub(crate) kernel: &'k K,
    pub(crate) control: C,
    pub(crate) input: I,
    pub(crate) settings: Settings,
    pub(crate) events: E,
}

impl<'k, K: ContactSystem> ContactRun<'k, K> {
    /// A run of a system, without inputs and with Newton's law of impact.
    pub fn new(kernel: &'k K) -> Self {
        Self::of_parts(kernel, NoControl, NoInput, NoEvents).tolerance(TOLERANCE.relative, TOLERANCE.absolute)
    }
}

impl<'k, K: ContactSystem, C, I, E> ContactRun<'k, K, C, I, E> {
    /// A run of these parts, with the tolerance of its steps.
    pub(crate) fn of_parts(kernel: &'k K, control: C, input: I, events: E) -> Self {
        const { assert!(K::Scalar::LANES == 1, "runs with contacts take one state at a time, no packs of numbers") }
        Self { kernel, control, input, settings: Settings::new(), events }
    }
}

impl<'k, K: ContactSystem, C, I, E> ContactRun<'k, K, C, I, E> {
    /// Steps as long as the tolerances allow: see [`Adaptive::new`]. They are those of [`tolerance`](Self::tolerance)
    /// as well.
    pub fn adaptive(self, relative: f64, absolute: f64) -> ContactRun<'k, K, Adaptive, I, E> {
        self.control(Adaptive::new(relative, absolute)).tolerance(relative, absolute)
    }

    /// Any method with its choice of steps.
    pub fn control<D>(self, control: D) -> ContactRun<'k, K, D, I, E> {
        let Self { kernel, input, settings, events, .. } = self;
        ContactRun { kernel, control, input, settings, events }
    }

    /// The speeds that count as rest where bounces pile up and where a slip of several rows of friction ends:
    /// `absolute`, plus `relative` times the largest speed at an event so far. Each such place adds an error of that
    /// size.
    pub fn tolerance(mut self, relative: f64, absolute: f64) -> Self {
        self.settings.tolerance = Some(Tolerance { relative, absolute });
        self
    }

    /// The input as a function of time and state, which should be smooth. At rest, where steps grow long, what it does
    /// is looked at every 256th of the time that is left: a push that is over sooner may fall between two looks, unless
    /// [`input_changes_within`](ContactRun::input_changes_within) says how near they have to be.
    pub fn input<G>(self, input: G) -> ContactRun<'k, K, C, Feedback<G>, E>
    where
        G: Fn(K::Scalar, &K::Configuration, &K::Speeds) -> K::Input,
    {
        self.input_from(Feedback(input))
    }

    /// The input from a type that implements [`InputSource`]: a controller with parameters of its own, or a table.
    pub fn input_from<J: InputSource<K>>(self, input: J) -> ContactRun<'k, K, C, J, E> {
        let Self { kernel, control, settings, events, .. } = self;
        ContactRun { kernel, control, input, settings, events }
    }

    /// The law of impacts.
    pub fn law(mut self, law: Impact) -> Self {
        self.settings.law = law;
        self
    }

    /// At Painlevé's states without a motion ([`ContactErrorKind::Inconsistent`]) an impulse stops the slip, at a gap
    /// that is closed and does not close further: an impact without collision, the only solution of the laws for
    /// velocities but none at all (F. Génot & B. Brogliato 1999). Without this the run ends there.
    pub fn impact_without_collision(mut self) -> Self {
        self.settings.jams = true;
        self
    }

    /// The most events before the run is given up, instead of a million.
    pub fn max_events(mut self, limit: usize) -> Self {
        self.settings.limit = limit;
        self
    }

    /// The most steps (rejected ones included) before the run is given up, in all of it.
    pub fn max_steps(mut self, limit: u64) -> Self {
        self.settings.steps = Some(limit);
        self
    }

    /// The run without its input, and that.
    pub(crate) fn parted(self) -> (ContactRun<'k, K, C, NoInput, E>, I) {
        let Self { kernel, control, input, settings, events } = self;
        (ContactRun { kernel, control, input: NoInput, settings, events }, input)
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
        E: Events<K>,
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
        E: Events<K>,
    {
        let (run, input) = self.parted();
        run.attempt_with(with_holds(input), None, (q0, z0), interval)
    }
}

impl<'k, K: ContactSystem, M, I, E> ContactRun<'k, K, Adaptive<M>, I, E> {
    /// The shortest time within which the input changes: see [`Adaptive::input_changes_within`].
    pub fn input_changes_within(mut self, time: f64) -> Self {
        self.control = self.control.input_changes_within(time);
        self
    }
}

impl<K: ContactSystem, C: Clone> ContactRun<'_, K, C> {
    /// The same once more.
    pub(crate) fn again(&self) -> Self {
        let Self { kernel, settings, .. } = *self;
        Self { kernel, control: self.control.clone(), input: NoInput, settings, events: NoEvents }
    }
}

impl<'k, K: ContactSystem, C, E> ContactRun<'k, K, C, NoInput, E> {
    /// The same with a shared input; a run in which events pile up ends, if they are given, where there are more than
    /// so many within so long a time.
    pub(crate) fn attempt_with(
        self,
        (input, holds): (InputOf<'k, K>, Option<Holds<K>>),
        piles: Option<(usize, f64)>,
        (q0, z0): (K::Configuration, K::Speeds),
        interval: Range<K::Scalar>,
    ) -> (ContactTrajectory<'k, K>, Option<ContactError>)
    where
        C: Control<InMode<'k, K>> + Clone + 'k,
        E: Events<K>,
    {
        let Self { kernel, control, settings, events, .. } = self;
        let scales = Scales::new(settings.tolerance::<InMode<'k, K>>(&control), settings.law, interval.start);
        let mut driver = Driver {
            kernel,
            control,
            made: ContactTrajectory::begun(input),
            holds,
            scales,
            settings,
            events,
            end: interval.end,
            jumps: Jumps::new::<K::Scalar>(value(interval.start), value(interval.end)),
            piles,
            used: 0,
            moving: MovingGaps::of(kernel, &q0, &interval),
            recent: Vec::new(),
            last: f64::NEG_INFINITY,
            at_once: 0,
        };
        let error = driver.go((interval.start, q0.renormalise(), z0)).err();
        (driver.made, error)
    }
}

/// A run on its way.
struct Driver<'k, K: ContactSystem, C, E> {
    kernel: &'k K,
    control: C,
    made: ContactTrajectory<'k, K>,
    /// Inputs that controllers have held, where there are some that sample.
    holds: Option<Holds<K>>,
    scales: Scales,
    settings: Settings,
    /// The events of the user.
    events: E,
    end: K::Scalar,
    /// Jumps by events of the user, as they follow each other.
    jumps: Jumps,
    /// More than so many events within so long a time pile up.
    piles: Option<(usize, f64)>,
    /// Steps so far, rejected ones included.
    used: u64,
    /// The largest rate at which each gap changes with the time alone.
    moving: MovingGaps,
    /// The contacts of the events, where that is asked.
    recent: Vec<usize>,
    /// The time of the last event, and how many there were at it.
    last: f64,
    at_once: u32,
}

/// A gap that sinks below zero by so many times what counts as closed is a landing.
const DEEP: f64 = 8.0;
/// The part of forces to which the most of their bounds is known.
const LEAST_RESERVE: f64 = 1e-9;
/// Events at one time before they count as endless: all contacts may have several of their own.
const AT_ONCE: u32 = 200;

/// Adds a witness, whose function is shifted by a function of its value at the start.
type AddWitness<'w> = dyn FnMut(Watched, &dyn Fn(f64) -> f64) + 'w;

/// The cause of the end of a segment.
enum Stop {
    /// The end of the run, or an event of the user.
    End,
    Contact(Watched),
}

impl<'k, K, C, E> Driver<'k, K, C, E>
where
    K: ContactSystem,
    C: Control<InMode<'k, K>> + Clone + 'k,
    E: Events<K>,
{
    fn go(&mut self, (t, q, z): (K::Scalar, K::Configuration, K::Speeds)) -> Result<(), ContactError> {
        self.check_start(t, &q, &z)?;
        sampling::begin::<K, E>(&mut self.events, self.holds.is_some(), (t, self.end), self.settings.steps)?;
        let (modes, jams) = (vec![Mode::Open; self.kernel.contacts().len()], self.settings.jams);
        let mut instant =
            Instant { kernel: self.kernel, t, q, z, modes, fired: None, first: true, jumped: false, jams };
        loop {
            let now = (instant.t, &instant.q, &instant.z);
            let (until, held) = match self.made.stopped_by {
                None => sampling::tick(&mut self.events, self.kernel, now, (None, self.end))?,
                Some(_) => (self.end, None),
            };
            held.iter().zip(&self.holds).for_each(|(held, holds)| holds.borrow_mut().push((value(now.0), *held)));
            self.decide(&mut instant)?;
            // An event over which an impact has led may have ended the run.
            let until = if value(self.end) < value(until) { self.end } else { until };
            let (stop, here) = self.segment(&instant, until)?;
            let fired = if let Stop::Contact(fired) = stop { Some(fired) } else { None };
            let Some(last) = self.made.last() else { return Ok(()) };
            let goes_on = value(last.t) < value(self.end) && value(last.t) == value(until);
            instant = Instant { t: last.t, q: last.q, z: last.z, fired, first: false, jumped: false, ..instant };
            // An event that may jump has ended the segment, also where it leaves the state as it is.
            let stopped_there = !here.is_empty();
            let jumps = self.jump(&mut instant, here)?;
            if self.made.stopped_by.is_some() && !jumps {
                return Ok(());
            }
            instant.fired = instant.fired.or_else(|| if instant.jumped { None } else { self.touches(&instant) });
            match instant.fired {
                Some(fired) => self.count(value(last.t), fired)?,
                None if goes_on || stopped_there => {}
                None => return Ok(()),
            }
        }
    }

    /// Brings the state over an instant: impacts and modes, events of the user over whose zeros an impact has led, and
    /// again where one of them makes the state jump.
    fn decide(&mut self, instant: &mut Instant<'k, K>) -> Result<(), ContactError> {
        if !E::ANY {
            return instant.decide(&mut self.scales, &mut self.made);
        }
        loop {
            let (first, z) = (instant.first, instant.z);
            instant.decide(&mut self.scales, &mut self.made)?;
            let mut passed = Vec::new();
            if !first {
                let Self { events, made, .. } = self;
                let mut record = Record::of(&mut made.passages, &mut made.state_jumps, &mut made.stopped_by);
                let after = instant.sample();
                passed = record.led_over(events, (&Sample { z, ..after }, &after), &[]);
                self.ends_where_stopped(instant.t);
            }
            if !self.jump(instant, passed)? {
                return Ok(());
            }
        }
    }

    /// The jumps of events of the user at an instant; whether there are any.
    fn jump(&mut self, instant: &mut Instant<'k, K>, here: Vec<usize>) -> Result<bool, ContactError> {
        if here.is_empty() {
            return Ok(false);
        }
        let Self { kernel, events, jumps, made, .. } = self;
        let record = Record::of(&mut made.passages, &mut made.state_jumps, &mut made.stopped_by);
        let input = |t: K::Scalar, q: &K::Configuration, z: &K::Speeds| (made.input)(t, q, z);
        let problem = SystemProblem::new(*kernel).input_from(Feedback(input));
        let Some((after, changed)) = jumps::all(events, &problem, (here, &instant.sample()), jumps, record)? else {
            return Ok(false);
        };
        if changed {
            instant.jump_to(&after, &self.scales, &mut self.made);
        }
        self.ends_where_stopped(instant.t);
        Ok(true)
    }

    /// Ends the run in the state after an event that ends it.
    fn ends_where_stopped(&mut self, t: K::Scalar) {
        self.end = if self.made.stopped_by.is_some() { t } else { self.end };
    }

    fn check_start(&self, t: K::Scalar, q: &K::Configuration, z: &K::Speeds) -> Result<(), ContactError> {
        if !(t.is_finite() && self.end.is_finite() && value(t) <= value(self.end)) {
            return Err(ContactError { contact: None, time: value(t), kind: ContactErrorKind::InvalidInterval });
        }
        crate::start::check(self.kernel, t, q, z)
    }

    /// Counts events that do not move the time.
    fn count(&mut self, t: f64, fired: Watched) -> Result<(), ContactError> {
        let stop =
            |kind| Err(ContactError { contact: Some(self.kernel.contacts()[fired.contact()].name), time: t, kind });
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
        let limit = self.settings.limit;
        if self.made.segments.len() >= limit {
            return stop(ContactErrorKind::TooManyEvents { limit });
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

    /// One segment, with what ended it, and the events of the user at its end.
    fn segment(&mut self, from: &Instant<'k, K>, until: K::Scalar) -> Result<(Stop, Vec<usize>), ContactError> {
        let system = InMode::with(self.kernel, &from.modes, self.least(from));
        let problem = InModeProblem::new(system.clone(), Rc::clone(&self.made.input), self.moving.clone());
        let witnesses = self.witnesses(from, &problem);
        let watched: Vec<Watched> = witnesses.iter().map(|witness| witness.watched).collect();
        let sampled = Rc::new(RefCell::new(Vec::new()));
        let functions = witnesses.into_iter().map(|witness| {
            let bound = GapBound::of(&witness, &sampled);
            (move |t: K::Scalar, q: &K::Configuration, z: &K::Speeds| witness.value(t, q, z), bound)
        });
        let users = self.events.count();
        let events = SegmentEvents::<K, E>::of(&mut self.events);
        let simulation = Simulation::of(problem).control(self.control.clone()).events_by(events);
        let simulation = simulation.every(self.settings.every);
        let mut simulation = simulation.until_each_bounded(Crossing::Falling, functions.collect());
        if let Some(limit) = self.settings.steps {
            simulation = simulation.max_steps(limit.saturating_sub(self.used));
        }
        let (trajectory, error) = simulation.attempt(from.q, from.z, from.t..until);
        let (last, end) = (*trajectory.last(), trajectory.last().t);
        self.used += trajectory.summary().steps + trajectory.summary().rejected;
        let passed = trajectory.events().iter().filter(|event| event.number < users);
        self.made.passages.extend(passed.clone().map(|event| Passage::of(event.number, &event.sample)));
        let moving = self.kernel.contacts().iter().enumerate().filter(|(_, contact)| contact.moves);
        let looked_at = moving.map(|(contact, _)| SampledGap { contact, start: value(from.t), end: value(end) });
        let bounded = |gap: &SampledGap| !self.kernel.contacts()[gap.contact].moves;
        let all: Vec<SampledGap> = sampled.borrow().iter().copied().filter(bounded).chain(looked_at).collect();
        self.made.keep_sampled(&all, value(end));
        let stopped = trajectory.stopped_by();
        let at_end = passed.filter(|event| stopped.is_some() && value(event.sample.t) == value(end));
        let here: Vec<usize> = at_end.map(|event| event.number).collect();
        self.made.stopped_by = self.made.stopped_by.or(jumps::first_end(&mut self.events, &here));
        self.made.segments.push(Segment { system, trajectory });
        if let Some(error) = error {
            let grazes = |event: usize, rate| ContactError {
                contact: Some(self.kernel.contacts()[watched[event].contact()].name),
                time: value(end),
                kind: ContactErrorKind::Grazes { rate },
            };
            let too_many = |limit| ContactError {
                contact: None,
                time: value(end),
                kind: ContactErrorKind::TooManySteps { limit },
            };
            return Err(match (error.kind, self.settings.steps) {
                (IntegrationErrorKind::NoDerivative { event, rate }, _) if event >= users => {
                    grazes(event - users, rate)
                }
                (IntegrationErrorKind::TooManySteps { .. }, Some(limit)) => too_many(limit),
                _ => integration(value(end), error),
            });
        }
        self.check_end(&from.modes, (end, &last.q, &last.z))?;
        Ok((stopped.and_then(|n| n.checked_sub(users)).map_or(Stop::End, |n| Stop::Contact(watched[n])), here))
    }

    /// The slips that have no direction of their own in a segment from here.
    fn least(&self, from: &Instant<'k, K>) -> Least {
        let Instant { t, q, z, modes, .. } = from;
        let system = InMode::new(self.kernel, modes);
        let mut grows = vec![0.0; K::ContactRows::DIM];
        if modes.iter().any(|mode| matches!(mode, Mode::Slides(_))) {
            let loads = system.loads(*t, q, z, &(self.made.input)(*t, q, z));
            grows = system.rounding_of_accelerations(&loads, (*t, q, z));
        }
        let rounding =
            from.sizes(&self.scales).of_rate.into_iter().zip(grows).map(|(at_start, grows)| [at_start, grows]);
        Least { rest: self.scales.rest(), rounding: rounding.collect(), start: value(*t) }
    }

    /// The event on which the end of a run falls to the resolution of its time: a gap that closes, a slip that ends.
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
        let mut each = self.kernel.contacts().iter().zip(&end.modes).enumerate();
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
        for (i, (contact, mode)) in self.kernel.contacts().iter().zip(modes).enumerate() {
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

    /// Watches for the end of a slip.
    fn watch_slip(&self, i: usize, of_rate: &[f64], watch: &mut AddWitness<'_>) {
        let rows = tangents(&self.kernel.contacts()[i]);
        let (several, rest) = (rows.len() > 1, self.scales.rest());
        let rounding = rows.map(|row| of_rate[row]).fold(0.0, f64::max);
        watch(Watched::Slip(i), &|slip| if slip.abs() <= rounding { -slip } else { 0.0 });
        // One that begins against its direction would be driven by its friction.
        let least = rounding.max(0.5 * rest);
        watch(Watched::Slip(i), &|slip| if slip <= least { least - slip.min(0.0) } else { 0.0 });
        if several {
            watch(Watched::Speed(i, rest), &|_| 0.0);
        }
    }

    /// Witnesses of the events that may end the segment from here.
    fn witnesses(&self, from: &Instant<'k, K>, problem: &InModeProblem<'k, K>) -> Vec<Witness<'k, K>> {
        let mut found = Vec::new();
        let gaps = self.kernel.gaps(from.t, &from.q);
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
        // Contacts that depend on one another hold as long as any of their forces do.
        let input = (self.made.input)(from.t, &from.q, &from.z);
        let shared = problem.system.reserve((from.t, &q, &z), &input).is_some();
        if let Some(first) = from.modes.iter().position(Mode::is_closed).filter(|_| shared) {
            watch(Watched::Reserve(first), &|part| (LEAST_RESERVE - part).max(0.0));
        }
        for (i, contact) in self.kernel.contacts().iter().enumerate() {
            // Forces that are no more than rounding start above zero by as much.
            let least = loads.as_ref().map_or(0.0, |loads| loads.rounding(contact).max(f64::MIN_POSITIVE));
            let above = move |value: f64| if value > least { 0.0 } else { least - value };
            match from.modes[i] {
                Mode::Open if !contact.has_gap() => {}
                Mode::Open => {
                    // What others have pushed below zero, as they came to rest, starts from there: it would never fall
                    // to zero.
                    let opens = value(sizes.rates.component(contact.normal)) > sizes.of_rate[contact.normal];
                    let start = if opens { 0.0 } else { sizes.rounding[i] };
                    watch(Watched::Gap(i), &|gap| if gap <= sizes.of_gap[i] { start - gap } else { 0.0 });
                    // A flight that is lower than rounding is not seen to end: what sinks by more is.
                    if value(gaps.component(i)) <= sizes.of_gap[i] {
                        let deep = (DEEP * sizes.of_gap[i]).max(f64::MIN_POSITIVE);
                        watch(Watched::Gap(i), &|gap| deep - gap.min(0.0));
                    }
                }
                Mode::Closed | Mode::Sticks if shared => {}
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
                    self.watch_slip(i, &sizes.of_rate, &mut watch);
                    if contact.has_gap() {
                        watch(Watched::Pushes(i), &|_| 0.0);
                    }
                }
            }
        }
        found
    }
}
