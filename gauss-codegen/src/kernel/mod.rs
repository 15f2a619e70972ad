//! From expressions to straight-line programs: constants hoisted, common factors pulled out, common parts shared,
//! multiply-adds fused, everything counted.
//!
//! - `hoist`: what depends on parameters alone becomes a constant, computed once.
//! - `factor`: common factors of the terms of a sum are pulled out.
//! - `network`: sums and products of many terms; parts that occur more than once are split off.
//! - `signs`: negations led to where they cost nothing.
//! - `tangent`: derivatives of programs.
//! - `derivatives`: derivatives of functions by what moves and by parameters.
//! - `program`: single-assignment instructions, their counts, and an interpreter to check them with.
//!
//! Knows nothing of frames or bodies. Every program is checked against the expressions it was made from before it is
//! handed out (see [`Kernel::lower`]).

mod derivatives;
mod factor;
mod hoist;
mod network;
mod program;
mod signs;
mod tangent;
#[cfg(test)]
mod tests;

use std::fmt;

use crate::algebra::{Evaluation, Expr, Graph, Map, Rational};

pub use derivatives::{ByParameters, Derivatives, Differentiated, Equation};
use derivatives::{Constants, Expected, Kept};
use hoist::Hoister;
pub use program::{Counts, Operand, Operation, Program, Smoothness};
pub use tangent::Direction;

/// Programs of a set of functions that share their constants.
pub struct Kernel<'g> {
    /// Computes the constants from the parameters; its outputs are the constants in order.
    pub constants: Program<'g>,
    /// One program a function, in the order given; the symbols of constants among their inputs are listed below.
    pub functions: Vec<Program<'g>>,
    /// The outputs of several functions, one after the other, what they have in common computed once.
    pub joined: Program<'g>,
    /// The outputs of what is differentiated, then all their derivatives along the first direction, and so on.
    pub tangents: Option<Program<'g>>,
    /// The derivatives of the same outputs by the first parameter, and so on.
    pub by_parameters: Option<Program<'g>>,
    /// The coefficients of the first parameter in outputs that are affine in them, and so on.
    pub regressor: Option<Program<'g>>,
    /// The constants as symbols, in the order of the outputs of `constants`.
    pub constant_symbols: Vec<Expr<'g>>,
    /// Constants that literal numbers alone determine, with their values.
    pub known_constants: Vec<(Expr<'g>, f64)>,
}

/// Symbols that stand for literal numbers. Where the scalar is not known before run time, there is no value to fold.
pub type Literals<'a, 'g> = Option<&'a [(Rational, Expr<'g>)]>;

/// A function to be lowered: lists of outputs that are equal, of which the cheapest is taken.
pub struct Candidates<'g> {
    pub arrangements: Vec<Vec<Expr<'g>>>,
    pub cost: Cost,
}

#[cfg(test)]
impl<'g> Candidates<'g> {
    /// Arrangements of which values are wanted.
    pub fn of_values(arrangements: Vec<Vec<Expr<'g>>>) -> Self {
        Self { arrangements, cost: Cost::Values }
    }
}

/// What a function is to be cheap for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cost {
    /// Its values.
    Values,
    /// The power series of its values.
    Series,
}

/// A program does not compute what its expressions say: an error of this crate, never of its user.
#[derive(Debug)]
pub struct Miscompiled {
    function: usize,
    output: usize,
    expected: f64,
    found: f64,
}

impl fmt::Display for Miscompiled {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { function, output, expected, found } = self;
        write!(f, "output {output} of function {function} computes {found} instead of {expected}")
    }
}

