//! What an integration hands out: samples, and trajectories that can be asked at any time between them.

use core::fmt;

use alloc::vec::Vec;

use crate::configuration::{Configuration, VectorSpace};
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::state::{Rates, Sample, State, TangentOf, copy_and_debug};
use crate::real::Real;
use crate::system::GaussSystem;

/// A sample with the derivatives that interpolation needs.
struct Knot<S: GaussSystem> {
    sample: Sample<S>,
    velocity: TangentOf<S>,
    acceleration: S::Speeds,
    momentum_rate: S::Speeds,
}

copy_and_debug!(Knot { sample, velocity, acceleration, momentum_rate });

/// A state in which a function passed through zero: see [`Simulation::event`](crate::integrate::Simulation::event).
#[non_exhaustive]
pub struct EventSample<S: GaussSystem> {
    /// Which event, counted from 0 in the order in which they were asked for.
    pub number: usize,
    /// The state.
    pub sample: Sample<S>,
}

copy_and_debug!(EventSample { number, sample });

/// Samples in the order of integration, at least one; a continuous curve through them by [`at`](Self::at).
pub struct Trajectory<S: GaussSystem> {
    knots: Vec<Knot<S>>,
    events: Vec<EventSample<S>>,
}

impl<S: GaussSystem> Clone for Trajectory<S> {
    fn clone(&self) -> Self {
        Self { knots: self.knots.clone(), events: self.events.clone() }
    }
}

impl<S: GaussSystem> fmt::Debug for Trajectory<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}

#[allow(clippy::len_without_is_empty)] // Never empty.
impl<S: GaussSystem> Trajectory<S> {
    /// A trajectory of one sample, its derivatives not known.
    pub(in crate::integrate) fn starting_with(sample: Sample<S>) -> Self {
        let none = S::Speeds::zero();
        let velocity = TangentOf::<S>::zero();
        let knots = Vec::from([Knot { sample, velocity, acceleration: none, momentum_rate: none }]);
        Self { knots, events: Vec::new() }
    }

    /// Appends a sample; `first` replaces the one that the trajectory started with.
    pub(in crate::integrate) fn record<P: Problem<System = S>>(
        &mut self,
        first: bool,
        problem: &P,
        sample: &Sample<S>,
        state: &State<S>,
        rates: &Rates<S>,
    ) {
        let (acceleration, momentum_rate) = problem.both_rates(state, &rates.variables);
        if first {
            self.knots.clear();
        }
        self.knots.push(Knot { sample: *sample, velocity: rates.configuration, acceleration, momentum_rate });
    }

    pub(in crate::integrate) fn record_event(&mut self, number: usize, sample: Sample<S>) {
        self.events.push(EventSample { number, sample });
    }

    /// The events in the order in which they happened. They are states of the run by themselves, not samples of the
    /// trajectory; only one that ended the run is its last sample too.
    #[must_use]
    pub fn events(&self) -> &[EventSample<S>] {
        &self.events
    }

    /// The times and states of one event, by its number.
    pub fn events_of(&self, number: usize) -> impl Iterator<Item = &Sample<S>> {
        self.events.iter().filter(move |event| event.number == number).map(|event| &event.sample)
    }

    /// The number of samples, at least 1.
    #[must_use]
    pub fn len(&self) -> usize {
        self.knots.len()
    }

    /// The initial sample.
    #[must_use]
    pub fn first(&self) -> &Sample<S> {
        &self.knots[0].sample
    }

    /// The last sample.
    #[must_use]
    pub fn last(&self) -> &Sample<S> {
        &self.knots[self.knots.len() - 1].sample
    }

    /// Sample `n`, counted from 0.
    #[must_use]
    pub fn get(&self, n: usize) -> Option<&Sample<S>> {
        self.knots.get(n).map(|knot| &knot.sample)
    }

    /// The samples in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &Sample<S>> + DoubleEndedIterator {
        self.knots.iter().map(|knot| &knot.sample)
    }

    /// The state at time `t`; `None` outside the interval of the trajectory. For packs of numbers the first lane of the
    /// times decides between which samples to look.
    ///
    /// Cubic Hermite interpolation of z and p, and of the configuration on its group: in the algebra at the earlier sample,
    /// where q is `q₀ ∘ exp(σ)`, σ is interpolated with `σ̇ = dexp_inv(σ, V)`. The error is of fourth order in the distance
    /// of the samples; between them the body must turn by less than π. Samples satisfy constraints up to rounding, what is
    /// interpolated between them up to that error: [`GaussSystem::project`] takes it away.
    #[must_use]
    pub fn at(&self, t: S::Scalar) -> Option<Sample<S>> {
        let time = t.lane(0);
        let after = self.knot_from(t)?;
        let right = self.knots.get(after)?;
        if right.sample.t.lane(0) == time || after == 0 {
            return Some(Sample { t, ..right.sample });
        }
        Some(hermite(&self.knots[after - 1], right, t))
    }

    /// The number of the first sample that is not before `t`, if the trajectory covers it.
    pub(in crate::integrate) fn knot_from(&self, t: S::Scalar) -> Option<usize> {
        let time = t.lane(0);
        let of = |knot: &Knot<S>| knot.sample.t.lane(0);
        let (first, last) = (self.first().t.lane(0), self.last().t.lane(0));
        let backward = last < first;
        let inside = if backward { last <= time && time <= first } else { first <= time && time <= last };
        if !inside {
            return None;
        }
        Some(self.knots.partition_point(|knot| if backward { of(knot) > time } else { of(knot) < time }))
    }
}

impl<'a, S: GaussSystem> IntoIterator for &'a Trajectory<S> {
    type Item = &'a Sample<S>;
    type IntoIter = alloc::boxed::Box<dyn Iterator<Item = &'a Sample<S>> + 'a>;

    fn into_iter(self) -> Self::IntoIter {
        alloc::boxed::Box::new(self.iter())
    }
}

/// The cubic between two knots.
fn hermite<S: GaussSystem>(left: &Knot<S>, right: &Knot<S>, t: S::Scalar) -> Sample<S> {
    let (one, two) = (S::Scalar::one(), S::Scalar::from_f64(2.0));
    let h = right.sample.t - left.sample.t;
    let s = (t - left.sample.t) / h;
    let rest = one - s;
    // Values at the right end (the left one is the origin of differences), and the two slopes.
    let value = s * s * (one + two * rest);
    let (slope_left, slope_right) = (h * s * rest * rest, -(h * s * s * rest));

    let sigma = left.sample.q.difference(&right.sample.q);
    let end_slope = S::Configuration::dexp_inv(&sigma, &right.velocity);
    let increment = sigma.scale(value).add_scaled(slope_left, &left.velocity).add_scaled(slope_right, &end_slope);

    let linear = |from: &S::Speeds, to: &S::Speeds, slope: &S::Speeds, next: &S::Speeds| {
        let change = to.add_scaled(-one, from);
        from.add_scaled(value, &change).add_scaled(slope_left, slope).add_scaled(slope_right, next)
    };
    Sample {
        t,
        q: left.sample.q.retract(&increment).renormalise(),
        z: linear(&left.sample.z, &right.sample.z, &left.acceleration, &right.acceleration),
        p: linear(&left.sample.p, &right.sample.p, &left.momentum_rate, &right.momentum_rate),
    }
}
