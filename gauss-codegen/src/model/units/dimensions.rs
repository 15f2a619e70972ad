//! Dimensions of expressions, as far as they follow from the units of fields and inputs, from roles, from `t` in s, and
//! from the positions and velocities of bodies. A scene in which no unit is written is not checked.
//!
//! What has no unit, such as scalar coordinates and speeds, agrees with everything, and so does its product with
//! anything. A literal agrees with everything too, in a sum or alone; as a factor it has no dimension, unless it is
//! zero.

use std::collections::HashMap;

use super::need::{ANGLE, ANGULAR_VELOCITY, FORCE, LENGTH, Need, TORQUE, VELOCITY};
use crate::algebra::Rational;
use crate::model::language::context::Context;
use crate::model::language::units::Dimension;
use crate::model::language::words::{same, word};
use crate::model::scene::expression::{BinaryOperator, Expression, ExpressionKind, FunctionName, Property};
use proc_macro2::{Ident, Span};

/// Knowledge of the dimension of a number.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum InferredDimension {
    Unknown,
    /// It is zero, of any dimension, and makes products zero.
    Zero,
    /// It is made of literals.
    Number,
    Known(Dimension),
}

/// Knowledge of the dimensions of a value: of a vector component by component, of a scalar three times the same.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Dimensions {
    Rotation,
    Parts([InferredDimension; 3]),
}

impl InferredDimension {
    fn times(self, other: InferredDimension) -> InferredDimension {
        match (self, other) {
            (InferredDimension::Zero, _) | (_, InferredDimension::Zero) => InferredDimension::Zero,
            (InferredDimension::Unknown, _) | (_, InferredDimension::Unknown) => InferredDimension::Unknown,
            (InferredDimension::Number, other) | (other, InferredDimension::Number) => other,
            (InferredDimension::Known(a), InferredDimension::Known(b)) => InferredDimension::known(a.times(b)),
        }
    }

    fn known(dimension: Option<Dimension>) -> InferredDimension {
        dimension.map_or(InferredDimension::Unknown, InferredDimension::Known)
    }

    fn change(self, change: impl Fn(Dimension) -> Option<Dimension>) -> InferredDimension {
        match self {
            InferredDimension::Known(dimension) => InferredDimension::known(change(dimension)),
            other => other,
        }
    }

    /// Dimension of a number without dimension that is made of this one.
    fn without_dimension(self) -> InferredDimension {
        match self {
            InferredDimension::Zero | InferredDimension::Number => InferredDimension::Number,
            InferredDimension::Unknown | InferredDimension::Known(_) => InferredDimension::Known(Dimension::NONE),
        }
    }
}

impl Dimensions {
    pub const UNKNOWN: Dimensions = Dimensions::all(InferredDimension::Unknown);

    const fn all(found: InferredDimension) -> Dimensions {
        Dimensions::Parts([found; 3])
    }

    pub fn of(dimension: Dimension) -> Dimensions {
        Dimensions::all(InferredDimension::Known(dimension))
    }

    pub fn parts(self) -> [InferredDimension; 3] {
        match self {
            Dimensions::Rotation => [InferredDimension::Known(Dimension::NONE); 3],
            Dimensions::Parts(parts) => parts,
        }
    }

    fn change(self, change: impl Fn(InferredDimension) -> InferredDimension) -> Dimensions {
        Dimensions::Parts(self.parts().map(change))
    }
}

pub struct UnitChecker<'a> {
    /// Units as they are written, of names.
    pub units: Vec<(&'a Ident, &'a str)>,
    pub names: HashMap<String, Dimensions>,
    /// The dimension of a number that is written: those of a file are in units of the SI, which need not be said.
    pub number: InferredDimension,
    pub context: &'a mut Context,
}

