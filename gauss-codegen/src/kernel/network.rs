//! Sums and products of many terms as a network of nodes, with the parts that several of them contain split off.

use std::collections::HashMap;

use crate::algebra::{
    BinaryFunction, Expr, Function, Key, MOST_VARIABLES, Map, NodeView, OwnFunction, Rational, joined,
};

use super::passes::{Pass, Passes};

/// Parts of one sum or product that are paired with one another: the number of pairs goes with its square.
const PAIRED: usize = 200;

/// Pairs that are looked at before a program is left as it is: at least, and for each of its nodes. All scenes that are
/// known need a tenth.
const PAIRS: [usize; 2] = [500_000, 500];

/// Levels that are written at once: a chain of more, each part the part of one other, would overflow the stack.
const LEVELS: u32 = 400;

/// Index of a node of a network.
pub type NodeIndex = usize;

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NetworkNode<'g> {
    Number(Rational),
    /// An argument of the function or a constant.
    Leaf(Expr<'g>),
    /// Σ cᵢ nᵢ; the constant term is a multiple of the node of the number one.
    Sum(Vec<(Rational, NodeIndex)>),
    /// Π nᵢ, repeated for powers.
    Product(Vec<NodeIndex>),
    /// 1/n. A quotient is a product with one, so that quotients with the same denominator share it.
    Reciprocal(NodeIndex),
    Call(Function, NodeIndex),
    Binary(BinaryFunction, NodeIndex, NodeIndex),
    Own(OwnFunction, [NodeIndex; MOST_VARIABLES]),
}

impl Key for NetworkNode<'_> {
    fn word(&self) -> u64 {
        match self {
            NetworkNode::Number(value) => joined(1, value.word()),
            NetworkNode::Leaf(e) => joined(2, u64::from(e.key())),
            NetworkNode::Sum(terms) => {
                let mut word = 3;
                for (c, place) in terms {
                    word = joined(word, c.word() ^ (*place as u64) << 32);
                }
                word
            }
            NetworkNode::Product(factors) => {
                let mut word = 4;
                for place in factors {
                    word = joined(word, *place as u64);
                }
                word
            }
            NetworkNode::Reciprocal(a) => joined(5, *a as u64),
            NetworkNode::Call(function, a) => joined(7 + function.word(), *a as u64),
            NetworkNode::Binary(function, a, b) => joined(joined(6, *a as u64), (*function as u64) << 32 ^ *b as u64),
            NetworkNode::Own(function, places) => {
                places.iter().fold(joined(20, function.word()), |word, place| joined(word, *place as u64))
            }
        }
    }
}

impl NetworkNode<'_> {
    /// Nodes that it is made of.
    pub fn parts(&self) -> Vec<NodeIndex> {
        match self {
            NetworkNode::Number(_) | NetworkNode::Leaf(_) => Vec::new(),
            NetworkNode::Sum(terms) => terms.iter().map(|term| term.1).collect(),
            NetworkNode::Product(factors) => factors.clone(),
            NetworkNode::Reciprocal(a) | NetworkNode::Call(_, a) => vec![*a],
            NetworkNode::Binary(_, a, b) => vec![*a, *b],
            NetworkNode::Own(function, places) => function.of(places).to_vec(),
        }
    }
}

/// The nodes of one function, each once; children may follow their parents.
pub struct Network<'g> {
    pub nodes: Vec<NetworkNode<'g>>,
    /// The first node that each is alike to: orders go by these, then by places.
    ranks: Vec<NodeIndex>,
    /// First nodes, by their structure; nothing where no symbols are alike.
    first: Option<HashMap<u64, NodeIndex>>,
    /// (coefficient, node) of every output.
    pub outputs: Vec<(Rational, NodeIndex)>,
    index: Map<NetworkNode<'g>, NodeIndex>,
    memo: Map<u32, (Rational, NodeIndex)>,
}

