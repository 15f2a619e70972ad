//! Coordinates that are locked: what is left of a scene, and what is refused.

use super::super::check;
use super::{show, system};

/// An arm of two links on a slide, with more `clauses` and `fields`.
fn arm(clauses: &str, fields: &str) -> String {
    format!(
        "#[gauss(coordinates(slide, hip, knee), \
           body(thigh, position = [slide, 0, 0], rotation = rotation_y(hip), mass = m, inertia = [1, 1, 1]), \
           body(shank, parent = thigh, position = [0, 0, -l], rotation = rotation_y(knee), mass = m, inertia = [1, 1, 1]), \
           {clauses})] struct Leg {{ m: f64, l: f64, {fields} }}"
    )
}

fn coordinates(source: &str) -> Vec<String> {
    system(source).coordinates.iter().map(|q| q.ident.to_string()).collect()
}

#[test]
fn a_locked_coordinate_is_its_value() {
    let read = system(&arm("lock(knee = bent, slide = -0.25), potential = knee * hip", "bent: f64"));
    let names: Vec<String> = read.coordinates.iter().map(|q| q.ident.to_string()).collect();
    assert_eq!(names, ["hip"]);
    let rotation = |k: usize| read.bodies[k].rotation.as_ref().map(show);
    assert_eq!([rotation(0), rotation(1)].map(Option::unwrap), ["(rotation_y hip)", "(rotation_y bent)"]);
    assert_eq!(read.potential.as_ref().map(show).unwrap(), "(Multiply bent hip)");
    assert!(
        read.bodies[0].position.as_ref().map(show).unwrap().starts_with("[(-1/4)"),
        "{:?}",
        read.bodies[0].position
    );
    // In clauses of their own, with π, and what fields and numbers make.
    assert_eq!(coordinates(&arm("lock(knee = -pi / 2), lock(hip = 2 * bent + 0.1)", "bent: f64")), ["slide"]);
    // Its rate is zero, and may be named all the same.
    assert_eq!(coordinates(&arm("lock(knee = 0), drive(hip = -l * rate(knee))", "")), ["slide", "hip"]);
}

#[test]
fn speeds_go_with_their_coordinates() {
    let scene = |clauses: &str| arm(&format!("speeds(v, w, u), kinematics(slide = v, hip = w, knee = {clauses}"), "");
    let read = system(&scene("u + v), lock(slide = 0.5)"));
    let names: Vec<String> = read.speeds.iter().flatten().map(|z| z.ident.to_string()).collect();
    assert_eq!(names, ["w", "u"]);
    assert_eq!(
        read.kinematics.iter().map(|(q, rate)| format!("{q}: {}", show(rate))).collect::<Vec<_>>(),
        ["hip: w", "knee: (Add u 0)"]
    );
    check(
        &scene("u + v), lock(knee = 0.5)"),
        &[(
            "knee",
            "the rate of `knee` is no speed alone, and a lock leaves that one out; write `knee = v` with a speed `v`, or \
             `constraint(velocity = …)` in place of the lock",
        )],
    );
    check(
        &scene("u), constraint(velocity = u - w), independent(w, v), lock(slide = 0.5)"),
        &[("v", "`v` is zero, since `slide` is locked; remove it here")],
    );
}

#[test]
fn mistakes_of_locks() {
    let clauses = "lock(kne = 0, hip = 0.1, hip = 0.2, turn = 1, slide = 0), \
                   drive(hip = 1), armature(hip = 1), dry_friction(slide, bound = 1)";
    check(
        &arm(clauses, ""),
        &[
            ("kne", "`kne` is no coordinate, and a lock holds one; did you mean `knee`?"),
            ("hip", "`hip` is locked, so that nothing drives it; remove this, or the lock"),
            ("hip", "`hip` is locked, so that nothing turns with it; remove this, or the lock"),
            ("hip", "`hip` is locked twice; keep one of the two"),
            ("turn", "`turn` is no coordinate, and a lock holds one; expected `slide` or `knee`"),
            ("slide", "`slide` is locked, so that nothing brakes it; remove this, or the lock"),
        ],
    );
    check(
        &arm("lock(slide = t, hip = knee)", ""),
        &[
            ("t", "`t` varies, and the value of a lock is constant; write numbers and fields only"),
            ("knee", "`knee` varies, and the value of a lock is constant; write numbers and fields only"),
        ],
    );
    check(
        &arm("lock(slide = 0, hip = 0, knee = 0)", ""),
        &[("slide", "all coordinates are locked, so that nothing moves; leave one of them free")],
    );
    check(
        &arm("lock(slide), lock(hip(1)), lock = 3, lock()", ""),
        &[
            ("slide", "`slide` needs a value; write `slide = 0.5`"),
            ("(", "the value of `hip` follows `=`, without brackets; write `hip = 0.5`"),
            ("3", "`lock` takes brackets, not `=`; write `lock(elbow = 0.5)`"),
            ("(", "`lock()` is empty; write `lock(elbow = 0.5)` or remove it"),
        ],
    );
    check(
        &arm("lock(hip = a)", "a: Vector3<f64>"),
        &[("a", "the value of a lock is a scalar, found a vector; write one number or the name of a field")],
    );
}

