//! Operational space: the inertia that a frame shows to forces at it, and the mass matrix factored.
//!
//! With J the [Jacobian](crate::frames::FramedSystem::jacobian_of) of a task (rows of one frame or of several), forces
//! F at it accelerate it by `Λ⁻¹ F`, where `Λ = (J A⁻¹ Jᵀ)⁻¹`; O. Khatib, *A unified approach for motion and force
//! control of robot manipulators: the operational space formulation*, IEEE Journal of Robotics and Automation 3 (1987).

use core::fmt;

use nalgebra::{SMatrix, SVector};

use crate::real::Real;

/// A = L Lᵀ, L lower triangular with positive diagonal: a mass matrix, factored once for many right-hand sides.
///
/// Accelerations do not need it: [`acceleration`](crate::system::GaussSystem::acceleration) uses the
/// structure of the system. This is for computations of your own with A.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Factor<T, const N: usize> {
    lower: SMatrix<T, N, N>,
}

impl<T: Real, const N: usize> Factor<T, N> {
    /// Factors a symmetric matrix, of which the entries on and below the diagonal are read.
    ///
    /// # Errors
    /// [`OperationalError::NotPositive`] at the first row that is not positive definite together with those before it.
    pub fn of(matrix: &SMatrix<T, N, N>) -> Result<Self, OperationalError> {
        let mut lower = SMatrix::from_fn(|_, _| T::zero());
        for k in 0..N {
            let pivot = (0..k).fold(matrix[(k, k)], |sum, j| sum - lower[(k, j)] * lower[(k, j)]);
            // Written so that a NaN is refused; of lanes each counts.
            if !(0..T::LANES).all(|lane| pivot.lane(lane) > 0.0) {
                return Err(OperationalError::NotPositive { row: k });
            }
            let root = pivot.sqrt();
            lower[(k, k)] = root;
            for i in k + 1..N {
                let rest = (0..k).fold(matrix[(i, k)], |sum, j| sum - lower[(i, j)] * lower[(k, j)]);
                lower[(i, k)] = rest / root;
            }
        }
        Ok(Self { lower })
    }

    /// L.
    pub fn lower(&self) -> &SMatrix<T, N, N> {
        &self.lower
    }

    /// `A⁻¹ b`, column by column.
    #[must_use]
    pub fn solve<const C: usize>(&self, right: &SMatrix<T, N, C>) -> SMatrix<T, N, C> {
        self.backward(&self.forward(right))
    }

    /// `L⁻¹ b`.
    fn forward<const C: usize>(&self, right: &SMatrix<T, N, C>) -> SMatrix<T, N, C> {
        let mut x = *right;
        for column in 0..C {
            for i in 0..N {
                let rest = (0..i).fold(x[(i, column)], |sum, j| sum - self.lower[(i, j)] * x[(j, column)]);
                x[(i, column)] = rest / self.lower[(i, i)];
            }
        }
        x
    }

    /// `L⁻ᵀ b`.
    fn backward<const C: usize>(&self, right: &SMatrix<T, N, C>) -> SMatrix<T, N, C> {
        let mut x = *right;
        for column in 0..C {
            for i in (0..N).rev() {
                let rest = (i + 1..N).fold(x[(i, column)], |sum, j| sum - self.lower[(j, i)] * x[(j, column)]);
                x[(i, column)] = rest / self.lower[(i, i)];
            }
        }
        x
    }

    /// The largest over the smallest diagonal entry: L is conditioned no better than this.
    fn spread(&self, lane: usize) -> f64 {
        let entries = (0..N).map(|k| self.lower[(k, k)].lane(lane));
        entries.clone().fold(0.0, f64::max) / entries.fold(f64::INFINITY, f64::min)
    }
}

/// Inertia and generalised inverse of a task with K rows in a system with N speeds. Components are those of the rows of
/// its Jacobian.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct OperationalSpace<T, const K: usize, const N: usize> {
    /// `Λ = (J A⁻¹ Jᵀ)⁻¹`.
    pub inertia: SMatrix<T, K, K>,
    /// `J̄ = A⁻¹ Jᵀ Λ`, the inverse of J with the least kinetic energy: `J J̄ = 1`, and generalised forces τ with
    /// `J̄ᵀ τ = 0` do not accelerate the task.
    pub inverse: SMatrix<T, N, K>,
}

