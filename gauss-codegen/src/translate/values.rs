//! Expressions as the user wrote them, as values of the algebra.

use proc_macro2::Span;

use crate::algebra::{BinaryFunction, Expr, Function, Notation, Rational, decimal};
use crate::error::Result;
use crate::mechanics::{Axes, Tree, Turn, dot, subtract};
use crate::model::{BinaryOperator, Expression, ExpressionKind, FunctionName, Property};
use crate::terms::Twin;
use crate::words::Unraw;

use super::limbs;
use super::translator::{Translator, bug};
use super::value::{Local, RotationFactor, Value};

type Triple<'g> = [Expr<'g>; 3];

/// Numerators and denominators up to which literals are fractions in the algebra.
const EXACT: i64 = 1000;

/// Number of quarter turns of a literal angle: `1.5707963267948966` is meant to be π/2, and its sine and cosine to be
/// one and zero, not 6e-17.
fn quarter_turns(angle: &Expression) -> Option<usize> {
    if let Some((turns, 1)) = angle.turns_of_pi().and_then(|turns| (turns * Rational::from_integer(2)).parts()) {
        return usize::try_from(turns.rem_euclid(4)).ok();
    }
    let angle = match &angle.kind {
        ExpressionKind::Number { value, .. } => value.to_f64(),
        ExpressionKind::Negate(inner) => return quarter_turns(inner).map(|quarters| (4 - quarters) % 4),
        _ => return None,
    };
    let quarters = (angle / std::f64::consts::FRAC_PI_2).round();
    // The nearest double, or one of its neighbours.
    let close = (angle - quarters * std::f64::consts::FRAC_PI_2).abs() <= 2.0 * f64::EPSILON * angle.abs();
    (close && quarters < 1e6).then_some(quarters as usize % 4)
}

