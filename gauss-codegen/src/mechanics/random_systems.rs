//! Random systems: what their programs compute against the minimiser of (3.1) over particles alone, found by dense
//! algebra in double precision.
//!
//! - `numbers`: smooth functions that expressions and jets evaluate alike.
//! - `plan`: a system as data, drawn at random.
//! - `scene`: its scene, from which the derive makes programs.
//! - `witness`: its particles, (3.1) and the constraints at a state. Shares with the derive only what is given:
//!   functions, ψ, the places of links.
//! - `derivatives`: the recursion against dual numbers through the accelerations.
//! - `expectation`: what each method of the kernel should compute, and what its roundings are measured by.

mod dense;
mod derivatives;
mod expectation;
mod fluid;
mod numbers;
mod plan;
mod scene;
mod witness;

use crate::accuracy::Trial;
use crate::algebra::{Expr, Graph, Map};
use crate::kernel::{Candidates, Derivatives, Kernel, Passes, Program};

use crate::mechanics::check::faults::{Claims, check_system_against_definition};
use crate::mechanics::formula::{Formulas, Method};
use crate::mechanics::system::System;
use crate::mechanics::system::elimination::Elimination;
use crate::mechanics::tests::Random;

use dense::largest;
use expectation::{Expectation, Reduction, of_reduced, of_whole};
use numbers::below;
use plan::{Plan, SpeedChoice, TreeShape};
use scene::PlanSymbols;
use witness::{DenseWitness, WitnessState, residuals};

/// Roundings, beside the largest output, beyond which a comparison would say little: it is left out.
const BLIND: f64 = 1e-5;

/// Programs of all formulas, every arrangement by itself.
struct FormulaPrograms<'g> {
    kernel: Kernel<'g>,
    constants: Map<u32, f64>,
}

impl<'g> FormulaPrograms<'g> {
    fn new(graph: &'g Graph, symbols: &PlanSymbols<'g>, formulas: &Formulas<'g>, what: &str) -> Self {
        let alone = |outputs: &Vec<Expr<'g>>| Candidates::of_values(vec![outputs.clone()]);
        let mut further = Vec::new();
        let mut functions = formulas.each_ref().map(|method, arrangements| {
            further.extend(arrangements[1..].iter().map(|outputs| (method, alone(outputs))));
            alone(&arrangements[0])
        });
        functions.others.extend(further);
        let (wanted, definitions) = (Derivatives::default(), &symbols.definitions);
        let kernel =
            Kernel::lower(graph, &functions, definitions, &wanted, None, &mut Trial::default(), Passes::default());
        let kernel = kernel.unwrap_or_else(|error| panic!("{what}: {error}"));
        assert!(!graph.is_undefined(), "{what}: a division by zero");
        let values = kernel.constants.run(&symbols.parameters);
        let constants = kernel.constant_symbols.iter().map(|s| s.key()).zip(values).collect();
        Self { kernel, constants }
    }

    /// All that programs read at a state.
    fn inputs(&self, symbols: &PlanSymbols<'g>, state: &WitnessState) -> Map<u32, f64> {
        let mut at = self.constants.clone();
        at.extend(symbols.parameters.iter().map(|(&key, &value)| (key, value)));
        at.insert(symbols.time.key(), state.time);
        at.extend(symbols.configuration.iter().map(|s| s.key()).zip(state.configuration.iter().copied()));
        at.extend(symbols.speeds.iter().map(|s| s.key()).zip(state.speeds.iter().copied()));
        let components = symbols.quaternions.iter().zip(&state.quaternions);
        at.extend(components.flat_map(|(s, x)| s.iter().map(|s| s.key()).zip(*x)));
        at
    }

    fn programs(&self) -> impl Iterator<Item = (Method, &Program<'g>)> {
        self.kernel.functions.iter().map(|(method, function)| (method, &function.program))
    }

    fn run(&self, method: Method, at: &Map<u32, f64>) -> Vec<f64> {
        let (_, program) = self.programs().find(|(own, _)| *own == method).expect("a program of that method");
        program.run(at)
    }

