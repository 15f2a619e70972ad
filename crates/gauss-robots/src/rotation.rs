//! Constant rotations, and what they turn, in double precision.

use std::f64::consts::FRAC_PI_2;

/// Components of a vector.
pub type Triple = [f64; 3];
/// Rows.
pub type Matrix = [Triple; 3];

/// Bound of the rounding that is left of a zero, where lengths are one.
const RESIDUE: f64 = 1e-15;

/// R = R_z(yaw) R_y(pitch) R_x(roll).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotation {
    /// Roll, pitch, yaw.
    pub angles: Triple,
    /// R, which takes components in turned axes to those in fixed axes.
    pub matrix: Matrix,
}

impl Rotation {
    /// From angles about the fixed axes, first to third.
    pub fn from_angles(angles: Triple) -> Rotation {
        let angles = angles.map(settled);
        let matrix = multiply(&about(2, angles[2]), &multiply(&about(1, angles[1]), &about(0, angles[0])));
        Rotation { angles, matrix }
    }

    /// The angles of a matrix, and the matrix of these.
    pub fn from_matrix(r: &Matrix) -> Rotation {
        let across = r[2][1].hypot(r[2][2]);
        // Where the first and the last turn are about one axis, one of them is enough.
        let roll = if across > RESIDUE { settled(r[2][1].atan2(r[2][2])) } else { 0.0 };
        // Near there rounding leaves little of the roll; the yaw is that of what it leaves, R R_x(−roll), and makes it
        // good.
        let [sine, cosine] = sine_and_cosine(roll);
        let [x, y] = [0, 1].map(|i| r[i][1] * cosine - r[i][2] * sine);
        Rotation::from_angles([roll, (-r[2][0]).atan2(across), (-x).atan2(y)])
    }

    /// No turn.
    pub fn none() -> Rotation {
        Rotation::from_angles([0.0; 3])
    }
}

/// Sums of halves of π, and zero, without what rounding left of them.
pub fn settled(angle: f64) -> f64 {
    let quarters = (angle / FRAC_PI_2).round();
    let exact = quarters * FRAC_PI_2;
    if (angle - exact).abs() <= RESIDUE * (1.0 + exact.abs()) { exact } else { angle }
}

/// Sine and cosine, exact at quarters of a turn.
pub fn sine_and_cosine(angle: f64) -> [f64; 2] {
    let quarters = (angle / FRAC_PI_2).round();
    if angle == quarters * FRAC_PI_2 {
        let at = |k: f64| [0.0, 1.0, 0.0, -1.0][(quarters + k).rem_euclid(4.0) as usize];
        return [at(0.0), at(1.0)];
    }
    [angle.sin(), angle.cos()]
}

/// The turn about an axis of the frame.
pub fn about(axis: usize, angle: f64) -> Matrix {
    let [sine, cosine] = sine_and_cosine(angle);
    let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut matrix = [[0.0; 3]; 3];
    matrix[axis][axis] = 1.0;
    (matrix[j][j], matrix[k][k]) = (cosine, cosine);
    (matrix[j][k], matrix[k][j]) = (-sine, sine);
    matrix
}

/// The turn by an angle about a direction of length one.
pub fn about_direction(n: &Triple, angle: f64) -> Matrix {
    let [sine, cosine] = sine_and_cosine(angle);
    let across = |i: usize, j: usize| match (j + 3 - i) % 3 {
        0 => cosine,
        1 => -sine * n[3 - i - j],
        _ => sine * n[3 - i - j],
    };
    std::array::from_fn(|i| std::array::from_fn(|j| (1.0 - cosine) * n[i] * n[j] + across(i, j)))
}

/// The turn of a quaternion (w, x, y, z) of any length; `None` of one that is zero.
pub fn of_quaternion(q: [f64; 4]) -> Option<Matrix> {
    let square: f64 = q.iter().map(|c| c * c).sum();
    if square == 0.0 || !square.is_finite() {
        return None;
    }
    let [w, x, y, z] = q;
    let entry = |e: f64| e / square;
    Some([
        [entry(w * w + x * x - y * y - z * z), entry(2.0 * (x * y - w * z)), entry(2.0 * (x * z + w * y))],
        [entry(2.0 * (x * y + w * z)), entry(w * w - x * x + y * y - z * z), entry(2.0 * (y * z - w * x))],
        [entry(2.0 * (x * z - w * y)), entry(2.0 * (y * z + w * x)), entry(w * w - x * x - y * y + z * z)],
    ])
}

/// A B.
pub fn multiply(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
}

/// R v.
pub fn turned(matrix: &Matrix, v: &Triple) -> Triple {
    std::array::from_fn(|i| (0..3).map(|j| matrix[i][j] * v[j]).sum())
}

