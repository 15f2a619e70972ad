//! Power series of motions in time: what the clause `taylor` of the derive generates, and the arrays that it works on.
//!
//! The equations of motion are products, quotients, roots and functions of series; coefficient by coefficient each is a sum over
//! products of earlier coefficients (Knuth, TAOCP 2, 4.7; Moore 1966; Jorba & Zou 2005). All of these sums of one order are
//! formed together, a *lane* each, which is what vector instructions are made for; what remains of an order is a straight line.

use nalgebra::SVector;

use crate::configuration::VectorSpace;
use crate::real::Real;
use crate::system::GaussSystem;

/// The highest order of a series.
pub const MAX_ORDER: usize = 30;

/// A system whose motion can be written as a power series in time: `#[gauss(taylor)]`.
///
/// The variables are the components of the configuration (unit quaternion x, y, z, w before the translation of a pose,
/// cosine before sine before the translation in the plane, scalar coordinates after the elements of groups) and then z.
pub trait TaylorSystem: GaussSystem<Input = ()> {
    /// The coefficients of all variables.
    type Series: PowerSeries<Self::Scalar>;

    /// How many variables are measured together, group by group in the order of the variables: a unit quaternion, a translation,
    /// a scalar, a speed.
    const GROUPS: &'static [usize];

    /// The series of the solution through (t, q, z) up to the given order, at most [`MAX_ORDER`] and at least 1:
    /// `x(t + τ) = Σ coefficient(k) τᵏ`. With constraints it is that of the equations with multipliers, which satisfies them if
    /// the state does.
    fn expand(
        &self,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
        order: usize,
        series: &mut Self::Series,
    );

    /// The configuration, as its components say, not brought back to norm 1, and z.
    fn state_of(
        &self,
        variables: &<Self::Series as PowerSeries<Self::Scalar>>::Variables,
    ) -> (Self::Configuration, Self::Speeds);
}

/// Coefficients of several power series.
pub trait PowerSeries<T: Real> {
    /// A value of each variable.
    type Variables: VectorSpace<T>;

    /// All coefficients zero.
    fn zero() -> Self;

    /// The coefficients of order k.
    ///
    /// # Panics
    /// When `k > MAX_ORDER`.
    fn coefficient(&self, k: usize) -> &Self::Variables;

    /// `Σ_{k ≤ order} coefficient(k) τᵏ`, summed from the highest order down.
    ///
    /// # Panics
    /// When `order > MAX_ORDER`.
    #[inline]
    fn at(&self, order: usize, tau: T) -> Self::Variables {
        let mut sum = *self.coefficient(order);
        for k in (0..order).rev() {
            sum = self.coefficient(k).add_scaled(tau, &sum);
        }
        sum
    }
}

/// The values of L products, of one order.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Row<T, const L: usize>([T; L]);

/// The series of V variables, and of both factors of L products of what is computed from them.
#[derive(Clone, Debug)]
pub struct Series<T, const V: usize, const L: usize> {
    variables: [SVector<T, V>; MAX_ORDER + 1],
    left: [Row<T, L>; MAX_ORDER + 1],
    right: [Row<T, L>; MAX_ORDER + 1],
}

/// Products whose sums are formed side by side: as many as fit in vector registers together with the factors.
const BLOCK: usize = 16;

impl<T: Real, const V: usize, const L: usize> Series<T, V, L> {
    /// The coefficients of order k.
    #[inline(always)]
    pub fn variables(&self, k: usize) -> [T; V] {
        self.variables[k].data.0[0]
    }

    /// Sets the coefficients of order k.
    #[inline(always)]
    pub fn set_variables(&mut self, k: usize, values: [T; V]) {
        self.variables[k] = SVector::from(values);
    }

    /// Sets the factors of order k of all products.
    #[inline(always)]
    pub fn set_factors(&mut self, k: usize, left: [T; L], right: [T; L]) {
        self.left[k] = Row(left);
        self.right[k] = Row(right);
    }

    /// `Σ_{0 < j < k} leftⱼ rightₖ₋ⱼ` of every product: all but the first and the last term of the coefficient of order k.
    // Inlined, its packs would be taken apart to suit what their elements are added to.
    #[inline(never)]
    pub fn convolution(&self, k: usize) -> [T; L] {
        let mut sums = [T::zero(); L];
        let mut from = 0;
        while from + BLOCK <= L {
            sums[from..from + BLOCK].copy_from_slice(&self.block::<BLOCK>(k, from));
            from += BLOCK;
        }
        while from + PACK <= L {
            sums[from..from + PACK].copy_from_slice(&self.block::<PACK>(k, from));
            from += PACK;
        }
        sums
    }

    /// N of these sums. The factors of order k − 1 have been stored only just, so their terms come last; two sums go side by
    /// side, since each addition waits for the one before.
    #[inline(always)]
    fn block<const N: usize>(&self, k: usize, from: usize) -> [T; N] {
        // A macro, because arrays that go through a function do not always stay in registers.
        macro_rules! add {
            ($sum:ident, $left:expr, $right:expr) => {
                for i in 0..N {
                    $sum[i] = $left.0[from + i].fma($right.0[from + i], $sum[i]);
                }
            };
        }
        let (mut even, mut odd) = ([T::zero(); N], [T::zero(); N]);
        if k > 3 {
            let (left, right) = (&self.left[2..k - 1], &self.right[2..k - 1]);
            let (pairs, facing) = (left.chunks_exact(2), right.rchunks_exact(2));
            let single = pairs.remainder().first().zip(facing.remainder().first());
            for (a, b) in pairs.zip(facing) {
                add!(even, a[0], b[1]);
                add!(odd, a[1], b[0]);
            }
            if let Some((a, b)) = single {
                add!(even, a, b);
            }
        }
        if k > 1 {
            add!(odd, self.left[1], self.right[k - 1]);
        }
        if k > 2 {
            add!(even, self.left[k - 1], self.right[1]);
        }
        for i in 0..N {
            even[i] = even[i] + odd[i];
        }
        even
    }
}

/// What the number of products is rounded up to a multiple of.
const PACK: usize = 4;

impl<T: Real, const V: usize, const L: usize> PowerSeries<T> for Series<T, V, L> {
    type Variables = SVector<T, V>;

    fn zero() -> Self {
        let row = Row([T::zero(); L]);
        Self {
            variables: [VectorSpace::zero(); MAX_ORDER + 1],
            left: [row; MAX_ORDER + 1],
            right: [row; MAX_ORDER + 1],
        }
    }

    #[inline(always)]
    fn coefficient(&self, k: usize) -> &Self::Variables {
        &self.variables[k]
    }
}
