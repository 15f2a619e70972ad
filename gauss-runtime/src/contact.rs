//! Contacts and dry friction: gaps that may close and not become negative, slips that are resisted, and what a solver
//! of their laws needs of a system.
//!
//! A contact has a gap `g(t, q) ≥ 0`, its rate ġ along the normal, and rates s of slip along one or two tangents. With
//! the rows `W = ∂(ġ, s)/∂z` contact forces λ (normal, then tangential, contact by contact) enter Gauss' condition as
//! `A ż = r + Wᵀλ`: where C is minimised subject to `g̈ ≥ 0` for closed gaps, λ are the multipliers, and
//! `(ġ, s)˙ = D λ + b` with Delassus' matrix `D = W A⁻¹ Wᵀ` and `b = W A⁻¹ r + γ` (J. J. Moreau, *Unilateral contact
//! and dry friction in finite freedom dynamics*, 1988). What the laws of contact and friction make of that is for
//! a solver, such as the crate `gauss-contact`: the equations of a kernel are those of its motion without contact
//! forces.
//!
//! Dry friction of a given bound f, as in a brake or a joint, is a contact without a normal: its rows are slips s, and
//! its forces are at most f.
//!
//! Friction of drilling is a row after the tangents: the relative angular velocity about the normal times a length,
//! so that all rows of friction are velocities and all of their forces are bounded together (P. Contensou 1963).
//! Rolling resistance is a contact of its own without a gap, whose bound is a multiple of the normal force of another.
//!
//! `#[gauss(contact(…), range(…), dry_friction(…))]` has the derive write it.

use core::fmt::{self, Debug};
use core::ops::{Index, IndexMut, Range};

use nalgebra::Vector3;

use crate::configuration::VectorSpace;
use crate::forces::Columns;
use crate::real::Real;
use crate::system::GaussSystem;

/// A system some of whose gaps may close, or with dry friction.
///
/// Rows of contacts are numbered contact by contact: of each its normal, then its tangents, then its spin where there
/// is friction of drilling; of dry friction and rolling resistance only the tangents. Units are those of the gaps and
/// of slips: with lengths λ is a force, with angles a torque. Bilateral constraints of the scene hold in all of it: A⁻¹
/// is then the inverse on the velocities that they admit.
#[doc(alias = "contact")]
#[doc(alias = "impact")]
#[doc(alias = "collision")]
#[doc(alias = "unilateral")]
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no contacts",
    label = "the clauses `contact(…)`, `range(…)` and `dry_friction(…)` bring them",
    note = "stops and friction that give way are forces, not contacts"
)]
pub trait ContactSystem: GaussSystem {
    /// `SVector<Scalar, C>`, C contacts: one component for each.
    type Gaps: VectorSpace<Self::Scalar>;

    /// `SVector<Scalar, R>`, R rows: rates, accelerations and forces of contacts.
    type ContactRows: VectorSpace<Self::Scalar>;

    /// `SMatrix<Scalar, DOF, R>`, one column for each row of the contacts.
    type ContactColumns: Columns<Self::Speeds> + Copy + Debug;

    /// Factors from which [`impulse_velocities`](Self::impulse_velocities) makes A⁻¹WᵀP at a (t, q): A⁻¹Wᵀ, or of long
    /// trees the factors of A and L⁻¹ of each row of W.
    type ImpulseFactors: Copy + Debug;

    /// `SMatrix<Scalar, R, R>`, with entries by `(row, column)`.
    type Delassus: Copy + Debug + Index<(usize, usize), Output = Self::Scalar>;

    /// `[T; C]`: something of each contact.
    type EachContact<T: Copy + Debug>: Each<T>;

    /// `[T; R]`: something of each row.
    type EachRow<T: Copy + Debug>: Each<T>;

