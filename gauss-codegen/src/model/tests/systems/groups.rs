//! Coordinates that are poses and rotations, speeds that are vectors, and their kinematics.

use super::super::check;
use super::{show, system};
use crate::model::{CoordinateKind, SpeedKind};

/// The only body at a pose, with other clauses of motion.
fn body(clauses: &str) -> String {
    format!(
        "#[gauss({clauses}, body(position = pose.position, rotation = pose.rotation))] \
         struct Scene {{ #[gauss(mass)] m: f64, #[gauss(inertia)] j: f64 }}"
    )
}

#[test]
fn accepted() {
    let model = system(
        "#[gauss(coordinates(x, pose: Pose, attitude: Rotation), speeds(v, u: Vector3, w: Vector3, z: Vector3), \
         kinematics(attitude = [z.x, z[1], v], pose = twist(u - 2 * w, inverse(pose.rotation) * w), x = v + z.z), \
         body(a, position = pose.position, rotation = pose.rotation * attitude), \
         particle(mass = 1, position = attitude * [x, 0, 0]), potential = atan2(x, pose.position.z))] \
         struct Scene { #[gauss(body)] a: RigidBody<f64> }",
    );
    let coordinates: Vec<_> = model.coordinates.iter().map(|q| (q.ident.to_string(), q.kind)).collect();
    assert_eq!(
        coordinates,
        [
            ("x".into(), CoordinateKind::Scalar),
            ("pose".into(), CoordinateKind::Pose),
            ("attitude".into(), CoordinateKind::Rotation)
        ]
    );
    let speeds: Vec<_> = model.speeds.iter().flatten().map(|z| (z.ident.to_string(), z.kind)).collect();
    assert_eq!(speeds[0], ("v".into(), SpeedKind::Scalar));
    assert_eq!(speeds[1], ("u".into(), SpeedKind::Vector));
    let kinematics: Vec<_> = model.kinematics.iter().map(|(name, rate)| format!("{name} = {}", show(rate))).collect();
    assert_eq!(
        kinematics,
        [
            "x = (Add v z[2])",
            "pose = (twist (Subtract u (Multiply 2 w)) (Multiply (inverse pose.Rotation) w))",
            "attitude = [z[0] z[1] v]"
        ]
    );
    assert_eq!(model.potential.as_ref().map(show).as_deref(), Some("(atan2 x pose.Position[2])"));
    // Method syntax, and the jet chart.
    let model = system(
        "#[gauss(coordinates(r: Rotation, y), body(rotation = r.inverse(), position = [y, 0, 0]), \
         potential = y.atan2(2))] struct Scene { #[gauss(mass)] m: f64, #[gauss(inertia)] j: f64 }",
    );
    assert!(model.speeds.is_none());
    assert_eq!(model.bodies[0].rotation.as_ref().map(show).as_deref(), Some("(inverse r)"));
    assert_eq!(model.potential.as_ref().map(show).as_deref(), Some("(atan2 y 2)"));
}

#[test]
fn kinds_of_declarations() {
    check(
        &body("coordinates(pose: Pos, a: Rotaton, b: Quaternion, c: f64, d: Vector3, e: gauss::Rotation, f:)"),
        &[
            ("Pos", "unknown kind of coordinate `Pos`; did you mean `Pose`?"),
            ("Rotaton", "unknown kind of coordinate `Rotaton`; did you mean `Rotation`?"),
            ("Quaternion", "unknown kind of coordinate `Quaternion`; a rotation is `b: Rotation`"),
            (":", "a scalar coordinate has no type; write `c`"),
            (
                "Vector3",
                "unknown kind of coordinate `Vector3`; expected `Pose` or `Rotation`, or `d` alone for a scalar",
            ),
            ("gauss", "`gauss::Rotation` is written as one word; write `e: Rotation`"),
            (":", "nothing follows `f:`; expected `Pose` or `Rotation`, or `f` alone for a scalar"),
        ],
    );
    check(
        &body(
            "coordinates(pose: Pose), speeds(u: Vector3<f64>, w: Vector, p: Pose, s: f64), \
             kinematics(pose = twist(u, w))",
        ),
        &[
            ("Vector3", "`Vector3<f64>` is written as one word; write `u: Vector3`"),
            ("Vector", "unknown kind of speed `Vector`; did you mean `Vector3`?"),
            ("Pose", "unknown kind of speed `Pose`; expected `Vector3`, or `p` alone for a scalar"),
            (":", "a scalar speed has no type; write `s`"),
        ],
    );
}