impl<'g> Kernel<'g> {
    /// Lowers functions, each of which has an arrangement; those that are `joined` also together. `definitions` are symbols that stand for expressions of the arguments. Every program is then run at a
    /// pseudo-random point and compared with its expressions.
    pub fn lower(
        graph: &'g Graph,
        functions: &[Candidates<'g>],
        joined: &[usize],
        definitions: &Map<u32, Expr<'g>>,
        wanted: &Derivatives<'_, 'g>,
        literals: Literals<'_, 'g>,
    ) -> Result<Self, Miscompiled> {
        let mut hoister = Hoister::new(graph, definitions);
        let mut programs = Vec::with_capacity(functions.len());
        let mut chosen = Vec::with_capacity(functions.len());
        for Candidates { arrangements, cost } in functions {
            let lowered: Vec<_> =
                arrangements.iter().map(|outputs| (Program::lower(&hoister.hoist(outputs)), outputs)).collect();
            let cost_of = |program: &Program<'g>| match cost {
                Cost::Values => program.cost(),
                Cost::Series => program.series_cost(|symbol| hoister.is_hoisted(symbol)),
            };
            let (program, outputs) = lowered
                .into_iter()
                .min_by_key(|(program, _)| cost_of(program))
                .expect("a function has at least one arrangement");
            // A power series takes a negation of an addend for an instruction like any other.
            programs.push(if *cost == Cost::Values { program.with_signs_led_back() } else { program });
            chosen.push(outputs);
        }
        let (joined, of_joined) = lower_together(&mut hoister, functions, &chosen, joined);
        let by_state = wanted.by_state.map(|wanted| wanted.lower(&mut hoister, Kept::ValuesToo));
        let regressor = wanted.regressor.map(|wanted| wanted.lower(&mut hoister, Kept::DerivativesAlone));
        let (tangents, expected_tangents) = by_state.unzip();
        let (regressor, expected_regressor) = regressor.unzip();
        // Constants that only a dearer arrangement wanted are dropped.
        let differentiated = tangents.iter().chain(&regressor);
        let read: Vec<Expr<'g>> =
            programs.iter().chain([&joined]).chain(differentiated).flat_map(Program::symbols).collect();
        let constants = hoister.into_constants().into_iter().filter(|(symbol, _)| read.contains(symbol));
        let literal_values: Map<u32, f64> =
            literals.into_iter().flatten().map(|(value, symbol)| (symbol.key(), value.to_f64())).collect();
        let known = |definition: Expr<'g>| {
            let value = Evaluation::new(&literal_values).value(definition);
            let made_of_literals = literals.is_some()
                && Program::lower(&[definition]).symbols().iter().all(|s| literal_values.contains_key(&s.key()));
            // What has no value is left to `kernel()`, which refuses it.
            Some(value).filter(|value| made_of_literals && value.is_finite())
        };
        let (mut symbols, mut values, mut known_constants) = (Vec::new(), Vec::new(), Vec::new());
        for (symbol, definition) in constants {
            match known(definition) {
                Some(value) => known_constants.push((symbol, value)),
                None => {
                    symbols.push(symbol);
                    values.push(definition);
                }
            }
        }
        let mut constants = Constants { program: Program::lower(&values), symbols };
        let by_parameters = wanted.by_parameters.map(|by| by.lower(graph, (&programs, &chosen), &mut constants));
        let (by_parameters, expected_by_parameters) = by_parameters.unzip();
        let kernel = Self {
            constants: constants.program,
            functions: programs,
            joined,
            tangents,
            by_parameters,
            regressor,
            constant_symbols: constants.symbols,
            known_constants,
        };
        chosen.push(&of_joined);
        let sample = Sample { definitions, units: wanted.units, literals: &literal_values };
        kernel.check(graph, &chosen, &sample, &[expected_tangents, expected_by_parameters, expected_regressor])?;
        Ok(kernel)
    }

    /// Runs every program at a pseudo-random point against the expressions that it was lowered from. Roots and logarithms
    /// have domains: it is the first of a few points at which everything has a value. Functions that have none at any of
    /// them cannot be checked. A wrong term is wrong nearly everywhere, roundings grow large near singular points alone:
    /// programs are refused when they disagree at three points.
    fn check(
        &self,
        graph: &'g Graph,
        functions: &[&Vec<Expr<'g>>],
        sample: &Sample<'_, 'g>,
        derived: &[Option<Expected<'_, 'g>>],
    ) -> Result<(), Miscompiled> {
        let outputs = || functions.iter().flat_map(|outputs| outputs.iter());
        let points = (0..16).map(|shift| sample.point(graph, shift));
        let inside = |point: &Map<u32, f64>| {
            let mut evaluation = Evaluation::new(point);
            outputs().all(|e| evaluation.value(*e).is_finite())
        };
        let mut refused = Ok(());
        for point in points.filter(inside).take(3) {
            refused = self.check_at(&point, functions, derived);
            if refused.is_ok() {
                break;
            }
        }
        refused
    }

    /// The programs of derivatives, in the order in which their values are expected.
    pub fn derivatives(&self) -> impl Iterator<Item = Option<&Program<'g>>> {
        [&self.tangents, &self.by_parameters, &self.regressor].into_iter().map(Option::as_ref)
    }

    fn check_at(
        &self,
        point: &Map<u32, f64>,
        functions: &[&Vec<Expr<'g>>],
        derived: &[Option<Expected<'_, 'g>>],
    ) -> Result<(), Miscompiled> {
        let mut values = point.clone();
        let constants = self.constants.run(point);
        values.extend(self.constant_symbols.iter().zip(constants).map(|(s, v)| (s.key(), v)));
        values.extend(self.known_constants.iter().map(|(s, v)| (s.key(), *v)));
        let mut evaluation = Evaluation::new(point);
        for (function, (program, outputs)) in self.functions.iter().chain([&self.joined]).zip(functions).enumerate() {
            let expected: Vec<f64> = outputs.iter().map(|e| evaluation.value(*e)).collect();
            compare(function, &program.run(&values), &expected)?;
        }
        for (program, expected) in self.derivatives().zip(derived) {
            if let (Some(program), Some(expected)) = (program, expected) {
                compare(self.functions.len() + 1, &program.run(&values), &expected.values(&mut evaluation))?;
            }
        }
        Ok(())
    }
}

