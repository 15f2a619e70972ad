//! Frames, points, parents of particles; what expressions ask of bodies.

use super::super::check;
use super::{show, system};

/// A body `arm` at angle `q`, with more `clauses` and `fields`.
fn arm(clauses: &str, fields: &str) -> String {
    format!(
        "#[gauss(coordinates(q, x), body(arm, position = [x, 0, 0], rotation = rotation_z(q)), {clauses})] \
         struct Scene {{ #[gauss(body)] arm: RigidBody<f64>, l: f64, {fields} }}"
    )
}

#[test]
fn accepted() {
    let model = system(&arm(
        "frame(hip, parent = arm, position = [l, 0, 0]), frame(ground), point(tip, body = hip, at = [l / 2, 0, 0]), \
         particle(mass = 1, parent = hip, position = [x, 0, 0]), \
         particle(mass = 1, position = tip + arm.rotation * [0, l, 0] - hip.position), \
         potential = dot(tip, ground.position)",
        "",
    ));
    let bodies: Vec<_> = model.bodies.iter().map(|body| (body.massless, body.name.clone().unwrap())).collect();
    assert_eq!(bodies.iter().map(|(massless, _)| *massless).collect::<Vec<_>>(), [false, true, true]);
    assert_eq!(model.bodies[1].parent.as_ref().unwrap(), "arm");
    let [point] = model.points.as_slice() else { panic!("one point") };
    assert_eq!(
        (point.name.to_string(), point.body.to_string(), show(&point.at)),
        ("tip".into(), "hip".into(), "[(Divide l 2) 0 0]".into())
    );
    assert_eq!(model.particles[0].parent.as_ref().unwrap(), "hip");
    assert_eq!(show(&model.particles[1].position), "(Subtract (Add tip (Multiply arm.Rotation [0 l 0])) hip.Position)");
    // The only body needs no name next to frames, and may have one for its parent.
    system(
        "#[gauss(coordinates(q), frame(tilt, rotation = rotation_x(angle)), body(parent = tilt, rotation = rotation_z(q)))] \
         struct Scene { #[gauss(mass)] m: f64, #[gauss(inertia)] j: f64, angle: f64 }",
    );
}

#[test]
fn clauses() {
    check(
        &arm(
            "frame(position = [l, 0, 0]), frame(), frame = 3, frame(a, mass = l), frame(b, rotaton = arm), \
             point(at = [l, 0, 0]), point(c, body = arm), point(d, at = [l, 0, 0]), point(e, bdy = arm, at = [0, 0, 0]), \
             point(f, body = 3, at = [0, 0, 0]), point(g x, body = arm, at = [0, 0, 0])",
            "",
        ),
        &[
            ("frame", "a frame needs a name to be referred to by; write `frame(name, …)`"),
            ("(", "`frame()` is empty; write `frame(name, position = […], rotation = …)` or remove it"),
            ("3", "`frame` takes brackets, not `=`; write `frame(name, position = […], rotation = …)`"),
            ("mass", "a frame has no mass; matter is a `body` or a `particle`"),
            ("rotaton", "unknown argument of `frame`: `rotaton`; did you mean `rotation`?"),
            ("point", "a point needs a name to be referred to by; write `point(name, …)`"),
            ("point", "a point needs the body that it is fixed in; add `body = name`"),
            ("point", "a point needs its place in the body; add `at = [x, y, z]`"),
            ("point", "a point needs the body that it is fixed in; add `body = name`"),
            ("bdy", "unknown argument of `point`: `bdy`; did you mean `body`?"),
            ("3", "`body` is the name of a body or a frame, found the literal `3`"),
            ("x", "expected `=` or `,` after `g`, found `x`"),
        ],
    );
}