#[test]
fn kinematics() {
    let speeds = "coordinates(pose: Pose), speeds(u: Vector3, w: Vector3)";
    let twist = "a pose changes by `twist(linear, angular)`, two vectors in body axes";
    let remedy = "write `twist(u, w)` with speeds `u: Vector3, w: Vector3`";
    check(&body(&format!("{speeds}, kinematics(pose = u)")), &[("u", &format!("{twist}, found a vector; {remedy}"))]);
    check(&body(&format!("{speeds}, kinematics(pose = u.x)")), &[("x", &format!("{twist}, found a scalar; {remedy}"))]);
    check(
        &body(&format!("{speeds}, kinematics(pose = 2 * twist(u, w.x))")),
        &[
            ("x", "`twist` takes a vector, found a scalar"),
            (
                "twist",
                "a twist is no part of another expression; write `pose = twist(linear, angular)` in `kinematics(…)`",
            ),
        ],
    );
    check(
        &body(
            "coordinates(pose: Pose, r: Rotation, x), speeds(u: Vector3, w: Vector3, v: Vector3), \
             kinematics(pose = twist(u, w), r = u.x, x = twist(v, r))",
        ),
        &[
            (
                "x",
                "a rotation changes by its angular velocity, a vector in body axes, found a scalar; \
                 write `[w1, w2, w3]`, or the name of a speed `w: Vector3`",
            ),
            ("r", "`twist` takes a vector, found a rotation"),
            (
                "twist",
                "the rate of a coordinate is a scalar, found a twist; write one number, such as `v * cos(theta)`",
            ),
        ],
    );
    check(
        &body("coordinates(pose: Pose, r: Rotation), speeds(u: Vector3, w: Vector3)"),
        &[("speeds", "`speeds` do not say how the coordinates change; add `kinematics(pose = twist(…, …), r = …)`")],
    );
    check(
        &body("coordinates(pose: Pose, r: Rotation), speeds(u: Vector3, w: Vector3), kinematics(r = u + w)"),
        &[("pose", "the coordinate `pose` has no kinematics; add `pose = twist(…, …)` to `kinematics(…)`")],
    );
    check(
        &body(&format!("{speeds}, kinematics(pose = twist(pose, w), potential = pose.x)")),
        &[
            ("potential", "`potential` is no coordinate; expected `pose`"),
            ("pose", "`pose` is a pose; write `pose.position` or `pose.rotation`"),
            ("pose", "`pose` is a pose; write `pose.position` or `pose.rotation`"),
        ],
    );
}

#[test]
fn dependence() {
    check(
        &body("coordinates(pose: Pose, r: Rotation)"),
        &[(
            "r",
            "no position and no rotation depends on the coordinate `r`, so nothing determines its acceleration; \
             name it in one of them, give it an `armature`, or remove it",
        )],
    );
    check(
        &body("coordinates(pose: Pose), speeds(u: Vector3, w: Vector3, v, s: Vector3), kinematics(pose = twist(u, w))"),
        &[
            (
                "v",
                "no velocity depends on the speed `v`, so nothing determines its rate; \
                 name it in `kinematics(…)` or remove it",
            ),
            (
                "s",
                "no velocity depends on the speed `s`, so nothing determines its rate; \
                 name it in `kinematics(…)` or remove it",
            ),
            (
                "v",
                "there are more speeds (10) than degrees of freedom of the coordinates (6), so the velocities do not \
                 determine them; remove 4",
            ),
        ],
    );
    // A part that is named is enough.
    system(&body("coordinates(pose: Pose), speeds(u: Vector3, w), kinematics(pose = twist([u.x, 0, 0], [0, 0, w]))"));
}
