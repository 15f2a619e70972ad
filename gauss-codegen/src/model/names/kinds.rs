//! Kinds of values of expressions, and whether they are those that their places need.

use super::places::ExpressionPlace;
use super::scope::{Meaning, Scope};
use crate::model::language::context::Context;
use crate::model::language::kind::ValueKind;
use crate::model::scene::clauses::{CoordinateKind, SpeedKind};
use crate::model::scene::expression::{BinaryOperator, Expression, ExpressionKind, FunctionName, Property};
use crate::terms::InputKind;
use proc_macro2::{Ident, Span};
use std::cmp::Ordering;

/// Checks names and kinds of an expression that stands at `place`; its kind, unless something is wrong, which is noted.
pub fn check(
    expression: &Expression,
    place: ExpressionPlace,
    scope: &Scope,
    context: &mut Context,
) -> Option<ValueKind> {
    let mut checker = KindChecker { place, scope, context, differentiated: false, within: None, faulty: false };
    let found = match &expression.kind {
        // Only a whole rate is a twist.
        ExpressionKind::Call(FunctionName::Twist, arguments) if matches!(place, ExpressionPlace::Kinematics(_)) => {
            checker.arguments(FunctionName::Twist, arguments);
            ValueKind::Twist
        }
        _ => checker.kind(expression)?,
    };
    if !place.accepts(found) {
        return checker.note(expression.span, place.mismatch(found));
    }
    // What a function or a vector gives is known whatever its parts are.
    (!checker.faulty).then_some(found)
}

struct KindChecker<'a> {
    place: ExpressionPlace,
    scope: &'a Scope,
    context: &'a mut Context,
    /// Inside `rate(…)`.
    differentiated: bool,
    /// Inside a definition, whose name stands in the expression.
    within: Option<usize>,
    /// Something was wrong with a part.
    faulty: bool,
}

