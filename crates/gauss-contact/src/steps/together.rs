//! Decisions of several lanes of a step: in packs as long as lanes decide alike, lane by lane else.

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::{ContactSystem, Each, ImpulseDynamics};
use gauss_runtime::real::Real;
use gauss_runtime::simd::Packed;

use crate::mode::{Mode, after_impulses};

use super::bounds::Touched;
use super::cones::Laws;
use super::impulses::{self, Impulses};
use super::lane::{Lane, LaneDynamics, LanesOf, PackedState, Stage, put, single};
use super::motion;
use super::outcome::Pushed;
use super::posed::Posed;
use super::projection::{Closed, Projection};
use super::relaxed::StepLaw;
use super::step::{Decisions, Moved, Step, StepDynamics, Stopped};
use super::stepper::ContactStepper;
use super::unknowns::Unknowns;

/// Decisions of the lanes that go together: those in one stage of a step.
pub(super) struct Together<'a, 'k, W: ContactSystem, K: ContactSystem<Scalar = f64>> {
    pub(super) steppers: &'a mut [ContactStepper<'k, K>],
    pub(super) lanes: &'a mut [Lane<'k, K>],
    pub(super) memory: &'a mut [W::Scalar],
    pub(super) state: &'a PackedState<W>,
    pub(super) stage: Stage,
    /// Whether all lanes have decided alike.
    pub(super) in_lockstep: bool,
}

/// No lane goes with the others.
pub(super) struct Parted;

impl<'a, 'k, W: LanesOf<K>, K: ContactSystem<Scalar = f64>> Together<'a, 'k, W, K> {
    /// Whether there is a lane that goes.
    fn goes(&self) -> bool {
        self.lanes.iter().any(|lane| lane.stage == self.stage)
    }

    /// A decision of each lane, without which it goes alone.
    pub(super) fn each(
        &mut self,
        mut decide: impl FnMut(usize, &mut ContactStepper<'k, K>, &mut Lane<'k, K>) -> Option<()>,
    ) -> Result<(), Parted> {
        let Self { steppers, lanes, stage, .. } = self;
        for (lane, (stepper, of)) in steppers.iter_mut().zip(lanes.iter_mut()).enumerate() {
            if of.stage == *stage && decide(lane, stepper, of).is_none() {
                of.stage = Stage::Alone;
            }
        }
        self.in_lockstep &= self.lanes.iter().all(|lane| lane.stage == self.stage);
        if self.goes() { Ok(()) } else { Err(Parted) }
    }

    /// Whether an answer is that of the first lane in all of them.
    fn alike<A: PartialEq>(&self, of: impl Fn(usize) -> A) -> bool {
        let first = of(0);
        (1..self.steppers.len()).all(|lane| of(lane) == first)
    }

    /// Whether all lanes have the same law, and the same contacts are closed in them.
    fn begins_alike(&self) -> bool {
        let of = |lane: usize| &self.steppers[lane];
        let law = |lane: usize| (of(lane).law, of(lane).tolerance.to_bits(), of(lane).dependent);
        let closed = |i: usize| self.alike(|lane| (of(lane).modes[i].is_closed(), of(lane).may_bounce(i)));
        self.in_lockstep
            && of(0).law == StepLaw::Coulomb
            && self.alike(law)
            && (0..of(0).kernel.contacts().len()).all(closed)
    }

