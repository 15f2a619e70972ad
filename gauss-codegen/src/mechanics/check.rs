//! Every scene is checked against the definition before code is written: the residual and the accelerations that kernels
//! are made from must make C of (3.1) stationary, formed word for word from v_P, at a pseudo-random state.

use std::fmt;

use crate::algebra::{Evaluation, Expr, Map, Number, Precise, Rational};

use super::chart::ConfigurationKind;
use super::formula::{Formula, Method};
use super::gauss::stationarity;
use super::methods::Scene;
use super::rotation::rotation_of_quaternion;

/// A formula does not satisfy the Gauss condition: an error of this crate, never of its user.
#[derive(Debug)]
pub struct Disagreement {
    method: Method,
    row: usize,
    residual: f64,
}

impl fmt::Display for Disagreement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { method, row, residual } = self;
        write!(f, "row {row} of {method:?} misses the Gauss condition by {residual:e}")
    }
}

/// Evaluates the condition at one state, with the residual formula at any ż and with every arrangement's acceleration. What disagrees in
/// double precision counts only if it does in numbers of many digits: see [`super::system_check`].
pub fn check_against_definition<'g>(scene: &Scene<'g>, formulas: &[Formula<'g>]) -> Result<(), Disagreement> {
    check_in::<f64>(scene, formulas).or_else(|_| check_in::<Precise>(scene, formulas))
}

fn check_in<'g, N: Number>(scene: &Scene<'g>, formulas: &[Formula<'g>]) -> Result<(), Disagreement> {
    let mut condition = stationarity(&scene.kinematics, &scene.body);
    if let Some(acting) = &scene.acting {
        let forces = acting.by_definition(&scene.kinematics);
        condition.iter_mut().zip(forces).for_each(|(row, force)| *row = *row - force);
    }
    let mut state = sample_state(scene);
    let values = |state: &Map<u32, N>, outputs: &[Expr<'g>]| -> Vec<N> {
        let mut evaluation = Evaluation::new(state);
        outputs.iter().map(|e| evaluation.value(*e)).collect()
    };
    let expected = values(&state, &condition);
    for formula in formulas.iter().filter(|f| f.method == Method::GaussResidual) {
        for arrangement in &formula.arrangements {
            agree(formula.method, &values(&state, arrangement), &expected)?;
        }
    }
    for formula in formulas.iter().filter(|f| f.method == Method::Acceleration) {
        for arrangement in &formula.arrangements {
            let rates = values(&state, arrangement);
            state.extend(scene.kinematics.speed_rates.iter().zip(&rates).map(|(symbol, rate)| (symbol.key(), *rate)));
            agree(formula.method, &values(&state, &condition), &vec![N::number(0.0); rates.len()])?;
        }
    }
    Ok(())
}

/// Two evaluations of the same rows.
pub(super) fn agree<N: Number>(method: Method, found: &[N], expected: &[N]) -> Result<(), Disagreement> {
    let scale = found.iter().chain(expected).fold(1.0_f64, |m, x| m.max(x.to_f64().abs()));
    for (row, (x, y)) in found.iter().zip(expected).enumerate() {
        // Numbers of order one and some hundreds of roundings; NaN is no agreement either.
        let residual = (*x - *y).to_f64();
        let close = residual.abs() <= 1e-8 * scale;
        if !close {
            return Err(Disagreement { method, row, residual });
        }
    }
    Ok(())
}

/// Values of order one for all symbols; rotations are rotations, and the kinetic matrix is dominated by its diagonal.
fn sample_state<N: Number>(scene: &Scene<'_>) -> Map<u32, N> {
    let kinematics = &scene.kinematics;
    // Multiples of the golden ratio are spread evenly and never equal.
    let mut index = 0;
    let mut next = || {
        index += 1;
        N::number(0.5 + (f64::from(index) * 0.618_033_988_749_894_9).fract())
    };
    let mut state: Map<u32, N> = Map::default();
    for parameter in &scene.body.parameters {
        let diagonal = parameter.row == parameter.column;
        let value = if diagonal { N::number(4.0) + next() } else { N::number(0.3) * next() };
        state.insert(parameter.symbol.key(), value);
    }
    let mut configuration = kinematics.configuration.iter();
    match kinematics.kind {
        ConfigurationKind::Pose | ConfigurationKind::Rotation => {
            // (1, 5, −3, 1)/6 is a unit quaternion.
            let graph = kinematics.frame.graph;
            let quaternion = [1, 5, -3, 1].map(|n| graph.integer(n).scale(Rational::new(1, 6)));
            let none = Map::default();
            let mut evaluation = Evaluation::new(&none);
            let entries = rotation_of_quaternion(graph, quaternion);
            let values: Vec<N> = entries.iter().flatten().map(|e| evaluation.value(*e)).collect();
            state.extend(configuration.by_ref().zip(values).take(9).map(|(symbol, value)| (symbol.key(), value)));
        }
        ConfigurationKind::PlanePose => {
            state.extend(
                configuration
                    .by_ref()
                    .zip([3, 4])
                    .take(2)
                    .map(|(symbol, value)| (symbol.key(), N::fraction(Rational::new(value, 5)))),
            );
        }
        ConfigurationKind::Coordinates => {}
    }
    let rest = kinematics.configuration.iter().chain(&kinematics.speeds).chain(&kinematics.speed_rates);
    for symbol in rest {
        state.entry(symbol.key()).or_insert_with(&mut next);
    }
    // Whatever else the expressions of forces read.
    for key in kinematics.frame.graph.symbol_keys() {
        state.entry(key).or_insert_with(&mut next);
    }
    state
}