    /// The contacts, in the order in which they are written. Names are unique. A kernel that was compiled has the list
    /// of its struct, one that came at run time that of its model: rows may be fewer than
    /// [`ContactRows`](Self::ContactRows) has room for, and those behind them are zero.
    fn contacts(&self) -> &'static [Contact];

    /// g(t, q) of each contact: positive where it is open; 0 of dry friction and of rolling resistance.
    fn gaps(&self, t: Self::Scalar, q: &Self::Configuration) -> Self::Gaps;

    /// ġ, then the slip s of each tangent and the spin, contact by contact; of contacts with a gap they are velocities
    /// of the first body's point at the contact relative to what it touches. The spin is the relative angular velocity
    /// about the normal times the radius of drilling; slips of rolling resistance are relative angular velocities about
    /// the tangents.
    fn contact_rates(&self, t: Self::Scalar, q: &Self::Configuration, z: &Self::Speeds) -> Self::ContactRows;

    /// Wᵀ, `W = ∂(ġ, s)/∂z`: the generalised force of a unit contact force, column by column.
    fn contact_jacobian(&self, t: Self::Scalar, q: &Self::Configuration) -> Self::ContactColumns;

    /// Point, normal and tangents of a contact, by its number among [`contacts`](Self::contacts); `None` of gaps and
    /// slips that are written as expressions, of ranges and of dry friction.
    fn contact_frame(
        &self,
        contact: usize,
        t: Self::Scalar,
        q: &Self::Configuration,
    ) -> Option<ContactFrame<Self::Scalar>> {
        let _ = (contact, t, q);
        None
    }

    /// The bounds of friction, row by row: μ of each tangent of a contact and of its spin, f of each slip of dry
    /// friction, in its generalised force, ρ of rolling resistance; 0 of normals. The rows of a contact are the axes of
    /// an ellipse or an ellipsoid: `(λ₁/μ₁)² + (λ₂/μ₂)² + (λ₃/μ₃)² ≤ λ_N²`, or with f in the place of μ `… ≤ 1`.
    fn friction(
        &self,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
        input: &Self::Input,
    ) -> Self::ContactRows;

    /// The coefficient of restitution e of each contact; 0 where none is given.
    fn restitution(&self) -> Self::Gaps;

    /// Factors of A⁻¹Wᵀ and the matrix `W A⁻¹ Wᵀ` at (t, q): enough where some impulses act, as in steps.
    fn impulse_response(&self, t: Self::Scalar, q: &Self::Configuration) -> ImpulseResponse<Self>;

    /// The motion without contact forces at (t, q, z), with b = `W ż + γ` of it and what contact impulses do.
    fn impulse_dynamics(
        &self,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
        input: &Self::Input,
    ) -> ImpulseDynamics<Self>;

    /// `A⁻¹WᵀP`: what impulses P add to the speeds.
    fn impulse_velocities(&self, factors: &Self::ImpulseFactors, impulses: &Self::ContactRows) -> Self::Speeds;

    /// Sizes of the terms that each component of [`impulse_velocities`](Self::impulse_velocities) is the sum of: a
    /// component that is no larger than their rounding is zero.
    fn impulse_terms(&self, factors: &Self::ImpulseFactors, impulses: &Self::ContactRows) -> Self::Speeds;

    /// `A⁻¹ Wᵀ`: the velocities that unit impulses make, column by column.
    fn contact_columns(&self, factors: &Self::ImpulseFactors) -> Self::ContactColumns;

    /// Columns of A⁻¹Wᵀ and the matrix `W A⁻¹ Wᵀ` at (t, q).
    #[inline]
    fn contact_response(&self, t: Self::Scalar, q: &Self::Configuration) -> ContactResponse<Self> {
        let ImpulseResponse { factors, delassus } = self.impulse_response(t, q);
        ContactResponse { columns: self.contact_columns(&factors), delassus }
    }

