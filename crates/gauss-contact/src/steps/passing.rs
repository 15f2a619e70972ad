//! Functions of the user that pass through zero within a step, and jumps of the state there.
//!
//! A passage is found in the states that a step has between its ends. Where the state jumps the step is made again,
//! shorter and shorter or longer, until it ends at the zero: what jumps is a state that steps reach, with gaps closed
//! and rates of what rests zero. The next step begins there, as that of a run does.

use alloc::vec::Vec;

use gauss_runtime::contact::ContactSystem;
use gauss_runtime::integrate::drive::event::{Events, is_of_the_configuration, rounding};
use gauss_runtime::integrate::drive::run::Jumps;
use gauss_runtime::integrate::problem::state::State;
use gauss_runtime::integrate::{IntegrationErrorKind, Problem, Sample};

use crate::error::{ContactError, ContactErrorKind};
use crate::history::Passage;
use crate::jumps::{self, Record};

use super::made::{StepSample, SteppedRun, between};

/// Halvings of a step: as many as a time has digits.
const HALVINGS: u32 = 52;
/// Roundings of a time to which a step ends at a zero.
const ROUNDINGS: f64 = 4.0;
/// The most steps that are made to find one.
const TRIALS: u32 = 200;

/// A function that is on zero, after the jump of its event.
struct ZeroDeparture {
    number: usize,
    /// Values below are zero.
    rounding: f64,
    /// A value on the side that it came from, and its rate, where the jump has to lead it back.
    back: Option<(f64, f64)>,
}

/// The events of a run in steps, as they follow each other.
pub(super) struct EventWatch {
    jumps: Jumps,
    leaving: Vec<ZeroDeparture>,
    /// After a step that ended on the wrong side of zero: the event, and the mean rate of its function.
    wrong: Option<(usize, f64)>,
}

/// An event in a step.
struct StepEvent<K: ContactSystem<Scalar = f64>> {
    passage: Passage<K>,
    ends: bool,
    jumps: bool,
}

/// All that is seen in a step.
struct StepEvents<K: ContactSystem<Scalar = f64>> {
    /// The events, in order of time.
    found: Vec<StepEvent<K>>,
    /// Functions that have left zero.
    left: Vec<usize>,
    /// A function that has not been led back at the end of the step, with its mean rate.
    wrong: Option<(usize, f64)>,
    /// Functions that have not left it.
    stays: Vec<usize>,
}

/// Consequences of the events of a step.
pub(super) enum EventOutcome {
    /// The run goes on.
    On,
    /// It has ended there.
    Ended,
    /// The step is to end at an event that makes the state jump: its number, and about when.
    Jumps(usize, f64),
    /// After a jump the step is too long to show where it leads.
    TooLong,
    /// The jump does not lead back.
    Fails(IntegrationErrorKind),
}

/// The value of one event at a state.
fn value_of<K: ContactSystem<Scalar = f64>, E: Events<K>>(events: &mut E, event: usize, state: &Sample<K>) -> f64 {
    let (mut number, mut value) = (0, f64::NAN);
    events.each(&mut |function, _| {
        value = if number == event { function(state.t, &state.q, &state.z) } else { value };
        number += 1;
    });
    value
}

impl EventWatch {
    /// Before a run.
    pub(super) fn new(start: f64, end: f64) -> Self {
        Self { jumps: Jumps::new::<f64>(start, end), leaving: Vec::new(), wrong: None }
    }

    /// Looks for events in the last step of a run, in the states that the step has between its ends. Where one ends the
    /// run the last state is that of the event. What passes there and back within a step is not seen.
    pub(super) fn look<K: ContactSystem<Scalar = f64>, E: Events<K>>(
        &mut self,
        events: &mut E,
        made: &mut SteppedRun<'_, K>,
    ) -> Result<EventOutcome, ContactError> {
        if !E::ANY {
            return Ok(EventOutcome::On);
        }
        let seen = self.seen(events, made)?;
        match (core::mem::replace(&mut self.wrong, seen.wrong), seen.wrong) {
            // In a shorter step a flight that is too short for both goes on at a lesser rate.
            (Some((before, rate)), Some((event, after))) if before == event && after.abs() > 0.5 * rate.abs() => {
                return Ok(EventOutcome::Fails(self.goes_on(event, after)));
            }
            (_, Some(_)) => return Ok(EventOutcome::TooLong),
            (Some((event, _)), None) if seen.stays.contains(&event) => {
                let interval = made.last_state().t - made.before(made.samples.len() - 1).t;
                return Ok(EventOutcome::Fails(IntegrationErrorKind::Zeno { event, interval }));
            }
            (_, None) => {}
        }
        let first = seen.found.iter().find(|found| found.jumps || found.ends);
        if let Some(StepEvent { passage, jumps: true, .. }) = first {
            return Ok(EventOutcome::Jumps(passage.number, passage.sample.t));
        }
        self.leaving.retain(|leaving| !seen.left.contains(&leaving.number));
        for StepEvent { passage, ends, .. } in seen.found {
            made.passages.push(passage);
            if ends {
                made.stopped_by = Some(passage.number);
                if let Some(last) = made.samples.last_mut() {
                    last.state = passage.sample;
                }
                return Ok(EventOutcome::Ended);
            }
        }
        Ok(EventOutcome::On)
    }

