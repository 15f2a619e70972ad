//! The motion of a heavy body of revolution about a point of its axis, without units: moments across the axis, weight
//! times lever times two and their ratio are 1.
//!
//! A rotation is `R_z(φ) R_y(θ) R_z(ψ)` in Cayley and Klein's parameters, α = cos θ/2 e^{i(φ+ψ)/2} and β = sin θ/2
//! e^{i(φ−ψ)/2}. With u = cos θ, the momentum ℓ along the axis, λ about the vertical and μ = μ₁ + iμ₂ across,
//!
//! ```text
//! u̇² = u³ + c₂ … = (u − u₁)(u − u₂)(u − u₃),   u₁ ≤ u ≤ u₂ ≤ 1 ≤ u₃,   u = u₁ cn² + u₂ sn²
//! φ̇ + ψ̇ = (κ − 1)ℓ + (λ + ℓ)/(1 + u),   φ̇ − ψ̇ = (1 − κ)ℓ + (λ − ℓ)/(1 − u)
//! ```
//!
//! Each parameter has one integral of the third kind, whose integrand is positive: 1 − u from the lower end of the
//! nutation, 1 + u from the upper. Heights are counted from where the motion starts, and what is small near the
//! vertical comes from products and not from differences, so that motions near it keep their digits.
//!
//! Sources: Klein & Sommerfeld, *Theorie des Kreisels*, VI; Whittaker, *Analytical Dynamics*, 71; Carlson (Numer.
//! Algorithms 10, 1995); the arrangement is ours.

use gauss_runtime::real::Real;

use crate::elliptic::{Jacobi, Modulus, complete, round};

/// re + i im.
type Complex = [f64; 2];

fn product(a: Complex, b: Complex) -> Complex {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

fn conjugate(a: Complex) -> Complex {
    [a[0], -a[1]]
}

fn square(a: Complex) -> f64 {
    a[0] * a[0] + a[1] * a[1]
}

fn scaled(s: f64, a: Complex) -> Complex {
    [s * a[0], s * a[1]]
}

/// e^{ix}.
fn unit(x: f64) -> Complex {
    let (sine, cosine) = Real::sin_cos(x);
    [cosine, sine]
}

/// A top on its way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Top {
    pub(crate) alpha: Complex,
    pub(crate) beta: Complex,
    /// Momentum across the axis, body axes.
    pub(crate) across: Complex,
    /// Momentum along the axis.
    pub(crate) along: f64,
}

/// Smaller numbers are taken for this one: its square is a number.
const LEAST: f64 = 1e-150;

/// The least momentum that an axis through the vertical is given, so that angles about the vertical turn by half a turn
/// there.
const SLIGHT: f64 = 1e-100;

/// A parameter that is not zero, though its square is below any rounding.
const ABOUT: f64 = 1e-70;

/// Zeros of a cubic with the first coefficient 1 and real zeros; `f(0) = c₀ ≥ 0`, so that one is not positive and two
/// not negative.
fn zeros([c0, c1, c2]: [f64; 3]) -> [f64; 3] {
    let middle = -c2 / 3.0;
    let reach = 2.0 * Real::sqrt((middle * middle - c1 / 3.0).max(0.0));
    let value = |x: f64| x.fma(x.fma(x + c2, c1), c0);
    // The zero that stands alone, from outside, where Laguerre's steps fall short of it.
    let lowest_alone = value(middle) > 0.0;
    let slack = 4.0 * f64::EPSILON * (middle.abs() + reach);
    let mut alone = if lowest_alone { middle - reach - slack } else { middle + reach + slack };
    for _ in 0..60 {
        let (f, slope, bend) = (value(alone), alone.fma(3.0 * alone + 2.0 * c2, c1), 6.0 * alone + 2.0 * c2);
        let root = Real::sqrt((2.0 * (2.0 * slope * slope - 3.0 * f * bend)).max(0.0));
        let below = slope + root;
        if f == 0.0 || below == 0.0 {
            break;
        }
        let step = 3.0 * f / below;
        alone -= step;
        if step.abs() <= 1e-6 * alone.abs() {
            break;
        }
    }
    // Sum and product of the others, by the coefficients that do not cancel.
    let direct = -c2 - alone;
    let product = if alone.abs() > 0.1 * direct.abs() { -c0 / alone } else { c1 - alone * direct };
    let sum = if direct.abs() > 0.5 * alone.abs() { direct } else { (c1 - product) / alone };
    let (half, product) = (0.5 * sum, if lowest_alone { product.max(0.0) } else { product.min(0.0) });
    let root = Real::sqrt((half * half - product).max(0.0));
    let far = if half < 0.0 { half - root } else { half + root };
    let near = if far == 0.0 { 0.0 } else { product / far };
    let (less, more) = if far < near { (far, near) } else { (near, far) };
    if lowest_alone { [alone.min(0.0), less.max(0.0), more.max(0.0)] } else { [less.min(0.0), more.max(0.0), alone] }
}

