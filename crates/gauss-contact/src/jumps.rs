//! Jumps of the state by events of the user.

use alloc::vec::Vec;

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::integrate::drive::event::{self, Events};
use gauss_runtime::integrate::drive::run::Jumps;
use gauss_runtime::integrate::problem::state::State;
use gauss_runtime::integrate::{IntegrationError, IntegrationErrorKind, Problem, Sample};

use crate::decide::{Instant, Scales};
use crate::dense::value;
use crate::error::{ContactError, ContactErrorKind};
use crate::history::{ContactEvent, EventKind, Passage, StateJump};
use crate::mode::Mode;
use crate::trajectory::{ContactTrajectory, integration};
use crate::witness::Watched;

/// Error of a jump in a state.
pub(crate) fn error<K: ContactSystem, P: Problem<System = K>>(
    problem: &P,
    at: &Sample<K>,
    kind: IntegrationErrorKind,
) -> ContactError {
    let state = State { t: at.t, q: at.q, y: problem.variables(at.t, &at.q, &at.z) };
    integration(value(at.t), IntegrationError::at(problem, &state, kind))
}

impl<K: ContactSystem> Instant<'_, K> {
    pub(crate) fn sample(&self) -> Sample<K> {
        let Self { kernel, t, q, z, .. } = *self;
        Sample { t, q, z, p: kernel.momentum(t, &q, &z) }
    }

    /// Takes the state after a jump, of which contacts decide anew what they do: those whose gaps it opens are open.
    pub(crate) fn jump_to(&mut self, after: &Sample<K>, scales: &Scales, made: &mut ContactTrajectory<'_, K>) {
        let rounding = self.sizes(scales).rounding;
        let [before, now] = [&self.q, &after.q].map(|q| self.kernel.gaps(self.t, q));
        let moved = |i: usize| (value(now.component(i)) - value(before.component(i))).abs() > 2.0 * rounding[i];
        for (i, contact) in self.kernel.contacts().iter().enumerate() {
            if contact.has_gap() && moved(i) && self.modes[i].is_closed() {
                self.modes[i] = Mode::Open;
                let (time, name) = (value(self.t), contact.name);
                made.events.push(ContactEvent { time, contact: i, name, kind: EventKind::Leaves });
            }
        }
        self.fired = self.fired.filter(|fired| matches!(fired, Watched::Gap(i) if !moved(*i)));
        (self.q, self.z, self.jumped) = (after.q, after.z, true);
    }
}

/// The state after the jump of an event, and whether it is another one; none where the event has no jump.
///
/// # Errors
/// Those of [`event::jump`]; a gap that it leaves below zero.
fn jump<K: ContactSystem, P: Problem<System = K>, E: Events<K>>(
    events: &mut E,
    problem: &P,
    number: usize,
    before: &Sample<K>,
) -> Result<Option<(Sample<K>, bool)>, ContactError> {
    let jumped = event::jump(events, problem, (number, before), &(0..1));
    let Some(((q, z), changed)) = jumped.map_err(|kind| error(problem, before, kind))? else { return Ok(None) };
    let (kernel, t) = (problem.system(), before.t);
    crate::start::check(kernel, t, &q, &z).map_err(|cause| match cause.kind {
        ContactErrorKind::NegativeGap { gap } => {
            ContactError { kind: ContactErrorKind::JumpPenetrates { event: number, gap }, ..cause }
        }
        _ => cause,
    })?;
    Ok(Some((Sample { t, q, z, p: kernel.momentum(t, &q, &z) }, changed)))
}

/// Notes that the run has made the jump of an event: its function has to be led back.
fn note<K: ContactSystem, E: Events<K>>(events: &mut E, jumped: usize) {
    let mut number = 0;
    events.each(&mut |_, mark| {
        if number == jumped {
            mark.note_jump();
        }
        number += 1;
    });
}

/// Places in which a run keeps what happens at its events.
pub(crate) struct Record<'a, K: ContactSystem> {
    passages: &'a mut Vec<Passage<K>>,
    jumps: &'a mut Vec<StateJump<K>>,
    stopped_by: &'a mut Option<usize>,
}

impl<'a, K: ContactSystem> Record<'a, K> {
    pub(crate) fn of(
        passages: &'a mut Vec<Passage<K>>,
        jumps: &'a mut Vec<StateJump<K>>,
        stopped_by: &'a mut Option<usize>,
    ) -> Self {
        Self { passages, jumps, stopped_by }
    }

    /// The events, but these, over whose zeros an impact or a jump has led.
    pub(crate) fn led_over<E: Events<K>>(
        &mut self,
        events: &mut E,
        (before, after): (&Sample<K>, &Sample<K>),
        but: &[usize],
    ) -> Vec<usize> {
        let (mut passed, mut number) = (Vec::new(), 0);
        events.each(&mut |function, mark| {
            let at = |state: &Sample<K>| value(function(state.t, &state.q, &state.z));
            if !but.contains(&number) && mark.passes(at(before), at(after)) {
                passed.push(number);
            }
            number += 1;
        });
        self.passages.extend(passed.iter().map(|&number| Passage { number, sample: *after }));
        *self.stopped_by = self.stopped_by.or(first_end(events, &passed));
        passed
    }
}

/// The jumps of some events in a state, in their order, and of those over whose zeros they lead: the state after them
/// all, and whether it is another one; none where none of the events has a jump.
///
/// # Errors
/// Those of [`event::jump`]; a gap that a jump leaves below zero; jumps that pile up.
pub(crate) fn all<K: ContactSystem, P: Problem<System = K>, E: Events<K>>(
    events: &mut E,
    problem: &P,
    (mut here, start): (Vec<usize>, &Sample<K>),
    jumps: &mut Jumps,
    mut record: Record<'_, K>,
) -> Result<Option<(Sample<K>, bool)>, ContactError> {
    let (mut now, mut found, mut next) = (*start, None, 0);
    while let Some(&number) = here.get(next) {
        next += 1;
        let Some((after, changed)) = jump(events, problem, number, &now)? else { continue };
        if found.is_none() {
            jumps.count(value(now.t), number).map_err(|kind| error(problem, &now, kind))?;
        }
        record.jumps.push(StateJump { number, before: now, after });
        if changed {
            note(events, number);
        }
        here.extend(record.led_over(events, (&now, &after), &here));
        (now, found) = (after, Some(changed || found == Some(true)));
    }
    if found.is_some() {
        *record.stopped_by = record.stopped_by.or(first_end(events, &here));
    }
    Ok(found.map(|changed| (now, changed)))
}

/// The first of some events that ends the run.
pub(crate) fn first_end<K: ContactSystem, E: Events<K>>(events: &mut E, among: &[usize]) -> Option<usize> {
    let mut ends = Vec::new();
    events.each(&mut |_, mark| ends.push(mark.ends_the_run()));
    among.iter().copied().find(|&event| ends.get(event) == Some(&true))
}