    /// Impulses of all lanes, and the speeds after them; nothing where lanes part.
    fn push_in_lockstep(&mut self, at: &StepDynamics<W>) -> Option<(W::ContactRows, W::Speeds)> {
        if !self.begins_alike() {
            return None;
        }
        let StepDynamics { step: Step { kernel, h, middle, .. }, friction, free, impulses } = at;
        let (kernel, h, ImpulseDynamics { bias, response, .. }) = (*kernel, *h, impulses);
        let PackedState { z, gaps, rates, impulses, .. } = self.state;
        let laws = Laws::new(kernel, h, friction).ok()?;
        let ContactStepper { dependent, tolerance, modes, .. } = self.steppers[0];
        let bounces = |i: usize| self.steppers[0].may_bounce(i);
        let rates = motion::free_rates(kernel, h, middle, (z, rates), (free, bias), (dependent, bounces));
        let posed = Posed::<W> {
            kernel,
            h,
            law: StepLaw::Coulomb,
            tolerance,
            laws: &laws,
            delassus: &response.delassus,
            restitution: kernel.restitution(),
            gaps: *gaps,
            rates,
            fastest: motion::fastest::<W>(&rates),
            impulses: *impulses,
            modes: modes.as_ref(),
            dependent,
        };
        let mut unknowns = Unknowns::<W>::new();
        let memory = &mut self.memory[..impulses::memory(W::ContactRows::DIM)];
        let mut problem = Impulses::new(memory, unknowns.slices(kernel));
        let cones = posed.pose(&mut problem);
        let cones = &cones.as_ref()[..kernel.contacts().len()];
        let found = problem.solve_in_lockstep(cones, posed.tolerance)?;
        posed.drive(&mut problem, cones);
        let joins = |i: usize| {
            let rate = cones[i].normal.map(|normal| problem.rates[normal]);
            let closes = |rate| (0..self.steppers.len()).any(|lane| posed.gap_left_open(i, rate).lane(lane) < 0.0);
            !cones[i].acts && rate.is_some_and(closes)
        };
        let answer = posed.answer(&problem, found, cones);
        let impulses = posed.impulses(&problem);
        let z = after_impulses(&problem.lockstep, kernel, free, (&response.factors, &impulses));
        if (0..cones.len()).any(joins) || problem.dependent != dependent || problem.lockstep.has_parted() {
            return None;
        }
        for (lane, (stepper, of)) in self.steppers.iter_mut().zip(self.lanes.iter_mut()).enumerate() {
            let rests = (stepper.rests.as_ref(), stepper.next.as_mut());
            let solved = posed.solved::<K>(&problem, (&answer, cones), rests, lane);
            of.pushed = Some(Pushed { impulses: single::<W, _, _>(&impulses, lane), dependent, solved });
        }
        Some((impulses, z))
    }

    /// Whether a contact rests in a lane, and its mode at the end. Rows that are brought to zero do not depend on the
    /// direction of slip.
    fn rests(&self, lane: usize, i: usize) -> (bool, Mode) {
        let rests = self.lanes[lane].pushed.as_ref().is_some_and(|pushed| pushed.solved.rests[i]);
        let mode = match self.steppers[lane].next[i] {
            _ if !rests => Mode::Open,
            Mode::Slides(_) => Mode::Closed,
            mode => mode,
        };
        (rests, mode)
    }

    /// The same of the first lane, where all are alike.
    fn rest_alike(&self) -> Option<(W::EachContact<bool>, W::EachContact<Mode>)> {
        let contacts = 0..self.steppers[0].kernel.contacts().len();
        let alike = self.in_lockstep && contacts.clone().all(|i| self.alike(|lane| self.rests(lane, i)));
        let of = |i: usize| if contacts.contains(&i) { self.rests(0, i) } else { (false, Mode::Open) };
        alike.then(|| (Each::from_fn(|i| of(i).0), Each::from_fn(|i| of(i).1)))
    }
}

