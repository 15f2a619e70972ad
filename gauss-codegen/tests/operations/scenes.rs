//! What is counted: one body in every chart and motion, loads one by one, and the systems of the tables.

#[path = "../../examples/structures/mod.rs"]
mod structures;

use crate::sources::{self, Scene};

pub fn all() -> Vec<Scene> {
    [bodies(), loads(), between(), one_link(), chains(), touching(), written_out(), in_macros()]
        .into_iter()
        .flatten()
        .collect()
}

/// Charts of each motion.
const MOTIONS: [(&str, &[&str]); 3] = [
    ("free", &SPATIAL),
    ("fixed_point", &SPATIAL),
    ("planar", &["left_invariant", "right_invariant", "hybrid", "jet"]),
];

const SPATIAL: [&str; 7] = [
    "left_invariant",
    "right_invariant",
    "hybrid",
    "jet(euler_zyx)",
    "jet(euler_zxz)",
    "jet(rodrigues)",
    "jet(modified_rodrigues)",
];

const MASS: &str = "#[gauss(mass)] m: f64,";
const SPHERICAL: &str = "#[gauss(inertia)] i: f64,";
const PRINCIPAL: &str = "#[gauss(inertia)] i: Vector3<f64>,";
const FULL: &str = "#[gauss(inertia)] i: Matrix3<f64>,";
const CENTER: &str = "#[gauss(center_of_mass)] c: Vector3<f64>,";
const DIAGONAL_FLUID: &str = "#[gauss(added_mass)] x: Vector6<f64>,";
const FULL_FLUID: &str = "#[gauss(added_mass)] x: Matrix6<f64>,";
const VERTICAL: &str = "#[gauss(gravity)] g: f64,";
const FIELD: &str = "#[gauss(gravity)] g: Vector3<f64>,";
const BUOYANCY: &str = "#[gauss(displaced_mass)] d: f64,";
const OFF_CENTER: &str = "#[gauss(center_of_buoyancy)] h: Vector3<f64>,";

/// Shapes of a body: each feature alone, and those that go together.
const SHAPES: [(&str, &[&str]); 18] = [
    ("spherical", &[SPHERICAL]),
    ("principal", &[PRINCIPAL]),
    ("full", &[FULL]),
    ("principal; g", &[PRINCIPAL, VERTICAL]),
    ("principal; field", &[PRINCIPAL, FIELD]),
    ("spherical off centre", &[SPHERICAL, CENTER]),
    ("principal off centre", &[PRINCIPAL, CENTER]),
    ("full off centre", &[FULL, CENTER]),
    ("principal off centre; g", &[PRINCIPAL, CENTER, VERTICAL]),
    ("full off centre; g", &[FULL, CENTER, VERTICAL]),
    ("principal in fluid (6)", &[PRINCIPAL, DIAGONAL_FLUID]),
    ("principal in fluid (6×6)", &[PRINCIPAL, FULL_FLUID]),
    ("principal off centre in fluid (6)", &[PRINCIPAL, CENTER, DIAGONAL_FLUID]),
    ("principal off centre in fluid (6); g", &[PRINCIPAL, CENTER, DIAGONAL_FLUID, VERTICAL]),
    ("full off centre in fluid (6×6)", &[FULL, CENTER, FULL_FLUID]),
    ("principal; g and buoyancy off O", &[PRINCIPAL, VERTICAL, BUOYANCY, OFF_CENTER]),
    ("principal off centre in fluid (6×6); field and buoyancy", &[PRINCIPAL, CENTER, FULL_FLUID, FIELD, BUOYANCY]),
    ("everything", &[FULL, CENTER, FULL_FLUID, FIELD, BUOYANCY, OFF_CENTER]),
];

/// One body: chart × motion × shape.
fn bodies() -> Vec<Scene> {
    let mut scenes = Vec::new();
    for (motion, charts) in MOTIONS {
        for chart in charts {
            for (shape, fields) in SHAPES {
                let name = format!("{motion} {chart} {shape}");
                let fields = fields.concat();
                let source = format!("#[gauss(chart = {chart}, motion = {motion})] struct Body {{ {MASS} {fields} }}");
                scenes.push(Scene { name, source });
            }
        }
    }
    scenes
}

