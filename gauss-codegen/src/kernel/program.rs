//! Straight-line programs: single assignment, no loops, no branches.

use crate::algebra::{BinaryFunction, Expr, Function, Map, Number, Rational};

use super::factor::Factoring;
use super::network::{Network, Node, Place};

/// What an instruction works on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Operand<'g> {
    /// An argument of the function or a constant, by its symbol.
    Symbol(Expr<'g>),
    Number(Rational),
    /// The result of an earlier instruction.
    Value(usize),
    /// Sine or cosine out of a pair computed by an earlier instruction.
    Sine(usize),
    Cosine(usize),
}

impl<'g> Operand<'g> {
    /// Whether it changes when the symbols change that are not `constant`; `moving` tells it of earlier instructions.
    pub fn moves(&self, moving: &[bool], constant: impl Fn(Expr<'g>) -> bool) -> bool {
        match *self {
            Operand::Number(_) => false,
            Operand::Symbol(symbol) => !constant(symbol),
            Operand::Value(k) | Operand::Sine(k) | Operand::Cosine(k) => moving[k],
        }
    }
}

/// What a product of series costs in one order, where a sum costs 1: a lane of multiply-adds over the lower orders and two more.
const SERIES_PRODUCT: u32 = 5;

/// One step; its result is `Value(index of the step)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Operation<'g> {
    Add(Operand<'g>, Operand<'g>),
    Subtract(Operand<'g>, Operand<'g>),
    Multiply(Operand<'g>, Operand<'g>),
    /// a·b + c.
    MultiplyAdd(Operand<'g>, Operand<'g>, Operand<'g>),
    /// c − a·b.
    MultiplySubtract(Operand<'g>, Operand<'g>, Operand<'g>),
    Divide(Operand<'g>, Operand<'g>),
    Negate(Operand<'g>),
    /// Sine and cosine of one angle.
    SineCosine(Operand<'g>),
    /// Any function but sine and cosine, which come in pairs.
    Call(Function, Operand<'g>),
    Binary(BinaryFunction, Operand<'g>, Operand<'g>),
}

impl<'g> Operation<'g> {
    /// The same operation on other operands.
    pub(super) fn map(&self, mut f: impl FnMut(Operand<'g>) -> Operand<'g>) -> Self {
        match *self {
            Operation::Add(a, b) => Operation::Add(f(a), f(b)),
            Operation::Subtract(a, b) => Operation::Subtract(f(a), f(b)),
            Operation::Multiply(a, b) => Operation::Multiply(f(a), f(b)),
            Operation::MultiplyAdd(a, b, c) => Operation::MultiplyAdd(f(a), f(b), f(c)),
            Operation::MultiplySubtract(a, b, c) => Operation::MultiplySubtract(f(a), f(b), f(c)),
            Operation::Divide(a, b) => Operation::Divide(f(a), f(b)),
            Operation::Negate(a) => Operation::Negate(f(a)),
            Operation::SineCosine(a) => Operation::SineCosine(f(a)),
            Operation::Call(function, a) => Operation::Call(function, f(a)),
            Operation::Binary(function, a, b) => Operation::Binary(function, f(a), f(b)),
        }
    }

    pub fn operands(&self) -> impl Iterator<Item = Operand<'g>> + use<'g> {
        let (a, b, c) = match *self {
            Operation::Add(a, b)
            | Operation::Subtract(a, b)
            | Operation::Multiply(a, b)
            | Operation::Divide(a, b)
            | Operation::Binary(_, a, b) => (a, Some(b), None),
            Operation::MultiplyAdd(a, b, c) | Operation::MultiplySubtract(a, b, c) => (a, Some(b), Some(c)),
            Operation::Negate(a) | Operation::SineCosine(a) | Operation::Call(_, a) => (a, None, None),
        };
        [Some(a), b, c].into_iter().flatten()
    }
}

/// How much a program computes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    pub additions: u32,
    pub multiplications: u32,
    pub divisions: u32,
    pub roots: u32,
    pub transcendentals: u32,
}

impl Counts {
    /// A single figure to compare arrangements by, in units of one addition. A division or a root keeps its unit busy as long as eight
    /// additions (Fog, Instruction tables: four cycles where two additions start in each), and everything else waits for it.
    pub fn cost(&self) -> u32 {
        self.additions + self.multiplications + 8 * (self.divisions + self.roots) + 15 * self.transcendentals
    }
}

/// How smooth the outputs of a program are, away from singularities.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Smoothness {
    Smooth,
    /// Derivatives jump.
    Kinks,
    /// Values jump.
    Jumps,
}

/// A function as a list of instructions.
#[derive(Clone, Debug)]
pub struct Program<'g> {
    pub instructions: Vec<Operation<'g>>,
    pub outputs: Vec<Operand<'g>>,
}

impl<'g> Program<'g> {
    /// Factors, shares, and writes out.
    pub fn lower(outputs: &[Expr<'g>]) -> Self {
        let mut factoring = Factoring::default();
        let outputs: Vec<_> = outputs.iter().map(|&e| factoring.rewrite(e)).collect();
        Writer::new(Network::new(&outputs)).write()
    }

    pub fn counts(&self) -> Counts {
        let mut counts = Counts::default();
        for instruction in &self.instructions {
            match instruction {
                Operation::Add(..) | Operation::Subtract(..) => counts.additions += 1,
                Operation::Multiply(..) => counts.multiplications += 1,
                Operation::MultiplyAdd(..) | Operation::MultiplySubtract(..) => {
                    counts.additions += 1;
                    counts.multiplications += 1;
                }
                Operation::Divide(..) => counts.divisions += 1,
                Operation::Negate(_) => {}
                Operation::SineCosine(_) => counts.transcendentals += 2,
                Operation::Call(Function::Sqrt, _) => counts.roots += 1,
                // A comparison costs what an addition costs.
                Operation::Call(Function::Abs | Function::Signum, _)
                | Operation::Binary(BinaryFunction::Min | BinaryFunction::Max, ..) => counts.additions += 1,
                Operation::Call(..) | Operation::Binary(..) => counts.transcendentals += 1,
            }
        }
        counts
    }

    /// A single figure to compare arrangements by, in units of one addition of which two start in a cycle: all instructions, and the
    /// longest chain of them that wait for one another. Of the chain a quarter counts: a call alone would wait for all of it, calls
    /// that overlap for none.
    pub fn cost(&self) -> u32 {
        self.counts().cost() + self.latency() / 2
    }

    /// Cycles from the arguments to the last output, were there no limit to what runs at once (Fog, Instruction tables: four for
    /// additions and products, fifteen for divisions and roots; forty for inlined sines and cosines).
    fn latency(&self) -> u32 {
        let mut ready: Vec<u32> = Vec::with_capacity(self.instructions.len());
        let of = |operand: &Operand<'g>, ready: &[u32]| match *operand {
            Operand::Symbol(_) | Operand::Number(_) => 0,
            Operand::Value(k) | Operand::Sine(k) | Operand::Cosine(k) => ready[k],
        };
        for instruction in &self.instructions {
            let own = match instruction {
                Operation::Negate(_) => 1,
                Operation::Divide(..) | Operation::Call(Function::Sqrt, _) => 15,
                Operation::SineCosine(_) => 40,
                Operation::Call(Function::Abs | Function::Signum, _)
                | Operation::Binary(BinaryFunction::Min | BinaryFunction::Max, ..) => 4,
                Operation::Call(..) | Operation::Binary(..) => 60,
                _ => 4,
            };
            let start = instruction.operands().map(|operand| of(&operand, &ready)).max().unwrap_or(0);
            ready.push(start + own);
        }
        self.outputs.iter().map(|output| of(output, &ready)).max().unwrap_or(0)
    }

    /// That of its roughest instruction.
    pub fn smoothness(&self) -> Smoothness {
        let of = |operation: &Operation<'g>| match operation {
            Operation::Call(Function::Signum, _) => Smoothness::Jumps,
            Operation::Call(Function::Abs, _) | Operation::Binary(BinaryFunction::Min | BinaryFunction::Max, ..) => {
                Smoothness::Kinks
            }
            _ => Smoothness::Smooth,
        };
        self.instructions.iter().map(of).max().unwrap_or(Smoothness::Smooth)
    }

    /// Which instructions compute something that changes, when the symbols change that are not `constant`.
    pub fn moving(&self, constant: impl Fn(Expr<'g>) -> bool) -> Vec<bool> {
        let mut moving: Vec<bool> = Vec::with_capacity(self.instructions.len());
        for instruction in &self.instructions {
            let moves = instruction.operands().any(|operand| operand.moves(&moving, &constant));
            moving.push(moves);
        }
        moving
    }

    /// Which instructions add up or multiply something that one other instruction adds to something else, and nobody else reads.
    pub fn added_once(&self) -> Vec<bool> {
        let mut uses = vec![0_usize; self.instructions.len()];
        let mut added = vec![false; self.instructions.len()];
        for operand in self.operands() {
            if let Operand::Value(k) = operand {
                uses[k] += 1;
            }
        }
        for instruction in &self.instructions {
            let addends = match instruction {
                Operation::Add(a, b) | Operation::Subtract(a, b) => [Some(a), Some(b)],
                Operation::MultiplyAdd(_, _, c) | Operation::MultiplySubtract(_, _, c) | Operation::Negate(c) => {
                    [Some(c), None]
                }
                _ => [None, None],
            };
            for addend in addends.into_iter().flatten() {
                if let Operand::Value(k) = addend {
                    added[*k] = true;
                }
            }
        }
        let adds = |instruction: &Operation<'g>| {
            matches!(
                instruction,
                Operation::Add(..)
                    | Operation::Subtract(..)
                    | Operation::Negate(_)
                    | Operation::Multiply(..)
                    | Operation::MultiplyAdd(..)
                    | Operation::MultiplySubtract(..)
            )
        };
        (0..added.len()).map(|k| added[k] && uses[k] == 1 && adds(&self.instructions[k])).collect()
    }

    /// What one order of the power series of the outputs costs, roughly: products of what changes are sums over all lower orders.
    pub fn series_cost(&self, constant: impl Fn(Expr<'g>) -> bool) -> u32 {
        let moving = self.moving(&constant);
        let cost = |(instruction, &moves): (&Operation<'g>, &bool)| {
            let both = |a: &Operand<'g>, b: &Operand<'g>| a.moves(&moving, &constant) && b.moves(&moving, &constant);
            match instruction {
                _ if !moves => 0,
                Operation::Multiply(a, b) | Operation::MultiplyAdd(a, b, _) | Operation::MultiplySubtract(a, b, _)
                    if both(a, b) =>
                {
                    SERIES_PRODUCT
                }
                Operation::Divide(_, b) if b.moves(&moving, &constant) => SERIES_PRODUCT,
                Operation::Call(..) => SERIES_PRODUCT,
                Operation::SineCosine(_) => 2 * SERIES_PRODUCT,
                Operation::Binary(..) => 4 * SERIES_PRODUCT,
                _ => 1,
            }
        };
        self.instructions.iter().zip(&moving).map(cost).sum()
    }

    /// A function without a power series that the program calls, as users write it.
    pub fn function_without_series(&self) -> Option<&'static str> {
        self.instructions.iter().find_map(|instruction| match instruction {
            Operation::Call(Function::Abs, _) => Some("abs"),
            Operation::Call(Function::Signum, _) => Some("signum"),
            Operation::Binary(BinaryFunction::Min, ..) => Some("min"),
            Operation::Binary(BinaryFunction::Max, ..) => Some("max"),
            _ => None,
        })
    }

    /// Everything that the program reads, repeatedly where it is read repeatedly.
    pub fn operands(&self) -> impl Iterator<Item = Operand<'g>> {
        self.instructions.iter().flat_map(Operation::operands).chain(self.outputs.iter().copied())
    }

    /// The symbols that the program reads.
    pub fn symbols(&self) -> Vec<Expr<'g>> {
        let mut symbols: Vec<Expr<'g>> = Vec::new();
        for operand in self.operands() {
            if let Operand::Symbol(e) = operand
                && !symbols.contains(&e)
            {
                symbols.push(e);
            }
        }
        symbols
    }

