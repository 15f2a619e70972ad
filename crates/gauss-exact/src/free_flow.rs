//! The exact motion of a free rigid body, over any span of time in one call.
//!
//! Momentum: with e and o the principal axes across, and a the axis about which y runs, all of `y = (E cn, O sn, A dn)`
//! or, shifted by a quarter of the period, `y = (E cd, O sd, A′ nd)`. The first form is taken when a has the smallest
//! moment and the second when it has the largest, so that e is the axis with the larger of the other two moments when a
//! is the smallest: every amplitude is a sum of squares then, and the modulus a difference of given numbers.
//!
//! Attitude: R = R_ℓ(ψ) R_y(−β) R_a(−θ), with θ, β the direction of y seen from a and ψ the angle about the constant
//! momentum ℓ in space. ψ̇ = |y| (y_e²/I_e + y_o²/I_o)/(y_e² + y_o²), an average of two rates: the integral of the
//! third kind enters as a sum of positive terms with no pole in sight.
//!
//! A body of two equal moments needs none of that: R exp(t y/I₁) exp(t (1/I₃ − 1/I₁) y₃ e₃) is its attitude, and y
//! turns about e₃.
//!
//! Sources: Celledoni, Fassò, Säfström & Zanna (SIAM J. Sci. Comput. 30, 2008); van Zon & Schofield (J. Comput. Phys.
//! 225, 2007); Carlson (Numer. Algorithms 10, 1995); the arrangement is ours.

use gauss_runtime::__crates_0_1_0::{Triple, add, dot, quaternion, sub, triple, two_sum, unit_quaternion};
use gauss_runtime::integrate::{IntegrationErrorKind, RunPart};
use gauss_runtime::lie::coefficients::sinc_cos;
use gauss_runtime::lie::so3;
use gauss_runtime::real::Real;
use nalgebra::{SVector, Vector3};

use crate::elliptic::{Jacobi, Modulus, complete, round};
use crate::inertia::{FreeMotion, Turn};

/// The exact free motion of a body with given principal moments, in one call of some thousand operations.
///
/// Errors: a few roundings of the angle through which the body turns, and of the phase of its wobble times how much the
/// motion depends on it. Energy and the length of the momentum are kept to a few roundings a call, which are not of one
/// sign.
///
/// For `f64`: the number of operations depends on the state.
///
/// ```
/// use gauss_exact::{FreeFlow, FreeMotion};
/// use gauss_runtime::prelude::*;
///
/// // A wing nut, thrown with a little wobble about its middle axis: where is it after a quarter of an hour?
/// let flow = FreeFlow::new([1.0, 2.0, 3.0]);
/// let y = Vector3::new(1e-3, 2.0, 0.0);
/// let turn = flow.turn(&y, 900.0)?;
/// let later = y + turn.change;
/// // The momentum in space is what it was.
/// assert!((turn.rotation * later - y).norm() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeFlow {
    /// In units of `unit`.
    moments: Triple<f64>,
    inverse: Triple<f64>,
    unit: f64,
    /// Axes from the smallest moment to the largest.
    order: [usize; 3],
    /// I₁(I₃ − I₂) and I₃(I₂ − I₁), sorted: y stays on the side of axis 3 when the first times y₃² exceeds the second
    /// times y₁².
    sides: [f64; 2],
    /// The axis of a body of revolution, with (1/I₃ − 1/I₁)/2.
    revolution: Option<(usize, f64)>,
}

/// A right-handed frame along principal axes.
#[derive(Clone, Copy)]
struct Frame {
    axes: [usize; 3],
    signs: Triple<f64>,
}

/// The constants of a motion: see the module.
#[derive(Clone, Copy)]
struct Orbit {
    /// Axes e, o, a.
    frame: Frame,
    modulus: Modulus,
    complement: f64,
    /// E, O, A or A′.
    amplitudes: Triple<f64>,
    /// Whether the second form is used.
    shifted: bool,
    /// (O/E)².
    ratio: f64,
    /// du/dt.
    rate: f64,
}

