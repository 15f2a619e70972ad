//! Functions of numbers that have more digits than the machine's: series, after what is periodic or doubles has been
//! taken away, and iterations that begin at the double next to the result.

use std::cmp::Ordering;

use crate::algebra::expressions::function::{BinaryFunction, Function};
use crate::algebra::numbers::evaluate::Number;

/// Numbers in base two of more digits than a double.
pub trait ManyDigits: Number {
    /// Steps of iterations, each of which makes correct digits three times as many, from 53 to all.
    const STEPS: u32;

    /// The power of two above it, or nearly; of zero a very small one.
    fn magnitude(self) -> i64;

    /// x·2ⁿ, without rounding.
    fn times_two_to(self, power: i64) -> Self;
}

/// π/2 and ln 2, each as a sum of doubles: more digits than any of the numbers has.
const QUARTER_TURN: [f64; 6] = [
    std::f64::consts::FRAC_PI_2,
    6.123_233_995_736_766e-17,
    -1.497_384_904_859_169_8e-33,
    5.562_271_104_316_826e-50,
    2.836_115_989_820_158e-66,
    8.724_931_080_676_243e-84,
];
const LN_2: [f64; 6] = [
    std::f64::consts::LN_2,
    2.319_046_813_846_299_6e-17,
    5.707_708_438_416_212e-34,
    -3.582_432_210_601_811_4e-50,
    -1.352_169_675_798_863e-66,
    6.080_638_740_240_814e-83,
];

/// Terms of a series in |x| ≤ π/4 after which nothing is left of 256 digits.
const TERMS: u32 = 40;

/// Beyond it, up or down, eˣ is out of the range of all of them.
const LARGEST_EXPONENT: f64 = 1e12;

/// Beyond it tanh differs from ±1 by less than 2⁻²⁸⁰.
const SATURATED: f64 = 100.0;

/// Sine and cosine of an angle in radians.
pub fn sine_cosine<N: ManyDigits>(angle: N) -> (N, N) {
    let (mut x, mut quarters) = (angle, 0.0);
    // Angles of more than 2⁵³ quarter turns lose 53 digits a time.
    for _ in 0..3 {
        let turns = (x.to_f64() / QUARTER_TURN[0]).round();
        if turns == 0.0 {
            break;
        }
        x = without(x, turns, &QUARTER_TURN);
        quarters += turns.rem_euclid(4.0);
    }
    let square = -(x * x);
    let (sin, cos) = (series(x, square, 1, 2), series(N::number(1.0), square, 0, 2));
    match quarters.rem_euclid(4.0) as u8 {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

/// A function of one argument.
pub fn call<N: ManyDigits>(x: N, function: Function) -> N {
    let zero = N::number(0.0);
    match function {
        Function::Sin => sine_cosine(x).0,
        Function::Cos => sine_cosine(x).1,
        Function::Exp => exp(x),
        Function::Ln => ln(x),
        Function::Sqrt => sqrt(x),
        Function::Abs if x < zero => -x,
        Function::Abs => x,
        Function::Signum if x > zero => N::number(1.0),
        Function::Signum if x < zero => N::number(-1.0),
        Function::Signum => x,
        Function::Tanh => tanh(x),
    }
}

/// A function of two arguments.
pub fn call_with<N: ManyDigits>(x: N, function: BinaryFunction, other: N) -> N {
    match (function, x.partial_cmp(&other)) {
        (BinaryFunction::Atan2, _) => atan2(x, other),
        (BinaryFunction::Powf, _) => powf(x, other),
        (_, None) => N::number(f64::NAN),
        (BinaryFunction::Min, Some(Ordering::Greater)) | (BinaryFunction::Max, Some(Ordering::Less)) => other,
        _ => x,
    }
}

/// x − n·Σ parts, the large ones first, for an integer n.
fn without<N: ManyDigits>(x: N, n: f64, parts: &[f64]) -> N {
    parts.iter().fold(x, |rest, &part| rest - N::number(n) * N::number(part))
}

/// `Σ xᵏ/k!` over k = from, from + step, …, whose first term is given; `factor` is what x and its sign give each next
/// one.
fn series<N: ManyDigits>(first: N, factor: N, from: u32, step: u32) -> N {
    let (mut sum, mut term, mut k) = (first, first, from);
    for _ in 0..TERMS {
        let divisor: u32 = (k + 1..=k + step).product();
        k += step;
        term = term * factor / N::number(divisor.into());
        let next = sum + term;
        if next == sum || !next.is_finite() {
            return next;
        }
        sum = next;
    }
    sum
}

/// Exponential of what is left of x without powers of two, below ln 2/128, squared six times.
fn exp<N: ManyDigits>(x: N) -> N {
    let near = x.to_f64();
    if near.abs() > LARGEST_EXPONENT {
        return N::number(near.exp());
    }
    let halvings = (near / LN_2[0]).round();
    let small = series(N::number(1.0), without(x, halvings, &LN_2).times_two_to(-6), 0, 1);
    (0..6).fold(small, |power, _| power * power).times_two_to(halvings as i64)
}

/// Logarithm by Halley's iteration on the exponential.
fn ln<N: ManyDigits>(x: N) -> N {
    let size = x.magnitude();
    let guess = x.times_two_to(-size).to_f64().ln() + size as f64 * LN_2[0];
    (0..N::STEPS).fold(N::number(guess), |y, _| {
        let power = exp(y);
        y + ((x - power) / (x + power)).times_two_to(1)
    })
}

/// Square root by Halley's iteration.
fn sqrt<N: ManyDigits>(x: N) -> N {
    if x == N::number(0.0) {
        return x;
    }
    let half = x.magnitude() / 2;
    let x = x.times_two_to(-2 * half);
    let root = (0..N::STEPS).fold(N::number(x.to_f64().sqrt()), |y, _| {
        let square = y * y;
        y + y * (x - square).times_two_to(1) / (square + square.times_two_to(1) + x)
    });
    root.times_two_to(half)
}

/// Hyperbolic tangent, by series near zero, where the exponentials cancel.
fn tanh<N: ManyDigits>(x: N) -> N {
    let size = x.to_f64().abs();
    if size < 0.5 {
        let square = x * x;
        return series(x, square, 1, 2) / series(N::number(1.0), square, 0, 2);
    }
    if size > SATURATED {
        return call(x, Function::Signum);
    }
    let (up, down) = (exp(x), exp(-x));
    (up - down) / (up + down)
}

/// Power of a base that is not negative.
fn powf<N: ManyDigits>(base: N, exponent: N) -> N {
    let zero = N::number(0.0);
    if exponent == zero {
        N::number(1.0)
    } else if base == zero {
        N::number(0.0_f64.powf(exponent.to_f64()))
    } else {
        exp(exponent * ln(base))
    }
}

/// Angle by Newton's iteration on the tangent of the remaining angle.
fn atan2<N: ManyDigits>(y: N, x: N) -> N {
    let zero = N::number(0.0);
    if y == zero && x >= zero {
        return zero;
    }
    let scale = -y.magnitude().max(x.magnitude());
    let (y, x) = (y.times_two_to(scale), x.times_two_to(scale));
    (0..N::STEPS).fold(N::number(y.to_f64().atan2(x.to_f64())), |angle, _| {
        let (sin, cos) = sine_cosine(angle);
        angle + (y * cos - x * sin) / (x * cos + y * sin)
    })
}