    /// A jump that lets its function go on.
    fn goes_on(&self, event: usize, after: f64) -> IntegrationErrorKind {
        let back = self.leaving.iter().find(|leaving| leaving.number == event).and_then(|leaving| leaving.back);
        IntegrationErrorKind::NotTurnedBack { event, before: back.map_or(0.0, |(_, rate)| rate), after }
    }

    /// Makes the last step again, by `step`, so that it ends at the zero of an event that was seen in it, and lets the
    /// state jump there; whether the run ends with that.
    pub(super) fn jump<K: ContactSystem<Scalar = f64>, P: Problem<System = K>, E: Events<K>>(
        &mut self,
        (events, problem): (&mut E, &P),
        made: &mut SteppedRun<'_, K>,
        mut first: (usize, f64),
        step: &mut dyn FnMut(f64) -> Result<StepSample<K>, ContactError>,
    ) -> Result<bool, ContactError> {
        let Some(mut last) = made.samples.pop() else { return Ok(false) };
        let (before, passed) = (made.last_state(), last.state);
        loop {
            last = Self::at_zero(events, first, (&before, last), step)?;
            made.samples.push(last.clone());
            // What the states in between have in another order.
            let earlier = self.seen(events, made)?.found.into_iter().find(|found| found.jumps || found.ends);
            match earlier {
                Some(StepEvent { passage, jumps: true, .. })
                    if passage.number != first.0 && passage.sample.t < last.state.t - resolution(&last.state) =>
                {
                    made.samples.pop();
                    first = (passage.number, passage.sample.t);
                }
                _ => break,
            }
        }
        self.happen((events, problem), made, [&before, &passed])
    }

    /// The events in a step that ends at a jump, with the states before it and where it would have ended; whether one
    /// of them ends the run.
    fn happen<K: ContactSystem<Scalar = f64>, P: Problem<System = K>, E: Events<K>>(
        &mut self,
        (events, problem): (&mut E, &P),
        made: &mut SteppedRun<'_, K>,
        [before, passed]: [&Sample<K>; 2],
    ) -> Result<bool, ContactError> {
        let Some(last) = made.samples.last().cloned() else { return Ok(false) };
        let end = last.state;
        let mut here = Vec::new();
        let StepEvents { found, stays, .. } = self.seen(events, made)?;
        for StepEvent { passage, ends, jumps } in found {
            let at_end = jumps || passage.sample.t >= end.t - resolution(&end);
            let passage = if at_end { Passage { sample: end, ..passage } } else { passage };
            made.passages.push(passage);
            if at_end {
                here.push(passage.number);
            } else if ends {
                made.stopped_by = Some(passage.number);
                if let Some(last) = made.samples.last_mut() {
                    last.state = passage.sample;
                }
                return Ok(true);
            }
        }
        here.sort_unstable();
        let record = Record::of(&mut made.passages, &mut made.state_jumps, &mut made.stopped_by);
        let jumped = jumps::all(events, problem, (here.clone(), &end), &mut self.jumps, record)?;
        self.leaving.retain(|leaving| stays.contains(&leaving.number));
        if let Some((after, changed)) = jumped {
            made.samples.push(StepSample::jumped(after, last.modes));
            self.leave((events, problem), (&here, changed), [before, passed, &after]);
        }
        Ok(made.stopped_by.is_some())
    }

    /// Remembers which functions are on zero after jumps, with the states before the step, where it would
    /// have ended, and after the jumps.
    fn leave<K: ContactSystem<Scalar = f64>, P: Problem<System = K>, E: Events<K>>(
        &mut self,
        (events, problem): (&mut E, &P),
        (here, changed): (&[usize], bool),
        [before, passed, after]: [&Sample<K>; 3],
    ) {
        let (mut number, leaving) = (0, &mut self.leaving);
        let state = State { t: after.t, q: after.q, y: problem.variables(after.t, &after.q, &after.z) };
        events.each(&mut |function, mark| {
            let value = |state: &Sample<K>| function(state.t, &state.q, &state.z);
            let [start, end, now] = [before, passed, after].map(value);
            // Zeros are found to some roundings of the time, by which the function is beyond.
            let rate = (end - start) / (passed.t - before.t);
            let rounding = rounding(problem, function, 0, &state) + 4.0 * resolution(after) * rate.abs();
            if here.contains(&number) && now.abs() <= rounding {
                // What no velocity turns back, such as the time, is not meant to be.
                let leads_back = mark.jumps() && changed && !mark.may_go_on();
                let leads_back = leads_back && is_of_the_configuration(problem, function, 0, &state);
                leaving.push(ZeroDeparture { number, rounding, back: leads_back.then_some((start, rate)) });
            }
            number += 1;
        });
    }

