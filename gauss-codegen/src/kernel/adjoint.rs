//! Gradients of programs with one output; second derivatives are tangents of these.

use crate::algebra::{Expr, Map, Rational};
use crate::derivatives::Direction;
use crate::program::derivatives::{InstructionWriter, Sweep, Tangent, TangentPass, signed};

use super::tangent::rate_of_symbol;
use super::write::{Operand, Program};

/// The derivatives of the only output of a program along each of the directions, as a program that reads what that one
/// read, and the rates.
pub fn gradient<'g>(program: &Program<'g>, directions: &[Direction<'g>]) -> Program<'g> {
    let mut writer = InstructionWriter::default();
    let none = Map::default();
    let (places, _) = writer.copy(program, &none);
    let mut sweep = Sweep::new(TangentPass::new(&mut writer, program, &none, &places));
    sweep.run(&[Some(Tangent { negative: false, value: Operand::Number(Rational::one()) })]);
    let outputs = directions.iter().map(|direction| along(&mut sweep, direction)).collect();
    writer.finish(outputs)
}

/// The derivative along a direction, where the derivatives by all symbols are known.
fn along<'g>(sweep: &mut Sweep<'_, Expr<'g>>, direction: &Direction<'g>) -> Operand<'g> {
    let mut sum = None;
    for (symbol, rate) in direction {
        let slope = sweep.of_symbols.get(symbol).copied().flatten();
        if let Some(rate) = rate_of_symbol(&sweep.pass, *rate) {
            sum = sweep.pass.writer.times_plus(signed(slope, rate), rate.value, sum);
        }
    }
    sum.map_or(Operand::Number(Rational::zero()), |sum| sweep.pass.writer.written(sum))
}
