//! Dense linear algebra in double precision: Gaussian elimination with partial pivoting.

pub type Matrix = Vec<Vec<f64>>;

/// The inverse; `None` where a pivot vanishes.
pub fn inverse(matrix: &Matrix) -> Option<Matrix> {
    let n = matrix.len();
    let mut rows: Matrix = matrix
        .iter()
        .enumerate()
        .map(|(i, row)| row.iter().copied().chain((0..n).map(|j| f64::from(u8::from(i == j)))).collect())
        .collect();
    for column in 0..n {
        let best = (column..n).max_by(|&i, &j| rows[i][column].abs().total_cmp(&rows[j][column].abs()))?;
        rows.swap(column, best);
        let pivot = rows[column].clone();
        if pivot[column] == 0.0 {
            return None;
        }
        for (i, row) in rows.iter_mut().enumerate() {
            let factor = row[column] / pivot[column];
            if i == column {
                row.iter_mut().for_each(|x| *x /= pivot[column]);
            } else if factor != 0.0 {
                row.iter_mut().zip(&pivot).for_each(|(x, p)| *x -= factor * p);
            }
        }
    }
    Some(rows.into_iter().map(|row| row[n..].to_vec()).collect())
}

pub fn apply(matrix: &Matrix, x: &[f64]) -> Vec<f64> {
    matrix.iter().map(|row| dot(row, x)).collect()
}

pub fn transposed(matrix: &Matrix, columns: usize) -> Matrix {
    (0..columns).map(|j| matrix.iter().map(|row| row[j]).collect()).collect()
}

pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Largest sum of a row.
pub fn norm(matrix: &Matrix) -> f64 {
    matrix.iter().map(|row| row.iter().map(|x| x.abs()).sum()).fold(0.0, f64::max)
}

pub fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m, x| m.max(x.abs()))
}

/// `½ x·A x − x·force` at its least among all x with `J x = bias`: x, and the multipliers λ of `A x = force + Jᵀλ`.
pub struct Saddle {
    inverse: Matrix,
    n: usize,
    /// ‖K⁻¹‖ and the condition number of K, with K the whole matrix.
    pub inverse_norm: f64,
    pub condition: f64,
}

impl Saddle {
    /// `None` where there is no single minimiser.
    pub fn new(matrix: &Matrix, jacobian: &Matrix) -> Option<Self> {
        let n = matrix.len();
        let forces = transposed(jacobian, n);
        let upper = matrix.iter().zip(forces).map(|(row, force)| {
            let force: Vec<f64> = force.iter().map(|j| -j).collect();
            [row.clone(), force].concat()
        });
        let lower = jacobian.iter().map(|row| [row.clone(), vec![0.0; jacobian.len()]].concat());
        let whole: Matrix = upper.chain(lower).collect();
        let inverse = inverse(&whole)?;
        let inverse_norm = norm(&inverse);
        let condition = inverse_norm * norm(&whole);
        condition.is_finite().then_some(Self { inverse, n, inverse_norm, condition })
    }

    pub fn solve(&self, force: &[f64], bias: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let mut x = apply(&self.inverse, &[force, bias].concat());
        let multipliers = x.split_off(self.n);
        (x, multipliers)
    }
}
