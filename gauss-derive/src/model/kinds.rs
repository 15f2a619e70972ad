//! What kind of value an expression has, and whether it is the kind that its place needs.

use super::context::Context;
use super::scope::{Meaning, Scope};
use super::{BinaryOperator, Expression, ExpressionKind};
use proc_macro2::{Ident, Span};

/// The kind of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Scalar,
    Vector,
    Rotation,
}

impl Kind {
    fn noun(self) -> &'static str {
        match self {
            Kind::Scalar => "a scalar",
            Kind::Vector => "a vector",
            Kind::Rotation => "a rotation",
        }
    }
}

/// Where an expression stands.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    Kinematics,
    Position,
    Rotation,
    Mass,
    Potential,
}

impl Place {
    fn kind(self) -> Kind {
        match self {
            Place::Kinematics | Place::Mass | Place::Potential => Kind::Scalar,
            Place::Position => Kind::Vector,
            Place::Rotation => Kind::Rotation,
        }
    }

    /// What to say of an expression of another kind.
    fn mismatch(self, found: Kind) -> String {
        let (what, remedy) = match self {
            Place::Kinematics => ("the rate of a coordinate", "write one number, such as `v * cos(theta)`"),
            Place::Position => ("a position", "write `[x, y, z]`"),
            Place::Rotation => ("a rotation", "write `rotation_z(theta)`, or a product of such turns"),
            Place::Mass => ("the mass of a particle", "write one number or the name of a field"),
            Place::Potential => ("a potential", "write one number, such as `k * x * x / 2`"),
        };
        if self == Place::Rotation {
            format!("expected a rotation, found {}; {remedy}", found.noun())
        } else {
            format!("{what} is {}, found {}; {remedy}", self.kind().noun(), found.noun())
        }
    }

    /// What to say of a name that may not stand here.
    fn forbids(self, name: &Ident, meaning: &Meaning) -> Option<String> {
        match (self, meaning) {
            (Place::Potential, Meaning::Speed) => Some(format!(
                "`{name}` is a speed, and a potential depends on coordinates, fields and `t` only; \
                 write the potential without `{name}`"
            )),
            (Place::Position | Place::Rotation, Meaning::Speed) => {
                let what = if self == Place::Position { "position" } else { "rotation" };
                Some(format!(
                    "`{name}` is a speed, and a {what} depends on coordinates, fields and `t` only; \
                     speeds stand in `kinematics`"
                ))
            }
            (Place::Mass, Meaning::Coordinate | Meaning::Speed | Meaning::Time) => {
                Some(format!("`{name}` varies, and the mass of a particle is constant; write numbers and fields only"))
            }
            _ => None,
        }
    }
}

/// Checks names and kinds of an expression that stands at `place`.
pub(super) fn check(expression: &Expression, place: Place, scope: &Scope, context: &mut Context) {
    let found = Checker { place, scope, context }.kind(expression);
    if let Some(found) = found
        && found != place.kind()
    {
        context.error(expression.span, place.mismatch(found));
    }
}

struct Checker<'a> {
    place: Place,
    scope: &'a Scope,
    context: &'a mut Context,
}

impl Checker<'_> {
    /// The kind of an expression; `None` where something is wrong, which is then noted.
    fn kind(&mut self, expression: &Expression) -> Option<Kind> {
        match &expression.kind {
            ExpressionKind::Number { .. } => Some(Kind::Scalar),
            ExpressionKind::Name(name) => self.name(name),
            ExpressionKind::Property(base, _) => self.kind(base),
            ExpressionKind::Component(base, _) => {
                let kind = self.kind(base)?;
                self.expect(kind, Kind::Vector, expression.span, "components are those of")?;
                Some(Kind::Scalar)
            }
            ExpressionKind::Negate(inner) => match self.kind(inner)? {
                Kind::Rotation => self.note(
                    expression.span,
                    "a rotation has no negative; the inverse of `rotation_z(a)` is `rotation_z(-a)`".into(),
                ),
                kind => Some(kind),
            },
            ExpressionKind::Binary(operator, left, right) => {
                let (left, right) = (self.kind(left), self.kind(right));
                self.binary(*operator, left?, right?, expression.span)
            }
            ExpressionKind::Power(base, _) => {
                let kind = self.kind(base)?;
                self.expect(kind, Kind::Scalar, base.span, "`powi` takes")?;
                Some(Kind::Scalar)
            }
            ExpressionKind::Call(function, arguments) => {
                for argument in arguments {
                    if let Some(kind) = self.kind(argument) {
                        self.expect(kind, function.takes(), argument.span, &format!("`{}` takes", function.word()));
                    }
                }
                Some(function.gives())
            }
            ExpressionKind::Vector(components) => {
                for component in components {
                    if let Some(kind) = self.kind(component) {
                        self.expect(kind, Kind::Scalar, component.span, "each component of a vector is");
                    }
                }
                Some(Kind::Vector)
            }
        }
    }

    fn name(&mut self, name: &Ident) -> Option<Kind> {
        let meaning = match self.scope.find(name) {
            Ok(meaning) => meaning,
            Err(message) => return self.note(name.span(), message?),
        };
        if let Some(message) = self.place.forbids(name, meaning) {
            return self.note(name.span(), message);
        }
        match meaning {
            Meaning::Time | Meaning::Coordinate | Meaning::Speed | Meaning::Scalar => Some(Kind::Scalar),
            Meaning::Vector => Some(Kind::Vector),
            Meaning::Unusable(message) => self.note(name.span(), message.clone()),
        }
    }

    fn binary(&mut self, operator: BinaryOperator, left: Kind, right: Kind, span: Span) -> Option<Kind> {
        use Kind::{Rotation, Scalar, Vector};
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

    fn expect(&mut self, found: Kind, expected: Kind, span: Span, what: &str) -> Option<()> {
        if found == expected {
            return Some(());
        }
        self.note(span, format!("{what} {}, found {}", expected.noun(), found.noun()));
        None
    }

    fn note(&mut self, span: Span, message: String) -> Option<Kind> {
        self.context.error(span, message);
        None
    }
}
