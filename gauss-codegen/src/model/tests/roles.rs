//! Mistakes in the roles and types of the fields.

use super::{INERTIA, check, with};

const ROLES: &str = "`mass`, `center_of_mass`, `inertia`, `inertia_about_center_of_mass`, `added_mass`, `gravity`, `displaced_mass` or `center_of_buoyancy`";

#[test]
fn missing_roles() {
    let mass = "`Body` has no field with the role `mass`, which every body needs; add `#[gauss(mass)] mass: f64`";
    let inertia = "`Body` has no field with the role `inertia`, which every body needs; \
        add `#[gauss(inertia)] inertia: Vector3<f64>`";
    check("struct Body { #[gauss(inertia)] j: f64 }", &[("Body", mass)]);
    check("struct Body { #[gauss(mass)] m: f64 }", &[("Body", inertia)]);
    check("struct Body {}", &[("Body", mass), ("Body", inertia)]);
    check("struct Body<T> { #[gauss(mass)] m: T }", &[("Body", &inertia.replace("f64", "T"))]);
}

#[test]
fn unknown_roles() {
    // A misspelt role is not missing as well.
    check(
        "struct Body { #[gauss(mas)] m: f64, #[gauss(inerta)] j: f64 }",
        &[
            ("mas", "unknown role `mas`; did you mean `mass`?"),
            ("inerta", "unknown role `inerta`; did you mean `inertia`?"),
        ],
    );
    check(
        &with("#[gauss(centre_of_mass)] c: Vector3<f64>"),
        &[("centre_of_mass", "unknown role `centre_of_mass`; did you mean `center_of_mass`?")],
    );
    check(&with("#[gauss(flywheel)] k: f64"), &[("flywheel", &format!("unknown role `flywheel`; expected {ROLES}"))]);
    check(
        &with("#[gauss(chart = hybrid)] k: f64"),
        &[(
            "chart",
            "`chart` is a clause of the struct, not of a field; write `#[gauss(chart = hybrid)]` above `struct`",
        )],
    );
    check(
        "struct Body { #[gauss(mass)] m: f64, #[gauss(principal)] j: Vector3<f64> }",
        &[(
            "principal",
            "`principal` is a form of a role, not a role; write `inertia = principal` or \
              `inertia_about_center_of_mass = principal`",
        )],
    );
    check(
        &with("#[gauss(full)] a: Matrix6<f64>"),
        &[(
            "full",
            "`full` is a form of a role, not a role; write `inertia = full` or \
              `inertia_about_center_of_mass = full` or `added_mass = full`",
        )],
    );
}

#[test]
fn doubled_roles() {
    check(
        &with("#[gauss(mass)] n: f64"),
        &[(
            "mass",
            "the role `mass` of the field `n` is already that of the field `m`; a body has one: remove one of the two",
        )],
    );
    check(
        "struct Body { #[gauss(mass, inertia)] m: f64 }",
        &[(
            "inertia",
            "the field `m` has two roles, first `mass` and now `inertia`; \
         a field plays one role: make a second field for `inertia`",
        )],
    );
    check(
        "struct Body { #[gauss(mass)] #[gauss(mass)] m: f64, #[gauss(inertia)] j: f64 }",
        &[("mass", "`mass` is written twice on the field `m`; write it once")],
    );
}

#[test]
fn wrong_shapes() {
    let inertia = |ty: &str| format!("struct Body {{ #[gauss(mass)] m: f64, #[gauss(inertia)] j: {ty} }}");
    check(
        "struct Body { #[gauss(mass)] m: Matrix6<f64>, #[gauss(inertia)] j: f64 }",
        &[("Matrix6<f64>", "`mass` cannot be a `Matrix6`; the mass of a body is one number: expected `f64`")],
    );
    check(
        "struct Body<T> { #[gauss(mass)] m: Vec<T>, #[gauss(inertia)] j: T }",
        &[("Vec<T>", "`mass` cannot be a `Vec`; the mass of a body is one number: expected `T`")],
    );
    check(&inertia("Matrix6<f64>"), &[("Matrix6<f64>", &format!("`inertia` cannot be a `Matrix6`; {INERTIA}"))]);
    check(&inertia("(f64, f64)"), &[("(f64, f64)", &format!("`inertia` cannot be a tuple; {INERTIA}"))]);
    check(&inertia("[f64; 3]"), &[("[f64; 3]", &format!("`inertia` cannot be an array; {INERTIA}"))]);
    check(&inertia("SVector<f64, 4>"), &[("SVector<f64, 4>", &format!("`inertia` cannot be an `SVector`; {INERTIA}"))]);
    check(
        &with("#[gauss(center_of_mass)] c: f64"),
        &[(
            "f64",
            "`center_of_mass` cannot be an `f64`; the centre of mass is a point, in body axes from O: \
         expected `Vector3<f64>`",
        )],
    );
    check(
        &with("#[gauss(added_mass)] a: Matrix3<f64>"),
        &[(
            "Matrix3<f64>",
            "`added_mass` cannot be a `Matrix3`; added mass acts on three linear and three angular speeds: \
         expected `Vector6<f64>` (diagonal) or `Matrix6<f64>` (full)",
        )],
    );
    check(
        &with("#[gauss(gravity)] g: bool"),
        &[(
            "bool",
            "`gravity` cannot be a `bool`; gravity is a magnitude along −k₃ or a vector in observer axes: \
         expected `f64` (vertical) or `Vector3<f64>` (vector)",
        )],
    );
}

