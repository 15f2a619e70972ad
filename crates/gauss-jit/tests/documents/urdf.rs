//! URDF: its elements, what is lost, and what has no counterpart. `again` and `pinocchio` have its motions.

use gauss_jit::{DocumentError, Urdf};

use crate::scenes::examples;

fn made(clauses: &str) -> Urdf {
    let source = format!("#[gauss({clauses})] struct Scene {{}}");
    Urdf::new(&source, &[]).unwrap_or_else(|error| panic!("{clauses}: {error}"))
}

fn holds(made: &Urdf, parts: &[&str]) {
    parts.iter().for_each(|part| assert!(made.xml().contains(part), "{part}\n{}", made.xml()));
}

/// A joint whose axis is not through the O of what it carries has a link of its own on the axis.
#[test]
fn links_and_joints_have_the_places_of_the_scene() {
    let made = made(
        "coordinates(x, angle), gravity = 9.81, input(push), drive(x = 2 * push), armature(x = 0.2),
         friction(along = angle, viscous = 0.3), dry_friction(hinge, slip = rate(angle), bound = 0.5),
         range(rail, along = x, from = -1, to = 2),
         body(cart, position = [x, 0, 0.1], rotation = rotation_x(pi / 2), mass = 1, inertia = [1, 2, 2.5]),
         body(bob, position = [x - 0.5 * sin(angle), 0, 0.1 - 0.5 * cos(angle)], rotation = rotation_y(angle),
              mass = 0.2, center_of_mass = [0, 0.1, 0], inertia = [0.3, 0.3, 0.1]),
         frame(tip, parent = bob, position = [0, 0, -0.1])",
    );
    holds(
        &made,
        &[
            "<?xml version=\"1.0\"?>\n<robot name=\"Scene\">",
            "  <link name=\"world\"/>\n  <joint name=\"x\" type=\"prismatic\">\n    <parent link=\"world\"/>\n    \
             <child link=\"cart\"/>\n    <origin xyz=\"0 0 0.1\" rpy=\"1.5707963267948966 0 0\"/>\n    \
             <axis xyz=\"1 0 0\"/>\n    <limit lower=\"-1\" upper=\"2\" effort=\"1000000000\" velocity=\"1000000000\"/>",
            "<origin xyz=\"0 0.1 0\"/>\n      <mass value=\"0.2\"/>\n      \
             <inertia ixx=\"0.298\" iyy=\"0.3\" izz=\"0.098\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/>",
            "<joint name=\"angle\" type=\"continuous\">\n    <parent link=\"cart\"/>\n    <child link=\"angle_link\"/>",
            "<dynamics damping=\"0.3\" friction=\"0.5\"/>",
            "<joint name=\"bob_fixed\" type=\"fixed\">\n    <parent link=\"angle_link\"/>\n    <child link=\"bob\"/>\n    \
             <origin xyz=\"0 0 -0.5\"/>",
            "<child link=\"tip\"/>",
            "<transmission name=\"push\">",
            "<mechanicalReduction>2</mechanicalReduction>\n      <rotorInertia>0.05</rotorInertia>",
        ],
    );
    let lost = made.lost().join("\n");
    for words in [
        "gravity is lost, (0, 0, -9.81) m/s²",
        "`x` has no bounds of these, which URDF wants: effort, velocity; 1e9 stands there",
        "the armature of `x` is a rotor of the transmission `push`",
    ] {
        assert!(lost.contains(words), "{words}\n{lost}");
    }
    assert_eq!(made.lost().len(), 3, "{lost}");
    made.lost().iter().for_each(|line| holds(&made, &[&format!("<!-- {line} -->")]));
}

#[test]
fn joints_that_follow_one_are_mimics() {
    let made = made(
        "coordinates(a), range(stop, along = a, from = -1), body(one, rotation = rotation_x(a), mass = 1, inertia = 1),
         body(two, rotation = rotation_z(-2 * a), mass = 1, inertia = 1),
         body(three, parent = one, position = [0, 0.25 * a, 1], mass = 1, inertia = 1)",
    );
    holds(
        &made,
        &[
            "<joint name=\"a_2\" type=\"revolute\">\n    <parent link=\"world\"/>\n    <child link=\"two\"/>\n    \
             <axis xyz=\"0 0 -1\"/>\n    <limit lower=\"-2\" upper=\"1000000000\" effort=\"1000000000\" \
             velocity=\"1000000000\"/>\n    <mimic joint=\"a\" multiplier=\"2\"/>",
            "<joint name=\"a_3\" type=\"prismatic\">\n    <parent link=\"one\"/>\n    <child link=\"three\"/>",
            "<mimic joint=\"a\" multiplier=\"0.25\"/>",
        ],
    );
    assert!(
        made.lost().iter().any(|line| line.contains("`a_2` has no bounds of these, which URDF wants: upper limit"))
    );
}

