//! Expressions without a value, whatever the state and the parameters are: mistakes of the user that only algebra sees.

use proc_macro2::Span;

use crate::algebra::{Evaluation, Expr, Map, NodeView, Notation, Number, Precise, Rational, Scalar as _, decimal};
use crate::kernel::Kernel;
use crate::mechanics::{Body, Tree};
use crate::mistakes::Mistakes;
use crate::model::{Expression, FunctionName, LARGEST_EXPONENT, Role, Scalar, too_many_factors};
use crate::program::{Instruction, Operand};

use super::Translator;

/// Terms up to which a divisor is multiplied out to see whether it vanishes.
const LIMIT: usize = 100;

/// Beyond, fourth powers are longer than 256 binary digits.
const EXTREME: f64 = 1e19;

/// Whether a symmetric matrix has a negative eigenvalue: one of its principal minors is negative.
fn is_indefinite(a: &[[Precise; 3]; 3]) -> bool {
    let pairs = [(0, 1), (0, 2), (1, 2)];
    let minor = |(i, j): (usize, usize)| a[i][i] * a[j][j] - a[i][j] * a[j][i];
    let cofactor = |k: usize| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        a[1][i] * a[2][j] - a[1][j] * a[2][i]
    };
    let determinant = (0..3).fold(Precise::number(0.0), |sum, k| sum + a[0][k] * cofactor(k));
    let size = (0..3).map(|i| a[i][i].to_f64().abs()).fold(0.0, f64::max);
    // Rods have a moment of zero: beside the roundings of 256 digits that is far below this.
    let negative = |minor: Precise, power: i32| minor.to_f64() < -1e-50 * size.powi(power);
    (0..3).any(|i| negative(a[i][i], 1))
        || pairs.into_iter().any(|pair| negative(minor(pair), 2))
        || negative(determinant, 3)
}

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
                    false => !self.extreme.borrow().is_empty() && self.factors(value).into_iter().any(lost),
                }
            }
        };
        if !lost {
            return value;
        }
        self.mistake(written.span, "this number is beyond the range of double precision".to_owned())
    }

    /// Of every term the product of what literals alone determine in it.
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

    /// Constants of the equations that are beyond the range of the scalar although the numbers that they are made of are
    /// not: nothing, or infinity, would stand in their place.
    ///
    /// # Errors
    /// The first of the extreme numbers, or the name of the struct where there are none.
    pub fn refuse_lost(&self, kernel: &Kernel<'g>) -> syn::Result<()> {
        let single = matches!(self.model.scalar, Scalar::F32);
        let [least, most] = match single {
            true => [f32::MIN_POSITIVE, f32::MAX].map(f64::from),
            false => [f64::MIN_POSITIVE, f64::MAX],
        };
        let is_lost = |value: f64| !(least..=most).contains(&value.abs());
        let has_extreme = !self.extreme.borrow().is_empty();
        // Zero, too small or too large.
        let suspicious = kernel.known_constants.iter().zip(&kernel.folded).filter(|((_, found), _)| is_lost(*found));
        let of_literals = suspicious.map(|(_, (_, definition))| self.known(*definition)).any(|exact| {
            let exact = exact.filter(|exact| *exact != Precise::number(0.0));
            // Among usual numbers a zero is what rounding left of a difference; among extreme ones a product may be lost.
            exact.is_some_and(|exact| is_lost(exact.to_f64()) || has_extreme)
        });
        let programs = kernel.written();
        let in_programs = || {
            let mut operands = programs.flat_map(|program| &program.instructions).flat_map(Instruction::operands);
            operands.any(|operand| matches!(operand, Operand::Number(n) if !n.is_zero() && is_lost(n.to_f64())))
        };
        if !of_literals && !in_programs() {
            return Ok(());
        }
        let extreme = self.extreme.borrow();
        let span = extreme.first().map_or(self.model.ident.span(), |(span, _)| *span);
        let of = extreme.first().map(|(_, value)| format!(" with `{}`", decimal(*value, Notation::Text)));
        let (of, precision) = (of.unwrap_or_default(), if single { "single" } else { "double" });
        let message = format!(
            "a constant of the equations{of} is beyond the range of {precision} precision; choose units in which the numbers \
             are nearer to 1"
        );
        Err(syn::Error::new(span, message))
    }

    /// Notes a number whose powers may be out of the reach of checks.
    pub(super) fn note_extreme(&self, value: Rational, span: Span) {
        let size = value.to_f64().abs();
        if value.is_zero() || (1.0 / EXTREME..=EXTREME).contains(&size) {
            return;
        }
        let mut extreme = self.extreme.borrow_mut();
        if !extreme.iter().any(|(_, known)| *known == value) {
            extreme.push((span, value));
        }
    }

    /// Why a check fails that no mistake of this crate makes fail: bodies that none can be, numbers out of its reach.
    pub fn cause_of_failure(&self, tree: &Tree<'g>) -> Option<syn::Error> {
        self.impossible_body(tree).or_else(|| {
            let extreme = self.extreme.borrow();
            let (span, _) = extreme.first()?;
            let list: Vec<String> =
                extreme.iter().map(|(_, value)| format!("`{}`", decimal(*value, Notation::Text))).collect();
            let (are, they) = if list.len() == 1 { ("is", "it is") } else { ("are", "they are") };
            Some(syn::Error::new(
                *span,
                format!(
                    "{} {are} out of reach: not even numbers of 256 binary digits tell whether the equations are right; \
                     choose units in which {they} nearer to 1",
                    list.join(", ")
                ),
            ))
        })
    }

    /// A body whose mass data are literals and that has a negative moment of inertia about its centre of mass.
    fn impossible_body(&self, tree: &Tree<'g>) -> Option<syn::Error> {
        let clauses = self.model.bodies.iter().zip(&self.links_of_clauses);
        let (clause, _) = clauses.into_iter().find(|(_, link)| {
            let body = tree.links.get(**link).and_then(|link| link.body());
            body.and_then(|body| self.central_moments(body)).is_some_and(|moments| is_indefinite(&moments))
        })?;
        let own = if clause.name.is_some() { &clause.role_clauses } else { &self.model.role_clauses };
        let inertia = own.iter().find(|own| matches!(own.role, Role::Inertia | Role::CentralInertia));
        let (span, word) = inertia.map_or((clause.span, Role::Inertia.word()), |own| (own.span, own.role.word()));
        let rule = match word == Role::CentralInertia.word() {
            true => String::new(),
            false => format!(
                "; `{word}` is about O, m (|c|² 1 − c cᵀ) more; what is about the centre of mass is written \
                 `{}`",
                Role::CentralInertia.word()
            ),
        };
        let message =
            format!("no body has this `{word}`: about its centre of mass a moment of inertia is negative{rule}");
        Some(syn::Error::new(span, message))
    }

    /// I_O − m(|c|² 1 − c cᵀ), where literals alone determine it.
    fn central_moments(&self, body: &Body<'g>) -> Option<[[Precise; 3]; 3]> {
        let mass = self.known(body.mass)?;
        let mut center = [Precise::number(0.0); 3];
        for (value, e) in center.iter_mut().zip(body.center_of_mass) {
            *value = self.known(e)?;
        }
        let square = center.iter().fold(Precise::number(0.0), |sum, c| sum + *c * *c);
        let mut moments = [[Precise::number(0.0); 3]; 3];
        for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
            let own = if i == j { square } else { Precise::number(0.0) };
            moments[i][j] = self.known(body.inertia[i][j])? - mass * (own - center[i] * center[j]);
        }
        Some(moments)
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
