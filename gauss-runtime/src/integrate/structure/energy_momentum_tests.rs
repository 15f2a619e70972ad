//! What the energy–momentum method keeps, and how accurate it is, on a top typed by hand.

use nalgebra::Vector3;

use super::*;
use crate::integrate::SystemProblem;
use crate::integrate::{Compensated, Composed, Composition, Feedback, Fixed, MomentumForm, Simulation, VelocityForm};
use crate::testing::FreeTop;
use crate::testing::order::{
    NONE, TOP, TORQUE, WEIGHT, distance, march, measured_order, start_by_momentum, start_by_velocity,
};

fn method() -> EnergyMomentum<f64> {
    EnergyMomentum::new()
}

#[test]
fn orders_alone_and_composed() {
    let velocities = SystemProblem { system: &TOP, form: VelocityForm, input: TORQUE };
    let momenta = SystemProblem { system: &TOP, form: MomentumForm, input: TORQUE };
    let (v, p) = (start_by_velocity(), start_by_momentum());
    let composed = Composed::new(&Composition::KAHAN_LI_6, method());
    let five = EnergyMomentum::<f64, 5>::with_points();
    for (expected, found) in [
        (2.0, measured_order(&method(), &velocities, &v, 4.0, &[40, 80, 160, 320])),
        (2.0, measured_order(&method(), &momenta, &p, 4.0, &[40, 80, 160, 320])),
        (2.0, measured_order(&five, &momenta, &p, 4.0, &[40, 80, 160, 320])),
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
        let there = march(&method(), &problem, &start, h, 1);
        let found = distance(&march(&method(), &problem, &there, -h, 1), &start);
        // Some thirty roundings each way, and what the iterations leave.
        assert!(found < 60.0 * f64::EPSILON, "h = {h}: {found:e}");
    }
}

/// Polynomials of degree 2N − 1 by the rule, `∫ x^k dx` over (−½, ½); with double-double coefficients not needed here.
#[test]
fn points_are_those_of_gauss() {
    fn check<const N: usize>() {
        let EnergyMomentum { offsets, weights, .. } = EnergyMomentum::<f64, N>::with_points();
        for k in 0..2 * N {
            let sum: f64 = offsets.iter().zip(&weights).map(|(x, w)| w * x.powi(k as i32)).sum();
            let exact = if k % 2 == 1 { 0.0 } else { 0.5_f64.powi(k as i32) / (k as f64 + 1.0) };
            assert!((sum - exact).abs() < 4.0 * f64::EPSILON * 0.5_f64.powi(k as i32), "{N} {k}: {sum} {exact}");
        }
    }
    check::<2>();
    check::<3>();
    check::<4>();
    check::<6>();
    check::<7>();
}

/// cos θs and sin θs about the middle, θ from nothing to π.
#[test]
fn what_turns_with_the_body_is_integrated_exactly() {
    for theta in [0.0_f64, 1e-300, 1e-9, 1e-3, 0.4, 1.0, 2.5, core::f64::consts::PI] {
        let c = method().spread(theta * theta);
        let exact = if theta == 0.0 { 1.0 } else { (0.5 * theta).sin() / (0.5 * theta) };
        assert!(((theta * c).cos() - exact).abs() <= 2.0 * f64::EPSILON, "{theta}: {c}");
    }
    assert!((method().spread(0.0) - (1.0_f64 / 12.0).sqrt()).abs() < f64::EPSILON);
}

type TopState = State<FreeTop<f64>>;

fn in_space(state: &TopState) -> Vector3<f64> {
    state.q * state.y
}

/// |slope| of a line through the deviations of evenly spaced samples, per step.
fn slope(samples: &[f64], steps: u32) -> f64 {
    let n = samples.len() as f64;
    let mean = samples.iter().sum::<f64>() / n;
    let middle = 0.5 * (n - 1.0);
    let (mut over, mut under) = (0.0, 0.0);
    for (i, sample) in samples.iter().enumerate() {
        over += (i as f64 - middle) * (sample - mean);
        under += (i as f64 - middle).powi(2);
    }
    (over / under).abs() * n / f64::from(steps)
}

/// 10⁵ steps: the largest deviation of what is kept is a walk of roundings, and has no slope beyond that of a walk.
fn stays<const K: usize>(
    method: &impl OneStep<FreeTop<f64>>,
    input: Feedback<crate::testing::order::Torque>,
    kept: impl Fn(&TopState) -> [f64; K],
    h: f64,
    roundings: f64,
) {
    let (steps, every) = (100_000_u32, 1000);
    let problem = SystemProblem { system: &TOP, form: MomentumForm, input };
    let mut state = start_by_momentum();
    let first = kept(&state);
    let mut deviations = [const { std::vec::Vec::new() }; K];
    for _ in 0..steps / every {
        state = march(method, &problem, &state, f64::from(every) * h, every);
        for (all, (now, then)) in deviations.iter_mut().zip(kept(&state).into_iter().zip(first)) {
            all.push(now - then);
        }
    }
    let walk = roundings * f64::EPSILON * f64::from(steps).sqrt();
    for all in &deviations {
        let worst = all.iter().fold(0.0_f64, |m, d| m.max(d.abs()));
        assert!(worst < walk, "{worst:e} {walk:e}");
        // A walk that ends at w has a slope of about w over its steps.
        assert!(slope(all, steps) < walk / f64::from(steps), "{:e}", slope(all, steps));
    }
}

