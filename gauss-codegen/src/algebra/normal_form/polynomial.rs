//! The normal form: multiplied out, collected, and reduced modulo what the atoms satisfy.
//!
//! Atoms are symbols, function values with normalised arguments, opaque constants, and reciprocals of primitive sums.
//! Two rewriting rules are always on: `cos²x → 1 − sin²x`, and `lm(S)·S⁻¹ → 1 − (S − lm(S))·S⁻¹` for a denominator S
//! with leading monomial lm(S) (graded order, cosines before all else); both lower the order of the monomial, so they
//! terminate.

use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::rc::Rc;

use crate::algebra::expressions::function::Function;
use crate::algebra::expressions::graph::{Expr, Graph, NodeView};
use crate::algebra::expressions::node::{Id, Node};
use crate::algebra::map::Map;
use crate::algebra::rational::Rational;

/// Π atomᵢ^nᵢ, sorted by atom, exponents nonzero.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Default)]
pub struct Monomial {
    /// Σ nᵢ.
    degree: i32,
    pub(super) factors: Vec<(Id, i32)>,
}

impl Monomial {
    pub(super) fn new(factors: Vec<(Id, i32)>) -> Self {
        let mut degree = 0;
        for &(_, n) in &factors {
            degree += n;
        }
        Self { degree, factors }
    }

    pub(super) fn times(&self, other: &Self) -> Self {
        if other.factors.is_empty() {
            return self.clone();
        }
        let (own, others) = (self.factors.as_slice(), other.factors.as_slice());
        let (mut i, mut j) = (0, 0);
        let mut factors = Vec::with_capacity(own.len() + others.len());
        while i < own.len() && j < others.len() {
            let (a, b) = (own[i], others[j]);
            if a.0 < b.0 {
                factors.push(a);
                i += 1;
            } else if b.0 < a.0 {
                factors.push(b);
                j += 1;
            } else {
                if a.1 + b.1 != 0 {
                    factors.push((a.0, a.1 + b.1));
                }
                i += 1;
                j += 1;
            }
        }
        factors.extend_from_slice(&own[i..]);
        factors.extend_from_slice(&others[j..]);
        Self { degree: self.degree + other.degree, factors }
    }

    pub(super) fn degree(&self) -> i32 {
        self.degree
    }

    /// `self / divisor` when the exponents of the divisor's atoms allow it.
    pub(super) fn over(&self, divisor: &Self) -> Option<Self> {
        let mut factors = self.factors.clone();
        for &(atom, n) in &divisor.factors {
            let factor = factors.iter_mut().find(|f| f.0 == atom)?;
            if factor.1 < n {
                return None;
            }
            factor.1 -= n;
        }
        factors.retain(|&(_, n)| n != 0);
        Some(Self { degree: self.degree - divisor.degree, factors })
    }
}

/// Graded lexicographic order; an earlier atom counts as larger.
impl Ord for Monomial {
    fn cmp(&self, other: &Self) -> Ordering {
        if self.degree != other.degree {
            return self.degree.cmp(&other.degree);
        }
        let (own, others) = (self.factors.as_slice(), other.factors.as_slice());
        let mut k = 0;
        while k < own.len() && k < others.len() {
            let (a, b) = (own[k], others[k]);
            if a.0 != b.0 {
                // The one whose first differing atom comes earlier has it to a positive power, the other to none.
                return if a.0 < b.0 { a.1.cmp(&0) } else { 0.cmp(&b.1) };
            }
            if a.1 != b.1 {
                return a.1.cmp(&b.1);
            }
            k += 1;
        }
        match own.len().cmp(&others.len()) {
            Ordering::Equal => Ordering::Equal,
            Ordering::Greater => own[k].1.cmp(&0),
            Ordering::Less => 0.cmp(&others[k].1),
        }
    }
}

impl PartialOrd for Monomial {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Σ cᵢ · monomialᵢ in normal form.
#[derive(Clone)]
pub struct Polynomial<'g> {
    pub(super) graph: &'g Graph,
    pub(super) terms: BTreeMap<Monomial, Rational>,
}

