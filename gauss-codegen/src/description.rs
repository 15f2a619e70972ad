//! A scene in words as plain data: its coordinates, speeds and inputs by name, its frames, joints and contacts.
//!
//! `#[derive(GaussDynamics)]` writes the same into states, inputs and classes of Python. A tool that makes kernels at
//! run time reads it here.

/// The names of a scene. It refers to none.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Description {
    /// The doc comment of the struct.
    pub documentation: String,
    /// Coordinates, with the states of elements behind them, in the order of the clauses. In a configuration all
    /// scalars stand behind all others.
    pub coordinates: Vec<Quantity>,
    /// Number of the states of elements among the coordinates.
    pub states: usize,
    /// Speeds, in their order.
    pub speeds: Vec<Quantity>,
    /// Inputs, in their order.
    pub inputs: Vec<Quantity>,
    /// Names of the frames of `frames(…)`.
    pub frames: Vec<String>,
    /// Names of the joints of `reactions(…)`.
    pub joints: Vec<String>,
    /// Names of the coordinates of `motion(…)`, whose driving forces are known.
    pub motions: Vec<String>,
    /// Contacts, ranges and dry joints, in the order of their rows.
    pub contacts: Vec<ContactDescription>,
    /// The count of the first numbers of the halves of A⁻¹Wᵀ, the pivots of A and what is below them, where velocities
    /// of contact impulses come from halves. Numbers of rows follow.
    pub factors: Option<usize>,
    /// Whether nothing but contacts can raise the energy.
    pub keeps_energy: bool,
    /// Remarks about the robot's file, in words that are not of Rust.
    pub remarks: Vec<Remark>,
    /// Whether a run can drift away from constraints, so that states are projected onto them.
    pub is_constrained: bool,
}

/// A coordinate, a speed or an input.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Quantity {
    /// Its name.
    pub name: String,
    /// Its type.
    pub kind: QuantityKind,
    /// Its meaning, with the unit where that is known.
    pub label: String,
    /// The names of its numbers, in their order.
    pub numbers: Vec<String>,
}

/// A contact, a range, dry friction or rolling resistance, with the kinds of its rows.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct ContactDescription {
    /// Its name.
    pub name: String,
    /// Whether it has a gap, whose normal is its first row.
    pub has_gap: bool,
    /// Number of its tangents.
    pub tangents: usize,
    /// Whether a row of friction of drilling follows the tangents.
    pub drills: bool,
    /// Place of the contact whose normal force bounds its rolling resistance.
    pub rolls_on: Option<usize>,
    /// Names of the bodies that touch, where they are known: of the one that has the point, and of the other.
    pub bodies: [Option<String>; 2],
    /// Whether its gap depends on the time, not through the motion alone.
    pub moves: bool,
    /// Number of axes of its frame, the normal among them: 0 where its place is not known.
    pub axes: usize,
}

impl ContactDescription {
    /// Number of its rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        usize::from(self.has_gap) + self.tangents + usize::from(self.drills)
    }
}

/// The type of a coordinate, a speed or an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum QuantityKind {
    /// One number.
    Scalar,
    /// This many numbers.
    Vector(usize),
    /// A rotation: the unit quaternion i, j, k, w.
    Rotation,
    /// A pose: the unit quaternion of the rotation, then the position.
    Pose,
    /// A pose in the plane: cosine, sine, then the position.
    Plane,
}

impl QuantityKind {
    /// Count of its first numbers whose squares add up to 1.
    #[must_use]
    pub fn unit_components(self) -> usize {
        match self {
            Self::Scalar | Self::Vector(_) => 0,
            Self::Rotation | Self::Pose => 4,
            Self::Plane => 2,
        }
    }
}

/// A remark about a robot's file.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Remark {
    /// The remark, with its place in the file.
    pub text: String,
    /// Whether something that acts in the file does not act in the equations.
    pub ignored: bool,
}
