//! Rates at which gaps change with the time alone: walls and grounds that move as the scene says.

use alloc::rc::Rc;
use alloc::vec;
use core::ops::Range;

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::real::Real;

use crate::dense::value;

/// Gaps are looked at so often in a run; so often where the scene does not say that one depends on the time.
const LOOKS: u32 = 4096;
const FEW: u32 = 64;

/// Between two looks they may change faster by this factor.
const BETWEEN: f64 = 2.0;

/// The largest rate of each gap in a run where nothing moves but what the time moves, by looks.
#[derive(Clone, Debug)]
pub(crate) struct MovingGaps {
    pub(crate) rates: Rc<[f64]>,
    /// The time between two looks.
    pub(crate) look: f64,
}

impl MovingGaps {
    pub(crate) fn of<K: ContactSystem>(kernel: &K, q: &K::Configuration, interval: &Range<K::Scalar>) -> Self {
        let (start, span) = (value(interval.start), value(interval.end) - value(interval.start));
        let mut fastest = vec![0.0_f64; kernel.contacts().len()];
        if !(span.is_finite() && span > 0.0) {
            return Self { rates: fastest.into(), look: f64::INFINITY };
        }
        let looks = if kernel.contacts().iter().any(|contact| contact.moves) { LOOKS } else { FEW };
        let step = span / f64::from(looks);
        let mut before = kernel.gaps(interval.start, q);
        for look in 1..=looks {
            let now = kernel.gaps(K::Scalar::from_f64(step.fma(f64::from(look), start)), q);
            for (i, fastest) in fastest.iter_mut().enumerate() {
                let change = value(now.component(i) - before.component(i)).abs();
                *fastest = if change.is_finite() { fastest.max(BETWEEN * change / step) } else { *fastest };
            }
            before = now;
        }
        Self { rates: fastest.into(), look: step }
    }
}
