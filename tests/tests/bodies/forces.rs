//! Forces, torques, drives, springs, dissipation and inputs of systems: a reference solution, closed forms, two ways to
//! say the same, and the balance of power.

use gauss_runtime::prelude::*;
use gauss_tests::laws::forced_laws;
use gauss_tests::nonholonomic::state_of_twist;
use gauss_tests::trajectory::{Run, reference, rotation, triple};
use proptest::prelude::*;

/// Linear drag in body axes and a steady push at a point off the centre.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    speeds(u: Vector3, w: Vector3),
    kinematics(pose = twist(u, w)),
    body(hull, position = pose.position, rotation = pose.rotation),
    force(drag, body = hull, value = -linear * u),
    torque(turning_drag, body = hull, value = -angular * w),
    force(push, body = hull, at = at, value = f, axes = observer),
)]
struct Dragged {
    #[gauss(body)]
    hull: RigidBody<f64>,
    linear: f64,
    angular: f64,
    at: Vector3<f64>,
    f: Vector3<f64>,
    #[gauss(gravity)]
    g: f64,
}

fn dragged() -> Dragged {
    Dragged {
        hull: RigidBody {
            mass: 1.0,
            center_of_mass: Vector3::zeros(),
            inertia: Matrix3::from_diagonal(&Vector3::new(0.3, 0.5, 0.6)),
        },
        linear: 0.4,
        angular: 0.05,
        at: Vector3::new(0.2, 0.0, 0.1),
        f: Vector3::new(1.0, 2.0, 0.5),
        g: 9.81,
    }
}

#[test]
fn dragged_body_as_in_the_reference() {
    let kernel = dragged().kernel().unwrap();
    let initial = &reference("drag_body")["initial"];
    let pose = Isometry3::from_parts(triple(&initial["b"]).into(), rotation(&initial["R"]));
    let (u, w) = (triple(&initial["body_u"]), triple(&initial["body_omega"]));
    let z = SVector::from([u.x, u.y, u.z, w.x, w.y, w.z]);
    forced_laws(&kernel, 0.0, (&pose, &z), &());
    Run { name: "drag_body", system: &kernel, start: (pose, z) }.agrees(1.0, |_, q, z| state_of_twist(q, z));
}

/// A mass on a spring with a damper, pushed by an input.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    particle(mass = m, position = [x, 0, 0]),
    spring(from = [0, 0, 0], to = [x, 0, 0], stiffness = k, length = rest, damping = c),
    input(push),
    drive(x = push),
)]
struct Oscillator {
    m: f64,
    k: f64,
    rest: f64,
    c: f64,
}

#[test]
fn damped_oscillator_has_its_closed_form() {
    let (m, k, rest, c, push) = (1.5, 40.0, 0.7, 2.0, 3.0);
    let kernel = Oscillator { m, k, rest, c }.kernel().unwrap();
    let (x, v) = (SVector::from([1.1]), SVector::from([-0.4]));
    let found = kernel.acceleration(0.0, &x, &v, &SVector::from([push]))[0];
    let expected = (push - k * (1.1 - rest) + c * 0.4) / m;
    assert!((found - expected).abs() <= 4.0 * f64::EPSILON * expected.abs(), "{found} {expected}");
    assert!((kernel.potential_energy(0.0, &x) - 0.5 * k * 0.4_f64.powi(2)).abs() < 1e-14);
    // ẍ + 2δẋ + ω²(x − x₀) = 0 with x₀ where the push and the spring agree.
    let (delta, square) = (c / (2.0 * m), k / m);
    let frequency = (square - delta * delta).sqrt();
    forced_laws(&kernel, 0.0, (&x, &v), &SVector::from([push]));
    let equilibrium = rest + push / k;
    let (a, time) = (1.1 - equilibrium, 2.0);
    let b = (-0.4 + delta * a) / frequency;
    let exact = equilibrium + (-delta * time).exp() * (a * (frequency * time).cos() + b * (frequency * time).sin());
    for momentum in [false, true] {
        let run = Simulation::new(&kernel).input(|_, _, _| SVector::from([push]));
        let steps = Adaptive::with(&Tableau::DORMAND_PRINCE_8, 1e-12, 1e-12);
        let end = match momentum {
            true => run.momentum_form().control(steps).run_to_end(x, v, 0.0..time),
            false => run.control(steps).run_to_end(x, v, 0.0..time),
        };
        // Tolerances of 1e-12 a step over some dozens of steps of a damped motion.
        assert!((end.unwrap().q[0] - exact).abs() < 1e-10);
    }
}

