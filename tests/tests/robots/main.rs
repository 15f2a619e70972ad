//! Robots from their files: what they do at states that Pinocchio computed, and against mass matrices and weights
//! that are summed link by link from the numbers of the file.

mod asked;
mod balls;
mod ground;
mod locks;
mod mechanisms;
mod placed_robots;
mod quadrotor;
mod self_contact;
mod springs;

use std::fs;
use std::path::Path;

use gauss_codegen::Derivation;
use gauss_runtime::prelude::*;
use serde_json::Value;

const EPSILON: f64 = f64::EPSILON;

#[derive(GaussDynamics)]
#[gauss(urdf = "robots/panda.urdf", gravity = 9.81)]
struct Panda;

/// The efforts of the joints come first, then what the base is pushed with.
#[derive(GaussDynamics)]
#[gauss(
    urdf = "robots/anymal.urdf",
    base = floating,
    gravity = 9.81,
    input(push: Wrench),
    wrench(push, body = base_link, force = push.force, torque = push.torque)
)]
struct Anymal;

#[derive(GaussDynamics)]
#[gauss(
    urdf = "robots/talos.urdf",
    base = floating,
    gravity = 9.81,
    input(push: Wrench),
    wrench(push, body = base_link, force = push.force, torque = push.torque)
)]
struct Talos;

/// The states of a robot and what Pinocchio found there.
fn states(name: &str) -> Vec<Value> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("robots").join(format!("{name}.json"));
    let robot: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    robot["states"].as_array().unwrap().clone()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

fn vector<const N: usize>(value: &Value) -> SVector<f64, N> {
    SVector::from_iterator(numbers(value))
}

/// Kinetic energy, acceleration and inverse dynamics at one state.
///
/// Both programs add some hundred products for every entry of A and of the forces, and solve by a factorisation that
/// is backward stable: forces agree within that many roundings of the largest term, accelerations within as many
/// times the condition of A.
fn check<S, const N: usize>(kernel: &S, q: &S::Configuration, input: &S::Input, state: &Value)
where
    S: GaussSystem<Scalar = f64, Speeds = SVector<f64, N>, MassMatrix = SMatrix<f64, N, N>>,
{
    let z: SVector<f64, N> = vector(&state["v"]);
    let matrix = kernel.mass_matrix(0.0, q);
    let energy = state["kinetic_energy"].as_f64().unwrap();
    let roundings = 500.0 * EPSILON;
    assert!((kernel.kinetic_energy(0.0, q, &z) - energy).abs() <= roundings * energy);
    assert!((0.5 * z.dot(&(matrix * z)) - energy).abs() <= roundings * energy);
    let condition = matrix.norm() * matrix.try_inverse().unwrap().norm();
    let (found, expected) = (kernel.acceleration(0.0, q, &z, input), vector::<N>(&state["acceleration"]));
    let error = (found - expected).amax();
    assert!(
        error <= roundings * condition * expected.amax(),
        "{error:e} of {} at condition {condition:e}",
        expected.amax()
    );
    // Without the inputs: what the joints and the base must be driven with for this acceleration.
    let driven = kernel.inverse_dynamics(0.0, q, &z, &z, input);
    let tau: SVector<f64, N> = vector(&state["tau"]);
    let expected = vector::<N>(&state["inverse_dynamics_at_v_as_acceleration"]) - tau;
    let error = (driven - expected).amax();
    assert!(error <= roundings * (expected.amax() + tau.amax()), "{error:e} of {}", expected.amax());
}

#[test]
fn an_arm_with_two_fingers() {
    let kernel = Panda.kernel().unwrap();
    assert_eq!(size_of_val(&kernel), 0);
    for state in states("panda") {
        check(&kernel, &vector::<9>(&state["q"]), &vector::<9>(&state["tau"]), &state);
    }
}

/// (x, y, z, quaternion with its real part last, joints), and the efforts of the joints before the wrench on the base.
fn floating<const N: usize, const I: usize>(state: &Value) -> ((Isometry3<f64>, SVector<f64, N>), SVector<f64, I>) {
    let q = numbers(&state["q"]);
    let quaternion = UnitQuaternion::from_quaternion(Quaternion::new(q[6], q[3], q[4], q[5]));
    let pose = Isometry3::from_parts(Vector3::new(q[0], q[1], q[2]).into(), quaternion);
    let tau = numbers(&state["tau"]);
    let input = SVector::from_iterator(tau[6..].iter().chain(&tau[..6]).copied());
    ((pose, SVector::from_iterator(q[7..].iter().copied())), input)
}

