//! Why a state cannot be brought onto the constraints.

use core::fmt;

/// Which of a system's constraints.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ConstraintLevel {
    /// φ(t, q) = 0.
    Position,
    /// φ(t, q, z) = 0, and dφ/dt = 0 of position constraints.
    Velocity,
}

impl fmt::Display for ConstraintLevel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Position => "position",
            Self::Velocity => "velocity",
        })
    }
}

/// Why a state cannot be brought back onto the constraints.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ProjectionFailure {
    /// A residual or a correction is infinite or undefined: the state was, or constraints depend on one another there.
    NonFinite,
    /// Corrections do not settle: the state is too far from the constraints, or they contradict each other.
    NotConverged,
    /// The constraints hold where the search ended, and their gradients vanish or depend on one another there: so does
    /// that of (x − c)² at x = c.
    Singular,
}

/// A state that could not be brought onto the constraints: see
/// [`GaussSystem::project`](crate::system::GaussSystem::project).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ProjectionError {
    /// Positions come first, velocities after them.
    pub level: ConstraintLevel,
    /// Cause of the failure.
    pub failure: ProjectionFailure,
    /// The largest component of the residual of the state that was given, in the unit of that constraint; NaN where it
    /// is undefined.
    pub given: f64,
    /// The same where the search was given up.
    pub residual: f64,
}

impl ProjectionError {
    /// From its parts, for projections that are written by hand: `residual` is that of the state that was given.
    #[must_use]
    pub const fn new(level: ConstraintLevel, failure: ProjectionFailure, residual: f64) -> Self {
        Self { level, failure, given: residual, residual }
    }
}

impl fmt::Display for ProjectionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { level, failure, given, residual } = self;
        if *failure != ProjectionFailure::Singular {
            write!(f, "no state that satisfies the constraints was found: ")?;
        }
        match failure {
            ProjectionFailure::NonFinite => write!(
                f,
                "the correction of the {level} is infinite or undefined (residual {given:e}, then {residual:e}); \
                 the state is, or constraints depend on one another there, which they may in a scene that says \
                 `redundant`"
            ),
            ProjectionFailure::NotConverged => write!(
                f,
                "corrections of the {level} do not settle: the given state misses the constraints by {given:e}, the \
                 nearest that was found by {residual:e}; it is too far from them, or they contradict each other"
            ),
            ProjectionFailure::Singular => write!(
                f,
                "the constraints hold where the search ended (residual of the {level} {given:e}, then {residual:e}), but \
                 one has a gradient that vanishes there, so that nothing holds it: of `powi(x - c, 2)` write `x - c`; or \
                 constraints depend on one another there, which they may in a scene that says `redundant`"
            ),
        }
    }
}

impl core::error::Error for ProjectionError {}
