//! Common parts of long expressions, under names, so that what is printed is no longer than the graph.

use crate::algebra::expressions::graph::{Expr, Graph};
use crate::algebra::expressions::node::{Id, Node};
use crate::algebra::map::Map;

/// Leaves up to which an expression is printed as it is.
pub const LONG: u64 = 200;
/// Leaves from which on a part is worth a name.
const WORTH: u64 = 4;
/// Letters for the names; the first that no symbol has with an index.
const LETTERS: [&str; 4] = ["s", "h", "c", "k"];

/// Names for parts of long expressions: a part that is defined in the same place keeps its name, any other part that
/// occurs more than once gets a letter with a number. Short parts are printed in full.
#[derive(Default)]
pub struct Parts<'g> {
    long: Map<Id, ()>,
    /// In text and in LaTeX.
    names: Map<Id, [String; 2]>,
    /// Expressions that the numbers stand for, those first that others are made of.
    values: Vec<Expr<'g>>,
}

impl<'g> Parts<'g> {
    /// Names parts of expressions that are printed together; some of them say what a name (in text and in LaTeX) stands
    /// for.
    pub fn of(printed: &[(Option<[String; 2]>, Expr<'g>)]) -> Self {
        let Some((_, first)) = printed.first() else { return Self::default() };
        let graph = first.graph;
        let roots: Vec<Id> = printed.iter().map(|(_, e)| graph.ungrouped(e.id)).collect();
        let everything = graph.reached(&roots, parts_of);
        let leaves = leaves_of_all(graph, &everything);
        let long: Vec<Id> = roots.iter().copied().filter(|id| leaves[id] > LONG).collect();
        let mut occurrences: Map<Id, usize> = Map::default();
        let uses = graph.reached(&long, parts_of).into_iter().flat_map(|id| parts_of(graph, id));
        uses.chain(long.iter().copied()).for_each(|id| *occurrences.or_insert_with(id, || 0) += 1);
        let mut names: Map<Id, [String; 2]> = Map::default();
        for ((name, _), id) in printed.iter().zip(&roots) {
            if let Some(name) = name.as_ref().filter(|_| leaves[id] >= WORTH) {
                names.or_insert_with(*id, || name.clone());
            }
        }
        let shared = |id: &Id| {
            leaves[id] >= WORTH && !names.contains_key(id) && occurrences.get(id).is_some_and(|&count| count > 1)
        };
        let numbered: Vec<Id> = everything.into_iter().filter(shared).collect();
        let letter = letter(graph);
        names.extend(numbered.iter().enumerate().map(|(k, &id)| (id, numbered_name(letter, k + 1))));
        let values = numbered.into_iter().map(|id| graph.expr(id)).collect();
        Self { long: long.into_iter().map(|id| (id, ())).collect(), names, values }
    }

    /// Expressions that the numbers stand for.
    pub(super) fn values(&self) -> &[Expr<'g>] {
        &self.values
    }

    /// Whether an expression is printed with names.
    pub(super) fn is_long(&self, e: Expr<'g>) -> bool {
        self.long.contains_key(&e.graph.ungrouped(e.id))
    }

    /// The name of a part, in text and in LaTeX.
    pub(super) fn name(&self, e: Expr<'g>) -> Option<&[String; 2]> {
        if self.names.is_empty() { None } else { self.names.get(&e.graph.ungrouped(e.id)) }
    }
}

/// In text with an index that no identifier can have.
fn numbered_name(letter: &str, k: usize) -> [String; 2] {
    let lowered = |digit: char| char::from_u32('₀' as u32 + digit as u32 - '0' as u32).unwrap_or(digit);
    let index: String = k.to_string().chars().map(lowered).collect();
    [format!("{letter}{index}"), format!("{letter}_{{{k}}}")]
}

/// Parts that a reader sees in it: groups are no brackets of their own.
fn parts_of(graph: &Graph, id: Id) -> Vec<Id> {
    graph.node(id).children().into_iter().map(|id| graph.ungrouped(id)).collect()
}

/// Symbols, numbers and functions that an expression has when it is written out.
pub(super) fn leaves_of(e: Expr<'_>) -> u64 {
    let root = e.graph.ungrouped(e.id);
    leaves_of_all(e.graph, &e.graph.reached(&[root], parts_of))[&root]
}

/// The same of all of these, parts before what is made of them.
fn leaves_of_all(graph: &Graph, nodes: &[Id]) -> Map<Id, u64> {
    let mut leaves = Map::default();
    for &id in nodes {
        let own = leaves_from(graph, id, &leaves);
        leaves.insert(id, own);
    }
    leaves
}

fn leaves_from(graph: &Graph, id: Id, known: &Map<Id, u64>) -> u64 {
    let own = match graph.node(id) {
        Node::Number(_) | Node::Symbol(_) | Node::Call(..) | Node::Binary(..) | Node::Own(..) => 1,
        Node::Sum(terms) => terms.iter().filter(|(c, _)| !c.abs().is_one()).count() as u64,
        _ => 0,
    };
    parts_of(graph, id).iter().fold(own, |sum, part| sum.saturating_add(known[part]))
}

/// A letter that no index is on yet.
fn letter(graph: &Graph) -> &'static str {
    let taken = |letter: &&str| graph.any_symbol(|symbol| symbol.latex.starts_with(&format!("{letter}_")));
    LETTERS.into_iter().find(|letter| !taken(letter)).unwrap_or("\\sigma")
}
