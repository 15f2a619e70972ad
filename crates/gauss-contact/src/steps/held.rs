//! A stepper between two steps, for contacts whose data change there.

use core::fmt;

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::{ContactSystem, Each};

use crate::error::ContactError;
use crate::mode::Mode;

use super::account::Account;
use super::relaxed::StepLaw;
use super::report::{StepReport, StepScheme};
use super::stepper::ContactStepper;
use super::stiffness::LastForces;

/// Mode of a contact in the step before, and whether it rests.
type Carried = Option<(Mode, bool)>;

/// All of a [`ContactStepper`] but its kernel, whose data are free to change: the answer of
/// [`hold`](ContactStepper::hold).
pub struct HeldSteps<K: ContactSystem<Scalar = f64>, M> {
    t: f64,
    q: K::Configuration,
    z: K::Speeds,
    scheme: StepScheme,
    law: StepLaw,
    tolerance: f64,
    memory: M,
    impulses: K::ContactRows,
    dependent: bool,
    last: LastForces<K::Speeds>,
    modes: K::EachContact<Mode>,
    rests: K::EachContact<bool>,
    report: StepReport,
}

impl<K: ContactSystem<Scalar = f64>, M> fmt::Debug for HeldSteps<K, M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { t, q, z, report, .. } = self;
        f.debug_struct("HeldSteps").field("t", t).field("q", q).field("z", z).field("report", report).finish()
    }
}

impl<K: ContactSystem<Scalar = f64>, M: AsMut<[f64]>> HeldSteps<K, M> {
    /// See [`ContactStepper::scheme`].
    #[must_use]
    pub fn scheme(self, scheme: StepScheme) -> Self {
        Self { scheme, ..self }
    }

    /// See [`ContactStepper::law`].
    #[must_use]
    pub fn law(self, law: StepLaw) -> Self {
        Self { law, ..self }
    }

    /// See [`ContactStepper::tolerance`].
    #[must_use]
    pub fn tolerance(self, tolerance: f64) -> Self {
        Self { tolerance, ..self }
    }

    /// The time.
    pub fn time(&self) -> f64 {
        self.t
    }

    /// The configuration.
    pub fn configuration(&self) -> &K::Configuration {
        &self.q
    }

    /// The quasi-velocities.
    pub fn speeds(&self) -> &K::Speeds {
        &self.z
    }

    /// Report of the last step.
    pub fn report(&self) -> StepReport {
        self.report
    }

    /// Modes of the contacts in the last step.
    pub fn modes(&self) -> &[Mode] {
        self.modes.as_ref()
    }

    /// The impulses of the last step, row by row.
    pub fn impulses(&self) -> &K::ContactRows {
        &self.impulses
    }

    /// One step with new data of the contacts, as of [`ContactStepper::step`]. `before(i)` is the contact of the step
    /// before whose impulses and mode contact i begins with, both of the same number of rows; `None` where it is new.
    /// A new one counts as closed where its gap is zero to rounding and does not open.
    ///
    /// A gap that the new data put below zero is brought to zero, and counted in the
    /// [`penetration`](StepReport::penetration).
    ///
    /// # Errors
    /// Those of [`ContactStepper::step`], `InvalidRestitution`; the state is then that before the step.
    pub fn step(
        &mut self,
        kernel: &K,
        before: impl Fn(usize) -> Option<usize>,
        (h, input): (f64, &K::Input),
    ) -> Result<StepReport, ContactError>
    where
        M: Default,
    {
        crate::start::check_contacts(kernel, self.t, &self.q, |_| f64::INFINITY)?;
        let memory = core::mem::take(&mut self.memory);
        let mut stepper = ContactStepper::resumed(kernel, Self { memory, ..*self }, before);
        let made = stepper.step(h, input);
        *self = stepper.hold();
        made
    }

    /// The rows that contacts begin with, their modes and whether they rest.
    fn carried(
        &self,
        kernel: &K,
        before: impl Fn(usize) -> Option<usize>,
    ) -> (K::ContactRows, K::EachContact<Carried>) {
        let (mut impulses, mut modes) = (K::ContactRows::zero(), <K::EachContact<Carried>>::from_fn(|_| None));
        for (i, contact) in kernel.contacts().iter().enumerate() {
            let Some((from, known)) = before(i).and_then(|from| Some((from, kernel.contacts().get(from)?))) else {
                continue;
            };
            modes[i] = Some((self.modes[from], self.rests[from]));
            for (row, from) in contact.rows().zip(known.rows()) {
                impulses.set_component(row, self.impulses.component(from));
            }
        }
        (impulses, modes)
    }
}

impl<'k, K: ContactSystem<Scalar = f64>, M: AsMut<[f64]>> ContactStepper<'k, K, M> {
    /// Lets go of the kernel, so that data of its contacts may change; [`HeldSteps::step`] goes on.
    #[must_use]
    pub fn hold(self) -> HeldSteps<K, M> {
        let Self { t, q, z, scheme, law, tolerance, memory, impulses, dependent, last, .. } = self;
        let Self { modes, rests, report, .. } = self;
        HeldSteps { t, q, z, scheme, law, tolerance, memory, impulses, dependent, last, modes, rests, report }
    }

    /// The stepper of what was held, with contacts whose data may be other ones.
    fn resumed(kernel: &'k K, held: HeldSteps<K, M>, before: impl Fn(usize) -> Option<usize>) -> Self {
        let (impulses, known) = held.carried(kernel, before);
        let HeldSteps { t, q, z, scheme, law, tolerance, memory, dependent, last, report, .. } = held;
        let (gaps, rates) = (kernel.gaps(t, &q), kernel.contact_rates(t, &q, &z));
        let open = Each::from_fn(|_| Mode::Open);
        let mut stepper = Self {
            kernel,
            t,
            q,
            z,
            scheme,
            law,
            tolerance,
            accounts: true,
            memory,
            impulses,
            dependent,
            gaps,
            rates,
            last,
            // Data that are other ones may lift what is there.
            account: kernel.keeps_energy().then(|| Account::begun(kernel, (t, &q, &z))),
            modes: open,
            rests: Each::from_fn(|_| false),
            next: open,
            report,
        };
        stepper.find_closed();
        for (i, &known) in known.as_ref().iter().enumerate() {
            (stepper.modes[i], stepper.rests[i]) = known.unwrap_or((stepper.modes[i], stepper.rests[i]));
        }
        stepper
    }
}