impl<'k, W: LanesOf<K>, K: ContactSystem<Scalar = f64>> Decisions<W> for Together<'_, 'k, W, K> {
    type Pushed = W::ContactRows;
    type Refusal = Parted;

    fn stays_open(
        &mut self,
        Step { kernel, h, z: before, middle, .. }: &Step<W>,
        z: &W::Speeds,
    ) -> Result<bool, Parted> {
        let rates = kernel.contact_rates(middle.t, &middle.q, &motion::mean(before, z));
        let closes =
            |lane, stepper: &ContactStepper<'k, K>| stepper.comes_to_zero(*h, &single::<W, _, _>(&rates, lane));
        self.each(|lane, stepper, _| (!closes(lane, stepper)).then_some(())).map(|()| true)
    }

    fn push(&mut self, at: &StepDynamics<W>) -> Result<(W::ContactRows, W::Speeds), Parted> {
        if let Some(pushed) = self.push_in_lockstep(at) {
            return Ok(pushed);
        }
        self.in_lockstep = false;
        let (mut impulses, mut after) = (W::ContactRows::zero(), *at.free);
        self.each(|lane, stepper, of| {
            // Where it has no solution it is tried in parts, alone.
            let of_lane = of.dynamics.insert(LaneDynamics::new(at, stepper, lane));
            let (pushed, z) = of_lane.decide(|at| stepper.push(at)).ok()?;
            put::<W, _, _>(&mut impulses, lane, &pushed.impulses);
            put::<W, _, _>(&mut after, lane, &z);
            of.pushed = Some(pushed);
            Some(())
        })?;
        Ok((impulses, after))
    }

    /// Lane by lane: iterations end where they do.
    fn project(&mut self, step: &Step<W>, (mut q, mut z): Moved<W>) -> Result<Moved<W>, Parted> {
        self.each(|lane, stepper, _| {
            let t = stepper.t + step.h;
            let end = stepper.kernel.project(t, &q.extract(lane), &single::<W, _, _>(&z, lane)).ok()?;
            q.replace(lane, &end.0);
            put::<W, _, _>(&mut z, lane, &end.1);
            Some(())
        })?;
        Ok((q, z))
    }

    fn close(
        &mut self,
        at: &StepDynamics<W>,
        pushed: &mut W::ContactRows,
        end: &Moved<W>,
    ) -> Result<Closed<W>, Parted> {
        let StepDynamics { step, impulses, .. } = at;
        if let Some((rests, _)) = self.rest_alike() {
            let touched = Touched { closed: rests.as_ref(), impulses: pushed, rates: &self.state.rates, h: step.h };
            let mut projection = projection(step.kernel, self.memory);
            if let Ok(closed) = projection.close((step.end, end.0), &impulses.response, &touched)
                && !projection.lockstep.has_parted()
            {
                self.lanes.iter_mut().enumerate().for_each(|(lane, of)| of.closed = Some(closed_of(&closed, lane)));
                return Ok(closed);
            }
        }
        self.in_lockstep = false;
        let mut closed = Closed::<W>::still(end.0);
        self.each(|lane, stepper, of| {
            let of_lane = of.dynamics.get_or_insert_with(|| LaneDynamics::new(at, stepper, lane));
            let end = (end.0.extract(lane), single::<W, _, _>(&end.1, lane));
            let pushed = of.pushed.as_mut()?;
            let closes = of_lane.decide(|at| stepper.close(at, pushed, &end)).ok()?;
            closed.q.replace(lane, &closes.q);
            put::<W, _, _>(&mut closed.gaps, lane, &closes.gaps);
            of.closed = Some(closes);
            Some(())
        })?;
        Ok(closed)
    }

    fn stop(
        &mut self,
        at: &StepDynamics<W>,
        (_, closed): (&W::ContactRows, &Closed<W>),
        (mut z, mut rates): Stopped<W>,
    ) -> Result<Stopped<W>, Parted> {
        let StepDynamics { step, impulses, .. } = at;
        if let Some((_, modes)) = self.rest_alike() {
            let solved = |lane: usize| self.lanes[lane].pushed.as_ref().map(|pushed| &pushed.solved);
            let rounding = |lane: usize| solved(lane).map_or(0.0, |solved| self.steppers[lane].rounding_at_end(solved));
            let mut roundings = W::Scalar::repeat(&rounding(0));
            (1..self.lanes.len()).for_each(|lane| roundings.replace(lane, &rounding(lane)));
            let mut projection = projection(step.kernel, self.memory);
            let at_end = (step.end, &closed.q, z, rates);
            let stopped = projection.stop(at_end, &impulses.response, (|i| modes[i], roundings));
            if !projection.lockstep.has_parted() {
                return Ok(stopped);
            }
        }
        self.in_lockstep = false;
        self.each(|lane, stepper, of| {
            let of_lane = of.dynamics.get_or_insert_with(|| LaneDynamics::new(at, stepper, lane));
            let end = (single::<W, _, _>(&z, lane), single::<W, _, _>(&rates, lane));
            let decided = (of.pushed.as_ref()?, of.closed.as_ref()?);
            let stopped = of_lane.decide(|at| stepper.stop(at, decided, end)).ok()?;
            put::<W, _, _>(&mut z, lane, &stopped.0);
            put::<W, _, _>(&mut rates, lane, &stopped.1);
            Some(())
        })?;
        Ok((z, rates))
    }
}

/// Memory for the projection of all lanes.
fn projection<'m, W: ContactSystem>(kernel: &'m W, memory: &'m mut [W::Scalar]) -> Projection<'m, W> {
    Projection::new(kernel, &mut memory[impulses::memory(W::ContactRows::DIM)..])
}

/// Closed gaps of a lane.
fn closed_of<W: LanesOf<K>, K: ContactSystem<Scalar = f64>>(closed: &Closed<W>, lane: usize) -> Closed<K> {
    Closed {
        q: closed.q.extract(lane),
        gaps: single::<W, _, _>(&closed.gaps, lane),
        penetration: closed.penetration.lane(lane),
        closure: closed.closure.lane(lane),
        left: Each::from_fn(|_| false),
    }
}
