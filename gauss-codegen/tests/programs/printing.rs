//! Equations for people are no longer than the graph that they are printed from: what long rows have in common has a
//! name.

#[path = "../common/latex.rs"]
mod latex;
#[path = "../common/tex.rs"]
mod tex;

use std::time::{Duration, Instant};

use gauss_codegen::{Derivation, Notation};

/// The bicycle of Whipple: a frame with its rider, a fork, two wheels that roll without slipping. Without `independent`
/// its contacts have multipliers; with it three of eight speeds stay.
fn bicycle(independent: &str) -> Derivation {
    let source = format!(
        "#[gauss(
            coordinates(x, y, yaw, lean, pitch, steer, rear_angle, front_angle),
            speeds(vx, vy, turning, leaning, pitching, steering, rolling, spinning),
            kinematics(
                x = vx, y = vy, yaw = turning, lean = leaning, pitch = pitching, steer = steering, rear_angle = rolling,
                front_angle = spinning,
            ),
            frame(heading, position = [x, y, 0], rotation = rotation_z(yaw) * rotation_x(lean)),
            body(rear, parent = heading, position = [0, 0, a], rotation = rotation_y(rear_angle)),
            body(rider, parent = heading, position = [0, 0, a], rotation = rotation_y(pitch)),
            body(fork, parent = rider, position = [c, 0, 0], rotation = rotation_z(steer)),
            body(front, parent = fork, position = [e, 0, -f], rotation = rotation_y(front_angle)),
            define(
                axle = fork.rotation * [0, 1, 0],
                down = (axle.z * axle - [0, 0, 1]) / sqrt(1 - axle.z * axle.z),
            ),
            constraint(velocity = rear.velocity.x - a * cross(rear.angular_velocity, heading.rotation * [0, 0, 1]).x),
            constraint(velocity = rear.velocity.y - a * cross(rear.angular_velocity, heading.rotation * [0, 0, 1]).y),
            constraint(velocity = front.velocity + cross(front.angular_velocity, b * down)),
            {independent}
        )]
        struct Bicycle {{
            #[gauss(body)] rear: RigidBody<f64>, #[gauss(body)] rider: RigidBody<f64>,
            #[gauss(body)] fork: RigidBody<f64>, #[gauss(body)] front: RigidBody<f64>,
            a: f64, b: f64, c: f64, e: f64, f: f64, #[gauss(gravity)] g: f64,
        }}"
    );
    Derivation::of_source(&source, "Bicycle").expect("a valid scene")
}

fn operations(derivation: &Derivation, method: &str) -> u32 {
    derivation.program(method).expect("a method of every kernel").code.cost().total()
}

/// It took forever as trees of 10⁸ terms.
#[test]
fn the_equations_of_a_bicycle_are_printed() {
    let begun = Instant::now();
    let derivation = bicycle("independent(leaning, steering, rolling)");
    assert!(begun.elapsed() < Duration::from_secs(30), "{:?}", begun.elapsed());
    for notation in [Notation::Text, Notation::Latex] {
        let printed = derivation.equations(notation);
        assert!(printed.contains("where"));
        // Some ten characters for each of its ten thousand operations.
        assert!(printed.len() < 200_000, "{} bytes", printed.len());
    }
}

/// A name is explained once, in terms of those before it.
#[test]
fn names_are_explained_in_order() {
    let derivation = bicycle("independent(leaning, steering, rolling)");
    let (_, explained) = derivation.equations(Notation::Text).split_once("\nwhere\n").expect("long rows");
    let number = |name: &str| -> usize {
        let digits = name.chars().map_while(|c| (c as u32).checked_sub('₀' as u32).filter(|digit| *digit < 10));
        digits.fold(0, |number, digit| 10 * number + digit as usize)
    };
    for (k, line) in explained.lines().enumerate() {
        let (name, value) = line.trim().split_once(" = ").expect("a definition");
        assert_eq!(number(name.strip_prefix('s').expect("the letter of parts")), k + 1);
        assert!(value.split('s').skip(1).map(number).all(|part| part <= k), "{line}");
    }
}

