//! Sine and cosine as someone writes them who wants speed alone: inlined, without branches and without a test of the
//! range. Reduction in two parts by fused multiply-adds, minimax polynomials, selection by quadrant; errors up to 1.5
//! ulp, and none of this holds for angles beyond some thousand turns. C compilers and rustc pack two calls beside each
//! other.

use gauss_runtime::prelude::Real;

/// 1.5·2⁵², which rounds what is added to it.
const SHIFTER: f64 = 6_755_399_441_055_744.0;

const SINE: [f64; 6] = [
    -1.666_666_666_666_663_2e-1,
    8.333_333_333_322_49e-3,
    -1.984_126_982_985_795e-4,
    2.755_731_370_707_006_8e-6,
    -2.505_076_025_340_686_3e-8,
    1.589_690_995_211_55e-10,
];

const COSINE: [f64; 6] = [
    4.166_666_666_666_66e-2,
    -1.388_888_888_887_411e-3,
    2.480_158_728_947_673e-5,
    -2.755_731_435_139_066_3e-7,
    2.087_572_321_298_175e-9,
    -1.135_964_755_778_819_5e-11,
];

/// Sine and cosine of a moderate angle.
#[inline(always)]
pub fn sin_cos(x: f64) -> (f64, f64) {
    let shifted = Real::fma(x, std::f64::consts::FRAC_2_PI, SHIFTER);
    let n = shifted - SHIFTER;
    let y = if cfg!(target_feature = "fma") {
        Real::fma(-n, 6.123_233_995_736_766e-17, Real::fma(-n, std::f64::consts::FRAC_PI_2, x))
    } else {
        // Parts of 33 binary digits, whose products with n are exact, and the rest.
        let parts = [0x3FF9_21FB_5440_0000, 0x3DD0_B461_1A60_0000, 0x3BA3_198A_2E03_7073].map(f64::from_bits);
        ((x - n * parts[0]) - n * parts[1]) - n * parts[2]
    };
    let (z, quadrant) = (y * y, shifted.to_bits());
    let z2 = z * z;
    let series = |[a, b, c, d, e, f]: [f64; 6]| {
        Real::fma(Real::fma(Real::fma(f, z, e), z2, Real::fma(d, z, c)), z2, Real::fma(b, z, a))
    };
    let (sine, cosine) = (Real::fma(y * z, series(SINE), y), Real::fma(Real::fma(series(COSINE), z, -0.5), z, 1.0));
    let (sine, cosine) = if quadrant & 1 == 0 { (sine, cosine) } else { (cosine, sine) };
    let flipped = |value: f64, signs: u64| f64::from_bits(value.to_bits() ^ (signs & (1 << 63)));
    (flipped(sine, quadrant << 62), flipped(cosine, quadrant.wrapping_add(1) << 62))
}
