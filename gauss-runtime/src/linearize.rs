//! Exact derivatives of the equations of motion by the state, time and the input: what control, estimation and linearly
//! implicit integrators are made of.
//!
//! `#[gauss(linearize)]` on a struct has the derive write them: its kernel then implements [`LinearizedSystem`].

use core::fmt::Debug;

use nalgebra::{Complex, SMatrix, SVector};

use crate::configuration::{Configuration, VectorSpace};
use crate::real::Real;
use crate::sealed::Sealed;
use crate::system::GaussSystem;

/// A system whose equations come with their derivatives: the same instructions differentiated one by one, or, where
/// that is shorter, −A⁻¹ times the derivatives of the forces at fixed accelerations.
///
/// The state moves by (σ, δz): `q ∘ exp(σ)` as everywhere in this crate (seen from the body: for a pose its first three
/// components move O along body axes, the last three turn about them), and `z + δz`. Rates are (V, ż), with V the
/// velocity of the configuration, q̇ seen from the body.
///
#[cfg_attr(
    feature = "derive",
    doc = r##"
```
use gauss_runtime::prelude::*;

/// A pendulum with a motor at its hinge.
#[derive(GaussDynamics)]
#[gauss(
    linearize,
    coordinates(theta),
    particle(mass = m, position = [l * sin(theta), 0, -l * cos(theta)]),
    input(torque),
    drive(theta = torque),
)]
struct Pendulum {
    m: f64,
    l: f64,
    #[gauss(gravity)]
    g: f64,
}

# fn main() -> Result<(), Box<dyn std::error::Error>> {
let kernel = Pendulum { m: 2.0, l: 0.5, g: 9.81 }.kernel()?;
// Upright: θ̈ = −(g/l) sin θ + torque/(m l²).
let (up, still) = (SVector::from([std::f64::consts::PI]), SVector::from([0.0]));
let linear = kernel.linearize(0.0, &up, &still, &SVector::from([0.0]));
assert!((linear.by_state[(1, 0)] - 9.81 / 0.5).abs() < 1e-12);
assert!((linear.by_input[(1, 0)] - 1.0 / (2.0 * 0.25)).abs() < 1e-12);
assert_eq!(linear.by_state[(0, 1)], 1.0);
# Ok(())
# }
```
"##
)]
#[doc(alias = "jacobian")]
#[doc(alias = "riccati")]
#[doc(alias = "lqr")]
#[doc(alias = "kalman")]
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no derivatives, because its struct does not ask for them",
    label = "the clause `linearize` brings them",
    note = "add `linearize` to the `#[gauss(…)]` of the struct"
)]
pub trait LinearizedSystem: GaussSystem<Input: VectorSpace<<Self as GaussSystem>::Scalar>> {
    /// [`Linearization`] of this system's sizes.
    type Linearization: LinearModel<Self::Scalar>;

    /// Which entries of [`Linearization::by_state`] can be other than zero, row by row.
    const STATE_PATTERN: &'static [&'static [bool]];

    /// Which entries of [`Linearization::by_input`] can be other than zero, row by row.
    const INPUT_PATTERN: &'static [&'static [bool]];

    /// (V, ż) and all their derivatives, exact up to rounding; under constraints those of the accelerations that
    /// satisfy them. Contact forces are not in them: of a scene with [contacts](GaussSystem::HAS_CONTACTS) these are
    /// the derivatives where all gaps are open; `gauss_adapters::linearize` takes an `InMode` of the crate
    /// `gauss-contact`.
    ///
    /// Where a force has a kink (`abs`, `min`, `max`, `clamp`) the derivative is the mean of those on its two sides;
    /// that of a jump (`signum`) is 0. Where a root is 0 its infinite slope is replaced by a huge one, so that what
    /// does not change to first order, such as |v| v at rest, has the derivative 0. Non-finite input gives non-finite
    /// output.
    fn linearize(
        &self,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
        input: &Self::Input,
    ) -> Self::Linearization;
}

