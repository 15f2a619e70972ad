//! A commutator-free method: several exponentials instead of dexp⁻¹.

use crate::configuration::{Configuration, VectorSpace};
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::{IntegrationErrorKind, RunPart};
use crate::integrate::problem::state::{Rates, State, TangentOf};
use crate::integrate::step::checks::{check_chart, check_turn};
use crate::integrate::step::one_step::{OneStep, Properties, Step, check_contacts};
use crate::real::Real;
use crate::system::GaussSystem;

/// The method of order 4 of Celledoni, Marthinsen and Owren (*Commutator-free Lie group methods*, Future Generation
/// Computer Systems 19, 2003): four stages and five exponentials a step, no dexp⁻¹.
///
/// With V₁…V₄ the velocities of the stages, seen from the body, the stages are
/// `q₂ = q∘exp(½hV₁)`, `q₃ = q∘exp(½hV₂)`, `q₄ = q₂∘exp(h(V₃ − ½V₁))`, and the end is
/// `q∘exp(h(3V₁ + 2V₂ + 2V₃ − V₄)/12)∘exp(h(−V₁ + 2V₂ + 2V₃ + 3V₄)/12)`.
/// The variables y take the classical method of order 4, which is what remains on a linear space.
///
/// Explicit, and keeps nothing; errors are those of [`Rkmk`](crate::integrate::Rkmk) of order 4, nearly.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CommutatorFree4;

impl<S: GaussSystem> OneStep<S> for CommutatorFree4 {
    fn properties(&self) -> Properties {
        Properties::of_order(4)
    }

    /// Refuses exponentials that turn by more than π ([`IntegrationErrorKind::IncrementTooLarge`]), singularities of
    /// the coordinates ([`IntegrationErrorKind::SingularChart`]), and overflowing or undefined results
    /// ([`IntegrationErrorKind::NonFinite`]).
    #[inline]
    fn step<P: Problem<System = S>>(
        &self,
        problem: &P,
        state: &State<S>,
        rates: &Rates<S>,
        h: S::Scalar,
    ) -> Result<Step<S>, IntegrationErrorKind> {
        check_contacts(problem)?;
        let end = Path::new(state, rates, h, |_, stage| problem.rates(stage))?.end;
        check_chart(problem.system(), state, &end)?;
        // No stage has weight 0: what is not finite reaches the end.
        if !(end.q.is_finite() && end.y.is_finite()) {
            return Err(IntegrationErrorKind::NonFinite { part: RunPart::Step });
        }
        let error = Rates { configuration: TangentOf::<S>::zero(), variables: S::Speeds::zero() };
        Ok(Step { state: end, error, rates: None })
    }
}

/// The times of the stages after the start, over the step.
pub(in crate::integrate) const STAGE_TIMES: [(i64, i64); 4] = [(0, 1), (1, 2), (1, 2), (1, 1)];

/// The exponentials that a step consists of, and where it ends.
pub(in crate::integrate) struct Path<S: GaussSystem> {
    /// From the start to the second stage, to the third, from the second to the fourth; from the start to the end, in
    /// two.
    pub(in crate::integrate) increments: [TangentOf<S>; 5],
    pub(in crate::integrate) end: State<S>,
}

impl<S: GaussSystem> Path<S> {
    /// `rates(n, stage)` are those at the stages 1, 2 and 3, the first one being 0.
    #[inline(always)]
    pub(in crate::integrate) fn new(
        state: &State<S>,
        first: &Rates<S>,
        h: S::Scalar,
        mut rates: impl FnMut(usize, &State<S>) -> Rates<S>,
    ) -> Result<Self, IntegrationErrorKind> {
        let one = S::Scalar::one();
        let (half, third, sixth) = (h * S::Scalar::ratio(1, 2), h * S::Scalar::ratio(1, 3), h * S::Scalar::ratio(1, 6));
        let turned =
            |q: &S::Configuration, increment: &TangentOf<S>| check_turn::<S>(increment).map(|()| q.retract(increment));
        let middle = state.t + half;

        let to_second = first.configuration.scale(half);
        let early = turned(&state.q, &to_second)?;
        let second = rates(1, &State { t: middle, q: early, y: state.y.add_scaled(half, &first.variables) });
        let to_third = second.configuration.scale(half);
        let third_q = turned(&state.q, &to_third)?;
        let third_stage = rates(2, &State { t: middle, q: third_q, y: state.y.add_scaled(half, &second.variables) });
        let rest = third_stage.configuration.scale(h).add_scaled(-half, &first.configuration);
        let fourth = rates(
            3,
            &State { t: state.t + h, q: turned(&early, &rest)?, y: state.y.add_scaled(h, &third_stage.variables) },
        );

        let combined = |[a, b, c, d]: [S::Scalar; 4]| {
            let middle = second.configuration.scale(h * b).add_scaled(h * c, &third_stage.configuration);
            middle.add_scaled(h * a, &first.configuration).add_scaled(h * d, &fourth.configuration)
        };
        let [before, after] = halves();
        let (before, after) = (combined(before), combined(after));
        let change = first
            .variables
            .scale(sixth)
            .add_scaled(third, &second.variables)
            .add_scaled(third, &third_stage.variables)
            .add_scaled(sixth, &fourth.variables);
        let end = State {
            t: state.t + h,
            q: turned(&turned(&state.q, &before)?, &after)?.renormalise(),
            y: state.y.add_scaled(one, &change),
        };
        Ok(Self { increments: [to_second, to_third, rest, before, after], end })
    }
}

