//! The steps of a run, as its values choose them: derivatives are those of these very steps, with their lengths held.

use gauss_runtime::integrate::drive::control::prepare;
use gauss_runtime::integrate::{IntegrationError, IntegrationErrorKind, Sample, SamplingMistake, State, SystemProblem};
use gauss_runtime::real::Real;

use crate::error::SensitivityError;
use crate::run::{Equations, Fed, Run, equations};
use crate::steps::Steps;

/// When each step of a run ends.
pub(crate) struct Mesh {
    /// The start, then the end of each step.
    pub(crate) times: Vec<f64>,
    /// Number of steps that are made at each instant that is reached.
    reached: Vec<usize>,
    /// Whether an event ended the run.
    pub(crate) ended: bool,
    /// The steps, from 0, at whose ends the state jumps at an event.
    jumps: Vec<usize>,
    /// The steps, from 0, at whose starts a controller samples.
    samples: Vec<usize>,
}

impl Mesh {
    /// The steps of a run at these numbers.
    pub(crate) fn of<R: Run<P>, C: Steps, const P: usize>(
        run: &R,
        steps: &C,
        numbers: &[f64; P],
    ) -> Result<Self, SensitivityError> {
        let instants = run.instants();
        check(instants)?;
        let system = run.system(numbers)?;
        let (q, z) = run.start(numbers, &system);
        let mut state = State { t: instants[0], q, y: z };
        let problem = equations(run, numbers, &system);
        let at_start = problem.input.at(state.t, &state.q, &state.y);
        let crossing = run.until(numbers, &at_start).map(|(crossing, _)| crossing);
        let jumping = crossing.and_then(|_| run.jump(numbers, &at_start)).map(|_| run.goes_through());
        let sampling = Sampling::of(run.period(), instants);
        let mut sampling = sampling.map_err(|kind| IntegrationError::at(&problem, &state, kind))?;
        let (times, reached) = (vec![state.t], vec![0]);
        let mut mesh = Self { times, reached, ended: false, jumps: Vec::new(), samples: Vec::new() };
        let (mut length, mut input) = (None, problem.input);
        while let Some(&instant) = instants.get(mesh.reached.len()) {
            input.number = mesh.reached.len() - 1;
            if sampling.is_now(state.t) {
                input.sample(&state);
                mesh.samples.push(mesh.steps());
            }
            let end = sampling.before(instant);
            let (problem, function) = (SystemProblem::new(&system).input_from(input), input);
            let event = crossing.map(|crossing| (crossing, move |t: f64, q: &_, z: &_| function.until(t, q, z)));
            let jump = |sample: &mut Sample<R::System<f64>>| {
                if let Some((q, z)) = run.jump(numbers, &input.at(sample.t, &sample.q, &sample.z)) {
                    (sample.q, sample.z) = (q, z);
                }
            };
            let jump = jumping.map(|through| (jump, through));
            let first = mesh.times.len();
            let each = &mut |t: f64, jumped: bool| mesh.see(t, jumped);
            let (next, ended) = steps.after(length).drive(problem, state, end, (event, jump), each)?;
            (state, mesh.ended) = (next, ended);
            if mesh.ended && mesh.times.len() == first {
                return Err(SensitivityError::NoDerivative { time: state.t, rate: f64::NAN });
            }
            if mesh.ended {
                break;
            }
            if end == instant {
                mesh.reached.push(mesh.steps());
            }
            // The last one was shortened.
            let lengths = mesh.times[first - 1..].windows(2).map(|pair| (pair[1] - pair[0]).abs());
            length = Some(lengths.fold(0.0, f64::max));
        }
        Ok(mesh)
    }

    /// The end of a step.
    fn see(&mut self, t: f64, jumped: bool) {
        if self.times.last() != Some(&t) {
            self.times.push(t);
        }
        if jumped {
            self.jumps.push(self.times.len() - 2);
        }
    }

    /// Number of the steps.
    pub(crate) fn steps(&self) -> usize {
        self.times.len() - 1
    }

    /// Whether a step ends at an event.
    pub(crate) fn is_event(&self, step: usize) -> bool {
        self.ended && step + 1 == self.steps() || self.jumps_after(step)
    }

    /// Whether the state jumps at the end of a step.
    pub(crate) fn jumps_after(&self, step: usize) -> bool {
        self.jumps.binary_search(&step).is_ok()
    }