/// The rates (V, ż) of a state (q, z) and their derivatives. D counts the components of (σ, δz), U those of the input.
///
/// | rows | columns of `by_state` | block |
/// |---|---|---|
/// | V | σ, then δz | ∂V/∂σ, ∂V/∂z |
/// | ż | σ, then δz | ∂ż/∂σ, ∂ż/∂z |
///
/// V and σ have the components of the increments of the configuration ([`Configuration::Tangent`]). The time derivative
/// of a small deviation (σ, δz) from a motion is given by [`error_matrix`].
///
/// [`Configuration::Tangent`]: crate::configuration::Configuration::Tangent
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Linearization<T, const D: usize, const U: usize> {
    /// V, then ż.
    pub rate: SVector<T, D>,
    /// ∂(V, ż)/∂(σ, z).
    pub by_state: SMatrix<T, D, D>,
    /// ∂(V, ż)/∂t, explicit in time: 0 where the equations do not name it.
    pub by_time: SVector<T, D>,
    /// ∂(V, ż)/∂input.
    pub by_input: SMatrix<T, D, U>,
}

impl<T, const D: usize, const U: usize> Linearization<T, D, U> {
    /// From its parts, in the order of the fields.
    #[inline(always)]
    pub fn new(
        rate: SVector<T, D>,
        by_state: SMatrix<T, D, D>,
        by_time: SVector<T, D>,
        by_input: SMatrix<T, D, U>,
    ) -> Self {
        Self { rate, by_state, by_time, by_input }
    }
}

/// A [`Linearization`] without its sizes, for code over every system. Implemented by that type alone.
pub trait LinearModel<T: Real>: Copy + Debug + Sealed {
    /// `SVector` of (σ, δz).
    type Vector: VectorSpace<T>;
    /// `SMatrix` of that size, square.
    type Matrix: Copy + Debug;
    /// The same, factored.
    type Factors: Factored<T, Self::Vector>;
    /// A complex matrix of that size, factored, for real and imaginary parts of vectors.
    type ComplexFactors: Factored<T, [Self::Vector; 2]>;

    /// V, then ż.
    fn rate(&self) -> &Self::Vector;
    /// Entry of ∂(V, ż)/∂(σ, z).
    fn by_state(&self, row: usize, column: usize) -> T;
    /// ∂(V, ż)/∂t.
    fn by_time(&self) -> &Self::Vector;
    /// Entry of ∂(V, ż)/∂input.
    fn by_input(&self, row: usize, column: usize) -> T;
    /// The matrix with the given entries.
    fn matrix(entry: impl FnMut(usize, usize) -> T) -> Self::Matrix;
    /// The factors of the matrix with the given entries. Those of a singular one are not finite.
    fn factor(entry: impl FnMut(usize, usize) -> T) -> Self::Factors;
    /// The factors of the complex matrix with the given entries. Those of a singular one are not finite.
    fn factor_complex(entry: impl FnMut(usize, usize) -> Complex<T>) -> Self::ComplexFactors;
    /// The same with other entries of ∂(V, ż)/∂(σ, z).
    #[must_use]
    fn with_state_slopes(&self, entry: impl FnMut(usize, usize) -> T) -> Self;
}

/// A square matrix, ready for right-hand sides.
pub trait Factored<T: Real, V>: Sealed {
    /// x with `matrix · x = right`; not finite where the matrix is singular.
    fn solve(&self, right: &V) -> V;
}

impl<T, const D: usize, const U: usize> Sealed for Linearization<T, D, U> {}

impl<T: Real, const D: usize, const U: usize> LinearModel<T> for Linearization<T, D, U> {
    type Vector = SVector<T, D>;
    type Matrix = SMatrix<T, D, D>;
    type Factors = Lu<T, D>;
    type ComplexFactors = Lu<Complex<T>, D>;

