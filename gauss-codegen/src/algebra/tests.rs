//! Algebra against itself and against numbers.

use super::Map;
use super::ideal::Ideal;
use super::{
    BinaryFunction, Evaluation, Expr, Graph, Notation, Parts, Rational, Solver, inverse_of_symmetric, print,
    print_parts, print_with,
};

fn symbols<'g, const N: usize>(graph: &'g Graph, names: [&str; N]) -> [Expr<'g>; N] {
    names.map(|name| graph.symbol(name, name, false))
}

fn text(e: Expr<'_>) -> String {
    print(e, Notation::Text)
}

#[test]
fn equal_expressions_are_one_node() {
    let graph = Graph::new();
    let [a, b, c] = symbols(&graph, ["a", "b", "c"]);
    assert_eq!(a + b + c, c + (b + a));
    assert_eq!(a * (b * c), (c * a) * b);
    assert_eq!((a - b) * (b - a).recip(), graph.integer(-1));
    assert_eq!((a + a).half(), a);
    assert!((a * b - b * a).is_zero());
    assert_eq!((-a).sin(), -a.sin());
    assert_eq!((-a).cos(), a.cos());
}

#[test]
fn groups_give_up_their_common_factors_and_nothing_else() {
    let graph = Graph::new();
    let [m, a, b] = symbols(&graph, ["m", "a", "b"]);
    let grouped = (m * a + m * b).group();
    assert_eq!(grouped * m.recip(), (a + b).group());
    // A sum around a group does not take it apart, the normal form does.
    assert_ne!((a + b).group() - a, b);
    assert_eq!(((a + b).group() - a).collected(10), b);
}

/// 0.088 a + b stays that: as 11 a + 125 b, with 1/125 in front, every term would be multiplied by a number.
#[test]
fn groups_give_up_numbers_that_all_terms_have() {
    let graph = Graph::new();
    let [a, b] = symbols(&graph, ["a", "b"]);
    let fraction = |p, q| Rational::new(p, q);
    let grouped = |x, y| (a.scale(x) + b.scale(y)).group().split_coefficient().0;
    assert_eq!(grouped(fraction(11, 125), fraction(1, 1)), fraction(1, 1));
    assert_eq!(grouped(fraction(11, 125), fraction(-22, 125)), fraction(11, 125));
    assert_eq!(grouped(fraction(-6, 1), fraction(4, 1)), fraction(-2, 1));
    assert_eq!(grouped(fraction(3, 4), fraction(5, 6)), fraction(1, 2));
}

#[test]
fn normal_forms_decide_identities() {
    let graph = Graph::new();
    let [x, y] = symbols(&graph, ["x", "y"]);
    let zero = |e: Expr<'_>| e.expand(1000).is_some_and(|p| p.is_zero());
    assert!(zero((x + y).powi(3) - x.powi(3) - y.powi(3) - graph.integer(3) * x * y * (x + y)));
    assert!(zero(x.sin().powi(2) + x.cos().powi(2) - graph.one()));
    assert!(zero((x + y).sin().powi(4) - (graph.one() - (y + x).cos().powi(2)).powi(2)));
    // Denominators: (x² − y²)/(x − y) = x + y, and 1/(1 + x²) + x²/(1 + x²) = 1.
    assert!(zero((x.powi(2) - y.powi(2)) * (x - y).recip() - x - y));
    let norm = graph.one() + x.powi(2);
    assert!(zero(norm.recip() + x.powi(2) * norm.recip() - graph.one()));
    assert!(!zero(norm.recip() - graph.one()));
    // Too long is said, not computed.
    assert!((x + y).powi(9).expand(5).is_none());
}

/// A sine made before its cosine, both in a denominator: `cos² → 1 − sin²` and the rule of the denominator must not
/// undo one another.
#[test]
fn rewriting_sines_in_denominators_ends() {
    let graph = Graph::new();
    let [x] = symbols(&graph, ["x"]);
    let (sin, cos) = (x.sin(), x.cos());
    let zero = |e: Expr<'_>| e.expand(1000).is_some_and(|p| p.is_zero());
    let sum = sin.powi(2) + sin * cos;
    let quotient = sin * cos.powi(2) * sum.recip();
    assert!(quotient.expand(1000).is_some());
    // It is s c² = s − s³ on the other side too.
    assert!(zero(quotient - (sin - sin.powi(3)) * sum.recip()));
}

/// (x^p)˙ = p x^(p − 1) ẋ + x^p ln x ṗ, and nothing where x is 0.
#[test]
fn exponents_move_as_well() {
    let graph = Graph::new();
    let [x, p] = symbols(&graph, ["x", "p"]);
    let f = x.binary(BinaryFunction::Powf, p);
    let value = |e: Expr<'_>, base: f64| Evaluation::new(&Map::from_iter([(x.key(), base), (p.key(), 1.5)])).value(e);
    assert!((value(f.partial(p), 2.0) - 2.0_f64.powf(1.5) * 2.0_f64.ln()).abs() < 1e-15);
    assert_eq!(value(f.partial(p), 0.0), 0.0);
    assert!((value(f.partial(x), 2.0) - 1.5 * 2.0_f64.sqrt()).abs() < 1e-15);
}

