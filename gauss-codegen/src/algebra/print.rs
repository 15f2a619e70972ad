//! Expressions for people: plain text and LaTeX.

use std::fmt;

use crate::algebra::expressions::function::{BinaryFunction, Function, OwnFunction};
use crate::algebra::expressions::graph::{Expr, Graph, NodeView};
use crate::algebra::parts::{Parts, leaves_of};
use crate::algebra::rational::Rational;

/// Ways to write expressions.
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
    Printer::new(notation, &Parts::default()).sum(e)
}

/// The same, if no more than so many numbers, symbols and functions are written: what has parts in common may be
/// doubled by each function that it is within.
pub fn print_short(e: Expr<'_>, notation: Notation, leaves: u64) -> Option<String> {
    (leaves_of(e) <= leaves).then(|| print(e, notation))
}

/// The same as [`print`]; what is long, with names in the place of parts.
pub fn print_with<'g>(e: Expr<'g>, notation: Notation, parts: &Parts<'g>) -> String {
    if !parts.is_long(e) {
        return print(e, notation);
    }
    Printer::new(notation, parts).sum(e)
}

/// Writes a definition in terms of other parts.
pub fn print_definition<'g>(e: Expr<'g>, notation: Notation, parts: &Parts<'g>) -> String {
    if !parts.is_long(e) {
        return print(e, notation);
    }
    joined(Printer::new(notation, parts).terms_of(e))
}

