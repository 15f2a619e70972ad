//! Gauss' methods on the group: orders, symmetry, what they keep over long runs, refusals.

use core::cell::Cell;

use nalgebra::{SVector, UnitQuaternion};
use std::string::ToString;
use std::vec::Vec;

use crate::integrate::*;
use crate::simd::Lanes;
use crate::system::GaussSystem;
use crate::testing::FreeTop;
use crate::testing::constrained::{GRAVITY, pendulum, pendulum_by_angle};
use crate::testing::order::{
    NONE, TOP, TORQUE, WEIGHT, distance, march, measured_order, start_by_momentum, start_by_velocity,
};
use crate::testing::oscillator::{Oscillator, Viscous};

type Top = FreeTop<f64>;

fn methods() -> (Collocation<f64, 1>, Collocation<f64, 2>, Collocation<f64, 3>) {
    (Collocation::midpoint(), Collocation::order_4(), Collocation::order_6())
}

#[test]
fn orders_in_both_forms() {
    let velocities = SystemProblem { system: &TOP, form: VelocityForm, input: TORQUE };
    let momenta = SystemProblem { system: &TOP, form: MomentumForm, input: TORQUE };
    let (two, four, six) = methods();
    let counts = [10, 20, 40, 80, 160];
    let (v, p) = (start_by_velocity(), start_by_momentum());
    for (expected, found) in [
        (2.0, measured_order(&two, &velocities, &v, 4.0, &counts)),
        (2.0, measured_order(&two, &momenta, &p, 4.0, &counts)),
        (4.0, measured_order(&four, &velocities, &v, 4.0, &counts)),
        (4.0, measured_order(&four, &momenta, &p, 4.0, &counts)),
        (6.0, measured_order(&six, &velocities, &v, 4.0, &counts)),
        (6.0, measured_order(&six, &momenta, &p, 4.0, &counts)),
    ] {
        assert!((found - expected).abs() < 0.15, "{found} instead of {expected}");
    }
    for (order, properties) in [
        (2, OneStep::<Top>::properties(&two)),
        (4, OneStep::<Top>::properties(&four)),
        (6, OneStep::<Top>::properties(&six)),
    ] {
        assert_eq!(properties, Properties { symmetric: true, ..Properties::of_order(order) });
    }
}

/// A step and a step back, each some ten roundings a stage, and what the iteration leaves.
fn there_and_back(method: &impl OneStep<Top>, h: f64) -> f64 {
    let problem = SystemProblem { system: &TOP, form: VelocityForm, input: TORQUE };
    let start = State { t: 0.3, ..start_by_velocity() };
    let there = march(method, &problem, &start, h, 1);
    let back = march(method, &problem, &there, -h, 1);
    distance(&start, &back)
}

#[test]
fn a_step_back_undoes_a_step() {
    let (two, four, six) = methods();
    for h in [0.05, 0.2, 0.5] {
        for found in [there_and_back(&two, h), there_and_back(&four, h), there_and_back(&six, h)] {
            assert!(found < 60.0 * f64::EPSILON, "h = {h}: {found:e}");
        }
        // A method that is not symmetric leaves its error.
        assert!(there_and_back(&CommutatorFree4, h) > 1e-10);
    }
}

/// The largest change of a quantity over a run in momentum form, and the change that the least-squares line through it
/// makes from the start to the end of the run; both relative to its first value.
fn drift(
    method: &impl OneStep<Top>,
    problem: &SystemProblem<'_, Top, MomentumForm, impl InputSource<Top>>,
    h: f64,
    steps: u32,
    quantity: impl Fn(&State<Top>) -> f64,
) -> (f64, f64) {
    let mut state = start_by_momentum();
    let first = quantity(&state);
    let (mut largest, mut weighted, mut squares) = (0.0_f64, 0.0, 0.0);
    for n in 1..=steps {
        state = march(method, problem, &state, h, 1);
        let change = quantity(&state) / first - 1.0;
        let centred = f64::from(n) / f64::from(steps) - 0.5;
        largest = largest.max(change.abs());
        weighted += centred * change;
        squares += centred * centred;
    }
    (largest, weighted / squares)
}

