//! From a network to straight-line code.

use crate::algebra::{Expr, Function, Map, Number, Rational, Set};
use crate::program::{Code, Instruction};

use super::factor::Factoriser;
use super::network::{Network, NetworkNode, NodeIndex};
use super::passes::{Pass, Passes};

/// Straight-line code whose inputs are symbols.
pub type Program<'g> = Code<Expr<'g>>;
/// Operand of an instruction.
pub type Operand<'g> = crate::program::Operand<Expr<'g>>;
/// One step of it.
pub type Operation<'g> = Instruction<Expr<'g>>;

impl<'g> Program<'g> {
    /// Factors, shares, and writes out.
    pub fn lower(outputs: &[Expr<'g>]) -> Self {
        Self::lowered(outputs, Passes::default())
    }

    pub(super) fn lowered(outputs: &[Expr<'g>], passes: Passes) -> Self {
        let mut factoring = Factoriser::default();
        let factored = |&e: &Expr<'g>| if passes.make(Pass::Factors) { factoring.rewrite(e) } else { e };
        let outputs: Vec<_> = outputs.iter().map(factored).collect();
        NetworkWriter::new(Network::new(&outputs, passes), passes).write().verified()
    }

    /// The same with signs where they cost nothing.
    pub(super) fn signed(self, passes: Passes) -> Self {
        if passes.make(Pass::Signs) { self.with_signs_led_back() } else { self }
    }

    /// The same with products within the sums that read them.
    pub(super) fn fused(self, passes: Passes) -> Self {
        if passes.make(Pass::ProductsInSums) { self.with_products_in_sums() } else { self }
    }

    /// The same without a product at the beginning of a sum that something is added to, if there is one.
    pub(super) fn begun(&self, passes: Passes) -> Option<Self> {
        self.sums_begun().filter(|_| passes.make(Pass::Beginnings))
    }

    /// The same computation as it is carried out: products and sums joined, chains that overlap.
    pub(super) fn carried_out(self, passes: Passes) -> Self {
        let fused = self.fused(passes);
        fused.begun(passes).unwrap_or(fused).ordered()
    }

    /// The symbols that the program reads.
    pub fn symbols(&self) -> Vec<Expr<'g>> {
        let mut seen = Set::default();
        let new = |operand| match operand {
            Operand::Input(symbol) if seen.insert(symbol.key()) => Some(symbol),
            _ => None,
        };
        self.operands().filter_map(new).collect()
    }

    /// Runs the program in double precision, with values of symbols by their keys.
    pub fn run<N: Number>(&self, symbols: &Map<u32, N>) -> Vec<N> {
        let input = |symbol: Expr<'_>| symbols.get(&symbol.key()).copied().unwrap_or(N::number(f64::NAN));
        self.evaluate_with(input, Number::stand_in)
    }
}

/// Writes a network as instructions, each node where it is first needed: values are short-lived that way.
struct NetworkWriter<'g> {
    network: Network<'g>,
    /// Number of nodes and outputs that use each node.
    uses: Vec<usize>,
    written: Map<NodeIndex, Operand<'g>>,
    negated: Map<usize, Operand<'g>>,
    /// Instructions in which sines and cosines are computed.
    pairs: Vec<usize>,
    instructions: Vec<Operation<'g>>,
    passes: Passes,
}

impl<'g> NetworkWriter<'g> {
    fn new(network: Network<'g>, passes: Passes) -> Self {
        let mut uses = vec![0; network.nodes.len()];
        let mut reached = vec![false; network.nodes.len()];
        let mut open: Vec<NodeIndex> = network.outputs.iter().map(|&(_, place)| place).collect();
        while let Some(place) = open.pop() {
            uses[place] += 1;
            if std::mem::replace(&mut reached[place], true) {
                continue;
            }
            open.extend(network.nodes[place].parts());
        }
        Self {
            network,
            uses,
            written: Map::default(),
            negated: Map::default(),
            pairs: Vec::new(),
            instructions: Vec::new(),
            passes,
        }
    }

    fn write(mut self) -> Program<'g> {
        for place in self.network.stages() {
            self.operand(place);
        }
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

