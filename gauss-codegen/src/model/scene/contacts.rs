//! Clauses of what may touch, checked.

use super::expression::Expression;
use proc_macro2::Ident;

/// `contact(name, …)`, one contact or one for each part of a shape; `range(name, …)`, one for each of its limits; or
/// `dry_friction(name, …)`.
#[derive(Clone)]
pub struct ContactClause {
    /// Names of the contacts: one, `box_0` and so on, or `x_from` and `x_to` of a range.
    pub names: Vec<Ident>,
    /// Parts that may touch.
    pub touching: ContactGeometry,
    /// The coefficient μ, or those of two tangents; of dry friction the bounds of its force. Scalars of t, q, z,
    /// inputs, fields and numbers; only with slip.
    pub friction: Vec<Expression>,
    /// The coefficient e: a scalar of fields and numbers.
    pub restitution: Option<Expression>,
    /// The radius of friction of drilling: a scalar of fields and numbers; only with friction, and spin.
    pub drilling: Option<Expression>,
    /// The arm ρ of rolling resistance, a scalar as `friction`; only with that. Each contact has another one with it,
    /// whose name follows its own among the names.
    pub rolling: Option<Expression>,
    /// Made of the file of a robot: friction that does nothing is no mistake.
    pub of_file: bool,
    /// The links of a file whose shapes touch; of what is written its points say that.
    pub links: [Option<Ident>; 2],
}

/// Ways in which parts may touch.
#[derive(Clone)]
pub enum ContactGeometry {
    /// `gap = …, slip = …, spin = …, roll = …`.
    Gap {
        /// A scalar of t and q that is not negative.
        gap: Expression,
        /// One or two scalars of t, q and z with friction, else none.
        slips: Vec<Expression>,
        /// The angular velocity about the normal with drilling, a scalar of t, q and z.
        spin: Option<Expression>,
        /// The same about the tangents with rolling, one or two.
        rolls: Vec<Expression>,
    },
    /// `point = …` of a point, a sphere or a rim.
    Point(Box<PointContact>),
    /// `slip = …` of dry friction: one or two scalars of t, q and z.
    Slip {
        /// Velocities that friction resists.
        slips: Vec<Expression>,
        /// The only one is the name of a coordinate, whose rate is meant, or of a speed.
        named: bool,
    },
    /// `along = …, from = …, to = …`: scalars of t and q. One limit at least.
    Range {
        /// Length or angle that stays between the limits.
        along: Expression,
        /// The lower limit.
        from: Option<Expression>,
        /// The upper limit.
        to: Option<Expression>,
    },
}

/// A point, the sphere or the ellipsoid about it, or the rim of a disk about it, perhaps at several places, and what it
/// may touch.
#[derive(Clone)]
pub struct PointContact {
    /// A vector of t and q: observer axes from Ω.
    pub point: Expression,
    /// Radius of the sphere: a scalar of fields and numbers.
    pub radius: Option<Expression>,
    /// Radius, and the axis in the axes of the body that has the point: of fields and numbers.
    pub rim: Option<[Expression; 2]>,
    /// Semi-axes of the ellipsoid along the axes of the body that has the point: scalars of fields and numbers.
    pub semi_axes: Option<[Expression; 3]>,
    /// Other places where it is.
    pub copies: Copies,
    /// Counterpart that it may touch.
    pub against: Counterpart,
}

/// The places of the same body at which a point, a sphere or a rim is: each is a contact of its own.
#[derive(Clone)]
pub enum Copies {
    /// The point.
    One,
    /// `edges = [a, b, c]`, fields and numbers: the corners of a box about the point, along the axes of its body. Along
    /// an edge that is written 0 there is one corner.
    Corners([Expression; 3]),
    /// `end = …`: the point, and this one, a vector of t and q.
    Ends(Expression),
    /// `length = …` of fields and numbers: half of it before and behind the point along the axis of the rim.
    Rims(Expression),
}

impl Copies {
    /// Number of the copies.
    pub fn count(&self) -> usize {
        match self {
            Self::One => 1,
            Self::Corners(edges) => 1 << edges.iter().filter(|edge| !Self::is_flat(edge)).count(),
            Self::Ends(_) | Self::Rims(_) => 2,
        }
    }

