//! Functions of up to three numbers by their values on a grid.

use super::spline::{Node, slopes_of_parabolas, slopes_of_spline};
use crate::real::Real;

/// Interpolation between the points of a table, along each of its axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Joined {
    /// Straight lines: continuous, and derivatives jump at the points.
    Linear,
    /// Cubics whose slopes at the points are those of parabolas through three neighbours (Bessel's): one continuous
    /// derivative. A change of one value acts two cells around.
    Hermite,
    /// Natural cubic spline: two continuous derivatives.
    Cubic,
}

/// A function of up to three numbers, by its values at N × M × L points.
///
/// It is the tensor product of the curves of one variable: what is joined along the first axis, point by point, is
/// joined along the second, and the order does not matter. A table of fewer variables has one point along the axes that
/// are left. Beyond the grid it goes on straight along each axis, whatever it is joined by.
///
/// K numbers are kept of each point: the value alone where the points are joined by straight lines; otherwise the
/// value, its slopes along the axes, and their slopes along the others, 2, 4 and 8 of one, two and three variables.
///
/// ```
/// use gauss_runtime::table::{Grid, Joined};
/// const ALPHA: [f64; 3] = [-0.1, 0.0, 0.2];
/// const MACH: [f64; 2] = [0.5, 0.9];
/// const LIFT: Grid<3, 2, 1, 1> =
///     Grid::of_two(&ALPHA, &MACH, &[[-0.5, -0.6], [0.0, 0.0], [1.0, 1.2]], Joined::Linear);
/// assert_eq!(LIFT.at([0, 0], [0.1, 0.9]), 0.6);
/// assert_eq!(LIFT.at([1, 0], [0.1, 0.5]), 5.0); // by alpha
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid<const N: usize, const M: usize, const L: usize, const K: usize> {
    axes: ([f64; N], [f64; M], [f64; L]),
    /// Values and slopes of each point; number k is differentiated once by the variables whose bits are in k.
    points: [[[[f64; K]; L]; M]; N],
}

/// An axis of a table: two numbers or more, which increase.
///
/// # Panics
/// Of any other: when the program is compiled, if the table is a constant.
#[must_use]
pub const fn axis<const N: usize>(axis: &[f64; N]) -> [f64; N] {
    assert!(N >= 2, "an axis of a table has two numbers or more");
    let mut i = 0;
    while i < N {
        assert!(axis[i].is_finite(), "the numbers of a table are finite");
        assert!(i == 0 || axis[i - 1] < axis[i], "the numbers of an axis of a table increase");
        i += 1;
    }
    *axis
}

impl<const N: usize, const K: usize> Grid<N, 1, 1, K> {
    /// Through points [x, y] with increasing x.
    ///
    /// # Panics
    /// As [`of_three`](Grid::of_three).
    #[must_use]
    pub const fn through(points: &[[f64; 2]; N], joined: Joined) -> Self {
        let (mut x, mut y) = ([0.0; N], [0.0; N]);
        let mut i = 0;
        while i < N {
            [x[i], y[i]] = points[i];
            i += 1;
        }
        Self::of_one(&x, &y, joined)
    }

    /// Table of one variable: `values[i]` is the value at `x[i]`.
    ///
    /// # Panics
    /// As [`of_three`](Grid::of_three).
    #[must_use]
    pub const fn of_one(x: &[f64; N], values: &[f64; N], joined: Joined) -> Self {
        let mut points = [[[[0.0; K]; 1]; 1]; N];
        let mut i = 0;
        while i < N {
            points[i][0][0][0] = values[i];
            i += 1;
        }
        Self { axes: (axis(x), [0.0], [0.0]), points }.joined(1, joined)
    }
}

