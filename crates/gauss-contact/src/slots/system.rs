//! A system with slots in the place of contacts that its clauses would have.

use core::fmt;
use core::ops::Range;

use gauss_runtime::__crates_0_1_0::{add, scaled, sub, triple};
use gauss_runtime::accuracy::Accuracy;
use gauss_runtime::chart::Chart;
use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::{
    Contact, ContactFrame, ContactSystem, ImpulseDynamics, ImpulseResponse, impulse_terms, impulse_velocities,
};
use gauss_runtime::description::{DescribedSystem, Equations, Operations};
use gauss_runtime::forces::{Element, ForcedSystem};
use gauss_runtime::frames::{FrameMotion, FramePose, FramedSystem};
use gauss_runtime::nalgebra::{SMatrix, SVector};
use gauss_runtime::real::Real;
use gauss_runtime::system::{GaussSystem, Smoothness};

use super::envelope::{Envelope, extents};
use super::place::{Touch, Twist, rest, turned};
use super::slot::{Slot, SlotError, SlotField, SlotRule, dot};

/// The gap of a slot that is not used: it has no rate and never closes.
const OPEN: f64 = 1.0;

/// Roundings of the largest term of a row of W below which an entry is none.
const ROUNDINGS: f64 = 8.0;

/// Names have three digits at most.
const MOST: usize = 1000;

/// A kernel with N slots for contacts: a [`ContactSystem`] whose contacts are given at run time, between any two of its
/// `frames(…)`, or one of them and what is at rest.
///
/// R is 3 N: of each contact its normal and two tangents. D is the number of speeds. The compiler finds the others of
/// `Slots::<_, 8, 24, _>::new(&kernel)`. Poses, twists, Jacobians and accelerations are those of the kernel, and so is
/// A: it is factored along its zeros, so that a response costs what the bodies that touch ask for.
///
/// Matrices of R rows are handed on by value, as in every `ContactSystem`: 64 slots of 100 speeds take half a megabyte
/// of the stack for each copy, and a build without optimisation makes several. Give such a thread 32 MB.
///
/// The scalar is that of the kernel: packs for lanes, dual numbers for derivatives. A slot is between the same frames
/// in all lanes of a pack, which have data of their own.
///
/// A kernel with constraints that speeds do not solve, or with contacts of its own, does not compile here. Of a scene
/// that moves in a plane, rows along which nothing moves are left without effect.
pub struct Slots<'k, K: FramedSystem, const N: usize, const R: usize, const D: usize> {
    kernel: &'k K,
    slots: [Option<Slot<K::Frame, K::Scalar>>; N],
}

impl<K: FramedSystem, const N: usize, const R: usize, const D: usize> Clone for Slots<'_, K, N, R, D> {
    fn clone(&self) -> Self {
        Self { kernel: self.kernel, slots: self.slots }
    }
}

impl<K: FramedSystem, const N: usize, const R: usize, const D: usize> fmt::Debug for Slots<'_, K, N, R, D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.slots.iter().flatten()).finish()
    }
}