/// Two arms with motors in their joints: as drives of the coordinates.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b),
    body(upper, rotation = rotation_y(a)),
    body(lower, parent = upper, position = [0, 0, -l], rotation = rotation_y(b)),
    input(shoulder, elbow),
    drive(a = shoulder, b = elbow),
    damping = 0.5 * c * rate_a.powi(2) + 0.5 * c * rate_b.powi(2),
    speeds(rate_a, rate_b),
    kinematics(a = rate_a, b = rate_b),
)]
struct Driven {
    #[gauss(body)]
    upper: RigidBody<f64>,
    #[gauss(body)]
    lower: RigidBody<f64>,
    l: f64,
    c: f64,
    #[gauss(gravity)]
    g: f64,
}

/// The same motors as torques on the bodies, with their reactions, and angles from the vertical.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b),
    body(upper, rotation = rotation_y(a)),
    body(lower, position = [-l * sin(a), 0, -l * cos(a)], rotation = rotation_y(b)),
    input(shoulder, elbow),
    torque(body = upper, value = [0, shoulder, 0]),
    torque(body = lower, value = [0, elbow, 0], reaction = upper),
    torque(friction, body = upper, value = -c * upper.angular_velocity, axes = observer),
    torque(elbow_friction, body = lower, value = c * (upper.angular_velocity - lower.angular_velocity), axes = observer, reaction = upper),
)]
struct Turned {
    #[gauss(body)]
    upper: RigidBody<f64>,
    #[gauss(body)]
    lower: RigidBody<f64>,
    l: f64,
    c: f64,
    #[gauss(gravity)]
    g: f64,
}

fn arm(mass: f64, length: f64) -> RigidBody<f64> {
    let moment = mass * length * length / 3.0;
    RigidBody {
        mass,
        center_of_mass: Vector3::new(0.0, 0.0, -length / 2.0),
        inertia: Matrix3::from_diagonal(&Vector3::new(moment, moment, 0.01 * moment)),
    }
}

/// A vehicle with a thruster: a force at a named point, in observer's axes, against the same at a point fixed in the
/// body.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(hull, position = pose.position, rotation = pose.rotation),
    point(nozzle, body = hull, at = at),
    input(thrust, side),
    force(at = nozzle, value = pose.rotation * [thrust, max(side, -1), abs(side)]),
)]
struct AtPoint {
    #[gauss(body)]
    hull: RigidBody<f64>,
    at: Vector3<f64>,
}

#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(hull, position = pose.position, rotation = pose.rotation),
    input(thrust, side),
    force(body = hull, at = at, value = [thrust, max(side, -1), abs(side)]),
)]
struct InBody {
    #[gauss(body)]
    hull: RigidBody<f64>,
    at: Vector3<f64>,
}

fn close(found: &[f64], expected: &[f64], scale: f64) {
    for (a, b) in found.iter().zip(expected) {
        // A hundred operations round independently, and A lets them through by its condition, which is below ten here.
        assert!((a - b).abs() <= 1000.0 * f64::EPSILON * scale, "{found:?} {expected:?}");
    }
}

