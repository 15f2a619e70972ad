use gauss_runtime::dual::Dual;

use super::*;

type Of<T> = fn(T, T) -> T;

macro_rules! each {
    ($($function:expr;)+) => {
        [$(($function as Of<Dual<2>>, $function as Of<Taped>)),+]
    };
}

/// Values to the bit, slopes to rounding: the same products, summed in another order.
#[test]
fn slopes_are_those_of_dual_numbers() {
    let functions = each![
        |x, y| x + y;
        |x, y| x - y * x;
        |x, y| x / y + y / x;
        |x, y| Real::sqrt(x * y);
        |x, y| Real::sin(x) * Real::cos(y);
        |x, y| Real::tan(x) + Real::atan2(x, y);
        |x, y| Real::asin(x) * Real::acos(y * x);
        |x, y| Real::atan(x) + Real::sinh(y);
        |x, y| Real::cosh(x) * Real::tanh(y);
        |x, y| Real::exp(x) * Real::ln(y);
        |x, y| Real::recip(x) - Real::powi(y, 3);
        |x, y| Real::powf(x, y);
        |x, y| Real::max(x, y) * Real::abs(-x) + Real::min(x, x) * Real::signum(y);
    ];
    for (n, (dual, taped)) in functions.into_iter().enumerate() {
        let expected = dual(Dual::variable(0.4, 0), Dual::variable(0.7, 1));
        let (value, slopes) = gradient(&[0.4, 0.7], |&[x, y]| taped(x, y)).expect("finite");
        assert_eq!(value, expected.value, "{n}");
        for (slope, expected) in slopes.into_iter().zip(expected.slopes) {
            // Some ten products of numbers below 5.
            assert!((slope - expected).abs() < 50.0 * f64::EPSILON, "{n}: {slope} {expected}");
        }
    }
}

#[test]
fn roots_at_zero_have_no_slope_along_what_does_not_change() {
    // |v| at rest, and a root of what is constant.
    let (value, slopes) = gradient(&[0.0, 3.0], |&[v, w]| (v * v).sqrt() * w + w).expect("finite");
    assert_eq!((value, slopes), (3.0, [0.0, 1.0]));
    assert!(gradient(&[0.0], |&[v]| v.sqrt()).is_none());
}

#[test]
fn numbers_of_another_recording_are_none() {
    let mut kept = Taped::constant(0.0);
    gradient(&[2.0], |&[x]| {
        kept = x;
        x
    })
    .expect("finite");
    assert!((kept + kept).value().is_nan());
    assert!(gradient(&[1.0], |&[x]| x * kept).is_none());
    // On another thread.
    let found = gradient(&[1.0], |&[x]| std::thread::scope(|s| s.spawn(move || x * x).join().expect("joins")));
    assert!(found.is_none());
    // And one within another.
    let mut inner = Some((0.0, [0.0]));
    let outer = gradient(&[1.0], |&[x]| {
        inner = gradient(&[1.0], |&[y]| y);
        x
    });
    assert_eq!((inner, outer), (None, Some((1.0, [1.0]))));
}

/// A sweep costs as much for a thousand numbers as the function itself does: a node for each operation.
#[test]
fn many_numbers_need_one_sweep() {
    let numbers: [f64; 1000] = std::array::from_fn(|k| k as f64);
    let (_, slopes) = gradient(&numbers, |x| x.iter().fold(Taped::zero(), |sum, &x| x.fma(x, sum))).expect("finite");
    assert!(slopes.iter().enumerate().all(|(k, &slope)| slope == 2.0 * k as f64));
}