impl<'g> Network<'g> {
    pub fn new(outputs: &[Expr<'g>], passes: Passes) -> Self {
        let mut network = Self {
            nodes: Vec::new(),
            ranks: Vec::new(),
            first: outputs.first().filter(|e| e.graph().has_alike()).map(|_| HashMap::new()),
            outputs: Vec::new(),
            index: Map::default(),
            memo: Map::default(),
        };
        for &e in outputs {
            for part in e.stages(|key| network.memo.contains_key(&key)) {
                network.visit(part);
            }
            let output = network.visit(e);
            network.outputs.push(output);
        }
        if passes.make(Pass::Products) && network.share(GroupKind::Products) {
            network.merge_duplicates();
            network.index_anew();
        }
        // Nothing is looked up afterwards.
        if passes.make(Pass::Sums) && network.share(GroupKind::Sums) {
            network.merge_duplicates();
        }
        network
    }

    /// Nodes that are written first, parts before what is made of them, so that no more than some levels are written at
    /// once.
    pub fn stages(&self) -> Vec<NodeIndex> {
        let mut depth: Vec<Option<u32>> = vec![None; self.nodes.len()];
        let mut stages = Vec::new();
        let mut open: Vec<NodeIndex> = self.outputs.iter().rev().map(|&(_, place)| place).collect();
        while let Some(&place) = open.last() {
            if depth[place].is_some() {
                open.pop();
                continue;
            }
            let parts = self.nodes[place].parts();
            let unknown: Vec<NodeIndex> = parts.iter().copied().filter(|&part| depth[part].is_none()).collect();
            if !unknown.is_empty() {
                open.extend(unknown);
                continue;
            }
            let own = parts.iter().filter_map(|&part| depth[part]).max().map_or(0, |deepest| deepest + 1);
            let lower = |part: &&NodeIndex| depth[**part].is_some_and(|depth| depth / LEVELS < own / LEVELS);
            stages.extend(parts.iter().filter(lower));
            depth[place] = Some(own);
            open.pop();
        }
        stages
    }

    fn place(&mut self, node: NetworkNode<'g>) -> NodeIndex {
        let (nodes, ranks, first) = (&mut self.nodes, &mut self.ranks, &mut self.first);
        let new = |node: &NetworkNode<'g>| {
            let place = nodes.len();
            let rank = first.as_mut().map_or(place, |first| *first.entry(likeness(node, ranks)).or_insert(place));
            ranks.push(rank);
            nodes.push(node.clone());
            place
        };
        *self.index.or_insert_of(node, new)
    }

    /// Place in an order in which nodes that are alike have the same place.
    fn rank(&self, place: NodeIndex) -> (NodeIndex, NodeIndex) {
        (self.ranks[place], place)
    }

