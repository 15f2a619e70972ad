//! Equations of motion by someone who knows the structure: constants computed once, sines and cosines inlined and once
//! an angle, fused multiply-adds, no matrix that is not full.

use gauss_runtime::prelude::*;
use nalgebra::Vector2;

mod sine_cosine;

use sine_cosine::sin_cos;

use crate::Dynamics;
use crate::scenes::{G, numbers};

/// a·b + c as the target does it best: what kernels use as well.
#[inline(always)]
fn fma(a: f64, b: f64, c: f64) -> f64 {
    Real::fma(a, b, c)
}

/// a·b − c·d.
#[inline(always)]
fn minor(a: f64, b: f64, c: f64, d: f64) -> f64 {
    fma(a, b, -(c * d))
}

#[inline(always)]
fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [minor(a[1], b[2], a[2], b[1]), minor(a[2], b[0], a[0], b[2]), minor(a[0], b[1], a[1], b[0])]
}

/// a × b + c.
#[inline(always)]
fn cross_plus(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> [f64; 3] {
    let component = |i: usize, j: usize, k: usize| fma(a[i], b[j], fma(-a[j], b[i], c[k]));
    [component(1, 2, 0), component(2, 0, 1), component(0, 1, 2)]
}

/// M v, M given by its rows.
#[inline(always)]
fn times<const N: usize>(matrix: &[[f64; N]; N], v: [f64; N]) -> [f64; N] {
    std::array::from_fn(|i| {
        let mut sum = matrix[i][0] * v[0];
        for j in 1..N {
            sum = fma(matrix[i][j], v[j], sum);
        }
        sum
    })
}

fn rows<const N: usize>(matrix: &SMatrix<f64, N, N>) -> [[f64; N]; N] {
    std::array::from_fn(|i| std::array::from_fn(|j| matrix[(i, j)]))
}

/// The vertical k₃ in body axes, from the unit quaternion of the attitude: the third row of R.
#[inline(always)]
fn vertical(q: &Isometry3<f64>) -> [f64; 3] {
    let c = &q.rotation.coords;
    let (x, y, z, w) = (c.x, c.y, c.z, c.w);
    [2.0 * minor(x, z, w, y), 2.0 * fma(y, z, w * x), fma(-2.0, fma(x, x, y * y), 1.0)]
}

#[inline(always)]
fn parts(z: &Vector6<f64>) -> ([f64; 3], [f64; 3]) {
    ([z[0], z[1], z[2]], [z[3], z[4], z[5]])
}

#[inline(always)]
fn joined(a: [f64; 3], b: [f64; 3]) -> Vector6<f64> {
    Vector6::new(a[0], a[1], a[2], b[0], b[1], b[2])
}

/// S1.
#[derive(Clone, Copy, Debug)]
pub struct FreeBody {
    ratios: [f64; 3],
}

impl FreeBody {
    /// With the parameters of the scene.
    pub fn new() -> Self {
        let (_, [a, b, c]) = numbers::FREE_BODY;
        Self { ratios: [(b - c) / a, (c - a) / b, (a - b) / c] }
    }
}

impl Dynamics for FreeBody {
    type Configuration = Isometry3<f64>;
    type Speeds = Vector6<f64>;

    #[inline]
    fn acceleration(&self, _: &Isometry3<f64>, z: &Vector6<f64>) -> Vector6<f64> {
        let (u, w) = parts(z);
        let [r1, r2, r3] = self.ratios;
        joined(cross(u, w), [r1 * w[1] * w[2], r2 * w[2] * w[0], r3 * w[0] * w[1]])
    }
}

/// S2: the weight has no moment about the centre of mass, so ω̇ is that of a free body.
#[derive(Clone, Copy, Debug)]
pub struct HeavyBody {
    center: [f64; 3],
    inertia: [[f64; 3]; 3],
    inverse: [[f64; 3]; 3],
}

impl HeavyBody {
    /// With the parameters of the scene.
    pub fn new() -> Self {
        let (_, center, inertia) = numbers::heavy_body();
        let inverse = inertia.try_inverse().unwrap_or_default();
        Self { center: center.into(), inertia: rows(&inertia), inverse: rows(&inverse) }
    }
}

impl Dynamics for HeavyBody {
    type Configuration = Isometry3<f64>;
    type Speeds = Vector6<f64>;

    #[inline]
    fn acceleration(&self, q: &Isometry3<f64>, z: &Vector6<f64>) -> Vector6<f64> {
        let (u, w) = parts(z);
        let c = self.center;
        let rate = times(&self.inverse, cross(times(&self.inertia, w), w));
        let up = vertical(q);
        let weight = [-G * up[0], -G * up[1], -G * up[2]];
        // u̇ = g − ω × (u + ω × c) − ω̇ × c.
        let velocity = cross_plus(w, c, u);
        let translation = cross_plus(c, rate, cross_plus(velocity, w, weight));
        joined(translation, rate)
    }
}

/// S3.
#[derive(Clone, Copy, Debug)]
pub struct Immersed {
    kinetic: [[f64; 6]; 6],
    inverse: [[f64; 6]; 6],
    /// Buoyancy less weight, and its moment about O for a vertical of length one.
    lift: f64,
    arm: [f64; 3],
}

impl Immersed {
    /// With the parameters of the scene.
    pub fn new() -> Self {
        let inverse = Matrix6::from_fn(|i, j| numbers::KINETIC[i][j]).try_inverse().unwrap_or_default();
        let ((weight, low), (buoyancy, high)) = (numbers::WEIGHT, numbers::BUOYANCY);
        let arm = std::array::from_fn(|i| buoyancy * high[i] - weight * low[i]);
        Self { kinetic: numbers::KINETIC, inverse: rows(&inverse), lift: buoyancy - weight, arm }
    }
}

impl Dynamics for Immersed {
    type Configuration = Isometry3<f64>;
    type Speeds = Vector6<f64>;

    #[inline]
    fn acceleration(&self, q: &Isometry3<f64>, z: &Vector6<f64>) -> Vector6<f64> {
        let (u, w) = parts(z);
        let p = times(&self.kinetic, [u[0], u[1], u[2], w[0], w[1], w[2]]);
        let (linear, angular) = ([p[0], p[1], p[2]], [p[3], p[4], p[5]]);
        let up = vertical(q);
        let force = cross_plus(linear, w, [self.lift * up[0], self.lift * up[1], self.lift * up[2]]);
        let torque = cross_plus(angular, w, cross_plus(linear, u, cross(self.arm, up)));
        times(&self.inverse, [force[0], force[1], force[2], torque[0], torque[1], torque[2]]).into()
    }
}

/// S4: Euler's equations in body axes; second derivatives of the angles along the line of nodes and across it.
#[derive(Clone, Copy, Debug)]
pub struct Top {
    ratios: [f64; 3],
    /// m g l over the first and the second moment.
    weights: [f64; 2],
}

impl Top {
    /// With the parameters of the scene.
    pub fn new() -> Self {
        let (mass, distance, moments) = numbers::top();
        let [a, b, c] = [moments.x, moments.y, moments.z];
        let weight = mass * G * distance;
        Self { ratios: [(b - c) / a, (c - a) / b, (a - b) / c], weights: [weight / a, weight / b] }
    }
}

impl Dynamics for Top {
    type Configuration = Vector3<f64>;
    type Speeds = Vector3<f64>;

    #[inline]
    fn acceleration(&self, q: &Vector3<f64>, z: &Vector3<f64>) -> Vector3<f64> {
        let (st, ct) = sin_cos(q[1]);
        let (sp, cp) = sin_cos(q[2]);
        let (precession, nutation, spin) = (z[0], z[1], z[2]);
        let across = precession * st;
        // ω in body axes.
        let w1 = fma(across, sp, nutation * cp);
        let w2 = minor(across, cp, nutation, sp);
        let w3 = fma(precession, ct, spin);
        let [r1, r2, r3] = self.ratios;
        let a1 = fma(r1 * w2, w3, self.weights[0] * (st * cp));
        let a2 = minor(r2 * w3, w1, self.weights[1], st * sp);
        let a3 = r3 * (w1 * w2);
        // Rates of ω's components along the line of nodes and across it, without the spin of the axes.
        let along = fma(-across, spin, minor(a1, cp, a2, sp));
        let across_rate = fma(nutation, spin, fma(a1, sp, a2 * cp));
        let turning = precession * nutation;
        let first = fma(-turning, ct, across_rate) / st;
        Vector3::new(first, along, fma(turning, st, fma(-first, ct, a3)))
    }
}

/// S5.
#[derive(Clone, Copy, Debug)]
pub struct DoublePendulum {
    /// Moments: of the upper link with the lower one's mass at its end, of the lower link, and what couples them.
    moments: [f64; 3],
    weights: [f64; 2],
    /// Product of the moments.
    product: f64,
}

impl DoublePendulum {
    /// With the parameters of the scene.
    pub fn new() -> Self {
        let ((m1, c1, i1), (m2, c2, i2), l) = (numbers::UPPER, numbers::LOWER, numbers::LENGTH);
        let (upper, lower) = (i1 + m1 * c1 * c1 + m2 * l * l, i2 + m2 * c2 * c2);
        let weights = [(m1 * c1 + m2 * l) * G, m2 * c2 * G];
        Self { moments: [upper, lower, m2 * l * c2], weights, product: upper * lower }
    }

    /// Rates of the angular velocities of the links; sines of both angles, sine and cosine of what the lower one is
    /// ahead.
    #[inline(always)]
    fn rates(&self, sines: [f64; 2], (sine, cosine): (f64, f64), speeds: [f64; 2]) -> [f64; 2] {
        let [upper, lower, coupling] = self.moments;
        let (off, turning) = (coupling * cosine, coupling * sine);
        let f1 = minor(turning, speeds[1] * speeds[1], self.weights[0], sines[0]);
        let f2 = fma(-turning, speeds[0] * speeds[0], -(self.weights[1] * sines[1]));
        let reciprocal = 1.0 / fma(-off, off, self.product);
        [minor(lower, f1, off, f2) * reciprocal, minor(upper, f2, off, f1) * reciprocal]
    }
}

impl Dynamics for DoublePendulum {
    type Configuration = Vector2<f64>;
    type Speeds = Vector2<f64>;

    #[inline]
    fn acceleration(&self, q: &Vector2<f64>, z: &Vector2<f64>) -> Vector2<f64> {
        let (sa, ca) = sin_cos(q[0]);
        let (sb, cb) = sin_cos(q[1]);
        self.rates([sa, sb], (minor(sb, ca, cb, sa), fma(sa, sb, ca * cb)), [z[0], z[1]]).into()
    }
}

/// S5′.
#[derive(Clone, Copy, Debug, Default)]
pub struct JointedPendulum(pub DoublePendulum);

impl Dynamics for JointedPendulum {
    type Configuration = Vector2<f64>;
    type Speeds = Vector2<f64>;

    #[inline]
    fn acceleration(&self, q: &Vector2<f64>, z: &Vector2<f64>) -> Vector2<f64> {
        let (sa, ca) = sin_cos(q[0]);
        let (sc, cc) = sin_cos(q[1]);
        let [first, second] = self.0.rates([sa, fma(sa, cc, ca * sc)], (sc, cc), [z[0], z[0] + z[1]]);
        Vector2::new(first, second - first)
    }
}

/// S6.
#[derive(Clone, Copy, Debug)]
pub struct CartPole {
    mass: f64,
    moment: f64,
    product: f64,
    first_moment: f64,
    weight: f64,
}

impl CartPole {
    /// With the parameters of the scene.
    pub fn new() -> Self {
        let (m, c, i) = numbers::POLE;
        let (mass, moment) = (numbers::CART + m, i + m * c * c);
        Self { mass, moment, product: mass * moment, first_moment: m * c, weight: m * c * G }
    }
}

impl Dynamics for CartPole {
    type Configuration = Vector2<f64>;
    type Speeds = Vector2<f64>;

    #[inline]
    fn acceleration(&self, q: &Vector2<f64>, z: &Vector2<f64>) -> Vector2<f64> {
        let (s, c) = sin_cos(q[1]);
        let off = self.first_moment * c;
        let force = self.first_moment * s * (z[1] * z[1]);
        let torque = self.weight * s;
        let reciprocal = 1.0 / fma(-off, off, self.product);
        let cart = minor(self.moment, force, off, torque) * reciprocal;
        Vector2::new(cart, minor(self.mass, torque, off, force) * reciprocal)
    }
}

macro_rules! as_in_the_scene {
    ($($name:ident)+) => {$(
        impl Default for $name {
            fn default() -> Self {
                Self::new()
            }
        }
    )+};
}

as_in_the_scene!(FreeBody HeavyBody Immersed Top DoublePendulum CartPole);
