//! The steps of a run, as its values choose them: derivatives are those of these very steps, with their lengths held.

use gauss_runtime::integrate::drive::control::prepare;
use gauss_runtime::integrate::{IntegrationError, Sample, State, SystemProblem};
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
        let first = equations(run, numbers, &system);
        let crossing = run.until(numbers, &first.input.at(state.t, &state.q, &state.y)).map(|(crossing, _)| crossing);
        let jumps = run.jump(numbers, &first.input.at(state.t, &state.q, &state.y)).is_some();
        let jumping = (crossing.is_some() && jumps).then(|| run.goes_through());
        let mut mesh = Self { times: vec![state.t], reached: vec![0], ended: false, jumps: Vec::new() };
        let mut length = None;
        for (number, &end) in instants.iter().enumerate().skip(1) {
            let fed = || Fed { number: number - 1, run, numbers, system: &system };
            let (problem, function) = (SystemProblem::new(&system).input_from(fed()), fed());
            let steps = &steps.after(length);
            let event = crossing.map(|crossing| (crossing, move |t: f64, q: &_, z: &_| function.until(t, q, z)));
            let jump = |sample: &mut Sample<R::System<f64>>| {
                if let Some((q, z)) = run.jump(numbers, &fed().at(sample.t, &sample.q, &sample.z)) {
                    (sample.q, sample.z) = (q, z);
                }
            };
            let first = mesh.times.len();
            let (times, jumps) = (&mut mesh.times, &mut mesh.jumps);
            let each = &mut |t: f64, jumped: bool| {
                if times.last() != Some(&t) {
                    times.push(t);
                }
                if jumped {
                    jumps.push(times.len() - 2);
                }
            };
            let jump = jumping.map(|through| (jump, through));
            (state, mesh.ended) = steps.drive(problem, state, end, (event, jump), each)?;
            if mesh.ended && mesh.times.len() == first {
                return Err(SensitivityError::NoDerivative { time: state.t, rate: f64::NAN });
            }
            if mesh.ended {
                break;
            }
            mesh.reached.push(mesh.steps());
            // The last one was shortened.
            let lengths = mesh.times[first - 1..].windows(2).map(|pair| (pair[1] - pair[0]).abs());
            length = Some(lengths.fold(0.0, f64::max));
        }
        Ok(mesh)
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
        size_of_val(&self.times[..]) + size_of_val(&self.reached[..]) + size_of_val(&self.jumps[..])
    }
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
