//! Pendulums of several kinds, each in two choices of coordinates: reference solutions, what holds at every state, and
//! that both choices are one motion.

use gauss_runtime::prelude::*;
use gauss_tests::laws::{Time, balance, constrained_laws, corresponds, laws, least, position_rates};
use gauss_tests::trajectory::{Run, reference, rows};
use proptest::prelude::*;

/// Two point masses, each rod by two angles from the vertical.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a1, b1, a2, b2),
    particle(mass = m1, position = rotation_x(a1) * rotation_y(b1) * [0, 0, -l1]),
    particle(mass = m2, position = rotation_x(a1) * rotation_y(b1) * [0, 0, -l1] + rotation_x(a2) * rotation_y(b2) * [0, 0, -l2])
)]
struct SpatialDoublePendulum {
    m1: f64,
    m2: f64,
    l1: f64,
    l2: f64,
    #[gauss(gravity)]
    g: f64,
}

/// The same masses as free particles between which the distances are kept.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x1, y1, z1, x2, y2, z2),
    particle(mass = m1, position = [x1, y1, z1]),
    particle(mass = m2, position = [x2, y2, z2]),
    constraint(position = x1.powi(2) + y1.powi(2) + z1.powi(2) - l1 * l1),
    constraint(position = (x2 - x1).powi(2) + (y2 - y1).powi(2) + (z2 - z1).powi(2) - l2 * l2)
)]
struct MassesOnRods {
    m1: f64,
    m2: f64,
    l1: f64,
    l2: f64,
    #[gauss(gravity)]
    g: f64,
}

/// Two rods on universal joints.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a1, b1, a2, b2),
    body(upper, rotation = rotation_x(a1) * rotation_y(b1)),
    body(lower, parent = upper, position = [0, 0, -l1], rotation = rotation_x(a2) * rotation_y(b2))
)]
struct Rods {
    #[gauss(body)]
    upper: RigidBody<f64>,
    #[gauss(body)]
    lower: RigidBody<f64>,
    l1: f64,
    #[gauss(gravity)]
    g: f64,
}

/// The same rods by rotations; a universal joint keeps an axis of one body across an axis of the other.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(first: Rotation, second: Rotation),
    body(upper, rotation = first),
    body(lower, position = first * [0, 0, -l1], rotation = second),
    constraint(position = dot([1, 0, 0], upper.rotation * [0, 1, 0])),
    constraint(position = dot(upper.rotation * [1, 0, 0], lower.rotation * [0, 1, 0]))
)]
struct RodsInJoints {
    #[gauss(body)]
    upper: RigidBody<f64>,
    #[gauss(body)]
    lower: RigidBody<f64>,
    l1: f64,
    #[gauss(gravity)]
    g: f64,
}

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, theta),
    particle(mass = cart, position = [x, 0, 0]),
    particle(mass = bob, position = [x + l * sin(theta), 0, -l * cos(theta)])
)]
struct CartPole {
    cart: f64,
    bob: f64,
    l: f64,
    #[gauss(gravity)]
    g: f64,
}

/// Speeds of its own: that of the centre of mass along the rail, and that of the bob against the cart.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, theta),
    speeds(v, w),
    kinematics(x = v - bob / (cart + bob) * w * cos(theta), theta = w / l),
    particle(mass = cart, position = [x, 0, 0]),
    particle(mass = bob, position = [x + l * sin(theta), 0, -l * cos(theta)])
)]
struct CartPoleByCenter {
    cart: f64,
    bob: f64,
    l: f64,
    #[gauss(gravity)]
    g: f64,
}

/// The rail and the rod as constraints on two free particles, in the plane k₁k₃.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x1, z1, x2, z2),
    particle(mass = cart, position = [x1, 0, z1]),
    particle(mass = bob, position = [x2, 0, z2]),
    constraint(position = z1),
    constraint(position = (x2 - x1).powi(2) + (z2 - z1).powi(2) - l * l)
)]
struct CartPoleOnRail {
    cart: f64,
    bob: f64,
    l: f64,
    #[gauss(gravity)]
    g: f64,
}

