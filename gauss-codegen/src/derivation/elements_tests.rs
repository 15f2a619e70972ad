//! Elements between two bodies against the same loads written in expressions.

use crate::derivation::Derivation;
use crate::derivation::rounding::{SceneState, outputs};

/// The accelerations, in two states, of two hinged bodies and one that slides and turns by itself.
fn accelerations(acting: &str) -> Vec<f64> {
    let source = format!(
        "#[gauss(coordinates(a, b, x, d), body(one, rotation = rotation_x(a), mass = 2, inertia = [1, 2, 2.5]),
            body(two, parent = one, position = [0, 0.2, 0.5], rotation = rotation_z(b), mass = 1, inertia = [1, 1, 0.5]),
            frame(seat, parent = one, position = [0, 0.2, 0.5]),
            body(three, position = [x, 0.3, 0.8], rotation = rotation_y(d), mass = m, inertia = [0.5, 1, 0.75]), {acting})]
        struct Scene {{ m: f64, k: Matrix6<f64> }}"
    );
    let scene = Derivation::of_source(&source, "Scene").unwrap_or_else(|error| panic!("{error}\n{source}"));
    // The mass, and a matrix that is symmetric, in whatever order.
    let entry = |n: usize| MATRIX[n / 6][n % 6];
    let parameters = scene.constants().arguments[0].components.len();
    let parameters: Vec<f64> = std::iter::once(1.0).chain((0..36).map(entry)).take(parameters).collect();
    let at = |configuration: [f64; 4], speeds: [f64; 4]| {
        let (configuration, speeds) = (configuration.to_vec(), speeds.to_vec());
        outputs(&scene, "acceleration", &SceneState { parameters: parameters.clone(), configuration, speeds }, |x| x)
    };
    [at([0.3, -0.4, 0.2, 0.6], [0.5, -0.7, 0.3, 0.9]), at([-0.5, 0.9, -0.4, 0.2], [-0.2, 1.1, 0.6, -0.8])].concat()
}

const MATRIX: [[f64; 6]; 6] = [
    [3.0, 0.0, 0.0, 0.0, 0.5, 0.0],
    [0.0, 4.0, 0.0, 0.0, 0.0, -0.25],
    [0.0, 0.0, 5.0, 0.0, 0.0, 0.0],
    [0.0, 0.0, 0.0, 2.0, 0.0, 0.75],
    [0.5, 0.0, 0.0, 0.0, 1.5, 0.0],
    [0.0, -0.25, 0.0, 0.75, 0.0, 2.5],
];

/// The place of `three` relative to `two`.
const PLACE: &str = "define(r = inverse(two.rotation) * three.rotation,
    arm = inverse(two.rotation) * (three.position - two.position), ex = r * [1, 0, 0], ey = r * [0, 1, 0],
    ez = r * [0, 0, 1], al = atan2(-ez.y, ez.z), be = asin(ez.x), ga = atan2(-ey.x, ex.x))";

fn assert_same(element: &str, written: &str) {
    let [free, one, other] = ["limit = 50000", element, written].map(accelerations);
    assert_eq!(one.len(), 8);
    for ((free, a), b) in free.iter().zip(&one).zip(&other) {
        // Numbers of order 1 to 10, each the sum of less than a hundred products, through a mass matrix with a
        // condition below ten.
        assert!((a - b).abs() <= 1e3 * f64::EPSILON * 10.0, "{element}: {a} and {b}");
        assert!(a.is_finite() && free.is_finite());
    }
    assert!(free.iter().zip(&one).any(|(free, a)| (free - a).abs() > 0.1), "{element} does nothing");
}

#[test]
fn couplings_are_torques() {
    assert_same("coupling(body = two, other = one, viscous = 0.7)", "drive(b = -0.7 * rate(b))");
    let by_hand =
        "torque(body = three, value = -0.7 * (three.angular_velocity - two.angular_velocity), axes = observer,
        reaction = two)";
    assert_same("coupling(body = three, other = two, viscous = 0.7)", by_hand);
    assert_same("coupling(body = two, other = three, viscous = 0.7)", by_hand);
}

#[test]
fn torsional_springs_are_springs_along_a_twist() {
    assert_same(
        "torsional_spring(body = two, other = seat, stiffness = 3, angle = 0.4, damping = 0.7)",
        "spring(along = b, stiffness = 3, length = 0.4, damping = 0.7)",
    );
    // Of the quaternion: tan(θ/2) = q₃/q₀.
    let twist = "define(r = inverse(two.rotation) * three.rotation, ex = r * [1, 0, 0], ey = r * [0, 1, 0],
        ez = r * [0, 0, 1], w = sqrt(1 + ex.x + ey.y + ez.z)),
        spring(along = 2 * atan2((ex.y - ey.x) / w, w), stiffness = 3, length = 0.4, damping = 0.7)";
    assert_same("torsional_spring(body = three, other = two, stiffness = 3, angle = 0.4, damping = 0.7)", twist);
}

#[test]
fn bushings_are_springs_along_displacements_and_cardan_angles() {
    assert_same(
        "bushing(body = two, other = seat, stiffness = [1, 1, 1, 1, 1, 3], damping = [2, 2, 2, 2, 2, 0.7])",
        "spring(along = b, stiffness = 3, damping = 0.7)",
    );
    let springs: Vec<String> = ["arm.x", "arm.y", "arm.z", "al", "be", "ga"]
        .iter()
        .enumerate()
        .map(|(n, along)| format!("spring(along = {along}, stiffness = {}, damping = 0.{})", n + 1, n + 2))
        .collect();
    let element = "bushing(body = three, other = two, stiffness = [1, 2, 3, 4, 5, 6],
        damping = [0.2, 0.3, 0.4, 0.5, 0.6, 0.7])";
    assert_same(element, &format!("{PLACE}, {}", springs.join(", ")));
    let potential =
        "potential = (3 * arm.x * arm.x + 4 * arm.y * arm.y + 5 * arm.z * arm.z + 2 * al * al + 1.5 * be * be
        + 2.5 * ga * ga) / 2 + 0.5 * arm.x * be - 0.25 * arm.y * ga + 0.75 * al * ga";
    assert_same("bushing(body = three, other = two, stiffness = k)", &format!("{PLACE}, {potential}"));
}