/// What is solved by hand of `independent` costs no more than multipliers do: both ways are derived. The order in which
/// common parts are extracted decides up to 0.8 % of a program's operations (docs/decisions.md). A form that keeps
/// digits which the other one loses may cost twice as much.
#[test]
fn solving_for_speeds_is_not_dearer_than_multipliers() {
    let derivations = ["independent(leaning, steering, rolling)", ""].map(bicycle);
    let loses = |derivation: &Derivation| {
        let figures = derivation.accuracy().iter().find(|(name, _)| name == "acceleration");
        figures.expect("a figure").1[0]
    };
    let [solved, kept] = [0, 1].map(|k: usize| f64::from(operations(&derivations[k], "acceleration")));
    let most = if loses(&derivations[0]) < loses(&derivations[1]) { 2.0 } else { 1.008 };
    assert!(solved <= most * kept, "{solved} and {kept}");
}

/// A quantity that is squared again and again has a short graph and a tree of 2⁶ times the length.
#[test]
fn what_is_shared_is_printed_once() {
    let squares: String = (1..7).map(|k| format!(", d{k} = sin(d{0}) * d{0} + x", k - 1)).collect();
    let source = format!(
        "#[gauss(coordinates(x), particle(mass = m, position = [x, 0, 0]), define(d0 = cos(x) + k * x{squares}), \
         potential = d6)] struct Scene {{ m: f64, k: f64 }}"
    );
    let derivation = Derivation::of_source(&source, "Scene").expect("a valid scene");
    assert!(derivation.equations(Notation::Text).len() < 4000, "{}", derivation.equations(Notation::Text));
}

/// Whatever was derived before in the same process.
#[test]
fn a_scene_is_printed_as_it_was_before() {
    let of_scenes =
        || crate::common::SCENES.map(|(name, source)| Derivation::of_source(source, name).expect("a valid scene"));
    for (first, second) in of_scenes().iter().zip(&of_scenes()) {
        for notation in [Notation::Text, Notation::Latex] {
            assert_eq!(first.equations(notation), second.equations(notation));
        }
        assert_eq!(first.rust().expect("code").to_string(), second.rust().expect("code").to_string());
    }
}

/// And whatever else is asked of the scene: derivatives are derived before equations are printed.
#[test]
fn what_else_is_wanted_changes_nothing_in_the_equations() {
    let scene = |wanted: &str| {
        let source = format!(
            "#[gauss(coordinates(a, b), body(one, rotation = rotation_y(a)), {wanted}
                body(two, parent = one, position = [l, 0, 0], rotation = rotation_y(b)), drive(b = -k * rate(b)))]
             struct Arms {{
                #[gauss(body)] one: RigidBody<f64>, #[gauss(body)] two: RigidBody<f64>, l: f64, k: f64,
                #[gauss(gravity)] g: f64,
             }}"
        );
        Derivation::of_source(&source, "Arms").expect("a valid scene")
    };
    let alone = scene("");
    for wanted in ["linearize,", "linearize(parameters),", "regressor,", "taylor,", "taylor, regressor, linearize,"] {
        let derivation = scene(wanted);
        for notation in [Notation::Text, Notation::Latex] {
            assert_eq!(derivation.equations(notation), alone.equations(notation), "{wanted}");
        }
    }
}

