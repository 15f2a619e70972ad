//! Each pass against its input: same values, fewer operations.

use super::check::{CheckedPrograms, Sample};
use super::expected_outputs::ExpectedOutputs;
use super::factor::Factoriser;
use super::hoist::Hoister;
use super::passes::Passes;
use super::tangent::with_tangents;
use super::{Candidates, Counts, DerivativeRequest, Derivatives, Differentiation, Kernel, Program};
use crate::accuracy::Trial;
use crate::algebra::{BinaryFunction, Evaluation, Expr, Function, Graph, Map};
use crate::derivatives::{Direction, DirectionalDerivatives, Equation, ParametricDerivatives};
use crate::methods::{DerivativeKind, Methods};

/// A reproducible stream of small integers.
struct Random(u64);

impl Random {
    fn below(&mut self, n: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 33) % n
    }
}

/// A random expression in some symbols: sums, products, quotients, sines, groups.
fn random_expr<'g>(random: &mut Random, leaves: &[Expr<'g>], depth: u32) -> Expr<'g> {
    if depth == 0 {
        return leaves[random.below(leaves.len() as u64) as usize];
    }
    let mut child = || random_expr(random, leaves, depth - 1);
    let (a, b, c) = (child(), child(), child());
    match random.below(7) {
        0 | 1 => a + b.scale(3.into()) - c,
        2 | 3 => a * b - b * c,
        4 => (a * b + a * c).group() * b,
        // Squares keep denominators away from zero.
        5 => a * (a.graph().one() + b * b).recip(),
        _ => a.sin() + b * c.cos(),
    }
}

fn point_of<'g>(graph: &'g Graph, definitions: &Map<u32, Expr<'g>>) -> Map<u32, f64> {
    Sample { definitions, units: &[], literals: &Map::default(), folded: &[] }.point(graph, 0)
}

/// A kernel whose methods have no outputs.
fn nothing<'g>() -> Methods<Candidates<'g>> {
    let none = || Candidates::of_values(vec![Vec::new()]);
    Methods {
        kinematics: none(),
        acceleration: none(),
        momentum: none(),
        velocity: none(),
        momentum_rate: none(),
        mass_matrix: none(),
        kinetic_energy: none(),
        potential_energy: none(),
        gauss_residual: none(),
        constraint_function: none(),
        others: Vec::new(),
    }
}

/// A kernel of one function, with some derivatives.
fn lowered<'g>(
    graph: &'g Graph,
    arrangements: Vec<Vec<Expr<'g>>>,
    definitions: &Map<u32, Expr<'g>>,
    list: &[DerivativeRequest<'g>],
) -> Kernel<'g> {
    let functions = Methods { acceleration: Candidates::of_values(arrangements), ..nothing() };
    let wanted = Derivatives { list, units: &[] };
    Kernel::lower(graph, &functions, definitions, &wanted, None, &mut Trial::default(), Passes::default())
        .expect("a program")
}

#[test]
fn every_pass_keeps_the_values_of_random_expressions() {
    for seed in 0..300 {
        let graph = Graph::new();
        let names = ["a", "b", "c", "p", "q"];
        // Two parameters, three arguments.
        let leaves: Vec<Expr<'_>> = names.iter().enumerate().map(|(k, n)| graph.symbol(*n, *n, k < 2)).collect();
        let mut random = Random(seed);
        let outputs: Vec<Expr<'_>> = (0..3).map(|_| random_expr(&mut random, &leaves, 3)).collect();
        let point = point_of(&graph, &Map::default());
        let values = |outputs: &[Expr<'_>], point: &Map<u32, f64>| -> Vec<f64> {
            let mut evaluation = Evaluation::new(point);
            outputs.iter().map(|e| evaluation.value(*e)).collect()
        };
        let expected = values(&outputs, &point);
        let close = |what: &str, found: &[f64]| {
            for (x, y) in expected.iter().zip(found) {
                // Three levels of at most ten operations each.
                assert!((x - y).abs() <= 1e-12 * (1.0 + x.abs()), "{what}, seed {seed}: {x} became {y}");
            }
        };
        let definitions = Map::default();
        let mut hoister = Hoister::new(&graph, &definitions, Passes::default());
        let hoisted = hoister.hoist(&outputs);
        let mut with_constants = point.clone();
        for &(symbol, definition) in hoister.constants() {
            let value = values(&[definition], &point)[0];
            with_constants.insert(symbol.key(), value);
        }
        close("hoisting", &values(&hoisted, &with_constants));
        let mut factoring = Factoriser::default();
        let factored: Vec<Expr<'_>> = hoisted.iter().map(|e| factoring.rewrite(*e)).collect();
        close("factoring", &values(&factored, &with_constants));
        let program = Program::lower(&hoisted);
        let results = program.run(&with_constants);
        close("the program", &results);
        assert_eq!(program.with_signs_led_back().run(&with_constants), results, "signs, seed {seed}");
    }
}

