//! Common factors: `a·b + a·c` becomes `a·(b + c)`, greedily, the most frequent factor first.

use crate::algebra::{Expr, Map, NodeView, Rational};

/// Rewrites every sum of an expression.
#[derive(Default)]
pub struct Factoriser<'g> {
    memo: Map<u32, Expr<'g>>,
}

/// A term of a sum while factors are looked for.
#[derive(Clone)]
struct FactoredTerm<'g> {
    coefficient: Rational,
    factors: Vec<(Expr<'g>, i32)>,
}

impl<'g> FactoredTerm<'g> {
    fn exponent(&self, factor: Expr<'g>) -> i32 {
        for (f, n) in &self.factors {
            if *f == factor {
                return *n;
            }
        }
        0
    }

    fn without(&self, factor: Expr<'g>, sign: i32) -> Self {
        let mut factors = Vec::with_capacity(self.factors.len());
        for &(f, n) in &self.factors {
            let n = if f == factor { n - sign } else { n };
            if n != 0 {
                factors.push((f, n));
            }
        }
        Self { coefficient: self.coefficient, factors }
    }

    fn expr(&self, like: Expr<'g>) -> Expr<'g> {
        like.graph().product(self.coefficient, self.factors.iter().copied())
    }
}

impl<'g> Factoriser<'g> {
    pub fn rewrite(&mut self, e: Expr<'g>) -> Expr<'g> {
        for part in e.stages(|key| self.memo.contains_key(&key)) {
            self.visit(part);
        }
        self.visit(e)
    }

    fn visit(&mut self, e: Expr<'g>) -> Expr<'g> {
        if let Some(&done) = self.memo.get(&e.key()) {
            return done;
        }
        let graph = e.graph();
        let result = match e.view() {
            NodeView::Number(_) | NodeView::Symbol(_) => e,
            NodeView::Call(function, argument) => {
                let argument = self.visit(argument);
                graph.call(function, argument)
            }
            NodeView::Binary(function, a, b) => self.visit(a).binary(function, self.visit(b)),
            NodeView::Own(function, arguments) => {
                let arguments: Vec<_> = arguments.into_iter().map(|argument| self.visit(argument)).collect();
                graph.own(function, &arguments)
            }
            NodeView::Group(inner) | NodeView::Opaque(inner) => self.visit(inner).group_as_is(),
            NodeView::Product(factors) => {
                let mut visited = Vec::with_capacity(factors.len());
                for (f, n) in factors {
                    visited.push((self.visit(f), n));
                }
                graph.product(Rational::one(), visited)
            }
            NodeView::Sum(terms) => {
                let mut visited = Vec::with_capacity(terms.len());
                for (c, term) in terms {
                    let (content, rest) = self.visit(term).split_coefficient();
                    let factors = match rest.view() {
                        NodeView::Product(factors) => factors,
                        NodeView::Number(_) => Vec::new(),
                        _ => vec![(rest, 1)],
                    };
                    visited.push(FactoredTerm { coefficient: c * content, factors });
                }
                factor(e, visited)
            }
        };
        self.memo.insert(e.key(), result);
        result
    }
}

/// The sum of the terms with common factors pulled out.
fn factor<'g>(like: Expr<'g>, mut terms: Vec<FactoredTerm<'g>>) -> Expr<'g> {
    let graph = like.graph();
    // Products must not be taken for sums again, so they join the rest as terms.
    let mut products = Vec::new();
    let rest = loop {
        let Some((shared, sign)) = most_frequent(&terms) else { break Some(shared_number(like, &terms)) };
        let (mut inside, mut outside) = (Vec::new(), Vec::new());
        for term in terms {
            if term.exponent(shared).signum() == sign {
                inside.push(term.without(shared, sign));
            } else {
                outside.push(term);
            }
        }
        let inner = factor(like, inside).group_as_is();
        products.push(graph.product(Rational::one(), [(shared, sign), (inner, 1)]));
        if outside.is_empty() {
            break None;
        }
        terms = outside;
    };
    let sum = |rest: Option<Expr<'g>>, product| Some(rest.map_or(product, |rest| product + rest));
    products.into_iter().rev().fold(rest, sum).unwrap_or_else(|| graph.zero())
}

/// The factor that most terms share, and the sign of its exponents.
fn most_frequent<'g>(terms: &[FactoredTerm<'g>]) -> Option<(Expr<'g>, i32)> {
    let mut count: Map<(u32, i32), (usize, Expr<'g>)> = Map::default();
    for term in terms {
        for &(f, n) in &term.factors {
            count.or_insert_with((f.key(), n.signum()), || (0, f)).0 += 1;
        }
    }
    let best =
        count.iter().filter(|(_, (n, _))| *n >= 2).max_by_key(|((key, sign), (n, e))| (*n, *sign, e.rank(), *key));
    best.map(|(&(_, sign), &(_, shared))| (shared, sign))
}

/// Pulls out a number that several terms have in front: `1 − 2a − 2b` becomes `1 − 2(a + b)`.
fn shared_number<'g>(like: Expr<'g>, terms: &[FactoredTerm<'g>]) -> Expr<'g> {
    let graph = like.graph();
    let one = Rational::one();
    let value = |t: &FactoredTerm<'g>| if t.factors.is_empty() { one } else { t.coefficient.abs() };
    let mut numbers = Vec::with_capacity(terms.len());
    for term in terms {
        let number = value(term);
        if !number.is_one() {
            numbers.push(number);
        }
    }
    // The first that comes twice.
    let twice = |k: &usize| numbers[*k + 1..].contains(&numbers[*k]);
    let Some(number) = (0..numbers.len()).find(twice).map(|k| numbers[k]) else {
        return graph.sum(terms.iter().map(|t| (one, t.expr(like))));
    };
    let (inside, outside): (Vec<_>, Vec<_>) = terms.iter().partition(|t| value(t) == number);
    let inner = graph.sum(inside.iter().map(|t| (t.coefficient / number, t_without_number(t).expr(like))));
    let rest = outside.iter().map(|t| (one, t.expr(like)));
    graph.sum(rest.chain([(number, inner.group_as_is())]))
}

fn t_without_number<'g>(t: &FactoredTerm<'g>) -> FactoredTerm<'g> {
    FactoredTerm { coefficient: Rational::one(), factors: t.factors.clone() }
}
