//! Expected results of the methods of a kernel at a state, from the witness.

use crate::mechanics::formula::Method;

use super::dense::{Matrix, Saddle, apply, inverse, largest, norm, transposed};
use super::plan::Plan;
use super::witness::{DenseWitness, WitnessState};

/// Outputs of a method, and the absolute values behind them that roundings are relative to, conditioning included.
pub struct Expectation {
    pub method: Method,
    pub values: Vec<f64>,
    pub size: f64,
}

/// Errors of ż and λ per relative rounding. Eliminating A first is stable for A and leaves an error of the size of its
/// condition in J A⁻¹ Jᵀ.
fn solution_size(w: &DenseWitness<'_>) -> f64 {
    let solution = largest(&w.acceleration).max(largest(&w.multipliers));
    let behind = w.sizes.force + bias_size(w) + (w.sizes.matrix + norm(&w.jacobian)) * solution;
    let first = if w.jacobian.is_empty() { 1.0 } else { w.sizes.condition };
    first * w.saddle.inverse_norm * behind
}

/// Size of γ: second derivatives of a constraint are of the order of its first ones, and twice as many speeds as in J
/// enter.
fn bias_size(w: &DenseWitness<'_>) -> f64 {
    largest(&w.bias) + norm(&w.jacobian) * (1.0 + largest(&w.state().speeds)).powi(2)
}

/// The same of ṗ: z follows from p with an error of the size of the condition of A, and enters twice.
fn momentum_rate_size(w: &DenseWitness<'_>) -> f64 {
    let balance = w.sizes.momentum_rate + w.sizes.force;
    w.sizes.condition * (2.0 * balance + force_size(w))
}

/// The same of Jᵀ λ.
fn force_size(w: &DenseWitness<'_>) -> f64 {
    norm(&transposed(&w.jacobian, w.matrix.len())) * solution_size(w)
}

fn kinematics_size(w: &DenseWitness<'_>, values: &[f64]) -> f64 {
    1.0 + largest(values) + norm(&transposed(&w.kinematic_rows, values.len()))
}

/// Corrections of positions and of velocities, and their sizes.
fn corrections(w: &DenseWitness<'_>, plan: &Plan, wanted: &[f64]) -> [Expectation; 2] {
    let opposite = |rows: &[usize]| -> Vec<f64> { rows.iter().map(|&k| -wanted[k]).collect() };
    let least = |rows: &[usize]| -> (Vec<f64>, f64) {
        let jacobian: Matrix = rows.iter().map(|&k| w.jacobian[k].clone()).collect();
        let saddle = Saddle::new(&w.matrix, &jacobian).expect("fewer constraints than at a usable state");
        let (increment, multipliers) = saddle.solve(&vec![0.0; w.matrix.len()], &opposite(rows));
        let solution = largest(&increment).max(largest(&multipliers));
        let behind = largest(wanted) + (w.sizes.matrix + norm(&jacobian)) * solution;
        (increment, w.sizes.condition * saddle.inverse_norm * behind)
    };
    let all: Vec<usize> = (0..plan.constraints.len()).collect();
    let positions: Vec<usize> = all.iter().copied().filter(|&k| plan.constraints[k].is_on_positions()).collect();
    let (increment, size) = least(&positions);
    let rows = transposed(&w.kinematic_rows, w.kinematics.len());
    let moved = apply(&rows, &increment);
    let moved_size = norm(&rows) * size;
    let (pushed, pushed_size) = least(&all);
    [
        Expectation { method: Method::PositionCorrection, values: moved, size: moved_size },
        Expectation { method: Method::VelocityCorrection, values: pushed, size: pushed_size },
    ]
}

fn residual_size(w: &DenseWitness<'_>, values: &[f64], state: &WitnessState) -> f64 {
    10.0 + largest(values) + norm(&w.jacobian) * (1.0 + largest(&state.speeds))
}