fn counts(outputs: &[Expr<'_>]) -> Counts {
    Program::lower(outputs).counts()
}

#[test]
fn common_parts_are_computed_once() {
    let graph = Graph::new();
    let [a, b, c, d] = ["a", "b", "c", "d"].map(|n| graph.symbol(n, n, false));
    let operations = |additions, multiplications, divisions, transcendentals| Counts {
        additions,
        multiplications,
        divisions,
        roots: 0,
        transcendentals,
    };
    // a·b + a·c + a·d = a·(b + c + d).
    assert_eq!(counts(&[a * b + a * c + a * d]), operations(2, 1, 0, 0));
    // The product of two factors and the sum of two terms are shared between outputs.
    assert_eq!(counts(&[a * b * c, a * b * d]), operations(0, 3, 0, 0));
    assert_eq!(counts(&[a + b + c, (a + b - d).scale(5.into())]), operations(3, 1, 0, 0));
    // One denominator is divided by once; a single quotient is a division.
    assert_eq!(counts(&[a * d.recip(), b * d.recip(), c * d.recip()]), operations(0, 3, 1, 0));
    assert_eq!(counts(&[a * d.recip()]), operations(0, 0, 1, 0));
    // Sine and cosine of one angle are one call.
    assert_eq!(counts(&[a.sin() * a.cos()]), operations(0, 1, 0, 2));
    // b − a and a − b are one node and a sign.
    assert_eq!(counts(&[a - b, b - a]), operations(1, 0, 0, 0));
    // Powers by repeated squaring where the square is there anyway.
    assert_eq!(counts(&[a.powi(2), a.powi(4)]), operations(0, 2, 0, 0));
    // Parts that become alike only when others were split off.
    assert_eq!(counts(&[a * b * c + d, a * b * c * d, a * b]), operations(1, 3, 0, 0));
}

/// −(a b − c − d²) is c + d² − a b; what another output reads as well keeps its sign.
#[test]
fn signs_are_led_to_where_they_cost_nothing() {
    let graph = Graph::new();
    let [a, b, c, d] = ["a", "b", "c", "d"].map(|n| graph.symbol(n, n, false));
    let results = |program: &Program<'_>| {
        let negations = program.outputs.iter().filter(|output| match output {
            super::Operand::Value(k) => matches!(program.instructions[*k], super::Operation::Negate(_)),
            _ => false,
        });
        negations.count()
    };
    let one = Program::lower(&[-(a * b - c * d - d * d)]);
    let both = Program::lower(&[a * b - c, c - a * b]);
    assert_eq!([results(&one), results(&both)], [1, 1]);
    assert_eq!([results(&one.with_signs_led_back()), results(&both.with_signs_led_back())], [0, 1]);
}

#[test]
fn what_depends_on_parameters_alone_is_a_constant() {
    let graph = Graph::new();
    let [m, i1, i2] = ["m", "I1", "I2"].map(|n| graph.symbol(n, n, true));
    let [x, y] = ["x", "y"].map(|n| graph.symbol(n, n, false));
    let outputs = vec![(i1 - i2) * m.recip() * x + (i2 - i1) * m.recip() * y];
    let kernel = lowered(&graph, vec![outputs], &Map::default(), &[]);
    // One constant serves both terms, up to its sign.
    assert_eq!(kernel.constant_symbols.len(), 1);
    assert_eq!(
        kernel.functions.acceleration.program.counts(),
        Counts { additions: 1, multiplications: 1, ..Counts::default() }
    );
}

