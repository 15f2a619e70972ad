//! Errors of steps in units of what is tolerated, and what rounding alone does to them.
//!
//! **Rounding.** Stages of a step are rounded, so derivatives are evaluated at states that are off by about ε of their sizes: an
//! error estimate, which is h times a sum of derivatives, never falls below h times what that changes. Where a tolerance asks for
//! less, shorter steps do not help: the estimate falls with h alone, and steps that follow it become shorter by orders of
//! magnitude without being any better. So when a step is rejected, or steps have become half as long, the derivatives are evaluated
//! at states that differ by ε, and what they differ by is tolerated in each component, h·δ with a factor, if that is more than what
//! was asked for. Where it is less it changes nothing, to the last bit. A kink or a jump is no rounding: it is not within ε of the state.

use crate::configuration::{Configuration, VectorSpace};
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::state::{Rates, State, TangentOf};
use crate::real::Real;
use crate::system::GaussSystem;

/// The error of a step, which is a weighted sum of derivatives with errors δ, in δ times its length: roots of the sums of squares of
/// the weights of embedded pairs are up to 2, what three samples show of δ may be a part of it, and in between there is to be room
/// to tell an error from rounding.
const AMPLIFICATION: f64 = 4.0;

/// The tolerances of an adaptive method.
#[derive(Clone, Copy, Debug)]
pub(in crate::integrate) struct Tolerance {
    pub(in crate::integrate) relative: f64,
    pub(in crate::integrate) absolute: f64,
}

/// What rounding does to a step of some length from a state, component by component: at least so much is tolerated.
pub(in crate::integrate) struct Floor<S: GaussSystem> {
    /// What derivatives differ by within a rounding of the state.
    derivatives: Rates<S>,
}

impl<S: GaussSystem> Floor<S> {
    /// Measured at a state with its derivatives.
    #[cold]
    #[inline(never)]
    pub(in crate::integrate) fn at<P: Problem<System = S>>(problem: &P, state: &State<S>, rates: &Rates<S>) -> Self {
        let mut derivatives: Rates<S> = Rates { configuration: TangentOf::<S>::zero(), variables: S::Speeds::zero() };
        let unit = S::Scalar::from_f64(S::Scalar::EPSILON);
        // One sign for all, alternating signs, pairs of signs.
        for pattern in [|_: usize| false, |i: usize| i % 2 == 1, |i: usize| i % 4 > 1] {
            let mut sigma = TangentOf::<S>::zero();
            for i in 0..TangentOf::<S>::DIM {
                let size = S::Scalar::EPSILON * state.q.magnitude(i);
                sigma.set_component(i, S::Scalar::from_f64(if pattern(i) { -size } else { size }));
            }
            let mut y = state.y;
            for i in 0..S::Speeds::DIM {
                let by = y.component(i) * unit;
                let moved = y.component(i) + if pattern(i + TangentOf::<S>::DIM) { -by } else { by };
                y.set_component(i, moved);
            }
            let near = problem.rates(&State { t: state.t, q: state.q.retract(&sigma), y });
            if !near.is_finite() {
                continue;
            }
            for i in 0..TangentOf::<S>::DIM {
                let change = (near.configuration.component(i) - rates.configuration.component(i)).abs();
                let most = change.max(derivatives.configuration.component(i));
                derivatives.configuration.set_component(i, most);
            }
            for i in 0..S::Speeds::DIM {
                let change = (near.variables.component(i) - rates.variables.component(i)).abs();
                derivatives.variables.set_component(i, change.max(derivatives.variables.component(i)));
            }
        }
        Self { derivatives }
    }
}

/// A step, of which errors are to be judged.
pub(in crate::integrate) struct Trial<'a, S: GaussSystem> {
    pub(in crate::integrate) from: &'a State<S>,
    pub(in crate::integrate) to: &'a State<S>,
    pub(in crate::integrate) length: f64,
    pub(in crate::integrate) floor: Option<&'a Floor<S>>,
}

