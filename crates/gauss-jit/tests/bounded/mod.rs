//! Programs in numbers that bound their own rounding.

use std::ops::{Add, Div, Mul, Neg, Sub};

use gauss_bounded::Bounded;
use gauss_codegen::program::{BinaryFunction, Function, Program, Rational, Scalar};
use gauss_runtime::prelude::Real;

/// A number of double precision with a bound on its distance from what exact arithmetic gives.
#[derive(Clone)]
struct Number(Bounded<f64>);

macro_rules! operators {
    ($($operator:ident $name:ident)+) => {$(
        impl $operator for Number {
            type Output = Self;

            fn $name(self, other: Self) -> Self {
                Self(self.0.$name(other.0))
            }
        }
    )+};
}

operators! { Add add Sub sub Mul mul Div div }

impl Neg for Number {
    type Output = Self;

    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Scalar for Number {
    fn number(value: f64) -> Self {
        Self(Bounded::exact(value))
    }

    fn fraction(value: Rational) -> Self {
        let number = value.to_f64();
        Self(if value.is_dyadic() { Bounded::exact(number) } else { Bounded::rounded(number) })
    }

    fn sine_cosine(self) -> (Self, Self) {
        let (sine, cosine) = self.0.sin_cos();
        (Self(sine), Self(cosine))
    }

    fn call(self, function: Function) -> Self {
        Self(match function {
            Function::Sin => self.0.sin(),
            Function::Cos => self.0.cos(),
            Function::Exp => self.0.exp(),
            Function::Ln => self.0.ln(),
            Function::Sqrt => self.0.sqrt(),
            Function::Abs => self.0.abs(),
            Function::Signum => self.0.signum(),
            Function::Tanh => self.0.tanh(),
        })
    }

    fn call_with(self, function: BinaryFunction, other: Self) -> Self {
        Self(match function {
            BinaryFunction::Atan2 => self.0.atan2(other.0),
            BinaryFunction::Min => self.0.min(other.0),
            BinaryFunction::Max => self.0.max(other.0),
            BinaryFunction::Powf => self.0.powf(other.0),
        })
    }
}

/// The outputs in double precision, every product rounded before anything is added to it, each with the bound on its
/// rounding. What rounds less often, as with products that are fused, is within the same bound.
#[allow(dead_code, reason = "each test needs one of the two")]
pub fn outputs(program: &Program, arguments: &[&[f64]]) -> Vec<(f64, f64)> {
    numbers(program, &arguments.iter().map(|list| exact(list)).collect::<Vec<_>>()).into_iter().map(parts).collect()
}

/// The same of a method from the numbers of the parameters on: constants, then `arguments`.
#[allow(dead_code, reason = "each test needs one of the two")]
pub fn of_parameters(
    constants: &Program,
    parameters: &[f64],
    method: &Program,
    arguments: &[&[f64]],
) -> Vec<(f64, f64)> {
    let constants = numbers(constants, &[exact(parameters)]);
    let all: Vec<_> = std::iter::once(constants).chain(arguments.iter().map(|list| exact(list))).collect();
    numbers(method, &all).into_iter().map(parts).collect()
}

fn parts(Number(x): Number) -> (f64, f64) {
    (x.value, x.bound)
}

fn exact(list: &[f64]) -> Vec<Number> {
    list.iter().map(|&x| Number(Bounded::exact(x))).collect()
}

fn numbers(program: &Program, lists: &[Vec<Number>]) -> Vec<Number> {
    let lists: Vec<&[Number]> = lists.iter().map(Vec::as_slice).collect();
    program.run(&lists).expect("its arguments")
}
