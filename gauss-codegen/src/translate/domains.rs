//! Expressions without a value, whatever the state and the parameters are: mistakes of the user that only algebra sees.

use proc_macro2::Span;

use crate::algebra::{Evaluation, Expr, Map, Number, Precise, Scalar};
use crate::mistakes::Mistakes;
use crate::model::{Expression, FunctionName, LARGEST_EXPONENT, too_many_factors};

use super::Translator;

/// Terms up to which a divisor is multiplied out to see whether it vanishes.
const LIMIT: usize = 100;

impl<'g> Translator<'_, 'g> {
    /// What is divided by; if that is always zero, the mistake is noted and one stands in its place.
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

    /// A number that literals alone determine, arithmetic with which should stay in range; a power of not too many factors.
    pub(super) fn in_range(&self, value: Expr<'g>, written: &Expression) -> Expr<'g> {
        if value.largest_exponent() > LARGEST_EXPONENT {
            return self.mistake(written.span, too_many_factors());
        }
        let of_literals = || written.is_made_of_literals();
        let lost = match value.as_number() {
            Some(number) => !number.to_f64().is_finite(),
            None => of_literals() && self.known(value).is_some_and(|value| !value.to_f64().is_finite()),
        };
        if !lost {
            return value;
        }
        self.mistake(written.span, "this number is beyond the range of double precision".to_owned())
    }

    /// All mistakes so far.
    ///
    /// # Errors
    /// Each at the expression that has no value.
    pub fn refuse_mistakes(&self) -> syn::Result<()> {
        let mut mistakes = Mistakes::default();
        self.mistakes.borrow().iter().for_each(|(span, message)| mistakes.push(*span, message.clone()));
        mistakes.finish()
    }

    fn mistake(&self, span: Span, message: String) -> Expr<'g> {
        let mut mistakes = self.mistakes.borrow_mut();
        // Expressions with a name are translated where the name stands.
        let place = |span: Span| format!("{span:?}");
        if !mistakes.iter().any(|(known, text)| place(*known) == place(span) && *text == message) {
            mistakes.push((span, message));
        }
        self.graph.one()
    }

    fn vanishes(&self, value: Expr<'g>) -> bool {
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
        point.extend(self.literals.borrow().iter().map(|(value, symbol)| (symbol.key(), value.to_f64())));
        let value = Evaluation::new(&point).value(value);
        value.is_finite() && value.abs() > 1e-6
    }

    /// The value of what literals alone determine.
    fn known(&self, value: Expr<'g>) -> Option<Precise> {
        if value.as_number().is_none() && !value.is_constant() {
            return None;
        }
        let literals = self.literals.borrow();
        let literals = literals.iter().map(|(value, symbol)| (symbol.key(), Precise::fraction(*value))).collect();
        // Symbols without a value make it undefined.
        Some(Evaluation::of_known(&literals).value(value)).filter(|value: &Precise| value.is_finite())
    }
}
