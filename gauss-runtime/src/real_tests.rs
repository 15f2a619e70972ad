//! Ratios, the functions that the trait provides, and how derivatives are told apart.

use super::*;

#[test]
fn a_ratio_and_its_rest_are_exact() {
    // 1/3 − fl(1/3) = 1/(3·2⁵⁴); what f64 holds leaves nothing.
    assert_eq!(ratio_rest(1, 3), 2.0_f64.powi(-54) / 3.0);
    assert_eq!(ratio_rest(3, 4), 0.0);
    assert_eq!(ratio_rest((1 << 53) + 1, 1), 1.0);
    // By fractions of whole numbers (Python).
    for (p, q, rest) in [
        (-22, 7, -6.344131569286608e-17),
        (4_450_312_892_752_408_881, 1_000_000_000_000_000_000, -2.741504170638509e-16),
        (43_867, 5_109_094_217_170_944_000, -6.05252374381974e-31),
    ] {
        assert!((ratio_rest(p, q) - rest).abs() <= 2.0 * f64::EPSILON * rest.abs(), "{p}/{q}");
    }
}

#[test]
fn ratios_are_rounded_once() {
    assert_eq!(f64::ratio(1, 3), 1.0 / 3.0);
    assert_eq!(f64::ratio(-22, 7), -22.0 / 7.0);
    assert_eq!(f32::ratio(1, 3), 1.0_f32 / 3.0);
    // Operands that f64 cannot hold: 2^53 + 1 over 1 is a tie, to even.
    assert_eq!(f64::ratio((1 << 53) + 1, 1), 9_007_199_254_740_992.0);
    assert_eq!(f64::ratio((1 << 53) + 3, 1), 9_007_199_254_740_996.0);
    assert_eq!(f64::ratio(i64::MAX, i64::MAX), 1.0);
    assert_eq!(f64::ratio(i64::MIN, i64::MAX), -1.0);
    assert_eq!(f64::ratio(1, i64::MIN), -(2.0_f64.powi(-63)));
    // 43867/5109094217170944000 to 17 digits (mpmath).
    assert_eq!(f64::ratio(43_867, 5_109_094_217_170_944_000), 8.586_062_056_277_845e-15);
    // Rounding to f64 first would go to the wrong neighbour: 1 + 2^-24 + 2^-60 rounds up in f32.
    assert_eq!(f32::ratio((1 << 60) + (1 << 36) + 1, 1 << 60), 1.0 + f32::EPSILON);
    assert_eq!(f32::ratio((1 << 60) + (1 << 36), 1 << 60), 1.0);
    assert!(f64::ratio(0, 0).is_nan());
    assert_eq!(f64::ratio(-1, 0), f64::NEG_INFINITY);
}

/// A scalar with no more than a scalar has to have.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Least(f64);

macro_rules! arithmetic {
    ($($trait:ident $method:ident $assign_trait:ident $assign:ident;)+) => {$(
        impl $trait for Least {
            type Output = Self;

            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0))
            }
        }

        impl $assign_trait for Least {
            fn $assign(&mut self, other: Self) {
                self.0.$assign(other.0);
            }
        }
    )+};
}

arithmetic! {
    Add add AddAssign add_assign;
    Sub sub SubAssign sub_assign;
    Mul mul MulAssign mul_assign;
    Div div DivAssign div_assign;
}

impl Neg for Least {
    type Output = Self;

    fn neg(self) -> Self {
        Self(-self.0)
    }
}

macro_rules! functions {
    ($($name:ident)+) => {$(
        fn $name(self) -> Self {
            Self(Real::$name(self.0))
        }
    )+};
}

impl Real for Least {
    const LANES: usize = 1;

    fn lane(self, _: usize) -> f64 {
        self.0
    }

    fn from_f64(value: f64) -> Self {
        Self(value)
    }

    functions!(sqrt sinh tanh exp ln);

    fn sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = Real::sin_cos(self.0);
        (Self(sine), Self(cosine))
    }

    fn atan2(self, x: Self) -> Self {
        Self(Real::atan2(self.0, x.0))
    }

    fn is_finite(self) -> bool {
        self.0.is_finite()
    }

    fn select_lt(a: Self, b: Self, x: Self, y: Self) -> Self {
        if a.0 < b.0 { x } else { y }
    }
}

