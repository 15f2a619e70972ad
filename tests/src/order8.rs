//! The Dormand–Prince method of order 8 on the group, with step control for accuracy near rounding.

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::integrate::{
    Control, IntegrationError, IntegrationErrorKind, OneStep, Problem, Progress, Rates, Rkmk, RunPart, State,
    StepCallback, StepStatistics, Tableau,
};
use gauss_runtime::system::GaussSystem;

/// Steps of order 8 whose embedded estimate, of order 5, stays below a tolerance.
///
/// The estimate is of the order h⁶ and the error of the result of the order h⁹: with a tolerance δ the local error of
/// the result is near δ^(3/2), relative to the sizes that the estimate is measured by. So δ = 1e-10 asks for 1e-15.
#[derive(Clone, Copy, Debug)]
pub struct Order8 {
    method: Rkmk<f64, 12>,
    tolerance: f64,
    fixed: Option<f64>,
}

impl Order8 {
    /// Steps by tolerance.
    #[must_use]
    pub fn new(tolerance: f64) -> Self {
        Self { method: Rkmk::new(&Tableau::DORMAND_PRINCE_8), tolerance, fixed: None }
    }

    /// Steps of one length, which should divide the interval: to see the order.
    #[must_use]
    pub fn fixed(step: f64) -> Self {
        Self { fixed: Some(step), ..Self::new(1.0) }
    }
}

/// The largest ratio of an error to the size of what it is an error of. Positions and angles: the distance from the
/// origin (at least 1) and 1 rad. Variables: linear and angular ones apart, each against the largest of its three,
/// because a component that passes through zero is not to be known any better than its neighbours. Between linear and
/// angular ones lies at most 10⁶, beyond which one is rounding of the other.
fn ratio<S: GaussSystem<Scalar = f64>>(from: &State<S>, to: &State<S>, error: &Rates<S>) -> f64 {
    let mut worst = 0.0_f64;
    let mut see = |error: f64, size: f64| {
        if error != 0.0 {
            worst = worst.max(error.abs() / size);
        }
    };
    for i in 0..<S::Configuration as Configuration>::Tangent::DIM {
        see(error.configuration.component(i), from.q.magnitude(i).max(to.q.magnitude(i)).max(1.0));
    }
    let all = from.y.max_norm().max(to.y.max_norm());
    for block in 0..S::Speeds::DIM.div_ceil(3) {
        let components = 3 * block..S::Speeds::DIM.min(3 * block + 3);
        let size = components
            .clone()
            .fold(1e-6 * all, |size, i| size.max(from.y.component(i).abs()).max(to.y.component(i).abs()));
        components.for_each(|i| see(error.variables.component(i), size));
    }
    worst
}

/// As the controls of the runtime do: the end of every step goes onto the constraints.
fn projected<S, P>(problem: &P, state: State<S>) -> Result<State<S>, IntegrationErrorKind>
where
    S: GaussSystem<Scalar = f64>,
    P: Problem<System = S>,
{
    if !S::CONSTRAINED {
        return Ok(state);
    }
    let speeds = problem.speeds(state.t, &state.q, &state.y);
    let projected = problem.system().project(state.t, &state.q, &speeds);
    let (q, z) = projected.map_err(|error| IntegrationErrorKind::Projection { error })?;
    Ok(problem.state(state.t, q, &z))
}

impl<S: GaussSystem<Scalar = f64>> Control<S> for Order8 {
    /// The length of the next step, the steps so far, and the most of them.
    type StepMemory = (f64, u64, u64);

    fn start<P: Problem<System = S>>(
        &self,
        problem: &P,
        state: State<S>,
        end: f64,
        limit: u64,
        emit: &mut StepCallback<'_, S>,
    ) -> Result<Progress<S, Self::StepMemory>, IntegrationError> {
        let rates = problem.rates(&state);
        if !rates.is_finite() {
            let kind = IntegrationErrorKind::NonFinite { part: RunPart::Derivative };
            return Err(IntegrationError::at(problem, &state, kind));
        }
        // A first step far too short costs a few steps: it grows tenfold each time.
        let turn = S::Configuration::increment_angle(&rates.configuration);
        let length = self.fixed.unwrap_or(1e-3 / turn.max(1.0));
        Ok(Progress::new((state, rates), end, (length, 0, limit), emit))
    }

    fn advance<P: Problem<System = S>>(
        &self,
        problem: &P,
        run: &mut Progress<S, Self::StepMemory>,
        emit: &mut StepCallback<'_, S>,
    ) -> Result<(), IntegrationError> {
        let stopped = |state: &State<S>, kind| IntegrationError::at(problem, state, kind);
        let Progress { state, rates, end, ended, memory: (length, steps, limit) } = run;
        while *steps < *limit {
            *steps += 1;
            let left = *end - state.t;
            let last = *length >= 0.999 * left;
            let h = if last { left } else { *length };
            if state.t + h == state.t {
                return Err(stopped(state, IntegrationErrorKind::StepTooSmall { step: h }));
            }
            let (step, error) = match self.method.step(problem, state, rates, h) {
                Ok(step) => {
                    let error = ratio(state, &step.state, &step.error) / self.tolerance;
                    (step, error)
                }
                Err(kind) if self.fixed.is_some() => return Err(stopped(state, kind)),
                Err(kind) => {
                    *length = 0.25 * h;
                    if state.t + *length == state.t {
                        return Err(stopped(state, kind));
                    }
                    continue;
                }
            };
            if self.fixed.is_none() {
                *length = h * (0.9 * error.powf(-1.0 / 6.0)).clamp(0.2, 10.0);
                if error > 1.0 {
                    continue;
                }
            }
            let mut next = step.state;
            if last {
                next.t = *end;
            }
            next = projected(problem, next).map_err(|kind| stopped(state, kind))?;
            let slopes = problem.rates(&next);
            if !slopes.is_finite() {
                return Err(stopped(state, IntegrationErrorKind::NonFinite { part: RunPart::Step }));
            }
            (*state, *rates, *ended) = (next, slopes, last);
            if emit(state, rates, StepStatistics::default()).is_break() || last {
                return Ok(());
            }
        }
        Err(stopped(state, IntegrationErrorKind::TooManySteps { limit: *limit }))
    }
}