/// Expectations of a system with all its speeds, at any ż and any residuals that corrections are asked for.
pub fn of_whole(w: &DenseWitness<'_>, plan: &Plan, rates: &[f64], wanted: &[f64]) -> Vec<Expectation> {
    let (n, sizes) = (w.matrix.len(), &w.sizes);
    let expectation = |method, values: Vec<f64>, size: f64| Expectation { method, values, size };
    let inertia = apply(&w.matrix, rates);
    let forces = w.constraint_forces();
    let residual: Vec<f64> = (0..n).map(|k| inertia[k] - w.force[k] - forces[k]).collect();
    let gradient_size = sizes.force + sizes.matrix * largest(rates);
    let function = w.constraint_function(rates) - w.constraint_function(&vec![0.0; n]);
    let state = w.state();
    let velocity_size = sizes.inverse * (sizes.momentum + sizes.matrix * largest(&state.speeds));
    let mut all = vec![
        expectation(Method::Kinematics, w.kinematics.clone(), kinematics_size(w, &w.kinematics)),
        expectation(Method::Acceleration, w.acceleration.clone(), solution_size(w)),
        expectation(Method::Momentum, w.momentum.clone(), sizes.momentum),
        expectation(Method::Velocity, state.speeds.clone(), velocity_size),
        expectation(Method::MomentumRate, w.momentum_rate.clone(), momentum_rate_size(w)),
        expectation(Method::MassMatrix, w.matrix.concat(), sizes.matrix),
        expectation(Method::KineticEnergy, vec![w.kinetic_energy], sizes.kinetic_energy),
        expectation(Method::PotentialEnergy, vec![w.potential_energy], sizes.potential_energy),
        expectation(Method::GaussResidual, residual, gradient_size + force_size(w)),
        expectation(Method::ConstraintFunction, vec![function], w.function_size(rates)),
    ];
    if !plan.constraints.is_empty() {
        let (positions, velocities) = (w.on_positions.clone(), w.on_velocities.clone());
        let (position_size, velocity_size) =
            (residual_size(w, &positions, state), residual_size(w, &velocities, state));
        all.extend([
            expectation(Method::Multipliers, w.multipliers.clone(), solution_size(w)),
            expectation(Method::PositionResidual, positions, position_size),
            expectation(Method::VelocityResidual, velocities, velocity_size),
        ]);
        all.extend(corrections(w, plan, wanted));
    }
    all
}

/// Which speeds stay and which follow from them.
pub struct Reduction {
    pub kept: Vec<usize>,
    pub eliminated: Vec<usize>,
}

impl Reduction {
    /// Eliminates the speeds that the constraints determine best at a state: pivots of J, by rows and columns.
    pub fn choose(w: &DenseWitness<'_>) -> Option<Self> {
        let n = w.matrix.len();
        let mut rows = w.jacobian.clone();
        let mut eliminated = Vec::new();
        for k in 0..rows.len() {
            let free = (0..n).filter(|column| !eliminated.contains(column));
            let pivot = free.max_by(|&a, &b| rows[k][a].abs().total_cmp(&rows[k][b].abs()))?;
            let own = rows[k].clone();
            for row in rows.iter_mut().skip(k + 1) {
                let factor = row[pivot] / own[pivot];
                row.iter_mut().zip(&own).for_each(|(x, p)| *x -= factor * p);
            }
            eliminated.push(pivot);
        }
        let kept = (0..n).filter(|column| !eliminated.contains(column)).collect();
        Some(Self { kept, eliminated })
    }

    fn block(rows: &Matrix, columns: &[usize]) -> Matrix {
        rows.iter().map(|row| columns.iter().map(|&k| row[k]).collect()).collect()
    }

    /// J_d⁻¹ of the speeds that are eliminated, unless they are badly determined.
    fn solver(&self, w: &DenseWitness<'_>) -> Option<Matrix> {
        inverse(&Self::block(&w.jacobian, &self.eliminated)).filter(|inverse| norm(inverse) < 10.0)
    }

    /// The state with the eliminated speeds such that the constraints hold, where they determine them well.
    pub fn satisfied(&self, plan: &Plan, state: &WitnessState) -> Option<WitnessState> {
        let w = DenseWitness::new(plan, state)?;
        let mut state = state.clone();
        for (&k, excess) in self.eliminated.iter().zip(apply(&self.solver(&w)?, &w.on_velocities)) {
            state.speeds[k] -= excess;
        }
        Some(state)
    }

