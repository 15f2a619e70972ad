//! Rigid-body dynamics at run time: the traits of kernels that `#[derive(GaussDynamics)]` generates, and their
//! integrators.
#![cfg_attr(
    all(feature = "derive", feature = "std"),
    doc = r##"
```
use gauss_runtime::prelude::*;

/// A wheel on a free craft, in kg, m, s. Everything that moves is declared; the equations follow.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(craft: Pose, angle),
    speeds(u: Vector3, w: Vector3, spin), // in the craft's axes: velocity, angular velocity; rate of the wheel
    kinematics(craft = twist(u, w), angle = spin),
    body(hull, pose = craft, mass = 10, inertia = 0.2),
    body(wheel, parent = hull, rotation = rotation_z(angle), mass = 0.5, inertia = [across, across, along]),
    input(motor = "N m"),
    torque(drive, body = wheel, value = [0, 0, motor], reaction = hull),
)]
struct Craft { across: f64, along: f64 }

# fn main() -> Result<(), Box<dyn std::error::Error>> {
let kernel = Craft { across: 0.001, along: 0.002 }.kernel()?; // parameters are checked here
println!("{}", CraftKernel::EQUATIONS);

let start = CraftState { spin: 5.0, ..Default::default() }; // the rest at the origin, at rest
let run = Simulation::new(&kernel)
    .input(|_t: f64, q: &_, z: &_| SVector::from([-0.001 * CraftState::of(q, z).spin])) // brakes
    .adaptive(1e-10, 1e-12)
    .run(start.q(), start.z(), 0.0..10.0)?;
let end = CraftState::of(&run.last().q, &run.last().z);
// Along e₃ the wheel, 0.002 (ω₃ + spin), and the craft, 0.2 ω₃, keep what they had together.
assert!((0.202 * end.w.z + 0.002 * end.spin - 0.01).abs() < 1e-12);
# Ok(())
# }
```
"##
)]
//!
//! # Where to read on
//!
//! - The language, clause by clause: [`GaussDynamics`]. What runs: [`Simulation`](integrate::Simulation).
//! - The guide, in the folder `guide/src` of the repository (`mdbook build guide` makes pages of it). It begins with
//!   `first_body.md`; `frames.md` has frames and poles, `charts.md` the choice of speeds, `loads.md` what acts,
//!   `touching.md` contact, `inputs.md` control, `integrators.md` the choice of a method, `derivatives.md` filters and
//!   identification, `robots.md` robots from their files, `results.md` plots and tables, and `field_*.md` one field
//!   each. `from_sympy.md`, `from_pinocchio_mujoco.md` and `from_mss.md` begin at other programs.
//!
//! # Modules
//!
//! | module | holds |
//! |---|---|
//! | [`system`] | [`GaussSystem`](system::GaussSystem), [`RigidBodySystem`](system::RigidBodySystem): the methods of a kernel |
//! | [`description`] | [`DescribedSystem`](description::DescribedSystem): a kernel's equations as text, and the costs of its methods |
//! | [`condition`](mod@condition) | how well a mass matrix can be inverted |
//! | [`constraint`] | [`ConstrainedSystem`](constraint::ConstrainedSystem): multipliers, projection on constraints |
//! | [`forces`] | [`ForcedSystem`](forces::ForcedSystem): forces, element by element; powers and the balance of energy |
//! | [`frames`] | [`FramedSystem`](frames::FramedSystem): poses, velocities and Jacobians of frames by name |
//! | [`driven`] | [`DrivenSystem`](driven::DrivenSystem): forces that move coordinates as functions of time |
//! | [`reactions`](mod@reactions) | [`Reactions`](reactions::Reactions): forces and torques of joints and bearings |
//! | [`centroidal`] | [`CentroidalSystem`](centroidal::CentroidalSystem): centre of mass, momenta about it; gravity torques |
//! | [`operational`] | the inertia of a system as felt at a frame, and the mass matrix factored |
//! | [`linearize`] | [`LinearizedSystem`](linearize::LinearizedSystem): exact derivatives by state, time and input |
//! | [`hessian`] | [`HessianSystem`](hessian::HessianSystem): second derivatives along given weights |
//! | [`inverse`] | [`InverseLinearizedSystem`](inverse::InverseLinearizedSystem): derivatives of inverse dynamics |
//! | [`increments`] | [`Increments`](increments::Increments): increments of a state as one flat vector, for filters |
//! | [`configuration`] | groups as configurations, linear spaces of increments |
//! | [`lie`] | exp, log, dexp⁻¹ on SO(3), SE(3), SE(2), accurate from angle 0 up to the pole of dexp⁻¹ at 2π |
//! | [`chart`] | names of charts, rotation coordinates, exact conversion of states |
//! | [`integrate`] | geometric and adaptive integrators, [`Simulation`](integrate::Simulation), trajectories |
//! | [`monitor`] | energy and momentum watched over a run, energy against the work supplied |
//! | [`error`] | errors for parameters that no body can have, and warnings |
//! | [`real`] | the scalar: floats, SIMD lanes, dual numbers |
//! | [`dual`] | [`Dual`](dual::Dual): dual numbers of several directions |
//! | [`simd`] | packs of numbers that are worked on in lockstep |
//! | `saved` | parameters, states and runs as data, for `serde` |
//!
//! Mathematics and numbers of equations: Massa & Vignolo, *Newton–Euler, Lagrange and Kirchhoff formulations of rigid
//! body dynamics: a unified approach*.
//!
//! # Crates around this one
//!
//! Each has the version of this crate, and a page of its own.
//!
//! | crate | for |
//! |---|---|
//! | `gauss-batch` | many states of one scene at once: packs, threads, ensembles |
//! | `gauss-contact` | contact, dry friction and impacts, from event to event |
//! | `gauss-tables` | runs as tables, plots and files (CSV, Arrow, Parquet) |
//! | `gauss-playback`, `gauss-rerun` | motions as a page that plays; in the viewer Rerun |
//! | `gauss-exact` | exact motions of free bodies and tops, splitting methods |
//! | `gauss-adapters` | integrators, dual numbers and vectors of other crates |
//! | `gauss-sensitivity` | derivatives of whole runs by any numbers, forward and backward; fits |
//! | `gauss-bounded` | a scalar that knows how many of its digits are right |
//!
//! # Features
//!
//! - `std` (default): elementary functions of the standard library; implies `alloc`.
//! - `derive` (default): `#[derive(GaussDynamics)]`.
//! - `libm`: elementary functions without the standard library. One of `std` and `libm` is needed.
//! - `alloc`: trajectories, and whatever needs one, without the standard library. Integrators and monitors themselves
//!   never allocate.
//! - `urdf`, `mjcf`: robots from their files, which the derive reads; they imply `derive`.
//! - `wide` (default): sines and cosines of several angles in vectors, by the crate `wide`, with the same bits; its
//!   vectors as scalars, for the widest instructions that the target has; see [`simd`].
//! - `serde`: parameters, states and runs as data: the module `saved`.

