//! Sines and cosines of one angle or several together, inlined and without branches: kernels with angles spend most of
//! their time in the library's otherwise, and what is without branches can be done for several angles in one vector.
//!
//! The angle is reduced by the nearest multiple of π/2, which is subtracted in parts (Cody & Waite, *Software Manual
//! for the Elementary Functions*, 1980), with what the last subtraction rounds off carried along. The polynomials on
//! [−π/4, π/4] are those of fdlibm (Sun Microsystems 1993; `k_sin.c`, `k_cos.c`), whose errors are below 2⁻⁵⁸. Results
//! are within 0.96 ulp: of that 0.5 is the last sum; of a cosine 0.2 is each of the two before it, of a sine 0.15 what
//! [`fused`] leaves out; found in 3·10⁸ angles: 0.91 and 0.93. Others are found by one test for all angles and reduced
//! in whole numbers ([`huge`]): those beyond [`MULTIPLES`] quarter turns, and, where products and sums are not fused,
//! those within [`CLOSE`] of a multiple of π/2. So no angle is left to the library of a platform, some of which are 8
//! ulp off at 5.3e255.
//!
//! Those of single precision are rounded from these: each of the 4,278,190,080 finite numbers was tried, and none is
//! further than half an ulp from the library's result in double precision (to 1e-8 ulp).
//!
//! An angle gets the same bits alone and among others.

mod huge;

use core::ops::{Add, Mul, Neg, Sub};

/// Whether a·b + c is one instruction.
pub(crate) const FUSED: bool =
    cfg!(all(feature = "std", any(target_feature = "fma", all(target_arch = "aarch64", target_feature = "neon"))));

/// As many quarter turns are allowed: products of such multiples with parts of 33 and 34 binary digits are exact, and
/// what the reduction leaves out is far below an ulp.
const MULTIPLES: u64 = 1 << 16;

/// Half of the digits of an angle of [`MULTIPLES`] quarter turns are left here.
const CLOSE: f64 = 1.0e-4;

/// 1.5·2⁵²: added and taken away again it rounds to whole numbers; in between they are the last digits.
const SHIFTER: f64 = 6_755_399_441_055_744.0;

/// π/2 in parts of 53, 34 and 53 binary digits.
const PARTS: [f64; 3] =
    [core::f64::consts::FRAC_PI_2, f64::from_bits(0x3C91_A626_3310_0000), f64::from_bits(0x3A71_701B_839A_2520)];

/// π/2 in two parts of 33 binary digits, and the rest: products of the former with the multiple are not rounded.
const SHORT_PARTS: [f64; 3] = [
    f64::from_bits(0x3FF9_21FB_5440_0000),
    f64::from_bits(0x3DD0_B461_1A60_0000),
    f64::from_bits(0x3BA3_198A_2E03_7073),
];

/// (y − sin y)/y³ by powers of y².
const SINE: [f64; 6] = [
    1.666_666_666_666_663_2e-1,
    -8.333_333_333_322_49e-3,
    1.984_126_982_985_795e-4,
    -2.755_731_370_707_006_8e-6,
    2.505_076_025_340_686_3e-8,
    -1.589_690_995_211_55e-10,
];

/// (cos y − 1 + y²/2)/y⁴.
const COSINE: [f64; 6] = [
    4.166_666_666_666_66e-2,
    -1.388_888_888_887_411e-3,
    2.480_158_728_947_673e-5,
    -2.755_731_435_139_066_3e-7,
    2.087_572_321_298_175e-9,
    -1.135_964_755_778_819_5e-11,
];

/// a·b + c of plain numbers.
pub(crate) trait MultiplyAdd: Fn(f64, f64, f64) -> f64 + Copy {}

impl<F: Fn(f64, f64, f64) -> f64 + Copy> MultiplyAdd for F {}

/// One number, or the numbers of a vector.
trait Pack: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self> {
    fn splat(value: f64) -> Self;

    /// a·b + c, rounded as plain numbers are.
    fn multiply_add(self, b: Self, c: Self, fma: impl MultiplyAdd) -> Self;

