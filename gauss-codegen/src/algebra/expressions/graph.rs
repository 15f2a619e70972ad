//! The expression graph: every distinct expression exists once, so equality is equality of indices and sharing is free.

use std::cell::{Cell, Ref, RefCell};
use std::collections::HashMap;
use std::rc::Rc;

use crate::algebra::expressions::budget::Budget;
use crate::algebra::expressions::function::{BinaryFunction, Function, OwnFunction};
use crate::algebra::expressions::node::{Id, Node};
use crate::algebra::map::{Key, Places};
use crate::algebra::rational::Rational;

/// A symbol, as far as algebra cares: its names, and whether it is fixed once the parameters are known.
#[derive(Clone, Debug)]
pub struct Symbol {
    /// Name in plain text.
    pub text: String,
    /// Name in LaTeX.
    pub latex: String,
    /// Fixed for a given set of parameters; everything made of such symbols alone is computed once.
    pub constant: bool,
}

/// Parts of a node that is found again, for each that counts as made: to find a short one costs nothing.
const LONG: usize = 32;

/// The numbers 0 and 1, which every graph begins with.
pub(super) const ZERO: Id = 0;
pub(super) const ONE: Id = 1;

/// A node, with its children as expressions.
pub enum NodeView<'g> {
    Number(Rational),
    Symbol(u32),
    Sum(Vec<(Rational, Expr<'g>)>),
    Product(Vec<(Expr<'g>, i32)>),
    Call(Function, Expr<'g>),
    Binary(BinaryFunction, Expr<'g>, Expr<'g>),
    Own(OwnFunction, Vec<Expr<'g>>),
    Group(Expr<'g>),
    Opaque(Expr<'g>),
}

/// Properties of a node that are known as soon as it is made.
#[derive(Clone, Copy)]
struct Traits {
    /// Every symbol in it is constant.
    constant: bool,
    /// The longest way down to a symbol or a number.
    depth: u32,
    /// See `alike`.
    rank: Id,
}

/// The arena of all expressions of one derivation.
pub struct Graph {
    nodes: RefCell<Vec<Node>>,
    traits: RefCell<Vec<Traits>>,
    /// Limits of what more may be made of it.
    pub(in crate::algebra) budget: Budget,
    index: RefCell<Places>,
    symbols: RefCell<Vec<Symbol>>,
    /// Names of functions of the user's own.
    functions: RefCell<Vec<String>>,
    undefined: Cell<bool>,
    /// Some symbols are alike.
    pub(super) some_are_alike: Cell<bool>,
    pub(super) ranks: RefCell<HashMap<u64, Id>>,
}

/// An expression: a node of a graph. Copies are free and equality is structural.
#[derive(Clone, Copy)]
pub struct Expr<'g> {
    pub(in crate::algebra) graph: &'g Graph,
    pub(in crate::algebra) id: Id,
}

impl Graph {
    pub fn new() -> Self {
        let (nodes, traits, index, symbols, functions, undefined, some_are_alike, ranks) = Default::default();
        let budget = Budget::default();
        let graph = Self { nodes, traits, budget, index, symbols, functions, undefined, some_are_alike, ranks };
        // They are asked for so often that looking them up would take time: see `zero` and `one`.
        graph.intern(Node::Number(Rational::zero()));
        graph.intern(Node::Number(Rational::one()));
        graph
    }

    /// True once something was divided by zero, or by a number beyond any use in double precision; every result is then
    /// meaningless.
    pub fn is_undefined(&self) -> bool {
        self.undefined.get()
    }

    /// Result of some work, or `None` where that divides by zero; the rest keeps its meaning.
    pub fn defined<R>(&self, work: impl FnOnce() -> R) -> Option<R> {
        let earlier = self.undefined.replace(false);
        let result = work();
        let undefined = self.undefined.replace(earlier);
        (!undefined).then_some(result)
    }

    /// A new symbol; two calls give two different symbols even when the names agree.
    pub fn symbol(&self, text: impl Into<String>, latex: impl Into<String>, constant: bool) -> Expr<'_> {
        let mut symbols = self.symbols.borrow_mut();
        symbols.push(Symbol { text: text.into(), latex: latex.into(), constant });
        let symbol = symbols.len() as u32 - 1;
        drop(symbols);
        self.intern(Node::Symbol(symbol))
    }

    /// A function of the user's own, by its place among them.
    pub fn declare_function(&self, name: impl Into<String>) -> u16 {
        let mut functions = self.functions.borrow_mut();
        functions.push(name.into());
        (functions.len() - 1) as u16
    }

    /// The name of a function of the user's own.
    pub fn function_name(&self, function: OwnFunction) -> String {
        self.functions.borrow().get(usize::from(function.index)).cloned().unwrap_or_default()
    }

    /// A function of the user's own, of as many arguments as it takes.
    pub fn own<'g>(&'g self, function: OwnFunction, arguments: &[Expr<'g>]) -> Expr<'g> {
        let ids: Vec<Id> = arguments.iter().map(|argument| argument.id).collect();
        self.intern(Node::Own(function, OwnFunction::filled(&ids)))
    }

    /// Keys of all symbols made so far.
    pub fn symbol_keys(&self) -> Vec<u32> {
        let nodes = self.nodes.borrow();
        (0..nodes.len() as Id).filter(|&id| matches!(nodes[id as usize], Node::Symbol(_))).collect()
    }

    pub(in crate::algebra) fn with_symbol<R>(&self, symbol: u32, read: impl FnOnce(&Symbol) -> R) -> R {
        read(&self.symbols.borrow()[symbol as usize])
    }

    pub(in crate::algebra) fn any_symbol(&self, holds: impl FnMut(&Symbol) -> bool) -> bool {
        self.symbols.borrow().iter().any(holds)
    }

    /// The expression inside a group.
    pub(in crate::algebra) fn ungrouped(&self, mut id: Id) -> Id {
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
        let word = node.word();
        let known = {
            let nodes: &[Node] = &self.nodes.borrow();
            self.index.borrow().find(word, |place| nodes[place] == node)
        };
        let id = match known {
            Some(place) => {
                // To find one of many parts again takes as long as to make it, and functions of functions, sixty deep,
                // have derivatives of as many factors that are found a million times.
                self.budget.count(node.edges() / LONG);
                place as Id
            }
            None if self.budget.is_exhausted() && !matches!(node, Node::Symbol(_)) => 0,
            None => {
                self.budget.count(1 + node.edges());
                self.index.borrow_mut().push(word);
                let traits = self.traits_of(&node);
                self.traits.borrow_mut().push(traits);
                let mut nodes = self.nodes.borrow_mut();
                nodes.push(node);
                (nodes.len() - 1) as Id
            }
        };
        Expr { graph: self, id }
    }

    /// Result of some work, without the expressions that it makes: the graph is afterwards what it was before. Nothing
    /// that is kept may refer to them.
    pub fn aside<R: 'static>(&self, work: impl FnOnce() -> R) -> R {
        let (nodes, symbols, functions) =
            (self.nodes.borrow().len(), self.symbols.borrow().len(), self.functions.borrow().len());
        let (budget, undefined) = (self.budget.clone(), self.undefined.get());
        let result = work();
        let gone = self.nodes.borrow_mut().split_off(nodes);
        self.index.borrow_mut().truncate(gone.iter().rev().map(Node::word));
        self.traits.borrow_mut().truncate(nodes);
        self.ranks.borrow_mut().retain(|_, first| (*first as usize) < nodes);
        self.symbols.borrow_mut().truncate(symbols);
        self.functions.borrow_mut().truncate(functions);
        self.budget.restore(&budget);
        self.undefined.set(undefined);
        result
    }

    fn traits_of(&self, node: &Node) -> Traits {
        let known = self.traits.borrow();
        let part = |id: Id| known[id as usize];
        let with = |all: Traits, id: Id| Traits {
            constant: all.constant && part(id).constant,
            depth: all.depth.max(part(id).depth),
            ..all
        };
        let rank = self.rank_of(node, known.len() as Id, |id| part(id).rank);
        let leaf = Traits { constant: true, depth: 0, rank };
        let parts = match node {
            Node::Number(_) => return leaf,
            Node::Symbol(symbol) => return Traits { constant: self.with_symbol(*symbol, |s| s.constant), ..leaf },
            Node::Sum(terms) => terms.iter().fold(leaf, |all, &(_, id)| with(all, id)),
            Node::Product(factors) => factors.iter().fold(leaf, |all, &(id, _)| with(all, id)),
            Node::Call(_, id) | Node::Group(id) | Node::Opaque(id) => part(*id),
            Node::Binary(_, a, b) => with(part(*a), *b),
            Node::Own(_, ids) => ids.iter().fold(leaf, |all, &id| with(all, id)),
        };
        Traits { depth: parts.depth + 1, rank, ..parts }
    }

    pub(super) fn rank(&self, id: Id) -> Id {
        self.traits.borrow()[id as usize].rank
    }

    pub(super) fn set_rank(&self, id: Id, rank: Id) {
        self.traits.borrow_mut()[id as usize].rank = rank;
    }

    /// The longest way from a node down to a symbol or a number.
    pub(super) fn depth(&self, id: Id) -> u32 {
        self.traits.borrow()[id as usize].depth
    }

    /// True of symbols and numbers.
    pub(super) fn is_leaf(&self, id: Id) -> bool {
        matches!(self.nodes.borrow()[id as usize], Node::Symbol(_) | Node::Number(_))
    }

    /// True when every symbol in it is constant.
    pub(in crate::algebra) fn is_constant(&self, id: Id) -> bool {
        self.traits.borrow()[id as usize].constant
    }

    pub(in crate::algebra) fn node(&self, id: Id) -> Node {
        self.nodes.borrow()[id as usize].clone()
    }

    /// All nodes there are; none can be made meanwhile.
    pub(in crate::algebra) fn nodes(&self) -> Ref<'_, Vec<Node>> {
        self.nodes.borrow()
    }

    pub(in crate::algebra) fn expr(&self, id: Id) -> Expr<'_> {
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

    pub(super) fn push_term(&self, flat: &mut Vec<(Rational, Id)>, coefficient: Rational, id: Id) {
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

    pub(super) fn collected_sum(&self, mut terms: Vec<(Rational, Id)>) -> Expr<'_> {
        let list: &mut [(Rational, Id)] = &mut terms;
        sort_by_id(list, |&(_, id)| id);
        let (mut count, mut k) = (0, 0);
        while k < list.len() {
            let (c, id) = list[k];
            k += 1;
            if count > 0 && list[count - 1].1 == id {
                list[count - 1].0 = list[count - 1].0.plus(c);
                continue;
            }
            // What has cancelled gives up its place.
            if count > 0 && list[count - 1].0.is_zero() {
                count -= 1;
            }
            list[count] = (c, id);
            count += 1;
        }
        if count > 0 && list[count - 1].0.is_zero() {
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

    pub(super) fn collected_product(&self, coefficient: Rational, mut factors: Vec<(Id, i32)>) -> Expr<'_> {
        let list: &mut [(Id, i32)] = &mut factors;
        sort_by_id(list, |&(id, _)| id);
        let (mut count, mut k) = (0, 0);
        while k < list.len() {
            let (id, n) = list[k];
            k += 1;
            if count > 0 && list[count - 1].0 == id {
                list[count - 1].1 = list[count - 1].1.saturating_add(n);
                continue;
            }
            if count > 0 && list[count - 1].1 == 0 {
                count -= 1;
            }
            list[count] = (id, n);
            count += 1;
        }
        if count > 0 && list[count - 1].1 == 0 {
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

    pub(super) fn push_factor(&self, coefficient: &mut Rational, flat: &mut Vec<(Id, i32)>, id: Id, exponent: i32) {
        let terms = match &self.nodes.borrow()[id as usize] {
            Node::Number(value) => {
                *coefficient *= value.pow(exponent);
                return;
            }
            Node::Product(inner) => {
                for &(id, n) in inner.iter() {
                    flat.push((id, n.saturating_mul(exponent)));
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
    pub(in crate::algebra) fn content(&self, terms: &[(Rational, Id)]) -> Rational {
        let mut content = Rational::zero();
        for &(c, _) in terms {
            content = content.common_divisor(c);
        }
        if terms[0].0.is_negative() { -content } else { content }
    }

    /// Common divisor of all coefficients of a sum, with the sign of the first.
    pub(super) fn shared_content(&self, terms: &[(Rational, Id)]) -> Rational {
        let mut content = terms[0].0;
        for &(c, _) in &terms[1..] {
            content = content.shared_with(c);
        }
        if terms[0].0.is_negative() { -content.abs() } else { content.abs() }
    }

    /// Powers that all terms have in common.
    pub(super) fn common_factors(&self, terms: &[(Rational, Id)]) -> Vec<(Id, i32)> {
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
                Function::Sin | Function::Sqrt | Function::Abs | Function::Signum | Function::Tanh => {
                    return self.zero();
                }
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

impl PartialEq for Expr<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id
    }
}

impl Eq for Expr<'_> {}

impl Key for Expr<'_> {
    fn word(&self) -> u64 {
        u64::from(self.id)
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
    let mut k = 1;
    while k < list.len() {
        let (moved, mut place) = (list[k], k);
        let own = id(&moved);
        while place > 0 && id(&list[place - 1]) > own {
            list[place] = list[place - 1];
            place -= 1;
        }
        list[place] = moved;
        k += 1;
    }
}
