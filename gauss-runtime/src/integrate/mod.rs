//! Integrators on groups: a folder a family of methods, all written once over the two forms of the equations.
//!
//! | folder | files |
//! |---|---|
//! | [`problem`] | what is integrated. [`equations`](problem::equations): the [`Problem`] that a method sees; [`form`](problem::form): velocity form and momentum form; [`input`](problem::input): sources of inputs; `sampled`: inputs that controllers hold; [`state`](problem::state): states, rates, samples; [`error`](problem::error): [`IntegrationError`] |
//! | [`step`] | the seam. [`one_step`](step::one_step): what a method of one step is and keeps; `iteration`: when an implicit step is solved |
//! | [`runge_kutta`] | [`tableau`](runge_kutta::tableau): coefficients; [`components`](runge_kutta::components): steps on the components, brought back onto the group |
//! | [`lie_group`] | [`rkmk`](lie_group::rkmk): Runge–Kutta–Munthe-Kaas steps; [`commutator_free`](lie_group::commutator_free): a method of order 4; [`discrete`](lie_group::discrete): exact derivatives of its steps, transition matrices for filters and regulators |
//! | [`structure`] | [`collocation`](structure::collocation): Gauss' implicit methods of orders 2, 4, 6, symmetric; [`composition`](structure::composition): symmetric methods composed to higher orders; [`variational`](structure::variational): symplectic in the left-invariant chart; [`energy_momentum`](structure::energy_momentum): energy and momenta of bodies at once |
//! | [`rosenbrock`] | a linearly implicit method of order 4 for stiff scenes |
//! | [`radau`] | an implicit method of order 5 for scenes whose stiffness follows what the time moves |
//! | [`adams`] | multistep methods: from the derivatives of earlier steps |
//! | [`taylor`] | power series of the solution, where the derive gives them |
//! | [`choice`] | methods by name, for programs whose users choose one. [`method`](choice::method): the table, with a row for each [`Method`]; [`step`](choice::step), [`control`](choice::control): all of them as one type |
//! | [`drive`] | runs. [`control`](drive::control): what carries a state over an interval; [`fixed`](drive::fixed); [`adaptive`](drive::adaptive), with [`step_length`](drive::step_length): how steps grow and shrink, and [`tolerance`](drive::tolerance): errors, and what rounding does to them; [`pace`](drive::pace), [`cause`](drive::cause): when and why a run is given up; [`compensated`](drive::compensated): what is rounded off is carried; [`projection`](drive::projection): constraints; [`event`](drive::event), [`search`](drive::search), `each`, `zero`: zeros of functions, jumps; `schedule`: controllers that sample; [`run`](drive::run): from jump to jump; `interval`: from instant to instant; [`trajectory`](drive::trajectory), [`summary`](drive::summary): what is kept; `record`: [`RunRecord`], what tables and pages read; [`simulation`](drive::simulation): [`Simulation`], the front; [`stepper`](drive::stepper): [`Stepper`], step by step; `boxed`: in a type for fields of structs |

pub mod adams;
pub mod choice;
pub mod drive;
pub mod lie_group;
pub mod problem;
pub mod radau;
pub mod rosenbrock;
pub mod runge_kutta;
pub mod step;
pub mod structure;
pub mod taylor;

pub use adams::Adams;
pub use choice::control::{MethodControl, StepSetting};
pub use choice::error::{MethodError, UnknownMethod};
pub use choice::method::Method;
pub use choice::step::{Absent, JacobianMethod, MethodPair, MethodPlace, MethodStep, NoTaylor};
#[cfg(feature = "alloc")]
pub use drive::RunRecord;
pub use drive::adaptive::Adaptive;
#[cfg(feature = "alloc")]
pub use drive::boxed::BoxedSimulation;
pub use drive::compensated::Compensated;
pub use drive::control::{Control, DEFAULT_LIMIT, Progress, StepCallback, StepStatistics};
pub use drive::fixed::Fixed;
pub use drive::observer::Observer;
pub use drive::search::Crossing;
pub use drive::simulation::Simulation;
pub use drive::stepper::{StepOutcome, Stepper};
pub use drive::summary::{End, Summary};
#[cfg(feature = "alloc")]
pub use drive::trajectory::{EventSample, Trajectory};
pub use lie_group::commutator_free::CommutatorFree4;
pub use lie_group::discrete::DiscreteLinearization;
pub use lie_group::rkmk::Rkmk;
pub use problem::equations::{Problem, SystemProblem};
pub use problem::error::{IntegrationError, IntegrationErrorKind, JumpMistake, RunPart, SamplingMistake};
pub use problem::form::{Form, MomentumForm, VelocityForm, WithoutContacts};
pub use problem::input::{Feedback, InputSource, NoInput};
#[cfg(feature = "alloc")]
pub use problem::sampled::Controller;
pub use problem::state::{Rates, Sample, State};
pub use radau::Radau;
pub use rosenbrock::Rosenbrock;
pub use runge_kutta::components::RungeKutta;
pub use runge_kutta::tableau::{Classical4, Coefficients, DormandPrince5, DormandPrince8, Tableau, Verner9};
pub use step::one_step::{EstimatingStep, IncrementStep, OneStep, Properties, Step, check_contacts};
pub use structure::collocation::Collocation;
pub use structure::composition::{Composed, Composition};
pub use structure::energy_momentum::EnergyMomentum;
pub use structure::variational::Variational;
pub use taylor::Taylor;

#[cfg(all(test, feature = "alloc"))]
mod product_tests;
#[cfg(test)]
mod smoothness_tests;
#[cfg(all(test, feature = "alloc"))]
mod tests;
