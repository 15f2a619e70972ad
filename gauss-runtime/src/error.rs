//! Parameters that no body has: which field, which value, which rule.

use core::fmt;

/// The most violations that one error lists; a scene has a handful of fields, and each reports once.
pub const MOST_VIOLATIONS: usize = 8;

/// What a parameter of a body has to satisfy.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Rule {
    /// Every number is finite.
    Finite,
    /// What is made of the parameters stays within the range of the scalar. The value is the infinite or undefined result.
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
    /// An inertia tensor is positive definite. The value is its smallest principal moment.
    PositiveDefiniteInertia,
    /// The moments of inertia about the centre of mass, `I_O − m(|c|² 1 − c cᵀ)`, are positive. The value is the smallest.
    InertiaAboutCenterOfMass,
    /// No principal moment of inertia exceeds the sum of the other two. The value is the largest moment.
    TriangleInequality {
        /// Which principal axis has the largest moment, from 0; the body axis itself when the tensor is diagonal.
        axis: usize,
        /// The sum of the other two moments.
        sum: f64,
        /// By how much the largest moment exceeds the sum.
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
                     is {value}); choose units in which the parameters are nearer to 1"
                )
            }
            Rule::PositiveMass => {
                write!(
                    f,
                    "`{field}` is {value}: a mass must be greater than 0; give the mass of the body in your units"
                )
            }
            Rule::NonNegative => {
                write!(f, "`{field}` is {value}: it must be 0 or greater; check its sign")
            }
            Rule::SymmetricInertia { row, col } => write!(
                f,
                "`{field}`: entries ({row}, {col}) and ({col}, {row}) differ by {value}: an inertia tensor is symmetric; \
                 products of inertia enter it twice, with the minus sign"
            ),
            Rule::PositiveDefiniteInertia => write!(
                f,
                "`{field}` has the smallest principal moment {value}: it must be greater than 0; check the diagonal, \
                 and the sign and size of the products of inertia"
            ),
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
                     by {excess}: no distribution of mass has it; check the moments and their units"
                )
            }
            Rule::SymmetricAddedMass { row, col } => write!(
                f,
                "`{field}`: entries ({row}, {col}) and ({col}, {row}) differ by {value}: added mass is symmetric in an \
                 ideal fluid; use the symmetric part, and check the order (u, ω)"
            ),
            Rule::PositiveDefiniteKineticMatrix => write!(
                f,
                "`{field}` makes the kinetic energy of body and fluid indefinite (smallest scaled eigenvalue {value}): it \
                 must be positive for every motion; check signs, and that all refers to the pole O"
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
    list: alloc::boxed::Box<ViolationList>,
    #[cfg(not(feature = "alloc"))]
    list: ViolationList,
}

impl ParameterError {
    /// What is wrong, at least one violation and at most [`MOST_VIOLATIONS`].
    #[must_use]
    pub fn violations(&self) -> &[Violation] {
        self.list.as_slice()
    }
}

impl fmt::Debug for ParameterError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ParameterError").field("violations", &self.violations()).finish()
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

/// A bounded list, so that checking parameters needs no allocator.
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct ViolationList {
    items: [Violation; MOST_VIOLATIONS],
    count: usize,
}

impl ViolationList {
    pub(crate) const fn new() -> Self {
        let blank = Violation { field: "", value: 0.0, rule: Rule::Finite };
        Self { items: [blank; MOST_VIOLATIONS], count: 0 }
    }

    pub(crate) fn as_slice(&self) -> &[Violation] {
        &self.items[..self.count]
    }

    /// Adds a violation; what does not fit is dropped, the list says enough by then.
    pub(crate) fn push(&mut self, violation: Violation) {
        if let Some(slot) = self.items.get_mut(self.count) {
            *slot = violation;
            self.count += 1;
        }
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
