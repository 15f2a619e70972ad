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
mod arguments;
mod arithmetic;
mod assembly;
mod attributes;
mod bodies;
mod charts;
mod clauses;
mod coefficients;
mod constraints;
mod context;
mod declarations;
mod declared;
mod definitions;
mod dimensions;
mod expression;
mod expressions;
mod fields;
mod forces;
mod functions;
mod given;
mod head;
mod kind;
mod kinds;
mod masses;
mod model;
mod motion;
mod moving;
mod names;
mod naming;
mod need;
mod needs;
mod number;
mod parse;
mod placements;
mod places;
mod role_words;
mod roles;
mod scope;
mod shapes;
mod statements;
#[cfg(test)]
mod tests;
mod units;
mod validate;

pub use charts::{Chart, InChart, Motion, RotationChart};
pub use clauses::{
    BodyClause, Coefficients, ConstraintKind, Coordinate, CoordinateKind, Extent, ForceAxes, ForceClause, ForceKind,
    Given, GivenValue, InputKind, InputName, SpeedKind,
};
pub use expression::{BinaryOperator, Expression, ExpressionKind, FunctionName, Property};
pub use model::{Field, Model, Scalar, Wanted};
pub use parse::parse;
pub use roles::{Role, Shape};
