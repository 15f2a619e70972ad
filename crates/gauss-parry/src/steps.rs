//! Steps before each of which the library is asked.

use std::fmt;

use gauss_contact::{ContactError, ContactStepper, HeldSteps, Mode, Slots, StepReport, StepScheme};
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::frames::{FrameName, FramedSystem};
use gauss_runtime::nalgebra::{SMatrix, SVector};

use crate::error::{ParryError, ParryErrorKind};
use crate::shapes::{Found, Shapes};

/// A kernel on its way in steps, with contacts between shapes.
///
/// Before a step the library says where shapes touch; slots take these points in the order of the pairs, and each
/// begins with the impulse and the mode that the same features had in the step before. N, R and D are those of
/// [`Slots`].
pub struct ParrySteps<'k, K, const N: usize, const R: usize, const D: usize>
where
    K: FramedSystem<Scalar = f64, Speeds = SVector<f64, D>, Jacobian = SMatrix<f64, 6, D>>,
{
    shapes: Shapes<K::Frame>,
    slots: Slots<'k, K, N, R, D>,
    /// The contacts of the step before.
    before: Vec<Found<K::Frame>>,
    held: HeldSteps<Slots<'k, K, N, R, D>, Vec<f64>>,
}

impl<K, const N: usize, const R: usize, const D: usize> fmt::Debug for ParrySteps<'_, K, N, R, D>
where
    K: FramedSystem<Scalar = f64, Speeds = SVector<f64, D>, Jacobian = SMatrix<f64, 6, D>>,
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ParrySteps").field("held", &self.held).field("shapes", &self.shapes).finish_non_exhaustive()
    }
}

impl<'k, K, const N: usize, const R: usize, const D: usize> ParrySteps<'k, K, N, R, D>
where
    K: FramedSystem<Scalar = f64, Speeds = SVector<f64, D>, Jacobian = SMatrix<f64, 6, D>>,
{
    /// A kernel in the state (q, z) at a time.
    ///
    /// # Errors
    /// Those of [`Shapes::update`]; `Points` where there are more than slots, `Contact` with `NegativeGap` where shapes
    /// are inside one another, and with `NonFinite`.
    pub fn new(
        kernel: &'k K,
        shapes: Shapes<K::Frame>,
        (t, q, z): (f64, K::Configuration, K::Speeds),
    ) -> Result<Self, ParryError> {
        let (mut shapes, mut slots) = (shapes, Slots::new(kernel));
        ask(&mut shapes, &mut slots, (t, &q))?;
        let held = ContactStepper::new(&slots, t, q, z)?.hold();
        let before = shapes.found().to_vec();
        Ok(Self { shapes, slots, before, held })
    }

    /// Sets the scheme of the motion between impacts.
    #[must_use]
    pub fn scheme(self, scheme: StepScheme) -> Self {
        Self { held: self.held.scheme(scheme), ..self }
    }

    /// See [`ContactStepper::tolerance`].
    #[must_use]
    pub fn tolerance(self, tolerance: f64) -> Self {
        Self { held: self.held.tolerance(tolerance), ..self }
    }

    /// One step of length `h`, under an input that stays. Where it is an error, the state is that before the step.
    ///
    /// # Errors
    /// Those of [`Shapes::update`]; `Points`, `Slot`, `TooDeep`; `Contact` with those of [`ContactStepper::step`].
    pub fn step(&mut self, h: f64, input: &K::Input) -> Result<StepReport, ParryError> {
        let (t, q) = (self.held.time(), *self.held.configuration());
        ask(&mut self.shapes, &mut self.slots, (t, &q))?;
        let found = self.shapes.found();
        let before = |i: usize| found.get(i).and_then(|found| earlier(&self.before, found));
        let made = self.held.step(&self.slots, before, (h, input));
        let report = made.map_err(|error| self.about(error))?;
        self.before = self.shapes.found().to_vec();
        Ok(report)
    }

    /// An error of the step, with the shapes of its contact.
    fn about(&self, error: ContactError) -> ParryError {
        let slot = |name: &str| Slots::<K, N, R, D>::CONTACTS.iter().position(|contact| contact.name == name);
        let found = error.contact.and_then(slot).and_then(|i| self.shapes.found().get(i));
        ParryError { shapes: found.map(|found| found.feature.shapes), kind: ParryErrorKind::Contact(error) }
    }

    /// The time.
    pub fn time(&self) -> f64 {
        self.held.time()
    }

    /// The configuration.
    pub fn configuration(&self) -> &K::Configuration {
        self.held.configuration()
    }

    /// The quasi-velocities.
    pub fn speeds(&self) -> &K::Speeds {
        self.held.speeds()
    }

    /// The shapes, with the points that were found before the last step.
    pub fn shapes(&self) -> &Shapes<K::Frame> {
        &self.shapes
    }

    /// The contacts of the last step.
    pub fn slots(&self) -> &Slots<'k, K, N, R, D> {
        &self.slots
    }

    /// Modes of the contacts in the last step, slot by slot.
    pub fn modes(&self) -> &[Mode] {
        self.held.modes()
    }

    /// Their impulses in it, row by row.
    pub fn impulses(&self) -> &SVector<f64, R> {
        self.held.impulses()
    }
}

/// Fills the slots by what the library finds in a state.
fn ask<'k, K, const N: usize, const R: usize, const D: usize>(
    shapes: &mut Shapes<K::Frame>,
    slots: &mut Slots<'k, K, N, R, D>,
    (t, q): (f64, &K::Configuration),
) -> Result<(), ParryError>
where
    K: FramedSystem<Scalar = f64, Speeds = SVector<f64, D>, Jacobian = SMatrix<f64, 6, D>>,
{
    let kernel = slots.kernel();
    let found = shapes.update(|frame| kernel.pose_of(frame, t, q))?;
    if found.len() > N {
        return Err(ParryError::of(ParryErrorKind::Points { points: found.len(), slots: N }));
    }
    slots.fill(found.iter().map(|found| found.slot))?;
    let (gaps, deepest) = (slots.gaps(t, q), shapes.depth_allowed());
    match shapes.found().iter().zip(gaps.iter()).find(|(_, gap)| **gap < -deepest) {
        Some((found, &gap)) => {
            let (shapes, kind) = (Some(found.feature.shapes), ParryErrorKind::TooDeep { gap, deepest });
            Err(ParryError { shapes, kind })
        }
        None => Ok(()),
    }
}

/// The contact that was this one before: that of the same features, or else the same point of a body that is over the
/// same plane of the other, as on the next triangle of a flat part of a mesh.
fn earlier<F: FrameName>(before: &[Found<F>], found: &Found<F>) -> Option<usize> {
    let same = before.iter().position(|known| known.feature == found.feature);
    same.or_else(|| before.iter().position(|known| goes_on(known, found)))
}

/// Half of the digits.
const SAME: f64 = 1e-8;

fn goes_on<F: FrameName>(known: &Found<F>, found: &Found<F>) -> bool {
    let (a, b) = (&known.slot, &found.slot);
    let (point, origin) = (a.point - b.point, a.origin - b.origin);
    let size = a.point.amax().max(a.origin.amax()).max(b.origin.amax()) + a.radius;
    known.feature.shapes == found.feature.shapes
        && (a.first, a.second) == (b.first, b.second)
        && point.amax() <= SAME * size
        && (a.normal - b.normal).amax() <= SAME
        && a.normal.dot(&origin).abs() <= SAME * size
}
