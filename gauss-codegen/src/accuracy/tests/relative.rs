//! Links of one tree beside each other: what is between them does not depend on how all of them move together.

use super::scenes::Scene;
use super::{computed, loss, values_of_scene};
use crate::expand::derive;
use crate::mechanics::{Coordinate, Method};

/// Roundings of some hundred operations, of random signs, in units of one rounding of every number.
const FEW: f64 = 10.0;
/// The same where a cheaper arrangement may be taken that loses so many times what the best does (`trial.rs`).
const CHOSEN: f64 = 32.0;
/// States of each scene: speeds of their own.
const STATES: u64 = 4;

const POSE: [f64; 7] = [0.3, -0.5, 0.7, 0.4, 10.3, 20.1, -7.7];
const HULL: &str = "body(hull, pose = craft, mass = 10, inertia = [0.2, 0.3, 0.4])";
const WHEEL: &str = "body(wheel, parent = hull, rotation = rotation_z(angle), position = [0.1, 0, 0], mass = 0.5, \
                     inertia = [0.001, 0.001, 0.002])";
const ARM: &str = "body(arm, parent = hull, rotation = rotation_z(angle), position = [0.1, 0, 0], mass = 0.5, \
                   inertia = [0.001, 0.003, 0.002])";

/// Accelerations of a scene.
struct MeasuredRates {
    /// The worst of all states.
    loss: f64,
    operations: u32,
    /// Which scalar coordinates they are computed from.
    read: Vec<String>,
    values: Vec<f64>,
    /// Speeds with generalised forces of elements.
    pushed: Vec<usize>,
}

fn tried(coordinates: &[&str], clauses: &str, values: &[&[f64]], speed: f64) -> MeasuredRates {
    let scene = Scene::written(coordinates, clauses, values, speed);
    let input: syn::DeriveInput = syn::parse_str(&scene.source()).expect("a struct");
    let tried = derive(&input, |derived| {
        let program = &derived.kernel.functions.acceleration.program;
        let inputs: Vec<u32> = program.inputs().iter().map(|symbol| symbol.key()).collect();
        let system = derived.subject.system;
        let is_read = |coordinate: &Coordinate<'_>| match coordinate {
            Coordinate::Scalar(q) => inputs.contains(&q.key()),
            _ => false,
        };
        let named = coordinates.iter().zip(&system.scene.coordinates).filter(|(_, q)| is_read(q));
        let of = |seed| loss(derived, &scene, seed).map_or(f64::INFINITY, |(loss, _)| loss);
        Ok(MeasuredRates {
            loss: (0..STATES).map(of).fold(0.0, f64::max),
            operations: program.cost().operations,
            read: named.map(|(name, _)| (*name).to_owned()).collect(),
            values: computed(derived.kernel, Method::Acceleration, &values_of_scene(derived, &scene, 0)),
            pushed: (0..system.scene.speeds.len()).filter(|&k| !system.element_forces()[k].is_zero()).collect(),
        })
    });
    tried.unwrap_or_else(|error| panic!("{error}: {}", scene.source()))
}

fn on_craft(clauses: &[&str]) -> MeasuredRates {
    tried(&["craft: Pose", "angle"], &clauses.join(", "), &[&POSE, &[0.7]], 1.0)
}

#[track_caller]
fn agree(a: &MeasuredRates, b: &MeasuredRates) {
    for (a, b) in a.values.iter().zip(&b.values) {
        // Either loses less than FEW.
        assert!((a - b).abs() <= 2.0 * FEW * f64::EPSILON * b.abs().max(1.0), "{a:e} and {b:e}");
    }
}

#[test]
fn a_torque_with_its_reaction_is_a_drive_of_the_hinge() {
    let drive = on_craft(&[HULL, ARM, "drive(motor, angle = 1000.7)"]);
    for torque in [
        "torque(motor, body = arm, value = [0, 0, 1000.7], reaction = hull)",
        "torque(motor, body = hull, value = [0, 0, -1000.7], reaction = arm)",
        "torque(motor, body = arm, value = arm.rotation * [0, 0, 1000.7], axes = observer, reaction = hull)",
    ] {
        let by_torque = on_craft(&[HULL, ARM, torque]);
        assert!(by_torque.loss < FEW, "{:e}", by_torque.loss);
        assert!(by_torque.operations <= drive.operations, "{} and {}", by_torque.operations, drive.operations);
        assert_eq!(by_torque.pushed, [6]);
        agree(&by_torque, &drive);
    }
}

