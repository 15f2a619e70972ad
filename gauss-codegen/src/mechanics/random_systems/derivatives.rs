//! The derivatives of random trees by recursion against dual numbers through their accelerations and inverse dynamics.

use crate::algebra::{Evaluation, Expr, Function, Graph, Map, Number, Precise, Rational, Scalar, Tangents};

use crate::derivatives::{DirectionalDerivatives, SecondDerivatives};
use crate::mechanics::derivatives::hessian::Hessian;
use crate::mechanics::derivatives::inverse::InverseLinearization;
use crate::mechanics::derivatives::linearize::Linearization;
use crate::mechanics::system::System;
use crate::mechanics::tests::Random;

use super::plan::{Plan, SpeedChoice, TreeShape};
use super::scene::PlanSymbols;
use super::usable_states;
use super::witness::WitnessState;

/// In numbers of 256 binary digits: some ten thousand roundings, amplified by condition numbers of up to 1e6 twice,
/// leave 60 decimal places; a wrong term leaves none.
const AGREEMENT: f64 = 1e-50;

/// All that expressions read, with quaternions whose norm is 1 to the last of many digits.
fn point<'g>(symbols: &PlanSymbols<'g>, system: &System<'g>, state: &WitnessState) -> Map<u32, Precise> {
    let mut at: Map<u32, Precise> =
        symbols.parameters.iter().map(|(&key, &value)| (key, Precise::number(value))).collect();
    let mut give = |symbols: &[Expr<'g>], values: &[f64]| {
        at.extend(symbols.iter().map(|s| s.key()).zip(values.iter().map(|&value| Precise::number(value))));
    };
    give(&[symbols.time], &[state.time]);
    give(&symbols.configuration, &state.configuration);
    give(&system.scene.speeds, &state.speeds);
    for (quaternion, values) in symbols.quaternions.iter().zip(&state.quaternions) {
        let values = values.map(Precise::number);
        let norm = values.iter().fold(Precise::number(0.0), |sum, x| sum + *x * *x).call(Function::Sqrt);
        at.extend(quaternion.iter().map(|s| s.key()).zip(values.map(|x| x / norm)));
    }
    let mut evaluation = Evaluation::new(&at);
    let defined: Vec<_> = symbols.definitions.iter().map(|(&key, e)| (key, evaluation.value(*e))).collect();
    at.extend(defined);
    at
}

/// Whether there are derivatives by recursion; panics where one is wrong.
fn check(plan: &Plan, random: &mut Random, twice: bool, what: &str) -> bool {
    let states = usable_states(plan, random);
    let Some(state) = states.first() else { return false };
    let graph = Graph::new();
    let symbols = PlanSymbols::new(&graph, plan);
    let all: Vec<usize> = (0..plan.speeds).collect();
    let system = System::new(symbols.scene(plan, &symbols.speeds, &all, true));
    let formulas = system.formulas();
    let linearization = Linearization::new(&system, &formulas);
    let inverse = InverseLinearization::new(&system, &formulas);
    let mut values = point(&symbols, &system, state);
    // Rates of the speeds, of which accelerations know nothing.
    let rates = system.scene.speed_rates.iter();
    values.extend(rates.zip(&state.speeds).map(|(symbol, z)| (symbol.key(), Precise::number(0.3 - 0.7 * z))));
    let both = agree(&linearization.differentiated, &values, what) && agree(&inverse.differentiated, &values, what);
    let both = agree_by_parameters(&linearization, &system, &symbols, &values, what) && both;
    if !twice {
        return both;
    }
    let hessian = Hessian::new(&system, &formulas);
    let weights = hessian.weights.iter().enumerate();
    values.extend(weights.map(|(k, symbol)| (symbol.key(), Precise::number(0.8 - 0.3 * k as f64))));
    agree_twice(&hessian.curved, plan.speeds < 3, &values, what) && both
}

/// Whether there are forms of their own; panics where one is wrong.
fn agree<'g>(differentiated: &DirectionalDerivatives<'g>, values: &Map<u32, Precise>, what: &str) -> bool {
    let mut evaluation = Evaluation::new(values);
    let outputs = &differentiated.arrangements[0];
    let mut expected: Vec<Precise> = outputs.iter().map(|e| evaluation.value(*e)).collect();
    for direction in &differentiated.directions {
        let rates = direction.iter().map(|(symbol, rate)| (symbol.key(), evaluation.value(*rate))).collect();
        let mut tangents = Tangents::new(&mut evaluation, &rates);
        expected.extend(outputs.iter().map(|e| tangents.along(*e)));
    }
    for derived in &differentiated.derived {
        assert_eq!(derived.outputs.len(), expected.len(), "{what}");
        for (k, (e, expected)) in derived.outputs.iter().zip(&expected).enumerate() {
            let apart = (evaluation.value(*e) - *expected).to_f64().abs();
            let (direction, row) = (k / outputs.len(), k % outputs.len());
            let close = apart <= AGREEMENT * (1.0 + expected.to_f64().abs());
            assert!(close, "{what}: row {row} along {direction}: {} is {apart:e} off", expected.to_f64());
        }
    }
    !differentiated.derived.is_empty()
}

