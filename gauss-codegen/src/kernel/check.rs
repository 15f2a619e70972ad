//! Programs run at a pseudo-random point, against the expressions that they were lowered from.

use std::fmt;

use crate::algebra::{Evaluation, Expr, Function, Graph, Map, Number, Precise};

use super::derivative_programs::DerivativeProgram;
use super::expected_outputs::ExpectedOutputs;
use super::write::Program;

/// A program does not compute what its expressions say: an error of this crate, never of its user.
#[derive(Debug)]
pub struct Miscompilation {
    function: usize,
    output: usize,
    expected: f64,
    found: f64,
}

impl fmt::Display for Miscompilation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { function, output, expected, found } = self;
        write!(f, "output {output} of function {function} computes {found} instead of {expected}")
    }
}

/// Programs, and what they should compute.
pub(super) struct CheckedPrograms<'a, 'g> {
    pub constants: &'a Program<'g>,
    pub constant_symbols: &'a [Expr<'g>],
    pub functions: Vec<(&'a Program<'g>, ExpectedOutputs<'a, 'g>)>,
    /// Derivatives, for which the point need not be in the domain.
    pub derivatives: &'a [DerivativeProgram<'a, 'g>],
}

impl<'g> CheckedPrograms<'_, 'g> {
    /// Roots and logarithms have domains: the point is the first of a few at which everything has a value. Functions
    /// that have none at any of them cannot be checked. A wrong term is wrong nearly everywhere, and in numbers of many
    /// digits, too; where terms cancel, two right forms differ by the roundings of what cancelled, which are smaller
    /// there by as many digits as there are more. So programs are refused when they disagree at three points and do so
    /// in numbers of many digits.
    pub fn check(&self, graph: &'g Graph, sample: &Sample<'_, 'g>) -> Result<(), Miscompilation> {
        self.check_in::<f64>(graph, sample).or_else(|_| self.check_in::<Precise>(graph, sample))
    }

    fn check_in<N: Number>(&self, graph: &'g Graph, sample: &Sample<'_, 'g>) -> Result<(), Miscompilation> {
        let points = (0..16).map(|shift| sample.point(graph, shift));
        let inside = |point: &Map<u32, N>| {
            let mut evaluation = Evaluation::new(point);
            let mut outputs = self.functions.iter().flat_map(|(_, expected)| expected.outputs());
            outputs.all(|e| evaluation.value(*e).is_finite())
        };
        let mut refused = Ok(());
        for point in points.filter(inside).take(3) {
            refused = self.check_at(&point, sample);
            if refused.is_ok() {
                break;
            }
        }
        refused
    }

    fn check_at<N: Number>(&self, point: &Map<u32, N>, sample: &Sample<'_, 'g>) -> Result<(), Miscompilation> {
        let mut values = point.clone();
        let constants = self.constants.run(point);
        values.extend(self.constant_symbols.iter().zip(constants).map(|(s, v)| (s.key(), v)));
        let mut evaluation = Evaluation::new(point);
        values.extend(sample.folded.iter().map(|(s, definition)| (s.key(), evaluation.value(*definition))));
        for (function, (program, expected)) in self.functions.iter().enumerate() {
            compare(function, &program.run(&values), &expected.values(&mut evaluation))?;
        }
        for (function, derivative) in (self.functions.len()..).zip(self.derivatives) {
            let expected = derivative.expected.values(&mut evaluation);
            compare(function, &derivative.program.run(&values), &expected)?;
            if let Some(columns) = &derivative.columns {
                compare(function, &columns.run(&values), &expected)?;
            }
        }
        Ok(())
    }
}

/// Refuses what is not computed as expected.
fn compare<N: Number>(function: usize, found: &[N], expected: &[N]) -> Result<(), Miscompilation> {
    for (output, (&found, &wanted)) in found.iter().zip(expected).enumerate() {
        let (apart, found, expected) = ((found - wanted).to_f64(), found.to_f64(), wanted.to_f64());
        // Inputs are of order one; hundreds of roundings stay far below, a wrong term far above this.
        let close = apart.abs() <= 1e-6 * (1.0 + expected.abs());
        // Derivatives alone may have no value where functions have one, as that of 0^k by k: there is nothing to
        // compare with.
        if expected.is_finite() && !close {
            return Err(Miscompilation { function, output, expected, found });
        }
    }
    Ok(())
}

/// Conditions on the points of checks.
pub(super) struct Sample<'a, 'g> {
    /// Symbols that stand for expressions of the arguments.
    pub definitions: &'a Map<u32, Expr<'g>>,
    /// Symbols that are scaled to have the norm 1, list by list.
    pub units: &'a [Vec<Expr<'g>>],
    /// Symbols that stand for literals.
    pub literals: &'a Map<u32, f64>,
    /// Constants that literals alone determine.
    pub folded: &'a [(Expr<'g>, Expr<'g>)],
}

impl<'g> Sample<'_, 'g> {
    /// A value of order one for every symbol, different for each, but for literals, and the values of what is defined
    /// by them.
    pub fn point<N: Number>(&self, graph: &'g Graph, shift: u32) -> Map<u32, N> {
        let mut point: Map<u32, N> = graph
            .symbol_keys()
            .into_iter()
            .enumerate()
            .map(|(k, key)| {
                // Multiples of the golden ratio are spread evenly and never equal.
                let fraction = (((k + 1) as f64 + f64::from(shift) * 0.37) * 0.618_033_988_749_894_9).fract();
                (key, N::number(0.6 + fraction))
            })
            .collect();
        point.extend(self.literals.iter().map(|(&key, &value)| (key, N::number(value))));
        for unit in self.units {
            let square = |symbol: &Expr<'g>| point[&symbol.key()].powi(2);
            let norm = unit.iter().fold(N::number(0.0), |sum, symbol| sum + square(symbol)).call(Function::Sqrt);
            for symbol in unit {
                if let Some(value) = point.get_mut(&symbol.key()) {
                    *value = *value / norm;
                }
            }
        }
        let mut evaluation = Evaluation::new(&point);
        let defined: Vec<(u32, N)> =
            self.definitions.iter().map(|(&symbol, e)| (symbol, evaluation.value(*e))).collect();
        point.extend(defined);
        point
    }
}
