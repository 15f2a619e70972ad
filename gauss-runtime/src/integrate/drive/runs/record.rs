//! Runs that were made, as tables, plots, pages and studies read them.

use alloc::vec::Vec;

use crate::configuration::{Configuration, VectorSpace};
use crate::integrate::drive::trajectory::Trajectory;
use crate::integrate::problem::error::IntegrationError;
use crate::integrate::problem::state::Sample;
use crate::real::Real;
use crate::system::GaussSystem;

/// The record of a run: its states in order, and those between them. Tables (`gauss-tables`), pages (`gauss-playback`)
/// and other readers take any of them: a [`Trajectory`], and runs with contacts of the crate `gauss-contact`, from
/// event to event and in steps alike.
pub trait RunRecord<S: GaussSystem> {
    /// The error for a state that cannot be found.
    type Error: core::error::Error + 'static;

    /// The states that the run has kept, in order: two at a time where the state jumps.
    fn states(&self) -> Vec<Sample<S>>;

    /// The first and the last time; `None` where the run ended before its first state.
    fn span(&self) -> Option<(S::Scalar, S::Scalar)>;

    /// The state at a time; where the state jumps, the one after it.
    ///
    /// # Errors
    /// Where the run does not cover the time, or the state there cannot be made.
    fn state_at(&self, t: S::Scalar) -> Result<Sample<S>, Self::Error>;

    /// The times at which the state, or a force at a contact, jumps, in order: what is drawn is not to go straight on
    /// from before them to after them. Times of lanes are those of the first.
    fn jumps(&self) -> Vec<f64>;

    /// States for pictures and tables: at `count` times equally far apart, at least two, and before and after each
    /// [jump](Self::jumps). Of jumps that pile up no more are shown than are a tenth of these times apart.
    ///
    /// # Errors
    /// That of [`state_at`](Self::state_at).
    fn sampled(&self, count: usize) -> Result<Vec<Sample<S>>, Self::Error> {
        let Some((first, last)) = self.span() else {
            return self.state_at(S::Scalar::zero()).map(|state| [state].into());
        };
        let gaps = count.max(2) - 1;
        let (begin, end) = (first.lane(0), last.lane(0));
        // The last time is that of the run itself: rounding must not leave it.
        let time = |n: usize| if n == gaps { end } else { begin + (end - begin) * n as f64 / gaps as f64 };
        let mut times: Vec<f64> = (0..=gaps).map(time).collect();
        let (least, forward) = ((end - begin).abs() / (10 * gaps) as f64, end >= begin);
        let mut shown = None::<f64>;
        for jump in self.jumps().into_iter().filter(|jump| *jump != begin) {
            if shown.is_none_or(|last| (jump - last).abs() > least) {
                shown = Some(jump);
                times.extend([if forward { jump.next_down() } else { jump.next_up() }, jump]);
            }
        }
        times.sort_by(|a, b| if forward { a.total_cmp(b) } else { b.total_cmp(a) });
        times.dedup();
        times.into_iter().map(|t| self.state_at(S::Scalar::from_f64(t))).collect()
    }
}

impl<S: GaussSystem> RunRecord<S> for Trajectory<'_, S> {
    type Error = IntegrationError;

    fn states(&self) -> Vec<Sample<S>> {
        self.samples().to_vec()
    }

    fn span(&self) -> Option<(S::Scalar, S::Scalar)> {
        Some((self.first().t, self.last().t))
    }

    fn state_at(&self, t: S::Scalar) -> Result<Sample<S>, IntegrationError> {
        self.at(t)
    }

    fn jumps(&self) -> Vec<f64> {
        let differ = |[a, b]: &[Sample<S>; 2]| {
            let speeds = (0..S::Speeds::DIM).any(|i| a.z.component(i).lane(0) != b.z.component(i).lane(0));
            let [p, q] = [a, b].map(|sample| sample.q.components());
            speeds
                || (0..<<S::Configuration as Configuration>::Components as VectorSpace<S::Scalar>>::DIM)
                    .any(|i| p.component(i).lane(0) != q.component(i).lane(0))
        };
        let pairs = self.samples().windows(2).filter_map(|pair| <&[Sample<S>; 2]>::try_from(pair).ok());
        pairs
            .filter(|pair| pair[0].t.lane(0) == pair[1].t.lane(0) && differ(pair))
            .map(|pair| pair[0].t.lane(0))
            .collect()
    }
}