    #[inline(always)]
    fn rate(&self) -> &SVector<T, D> {
        &self.rate
    }
    #[inline(always)]
    fn by_state(&self, row: usize, column: usize) -> T {
        self.by_state.data.0[column][row]
    }
    #[inline(always)]
    fn by_time(&self) -> &SVector<T, D> {
        &self.by_time
    }
    #[inline(always)]
    fn by_input(&self, row: usize, column: usize) -> T {
        self.by_input.data.0[column][row]
    }
    #[inline]
    fn matrix(mut entry: impl FnMut(usize, usize) -> T) -> SMatrix<T, D, D> {
        SMatrix::from(core::array::from_fn::<_, D, _>(|column| core::array::from_fn(|row| entry(row, column))))
    }
    #[inline]
    fn factor(entry: impl FnMut(usize, usize) -> T) -> Lu<T, D> {
        Lu::of_entries(entry)
    }
    #[inline]
    fn factor_complex(entry: impl FnMut(usize, usize) -> Complex<T>) -> Lu<Complex<T>, D> {
        Lu::of_entries(entry)
    }
    #[inline]
    fn with_state_slopes(&self, entry: impl FnMut(usize, usize) -> T) -> Self {
        Self { by_state: Self::matrix(entry), ..*self }
    }
}

/// The matrix F of `d(σ, δz)/dt = F (σ, δz)`, for states a small increment away from a motion, as regulators and
/// filters need them.
///
/// The neighbour `q(t) ∘ exp(σ)` has the velocity V + ∂V/∂σ σ + ∂V/∂z δz, and its increment changes by what that is
/// more than V and by [σ, V], because it is seen in axes that move. So F is [`Linearization::by_state`] and, where the
/// configuration is a group, the bracket.
#[must_use]
pub fn error_matrix<S: LinearizedSystem>(
    linear: &S::Linearization,
) -> <S::Linearization as LinearModel<S::Scalar>>::Matrix {
    let two = S::Scalar::from_f64(2.0);
    let mut bracket = brackets::<S>(linear, Velocity::<S>::zero());
    S::Linearization::matrix(|row, column| two.fma(bracket(row, column), linear.by_state(row, column)))
}

type Velocity<S> = <<S as GaussSystem>::Configuration as Configuration>::Tangent;

/// Entries of ½ [σ, V] as a matrix on the state, column by column. V is put into a velocity that is there: of models
/// that come at run time it knows of what groups it is.
pub(crate) fn brackets<S: LinearizedSystem>(
    linear: &S::Linearization,
    mut velocity: Velocity<S>,
) -> impl FnMut(usize, usize) -> S::Scalar {
    let components = Velocity::<S>::DIM;
    for i in 0..components {
        velocity.set_component(i, linear.rate().component(i));
    }
    let of_axis = move |k: usize| {
        let mut axis = Velocity::<S>::zero();
        axis.set_component(k, S::Scalar::one());
        S::Configuration::bracket(&axis, &velocity).scale(S::Scalar::ratio(1, 2))
    };
    // The closure may be called for entries in any order; the last column is kept.
    let mut known = (usize::MAX, Velocity::<S>::zero());
    move |row, column| {
        if row >= components || column >= components {
            return S::Scalar::zero();
        }
        if known.0 != column {
            known = (column, of_axis(column));
        }
        known.1.component(row)
    }
}

/// An entry of a matrix that is factored: a real number, or a complex one.
pub trait Entry: Copy {
    /// Zero.
    fn null() -> Self;
    /// `self − a b`.
    fn less(self, a: Self, b: Self) -> Self;
    /// `self · a`.
    fn times(self, a: Self) -> Self;
    /// `1/self`.
    fn reciprocal(self) -> Self;
    /// Magnitude of the least lane, up to a factor of √2: which pivot to take.
    fn size(self) -> f64;
}

