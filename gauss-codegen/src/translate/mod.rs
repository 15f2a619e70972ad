//! From a checked system to its symbols: expressions as the user wrote them become expressions of the algebra.
//!
//! [`translate`] gives the scene and what is only written down; nothing of how it was found is left.
//!
//! - `translator`: the scene, part by part, in the order in which one part can name another.
//! - `translated`: what comes out; `blame`: which part of it is to blame where a check fails.
//! - `symbols`: what every field, coordinate and speed is called, and where the value of each symbol is read.
//! - `mass_data`: what clauses say of bodies and of gravity.
//! - `kinematics`: ψ, and the rates of everything that it moves.
//! - `values`: expressions; `value`: what they stand for.
//! - `domains`: expressions without a value; `notes`: what is noted on the way.
//! - `forces`: loads; `flow`: matter that leaves or enters; `contacts`: gaps, slips and their coefficients; `shapes`:
//!   those of points, spheres, boxes.
//! - `laws`, `drag`: constants of loads, for checks and warnings.
//! - `parameters`: what the numbers of fields are called; `state`: what coordinates and speeds are called.
//! - `freed_scene`: the scene once more, with joints let go, for their reactions; `freedom`: what they move by then.
//! - `limbs`: which symbols of limbs that are alike correspond to one another.
//! - `placements`: where bodies, frames and points are.
//! - `readings`: names of expressions, for printed equations.

mod blame;
mod contacts;
mod domains;
mod drag;
mod flow;
mod forces;
mod freed_scene;
mod freedom;
mod kinematics;
mod laws;
mod limbs;
mod mass_data;
mod modes;
mod notes;
mod parameters;
mod placements;
mod readings;
mod shapes;
mod state;
mod symbols;
mod translated;
mod translator;
mod value;
mod values;

pub use drag::DragMatrix;
pub use laws::Law;
pub use parameters::FieldNumber;
pub use state::{NamedQuantity, QuantityKind};
pub use symbols::{FieldPart, ParameterSource};
pub use translated::{BodyData, ClauseValue, ConstraintPlace, IndependentSpeeds, Provenance, SpannedName, Translated};
pub use translator::translate;