impl UnitChecker<'_> {
    pub fn add(&mut self, name: &Ident, value: Dimensions) {
        self.name_as(word(name), value);
    }

    /// `in N`, `in rad (dimensionless)`, `dimensionless`.
    pub fn unit(&self, expression: &Expression, dimension: Dimension) -> String {
        match self.written(expression) {
            Some(unit) if dimension == Dimension::NONE && unit != "1" => format!("in {unit} (dimensionless)"),
            _ if dimension == Dimension::NONE => "dimensionless".into(),
            Some(unit) => format!("in {unit}"),
            None => format!("in {dimension}"),
        }
    }

    /// The unit of a name as it is written.
    pub fn written(&self, expression: &Expression) -> Option<&str> {
        match &expression.kind {
            ExpressionKind::Name(name) => self.units.iter().find(|(known, _)| same(known, name)).map(|(_, unit)| *unit),
            ExpressionKind::Component(inner, _) | ExpressionKind::Negate(inner) => self.written(inner),
            _ => None,
        }
    }

    /// The one dimension of several values, component by component; that they have several is noted once, with `what`
    /// they are and why they have one.
    fn agree(&mut self, span: Span, values: &[(&Expression, Dimensions)], what: &str, why: &str) -> Dimensions {
        let mut common = [InferredDimension::Zero; 3];
        for (index, common) in common.iter_mut().enumerate() {
            let mut first: Option<(&Expression, Dimension)> = None;
            for &(expression, value) in values {
                match (value.parts()[index], first) {
                    (InferredDimension::Known(found), None) => first = Some((expression, found)),
                    (InferredDimension::Known(found), Some((earlier, expected))) if found != expected => {
                        let message = self.disagreement([(earlier, expected), (expression, found)], what, why);
                        self.context.error(span, message);
                        return Dimensions::UNKNOWN;
                    }
                    (InferredDimension::Unknown, _) => *common = InferredDimension::Unknown,
                    (InferredDimension::Number, _) if *common == InferredDimension::Zero => {
                        *common = InferredDimension::Number
                    }
                    _ => {}
                }
            }
            if let Some((_, dimension)) = first {
                *common = InferredDimension::Known(dimension);
            }
        }
        Dimensions::Parts(common)
    }

    fn disagreement(&self, terms: [(&Expression, Dimension); 2], what: &str, why: &str) -> String {
        let shown = terms.map(|(expression, dimension)| {
            let unit = self.unit(expression, dimension);
            let unit = match unit.strip_prefix("in ") {
                // In brackets there are no brackets.
                Some(unit) => unit.split(" (").next().unwrap_or(unit).to_owned(),
                None => unit,
            };
            format!("{} ({unit})", subject(expression, "a"))
        });
        let [(_, first), (_, second)] = terms;
        let remedy = match first.over(second) {
            Some(coefficient) => format!("multiply the latter by a coefficient in {coefficient}"),
            None => "correct one of the two".into(),
        };
        format!("{what} {} and {}: {why}; {remedy}", shown[0], shown[1])
    }

    /// The dimensions of an expression. A mistake in a part is noted at the part, and not again at the expressions
    /// around it.
    pub fn value(&mut self, expression: &Expression) -> Dimensions {
        let earlier = self.context.count();
        let value = self.inferred(expression);
        if self.context.count() > earlier && value != Dimensions::Rotation { Dimensions::UNKNOWN } else { value }
    }

    fn inferred(&mut self, expression: &Expression) -> Dimensions {
        let span = expression.span;
        match &expression.kind {
            ExpressionKind::Number { .. } if expression.is_zero() => Dimensions::all(InferredDimension::Zero),
            ExpressionKind::Number { .. } => Dimensions::all(self.number),
            ExpressionKind::Name(name) => self.name(name),
            ExpressionKind::Input(_) => Dimensions::UNKNOWN,
            ExpressionKind::Horizontal(..) => Dimensions::of(LENGTH.1),
            ExpressionKind::Property(_, property) => property_value(*property),
            ExpressionKind::Component(inner, index) => {
                let parts = self.value(inner).parts();
                Dimensions::all(parts.get(*index).copied().unwrap_or(InferredDimension::Unknown))
            }
            ExpressionKind::Negate(inner) => self.value(inner),
            ExpressionKind::Binary(operator, left, right) => {
                let (a, b) = (self.value(left), self.value(right));
                let terms = [(&**left, a), (&**right, b)];
                match (operator, a, b) {
                    (BinaryOperator::Add, ..) => self.agree(span, &terms, "the sum of", "terms of a sum have one unit"),
                    (BinaryOperator::Subtract, ..) => {
                        self.agree(span, &terms, "the difference of", "the two sides of `-` have one unit")
                    }
                    (BinaryOperator::Multiply, Dimensions::Rotation, Dimensions::Rotation) => Dimensions::Rotation,
                    (BinaryOperator::Multiply, Dimensions::Rotation, turned) => self.turned(span, turned),
                    (BinaryOperator::Multiply, ..) => product(a, b),
                    (BinaryOperator::Divide, ..) => product(a, b.change(|part| part.change(|d| d.to_the(-1)))),
                }
            }
            ExpressionKind::Power(base, power) => {
                let base = self.value(base);
                base.change(|part| part.change(|dimension| dimension.to_the(*power)))
            }
            ExpressionKind::Call(FunctionName::Powf, arguments) => self.power(arguments),
            ExpressionKind::Call(function, arguments) => self.call(*function, arguments, span),
            // What units it takes and gives is the user's affair.
            ExpressionKind::Own(_, arguments) => {
                arguments.iter().for_each(|argument| _ = self.value(argument));
                Dimensions::UNKNOWN
            }
            ExpressionKind::Vector(components) => {
                let [x, y, z] = components;
                Dimensions::Parts([x, y, z].map(|component| self.value(component).parts()[0]))
            }
        }
    }

    /// A name with two meanings, which is noted elsewhere, has no dimension.
    pub fn name_as(&mut self, word: String, value: Dimensions) {
        self.names.entry(word).and_modify(|known| *known = Dimensions::UNKNOWN).or_insert(value);
    }

    fn name(&self, name: &Ident) -> Dimensions {
        self.names.get(&word(name)).copied().unwrap_or(Dimensions::UNKNOWN)
    }

    /// A vector whose components a rotation mixes.
    fn turned(&mut self, span: Span, value: Dimensions) -> Dimensions {
        let mut known = None;
        for part in value.parts() {
            match (part, known) {
                (InferredDimension::Known(found), Some(expected)) if found != expected => {
                    self.context.error(
                        span,
                        format!(
                            "a rotation mixes the components of a vector, and here one is in {expected} and another in \
                             {found}; give them one unit"
                        ),
                    );
                    return Dimensions::UNKNOWN;
                }
                (InferredDimension::Known(found), _) => known = Some(found),
                _ => {}
            }
        }
        let [x, y, z] = value.parts();
        known.map_or(if x == y && y == z { value } else { Dimensions::UNKNOWN }, Dimensions::of)
    }

    /// `powf(x, p)`: of a literal p that of a power, if it is whole; of any other a pure number.
    fn power(&mut self, arguments: &[Expression]) -> Dimensions {
        let [base, exponent] = arguments else { return Dimensions::UNKNOWN };
        let (value, of_exponent) = (self.value(base), self.value(exponent));
        let pure = |what: &str| Need::new(format!("{what} of `powf` is"), ("1", Dimension::NONE));
        self.compare(exponent, of_exponent, &pure("the exponent"));
        match exponent.number().map(Rational::to_f64) {
            // Halves, as of roots.
            Some(power) if f64::fract(2.0 * power) == 0.0 && power.abs() < 50.0 => value
                .change(|part| part.change(|dimension| dimension.to_the((2.0 * power) as i32)).change(Dimension::root)),
            _ => {
                self.compare(base, value, &pure("the base"));
                value.change(InferredDimension::without_dimension)
            }
        }
    }

    fn call(&mut self, function: FunctionName, arguments: &[Expression], span: Span) -> Dimensions {
        let values: Vec<Dimensions> = arguments.iter().map(|argument| self.value(argument)).collect();
        let all: Vec<(&Expression, Dimensions)> = arguments.iter().zip(values.iter().copied()).collect();
        let word = function.word();
        let first = values.first().copied().unwrap_or(Dimensions::UNKNOWN);
        let second = values.get(1).copied().unwrap_or(Dimensions::UNKNOWN);
        let angle = Need::new(format!("`{word}` takes angles"), ANGLE);
        match function {
            FunctionName::Sin | FunctionName::Cos | FunctionName::Tan => {
                all.iter().for_each(|(argument, value)| self.compare(argument, *value, &angle));
                first.change(InferredDimension::without_dimension)
            }
            FunctionName::RotationX | FunctionName::RotationY | FunctionName::RotationZ => {
                all.iter().for_each(|(argument, value)| self.compare(argument, *value, &angle));
                Dimensions::Rotation
            }
            FunctionName::Exp
            | FunctionName::Ln
            | FunctionName::Asin
            | FunctionName::Acos
            | FunctionName::Atan
            | FunctionName::Tanh => {
                let need = Need::new(format!("the argument of `{word}` is"), ("1", Dimension::NONE));
                all.iter().for_each(|(argument, value)| self.compare(argument, *value, &need));
                first.change(InferredDimension::without_dimension)
            }
            FunctionName::Powf => Dimensions::UNKNOWN,
            FunctionName::Sqrt => first.change(|part| part.change(Dimension::root)),
            FunctionName::Signum => first.change(InferredDimension::without_dimension),
            FunctionName::Abs | FunctionName::Inverse => first,
            FunctionName::Rate => first.change(|part| part.change(|dimension| dimension.over(Dimension::TIME))),
            FunctionName::Twist => Dimensions::UNKNOWN,
            FunctionName::Min | FunctionName::Max | FunctionName::Clamp | FunctionName::Hypot => {
                self.agree(span, &all, &format!("`{word}` of"), "its arguments have one unit")
            }
            FunctionName::Atan2 | FunctionName::SmoothStep => self
                .agree(span, &all, &format!("`{word}` of"), "its arguments have one unit")
                .change(InferredDimension::without_dimension),
            FunctionName::Dot => {
                let terms = product(first, second).parts();
                self.sum_of_products(span, word, &terms).map_or(Dimensions::UNKNOWN, Dimensions::all)
            }
            FunctionName::Cross => {
                let (a, b) = (first.parts(), second.parts());
                let mut parts = [InferredDimension::Unknown; 3];
                for (index, part) in parts.iter_mut().enumerate() {
                    let (i, j) = ((index + 1) % 3, (index + 2) % 3);
                    let terms = [a[i].times(b[j]), a[j].times(b[i])];
                    let Some(sum) = self.sum_of_products(span, word, &terms) else { return Dimensions::UNKNOWN };
                    *part = sum;
                }
                Dimensions::Parts(parts)
            }
        }
    }

    /// Dimension of one component of a scalar or vector product; `None` if its terms disagree, which is noted.
    fn sum_of_products(
        &mut self,
        span: Span,
        function: &str,
        terms: &[InferredDimension],
    ) -> Option<InferredDimension> {
        let mut known = terms.iter().filter_map(|term| match term {
            InferredDimension::Known(dimension) => Some(*dimension),
            _ => None,
        });
        let Some(first) = known.next() else {
            let present = |found: &InferredDimension| terms.contains(found);
            return Some(
                [InferredDimension::Unknown, InferredDimension::Number]
                    .into_iter()
                    .find(present)
                    .unwrap_or(InferredDimension::Zero),
            );
        };
        let Some(other) = known.find(|other| *other != first) else { return Some(InferredDimension::Known(first)) };
        self.context.error(
            span,
            format!(
                "`{function}` adds products of components, and here one is in {first} and another in {other}; give the \
                 components of each vector one unit"
            ),
        );
        None
    }

    pub fn compare(&mut self, expression: &Expression, value: Dimensions, need: &Need) {
        let parts = value.parts();
        let wrong = |part: &InferredDimension| match part {
            InferredDimension::Known(dimension) => *dimension != need.dimension,
            _ => false,
        };
        let Some(index) = parts.iter().position(wrong) else { return };
        let InferredDimension::Known(found) = parts[index] else { return };
        let mut subject = subject(expression, "this");
        if parts[0] != parts[1] || parts[0] != parts[2] {
            subject = match subject.strip_suffix('`') {
                Some(name) => format!("{name}.{}`", ["x", "y", "z"][index]),
                None => format!("the {} component of {subject}", ["first", "second", "third"][index]),
            };
        }
        let unit = self.unit(expression, found);
        let Need { what, unit: needed, dimension } = need;
        let mut remedy = match dimension.over(found) {
            Some(coefficient) => format!("multiply it by a coefficient in {coefficient}"),
            None => "correct one of the two".into(),
        };
        match self.written(expression) {
            // That radians are hidden in a coefficient is worth being said.
            Some(written) if written.contains("rad") && !needed.contains(['/', '(']) => {
                let below = if written == "rad" { written.into() } else { format!("({written})") };
                remedy = format!("{remedy} ({needed}/{below})");
            }
            Some(_) => remedy.push_str(", or correct its unit"),
            None => {}
        }
        if has_literal_factor(expression) {
            remedy.push_str(", such as a field with this unit: numbers have none");
        }
        let needed = if needed == "1" { "dimensionless".into() } else { format!("in {needed}") };
        let message = format!("{subject} is {unit}, and {what} {needed}; {remedy}");
        self.context.error(expression.span, message);
    }
}

