//! Runs in steps of one length.

use alloc::vec::Vec;
use core::ops::Range;

use gauss_runtime::contact::ContactSystem;
use gauss_runtime::integrate::{Feedback, InputSource, NoInput, Sample};

use crate::error::{ContactError, ContactErrorKind};
use crate::mode::Mode;
use crate::sensors::ContactForces;

use super::relaxed::StepLaw;
use super::report::{StepReport, StepScheme};
use super::stepper::ContactStepper;

/// A run in steps in preparation.
#[derive(Clone, Copy, Debug)]
#[must_use = "a run does nothing before `run`"]
pub struct ContactSteps<'k, K, I = NoInput> {
    pub(super) kernel: &'k K,
    pub(super) h: f64,
    pub(super) input: I,
    scheme: StepScheme,
    law: StepLaw,
    tolerance: f64,
}

/// The end of a step.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct StepSample<K: ContactSystem<Scalar = f64>> {
    /// The state.
    pub state: Sample<K>,
    /// The impulses of the step, row by row.
    pub impulses: K::ContactRows,
    /// What the contacts did in it.
    pub modes: Vec<Mode>,
    /// How the laws were solved.
    pub report: StepReport,
}

impl<K: ContactSystem<Scalar = f64>> StepSample<K> {
    /// The mean forces of the step, with what sensors at the contacts of the kernel measure.
    pub fn forces<'k>(&self, kernel: &'k K) -> ContactForces<'k, K> {
        ContactForces::new(kernel, self.state.t, self.state.q, self.report.mean(&self.impulses))
    }

    /// After a step.
    pub(crate) fn of(stepper: &ContactStepper<'_, K>) -> Self {
        let (t, q, z) = (stepper.time(), *stepper.configuration(), *stepper.speeds());
        let state = Sample { t, q, z, p: stepper.kernel.momentum(t, &q, &z) };
        let (impulses, modes) = (*stepper.impulses(), stepper.modes().into());
        Self { state, impulses, modes, report: stepper.report() }
    }
}

impl<'k, K: ContactSystem<Scalar = f64>> ContactSteps<'k, K> {
    /// Steps of length `h` of a system without inputs.
    pub fn new(kernel: &'k K, h: f64) -> Self {
        Self { kernel, h, input: NoInput, scheme: StepScheme::default(), law: StepLaw::default(), tolerance: 1e-8 }
    }
}

impl<'k, K: ContactSystem<Scalar = f64>, I> ContactSteps<'k, K, I> {
    /// The input as a function of time and state; it is taken at the start of each step and held.
    pub fn input<G>(self, input: G) -> ContactSteps<'k, K, Feedback<G>>
    where
        G: Fn(f64, &K::Configuration, &K::Speeds) -> K::Input,
    {
        let Self { kernel, h, scheme, law, tolerance, .. } = self;
        ContactSteps { kernel, h, input: Feedback(input), scheme, law, tolerance }
    }

    /// How the motion between impacts is taken.
    pub fn scheme(mut self, scheme: StepScheme) -> Self {
        self.scheme = scheme;
        self
    }

    /// Which law of friction impulses satisfy.
    pub fn law(mut self, law: StepLaw) -> Self {
        self.law = law;
        self
    }

    /// See [`ContactStepper::tolerance`].
    pub fn tolerance(mut self, tolerance: f64) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// Steps from (q₀, z₀) over the interval, forward in time: the ends of all steps. The length is made a little
    /// shorter where the interval is no multiple of it.
    ///
    /// # Errors
    /// When the end is not reached; [`attempt`](Self::attempt) then gives the part that was made.
    pub fn run(
        self,
        q0: K::Configuration,
        z0: K::Speeds,
        interval: Range<f64>,
    ) -> Result<Vec<StepSample<K>>, ContactError>
    where
        I: InputSource<K>,
    {
        match self.attempt(q0, z0, interval) {
            (made, None) => Ok(made),
            (_, Some(error)) => Err(error),
        }
    }

    /// Like [`run`](Self::run), but gives the steps that were made when the end is not reached, with the reason.
    pub fn attempt(
        self,
        q0: K::Configuration,
        z0: K::Speeds,
        interval: Range<f64>,
    ) -> (Vec<StepSample<K>>, Option<ContactError>)
    where
        I: InputSource<K>,
    {
        let mut made = Vec::new();
        let error = self.go((q0, z0), interval, &mut made).err();
        (made, error)
    }

    fn go(
        self,
        (q0, z0): (K::Configuration, K::Speeds),
        interval: Range<f64>,
        made: &mut Vec<StepSample<K>>,
    ) -> Result<(), ContactError>
    where
        I: InputSource<K>,
    {
        let Self { h, ref input, .. } = self;
        let Range { start, end } = interval;
        let count = (end - start) / h - 1e-9;
        if !(h > 0.0 && h.is_finite() && start <= end && count < 1e15) {
            return Err(ContactError { contact: None, time: start, kind: ContactErrorKind::InvalidInterval });
        }
        // Rounded up; a negative number becomes 0.
        let whole = count as u64;
        let count = whole + u64::from(count > whole as f64);
        let h = (end - start) / count as f64;
        let mut stepper = self.stepper(start, q0, z0)?;
        for n in 1..=count {
            let (q, z) = (*stepper.configuration(), *stepper.speeds());
            stepper.step(h, &input.input(stepper.time(), &q, &z))?;
            // Times are multiples of the length, not sums of it.
            stepper.t = start + (end - start) * (n as f64 / count as f64);
            made.push(StepSample::of(&stepper));
        }
        Ok(())
    }

    /// At the start of a run.
    pub(super) fn stepper(
        &self,
        start: f64,
        q: K::Configuration,
        z: K::Speeds,
    ) -> Result<ContactStepper<'k, K>, ContactError> {
        let stepper = ContactStepper::new(self.kernel, start, q, z)?;
        Ok(stepper.scheme(self.scheme).law(self.law).tolerance(self.tolerance))
    }
}
