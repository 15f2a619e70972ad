//! Sines and cosines against sums of two numbers (106 binary digits) and against the library; both reductions, whatever
//! the target.

use std::vec::Vec;

use super::{MULTIPLES, of_small_angle, sines_and_cosines};
use crate::real::Real;

#[path = "trigonometry/angles_tests.rs"]
mod angles;
use angles::HUGE;

/// Angles up to here are not left to the library.
const LIMIT: f64 = (MULTIPLES - 1) as f64 * core::f64::consts::FRAC_PI_2;

fn sin_cos(x: f64) -> (f64, f64) {
    super::sin_cos(x, Real::fma)
}

/// Numbers below 1 in magnitude.
fn random() -> impl FnMut() -> f64 {
    let mut seed = 1_u64;
    move || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 - 1.0
    }
}

/// a + b as a sum of two numbers (Knuth), and such sums added and multiplied (Dekker): some 30 digits.
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let rounded = sum - a;
    (sum, (a - (sum - rounded)) + (b - rounded))
}

fn add(a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    let (sum, rest) = two_sum(a.0, b.0);
    two_sum(sum, rest + (a.1 + b.1))
}

fn multiply(a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    let product = a.0 * b.0;
    two_sum(product, f64::mul_add(a.0, b.0, -product) + (a.0 * b.1 + a.1 * b.0))
}

/// Sine and cosine for |x| < 2¹⁷, by their power series on [−π/4, π/4].
fn exactly(x: f64) -> [(f64, f64); 2] {
    let n = (x * core::f64::consts::FRAC_2_PI).round();
    // π/2 to 159 binary digits.
    let quarter_turn = [core::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17, -1.497_384_904_859_169_8e-33];
    let y = quarter_turn.iter().fold((x, 0.0), |y, &part| add(y, multiply((-n, 0.0), (part, 0.0))));
    let square = multiply(y, y);
    let (mut sine, mut cosine) = ((1.0, 0.0), (1.0, 0.0));
    let one_minus = |(high, low): (f64, f64)| add((1.0, 0.0), (-high, -low));
    for k in (1..=14).map(|k| 2.0 * f64::from(k)) {
        let k = 30.0 - k;
        let over = |divisor: f64| {
            let quotient = 1.0 / divisor;
            multiply(square, (quotient, f64::mul_add(-quotient, divisor, 1.0) / divisor))
        };
        sine = one_minus(multiply(over(k * (k + 1.0)), sine));
        cosine = one_minus(multiply(over(k * (k - 1.0)), cosine));
    }
    let sine = multiply(sine, y);
    let minus = |(high, low): (f64, f64)| (-high, -low);
    match (n as i64).rem_euclid(4) {
        0 => [sine, cosine],
        1 => [cosine, minus(sine)],
        2 => [minus(sine), minus(cosine)],
        _ => [minus(cosine), sine],
    }
}

/// The distance of what was found from the exact number, in steps from its leading part to the next number.
fn ulps(found: f64, (high, low): (f64, f64)) -> f64 {
    let magnitude = high.abs();
    ((found - high) - low).abs() / (f64::from_bits(magnitude.to_bits() + 1) - magnitude)
}

/// The errors that the module states, of both reductions where they hold.
fn check(x: f64) {
    let exact = exactly(x);
    let ways = [of_small_angle::<true, f64>(x, f64::mul_add), of_small_angle::<false, f64>(x, |a, b, c| a * b + c)];
    for (fused, (sine, cosine, holds)) in [true, false].into_iter().zip(ways) {
        assert!(holds || !fused || x.abs() > LIMIT, "{x:e} goes to the library");
        let errors = [ulps(sine, exact[0]), ulps(cosine, exact[1])];
        assert!(!holds || errors.iter().all(|&error| error < 0.96), "{x:e}, fused {fused}: {errors:?} ulp");
    }
}

#[test]
fn errors_are_below_what_the_module_states() {
    let mut random = random();
    for scale in [1e-8, 1e-3, 0.5, 0.8, 2.0, 10.0, 1e3, LIMIT] {
        (0..20_000).for_each(|_| check(random() * scale));
    }
}