impl<T: Real, const K: usize, const N: usize> OperationalSpace<T, K, N> {
    /// From a mass matrix and the Jacobian of a task: all six rows of that of a frame, or the upper three for its
    /// origin.
    ///
    /// `J A⁻¹ Jᵀ` is not formed: `L⁻¹ Jᵀ` is orthogonalised, so that errors near a singularity grow with the condition
    /// number of J and not with its square.
    ///
    /// # Errors
    /// [`OperationalError::Singular`] where a row of J depends on those before it up to rounding, or K > N;
    /// [`OperationalError::NotPositive`].
    pub fn new(mass_matrix: &SMatrix<T, N, N>, jacobian: &SMatrix<T, K, N>) -> Result<Self, OperationalError> {
        let factor = Factor::of(mass_matrix)?;
        let (q, r) = orthogonalised(&factor, jacobian)?;
        // X = R⁻¹: Λ = X Xᵀ, J̄ = L⁻ᵀ Q Xᵀ.
        let mut x: SMatrix<T, K, K> = SMatrix::from_fn(|_, _| T::zero());
        for column in 0..K {
            for i in (0..=column).rev() {
                let unit = if i == column { T::one() } else { T::zero() };
                let rest = (i + 1..=column).fold(unit, |sum, j| sum - r[(i, j)] * x[(j, column)]);
                x[(i, column)] = rest / r[(i, i)];
            }
        }
        let inertia = times_transposed(&x, &x);
        let inverse = factor.backward(&times_transposed(&q, &x));
        Ok(Self { inertia, inverse })
    }

    /// The generalised forces that accelerate the task as wanted, `Jᵀ Λ (wanted − bias)`: to be added to what holds the
    /// system without acceleration ([`inverse_dynamics`](crate::system::GaussSystem::inverse_dynamics) at ż = 0).
    #[must_use]
    pub fn forces(&self, jacobian: &SMatrix<T, K, N>, wanted: &SVector<T, K>, bias: &SVector<T, K>) -> SVector<T, N> {
        let lacking: [T; K] = core::array::from_fn(|i| wanted[i] - bias[i]);
        let force: [T; K] =
            core::array::from_fn(|i| (0..K).fold(T::zero(), |sum, j| self.inertia[(i, j)].fma(lacking[j], sum)));
        SVector::from(core::array::from_fn(|k| (0..K).fold(T::zero(), |sum, i| jacobian[(i, k)].fma(force[i], sum))))
    }

    /// The part of generalised forces that does not accelerate the task: `τ − Jᵀ J̄ᵀ τ`.
    #[must_use]
    pub fn null_space(&self, jacobian: &SMatrix<T, K, N>, forces: &SVector<T, N>) -> SVector<T, N> {
        let seen: [T; K] =
            core::array::from_fn(|i| (0..N).fold(T::zero(), |sum, k| self.inverse[(k, i)].fma(forces[k], sum)));
        SVector::from(core::array::from_fn(|k| (0..K).fold(forces[k], |sum, i| sum - jacobian[(i, k)] * seen[i])))
    }
}

/// `L⁻¹ Jᵀ = Q R` with orthonormal columns of Q and R upper triangular, by modified Gram–Schmidt.
fn orthogonalised<T: Real, const K: usize, const N: usize>(
    factor: &Factor<T, N>,
    jacobian: &SMatrix<T, K, N>,
) -> Result<(SMatrix<T, N, K>, SMatrix<T, K, K>), OperationalError> {
    let mut q = factor.forward(&SMatrix::from_fn(|i, k| jacobian[(k, i)]));
    let mut r: SMatrix<T, K, K> = SMatrix::from_fn(|_, _| T::zero());
    for k in 0..K {
        let whole = length(&q, k);
        // Twice is enough for a right angle up to rounding.
        for _ in 0..2 {
            for j in 0..k {
                let along = (0..N).fold(T::zero(), |sum, i| q[(i, j)].fma(q[(i, k)], sum));
                r[(j, k)] += along;
                for i in 0..N {
                    q[(i, k)] = q[(i, k)] - along * q[(i, j)];
                }
            }
        }
        let left = length(&q, k);
        for lane in 0..T::LANES {
            // Rounding of the solution by L, which is conditioned no better than its diagonal is spread.
            let rounding = 4.0 * N as f64 * T::EPSILON * factor.spread(lane);
            let sine = left.lane(lane) / whole.lane(lane);
            if k >= N || sine.is_nan() || sine <= rounding {
                return Err(OperationalError::Singular { row: k });
            }
        }
        r[(k, k)] = left;
        for i in 0..N {
            q[(i, k)] /= left;
        }
    }
    Ok((q, r))
}

/// `a bᵀ`.
fn times_transposed<T: Real, const R: usize, const C: usize, const K: usize>(
    a: &SMatrix<T, R, K>,
    b: &SMatrix<T, C, K>,
) -> SMatrix<T, R, C> {
    SMatrix::from_fn(|i, k| (0..K).fold(T::zero(), |sum, j| a[(i, j)].fma(b[(k, j)], sum)))
}

