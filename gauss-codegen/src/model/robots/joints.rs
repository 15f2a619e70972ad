//! Pose of the link of a joint, as expressions of its coordinates.

use std::f64::consts::{FRAC_PI_2, PI};

use proc_macro2::{Ident, Span};

use crate::model::scene::expression::{BinaryOperator, Expression, ExpressionKind, FunctionName, Property};
use crate::terms::number::shortest;
use gauss_robots::Coupling;
use gauss_robots::description::{Joint, JointKind};
use gauss_robots::rotation::{Rotation, Triple, turned};

/// Writes expressions, all of them at one token.
#[derive(Clone, Copy)]
pub struct ExpressionWriter {
    pub span: Span,
}

impl ExpressionWriter {
    pub fn expression(self, kind: ExpressionKind) -> Expression {
        Expression { kind, span: self.span }
    }

    /// A number as it would be written: the shortest decimal fraction that is read as it.
    pub fn number(self, value: f64) -> Expression {
        let number = self.expression(ExpressionKind::Number { value: shortest(value.abs()), twin: None });
        if value < 0.0 { self.negative(number) } else { number }
    }

    pub fn name(self, name: &Ident) -> Expression {
        self.expression(ExpressionKind::Name(name.clone()))
    }

    pub fn negative(self, e: Expression) -> Expression {
        self.expression(ExpressionKind::Negate(Box::new(e)))
    }

    pub fn binary(self, operator: BinaryOperator, a: Expression, b: Expression) -> Expression {
        self.expression(ExpressionKind::Binary(operator, Box::new(a), Box::new(b)))
    }

    pub fn times(self, a: Expression, b: Expression) -> Expression {
        self.binary(BinaryOperator::Multiply, a, b)
    }

    pub fn plus(self, a: Expression, b: Expression) -> Expression {
        self.binary(BinaryOperator::Add, a, b)
    }

    pub fn call(self, function: FunctionName, arguments: Vec<Expression>) -> Expression {
        self.expression(ExpressionKind::Call(function, arguments))
    }

    pub fn vector(self, components: [Expression; 3]) -> Expression {
        self.expression(ExpressionKind::Vector(components.map(Box::new)))
    }

    /// `None` for the zero vector.
    pub fn triple(self, v: &Triple) -> Option<Expression> {
        (*v != [0.0; 3]).then(|| self.vector(v.map(|c| self.number(c))))
    }

    pub fn property(self, name: &Ident, property: Property) -> Expression {
        self.expression(ExpressionKind::Property(Box::new(self.name(name)), property))
    }

    fn about(self, axis: usize, angle: Expression) -> Expression {
        let turns = [FunctionName::RotationX, FunctionName::RotationY, FunctionName::RotationZ];
        self.call(turns[axis], vec![angle])
    }

    /// A constant turn; nothing if it is none.
    fn turn(self, axis: usize, angle: f64) -> Option<Expression> {
        (angle != 0.0).then(|| self.about(axis, self.number(angle)))
    }

    fn constant(self, rotation: &Rotation) -> Vec<Expression> {
        [2, 1, 0].into_iter().filter_map(|axis| self.turn(axis, rotation.angles[axis])).collect()
    }

    /// Turns by `angle` about an axis of any direction: about an axis of the frame that is turned there and back.
    fn about_direction(self, axis: &Triple, angle: Expression) -> Vec<Expression> {
        let (own, there) = aligned(axis);
        let opposite = there.is_empty() && axis[own] < 0.0;
        let angle = if opposite { self.negative(angle) } else { angle };
        let forward = there.iter().filter_map(|&(axis, angle)| self.turn(axis, angle));
        let back = there.iter().rev().filter_map(|&(axis, angle)| self.turn(axis, -angle));
        forward.chain([self.about(own, angle)]).chain(back).collect()
    }

    fn product(self, factors: Vec<Expression>) -> Option<Expression> {
        factors.into_iter().reduce(|a, b| self.times(a, b))
    }

    /// From the axes of a frame to those of its parent; `None` where they are the same.
    pub fn rotation(self, rotation: &Rotation) -> Option<Expression> {
        self.product(self.constant(rotation))
    }

    /// Coordinate of a joint, given that of the one it follows.
    pub fn coupled(self, leader: &Ident, coupling: &Coupling) -> Expression {
        let scaled = match coupling.multiplier {
            1.0 => self.name(leader),
            -1.0 => self.negative(self.name(leader)),
            multiplier => self.times(self.number(multiplier), self.name(leader)),
        };
        if coupling.offset == 0.0 { scaled } else { self.plus(scaled, self.number(coupling.offset)) }
    }

