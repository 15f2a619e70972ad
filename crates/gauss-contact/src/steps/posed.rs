//! The laws of a step as they are posed: the contacts that act in it, and what they begin with.

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::{ContactSystem, Each};
use gauss_runtime::real::Real;

use crate::lockstep::Lockstep;
use crate::mode::Mode;
use crate::residual::Residual;

use super::cones::{Cone, Laws};
use super::impulses::{Found, Impulses, norm};
use super::motion;
use super::outcome::Solved;
use super::relaxed::{StepLaw, lifts};
use super::unknowns::State;

/// Data of a step before its impulses.
pub(super) struct Posed<'a, K: ContactSystem> {
    pub(super) kernel: &'a K,
    pub(super) h: f64,
    pub(super) law: StepLaw,
    pub(super) tolerance: f64,
    pub(super) laws: &'a Laws<K>,
    pub(super) delassus: &'a K::Delassus,
    pub(super) restitution: K::Gaps,
    /// Before the step.
    pub(super) gaps: K::Gaps,
    /// Before the step, and at its end without impulses.
    pub(super) rates: [K::ContactRows; 2],
    /// The fastest of them.
    pub(super) fastest: K::Scalar,
    /// Impulses of the step before.
    pub(super) impulses: K::ContactRows,
    pub(super) modes: &'a [Mode],
    /// Whether contacts depend on one another, as far as is known.
    pub(super) dependent: bool,
}