/// Names of all kinds, and powers of all kinds of functions.
#[test]
fn latex_can_be_set() {
    let scenes = [
        "#[gauss(
            coordinates(pitch_angle, x1, ω, αβ, craft_2: Pose, head: Rotation),
            body(hull_7, pose = craft_2), body(top, parent = hull_7, rotation = head),
            body(arm, parent = top, position = [x1, 0, 0], rotation = rotation_y(pitch_angle)),
            particle(mass = 1.5e-20, position = [ω, αβ, exp(x1) * tanh(ω)]),
            potential = k * powf(2 + cos(pitch_angle), n) * sin(pitch_angle) * sin(pitch_angle) + powf(k * k, n) / 3
                + atan2(x1, ω) * atan2(x1, ω) + powi(lift(x1), 3) * powi(sin(x1 + ω), 4) + powi(asin(x1 / 4), 2)
                + sqrt(1 + x1 * x1) * powf(1 + x1 * x1, n) * powf(1 + x1 * x1, n) + 0.3333333333333 * ln(3 + αβ),
            function(lift, derivative = lift_slope, second = lift_curvature),
            input(gust_of_wind: Wrench, thrust_3, way: Vector3),
            wrench(the_gust, body = hull_7, force = gust_of_wind.force, torque = gust_of_wind.torque),
            force(the_push, body = top, value = abs(way.x) * thrust_3 * way),
            damping = k * powi(rate(x1), 2) * powi(cos(pitch_angle), 2)
        )]
        struct Names {
            #[gauss(body)] hull_7: RigidBody<f64>, #[gauss(body)] top: RigidBody<f64>,
            #[gauss(body)] arm: RigidBody<f64>, k: f64, n: f64, #[gauss(gravity)] g: Vector3<f64>,
        }",
        "#[gauss(chart = jet(euler_zyx), drag(the_water, linear = d, quadratic = e), medium(velocity = [s, 0, 0]))]
        struct Names {
            #[gauss(mass)] m: f64, #[gauss(center_of_mass)] c: Vector3<f64>, #[gauss(inertia)] i: Matrix3<f64>,
            #[gauss(added_mass)] a: Matrix6<f64>, #[gauss(gravity)] g: f64, #[gauss(displaced_mass)] w: f64,
            #[gauss(center_of_buoyancy)] h: Vector3<f64>, d: Matrix6<f64>, e: Vector6<f64>, s: f64,
        }",
    ];
    for source in scenes {
        let derivation = Derivation::of_source(source, "Names").expect("a valid scene");
        let complaints = latex::complaints(derivation.equations(Notation::Latex));
        assert!(complaints.is_empty(), "\n{}", complaints.join("\n"));
    }
}