/// A pendulum on the rotating Earth, by the horizontal coordinates of the bob in axes (east, north, up) that turn with
/// it.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    frame(earth, rotation = rotation_z(turn * t) * rotation_x(tilt)),
    particle(mass = m, parent = earth, position = [x, y, -sqrt(l * l - x * x - y * y)]),
    potential = -m * g * sqrt(l * l - x * x - y * y)
)]
struct Foucault {
    m: f64,
    l: f64,
    g: f64,
    /// Rate about the polar axis.
    turn: f64,
    /// Between the polar axis and the vertical.
    tilt: f64,
}

/// The same pendulum by two angles, and without a frame.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b),
    particle(mass = m, position = rotation_z(turn * t) * rotation_x(tilt) * rotation_x(a) * rotation_y(b) * [0, 0, -l]),
    potential = -m * g * l * cos(a) * cos(b)
)]
struct FoucaultByAngles {
    m: f64,
    l: f64,
    g: f64,
    turn: f64,
    tilt: f64,
}

const DOWN: Vector3<f64> = Vector3::new(0.0, 0.0, -1.0);

fn about(axis: usize, angle: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_axis_angle(&[Vector3::x_axis(), Vector3::y_axis(), Vector3::z_axis()][axis], angle)
}

/// R_x(a) R_y(b), and its angular velocity in body axes.
fn universal(a: f64, b: f64, va: f64, vb: f64) -> (UnitQuaternion<f64>, Vector3<f64>) {
    (about(0, a) * about(1, b), Vector3::new(va * b.cos(), vb, va * b.sin()))
}

/// R_x(a) R_y(b) (0, 0, −l) and its rate.
fn rod(l: f64, a: f64, b: f64, va: f64, vb: f64) -> (Vector3<f64>, Vector3<f64>) {
    let (rotation, omega) = universal(a, b, va, vb);
    (rotation * DOWN * l, rotation * omega.cross(&(DOWN * l)))
}

fn masses(q: &SVector<f64, 4>, z: &SVector<f64, 4>) -> [Vector3<f64>; 4] {
    let (x1, v1) = rod(1.0, q[0], q[1], z[0], z[1]);
    let (x2, v2) = rod(0.6, q[2], q[3], z[2], z[3]);
    [x1, x1 + x2, v1, v1 + v2]
}

fn flat<const N: usize>(parts: [Vector3<f64>; N]) -> Vec<f64> {
    parts.iter().flatten().copied().collect()
}

fn spatial_double_pendulum() -> (SpatialDoublePendulumKernel, MassesOnRodsKernel) {
    let (m1, m2, l1, l2, g) = (1.0, 0.7, 1.0, 0.6, 9.81);
    (
        SpatialDoublePendulum { m1, m2, l1, l2, g }.kernel().unwrap(),
        MassesOnRods { m1, m2, l1, l2, g }.kernel().unwrap(),
    )
}

fn to_masses(q: &SVector<f64, 4>, z: &SVector<f64, 4>) -> (SVector<f64, 6>, SVector<f64, 6>) {
    let [x1, x2, v1, v2] = masses(q, z);
    (SVector::from_iterator(flat([x1, x2])), SVector::from_iterator(flat([v1, v2])))
}

#[test]
fn spatial_double_pendulum_as_in_the_reference() {
    let (angles, particles) = spatial_double_pendulum();
    let name = "spatial_double_pendulum";
    let start = (SVector::from([0.9, 0.5, -0.4, 1.0]), SVector::from([0.3, -1.2, 2.0, 0.7]));
    Run { name, system: &angles, start }.agrees(1.0, |_, q, z| {
        let [x1, x2, v1, v2] = masses(q, z).map(|v| v.as_slice().to_vec());
        vec![("q", q.as_slice().to_vec()), ("x1", x1), ("x2", x2), ("v1", v1), ("v2", v2)]
    });
    let start = to_masses(&start.0, &start.1);
    Run { name, system: &particles, start }.agrees(1.0, |_, q, z| {
        let part = |v: &SVector<f64, 6>, i: usize| v.as_slice()[i..i + 3].to_vec();
        vec![("x1", part(q, 0)), ("x2", part(q, 3)), ("v1", part(z, 0)), ("v2", part(z, 3))]
    });
}

