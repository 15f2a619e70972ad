//! The expression graph: every distinct expression exists once, so equality is equality of indices and sharing is free.

use std::cell::{Cell, RefCell};
use std::collections::hash_map::Entry;
use std::hash::{Hash, Hasher};
use std::iter::Sum;
use std::ops::{Add, Mul, Neg, Sub};
use std::rc::Rc;

use super::map::Map;
use super::rational::Rational;

/// A function of one argument that the language knows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Function {
    /// Sine of an angle in radians.
    Sin,
    /// Cosine of an angle in radians.
    Cos,
    /// Exponential.
    Exp,
    /// Natural logarithm.
    Ln,
    /// Square root.
    Sqrt,
    /// Absolute value.
    Abs,
    /// −1, 0 or 1.
    Signum,
}

/// A function of two arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum BinaryFunction {
    /// Angle of the point (x, y), given as y and x.
    Atan2,
    /// The smaller one.
    Min,
    /// The larger one.
    Max,
}

impl Function {
    /// What users write.
    pub const fn name(self) -> &'static str {
        match self {
            Function::Sin => "sin",
            Function::Cos => "cos",
            Function::Exp => "exp",
            Function::Ln => "ln",
            Function::Sqrt => "sqrt",
            Function::Abs => "abs",
            Function::Signum => "signum",
        }
    }
}

impl BinaryFunction {
    /// What users write.
    pub const fn name(self) -> &'static str {
        match self {
            BinaryFunction::Atan2 => "atan2",
            BinaryFunction::Min => "min",
            BinaryFunction::Max => "max",
        }
    }
}

/// What a symbol stands for, as far as algebra cares: its names, and whether it is fixed once the parameters are known.
#[derive(Clone, Debug)]
pub struct Symbol {
    /// Name in plain text.
    pub text: String,
    /// Name in LaTeX.
    pub latex: String,
    /// Fixed for a given set of parameters; everything made of such symbols alone is computed once.
    pub constant: bool,
}

/// Index of a node in its graph. Children always have smaller indices than their parents.
pub(super) type Id = u32;
/// The numbers 0 and 1, which every graph begins with.
const ZERO: Id = 0;
const ONE: Id = 1;

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Node {
    Number(Rational),
    Symbol(u32),
    /// Σ cᵢ eᵢ, sorted by index, coefficients nonzero; a constant term is a multiple of the number one.
    Sum(Rc<[(Rational, Id)]>),
    /// Π eᵢ^nᵢ, sorted by index, exponents nonzero; no numbers and no products among the factors.
    Product(Rc<[(Id, i32)]>),
    Call(Function, Id),
    Binary(BinaryFunction, Id, Id),
    /// A sum that is to be computed once under a name: transparent for mathematics, a barrier for flattening.
    Group(Id),
    /// A constant that is to be computed once and never looked into again, not even by the normal form.
    Opaque(Id),
}

impl Node {
    /// What it is made of.
    pub(super) fn children(&self) -> Vec<Id> {
        match self {
            Node::Number(_) | Node::Symbol(_) => Vec::new(),
            Node::Sum(terms) => terms.iter().map(|&(_, id)| id).collect(),
            Node::Product(factors) => factors.iter().map(|&(id, _)| id).collect(),
            Node::Call(_, id) | Node::Group(id) | Node::Opaque(id) => vec![*id],
            Node::Binary(_, a, b) => vec![*a, *b],
        }
    }
}

