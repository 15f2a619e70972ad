//! A step with contacts, in any scalar and whoever decides.
//!
//! `z⁺ = z + h ż₀ + A⁻¹WᵀP`: forces and what impulses do are taken at half of the step, the second half goes with the
//! speeds after the impulses, and then closed gaps are zero, so are their rates and the slips of what sticks. Which
//! contacts act, stick or slide is decided by values: of one state (`stepper`), of all lanes of a pack, in lockstep
//! or lane by lane (`together`), or it is as a step that was made has decided (`followed`, in dual numbers).

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::{ContactSystem, ImpulseDynamics};
use gauss_runtime::real::Real;
use gauss_runtime::system::GaussSystem;

use super::motion::{self, Middle};
use super::projection::Closed;

/// A step, with the state at half of it.
pub(super) struct Step<'a, K: ContactSystem> {
    pub(super) kernel: &'a K,
    pub(super) h: f64,
    /// Time at its end.
    pub(super) end: K::Scalar,
    /// Speeds before it.
    pub(super) z: &'a K::Speeds,
    pub(super) middle: &'a Middle<K>,
}

/// The motion of a step without contacts, and what impulses do, at half of it.
pub(super) struct StepDynamics<'a, K: ContactSystem> {
    pub(super) step: &'a Step<'a, K>,
    pub(super) friction: &'a K::ContactRows,
    /// Speeds after the step without impulses.
    pub(super) free: &'a K::Speeds,
    pub(super) impulses: &'a ImpulseDynamics<K>,
}

/// A configuration with speeds.
pub(super) type Moved<K> = (<K as GaussSystem>::Configuration, <K as GaussSystem>::Speeds);
/// Speeds with rates of contacts.
pub(super) type Stopped<K> = (<K as GaussSystem>::Speeds, <K as ContactSystem>::ContactRows);

/// The end of a flight, with the acceleration at half of it.
pub(super) type Flown<K> = (Moved<K>, <K as GaussSystem>::Speeds);

/// The end of a step in which contacts may act, with the solution of its laws.
pub(super) struct Contacted<K: ContactSystem, P> {
    pub(super) pushed: P,
    pub(super) closed: Closed<K>,
    pub(super) stopped: Stopped<K>,
    /// Acceleration without contacts, at half of the step.
    pub(super) acceleration: K::Speeds,
}

/// The decisions of a step.
pub(super) trait Decisions<K: ContactSystem> {
    /// A solution of the laws.
    type Pushed;
    /// Why there is no step.
    type Refusal;

    /// Whether no gap closes in a flight that ends with these speeds.
    fn stays_open(&mut self, step: &Step<K>, z: &K::Speeds) -> Result<bool, Self::Refusal>;

    /// The solution of the laws, with the speeds after its impulses.
    fn push(&mut self, at: &StepDynamics<K>) -> Result<(Self::Pushed, K::Speeds), Self::Refusal>;

    /// The end of a step on its bilateral constraints.
    fn project(&mut self, step: &Step<K>, end: Moved<K>) -> Result<Moved<K>, Self::Refusal>;

    /// Closed gaps brought to zero.
    fn close(
        &mut self,
        at: &StepDynamics<K>,
        pushed: &mut Self::Pushed,
        end: &Moved<K>,
    ) -> Result<Closed<K>, Self::Refusal>;

    /// Rates of what rests brought to zero.
    fn stop(
        &mut self,
        at: &StepDynamics<K>,
        of: (&Self::Pushed, &Closed<K>),
        end: Stopped<K>,
    ) -> Result<Stopped<K>, Self::Refusal>;
}

impl<K: ContactSystem> Step<'_, K> {
    /// A step in which no contact acts; nothing where a gap closes.
    pub(super) fn flight<D: Decisions<K>>(
        &self,
        input: &K::Input,
        decide: &mut D,
    ) -> Result<Option<Flown<K>>, D::Refusal> {
        let middle = self.middle;
        let acceleration = self.kernel.acceleration(middle.t, &middle.q, &middle.z, input);
        let z = self.z.add_scaled(K::Scalar::from_f64(self.h), &acceleration);
        if !decide.stays_open(self, &z)? {
            return Ok(None);
        }
        Ok(Some((self.second_half(z, decide)?, acceleration)))
    }

    /// A step in which contacts may act.
    pub(super) fn touching<D: Decisions<K>>(
        &self,
        input: &K::Input,
        decide: &mut D,
    ) -> Result<Contacted<K, D::Pushed>, D::Refusal> {
        let (kernel, t, middle) = (self.kernel, self.end, self.middle);
        let friction = kernel.friction(middle.t, &middle.q, &middle.z, input);
        let impulses = kernel.impulse_dynamics(middle.t, &middle.q, &middle.z, input);
        let free = self.z.add_scaled(K::Scalar::from_f64(self.h), &impulses.acceleration);
        let at = StepDynamics { step: self, friction: &friction, free: &free, impulses: &impulses };
        let (mut pushed, z) = decide.push(&at)?;
        let end = self.second_half(z, decide)?;
        let closed = decide.close(&at, &mut pushed, &end)?;
        let rates = kernel.contact_rates(t, &closed.q, &end.1);
        let stopped = decide.stop(&at, (&pushed, &closed), (end.1, rates))?;
        Ok(Contacted { pushed, closed, stopped, acceleration: impulses.acceleration })
    }

    /// The second half of a step, with the speeds after it.
    fn second_half<D: Decisions<K>>(&self, z: K::Speeds, decide: &mut D) -> Result<Moved<K>, D::Refusal> {
        let half = &self.middle.half;
        let q = motion::half_way::<K>(self.h, half, &self.kernel.kinematics(self.middle.t, half, &z));
        if K::CONSTRAINED { decide.project(self, (q, z)) } else { Ok((q, z)) }
    }
}
