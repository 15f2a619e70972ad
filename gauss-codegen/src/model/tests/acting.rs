//! Loads on one body in a chart: the same clauses as in systems, of a body that is called `body`.

use super::systems::{show, shown};
use super::{Mistake, check, model};
use crate::model::Model;
use crate::terms::{Chart, RotationChart, Shape};

/// A body in a chart with `clauses` and more fields.
fn body(clauses: &str) -> String {
    format!(
        "#[gauss({clauses})] struct Body {{ #[gauss(mass)] m: f64, #[gauss(inertia)] j: Vector3<f64>, l: f64, k: f64, \
         c: Vector3<f64>, d: Matrix6<f64>, n: usize }}"
    )
}

fn acting(clauses: &str) -> Model {
    let model = model(&body(clauses));
    assert!(model.is_acted_upon());
    model
}

#[track_caller]
fn mistakes(clauses: &str, expected: &[Mistake<'_>]) {
    check(&body(clauses), expected);
}

#[test]
fn the_same_body_as_a_system() {
    assert!(!model(&body("chart = hybrid")).is_acted_upon());
    let model = acting(
        "chart = jet(euler_zyx), input(fin, gust: Wrench), define(u = body.relative_velocity), \
         point(tail, at = [-l, 0, 0]), medium(velocity = c), central_gravity(mu = k), potential = k * tail.z, limit = 5000, \
         force(lift, at = tail, value = [0, 0, u.x * u.x * fin]), force(at = c, value = c, axes = observer), \
         force(body = body, value = -k * body.velocity), torque(value = gust.torque), \
         wrench(at = [l, 0, 0], force = c, torque = c), drag(linear = d), \
         spring(from = body.position, to = tail, stiffness = k), stop(along = body.position.z, least = 0, stiffness = k, \
         width = l), damping = k * dot(body.angular_velocity, body.angular_velocity)",
    );
    assert_eq!(
        model.forces.iter().map(shown).collect::<Vec<_>>(),
        [
            "force lift: at [(-l) 0 0], value [0 0 (Multiply (Multiply body.RelativeVelocity[0] \
             body.RelativeVelocity[0]) fin)], body body",
            "force -: at c, value c, body body, axes observer",
            "force -: value (Multiply (-k) body.Velocity), body body",
            "torque -: body body, value gust.Torque",
            "wrench -: body body, at [l 0 0], force c, torque c",
            "drag -: body body, linear d",
            "spring -: from body.Position, to tail, stiffness k",
            "stop -: along body.Position[2], least 0, stiffness k, width l",
            "damping -: value (Multiply k (dot body.AngularVelocity body.AngularVelocity))",
        ]
    );
    assert_eq!(model.points[0].body, "body");
    assert!(model.coordinates.is_empty() && model.speeds.is_none() && model.kinematics.is_empty());
    assert_eq!(model.chart_of_all().map(|own| own.chart), Some(Chart::Jet(RotationChart::Euler([2, 1, 0]))));
    let [only] = model.bodies.as_slice() else { panic!("{} bodies", model.bodies.len()) };
    assert!(only.name.is_none() && !only.massless && only.parent.is_none());
    assert!(model.is_in_chart(only) && only.position.is_none() && only.rotation.is_none());
    assert_eq!(model.potential.as_ref().map(show), Some("(Multiply k tail[2])".into()));
    assert_eq!(model.item.limit, Some(5000));
    let shapes: Vec<Shape> = model.item.fields.iter().map(|field| field.shape).collect();
    let scalar = Shape::Scalar;
    assert_eq!(shapes, [scalar, Shape::Vector3, scalar, scalar, Shape::Vector3, Shape::Matrix6, Shape::Other]);
}

#[test]
fn places_and_bodies() {
    mistakes(
        "force(value = c), force(at = c), force(at = tip, value = c), force(at = body.position, value = c), \
         point(tip, at = [l, 0, 0]), point(toe), force(body = arm, at = c, value = c), torque(body = arm, value = c), \
         force(at = c, value = c, axes = world), torque(value = c, reaction = body), torque(value = c, reaction = ground), \
         force(at = c, value = arm.velocity)",
        &[
            (
                "force",
                "a force needs the point where it acts; add `at = …` in body axes from O, or `body = body` for a \
                 force at O",
            ),
            ("force", "a force needs its components; add `value = [fx, fy, fz]`"),
            ("point", "a point needs its place in the body; add `at = [x, y, z]`"),
            ("world", "unknown axes `world`; expected `body` or `observer`"),
            ("arm", "no body or frame is called `arm`; the only body is `body`"),
            ("arm", "no body or frame is called `arm`; the only body is `body`"),
            ("ground", "no body or frame is called `ground`; there is no other: leave `reaction` out"),
            (
                "body",
                "`body` is a body, which is known in observer axes, and the place where this acts is in the axes of \
                 its body; write numbers and fields, or the name of a point of that body",
            ),
            ("body", "the torque on `body` and its reaction on `body` cancel; name another body"),
        ],
    );
}

#[test]
fn what_systems_alone_have() {
    mistakes(
        "drive(x = k)",
        &[(
            "drive",
            "`drive` acts on rates of named coordinates, and those of a chart have no names; write `force(…)` or \
             `torque(…)`, or `coordinates(…)` of what else moves",
        )],
    );
    assert_eq!(model(&body("limit = 10")).item.limit, Some(10));
}

#[test]
fn names() {
    mistakes(
        "input(k, m), define(l = 1, j = 2), force(k, at = c, value = c)",
        &[
            (
                "k",
                "`k` is a field, whose value is fixed when the kernel is made, and an input, whose value arrives at \
                 run time; rename or remove one of the two",
            ),
            (
                "m",
                "`m` is a field, whose value is fixed when the kernel is made, and an input, whose value arrives at \
                 run time; rename or remove one of the two",
            ),
            ("l", "`l` names a field and a definition; rename one of the two"),
            ("j", "`j` names a field and a definition; rename one of the two"),
        ],
    );
    mistakes(
        "input(thrust, body), force(at = c, value = [thrust, body, 0])",
        &[("body", "`body` is the only body in expressions and clauses, and an input; rename the input")],
    );
    // Nobody takes a field for the body that no expression names.
    let field = |value: &str| {
        format!(
            "#[gauss(force(at = [0, 0, 0], value = {value}))] \
             struct Body {{ #[gauss(mass)] body: f64, #[gauss(inertia)] j: f64, c: Vector3<f64> }}"
        )
    };
    assert!(model(&field("c")).is_acted_upon());
    check(
        &field("-body.velocity"),
        &[("body", "`body` is the only body in expressions and clauses, and a field; rename the field")],
    );
}

#[test]
fn potentials_and_the_medium() {
    mistakes(
        "input(thrust), potential = body.velocity.x + thrust",
        &[
            (
                "velocity",
                "`body.velocity` is a velocity, which only `constraint(velocity = …)` and values of forces can \
                 contain; write what depends on velocities as `force(…)` or `damping = …`",
            ),
            (
                "thrust",
                "`thrust` is an input, whose value is not known before run time, and whose rate is never; inputs \
                 stand in values of `force`, `torque`, `wrench` and `drive`, in coefficients of `drag`, and in \
                 `damping`",
            ),
        ],
    );
    mistakes(
        "input(thrust), medium(velocity = [thrust, 0, 0]), drag(linear = d), force(at = c, value = thrust * c)",
        &[(
            "thrust",
            "`thrust` is an input, whose rate is never known, and bodies feel the rate of the velocity of the \
                 medium by their added mass; write it in `t`, fields and numbers",
        )],
    );
    mistakes(
        "medium(velocity = c)",
        &[(
            "medium",
            "nothing in the scene feels the medium; add `drag(…)`, name `.relative_velocity` of a body in a \
                 force, give the body a field with the role `added_mass`, or remove `medium`",
        )],
    );
    let fluid = "#[gauss(medium(velocity = [1, 0, 0]))] \
        struct Body { #[gauss(mass)] m: f64, #[gauss(inertia)] j: f64, #[gauss(added_mass)] a: Matrix6<f64> }";
    assert!(model(fluid).is_acted_upon());
}

#[test]
fn one_scalar() {
    check(
        "#[gauss(force(at = [0, 0, 0], value = [k, 0, 0]), drag(linear = d))] \
         struct Body { #[gauss(mass)] m: f64, #[gauss(inertia)] j: f64, k: f32, d: Vector6<f32> }",
        &[
            (
                "f32",
                "the scalar of `k` is `f32`, but that of `m` is `f64`; one scalar serves the whole body: write `f64`",
            ),
            (
                "f32",
                "the scalar of `d` is `f32`, but that of `m` is `f64`; one scalar serves the whole body: write `f64`",
            ),
        ],
    );
}
