//! Costs of a program, the length of its chains, and the smoothness of its outputs.

use std::fmt;

use crate::algebra::{BinaryFunction, Function, Key, Set};

use super::code::Code;
use super::instruction::{Instruction, Operand};

/// Operations by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Counts {
    /// Additions, subtractions, comparisons; one in each multiply-add.
    pub additions: u32,
    /// Multiplications; one in each multiply-add, unless another has the same.
    pub multiplications: u32,
    /// Divisions.
    pub divisions: u32,
    /// Square roots.
    pub roots: u32,
    /// Sines and cosines, two for a pair; exponentials, logarithms, arcus tangents.
    pub transcendentals: u32,
}

impl Counts {
    /// A single figure to compare arrangements by, in units of one addition. A division or a root keeps its unit busy
    /// as long as eight additions (Fog, Instruction tables: four cycles where two additions start in each), and
    /// everything else waits for it.
    pub fn weighted(&self) -> u32 {
        self.additions + self.multiplications + 8 * (self.divisions + self.roots) + 15 * self.transcendentals
    }
}

/// `12 add, 3 mul, 1 div`; `none`.
impl fmt::Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts = [
            (self.additions, "add"),
            (self.multiplications, "mul"),
            (self.divisions, "div"),
            (self.roots, "sqrt"),
            (self.transcendentals, "transcendental"),
        ];
        let parts: Vec<String> =
            parts.into_iter().filter(|(n, _)| *n > 0).map(|(n, name)| format!("{n} {name}")).collect();
        f.write_str(&if parts.is_empty() { "none".to_owned() } else { parts.join(", ") })
    }
}

/// Cost of a call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cost {
    /// All instructions, in units of one addition: [`Counts::weighted`].
    pub operations: u32,
    /// Cycles of the longest chain of instructions that wait for one another.
    pub chain: u32,
}

impl Cost {
    /// A single figure to compare arrangements by, in units of one addition: all instructions, and the longest chain.
    /// Two additions start in a cycle, so that a call that waits for another would wait for two of them in every cycle
    /// of the chain, and calls that overlap for none; of what both take together 1.4 was found to fit best.
    pub fn total(self) -> u32 {
        self.operations + self.chain * 3 / 2
    }
}

/// Smoothness of the outputs of a program, away from singularities.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Smoothness {
    /// All derivatives exist.
    Smooth,
    /// Derivatives jump.
    Kinks,
    /// Values jump.
    Jumps,
}

impl<S: Copy> Operand<S> {
    /// The cycle in which it is there, after those of the instructions.
    pub(crate) fn ready(self, ready: &[u32]) -> u32 {
        self.instruction().map_or(0, |k| ready[k])
    }
}

impl<S: Copy> Instruction<S> {
    /// Cycles from its operands to its result (Fog, Instruction tables: four for additions and products, fifteen for
    /// divisions and roots; forty for inlined sines and cosines).
    pub(super) fn cycles(&self) -> u32 {
        match self {
            Instruction::Negate(_) => 1,
            Instruction::Divide(..) | Instruction::Call(Function::Sqrt, _) => 15,
            Instruction::SineCosine(_) => 40,
            Instruction::Call(Function::Abs | Function::Signum, _)
            | Instruction::Binary(BinaryFunction::Min | BinaryFunction::Max, ..) => 4,
            Instruction::Call(..) | Instruction::Binary(..) | Instruction::Own(..) => 60,
            _ => 4,
        }
    }

    /// The cycle in which its result is there, after those of the instructions before it, were there no limit to what
    /// runs at once.
    pub(crate) fn ready(&self, ready: &[u32]) -> u32 {
        self.operands().map(|operand| operand.ready(ready)).max().unwrap_or(0) + self.cycles()
    }
}

impl<S: Copy + Key> Code<S> {
    /// Its operations by kind.
    pub fn counts(&self) -> Counts {
        let mut counts = Counts::default();
        // Targets that do not fuse form a product once; those that do form none.
        let mut fused = Set::default();
        for instruction in &self.instructions {
            match instruction {
                Instruction::Add(..) | Instruction::Subtract(..) => counts.additions += 1,
                Instruction::Multiply(..) => counts.multiplications += 1,
                Instruction::MultiplyAdd(a, b, _) | Instruction::MultiplySubtract(a, b, _) => {
                    counts.additions += 1;
                    counts.multiplications += u32::from(fused.insert((*a, *b)));
                }
                Instruction::Divide(..) => counts.divisions += 1,
                Instruction::Negate(_) => {}
                Instruction::SineCosine(_) => counts.transcendentals += 2,
                Instruction::Call(Function::Sqrt, _) => counts.roots += 1,
                // A comparison costs what an addition costs.
                Instruction::Call(Function::Abs | Function::Signum, _)
                | Instruction::Binary(BinaryFunction::Min | BinaryFunction::Max, ..) => counts.additions += 1,
                Instruction::Call(..) | Instruction::Binary(..) | Instruction::Own(..) => counts.transcendentals += 1,
            }
        }
        counts
    }

    /// Cost of a call.
    pub fn cost(&self) -> Cost {
        Cost { operations: self.counts().weighted(), chain: self.chain() }
    }

    /// Cycles from the arguments to the last output, were there no limit to what runs at once.
    fn chain(&self) -> u32 {
        let mut ready: Vec<u32> = Vec::with_capacity(self.instructions.len());
        for instruction in &self.instructions {
            ready.push(instruction.ready(&ready));
        }
        self.outputs.iter().map(|output| output.ready(&ready)).max().unwrap_or(0)
    }

    /// Smoothness of its roughest instruction.
    pub fn smoothness(&self) -> Smoothness {
        let of = |instruction: &Instruction<S>| match instruction {
            Instruction::Call(Function::Signum, _) => Smoothness::Jumps,
            Instruction::Own(function, _) => match function.continuous {
                Some(continuous) if function.order() > continuous => Smoothness::Jumps,
                Some(_) => Smoothness::Kinks,
                None => Smoothness::Smooth,
            },
            Instruction::Call(Function::Abs, _)
            | Instruction::Binary(BinaryFunction::Min | BinaryFunction::Max, ..) => Smoothness::Kinks,
            _ => Smoothness::Smooth,
        };
        self.instructions.iter().map(of).max().unwrap_or(Smoothness::Smooth)
    }
}
