//! Steps of fixed length in velocities and impulses, for many contacts.
//!
//! A step of length h goes half of the way with the speeds before it, finds there the impulses P with which speeds
//! after the step satisfy the laws (J. J. Moreau 1988; M. Jean 1999),
//!
//! `z⁺ = z + h ż₀ + A⁻¹WᵀP`, `u⁺ = u + h b + D P`,
//!
//! and goes the other half with the speeds after it. All impacts of a step are solved at once. A contact counts as
//! closed by the gap that the step would end with. Then positions and speeds are projected: closed gaps are zero, so
//! are their rates and the slips of what sticks. Positions move by the least that leaves no gap below zero; a gap above
//! zero is pulled shut by at most what the impulse of the step does at another time of it, and stays open else. No
//! event is sought, so that dozens of contacts, and impacts that pile up, are no more work than one; the time of an
//! impact is known to a step. A step whose forces were taken at other speeds than its mean ones is made again
//! (`speeds`), or at another place where they change much with it (`stiffness`; `springs`: what
//! steps without a memory refuse).

mod account;
mod active;
mod adaptive;
mod agreement;
mod bounds;
mod cones;
mod derivatives;
mod edges;
mod ensemble;
mod equations;
mod flight;
mod followed;
mod gain;
mod held;
mod impulses;
mod kept;
mod lane;
mod lanes;
mod least;
mod linear;
mod made;
mod motion;
mod outcome;
mod passing;
mod posed;
mod projection;
mod pull;
mod reach;
mod relaxed;
mod report;
mod rounds;
mod run;
mod speeds;
mod springs;
mod step;
mod stepper;
mod stiffness;
mod together;
mod unknowns;
mod used;
mod watch;

pub use adaptive::AdaptiveContactSteps;
pub use derivatives::StepDerivatives;
pub use edges::{AtChange, Change};
pub use ensemble::ContactEnsemble;
pub use held::HeldSteps;
pub use lane::LanesOf;
pub use lanes::ContactLanes;
pub use made::{StepSample, StepStatistics, SteppedRun};
pub use relaxed::StepLaw;
pub use report::{StepReport, StepScheme};
pub use run::ContactSteps;
pub use stepper::ContactStepper;
