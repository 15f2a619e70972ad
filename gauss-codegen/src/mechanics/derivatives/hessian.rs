//! Second derivatives of the equations along given weights: the Hessian of `λ · (V, ż)` by the state and the inputs,
//! for optimisation along trajectories.
//!
//! Of elements of groups second derivatives are those of σ ↦ λ · (V, ż)(q ∘ exp(σ)): the mean of what differentiating
//! along one component and then the other gives, and the other way round.

use crate::algebra::{Expr, Map, Rational, Substitution};
use crate::derivatives::{Direction, SecondDerivatives};

use crate::mechanics::derivatives::linearize::{Increments, alone};
use crate::mechanics::derivatives::rigid::Rates;
use crate::mechanics::formula::Formulas;
use crate::mechanics::kinematics::coordinate::Coordinate;
use crate::mechanics::scene::SystemScene;
use crate::mechanics::system::System;

/// Weighted sum of the rates, which is differentiated twice.
pub struct Hessian<'g> {
    /// Along the components of an increment, the speeds and the inputs, in this order.
    pub curved: SecondDerivatives<'g>,
    /// λ, of V in the order of increments and then of ż.
    pub weights: Vec<Expr<'g>>,
}

impl<'g> Hessian<'g> {
    pub fn new(system: &System<'g>, formulas: &Formulas<'g>) -> Self {
        let scene = &system.scene;
        let graph = scene.graph;
        let Increments { mut directions, order } = Increments::of(scene);
        directions.extend(alone(graph, &scene.speeds));
        let states = directions.len();
        directions.extend(alone(graph, &scene.inputs));
        let weight = |k: usize| graph.symbol(format!("λ_{}", k + 1), format!("\\lambda_{{{}}}", k + 1), false);
        let weights: Vec<Expr<'g>> = (0..states).map(weight).collect();
        let velocity: Vec<Expr<'g>> = order.iter().map(|&k| scene.kinematics[k]).collect();
        let weighted = |accelerations: &Vec<Expr<'g>>| {
            let values = velocity.iter().chain(accelerations);
            weights.iter().zip(values).fold(graph.zero(), |sum, (weight, value)| sum + *weight * value.group())
        };
        let arrangements = formulas.acceleration.iter().map(weighted).collect();
        let groups = groups(scene, directions.len());
        let mut curved =
            SecondDerivatives { arrangements, defined: system.defined(), directions, groups, derived: Vec::new() };
        curved.derived = Recursion::new(system, &curved, &weights, &velocity).ways(system);
        Self { curved, weights }
    }
}

/// Second derivatives of accelerations that solve `∂C/∂ż = 0`, for links that hang on one another. With μ = A⁻¹λ they
/// are `−(∂ᵢ∂ⱼ + ∂ⱼż · ∂ᵢ∂/∂ż + ∂ᵢż · ∂ⱼ∂/∂ż) (μ · ∂C/∂ż)` at fixed μ, and ż fixed but where it is named.
struct Recursion<'a, 'g> {
    curved: &'a SecondDerivatives<'g>,
    /// λ of the rates of the configuration times these, and λ of ż.
    velocity: Expr<'g>,
    weights: &'a [Expr<'g>],
    /// Symbols for μ.
    solved: Vec<Expr<'g>>,
    /// Directions that are wanted, then that along ż.
    directions: Vec<Rates<'g>>,
    /// Which second derivatives of the residual are needed, by what follows what.
    pairs: Vec<(usize, usize)>,
    places: Map<(usize, usize), usize>,
}

