//! Constraints, independent speeds, and the limit on the size of the code.

use super::super::check;
use super::{particle, show, system};
use crate::model::ConstraintLevel;

/// A particle in space, two speeds, a body on a path, with more `clauses`.
fn moving(clauses: &str) -> String {
    format!(
        "#[gauss(coordinates(x, y, q), speeds(v, w, s), kinematics(x = v, y = w, q = s), \
         particle(mass = m, position = [x, y, 0]), body(arm, position = [l, 0, 0], rotation = rotation_z(q)), \
         frame(wall, position = [l * t, 0, 0]), frame(hand, parent = arm), \
         point(tip, body = hand, at = [l, 0, 0]), point(nail, body = wall, at = [l, 0, 0]), {clauses})] \
         struct Scene {{ #[gauss(body)] arm: RigidBody<f64>, m: f64, l: f64 }}"
    )
}

#[track_caller]
fn mistake(clause: &str, token: &str, message: &str) {
    check(&moving(clause), &[(token, message)]);
}

#[test]
fn accepted() {
    let model = system(&moving(
        "constraint(velocity = v * sin(q) - w), constraint(position = tip - [x, y, 0]), \
         constraint(velocity = rate(tip) - cross(arm.angular_velocity, tip) - arm.velocity), \
         constraint(velocity = rate(x * t)), independent(s, v), limit = 1_000",
    ));
    let constraints: Vec<_> = model.constraints.iter().map(|c| (c.kind, c.vector, show(&c.expression))).collect();
    use ConstraintLevel::{Position, Velocity};
    assert_eq!(
        constraints,
        [
            (Velocity, false, "(Subtract (Multiply v (sin q)) w)".into()),
            (Position, true, "(Subtract tip [x y 0])".into()),
            (Velocity, true, "(Subtract (Subtract (rate tip) (cross arm.AngularVelocity tip)) arm.Velocity)".into()),
            (Velocity, false, "(rate (Multiply x t))".into()),
        ]
    );
    let independent: Vec<_> = model.independent.iter().flatten().map(ToString::to_string).collect();
    assert_eq!(independent, ["s", "v"]);
    assert_eq!(model.item.limit, Some(1000));
    // Coordinates that only constraints name are for the derivation to judge.
    system(
        "#[gauss(coordinates(x, y), particle(mass = 1, position = [x, 0, 0]), constraint(position = x - y))] struct Scene {}",
    );
}

#[test]
fn clauses() {
    check(
        &moving(
            "constraint, constraint(), constraint(x - y), constraint(acceleration = x), constraint(positon = x), \
             constraint(position = x, velocity = v), constraint(position), constraint(positin: x), constraint([v, w, s])",
        ),
        &[
            ("constraint", "`constraint` is empty; write `constraint(velocity = …)`"),
            ("(", "`constraint()` is empty; write `constraint(velocity = …)` or remove it"),
            (
                "x",
                "a constraint is one of positions or of velocities; write `constraint(position = x-y)` or \
                 `constraint(velocity = x-y)`",
            ),
            ("acceleration", "unknown argument of `constraint`: `acceleration`; expected `position` or `velocity`"),
            ("positon", "unknown argument of `constraint`: `positon`; did you mean `position`?"),
            ("velocity", "a clause has one constraint; write `constraint(velocity = …)` in a clause of its own"),
            ("position", "`position` needs a value; write `position = x - l`"),
            (":", "expected `=` or `,` after `positin`, found `:`"),
            ("positin", "unknown argument of `constraint`: `positin`; did you mean `position`?"),
            (
                "[",
                "a constraint is one of positions or of velocities; write `constraint(position = [v, w, s])` or \
                 `constraint(velocity = [v, w, s])`",
            ),
        ],
    );
}

#[test]
fn a_name() {
    let unnamed = "a constraint has no name: nothing refers to it; write `constraint(position = …)` or \
                   `constraint(velocity = …)` without `closing`";
    mistake("constraint(closing, position = x - y)", "closing", unnamed);
    check(
        &moving("constraint(position = x - y, closing, velocity = v)"),
        &[
            ("closing", unnamed),
            ("velocity", "a clause has one constraint; write `constraint(velocity = …)` in a clause of its own"),
        ],
    );
}

#[test]
fn kinds() {
    mistake(
        "constraint(position = arm.rotation)",
        "rotation",
        "a constraint is a scalar or a vector that is zero, found a rotation; \
         write numbers that vanish when it holds, such as products of unit vectors",
    );
    mistake(
        "constraint(velocity = rate(arm.rotation))",
        "rotation",
        "`rate` takes a scalar or a vector, found a rotation; ask bodies for `.angular_velocity`",
    );
    mistake(
        "constraint(velocity = twist(tip, tip))",
        "twist",
        "a twist is no part of another expression; write `pose = twist(linear, angular)` in `kinematics(…)`",
    );
}

