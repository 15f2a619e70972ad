//! Scenes whose digits used to be lost.

use crate::derivation::Derivation;
use crate::derivation::rounding::{OutputErrors, SceneState};

fn derived(source: &str) -> Derivation {
    Derivation::of_source(source, "Scene").unwrap_or_else(|error| panic!("{error}\n{source}"))
}

/// Two bodies, their inertia about O below the diagonal, column by column.
fn bodies() -> Vec<f64> {
    let bus = [11.8, 0.01, -0.02, 0.03, 0.3, 0.01, -0.02, 0.4, 0.015, 0.5];
    let wheel = [0.2, 0.001, 0.002, 0.0015, 1e-3, 1e-5, 2e-5, 1.2e-3, 3e-5, 0.9e-3];
    [bus, wheel].concat()
}

fn quaternion() -> [f64; 4] {
    let q: [f64; 4] = [0.1, -0.3, 0.2, 0.9];
    let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    q.map(|x| x / length)
}

/// Description of a base that floats: clauses of its motion, its configuration, its speeds, and which of them are
/// translations.
struct Base {
    clauses: &'static str,
    configuration: Vec<f64>,
    speeds: Vec<f64>,
    translations: std::ops::Range<usize>,
}

/// In every chart, 7000 km from Ω at orbital speed.
fn bases() -> Vec<Base> {
    let b = [4.1e6, -3.3e6, 4.612e6];
    let (v, w) = ([7.1e3, 1.2e3, -2.1e3], [1e-3, -2e-3, 1.5e-3]);
    let pose = |clauses, v: [f64; 3]| Base {
        clauses,
        configuration: [quaternion().as_slice(), &b, &[0.7]].concat(),
        speeds: [v.as_slice(), &w, &[0.02]].concat(),
        translations: 0..3,
    };
    let scalars = |clauses, configuration: &[f64], speeds: &[f64], translations| Base {
        clauses,
        configuration: configuration.to_vec(),
        speeds: speeds.to_vec(),
        translations,
    };
    vec![
        pose(
            "coordinates(pose: Pose, turn), speeds(v: Vector3, w: Vector3, s),
            kinematics(pose = twist(inverse(pose.rotation) * v, w), turn = s),
            body(bus, position = pose.position, rotation = pose.rotation)",
            v,
        ),
        pose(
            "coordinates(pose: Pose, turn), speeds(u: Vector3, w: Vector3, s),
            kinematics(pose = twist(u, w), turn = s),
            body(bus, position = pose.position, rotation = pose.rotation)",
            v,
        ),
        // ξ = v − ω × b.
        pose(
            "coordinates(pose: Pose, turn), speeds(x: Vector3, w: Vector3, s), kinematics(
                pose = twist(inverse(pose.rotation) * (x + cross(w, pose.position)), inverse(pose.rotation) * w),
                turn = s,
            ), body(bus, position = pose.position, rotation = pose.rotation)",
            [
                v[0] - (w[1] * b[2] - w[2] * b[1]),
                v[1] - (w[2] * b[0] - w[0] * b[2]),
                v[2] - (w[0] * b[1] - w[1] * b[0]),
            ],
        ),
        scalars(
            "coordinates(x, y, z, yaw, pitch, roll, turn),
            body(bus, position = [x, y, z], rotation = rotation_z(yaw) * rotation_y(pitch) * rotation_x(roll))",
            &[b[0], b[1], b[2], 0.3, -0.4, 1.1, 0.7],
            &[v[0], v[1], v[2], w[0], w[1], w[2], 0.02],
            0..3,
        ),
        // In the plane, in working axes of the observer.
        scalars(
            "coordinates(y, z, roll, turn), body(bus, position = [0, y, z], rotation = rotation_x(roll))",
            &[b[1], b[2], 1.1, 0.7],
            &[v[1], v[2], w[0], 0.02],
            0..2,
        ),
        // On a frame without mass.
        scalars(
            "coordinates(x, y, z, yaw, turn), frame(hub, position = [x, y, z]),
            body(bus, parent = hub, position = [0, 0, 0.1], rotation = rotation_z(yaw))",
            &[b[0], b[1], b[2], 0.3, 0.7],
            &[v[0], v[1], v[2], w[0], 0.02],
            0..3,
        ),
    ]
}

