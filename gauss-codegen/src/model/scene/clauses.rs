//! The clauses of a scene, checked: coordinates and speeds, bodies and particles, constraints, functions and inputs.

use super::expression::Expression;
use crate::terms::{Role, Shape};
use proc_macro2::Span;
use syn::Ident;

/// One coordinate, or three or six that are an element of a group.
#[derive(Clone)]
pub struct CoordinateClause {
    /// Its name.
    pub ident: Ident,
    /// Kind of its values.
    pub kind: CoordinateKind,
}

/// Kinds of values of coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CoordinateKind {
    /// The real numbers.
    Scalar,
    /// SE(3): (R, b).
    Pose,
    /// SO(3): R.
    Rotation,
}

/// A state of an element: a number that changes at a given rate, and moves no body.
#[derive(Clone)]
pub struct ElementState {
    /// Its name.
    pub ident: Ident,
    /// ẋ = f(t, q, z, x, input): a scalar of all that is known at an instant.
    pub rate: Expression,
}

/// One speed, or three under one name.
#[derive(Clone)]
pub struct Speed {
    /// Its name.
    pub ident: Ident,
    /// Number of speeds that it stands for.
    pub kind: SpeedKind,
}

/// A speed, or one component of a vector of speeds: `w`, `w.x`.
#[derive(Clone)]
pub struct SpeedPart {
    /// The name of the speed.
    pub ident: Ident,
    /// The component; `None`: all of it.
    pub component: Option<usize>,
}

impl std::fmt::Display for SpeedPart {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.component {
            Some(k) => write!(f, "{}.{}", self.ident, ["x", "y", "z"][k % 3]),
            None => self.ident.fmt(f),
        }
    }
}

/// Number of speeds under one name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpeedKind {
    /// One.
    Scalar,
    /// Three.
    Vector,
}

/// `body(name, parent = …, position = …, rotation = …)` or `frame(name, …)`.
#[derive(Clone)]
pub struct BodyClause {
    /// Name of a frame, or of a body: of the field with its mass data, unless they are given here; `None` for the only
    /// body, whose mass data are the fields with roles. Frames have names.
    pub name: Option<Ident>,
    /// It is a frame: axes with an origin and no mass.
    pub massless: bool,
    /// The body or frame whose O and axes position and rotation are relative to; `None`: Ω and k.
    pub parent: Option<Ident>,
    /// The position of O; `None`: at the parent's O, or at Ω, or given by the chart.
    pub position: Option<Expression>,
    /// The rotation of the axes e; `None`: like the parent's, or like k, or given by the chart.
    pub rotation: Option<Expression>,
    /// Mass, centre of mass and inertia where the body has no field; what the fluid about it does, in any case.
    pub role_clauses: Vec<RoleClause>,
    /// The word `body` or `frame`.
    pub span: Span,
}

impl BodyClause {
    /// Its mass data are said in the clause.
    pub fn has_matter(&self) -> bool {
        self.role_clauses.iter().any(|clause| clause.role.is_of_matter())
    }
}

/// `particle(mass = …, position = …, parent = …)`.
#[derive(Clone)]
pub struct ParticleClause {
    /// A scalar of t, fields and numbers.
    pub mass: Expression,
    /// A vector of t and q: in the axes of the parent from its O, or in observer axes from Ω.
    pub position: Expression,
    /// The body or frame that the position is relative to.
    pub parent: Option<Ident>,
    /// The word `particle`.
    #[allow(dead_code, reason = "where a mistake about the whole clause belongs")]
    pub span: Span,
}

/// `point(name, body = …, at = …)`.
#[derive(Clone)]
pub struct PointClause {
    /// In expressions the name is the position vector from Ω, in observer axes.
    pub name: Ident,
    /// The body or frame that the point is fixed in.
    pub body: Ident,
    /// A vector of fields and numbers: body axes from O.
    pub at: Expression,
    /// The word `point`.
    pub span: Span,
}

/// `constraint(position = …)` or `constraint(velocity = …)`: the expression is zero.
#[derive(Clone)]
pub struct ConstraintClause {
    /// Level of the constraint.
    pub kind: ConstraintLevel,
    /// A scalar or a vector: of t and q; of t, q and z if velocities are constrained.
    pub expression: Expression,
    /// The expression is a vector: three constraints.
    pub vector: bool,
    /// Place in the file of a robot.
    pub place: Option<String>,
    /// The word `constraint`.
    pub span: Span,
}

/// Levels of constraints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConstraintLevel {
    /// φ(t, q) = 0.
    Position,
    /// φ(t, q, z) = 0.
    Velocity,
}

/// Coefficients of a drag, or an added mass, in body axes, pole O, order (u, ω).
#[derive(Clone)]
pub enum Coefficients {
    /// `[a, b, c, d, e, f]`: one for each component, scalars as in values of forces.
    Diagonal([Box<Expression>; 6]),
    /// A field that is a `Vector6`, one for each component, or a `Matrix6`.
    Field(Ident),
}

impl Coefficients {
    pub fn each_expression(&mut self, change: &mut dyn FnMut(&mut Expression)) {
        if let Coefficients::Diagonal(entries) = self {
            entries.iter_mut().for_each(|entry| change(entry));
        }
    }

    pub fn entries(&self) -> impl Iterator<Item = &Expression> {
        let entries = match self {
            Coefficients::Diagonal(entries) => Some(entries),
            Coefficients::Field(_) => None,
        };
        entries.into_iter().flatten().map(|entry| &**entry)
    }
}

/// `role = value`, of the body that has it.
#[derive(Clone)]
pub struct RoleClause {
    /// Any but that of being a body.
    pub role: Role,
    /// Scalar or vector; of an added mass six, or six by six.
    pub shape: Shape,
    /// Value, made of fields and numbers; of mass data also of t.
    pub value: RoleValue,
    /// The word of the role.
    pub span: Span,
}

/// Value that is given to a role.
#[derive(Clone)]
pub enum RoleValue {
    /// A scalar or a vector.
    Expression(Expression),
    /// An added mass.
    Coefficients(Coefficients),
}
