//! Loops that stay in a plane, whatever that plane is: what they say across it says nothing, and is left out.

#![cfg(feature = "mjcf")]

use gauss_codegen::Derivation;

const GRAVITY: f64 = 9.81;

/// Two cranks of 0.5 m side by side on what `trunk` opens, joined by a rod of 0.4 m.
fn linkage(trunk: &str, equality: &str) -> String {
    format!(
        "<mujoco><option gravity=\"0 0 -{GRAVITY}\"/><compiler angle=\"radian\"/>\n\
         <worldbody><body name=\"trunk\" {trunk}<geom type=\"box\" size=\"0.2 0.1 0.05\"/>\n\
         <body name=\"a\"><joint name=\"ja\" axis=\"0 1 0\"/>\
         <geom type=\"capsule\" fromto=\"0 0 0 0 0 0.5\" size=\"0.03\"/>\n\
         <body name=\"b\" pos=\"0 0 0.5\"><joint name=\"jb\" axis=\"0 1 0\"/>\n\
         <geom type=\"capsule\" fromto=\"0 0 0 0.4 0 0\" size=\"0.03\"/></body></body>\n\
         <body name=\"c\" pos=\"0.4 0 0\"><joint name=\"jc\" axis=\"0 1 0\"/>\n\
         <geom type=\"capsule\" fromto=\"0 0 0 0 0 0.5\" size=\"0.03\"/></body></body></worldbody>\n\
         <equality>\n{equality}</equality></mujoco>"
    )
}

const CLOSED: &str = "<connect body1=\"b\" body2=\"c\" anchor=\"0.4 0 0\"/>";

/// What is derived of a file with this text.
fn derived(name: &str, text: &str) -> Result<Derivation, String> {
    let path = std::env::temp_dir().join(format!("gauss_loops_{}_{name}.xml", std::process::id()));
    std::fs::write(&path, text).expect("a temporary file");
    let source = format!("#[gauss(mjcf = {path:?}, inputs = none)] struct Linkage;");
    let derivation = Derivation::new(&syn::parse_str(&source).expect("a struct"));
    std::fs::remove_file(&path).expect("it is there");
    derivation.map_err(|error| error.to_string().replace(&*path.to_string_lossy(), "FILE"))
}

/// What a method gives at rest.
fn values(derivation: &Derivation, name: &str, q: &[f64]) -> Vec<f64> {
    let constants = derivation.constants().run::<f64>(&[&[]]).expect("constants");
    let program = derivation.program(name).expect(name);
    let zeros = [0.0; 9];
    let arguments: Vec<&[f64]> = program
        .arguments
        .iter()
        .map(|argument| match argument.components.len() {
            _ if argument.components.first().is_some_and(|name| name == "t") => &zeros[..1],
            n if argument.components.iter().any(|name| name == "ja") => &q[..n],
            n if argument.kind == gauss_codegen::program::ArgumentKind::Constants => &constants[..n],
            n => &zeros[..n],
        })
        .collect();
    program.run(&arguments).expect(name)
}

/// The cranks stay parallel: J has no third row that vanishes where the loop is closed, and on a body that falls
/// nothing in it moves.
#[test]
fn on_a_body_that_moves() {
    let linkage = derived("free", &linkage("><freejoint name=\"root\"/>", CLOSED)).expect("derived");
    for q in [
        [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [0.5, -0.5, 0.5, 0.5, 1.0, 2.0, 3.0, 0.4, -0.4, 0.4],
        [0.1, 0.7, 0.1, 0.7, 0.0, 0.0, 0.0, -0.3, 0.3, -0.3],
    ] {
        let residual = values(&linkage, "position_residual", &q);
        assert!(residual.len() == 2 && residual.iter().all(|x| x.abs() < 1e-15), "{residual:?}");
        let rates = values(&linkage, "acceleration", &q);
        let fall = rates[..3].iter().map(|a| a * a).sum::<f64>().sqrt();
        // Some hundred sums of terms of about 10.
        assert!((fall - GRAVITY).abs() < 1e-12 && rates[3..].iter().all(|a| a.abs() < 1e-12), "{rates:?}");
    }
}

/// A plane along no axis of the observer: of three components one follows from the others, to rounding alone.
#[test]
fn across_the_axes() {
    let upright = derived("upright", &linkage(">", CLOSED)).expect("derived");
    let tilted = derived("tilted", &linkage("euler=\"0.3 -0.4 0.5\">", CLOSED)).expect("derived");
    for linkage in [&upright, &tilted] {
        let residual = values(linkage, "position_residual", &[0.4, -0.4, 0.4]);
        assert!(residual.len() == 2 && residual.iter().all(|x| x.abs() < 1e-15), "{residual:?}");
        assert!(values(linkage, "acceleration", &[0.4, -0.4, 0.4]).iter().all(|a| a.is_finite()));
    }
    // Nothing but the plane's height against the weight is different: turned about the vertical nothing is.
    let turned = derived("turned", &linkage("euler=\"0 0 0.7\">", CLOSED)).expect("derived");
    let both = [&upright, &turned].map(|linkage| values(linkage, "acceleration", &[0.4, -0.4, 0.4]));
    assert!(both[0].iter().zip(&both[1]).all(|(a, b)| (a - b).abs() < 1e-12 * (1.0 + a.abs())), "{both:?}");
}

/// In a plane a rod that is welded turns with the other; what a file says twice holds once, and what contradicts is
/// told in its line.
#[test]
fn welds_and_what_is_said_twice() {
    let weld = "<weld body1=\"b\" body2=\"c\"/>";
    let welded = derived("welded", &linkage(">", weld)).expect("derived");
    assert_eq!(values(&welded, "position_residual", &[0.0; 3]).len(), 3);
    let twice = derived("twice", &linkage(">", &format!("{CLOSED}\n{CLOSED}"))).expect("derived");
    assert_eq!(values(&twice, "position_residual", &[0.0; 3]).len(), 2);
    let polynomial = "<joint joint1=\"ja\" joint2=\"jb\" polycoef=\"0 1 1 0 0\"/>\n";
    let against = polynomial.replace("\"0 1 1", "\"0.5 1 1");
    let message = derived("against", &linkage(">", &(polynomial.to_owned() + &against))).expect_err("contradicts");
    assert!(message.starts_with("FILE:10:1: no motion satisfies this constraint"), "{message}");
}
