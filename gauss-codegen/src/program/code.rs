//! Straight-line code: instructions and outputs.

use super::input::Input;
use super::instruction::{Instruction, Operand};

/// A function as a list of instructions: single assignment, no loops, no branches.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Code<S = Input> {
    /// In the order in which they are carried out; each reads only results of earlier ones.
    pub instructions: Vec<Instruction<S>>,
    /// Results of the function.
    pub outputs: Vec<Operand<S>>,
}

impl<S: Copy> Code<S> {
    /// Code without instructions and outputs.
    pub fn nothing() -> Self {
        Self { instructions: Vec::new(), outputs: Vec::new() }
    }

    /// Everything that the code reads, repeatedly where it is read repeatedly.
    pub fn operands(&self) -> impl Iterator<Item = Operand<S>> {
        self.instructions.iter().flat_map(Instruction::operands).chain(self.outputs.iter().copied())
    }

    /// The inputs that the code reads, each once.
    pub fn inputs(&self) -> Vec<S>
    where
        S: PartialEq,
    {
        let mut inputs = Vec::new();
        for operand in self.operands() {
            if let Operand::Input(input) = operand
                && !inputs.contains(&input)
            {
                inputs.push(input);
            }
        }
        inputs
    }

    /// Number of readers of each instruction among instructions and outputs.
    pub fn uses(&self) -> Vec<usize> {
        let mut uses = vec![0; self.instructions.len()];
        for operand in self.operands() {
            if let Some(k) = operand.instruction() {
                uses[k] += 1;
            }
        }
        uses
    }

    /// Whether each instruction is needed for an output.
    pub fn needed(&self) -> Vec<bool> {
        let mut needed = vec![false; self.instructions.len()];
        self.outputs.iter().filter_map(|operand| operand.instruction()).for_each(|k| needed[k] = true);
        for (k, instruction) in self.instructions.iter().enumerate().rev() {
            if needed[k] {
                for operand in instruction.operands() {
                    if let Some(k) = operand.instruction() {
                        needed[k] = true;
                    }
                }
            }
        }
        needed
    }

    /// The same without instructions that no output needs.
    pub fn without_idle(&self) -> Self {
        let needed = self.needed();
        // Places of what stays; those of the others are never looked up.
        let mut places = Vec::with_capacity(needed.len());
        let mut count = 0;
        for &stays in &needed {
            places.push(count);
            count += usize::from(stays);
        }
        let moved = |operand: Operand<S>| operand.moved(|k| places[k]);
        let kept = self.instructions.iter().zip(&needed).filter(|(_, needed)| **needed);
        Self {
            instructions: kept.map(|(instruction, _)| instruction.map(moved)).collect(),
            outputs: self.outputs.iter().map(|&operand| moved(operand)).collect(),
        }
    }

    /// The same code on other operands in place of its inputs.
    ///
    /// # Errors
    /// The first input that has nothing in its place.
    pub fn with_inputs<T, E>(&self, mut of: impl FnMut(S) -> Result<Operand<T>, E>) -> Result<Code<T>, E> {
        let mut failed = None;
        let mut replaced = |operand: Operand<S>| match operand {
            Operand::Input(input) => of(input).unwrap_or_else(|error| {
                failed.get_or_insert(error);
                Operand::Value(0)
            }),
            Operand::Number(n) => Operand::Number(n),
            Operand::Value(k) => Operand::Value(k),
            Operand::Sine(k) => Operand::Sine(k),
            Operand::Cosine(k) => Operand::Cosine(k),
        };
        let instructions = self.instructions.iter().map(|instruction| instruction.map(&mut replaced)).collect();
        let outputs = self.outputs.iter().map(|&operand| replaced(operand)).collect();
        failed.map_or(Ok(Code { instructions, outputs }), Err)
    }
}