#[test]
fn a_quadruped() {
    let kernel = Anymal.kernel().unwrap();
    assert_eq!(size_of_val(&kernel), 0);
    for state in states("anymal") {
        let (q, input) = floating::<12, 18>(&state);
        check(&kernel, &q, &input, &state);
    }
}

#[test]
fn a_biped() {
    let kernel = Talos.kernel().unwrap();
    assert_eq!(size_of_val(&kernel), 0);
    for state in states("talos") {
        let (q, input) = floating::<32, 38>(&state);
        check(&kernel, &q, &input, &state);
    }
}

#[derive(GaussDynamics)]
#[gauss(
    urdf = "robots/gripper.urdf",
    gravity = 9.81,
    joint_friction = smooth(width),
    limits = stop(stiffness = 1e4, width = 1e-3),
    saturation = none,
    point(pad, body = left_finger, at = [0, 0, 0.04]),
    frames(upper_arm, left_finger),
    methods(centroidal, nonlinear_effects, gravity_torques, jacobian_rates)
)]
struct Gripper {
    width: f64,
}

/// The same with mass data in fields: links that are fixed to these are then bodies of their own.
#[derive(GaussDynamics)]
#[gauss(
    urdf = "robots/gripper.urdf",
    gravity = 9.81,
    joint_friction = smooth(width),
    limits = none,
    saturation = none,
    parameters = inertial
)]
struct LoadedGripper {
    width: f64,
    #[gauss(body)]
    upper_arm: RigidBody<f64, AboutCenterOfMass<f64>>,
    #[gauss(body)]
    left_finger: RigidBody<f64>,
    #[gauss(body)]
    right_finger: RigidBody<f64>,
}

/// A link of the hand: its pose, and how it moves with each of the two coordinates.
#[derive(Clone, Copy)]
struct Moved {
    pose: Isometry3<f64>,
    /// Velocity of the point of the link that is at Ω, and angular velocity, observer's axes.
    rates: [[Vector3<f64>; 2]; 2],
}

impl Moved {
    /// A link that hangs on this one, turned by `angle` about `axis` or moved along it; `rate` is that of each
    /// coordinate.
    fn hung(&self, xyz: [f64; 3], rpy: [f64; 3], axis: Vector3<f64>, [turn, way]: [f64; 2], rate: [f64; 2]) -> Moved {
        let origin =
            Isometry3::from_parts(Vector3::from(xyz).into(), UnitQuaternion::from_euler_angles(rpy[0], rpy[1], rpy[2]));
        let frame = self.pose * origin;
        let axis = axis.normalize();
        let pose = frame * Isometry3::from_parts((axis * way).into(), UnitQuaternion::from_scaled_axis(axis * turn));
        let along = frame.rotation * axis;
        let mut rates = self.rates;
        // The elbow turns, the fingers slide.
        for (k, (own, rate)) in rates.iter_mut().zip(rate).enumerate() {
            let [linear, angular] = if k == 1 {
                [along * rate, Vector3::zeros()]
            } else {
                [frame.translation.vector.cross(&along) * rate, along * rate]
            };
            own[0] += linear;
            own[1] += angular;
        }
        Moved { pose, rates }
    }
}