    /// [`within_limit`] of the numbers of a pack.
    fn within_limit(self) -> bool;

    /// Whether each remainder is not too close to zero, or nothing was subtracted.
    fn is_far_from(self, multiple: Self) -> bool;

    /// Sine and cosine of an angle from those of its remainder; the last digits of `shifted` have the quadrant.
    fn in_quadrant(shifted: Self, sine: Self, cosine: Self) -> (Self, Self);
}

const SIGN: u64 = 1 << 63;

/// Whether all multiples in the last digits are below [`MULTIPLES`]; not so of an angle that is not finite. In whole
/// numbers, whose units have nothing else to do.
#[inline(always)]
fn within_limit<const N: usize>(shifted: [f64; N]) -> bool {
    let above = |shifted: f64| shifted.to_bits().wrapping_sub(SHIFTER.to_bits() - MULTIPLES);
    shifted.into_iter().fold(0, |digits, shifted| digits | above(shifted)) < 2 * MULTIPLES
}

impl Pack for f64 {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn multiply_add(self, b: Self, c: Self, fma: impl MultiplyAdd) -> Self {
        fma(self, b, c)
    }

    #[inline(always)]
    fn within_limit(self) -> bool {
        within_limit([self])
    }

    #[inline(always)]
    fn is_far_from(self, multiple: Self) -> bool {
        (self.abs() >= CLOSE) | (multiple == 0.0)
    }

    #[inline(always)]
    fn in_quadrant(shifted: Self, sine: Self, cosine: Self) -> (Self, Self) {
        let quadrant = shifted.to_bits();
        let (sine, cosine) = if quadrant & 1 == 0 { (sine, cosine) } else { (cosine, sine) };
        let flipped = |value: f64, signs: u64| f64::from_bits(value.to_bits() ^ (signs & SIGN));
        (flipped(sine, quadrant << 62), flipped(cosine, quadrant.wrapping_add(1) << 62))
    }
}

/// The same numbers in every place. Not by `map`, which compilers leave as a call, and then keep every vector in
/// memory.
#[inline(always)]
fn constants<P: Pack>([a, b, c, d, e, f]: [f64; 6]) -> [P; 6] {
    [P::splat(a), P::splat(b), P::splat(c), P::splat(d), P::splat(e), P::splat(f)]
}

/// Remainder of an angle by the nearest multiple of π/2.
struct QuadrantRemainder<P> {
    /// Its last digits give the quadrant.
    shifted: P,
    /// x − n π/2 = y − excess.
    y: P,
    excess: P,
}

#[inline(always)]
fn reduced<const FUSED: bool, P: Pack>(x: P, fma: impl MultiplyAdd) -> QuadrantRemainder<P> {
    let (number, fma) = (P::splat, |a: P, b: P, c: P| a.multiply_add(b, c, fma));
    let shifted = fma(x, number(core::f64::consts::FRAC_2_PI), number(SHIFTER));
    let n = shifted - number(SHIFTER);
    let (y, excess) = if FUSED {
        let [first, second, third] = [number(PARTS[0]), number(PARTS[1]), number(PARTS[2])];
        // Exact: a multiple of 2⁻⁵³ below 1; so is the product, of 34 and 17 digits. So is y − left: either the two are
        // within a factor of two of each other, or both are so small that y has no more than 53 digits down to the last
        // one of the product.
        let (left, part) = (fma(-n, first, x), n * second);
        let y = left - part;
        (y, fma(n, third, (y - left) + part))
    } else {
        let [first, second, third] = [number(SHORT_PARTS[0]), number(SHORT_PARTS[1]), number(SHORT_PARTS[2])];
        // Both sides of the first difference are within a factor of two of each other.
        let (left, part) = (x - n * first, n * second);
        let y = left - part;
        (y, ((y - left) + part) + n * third)
    };
    QuadrantRemainder { shifted, y, excess }
}