impl<'a, 'g> Recursion<'a, 'g> {
    fn new(
        system: &System<'g>,
        curved: &'a SecondDerivatives<'g>,
        weights: &'a [Expr<'g>],
        velocity: &[Expr<'g>],
    ) -> Self {
        let scene = &system.scene;
        let (of_velocity, weights) = weights.split_at(velocity.len());
        let values = of_velocity.iter().zip(velocity).map(|(weight, value)| *weight * *value);
        let velocity = values.fold(scene.graph.zero(), |sum, e| sum + e);
        let solved = (0..weights.len()).map(|_| scene.graph.symbol("μ", "\\mu", false)).collect();
        let rates = |direction: &Direction<'g>| direction.iter().map(|(s, rate)| (s.key(), *rate)).collect();
        let asked = curved.directions.len();
        let along = alone(scene.graph, &scene.speed_rates);
        let directions = curved.directions.iter().chain(&along).map(rates).collect();
        let mut pairs = Vec::new();
        for (i, j) in SecondDerivatives::<'g>::pairs(asked) {
            pairs.push((i, j));
            if !curved.commute(i, j) {
                pairs.push((j, i));
            }
        }
        // A depends on the configuration alone.
        let configuration = asked - scene.speeds.len() - scene.inputs.len();
        pairs.extend((0..configuration).flat_map(|i| (0..along.len()).map(move |k| (i, asked + k))));
        let places = pairs.iter().copied().enumerate().map(|(place, pair)| (pair, place)).collect();
        Self { curved, velocity, weights, solved, directions, pairs, places }
    }

    /// The second derivatives in the ways that are worth trying.
    fn ways(&self, system: &System<'g>) -> Vec<Vec<Expr<'g>>> {
        let asked = self.curved.directions.len();
        let residuals = system.weighted_residual_twice(&self.solved, &self.directions, &self.pairs);
        let Some(residual) = residuals.first() else { return Vec::new() };
        let ways = system.accelerations_with_derivatives(&self.directions[..asked], Some(self.weights));
        let second = self.of_velocity();
        ways.iter().map(|way| self.assembled(system, (&way.outputs, &way.solved), residual, &second)).collect()
    }

    fn of_velocity(&self) -> Vec<Expr<'g>> {
        let once: Vec<Expr<'g>> = self.directions.iter().map(|d| self.velocity.derivative(d)).collect();
        self.pairs.iter().map(|&(i, j)| once[i].derivative(&self.directions[j])).collect()
    }

    fn assembled(
        &self,
        system: &System<'g>,
        (accelerations, solved): (&[Vec<Expr<'g>>], &[Expr<'g>]),
        residual: &[Expr<'g>],
        of_velocity: &[Expr<'g>],
    ) -> Vec<Expr<'g>> {
        let asked = self.curved.directions.len();
        let scene = &system.scene;
        let symbols = scene.speed_rates.iter().zip(&accelerations[0]).chain(self.solved.iter().zip(solved));
        let values = Substitution::new(symbols.map(|(symbol, value)| (symbol.key(), value.group())).collect());
        let residual: Vec<Expr<'g>> = residual.iter().map(|e| values.of(*e).group()).collect();
        // ∂ᵢ∂/∂ż of the residual with ∂ⱼż.
        let mixed = |i: usize, j: usize| -> Expr<'g> {
            let rates = accelerations[1 + j].iter().enumerate();
            let terms = rates.filter_map(|(k, rate)| Some(residual[*self.places.get(&(i, asked + k))?] * rate.group()));
            terms.fold(scene.graph.zero(), |sum, e| sum + e)
        };
        let mean = |of: &[Expr<'g>], i: usize, j: usize| {
            let value = of[self.places[&(i, j)]];
            match self.curved.commute(i, j) {
                true => value,
                false => (value + of[self.places[&(j, i)]]).scale(Rational::new(1, 2)),
            }
        };
        let entry =
            |(i, j): (usize, usize)| mean(of_velocity, i, j) - mean(&residual, i, j) - mixed(i, j) - mixed(j, i);
        SecondDerivatives::<'g>::pairs(asked).map(entry).collect()
    }
}

/// Element of a group that each direction moves.
fn groups(scene: &SystemScene<'_>, count: usize) -> Vec<Option<usize>> {
    let elements = scene.coordinates.iter().filter(|coordinate| !matches!(coordinate, Coordinate::Scalar(_)));
    let sizes = elements.enumerate().flat_map(|(k, element)| std::iter::repeat_n(Some(k), element.size()));
    let mut groups: Vec<Option<usize>> = sizes.collect();
    groups.resize(count, None);
    groups
}
