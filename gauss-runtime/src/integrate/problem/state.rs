//! States of a run, and their derivatives.

use core::fmt;

use crate::configuration::{Configuration, VectorSpace};
use crate::system::GaussSystem;

/// The increments of a system's configuration.
pub type TangentOf<S> = <<S as GaussSystem>::Configuration as Configuration>::Tangent;

/// The time derivatives of a state: the velocity of the configuration seen from the body, and ẏ.
pub struct Rates<S: GaussSystem> {
    /// V, left-trivialised.
    pub configuration: TangentOf<S>,
    /// ẏ.
    pub variables: S::Speeds,
}

impl<S: GaussSystem> Rates<S> {
    /// Whether both parts are finite.
    #[inline]
    pub fn is_finite(&self) -> bool {
        self.configuration.is_finite() && self.variables.is_finite()
    }
}

/// A state of an integrator: time, configuration, and the variables y of the form.
pub struct State<S: GaussSystem> {
    /// Time.
    pub t: S::Scalar,
    /// Configuration.
    pub q: S::Configuration,
    /// z in the velocity form, p in the momentum form.
    pub y: S::Speeds,
}

// Written by hand: deriving would ask the same of the system S, which is only named here.
macro_rules! copy_and_debug {
    ($name:ident { $($field:ident),+ }) => {
        impl<S: GaussSystem> Copy for $name<S> {}

        impl<S: GaussSystem> Clone for $name<S> {
            #[inline(always)]
            fn clone(&self) -> Self {
                *self
            }
        }

        impl<S: GaussSystem> fmt::Debug for $name<S> {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.debug_struct(stringify!($name))$(.field(stringify!($field), &self.$field))+.finish()
            }
        }
    };
}
pub(in crate::integrate) use copy_and_debug;

copy_and_debug!(Rates { configuration, variables });
copy_and_debug!(State { t, q, y });

/// A state of the system: quasi-velocities and momenta both, whichever form was integrated.
pub struct Sample<S: GaussSystem> {
    /// Time.
    pub t: S::Scalar,
    /// Configuration.
    pub q: S::Configuration,
    /// Quasi-velocities.
    pub z: S::Speeds,
    /// Momenta p = ∂T/∂z.
    pub p: S::Speeds,
}

copy_and_debug!(Sample { t, q, z, p });
