//! Power series of motions in time: the traits of the clause `taylor`, and the arrays that its code works on.
//!
//! The equations of motion are products, quotients, roots and functions of series; coefficient by coefficient each is a
//! sum over products of earlier coefficients (Knuth, TAOCP 2, 4.7; Moore 1966; Jorba & Zou 2005). All of these sums of
//! one order are formed together, a *lane* each, which is what vector instructions are made for; what remains of an
//! order is a straight line.

use nalgebra::SVector;

use crate::configuration::{Configuration, VectorSpace};
use crate::real::Real;
use crate::sealed::Sealed;
use crate::system::GaussSystem;

/// The highest order of a series.
pub const MAX_ORDER: usize = 30;

/// A system whose motion can be written as a power series in time: `#[gauss(taylor)]`.
///
/// The variables are the components of the configuration ([`Configuration::Components`]) and then z.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no power series, because its struct does not ask for them",
    label = "the clause `taylor` brings them",
    note = "add `taylor` to the `#[gauss(…)]` of the struct"
)]
pub trait TaylorSystem: GaussSystem<Input = ()> {
    /// The coefficients of all variables.
    type Series: PowerSeries<Self::Scalar>;

    /// Numbers of variables that are measured together, group by group in the order of the variables: a unit
    /// quaternion, a translation, a scalar, a speed.
    const GROUPS: &'static [usize];

    /// The series of the solution through (t, q, z) up to the given order, at most [`MAX_ORDER`] and at least 1:
    /// `x(t + τ) = Σ coefficient(k) τᵏ`. With constraints it is that of the equations with multipliers, which satisfies
    /// them if the state does.
    fn expand(
        &self,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
        order: usize,
        series: &mut Self::Series,
    );
}

/// The configuration, as its components say and not brought back onto the group, and z of a value of each variable.
#[must_use]
pub fn state_of<S: TaylorSystem>(
    variables: &<S::Series as PowerSeries<S::Scalar>>::Variables,
) -> (S::Configuration, S::Speeds) {
    let mut components = ComponentsOf::<S>::zero();
    for i in 0..ComponentsOf::<S>::DIM {
        components.set_component(i, variables.component(i));
    }
    let mut speeds = S::Speeds::zero();
    for i in 0..S::DOF {
        speeds.set_component(i, variables.component(ComponentsOf::<S>::DIM + i));
    }
    (S::Configuration::from_components(&components), speeds)
}

type ComponentsOf<S> = <<S as GaussSystem>::Configuration as Configuration>::Components;

/// Coefficients of several power series.
pub trait PowerSeries<T: Real>: Sealed {
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

/// The power series of V variables, and of the D factors of L products that are computed from these variables.
///
/// Of numbers both factors of each product are kept, row by row, so that products lie side by side in vectors. Packs
/// are vectors themselves: of them each factor is kept once, in all its orders one after the other, which is a fraction
/// of the memory.
#[derive(Clone, Debug)]
pub struct Series<T, const V: usize, const D: usize, const L: usize> {
    variables: [SVector<T, V>; MAX_ORDER + 1],
    factors: [[T; MAX_ORDER + 1]; D],
    left: [Row<T, L>; MAX_ORDER + 1],
    right: [Row<T, L>; MAX_ORDER + 1],
    /// Terms of the sums of the next order that are known already.
    ahead: Row<T, L>,
}

/// Products whose sums are formed side by side: as many as fit in vector registers together with the factors.
const BLOCK: usize = if cfg!(target_feature = "avx") { 16 } else { 8 };

/// The number of products is a multiple of this.
const PACK: usize = 4;

/// `sums[i] += row[from + i]·factors[i]`: a macro, because arrays that go through functions do not always stay in
/// registers.
macro_rules! add_products {
    ($n:expr, $sums:ident, $row:expr, $from:expr, $factors:ident) => {
        for i in 0..$n {
            $sums[i] = $row.0[$from + i].fma($factors[i], $sums[i]);
        }
    };
}

impl<T: Real, const V: usize, const D: usize, const L: usize> Series<T, V, D, L> {
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

    /// Sets the factors of order k: each once, and those of all products.
    #[inline(always)]
    pub fn set_factors(&mut self, k: usize, factors: [T; D], left: [T; L], right: [T; L]) {
        if T::LANES > 1 {
            for i in 0..D {
                self.factors[i][k] = factors[i];
            }
        } else {
            self.left[k] = Row(left);
            self.right[k] = Row(right);
        }
    }

    /// `Σ_{0 < j < k} leftⱼ rightₖ₋ⱼ` of every product: all but the first and the last term of the coefficient of order
    /// k. Call it for k = 1, 2, … in this order. `pairs` has the numbers of the two factors of each product.
    // Inlined, its packs would be taken apart to suit what their elements are added to.
    #[inline(never)]
    pub fn convolution(&mut self, k: usize, pairs: &[[usize; 2]; L]) -> [T; L] {
        let mut sums = [T::zero(); L];
        if T::LANES > 1 {
            assert!(k <= MAX_ORDER, "an order beyond the highest");
            let (parts, _) = pairs.as_chunks::<PACK>();
            let places = sums.as_chunks_mut::<PACK>().0.iter_mut().zip(self.ahead.0.as_chunks_mut::<PACK>().0);
            for (part, (sums, ahead)) in parts.iter().zip(places) {
                let factor = |i: usize| part.map(|pair| &self.factors[pair[i]]);
                if k % 2 == 1 {
                    (*sums, *ahead) = odd_of_packs(k, factor(0), factor(1));
                } else {
                    *sums = even_of_packs(k, *ahead, factor(0), factor(1));
                }
            }
            return sums;
        }
        let mut from = 0;
        macro_rules! blocks {
            ($width:expr) => {
                while from + $width <= L {
                    let block =
                        if k % 2 == 1 { self.odd::<{ $width }>(k, from) } else { self.even::<{ $width }>(k, from) };
                    sums[from..from + $width].copy_from_slice(&block);
                    from += $width;
                }
            };
        }
        blocks!(BLOCK);
        blocks!(8);
        blocks!(PACK);
        sums
    }

