//! Every system against the definition, as for one body: C of (3.1) over all bodies and particles must be stationary.

use crate::algebra::{Evaluation, Expr, Map};

use super::check::{Disagreement, agree};
use super::gauss::stationarity_of_body;
use super::methods::{Formula, Method};
use super::system::System;
use super::vector::dot;

/// What is found wrong with a system at a pseudo-random state.
#[derive(Debug)]
pub enum SystemFault {
    /// An error of this crate.
    Disagreement(Disagreement),
    /// A is singular: this speed moves nothing that the earlier ones do not move.
    DependentSpeed(usize),
}

/// `Σ ∫a_P·w_α dm − ∫w_α·dF` with v_P differentiated from positions, and (3.3) for the particles.
fn stationarity<'g>(system: &System<'g>) -> Vec<Expr<'g>> {
    let scene = &system.scene;
    let mut rows = vec![scene.graph.zero(); scene.speeds.len()];
    let add = |rows: &mut Vec<Expr<'g>>, more: Vec<Expr<'g>>| {
        rows.iter_mut().zip(more).for_each(|(row, e)| *row = *row + e);
    };
    for (moving, link) in system.bodies.iter().zip(&scene.links) {
        let omega = moving.angular_velocity_vector();
        let rates = [&system.rates, &system.along];
        let motion = moving.motion(&omega);
        add(&mut rows, stationarity_of_body(&motion, &moving.position, &link.body, &scene.speeds, rates));
    }
    for particle in &scene.particles {
        let velocity = particle.position.map(|e| e.derivative(&system.rates));
        let acceleration = velocity.map(|e| e.derivative(&system.along));
        let free = scene.gravity.unwrap_or([scene.graph.zero(); 3]);
        let excess = std::array::from_fn(|i| particle.mass * (acceleration[i] - free[i]));
        add(&mut rows, scene.speeds.iter().map(|&z| dot(&excess, &velocity.map(|e| e.partial(z)))).collect());
    }
    if let Some(potential) = scene.potential {
        let power = potential.derivative(&system.rates);
        add(&mut rows, scene.speeds.iter().map(|&z| power.partial(z)).collect());
    }
    rows
}

/// Evaluates the condition at one state, with the residual at any ż and with every arrangement's acceleration.
pub fn check_system_against_definition<'g>(system: &System<'g>, formulas: &[Formula<'g>]) -> Result<(), SystemFault> {
    let condition = stationarity(system);
    let entries: Vec<Expr<'g>> = system.matrix.iter().flatten().copied().collect();
    let arrangements =
        |method: Method| formulas.iter().filter(move |f| f.method == method).flat_map(|f| f.arrangements.iter());
    // Roots and logarithms have domains: the first of a few states where everything has a value. Where there is none, the
    // programs are still checked against their expressions.
    let inside = |state: &Map<u32, f64>| values(state, condition.iter().chain(&entries)).iter().all(|x| x.is_finite());
    let Some(mut state) = (0..16).map(|shift| sample_state(system, shift)).find(inside) else { return Ok(()) };
    if let Some(speed) = vanishing_pivot(values(&state, &entries), system.scene.speeds.len()) {
        return Err(SystemFault::DependentSpeed(speed));
    }
    let expected = values(&state, &condition);
    for arrangement in arrangements(Method::GaussResidual) {
        agree(Method::GaussResidual, &values(&state, arrangement), &expected).map_err(SystemFault::Disagreement)?;
    }
    for arrangement in arrangements(Method::Acceleration) {
        let rates = values(&state, arrangement);
        let named = system.scene.speed_rates.iter().zip(&rates);
        state.extend(named.map(|(symbol, rate)| (symbol.key(), *rate)));
        let found = values(&state, &condition);
        agree(Method::Acceleration, &found, &vec![0.0; rates.len()]).map_err(SystemFault::Disagreement)?;
    }
    Ok(())
}

fn values<'a, 'g: 'a>(state: &Map<u32, f64>, outputs: impl IntoIterator<Item = &'a Expr<'g>>) -> Vec<f64> {
    let mut evaluation = Evaluation::new(state);
    outputs.into_iter().map(|e| evaluation.value(*e)).collect()
}

/// The first unknown whose pivot vanishes while A is eliminated, beside what it was.
fn vanishing_pivot(mut a: Vec<f64>, n: usize) -> Option<usize> {
    let diagonal: Vec<f64> = (0..n).map(|k| a[k * n + k].abs()).collect();
    for k in 0..n {
        let pivot = a[k * n + k];
        // Cancellation leaves roundings of the diagonal; a regular A of numbers of order one stays far above.
        if pivot.abs() <= 1e-12 * diagonal[k] {
            return Some(k);
        }
        for i in k + 1..n {
            let factor = a[i * n + k] / pivot;
            for j in k..n {
                a[i * n + j] -= factor * a[k * n + j];
            }
        }
    }
    None
}

/// Values of order one for all symbols; masses and moments of inertia dominate products of inertia.
fn sample_state(system: &System<'_>, shift: u32) -> Map<u32, f64> {
    let scene = &system.scene;
    let mut state: Map<u32, f64> = Map::default();
    for (k, key) in scene.graph.symbol_keys().into_iter().enumerate() {
        // Multiples of the golden ratio are spread evenly and never equal.
        let fraction = ((k as f64 + 0.37 * f64::from(shift)) * 0.618_033_988_749_894_9).fract();
        state.insert(key, 0.5 + fraction);
    }
    for parameter in scene.links.iter().flat_map(|link| &link.body.parameters) {
        let value = &mut *state.entry(parameter.symbol.key()).or_insert(1.0);
        *value = if parameter.row == parameter.column { 4.0 + *value } else { 0.3 * *value };
    }
    state
}
