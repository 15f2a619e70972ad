//! Errors of steps in units of the tolerance, and the part of them that is rounding.
//!
//! **Rounding.** Stages of a step are rounded, so derivatives are evaluated at states that are off by about ε of their
//! sizes: an error estimate, which is h times a sum of derivatives, never falls below h times their change. Where
//! a tolerance asks for less, shorter steps do not help: the estimate falls with h alone, and steps that follow it
//! become shorter by orders of magnitude without being any better. So when a step is rejected, or steps have become
//! half as long, the derivatives are evaluated at states that differ by ε, and their difference δ is tolerated in each
//! component, h·δ with a factor, where that is more than the user's tolerance. Elsewhere nothing changes, to the last
//! bit. A kink or a jump is no rounding: it is not within ε of the state.
//!
//! **What is measured.** Errors are those of q and of the speeds z, in the momentum form as well: near a singular place
//! of a chart, and of a body far from O, a small part of a momentum is much of a speed. States here have z in the place
//! of y ([`Problem::in_speeds`]), and errors are changes of (q, z) ([`Problem::change_of_speeds`]).

use core::fmt;

use crate::configuration::{Configuration, VectorSpace};
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::state::{Rates, State, TangentOf, copy_and_debug};
use crate::real::Real;
use crate::system::GaussSystem;

/// The error of a step, which is a weighted sum of derivatives with errors δ, in δ times its length: roots of the sums
/// of squares of the weights of embedded pairs are up to 2, what three samples show of δ may be a part of it, and in
/// between there is to be room to tell an error from rounding.
const AMPLIFICATION: f64 = 4.0;

/// Roundings of momenta by which the speeds at the end of a step may be off: a step is a sum of a dozen stages, with
/// weights of either sign.
const SUMS: f64 = 16.0;

/// The tolerances of an adaptive method.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    /// Tolerance relative to the size of a component.
    pub relative: f64,
    /// Tolerance for components near zero.
    pub absolute: f64,
}

/// Rounding errors of a step of some length from a state, component by component: at least so much is tolerated.
pub struct Floor<S: GaussSystem> {
    /// Differences of derivatives within a rounding of the state.
    derivatives: Rates<S>,
    /// Relative rounding of the state itself at the end of a step; 0 in lanes without a floor.
    unit: S::Scalar,
    /// The errors of the speeds by a rounding of q and of momenta, where they are more than a rounding of theirs.
    speeds: S::Speeds,
}

copy_and_debug!(Floor { derivatives, unit, speeds });

impl<S: GaussSystem> Floor<S> {
    /// Nothing is known in any lane.
    pub fn none() -> Self {
        let derivatives = Rates { configuration: TangentOf::<S>::zero(), variables: S::Speeds::zero() };
        Self { derivatives, unit: S::Scalar::zero(), speeds: S::Speeds::zero() }
    }

    /// Takes the floor of `other` in lanes where `of_other` is 1, else this one.
    pub fn or(&self, of_other: S::Scalar, other: &Self) -> Self {
        let choose = |mine: S::Scalar, other: S::Scalar| S::Scalar::select_lt(S::Scalar::zero(), of_other, other, mine);
        let (mut derivatives, mut speeds) = (self.derivatives, self.speeds);
        for i in 0..TangentOf::<S>::DIM {
            let both = (derivatives.configuration.component(i), other.derivatives.configuration.component(i));
            derivatives.configuration.set_component(i, choose(both.0, both.1));
        }
        for i in 0..S::Speeds::DIM {
            let both = (derivatives.variables.component(i), other.derivatives.variables.component(i));
            derivatives.variables.set_component(i, choose(both.0, both.1));
            speeds.set_component(i, choose(speeds.component(i), other.speeds.component(i)));
        }
        Self { derivatives, unit: choose(self.unit, other.unit), speeds }
    }

