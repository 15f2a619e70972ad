//! Sines and cosines of one angle or several together, inlined and without branches: kernels with angles spend most of their time in
//! the library's otherwise, and what is without branches the compiler packs into vectors.
//!
//! The angle is reduced by the nearest multiple of π/2, which is subtracted in parts (Cody & Waite, *Software Manual for the Elementary
//! Functions*, 1980), with what the last subtraction rounds off carried along. The polynomials on [−π/4, π/4] are those of fdlibm (Sun
//! Microsystems 1993; `k_sin.c`, `k_cos.c`), whose errors are below 2⁻⁵⁸. Results are within 0.9 ulp. What is left goes to the library,
//! by one test for all angles: those beyond [`LIMIT`], what is not finite, and, where products and sums are not fused, those within
//! [`CLOSE`] of a multiple of π/2.
//!
//! An angle gets the same bits alone and among others.

/// Whether a·b + c is one instruction.
pub(crate) const FUSED: bool =
    cfg!(all(feature = "std", any(target_feature = "fma", all(target_arch = "aarch64", target_feature = "neon"))));

/// Multiples below 2¹⁷·π/2 are exact beside parts of 33 binary digits, and what the reduction leaves out is far below an ulp.
const LIMIT: f64 = 1.0e5;

/// Half of the digits of an angle as large as [`LIMIT`] are left here.
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

/// a·b + c.
pub(crate) trait MultiplyAdd: Fn(f64, f64, f64) -> f64 + Copy {}

impl<F: Fn(f64, f64, f64) -> f64 + Copy> MultiplyAdd for F {}

/// An angle less the nearest multiple of π/2.
struct Reduced {
    y: f64,
    /// By how much y is too large.
    excess: f64,
    /// The multiple is in the last digits.
    shifted: f64,
    /// Whether this is so.
    holds: bool,
}

#[inline(always)]
fn reduce<const FUSED: bool>(x: f64, fma: impl MultiplyAdd) -> Reduced {
    let shifted = fma(x, core::f64::consts::FRAC_2_PI, SHIFTER);
    let n = shifted - SHIFTER;
    // False for a NaN.
    let small = x.abs() <= LIMIT;
    if FUSED {
        // Exact: a multiple of 2⁻⁵³ below 1. So is y − first: either the two are within a factor of two of each other, or both are so
        // small that y has no more than 53 digits down to the last one of the product.
        let first = fma(-n, PARTS[0], x);
        let y = fma(-n, PARTS[1], first);
        let excess = fma(n, PARTS[2], fma(n, PARTS[1], y - first));
        Reduced { y, excess, shifted, holds: small }
    } else {
        // Both sides of the first difference are within a factor of two of each other.
        let first = x - n * SHORT_PARTS[0];
        let part = n * SHORT_PARTS[1];
        let y = first - part;
        let excess = ((y - first) + part) + n * SHORT_PARTS[2];
        // Where there is nothing to subtract nothing cancels.
        Reduced { y, excess, shifted, holds: small & ((y.abs() >= CLOSE) | (n == 0.0)) }
    }
}

/// `(sin x, cos x)`, and whether they are.
#[inline(always)]
fn of_small_angle<const FUSED: bool>(x: f64, fma: impl MultiplyAdd) -> (f64, f64, bool) {
    let Reduced { y, excess, shifted, holds } = reduce::<FUSED>(x, fma);
    let z = y * y;
    let z2 = z * z;
    // Pairs of terms side by side: what follows waits for them.
    let series = |[a, b, c, d, e, f]: [f64; 6]| fma(fma(fma(f, z, e), z2, fma(d, z, c)), z2, fma(b, z, a));
    let (s, c) = (series(SINE), series(COSINE));
    // y comes last: −0 keeps its sign.
    let (sine, cosine) = if FUSED {
        // sin(y − e) = y − (e + y³s), with at most 0.15 ulp left out; (y − e)² as it is rounded once.
        let square = fma(y, y, -((y + y) * excess));
        (y - fma(y * z, s, excess), fma(fma(c, z, -0.5), square, 1.0))
    } else {
        let half = 0.5 * z;
        let most = 1.0 - half;
        let sine = y - ((y * z) * s + (excess - half * excess));
        (sine, most + (((1.0 - most) - half) + (c * z2 + y * excess)))
    };
    let quadrant = shifted.to_bits();
    let (sine, cosine) = if quadrant & 1 == 0 { (sine, cosine) } else { (cosine, sine) };
    let flipped = |value: f64, signs: u64| f64::from_bits(value.to_bits() ^ (signs & (1 << 63)));
    (flipped(sine, quadrant << 62), flipped(cosine, quadrant.wrapping_add(1) << 62), holds)
}

