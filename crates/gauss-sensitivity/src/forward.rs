//! Derivatives along a run: the run once more, in dual numbers, with the steps that its values have chosen.

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::dual::Dual;
use gauss_runtime::integrate::{IntegrationError, Problem, State};
use gauss_runtime::real::Real;
use gauss_runtime::system::GaussSystem;

use crate::error::SensitivityError;
use crate::mesh::{Mesh, initial};
use crate::run::{At, Equations, Residuals, Run, equations};
use crate::states::{ComponentsOf, StateWithInput, TangentOf, in_numbers, increment, numbers_of, recast};
use crate::steps::Steps;

/// Directions that are followed at once: kernels in more of them take long to compile.
const TOGETHER: usize = 4;
/// A run in them.
type Number = Dual<TOGETHER>;

/// A state of a run with its derivatives by P numbers.
#[non_exhaustive]
pub struct Point<S: GaussSystem<Scalar = f64>, const P: usize> {
    /// Time.
    pub t: f64,
    /// Configuration.
    pub q: S::Configuration,
    /// Quasi-velocities.
    pub z: S::Speeds,
    /// Whether the run was ended by its event here.
    pub ended: bool,
    /// ∂σ/∂numbers, a row for each component of σ: the configuration moves by `q ∘ exp(σ)`, seen from the body
    /// ([`Configuration::Tangent`](gauss_runtime::configuration::Configuration::Tangent)).
    pub q_slopes: Vec<[f64; P]>,
    /// ∂z/∂numbers, a row for each component of z.
    pub z_slopes: Vec<[f64; P]>,
    /// ∂t/∂numbers: zero but where the run was ended by its event. Derivatives of q and z are those of the state at
    /// that time, wherever it moves to.
    pub t_slopes: [f64; P],
}