impl<T: Real, K: ContactSystem<Scalar = T>> Posed<'_, K> {
    /// Rate that an impact passes on: a part of that before it.
    pub(super) fn passed_on(&self, i: usize) -> T {
        let [before, free] = [0, 1].map(|k: usize| self.rates[k].component(self.kernel.contacts()[i].normal));
        -self.restitution.component(i) * motion::reversed(before, self.gap_at_end(i, free), self.fastest)
    }

    /// Whether a gap was closed in the step before, and does not lie open since: an impact may leave a gap on its way
    /// to zero.
    fn stays_closed(&self, i: usize, lockstep: &Lockstep) -> bool {
        let free = self.rates[1].component(self.kernel.contacts()[i].normal);
        let is_open = |lane: usize| self.approaches(i, lane) && self.gap_at_end(i, free).lane(lane) > 0.0;
        self.modes[i].is_closed() && !lockstep.agree::<T>(is_open)
    }

    /// Whether a gap closes before the step, to half of the digits: what is slower lies still.
    fn approaches(&self, i: usize, lane: usize) -> bool {
        let before = self.rates[0].component(self.kernel.contacts()[i].normal);
        before.lane(lane) < -Real::sqrt(f64::EPSILON) * self.fastest.lane(lane)
    }

    /// The gap with which a contact ends the step, given its rate there.
    fn gap_at_end(&self, i: usize, rate: T) -> T {
        let before = self.rates[0].component(self.kernel.contacts()[i].normal);
        self.gaps.component(i) + T::from_f64(0.5 * self.h) * (before + rate)
    }

    /// The gap of a contact that does not act, given its rate without what impacts pass on.
    pub(super) fn gap_left_open(&self, i: usize, rate: T) -> T {
        self.gap_at_end(i, rate + self.passed_on(i))
    }

    /// Poses the problem; the cones of which those act that may.
    pub(super) fn pose(&self, problem: &mut Impulses<T>) -> K::EachContact<Cone<T>> {
        problem.dependent = self.dependent;
        problem.relaxed = self.law == StepLaw::ConvexRelaxation;
        let row = |row: usize| [self.rates[1].component(row), self.impulses.component(row)];
        problem.set_up(self.laws.scales.as_ref(), |i, j| self.delassus[(i, j)], row);
        let mut cones = self.laws.cones;
        for (i, contact) in self.kernel.contacts().iter().enumerate() {
            // Rolling resistance comes after the contact that it is of.
            cones[i].acts = match contact.rolls_on() {
                Some(on) => cones[on].acts,
                None => {
                    !contact.has_gap()
                        || (self.stays_closed(i, &problem.lockstep)
                            && !lifts(self.kernel.contacts(), self.law, self.modes, i))
                        || problem.lockstep.at_most(self.gap_at_end(i, problem.b[contact.normal]), T::zero())
                }
            };
            if contact.has_gap() {
                problem.b[contact.normal] -= self.passed_on(i);
            }
        }
        cones
    }

    /// Friction where no impulse changes the slip, as along a coordinate that a constraint drives: it is at its bound
    /// against the mean slip of the step, and nothing but the force of the constraint depends on it.
    pub(super) fn drive(&self, problem: &mut Impulses<T>, cones: &[Cone<T>]) {
        for cone in cones {
            if !(cone.acts && problem.is_driven(cone)) {
                continue;
            }
            let mut slip = [T::zero(); 3];
            for (slip, row) in slip.iter_mut().zip(cone.tangents()) {
                let mean = T::from_f64(0.5) * (self.rates[0].component(row) + self.rates[1].component(row));
                *slip = self.laws.scales[row] * mean;
            }
            let size = norm(&slip);
            let friction = if problem.lockstep.at_most(size, T::zero()) {
                [T::zero(); 3]
            } else {
                let radius = cone.radius(problem.impulses);
                slip.map(|slip| -radius * (slip / size))
            };
            cone.tangents().zip(friction).for_each(|(row, friction)| problem.impulses[row] = friction);
        }
    }

    /// The impulses that were found.
    pub(super) fn impulses(&self, problem: &Impulses<T>) -> K::ContactRows {
        let mut impulses = K::ContactRows::zero();
        let scales = self.laws.scales.as_ref();
        let each = scales.iter().zip(problem.impulses.iter()).enumerate();
        each.for_each(|(row, (scale, impulse))| impulses.set_component(row, *scale * *impulse));
        impulses
    }

    /// The answer of the laws.
    pub(super) fn answer(&self, problem: &Impulses<T>, found: Found<T>, cones: &[Cone<T>]) -> Answer<T, K> {
        let scales = self.laws.scales.as_ref();
        let from_coulomb = if problem.relaxed { problem.residual_of_coulomb(cones) } else { found.residual };
        let work = problem.work(|row| scales[row] * self.rates[1].component(row));
        let state = |cone: &Cone<T>| problem.slides_driven(cone).unwrap_or_else(|| problem.state(cones, cone));
        let states = Each::from_fn(|i| cones.get(i).map_or(State::Leaves, state));
        Answer { found, from_coulomb, work, states }
    }

    /// The same in a lane, of which it is given what rested before the step, with the modes after it.
    pub(super) fn solved<S: ContactSystem<Scalar = f64>>(
        &self,
        problem: &Impulses<T>,
        (answer, cones): (&Answer<T, K>, &[Cone<T>]),
        (rested, after): (&[bool], &mut [Mode]),
        lane: usize,
    ) -> Solved<S> {
        let scales = self.laws.scales.as_ref();
        for ((mode, cone), state) in after.iter_mut().zip(cones).zip(answer.states.as_ref()) {
            *mode = problem.mode((cone, state), scales, self.tolerance, lane);
        }
        let (found, from_coulomb, work) =
            (answer.found.lane(lane), answer.from_coulomb.lane(lane), answer.work.lane(lane));
        let rests = Each::from_fn(|_| false);
        let mut solved = Solved { found, from_coulomb, rests, struck: false, impacts: 0, work };
        let approaches = |i: usize| self.approaches(i, lane);
        solved.tell((self.kernel.contacts(), self.law), (rested, after), |i| {
            (self.passed_on(i).lane(lane), approaches(i))
        });
        solved
    }
}

/// Answer of the laws of a step, of all lanes.
pub(super) struct Answer<T: Real, K: ContactSystem<Scalar = T>> {
    found: Found<T>,
    from_coulomb: Residual<T>,
    work: T,
    states: K::EachContact<State<T>>,
}
