//! Each pass against its input: same values, fewer operations.

use super::factor::Factoring;
use super::hoist::Hoister;
use super::{Candidates, Counts, Kernel, Program, sample_point};
use crate::algebra::{Evaluation, Expr, Graph, Map};

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

#[test]
fn every_pass_keeps_the_values_of_random_expressions() {
    for seed in 0..300 {
        let graph = Graph::new();
        let names = ["a", "b", "c", "p", "q"];
        // Two parameters, three arguments.
        let leaves: Vec<Expr<'_>> = names.iter().enumerate().map(|(k, n)| graph.symbol(*n, *n, k < 2)).collect();
        let mut random = Random(seed);
        let outputs: Vec<Expr<'_>> = (0..3).map(|_| random_expr(&mut random, &leaves, 3)).collect();
        let point = sample_point(&graph, 0, &Map::default());
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
        let mut hoister = Hoister::new(&graph, &definitions);
        let hoisted = hoister.hoist(&outputs);
        let mut with_constants = point.clone();
        for (symbol, definition) in hoister.into_constants() {
            let value = values(&[definition], &point)[0];
            with_constants.insert(symbol.key(), value);
        }
        close("hoisting", &values(&hoisted, &with_constants));
        let mut factoring = Factoring::default();
        let factored: Vec<Expr<'_>> = hoisted.iter().map(|e| factoring.rewrite(*e)).collect();
        close("factoring", &values(&factored, &with_constants));
        close("the program", &Program::lower(&hoisted).run(&with_constants));
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

#[test]
fn what_depends_on_parameters_alone_is_a_constant() {
    let graph = Graph::new();
    let [m, i1, i2] = ["m", "I1", "I2"].map(|n| graph.symbol(n, n, true));
    let [x, y] = ["x", "y"].map(|n| graph.symbol(n, n, false));
    let outputs = vec![(i1 - i2) * m.recip() * x + (i2 - i1) * m.recip() * y];
    let kernel =
        Kernel::lower(&graph, &[Candidates::of_values(vec![outputs])], &Map::default(), None).expect("a program");
    // One constant serves both terms, up to its sign.
    assert_eq!(kernel.constant_symbols.len(), 1);
    assert_eq!(kernel.functions[0].counts(), Counts { additions: 1, multiplications: 1, ..Counts::default() });
}

#[test]
fn the_cheapest_arrangement_is_taken() {
    let graph = Graph::new();
    let [a, b, c] = ["a", "b", "c"].map(|n| graph.symbol(n, n, false));
    let wide = vec![a * a.cos().powi(2) * b + a * a.sin().powi(2) * b + c];
    let narrow = vec![a * b + c];
    let kernel =
        Kernel::lower(&graph, &[Candidates::of_values(vec![wide, narrow])], &Map::default(), None).expect("a program");
    assert_eq!(kernel.functions[0].counts().transcendentals, 0);
}

#[test]
fn a_program_that_computes_something_else_is_refused() {
    let graph = Graph::new();
    let [a, b] = ["a", "b"].map(|n| graph.symbol(n, n, false));
    let mut kernel =
        Kernel::lower(&graph, &[Candidates::of_values(vec![vec![a + b]])], &Map::default(), None).expect("a program");
    kernel.functions[0] = Program::lower(&[a - b]);
    assert!(kernel.check(&graph, &[&vec![a + b]], &Map::default(), None).is_err());
}