    /// Position and rotation of the link of a joint, relative to its parent; `coordinates` are those that it moves
    /// by, one or, in a plane, three.
    pub fn placed(self, joint: &Joint, coordinates: &[Expression]) -> [Option<Expression>; 2] {
        let fixed = self.constant(&joint.rotation);
        match (joint.kind, coordinates) {
            (JointKind::Turning, [angle]) if !angle.is_zero() => {
                let turns = self.about_direction(&joint.axis, angle.clone());
                [self.triple(&joint.position), self.product(fixed.into_iter().chain(turns).collect())]
            }
            (JointKind::Sliding, [way]) => {
                let along = turned(&joint.rotation.matrix, &joint.axis);
                [Some(self.moved(&joint.position, &[(along, way)])), self.product(fixed)]
            }
            (JointKind::Planar, [x, y, angle]) => {
                let [e, f] = in_plane(&joint.axis).map(|way| turned(&joint.rotation.matrix, &way));
                let turns = self.about_direction(&joint.axis, angle.clone());
                let rotation = self.product(fixed.into_iter().chain(turns).collect());
                [Some(self.moved(&joint.position, &[(e, x), (f, y)])), rotation]
            }
            _ => [self.triple(&joint.position), self.product(fixed)],
        }
    }

    /// The same of a joint whose coordinate is a rotation.
    pub fn ball(self, joint: &Joint, rotation: &Ident) -> [Option<Expression>; 2] {
        let factors = self.constant(&joint.rotation).into_iter().chain([self.name(rotation)]).collect();
        [self.triple(&joint.position), self.product(factors)]
    }

    /// The same of a joint whose coordinate is a pose.
    pub fn floating(self, joint: &Joint, pose: &Ident) -> [Option<Expression>; 2] {
        let (position, rotation) = (self.property(pose, Property::Position), self.property(pose, Property::Rotation));
        let fixed = self.product(self.constant(&joint.rotation));
        let position = match &fixed {
            Some(fixed) => self.times(fixed.clone(), position),
            None => position,
        };
        let position = match self.triple(&joint.position) {
            Some(origin) => self.plus(origin, position),
            None => position,
        };
        let factors = fixed.into_iter().chain([rotation]).collect();
        [Some(position), self.product(factors)]
    }

    /// A point that coordinates move along directions, component by component.
    fn moved(self, origin: &Triple, ways: &[(Triple, &Expression)]) -> Expression {
        let component = |i: usize| {
            let terms = ways.iter().filter(|(along, _)| along[i] != 0.0).map(|(along, way)| match along[i] {
                1.0 => (*way).clone(),
                -1.0 => self.negative((*way).clone()),
                factor => self.times(self.number(factor), (*way).clone()),
            });
            let start = (origin[i] != 0.0).then(|| self.number(origin[i]));
            start.into_iter().chain(terms).reduce(|a, b| self.plus(a, b)).unwrap_or_else(|| self.number(0.0))
        };
        self.vector([component(0), component(1), component(2)])
    }
}

/// An axis of the frame, and the turns, the outermost first, that bring it to a direction.
fn aligned(axis: &Triple) -> (usize, Vec<(usize, f64)>) {
    let [x, y, z] = *axis;
    match [x == 0.0, y == 0.0, z == 0.0] {
        [_, true, true] => (0, Vec::new()),
        [true, _, true] => (1, Vec::new()),
        [true, true, _] => (2, Vec::new()),
        [false, false, true] => (0, vec![(2, y.atan2(x))]),
        [false, true, false] => (2, vec![(1, x.atan2(z))]),
        [true, false, false] => (1, vec![(0, z.atan2(y))]),
        _ => (2, vec![(2, y.atan2(x)), (1, x.hypot(y).atan2(z))]),
    }
}

/// Two directions that make a right-handed frame with a normal: those of the frame that is turned to it.
fn in_plane(normal: &Triple) -> [Triple; 2] {
    let angles = match normal {
        [0.0, 0.0, z] => [if *z < 0.0 { PI } else { 0.0 }, 0.0, 0.0],
        // The third axis comes to lie along the first or the second.
        [x, 0.0, 0.0] => [0.0, x.signum() * FRAC_PI_2, 0.0],
        [0.0, y, 0.0] => [-y.signum() * FRAC_PI_2, 0.0, 0.0],
        [x, y, z] => [0.0, x.hypot(*y).atan2(*z), y.atan2(*x)],
    };
    let matrix = Rotation::from_angles(angles).matrix;
    [0, 1].map(|k| std::array::from_fn(|i| matrix[i][k]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use gauss_robots::rotation::direction;

    /// The turns bring the axis of the frame to the direction.
    #[test]
    fn axes_of_any_direction() {
        for written in [[1.0, 2.0, 0.0], [1.0, 0.0, -3.0], [0.0, -1.0, 0.5], [0.3, -0.4, -0.7], [-1.0, -1.0, 1.0]] {
            let axis = direction(written).unwrap();
            let (own, turns) = aligned(&axis);
            let mut v: Triple = std::array::from_fn(|i| f64::from(u8::from(i == own)));
            for (about, angle) in turns.into_iter().rev() {
                let mut angles = [0.0; 3];
                angles[about] = angle;
                v = turned(&Rotation::from_angles(angles).matrix, &v);
            }
            for i in 0..3 {
                assert!((v[i] - axis[i]).abs() < 4.0 * f64::EPSILON, "{written:?}: {v:?}");
            }
            let [e, f] = in_plane(&axis);
            for i in 0..3 {
                let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                assert!((e[j] * f[k] - e[k] * f[j] - axis[i]).abs() < 4.0 * f64::EPSILON, "{written:?}");
            }
        }
    }
}