    /// All components of an increment of speeds, from those of each part.
    fn together(&self, kept: &[f64], eliminated: &[f64]) -> Vec<f64> {
        let mut all = vec![0.0; self.kept.len() + self.eliminated.len()];
        self.kept.iter().zip(kept).for_each(|(&k, x)| all[k] = *x);
        self.eliminated.iter().zip(eliminated).for_each(|(&k, x)| all[k] = *x);
        all
    }
}

/// Expectations of a system whose constraints are solved for some of its speeds, at a state that satisfies them: those
/// of the whole one, with `z = V z_kept + …`, `V = (1, −J_d⁻¹ J_k)`.
pub fn of_reduced(
    w: &DenseWitness<'_>,
    plan: &Plan,
    reduction: &Reduction,
    rates: &[f64],
    wanted: &[f64],
) -> Option<Vec<Expectation>> {
    let solver = reduction.solver(w)?;
    let negative = |x: Vec<f64>| -> Vec<f64> { x.into_iter().map(|x| -x).collect() };
    let column_of = |rows: &Matrix, k: usize| -> Vec<f64> { rows.iter().map(|row| row[k]).collect() };
    // V and its rate, column by column: J V = 0.
    let directions: Matrix = (0..reduction.kept.len())
        .map(|k| {
            let mut own = vec![0.0; reduction.kept.len()];
            own[k] = 1.0;
            let follow = apply(&solver, &column_of(&w.jacobian, reduction.kept[k]));
            reduction.together(&own, &negative(follow))
        })
        .collect();
    let still = vec![0.0; reduction.kept.len()];
    let turning: Matrix = directions
        .iter()
        .map(|v| reduction.together(&still, &negative(apply(&solver, &apply(&w.jacobian_rate, v)))))
        .collect();
    let completed = |rates: &[f64]| -> Vec<f64> {
        let begun = apply(&transposed(&directions, w.matrix.len()), rates);
        let bias = reduction.together(&still, &apply(&solver, &w.bias));
        begun.iter().zip(bias).map(|(x, b)| x + b).collect()
    };
    let all_rates = completed(rates);
    let inertia = apply(&w.matrix, &all_rates);
    let unbalanced: Vec<f64> = inertia.iter().zip(&w.force).map(|(a, f)| a - f).collect();
    let matrix: Matrix = directions.iter().map(|v| apply(&directions, &apply(&w.matrix, v))).collect();
    let balance = apply(&directions, &w.momentum_rate);
    let momentum_rate: Vec<f64> = balance.iter().zip(apply(&turning, &w.momentum)).map(|(a, b)| a + b).collect();
    let function = w.constraint_function(&all_rates) - w.constraint_function(&completed(&still));
    // Elimination multiplies roundings by what it divides by, once for each factor V; the state satisfies the
    // constraints with roundings of its own.
    let (v, divided) = (norm(&transposed(&directions, w.matrix.len())), 1.0 + norm(&solver) * norm(&w.jacobian));
    let factor = v * v * divided * divided;
    let reduced_condition = norm(&inverse(&matrix)?) * norm(&matrix);
    let pick = |values: &[f64]| -> Vec<f64> { reduction.kept.iter().map(|&k| values[k]).collect() };
    let speeds = pick(&w.state().speeds);
    let values = |method: Method, whole: &Expectation| -> Vec<f64> {
        match method {
            Method::Acceleration => pick(&w.acceleration),
            Method::Momentum => apply(&directions, &w.momentum),
            Method::Velocity => speeds.clone(),
            Method::MomentumRate => momentum_rate.clone(),
            Method::MassMatrix => matrix.concat(),
            Method::GaussResidual => apply(&directions, &unbalanced),
            Method::ConstraintFunction => vec![function],
            Method::VelocityResidual => vec![0.0; plan.constraints.len()],
            Method::VelocityCorrection => vec![0.0; reduction.kept.len()],
            _ => whole.values.clone(),
        }
    };
    let expectations = of_whole(w, plan, &all_rates, wanted).into_iter().map(|whole| Expectation {
        method: whole.method,
        values: values(whole.method, &whole),
        size: whole.size * factor * reduced_condition,
    });
    Some(expectations.collect())
}
