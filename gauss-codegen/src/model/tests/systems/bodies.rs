//! Bodies: names, fields, parents, roles.

use super::super::check;
use crate::model::language::arithmetic::ALLOWED;

/// A system with two named bodies whose clauses are given.
fn two(first: &str, second: &str) -> String {
    format!(
        "#[gauss(coordinates(a, b), body({first}), body({second}))] \
         struct Scene {{ #[gauss(body)] upper: RigidBody<f64>, #[gauss(body)] lower: RigidBody<f64> }}"
    )
}

const A: &str = "rotation = rotation_x(a)";
const B: &str = "rotation = rotation_x(b)";

#[test]
fn names() {
    let unnamed = "a body without a name must be the only one, and there are 2; \
        write `body(name, …)` with a field `#[gauss(body)] name: RigidBody<f64>`";
    check(
        &format!("#[gauss(coordinates(a, b), body({A}), body({B}))] struct Scene {{}}"),
        &[("body", unnamed), ("body", unnamed)],
    );
    check(
        &two(&format!("upper, {A}"), &format!("upper, {B}")),
        &[
            ("upper", "two bodies are called `upper`; each has a field of its own: rename one of the two"),
            (
                "body",
                "the field `lower` is a body, but no clause gives its place; \
                 add `body(lower, position = […], rotation = …)` above `struct`",
            ),
        ],
    );
}

#[test]
fn fields() {
    check(
        &two(&format!("upper, {A}"), &format!("lowr, {B}")),
        &[("lowr", "the body `lowr` has no field with its mass data; did you mean `lower`?")],
    );
    check(
        &format!("#[gauss(coordinates(a), body(arm, {A}), body(tip, parent = arm))] struct Scene {{ arm: f64 }}"),
        &[
            (
                "arm",
                "the body `arm` takes its mass data from the field `arm`, which has no role; \
                 write `#[gauss(body)] arm: RigidBody<f64>`",
            ),
            (
                "tip",
                "the body `tip` has no field with its mass data; add `#[gauss(body)] tip: RigidBody<f64>`, or `mass = …` and `inertia = …` to the clause",
            ),
        ],
    );
    check(
        &format!("#[gauss(coordinates(a), body(arm, {A}))] struct Scene {{ #[gauss(body)] arm: Matrix3<f64> }}"),
        &[(
            "Matrix3<f64>",
            "`body` cannot be a `Matrix3`; a body of a system has mass, centre of mass and inertia together: \
             expected `RigidBody<f64>`",
        )],
    );
    check(
        "#[gauss(chart = hybrid)] struct Scene { #[gauss(body)] arm: RigidBody<f64> }",
        &[
            (
                "chart",
                "`chart` moves a body without a name, and `Scene` has no mass data of one; add `#[gauss(mass)] mass: f64` \
                 and `#[gauss(inertia)] inertia: Vector3<f64>`, or remove `chart`: what else moves is said by \
                 `coordinates` and `speeds`",
            ),
            (
                "body",
                "the field `arm` is a body, but no clause gives its place; \
                 add `body(arm, position = […], rotation = …)` above `struct`",
            ),
        ],
    );
}

#[test]
fn roles() {
    check(
        &format!("#[gauss(coordinates(a), body({A}))] struct Scene {{ #[gauss(mass)] m: f64 }}"),
        &[(
            "Scene",
            "`Scene` has no field with the role `inertia`, which every body needs; \
             add `#[gauss(inertia)] inertia: Vector3<f64>`",
        )],
    );
    check(
        "#[gauss(coordinates(x), particle(mass = m, position = [x, 0, 0]))] \
         struct Scene { #[gauss(mass)] m: f64, #[gauss(gravity)] g: f64 }",
        &[(
            "mass",
            "the role `mass` belongs to a body without a name, and this system has none; \
             add `body(position = […], rotation = …)`, or remove the role: expressions can name `m` without it",
        )],
    );
}

#[test]
fn parents() {
    let alone = "one body must be placed in the observer's frame: leave one `parent` out";
    check(
        &two(&format!("upper, parent = lower, {A}"), &format!("lower, parent = upper, {B}")),
        &[("lower", &format!("the bodies `upper` and `lower` are each other's parent; {alone}"))],
    );
    check(
        &two(&format!("upper, parent = upper, {A}"), &format!("lower, parent = uper, {B}")),
        &[
            ("uper", "no body or frame is called `uper`; did you mean `upper`?"),
            ("upper", &format!("the body `upper` is its own parent; {alone}")),
        ],
    );
    check(
        &two(&format!("upper, {A}"), &format!("lower, parent = ground, {B}")),
        &[("ground", "no body or frame is called `ground`; expected `upper`")],
    );
    check(
        "#[gauss(coordinates(q), body(a, parent = b), body(b, parent = c), body(c, parent = a, rotation = rotation_x(q)))] \
         struct Scene { #[gauss(body)] a: RigidBody<f64>, #[gauss(body)] b: RigidBody<f64>, \
         #[gauss(body)] c: RigidBody<f64> }",
        &[("b", &format!("the parents of the bodies `a`, `b` and `c` go round in a circle; {alone}"))],
    );
}

#[test]
fn arguments() {
    check(
        &two(&format!("upper, {A}, positon = [a, 0, 0]"), &format!("lower, {B}, parent = 3, rotation = {A}")),
        &[
            ("positon", "unknown argument of `body`: `positon`; did you mean `position`?"),
            ("3", "`parent` is the name of another body or frame, found the literal `3`"),
            ("rotation", "`rotation` is given twice; keep one of the two"),
            ("=", &format!("a second `=` has no meaning here; {ALLOWED}")),
        ],
    );
}
