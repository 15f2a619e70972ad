//! Controllers that sample in runs with contacts: each instant ends a step, or a segment of a run from event to event.

use alloc::rc::Rc;
use alloc::vec::Vec;
use core::cell::{Cell, RefCell};

use gauss_runtime::contact::ContactSystem;
use gauss_runtime::integrate::drive::event::Events;
use gauss_runtime::integrate::drive::interval;
use gauss_runtime::integrate::{InputSource, IntegrationErrorKind, Sample};
use gauss_runtime::real::Real;

use crate::dense::value;
use crate::error::{ContactError, ContactErrorKind};
use crate::trajectory::InputOf;

fn error<T: Real>(t: T, kind: IntegrationErrorKind) -> ContactError {
    ContactError { contact: None, time: value(t), kind: ContactErrorKind::Sampling(kind) }
}

/// Checks controllers before a run.
///
/// # Errors
/// The errors of [`interval::begin`].
pub(crate) fn begin<K: ContactSystem, E: Events<K>>(
    events: &mut E,
    holds: bool,
    (start, end): (K::Scalar, K::Scalar),
    limit: Option<u64>,
) -> Result<(), ContactError> {
    if !E::SAMPLED {
        return Ok(());
    }
    let most = limit.unwrap_or(u64::MAX);
    interval::begin(events, holds, (start, end), most).map_err(|kind| error(start, kind))
}

/// Lets controllers sample a state; until when they hold what they give, and what that is.
///
/// # Errors
/// An input that is not finite.
pub(crate) fn tick<K: ContactSystem, E: Events<K>>(
    events: &mut E,
    kernel: &K,
    (t, q, z): (K::Scalar, &K::Configuration, &K::Speeds),
    (cell, end): (Option<&Cell<K::Input>>, K::Scalar),
) -> Result<(K::Scalar, Option<K::Input>), ContactError> {
    if !E::SAMPLED {
        return Ok((end, None));
    }
    let now = Sample { t, q: *q, z: *z, p: kernel.momentum(t, q, z) };
    let (held, until) = interval::tick(events, &now, cell, end).map_err(|kind| error(t, kind))?;
    Ok((until, held))
}

/// Inputs that controllers have held, each from a time on: a run asks for those of times that it has left.
pub(crate) type Holds<K> = Rc<RefCell<Vec<(f64, <K as gauss_runtime::system::GaussSystem>::Input)>>>;

/// The input of a run as a function of time and state, with what controllers held then.
pub(crate) fn with_holds<'k, K: ContactSystem + 'k, I: InputSource<K> + 'k>(
    input: I,
) -> (InputOf<'k, K>, Option<Holds<K>>) {
    if input.held().is_none() {
        return (Rc::new(move |t, q, z| input.input(t, q, z)), None);
    }
    let holds: Holds<K> = Rc::new(RefCell::new(Vec::new()));
    let known = Rc::clone(&holds);
    let of_time = move |t: K::Scalar, q: &K::Configuration, z: &K::Speeds| {
        let holds = known.borrow();
        let later = holds.partition_point(|(from, _)| *from <= value(t));
        if let (Some(cell), Some((_, held))) = (input.held(), holds.get(later.saturating_sub(1))) {
            cell.set(*held);
        }
        input.input(t, q, z)
    };
    (Rc::new(of_time), Some(holds))
}
