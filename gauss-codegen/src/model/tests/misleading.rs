//! Scenes as people write them at first: the message leads to what is meant, and is the only one.

use super::read;

/// A ball joint on a hinge, with an input that is a wrench.
fn arm(clause: &str) -> String {
    format!(
        "#[gauss(coordinates(a, turn: Rotation), body(hull, rotation = rotation_z(a), mass = 1, inertia = 1), \
         body(arm, parent = hull, rotation = turn, mass = 1, inertia = 1), input(push: Wrench), \
         wrench(body = arm, torque = push.torque), {clause})] struct Scene {{ k: f64, v: Vector3<f64> }}"
    )
}

#[track_caller]
fn only(source: &str, expected: &str) {
    let told: Vec<String> = match read(source) {
        Ok(_) => panic!("accepted: {source}"),
        Err(error) => error.into_iter().map(|mistake| mistake.to_string()).collect(),
    };
    assert_eq!(told, [expected], "{source}");
}

#[test]
fn what_is_held() {
    for clause in ["freeze(joint = a)", "locked(a = 0.3)"] {
        let word = clause.split('(').next().unwrap();
        let held = format!(
            "unknown clause `{word}`; a coordinate that never moves is left out by `lock(angle = a)`; with the force that \
             holds it, it is `motion(angle = a)`"
        );
        only(&arm(clause), &held);
    }
}

/// A rotation is no number: what acts in its place.
#[test]
fn limits_and_laws_of_rotations() {
    let range = "what stays in a range is a scalar, found a rotation; how far it may turn from an axis is a gap: \
                 `contact(limit, gap = dot(turn * [0, 0, 1], [0, 0, 1]) - cos(a))`";
    only(&arm("range(turn, to = 1)"), range);
    let friction = "the extent of a friction law is a scalar, found a rotation; what brakes a turn is `damping = c * \
                    dot(turn.body_angular_velocity, turn.body_angular_velocity) / 2`";
    only(&arm("friction(along = turn, viscous = k)"), friction);
    for (clause, noun) in [
        ("stop(along = turn, most = 1, stiffness = k, width = k)", "a stop"),
        ("spring(along = turn, stiffness = k)", "a spring"),
    ] {
        let extent = format!(
            "the extent of {noun} is a scalar, found a rotation; how far it may turn from an axis is the cosine `along = \
             dot(turn * [0, 0, 1], [0, 0, 1])`"
        );
        only(&arm(clause), &extent);
    }
    let told =
        "`turn` is a rotation, and its angular velocity is driven by a torque; write `torque(body = …, value = …)`";
    only(&arm("drive(turn = k)"), told);
    // What is told is a scene.
    for clause in [
        "contact(limit, gap = dot(turn * [0, 0, 1], [0, 0, 1]) - cos(0.3))",
        "damping = k * dot(turn.body_angular_velocity, turn.body_angular_velocity) / 2",
        "stop(along = dot(turn * [0, 0, 1], [0, 0, 1]), least = 0.5, stiffness = k, width = k)",
    ] {
        assert!(read(&arm(clause)).is_ok(), "{clause}");
    }
}

#[test]
fn wrenches_for_forces_and_torques() {
    let wrench = "`push` is a wrench, which is two vectors; write `push.force` or `push.torque`";
    only(&arm("torque(body = arm, value = push, reaction = hull)"), wrench);
    only(&arm("force(body = arm, at = v, value = push)"), wrench);
    let six = "a vector has three components, found 6; six of a wrench are two vectors, `wrench(body = …, force = [fx, fy, \
               fz], torque = [mx, my, mz])`";
    only(&arm("torque(body = arm, value = [0, 0, 0, 0, 0, 1])"), six);
    let value = "the components of a torque are its value; write `value = [mx, my, mz]`";
    only(&arm("torque(body = arm, torque = v)"), value);
    let both = "a force with a torque is a wrench, `wrench(body = …, force = […], torque = […])`; a reaction has the torque \
                alone, `torque(body = …, value = […], reaction = …)`";
    only(&arm("torque(body = arm, force = v, reaction = hull)"), both);
    let both = "a force with a torque is a wrench; write `wrench(body = …, at = …, force = […], torque = […])`";
    only(&arm("force(body = arm, at = v, torque = v)"), both);
    let other = "a force acts on one body; the other side is a `force(…)` of its own at the same point, with the opposite value";
    only(&arm("force(body = arm, at = v, value = v, reaction = hull)"), other);
    let parts = "a wrench has two parts; write `force = […], torque = […]`, of an input `push.force` and `push.torque`";
    only(&arm("wrench(body = arm, value = push)"), parts);
    only(&arm("wrench(push, body = arm, wrench = push)"), parts);
}

#[test]
fn quaternions() {
    let of = |coordinates: &str, rotation: &str| {
        format!(
            "#[gauss(coordinates({coordinates}), body(arm, rotation = {rotation}, mass = 1, inertia = 1))] struct Scene {{}}"
        )
    };
    let four = "a vector has three components, found 4; a rotation by a quaternion is one coordinate, `coordinates(turn: \
                Rotation)` with `rotation = turn`";
    only(&of("q0, q1, q2, q3", "[q0, q1, q2, q3]"), four);
    for function in ["quaternion", "rotation", "rotation_quaternion"] {
        let told = format!(
            "unknown function `{function}`; a rotation by a quaternion, or by a vector, is one coordinate: \
             `coordinates(turn: Rotation)` with `rotation = turn`; turns by angles are `rotation_x(a)`, `rotation_y(b)` and \
             `rotation_z(c)`"
        );
        only(&of("w, x, y, z", &format!("{function}(w, x, y, z)")), &told);
    }
    for kind in ["Quaternion", "UnitQuaternion"] {
        only(
            &of(&format!("q: {kind}"), "q"),
            &format!("unknown kind of coordinate `{kind}`; a rotation is `q: Rotation`"),
        );
    }
}

#[test]
fn slips_of_points_and_structs_without_fields() {
    let slip = "the slip of a point follows from its motion; remove `slip`, or write the gap in place of `point` as well: \
                `gap = …, slip = …`";
    only(&arm("point(tip, body = arm, at = v), contact(tip, point = tip, slip = a, friction = k)"), slip);
    let unit = "`GaussDynamics` is derived for structs with named fields, and `Scene` is a unit struct; write `struct Scene {}`";
    let scene = "#[gauss(coordinates(a), body(arm, rotation = rotation_z(a), mass = 1, inertia = 1))] struct Scene;";
    only(scene, unit);
}

#[test]
fn inertias_that_are_misread_are_not_missing_too() {
    let scene = |inertia: &str| {
        format!(
            "#[gauss(coordinates(a), body(arm, rotation = rotation_z(a), mass = 1, inertia = {inertia}))] struct Scene {{}}"
        )
    };
    only(&scene("[.4, 0.4, 0.4]"), "a number begins with a digit; write `0.4` in place of `.4`");
    let told = "NumPy prints its numbers as `np.float64(…)`; write those of Python: `{float(x)}`, `{x.tolist()}`";
    only(&scene("np.float64(0.1)"), told);
}
