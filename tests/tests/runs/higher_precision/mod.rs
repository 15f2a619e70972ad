//! The same derive in double-double numbers: runs that agree with the reference solutions to 25 digits.

use gauss_runtime::nalgebra::Unit;
use gauss_runtime::prelude::*;
use gauss_tests::double_double::DoubleDouble;
use gauss_tests::top::Top;
use gauss_tests::trajectory::reference;
use serde_json::Value;

#[derive(GaussDynamics)]
#[gauss(
    taylor,
    coordinates(a, b),
    particle(mass = m1, position = [l1 * sin(a), 0, -l1 * cos(a)]),
    particle(mass = m2, position = [l1 * sin(a) + l2 * sin(b), 0, -l1 * cos(a) - l2 * cos(b)]),
)]
struct Pendulum<T> {
    m1: T,
    m2: T,
    l1: T,
    l2: T,
    #[gauss(gravity)]
    g: T,
}

/// What a series of a step may leave out: relative to numbers of order one, far above the rounding of either scalar.
const WIDE: f64 = 1e-28;
const NARROW: f64 = 1e-12;

fn decimals(value: &Value) -> Vec<DoubleDouble> {
    match value {
        Value::Array(items) => items.iter().flat_map(decimals).collect(),
        Value::String(text) => vec![DoubleDouble::decimal(text)],
        _ => panic!("not a decimal: {value}"),
    }
}

/// A number that both scalars hold, from the 31 digits of one of them.
fn narrowed<T: Real>(value: DoubleDouble) -> T {
    T::from_f64(value.high) + T::from_f64(value.low)
}

fn read<T: Real>(value: &Value) -> Vec<T> {
    decimals(value).into_iter().map(narrowed).collect()
}

/// The largest difference from decimals.
fn error<T: Real>(found: &[T], expected: &Value) -> f64 {
    let expected: Vec<T> = read(expected);
    assert_eq!(found.len(), expected.len());
    found.iter().zip(expected).map(|(a, b)| Real::abs(*a - b).lane(0)).fold(0.0, f64::max)
}

/// Final angular velocity (body axes) and third row of R of the heavy top of Hairer, Lubich & Wanner.
fn top<T: Real>(tolerance: f64) -> f64 {
    let scene = reference("hlw_heavy_top");
    let n = |p, q| T::ratio(p, q);
    let kernel = Top {
        mass: T::one(),
        center: Vector3::new(T::zero(), T::zero(), T::one()),
        inertia: Vector3::new(n(1, 2), n(17, 20), T::one()),
        g: T::one(),
    };
    let kernel = kernel.kernel().expect("a formal body");
    // The quaternion behind R of the data: 0.4 + 0.2 i + 0.4 j + 0.8 k.
    let start = Unit::new_unchecked(Quaternion::from(SVector::from([n(1, 5), n(2, 5), n(4, 5), n(2, 5)])));
    let omega = Vector3::from_iterator(read::<T>(&scene["initial"]["body_omega"]));
    let simulation = Simulation::new(&kernel).taylor(tolerance, tolerance);
    let end = simulation.run_to_end(start, omega, T::zero()..T::from_f64(30.0)).expect("runs");
    let [x, y, z, w] = end.q.coords.into();
    let two = T::from_f64(2.0);
    // The entries of R, which the signs of a quaternion do not change.
    let last_row = [two * (x * z - w * y), two * (y * z + w * x), T::one() - two * (x * x + y * y)];
    let spin: Vec<T> = end.z.iter().copied().collect();
    error(&spin, &scene["final"]["body_omega"]).max(error(&last_row, &scene["final"]["R"][2]))
}

/// Final places of the two particles of a double pendulum that goes over.
fn pendulum<T: Real>(tolerance: f64) -> f64 {
    let scene = reference("double_pendulum");
    let number = |key: &str| read::<T>(&scene["parameters"][key])[0];
    let [m1, m2, l1, l2, g] = ["m1", "m2", "l1", "l2", "g"].map(number);
    let kernel = Pendulum { m1, m2, l1, l2, g }.kernel().expect("a pendulum");
    let pair = |key: &str| SVector::<T, 2>::from_iterator(read::<T>(&scene["parameters"][key]));
    let simulation = Simulation::new(&kernel).taylor(tolerance, tolerance);
    let end = simulation.run_to_end(pair("theta"), pair("thetadot"), T::zero()..T::from_f64(5.0)).expect("runs");
    let ((sa, ca), (sb, cb)) = (end.q[0].sin_cos(), end.q[1].sin_cos());
    let first = [l1 * sa, -l1 * ca];
    let second = [first[0] + l2 * sb, first[1] - l2 * cb];
    error(&first, &scene["final"]["x1"]).max(error(&second, &scene["final"]["x2"]))
}

/// What a run makes of what its steps leave out is a property of the motion, and measured in double precision: in
/// double-double numbers it is the same up to the luck of signs and orders, for which a factor of a hundred is allowed.
fn check(wide: fn(f64) -> f64, narrow: fn(f64) -> f64) {
    let growth = narrow(NARROW) / NARROW;
    let found = wide(WIDE);
    assert!(found <= 100.0 * growth * WIDE, "{found:e}, where errors grow {growth:e} times");
    assert!(found < 1e-25, "{found:e}");
}

#[test]
fn a_heavy_top_agrees_with_its_reference() {
    check(top::<DoubleDouble>, top::<f64>);
}

#[test]
fn a_double_pendulum_agrees_with_its_reference() {
    check(pendulum::<DoubleDouble>, pendulum::<f64>);
}

/// The scalar itself, by what functions satisfy and by decimals.
#[test]
fn functions_have_thirty_digits() {
    let number = DoubleDouble::decimal;
    let near = |a: DoubleDouble, b: DoubleDouble| {
        let apart = Real::abs(a - b).lane(0);
        // Some hundred roundings.
        assert!(apart <= 100.0 * DoubleDouble::EPSILON * (1.0 + b.lane(0).abs()), "{a:?} and {b:?}: {apart:e}");
    };
    let pi = number("3.14159265358979323846264338327950288");
    near(DoubleDouble::zero().atan2(-DoubleDouble::one()), pi);
    near(DoubleDouble::one().exp(), number("2.71828182845904523536028747135266249"));
    near(number("2").sqrt(), number("1.41421356237309504880168872420969808"));
    near(number("2").ln(), number("0.693147180559945309417232121458176568"));
    near(number("0.5").asin(), pi / number("6"));
    near(number("0.5").acos(), pi / number("3"));
    near(number("1").sinh(), number("1.17520119364380145688238185059560082"));
    near(number("1").cosh(), number("1.54308063481524377847790562075706168"));
    for k in -40..=40 {
        let x = DoubleDouble::ratio(k, 7);
        let (sine, cosine) = x.sin_cos();
        near(sine * sine + cosine * cosine, DoubleDouble::one());
        near(x.exp().ln(), x);
        near(x.atan().tan(), x);
        near(x.tanh() * x.cosh(), x.sinh());
    }
}
