//! Controllers that sample: their input is held from one instant to the next.

use core::cell::Cell;
use core::fmt;

use crate::integrate::problem::input::{Feedback, InputSource, NoInput};
use crate::real::Real;
use crate::sealed::Sealed;
use crate::system::GaussSystem;
use crate::vector_space::VectorSpace;

/// A controller that samples: a closure ([`Simulation::sampled`](crate::integrate::Simulation::sampled)), or a type of
/// your own ([`Simulation::sampled_by`](crate::integrate::Simulation::sampled_by)). It is called once at each of its
/// instants, in the order of time, so that it may have a state that changes: integrals, filters, random numbers.
pub trait Controller<S: GaussSystem> {
    /// Before a run, the first one included: a controller that begins every run anew sets its state here.
    fn start(&mut self) {}

    /// The input from the state at an instant. Without a delay it acts from that instant on.
    fn sample(&mut self, t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Input;
}

impl<S: GaussSystem, C: Controller<S> + ?Sized> Controller<S> for &mut C {
    fn start(&mut self) {
        (**self).start();
    }

    fn sample(&mut self, t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Input {
        (**self).sample(t, q, z)
    }
}

/// A controller that is a closure.
#[derive(Clone, Copy, Debug)]
pub struct Law<G>(pub G);

impl<S: GaussSystem, G: FnMut(S::Scalar, &S::Configuration, &S::Speeds) -> S::Input> Controller<S> for Law<G> {
    fn sample(&mut self, t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Input {
        (self.0)(t, q, z)
    }
}

/// The input of a run with controllers that sample: the sum of what they hold, and what a function of time and state
/// adds. Outside a run it is undefined.
#[derive(Clone)]
pub struct Sampled<S: GaussSystem, R = NoInput> {
    rest: R,
    held: Cell<S::Input>,
}

impl<S: GaussSystem, R> fmt::Debug for Sampled<S, R> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Sampled").field("held", &self.held).finish_non_exhaustive()
    }
}

/// Inputs that a run may have when a controller that samples is added.
#[diagnostic::on_unimplemented(
    message = "a controller that samples cannot be added to `{Self}`",
    note = "it adds to a closure, `.input(|t, q, z| …)`, to other controllers that sample, or to nothing: put what a type \
            gives into a closure"
)]
pub trait Samples<S: GaussSystem>: Sealed {
    /// The part that is a function of time and state.
    type Rest: Rest<S>;

    /// Returns that part.
    fn rest(self) -> Self::Rest;
}

/// Input that is added to the inputs that are held.
pub trait Rest<S: GaussSystem>: Sealed {
    /// The sum.
    fn with(&self, held: S::Input, t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Input;
}

impl Sealed for NoInput {}

impl<G> Sealed for Feedback<G> {}

impl<S: GaussSystem, R> Sealed for Sampled<S, R> {}

impl<S: GaussSystem> Rest<S> for NoInput {
    #[inline(always)]
    fn with(&self, held: S::Input, _: S::Scalar, _: &S::Configuration, _: &S::Speeds) -> S::Input {
        held
    }
}

impl<S, G> Rest<S> for Feedback<G>
where
    S: GaussSystem<Input: VectorSpace<S::Scalar>>,
    G: Fn(S::Scalar, &S::Configuration, &S::Speeds) -> S::Input,
{
    #[inline(always)]
    fn with(&self, held: S::Input, t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Input {
        held.add_scaled(S::Scalar::one(), &(self.0)(t, q, z))
    }
}

impl<S: GaussSystem> Samples<S> for NoInput {
    type Rest = Self;

    fn rest(self) -> Self {
        self
    }
}

impl<S: GaussSystem, G> Samples<S> for Feedback<G>
where
    Self: Rest<S>,
{
    type Rest = Self;

    fn rest(self) -> Self {
        self
    }
}

impl<S: GaussSystem, R: Rest<S>> Samples<S> for Sampled<S, R> {
    type Rest = R;

    fn rest(self) -> R {
        self.rest
    }
}

/// Input outside a run: no number, so that nobody goes on with it.
fn undefined<S: GaussSystem<Input: VectorSpace<S::Scalar>>>() -> S::Input {
    let mut none = S::Input::zero();
    (0..S::Input::DIM).for_each(|i| none.set_component(i, S::Scalar::from_f64(f64::NAN)));
    none
}

impl<S: GaussSystem<Input: VectorSpace<S::Scalar>>, R> Sampled<S, R> {
    /// Adds controllers to a function of time and state.
    pub(in crate::integrate) fn with(rest: R) -> Self {
        Self { rest, held: Cell::new(undefined::<S>()) }
    }
}

#[diagnostic::do_not_recommend]
impl<S, R> InputSource<S> for Sampled<S, R>
where
    S: GaussSystem<Input: VectorSpace<S::Scalar>>,
    R: Rest<S>,
{
    #[inline(always)]
    fn input(&self, t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Input {
        self.rest.with(self.held.get(), t, q, z)
    }

    #[inline(always)]
    fn held(&self) -> Option<&Cell<S::Input>> {
        Some(&self.held)
    }
}
