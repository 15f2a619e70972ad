//! The attribute language, read and checked: a struct with `#[gauss(…)]` goes in, a [`Model`] comes out.
//!
//! This is the only part of the derive that knows syn's input types. Nothing here panics on what a user can write;
//! every mistake is collected in a [`Context`](context::Context) and all of them are reported together, each at the
//! token that is wrong, with what was expected.
//!
//! | file | what it holds |
//! |---|---|
//! | `attributes` | `#[gauss(…)]` → clauses `name`, `name = value`, `name(…)` |
//! | `scene` | the clauses of the struct: `chart`, `motion`, `crate`, `taylor`, `linearize`, `regressor` |
//! | `statements` | those of a system, each with one of the next three; `constraint`, `potential`, `damping`, `limit` |
//! | `declarations` | `coordinates`, `speeds`, `independent`, `input`, `kinematics`, `define` |
//! | `placements` | `body`, `frame`, `particle`, `point` |
//! | `actions` | `force`, `torque`, `wrench`, `drag`, `drive`, `spring`, `stop`, `central_gravity`, `medium` |
//! | `fields` | the clauses of the fields: their roles |
//! | `given` | mass data in clauses: `mass = 2.0` |
//! | `roles` | what each role is called and which shapes it takes |
//! | `shapes` | the written type of a field → shape and scalar |
//! | `validate` | what must hold between fields: one scalar, no role missing or doubled |
//! | `expression`, `arithmetic`, `number`, `functions` | Rust arithmetic → trees with spans |
//! | `scope`, `places`, `kinds` | what names mean in expressions and where they may stand; scalar, vector or rotation |
//! | `naming` | one name, one meaning |
//! | `charts` | what the speeds of charts are called |
//! | `motion` | what must hold between coordinates, speeds and kinematics |
//! | `bodies` | what must hold between bodies: names, fields, parents |
//! | `constraints` | what must hold of constraints and independent speeds |
//! | `forces` | what must hold of forces and inputs |
//! | `units`, `dimensions`, `needs` | units of fields and inputs; dimensions of expressions that follow; which are needed where |
//! | `definitions` | named expressions, put in the place of their names |
//! | `moving` | what moves with the coordinates and the speeds |
//! | `assembly`, `system` | a whole scene checked, and the type that it has then |
//! | `names` | the nearest valid word to a misspelt one |
//! | `context` | the mistakes found so far |

mod actions;
mod arithmetic;
mod assembly;
mod attributes;
mod bodies;
mod charts;
mod constraints;
mod context;
mod declarations;
mod definitions;
mod dimensions;
mod expression;
mod fields;
mod forces;
mod functions;
mod given;
mod kinds;
mod motion;
mod moving;
mod names;
mod naming;
mod needs;
mod number;
mod placements;
mod places;
mod roles;
mod scene;
mod scope;
mod shapes;
mod statements;
mod system;
#[cfg(test)]
mod tests;
mod units;
mod validate;

pub use expression::{BinaryOperator, Expression, ExpressionKind, FunctionName, Property};
pub use given::{Given, GivenValue};
pub use system::{
    Attraction, BodyClause, Coefficients, ConstraintClause, ConstraintKind, Coordinate, CoordinateKind, Extent, Field,
    ForceAxes, ForceClause, ForceKind, InChart, InputKind, InputName, Model, ParticleClause, PointClause, Speed,
    SpeedKind,
};

use context::Context;
use syn::{Data, DeriveInput, Error, Fields, FieldsNamed, GenericParam, Generics, Ident};

/// What is wanted beside the equations.
#[derive(Clone, Default)]
pub struct Wanted {
    /// `taylor`, where it is written: power series of the motion.
    pub taylor: Option<Ident>,
    /// `linearize`: the derivatives of the equations by the state.
    pub linearize: bool,
    /// `linearize(parameters)`: by the parameters, too.
    pub by_parameters: bool,
    /// `regressor`, where it is written: the coefficients of the inertial parameters.
    pub regressor: Option<Ident>,
}

/// The number type that kernels compute with.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Scalar {
    /// `f32`.
    F32,
    /// `f64`.
    F64,
    /// A type parameter of the struct.
    Parameter(Ident),
}

impl std::fmt::Display for Scalar {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Scalar::F32 => formatter.write_str("f32"),
            Scalar::F64 => formatter.write_str("f64"),
            Scalar::Parameter(ident) => ident.fmt(formatter),
        }
    }
}