/// R I Rᵀ.
pub fn turned_tensor(matrix: &Matrix, tensor: &Matrix) -> Matrix {
    let half = multiply(matrix, tensor);
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            // Once for both of two entries: the result is symmetric to the last bit.
            let (i, j) = (i.min(j), i.max(j));
            let entry: f64 = (0..3).map(|k| half[i][k] * matrix[j][k]).sum();
            // Smaller than the rounding of the products that it is the sum of: a zero, which can have either sign.
            let size: f64 = (0..3).map(|k| (half[i][k] * matrix[j][k]).abs()).sum();
            let largest = tensor.iter().flatten().fold(0.0, |largest: f64, c| largest.max(c.abs()));
            if entry.abs() <= f64::EPSILON * size.max(largest) { 0.0 } else { entry }
        })
    })
}

/// The vector with length one, what rounding left of zeros removed; `None` without a direction.
pub fn direction(v: Triple) -> Option<Triple> {
    let largest = v.iter().fold(0.0, |largest: f64, c| largest.max(c.abs()));
    if largest == 0.0 || !largest.is_finite() {
        return None;
    }
    let scaled = v.map(|c| c / largest);
    let length = scaled.iter().map(|c| c * c).sum::<f64>().sqrt();
    Some(scaled.map(|c| c / length).map(|c| if c.abs() <= RESIDUE { 0.0 } else { c }))
}

/// The eigenvalues of a symmetric matrix with their directions, the columns of a matrix, by turns that bring the
/// entries off the diagonal to zero (Jacobi).
pub fn principal(mut a: Matrix) -> (Triple, Matrix) {
    let mut axes = Rotation::none().matrix;
    // Each round squares what is left of them.
    for _ in 0..16 {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if a[p][q] == 0.0 {
                continue;
            }
            let slope = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
            let tangent = slope.signum() / (slope.abs() + slope.hypot(1.0));
            let cosine = 1.0 / tangent.hypot(1.0);
            let sine = tangent * cosine;
            for row in a.iter_mut().chain(&mut axes) {
                (row[p], row[q]) = (cosine * row[p] - sine * row[q], sine * row[p] + cosine * row[q]);
            }
            for k in 0..3 {
                (a[p][k], a[q][k]) = (cosine * a[p][k] - sine * a[q][k], sine * a[p][k] + cosine * a[q][k]);
            }
        }
    }
    ([a[0][0], a[1][1], a[2][2]], axes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarters_of_a_turn_are_exact() {
        let rotation = Rotation::from_angles([-FRAC_PI_2, 2.2e-16, std::f64::consts::PI]);
        assert_eq!(rotation.matrix, [[-1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, -1.0, 0.0]]);
        assert_eq!(settled(1.571), 1.571);
    }

    #[test]
    fn matrices_and_back() {
        let near = [0, 3, 6, 9, 12, 14, 15].map(|digits| [0.4, FRAC_PI_2 - 10.0_f64.powi(-digits), 1.1]);
        let others =
            [[0.1, 0.2, -0.3], [0.0, FRAC_PI_2, 0.7], [3.0, -1.0, 2.0], [0.0, 0.0, -FRAC_PI_2], [2.0, -1.57, 3.0]];
        for angles in near.into_iter().chain(others) {
            let rotation = Rotation::from_angles(angles);
            let again = Rotation::from_matrix(&rotation.matrix);
            for (a, b) in rotation.matrix.iter().flatten().zip(again.matrix.iter().flatten()) {
                assert!((a - b).abs() <= 4.0 * f64::EPSILON, "{angles:?}");
            }
        }
    }

    /// Turned moments are the same moments, and their directions are turned.
    #[test]
    fn principal_moments() {
        for angles in [[0.0; 3], [0.3, -0.7, 1.1], [2.0, 0.5, -0.1]] {
            let turn = Rotation::from_angles(angles).matrix;
            let tensor = turned_tensor(&turn, &[[1.0, 0.0, 0.0], [0.0, 2.5, 0.0], [0.0, 0.0, 3.0]]);
            let (found, axes) = principal(tensor);
            let diagonal = std::array::from_fn(|i| std::array::from_fn(|j| if i == j { found[i] } else { 0.0 }));
            let again = turned_tensor(&axes, &diagonal);
            for (a, b) in again.iter().flatten().zip(tensor.iter().flatten()) {
                assert!((a - b).abs() < 64.0 * f64::EPSILON, "{a} {b}");
            }
            let mut found = found;
            found.sort_by(f64::total_cmp);
            for (found, expected) in found.into_iter().zip([1.0, 2.5, 3.0]) {
                assert!((found - expected).abs() < 16.0 * f64::EPSILON, "{found} {expected}");
            }
        }
    }

    #[test]
    fn directions() {
        assert_eq!(direction([0.0, 0.0, -2.0]), Some([0.0, 0.0, -1.0]));
        assert_eq!(direction([0.0; 3]), None);
        assert_eq!(direction([1e-300, 0.0, 0.0]), Some([1.0, 0.0, 0.0]));
    }
}
