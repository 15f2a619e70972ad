//! Plain values that every step shares: what a struct declares, in terms of identifiers, spans and tokens alone.
//!
//! `charts` of one body, `roles` of fields with the shapes of their values, `laws` that constants obey, `functions` and
//! `inputs` of the user's own, the `item` with its fields and its scalar, what is `wanted` of a kernel, files that a
//! scene is `described` in, numbers of limbs that are alike (`twins`), and decimal fractions (`number`).

pub mod charts;
pub mod described;
pub mod functions;
pub mod inputs;
pub mod item;
pub mod laws;
pub mod number;
pub mod roles;
pub mod twins;
pub mod wanted;

pub use charts::{Chart, InChart, Motion, RotationChart};
pub use described::{BodyOfFile, Described, Remark, StateOfFile, ValueOfState};
pub use functions::{Axis, FunctionKind, Joined, Table, UserFunction};
pub use inputs::{InputKind, InputName};
pub use item::{Field, Generics, Item, Scalar};
pub use laws::LawKind;
pub use roles::{Role, Shape};
pub use twins::Twin;
pub use wanted::{Wanted, WantedJoint, WantedMethod};
