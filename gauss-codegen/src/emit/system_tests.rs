//! Systems: the derived equations for review, code, and how the work grows with the length of a chain.

use proc_macro2::{TokenStream, TokenTree};

use super::tests::{function, generate, pretty};

const SLEIGH: &str = "#[gauss(
    coordinates(x, y, theta), speeds(v, omega), kinematics(x = v * cos(theta), y = v * sin(theta), theta = omega),
    body(position = [x, y, 0], rotation = rotation_z(theta)),
)] struct Sleigh { #[gauss(mass)] m: f64, #[gauss(center_of_mass)] a: Vector3<f64>, #[gauss(inertia)] j: Vector3<f64> }";

const PENDULUM: &str = "#[gauss(
    coordinates(theta, phi),
    particle(mass = m, position = [l * sin(theta) * cos(phi), l * sin(theta) * sin(phi), -l * cos(theta)]),
)] struct Pendulum { m: f64, l: f64, #[gauss(gravity)] g: f64 }";

const ROD: &str = "#[gauss(
    coordinates(x, z), particle(mass = m, position = [x, 0, z]), constraint(position = x * x + z * z - l * l),
)] struct Rod { m: f64, l: f64, #[gauss(gravity)] g: f64 }";

const ARMS: &str = "#[gauss(
    coordinates(a, b),
    body(upper, rotation = rotation_y(a)),
    body(lower, parent = upper, position = [0, 0, -l], rotation = rotation_y(b)),
)] struct Arms {
    #[gauss(body)] upper: RigidBody<f64>, #[gauss(body)] lower: RigidBody<f64>, l: f64, #[gauss(gravity)] g: f64,
}";

const SLUNG: &str = "#[gauss(
    coordinates(pose: Pose, alpha), speeds(u: Vector3, w: Vector3, s), kinematics(pose = twist(u, w), alpha = s),
    body(craft, position = pose.position, rotation = pose.rotation),
    particle(mass = m, parent = craft, position = [l * sin(alpha), 0, -l * cos(alpha)]),
)] struct Slung { #[gauss(body)] craft: RigidBody<f64>, m: f64, l: f64, #[gauss(gravity)] g: f64 }";

/// A disk that rolls: the constraints are solved for the velocity of its centre.
const DISK: &str = "#[gauss(
    coordinates(x, y, phi, theta, psi), speeds(vx, vy, w1, w2, w3),
    kinematics(x = vx, y = vy, phi = w2 / sin(theta), theta = w1, psi = w3 - w2 / tan(theta)),
    body(disk, position = [x, y, r * sin(theta)], rotation = rotation_z(phi) * rotation_x(theta) * rotation_z(psi)),
    constraint(velocity = disk.velocity
        - cross(disk.angular_velocity, r * (rotation_z(phi) * [0, cos(theta), sin(theta)]))),
    independent(w1, w2, w3),
)] struct Disk { #[gauss(body)] disk: RigidBody<f64>, r: f64, #[gauss(gravity)] g: f64 }";

/// Bristles that bend and slip: LuGre's friction, under a motor that is late.
const BRISTLES: &str = "#[gauss(
    coordinates(x), input(command), particle(mass = m, position = [x, 0, 0]),
    define(slide = rate(x) - s0 * abs(rate(x)) * bristle / hold),
    states(bristle = slide, thrust = (command - thrust) / lag),
    drive(x = thrust - s0 * bristle - s1 * slide),
)] struct Bristles { m: f64, s0: f64, s1: f64, hold: f64, lag: f64 }";

/// The text of `EQUATIONS`: the first string in the brackets after the name.
fn equations(source: &str) -> String {
    fn find(tokens: TokenStream) -> Option<String> {
        let mut tokens = tokens.into_iter();
        while let Some(token) = tokens.next() {
            let found = match token {
                TokenTree::Group(group) => find(group.stream()),
                TokenTree::Ident(word) if word == "EQUATIONS" => {
                    let group = tokens.find_map(|token| match token {
                        TokenTree::Group(group) => group.stream().into_iter().next(),
                        _ => None,
                    });
                    group.and_then(|text| syn::parse2::<syn::LitStr>(text.into()).ok()).map(|s| s.value())
                }
                _ => None,
            };
            if found.is_some() {
                return found;
            }
        }
        None
    }
    find(generate(source)).expect("generated code has the equations")
}

