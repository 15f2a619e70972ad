//! Elements between two bodies: what must hold of the second one, of every element that has one.

use super::super::check;
use super::system;
use crate::model::scene::elements::{ArgumentType, ELEMENTS, ElementArgument, Row};

/// A hull with a mast that is hinged on it and a foot that is fixed in it, a quay and a pier at rest.
fn boat(clause: &str) -> String {
    format!(
        "#[gauss(coordinates(pose: Pose, theta), speeds(u: Vector3, w: Vector3, v), kinematics(pose = twist(u, w), theta = v), \
         body(hull, position = pose.position, rotation = pose.rotation), body(mast, parent = hull, rotation = rotation_x(theta)), \
         frame(foot, parent = hull, position = [0, 0, 1]), frame(shoe, parent = foot, rotation = rotation_z(k)), \
         frame(quay), frame(pier, parent = quay, position = [1, 0, 0]), frame(clock, rotation = rotation_z(t)), {clause})] \
         struct Scene {{ #[gauss(body)] hull: RigidBody<f64>, #[gauss(body)] mast: RigidBody<f64>, k: f64, c: Vector3<f64> }}"
    )
}

/// Every element with a second body, all its arguments but the bodies written.
fn each(test: impl Fn(&Row, &str, &dyn Fn(&str, &str) -> String)) {
    let mut count = 0;
    for row in ELEMENTS {
        let Some(other) = row.arguments.iter().find(|argument| argument.takes == ArgumentType::Other) else { continue };
        let rest: Vec<String> = row.arguments.iter().filter_map(written).collect();
        let clause = |body: &str, second: &str| {
            format!("{}(body = {body}, {} = {second}, {})", row.word, other.word, rest.join(", "))
        };
        test(row, other.word, &clause);
        count += 1;
    }
    assert!(count > 0);
}

fn written(argument: &ElementArgument) -> Option<String> {
    let value = match argument.takes {
        ArgumentType::Body | ArgumentType::Other | ArgumentType::Axes => return None,
        ArgumentType::Force
        | ArgumentType::Torque
        | ArgumentType::FlowVelocity
        | ArgumentType::Point
        | ArgumentType::End
        | ArgumentType::Center => "c",
        ArgumentType::Constant { .. } | ArgumentType::Drive | ArgumentType::Dissipation | ArgumentType::Along => "k",
        ArgumentType::Coefficients(_) | ArgumentType::Matrix { .. } => "[1, 2, 3, 4, 5, k]",
    };
    Some(format!("{} = {value}", argument.word))
}

#[test]
fn either_body_may_be_at_rest() {
    each(|row, _, clause| {
        for [body, other] in [["hull", "mast"], ["mast", "quay"], ["quay", "hull"], ["mast", "foot"], ["foot", "clock"]]
        {
            let model = system(&boat(&clause(body, other)));
            assert_eq!(model.forces[0].row.kind, row.kind);
            assert_eq!(model.forces[0].other().unwrap().0, other);
        }
    });
}

#[test]
fn the_second_body_is_another_one() {
    each(|row, _, clause| {
        let noun = row.noun;
        let cancel = format!("the {noun} on `hull` and its reaction on `hull` cancel; name another body");
        check(&boat(&clause("hull", "hull")), &[("hull", cancel.as_str())]);
        for [body, other] in [["hull", "shoe"], ["foot", "hull"], ["shoe", "foot"]] {
            let joined = format!(
                "`{body}` and `{other}` never move relative to each other, so the {noun} does nothing; name another body"
            );
            check(&boat(&clause(body, other)), &[(row.word, joined.as_str())]);
        }
        let idle = format!("neither `quay` nor `pier` moves, so the {noun} does nothing; remove it");
        check(&boat(&clause("quay", "pier")), &[(row.word, idle.as_str())]);
    });
}

#[test]
fn bodies_are_known() {
    each(|row, word, clause| {
        let near = "no body or frame is called `masst`; did you mean `mast`?";
        check(&boat(&clause("hull", "masst")), &[("masst", near)]);
        check(&boat(&clause("masst", "hull")), &[("masst", near)]);
        let misspelt = format!("unknown argument of `{}`: `{word}_`; did you mean `{word}`?", row.word);
        let written = clause("hull", "mast").replace(&format!("{word} ="), &format!("{word}_ ="));
        check(&boat(&written), &[(&format!("{word}_"), misspelt.as_str())]);
    });
}

#[test]
fn couplings() {
    check(
        &boat(
            "coupling(drag, body = hull, viscous = k), coupling(other = mast, viscous = k), coupling(body = hull, other = mast), \
             coupling(body = hull, reaction = mast, viscous = k), coupling(body = hull, other = mast, viscous = theta), \
             coupling(body = hull, other = mast, viscous = c), coupling(body = hull, other = mast, damping = k), \
             torque(body = hull, value = c, other = mast), viscous_coupling(body = hull)",
        ),
        &[
            ("coupling", "a coupling needs the body on which its reaction acts; add `other = …`"),
            ("coupling", "a coupling needs the body that it acts on; add `body = …`"),
            ("coupling", "a coupling needs its torque by relative angular velocity; add `viscous = c`"),
            ("reaction", "unknown argument of `coupling`: `reaction`; write `other`"),
            ("damping", "unknown argument of `coupling`: `damping`; write `viscous`"),
            ("other", "unknown argument of `torque`: `other`; write `reaction`"),
            (
                "viscous_coupling",
                "unknown clause `viscous_coupling`; a viscous coupling of two bodies is `coupling(body = wheel, other = \
                 hull, viscous = c)`",
            ),
            ("theta", "`theta` varies, and the coefficient of a coupling is constant; write numbers and fields only"),
            ("c", "the coefficient of a coupling is a scalar, found a vector; write one number or the name of a field"),
        ],
    );
}

