//! Trait of the methods of one step: the seam at which methods are added.

use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::IntegrationErrorKind;
use crate::integrate::problem::state::{Rates, State};
use crate::system::GaussSystem;

/// The integrals that a method keeps, and its order, as stated by the method and tested.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Properties {
    /// The global error is of order `h^order`.
    pub order: u32,
    /// A step back undoes a step, up to rounding and the tolerance of iterations.
    pub symmetric: bool,
    /// The map of a step on the cotangent bundle is symplectic (on a Lie–Poisson space: a Poisson map).
    pub symplectic: bool,
    /// Momenta that the symmetry of the scene keeps are kept up to rounding.
    pub keeps_momentum: bool,
    /// The energy is kept up to rounding and the tolerance of iterations.
    pub keeps_energy: bool,
    /// Steps may be much longer than the time in which the fastest motions decay.
    pub stiff: bool,
}

impl Properties {
    /// A method of the given order that keeps nothing.
    #[must_use]
    pub const fn of_order(order: u32) -> Self {
        Self { order, symmetric: false, symplectic: false, keeps_momentum: false, keeps_energy: false, stiff: false }
    }
}

/// The outcome of one step.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Step<S: GaussSystem> {
    /// The state at its end.
    pub state: State<S>,
    /// The estimated error of the step in the tangent space, and in y. Zero for a method without an estimate.
    pub error: Rates<S>,
    /// The derivatives at the end, when the method has them for nothing.
    pub rates: Option<Rates<S>>,
}

impl<S: GaussSystem> Step<S> {
    /// A step to a state, with its estimated error; the derivatives at the end are unknown.
    #[inline]
    #[must_use]
    pub fn new(state: State<S>, error: Rates<S>) -> Self {
        Self { state, error, rates: None }
    }
}

/// A method that makes one step of a given length: with [`Fixed`](crate::integrate::Fixed) an integrator.
///
/// A method of your own needs [`step`](Self::step) alone.
pub trait OneStep<S: GaussSystem> {
    /// The integrals that the method keeps, and its order.
    fn properties(&self) -> Properties;

    /// One step of length `h` from `state`, where the derivatives are `rates`. The end is not brought back onto
    /// constraints: [`Control`](crate::integrate::drive::control::Control) does that.
    ///
    /// # Errors
    /// When the step cannot be made; the state given is untouched. Contacts are refused as in a run: begin with
    /// [`check_contacts`].
    fn step<P: Problem<System = S>>(
        &self,
        problem: &P,
        state: &State<S>,
        rates: &Rates<S>,
        h: S::Scalar,
    ) -> Result<Step<S>, IntegrationErrorKind>;
}

/// A method that estimates the error of its steps: with [`Adaptive`](crate::integrate::Adaptive) an integrator whose
/// steps are as long as a tolerance allows.
pub trait EstimatingStep<S: GaussSystem>: OneStep<S> {
    /// The power of the step that the estimate goes with where the motion is smooth.
    fn estimate_order(&self) -> f64;

    /// The step that [`OneStep::step`] makes, with its estimate in [`Step::error`], and a second, coarser estimate ê
    /// where the method has one: the error of a step is then taken for `e²/√(e² + ê²/100)`, which goes with a higher
    /// power of the step than e (Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I*, II.10).
    ///
    /// # Errors
    /// When the step cannot be made; the state given is untouched.
    #[inline]
    fn step_and_estimates<P: Problem<System = S>>(
        &self,
        problem: &P,
        state: &State<S>,
        rates: &Rates<S>,
        h: S::Scalar,
    ) -> Result<(Step<S>, Option<Rates<S>>), IntegrationErrorKind> {
        self.step(problem, state, rates, h).map(|step| (step, None))
    }
}

/// A method whose step is one increment, `q₁ = q₀ ∘ exp(σ)` and `y₁ = y₀ + Δy`. It can be run with the rounding error
/// of each sum carried to the next step ([`Compensated`](crate::integrate::drive::compensated::Compensated)).
pub trait IncrementStep<S: GaussSystem>: OneStep<S> {
    /// (σ, Δy) of the step that [`OneStep::step`] makes, up to rounding that is relative to the increment. What it is
    /// added to, and the result, are not checked.
    ///
    /// # Errors
    /// When the step cannot be made.
    fn increment<P: Problem<System = S>>(
        &self,
        problem: &P,
        state: &State<S>,
        rates: &Rates<S>,
        h: S::Scalar,
    ) -> Result<Rates<S>, IntegrationErrorKind>;
}

/// Refuses a scene with [contacts](GaussSystem::HAS_CONTACTS), whose forces the equations do not have, unless they are
/// left out on purpose ([`WithoutContacts`](crate::integrate::WithoutContacts)). Every run and every step of the
/// methods here asks it; it costs nothing.
///
/// # Errors
/// [`IntegrationErrorKind::Contacts`].
#[inline(always)]
pub fn check_contacts<P: Problem>(_: &P) -> Result<(), IntegrationErrorKind> {
    if P::System::HAS_CONTACTS && !P::LEAVES_CONTACTS_OUT { Err(IntegrationErrorKind::Contacts) } else { Ok(()) }
}
