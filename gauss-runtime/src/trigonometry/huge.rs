//! The remainder of an angle of any size (Payne & Hanek, *Radian reduction for trigonometric functions*, SIGNUM
//! Newsletter 18, 1983).
//!
//! An angle is m·2^e with a whole number m, so whole turns are dropped from x/2π = m·2^(e − 2)·(2/π) by leaving out the
//! leading digits of 2/π. Of the others 192 are taken, which leave an error below 2⁻¹³⁷ of a quarter turn. No double is
//! nearer than 2⁻⁶² to a multiple of a quarter turn (6381956970095103·2⁷⁹⁷ is nearest: J.-M. Muller, *Elementary
//! Functions*, table 11.1), so 75 digits of the remainder are right. All is done in whole numbers: the same on every
//! platform.

/// Binary digits of 2/π behind the point, after as many zeros as let the least of the angles in question begin within
/// the table.
const TWO_OVER_PI: [u64; 20] = [
    0,
    0xA2F9_836E_4E44_1529,
    0xFC27_57D1_F534_DDC0,
    0xDB62_9599_3C43_9041,
    0xFE51_63AB_DEBB_C561,
    0xB724_6E3A_424D_D2E0,
    0x0649_2EEA_09D1_921C,
    0xFE1D_EB1C_B129_A73E,
    0xE882_35F5_2EBB_4484,
    0xE99C_7026_B45F_7E41,
    0x3991_D639_8353_39F4,
    0x9C84_5F8B_BDF9_283B,
    0x1FF8_97FF_DE05_980F,
    0xEF2F_118B_5A0A_6D1F,
    0x6D36_7ECF_27CB_09B7,
    0x4F46_3F66_9E5F_EA2D,
    0x7527_BAC7_EBE5_F17B,
    0x3D07_39F7_8A52_92EA,
    0x6BFB_5FB1_1F8D_5D08,
    0x5603_3046_FC7B_6BAB,
];

/// Zeros at the head of [`TWO_OVER_PI`].
const ZEROS: i32 = 64;

/// π/2 in units of 2⁻⁶³.
const QUARTER_TURN: u64 = 0xC90F_DAA2_2168_C234;

/// The nearest multiple n of π/2 modulo 4, and x − n π/2 as y − excess, for a finite x of at least 2⁻¹⁰; the relative
/// error of y − excess is below 2⁻⁶¹.
pub(super) fn reduced(x: f64) -> (u64, f64, f64) {
    let bits = x.abs().to_bits();
    let mantissa = bits & ((1 << 52) - 1) | 1 << 52;
    let exponent = (bits >> 52) as i32 - 1075;
    // In units of 2⁻¹⁹² turns, three words.
    let turns = product(mantissa, window((exponent - 2 + ZEROS) as usize));
    // The nearest quarter turn, and what is left, in units of 2⁻¹⁹⁰ quarter turns.
    let quadrant = ((turns[0] >> 61) + 1) >> 1;
    let left = [turns[0].wrapping_sub(quadrant << 62), turns[1], turns[2]];
    let (below, left) = if left[0] >> 63 == 1 { (true, negative(left)) } else { (false, left) };
    // The first 64 digits of what is left, without leading zeros.
    let zeros = leading_zeros(left);
    let digits = shifted(left, zeros)[0];
    let angle = u128::from(digits) * u128::from(QUARTER_TURN);
    // In units of 2^(128 − zeros)·2⁻¹⁹⁰·2⁻⁶³; the first 53 digits, and 64 more.
    let more = angle.leading_zeros();
    let angle = angle << more;
    let unit = power_of_two(-125 - (zeros + more) as i32);
    let high = (angle >> 75) as f64 * power_of_two(75) * unit;
    let low = ((angle >> 11) as u64) as f64 * power_of_two(11) * unit;
    let y = high + low;
    let excess = (y - high) - low;
    let flip = |number: f64, flipped: bool| if flipped { -number } else { number };
    let negative = x < 0.0;
    let quadrant = if negative { quadrant.wrapping_neg() } else { quadrant };
    (quadrant & 3, flip(y, below != negative), flip(excess, below != negative))
}

/// The 192 digits of the table after so many.
fn window(start: usize) -> [u64; 3] {
    let (word, shift) = (start / 64, start % 64);
    core::array::from_fn(|i| {
        let both = u128::from(TWO_OVER_PI[word + i]) << 64 | u128::from(TWO_OVER_PI[word + i + 1]);
        (both >> (64 - shift)) as u64
    })
}

/// A product modulo 2¹⁹², the most significant word first like all numbers here.
fn product(factor: u64, number: [u64; 3]) -> [u64; 3] {
    let mut result = [0; 3];
    let mut carry = 0;
    for i in (0..3).rev() {
        let part = u128::from(factor) * u128::from(number[i]) + carry;
        result[i] = part as u64;
        carry = part >> 64;
    }
    result
}

/// 2¹⁹² − a.
fn negative([first, second, third]: [u64; 3]) -> [u64; 3] {
    let (third, carry) = (!third).overflowing_add(1);
    let (second, carry) = (!second).overflowing_add(u64::from(carry));
    [(!first).wrapping_add(u64::from(carry)), second, third]
}

fn leading_zeros(number: [u64; 3]) -> u32 {
    number.iter().position(|&word| word != 0).map_or(191, |i| 64 * i as u32 + number[i].leading_zeros())
}

/// a·2^by modulo 2¹⁹².
fn shifted(number: [u64; 3], by: u32) -> [u64; 3] {
    let (words, bits) = ((by / 64) as usize, by % 64);
    let word = |i: usize| number.get(i + words).copied().unwrap_or(0);
    core::array::from_fn(|i| ((u128::from(word(i)) << 64 | u128::from(word(i + 1))) << bits >> 64) as u64)
}

/// Power of two as a normal number.
fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((1023 + exponent) as u64) << 52)
}