/// The links of gripper.urdf that move, with mass, centre of mass, and inertia about it turned by the angles of its
/// frame.
fn hand([elbow, left]: [f64; 2]) -> Vec<(Moved, f64, Vector3<f64>, Matrix3<f64>)> {
    let still = Moved { pose: Isometry3::identity(), rates: [[Vector3::zeros(); 2]; 2] };
    let x = Vector3::x();
    let plate = still.hung([0.1, 0.0, 0.2], [0.0, 0.0, 0.3], x, [0.0; 2], [0.0; 2]);
    let arm = plate.hung([0.0, 0.0, 0.1], [0.2, -0.4, 0.7], Vector3::new(1.0, 2.0, -2.0), [elbow, 0.0], [1.0, 0.0]);
    let quarter = std::f64::consts::FRAC_PI_2;
    let palm = arm.hung([0.0, 0.02, 0.4], [quarter, 0.0, 0.4], x, [0.0; 2], [0.0; 2]);
    let finger =
        |way: f64, rate: f64| palm.hung([0.0, 0.0, 0.05], [0.0, 0.0, 0.785], Vector3::y(), [0.0, way], [0.0, rate]);
    let turned = |rpy: [f64; 3], inertia: Matrix3<f64>| {
        let r = *UnitQuaternion::from_euler_angles(rpy[0], rpy[1], rpy[2]).to_rotation_matrix().matrix();
        r * inertia * r.transpose()
    };
    let upper = Matrix3::new(0.02, 0.001, -0.002, 0.001, 0.025, 0.0005, -0.002, 0.0005, 0.01);
    let slender = Matrix3::from_diagonal(&Vector3::new(1e-5, 1e-5, 2e-6));
    let of_palm = Matrix3::from_diagonal(&Vector3::new(0.0004, 0.0005, 0.0003));
    vec![
        (arm, 1.5, Vector3::new(0.05, 0.01, 0.2), turned([0.5, 0.1, -0.3], upper)),
        (palm, 0.4, Vector3::new(0.0, 0.0, 0.03), turned([0.0, 0.2, 0.0], of_palm)),
        (finger(left, 1.0), 0.05, Vector3::new(0.0, 0.01, 0.02), slender),
        (finger(-0.5 * left - 0.01, -0.5), 0.05, Vector3::new(0.0, -0.01, 0.02), slender),
    ]
}

/// A and the weight's potential energy, summed over the links.
fn summed(q: [f64; 2]) -> (SMatrix<f64, 2, 2>, f64) {
    let (mut matrix, mut potential) = (SMatrix::<f64, 2, 2>::zeros(), 0.0);
    for (link, mass, center, inertia) in hand(q) {
        let at = link.pose.rotation * center + link.pose.translation.vector;
        let r = *link.pose.rotation.to_rotation_matrix().matrix();
        let inertia = r * inertia * r.transpose();
        let velocity = |k: usize| link.rates[k][0] + link.rates[k][1].cross(&at);
        for i in 0..2 {
            for j in 0..2 {
                matrix[(i, j)] +=
                    mass * velocity(i).dot(&velocity(j)) + link.rates[i][1].dot(&(inertia * link.rates[j][1]));
            }
        }
        potential += mass * 9.81 * at.z;
    }
    (matrix, potential)
}

const STATES: [[f64; 2]; 3] = [[0.0, 0.0], [0.7, 0.02], [-1.2, 0.035]];

/// Rotated inertial frames, an axis of no frame, links that are fixed to others, and a joint that mimics another.
#[test]
fn a_hand_as_its_numbers_say() {
    let kernel = Gripper { width: 0.01 }.kernel().unwrap();
    let zero = kernel.potential_energy(0.0, &SVector::from([0.5, 0.02])) - summed([0.5, 0.02]).1;
    for q in STATES {
        let (matrix, potential) = summed(q);
        let found = kernel.mass_matrix(0.0, &SVector::from(q));
        // Some fifty products for each link and entry, of sizes up to those of the diagonal.
        let size = (matrix[(0, 0)] * matrix[(1, 1)]).sqrt().max(matrix[(0, 0)]);
        assert!((found - matrix).amax() <= 200.0 * EPSILON * size, "{found} {matrix}");
        // Stops push a little before their limits, by less than their stiffness times the square of their width.
        let difference = kernel.potential_energy(0.0, &SVector::from(q)) - potential - zero;
        assert!(difference.abs() <= 1e4 * 1e-6, "{difference:e}");
    }
    // Far beyond a limit the stop is a spring.
    let q = SVector::from([2.0 + 0.5, 0.02]);
    let rest = kernel.acceleration(0.0, &q, &SVector::zeros(), &SVector::zeros());
    let force = kernel.mass_matrix(0.0, &q) * rest;
    assert!((force[0] + 0.5e4).abs() < 30.0, "{force}");
}