impl<const N: usize, const M: usize, const K: usize> Grid<N, M, 1, K> {
    /// Table of two variables: `values[i][j]` is the value at `x[i]` and `y[j]`.
    ///
    /// # Panics
    /// As [`of_three`](Grid::of_three).
    #[must_use]
    pub const fn of_two(x: &[f64; N], y: &[f64; M], values: &[[f64; M]; N], joined: Joined) -> Self {
        let mut points = [[[[0.0; K]; 1]; M]; N];
        let mut i = 0;
        while i < N {
            let mut j = 0;
            while j < M {
                points[i][j][0][0] = values[i][j];
                j += 1;
            }
            i += 1;
        }
        Self { axes: (axis(x), axis(y), [0.0]), points }.joined(2, joined)
    }
}

impl<const N: usize, const M: usize, const L: usize, const K: usize> Grid<N, M, L, K> {
    /// Table of three variables: `values[i][j][l]` is the value at `x[i]`, `y[j]` and `z[l]`.
    ///
    /// # Panics
    /// Of axes of fewer than two numbers, or of numbers that do not increase, of numbers that are not finite, and of a
    /// K that is not 1 for straight lines and two to the number of variables for others: when the program is compiled,
    /// if the table is a constant.
    ///
    /// ```compile_fail
    /// use gauss_runtime::table::{Grid, Joined};
    /// // 1 is not below 0.
    /// const UNORDERED: Grid<2, 2, 1, 1> = Grid::of_two(&[1.0, 0.0], &[0.0, 1.0], &[[0.0; 2]; 2], Joined::Linear);
    /// assert_eq!(UNORDERED.at([0, 0], [0.5, 0.5]), 0.0);
    /// ```
    #[must_use]
    pub const fn of_three(
        x: &[f64; N],
        y: &[f64; M],
        z: &[f64; L],
        values: &[[[f64; L]; M]; N],
        joined: Joined,
    ) -> Self {
        let mut points = [[[[0.0; K]; L]; M]; N];
        let mut i = 0;
        while i < N * M * L {
            let [a, b, c] = Self::place(i);
            points[a][b][c][0] = values[a][b][c];
            i += 1;
        }
        Self { axes: (axis(x), axis(y), axis(z)), points }.joined(3, joined)
    }

    /// Adds slopes along the first axes, of which there are `variables`.
    const fn joined(mut self, variables: usize, joined: Joined) -> Self {
        let mut i = 0;
        while i < N * M * L {
            let [a, b, c] = Self::place(i);
            assert!(self.points[a][b][c][0].is_finite(), "the numbers of a table are finite");
            i += 1;
        }
        let spline = match joined {
            Joined::Linear => {
                assert!(K == 1, "of a table of straight lines one number is kept of each point");
                return self;
            }
            Joined::Hermite => false,
            Joined::Cubic => true,
        };
        assert!(K == 1 << variables, "2, 4 and 8 numbers are kept of the points of one, two and three variables");
        let points = self.points.as_flattened_mut().as_flattened_mut().as_flattened_mut();
        add_slopes(points, 0, [M * L, K], &mut Node::along(&self.axes.0), spline);
        if variables > 1 {
            add_slopes(points, 1, [L, K], &mut Node::along(&self.axes.1), spline);
        }
        if variables > 2 {
            add_slopes(points, 2, [1, K], &mut Node::along(&self.axes.2), spline);
        }
        self
    }

    /// The indices of a point, by its number.
    const fn place(number: usize) -> [usize; 3] {
        [number / (M * L), number / L % M, number % L]
    }

    /// The derivative of these orders, by each variable, at x; orders of zero are the value. Of straight lines there
    /// are first derivatives by each variable, of cubics three; further ones are zero. Where a derivative jumps, at a
    /// point of an axis, it is that of the cell behind. Variables that the table does not have are left out.
    #[inline]
    pub fn at<const D: usize, T: Real>(&self, orders: [u8; D], x: [T; D]) -> T {
        const { assert!(1 <= D && D <= 3, "a table has one, two or three variables") }
        let of = |k: usize| if k < D { (orders[k], x[k]) } else { (0, T::zero()) };
        let smooth = K > 1;
        sum(
            self.points.as_flattened().as_flattened().as_flattened(),
            [M, L, K],
            &Weights::<T, N>::new(&self.axes.0, smooth, of(0)),
            &Weights::<T, M>::new(&self.axes.1, smooth, of(1)),
            &Weights::<T, L>::new(&self.axes.2, smooth, of(2)),
        )
    }
}

