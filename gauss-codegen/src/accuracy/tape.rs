//! Programs that are run many times: inputs and numbers in one list.

use crate::algebra::{Expr, Map, Number, Rational};
use crate::program::{Code, Operand};

/// Symbol or number that a place in the list is filled with.
#[derive(Clone, Copy, PartialEq, Eq)]
enum TapeInput {
    Symbol(u32),
    Number(Rational),
}

/// A program with the places of its inputs.
pub struct Tape {
    code: Code<usize>,
    places: Vec<TapeInput>,
}

impl Tape {
    pub fn new(program: &Code<Expr<'_>>) -> Self {
        let mut places: Vec<TapeInput> = Vec::new();
        let mut known: Map<u32, usize> = Map::default();
        let mut numbers: Map<Rational, usize> = Map::default();
        let mut place_of = |operand: Operand<Expr<'_>>| match operand {
            Operand::Input(symbol) => Operand::Input(*known.or_insert_with(symbol.key(), || {
                places.push(TapeInput::Symbol(symbol.key()));
                places.len() - 1
            })),
            Operand::Number(value) => Operand::Input(*numbers.or_insert_with(value, || {
                places.push(TapeInput::Number(value));
                places.len() - 1
            })),
            Operand::Value(k) => Operand::Value(k),
            Operand::Sine(k) => Operand::Sine(k),
            Operand::Cosine(k) => Operand::Cosine(k),
        };
        let instructions = program.instructions.iter().map(|instruction| instruction.map(&mut place_of)).collect();
        let outputs = program.outputs.iter().map(|&operand| place_of(operand)).collect();
        Self { code: Code { instructions, outputs }, places }
    }

    /// Its outputs, with values of symbols by their keys.
    pub fn run<N: Number>(&self, symbols: &Map<u32, N>) -> Vec<N> {
        let value = |place: &TapeInput| match *place {
            TapeInput::Symbol(key) => symbols.get(&key).copied().unwrap_or(N::number(f64::NAN)),
            TapeInput::Number(value) => N::fraction(value),
        };
        let values: Vec<N> = self.places.iter().map(value).collect();
        self.code.evaluate_with(|place| values[place], N::stand_in)
    }
}