impl PartialEq for Polynomial<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.terms == other.terms
    }
}

/// Multiplies expressions out, remembering what it has seen.
pub struct Expander<'g> {
    graph: &'g Graph,
    limit: usize,
    /// Whether sums of moving symbols that are factors stay as they are written.
    whole: bool,
    memo: Map<Id, Option<Rc<Polynomial<'g>>>>,
    denominators: Map<Id, Denominator<'g>>,
}

/// A primitive sum that is divided by, and its leading monomial.
struct Denominator<'g> {
    sum: Polynomial<'g>,
    leading: Monomial,
}

impl<'g> Expr<'g> {
    /// The normal form, or `None` when more than `limit` terms would be needed on the way.
    pub fn expand(self, limit: usize) -> Option<Polynomial<'g>> {
        let mut expander = Expander::new(self.graph, limit);
        let polynomial = expander.expand(self)?;
        drop(expander);
        Some(Rc::unwrap_or_clone(polynomial))
    }

    /// The same with sums of moving symbols and constants, such as `x − c`, as atoms where they are factors: what is
    /// multiplied out there loses the digits of the difference.
    pub fn expand_around_sums(self, limit: usize) -> Option<Polynomial<'g>> {
        let mut expander = Expander { whole: true, ..Expander::new(self.graph, limit) };
        let polynomial = expander.expand(self)?;
        drop(expander);
        Some(Rc::unwrap_or_clone(polynomial))
    }

    /// The normal form written back as an expression: constants gathered in front of each monomial of variables.
    /// Stays as it is when more than `limit` terms would be needed.
    pub fn collected(self, limit: usize) -> Self {
        self.expand(limit).map_or(self, |p| p.collect())
    }
}

/// Whether a power of a sum stays as it is written: of symbols of which one moves at least, with constants of any kind;
/// of a constant with sines and cosines, such as `R + r cos b`; of a constant with other functions, such as `√u − l`,
/// where it is squared.
fn is_written_sum(e: Expr<'_>, exponent: i32) -> bool {
    let NodeView::Sum(terms) = e.view() else { return false };
    let (fixed, moving): (Vec<_>, Vec<_>) = terms.iter().map(|(_, e)| *e).partition(|e| e.is_constant());
    let symbols = moving.iter().all(|e| matches!(e.view(), NodeView::Symbol(_)));
    let several = !moving.is_empty() && fixed.len() + moving.len() > 1;
    let kept = |e: &Expr<'_>| match e.view() {
        NodeView::Symbol(_) | NodeView::Call(Function::Sin | Function::Cos, _) => true,
        NodeView::Call(..) | NodeView::Own(..) => exponent > 1,
        _ => false,
    };
    let multiple = |e: Expr<'_>| match e.view() {
        NodeView::Product(factors) => match *factors.iter().filter(|(e, _)| !e.is_constant()).collect::<Vec<_>>() {
            [(moving, 1)] => kept(moving),
            _ => false,
        },
        _ => kept(&e),
    };
    several && (symbols || !fixed.is_empty() && moving.into_iter().all(multiple))
}

impl<'g> Expander<'g> {
    /// `limit` is the number of terms that may be needed on the way.
    pub fn new(graph: &'g Graph, limit: usize) -> Self {
        Self { graph, limit, whole: false, memo: Map::default(), denominators: Map::default() }
    }

