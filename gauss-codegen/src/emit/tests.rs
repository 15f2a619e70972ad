//! The generated code: what a few kernels look like, and what none of them contains.

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};
use quote::quote;

use crate::expand::{expand, expand_without_vectors};
use crate::terms::Scalar;

use crate::emit::derived::PRIVATE;
use crate::emit::dialect::program::ScalarTokens;

pub fn generate(source: &str) -> TokenStream {
    let input = syn::parse_str(source).expect("a struct");
    expand(&input).expect("a body")
}

pub fn pretty(source: &str) -> String {
    // Without the version, which is no part of what is looked at.
    let code = with_both_forms_as_code(generate(source)).to_string().replace(PRIVATE, "__private");
    prettyplease::unparse(&syn::parse_str(&code).expect("generated code is Rust"))
}

/// `with_vectors! { {…} {…} }` as a call of two blocks, which is printed line by line.
fn with_both_forms_as_code(code: TokenStream) -> TokenStream {
    let mut written: Vec<TokenTree> = Vec::new();
    for token in code {
        let is_of_the_macro = written.len() > 1
            && matches!(&written[written.len() - 2], TokenTree::Ident(name) if name == "with_vectors");
        let next = match token {
            TokenTree::Group(group) if is_of_the_macro => {
                written.pop();
                let blocks = group.stream().into_iter();
                Group::new(Delimiter::Parenthesis, quote!(#(#blocks),*)).into()
            }
            TokenTree::Group(group) => Group::new(group.delimiter(), with_both_forms_as_code(group.stream())).into(),
            other => other,
        };
        written.push(next);
    }
    written.into_iter().collect()
}

/// The body of one generated function.
pub fn function(source: &str, name: &str) -> String {
    let code = pretty(source);
    let start = code.find(&format!("fn {name}(")).expect("the function is there");
    let end = code[start..].find("\n        }\n").expect("it ends");
    code[start..start + end + 11].replace("\n        ", "\n")
}

const FREE: &str = "#[gauss(chart = left_invariant)] struct Body {
    #[gauss(mass)] mass: f64,
    #[gauss(inertia)] inertia: Vector3<f64>,
}";

const TOP: &str = "#[gauss(motion = fixed_point, chart = jet(euler_zxz))] struct Top<T> {
    #[gauss(mass)] mass: T,
    #[gauss(center_of_mass)] center: Vector3<T>,
    #[gauss(inertia)] inertia: Vector3<T>,
    #[gauss(gravity)] g: T,
}";

const VEHICLE: &str = "#[gauss(chart = hybrid)] pub struct Vehicle {
    #[gauss(mass)] mass: f64,
    #[gauss(center_of_mass)] center: Vector3<f64>,
    #[gauss(inertia)] inertia: Matrix3<f64>,
    #[gauss(added_mass)] added: Matrix6<f64>,
    #[gauss(gravity)] g: Vector3<f64>,
    #[gauss(displaced_mass)] displaced: f64,
}";

#[test]
fn acceleration_of_a_heavy_top_in_euler_angles() {
    insta::assert_snapshot!(function(TOP, "acceleration"));
}

/// Products of series become lanes, sums of the rest are trees.
#[test]
fn power_series_of_a_free_top() {
    let source = "#[gauss(motion = fixed_point, taylor)] struct Top {
        #[gauss(mass)] mass: f64,
        #[gauss(inertia)] inertia: Vector3<f64>,
    }";
    insta::assert_snapshot!(function(source, "expand"));
}

fn words(tokens: TokenStream, found: &mut Vec<String>) {
    for token in tokens {
        match token {
            TokenTree::Group(group) => words(group.stream(), found),
            TokenTree::Ident(ident) => found.push(ident.to_string()),
            TokenTree::Punct(_) | TokenTree::Literal(_) => {}
        }
    }
}

/// Targets without vectors have no form for them, nor is one looked for; all else is the same.
#[test]
fn without_vectors_there_is_one_form() {
    let input = syn::parse_str(VEHICLE).expect("a struct");
    let [mut both, mut one] = [Vec::new(), Vec::new()];
    words(expand(&input).expect("a body"), &mut both);
    words(expand_without_vectors(&input).expect("a body"), &mut one);
    for word in ["with_vectors", "Rows", "rows", "packs"] {
        assert!(both.iter().any(|found| found == word) && one.iter().all(|found| found != word), "{word}");
    }
    let functions = |words: &[String]| words.iter().filter(|word| *word == "fn").count();
    assert_eq!(functions(&both), functions(&one));
}

#[test]
fn generated_code_is_straight_and_safe() {
    let charts = ["left_invariant", "right_invariant", "hybrid", "jet(euler_zyx)", "jet(modified_rodrigues)"];
    for source in [FREE, VEHICLE] {
        for chart in charts {
            let source = source.replacen("left_invariant", chart, 1).replacen("= hybrid", &format!("= {chart}"), 1);
            let mut found = Vec::new();
            words(generate(&source), &mut found);
            assert!(found.contains(&"acceleration".to_owned()));
            for forbidden in
                ["unsafe", "loop", "while", "if", "match", "Vec", "Box", "std", "unwrap", "expect", "panic"]
            {
                assert!(!found.contains(&forbidden.to_owned()), "`{forbidden}` in {chart}");
            }
            // `for` stands only in `impl … for`: all but those of the struct, its state and its places.
            let loops = found.iter().filter(|w| *w == "for").count();
            assert_eq!(loops, found.iter().filter(|w| *w == "impl").count() - 3, "{chart}");
        }
    }
}

