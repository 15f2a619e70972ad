//! Free bodies with something on them: a flywheel on an axle, a load on a cable. Configurations mix poses and angles.

use gauss_runtime::nalgebra::Unit;
use gauss_runtime::prelude::*;
use gauss_tests::laws::{Time, constrained_laws, corresponds, laws, least, position_rates};
use gauss_tests::trajectory::{Run, Seen, number, numbers, reference, rotation, rows, triple};
use proptest::prelude::*;
use serde_json::Value;

/// A body with a wheel on an axle: pose and angle, their rates seen from the body.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose, phi),
    body(hull, position = pose.position, rotation = pose.rotation),
    body(wheel, parent = hull, position = axle, rotation = rotation_y(tilt) * rotation_z(phi))
)]
struct Gyrostat {
    #[gauss(body)]
    hull: RigidBody<f64>,
    #[gauss(body)]
    wheel: RigidBody<f64>,
    axle: Vector3<f64>,
    tilt: f64,
}

/// The same with the twist in the observer's axes, pole Ω, to which the total momentum belongs.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose, phi),
    speeds(xi: Vector3, w: Vector3, rate_of_phi),
    kinematics(
        pose = twist(inverse(pose.rotation) * (xi + cross(w, pose.position)), inverse(pose.rotation) * w),
        phi = rate_of_phi
    ),
    body(hull, position = pose.position, rotation = pose.rotation),
    body(wheel, parent = hull, position = axle, rotation = rotation_y(tilt) * rotation_z(phi))
)]
struct GyrostatFromSpace {
    #[gauss(body)]
    hull: RigidBody<f64>,
    #[gauss(body)]
    wheel: RigidBody<f64>,
    axle: Vector3<f64>,
    tilt: f64,
}

/// Both bodies free, and five constraints that make the axle.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(first: Pose, second: Pose),
    body(hull, position = first.position, rotation = first.rotation),
    body(wheel, position = second.position, rotation = second.rotation),
    point(bearing, body = hull, at = axle),
    constraint(position = wheel.position - bearing),
    constraint(position = dot(hull.rotation * [cos(tilt), 0, -sin(tilt)], wheel.rotation * [0, 0, 1])),
    constraint(position = dot(hull.rotation * [0, 1, 0], wheel.rotation * [0, 0, 1]))
)]
struct GyrostatOfTwo {
    #[gauss(body)]
    hull: RigidBody<f64>,
    #[gauss(body)]
    wheel: RigidBody<f64>,
    axle: Vector3<f64>,
    tilt: f64,
}

/// A quadrotor's frame and a load on a rigid cable, whose angles are from the vertical.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose, a1, a2),
    body(hull, position = pose.position, rotation = pose.rotation),
    point(hook, body = hull, at = h),
    particle(mass = load, position = hook + rotation_x(a1) * rotation_y(a2) * [0, 0, -l])
)]
struct Quadrotor {
    #[gauss(body)]
    hull: RigidBody<f64>,
    h: Vector3<f64>,
    load: f64,
    l: f64,
    #[gauss(gravity)]
    g: f64,
}

/// The load as a free particle, and the length of the cable as a constraint.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose, x, y, z),
    body(hull, position = pose.position, rotation = pose.rotation),
    point(hook, body = hull, at = h),
    particle(mass = load, position = [x, y, z]),
    constraint(position = dot([x, y, z] - hook, [x, y, z] - hook) - l * l)
)]
struct QuadrotorAndLoad {
    #[gauss(body)]
    hull: RigidBody<f64>,
    h: Vector3<f64>,
    load: f64,
    l: f64,
    #[gauss(gravity)]
    g: f64,
}

fn body(value: &Value) -> RigidBody<f64> {
    RigidBody {
        mass: number(&value["mass"]),
        center_of_mass: triple(&value["centre_of_mass_body_from_O"]),
        inertia: Matrix3::from_row_slice(&numbers(&value["inertia_about_O"])),
    }
}

fn gyrostats(scene: &Value) -> (GyrostatKernel, GyrostatFromSpaceKernel, GyrostatOfTwoKernel) {
    let p = &scene["parameters"];
    let (hull, wheel) = (body(&p["body"]), body(&p["wheel"]));
    let (axle, tilt) = (triple(&p["wheel_position"]), number(&p["tilt"]));
    (
        Gyrostat { hull, wheel, axle, tilt }.kernel().unwrap(),
        GyrostatFromSpace { hull, wheel, axle, tilt }.kernel().unwrap(),
        GyrostatOfTwo { hull, wheel, axle, tilt }.kernel().unwrap(),
    )
}

