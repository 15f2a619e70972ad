//! Adams' methods: each step makes use of the derivatives at the ends of those before, and needs two evaluations,
//! whatever the order.
//!
//! The explicit formula of K steps predicts the end of a step, the implicit one of order K + 1 corrects it once, and
//! the derivatives there are evaluated again (Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I*,
//! III.1, "PECE"). Steps are made on the components of the configuration, as those of [`RungeKutta`] are, and brought
//! back onto the group at their ends: what is remembered are derivatives of components, which live in one linear space
//! wherever the group was, so that no logarithm is needed between steps.
//!
//! Smooth scenes need half of the evaluations that Runge–Kutta methods of order 8 and 9 need between errors of 1e-4 and
//! 1e-12. Steps must resolve the fastest motion: a longer one is not inaccurate but unstable. The first K − 1 steps of
//! a run, and after a jump, are made by a Runge–Kutta method of order 8, two or three at once (`beginning`): 53
//! evaluations for K = 10, 77 for K = 12.

mod beginning;
mod formula;

use core::ops::ControlFlow;

use crate::configuration::{Configuration, VectorSpace};
use crate::integrate::drive::control::{Control, Progress, StepCallback, one_step};
use crate::integrate::drive::fixed::EqualSteps;
use crate::integrate::problem::called_equations::CalledEquations;
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::{IntegrationError, IntegrationErrorKind, RunPart};
use crate::integrate::problem::state::{Rates, State};
use crate::integrate::runge_kutta::components::{ComponentsOf, Point, RungeKutta};
use crate::integrate::runge_kutta::tableau::DormandPrince8;
use crate::integrate::step::checks::{check_chart, check_turn};
use crate::real::Real;
use crate::system::GaussSystem;
pub use beginning::{StartingStates, begin, point};
use formula::Formula;

/// Adams' method of K steps, 2 to 12, with steps of one length: of order K + 1, or 9 for K from 9 on, because of how it
/// begins.
///
/// The more steps, the fewer evaluations at small errors, and the shorter a step must be to be stable: hλ up to 0.9,
/// 0.5 and 0.3 for oscillations of frequency λ and 6, 8 and 10 steps. Beyond that results are useless at once.
///
/// ```
/// use gauss_runtime::integrate::Adams;
///
/// let control = Adams::<_, 10>::new(0.02);
/// # let _: Adams<f64, 10> = control;
/// ```
///
/// It goes into [`Simulation::control`](crate::integrate::Simulation::control).
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Adams<T, const K: usize> {
    /// The length of the steps, of either sign.
    pub step: T,
}

impl<T: Real, const K: usize> Adams<T, K> {
    /// Steps of length |step|; the direction is that of the interval.
    #[must_use]
    pub fn new(step: T) -> Self {
        Self { step }
    }
}

/// The derivatives at the ends of the last steps, the newest first, in a window that moves through an array with room
/// for so many.
#[derive(Clone)]
pub struct History<C, Y, const K: usize, const ROOM: usize> {
    derivatives: [Point<C, Y>; ROOM],
    newest: usize,
    /// Weights of the explicit and of the implicit formula. A field, so that compilers need not know their number:
    /// where a history is behind a pointer, as that of lanes, loops over it stay loops, whose sums are in registers.
    weights: &'static [[f64; 2]],
}

impl<C: Copy, Y: Copy, const K: usize, const ROOM: usize> History<C, Y, K, ROOM> {
    /// Before the first step.
    pub fn new<T: Real>() -> Self
    where
        C: VectorSpace<T>,
        Y: VectorSpace<T>,
    {
        const { assert!(ROOM > K) };
        Self { derivatives: [Point::zero(); ROOM], newest: ROOM, weights: &Formula::<K>::BOTH }
    }

    /// Puts a derivative before the newest one: after [`step`](Self::step) it is the newest itself.
    #[inline(always)]
    pub fn put<T: Real>(&mut self, derivative: &Point<C, Y>)
    where
        C: VectorSpace<T>,
        Y: VectorSpace<T>,
    {
        if self.newest == 0 {
            self.newest = ROOM - K;
            self.derivatives.copy_within(0..K, self.newest);
        }
        // One by one, from registers: a copy as a whole would be a call.
        let place = &mut self.derivatives[self.newest - 1];
        (0..C::DIM).for_each(|i| place.components.set_component(i, derivative.components.component(i)));
        (0..Y::DIM).for_each(|i| place.variables.set_component(i, derivative.variables.component(i)));
    }