#[test]
fn a_torque_passes_the_joints_between_its_links_alone() {
    let hand = "body(hand, parent = arm, rotation = rotation_x(b), position = [0.4, 0, 0], mass = 0.1, \
                center_of_mass = [0.1, 0, 0], inertia = [0.001, 0.003, 0.002])";
    let other = "body(other, parent = hull, rotation = rotation_y(c), position = [0, 0.2, 0], mass = 0.2, \
                 inertia = [0.002, 0.001, 0.002])";
    let coordinates = ["craft: Pose", "angle", "b", "c"];
    let with = |torque: &str| {
        let clauses = [HULL, ARM, hand, other, torque].join(", ");
        tried(&coordinates, &clauses, &[&POSE, &[0.7], &[0.4], &[-1.1]], 1.0)
    };
    // To the hull: the wrist, about its axis, and the shoulder; to a link beside it: that one's hinge as well.
    for (torque, joints) in [
        ("torque(a, body = hand, value = [7, 8, 9], reaction = arm)", vec![7]),
        ("torque(a, body = hand, value = [7, 8, 9], reaction = hull)", vec![6, 7]),
        ("torque(a, body = hand, value = [7, 8, 9], reaction = other)", vec![6, 7, 8]),
        ("torque(a, body = hull, value = [7, 8, 9], reaction = other)", vec![8]),
    ] {
        let tried = with(torque);
        assert_eq!(tried.pushed, joints, "{torque}");
        assert!(tried.loss < FEW, "{torque}: {:e}", tried.loss);
    }
}

#[test]
fn a_spring_between_points_is_one_along_their_distance() {
    let along = "spring(along = sqrt((0.1 * cos(angle) - 0.05 * sin(angle) - 0.2).powi(2) \
                 + (0.1 * sin(angle) + 0.05 * cos(angle) - 0.1).powi(2)), stiffness = 10007, length = 0.1)";
    let along = on_craft(&[HULL, ARM, along]);
    let points = "point(p, body = hull, at = [0.3, 0.1, 0]), point(q, body = arm, at = [0.1, 0.05, 0])";
    for spring in [
        "spring(from = p, to = q, stiffness = 10007, length = 0.1)",
        "spring(from = craft.position + craft.rotation * [0.3, 0.1, 0], \
         to = arm.position + arm.rotation * [0.1, 0.05, 0], stiffness = 10007, length = 0.1)",
        "spring(along = sqrt(dot(q - p, q - p)), stiffness = 10007, length = 0.1)",
    ] {
        let between = on_craft(&[HULL, ARM, points, spring]);
        assert!(between.loss < FEW, "{spring}: {:e}", between.loss);
        assert!(between.operations <= along.operations, "{spring}: {} and {}", between.operations, along.operations);
        assert_eq!(between.pushed, [6]);
        agree(&between, &along);
    }
}

#[test]
fn a_tether_to_what_is_seen_from_a_craft_far_away_keeps_its_digits() {
    let clauses = "body(hull, pose = craft, mass = 100, inertia = [20, 30, 40]), \
                   body(load, parent = hull, position = [x, y, z], mass = 5, inertia = [1, 2, 3]), \
                   point(p, body = hull, at = [0.3, 0.1, 0]), \
                   spring(from = p, to = load.position, stiffness = 10007, length = 0.009999)";
    let pose = [0.3, -0.5, 0.7, 0.4, 7_000_100.3, 20.1, -7.7];
    let tether = tried(&["craft: Pose", "x", "y", "z"], clauses, &[&pose, &[0.31], &[0.1], &[0.0001]], 1.0);
    assert!(tether.loss < FEW, "{:e}", tether.loss);
}

#[test]
fn links_of_two_trees_push_each_other_through_the_observer() {
    let clauses = "body(one, pose = a, mass = 10, inertia = [0.2, 0.3, 0.4]), \
                   body(two, pose = b, mass = 5, inertia = [1, 2, 3]), \
                   torque(motor, body = one, value = [1, 2, 3], reaction = two), \
                   spring(from = a.position, to = two.position + two.rotation * [0.1, 0.2, 0.3], stiffness = 7)";
    let other = [0.1, 0.2, -0.3, 0.8, 1.0, 2.0, 3.0];
    let apart = tried(&["a: Pose", "b: Pose"], clauses, &[&POSE, &other], 1.0);
    assert_eq!(apart.pushed, (0..12).collect::<Vec<_>>());
    assert!(apart.loss < FEW, "{:e}", apart.loss);
}

