//! Laws that constants must obey.

/// Laws of constants that `kernel()` checks, and `warnings()` looks at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LawKind {
    /// The stiffness of a spring or a stop.
    Stiffness,
    /// The width of a stop.
    Width,
    /// The two positions of a stop.
    Limits,
    /// A coefficient of a spring or a stop.
    Damping,
    /// The level of dry friction.
    NonNegative,
    /// An armature.
    Armature,
    /// A semi-axis of an ellipsoid.
    Length,
    /// The mass of a particle.
    MassInSum,
    /// The stiffness matrix of a bushing or of modes, row by row.
    StiffnessMatrix,
    /// The damping matrix of a bushing or of modes, row by row.
    DampingMatrix,
    /// Mass, first moment, inertia, participations and modal masses of a body that deforms: a matrix, row by row.
    Modes,
    /// A whole dissipation function, of the state too.
    Dissipation,
    /// A gravitational parameter.
    Attraction,
    /// A coefficient of friction: checked where it is a constant.
    Friction,
    /// The square of the length of a direction.
    Direction,
    /// A coefficient of restitution.
    Restitution,
}