/// Adds the slopes along an axis: those of the numbers of each point that are known before it. `nodes` are above the
/// numbers of the axis; behind it come so many points, of each of which so many numbers are kept.
pub(super) const fn add_slopes(
    points: &mut [f64],
    axis: usize,
    [behind, kept]: [usize; 2],
    nodes: &mut [Node],
    spline: bool,
) {
    let lines = points.len() / (kept * nodes.len());
    let mut line = 0;
    while line < lines {
        let first = line / behind * nodes.len() * behind + line % behind;
        let mut k = 0;
        while k < 1 << axis {
            let mut i = 0;
            while i < nodes.len() {
                nodes[i].y = points[(first + i * behind) * kept + k];
                i += 1;
            }
            if spline {
                slopes_of_spline(nodes);
            } else {
                slopes_of_parabolas(nodes);
            }
            i = 0;
            while i < nodes.len() {
                points[(first + i * behind) * kept + (k | 1 << axis)] = nodes[i].slope;
                i += 1;
            }
            k += 1;
        }
        line += 1;
    }
}

/// Sums values and slopes of the points times the weights, axis by axis from the last one. There are so many points
/// along the second and the third axis, and so many numbers of each point.
#[inline(always)]
pub(super) fn sum<T: Real, const N: usize, const M: usize, const L: usize>(
    points: &[f64],
    [seconds, thirds, kept]: [usize; 3],
    first: &Weights<T, N>,
    second: &Weights<T, M>,
    third: &Weights<T, L>,
) -> T {
    let mut sum = T::zero();
    for a in first.from..=first.to {
        let mut of_first = [T::zero(); 2];
        for b in second.from..=second.to {
            let mut of_second = [T::zero(); 4];
            for c in third.from..=third.to {
                let point = ((a * seconds + b) * thirds + c) * kept;
                for (k, &number) in points[point..point + kept].iter().enumerate() {
                    of_second[k & 3] = T::fma(third.of(c, k & 4), T::from_f64(number), of_second[k & 3]);
                }
            }
            for k in 0..kept.min(4) {
                of_first[k & 1] = T::fma(second.of(b, k & 2), of_second[k], of_first[k & 1]);
            }
        }
        for k in 0..kept.min(2) {
            sum = T::fma(first.of(a, k), of_first[k], sum);
        }
    }
    sum
}

/// Weights of the values, and of the slopes, at the points of an axis for a place between them: of up to N points.
pub(super) struct Weights<T, const N: usize> {
    /// The first and the last point that counts in some lane.
    from: usize,
    to: usize,
    values: [T; N],
    slopes: [T; N],
}

impl<T: Real, const N: usize> Weights<T, N> {
    /// Weights for the derivative of that order at x.
    #[inline(always)]
    pub fn new(axis: &[f64], smooth: bool, (order, x): (u8, T)) -> Self {
        let (zero, mut own) = (T::zero(), Self { from: 0, to: 0, values: [T::zero(); N], slopes: [T::zero(); N] });
        let Some(last) = axis.len().checked_sub(2) else {
            own.values[0] = T::one();
            return own;
        };
        let (from, to) = cells_about(x, axis);
        (own.from, own.to) = (from, to + 1);
        for i in from..=to {
            let [begin, end] = [axis[i], axis[i + 1]].map(T::from_f64);
            let weights = if smooth {
                let (near, far) = (i == 0, i == last);
                cubic(order, x, [begin, end], [near, far])
            } else {
                linear(order, x, [begin, end])
            };
            // Lanes in other cells have nothing of this one. The last cell that begins at or before x is that of x.
            let chosen = |weight: T| {
                let weight = if i == to { weight } else { T::select_lt(x, end, weight, zero) };
                if i == from { weight } else { T::select_lt(x, begin, zero, weight) }
            };
            let [before, after, slope_before, slope_after] = weights.map(chosen);
            own.values[i - from] += before;
            own.values[i + 1 - from] += after;
            own.slopes[i - from] += slope_before;
            own.slopes[i + 1 - from] += slope_after;
        }
        own
    }

