//! Conditions on the state in which a motion with contacts starts.

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::contact::ContactSystem;

use crate::dense::value;
use crate::error::{ContactError, ContactErrorKind};
use crate::rounding::Rounding;

/// Refuses states that are not finite, gaps that are negative by more than rounding, and restitution beyond [0, 1].
pub(crate) fn check<K: ContactSystem>(
    kernel: &K,
    t: K::Scalar,
    q: &K::Configuration,
    z: &K::Speeds,
) -> Result<(), ContactError> {
    if !(q.is_finite() && z.is_finite()) {
        return Err(ContactError { contact: None, time: value(t), kind: ContactErrorKind::NonFinite });
    }
    check_contacts(kernel, t, q, |q| Rounding::of::<K>(q).half_of_the_digits())
}

/// The same of the contacts alone, with how far a gap may be below zero.
pub(crate) fn check_contacts<K: ContactSystem>(
    kernel: &K,
    t: K::Scalar,
    q: &K::Configuration,
    allowed: impl Fn(&K::Configuration) -> f64,
) -> Result<(), ContactError> {
    let stop = |contact: Option<usize>, kind| {
        Err(ContactError { contact: contact.map(|i: usize| kernel.contacts()[i].name), time: value(t), kind })
    };
    let (gaps, restitution) = (kernel.gaps(t, q), kernel.restitution());
    for i in 0..kernel.contacts().len() {
        let (gap, e) = (value(gaps.component(i)), value(restitution.component(i)));
        if !(0.0..=1.0).contains(&e) {
            return stop(Some(i), ContactErrorKind::InvalidRestitution { restitution: e });
        }
        if !gap.is_finite() {
            return stop(Some(i), ContactErrorKind::NonFinite);
        }
        if gap < -allowed(q) {
            return stop(Some(i), ContactErrorKind::NegativeGap { gap });
        }
    }
    Ok(())
}