#[test]
fn the_cheapest_arrangement_is_taken() {
    let graph = Graph::new();
    let [a, b, c] = ["a", "b", "c"].map(|n| graph.symbol(n, n, false));
    let wide = vec![a * a.cos().powi(2) * b + a * a.sin().powi(2) * b + c];
    let narrow = vec![a * b + c];
    let kernel = lowered(&graph, vec![wide, narrow], &Map::default(), &[]);
    assert_eq!(kernel.functions.acceleration.program.counts().transcendentals, 0);
}

#[test]
fn a_program_that_computes_something_else_is_refused() {
    let graph = Graph::new();
    let [a, b] = ["a", "b"].map(|n| graph.symbol(n, n, false));
    let sample = Sample { definitions: &Map::default(), units: &[], literals: &Map::default(), folded: &[] };
    let (constants, outputs) = (Program::nothing(), [a + b]);
    let refused = |program: &Program<'_>| {
        let functions = vec![(program, ExpectedOutputs::of(&outputs))];
        let checked = CheckedPrograms { constants: &constants, constant_symbols: &[], functions, derivatives: &[] };
        checked.check(&graph, &sample).is_err()
    };
    assert_eq!([Program::lower(&[a + b]), Program::lower(&[a - b])].map(|program| refused(&program)), [false, true]);
}

/// Values and derivatives along each direction by the symbolic derivatives of the expressions.
fn symbolic(outputs: &[Expr<'_>], directions: &[Direction<'_>], point: &Map<u32, f64>) -> Vec<f64> {
    let mut evaluation = Evaluation::new(point);
    let mut values: Vec<f64> = outputs.iter().map(|e| evaluation.value(*e)).collect();
    for direction in directions {
        let rates: Map<u32, Expr<'_>> = direction.iter().map(|(symbol, rate)| (symbol.key(), *rate)).collect();
        values.extend(outputs.iter().map(|e| evaluation.value(e.derivative(&rates))));
    }
    values
}

#[test]
fn tangents_are_the_derivatives_of_the_expressions() {
    for seed in 0..300 {
        let graph = Graph::new();
        let names = ["a", "b", "c", "p", "q"];
        let leaves: Vec<Expr<'_>> = names.iter().map(|n| graph.symbol(*n, *n, false)).collect();
        let mut random = Random(seed);
        let mut outputs: Vec<Expr<'_>> = (0..2).map(|_| random_expr(&mut random, &leaves, 2)).collect();
        let [a, b] = [outputs[0], outputs[1]];
        let square = graph.one() + a * a;
        outputs.extend([square.sqrt() * b.exp(), square.ln() - a, a.binary(BinaryFunction::Atan2, square + b * b)]);
        outputs.extend([a.binary(BinaryFunction::Max, b), a.binary(BinaryFunction::Min, b) * b]);
        outputs.extend([Function::Abs, Function::Signum].map(|f| graph.call(f, a) * b));
        let directions = vec![
            vec![(leaves[0], graph.one())],
            vec![(leaves[1], -leaves[4]), (leaves[2], leaves[1]), (leaves[3], graph.integer(-1))],
            vec![],
        ];
        let none = Program::lower(&[]);
        let program = with_tangents(&Program::lower(&outputs), (&[], &none), &directions);
        let point = point_of(&graph, &Map::default());
        let expected = symbolic(&outputs, &directions, &point);
        for (k, (x, y)) in expected.iter().zip(program.run(&point)).enumerate() {
            // Two levels of at most ten operations each, and their derivatives; exponentials are steep.
            assert!((x - y).abs() <= 1e-11 * (1.0 + x.abs()), "seed {seed}, {k}: {x} became {y}");
        }
        // Nothing moves in the last direction: its outputs are numbers.
        assert!(program.outputs[3 * outputs.len()..].iter().all(|o| *o == super::Operand::Number(0.into())));
    }
}

#[test]
fn tangents_cost_what_the_chain_rule_costs() {
    let graph = Graph::new();
    let [a, b, c] = ["a", "b", "c"].map(|n| graph.symbol(n, n, false));
    let counts = |outputs: &[Expr<'_>], symbols: &[Expr<'_>]| {
        let directions: Vec<Direction<'_>> = symbols.iter().map(|&s| vec![(s, graph.one())]).collect();
        with_tangents(&Program::lower(outputs), (&[], &Program::lower(&[])), &directions).counts()
    };
    let operations = |additions, multiplications| Counts { additions, multiplications, ..Counts::default() };
    // (a b + c)˙ is b, a and 1, which are there.
    assert_eq!(counts(&[a * b + c], &[a, b, c]), operations(1, 1));
    // (a b c)˙: two more products, since one of two factors is there.
    assert_eq!(counts(&[a * b * c], &[a, b, c]), operations(0, 4));
    // What both directions need is written once: 1/b and a/b.
    assert_eq!(counts(&[a * b.recip()], &[a, b]), Counts { multiplications: 1, divisions: 2, ..Counts::default() });
}