fn kinetic(state: &State<Top>) -> f64 {
    let z = TOP.velocity(0.0, &state.q, &state.y);
    TOP.kinetic_energy(0.0, &state.q, &z)
}

#[test]
fn quadratic_integrals_of_the_free_body_are_kept_to_rounding() {
    let free = SystemProblem { system: &TOP, form: MomentumForm, input: NONE };
    let (two, four, six) = methods();
    let (steps, h) = (10_000, 0.2);
    // Each step rounds the three components of π, which are at most |π|: by less than 2ε|π|² in |π|², and as much of T
    // (inertias within a factor 2, so four times that). Such errors are of both signs: a walk of √n steps of that size.
    let walk = 2.0 * f64::EPSILON * f64::from(steps).sqrt();
    let square = |state: &State<Top>| state.y.norm_squared();
    for ((size, _), (energy, slope)) in [
        (drift(&two, &free, h, steps, square), drift(&two, &free, h, steps, kinetic)),
        (drift(&four, &free, h, steps, square), drift(&four, &free, h, steps, kinetic)),
        (drift(&six, &free, h, steps, square), drift(&six, &free, h, steps, kinetic)),
    ] {
        assert!(size < 2.0 * walk && energy < 8.0 * walk && slope.abs() < 8.0 * walk, "{size:e} {energy:e} {slope:e}");
    }
    let (energy, _) = drift(&Rkmk::new(&Tableau::RK4), &free, h, steps, kinetic);
    assert!(energy > 1e6 * walk, "{energy:e}");
}

/// A symmetric top under a weight: the motion is integrable and reversible, so symmetric methods keep its energy within
/// a bound and do not let it drift: through some hundreds of its oscillations, cut anywhere, the line rises by less
/// than a hundredth of them.
#[test]
fn energy_of_a_heavy_top_stays_within_a_bound() {
    const LAGRANGE: Top = FreeTop { inertia: [0.5, 0.5, 1.0] };
    let heavy = SystemProblem { system: &LAGRANGE, form: MomentumForm, input: WEIGHT };
    let energy = |state: &State<Top>| {
        let z = LAGRANGE.velocity(0.0, &state.q, &state.y);
        LAGRANGE.kinetic_energy(0.0, &state.q, &z) + 0.6 * (state.q.inverse() * SVector::from([0.0, 0.0, 1.0]))[2]
    };
    let (two, four, six) = methods();
    let (steps, h) = (10_000, 0.1);
    for (name, (largest, slope)) in [
        ("midpoint", drift(&two, &heavy, h, steps, energy)),
        ("order 4", drift(&four, &heavy, h, steps, energy)),
        ("order 6", drift(&six, &heavy, h, steps, energy)),
    ] {
        assert!(slope.abs() < 0.01 * largest, "{name}: {largest:e} {slope:e}");
    }
    // The classical method loses it in proportion to time: the line is all of the change.
    let (largest, slope) = drift(&Rkmk::new(&Tableau::RK4), &heavy, h, steps, energy);
    assert!(slope.abs() > 0.8 * largest, "{largest:e} {slope:e}");
}

#[test]
fn the_iteration_takes_few_evaluations() {
    let evaluations = Cell::new(0);
    let counted = Feedback(|t: f64, q: &UnitQuaternion<f64>, z: &SVector<f64, 3>| {
        evaluations.set(evaluations.get() + 1);
        (TORQUE.0)(t, q, z)
    });
    let problem = SystemProblem { system: &TOP, form: VelocityForm, input: counted };
    let start = start_by_velocity();
    let (two, four, six) = methods();
    // Derivatives of the equations are about 1, those of dexp⁻¹ ½: each sweep gains a digit, and one more sees that
    // none is left.
    let check = |method: &dyn Fn(), stages: u32| {
        evaluations.set(0);
        method();
        assert!(evaluations.get() <= 1 + 17 * stages, "{} of {stages} stages", evaluations.get());
    };
    check(
        &|| {
            march(&two, &problem, &start, 0.1, 1);
        },
        1,
    );
    check(
        &|| {
            march(&four, &problem, &start, 0.1, 1);
        },
        2,
    );
    check(
        &|| {
            march(&six, &problem, &start, 0.1, 1);
        },
        3,
    );
}