    /// N of the sums of an odd order k, and of those of order k + 1 what can be known: twice as much is done with what
    /// is loaded. The factors of order k − 1 have been stored only just, so they are read last.
    #[inline(always)]
    fn odd<const N: usize>(&mut self, k: usize, from: usize) -> [T; N] {
        let (left, right) = (&self.left, &self.right);
        let (mut sums, mut ahead) = ([T::zero(); N], [T::zero(); N]);
        if k > 1 {
            let mut above = part::<T, L, N>(&right[k - 2], from);
            if k > 3 {
                for (a, b) in left[3..k - 1].iter().zip(right[2..k - 2].iter().rev()) {
                    let below = part::<T, L, N>(b, from);
                    add_products!(N, sums, a, from, below);
                    add_products!(N, ahead, a, from, above);
                    above = below;
                }
                let second = part::<T, L, N>(&right[k - 2], from);
                add_products!(N, sums, left[2], from, second);
            }
            let fresh = part::<T, L, N>(&right[k - 1], from);
            add_products!(N, sums, left[1], from, fresh);
            add_products!(N, ahead, left[2], from, fresh);
            let first = part::<T, L, N>(&right[1], from);
            add_products!(N, sums, left[k - 1], from, first);
            if k > 3 {
                let second = part::<T, L, N>(&right[2], from);
                add_products!(N, ahead, left[k - 1], from, second);
            }
        }
        self.ahead.0[from..from + N].copy_from_slice(&ahead);
        sums
    }

    /// N of the sums of an even order, of which but the outermost terms are known.
    #[inline(always)]
    fn even<const N: usize>(&self, k: usize, from: usize) -> [T; N] {
        let (left, right) = (&self.left, &self.right);
        let mut sums = part::<T, L, N>(&self.ahead, from);
        let fresh = part::<T, L, N>(&right[k - 1], from);
        add_products!(N, sums, left[1], from, fresh);
        if k > 2 {
            let first = part::<T, L, N>(&right[1], from);
            add_products!(N, sums, left[k - 1], from, first);
        }
        sums
    }
}

/// All orders of one factor.
type Orders<T> = [T; MAX_ORDER + 1];

/// [`Series::odd`] of factors that are kept by themselves, and with its bits: the sums, and what is known of the next
/// ones.
#[inline(always)]
fn odd_of_packs<T: Real>(k: usize, left: [&Orders<T>; PACK], right: [&Orders<T>; PACK]) -> ([T; PACK], [T; PACK]) {
    let (mut sums, mut ahead) = ([T::zero(); PACK], [T::zero(); PACK]);
    macro_rules! add {
        ($to:ident, $a:expr, $b:expr) => {
            for i in 0..PACK {
                $to[i] = left[i][$a].fma(right[i][$b], $to[i]);
            }
        };
    }
    if k > 1 {
        // What is read for the one is kept for the other.
        let mut above = [T::zero(); PACK];
        for i in 0..PACK {
            above[i] = right[i][k - 2];
        }
        for j in 3..k - 1 {
            for i in 0..PACK {
                let (a, below) = (left[i][j], right[i][k - j]);
                sums[i] = a.fma(below, sums[i]);
                ahead[i] = a.fma(above[i], ahead[i]);
                above[i] = below;
            }
        }
        if k > 3 {
            add!(sums, 2, k - 2);
        }
        add!(sums, 1, k - 1);
        add!(ahead, 2, k - 1);
        add!(sums, k - 1, 1);
        if k > 3 {
            add!(ahead, k - 1, 2);
        }
    }
    (sums, ahead)
}

/// [`Series::even`] likewise.
#[inline(always)]
fn even_of_packs<T: Real>(
    k: usize,
    ahead: [T; PACK],
    left: [&Orders<T>; PACK],
    right: [&Orders<T>; PACK],
) -> [T; PACK] {
    let mut sums = ahead;
    for i in 0..PACK {
        sums[i] = left[i][1].fma(right[i][k - 1], sums[i]);
        if k > 2 {
            sums[i] = left[i][k - 1].fma(right[i][1], sums[i]);
        }
    }
    sums
}

/// N elements of a row.
#[inline(always)]
fn part<T: Real, const L: usize, const N: usize>(row: &Row<T, L>, from: usize) -> [T; N] {
    let mut part = [T::zero(); N];
    part.copy_from_slice(&row.0[from..from + N]);
    part
}

impl<T, const V: usize, const D: usize, const L: usize> Sealed for Series<T, V, D, L> {}

impl<T: Real, const V: usize, const D: usize, const L: usize> PowerSeries<T> for Series<T, V, D, L> {
    type Variables = SVector<T, V>;

    fn zero() -> Self {
        let row = Row([T::zero(); L]);
        Self {
            variables: [VectorSpace::zero(); MAX_ORDER + 1],
            factors: [[T::zero(); MAX_ORDER + 1]; D],
            left: [row; MAX_ORDER + 1],
            right: [row; MAX_ORDER + 1],
            ahead: row,
        }
    }

    #[inline(always)]
    fn coefficient(&self, k: usize) -> &Self::Variables {
        &self.variables[k]
    }
}
