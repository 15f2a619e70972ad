//! Expressions without a value, whatever the state and the parameters are: mistakes of the user that only algebra sees.

use proc_macro2::Span;

use crate::algebra::{Evaluation, Expr, Map, NodeView, Number, Precise, Rational, Scalar};
use crate::error::{Mistakes, Result};
use crate::model::{Expression, FunctionName, LARGEST_EXPONENT, too_many_factors};

use super::translator::Translator;

/// Terms up to which a divisor is multiplied out to see whether it vanishes.
const LIMIT: usize = 100;

/// Beyond, fourth powers are longer than 256 binary digits.
const EXTREME: f64 = 1e19;

impl<'g> Translator<'_, 'g> {
    /// Checks a divisor; if it is always zero, the mistake is noted and one stands in its place.
    pub(super) fn divisor(&self, value: Expr<'g>, span: Span) -> Expr<'g> {
        if !self.vanishes(value) {
            return value;
        }
        self.mistake(span, "division by zero: this is always zero".to_owned())
    }

    /// The argument of a function that has none everywhere.
    pub(super) fn in_domain(&self, function: FunctionName, argument: Expr<'g>, span: Span) -> Expr<'g> {
        let found = match self.known(argument) {
            Some(value) => value.to_f64(),
            None if self.vanishes(argument) => 0.0,
            None => return argument,
        };
        match function {
            FunctionName::Ln if found <= 0.0 => {
                self.mistake(span, format!("the argument of `ln` must be positive, found {found}"))
            }
            FunctionName::Sqrt if found < 0.0 => {
                self.mistake(span, format!("the argument of `sqrt` must be zero or more, found {found}"))
            }
            FunctionName::Powf if found < 0.0 => {
                self.mistake(span, format!("the base of `powf` must be zero or more, found {found}; write `powi`"))
            }
            FunctionName::Asin | FunctionName::Acos if found.abs() > 1.0 => {
                let word = if function == FunctionName::Asin { "asin" } else { "acos" };
                self.mistake(span, format!("the argument of `{word}` lies between -1 and 1, found {found}"))
            }
            _ => argument,
        }
    }

    /// The ordinate of an angle; the angle of the point (0, 0) is undetermined.
    pub(super) fn ordinate(&self, [y, x]: [Expr<'g>; 2], span: Span) -> Expr<'g> {
        if !(self.vanishes(y) && self.vanishes(x)) {
            return y;
        }
        self.mistake(span, "both arguments of `atan2` are always zero, and that point has no angle".to_owned())
    }

    /// Whether what has mass stays at a center of attraction, from which it is `arm` away; that is noted.
    pub(super) fn stays_at(&self, arm: &[Expr<'g>; 3], span: Span) -> bool {
        let stays = arm.iter().all(|e| self.vanishes(*e));
        if stays {
            let message = "something with mass stays at the center, where the attraction is infinite; say where the center \
                           is: `center = […]`";
            self.mistake(span, message.to_owned());
        }
        stays
    }

    /// The width of a smooth step.
    pub(super) fn width(&self, value: Expr<'g>, span: Span) -> Expr<'g> {
        if !self.vanishes(value) {
            return value;
        }
        self.mistake(span, "a smooth step has two ends, and these are the same; write different numbers".to_owned())
    }

    /// A number that literals alone determine, arithmetic with which should stay in range; a power of not too many
    /// factors.
    pub(super) fn in_range(&self, value: Expr<'g>, written: &Expression) -> Expr<'g> {
        if value.largest_exponent() > LARGEST_EXPONENT {
            return self.mistake(written.span, too_many_factors());
        }
        let of_literals = || written.is_made_of_literals();
        // Too large, or so small that nothing is left of it.
        let out_of_range = |rounded: f64, zero: bool| !rounded.is_finite() || (rounded == 0.0 && !zero);
        let lost = match value.as_number() {
            Some(number) => {
                self.note_extreme(number, written.span);
                out_of_range(number.to_f64(), number.is_zero())
            }
            None => {
                let lost = |value: Precise| out_of_range(value.to_f64(), value == Precise::number(0.0));
                match of_literals() {
                    true => self.known(value).is_some_and(lost),
                    // Each number by itself is in range: only extreme ones can leave it together.
                    false => !self.notes.read().extreme.is_empty() && self.factors(value).into_iter().any(lost),
                }
            }
        };
        if !lost {
            return value;
        }
        self.mistake(written.span, "this number is beyond the range of double precision".to_owned())
    }

    /// Product of the factors that literals alone determine, for every term.
    fn factors(&self, value: Expr<'g>) -> Vec<Precise> {
        let terms = match value.view() {
            NodeView::Sum(terms) => terms,
            _ => vec![(Rational::one(), value)],
        };
        let of_term = |(coefficient, term): (Rational, Expr<'g>)| {
            let factors = match term.view() {
                NodeView::Product(factors) => factors,
                _ => vec![(term, 1)],
            };
            let known = factors.into_iter().filter_map(|(factor, power)| self.known(factor.powi(power)));
            known.fold(Precise::fraction(coefficient), |product, factor| product * factor)
        };
        terms.into_iter().map(of_term).collect()
    }

    /// Notes a number whose powers may be out of the reach of checks.
    pub(super) fn note_extreme(&self, value: Rational, span: Span) {
        let size = value.to_f64().abs();
        if value.is_zero() || (1.0 / EXTREME..=EXTREME).contains(&size) {
            return;
        }
        let mut notes = self.notes.add();
        if !notes.extreme.iter().any(|(_, known)| *known == value) {
            notes.extreme.push((span, value));
        }
    }

    /// Notes that an element has no value whatever the state is.
    pub(super) fn divides_by_zero(&self, span: Span, name: &str) {
        self.mistake(
            span,
            format!("`{name}` divides by zero wherever the system is: a distance or a number in it is always zero"),
        );
    }

    /// All mistakes so far.
    ///
    /// # Errors
    /// Each at the expression that has no value.
    pub(super) fn refuse_mistakes(&self) -> Result<()> {
        let mut mistakes = Mistakes::default();
        self.notes.read().mistakes.iter().for_each(|(span, message)| mistakes.push(*span, message.clone()));
        mistakes.finish()
    }

    pub(super) fn mistake(&self, span: Span, message: String) -> Expr<'g> {
        let mut notes = self.notes.add();
        // Expressions with a name are translated where the name stands.
        let place = |span: Span| format!("{span:?}");
        if !notes.mistakes.iter().any(|(known, text)| place(*known) == place(span) && *text == message) {
            notes.mistakes.push((span, message));
        }
        self.graph.one()
    }

    pub(super) fn vanishes(&self, value: Expr<'g>) -> bool {
        let multiplied_out = || value.expand(LIMIT).is_some_and(|sum| sum.len() == 0);
        let of_literals = || self.known(value).is_some_and(|value| value == Precise::number(0.0));
        value.is_zero() || (!self.is_clear_of_zero(value) && (of_literals() || multiplied_out()))
    }

    /// Whether it is a number and not nearly zero at some state; most divisors are, and need not be looked into.
    fn is_clear_of_zero(&self, value: Expr<'g>) -> bool {
        let symbols = self.graph.symbol_keys().into_iter().enumerate();
        // Multiples of the golden ratio are spread evenly and never equal.
        let at = |k: usize| 0.5 + (k as f64 * 0.618_033_988_749_894_9).fract();
        let mut point: Map<u32, f64> = symbols.map(|(k, key)| (key, at(k))).collect();
        point.extend(self.notes.read().literals.iter().map(|(value, symbol)| (symbol.key(), value.to_f64())));
        let value = Evaluation::new(&point).value(value);
        value.is_finite() && value.abs() > 1e-6
    }

    /// The value of what literals alone determine.
    pub(super) fn known(&self, value: Expr<'g>) -> Option<Precise> {
        value_of_literals(value, &self.notes.read().literals)
    }
}

/// The value of what literals alone determine.
pub(super) fn value_of_literals<'g, N: Number>(value: Expr<'g>, literals: &[(Rational, Expr<'g>)]) -> Option<N> {
    if value.as_number().is_none() && !value.is_constant() {
        return None;
    }
    let literals = literals.iter().map(|(value, symbol)| (symbol.key(), N::fraction(*value))).collect();
    // Symbols without a value make it undefined.
    Some(Evaluation::of_known(&literals).value(value)).filter(|value: &N| value.is_finite())
}
