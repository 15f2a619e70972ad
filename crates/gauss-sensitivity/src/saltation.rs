//! Steps that end at an event, with the jump of the state there, in a product of derivatives of steps.
//!
//! A neighbouring motion comes to the event at another time. With w the function of the event, f the change of the end
//! of the step with its length and ẇ = ∂w/∂x f + ∂w/∂t, an end that moves by a comes later by δt = −(∂w/∂x a)/ẇ; it is
//! then at a + f δt, and the jump J leads to ∂J/∂x (a + f δt) + ∂J/∂t δt. The step after that starts later by δt and
//! ends when it did (M. A. Aizerman & F. R. Gantmakher, *Determination of stability by linear approximation of a
//! periodic solution of a system of differential equations with discontinuous right-hand sides*, 1958).

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::dual::Dual;
use gauss_runtime::integrate::{DiscreteLinearization, Feedback, IntegrationError, State, SystemProblem, VelocityForm};
use gauss_runtime::nalgebra::{SMatrix, SVector};
use gauss_runtime::system::GaussSystem;

use crate::error::SensitivityError;
use crate::run::{At, Start, consistent};
use crate::states::{ComponentsOf, TangentOf, in_numbers, increment, numbers_of};

/// A step, or several as one, that ends at an event, and the state after the jump there. D counts the components of
/// (σ, δz), U those of the input, as in [`DiscreteLinearization`].
///
/// Between events derivatives of steps are multiplied by [`then`](DiscreteLinearization::then); over an event by
/// [`after`](Self::after) and [`then`](Self::then). So a run with events has the product of its steps, for regulators
/// and filters of what walks, bounces and switches.
///
/// ```
/// use gauss_runtime::dual::Dual;
/// use gauss_runtime::prelude::*;
/// use gauss_sensitivity::Saltation;
///
/// #[derive(GaussDynamics)]
/// #[gauss(linearize, coordinates(height), particle(mass = 1, position = [0, 0, height]))]
/// struct Ball<T> {
///     #[gauss(gravity)]
///     g: T,
/// }
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let (kernel, dual) = (Ball { g: 10.0 }.kernel()?, Ball { g: Dual::<2>::constant(10.0) }.kernel()?);
/// let step = |q: &_, z: &_, h| CommutatorFree4.step_linearized(&kernel, 0.0, q, z, &(), h);
/// // From 5 m the ball is on the floor after a second, at 10 m/s; eight tenths of that are left.
/// let fall = step(&SVector::from([5.0]), &SVector::from([0.0]), 1.0)?;
/// let kept = Dual::constant(-0.8);
/// let bounce = Saltation::after(&fall, &dual, |at| at.q[0], |at| (*at.q, SVector::from([kept * at.z[0]])))?;
/// // A centimetre higher it comes a millisecond later.
/// assert!((bounce.time_by_state[0] - 0.1).abs() < 1e-14);
/// let whole = bounce.then(&step(&bounce.step.q, &bounce.step.z, 0.5)?);
/// // v = 0.8 √(2 g h) − g (t − √(2 h/g)) at its end.
/// assert!((whole.by_state[(1, 0)] - (0.8 + 1.0)).abs() < 1e-13);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Saltation<S: GaussSystem<Scalar = f64>, const D: usize, const U: usize> {
    /// The step with the state after the jump as its end, at the time of the event, wherever that moves.
    pub step: DiscreteLinearization<S, D, U>,
    /// ∂(time of the event)/∂(σ, δz) at the start.
    pub time_by_state: SVector<f64, D>,
    /// ∂(time of the event)/∂input.
    pub time_by_input: SVector<f64, U>,
    /// ∂(time of the event)/∂t, of steps that start later.
    pub time_by_time: f64,
    /// The time by which the step ends before the event, to first order: rounding, where it ends at it.
    pub early: f64,
}