/// The length of a column.
fn length<T: Real, const N: usize, const K: usize>(columns: &SMatrix<T, N, K>, k: usize) -> T {
    (0..N).fold(T::zero(), |sum, i| columns[(i, k)].fma(columns[(i, k)], sum)).sqrt()
}

/// Why there is no operational space.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum OperationalError {
    /// This row of the Jacobian, counted from 0, depends on those before it up to rounding: the task cannot be
    /// accelerated in all its directions. Leave rows out, or move away from there.
    Singular {
        /// The row.
        row: usize,
    },
    /// The mass matrix is not positive definite in this row, together with those before it.
    NotPositive {
        /// The row.
        row: usize,
    },
}

impl fmt::Display for OperationalError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Singular { row } => write!(
                f,
                "row {row} of the Jacobian depends on the rows before it: the task is singular here; leave rows out, or move away"
            ),
            Self::NotPositive { row } => write!(f, "the mass matrix is not positive definite in row {row}"),
        }
    }
}

impl core::error::Error for OperationalError {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::Lanes;

    /// A = B Bᵀ + 1 and J with entries that nothing relates.
    fn sample() -> (SMatrix<f64, 5, 5>, SMatrix<f64, 3, 5>) {
        let mut state = 1_u64;
        let mut next = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        let b: SMatrix<f64, 5, 5> = SMatrix::from_fn(|_, _| next());
        let jacobian: SMatrix<f64, 3, 5> = SMatrix::from_fn(|_, _| next());
        (b * b.transpose() + SMatrix::identity(), jacobian)
    }

    #[test]
    fn forces_accelerate_the_task_as_wanted_and_those_of_the_null_space_do_not() {
        let (matrix, jacobian) = sample();
        let space = OperationalSpace::new(&matrix, &jacobian).unwrap();
        let (wanted, bias) = (SVector::from([1.0, -2.0, 0.5]), SVector::from([0.3, 0.1, -0.7]));
        let rates = Factor::of(&matrix).unwrap().solve(&space.forces(&jacobian, &wanted, &bias));
        // Some 10² roundings of numbers of order 1 to 10.
        assert!((jacobian * rates + bias - wanted).amax() < 1e-13);
        let any = SVector::from([1.0, 2.0, -3.0, 0.5, -1.0]);
        let rates = Factor::of(&matrix).unwrap().solve(&space.null_space(&jacobian, &any));
        assert!((jacobian * rates).amax() < 1e-13 && rates.amax() > 0.1);
    }

    #[test]
    fn singular_tasks_and_matrices_are_refused() {
        let (matrix, mut jacobian) = sample();
        for k in 0..5 {
            jacobian[(2, k)] = 2.0 * jacobian[(0, k)] - jacobian[(1, k)] / 3.0;
        }
        assert_eq!(OperationalSpace::new(&matrix, &jacobian), Err(OperationalError::Singular { row: 2 }));
        jacobian.fill_row(0, 0.0);
        assert_eq!(OperationalSpace::new(&matrix, &jacobian), Err(OperationalError::Singular { row: 0 }));
        let tall: SMatrix<f64, 3, 2> = SMatrix::from_fn(|i, k| (1 + i * i + 3 * k) as f64);
        let error = OperationalSpace::new(&SMatrix::<f64, 2, 2>::identity(), &tall);
        assert_eq!(error, Err(OperationalError::Singular { row: 2 }));
        let mut matrix = matrix;
        matrix[(3, 3)] = -1.0;
        let error = Factor::of(&matrix).unwrap_err();
        assert_eq!(error, OperationalError::NotPositive { row: 3 });
        assert!(std::format!("{error}").contains("row 3"));
    }

    /// Every lane by itself.
    #[test]
    fn lanes_are_independent() {
        let (matrix, jacobian) = sample();
        let lanes = |scale: f64, x: f64| Lanes([x, scale * x]);
        let of_lanes = OperationalSpace::new(&matrix.map(|x| lanes(2.0, x)), &jacobian.map(|x| lanes(1.0, x))).unwrap();
        let alone = OperationalSpace::new(&matrix, &jacobian).unwrap();
        for (both, one) in of_lanes.inertia.iter().zip(alone.inertia.iter()) {
            // Factors of 2 inside a root: the second lane rounds otherwise, by some units in the last place.
            assert!(both.lane(0) == *one && (both.lane(1) - 2.0 * one).abs() < 1e-13 * (1.0 + one.abs()));
        }
    }
}