/// Several functions in one program. What wins alone may have less in common with the rest than what comes first: it is replaced where
/// that costs less.
fn lower_together<'g>(
    hoister: &mut Hoister<'_, 'g>,
    functions: &[Candidates<'g>],
    chosen: &[&Vec<Expr<'g>>],
    joined: &[usize],
) -> (Program<'g>, Vec<Expr<'g>>) {
    let mut lower = |parts: &[&Vec<Expr<'g>>]| {
        let outputs: Vec<Expr<'g>> = parts.iter().flat_map(|part| part.iter()).copied().collect();
        (Program::lower(&hoister.hoist(&outputs)), outputs)
    };
    let mut parts: Vec<&Vec<Expr<'g>>> = joined.iter().map(|&k| chosen[k]).collect();
    let mut best = lower(&parts);
    for (place, &k) in joined.iter().enumerate() {
        let first = &functions[k].arrangements[0];
        if first == parts[place] {
            continue;
        }
        let won = std::mem::replace(&mut parts[place], first);
        let other = lower(&parts);
        if other.0.cost() < best.0.cost() {
            best = other;
        } else {
            parts[place] = won;
        }
    }
    (best.0.with_signs_led_back(), best.1)
}

/// Refuses what is not computed as expected.
fn compare(function: usize, found: &[f64], expected: &[f64]) -> Result<(), Miscompiled> {
    for (output, (&found, &expected)) in found.iter().zip(expected).enumerate() {
        // Inputs are of order one; hundreds of roundings stay far below, a wrong term far above this.
        let close = (found - expected).abs() <= 1e-6 * (1.0 + expected.abs());
        if !close {
            return Err(Miscompiled { function, output, expected, found });
        }
    }
    Ok(())
}

/// What the points of checks must have.
struct Sample<'a, 'g> {
    /// Symbols that stand for expressions of the arguments.
    definitions: &'a Map<u32, Expr<'g>>,
    /// Symbols that are scaled to have the norm 1, list by list.
    units: &'a [Vec<Expr<'g>>],
    /// Symbols that stand for literals.
    literals: &'a Map<u32, f64>,
}

impl<'g> Sample<'_, 'g> {
    /// A value of order one for every symbol, different for each, but for literals, and the values of what is defined by them.
    fn point(&self, graph: &'g Graph, shift: u32) -> Map<u32, f64> {
        let mut point: Map<u32, f64> = graph
            .symbol_keys()
            .into_iter()
            .enumerate()
            .map(|(k, key)| {
                // Multiples of the golden ratio are spread evenly and never equal.
                let fraction = (((k + 1) as f64 + f64::from(shift) * 0.37) * 0.618_033_988_749_894_9).fract();
                (key, 0.6 + fraction)
            })
            .collect();
        point.extend(self.literals);
        for unit in self.units {
            let norm = unit.iter().map(|symbol| point[&symbol.key()].powi(2)).sum::<f64>().sqrt();
            for symbol in unit {
                point.entry(symbol.key()).and_modify(|value| *value /= norm);
            }
        }
        let mut evaluation = Evaluation::new(&point);
        let defined: Vec<(u32, f64)> =
            self.definitions.iter().map(|(&symbol, e)| (symbol, evaluation.value(*e))).collect();
        point.extend(defined);
        point
    }
}