impl KindChecker<'_> {
    /// The kind of an expression; `None` where it cannot be told because something is wrong, which is then noted.
    fn kind(&mut self, expression: &Expression) -> Option<ValueKind> {
        let found = self.kind_of(expression);
        self.faulty |= found.is_none();
        found
    }

    fn kind_of(&mut self, expression: &Expression) -> Option<ValueKind> {
        match &expression.kind {
            ExpressionKind::Number { .. } | ExpressionKind::Horizontal(..) => Some(ValueKind::Scalar),
            ExpressionKind::Name(name) => self.name(name),
            // It names no input, which is noted.
            ExpressionKind::Input(_) => None,
            ExpressionKind::Property(base, property) => self.property(base, *property, expression.span),
            ExpressionKind::Component(base, _) => {
                let kind = self.kind(base)?;
                self.expect(kind, ValueKind::Vector, expression.span, "components are those of")?;
                Some(ValueKind::Scalar)
            }
            ExpressionKind::Negate(inner) => match self.kind(inner)? {
                ValueKind::Rotation => {
                    self.note(expression.span, "a rotation has no negative; the inverse of `r` is `inverse(r)`".into())
                }
                kind => Some(kind),
            },
            ExpressionKind::Binary(operator, left, right) => {
                let (left, right) = (self.kind(left), self.kind(right));
                self.binary(*operator, left?, right?, expression.span)
            }
            ExpressionKind::Power(base, _) => {
                let kind = self.kind(base)?;
                self.expect(kind, ValueKind::Scalar, base.span, "`powi` takes")?;
                Some(ValueKind::Scalar)
            }
            ExpressionKind::Call(FunctionName::Twist, arguments) => {
                self.arguments(FunctionName::Twist, arguments);
                self.note(
                    expression.span,
                    "a twist is no part of another expression; write `pose = twist(linear, angular)` in `kinematics(…)`"
                        .into(),
                )
            }
            ExpressionKind::Own(name, arguments) => self.own(name, arguments, expression.span),
            ExpressionKind::Call(FunctionName::Powf, arguments) => {
                self.arguments(FunctionName::Powf, arguments);
                self.exponent(arguments.get(1)?)
            }
            ExpressionKind::Call(FunctionName::Rate, arguments) => self.rate(arguments, expression.span),
            ExpressionKind::Call(function, arguments) => {
                self.arguments(*function, arguments);
                if function.has_kink()
                    && let Some(message) = self.refuses_kink(*function)
                {
                    return self.note(expression.span, message);
                }
                function.gives()
            }
            ExpressionKind::Vector(components) => {
                for component in components {
                    if let Some(kind) = self.kind(component) {
                        self.expect(kind, ValueKind::Scalar, component.span, "each component of a vector is");
                    }
                }
                Some(ValueKind::Vector)
            }
        }
    }

    /// A function that a clause declares.
    fn own(&mut self, name: &Ident, arguments: &[Expression], span: Span) -> Option<ValueKind> {
        for argument in arguments {
            if let Some(kind) = self.kind(argument) {
                self.expect(kind, ValueKind::Scalar, argument.span, &format!("`{name}` takes"));
            }
        }
        let declared = match self.scope.find_function(name) {
            Ok(declared) => declared.clone(),
            Err(message) => return self.note(span, message?),
        };
        if declared.variables.len() != arguments.len() {
            let takes = match declared.variables.len() {
                1 => "one argument",
                2 => "two arguments",
                _ => "three arguments",
            };
            let (variables, found) = (declared.variables.join(", "), arguments.len());
            return self.note(span, format!("`{name}` takes {takes}, found {found}; write `{name}({variables})`"));
        }
        if !declared.kink {
            return Some(ValueKind::Scalar);
        }
        let why = if self.differentiated {
            Some("`rate` takes derivatives".to_owned())
        } else {
            self.place.refuses_kinks().map(|why| why.to_string())
        };
        match why {
            Some(why) => {
                self.note(span, format!("the derivative of the table `{name}` jumps, and {why}; write `kind = cubic`"))
            }
            None => Some(ValueKind::Scalar),
        }
    }

    /// The exponent of `powf`: nothing in it moves.
    fn exponent(&mut self, exponent: &Expression) -> Option<ValueKind> {
        let mut moving = None;
        exponent.walk(&mut |part| {
            if let ExpressionKind::Name(name) = &part.kind {
                let constant = |meaning: &Meaning| {
                    matches!(meaning, Meaning::Scalar | Meaning::Vector | Meaning::Pi | Meaning::Definition(_))
                };
                let varies = self.scope.find(name, constant).is_ok_and(|meaning| !constant(meaning));
                moving = moving.take().or(varies.then(|| name.clone()));
            }
        });
        match moving {
            Some(name) => self.note(
                name.span(),
                format!(
                    "`{name}` varies, and the exponent of `powf` is made of numbers and fields; write `exp` and `ln`"
                ),
            ),
            None => Some(ValueKind::Scalar),
        }
    }

    /// The kind of the last argument, if nothing is wrong with it.
    fn arguments(&mut self, function: FunctionName, arguments: &[Expression]) -> Option<ValueKind> {
        let mut last = None;
        for argument in arguments {
            last = self.kind(argument);
            let (Some(kind), Some(taken)) = (last, function.takes()) else { continue };
            last = self.expect(kind, taken, argument.span, &format!("`{}` takes", function.word())).map(|()| kind);
        }
        last
    }

    /// Message about a function whose derivative jumps, where derivatives are taken.
    fn refuses_kink(&self, function: FunctionName) -> Option<String> {
        if self.differentiated {
            return Some(format!(
                "{}, and `rate` takes derivatives; take `{}` out of `rate(…)`",
                function.jump(),
                function.word()
            ));
        }
        self.place.refuses_kink(function)
    }

    /// A time derivative, which is a velocity.
    fn rate(&mut self, arguments: &[Expression], span: Span) -> Option<ValueKind> {
        if let Some(message) = self.place.refuses_velocity("rate(…)") {
            return self.note(span, message);
        }
        if self.differentiated {
            return self.note(span, self.acceleration("rate(…)", "one `rate`"));
        }
        self.differentiated = true;
        let kind = self.arguments(FunctionName::Rate, arguments);
        self.differentiated = false;
        match kind? {
            kind @ (ValueKind::Scalar | ValueKind::Vector) => Some(kind),
            kind => self.note(
                arguments.first().map_or(span, |argument| argument.span),
                format!("`rate` takes a scalar or a vector, found {}; ask bodies for `.angular_velocity`", kind.noun()),
            ),
        }
    }

    fn meaning(&mut self, name: &Ident, expected: impl Fn(&Meaning) -> bool) -> Option<Meaning> {
        match self.scope.find(name, expected) {
            Ok(Meaning::Unusable(message)) => {
                self.note(name.span(), message.clone());
                None
            }
            Ok(meaning) if self.place.allows(meaning) => Some(meaning.clone()),
            Ok(meaning) => {
                self.note(name.span(), self.place.refusal(name, meaning));
                None
            }
            Err(message) => {
                self.note(name.span(), message?);
                None
            }
        }
    }

    fn name(&mut self, name: &Ident) -> Option<ValueKind> {
        let place = self.place;
        match self.meaning(name, |meaning| place.allows(meaning))? {
            Meaning::Speed(_) if self.differentiated => {
                self.note(name.span(), self.acceleration(&name.to_string(), &format!("`{name}` itself")))
            }
            Meaning::Input(_) if self.differentiated => self.note(name.span(), rate_of_input(name)),
            Meaning::State if self.differentiated => self.note(
                name.span(),
                format!(
                    "the rate of the state `{name}` is what `states({name} = …)` says; give that a name by `define(…)`, \
                     and write it in the place of the rate"
                ),
            ),
            Meaning::Time
            | Meaning::Pi
            | Meaning::Scalar
            | Meaning::Coordinate(CoordinateKind::Scalar)
            | Meaning::Speed(SpeedKind::Scalar)
            | Meaning::State
            | Meaning::Input(InputKind::Scalar) => Some(ValueKind::Scalar),
            Meaning::Speed(SpeedKind::Vector) | Meaning::Input(InputKind::Vector) => Some(ValueKind::Vector),
            Meaning::Function(declared) => {
                let call = declared.variables.join(", ");
                self.note(name.span(), format!("`{name}` is a function; write `{name}({call})`"))
            }
            Meaning::Input(InputKind::Wrench) => self.note(
                name.span(),
                format!("`{name}` is a wrench, which is two vectors; write `{name}.force` or `{name}.torque`"),
            ),
            Meaning::Definition(index) => self.definition(name, index),
            Meaning::Vector | Meaning::Point => Some(ValueKind::Vector),
            Meaning::Coordinate(CoordinateKind::Rotation) => Some(ValueKind::Rotation),
            meaning => self.note(
                name.span(),
                format!("`{name}` is {}; write `{name}.position` or `{name}.rotation`", meaning.described()),
            ),
        }
    }

    /// The kind of a definition, whose expression stands where its name stands.
    fn definition(&mut self, name: &Ident, index: usize) -> Option<ValueKind> {
        let scope = self.scope;
        match scope.definition(index) {
            Ok(expression) => {
                let expression = expression?;
                let outside = self.within.replace(index);
                let kind = self.kind(expression);
                self.within = outside;
                kind
            }
            Err(order) => {
                let message = match order {
                    Ordering::Greater => format!("`{name}` is defined later; move its definition up"),
                    _ => format!("`{name}` is defined by itself; define it without `{name}`"),
                };
                self.note(name.span(), message)
            }
        }
    }

    /// `arm.position`.
    fn property(&mut self, base: &Expression, property: Property, span: Span) -> Option<ValueKind> {
        let word = property.word();
        let ExpressionKind::Name(name) = &base.kind else {
            self.kind(base)?;
            return self.note(
                span,
                format!("`.{word}` is a property of bodies, frames and poses; write it after their names"),
            );
        };
        let place = self.place;
        let pose = Meaning::Coordinate(CoordinateKind::Pose);
        let wrench = Meaning::Input(InputKind::Wrench);
        let has = |meaning: &Meaning| {
            place.allows(meaning)
                && if property.is_of_wrench() {
                    *meaning == wrench
                } else {
                    meaning.is_body() || *meaning == pose || meaning.has_velocity(property)
                }
        };
        let meaning = self.meaning(name, has)?;
        let message = match (&meaning, property) {
            (meaning, property) if meaning.has_velocity(property) => match self.velocity(&format!("{name}.{word}")) {
                Some(message) => message,
                None => return Some(ValueKind::Vector),
            },
            (Meaning::Body | Meaning::Frame | Meaning::Coordinate(CoordinateKind::Pose), Property::Position) => {
                return Some(ValueKind::Vector);
            }
            (Meaning::Body | Meaning::Frame | Meaning::Coordinate(CoordinateKind::Pose), Property::Rotation) => {
                return Some(ValueKind::Rotation);
            }
            (Meaning::Input(InputKind::Wrench), Property::Force | Property::Torque) => {
                if !self.differentiated {
                    return Some(ValueKind::Vector);
                }
                rate_of_input(name)
            }
            (Meaning::Input(InputKind::Wrench), _) => {
                format!("`{name}` is a wrench and has no `.{word}`; it has `.force` and `.torque`")
            }
            (meaning, Property::Force | Property::Torque) => format!(
                "`{name}` is {} and has no `.{word}`; inputs that are wrenches have: `input(name: Wrench)`",
                meaning.described()
            ),
            (Meaning::Coordinate(CoordinateKind::Pose), _) => format!(
                "a pose has `.position`, `.rotation` and velocities, and no `.{word}`; ask it of the body that has this pose"
            ),
            (Meaning::Coordinate(CoordinateKind::Rotation), Property::Rotation) => {
                format!("`{name}` is itself a rotation; write `{name}`")
            }
            (Meaning::Point, Property::Position) => format!("`{name}` is itself a position; write `{name}`"),
            (meaning, _) => format!(
                "`{name}` is {} and has no `.{word}`; bodies and frames have, by their names",
                meaning.described()
            ),
        };
        self.note(span, message)
    }

    /// Message about a velocity, `written` so, where none may stand.
    fn velocity(&self, written: &str) -> Option<String> {
        let refused = self.place.refuses_velocity(written);
        refused.or_else(|| self.differentiated.then(|| self.acceleration(written, &format!("`{written}` itself"))))
    }

    fn binary(&mut self, operator: BinaryOperator, left: ValueKind, right: ValueKind, span: Span) -> Option<ValueKind> {
        use ValueKind::{Rotation, Scalar, Vector};
        let found = format!("found {} and {}", left.noun(), right.noun());
        let message = match (operator, left, right) {
            (BinaryOperator::Add | BinaryOperator::Subtract, Scalar, Scalar) => return Some(Scalar),
            (BinaryOperator::Add | BinaryOperator::Subtract, Vector, Vector) => return Some(Vector),
            (BinaryOperator::Add, ..) => format!("`+` joins two scalars or two vectors, {found}"),
            (BinaryOperator::Subtract, ..) => format!("`-` joins two scalars or two vectors, {found}"),
            (BinaryOperator::Multiply, Scalar, Scalar) => return Some(Scalar),
            (BinaryOperator::Multiply, Scalar, Vector) | (BinaryOperator::Multiply, Vector, Scalar) => {
                return Some(Vector);
            }
            (BinaryOperator::Multiply, Rotation, Vector) => return Some(Vector),
            (BinaryOperator::Multiply, Rotation, Rotation) => return Some(Rotation),
            (BinaryOperator::Multiply, Vector, Vector) => {
                "two vectors have two products; write `dot(a, b)` or `cross(a, b)`".into()
            }
            (BinaryOperator::Multiply, Vector, Rotation) => {
                "a rotation stands before the vector that it turns; write `rotation * vector`".into()
            }
            (BinaryOperator::Multiply, ..) => format!("`*` turns a vector or another rotation, {found}"),
            (BinaryOperator::Divide, Scalar, Scalar) => return Some(Scalar),
            (BinaryOperator::Divide, Vector, Scalar) => return Some(Vector),
            (BinaryOperator::Divide, ..) => format!("`/` divides a scalar or a vector by a scalar, {found}"),
        };
        self.note(span, message)
    }

    fn expect(&mut self, found: ValueKind, expected: ValueKind, span: Span, what: &str) -> Option<()> {
        if found == expected {
            return Some(());
        }
        self.note(span, format!("{what} {}, found {}", expected.noun(), found.noun()));
        None
    }

    fn note(&mut self, span: Span, message: String) -> Option<ValueKind> {
        self.faulty = true;
        let Some(definition) = self.within else {
            self.context.error(span, message);
            return None;
        };
        // It is well by itself, so that the use is what forbids it.
        if self.scope.is_new(definition, &message) {
            let (name, subject) = (self.scope.name_of_definition(definition), self.place.subject());
            self.context.error(span, format!("in the definition of `{name}`, which {subject} uses: {message}"));
        }
        None
    }

    /// Message about the time derivative of a velocity.
    fn acceleration(&self, written: &str, instead: &str) -> String {
        format!(
            "the time derivative of `{written}` is an acceleration, which {} cannot contain; write {instead}",
            self.place.subject()
        )
    }
}

/// Message about an input in `rate(…)`.
fn rate_of_input(name: &Ident) -> String {
    format!(
        "`{name}` is an input, whose rate is never known; take it out of `rate(…)`, and declare an input for its rate if \
         that is known"
    )
}
