//! Mistakes in the clauses of the struct.

use super::{ALL_CLAUSES, check, check_body, with};

const ROTATIONS: &str = "`euler_zyx`, `euler_zxz`, `euler_zyz`, `euler_xyz`, `euler_xzy`, `euler_yxz`, `euler_yzx`, \
    `euler_zxy`, `euler_xyx`, `euler_xzx`, `euler_yxy`, `euler_yzy`, `rodrigues` or `modified_rodrigues`";

#[test]
fn chart_values() {
    check_body("#[gauss(chart = hybird)]", &[("hybird", "unknown chart `hybird`; did you mean `hybrid`?")]);
    check_body(
        "#[gauss(chart = LeftInvariant)]",
        &[("LeftInvariant", "unknown chart `LeftInvariant`; did you mean `left_invariant`?")],
    );
    let list = "`left_invariant`, `right_invariant`, `hybrid` or `jet`";
    check_body("#[gauss(chart = polar)]", &[("polar", &format!("unknown chart `polar`; expected {list}"))]);
    check_body(
        "#[gauss(chart = \"hybrid\")]",
        &[("\"hybrid\"", "`chart` takes a bare word, not a string; write `chart = hybrid`")],
    );
    check_body(
        "#[gauss(chart = \"jet(euler_zyx)\")]",
        &[("\"jet(euler_zyx)\"", "`chart` takes a bare word, not a string; write `chart = jet(euler_zyx)`")],
    );
    check_body(
        "#[gauss(chart = 3)]",
        &[("3", &format!("`chart` takes a word, found the literal `3`; expected {list}"))],
    );
    check_body("#[gauss(chart)]", &[("chart", &format!("`chart` needs a value; write `chart = …` with {list}"))]);
    check_body("#[gauss(chart = )]", &[("=", "nothing follows `chart =`; write a value or remove the clause")]);
    check_body(
        "#[gauss(chart(hybrid))]",
        &[("(", "the value of `chart` follows `=`, without brackets; write `chart = hybrid`")],
    );
    check_body(
        "#[gauss(chart = hybrid(x))]",
        &[("(", "the chart `hybrid` takes nothing in brackets; write `chart = hybrid`")],
    );
    check_body("#[gauss(chart: hybrid)]", &[(":", "expected `=` or `,` after `chart`, found `:`")]);
    check_body(
        "#[gauss(chart = hybrid motion = free)]",
        &[("motion", "expected `,` after `chart = hybrid`, found `motion`; separate clauses by commas")],
    );
}

#[test]
fn linearize_stands_alone_or_names_more() {
    let remedy = "write `linearize` alone for the derivatives by state, time and input, and in brackets what \
                  else is wanted: `parameters` for those by the parameters, `inverse` for those of inverse dynamics, \
                  `hessian` for second ones along given weights";
    check_body("#[gauss(linearize = true)]", &[("true", &format!("`linearize` takes no value after `=`; {remedy}"))]);
    let unknown = "unknown kind of derivative `z`; expected `parameters`, `inverse`, `hessian` or `without_contacts`";
    check_body("#[gauss(linearize(z))]", &[("z", unknown)]);
    check_body("#[gauss(linearize(parameters, z))]", &[("z", unknown)]);
    let near = "unknown kind of derivative `inverted`; did you mean `inverse`?";
    check_body("#[gauss(linearize(inverted))]", &[("inverted", near)]);
    let twice = "`inverse` is named twice; keep one of the two";
    check_body("#[gauss(linearize(inverse, parameters, inverse))]", &[("inverse", twice)]);
    check_body("#[gauss(linearize())]", &[("(", "`linearize()` is empty; write `linearize(inverse)` or remove it")]);
    check_body("#[gauss(linearize(3))]", &[("3", "expected the name of a kind of derivative, found the literal `3`")]);
    check_body("#[gauss(linearise)]", &[("linearise", "unknown clause `linearise`; did you mean `linearize`?")]);
    check_body(
        "#[gauss(linearize, chart = hybrid, linearize)]",
        &[("linearize", "`linearize` is given twice; it was given first as `linearize`: keep one of the two")],
    );
}

#[test]
fn regressor_stands_alone() {
    let message = "`regressor` takes no value; write `regressor` alone, or leave it out";
    check_body("#[gauss(regressor = true)]", &[("true", message)]);
    check_body("#[gauss(regressor(m))]", &[("(", message)]);
    check_body("#[gauss(regresor)]", &[("regresor", "unknown clause `regresor`; did you mean `regressor`?")]);
}

