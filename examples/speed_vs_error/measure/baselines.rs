//! What a user would otherwise do: DOP853 of two libraries, the method of Runge and Kutta on a quaternion, and the
//! step of a game engine, all on equations written by hand.

use std::cell::Cell;
use std::hint::black_box;
use std::rc::Rc;

use differential_equations::prelude::{IVP, ODE};
use ode_solvers::dop_shared::OutputType;
use ode_solvers::{Dop853, SVector as OdeVector, System};

use super::entry::{Ask, Entry, Setting, Side};
use super::scene::Target;

/// Equations of motion as one types them: velocities first, then where the system is.
pub trait ByHand<const N: usize> {
    /// How many of the N variables are velocities.
    const VELOCITIES: usize;

    /// The derivatives.
    fn rates(&self, y: &[f64; N]) -> [f64; N];

    /// Brings what drifts (the length of a quaternion) back.
    fn normalise(&self, y: &mut [f64; N]);

    /// What the target knows.
    fn observe(&self, y: &[f64; N]) -> Vec<Vec<f64>>;

    /// The energy.
    fn energy(&self, y: &[f64; N]) -> f64;
}

/// The baselines on equations with their start.
pub fn baselines<E: ByHand<N> + Copy + 'static, const N: usize>(
    entries: &mut Vec<Entry>,
    variables: &'static str,
    equations: E,
    start: [f64; N],
    target: &Rc<Target>,
) {
    let mut add = |method, setting, run: Solve<E, N>| {
        let name = (method, variables, "by hand");
        let target = Rc::clone(target);
        entries.push(Entry::new(name, Side::Baseline, setting, move |value, duration, ask| {
            let counted = Counted { equations, count: Rc::default() };
            let failed = || format!("{method} gives up");
            match ask {
                Ask::Time => {
                    black_box(run(&counted, black_box(start), duration, value, None).ok_or_else(failed)?);
                }
                Ask::Error(error) => {
                    let end = run(&counted, start, duration, value, None).ok_or_else(failed)?;
                    *error = target.error(&equations.observe(&end));
                }
                Ask::Energy(see) => {
                    let see = &mut |t: f64, y: &[f64; N]| see(t, equations.energy(y));
                    run(&counted, start, duration, value, Some(see)).ok_or_else(failed)?;
                }
            }
            Ok(counted.count.get())
        }));
    };
    add("DOP853 of ode_solvers", Setting::Tolerance, ode_solvers);
    add("DOP853 of differential-equations", Setting::Tolerance, differential_equations);
    add("RK 4 on quaternions", Setting::Step(4), runge_kutta);
    add("semi-implicit Euler", Setting::Step(1), semi_implicit_euler);
}