    /// Measured at a state with its derivatives.
    #[cold]
    #[inline(never)]
    pub fn at<P: Problem<System = S>>(problem: &P, state: &State<S>, rates: &Rates<S>) -> Self {
        let mut derivatives: Rates<S> = Rates { configuration: TangentOf::<S>::zero(), variables: S::Speeds::zero() };
        let unit = S::Scalar::from_f64(S::Scalar::EPSILON);
        let (mut speeds, z) = (S::Speeds::zero(), problem.in_speeds(state).y);
        for pattern in PATTERNS {
            let (there, change) = rounded(state, pattern);
            let near = problem.rates(&there);
            let differs = problem.change_of_speeds(&there, &change).variables;
            let of_y = near.variables.add_scaled(-S::Scalar::one(), &rates.variables);
            // Momenta that differ by so much, at the same place.
            let still = Rates { configuration: TangentOf::<S>::zero(), variables: of_y };
            let of_z = problem.change_of_speeds(&State { y: of_y, ..*state }, &still).variables;
            // 0 in a lane that is finite there, else NaN.
            let mut null = S::Scalar::zero();
            (0..TangentOf::<S>::DIM)
                .map(|i| near.configuration.component(i))
                .for_each(|x| null += x * S::Scalar::zero());
            (0..S::Speeds::DIM).map(|i| near.variables.component(i)).for_each(|x| null += x * S::Scalar::zero());
            let more = |differs: S::Scalar, known: S::Scalar| {
                let most = larger(differs.abs(), known);
                S::Scalar::select_lt(null, S::Scalar::one(), most, known)
            };
            for i in 0..TangentOf::<S>::DIM {
                let (near, here) = (near.configuration.component(i), rates.configuration.component(i));
                let most = more(near - here, derivatives.configuration.component(i));
                derivatives.configuration.set_component(i, most);
            }
            for i in 0..S::Speeds::DIM {
                derivatives.variables.set_component(i, more(of_z.component(i), derivatives.variables.component(i)));
                let (differs, usual) = (differs.component(i), (unit + unit) * z.component(i).abs());
                let own = S::Scalar::select_lt(usual, differs.abs(), differs, S::Scalar::zero());
                let own = S::Scalar::from_f64(SUMS) * own;
                speeds.set_component(i, more(own, speeds.component(i)));
            }
        }
        Self { derivatives, unit, speeds }
    }
}

/// Which components are rounded down, the others up: none, every other one, two of four.
pub(in crate::integrate) const PATTERNS: [fn(usize) -> bool; 3] = [|_| false, |i| i % 2 == 1, |i| i % 4 > 1];

/// A state that differs from another by ε of each component, and the difference.
pub(in crate::integrate) fn rounded<S: GaussSystem>(
    state: &State<S>,
    pattern: fn(usize) -> bool,
) -> (State<S>, Rates<S>) {
    let unit = S::Scalar::from_f64(S::Scalar::EPSILON);
    let mut sigma = TangentOf::<S>::zero();
    for i in 0..TangentOf::<S>::DIM {
        let size = unit * state.q.magnitudes(i);
        sigma.set_component(i, if pattern(i) { -size } else { size });
    }
    let (mut y, mut by) = (state.y, S::Speeds::zero());
    for i in 0..S::Speeds::DIM {
        let size = y.component(i) * unit;
        by.set_component(i, if pattern(i + TangentOf::<S>::DIM) { -size } else { size });
        y.set_component(i, y.component(i) + by.component(i));
    }
    (State { t: state.t, q: state.q.retract(&sigma), y }, Rates { configuration: sigma, variables: by })
}

/// A step, of which errors are to be judged; its states have z in the place of y.
pub struct Trial<'a, S: GaussSystem> {
    /// Its start.
    pub from: &'a State<S>,
    /// Its end.
    pub to: &'a State<S>,
    /// Duration of the step, without a sign.
    pub length: S::Scalar,
    /// Rounding errors of the step, where they are known.
    pub floor: Option<&'a Floor<S>>,
}

impl Tolerance {
    /// The error of a step in tolerances: the root mean square over the components, of the worst lane. NaN when an
    /// error is.
    #[inline(always)]
    pub fn error<S: GaussSystem>(&self, trial: &Trial<'_, S>, fine: &Rates<S>, coarse: Option<&Rates<S>>) -> f64 {
        worst_lane(self.errors(trial, fine, coarse))
    }

    /// The error of a step in tolerances: the root mean square over the components, lane by lane. NaN when an error is.
    #[inline(always)]
    pub fn errors<S: GaussSystem>(
        &self,
        trial: &Trial<'_, S>,
        fine: &Rates<S>,
        coarse: Option<&Rates<S>>,
    ) -> S::Scalar {
        let zero = S::Scalar::zero();
        let squares = |tolerance: S::Scalar, fine: S::Scalar, coarse: Option<S::Scalar>| {
            let per_tolerance = tolerance.recip();
            let square = |error: S::Scalar| {
                let ratio = error * per_tolerance;
                ratio * ratio
            };
            [square(fine), coarse.map_or(zero, square)]
        };
        let sum = |[a, b]: [S::Scalar; 2], [c, d]: [S::Scalar; 2]| [a + c, b + d];
        let (mut of_q, mut of_y) = ([zero; 2], [zero; 2]);
        for i in 0..TangentOf::<S>::DIM {
            let coarse = coarse.map(|coarse| coarse.configuration.component(i));
            of_q = sum(of_q, squares(self.of_configuration(trial, i), fine.configuration.component(i), coarse));
        }
        for i in 0..S::Speeds::DIM {
            let coarse = coarse.map(|coarse| coarse.variables.component(i));
            of_y = sum(of_y, squares(self.of_variables(trial, i), fine.variables.component(i), coarse));
        }
        let [fine, coarse] = sum(of_q, of_y);
        let components = (TangentOf::<S>::DIM + S::Speeds::DIM).max(1) as f64;
        (combined(fine, coarse) * S::Scalar::from_f64(1.0 / components)).sqrt()
    }