#[test]
fn what_does_not_converge_is_an_error_in_words() {
    let system = Oscillator::<Viscous>::new(0.0);
    let run = || Simulation::new(&system).input(|_, _: &_, _: &_| 0.0);
    let (q, z) = (SVector::from([1.0]), SVector::from([0.0]));
    let error = run().control(Fixed::by(Collocation::order_4(), 10.0)).run(q, z, 0.0..20.0).expect_err("refused");
    assert!(matches!(error.kind, IntegrationErrorKind::NotConverged { iterations: 64, residual } if residual > 1.0));
    assert!(error.to_string().contains("not solved after 64 iterations"), "{error}");
    assert!(run().control(Fixed::by(Collocation::order_4(), 1.0)).run(q, z, 0.0..20.0).is_ok());
    // An iteration that leaves the range of numbers before its sweeps are used up has not converged either.
    let stiff = Simulation::new(&system).input(|_, _: &_, z: &SVector<f64, 1>| -1e9 * z[0]);
    let error = stiff.control(Fixed::by(Collocation::order_6(), 10.0)).run(q, z, 0.0..20.0).expect_err("refused");
    assert!(matches!(error.kind, IntegrationErrorKind::NotConverged { iterations: ..64, residual } if residual > 0.5));

    let fast = SVector::from([0.0, 0.0, 40.0]);
    let turning = Simulation::new(&TOP).input_from(NONE);
    let q = start_by_velocity().q;
    let error = turning.control(Fixed::by(Collocation::order_4(), 0.1)).run(q, fast, 0.0..1.0).expect_err("refused");
    assert!(matches!(error.kind, IntegrationErrorKind::IncrementTooLarge { angle } if (angle - 4.0).abs() < 1e-12));
    let broken = Feedback(|t: f64, _: &_, _: &_| [if t > 0.05 { f64::NAN } else { 0.0 }, 0.0, 0.0]);
    let broken = Simulation::new(&TOP).input_from(broken);
    let error = broken.control(Fixed::by(Collocation::midpoint(), 0.2)).run(q, fast, 0.0..1.0).expect_err("refused");
    assert_eq!(error.kind, IntegrationErrorKind::NonFinite { part: RunPart::Step });
}

/// A torque whose rounding is 1e5 times that of the state, as where large terms cancel.
#[test]
fn rounding_of_the_equations_is_not_taken_for_divergence() {
    let noisy = Feedback(|t: f64, q: &UnitQuaternion<f64>, z: &SVector<f64, 3>| {
        (TORQUE.0)(t, q, z).map(|component| component + 1e-11 * (z[0] * 1e15).fract())
    });
    let problem = SystemProblem { system: &TOP, form: VelocityForm, input: noisy };
    let clean = SystemProblem { system: &TOP, form: VelocityForm, input: TORQUE };
    let (start, method) = (start_by_velocity(), Collocation::order_4());
    let found = distance(&march(&method, &problem, &start, 1.0, 10), &march(&method, &clean, &start, 1.0, 10));
    // In a unit of time, by inertias of ½ and more, carried on about as large.
    assert!(found < 4e-11, "{found:e}");
}

#[test]
fn a_state_at_rest_stays() {
    let problem = SystemProblem { system: &TOP, form: VelocityForm, input: NONE };
    let start = State { y: SVector::zeros(), ..start_by_velocity() };
    assert_eq!(distance(&march(&Collocation::order_6(), &problem, &start, 1.0, 4), &start), 0.0);
}