/// `(sin x, cos x)`, with the given `a·b + c`.
#[inline(always)]
pub(crate) fn sin_cos(x: f64, fma: impl MultiplyAdd) -> (f64, f64) {
    let (sine, cosine, holds) = of_small_angle::<FUSED>(x, fma);
    if holds { (sine, cosine) } else { library(x) }
}

/// Functions of as many angles as fill vectors. One name for each number, not a loop: compilers pack the former (LLVM 21), and of loops
/// that they unroll parts.
macro_rules! together {
    ($($name:ident of $count:literal: $($lane:literal $sine:ident $cosine:ident $holds:ident),+;)+) => {$(
        #[inline(always)]
        fn $name(x: [f64; $count], fma: impl MultiplyAdd) -> ([f64; $count], [f64; $count]) {
            $(let ($sine, $cosine, $holds) = of_small_angle::<FUSED>(x[$lane], fma);)+
            if $($holds)&+ { ([$($sine),+], [$($cosine),+]) } else { apart(x, fma) }
        }
    )+};
}

together! {
    two of 2: 0 s0 c0 h0, 1 s1 c1 h1;
    four of 4: 0 s0 c0 h0, 1 s1 c1 h1, 2 s2 c2 h2, 3 s3 c3 h3;
    eight of 8: 0 s0 c0 h0, 1 s1 c1 h1, 2 s2 c2 h2, 3 s3 c3 h3, 4 s4 c4 h4, 5 s5 c5 h5, 6 s6 c6 h6, 7 s7 c7 h7;
}

/// Each by itself, because some go to the library.
#[cold]
#[inline(never)]
fn apart<const N: usize>(x: [f64; N], fma: impl MultiplyAdd) -> ([f64; N], [f64; N]) {
    let pairs = x.map(|x| sin_cos(x, fma));
    (pairs.map(|pair| pair.0), pairs.map(|pair| pair.1))
}

/// Sines and cosines of several angles; of 2, 4 or 8 at once, of others in such groups.
#[inline(always)]
pub(crate) fn sines_and_cosines<const N: usize>(x: [f64; N], fma: impl MultiplyAdd) -> ([f64; N], [f64; N]) {
    let (mut sines, mut cosines) = ([0.0; N], [0.0; N]);
    let mut done = 0;
    macro_rules! next {
        ($count:literal $function:ident) => {
            if let Some(angles) = x.get(done..).and_then(|left| left.first_chunk::<$count>()) {
                let (s, c) = $function(*angles, fma);
                sines[done..done + $count].copy_from_slice(&s);
                cosines[done..done + $count].copy_from_slice(&c);
                done += $count;
            }
        };
    }
    for _ in 0..N / 8 {
        next!(8 eight);
    }
    next!(4 four);
    next!(2 two);
    if done < N {
        (sines[done], cosines[done]) = sin_cos(x[done], fma);
    }
    (sines, cosines)
}

#[cold]
#[inline(never)]
fn library(x: f64) -> (f64, f64) {
    #[cfg(feature = "std")]
    return x.sin_cos();
    #[cfg(not(feature = "std"))]
    return libm::sincos(x);
}

#[cfg(test)]
#[path = "trigonometry_tests.rs"]
mod tests;