    /// The normal form, or `None` when more terms would be needed on the way.
    pub fn expand(&mut self, e: Expr<'g>) -> Option<Rc<Polynomial<'g>>> {
        for part in e.stages(|key| self.memo.contains_key(&key)) {
            self.visit(part);
        }
        self.visit(e)
    }

    fn visit(&mut self, e: Expr<'g>) -> Option<Rc<Polynomial<'g>>> {
        if let Some(done) = self.memo.get(&e.id) {
            return done.clone();
        }
        let result = self.expand_new(e);
        self.memo.insert(e.id, result.clone());
        result
    }

    fn expand_new(&mut self, e: Expr<'g>) -> Option<Rc<Polynomial<'g>>> {
        let polynomial = match self.graph.node(e.id) {
            Node::Number(value) => Polynomial::constant(self.graph, value),
            Node::Symbol(_) | Node::Opaque(_) => Polynomial::atom(e, 1),
            Node::Group(inner) => return self.visit(self.graph.expr(inner)),
            Node::Sum(terms) => self.expand_sum(&terms)?,
            Node::Product(factors) => self.expand_product(&factors)?,
            Node::Call(function, argument) => {
                let argument = self.visit(self.graph.expr(argument))?.to_expr();
                let call = self.graph.call(function, argument);
                match call.view() {
                    NodeView::Call(..) => Polynomial::atom(call, 1),
                    _ => return self.visit(call),
                }
            }
            Node::Binary(function, a, b) => {
                let [a, b] = [a, b].map(|id| self.graph.expr(id));
                let (a, b) = (self.visit(a)?.to_expr(), self.visit(b)?.to_expr());
                Polynomial::atom(a.binary(function, b), 1)
            }
            Node::Own(function, ids) => {
                let mut arguments = Vec::new();
                for &id in function.of(&ids) {
                    arguments.push(self.visit(self.graph.expr(id))?.to_expr());
                }
                Polynomial::atom(self.graph.own(function, &arguments), 1)
            }
        };
        Some(Rc::new(polynomial))
    }

    fn expand_sum(&mut self, terms: &[(Rational, Id)]) -> Option<Polynomial<'g>> {
        let mut result = Polynomial::zero(self.graph);
        for &(c, term) in terms {
            let term = self.visit(self.graph.expr(term))?;
            for (m, d) in &term.terms {
                result.add_term(m.clone(), c * *d);
            }
            if result.terms.len() > self.limit {
                return None;
            }
        }
        Some(result)
    }

    fn expand_product(&mut self, factors: &[(Id, i32)]) -> Option<Polynomial<'g>> {
        let mut result = Polynomial::constant(self.graph, Rational::one());
        // Powers of atoms first: cheap, and denominators then cancel as early as possible.
        for &(factor, exponent) in factors {
            let factor = self.graph.expr(factor);
            if self.whole && is_written_sum(factor, exponent) {
                result = self.multiply(&result, &Polynomial::atom(factor, exponent))?;
                continue;
            }
            let factor = self.visit(factor)?;
            result = self.multiply_power(result, &factor, exponent)?;
        }
        Some(result)
    }

    fn multiply_power(
        &mut self,
        base: Polynomial<'g>,
        factor: &Polynomial<'g>,
        exponent: i32,
    ) -> Option<Polynomial<'g>> {
        // A single monomial has every power, also the negative ones.
        if let Some((monomial, coefficient)) = factor.as_single_term() {
            let power = Monomial::new(monomial.factors.iter().map(|&(a, n)| (a, n.saturating_mul(exponent))).collect());
            let single = Polynomial::term(self.graph, power, coefficient.pow(exponent));
            return self.multiply(&base, &single);
        }
        if exponent > 0 {
            let mut result = base;
            for _ in 0..exponent {
                result = self.multiply(&result, factor)?;
            }
            return Some(result);
        }
        // A denominator: its primitive part becomes an atom.
        let sum = factor.to_expr();
        let Node::Product(reciprocal) = self.graph.node(match sum.recip().view() {
            NodeView::Sum(terms) => terms[0].1.id,
            _ => sum.recip().id,
        }) else {
            return None;
        };
        let (atom, _) = reciprocal[0];
        let primitive = factor.scaled_to(self.graph.expr(atom));
        let content = factor.ratio_to(&primitive);
        // The order is a well-order on proper monomials only: a denominator with denominators inside stays an atom.
        if primitive.terms.keys().all(|m| m.factors.iter().all(|&(_, n)| n > 0)) {
            let leading = primitive.leading_monomial().clone();
            self.denominators.insert(atom, Denominator { sum: primitive, leading });
        }
        let single = Polynomial::term(self.graph, Monomial::new(vec![(atom, exponent)]), content.pow(exponent));
        self.multiply(&base, &single)
    }

