//! Events of the user in runs from event to event, and their jumps.

use gauss_runtime::contact::ContactSystem;
use gauss_runtime::integrate::drive::event::{JumpFunction, Watched};
use gauss_runtime::integrate::{Crossing, Sample};

use crate::run::ContactRun;

impl<'k, K: ContactSystem, C, I, E> ContactRun<'k, K, C, I, E> {
    /// Finds the states in which a function of time and state passes through zero, between impacts or by one. They are
    /// numbered in the order of these calls and of [`until`](Self::until), from 0, and are found in
    /// [`ContactTrajectory::passages`](crate::ContactTrajectory::passages). How they are found between impacts, and
    /// which are missed, is told where those of [`Simulation`](gauss_runtime::integrate::Simulation) are:
    /// [`event`](gauss_runtime::integrate::drive::event).
    pub fn event<G>(self, crossing: Crossing, function: G) -> ContactRun<'k, K, C, I, Watched<E, G>>
    where
        G: Fn(K::Scalar, &K::Configuration, &K::Speeds) -> K::Scalar,
    {
        self.with_events(|events| Watched::after(events, crossing, false, function))
    }

    /// Ends the run at the first such state, which is then its last sample;
    /// [`ContactTrajectory::stopped_by`](crate::ContactTrajectory::stopped_by) tells whether it came to that.
    pub fn until<G>(self, crossing: Crossing, function: G) -> ContactRun<'k, K, C, I, Watched<E, G>>
    where
        G: Fn(K::Scalar, &K::Configuration, &K::Speeds) -> K::Scalar,
    {
        self.with_events(|events| Watched::after(events, crossing, true, function))
    }

    /// Events that another front has gathered, in the place of those so far.
    #[doc(hidden)]
    pub fn events_by<F>(self, events: F) -> ContactRun<'k, K, C, I, F> {
        self.with_events(|_| events)
    }

    fn with_events<F>(self, change: impl FnOnce(E) -> F) -> ContactRun<'k, K, C, I, F> {
        let Self { kernel, control, input, settings, events } = self;
        ContactRun { kernel, control, input, settings, events: change(events) }
    }
}

impl<'k, K: ContactSystem, C, I, E, G> ContactRun<'k, K, C, I, Watched<E, G>> {
    /// Changes the state at the event that was added last, as
    /// [`Simulation::then`](gauss_runtime::integrate::Simulation::then) does: a kick, a catch, a bounce by a law of
    /// one's own. The segment ends there; contacts decide anew what they do after the jump, as at the start of a run. A
    /// closed gap that the jump closes further is an impact, one that it opens is open, and what stuck slides if it is
    /// kicked along. What jumps gave or took is in
    /// [`ContactTrajectory::state_jumps`](crate::ContactTrajectory::state_jumps) and in the balance of energy.
    ///
    /// A jump that leaves a gap below zero ends the run with
    /// [`JumpPenetrates`](crate::ContactErrorKind::JumpPenetrates); one that does not lead back, or piles up, as in
    /// runs without contacts.
    ///
    /// ```
    /// use gauss_contact::WithContacts;
    /// use gauss_runtime::prelude::*;
    ///
    /// /// A block on a floor with friction.
    /// #[derive(GaussDynamics)]
    /// #[gauss(
    ///     coordinates(x, y),
    ///     particle(mass = 2, position = [x, 0, y]),
    ///     contact(floor, gap = y, slip = rate(x), friction = 0.5),
    ///     gravity = 10,
    /// )]
    /// struct Block {}
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let kernel = Block {}.kernel()?;
    /// let run = Simulation::new(&kernel)
    ///     .event(Crossing::Rising, |t, _q, _z| t - 1.0)
    ///     .then(|state| state.z[0] = 2.0) // a blow
    ///     .adaptive(1e-10, 1e-10)
    ///     .contact_events()
    ///     .run(SVector::zeros(), SVector::zeros(), 0.0..3.0)?;
    /// // It rests, slides for v²/(2 μ g), and rests.
    /// let end = run.last().expect("a state");
    /// assert!((end.q[0] - 0.4).abs() < 1e-9 && end.z[0] == 0.0);
    /// # Ok(())
    /// # }
    /// ```
    pub fn then<J: FnMut(&mut Sample<K>)>(self, jump: J) -> ContactRun<'k, K, C, I, Watched<E, G, JumpFunction<J>>> {
        self.with_events(|events| events.then(jump, false))
    }

    /// Changes the state as [`then`](Self::then) does, where the function may go on through zero.
    pub fn then_through<J: FnMut(&mut Sample<K>)>(
        self,
        jump: J,
    ) -> ContactRun<'k, K, C, I, Watched<E, G, JumpFunction<J>>> {
        self.with_events(|events| events.then(jump, true))
    }
}
