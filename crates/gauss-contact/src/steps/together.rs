//! A step of all lanes in packs, as long as lanes decide alike.

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::{ContactSystem, Each, ImpulseDynamics, ImpulseResponse};
use gauss_runtime::real::Real;
use gauss_runtime::simd::Packed;

use crate::mode::{Mode, after_impulses};

use super::bounds::Touched;
use super::cones::Laws;
use super::impulses::{self, Impulses};
use super::lanes::{ContactLanes, LanesOf, PackedState, put, single};
use super::motion::{self, Middle};
use super::outcome::{Attempt, Pushed};
use super::posed::Posed;
use super::projection::{Closed, Projection};
use super::relaxed::StepLaw;
use super::report::StepScheme;
use super::unknowns::Unknowns;
use super::used::Used;

/// Speeds of all lanes after their impulses, with these.
struct PushedLanes<W: ContactSystem> {
    z: W::Speeds,
    impulses: W::ContactRows,
    dependent: bool,
}

impl<W: LanesOf<K>, K: ContactSystem<Scalar = f64>> ContactLanes<'_, W, K> {
    /// Whether an answer is that of the first lane in all of them.
    fn alike<A: PartialEq>(&self, of: impl Fn(usize) -> A) -> bool {
        let first = of(0);
        (1..self.steppers.len()).all(|lane| of(lane) == first)
    }

    /// Whether all lanes touch, and begin a step alike, of which the speeds at half are known.
    fn begin_alike(&self, h: f64) -> bool {
        let of = |lane: usize| &self.steppers[lane];
        let law = |lane: usize| (of(lane).law, of(lane).tolerance.to_bits(), of(lane).dependent, of(lane).scheme);
        let known = |lane: usize| of(lane).scheme == StepScheme::Midpoint && of(lane).last.acceleration.is_some();
        let closed = |i: usize| self.alike(|lane| (of(lane).modes[i].is_closed(), of(lane).may_bounce(i)));
        let goes_on = |lane: usize| !self.halted[lane] && known(lane) && !of(lane).last.is_stiff();
        (h > 0.0 && h.is_finite() && of(0).law == StepLaw::Coulomb && !of(0).flies())
            && (self.alike(law) && (0..self.steppers.len()).all(goes_on))
            && (0..self.wide.contacts().len()).all(closed)
    }

    /// The states of all lanes.
    fn pack(&self) -> PackedState<W> {
        let of = |lane: usize| &self.steppers[lane];
        PackedState {
            t: self.number(|lane| of(lane).t),
            q: self.places(|lane| of(lane).q),
            z: self.vectors(|lane| of(lane).z),
            gaps: self.vectors(|lane| of(lane).gaps),
            rates: self.vectors(|lane| of(lane).rates),
            impulses: self.vectors(|lane| of(lane).impulses),
            acceleration: self.vectors(|lane| of(lane).last.acceleration.unwrap_or(of(lane).z)),
        }
    }

    /// A step of all lanes; nothing, and nothing is changed, where they part.
    pub(super) fn step_together(&mut self, h: f64, input: &W::Input) -> Option<()> {
        if !self.begin_alike(h) {
            return None;
        }
        let state = self.packed.take().unwrap_or_else(|| self.pack());
        let (half, end) = (W::Scalar::from_f64(0.5 * h), state.t + W::Scalar::from_f64(h));
        let rate = self.wide.kinematics(state.t, &state.q, &state.z);
        let z = state.z.add_scaled(half, &state.acceleration);
        let middle = Middle::<W>::new((state.t, h), motion::half_way::<W>(h, &state.q, &rate), state.z, z);
        let friction = self.wide.friction(middle.t, &middle.q, &middle.z, input);
        let laws = Laws::new(self.wide, h, &friction).ok()?;
        let dynamics = self.wide.impulse_dynamics(middle.t, &middle.q, &middle.z, input);
        let pushed = self.push_together(h, (&state, &middle), &laws, &dynamics)?;
        let (q, z) = self.second_half_together(h, &middle, pushed.z)?;
        let at_end = (end, q, z);
        let (closed, z, rates) = self.close_together((h, &state), at_end, (&dynamics.response, &pushed))?;
        if !self.agree_together(h, (&state, &middle), (&dynamics.acceleration, &z), input) {
            return None;
        }
        self.take_together(h, (&state, end), (&pushed, &dynamics.acceleration), (closed, z, rates));
        Some(())
    }

    /// Impulses of all lanes, and what the laws came to in each.
    fn push_together(
        &mut self,
        h: f64,
        (state, middle): (&PackedState<W>, &Middle<W>),
        laws: &Laws<W>,
        dynamics: &ImpulseDynamics<W>,
    ) -> Option<PushedLanes<W>> {
        let first = &self.steppers[0];
        let dependent = first.dependent;
        let free = state.z.add_scaled(W::Scalar::from_f64(h), &dynamics.acceleration);
        let before = (&state.z, &state.rates);
        let bounces = |i: usize| first.may_bounce(i);
        let at = (&free, &dynamics.bias);
        let rates = motion::free_rates(self.wide, h, middle, before, at, (dependent, bounces));
        let posed = Posed::<W> {
            kernel: self.wide,
            h,
            law: StepLaw::Coulomb,
            tolerance: first.tolerance,
            laws,
            delassus: &dynamics.response.delassus,
            restitution: self.wide.restitution(),
            gaps: state.gaps,
            rates,
            fastest: motion::fastest::<W>(&rates),
            impulses: state.impulses,
            modes: first.modes.as_ref(),
            dependent,
        };
        let mut unknowns = Unknowns::<W>::new();
        let memory = &mut self.memory[..impulses::memory(W::ContactRows::DIM)];
        let mut problem = Impulses::new(memory, unknowns.slices(self.wide));
        let cones = posed.pose(&mut problem);
        let cones = &cones.as_ref()[..self.wide.contacts().len()];
        let found = problem.solve_in_lockstep(cones, posed.tolerance)?;
        posed.drive(&mut problem, cones);
        let joins = |i: usize| {
            let rate = cones[i].normal.map(|normal| problem.rates[normal]);
            let closes = |rate| (0..self.steppers.len()).any(|lane| posed.gap_left_open(i, rate).lane(lane) < 0.0);
            !cones[i].acts && rate.is_some_and(closes)
        };
        let answer = posed.answer(&problem, found, cones);
        let impulses = posed.impulses(&problem);
        let z = after_impulses(&problem.lockstep, self.wide, &free, (&dynamics.response.factors, &impulses));
        if (0..cones.len()).any(joins) || problem.dependent != dependent || problem.lockstep.has_parted() {
            return None;
        }
        self.solved.clear();
        self.solved.extend(self.steppers.iter().enumerate().map(|(lane, stepper)| {
            let mut after: K::EachContact<Mode> = Each::from_fn(|_| Mode::Open);
            let rests = (stepper.rests.as_ref(), after.as_mut());
            let solved = posed.solved::<K>(&problem, (&answer, cones), rests, lane);
            (after, solved)
        }));
        // An impact keeps an account of its energy, alone.
        let struck = self.solved.iter().any(|(_, solved)| solved.struck);
        (!struck).then_some(PushedLanes { z, impulses, dependent })
    }

    /// The second half of a step. What keeps bilateral constraints goes lane by lane: its iterations end where they do.
    fn second_half_together(&self, h: f64, middle: &Middle<W>, z: W::Speeds) -> Option<(W::Configuration, W::Speeds)> {
        let rate = self.wide.kinematics(middle.t, &middle.q, &z);
        let q = motion::half_way::<W>(h, &middle.q, &rate);
        if !K::CONSTRAINED {
            return Some((q, z));
        }
        let mut projected = (q, z);
        for (lane, stepper) in self.steppers.iter().enumerate() {
            let (q, z) = (projected.0.extract(lane), single::<W, _, K::Speeds>(&projected.1, lane));
            let (q, z) = stepper.kernel.project(stepper.t + h, &q, &z).ok()?;
            projected.0.replace(lane, &q);
            put::<W, _, _>(&mut projected.1, lane, &z);
        }
        Some(projected)
    }

    /// Closed gaps brought to zero, then rates of what rests, and slips of what sticks.
    fn close_together(
        &mut self,
        (h, state): (f64, &PackedState<W>),
        (t, q, z): (W::Scalar, W::Configuration, W::Speeds),
        (response, pushed): (&ImpulseResponse<W>, &PushedLanes<W>),
    ) -> Option<(Closed<W>, W::Speeds, W::ContactRows)> {
        let rest = |lane: usize, i: usize| self.solved[lane].1.rests[i];
        let rests: W::EachContact<bool> = Each::from_fn(|i| rest(0, i));
        // The rows that are brought to zero do not depend on the direction of slip.
        let mode = |lane: usize, i: usize| match self.solved[lane].0[i] {
            _ if !rest(lane, i) => Mode::Open,
            Mode::Slides(_) => Mode::Closed,
            mode => mode,
        };
        let modes: W::EachContact<Mode> = Each::from_fn(|i| mode(0, i));
        let contacts = 0..self.wide.contacts().len();
        if !contacts.clone().all(|i| self.alike(|lane| (rest(lane, i), mode(lane, i)))) {
            return None;
        }
        let rounding = |lane: usize| {
            let (after, solved) = &self.solved[lane];
            self.steppers[lane].rounding_at_end(after.as_ref(), solved)
        };
        let rounding = self.number(rounding);
        let mut projection = Projection::<W>::new(self.wide, &mut self.memory[impulses::memory(W::ContactRows::DIM)..]);
        let (gaps, magnitude) = (self.wide.gaps(t, &q), motion::magnitude(&q));
        let (closed, impulses, rates) = (rests.as_ref(), &pushed.impulses, &state.rates);
        let touched = Touched { closed, impulses, rates, h };
        let closed = projection.close((t, q, gaps), (response, magnitude), &touched).ok()?;
        let rates = self.wide.contact_rates(t, &closed.q, &z);
        let at_end = (t, &closed.q, z, rates);
        let (z, rates) = projection.stop(at_end, response, (|i| modes[i], rounding));
        (!projection.lockstep.has_parted()).then_some((closed, z, rates))
    }

    /// Whether no lane is to make its step again for its speeds.
    fn agree_together(
        &self,
        h: f64,
        (state, middle): (&PackedState<W>, &Middle<W>),
        (acceleration, after): (&W::Speeds, &W::Speeds),
        input: &W::Input,
    ) -> bool {
        let of = |vectors: &W::Speeds, lane: usize| single::<W, _, K::Speeds>(vectors, lane);
        let used = |lane: usize| Used {
            h,
            least: self.steppers[lane].least(h),
            before: of(&state.z, lane),
            used: of(&middle.z, lane),
            acceleration: of(acceleration, lane),
            after: of(after, lane),
        };
        let mut all = (0..self.steppers.len()).map(used).enumerate();
        let is_plain = |(lane, used): (usize, Used<K::Speeds>)| {
            self.steppers[lane].last.may_stiffen(&used) == Some(false) && !used.is_rough()
        };
        if !all.clone().all(is_plain) {
            return false;
        }
        let mut apart = all.by_ref().filter(|(_, used)| !used.is_plain()).peekable();
        apart.peek().is_none() || {
            let mean = motion::mean(&state.z, after);
            let at_mean = self.wide.acceleration(middle.t, &middle.q, &mean, input);
            apart.all(|(lane, used)| !used.grows(&of(&at_mean, lane)))
        }
    }

    /// The end of a step to each lane, and in packs where all of them go on.
    fn take_together(
        &mut self,
        h: f64,
        (state, t): (&PackedState<W>, W::Scalar),
        (pushed, free): (&PushedLanes<W>, &W::Speeds),
        (closed, z, rates): (Closed<W>, W::Speeds, W::ContactRows),
    ) {
        let mut goes_on = true;
        for (lane, (after, solved)) in self.solved.drain(..).enumerate() {
            let stepper = &mut self.steppers[lane];
            stepper.next = after;
            let of_lane = Closed {
                q: closed.q.extract(lane),
                gaps: single::<W, _, K::Gaps>(&closed.gaps, lane),
                penetration: closed.penetration.lane(lane),
                closure: closed.closure.lane(lane),
                left: Each::from_fn(|_| false),
            };
            let (z, rates) = (single::<W, _, K::Speeds>(&z, lane), single::<W, _, K::ContactRows>(&rates, lane));
            let impulses = single::<W, _, K::ContactRows>(&pushed.impulses, lane);
            let of_lane_pushed = Pushed { z, impulses, dependent: pushed.dependent, solved };
            let end = stepper.end(of_lane_pushed, of_lane, (z, rates));
            let acceleration = single::<W, _, K::Speeds>(free, lane);
            self.outcomes[lane] = stepper.made(h, Attempt { end, acceleration });
            goes_on &= self.outcomes[lane].is_ok();
        }
        let (PushedLanes { impulses, .. }, Closed { q, gaps, .. }) = (pushed, closed);
        self.packed = goes_on.then(|| {
            let acceleration = z.add_scaled(-W::Scalar::one(), &state.z).scale(W::Scalar::from_f64(1.0 / h));
            PackedState { t, q, z, gaps, rates, impulses: *impulses, acceleration }
        });
    }
}