impl FreeFlow {
    /// The motion of a body with the given principal moments, which are greater than zero.
    #[must_use]
    pub fn new(moments: [f64; 3]) -> Self {
        let unit = power_of_two(moments.iter().fold(0.0_f64, |m, &i| m.max(i)));
        let moments = moments.map(|i| i / unit);
        let mut order = [0, 1, 2];
        for (i, j) in [(0, 1), (1, 2), (0, 1)] {
            if moments[order[i]] > moments[order[j]] {
                order.swap(i, j);
            }
        }
        let [smallest, middle, largest] = order.map(|axis| moments[axis]);
        let sides = [smallest * (largest - middle), largest * (middle - smallest)];
        let axis = (0..3).find(|&axis| moments[(axis + 1) % 3] == moments[(axis + 2) % 3]);
        let revolution = axis.map(|axis| {
            let (along, across) = (moments[axis], moments[(axis + 1) % 3]);
            (axis, 0.5 * (across - along) / (across * along))
        });
        Self { moments, inverse: moments.map(|i| 1.0 / i), unit, order, sides, revolution }
    }

    /// [`flow`](Self::flow) for a body of revolution about an axis.
    #[inline(always)]
    fn flow_of_revolution(&self, (axis, rate): (usize, f64), y: Triple<f64>, t: f64) -> ([f64; 4], Triple<f64>) {
        let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
        let half = 0.5 * t * self.inverse[a];
        let (sinc, cosine) = sinc_and_cosine(half * half * dot(y, y));
        let sinc = half * sinc;
        let (spin, spun) = Real::sin_cos(y[axis] * (rate * t));
        // exp(t y/I₁), then the spin about the axis.
        let [x, z, along] = [sinc * y[a], sinc * y[b], sinc * y[axis]];
        let mut rotation = [0.0, 0.0, 0.0, cosine * spun - along * spin];
        rotation[a] = spun * x + spin * z;
        rotation[b] = spun * z - spin * x;
        rotation[axis] = spun * along + cosine * spin;
        // y turns back: cos − 1 and sin of the spin, whose rounding would leave the same bits in every call of a steady
        // spin.
        let (less, sine) = (-2.0 * spin * spin, 2.0 * spin * spun);
        let ((square, rest), (other, other_rest)) = (two_product(sine, sine), two_product(less, less));
        let (sum, low) = two_sum(2.0 * less, square);
        // With |less| up to 2 the sum has a rounding, too.
        let (sum, lower) = two_sum(sum, other);
        let stretch = -0.5 * (sum + (low + lower + rest + other_rest));
        let mut change = [0.0; 3];
        let (ya, yb) = (less * y[a] + sine * y[b], less * y[b] - sine * y[a]);
        change[a] = stretch.fma(y[a] + ya, ya);
        change[b] = stretch.fma(y[b] + yb, yb);
        (if rotation[3] < 0.0 { rotation.map(|c| -c) } else { rotation }, change)
    }

    /// The turn and the change of the momentum, in units in which the largest component of y and the largest moment are
    /// between 1 and 2.
    fn flow(&self, y: Triple<f64>, t: f64) -> ([f64; 4], Triple<f64>) {
        let [first, second] = self.sides;
        let [smallest, middle, largest] = self.order;
        let steady = |y: Triple<f64>| (so3_exp(core::array::from_fn(|i| t * y[i] * self.inverse[i])), [0.0; 3]);
        if second == 0.0 && (first == 0.0 || y[largest] == 0.0) {
            return steady(y);
        }
        let upper = second == 0.0 || first * y[largest] * y[largest] > second * y[smallest] * y[smallest];
        let (about, third) = if upper { (largest, smallest) } else { (smallest, largest) };
        let Some(orbit) = self.orbit(y, [about, middle, third], upper) else {
            return steady(y);
        };
        let seen = orbit.frame.see(y);
        let weights = orbit.frame.axes.map(|axis| self.inverse[axis]);
        let length = Real::sqrt(dot(seen, seen));

        let before = orbit.phase_of(seen);
        let (phase, integral_before) = before.integrals(orbit.ratio, orbit.complement);
        let reached = phase + orbit.rate * t;
        let half_period = 2.0 * orbit.modulus.quarter_period();
        let turns = round(reached / half_period);
        let rest = if turns == 0.0 { reached } else { reached - turns * half_period };
        let mut after = orbit.modulus.jacobi(rest);
        let (_, mut integral) = after.integrals(orbit.ratio, orbit.complement);
        integral -= integral_before;
        if turns != 0.0 {
            integral += 2.0 * turns * complete(orbit.ratio, orbit.complement);
            // Half a period changes the signs of sn and cn.
            let sign = if 0.5 * turns == round(0.5 * turns) { 1.0 } else { -1.0 };
            (after.sn, after.cn) = (sign * after.sn, sign * after.cn);
        }

        let psi = length * (weights[0] * t + (weights[1] - weights[0]) * orbit.ratio * (integral / orbit.rate));
        let change = restore(orbit.momentum(after), seen, weights);
        let [x, y, z, w] = relative_rotation(seen, add(seen, change), psi, length);
        let [x, y, z] = orbit.frame.unsee([x, y, z]);
        ([x, y, z, w], orbit.frame.unsee(change))
    }

