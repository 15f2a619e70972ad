//! Parameters that no body has: which field, which value, which rule. And parameters that a body can have, but hardly
//! should.

use core::fmt;

/// The most violations that one error lists, and the most warnings; a scene has a handful of fields, and each reports
/// once.
pub const MOST_VIOLATIONS: usize = 8;

/// A rule that parameters of bodies satisfy.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Rule {
    /// Every number is finite.
    Finite,
    /// Constants that are computed from the parameters stay within the range of the scalar. The value is the infinite
    /// or undefined result.
    OutOfRange,
    /// A mass is greater than zero.
    PositiveMass,
    /// A parameter is zero or greater.
    NonNegative,
    /// An inertia tensor is symmetric: entries (row, col) and (col, row) agree up to rounding. The value is their
    /// difference.
    SymmetricInertia {
        /// Row of the entry, from 0.
        row: usize,
        /// Column of the entry, from 0.
        col: usize,
    },
    /// The stiffness of a spring or a stop is zero or greater.
    NonNegativeStiffness,
    /// A stop sets in over a distance that is greater than zero.
    PositiveWidth,
    /// A semi-axis of an ellipsoid is greater than zero, and so is its square.
    PositiveLength,
    /// The lower limit of a stop, the value, is below its upper one.
    LimitsInOrder {
        /// The upper limit.
        most: f64,
    },
    /// A direction is a vector that is not zero, a tangent one that is not along the normal. The value is the square of
    /// what is left of it.
    Direction,
    /// A coefficient of restitution is from 0 to 1: an impact takes energy, and does not draw together.
    Restitution,
    /// Bodies without mass, or without some moment of inertia, move together with others that make up for it; so do
    /// coordinates with an armature of zero. The value is the smallest eigenvalue of their mass matrix scaled to a unit
    /// diagonal, 0.
    RegularSum,
    /// An inertia tensor is positive definite; of a body that others move with, no moment is negative. The value is its
    /// smallest principal moment.
    PositiveDefiniteInertia,
    /// The moments of inertia about the centre of mass, `I_O − m(|c|² 1 − c cᵀ)`, are positive. The value is the
    /// smallest.
    InertiaAboutCenterOfMass,
    /// No principal moment of inertia exceeds the sum of the other two. The value is the largest moment.
    TriangleInequality {
        /// Which principal axis has the largest moment, from 0; the body axis itself when the tensor is diagonal.
        axis: usize,
        /// The sum of the other two moments.
        sum: f64,
        /// Excess of the largest moment over the sum.
        excess: f64,
        /// Whether the moments are those about the centre of mass, rather than about O as given.
        about_center_of_mass: bool,
    },
    /// A matrix of added mass is symmetric. The value is the difference of entries (row, col) and (col, row).
    SymmetricAddedMass {
        /// Row of the entry, from 0, in the order (u, ω).
        row: usize,
        /// Column of the entry, from 0.
        col: usize,
    },
    /// The stiffness and the damping of a bushing, or of modes, are symmetric. The value is the difference of entries
    /// (row, col) and (col, row).
    SymmetricCoefficients {
        /// Row of the entry, from 0; of a bushing displacements first.
        row: usize,
        /// Column of the entry, from 0.
        col: usize,
    },
    /// The stiffness matrix of a bushing, or of modes, has no negative eigenvalue. The value is its smallest
    /// eigenvalue, in the units given.
    SemidefiniteStiffness,
    /// Each mode of a body moves mass. The value is the modal mass that is not positive.
    PositiveModalMass,
    /// The kinetic energy of a body that deforms is negative for no motion: its modes take no more of the mass than it
    /// has. The value is the smallest eigenvalue of mass, first moment, inertia, participations and modal masses.
    SemidefiniteModes,
    /// The kinetic energy of body and fluid is positive for every motion. The value is the smallest eigenvalue of the
    /// mass matrix scaled to a unit diagonal, or the diagonal entry that is not positive.
    PositiveDefiniteKineticMatrix,
    /// The mass matrix can be inverted in the scalar's precision. The value is the condition number after scaling to a
    /// unit diagonal.
    ConditionedKineticMatrix {
        /// The largest condition number that is accepted: 1/ε.
        limit: f64,
    },
}