/// Between two limits.
pub(super) fn clamped<'g>(x: Expr<'g>, [low, high]: [Expr<'g>; 2]) -> Expr<'g> {
    x.binary(BinaryFunction::Max, low).binary(BinaryFunction::Min, high)
}

impl<'g> Translator<'_, 'g> {
    pub(super) fn scalar(&self, e: &Expression, tree: &Tree<'g>) -> Result<Expr<'g>> {
        match self.value(e, tree)? {
            Value::Scalar(value) => Ok(value),
            _ => Err(bug(e.span)),
        }
    }

    pub(super) fn vector(&self, e: &Expression, tree: &Tree<'g>) -> Result<Triple<'g>> {
        match self.value(e, tree)?.observed() {
            Value::Vector(value) => Ok(value),
            _ => Err(bug(e.span)),
        }
    }

    /// The value of an expression; links that it names are those of the tree.
    pub(super) fn value(&self, e: &Expression, tree: &Tree<'g>) -> Result<Value<'g>> {
        Ok(match &e.kind {
            ExpressionKind::Number { value, twin } => {
                self.note_extreme(*value, e.span);
                Value::Scalar(twin.map_or_else(|| self.number(*value), |twin| self.twin(*value, twin)))
            }
            ExpressionKind::Name(name) => {
                self.names.get(&name.unraw().to_string()).cloned().ok_or_else(|| bug(e.span))?
            }
            ExpressionKind::Input(_) => return Err(bug(e.span)),
            ExpressionKind::Horizontal(_, k) => {
                Value::Scalar(self.place.and_then(|place| place.get(*k).copied()).ok_or_else(|| bug(e.span))?)
            }
            ExpressionKind::Property(inner, property) => self.property(inner, *property, tree)?,
            ExpressionKind::Component(inner, k) => {
                Value::Scalar(*self.vector(inner, tree)?.get(*k).ok_or_else(|| bug(e.span))?)
            }
            ExpressionKind::Negate(inner) => match self.value(inner, tree)? {
                Value::Scalar(a) => Value::Scalar(-a),
                Value::Vector(a) => Value::Vector(a.map(|a| -a)),
                Value::Local(a) => a.map(|a| -a).map_or(Value::Vector(a.observed.map(|a| -a)), Value::Local),
                _ => return Err(bug(e.span)),
            },
            ExpressionKind::Power(inner, exponent) => {
                let base = self.scalar(inner, tree)?;
                let base = if *exponent < 0 { self.divisor(base, inner.span) } else { base };
                Value::Scalar(self.in_range(base.powi(*exponent), e))
            }
            ExpressionKind::Vector([a, b, c]) => {
                Value::Vector([self.scalar(a, tree)?, self.scalar(b, tree)?, self.scalar(c, tree)?])
            }
            ExpressionKind::Own(name, arguments) => {
                let function = self.functions.get(&name.unraw().to_string()).ok_or_else(|| bug(e.span))?;
                let arguments = arguments.iter().map(|argument| self.scalar(argument, tree));
                Value::Scalar(self.graph.own(*function, &arguments.collect::<Result<Vec<_>>>()?))
            }
            ExpressionKind::Call(function, arguments) => match self.call(*function, arguments, e.span, tree)? {
                Value::Scalar(value) => Value::Scalar(self.in_range(value, e)),
                value => value,
            },
            ExpressionKind::Binary(operator, left, right) => {
                let value = self.value(left, tree)?;
                let other = match (operator, self.value(right, tree)?) {
                    (BinaryOperator::Divide, Value::Scalar(b)) => Value::Scalar(self.divisor(b, right.span)),
                    (_, other) => other,
                };
                match self.binary(*operator, value, other, tree).ok_or_else(|| bug(e.span))? {
                    Value::Scalar(value) => Value::Scalar(self.in_range(value, e)),
                    value => value,
                }
            }
        })
    }

    /// A literal; one of many digits is a constant of its own: nothing cancels against it, and products of several
    /// would have ever more digits.
    fn number(&self, value: Rational) -> Expr<'g> {
        if value.parts().is_some_and(|(numerator, denominator)| numerator.abs().max(denominator) <= EXACT) {
            return self.graph.number(value);
        }
        let noted = self.notes.read();
        let is_twin = |symbol: &Expr<'g>| noted.twins.iter().any(|(twin, _)| twin == symbol);
        if let Some((_, symbol)) = noted.literals.iter().find(|(known, symbol)| *known == value && !is_twin(symbol)) {
            return *symbol;
        }
        drop(noted);
        let symbol = self.literal(value);
        self.notes.add().literals.push((value, symbol));
        symbol
    }

    /// A number that differs among limbs that are alike: a constant of its own, so that these are computed alike.
    fn twin(&self, value: Rational, twin: Twin) -> Expr<'g> {
        let twin = limbs::slot(twin, 0);
        if let Some((symbol, _)) = self.notes.read().twins.iter().find(|(_, known)| *known == twin) {
            return *symbol;
        }
        let symbol = self.literal(value);
        self.graph.declare_alike(symbol, twin.slot as u64);
        let mut notes = self.notes.add();
        notes.twins.push((symbol, twin));
        notes.literals.push((value, symbol));
        symbol
    }

    fn literal(&self, value: Rational) -> Expr<'g> {
        // Of twins, some are negative.
        let written = |notation| match decimal(value, notation) {
            negative if value.is_negative() => format!("({negative})"),
            other => other,
        };
        self.graph.symbol(written(Notation::Text), written(Notation::Latex), true)
    }

    /// x^p: products where p is a small whole number, a root beside them for a half.
    fn power(&self, x: Expr<'g>, p: Expr<'g>, span: Span) -> Expr<'g> {
        const LARGEST: i64 = 20;
        match p.as_number().and_then(Rational::parts) {
            Some((n, d @ (1 | 2))) if n.abs() <= LARGEST * d => {
                let x = if n < 0 { self.divisor(x, span) } else { x };
                let root = if d == 2 { x.sqrt().powi((n.rem_euclid(2)) as i32) } else { self.graph.one() };
                x.powi(n.div_euclid(d) as i32) * root
            }
            _ => x.binary(BinaryFunction::Powf, p),
        }
    }

    /// Two vectors in axes that are theirs both: those of a link where it knows them, else the observer's.
    fn in_common_axes(&self, [a, b]: [&Expression; 2], tree: &Tree<'g>) -> Result<[Triple<'g>; 2]> {
        if let (Value::Local(a), Value::Local(b)) = (self.value(a, tree)?, self.value(b, tree)?)
            && let Some((_, both)) = a.together(&b, tree)
        {
            return Ok(both);
        }
        Ok([self.vector(a, tree)?, self.vector(b, tree)?])
    }

    fn property(&self, owner: &Expression, property: Property, tree: &Tree<'g>) -> Result<Value<'g>> {
        let ExpressionKind::Name(name) = &owner.kind else { return Err(bug(owner.span)) };
        let word = name.unraw().to_string();
        match self.names.get(&word) {
            Some(Value::Pose(_, position)) if property == Property::Position => {
                let here = tree.links.iter().position(|link| link.position == *position);
                let none = [self.graph.zero(); 3];
                return Ok(here.map_or(Value::Vector(*position), |k| Value::Local(Local::point(k, none, *position))));
            }
            Some(Value::Pose(rotation, _)) if property == Property::Rotation => {
                return Ok(Value::Rotation(vec![*rotation]));
            }
            Some(Value::Local(point)) if property == Property::Velocity => {
                return Ok(Value::Vector(point.observed.map(|e| e.derivative(&self.rates))));
            }
            Some(Value::Pose(..) | Value::Rotation(_)) => {
                return self.velocity_of_coordinate(&word, property).map(Value::Vector).ok_or_else(|| bug(owner.span));
            }
            _ => {}
        }
        if let Some(Value::Twist(force, torque)) = self.names.get(&word) {
            return match property {
                Property::Force => Ok(Value::Vector(*force)),
                Property::Torque => Ok(Value::Vector(*torque)),
                _ => Err(bug(owner.span)),
            };
        }
        let index = *self.links.get(&word).ok_or_else(|| bug(owner.span))?;
        let link = tree.links.get(index).ok_or_else(|| bug(owner.span))?;
        Ok(match property {
            Property::Position => Value::Local(Local::point(index, [self.graph.zero(); 3], link.position)),
            Property::Rotation => {
                // Its angular velocity is not asked for: rotations of bodies are named where vectors are turned.
                Value::Rotation(vec![RotationFactor::Given(Turn::given(link.rotation, [self.graph.zero(); 3]))])
            }
            Property::Force | Property::Torque => return Err(bug(owner.span)),
            _ => Value::Vector(self.velocity_of(index, property, tree)),
        })
    }

    /// A velocity of a coordinate that is a pose or a rotation, as the kinematics have it.
    pub(super) fn velocity_of_coordinate(&self, word: &str, property: Property) -> Option<Triple<'g>> {
        let own = self.model.coordinates.iter().position(|q| q.ident.unraw() == *word)?;
        let k = self.declared.before + own;
        let matrix = self.declared.coordinates[k].rotation()?;
        let rate = self.declared.rate_of(k, &self.kinematics);
        let triple = |at: usize| Some([*rate.get(at)?, *rate.get(at + 1)?, *rate.get(at + 2)?]);
        let omega = triple(rate.len().checked_sub(3)?)?;
        let turned =
            |v: Triple<'g>| std::array::from_fn(|i| (0..3).map(|j| matrix[i][j] * v[j]).sum::<Expr<'g>>().group());
        let [observed, observed_omega] = self.observed_rates[own];
        Some(match property {
            Property::BodyAngularVelocity => omega,
            Property::AngularVelocity => observed_omega.unwrap_or_else(|| turned(omega)),
            Property::BodyVelocity => triple(0)?,
            Property::Velocity => match observed {
                Some(velocity) => velocity,
                None => turned(triple(0)?),
            },
            _ => return None,
        })
    }

    /// A velocity of a link: of O or angular, in observer's axes or in its own.
    pub(super) fn velocity_of(&self, index: usize, property: Property, tree: &Tree<'g>) -> Triple<'g> {
        let link = &tree.links[index];
        if property == Property::RelativeVelocity {
            let u = self.velocity_of(index, Property::BodyVelocity, tree);
            // The medium is a checked vector of t and parameters: what cannot be translated is reported where it acts.
            return match self.stream(tree) {
                Ok(Some(stream)) => subtract(&u, &link.axes().to_body(&stream).map(Expr::group)),
                _ => u,
            };
        }
        match (property, &self.observed) {
            (Property::Velocity, Some(observed)) => observed.velocity,
            (Property::BodyVelocity, Some(observed)) => observed.body_velocity,
            (Property::AngularVelocity, Some(observed)) => observed.angular_velocity,
            (_, Some(observed)) => observed.body_angular_velocity,
            (Property::Velocity, None) => link.frame.resolve(&link.velocity, Axes::Space),
            (Property::BodyVelocity, None) => link.twist().0,
            (Property::AngularVelocity, None) => link.frame.to_space(&link.angular_velocity).map(Expr::group),
            (_, None) => link.twist().1,
        }
    }

    /// The same of vectors that links know, where the result is one.
    fn local(
        &self,
        operator: BinaryOperator,
        left: &Value<'g>,
        right: &Value<'g>,
        tree: &Tree<'g>,
    ) -> Option<Local<'g>> {
        use BinaryOperator::{Add, Divide, Multiply, Subtract};
        use Value::{Rotation, Scalar};
        match (operator, left, right) {
            (Add, Value::Local(a), Value::Local(b)) => a.plus(b, tree),
            (Subtract, Value::Local(a), Value::Local(b)) => a.minus(b, tree),
            (Multiply, Scalar(a), Value::Local(b)) | (Multiply, Value::Local(b), Scalar(a)) => b.map(|b| *a * b),
            (Divide, Value::Local(a), Scalar(b)) => a.map(|a| a * b.recip()),
            (Multiply, Rotation(pieces), Value::Vector(a)) => {
                let [piece] = pieces.as_slice() else { return None };
                let matrix = piece.matrix(self.graph);
                let turning = !matrix.iter().flatten().all(|e| e.is_constant());
                let link = tree.links.iter().position(|link| link.rotation == matrix).filter(|_| turning)?;
                Some(Local::turned(link, *a, tree))
            }
            _ => None,
        }
    }

    pub(super) fn binary(
        &self,
        operator: BinaryOperator,
        left: Value<'g>,
        right: Value<'g>,
        tree: &Tree<'g>,
    ) -> Option<Value<'g>> {
        use BinaryOperator::{Add, Divide, Multiply, Subtract};
        use Value::{Rotation, Scalar, Vector};
        if let Some(local) = self.local(operator, &left, &right, tree) {
            return Some(Value::Local(local));
        }
        Some(match (operator, left.observed(), right.observed()) {
            (Add, Scalar(a), Scalar(b)) => Scalar(a + b),
            (Add, Vector(a), Vector(b)) => Vector(std::array::from_fn(|i| a[i] + b[i])),
            (Subtract, Scalar(a), Scalar(b)) => Scalar(a - b),
            (Subtract, Vector(a), Vector(b)) => Vector(std::array::from_fn(|i| a[i] - b[i])),
            (Multiply, Scalar(a), Scalar(b)) => Scalar(a * b),
            (Multiply, Scalar(a), Vector(b)) | (Multiply, Vector(b), Scalar(a)) => Vector(b.map(|b| a * b)),
            (Multiply, Rotation(a), Rotation(b)) => Rotation(a.into_iter().chain(b).collect()),
            (Multiply, Rotation(a), Vector(b)) => Vector(a.iter().rev().fold(b, |b, piece| {
                let matrix = piece.matrix(self.graph);
                std::array::from_fn(|i| (0..3).map(|j| matrix[i][j] * b[j]).sum())
            })),
            (Divide, Scalar(a), Scalar(b)) => Scalar(a * b.recip()),
            (Divide, Vector(a), Scalar(b)) => Vector(a.map(|a| a * b.recip())),
            _ => return None,
        })
    }

    /// A function of one number, which is `x`, written as `written`.
    fn elementary(&self, function: FunctionName, x: Expr<'g>, written: &Expression) -> Expr<'g> {
        let quarters = || written.turns_of_pi().and(quarter_turns(written));
        let in_domain = || self.in_domain(function, x, written.span);
        let exact = |quarters: usize| self.graph.integer([0, 1, 0, -1][quarters % 4]);
        match function {
            FunctionName::Sin => quarters().map_or_else(|| x.sin(), exact),
            FunctionName::Cos => quarters().map_or_else(|| x.cos(), |quarters| exact(quarters + 1)),
            // The sine–cosine pair is shared with whatever else turns by the angle.
            FunctionName::Tan => x.sin() * x.cos().recip(),
            FunctionName::Asin => {
                let x = in_domain();
                x.binary(BinaryFunction::Atan2, x.leg())
            }
            FunctionName::Acos => {
                let x = in_domain();
                x.leg().binary(BinaryFunction::Atan2, x)
            }
            FunctionName::Atan => x.binary(BinaryFunction::Atan2, self.graph.one()),
            FunctionName::Tanh => self.graph.call(Function::Tanh, x),
            FunctionName::Exp => x.exp(),
            FunctionName::Ln => in_domain().ln(),
            FunctionName::Sqrt => in_domain().sqrt(),
            FunctionName::Abs => x.abs(),
            _ => self.graph.call(Function::Signum, x),
        }
    }

    /// 3s² − 2s³ of the way from one number to another.
    fn smooth_step(&self, [x, start, end]: [Expr<'g>; 3], span: Span) -> Expr<'g> {
        let s = (x - start) * self.width(end - start, span).group().recip();
        let s = clamped(s, [self.graph.zero(), self.graph.one()]).group();
        let three = self.graph.integer(3);
        s.powi(2) * (three - s.scale(Rational::from_integer(2))).group()
    }

    fn call(&self, function: FunctionName, arguments: &[Expression], span: Span, tree: &Tree<'g>) -> Result<Value<'g>> {
        let scalar = |e: &Expression| self.scalar(e, tree);
        let turn = |axis, angle: &Expression| {
            let piece = match quarter_turns(angle) {
                Some(quarters) => RotationFactor::quarters(self.graph, axis, quarters),
                None => RotationFactor::About(axis, scalar(angle)?),
            };
            Result::Ok(Value::Rotation(vec![piece]))
        };
        Ok(match (function, arguments) {
            (function, [a]) if function.is_elementary() => Value::Scalar(self.elementary(function, scalar(a)?, a)),
            (FunctionName::Powf, [a, p]) => {
                let x = self.in_domain(function, scalar(a)?, a.span);
                Value::Scalar(self.power(x, scalar(p)?, a.span))
            }
            (FunctionName::Atan2, [y, x]) => {
                let (b, a) = (scalar(y)?, scalar(x)?);
                Value::Scalar(self.ordinate([b, a], span).binary(BinaryFunction::Atan2, a))
            }
            (FunctionName::Min, [a, b]) => Value::Scalar(scalar(a)?.binary(BinaryFunction::Min, scalar(b)?)),
            (FunctionName::Max, [a, b]) => Value::Scalar(scalar(a)?.binary(BinaryFunction::Max, scalar(b)?)),
            (FunctionName::Clamp, [x, low, high]) => Value::Scalar(clamped(scalar(x)?, [scalar(low)?, scalar(high)?])),
            (FunctionName::SmoothStep, [x, from, to]) => {
                Value::Scalar(self.smooth_step([scalar(x)?, scalar(from)?, scalar(to)?], from.span))
            }
            (FunctionName::Hypot, [a, b]) => {
                let (a, b) = (scalar(a)?, scalar(b)?);
                Value::Scalar((a * a + b * b).sqrt())
            }
            (FunctionName::RotationX, [a]) => turn(0, a)?,
            (FunctionName::RotationY, [a]) => turn(1, a)?,
            (FunctionName::RotationZ, [a]) => turn(2, a)?,
            (FunctionName::Dot, [a, b]) => {
                let [a, b] = self.in_common_axes([a, b], tree)?;
                Value::Scalar(dot(&a, &b))
            }
            (FunctionName::Cross, [a, b]) => {
                let (a, b) = (self.vector(a, tree)?, self.vector(b, tree)?);
                Value::Vector(crate::mechanics::cross(&a, &b))
            }
            (FunctionName::Twist, [linear, angular]) => {
                Value::Twist(self.vector(linear, tree)?, self.vector(angular, tree)?)
            }
            (FunctionName::Inverse, [rotation]) => match self.value(rotation, tree)? {
                Value::Rotation(pieces) => Value::Rotation(pieces.iter().rev().map(RotationFactor::inverse).collect()),
                _ => return Err(bug(span)),
            },
            (FunctionName::Rate, [a]) => match self.value(a, tree)?.observed() {
                Value::Scalar(a) => Value::Scalar(a.derivative(&self.rates)),
                Value::Vector(a) => Value::Vector(a.map(|e| e.derivative(&self.rates))),
                _ => return Err(bug(span)),
            },
            _ => return Err(bug(span)),
        })
    }
}
