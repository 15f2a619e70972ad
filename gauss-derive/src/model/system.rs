//! A system as the user wrote it, checked: own coordinates and speeds, bodies and particles.

use super::{Expression, Role, Scalar, Shape};
use proc_macro2::Span;
use syn::{Generics, Ident, Path, Visibility};

/// Any system that the Gauss condition covers, in its own coordinates q and speeds z.
#[derive(Clone)]
pub struct SystemModel {
    /// Name of the struct.
    pub ident: Ident,
    /// Visibility of the struct; the kernel gets the same.
    pub visibility: Visibility,
    /// Generics of the struct: type parameters only.
    pub generics: Generics,
    /// The one scalar of every field with a role and of every field that an expression names; `f64` if there are none.
    pub scalar: Scalar,
    /// Where the generated code finds the runtime: `::gauss_runtime`, or what `crate = path` says.
    pub runtime: Path,
    /// Every field of the struct, in order.
    pub fields: Vec<SystemField>,
    /// The coordinates q, in order.
    pub coordinates: Vec<Ident>,
    /// The speeds z, in order; `None` for the jet chart z = q̇.
    pub speeds: Option<Vec<Ident>>,
    /// q̇ = ψ(t, q, z) of (3.2): one for each coordinate, in the order of the coordinates; empty in the jet chart.
    pub kinematics: Vec<(Ident, Expression)>,
    /// The bodies, in the order in which they are written: a parent may come after its child.
    pub bodies: Vec<BodyClause>,
    /// The particles of (3.3).
    pub particles: Vec<ParticleClause>,
    /// The potential energy besides that of gravity: a scalar of t and q.
    pub potential: Option<Expression>,
}

/// One field of the struct of a system.
#[derive(Clone)]
pub struct SystemField {
    /// Name of the field.
    pub ident: Ident,
    /// What the field means to the unnamed body, or that it is a named one; `None` for a plain parameter.
    pub role: Option<Role>,
    /// Shape of the value. A plain parameter whose scalar is not the scalar of the model is [`Shape::Other`].
    pub shape: Shape,
    /// Its doc comment, trimmed; empty when it has none.
    pub documentation: String,
}

/// `body(name, parent = …, position = …, rotation = …)`.
#[derive(Clone)]
pub struct BodyClause {
    /// The field with its mass data; `None` for the only body, whose mass data are the fields with roles.
    pub name: Option<Ident>,
    /// The body whose O and axes position and rotation are relative to; `None`: Ω and k.
    pub parent: Option<Ident>,
    /// Where O is; `None`: at the parent's O, or at Ω.
    pub position: Option<Expression>,
    /// How the axes e are turned; `None`: like the parent's, or like k.
    pub rotation: Option<Expression>,
    /// The word `body`.
    pub span: Span,
}

/// `particle(mass = …, position = …)`.
#[derive(Clone)]
pub struct ParticleClause {
    /// A scalar of fields and numbers.
    pub mass: Expression,
    /// A vector of t and q, in observer axes from Ω.
    pub position: Expression,
    /// The word `particle`.
    #[allow(dead_code, reason = "where a mistake about the whole clause belongs")]
    pub span: Span,
}
