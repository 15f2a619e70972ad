//! The discrete Moser–Veselov method for free bodies, made accurate to order 10 by modified moments of inertia.
//!
//! A step turns the body by the Cayley transform of c, the quaternion (c, 1) normalised, where
//! `c_i = (1 + |c|²)(h/2) y_i/Ĩ_i + (Ĩ_j − Ĩ_k)/Ĩ_i c_j c_k` ((i, j, k) cyclic), and changes the momentum y
//! accordingly: `y_i += (4/h)(Ĩ_j − Ĩ_k) c_j c_k/(1 + |c|²)` (Moser & Veselov 1991; McLachlan & Zanna 2005). With Ĩ = I
//! the method has order 2; its orbits are those of the body at a wrong rate. `1/Ĩ_i = s/I_i + d` with s and d functions
//! of the energy and of |y| puts the rate right (Hairer & Vilmart, J. Phys. A 39, 2006).

use gauss_runtime::__crates_0_1_0::{add, cross, dot, scaled, triple, unit_quaternion};
use gauss_runtime::integrate::{IntegrationErrorKind, RunPart};
use gauss_runtime::lie::so3;
use gauss_runtime::real::Real;
use nalgebra::{SVector, Vector3};

use crate::corrections::Corrections;
use crate::inertia::{FreeMotion, Turn};

/// Newton's iteration converges in three or four steps where a step of the method makes sense.
const MOST_ITERATIONS: u32 = 20;

/// The discrete Moser–Veselov method with corrections, of order 2, 4, 6, 8 or 10.
///
/// Symmetric; energy, |y| and the momentum in space are kept up to rounding. Without corrections the map is symplectic;
/// with them y moves by a Poisson map, but how the attitude follows is a gradient of the same function only as far as
/// the corrections go. No elementary functions.
///
/// Steps that turn the body by much more than 1 rad, or a body whose moments differ much by correspondingly less, end
/// with [`IntegrationErrorKind::NotConverged`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MoserVeselov<T> {
    /// Moments in units of the largest.
    inverse: [T; 3],
    /// 1/I_k − 1/I_j, (i, j, k) cyclic.
    differences: [T; 3],
    unit: T,
    corrections: Corrections<T>,
    order: u32,
}

impl<T: Real> MoserVeselov<T> {
    /// The method of order 10 for a body with the given principal moments, which are greater than zero.
    #[must_use]
    pub fn new(moments: [T; 3]) -> Self {
        Self::of_order(moments, 10)
    }

    /// The method of an even order from 2 to 10.
    ///
    /// # Panics
    /// When there is none of this order.
    #[must_use]
    pub fn of_order(moments: [T; 3], order: u32) -> Self {
        assert!((2..=10).contains(&order) && order.is_multiple_of(2), "the orders are 2, 4, 6, 8 and 10");
        let unit = T::select_lt(moments[0], moments[1], moments[1], moments[0]);
        let unit = T::select_lt(unit, moments[2], moments[2], unit);
        let moments = moments.map(|i| i / unit);
        let differences = core::array::from_fn(|i| {
            let (j, k) = (moments[(i + 1) % 3], moments[(i + 2) % 3]);
            (j - k) / (j * k)
        });
        let corrections = Corrections::new(moments, (order / 2 - 1) as usize);
        Self { inverse: moments.map(T::recip), differences, unit, corrections, order }
    }
}

impl<T: Real> FreeMotion<T> for MoserVeselov<T> {
    fn order(&self) -> Option<u32> {
        Some(self.order)
    }

    fn symplectic(&self) -> bool {
        self.order == 2
    }

