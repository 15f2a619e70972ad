//! The Chaplygin sleigh: a body on a plane with a knife edge at O, which slides along e₁ and not along e₂. G = O + a
//! e₁.

use gauss_runtime::prelude::*;
use gauss_tests::laws::{Time, constrained_laws, corresponds, laws, least};
use gauss_tests::nonholonomic::{precise, rigid_state, state_of_twist};
use gauss_tests::trajectory::{Run, Seen, reference, rotation};
use proptest::prelude::*;

/// Speeds that solve the constraint.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, theta),
    speeds(v, omega),
    kinematics(x = v * cos(theta), y = v * sin(theta), theta = omega),
    body(position = [x, y, 0], rotation = rotation_z(theta))
)]
struct OwnSpeeds {
    #[gauss(mass)]
    m: f64,
    #[gauss(center_of_mass)]
    a: Vector3<f64>,
    #[gauss(inertia)]
    j: Vector3<f64>,
}

/// The edge as a constraint on the rates of the coordinates, with a multiplier.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, theta),
    body(sleigh, position = [x, y, 0], rotation = rotation_z(theta)),
    constraint(velocity = dot(sleigh.velocity, sleigh.rotation * [0, 1, 0])),
)]
struct Edge {
    #[gauss(body)]
    sleigh: RigidBody<f64>,
}

/// The same constraint written out, solved for one of the velocities in body axes.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, theta),
    speeds(along, across, omega),
    kinematics(
        x = along * cos(theta) - across * sin(theta),
        y = along * sin(theta) + across * cos(theta),
        theta = omega,
    ),
    body(sleigh, position = [x, y, 0], rotation = rotation_z(theta)),
    constraint(velocity = rate(y) * cos(theta) - rate(x) * sin(theta)),
    independent(along, omega),
)]
struct Eliminated {
    #[gauss(body)]
    sleigh: RigidBody<f64>,
}

/// A pose in space: the edge beside the three constraints that keep the body in the plane, two on velocities and one on
/// positions.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(sleigh, position = pose.position, rotation = pose.rotation),
    constraint(velocity = dot(sleigh.velocity, sleigh.rotation * [0, 1, 0])),
    constraint(position = pose.position.z),
    constraint(velocity = dot(sleigh.angular_velocity, pose.rotation * [1, 0, 0])),
    constraint(velocity = dot(sleigh.angular_velocity, pose.rotation * [0, 1, 0])),
)]
struct InSpace {
    #[gauss(body)]
    sleigh: RigidBody<f64>,
}

const MASS: f64 = 1.2;
const LEVER: f64 = 0.3;
/// About G.
const INERTIA: f64 = 0.5;

fn body() -> RigidBody<f64> {
    let steiner = MASS * LEVER * LEVER;
    // What is about e₁ and e₂ does not enter the motion.
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.4, 0.4 + steiner, INERTIA + steiner));
    RigidBody { mass: MASS, center_of_mass: Vector3::new(LEVER, 0.0, 0.0), inertia }
}

fn own_speeds() -> OwnSpeedsKernel {
    let RigidBody { mass, center_of_mass, inertia } = body();
    OwnSpeeds { m: mass, a: center_of_mass, j: inertia.diagonal() }.kernel().unwrap()
}

fn edge() -> EdgeKernel {
    Edge { sleigh: body() }.kernel().unwrap()
}

fn eliminated() -> EliminatedKernel {
    Eliminated { sleigh: body() }.kernel().unwrap()
}

fn in_space() -> InSpaceKernel {
    InSpace { sleigh: body() }.kernel().unwrap()
}

/// ẋ, ẏ, θ̇ of v and ω at θ.
fn rates(theta: f64, v: f64, omega: f64) -> SVector<f64, 3> {
    SVector::from([v * theta.cos(), v * theta.sin(), omega])
}

fn planar(q: &SVector<f64, 3>, rates: &SVector<f64, 3>) -> Seen {
    let rotation = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), q[2]);
    let pose = Isometry3::from_parts(Translation3::new(q[0], q[1], 0.0), rotation);
    rigid_state(&pose, Vector3::new(rates[0], rates[1], 0.0), Vector3::new(0.0, 0.0, rates[2]))
}

#[test]
fn every_way_gives_the_reference() {
    let name = "chaplygin_sleigh";
    let (q, v, omega) = (SVector::from([0.0, 0.0, 0.25]), 0.4, 1.5);
    let start = (q, SVector::from([v, omega]));
    let two = |_: f64, q: &SVector<f64, 3>, z: &SVector<f64, 2>| planar(q, &rates(q[2], z[0], z[1]));
    Run { name, system: &own_speeds(), start }.agrees(1.0, two);
    Run { name, system: &eliminated(), start }.agrees(1.0, two);
    Run { name, system: &edge(), start: (q, rates(q[2], v, omega)) }.agrees(1.0, |_, q, z| planar(q, z));
    let pose = Isometry3::from_parts(Translation3::identity(), rotation(&reference(name)["initial"]["R"]));
    let start = (pose, SVector::from([v, 0.0, 0.0, 0.0, 0.0, omega]));
    Run { name, system: &in_space(), start }.agrees(1.0, |_, pose, z| state_of_twist(pose, z));
}

