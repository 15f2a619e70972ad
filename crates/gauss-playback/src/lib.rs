//! A trajectory as a page that plays: bodies as ellipsoids, boxes, cylinders and rods, traces of points, arrows of
//! forces or momenta, and curves below, with a slider of time. One HTML file that any browser opens, without network or
//! libraries.
//!
//! ```
//! use gauss_playback::{Playback, Shape};
//! use gauss_runtime::prelude::*;
//!
//! /// A racket: moments in the order that makes the second axis unstable.
//! #[derive(GaussDynamics)]
//! #[gauss(chart = left_invariant, motion = free)]
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
//! let page = Playback::new("A racket that flips", &path)?
//!     .si() // axes show s, m, J
//!     .body("racket", |s| racket.pose(s.t, &s.q), [Shape::cuboid([0.2, 0.6, 0.03])])
//!     .trace("racket", [0.0, 0.3, 0.0])
//!     .energy(&racket)
//!     .html()?;
//! assert!(page.starts_with("<!DOCTYPE html>"));
//! # Ok(())
//! # }
//! ```
//!
//! A system has more bodies: [`Playback::frames`] takes all frames of a kernel with `frames(…)`, and [`Playback::rod`]
//! joins two of them, so that a robot is drawn as its skeleton without any mesh. With the feature `urdf`
//! `Playback::shapes_of_urdf` gives them the boxes, cylinders and balls of their file.
//!
//! What touches is shown by [`Playback::contact`]: a dot and a force, in the colour of what the contact does. With the
//! feature `contact` `Playback::contacts` shows all contacts of a run of `gauss-contact` with their forces, and the
//! planes that they touch.
//!
//! All lengths are in the units of the scene, which the page shows if they are those of the SI ([`Playback::si`]); the
//! axes are the observer's, and k₃ points up on the screen.

#![warn(missing_docs)]

mod contact;
mod error;
mod page;
mod playback;
mod recording;
mod shape;
mod touch;
#[cfg(feature = "urdf")]
mod urdf;

pub use error::PlaybackError;
pub use playback::Playback;
pub use recording::Recording;
pub use shape::Shape;
pub use touch::Touch;
