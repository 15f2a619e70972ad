//! Each operation alone, on operands with bounds and on extreme magnitudes.

use gauss_bounded::{Lift, exact, measured, rounded};
use gauss_runtime::prelude::*;
use gauss_tests::double_double::DoubleDouble;

use crate::common::Bounded;
use crate::compare::{Random, error};

type Unary = (&'static str, fn(Bounded) -> Bounded, fn(DoubleDouble) -> DoubleDouble);
type Binary = (&'static str, fn(Bounded, Bounded) -> Bounded, fn(DoubleDouble, DoubleDouble) -> DoubleDouble);

macro_rules! both {
    ($($name:ident)+) => { [$((stringify!($name), Real::$name, Real::$name)),+] };
}

/// Positive or signed numbers of any size between 10^±`decades`.
fn spread(random: &mut Random, decades: f64) -> f64 {
    let size = 10.0_f64.powf(decades * random.next());
    if random.next() < 0.0 { -size } else { size }
}

/// A number with a bound of any size, and an exact number within it, often at its ends.
fn operand(random: &mut Random, value: f64) -> (Bounded, DoubleDouble) {
    let bound = match random.below(4) {
        0 => 0.0,
        1 => value.abs() * 10.0_f64.powf(-8.0 + 8.0 * random.next()),
        2 => value.abs() * random.next().abs(),
        _ => 10.0_f64.powf(-8.0 + 8.0 * random.next()),
    };
    let place = [-1.0, 1.0, random.next()][random.below(3)];
    let exact = DoubleDouble::new(value) + DoubleDouble::new(bound) * DoubleDouble::new(place);
    (Bounded::measured(value, bound), exact)
}

#[track_caller]
fn covers(what: &str, found: Bounded, exact: DoubleDouble, operands: &dyn std::fmt::Debug) {
    assert!(found.bound >= 0.0, "{what}: {found:?}");
    if exact.is_finite() && found.value.is_finite() {
        let error = error(found.value, exact);
        // Numbers of 31 digits are themselves off by little.
        let allowed = found.bound * (1.0 + 1e-12) + 1e-29 * exact.high.abs();
        assert!(error <= allowed, "{what} of {operands:?} is {found:?}, off by {error:e}");
    } else if !found.value.is_finite() {
        assert_eq!(found.bound, f64::INFINITY, "{what} of {operands:?}");
    }
}

#[test]
fn functions_of_one_number_are_covered() {
    let functions: [Unary; 15] = both!(sqrt sin cos tan asin acos atan sinh cosh tanh exp ln abs recip signum);
    let powers: [Unary; 2] = [("cube", |x| x.powi(3), |x| x.powi(3)), ("power −2", |x| x.powi(-2), |x| x.powi(-2))];
    let mut random = Random(1);
    for _ in 0..20_000 {
        let value = spread(&mut random, 3.0);
        let (bounded, exact) = operand(&mut random, value);
        for (name, function, truth) in functions.into_iter().chain(powers) {
            let inside = match name {
                "sqrt" | "ln" => exact.high > 0.0,
                "asin" | "acos" => exact.high.abs() < 1.0,
                // 31 digits of sine and exponential need arguments that are not large.
                "sin" | "cos" | "tan" => exact.high.abs() < 100.0,
                "sinh" | "cosh" | "tanh" | "exp" => exact.high.abs() < 300.0,
                "recip" | "power −2" => exact.high != 0.0,
                _ => true,
            };
            if inside {
                covers(name, function(bounded), truth(exact), &(bounded, exact));
            }
        }
    }
}

#[test]
fn functions_near_their_ends_are_covered() {
    let mut random = Random(2);
    for _ in 0..20_000 {
        let near = 10.0_f64.powf(-8.0 + 8.0 * random.next());
        let bound = near * 10.0_f64.powf(2.0 * random.next());
        let at = |value: f64, place: f64| {
            let exact = DoubleDouble::new(value) + DoubleDouble::new(bound) * DoubleDouble::new(place);
            (Bounded::measured(value, bound), exact)
        };
        let place = [-1.0, 1.0, random.next()][random.below(3)];
        let (x, exact) = at(near, place);
        if exact.high >= 0.0 {
            covers("sqrt", x.sqrt(), exact.sqrt(), &x);
        }
        for value in [1.0 - near, near - 1.0] {
            let (x, exact) = at(value, place);
            if exact.high.abs() <= 1.0 {
                covers("asin", x.asin(), exact.asin(), &x);
                covers("acos", x.acos(), exact.acos(), &x);
            }
        }
        for quarters in -4..=4 {
            let (x, exact) = at(f64::from(quarters) * std::f64::consts::FRAC_PI_2 + near, place);
            covers("sin", x.sin_cos().0, exact.sin(), &x);
            covers("cos", x.sin_cos().1, exact.cos(), &x);
            covers("tan", x.tan(), exact.tan(), &x);
        }
    }
}

fn select(a: Bounded, b: Bounded) -> Bounded {
    Bounded::select_lt(a, b, a + a, b)
}

fn select_exactly(a: DoubleDouble, b: DoubleDouble) -> DoubleDouble {
    DoubleDouble::select_lt(a, b, a + a, b)
}

#[test]
fn functions_of_two_numbers_are_covered() {
    let functions: [Binary; 9] = [
        ("add", |a, b| a + b, |a, b| a + b),
        ("sub", |a, b| a - b, |a, b| a - b),
        ("mul", |a, b| a * b, |a, b| a * b),
        ("div", |a, b| a / b, |a, b| a / b),
        ("fma", |a, b| a.fma(b, -a), |a, b| a * b - a),
        ("atan2", Real::atan2, Real::atan2),
        ("min", Real::min, Real::min),
        ("max", Real::max, Real::max),
        ("select_lt", select, select_exactly),
    ];
    let mut random = Random(3);
    for _ in 0..60_000 {
        let a = spread(&mut random, 3.0);
        // Often near the other, so that differences cancel and comparisons are open.
        let b = match random.below(3) {
            0 => a * (1.0 + 1e-3 * random.next()),
            1 => a,
            _ => spread(&mut random, 3.0),
        };
        let ((a, exact_a), (b, exact_b)) = (operand(&mut random, a), operand(&mut random, b));
        for (name, function, truth) in functions {
            if name != "div" || exact_b.high != 0.0 {
                covers(name, function(a, b), truth(exact_a, exact_b), &(a, b));
            }
        }
    }
}

/// `value·2^exponent` in steps that stay within the range.
fn scaled(value: f64, exponent: i32) -> f64 {
    let mut left = exponent;
    let mut value = value;
    while left != 0 {
        let step = left.clamp(-1000, 1000);
        value *= 2.0_f64.powi(step);
        left -= step;
    }
    value
}

/// Products, quotients and roots across the whole range: operands between 1 and 2 have exact results in double-double
/// numbers, and powers of two carry those to where the results overflow or underflow.
#[test]
fn extreme_magnitudes_are_covered() {
    let mut random = Random(4);
    let check = |what: &str, found: Bounded, exact: DoubleDouble, exponent: i32| {
        if !found.value.is_finite() {
            assert_eq!(found.bound, f64::INFINITY, "{what}");
            return;
        }
        if found.bound == f64::INFINITY {
            return;
        }
        // Down to what is at most 2^200, or up: both without rounding.
        let shift = -exponent;
        let (value, bound) = (scaled(found.value, shift), scaled(found.bound, shift));
        if bound.is_finite() && value.is_finite() {
            let error = error(value, exact);
            assert!(error <= bound * (1.0 + 1e-12), "{what}: {found:?} against {exact:?}·2^{exponent}: {error:e}");
        }
    };
    for _ in 0..100_000 {
        let mut number = || {
            let exponent = (1073.0 * random.next()) as i32;
            // What is left of a number between 1 and 2 that becomes subnormal.
            let value = scaled(1.0 + random.next().abs(), exponent);
            (value, exponent)
        };
        let ((a, m), (b, n)) = (number(), number());
        let fraction = |value: f64, exponent: i32| DoubleDouble::new(scaled(value, -exponent));
        if !(a.is_finite() && b.is_finite()) || a == 0.0 || b == 0.0 {
            continue;
        }
        let (x, y) = (Bounded::exact(a), Bounded::exact(b));
        check("mul", x * y, fraction(a, m) * fraction(b, n), m + n);
        check("div", x / y, fraction(a, m) / fraction(b, n), m - n);
        // Operands that are only known up to a part of them, a quarter, which is exact where it is normal.
        if a >= 4.0 * f64::MIN_POSITIVE && b >= 4.0 * f64::MIN_POSITIVE {
            let known = |value: f64| Bounded::measured(value, 0.25 * value);
            let more = DoubleDouble::new(1.25);
            check("mul", known(a) * known(b), fraction(a, m) * more * fraction(b, n) * more, m + n);
            check(
                "div",
                known(a) / known(b),
                fraction(a, m) * more / (fraction(b, n) * DoubleDouble::new(0.75)),
                m - n,
            );
        }
        let even = m - m.rem_euclid(2);
        check("sqrt", x.sqrt(), fraction(a, even).sqrt(), even / 2);
    }
}

#[test]
fn exact_operations_stay_exact() {
    let exactly = |x: Bounded, value: f64| assert_eq!((x.value, x.bound), (value, 0.0));
    let number = Bounded::exact;
    exactly(number(0.1) - number(0.1), 0.0);
    exactly(number(1000.3) - number(1000.0), 1000.3 - 1000.0);
    exactly(number(0.1) * number(-4.0), -0.4);
    exactly(number(0.1) / number(0.5), 0.2);
    exactly(number(0.0) * number(0.7) + number(0.3), 0.3);
    exactly(Real::sin_cos(number(0.0)).1, 1.0);
    exactly(Bounded::ratio(3, 8), 0.375);
    exactly(Bounded::ratio(-21, 7), -3.0);
    exactly(Bounded::from_f64(0.1), 0.1);
    exactly(Real::powi(number(3.0), 0), 1.0);
    assert!(Bounded::ratio(1, 10).bound > 0.0 && Bounded::ratio(1, 10).bound < 1.2e-17);
}

#[test]
fn nothing_known_is_infinite_and_never_nan() {
    let (zero, one) = (Bounded::zero(), Bounded::one());
    let open = Bounded::measured(1e-9, 1e-9);
    let huge = Bounded::exact(f64::MAX);
    for unknown in
        [one / open, zero / zero, one / zero, huge * huge, huge + huge, -one / zero + one, (-one).sqrt(), zero.ln()]
    {
        assert_eq!(unknown.bound, f64::INFINITY, "{unknown:?}");
        assert_eq!(unknown.digits(), 0.0);
        for next in
            [unknown * zero, unknown - unknown, unknown.sqrt(), unknown.exp(), unknown.min(one), unknown.atan2(one)]
        {
            assert!(!next.bound.is_nan(), "{next:?}");
        }
    }
    // The value is finite, and a sine is between −1 and 1.
    assert!((one / open).sin().bound <= 2.0);
    assert_eq!(Bounded::measured(1.0, f64::NAN).bound, f64::INFINITY);
    assert_eq!(Bounded::measured(1.0, -0.5).bound, 0.5);
    // An angle across the cut may be off by a turn.
    let across = Bounded::measured(1e-9, 1e-8).atan2(-one);
    assert!((std::f64::consts::TAU - 1e-7..6.4).contains(&across.bound), "{across:?}");
}

#[test]
fn digits_are_counted() {
    let most = 53.0 * 2.0_f64.log10();
    assert!((Bounded::exact(0.0).digits() - most).abs() < 1e-12);
    assert!((Bounded::measured(2.0, 2e-6).digits() - 6.0).abs() < 1e-12);
    assert_eq!(Bounded::measured(1e-20, 1e-18).digits(), 0.0);
    assert!((Bounded::measured(1e-20, 1e-18).digits_beside(100.0) - most).abs() < 1e-12);
    assert!((Bounded::measured(1e-20, 1e-18).digits_beside(1e-6) - 12.0).abs() < 1e-12);
    assert_eq!(Bounded::measured(0.5, 1e-9).to_string(), "0.5 ± 1.1e-9");
    assert_eq!(format!("{:.3}", Bounded::exact(2.0)), "2.000 ± 0.0e0");
}

#[test]
fn states_and_bodies_are_lifted() {
    let body = RigidBody {
        mass: 2.0,
        center_of_mass: Vector3::new(0.1, 0.2, 0.3),
        inertia: Matrix3::new(1.0, 0.1, 0.2, 0.1, 2.0, 0.3, 0.2, 0.3, 3.0),
    };
    let lifted = rounded(&body);
    assert_eq!(lifted.inertia.map(|x| x.value), body.inertia);
    assert!(lifted.mass.bound > 2e-16 && lifted.mass.bound < 2.3e-16);
    let pose = Isometry3 {
        rotation: UnitQuaternion::from_scaled_axis(Vector3::new(0.3, -0.8, 0.5)),
        translation: Translation3::new(1.0, 2.0, 3.0),
    };
    let pair = measured(&(pose, SVector::from([5.0, 6.0])), 1e-3);
    assert_eq!(pair.0.rotation.coords.map(|x| x.value), pose.rotation.coords);
    assert!(pair.1.iter().chain(&pair.0.translation.vector).all(|x| x.bound == 1e-3));
    let plane = exact(&Isometry2::new(SVector::from([0.1, 0.2]), 0.4));
    assert_eq!((plane.rotation.re.value, plane.translation.vector[1].value), (0.4_f64.cos(), 0.2));
    assert_eq!([0.5_f32].lift(&gauss_bounded::Bounded::exact)[0].bound, 0.0);
}

/// In single precision against double precision, which holds its products exactly.
#[test]
fn single_precision_is_covered() {
    type Single = gauss_bounded::Bounded<f32>;
    let mut random = Random(5);
    let check = |what: &str, found: Single, exact: f64| {
        let error = (f64::from(found.value) - exact).abs();
        // Double precision rounds as well.
        let allowed = f64::from(found.bound) + 4.0 * f64::EPSILON * exact.abs();
        assert!(error <= allowed || !found.value.is_finite(), "{what}: {found:?} {exact:e}");
    };
    for _ in 0..50_000 {
        let (a, b) = (spread(&mut random, 30.0), spread(&mut random, 30.0));
        let (x, y) = (Single::from_f64(a), Single::from_f64(b));
        check("from_f64", x, a);
        check("mul", x * y, a * b);
        check("div", x / y, a / b);
        check("add", x + y, a + b);
        check("sqrt", x.abs().sqrt(), a.abs().sqrt());
        check("atan2", x.atan2(y), a.atan2(b));
        if a.abs() < 1e3 {
            check("sin", x.sin_cos().0, a.sin());
            check("exp", x.exp(), a.exp());
        }
    }
    check("ratio", Single::ratio(1, 3), 1.0 / 3.0);
}