/// Whether there are derivatives by parameters in forms of their own; panics where one is wrong.
fn agree_by_parameters<'g>(
    linearization: &Linearization<'g>,
    system: &System<'g>,
    symbols: &PlanSymbols<'g>,
    values: &Map<u32, Precise>,
    what: &str,
) -> bool {
    let (mut evaluation, outputs) = (Evaluation::new(values), &linearization.differentiated.arrangements[0]);
    let parameters = symbols.all_parameters();
    let ways = linearization.derived_by_parameters(system, &parameters);
    // Some of each link.
    for (k, parameter) in parameters.iter().enumerate().skip(what.len() % 3).step_by(3) {
        let rates = Map::from_iter([(parameter.key(), Precise::number(1.0))]);
        let mut tangents = Tangents::new(&mut evaluation, &rates);
        let expected: Vec<Precise> = outputs.iter().map(|e| tangents.along(*e)).collect();
        for way in &ways {
            let found = way[k * outputs.len()..][..outputs.len()].iter().map(|e| evaluation.value(*e));
            for (row, (found, expected)) in found.zip(&expected).enumerate() {
                let apart = (found - *expected).to_f64().abs();
                let close = apart <= AGREEMENT * (1.0 + expected.to_f64().abs());
                assert!(close, "{what}: row {row} by parameter {k}: {} is {apart:e} off", expected.to_f64());
            }
        }
    }
    !ways.is_empty()
}

/// Whether there are second derivatives in forms of their own; panics where one is wrong. Those of small systems are
/// found in a third way, by differentiating expressions.
fn agree_twice<'g>(curved: &SecondDerivatives<'g>, small: bool, values: &Map<u32, Precise>, what: &str) -> bool {
    let mut evaluation = Evaluation::new(values);
    let expected = curved.values(&mut evaluation);
    let mut ways = curved.derived.clone();
    if small {
        let along: Vec<Map<u32, Expr<'g>>> =
            curved.directions.iter().map(|d| d.iter().map(|(s, rate)| (s.key(), *rate)).collect()).collect();
        let once: Vec<Expr<'g>> = along.iter().map(|d| curved.arrangements[0].derivative(d)).collect();
        let twice = |(i, j): (usize, usize)| {
            let sum = once[i].derivative(&along[j]) + once[j].derivative(&along[i]);
            sum.scale(Rational::new(1, 2))
        };
        ways.push(SecondDerivatives::<'g>::pairs(along.len()).map(twice).collect());
    }
    for way in &ways {
        assert_eq!(way.len(), expected.len(), "{what}");
        let pairs = SecondDerivatives::<'g>::pairs(curved.directions.len());
        for ((pair, e), expected) in pairs.zip(way).zip(&expected) {
            let apart = (evaluation.value(*e) - *expected).to_f64().abs();
            let close = apart <= AGREEMENT * (1.0 + expected.to_f64().abs());
            assert!(close, "{what}: along {pair:?} {} is {apart:e} off", expected.to_f64());
        }
    }
    !curved.derived.is_empty()
}

#[test]
fn trees_have_the_derivatives_that_dual_numbers_give() {
    let mut random = Random(41);
    let mut told = 0;
    for trial in 0..12 {
        let shape = TreeShape {
            bodies: 2 + trial % 3,
            planar: trial % 4 == 3,
            rates: 7,
            choice: [SpeedChoice::Rates, SpeedChoice::Own, SpeedChoice::Fewer(3)][trial % 3],
            constraints: 0,
        };
        let attempt = |random: &mut Random| {
            let plan = Plan::tree(random, shape);
            // Second ones take longer: of some small trees, in space and in the plane, with rates and with speeds of
            // their own.
            check(&plan, random, trial % 2 == 1 && trial % 3 != 2, &format!("trial {trial} of {shape:?}: {plan:?}"))
        };
        told += usize::from((0..16).any(|_| attempt(&mut random)));
    }
    assert!(told >= 11, "only {told} of 12 trees have derivatives by recursion");
}