/// The integral of du/(cn² + g sn²) up to an argument with its values, g ≤ k'² ≤ 1, and the argument itself: a sum of
/// positive terms.
fn third_kind(values: &Jacobi, g: f64, complement: f64) -> (f64, f64) {
    let (argument, part) = values.integrals(g, complement);
    (argument, (1.0 - g).fma(part, argument))
}

/// A product and a sum of it with what g is in the other form: from the upper end of the nutation.
fn shifted_kind(values: &Jacobi, g: f64, complement: f64) -> f64 {
    let square = complement * complement;
    let (argument, part) = values.integrals((square * g).max(LEAST * LEAST), complement);
    (square * (1.0 - g)).fma(part, argument)
}

/// Functions of an argument that is counted from the upper end.
fn from_above(Jacobi { sn, cn, dn }: Jacobi, complement: f64, sign: f64) -> Jacobi {
    Jacobi { sn: sign * cn / dn, cn: complement * sn.abs() / dn, dn: complement / dn }
}

/// A nutation: what of it does not depend on time.
struct Nutation {
    /// Lower and upper end of u, measured from its value at the start.
    ends: [f64; 2],
    /// 1 − u₁, 1 − u₂.
    below: [f64; 2],
    /// 1 + u₁, 1 + u₂.
    above: [f64; 2],
    /// λ + ℓ, λ − ℓ; not zero.
    momenta: [f64; 2],
    start: Jacobi,
    complement: f64,
    modulus: Modulus,
    /// Rate of the argument.
    rate: f64,
}

impl Top {
    /// Conj(Γ) μ, Γ = γ₁ + iγ₂ = −2 conj(α) β: λ − ℓu and u̇.
    fn lean(&self) -> Complex {
        product(scaled(-2.0, product(self.alpha, conjugate(self.beta))), self.across)
    }

    fn nutation(&self, [aa, bb]: [f64; 2]) -> Nutation {
        let (across, along) = (square(self.across), self.along);
        let [level, rise] = self.lean();
        let at_least = |x: f64| if x.abs() < SLIGHT { SLIGHT } else { x };
        let momenta = [at_least(level + 2.0 * along * aa), at_least(level - 2.0 * along * bb)];
        let height = aa - bb;
        let c1 = 2.0 * (along * level - height * across) - 4.0 * aa * bb;
        let c2 = 2.0 * height - across - along * along;
        let [x1, x2, x3] = zeros([rise * rise, c1, c2]);
        let (width, spread) = ((x2 - x1).max(0.0), (x3 - x1).max(LEAST));
        // (1 + u₁)(1 + u₂)(1 + u₃) = (λ + ℓ)², (1 − u₁)(1 − u₂)(u₃ − 1) = (λ − ℓ)².
        let highest = 2.0 * aa + x2;
        let lowest = momenta[0] * momenta[0] / (highest * (2.0 * aa + x3));
        let widest = 2.0 * bb - x1;
        let (half, rest) = (0.5 * (x2 + x3) - 2.0 * bb, momenta[1] * momenta[1] / widest);
        let root = Real::sqrt(half.fma(half, rest));
        // u₃ − u₂ is a sum of what both are off the vertical.
        let complement = Real::sqrt((2.0 * root / spread).clamp(0.0, 1.0)).max(LEAST);
        let start = if width > 0.0 {
            let sn = Real::sqrt((-x1 / width).clamp(0.0, 1.0));
            let cn = Real::sqrt((x2 / width).clamp(0.0, 1.0));
            let dn = Real::sqrt((x3 / spread).clamp(0.0, 1.0)).max(LEAST);
            Jacobi { sn: if rise < 0.0 { -sn } else { sn }, cn, dn }
        } else {
            Jacobi { sn: 0.0, cn: 1.0, dn: 1.0 }
        };
        let narrowest = if half < 0.0 { root - half } else { rest / (root + half) };
        Nutation {
            ends: [x1, x2],
            below: [widest, narrowest],
            above: [lowest, highest],
            momenta,
            start,
            complement,
            modulus: Modulus::of_complement(complement),
            rate: 0.5 * Real::sqrt(spread),
        }
    }

