//! Steps of what turns fast, and of stiff forces: nothing grows because forces are taken at another time than speeds.

use gauss_contact::{ContactErrorKind, ContactLanes, ContactStepper, ContactSteps, StepScheme};
use gauss_runtime::prelude::*;

use crate::common::numbers;

/// A homogeneous ball above a floor.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(ball, position = pose.position, rotation = pose.rotation, mass = m, inertia = 0.4 * m * r * r),
    contact(floor, point = ball.position, radius = r, friction = mu, restitution = e),
)]
struct Ball<T> {
    m: T,
    r: T,
    mu: T,
    e: T,
    #[gauss(gravity)]
    g: T,
}

fn ball<T: Real>(r: f64, e: f64, g: f64) -> BallKernel<T> {
    let number = T::from_f64;
    Ball { m: number(0.4), r: number(r), mu: number(0.6), e: number(e), g: number(g) }.kernel().unwrap()
}

/// A slab whose moments differ, by speeds along the axes of the observer.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, height, attitude: Rotation),
    body(slab, position = [x, y, height], rotation = attitude, mass = 2, inertia = [0.02, 0.05, 0.06]),
    contact(floor, gap = height),
)]
struct Slab {
    #[gauss(gravity)]
    g: f64,
}

/// The same by angles, whose rates are its speeds.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, height, a, b, c),
    body(slab, position = [x, y, height], rotation = rotation_z(a) * rotation_y(b) * rotation_x(c),
        mass = 2, inertia = [0.02, 0.05, 0.06]),
    contact(floor, gap = height),
)]
struct Angles {
    #[gauss(gravity)]
    g: f64,
}

/// A puck by speeds of its own, along its axes.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, theta),
    speeds(u, v, omega),
    kinematics(x = u * cos(theta) - v * sin(theta), y = u * sin(theta) + v * cos(theta), theta = omega),
    body(puck, position = [x, y, 0], rotation = rotation_z(theta), mass = 0.2, inertia = [0.1, 0.1, j]),
    contact(wall, gap = x),
)]
struct Puck {
    j: f64,
}

/// A slider with a spring and a damper.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    particle(mass = m, position = [x, y, 0]),
    spring(strut, along = x, stiffness = k, damping = c),
    contact(wall, gap = y),
)]
struct Slider {
    m: f64,
    k: f64,
    c: f64,
}

const SCHEMES: [StepScheme; 2] = [StepScheme::Midpoint, StepScheme::MoreauJean];

/// Starts in the air: a turn per second and a speed, in seconds a step.
const FLIGHTS: [[f64; 3]; 4] =
    [[30.0, 2.0, 1.0 / 60.0], [60.0, 20.0, 1.0 / 60.0], [300.0, 20.0, 1e-3], [3.0, 5.0, 2e-3]];

#[test]
fn a_ball_that_spins_in_the_air_flies_straight() {
    let kernel = ball::<f64>(0.11, 0.0, 0.0);
    for scheme in SCHEMES {
        for [omega, v, h] in FLIGHTS {
            let z = SVector::from([v, 0.0, 0.0, 0.3 * omega, 0.5 * omega, -0.8 * omega]);
            let start = Isometry3::translation(0.0, 0.0, 50.0);
            let run = ContactSteps::new(&kernel, h).scheme(scheme).run(start, z, 0.0..1.0).unwrap();
            let before = kernel.kinetic_energy(0.0, &start, &z);
            for step in &run {
                let energy = kernel.kinetic_energy(0.0, &step.state.q, &step.state.z);
                let (gain, t) = (energy / before - 1.0, step.state.t);
                // Without a memory x⁶/32 of what turns by x goes, in parts of up to a fifth of a radian.
                let lost = if scheme == StepScheme::MoreauJean { 0.2_f64.powi(5) / 32.0 * omega * t } else { 0.0 };
                assert!((-2e-5 - lost..2e-5).contains(&gain), "{scheme:?} {omega} {t} {gain:e}");
            }
            let end = run.last().unwrap().state.q.translation.vector;
            let off = (end - Vector3::new(v, 0.0, 50.0)).norm();
            // Without a memory what turns by x lags by x³/12, and the way leans by half of what it lags by in the end.
            let lags = if scheme == StepScheme::MoreauJean { omega * (omega * h).min(0.2).powi(2) / 24.0 } else { 0.0 };
            assert!(off < (0.01 + lags) * v, "{scheme:?} {omega} {off}");
        }
    }
}

