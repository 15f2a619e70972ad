//! Runge–Kutta methods on the components of the configuration, brought back onto the group at the end of each step.
//!
//! A configuration consists of numbers: the four of a quaternion, the three of a place in the observer's axes
//! ([`Configuration::Components`]). Their time derivatives are products of themselves and the velocity
//! ([`Configuration::component_rates`]), so they are integrated as those of any vector are. The equations continued
//! off the group in this way have a flow that stays on the group when it starts there, so the step ends off the
//! group by its local error at most, and bringing it back (a quaternion to norm 1) changes it by no more: the order is
//! that of the tableau (Hairer, Lubich & Wanner, *Geometric Numerical Integration*, IV.4, "standard projection
//! method").
//!
//! Compared with Runge–Kutta–Munthe-Kaas methods ([`rkmk`](crate::integrate::lie_group::rkmk)) of the same tableau a
//! stage needs neither exp nor dexp⁻¹. What is lost: a rotation of constant angular velocity is not exact, and stages
//! lie off the group by their own error. What the equations keep everywhere is kept to the last bit, as momenta with ṗ
//! ≡ 0 are; what they keep only because rotation matrices are orthogonal, as the total momentum of several bodies in
//! the observer's axes, is kept within the tolerance.
//!
//! The coefficients are constants of the type, and stages are written out one after the other: null weights leave no
//! trace in the code, and derivatives stay in registers where there are enough of them.

use crate::configuration::{Configuration, VectorSpace};
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::{IntegrationErrorKind, RunPart};
use crate::integrate::problem::state::{Rates, State, TangentOf};
use crate::integrate::runge_kutta::tableau::{Coefficients, Rational, estimate_order};
use crate::integrate::step::checks::{check_chart, check_turn};
use crate::integrate::step::one_step::{EstimatingStep, OneStep, Properties, Step, check_contacts};
use crate::real::Real;
use crate::system::GaussSystem;

/// The Runge–Kutta method of a tableau of S stages, at most 16, on the components of the configuration:
/// `RungeKutta(DormandPrince8)`. The tableau is a type, so that its numbers are known when the step is compiled; one of
/// your own is two lines ([`Coefficients`]).
///
/// Steps need no memory beyond the stack.
#[derive(Clone, Copy, Debug, Default)]
pub struct RungeKutta<C, const S: usize>(pub C)
where
    C: Coefficients<S>;

/// The components of a system's configuration.
pub type ComponentsOf<S> = <<S as GaussSystem>::Configuration as Configuration>::Components;

/// A point of the linear space in which a step is made, or a derivative there.
#[derive(Clone, Copy)]
pub struct Point<C, Y> {
    /// Part of the components of the configuration.
    pub components: C,
    /// Part of the quasi-velocities, or of the momenta.
    pub variables: Y,
}

impl<C, Y> Point<C, Y> {
    /// Zero.
    #[inline(always)]
    pub fn zero<T: Real>() -> Self
    where
        C: VectorSpace<T>,
        Y: VectorSpace<T>,
    {
        Self { components: C::zero(), variables: Y::zero() }
    }

    /// `self + a·x`.
    #[inline(always)]
    pub fn add_scaled<T: Real>(&self, a: T, x: &Self) -> Self
    where
        C: VectorSpace<T>,
        Y: VectorSpace<T>,
    {
        Self {
            components: self.components.add_scaled(a, &x.components),
            variables: self.variables.add_scaled(a, &x.variables),
        }
    }
}

/// A coefficient in the scalar of the system: the `f64` of the compiler where that is as good.
#[inline(always)]
fn coefficient<T: Real>(value: f64, (p, q): Rational) -> T {
    if T::EPSILON < f64::EPSILON {
        return T::ratio(p, q);
    }
    // Halves, quarters, … are not rounded.
    let rounding = if q.unsigned_abs().is_power_of_two() { 0.0 } else { 0.5 * f64::EPSILON * value.abs() };
    T::from_f64(value).omitting(T::from_f64(rounding))
}

/// Writes its body once for each number of a stage that a method can have, `$i` a constant: from the first stage on, or
/// from the second.
macro_rules! for_each_stage {
    (first, $i:ident => $body:block) => {
        for_each_stage!(@ $i $body 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15)
    };
    (second, $i:ident => $body:block) => {
        for_each_stage!(@ $i $body 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15)
    };
    (@ $i:ident $body:block $($number:literal)+) => {$({
        const $i: usize = $number;
        $body
    })+};
}

/// `$sum += weight·$stage`; nothing where the weight is null.
macro_rules! accumulate {
    ($sum:ident, $row:expr, $fractions:expr, $j:expr, $stages:ident) => {
        let weight = const { if $j < S { $row[$j % S] } else { 0.0 } };
        if weight != 0.0 {
            $sum = $sum.add_scaled(coefficient(weight, const { $fractions[$j % S] }), &$stages[$j % S]);
        }
    };
}

impl<C: Coefficients<S>, const S: usize> RungeKutta<C, S> {
    const STAGES: () = assert!(0 < S && S <= 16, "a tableau has 1 to 16 stages");

    /// The last stage that the result is made of.
    const LATEST: usize = {
        let mut stage = S - 1;
        while stage > 0 && C::TABLEAU.b[stage].0 == 0 {
            stage -= 1;
        }
        stage
    };