/// One rule broken by one field.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Violation {
    /// The field of the struct of parameters.
    pub field: &'static str,
    /// The number that breaks the rule: see the rule for what it is.
    pub value: f64,
    /// The rule.
    pub rule: Rule,
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { field, value, rule } = self;
        match rule {
            Rule::Finite => {
                write!(f, "`{field}` contains {value}: every number must be finite; check how it is computed")
            }
            Rule::OutOfRange => {
                write!(
                    f,
                    "`{field}` and the other parameters together leave the range of the scalar (a constant of the kernel \
                     is {value}); none by which others are divided, as a length, may be 0, and units are best in which \
                     the parameters are near 1"
                )
            }
            Rule::PositiveMass if *value == 0.0 => write!(
                f,
                "`{field}` is 0: a body that is alone has a mass, also where it has added mass; give the mass of the body \
                 in your units"
            ),
            Rule::PositiveMass => {
                write!(
                    f,
                    "`{field}` is {value}: a mass must be greater than 0; give the mass of the body in your units"
                )
            }
            Rule::NonNegative => {
                write!(f, "`{field}` is {value}: it must be 0 or greater; check its sign")
            }
            Rule::Direction => write!(
                f,
                "`{field}` has no direction: it is zero, or along the normal; give a vector of any other length and direction"
            ),
            Rule::Restitution => write!(
                f,
                "`{field}` is {value}: a coefficient of restitution is from 0, without rebound, to 1, without loss"
            ),
            Rule::NonNegativeStiffness => write!(
                f,
                "`{field}` is {value}: a stiffness is 0 or greater, and pulls back; check its sign, or write what pushes \
                 away as a `potential`"
            ),
            Rule::PositiveLength => write!(
                f,
                "`{field}` is {value}: a semi-axis of an ellipsoid is greater than 0, and so is its square; of what is flat \
                 write `rim = …`, or its points"
            ),
            Rule::PositiveWidth => write!(
                f,
                "`{field}` is {value}: the width over which a stop sets in must be greater than 0; give a length (an \
                 angle) that steps of the run resolve"
            ),
            Rule::LimitsInOrder { most } => write!(
                f,
                "`{field}` is {value}, and the upper limit of the same stop is {most}: the lower limit lies below; \
                 exchange the two"
            ),
            Rule::RegularSum => write!(
                f,
                "`{field}` is zero, and nothing that moves with it makes up for that: the mass matrix is singular in \
                 every configuration; give the body mass or inertia, the coordinate an armature, or take away the speed \
                 that nothing resists"
            ),
            Rule::SymmetricInertia { row, col } => write!(
                f,
                "`{field}`: entries ({row}, {col}) and ({col}, {row}) differ by {value}: an inertia tensor is symmetric; \
                 products of inertia enter it twice, with the minus sign"
            ),
            Rule::PositiveDefiniteInertia => {
                let rule = if *value < 0.0 { "no body has a negative one" } else { "it must be greater than 0" };
                write!(
                    f,
                    "`{field}` has the smallest principal moment {value}: {rule}; check the diagonal, and the sign and \
                     size of the products of inertia"
                )
            }
            Rule::InertiaAboutCenterOfMass => write!(
                f,
                "`{field}` leaves the smallest principal moment {value} about the centre of mass: it must be greater than \
                 0; give the inertia about O, not about the centre of mass"
            ),
            Rule::TriangleInequality { axis, sum, excess, about_center_of_mass } => {
                let about = if *about_center_of_mass { " about the centre of mass" } else { "" };
                write!(
                    f,
                    "`{field}`: the principal moment {value}{about} (axis {axis}) exceeds the sum {sum} of the other two \
                     by {excess}: no distribution of mass has it; check the moments and their units, or write \
                     `waive(triangle_inequality)` if the body is formal"
                )
            }
            Rule::SymmetricAddedMass { row, col } => write!(
                f,
                "`{field}`: entries ({row}, {col}) and ({col}, {row}) differ by {value}: added mass is symmetric in an \
                 ideal fluid; use the symmetric part, and check the order (u, ω)"
            ),
            Rule::SymmetricCoefficients { row, col } => write!(
                f,
                "`{field}`: entries ({row}, {col}) and ({col}, {row}) differ by {value}: a stiffness has a potential energy, \
                 and a damping a dissipation function, where it is symmetric; use the symmetric part"
            ),
            Rule::SemidefiniteStiffness => write!(
                f,
                "`{field}` has the eigenvalue {value}: a stiffness matrix has none below 0, and pulls back along every \
                 direction; check its signs, or write what pushes away as a `potential`"
            ),
            Rule::PositiveModalMass => {
                write!(f, "the modes of `{field}` have the modal mass {value}: each moves mass; give ∫φ² dm")
            }
            Rule::SemidefiniteModes => write!(
                f,
                "the modes of `{field}` take more of the mass than the body has (eigenvalue {value} of mass, inertia, \
                 participations and modal masses together); check units and the pole O, and that modal masses and \
                 participations are of the same normalisation"
            ),
            Rule::PositiveDefiniteKineticMatrix => write!(
                f,
                "`{field}` makes the kinetic energy of body and fluid indefinite (smallest scaled eigenvalue {value}): it \
                 must be positive for every motion; check signs (added mass is minus the derivatives X_u̇ … N_ṙ), and that all \
                 refers to the pole O"
            ),
            Rule::ConditionedKineticMatrix { limit } => write!(
                f,
                "`{field}` makes the mass matrix singular to working precision: its condition {value:e} after scaling \
                 exceeds {limit:e}; move O nearer to the centre of mass, or use a wider scalar"
            ),
        }
    }
}