/// Next to multiples of π/2 nearly all digits cancel: all multiples that there are up to the limit.
#[test]
fn hard_arguments() {
    let mut n = 1.0;
    while n * core::f64::consts::FRAC_PI_2 < LIMIT {
        let x: f64 = n * core::f64::consts::FRAC_PI_2;
        for k in -1..=1 {
            let x = f64::from_bits((x.to_bits() as i64 + k) as u64);
            check(x);
            check(-x);
        }
        n += 1.0;
    }
}

/// Agrees with the library where that is right: both are within 1 ulp of the true value.
#[test]
fn agree_with_the_library_within_an_ulp() {
    let place = |x: f64| {
        let bits = x.to_bits() as i64;
        if bits < 0 { i64::MIN - bits } else { bits }
    };
    let mut random = random();
    for scale in [1e-8, 0.5, 10.0, 1e5, 1e8] {
        for _ in 0..5_000 {
            let x = random() * scale;
            let (found, expected) = (sin_cos(x), x.sin_cos());
            let apart = [(found.0, expected.0), (found.1, expected.1)].map(|(a, b)| place(a).abs_diff(place(b)));
            assert!(apart.iter().all(|&apart| apart <= 1), "{x:e}: {found:?} {expected:?}");
        }
    }
}

/// Angles of any size, the nearest of all doubles to a multiple of π/2 among them: alone, among others, the functions
/// one by one, and in single precision.
#[test]
fn angles_of_any_size_are_as_exact_as_small_ones() {
    use crate::simd::Lanes;

    for (x, sine, cosine) in HUGE {
        let found = sin_cos(x);
        let errors = [ulps(found.0, sine), ulps(found.1, cosine)];
        assert!(errors.iter().all(|&error| error < 0.96), "{x:e}: {errors:?} ulp");
        assert_eq!((Real::sin(x), Real::cos(x)), found);
        let (sines, cosines) = Real::sin_cos(Lanes([x, 0.0, -x, x]));
        assert_eq!((sines.0, cosines.0), ([found.0, 0.0, -found.0, found.0], [found.1, 1.0, found.1, found.1]));
        let quotient = sine.0 / cosine.0;
        let rest = f64::mul_add(-quotient, cosine.0, sine.0) + sine.1 - quotient * cosine.1;
        let tangent = (quotient, rest / cosine.0);
        // Those of the sine and the cosine, and half a one.
        let off = ulps(Real::tan(x), tangent);
        assert!(off <= 2.0 * (0.96 + 0.96 + 0.5), "{x:e}: {off} ulp of {tangent:?}, {:e}", Real::tan(x));

        let single = x as f32;
        if single.is_finite() && f64::from(single) == x {
            assert_eq!(Real::sin_cos(single), (sine.0 as f32, cosine.0 as f32));
        }
    }
}

#[test]
fn odd_and_even_and_exact_where_they_can_be() {
    assert_eq!((sin_cos(0.0).0.to_bits(), sin_cos(0.0).1), (0, 1.0));
    assert_eq!(sin_cos(-0.0).0.to_bits(), (-0.0_f64).to_bits());
    for zero in [0.0, -0.0] {
        let ways =
            [of_small_angle::<true, f64>(zero, f64::mul_add), of_small_angle::<false, f64>(zero, |a, b, c| a * b + c)];
        assert!(ways.iter().all(|(sine, cosine, holds)| sine.to_bits() == zero.to_bits() && *cosine == 1.0 && *holds));
    }
    for x in [1e-300, 5e-324, 1e-9] {
        assert_eq!(sin_cos(x), (x, 1.0));
    }
    for x in [0.3, 1.7, 4.0, 1e4, 7e5] {
        let ((s, c), (t, d)) = (sin_cos(x), sin_cos(-x));
        assert_eq!((s, c), (-t, d));
    }
    for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(sin_cos(x).0.is_nan() && sin_cos(x).1.is_nan());
    }
}