type PoseAndAngle = (Isometry3<f64>, SVector<f64, 1>);
type OnAxle = (PoseAndAngle, SVector<f64, 7>);
type OfTwo = ((Isometry3<f64>, Isometry3<f64>), SVector<f64, 12>);

fn pose(rotation: UnitQuaternion<f64>, position: Vector3<f64>) -> Isometry3<f64> {
    Isometry3 { rotation, translation: Translation3 { vector: position } }
}

fn part<const N: usize>(z: &SVector<f64, N>, i: usize) -> Vector3<f64> {
    Vector3::new(z[i], z[i + 1], z[i + 2])
}

fn join<const N: usize>(parts: &[&[f64]]) -> SVector<f64, N> {
    SVector::from_iterator(parts.concat())
}

fn about(axis: Unit<Vector3<f64>>, angle: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_axis_angle(&axis, angle)
}

/// The axle of the references, and its tilt about the second axis.
const AXLE: Vector3<f64> = Vector3::new(0.3, 0.1, -0.2);
const TILT: f64 = 0.4;

fn to_space((pose, phi): &PoseAndAngle, z: &SVector<f64, 7>) -> OnAxle {
    let (velocity, omega) = (pose.rotation * part(z, 0), pose.rotation * part(z, 3));
    let xi = velocity - omega.cross(&pose.translation.vector);
    ((*pose, *phi), join(&[xi.as_slice(), omega.as_slice(), &[z[6]]]))
}

fn to_body((pose, phi): &PoseAndAngle, z: &SVector<f64, 7>) -> OnAxle {
    let (xi, omega) = (part(z, 0), part(z, 3));
    let u = pose.rotation.inverse() * (xi + omega.cross(&pose.translation.vector));
    let w = pose.rotation.inverse() * omega;
    ((*pose, *phi), join(&[u.as_slice(), w.as_slice(), &[z[6]]]))
}

fn to_two((hull, phi): &PoseAndAngle, z: &SVector<f64, 7>) -> OfTwo {
    let turn = about(Vector3::y_axis(), TILT) * about(Vector3::z_axis(), phi[0]);
    let (u, omega) = (part(z, 0), part(z, 3));
    let back = turn.inverse();
    let there = back * (u + omega.cross(&AXLE));
    let spin = back * omega + Vector3::z() * z[6];
    let wheel = pose(hull.rotation * turn, hull.translation.vector + hull.rotation * AXLE);
    ((*hull, wheel), join(&[u.as_slice(), omega.as_slice(), there.as_slice(), spin.as_slice()]))
}

fn initial_on_axle(scene: &Value) -> OnAxle {
    let initial = &scene["initial"];
    let keys = ["body_u", "body_omega", "phi_rate"];
    let speeds: Vec<f64> = keys.iter().flat_map(|key| numbers(&initial[key])).collect();
    let phi = SVector::from([numbers(&initial["phi"])[0]]);
    ((pose(rotation(&initial["R"]), triple(&initial["b"])), phi), SVector::from_iterator(speeds))
}

/// What the references list of both bodies.
fn seen((hull, wheel): &(Isometry3<f64>, Isometry3<f64>), z: &[f64]) -> Seen {
    vec![
        ("R", rows(&hull.rotation)),
        ("b", hull.translation.vector.as_slice().to_vec()),
        ("body_u", z[..3].to_vec()),
        ("body_omega", z[3..6].to_vec()),
        ("wheel_R", rows(&wheel.rotation)),
    ]
}