/// Clauses about a locked coordinate alone are about nothing that moves, as their own messages say, some at the value.
#[test]
fn clauses_about_locked_coordinates_alone() {
    for (clause, token, told) in [
        ("range(knee, from = 0, to = 1)", "0.3", "the range is that of nothing that moves"),
        ("constraint(position = knee - 0.3)", "constraint", "the constraint names nothing that moves"),
        ("constraint(velocity = rate(knee))", "constraint", "the constraint names nothing that moves"),
        ("spring(along = knee, stiffness = 3)", "spring", "the extent of the spring does not change"),
        ("stop(along = knee, least = 0, stiffness = 3, width = 0.1)", "stop", "the extent of the stop does not change"),
        ("friction(along = knee, viscous = 3)", "friction", "the extent of the friction law does not change"),
        ("contact(x, gap = knee)", "0.3", "the gap names nothing that moves"),
        ("damping = rate(knee) * rate(knee)", "damping", "the dissipation function contains no velocity"),
    ] {
        let source = arm(&format!("lock(knee = 0.3), {clause}"), "");
        let error = super::super::read(&source).err().expect(clause);
        let found: Vec<String> = error.clone().into_iter().map(|mistake| mistake.to_string()).collect();
        let [one] = found.as_slice() else { panic!("{clause}: {found:?}") };
        assert!(one.starts_with(told), "{clause}: {one}");
        assert_eq!(error.span().source_text().as_deref(), Some(token), "{clause}");
    }
    // A potential of it alone is a constant, as any other.
    assert_eq!(coordinates(&arm("lock(knee = 0.3), potential = knee * knee", "")), ["slide", "hip"]);
}

#[test]
fn rotations_poses_and_modes_are_not_locked() {
    let scene = "#[gauss(coordinates(x, ball: Rotation, base: Pose), particle(mass = 1, position = [x, 0, 0]), \
                 body(b, rotation = ball, mass = 1, inertia = [1, 1, 1]), body(c, pose = base, mass = 1, inertia = [1, 1, 1]), \
                 lock(ball = 0, base = 1))] struct Scene {}";
    check(
        scene,
        &[
            (
                "ball",
                "`ball` is a rotation, and a lock is one number; write a constant `rotation` of its body, or make the \
                 joint of the file a fixed one",
            ),
            (
                "base",
                "`base` is a pose, and a lock is one number; write a constant `position` and `rotation` of its body, or \
                 `base = fixed` of a file",
            ),
        ],
    );
    let of_chart =
        "#[gauss(motion = planar, lock(x = 0))] struct Body { #[gauss(mass)] m: f64, #[gauss(inertia)] j: f64 }";
    check(of_chart, &[("x", "`x` is no coordinate, and a lock holds one; there is none with a name and one number")]);
}

/// The value of a lock is not made of the lock: advice that leads there would lead into a circle. So is that of every
/// definition.
#[test]
fn advice_for_unknown_names_leads_to_no_circle() {
    let value = |value: &str, message: &str| {
        check(&arm(&format!("define(bend = 0.5), lock(knee = {value})"), ""), &[(value, message)]);
    };
    value("q", "unknown name `q`; expected a definition (`bend`) or a field (`m` or `l`)");
    value("knees", "unknown name `knees`; expected a definition (`bend`) or a field (`m` or `l`)");
    value("bends", "unknown name `bends`; did you mean the definition `bend`?");
    let alone = "#[gauss(coordinates(x, y), particle(position = [x, y, 0], mass = 1), CLAUSE)] struct Dot {}";
    for (clause, token, message) in [
        ("lock(y = q)", "q", "unknown name `q`; expected a number or the name of a field"),
        ("lock(y = Y)", "Y", "unknown name `Y`; expected a number or the name of a field"),
        ("motion(y = q)", "q", "unknown name `q`; expected `t`"),
        ("lock(q = 1)", "q", "`q` is no coordinate, and a lock holds one; expected `x` or `y`"),
        (
            "define(w = q)",
            "q",
            "unknown name `q`; declare it by `input(q)` if it arrives at run time, or write a coordinate (`x` or `y`) or \
             `t`",
        ),
    ] {
        check(&alone.replace("CLAUSE", clause), &[(token, message)]);
    }
}