    /// The constants of the motion through y; `axes` are a, b (the middle one) and c. `None` when y does not move, or
    /// so slowly or so little that squares cannot tell.
    fn orbit(&self, y: Triple<f64>, axes: [usize; 3], upper: bool) -> Option<Orbit> {
        let [ia, ib, ic] = axes.map(|axis| self.moments[axis]);
        let [square_a, square_b, square_c] = axes.map(|axis| y[axis] * y[axis]);
        // The separatrix is y_a² = r y_c²; least and most are the extremes of y_a².
        let r = ia * (ic - ib) / (ic * (ib - ia));
        let edge = Real::sqrt(r * square_c);
        let most = square_a + square_b * (ia * (ic - ib) / (ib * (ic - ia)));
        let least = ((y[axes[0]].abs() - edge).max(0.0) * (y[axes[0]].abs() + edge)).min(most);
        if most == 0.0 {
            return None;
        }
        // Nearer to the separatrix than squares can tell is on it.
        let least = if least < 1e-300 * most { 0.0 } else { least };
        let complement = Real::sqrt(least / most);
        let growth = ib * (ic - ia) / (ic * (ib - ia));
        let shifted = upper && least > 0.0;
        let [about, b, c] = axes;
        let (even, odd) = if shifted { (b, c) } else { (c, b) };
        let (ratio, even_square, about_square) = if shifted {
            (least / most / growth, square_b + growth * square_c, least)
        } else {
            (growth, square_c + square_b / growth, most)
        };
        if even_square == 0.0 || ratio == 0.0 {
            return None;
        }
        let frame = Frame::leaning([even, odd, about], y);
        let even_amplitude = Real::sqrt(even_square);
        let even_amplitude = if y[even] < 0.0 { -even_amplitude } else { even_amplitude };
        // ẏ_o = y_a y_e (1/I_e − 1/I_a): the sign of what follows at phase 0.
        let grows = (self.moments[even] < self.moments[about]) == (even_amplitude > 0.0);
        let odd_amplitude = Real::sqrt(ratio * even_square);
        Some(Orbit {
            frame,
            modulus: Modulus::of_complement(complement),
            complement,
            amplitudes: [even_amplitude, if grows { odd_amplitude } else { -odd_amplitude }, Real::sqrt(about_square)],
            shifted,
            ratio,
            rate: Real::sqrt(most * ((ic - ia) * (ib - ia) / (ib * ic))) / ia,
        })
    }
}

impl FreeMotion<f64> for FreeFlow {
    fn order(&self) -> Option<u32> {
        None
    }

    fn symplectic(&self) -> bool {
        true
    }

    #[inline]
    fn turn(&self, y: &Vector3<f64>, h: f64) -> Result<Turn<f64>, IntegrationErrorKind> {
        let y = triple(y);
        if let Some(revolution) = self.revolution {
            let (square, t) = (dot(y, y), h / self.unit);
            // Squares of the components that matter are within the range of numbers.
            if (1e-280..1e280).contains(&square) {
                let (rotation, change) = self.flow_of_revolution(revolution, y, t);
                // A product of two rotations is of norm 1 up to rounding.
                return finite(rotation, change)
                    .map(|()| Turn { rotation: unit_quaternion(rotation), change: SVector::from(change) });
            }
        }
        // A NaN passes here and is caught below.
        let scale = power_of_two(y.iter().fold(0.0_f64, |m, &c| m.max(c.abs())));
        let scaled = y.map(|c| c / scale);
        let (rotation, change) = self.flow(scaled, h * (scale / self.unit));
        let change = change.map(|c| c * scale);
        finite(rotation, change)?;
        Ok(Turn { rotation: so3::renormalise(&unit_quaternion(rotation)), change: SVector::from(change) })
    }
}

#[inline(always)]
fn finite(rotation: [f64; 4], change: Triple<f64>) -> Result<(), IntegrationErrorKind> {
    let all = rotation.iter().chain(&change).fold(true, |all, c| all & Real::is_finite(*c));
    if all { Ok(()) } else { Err(IntegrationErrorKind::NonFinite { part: RunPart::Step }) }
}

/// (sin θ/θ, cos θ) from s = θ². In long thin tops, which turn slowly about their momentum, a drift waits for these: up
/// to θ = 1 their series are summed in pairs, without a root, to a rounding or two (what is left out is below 1/20!).
#[inline(always)]
fn sinc_and_cosine(s: f64) -> (f64, f64) {
    if s < 1.0 { (summed(SINC, s), summed(COSINE, s)) } else { sinc_cos(s) }
}

