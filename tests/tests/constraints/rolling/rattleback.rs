//! The rattleback: an ellipsoid whose principal axes of inertia are turned against its own, so that it spins one way
//! and not the other. O is its centre, e₃ points up at rest, G is below O. With γ = Rᵀk₃ the lowest point of the
//! ellipsoid of half-axes a is at −(aᵢ² γᵢ)/h from O, h = √Σ aᵢ² γᵢ² the height of O.

use gauss_runtime::prelude::*;
use gauss_tests::laws::{Time, constrained_laws, corresponds, laws, least};
use gauss_tests::nonholonomic::{precise, rigid_state, state_of_twist, twist};
use gauss_tests::trajectory::{Run, Seen};
use proptest::prelude::*;

/// Speeds that solve the rolling, angles as in the reference: γ = (−cos ρ sin π, sin ρ, cos ρ cos π) of roll ρ and
/// pitch π.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, yaw, roll, pitch),
    speeds(w: Vector3),
    kinematics(
        x = (rotation_z(yaw) * rotation_x(roll) * rotation_y(pitch) * cross(w, [
            -a.x * a.x * cos(roll) * sin(pitch), a.y * a.y * sin(roll), a.z * a.z * cos(roll) * cos(pitch),
        ])).x / sqrt(
            (a.x * cos(roll) * sin(pitch)).powi(2) + (a.y * sin(roll)).powi(2) + (a.z * cos(roll) * cos(pitch)).powi(2)
        ),
        y = (rotation_z(yaw) * rotation_x(roll) * rotation_y(pitch) * cross(w, [
            -a.x * a.x * cos(roll) * sin(pitch), a.y * a.y * sin(roll), a.z * a.z * cos(roll) * cos(pitch),
        ])).y / sqrt(
            (a.x * cos(roll) * sin(pitch)).powi(2) + (a.y * sin(roll)).powi(2) + (a.z * cos(roll) * cos(pitch)).powi(2)
        ),
        yaw = (w.z * cos(pitch) - w.x * sin(pitch)) / cos(roll),
        roll = w.x * cos(pitch) + w.z * sin(pitch),
        pitch = w.y - tan(roll) * (w.z * cos(pitch) - w.x * sin(pitch)),
    ),
    body(
        position = [x, y, sqrt(
            (a.x * cos(roll) * sin(pitch)).powi(2) + (a.y * sin(roll)).powi(2) + (a.z * cos(roll) * cos(pitch)).powi(2)
        )],
        rotation = rotation_z(yaw) * rotation_x(roll) * rotation_y(pitch),
    )
)]
struct InAngles {
    #[gauss(mass)]
    m: f64,
    #[gauss(center_of_mass)]
    c: Vector3<f64>,
    #[gauss(inertia)]
    j: Matrix3<f64>,
    a: Vector3<f64>,
    #[gauss(gravity)]
    g: f64,
}

/// A pose, the material point at the contact at rest.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(stone, position = pose.position, rotation = pose.rotation),
    constraint(velocity = stone.velocity - pose.rotation * cross(inverse(pose.rotation) * stone.angular_velocity, [
        a.x * a.x * (inverse(pose.rotation) * [0, 0, 1]).x,
        a.y * a.y * (inverse(pose.rotation) * [0, 0, 1]).y,
        a.z * a.z * (inverse(pose.rotation) * [0, 0, 1]).z,
    ]) / sqrt(
        (a.x * (inverse(pose.rotation) * [0, 0, 1]).x).powi(2)
            + (a.y * (inverse(pose.rotation) * [0, 0, 1]).y).powi(2)
            + (a.z * (inverse(pose.rotation) * [0, 0, 1]).z).powi(2)
    )),
)]
struct OnVelocities {
    #[gauss(body)]
    stone: RigidBody<f64>,
    a: Vector3<f64>,
    #[gauss(gravity)]
    g: f64,
}

