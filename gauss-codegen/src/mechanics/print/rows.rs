//! Lines of printed equations under their headings.

use crate::algebra::{Expr, Notation, Parts, print_definition, print_with};
use crate::mechanics::name::Name;

/// One line.
pub enum PrintedRow<'g> {
    /// name = value.
    Definition(Name, Expr<'g>),
    /// d(momentum)/dt = bracket + force; the force is left out where it vanishes beside a bracket.
    Balance { momentum: Name, bracket: Expr<'g>, force: Option<Name> },
    /// left = right.
    Equation(Expr<'g>, Expr<'g>),
    /// Words in the place of equations.
    Words(String),
}

impl<'g> PrintedRow<'g> {
    pub fn print(&self, notation: Notation, parts: &Parts<'g>) -> String {
        let name = |name: &Name| name.print(notation).to_owned();
        let print = |e: &Expr<'g>| print_with(*e, notation, parts);
        match self {
            PrintedRow::Definition(left, right) => {
                format!("{} = {}", name(left), print_definition(*right, notation, parts))
            }
            PrintedRow::Balance { momentum, bracket, force } => {
                let mut terms = Vec::new();
                if !bracket.is_zero() {
                    terms.push(print(bracket));
                }
                terms.extend(force.as_ref().map(name));
                format!("{} = {}", name(&momentum.time_derivative()), terms.join(" + "))
            }
            PrintedRow::Equation(left, right) => format!("{} = {}", print(left), print(right)),
            PrintedRow::Words(words) if notation == Notation::Latex => format!("\\text{{{words}}}"),
            PrintedRow::Words(words) => words.clone(),
        }
    }

    /// Expressions that are printed of it, with the name of the one that it defines.
    pub fn expressions(&self) -> Vec<(Option<[String; 2]>, Expr<'g>)> {
        match self {
            PrintedRow::Definition(Name { text, latex }, e) => vec![(Some([text.clone(), latex.clone()]), *e)],
            PrintedRow::Balance { bracket: e, .. } => vec![(None, *e)],
            PrintedRow::Equation(left, right) => vec![(None, *left), (None, *right)],
            PrintedRow::Words(_) => Vec::new(),
        }
    }
}

/// A heading and its rows.
pub struct Section<'g> {
    pub title: Name,
    pub rows: Vec<PrintedRow<'g>>,
}