impl<T: Real> Entry for T {
    #[inline(always)]
    fn null() -> Self {
        T::zero()
    }
    #[inline(always)]
    fn less(self, a: Self, b: Self) -> Self {
        (-a).fma(b, self)
    }
    #[inline(always)]
    fn times(self, a: Self) -> Self {
        self * a
    }
    #[inline(always)]
    fn reciprocal(self) -> Self {
        self.recip()
    }
    #[inline(always)]
    fn size(self) -> f64 {
        (0..T::LANES).map(|lane| Real::abs(self.lane(lane))).fold(f64::INFINITY, f64::min)
    }
}

impl<T: Real> Entry for Complex<T> {
    #[inline(always)]
    fn null() -> Self {
        Self { re: T::zero(), im: T::zero() }
    }
    #[inline(always)]
    fn less(self, a: Self, b: Self) -> Self {
        Self { re: a.im.fma(b.im, (-a.re).fma(b.re, self.re)), im: (-a.im).fma(b.re, (-a.re).fma(b.im, self.im)) }
    }
    #[inline(always)]
    fn times(self, a: Self) -> Self {
        Self { re: (-self.im).fma(a.im, self.re * a.re), im: self.im.fma(a.re, self.re * a.im) }
    }
    #[inline(always)]
    fn reciprocal(self) -> Self {
        // The squares of what is divided by its size cannot overflow.
        let size = (self.re.abs() + self.im.abs()).recip();
        let (re, im) = (self.re * size, self.im * size);
        let scale = size / re.fma(re, im * im);
        Self { re: re * scale, im: -(im * scale) }
    }
    #[inline(always)]
    fn size(self) -> f64 {
        (self.re.abs() + self.im.abs()).size()
    }
}

/// LU with partial pivoting, on the stack. Lanes share their pivots: the row whose least lane is the largest.
#[derive(Clone, Copy, Debug)]
pub struct Lu<T, const D: usize> {
    /// Multipliers below the diagonal, reciprocal pivots on it, U above.
    rows: [[T; D]; D],
    /// Row `k` of the factors is that row of the matrix.
    order: [usize; D],
}

impl<T: Entry, const D: usize> Lu<T, D> {
    /// The factors of the matrix with these rows.
    #[must_use]
    pub fn new(mut rows: [[T; D]; D]) -> Self {
        let mut order: [usize; D] = core::array::from_fn(|k| k);
        for k in 0..D {
            let mut best = k;
            for i in k + 1..D {
                if rows[i][k].size() > rows[best][k].size() {
                    best = i;
                }
            }
            rows.swap(k, best);
            order.swap(k, best);
            let reciprocal = rows[k][k].reciprocal();
            rows[k][k] = reciprocal;
            let pivot = rows[k];
            for row in &mut rows[k + 1..] {
                // Zeros are not skipped: dual numbers compare by their value, and what is zero may have a derivative.
                let factor = row[k].times(reciprocal);
                row[k] = factor;
                for j in k + 1..D {
                    row[j] = row[j].less(factor, pivot[j]);
                }
            }
        }
        Self { rows, order }
    }

    #[inline]
    fn of_entries(mut entry: impl FnMut(usize, usize) -> T) -> Self {
        let mut rows = [[T::null(); D]; D];
        for column in 0..D {
            for row in 0..D {
                rows[row][column] = entry(row, column);
            }
        }
        Self::new(rows)
    }

    #[inline]
    fn solution(&self, right: impl Fn(usize) -> T) -> [T; D] {
        let mut x: [T; D] = core::array::from_fn(|k| right(self.order[k]));
        for i in 1..D {
            for j in 0..i {
                x[i] = x[i].less(self.rows[i][j], x[j]);
            }
        }
        for i in (0..D).rev() {
            for j in i + 1..D {
                x[i] = x[i].less(self.rows[i][j], x[j]);
            }
            x[i] = x[i].times(self.rows[i][i]);
        }
        x
    }
}