#[test]
fn equations_of_the_sleigh() {
    insta::assert_snapshot!(equations(SLEIGH));
}

#[test]
fn equations_of_bristles() {
    insta::assert_snapshot!(equations(BRISTLES));
}

#[test]
fn rates_of_bristles() {
    insta::assert_snapshot!(function(BRISTLES, "configuration_rates"));
}

#[test]
fn equations_of_the_spherical_pendulum() {
    insta::assert_snapshot!(equations(PENDULUM));
}

#[test]
fn equations_of_a_pendulum_in_cartesian_coordinates() {
    insta::assert_snapshot!(equations(ROD));
}

#[test]
fn equations_of_two_arms() {
    insta::assert_snapshot!(equations(ARMS));
}

#[test]
fn acceleration_of_the_sleigh() {
    insta::assert_snapshot!(function(SLEIGH, "acceleration"));
}

#[test]
fn acceleration_of_two_arms() {
    insta::assert_snapshot!(function(ARMS, "acceleration"));
}

#[test]
fn multipliers_of_a_pendulum_in_cartesian_coordinates() {
    insta::assert_snapshot!(function(ROD, "multipliers"));
}

/// The compiler's time grows faster than a function does. Short ones are one function as ever.
#[test]
fn long_programs_are_split_into_functions() {
    let chain = |count: usize| {
        let listed = |entry: &dyn Fn(usize) -> String| (0..count).map(entry).collect::<Vec<_>>().join(", ");
        let body = |k: usize| {
            let parent = if k > 0 { format!("parent = b{}, position = [l, 0, 0], ", k - 1) } else { String::new() };
            format!("body(b{k}, {parent}rotation = rotation_{}(q{k}))", ["x", "y", "z"][k % 3])
        };
        format!(
            "#[gauss(linearize, limit = 1000000, coordinates({}), {})] struct Chain {{ {}, l: f64 }}",
            listed(&|k| format!("q{k}")),
            listed(&body),
            listed(&|k| format!("#[gauss(body)] b{k}: RigidBody<f64>")),
        )
    };
    let parts = |count: usize| generate(&chain(count)).to_string().matches(":: apart").count();
    assert_eq!(parts(4), 0);
    // Long enough in any of its forms.
    assert!(parts(56) > 4);
}

/// Weight is an element like others.
#[test]
fn a_system_under_gravity_alone_has_powers() {
    let falling =
        "#[gauss(coordinates(x), particle(mass = m, position = [0, 0, x]))] struct Falling { m: f64, GRAVITY }";
    let code = |gravity: &str| generate(&falling.replace("GRAVITY", gravity)).to_string();
    assert!(code("#[gauss(gravity)] g: f64").contains("ForcedSystem"));
    assert!(!code("g: f64").contains("ForcedSystem"));
}

#[test]
fn kinematics_of_a_disk_whose_constraints_are_solved() {
    insta::assert_snapshot!(function(DISK, "kinematics"));
}

#[test]
fn kinematics_of_a_product() {
    insta::assert_snapshot!(function(SLUNG, "kinematics"));
}

/// Operations of `acceleration`, from the table in the rustdoc.
fn operations(source: &str) -> u32 {
    let code = pretty(source);
    let row = code.split("`acceleration` | ").nth(1).and_then(|rest| rest.split('|').next()).expect("a row");
    row.split(", ").filter_map(|part| part.split(' ').next()?.parse::<u32>().ok()).sum()
}