    /// An edge that is written 0.
    pub fn is_flat(edge: &Expression) -> bool {
        edge.literal() == Some(0.0)
    }

    /// Its points and lengths.
    fn expressions(&self) -> &[Expression] {
        match self {
            Self::One => &[],
            Self::Corners(edges) => edges,
            Self::Ends(one) | Self::Rims(one) => std::slice::from_ref(one),
        }
    }

    fn expressions_mut(&mut self) -> &mut [Expression] {
        match self {
            Self::One => &mut [],
            Self::Corners(edges) => edges,
            Self::Ends(one) | Self::Rims(one) => std::slice::from_mut(one),
        }
    }
}

/// Counterparts that a point may touch.
#[derive(Clone)]
pub enum Counterpart {
    /// A half space: below a plane.
    Plane {
        /// A vector of fields and numbers, observer axes, out of the half space; `None`: against a scalar gravity.
        normal: Option<Expression>,
        /// Height of the plane from Ω along the normal: a scalar of t, fields and numbers.
        height: Option<Expression>,
        /// The first tangent up to a multiple of the normal: of fields and numbers.
        along: Option<Expression>,
    },
    /// Ground below a height, a scalar of t, fields, numbers and the [horizontal
    /// place](super::expression::ExpressionKind::Horizontal).
    Ground(Expression),
    /// A sphere about another point, or a capsule from there to an end: vectors of t and q, and a scalar of fields and
    /// numbers; with friction a direction that the line of centers never has, of fields and numbers.
    Sphere { center: Expression, end: Option<Expression>, radius: Option<Expression>, along: Option<Expression> },
}

impl PointContact {
    /// Points that it is between.
    pub fn places(&self) -> impl Iterator<Item = &Expression> {
        let other = match &self.against {
            Counterpart::Sphere { center, .. } => Some(center),
            Counterpart::Plane { .. } | Counterpart::Ground(_) => None,
        };
        let end = match &self.copies {
            Copies::Ends(end) => Some(end),
            _ => None,
        };
        std::iter::once(&self.point).chain(other).chain(end)
    }

    /// Its points, lengths, radii and heights.
    pub fn lengths(&self) -> Vec<&Expression> {
        let of_rim = self.rim.iter().map(|[radius, _]| radius);
        let own = std::iter::once(&self.point).chain(&self.radius).chain(of_rim);
        let own = own.chain(self.semi_axes.iter().flatten()).chain(self.copies.expressions());
        match &self.against {
            Counterpart::Plane { height, .. } => own.chain(height).collect(),
            Counterpart::Ground(height) => own.chain([height]).collect(),
            Counterpart::Sphere { center, end, radius, .. } => own.chain([center]).chain(end).chain(radius).collect(),
        }
    }

    fn each_expression(&mut self, change: &mut dyn FnMut(&mut Expression)) {
        change(&mut self.point);
        let copies = self.copies.expressions_mut();
        let about = self.radius.iter_mut().chain(self.rim.iter_mut().flatten());
        about.chain(self.semi_axes.iter_mut().flatten()).chain(copies).for_each(&mut *change);
        match &mut self.against {
            Counterpart::Plane { normal, height, along } => {
                normal.iter_mut().chain(height).chain(along).for_each(change);
            }
            Counterpart::Ground(height) => change(height),
            Counterpart::Sphere { center, end, radius, along } => {
                change(center);
                end.iter_mut().chain(radius).chain(along).for_each(change);
            }
        }
    }
}

impl ContactClause {
    /// Calls `change` with each of its expressions.
    pub fn each_expression(&mut self, change: &mut dyn FnMut(&mut Expression)) {
        match &mut self.touching {
            ContactGeometry::Gap { gap, slips, spin, rolls } => {
                change(gap);
                slips.iter_mut().chain(spin).chain(rolls).for_each(&mut *change);
            }
            ContactGeometry::Point(contact) => contact.each_expression(change),
            ContactGeometry::Slip { slips, .. } => slips.iter_mut().for_each(&mut *change),
            ContactGeometry::Range { along, from, to } => {
                change(along);
                from.iter_mut().chain(to).for_each(&mut *change);
            }
        }
        let of_turns = self.drilling.iter_mut().chain(&mut self.rolling);
        self.friction.iter_mut().chain(&mut self.restitution).chain(of_turns).for_each(change);
    }
}