/// Every violation of a struct of parameters, in the order of the checks.
#[derive(Clone, PartialEq)]
pub struct ParameterError {
    // Boxed where there is an allocator, so that results stay small; the error path may allocate.
    #[cfg(feature = "alloc")]
    list: alloc::boxed::Box<BoundedList<Violation>>,
    #[cfg(not(feature = "alloc"))]
    list: BoundedList<Violation>,
}

impl ParameterError {
    /// The violations: at least one, at most [`MOST_VIOLATIONS`].
    #[must_use]
    pub fn violations(&self) -> &[Violation] {
        self.list.as_slice()
    }
}

/// As `Display`: what `main` and `unwrap` print are the sentences.
impl fmt::Debug for ParameterError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl fmt::Display for ParameterError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.violations() {
            [one] => write!(f, "{one}"),
            several => {
                write!(f, "{} parameters are not those of a body:", several.len())?;
                several.iter().try_for_each(|violation| write!(f, "\n- {violation}"))
            }
        }
    }
}

impl core::error::Error for ParameterError {}

/// Effect of a matrix of drag on the velocity V = (u, ω) of a body relative to the medium.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum DragKind {
    /// `F_i = −Σ_j D_ij V_j`.
    Linear,
    /// `F_i = −Σ_j D_ij |V_j| V_j`.
    Quadratic,
}

impl fmt::Display for DragKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Linear => "linear",
            Self::Quadratic => "quadratic",
        })
    }
}

/// A value of a parameter that is valid, but likely a mistake.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Finding {
    /// A matrix of drag D delivers energy. The value is the smallest eigenvalue of its symmetric part, in the units
    /// given.
    ///
    /// Of linear drag VᵀDV is the power taken. Quadratic drag takes `|V_j| VᵀDV` from velocities whose components all
    /// have the same size |V_j|; others are not looked at.
    DragFeedsEnergy {
        /// Linear or quadratic.
        kind: DragKind,
    },
    /// The damping of a spring or a stop, or a Rayleigh dissipation function, delivers energy. The value is the
    /// coefficient, or the value of the function at the state where it was found to be negative.
    DampingFeedsEnergy,
    /// The damping of a bushing, or of modes, delivers energy. The value is the smallest eigenvalue of its matrix, in
    /// the units given.
    BushingFeedsEnergy,
    /// A gravity of one number is negative: bodies fall upward. The value is that number.
    GravityUpward,
    /// A centre pushes away. The value is its gravitational parameter.
    CenterRepels,
    /// A diagonal entry of an added mass is negative, which is the sign of the derivatives X_u̇ … N_ṙ (SNAME 1950). The
    /// value is that entry.
    AddedMassOfDerivatives,
}

/// One finding about one parameter. The kernel works as given.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ParameterWarning {
    /// The field of the struct of parameters, or the text that is written in its place.
    pub field: &'static str,
    /// The number that the finding is about: see the finding for what it is.
    pub value: f64,
    /// The finding.
    pub finding: Finding,
}