    fn operand(&mut self, place: NodeIndex) -> Operand<'g> {
        if let Some(&done) = self.written.get(&place) {
            return done;
        }
        let result = match self.network.nodes[place].clone() {
            NetworkNode::Number(value) => Operand::Number(value),
            NetworkNode::Leaf(e) => Operand::Input(e),
            NetworkNode::Product(factors) => self.product(&factors),
            NetworkNode::Reciprocal(a) => {
                let a = self.operand(a);
                self.push(Instruction::Divide(Operand::Number(Rational::one()), a))
            }
            NetworkNode::Call(function, a) if !matches!(function, Function::Sin | Function::Cos) => {
                let a = self.operand(a);
                self.push(Instruction::Call(function, a))
            }
            NetworkNode::Call(function, a) => {
                let a = self.operand(a);
                let pair = Instruction::SineCosine(a);
                let known = self.pairs.iter().copied().find(|&k| self.instructions[k] == pair);
                let index = known.unwrap_or_else(|| {
                    self.push(pair);
                    self.pairs.push(self.instructions.len() - 1);
                    self.instructions.len() - 1
                });
                match function {
                    Function::Sin => Operand::Sine(index),
                    _ => Operand::Cosine(index),
                }
            }
            NetworkNode::Binary(function, a, b) => {
                let (a, b) = (self.operand(a), self.operand(b));
                self.push(Instruction::Binary(function, a, b))
            }
            NetworkNode::Own(function, places) => {
                let arguments = places.map(|place| self.operand(place));
                self.push(Instruction::Own(function, arguments))
            }
            NetworkNode::Sum(terms) => self.sum(&terms),
        };
        self.written.insert(place, result);
        result
    }

    /// A product; reciprocals that nobody else needs become one division.
    fn product(&mut self, factors: &[NodeIndex]) -> Operand<'g> {
        let (below, above): (Vec<NodeIndex>, Vec<NodeIndex>) = factors.iter().partition(|&&f| {
            matches!(self.network.nodes[f], NetworkNode::Reciprocal(_))
                && self.uses[f] == 1
                && !self.written.contains_key(&f)
        });
        if below.is_empty() || above.is_empty() {
            return self.multiply(factors);
        }
        let below: Vec<NodeIndex> = below
            .into_iter()
            .filter_map(|f| if let NetworkNode::Reciprocal(a) = self.network.nodes[f] { Some(a) } else { None })
            .collect();
        let (above, below) = (self.multiply(&above), self.multiply(&below));
        self.push(Instruction::Divide(above, below))
    }

    fn multiply(&mut self, factors: &[NodeIndex]) -> Operand<'g> {
        let mut product = self.operand(factors[0]);
        for &factor in &factors[1..] {
            let factor = self.operand(factor);
            product = self.push(Instruction::Multiply(product, factor));
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
            let result = self.push(Instruction::Negate(value));
            if let Operand::Value(k) = value {
                self.negated.insert(k, result);
            }
            return result;
        }
        if c == Rational::from_integer(2) {
            return self.push(Instruction::Add(value, value));
        }
        self.push(Instruction::Multiply(Operand::Number(c), value))
    }

    /// The two sides of a product that nobody else needs, so that it can be fused with an addition.
    fn fusible(&mut self, place: NodeIndex) -> Option<(Operand<'g>, Operand<'g>)> {
        if self.uses[place] != 1 || self.written.contains_key(&place) || !self.passes.make(Pass::Fusing) {
            return None;
        }
        let NetworkNode::Product(factors) = self.network.nodes[place].clone() else { return None };
        if factors.iter().any(|&f| matches!(self.network.nodes[f], NetworkNode::Reciprocal(_)) && self.uses[f] == 1) {
            return None;
        }
        let (last, rest) = factors.split_last()?;
        Some((self.multiply(rest), self.operand(*last)))
    }

    fn sum(&mut self, terms: &[(Rational, NodeIndex)]) -> Operand<'g> {
        // Terms that are only added come first, a positive one at the head; products are fused onto them.
        let mut order: Vec<usize> = (0..terms.len()).collect();
        let plain = |k: &usize| {
            let (c, place) = terms[*k];
            let fusible = self.uses[place] == 1 && matches!(self.network.nodes[place], NetworkNode::Product(_));
            let scaled = !c.abs().is_one() && !matches!(self.network.nodes[place], NetworkNode::Number(_));
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
                    Instruction::MultiplySubtract(a, b, sum)
                } else {
                    Instruction::MultiplyAdd(a, b, sum)
                });
                continue;
            }
            let value = self.operand(place);
            sum = match (c.abs().is_one(), c.is_negative(), value) {
                (_, _, Operand::Number(n)) => self.push(Instruction::Add(sum, Operand::Number(c * n))),
                (true, false, _) => self.push(Instruction::Add(sum, value)),
                (true, true, _) => self.push(Instruction::Subtract(sum, value)),
                (false, negative, _) => {
                    let factor = Operand::Number(c.abs());
                    self.push(if negative {
                        Instruction::MultiplySubtract(factor, value, sum)
                    } else {
                        Instruction::MultiplyAdd(factor, value, sum)
                    })
                }
            };
        }
        sum
    }
}