fn rods() -> (RodsKernel, RodsInJointsKernel) {
    let upper = RigidBody {
        mass: 1.5,
        center_of_mass: Vector3::new(0.01, -0.02, -0.45),
        inertia: Matrix3::new(0.42, 0.001, 0.008, 0.001, 0.41, -0.012, 0.008, -0.012, 0.03),
    };
    let lower = RigidBody {
        mass: 0.8,
        center_of_mass: Vector3::new(0.0, 0.015, -0.3),
        inertia: Matrix3::new(0.11, 0.0, 0.002, 0.0, 0.105, 0.004, 0.002, 0.004, 0.009),
    };
    let (l1, g) = (0.9, 9.81);
    (Rods { upper, lower, l1, g }.kernel().unwrap(), RodsInJoints { upper, lower, l1, g }.kernel().unwrap())
}

type Attitudes = (UnitQuaternion<f64>, UnitQuaternion<f64>);

/// Both rotations from Ω and both angular velocities in body axes.
fn to_joints(q: &SVector<f64, 4>, z: &SVector<f64, 4>) -> (Attitudes, SVector<f64, 6>) {
    let (first, one) = universal(q[0], q[1], z[0], z[1]);
    let (relative, two) = universal(q[2], q[3], z[2], z[3]);
    let two = relative.inverse() * one + two;
    ((first, first * relative), SVector::from_iterator(flat([one, two])))
}

#[test]
fn rods_as_in_the_reference() {
    let (angles, joints) = rods();
    let name = "spatial_double_pendulum_of_rods";
    let see = |(first, second): &Attitudes, z: &SVector<f64, 6>| {
        let (one, two) = (Vector3::new(z[0], z[1], z[2]), z.as_slice()[3..].to_vec());
        let (b, rate) = (first * DOWN * 0.9, first * one.cross(&(DOWN * 0.9)));
        vec![
            ("upper_R", rows(first)),
            ("upper_omega", one.as_slice().to_vec()),
            ("lower_b", b.as_slice().to_vec()),
            ("lower_bdot", rate.as_slice().to_vec()),
            ("lower_R", rows(second)),
            ("lower_omega", two),
        ]
    };
    let start = (SVector::from([0.8, 0.5, -0.6, 0.4]), SVector::from([0.3, -1.2, 2.0, 0.7]));
    Run { name, system: &angles, start }.agrees(1.0, |_, q, z| {
        let (attitudes, speeds) = to_joints(q, z);
        let mut seen = see(&attitudes, &speeds);
        seen.push(("q", q.as_slice().to_vec()));
        seen
    });
    let start = to_joints(&start.0, &start.1);
    Run { name, system: &joints, start }.agrees(1.0, |_, q, z| see(q, z));
}

fn cart_pole() -> (CartPoleKernel, CartPoleByCenterKernel, CartPoleOnRailKernel) {
    let (cart, bob, l, g) = (2.0, 0.3, 0.8, 9.81);
    (
        CartPole { cart, bob, l, g }.kernel().unwrap(),
        CartPoleByCenter { cart, bob, l, g }.kernel().unwrap(),
        CartPoleOnRail { cart, bob, l, g }.kernel().unwrap(),
    )
}

fn to_center(q: &SVector<f64, 2>, z: &SVector<f64, 2>) -> (SVector<f64, 2>, SVector<f64, 2>) {
    let w = 0.8 * z[1];
    (*q, SVector::from([z[0] + 0.3 / 2.3 * w * q[1].cos(), w]))
}

fn to_rail(q: &SVector<f64, 2>, z: &SVector<f64, 2>) -> (SVector<f64, 4>, SVector<f64, 4>) {
    let (s, c) = q[1].sin_cos();
    let w = 0.8 * z[1];
    (SVector::from([q[0], 0.0, q[0] + 0.8 * s, -0.8 * c]), SVector::from([z[0], 0.0, z[0] + w * c, w * s]))
}

