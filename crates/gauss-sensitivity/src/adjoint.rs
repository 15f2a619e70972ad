//! The derivatives of a cost by any number of numbers: back through a run, step by step.
//!
//! A sweep back through one step (on its [tape](crate::tape)) takes what the cost changes with its end to what it
//! changes with its start, and adds what it changes with the numbers: vᵀ∂(step). The system, as a function of the
//! numbers, is on the tape once for all steps. States on the way back are made again from those that are kept
//! ([`checkpoints`](crate::checkpoints)).

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::integrate::{IntegrationError, Problem, State};

use crate::checkpoints::reverse;
use crate::error::SensitivityError;
use crate::forward::{advance, after_step, check_rate, enter};
use crate::mesh::{Mesh, initial};
use crate::run::{At, Cost, Equations, Fed, InputOf, Run, equations};
use crate::states::{ComponentsOf, StateWithInput, by_increments, in_numbers, numbers_of, recast};
use crate::steps::Steps;
use crate::tape::{Adjoints, Recording, Taped};

/// Work and memory that a gradient took.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Effort {
    /// Steps of the run.
    pub steps: usize,
    /// Steps that were made once more, to have the states on the way back.
    pub repeated: usize,
    /// The most states that were kept at a time.
    pub states: usize,
    /// The most bytes of the tape, of states and of the times of steps together.
    pub bytes: usize,
}

/// A cost with its derivatives.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Gradient<const P: usize> {
    /// The cost.
    pub value: f64,
    /// Its derivatives by the numbers.
    pub by_numbers: [f64; P],
    /// Its derivatives by the initial configuration, with the numbers held: by an increment σ, `q ∘ exp(σ)`, seen from
    /// the body.
    pub by_q: Vec<f64>,
    /// Its derivatives by the initial quasi-velocities, with the numbers held.
    pub by_z: Vec<f64>,
    /// Work and memory that it took.
    pub effort: Effort,
}

/// The way back.
struct Back<'a, R: Run<P>, C, const P: usize> {
    steps: &'a C,
    mesh: &'a Mesh,
    recording: &'a Recording,
    problem: Equations<'a, R, Taped, P>,
    /// The nodes of the numbers, the system and the initial state: they stay.
    kept: usize,
    adjoints: Adjoints,
    /// Derivatives of the cost by the components of q and by z where the way back has come to.
    by_state: Vec<f64>,
    /// Its derivatives by the input that is held there.
    by_input: Vec<f64>,
    /// Its derivative by the time there, where that is the time of an event.
    by_time: f64,
    /// Contribution of each instant to the cost.
    costs: Vec<f64>,
}

/// One step on the tape.
struct Taking {
    start: Vec<Taped>,
    /// The time at which it starts.
    from: Taped,
    /// Its end, after the jump where there is one.
    end: Vec<Taped>,
    to: Taped,
    h: Taped,
    /// The input that is held, at the start and at the end: the start has none where it is sampled there.
    held: [Vec<Taped>; 2],
    cost: Taped,
    /// The function that ends the run, with its value at the start of the step.
    event: Option<(Taped, f64)>,
}

impl<R: Cost<P>, C: Steps, const P: usize> Back<'_, R, C, P> {
    fn cost(&mut self, made: usize, state: &State<R::System<Taped>>) -> Taped {
        let Some((number, ended)) = self.mesh.instant(made) else { return Taped::constant(0.0) };
        let Fed { run, numbers, system, .. } = self.problem.input;
        let cost = run.cost(numbers, &At { number, ended, system, t: state.t, q: &state.q, z: &state.y });
        self.costs[number] = cost.value();
        cost
    }

    /// Writes a step down.
    fn take(&mut self, held: &StateWithInput<R::System<f64>>, n: usize) -> Result<Taking, SensitivityError> {
        let (recording, [from, to]) = (self.recording, [self.mesh.times[n], self.mesh.times[n + 1]]);
        let ends = self.mesh.is_event(n);
        recording.truncate(self.kept);
        let moves = self.mesh.starts_at_event(n);
        let from = if moves { recording.variable(from) } else { Taped::constant(from) };
        let start: State<R::System<Taped>> = in_numbers(&held.state, from, |number| recording.variable(number));
        self.problem.input.held = held.input.map(|input| recast(&input, &mut |number| recording.variable(number)));
        let before = self.held().filter(|_| !self.mesh.samples_before(n));
        enter(&mut self.problem, self.mesh, n, &start);
        let held = [before, self.held()].map(Option::unwrap_or_default);
        let h = match (ends, moves) {
            (true, _) => recording.variable(to - from.value()),
            (false, true) => Taped::constant(to) - from,
            (false, false) => Taped::constant(to - from.value()),
        };
        let end = self.steps.step(&self.problem, &start, &self.problem.rates(&start), h);
        let mut end = end.map_err(|kind| IntegrationError::at(&self.problem, &start, kind))?;
        // As a number of its own where the end does not move.
        end.t = if ends { start.t + h } else { Taped::constant(to) };
        let function = |state: &State<R::System<Taped>>| self.problem.input.until(state.t, &state.q, &state.y);
        let event = ends.then(|| (function(&end), function(&start).value()));
        end = after_step(&self.problem, self.mesh, (n, end))?;
        let cost = self.cost(n + 1, &end);
        let (to, start, end) = (end.t, numbers_of(&start).collect(), numbers_of(&end).collect());
        Ok(Taking { start, from, end, to, h, held, cost, event })
    }

    /// The numbers of the input that is held.
    fn held(&self) -> Option<Vec<Taped>> {
        let input = self.problem.input.held?;
        Some((0..InputOf::<R::System<Taped>>::DIM).map(|i| input.component(i)).collect())
    }

    /// From the end of a step to its start.
    fn back(&mut self, start: &StateWithInput<R::System<f64>>, n: usize) -> Result<(), SensitivityError> {
        let step = self.take(start, n)?;
        let [held, kept] = &step.held;
        let mut seeds = vec![(step.cost, 1.0)];
        seeds.extend(step.end.iter().copied().zip(self.by_state.iter().copied()));
        seeds.extend(kept.iter().copied().zip(self.by_input.iter().copied()));
        seeds.push((step.to, self.by_time));
        if let Some((function, before)) = step.event {
            // The end moves by −∂w/w′ when the function w changes by ∂w.
            let by_length = |seeds: &[(Taped, f64)]| {
                let mut trial = Adjoints::default();
                seeds.iter().for_each(|&(number, seed)| trial.add(number, seed));
                trial.sweep(self.recording, self.kept..self.recording.len());
                trial.of(step.h)
            };
            let [from, to] = [self.mesh.times[n], self.mesh.times[n + 1]];
            let rate = by_length(&[(function, 1.0)]);
            check_rate(to, rate, (function.value() - before) / (to - from))?;
            seeds.push((function, -by_length(&seeds) / rate));
        }
        seeds.iter().for_each(|&(number, seed)| self.adjoints.add(number, seed));
        self.adjoints.sweep(self.recording, self.kept..self.recording.len());
        self.by_state = step.start.iter().map(|&number| self.adjoints.of(number)).collect();
        self.by_input = held.iter().map(|&number| self.adjoints.of(number)).collect();
        self.by_time = if self.mesh.starts_at_event(n) { self.adjoints.of(step.from) } else { 0.0 };
        self.adjoints.truncate(self.kept);
        let finite = self.by_state.iter().all(|by| by.is_finite()) && step.cost.value().is_finite();
        if finite { Ok(()) } else { Err(SensitivityError::NonFinite { time: self.mesh.times[n] }) }
    }
}

