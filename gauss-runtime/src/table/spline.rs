//! Slopes of curves through points, worked out by the compiler.

/// First derivatives of the natural spline at its points.
pub(super) const fn slopes_of_spline<const N: usize>(points: &[[f64; 2]; N]) -> [f64; N] {
    let curvature = curvatures(points);
    let mut slopes = [0.0; N];
    let mut i = 0;
    while i < N {
        // By the piece after the point, of the last one by the piece before it.
        let from = if i + 1 < N { i } else { i - 1 };
        let (secant, h) = secant(points, from);
        let (a, b) = (curvature[from], curvature[from + 1]);
        slopes[i] = if i == from { secant - h * (2.0 * a + b) / 6.0 } else { secant + h * (a + 2.0 * b) / 6.0 };
        i += 1;
    }
    slopes
}

/// Slopes of the parabolas through each point and its neighbours; at the ends of those through the last three.
pub(super) const fn slopes_of_parabolas<const N: usize>(points: &[[f64; 2]; N]) -> [f64; N] {
    let mut slopes = [0.0; N];
    let mut i = 0;
    while i < N {
        let middle = if N == 2 || i == 0 {
            1
        } else if i + 1 == N {
            i - 1
        } else {
            i
        };
        let (before, width) = secant(points, middle - 1);
        if N == 2 {
            slopes[i] = before;
        } else {
            let (after, next) = secant(points, middle);
            // The parabola's slope at the middle, and by its curvature at the point.
            let curvature = (after - before) / (width + next);
            slopes[i] = before + curvature * width + 2.0 * curvature * (points[i][0] - points[middle][0]);
        }
        i += 1;
    }
    slopes
}

/// The slope of the secant from a point to the next, and how far that is.
const fn secant<const N: usize>(points: &[[f64; 2]; N], from: usize) -> (f64, f64) {
    let width = points[from + 1][0] - points[from][0];
    ((points[from + 1][1] - points[from][1]) / width, width)
}

/// Second derivatives of the natural spline at its points: zero at the ends; the tridiagonal system for the others is
/// diagonally dominant, and eliminated as it stands (de Boor, A Practical Guide to Splines, IV).
pub(super) const fn curvatures<const N: usize>(points: &[[f64; 2]; N]) -> [f64; N] {
    // Row i: h₋ m₋ + 2 (h₋ + h₊) m + h₊ m₊ = 6 (s₊ − s₋), where h are widths and s slopes of secants.
    let (mut upper, mut right) = ([0.0; N], [0.0; N]);
    let mut i = 1;
    while i + 1 < N {
        let (before, after) = (points[i][0] - points[i - 1][0], points[i + 1][0] - points[i][0]);
        let slopes = [(points[i][1] - points[i - 1][1]) / before, (points[i + 1][1] - points[i][1]) / after];
        let pivot = 2.0 * (before + after) - before * upper[i - 1];
        upper[i] = after / pivot;
        right[i] = (6.0 * (slopes[1] - slopes[0]) - before * right[i - 1]) / pivot;
        i += 1;
    }
    let mut curvature = [0.0; N];
    let mut i = N - 1;
    while i > 1 {
        i -= 1;
        curvature[i] = right[i] - upper[i] * curvature[i + 1];
    }
    curvature
}