impl<'k, T: Real, K, const N: usize, const R: usize, const D: usize> Slots<'k, K, N, R, D>
where
    K: FramedSystem<Scalar = T, Speeds = SVector<T, D>, Jacobian = SMatrix<T, 6, D>>,
{
    /// A contact for each slot.
    pub const CONTACTS: &'static [Contact] = &Self::TABLE;
    const TABLE: [Contact; N] = {
        let mut table = [Contact::new("", 0, 2); N];
        let mut i = 0;
        while i < N {
            table[i] = Contact::new(name(&Self::NAMES[i]), 3 * i, 2);
            i += 1;
        }
        table
    };
    const NAMES: &'static [([u8; 8], usize); N] = &{
        let mut names = [(*b"slot_000", 0); N];
        let mut i = 0;
        while i < N {
            names[i] = letters(i);
            i += 1;
        }
        names
    };

    /// All slots are open.
    pub fn new(kernel: &'k K) -> Self {
        const {
            assert!(R == 3 * N, "a slot has three rows: its normal and two tangents");
            assert!(N <= MOST, "slots have numbers of up to three digits");
            assert!(!K::CONSTRAINED, "slots need a kernel whose speeds satisfy its constraints by themselves");
            assert!(!K::HAS_CONTACTS, "slots need a kernel without contacts of its own; write their points as slots");
        }
        Self { kernel, slots: [None; N] }
    }

    /// The kernel.
    pub fn kernel(&self) -> &'k K {
        self.kernel
    }

    /// The data of all slots, with normals of length one; `None` where a slot is not used.
    pub fn slots(&self) -> &[Option<Slot<K::Frame, T>>; N] {
        &self.slots
    }

    /// Gives a slot its data; where they are refused it keeps those that it had.
    ///
    /// # Errors
    /// [`SlotError`]: a number beyond the last, two frames that are one, numbers that are none.
    pub fn set(&mut self, slot: usize, data: Slot<K::Frame, T>) -> Result<(), SlotError> {
        let checked = data.checked(slot)?;
        let (field, rule) = (SlotField::Number, SlotRule::Below { count: N });
        let place = self.slots.get_mut(slot).ok_or(SlotError { slot, field, value: slot as f64, rule })?;
        *place = Some(checked);
        Ok(())
    }

    /// Leaves a slot unused; nothing where there is none of that number.
    pub fn clear(&mut self, slot: usize) {
        if let Some(place) = self.slots.get_mut(slot) {
            *place = None;
        }
    }

    /// All slots from the first on, those that are left unused; where one is refused all keep what they had.
    ///
    /// # Errors
    /// [`SlotError`] of the first that is refused.
    pub fn fill(&mut self, data: impl IntoIterator<Item = Slot<K::Frame, T>>) -> Result<(), SlotError> {
        let mut filled = Self { kernel: self.kernel, slots: [None; N] };
        for (slot, data) in data.into_iter().enumerate() {
            filled.set(slot, data)?;
        }
        self.slots = filled.slots;
        Ok(())
    }

    /// Calls a function for each slot that is used, with what it is told of both frames; that is asked for again where
    /// the frame is another one than of the slot before.
    fn each<P: Clone>(
        &self,
        of: impl Fn(Option<K::Frame>) -> P,
        mut act: impl FnMut(usize, &Slot<K::Frame, T>, [&P; 2]),
    ) {
        let mut last: [Option<(Option<K::Frame>, P)>; 2] = [None, None];
        for (i, slot) in self.slots.iter().enumerate() {
            let Some(slot) = slot else { continue };
            for (last, frame) in last.iter_mut().zip([slot.first, slot.second]) {
                if last.as_ref().is_none_or(|(known, _)| *known != frame) {
                    *last = Some((frame, of(frame)));
                }
            }
            if let [Some((_, first)), Some((_, second))] = &last {
                act(i, slot, [first, second]);
            }
        }
    }

    fn pose(&self, frame: Option<K::Frame>, t: T, q: &K::Configuration) -> FramePose<T> {
        frame.map_or_else(rest, |frame| self.kernel.pose_of(frame, t, q))
    }

    /// Wᵀ, column by column.
    fn columns(&self, frames: &K::Frames) -> SMatrix<T, D, R> {
        let mut columns = SMatrix::<T, D, R>::from([[T::zero(); D]; R]);
        let moving = |frame: Option<K::Frame>| {
            let motion = frame.map(|frame| &frames[frame]);
            (motion.map_or_else(rest, |motion| motion.pose), motion, motion.map_or(0..0, speeds_of))
        };
        self.each(moving, |i, slot, motions| {
            let touch = Touch::new(slot, [&motions[0].0, &motions[1].0]);
            for (k, axis) in slot.axes().into_iter().enumerate() {
                let column = &mut columns.data.0[3 * i + k];
                // The sizes of the terms, for rounding.
                let mut sizes = [T::zero(); D];
                for (arm, (_, motion, speeds)) in touch.arms(slot, axis).iter().zip(motions) {
                    let Some(motion) = motion else { continue };
                    for j in speeds.clone() {
                        for part in 0..6 {
                            let term = arm[part] * motion.jacobian[(part, j)];
                            column[j] += term;
                            sizes[j] += term.abs();
                        }
                    }
                }
                let largest = sizes.into_iter().fold(T::zero(), T::max);
                let rounding = T::from_f64(ROUNDINGS * T::EPSILON) * largest;
                column.iter_mut().for_each(|x| *x = without_rounding(*x, rounding));
            }
        });
        columns
    }

    fn response(&self, t: T, q: &K::Configuration, frames: &K::Frames) -> ImpulseResponse<Self> {
        let mut columns = self.columns(frames);
        let matrix = self.kernel.mass_matrix(t, q);
        let factor = Envelope::of(SMatrix::<T, D, D>::from_fn(|i, j| matrix[(i, j)]));
        let from = extents(&columns);
        for (column, (from, _)) in columns.data.0.iter_mut().zip(from) {
            factor.forward(column, from);
        }
        // D = (L⁻¹Wᵀ)ᵀ (L⁻¹Wᵀ).
        let extents = extents(&columns);
        let mut delassus = SMatrix::<T, R, R>::from([[T::zero(); R]; R]);
        for row in 0..R {
            for other in 0..=row {
                let (from, to) = (extents[row].0.max(extents[other].0), extents[row].1.min(extents[other].1));
                let product = (from..to).fold(T::zero(), |sum, k| sum + columns[(k, row)] * columns[(k, other)]);
                (delassus[(row, other)], delassus[(other, row)]) = (product, product);
            }
        }
        self.fill_idle_rows(&mut delassus);
        columns.data.0.iter_mut().for_each(|column| factor.backward(column));
        ImpulseResponse::new(columns, delassus)
    }

    /// Rows of a slot along which nothing can move: with a diagonal of their own they are independent of all others,
    /// and impulses along them do nothing.
    fn fill_idle_rows(&self, delassus: &mut SMatrix<T, R, R>) {
        for (i, _) in self.slots.iter().enumerate().filter(|(_, slot)| slot.is_some()) {
            let largest = (3 * i..3 * i + 3).fold(T::zero(), |largest, row| largest.max(delassus[(row, row)]));
            for row in 3 * i..3 * i + 3 {
                let own = delassus[(row, row)];
                delassus[(row, row)] = T::select_lt(T::zero(), own, own, own + largest);
            }
        }
    }
}

