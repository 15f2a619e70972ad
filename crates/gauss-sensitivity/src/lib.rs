//! Derivatives of whole runs of [`gauss_runtime`] by any numbers: parameters of bodies, initial states, gains, values
//! of inputs.
//!
//! A run is described once as a function of numbers ([`Run`]); [`Derivatives`] then gives
//!
//! | asked for | found | costs about |
//! |---|---|---|
//! | states at all instants with their derivatives: [`run`](Derivatives::run) | forward, in dual numbers | three or four runs for every four numbers |
//! | a cost with its gradient: [`gradient`](Derivatives::gradient) | backward, with few states kept | some tens of runs, whatever the count of numbers |
//! | that of an ensemble: [`gradient_of_all`](Derivatives::gradient_of_all) | backward, run by run | the same for each run |
//! | the numbers that fit measurements: [`fit`](Derivatives::fit) | forward, Gauss–Newton | a handful of the first |
//!
//! All are exact derivatives of the steps that were made, whose lengths the values choose. Rotations and poses are
//! differentiated as increments seen from the body, `q ∘ exp(σ)`; constraints hold differentiated; an event that ends
//! the run, or at which its state jumps, has the derivative of its time; samples of a controller are functions of the
//! state. Not differentiated: contacts (which have
//! derivatives in dual numbers, `gauss-contact`), implicit methods, the momentum form.
//!
//! | file | holds |
//! |---|---|
//! | [`run`](mod@run) | what is differentiated: [`Run`], [`Cost`], [`Residuals`] |
//! | `derivatives` | the front |
//! | `mesh` | the steps that values choose |
//! | `forward` | along a run, in dual numbers |
//! | [`tape`] | a scalar that writes down what is done with it |
//! | `adjoint` | back through a run, step by step |
//! | `saltation` | an event, and its jump, in a product of derivatives of steps: [`Saltation`] |
//! | `checkpoints` | which states are kept on the way back |
//! | `fit` | least squares |

#![forbid(unsafe_code)]
#![deny(missing_docs)]
#![cfg_attr(docsrs, feature(doc_cfg))]

mod adjoint;
mod checkpoints;
mod derivatives;
mod error;
mod fit;
mod forward;
mod mesh;
pub mod run;
mod saltation;
mod states;
mod steps;
pub mod tape;

pub use adjoint::{Effort, Gradient};
pub use derivatives::{Derivatives, FixedSteps};
pub use error::{EnsembleError, SensitivityError};
pub use fit::{Fit, FitError};
pub use forward::Point;
pub use run::{At, ConfigurationOf, Cost, InputOf, Residuals, Run, SpeedsOf, Start};
pub use saltation::Saltation;
pub use states::constant;
pub use steps::{ExplicitMethod, Steps};

/// The example of the README is a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