/// In one word: hashing piece by piece is most of a look-up in unoptimised code.
impl Hash for Node {
    fn hash<H: Hasher>(&self, state: &mut H) {
        /// Any odd number whose digits look random.
        const SPREAD: u64 = 0x9e37_79b9_7f4a_7c15;
        let mut word = match self {
            Node::Number(value) => value.hash_word(),
            Node::Symbol(symbol) => 1 << 32 | u64::from(*symbol),
            Node::Sum(_) => 2,
            Node::Product(_) => 3,
            Node::Call(function, id) => (4 + *function as u64) << 32 | u64::from(*id),
            Node::Binary(function, a, b) => (64 + *function as u64) << 48 | u64::from(*a) << 24 ^ u64::from(*b),
            Node::Group(id) => 128 << 32 | u64::from(*id),
            Node::Opaque(id) => 129 << 32 | u64::from(*id),
        };
        if let Node::Sum(terms) = self {
            for (c, id) in terms.iter() {
                word = (word.rotate_left(5) ^ c.hash_word() ^ (*id as u64) << 32).wrapping_mul(SPREAD);
            }
        }
        if let Node::Product(factors) = self {
            for (id, n) in factors.iter() {
                word = (word.rotate_left(5) ^ *n as u64 ^ (*id as u64) << 32).wrapping_mul(SPREAD);
            }
        }
        state.write_u64(word);
    }
}