    /// After a time t; `ratio` is that of the moments, across to along.
    pub(crate) fn after(&self, t: f64, ratio: f64) -> Self {
        // On the vertical one of the parameters is zero, and without a direction: that in which it is about to move.
        let still = square(self.across) < LEAST;
        let vertical = |of: Complex| square(of) < LEAST;
        if still && (vertical(self.alpha) || vertical(self.beta)) {
            let angle = 0.5 * ratio * self.along * t;
            let (alpha, beta) = (product(self.alpha, unit(angle)), product(self.beta, unit(-angle)));
            return Self { alpha, beta, ..*self };
        }
        let about = scaled(ABOUT / Real::sqrt(square(self.across)), self.across);
        if vertical(self.alpha) {
            let alpha = product([0.0, -1.0], product(conjugate(about), self.beta));
            return Self { alpha, ..*self }.on_its_way(t, ratio);
        }
        if vertical(self.beta) {
            let beta = product([0.0, -1.0], product(about, self.alpha));
            return Self { beta, ..*self }.on_its_way(t, ratio);
        }
        self.on_its_way(t, ratio)
    }

    /// The same off the vertical.
    fn on_its_way(&self, t: f64, ratio: f64) -> Self {
        let norm = 1.0 / (square(self.alpha) + square(self.beta));
        let squares = [square(self.alpha) * norm, square(self.beta) * norm];
        let spin = (ratio - 1.0) * self.along * t;
        let nutation = self.nutation(squares);
        let (integrals, values) = nutation.integrals(t);
        let Nutation { below, above, momenta, ends, rate, .. } = nutation;
        let mixed = |[low, high]: [f64; 2]| low * values.cn * values.cn + high * values.sn * values.sn;
        let (up, down) = (mixed(above), mixed(below));
        let turned = |start: Complex, old: f64, new: f64, angle: f64| {
            scaled(Real::sqrt(0.5 * new / old), product(start, unit(0.5 * angle)))
        };
        let alpha = turned(self.alpha, square(self.alpha), up, momenta[0].fma(integrals[0], spin));
        let beta = turned(self.beta, square(self.beta), down, momenta[1].fma(integrals[1], -spin));
        let level = if up < down { momenta[0] - self.along * up } else { momenta[1] + self.along * down };
        let rise = 2.0 * rate * (ends[1] - ends[0]) * values.sn * values.cn * values.dn;
        let across = product([level, rise], product(conjugate(alpha), beta));
        Self { alpha, beta, across: scaled(-2.0 / (up * down), across), along: self.along }
    }
}

impl Nutation {
    /// ∫ dt/(1 + u) and ∫ dt/(1 − u) over a time t, and the values at its end.
    fn integrals(&self, t: f64) -> ([f64; 2], Jacobi) {
        let Self { below, above, complement, rate, .. } = *self;
        let (g_below, g_above) = (below[1] / below[0], above[0] / above[1]);
        let (phase, lower_before) = third_kind(&self.start, g_below, complement);
        let half_period = 2.0 * self.modulus.quarter_period();
        let reached = rate.fma(t, phase);
        let turns = round(reached / half_period);
        let rest = if turns == 0.0 { reached } else { reached - turns * half_period };
        let values = self.modulus.jacobi(rest);
        let folded = Jacobi { cn: values.cn.abs(), ..values };
        let (_, mut lower) = third_kind(&folded, g_below, complement);
        lower -= lower_before;
        // From the upper end: arguments up to K lie below it, those before the lower end half a period further back.
        let side = |values: &Jacobi| {
            let back = values.sn < 0.0;
            let shifted = from_above(*values, complement, if back { 1.0 } else { -1.0 });
            (shifted_kind(&shifted, g_above, complement), if back { -1.0 } else { 0.0 })
        };
        let ((upper_before, part_before), (upper_after, part_after)) = (side(&self.start), side(&folded));
        let mut upper = upper_after - upper_before;
        let passed = turns + part_after - part_before;
        if turns != 0.0 {
            lower += 2.0 * turns * (self.modulus.quarter_period() + (1.0 - g_below) * complete(g_below, complement));
        }
        if passed != 0.0 {
            let square = complement * complement;
            let part = square * (1.0 - g_above) * complete((square * g_above).max(LEAST * LEAST), complement);
            upper += 2.0 * passed * (self.modulus.quarter_period() + part);
        }
        ([upper / (rate * above[1]), lower / (rate * below[0])], values)
    }
}
