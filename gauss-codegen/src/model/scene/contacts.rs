//! Clauses of what may touch, checked.

use super::expression::Expression;
use proc_macro2::Ident;

/// `contact(name, …)`, or `range(name, …)`, which is one contact for each of its limits.
#[derive(Clone)]
pub struct ContactClause {
    /// Of each contact: one, or `x_from` and `x_to` of a range.
    pub names: Vec<Ident>,
    /// What may touch.
    pub touching: Touching,
    /// The coefficient μ: a scalar of t, q, z, inputs, fields and numbers; only with slip.
    pub friction: Option<Expression>,
    /// The coefficient e: a scalar of fields and numbers.
    pub restitution: Option<Expression>,
}

/// What may touch.
#[derive(Clone)]
pub enum Touching {
    /// `gap = …, slip = …`.
    Gap {
        /// A scalar of t and q that is not negative.
        gap: Expression,
        /// One or two scalars of t, q and z with friction, else none.
        slips: Vec<Expression>,
    },
    /// `point = …` of a point, a sphere or a rim.
    Point(Box<PointContact>),
    /// `along = …, from = …, to = …`: scalars of t and q. One limit at least.
    Range {
        /// What stays between the limits.
        along: Expression,
        /// The lower limit.
        from: Option<Expression>,
        /// The upper limit.
        to: Option<Expression>,
    },
}

/// A point, the sphere about it, or the rim of a disk about it, and what it may touch.
#[derive(Clone)]
pub struct PointContact {
    /// A vector of t and q: observer axes from Ω.
    pub point: Expression,
    /// Of the sphere: a scalar of fields and numbers.
    pub radius: Option<Expression>,
    /// Radius, and the axis in the axes of the body that has the point: of fields and numbers.
    pub rim: Option<[Expression; 2]>,
    /// What it may touch.
    pub against: Against,
}

/// What a point may touch.
#[derive(Clone)]
pub enum Against {
    /// A half space: below a plane.
    Plane {
        /// A vector of fields and numbers, observer axes, out of the half space; `None`: against a scalar gravity.
        normal: Option<Expression>,
        /// Of the plane from Ω along the normal: a scalar of t, fields and numbers.
        height: Option<Expression>,
        /// The first tangent up to a multiple of the normal: of fields and numbers.
        along: Option<Expression>,
    },
    /// A sphere about another point: a vector of t and q, and a scalar of fields and numbers.
    Sphere { center: Expression, radius: Option<Expression> },
}

impl PointContact {
    /// Its points, radii and heights.
    pub fn lengths(&self) -> Vec<&Expression> {
        let of_rim = self.rim.iter().map(|[radius, _]| radius);
        let own = std::iter::once(&self.point).chain(&self.radius).chain(of_rim);
        match &self.against {
            Against::Plane { height, .. } => own.chain(height).collect(),
            Against::Sphere { center, radius } => own.chain([center]).chain(radius).collect(),
        }
    }

    fn each_expression(&mut self, change: &mut dyn FnMut(&mut Expression)) {
        change(&mut self.point);
        self.radius.iter_mut().chain(self.rim.iter_mut().flatten()).for_each(&mut *change);
        match &mut self.against {
            Against::Plane { normal, height, along } => {
                normal.iter_mut().chain(height).chain(along).for_each(change);
            }
            Against::Sphere { center, radius } => {
                change(center);
                radius.iter_mut().for_each(change);
            }
        }
    }
}

impl ContactClause {
    /// Calls `change` with each of its expressions.
    pub fn each_expression(&mut self, change: &mut dyn FnMut(&mut Expression)) {
        match &mut self.touching {
            Touching::Gap { gap, slips } => {
                change(gap);
                slips.iter_mut().for_each(&mut *change);
            }
            Touching::Point(contact) => contact.each_expression(change),
            Touching::Range { along, from, to } => {
                change(along);
                from.iter_mut().chain(to).for_each(&mut *change);
            }
        }
        self.friction.iter_mut().chain(&mut self.restitution).for_each(change);
    }
}