    /// Interprets the program.
    pub fn run<N: Number>(&self, symbols: &Map<u32, N>) -> Vec<N> {
        let mut values: Vec<(N, N)> = Vec::with_capacity(self.instructions.len());
        let zero = N::from_f64(0.0);
        let get = |operand: &Operand<'g>, values: &[(N, N)]| match operand {
            Operand::Symbol(e) => symbols.get(&e.key()).copied().unwrap_or(N::from_f64(f64::NAN)),
            Operand::Number(value) => N::fraction(*value),
            Operand::Value(k) | Operand::Sine(k) => values[*k].0,
            Operand::Cosine(k) => values[*k].1,
        };
        for instruction in &self.instructions {
            let at = |operand: &Operand<'g>| get(operand, &values);
            let value = match instruction {
                Operation::Add(a, b) => (at(a) + at(b), zero),
                Operation::Subtract(a, b) => (at(a) - at(b), zero),
                Operation::Multiply(a, b) => (at(a) * at(b), zero),
                Operation::MultiplyAdd(a, b, c) => (at(a) * at(b) + at(c), zero),
                Operation::MultiplySubtract(a, b, c) => (at(c) - at(a) * at(b), zero),
                Operation::Divide(a, b) => (at(a) / at(b), zero),
                Operation::Negate(a) => (-at(a), zero),
                Operation::SineCosine(a) => at(a).sine_cosine(),
                Operation::Call(function, a) => (at(a).call(*function), zero),
                Operation::Binary(function, a, b) => (at(a).call_with(*function, at(b)), zero),
            };
            values.push(value);
        }
        self.outputs.iter().map(|o| get(o, &values)).collect()
    }
}