proptest! {
    #[test]
    fn motors_as_drives_and_as_torques(
        angles in prop::array::uniform2(-3.0..3.0_f64),
        rates in prop::array::uniform2(-2.0..2.0_f64),
        motors in prop::array::uniform2(-5.0..5.0_f64),
    ) {
        let (upper, lower, l, c, g) = (arm(2.0, 0.8), arm(1.0, 0.6), 0.8, 0.3, 9.81);
        let driven = Driven { upper, lower, l, c, g }.kernel().unwrap();
        let turned = Turned { upper, lower, l, c, g }.kernel().unwrap();
        let [a, b] = angles;
        let [va, vb] = rates;
        let input = SVector::from(motors);
        let first = driven.acceleration(0.0, &SVector::from(angles), &SVector::from(rates), &input);
        let (q, z) = (SVector::from([a, a + b]), SVector::from([va, va + vb]));
        let second = turned.acceleration(0.0, &q, &z, &input);
        close(&[first[0], first[0] + first[1]], second.as_slice(), 200.0);
        forced_laws(&driven, 0.0, (&SVector::from(angles), &SVector::from(rates)), &input);
        forced_laws(&turned, 0.0, (&q, &z), &input);
        // dE/dt is the power of the motors less what friction takes.
        let h = 1e-3;
        let energy = |s: f64| {
            let (dq, dz) = (SVector::from(rates), first);
            let curve = SVector::from(angles) + dq * s + dz * (0.5 * s * s);
            driven.energy(0.0, &curve, &(dq + dz * s))
        };
        let found = (8.0 * (energy(h) - energy(-h)) - (energy(2.0 * h) - energy(-2.0 * h))) / (12.0 * h);
        let power = motors[0] * va + motors[1] * vb - c * (va * va + vb * vb);
        // Truncation h⁴/30 of fifth derivatives, which accelerations of up to 200 make 1e7 at most.
        prop_assert!((found - power).abs() < 1e-4 * (1.0 + power.abs()), "{} {}", found, power);
        // ṗ of the momentum form is that of the velocity form: p = A z, and A depends on q alone.
        let p = driven.momentum(0.0, &SVector::from(angles), &SVector::from(rates));
        let rate = driven.momentum_rate(0.0, &SVector::from(angles), &p, &input);
        let momentum = |s: f64| {
            let (dq, dz) = (SVector::from(rates), first);
            driven.momentum(0.0, &(SVector::from(angles) + dq * s), &(dq + dz * s))
        };
        let slope = ((momentum(h) - momentum(-h)) * 8.0 - (momentum(2.0 * h) - momentum(-2.0 * h))) / (12.0 * h);
        prop_assert!((slope - rate).norm() < 1e-5 * (1.0 + rate.norm()));
    }

    #[test]
    fn a_force_at_a_point_is_a_force_on_its_body(
        axis in prop::array::uniform3(-2.0..2.0_f64),
        z in prop::array::uniform6(-2.0..2.0_f64),
        input in prop::array::uniform2(-3.0..3.0_f64),
    ) {
        let hull = RigidBody {
            mass: 2.0,
            center_of_mass: Vector3::new(0.1, -0.05, 0.02),
            inertia: Matrix3::new(0.9, 0.05, 0.02, 0.05, 1.1, -0.03, 0.02, -0.03, 1.3),
        };
        let at = Vector3::new(-0.6, 0.1, 0.2);
        let pose = Isometry3::from_parts(Vector3::new(1.0, 2.0, 3.0).into(), UnitQuaternion::from_scaled_axis(Vector3::from(axis)));
        let (z, input) = (SVector::from(z), SVector::from(input));
        let first = AtPoint { hull, at }.kernel().unwrap().acceleration(0.0, &pose, &z, &input);
        let second = InBody { hull, at }.kernel().unwrap().acceleration(0.0, &pose, &z, &input);
        close(first.as_slice(), second.as_slice(), 20.0);
        forced_laws(&AtPoint { hull, at }.kernel().unwrap(), 0.0, (&pose, &z), &input);
        forced_laws(&InBody { hull, at }.kernel().unwrap(), 0.0, (&pose, &z), &input);
        // Newton and Euler about G, by hand: m a_G = F, and the torque about G changes the spin.
        let kernel = InBody { hull, at }.kernel().unwrap();
        let free = kernel.acceleration(0.0, &pose, &z, &SVector::from([0.0, 0.0]));
        let force = Vector3::new(input[0], input[1].max(-1.0), input[1].abs());
        let c = hull.center_of_mass;
        let central = hull.inertia - (Matrix3::identity() * c.dot(&c) - c * c.transpose()) * hull.mass;
        let spin = central.try_inverse().unwrap() * (at - c).cross(&force);
        let linear = force / hull.mass - spin.cross(&c);
        let still = kernel.acceleration(0.0, &pose, &z, &SVector::from([0.0, 0.0]));
        prop_assert_eq!(still, free);
        // max(0, −1) and |0| vanish, so that the free motion is that without forces.
        let gained = second - free;
        close(gained.as_slice(), &[linear.x, linear.y, linear.z, spin.x, spin.y, spin.z], 40.0);
    }
}
