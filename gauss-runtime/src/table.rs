//! Functions given by their values at points: what `table(…)` of a scene becomes. Of one number they are [`Linear`] and
//! [`Cubic`], of two and three, on a grid, [`Grid`].
//!
//! Between the points a [`Linear`] table is a straight line from each to the next, a [`Cubic`] one the natural cubic
//! spline, which has two continuous derivatives. Beyond the first and the last point both go on straight. The points
//! are constants, and so are the coefficients: they are worked out by the compiler, which refuses points that are not
//! in order. Of points that come at run time there is [`Table`], a grid of any size.
//!
//! A piece is found by one comparison for each point, without branches, so that lanes, dual numbers and numbers with
//! error bounds find their own.

#[cfg(feature = "alloc")]
mod at_run_time;
mod grid;
mod spline;

#[cfg(feature = "alloc")]
pub use at_run_time::{Table, TableFault};
pub use grid::{Grid, Joined, axis};

use crate::real::Real;
use spline::{Node, curvatures};

/// Straight lines through N points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linear<const N: usize>(Pieces<N>);

/// The natural cubic spline through N points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cubic<const N: usize>(Pieces<N>);

/// Polynomials about points: each from its point to the next, the first also before it, and one after the last.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Pieces<const N: usize> {
    /// Point at which each polynomial begins.
    start: [f64; N],
    /// Coefficients of powers of the distance from there.
    coefficients: [[f64; 4]; N],
    /// Slope before the first point.
    before: f64,
}

impl<const N: usize> Linear<N> {
    /// Through points [x, y] with increasing x.
    ///
    /// ```compile_fail
    /// use gauss_runtime::table::Linear;
    /// // 1 is not below 0.
    /// const UNORDERED: Linear<2> = Linear::through(&[[1.0, 0.0], [0.0, 1.0]]);
    /// assert_eq!(UNORDERED.value(0.5), 0.5);
    /// ```
    ///
    /// # Panics
    /// Of fewer than two points, of x that do not increase, of numbers that are not finite: when the program is
    /// compiled, if the table is a constant.
    #[must_use]
    pub const fn through(points: &[[f64; 2]; N]) -> Self {
        check(points);
        let mut pieces = Pieces { start: [0.0; N], coefficients: [[0.0; 4]; N], before: 0.0 };
        let mut i = 0;
        while i < N {
            let from = if i + 1 < N { i } else { i - 1 };
            let slope = (points[from + 1][1] - points[from][1]) / (points[from + 1][0] - points[from][0]);
            pieces.start[i] = points[i][0];
            pieces.coefficients[i] = [points[i][1], slope, 0.0, 0.0];
            i += 1;
        }
        pieces.before = pieces.coefficients[0][1];
        Self(pieces)
    }

    /// The value at x.
    #[inline]
    pub fn value<T: Real>(&self, x: T) -> T {
        let (h, [y, slope, ..]) = self.0.at(x);
        T::fma(h, slope, y)
    }

    /// The slope at x; at a point of the table the slope to its right.
    #[inline]
    pub fn slope<T: Real>(&self, x: T) -> T {
        self.0.at(x).1[1]
    }
}

impl<const N: usize> Cubic<N> {
    /// Through points [x, y] with increasing x.
    ///
    /// # Panics
    /// As [`Linear::through`].
    #[must_use]
    pub const fn through(points: &[[f64; 2]; N]) -> Self {
        check(points);
        let mut nodes = [Node::new([0.0; 2]); N];
        let mut i = 0;
        while i < N {
            nodes[i] = Node::new(points[i]);
            i += 1;
        }
        curvatures(&mut nodes);
        let mut pieces = Pieces { start: [0.0; N], coefficients: [[0.0; 4]; N], before: 0.0 };
        i = 0;
        while i + 1 < N {
            let h = points[i + 1][0] - points[i][0];
            let (a, b) = (nodes[i].curvature, nodes[i + 1].curvature);
            let secant = (points[i + 1][1] - points[i][1]) / h;
            pieces.start[i] = points[i][0];
            pieces.coefficients[i] = [points[i][1], secant - h * (2.0 * a + b) / 6.0, a / 2.0, (b - a) / (6.0 * h)];
            if i + 2 == N {
                pieces.start[i + 1] = points[i + 1][0];
                pieces.coefficients[i + 1] = [points[i + 1][1], secant + h * (a + 2.0 * b) / 6.0, 0.0, 0.0];
            }
            i += 1;
        }
        pieces.before = pieces.coefficients[0][1];
        Self(pieces)
    }

    /// The value at x.
    #[inline]
    pub fn value<T: Real>(&self, x: T) -> T {
        let (h, [y, a, b, c]) = self.0.at(x);
        T::fma(h, T::fma(h, T::fma(h, c, b), a), y)
    }

    /// The derivative at x.
    #[inline]
    pub fn slope<T: Real>(&self, x: T) -> T {
        let (h, [_, a, b, c]) = self.0.at(x);
        T::fma(h, T::fma(h, T::ratio(3, 1) * c, b + b), a)
    }

    /// The second derivative at x.
    #[inline]
    pub fn second<T: Real>(&self, x: T) -> T {
        let (h, [_, _, b, c]) = self.0.at(x);
        T::fma(h, T::ratio(6, 1) * c, b + b)
    }