/// An entry of W, zero where it is rounding: that is no direction in which something moves. Derivatives stay, since
/// what is zero may turn away.
fn without_rounding<T: Real>(x: T, rounding: T) -> T {
    let none = match T::LANES {
        1 => x - T::from_f64(x.lane(0)),
        _ if T::DERIVATIVES => x,
        _ => x * T::zero(),
    };
    T::select_lt(rounding, x.abs(), x, none)
}

/// `slot_` with a number, and how many letters that has.
const fn letters(number: usize) -> ([u8; 8], usize) {
    let (mut letters, mut length, mut power) = (*b"slot_000", 5, 100);
    while power > 0 {
        if number >= power || power == 1 {
            letters[length] = b'0' + (number / power % 10) as u8;
            length += 1;
        }
        power /= 10;
    }
    (letters, length)
}

const fn name(letters: &'static ([u8; 8], usize)) -> &'static str {
    let (used, _) = letters.0.split_at(letters.1);
    match core::str::from_utf8(used) {
        Ok(name) => name,
        Err(_) => panic!("letters and digits"),
    }
}

type Motion<T, const D: usize> = FrameMotion<T, SMatrix<T, 6, D>>;

/// The product of factors and a twist.
fn paired<T: Real>(factors: &Twist<T>, twist: &Twist<T>) -> T {
    (0..6).fold(T::zero(), |sum, part| sum + factors[part] * twist[part])
}

/// From the first speed that moves a frame to the last.
fn speeds_of<T: Real, const D: usize>(motion: &Motion<T, D>) -> Range<usize> {
    let moves = |column: &[T; 6]| column.iter().any(|x| *x != T::zero());
    let columns = &motion.jacobian.data.0;
    let from = columns.iter().position(moves).unwrap_or(D);
    from..columns.iter().rposition(moves).map_or(from, |last| last + 1)
}

impl<T: Real, K, const N: usize, const R: usize, const D: usize> GaussSystem for Slots<'_, K, N, R, D>
where
    K: FramedSystem<Scalar = T, Speeds = SVector<T, D>, Jacobian = SMatrix<T, 6, D>>,
{
    gauss_runtime::forward_system!(K => kernel: types motion dynamics momenta energies condition constraints);

    const CHART: Chart = K::CHART;
    const HAS_CONTACTS: bool = true;
    const STATES: usize = K::STATES;
    const SMOOTHNESS: Smoothness = K::SMOOTHNESS;
}

/// Powers and forces of elements are those of the kernel: contact forces have their own account, in
/// [`ContactTrajectory::energy_balance`](crate::ContactTrajectory::energy_balance).
impl<T: Real, K, const N: usize, const R: usize, const D: usize> ForcedSystem for Slots<'_, K, N, R, D>
where
    K: ForcedSystem + FramedSystem<Scalar = T, Speeds = SVector<T, D>, Jacobian = SMatrix<T, 6, D>>,
{
    type Powers = K::Powers;
    type ElementForces = K::ElementForces;

    const ELEMENTS: &'static [Element] = K::ELEMENTS;

    fn powers(&self, t: T, q: &K::Configuration, z: &K::Speeds, input: &K::Input) -> K::Powers {
        self.kernel.powers(t, q, z, input)
    }

    fn element_forces(&self, t: T, q: &K::Configuration, z: &K::Speeds, input: &K::Input) -> K::ElementForces {
        self.kernel.element_forces(t, q, z, input)
    }

    fn supplied_power(&self, t: T, q: &K::Configuration, z: &K::Speeds, input: &K::Input) -> T {
        self.kernel.supplied_power(t, q, z, input)
    }
}

/// Names, equations and figures are those of the kernel: contact forces are not among its methods.
impl<T: Real, K, const N: usize, const R: usize, const D: usize> DescribedSystem for Slots<'_, K, N, R, D>
where
    K: DescribedSystem + FramedSystem<Scalar = T, Speeds = SVector<T, D>, Jacobian = SMatrix<T, 6, D>>,
{
    const EQUATIONS: Equations = K::EQUATIONS;
    const OPERATIONS: Operations = K::OPERATIONS;
    const ACCURACY: Accuracy = K::ACCURACY;
    const COORDINATE_NAMES: &'static [&'static str] = K::COORDINATE_NAMES;
    const SPEED_NAMES: &'static [&'static str] = K::SPEED_NAMES;
}

