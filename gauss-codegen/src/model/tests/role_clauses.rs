//! Mass data in clauses: `mass = 2.0`.

use super::{check, model};
use crate::model::Model;
use crate::terms::{Role, Scalar, Shape};

/// A struct under clauses.
fn under(clauses: &str, fields: &str) -> String {
    format!("#[gauss({clauses})] struct Body {{ {fields} }}")
}

fn shape(model: &Model, role: Role) -> Option<Shape> {
    let clause = model.role_clauses.iter().find(|clause| clause.role == role).map(|clause| clause.shape);
    model.item.field(role).map(|field| field.shape).or(clause)
}

#[test]
fn a_body_without_fields() {
    let model = model(&under("mass = 2.0, inertia = [0.1, 0.1, 0.2], center_of_mass = [0, 0, 0.3]", ""));
    assert_eq!(model.item.scalar, Scalar::F64);
    assert!(!model.is_acted_upon() && model.item.fields.is_empty());
    let shapes = [Role::Mass, Role::Inertia, Role::CenterOfMass, Role::Gravity].map(|role| shape(&model, role));
    assert_eq!(shapes, [Some(Shape::Scalar), Some(Shape::Vector3), Some(Shape::Vector3), None]);
}

#[test]
fn fields_and_clauses_together() {
    let model = model(&under("inertia = a * [1, 1, r], gravity = 9.81", "#[gauss(mass)] m: f32, a: f32, r: f32"));
    assert_eq!(model.item.scalar, Scalar::F32);
    let shapes = [Role::Mass, Role::Inertia, Role::Gravity].map(|role| shape(&model, role));
    assert_eq!(shapes, [Some(Shape::Scalar), Some(Shape::Vector3), Some(Shape::Scalar)]);
}

#[test]
fn what_no_body_has() {
    check(
        &under("mass = -2.0, inertia = [1, 1, -3]", ""),
        &[("-", "`mass` must be positive, found -2"), ("-", "`inertia` must be zero or more, found -3")],
    );
    check(&under("mass = 0, inertia = 1", ""), &[("0", "`mass` must be positive, found 0")]);
    check(
        &under("mass = 1, inertia = 1, gravity = 9.81, displaced_mass = -1", ""),
        &[("-", "`displaced_mass` must be zero or more, found -1")],
    );
    // A thin bar in the plane: only one moment matters.
    model(&under("mass = 1, inertia = [0, 1, 1], motion = planar", ""));
}

#[test]
fn kinds_and_names() {
    check(
        &under("mass = [1, 2, 3], inertia = 2.0, center_of_mass = l", "l: f64"),
        &[
            ("[", "the mass of a body is one number, found a vector; write one number"),
            ("l", "the centre of mass is a point, in body axes from O, found a scalar; write `[x, y, z]`"),
        ],
    );
    model(&under("mass = 3 - t, inertia = [2, 2 - t, 2], center_of_mass = [0, 0, t]", ""));
    check(
        &under("mass = 1, inertia = 2.0, gravity = t", ""),
        &[("t", "`t` varies, and `gravity` of a body is constant; write numbers and fields only")],
    );
    check(
        &under("mass = 1, inertia = [1, 2, 3, 4, 5, 6 + abs(t)]", ""),
        &[(
            "abs",
            "`abs` stands in values of forces only; make the number a field of the struct, or the function of time a \
             `table(…)`",
        )],
    );
    check(&under("mass = 1.0, inertia = jj", "j: f64"), &[("jj", "unknown name `jj`; did you mean the field `j`?")]);
}

#[test]
fn once_and_all_of_it() {
    check(
        &under("mass = 1, mass = 2, inertia = 3", "#[gauss(inertia)] j: f64"),
        &[
            ("mass", "`mass` is given twice; keep one of the two"),
            ("inertia", "`inertia` is given here and by the field `j`; keep one of the two"),
        ],
    );
    check(
        &under("mass = 1", ""),
        &[(
            "Body",
            "`Body` has no field with the role `inertia`, which every body needs; add `#[gauss(inertia)] inertia: Vector3<f64>`",
        )],
    );
    check(
        &under("mass = 1, inertia = 2, added_mass = 3", ""),
        &[(
            "3",
            "an added mass is six, one for each component; write six scalars `[a, b, c, d, e, f]` in the order (u, ω), or \
             the name of a field that is a `Vector6` or a `Matrix6`",
        )],
    );
    check(
        &under("mass = 1, inertia = 2, displaced_mass = 3", ""),
        &[(
            "displaced_mass",
            "`displaced_mass` needs a field with the role `gravity`; buoyancy is the displaced mass times gravity: \
             add `#[gauss(gravity)] g: f64`",
        )],
    );
}

#[test]
fn bodies_of_systems() {
    let system = |clauses: &str, fields: &str| under(&format!("coordinates(a), {clauses}"), fields);
    check(
        &system("body(arm, rotation = rotation_x(a), mass = 1)", "#[gauss(body)] arm: RigidBody<f64>"),
        &[
            ("arm", "the mass data of the body `arm` are given here and by the field `arm`; keep one of the two"),
            (
                "body",
                "the body `arm` has some of its mass data here, but no `inertia`; add `inertia = …`, or write a `particle`",
            ),
        ],
    );
    check(
        &system("mass = 2, body(arm, rotation = rotation_x(a), mass = 1, inertia = 1)", ""),
        &[(
            "mass",
            "`mass` is that of a body without a name, and this system has none; write it in the clause of the body: \
             `body(name, mass = …)`",
        )],
    );
    check(
        &system("mass = 2, body(rotation = rotation_x(a), mass = 1, inertia = 1)", ""),
        &[("mass", "`mass` is given twice; keep one of the two")],
    );
    check(
        &system("body(rotation = rotation_x(a), mass = 1, inertia = 1), frame(f, mass = 2)", ""),
        &[("mass", "a frame has no mass; matter is a `body` or a `particle`")],
    );
}