#[test]
fn a_mistake_is_one_message_and_no_code() {
    let input =
        syn::parse_str("#[gauss(chart = left_invarient)] struct Body { #[gauss(mass)] m: f64 }").expect("a struct");
    let messages: Vec<String> = expand(&input).expect_err("two mistakes").into_iter().map(|e| e.to_string()).collect();
    assert_eq!(messages.len(), 2, "{messages:?}");
}

/// Literals alone become the numbers themselves, divided and multiplied out.
#[test]
fn acceleration_of_a_body_of_literals() {
    let source = "#[gauss(mass = 2.5, center_of_mass = [0, 0, 0.125], inertia = [0.5, 0.5, 0.34375], gravity = 9.80665)] struct Body {}";
    insta::assert_snapshot!(function(source, "acceleration"));
}

#[test]
fn literals_read_back_as_what_they_are() {
    let scalar = |scalar: &'static Scalar| ScalarTokens {
        scalar,
        real: TokenStream::new(),
        fma: TokenStream::new(),
        apart: TokenStream::new(),
        functions: &[],
    };
    // Steps of an odd number run through exponents and mantissas alike.
    let bits = (0..10_000_u64).map(|k| k.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    for value in bits.map(f64::from_bits).filter(|value| value.is_finite()) {
        let text = scalar(&Scalar::F64).literal(value).to_string().replace(['(', ')', ' '], "");
        let number = text.trim_end_matches("f64").parse::<f64>().expect("a number");
        assert_eq!(number.to_bits(), value.to_bits(), "{text}");
        let narrow = value as f32;
        if narrow.is_finite() {
            let text = scalar(&Scalar::F32).literal(value).to_string().replace(['(', ')', ' '], "");
            assert_eq!(
                text.trim_end_matches("f32").parse::<f32>().expect("a number").to_bits(),
                narrow.to_bits(),
                "{text}"
            );
        }
    }
}

/// A struct that asks for no Python has no word of it; one that does has the same code, and one call of a macro more.
#[test]
fn python_is_one_call_more() {
    let scene = |clause: &str| {
        format!(
            "/// Swings.\n#[gauss({clause} coordinates(a), frames(rod), body(rod, rotation = rotation_y(a), mass = m, inertia = 1), \
             input(motor = \"N m\"), drive(a = motor))] struct Swing<T> {{ #[gauss(unit = \"kg\")] m: T }}"
        )
    };
    let expanded = |clause: &str| {
        let input: syn::DeriveInput = syn::parse_str(&scene(clause)).expect("a struct");
        crate::expand::expand(&input).expect("a scene").to_string()
    };
    let (without, with) = (expanded(""), expanded("python,"));
    let call = with.strip_prefix(&without).expect("the same code first");
    let expected = ":: gauss_python :: scene ! { scene Swing [T] \"Swings.\" ; kernel SwingKernel ; state SwingState ; \
         fields { m [T] \"m\" \"kg\" \"\" ; } coordinates { \"a\" 1 0 \"coordinate\" ; } \
         speeds { \"a_dot\" 1 0 \"rate of `a`\" ; } inputs { \"motor\" 1 0 \"input, in N m\" ; } offers { frames } \
         steps { } remarks { } }";
    assert_eq!(call.split_whitespace().collect::<Vec<_>>(), expected.split_whitespace().collect::<Vec<_>>());
}

/// The compiler prints the name of what a warning is about: that of the struct, and what the matter is.
#[cfg(feature = "urdf")]
#[test]
fn warnings_of_a_file_name_the_struct() {
    let file = std::env::temp_dir().join(format!("gauss_warnings_{}.urdf", std::process::id()));
    let (base, inertial) = (
        r#"<link name="base"/>"#,
        r#"<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>"#,
    );
    let joint = r#"<parent link="base"/><child link="arm"/><axis xyz="0 1 0"/><dynamics friction="0.2"/>"#;
    let robot = format!(
        r#"<robot name="r">{base}<link name="arm">{inertial}</link><joint name="j" type="continuous">{joint}</joint></robot>"#
    );
    std::fs::write(&file, robot).expect("a folder for files of a moment");
    let code = |clauses: &str| {
        let source = format!("#[gauss(urdf = {:?}{clauses})] struct Arm;", file.display().to_string());
        generate(&source).to_string()
    };
    let told = code("");
    assert!(told.contains("impl Arm where"), "{told}");
    assert!(told.contains("const NOT_IN_THE_EQUATIONS : () = () ;"), "{told}");
    assert!(told.contains("Self :: NOT_IN_THE_EQUATIONS"), "{told}");
    assert!(!code(", joint_friction = none").contains("NOT_IN_THE_EQUATIONS"));
    std::fs::remove_file(file).expect("it is there");
}
