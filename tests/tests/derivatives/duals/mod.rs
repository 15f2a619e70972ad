//! Dual numbers of `num-dual` in kernels and integrators: derivatives of whole simulations by parameters, against
//! differences.

mod contacts;
mod events;

use gauss_adapters::DualNumber;
use gauss_runtime::integrate::Fixed;
use gauss_runtime::linearize::{Factored, Lu};
use gauss_runtime::nalgebra::Unit;
use gauss_runtime::prelude::*;
use gauss_tests::top::Top;
use num_dual::{Dual2_64, Dual64, DualSVec64, HyperDual64};

/// The angular velocity after one second, by its mass and its height of the centre of mass.
fn spin<T: Real>(mass: T, height: T) -> [T; 3] {
    let number = T::from_f64;
    let zero = T::zero();
    let inertia = Vector3::new(number(0.5), number(0.6), number(0.2));
    let kernel =
        Top { mass, center: Vector3::new(zero, zero, height), inertia, g: number(9.81) }.kernel().expect("a body");
    let half: T = number(0.2);
    let (sine, cosine) = half.sin_cos();
    let tilted = Unit::new_unchecked(Quaternion::from(SVector::from([sine, zero, zero, cosine])));
    let turning = Vector3::new(number(0.1), number(-0.2), number(4.0));
    let end = Simulation::new(&kernel)
        .control(Fixed::by(CommutatorFree4, number(0.02)))
        .run_to_end(tilted, turning, zero..T::one())
        .expect("runs");
    [end.z[0], end.z[1], end.z[2]]
}

/// Central differences of a step e, extrapolated: their error is of order e⁴ (1e-12 for 1e-3) and 2 ε/e, some 1e-12, of
/// the largest number on the way, in each of the fifty steps at worst.
fn slope(f: impl Fn(f64) -> [f64; 3]) -> [f64; 3] {
    let central = |e: f64| {
        let (after, before) = (f(e), f(-e));
        [0, 1, 2].map(|i| (after[i] - before[i]) / (2.0 * e))
    };
    let (fine, coarse) = (central(1e-3), central(2e-3));
    [0, 1, 2].map(|i| (4.0 * fine[i] - coarse[i]) / 3.0)
}

fn number(value: f64, rate: f64) -> DualNumber<Dual64> {
    DualNumber(Dual64::new(value, rate))
}

fn variable(value: f64) -> DualNumber<Dual64> {
    number(value, 1.0)
}

fn constant(value: f64) -> DualNumber<Dual64> {
    number(value, 0.0)
}

const MASS: f64 = 0.8;
const HEIGHT: f64 = 0.3;
const TOLERANCE: f64 = 1e-9;

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= TOLERANCE * (1.0 + b.abs())
}

#[test]
fn derivatives_of_a_run_by_its_parameters_are_those_of_differences() {
    let by_mass = slope(|e| spin(MASS + e, HEIGHT));
    let by_height = slope(|e| spin(MASS, HEIGHT + e));
    let plain = spin(MASS, HEIGHT);
    let one = spin(variable(MASS), constant(HEIGHT));
    let variables = |value: f64| DualNumber(DualSVec64::<2>::from_re(value));
    let mut gradient = [variables(MASS), variables(HEIGHT)];
    gradient[0].eps = num_dual::Derivative::some(SVector::from([1.0, 0.0]));
    gradient[1].eps = num_dual::Derivative::some(SVector::from([0.0, 1.0]));
    let both: [DualNumber<DualSVec64<2>>; 3] = spin(gradient[0], gradient[1]);
    for i in 0..3 {
        // The values take the same operations, but num-dual divides by reciprocals.
        assert!((one[i].re - plain[i]).abs() < 1e-12 && (both[i].re - plain[i]).abs() < 1e-12);
        assert!(near(one[i].eps, by_mass[i]), "{i}: {} for {}", one[i].eps, by_mass[i]);
        let slopes = both[i].eps.0.expect("it depends on both");
        assert!(near(slopes[0], by_mass[i]) && near(slopes[1], by_height[i]), "{i}: {slopes:?}");
    }
    assert!(by_mass.iter().chain(&by_height).all(|slope| slope.abs() > 1e-3), "{by_mass:?} {by_height:?}");
}