    #[inline]
    fn turn(&self, y: &Vector3<T>, h: T) -> Result<Turn<T>, IntegrationErrorKind> {
        let (one, half) = (T::one(), T::ratio(1, 2));
        if h == T::zero() {
            return Ok(Turn { rotation: unit_quaternion([h, h, h, one]), change: SVector::from([h; 3]) });
        }
        // Angles: h times a velocity.
        let y = scaled(h / self.unit, triple(y));
        let inverse = self.inverse;
        let omega = core::array::from_fn(|i| inverse[i] * y[i]);
        let (more, shift) = self.corrections.at(half * dot(y, y), half * dot(y, omega));
        let stretch = one + more;
        // 1/Ĩ_i and (Ĩ_j − Ĩ_k)/Ĩ_i; that the differences are of 1/I keeps those of nearly equal moments.
        let weights: [T; 3] = core::array::from_fn(|i| stretch.fma(inverse[i], shift));
        let gaps: [T; 3] =
            core::array::from_fn(|i| stretch * self.differences[i] / (weights[(i + 1) % 3] * weights[(i + 2) % 3]));
        let couplings: [T; 3] = core::array::from_fn(|i| gaps[i] * weights[i]);
        let drive: [T; 3] = core::array::from_fn(|i| half * y[i] * weights[i]);
        for lane in 0..T::LANES {
            // Far beyond their range corrections grow without bound. A NaN passes here and is caught below.
            let far = more.lane(lane).abs() > 0.5;
            if far || weights.iter().any(|w| w.lane(lane) <= 0.0) {
                return Err(IntegrationErrorKind::NotConverged { iterations: 0, residual: more.lane(lane).abs() });
            }
        }
        let c = solve(drive, couplings)?;
        let products = [c[1] * c[2], c[2] * c[0], c[0] * c[1]];
        let factor = (T::ratio(4, 1) / (one + dot(c, c))) * (self.unit / h);
        let change: [T; 3] = core::array::from_fn(|i| factor * gaps[i] * products[i]);
        let scale = (one + dot(c, c)).sqrt().recip();
        let rotation = [c[0] * scale, c[1] * scale, c[2] * scale, scale];
        if !rotation.iter().chain(&change).all(|v| v.is_finite()) {
            return Err(IntegrationErrorKind::NonFinite { part: RunPart::Step });
        }
        Ok(Turn { rotation: so3::renormalise(&unit_quaternion(rotation)), change: SVector::from(change) })
    }
}

/// The root c near k of `c = (1 + |c|²) k + m·(c₂c₃, c₃c₁, c₁c₂)`, by Newton's method.
#[inline]
fn solve<T: Real>(k: [T; 3], m: [T; 3]) -> Result<[T; 3], IntegrationErrorKind> {
    let one = T::one();
    // Quadratic: once steps are below this, the next one is below rounding.
    let enough = 0.05 * Real::sqrt(T::EPSILON);
    let mut c = k;
    let mut last = f64::INFINITY;
    for _ in 0..MOST_ITERATIONS {
        let spread = one + dot(c, c);
        let residual: [T; 3] = core::array::from_fn(|i| {
            let (j, l) = ((i + 1) % 3, (i + 2) % 3);
            spread.fma(k[i], (m[i] * c[j]).fma(c[l], -c[i]))
        });
        // Rows of 1 − 2 k cᵀ − m·∂(c₂c₃, c₃c₁, c₁c₂).
        let row = |i: usize| {
            let (j, l) = ((i + 1) % 3, (i + 2) % 3);
            let twice = k[i] + k[i];
            let mut row = [T::zero(); 3];
            row[i] = one - twice * c[i];
            row[j] = -(twice * c[j] + m[i] * c[l]);
            row[l] = -(twice * c[l] + m[i] * c[j]);
            row
        };
        let rows = [row(0), row(1), row(2)];
        let minors = [cross(rows[1], rows[2]), cross(rows[2], rows[0]), cross(rows[0], rows[1])];
        let determinant = dot(rows[0], minors[0]).recip();
        let step = scaled(
            determinant,
            add(scaled(residual[0], minors[0]), add(scaled(residual[1], minors[1]), scaled(residual[2], minors[2]))),
        );
        c = add(c, step);
        last = relative_size(step, c);
        if last <= enough {
            return Ok(c);
        }
        if !last.is_finite() {
            break;
        }
    }
    if k.iter().chain(&m).all(|v| v.is_finite()) {
        Err(IntegrationErrorKind::NotConverged { iterations: MOST_ITERATIONS, residual: last })
    } else {
        Err(IntegrationErrorKind::NonFinite { part: RunPart::Step })
    }
}

/// The largest component of a step against the largest of what it leads to, the worst lane; 0 at rest.
fn relative_size<T: Real>(step: [T; 3], reached: [T; 3]) -> f64 {
    let mut worst = 0.0_f64;
    for lane in 0..T::LANES {
        // `max` drops a NaN, the sum keeps it.
        let largest = |v: [T; 3]| v.iter().fold(0.0_f64, |m, c| m.max(c.lane(lane).abs()));
        let total: f64 = step.iter().map(|c| c.lane(lane)).sum();
        let (step, reached) = (largest(step), largest(reached));
        if !total.is_finite() {
            return f64::NAN;
        }
        if step > 0.0 {
            worst = worst.max(step / reached);
        }
    }
    worst
}