/// Each function of the library is within an ulp; of the sums and products, 1 − x and 1 + x are exact or rounded
/// once, and the root halves what goes into it. Exponentials are squared, which doubles their error.
#[test]
fn a_scalar_writes_eleven_functions() {
    let near = |found: Least, expected: f64, ulps: f64| {
        assert!((found.0 - expected).abs() <= ulps * f64::EPSILON * expected.abs(), "{} {expected}", found.0);
    };
    for x in [-1.0, -0.999_999, -0.5, -1e-9, 0.0, 1e-300, 0.3, 0.7, 0.999, 1.0] {
        near(Least(x).asin(), Real::asin(x), 4.0);
        near(Least(x).acos(), Real::acos(x), 4.0);
    }
    for x in [-710.4, -40.0, -1.0, 0.0, 1e-9, 0.4, 3.0, 710.4] {
        near(Least(x).atan(), Real::atan(x), 4.0);
        near(Least(x).cosh(), Real::cosh(x), 6.0);
        assert_eq!(Least(x).abs().0, Real::abs(x));
    }
    near(Least(-1e300).atan(), -core::f64::consts::FRAC_PI_2, 1.0);
    assert!(Least(1.1).asin().0.is_nan() && Least(-1.1).acos().0.is_nan());
    assert_eq!((Least::zero(), Least::one()), (Least(0.0), Least(1.0)));
    for (p, q) in [(1, 3), (-22, 7), (i64::MIN, 3), (43_867, 5_109_094_217_170_944_000), (-7, i64::MAX), (1, 0)] {
        assert_eq!(Least::ratio(p, q).0.is_finite(), f64::ratio(p, q).is_finite());
        if q != 0 {
            near(Least::ratio(p, q), f64::ratio(p, q), 2.0);
        }
    }
    assert_eq!([Least::ratio(1, 3).0, Least::ratio(-22, 7).0], [f64::ratio(1, 3), f64::ratio(-22, 7)]);
}

#[test]
fn provided_functions_agree_with_the_library() {
    assert_eq!(Real::powi(1.5_f64, 7), 17.085_937_5);
    assert_eq!(Real::powi(2.0_f64, -3), 0.125);
    assert_eq!(Real::powi(0.0_f64, 0), 1.0);
    assert_eq!([Real::powf(2.25_f64, 1.5), Real::powf(0.0, 0.3)], [3.375, 0.0]);
    assert_eq!(Real::powf(2.25_f32, 1.5), 3.375);
    assert_eq!(f64::select_lt(1.0, 2.0, 3.0, f64::NAN), 3.0);
    assert_eq!(f64::select_lt(f64::NAN, 2.0, 3.0, 4.0), 4.0);
    assert_eq!(Real::atan2(1.0_f32, 1.0), core::f32::consts::FRAC_PI_4);
    assert_eq!([2.0, 0.0, -3.0].map(<f64 as Real>::signum), [1.0, 0.0, -1.0]);
    assert!(<f64 as Real>::signum(f64::NAN).is_nan());
    assert_eq!([<f64 as Real>::min(1.0, 2.0), <f64 as Real>::max(1.0, 2.0)], [1.0, 2.0]);
    assert_eq!([<f64 as Real>::min(2.0, 1.0), <f64 as Real>::max(2.0, 1.0)], [1.0, 2.0]);
    assert_eq!(<f64 as Real>::min(f64::MAX, f64::MAX), f64::MAX);
    assert!([<f64 as Real>::min(f64::NAN, 1.0), <f64 as Real>::max(1.0, f64::NAN)].iter().all(|x| x.is_nan()));
}

#[test]
fn the_largest_derivative_is_told_to_a_power_of_two() {
    use crate::testing::dual::dual;
    for rate in [1.0, -3.7, 1e-200, 5e250, 1e-6] {
        let found = largest_derivative(dual(1e10, rate));
        assert!(found >= rate.abs() && found <= 2.0 * rate.abs(), "{rate:e} {found:e}");
    }
    assert_eq!([largest_derivative(dual(3.0, 0.0)), largest_derivative(7.0_f64)], [0.0, 0.0]);
    assert_eq!(largest_derivative(dual(3.0, f64::NAN)), f64::INFINITY);
}
