//! Plain values that every step shares: what a struct declares, in terms of identifiers, spans and tokens alone.
//!
//! `charts` of one body, `roles` of fields with the shapes of their values, `laws` that constants obey, `functions` and
//! `inputs` of the user's own, the `item` with its fields and its scalar, the options of a kernel
//! (`kernel_options`), the file that a scene comes from (`robot_file`), numbers of limbs that are alike (`twins`), and
//! decimal fractions (`number`).

pub mod charts;
pub mod functions;
pub mod inputs;
pub mod item;
pub mod kernel_options;
pub mod laws;
pub mod number;
pub mod robot_file;
pub mod roles;
pub mod twins;

pub use charts::{BodyChart, Chart, Motion, RotationChart};
pub use functions::{Axis, FunctionKind, Interpolation, Table, UserFunction};
pub use inputs::{InputKind, InputName};
pub use item::{Field, Generics, Item, Scalar};
pub use kernel_options::{KernelOptions, OptionalMethod, ReactionJoint};
pub use laws::LawKind;
pub use robot_file::{BodyOfFile, FileRemark, RobotFile, StateOfFile, ValueOfState};
pub use roles::{Role, Shape};
pub use twins::Twin;