/// A rotation for the attitude, the velocity of the centre eliminated by the derive.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, attitude: Rotation),
    speeds(vx, vy, w1, w2, w3),
    kinematics(x = vx, y = vy, attitude = [w1, w2, w3]),
    body(
        stone,
        position = [x, y, sqrt(
            (a.x * (inverse(attitude) * [0, 0, 1]).x).powi(2)
                + (a.y * (inverse(attitude) * [0, 0, 1]).y).powi(2)
                + (a.z * (inverse(attitude) * [0, 0, 1]).z).powi(2)
        )],
        rotation = attitude,
    ),
    constraint(velocity = vx - (attitude * cross([w1, w2, w3], [
        a.x * a.x * (inverse(attitude) * [0, 0, 1]).x,
        a.y * a.y * (inverse(attitude) * [0, 0, 1]).y,
        a.z * a.z * (inverse(attitude) * [0, 0, 1]).z,
    ])).x / stone.position.z),
    constraint(velocity = vy - (attitude * cross([w1, w2, w3], [
        a.x * a.x * (inverse(attitude) * [0, 0, 1]).x,
        a.y * a.y * (inverse(attitude) * [0, 0, 1]).y,
        a.z * a.z * (inverse(attitude) * [0, 0, 1]).z,
    ])).y / stone.position.z),
    independent(w1, w2, w3),
)]
struct Eliminated {
    #[gauss(body)]
    stone: RigidBody<f64>,
    a: Vector3<f64>,
    #[gauss(gravity)]
    g: f64,
}

const G: f64 = 9.81;
/// Of the rattleback of Kane & Levinson (1982).
const FLAT: Vector3<f64> = Vector3::new(0.2, 0.03, 0.02);
/// For the laws, which hold for all: central differences do not resolve how fast the contact moves on the flat one.
const ROUND: Vector3<f64> = Vector3::new(0.2, 0.16, 0.13);

/// The same paper; O in the centre.
fn body() -> RigidBody<f64> {
    let inertia = Matrix3::new(3e-4, 2e-5, 0.0, 2e-5, 1.7e-3, 0.0, 0.0, 0.0, 1.7e-3);
    RigidBody { mass: 1.0, center_of_mass: Vector3::new(0.0, 0.0, -0.01), inertia }
}

fn in_angles(a: Vector3<f64>) -> InAnglesKernel {
    let RigidBody { mass: m, center_of_mass: c, inertia: j } = body();
    InAngles { m, c, j, a, g: G }.kernel().unwrap()
}

fn on_velocities(a: Vector3<f64>) -> OnVelocitiesKernel {
    OnVelocities { stone: body(), a, g: G }.kernel().unwrap()
}

fn eliminated(a: Vector3<f64>) -> EliminatedKernel {
    Eliminated { stone: body(), a, g: G }.kernel().unwrap()
}

fn turned(q: &SVector<f64, 5>) -> UnitQuaternion<f64> {
    let turn = |axis, angle| UnitQuaternion::from_axis_angle(&axis, angle);
    turn(Vector3::z_axis(), q[2]) * turn(Vector3::x_axis(), q[3]) * turn(Vector3::y_axis(), q[4])
}

type Planar = (UnitQuaternion<f64>, SVector<f64, 2>);

fn planar(q: &SVector<f64, 5>) -> Planar {
    (turned(q), SVector::from([q[0], q[1]]))
}

/// From the lowest point to O, body axes.
fn to_centre(a: &Vector3<f64>, rotation: &UnitQuaternion<f64>) -> Vector3<f64> {
    let up = rotation.inverse() * Vector3::z();
    let weighted = a.component_mul(a).component_mul(&up);
    weighted / weighted.dot(&up).sqrt()
}

/// The pose and the velocity of O of a rolling motion.
fn rolling(a: &Vector3<f64>, (rotation, b): &Planar, w: &Vector3<f64>) -> (Isometry3<f64>, Vector3<f64>) {
    let arm = rotation * to_centre(a, rotation);
    (Isometry3::from_parts(Translation3::new(b[0], b[1], arm.z), *rotation), (rotation * w).cross(&arm))
}

fn in_space(a: &Vector3<f64>, q: &SVector<f64, 5>, w: &Vector3<f64>) -> (Isometry3<f64>, SVector<f64, 6>) {
    let (pose, velocity) = rolling(a, &planar(q), w);
    (pose, twist(&pose.rotation, velocity, pose.rotation * w))
}

fn start() -> (SVector<f64, 5>, Vector3<f64>) {
    (SVector::from([0.0, 0.0, 0.0, 0.009, 0.009]), Vector3::new(0.0, 0.0, 5.0))
}

