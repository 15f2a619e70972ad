//! Items that are no structs with named fields, generics, many mistakes at once, and anything at all.

use super::{ALL_CLAUSES, INERTIA, body, check, read};

#[test]
fn other_items() {
    let message = |found: &str| {
        format!(
            "`GaussDynamics` is derived for structs with named fields, and `Body` is {found}; \
             write `struct Body {{ #[gauss(mass)] mass: f64, #[gauss(inertia)] inertia: f64 }}`"
        )
    };
    check("enum Body { A, B }", &[("Body", &message("an enum"))]);
    check("union Body { a: f64 }", &[("Body", &message("a union"))]);
    check("struct Body(f64, f64);", &[("Body", &message("a tuple struct"))]);
    let unit = "`GaussDynamics` is derived for structs with named fields, and `Body` is a unit struct; \
                write `struct Body {}`";
    check("struct Body;", &[("Body", unit)]);
    check(
        "#[gauss(chart = hybird)] enum Body {}",
        &[("hybird", "unknown chart `hybird`; did you mean `hybrid`?"), ("Body", &message("an enum"))],
    );
}

#[test]
fn generics() {
    check(
        "struct Body<'a, T, const N: usize> { #[gauss(mass)] m: T, #[gauss(inertia)] j: T, n: &'a [T; N] }",
        &[
            (
                "'a",
                "the lifetime parameter `'a` is not supported; \
                 a kernel outlives the struct that it is made from: write fields that own their values",
            ),
            (
                "N",
                "the const parameter `N` is not supported; \
                 the shape of every role is fixed: write the number where it is used",
            ),
        ],
    );
    let hidden = "the scalar cannot be read from any field that is computed with, since each type is behind an alias; \
        write `f64`, `f32` or a type parameter in one of them";
    check("struct Body { #[gauss(inertia = full)] j: Tensor, #[gauss(mass)] m: Mass }", &[("Mass", hidden)]);
    check(
        "struct Body<T, U> { #[gauss(mass)] m: Mass, #[gauss(inertia = full)] j: J, t: T, u: U }",
        &[("Mass", hidden)],
    );
}

#[test]
fn several_at_once() {
    check(
        "#[gauss(chart = hybird, motion = planer, bogus)] struct Body { \
         #[gauss(mas)] m: f64, #[gauss(inertia)] j: Matrix6<f64>, \
         #[gauss(center_of_mass)] c: f64, #[gauss(displaced_mass)] d: f64 }",
        &[
            ("hybird", "unknown chart `hybird`; did you mean `hybrid`?"),
            ("planer", "unknown motion `planer`; did you mean `planar`?"),
            ("bogus", &format!("unknown clause `bogus`; {ALL_CLAUSES}")),
            ("mas", "unknown role `mas`; did you mean `mass`?"),
            ("Matrix6<f64>", &format!("`inertia` cannot be a `Matrix6`; {INERTIA}")),
            (
                "f64",
                "`center_of_mass` cannot be an `f64`; the centre of mass is a point, in body axes from O: \
                 expected `Vector3<f64>`",
            ),
            (
                "displaced_mass",
                "`displaced_mass` needs a field with the role `gravity`; \
                 buoyancy is the displaced mass times gravity: add `#[gauss(gravity)] g: f64`",
            ),
        ],
    );
}

/// Whatever stands in an attribute, the answer is a model or a message.
#[test]
fn nothing_panics() {
    let words = [
        "gauss",
        "chart",
        "=",
        "jet",
        "(euler_zyx)",
        "()",
        "hybrid",
        ",",
        "crate",
        "::",
        "\"\"",
        "\"(\"",
        "'x'",
        "0",
        "mass",
        "[",
        "]",
        "#",
        "r#motion",
        "b\"\"",
        "-",
        "_",
        "é",
        "planar",
        ";",
        "c\"a\"",
        "{}",
        "principal",
    ];
    let mut read_snippets = 0;
    for first in words {
        for second in words {
            for third in words {
                let clause = format!("{first} {second} {third}");
                let on_struct = body(&format!("#[gauss({clause})]"));
                let on_field = format!("struct Body {{ #[gauss({clause})] m: f64, #[gauss(inertia)] j: f64 }}");
                for source in [on_struct, on_field] {
                    if let Ok(input) = syn::parse_str(&source) {
                        let _ = crate::model::parse(&input);
                        read_snippets += 1;
                    }
                }
            }
        }
    }
    assert!(read_snippets > 10_000, "{read_snippets}");
    assert!(read(&body("")).is_ok());
}