    /// The node of an expression up to a number, which sums and products around it take over.
    fn visit(&mut self, e: Expr<'g>) -> (Rational, NodeIndex) {
        if let Some(&done) = self.memo.get(&e.key()) {
            return done;
        }
        let one = Rational::one();
        let result = match e.view() {
            NodeView::Number(value) if value.is_zero() => (one, self.place(NetworkNode::Number(value))),
            NodeView::Number(value) => (value, self.place(NetworkNode::Number(one))),
            NodeView::Symbol(_) => (one, self.place(NetworkNode::Leaf(e))),
            NodeView::Group(inner) | NodeView::Opaque(inner) => self.visit(inner),
            NodeView::Call(function, argument) => {
                let (c, place) = self.visit(argument);
                let argument = self.scaled(c, place);
                (one, self.place(NetworkNode::Call(function, argument)))
            }
            NodeView::Binary(function, a, b) => {
                let [a, b] = [a, b].map(|e| {
                    let (c, place) = self.visit(e);
                    self.scaled(c, place)
                });
                (one, self.place(NetworkNode::Binary(function, a, b)))
            }
            NodeView::Own(function, arguments) => {
                let scaled = |e: &Expr<'g>| {
                    let (c, place) = self.visit(*e);
                    self.scaled(c, place)
                };
                let arguments: Vec<NodeIndex> = arguments.iter().map(scaled).collect();
                (one, self.place(NetworkNode::Own(function, OwnFunction::filled(&arguments))))
            }
            NodeView::Sum(terms) => {
                let mut parts = Vec::with_capacity(terms.len());
                for (c, e) in terms {
                    let (d, place) = self.visit(e);
                    parts.push((c * d, place));
                }
                self.sum(parts)
            }
            NodeView::Product(factors) => {
                let (mut coefficient, mut places) = (one, Vec::new());
                for (e, n) in factors {
                    let (c, place) = self.visit(e);
                    coefficient *= c.pow(n);
                    let place = if n > 0 { place } else { self.place(NetworkNode::Reciprocal(place)) };
                    for _ in 0..n.unsigned_abs() {
                        places.push(place);
                    }
                }
                (coefficient, self.product(places))
            }
        };
        self.memo.insert(e.key(), result);
        result
    }

    fn scaled(&mut self, c: Rational, place: NodeIndex) -> NodeIndex {
        if c.is_one() { place } else { self.place(NetworkNode::Sum(vec![(c, place)])) }
    }

    /// A sum up to sign: the first term is positive, so that a − b and b − a are one node.
    fn sum(&mut self, mut terms: Vec<(Rational, NodeIndex)>) -> (Rational, NodeIndex) {
        let one = Rational::one();
        if let [(c, place)] = terms[..] {
            return (c, place);
        }
        terms.sort_by_key(|t| self.rank(t.1));
        let negative = terms[0].0.is_negative();
        if negative {
            terms.iter_mut().for_each(|t| t.0 = -t.0);
        }
        let place = self.place(NetworkNode::Sum(terms));
        (if negative { -one } else { one }, place)
    }

    fn product(&mut self, mut factors: Vec<NodeIndex>) -> NodeIndex {
        factors.retain(|&p| self.nodes[p] != NetworkNode::Number(Rational::one()));
        factors.sort_unstable_by_key(|&place| self.rank(place));
        match factors[..] {
            [] => self.place(NetworkNode::Number(Rational::one())),
            [only] => only,
            _ => self.place(NetworkNode::Product(factors)),
        }
    }

    /// Splits pairs of parts that several sums (or several products) contain off as nodes of their own, the most
    /// frequent first, until no pair occurs twice. Terms of sums are alike up to a common factor. Whether there was
    /// any.
    fn share(&mut self, kind: GroupKind) -> bool {
        let mut shared = false;
        let mut left = PAIRS[0] + PAIRS[1] * self.nodes.len();
        loop {
            let repeated = self.repeated(kind);
            let mut holders: Map<(NodeIndex, NodeIndex, Rational), Vec<NodeIndex>> = Map::default();
            for (place, node) in self.nodes.iter().enumerate() {
                let parts = kind.parts_of(node, &repeated);
                for parts in parts.chunks(PAIRED) {
                    let pairs = parts.len() * parts.len() / 2;
                    if pairs > left {
                        return shared;
                    }
                    left -= pairs;
                    for (i, &(c, a)) in parts.iter().enumerate() {
                        for &(d, b) in &parts[i + 1..] {
                            let places = holders.or_insert_with((a, b, d / c), Vec::new);
                            if places.last() != Some(&place) {
                                places.push(place);
                            }
                        }
                    }
                }
            }
            let mut frequent: Vec<_> = holders.into_iter().filter(|(_, places)| places.len() >= 2).collect();
            frequent.sort_by_key(|((a, b, ratio), places)| {
                (usize::MAX - places.len(), self.ranks[*a], self.ranks[*b], (*a, *b, *ratio))
            });
            let mut progress = false;
            for ((a, b, ratio), places) in frequent {
                // Earlier pairs of this round may have taken the parts away.
                let places: Vec<NodeIndex> =
                    places.into_iter().filter(|&p| kind.without(&self.nodes[p], a, b, ratio).is_some()).collect();
                if places.len() < 2 {
                    continue;
                }
                let pair = self.place(kind.node(vec![(Rational::one(), a), (ratio, b)]));
                for place in places {
                    if place == pair {
                        continue;
                    }
                    if let Some((c, mut rest)) = kind.without(&self.nodes[place], a, b, ratio) {
                        if rest.is_empty() && c.is_one() {
                            // The very same parts: the two nodes will be merged.
                            continue;
                        }
                        rest.push((c, pair));
                        rest.sort_by_key(|part| self.rank(part.1));
                        self.nodes[place] = kind.node(rest);
                        progress = true;
                    }
                }
            }
            if !progress {
                return shared;
            }
            shared = true;
        }
    }

    /// The nodes that are parts of several others: only pairs of these can be.
    fn repeated(&self, kind: GroupKind) -> Vec<bool> {
        let mut last = vec![usize::MAX; self.nodes.len()];
        let mut repeated = vec![false; self.nodes.len()];
        for (place, node) in self.nodes.iter().enumerate() {
            let mut note = |part: NodeIndex| {
                if last[part] != usize::MAX && last[part] != place {
                    repeated[part] = true;
                }
                last[part] = place;
            };
            match (kind, node) {
                (GroupKind::Sums, NetworkNode::Sum(terms)) => {
                    for &(_, part) in terms {
                        note(part);
                    }
                }
                (GroupKind::Products, NetworkNode::Product(factors)) => {
                    for &part in factors {
                        note(part);
                    }
                }
                _ => {}
            }
        }
        repeated
    }

    /// Splitting parts off can make two nodes alike: everything that refers to the later one is led to the first, and
    /// the later one, which nobody needs any more, is blanked.
    fn merge_duplicates(&mut self) {
        loop {
            let mut first: Map<&NetworkNode<'g>, NodeIndex> = Map::default();
            let lead: Vec<NodeIndex> =
                self.nodes.iter().enumerate().map(|(k, node)| *first.or_insert_with(node, || k)).collect();
            let mut changed = false;
            let mut follow = |place: &mut NodeIndex| {
                changed |= lead[*place] != *place;
                *place = lead[*place];
            };
            let ranks = &self.ranks;
            let rank = |place: NodeIndex| (ranks[place], place);
            for node in &mut self.nodes {
                match node {
                    NetworkNode::Number(_) | NetworkNode::Leaf(_) => {}
                    NetworkNode::Sum(terms) => {
                        terms.iter_mut().for_each(|t| follow(&mut t.1));
                        terms.sort_by_key(|t| rank(t.1));
                    }
                    NetworkNode::Product(factors) => {
                        factors.iter_mut().for_each(&mut follow);
                        factors.sort_unstable_by_key(|&place| rank(place));
                    }
                    NetworkNode::Reciprocal(a) | NetworkNode::Call(_, a) => follow(a),
                    NetworkNode::Binary(_, a, b) => [a, b].into_iter().for_each(&mut follow),
                    NetworkNode::Own(_, places) => places.iter_mut().for_each(&mut follow),
                }
            }
            self.outputs.iter_mut().for_each(|o| follow(&mut o.1));
            for (k, &to) in lead.iter().enumerate() {
                if k != to {
                    self.nodes[k] = NetworkNode::Number(Rational::zero());
                }
            }
            if !changed {
                break;
            }
        }
    }

    fn index_anew(&mut self) {
        self.index = Map::default();
        for (k, node) in self.nodes.iter().enumerate() {
            self.index.or_insert_with(node.clone(), || k);
        }
    }
}