/// A polynomial in z.
#[inline(always)]
fn series<P: Pack>(terms: [P; 6], z: P, fma: impl MultiplyAdd) -> P {
    let fma = |a: P, b: P, c: P| a.multiply_add(b, c, fma);
    let ([a, b, c, d, e, f], z2) = (terms, z * z);
    // Pairs of terms side by side: what follows waits for them.
    fma(fma(fma(f, z, e), z2, fma(d, z, c)), z2, fma(b, z, a))
}

/// Coefficients that make a sine of [`fused`], or a cosine.
struct SeriesCoefficients<P> {
    /// Coefficients of the series.
    terms: [P; 6],
    /// The part of y beside it.
    part: P,
    factor: P,
    start: P,
}

/// Sine or cosine by fused products: sin(y − e) = y − (s y³ + e), cos(y − e) = 1 + (c y³ + (e − y/2)) y, with at most
/// 0.15 and 0.04 ulp of e left out. One form for both, so that both can be places of one vector.
#[inline(always)]
fn fused<P: Pack>(y: P, excess: P, wanted: SeriesCoefficients<P>, fma: impl MultiplyAdd) -> P {
    let z = y * y;
    let series = series(wanted.terms, z, fma);
    let fma = |a: P, b: P, c: P| a.multiply_add(b, c, fma);
    fma(fma(series, z * y, fma(wanted.part, y, excess)), wanted.factor, wanted.start)
}

/// `(sin x, cos x)`, and whether they are for all numbers of the pack.
#[inline(always)]
fn of_small_angle<const FUSED: bool, P: Pack>(x: P, fma: impl MultiplyAdd) -> (P, P, bool) {
    let left = reduced::<FUSED, P>(x, fma);
    let multiple = left.shifted - P::splat(SHIFTER);
    let holds = left.shifted.within_limit() & (FUSED || left.y.is_far_from(multiple));
    let (sine, cosine) = of_reduced::<FUSED, P>(left, fma);
    (sine, cosine, holds)
}

/// `(sin x, cos x)` of the remainder of an angle.
#[inline(always)]
fn of_reduced<const FUSED: bool, P: Pack>(left: QuadrantRemainder<P>, fma: impl MultiplyAdd) -> (P, P) {
    let (QuadrantRemainder { shifted, y, excess }, number, one) = (left, P::splat, P::splat(1.0));
    let (sine_terms, cosine_terms) = (constants(SINE), constants(COSINE));
    let (sine, cosine) = if FUSED {
        // y comes last: −0 keeps its sign.
        let sine = SeriesCoefficients { terms: sine_terms, part: number(0.0), factor: number(-1.0), start: y };
        let cosine = SeriesCoefficients { terms: cosine_terms, part: number(-0.5), factor: y, start: one };
        (fused(y, excess, sine, fma), fused(y, excess, cosine, fma))
    } else {
        let z = y * y;
        let half = number(0.5) * z;
        let most = one - half;
        let sine = y - ((y * z) * series(sine_terms, z, fma) + (excess - half * excess));
        let rest = series(cosine_terms, z, fma) * (z * z) + y * excess;
        (sine, most + (((one - most) - half) + rest))
    };
    P::in_quadrant(shifted, sine, cosine)
}

/// `(sin x, cos x)`, with the given `a·b + c`.
#[inline(always)]
pub(crate) fn sin_cos(x: f64, fma: impl MultiplyAdd) -> (f64, f64) {
    #[cfg(feature = "wide")]
    if FUSED {
        let ([sine], [cosine], holds) = vectors::halves_of_two([x]);
        return if holds { (sine, cosine) } else { of_any_angle(x) };
    }
    let (sine, cosine, holds) = of_small_angle::<FUSED, f64>(x, fma);
    if holds { (sine, cosine) } else { of_any_angle(x) }
}

/// Sines and cosines of several angles.
#[cfg(not(feature = "wide"))]
#[inline(always)]
pub(crate) fn sines_and_cosines<const N: usize>(x: [f64; N], fma: impl MultiplyAdd) -> ([f64; N], [f64; N]) {
    one_by_one(x, fma)
}

#[cfg(feature = "wide")]
pub(crate) use vectors::sines_and_cosines;

