//! The simplest walker: a hip, two legs without mass, feet without mass. And its gaits, by Newton's method with
//! derivatives through the heel strike.

use std::error::Error;

use gauss_adapters::DualNumber;
use gauss_runtime::nalgebra::{Complex, Matrix2};
use gauss_runtime::prelude::*;
use num_dual::{Derivative, DualSVec64};

// ANCHOR: walker
/// Points for the hip and both feet. The foot that stands is the origin; x is along the slope, downhill; legs are given
/// by their angles from its normal.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, stance, swing),
    particle(mass = 1, position = [x, 0, y]),
    particle(mass = foot, position = [x + sin(stance), 0, y - cos(stance)]),
    particle(mass = foot, position = [x + sin(swing), 0, y - cos(swing)]),
    // The hip is at the end of the leg that stands: at its length, in its direction.
    constraint(position = x * x + y * y - 1),
    constraint(position = x * cos(stance) + y * sin(stance)),
)]
pub struct Walker<T> {
    pub foot: T,
    #[gauss(gravity)]
    pub g: Vector3<T>,
}

/// Steps down a slope from just after a heel strike: the angle of the leg that stands, its rate.
///
/// At a heel strike legs change their names, and the run brings the state onto the constraints of the new foot with
/// velocities as an impact makes them. In the middle of a step the foot passes through the ground, as published.
///
/// # Errors
/// Where the walker falls.
pub fn walk<T: Real>(
    foot: T,
    slope: T,
    [angle, rate]: [T; 2],
    seen: impl FnMut(&Sample<WalkerKernel<T>>),
    steps: usize,
) -> Result<[T; 2], Box<dyn Error>> {
    let (sine, cosine) = slope.sin_cos();
    let kernel = Walker { foot, g: Vector3::new(sine, T::zero(), -cosine) }.kernel()?;
    let walk = Simulation::new(&kernel).adaptive(1e-12, 1e-12).observe(seen);
    let mut strikes = walk
        .until(Crossing::Falling, |_, q: &SVector<T, 4>, _| {
            // Feet are at one height where legs lie alike about the normal; the hip has passed over the foot by then.
            T::select_lt(q[0], T::zero(), -T::one(), q[2] + q[3])
        })
        .then(|s| {
            let ([u, v, stance, swing], (sine, cosine)) = (s.z.into(), s.q[3].sin_cos());
            (s.q, s.z) = ([-sine, cosine, s.q[3], s.q[2]].into(), [u, v, swing, stance].into());
        })
        .boxed();
    let (sine, cosine) = angle.sin_cos();
    let both = (angle + angle).cos();
    let mut q = SVector::from([-sine, cosine, angle, -angle]);
    let mut z = SVector::from([-cosine * rate, -sine * rate, rate, both * rate]);
    let mut t = T::zero();
    for _ in 0..steps {
        let end = strikes.run_to_end(q, z, t..t + T::from_f64(LONGEST))?;
        if end.stopped_by.is_none() {
            return Err("it falls".into());
        }
        (t, q, z) = (end.sample.t, end.sample.q, end.sample.z);
    }
    Ok([q[2], z[2]])
}
// ANCHOR_END: walker

/// Steps take less, in units of √(l/g).
const LONGEST: f64 = 10.0;

/// The mass of a foot over that of the hip, of which the walker is the limit at 0: its numbers differ by some of it,
/// which is no digit of theirs. Nothing cancels on the way: hip and legs have coordinates of their own, and the
/// constraints separate what moves the hip from what turns the leg.
pub const FOOT: f64 = 1e-18;

/// Guesses for the two gaits on a slope of 0.009.
pub const LONG: [f64; 2] = [0.2, -0.2];
/// The other one.
pub const SHORT: [f64; 2] = [0.19, -0.2];

/// Numbers with derivatives by angle and rate.
type Two = DualNumber<DualSVec64<2>>;

/// A step that repeats itself.
#[derive(Clone, Copy, Debug)]
pub struct Gait {
    /// Angle and rate just after the heel strike.
    pub start: [f64; 2],
    /// The derivative of the step: how a small deviation is changed by it.
    pub derivative: Matrix2<f64>,
}

impl Gait {
    /// Newton's method from a guess.
    ///
    /// # Errors
    /// Where no gait is found from there.
    pub fn find(foot: f64, slope: f64, mut start: [f64; 2]) -> Result<Self, Box<dyn Error>> {
        let mut least = f64::INFINITY;
        for _ in 0..30 {
            let (next, derivative) = step(foot, slope, start)?;
            let off = SVector::from(next) - SVector::from(start);
            // Steps are known to 1e-12 and some; then corrections no longer shrink.
            if off.norm() < 1e-10 && off.norm() >= 0.5 * least {
                return Ok(Self { start, derivative });
            }
            least = off.norm();
            let by = (Matrix2::identity() - derivative).lu().solve(&off).ok_or("a gait that is not alone")?;
            start = [start[0] + by[0], start[1] + by[1]];
        }
        Err("no gait".into())
    }

    /// The two numbers by which deviations are multiplied in a step.
    pub fn multipliers(&self) -> [Complex<f64>; 2] {
        self.derivative.complex_eigenvalues().into()
    }
}

/// A step, with its derivatives by angle and rate.
///
/// # Errors
/// Where the walker falls.
pub fn step(foot: f64, slope: f64, start: [f64; 2]) -> Result<([f64; 2], Matrix2<f64>), Box<dyn Error>> {
    let variables: [Two; 2] = std::array::from_fn(|i| {
        let mut x = DualSVec64::from_re(start[i]);
        x.eps = Derivative::some(SVector::from_fn(|j, _| f64::from(u8::from(i == j))));
        DualNumber(x)
    });
    let end = walk(Two::from_f64(foot), Two::from_f64(slope), variables, |_| {}, 1)?;
    let slopes = end.map(|x| x.eps.0.unwrap_or_else(SVector::zeros));
    Ok((end.map(|x| x.re), Matrix2::new(slopes[0][0], slopes[0][1], slopes[1][0], slopes[1][1])))
}
