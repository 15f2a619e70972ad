//! Expressions: ordinary Rust arithmetic on scalars, vectors and rotations, as a tree with spans.
//!
//! `arithmetic` reads them; `kinds` checks their names and kinds.

use std::collections::HashSet;

use proc_macro2::Span;
use syn::Ident;
use syn::ext::IdentExt;

use crate::algebra::Rational;
use crate::terms::Twin;

/// A value that the equations depend on, as the user wrote it.
#[derive(Clone, Debug)]
pub struct Expression {
    /// Kind of the expression.
    pub kind: ExpressionKind,
    /// Its head: the name, the literal, the operator, the function, or the opening bracket of a vector.
    pub span: Span,
}

/// The forms of expressions.
#[derive(Clone, Debug)]
pub enum ExpressionKind {
    /// A literal, exactly.
    Number {
        /// Not negative but of a twin.
        value: Rational,
        /// It differs among limbs that are alike: a constant of its own, whatever its value.
        twin: Option<Twin>,
    },
    /// A coordinate, a speed, an input, a field that is a scalar or a vector, a point, or `t`.
    Name(Ident),
    /// `input.elbow`: an input by what it is called outside of expressions; only until `names::inputs` has named it.
    Input(Ident),
    /// A horizontal coordinate of the place where something touches, by its number: in `height = …` with `over = …`
    /// alone.
    Horizontal(Ident, usize),
    /// `arm.position`: of a body, a frame or a coordinate that is a pose, which is the name before it.
    Property(Box<Expression>, Property),
    /// `a.x`, `a[0]`: component 0, 1 or 2 of a vector.
    Component(Box<Expression>, usize),
    /// `-a`.
    Negate(Box<Expression>),
    /// `a + b` and the like.
    Binary(BinaryOperator, Box<Expression>, Box<Expression>),
    /// `powi(a, n)`, `a.powi(n)`.
    Power(Box<Expression>, i32),
    /// `sin(a)`, `a.sin()`, `dot(a, b)`: the number of arguments is right.
    Call(FunctionName, Vec<Expression>),
    /// `lift(a)`, `drag(a, m)`: a function that a clause declares.
    Own(Ident, Box<[Expression]>),
    /// `[a, b, c]`.
    Vector([Box<Expression>; 3]),
}

/// Arithmetic between two expressions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BinaryOperator {
    /// `+`: two scalars or two vectors.
    Add,
    /// `-`: two scalars or two vectors.
    Subtract,
    /// `*`: scalars, a scalar and a vector, a rotation and a vector, two rotations.
    Multiply,
    /// `/`: a scalar or a vector by a scalar.
    Divide,
}

/// Functions of expressions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FunctionName {
    /// Sine of an angle in radians.
    Sin,
    /// Cosine of an angle in radians.
    Cos,
    /// Tangent of an angle in radians.
    Tan,
    /// Inverse sine in radians, of a number between −1 and 1.
    Asin,
    /// Inverse cosine in radians, of a number between −1 and 1.
    Acos,
    /// Inverse tangent in radians.
    Atan,
    /// Hyperbolic tangent.
    Tanh,
    /// Power (x, p) with a constant exponent, of a base that is not negative.
    Powf,
    /// Exponential.
    Exp,
    /// Natural logarithm.
    Ln,
    /// Square root.
    Sqrt,
    /// Turn about the first axis.
    RotationX,
    /// Turn about the second axis.
    RotationY,
    /// Turn about the third axis.
    RotationZ,
    /// Scalar product.
    Dot,
    /// Vector product.
    Cross,
    /// Angle of the point (x, y), given as (y, x), from the first axis, in radians.
    Atan2,
    /// Linear and angular velocity in body axes, pole O: only as the whole rate of a pose.
    Twist,
    /// Inverse of a rotation.
    Inverse,
    /// Time derivative of a scalar or a vector of t and q: only in constraints of velocities and values of forces.
    Rate,
    /// −1, 0 or 1: only in values of forces, since it jumps.
    Signum,
    /// The value (x, low, high) kept between two limits: only in values of forces, since its derivative jumps.
    Clamp,
    /// Smooth step of (x, from, to): 0 below `from`, 1 above `to`, `3s² − 2s³` between; only in values of forces, since
    /// its second derivative jumps.
    SmoothStep,
    /// Absolute value: only in values of forces, since its derivative jumps.
    Abs,
    /// The lesser of two: only in values of forces, since its derivative jumps.
    Min,
    /// The greater of two: only in values of forces, since its derivative jumps.
    Max,
    /// √(a² + b²).
    Hypot,
}

/// A property of a body or a frame, with components in observer axes unless the variant names others. A coordinate that
/// is a pose has the first two, an input that is a wrench the last two.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Property {
    /// O from Ω.
    Position,
    /// R: from the axes e to the axes k.
    Rotation,
    /// The velocity of O; only in constraints of velocities and values of forces.
    Velocity,
    /// ω; only in constraints of velocities and values of forces.
    AngularVelocity,
    /// u = Rᵀ v_O, the velocity of O in body axes; where the velocity may stand.
    BodyVelocity,
    /// ω in body axes; where the angular velocity may stand.
    BodyAngularVelocity,
    /// The velocity of O relative to the medium, in body axes; where the velocity may stand.
    RelativeVelocity,
    /// The first three components of an input that is a wrench, in the axes of where they are used.
    Force,
    /// The last three components of an input that is a wrench, in the axes of where they are used.
    Torque,
}