#[test]
fn rotation_charts() {
    let jet = |argument: &str| format!("#[gauss(chart = jet({argument}))]");
    check_body(
        &jet("euler_zyy"),
        &[(
            "euler_zyy",
            "`euler_zyy` turns about y twice in a row, which is one turn; \
         expected three axes with no two neighbours equal, such as `euler_zyx` or `euler_zxz`",
        )],
    );
    check_body(&jet("euler_ZYX"), &[("euler_ZYX", "unknown rotation chart `euler_ZYX`; did you mean `euler_zyx`?")]);
    check_body(&jet("zyx"), &[("zyx", "unknown rotation chart `zyx`; did you mean `euler_zyx`?")]);
    check_body(&jet("rodriguez"), &[("rodriguez", "unknown rotation chart `rodriguez`; did you mean `rodrigues`?")]);
    check_body(
        &jet("quaternion"),
        &[("quaternion", &format!("unknown rotation chart `quaternion`; expected {ROTATIONS}"))],
    );
    check_body(
        &jet("\"euler_zyx\""),
        &[("\"euler_zyx\"", "`jet` takes a bare word, not a string; write `jet(euler_zyx)`")],
    );
    check_body(
        &jet("euler_zyx, rodrigues"),
        &[(
            ",",
            "`jet` takes one rotation chart, found `,` after `euler_zyx`; write one word, such as `jet(euler_zyx)`",
        )],
    );
    check_body(
        &jet(""),
        &[(
            "(",
            "`jet()` has nothing in its brackets; \
         write a rotation chart such as `jet(euler_zyx)`, or `jet` alone in planar motion",
        )],
    );
}

#[test]
fn jet_and_motion() {
    let message = format!("`jet` needs a rotation chart unless the motion is planar; write `jet(…)` with {ROTATIONS}");
    check_body("#[gauss(chart = jet)]", &[("jet", &message)]);
    check_body("#[gauss(chart = jet, motion = fixed_point)]", &[("jet", &message)]);
    check_body(
        "#[gauss(motion = planar, chart = jet(euler_zyx))]",
        &[(
            "euler_zyx",
            "`jet(euler_zyx)` contradicts `motion = planar`, where the body turns through one angle only; \
         write `chart = jet`",
        )],
    );
    // A misspelt motion is not also blamed for the chart.
    check_body("#[gauss(motion = planr, chart = jet)]", &[("planr", "unknown motion `planr`; did you mean `planar`?")]);
}

#[test]
fn motions() {
    check_body(
        "#[gauss(motion = fixed)]",
        &[("fixed", "unknown motion `fixed`; expected `free`, `fixed_point` or `planar`")],
    );
    check_body(
        "#[gauss(motion = \"planar\")]",
        &[("\"planar\"", "`motion` takes a bare word, not a string; write `motion = planar`")],
    );
    check_body(
        "#[gauss(motion = free())]",
        &[("(", "the motion `free` takes nothing in brackets; write `motion = free`")],
    );
}

#[test]
fn runtime_paths() {
    check_body(
        "#[gauss(crate = \"a::b\")]",
        &[("\"a::b\"", "`crate` takes the path to the runtime, found `\"a::b\"`; write `crate = a::b` without quotes")],
    );
    check_body(
        "#[gauss(crate)]",
        &[("crate", "`crate` needs the path to the runtime; write `crate = ::gauss_runtime`")],
    );
    check_body(
        "#[gauss(crate = 3)]",
        &[("3", "`crate` takes the path to the runtime, found `3`; write `crate = ::gauss_runtime`")],
    );
}

#[test]
fn clauses_given_twice() {
    check_body(
        "#[gauss(chart = hybrid, chart = jet(rodriguez))]",
        &[
            ("chart", "`chart` is given twice; it was given first as `chart = hybrid`: keep one of the two"),
            ("rodriguez", "unknown rotation chart `rodriguez`; did you mean `rodrigues`?"),
        ],
    );
    check_body(
        "#[gauss(chart = hybrid)] #[gauss(motion = free, chart = jet(euler_zyx))]",
        &[("chart", "`chart` is given twice; it was given first as `chart = hybrid`: keep one of the two")],
    );
    check_body(
        "#[gauss(motion = planar, motion = plnar)]",
        &[
            ("motion", "`motion` is given twice; it was given first as `motion = planar`: keep one of the two"),
            ("plnar", "unknown motion `plnar`; did you mean `planar`?"),
        ],
    );
}

#[test]
fn struct_clauses() {
    check_body("#[gauss(char = hybrid)]", &[("char", "unknown clause `char`; did you mean `chart`?")]);
    check_body("#[gauss(foo = 1)]", &[("foo", &format!("unknown clause `foo`; {ALL_CLAUSES}"))]);
    check_body("#[gauss(hybrid)]", &[("hybrid", "`hybrid` is a chart; write `chart = hybrid`")]);
    check_body("#[gauss(jet(euler_zyx))]", &[("jet", "`jet` is a chart; write `chart = jet(euler_zyx)`")]);
    check_body("#[gauss(jet = euler_zyx)]", &[("jet", "`jet` is a chart; write `chart = jet(euler_zyx)`")]);
    check_body("#[gauss(planar)]", &[("planar", "`planar` is a motion; write `motion = planar`")]);
    check_body(
        "#[gauss(rodrigues)]",
        &[("rodrigues", "`rodrigues` is a rotation chart; write `chart = jet(rodrigues)`")],
    );
    check_body(
        "#[gauss(mass)]",
        &[("mass", "`mass` is the role of a field; write `#[gauss(mass)]` on that field, or give it here: `mass = …`")],
    );
    check_body(
        "#[gauss(coordinate(x))]",
        &[("coordinate", "unknown clause `coordinate`; did you mean `coordinates`?")],
    );
    check_body("#[gauss(dampng(x))]", &[("dampng", "unknown clause `dampng`; did you mean `damping`?")]);
}