    /// The motion without contact forces at (t, q, z), with b = `W ż + γ` of it and what contact forces add, column by
    /// column.
    #[inline]
    fn contact_dynamics(
        &self,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
        input: &Self::Input,
    ) -> ContactDynamics<Self> {
        let ImpulseDynamics { acceleration, bias, response } = self.impulse_dynamics(t, q, z, input);
        let ImpulseResponse { factors, delassus } = response;
        let response = ContactResponse { columns: self.contact_columns(&factors), delassus };
        ContactDynamics { acceleration, bias, response }
    }
}

/// An array whose length is that of a system: memory of a solver that allocates nothing.
pub trait Each<T>: Copy + Debug + AsRef<[T]> + AsMut<[T]> + Index<usize, Output = T> + IndexMut<usize> {
    /// One by one.
    fn from_fn(of: impl FnMut(usize) -> T) -> Self;
}

impl<T: Copy + Debug, const N: usize> Each<T> for [T; N] {
    #[inline]
    fn from_fn(of: impl FnMut(usize) -> T) -> Self {
        core::array::from_fn(of)
    }
}

/// [`ContactSystem::impulse_velocities`] by columns, of systems whose factors these are.
pub fn impulse_velocities<S>(columns: &S::ContactColumns, impulses: &S::ContactRows) -> S::Speeds
where
    S: ContactSystem + ?Sized,
{
    let mut speeds = S::Speeds::zero();
    each_that_acts::<S>(columns, impulses, |impulse, column| speeds = speeds.add_scaled(impulse, column));
    speeds
}

/// [`ContactSystem::impulse_terms`] by columns, of systems whose factors these are.
pub fn impulse_terms<S>(columns: &S::ContactColumns, impulses: &S::ContactRows) -> S::Speeds
where
    S: ContactSystem + ?Sized,
{
    let mut terms = S::Speeds::zero();
    each_that_acts::<S>(columns, impulses, |impulse, column| {
        for k in 0..S::Speeds::DIM {
            terms.set_component(k, terms.component(k) + (impulse * column.component(k)).abs());
        }
    });
    terms
}

/// Impulses that are not zero in all lanes, with their columns.
fn each_that_acts<S>(columns: &S::ContactColumns, impulses: &S::ContactRows, mut act: impl FnMut(S::Scalar, &S::Speeds))
where
    S: ContactSystem + ?Sized,
{
    for row in 0..S::ContactRows::DIM {
        let impulse = impulses.component(row);
        let acts = S::Scalar::DERIVATIVES || (0..S::Scalar::LANES).any(|lane| impulse.lane(lane) != 0.0);
        if let Some(column) = columns.nth(row).filter(|_| acts) {
            act(impulse, &column);
        }
    }
}

/// One contact of a system.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub struct Contact {
    /// Its name in the scene.
    pub name: &'static str,
    /// Its first row in [`ContactRows`](ContactSystem::ContactRows): the normal, which the tangents follow; of dry
    /// friction the first tangent.
    pub normal: usize,
    /// Number of its tangents: 0 without friction, 1 where motion or scene is plane, else 2.
    pub tangents: usize,
    /// Whether a row of friction of drilling follows the tangents.
    pub drills: bool,
    /// Kind of force that bounds its friction.
    pub kind: ContactKind,
    /// The body that has the point that touches, then the one that is touched, by their names in the scene, which may
    /// be those of frames, or of links of a robot's file; `None` of what is fixed, of the only body of a chart, and of
    /// gaps and slips that are written as expressions.
    pub bodies: [Option<&'static str>; 2],
    /// Whether its gap depends on the time, not through the motion alone: nothing then bounds how fast it can change.
    pub moves: bool,
}

/// Point, normal and tangents of a contact. Components are along the observer's axes, points are from the observer's
/// origin Ω.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ContactFrame<T> {
    /// Point of contact; of an open contact the point of the first body that would touch.
    pub point: Vector3<T>,
    /// The normal, towards the first body; of length one.
    pub normal: Vector3<T>,
    tangents: [Vector3<T>; 2],
    count: usize,
}

