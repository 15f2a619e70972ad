//! The public face as other crates use it: programs run on other numbers, written and read, refused when malformed, and
//! in C.

mod c;
#[path = "../common/mod.rs"]
mod common;
mod cpp;
mod derivatives;
mod loops;
mod poles;
mod printing;
mod rust;
mod scene;
mod without_value;

use std::ops::{Add, Div, Mul, Neg, Sub};

use common::{Random, SCENES, close, derivation, random_arguments};
use gauss_codegen::program::{
    ArgumentKind, BinaryFunction, Code, Function, Instruction, Malformed, Operand, Program, Rational, Scalar,
};
use gauss_codegen::{Derivation, Notation};

/// A value and its derivative: what the interpreter needs of a scalar in twenty lines.
#[derive(Clone, Copy)]
struct Dual {
    value: f64,
    slope: f64,
}

fn dual(value: f64, slope: f64) -> Dual {
    Dual { value, slope }
}

impl Add for Dual {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        dual(self.value + other.value, self.slope + other.slope)
    }
}

impl Sub for Dual {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        dual(self.value - other.value, self.slope - other.slope)
    }
}

impl Mul for Dual {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        dual(self.value * other.value, self.slope * other.value + self.value * other.slope)
    }
}

impl Div for Dual {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        dual(value, (self.slope - value * other.slope) / other.value)
    }
}

impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        dual(-self.value, -self.slope)
    }
}

impl Scalar for Dual {
    fn number(value: f64) -> Self {
        dual(value, 0.0)
    }

    fn fraction(value: Rational) -> Self {
        dual(value.to_f64(), 0.0)
    }

    fn sine_cosine(self) -> (Self, Self) {
        let (sine, cosine) = self.value.sin_cos();
        (dual(sine, self.slope * cosine), dual(cosine, -self.slope * sine))
    }

    fn call(self, function: Function) -> Self {
        let value = self.value.call(function);
        let slope = match function {
            Function::Exp => value,
            Function::Ln => 1.0 / self.value,
            Function::Sqrt => 0.5 / value,
            Function::Abs => self.value.signum(),
            Function::Tanh => 1.0 - value * value,
            _ => 0.0,
        };
        dual(value, self.slope * slope)
    }

    fn call_with(self, function: BinaryFunction, other: Self) -> Self {
        match function {
            BinaryFunction::Atan2 => {
                let (y, x) = (self, other);
                let square = x.value * x.value + y.value * y.value;
                dual(y.value.atan2(x.value), (y.slope * x.value - x.slope * y.value) / square)
            }
            BinaryFunction::Powf => {
                let (x, p, power) = (self.value, other.value, self.value.powf(other.value));
                dual(power, self.slope * p * x.powf(p - 1.0) + other.slope * power * x.ln())
            }
            BinaryFunction::Min if other.value < self.value => other,
            BinaryFunction::Max if other.value > self.value => other,
            _ => self,
        }
    }
}

/// Derivatives by the speeds, once from the program that computes them and once by dual numbers through that of the
/// accelerations.
#[test]
fn dual_numbers_run_through_programs() {
    for name in ["Arms", "Vehicle"] {
        let derivation = derivation(name);
        let [acceleration, linearize] = ["acceleration", "linearize"].map(|m| derivation.program(m).expect("derived"));
        let arguments = random_arguments(&derivation, acceleration, &mut Random(7));
        let lists: Vec<&[f64]> = arguments.iter().map(Vec::as_slice).collect();
        let derivatives = linearize.run(&lists).expect("its arguments");
        let speeds = acceleration.arguments.iter().position(|a| a.kind == ArgumentKind::Speeds).expect("speeds");
        let n = arguments[speeds].len();
        let (states, height) = (linearize.results[1].columns, linearize.results[0].rows);
        for k in 0..n {
            let moved = |(argument, list): (usize, &Vec<f64>)| -> Vec<Dual> {
                let slope = |i: usize| if (argument, i) == (speeds, k) { 1.0 } else { 0.0 };
                list.iter().enumerate().map(|(i, &value)| dual(value, slope(i))).collect()
            };
            let duals: Vec<Vec<Dual>> = arguments.iter().enumerate().map(moved).collect();
            let duals: Vec<&[Dual]> = duals.iter().map(Vec::as_slice).collect();
            for (i, rate) in acceleration.run(&duals).expect("its arguments").iter().enumerate() {
                // `rate`, then `by_state` row by row; the accelerations and the speeds are the last of the states.
                let expected = derivatives[height + states * (height - n + i) + states - n + k];
                assert!(close(rate.slope, expected), "{name}: row {i}, speed {k}: {} and {expected}", rate.slope);
            }
        }
    }
}

