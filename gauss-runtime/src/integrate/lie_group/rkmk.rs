//! Runge–Kutta–Munthe-Kaas methods: a classical Runge–Kutta method in the algebra, one exponential a stage.
//!
//! With `q = q₀ ∘ exp(σ)` the kinematics become `σ̇ = dexp_inv(σ, V)` on a linear space, where any Runge–Kutta method
//! keeps its order (Munthe-Kaas 1999). Each step starts again at σ = 0, far from the singularity of dexp⁻¹ at 2π. On ℝⁿ
//! exp is addition and dexp⁻¹ the identity: the method is the Runge–Kutta method itself, operation by operation.

use crate::configuration::{Configuration, VectorSpace};
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::{IntegrationErrorKind, RunPart};
use crate::integrate::problem::state::{Rates, State, TangentOf};
use crate::integrate::runge_kutta::tableau::{Rational, Tableau, estimate_order};
use crate::integrate::step::checks::{check_chart, check_increment};
use crate::integrate::step::one_step::{EstimatingStep, IncrementStep, OneStep, Properties, Step, check_contacts};
use crate::real::{Real, ratio_rest, rounded_ratio};
use crate::system::GaussSystem;

/// An explicit Runge–Kutta–Munthe-Kaas method of S stages, its coefficients in the scalar T.
///
/// Steps need no memory beyond the stack.
#[derive(Clone, Copy, Debug)]
pub struct Rkmk<T, const S: usize> {
    a: [[T; S]; S],
    b: [T; S],
    /// a and b beyond the precision of T: heads of half its digits and what is left.
    a_parts: [[[T; S]; 2]; S],
    b_parts: [[T; S]; 2],
    c: [T; S],
    error: [T; S],
    coarse_error: [T; S],
    order: u32,
    estimate_order: f64,
    has_error: bool,
    has_coarse_error: bool,
    first_same_as_last: bool,
}

impl<T: Real, const S: usize> Rkmk<T, S> {
    /// The method of a tableau.
    #[must_use]
    pub fn new(tableau: &Tableau<S>) -> Self {
        let row = |row: &[Rational; S]| row.map(|(p, q)| T::ratio(p, q));
        let parts = |row: &[Rational; S]| [row.map(|fraction| head(fraction)), row.map(|fraction| tail(fraction))];
        Self {
            a: tableau.a.each_ref().map(row),
            b: row(&tableau.b),
            a_parts: tableau.a.each_ref().map(parts),
            b_parts: parts(&tableau.b),
            c: row(&tableau.c),
            error: row(&tableau.error),
            coarse_error: row(&tableau.coarse_error),
            order: tableau.order,
            estimate_order: estimate_order(tableau),
            has_error: tableau.embedded_order > 0,
            has_coarse_error: tableau.coarse_order > 0,
            first_same_as_last: tableau.first_same_as_last,
        }
    }

    /// The order of the method.
    #[must_use]
    pub fn order(&self) -> u32 {
        self.order
    }

    /// The derivatives at the stages in the algebra, and those of the last stage as they are. `increment` gives the
    /// place of stage i.
    #[inline(always)]
    fn stages<Sys: GaussSystem<Scalar = T>, P: Problem<System = Sys>>(
        &self,
        problem: &P,
        state: &State<Sys>,
        rates: &Rates<Sys>,
        h: T,
        increment: impl Fn(usize, &[Rates<Sys>; S]) -> Rates<Sys>,
    ) -> Result<([Rates<Sys>; S], Rates<Sys>), IntegrationErrorKind> {
        check_contacts(problem)?;
        let one = <Sys::Scalar as Real>::one();
        // Derivatives in the algebra: dexp_inv(σ, V) and ẏ. At σ = 0 the former is V.
        let mut stages = [*rates; S];
        let mut last = *rates;
        for i in 1..S {
            let sigma = increment(i, &stages);
            check_increment::<Sys>(&sigma)?;
            let stage: State<Sys> = State {
                t: self.c[i].fma(h, state.t),
                q: state.q.retract(&sigma.configuration),
                y: state.y.add_scaled(one, &sigma.variables),
            };
            last = problem.rates(&stage);
            stages[i] = Rates {
                configuration: Sys::Configuration::dexp_inv(&sigma.configuration, &last.configuration),
                variables: last.variables,
            };
        }
        Ok((stages, last))
    }

    #[inline(always)]
    fn advance<Sys: GaussSystem<Scalar = T>, P: Problem<System = Sys>>(
        &self,
        problem: &P,
        state: &State<Sys>,
        rates: &Rates<Sys>,
        h: T,
    ) -> Result<(Step<Sys>, Option<Rates<Sys>>), IntegrationErrorKind> {
        let one = <Sys::Scalar as Real>::one();
        let (stages, last) =
            self.stages(problem, state, rates, h, |i, stages| combination(h, &self.a[i][..i], stages))?;
        let sigma = combination(h, &self.b, &stages);
        check_increment::<Sys>(&sigma)?;
        let end: State<Sys> = State {
            t: state.t + h,
            q: state.q.advance(&sigma.configuration),
            y: state.y.add_scaled(one, &sigma.variables),
        };
        check_chart(problem.system(), state, &end)?;
        let error: Rates<Sys> = if self.has_error {
            combination(h, &self.error, &stages)
        } else {
            Rates { configuration: TangentOf::<Sys>::zero(), variables: Sys::Speeds::zero() }
        };
        let coarse = self.has_coarse_error.then(|| combination(h, &self.coarse_error, &stages));
        // A stage that is not finite makes the result so, because no later weight can take it out again.
        if !(end.q.is_finite() && end.y.is_finite() && error.is_finite() && last.is_finite()) {
            return Err(IntegrationErrorKind::NonFinite { part: RunPart::Step });
        }
        // The last stage is the result also on a group: its σ is the step's. Renormalising moves it by rounding only.
        let rates = self.first_same_as_last.then_some(last);
        Ok((Step { state: end, error, rates }, coarse))
    }
}