    /// Weight of the slope at a point, if `slope` is not zero, else of the value.
    #[inline(always)]
    fn of(&self, point: usize, slope: usize) -> T {
        let place = point - self.from;
        if slope == 0 { self.values[place] } else { self.slopes[place] }
    }
}

/// The first and the last cell that a lane may be in.
#[inline(always)]
fn cells_about<T: Real>(x: T, axis: &[f64]) -> (usize, usize) {
    let last = axis.len() - 2;
    let (mut from, mut to) = (0, last);
    for (i, &begin) in axis.iter().enumerate().take(last + 1).skip(1) {
        let begin = T::from_f64(begin);
        if T::all_surely_lt(begin, x) {
            from = i;
        } else if T::all_surely_lt(x, begin) {
            to = i - 1;
            break;
        }
    }
    (from, to)
}

/// Weights of the values at both ends of a cell, on the straight line through them.
#[inline(always)]
fn linear<T: Real>(order: u8, x: T, [begin, end]: [T; 2]) -> [T; 4] {
    let (zero, width) = (T::zero(), end - begin);
    match order {
        0 => [(end - x) / width, (x - begin) / width, zero, zero],
        1 => [-width.recip(), width.recip(), zero, zero],
        _ => [zero; 4],
    }
}

/// Weights of the values at both ends of a cell and of the slopes there, on Hermite's cubic. Before the first cell and
/// behind the last one it goes on straight.
#[inline(always)]
fn cubic<T: Real>(order: u8, x: T, [begin, end]: [T; 2], [first, last]: [bool; 2]) -> [T; 4] {
    let (zero, one, width) = (T::zero(), T::one(), end - begin);
    let [two, three, six] = [2, 3, 6].map(|n| T::ratio(n, 1));
    let mut within = x;
    if first {
        within = T::select_lt(x, begin, begin, within);
    }
    if last {
        within = T::select_lt(end, x, end, within);
    }
    // Each from its own end: 1 − u has no digit of the distance to a point behind which the cell is narrow, and slopes
    // steep.
    let [u, v] = [within - begin, end - within].map(|distance| distance / width);
    let weights = match order {
        0 => {
            // What is beyond the grid, times the slope at its edge.
            let beyond = x - within;
            let before = if first { T::select_lt(x, begin, beyond, zero) } else { zero };
            let after = if last { T::select_lt(end, x, beyond, zero) } else { zero };
            let values = [v * v * T::fma(two, u, one), u * u * T::fma(-two, u, three)];
            return [values[0], values[1], width * u * v * v + before, after - width * u * u * v];
        }
        1 => {
            let steep = six * u * v / width;
            return [-steep, steep, v * T::fma(-two, u, v), u * T::fma(-two, v, u)];
        }
        2 => {
            let bend = six * (v - u) / (width * width);
            [-bend, bend, (two * u - two * two * v) / width, (two * two * u - two * v) / width]
        }
        3 => {
            let square = six / (width * width);
            let twist = two * square / width;
            [twist, -twist, square, square]
        }
        _ => [zero; 4],
    };
    // The straight lines beyond have no second derivative.
    weights.map(|mut weight| {
        if first {
            weight = T::select_lt(x, begin, zero, weight);
        }
        if last {
            weight = T::select_lt(end, x, zero, weight);
        }
        weight
    })
}

#[cfg(test)]
#[path = "grid_tests.rs"]
mod tests;