/// Weights of the velocities in the two exponentials that end a step; together those of the classical method.
#[inline(always)]
pub(in crate::integrate) fn halves<T: Real>() -> [[T; 4]; 2] {
    let (quarter, sixth, negative) = (T::ratio(1, 4), T::ratio(1, 6), T::ratio(-1, 12));
    [[quarter, sixth, sixth, negative], [negative, sixth, sixth, quarter]]
}

#[cfg(test)]
mod tests {
    use nalgebra::SVector;

    use super::*;
    use crate::integrate::SystemProblem;
    use crate::integrate::{Fixed, MomentumForm, NoInput, Rkmk, Simulation, Tableau, VelocityForm};
    use crate::simd::Lanes;
    use crate::testing::FreeTop;
    use crate::testing::constrained::{pendulum, pendulum_by_angle};
    use crate::testing::order::{TOP, TORQUE, distance, march, measured_order, start_by_momentum, start_by_velocity};

    #[test]
    fn order_4_in_both_forms() {
        let velocities = SystemProblem { system: &TOP, form: VelocityForm, input: TORQUE };
        let momenta = SystemProblem { system: &TOP, form: MomentumForm, input: TORQUE };
        let counts = [20, 40, 80, 160, 320];
        for order in [
            measured_order(&CommutatorFree4, &velocities, &start_by_velocity(), 4.0, &counts),
            measured_order(&CommutatorFree4, &momenta, &start_by_momentum(), 4.0, &counts),
        ] {
            assert!((order - 4.0).abs() < 0.15, "{order}");
        }
        assert_eq!(OneStep::<FreeTop<f64>>::properties(&CommutatorFree4), Properties::of_order(4));
    }

    /// Up to rounding: on a line all exponentials are additions.
    #[test]
    fn on_a_line_it_is_the_classical_method() {
        let system = pendulum_by_angle();
        let problem = SystemProblem { system: &system, form: VelocityForm, input: NoInput };
        let start = State { t: 0.0, q: SVector::from([1.0]), y: SVector::from([0.3]) };
        let found = march(&CommutatorFree4, &problem, &start, 4.0, 64);
        let classical = march(&Rkmk::new(&Tableau::RK4), &problem, &start, 4.0, 64);
        // 64 steps of some ten roundings of numbers up to 5, which the motion carries on hardly larger.
        assert!(distance(&found, &classical) < 64.0 * 10.0 * 5.0 * f64::EPSILON);
    }

    #[test]
    fn constraints_hold_in_every_sample() {
        let system = pendulum::<f64>(2.0);
        let end = Simulation::new(&system)
            .control(Fixed::by(CommutatorFree4, 0.01))
            .run_to_end(SVector::from([0.6, -0.8]), SVector::from([0.8, 0.6]), 0.0..2.0)
            .expect("runs");
        assert!((end.q.norm() - 1.0).abs() < 4.0 * f64::EPSILON && end.q.dot(&end.z).abs() < 1e-15 * end.z.norm());
    }

    #[test]
    fn too_long_steps_and_broken_inputs_are_refused() {
        let start = State { y: SVector::from([0.0, 0.0, 40.0]), ..start_by_velocity() };
        let problem = SystemProblem { system: &TOP, form: VelocityForm, input: TORQUE };
        let error = CommutatorFree4.step(&problem, &start, &problem.rates(&start), 0.2).err();
        assert!(
            matches!(error, Some(IntegrationErrorKind::IncrementTooLarge { angle }) if (angle - 4.0).abs() < 1e-12)
        );
        let broken =
            crate::integrate::Feedback(|t: f64, _: &_, _: &_| [if t > 0.05 { f64::NAN } else { 0.0 }, 0.0, 0.0]);
        let problem = SystemProblem { system: &TOP, form: VelocityForm, input: broken };
        let start = start_by_velocity();
        let error = CommutatorFree4.step(&problem, &start, &problem.rates(&start), 0.1).err();
        assert_eq!(error, Some(IntegrationErrorKind::NonFinite { part: RunPart::Step }));
    }

    #[test]
    fn runs_in_single_precision_and_in_packs() {
        let exact = {
            let problem = SystemProblem { system: &TOP, form: MomentumForm, input: crate::testing::order::NONE };
            march(&CommutatorFree4, &problem, &start_by_momentum(), 2.0, 40)
        };
        let single = FreeTop { inertia: [0.5_f32, 0.85, 1.0] };
        let start = start_by_velocity();
        let end = Simulation::new(&single)
            .momentum_form()
            .input(|_, _: &_, _: &_| [0.0; 3])
            .control(Fixed::by(CommutatorFree4, 0.05))
            .run_to_end(start.q.cast(), start.y.cast(), 0.0..2.0)
            .expect("runs");
        // 40 steps of some ten roundings.
        assert!((end.p.cast::<f64>() - exact.y).amax() < 400.0 * f64::from(f32::EPSILON));
        let both = |x: f64| Lanes([x, x]);
        let pack = FreeTop { inertia: [0.5, 0.85, 1.0].map(both) };
        let q = crate::triple::unit_quaternion(crate::triple::quaternion(&start.q).map(both));
        let end = Simulation::new(&pack)
            .momentum_form()
            .input(|_, _: &_, _: &_| [both(0.0); 3])
            .control(Fixed::by(CommutatorFree4, both(0.05)))
            .run_to_end(q, SVector::from(start.y.data.0[0].map(both)), both(0.0)..both(2.0))
            .expect("runs");
        for i in 0..3 {
            assert!((end.p[i].0[1] - exact.y[i]).abs() < 400.0 * f64::EPSILON);
        }
    }
}
