//! Composition: a symmetric method made more accurate by steps of several lengths, some of them backwards.

use crate::configuration::VectorSpace;
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::IntegrationErrorKind;
use crate::integrate::problem::state::{Rates, State, TangentOf};
use crate::integrate::runge_kutta::tableau::{Rational, decimal};
use crate::integrate::step::one_step::{OneStep, Properties, Step};
use crate::real::Real;
use crate::system::GaussSystem;

/// The lengths of N steps in one, as parts of it: they read the same backwards, and their sum is exactly 1.
///
/// The order is that which a symmetric method of order 2 gets. Errors are smaller with more steps than are needed for
/// the order: the 9 of Kahan and Li rather than Yoshida's 7.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Composition<const N: usize> {
    /// γ₁…γ_N.
    pub weights: [Rational; N],
    /// The order reached from a symmetric method of order 2.
    pub order: u32,
}

/// The middle weight makes the sum 1; 18 decimals.
const fn symmetric<const N: usize>(first: &[i64], order: u32) -> Composition<N> {
    let mut weights = [(0, 1); N];
    let mut left = 10_i64.pow(18);
    let mut i = 0;
    while i < first.len() {
        weights[i] = decimal(first[i], 18);
        weights[N - 1 - i] = weights[i];
        left -= 2 * first[i];
        i += 1;
    }
    weights[first.len()] = decimal(left, 18);
    Composition { weights, order }
}

impl<const N: usize> Composition<N> {
    /// The weights as the nearest doubles, or their neighbours.
    #[must_use]
    pub const fn doubles(&self) -> [f64; N] {
        let mut doubles = [0.0; N];
        let mut i = 0;
        while i < N {
            doubles[i] = self.weights[i].0 as f64 / self.weights[i].1 as f64;
            i += 1;
        }
        doubles
    }
}

impl Composition<9> {
    /// W. Kahan and R.-C. Li, Math. Comp. 66 (1997): nine steps of order 6.
    pub const KAHAN_LI_6: Self = symmetric(
        &[392_161_444_007_314_139, 332_599_136_789_359_439, -706_246_172_557_639_360, 82_213_596_293_550_800],
        6,
    );
}

impl Composition<17> {
    /// W. Kahan and R.-C. Li, Math. Comp. 66 (1997): seventeen steps of order 8.
    pub const KAHAN_LI_8: Self = symmetric(
        &[
            130_202_483_088_890_081,
            561_162_981_775_108_385,
            -389_474_962_644_847_286,
            158_841_906_555_155_601,
            -395_903_894_133_237_577,
            184_539_640_978_315_707,
            258_374_387_686_322_047,
            295_011_723_609_310_299,
        ],
        8,
    );
}

/// A method composed with itself: N of its steps, of the lengths γ₁h…γ_Nh, are one step.
///
/// What the method keeps is kept. A symmetric method reaches the order of the composition (or stays at its own where
/// that is higher); one that is not symmetric is not promised more than it has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Composed<M, T, const N: usize> {
    method: M,
    weights: [T; N],
    order: u32,
}

impl<M, T: Real, const N: usize> Composed<M, T, N> {
    /// A method by a composition, for example
    /// `Composed::new(&Composition::KAHAN_LI_6, Collocation::midpoint())`.
    #[must_use]
    pub fn new(composition: &Composition<N>, method: M) -> Self {
        Self { method, weights: composition.weights.map(|(p, q)| T::ratio(p, q)), order: composition.order }
    }
}

impl<S: GaussSystem, M: OneStep<S>, const N: usize> OneStep<S> for Composed<M, S::Scalar, N> {
    fn properties(&self) -> Properties {
        let method = self.method.properties();
        Properties { order: if method.symmetric { method.order.max(self.order) } else { method.order }, ..method }
    }

