//! Programs in C++, compiled and run beside the interpreter. Where there is no compiler there is nothing to test.

use std::process::Command;

use gauss_codegen::{Derivation, targets};

use crate::c::Language;
use crate::common::{close, derivation};

const CPP: Language = Language {
    compilers: &["c++", "g++", "clang++"],
    flags: &["-std=c++17", "-ffp-contract=off"],
    ending: "cpp",
    between: "::",
    number: "double",
};

fn source(derivation: &Derivation) -> String {
    // The warning is for files that are no headers.
    targets::cpp::source(derivation.functions()).replace("#pragma once\n", "")
}

#[test]
fn functions_in_cpp_compute_what_the_programs_say() {
    CPP.agrees::<f64>(source, close);
}

#[test]
fn templates_of_floats_have_the_bits_of_the_programs() {
    Language { number: "float", ..CPP }.agrees::<f32>(source, |found, expected| found == expected);
}

/// Numbers that carry a derivative, which a scene knows nothing of; in `std::array`, with places by name.
const DUAL: &str = r"
#include <array>
#include <cstdio>

struct Dual { double v, d; Dual(double value = 0.0, double slope = 0.0) : v(value), d(slope) {} };
Dual operator+(Dual a, Dual b) { return {a.v + b.v, a.d + b.d}; }
Dual operator-(Dual a, Dual b) { return {a.v - b.v, a.d - b.d}; }
Dual operator-(Dual a) { return {-a.v, -a.d}; }
Dual operator*(Dual a, Dual b) { return {a.v * b.v, a.v * b.d + a.d * b.v}; }
Dual operator/(Dual a, Dual b) { return {a.v / b.v, (a.d - a.v / b.v * b.d) / b.v}; }
Dual sin(Dual a) { return {std::sin(a.v), std::cos(a.v) * a.d}; }
Dual cos(Dual a) { return {std::cos(a.v), -std::sin(a.v) * a.d}; }

int main()
{
    namespace q_place = swing::q_place;
    std::array<Dual, swing::parameters_place::count> parameters{};
    parameters[swing::parameters_place::m_] = 2.0;
    parameters[swing::parameters_place::l_] = 0.5;
    parameters[swing::parameters_place::g_] = 9.81;
    std::array<Dual, swing::k_place::count> k{};
    swing::kernel(parameters, k);
    std::array<Dual, q_place::count> q{};
    q[q_place::angle_] = Dual(0.3, 1.0);
    const std::array<Dual, swing::z_place::count> z{};
    // The only result is a number.
    const Dual acceleration = swing::acceleration(k, Dual(0.0), q, z);
    std::printf(ROW, acceleration.v, acceleration.d);
    return 0;
}
";

#[test]
fn types_of_ones_own_carry_derivatives_through() {
    let swing = "#[gauss(coordinates(angle), particle(mass = m, position = [l*sin(angle), 0, -l*cos(angle)]))] \
                 struct Swing { m: f64, l: f64, #[gauss(gravity)] g: f64 }";
    let swing = Derivation::of_source(swing, "Swing").expect("a scene");
    let main = DUAL.replace("ROW", r#""%.17g %.17g\n""#);
    let Some(binary) = CPP.compiled("swing_dual", &(source(&swing) + &main)) else {
        return;
    };
    let output = Command::new(binary).output().expect("it runs");
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let found: Vec<f64> = text.split_whitespace().map(|number| number.parse().expect("a number")).collect();
    let exact = [-9.81 / 0.5 * 0.3_f64.sin(), -9.81 / 0.5 * 0.3_f64.cos()];
    assert!(found.iter().zip(exact).all(|(found, exact)| close(*found, exact)), "{found:?}, {exact:?}");
}

/// A scene whose name is a word of the language, functions of the user's own, and what the header looks like.
#[test]
fn a_header_in_cpp() {
    let wing = "#[gauss(coordinates(x), particle(mass = m, position = [x, 0, 0]), potential = liftCurve(x), \
                function(liftCurve = aero::lift, derivative = aero::slope))] struct Double { m: f64 }";
    let wing = Derivation::of_source(wing, "Double").expect("a scene");
    let code = targets::cpp::source(wing.functions());
    assert!(code.contains("namespace double_ {"), "{code}");
    assert!(code.contains("template <class Scalar>\nScalar lift_curve_1(Scalar x);\n"), "{code}");
    insta::assert_snapshot!(targets::cpp::source(derivation("Top").functions()));
}