#[test]
fn forms() {
    let inertia =
        |form: &str, ty: &str| format!("struct Body {{ #[gauss(mass)] m: f64, #[gauss(inertia {form})] j: {ty} }}");
    check(
        &inertia("= principal", "Matrix3<f64>"),
        &[(
            "principal",
            "`inertia = principal` contradicts the type `Matrix3` of `j`; \
         write `inertia = full` or make the field `Vector3<f64>`",
        )],
    );
    check(
        &inertia("= full", "Matrix6<f64>"),
        &[("full", "`inertia = full` contradicts the type `Matrix6` of `j`; make the field `Matrix3<f64>`")],
    );
    check(
        &inertia("= princpal", "Tensor"),
        &[("princpal", "unknown `inertia` form `princpal`; did you mean `principal`?")],
    );
    check(
        &inertia("= diagonal", "Tensor"),
        &[("diagonal", "unknown `inertia` form `diagonal`; expected `spherical`, `principal` or `full`")],
    );
    check(
        &inertia("= \"full\"", "Tensor"),
        &[("\"full\"", "`inertia` takes a bare word, not a string; write `inertia = full`")],
    );
    check(
        &inertia("(full)", "Tensor"),
        &[("(", "the value of `inertia` follows `=`, without brackets; write `inertia = full`")],
    );
    check(
        &inertia("", "Tensor"),
        &[(
            "Tensor",
            "the shape of `j` cannot be read from `Tensor`; \
         say it in the role: write `inertia = …` with `spherical`, `principal` or `full`",
        )],
    );
    check(
        "struct Body { #[gauss(mass = 3.0)] m: f64, #[gauss(inertia)] j: f64 }",
        &[("3.0", "`mass` takes no value; write `#[gauss(mass)]`")],
    );
    check(
        "struct Body { #[gauss(mass(dry))] m: f64, #[gauss(inertia)] j: f64 }",
        &[("(", "`mass` takes nothing in brackets; write `#[gauss(mass)]`")],
    );
}

#[test]
fn companions() {
    check(
        &with("#[gauss(displaced_mass)] d: f64"),
        &[(
            "displaced_mass",
            "`displaced_mass` needs a field with the role `gravity`; \
         buoyancy is the displaced mass times gravity: add `#[gauss(gravity)] g: f64`",
        )],
    );
    check(
        &with("#[gauss(gravity)] g: f64, #[gauss(center_of_buoyancy)] b: Vector3<f64>"),
        &[(
            "center_of_buoyancy",
            "`center_of_buoyancy` needs a field with the role `displaced_mass`; \
         without a displaced mass nothing acts there: add `#[gauss(displaced_mass)] displaced: f64`",
        )],
    );
}

#[test]
fn mixed_scalars() {
    check(
        &with("#[gauss(center_of_mass)] c: Vector3<f32>"),
        &[(
            "f32",
            "the scalar of `c` is `f32`, but that of `m` is `f64`; one scalar serves the whole body: write `f64`",
        )],
    );
    // The odd one is the one that most others disagree with, though it comes first.
    check(
        "struct Body<T> { #[gauss(mass)] m: f64, #[gauss(inertia)] j: T, #[gauss(gravity)] g: T }",
        &[("f64", "the scalar of `m` is `f64`, but that of `j` is `T`; one scalar serves the whole body: write `T`")],
    );
    check(
        "struct Body { #[gauss(mass)] m: f64, #[gauss(inertia)] j: Vector3<i32> }",
        &[("i32", "the scalar of `j` is `i32`; expected `f64`, `f32` or a type parameter of the struct")],
    );
}
