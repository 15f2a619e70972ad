//! Differences of like functions without what cancels in them: `√u − l`, `a/√u − b/√v`, `1 − cos x`, `a² − b²`.
//!
//! Fractions and symbols cancel exactly where expressions are multiplied out, their values do not. So a root is written
//! as another one, or as a length, and a small rest: `√u = l + (u − l²)/(√u + l)`, with the difference under it
//! multiplied out (for two central fields that is the form of Encke).

use crate::algebra::expressions::function::Function;
use crate::algebra::expressions::graph::{Expr, Graph, NodeView};
use crate::algebra::expressions::node::{Id, Node};
use crate::algebra::map::Map;
use crate::algebra::normal_form::polynomial::{Expander, Monomial, Polynomial};
use crate::algebra::rational::Rational;

/// Terms of a sum in which roots are brought together, and on the way there.
const TERMS: usize = 64;
const ON_THE_WAY: usize = 400;
/// Roots that are brought together in one sum.
const ROOTS: usize = 8;

/// Expressions of the same values in which differences of roots and cosines do not cancel, as far as each is a sum by
/// itself, and then with those that only multiplying out brings together; nothing where there are none.
pub fn without_differences<'g>(outputs: &[Expr<'g>]) -> Vec<Vec<Expr<'g>>> {
    let mut found: Vec<Vec<Expr<'g>>> = Vec::new();
    for gathered in [false, true] {
        let Some(first) = outputs.first() else { continue };
        let mut differences = Differences::new(first.graph, gathered);
        let rewritten: Vec<Expr<'g>> = outputs.iter().map(|e| differences.of(*e)).collect();
        if rewritten != outputs && !found.contains(&rewritten) {
            found.push(rewritten);
        }
    }
    found
}

/// Stand-in for zero in sums of roots that are divided by: no length is as small, so that their sum stays as it is, and
/// a difference that is zero stays zero.
fn tiny() -> Rational {
    Rational::new(1, 1 << 50).pow(2)
}

/// |l|, or [`tiny`] where that is zero.
fn positive(length: Expr<'_>) -> Expr<'_> {
    let graph = length.graph;
    let size = graph.call(Function::Abs, length);
    size + (graph.one() - graph.call(Function::Signum, size)).group().scale(tiny())
}

struct Differences<'g> {
    graph: &'g Graph,
    expander: Expander<'g>,
    /// Whether sums are multiplied out to bring roots together.
    gathered: bool,
    done: Map<Id, Expr<'g>>,
    /// Roots that an expression is made of.
    roots: Map<Id, Vec<Id>>,
}

impl<'g> Differences<'g> {
    fn new(graph: &'g Graph, gathered: bool) -> Self {
        let expander = Expander::new(graph, ON_THE_WAY);
        Self { graph, expander, gathered, done: Map::default(), roots: Map::default() }
    }

