//! Charts: by which numbers a motion is described, and exact conversions of states between them.
//!
//! [`Chart`] names the rows of the table of quasi-velocities (2.2–2.6 of Massa & Vignolo); [`RotationChart`] names
//! coordinates of the rotation group, converted in [`rotation`]; [`convert`] carries a state (q, z) from one generated
//! kernel to another through what does not depend on the chart: the pose of the body and its twist.

mod error;
pub mod rotation;

use core::fmt;

pub use crate::conversion::{convert, convert_at};
pub use error::{ChartError, MotionRule};

/// The kind of quasi-velocities z (or coordinate velocities) of a system.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Chart {
    /// Body components u, ω of the velocity of O and of the angular velocity (2.3): Kirchhoff's equations.
    LeftInvariant,
    /// Observer components of the velocity of the body point at Ω, and of the angular velocity (2.4).
    RightInvariant,
    /// Observer components of the velocity of O, body components of the angular velocity (2.5).
    Hybrid,
    /// Velocities of coordinates (2.6): Lagrange's equations.
    Jet(RotationChart),
    /// The user's own quasi-velocities, by the kinematics q̇ = ψ(t, q, z) (3.2). The configuration is an `SVector` of
    /// the coordinates, a pose, a rotation, or pairs of these: elements of groups in the order written, then all plain
    /// coordinates, as in `(Isometry3, (UnitQuaternion, SVector))`.
    Own,
}

impl Chart {
    /// Whether velocities lose digits near a singularity of the coordinates. Not where these stretch equally in all
    /// directions, as modified Rodrigues parameters do: a motion past a full turn loses none, however close.
    pub(crate) const fn loses_digits(self) -> bool {
        !matches!(self, Self::Jet(RotationChart::ModifiedRodrigues))
    }
}

impl fmt::Display for Chart {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::LeftInvariant => f.write_str("left_invariant"),
            Self::RightInvariant => f.write_str("right_invariant"),
            Self::Hybrid => f.write_str("hybrid"),
            // The plane has one angle, which needs no name.
            Self::Jet(RotationChart::Angle) => f.write_str("jet"),
            Self::Jet(rotation) => write!(f, "jet({rotation})"),
            Self::Own => f.write_str("own"),
        }
    }
}

/// Coordinates of a rotation R, body to observer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
#[doc(alias = "euler angles")]
#[doc(alias = "roll pitch yaw")]
pub enum RotationChart {
    /// Three angles about axes of the body, in sequence. Singular where the middle angle aligns the outer axes.
    Euler(EulerSequence),
    /// The Rodrigues (Gibbs) vector `g = tan(θ/2) n`. Singular at half a turn.
    Rodrigues,
    /// The modified Rodrigues parameters `σ = tan(θ/4) n`. Singular at a full turn, which |σ| ≤ 1 stays away from.
    ModifiedRodrigues,
    /// The angle of the plane, about k₃ = e₃.
    Angle,
}

impl fmt::Display for RotationChart {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Euler(sequence) => sequence.fmt(f),
            Self::Rodrigues => f.write_str("rodrigues"),
            Self::ModifiedRodrigues => f.write_str("modified_rodrigues"),
            Self::Angle => f.write_str("angle"),
        }
    }
}

/// The axes of Euler angles: `R = R_a0(α₀) R_a1(α₁) R_a2(α₂)`, each rotation about an axis of the already turned body.
///
/// Neighbouring axes differ, so there are twelve sequences: six Tait–Bryan (three axes) and six proper Euler (first =
/// last).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[doc(alias = "euler angles")]
#[doc(alias = "roll pitch yaw")]
pub struct EulerSequence {
    /// Axes in the order of the factors: 0 = x, 1 = y, 2 = z.
    pub axes: [u8; 3],
}

impl EulerSequence {
    /// Yaw, pitch, roll.
    pub const ZYX: Self = Self { axes: [2, 1, 0] };
    /// Precession, nutation, spin.
    pub const ZXZ: Self = Self { axes: [2, 0, 2] };

    /// All twelve sequences, Tait–Bryan first.
    pub const ALL: [Self; 12] = [
        Self::ZYX,
        Self { axes: [0, 1, 2] },
        Self { axes: [0, 2, 1] },
        Self { axes: [1, 0, 2] },
        Self { axes: [1, 2, 0] },
        Self { axes: [2, 0, 1] },
        Self::ZXZ,
        Self { axes: [0, 1, 0] },
        Self { axes: [0, 2, 0] },
        Self { axes: [1, 0, 1] },
        Self { axes: [1, 2, 1] },
        Self { axes: [2, 1, 2] },
    ];

    /// Whether the axes are 0, 1 or 2 and neighbours differ: otherwise three angles do not reach every rotation.
    #[must_use]
    pub const fn is_valid(self) -> bool {
        let [a, b, c] = self.axes;
        a < 3 && b < 3 && c < 3 && a != b && b != c
    }
}

impl fmt::Display for EulerSequence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("euler_")?;
        self.axes.iter().try_for_each(|axis| {
            f.write_str(match axis {
                0 => "x",
                1 => "y",
                2 => "z",
                _ => "?",
            })
        })
    }
}

#[cfg(test)]
mod tests;