impl<Sys: GaussSystem, const S: usize> OneStep<Sys> for Rkmk<Sys::Scalar, S> {
    fn properties(&self) -> Properties {
        Properties::of_order(self.order)
    }

    /// Refuses stages that turn by more than π ([`IntegrationErrorKind::IncrementTooLarge`]), singularities of the
    /// coordinates ([`IntegrationErrorKind::SingularChart`]), and overflowing or undefined results
    /// ([`IntegrationErrorKind::NonFinite`]).
    #[inline]
    fn step<P: Problem<System = Sys>>(
        &self,
        problem: &P,
        state: &State<Sys>,
        rates: &Rates<Sys>,
        h: Sys::Scalar,
    ) -> Result<Step<Sys>, IntegrationErrorKind> {
        self.advance(problem, state, rates, h).map(|(step, _)| step)
    }
}

impl<Sys: GaussSystem, const S: usize> EstimatingStep<Sys> for Rkmk<Sys::Scalar, S> {
    fn estimate_order(&self) -> f64 {
        self.estimate_order
    }

    #[inline]
    fn step_and_estimates<P: Problem<System = Sys>>(
        &self,
        problem: &P,
        state: &State<Sys>,
        rates: &Rates<Sys>,
        h: Sys::Scalar,
    ) -> Result<(Step<Sys>, Option<Rates<Sys>>), IntegrationErrorKind> {
        self.advance(problem, state, rates, h)
    }
}

impl<Sys: GaussSystem, const S: usize> IncrementStep<Sys> for Rkmk<Sys::Scalar, S> {
    #[inline]
    fn increment<P: Problem<System = Sys>>(
        &self,
        problem: &P,
        state: &State<Sys>,
        rates: &Rates<Sys>,
        h: Sys::Scalar,
    ) -> Result<Rates<Sys>, IntegrationErrorKind> {
        let one = <Sys::Scalar as Real>::one();
        // Rounded coefficients, and rounded products of h with them, would make the same error in every step, which
        // adds up like n and not like √n. So coefficients come in two parts, h comes last, and Σ b k is k₁ + Σ b (k −
        // k₁). What is left of a rounded coefficient would be lost in sums that are rounded already; what is left of
        // its first half is not.
        let precise = |[head, tail]: [&[Sys::Scalar]; 2], stages: &[Rates<Sys>; S]| {
            let mut sum = combination(one, tail, stages);
            accumulate(&mut sum, one, head, stages);
            Rates { configuration: sum.configuration.scale(h), variables: sum.variables.scale(h) }
        };
        let (stages, _) = self.stages(problem, state, rates, h, |i, stages| {
            precise(self.a_parts[i].each_ref().map(|part| &part[..i]), stages)
        })?;
        let less_first = stages.map(|stage| Rates {
            configuration: stage.configuration.add_scaled(-one, &rates.configuration),
            variables: stage.variables.add_scaled(-one, &rates.variables),
        });
        let mut sum = precise(self.b_parts.each_ref().map(|part| &part[..]), &less_first);
        accumulate(&mut sum, h, &[one], &[*rates]);
        check_increment::<Sys>(&sum)?;
        Ok(sum)
    }
}

/// The first half of the digits of a coefficient; all of them for a scalar with more digits than `f64`.
fn head<T: Real>((p, q): Rational) -> T {
    if T::EPSILON < f64::EPSILON {
        return T::ratio(p, q);
    }
    let digits = if T::EPSILON > f64::EPSILON { f32::MANTISSA_DIGITS } else { f64::MANTISSA_DIGITS } / 2;
    T::from_f64(rounded_ratio(p, q, digits))
}

/// The rest of a coefficient that [`head`] leaves out, so that 80 binary digits of the coefficient are right.
fn tail<T: Real>((p, q): Rational) -> T {
    if T::EPSILON < f64::EPSILON {
        return T::zero();
    }
    let tail = f64::ratio(p, q) - head::<T>((p, q)).lane(0) + ratio_rest(p, q);
    // Halves, quarters, … are not rounded; of others, the sum and the rest.
    let rounding = if q.unsigned_abs().is_power_of_two() { 0.0 } else { f64::EPSILON * Real::abs(tail) };
    T::from_f64(tail).omitting(T::from_f64(rounding))
}

/// `h Σ wᵢ·stageᵢ`; null weights are passed over.
#[inline(always)]
fn combination<S: GaussSystem>(h: S::Scalar, weights: &[S::Scalar], stages: &[Rates<S>]) -> Rates<S> {
    let mut sum: Rates<S> = Rates { configuration: TangentOf::<S>::zero(), variables: S::Speeds::zero() };
    accumulate(&mut sum, h, weights, stages);
    sum
}

/// Adds `h Σ wᵢ·stageᵢ`.
#[inline(always)]
fn accumulate<S: GaussSystem>(sum: &mut Rates<S>, h: S::Scalar, weights: &[S::Scalar], stages: &[Rates<S>]) {
    for (&weight, stage) in weights.iter().zip(stages) {
        if weight != S::Scalar::zero() {
            let factor = h * weight;
            sum.configuration = sum.configuration.add_scaled(factor, &stage.configuration);
            sum.variables = sum.variables.add_scaled(factor, &stage.variables);
        }
    }
}