/// What acts, on a body in principal axes: clause, fields.
const LOADS: [(&str, &str, &str); 12] = [
    ("central gravity", "central_gravity(mu = k)", "k: f64"),
    ("stream", "medium(velocity = s)", "#[gauss(added_mass)] x: Vector6<f64>, s: Vector3<f64>"),
    ("linear drag (6)", "drag(linear = e)", "e: Vector6<f64>"),
    ("linear drag (6×6)", "drag(linear = e)", "e: Matrix6<f64>"),
    ("quadratic drag (6)", "drag(quadratic = e)", "e: Vector6<f64>"),
    ("quadratic drag (6×6)", "drag(quadratic = e)", "e: Matrix6<f64>"),
    ("input at a point", "input(f), force(thrust, at = a, value = [f, 0, 0])", "a: Vector3<f64>"),
    (
        "input at a point in observer's axes",
        "input(f: Vector3), force(thrust, at = a, value = f, axes = observer)",
        "a: Vector3<f64>",
    ),
    ("input of a torque", "input(n: Vector3), torque(motor, value = n)", ""),
    ("potential", "potential = k * body.position.x", "k: f64"),
    (
        "literal data",
        "center_of_mass = [0, 0, k], force(push, at = [0.2, 0, 0.1], value = [1, 2, 0.5], axes = observer)",
        "#[gauss(gravity)] g: f64, k: f64",
    ),
    (
        "a vehicle in a stream",
        "input(thrust, rudder), medium(velocity = s * sin(t)), define(v = body.relative_velocity), \
         drag(quadratic = e), force(lift, at = a, value = [0, k * v.x * v.y, k * v.x * v.z]), \
         force(fin, at = a, value = [thrust, l * v.x * v.x * rudder, 0])",
        "#[gauss(added_mass)] x: Matrix6<f64>, #[gauss(gravity)] g: Vector3<f64>, #[gauss(displaced_mass)] d: f64, \
         s: Vector3<f64>, a: Vector3<f64>, k: f64, l: f64, e: Matrix6<f64>",
    ),
];

/// A free body with one load, in four charts; derivatives of the heavy body.
fn loads() -> Vec<Scene> {
    let mut scenes = Vec::new();
    for chart in &SPATIAL[..4] {
        for (load, clause, fields) in LOADS {
            let source = format!("#[gauss(chart = {chart}, {clause})] struct Body {{ {MASS} {PRINCIPAL} {fields} }}");
            scenes.push(Scene { name: format!("load {chart} {load}"), source });
        }
        for wanted in ["linearize(parameters)", "regressor", "taylor"] {
            let source =
                format!("#[gauss(chart = {chart}, {wanted})] struct Body {{ {MASS} {FULL} {CENTER} {VERTICAL} }}");
            scenes.push(Scene { name: format!("wanted {chart} {wanted}"), source });
        }
    }
    scenes
}

/// Elements between two bodies: clause, fields.
const BETWEEN: [(&str, &str, &str); 3] = [
    ("coupling", "coupling(body = lower, other = upper, viscous = c)", "c: f64"),
    (
        "torsional spring",
        "torsional_spring(body = lower, other = upper, stiffness = k, angle = a, damping = c)",
        "k: f64, a: f64, c: f64",
    ),
    ("bushing", "bushing(body = lower, other = upper, stiffness = k, damping = c)", "k: Matrix6<f64>, c: Vector6<f64>"),
];

/// Two bodies on hinges, and two free bodies, with one element between them.
fn between() -> Vec<Scene> {
    let pairs = [
        (
            "hinged",
            "coordinates(alpha, beta), body(upper, rotation = rotation_y(alpha)), \
             body(lower, parent = upper, position = [0, 0, -1], rotation = rotation_z(beta))",
        ),
        (
            "free",
            "coordinates(one: Pose, two: Pose), body(upper, position = one.position, rotation = one.rotation), \
             body(lower, position = two.position, rotation = two.rotation)",
        ),
    ];
    let mut scenes = Vec::new();
    for (pair, bodies) in pairs {
        for (element, clause, fields) in BETWEEN {
            let source = format!(
                "#[gauss({bodies}, {clause})] struct Pair {{ #[gauss(body)] upper: RigidBody<f64>, \
                 #[gauss(body)] lower: RigidBody<f64>, {fields} }}"
            );
            scenes.push(Scene { name: format!("between two {pair} bodies: {element}"), source });
        }
    }
    scenes
}