#[test]
fn derivatives_agree_with_differences() {
    let graph = Graph::new();
    let [x, y] = symbols(&graph, ["x", "y"]);
    let f = (x * y).sin() * (graph.one() + x.powi(2) * y).recip() + (y - x).cos().powi(3);
    let at = |dx: f64| Map::from_iter([(x.key(), 0.7 + dx), (y.key(), 1.3)]);
    let value = |e: Expr<'_>, dx: f64| Evaluation::new(&at(dx)).value(e);
    let h = 1e-5;
    let difference = (value(f, h) - value(f, -h)) / (2.0 * h);
    // Central differences: h²·f‴/6 is about 1e-9 here, rounding 1e-11.
    assert!((value(f.partial(x), 0.0) - difference).abs() < 1e-8);
    // Along a flow: df/dt = ∂f/∂x ẋ + ∂f/∂y ẏ.
    let rates = Map::from_iter([(x.key(), y), (y.key(), -x)]);
    let chain = f.partial(x) * y - f.partial(y) * x;
    assert!((value(f.derivative(&rates), 0.0) - value(chain, 0.0)).abs() < 1e-14);
}

#[test]
fn the_ideal_of_rotations_has_the_functions_of_so3_left_over() {
    let graph = Graph::new();
    let names: Vec<String> = (0..9).map(|k| format!("r{k}")).collect();
    let entries: Vec<Expr<'_>> = names.iter().map(|n| graph.symbol(n.as_str(), n.as_str(), false)).collect();
    let r: [[Expr<'_>; 3]; 3] = std::array::from_fn(|i| std::array::from_fn(|j| entries[3 * i + j]));
    let ideal = Ideal::of_rotation(&graph, &r);
    // det R = 1 follows from what was put in.
    let minor = |i: usize, j: usize| r[1][i] * r[2][j] - r[1][j] * r[2][i];
    let det = r[0][0] * minor(1, 2) - r[0][1] * minor(0, 2) + r[0][2] * minor(0, 1);
    assert!(ideal.annihilates(det - graph.one()));
    assert!(!ideal.annihilates(r[0][0] - graph.one()));
    // Peter–Weyl: polynomials of degree d on SO(3) modulo lower ones have dimension (2d + 1)².
    let mut monomials = vec![graph.one()];
    for degree in 1..=3 {
        let mut next: Vec<Expr<'_>> = monomials.iter().flat_map(|m| entries.iter().map(move |e| *m * *e)).collect();
        next.sort_by_key(|e| e.key());
        next.dedup();
        monomials = next;
        let standard = monomials
            .iter()
            .filter(|m| {
                let p = m.expand(10).expect("a monomial");
                ideal.reduce(&p) == p
            })
            .count();
        assert_eq!(standard, (2 * degree + 1) * (2 * degree + 1), "degree {degree}");
    }
}

#[test]
fn linear_systems_are_solved_block_by_block() {
    let graph = Graph::new();
    let [a, b, c, p, q, r] = symbols(&graph, ["a", "b", "c", "p", "q", "r"]);
    let (zero, one) = (graph.zero(), graph.one());
    // A rotation in the first two unknowns: its determinant must collapse to one.
    let matrix = vec![vec![a.cos(), -a.sin(), zero], vec![a.sin(), a.cos(), zero], vec![b, c, one]];
    let x = Solver::new(matrix.clone()).expect("regular").solve(&[p, q, r]);
    let back = |row: &Vec<Expr<'_>>, right: Expr<'_>| {
        let sum: Expr<'_> = row.iter().zip(&x).map(|(m, x)| *m * *x).sum();
        (sum - right).expand(1000).is_some_and(|e| e.is_zero())
    };
    assert!(back(&matrix[0], p) && back(&matrix[1], q) && back(&matrix[2], r));
    assert_eq!(x[0].collected(100), a.cos() * p + a.sin() * q);
    assert!(Solver::new(vec![vec![a, a], vec![b, b]]).is_none());
}

#[test]
fn inverses_of_symmetric_matrices_invert() {
    let graph = Graph::new();
    let [a, b, c, d] = ["a", "b", "c", "d"].map(|n| graph.symbol(n, n, true));
    let zero = graph.zero();
    let matrix = vec![vec![a, b, zero], vec![b, c, zero], vec![zero, zero, d]];
    let inverse = inverse_of_symmetric(&matrix);
    assert_eq!(inverse[2][2], d.recip());
    assert!(inverse[0][2].is_zero());
    let at = Map::from_iter([(a.key(), 2.0), (b.key(), 0.5), (c.key(), 3.0), (d.key(), 4.0)]);
    let mut evaluation = Evaluation::new(&at);
    for i in 0..3 {
        for j in 0..3 {
            let product: f64 = (0..3).map(|k| evaluation.value(matrix[i][k]) * evaluation.value(inverse[k][j])).sum();
            let expected = if i == j { 1.0 } else { 0.0 };
            assert!((product - expected).abs() < 1e-15);
        }
    }
}

#[test]
fn coefficients_beyond_64_bits_stay_exact() {
    let graph = Graph::new();
    let [x] = symbols(&graph, ["x"]);
    let large = graph.integer(i64::MAX);
    let twice = large * x + large * x;
    assert!((twice - x.scale(Rational::from_integer(i64::MAX)) - large * x).is_zero());
    assert_eq!(text(twice), "1.8446744073709552e19*x");
    let third = Rational::new(1, 3);
    for exponent in [2, 30, 41, 300] {
        let power = third.pow(exponent);
        assert_eq!(power * Rational::from_integer(3).pow(exponent), Rational::one(), "{exponent}");
        assert_eq!(power.recip(), third.pow(-exponent));
        assert_eq!(power.common_divisor(third), power);
        assert!(power < third && -third < -power && power.pow(2) < power);
        assert_eq!(power.plus(third) - power, third);
    }
    assert_eq!(Rational::new(i64::MIN, 1), -(Rational::from_integer(i64::MAX).plus(Rational::one())));
    assert_eq!(Rational::new(6, -4), Rational::new(-3, 2));
    assert_eq!(Rational::new(1, 6).common_divisor(Rational::new(3, 4)), Rational::new(1, 12));
    assert!(Rational::new(1, 3) < Rational::new(1, 2));
    assert!(!graph.is_undefined());
}

/// One tenth and the like, as if they were read from digits.
#[test]
fn fractions_become_the_nearest_double() {
    for (numerator, exponent) in [(1, 1), (12_345_678_901_234_567, 17), (i64::MAX, 18), (9_007_199_254_740_993, 0)] {
        for power in [-280, -40, -1, 0, 1, 40, 200] {
            let value = Rational::from_integer(numerator) * Rational::from_integer(10).pow(power - exponent);
            let expected: f64 = format!("{numerator}e{}", power - exponent).parse().expect("a number");
            assert_eq!(value.to_f64(), expected);
            assert_eq!((-value).to_f64(), -expected);
        }
    }
}

/// Longer fractions than anybody has digits for are rounded, far below double precision; nothing grows without bound.
#[test]
fn fractions_have_bounded_length() {
    let mut power = Rational::new(999, 1000);
    for _ in 0..12 {
        power = power * power;
        let exact = 0.999_f64.powi(4096);
        assert!(power.to_f64() > 0.9 * exact);
    }
    assert!((power.to_f64() / 0.999_f64.powi(4096) - 1.0).abs() < 1e-12);
    assert_eq!(power.plus(power) - power, power);
    // Beyond any use in double precision: without a value, at once.
    assert!(Rational::new(1, 3).pow(i32::MAX).is_undefined());
    assert!(Rational::new(1, 3).pow(i32::MIN).is_undefined());
    assert!(Rational::zero().recip().is_undefined());
    let graph = Graph::new();
    let _ = graph.zero().recip();
    assert!(graph.is_undefined());
}

#[test]
fn printing_reads_like_a_textbook() {
    let graph = Graph::new();
    let [i1, i3] = ["I1", "I3"].map(|n| graph.symbol(n, n, true));
    let [w1, w3] = symbols(&graph, ["w1", "w3"]);
    let e = (i3 * w1 * w3 - i1 * w1 * w3).collected(10);
    assert_eq!(text(e), "(I3 - I1)*w1*w3");
    assert_eq!(text((w1 - w3).half()), "w1/2 - w3/2");
    assert_eq!(text(w1.powi(-2) * w3), "w3/w1^2");
    assert_eq!(text((w1 + w3).recip()), "1/(w1 + w3)");
    assert_eq!(print((w1 * w3.recip()).half(), Notation::Latex), "\\frac{w1}{2 \\, w3}");
    assert_eq!(print((w1 + w3).sin(), Notation::Latex), "\\sin\\left(w1 + w3\\right)");
}

#[test]
fn common_parts_have_names_where_rows_are_long() {
    let graph = Graph::new();
    let [x, y] = ["x", "y"].map(|name| graph.symbol(name, name, false));
    let mut part = x * y + x + y;
    for _ in 0..40 {
        part = part.sin() * part.group() + x;
    }
    let short = (x + y).sin();
    let parts = Parts::of(&[(None, part), (Some(["v".into(), "v".into()]), short), (None, (x + y).group() * part)]);
    // As a tree it has 2⁴⁰ terms.
    assert!(print_with(part, Notation::Text, &parts).len() < 10);
    assert!(print_parts(Notation::Text, &parts).iter().all(|(_, value)| value.len() < 30));
    assert_eq!(
        print_parts(Notation::Latex, &parts)[1],
        ("s_{2}".into(), "x + \\sin\\left(s_{1}\\right) \\, s_{1}".into())
    );
    assert_eq!(print_with(short, Notation::Text, &parts), "sin(x + y)");
}