    /// The errors of the method, in any of its steps.
    #[inline]
    fn step<P: Problem<System = S>>(
        &self,
        problem: &P,
        state: &State<S>,
        rates: &Rates<S>,
        h: S::Scalar,
    ) -> Result<Step<S>, IntegrationErrorKind> {
        let mut reached = *state;
        let mut given = Some(*rates);
        for &weight in &self.weights {
            let rates = given.unwrap_or_else(|| problem.rates(&reached));
            let step = self.method.step(problem, &reached, &rates, weight * h)?;
            (reached, given) = (step.state, step.rates);
        }
        reached.t = state.t + h;
        let error = Rates { configuration: TangentOf::<S>::zero(), variables: S::Speeds::zero() };
        Ok(Step { state: reached, error, rates: given })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integrate::SystemProblem;
    use crate::integrate::{Collocation, CommutatorFree4, Fixed, MomentumForm, Simulation, VelocityForm};
    use crate::testing::order::{
        NONE, TOP, TORQUE, distance, march, measured_order, start_by_momentum, start_by_velocity,
    };

    /// One of a user's own: γ₁ = γ₂ = 1/(4 − ∛4), M. Suzuki, Phys. Lett. A 146 (1990).
    const SUZUKI_4: Composition<5> = symmetric(&[414_490_771_794_375_737; 2], 4);

    /// The sum is 1 in integers; the sums of powers that every method of the order needs vanish (Hairer, Lubich &
    /// Wanner, *Geometric Numerical Integration*, V.3.2): `Σγ³ = 0` for order 4, `Σγ⁵ = 0` for 6, `Σγ⁷ = 0` for 8.
    fn check<const N: usize>(composition: &Composition<N>) {
        let one = 10_i64.pow(18);
        assert_eq!(composition.weights.iter().map(|&(p, _)| p).sum::<i64>(), one);
        assert!(composition.weights.iter().all(|&(_, q)| q == one));
        let backwards: [Rational; N] = core::array::from_fn(|i| composition.weights[N - 1 - i]);
        assert_eq!(composition.weights, backwards);
        let weights = composition.doubles();
        for power in (3..composition.order as i32).step_by(2) {
            let sum: f64 = weights.iter().map(|w| w.powi(power)).sum();
            // Each weight is rounded twice, which its power multiplies, and each sum once.
            let size: f64 = weights.iter().map(|w| w.powi(power).abs()).sum();
            assert!(sum.abs() < f64::from(2 * power + N as i32) * f64::EPSILON * size, "{power}: {sum:e}");
        }
    }

    #[test]
    fn weights_satisfy_the_conditions_on_powers() {
        check(&SUZUKI_4);
        check(&Composition::KAHAN_LI_6);
        check(&Composition::KAHAN_LI_8);
    }

    fn order_from<M: OneStep<crate::testing::FreeTop<f64>>, const N: usize>(
        composition: &Composition<N>,
        method: M,
        counts: &[u32],
    ) -> (u32, f64) {
        let composed = Composed::new(composition, method);
        let properties = composed.properties();
        let velocities = SystemProblem { system: &TOP, form: VelocityForm, input: TORQUE };
        (properties.order, measured_order(&composed, &velocities, &start_by_velocity(), 2.0, counts))
    }

    #[test]
    fn orders_are_raised() {
        let midpoint = Collocation::midpoint();
        for (stated, found) in [
            order_from(&Composition::KAHAN_LI_6, midpoint, &[10, 20, 40, 80]),
            order_from(&Composition::KAHAN_LI_8, midpoint, &[4, 6, 8, 12, 16]),
            order_from(&Composition::KAHAN_LI_6, Collocation::order_4(), &[4, 8, 16, 32]),
            order_from(&SUZUKI_4, midpoint, &[10, 20, 40, 80]),
            // Not symmetric: what it had.
            order_from(&SUZUKI_4, CommutatorFree4, &[10, 20, 40, 80]),
        ] {
            assert!((found - f64::from(stated)).abs() < 0.3, "{found} instead of {stated}");
        }
        let stated = |properties: Properties| (properties.order, properties.symmetric);
        type Top = crate::testing::FreeTop<f64>;
        let composed = Composed::<_, f64, 9>::new(&Composition::KAHAN_LI_6, Collocation::midpoint());
        assert_eq!(stated(OneStep::<Top>::properties(&composed)), (6, true));
        let low = Composed::<_, f64, 5>::new(&SUZUKI_4, Collocation::order_6());
        assert_eq!(stated(OneStep::<Top>::properties(&low)), (6, true));
        let not = Composed::<_, f64, 9>::new(&Composition::KAHAN_LI_6, CommutatorFree4);
        assert_eq!(stated(OneStep::<Top>::properties(&not)), (4, false));
    }

    #[test]
    fn symmetry_and_integrals_are_inherited() {
        let method = Composed::new(&Composition::KAHAN_LI_6, Collocation::midpoint());
        let problem = SystemProblem { system: &TOP, form: VelocityForm, input: TORQUE };
        let start = start_by_velocity();
        let there = march(&method, &problem, &start, 0.4, 1);
        // As for one step of the midpoint rule, nine times there and nine back.
        assert!(distance(&march(&method, &problem, &there, -0.4, 1), &start) < 9.0 * 60.0 * f64::EPSILON);
        assert_eq!(there.t, 0.4);

        let free = SystemProblem { system: &TOP, form: MomentumForm, input: NONE };
        let end = march(&method, &free, &start_by_momentum(), 200.0, 1000);
        // A walk of 9000 steps of 2ε.
        let walk = 2.0 * f64::EPSILON * 9000_f64.sqrt();
        assert!((end.y.norm_squared() / start_by_momentum().y.norm_squared() - 1.0).abs() < 2.0 * walk);
    }

    #[test]
    fn what_the_method_refuses_is_refused() {
        let method = Composed::new(&Composition::KAHAN_LI_6, Collocation::midpoint());
        let fast = nalgebra::SVector::from([0.0, 0.0, 40.0]);
        let run = Simulation::new(&TOP).input_from(NONE).control(Fixed::by(method, 0.25));
        let error = run.run_to_end(start_by_velocity().q, fast, 0.0..1.0).map(|end| end.t).expect_err("refused");
        assert!(matches!(error.kind, IntegrationErrorKind::IncrementTooLarge { .. }), "{error}");
        assert_eq!(error.time, 0.0);
    }
}