impl Tolerance {
    /// The error of a step in tolerances: the root mean square over the components, of the worst lane. NaN when an error is.
    #[inline(always)]
    pub(in crate::integrate) fn error<S: GaussSystem>(
        &self,
        trial: &Trial<'_, S>,
        fine: &Rates<S>,
        coarse: Option<&Rates<S>>,
    ) -> f64 {
        let components = (TangentOf::<S>::DIM + S::Speeds::DIM).max(1) as f64;
        let mut worst = 0.0;
        for lane in 0..S::Scalar::LANES {
            let squares = |tolerance: f64, fine: S::Scalar, coarse: Option<S::Scalar>| {
                let per_tolerance = 1.0 / tolerance;
                let square = |error: S::Scalar| {
                    let ratio = error.lane(lane) * per_tolerance;
                    ratio * ratio
                };
                [square(fine), coarse.map_or(0.0, square)]
            };
            let sum = |[a, b]: [f64; 2], [c, d]: [f64; 2]| [a + c, b + d];
            let (mut of_q, mut of_y) = ([0.0; 2], [0.0; 2]);
            for i in 0..TangentOf::<S>::DIM {
                let coarse = coarse.map(|coarse| coarse.configuration.component(i));
                of_q =
                    sum(of_q, squares(self.of_configuration(trial, i, lane), fine.configuration.component(i), coarse));
            }
            for i in 0..S::Speeds::DIM {
                let coarse = coarse.map(|coarse| coarse.variables.component(i));
                of_y = sum(of_y, squares(self.of_variables(trial, i, lane), fine.variables.component(i), coarse));
            }
            let [fine, coarse] = sum(of_q, of_y);
            let error = Real::sqrt(combined(fine, coarse) * (1.0 / components));
            // Written so that a NaN stays.
            worst = if error <= worst { worst } else { error };
        }
        worst
    }

    /// The same above a floor. Runs that stay above rounding hold no copy of it.
    #[cold]
    #[inline(never)]
    pub(in crate::integrate) fn error_above<S: GaussSystem>(
        &self,
        floor: &Floor<S>,
        (from, to, length): (&State<S>, &State<S>, f64),
        (fine, coarse): (&Rates<S>, Option<&Rates<S>>),
    ) -> f64 {
        self.error(&Trial { from, to, length, floor: Some(floor) }, fine, coarse)
    }

    /// How many times the tolerance rounding is where it is more, the largest of the components; 0 where it is nowhere.
    #[cold]
    #[inline(never)]
    pub(in crate::integrate) fn excess<S: GaussSystem>(&self, trial: &Trial<'_, S>) -> f64 {
        let bare = Trial { floor: None, ..*trial };
        let mut largest = 0.0_f64;
        for lane in 0..S::Scalar::LANES {
            for i in 0..TangentOf::<S>::DIM {
                largest = largest.max(self.of_configuration(trial, i, lane) / self.of_configuration(&bare, i, lane));
            }
            for i in 0..S::Speeds::DIM {
                largest = largest.max(self.of_variables(trial, i, lane) / self.of_variables(&bare, i, lane));
            }
        }
        if largest > 1.0 { largest } else { 0.0 }
    }

    #[inline(always)]
    fn of_configuration<S: GaussSystem>(&self, trial: &Trial<'_, S>, i: usize, lane: usize) -> f64 {
        let size = trial.from.q.magnitude(i).max(trial.to.q.magnitude(i));
        let noise = |floor: &Floor<S>| floor.derivatives.configuration.component(i).lane(lane);
        self.of(size, trial.length, trial.floor.map(noise), S::Scalar::EPSILON)
    }

    #[inline(always)]
    fn of_variables<S: GaussSystem>(&self, trial: &Trial<'_, S>, i: usize, lane: usize) -> f64 {
        let size = trial.from.y.component(i).lane(lane).abs().max(trial.to.y.component(i).lane(lane).abs());
        let noise = |floor: &Floor<S>| floor.derivatives.variables.component(i).lane(lane);
        self.of(size, trial.length, trial.floor.map(noise), S::Scalar::EPSILON)
    }

    /// What is tolerated of a component of some size. Purely relative control of a null component asks for what is null too.
    #[inline(always)]
    fn of(&self, size: f64, length: f64, noise: Option<f64>, unit: f64) -> f64 {
        let asked = (self.absolute + self.relative * size).max(f64::MIN_POSITIVE);
        match noise {
            // The state itself is rounded at the end of the step.
            Some(noise) => asked.max(AMPLIFICATION * length * noise + unit * size),
            None => asked,
        }
    }
}

/// The square of `e²/√(e² + ê²/100)` from the squares of e and ê: that of e itself where ê is too large or too small beside it
/// for the formula to be computed.
fn combined(fine: f64, coarse: f64) -> f64 {
    let part = fine / (fine + 0.01 * coarse);
    if part > 0.0 { fine * part } else { fine }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_estimates_make_one() {
        assert_eq!(combined(1e-6, 0.0), 1e-6);
        // e = 3, ê/10 = 4.
        assert!((combined(9.0, 1600.0) - (9.0_f64 / 5.0).powi(2)).abs() < 4.0 * f64::EPSILON);
        // What cannot be computed is not taken for small.
        assert_eq!(combined(0.0, 0.0), 0.0);
        assert_eq!(combined(0.0, 1.0), 0.0);
        assert_eq!(combined(1e-200, f64::INFINITY), 1e-200);
        assert_eq!(combined(f64::INFINITY, f64::INFINITY), f64::INFINITY);
        assert!(combined(f64::NAN, 1.0).is_nan());
    }
}
