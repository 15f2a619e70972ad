//! A variational method on the group, for bodies in the left-invariant chart.

use crate::chart::Chart;
use crate::configuration::{Configuration, VectorSpace};
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::{IntegrationErrorKind, RunPart};
use crate::integrate::problem::state::{Rates, State};
use crate::integrate::step::checks::{check_chart, check_increment};
use crate::integrate::step::iteration::{Convergence, relative_change, worst};
use crate::integrate::step::one_step::{OneStep, Properties, Step, check_contacts};
use crate::real::Real;
use crate::system::GaussSystem;

/// The variational method of order 2 of the discrete Lagrangian `h T(ξ) − ½h V(q₀) − ½h V(q₁)`, `q₁ = q₀ ∘ exp(hξ)`,
/// for one body in the left-invariant chart: held at a point or free, added mass and all (J. E. Marsden & M. West, Acta
/// Numerica 10, 2001; N. Bou-Rabee & J. E. Marsden, *Hamilton–Pontryagin integrators on Lie groups*, Found. Comput.
/// Math. 9, 2009).
///
/// With p the momenta and f the generalised forces, both in body axes, and D± the maps `w ↦ dexp_inv(±hξ, w)`, a step
/// is `p⁺ = p₀ + ½h f(q₀, p₀)`, ξ from `D₋ᵀ M ξ = p⁺`, `q₁ = q₀ ∘ exp(hξ)`, `p₁ = D₊ᵀ M ξ + ½h f(q₁, p₁)`.
///
/// Where forces have a potential it is symplectic and keeps the momenta of the scene's symmetries to rounding: P and L
/// in space without forces, the angular momentum about the vertical of a top. Energy oscillates and does not drift.
/// Forces of any other kind are taken as they are, and the method stays symmetric and of order 2;
/// [`Composed`](crate::integrate::Composed) raises that.
///
/// ξ, and p₁ where forces depend on velocity, are found by fixed-point iteration down to rounding. Beyond a turn of
/// about 2 rad in a step, less for slender bodies, that ends with [`IntegrationErrorKind::NotConverged`]. Other charts,
/// where momenta are not those of the group, are refused when the program is compiled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Variational;

impl<S: GaussSystem> OneStep<S> for Variational
where
    S::Configuration: Configuration<Tangent = S::Speeds>,
{
    fn properties(&self) -> Properties {
        Properties { symmetric: true, symplectic: true, keeps_momentum: true, ..Properties::of_order(2) }
    }

    /// Refuses steps whose iteration does not converge ([`IntegrationErrorKind::NotConverged`]), that turn by more than
    /// π ([`IntegrationErrorKind::IncrementTooLarge`]), and overflowing or undefined results
    /// ([`IntegrationErrorKind::NonFinite`]).
    #[inline]
    fn step<P: Problem<System = S>>(
        &self,
        problem: &P,
        state: &State<S>,
        _: &Rates<S>,
        h: S::Scalar,
    ) -> Result<Step<S>, IntegrationErrorKind> {
        check_contacts(problem)?;
        const { assert!(matches!(S::CHART, Chart::LeftInvariant), "`Variational` needs the left-invariant chart") };
        let system = problem.system();
        let (one, half) = (S::Scalar::one(), h * S::Scalar::ratio(1, 2));
        let State { t, q, y } = state;

        let start = problem.momentum(*t, q, y);
        let pushed = start.add_scaled(half, &force(problem, *t, q, &start));
        // M is constant in this chart: neither time nor configuration matters to it.
        let mut xi = problem.speeds(*t, q, y);
        let mut momentum = system.momentum(*t, q, &xi);
        let size = pushed.max_norm();
        let mut progress = Convergence::new();
        loop {
            let defect = pushed.add_scaled(-one, &transposed::<S>(&xi.scale(-h), &momentum));
            xi = xi.add_scaled(one, &system.velocity(*t, q, &defect));
            momentum = system.momentum(*t, q, &xi);
            if progress.finished::<S::Scalar>(change::<S>(&S::Speeds::zero(), &defect, size))? {
                break;
            }
        }
        let increment = xi.scale(h);
        check_increment::<S>(&Rates { configuration: increment, variables: S::Speeds::zero() })?;

        let (t, q) = (*t + h, q.advance(&increment));
        let carried = transposed::<S>(&increment, &momentum);
        let mut end = carried;
        let mut progress = Convergence::new();
        loop {
            let next = carried.add_scaled(half, &force(problem, t, &q, &end));
            let residual = change::<S>(&end, &next, size.max(next.max_norm()));
            end = next;
            if progress.finished::<S::Scalar>(residual)? {
                break;
            }
        }
        // There and back momenta would be multiplied by I (1/I), the same rounding in every step.
        let y = problem.of_momentum(t, &q, &end);
        let reached = State { t, q, y };
        check_chart(problem.system(), state, &reached)?;
        if !(reached.q.is_finite() && reached.y.is_finite()) {
            return Err(IntegrationErrorKind::NonFinite { part: RunPart::Step });
        }
        let error = Rates { configuration: S::Speeds::zero(), variables: S::Speeds::zero() };
        Ok(Step { state: reached, error, rates: None })
    }
}