/// −f v/√(v² + w²) − d v in the elbow; of the two fingers, which are dampers, d₁ v + d₂ v/4.
#[test]
fn friction_and_damping() {
    let (kernel, q) = (Gripper { width: 0.01 }.kernel().unwrap(), SVector::from([0.3, 0.02]));
    for [v, w] in [[0.02, 0.3], [-2.0, -0.1]] {
        let z = SVector::from([v, w]);
        let input = GripperInput { elbow: 0.7, left: -0.4 }.input();
        assert_eq!(input, SVector::from([0.7, -0.4]));
        assert_eq!(GripperInput::of(&input).left, -0.4);
        let of = |name: &str| kernel.generalised_force(name, 0.0, &q, &z, &input).unwrap();
        assert_eq!(of("efforts"), input);
        let damping = of("joint_damping");
        assert!(
            (damping[0] + 0.3 * v).abs() <= 4.0 * EPSILON && (damping[1] + 2.25 * w).abs() <= 4.0 * EPSILON,
            "{damping}"
        );
        let friction = of("joint_friction");
        assert!((friction[0] + 0.2 * v / v.hypot(0.01)).abs() <= 4.0 * EPSILON && friction[1] == 0.0, "{friction}");
    }
}

/// Frames have the names of the file.
#[test]
fn frames_by_the_names_of_the_file() {
    let kernel = Gripper { width: 0.01 }.kernel().unwrap();
    assert_eq!(GripperFrame::named("upper arm"), Some(GripperFrame::upper_arm));
    assert_eq!(GripperFrame::named("palm"), None);
    let q = [0.7, 0.02];
    let pose = kernel.pose_of(GripperFrame::named("left_finger").unwrap(), 0.0, &SVector::from(q));
    let expected = hand(q)[2].0.pose;
    assert!((pose.translation.vector - expected.translation.vector).amax() <= 16.0 * EPSILON, "{pose}");
    assert!((pose.rotation.matrix() - expected.rotation.to_rotation_matrix().matrix()).amax() <= 16.0 * EPSILON);
}

/// Fields that begin with the values of the file.
#[test]
fn mass_data_in_fields() {
    let loaded = LoadedGripper::from_file(0.01);
    let (mass, center, inertia) = (hand([0.0, 0.0])[0].1, hand([0.0, 0.0])[0].2, hand([0.0, 0.0])[0].3);
    assert_eq!((loaded.upper_arm.mass, loaded.upper_arm.center_of_mass), (mass, center));
    assert!((loaded.upper_arm.inertia.0 - inertia).amax() <= 4.0 * EPSILON * inertia.amax());
    let (loaded, plain) = (loaded.kernel().unwrap(), Gripper { width: 0.01 }.kernel().unwrap());
    for q in STATES.map(SVector::from) {
        let (a, b) = (loaded.mass_matrix(0.0, &q), plain.mass_matrix(0.0, &q));
        assert!((a - b).amax() <= 200.0 * EPSILON * b.amax(), "{a} {b}");
    }
}

/// A gripper by published numbers: ten links that mimics tie to one motor.
#[derive(GaussDynamics)]
#[gauss(
    urdf = "robots/robotiq_2f_85.urdf",
    gravity = 9.81,
    limits = none,
    saturation = none,
    frames(left_pad, right_pad)
)]
struct Robotiq;

