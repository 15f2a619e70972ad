//! The equations of motion of every scene, as one types them from a textbook: body-frame velocities and a quaternion,
//! angles for pendulums. Nothing here is derived by Gauss. Constants and reciprocals are worked out before the run,
//! and fused multiply-adds are used where the target has them, as a careful author would.
//!
//! Quaternions are x, y, z, w and take body components to the observer's.

use gauss_runtime::prelude::*;

use super::baselines::ByHand;
use super::scene::rows;

/// a b + c, fused where that is one instruction.
#[inline(always)]
fn fused(a: f64, b: f64, c: f64) -> f64 {
    if cfg!(target_feature = "fma") { a.mul_add(b, c) } else { a * b + c }
}

/// The vector product.
#[inline(always)]
pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [fused(a[1], b[2], -a[2] * b[1]), fused(a[2], b[0], -a[0] * b[2]), fused(a[0], b[1], -a[1] * b[0])]
}

/// Half of q ∘ (ω, 0).
#[inline(always)]
pub fn quaternion_rate([x, y, z, w]: [f64; 4], omega: [f64; 3]) -> [f64; 4] {
    let [a, b, c] = omega.map(|rate| 0.5 * rate);
    [
        fused(w, a, fused(y, c, -z * b)),
        fused(w, b, fused(z, a, -x * c)),
        fused(w, c, fused(x, b, -y * a)),
        fused(-x, a, fused(-y, b, -z * c)),
    ]
}

/// Rᵀk₃: the vertical in body axes.
#[inline(always)]
pub fn vertical([x, y, z, w]: [f64; 4]) -> [f64; 3] {
    [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)]
}

/// R v.
#[inline(always)]
pub fn turned([x, y, z, w]: [f64; 4], v: [f64; 3]) -> [f64; 3] {
    let t = cross([x, y, z], v).map(|c| 2.0 * c);
    let s = cross([x, y, z], t);
    [0, 1, 2].map(|n| fused(w, t[n], v[n] + s[n]))
}

/// Four components brought back to length 1.
#[inline(always)]
pub fn normalise_quaternion(q: &mut [f64]) {
    let scale = 1.0 / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]).sqrt();
    q.iter_mut().for_each(|x| *x *= scale);
}

fn attitude(q: [f64; 4]) -> Vec<f64> {
    rows(&UnitQuaternion::new_normalize(Quaternion::new(q[3], q[0], q[1], q[2])))
}

/// A quaternion in the order of these equations.
pub fn coordinates(rotation: &UnitQuaternion<f64>) -> [f64; 4] {
    rotation.coords.into()
}

/// Euler's equations about a fixed point, principal axes, with the weight of G: ω, then the quaternion.
#[derive(Clone, Copy)]
pub struct Top {
    inertia: [f64; 3],
    /// (I₂ − I₃)/I₁ and so on round.
    ratios: [f64; 3],
    reciprocals: [f64; 3],
    /// m g c.
    moment: [f64; 3],
}

impl Top {
    /// Inertia about O; `moment` is m g times the vector from O to G.
    pub fn new(inertia: Vector3<f64>, moment: Vector3<f64>) -> Self {
        let [i, j, k] = inertia.into();
        Self {
            inertia: [i, j, k],
            ratios: [(j - k) / i, (k - i) / j, (i - j) / k],
            reciprocals: [1.0 / i, 1.0 / j, 1.0 / k],
            moment: moment.into(),
        }
    }
}

impl ByHand<7> for Top {
    const VELOCITIES: usize = 3;

    #[inline(always)]
    fn rates(&self, &[a, b, c, x, y, z, w]: &[f64; 7]) -> [f64; 7] {
        let q = [x, y, z, w];
        // The weight −m g γ acts at c.
        let torque = cross(vertical(q), self.moment);
        let [x, y, z, w] = quaternion_rate(q, [a, b, c]);
        let ([r1, r2, r3], [i, j, k]) = (self.ratios, self.reciprocals);
        [fused(r1 * b, c, torque[0] * i), fused(r2 * c, a, torque[1] * j), fused(r3 * a, b, torque[2] * k), x, y, z, w]
    }