/// A line for each gap, slip and coefficient, of a body in a chart and of others.
#[test]
fn contacts_are_printed_by_their_names() {
    let (_, source) = crate::common::SCENES.iter().find(|(name, _)| *name == "Rolling").expect("a scene");
    let others = "#[gauss(coordinates(x, y), particle(mass = 1, position = [x, y, 0]), range(x, to = l),
        contact(wall_2, gap = y - x, slip = rate(x + y), friction = mu))] struct Corner { l: f64, mu: f64 }";
    let rubbing = "#[gauss(coordinates(x, y), particle(mass = 1, position = [x, y, 0]), dry_friction(x, bound = f),
        dry_friction(belt, slip = [rate(x), rate(y) - v], bound = [f, 2 * f]))] struct Rubbing { f: f64, v: f64 }";
    let turning =
        "#[gauss(coordinates(x, h, a), particle(mass = 1, position = [x, 0, h]), body(top, rotation = rotation_z(a),
        mass = 1, inertia = 1), contact(ice, gap = h, slip = rate(x), friction = mu, spin = rate(a), drilling = l,
        roll = rate(x) / l, rolling = rho))] struct Turning { l: f64, mu: f64, rho: f64 }";
    let rolling = "rolling resistance: a torque against each slip, of the size ρ times the force of the gap; at rest any torque \
                   that is not larger";
    let gaps = "gaps: none becomes negative; each adds a force that is not negative, and zero where it is open";
    let dry = "dry friction: a force against each slip, of the size f; at rest any force that is not larger";
    for (name, source, title, lines) in [
        (
            "Rubbing",
            rubbing,
            dry,
            vec![
                "  s_x = x\u{307}",
                "  f_x = f",
                "  s_belt1 = x\u{307}",
                "  s_belt2 = ",
                "  f_belt1 = f",
                "  f_belt2 = ",
            ],
        ),
        (
            "Turning",
            turning,
            gaps,
            vec!["  g_ice = h", "  s_ice1 = x\u{307}", "  s_ice2 = ", "  μ_ice = mu", "", rolling],
        ),
        ("Turning", turning, rolling, vec!["  s_ice_rolling = ", "  ρ_ice_rolling = rho"]),
        ("Rolling", *source, gaps, vec!["  g_floor = ", "  s_floor1 = ", "  s_floor2 = ", "  μ_floor = mu"]),
        (
            "Corner",
            others,
            gaps,
            vec!["  g_x_to = l - x", "  g_wall_2 = y - x", "  s_wall_2 = x\u{307} + y\u{307}", "  μ_wall_2 = mu"],
        ),
    ] {
        let derivation = Derivation::of_source(source, name).expect("a valid scene");
        let text = derivation.equations(Notation::Text);
        let (_, after) = text.split_once(title).unwrap_or_else(|| panic!("{text}"));
        let found: Vec<&str> = after.trim_start().lines().take(lines.len()).map(str::trim).collect();
        for (line, found) in lines.iter().zip(&found) {
            assert!(found.starts_with(line.trim()), "{line}: {text}");
        }
        let complaints = latex::complaints(derivation.equations(Notation::Latex));
        assert!(complaints.is_empty(), "\n{}", complaints.join("\n"));
    }
}

/// A motor between a craft and its wheel: on the craft's speeds it does not act, in whatever attitude.
#[test]
fn a_torque_between_two_links_is_printed_on_their_joint_alone() {
    let source = "#[gauss(
            coordinates(craft: Pose, angle),
            speeds(u: Vector3, w: Vector3, spin),
            kinematics(craft = twist(u, w), angle = spin),
            body(hull, pose = craft, mass = 10, inertia = 0.2),
            body(wheel, parent = hull, rotation = rotation_z(angle), position = [0.1, 0, 0], mass = 0.5,
                 inertia = [a, a, b]),
            input(motor = \"N m\"),
            torque(drive, body = wheel, value = [0, 0, motor], reaction = hull),
        )]
        struct Spacecraft { a: f64, b: f64 }";
    let derivation = Derivation::of_source(source, "Spacecraft").expect("a valid scene");
    let printed = derivation.equations(Notation::Text);
    let with_motor: Vec<&str> = printed.lines().filter(|line| line.contains("motor")).collect();
    assert_eq!(with_motor, ["  F_spin = motor"], "{printed}");
    for of_craft in ["u1", "u2", "u3", "w1", "w2", "w3"] {
        assert!(printed.contains(&format!("\n  F_{of_craft} = 0\n")), "{printed}");
    }
}

/// A spring pendulum in the plane; with names for its mass and its stretch, and without.
fn elastic(named: bool) -> Derivation {
    let (define, mass, stretch) = match named {
        true => {
            ("define(total = m + n, stretch = sqrt(x * x + y * y) - l, double = 2 * stretch),", "total", "double / 2")
        }
        false => ("", "(m + n)", "(2 * (sqrt(x * x + y * y) - l)) / 2"),
    };
    let source = format!(
        "#[gauss(coordinates(x, y), {define} particle(mass = {mass}, position = [x, y, 0]),
            potential = k * powi({stretch}, 2) / 2)]
        struct Elastic {{ m: f64, n: f64, l: f64, k: f64 }}"
    );
    Derivation::of_source(&source, "Elastic").expect("a valid scene")
}