/// Knuckles and outer fingers turn about the palm; inner fingers turn as far back, and so move on circles: the inertia
/// is the same wherever they are, and the pads stay parallel.
#[test]
fn a_published_gripper() {
    let kernel = Robotiq.kernel().unwrap();
    let about_pivot = |moment: f64, mass: f64, y: f64, z: f64| moment + mass * (y * y + z * z);
    let knuckle = about_pivot(2.89328108496468e-6, 0.00853198276973456, 0.0199435877845359, 0.0292245259211331);
    let [y, z] = [0.0315 + 0.0373907951953854, -0.0041 - 0.0208027427000385];
    let outer_finger = about_pivot(1.52518312458174e-5, 0.022614240507152, y, z);
    let inner_knuckle = about_pivot(2.61910379223783e-5, 0.0271177346495152, 0.0507850843201817, 0.00103968640075166);
    let inner_finger = about_pivot(0.0, 0.0104003125914103, 0.0315 + 0.0061, -0.0041 + 0.0471);
    let inertia = 2.0 * (knuckle + outer_finger + inner_knuckle + inner_finger);
    let pad = |frame, q: &SVector<f64, 1>| kernel.pose_of(frame, 0.0, q);
    let open = pad(RobotiqFrame::right_pad, &SVector::zeros());
    // Lengths of the file: a stroke of 85 mm between pads of 6.35 mm.
    let half = 0.0306011 + 0.0315 + 0.0061 - 0.0220203446692936;
    assert!((open.translation.y - half).abs() <= 4.0 * EPSILON && (2.0 * half - 0.00635 - 0.085).abs() < 1.1e-3);
    for angle in [0.0, 0.3, 0.81] {
        let q = SVector::from([angle]);
        let found = kernel.mass_matrix(0.0, &q)[0];
        // Some twenty products for each of eight links.
        assert!((found - inertia).abs() <= 100.0 * EPSILON * inertia, "{found} {inertia}");
        let [left, right] = [RobotiqFrame::left_pad, RobotiqFrame::right_pad].map(|frame| pad(frame, &q));
        let [l, r] = [left, right].map(|pose| pose.translation.vector);
        assert!((l - Vector3::new(-r.x, -r.y, r.z)).amax() <= 8.0 * EPSILON, "{l} {r}");
        assert!((right.rotation.matrix() - open.rotation.matrix()).amax() <= 8.0 * EPSILON);
        assert!(angle == 0.0 || r.y < open.translation.y);
    }
}

/// Inputs of the two joints that transmissions drive; the tips are joined by clauses of the struct.
#[derive(GaussDynamics)]
#[gauss(
    urdf = "robots/five_bar.urdf",
    gravity = 9.81,
    inputs = transmissions,
    constraint(position = dot(left_tip.position - right_tip.position, [1, 0, 0])),
    constraint(position = dot(left_tip.position - right_tip.position, [0, 0, 1])),
    particle(mass = 0.1, position = [0, 0, 0], parent = left_tip)
)]
struct FiveBar;

/// Cranks of 0.115 m and rods of 0.2 m, turned apart by as much, with the tips in the middle.
fn five_bar_turned(crank: f64) -> SVector<f64, 4> {
    let knee = -(0.115 * crank.sin() / 0.2).asin() - crank;
    SVector::from([crank, knee, -crank, -knee])
}

/// Symmetric and symmetrically driven, it moves symmetrically; the tips stay together.
#[test]
fn a_closed_loop() {
    let kernel = FiveBar.kernel().unwrap();
    let q = five_bar_turned(0.6);
    assert!(kernel.position_residual(0.0, &q).amax() <= 4.0 * EPSILON);
    let input = SVector::from([0.3, -0.3]);
    let found = kernel.acceleration(0.0, &q, &SVector::zeros(), &input);
    let size = found.amax();
    assert!(size > 0.1, "{found}");
    assert!(
        (found[0] + found[2]).abs() <= 1e3 * EPSILON * size && (found[1] + found[3]).abs() <= 1e3 * EPSILON * size,
        "{found}"
    );
}

/// Let go beside its symmetry, without motors it keeps its energy, and its tips stay together.
#[test]
fn a_closed_loop_keeps_its_energy() {
    let kernel = FiveBar.kernel().unwrap();
    let beside = five_bar_turned(0.6) + SVector::from([0.1, 0.0, 0.05, 0.0]);
    let (q, z) = kernel.project(0.0, &beside, &SVector::zeros()).unwrap();
    let path = Simulation::new(&kernel)
        .input(|_: f64, _: &SVector<f64, 4>, _: &SVector<f64, 4>| SVector::zeros())
        .adaptive(1e-11, 1e-12)
        .run(q, z, 0.0..0.15)
        .unwrap();
    let [before, after] = [path.first(), path.last()].map(|s| kernel.energy(0.0, &s.q, &s.z));
    let last = path.last();
    let moving = kernel.kinetic_energy(0.0, &last.q, &last.z);
    assert!(moving > 0.1, "{moving}");
    // Some hundred steps, each off by 1e-11 of rates of some ten.
    assert!((after - before).abs() <= 1e-8 * moving, "{moving} {after} {before}");
    assert!(path.iter().all(|s| kernel.position_residual(0.0, &s.q).amax() <= 1e-10));
}

