//! Integrators on groups: one file a family of methods, all written once over the two forms of the equations.
//!
//! | file | holds |
//! |---|---|
//! | [`form`] | velocity form and momentum form, inputs, and the [`Problem`] that a method sees |
//! | [`tableau`] | coefficients of Runge–Kutta methods |
//! | [`one_step`] | what a method of one step is and keeps |
//! | [`runge_kutta`] | Runge–Kutta steps on the components, brought back onto the group |
//! | [`rkmk`] | Runge–Kutta–Munthe-Kaas steps |
//! | [`collocation`] | Gauss' implicit methods of orders 2, 4, 6, symmetric |
//! | [`rosenbrock`] | a linearly implicit method of order 4 for stiff scenes |
//! | [`commutator_free`] | a commutator-free method of order 4 |
//! | [`discrete`] | exact derivatives of a step: transition matrices for filters and regulators |
//! | [`composition`] | symmetric methods composed to higher orders |
//! | [`control`] | fixed steps, adaptive steps |
//! | [`compensated`] | fixed steps that carry what is rounded off, for long runs |
//! | `step_length` | how adaptive steps grow and shrink, and what they do at kinks and jumps |
//! | [`variational`] | a variational method in the left-invariant chart: symplectic, keeps momenta |
//! | [`energy_momentum`] | a method that keeps energy and momenta of bodies in the left-invariant chart |
//! | `iteration` | when the iteration of an implicit step ends |
//! | `projection` | states of a run kept on the constraints |
//! | [`simulation`] | [`Simulation`], the front |
//! | [`event`] | where functions of the state pass through zero |
//! | [`taylor`] | power series of the solution, where the derive gives them |
//! | [`trajectory`] | [`Sample`], `Trajectory` |
//! | [`body`] | free and heavy bodies: exact flow, discrete Moser–Veselov, splitting |
//! | `dense` | `Dense`: states between samples with the accuracy of the method |
//! | [`method`] | methods and forms chosen at run time |
//! | `tune` | the cheapest method for a scene, measured on it |
//! | [`error`] | [`IntegrationError`] |

pub mod body;
pub mod collocation;
pub mod commutator_free;
pub mod compensated;
pub mod composition;
pub mod control;
#[cfg(feature = "alloc")]
pub mod dense;
pub mod discrete;
pub mod energy_momentum;
pub mod error;
pub mod event;
pub mod form;
mod iteration;
pub mod method;
pub mod one_step;
mod projection;
pub mod rkmk;
pub mod rosenbrock;
pub mod runge_kutta;
pub mod simulation;
mod step_length;
pub mod tableau;
pub mod taylor;
pub mod trajectory;
#[cfg(feature = "alloc")]
pub mod tune;
pub mod variational;

pub use body::{FreeFlow, MoserVeselov, Scheme, Splitting, SplittingError};
pub use collocation::Collocation;
pub use commutator_free::CommutatorFree4;
pub use compensated::Compensated;
pub use composition::{Composed, Composition};
pub use control::{Adaptive, Control, Emit, Fixed};
#[cfg(feature = "alloc")]
pub(crate) use control::{number_of_steps, prepare};
#[cfg(feature = "alloc")]
pub use dense::Dense;
pub use discrete::DiscreteLinearization;
pub use energy_momentum::EnergyMomentum;
pub use error::{IntegrationError, IntegrationErrorKind, Part};
pub use event::Crossing;
pub use form::{Feedback, Form, InputSource, MomentumForm, NoInput, Problem, Rates, State, VelocityForm};
pub use method::{EitherForm, Method};
pub use one_step::{EstimatingStep, IncrementStep, OneStep, Properties, Step};
#[cfg(feature = "alloc")]
pub(crate) use projection::accept;
pub use rkmk::Rkmk;
pub use rosenbrock::Rosenbrock;
pub use runge_kutta::RungeKutta;
pub use simulation::{Observer, Simulation};
pub use tableau::{Classical4, Coefficients, DormandPrince5, DormandPrince8, Tableau, Verner9};
pub use taylor::Taylor;
pub use trajectory::Sample;
#[cfg(feature = "alloc")]
pub use trajectory::{EventSample, Trajectory};
#[cfg(feature = "alloc")]
pub use tune::{Candidate, Measured, TuneError, Tuned};
pub use variational::Variational;

#[cfg(all(test, feature = "alloc"))]
mod collocation_tests;
#[cfg(all(test, feature = "alloc"))]
mod product_tests;
#[cfg(test)]
mod smoothness_tests;
#[cfg(all(test, feature = "alloc"))]
mod tests;