/// What is named is printed by its name, and the names are explained first.
#[test]
fn names_of_definitions_are_kept() {
    let named = elastic(true);
    let sections = named.sections(Notation::Text);
    let (title, definitions) = &sections[0];
    assert_eq!(title, "definitions");
    assert!(definitions.contains(&"total = m + n".to_owned()), "{definitions:?}");
    let momenta = sections.iter().find(|(title, _)| title.starts_with("momenta")).expect("momenta");
    assert_eq!(momenta.1, ["p_x = total*x\u{307}", "p_y = total*y\u{307}"]);
    let forces = sections.iter().find(|(title, _)| title.starts_with("active forces")).expect("forces");
    assert!(forces.1.iter().all(|row| row.contains("stretch") || row.contains("double")), "{forces:?}");
    assert_ne!(elastic(false).equations(Notation::Text), named.equations(Notation::Text));
}

/// Names are for readers: kernels have the same operations in the same order.
#[test]
fn names_of_definitions_change_no_program() {
    let [named, plain] = [true, false].map(elastic);
    assert_eq!(format!("{:?}", named.programs()), format!("{:?}", plain.programs()));
    assert_eq!(named.accuracy(), plain.accuracy());
}

/// A cart with a pendulum, as textbooks have it.
#[test]
fn systems_are_printed_in_velocity_form() {
    let source = "#[gauss(coordinates(x, theta), particle(mass = m1, position = [x, 0, 0]),
            particle(mass = m2, position = [x + l * sin(theta), 0, -l * cos(theta)]), spring(along = x, stiffness = k, length = 0))]
        struct Cart { m1: f64, m2: f64, l: f64, k: f64, #[gauss(gravity)] g: f64 }";
    let derivation = Derivation::of_source(source, "Cart").expect("a valid scene");
    let sections = derivation.sections(Notation::Text);
    let (_, rows) = sections.iter().find(|(title, _)| title == "velocity form A dz/dt = r").expect("a section");
    assert_eq!(
        *rows,
        [
            "m2*l*cos(theta)*theta_ddot + (m1 + m2)*x\u{308} = m2*l*theta_dot^2*sin(theta) - k*x",
            "m2*l*cos(theta)*x\u{308} + m2*l^2*theta_ddot = -m2*l*g*sin(theta)",
        ]
    );
    assert!(derivation.equations(Notation::Latex).contains("\\ddot{\\theta}"));
    // What is too long to read says so.
    let long = bicycle("independent(leaning, steering, rolling)");
    let sections = long.sections(Notation::Text);
    let (_, rows) = sections.iter().find(|(title, _)| title.starts_with("velocity form")).expect("a section");
    assert!(rows.len() == 1 && rows[0].starts_with("left out: "), "{rows:?}");
}

/// A plane linkage of six bars with two loops: it was six times as wide as a page.
const SIX_BARS: &str = "#[gauss(coordinates(a, b, c, d, e, f),
        body(one, rotation = rotation_y(a)), body(two, parent = one, position = [l1, 0, 0], rotation = rotation_y(b)),
        body(three, parent = two, position = [l2, 0, 0], rotation = rotation_y(c)),
        body(four, position = [w, 0, 0], rotation = rotation_y(d)),
        body(five, parent = four, position = [l4, 0, 0], rotation = rotation_y(e)),
        body(six, position = [w, 0, h], rotation = rotation_y(f)),
        point(p, body = three, at = [l3, 0, 0]), point(q, body = four, at = [l5, 0, h]),
        point(r, body = five, at = [l6, 0, 0]), point(s, body = six, at = [l2, 0, l1]),
        constraint(position = p.x - q.x), constraint(position = p.z - q.z),
        constraint(position = r.x - s.x), constraint(position = r.z - s.z))]
    struct SixBars {
        #[gauss(body)] one: RigidBody<f64>, #[gauss(body)] two: RigidBody<f64>, #[gauss(body)] three: RigidBody<f64>,
        #[gauss(body)] four: RigidBody<f64>, #[gauss(body)] five: RigidBody<f64>, #[gauss(body)] six: RigidBody<f64>,
        l1: f64, l2: f64, l3: f64, l4: f64, l5: f64, l6: f64, w: f64, h: f64, #[gauss(gravity)] g: f64,
    }";