#[test]
fn attribute_forms() {
    check_body(
        "#[gauss()]",
        &[("gauss", "`#[gauss()]` is empty; write a clause such as `chart = hybrid` or remove it")],
    );
    check_body(
        "#[gauss]",
        &[("gauss", "`#[gauss]` is empty; write `#[gauss(…)]` with a clause such as `chart = hybrid` or remove it")],
    );
    check_body(
        "#[gauss = \"chart = hybrid\"]",
        &[("gauss", "`gauss` takes its clauses in brackets, not after `=`; write `#[gauss(chart = hybrid)]`")],
    );
    check_body(
        "#[gauss[chart = hybrid]]",
        &[("gauss", "`gauss` takes round brackets; write `#[gauss(…)]` with a clause such as `chart = hybrid`")],
    );
    check_body("#[gauss(,)]", &[(",", "expected a clause such as `chart = hybrid` before `,`")]);
    check_body(
        "#[gauss(\"chart\")]",
        &[("\"chart\"", "`gauss` takes words, found \"chart\"; write `#[gauss(chart)]` without quotes")],
    );
    check_body("#[gauss(7)]", &[("7", "`gauss` takes words, found 7; write a clause such as `chart = hybrid`")]);
    check(&with("#[gauss()] k: f64"), &[("gauss", "`#[gauss()]` is empty; write a role such as `mass` or remove it")]);
}

/// Clauses of loads make no system of their struct, and are told to stand above it, not at a field.
#[test]
fn clauses_of_what_acts() {
    for word in [
        "input",
        "force",
        "torque",
        "wrench",
        "spring",
        "stop",
        "drag",
        "define",
        "medium",
        "central_gravity",
        "damping",
    ] {
        let form = if word == "damping" { "damping = …".into() } else { format!("{word}(…)") };
        check(
            &format!("struct Scene {{ #[gauss(mass)] m: f64, #[gauss(inertia)] j: f64, #[gauss({word})] k: f64 }}"),
            &[(
                word,
                &format!("`{word}` is a clause of the struct, not of a field; write `#[gauss({form})]` above `struct`"),
            )],
        );
    }
    check(
        "#[gauss(force(at = [0, 0, 0], value = [k, 0, 0]))] struct Scene { k: f64 }",
        &[
            (
                "Scene",
                "`Scene` has no field with the role `mass`, which every body needs; add `#[gauss(mass)] mass: f64`",
            ),
            (
                "Scene",
                "`Scene` has no field with the role `inertia`, which every body needs; \
                 add `#[gauss(inertia)] inertia: Vector3<f64>`",
            ),
        ],
    );
    check_body(
        "#[gauss(damping = k * x, chart = hybird)]",
        &[
            ("hybird", "unknown chart `hybird`; did you mean `hybrid`?"),
            (
                "k",
                "unknown name `k`; declare it by `input(k)` if it arrives at run time, or write a field (`m` or `j`), \
                 a body (`body`) or `t`",
            ),
            (
                "x",
                "unknown name `x`; declare it by `input(x)` if it arrives at run time, or write a field (`m` or `j`), \
                 a body (`body`) or `t`",
            ),
        ],
    );
}

#[test]
fn python_stands_alone_and_has_one_scalar() {
    check_body("#[gauss(python = yes)]", &[("yes", "`python` takes no value; write `python` alone, or leave it out")]);
    let mistakes = |source: &str| {
        let input: syn::DeriveInput = syn::parse_str(source).expect("a struct");
        let error = crate::model::parse(&input).err().expect("a mistake");
        error.into_iter().map(|error| error.to_string()).collect::<Vec<_>>()
    };
    let single = "#[gauss(python)] struct Ball { #[gauss(mass)] m: f32, #[gauss(inertia)] i: f32 }";
    assert_eq!(mistakes(single), ["`python` computes in `f64`; write the fields in `f64` or in a type parameter `T`"]);
    let two = "#[gauss(python)] struct Ball<T, U> { #[gauss(mass)] m: T, #[gauss(inertia)] i: T, other: U }";
    assert_eq!(mistakes(two), ["with `python` the scalar is the only type parameter; `U` is none"]);
}