#[test]
fn velocities() {
    mistake(
        "constraint(position = x * v)",
        "v",
        "`v` is a speed, and a constraint of positions depends on coordinates, fields and `t` only; \
         write `constraint(velocity = …)`",
    );
    mistake(
        "constraint(position = arm.velocity.x)",
        "velocity",
        "`arm.velocity` is a velocity, which only `constraint(velocity = …)` and values of forces can contain; \
         write `constraint(velocity = …)`",
    );
    mistake(
        "potential = rate(x)",
        "rate",
        "`rate(…)` is a velocity, which only `constraint(velocity = …)` and values of forces can contain; \
         write what depends on velocities as `force(…)` or `damping = …`",
    );
    let acceleration = |of: &str, instead: &str| {
        format!(
            "the time derivative of `{of}` is an acceleration, which a constraint of velocities cannot contain; \
             write {instead}"
        )
    };
    mistake("constraint(velocity = rate(x * v))", "v", &acceleration("v", "`v` itself"));
    mistake(
        "constraint(velocity = rate(arm.velocity))",
        "velocity",
        &acceleration("arm.velocity", "`arm.velocity` itself"),
    );
    mistake("constraint(velocity = rate(rate(x)))", "rate", &acceleration("rate(…)", "one `rate`"));
    mistake(
        "constraint(velocity = dot(tip.angular_velocity, tip))",
        "angular_velocity",
        "`tip` is a point and has no `.angular_velocity`; bodies and frames have, by their names",
    );
}

#[test]
fn motion() {
    let nothing = "the constraint names nothing that moves, so no motion makes it hold; \
        name a coordinate, a speed, or a body or point that moves";
    mistake("constraint(position = l - m)", "constraint", nothing);
    mistake("constraint(position = nail)", "constraint", nothing);
    mistake("constraint(velocity = rate(nail) - wall.velocity)", "constraint", nothing);
    mistake(
        "constraint(velocity = tip - nail + rate(nail))",
        "constraint",
        "the constraint contains no velocity of anything that moves; write `constraint(position = …)`, \
         or the time derivative `rate(…)`",
    );
}

#[test]
fn redundant() {
    let constraint = "constraint(velocity = v - w)";
    assert!(system(&moving(&format!("{constraint}, redundant"))).redundant);
    assert!(!system(&moving(constraint)).redundant);
    mistake(
        "redundant",
        "redundant",
        "without constraints none can depend on others; add `constraint(…)`, or remove `redundant`",
    );
    mistake(
        &format!("{constraint}, redundant(v)"),
        "redundant",
        "`redundant` is a word alone, and of all constraints; write `redundant` without a value",
    );
    mistake(
        &format!("{constraint}, redundant, redundant"),
        "redundant",
        "`redundant` is given twice; keep one of the two",
    );
    mistake(
        &format!("{constraint}, redundant, independent(v)"),
        "independent",
        "constraints that may depend on one another cannot be solved for speeds when the code is written; remove \
         `independent` to have them kept with multipliers, or remove `redundant`",
    );
}

#[test]
fn independent() {
    let constraint = "constraint(velocity = v - w)";
    check(
        &moving(&format!("{constraint}, independent(v, v, x, ss, unknown)")),
        &[
            ("v", "`v` is named independent twice; remove one of the two"),
            ("x", "`x` is a coordinate, not a speed; expected `v`, `w` or `s`"),
            ("ss", "`ss` is no speed; did you mean `s`?"),
            ("unknown", "`unknown` is no speed; expected `v`, `w` or `s`"),
        ],
    );
    mistake(
        "independent(v)",
        "independent",
        "without constraints all speeds are independent; add `constraint(…)`, or remove `independent`",
    );
    mistake(
        &format!("{constraint}, independent(v, w, s)"),
        "independent",
        "all speeds are named independent, and none is left to solve the constraints for; \
         leave out as many as there are constraints",
    );
    mistake(
        &format!("{constraint}, independent(v), independent(w)"),
        "independent",
        "`independent` is given twice; write all of it in one",
    );
    mistake(
        &format!("{constraint}, independent(v: Vector3)"),
        ":",
        "the kind of a speed is given where it is declared; write `v`",
    );
    check(
        &particle("constraint(position = x - y), independent(x)", ""),
        &[(
            "independent",
            "`independent` names speeds, and without `speeds(…)` they have no names; \
             add `speeds(…)` and `kinematics(…)`, or remove `independent`",
        )],
    );
}

#[test]
fn limit() {
    for (written, token) in [("0", "0"), ("-5", "-"), ("5.0", "5.0"), ("many", "many"), ("5u8", "5u8")] {
        let message = format!(
            "`limit` is the most operations that the generated code may have, a positive integer, found `{written}`; \
             write `limit = 50000`"
        );
        check(&particle(&format!("limit = {written}"), ""), &[(token, &message)]);
    }
    check(
        &particle("limit = 10, limit = 20, limit(5)", ""),
        &[
            ("limit", "`limit` is given twice; keep one of the two"),
            ("limit", "`limit` is given twice; keep one of the two"),
            ("(", "the value of `limit` follows `=`, without brackets; write `limit = 50000`"),
        ],
    );
}