    /// Whether the time at which a step starts is that of an event.
    pub(crate) fn starts_at_event(&self, step: usize) -> bool {
        step.checked_sub(1).is_some_and(|before| self.jumps_after(before))
    }

    /// Whether a controller samples the state at which a step starts.
    pub(crate) fn samples_before(&self, step: usize) -> bool {
        self.samples.binary_search(&step).is_ok()
    }

    /// The interval between instants that a step is in.
    pub(crate) fn interval(&self, step: usize) -> usize {
        self.reached.partition_point(|&made| made <= step) - 1
    }

    /// Which instant there is after so many steps, and whether an event ended the run there.
    pub(crate) fn instant(&self, made: usize) -> Option<(usize, bool)> {
        match self.reached.binary_search(&made) {
            Ok(number) => Some((number, false)),
            Err(_) if self.ended && made == self.steps() => Some((self.reached.len(), true)),
            Err(_) => None,
        }
    }

    /// Number of instants that are reached, the end by an event among them.
    pub(crate) fn instants(&self) -> usize {
        self.reached.len() + usize::from(self.ended)
    }

    /// Its bytes.
    pub(crate) fn bytes(&self) -> usize {
        let of_steps = [&self.reached, &self.jumps, &self.samples].map(|steps| size_of_val(&steps[..]));
        size_of_val(&self.times[..]) + of_steps.iter().sum::<usize>()
    }
}

/// When a controller samples: at multiples of its period from the start on, as in a simulation.
struct Sampling {
    period: Option<f64>,
    start: f64,
    count: u64,
}

impl Sampling {
    fn of(period: Option<f64>, instants: &[f64]) -> Result<Self, IntegrationErrorKind> {
        let [start, end] = [instants[0], instants[instants.len() - 1]];
        let refuse = |mistake| Err(IntegrationErrorKind::Sampling { controller: 0, mistake });
        match period {
            Some(_) if end < start => refuse(SamplingMistake::Backward),
            // So that no two samples are one.
            Some(period) if !(period > 2.0 * roundings(start, end) && period.is_finite()) => {
                refuse(SamplingMistake::Period(period))
            }
            period => Ok(Self { period, start, count: 0 }),
        }
    }

    /// The time of the next sample.
    fn next(&self) -> Option<f64> {
        self.period.map(|period| (self.count as f64).mul_add(period, self.start))
    }

    /// Whether a controller samples at a time, once: an instant that is a sample on paper is apart by roundings.
    fn is_now(&mut self, t: f64) -> bool {
        let is_now = self.next().is_some_and(|next| next - t <= roundings(self.start, t));
        self.count += u64::from(is_now);
        is_now
    }

    /// The end of what is driven at once: an instant, or a sample before it.
    fn before(&self, instant: f64) -> f64 {
        self.next().filter(|&next| instant - next > roundings(self.start, instant)).unwrap_or(instant)
    }
}

/// Some roundings of times.
fn roundings(start: f64, t: f64) -> f64 {
    8.0 * f64::EPSILON * t.abs().max(start.abs())
}

/// The initial state of a run in any scalar, on the constraints.
pub(crate) fn initial<R: Run<P>, T: Real, const P: usize>(
    problem: &Equations<'_, R, T, P>,
    mesh: &Mesh,
) -> Result<State<R::System<T>>, IntegrationError> {
    let Fed { run, numbers, system, .. } = problem.input;
    let (q, z) = run.start(numbers, system);
    let [t, end] = [mesh.times[0], mesh.times[mesh.steps()]].map(T::from_f64);
    let state = State { t, q, y: z };
    let (_, state, _) = prepare(problem, &state, end).map_err(|kind| IntegrationError::at(problem, &state, kind))?;
    Ok(state)
}

/// Refuses instants that are no times of a run.
fn check(instants: &[f64]) -> Result<(), SensitivityError> {
    let refused = |number| Err(SensitivityError::Instants { number });
    if let Some(number) = instants.iter().position(|t| !t.is_finite()) {
        return refused(number);
    }
    let &[first, second, ..] = instants else { return refused(instants.len()) };
    let forward = second > first;
    let wrong = |pair: &[f64]| if forward { pair[1] <= pair[0] } else { pair[1] >= pair[0] };
    instants.windows(2).position(wrong).map_or(Ok(()), |number| refused(number + 1))
}