/// The number of states that are kept where nothing is said: the root of the number of steps.
fn usual_room(steps: usize) -> usize {
    steps.isqrt().max(8)
}

/// The cost of a run and its derivatives.
pub(crate) fn gradient<R: Cost<P>, C: Steps, const P: usize>(
    run: &R,
    steps: &C,
    numbers: &[f64; P],
    room: Option<usize>,
) -> Result<Gradient<P>, SensitivityError> {
    let mesh = &Mesh::of(run, steps, numbers)?;
    let plain = run.system(numbers)?;
    let start = initial(&equations(run, numbers, &plain), mesh)?;

    let recording = &Recording::start().ok_or(SensitivityError::Nested)?;
    let variables = &numbers.map(|number| recording.variable(number));
    let system = run.system(variables)?;
    let problem = equations(run, variables, &system);
    let given: Vec<Taped> = numbers_of(&initial(&problem, mesh)?).collect();
    let before = recording.len();
    // Variables of their own, so that the derivatives by the initial state are known as well.
    let taped = in_numbers(&start, Taped::constant(start.t), |number| recording.variable(number));
    let first: Vec<Taped> = numbers_of(&taped).collect();
    let by_state = vec![0.0; first.len()];
    let costs = vec![0.0; mesh.instants()];
    let adjoints = Adjoints::default();
    let (by_input, by_time) = (Vec::new(), 0.0);
    let mut way = Back { steps, mesh, recording, problem, kept: 0, adjoints, by_state, by_input, by_time, costs };
    let at_start = way.cost(0, &taped);
    way.kept = recording.len();
    way.adjoints.add(at_start, 1.0);

    let room = room.unwrap_or_else(|| usual_room(mesh.steps()));
    let forward = |held, from, to| advance((run, steps, mesh), (&plain, numbers), held, from..to);
    let first_held = StateWithInput { state: start, input: None };
    let (repeated, states) = reverse(first_held, mesh.steps(), room, forward, |held, n| way.back(&held, n))?;

    recording.truncate(way.kept);
    first.iter().zip(&way.by_state).for_each(|(&number, &by)| way.adjoints.add(number, by));
    way.adjoints.sweep(recording, before..way.kept);
    let by_first: Vec<f64> = first.iter().map(|&number| way.adjoints.of(number)).collect();
    given.iter().zip(&by_first).for_each(|(&number, &by)| way.adjoints.add(number, by));
    way.adjoints.sweep(recording, 0..before);
    let by_numbers = variables.map(|number| way.adjoints.of(number));

    let value = way.costs.iter().sum::<f64>();
    let finite = value.is_finite() && by_numbers.iter().chain(&by_first).all(|by| by.is_finite());
    if !finite {
        return Err(SensitivityError::NonFinite { time: mesh.times[0] });
    }
    let (by_components, by_z) = by_first.split_at(ComponentsOf::<R::System<f64>>::DIM);
    let by_q = by_increments::<R::System<f64>>(&start.q, by_components);
    let bytes = recording.most_bytes() + states * size_of::<StateWithInput<R::System<f64>>>() + mesh.bytes();
    let effort = Effort { steps: mesh.steps(), repeated, states, bytes };
    Ok(Gradient { value, by_numbers, by_q, by_z: by_z.to_vec(), effort })
}