/// What a node is, with its children as expressions.
pub enum NodeView<'g> {
    Number(Rational),
    Symbol(u32),
    Sum(Vec<(Rational, Expr<'g>)>),
    Product(Vec<(Expr<'g>, i32)>),
    Call(Function, Expr<'g>),
    Binary(BinaryFunction, Expr<'g>, Expr<'g>),
    Group(Expr<'g>),
    Opaque(Expr<'g>),
}

/// The arena of all expressions of one derivation.
pub struct Graph {
    nodes: RefCell<Vec<Node>>,
    /// Whether every symbol in a node is constant.
    constant: RefCell<Vec<bool>>,
    index: RefCell<Map<Node, Id>>,
    symbols: RefCell<Vec<Symbol>>,
    undefined: Cell<bool>,
}

/// An expression: a node of a graph. Copies are free and equality is structural.
#[derive(Clone, Copy)]
pub struct Expr<'g> {
    pub(super) graph: &'g Graph,
    pub(super) id: Id,
}

impl Graph {
    pub fn new() -> Self {
        let (nodes, constant, index, symbols, undefined) = Default::default();
        let graph = Self { nodes, constant, index, symbols, undefined };
        // They are asked for so often that looking them up would take time: see `zero` and `one`.
        graph.intern(Node::Number(Rational::zero()));
        graph.intern(Node::Number(Rational::one()));
        graph
    }

    /// True once something was divided by zero, or by a number beyond any use in double precision; every result is then meaningless.
    pub fn is_undefined(&self) -> bool {
        self.undefined.get()
    }

    /// A new symbol; two calls give two different symbols even when the names agree.
    pub fn symbol(&self, text: impl Into<String>, latex: impl Into<String>, constant: bool) -> Expr<'_> {
        let mut symbols = self.symbols.borrow_mut();
        symbols.push(Symbol { text: text.into(), latex: latex.into(), constant });
        let symbol = symbols.len() as u32 - 1;
        drop(symbols);
        self.intern(Node::Symbol(symbol))
    }

    /// Keys of all symbols made so far.
    pub fn symbol_keys(&self) -> Vec<u32> {
        let nodes = self.nodes.borrow();
        (0..nodes.len() as Id).filter(|&id| matches!(nodes[id as usize], Node::Symbol(_))).collect()
    }

    pub(super) fn with_symbol<R>(&self, symbol: u32, read: impl FnOnce(&Symbol) -> R) -> R {
        read(&self.symbols.borrow()[symbol as usize])
    }

    pub(super) fn any_symbol(&self, holds: impl FnMut(&Symbol) -> bool) -> bool {
        self.symbols.borrow().iter().any(holds)
    }

    /// All that expressions are made of, they too; parts come before what is made of them.
    pub(super) fn reached(&self, roots: &[Id], parts: impl Fn(&Self, Id) -> Vec<Id>) -> Vec<Id> {
        let (mut found, mut open) = (Map::default(), roots.to_vec());
        while let Some(id) = open.pop() {
            if found.insert(id, ()).is_none() {
                open.extend(parts(self, id));
            }
        }
        let mut found: Vec<Id> = found.into_keys().collect();
        found.sort_unstable();
        found
    }

    /// About how many operations expressions take together, each part computed once.
    pub fn operations(&self, outputs: &[Expr<'_>]) -> usize {
        let roots: Vec<Id> = outputs.iter().map(|e| e.id).collect();
        let children = |graph: &Self, id: Id| graph.node(id).children();
        self.reached(&roots, children).into_iter().map(|id| children(self, id).len()).sum()
    }

    /// What a group is a group of.
    pub(super) fn ungrouped(&self, mut id: Id) -> Id {
        while let Node::Group(inner) | Node::Opaque(inner) = self.node(id) {
            id = inner;
        }
        id
    }

    pub fn zero(&self) -> Expr<'_> {
        self.expr(ZERO)
    }

    pub fn one(&self) -> Expr<'_> {
        self.expr(ONE)
    }

    pub fn integer(&self, value: i64) -> Expr<'_> {
        self.number(Rational::from_integer(value))
    }

    pub fn number(&self, value: Rational) -> Expr<'_> {
        if value.is_undefined() {
            self.undefined.set(true);
        }
        self.intern(Node::Number(value))
    }

    pub(super) fn intern(&self, node: Node) -> Expr<'_> {
        let id = match self.index.borrow_mut().entry(node) {
            Entry::Occupied(known) => *known.get(),
            Entry::Vacant(place) => {
                let mut nodes = self.nodes.borrow_mut();
                let id = nodes.len() as Id;
                let constant = self.is_made_of_constants(place.key());
                self.constant.borrow_mut().push(constant);
                nodes.push(place.key().clone());
                *place.insert(id)
            }
        };
        Expr { graph: self, id }
    }

    fn is_made_of_constants(&self, node: &Node) -> bool {
        let known = self.constant.borrow();
        match node {
            Node::Number(_) => true,
            Node::Symbol(symbol) => self.with_symbol(*symbol, |s| s.constant),
            Node::Sum(terms) => terms.iter().all(|&(_, id)| known[id as usize]),
            Node::Product(factors) => factors.iter().all(|&(id, _)| known[id as usize]),
            Node::Call(_, id) | Node::Group(id) | Node::Opaque(id) => known[*id as usize],
            Node::Binary(_, a, b) => known[*a as usize] && known[*b as usize],
        }
    }

    pub(super) fn node(&self, id: Id) -> Node {
        self.nodes.borrow()[id as usize].clone()
    }

    pub(super) fn expr(&self, id: Id) -> Expr<'_> {
        Expr { graph: self, id }
    }

    /// Σ cᵢ eᵢ, flattened and collected.
    pub fn sum<'g>(&'g self, terms: impl IntoIterator<Item = (Rational, Expr<'g>)>) -> Expr<'g> {
        let mut flat: Vec<(Rational, Id)> = Vec::new();
        for (coefficient, term) in terms {
            self.push_term(&mut flat, coefficient, term.id);
        }
        self.collected_sum(flat)
    }

    fn push_term(&self, flat: &mut Vec<(Rational, Id)>, coefficient: Rational, id: Id) {
        if coefficient.is_zero() {
            return;
        }
        match &self.nodes.borrow()[id as usize] {
            Node::Number(value) => flat.push((coefficient * *value, ONE)),
            Node::Sum(inner) if coefficient.is_one() => flat.extend_from_slice(inner),
            Node::Sum(inner) => {
                for &(c, id) in inner.iter() {
                    flat.push((coefficient * c, id));
                }
            }
            _ => flat.push((coefficient, id)),
        }
    }

    fn collected_sum(&self, mut terms: Vec<(Rational, Id)>) -> Expr<'_> {
        sort_by_id(&mut terms, |&(_, id)| id);
        let mut count = 0;
        for k in 0..terms.len() {
            let (c, id) = terms[k];
            if count > 0 && terms[count - 1].1 == id {
                terms[count - 1].0 = terms[count - 1].0.plus(c);
                continue;
            }
            // What has cancelled gives up its place.
            if count > 0 && terms[count - 1].0.is_zero() {
                count -= 1;
            }
            terms[count] = (c, id);
            count += 1;
        }
        if count > 0 && terms[count - 1].0.is_zero() {
            count -= 1;
        }
        terms.truncate(count);
        for (c, _) in &terms {
            if c.is_undefined() {
                self.undefined.set(true);
            }
        }
        match terms[..] {
            [] => self.zero(),
            [(c, ONE)] => self.number(c),
            [(c, id)] if c.is_one() => self.expr(id),
            // A multiple of a sum distributes, so that `2·(a + b)` and `2·a + 2·b` are one node.
            [(c, id)] => match self.node(id) {
                Node::Sum(inner) => {
                    let terms = inner.iter().map(|&(d, id)| (c * d, id)).collect();
                    self.intern(Node::Sum(terms))
                }
                _ => self.intern(Node::Sum(terms.into())),
            },
            _ => self.intern(Node::Sum(terms.into())),
        }
    }

    /// c · Π eᵢ^nᵢ, flattened and collected. A sum among the factors gives up its rational content and its sign, so
    /// that `(a − b)·(b − a)⁻¹` is −1.
    pub fn product<'g>(
        &'g self,
        coefficient: Rational,
        factors: impl IntoIterator<Item = (Expr<'g>, i32)>,
    ) -> Expr<'g> {
        let mut coefficient = coefficient;
        let mut flat: Vec<(Id, i32)> = Vec::new();
        for (factor, exponent) in factors {
            self.push_factor(&mut coefficient, &mut flat, factor.id, exponent);
        }
        self.collected_product(coefficient, flat)
    }

    fn collected_product(&self, coefficient: Rational, mut factors: Vec<(Id, i32)>) -> Expr<'_> {
        sort_by_id(&mut factors, |&(id, _)| id);
        let mut count = 0;
        for k in 0..factors.len() {
            let (id, n) = factors[k];
            if count > 0 && factors[count - 1].0 == id {
                factors[count - 1].1 += n;
                continue;
            }
            if count > 0 && factors[count - 1].1 == 0 {
                count -= 1;
            }
            factors[count] = (id, n);
            count += 1;
        }
        if count > 0 && factors[count - 1].1 == 0 {
            count -= 1;
        }
        factors.truncate(count);
        let base = match factors[..] {
            [] => return self.number(coefficient),
            [(id, 1)] => self.expr(id),
            _ => self.intern(Node::Product(factors.into())),
        };
        if coefficient.is_one() { base } else { base.scale(coefficient) }
    }

    fn push_factor(&self, coefficient: &mut Rational, flat: &mut Vec<(Id, i32)>, id: Id, exponent: i32) {
        let terms = match &self.nodes.borrow()[id as usize] {
            Node::Number(value) => {
                *coefficient *= value.pow(exponent);
                return;
            }
            Node::Product(inner) => {
                for &(id, n) in inner.iter() {
                    flat.push((id, n * exponent));
                }
                return;
            }
            Node::Sum(terms) => Rc::clone(terms),
            _ => {
                flat.push((id, exponent));
                return;
            }
        };
        let content = self.content(&terms);
        *coefficient *= content.pow(exponent);
        if let [(_, only)] = terms.as_ref() {
            self.push_factor(coefficient, flat, *only, exponent);
        } else if content.is_one() {
            flat.push((id, exponent));
        } else {
            let scale = content.recip();
            let primitive = terms.iter().map(|&(c, id)| (scale * c, id)).collect();
            flat.push((self.intern(Node::Sum(primitive)).id, exponent));
        }
    }

    /// The rational content of a sum: greatest common divisor of the coefficients, with the sign of the first.
    fn content(&self, terms: &[(Rational, Id)]) -> Rational {
        let mut content = Rational::zero();
        for &(c, _) in terms {
            content = content.common_divisor(c);
        }
        if terms[0].0.is_negative() { -content } else { content }
    }

    /// Powers that all terms have in common.
    fn common_factors(&self, terms: &[(Rational, Id)]) -> Vec<(Id, i32)> {
        let nodes = self.nodes.borrow();
        let mut common = match &nodes[terms[0].1 as usize] {
            Node::Product(factors) => factors.to_vec(),
            _ => vec![(terms[0].1, 1)],
        };
        for &(_, id) in &terms[1..] {
            let single = [(id, 1)];
            let factors = match &nodes[id as usize] {
                Node::Product(factors) => factors.as_ref(),
                _ => single.as_slice(),
            };
            common.retain_mut(|(f, n)| {
                let Some(&(_, m)) = factors.iter().find(|(g, _)| g == f) else { return false };
                let shared = n.signum() == m.signum();
                *n = if *n > 0 { (*n).min(m) } else { (*n).max(m) };
                shared
            });
            if common.is_empty() {
                break;
            }
        }
        common
    }

    /// A function of an expression, with the values at zero and one and the parity of sine and cosine taken care of.
    pub fn call<'g>(&'g self, function: Function, argument: Expr<'g>) -> Expr<'g> {
        if argument.is_zero() {
            match function {
                Function::Sin | Function::Sqrt | Function::Abs | Function::Signum => return self.zero(),
                Function::Cos | Function::Exp => return self.one(),
                // Not a number: it is left to whoever evaluates it.
                Function::Ln => {}
            }
        }
        if argument == self.one() {
            match function {
                Function::Ln => return self.zero(),
                Function::Sqrt | Function::Abs | Function::Signum => return self.one(),
                _ => {}
            }
        }
        if matches!(function, Function::Sin | Function::Cos)
            && let Node::Sum(terms) = self.node(argument.id)
            && self.content(&terms).is_negative()
        {
            let positive = self.intern(Node::Call(function, (-argument).id));
            return match function {
                Function::Sin => -positive,
                _ => positive,
            };
        }
        self.intern(Node::Call(function, argument.id))
    }
}