impl fmt::Display for ParameterWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { field, value, finding } = self;
        match finding {
            Finding::DragFeedsEnergy { kind: DragKind::Linear } => write!(
                f,
                "`linear` drag feeds energy: the symmetric part of `{field}` has the eigenvalue {value}, and drag is \
                 −`{field}`·(u, ω); check its signs"
            ),
            Finding::DragFeedsEnergy { kind: DragKind::Quadratic } => write!(
                f,
                "`quadratic` drag feeds energy: velocities with components V_j of equal size meet it as linear drag, and \
                 the symmetric part of `{field}` has the eigenvalue {value}; drag is −Σ_j `{field}`_ij |V_j| V_j; check \
                 its signs"
            ),
            Finding::DampingFeedsEnergy => write!(
                f,
                "damping feeds energy: `{field}` is {value}, and damping takes energy out where that is positive; \
                 check its sign"
            ),
            Finding::BushingFeedsEnergy => write!(
                f,
                "damping feeds energy: `{field}` has the eigenvalue {value}, and a damping matrix takes energy out where \
                 none is below 0; check its signs"
            ),
            Finding::GravityUpward => write!(
                f,
                "`{field}` is {value}: a gravity of one number is how fast things fall, and a negative one makes them \
                 fall upward; write its magnitude, or a vector"
            ),
            Finding::CenterRepels => write!(
                f,
                "`{field}` is {value}: a center with a negative gravitational parameter pushes away; check its sign"
            ),
            Finding::AddedMassOfDerivatives => write!(
                f,
                "`{field}` has {value} on its diagonal: in an ideal fluid added mass is 0 or greater there; hydrodynamic \
                 derivatives X_u̇ … N_ṙ have the opposite sign: give −X_u̇ … −N_ṙ"
            ),
        }
    }
}

/// Every finding about a struct of parameters, in the order of the checks; often none.
#[derive(Clone, PartialEq)]
pub struct ParameterWarnings {
    pub(crate) list: BoundedList<ParameterWarning>,
}

impl ParameterWarnings {
    /// Whether there is nothing to say.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.as_slice().is_empty()
    }

    /// The findings, at most [`MOST_VIOLATIONS`].
    #[must_use]
    pub fn as_slice(&self) -> &[ParameterWarning] {
        self.list.as_slice()
    }

    /// The findings in order.
    pub fn iter(&self) -> core::slice::Iter<'_, ParameterWarning> {
        self.as_slice().iter()
    }
}

impl IntoIterator for ParameterWarnings {
    type Item = ParameterWarning;
    type IntoIter = core::iter::Take<core::array::IntoIter<ParameterWarning, MOST_VIOLATIONS>>;

    fn into_iter(self) -> Self::IntoIter {
        self.list.items.into_iter().take(self.list.count)
    }
}

impl<'a> IntoIterator for &'a ParameterWarnings {
    type Item = &'a ParameterWarning;
    type IntoIter = core::slice::Iter<'a, ParameterWarning>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl fmt::Debug for ParameterWarnings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self).finish()
    }
}

impl fmt::Display for ParameterWarnings {
    /// One finding a line; nothing when there are none.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (n, warning) in self.iter().enumerate() {
            let separator = if n > 0 { "\n" } else { "" };
            write!(f, "{separator}{warning}")?;
        }
        Ok(())
    }
}

/// A bounded list, so that checking parameters needs no allocator.
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct BoundedList<I> {
    items: [I; MOST_VIOLATIONS],
    count: usize,
}

impl<I: Copy> BoundedList<I> {
    /// An empty list; `blank` fills what is not used.
    const fn of(blank: I) -> Self {
        Self { items: [blank; MOST_VIOLATIONS], count: 0 }
    }

    pub(crate) fn as_slice(&self) -> &[I] {
        &self.items[..self.count]
    }

    /// Adds an item; where the list is full, the item is dropped.
    pub(crate) fn push(&mut self, item: I) {
        if let Some(slot) = self.items.get_mut(self.count) {
            *slot = item;
            self.count += 1;
        }
    }
}

impl BoundedList<Violation> {
    pub(crate) const fn new() -> Self {
        Self::of(Violation { field: "", value: 0.0, rule: Rule::Finite })
    }

    pub(crate) fn into_result(self) -> Result<(), ParameterError> {
        if self.count == 0 {
            return Ok(());
        }
        #[cfg(feature = "alloc")]
        let list = alloc::boxed::Box::new(self);
        #[cfg(not(feature = "alloc"))]
        let list = self;
        Err(ParameterError { list })
    }
}

impl BoundedList<ParameterWarning> {
    pub(crate) const fn new() -> Self {
        let finding = Finding::DragFeedsEnergy { kind: DragKind::Linear };
        Self::of(ParameterWarning { field: "", value: 0.0, finding })
    }
}