    /// Lets each derivative of the window that is to come be what is chosen of it and of the one in its place now.
    pub fn put_back(&mut self, choose: impl Fn(&Point<C, Y>, &Point<C, Y>) -> Point<C, Y>) {
        for i in self.newest - 1..(self.newest + K).min(ROOM) - 1 {
            self.derivatives[i] = choose(&self.derivatives[i], &self.derivatives[i + 1]);
        }
    }

    /// The window moves on.
    #[inline(always)]
    pub fn step(&mut self) {
        self.newest -= 1;
    }

    /// The change in a step of length 1 by the explicit formula, and what the derivatives known are in the implicit
    /// one.
    #[inline(always)]
    pub fn sums<T: Real>(&self, newest: &Point<C, Y>) -> [Point<C, Y>; 2]
    where
        C: VectorSpace<T>,
        Y: VectorSpace<T>,
    {
        let Some(([a, b], weights)) = self.weights.split_first() else { return [Point::zero(); 2] };
        let window = &self.derivatives[self.newest..self.newest + weights.len()];
        // The newest last: all others are known while it is evaluated. It is not yet in the window, from which it would
        // have to be read as soon as it is written. Components and variables one after the other, so that sums stay in
        // registers.
        let [mut explicit, mut implicit] = [Point::<C, Y>::zero(); 2];
        for ([a, b], known) in weights.iter().zip(window).rev() {
            explicit.components = explicit.components.add_scaled(T::from_f64(*a), &known.components);
            implicit.components = implicit.components.add_scaled(T::from_f64(*b), &known.components);
        }
        for ([a, b], known) in weights.iter().zip(window).rev() {
            explicit.variables = explicit.variables.add_scaled(T::from_f64(*a), &known.variables);
            implicit.variables = implicit.variables.add_scaled(T::from_f64(*b), &known.variables);
        }
        [explicit.add_scaled(T::from_f64(*a), newest), implicit.add_scaled(T::from_f64(*b), newest)]
    }
}

/// A step: prediction, evaluation, correction. From a state, the derivatives there, and what is known of the step by
/// [`History::sums`].
///
/// # Errors
/// When it cannot be made.
#[inline(always)]
pub fn multistep<S: GaussSystem, P: Problem<System = S>, const K: usize>(
    problem: &P,
    state: &State<S>,
    rates: &Rates<S>,
    h: S::Scalar,
    [predicted, known]: [Point<ComponentsOf<S>, S::Speeds>; 2],
) -> Result<State<S>, IntegrationErrorKind> {
    let State { t, q, y } = *state;
    let start = Point { components: q.components(), variables: y };
    let ahead = start.add_scaled(h, &predicted);
    let ahead = State { t: t + h, q: S::Configuration::from_components(&ahead.components), y: ahead.variables };
    let next = problem.rates(&ahead);
    let sum = known.add_scaled(S::Scalar::from_f64(Formula::<K>::AHEAD), &point::<S>(&ahead.q, &next));
    let turn = rates.configuration.add_scaled(S::Scalar::one(), &next.configuration);
    check_turn::<S>(&turn.scale(S::Scalar::ratio(1, 2) * h))?;
    // What the rounding of the step before left of norms goes away with the rounding of this one.
    let change = q.norm_correction().add_scaled(h, &sum.components);
    let components = start.components.add_scaled(S::Scalar::one(), &change);
    let q = S::Configuration::from_components(&components).renormalise();
    let end = State { t: t + h, q, y: y.add_scaled(h, &sum.variables) };
    check_chart(problem.system(), state, &end)?;
    if end.q.is_finite() && end.y.is_finite() {
        Ok(end)
    } else {
        Err(IntegrationErrorKind::NonFinite { part: RunPart::Step })
    }
}

/// Derivatives there is room for.
const ROOM: usize = 64;