#[test]
fn a_ball_that_spins_and_bounces_gives_no_energy() {
    for [omega, v, h] in FLIGHTS {
        let kernel = ball::<f64>(0.11, 0.7, 9.81);
        let mut number = numbers(3);
        for _ in 0..10 {
            let turn = Vector3::new(number(), number(), number()).normalize() * omega;
            let z = SVector::from([v, 0.0, -1.0, turn.x, turn.y, turn.z]);
            let start = Isometry3::translation(0.0, 0.0, 1.0);
            let run = ContactSteps::new(&kernel, h).run(start, z, 0.0..2.0).unwrap();
            let before = kernel.energy(0.0, &start, &z);
            let most = run.iter().map(|step| kernel.energy(0.0, &step.state.q, &step.state.z)).fold(0.0, f64::max);
            // Heights are known to the way of a step.
            let way = 0.4 * 9.81 * h * (1.0 + v);
            assert!(most < 1.001 * before + way, "{omega} {h} {most} {before}");
        }
    }
}

#[test]
fn a_ball_that_rolls_keeps_its_speed() {
    for scheme in SCHEMES {
        for [r, v, h] in [[0.03, 1.0, 1e-3], [0.11, 5.0, 2e-3], [0.02, 8.0, 1e-3], [0.5, 0.1, 1e-2]] {
            let kernel = ball::<f64>(r, 0.0, 9.81);
            let z = SVector::from([v, 0.0, 0.0, 0.0, v / r, 0.0]);
            let run =
                ContactSteps::new(&kernel, h).scheme(scheme).run(Isometry3::translation(0.0, 0.0, r), z, 0.0..5.0);
            let run = run.unwrap();
            for step in &run {
                let u = SVector::<f64, 3>::from_fn(|i, _| step.state.z[i]);
                // By a millionth of it in each step at most.
                let allowed = 1e-3_f64.max(1e-6 * step.state.t / h);
                assert!((u.norm() / v - 1.0).abs() < allowed, "{scheme:?} {r} {} {}", step.state.t, u.norm());
            }
            let end = run.last().unwrap().state.q.translation.vector;
            // Of parts in which it turns by x = ωh places err by x²/24, without a memory speeds by x²/12. x is 1/5 at
            // most, and speeds may have changed by what is allowed.
            let off = if scheme == StepScheme::MoreauJean { 1.0 / 200.0 + 5e-6 / h } else { 1.0 / 500.0 };
            assert!((end - Vector3::new(5.0 * v, 0.0, r)).norm() < 5.0 * v * off, "{scheme:?} {r} {end}");
        }
    }
}

/// The energies of a run without forces stay.
macro_rules! stays {
    ($kernel:expr, $q:expr, $z:expr, $h:expr) => {
        for scheme in SCHEMES {
            let (kernel, q, z) = (&$kernel, $q, $z);
            let before = kernel.kinetic_energy(0.0, &q, &z);
            let run = ContactSteps::new(kernel, $h).scheme(scheme).run(q, z, 0.0..10.0).unwrap();
            for step in &run {
                let energy = kernel.kinetic_energy(0.0, &step.state.q, &step.state.z);
                assert!((energy / before - 1.0).abs() < 0.02, "{scheme:?} {} {}", step.state.t, energy / before);
            }
        }
    };
}

#[test]
fn what_tumbles_keeps_its_energy_in_every_chart() {
    let slab = Slab { g: 0.0 }.kernel().unwrap();
    // About the middle axis, along which it turns over.
    for z in [[3.0, -1.0, 0.0, 0.1, 12.0, 0.2], [0.1, 12.0, 0.2, 3.0, -1.0, 0.0]] {
        stays!(slab, (UnitQuaternion::identity(), SVector::from([0.0, 0.0, 150.0])), SVector::from(z), 4e-3);
    }
    let angles = Angles { g: 0.0 }.kernel().unwrap();
    let z = SVector::from([3.0, -1.0, 0.0, 5.0, 0.3, -0.2]);
    stays!(angles, SVector::from([0.0, 0.0, 5.0, 0.1, 0.3, -0.2]), z, 4e-3);
    let puck = Puck { j: 1e-4 }.kernel().unwrap();
    stays!(puck, SVector::from([900.0, 0.0, 0.0]), SVector::from([20.0, 1.0, 80.0]), 1e-2);
}

