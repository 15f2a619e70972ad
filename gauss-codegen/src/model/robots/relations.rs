//! Relations of links besides the tree: points and rotations in common, coordinates that are polynomials of others.

use super::clauses::Robot;
use crate::model::scene::clauses::{ConstraintClause, ConstraintLevel};
use crate::model::scene::expression::{BinaryOperator, Expression, FunctionName, Property};
use gauss_robots::description::{At, Closure, Polynomial, Turn};
use gauss_robots::located;
use gauss_robots::rotation::{Rotation, Triple};

impl Robot<'_> {
    /// Links that have a point in common, or a place; coordinates that others determine.
    pub fn constraints(&self, names: &[String]) -> Vec<ConstraintClause> {
        let clause = |at: At, expression: Expression| ConstraintClause {
            kind: ConstraintLevel::Position,
            expression,
            vector: false,
            place: Some(located(names, at, "")),
            span: self.writer.span,
        };
        let open = self.description.closures.iter().filter(|closure| !self.is_held_together(closure));
        let closures = open.flat_map(|closure| {
            self.closure(closure).unwrap_or_default().into_iter().map(|expression| clause(closure.at, expression))
        });
        let still = |along: &Vec<(String, f64)>| self.is_still(along);
        let moves = |relation: &&Polynomial| !(still(&relation.along) && relation.of.as_ref().is_none_or(still));
        let polynomials = self.description.polynomials.iter().filter(moves);
        let polynomials =
            polynomials.filter_map(|polynomial| Some(clause(polynomial.at, self.polynomial(polynomial)?)));
        closures.chain(polynomials).collect()
    }

    fn closure(&self, closure: &Closure) -> Option<Vec<Expression>> {
        let writer = self.writer;
        let index = |name: &String| self.description.links.iter().position(|link| link.name == *name);
        let [first, second] = [index(&closure.links[0])?, index(&closure.links[1])?];
        let (other, turn) = match closure.turn {
            Some(Turn::To(turn)) => ([0.0; 3], Some(turn)),
            turn => {
                let other = self.structure.opposite(self.description, [first, second], &closure.anchor);
                (other, turn.map(|_| self.structure.turn_at_rest(self.description, [first, second])))
            }
        };
        let axes = self.axes([first, second]);
        let [a, b] = [(first, &closure.anchor), (second, &other)].map(|(link, point)| {
            let turned = writer.triple(point).map(|point| self.turned(link, axes, point));
            match (self.origin(link, axes), turned) {
                (Some(origin), Some(turned)) => writer.plus(origin, turned),
                (origin, turned) => {
                    origin.or(turned).unwrap_or_else(|| writer.vector([0.0; 3].map(|c| writer.number(c))))
                }
            }
        });
        let mut all = vec![writer.binary(BinaryOperator::Subtract, a, b)];
        if let Some(turn) = turn {
            all.extend(self.axes_in_common([first, second], &turn));
        }
        Some(all)
    }

    /// Link that a loop of these links hangs on, if it moves: in the axes of this link a loop that stays in a plane
    /// stays in the same.
    fn axes(&self, links: [usize; 2]) -> Option<usize> {
        let parent_of = &self.structure.parent_of;
        let chain = |link: usize| std::iter::successors(Some(link), |&link| parent_of[link]);
        let common = chain(links[0]).find(|&link| chain(links[1]).any(|other| other == link));
        common.filter(|&link| self.moves(link))
    }

    /// A vector of a link in the axes of one that it hangs on, or of the observer.
    fn turned(&self, link: usize, axes: Option<usize>, vector: Expression) -> Expression {
        let Some(axes) = axes else {
            return self.writer.times(self.writer.property(&self.links[link], Property::Rotation), vector);
        };
        let turn = |vector, link| match self.placement(link) {
            [_, Some(rotation)] => self.writer.times(rotation, vector),
            [_, None] => vector,
        };
        self.chain(link, axes).fold(vector, turn)
    }

    /// Position of a link from one that it hangs on, in its axes, or from Ω; none where it is there always.
    fn origin(&self, link: usize, axes: Option<usize>) -> Option<Expression> {
        let Some(axes) = axes else { return Some(self.writer.property(&self.links[link], Property::Position)) };
        self.chain(link, axes).fold(None, |point: Option<Expression>, link| {
            let [position, rotation] = self.placement(link);
            let turned = point.map(|point| match rotation {
                Some(rotation) => self.writer.times(rotation, point),
                None => point,
            });
            match (position, turned) {
                (Some(position), Some(turned)) => Some(self.writer.plus(position, turned)),
                (position, turned) => position.or(turned),
            }
        })
    }

    /// A link and what it hangs on, below another.
    fn chain(&self, link: usize, end: usize) -> impl Iterator<Item = usize> {
        let parent_of = &self.structure.parent_of;
        std::iter::successors(Some(link), |&link| parent_of[link]).take_while(move |&link| link != end)
    }

    /// Axes of two links are the same, those of the second turned back: three products that are zero where they are.
    fn axes_in_common(&self, links: [usize; 2], turn: &[Triple; 3]) -> Vec<Expression> {
        let writer = self.writer;
        let axes = self.axes(links);
        let along = |link: usize, axis: Triple| self.turned(link, axes, writer.vector(axis.map(|c| writer.number(c))));
        let product = |i: usize| {
            let j = (i + 1) % 3;
            // Axis i of the first, and what is its axis j while the turn holds, in the axes of the second.
            let own: Triple = Rotation::none().matrix[i];
            let other: Triple = std::array::from_fn(|k| turn[j][k]);
            writer.call(FunctionName::Dot, vec![along(links[0], own), along(links[1], other)])
        };
        (0..3).map(product).collect()
    }

    /// l₁ − Σ cₖ l₂ᵏ, with l = Σ c (q − r), of one joint q − r.
    fn polynomial(&self, polynomial: &Polynomial) -> Option<Expression> {
        let writer = self.writer;
        let from_reference = |(name, factor): &(String, f64)| {
            let joint = self.description.joints.iter().position(|joint| joint.name == *name)?;
            let reference = self.description.joints[joint].reference;
            let value = self.values(joint, reference).into_iter().next()?;
            Some(if *factor == 1.0 { value } else { writer.times(writer.number(*factor), value) })
        };
        let length = |along: &Vec<(String, f64)>| {
            let terms: Option<Vec<Expression>> = along.iter().map(from_reference).collect();
            terms?.into_iter().reduce(|a, b| writer.plus(a, b))
        };
        let value = length(&polynomial.along)?;
        let of = polynomial.of.as_ref().and_then(length);
        let [lowest, rest @ ..] = polynomial.coefficients;
        let mut sum = writer.number(lowest);
        let mut power = of.clone();
        for coefficient in rest {
            let Some(term) = power.take() else { break };
            power = of.as_ref().map(|of| writer.times(term.clone(), of.clone()));
            if coefficient != 0.0 {
                sum = writer.plus(sum, writer.times(writer.number(coefficient), term));
            }
        }
        Some(writer.binary(BinaryOperator::Subtract, value, sum))
    }
}
