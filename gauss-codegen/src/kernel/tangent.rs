//! Derivatives of programs: forward differentiation, instruction by instruction, along many directions at once.
//!
//! A program is a list of elementary steps, so the chain rule is one rule a step, and what a step costs its derivative
//! costs two or three times. Products with 0 and 1 are never written, equal instructions are written once, and what no
//! output needs is left out: outputs that cannot change along a direction are the number 0.

use crate::algebra::{Expr, Map};
use crate::derivatives::Direction;
use crate::program::derivatives::{InstructionWriter, Rate, Tangent, TangentPass};

use super::write::{Operand, Program};

/// The outputs of `program`, and then, direction by direction, the derivatives of them all. `bound` are symbols that
/// are outputs of the other program: what reads them reads these.
pub fn with_tangents<'g>(
    program: &Program<'g>,
    bound: (&[Expr<'g>], &Program<'g>),
    directions: &[Direction<'g>],
) -> Program<'g> {
    let (writer, values, tangents) = differentiated(program, bound, directions);
    writer.finish([values, tangents].concat())
}

/// The derivatives alone, and what they need.
pub fn tangents_alone<'g>(
    program: &Program<'g>,
    bound: (&[Expr<'g>], &Program<'g>),
    directions: &[Direction<'g>],
) -> Program<'g> {
    let (writer, _, tangents) = differentiated(program, bound, directions);
    writer.finish(tangents)
}

/// Other outputs of the same instructions, and only the instructions that they need.
pub fn with_outputs<'g>(program: &Program<'g>, outputs: Vec<Operand<'g>>) -> Program<'g> {
    InstructionWriter::of(program).finish(outputs)
}

/// Two programs as one: the outputs of the first, then those of the second.
pub fn joined<'g>(first: &Program<'g>, second: &Program<'g>) -> Program<'g> {
    let mut writer = InstructionWriter::default();
    let none = Map::default();
    let (_, mut outputs) = writer.copy(first, &none);
    outputs.extend(writer.copy(second, &none).1);
    writer.finish(outputs)
}

/// Functions of which one is given as the root of another: x with `residual(x) = 0`, solved by `root`.
pub struct Implicit<'a, 'g> {
    pub root: &'a Program<'g>,
    pub residual: &'a Program<'g>,
    /// x in the residual, in the order of the outputs of both.
    pub unknowns: &'a [Expr<'g>],
    /// Affine in `loads`, with the inverse of ∂residual/∂x as the coefficients.
    pub solution: &'a Program<'g>,
    pub loads: &'a [Expr<'g>],
}

/// The derivatives of the outputs of a program, and then of the root, direction by direction:
/// `−(∂residual/∂x)⁻¹ ∂residual`. What the solution divides by is worked out once for all directions.
pub fn implicit_tangents<'g>(
    explicit: &Program<'g>,
    implicit: &Implicit<'_, 'g>,
    directions: &[Direction<'g>],
) -> Program<'g> {
    let mut writer = InstructionWriter::default();
    let none = Map::default();
    let (_, root) = writer.copy(implicit.root, &none);
    let unknowns: Map<Expr<'g>, Operand<'g>> = implicit.unknowns.iter().copied().zip(root).collect();
    let (explicit_places, _) = writer.copy(explicit, &none);
    let (residual_places, _) = writer.copy(implicit.residual, &unknowns);
    let (solution_places, _) = writer.copy(implicit.solution, &none);
    let mut outputs = Vec::new();
    for direction in directions {
        let mut pass = TangentPass::new(&mut writer, explicit, &none, &explicit_places);
        set_out(&mut pass, direction);
        outputs.extend(pass.outputs());
        let mut pass = TangentPass::new(&mut writer, implicit.residual, &unknowns, &residual_places);
        set_out(&mut pass, direction);
        let changes = pass.tangents();
        let mut pass = TangentPass::new(&mut writer, implicit.solution, &none, &solution_places);
        let loads = implicit.loads.iter().zip(changes);
        pass.rates = loads.map(|(symbol, rate)| (*symbol, rate.map(Tangent::negated))).collect();
        outputs.extend(pass.outputs());
    }
    writer.finish(outputs)
}

/// Writes the instructions of the outputs and their derivatives, and tells where these are.
fn differentiated<'g>(
    program: &Program<'g>,
    bound: (&[Expr<'g>], &Program<'g>),
    directions: &[Direction<'g>],
) -> (InstructionWriter<Expr<'g>>, Vec<Operand<'g>>, Vec<Operand<'g>>) {
    let mut writer = InstructionWriter::default();
    let none = Map::default();
    let (_, values) = writer.copy(bound.1, &none);
    let symbols: Map<Expr<'g>, Operand<'g>> = bound.0.iter().copied().zip(values).collect();
    let (places, outputs) = writer.copy(program, &symbols);
    let mut tangents = Vec::new();
    for direction in directions {
        let mut pass = TangentPass::new(&mut writer, program, &symbols, &places);
        set_out(&mut pass, direction);
        tangents.extend(pass.outputs());
    }
    (writer, outputs, tangents)
}

/// Sets the rates of the symbols that move along a direction.
fn set_out<'g>(pass: &mut TangentPass<'_, Expr<'g>>, direction: &Direction<'g>) {
    for (symbol, rate) in direction {
        let rate = rate_of_symbol(pass, *rate);
        pass.rates.insert(*symbol, rate);
    }
}

/// A rate that is a number, a symbol, or the negative of one.
pub(super) fn rate_of_symbol<'g>(pass: &TangentPass<'_, Expr<'g>>, rate: Expr<'g>) -> Rate<Expr<'g>> {
    if rate.is_zero() {
        return None;
    }
    let (c, rest) = rate.split_coefficient();
    let value = if rest.as_number().is_some() { Operand::Number(c.abs()) } else { pass.here(Operand::Input(rest)) };
    let tangent = Tangent { negative: false, value };
    Some(if c.is_negative() { tangent.negated() } else { tangent })
}