/// Goes along the steps of a run in any scalar, and shows the states at all instants.
fn walk<R: Run<P>, C: Steps, T: Real, const P: usize>(
    (run, steps, mesh): (&R, &C, &Mesh),
    numbers: &[T; P],
    rates: &[f64],
    mut see: impl FnMut(&At<'_, R::System<T>>),
) -> Result<(), SensitivityError> {
    let system = run.system(numbers)?;
    let mut problem = equations(run, numbers, &system);
    let mut state = initial(&problem, mesh)?;
    let mut show = |made: usize, state: &State<R::System<T>>| {
        if let Some((number, ended)) = mesh.instant(made) {
            see(&At { number, ended, system: &system, t: state.t, q: &state.q, z: &state.y });
        }
    };
    show(0, &state);
    let mut rates_of_events = rates.iter().copied();
    for (n, pair) in mesh.times.windows(2).enumerate() {
        enter(&mut problem, mesh, n, &state);
        let rates = problem.rates(&state);
        let step = |h: T| {
            let end = steps.step(&problem, &state, &rates, h);
            end.map_err(|kind| IntegrationError::at(&problem, &state, kind))
        };
        // The time of an event at which the step starts has derivatives.
        let early = state.t - T::from_f64(pair[0]);
        let h = T::from_f64(pair[1] - pair[0]) - early;
        let mut end = step(h)?;
        end.t = T::from_f64(pair[1]);
        if T::DERIVATIVES && mesh.is_event(n) {
            let function = problem.input.until(end.t, &end.q, &end.y);
            let rate = rates_of_events.next().unwrap_or(f64::NAN);
            let later = -(function - T::from_f64(function.lane(0))) / T::from_f64(rate);
            let t = end.t + later;
            end = step(h + later)?;
            end.t = t;
        }
        state = after_step(&problem, mesh, (n, end))?;
        show(n + 1, &state);
    }
    Ok(())
}

/// The input of a step: that of its interval, and what is sampled at its start.
pub(crate) fn enter<R: Run<P>, T: Real, const P: usize>(
    problem: &mut Equations<'_, R, T, P>,
    mesh: &Mesh,
    n: usize,
    start: &State<R::System<T>>,
) {
    problem.input.number = mesh.interval(n);
    if mesh.samples_before(n) {
        problem.input.sample(start);
    }
}

/// The end of a step, after the jump where its event has one.
pub(crate) fn after_step<R: Run<P>, T: Real, const P: usize>(
    problem: &Equations<'_, R, T, P>,
    mesh: &Mesh,
    (n, end): (usize, State<R::System<T>>),
) -> Result<State<R::System<T>>, IntegrationError> {
    if !mesh.jumps_after(n) {
        return Ok(end);
    }
    problem.input.jumped(&end).map_err(|kind| IntegrationError::at(problem, &end, kind))
}

/// The rates at which the function of an event passes through zero, by the length of each step that ends at one.
fn rates_of_events<R: Run<P>, C: Steps, const P: usize>(
    (run, steps, mesh): (&R, &C, &Mesh),
    numbers: &[f64; P],
) -> Result<Vec<f64>, SensitivityError> {
    let plain = run.system(numbers)?;
    let state = initial(&equations(run, numbers, &plain), mesh)?;
    let mut held = StateWithInput { state, input: None };
    let constants = &numbers.map(Number::constant);
    let system = run.system(constants)?;
    let mut problem = equations(run, constants, &system);
    let (mut made, mut rates) = (0, Vec::new());
    for n in (0..mesh.steps()).filter(|&n| mesh.is_event(n)) {
        held = advance((run, steps, mesh), (&plain, numbers), held, made..n)?;
        made = n;
        let (from, to) = (mesh.times[n], mesh.times[n + 1]);
        let start: State<R::System<Number>> = in_numbers(&held.state, Number::constant(from), Number::constant);
        problem.input.held = held.input.map(|input| recast(&input, &mut Number::constant));
        enter(&mut problem, mesh, n, &start);
        let h = Number::variable(to - from, 0);
        let end = steps.step(&problem, &start, &problem.rates(&start), h);
        let end = end.map_err(|kind| IntegrationError::at(&problem, &start, kind))?;
        let before = problem.input.until(start.t, &start.q, &start.y).value;
        let after = problem.input.until(start.t + h, &end.q, &end.y);
        check_rate(to, after.slopes[0], (after.value - before) / (to - from))?;
        rates.push(after.slopes[0]);
    }
    Ok(rates)
}

/// Refuses an event whose function passes through zero so much slower than it changes over the last step that it
/// rather touches zero, or jumps over it: then its time has no derivative, or one without digits.
pub(crate) fn check_rate(time: f64, rate: f64, mean: f64) -> Result<(), SensitivityError> {
    const TOUCHES: f64 = 1e-6;
    let passes = rate.is_finite() && mean.is_finite() && rate.abs() > TOUCHES * mean.abs();
    if passes { Ok(()) } else { Err(SensitivityError::NoDerivative { time, rate }) }
}

/// The steps of a run from one number to another, in plain numbers.
pub(crate) fn advance<R: Run<P>, C: Steps, const P: usize>(
    (run, steps, mesh): (&R, &C, &Mesh),
    (system, numbers): (&R::System<f64>, &[f64; P]),
    StateWithInput { mut state, input }: StateWithInput<R::System<f64>>,
    which: std::ops::Range<usize>,
) -> Result<StateWithInput<R::System<f64>>, SensitivityError> {
    let mut problem = equations(run, numbers, system);
    problem.input.held = input;
    for n in which {
        enter(&mut problem, mesh, n, &state);
        let h = mesh.times[n + 1] - mesh.times[n];
        let end = steps.step(&problem, &state, &problem.rates(&state), h);
        state = end.map_err(|kind| IntegrationError::at(&problem, &state, kind))?;
        state.t = mesh.times[n + 1];
        state = after_step(&problem, mesh, (n, state))?;
    }
    Ok(StateWithInput { state, input: problem.input.held })
}

/// Goes along a run as often as all directions need: `see` gets the number of the first direction with each state.
fn in_all_directions<R: Run<P>, C: Steps, const P: usize>(
    run: &R,
    steps: &C,
    numbers: &[f64; P],
    mut see: impl FnMut(usize, &[Number; P], &At<'_, R::System<Number>>),
) -> Result<(), SensitivityError> {
    let mesh = Mesh::of(run, steps, numbers)?;
    let rates = &rates_of_events((run, steps, &mesh), numbers)?;
    // Once also where there are no numbers.
    for first in (0..P.max(1)).step_by(TOGETHER) {
        let numbers = &std::array::from_fn(|k| match k.checked_sub(first) {
            Some(direction) if direction < TOGETHER => Number::variable(numbers[k], direction),
            _ => Number::constant(numbers[k]),
        });
        walk((run, steps, &mesh), numbers, rates, |at| see(first, numbers, at))?;
    }
    Ok(())
}

/// The slopes of a number in one pack of directions, put where they belong.
fn put<const P: usize>(row: &mut [f64; P], first: usize, number: Number) {
    for (slope, found) in row[first..].iter_mut().zip(number.slopes) {
        *slope = found;
    }
}

/// The states of a run at all instants that it reaches, with their derivatives.
pub(crate) fn follow<R: Run<P>, C: Steps, const P: usize>(
    run: &R,
    steps: &C,
    numbers: &[f64; P],
) -> Result<Vec<Point<R::System<f64>, P>>, SensitivityError> {
    let mut points: Vec<Point<R::System<f64>, P>> = Vec::new();
    in_all_directions(run, steps, numbers, |first, _, at| {
        let state = State::<R::System<Number>> { t: at.t, q: *at.q, y: *at.z };
        if first == 0 {
            let State { t, q, y }: State<R::System<f64>> = in_numbers(&state, at.t.value, |number| number.value);
            let [of_q, of_z] = [TangentOf::<R::System<f64>>::DIM, <R::System<f64> as GaussSystem>::DOF];
            let zeros = |rows| vec![[0.0; P]; rows];
            let (q_slopes, z_slopes, t_slopes) = (zeros(of_q), zeros(of_z), [0.0; P]);
            points.push(Point { t, q, z: y, ended: at.ended, q_slopes, z_slopes, t_slopes });
        }
        let point = &mut points[at.number];
        put(&mut point.t_slopes, first, at.t);
        let all: Vec<Number> = numbers_of(&state).collect();
        let (of_q, of_z) = all.split_at(ComponentsOf::<R::System<f64>>::DIM);
        for (row, &number) in point.z_slopes.iter_mut().zip(of_z) {
            put(row, first, number);
        }
        for (k, direction) in (first..P).zip(0..TOGETHER) {
            let change: Vec<f64> = of_q.iter().map(|number| number.slopes[direction]).collect();
            let moved = increment::<R::System<f64>>(&point.q, &change);
            for (i, row) in point.q_slopes.iter_mut().enumerate() {
                row[k] = moved.component(i);
            }
        }
    })?;
    for (n, point) in points.iter().enumerate() {
        let rows = [&[point.t_slopes][..], &point.q_slopes, &point.z_slopes].concat();
        if !rows.iter().flatten().all(|slope| slope.is_finite()) {
            return Err(SensitivityError::NonFinite { time: points[n.saturating_sub(1)].t });
        }
    }
    Ok(points)
}

/// The residuals of an instant, and their derivatives: a row for each.
pub(crate) type Rows<const P: usize, const R: usize> = ([f64; R], [[f64; P]; R]);

/// The residuals of a run at all instants that it reaches, with their derivatives.
pub(crate) fn residuals<M: Residuals<P, R>, C: Steps, const P: usize, const R: usize>(
    run: &M,
    steps: &C,
    numbers: &[f64; P],
) -> Result<Vec<Rows<P, R>>, SensitivityError> {
    let mut rows: Vec<(f64, Rows<P, R>)> = Vec::new();
    in_all_directions(run, steps, numbers, |first, numbers, at| {
        let found = run.residuals(numbers, at);
        if first == 0 {
            rows.push((at.t.value, (found.map(|number| number.value), [[0.0; P]; R])));
        }
        let (_, (_, slopes)) = &mut rows[at.number];
        slopes.iter_mut().zip(found).for_each(|(row, number)| put(row, first, number));
    })?;
    for (n, (_, (values, slopes))) in rows.iter().enumerate() {
        if !values.iter().chain(slopes.iter().flatten()).all(|number| number.is_finite()) {
            return Err(SensitivityError::NonFinite { time: rows[n.saturating_sub(1)].0 });
        }
    }
    Ok(rows.into_iter().map(|(_, rows)| rows).collect())
}

/// The sum of the squares of all residuals.
pub(crate) fn misfit<M: Residuals<P, R>, C: Steps, const P: usize, const R: usize>(
    run: &M,
    steps: &C,
    numbers: &[f64; P],
) -> Result<f64, SensitivityError> {
    let mesh = Mesh::of(run, steps, numbers)?;
    let mut sum = 0.0;
    walk((run, steps, &mesh), numbers, &[], |at| {
        sum += run.residuals(numbers, at).iter().map(|residual| residual * residual).sum::<f64>();
    })?;
    if sum.is_finite() { Ok(sum) } else { Err(SensitivityError::NonFinite { time: mesh.times[0] }) }
}