/// Each by itself, because some are reduced in whole numbers.
#[cfg_attr(feature = "wide", cold)]
#[cfg_attr(feature = "wide", inline(never))]
fn one_by_one<const N: usize>(x: [f64; N], fma: impl MultiplyAdd) -> ([f64; N], [f64; N]) {
    let pairs = x.map(|x| sin_cos(x, fma));
    (pairs.map(|pair| pair.0), pairs.map(|pair| pair.1))
}

/// The vectors of the crate `wide`. Of loops over arrays compilers pack only parts (LLVM 21), and more or less of them
/// from kernel to kernel.
#[cfg(feature = "wide")]
mod vectors {
    use ::wide::{f64x2, f64x4, f64x8, u64x2, u64x4, u64x8};

    use super::{
        CLOSE, COSINE, FUSED, MultiplyAdd, Pack, QuadrantRemainder, SIGN, SINE, SeriesCoefficients, fused,
        of_small_angle, one_by_one, reduced, sin_cos, within_limit,
    };

    macro_rules! packs {
        ($($vector:ident $bits:ident)+) => {$(
            impl Pack for $vector {
                #[inline(always)]
                fn splat(value: f64) -> Self {
                    Self::splat(value)
                }

                #[inline(always)]
                fn multiply_add(self, b: Self, c: Self, _: impl MultiplyAdd) -> Self {
                    if FUSED { self.mul_add(b, c) } else { self * b + c }
                }

                #[inline(always)]
                fn within_limit(self) -> bool {
                    within_limit(self.to_array())
                }

                #[inline(always)]
                fn is_far_from(self, multiple: Self) -> bool {
                    (self.abs().simd_ge(Self::splat(CLOSE)) | multiple.simd_eq(Self::splat(0.0))).all()
                }

                #[inline(always)]
                fn in_quadrant(shifted: Self, sine: Self, cosine: Self) -> (Self, Self) {
                    let bits = |x: Self| $bits::new(x.to_array().map(f64::to_bits));
                    let numbers = |x: $bits| Self::new(x.to_array().map(f64::from_bits));
                    let (quadrant, sine, cosine) = (bits(shifted), bits(sine), bits(cosine));
                    let odd = $bits::splat(0) - (quadrant & $bits::splat(1));
                    let exchanged = (sine ^ cosine) & odd;
                    // That of the cosine is the next quadrant's.
                    let sign = quadrant.unbounded_shl_scalar(62);
                    let next = sign ^ (sign + sign);
                    let sign_bit = $bits::splat(SIGN);
                    (numbers(sine ^ exchanged ^ (sign & sign_bit)), numbers(cosine ^ exchanged ^ (next & sign_bit)))
                }
            }
        )+};
    }

    packs! { f64x2 u64x2 f64x4 u64x4 f64x8 u64x8 }

    /// Sines and cosines of as many angles as fill half a vector: what is done for the sine is done for the cosine in
    /// the other half.
    macro_rules! halves {
        ($($name:ident: $half:literal of $vector:ident, $pack:expr, $array:expr;)+) => {$(
            #[inline(always)]
            pub(super) fn $name(x: [f64; $half]) -> ([f64; $half], [f64; $half], bool) {
                let numbers = |sine: f64, cosine: f64| {
                    $vector::new(core::array::from_fn(|i| if i < $half { sine } else { cosine }))
                };
                let select = |sine: $vector, cosine: $vector| {
                    let (sine, cosine) = (sine.to_array(), cosine.to_array());
                    $vector::new(core::array::from_fn(|i| if i < $half { sine[i] } else { cosine[i] }))
                };
                let part = |x: $vector, first: usize| -> [f64; $half] {
                    let x = x.to_array();
                    core::array::from_fn(|i| x[first + i])
                };
                // Vectors have their own.
                let fma = |a: f64, b: f64, c: f64| a * b + c;
                let x = $vector::new(core::array::from_fn(|i| if i < $half { x[i] } else { x[i - $half] }));

                let QuadrantRemainder { shifted, y, excess } = reduced::<true, $vector>(x, fma);
                let holds = within_limit(part(shifted, 0));
                let one = $vector::splat(1.0);
                let wanted = SeriesCoefficients {
                    terms: core::array::from_fn(|i| numbers(SINE[i], COSINE[i])),
                    part: numbers(0.0, -0.5),
                    factor: select($vector::splat(-1.0), y),
                    start: select(y, one),
                };
                let found = fused(y, excess, wanted, fma);
                let (sine, cosine) = Pack::in_quadrant(
                    $pack(part(shifted, 0)),
                    $pack(part(found, 0)),
                    $pack(part(found, $half)),
                );
                ($array(sine), $array(cosine), holds)
            }
        )+};
    }