/// Writes a network as instructions, each node where it is first needed: values are short-lived that way.
struct Writer<'g> {
    network: Network<'g>,
    /// How many nodes and outputs use each node.
    uses: Vec<usize>,
    written: Map<Place, Operand<'g>>,
    negated: Map<usize, Operand<'g>>,
    instructions: Vec<Operation<'g>>,
}

impl<'g> Writer<'g> {
    fn new(network: Network<'g>) -> Self {
        let mut uses = vec![0; network.nodes.len()];
        let mut reached = vec![false; network.nodes.len()];
        let mut open: Vec<Place> = network.outputs.iter().map(|&(_, place)| place).collect();
        while let Some(place) = open.pop() {
            uses[place] += 1;
            if std::mem::replace(&mut reached[place], true) {
                continue;
            }
            match &network.nodes[place] {
                Node::Number(_) | Node::Leaf(_) => {}
                Node::Sum(terms) => open.extend(terms.iter().map(|t| t.1)),
                Node::Product(factors) => open.extend(factors),
                Node::Reciprocal(a) => open.push(*a),
                Node::Call(_, a) => open.push(*a),
                Node::Binary(_, a, b) => open.extend([*a, *b]),
            }
        }
        Self { network, uses, written: Map::default(), negated: Map::default(), instructions: Vec::new() }
    }