/// The same word for nodes that are alike.
fn likeness(node: &NetworkNode<'_>, ranks: &[NodeIndex]) -> u64 {
    let parts =
        |kind: u64, parts: &[NodeIndex]| parts.iter().fold(kind, |word, &place| joined(word, ranks[place] as u64));
    match node {
        NetworkNode::Leaf(e) => joined(0, u64::from(e.rank())),
        NetworkNode::Number(value) => joined(1, value.word()),
        NetworkNode::Sum(terms) => {
            terms.iter().fold(2, |word, (c, place)| joined(joined(word, c.word()), ranks[*place] as u64))
        }
        NetworkNode::Product(factors) => parts(3, factors),
        NetworkNode::Reciprocal(a) => parts(4, &[*a]),
        NetworkNode::Call(function, a) => parts(5 + function.word(), &[*a]),
        NetworkNode::Binary(function, a, b) => parts(20 + *function as u64, &[*a, *b]),
        NetworkNode::Own(function, places) => parts(joined(30, function.word()), places),
    }
}

/// Kinds of shared parts: terms of sums, or factors of products.
#[derive(Clone, Copy)]
enum GroupKind {
    Sums,
    Products,
}

/// Parts of a sum or a product, with their coefficients (one in a product).
type Parts = Vec<(Rational, NodeIndex)>;

impl GroupKind {
    fn parts(self, node: &NetworkNode<'_>) -> Parts {
        match (self, node) {
            (GroupKind::Sums, NetworkNode::Sum(terms)) => terms.clone(),
            (GroupKind::Products, NetworkNode::Product(factors)) => {
                factors.iter().map(|&f| (Rational::one(), f)).collect()
            }
            _ => Vec::new(),
        }
    }

    /// Parts that are `wanted`, in their order.
    fn parts_of(self, node: &NetworkNode<'_>, wanted: &[bool]) -> Parts {
        let mut parts = Vec::new();
        match (self, node) {
            (GroupKind::Sums, NetworkNode::Sum(terms)) => {
                for &(c, place) in terms {
                    if wanted[place] {
                        parts.push((c, place));
                    }
                }
            }
            (GroupKind::Products, NetworkNode::Product(factors)) => {
                for &place in factors {
                    if wanted[place] {
                        parts.push((Rational::one(), place));
                    }
                }
            }
            _ => {}
        }
        parts
    }

    fn node<'g>(self, parts: Parts) -> NetworkNode<'g> {
        match self {
            GroupKind::Sums => NetworkNode::Sum(parts),
            GroupKind::Products => NetworkNode::Product(parts.into_iter().map(|(_, place)| place).collect()),
        }
    }

    /// The parts without a and `ratio`·b, and the coefficient that a had; `None` when the node does not have both.
    fn without(self, node: &NetworkNode<'_>, a: NodeIndex, b: NodeIndex, ratio: Rational) -> Option<(Rational, Parts)> {
        let mut parts = self.parts(node);
        let (c, _) = parts.remove(parts.iter().position(|part| part.1 == a)?);
        let (d, _) = parts.remove(parts.iter().position(|part| part.1 == b)?);
        (d / c == ratio).then_some((c, parts))
    }
}