#[test]
fn every_way_gives_the_reference() {
    let (name, (q, w)) = ("rattleback", start());
    Run { name, system: &in_angles(FLAT), start: (q, w) }.agrees(1.0, |_, q, w| {
        let (pose, velocity) = rolling(&FLAT, &planar(q), w);
        let angles = ("q", q.iter().copied().collect());
        rigid_state(&pose, velocity, *w).into_iter().chain([angles]).collect::<Seen>()
    });
    Run { name, system: &eliminated(FLAT), start: (planar(&q), w) }.agrees(1.0, |_, q, w| {
        let (pose, velocity) = rolling(&FLAT, q, w);
        rigid_state(&pose, velocity, *w)
    });
    let start = in_space(&FLAT, &q, &w);
    Run { name, system: &on_velocities(FLAT), start }.agrees(1.0, |_, pose, z| state_of_twist(pose, z));
}

/// The angular velocity about the vertical at the times when a run from `spin` passes whole seconds, with its energies.
fn spins(spin: f64) -> Vec<(f64, f64)> {
    let kernel = eliminated(FLAT);
    let (q, _) = start();
    let run =
        Simulation::new(&kernel).control(precise()).run(planar(&q), Vector3::new(0.0, 0.0, spin), 0.0..5.0).unwrap();
    run.iter().map(|s| ((s.q.0 * s.z).z, kernel.energy(s.t, &s.q, &s.z))).collect()
}

#[test]
fn it_reverses_its_spin_one_way_only() {
    let against = spins(5.0);
    let (last, first) = (against[against.len() - 1].0, against[0].0);
    assert!(first > 4.9 && last < -3.0, "{first} to {last}");
    // The other way it goes on; the slower of the two oscillations, which that spin feeds, takes its time.
    let along = spins(-5.0);
    assert!(along.iter().all(|(spin, _)| (-5.5..-4.2).contains(spin)));
    for run in [against, along] {
        // The potential is 0.1 J, the turning 0.02 J; some thousand steps of a few roundings.
        assert!(run.iter().all(|(_, energy)| (energy - run[0].1).abs() < 1e-13));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn laws_in_every_way(
        place in prop::array::uniform2(-0.5..0.5), angles in prop::array::uniform3(-0.9..0.9),
        w in prop::array::uniform3(-4.0..4.0),
    ) {
        let (q, w) = (SVector::from([place[0], place[1], 3.0 * angles[0], angles[1], angles[2]]), Vector3::from(w));
        let (angles, solved, full) = (in_angles(ROUND), eliminated(ROUND), on_velocities(ROUND));
        let (there, (pose, z)) = (planar(&q), in_space(&ROUND, &q, &w));
        laws(&angles, 0.0, &q, &w, Time::Absent);
        least(&angles, 0.0, &q, &w);
        laws(&solved, 0.0, &there, &w, Time::Absent);
        least(&solved, 0.0, &there, &w);
        laws(&full, 0.0, &pose, &z, Time::Absent);
        constrained_laws(&full, 0.0, &pose, &z);
        corresponds(&angles, &solved, 0.0, (&q, &w), |_, q, w| (planar(q), *w));
        corresponds(&angles, &full, 0.0, (&q, &w), |_, q, w| in_space(&ROUND, q, w));

        // Newton and Euler about G, with the multipliers as the force at the contact.
        let rate = full.acceleration(0.0, &pose, &z, &());
        let (u, u_rate) = (Vector3::new(z[0], z[1], z[2]), Vector3::new(rate[0], rate[1], rate[2]));
        let (w_rate, RigidBody { mass, center_of_mass: c, inertia }) = (Vector3::new(rate[3], rate[4], rate[5]), body());
        let of_center = u_rate + w.cross(&u) + w_rate.cross(&c) + w.cross(&w.cross(&c));
        let force = mass * (of_center + pose.rotation.inverse() * Vector3::new(0.0, 0.0, G));
        let steiner = mass * (Matrix3::identity() * c.norm_squared() - c * c.transpose());
        let about_center = inertia - steiner;
        let moment = about_center * w_rate + w.cross(&(about_center * w));
        // Moments of inertia that differ by a factor of eight, forces up to 10 N, thousands of roundings.
        let arm = -to_centre(&ROUND, &pose.rotation) - c;
        prop_assert!((moment - arm.cross(&force)).amax() <= 1e-12);
        let found = full.multipliers(0.0, &pose, &z, &());
        prop_assert!((found - pose.rotation * force).amax() <= 1e-11, "{found} {force}");
        let reduced = solved.multipliers(0.0, &there, &w, &());
        prop_assert!((reduced - found.fixed_rows::<2>(0)).amax() <= 1e-11, "{reduced} {found}");
    }
}