    #[inline(always)]
    fn normalise(&self, y: &mut [f64; 7]) {
        normalise_quaternion(&mut y[3..]);
    }

    fn observe(&self, &[_, _, _, x, y, z, w]: &[f64; 7]) -> Vec<Vec<f64>> {
        vec![attitude([x, y, z, w])]
    }

    fn energy(&self, &[a, b, c, x, y, z, w]: &[f64; 7]) -> f64 {
        let [i, j, k] = self.inertia;
        let up = vertical([x, y, z, w]);
        0.5 * (i * a * a + j * b * b + k * c * c) + (0..3).map(|n| self.moment[n] * up[n]).sum::<f64>()
    }
}

/// The same for a top with I₁ = I₂ and its centre of mass on e₃: ω₃ is constant.
#[derive(Clone, Copy)]
pub struct SymmetricTop(pub Top);

impl ByHand<7> for SymmetricTop {
    const VELOCITIES: usize = 3;

    #[inline(always)]
    fn rates(&self, &[a, b, c, x, y, z, w]: &[f64; 7]) -> [f64; 7] {
        // γ₁ and γ₂ of the vertical in body axes, halved.
        let (first, second) = (fused(x, z, -(y * w)), fused(y, z, x * w));
        let [turn, weight] = [self.0.ratios[0] * c, 2.0 * self.0.moment[2] * self.0.reciprocals[0]];
        let [x, y, z, w] = quaternion_rate([x, y, z, w], [a, b, c]);
        [fused(turn, b, weight * second), fused(-turn, a, -(weight * first)), 0.0, x, y, z, w]
    }

    #[inline(always)]
    fn normalise(&self, y: &mut [f64; 7]) {
        self.0.normalise(y);
    }

    fn observe(&self, y: &[f64; 7]) -> Vec<Vec<f64>> {
        self.0.observe(y)
    }

    fn energy(&self, y: &[f64; 7]) -> f64 {
        self.0.energy(y)
    }
}

/// The same without weight.
#[derive(Clone, Copy)]
pub struct FreeTop(pub Top);

impl ByHand<7> for FreeTop {
    const VELOCITIES: usize = 3;

    #[inline(always)]
    fn rates(&self, &[a, b, c, x, y, z, w]: &[f64; 7]) -> [f64; 7] {
        let [x, y, z, w] = quaternion_rate([x, y, z, w], [a, b, c]);
        let ratios = self.0.ratios;
        [ratios[0] * b * c, ratios[1] * c * a, ratios[2] * a * b, x, y, z, w]
    }

    #[inline(always)]
    fn normalise(&self, y: &mut [f64; 7]) {
        self.0.normalise(y);
    }

    fn observe(&self, y: &[f64; 7]) -> Vec<Vec<f64>> {
        self.0.observe(y)
    }

    fn energy(&self, y: &[f64; 7]) -> f64 {
        self.0.energy(y)
    }
}

/// (u, ω), the quaternion and b of a pose and a twist.
pub fn body_state(pose: &Isometry3<f64>, twist: &Vector6<f64>) -> [f64; 13] {
    let (q, b) = (coordinates(&pose.rotation), pose.translation.vector);
    std::array::from_fn(|i| match i {
        0..6 => twist[i],
        6..10 => q[i - 6],
        _ => b[i - 10],
    })
}

/// The parts of [`body_state`].
#[inline(always)]
fn parts(y: &[f64; 13]) -> ([f64; 3], [f64; 3], [f64; 4], [f64; 3]) {
    let &[u1, u2, u3, w1, w2, w3, x, y, z, w, b1, b2, b3] = y;
    ([u1, u2, u3], [w1, w2, w3], [x, y, z, w], [b1, b2, b3])
}

#[inline(always)]
fn joined(u: [f64; 3], omega: [f64; 3], q: [f64; 4], b: [f64; 3]) -> [f64; 13] {
    [u[0], u[1], u[2], omega[0], omega[1], omega[2], q[0], q[1], q[2], q[3], b[0], b[1], b[2]]
}