#[test]
fn solving_the_constraint_is_choosing_speeds() {
    // The same equations are found, and they cost the same.
    let (own, solved) = (OwnSpeedsKernel::OPERATIONS, EliminatedKernel::OPERATIONS);
    assert_eq!(solved.acceleration, own.acceleration);
    assert_eq!((EliminatedKernel::DOF, EliminatedKernel::CONSTRAINED), (2, false));
    const { assert!(EdgeKernel::CONSTRAINED) };
}

#[test]
fn the_motion_ends_straight() {
    // However it starts, the sleigh ends with G ahead of O, all energy in the translation.
    let kernel = own_speeds();
    let start = SVector::from([-1.0, 0.2]);
    let energy = kernel.kinetic_energy(0.0, &SVector::zeros(), &start);
    let last = Simulation::new(&kernel).control(precise()).run_to_end(SVector::zeros(), start, 0.0..60.0).unwrap();
    let final_speed = (2.0 * energy / MASS).sqrt();
    // ω decays like exp(−k t), k = m a v/I_O; at the end far below rounding, so that the energy's drift is what is
    // seen.
    assert!(last.z[1].abs() < 1e-12 && (last.z[0] - final_speed).abs() < 1e-11, "{}", last.z);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn laws_agreement_and_the_force_of_the_edge(
        q in prop::array::uniform3(-3.0_f64..3.0), v in -2.0..2.0, omega in -2.0..2.0,
    ) {
        let (own, edge, eliminated, space) = (own_speeds(), edge(), eliminated(), in_space());
        let (q, z) = (SVector::from(q), SVector::from([v, omega]));
        let (s, c) = q[2].sin_cos();
        let full = rates(q[2], v, omega);
        let rotation = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), q[2]);
        let pose = Isometry3::from_parts(Translation3::new(q[0], q[1], 0.0), rotation);
        let twist = SVector::from([v, 0.0, 0.0, 0.0, 0.0, omega]);
        laws(&own, 0.0, &q, &z, Time::Absent);
        laws(&eliminated, 0.0, &q, &z, Time::Absent);
        least(&own, 0.0, &q, &z);
        least(&eliminated, 0.0, &q, &z);
        laws(&edge, 0.0, &q, &full, Time::Absent);
        constrained_laws(&edge, 0.0, &q, &full);
        laws(&space, 0.0, &pose, &twist, Time::Absent);
        constrained_laws(&space, 0.0, &pose, &twist);
        corresponds(&own, &edge, 0.0, (&q, &z), |_, q, z| (*q, rates(q[2], z[0], z[1])));
        corresponds(&own, &space, 0.0, (&q, &z), |_, q, z| {
            let rotation = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), q[2]);
            let pose = Isometry3::from_parts(Translation3::new(q[0], q[1], 0.0), rotation);
            (pose, SVector::from([z[0], 0.0, 0.0, 0.0, 0.0, z[1]]))
        });

        // v̇ = a ω², I_O ω̇ = −m a v ω; the edge gives G, which moves with v and a ω along e₁ and e₂, the rest of its
        // acceleration.
        let about_edge = INERTIA + MASS * LEVER * LEVER;
        let expected = [LEVER * omega * omega, -MASS * LEVER * v * omega / about_edge];
        let force = MASS * v * omega * INERTIA / about_edge;
        let found = own.acceleration(0.0, &q, &z, &());
        let solved = eliminated.acceleration(0.0, &q, &z, &());
        let free = edge.acceleration(0.0, &q, &full, &());
        // Tens of roundings of terms of order ten.
        let close = |a: f64, b: f64| (a - b).abs() <= 1e-13;
        prop_assert!((0..2).all(|k| close(found[k], expected[k]) && close(solved[k], expected[k])), "{found} {solved}");
        let expected = [c * expected[0] - s * v * omega, s * expected[0] + c * v * omega, expected[1]];
        prop_assert!((0..3).all(|k| close(free[k], expected[k])), "{free} {expected:?}");
        for lambda in [edge.multipliers(0.0, &q, &full, &())[0], eliminated.multipliers(0.0, &q, &z, &())[0]] {
            prop_assert!(close(lambda, force), "{lambda} {force}");
        }
    }

    #[test]
    fn a_state_off_the_edge_is_brought_onto_it(theta in -3.0..3.0, z in prop::array::uniform3(-2.0..2.0)) {
        let edge = edge();
        let (q, z) = (SVector::from([0.1, 0.2, theta]), SVector::from(z));
        let (moved, nearest) = edge.project(0.0, &q, &z).unwrap();
        prop_assert_eq!(moved, q);
        let off = edge.velocity_residual(0.0, &q, &nearest)[0];
        prop_assert!(off.abs() < 1e-15, "{}", off);
        // The nearest in kinetic energy: the correction is across all velocities that the edge admits.
        let impulse = edge.momentum(0.0, &q, &(nearest - z));
        for admitted in [rates(theta, 1.0, 0.0), rates(theta, 0.0, 1.0)] {
            prop_assert!(impulse.dot(&admitted).abs() < 1e-14);
        }
    }
}