    /// Finds the events of the last step.
    fn seen<K: ContactSystem<Scalar = f64>, E: Events<K>>(
        &self,
        events: &mut E,
        made: &SteppedRun<'_, K>,
    ) -> Result<StepEvents<K>, ContactError> {
        let mut seen = StepEvents { found: Vec::new(), left: Vec::new(), wrong: None, stays: Vec::new() };
        let Some((last, earlier)) = made.samples.split_last() else { return Ok(seen) };
        let before = earlier.last().map_or(made.start, |step| step.state);
        let (mut number, mut defined) = (0, true);
        events.each(&mut |function, mark| {
            let at = |state: &Sample<K>| function(state.t, &state.q, &state.z);
            let (start, end) = (at(&before), at(&last.state));
            defined &= !start.is_nan() && !end.is_nan();
            match self.leaving.iter().find(|leaving| leaving.number == number) {
                Some(ZeroDeparture { rounding, .. }) if end.abs() <= *rounding => seen.stays.push(number),
                Some(ZeroDeparture { back, .. }) => {
                    if back.is_some_and(|(side, _)| (side < 0.0) != (end < 0.0)) {
                        seen.wrong = seen.wrong.or(Some((number, end / (last.state.t - before.t))));
                    }
                    seen.left.push(number);
                }
                None if mark.passes(start, end) => {
                    // The later end of what is halved is beyond zero, or on it.
                    let (mut low, mut beyond) = (before.t, last.state);
                    for _ in 0..HALVINGS {
                        let middle = between(made.kernel, &before, last, low + 0.5 * (beyond.t - low));
                        if mark.passes(start, at(&middle)) {
                            beyond = middle;
                        } else {
                            low = middle.t;
                        }
                    }
                    let (ends, jumps) = (mark.ends_the_run(), mark.jumps());
                    seen.found.push(StepEvent { passage: Passage { number, sample: beyond }, ends, jumps });
                }
                None => {}
            }
            number += 1;
        });
        if !defined {
            return Err(ContactError { contact: None, time: last.state.t, kind: ContactErrorKind::NonFinite });
        }
        seen.found.sort_by(|a, b| a.passage.sample.t.total_cmp(&b.passage.sample.t));
        Ok(seen)
    }

    /// The step that ends where an event has its zero, or beyond it by a rounding of the time, between steps of no
    /// length and the one that has passed it; about when it is, is known.
    fn at_zero<K: ContactSystem<Scalar = f64>, E: Events<K>>(
        events: &mut E,
        (number, near): (usize, f64),
        (before, passed): (&Sample<K>, StepSample<K>),
        step: &mut dyn FnMut(f64) -> Result<StepSample<K>, ContactError>,
    ) -> Result<StepSample<K>, ContactError> {
        let least = resolution(&passed.state);
        let start = value_of(events, number, before);
        let (mut low, mut high) = ((0.0, start), (passed.state.t - before.t, value_of(events, number, &passed.state)));
        let (mut guess, mut found) = (near - before.t, passed);
        for trial in 0..TRIALS {
            if high.0 - low.0 <= 2.0 * least || high.1 == 0.0 {
                break;
            }
            let middle = low.0 + 0.5 * (high.0 - low.0);
            // Every third step halves what is left, so that no function takes more than some hundred.
            let halves = trial % 3 == 2 || !guess.is_finite();
            let length = if halves { middle } else { guess.clamp(low.0 + least, high.0 - least) };
            let made = step(length)?;
            let value = value_of(events, number, &made.state);
            if value.is_nan() {
                return Err(ContactError { contact: None, time: made.state.t, kind: ContactErrorKind::NonFinite });
            }
            if value == 0.0 || (value < 0.0) != (start < 0.0) {
                (high, found) = ((length, value), made);
            } else {
                low = (length, value);
            }
            guess = low.0 + (high.0 - low.0) * (low.1 / (low.1 - high.1));
        }
        Ok(found)
    }
}

/// Times nearer than this are the same.
fn resolution<K: ContactSystem<Scalar = f64>>(at: &Sample<K>) -> f64 {
    ROUNDINGS * f64::EPSILON * at.t.abs().max(f64::MIN_POSITIVE)
}