impl<T: Real, K, const N: usize, const R: usize, const D: usize> ContactSystem for Slots<'_, K, N, R, D>
where
    K: FramedSystem<Scalar = T, Speeds = SVector<T, D>, Jacobian = SMatrix<T, 6, D>>,
{
    type Gaps = SVector<T, N>;
    type ContactRows = SVector<T, R>;
    type ContactColumns = SMatrix<T, D, R>;
    type ImpulseFactors = Self::ContactColumns;
    type Delassus = SMatrix<T, R, R>;
    type EachContact<E: Copy + fmt::Debug> = [E; N];
    type EachRow<E: Copy + fmt::Debug> = [E; R];

    #[inline]
    fn contacts(&self) -> &'static [Contact] {
        Self::CONTACTS
    }

    fn gaps(&self, t: T, q: &Self::Configuration) -> Self::Gaps {
        let mut gaps = SVector::from([T::from_f64(OPEN); N]);
        self.each(|frame| self.pose(frame, t, q), |i, slot, poses| gaps[i] = Touch::new(slot, poses).gap(slot));
        gaps
    }

    fn contact_rates(&self, t: T, q: &Self::Configuration, z: &Self::Speeds) -> Self::ContactRows {
        let mut rates = Self::ContactRows::zero();
        let moving = |frame: Option<K::Frame>| {
            let twist = frame.map_or_else(Twist::<T>::zero, |frame| self.kernel.twist_of(frame, t, q, z));
            (self.pose(frame, t, q), twist)
        };
        self.each(moving, |i, slot, [first, second]| {
            let touch = Touch::new(slot, [&first.0, &second.0]);
            for (k, axis) in slot.axes().into_iter().enumerate() {
                let [own, other] = touch.arms(slot, axis);
                rates[3 * i + k] = paired(&own, &first.1) + paired(&other, &second.1);
            }
        });
        rates
    }

    fn contact_jacobian(&self, t: T, q: &Self::Configuration) -> Self::ContactColumns {
        self.columns(&self.kernel.frames(t, q, &Self::Speeds::zero()))
    }

    fn contact_frame(&self, contact: usize, t: T, q: &Self::Configuration) -> Option<ContactFrame<T>> {
        let slot = self.slots.get(contact)?.as_ref()?;
        let (first, second) = (self.pose(slot.first, t, q), self.pose(slot.second, t, q));
        let [normal, a, b] = slot.axes().map(|axis| turned(&second, axis));
        let point = add(turned(&first, triple(&slot.point)), triple(&first.translation.vector));
        let touches = sub(point, scaled(slot.radius, normal));
        Some(ContactFrame::new(touches.into(), normal.into(), &[a.into(), b.into()]))
    }

    fn friction(&self, _: T, _: &Self::Configuration, _: &Self::Speeds, _: &Self::Input) -> Self::ContactRows {
        let of = |row: usize| self.slots[row / 3].as_ref().map_or(T::zero(), |slot| slot.friction);
        SVector::from(core::array::from_fn(|row| if row % 3 == 0 { T::zero() } else { of(row) }))
    }

    fn restitution(&self) -> Self::Gaps {
        SVector::from(core::array::from_fn(|i| self.slots[i].as_ref().map_or(T::zero(), |slot| slot.restitution)))
    }

    fn impulse_response(&self, t: T, q: &Self::Configuration) -> ImpulseResponse<Self> {
        self.response(t, q, &self.kernel.frames(t, q, &Self::Speeds::zero()))
    }

    fn impulse_dynamics(
        &self,
        t: T,
        q: &Self::Configuration,
        z: &Self::Speeds,
        input: &Self::Input,
    ) -> ImpulseDynamics<Self> {
        let frames = self.kernel.frames(t, q, z);
        let acceleration = self.kernel.acceleration(t, q, z, input);
        let mut bias = Self::ContactRows::zero();
        let moving = |frame: Option<K::Frame>| {
            let motion = frame.map(|frame| &frames[frame]);
            motion.map_or_else(
                || (rest(), Twist::<T>::zero(), Twist::<T>::zero()),
                |motion| (motion.pose, motion.twist, motion.acceleration(&acceleration)),
            )
        };
        self.each(moving, |i, slot, [first, second]| {
            let touch = Touch::new(slot, [&first.0, &second.0]);
            let relative = touch.acceleration(slot, [&first.1, &second.1], [&first.2, &second.2]);
            slot.axes().into_iter().enumerate().for_each(|(k, axis)| bias[3 * i + k] = dot(axis, relative));
        });
        ImpulseDynamics::new(acceleration, bias, self.response(t, q, &frames))
    }

    fn impulse_velocities(&self, columns: &Self::ImpulseFactors, impulses: &Self::ContactRows) -> Self::Speeds {
        impulse_velocities::<Self>(columns, impulses)
    }

    fn impulse_terms(&self, columns: &Self::ImpulseFactors, impulses: &Self::ContactRows) -> Self::Speeds {
        impulse_terms::<Self>(columns, impulses)
    }

    fn contact_columns(&self, columns: &Self::ImpulseFactors) -> Self::ContactColumns {
        *columns
    }
}