    fn multiply(&mut self, a: &Polynomial<'g>, b: &Polynomial<'g>) -> Option<Polynomial<'g>> {
        let mut result = Polynomial::zero(self.graph);
        for (m, c) in &a.terms {
            // Long monomials and coefficients take their time.
            let length = m.factors.len() as u64 / 4;
            let others: u64 = b.terms.values().map(|d| length + effort(*c).max(effort(*d))).sum();
            if !self.graph.budget.may_multiply(others) {
                return None;
            }
            for (n, d) in &b.terms {
                self.add_reduced(&mut result, m.times(n), *c * *d)?;
            }
            if result.terms.len() > self.limit {
                return None;
            }
        }
        Some(result)
    }

    /// Adds a term after rewriting it by the rules of its atoms; `None` where that takes too long.
    fn add_reduced(&self, result: &mut Polynomial<'g>, monomial: Monomial, coefficient: Rational) -> Option<()> {
        for (k, &(atom, n)) in monomial.factors.iter().enumerate() {
            if n >= 2
                && let Node::Call(Function::Cos, argument) = self.graph.node(atom)
            {
                let sine = self.graph.call(Function::Sin, self.graph.expr(argument));
                let mut rest = monomial.factors.clone();
                rest[k].1 %= 2;
                rest.retain(|&(_, n)| n != 0);
                let mut rest = Monomial::new(rest);
                // (1 − s²)ʰ, term by term: one factor after the other would be 2ʰ of them.
                let (squares, square) = (i64::from(n / 2), Monomial::new(vec![(sine.id, 2)]));
                let mut binomial = coefficient;
                for power in 0..=squares {
                    if !self.graph.budget.may_rewrite(effort(binomial)) {
                        return None;
                    }
                    self.add_reduced(result, rest.clone(), binomial)?;
                    rest = rest.times(&square);
                    binomial *= Rational::new(power - squares, power + 1);
                }
                return Some(());
            }
            if n < 0
                && let Some(denominator) = self.denominators.get(&atom)
            {
                let Denominator { sum, leading } = denominator;
                if let Some(rest) = monomial.over(leading) {
                    let coefficient = coefficient * sum.terms[leading].recip();
                    self.add_reduced(result, rest.times(&Monomial::new(vec![(atom, 1)])), coefficient)?;
                    for (m, c) in &sum.terms {
                        if !self.graph.budget.may_rewrite(effort(coefficient)) {
                            return None;
                        }
                        if m != leading {
                            let c = -(coefficient * *c);
                            self.add_reduced(result, rest.times(m), c)?;
                        }
                    }
                    return Some(());
                }
            }
        }
        result.add_term(monomial, coefficient);
        Some(())
    }
}

/// Beside a product of 64-bit fractions: those of a thousand bits are reduced by a greatest common divisor.
fn effort(coefficient: Rational) -> u64 {
    if coefficient.parts().is_some() { 1 } else { 40 }
}

impl<'g> Polynomial<'g> {
    pub fn zero(graph: &'g Graph) -> Self {
        Self { graph, terms: BTreeMap::new() }
    }

    fn constant(graph: &'g Graph, value: Rational) -> Self {
        Self::term(graph, Monomial::default(), value)
    }

    fn atom(e: Expr<'g>, exponent: i32) -> Self {
        Self::term(e.graph, Monomial::new(vec![(e.id, exponent)]), Rational::one())
    }

    fn term(graph: &'g Graph, monomial: Monomial, coefficient: Rational) -> Self {
        let mut p = Self::zero(graph);
        p.add_term(monomial, coefficient);
        p
    }

    pub(super) fn add_term(&mut self, monomial: Monomial, coefficient: Rational) {
        if coefficient.is_zero() {
            return;
        }
        match self.terms.entry(monomial) {
            std::collections::btree_map::Entry::Vacant(place) => {
                place.insert(coefficient);
            }
            std::collections::btree_map::Entry::Occupied(mut place) => {
                let sum = place.get().plus(coefficient);
                if sum.is_zero() {
                    place.remove();
                } else {
                    *place.get_mut() = sum;
                }
            }
        }
    }