#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]
#![cfg_attr(docsrs, feature(doc_cfg))]
// Without an allocator the list of violations travels by value.
#![cfg_attr(not(feature = "alloc"), allow(clippy::result_large_err))]

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("gauss-runtime needs elementary functions: enable the feature `std` or the feature `libm`");

#[cfg(feature = "alloc")]
extern crate alloc;
#[cfg(any(feature = "std", test))]
extern crate std;

pub mod accuracy;
pub mod centroidal;
pub mod chart;
pub mod condition;
pub mod configuration;
pub mod constraint;
pub mod contact;
pub mod description;
pub mod driven;
pub mod dual;
pub mod error;
pub mod forces;
pub mod frames;
pub mod hessian;
pub mod identification;
pub mod increments;
pub mod integrate;
pub mod inverse;
pub mod lie;
pub mod linearize;
pub mod monitor;
pub mod operational;
pub mod prelude;
pub mod reactions;
pub mod real;
#[cfg(feature = "serde")]
pub mod saved;
pub mod series;
pub mod simd;
pub mod system;
pub mod table;

mod conversion;
#[cfg(test)]
mod conversion_tests;
mod forwarding;
mod methods;
mod projection_error;
mod sealed;
mod trigonometry;
mod triple;
mod vector_space;
mod without_clause;

/// The vectors, poses and matrices of this crate, in the version that it uses.
pub use nalgebra;

/// The items that generated code uses, and the only ones of this crate. The name carries the version, so code that
/// another version of the derive has written fails to compile, and the missing name in the message has that version.
#[doc(hidden)]
#[path = "private/mod.rs"]
pub mod __private_0_1_0;
use __private_0_1_0 as private;

/// Items for the other crates of Gauss alone: no promise of stability is made here.
#[doc(hidden)]
pub mod __crates_0_1_0 {
    pub use crate::__packs_of_one_0_1_0 as packs_of_one;
    pub use crate::lie::carried::two_sum;
    pub use crate::lie::se3::{join, split};
    pub use crate::lie::so3::turned;
    pub use crate::triple::*;
}

#[cfg(feature = "derive")]
#[doc = include_str!("language.md")]
pub use gauss_derive::GaussDynamics;

#[cfg(test)]
mod testing;
