//! One step of a program, and what it works on.

use crate::algebra::{BinaryFunction, Function, Rational};

use super::input::Input;

/// What an instruction works on. `S` is what inputs are called: an [`Input`] of a finished [`Program`](super::Program), a symbol
/// while it is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Operand<S = Input> {
    /// An argument of the function or a constant.
    Input(S),
    /// An exact number.
    Number(Rational),
    /// The result of the earlier instruction of that index.
    Value(usize),
    /// The sine out of the pair computed by the earlier instruction of that index.
    Sine(usize),
    /// The cosine out of such a pair.
    Cosine(usize),
}

/// One step; its result is `Value(index of the step)`, or `Sine` and `Cosine` of that index.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Instruction<S = Input> {
    /// a + b.
    Add(Operand<S>, Operand<S>),
    /// a − b.
    Subtract(Operand<S>, Operand<S>),
    /// a b.
    Multiply(Operand<S>, Operand<S>),
    /// a b + c, rounded once or twice as the target likes.
    MultiplyAdd(Operand<S>, Operand<S>, Operand<S>),
    /// c − a b, rounded once or twice as the target likes.
    MultiplySubtract(Operand<S>, Operand<S>, Operand<S>),
    /// a/b.
    Divide(Operand<S>, Operand<S>),
    /// −a.
    Negate(Operand<S>),
    /// Sine and cosine of one angle in radians.
    SineCosine(Operand<S>),
    /// Any function but sine and cosine, which come in pairs.
    Call(Function, Operand<S>),
    /// A function of two arguments.
    Binary(BinaryFunction, Operand<S>, Operand<S>),
}

impl<S: Copy> Operand<S> {
    /// The instruction that it is a result of.
    pub fn instruction(self) -> Option<usize> {
        match self {
            Operand::Value(k) | Operand::Sine(k) | Operand::Cosine(k) => Some(k),
            Operand::Input(_) | Operand::Number(_) => None,
        }
    }

    /// The same with the instruction that it is a result of at another place.
    pub fn moved(self, place: impl FnOnce(usize) -> usize) -> Self {
        match self {
            Operand::Value(k) => Operand::Value(place(k)),
            Operand::Sine(k) => Operand::Sine(place(k)),
            Operand::Cosine(k) => Operand::Cosine(place(k)),
            other => other,
        }
    }

    /// Whether it changes when the inputs change that are not `constant`; `moving` tells it of earlier instructions.
    pub fn moves(&self, moving: &[bool], constant: impl Fn(S) -> bool) -> bool {
        match *self {
            Operand::Number(_) => false,
            Operand::Input(input) => !constant(input),
            Operand::Value(k) | Operand::Sine(k) | Operand::Cosine(k) => moving[k],
        }
    }
}

impl<S: Copy> Instruction<S> {
    /// The same instruction on other operands.
    pub fn map<T>(&self, mut f: impl FnMut(Operand<S>) -> Operand<T>) -> Instruction<T> {
        match *self {
            Instruction::Add(a, b) => Instruction::Add(f(a), f(b)),
            Instruction::Subtract(a, b) => Instruction::Subtract(f(a), f(b)),
            Instruction::Multiply(a, b) => Instruction::Multiply(f(a), f(b)),
            Instruction::MultiplyAdd(a, b, c) => Instruction::MultiplyAdd(f(a), f(b), f(c)),
            Instruction::MultiplySubtract(a, b, c) => Instruction::MultiplySubtract(f(a), f(b), f(c)),
            Instruction::Divide(a, b) => Instruction::Divide(f(a), f(b)),
            Instruction::Negate(a) => Instruction::Negate(f(a)),
            Instruction::SineCosine(a) => Instruction::SineCosine(f(a)),
            Instruction::Call(function, a) => Instruction::Call(function, f(a)),
            Instruction::Binary(function, a, b) => Instruction::Binary(function, f(a), f(b)),
        }
    }

    /// What it works on, in the order in which it is written.
    pub fn operands(&self) -> impl Iterator<Item = Operand<S>> + use<S> {
        let (a, b, c) = match *self {
            Instruction::Add(a, b)
            | Instruction::Subtract(a, b)
            | Instruction::Multiply(a, b)
            | Instruction::Divide(a, b)
            | Instruction::Binary(_, a, b) => (a, Some(b), None),
            Instruction::MultiplyAdd(a, b, c) | Instruction::MultiplySubtract(a, b, c) => (a, Some(b), Some(c)),
            Instruction::Negate(a) | Instruction::SineCosine(a) | Instruction::Call(_, a) => (a, None, None),
        };
        [Some(a), b, c].into_iter().flatten()
    }
}