#[test]
fn the_angle_of_a_symmetric_rotor_drops_out() {
    let gimbal =
        "body(gimbal, parent = hull, rotation = rotation_x(tilt), mass = 0.5, inertia = [0.001, 0.002, 0.002])";
    let wheel = |parent: &str, place: &str| {
        format!("body(wheel, parent = {parent}, {place}, mass = 0.5, inertia = [0.001, 0.001, 0.002])")
    };
    let second = "body(second, parent = wheel, rotation = rotation_z(tilt), position = [0, 0, 0.3], mass = 0.5, \
                  inertia = [0.003, 0.003, 0.002])";
    let drive = "drive(motor, angle = 1000.7)".to_owned();
    for (clauses, read) in [
        (vec![wheel("hull", "rotation = rotation_z(angle), position = [0.1, 0, tilt]"), drive.clone()], vec!["tilt"]),
        (vec![gimbal.to_owned(), wheel("gimbal", "rotation = rotation_z(angle)"), drive.clone()], vec!["tilt"]),
        (vec![wheel("hull", "rotation = rotation_x(tilt) * rotation_z(angle)"), drive.clone()], vec!["tilt"]),
        (vec![wheel("hull", "rotation = rotation_z(angle)"), second.to_owned(), drive], vec![]),
    ] {
        let clauses = [vec![HULL.to_owned()], clauses].concat().join(", ");
        let rotor = tried(&["craft: Pose", "tilt", "angle"], &clauses, &[&POSE, &[0.4], &[0.7]], 10.0);
        assert_eq!(rotor.read, read, "{clauses}");
        assert!(rotor.loss < FEW, "{clauses}: {:e}", rotor.loss);
    }
    // What pushes it in its own axes does not drop out.
    let pushed = on_craft(&[HULL, WHEEL, "torque(jet, body = wheel, value = [0.3, 0, 0])"]);
    assert_eq!(pushed.read, ["angle"]);
    assert!(pushed.loss < FEW, "{:e}", pushed.loss);
}

#[test]
fn short_levers_before_long_ones_keep_their_digits() {
    let links = |near: f64, far: f64| {
        format!(
            "body(near, rotation = rotation_z(a), mass = 1, inertia = [0, 0, {:e}], center_of_mass = [{:e}, 0, 0]), \
             body(far, parent = near, position = [{near:e}, 0, 0], rotation = rotation_z(b), mass = 1, \
             inertia = [0, 0, {:e}], center_of_mass = [{:e}, 0, 0]), gravity = [0, -9.81, 0]",
            0.3 * near * near,
            0.5 * near,
            0.3 * far * far,
            0.5 * far,
        )
    };
    let particles = "frame(near, rotation = rotation_z(a)), particle(parent = near, mass = 1, position = [0.001, 0, 0]), \
                     frame(far, parent = near, position = [0.001, 0, 0], rotation = rotation_z(b)), \
                     particle(parent = far, mass = 1, position = [1e6, 0, 0]), gravity = [0, -9.81, 0]";
    for (clauses, bends) in [
        (links(1e-3, 1e6), [0.9, 1e-3, 1e-7]),
        (particles.to_owned(), [0.9, 1e-3, 1e-7]),
        (links(1e6, 1e-3), [0.9, 0.1, 1e-3]),
    ] {
        for bent in bends {
            let pendulum = tried(&["a", "b"], &clauses, &[&[0.4], &[bent]], 1.0);
            assert!(pendulum.loss < CHOSEN, "{clauses} at {bent}: {:e}", pendulum.loss);
        }
    }
}

#[test]
fn a_disk_that_lies_nearly_flat_keeps_its_digits() {
    // Its speeds are the rates of its angles: of A is left sin² of the lean.
    for inertia in ["[1, 1, 1]", "[0.06, 0.06, 0.12]"] {
        let clauses = format!(
            "speeds(u, v, w), kinematics(x = -0.3 * (w + u * cos(lean)) * cos(heading) + 0.3 * sin(lean) * v * sin(heading), \
             y = -0.3 * (w + u * cos(lean)) * sin(heading) - 0.3 * sin(lean) * v * cos(heading), \
             heading = u, lean = v, spin = w), body(disk, position = [x, y, 0.3 * sin(lean)], \
             rotation = rotation_z(heading) * rotation_x(lean) * rotation_z(spin), mass = 1.5, inertia = {inertia}), \
             gravity = 9.81"
        );
        for lean in [1e-3, 1e-8] {
            let coordinates = ["x", "y", "heading", "lean", "spin"];
            let disk = tried(&coordinates, &clauses, &[&[0.0], &[0.0], &[0.3], &[lean], &[0.7]], 1.0);
            assert!(disk.loss < FEW, "{inertia} at {lean:e}: {:e}", disk.loss);
        }
    }
}

