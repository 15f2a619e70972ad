//! The laws of a step in all lanes at once, as long as lanes decide alike.

use alloc::vec::Vec;

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::{ContactSystem, Each, ImpulseDynamics, ImpulseResponse};
use gauss_runtime::real::Real;
use gauss_runtime::simd::Packed;

use crate::mode::{Mode, after_impulses};

use super::cones::Laws;
use super::impulses::{self, Impulses};
use super::lanes::{ContactLanes, LanesOf, Stage, single};
use super::motion::{self, Middle};
use super::outcome::{Pushed, Solved};
use super::posed::Posed;
use super::projection::{Closed, Projection};
use super::relaxed::StepLaw;
use super::unknowns::Unknowns;

impl<W: LanesOf<K>, K: ContactSystem<Scalar = f64>> ContactLanes<'_, W, K> {
    /// Whether an answer is that of the first lane in all of them.
    fn alike<A: PartialEq>(&self, of: impl Fn(usize) -> A) -> bool {
        let first = of(0);
        (1..self.steppers.len()).all(|lane| of(lane) == first)
    }

    /// Whether all lanes touch, and begin a step alike.
    fn begin_alike(&self) -> bool {
        let of = |lane: usize| &self.steppers[lane];
        let in_touch = self.stages.iter().all(|stage| matches!(stage, Stage::Middle(_)));
        let law = |lane: usize| (of(lane).law, of(lane).tolerance.to_bits(), of(lane).dependent);
        let closed = |i: usize| self.alike(|lane| of(lane).modes[i].is_closed());
        in_touch && self.alike(law) && of(0).law == StepLaw::Coulomb && (0..W::CONTACTS.len()).all(closed)
    }

    /// Impulses of all lanes; nothing, and nothing is changed, where they part.
    pub(super) fn push_together(
        &mut self,
        h: f64,
        middle: &Middle<W>,
        friction: &W::ContactRows,
        dynamics: &ImpulseDynamics<W>,
    ) -> Option<()> {
        let lanes = self.steppers.len();
        let of = |lane: usize| &self.steppers[lane];
        if !self.begin_alike() {
            return None;
        }
        let laws = Laws::<W>::new(h, friction).ok()?;
        let (z, before): (W::Speeds, W::ContactRows) =
            (self.vectors(|lane| of(lane).z), self.vectors(|lane| of(lane).rates));
        let free = z.add_scaled(W::Scalar::from_f64(h), &dynamics.acceleration);
        let dependent = of(0).dependent;
        let free_and_bias = (&free, &dynamics.bias);
        let rates = motion::free_rates(self.wide, (h, dependent), middle, (&z, &before), free_and_bias);
        let posed = Posed::<W> {
            h,
            law: StepLaw::Coulomb,
            tolerance: of(0).tolerance,
            laws: &laws,
            delassus: &dynamics.response.delassus,
            restitution: self.wide.restitution(),
            gaps: self.vectors(|lane| of(lane).gaps),
            rates,
            impulses: self.vectors(|lane| of(lane).impulses),
            modes: of(0).modes.as_ref(),
            dependent,
        };
        let mut unknowns = Unknowns::<W>::new();
        let mut problem = Impulses::new(&mut self.memory[..impulses::memory(W::ContactRows::DIM)], unknowns.slices());
        let cones = posed.pose(&mut problem);
        let cones = cones.as_ref();
        let found = problem.solve_in_lockstep(cones, posed.tolerance)?;
        let joins = |i: usize| {
            let rate = cones[i].normal.map(|normal| problem.rates[normal]);
            let closes = |rate| (0..lanes).any(|lane| posed.gap_left_open(i, rate).lane(lane) < 0.0);
            !cones[i].acts && rate.is_some_and(closes)
        };
        let answer = posed.answer(&problem, found, cones);
        let impulses = posed.impulses(&problem);
        let z = after_impulses(&problem.lockstep, self.wide, &free, (&dynamics.response.factors, &impulses));
        if (0..cones.len()).any(joins) || problem.dependent != dependent || problem.lockstep.has_parted() {
            return None;
        }
        let solved = |lane: usize| {
            let mut after: K::EachContact<Mode> = Each::from_fn(|_| Mode::Open);
            let modes = (self.steppers[lane].modes.as_ref(), after.as_mut());
            let solved = posed.solved::<K>(&problem, (&answer, cones), modes, lane);
            (after, solved)
        };
        let solved: Vec<_> = (0..lanes).map(solved).collect();
        self.hand_out(solved, (&z, &impulses, dependent));
        Some(())
    }

    /// Impulses, the speeds after them, and modes to each lane.
    fn hand_out(
        &mut self,
        solved: Vec<(K::EachContact<Mode>, Solved<K>)>,
        (z, impulses, dependent): (&W::Speeds, &W::ContactRows, bool),
    ) {
        for (lane, (after, solved)) in solved.into_iter().enumerate() {
            self.steppers[lane].next = after;
            if let Stage::Middle(middle) = core::mem::replace(&mut self.stages[lane], Stage::Alone) {
                let (z, impulses) =
                    (single::<W, _, K::Speeds>(z, lane), single::<W, _, K::ContactRows>(impulses, lane));
                self.stages[lane] = Stage::Pushed(middle, Pushed { z, impulses, dependent, solved });
            }
        }
    }

    /// What impulses do, in each lane: lanes part.
    pub(super) fn go_apart(&mut self) {
        if let Some(response) = self.response.take() {
            for (lane, of_lane) in self.responses.iter_mut().enumerate() {
                let (factors, delassus) = (response.factors.extract(lane), response.delassus.extract(lane));
                *of_lane = Some(ImpulseResponse::new(factors, delassus));
            }
        }
    }

    /// Closed gaps of all lanes brought to zero; nothing, and nothing is changed, where they part.
    pub(super) fn close_together(&mut self, (t, q, gaps): (W::Scalar, W::Configuration, W::Gaps)) -> Option<()> {
        let rests = |lane: usize, i: usize| match &self.stages[lane] {
            Stage::Open(_, _, pushed) => Some(pushed.solved.rests[i]),
            _ => None,
        };
        let rest: W::EachContact<Option<bool>> =
            Each::from_fn(|i| rests(0, i).filter(|_| self.alike(|lane| rests(lane, i))));
        if rest.as_ref().iter().any(Option::is_none) {
            return None;
        }
        let rest: W::EachContact<bool> = Each::from_fn(|i| rest[i] == Some(true));
        let magnitude = self.number(|lane| match &self.stages[lane] {
            Stage::Open(q, ..) => motion::magnitude(q),
            _ => f64::NAN,
        });
        let response = self.response.as_ref()?;
        let mut projection = Projection::<W>::new(&mut self.memory[impulses::memory(W::ContactRows::DIM)..]);
        let closed = projection.close(self.wide, (t, q, gaps), (response, magnitude), rest.as_ref()).ok()?;
        if projection.lockstep.has_parted() {
            return None;
        }
        for (lane, stage) in self.stages.iter_mut().enumerate() {
            if let Stage::Open(_, z, pushed) = core::mem::replace(stage, Stage::Alone) {
                let (q, gaps) = (closed.q.extract(lane), single::<W, _, K::Gaps>(&closed.gaps, lane));
                let (penetration, closure) = (closed.penetration.lane(lane), closed.closure.lane(lane));
                *stage = Stage::Closed(Closed { q, gaps, penetration, closure }, z, pushed);
            }
        }
        Some(())
    }

    /// Rates of what rests in all lanes brought to zero, and the end of the step; nothing, and nothing is changed,
    /// where they part.
    pub(super) fn stop_together(
        &mut self,
        h: f64,
        (t, q, z, rates): (W::Scalar, &W::Configuration, W::Speeds, W::ContactRows),
    ) -> Option<()> {
        // The rows that are brought to zero do not depend on the direction of slip.
        let mode = |lane: usize, i: usize| match &self.stages[lane] {
            Stage::Closed(_, _, pushed) => Some(match self.steppers[lane].mode_at_end(pushed, i) {
                Mode::Slides(_) => Mode::Closed,
                mode => mode,
            }),
            _ => None,
        };
        let modes: W::EachContact<Option<Mode>> =
            Each::from_fn(|i| mode(0, i).filter(|_| self.alike(|lane| mode(lane, i))));
        if modes.as_ref().iter().any(Option::is_none) {
            return None;
        }
        let rounding = self.number(|lane| match &self.stages[lane] {
            Stage::Closed(_, _, pushed) => self.steppers[lane].rounding_at_end(pushed),
            _ => f64::NAN,
        });
        let response = self.response.as_ref()?;
        let mut projection = Projection::<W>::new(&mut self.memory[impulses::memory(W::ContactRows::DIM)..]);
        let mode = |i: usize| modes[i].unwrap_or(Mode::Open);
        let (z, rates) = projection.stop(self.wide, (t, q, z, rates), response, (mode, rounding));
        if projection.lockstep.has_parted() {
            return None;
        }
        for (lane, stepper) in self.steppers.iter_mut().enumerate() {
            if let Stage::Closed(closed, _, pushed) = core::mem::replace(&mut self.stages[lane], Stage::Made) {
                let (z, rates) = (single::<W, _, K::Speeds>(&z, lane), single::<W, _, K::ContactRows>(&rates, lane));
                let end = stepper.end(pushed, closed, (z, rates));
                self.outcomes[lane] = stepper.made(h, end);
            }
        }
        Some(())
    }
}
