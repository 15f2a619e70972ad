//! Sines and cosines in lanes: the runtime's own (`gauss_runtime`, `trigonometry.rs`), step by step, with its bits.
//!
//! What it reduces in whole numbers, which takes branches, is an exception here: such rows are computed by themselves.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2};

use super::steps::{LaneOperand, Operation, Steps};

/// The bit of the sign.
pub const SIGN: u64 = 1 << 63;

/// Whether the runtime fuses products with sums there: by the processor that it was compiled for, as other code.
const FUSED: bool = cfg!(any(target_feature = "fma", all(target_arch = "aarch64", target_feature = "neon")));

/// The most quarter turns that are reduced here, a power of two.
const MULTIPLES: u64 = 1 << 16;
/// Nearer to a multiple of a quarter turn the runtime reduces in whole numbers, where products are not fused.
const CLOSE: f64 = 1.0e-4;
/// 1.5·2⁵²: added and taken away again it rounds to whole numbers.
const SHIFTER: f64 = 6_755_399_441_055_744.0;
/// π/2 in parts for fused products, and for those that are not.
const PARTS: [u64; 3] = if FUSED {
    [FRAC_PI_2.to_bits(), 0x3C91_A626_3310_0000, 0x3A71_701B_839A_2520]
} else {
    [0x3FF9_21FB_5440_0000, 0x3DD0_B461_1A60_0000, 0x3BA3_198A_2E03_7073]
};
/// (y − sin y)/y³ by powers of y², with the numbers of the runtime, which keeps them to itself: `tests/rows.rs` holds
/// rows to its bits.
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

/// Steps for the sine and the cosine of an angle.
pub fn sine_and_cosine(steps: &mut Steps, x: LaneOperand) -> [LaneOperand; 2] {
    let mut writer = SineWriter { steps };
    let w = &mut writer;
    let (turns, shifter, parts) = (w.number(FRAC_2_PI), w.number(SHIFTER), PARTS.map(|part| w.steps.bits(part)));
    let shifted = w.sum(x, turns, shifter);
    let n = w.two(Operation::Subtract, shifted, shifter);
    let left = if FUSED {
        w.steps.step(Operation::MultiplySubtract, &[n, parts[0], x])
    } else {
        let product = w.two(Operation::Multiply, n, parts[0]);
        w.two(Operation::Subtract, x, product)
    };
    let part = w.two(Operation::Multiply, n, parts[1]);
    let y = w.two(Operation::Subtract, left, part);
    let lost = w.two(Operation::Subtract, y, left);
    let lost = w.two(Operation::Add, lost, part);
    let excess = w.sum(n, parts[2], lost);
    w.exceptions(shifted, y);
    let of_remainder = if FUSED { w.fused(y, excess) } else { w.not_fused(y, excess) };
    w.in_quadrant(shifted, of_remainder)
}

struct SineWriter<'a> {
    steps: &'a mut Steps,
}