fn pose_of(y: &[f64; 13]) -> Vec<Vec<f64>> {
    let (_, _, q, b) = parts(y);
    vec![attitude(q), b.to_vec()]
}

/// Kirchhoff's equations with a diagonal kinetic matrix and no force.
#[derive(Clone, Copy)]
pub struct Ideal {
    masses: [f64; 3],
    inertia: [f64; 3],
    /// 1/m and 1/J.
    reciprocals: [[f64; 3]; 2],
}

impl Ideal {
    /// From the diagonal, order (u, ω).
    pub fn new(diagonal: Vector6<f64>) -> Self {
        let [a, b, c, i, j, k] = diagonal.into();
        let reciprocals = [[1.0 / a, 1.0 / b, 1.0 / c], [1.0 / i, 1.0 / j, 1.0 / k]];
        Self { masses: [a, b, c], inertia: [i, j, k], reciprocals }
    }
}

impl ByHand<13> for Ideal {
    const VELOCITIES: usize = 6;

    #[inline(always)]
    fn rates(&self, y: &[f64; 13]) -> [f64; 13] {
        let (u, omega, q, _) = parts(y);
        let (m, j) = (self.masses, self.inertia);
        let p = [m[0] * u[0], m[1] * u[1], m[2] * u[2]];
        let l = [j[0] * omega[0], j[1] * omega[1], j[2] * omega[2]];
        let force = cross(p, omega);
        let (spin, slip) = (cross(l, omega), cross(p, u));
        let [of_masses, of_inertia] = self.reciprocals;
        joined(
            [0, 1, 2].map(|n| force[n] * of_masses[n]),
            [0, 1, 2].map(|n| (spin[n] + slip[n]) * of_inertia[n]),
            quaternion_rate(q, omega),
            turned(q, u),
        )
    }

    #[inline(always)]
    fn normalise(&self, y: &mut [f64; 13]) {
        normalise_quaternion(&mut y[6..10]);
    }

    fn observe(&self, y: &[f64; 13]) -> Vec<Vec<f64>> {
        pose_of(y)
    }

    fn energy(&self, y: &[f64; 13]) -> f64 {
        let (u, omega, _, _) = parts(y);
        (0..3).map(|n| 0.5 * (self.masses[n] * u[n] * u[n] + self.inertia[n] * omega[n] * omega[n])).sum()
    }
}

/// Kirchhoff's equations with a full kinetic matrix, weight and buoyancy, in momenta: one product with a matrix an
/// evaluation, where velocities would need two.
#[derive(Clone, Copy)]
pub struct Submerged {
    inverse: [[f64; 6]; 6],
    /// Weight less buoyancy, N, along −k₃.
    heaviness: f64,
    /// m g c − m_d g c_b.
    moment: [f64; 3],
    /// Whether the position is known to the target.
    place: bool,
}

impl Submerged {
    /// A kinetic matrix, order (u, ω), pole O; weight less buoyancy, and their moment m g c − m_d g c_b.
    pub fn new(kinetic: Matrix6<f64>, heaviness: f64, moment: Vector3<f64>, place: bool) -> Option<Self> {
        let array = |m: Matrix6<f64>| std::array::from_fn(|i| std::array::from_fn(|j| m[(i, j)]));
        let inverse = array(kinetic.try_inverse()?);
        Some(Self { inverse, heaviness, moment: moment.into(), place })
    }
}

#[inline(always)]
fn times(m: &[[f64; 6]; 6], v: [f64; 6]) -> [f64; 6] {
    m.map(|row| (1..6).fold(row[0] * v[0], |sum, n| fused(row[n], v[n], sum)))
}

impl ByHand<13> for Submerged {
    const VELOCITIES: usize = 6;