#[test]
fn cart_pole_as_in_the_reference() {
    let (rates, center, rail) = cart_pole();
    let name = "cart_pole";
    let see = |q: &SVector<f64, 4>, z: &SVector<f64, 4>| {
        let pair = |a: f64, b: f64| vec![a, 0.0, b];
        vec![("x1", pair(q[0], q[1])), ("x2", pair(q[2], q[3])), ("v1", pair(z[0], z[1])), ("v2", pair(z[2], z[3]))]
    };
    let (q, z) = (SVector::from([0.5, 2.8]), SVector::from([0.2, 0.5]));
    Run { name, system: &rates, start: (q, z) }.agrees(1.0, |_, q, z| {
        let (x, v) = to_rail(q, z);
        [vec![("q", q.as_slice().to_vec()), ("z", z.as_slice().to_vec())], see(&x, &v)].concat()
    });
    Run { name, system: &center, start: to_center(&q, &z) }.agrees(1.0, |_, q, z| {
        let theta = z[1] / 0.8;
        let z = SVector::from([z[0] - 0.3 / 2.3 * z[1] * q[1].cos(), theta]);
        let (x, v) = to_rail(q, &z);
        see(&x, &v)
    });
    Run { name, system: &rail, start: to_rail(&q, &z) }.agrees(1.0, |_, q, z| see(q, z));
}

fn foucault(m: f64, l: f64, turn: f64, latitude: f64) -> (FoucaultKernel, FoucaultByAnglesKernel) {
    let (g, tilt) = (9.81, std::f64::consts::FRAC_PI_2 - latitude);
    let angles = FoucaultByAngles { m, l, g, turn, tilt }.kernel().unwrap();
    (Foucault { m, l, g, turn, tilt }.kernel().unwrap(), angles)
}

/// East and north of the bob and their rates.
fn horizontal(l: f64, q: &SVector<f64, 2>, z: &SVector<f64, 2>) -> (SVector<f64, 2>, SVector<f64, 2>) {
    let (x, v) = rod(l, q[0], q[1], z[0], z[1]);
    (SVector::from([x.x, x.y]), SVector::from([v.x, v.y]))
}

#[test]
fn foucault_pendulum_as_in_the_reference() {
    let (l, turn, latitude) = (1.2, 0.3, 0.85);
    let (coordinates, angles) = foucault(0.7, l, turn, latitude);
    let name = "foucault_pendulum";
    let see = |t: f64, q: &SVector<f64, 2>, z: &SVector<f64, 2>| {
        let up = -(l * l - q.dot(q)).sqrt();
        let (x, v) = (Vector3::new(q[0], q[1], up), Vector3::new(z[0], z[1], -q.dot(z) / up));
        let earth = about(2, turn * t) * about(0, std::f64::consts::FRAC_PI_2 - latitude);
        let inertial = earth * x;
        let rate = earth * v + Vector3::new(0.0, 0.0, turn).cross(&inertial);
        vec![
            ("local_x", x.as_slice().to_vec()),
            ("local_v", v.as_slice().to_vec()),
            ("inertial_x", inertial.as_slice().to_vec()),
            ("inertial_v", rate.as_slice().to_vec()),
        ]
    };
    let (q, z) = (SVector::from([0.5, -0.2]), SVector::from([0.1, 0.4]));
    Run { name, system: &coordinates, start: (q, z) }.agrees(1.0, see);
    // y = l sin a cos b, x = −l sin b; the rates from the two horizontal components.
    let b = (-q[0] / l).asin();
    let a = (q[1] / (l * b.cos())).asin();
    let vb = -z[0] / (l * b.cos());
    let va = (z[1] + l * a.sin() * b.sin() * vb) / (l * a.cos() * b.cos());
    let start = (SVector::from([a, b]), SVector::from([va, vb]));
    Run { name, system: &angles, start }.agrees(1.0, |t, q, z| {
        let (q, z) = horizontal(l, q, z);
        see(t, &q, &z)
    });
}