impl<'g> Expr<'g> {
    pub fn graph(self) -> &'g Graph {
        self.graph
    }

    /// The index of the node: a name for maps, smaller for what was built earlier.
    pub fn key(self) -> u32 {
        self.id
    }

    pub fn view(self) -> NodeView<'g> {
        let at = |id| self.graph.expr(id);
        match self.graph.node(self.id) {
            Node::Number(value) => NodeView::Number(value),
            Node::Symbol(symbol) => NodeView::Symbol(symbol),
            Node::Sum(terms) => NodeView::Sum(terms.iter().map(|&(c, id)| (c, at(id))).collect()),
            Node::Product(factors) => NodeView::Product(factors.iter().map(|&(id, n)| (at(id), n)).collect()),
            Node::Call(function, id) => NodeView::Call(function, at(id)),
            Node::Binary(function, a, b) => NodeView::Binary(function, at(a), at(b)),
            Node::Group(id) => NodeView::Group(at(id)),
            Node::Opaque(id) => NodeView::Opaque(at(id)),
        }
    }

    pub fn as_number(self) -> Option<Rational> {
        match &self.graph.nodes.borrow()[self.id as usize] {
            Node::Number(value) => Some(*value),
            _ => None,
        }
    }

    pub fn is_zero(self) -> bool {
        self.id == ZERO
    }

    pub fn powi(self, exponent: i32) -> Self {
        self.graph.product(Rational::one(), [(self, exponent)])
    }

    pub fn recip(self) -> Self {
        self.powi(-1)
    }

    pub fn scale(self, factor: Rational) -> Self {
        if self.id == ZERO || factor.is_one() {
            return self;
        }
        let mut terms = Vec::new();
        self.graph.push_term(&mut terms, factor, self.id);
        self.graph.collected_sum(terms)
    }

    /// self + factor · other.
    fn plus_multiple(self, factor: Rational, other: Self) -> Self {
        if other.id == ZERO {
            return self;
        }
        if self.id == ZERO {
            return other.scale(factor);
        }
        let mut terms = Vec::with_capacity(4);
        self.graph.push_term(&mut terms, Rational::one(), self.id);
        self.graph.push_term(&mut terms, factor, other.id);
        self.graph.collected_sum(terms)
    }

    pub fn half(self) -> Self {
        self.scale(Rational::new(1, 2))
    }

    pub fn sin(self) -> Self {
        self.graph.call(Function::Sin, self)
    }

    pub fn cos(self) -> Self {
        self.graph.call(Function::Cos, self)
    }

    pub fn exp(self) -> Self {
        self.graph.call(Function::Exp, self)
    }

    pub fn ln(self) -> Self {
        self.graph.call(Function::Ln, self)
    }

    pub fn sqrt(self) -> Self {
        self.graph.call(Function::Sqrt, self)
    }

    pub fn abs(self) -> Self {
        self.graph.call(Function::Abs, self)
    }

    pub fn binary(self, function: BinaryFunction, other: Self) -> Self {
        self.graph.intern(Node::Binary(function, self.id, other.id))
    }

    /// The same value as a quantity of its own: sums around it do not take it apart, so it is computed once. Factors
    /// that all its terms share are pulled out first, which lets a mass cancel later.
    pub fn group(self) -> Self {
        let Node::Sum(terms) = self.graph.node(self.id) else { return self };
        if terms.len() < 2 {
            return self;
        }
        let common = self.graph.common_factors(&terms);
        let content = self.graph.content(&terms);
        if common.is_empty() && content.is_one() {
            return self.graph.intern(Node::Group(self.id));
        }
        let common: Vec<_> = common.into_iter().map(|(id, n)| (self.graph.expr(id), n)).collect();
        let divisor = self.graph.product(content, common.iter().copied());
        let inverse = divisor.recip();
        let primitive = self.graph.sum(terms.iter().map(|&(c, id)| (c, self.graph.expr(id) * inverse)));
        divisor * self.graph.intern(Node::Group(primitive.id))
    }

    /// The same value as a group, whatever it is; for passes that rebuild expressions.
    pub fn group_as_is(self) -> Self {
        match self.graph.node(self.id) {
            Node::Sum(terms) if terms.len() > 1 => self.graph.intern(Node::Group(self.id)),
            _ => self,
        }
    }

    /// True when it is its own normal form for a reason that can be seen: a sum of products of symbols.
    pub fn is_normal(self) -> bool {
        let leaf = |id: Id| matches!(self.graph.node(id), Node::Symbol(_) | Node::Opaque(_));
        let monomial = |id: Id| match self.graph.node(id) {
            Node::Product(factors) => factors.iter().all(|&(f, _)| leaf(f)),
            Node::Number(_) => true,
            _ => leaf(id),
        };
        match self.graph.node(self.id) {
            Node::Sum(terms) => terms.iter().all(|&(_, id)| monomial(id)),
            _ => monomial(self.id),
        }
    }

    /// A number times something without one: `6·a·b` is 6 and `a·b`.
    pub fn split_coefficient(self) -> (Rational, Self) {
        match self.graph.node(self.id) {
            Node::Number(value) => (value, self.graph.one()),
            Node::Sum(terms) if terms.len() == 1 => (terms[0].0, self.graph.expr(terms[0].1)),
            _ => (Rational::one(), self),
        }
    }

    /// The same constant as a quantity of its own that even the normal form does not look into.
    pub fn opaque(self) -> Self {
        match self.graph.node(self.id) {
            Node::Number(_) | Node::Symbol(_) | Node::Opaque(_) => self,
            _ => self.graph.intern(Node::Opaque(self.id)),
        }
    }

    /// Rebuilds the expression with some symbols replaced. Groups stay groups.
    pub fn substitute(self, replacement: &Map<u32, Expr<'g>>) -> Self {
        self.rebuild(&mut Map::default(), &|symbol| replacement.get(&symbol.id).copied())
    }

    pub(super) fn rebuild(self, memo: &mut Map<Id, Expr<'g>>, leaf: &impl Fn(Expr<'g>) -> Option<Expr<'g>>) -> Self {
        if let Some(&done) = memo.get(&self.id) {
            return done;
        }
        let graph = self.graph;
        let at = |id: Id| graph.expr(id);
        // What holds nothing that is replaced stays as it is.
        let result = match graph.node(self.id) {
            Node::Number(_) => self,
            Node::Symbol(_) => leaf(self).unwrap_or(self),
            Node::Sum(terms) => {
                let mut flat = Vec::with_capacity(terms.len());
                let mut changed = false;
                for &(c, id) in terms.iter() {
                    let term = at(id).rebuild(memo, leaf).id;
                    changed |= term != id;
                    graph.push_term(&mut flat, c, term);
                }
                if changed { graph.collected_sum(flat) } else { self }
            }
            Node::Product(factors) => {
                let (mut coefficient, mut flat) = (Rational::one(), Vec::with_capacity(factors.len()));
                let mut changed = false;
                for &(id, n) in factors.iter() {
                    let factor = at(id).rebuild(memo, leaf).id;
                    changed |= factor != id;
                    graph.push_factor(&mut coefficient, &mut flat, factor, n);
                }
                if changed { graph.collected_product(coefficient, flat) } else { self }
            }
            Node::Call(function, argument) => graph.call(function, at(argument).rebuild(memo, leaf)),
            Node::Binary(function, a, b) => at(a).rebuild(memo, leaf).binary(function, at(b).rebuild(memo, leaf)),
            Node::Group(inner) => at(inner).rebuild(memo, leaf).group(),
            Node::Opaque(inner) => at(inner).rebuild(memo, leaf).opaque(),
        };
        memo.insert(self.id, result);
        result
    }

    /// True when every symbol in it is constant.
    pub fn is_constant(self) -> bool {
        self.graph.constant.borrow()[self.id as usize]
    }
}