/// Nothing but the part that comes has a size: the first sweep has nothing to compare with.
#[test]
fn what_rests_in_the_origin_is_set_going() {
    let system = Oscillator::<Viscous>::new(0.0);
    for onset in [0.0, 0.3] {
        let push = |t: f64, _: &SVector<f64, 1>, _: &SVector<f64, 1>| if t > onset { 2.0 * (t - onset) } else { 0.0 };
        let run = Simulation::new(&system).input(push).control(Fixed::by(Collocation::order_6(), 0.1));
        let end = run.run_to_end(SVector::zeros(), SVector::zeros(), 0.0..1.0).expect("a run");
        let exact = Simulation::new(&system).input(push).adaptive(1e-12, 1e-12);
        let exact = exact.run_to_end(SVector::zeros(), SVector::zeros(), onset..1.0).expect("a run");
        // Steps of a tenth have errors of some 1e-9 of order 6; the onset is at the end of one.
        assert!((end.q[0] - exact.q[0]).abs() < 1e-7 && end.q[0] > 0.05, "{} {}", end.q[0], exact.q[0]);
    }
}

#[test]
fn constraints_hold_and_the_order_stays() {
    let (rod, angle) = (pendulum::<f64>(2.0), pendulum_by_angle());
    let exact = Simulation::new(&angle)
        .control(Fixed::with(&Tableau::DORMAND_PRINCE_8, 1e-3))
        .run_to_end(SVector::from([0.9]), SVector::from([0.4]), 0.0..1.0)
        .expect("runs");
    let points: Vec<_> = [20, 40, 80, 160]
        .into_iter()
        .map(|n| {
            let h = 1.0 / f64::from(n);
            let (s, c) = 0.9_f64.sin_cos();
            let end = Simulation::new(&rod)
                .control(Fixed::by(Collocation::order_4(), h))
                .run_to_end(SVector::from([s, -c]), SVector::from([0.4 * c, 0.4 * s]), 0.0..1.0)
                .expect("runs");
            assert!((end.q.norm() - 1.0).abs() < 4.0 * f64::EPSILON);
            (h, (end.q[0].atan2(-end.q[1]) - exact.q[0]).abs())
        })
        .collect();
    // 1000 steps of the exact run, with accelerations up to g.
    let order = crate::testing::order::fitted_order(&points, GRAVITY * f64::EPSILON * 1000_f64.sqrt());
    assert!(order > 3.8, "{order}: {points:?}");
}

#[test]
fn runs_in_single_precision_and_in_packs() {
    let start = start_by_velocity();
    let problem = SystemProblem { system: &TOP, form: VelocityForm, input: NONE };
    let exact = march(&Collocation::order_6(), &problem, &start, 2.0, 20);
    let single = FreeTop { inertia: [0.5_f32, 0.85, 1.0] };
    let end = Simulation::new(&single)
        .input(|_, _: &_, _: &_| [0.0; 3])
        .control(Fixed::by(Collocation::order_6(), 0.1))
        .run_to_end(start.q.cast(), start.y.cast(), 0.0..2.0)
        .expect("runs");
    // 20 steps, some thirty roundings each.
    assert!((end.z.cast::<f64>() - exact.y).amax() < 600.0 * f64::from(f32::EPSILON));
    let both = |x: f64| Lanes([x, x]);
    let pack = FreeTop { inertia: [Lanes([0.5, 0.9]), both(0.85), both(1.0)] };
    let q = crate::triple::unit_quaternion(crate::triple::quaternion(&start.q).map(both));
    let end = Simulation::new(&pack)
        .input(|_, _: &_, _: &_| [both(0.0); 3])
        .control(Fixed::by(Collocation::order_6(), both(0.1)))
        .run_to_end(q, SVector::from(start.y.data.0[0].map(both)), both(0.0)..both(2.0))
        .expect("runs");
    for i in 0..3 {
        assert!((end.z[i].0[0] - exact.y[i]).abs() < 600.0 * f64::EPSILON);
    }
}
