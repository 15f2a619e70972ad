//! Sines, cosines and tangents of angles of any size lie within their bounds.

use gauss_bounded::Bounded;
use gauss_runtime::real::Real;

#[path = "../../../gauss-runtime/src/trigonometry/angles_tests.rs"]
mod angles;

#[test]
fn functions_of_angles_of_any_size_are_enclosed() {
    for (x, sine, cosine) in angles::HUGE {
        let quotient = sine.0 / cosine.0;
        let rest = f64::mul_add(-quotient, cosine.0, sine.0) + sine.1 - quotient * cosine.1;
        let tangent = (quotient, rest / cosine.0);
        let bounded = Bounded::<f64>::exact(x);
        let encloses =
            |number: Bounded<f64>, (high, low): (f64, f64)| ((number.value - high) - low).abs() <= number.bound;
        assert!(encloses(Real::sin(bounded), sine) && encloses(Real::cos(bounded), cosine), "{x:e}");
        assert!(encloses(Real::tan(bounded), tangent), "{x:e}");
    }
}
