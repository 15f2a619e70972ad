//! Wrenches, drags, stops and springs along a scalar, the medium and central gravity.

use super::super::{Mistake, check};
use super::{show, shown, system};
use crate::model::argument::{CENTER, MU};
use crate::terms::InputKind;

/// A boat with a mast that is hinged on it, with more `clauses`.
fn boat(clauses: &str) -> String {
    format!(
        "#[gauss(coordinates(pose: Pose, theta), speeds(u: Vector3, w: Vector3, v), kinematics(pose = twist(u, w), theta = v), \
         body(hull, position = pose.position, rotation = pose.rotation), body(mast, parent = hull, rotation = rotation_x(theta)), \
         frame(quay), point(top, body = mast, at = [0, 0, l]), {clauses})] \
         struct Scene {{ #[gauss(body)] hull: RigidBody<f64>, #[gauss(body)] mast: RigidBody<f64>, l: f64, k: f64, \
         c: Vector3<f64>, d: Matrix6<f64>, e: Vector6<f64>, i: Matrix3<f64>, alias: Damping }}"
    )
}

#[track_caller]
fn mistakes(clauses: &str, expected: &[Mistake<'_>]) {
    check(&boat(clauses), expected);
}

#[test]
fn accepted() {
    let model = system(&boat(
        "input(gust: Wrench, rudder), medium(velocity = k * sin(t) * c), central_gravity(mu = k), \
         central_gravity(sun, mu = 2 * k, center = [l * cos(t), 0, 0]), \
         wrench(sail, body = mast, at = top, force = gust.force, torque = gust.torque, axes = observer), \
         wrench(body = hull, torque = cross(hull.body_velocity, hull.body_angular_velocity)), \
         wrench(body = hull, at = c, force = [rudder * hull.relative_velocity.x, 0, signum(mast.relative_velocity.y)]), \
         drag(water, body = hull, linear = d, quadratic = [abs(u.x), 2, 3, clamp(k, 0, 1), 5, smooth_step(k, 0, 1)]), \
         drag(body = mast, quadratic = e), \
         spring(hinge, along = theta, stiffness = k, damping = 1), spring(along = top.z, stiffness = k, length = l), \
         stop(along = theta, least = -1, most = 1, stiffness = k, width = 0.1, damping = l), \
         stop(shroud, from = top, to = quay.position, most = l, stiffness = 1, width = l)",
    ));
    let inputs: Vec<_> = model.item.inputs.iter().map(|input| (input.ident.to_string(), input.kind)).collect();
    assert_eq!(inputs, [("gust".into(), InputKind::Wrench), ("rudder".into(), InputKind::Scalar)]);
    assert_eq!(model.medium.as_ref().map(show), Some("(Multiply (Multiply k (sin t)) c)".into()));
    let attractions = model.attractions.iter().map(|a| {
        let name = a.name.as_ref().map(ToString::to_string);
        (name, a.expression(MU).map(show), a.expression(CENTER).map(show))
    });
    assert_eq!(
        attractions.collect::<Vec<_>>(),
        [
            (None, Some("k".into()), None),
            (Some("sun".into()), Some("(Multiply 2 k)".into()), Some("[(Multiply l (cos t)) 0 0]".into())),
        ]
    );
    assert_eq!(
        model.forces.iter().map(shown).collect::<Vec<_>>(),
        [
            "wrench sail: body mast, at [0 0 l], force gust.Force, torque gust.Torque, axes observer",
            "wrench -: body hull, torque (cross hull.BodyVelocity hull.BodyAngularVelocity)",
            "wrench -: body hull, at c, force [(Multiply rudder hull.RelativeVelocity[0]) 0 (signum \
             mast.RelativeVelocity[1])]",
            "drag water: body hull, linear d, quadratic [(abs u[0]) 2 3 (clamp k 0 1) 5 (smooth_step k 0 1)]",
            "drag -: body mast, quadratic e",
            "spring hinge: along theta, stiffness k, damping 1",
            "spring -: along top[2], stiffness k, length l",
            "stop -: along theta, least (-1), most 1, stiffness k, width 1/10, damping l",
            "stop shroud: from top, to quay.Position, most l, stiffness 1, width l",
        ]
    );
}

#[test]
fn friction_and_armatures() {
    let model = system(&boat(
        "friction(hinge, along = theta, viscous = k, dry = 2 * l, width = 0.1), \
         friction(from = top, to = quay.position, dry = 1, width = k), friction(along = theta, viscous = 1), \
         armature(theta = 2 * k)",
    ));
    assert_eq!(
        model.forces.iter().map(shown).collect::<Vec<_>>(),
        [
            "friction hinge: along theta, viscous k, dry (Multiply 2 l), width 1/10",
            "friction -: from top, to quay.Position, dry 1, width k",
            "friction -: along theta, viscous 1"
        ]
    );
    let armatures: Vec<_> = model.armatures.iter().map(|(q, a)| (q.to_string(), show(a))).collect();
    assert_eq!(armatures, [("theta".into(), "(Multiply 2 k)".into())]);
    mistakes(
        "friction(along = theta), friction(viscous = k), friction(along = theta, dry = k), \
         friction(along = theta, viscous = k, width = l), friction(along = c, viscous = v, dry = top, width = k), \
         armature(theta = k, theta = 1), armature(pose = k), armature(thta = k), armature(theta = v), armature(v = k)",
        &[
            ("friction", "a friction law needs a coefficient; add `viscous = …`, `dry = …` with `width = …` or both"),
            (
                "friction",
                "a friction law needs its extent; add `from = …` and `to = …`, two points, or `along = …`, a scalar",
            ),
            ("friction", "a friction law needs the speed over which the dry part sets in smoothly; add `width = w`"),
            ("width", "the width is that of dry friction; add `dry = …`, or remove `width`"),
            ("v", "`v` varies, and the inertia of an armature is constant; write numbers and fields only"),
            (
                "c",
                "the extent of a friction law is a scalar, found a vector; write one number such as an angle, or \
                 `from = …` and `to = …` for the distance of two points",
            ),
            ("v", "`v` varies, and the viscous part of a friction law is constant; write numbers and fields only"),
            ("top", "`top` varies, and the dry part of a friction law is constant; write numbers and fields only"),
            ("theta", "`theta` is given an armature twice; write the sum of the two"),
            (
                "thta",
                "`thta` is no coordinate, and an armature turns with the rates of coordinates; did you mean `theta`?",
            ),
            ("theta", "`theta` is given an armature twice; write the sum of the two"),
            (
                "v",
                "`v` is a speed, not a coordinate, and an armature turns with the rates of coordinates; expected `pose` or \
                 `theta`",
            ),
        ],
    );
}

#[test]
fn wrenches() {
    mistakes(
        "wrench(body = hull), wrench(force = c), wrench(body = hull, at = c, torque = c), wrench(body = hul, force = k), \
         wrench(pull, body = hull, forse = c), wrench(body = hull, at = pose.position, force = c, value = c), \
         wrench(body = quay, force = c), input(gust: Wrench), force(at = top, value = gust), \
         torque(body = hull, value = gust.moment), drive(theta = gust.position.x + hull.force.x + rate(gust.force).x)",
        &[
            ("wrench", "a wrench needs its components; add `force = [fx, fy, fz]`, `torque = [mx, my, mz]` or both"),
            ("wrench", "a wrench needs the body that it acts on; add `body = …`"),
            (
                "at",
                "a torque has no point: it does the same wherever it acts on its body; add `force = …`, or remove \
                 `at`",
            ),
            ("forse", "unknown argument of `wrench`: `forse`; did you mean `force`?"),
            (
                "value",
                "a wrench has two parts; write `force = […], torque = […]`, of an input `push.force` and `push.torque`",
            ),
            (
                "moment",
                "there is no `.moment`; the components of a vector are `.x`, `.y` and `.z`, bodies have \
                 `.position`, `.rotation`, `.velocity`, `.angular_velocity`, `.body_velocity`, \
                 `.body_angular_velocity` and `.relative_velocity`, and inputs that are wrenches have `.force` and \
                 `.torque`",
            ),
            ("hul", "no body or frame is called `hul`; did you mean `hull`?"),
            ("k", "a force is a vector, found a scalar; write `[fx, fy, fz]`"),
            (
                "pose",
                "`pose` varies, and the place where this acts is fixed in its body; write numbers and fields only",
            ),
            ("gust", "`gust` is a wrench, which is two vectors; write `gust.force` or `gust.torque`"),
            ("position", "`gust` is a wrench and has no `.position`; it has `.force` and `.torque`"),
            ("force", "`hull` is a body and has no `.force`; inputs that are wrenches have: `input(name: Wrench)`"),
            (
                "force",
                "`gust` is an input, whose rate is never known; take it out of `rate(…)`, and declare an input for \
                 its rate if that is known",
            ),
        ],
    );
    mistakes(
        "wrench(body = quay, force = c)",
        &[("wrench", "`quay` does not move, so the wrench does nothing; name a body that moves")],
    );
}

#[test]
fn drags() {
    mistakes(
        "drag(body = hull), drag(linear = d), drag(body = hull, linear = [1, 2, 3]), drag(body = hull, linear = i), \
         drag(body = hull, quadratic = alias), drag(body = hull, linear = dd), drag(body = hull, linear = theta), \
         drag(body = hull, linear = k), drag(body = hull, linear = 2 * d), drag(body = hull, linear = 3), \
         drag(body = hull, quadratc = d), drag(body = hull, linear = [c, 0, 0, 0, 0, x]), drag(body = hull, linear(d))",
        &[
            ("drag", "a drag needs its coefficients; add `linear = …`, `quadratic = …` or both"),
            ("drag", "a drag needs the body that it acts on; add `body = …`"),
            (
                "[",
                "the `linear` coefficients of a drag are six, found 3; write six scalars `[a, b, c, d, e, f]` in \
                 the order (u, ω), or the name of a field that is a `Vector6` or a `Matrix6`",
            ),
            (
                "2",
                "the `linear` coefficients of a drag are six, one for each component; write six scalars `[a, b, c, \
                 d, e, f]` in the order (u, ω), or the name of a field that is a `Vector6` or a `Matrix6`",
            ),
            (
                "3",
                "the `linear` coefficients of a drag are six, one for each component; write six scalars `[a, b, c, \
                 d, e, f]` in the order (u, ω), or the name of a field that is a `Vector6` or a `Matrix6`",
            ),
            ("quadratc", "unknown argument of `drag`: `quadratc`; did you mean `quadratic`?"),
            ("(", "the value of `linear` follows `=`, without brackets; write `linear = [a, b, c, d, e, f]`"),
            ("c", "a coefficient of a drag is a scalar, found a vector; write one number"),
            (
                "x",
                "unknown name `x`; declare it by `input(x)` if it arrives at run time, or write a coordinate \
                 (`pose` or `theta`), a speed (`u`, `w` or `v`), a field (`l`, `k` or `c`), a body (`hull` or \
                 `mast`), a frame (`quay`), a point (`top`) or `t`",
            ),
            (
                "i",
                "the type of the field `i` is `Matrix3`, and the coefficients of a drag are six scalars in a list \
                 `[a, b, c, d, e, f]`, a `Vector6<f64>` (diagonal) or a `Matrix6<f64>` (full)",
            ),
            (
                "alias",
                "the kind of the field `alias` cannot be read from `Damping`; write `Vector6<f64>` or `Matrix6<f64>` \
                 for its type",
            ),
            ("dd", "no field is called `dd`; did you mean `d`?"),
            (
                "theta",
                "`theta` is a scalar, and the coefficients of a drag are six scalars in a list `[a, b, c, d, e, \
                 f]`, a `Vector6<f64>` (diagonal) or a `Matrix6<f64>` (full)",
            ),
            (
                "k",
                "the type of the field `k` is `f64`, and the coefficients of a drag are six scalars in a list `[a, \
                 b, c, d, e, f]`, a `Vector6<f64>` (diagonal) or a `Matrix6<f64>` (full)",
            ),
        ],
    );
    mistakes(
        "drag(body = quay, linear = d)",
        &[("drag", "`quay` does not move, so the drag does nothing; name a body that moves")],
    );
    mistakes(
        "force(at = top, value = d * c)",
        &[(
            "d",
            "the type of the field `d` is `Matrix6`, and expressions name scalars and vectors only: `f64` or \
                 `Vector3<f64>`",
        )],
    );
    check(
        "#[gauss(drag(linear = d))] struct Body { #[gauss(mass)] m: f64, #[gauss(inertia)] j: f64, d: Vector6<f32> }",
        &[(
            "f32",
            "the scalar of `d` is `f32`, but that of `m` is `f64`; one scalar serves the whole body: write `f64`",
        )],
    );
}

#[test]
fn stops_and_springs() {
    mistakes(
        "stop(along = theta, stiffness = k, width = l), stop(from = top, to = [0, 0, 0], least = 1, stiffness = k), \
         stop(along = theta, from = top, least = 1, width = l), stop(least = 1, stiffness = k, width = l), \
         stop(along = c, least = theta, most = t, stiffness = c, width = v, damping = x), \
         stop(alon = theta, most = 1, stiffness = k, width = l), spring(along = v, stiffness = k), \
         spring(along = abs(theta), stiffness = k), spring(to = top, stiffness = k), stop(from = theta, to = top, least = 0, \
         stiffness = k, width = l)",
        &[
            ("stop", "a stop needs a limit; add `least = …`, `most = …` or both"),
            ("stop", "a stop needs the distance over which it sets in smoothly; add `width = e`"),
            ("from", "`along` already gives the coordinate of the stop; remove it, or remove `from`"),
            ("stop", "a stop needs its force by distance beyond the limit; add `stiffness = k`"),
            ("stop", "a stop needs its extent; add `from = …` and `to = …`, two points, or `along = …`, a scalar"),
            ("alon", "unknown argument of `stop`: `alon`; did you mean `along`?"),
            ("spring", "a spring needs the point where it begins; add `from = …`"),
            (
                "c",
                "the extent of a stop is a scalar, found a vector; write one number such as an angle, or `from = \
                 …` and `to = …` for the distance of two points",
            ),
            ("theta", "`theta` varies, and the lower limit of a stop is constant; write numbers and fields only"),
            ("t", "`t` varies, and the upper limit of a stop is constant; write numbers and fields only"),
            ("c", "the stiffness of a stop is a scalar, found a vector; write one number or the name of a field"),
            ("v", "`v` varies, and the width of a stop is constant; write numbers and fields only"),
            ("x", "unknown name `x`; expected a field (`l`, `k` or `c`)"),
            (
                "v",
                "`v` is a speed, and the extent of a spring depends on coordinates, fields and `t` only; speeds \
                 stand in values of forces",
            ),
            (
                "abs",
                "the derivative of `abs` jumps, and the extent of a spring is differentiated; only values of forces \
                 can contain it",
            ),
            (
                "theta",
                "the end of a stop is a vector, found a scalar; write the name of a point, `arm.position` or `[x, \
                 y, z]`",
            ),
        ],
    );
    mistakes(
        "spring(along = k, stiffness = k), stop(along = quay.position.x, most = l, stiffness = k, width = l)",
        &[
            (
                "spring",
                "the extent of the spring does not change: it names no coordinate, and no body or point that moves",
            ),
            ("stop", "the extent of the stop does not change: it names no coordinate, and no body or point that moves"),
        ],
    );
}

#[test]
fn limits_in_numbers() {
    mistakes(
        "stop(along = theta, least = 1, most = -1, stiffness = k, width = 0), \
         drive(theta = clamp(theta, 2, 1.5) + smooth_step(theta, 0.5, 0.5) + smooth_step(theta, 1, 0))",
        &[
            ("2", "the lower limit is above the upper limit; exchange the two"),
            ("0.5", "a smooth step has two ends; write different numbers"),
            ("1", "the lower limit of a stop is below its upper limit; exchange the two"),
            ("0", "the width of a stop is the distance over which it sets in; write a positive number"),
        ],
    );
}

#[test]
fn media() {
    mistakes(
        "input(wind), medium(velocity = [wind, 0, 0]), drag(body = hull, linear = d)",
        &[(
            "wind",
            "`wind` is an input, whose rate is never known, and bodies feel the rate of the velocity of the \
                 medium by their added mass; write it in `t`, fields and numbers",
        )],
    );
    mistakes(
        "medium(velocity = [theta + v, hull.position.x, top.y]), medium(velocity = k), medium(speed = c), medium(), medium, \
         drag(body = hull, linear = d)",
        &[
            ("medium", "`medium` is given twice; keep one of the two"),
            ("medium", "`medium` is given twice; keep one of the two"),
            ("speed", "unknown argument of `medium`: `speed`; write `velocity`"),
            ("medium", "`medium` is given twice; keep one of the two"),
            ("(", "`medium()` is empty; write `medium(velocity = [cx, cy, cz])` or remove it"),
            ("medium", "`medium` is given twice; keep one of the two"),
            ("medium", "`medium` is empty; write `medium(velocity = [cx, cy, cz])`"),
            (
                "theta",
                "`theta` moves with the system, and there is no added mass in a stream that varies with the place; \
                 write the velocity of the medium in `t`, fields and numbers, and the drag in any other stream as \
                 `force(…)`",
            ),
            (
                "v",
                "`v` moves with the system, and there is no added mass in a stream that varies with the place; \
                 write the velocity of the medium in `t`, fields and numbers, and the drag in any other stream as \
                 `force(…)`",
            ),
            (
                "hull",
                "`hull` moves with the system, and there is no added mass in a stream that varies with the place; \
                 write the velocity of the medium in `t`, fields and numbers, and the drag in any other stream as \
                 `force(…)`",
            ),
            (
                "top",
                "`top` moves with the system, and there is no added mass in a stream that varies with the place; \
                 write the velocity of the medium in `t`, fields and numbers, and the drag in any other stream as \
                 `force(…)`",
            ),
        ],
    );
    mistakes(
        "medium(velocity = [abs(t), 0, 0]), drag(body = hull, linear = d)",
        &[(
            "abs",
            "the derivative of `abs` jumps, and the velocity of the medium is differentiated; only values of \
                 forces can contain it",
        )],
    );
    mistakes(
        "medium(velocity = c), force(at = top, value = c)",
        &[(
            "medium",
            "nothing in the scene feels the medium; add `drag(…)`, name `.relative_velocity` of a body in a \
                 force, give the body a field with the role `added_mass`, or remove `medium`",
        )],
    );
    system(&boat("medium(velocity = c), force(at = top, value = hull.relative_velocity)"));
}

#[test]
fn central_gravity() {
    mistakes(
        "central_gravity(center = c), central_gravity(mu = theta), central_gravity(mu = k, center = pose.position), \
         central_gravity(sun, mu = c), central_gravity(sun, mu = k), central_gravity(mu = k, centre = c), \
         central_gravity(l, mu = k, center = k), force(sun, at = top, value = c)",
        &[
            ("central_gravity", "an attraction needs its gravitational parameter; add `mu = gm`"),
            ("centre", "unknown argument of `central_gravity`: `centre`; did you mean `center`?"),
            ("sun", "`sun` names a force and an attraction; rename one of the two"),
            ("sun", "`sun` names a force and an attraction; rename one of the two"),
            (
                "theta",
                "`theta` varies, and the gravitational parameter of an attraction is constant; write numbers and \
                 fields only",
            ),
            (
                "pose",
                "`pose` moves with the system, and the center of gravity is given beforehand; write it in `t`, \
                 fields and numbers",
            ),
            (
                "c",
                "the gravitational parameter of an attraction is a scalar, found a vector; write one number or \
                 the name of a field",
            ),
            ("k", "the center of gravity is a vector, found a scalar; write `[x, y, z]`"),
        ],
    );
}
