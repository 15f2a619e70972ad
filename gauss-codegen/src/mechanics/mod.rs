//! From a scene to its equations: frames and vectors, charts, moments, the Gauss condition. Reads like the paper;
//! knows nothing of tokens.
//!
//! - `vector`, `rotation`: components in the body's and the observer's axes, rotation matrices.
//! - `body`: the parameters as symbols, integrals over the body by moments.
//! - `chart`: ψ of each chart (3.2).
//! - `chart_scene`: the body of a chart as a link of a system.
//! - `gauss`: the Gauss condition (3.4) from v_P, word for word; the reference for all that follows.
//! - `check`: every scene against that condition, before code is written.
//! - `momentum`: the same through (Q, Γ), solved in body axes.
//! - `turn`, `link`: bodies, frames and particles, each relative to its parent.
//! - `moments`, `regroup`: what their matter amounts to, and what of it moves with the parent as well.
//! - `tree`, `articulated`: sums over links by recursion, and A ż = r solved link by link.
//! - `forces`: what acts beside weight and buoyancy.
//! - `fields`: what acts on all that a body is made of: central gravity, a medium that moves.
//! - `wrench`: the same on one body in a chart.
//! - `accounts`: power and generalised force of each element.
//! - `constraint`: what coordinates and speeds do not solve by themselves.
//! - `elimination`: constraints solved for the speeds that depend on others.
//! - `system`, `system_check`, `system_equations`: the equations of bodies and particles in coordinates of their own.
//! - `methods`: every method of a kernel as expressions.
//! - `linearize`: what the equations are differentiated along.
//! - `regressor`: forces of inertia as a linear function of inertial parameters.
//! - `equations`: the equations for people.

mod accounts;
mod articulated;
mod body;
mod chart;
mod chart_scene;
mod check;
mod component_rates;
mod constraint;
mod elimination;
mod equations;
mod fields;
mod forces;
mod formula;
mod gauss;
mod linearize;
mod link;
mod methods;
mod moments;
mod momentum;
mod names;
#[cfg(test)]
mod proof;
#[cfg(test)]
mod random_systems;
mod regressor;
mod regroup;
mod rotation;
mod short;
#[cfg(test)]
mod snapshots;
#[cfg(test)]
mod special_cases;
mod system;
mod system_check;
mod system_equations;
#[cfg(test)]
pub mod tests;
mod tree;
mod turn;
mod vector;
mod wrench;

pub use accounts::Account;
pub use body::{Assigned, Body, BodyShape, ParameterSymbol};
pub use chart::{ConfigurationKind, Kinematics};
pub use check::check_against_definition;
pub use constraint::{Constraint, ConstraintKind, Constraints};
pub use elimination::{Elimination, Obstacle};
pub use equations::Section;
pub use fields::{attraction, entrained};
pub use forces::{Action, Element, Force};
pub use formula::{Formula, Method};
pub use linearize::Linearization;
pub use link::{Matter, Placement, identity};
pub use methods::Scene;
pub use momentum::KineticMatrix;
pub use names::Name;
pub use regressor::{InertialParameters, Regressor};
pub use rotation::{about_axis, poisson, rotation_of_quaternion};
pub use system::{Coordinate, System, SystemScene};
pub use system_check::{SystemFault, check_system_against_definition};
pub use tree::Tree;
pub use turn::Turn;
pub use vector::{Axes, cross, subtract};
pub use wrench::{Acting, Observed};