impl SineWriter<'_> {
    fn number(&mut self, value: f64) -> LaneOperand {
        self.steps.number(value)
    }

    fn two(&mut self, operation: Operation, a: LaneOperand, b: LaneOperand) -> LaneOperand {
        self.steps.step(operation, &[a, b])
    }

    fn shifted(&mut self, operation: Operation, a: LaneOperand) -> LaneOperand {
        self.steps.step(operation, &[a])
    }

    /// a·b + c as the runtime rounds it.
    fn sum(&mut self, a: LaneOperand, b: LaneOperand, c: LaneOperand) -> LaneOperand {
        if FUSED {
            return self.steps.step(Operation::MultiplyAdd, &[a, b, c]);
        }
        let product = self.two(Operation::Multiply, a, b);
        self.two(Operation::Add, product, c)
    }

    /// Notes the lanes whose angles the runtime reduces in whole numbers.
    fn exceptions(&mut self, shifted: LaneOperand, y: LaneOperand) {
        // Bits above those of multiples that are allowed; all others are zero.
        let least = self.steps.bits(SHIFTER.to_bits() - MULTIPLES);
        let above = self.two(Operation::SubtractBits, shifted, least);
        let large = self.shifted(Operation::ShiftRight((2 * MULTIPLES).trailing_zeros() as u8), above);
        self.note(large);
        if !FUSED {
            // Numbers that are not negative are in the order of their bits: the sign of a difference tells which is
            // less. That of a number or of its opposite is set where it is not zero.
            let (rest, close) = (self.steps.bits(!SIGN), self.number(CLOSE));
            let magnitude = self.two(Operation::And, y, rest);
            let is_close = self.two(Operation::SubtractBits, magnitude, close);
            let (shifter, zero) = (self.number(SHIFTER), self.steps.bits(0));
            let multiple = self.two(Operation::SubtractBits, shifted, shifter);
            let opposite = self.two(Operation::SubtractBits, zero, multiple);
            let is_reduced = self.two(Operation::Or, multiple, opposite);
            let both = self.two(Operation::And, is_close, is_reduced);
            let near = self.shifted(Operation::ShiftRight(63), both);
            self.note(near);
        }
    }

    fn note(&mut self, exceptions: LaneOperand) {
        let all = match self.steps.exceptions {
            Some(others) => self.two(Operation::Or, others, exceptions),
            None => exceptions,
        };
        self.steps.exceptions = Some(all);
    }

    /// A polynomial in z, pairs of terms side by side.
    fn series(&mut self, terms: [f64; 6], z: LaneOperand) -> LaneOperand {
        let [a, b, c, d, e, f] = terms.map(|term| self.number(term));
        let z2 = self.two(Operation::Multiply, z, z);
        let (last, middle) = (self.sum(f, z, e), self.sum(d, z, c));
        let rest = self.sum(last, z2, middle);
        let first = self.sum(b, z, a);
        self.sum(rest, z2, first)
    }

    fn fused(&mut self, y: LaneOperand, excess: LaneOperand) -> [LaneOperand; 2] {
        let z = self.two(Operation::Multiply, y, y);
        let cube = self.two(Operation::Multiply, z, y);
        let one = self.number(1.0);
        let minus_one = self.number(-1.0);
        [(SINE, 0.0, minus_one, y), (COSINE, -0.5, y, one)].map(|(terms, part, factor, start)| {
            let series = self.series(terms, z);
            let part = self.number(part);
            let part = self.sum(part, y, excess);
            let rest = self.sum(series, cube, part);
            self.sum(rest, factor, start)
        })
    }

    fn not_fused(&mut self, y: LaneOperand, excess: LaneOperand) -> [LaneOperand; 2] {
        let (one, half) = (self.number(1.0), self.number(0.5));
        let z = self.two(Operation::Multiply, y, y);
        let half = self.two(Operation::Multiply, half, z);
        let most = self.two(Operation::Subtract, one, half);
        let cube = self.two(Operation::Multiply, y, z);
        let series = self.series(SINE, z);
        let (product, part) =
            (self.two(Operation::Multiply, cube, series), self.two(Operation::Multiply, half, excess));
        let part = self.two(Operation::Subtract, excess, part);
        let rest = self.two(Operation::Add, product, part);
        let sine = self.two(Operation::Subtract, y, rest);
        let (series, square) = (self.series(COSINE, z), self.two(Operation::Multiply, z, z));
        let (product, part) = (self.two(Operation::Multiply, series, square), self.two(Operation::Multiply, y, excess));
        let rest = self.two(Operation::Add, product, part);
        let lost = self.two(Operation::Subtract, one, most);
        let lost = self.two(Operation::Subtract, lost, half);
        let rest = self.two(Operation::Add, lost, rest);
        [sine, self.two(Operation::Add, most, rest)]
    }

    /// The last two bits of `shifted` are the quadrant: in odd ones sine and cosine change places, and signs follow.
    fn in_quadrant(&mut self, shifted: LaneOperand, [sine, cosine]: [LaneOperand; 2]) -> [LaneOperand; 2] {
        let (zero, last, sign) = (self.steps.bits(0), self.steps.bits(1), self.steps.bits(SIGN));
        let is_odd = self.two(Operation::And, shifted, last);
        let is_odd = self.two(Operation::SubtractBits, zero, is_odd);
        let both = self.two(Operation::Xor, sine, cosine);
        let exchanged = self.two(Operation::And, both, is_odd);
        let second = self.shifted(Operation::ShiftLeft(62), shifted);
        let first = self.shifted(Operation::ShiftLeft(63), shifted);
        let next = self.two(Operation::Xor, second, first);
        [(sine, second), (cosine, next)].map(|(value, of_quadrant)| {
            let value = self.two(Operation::Xor, value, exchanged);
            let flipped = self.two(Operation::And, of_quadrant, sign);
            self.two(Operation::Xor, value, flipped)
        })
    }
}
