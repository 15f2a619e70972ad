//! Strongly connected components (Tarjan 1972).

use std::collections::{BTreeMap, BTreeSet};

/// Sets of more than one node each of which can be reached from all others, the largest first.
pub fn components<'a>(edges: impl Iterator<Item = &'a (String, String)>) -> Vec<BTreeSet<String>> {
    let mut search = Search::default();
    for (from, to) in edges {
        search.next.entry(from).or_default().push(to);
        search.next.entry(to).or_default();
    }
    let nodes: Vec<&str> = search.next.keys().copied().collect();
    for node in nodes {
        search.visit(node);
    }
    search.found.sort_by_key(|component| std::cmp::Reverse(component.len()));
    search.found
}

#[derive(Default)]
struct Search<'a> {
    next: BTreeMap<&'a str, Vec<&'a str>>,
    /// When a node was met first, and the earliest node that it leads back to.
    met: BTreeMap<&'a str, (usize, usize)>,
    open: Vec<&'a str>,
    found: Vec<BTreeSet<String>>,
}

impl<'a> Search<'a> {
    fn visit(&mut self, node: &'a str) -> usize {
        if let Some((_, back)) = self.met.get(node) {
            return *back;
        }
        let number = self.met.len();
        let mut back = number;
        self.met.insert(node, (number, back));
        self.open.push(node);
        for next in self.next[node].clone() {
            if !self.met.contains_key(next) || self.open.contains(&next) {
                back = back.min(self.visit(next));
            }
        }
        self.met.insert(node, (number, back));
        if back == number {
            let start = self.open.iter().position(|open| *open == node).expect("it is open");
            let component: BTreeSet<String> = self.open.drain(start..).map(str::to_owned).collect();
            if component.len() > 1 {
                self.found.push(component);
            }
        }
        back
    }
}