/// Released at rest on the Earth, the plane of the swing turns by −Ω sin λ.
#[test]
fn foucault_precession() {
    let name = "foucault_precession";
    let (l, turn, latitude, duration) = (67.0, 7.292_115e-5, 0.8526_f64, 600.0);
    let (kernel, _) = foucault(28.0, l, turn, latitude);
    let start = (SVector::from([0.67, 0.0]), SVector::from([0.0, 0.0]));
    // See the note in the reference for the azimuth.
    let azimuth = |q: &SVector<f64, 2>, z: &SVector<f64, 2>| {
        let (sine, cosine) = latitude.sin_cos();
        let (x, y) = (q[0], q[1] - turn * turn * sine * cosine * l * l / 9.81);
        let (vx, vy) = (z[0] - turn * sine * y, z[1] + turn * sine * x);
        let ratio = l / 9.81;
        0.5 * (2.0 * (x * y + ratio * vx * vy)).atan2(x * x - y * y + ratio * (vx * vx - vy * vy))
    };
    Run { name, system: &kernel, start }
        .agrees(1.0, |_, q, z| vec![("q", q.as_slice().to_vec()), ("z", z.as_slice().to_vec())]);
    let end = Simulation::new(&kernel).adaptive(1e-12, 1e-13).run_to_end(start.0, start.1, 0.0..duration).unwrap();
    let change = azimuth(&end.q, &end.z) - azimuth(&start.0, &start.1);
    let relative = change / (-turn * latitude.sin() * duration) - 1.0;
    // An ellipse of half-axes a, b turns by 3/8 a b/l² √(g/l) more; b = −a Ω sin λ √(l/g) makes that −3/8 (a/l)² of Ω
    // sin λ. The next term is smaller by (a/l)², and a hundredth of this one is room for the ripple within a period.
    let ellipse = -3.0 / 8.0 * (0.67_f64 / l).powi(2);
    assert!((relative / ellipse - 1.0).abs() < 0.01, "{relative:e} {ellipse:e}");
    let listed: f64 = reference(name)["precession"]["change_of_azimuth_of_swing"].as_str().unwrap().parse().unwrap();
    // Thirteen digits are listed, and the run has twelve.
    assert!((change - listed).abs() < 1e-12, "{change} {listed}");
}

/// Angles of a joint away from where its two axes are one, and rates.
fn joint_angles() -> impl Strategy<Value = [f64; 4]> {
    (-3.0..3.0, -1.0..1.0, -3.0..3.0, -1.0..1.0).prop_map(|(a, b, c, d)| [a, b, c, d])
}

