//! Friction along what no impulse moves: coordinates that a constraint drives, and drilling on a radius of zero.

use gauss_contact::{ContactLanes, ContactRun, ContactStepper, ContactSteps, Mode};
use gauss_runtime::dual::Dual;
use gauss_runtime::prelude::*;

/// A slide that a constraint drives, against dry friction; beside it a mass on a spring.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    particle(mass = 1, position = [x, y, 0]),
    constraint(position = x - a * sin(t)),
    dry_friction(rail, slip = rate(x), bound = f),
    spring(strut, along = y, stiffness = 4),
)]
struct Driven<T> {
    a: T,
    f: T,
}

fn driven<T: Real>() -> DrivenKernel<T> {
    Driven { a: T::from_f64(1.0), f: T::from_f64(2.0) }.kernel().unwrap()
}

#[test]
fn friction_along_a_driven_coordinate_is_at_its_bound() {
    let kernel = driven::<f64>();
    for h in [1e-2, 1e-3] {
        let run = ContactSteps::new(&kernel, h).run([0.0, 0.3].into(), [1.0, 0.0].into(), 0.0..10.0).unwrap();
        for step in &run {
            let speed = (step.state.t - 0.5 * h).cos();
            // Where it turns back the mean over the step is between.
            if speed.abs() > 2.0 * h {
                let force = step.impulses[0] / step.report.length;
                assert!((force + 2.0 * speed.signum()).abs() < 1e-9, "{h} {} {force}", step.state.t);
                assert!(matches!(step.modes[0], Mode::Slides(_)), "{h} {}", step.state.t);
            }
        }
        let end = run.last().unwrap().state;
        assert!((end.q[0] - 10.0_f64.sin()).abs() < 1e-9 && (end.q[1] - 0.3 * 20.0_f64.cos()).abs() < 1e-2, "{h}");
    }
}

#[test]
fn lanes_and_derivatives_have_friction_along_driven_coordinates() {
    type Four = Lanes<f64, 4>;
    let (kernel, wide, dual) = (driven::<f64>(), driven::<Four>(), driven::<Dual<4>>());
    let start = |lane: usize| {
        let t = 0.3 * lane as f64;
        ContactStepper::new(&kernel, t, [t.sin(), 0.3].into(), [t.cos(), 0.1].into()).unwrap()
    };
    let mut singles: Vec<_> = (0..4).map(start).collect();
    let mut lanes = ContactLanes::of(&wide, (0..4).map(start).collect()).unwrap();
    for n in 0..200 {
        let outcomes: Vec<_> = lanes.step(1e-2, &()).to_vec();
        for (lane, single) in singles.iter_mut().enumerate() {
            assert_eq!(outcomes[lane], single.step(1e-2, &()), "{n} {lane}");
            assert_eq!(single.impulses(), lanes.steppers()[lane].impulses(), "{n} {lane}");
            assert_eq!(single.modes(), lanes.steppers()[lane].modes(), "{n} {lane}");
        }
    }
    let made = singles[0].step_with_derivatives::<_, 4, 4, 0, 0>(1e-2, &(), &dual).unwrap();
    assert!(singles[0].impulses()[0].abs() > 0.019);
    // The mass beside it swings as without friction: ∂y⁺/∂ẏ = h to second order.
    assert!((made.by_state[(1, 3)] - 1e-2).abs() < 1e-5, "{}", made.by_state);
}

/// A puck whose place across is driven, with friction in all directions.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    particle(mass = 1, position = [x, y, 0]),
    constraint(position = x - sin(2 * t)),
    dry_friction(table, slip = [rate(x), rate(y)], bound = 0.5),
)]
struct Puck {}

