//! One step of a program, and what it works on.

use crate::algebra::{BinaryFunction, Function, Key, MOST_VARIABLES, OwnFunction, Rational, joined};

use super::input::Input;

/// Operand of an instruction. `S` is what inputs are called: an [`Input`] of a finished [`Program`](super::Program), a
/// symbol while it is made.
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
    /// A function of the user's own; what it has fewer arguments than there is room for is filled up with the last one.
    Own(OwnFunction, [Operand<S>; MOST_VARIABLES]),
}

impl<S: Key> Key for Operand<S> {
    fn word(&self) -> u64 {
        match self {
            Operand::Input(symbol) => joined(1, symbol.word()),
            Operand::Number(value) => joined(2, value.word()),
            Operand::Value(k) => joined(3, *k as u64),
            Operand::Sine(k) => joined(4, *k as u64),
            Operand::Cosine(k) => joined(5, *k as u64),
        }
    }
}

impl<S: Key> Key for Instruction<S> {
    fn word(&self) -> u64 {
        let two = |kind: u64, a: &Operand<S>, b: &Operand<S>| joined(joined(kind, a.word()), b.word());
        match self {
            Instruction::Add(a, b) => two(1, a, b),
            Instruction::Subtract(a, b) => two(2, a, b),
            Instruction::Multiply(a, b) => two(3, a, b),
            Instruction::MultiplyAdd(a, b, c) => joined(two(4, a, b), c.word()),
            Instruction::MultiplySubtract(a, b, c) => joined(two(5, a, b), c.word()),
            Instruction::Divide(a, b) => two(6, a, b),
            Instruction::Negate(a) => joined(7, a.word()),
            Instruction::SineCosine(a) => joined(8, a.word()),
            Instruction::Call(function, a) => joined(joined(9, function.word()), a.word()),
            Instruction::Binary(function, a, b) => joined(two(10, a, b), *function as u64),
            Instruction::Own(function, [a, b, c]) => joined(joined(two(11, a, b), c.word()), function.word()),
        }
    }
}

impl<S: Copy> Operand<S> {
    /// The instruction that it is a result of.
    pub fn instruction(self) -> Option<usize> {
        match self {
            Operand::Value(k) | Operand::Sine(k) | Operand::Cosine(k) => Some(k),
            Operand::Input(_) | Operand::Number(_) => None,
        }
    }

    /// Whether it is a result of that instruction.
    pub(super) fn is_result_of(self, k: usize) -> bool {
        self.instruction() == Some(k)
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
            Instruction::Own(function, arguments) => Instruction::Own(function, arguments.map(f)),
        }
    }

    /// Operands, in the order in which they are written.
    pub fn operands(&self) -> impl Iterator<Item = Operand<S>> + use<'_, S> {
        Operands { instruction: self, next: 0 }
    }

    /// One of what it works on, by its place.
    const fn operand(&self, place: u8) -> Option<Operand<S>> {
        match (self, place) {
            (
                Instruction::Add(a, _)
                | Instruction::Subtract(a, _)
                | Instruction::Multiply(a, _)
                | Instruction::MultiplyAdd(a, ..)
                | Instruction::MultiplySubtract(a, ..)
                | Instruction::Divide(a, _)
                | Instruction::Negate(a)
                | Instruction::SineCosine(a)
                | Instruction::Call(_, a)
                | Instruction::Binary(_, a, _),
                0,
            ) => Some(*a),
            (
                Instruction::Add(_, b)
                | Instruction::Subtract(_, b)
                | Instruction::Multiply(_, b)
                | Instruction::MultiplyAdd(_, b, _)
                | Instruction::MultiplySubtract(_, b, _)
                | Instruction::Divide(_, b)
                | Instruction::Binary(.., b),
                1,
            ) => Some(*b),
            (Instruction::MultiplyAdd(.., c) | Instruction::MultiplySubtract(.., c), 2) => Some(*c),
            (Instruction::Own(function, arguments), place) if place < function.variables => {
                Some(arguments[place as usize])
            }
            _ => None,
        }
    }
}

/// Iterator over the operands of an instruction: adapters of arrays take ten times as long where nothing is optimised.
struct Operands<'a, S> {
    instruction: &'a Instruction<S>,
    next: u8,
}

impl<S: Copy> Iterator for Operands<'_, S> {
    type Item = Operand<S>;

    fn next(&mut self) -> Option<Operand<S>> {
        let operand = self.instruction.operand(self.next);
        self.next += 1;
        operand
    }
}
