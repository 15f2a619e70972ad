//! Expressions as their author would write them: with the names of `define`, and with quarter turns of files as such.

use std::cell::RefCell;

use crate::algebra::{Expr, Graph, Notation, Rational, Substitution, print};
use crate::mechanics::name::Name;
use crate::mechanics::print::rows::{PrintedRow, Section};
use crate::mechanics::tidy;

/// Names and angles that are other in print than in kernels.
#[derive(Clone, Default)]
pub struct Readings<'g> {
    /// Expressions with names, each after those that it is made of.
    pub names: Vec<(Name, Expr<'g>)>,
    /// Numbers of a file that are so many quarters of a turn to their last place, as the symbols that they are.
    pub angles: Vec<(Expr<'g>, i64)>,
}

/// The same with symbols for the names.
pub(in crate::mechanics) struct PrintSymbols<'g> {
    angles: Vec<(Expr<'g>, i64)>,
    /// Expressions, and the symbols of their names.
    named: Vec<(Expr<'g>, Expr<'g>)>,
    names: Vec<Name>,
    /// Angles that occurred.
    turned: RefCell<Vec<usize>>,
}

impl<'g> PrintSymbols<'g> {
    /// Prepares the readings; values of speeds that constraints were solved for come into the place of the names.
    pub fn new(readings: &Readings<'g>, replacement: Option<&Substitution<'g>>) -> Self {
        let whole = |e: Expr<'g>| replacement.map_or(e, |replacement| replacement.of(e));
        let named = readings.names.iter().map(|(name, value)| {
            let symbol = value.graph().symbol(name.text.clone(), name.latex.clone(), value.is_constant());
            (whole(*value), symbol)
        });
        let names = readings.names.iter().map(|(name, _)| name.clone()).collect();
        Self { angles: readings.angles.clone(), named: named.collect(), names, turned: RefCell::default() }
    }

    /// The expression with angles of files read as the quarter turns that they are meant to be.
    fn turned(&self, e: Expr<'g>) -> Expr<'g> {
        if self.angles.is_empty() {
            return e;
        }
        for (k, angle) in self.angles.iter().enumerate() {
            let mut seen = self.turned.borrow_mut();
            if !seen.contains(&k) && e.with_quarter_turns(&[*angle]) != e {
                seen.push(k);
            }
        }
        e.with_quarter_turns(&self.angles)
    }

    /// The expression with names, where that is no longer than without.
    pub fn legible(&self, e: Expr<'g>) -> Expr<'g> {
        self.with(e, self.named.len(), tidy::legible)
    }

    /// The expression with the first so many names.
    fn with(&self, e: Expr<'g>, names: usize, set: impl Fn(Expr<'g>) -> Expr<'g>) -> Expr<'g> {
        let e = self.turned(e);
        let plain = set(e);
        if names == 0 {
            return plain;
        }
        // The last ones first: they are made of the others.
        let named: Vec<_> = self.named[..names].iter().rev().copied().collect();
        let ways = [set(e.with_named(&named)), plain.with_named(&named)];
        ways.into_iter().min_by_key(|way| way.leaves()).filter(|way| way.leaves() <= plain.leaves()).unwrap_or(plain)
    }

    /// Multiplied out if it is short enough to read, with names.
    pub fn readable(&self, e: Expr<'g>) -> Option<Expr<'g>> {
        let short = self.legible(e);
        tidy::readable(short).map(|_| short)
    }

    /// Rates of speeds under the names that readers know.
    pub fn rates(&self, rates: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let renamed = rates.iter().map(|rate| {
            let [text, latex] = [Notation::Text, Notation::Latex].map(|notation| print(*rate, notation));
            let name = Name::new(&text, &latex).printed_rate();
            rate.graph().symbol(name.text, name.latex, false)
        });
        renamed.collect()
    }

    /// Definitions of the names in some rows, and of the names in those.
    pub fn definitions(&self, rows: &[Expr<'g>]) -> Section<'g> {
        let mut used = vec![false; self.named.len()];
        let mut found = Vec::new();
        for k in (0..self.named.len()).rev() {
            let (value, symbol) = self.named[k];
            used[k] = rows.iter().chain(&found).any(|row| row.contains(symbol));
            if used[k] {
                found.push(self.with(value, k, tidy::legible));
            }
        }
        found.reverse();
        let names = self.names.iter().zip(used).filter(|(_, used)| *used).map(|(name, _)| name.clone());
        let rows = names.zip(found).map(|(name, value)| PrintedRow::Definition(name, value)).collect();
        Section { title: Name::new("definitions", "definitions"), rows }
    }

    /// Which numbers were read as quarter turns.
    pub fn quarter_turns(&self, graph: &'g Graph) -> Section<'g> {
        let mut seen = self.turned.borrow().clone();
        seen.sort_unstable();
        let pi = graph.symbol("π", "\\pi", true);
        let row = |k: usize| {
            let (number, quarters) = self.angles[k];
            let name = [Notation::Text, Notation::Latex].map(|notation| print(number, notation));
            PrintedRow::Definition(Name::new(&name[0], &name[1]), pi.scale(Rational::new(quarters, 2)))
        };
        let title = "angles of the file that are quarter turns to their last digit, and are printed as these";
        Section { title: Name::new(title, title), rows: seen.into_iter().map(row).collect() }
    }
}
