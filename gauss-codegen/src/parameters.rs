//! The parameters of a struct as plain data: what its fields hold, what `kernel()` checks of them, and the tables that
//! its equations call.
//!
//! `#[derive(GaussDynamics)]` writes the same checks as Rust. A tool that makes kernels at run time reads them here:
//! each is a [`Rule`] about numbers, which are given, or computed from those by a program.

use crate::program::Program;

pub use crate::terms::Interpolation;

/// The fields of a struct, and what must hold of their numbers. It refers to no scene.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Parameters {
    /// In the order of the fields; a body is three of them. Fields of other types are left out.
    pub list: Vec<Parameter>,
    /// Which of their numbers, counted through the list, is each argument of
    /// [`Derivation::constants`](crate::Derivation::constants).
    pub read: Vec<usize>,
    /// In the order in which they are made.
    pub checks: Vec<Check>,
    /// Rules whose breach is likely not meant, although a kernel can be made.
    pub warnings: Vec<Warning>,
    /// Program of the numbers that checks are about and nobody gives: from the arguments of
    /// [`Derivation::constants`](crate::Derivation) the numbers of [`Given::Computed`].
    pub computed: Program,
    /// The field that speaks for constants that leave the range of numbers.
    pub label: String,
    /// Bodies without mass may move with others: where [`Rule::MassInSum`] and its like found one, the mass matrix is
    /// to be regular.
    pub in_sum: bool,
    /// Functions that the struct declares, by the index that programs call each by; none where it is one of Rust.
    pub tables: Vec<Option<TableClause>>,
}

/// A function by its values at points. Its numbers are constants of Rust, which are not read here.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct TableClause {
    /// The name of the function in the equations.
    pub name: String,
    /// Paths of the constants with the numbers along each axis of the grid; none: the values are points [x, y].
    pub axes: Vec<String>,
    /// The path of the constant with the values, an array of as many dimensions as there are axes.
    pub values: String,
    /// Interpolation between the points.
    pub joined: Interpolation,
}

/// Numbers that are given together: a field, or a part of one that is a body.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Parameter {
    /// `m`, `arm.center_of_mass`.
    pub name: String,
    /// Count of its numbers; a matrix is row after row.
    pub count: usize,
    /// Its axes: none of a number, one of a vector, two of a matrix.
    pub axes: Vec<usize>,
    /// The unit, if one is written.
    pub unit: Option<String>,
    /// The comment of the field.
    pub documentation: String,
}

/// A number that a check is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Given {
    /// A place among the numbers of all parameters.
    Number(usize),
    /// Place among the outputs of [`Parameters::computed`].
    Computed(usize),
    /// Zero, where nothing is given.
    Zero,
}

/// A rule whose breach is likely not meant, and what it is about.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Warning {
    /// The name of the numbers in messages.
    pub label: String,
    /// The rule that they keep.
    pub rule: WarningRule,
    /// The numbers; of a matrix row after row.
    pub values: Vec<Given>,
}

/// Rules of numbers that a kernel does without: each is a method of the runtime's `WarningCheck`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum WarningRule {
    /// Drag with velocities, or with their squares where that is said, six by six: takes energy away.
    Drag {
        /// Whether it is with squares.
        quadratic: bool,
    },
    /// Damping of a spring or a stop: takes energy away.
    Damping,
    /// A square matrix that takes energy away.
    DampingMatrix,
    /// A dissipation function at a few states.
    Dissipation,
    /// Gravity of one number: points down.
    Gravity,
    /// The gravitational parameter of a centre: attracts.
    Center,
    /// The diagonal of an added mass.
    AddedMass,
}

/// A rule, and what it is about.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Check {
    /// The name of the numbers in messages.
    pub label: String,
    /// The rule that they keep.
    pub rule: Rule,
    /// The numbers; of a matrix row after row.
    pub values: Vec<Given>,
    /// Principal moments need not obey the triangle inequality.
    pub is_formal: bool,
}

/// Rules of numbers: each is a method of the runtime's `ParameterCheck`, with its arguments in order. Whoever
/// makes checks makes all of them: a rule that is added is an error of its compiler.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Rule {
    /// All are finite.
    Finite,
    /// Mass of a body alone.
    Mass,
    /// Mass of one of several bodies.
    MassInSum,
    /// Finite and zero or greater.
    NonNegative,
    /// Six by six.
    Symmetric,
    /// A tensor, three by three.
    Inertia,
    /// A mass, a centre, a tensor about O: what is left about the centre of mass.
    CentralInertia,
    /// The same, of which the moment about one axis enters.
    InertiaAboutAxis(usize),
    /// The same, of one of several bodies.
    InertiaInSum,
    /// A kinetic energy that is positive for all motions: a square matrix.
    KineticMatrix,
    /// Stiffness of a spring or a stop.
    Stiffness,
    /// Width of a stop.
    Width,
    /// Both limits of a stop, the lower one first.
    Limits,
    /// The inertia of a rate.
    Armature,
    /// A semi-axis.
    Length,
    /// A coefficient of restitution.
    Restitution,
    /// The square of a length.
    Direction,
    /// A square matrix.
    StiffnessMatrix,
    /// A square matrix.
    DampingMatrix,
    /// Mass, first moment, inertia, participations and modal masses: a square matrix.
    Modes,
}