/// The derivatives that a run by a method of K steps remembers, and its first states, once they have been made, where
/// it begins so.
type Multistep<S, const K: usize> =
    (History<ComponentsOf<S>, <S as GaussSystem>::Speeds, K, ROOM>, Option<StartingStates<S, K>>);

/// A run by a method of K steps.
type Multisteps<S, const K: usize> = Progress<S, (EqualSteps<<S as GaussSystem>::Scalar>, Multistep<S, K>)>;

/// The steps before there is a history.
#[inline(never)]
fn first_steps<S: GaussSystem, P: Problem<System = S>, const K: usize>(
    problem: &P,
    run: &mut Multisteps<S, K>,
    emit: &mut StepCallback<'_, S>,
) -> Result<ControlFlow<()>, IntegrationError> {
    let problem = &CalledEquations(problem);
    let (steps, (_, ahead)) = &mut run.memory;
    if steps.made() == 0 && StartingStates::<S, K>::serves(steps.steps()) {
        *ahead = StartingStates::of(problem, &run.state, &run.rates, steps.length()).ok();
    }
    let (first, mut made) = (steps.steps().min(K as u64 - 1), steps.made() as usize);
    run.until(first, problem, emit, |(history, ahead), state, rates, h| {
        let newest = point::<S>(&state.q, rates);
        let end = match ahead {
            Some(ahead) => {
                let (end, known) = ahead.after(made);
                (end, Some(known))
            }
            None => begin::<S, _, K>(problem, state, rates, h)?,
        };
        history.put(&newest);
        history.step();
        made += 1;
        Ok(end)
    })
}

/// A last step of another length, if there is one left.
#[inline(never)]
fn last_step<S: GaussSystem, P: Problem<System = S>, const K: usize>(
    problem: &P,
    run: &mut Multisteps<S, K>,
    emit: &mut StepCallback<'_, S>,
) -> Result<(), IntegrationError> {
    let problem = &CalledEquations(problem);
    let flow =
        run.until(run.memory.0.steps(), problem, emit, |_, state, rates, h| begin::<S, _, K>(problem, state, rates, h));
    flow.map(|_| ())
}

impl<S: GaussSystem, const K: usize> Control<S> for Adams<S::Scalar, K> {
    type StepMemory = (EqualSteps<S::Scalar>, Multistep<S, K>);

    fn start<P: Problem<System = S>>(
        &self,
        problem: &P,
        start: State<S>,
        end: S::Scalar,
        limit: u64,
        emit: &mut StepCallback<'_, S>,
    ) -> Result<Progress<S, Self::StepMemory>, IntegrationError> {
        EqualSteps::start(((self.step, false), (History::new(), None)), problem, &start, end, limit, emit)
    }

    fn advance<P: Problem<System = S>>(
        &self,
        problem: &P,
        run: &mut Progress<S, Self::StepMemory>,
        emit: &mut StepCallback<'_, S>,
    ) -> Result<(), IntegrationError> {
        let steps = run.memory.0;
        // Three loops, of which the second, by itself, keeps what it works on in registers.
        if steps.made() + 1 < K as u64 && first_steps(problem, run, emit)?.is_break() {
            return Ok(());
        }
        // The last step may be shorter.
        let whole = steps.steps() - u64::from(!steps.ends_with_a_whole_step(run.end));
        let flow = run.until(whole, problem, emit, |(history, _), state, rates, h| {
            let newest = point::<S>(&state.q, rates);
            let end = multistep::<S, P, K>(problem, state, rates, h, history.sums(&newest))?;
            history.put(&newest);
            history.step();
            Ok((end, None))
        })?;
        if flow.is_continue() && !run.ended {
            last_step(problem, run, emit)?;
        }
        Ok(())
    }

    /// Makes one step of the method that begins runs, whose steps may be longer.
    fn within<P: Problem<System = S>>(
        &self,
        problem: &P,
        state: &State<S>,
        rates: &Rates<S>,
        h: S::Scalar,
    ) -> Result<State<S>, IntegrationErrorKind> {
        one_step(&RungeKutta(DormandPrince8), problem, state, rates, h)
    }
}

#[cfg(test)]
#[path = "tests.rs"]
mod tests;
