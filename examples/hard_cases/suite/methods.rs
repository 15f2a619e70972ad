//! The methods that cases choose from. A new one is one line where it belongs: its name, its form, and itself.

use gauss_runtime::integrate::{Collocation, Compensated, Control, Fixed, Form, Rkmk};
use gauss_runtime::prelude::*;

use super::scenes::State;

/// Dormand and Prince, order 8, steps of one length.
pub fn order_8(step: f64) -> Fixed<f64, Rkmk<f64, 12>> {
    Fixed::with(&Tableau::DORMAND_PRINCE_8, step)
}

/// The same, carrying what is rounded off.
pub fn carrying_8(step: f64) -> Compensated<f64, Rkmk<f64, 12>> {
    Compensated::with(&Tableau::DORMAND_PRINCE_8, step)
}

/// Verner, order 9.
pub fn order_9(step: f64) -> Fixed<f64, Rkmk<f64, 16>> {
    Fixed::with(&Tableau::VERNER_9, step)
}

/// Gauss, order 6: symmetric, and keeps quadratic integrals of momenta.
pub fn gauss_6(step: f64) -> Fixed<f64, Collocation<f64, 3>> {
    Fixed::by(Collocation::order_6(), step)
}

/// RODAS, order 4: stable however stiff the scene is.
pub fn linearly_implicit(step: f64) -> Fixed<f64, Rosenbrock> {
    Fixed::by(Rosenbrock, step)
}

/// Splitting of order 4 over the exact free motion: spin costs nothing, and a body without forces needs one step.
macro_rules! splitting {
    ($kernel:expr, $step:expr) => {{
        use gauss_exact::{Scheme, Splitting};
        gauss_runtime::integrate::Fixed::by(Splitting::exact($kernel, Scheme::BLANES_MOAN_4)?, $step)
    }};
}
pub(super) use splitting;

/// Dormand and Prince, order 8, with steps for errors near rounding.
pub fn tight() -> Adaptive {
    adaptive_8(1e-14)
}

/// Power series, as long steps and high orders as rounding allows.
pub fn series() -> Taylor {
    Taylor::new(1e-16, 1e-16)
}

/// The same with another tolerance.
pub fn adaptive_8(tolerance: f64) -> Adaptive {
    Adaptive::new(tolerance, tolerance)
}

/// A run from a pose and a twist to its end, and the number of steps. Where a run stops the error is infinite.
pub fn end<S, F, C>(
    kernel: &S,
    form: F,
    control: C,
    start: &State,
    duration: f64,
) -> Result<(State, u64), Box<dyn std::error::Error>>
where
    S: RigidBodySystem<Scalar = f64, Input = ()>,
    F: Form<S>,
    C: Control<S>,
{
    let q = kernel.configuration(&start.pose())?;
    let z = kernel.speeds(0.0, &q, &start.twist());
    let mut steps = 0;
    let run = Simulation::new(kernel).form(form).control(control).observe(|_| steps += 1).max_steps(200_000);
    let last = run.run_to_end(q, z, 0.0..duration)?;
    Ok((State::of(kernel, &last.q, &last.z), steps - 1))
}