/// The energy of [`WEIGHT`], and momentum in space.
fn heavy(state: &TopState) -> [f64; 2] {
    let z = TOP.velocity(0.0, &state.q, &state.y);
    let up = state.q.inverse() * Vector3::z();
    [TOP.kinetic_energy(0.0, &state.q, &z) + 0.6 * up[2], in_space(state)[2]]
}

#[test]
fn free_bodies_keep_energy_and_momentum() {
    let kept = |state: &TopState| {
        let z = TOP.velocity(0.0, &state.q, &state.y);
        let l = in_space(state);
        [TOP.kinetic_energy(0.0, &state.q, &z), l[0], l[1], l[2]]
    };
    stays(&method(), NONE, kept, 0.05, 4.0);
}

#[test]
fn heavy_bodies_keep_energy_and_the_vertical_momentum() {
    stays(&method(), WEIGHT, heavy, 0.05, 4.0);
    // Nine steps in one, each with its rounding.
    stays(&Composed::new(&Composition::KAHAN_LI_6, method()), WEIGHT, heavy, 0.2, 12.0);
}

/// V = (e₃·k)² + ½ (e₁·k)³: neither linear in the axes nor smooth enough for few points, and still symmetric about k.
const CURVED: Feedback<crate::testing::order::Torque> = Feedback(|_, q, _| {
    let up = q.inverse() * Vector3::z();
    // Torque up × ∂V/∂up.
    let slope = Vector3::new(1.5 * up[0] * up[0], 0.0, 2.0 * up[2]);
    up.cross(&slope).into()
});

fn curved(state: &TopState) -> [f64; 2] {
    let z = TOP.velocity(0.0, &state.q, &state.y);
    let up = state.q.inverse() * Vector3::z();
    let potential = up[2] * up[2] + 0.5 * up[0].powi(3);
    [TOP.kinetic_energy(0.0, &state.q, &z) + potential, in_space(state)[2]]
}

#[test]
fn other_potentials_are_kept_with_more_points() {
    stays(&EnergyMomentum::<f64, 6>::with_points(), CURVED, curved, 0.05, 4.0);
    // With two points momentum is kept as well, energy to order h⁴ and without drift.
    stays(&method(), CURVED, |state| [curved(state)[1]], 0.05, 4.0);
    let problem = SystemProblem { system: &TOP, form: MomentumForm, input: CURVED };
    let largest = |h: f64| {
        let (mut state, mut halves) = (start_by_momentum(), [0.0_f64; 2]);
        let steps = (400.0 / h) as u32;
        for n in 0..steps {
            state = march(&method(), &problem, &state, h, 1);
            let worst = &mut halves[usize::from(2 * n >= steps)];
            *worst = worst.max((curved(&state)[0] - curved(&start_by_momentum())[0]).abs());
        }
        assert!(halves[1] < 1.5 * halves[0], "{halves:?}");
        halves[0]
    };
    let order = (largest(0.2) / largest(0.1)).log2();
    assert!((order - 4.0).abs() < 0.5, "{order}");
}

/// Increments are what a step adds, and carried they make less rounding.
#[test]
fn increments_add_up_to_the_step() {
    for (form_start, h) in [(start_by_momentum(), 0.1), (State { t: 1.0, ..start_by_momentum() }, -0.3)] {
        let problem = SystemProblem { system: &TOP, form: MomentumForm, input: TORQUE };
        let rates = problem.rates(&form_start);
        let step = method().step(&problem, &form_start, &rates, h).expect("steps").state;
        let Rates { configuration, variables } = method().increment(&problem, &form_start, &rates, h).expect("steps");
        let again = State { t: step.t, q: form_start.q.retract(&configuration), y: form_start.y + variables };
        assert!(distance(&step, &again) < 4.0 * f64::EPSILON);
    }
    let run = |control| Simulation::new(&TOP).input_from(NONE).momentum_form().control(control);
    let start = start_by_velocity();
    let end = run(Compensated::by(method(), 0.05)).run_to_end(start.q, start.y, 0.0..5000.0).expect("runs");
    let drift = (end.q * end.p - start.q * TOP.momentum(0.0, &start.q, &start.y)).amax();
    // One rounding of q and p at the end, and a walk of √n h ε.
    assert!(drift < (4.0 + 0.05 * 4.0 * 100_000_f64.sqrt()) * f64::EPSILON, "{drift:e}");
}

#[test]
fn what_cannot_be_solved_is_refused() {
    let run = |z: [f64; 3], h| {
        let run = Simulation::new(&TOP).input_from(NONE).control(Fixed::by(method(), h));
        run.run_to_end(start_by_velocity().q, SVector::from(z), 0.0..1.0).map(|end| end.t)
    };
    let error = run([1.0, 60.0, 40.0], 0.2).expect_err("refused");
    assert!(
        matches!(
            error.kind,
            IntegrationErrorKind::NotConverged { .. } | IntegrationErrorKind::IncrementTooLarge { .. }
        ),
        "{error}"
    );
    let error = run([0.0, 0.0, 40.0], 0.1).expect_err("refused");
    assert!(matches!(error.kind, IntegrationErrorKind::IncrementTooLarge { .. }), "{error}");
    let broken = Feedback(|t: f64, _: &_, _: &_| [if t > 0.05 { f64::NAN } else { 0.0 }, 0.0, 0.0]);
    let run = Simulation::new(&TOP).input_from(broken).control(Fixed::by(method(), 0.2));
    let start = start_by_velocity();
    let error = run.run_to_end(start.q, start.y, 0.0..1.0).map(|end| end.t).expect_err("refused");
    assert_eq!(error.kind, IntegrationErrorKind::NonFinite { part: Part::Step });
}