/// The charts of one body in the language of systems.
fn one_link() -> Vec<Scene> {
    let charts = [
        ("twist", "coordinates(pose: Pose)", "position = pose.position, rotation = pose.rotation"),
        (
            "hybrid",
            "coordinates(pose: Pose), speeds(v: Vector3, w: Vector3), \
             kinematics(pose = twist(inverse(pose.rotation) * v, w))",
            "position = pose.position, rotation = pose.rotation",
        ),
        (
            "right",
            "coordinates(pose: Pose), speeds(v: Vector3, w: Vector3), \
             kinematics(pose = twist(inverse(pose.rotation) * (v + cross(w, pose.position)), \
             inverse(pose.rotation) * w))",
            "position = pose.position, rotation = pose.rotation",
        ),
        (
            "zyx",
            "coordinates(b1, b2, b3, psi, theta, phi)",
            "position = [b1, b2, b3], rotation = rotation_z(psi) * rotation_y(theta) * rotation_x(phi)",
        ),
        ("ball", "coordinates(turn: Rotation)", "rotation = turn"),
        ("plane", "coordinates(b1, b2, theta)", "position = [b1, b2, 0], rotation = rotation_z(theta)"),
    ];
    let shapes = [
        ("principal", [PRINCIPAL].as_slice()),
        ("full off centre", &[FULL, CENTER]),
        ("full off centre; g", &[FULL, CENTER, VERTICAL]),
        ("principal off centre in fluid (6); g", &[PRINCIPAL, CENTER, DIAGONAL_FLUID, VERTICAL]),
    ];
    let mut scenes = Vec::new();
    for (chart, coordinates, place) in charts {
        for (shape, fields) in shapes {
            let fields = fields.concat();
            let source = format!("#[gauss({coordinates}, body({place}))] struct Body {{ {MASS} {fields} }}");
            scenes.push(Scene { name: format!("one link {chart} {shape}"), source });
        }
    }
    scenes
}

/// Contacts: without friction, with one tangent and with two, of one body in a chart, and in a loop.
fn touching() -> Vec<Scene> {
    let ball = "contact(floor, point = body.position, radius = r, friction = mu, restitution = e)";
    let scenes = [
        (
            "bouncing ball",
            "#[gauss(coordinates(z), particle(mass = m, position = [0, 0, z]), contact(floor, gap = z, restitution = e))] \
             struct Ball { m: f64, #[gauss(gravity)] g: f64, e: f64 }"
                .to_owned(),
        ),
        (
            "block on a slope",
            "#[gauss(coordinates(x, z), particle(mass = m, position = [x, 0, z]), contact(slope, point = [x, 0, z], \
             plane = [-sin(a), 0, cos(a)], along = [1, 0, 0], friction = mu))] \
             struct Block { m: f64, #[gauss(gravity)] g: f64, a: f64, mu: f64 }"
                .to_owned(),
        ),
        (
            "rolling ball",
            format!(
                "#[gauss(chart = hybrid, {ball})] struct Ball {{ {MASS} {PRINCIPAL} {CENTER} {VERTICAL} r: f64, mu: f64, \
                 e: f64 }}"
            ),
        ),
        (
            "pendulum with stops",
            "#[gauss(coordinates(a, b), particle(mass = m, position = [l * sin(a), 0, -l * cos(a)]), particle(mass = m, \
             position = [l * (sin(a) + sin(b)), 0, -l * (cos(a) + cos(b))]), range(a, from = -k, to = k), range(knee, \
             along = b - a, from = 0, restitution = e))] \
             struct Pendulum { m: f64, l: f64, k: f64, e: f64, #[gauss(gravity)] g: f64 }"
                .to_owned(),
        ),
        (
            "slider-crank with a stop",
            "#[gauss(coordinates(a, b, x), particle(mass = m, position = [l * cos(a), 0, l * sin(a)]), particle(mass = m, \
             position = [x, 0, 0]), body(rod, rotation = rotation_y(b), mass = m, inertia = k), constraint(position = \
             [l * cos(a) + k * cos(b) - x, 0, l * sin(a) - k * sin(b)]), range(x, to = k))] \
             struct Crank { m: f64, l: f64, k: f64 }"
                .to_owned(),
        ),
    ];
    let named = |(name, source): (&str, String)| Scene { name: format!("touching: {name}"), source };
    scenes.into_iter().map(named).collect()
}