    #[inline(always)]
    fn advance<Sys: GaussSystem, P: Problem<System = Sys>>(
        problem: &P,
        state: &State<Sys>,
        rates: &Rates<Sys>,
        h: Sys::Scalar,
    ) -> Result<(Step<Sys>, Option<Rates<Sys>>), IntegrationErrorKind> {
        check_contacts(problem)?;
        const { Self::STAGES };
        let start: Point<ComponentsOf<Sys>, Sys::Speeds> =
            Point { components: state.q.components(), variables: state.y };
        let first = Point { components: state.q.component_rates(&rates.configuration), variables: rates.variables };
        let mut stages = [first; S];
        let (mut last, mut late) = (*rates, rates.configuration);
        for_each_stage!(second, I => {
            if I < S {
                let mut sum = Point::zero();
                for_each_stage!(first, J => {
                    if J < I {
                        accumulate!(sum, C::A[I % S], C::TABLEAU.a[I % S], J, stages);
                    }
                });
                let point = start.add_scaled(h, &sum);
                let time = const { C::TIMES[I % S] };
                let t = coefficient::<Sys::Scalar>(time, const { C::TABLEAU.c[I % S] }).fma(h, state.t);
                let q = Sys::Configuration::from_components(&point.components);
                // Where the last stage is the end of the step its derivatives are those of the next step.
                let q = if C::TABLEAU.first_same_as_last && I == S - 1 { q.renormalise() } else { q };
                last = problem.rates(&State { t, q, y: point.variables });
                if I == Self::LATEST {
                    late = last.configuration;
                }
                stages[I % S] =
                    Point { components: q.component_rates(&last.configuration), variables: last.variables };
            }
        });
        let (mut sum, mut error, mut coarse) = (Point::zero(), Point::zero(), Point::zero());
        for_each_stage!(first, J => {
            accumulate!(sum, C::WEIGHTS, C::TABLEAU.b, J, stages);
            accumulate!(error, C::ERROR, C::TABLEAU.error, J, stages);
            accumulate!(coarse, C::COARSE_ERROR, C::TABLEAU.coarse_error, J, stages);
        });

        // The turn of the step by the trapezoidal rule.
        let turn = rates.configuration.add_scaled(Sys::Scalar::one(), &late);
        check_turn::<Sys>(&turn.scale(Sys::Scalar::ratio(1, 2) * h))?;
        let point = start.add_scaled(h, &sum);
        // What the rounding of the step before left of norms goes away with the rounding of this one.
        let change = state.q.norm_correction().add_scaled(h, &sum.components);
        let components = start.components.add_scaled(Sys::Scalar::one(), &change);
        let q = Sys::Configuration::from_components(&components).renormalise();
        let end = State { t: state.t + h, q, y: point.variables };
        check_chart(problem.system(), state, &end)?;
        let tangent = |sum: &Point<ComponentsOf<Sys>, Sys::Speeds>| Rates::<Sys> {
            configuration: q.tangent(&sum.components).scale(h),
            variables: sum.variables.scale(h),
        };
        let none = Rates { configuration: TangentOf::<Sys>::zero(), variables: Sys::Speeds::zero() };
        let error = if const { C::TABLEAU.embedded_order > 0 } { tangent(&error) } else { none };
        let coarse = const { C::TABLEAU.coarse_order > 0 }.then(|| tangent(&coarse));
        let rates = C::TABLEAU.first_same_as_last.then_some(last);
        // A stage that is not finite makes the result so, because no later weight can take it out again.
        if !(end.q.is_finite() && end.y.is_finite() && rates.is_none_or(|rates| rates.is_finite())) {
            return Err(IntegrationErrorKind::NonFinite { part: RunPart::Step });
        }
        Ok((Step { state: end, error, rates }, coarse))
    }
}

impl<Sys: GaussSystem, C: Coefficients<S>, const S: usize> OneStep<Sys> for RungeKutta<C, S> {
    fn properties(&self) -> Properties {
        Properties::of_order(C::TABLEAU.order)
    }

    /// Refuses steps that turn by more than π ([`IntegrationErrorKind::IncrementTooLarge`]; the angle is that of the
    /// mean of the velocities at the start and at the last stage of the result), singularities of the coordinates
    /// ([`IntegrationErrorKind::SingularChart`]), and overflowing or undefined results
    /// ([`IntegrationErrorKind::NonFinite`]).
    #[inline]
    fn step<P: Problem<System = Sys>>(
        &self,
        problem: &P,
        state: &State<Sys>,
        rates: &Rates<Sys>,
        h: Sys::Scalar,
    ) -> Result<Step<Sys>, IntegrationErrorKind> {
        Self::advance(problem, state, rates, h).map(|(step, _)| step)
    }
}

impl<Sys: GaussSystem, C: Coefficients<S>, const S: usize> EstimatingStep<Sys> for RungeKutta<C, S> {
    fn estimate_order(&self) -> f64 {
        estimate_order(&C::TABLEAU)
    }

    // Into the loop of steps, so that states stay in registers between them.
    #[inline(always)]
    fn step_and_estimates<P: Problem<System = Sys>>(
        &self,
        problem: &P,
        state: &State<Sys>,
        rates: &Rates<Sys>,
        h: Sys::Scalar,
    ) -> Result<(Step<Sys>, Option<Rates<Sys>>), IntegrationErrorKind> {
        let (step, coarse) = Self::advance(problem, state, rates, h)?;
        if !step.error.is_finite() {
            return Err(IntegrationErrorKind::NonFinite { part: RunPart::Step });
        }
        Ok((step, coarse))
    }
}

#[cfg(test)]
#[path = "components_tests.rs"]
mod tests;