/// R (three entries of it) is defined by other arguments, and moves by rates of its own.
#[test]
fn what_is_defined_moves_by_its_own_rates() {
    let graph = Graph::new();
    let [x, y, r, s] = ["x", "y", "r", "s"].map(|n| graph.symbol(n, n, false));
    let definitions = Map::from_iter([(r.key(), x * x - y * y), (s.key(), x * y + x * y)]);
    let outputs = vec![r * r + s * y, s];
    let wanted = DirectionalDerivatives {
        arrangements: vec![outputs.clone()],
        defined: vec![r, s],
        directions: vec![vec![(r, -s), (s, r)], vec![(y, graph.one())]],
        derived: Vec::new(),
    };
    let directions = wanted.directions.clone();
    let by_state =
        DerivativeRequest { kind: DerivativeKind::ByState, differentiation: Differentiation::WithValues(wanted) };
    let kernel = lowered(&graph, vec![outputs.clone()], &definitions, &[by_state]);
    let point = point_of(&graph, &definitions);
    let expected = symbolic(&outputs, &directions, &point);
    let found = kernel.derivative(DerivativeKind::ByState).expect("it is wanted").program.run(&point);
    for (a, b) in expected.iter().zip(found) {
        assert!((a - b).abs() <= 1e-13 * (1.0 + a.abs()), "{a} {b}");
    }
}

/// Accelerations by parameters, as they are computed and as the root of their equation: (m + n) a = f − k l x, v = n x.
#[test]
fn parameters_move_constants() {
    let graph = Graph::new();
    let [m, n, k, l] = ["m", "n", "k", "l"].map(|n| graph.symbol(n, n, true));
    let [x, f, a, p] = ["x", "f", "a", "p"].map(|n| graph.symbol(n, n, false));
    let force = f - k * l * x;
    let acceleration = force * (m + n).recip();
    let function = |output| Candidates::of_values(vec![vec![output]]);
    let functions = Methods {
        kinematics: function(n * x),
        acceleration: function(acceleration),
        gauss_residual: function((m + n) * a - force),
        velocity: function(p * (m + n).recip()),
        ..nothing()
    };
    let parameters = [m, n, k, l];
    let directions: Vec<Direction<'_>> = parameters.iter().map(|&e| vec![(e, graph.one())]).collect();
    let point = point_of(&graph, &Map::default());
    let expected = symbolic(&[n * x, acceleration], &directions, &point);
    for equation in [None, Some(Equation { unknowns: vec![a], loads: vec![p] })] {
        let (parameters, derived) = (parameters.to_vec(), Vec::new());
        let by_parameters = ParametricDerivatives { parameters, order: vec![0], equation, derived };
        let differentiation = Differentiation::ByParameters(by_parameters);
        let list = [DerivativeRequest { kind: DerivativeKind::ByParameters, differentiation }];
        let wanted = Derivatives { list: &list, units: &[] };
        let kernel =
            Kernel::lower(&graph, &functions, &Map::default(), &wanted, None, &mut Trial::default(), Passes::default());
        let kernel = kernel.expect("a program");
        let mut values = point.clone();
        let constants = kernel.constants.run(&point);
        values.extend(kernel.constant_symbols.iter().zip(constants).map(|(symbol, value)| (symbol.key(), value)));
        let program = &kernel.derivative(DerivativeKind::ByParameters).expect("it is wanted").program;
        for (x, y) in expected[2..].iter().zip(program.run(&values)) {
            assert!((x - y).abs() <= 1e-13 * (1.0 + x.abs()), "{x} {y}");
        }
        // The velocity depends on n alone, and as x does.
        let number = |value: i64| super::Operand::Number(value.into());
        let of_velocity: Vec<_> = program.outputs.iter().step_by(2).copied().collect();
        assert_eq!(of_velocity, [number(0), super::Operand::Input(x), number(0), number(0)]);
    }
}
