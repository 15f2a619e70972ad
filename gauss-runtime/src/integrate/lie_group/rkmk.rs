//! Runge–Kutta–Munthe-Kaas methods: a classical Runge–Kutta method in the algebra, one exponential a stage.
//!
//! With `q = q₀ ∘ exp(σ)` the kinematics become `σ̇ = dexp_inv(σ, V)` on a linear space, where any Runge–Kutta method keeps
//! its order (Munthe-Kaas 1999). Each step starts again at σ = 0, far from the singularity of dexp⁻¹ at 2π. On ℝⁿ exp is
//! addition and dexp⁻¹ the identity: the method is the Runge–Kutta method itself, operation by operation.

use crate::configuration::{Configuration, VectorSpace};
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::{IntegrationErrorKind, Part};
use crate::integrate::problem::state::{Rates, State, TangentOf};
use crate::integrate::runge_kutta::tableau::{Rational, Tableau, estimate_order};
use crate::integrate::step::checks::{check_chart, check_increment};
use crate::integrate::step::one_step::{EstimatingStep, IncrementStep, OneStep, Properties, Step};
use crate::real::Real;
use crate::system::GaussSystem;

/// An explicit Runge–Kutta–Munthe-Kaas method of S stages, its coefficients in the scalar T.
///
/// Steps need no memory beyond the stack.
#[derive(Clone, Copy, Debug)]
pub struct Rkmk<T, const S: usize> {
    a: [[T; S]; S],
    b: [T; S],
    /// Numerators and denominators of b.
    fractions: [(T, T); S],
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
        Self {
            a: tableau.a.each_ref().map(row),
            b: row(&tableau.b),
            fractions: tableau.b.map(|(p, q)| (T::from_f64(p as f64), T::from_f64(q as f64))),
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

    /// The derivatives at the stages in the algebra, and those of the last stage as they are.
    #[inline(always)]
    fn stages<Sys: GaussSystem<Scalar = T>, P: Problem<System = Sys>>(
        &self,
        problem: &P,
        state: &State<Sys>,
        rates: &Rates<Sys>,
        h: T,
    ) -> Result<([Rates<Sys>; S], Rates<Sys>), IntegrationErrorKind> {
        let one = <Sys::Scalar as Real>::one();
        // Derivatives in the algebra: dexp_inv(σ, V) and ẏ. At σ = 0 the former is V.
        let mut stages = [*rates; S];
        let mut last = *rates;
        for i in 1..S {
            let sigma = combination(h, &self.a[i][..i], &stages);
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
        let (stages, last) = self.stages(problem, state, rates, h)?;
        let sigma = combination(h, &self.b, &stages);
        check_increment::<Sys>(&sigma)?;
        let end: State<Sys> = State {
            t: state.t + h,
            q: state.q.retract(&sigma.configuration).renormalise(),
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
            return Err(IntegrationErrorKind::NonFinite { part: Part::Step });
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

    /// Refuses stages that turn by more than π ([`IntegrationErrorKind::IncrementTooLarge`]), singularities of the coordinates
    /// ([`IntegrationErrorKind::SingularChart`]), and what overflows or is undefined ([`IntegrationErrorKind::NonFinite`]).
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
        let (stages, _) = self.stages(problem, state, rates, h)?;
        // Rounded weights would make the same error in every step, which adds up like n and not like √n: of the size of a rounding
        // of h k where their sum is not 1, and h times that elsewhere. So Σ b k is k₁ + Σ b (k − k₁), and the fractions are
        // divided anew each time, with a rounding that varies.
        let mut sum: Rates<Sys> = Rates { configuration: TangentOf::<Sys>::zero(), variables: Sys::Speeds::zero() };
        for (&(p, q), stage) in self.fractions.iter().zip(&stages).skip(1) {
            let factor = h * p;
            add_quotient(&mut sum.configuration, factor, q, &stage.configuration, &rates.configuration);
            add_quotient(&mut sum.variables, factor, q, &stage.variables, &rates.variables);
        }
        sum.configuration = sum.configuration.add_scaled(h, &rates.configuration);
        sum.variables = sum.variables.add_scaled(h, &rates.variables);
        check_increment::<Sys>(&sum)?;
        Ok(sum)
    }
}

/// `h Σ wᵢ·stageᵢ`; null weights are passed over.
#[inline(always)]
fn combination<S: GaussSystem>(h: S::Scalar, weights: &[S::Scalar], stages: &[Rates<S>]) -> Rates<S> {
    let mut sum: Rates<S> = Rates { configuration: TangentOf::<S>::zero(), variables: S::Speeds::zero() };
    for (&weight, stage) in weights.iter().zip(stages) {
        if weight != S::Scalar::zero() {
            let factor = h * weight;
            sum.configuration = sum.configuration.add_scaled(factor, &stage.configuration);
            sum.variables = sum.variables.add_scaled(factor, &stage.variables);
        }
    }
    sum
}

/// Adds `factor·(x − origin)/divisor`.
#[inline(always)]
fn add_quotient<T: Real, V: VectorSpace<T>>(sum: &mut V, factor: T, divisor: T, x: &V, origin: &V) {
    for i in 0..V::DIM {
        let part = factor * (x.component(i) - origin.component(i)) / divisor;
        sum.set_component(i, sum.component(i) + part);
    }
}
