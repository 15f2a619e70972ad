//! Zeros of functions of one variable on an interval, and how near a function comes to zero.

use crate::real::Real;

/// The zero of a function on the interval from `a` to `b`, with values of different signs, or zero, at the ends: to a
/// distance of `resolution`, on the side that has the sign of the value at `b`. Chandrupatla, *A new hybrid
/// quadratic/bisection algorithm for finding the zero of a nonlinear function without using derivatives*, Advances in
/// Engineering Software 28 (1997).
///
/// `None` where the function changes its sign by way of infinity: at a pole it grows as the interval shrinks.
pub(in crate::integrate) fn locate<E>(
    mut function: impl FnMut(f64) -> Result<f64, E>,
    (start, at_start): (f64, f64),
    (end, at_end): (f64, f64),
    resolution: f64,
) -> Result<Option<f64>, E> {
    // The zero is between a, the newest point, and b; c is the point before.
    let (mut a, mut at_a, mut b, mut at_b) = (end, at_end, start, at_start);
    let mut fraction = 0.5;
    let mut trials = 0;
    while at_a != 0.0 && (b - a).abs() > resolution {
        trials += 1;
        let x = a + fraction * (b - a);
        let at_x = function(x)?;
        let (c, at_c);
        if (at_x > 0.0) == (at_a > 0.0) && at_x != 0.0 {
            (c, at_c) = (a, at_a);
        } else {
            (c, at_c) = (b, at_b);
            (b, at_b) = (a, at_a);
        }
        (a, at_a) = (x, at_x);
        // Interpolate where the three points lie so that the inverse quadratic is monotone, else halve. A function that
        // is at odds with every interpolation is halved from the fiftieth trial on, which ends it.
        let (xi, phi) = ((a - b) / (c - b), (at_a - at_b) / (at_c - at_b));
        fraction = if trials < 50 && phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi {
            at_a / (at_b - at_a) * at_c / (at_b - at_c)
                + (c - a) / (b - a) * at_a / (at_c - at_a) * at_b / (at_c - at_b)
        } else {
            0.5
        };
        // Not so near to an end of the bracket that it could not shrink to the resolution from there.
        let margin = (0.5 * resolution / (b - a).abs()).min(0.5);
        fraction = fraction.max(margin).min(1.0 - margin);
    }
    let size = |at: f64| if at.is_finite() { at.abs() } else { 0.0 };
    let grown = |at: f64| at.abs() > 1e3 * size(at_start).max(size(at_end));
    if grown(at_a) && grown(at_b) {
        return Ok(None);
    }
    let beyond = at_a == 0.0 || (at_a > 0.0) == (at_end > 0.0) && at_end != 0.0;
    Ok(Some(if beyond { a } else { b }))
}

/// The least value of a cubic between 0 and 1 with these values and slopes at the ends, where it falls from 0 and rises
/// towards 1.
pub(in crate::integrate) fn least_of_cubic(values: [f64; 2], slopes: [f64; 2]) -> f64 {
    let ([f0, f1], [s0, s1]) = (values, slopes);
    let (third, second) = (s0 + s1 - 2.0 * (f1 - f0), 3.0 * (f1 - f0) - 2.0 * s0 - s1);
    let at = |x: f64| f0 + x * (s0 + x * (second + x * third));
    // Where the slope, a quadratic that is negative at 0 and positive at 1, is zero.
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..20 {
        let x = 0.5 * (low + high);
        if s0 + x * (2.0 * second + x * 3.0 * third) < 0.0 { low = x } else { high = x }
    }
    at(0.5 * (low + high))
}

/// A point between `a` and `b` at which a function that falls from `a` and rises towards `b` is below zero, if there is
/// one; by the golden section.
pub(in crate::integrate) fn below_zero<E>(
    mut function: impl FnMut(f64) -> Result<f64, E>,
    mut a: f64,
    mut b: f64,
) -> Result<Option<(f64, f64)>, E> {
    let golden = 0.5 * (Real::sqrt(5.0_f64) - 1.0);
    let (mut x, mut y) = (b - golden * (b - a), a + golden * (b - a));
    let (mut at_x, mut at_y) = (function(x)?, function(y)?);
    // Values near a minimum differ by squares of distances: below the root of a rounding there is nothing to tell
    // apart.
    for _ in 0..40 {
        if at_x < 0.0 {
            return Ok(Some((x, at_x)));
        }
        if at_y < 0.0 {
            return Ok(Some((y, at_y)));
        }
        if at_x < at_y {
            (b, y, at_y) = (y, x, at_x);
            x = b - golden * (b - a);
            at_x = function(x)?;
        } else {
            (a, x, at_x) = (x, y, at_y);
            y = a + golden * (b - a);
            at_y = function(y)?;
        }
    }
    Ok(None)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_search_ends_on_the_far_side_of_any_zero_and_refuses_poles() {
        type Case = (&'static str, fn(f64) -> f64, Option<f64>);
        let functions: [Case; 7] = [
            ("line", |x| x - 0.3, Some(0.3)),
            ("ninth power", |x| (x - 0.7).powi(9), Some(0.7)),
            ("wall", |x| ((x - 0.123) * 1e9).atan(), Some(0.123)),
            ("jump", |x| if x < 1e-7 { 1.0 } else { -1e-300 }, Some(1e-7)),
            ("exponential", |x| (40.0 * x).exp() - 2.0, Some(0.05 * core::f64::consts::LN_2 / 2.0)),
            ("root", |x| (x - 0.9).cbrt(), Some(0.9)),
            ("pole", |x| 1.0 / (x - 0.45), None),
        ];
        for (name, function, zero) in functions {
            let mut evaluations = 0;
            let found = locate(
                |x| {
                    evaluations += 1;
                    Ok::<_, ()>(function(x))
                },
                (0.0, function(0.0)),
                (1.0, function(1.0)),
                1e-15,
            );
            let found = found.expect("defined");
            assert_eq!(found.is_some(), zero.is_some(), "{name}");
            if let (Some(found), Some(zero)) = (found, zero) {
                let far = function(found) == 0.0 || (function(found) > 0.0) == (function(1.0) > 0.0);
                // The ninth power is zero in floating point nowhere else, but is below 1e-135 within 1e-15.
                assert!((found - zero).abs() < 2e-15 && far, "{name}: {found}");
            }
            assert!(evaluations <= 105, "{name}: {evaluations}");
        }
    }

    #[test]
    fn what_dips_below_zero_is_found_and_what_does_not_is_not() {
        let dip = |depth: f64| move |x: f64| Ok::<_, ()>((x - 0.37) * (x - 0.37) - depth);
        let (x, value) = below_zero(dip(1e-12), 0.0, 1.0).expect("defined").expect("is there");
        assert!((x - 0.37).abs() < 1e-6 && value < 0.0);
        assert_eq!(below_zero(dip(0.0), 0.0, 1.0), Ok(None));
        assert_eq!(below_zero(dip(-1e-12), 0.0, 1.0), Ok(None));
        // A cubic is what it interpolates.
        let (value, slope) = (|x: f64| (x - 0.3) * (x - 0.3) - 0.01, |x: f64| 2.0 * (x - 0.3));
        assert!((least_of_cubic([value(0.0), value(1.0)], [slope(0.0), slope(1.0)]) + 0.01).abs() < 1e-11);
    }
}