/// From a start over a duration, s, with a step or a tolerance, to the end.
type Solve<E, const N: usize> = fn(&Counted<E>, [f64; N], f64, f64, See<'_, N>) -> Option<[f64; N]>;

/// Sees the states of a run.
type See<'s, const N: usize> = Option<&'s mut dyn FnMut(f64, &[f64; N])>;

/// Equations that count their evaluations. One of the libraries wants to own them, so the count is shared.
#[derive(Clone)]
struct Counted<E> {
    equations: E,
    count: Rc<Cell<u64>>,
}

impl<E> Counted<E> {
    #[inline(always)]
    fn rates<const N: usize>(&self, y: &[f64; N]) -> [f64; N]
    where
        E: ByHand<N>,
    {
        self.count.set(self.count.get() + 1);
        self.equations.rates(y)
    }
}

impl<E: ByHand<N>, const N: usize> System<f64, OdeVector<f64, N>> for Counted<E> {
    fn system(&self, _: f64, y: &OdeVector<f64, N>, dy: &mut OdeVector<f64, N>) {
        dy.data.0[0] = self.rates(&y.data.0[0]);
    }
}

impl<E: ByHand<N>, const N: usize> ODE<f64, [f64; N]> for Counted<E> {
    fn diff(&self, _: f64, y: &[f64; N], dydt: &mut [f64; N]) {
        *dydt = self.rates(y);
    }
}

/// Without dense output, which costs three evaluations a step. The limit of steps is raised: it is not what is
/// compared.
fn ode_solvers<E: ByHand<N> + Clone, const N: usize>(
    equations: &Counted<E>,
    start: [f64; N],
    duration: f64,
    tolerance: f64,
    see: See<'_, N>,
) -> Option<[f64; N]> {
    // The defaults of the library but for the last argument and the third from the end.
    let (safety, beta, least, most, longest, first) = (0.9, 0.0, 0.333, 6.0, duration, 0.0);
    let mut solver = Dop853::from_param(
        equations.clone(),
        0.0,
        duration,
        duration,
        OdeVector::from(start),
        tolerance,
        tolerance,
        safety,
        beta,
        least,
        most,
        longest,
        first,
        10_000_000,
        1000,
        OutputType::Sparse,
    );
    solver.integrate().ok()?;
    if let Some(see) = see {
        solver.x_out().iter().zip(solver.y_out()).for_each(|(t, y)| see(*t, &y.data.0[0]));
    }
    solver.y_out().last().map(|y| y.data.0[0])
}

fn differential_equations<E: ByHand<N>, const N: usize>(
    equations: &Counted<E>,
    start: [f64; N],
    duration: f64,
    tolerance: f64,
    see: See<'_, N>,
) -> Option<[f64; N]> {
    use differential_equations::prelude::ExplicitRungeKutta;
    let method = ExplicitRungeKutta::dop853().rtol(tolerance).atol(tolerance).max_steps(10_000_000);
    let solution = IVP::ode(equations, 0.0, duration, start).method(method).solve().ok()?;
    if let Some(see) = see {
        solution.t.iter().zip(&solution.y).for_each(|(t, y)| see(*t, y));
    }
    solution.y.last().copied()
}

/// Steps of about the length asked for that end in time.
fn steps(duration: f64, step: f64) -> (u64, f64) {
    let count = (duration / step).ceil().max(1.0);
    (count as u64, duration / count)
}

fn along<const N: usize>(y: &[f64; N], h: f64, rates: &[f64; N]) -> [f64; N] {
    std::array::from_fn(|i| y[i] + h * rates[i])
}

fn runge_kutta<E: ByHand<N>, const N: usize>(
    equations: &Counted<E>,
    start: [f64; N],
    duration: f64,
    step: f64,
    mut see: See<'_, N>,
) -> Option<[f64; N]> {
    let (count, h) = steps(duration, step);
    let mut y = start;
    for n in 1..=count {
        let k1 = equations.rates(&y);
        let k2 = equations.rates(&along(&y, 0.5 * h, &k1));
        let k3 = equations.rates(&along(&y, 0.5 * h, &k2));
        let k4 = equations.rates(&along(&y, h, &k3));
        y = std::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
        equations.equations.normalise(&mut y);
        if let Some(see) = &mut see {
            see(n as f64 * h, &y);
        }
    }
    y.iter().all(|x| x.is_finite()).then_some(y)
}

/// The new velocities move the configuration.
fn semi_implicit_euler<E: ByHand<N>, const N: usize>(
    equations: &Counted<E>,
    start: [f64; N],
    duration: f64,
    step: f64,
    mut see: See<'_, N>,
) -> Option<[f64; N]> {
    let (count, h) = steps(duration, step);
    let mut y = start;
    for n in 1..=count {
        let forces = equations.rates(&y);
        for i in 0..E::VELOCITIES {
            y[i] += h * forces[i];
        }
        // Only the kinematics are looked at, which is why this counts as a part of the same evaluation.
        let moved = equations.equations.rates(&y);
        for i in E::VELOCITIES..N {
            y[i] += h * moved[i];
        }
        equations.equations.normalise(&mut y);
        if let Some(see) = &mut see {
            see(n as f64 * h, &y);
        }
    }
    y.iter().all(|x| x.is_finite()).then_some(y)
}
