//! The attribute language, read and checked: a struct with `#[gauss(…)]` goes in, a [`Model`] comes out.
//!
//! This is the only part of the pipeline that knows syn's input types. Nothing here panics on what a user can write;
//! every mistake is collected in a [`Context`](language::context::Context) and all of them are reported together, each
//! at the token that is wrong, with what was expected.
//!
//! | room | what it holds |
//! |---|---|
//! | `parse` | the whole way |
//! | `scene` | what comes out: [`Model`], its clauses, the table of force elements, expressions with spans, charts, roles |
//! | `language` | tokens → clauses: `attributes` cuts them, `struct_clauses` and `statements` read those of the struct, `fields` those of the fields, `arithmetic` expressions |
//! | `names` | `declared` names and their meanings, the `places` of expressions and the `kinds` of their values, definitions written out |
//! | `units` | dimensions of expressions, and which are needed where |
//! | `checks` | rules among fields, mass data, coordinates and speeds, bodies, constraints and forces |
//! | `robots` | files that describe robots → clauses |
//! | `assembly` | clauses and fields put together: every check in order, then the model |

mod assembly;
mod checks;
mod language;
mod names;
mod parse;
#[cfg(any(feature = "urdf", feature = "mjcf"))]
mod robots;
mod scene;
#[cfg(test)]
mod tests;
mod units;

pub use language::arithmetic::{LARGEST_EXPONENT, too_many_factors};
pub use language::number::{exact as literal, of_double as exact};
pub use parse::{item, parse, struct_in};
pub use scene::charts::{Chart, InChart, Motion, RotationChart};
pub use scene::clauses::{
    BodyClause, Coefficients, ConstraintKind, Coordinate, CoordinateKind, FunctionClause, FunctionKind, InputKind,
    InputName, RoleClause, RoleValue, SpeedKind, SpeedPart,
};
pub use scene::described::{BodyOfFile, Described, Remark, StateOfFile, ValueOfState};
pub use scene::elements::{ElementKind, LawKind, Takes, argument};
pub use scene::expression::{BinaryOperator, Expression, ExpressionKind, FunctionName, Property};
pub use scene::forces::{ForceAxes, ForceClause};
pub use scene::model::{Field, GenericsOfImpl, Model, Scalar, Wanted, WantedMethod};
pub use scene::roles::{Role, Shape};