/// Bars one on the other: in the plane, or in universal joints.
fn chain(n: usize, joint: fn(usize) -> (String, String)) -> String {
    let mut clauses = String::new();
    let mut fields = String::new();
    let mut coordinates = Vec::new();
    for k in 0..n {
        let (angles, rotation) = joint(k);
        coordinates.push(angles);
        let parent = if k > 0 { format!("parent = b{}, position = [0, 0, l], ", k - 1) } else { String::new() };
        clauses += &format!(", body(b{k}, {parent}rotation = {rotation})");
        fields += &format!("#[gauss(body)] b{k}: RigidBody<f64>, ");
    }
    let coordinates = coordinates.join(", ");
    format!(
        "#[gauss(coordinates({coordinates}){clauses})] struct Chain {{ {fields} l: f64, #[gauss(gravity)] g: f64 }}"
    )
}

#[test]
fn the_work_of_a_chain_grows_with_its_length() {
    // From the bar before, and from the vertical.
    let relative = |k: usize| (format!("q{k}"), format!("rotation_y(q{k})"));
    let absolute = |k: usize| {
        let before = if k > 0 { format!(" - q{}", k - 1) } else { String::new() };
        (format!("q{k}"), format!("rotation_y(q{k}{before})"))
    };
    for angles in [relative, absolute] {
        let counts: Vec<u32> = [12, 15, 18, 21].iter().map(|&n| operations(&chain(n, angles))).collect();
        let growth: Vec<u32> = counts.windows(2).map(|pair| pair[1] - pair[0]).collect();
        assert_eq!(growth, [growth[0]; 3], "{counts:?}");
        // Cubic growth, as of a factorisation of A, would give 3 × 15² and more.
        assert!(growth[0] < 3 * 100, "{growth:?}");
    }
}

/// Bars one on the other in the plane, every one placed from Ω.
fn apart(n: usize) -> String {
    let sum = |k: usize| (0..=k).map(|j| format!("q{j}")).collect::<Vec<_>>().join(" + ");
    let along = |k: usize, f: &str| match k {
        0 => "0".to_owned(),
        _ => (0..k).map(|j| format!("l * {f}({})", sum(j))).collect::<Vec<_>>().join(" + "),
    };
    let body = |k: usize| {
        format!(
            ", body(b{k}, position = [{}, 0, {}], rotation = rotation_y({}))",
            along(k, "sin"),
            along(k, "cos"),
            sum(k)
        )
    };
    let clauses: String = (0..n).map(body).collect();
    let fields: String = (0..n).map(|k| format!("#[gauss(body)] b{k}: RigidBody<f64>, ")).collect();
    let coordinates = (0..n).map(|k| format!("q{k}")).collect::<Vec<_>>().join(", ");
    format!(
        "#[gauss(coordinates({coordinates}){clauses})] struct Chain {{ {fields} l: f64, #[gauss(gravity)] g: f64 }}"
    )
}

#[test]
fn recursion_costs_less_than_the_sum_over_bodies() {
    let relative = |k: usize| (format!("q{k}"), format!("rotation_y(q{k})"));
    for n in [3, 4, 6] {
        let (recursive, summed) = (operations(&chain(n, relative)), operations(&apart(n)));
        assert!(recursive < summed, "{n} links: {recursive} by recursion, {summed} by the sum");
    }
}

/// A free body in coordinates of the language, beside the same in the chart.
const BODY: &str = "struct Body {
    #[gauss(mass)] m: f64, #[gauss(center_of_mass)] c: Vector3<f64>, #[gauss(inertia)] j: Vector3<f64>, #[gauss(gravity)] g: f64,
}";

#[test]
fn a_free_body_in_the_language_and_in_the_chart() {
    let system = format!(
        "#[gauss(coordinates(pose: Pose), speeds(u: Vector3, w: Vector3), kinematics(pose = twist(u, w)), \
         body(position = pose.position, rotation = pose.rotation))] {BODY}"
    );
    let chart = format!("#[gauss(chart = left_invariant)] {BODY}");
    let costs = format!("in the language {}, in the chart {}", operations(&system), operations(&chart));
    insta::assert_snapshot!(format!("{costs}\n\n{}", equations(&system)));
}
