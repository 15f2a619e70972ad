//! What is timed and counted: one function for each, never inlined, so that each call pays what a call pays.

use crate::{Dynamics, Generated, by_hand, matrices, scenes};

/// A state of a scene.
pub type State<D> = (<D as Dynamics>::Configuration, <D as Dynamics>::Speeds);

macro_rules! entries {
    ($($(#[$documentation:meta])* $name:ident: $dynamics:ty;)+) => {$(
        $(#[$documentation])*
        #[inline(never)]
        pub fn $name(dynamics: &$dynamics, state: &State<$dynamics>) -> <$dynamics as Dynamics>::Speeds {
            dynamics.acceleration(&state.0, &state.1)
        }
    )+};
}

entries! {
    /// S1, generated.
    s1_generated: Generated<scenes::FreeBodyKernel>;
    /// S1, by hand.
    s1_by_hand: by_hand::FreeBody;
    /// S1, with matrices.
    s1_matrices: matrices::Body;
    /// S2, generated.
    s2_generated: Generated<scenes::HeavyBodyKernel>;
    /// S2, by hand.
    s2_by_hand: by_hand::HeavyBody;
    /// S2, with matrices.
    s2_matrices: matrices::Body;
    /// S3, generated.
    s3_generated: Generated<scenes::ImmersedKernel>;
    /// S3, by hand.
    s3_by_hand: by_hand::Immersed;
    /// S3, with matrices.
    s3_matrices: matrices::Body;
    /// S4, generated.
    s4_generated: Generated<scenes::TopKernel>;
    /// S4, by hand.
    s4_by_hand: by_hand::Top;
    /// S4, with matrices.
    s4_matrices: matrices::Top;
    /// S5, generated.
    s5_generated: Generated<scenes::DoublePendulumKernel>;
    /// S5, by hand.
    s5_by_hand: by_hand::DoublePendulum;
    /// S5, with matrices.
    s5_matrices: matrices::DoublePendulum;
    /// S5′, generated.
    s5_jointed_generated: Generated<scenes::JointedPendulumKernel>;
    /// S5′, by hand.
    s5_jointed_by_hand: by_hand::JointedPendulum;
    /// S5′, with matrices.
    s5_jointed_matrices: matrices::JointedPendulum;
    /// S6, generated.
    s6_generated: Generated<scenes::CartPoleKernel>;
    /// S6, by hand.
    s6_by_hand: by_hand::CartPole;
    /// S6, with matrices.
    s6_matrices: matrices::CartPole;
    /// S7, generated.
    s7_generated: Generated<scenes::ArmKernel>;
}
