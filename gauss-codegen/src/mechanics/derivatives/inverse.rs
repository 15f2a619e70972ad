//! Inverse dynamics and its derivatives: ∂C/∂ż at any ż, by the configuration, z, ż, time and inputs.

use crate::algebra::Expr;
use crate::derivatives::{DerivativeForm, Direction, DirectionalDerivatives};

use crate::mechanics::derivatives::linearize::{Increments, alone};
use crate::mechanics::derivatives::rigid::Rates;
use crate::mechanics::formula::Formulas;
use crate::mechanics::system::System;

/// Derivatives of the rows of ∂C/∂ż.
pub struct InverseLinearization<'g> {
    /// Along the components of an increment, the speeds, their rates, time, and the inputs, in this order.
    pub differentiated: DirectionalDerivatives<'g>,
}

impl<'g> InverseLinearization<'g> {
    pub fn new(system: &System<'g>, formulas: &Formulas<'g>) -> Self {
        let scene = &system.scene;
        let graph = scene.graph;
        let arrangements = formulas.gauss_residual.clone();
        let mut directions = Increments::of(scene).directions;
        directions.extend(alone(graph, &scene.speeds));
        let of_rates = directions.len()..directions.len() + scene.speed_rates.len();
        directions.extend(alone(graph, &scene.speed_rates));
        directions.push(scene.along_time());
        directions.extend(alone(graph, &scene.inputs));
        // Along ż it is linear, with the matrix A.
        let at_fixed_rates = |k: &usize| !of_rates.contains(k);
        let fixed: Vec<Rates<'g>> =
            (0..directions.len()).filter(at_fixed_rates).map(|k| rates(&directions[k])).collect();
        let whole = |mut way: Vec<Vec<Expr<'g>>>| {
            let rest = way.split_off(1 + of_rates.start);
            let outputs = way.into_iter().chain(system.matrix.iter().cloned()).chain(rest).flatten().collect();
            DerivativeForm { outputs, columns: None }
        };
        // Forms of their own know masses that stay.
        let forms = if scene.matter_time.is_some() { Vec::new() } else { system.residuals_with_derivatives(&fixed) };
        let derived = forms.into_iter().map(whole).collect();
        Self { differentiated: DirectionalDerivatives { arrangements, defined: system.defined(), directions, derived } }
    }
}

fn rates<'g>(direction: &Direction<'g>) -> Rates<'g> {
    direction.iter().map(|(symbol, rate)| (symbol.key(), *rate)).collect()
}