impl<T: Real> ContactFrame<T> {
    /// From its parts; of tangents the first two, in the order of the rows.
    pub fn new(point: Vector3<T>, normal: Vector3<T>, tangents: &[Vector3<T>]) -> Self {
        let zero = Vector3::new(T::zero(), T::zero(), T::zero());
        let tangent = |k: usize| tangents.get(k).copied().unwrap_or(zero);
        Self { point, normal, tangents: [tangent(0), tangent(1)], count: tangents.len().min(2) }
    }

    /// The tangents of the slips, in the order of their rows; of length one.
    pub fn tangents(&self) -> &[Vector3<T>] {
        &self.tangents[..self.count]
    }

    /// The force on the first body at the point, from the forces of the rows of this contact.
    pub fn force(&self, rows: &[T]) -> Vector3<T> {
        let axes = core::iter::once(&self.normal).chain(self.tangents());
        axes.zip(rows).fold(Vector3::new(T::zero(), T::zero(), T::zero()), |sum, (axis, force)| {
            Vector3::new(axis[0].fma(*force, sum[0]), axis[1].fma(*force, sum[1]), axis[2].fma(*force, sum[2]))
        })
    }
}

/// Kind of force that bounds the friction of a contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ContactKind {
    /// The force along the normal of a gap.
    Gap,
    /// Nothing but [`friction`](ContactSystem::friction): there is no gap and no normal.
    DryFriction,
    /// The force along the normal of another contact: a torque resists rolling of at most ρ times it. There is no gap.
    Rolling {
        /// Place of that contact in [`contacts`](ContactSystem::contacts), before this one.
        on: usize,
    },
}

impl Contact {
    /// A contact with a gap.
    #[must_use]
    pub const fn new(name: &'static str, normal: usize, tangents: usize) -> Self {
        Self { name, normal, tangents, drills: false, kind: ContactKind::Gap, bodies: [None; 2], moves: false }
    }

    /// Dry friction along one slip or two, of which the first row is given.
    #[must_use]
    pub const fn dry_friction(name: &'static str, first: usize, tangents: usize) -> Self {
        Self {
            name,
            normal: first,
            tangents,
            drills: false,
            kind: ContactKind::DryFriction,
            bodies: [None; 2],
            moves: false,
        }
    }

    /// Rolling resistance about one tangent or two of the contact number `on`, of which the first row is given.
    #[must_use]
    pub const fn rolling(name: &'static str, first: usize, tangents: usize, on: usize) -> Self {
        Self {
            name,
            normal: first,
            tangents,
            drills: false,
            kind: ContactKind::Rolling { on },
            bodies: [None; 2],
            moves: false,
        }
    }

    /// Adds a row of friction of drilling after its tangents.
    #[must_use]
    pub const fn with_drilling(self) -> Self {
        Self { drills: true, ..self }
    }