    /// [`error`](Self::error) above a floor. Runs that stay above rounding hold no copy of it.
    #[cold]
    #[inline(never)]
    pub fn error_above<S: GaussSystem>(
        &self,
        floor: &Floor<S>,
        states: (&State<S>, &State<S>, S::Scalar),
        estimates: (&Rates<S>, Option<&Rates<S>>),
    ) -> f64 {
        worst_lane(self.errors_above(floor, states, estimates))
    }

    /// [`errors`](Self::errors) above a floor: from a state to another, and the length of the step; its estimates, fine
    /// and coarse.
    #[cold]
    #[inline(never)]
    pub fn errors_above<S: GaussSystem>(
        &self,
        floor: &Floor<S>,
        (from, to, length): (&State<S>, &State<S>, S::Scalar),
        (fine, coarse): (&Rates<S>, Option<&Rates<S>>),
    ) -> S::Scalar {
        self.errors(&Trial { from, to, length, floor: Some(floor) }, fine, coarse)
    }

    /// Largest ratio of rounding to the tolerance, of the components and lanes, where rounding is more; 0 where it is
    /// nowhere.
    #[cold]
    #[inline(never)]
    pub fn excess<S: GaussSystem>(&self, trial: &Trial<'_, S>) -> f64 {
        let largest = worst_lane(self.excesses(trial));
        if largest > 1.0 { largest } else { 0.0 }
    }

    /// Ratio of rounding to the tolerance, at least 1, the largest of the components, lane by lane.
    #[cold]
    #[inline(never)]
    pub fn excesses<S: GaussSystem>(&self, trial: &Trial<'_, S>) -> S::Scalar {
        let bare = Trial { floor: None, ..*trial };
        let mut largest = S::Scalar::one();
        for i in 0..TangentOf::<S>::DIM {
            largest = larger(largest, self.of_configuration(trial, i) / self.of_configuration(&bare, i));
        }
        for i in 0..S::Speeds::DIM {
            largest = larger(largest, self.of_variables(trial, i) / self.of_variables(&bare, i));
        }
        largest
    }

    #[inline(always)]
    pub(in crate::integrate) fn of_configuration<S: GaussSystem>(&self, trial: &Trial<'_, S>, i: usize) -> S::Scalar {
        let size = larger(trial.from.q.magnitudes(i), trial.to.q.magnitudes(i));
        let noise = |floor: &Floor<S>| (floor.derivatives.configuration.component(i), floor.unit, S::Scalar::zero());
        self.of(size, trial.length, trial.floor.map(noise))
    }

    #[inline(always)]
    pub(in crate::integrate) fn of_variables<S: GaussSystem>(&self, trial: &Trial<'_, S>, i: usize) -> S::Scalar {
        let size = larger(trial.from.y.component(i).abs(), trial.to.y.component(i).abs());
        let noise =
            |floor: &Floor<S>| (floor.derivatives.variables.component(i), floor.unit, floor.speeds.component(i));
        self.of(size, trial.length, trial.floor.map(noise))
    }

    /// The tolerance for a component of some size. With a relative tolerance alone it is the smallest number where the
    /// component is zero.
    #[inline(always)]
    fn of<T: Real>(&self, size: T, length: T, noise: Option<(T, T, T)>) -> T {
        let asked = T::from_f64(self.absolute) + T::from_f64(self.relative) * size;
        let asked = larger(asked, T::from_f64(if T::EPSILON > 1e-10 { 1e-37 } else { f64::MIN_POSITIVE }));
        match noise {
            // The state itself is rounded at the end of the step.
            Some((noise, unit, own)) => larger(asked, T::from_f64(AMPLIFICATION) * length * noise + unit * size + own),
            None => asked,
        }
    }
}

/// The larger one, lane by lane; the first where one of them is NaN.
#[inline(always)]
pub(in crate::integrate) fn larger<T: Real>(a: T, b: T) -> T {
    T::select_lt(a, b, b, a)
}

/// The largest of the lanes; NaN where one of them is.
#[inline(always)]
pub fn worst_lane<T: Real>(errors: T) -> f64 {
    let mut worst = 0.0;
    for lane in 0..T::LANES {
        let error = errors.lane(lane);
        // Written so that a NaN wins and stays.
        worst = if error <= worst || worst.is_nan() { worst } else { error };
    }
    worst
}

/// The square of `e²/√(e² + ê²/100)` from the squares of e and ê: that of e itself where ê is too large or too small
/// for the formula to be computed.
#[inline(always)]
fn combined<T: Real>(fine: T, coarse: T) -> T {
    let part = fine / (fine + T::from_f64(0.01) * coarse);
    T::select_lt(T::zero(), part, fine * part, fine)
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