    /// The third derivative at x, which jumps at the points of the table; there the value to the right.
    #[inline]
    pub fn third<T: Real>(&self, x: T) -> T {
        T::ratio(6, 1) * self.0.at(x).1[3]
    }
}

impl<const N: usize> Pieces<N> {
    /// The distance of x from where its piece begins, and its coefficients.
    #[inline]
    fn at<T: Real>(&self, x: T) -> (T, [T; 4]) {
        let first = self.coefficients[0][0];
        let mut start = T::from_f64(self.start[0]);
        let mut found = [first, self.before, 0.0, 0.0].map(T::from_f64);
        for (&from, coefficients) in self.start.iter().zip(&self.coefficients) {
            let from = T::from_f64(from);
            for (found, &coefficient) in found.iter_mut().zip(coefficients) {
                *found = T::select_lt(x, from, *found, T::from_f64(coefficient));
            }
            start = T::select_lt(x, from, start, from);
        }
        (x - start, found)
    }
}

/// Refuses points that make no table.
const fn check<const N: usize>(points: &[[f64; 2]; N]) {
    assert!(N >= 2, "a table has two points or more");
    let mut i = 0;
    while i < N {
        assert!(points[i][0].is_finite() && points[i][1].is_finite(), "the numbers of a table are finite");
        assert!(i == 0 || points[i - 1][0] < points[i][0], "the first numbers of the points of a table increase");
        i += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::Lanes;

    const POINTS: [[f64; 2]; 5] = [[-1.0, 2.0], [0.0, 1.0], [0.5, 1.5], [2.0, 0.0], [3.0, 0.25]];
    const LINEAR: Linear<5> = Linear::through(&POINTS);
    const CUBIC: Cubic<5> = Cubic::through(&POINTS);

    #[test]
    fn both_meet_their_points_and_go_on_straight() {
        for [x, y] in POINTS {
            assert!((LINEAR.value(x) - y).abs() < 1e-15 && (CUBIC.value(x) - y).abs() < 1e-15);
        }
        assert_eq!(
            [LINEAR.value(0.25), LINEAR.slope(0.25), LINEAR.value(-3.0), LINEAR.value(5.0)],
            [1.25, 1.0, 4.0, 0.75]
        );
        assert_eq!(
            [LINEAR.slope(-3.0), LINEAR.slope(-1.0), LINEAR.slope(0.0), LINEAR.slope(9.0)],
            [-1.0, -1.0, 1.0, 0.25]
        );
        assert_eq!([CUBIC.second(-5.0), CUBIC.second(7.0), CUBIC.third(7.0)], [0.0; 3]);
        let line = CUBIC.value(5.0) - CUBIC.value(4.0);
        assert!((line - CUBIC.slope(3.0)).abs() < 1e-15);
        assert!(LINEAR.value(f64::NAN).is_nan() && CUBIC.slope(f64::NAN).is_nan());
    }

    /// The first two derivatives of a spline are continuous, and differences agree with them.
    #[test]
    fn the_spline_has_two_continuous_derivatives() {
        for [x, _] in POINTS {
            let (below, above) = (x - 1e-9, x + 1e-9);
            assert!((CUBIC.slope(below) - CUBIC.slope(above)).abs() < 1e-7);
            assert!((CUBIC.second(below) - CUBIC.second(above)).abs() < 1e-7);
        }
        for k in 0..50 {
            // Never within h of a point, where the third derivative jumps.
            let (x, h) = (-1.95 + 0.111 * f64::from(k), 1e-5);
            let slope = (CUBIC.value(x + h) - CUBIC.value(x - h)) / (2.0 * h);
            let second = (CUBIC.slope(x + h) - CUBIC.slope(x - h)) / (2.0 * h);
            assert!((slope - CUBIC.slope(x)).abs() < 1e-8 && (second - CUBIC.second(x)).abs() < 1e-8, "{x}");
        }
    }

    /// Natural splines reproduce straight lines, and a cubic that has no curvature at the ends.
    #[test]
    fn what_is_a_spline_is_reproduced() {
        let cubic = |x: f64| x * x * x - 6.0 * x * x + 2.0;
        const OF_CUBIC: Cubic<3> = Cubic::through(&[[2.0, -14.0], [3.0, -25.0], [4.0, -30.0]]);
        assert_eq!(OF_CUBIC.second(2.0), 0.0);
        assert!((OF_CUBIC.value(3.0) - cubic(3.0)).abs() < 1e-14);
        const LINE: Cubic<4> = Cubic::through(&[[0.0, 1.0], [1.0, 3.0], [3.0, 7.0], [4.0, 9.0]]);
        for k in 0..20 {
            let x = -1.0 + 0.3 * f64::from(k);
            assert!((LINE.value(x) - (1.0 + 2.0 * x)).abs() < 1e-14);
        }
    }

    #[test]
    fn lanes_find_their_own_pieces() {
        let lanes = CUBIC.value(Lanes([0.25, 2.5]));
        assert_eq!(lanes.0, [CUBIC.value(0.25), CUBIC.value(2.5)]);
    }
}