    fn write(mut self) -> Program<'g> {
        let outputs = self.network.outputs.clone();
        let outputs = outputs
            .into_iter()
            .map(|(c, place)| {
                let value = self.operand(place);
                self.scaled(c, value)
            })
            .collect();
        Program { instructions: self.instructions, outputs }
    }

    fn push(&mut self, instruction: Operation<'g>) -> Operand<'g> {
        self.instructions.push(instruction);
        Operand::Value(self.instructions.len() - 1)
    }

    fn operand(&mut self, place: Place) -> Operand<'g> {
        if let Some(&done) = self.written.get(&place) {
            return done;
        }
        let result = match self.network.nodes[place].clone() {
            Node::Number(value) => Operand::Number(value),
            Node::Leaf(e) => Operand::Symbol(e),
            Node::Product(factors) => self.product(&factors),
            Node::Reciprocal(a) => {
                let a = self.operand(a);
                self.push(Operation::Divide(Operand::Number(Rational::one()), a))
            }
            Node::Call(
                function @ (Function::Exp | Function::Ln | Function::Sqrt | Function::Abs | Function::Signum),
                a,
            ) => {
                let a = self.operand(a);
                self.push(Operation::Call(function, a))
            }
            Node::Call(function, a) => {
                let a = self.operand(a);
                let pair = Operation::SineCosine(a);
                let index = match self.instructions.iter().position(|i| *i == pair) {
                    Some(index) => index,
                    None => {
                        self.push(pair);
                        self.instructions.len() - 1
                    }
                };
                match function {
                    Function::Sin => Operand::Sine(index),
                    _ => Operand::Cosine(index),
                }
            }
            Node::Binary(function, a, b) => {
                let (a, b) = (self.operand(a), self.operand(b));
                self.push(Operation::Binary(function, a, b))
            }
            Node::Sum(terms) => self.sum(&terms),
        };
        self.written.insert(place, result);
        result
    }

    /// A product; reciprocals that nobody else needs become one division.
    fn product(&mut self, factors: &[Place]) -> Operand<'g> {
        let (below, above): (Vec<Place>, Vec<Place>) = factors.iter().partition(|&&f| {
            matches!(self.network.nodes[f], Node::Reciprocal(_)) && self.uses[f] == 1 && !self.written.contains_key(&f)
        });
        if below.is_empty() || above.is_empty() {
            return self.multiply(factors);
        }
        let below: Vec<Place> = below
            .into_iter()
            .filter_map(|f| if let Node::Reciprocal(a) = self.network.nodes[f] { Some(a) } else { None })
            .collect();
        let (above, below) = (self.multiply(&above), self.multiply(&below));
        self.push(Operation::Divide(above, below))
    }

    fn multiply(&mut self, factors: &[Place]) -> Operand<'g> {
        let mut product = self.operand(factors[0]);
        for &factor in &factors[1..] {
            let factor = self.operand(factor);
            product = self.push(Operation::Multiply(product, factor));
        }
        product
    }

    /// c · value.
    fn scaled(&mut self, c: Rational, value: Operand<'g>) -> Operand<'g> {
        if c.is_one() {
            return value;
        }
        if let Operand::Number(n) = value {
            return Operand::Number(c * n);
        }
        if (-c).is_one() {
            if let Operand::Value(k) = value
                && let Some(&done) = self.negated.get(&k)
            {
                return done;
            }
            let result = self.push(Operation::Negate(value));
            if let Operand::Value(k) = value {
                self.negated.insert(k, result);
            }
            return result;
        }
        if c == Rational::from_integer(2) {
            return self.push(Operation::Add(value, value));
        }
        self.push(Operation::Multiply(Operand::Number(c), value))
    }

    /// The two sides of a product that nobody else needs, so that it can be fused with an addition.
    fn fusible(&mut self, place: Place) -> Option<(Operand<'g>, Operand<'g>)> {
        if self.uses[place] != 1 || self.written.contains_key(&place) {
            return None;
        }
        let Node::Product(factors) = self.network.nodes[place].clone() else { return None };
        if factors.iter().any(|&f| matches!(self.network.nodes[f], Node::Reciprocal(_)) && self.uses[f] == 1) {
            return None;
        }
        let (last, rest) = factors.split_last()?;
        Some((self.multiply(rest), self.operand(*last)))
    }

    fn sum(&mut self, terms: &[(Rational, Place)]) -> Operand<'g> {
        // Terms that are only added come first, a positive one at the head; products are fused onto them.
        let mut order: Vec<usize> = (0..terms.len()).collect();
        let plain = |k: &usize| {
            let (c, place) = terms[*k];
            let fusible = self.uses[place] == 1 && matches!(self.network.nodes[place], Node::Product(_));
            let scaled = !c.abs().is_one() && !matches!(self.network.nodes[place], Node::Number(_));
            (fusible || scaled, c.is_negative(), *k)
        };
        order.sort_by_key(plain);
        let (c, place) = terms[order[0]];
        let first = self.operand(place);
        let mut sum = self.scaled(c, first);
        for &k in &order[1..] {
            let (c, place) = terms[k];
            if c.abs().is_one()
                && let Some((a, b)) = self.fusible(place)
            {
                sum = self.push(if c.is_negative() {
                    Operation::MultiplySubtract(a, b, sum)
                } else {
                    Operation::MultiplyAdd(a, b, sum)
                });
                continue;
            }
            let value = self.operand(place);
            sum = match (c.abs().is_one(), c.is_negative(), value) {
                (_, _, Operand::Number(n)) => self.push(Operation::Add(sum, Operand::Number(c * n))),
                (true, false, _) => self.push(Operation::Add(sum, value)),
                (true, true, _) => self.push(Operation::Subtract(sum, value)),
                (false, negative, _) => {
                    let factor = Operand::Number(c.abs());
                    self.push(if negative {
                        Operation::MultiplySubtract(factor, value, sum)
                    } else {
                        Operation::MultiplyAdd(factor, value, sum)
                    })
                }
            };
        }
        sum
    }
}