    fn of(&mut self, e: Expr<'g>) -> Expr<'g> {
        for part in e.stages(|key| self.done.contains_key(&key)) {
            self.visit(part);
        }
        self.visit(e)
    }

    fn visit(&mut self, e: Expr<'g>) -> Expr<'g> {
        if e.is_constant() {
            return e;
        }
        if let Some(&done) = self.done.get(&e.id) {
            return done;
        }
        let result = self.rewritten(e);
        self.done.insert(e.id, result);
        result
    }

    fn rewritten(&mut self, e: Expr<'g>) -> Expr<'g> {
        let graph = self.graph;
        match e.view() {
            NodeView::Number(_) | NodeView::Symbol(_) | NodeView::Opaque(_) => e,
            NodeView::Sum(terms) => {
                if let Some(gathered) = self.of_gathered_roots(e) {
                    return gathered;
                }
                let parts: Vec<_> = terms.into_iter().map(|(c, term)| (c, self.visit(term))).collect();
                let sum = graph.sum(parts);
                self.of_root(sum).unwrap_or_else(|| of_pairs(sum))
            }
            NodeView::Product(factors) => {
                let parts: Vec<_> = factors.into_iter().map(|(factor, n)| (self.visit(factor), n)).collect();
                graph.product(Rational::one(), parts)
            }
            NodeView::Call(function, argument) => graph.call(function, self.visit(argument)),
            NodeView::Binary(function, a, b) => self.visit(a).binary(function, self.visit(b)),
            NodeView::Own(function, arguments) => {
                let arguments: Vec<_> = arguments.into_iter().map(|argument| self.visit(argument)).collect();
                graph.own(function, &arguments)
            }
            NodeView::Group(inner) => self.visit(inner).group(),
        }
    }

    /// `k (√u − l)` of a constant l whose square cancels in u: `k (u − l²)/(√u + s)`, and `k (s − l)`, with s = |l|, so
    /// that it is zero of a length, once and for all. Where l is zero, s is [`tiny`]: √u may vanish as well.
    fn of_root(&mut self, sum: Expr<'g>) -> Option<Expr<'g>> {
        let NodeView::Sum(terms) = sum.view() else { return None };
        terms.iter().find_map(|&(c, term)| {
            let (root, u) = factors_of(term).into_iter().find_map(|(factor, n)| match factor.view() {
                NodeView::Call(Function::Sqrt, u) if n == 1 && !u.is_constant() => Some((factor, u)),
                _ => None,
            })?;
            let factor = (term * root.recip()).scale(c);
            let others = terms.iter().filter(|(_, other)| *other != term);
            let length = self.graph.sum(others.map(|&(c, e)| (-c, e * factor.recip())));
            let negative = length.as_number().is_some_and(Rational::is_negative);
            if !length.is_constant() || matches!(length.view(), NodeView::Sum(_)) || negative {
                return None;
            }
            let size = length.as_number().map_or_else(|| positive(length), |_| length);
            let rest = self.difference(u, length.powi(2))?.group() * (root + size).group().recip();
            Some(factor * (rest + (size - length)).group())
        })
    }

    /// a − b multiplied out, if something cancels.
    fn difference(&mut self, a: Expr<'g>, b: Expr<'g>) -> Option<Expr<'g>> {
        let apart = self.expander.expand(a)?.len() + self.expander.expand(b)?.len();
        let difference = self.expander.expand(a - b)?;
        (difference.len() < apart).then(|| difference.collect())
    }

    /// A sum in which something cancels where roots are taken for one another: each as the first and a small rest.
    fn of_gathered_roots(&mut self, e: Expr<'g>) -> Option<Expr<'g>> {
        if !self.gathered || self.roots_in(e).len() < 2 {
            return None;
        }
        let whole = self.expander.expand(e).filter(|whole| whole.len() <= TERMS)?;
        let near = self.near_roots(&whole);
        if near.is_empty() || !cancels(&whole, &near) {
            return None;
        }
        let by_root = |id: Id| near.iter().find(|root| root.id == id);
        let terms = whole.terms.iter().map(|(monomial, c)| {
            let factors = monomial.factors.iter().map(|&(id, n)| match by_root(id) {
                Some(near) if n > 0 => (near.base + near.rest, n),
                Some(near) => (near.reciprocal(self.graph), -n),
                None => (self.graph.expr(id), n),
            });
            (*c, self.graph.product(Rational::one(), factors))
        });
        let sum = self.graph.sum(terms);
        let gathered = self.expander.expand(sum).filter(|gathered| gathered.len() <= TERMS)?.collect();
        let rests: Map<u32, Expr<'g>> = near.iter().map(|near| (near.rest.id, near.meaning)).collect();
        Some(gathered.substitute(&rests))
    }

    /// Roots of a normal form that differ little from another one of it.
    fn near_roots(&mut self, whole: &Polynomial<'g>) -> Vec<NearRoot<'g>> {
        let mut radicands: Vec<(Id, Expr<'g>)> = Vec::new();
        for &(atom, _) in whole.terms.keys().flat_map(|monomial| &monomial.factors) {
            if let Node::Call(Function::Sqrt, u) = self.graph.node(atom)
                && radicands.iter().all(|(known, _)| *known != atom)
            {
                radicands.push((atom, self.graph.expr(u)));
            }
        }
        if radicands.len() > ROOTS {
            return Vec::new();
        }
        let mut near: Vec<NearRoot<'g>> = Vec::new();
        for (k, &(id, u)) in radicands.iter().enumerate() {
            let before = radicands[..k].iter().filter(|(other, _)| near.iter().all(|near| near.id != *other));
            let found = before.clone().find_map(|&(other, v)| Some((other, self.difference(u, v)?)));
            let Some((other, difference)) = found else { continue };
            let (root, base) = (self.graph.expr(id), self.graph.expr(other));
            let finite =
                whole.terms.keys().flat_map(|monomial| &monomial.factors).any(|&(atom, n)| atom == id && n > 0);
            // What divides by roots has no value where they vanish; what does not keeps its own.
            let sum = if finite { root + base + self.graph.number(tiny()) } else { root + base };
            let meaning = (difference.group() * sum.group().recip()).group();
            near.push(NearRoot { id, base, rest: self.graph.symbol("δ", "\\delta", false), meaning });
        }
        near
    }

    fn roots_in(&mut self, e: Expr<'g>) -> Vec<Id> {
        if let Some(known) = self.roots.get(&e.id) {
            return known.clone();
        }
        let node = self.graph.node(e.id);
        let mut roots = Vec::new();
        if !e.is_constant() {
            if matches!(node, Node::Call(Function::Sqrt, _)) {
                roots.push(e.id);
            }
            for part in node.children() {
                roots.extend(self.roots_in(self.graph.expr(part)));
            }
            roots.sort_unstable();
            roots.dedup();
            roots.truncate(ROOTS + 1);
        }
        self.roots.insert(e.id, roots.clone());
        roots
    }
}

/// A root as another one and a small rest.
struct NearRoot<'g> {
    id: Id,
    base: Expr<'g>,
    /// The symbol of `√u − √v`, and what it stands for.
    rest: Expr<'g>,
    meaning: Expr<'g>,
}

impl<'g> NearRoot<'g> {
    /// `1/√u = 1/√v − δ/(√u √v)`.
    fn reciprocal(&self, graph: &'g Graph) -> Expr<'g> {
        self.base.recip() - self.rest * self.base.recip() * graph.expr(self.id).recip()
    }
}

/// Whether terms vanish altogether where each root is taken for the one that it is near to.
fn cancels<'g>(whole: &Polynomial<'g>, near: &[NearRoot<'g>]) -> bool {
    let mut sums: Vec<(Monomial, Rational)> = Vec::new();
    for (monomial, c) in &whole.terms {
        let merged = monomial.factors.iter().fold(Monomial::default(), |merged, &(id, n)| {
            let id = near.iter().find(|near| near.id == id).map_or(id, |near| near.base.id);
            merged.times(&Monomial::new(vec![(id, n)]))
        });
        match sums.iter_mut().find(|(other, _)| *other == merged) {
            Some((_, sum)) => *sum = sum.plus(*c),
            None => sums.push((merged, *c)),
        }
    }
    sums.iter().any(|(_, sum)| sum.is_zero())
}

/// Terms `c m a` and `±c m b` with `a`, `b` = cosines or sines of two angles, or one of them 1, and squares: as
/// products.
fn of_pairs(sum: Expr<'_>) -> Expr<'_> {
    let NodeView::Sum(mut open) = sum.view() else { return sum };
    let graph = sum.graph;
    let mut closed = Vec::new();
    let mut k = 0;
    while k < open.len() {
        let (c, term) = open[k];
        let partner = (k + 1..open.len()).find_map(|j| {
            let (d, other) = open[j];
            let moving = !term.is_constant() || !other.is_constant();
            let sign = if c == d { Some(false) } else { (c == -d).then_some(true) };
            sign.filter(|_| moving).and_then(|opposite| of_pair(term, other, opposite)).map(|product| (j, product))
        });
        match partner {
            Some((j, product)) => {
                open.remove(j);
                open.remove(k);
                closed.push((c, product));
            }
            None => k += 1,
        }
    }
    if closed.is_empty() { sum } else { graph.sum(open.into_iter().chain(closed)) }
}

/// a − b, or a + b, as a product.
fn of_pair<'g>(a: Expr<'g>, b: Expr<'g>, opposite: bool) -> Option<Expr<'g>> {
    let graph = a.graph;
    let (mut own, mut others, mut common) = (factors_of(a), factors_of(b), graph.one());
    own.retain_mut(|(factor, n)| {
        let Some((_, m)) = others.iter_mut().find(|(other, m)| other == factor && (*m > 0) == (*n > 0)) else {
            return true;
        };
        let shared = if *n > 0 { (*n).min(*m) } else { (*n).max(*m) };
        common = common * factor.powi(shared);
        (*n, *m) = (*n - shared, *m - shared);
        *n != 0
    });
    others.retain(|(_, m)| *m != 0);
    let two = graph.integer(2);
    let halves = |x: Expr<'g>, y: Expr<'g>| [(x + y).half(), (x - y).half()];
    let product = match (angle_of(&own), angle_of(&others)) {
        (Some((Function::Cos, x)), None) | (None, Some((Function::Cos, x))) if own.is_empty() || others.is_empty() => {
            // c − c cos x, or the other way round.
            let square = if opposite { x.half().sin() } else { x.half().cos() }.powi(2);
            two * if opposite && others.is_empty() { -square } else { square }
        }
        (Some((Function::Cos, x)), Some((Function::Cos, y))) if opposite => {
            let [mean, half] = halves(x, y);
            -two * mean.sin() * half.sin()
        }
        (Some((Function::Sin, x)), Some((Function::Sin, y))) if opposite => {
            let [mean, half] = halves(x, y);
            two * mean.cos() * half.sin()
        }
        _ if opposite => {
            let [own, others] = [root_of(graph, &own)?, root_of(graph, &others)?];
            (own - others).group() * (own + others).group()
        }
        _ => return None,
    };
    Some(common * product)
}

/// The factors of a term; none of 1.
fn factors_of(term: Expr<'_>) -> Vec<(Expr<'_>, i32)> {
    match term.view() {
        NodeView::Product(factors) => factors,
        _ if term == term.graph.one() => Vec::new(),
        _ => vec![(term, 1)],
    }
}

/// A sine or a cosine, if that is all.
fn angle_of<'g>(factors: &[(Expr<'g>, i32)]) -> Option<(Function, Expr<'g>)> {
    match factors {
        [(factor, 1)] => match factor.view() {
            NodeView::Call(function @ (Function::Sin | Function::Cos), x) => Some((function, x)),
            _ => None,
        },
        _ => None,
    }
}

/// The root of a square.
fn root_of<'g>(graph: &'g Graph, factors: &[(Expr<'g>, i32)]) -> Option<Expr<'g>> {
    let even = factors.iter().all(|(_, n)| *n > 0 && n % 2 == 0);
    even.then(|| graph.product(Rational::one(), factors.iter().map(|&(factor, n)| (factor, n / 2))))
}

#[cfg(test)]
mod tests {
    use super::{tiny, without_differences};
    use crate::algebra::{Evaluation, Expr, Graph, Map, Number, Precise, Scalar};

    fn length<'g>(x: Expr<'g>, y: Expr<'g>) -> Expr<'g> {
        (x.powi(2) + y.powi(2)).group().sqrt()
    }

    /// The last form, in which most is brought together, in double precision; the error of the first one would be 1.
    #[track_caller]
    fn is_exact_in_another_form(e: Expr<'_>, values: &[(Expr<'_>, f64)]) {
        let forms = without_differences(&[e]);
        let double: Map<u32, f64> = values.iter().map(|(symbol, value)| (symbol.key(), *value)).collect();
        let long: Map<u32, Precise> = double.iter().map(|(&key, value)| (key, Precise::number(*value))).collect();
        let exact = Evaluation::new(&long).value(e).to_f64();
        let found = Evaluation::new(&double).value(forms.last().expect("another form")[0]);
        // A dozen roundings.
        assert!((found - exact).abs() <= 12.0 * f64::EPSILON * exact.abs(), "{found:e} in place of {exact:e}");
        let plain = Evaluation::new(&double).value(e);
        assert!((plain - exact).abs() > 1e-4 * exact.abs(), "nothing is lost: {plain:e} beside {exact:e}");
    }

    #[test]
    fn differences_of_like_functions_keep_their_digits() {
        let graph = Graph::new();
        let [x, y, l] = ["x", "y", "l"].map(|name| graph.symbol(name, name, name == "l"));
        let (one, thousand) = (graph.one(), graph.integer(1000));
        let near = [(x, 3e-14), (y, 2e-15), (l, 7.3)];
        is_exact_in_another_form(length(thousand + x, y) - thousand, &near);
        is_exact_in_another_form((length(l + x, y) - l) * y, &near);
        is_exact_in_another_form(l * (length(x - l, y) - l), &near);
        let pulls = [one + x, one - x].map(|x| x * length(x, y).recip());
        is_exact_in_another_form(pulls[0] - pulls[1] + x, &near);
        is_exact_in_another_form(l - l * x.cos(), &[(x, 1e-9), (l, 7.3)]);
        is_exact_in_another_form(x.cos() - y.cos(), &[(x, 1.3), (y, 1.3 + 1e-15)]);
        is_exact_in_another_form(x.sin() - y.sin(), &[(x, 1.3), (y, 1.3 + 1e-15)]);
        is_exact_in_another_form(l * x.powi(2) - l * y.powi(2), &[(x, 1.3), (y, 1.3 + 1e-15), (l, 7.3)]);
    }

    /// A length of either sign, with the point at its end: no form divides by zero there.
    #[test]
    fn other_forms_have_a_value_where_a_length_is_negative() {
        let graph = Graph::new();
        let (x, l) = (graph.symbol("x", "x", false), graph.symbol("l", "l", true));
        let stretch = (l + x).powi(2).group().sqrt() - l;
        for form in without_differences(&[stretch]) {
            let values = Map::from_iter([(x.key(), 0.0), (l.key(), -2.0)]);
            assert_eq!(Evaluation::new(&values).value(form[0]), 4.0);
        }
    }

    /// A length of zero from a point to itself: 0/0 in a form that divides by the sum of both.
    #[test]
    fn other_forms_have_a_value_where_a_length_is_zero() {
        let graph = Graph::new();
        let [x, y, l] = ["x", "y", "l"].map(|name| graph.symbol(name, name, name == "l"));
        let stretches = [(length(l + x, y) - l).powi(2), (length(l + x, y) - length(l - x, y)).powi(2)];
        for stretch in stretches {
            let forms = without_differences(&[stretch]);
            assert!(!forms.is_empty());
            for (x_value, expected) in [(0.0, [0.0, 0.0]), (3e-9, [9e-18, 0.0])] {
                let values = Map::from_iter([(x.key(), x_value), (y.key(), 0.0), (l.key(), 0.0)]);
                let expected = expected[usize::from(stretch == stretches[1])];
                for form in &forms {
                    let found = Evaluation::new(&values).value(form[0]);
                    // A few roundings, and the square of what zero is taken for.
                    let error = 8.0 * f64::EPSILON * expected + 8.0 * tiny().to_f64().powi(2);
                    assert!((found - expected).abs() <= error, "{found:e}, not {expected:e}");
                }
            }
        }
    }

    #[test]
    fn other_sums_stay_as_they_are() {
        let graph = Graph::new();
        let [x, y, l] = ["x", "y", "l"].map(|name| graph.symbol(name, name, name == "l"));
        let others = [length(x, y) - l, x - y, x.cos() - y.sin(), x.powi(3) - y.powi(2), length(x, y) + x.cos() * y];
        assert!(without_differences(&others).is_empty());
    }
}