    /// Between bodies of these names: the one that has the point that touches, and the one that is touched.
    #[must_use]
    pub const fn between(self, bodies: [Option<&'static str>; 2]) -> Self {
        Self { bodies, ..self }
    }

    /// A gap that depends on the time.
    #[must_use]
    pub const fn moving(self) -> Self {
        Self { moves: true, ..self }
    }

    /// Whether it has a gap and a normal.
    #[must_use]
    pub const fn has_gap(&self) -> bool {
        matches!(self.kind, ContactKind::Gap)
    }

    /// The contact whose normal force bounds its friction, where that is another one: of rolling resistance.
    #[must_use]
    pub const fn rolls_on(&self) -> Option<usize> {
        match self.kind {
            ContactKind::Rolling { on } => Some(on),
            _ => None,
        }
    }

    /// The rows of its tangents.
    #[must_use]
    pub const fn tangent_rows(&self) -> Range<usize> {
        let first = if self.has_gap() { self.normal + 1 } else { self.normal };
        first..first + self.tangents
    }

    /// The rows of its friction: the tangents, then the spin where there is friction of drilling.
    #[must_use]
    pub const fn friction_rows(&self) -> Range<usize> {
        let tangents = self.tangent_rows();
        tangents.start..tangents.end + self.drills as usize
    }

    /// All its rows.
    #[must_use]
    pub const fn rows(&self) -> Range<usize> {
        self.normal..self.friction_rows().end
    }
}

impl fmt::Display for Contact {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}

/// Response of the speeds to contact impulses: the result of [`ContactSystem::impulse_response`].
#[non_exhaustive]
pub struct ImpulseResponse<S: ContactSystem + ?Sized> {
    /// Factors of A⁻¹Wᵀ, for [`impulse_velocities`](ContactSystem::impulse_velocities).
    pub factors: S::ImpulseFactors,
    /// `D = W A⁻¹ Wᵀ`, symmetric and positive semidefinite.
    pub delassus: S::Delassus,
}

/// The motion without contact forces, and what impulses do: the result of [`ContactSystem::impulse_dynamics`].
#[non_exhaustive]
pub struct ImpulseDynamics<S: ContactSystem + ?Sized> {
    /// ż without contact forces.
    pub acceleration: S::Speeds,
    /// `b = W A⁻¹ r + γ`: the rates of ġ and s without contact forces.
    pub bias: S::ContactRows,
    /// Response of the speeds to contact impulses.
    pub response: ImpulseResponse<S>,
}

impl<S: ContactSystem + ?Sized> ImpulseResponse<S> {
    /// From its parts, in the order of the fields.
    #[inline(always)]
    pub fn new(factors: S::ImpulseFactors, delassus: S::Delassus) -> Self {
        Self { factors, delassus }
    }
}

impl<S: ContactSystem + ?Sized> ImpulseDynamics<S> {
    /// From its parts, in the order of the fields.
    #[inline(always)]
    pub fn new(acceleration: S::Speeds, bias: S::ContactRows, response: ImpulseResponse<S>) -> Self {
        Self { acceleration, bias, response }
    }
}

/// Response of the speeds to contact impulses, column by column: the result of [`ContactSystem::contact_response`].
#[non_exhaustive]
pub struct ContactResponse<S: ContactSystem + ?Sized> {
    /// `A⁻¹ Wᵀ`: the velocities that unit impulses make, column by column.
    pub columns: S::ContactColumns,
    /// `D = W A⁻¹ Wᵀ`, symmetric and positive semidefinite.
    pub delassus: S::Delassus,
}

/// The motion without contact forces, and what they add: the result of [`ContactSystem::contact_dynamics`].
#[non_exhaustive]
pub struct ContactDynamics<S: ContactSystem + ?Sized> {
    /// ż without contact forces.
    pub acceleration: S::Speeds,
    /// `b = W A⁻¹ r + γ`: the rates of ġ and s without contact forces.
    pub bias: S::ContactRows,
    /// Response of the speeds to contact impulses, which is that of ż to contact forces.
    pub response: ContactResponse<S>,
}

macro_rules! copied {
    ($($name:ident { $($field:ident)* })*) => {$(
        impl<S: ContactSystem + ?Sized> Clone for $name<S> {
            #[inline]
            fn clone(&self) -> Self {
                *self
            }
        }

        impl<S: ContactSystem + ?Sized> Copy for $name<S> {}

        impl<S: ContactSystem + ?Sized> fmt::Debug for $name<S> {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.debug_struct(stringify!($name))$(.field(stringify!($field), &self.$field))*.finish()
            }
        }
    )*};
}

copied! {
    ImpulseResponse { factors delassus }
    ImpulseDynamics { acceleration bias response }
    ContactResponse { columns delassus }
    ContactDynamics { acceleration bias response }
}