/// The file and the clauses that say the same give the same programs.
#[test]
fn a_file_is_as_good_as_clauses() {
    let file = "#[gauss(urdf = \"robots/panda.urdf\", gravity = 9.81)] struct Panda;";
    let file: syn::DeriveInput = syn::parse_str(file).unwrap();
    let derived = Derivation::new(&file).unwrap();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("robots/panda.json");
    let robot: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    let (mut coordinates, mut efforts, mut bodies) = (Vec::new(), Vec::new(), String::new());
    for link in robot["links"].as_array().unwrap() {
        let name = link["name"].as_str().unwrap();
        coordinates.push(name.to_owned());
        efforts.push(format!("{name} = {name}_effort"));
        let parent = link["parent"].as_str().map_or(String::new(), |parent| format!("parent = {parent}_link,"));
        let row = numbers(&link["rotation"][0]);
        let turn = match (numbers(&link["rotation"][2])[1], row[1]) {
            (-1.0, _) => "rotation_x(-pi / 2) *",
            (1.0, _) => "rotation_x(pi / 2) *",
            (_, 0.0) => "",
            _ => "rotation_z(-0.7853981633974484) *",
        };
        let [x, y, z]: [f64; 3] = numbers(&link["position"]).try_into().unwrap();
        let (position, rotation) = if link["joint"] == "prismatic" {
            let axis = numbers(&link["axis"]);
            let way = if axis[1] > 0.0 { name.to_owned() } else { format!("-{name}") };
            let along = format!("[0.7071067811865476 * {way}, 0.7071067811865475 * {way}, {z:?}]");
            (along, turn.trim_end_matches('*').to_owned())
        } else {
            (format!("[{x:?}, {y:?}, {z:?}]"), format!("{turn} rotation_z({name})"))
        };
        let moments = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"]
            .map(|entry| format!("{:?}", link["inertia_about_center_of_mass"][entry].as_f64().unwrap()));
        let diagonal = [1, 2, 4].iter().all(|&k| moments[k] == "0.0");
        let moments = if diagonal { vec![&moments[0], &moments[3], &moments[5]] } else { moments.iter().collect() };
        let moments: Vec<&str> = moments.into_iter().map(String::as_str).collect();
        let [cx, cy, cz]: [f64; 3] = numbers(&link["center_of_mass"]).try_into().unwrap();
        let center = if [cx, cy, cz] == [0.0; 3] {
            String::new()
        } else {
            format!("center_of_mass = [{cx:?}, {cy:?}, {cz:?}],")
        };
        bodies += &format!(
            "body({name}_link, {parent} position = {position}, rotation = {rotation}, mass = {:?}, {center} \
             inertia_about_center_of_mass = [{}]),",
            link["mass"].as_f64().unwrap(),
            moments.join(", "),
        );
    }
    let inputs: Vec<String> = coordinates.iter().map(|name| format!("{name}_effort")).collect();
    let written = format!(
        "#[gauss(coordinates({}), input({}), {bodies} drive(efforts, {}), gravity = 9.81)] struct Panda {{}}",
        coordinates.join(", "),
        inputs.join(", "),
        efforts.join(", "),
    );
    let written: syn::DeriveInput = syn::parse_str(&written).unwrap();
    let written = Derivation::new(&written).unwrap();
    for method in ["acceleration", "mass_matrix", "gauss_residual"] {
        let [a, b] = [&derived, &written].map(|d| d.program(method).map(|program| program.code.instructions.len()));
        assert_eq!(a, b, "{method}");
    }
}

/// The compiler is told of the files, so that an edit of one compiles its struct anew.
#[test]
fn files_are_tracked() {
    let executable = std::env::current_exe().unwrap();
    let dependencies = fs::read_to_string(executable.with_extension("d")).unwrap();
    for file in
        ["panda.urdf", "anymal.urdf", "gripper.urdf", "five_bar.urdf", "linkage.xml", "quadrotor.xml", "parts/load.xml"]
    {
        assert!(dependencies.contains(file), "{file}");
    }
}
