//! Hoisting: every part that depends on parameters alone is replaced by a constant.

use crate::algebra::{Expander, Expr, Graph, Map, NodeView, Rational};

use super::passes::Passes;
use super::write::Program;

/// Terms up to which two definitions are compared in normal form.
const LIMIT: usize = 64;

/// Rewrites expressions and gathers the constants they need.
pub struct Hoister<'a, 'g> {
    graph: &'g Graph,
    expander: Expander<'g>,
    memo: Map<u32, Expr<'g>>,
    /// (symbol, definition), in order of creation.
    constants: Vec<(Expr<'g>, Expr<'g>)>,
    /// Normal form of a definition → its symbol.
    known: Map<u32, Expr<'g>>,
    /// Symbols that stand for expressions of the arguments.
    definitions: Option<&'a Map<u32, Expr<'g>>>,
    /// Passes over all programs of the kernel.
    pub passes: Passes,
}

impl<'a, 'g> Hoister<'a, 'g> {
    pub fn new(graph: &'g Graph, definitions: &'a Map<u32, Expr<'g>>, passes: Passes) -> Self {
        Self {
            graph,
            expander: Expander::new(graph, LIMIT),
            memo: Map::default(),
            constants: Vec::new(),
            known: Map::default(),
            definitions: Some(definitions),
            passes,
        }
    }

    pub fn hoist(&mut self, outputs: &[Expr<'g>]) -> Vec<Expr<'g>> {
        outputs.iter().map(|&e| self.visit_deep(e)).collect()
    }

    /// The program of expressions, in which constants are symbols.
    pub fn program(&mut self, outputs: &[Expr<'g>]) -> Program<'g> {
        Program::lowered(&self.hoist(outputs), self.passes)
    }

    /// Hoisted expressions with the symbols that stand for expressions of the arguments left as they are.
    pub fn hoist_undefined(&mut self, outputs: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let definitions = self.definitions.take();
        let memo = std::mem::take(&mut self.memo);
        let hoisted = self.hoist(outputs);
        (self.definitions, self.memo) = (definitions, memo);
        hoisted
    }

    /// (symbol, definition) of all so far, in order of creation.
    pub fn constants(&self) -> &[(Expr<'g>, Expr<'g>)] {
        &self.constants
    }

    /// Whether a symbol is that of a constant.
    pub fn is_hoisted(&self, symbol: Expr<'g>) -> bool {
        self.constants.iter().any(|(constant, _)| *constant == symbol)
    }

    fn visit_deep(&mut self, e: Expr<'g>) -> Expr<'g> {
        for part in e.stages(|key| self.memo.contains_key(&key)) {
            // A constant is a quantity as a whole.
            if !part.is_constant() {
                self.visit(part);
            }
        }
        self.visit(e)
    }

    fn visit(&mut self, e: Expr<'g>) -> Expr<'g> {
        if let Some(&done) = self.memo.get(&e.key()) {
            return done;
        }
        let result = self.visit_new(e);
        self.memo.insert(e.key(), result);
        result
    }

    fn visit_new(&mut self, e: Expr<'g>) -> Expr<'g> {
        if e.is_constant() {
            return self.constant(e);
        }
        match e.view() {
            NodeView::Symbol(_) => match self.definitions.and_then(|definitions| definitions.get(&e.key())) {
                Some(&definition) => self.visit(definition),
                None => e,
            },
            NodeView::Number(_) => e,
            // Of mass that varies.
            NodeView::Opaque(inner) => self.visit(inner).opaque(),
            NodeView::Call(function, argument) => {
                let argument = self.visit(argument);
                self.graph.call(function, argument)
            }
            NodeView::Binary(function, a, b) => self.visit(a).binary(function, self.visit(b)),
            NodeView::Own(function, arguments) => {
                let arguments: Vec<_> = arguments.into_iter().map(|argument| self.visit(argument)).collect();
                self.graph.own(function, &arguments)
            }
            NodeView::Group(inner) => self.visit(inner).group_as_is(),
            NodeView::Product(_) => self.term(Rational::one(), e),
            NodeView::Sum(terms) => {
                let (mut constant, mut parts) = (Vec::new(), Vec::with_capacity(terms.len()));
                for (c, e) in terms {
                    if e.is_constant() {
                        constant.push((c, e));
                    } else {
                        parts.push(self.term(c, e));
                    }
                }
                if !constant.is_empty() {
                    let constant = self.graph.sum(constant);
                    parts.push(self.constant(constant));
                }
                parts.into_iter().sum()
            }
        }
    }

    /// c · e for a varying e: number and constant factors become one constant.
    fn term(&mut self, c: Rational, e: Expr<'g>) -> Expr<'g> {
        let NodeView::Product(factors) = e.view() else {
            return self.visit(e).scale(c);
        };
        // A rational content that a visited factor gives up belongs to the constant too, so visit first.
        let (mut constant, mut variable) = (Vec::new(), Vec::with_capacity(factors.len()));
        for (e, n) in factors {
            if e.is_constant() {
                constant.push((e, n));
            } else {
                variable.push((self.visit(e), n));
            }
        }
        let variable = self.graph.product(c, variable);
        if constant.is_empty() {
            return variable;
        }
        let (content, rest) = variable.split_coefficient();
        let constant = self.graph.product(content, constant);
        self.constant(constant) * rest
    }

    /// The symbol of a constant, up to sign.
    fn constant(&mut self, e: Expr<'g>) -> Expr<'g> {
        if e.as_number().is_some() {
            return e;
        }
        let normal = if e.is_normal() { e } else { self.expander.expand(e).map_or(e, |p| p.to_expr()) };
        if normal.as_number().is_some() {
            return normal;
        }
        let negative = match normal.view() {
            // In constants that are alike the terms that are: the first of them where nothing is alike.
            NodeView::Sum(terms) => {
                terms.iter().min_by_key(|(_, e)| e.rank()).is_some_and(|(first, _)| first.is_negative())
            }
            _ => false,
        };
        let (key, definition) = if negative { (-normal, -e) } else { (normal, e) };
        let symbol = match self.known.get(&key.key()) {
            Some(&symbol) => symbol,
            None => {
                let name = format!("k{}", self.constants.len());
                let symbol = self.graph.symbol(name.clone(), name, false);
                if self.graph.has_alike() {
                    self.graph.declare_alike(symbol, u64::from(definition.rank()) << 32);
                }
                self.constants.push((symbol, definition));
                self.known.insert(key.key(), symbol);
                symbol
            }
        };
        if negative { -symbol } else { symbol }
    }
}