/// The function of an event and the state after its jump, with their derivatives by (σ, δz) and by the time.
struct Event<S: GaussSystem, const D: usize> {
    value: f64,
    by_state: SVector<f64, D>,
    by_time: f64,
    end: State<S>,
    jump_by_state: SMatrix<f64, D, D>,
    jump_by_time: SVector<f64, D>,
}

impl<S: GaussSystem<Scalar = f64>, const D: usize, const U: usize> Saltation<S, D, U> {
    /// The step `before`, which ends where the function `event` is zero, and the `jump` there: as
    /// [`Run::until`](crate::Run::until) and [`Run::jump`](crate::Run::jump), in dual numbers of any number of
    /// directions. Where the state does not jump that is `|at| (*at.q, *at.z)`. `dual` is the same system in these
    /// numbers.
    ///
    /// # Errors
    /// [`NoDerivative`](SensitivityError::NoDerivative) where the function touches zero;
    /// [`NonFinite`](SensitivityError::NonFinite); [`Run`](SensitivityError::Run) where the state after the jump is not
    /// brought onto the constraints.
    pub fn after<L: GaussSystem<Scalar = Dual<N>, Input: VectorSpace<Dual<N>>>, const N: usize>(
        before: &DiscreteLinearization<S, D, U>,
        dual: &L,
        event: impl Fn(&At<'_, L>) -> Dual<N>,
        jump: impl Fn(&At<'_, L>) -> Start<L>,
    ) -> Result<Self, SensitivityError> {
        let found: Event<S, D> = differentiated(before, dual, event, jump)?;
        let terms = found.by_state.component_mul(&before.by_step);
        let rate = terms.sum() + found.by_time;
        check(before.t, rate, terms.abs().sum() + found.by_time.abs())?;
        let later = |ends: &SVector<f64, D>| -found.by_state.dot(ends) / rate;
        let of = |ends: SVector<f64, D>, later: f64, time: f64| {
            found.jump_by_state * (ends + before.by_step * later) + found.jump_by_time * time
        };
        let time_by_state = SVector::from_fn(|k, _| later(&before.by_state.column(k).into()));
        let time_by_input = SVector::from_fn(|k, _| later(&before.by_input.column(k).into()));
        let start_later = later(&before.by_time) - found.by_time / rate;
        let mut step = *before;
        (step.q, step.z) = (found.end.q, found.end.y);
        for k in 0..D {
            step.by_state.set_column(k, &of(before.by_state.column(k).into(), time_by_state[k], time_by_state[k]));
        }
        for k in 0..U {
            step.by_input.set_column(k, &of(before.by_input.column(k).into(), time_by_input[k], time_by_input[k]));
        }
        step.by_time = of(before.by_time, start_later, 1.0 + start_later);
        // The event ends the step, however long it was to be.
        step.by_step = SVector::zeros();
        let (early, time_by_time) = (-found.value / rate, 1.0 + start_later);
        let finite = |numbers: &[f64]| numbers.iter().all(|number| number.is_finite());
        if finite(step.by_state.as_slice()) && finite(step.by_input.as_slice()) && finite(step.by_time.as_slice()) {
            return Ok(Self { step, time_by_state, time_by_input, time_by_time, early });
        }
        Err(SensitivityError::NonFinite { time: before.t })
    }

    /// This and the `next` step, which starts after the jump, as one: where the event comes later that one starts later
    /// and ends at the same time. Of several steps as one the last one is shortened.
    #[must_use]
    pub fn then(&self, next: &DiscreteLinearization<S, D, U>) -> DiscreteLinearization<S, D, U> {
        let mut whole = self.step.then(next);
        let by_start = next.by_time - next.by_step;
        whole.by_state += by_start * self.time_by_state.transpose();
        whole.by_input += by_start * self.time_by_input.transpose();
        // `then` has the start as late as that of the whole.
        whole.by_time += by_start * (self.time_by_time - 1.0);
        whole
    }
}

/// An event that rather touches zero has no time that could be told.
fn check(time: f64, rate: f64, terms: f64) -> Result<(), SensitivityError> {
    const TOUCHES: f64 = 1e-6;
    let passes = rate.is_finite() && rate.abs() > TOUCHES * terms;
    if passes { Ok(()) } else { Err(SensitivityError::NoDerivative { time, rate }) }
}

/// Both functions at the end of a step, N directions at a time.
fn differentiated<S, L, const D: usize, const U: usize, const N: usize>(
    before: &DiscreteLinearization<S, D, U>,
    dual: &L,
    event: impl Fn(&At<'_, L>) -> Dual<N>,
    jump: impl Fn(&At<'_, L>) -> Start<L>,
) -> Result<Event<S, D>, SensitivityError>
where
    S: GaussSystem<Scalar = f64>,
    L: GaussSystem<Scalar = Dual<N>, Input: VectorSpace<Dual<N>>>,
{
    const {
        assert!(N > 0, "a dual number has a direction, at least");
        assert!(D == TangentOf::<S>::DIM + S::Speeds::DIM, "D counts increments and speeds");
    }
    let at_end = State::<S> { t: before.t, q: before.q, y: before.z };
    let (zero, square) = (SVector::zeros(), SMatrix::zeros());
    let mut found =
        Event { value: 0.0, by_state: zero, by_time: 0.0, end: at_end, jump_by_state: square, jump_by_time: zero };
    let no_input = Feedback(|_, _: &L::Configuration, _: &L::Speeds| L::Input::zero());
    let problem = SystemProblem { system: dual, form: VelocityForm, input: no_input };
    // The last direction is the time.
    for first in (0..=D).step_by(N) {
        let State { t, q, y } = varied::<S, L, N>(&at_end, first, D);
        let at = At { number: 0, ended: false, system: dual, t, q: &q, z: &y };
        let function = event(&at);
        let end = consistent(dual, at.t, jump(&at));
        let end = end.map_err(|kind| IntegrationError::at(&problem, &State { t, q, y }, kind))?;
        found.value = function.value;
        found.end = in_numbers(&end, before.t, |number| number.value);
        let all: Vec<Dual<N>> = numbers_of(&end).collect();
        let (of_q, of_z) = all.split_at(ComponentsOf::<S>::DIM);
        for (direction, k) in (first..=D).zip(0..N) {
            let change: Vec<f64> = of_q.iter().map(|number| number.slopes[k]).collect();
            let moved = increment::<S>(&found.end.q, &change);
            let column = SVector::<f64, D>::from_fn(|i, _| match i.checked_sub(TangentOf::<S>::DIM) {
                None => moved.component(i),
                Some(i) => of_z[i].slopes[k],
            });
            if direction == D {
                (found.by_time, found.jump_by_time) = (function.slopes[k], column);
            } else {
                found.by_state[direction] = function.slopes[k];
                found.jump_by_state.set_column(direction, &column);
            }
        }
    }
    Ok(found)
}

/// A state with derivatives by N components of (σ, δz, t) from a first one on.
fn varied<S, L, const N: usize>(state: &State<S>, first: usize, time: usize) -> State<L>
where
    S: GaussSystem<Scalar = f64>,
    L: GaussSystem<Scalar = Dual<N>>,
{
    let direction = |i: usize| match i.checked_sub(first) {
        Some(k) if k < N => Dual { value: 0.0, ..Dual::variable(0.0, k) },
        _ => Dual::constant(0.0),
    };
    let t = Dual::constant(state.t) + direction(time);
    let State { q, mut y, .. } = in_numbers::<S, L>(state, t, Dual::constant);
    let mut sigma = TangentOf::<L>::zero();
    let positions = TangentOf::<L>::DIM;
    (0..positions).for_each(|i| sigma.set_component(i, direction(i)));
    (0..L::Speeds::DIM).for_each(|i| y.set_component(i, y.component(i) + direction(positions + i)));
    State { t, q: q.retract(&sigma), y }
}
