//! Motions that are refused, and what of a file is left out, with words.

use gauss_jit::{Model, Place};

use crate::{leg, names, robot};

/// All mistakes of a scene: each at the last place of its token on the first line, with a part of its message.
fn refused(source: &str, expected: &[(&str, &str)]) {
    let mistakes = match Model::from_source(source) {
        Ok(_) => panic!("accepted: {source}"),
        Err(mistakes) => mistakes,
    };
    assert_eq!(mistakes.as_slice().len(), expected.len(), "{source}: {mistakes}");
    for (mistake, (token, text)) in mistakes.as_slice().iter().zip(expected) {
        let Place::Text { line, column } = mistake.place else { panic!("{mistake}") };
        let at: String = source.lines().nth(line - 1).unwrap_or_default().chars().skip(column - 1).collect();
        assert!(at.starts_with(token), "{mistake} at {at}");
        assert!(mistake.message.contains(text), "{mistake}");
    }
}

#[test]
fn mistakes_are_told_where_they_are() {
    let scene = |clauses: &str| leg("slide, hip, knee", clauses);
    let cases: [(&str, &[(&str, &str)]); 19] = [
        ("table(way, points = WAY, kind = linear), motion(knee = way(t))", &[("way(t)", "is differentiated")]),
        (
            "motion(knee = 2 * hip)",
            &[(
                "hip",
                "a motion is given beforehand; write it in `t`, fields and numbers, and what \
            holds between coordinates as `constraint(position = …)`",
            )],
        ),
        ("motion(knee = rate(hip))", &[("rate(hip)", "is a velocity")]),
        ("input(u), drive(hip = u), motion(knee = u)", &[("u)", "a motion is given beforehand")]),
        ("motion(knee = thigh.position.x)", &[("thigh", "a motion is given beforehand")]),
        ("motion(nee = t)", &[("nee", "`nee` is no coordinate, and a motion drives one; did you mean `knee`?")]),
        ("motion(knee = t, knee = 2 * t)", &[("knee = 2", "driven twice; keep one of the two")]),
        ("motion(knee = t), lock(knee = 2)", &[("knee = 2", "both locked and driven; keep one of the two")]),
        ("lock(knee = 2), motion(knee = t)", &[("knee = t", "both locked and driven; keep one of the two")]),
        ("motion(knee = [t, 0, 0])", &[("[t", "a motion is a scalar, found a vector")]),
        ("motion(knee = abs(t))", &[("abs", "a motion is differentiated")]),
        ("motion(knee = u), define(u = 2 * knee)", &[("knee)", "name each other")]),
        ("motion(knee = t, hip = t, slide = t)", &[("knee", "all coordinates are driven or locked")]),
        ("motion(knee)", &[("knee", "knee")]),
        ("motion()", &[("(", "")]),
        (
            "motion(knee = t), range(knee, from = 0, to = 1)",
            &[("knee, from", "`knee` is driven, so that no limit keeps it")],
        ),
        ("motion(knee = t), constraint(position = knee - 0.3)", &[("constraint", "names nothing that moves")]),
        (
            "motion(knee = t), dry_friction(rub, slip = rate(knee), bound = 2)",
            &[("rate", "the slip contains no velocity")],
        ),
        (
            "speeds(v, w, u), kinematics(slide = v, hip = w, knee = u + v), motion(slide = t)",
            &[("v, hip", "in the definition of `v`, which the rate of a coordinate uses: `rate(…)` is a velocity")],
        ),
    ];
    for (clauses, expected) in cases {
        refused(&scene(clauses), expected);
    }
    let groups = "#[gauss(coordinates(base: Pose, turn: Rotation, s), motion(base = t, turn = t),
        body(a, pose = base, mass = 1, inertia = 1),
        body(b, parent = a, position = [s, 0, 0], rotation = turn, mass = 1, inertia = 1))] struct B {}";
    refused(
        groups,
        &[
            (
                "base = t",
                "is a pose, and a motion is one number; write the `position` and `rotation` of its body as functions",
            ),
            ("turn = t", "is a rotation, and a motion is one number"),
        ],
    );
}

#[test]
fn joints_that_cannot_be_driven() {
    let of = |clauses: &[&str]| match Model::from_urdf(robot("gripper.urdf"), clauses) {
        Ok(_) => panic!("accepted: {clauses:?}"),
        Err(mistakes) => mistakes.to_string(),
    };
    assert!(
        of(&["motion(right = t)"]).contains("follows the joint `left`, and stands where that one is; drive `left`")
    );
    assert!(of(&["motion(elbw = t)"]).contains("did you mean `elbow`?"), "{}", of(&["motion(elbw = t)"]));
    assert!(of(&["motion(elbow = t)", "lock(elbow = 1)"]).contains("both locked and driven"));
}

/// Limits and the input of a driven joint are left out, whatever is said of them; remarks say so.
#[test]
fn limits_of_driven_joints_are_left_out() {
    let with = ["limits = range", "joint_friction = dry", "gravity = 9.81", "motion(elbow = sin(2 * t))"];
    let model = Model::from_urdf(robot("gripper.urdf"), &with).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let contacts: Vec<&str> = model.contacts().iter().map(|contact| contact.name).collect();
    assert!(!contacts.is_empty() && !contacts.iter().any(|name| name.starts_with("elbow")), "{contacts:?}");
    assert!(!names(&model.description().inputs).iter().any(|name| name == "elbow"));
    let told = "the joint `elbow` is driven by `motion`: it has no coordinate, no speed and no input";
    assert!(model.remarks().iter().any(|remark| remark.contains(told)), "{:?}", model.remarks());
}