/// Set by TeX on 16 cm: no line is wider. The test `operations` does the same with all its scenes.
#[test]
fn no_line_leaves_the_page() {
    let scenes = crate::common::SCENES.iter().copied().chain([("SixBars", SIX_BARS)]);
    let derived = scenes.map(|(name, source)| (name, Derivation::of_source(source, name).expect("a valid scene")));
    let derived = derived.chain([("Bicycle", bicycle("")), ("Elastic", elastic(true))]);
    let equations: Vec<(String, String)> =
        derived.map(|(name, derivation)| (name.to_owned(), derivation.equations(Notation::Latex).to_owned())).collect();
    for (name, latex) in &equations {
        let complaints = latex::complaints(latex);
        assert!(complaints.is_empty(), "{name}:\n{}", complaints.join("\n"));
    }
    if let Some(complaints) = tex::complaints("pages", &equations) {
        assert!(complaints.is_empty(), "\n{complaints}");
    }
}

/// An arm in a plane whose file says π/2 and π to four places, and 1.6, which is no quarter turn.
#[cfg(feature = "urdf")]
fn arm_of_file(turned: &str) -> Derivation {
    let inertial = "<inertial><origin xyz=\"0.2 0 0\"/><mass value=\"2\"/>
        <inertia ixx=\"0.01\" iyy=\"0.02\" izz=\"0.03\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial>";
    let joint = |name: &str, [parent, child]: [&str; 2], rpy: &str| {
        format!(
            "<joint name=\"{name}\" type=\"continuous\"><parent link=\"{parent}\"/><child link=\"{child}\"/>
             <origin xyz=\"0.4 0 0\" rpy=\"{rpy}\"/><axis xyz=\"0 0 1\"/></joint>
             <link name=\"{child}\">{inertial}</link>"
        )
    };
    let text = format!(
        "<robot name=\"arm\"><link name=\"ground\"/>{}{}</robot>",
        joint("shoulder", ["ground", "upper"], "1.5708 0 0"),
        joint("elbow", ["upper", "lower"], &format!("0 0 {turned}"))
    );
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("arm_{turned}.urdf"));
    std::fs::write(&path, text).expect("a folder that can be written");
    let source = format!("#[gauss(urdf = {path:?}, gravity = 9.81)] struct Arm {{}}");
    Derivation::of_source(&source, "Arm").expect("a valid scene")
}

/// Angles of a file that are quarter turns to their last digit are printed as such, and said to be; others are not.
#[cfg(feature = "urdf")]
#[test]
fn quarter_turns_of_files_are_folded_in_print_alone() {
    let folded = arm_of_file("-3.1416");
    let sections = folded.sections(Notation::Text);
    let (title, rows) = &sections[0];
    assert!(title.starts_with("angles of the file"), "{title}");
    assert_eq!(rows.len(), 2, "{rows:?}");
    let equations: Vec<&String> = sections[1..].iter().flat_map(|(_, rows)| rows).collect();
    assert!(equations.iter().all(|row| !row.contains("3.1416") && !row.contains("1.5708")), "{equations:?}");
    // Kernels compute with the number of the file.
    assert!(folded.rust().expect("code").to_string().contains("1.5708"));
    for (kept, printed) in [("1.6", "8/5"), ("1.571", "1.571"), ("1.5709", "1.5709"), ("0.7854", "0.7854")] {
        let derivation = arm_of_file(kept);
        let rows = derivation.sections(Notation::Text)[1..].iter().flat_map(|(_, rows)| rows);
        let rows: Vec<&String> = rows.collect();
        assert!(rows.iter().any(|row| row.contains(printed)), "{kept}: {rows:?}");
    }
}