#[test]
fn stiff_dampers_and_springs_give_no_energy() {
    // (m, k, c, h).
    for scheme in SCHEMES {
        for [m, k, c, h] in [
            [0.05, 0.0, 20.0, 0.02],
            [1.0, 1e4, 100.0, 5e-3],
            [1.0, 1e4, 0.0, 5e-3],
            [1.0, 1e5, 0.0, 0.04],
            [1.0, 0.0, 300.0, 5e-3],
        ] {
            if scheme == StepScheme::MoreauJean && h * h * k / m > 1.0 {
                continue;
            }
            let kernel = Slider { m, k, c }.kernel().unwrap();
            let (q, z) = (SVector::from([0.01, 1.0]), SVector::from([1.0, 0.0]));
            let run = ContactSteps::new(&kernel, h).scheme(scheme).run(q, z, 0.0..2.0).unwrap();
            let before = kernel.energy(0.0, &q, &z);
            for step in &run {
                let energy = kernel.energy(0.0, &step.state.q, &step.state.z);
                // Of springs alone the energy of a step swings by a part (ωh)²/4 of itself.
                assert!(energy <= 1.6 * before, "{scheme:?} {m} {k} {c} {h} {} {}", step.state.t, energy / before);
            }
            if k == 0.0 {
                let first = run[0].state.z[0];
                // In parts of at most half of the time of the damper, of second order and of first.
                let allowed = if scheme == StepScheme::Midpoint { 0.03 } else { 0.08 };
                assert!((first - (-c / m * h).exp()).abs() < allowed, "{scheme:?} {c} {first}");
            }
        }
    }
    // What no part of a step follows is refused with the speed that does it.
    for [m, k, c, h] in [[1e-3, 0.0, 1e3, 0.02], [1e-6, 1e9, 0.0, 0.02]] {
        let kernel = Slider { m, k, c }.kernel().unwrap();
        let (q, z) = (SVector::from([0.01, 1.0]), SVector::from([1.0, 0.0]));
        let error = ContactSteps::new(&kernel, h).run(q, z, 0.0..2.0).unwrap_err();
        assert!(matches!(error.kind, ContactErrorKind::Stiff { speed: 0, .. }), "{error}");
    }
}

#[test]
fn gains_of_a_controller_are_held_for_a_step() {
    let kernel = Pushed {}.kernel().unwrap();
    let law = |_: f64, q: &SVector<f64, 2>, z: &SVector<f64, 2>| SVector::from([-1e4 * q[0] - 100.0 * z[0]]);
    let run = ContactSteps::new(&kernel, 5e-3).input(law);
    let run = run.run(SVector::from([0.01, 1.0]), SVector::from([1.0, 0.0]), 0.0..2.0).unwrap();
    assert!(run.iter().all(|step| step.state.q[0].abs() < 0.02));
    assert!(run.last().unwrap().state.z.amax() < 1e-9);
}

/// A mass that is pushed.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    particle(mass = 1, position = [x, y, 0]),
    input(push),
    drive(x = push),
    contact(wall, gap = y),
)]
struct Pushed {}

#[test]
fn lanes_that_spin_have_the_bits_of_single_steps() {
    type Eight = Lanes<f64, 8>;
    let (kernel, wide) = (ball::<f64>(0.11, 0.5, 9.81), ball::<Eight>(0.11, 0.5, 9.81));
    let mut number = numbers(5);
    let mut start = |i: usize| {
        let z = SVector::from_fn(|k, _| number() * if k < 3 { 3.0 } else { [0.1, 20.0, 200.0][i % 3] });
        ContactStepper::new(&kernel, 0.0, Isometry3::translation(0.0, 0.0, 0.11 + 0.1 * (i % 2) as f64), z).unwrap()
    };
    let mut singles: Vec<_> = (0..8).map(&mut start).collect();
    let again =
        |one: &ContactStepper<'_, _>| ContactStepper::new(&kernel, 0.0, *one.configuration(), *one.speeds()).unwrap();
    let mut lanes = ContactLanes::of(&wide, singles.iter().map(again).collect()).unwrap();
    for n in 0..300 {
        let outcomes: Vec<_> = lanes.step(2e-3, &()).to_vec();
        for (lane, single) in singles.iter_mut().enumerate() {
            assert_eq!(outcomes[lane], single.step(2e-3, &()), "{n} {lane}");
            assert_eq!(single.speeds(), lanes.steppers()[lane].speeds(), "{n} {lane}");
            assert_eq!(single.configuration(), lanes.steppers()[lane].configuration(), "{n} {lane}");
        }
    }
}

#[test]
fn derivatives_follow_steps_that_are_made_again() {
    let (kernel, dual) = (ball::<f64>(0.11, 0.0, 9.81), ball::<gauss_runtime::dual::Dual<6>>(0.11, 0.0, 9.81));
    let (q, z) = (Isometry3::translation(0.0, 0.0, 0.11), SVector::from([3.0, 0.5, 0.0, 20.0, 60.0, -90.0]));
    let h = 2e-3;
    let step = |z: &SVector<f64, 6>| {
        let mut stepper = ContactStepper::new(&kernel, 0.0, q, *z).unwrap();
        let made = stepper.step_with_derivatives::<_, 6, 12, 0, 0>(h, &(), &dual).unwrap();
        (*stepper.speeds(), made)
    };
    let (_, made) = step(&z);
    // But the vertical speed, by which the ball would land anew.
    for k in [0, 1, 3, 4, 5] {
        let moved = |by: f64| step(&(z + SVector::<f64, 6>::from_fn(|i, _| if i == k { by } else { 0.0 }))).0;
        let (by, close) = (1e-3, 1e-4);
        let difference = (moved(by) - moved(-by)) / (2.0 * by);
        for i in 0..6 {
            let slope = made.by_state[(6 + i, 6 + k)];
            assert!((slope - difference[i]).abs() < close * (1.0 + slope.abs()), "{i} {k} {slope} {}", difference[i]);
        }
    }
}