/// The loads in body axes: `ṗ − ad*_z p`, that is ṗ without the term of the rotating axes.
#[inline(always)]
fn force<S: GaussSystem, P: Problem<System = S>>(
    problem: &P,
    t: S::Scalar,
    q: &S::Configuration,
    p: &S::Speeds,
) -> S::Speeds
where
    S::Configuration: Configuration<Tangent = S::Speeds>,
{
    let z = problem.system().velocity(t, q, p);
    let input = problem.input(t, q, &z);
    let rate = problem.system().momentum_rate(t, q, p, &input);
    // [z, w] is the odd part of dexp_inv, twice.
    let (forward, backward) = (transposed::<S>(&z, p), transposed::<S>(&z.scale(-S::Scalar::one()), p));
    rate.add_scaled(-S::Scalar::one(), &forward).add_scaled(S::Scalar::one(), &backward)
}

/// `Dᵀ μ` with D the map `w ↦ dexp_inv(v, w)`.
#[inline(always)]
fn transposed<S: GaussSystem>(v: &S::Speeds, mu: &S::Speeds) -> S::Speeds
where
    S::Configuration: Configuration<Tangent = S::Speeds>,
{
    let mut result = S::Speeds::zero();
    for i in 0..S::Speeds::DIM {
        let mut unit = S::Speeds::zero();
        unit.set_component(i, S::Scalar::one());
        let image = S::Configuration::dexp_inv(v, &unit);
        let sum = (0..S::Speeds::DIM).fold(S::Scalar::zero(), |sum, j| mu.component(j).fma(image.component(j), sum));
        result.set_component(i, sum);
    }
    result
}

fn change<S: GaussSystem>(old: &S::Speeds, new: &S::Speeds, size: f64) -> f64 {
    (0..S::Speeds::DIM).fold(0.0, |result, i| worst(result, relative_change(old.component(i), new.component(i), size)))
}

#[cfg(test)]
mod tests {
    use nalgebra::SVector;

    use super::*;
    use crate::integrate::SystemProblem;
    use crate::integrate::{Composed, Composition, Feedback, Fixed, MomentumForm, Simulation, VelocityForm};
    use crate::testing::FreeTop;
    use crate::testing::order::{
        NONE, TOP, TORQUE, WEIGHT, distance, march, measured_order, start_by_momentum, start_by_velocity,
    };

    #[test]
    fn orders_alone_and_composed() {
        let velocities = SystemProblem { system: &TOP, form: VelocityForm, input: TORQUE };
        let momenta = SystemProblem { system: &TOP, form: MomentumForm, input: TORQUE };
        let (v, p) = (start_by_velocity(), start_by_momentum());
        let composed = Composed::new(&Composition::KAHAN_LI_6, Variational);
        for (expected, found) in [
            (2.0, measured_order(&Variational, &velocities, &v, 4.0, &[40, 80, 160, 320])),
            (2.0, measured_order(&Variational, &momenta, &p, 4.0, &[40, 80, 160, 320])),
            (6.0, measured_order(&composed, &momenta, &p, 4.0, &[20, 40, 80, 160])),
        ] {
            assert!((found - expected).abs() < 0.2, "{found} instead of {expected}");
        }
    }

