//! Expressions for people: plain text and LaTeX.

use std::fmt;

use super::graph::{BinaryFunction, Expr, Function, NodeView};
use super::rational::Rational;

/// How to write.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Notation {
    /// Plain text.
    Text,
    /// LaTeX, in math mode.
    Latex,
}

impl fmt::Debug for Expr<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&print(*self, Notation::Text))
    }
}

/// An expression on one line. Groups are written out.
pub fn print(e: Expr<'_>, notation: Notation) -> String {
    Printer { notation }.sum(e)
}

/// To double precision, with a power of ten where many zeros would stand otherwise.
pub fn decimal(value: Rational, notation: Notation) -> String {
    let value = value.to_f64();
    if (1e-5..1e16).contains(&value.abs()) {
        return value.to_string();
    }
    let scientific = format!("{value:e}");
    match scientific.split_once('e') {
        Some((digits, exponent)) if notation == Notation::Latex => format!("{digits} \\cdot 10^{{{exponent}}}"),
        _ => scientific,
    }
}

struct Printer {
    notation: Notation,
}

/// One printed term: its sign and its unsigned text.
struct Term {
    negative: bool,
    text: String,
}

impl Printer {
    fn latex(&self) -> bool {
        self.notation == Notation::Latex
    }

    fn sum(&self, e: Expr<'_>) -> String {
        let mut out = String::new();
        for (k, term) in self.terms(e).into_iter().enumerate() {
            match (k, term.negative) {
                (0, true) => out.push('-'),
                (0, false) => {}
                (_, true) => out.push_str(" - "),
                (_, false) => out.push_str(" + "),
            }
            out.push_str(&term.text);
        }
        out
    }

    fn terms(&self, e: Expr<'_>) -> Vec<Term> {
        match e.view() {
            NodeView::Group(inner) | NodeView::Opaque(inner) => self.terms(inner),
            NodeView::Sum(terms) => {
                let mut printed: Vec<Term> = terms.into_iter().map(|(c, e)| self.term(c, e)).collect();
                // A positive term first where there is one: `a - b` rather than `-b + a`.
                if printed[0].negative
                    && let Some(k) = printed.iter().position(|t| !t.negative)
                {
                    let first = printed.remove(k);
                    printed.insert(0, first);
                }
                printed
            }
            _ => vec![self.term(Rational::one(), e)],
        }
    }

    fn term(&self, coefficient: Rational, e: Expr<'_>) -> Term {
        let negative = coefficient.is_negative();
        let coefficient = coefficient.abs();
        let (mut above, mut below) = (Vec::new(), Vec::new());
        let factors = match e.view() {
            NodeView::Product(factors) => factors,
            NodeView::Number(value) => {
                return Term {
                    negative: negative != value.is_negative(),
                    text: self.number(&(value.abs() * coefficient)),
                };
            }
            _ => vec![(e, 1)],
        };
        // Constants first, as in a textbook: (I2 - I3)*w2*w3.
        let (mut factors, varying): (Vec<_>, Vec<_>) = factors.into_iter().partition(|(e, _)| e.is_constant());
        factors.extend(varying);
        // A difference takes the sign of its term in: (I3 - I1)*w1*w3 rather than -(I1 - I3)*w1*w3.
        let mut negative = negative;
        if negative && let Some(factor) = factors.iter_mut().find(|(e, n)| *n == 1 && is_difference(*e)) {
            factor.0 = -ungrouped(factor.0);
            negative = false;
        }
        let single = factors.len() == 1 && coefficient.is_one();
        for (factor, exponent) in factors {
            let base = self.factor(factor, single && exponent == 1);
            let power = match exponent.abs() {
                1 => base,
                n if self.latex() => format!("{base}^{{{n}}}"),
                n => format!("{base}^{n}"),
            };
            if exponent > 0 { above.push(power) } else { below.push(power) }
        }
        let (numerator, denominator) = self.fraction(coefficient);
        if numerator != "1" || above.is_empty() {
            above.insert(0, numerator);
        }
        below.splice(0..0, denominator);
        let times = if self.latex() { " \\, " } else { "*" };
        let text = match (below.is_empty(), self.latex()) {
            (true, _) => above.join(times),
            (false, true) => format!("\\frac{{{}}}{{{}}}", above.join(times), below.join(times)),
            (false, false) if below.len() == 1 => format!("{}/{}", above.join(times), below[0]),
            (false, false) => format!("{}/({})", above.join(times), below.join(times)),
        };
        Term { negative, text }
    }

    fn factor(&self, e: Expr<'_>, alone: bool) -> String {
        match e.view() {
            NodeView::Symbol(symbol) => {
                e.graph().with_symbol(symbol, |s| if self.latex() { s.latex.clone() } else { s.text.clone() })
            }
            NodeView::Call(function, argument) => {
                let name = match function {
                    Function::Sqrt if self.latex() => return format!("\\sqrt{{{}}}", self.sum(argument)),
                    Function::Abs if self.latex() => return format!("\\left|{}\\right|", self.sum(argument)),
                    Function::Signum if self.latex() => "operatorname{sgn}",
                    function => function.name(),
                };
                match (self.latex(), matches!(argument.view(), NodeView::Symbol(_))) {
                    (true, true) => format!("\\{name} {}", self.sum(argument)),
                    (true, false) => format!("\\{name}\\left({}\\right)", self.sum(argument)),
                    (false, _) => format!("{name}({})", self.sum(argument)),
                }
            }
            NodeView::Binary(function, a, b) => {
                let name = match (function, self.latex()) {
                    (BinaryFunction::Atan2, true) => "\\operatorname{atan2}",
                    (BinaryFunction::Min, true) => "\\min",
                    (BinaryFunction::Max, true) => "\\max",
                    (function, false) => function.name(),
                };
                let (open, close) = if self.latex() { ("\\left(", "\\right)") } else { ("(", ")") };
                format!("{name}{open}{}, {}{close}", self.sum(a), self.sum(b))
            }
            NodeView::Number(value) => self.number(&value),
            NodeView::Group(inner) | NodeView::Opaque(inner) if !matches!(inner.view(), NodeView::Sum(_)) => {
                self.factor(inner, alone)
            }
            _ if alone => self.sum(e),
            _ if self.latex() => format!("\\left({}\\right)", self.sum(e)),
            _ => format!("({})", self.sum(e)),
        }
    }

    fn number(&self, value: &Rational) -> String {
        match self.fraction(*value) {
            (numerator, None) => numerator,
            (numerator, Some(denominator)) if self.latex() => format!("\\frac{{{numerator}}}{{{denominator}}}"),
            (numerator, Some(denominator)) => format!("{numerator}/{denominator}"),
        }
    }

    /// Numerator and denominator, if that is not one; fractions that nobody would read as numbers in double precision.
    fn fraction(&self, value: Rational) -> (String, Option<String>) {
        let Some((numerator, denominator)) = value.parts() else { return (decimal(value, self.notation), None) };
        (numerator.to_string(), (denominator != 1).then(|| denominator.to_string()))
    }
}

fn ungrouped(e: Expr<'_>) -> Expr<'_> {
    match e.view() {
        NodeView::Group(inner) => inner,
        _ => e,
    }
}

fn is_difference(e: Expr<'_>) -> bool {
    match ungrouped(e).view() {
        NodeView::Sum(terms) => {
            terms.iter().any(|(c, _)| c.is_negative()) && terms.iter().any(|(c, _)| !c.is_negative())
        }
        _ => false,
    }
}