/// (−1)ⁿ/(2n + 1)! and (−1)ⁿ/(2n)!.
const SINC: [f64; 10] = alternating(1);
const COSINE: [f64; 10] = alternating(0);

const fn alternating(first: u64) -> [f64; 10] {
    let (mut terms, mut n, mut factorial, mut sign) = ([0.0; 10], 0, 1, 1.0);
    while n < 10 {
        terms[n] = sign / factorial as f64;
        let k = 2 * n as u64 + first;
        // 21! is beyond the integers, and not needed.
        factorial *= if n < 9 { (k + 1) * (k + 2) } else { 1 };
        sign = -sign;
        n += 1;
    }
    terms
}

/// Σ c sⁿ, in a tree: nothing waits for more than five sums.
#[inline(always)]
fn summed(c: [f64; 10], s: f64) -> f64 {
    let square = s * s;
    let fourth = square * square;
    let pair = |n: usize| c[n + 1].fma(s, c[n]);
    let low = square.fma(pair(2), pair(0));
    let high = square.fma(pair(6), pair(4));
    fourth.fma(fourth.fma(pair(8), high), low)
}

impl Frame {
    /// The frame along (even, odd, about) with directions such that it is right-handed and y leans towards its third
    /// axis.
    fn leaning(axes: [usize; 3], y: Triple<f64>) -> Self {
        let side = if y[axes[2]] < 0.0 { -1.0 } else { 1.0 };
        let hand = if (axes[0] + 1) % 3 == axes[1] { side } else { -side };
        Self { axes, signs: [1.0, hand, side] }
    }

    fn see(&self, v: Triple<f64>) -> Triple<f64> {
        core::array::from_fn(|i| self.signs[i] * v[self.axes[i]])
    }

    fn unsee(&self, v: Triple<f64>) -> Triple<f64> {
        let mut seen = [0.0; 3];
        for i in 0..3 {
            seen[self.axes[i]] = self.signs[i] * v[i];
        }
        seen
    }
}

impl Orbit {
    /// sn, cn and dn of a momentum on the orbit, with cn ≥ 0: the sign of E is that of y_e.
    fn phase_of(&self, seen: Triple<f64>) -> Jacobi {
        let [even, odd, about] = self.amplitudes;
        let (dn, factor) = if self.shifted { (about / seen[2], about / seen[2]) } else { (seen[2] / about, 1.0) };
        Jacobi { sn: factor * seen[1] / odd, cn: factor * seen[0] / even, dn }
    }

    fn momentum(&self, Jacobi { sn, cn, dn }: Jacobi) -> Triple<f64> {
        let [even, odd, about] = self.amplitudes;
        if self.shifted { [even * cn / dn, odd * sn / dn, about / dn] } else { [even * cn, odd * sn, about * dn] }
    }
}

/// The change of the momentum, with the rounding of what was reached taken out of energy and length: it would leave the
/// same bits in every call, and repeated calls would drift. Both defects are sums of products with the change, in twice
/// the precision because the rounding of these would also be of one sign for one motion; the energy's relative to the
/// axis that y is nearest to, so that small deviations from a steady motion count with their own size.
fn restore(reached: Triple<f64>, before: Triple<f64>, weights: Triple<f64>) -> Triple<f64> {
    let nearest = (1..3).fold(0, |best, i| if reached[i].abs() > reached[best].abs() { i } else { best });
    let relative = weights.map(|w| w - weights[nearest]);
    let change = sub(reached, before);
    // x₁² − x₀² = (x₁ − x₀)(x₁ + x₀), and what its rounding leaves.
    let (mut squares, mut rests) = ([0.0; 3], [0.0; 3]);
    for i in 0..3 {
        let (after, lost) = two_sum(before[i], change[i]);
        let (sum, low) = two_sum(before[i], after);
        let (product, error) = two_product(change[i], sum);
        (squares[i], rests[i]) = (product, error + change[i] * (low + lost));
    }
    let square = dot(before, before);
    let kept = (0..3).fold(0.0, |sum, i| relative[i].fma(before[i] * before[i], sum));
    // The gradient of the energy along the sphere.
    let slope: Triple<f64> = core::array::from_fn(|i| reached[i] * (relative[i] - kept / square));
    let steepness = dot(slope, slope);
    let step = if steepness > 0.0 { -0.5 * weighted_sum(relative, squares, rests) / steepness } else { 0.0 };
    // From afar the rounding of the energy is more than what is left of it near the saddle: only what is rounding of y
    // is taken.
    let rounding = 16.0 * f64::EPSILON;
    let step = if step * step * steepness <= rounding * rounding * square { step } else { 0.0 };
    let stretch = -0.5 * weighted_sum([1.0; 3], squares, rests) / square;
    core::array::from_fn(|i| step.fma(slope[i], stretch.fma(reached[i], change[i])))
}