    #[cfg(test)]
    pub fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// Number of terms.
    pub fn len(&self) -> usize {
        self.terms.len()
    }

    #[cfg(test)]
    pub(super) fn terms(&self) -> &BTreeMap<Monomial, Rational> {
        &self.terms
    }

    #[cfg(test)]
    pub(super) fn graph(&self) -> &'g Graph {
        self.graph
    }

    fn as_single_term(&self) -> Option<(&Monomial, &Rational)> {
        if self.terms.len() == 1 { self.terms.first_key_value() } else { None }
    }

    /// The same polynomial with the scale of the given primitive sum (which has the same terms up to a factor).
    fn scaled_to(&self, primitive: Expr<'g>) -> Self {
        let NodeView::Sum(terms) = primitive.view() else { return self.clone() };
        let (c, e) = terms[0];
        let monomial = match e.view() {
            NodeView::Number(_) => Monomial::default(),
            NodeView::Product(factors) => Monomial::new(factors.into_iter().map(|(f, n)| (f.id, n)).collect()),
            _ => Monomial::new(vec![(e.id, 1)]),
        };
        let Some(own) = self.terms.get(&monomial) else { return self.clone() };
        let scale = c * own.recip();
        let terms = self.terms.iter().map(|(m, d)| (m.clone(), scale * *d)).collect();
        Self { graph: self.graph, terms }
    }

    fn ratio_to(&self, primitive: &Self) -> Rational {
        let (m, c) = self.terms.first_key_value().expect("a denominator has terms");
        *c * primitive.terms[m].recip()
    }

    /// The largest in an order that counts cosines before all other atoms, so that `cos² → 1 − sin²` lowers it as well,
    /// whichever of sine and cosine was made first: by degree, then by the cosines, then by the rest.
    fn leading_monomial(&self) -> &Monomial {
        let is_cosine = |id: Id| matches!(self.graph.node(id), Node::Call(Function::Cos, _));
        let parts = |m: &Monomial| -> (i32, Monomial, Monomial) {
            let (cosines, rest) = m.factors.iter().partition(|(id, _)| is_cosine(*id));
            (m.degree(), Monomial::new(cosines), Monomial::new(rest))
        };
        self.terms.keys().max_by_key(|m| parts(m)).expect("a denominator has terms")
    }

    pub(super) fn monomial_expr(&self, monomial: &Monomial) -> Expr<'g> {
        self.graph.product(Rational::one(), monomial.factors.iter().map(|&(id, n)| (self.graph.expr(id), n)))
    }

    /// Back to an expression, one term a monomial.
    pub fn to_expr(&self) -> Expr<'g> {
        self.graph.sum(self.terms.iter().map(|(m, c)| (*c, self.monomial_expr(m))))
    }

    /// Splits off the constants: a list of (coefficient made of constants, monomial of variables), highest first.
    pub fn by_variable_monomials(&self) -> Vec<(Polynomial<'g>, Expr<'g>)> {
        let mut groups: BTreeMap<Monomial, Polynomial<'g>> = BTreeMap::new();
        for (monomial, c) in &self.terms {
            let (constant, variable): (Vec<_>, Vec<_>) =
                monomial.factors.iter().partition(|(id, _)| self.graph.expr(*id).is_constant());
            groups
                .entry(Monomial::new(variable))
                .or_insert_with(|| Self::zero(self.graph))
                .add_term(Monomial::new(constant), *c);
        }
        groups.into_iter().rev().map(|(m, p)| (p, self.monomial_expr(&m))).collect()
    }

    /// Back to an expression with the constants gathered in front of each monomial of variables.
    pub fn collect(&self) -> Expr<'g> {
        let one = Rational::one();
        self.graph.sum(
            self.by_variable_monomials()
                .into_iter()
                .map(|(constant, variable)| (one, constant.to_expr().group() * variable)),
        )
    }
}