fn product(a: Dimensions, b: Dimensions) -> Dimensions {
    let ([a, b, c], [d, e, f]) = (a.parts(), b.parts());
    Dimensions::Parts([a.times(d), b.times(e), c.times(f)])
}

fn property_value(property: Property) -> Dimensions {
    Dimensions::of(match property {
        Property::Position => LENGTH.1,
        Property::Rotation => return Dimensions::Rotation,
        Property::Velocity | Property::BodyVelocity | Property::RelativeVelocity => VELOCITY.1,
        Property::AngularVelocity | Property::BodyAngularVelocity => ANGULAR_VELOCITY.1,
        Property::Force => FORCE.1,
        Property::Torque => TORQUE.1,
    })
}

/// Noun of an expression in messages.
pub fn subject(expression: &Expression, article: &str) -> String {
    match &expression.kind {
        ExpressionKind::Name(name) | ExpressionKind::Input(name) | ExpressionKind::Horizontal(name, _) => {
            format!("`{name}`")
        }
        ExpressionKind::Property(base, property) => match &base.kind {
            ExpressionKind::Name(name) => format!("`{name}.{}`", property.word()),
            _ => format!("{article} `.{}`", property.word()),
        },
        ExpressionKind::Component(inner, index) => {
            let axis = ["x", "y", "z"].get(*index).copied().unwrap_or_default();
            match subject(inner, article).strip_suffix('`') {
                Some(name) => format!("{name}.{axis}`"),
                None => format!("{article} component"),
            }
        }
        ExpressionKind::Negate(inner) => subject(inner, article),
        ExpressionKind::Number { .. } => format!("{article} number"),
        ExpressionKind::Binary(BinaryOperator::Add, ..) => format!("{article} sum"),
        ExpressionKind::Binary(BinaryOperator::Subtract, ..) => format!("{article} difference"),
        ExpressionKind::Binary(BinaryOperator::Multiply, ..) => format!("{article} product"),
        ExpressionKind::Binary(BinaryOperator::Divide, ..) => format!("{article} quotient"),
        ExpressionKind::Power(..) => format!("{article} power"),
        ExpressionKind::Call(function, _) => format!("`{}(…)`", function.word()),
        ExpressionKind::Own(name, _) => format!("`{name}(…)`"),
        ExpressionKind::Vector(_) => format!("{article} vector"),
    }
}

/// A number is multiplied with something: it may be meant to have a unit.
fn has_literal_factor(expression: &Expression) -> bool {
    match &expression.kind {
        ExpressionKind::Binary(BinaryOperator::Multiply | BinaryOperator::Divide, left, right) => {
            [left, right].into_iter().any(|side| side.literal().is_some() || has_literal_factor(side))
        }
        ExpressionKind::Negate(inner) => has_literal_factor(inner),
        _ => false,
    }
}