impl<T, const D: usize> Sealed for Lu<T, D> {}

impl<T: Real, const D: usize> Factored<T, SVector<T, D>> for Lu<T, D> {
    #[inline]
    fn solve(&self, right: &SVector<T, D>) -> SVector<T, D> {
        SVector::from(self.solution(|k| right.data.0[0][k]))
    }
}

impl<T: Real, const D: usize> Factored<T, [SVector<T, D>; 2]> for Lu<Complex<T>, D> {
    #[inline]
    fn solve(&self, [re, im]: &[SVector<T, D>; 2]) -> [SVector<T, D>; 2] {
        let x = self.solution(|k| Complex { re: re.data.0[0][k], im: im.data.0[0][k] });
        [SVector::from(x.map(|x| x.re)), SVector::from(x.map(|x| x.im))]
    }
}

/// The input of a scene without inputs: a space without dimensions.
impl<T: Real> VectorSpace<T> for () {
    const DIM: usize = 0;

    #[inline(always)]
    fn zero() -> Self {}
    #[inline(always)]
    fn add_scaled(&self, _: T, (): &Self) -> Self {}
    #[inline(always)]
    fn scale(&self, _: T) -> Self {}
    /// # Panics
    /// Always: there is no component.
    fn component(&self, i: usize) -> T {
        panic!("component {i} of 0")
    }
    /// # Panics
    /// Always: there is no component.
    fn set_component(&mut self, i: usize, _: T) {
        panic!("component {i} of 0")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_solve_and_permute() {
        // A zero where the first pivot would be, and rows in three orders of magnitude.
        let rows = [[0.0, 2.0, -1.0, 0.5], [1e3, 3.0, 0.0, 2.0], [-4.0, 1.0, 6.0, 0.0], [0.25, 0.0, -0.5, 1e-3]];
        let x = SVector::from([1.0, -2.0, 3.0, -4.0]);
        let right = SMatrix::<f64, 4, 4>::from(rows).transpose() * x;
        let error = (Lu::new(rows).solve(&right) - x).amax();
        // D³/3 roundings, times a condition number of at most 1e4.
        assert!(error < 22.0 * 1e4 * f64::EPSILON, "{error:e}");
    }

    /// (A + iB)(x + iy), formed from real products, is solved for x and y.
    #[test]
    fn complex_factors_solve_and_permute() {
        let a = SMatrix::from([[0.0, 1e3, -4.0], [2.0, 3.0, 1.0], [-1.0, 0.0, 6.0]]);
        let b = SMatrix::from([[0.0, -3.0, 1.0], [0.5, 1e2, 0.0], [2.0, 0.0, -1.0]]);
        let (x, y) = (SVector::from([1.0, -2.0, 3.0]), SVector::from([0.5, 4.0, -1.0]));
        let factors = <Linearization<f64, 3, 0> as LinearModel<f64>>::factor_complex(|row, column| Complex {
            re: a[(row, column)],
            im: b[(row, column)],
        });
        let [re, im] = factors.solve(&[a * x - b * y, a * y + b * x]);
        let error = (re - x).amax().max((im - y).amax());
        // D³/3 roundings of complex products, times a condition number of at most 1e4.
        assert!(error < 4.0 * 9.0 * 1e4 * f64::EPSILON, "{error:e}");
    }

    #[test]
    fn singular_matrices_give_no_number() {
        let x = Lu::new([[1.0, 2.0], [2.0, 4.0]]).solve(&SVector::from([1.0, 1.0]));
        assert!(!x.iter().all(|x| x.is_finite()));
        let one = Complex { re: 1.0, im: 1.0 };
        let ones = SVector::from([1.0, 1.0]);
        let [x, _] = Lu::new([[one, one], [one, one]]).solve(&[ones, ones]);
        assert!(!x.iter().all(|x| x.is_finite()));
    }
}