#[test]
fn what_is_driven_across_slides_along_too() {
    let kernel = Puck {}.kernel().unwrap();
    let run = ContactSteps::new(&kernel, 2e-3).run([0.0, 0.0].into(), [2.0, 1.5].into(), 0.0..8.0).unwrap();
    let exact =
        ContactRun::new(&kernel).adaptive(1e-9, 1e-9).run([0.0, 0.0].into(), [2.0, 1.5].into(), 0.0..0.7).unwrap();
    let end = exact.last().unwrap();
    let step = &run[349];
    assert!((step.state.t - 0.7).abs() < 1e-9);
    assert!((step.state.q - end.q).amax() < 1e-3 && (step.state.z - end.z).amax() < 1e-3, "{} {}", step.state.z, end.z);
    for step in &run {
        let force = step.impulses / step.report.length;
        assert!((force.norm() - 0.5).abs() < 1e-6, "{} {force}", step.state.t);
        assert!(force.dot(&step.state.z) <= 1e-2, "{} {force}", step.state.t);
    }
}

/// A ball on a table with friction of drilling on a radius that may be zero, and rolling resistance that may be.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(ball, position = pose.position, rotation = pose.rotation, mass = 0.2, inertia = 0.4 * 0.2 * 0.03 * 0.03),
    contact(table, point = ball.position, radius = 0.03, friction = mu, drilling = l, rolling = rho),
)]
struct Drilled<T> {
    mu: T,
    l: T,
    rho: T,
    #[gauss(gravity)]
    g: T,
}

#[test]
fn drilling_and_rolling_of_zero_are_none() {
    let start = Isometry3::translation(0.0, 0.0, 0.03);
    for z in [[0.0, 0.0, 0.0, 0.0, 0.0, 0.0], [0.5, 0.0, 0.0, 0.0, 0.0, 5.0], [0.0, 0.0, 0.0, 0.0, 0.0, 5.0]] {
        for (mu, rho) in [(0.3, 0.0), (0.3, 1e-4), (0.0, 0.0)] {
            let kernel = |l: f64| Drilled { mu, l, rho, g: 9.81 }.kernel().unwrap();
            let run =
                |l: f64| ContactSteps::new(&kernel(l), 1e-3).run(start, SVector::from(z), 0.0..1.0).unwrap().samples;
            let [none, small] = [0.0, 1e-6].map(run).map(|run| run.last().unwrap().state);
            // The torque 10⁻⁶ m · μ m g takes 0.01 rad/s from the spin.
            assert!((none.z - small.z).amax() < 0.03, "{z:?} {mu} {rho} {} {}", none.z, small.z);
            // Nothing brakes the spin about the vertical.
            let up = none.q.rotation.inverse() * Vector3::z();
            let spin = up.dot(&Vector3::new(none.z[3], none.z[4], none.z[5]));
            assert!((spin - z[5]).abs() < 1e-4, "{z:?} {mu} {rho} {spin}");
        }
    }
    let zero = Drilled { mu: 0.3, l: 0.0, rho: 0.0, g: 9.81 }.kernel().unwrap();
    let number = Dual::<6>::constant;
    let dual = Drilled { mu: number(0.3), l: number(0.0), rho: number(0.0), g: number(9.81) }.kernel().unwrap();
    let mut stepper = ContactStepper::new(&zero, 0.0, start, SVector::zeros()).unwrap();
    let made = stepper.step_with_derivatives::<_, 6, 12, 0, 0>(1e-3, &(), &dual).unwrap();
    assert!(made.by_state.iter().all(|slope| slope.is_finite()));
}

#[test]
fn events_take_drilling_of_zero_as_none() {
    let start = Isometry3::translation(0.0, 0.0, 0.03);
    for z in [[0.0; 6], [0.5, 0.0, 0.0, 0.0, 0.0, 5.0]] {
        let kernel = Drilled { mu: 0.3, l: 0.0, rho: 0.0, g: 9.81 }.kernel().unwrap();
        let run = ContactRun::new(&kernel).adaptive(1e-9, 1e-9).run(start, SVector::from(z), 0.0..1.0).unwrap();
        let steps = ContactSteps::new(&kernel, 1e-3).run(start, SVector::from(z), 0.0..1.0).unwrap();
        let [run, steps] = [run.last().unwrap(), steps.last().unwrap().state];
        assert!((run.z - steps.z).amax() < 1e-3, "{} {}", run.z, steps.z);
    }
}