/// A wheel hinged to it, and what acts.
fn craft(base: &Base, acting: &str, fields: &str) -> Derivation {
    derived(&format!(
        "#[gauss({}, body(wheel, parent = bus, position = arm, rotation = rotation_x(turn)), {acting})] struct Scene {{
            #[gauss(body)] bus: RigidBody<f64>, #[gauss(body)] wheel: RigidBody<f64>, arm: Vector3<f64>, {fields}
        }}",
        base.clauses
    ))
}

fn state(base: &Base, further: &[f64]) -> SceneState {
    SceneState {
        parameters: [bodies().as_slice(), &[0.2, 0.1, -0.05], further].concat(),
        configuration: base.configuration.clone(),
        speeds: base.speeds.clone(),
    }
}

/// A dozen roundings of every term, of which a few hundred are added at random: `√300 · 12/…`, in units in which each
/// of the sixty numbers of the scene is rounded once.
const HARMLESS: f64 = 10.0;

#[test]
fn the_gradient_of_gravity_turns_a_craft_with_a_wheel() {
    for base in bases() {
        let scene = craft(&base, "central_gravity(mu = mu)", "mu: f64");
        let state = state(&base, &[3.986004418e14]);
        let loss = OutputErrors::of(&scene, "acceleration", &state);
        assert!(loss.worst() < HARMLESS, "{}: {:?} {:?}", base.clauses, loss.errors, loss.excused);
    }
}

#[test]
fn uniform_gravity_leaves_no_rounding_in_what_it_cannot_change() {
    for base in bases() {
        let scene = craft(&base, "", "#[gauss(gravity)] g: Vector3<f64>");
        let accelerations = |g: &[f64]| OutputErrors::of(&scene, "acceleration", &state(&base, g)).rounded;
        let (still, falling) = (accelerations(&[0.0; 3]), accelerations(&[1.7, -4.1, 8.9]));
        for (k, (a, b)) in still.into_iter().zip(falling).enumerate() {
            let translates = base.translations.contains(&k);
            assert!((a == b) != translates, "{k} of {}: {a:e} {b:e}", base.clauses);
        }
    }
}

/// The common part of all accelerations does not reach the hinge either: at any speed of the base the rest is the same.
#[test]
fn a_fast_base_leaves_no_rounding_in_the_hinge() {
    for base in bases() {
        let scene = craft(&base, "", "");
        let loss = OutputErrors::of(&scene, "acceleration", &state(&base, &[]));
        assert!(loss.worst() < HARMLESS, "{}: {:?} {:?}", base.clauses, loss.errors, loss.excused);
    }
}

/// One body in every chart, with its centre of mass c off O.
fn far_from_o() -> Vec<(String, bool)> {
    let roles = "#[gauss(mass)] m: f64, #[gauss(center_of_mass)] c: Vector3<f64>,
        #[gauss(inertia_about_center_of_mass)] i: Matrix3<f64>, #[gauss(gravity)] g: f64";
    let charts = ["left_invariant", "hybrid", "right_invariant", "jet(euler_zyx)"];
    charts
        .into_iter()
        .map(|chart| (format!("#[gauss(chart = {chart})] struct Scene {{ {roles} }}"), chart.starts_with("jet")))
        .collect()
}

#[test]
fn inertia_about_the_centre_of_mass_is_not_carried_through_o() {
    for (source, in_coordinates) in far_from_o() {
        let scene = derived(&source);
        let parameters = vec![3.0, 400.0, -700.0, 500.0, 0.3, 0.01, -0.02, 0.4, 0.015, 0.5, 9.81];
        let configuration = match in_coordinates {
            true => vec![1.0, -2.0, 0.5, 0.3, -0.4, 1.1],
            false => [quaternion().as_slice(), &[1.0, -2.0, 0.5]].concat(),
        };
        let state = SceneState { parameters, configuration, speeds: vec![0.3, -0.7, 1.1, 0.6, -1.3, 0.4] };
        for method in ["acceleration", "velocity", "momentum_rate"] {
            let loss = OutputErrors::of(&scene, method, &state);
            assert!(loss.worst() < HARMLESS, "{method} {:?} {:?}\n{source}", loss.errors, loss.excused);
        }
    }
}