#[test]
fn torsional_springs() {
    check(
        &boat(
            "torsional_spring(body = hull, other = mast), torsional_spring(body = hull, other = mast, k = k), \
             torsional_spring(body = hull, other = mast, stiffness = k, rest_angle = k), \
             torsional_spring(body = hull, other = mast, stiffness = theta, angle = c, damping = t), \
             torsion_spring(along = theta)",
        ),
        &[
            ("torsional_spring", "a torsional spring needs its torque by twist; add `stiffness = k`"),
            ("k", "unknown argument of `torsional_spring`: `k`; write `stiffness`"),
            ("rest_angle", "unknown argument of `torsional_spring`: `rest_angle`; write `angle`"),
            (
                "torsion_spring",
                "unknown clause `torsion_spring`; a torsional spring between two bodies is `torsional_spring(body = arm, \
                 other = hull, stiffness = k)`, about their third axes; along a coordinate `spring(along = angle, \
                 stiffness = k)`",
            ),
            (
                "theta",
                "`theta` varies, and the stiffness of a torsional spring is constant; write numbers and fields only",
            ),
            (
                "c",
                "the angle of a torsional spring is a scalar, found a vector; write one number or the name of a field",
            ),
            ("t", "`t` varies, and the damping of a torsional spring is constant; write numbers and fields only"),
        ],
    );
}

#[test]
fn bushings() {
    check(
        &boat(
            "bushing(body = hull, other = mast), bushing(body = hull, other = mast, stiffness = [1, 2, 3]), \
             bushing(body = hull, other = mast, stiffness = k, damping = kk), bushing(body = hull, stifness = k), \
             bushing(body = hull, other = mast, stiffness = [1, 2, theta, c, 5, v], k = k), bushing(rubber, other = mast, c = k)",
        ),
        &[
            ("bushing", "a bushing needs its coefficients; add `stiffness = …`, `damping = …` or both"),
            (
                "[",
                "the `stiffness` coefficients of a bushing are six, found 3; write six scalars `[a, b, c, d, e, f]` in the \
                 order (u, ω), or the name of a field that is a `Vector6` or a `Matrix6`",
            ),
            ("stifness", "unknown argument of `bushing`: `stifness`; did you mean `stiffness`?"),
            ("bushing", "a bushing needs the body on which its reaction acts; add `other = …`"),
            ("k", "unknown argument of `bushing`: `k`; expected `body`, `other`, `stiffness` or `damping`"),
            ("c", "unknown argument of `bushing`: `c`; write `damping`"),
            ("bushing", "a bushing needs the body that it acts on; add `body = …`"),
            ("theta", "`theta` varies, and the stiffness of a bushing is constant; write numbers and fields only"),
            ("c", "the stiffness of a bushing is a scalar, found a vector; write one number or the name of a field"),
            ("v", "`v` varies, and the stiffness of a bushing is constant; write numbers and fields only"),
            (
                "k",
                "the type of the field `k` is `f64`, and the coefficients of a bushing are six scalars in a list `[a, b, \
                 c, d, e, f]`, a `Vector6<f64>` (diagonal) or a `Matrix6<f64>` (full)",
            ),
            ("kk", "no field is called `kk`; add `kk: Matrix6<f64>`, or write a list of six scalars"),
        ],
    );
}

#[test]
fn units() {
    let source = "#[gauss(coordinates(a, b), body(one, rotation = rotation_z(a), mass = 1, inertia = 1), \
                  body(two, parent = one, rotation = rotation_z(b), mass = 1, inertia = 1), \
                  coupling(body = two, other = one, viscous = k), \
                  torsional_spring(body = two, other = one, stiffness = c, angle = k, damping = k), \
                  bushing(body = two, other = one, stiffness = [k, k, k, 1, 1, k], damping = [c, k, 1, c, 1, 1]))] \
                  struct Scene { #[gauss(unit = \"N/m\")] k: f64, #[gauss(unit = \"N s/m\")] c: f64 }";
    let remedy = |factor: &str| format!("multiply it by a coefficient in {factor}, or correct its unit");
    let k = |what: &str, factor: &str| format!("`k` is in N/m, and the {what}; {}", remedy(factor));
    let c = |what: &str, factor: &str| format!("`c` is in N s/m, and the {what}; {}", remedy(factor));
    check(
        source,
        &[
            ("k", &k("coefficient of a coupling is in N m s", "m^2 s")),
            ("c", &c("stiffness of a torsional spring is in N m", "m^2/s")),
            ("k", &k("angle of a torsional spring is in rad", "s^2/kg")),
            ("k", &k("damping of a torsional spring is in N m s", "m^2 s")),
            ("k", &k("last three stiffness coefficients of a bushing are in N m", "m^2")),
            ("k", &k("first three damping coefficients of a bushing are in N s/m", "s")),
            ("c", &c("last three damping coefficients of a bushing are in N m s", "m^2")),
        ],
    );
}