#[test]
fn light_links_of_longer_chains_keep_digits_beside_heavy_ones() {
    let masses = [3e5, 2e-6, 4e3, 1e-3, 7e5, 5e-5, 2e2, 3e-6];
    let angles: [f64; 8] = [0.7, -2.1, 1.3, 2.6, -0.4, 1.9, -1.2, 0.5];
    let link = |(k, mass): (usize, &f64)| {
        let place = match k {
            0 => String::new(),
            _ => format!("parent = b{}, position = [0.5, 0, 0], ", k - 1),
        };
        format!(
            "body(b{k}, {place}rotation = rotation_z(q{k}), mass = {mass:e}, center_of_mass = [0.25, 0.01, 0.02], \
             inertia = [{:e}, {:e}, {:e}])",
            0.013 * mass,
            0.08 * mass,
            0.081 * mass
        )
    };
    let clauses: Vec<String> = masses.iter().enumerate().map(link).collect();
    let names: Vec<String> = (0..8).map(|k| format!("q{k}")).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let values: Vec<&[f64]> = angles.iter().map(std::slice::from_ref).collect();
    let chain = tried(&names, &format!("{}, gravity = [0, -9.81, 0.3]", clauses.join(", ")), &values, 1.0);
    // Twelve decimal orders between neighbours, and a thousand operations: a hundred roundings of sixteen digits.
    assert!(chain.loss < 10.0 * FEW, "{:e}", chain.loss);
}

/// An acceleration that all matter has is none of a mode: `ë = −k e/(1 − d²/m)` however heavy the body is.
#[test]
fn modes_of_bodies_that_float_keep_their_digits_under_weight() {
    let modes = "modes(hull, coordinates = [e], translation = [[0.4, 0.1, 0]], rotation = [[0, 0.02, 0.05]], \
                 mass = [1], stiffness = [30])";
    let arrays = "modes(arm, coordinates = [e], translation = [[0, 0.1, 0.05]], rotation = [[0, 0.002, 0.004]], \
                  mass = [1], stiffness = [30])";
    let far = [0.3, -0.5, 0.7, 0.4, 5e6, 4e6, 3e6];
    for (load, pose) in [
        ("gravity = 9.81", &POSE),
        ("gravity = [1.3, -9.81, 0.2]", &POSE),
        ("central_gravity(mu = 3.986004418e14)", &far),
    ] {
        for deflection in [1e-9, 1e-12] {
            let clauses = [HULL, modes, load].join(", ");
            let alone = tried(&["craft: Pose", "e"], &clauses, &[pose, &[deflection]], deflection);
            assert!(alone.loss < FEW, "{load} at {deflection:e}: {:e}", alone.loss);
            let clauses = [HULL, ARM, arrays, load].join(", ");
            let on_arm = tried(&["craft: Pose", "angle", "e"], &clauses, &[pose, &[0.7], &[deflection]], deflection);
            assert!(on_arm.loss < CHOSEN, "{load} on an arm at {deflection:e}: {:e}", on_arm.loss);
        }
    }
    // By coordinates, in space and in the plane.
    for (coordinates, place) in [
        (&["x", "y", "z", "a", "e"][..], "position = [x, y, z], rotation = rotation_z(a)"),
        (&["x", "y", "a", "e"], "position = [x, y, 0], rotation = rotation_z(a)"),
    ] {
        let clauses =
            format!("body(hull, {place}, mass = 10, inertia = [0.2, 0.3, 0.4]), {modes}, gravity = [1, -9.81, 0]");
        let mut values = vec![[0.3].as_slice(); coordinates.len() - 1];
        values.push(&[1e-9]);
        let by_coordinates = tried(coordinates, &clauses, &values, 1e-9);
        assert!(by_coordinates.loss < FEW, "{place}: {:e}", by_coordinates.loss);
    }
}