    #[test]
    fn a_step_back_undoes_a_step() {
        let problem = SystemProblem { system: &TOP, form: MomentumForm, input: TORQUE };
        let start = State { t: 0.3, ..start_by_momentum() };
        for h in [0.05, 0.2, 0.4] {
            let there = march(&Variational, &problem, &start, h, 1);
            let found = distance(&march(&Variational, &problem, &there, -h, 1), &start);
            // Some thirty roundings each way, and what the iterations leave.
            assert!(found < 60.0 * f64::EPSILON, "h = {h}: {found:e}");
        }
    }

    /// The momenta that the scene keeps, to rounding: each step rounds them by a few ε of |p|, of both signs.
    #[test]
    fn momenta_are_kept_and_energy_does_not_drift() {
        let (steps, h) = (10_000_u32, 0.05);
        let walk = 4.0 * f64::EPSILON * f64::from(steps).sqrt();
        let start = start_by_momentum();
        let in_space = |state: &State<FreeTop<f64>>| state.q * state.y;
        let free = SystemProblem { system: &TOP, form: MomentumForm, input: NONE };
        let end = march(&Variational, &free, &start, h * f64::from(steps), steps);
        // The attitude is rounded as well.
        assert!(
            (in_space(&end) - in_space(&start)).amax() < 2.0 * walk,
            "{:e}",
            (in_space(&end) - in_space(&start)).amax()
        );

        let heavy = SystemProblem { system: &TOP, form: MomentumForm, input: WEIGHT };
        let energy = |state: &State<FreeTop<f64>>| {
            let z = TOP.velocity(0.0, &state.q, &state.y);
            TOP.kinetic_energy(0.0, &state.q, &z) + 0.6 * (state.q.inverse() * SVector::from([0.0, 0.0, 1.0]))[2]
        };
        let (first, vertical) = (energy(&start), in_space(&start)[2]);
        let (mut state, mut halves) = (start, [0.0_f64; 2]);
        for n in 0..steps {
            state = march(&Variational, &heavy, &state, h, 1);
            let worst = &mut halves[usize::from(2 * n >= steps)];
            *worst = worst.max((energy(&state) - first).abs());
        }
        let growth = (in_space(&state)[2] - vertical).abs();
        assert!(growth < 2.0 * walk, "{growth:e}");
        // Both halves of the run show the same oscillation, of order h².
        assert!(halves[1] < 1.2 * halves[0] && halves[0] < 4.0 * h * h, "{halves:?}");
    }

    #[test]
    fn what_cannot_be_solved_is_refused() {
        let run = |z: [f64; 3], h| {
            let run = Simulation::new(&TOP).input_from(NONE).control(Fixed::by(Variational, h));
            run.run_to_end(start_by_velocity().q, SVector::from(z), 0.0..1.0).map(|end| end.t)
        };
        let error = run([1.0, 30.0, 20.0], 0.2).expect_err("refused");
        let kind = error.kind;
        assert!(
            matches!(kind, IntegrationErrorKind::NotConverged { .. } | IntegrationErrorKind::NonFinite { .. }),
            "{error}"
        );
        let error = run([0.0, 0.0, 40.0], 0.1).expect_err("refused");
        assert!(matches!(error.kind, IntegrationErrorKind::IncrementTooLarge { .. }), "{error}");
        let broken = Feedback(|t: f64, _: &_, _: &_| [if t > 0.05 { f64::NAN } else { 0.0 }, 0.0, 0.0]);
        let run = Simulation::new(&TOP).input_from(broken).control(Fixed::by(Variational, 0.2));
        let start = start_by_velocity();
        let error = run.run_to_end(start.q, start.y, 0.0..1.0).map(|end| end.t).expect_err("refused");
        assert_eq!(error.kind, IntegrationErrorKind::NonFinite { part: RunPart::Step });
    }
}