/// `Σ w (x + rest)` in twice the precision (Ogita, Rump & Oishi, SIAM J. Sci. Comput. 26, 2005).
fn weighted_sum(weights: Triple<f64>, squares: Triple<f64>, rests: Triple<f64>) -> f64 {
    let (mut sum, mut low) = (0.0, 0.0);
    for i in 0..3 {
        let (product, error) = two_product(weights[i], squares[i]);
        let (next, rest) = two_sum(sum, product);
        (sum, low) = (next, low + (rest + (error + weights[i] * rests[i])));
    }
    sum + low
}

/// a b to nearest, and exactly what is missing there (Dekker; Veltkamp's factors of 26 digits): also where no fused
/// operation is.
fn two_product(a: f64, b: f64) -> (f64, f64) {
    let split = |x: f64| {
        // 2²⁷ + 1.
        let c = 134_217_729.0 * x;
        let high = c - (c - x);
        (high, x - high)
    };
    let (product, (a1, a2), (b1, b2)) = (a * b, split(a), split(b));
    (product, a2 * b2 - (((product - a1 * b1) - a2 * b1) - a1 * b2))
}

/// R_z(θ₀) R_y(β₀) R_z(ψ) R_y(−β₁) R_z(−θ₁), where θ and β are the polar angles of two momenta of the given length with
/// positive third components.
fn relative_rotation(before: Triple<f64>, after: Triple<f64>, psi: f64, length: f64) -> [f64; 4] {
    let across = |y: Triple<f64>| Real::sqrt(y[0] * y[0] + y[1] * y[1]);
    let tilt = |y: Triple<f64>| {
        let sum = length + y[2];
        (Real::sqrt(0.5 * sum / length), across(y) / Real::sqrt(2.0 * length * sum))
    };
    let heading = |y: Triple<f64>| {
        let size = across(y);
        if size > 0.0 { half_angle(y[0] / size, y[1] / size) } else { (1.0, 0.0) }
    };
    let ((c0, s0), (c1, s1)) = (tilt(before), tilt(after));
    let ((e0, f0), (e1, f1)) = (heading(before), heading(after));
    let (sine, cosine) = Real::sin_cos(0.5 * psi);
    // R_y(β₀) R_z(ψ) R_y(−β₁).
    let (w, z) = (cosine * (c0 * c1 + s0 * s1), sine * (c0 * c1 - s0 * s1));
    let (x, y) = (sine * (s0 * c1 + c0 * s1), cosine * (s0 * c1 - c0 * s1));
    // Turns about z act on (w, z) by the difference of the angles, on (x, y) by the sum.
    let (dc, ds) = (e0 * e1 + f0 * f1, f0 * e1 - e0 * f1);
    let (sc, ss) = (e0 * e1 - f0 * f1, f0 * e1 + e0 * f1);
    let q = [sc * x - ss * y, ss * x + sc * y, ds * w + dc * z, dc * w - ds * z];
    // Of the two quaternions that of the smaller turn.
    if q[3] < 0.0 { q.map(|c| -c) } else { q }
}

/// (cos θ/2, sin θ/2) from (cos θ, sin θ).
fn half_angle(cosine: f64, sine: f64) -> (f64, f64) {
    if cosine >= 0.0 {
        let half = Real::sqrt(0.5 * (1.0 + cosine));
        (half, 0.5 * sine / half)
    } else {
        let half = Real::sqrt(0.5 * (1.0 - cosine));
        let half = if sine < 0.0 { -half } else { half };
        (0.5 * sine / half, half)
    }
}

/// The rotation by a rotation vector of any length.
fn so3_exp(sigma: Triple<f64>) -> [f64; 4] {
    quaternion(&so3::exp(&SVector::from(sigma)))
}

/// The largest power of two that does not exceed a number; units of this size round nothing, and leave no component at
/// 1, where floating-point numbers lie twice as densely below as above and roundings are not of random sign.
pub(crate) fn power_of_two(x: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff0_0000_0000_0000;
    f64::from_bits(x.to_bits() & EXPONENT).max(f64::MIN_POSITIVE)
}