    halves! {
        halves_of_two: 1 of f64x2, |[x]: [f64; 1]| x, |x: f64| [x];
        halves_of_four: 2 of f64x4, f64x2::new, f64x2::to_array;
        halves_of_eight: 4 of f64x8, f64x4::new, f64x4::to_array;
    }

    /// Largest number of places of a vector that may repeat the last angle. Where two vectors stand for one, they would
    /// cost more than the rest alone.
    const REPEATED: usize = if cfg!(target_feature = "avx") { 1 } else { 0 };

    /// The same of eight: five angles are less work in one vector than in two with both halves.
    const REPEATED_OF_EIGHT: usize = if cfg!(target_feature = "avx512f") { 3 } else { REPEATED };

    /// Sines and cosines of several angles: eight at once, then four, two and one.
    #[inline(always)]
    pub(crate) fn sines_and_cosines<const N: usize>(x: [f64; N], fma: impl MultiplyAdd) -> ([f64; N], [f64; N]) {
        let (mut sines, mut cosines) = ([0.0; N], [0.0; N]);
        let mut done = 0;
        macro_rules! next {
            ($count:literal $vector:ident) => {
                next!(
                    $count | angles | {
                        let (s, c, hold) = of_small_angle::<FUSED, $vector>($vector::new(angles), fma);
                        (s.to_array(), c.to_array(), hold)
                    }
                )
            };
            ($count:literal |$angles:ident| $both:expr) => {
                let $angles: [f64; $count] = core::array::from_fn(|i| x[(done + i).min(N - 1)]);
                let (s, c, hold) = $both;
                let (s, c) = if hold {
                    (s, c)
                } else if $count == 2 {
                    // A copy of the two: what a call is given lies in memory, and they would be read from there in one
                    // piece right after they were written in two.
                    one_by_one(core::array::from_fn(|i| x[(done + i).min(N - 1)]), fma)
                } else {
                    one_by_one($angles, fma)
                };
                for i in 0..usize::min($count, N - done) {
                    (sines[done + i], cosines[done + i]) = (s[i], c[i]);
                }
                done += usize::min($count, N - done);
            };
        }
        for _ in 0..(N + REPEATED_OF_EIGHT) / 8 {
            next!(8 f64x8);
        }
        if N - done + REPEATED >= 4 {
            if FUSED && cfg!(target_feature = "avx512f") {
                next!(4 | angles | halves_of_eight(angles));
            } else {
                next!(4 f64x4);
            }
        }
        if N - done >= 2 {
            if FUSED && cfg!(target_feature = "avx") {
                next!(2 | angles | halves_of_four(angles));
            } else {
                next!(2 f64x2);
            }
        }
        if done < N {
            (sines[done], cosines[done]) = sin_cos(x[done], fma);
        }
        (sines, cosines)
    }
}

/// `(sin x, cos x)` of an angle that is large or near a multiple of π/2; NaN for an angle that is not finite.
#[cold]
#[inline(never)]
fn of_any_angle(x: f64) -> (f64, f64) {
    if !x.is_finite() {
        return (f64::NAN, f64::NAN);
    }
    let (quadrant, y, excess) = huge::reduced(x);
    let shifted = f64::from_bits(SHIFTER.to_bits() + quadrant);
    of_reduced::<false, f64>(QuadrantRemainder { shifted, y, excess }, |a, b, c| a * b + c)
}

#[cfg(test)]
#[path = "trigonometry_tests.rs"]
mod tests;
