//! A scene in words as plain data: its coordinates, speeds and inputs by name, its frames, joints and contacts.
//!
//! `#[derive(GaussDynamics)]` writes the same into states, inputs and classes of Python. A tool that makes kernels at
//! run time reads it here.

/// The names of a scene. It refers to none.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Description {
    /// The doc comment of the struct.
    pub documentation: String,
    /// Coordinates, with the states of elements behind them, in the order of the clauses. In a configuration all
    /// scalars stand behind all others.
    pub coordinates: Vec<Quantity>,
    /// Speeds, in their order.
    pub speeds: Vec<Quantity>,
    /// Inputs, in their order.
    pub inputs: Vec<Quantity>,
    /// Names of the frames of `frames(…)`.
    pub frames: Vec<String>,
    /// Names of the joints of `reactions(…)`.
    pub joints: Vec<String>,
    /// Names of contacts, ranges and dry joints.
    pub contacts: Vec<String>,
    /// Remarks about the robot's file, in words that are not of Rust.
    pub remarks: Vec<Remark>,
    /// Whether a run can drift away from constraints, so that states are projected onto them.
    pub is_constrained: bool,
}

/// A coordinate, a speed or an input.
#[derive(Clone, Debug, PartialEq, Eq)]
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

/// The type of a coordinate, a speed or an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
#[non_exhaustive]
pub struct Remark {
    /// The remark, with its place in the file.
    pub text: String,
    /// Whether something that acts in the file does not act in the equations.
    pub ignored: bool,
}