    /// Whether the state can tell right from wrong, of every method; panics where a program is wrong.
    fn compare(&self, at: &Map<u32, f64>, expectations: &[Expectation], what: &str) -> bool {
        let mut told = true;
        for (method, program) in self.programs() {
            let expected = expectations.iter().find(|e| e.method == method);
            let expected = expected.unwrap_or_else(|| panic!("{what}: nothing is known of {method:?}"));
            let found = program.run(at);
            assert_eq!(found.len(), expected.values.len(), "{what}: {method:?}");
            // Each step of the program and of the constants rounds once, each sum of the witness fewer times.
            let steps = program.instructions.len() + self.kernel.constants.instructions.len() + 100;
            let rounding = f64::EPSILON * steps as f64 * expected.size;
            if rounding > BLIND * (1.0 + largest(&expected.values)) {
                told = false;
                continue;
            }
            for (k, (a, b)) in found.iter().zip(&expected.values).enumerate() {
                assert!((a - b).abs() <= rounding, "{what}: {method:?}[{k}] is {a}, not {b}, within {rounding:e}");
            }
        }
        told
    }
}

/// Without the accounts of elements, which list the same forces one by one.
fn formulas_of<'g>(system: &System<'g>) -> Formulas<'g> {
    let accounts = [Method::Powers, Method::ElementForces, Method::SuppliedPower];
    let mut formulas = system.formulas();
    formulas.others.retain(|(method, _)| !accounts.contains(method));
    formulas
}

fn random_values(random: &mut Random, count: usize) -> Vec<f64> {
    (0..count).map(|_| random.next()).collect()
}

/// States at which there is a minimiser, the best conditioned of many first.
fn usable_states(plan: &Plan, random: &mut Random) -> Vec<WitnessState> {
    let drawn = (0..24).map(|_| WitnessState::random(plan, random));
    let conditioned = drawn.filter_map(|state| {
        let witness = DenseWitness::new(plan, &state)?;
        let condition = witness.saddle.condition * witness.sizes.condition;
        (condition < 1e6).then_some((condition, state))
    });
    let mut states: Vec<(f64, WitnessState)> = conditioned.collect();
    states.sort_by(|a, b| a.0.total_cmp(&b.0));
    states.into_iter().map(|(_, state)| state).collect()
}

/// Programs of a system with all its speeds, at a few states.
fn check_whole(plan: &Plan, random: &mut Random, regrouped: bool, what: &str) -> bool {
    let states = usable_states(plan, random);
    let [first, second, ..] = states.as_slice() else { return false };
    let graph = Graph::new();
    let symbols = PlanSymbols::new(&graph, plan);
    let all: Vec<usize> = (0..plan.speeds).collect();
    let system = System::new(symbols.scene(plan, &symbols.speeds, &all, regrouped));
    let formulas = formulas_of(&system);
    if let Err(fault) = check_system_against_definition(&system, &Claims::of(&formulas)) {
        panic!("{what}: {fault:?}");
    }
    let compiled = FormulaPrograms::new(&graph, &symbols, &formulas, what);
    let mut told = false;
    for state in [first, second] {
        let witness = DenseWitness::new(plan, state).expect("a usable state");
        let rates = random_values(random, plan.speeds);
        let wanted = random_values(random, plan.constraints.len());
        let mut at = compiled.inputs(&symbols, state);
        let mut give = |symbols: &[crate::algebra::Expr<'_>], values: &[f64]| {
            at.extend(symbols.iter().map(|s| s.key()).zip(values.iter().copied()));
        };
        give(&symbols.speed_rates, &rates);
        give(&symbols.momenta, &witness.momentum);
        give(&system.constraints.residuals, &wanted);
        told |= compiled.compare(&at, &of_whole(&witness, plan, &rates, &wanted), what);
        if !plan.constraints.is_empty() {
            check_remainders(plan, state, &system, &compiled, &at, what);
        }
    }
    told
}

