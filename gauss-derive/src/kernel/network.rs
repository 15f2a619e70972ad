//! Sums and products of many terms as a network of nodes, with the parts that several of them contain split off.

use crate::algebra::{Expr, Function, Map, NodeView, Rational};

/// Index of a node of a network.
pub type Place = usize;

#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Node<'g> {
    Number(Rational),
    /// An argument of the function or a constant.
    Leaf(Expr<'g>),
    /// Σ cᵢ nᵢ; the constant term is a multiple of the node of the number one.
    Sum(Vec<(Rational, Place)>),
    /// Π nᵢ, repeated for powers.
    Product(Vec<Place>),
    /// 1/n. A quotient is a product with one, so that quotients with the same denominator share it.
    Reciprocal(Place),
    Call(Function, Place),
}

/// The nodes of one function, each once; children may follow their parents.
pub struct Network<'g> {
    pub nodes: Vec<Node<'g>>,
    /// (coefficient, node) of every output.
    pub outputs: Vec<(Rational, Place)>,
    index: Map<Node<'g>, Place>,
    memo: Map<u32, (Rational, Place)>,
}

impl<'g> Network<'g> {
    pub fn new(outputs: &[Expr<'g>]) -> Self {
        let mut network = Self { nodes: Vec::new(), outputs: Vec::new(), index: Map::default(), memo: Map::default() };
        network.outputs = outputs.iter().map(|&e| network.visit(e)).collect();
        network.share_products();
        network.merge_duplicates();
        network.share_sums();
        network.merge_duplicates();
        network
    }

    fn place(&mut self, node: Node<'g>) -> Place {
        if let Some(&place) = self.index.get(&node) {
            return place;
        }
        self.nodes.push(node.clone());
        self.index.insert(node, self.nodes.len() - 1);
        self.nodes.len() - 1
    }

    /// The node of an expression up to a number, which sums and products around it take over.
    fn visit(&mut self, e: Expr<'g>) -> (Rational, Place) {
        if let Some(&done) = self.memo.get(&e.key()) {
            return done;
        }
        let one = Rational::one();
        let result = match e.view() {
            NodeView::Number(value) if value.is_zero() => (one, self.place(Node::Number(value))),
            NodeView::Number(value) => (value, self.place(Node::Number(one))),
            NodeView::Symbol(_) => (one, self.place(Node::Leaf(e))),
            NodeView::Group(inner) | NodeView::Opaque(inner) => self.visit(inner),
            NodeView::Call(function, argument) => {
                let (c, place) = self.visit(argument);
                let argument = self.scaled(c, place);
                (one, self.place(Node::Call(function, argument)))
            }
            NodeView::Sum(terms) => {
                let terms = terms.into_iter().map(|(c, e)| {
                    let (d, place) = self.visit(e);
                    (c * d, place)
                });
                let terms: Vec<_> = terms.collect();
                self.sum(terms)
            }
            NodeView::Product(factors) => {
                let (mut coefficient, mut places) = (one, Vec::new());
                for (e, n) in factors {
                    let (c, place) = self.visit(e);
                    coefficient *= c.pow(n);
                    let place = if n > 0 { place } else { self.place(Node::Reciprocal(place)) };
                    places.extend(std::iter::repeat_n(place, n.unsigned_abs() as usize));
                }
                (coefficient, self.product(places))
            }
        };
        self.memo.insert(e.key(), result);
        result
    }

    fn scaled(&mut self, c: Rational, place: Place) -> Place {
        if c.is_one() { place } else { self.place(Node::Sum(vec![(c, place)])) }
    }

    /// A sum up to sign: the first term is positive, so that a − b and b − a are one node.
    fn sum(&mut self, mut terms: Vec<(Rational, Place)>) -> (Rational, Place) {
        let one = Rational::one();
        if let [(c, place)] = terms[..] {
            return (c, place);
        }
        terms.sort_by_key(|t| t.1);
        let negative = terms[0].0.is_negative();
        if negative {
            terms.iter_mut().for_each(|t| t.0 = -t.0);
        }
        let place = self.place(Node::Sum(terms));
        (if negative { -one } else { one }, place)
    }

    fn product(&mut self, mut factors: Vec<Place>) -> Place {
        factors.retain(|&p| self.nodes[p] != Node::Number(Rational::one()));
        factors.sort_unstable();
        match factors[..] {
            [] => self.place(Node::Number(Rational::one())),
            [only] => only,
            _ => self.place(Node::Product(factors)),
        }
    }

    /// Splits the most frequent pair of factors off all products that have it, until no pair occurs twice.
    fn share_products(&mut self) {
        loop {
            let mut count: Map<(Place, Place), usize> = Map::default();
            for node in &self.nodes {
                let Node::Product(factors) = node else { continue };
                let mut seen = Vec::new();
                for (i, &a) in factors.iter().enumerate() {
                    for &b in &factors[i + 1..] {
                        if !seen.contains(&(a, b)) {
                            seen.push((a, b));
                        }
                    }
                }
                for pair in seen {
                    *count.entry(pair).or_default() += 1;
                }
            }
            let best = count
                .into_iter()
                .filter(|&(_, n)| n >= 2)
                .max_by_key(|&((a, b), n)| (n, usize::MAX - a, usize::MAX - b));
            let Some(((a, b), _)) = best else { return };
            let pair = self.place(Node::Product(vec![a, b]));
            let mut progress = false;
            for place in 0..self.nodes.len() {
                let Node::Product(factors) = &self.nodes[place] else { continue };
                if place == pair || factors.len() < 3 {
                    continue;
                }
                let mut rest = factors.clone();
                let Some(i) = rest.iter().position(|&f| f == a) else { continue };
                rest.remove(i);
                let Some(j) = rest.iter().position(|&f| f == b) else { continue };
                rest.remove(j);
                rest.push(pair);
                rest.sort_unstable();
                self.nodes[place] = Node::Product(rest);
                progress = true;
            }
            if !progress {
                return;
            }
        }
    }

    /// Splitting parts off can make two nodes alike: everything that refers to the later one is led to the first, and
    /// the later one, which nobody needs any more, is blanked.
    fn merge_duplicates(&mut self) {
        loop {
            let mut first: Map<Node<'g>, Place> = Map::default();
            let lead: Vec<Place> =
                self.nodes.iter().enumerate().map(|(k, node)| *first.entry(node.clone()).or_insert(k)).collect();
            let mut changed = false;
            let mut follow = |place: &mut Place| {
                changed |= lead[*place] != *place;
                *place = lead[*place];
            };
            for node in &mut self.nodes {
                match node {
                    Node::Number(_) | Node::Leaf(_) => {}
                    Node::Sum(terms) => {
                        terms.iter_mut().for_each(|t| follow(&mut t.1));
                        terms.sort_by_key(|t| t.1);
                    }
                    Node::Product(factors) => {
                        factors.iter_mut().for_each(&mut follow);
                        factors.sort_unstable();
                    }
                    Node::Reciprocal(a) | Node::Call(_, a) => follow(a),
                }
            }
            self.outputs.iter_mut().for_each(|o| follow(&mut o.1));
            for (k, &to) in lead.iter().enumerate() {
                if k != to {
                    self.nodes[k] = Node::Number(Rational::zero());
                }
            }
            self.index = first;
            if !changed {
                return;
            }
        }
    }

    /// The same for pairs of terms, up to a common factor.
    fn share_sums(&mut self) {
        type Pair = (Place, Place, Rational);
        let pairs = |terms: &[(Rational, Place)]| -> Vec<Pair> {
            let mut pairs = Vec::new();
            for (i, &(c, a)) in terms.iter().enumerate() {
                for &(d, b) in &terms[i + 1..] {
                    pairs.push((a, b, d / c));
                }
            }
            pairs
        };
        loop {
            let mut count: Map<Pair, usize> = Map::default();
            for node in &self.nodes {
                let Node::Sum(terms) = node else { continue };
                for pair in pairs(terms) {
                    *count.entry(pair).or_default() += 1;
                }
            }
            let best = count
                .into_iter()
                .filter(|&(_, n)| n >= 2)
                .max_by_key(|&((a, b, r), n)| (n, usize::MAX - a, usize::MAX - b, r));
            let Some(((a, b, ratio), _)) = best else { return };
            let pair = self.place(Node::Sum(vec![(Rational::one(), a), (ratio, b)]));
            let mut progress = false;
            for place in 0..self.nodes.len() {
                let Node::Sum(terms) = &self.nodes[place] else { continue };
                if place == pair || terms.len() < 3 {
                    continue;
                }
                let (Some(i), Some(j)) = (terms.iter().position(|t| t.1 == a), terms.iter().position(|t| t.1 == b))
                else {
                    continue;
                };
                if terms[j].0 / terms[i].0 != ratio {
                    continue;
                }
                let coefficient = terms[i].0;
                let mut rest: Vec<_> =
                    terms.iter().enumerate().filter(|(k, _)| *k != i && *k != j).map(|(_, t)| *t).collect();
                rest.push((coefficient, pair));
                rest.sort_by_key(|t| t.1);
                self.nodes[place] = Node::Sum(rest);
                progress = true;
            }
            if !progress {
                return;
            }
        }
    }
}
