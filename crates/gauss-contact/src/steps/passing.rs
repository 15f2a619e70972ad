//! Functions of the user that pass through zero within a step.

use alloc::vec::Vec;

use gauss_runtime::contact::ContactSystem;
use gauss_runtime::integrate::Sample;
use gauss_runtime::integrate::drive::event::Events;

use crate::error::{ContactError, ContactErrorKind};
use crate::history::Passage;
use crate::mode::InMode;

use super::made::{SteppedRun, between};

/// Halvings of a step: as many as a time has digits.
const HALVINGS: u32 = 52;

/// Looks for events in the last step of a run, in the states that the step has between its ends. Where one ends the run
/// the last state is that of the event; whether it does. What passes there and back within a step is not seen.
pub(super) fn look<'k, K, E>(events: &mut E, made: &mut SteppedRun<'k, K>) -> Result<bool, ContactError>
where
    K: ContactSystem<Scalar = f64>,
    E: Events<InMode<'k, K>>,
{
    if !E::ANY {
        return Ok(false);
    }
    let Some((last, earlier)) = made.samples.split_last() else { return Ok(false) };
    let before = earlier.last().map_or(made.start, |step| step.state);
    let (mut found, mut number, mut defined) = (Vec::<(Passage<K>, bool)>::new(), 0, true);
    events.each(&mut |function, mark| {
        let at = |state: &Sample<K>| function(state.t, &state.q, &state.z);
        let (start, end) = (at(&before), at(&last.state));
        defined &= !start.is_nan() && !end.is_nan();
        if mark.passes(start, end) {
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
            found.push((Passage { number, sample: beyond }, mark.ends_the_run()));
        }
        number += 1;
    });
    if !defined {
        return Err(ContactError { contact: None, time: last.state.t, kind: ContactErrorKind::NonFinite });
    }
    found.sort_by(|(a, _), (b, _)| a.sample.t.total_cmp(&b.sample.t));
    for (passage, ends) in found {
        made.passages.push(passage);
        if ends {
            made.stopped_by = Some(passage.number);
            if let Some(last) = made.samples.last_mut() {
                last.state = passage.sample;
            }
            return Ok(true);
        }
    }
    Ok(false)
}
