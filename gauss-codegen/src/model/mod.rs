//! The attribute language, read and checked: a struct with `#[gauss(…)]` goes in, a [`Model`] comes out.
//!
//! This is the only part of the pipeline that knows syn's input types. Nothing here panics on what a user can write;
//! every mistake is collected in a [`Context`](language::context::Context) and all of them are reported together, each
//! at the token that is wrong, with what was expected.
//!
//! | room | what it holds |
//! |---|---|
//! | `parse` | the whole way |
//! | `scene` | what comes out: [`Model`], its clauses, the table of force elements, expressions with spans |
//! | `language` | tokens → clauses: `attributes` cuts them, `struct_clauses` and `statements` read those of the struct, `fields` those of the fields, `arithmetic` expressions |
//! | `names` | names and their meanings (`scope_entries`), the `places` of expressions and the `kinds` of their values, definitions written out |
//! | `units` | dimensions of expressions, and which are needed where |
//! | `checks` | rules among fields, mass data, coordinates and speeds, bodies, constraints and forces |
//! | `robots` | files that describe robots → clauses |
//! | `locks` | coordinates that are held → definitions of their names |
//! | `modes` | files of modes → what their clauses give |
//! | `assembly` | clauses and fields put together: every check in order, then the model |

mod assembly;
mod checks;
mod language;
mod locks;
#[cfg(feature = "modes")]
mod modes;
mod names;
mod parse;
#[cfg(any(feature = "urdf", feature = "mjcf"))]
mod robots;
mod scene;
#[cfg(test)]
mod tests;
mod units;

pub use language::arithmetic::{LARGEST_EXPONENT, too_many_factors};
pub use parse::{item, only_struct_in, parse, struct_in};
pub use scene::clauses::{
    BodyClause, Coefficients, ConstraintClause, ConstraintLevel, CoordinateClause, CoordinateKind, RoleClause,
    RoleValue, SpeedKind, SpeedPart,
};
pub use scene::contacts::{ContactClause, ContactGeometry, Copies, Counterpart, PointContact};
pub use scene::elements::{ArgumentType, ElementKind, argument};
pub use scene::expression::{BinaryOperator, Expression, ExpressionKind, FunctionName, Property};
pub use scene::forces::{ForceAxes, ForceClause};
pub use scene::model::Model;
pub use scene::modes::{Integral, ModesClause};