impl Expression {
    /// The components of a vector that is written in numbers.
    pub fn literal_components(&self) -> Option<[f64; 3]> {
        let number = |e: &Self| match &e.kind {
            ExpressionKind::Number { value, .. } => Some(value.to_f64()),
            ExpressionKind::Negate(inner) => match &inner.kind {
                ExpressionKind::Number { value, .. } => Some(-value.to_f64()),
                _ => None,
            },
            _ => None,
        };
        let ExpressionKind::Vector([a, b, c]) = &self.kind else { return None };
        Some([number(a)?, number(b)?, number(c)?])
    }

    /// Calls `visit` with this expression and every part of it.
    pub fn walk(&self, visit: &mut dyn FnMut(&Expression)) {
        visit(self);
        self.parts(&mut |part| part.walk(visit));
    }

    /// Calls `visit` with each of its parts, not with the parts of these.
    pub fn parts(&self, visit: &mut dyn FnMut(&Expression)) {
        match &self.kind {
            ExpressionKind::Number { .. }
            | ExpressionKind::Name(_)
            | ExpressionKind::Input(_)
            | ExpressionKind::Horizontal(..) => {}
            ExpressionKind::Component(inner, _)
            | ExpressionKind::Property(inner, _)
            | ExpressionKind::Negate(inner)
            | ExpressionKind::Power(inner, _) => visit(inner),
            ExpressionKind::Binary(_, left, right) => {
                visit(left);
                visit(right);
            }
            ExpressionKind::Call(_, arguments) => arguments.iter().for_each(visit),
            ExpressionKind::Own(_, arguments) => arguments.iter().for_each(visit),
            ExpressionKind::Vector(components) => components.iter().for_each(|component| visit(component)),
        }
    }

    /// Calls `change` with each of its parts, not with the parts of these.
    pub fn each_part(&mut self, change: &mut dyn FnMut(&mut Expression)) {
        match &mut self.kind {
            ExpressionKind::Number { .. }
            | ExpressionKind::Name(_)
            | ExpressionKind::Input(_)
            | ExpressionKind::Horizontal(..) => {}
            ExpressionKind::Component(inner, _)
            | ExpressionKind::Property(inner, _)
            | ExpressionKind::Negate(inner)
            | ExpressionKind::Power(inner, _) => change(inner),
            ExpressionKind::Binary(_, left, right) => {
                change(left);
                change(right);
            }
            ExpressionKind::Call(_, arguments) => arguments.iter_mut().for_each(change),
            ExpressionKind::Own(_, arguments) => arguments.iter_mut().for_each(change),
            ExpressionKind::Vector(components) => components.iter_mut().for_each(|component| change(component)),
        }
    }

    /// Adds the names in it.
    pub fn put_names(&self, names: &mut HashSet<String>) {
        self.walk(&mut |part| {
            if let ExpressionKind::Name(name) = &part.kind {
                names.insert(name.unraw().to_string());
            }
        });
    }

    /// Whether some part of it is the name `word`.
    pub fn names(&self, word: &str) -> bool {
        let mut found = false;
        self.walk(&mut |part| found |= matches!(&part.kind, ExpressionKind::Name(name) if name.unraw() == word));
        found
    }

    /// Whether it is made of literals alone.
    pub fn is_made_of_literals(&self) -> bool {
        let mut literals = true;
        let named = |kind: &ExpressionKind| {
            matches!(kind, ExpressionKind::Name(_) | ExpressionKind::Own(..) | ExpressionKind::Horizontal(..))
        };
        self.walk(&mut |part| literals &= !named(&part.kind));
        literals
    }

    /// A literal with its sign, to the nearest double.
    pub fn literal(&self) -> Option<f64> {
        match &self.kind {
            ExpressionKind::Number { value, .. } => Some(value.to_f64()),
            ExpressionKind::Negate(inner) => inner.literal().map(|value| -value),
            _ => None,
        }
    }

    /// Multiple of π, if it is made of `pi` and literals so that this can be seen: `pi`, `-pi / 2`, `3 * pi / 4`.
    pub fn turns_of_pi(&self) -> Option<Rational> {
        match &self.kind {
            ExpressionKind::Name(name) if name == "pi" => Some(Rational::one()),
            ExpressionKind::Negate(inner) => inner.turns_of_pi().map(|turns| -turns),
            ExpressionKind::Binary(BinaryOperator::Multiply, a, b) => match (a.turns_of_pi(), b.turns_of_pi()) {
                (Some(turns), None) => Some(turns * b.number()?),
                (None, Some(turns)) => Some(a.number()? * turns),
                _ => None,
            },
            ExpressionKind::Binary(BinaryOperator::Divide, a, b) => {
                let divisor = b.number().filter(|divisor| !divisor.is_zero())?;
                Some(a.turns_of_pi()? * divisor.recip())
            }
            _ => None,
        }
    }

    /// A literal with its sign, exactly.
    pub fn number(&self) -> Option<Rational> {
        match &self.kind {
            ExpressionKind::Number { value, .. } => Some(*value),
            ExpressionKind::Negate(inner) => inner.number().map(|value| -value),
            _ => None,
        }
    }

    pub fn is_zero(&self) -> bool {
        match &self.kind {
            ExpressionKind::Number { value, .. } => value.is_zero(),
            ExpressionKind::Negate(inner) => inner.is_zero(),
            _ => false,
        }
    }
}