/// Corrections cancel residuals to first order: what remains of a residual h is of order h², a quarter at h/2.
fn check_remainders<'g>(
    plan: &Plan,
    state: &WitnessState,
    system: &System<'g>,
    compiled: &FormulaPrograms<'g>,
    at: &Map<u32, f64>,
    what: &str,
) {
    let symbols = &system.constraints.residuals;
    let direction: Vec<f64> = symbols.iter().map(|s| at[&s.key()]).collect();
    let before = residuals(plan, state);
    let positions: Vec<bool> = plan.constraints.iter().map(|c| c.is_on_positions()).collect();
    let remainders = |h: f64| -> (Vec<f64>, Vec<f64>) {
        let mut at = at.clone();
        at.extend(symbols.iter().zip(&direction).map(|(s, d)| (s.key(), h * d)));
        let moved = state.moved(plan, &compiled.run(Method::PositionCorrection, &at));
        let mut pushed = state.clone();
        let pushes = compiled.run(Method::VelocityCorrection, &at);
        pushed.speeds.iter_mut().zip(pushes).for_each(|(z, more)| *z += more);
        let rest = |before: &[f64], after: &[f64]| -> Vec<f64> {
            before.iter().zip(after).zip(&direction).map(|((a, b), d)| b - a + h * d).collect()
        };
        let mut on_positions = rest(&before.0, &residuals(plan, &moved).0);
        on_positions.iter_mut().zip(&positions).filter(|(_, own)| !**own).for_each(|(x, _)| *x = 0.0);
        (on_positions, rest(&before.1, &residuals(plan, &pushed).1))
    };
    let h = 1.0 / 4096.0;
    let (whole, half) = (remainders(h), remainders(h / 2.0));
    for (kind, a, b) in [("positions", &whole.0, &half.0), ("velocities", &whole.1, &half.1)] {
        // Third derivatives change the quarter by a share of order h; residuals of order ten are known to 1e-14.
        let (a, b) = (largest(a), largest(b));
        assert!(b <= 0.3 * a || b <= 1e-12, "{what}: {kind} leave {a:e} at h and {b:e} at h/2");
    }
}

#[test]
fn particles_with_constraints_move_as_the_minimiser() {
    let mut random = Random(11);
    let mut told = 0;
    for count in 1..=5 {
        for constraints in 0..=4 {
            let speeds = 3 * count;
            let choice = match (count + constraints) % 3 {
                0 => SpeedChoice::Rates,
                1 => SpeedChoice::Own,
                _ => SpeedChoice::Fewer(speeds / 2 + 1),
            };
            let free = if let SpeedChoice::Fewer(count) = choice { count } else { speeds };
            let constraints = constraints.min(free - 1);
            let what = format!("{count} particles, {choice:?}, {constraints} constraints");
            let attempt = |random: &mut Random| {
                let plan = Plan::particles(random, count, choice, constraints);
                check_whole(&plan, random, true, &what)
            };
            told += usize::from((0..4).any(|_| attempt(&mut random)));
        }
    }
    assert!(told >= 20, "only {told} of 25 systems could be told right from wrong");
}

#[test]
fn trees_move_as_the_minimiser_regrouped_or_not() {
    let mut random = Random(5);
    let mut told = 0;
    for trial in 0..18 {
        let shape = TreeShape {
            bodies: 2 + trial % 5,
            planar: trial % 4 == 3,
            rates: 7,
            choice: [SpeedChoice::Rates, SpeedChoice::Own, SpeedChoice::Fewer(3)][trial % 3],
            constraints: [0, 0, 1, 2][below(&mut random, 4)],
        };
        let attempt = |random: &mut Random| {
            let plan = Plan::tree(random, shape);
            let what = format!("trial {trial} of {shape:?}: {plan:?}");
            check_whole(&plan, random, true, &what) && check_whole(&plan, random, false, &format!("as given, {what}"))
        };
        told += usize::from((0..6).any(|_| attempt(&mut random)));
    }
    assert!(told >= 15, "only {told} of 18 trees could be told right from wrong");
}

