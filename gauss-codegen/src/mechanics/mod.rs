//! From a scene to its equations. Reads like the paper; knows nothing of tokens. One body in a chart is a system of one
//! link.
//!
//! Folders, in the order of the work:
//!
//! - `kinematics`: frames and vectors, rotations, how one body moves, ψ of each chart (3.2).
//! - `matter`: bodies as symbols, integrals over them by moments.
//! - `loads`: forces and potentials, their wrenches, a medium that moves.
//! - `links`: bodies, frames and particles, each relative to its parent; sums over them by recursion; what moves with
//!   the parent as well; the power of forces on links, weight, central gravity.
//! - `constraints`: multipliers and rows of contacts.
//! - `arrangements`: ways to write the same equations: a free link in its body axes, multiplied out, link by link.
//! - `check`: the definition (3.1), and every scene against it before code is written.
//! - `derivatives`: what the equations are differentiated along; the regressor; rates of all numbers of a state.
//! - `print`: the equations for people.
//!
//! `name` is a name in both notations, `scene` is what is given, `system` puts everything together: every method
//! (`formula`) of a kernel, each in several arrangements, the account of every element, and constraints solved for the
//! speeds that depend on others; `one_body` defines the body that is all the matter; `frames` has quantities of single
//! links, `whole` those of all together, `reactions` those of joints. `tidy` is what is multiplied out where that is
//! short.

mod arrangements;
mod check;
mod constraints;
mod derivatives;
mod formula;
mod frames;
mod kinematics;
mod links;
mod loads;
mod matter;
mod name;
mod one_body;
mod print;
#[cfg(test)]
mod proof;
#[cfg(test)]
mod random_systems;
mod reactions;
mod scene;
#[cfg(test)]
mod snapshots;
#[cfg(test)]
mod special_cases;
mod system;
#[cfg(test)]
pub mod tests;
mod tidy;
mod whole;

pub use arrangements::balance::KineticMatrix;
pub use check::dependent::needless_constraints;
pub use check::faults::{Claims, SystemFault, check_system_against_definition, has_values};
pub use check::reactions::check_reactions;
#[cfg(test)]
pub use check::witness::acceleration_by_definition;
pub use constraints::multipliers::Constraints;
pub use derivatives::hessian::Hessian;
pub use derivatives::inverse::InverseLinearization;
pub use derivatives::linearize::Linearization;
pub use derivatives::regressor::{InertialParameter, InertialParameters, Regressor};
pub use formula::{Arrangements, Formula, Formulas, FrameQuantity, Method};
pub use kinematics::chart::ChartedBody;
pub use kinematics::coordinate::Coordinate;
pub use kinematics::rotation::{about_axis, poisson, rotation_of_quaternion};
pub use kinematics::turn::Turn;
pub use kinematics::vector::{Axes, Vector, add, cross, dot, subtract};
pub use links::central::CentralField;
pub use links::link::{Link, Matter, Placement, identity};
pub use links::path::{common, point_seen_from, relative_angular_velocity, turned};
pub use links::tree::Tree;
pub use loads::account::Account;
pub use loads::fields::entrained;
pub use loads::forces::{Action, Element, Force};
pub use loads::motion_symbols::MotionSymbols;
pub use matter::body::{Body, BodyShape, ParameterSymbol, QuantityValues};
pub use matter::flow::MatterFlow;
pub use matter::modes::{Deformation, ModalIntegrals};
pub use matter::rotor::Rotor;
pub use name::Name;
pub use print::readings::Readings;
pub use reactions::{FreedScene, Reactions};
pub use scene::constraint::{Constraint, ConstraintKind};
pub use scene::contact::{Contact, ContactFrame};
pub use scene::{ChartedLink, SystemScene};
pub use system::System;
pub use system::elimination::{Elimination, Obstacle};