#[test]
fn references() {
    check(
        &arm(
            "frame(hip, parent = am), point(tip, body = hipp, at = [0, 0, 0]), \
             particle(mass = 1, position = [x, 0, 0], parent = tip)",
            "",
        ),
        &[
            ("am", "no body or frame is called `am`; did you mean `arm`?"),
            ("tip", "`tip` is a point, not a body or frame; did you mean `hip`?"),
            ("hipp", "no body or frame is called `hipp`; did you mean `hip`?"),
        ],
    );
    check(
        "#[gauss(coordinates(q), body(rotation = rotation_x(q)), point(tip, body = body, at = [0, 0, 0]), \
         particle(mass = m, position = body.position), frame(hip, parent = other))] \
         struct Scene { #[gauss(mass)] m: f64, #[gauss(inertia)] j: f64 }",
        &[("other", "no body or frame is called `other`; the only body is `body`")],
    );
    check(
        "#[gauss(coordinates(q), particle(mass = m, position = [q, 0, 0]), point(tip, body = arm, at = [0, 0, 0]))] \
         struct Scene { m: f64 }",
        &[("arm", "no body or frame is called `arm`; add `body(arm, …)` or `frame(arm, …)`")],
    );
    check(
        &arm("frame(a, parent = b), frame(b, parent = a), frame(c, parent = c)", ""),
        &[
            (
                "b",
                "the frames `a` and `b` are each other's parent; one frame must be placed in the observer's frame: \
                 leave one `parent` out",
            ),
            (
                "c",
                "the frame `c` is its own parent; one frame must be placed in the observer's frame: \
                 leave one `parent` out",
            ),
        ],
    );
    check(
        "#[gauss(coordinates(q), body(arm, parent = hip), frame(hip, parent = arm, rotation = rotation_x(q)))] \
         struct Scene { #[gauss(body)] arm: RigidBody<f64> }",
        &[(
            "hip",
            "the bodies and frames `arm` and `hip` are each other's parent; one body or frame must be placed in the \
             observer's frame: leave one `parent` out",
        )],
    );
}

#[test]
fn names() {
    check(
        &arm(
            "frame(hand), frame(l), frame(q), frame(tip), point(tip, body = arm, at = [0, 0, 0]), frame(tip)",
            "#[gauss(body)] hand: RigidBody<f64>",
        ),
        &[
            (
                "hand",
                "`hand` is a body by its field, and a frame has no field; write `body(hand, …)`, or remove \
                 the field",
            ),
            ("l", "`l` names a field and a frame; rename one of the two"),
            ("q", "`q` names a coordinate and a frame; rename one of the two"),
            ("tip", "the frame `tip` is declared twice; remove one of the two"),
            ("tip", "`tip` names a frame and a point; rename one of the two"),
        ],
    );
    check(
        "#[gauss(coordinates(x), frame(a, position = [x, 0, 0]))] struct Scene {}",
        &[(
            "coordinates",
            "the system has no body and no particle, so nothing in it has mass; \
             add `body(position = […], rotation = …)` or `particle(mass = …, position = […])`",
        )],
    );
}