/// Eliminated and whole at one state that satisfies the constraints.
fn check_elimination(plan: &Plan, random: &mut Random, what: &str) -> bool {
    let states = usable_states(plan, random);
    let Some(reduction) = states.first().and_then(|state| Reduction::choose(&DenseWitness::new(plan, state)?)) else {
        return false;
    };
    let states: Vec<WitnessState> =
        states.iter().filter_map(|state| reduction.satisfied(plan, state)).take(2).collect();
    if states.is_empty() {
        return false;
    }
    let graph = Graph::new();
    let symbols = PlanSymbols::new(&graph, plan);
    let all: Vec<usize> = (0..plan.speeds).collect();
    let whole = System::new(symbols.scene(plan, &symbols.speeds, &all, true));
    let residual_symbols = whole.constraints.residuals.clone();
    let elimination = Elimination::new(whole, &reduction.kept).unwrap_or_else(|error| panic!("{what}: {error:?}"));
    let system = System::new(elimination.reduced());
    let mut formulas = formulas_of(&system);
    if let Err(fault) = check_system_against_definition(&system, &Claims::of(&formulas)) {
        panic!("{what}: {fault:?}");
    }
    formulas.extend(elimination.formulas());
    let compiled = FormulaPrograms::new(&graph, &symbols, &formulas, what);
    let mut told = false;
    for state in states {
        let witness = DenseWitness::new(plan, &state).expect("a usable state");
        let rates = random_values(random, reduction.kept.len());
        let wanted = random_values(random, plan.constraints.len());
        let Some(expected) = of_reduced(&witness, plan, &reduction, &rates, &wanted) else { continue };
        let mut at = compiled.inputs(&symbols, &state);
        let momenta = &expected.iter().find(|e| e.method == Method::Momentum).expect("momenta").values;
        for (k, &kept) in reduction.kept.iter().enumerate() {
            at.insert(symbols.speed_rates[kept].key(), rates[k]);
            at.insert(symbols.momenta[kept].key(), momenta[k]);
        }
        // The values of speeds that were eliminated are not there to be read.
        let gone: Vec<u32> = reduction.eliminated.iter().map(|&k| symbols.speeds[k].key()).collect();
        let mut at: Map<u32, f64> = at.into_iter().filter(|(key, _)| !gone.contains(key)).collect();
        at.extend(residual_symbols.iter().map(|s| s.key()).zip(wanted));
        told |= compiled.compare(&at, &expected, what);
    }
    told
}

#[test]
fn eliminating_speeds_moves_as_the_multipliers_do() {
    let mut random = Random(23);
    let mut told = 0;
    for trial in 0..12 {
        let constraints = 1 + trial % 3;
        let attempt = |random: &mut Random| {
            let plan = if trial % 2 == 0 {
                Plan::particles(random, 2, [SpeedChoice::Rates, SpeedChoice::Own][trial / 2 % 2], 0)
            } else {
                let choice = [SpeedChoice::Rates, SpeedChoice::Own][trial / 2 % 2];
                Plan::tree(random, TreeShape { bodies: 2, planar: trial % 4 == 3, rates: 6, choice, constraints: 0 })
            };
            let constraints = constraints.min(plan.speeds - 1);
            if constraints == 0 {
                return false;
            }
            let plan = plan.with_affine_constraints(random, constraints);
            let what = format!("trial {trial}, {constraints} eliminated: {plan:?}");
            check_elimination(&plan, random, &what)
        };
        told += usize::from((0..6).any(|_| attempt(&mut random)));
    }
    assert!(told >= 9, "only {told} of 12 systems could be told right from wrong");
}

/// The jets of the witness against quotients of differences: they are what all else rests on.
#[test]
fn jets_differentiate() {
    use numbers::{Jet, Smooth};
    let mut random = Random(3);
    for _ in 0..20 {
        let function = Smooth::random(&mut random, 4, &[0, 1, 2]);
        let x = random_values(&mut random, 3);
        let (rate, second, side, side_rate) = (
            random_values(&mut random, 3),
            random_values(&mut random, 3),
            random_values(&mut random, 3),
            random_values(&mut random, 3),
        );
        let at = |tau: f64, sigma: f64| {
            let moved = |k: usize| {
                x[k] + tau * rate[k] + 0.5 * tau * tau * second[k] + sigma * side[k] + sigma * tau * side_rate[k]
            };
            function.at(&[0, 1, 2].map(|k| Jet::constant(moved(k)))).value
        };
        let jets = [0, 1, 2].map(|k| Jet {
            value: x[k],
            rate: rate[k],
            second: second[k],
            side: side[k],
            side_rate: side_rate[k],
        });
        let found = function.at(&jets);
        let h = 1e-3;
        let differences = [
            (at(h, 0.0) - at(-h, 0.0)) / (2.0 * h),
            (at(h, 0.0) - 2.0 * at(0.0, 0.0) + at(-h, 0.0)) / (h * h),
            (at(0.0, h) - at(0.0, -h)) / (2.0 * h),
            (at(h, h) - at(h, -h) - at(-h, h) + at(-h, -h)) / (4.0 * h * h),
        ];
        for (a, b) in [found.rate, found.second, found.side, found.side_rate].iter().zip(differences) {
            // Fourth derivatives of order ten to a hundred times h², roundings of order 1e-16 / h².
            assert!((a - b).abs() <= 1e-4 * (1.0 + a.abs()), "{function:?}: {a} against {b}");
        }
    }
}
