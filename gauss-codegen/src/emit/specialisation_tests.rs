//! Absent elements leave nothing behind: the code of a scene without an element is the code of the scene that never
//! heard of it.

use super::tests::{function, generate};

/// Clauses that act on one body in a chart; they name fields of `FIELDS`.
const ELEMENTS: [&str; 9] = [
    "drag(linear = d)",
    "drag(quadratic = dd)",
    "medium(velocity = [v.x, v.y, v.z]), drag(linear = d)",
    "force(at = at, value = v)",
    "force(at = at, value = v, axes = observer)",
    "input(gust: Wrench), wrench(force = gust.force, torque = gust.torque)",
    "point(hook, body = body, at = at), spring(from = [0, 0, 0], to = hook, stiffness = k)",
    "central_gravity(mu = k, center = [0, 0, 0])",
    "potential = k * body.position.x",
];
const FIELDS: &str = "d: Vector6<f64>, dd: Matrix6<f64>, at: Vector3<f64>, v: Vector3<f64>, k: f64";
const CHARTS: [&str; 4] = ["left_invariant", "right_invariant", "hybrid", "jet(euler_zyx)"];

/// A heavy body in a chart with clauses and plain fields.
fn body(chart: &str, clauses: &str, fields: &str) -> String {
    format!(
        "#[gauss(chart = {chart}, {clauses})] struct Stone {{
            #[gauss(mass)] mass: f64,
            #[gauss(inertia)] inertia: Vector3<f64>,
            #[gauss(gravity)] g: f64,
            {fields}
        }}"
    )
}

/// The function with its constants, `self.k0` and so on, counted in the order in which it names them.
fn function_with_own_constants(source: &str, name: &str) -> String {
    let code = function(source, name);
    let mut seen: Vec<&str> = Vec::new();
    let mut parts = code.split("self.k");
    let mut out = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (number, rest) = part.split_at(part.find(|c: char| !c.is_ascii_digit()).unwrap_or(part.len()));
        let place = seen.iter().position(|n| *n == number).unwrap_or_else(|| {
            seen.push(number);
            seen.len() - 1
        });
        out += &format!("self.k{place}{rest}");
    }
    out
}

#[test]
fn an_element_that_is_taken_out_leaves_nothing_behind() {
    for chart in CHARTS {
        let bare = generate(&body(chart, "", "")).to_string();
        for element in ELEMENTS {
            assert_ne!(bare, generate(&body(chart, element, FIELDS)).to_string(), "{chart}: `{element}` does nothing");
        }
        // The clauses are gone and the fields that they named are still there: all of the code is what it was.
        assert_eq!(bare, generate(&body(chart, "", FIELDS)).to_string(), "{chart}");
    }
}

#[test]
fn a_system_forgets_elements_as_well() {
    let pendulum = |clauses: &str, fields: &str| {
        format!(
            "#[gauss(coordinates(theta), body(arm, rotation = rotation_y(theta)), {clauses})] struct Pendulum {{
                #[gauss(body)] arm: RigidBody<f64>,
                #[gauss(gravity)] g: f64,
                {fields}
            }}"
        )
    };
    let fields = "k: f64, c: f64, l: f64";
    // Before its methods are the kernel's fields and `kernel()`, which checks all numbers of a system, named or not.
    let methods = |clauses: &str, fields: &str| {
        let code = generate(&pendulum(clauses, fields)).to_string();
        let start = code.find("GaussSystem for PendulumKernel").expect("the kernel is a system");
        code[start..].to_owned()
    };
    let bare = methods("", "");
    let elements = [
        "drive(theta = -c * rate(theta))",
        "damping = 0.5 * c * rate(theta).powi(2)",
        "spring(along = theta, stiffness = k, length = l)",
        "stop(along = theta, least = -l, most = l, stiffness = k, width = c)",
        "input(motor), torque(body = arm, value = [0, motor, 0])",
    ];
    for element in elements {
        assert_ne!(bare, methods(element, fields), "`{element}` does nothing");
    }
    assert_eq!(bare, methods("", fields));
}

/// Momentum depends on the body alone, and not on what acts on it.
#[test]
fn what_acts_is_not_in_the_methods_of_the_motion() {
    for chart in CHARTS {
        let bare = body(chart, "", "");
        for element in ["medium(velocity = [v.x, v.y, v.z]), drag(linear = d)", "potential = k * body.position.x"] {
            let with = body(chart, element, FIELDS);
            for name in ["kinematics", "momentum", "velocity", "mass_matrix", "kinetic_energy"] {
                let [bare, with] = [&bare, &with].map(|source| function_with_own_constants(source, name));
                assert_eq!(bare, with, "{chart}: `{element}` changes `{name}`");
            }
        }
    }
}

/// Zeros that are known when the code is made are not in it.
#[test]
fn an_element_of_zeros_is_no_code() {
    let acceleration = |clauses: &str| function(&body("hybrid", clauses, FIELDS), "acceleration");
    let bare = acceleration("");
    for zeros in ["force(body = body, value = [0, 0, 0])", "drag(linear = [0, 0, 0, 0, 0, 0])", "potential = 0"] {
        assert_eq!(bare, acceleration(zeros), "`{zeros}`");
    }
    assert_eq!(acceleration("drag(linear = d)"), acceleration("medium(velocity = [0, 0, 0]), drag(linear = d)"));
}
