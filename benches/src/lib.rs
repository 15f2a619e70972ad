//! What an evaluation of a kernel costs, beside the same equations written by hand and with matrices.
//!
//! - `scenes`: S1–S7, as a user writes them, and their parameters.
//! - `by_hand`: the same equations by someone who knows the structure: everything constant computed once, plain
//!   scalars.
//! - `matrices`: the same equations as one types them with nalgebra, a factorisation a call.
//! - `packs`: scenes in any scalar, for batches and ensembles.
//! - `states`: 64 states of each scene.
//! - `measure`: times that alternate, so that ratios mean something on a busy machine.
//! - `entries`: one function for each evaluation that is timed, whose instructions are counted.
//! - `peers`: what other generators and simulators make of the scenes (feature `peers`).
//! - `robots`: S8 and S9, from their files (feature `robots`).
//! - `report`, `run`: the table; a run from its options to it.

pub mod by_hand;
pub mod cases;
pub mod entries;
pub mod matrices;
pub mod measure;
pub mod packs;
pub mod peers;
pub mod report;
#[cfg(feature = "robots")]
pub mod robots;
pub mod run;
pub mod scenes;
pub mod states;

use gauss_runtime::prelude::*;

/// Accelerations as a function of the state, however they are computed.
pub trait Dynamics {
    /// Where the system is.
    type Configuration: Copy + 'static;

    /// Quasi-velocities and their rates.
    type Speeds: Copy + 'static;

    /// ż, in the units of the scene.
    fn acceleration(&self, q: &Self::Configuration, z: &Self::Speeds) -> Self::Speeds;
}

/// A kernel that the derive wrote.
#[derive(Clone, Copy, Debug)]
pub struct Generated<S>(pub S);

impl<S> Dynamics for Generated<S>
where
    S: GaussSystem<Scalar = f64, Input = ()>,
    S::Configuration: Copy + 'static,
    S::Speeds: Copy + 'static,
{
    type Configuration = S::Configuration;
    type Speeds = S::Speeds;

    #[inline(always)]
    fn acceleration(&self, q: &S::Configuration, z: &S::Speeds) -> S::Speeds {
        self.0.acceleration(0.0, q, z, &())
    }
}