#[test]
fn single_precision_runs_through_programs() {
    let derivation = derivation("Torpedo");
    let program = derivation.program("acceleration").expect("derived");
    let arguments = random_arguments(&derivation, program, &mut Random(3));
    let lists: Vec<&[f64]> = arguments.iter().map(Vec::as_slice).collect();
    let narrow: Vec<Vec<f32>> = arguments.iter().map(|list| list.iter().map(|&x| x as f32).collect()).collect();
    let narrow: Vec<&[f32]> = narrow.iter().map(Vec::as_slice).collect();
    let (wide, narrow) = (program.run(&lists).expect("arguments"), program.run(&narrow).expect("arguments"));
    for (a, b) in wide.iter().zip(&narrow) {
        // Two hundred roundings of single precision.
        assert!((a - f64::from(*b)).abs() <= 1e-4 * (1.0 + a.abs()), "{a} {b}");
    }
}

#[test]
fn arguments_of_other_sizes_are_refused() {
    let derivation = derivation("Top");
    let program = derivation.program("acceleration").expect("derived");
    let error = program.run::<f64>(&[&[1.0]]).expect_err("one list instead of five");
    assert_eq!(error.found, [1]);
    assert_eq!(error.expected.len(), program.arguments.len());
}

#[test]
fn a_program_as_text() {
    insta::assert_snapshot!(derivation("Top").program("acceleration").expect("derived"));
}

#[test]
fn what_computes_the_constants_as_text() {
    insta::assert_snapshot!(derivation("Top").constants());
}

#[test]
fn equations_are_those_of_the_kernel() {
    let derivation = derivation("Top");
    assert!(derivation.equations(Notation::Text).starts_with("Top: chart left_invariant, motion fixed_point"));
    assert!(derivation.equations(Notation::Latex).starts_with("\\begin{align*}"));
    assert!(derivation.rust().expect("code").to_string().contains("struct TopKernel"));
}

/// Every program of every scene has the right shape, and what spoils it is found.
#[test]
fn malformed_programs_are_refused() {
    for (name, _) in SCENES {
        let derivation = derivation(name);
        for program in derivation.programs() {
            assert_eq!(program.verify(), Ok(()), "{name}");
            let with = |pass: &dyn Fn(Code) -> Code| program.clone().with_code(pass).map(|_: Program| ());
            let count = program.code.instructions.len();
            let longer = |instruction: Instruction| {
                move |mut code: Code| {
                    code.instructions.push(instruction);
                    code
                }
            };
            let one = Operand::Number(Rational::one());
            assert_eq!(with(&longer(Instruction::Negate(one))), Err(Malformed::Idle(count)));
            assert_eq!(with(&longer(Instruction::Call(Function::Sin, one))), Err(Malformed::LoneSine(count)));
            let ahead = Instruction::Negate(Operand::Value(count));
            let expected = Malformed::NotComputed { reader: Some(count), read: count };
            assert_eq!(with(&longer(ahead)), Err(expected));
            let fewer = |_: Code| Code::nothing();
            let sizes = program.results.iter().map(|result| result.len()).sum();
            assert_eq!(with(&fewer), Err(Malformed::Outputs { expected: sizes, found: 0 }));
        }
    }
}

#[test]
fn a_pass_keeps_the_values() {
    let derivation = derivation("Vehicle");
    for program in derivation.programs() {
        let arguments = random_arguments(&derivation, program, &mut Random(5));
        let lists: Vec<&[f64]> = arguments.iter().map(Vec::as_slice).collect();
        let passed = program.clone().with_code(Code::with_signs_led_back).expect("of right shape");
        assert_eq!(program.run(&lists), passed.run(&lists), "{}", program.name);
    }
}

#[test]
fn structs_are_found_by_name() {
    let source = format!("mod inner {{ #[derive(GaussDynamics)] {} }}", SCENES[0].1);
    assert!(Derivation::of_source(&source, SCENES[0].0).is_ok());
    let error = Derivation::of_source(&source, "Nobody").expect_err("there is none");
    assert!(error.to_string().contains("no struct `Nobody`"));
    assert!(Derivation::of_source("struct Empty { #[gauss(mess)] m: f64 }", "Empty").is_err());
}