/// The choice of quasi-velocities, row by row as in equations (2.2)–(2.6).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Chart {
    /// u and ω in body axes, pole O.
    LeftInvariant,
    /// The velocity of the body point at Ω, and ω, in observer axes, pole Ω.
    RightInvariant,
    /// ḃ in observer axes, ω in body axes, pole O.
    Hybrid,
    /// Time derivatives of coordinates.
    Jet(RotationChart),
}

/// Coordinates of the rotation in a jet chart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RotationChart {
    /// R = R_a(α₀) R_b(α₁) R_c(α₂), axes counted from 0, no two neighbours equal.
    Euler([u8; 3]),
    /// tan(θ/2) n.
    Rodrigues,
    /// tan(θ/4) n.
    ModifiedRodrigues,
    /// θ, the one angle of planar motion.
    Angle,
}

/// What the body is free to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// Six degrees of freedom.
    Free,
    /// O stays at Ω: rotation only.
    FixedPoint,
    /// O stays in the plane k₁k₂ and the body turns about k₃.
    Planar,
}

/// Shape of a field's value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// One number.
    Scalar,
    /// Three numbers.
    Vector3,
    /// Three by three.
    Matrix3,
    /// Six numbers, order (linear, angular).
    Vector6,
    /// Six by six, order (linear, angular).
    Matrix6,
    /// Mass, centre of mass and inertia of a body.
    RigidBody,
    /// Anything else: only plain parameters have it.
    Other,
}

/// What a field means to the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// The mass m: scalar.
    Mass,
    /// G − O in body axes: vector.
    CenterOfMass,
    /// About O, body axes: scalar (spherical), vector (principal) or matrix (full).
    Inertia,
    /// Six by six about O, body axes: vector (diagonal) or matrix (full).
    AddedMass,
    /// Scalar along −k₃, or a vector in observer axes.
    Gravity,
    /// Mass of the displaced fluid: scalar.
    DisplacedMass,
    /// Where buoyancy acts, body axes from O: vector.
    CenterOfBuoyancy,
    /// A body, named like the field.
    Body,
}

/// Reads and checks a struct.
///
/// # Errors
/// All mistakes of the struct combined, each at the token that is wrong.
pub fn parse(input: &DeriveInput) -> Result<Model, Error> {
    let mut context = Context::default();
    let clauses = scene::read(&input.attrs, fields::any_body(input), &mut context);
    check_generics(&input.generics, &mut context);
    let model = named_fields(input, &mut context).and_then(|named| {
        let reader = fields::read(named, &input.generics, clauses.own, &mut context);
        assembly::model(input, clauses, reader, &mut context)
    });
    context.finish(model)
}

/// The fields of a struct with named fields; anything else is a mistake at its name.
fn named_fields<'a>(input: &'a DeriveInput, context: &mut Context) -> Option<&'a FieldsNamed> {
    let found = match &input.data {
        Data::Struct(data) => match &data.fields {
            Fields::Named(named) => return Some(named),
            Fields::Unnamed(_) => "a tuple struct",
            Fields::Unit => "a unit struct",
        },
        Data::Enum(_) => "an enum",
        Data::Union(_) => "a union",
    };
    let name = &input.ident;
    context.error(
        name.span(),
        format!(
            "`GaussDynamics` is derived for structs with named fields, and `{name}` is {found}; \
             write `struct {name} {{ #[gauss(mass)] mass: f64, #[gauss(inertia)] inertia: f64 }}`"
        ),
    );
    None
}

/// A kernel holds numbers of one scalar type, so type parameters are all that it can carry over.
fn check_generics(generics: &Generics, context: &mut Context) {
    for parameter in &generics.params {
        match parameter {
            GenericParam::Type(_) => {}
            GenericParam::Lifetime(parameter) => context.error_at(
                &parameter.lifetime,
                format!(
                    "the lifetime parameter `{}` is not supported; \
                     a kernel outlives the struct that it is made from: write fields that own their values",
                    parameter.lifetime
                ),
            ),
            GenericParam::Const(parameter) => context.error(
                parameter.ident.span(),
                format!(
                    "the const parameter `{}` is not supported; \
                     the shape of every role is fixed: write the number where it is used",
                    parameter.ident
                ),
            ),
        }
    }
}