fn chains() -> Vec<Scene> {
    let mut scenes = vec![
        ("structure torpedo".into(), structures::torpedo("")),
        ("structure torpedo linearize".into(), structures::torpedo(", linearize(inverse)")),
        ("structure top".into(), structures::top("")),
        ("structure arm".into(), structures::arm("")),
        ("structure arm linearize".into(), structures::arm(", linearize(inverse)")),
        ("structure arm parameters".into(), structures::arm(", linearize(parameters)")),
        ("structure top hessian".into(), structures::top(", linearize(hessian)")),
        ("structure arm hessian".into(), structures::arm(", linearize(hessian)")),
        (
            "structure arm frames".into(),
            structures::arm(", frames(b3, b6), methods(centroidal, nonlinear_effects, gravity_torques)"),
        ),
        (
            "structure arm geared".into(),
            structures::arm(", armature(q0 = 0.1, q1 = 0.1, q2 = 0.1, q3 = 0.1, q4 = 0.1)"),
        ),
        ("structure torpedo frames".into(), structures::torpedo(", frames(body)")),
        ("structure quadruped linearize".into(), structures::quadruped(true, ", linearize(inverse), limit = 100000")),
        ("structure quadruped undriven".into(), structures::quadruped(false, ", linearize")),
    ];
    for n in [2, 3, 4, 5, 6, 8, 10, 14] {
        scenes.push((format!("chain of {n} in the plane; relative"), structures::planar(n, true)));
    }
    for n in [2, 4, 8] {
        scenes.push((format!("chain of {n} in the plane; absolute"), structures::planar(n, false)));
        scenes.push((format!("chain of {n} particles"), structures::particles(n)));
    }
    for n in [2, 3, 4, 6] {
        scenes.push((format!("chain of {n} in space"), structures::spatial(n)));
    }
    scenes.into_iter().map(|(name, source)| Scene { name, source }).collect()
}

/// Structs of benchmarks, examples and tests.
pub fn written_out() -> Vec<Scene> {
    let places = [
        "benches/src/scenes.rs",
        "examples",
        "tests/tests/systems/arm.rs",
        "tests/tests/bodies/central_gravity.rs",
        "tests/tests/systems/elements.rs",
        "tests/tests/constraints/holonomic.rs",
        "tests/tests/constraints/linkages",
        "tests/tests/bodies/media.rs",
        "tests/tests/constraints/nonholonomic",
        "tests/tests/constraints/rolling",
        "tests/tests/systems/main.rs",
    ];
    places.into_iter().flat_map(sources::of).collect()
}

/// Structs that macros write.
fn in_macros() -> Vec<Scene> {
    let mut scenes = Vec::new();
    for (name, chart) in [
        ("Kirchhoff", "left_invariant"),
        ("NewtonEuler", "right_invariant"),
        ("Hybrid", "hybrid"),
        ("Lagrange", "jet(euler_zyx)"),
    ] {
        let values = [("name", name), ("chart", chart)];
        scenes.push(sources::in_macro("examples/charts/src/vehicle.rs", "vehicle", &values));
        scenes.push(sources::in_macro("examples/remus100/vehicle.rs", "vehicle", &values));
    }
    let pendulums = [
        (
            "DoublePendulum",
            "coordinates(a, b)",
            "position = [length * sin(a), 0, -length * cos(a)], rotation = rotation_y(-b)",
        ),
        (
            "JointedPendulum",
            "coordinates(a, c)",
            "parent = upper, position = [0, 0, -length], rotation = rotation_y(-c)",
        ),
    ];
    for (name, coordinates, place) in pendulums {
        let values = [("name", name), ("coordinates", coordinates), ("lower", "lower"), ("place", place)];
        scenes.push(sources::in_macro("benches/src/scenes.rs", "pendulum", &values));
    }
    scenes
}