    #[inline(always)]
    fn rates(&self, y: &[f64; 13]) -> [f64; 13] {
        let (p, l, q, _) = parts(y);
        let [u1, u2, u3, w1, w2, w3] = times(&self.inverse, [p[0], p[1], p[2], l[0], l[1], l[2]]);
        let (u, omega) = ([u1, u2, u3], [w1, w2, w3]);
        let up = vertical(q);
        let force = cross(p, omega);
        let (spin, slip, weight) = (cross(l, omega), cross(p, u), cross(up, self.moment));
        joined(
            [0, 1, 2].map(|n| fused(-self.heaviness, up[n], force[n])),
            [0, 1, 2].map(|n| spin[n] + slip[n] + weight[n]),
            quaternion_rate(q, omega),
            turned(q, u),
        )
    }

    #[inline(always)]
    fn normalise(&self, y: &mut [f64; 13]) {
        normalise_quaternion(&mut y[6..10]);
    }

    fn observe(&self, y: &[f64; 13]) -> Vec<Vec<f64>> {
        let mut seen = pose_of(y);
        seen.truncate(if self.place { 2 } else { 1 });
        seen
    }

    fn energy(&self, y: &[f64; 13]) -> f64 {
        let (p, l, q, b) = parts(y);
        let momenta = [p[0], p[1], p[2], l[0], l[1], l[2]];
        let v = times(&self.inverse, momenta);
        let up = vertical(q);
        let kinetic = (0..6).map(|n| 0.5 * v[n] * momenta[n]).sum::<f64>();
        kinetic + self.heaviness * b[2] + (0..3).map(|n| self.moment[n] * up[n]).sum::<f64>()
    }
}

/// Newton–Euler equations about G: weight, linear drag on u and ω, and a force of constant observer components at a
/// point.
#[derive(Clone, Copy)]
pub struct Dragged {
    mass: f64,
    inertia: [f64; 3],
    /// 1/m.
    light: f64,
    /// 1/J.
    quick: [f64; 3],
    gravity: f64,
    /// On u and on ω.
    drag: [f64; 2],
    /// Observer axes.
    push: [f64; 3],
    /// Where it acts, body axes.
    at: [f64; 3],
}

impl Dragged {
    /// Principal moments about G; drag and push are those of the struct for the derive.
    pub fn new(mass: f64, inertia: [f64; 3], gravity: f64) -> Self {
        let (light, quick) = (1.0 / mass, inertia.map(|j| 1.0 / j));
        let (drag, push, at) = ([0.4, 0.05], [1.0, 2.0, 0.5], [0.2, 0.0, 0.1]);
        Self { mass, inertia, light, quick, gravity, drag, push, at }
    }
}

impl ByHand<13> for Dragged {
    const VELOCITIES: usize = 6;

    #[inline(always)]
    fn rates(&self, y: &[f64; 13]) -> [f64; 13] {
        let (u, omega, q, _) = parts(y);
        let [x, y, z, w] = q;
        let push = turned([-x, -y, -z, w], self.push);
        let (up, turn, lever) = (vertical(q), cross(u, omega), cross(self.at, push));
        let j = self.inertia;
        let l = [j[0] * omega[0], j[1] * omega[1], j[2] * omega[2]];
        let spin = cross(l, omega);
        let ([f, g], light, quick) = (self.drag, self.light, self.quick);
        joined(
            [0, 1, 2].map(|n| fused(push[n] - f * u[n], light, turn[n] - self.gravity * up[n])),
            [0, 1, 2].map(|n| (spin[n] + lever[n] - g * omega[n]) * quick[n]),
            quaternion_rate(q, omega),
            turned(q, u),
        )
    }

    #[inline(always)]
    fn normalise(&self, y: &mut [f64; 13]) {
        normalise_quaternion(&mut y[6..10]);
    }

    fn observe(&self, y: &[f64; 13]) -> Vec<Vec<f64>> {
        pose_of(y)
    }

    fn energy(&self, y: &[f64; 13]) -> f64 {
        let (u, omega, _, b) = parts(y);
        let kinetic = |n: usize| 0.5 * (self.mass * u[n] * u[n] + self.inertia[n] * omega[n] * omega[n]);
        (0..3).map(kinetic).sum::<f64>() + self.mass * self.gravity * b[2]
    }
}