/// Whatever their number, and also where one of them goes to the library.
#[test]
fn among_others_an_angle_gets_the_bits_that_it_gets_alone() {
    fn check<const N: usize>(numbers: &[f64]) {
        for first in 0..numbers.len() {
            let angles: [f64; N] = core::array::from_fn(|i| numbers[(first + 5 * i) % numbers.len()]);
            let (sines, cosines) = sines_and_cosines(angles, Real::fma);
            for i in 0..N {
                let (sine, cosine) = sin_cos(angles[i]);
                let same = |a: f64, b: f64| a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan());
                assert!(same(sines[i], sine) && same(cosines[i], cosine), "{} of {angles:?}", angles[i]);
            }
        }
    }
    let mut random = random();
    let mut numbers: Vec<f64> = (0..200).map(|_| random() * 20.0).collect();
    check::<4>(&numbers);
    numbers.extend([0.0, -0.0, 1e-310, core::f64::consts::PI, 1e6, -1e300, f64::NAN, f64::INFINITY]);
    check::<1>(&numbers);
    check::<2>(&numbers);
    check::<3>(&numbers);
    check::<4>(&numbers);
    check::<7>(&numbers);
    check::<8>(&numbers);
    check::<23>(&numbers);
}

/// Vectors that hold sines in one half and cosines in the other: the same operations, also where those that should be
/// fused are not.
#[cfg(feature = "wide")]
#[test]
fn both_in_one_vector_get_the_bits_of_one_by_one() {
    use super::vectors::{halves_of_eight, halves_of_four, halves_of_two};

    let mut random = random();
    for scale in [1e-8, 1.0, 10.0, 1e5, 1e12] {
        for _ in 0..1000 {
            let angles: [f64; 4] = core::array::from_fn(|_| random() * scale);
            let (one, two) = (halves_of_two([angles[0]]), halves_of_four([angles[1], angles[2]]));
            let (sines, cosines, hold) = halves_of_eight(angles);
            let singles = angles.map(|x| of_small_angle::<true, f64>(x, Real::fma));
            assert_eq!(hold, singles.iter().all(|single| single.2));
            if hold {
                let found = [one.0[0], two.0[0], two.0[1], one.1[0], two.1[0], two.1[1]];
                assert_eq!(found, [sines[0], sines[1], sines[2], cosines[0], cosines[1], cosines[2]]);
                let expected = singles.map(|(sine, cosine, _)| [sine, cosine].map(f64::to_bits));
                assert_eq!(core::array::from_fn(|i| [sines[i], cosines[i]].map(f64::to_bits)), expected);
            }
        }
    }
}

/// In single precision they are rounded from double, within half an ulp and what the first rounding can add, 2⁻²⁹ of an
/// ulp: every 2003rd number of both signs, or all of them by
/// `LONG_RUNS=1 cargo test --release -p gauss-runtime --lib single_precision_is_rounded_once_more`.
#[test]
fn single_precision_is_rounded_once_more() {
    let stride = if std::env::var_os("LONG_RUNS").is_some() { 1 } else { 2003 };
    let mut worst = (0.0, 0.0_f32);
    for bits in (0..f32::INFINITY.to_bits()).step_by(stride) {
        let x = f32::from_bits(bits);
        let (found, exact) = (Real::sin_cos(x), f64::from(x).sin_cos());
        // Odd and even to the last bit.
        assert!(Real::sin_cos(-x) == (-found.0, found.1), "{x:e}");
        for (exact, found) in [(exact.0, found.0), (exact.1, found.1)] {
            let unit = f64::from(f32::from_bits((exact as f32).abs().to_bits() + 1)) - f64::from((exact as f32).abs());
            let error = (f64::from(found) - exact).abs() / unit;
            assert!(error <= 0.5 + 1e-8, "{x:e}: {found:e} for {exact:e}");
            worst = if error > worst.0 { (error, x) } else { worst };
        }
    }
    std::println!("worst: {} ulp, at {:e}", worst.0, worst.1);
}