#[test]
fn cart_pole_has_the_textbook_equations() {
    let (cart, bob, l, g) = (2.0, 0.3, 0.8, 9.81);
    let kernel = CartPole { cart, bob, l, g }.kernel().unwrap();
    for (theta, rate) in [(0.4, 1.1), (-2.0, 0.3), (3.0, -4.0)] {
        let a = kernel.acceleration(0.0, &SVector::from([0.5, theta]), &SVector::from([0.2, rate]), &());
        let (s, c) = f64::sin_cos(theta);
        let force = (cart + bob) * a[0] + bob * l * (c * a[1] - s * rate * rate);
        let torque = l * a[1] + c * a[0] + g * s;
        // Terms of order ten, some tens of roundings.
        assert!(force.abs() < 1e-13 && torque.abs() < 1e-13, "{force:e} {torque:e}");
    }
    let (q, z) = (SVector::from([0.1, 2.0]), SVector::from([1.0, -2.0]));
    laws(&kernel, 0.6, &q, &z, Time::Absent);
    least(&kernel, 0.6, &q, &z);
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn spatial_double_pendulum_at_random(
        q in joint_angles(), z in prop::array::uniform4(-3.0..3.0_f64), off in prop::array::uniform12(-0.05..0.05_f64)
    ) {
        let (angles, particles) = spatial_double_pendulum();
        let (q, z) = (SVector::from(q), SVector::from(z));
        laws(&angles, 0.0, &q, &z, Time::Absent);
        least(&angles, 0.0, &q, &z);
        corresponds(&angles, &particles, 0.0, (&q, &z), |_, q, z| to_masses(q, z));
        let (q, z) = to_masses(&q, &z);
        let near = (SVector::from_fn(|i, _| q[i] + off[i]), SVector::from_fn(|i, _| z[i] + 10.0 * off[i + 6]));
        position_rates(&particles, 0.0, &near.0, &near.1);
        let (q, z) = particles.project(0.0, &near.0, &near.1).unwrap();
        laws(&particles, 0.0, &q, &z, Time::Absent);
        constrained_laws(&particles, 0.0, &q, &z);
    }

    #[test]
    fn rods_at_random(
        q in joint_angles(), z in prop::array::uniform4(-3.0..3.0_f64), off in prop::array::uniform12(-0.05..0.05_f64)
    ) {
        let (angles, joints) = rods();
        let (q, z) = (SVector::from(q), SVector::from(z));
        laws(&angles, 0.0, &q, &z, Time::Absent);
        least(&angles, 0.0, &q, &z);
        corresponds(&angles, &joints, 0.0, (&q, &z), |_, q, z| to_joints(q, z));
        let (q, z) = to_joints(&q, &z);
        let turn = |i: usize| UnitQuaternion::from_scaled_axis(Vector3::new(off[i], off[i + 1], off[i + 2]));
        let near = ((q.0 * turn(0), q.1 * turn(3)), SVector::from_fn(|i, _| z[i] + 10.0 * off[i + 6]));
        position_rates(&joints, 0.0, &near.0, &near.1);
        let (q, z) = joints.project(0.0, &near.0, &near.1).unwrap();
        laws(&joints, 0.0, &q, &z, Time::Absent);
        constrained_laws(&joints, 0.0, &q, &z);
    }

    #[test]
    fn cart_pole_at_random(
        x in -2.0..2.0_f64, theta in -3.0..3.0_f64, z in prop::array::uniform2(-3.0..3.0_f64),
        off in prop::array::uniform8(-0.05..0.05_f64)
    ) {
        let (rates, center, rail) = cart_pole();
        let (q, z) = (SVector::from([x, theta]), SVector::from(z));
        laws(&rates, 0.0, &q, &z, Time::Absent);
        least(&rates, 0.0, &q, &z);
        corresponds(&rates, &center, 0.0, (&q, &z), |_, q, z| to_center(q, z));
        corresponds(&rates, &rail, 0.0, (&q, &z), |_, q, z| to_rail(q, z));
        let (same, speeds) = to_center(&q, &z);
        laws(&center, 0.0, &same, &speeds, Time::Absent);
        least(&center, 0.0, &same, &speeds);
        let (q, z) = to_rail(&q, &z);
        let near = (SVector::from_fn(|i, _| q[i] + off[i]), SVector::from_fn(|i, _| z[i] + 10.0 * off[i + 4]));
        position_rates(&rail, 0.0, &near.0, &near.1);
        let (q, z) = rail.project(0.0, &near.0, &near.1).unwrap();
        laws(&rail, 0.0, &q, &z, Time::Absent);
        constrained_laws(&rail, 0.0, &q, &z);
    }

    #[test]
    fn foucault_pendulum_at_random(
        t in -10.0..10.0_f64, q in prop::array::uniform2(-0.6..0.6_f64), z in prop::array::uniform2(-1.0..1.0_f64)
    ) {
        let l = 1.2;
        let (coordinates, angles) = foucault(0.7, l, 0.3, 0.85);
        let (q, z) = (SVector::from(q), SVector::from(z));
        laws(&angles, t, &q, &z, Time::Hidden);
        balance(&angles, t, (&q, &z), &());
        least(&angles, t, &q, &z);
        corresponds(&angles, &coordinates, t, (&q, &z), |_, q, z| horizontal(l, q, z));
        let (x, v) = horizontal(l, &q, &z);
        laws(&coordinates, t, &x, &v, Time::Hidden);
        balance(&coordinates, t, (&x, &v), &());
        least(&coordinates, t, &x, &v);
    }
}