/// Loads and contacts are lost one by one; what of them damps a single joint is kept.
#[test]
fn loads_and_contacts_are_lost_line_by_line() {
    let made = made(
        "coordinates(x, y), input(u, v), gravity = [0, 0, -1],
         body(cart, position = [x, 0, y], mass = 1, inertia = 1), spring(buffer, along = x, stiffness = 3, damping = 2),
         spring(tie, along = x - y, stiffness = 3, damping = 2), drag(air, body = cart, quadratic = [1, 0, 0, 0, 0, 0]),
         drive(pull, x = u * u), drive(push, x = v, y = v), drive(shake, y = smooth_step(t, 1000, 1001)),
         potential = x * x * x, contact(floor, point = cart.position, friction = 0.3, restitution = 0.5), range(rope, along = x + y, to = 1)",
    );
    let lost = made.lost();
    for words in ["`buffer`", "`tie`", "`air`", "`pull`", "`potential`"] {
        assert_eq!(
            lost.iter().filter(|line| line.starts_with(&format!("of {words} nothing is left"))).count(),
            1,
            "{words}"
        );
    }
    for words in [
        "the input `u` is lost",
        "the input `v` is lost",
        "the contact `floor` is lost",
        "the contact `rope_to` is lost",
        "restitution is lost",
        "what depends on the time `t` is lost",
    ] {
        assert!(lost.iter().any(|line| line.starts_with(words)), "{words}\n{lost:#?}");
    }
    assert!(!lost.iter().any(|line| line.contains("MuJoCo") || line.contains("push")), "{lost:#?}");
    holds(&made, &["<dynamics damping=\"2\"/>"]);
    assert_eq!(made.xml().matches("<dynamics").count(), 1);
}

#[test]
fn names_that_are_taken_get_numbers() {
    let made = made(
        "coordinates(x), body(world, position = [x, 0, 0], mass = 1, inertia = 1), frame(x_fixed),
         body(x_link, parent = world, position = [0, 1, 0], mass = 1, inertia = 1)",
    );
    holds(
        &made,
        &["<link name=\"world_2\"/>", "<parent link=\"world_2\"/>", "<joint name=\"x_fixed_fixed\" type=\"fixed\">"],
    );
    let names = made.xml().lines().filter_map(|line| line.trim().strip_prefix("<link name=\"")?.split('"').next());
    let mut names: Vec<&str> = names.collect();
    names.sort_unstable();
    assert_eq!(names, ["world", "world_2", "x_fixed", "x_link"]);
}

#[test]
fn what_has_no_counterpart_is_named() {
    let refused = |clauses: &str| match Urdf::new(&format!("#[gauss({clauses})] struct Scene {{}}"), &[]) {
        Err(error @ DocumentError::NoCounterpart { .. }) => error.to_string(),
        other => panic!("{clauses}: {other:?}"),
    };
    let cart = "coordinates(x), body(cart, position = [x, 0, 0], mass = 1, inertia = 1";
    for (clauses, words) in [
        (
            "coordinates(turn: Rotation), body(top, rotation = turn, mass = 1, inertia = 1)",
            "`turn` turns about a point",
        ),
        (
            "coordinates(x, y), particle(mass = 1, position = [x, y, 0]), constraint(position = x - y)",
            "`constraint`, a loop",
        ),
        (&format!("{cart}, added_mass = [1, 1, 1, 0, 0, 0])"), "on `cart` a fluid acts"),
        (&format!("{cart}), states(f = -f), drive(x = f)"), "`states`"),
        (
            "coordinates(a), body(one, rotation = rotation_x(a), mass = 1, inertia = 1),
          body(two, rotation = rotation_x(a * a), mass = 1, inertia = 1)",
            "the place of `two`",
        ),
        ("coordinates(x), particle(mass = 1, position = [x, sin(t), 0])", "a function of time, as no joint does"),
    ] {
        let found = refused(clauses);
        assert!(found.starts_with("no counterpart in URDF: ") && found.contains(words), "{clauses}: {found}");
    }
}

/// Ball joints and loops are all that URDF lacks of these scenes.
#[test]
fn scenes_with_ball_joints_and_loops_are_refused() {
    let refused: Vec<&str> = examples().iter().filter(|own| own.urdf().is_none()).map(|own| own.name).collect();
    assert_eq!(refused, ["ball on an arm", "parallelogram", "tethered body", "quadrotor.xml"]);
}