/// Writes the expression that each numbered name stands for, in an order in which every one is made of those before it.
pub fn print_parts(notation: Notation, parts: &Parts<'_>) -> Vec<(String, String)> {
    let printer = Printer::new(notation, parts);
    let printed = |e: &Expr<'_>| Some((printer.name_of(*e)?, joined(printer.terms_of(*e))));
    parts.values().iter().filter_map(printed).collect()
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

/// Fractions with larger denominators are written as decimals, where these end after six places: 129/400 is 0.3225.
const LARGEST_DENOMINATOR: i64 = 12;
const PLACES: i64 = 1_000_000;

struct Printer<'a, 'g> {
    notation: Notation,
    parts: &'a Parts<'g>,
}

/// One printed term: its sign and its unsigned text.
struct Term {
    negative: bool,
    text: String,
}

/// Terms with their signs between them.
fn joined(terms: Vec<Term>) -> String {
    let mut out = String::new();
    for (k, term) in terms.into_iter().enumerate() {
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

impl<'a, 'g> Printer<'a, 'g> {
    fn new(notation: Notation, parts: &'a Parts<'g>) -> Self {
        Self { notation, parts }
    }

    fn latex(&self) -> bool {
        self.notation == Notation::Latex
    }

    fn name_of(&self, e: Expr<'g>) -> Option<String> {
        self.parts.name(e).map(|[text, latex]| if self.latex() { latex } else { text }.clone())
    }

    fn sum(&self, e: Expr<'g>) -> String {
        joined(self.terms(e))
    }

    fn terms(&self, e: Expr<'g>) -> Vec<Term> {
        match self.name_of(e) {
            Some(text) => vec![Term { negative: false, text }],
            None => self.terms_of(e),
        }
    }

    /// Terms of an expression itself, whatever its name.
    fn terms_of(&self, e: Expr<'g>) -> Vec<Term> {
        match e.view() {
            NodeView::Group(inner) | NodeView::Opaque(inner) => self.terms_of(inner),
            NodeView::Sum(terms) => {
                let mut printed: Vec<Term> = terms.into_iter().map(|(c, e)| self.term(c, self.factors(e))).collect();
                // A positive term first where there is one: `a - b` rather than `-b + a`.
                if printed[0].negative
                    && let Some(k) = printed.iter().position(|t| !t.negative)
                {
                    let first = printed.remove(k);
                    printed.insert(0, first);
                }
                printed
            }
            NodeView::Product(factors) => vec![self.term(Rational::one(), factors)],
            // Its name, if it has one, is what it is printed for.
            NodeView::Call(..) | NodeView::Binary(..) | NodeView::Own(..) => {
                vec![Term { negative: false, text: self.unnamed_factor(e, true) }]
            }
            _ => vec![self.term(Rational::one(), vec![(e, 1)])],
        }
    }

    /// Factors of a term.
    fn factors(&self, e: Expr<'g>) -> Vec<(Expr<'g>, i32)> {
        match e.view() {
            NodeView::Product(factors) if self.parts.name(e).is_none() => factors,
            _ => vec![(e, 1)],
        }
    }

    fn term(&self, coefficient: Rational, factors: Vec<(Expr<'g>, i32)>) -> Term {
        let negative = coefficient.is_negative();
        let coefficient = coefficient.abs();
        let (mut above, mut below) = (Vec::new(), Vec::new());
        if let [(e, 1)] = factors.as_slice()
            && let Some(value) = e.as_number()
        {
            let text = self.number(&(value.abs() * coefficient));
            return Term { negative: negative != value.is_negative(), text };
        }
        // Constants first, as in a textbook: (I2 - I3)*w2*w3.
        let (mut factors, varying): (Vec<_>, Vec<_>) = factors.into_iter().partition(|(e, _)| e.is_constant());
        factors.extend(varying);
        // A difference takes the sign of its term in: (I3 - I1)*w1*w3 rather than -(I1 - I3)*w1*w3.
        let mut negative = negative;
        let turned = |(e, n): &(Expr<'g>, i32)| *n == 1 && self.parts.name(*e).is_none() && is_difference(*e);
        if negative && let Some(factor) = factors.iter_mut().find(|factor| turned(factor)) {
            factor.0 = -ungrouped(factor.0);
            negative = false;
        }
        let single = factors.len() == 1 && coefficient.is_one();
        // A sum that is all of a numerator or a denominator has no brackets there.
        let count = |sign: i32| factors.iter().filter(|(_, n)| n.signum() == sign).count();
        let [above_alone, below_alone] = [1, -1].map(|sign| self.latex() && count(sign) == 1);
        let (units, parts) = (self.fraction(coefficient), count(-1));
        let above_alone = above_alone && units.0 == "1" && (parts > 0 || units.1.is_some());
        let below_alone = below_alone && units.1.is_none();
        for (factor, exponent) in factors {
            let alone = if exponent > 0 { above_alone } else { below_alone };
            let radicand = (alone && exponent.abs() == 2).then(|| self.radicand(factor)).flatten();
            let power = match (exponent.abs(), radicand) {
                (1, _) => self.factor(factor, alone || single && exponent == 1),
                (_, Some(inner)) => self.factor(inner, true),
                (n, None) => self.power(factor, n),
            };
            if exponent > 0 { above.push(power) } else { below.push(power) }
        }
        let (numerator, denominator) = units;
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

    /// Radicand of an expression that is a root.
    fn radicand(&self, e: Expr<'g>) -> Option<Expr<'g>> {
        match visible(e).view() {
            NodeView::Call(Function::Sqrt, inner) if self.name_of(e).is_none() => Some(inner),
            _ => None,
        }
    }

    /// eⁿ for n > 1. Powers of functions stand between name and argument, sin² θ; even ones of roots are powers.
    fn power(&self, e: Expr<'g>, n: i32) -> String {
        if n % 2 == 0
            && let Some(inner) = self.radicand(e)
        {
            return if n == 2 { self.factor(inner, false) } else { self.power(inner, n / 2) };
        }
        if !self.latex() {
            return format!("{}^{n}", self.factor(e, false));
        }
        if let Some(name) = self.name_of(e) {
            return format!("{name}^{{{n}}}");
        }
        match visible(e).view() {
            NodeView::Call(function, argument) => self.call(function, argument, &format!("^{{{n}}}")),
            NodeView::Binary(..) => format!("\\left({}\\right)^{{{n}}}", self.factor(e, false)),
            NodeView::Own(function, arguments) => self.own(e.graph(), function, &arguments, &format!("^{{{n}}}")),
            NodeView::Symbol(symbol) => e.graph().with_symbol(symbol, |s| {
                // Sine and cosine of an angle can be symbols.
                let turn = ["\\cos", "\\sin"].iter().find_map(|name| Some((name, s.latex.strip_prefix(name)?)));
                turn.map_or_else(|| format!("{}^{{{n}}}", s.latex), |(name, angle)| format!("{name}^{{{n}}}{angle}"))
            }),
            _ => format!("{}^{{{n}}}", self.factor(e, false)),
        }
    }

    /// A function in LaTeX, raised to a power that may be empty.
    fn call(&self, function: Function, argument: Expr<'g>, power: &str) -> String {
        let inner = self.sum(argument);
        match function {
            Function::Sqrt => format!("\\sqrt{{{inner}}}{power}"),
            Function::Abs => format!("\\left|{inner}\\right|{power}"),
            function => {
                let name = if function == Function::Signum { "operatorname{sgn}" } else { function.name() };
                match argument.view() {
                    NodeView::Symbol(_) => format!("\\{name}{power} {inner}"),
                    _ => format!("\\{name}{power}\\left({inner}\\right)"),
                }
            }
        }
    }

    /// A function of the user's own, raised to a power that may be empty. A prime stands for each derivative by the
    /// only variable; of several variables the orders by each follow the name, in LaTeX as f⁽¹′⁰⁾.
    fn own(&self, graph: &Graph, function: OwnFunction, arguments: &[Expr<'g>], power: &str) -> String {
        let name = graph.function_name(function);
        let arguments: Vec<String> = arguments.iter().map(|argument| self.sum(*argument)).collect();
        let arguments = arguments.join(", ");
        let (suffix, several) = (function.suffix(), function.variables > 1);
        let primes = if several { String::new() } else { "'".repeat(function.order().into()) };
        if !self.latex() {
            return format!("{name}{}({arguments})", if several { suffix } else { primes });
        }
        let name = format!("\\operatorname{{{}}}", name.replace('_', "\\_"));
        let arguments = format!("\\left({arguments}\\right)");
        if !several || suffix.is_empty() {
            return format!("{name}{primes}{power}{arguments}");
        }
        let orders = suffix.trim_start_matches('_').replace('_', ", ");
        let value = format!("{name}^{{({orders})}}{arguments}");
        if power.is_empty() { value } else { format!("\\left({value}\\right){power}") }
    }

    fn factor(&self, e: Expr<'g>, alone: bool) -> String {
        if let Some(name) = self.name_of(e) {
            return name;
        }
        self.unnamed_factor(e, alone)
    }

    fn unnamed_factor(&self, e: Expr<'g>, alone: bool) -> String {
        match e.view() {
            NodeView::Symbol(symbol) => {
                e.graph().with_symbol(symbol, |s| if self.latex() { s.latex.clone() } else { s.text.clone() })
            }
            NodeView::Call(function, argument) if self.latex() => self.call(function, argument, ""),
            NodeView::Call(function, argument) => format!("{}({})", function.name(), self.sum(argument)),
            NodeView::Binary(BinaryFunction::Powf, base, exponent) if self.latex() => {
                let base = match visible(base).view() {
                    NodeView::Symbol(_) => self.factor(base, false),
                    _ => format!("\\left({}\\right)", self.sum(base)),
                };
                format!("{base}^{{{}}}", self.sum(exponent))
            }
            NodeView::Binary(BinaryFunction::Atan2, y, x) if arc(y, x).is_some() => {
                let (name, argument) = arc(y, x).unwrap_or(("arctan", y));
                match self.latex() {
                    true => format!("\\{name}\\left({}\\right)", self.sum(argument)),
                    false => format!("{}({})", name.replace("arc", "a"), self.sum(argument)),
                }
            }
            NodeView::Binary(function, a, b) => {
                let name = match (function, self.latex()) {
                    (BinaryFunction::Atan2, true) => "\\operatorname{atan2}",
                    (BinaryFunction::Min, true) => "\\min",
                    (BinaryFunction::Max, true) => "\\max",
                    (BinaryFunction::Powf, true) => "\\operatorname{powf}",
                    (function, false) => function.name(),
                };
                let (open, close) = if self.latex() { ("\\left(", "\\right)") } else { ("(", ")") };
                format!("{name}{open}{}, {}{close}", self.sum(a), self.sum(b))
            }
            NodeView::Own(function, arguments) => self.own(e.graph(), function, &arguments, ""),
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
        if denominator > LARGEST_DENOMINATOR && PLACES % denominator == 0 {
            return (decimal(value, self.notation), None);
        }
        (numerator.to_string(), (denominator != 1).then(|| denominator.to_string()))
    }
}

/// The angle of the point (x, y) as an inverse function of one number.
fn arc<'g>(y: Expr<'g>, x: Expr<'g>) -> Option<(&'static str, Expr<'g>)> {
    match () {
        () if x == y.graph().one() => Some(("arctan", y)),
        () if x == y.leg() => Some(("arcsin", y)),
        () if y == x.leg() => Some(("arccos", x)),
        () => None,
    }
}

/// The expression as a reader sees it: brackets stand around sums alone.
fn visible(e: Expr<'_>) -> Expr<'_> {
    match e.view() {
        NodeView::Group(inner) | NodeView::Opaque(inner) if !matches!(inner.view(), NodeView::Sum(_)) => visible(inner),
        _ => e,
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
