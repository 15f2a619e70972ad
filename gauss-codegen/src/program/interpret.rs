//! The interpreter: a program run on any numbers.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::algebra::{BinaryFunction, Function, Rational};

use super::code::Code;
use super::instruction::{Instruction, Operand};

/// What a program can be run on: `f64`, `f32`, and with a few lines dual numbers, intervals or numbers of more digits.
pub trait Scalar:
    Clone + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// A number that no fraction of integers is, as literals of a scene determine it in double precision.
    fn number(value: f64) -> Self;

    /// A fraction, exactly where the type can hold it.
    fn fraction(value: Rational) -> Self;

    /// Sine and cosine of an angle in radians.
    fn sine_cosine(self) -> (Self, Self);

    /// A function of one argument; NaN, or what stands for it, outside its domain.
    fn call(self, function: Function) -> Self;

    /// A function of two arguments, of which this is the first.
    fn call_with(self, function: BinaryFunction, other: Self) -> Self;
}

macro_rules! primitive {
    ($scalar:ident) => {
        impl Scalar for $scalar {
            fn number(value: f64) -> Self {
                value as $scalar
            }

            fn fraction(value: Rational) -> Self {
                value.numer() as $scalar / value.denom() as $scalar
            }

            fn sine_cosine(self) -> (Self, Self) {
                self.sin_cos()
            }

            fn call(self, function: Function) -> Self {
                match function {
                    Function::Sin => self.sin(),
                    Function::Cos => self.cos(),
                    Function::Exp => self.exp(),
                    Function::Ln => self.ln(),
                    Function::Sqrt => self.sqrt(),
                    Function::Abs => self.abs(),
                    // Unlike that of the primitive type, zero at zero.
                    Function::Signum if self == 0.0 => 0.0,
                    Function::Signum => self.signum(),
                }
            }

            fn call_with(self, function: BinaryFunction, other: Self) -> Self {
                match function {
                    BinaryFunction::Atan2 => self.atan2(other),
                    BinaryFunction::Min => self.min(other),
                    BinaryFunction::Max => self.max(other),
                }
            }
        }
    };
}

primitive!(f64);
primitive!(f32);

/// The result of an instruction.
enum Computed<T> {
    One(T),
    /// Sine and cosine.
    Pair(T, T),
}

impl<S: Copy> Code<S> {
    /// Carries out the instructions; `input` gives the value of every input. Products are rounded before anything is added to them.
    ///
    /// # Panics
    /// Of code that [`Code::verify`] refuses.
    pub fn evaluate<T: Scalar>(&self, input: impl Fn(S) -> T) -> Vec<T> {
        let mut results: Vec<Computed<T>> = Vec::with_capacity(self.instructions.len());
        let get = |operand: Operand<S>, results: &[Computed<T>]| match operand {
            Operand::Input(symbol) => input(symbol),
            Operand::Number(value) => T::fraction(value),
            Operand::Value(k) | Operand::Sine(k) => match &results[k] {
                Computed::One(value) | Computed::Pair(value, _) => value.clone(),
            },
            Operand::Cosine(k) => match &results[k] {
                Computed::One(value) | Computed::Pair(_, value) => value.clone(),
            },
        };
        for instruction in &self.instructions {
            let at = |operand: Operand<S>| get(operand, &results);
            let value = match *instruction {
                Instruction::Add(a, b) => at(a) + at(b),
                Instruction::Subtract(a, b) => at(a) - at(b),
                Instruction::Multiply(a, b) => at(a) * at(b),
                Instruction::MultiplyAdd(a, b, c) => at(a) * at(b) + at(c),
                Instruction::MultiplySubtract(a, b, c) => at(c) - at(a) * at(b),
                Instruction::Divide(a, b) => at(a) / at(b),
                Instruction::Negate(a) => -at(a),
                Instruction::SineCosine(a) => {
                    let (sine, cosine) = at(a).sine_cosine();
                    results.push(Computed::Pair(sine, cosine));
                    continue;
                }
                Instruction::Call(function, a) => at(a).call(function),
                Instruction::Binary(function, a, b) => at(a).call_with(function, at(b)),
            };
            results.push(Computed::One(value));
        }
        self.outputs.iter().map(|&output| get(output, &results)).collect()
    }
}