#[test]
fn so_are_second_derivatives() {
    let first = |mass: f64, height: f64| spin(variable(mass), constant(height)).map(|x| x.eps);
    let twice_by_mass = slope(|e| first(MASS + e, HEIGHT));
    let mixed = slope(|e| first(MASS, HEIGHT + e));
    let second = spin(DualNumber(Dual2_64::from_re(MASS).derivative()), DualNumber(Dual2_64::from_re(HEIGHT)));
    let mass = DualNumber(HyperDual64::from_re(MASS).derivative1());
    let cross = spin(mass, DualNumber(HyperDual64::from_re(HEIGHT).derivative2()));
    for i in 0..3 {
        assert!(near(second[i].v2, twice_by_mass[i]), "{i}: {} for {}", second[i].v2, twice_by_mass[i]);
        assert!(near(cross[i].eps1eps2, mixed[i]), "{i}: {} for {}", cross[i].eps1eps2, mixed[i]);
    }
}

/// Every function of a dual number has the derivative that differences have, where it is smooth; and says when it has
/// none.
#[test]
fn functions_know_their_derivatives() {
    fn functions<T: Real>(x: T) -> Vec<T> {
        let b = T::from_f64(0.4);
        vec![
            x.sqrt(),
            x.sin(),
            x.cos(),
            x.tan(),
            x.asin(),
            x.acos(),
            x.atan(),
            x.atan2(b),
            b.atan2(x),
            x.sinh(),
            x.cosh(),
            x.tanh(),
            x.exp(),
            x.ln(),
            x.powi(3),
            x.powi(-2),
            (-x).abs(),
            x.recip(),
            x.fma(x, b),
            b.min(x * b),
            b.max(x + b),
            T::select_lt(x, T::one(), x * x, T::from_f64(f64::NAN)),
        ]
    }
    let at = functions(number(0.7, 1.0));
    for (number, dual) in at.into_iter().enumerate() {
        let value = |e: f64| functions(0.7 + e)[number];
        let central = |e: f64| (value(e) - value(-e)) / (2.0 * e);
        let expected = (4.0 * central(1e-3) - central(2e-3)) / 3.0;
        // e⁴ of a fifth derivative up to 1e3, and rounding as above.
        assert!((dual.eps - expected).abs() < 1e-8 * (1.0 + expected.abs()), "{number}: {} for {expected}", dual.eps);
    }
    assert!(!Real::is_finite(number(1.0, f64::NAN)) && Real::is_finite(number(1.0, 2.0)));
    assert!(!Real::is_finite(Real::sqrt(number(0.0, 1.0))));
}

/// Lanes of dual numbers: the derivatives of many states at once.
#[test]
fn duals_go_into_lanes() {
    type Pack = Lanes<DualNumber<Dual64>, 4>;
    let masses = [0.5, 0.8, 1.1, 1.4];
    let mass = Pack::from_fn(|i| variable(masses[i]));
    let together = spin(mass, Pack::splat(constant(HEIGHT)));
    for (lane, mass) in masses.into_iter().enumerate() {
        let alone = spin(variable(mass), constant(HEIGHT));
        for i in 0..3 {
            assert_eq!((together[i][lane].re, together[i][lane].eps), (alone[i].re, alone[i].eps));
        }
    }
}

/// An entry that is zero may have a derivative: dual numbers compare by their values alone.
#[test]
fn systems_of_dual_equations_keep_derivatives_of_zeros() {
    // 2a + b = 2, ε a + b = 0: a = 1 + ε/2, b = −ε.
    let factors = Lu::new([[number(2.0, 0.0), number(1.0, 0.0)], [number(0.0, 1.0), number(1.0, 0.0)]]);
    let solution = factors.solve(&SVector::from([number(2.0, 0.0), number(0.0, 0.0)]));
    assert_eq!([solution[0].re, solution[0].eps, solution[1].re, solution[1].eps], [1.0, 0.5, 0.0, -1.0]);
}
