//! A run in the viewer [Rerun](https://rerun.io): poses of bodies with its shapes, traces of points, arrows, scalars,
//! all over the time of the run on a timeline `t`.
//!
//! ```
//! use gauss_rerun::Recorder;
//! use gauss_runtime::prelude::*;
//! use rerun::{Boxes3D, RecordingStreamBuilder};
//!
//! /// A racket: moments in the order that makes the second axis unstable.
//! #[derive(GaussDynamics)]
//! #[gauss(chart = left_invariant)]
//! struct Racket {
//!     #[gauss(mass)]
//!     mass: f64,
//!     #[gauss(inertia)]
//!     inertia: Vector3<f64>,
//! }
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let racket = Racket { mass: 0.3, inertia: Vector3::new(2e-3, 1.5e-2, 1.6e-2) }.kernel()?;
//! let spin = Vector6::new(0.0, 0.0, 0.0, 0.01, 10.0, 0.01);
//! let path = Simulation::new(&racket).adaptive(1e-9, 1e-9).run(Isometry3::identity(), spin, 0.0..3.0)?;
//!
//! // Or `.save("flip.rrd")`, `.connect_grpc()`, `.spawn()`.
//! let (stream, _storage) = RecordingStreamBuilder::new("a racket that flips").memory()?;
//! Recorder::new(&stream, &path)?
//!     .body("racket", |s| racket.pose(s.t, &s.q))?
//!     .shape("racket", &Boxes3D::from_sizes([[0.2, 0.6, 0.03]]))?
//!     .trace("racket", "tip", [0.0, 0.3, 0.0])?
//!     .energy(&racket)?;
//! # Ok(())
//! # }
//! ```
//!
//! Numbers become f32, but for times and scalars. Lengths are in the units of the scene, axes are the observer's, and
//! k₃ points up.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod error;
mod recorder;

pub use error::RecordError;
pub use recorder::Recorder;