#[test]
fn gyrostats_as_in_the_references() {
    for name in ["body_with_flywheel", "body_with_unbalanced_wheel"] {
        let scene = reference(name);
        let (on_axle, from_space, of_two) = gyrostats(&scene);
        let start = initial_on_axle(&scene);
        let see = |q: &PoseAndAngle, z: &SVector<f64, 7>| {
            let (poses, speeds) = to_two(q, z);
            let angle = vec![("phi", q.1.as_slice().to_vec()), ("phi_rate", vec![z[6]])];
            [seen(&poses, speeds.as_slice()), angle].concat()
        };
        Run { name, system: &on_axle, start }.agrees(1.0, |_, q, z| see(q, z));
        // ξ and ω̂ about a point three metres off.
        Run { name, system: &from_space, start: to_space(&start.0, &start.1) }.agrees(4.0, |_, q, z| {
            let (q, z) = to_body(q, z);
            see(&q, &z)
        });
        let start = to_two(&start.0, &start.1);
        Run { name, system: &of_two, start }.agrees(1.0, |_, q, z| seen(q, z.as_slice()));
    }
}

/// The first six p of the twist in the observer's axes are (Q̂, Γ̂_Ω) of both bodies together.
#[test]
fn the_total_momentum_of_a_gyrostat_is_kept() {
    for name in ["body_with_flywheel", "body_with_unbalanced_wheel"] {
        let scene = reference(name);
        let (_, kernel, _) = gyrostats(&scene);
        let start = initial_on_axle(&scene);
        let (q, z) = to_space(&start.0, &start.1);
        let expected = [&scene["conserved"]["momentum"], &scene["conserved"]["angular_momentum_about_Omega"]];
        let expected: Vec<f64> = expected.iter().flat_map(|c| numbers(&c["value_t0"])).collect();
        let mut worst = 0.0_f64;
        Simulation::new(&kernel)
            .momentum_form()
            .control(Adaptive::with(&Tableau::DORMAND_PRINCE_5, 1e-9, 1e-9))
            .observe(|sample| {
                for i in 0..6 {
                    worst = worst.max((sample.p[i] - expected[i]).abs());
                }
            })
            .run_to_end(q, z, 0.0..4.0)
            .unwrap();
        // Stages on the group, where ṗ = 0 because R is orthogonal: a tolerance of 1e-9 in the steps, and the momenta
        // do not care. Ten roundings of terms up to ten at the start.
        assert!(worst <= 100.0 * f64::EPSILON, "{name}: {worst:e}");
    }
}

fn quadrotors(scene: &Value) -> (QuadrotorKernel, QuadrotorAndLoadKernel) {
    let p = &scene["parameters"];
    let (hull, h) = (body(&p["frame"]), triple(&p["hook"]));
    let (load, l, g) = (number(&p["load"]), number(&p["l"]), number(&p["g"]));
    (Quadrotor { hull, h, load, l, g }.kernel().unwrap(), QuadrotorAndLoad { hull, h, load, l, g }.kernel().unwrap())
}

type OnCable = (Isometry3<f64>, SVector<f64, 2>);
type WithLoad = ((Isometry3<f64>, SVector<f64, 3>), SVector<f64, 9>);

/// The hook and the cable of the reference.
const HOOK: Vector3<f64> = Vector3::new(0.05, 0.02, -0.1);
const CABLE: f64 = 0.8;

fn with_load((hull, angles): &OnCable, z: &SVector<f64, 8>) -> WithLoad {
    let cable = about(Vector3::x_axis(), angles[0]) * about(Vector3::y_axis(), angles[1]);
    let along = Vector3::new(0.0, 0.0, -CABLE);
    let turn = Vector3::new(z[6] * angles[1].cos(), z[7], z[6] * angles[1].sin());
    let (u, omega) = (part(z, 0), part(z, 3));
    let load = hull.translation.vector + hull.rotation * HOOK + cable * along;
    let velocity = hull.rotation * (u + omega.cross(&HOOK)) + cable * turn.cross(&along);
    ((*hull, load), join(&[&z.as_slice()[..6], velocity.as_slice()]))
}