/// Symbols to be replaced in many expressions, with what has been rebuilt so far.
pub struct Substitution<'g> {
    replacement: Map<u32, Expr<'g>>,
    rebuilt: RefCell<Map<Id, Expr<'g>>>,
}

impl<'g> Substitution<'g> {
    /// By the keys of the symbols.
    pub fn new(replacement: Map<u32, Expr<'g>>) -> Self {
        Self { replacement, rebuilt: RefCell::default() }
    }

    /// The expression with the symbols replaced. Groups stay groups.
    pub fn of(&self, e: Expr<'g>) -> Expr<'g> {
        e.rebuild(&mut self.rebuilt.borrow_mut(), &|symbol| self.replacement.get(&symbol.id).copied())
    }
}

impl PartialEq for Expr<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id
    }
}

impl Eq for Expr<'_> {}

impl Hash for Expr<'_> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.id.hash(state);
    }
}

impl<'g> Add for Expr<'g> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.plus_multiple(Rational::one(), other)
    }
}

impl<'g> Sub for Expr<'g> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.plus_multiple(Rational::from_integer(-1), other)
    }
}

impl<'g> Mul for Expr<'g> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        // Most products of mechanics are with zeros and ones of rotations and unit vectors.
        match (self.id, other.id) {
            (ZERO, _) | (_, ONE) => return self,
            (_, ZERO) | (ONE, _) => return other,
            _ => {}
        }
        let (mut coefficient, mut factors) = (Rational::one(), Vec::with_capacity(4));
        self.graph.push_factor(&mut coefficient, &mut factors, self.id, 1);
        self.graph.push_factor(&mut coefficient, &mut factors, other.id, 1);
        self.graph.collected_product(coefficient, factors)
    }
}

impl Neg for Expr<'_> {
    type Output = Self;
    fn neg(self) -> Self {
        self.scale(Rational::from_integer(-1))
    }
}

/// Sum of a non-empty sequence; an empty one has no graph to live in.
impl<'g> Sum for Expr<'g> {
    fn sum<I: Iterator<Item = Self>>(mut terms: I) -> Self {
        let first = terms.next().expect("a sum of expressions has at least one term");
        let mut flat = Vec::new();
        first.graph.push_term(&mut flat, Rational::one(), first.id);
        for term in terms {
            first.graph.push_term(&mut flat, Rational::one(), term.id);
        }
        first.graph.collected_sum(flat)
    }
}

/// Sorts terms or factors by what they are: short lists, and nearly in order.
fn sort_by_id<T: Copy>(list: &mut [T], id: impl Fn(&T) -> Id) {
    /// Beyond, insertion takes longer than merging.
    const SHORT: usize = 24;
    if list.len() > SHORT {
        list.sort_by_key(id);
        return;
    }
    for k in 1..list.len() {
        let (moved, mut place) = (list[k], k);
        while place > 0 && id(&list[place - 1]) > id(&moved) {
            list[place] = list[place - 1];
            place -= 1;
        }
        list[place] = moved;
    }
}