#[test]
fn properties() {
    let potential = |value: &str| {
        arm(
            &format!("point(tip, body = arm, at = [0, 0, 0]), frame(hip), potential = {value}"),
            "other: RigidBody<f64>, a: Vector3<f64>",
        )
    };
    let mistake = |value: &str, token: &str, message: &str| check(&potential(value), &[(token, message)]);
    mistake("arm.positon.x", "positon", "there is no `.positon`; did you mean `.position`?");
    mistake("arm.position().x", "position", "`position` is no function; write `.position` without brackets");
    mistake("arm.x", "arm", "`arm` is a body; write `arm.position` or `arm.rotation`");
    mistake("dot(hip, a)", "hip", "`hip` is a frame; write `hip.position` or `hip.rotation`");
    mistake("tip.position.x", "position", "`tip` is itself a position; write `tip`");
    mistake(
        "x.position.x",
        "position",
        "`x` is a scalar and has no `.position`; bodies and frames have, by their names",
    );
    mistake(
        "(a + a).position.x",
        "position",
        "`.position` is a property of bodies, frames and poses; write it after their names",
    );
    mistake(
        "arm.velocity.x",
        "velocity",
        "`arm.velocity` is a velocity, which only `constraint(velocity = …)` and values of forces can contain; \
         write what depends on velocities as `force(…)` or `damping = …`",
    );
    mistake("arn.position.x", "arn", "unknown name `arn`; did you mean the body `arm`?");
    mistake("somebody.position.x", "somebody", "unknown name `somebody`; expected a body (`arm`) or a frame (`hip`)");
    mistake(
        "dot(somewhere, a)",
        "somewhere",
        "unknown name `somewhere`; expected a coordinate (`q` or `x`), a field (`l` or `a`), a body (`arm`), \
         a frame (`hip`), a point (`tip`) or `t`",
    );
    mistake(
        "other.position.x",
        "other",
        "the field `other` has no role; a body is a field `#[gauss(body)] other: RigidBody<f64>` with a clause \
         `body(other, …)`",
    );
    mistake("dot(arm.rotation, a)", "rotation", "`dot` takes a vector, found a rotation");
    mistake("(inverse(a) * a).x", "a", "`inverse` takes a rotation, found a vector");
    mistake("atan2(x, a)", "a", "`atan2` takes a scalar, found a vector");
    mistake("atan2(x)", "atan2", "`atan2` takes two arguments, found 1; write `atan2(y, x)`");
}

#[test]
fn places() {
    check(
        "#[gauss(coordinates(q), speeds(v), kinematics(q = arm.position.x * v + tip.x), body(arm, rotation = rotation_x(q)), \
         body(hand, position = arm.position + tip + [v, 0, 0], rotation = arm.rotation), \
         point(tip, body = arm, at = [q, v, t] + arm.position), \
         particle(mass = dot(tip, tip), parent = arm, position = tip + [v, 0, 0]))] \
         struct Scene { #[gauss(body)] arm: RigidBody<f64>, #[gauss(body)] hand: RigidBody<f64> }",
        &[
            (
                "arm",
                "`arm` is a body, and its velocity follows from the kinematics, not the kinematics from it; \
                 write rates in coordinates, speeds, fields and `t`",
            ),
            (
                "tip",
                "`tip` is a point, and its velocity follows from the kinematics, not the kinematics from it; \
                 write rates in coordinates, speeds, fields and `t`",
            ),
            (
                "arm",
                "`arm` is a body, and bodies are placed relative to one another by parents; write `parent = arm` and \
                 what is relative to it",
            ),
            (
                "tip",
                "`tip` is a point, and bodies are placed relative to one another by parents; write `parent = …` with its \
                 body",
            ),
            (
                "v",
                "`v` is a speed, and a position depends on coordinates, fields and `t` only; speeds stand in \
                 `kinematics`",
            ),
            (
                "arm",
                "`arm` is a body, and bodies are placed relative to one another by parents; write `parent = arm` and \
                 what is relative to it",
            ),
            (
                "tip",
                "`tip` moves with the system, and the mass of a particle is given beforehand; write it in `t`, fields \
                 and numbers",
            ),
            (
                "tip",
                "`tip` moves with the system, and the mass of a particle is given beforehand; write it in `t`, fields \
                 and numbers",
            ),
            (
                "tip",
                "`tip` is a point, which is known in observer axes, and the position of a particle with a parent is in \
                 the axes of the parent; leave `parent` out, or write the position without `tip`",
            ),
            (
                "v",
                "`v` is a speed, and a position depends on coordinates, fields and `t` only; speeds stand in \
                 `kinematics`",
            ),
            ("q", "`q` varies, and a point is fixed in its body; write numbers and fields only"),
            ("v", "`v` varies, and a point is fixed in its body; write numbers and fields only"),
            ("t", "`t` varies, and a point is fixed in its body; write numbers and fields only"),
            ("arm", "`arm` is a body, and a point is given in the axes of its own body; write numbers and fields only"),
        ],
    );
}