#[test]
fn quadrotor_with_slung_load_as_in_the_reference() {
    let name = "quadrotor_slung_load";
    let scene = reference(name);
    let (angles, load) = quadrotors(&scene);
    let initial = &scene["initial"];
    let keys = ["body_u", "body_omega", "angle_rates"];
    let speeds: Vec<f64> = keys.iter().flat_map(|key| numbers(&initial[key])).collect();
    let q = (pose(rotation(&initial["R"]), triple(&initial["b"])), SVector::from_iterator(numbers(&initial["angles"])));
    let z = SVector::from_iterator(speeds);
    let see = |(hull, load): &(Isometry3<f64>, SVector<f64, 3>), z: &SVector<f64, 9>| {
        vec![
            ("R", rows(&hull.rotation)),
            ("b", hull.translation.vector.as_slice().to_vec()),
            ("body_u", z.as_slice()[..3].to_vec()),
            ("body_omega", z.as_slice()[3..6].to_vec()),
            ("load", load.as_slice().to_vec()),
            ("load_velocity", z.as_slice()[6..].to_vec()),
        ]
    };
    Run { name, system: &angles, start: (q, z) }.agrees(1.0, |_, q, z| {
        let angles = vec![("angles", q.1.as_slice().to_vec()), ("angle_rates", z.as_slice()[6..].to_vec())];
        let (q, z) = with_load(q, z);
        [see(&q, &z), angles].concat()
    });
    Run { name, system: &load, start: with_load(&q, &z) }.agrees(1.0, |_, q, z| see(q, z));
}

prop_compose! {
    fn any_pose()(
        turn in prop::array::uniform3(-1.7..1.7_f64), position in prop::array::uniform3(-2.0..2.0_f64)
    ) -> Isometry3<f64> {
        pose(UnitQuaternion::from_scaled_axis(Vector3::from(turn)), Vector3::from(position))
    }
}

/// A little away from a pose.
fn beside(q: &Isometry3<f64>, off: &[f64]) -> Isometry3<f64> {
    q.retract(&Vector6::from_column_slice(&off[..6]))
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn gyrostats_at_random(
        hull in any_pose(), phi in -3.0..3.0_f64, z in prop::array::uniform7(-2.0..2.0_f64),
        off in prop::array::uniform24(-0.03..0.03_f64)
    ) {
        let (on_axle, from_space, of_two) = gyrostats(&reference("body_with_unbalanced_wheel"));
        let (q, z) = ((hull, SVector::from([phi])), SVector::from(z));
        laws(&on_axle, 0.0, &q, &z, Time::Absent);
        least(&on_axle, 0.0, &q, &z);
        corresponds(&on_axle, &from_space, 0.0, (&q, &z), |_, q, z| to_space(q, z));
        corresponds(&on_axle, &of_two, 0.0, (&q, &z), |_, q, z| to_two(q, z));
        let (same, space) = to_space(&q, &z);
        laws(&from_space, 0.0, &same, &space, Time::Absent);
        least(&from_space, 0.0, &same, &space);
        corresponds(&from_space, &on_axle, 0.0, (&same, &space), |_, q, z| to_body(q, z));
        let (q, z) = to_two(&q, &z);
        let near = (
            (beside(&q.0, &off[..6]), beside(&q.1, &off[6..12])),
            SVector::from_fn(|i, _| z[i] + 10.0 * off[i + 12]),
        );
        position_rates(&of_two, 0.0, &near.0, &near.1);
        let (q, z) = of_two.project(0.0, &near.0, &near.1).unwrap();
        laws(&of_two, 0.0, &q, &z, Time::Absent);
        constrained_laws(&of_two, 0.0, &q, &z);
    }

    #[test]
    fn quadrotor_with_slung_load_at_random(
        hull in any_pose(), a1 in -3.0..3.0_f64, a2 in -1.0..1.0_f64, z in prop::array::uniform8(-2.0..2.0_f64),
        off in prop::array::uniform18(-0.03..0.03_f64)
    ) {
        let (angles, load) = quadrotors(&reference("quadrotor_slung_load"));
        let (q, z) = ((hull, SVector::from([a1, a2])), SVector::from(z));
        laws(&angles, 0.0, &q, &z, Time::Absent);
        least(&angles, 0.0, &q, &z);
        corresponds(&angles, &load, 0.0, (&q, &z), |_, q, z| with_load(q, z));
        let (q, z) = with_load(&q, &z);
        let near = (
            (beside(&q.0, &off[..6]), SVector::from_fn(|i, _| q.1[i] + off[6 + i])),
            SVector::from_fn(|i, _| z[i] + 10.0 * off[i + 9]),
        );
        position_rates(&load, 0.0, &near.0, &near.1);
        let (q, z) = load.project(0.0, &near.0, &near.1).unwrap();
        laws(&load, 0.0, &q, &z, Time::Absent);
        constrained_laws(&load, 0.0, &q, &z);
    }
}
