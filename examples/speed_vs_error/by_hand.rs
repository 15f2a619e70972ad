//! The equations of motion of every scene, as one types them from a textbook: body-frame velocities and a quaternion, angles
//! for pendulums. Nothing here is derived by Gauss. Constants are worked out before the run, as a careful author would.
//!
//! Quaternions are x, y, z, w and take body components to the observer's.

use gauss_runtime::prelude::*;

use crate::baselines::ByHand;
use crate::scene::rows;

/// The vector product.
#[inline(always)]
pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Half of q ∘ (ω, 0).
#[inline(always)]
fn quaternion_rate([x, y, z, w]: [f64; 4], [a, b, c]: [f64; 3]) -> [f64; 4] {
    [
        0.5 * (w * a + y * c - z * b),
        0.5 * (w * b + z * a - x * c),
        0.5 * (w * c + x * b - y * a),
        -0.5 * (x * a + y * b + z * c),
    ]
}

/// Rᵀk₃: the vertical in body axes.
#[inline(always)]
fn vertical([x, y, z, w]: [f64; 4]) -> [f64; 3] {
    [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)]
}

/// R v.
#[inline(always)]
fn turned([x, y, z, w]: [f64; 4], v: [f64; 3]) -> [f64; 3] {
    let t = cross([x, y, z], v).map(|c| 2.0 * c);
    let s = cross([x, y, z], t);
    [v[0] + w * t[0] + s[0], v[1] + w * t[1] + s[1], v[2] + w * t[2] + s[2]]
}

#[inline(always)]
fn normalise_quaternion(q: &mut [f64]) {
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
    /// m g c.
    moment: [f64; 3],
}

impl Top {
    /// Inertia about O; `moment` is m g times the vector from O to G.
    pub fn new(inertia: Vector3<f64>, moment: Vector3<f64>) -> Self {
        let [i, j, k] = inertia.into();
        Self { inertia: [i, j, k], ratios: [(j - k) / i, (k - i) / j, (i - j) / k], moment: moment.into() }
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
        let [i, j, k] = self.inertia;
        [
            self.ratios[0] * b * c + torque[0] / i,
            self.ratios[1] * c * a + torque[1] / j,
            self.ratios[2] * a * b + torque[2] / k,
            x,
            y,
            z,
            w,
        ]
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
}

impl Ideal {
    /// From the diagonal, order (u, ω).
    pub fn new(diagonal: Vector6<f64>) -> Self {
        let [a, b, c, i, j, k] = diagonal.into();
        Self { masses: [a, b, c], inertia: [i, j, k] }
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
        let torque = [spin[0] + slip[0], spin[1] + slip[1], spin[2] + slip[2]];
        joined(
            [force[0] / m[0], force[1] / m[1], force[2] / m[2]],
            [torque[0] / j[0], torque[1] / j[1], torque[2] / j[2]],
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

/// Kirchhoff's equations with a full kinetic matrix, weight and buoyancy.
#[derive(Clone, Copy)]
pub struct Submerged {
    kinetic: [[f64; 6]; 6],
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
        Some(Self { kinetic: array(kinetic), inverse, heaviness, moment: moment.into(), place })
    }
}

#[inline(always)]
fn times(m: &[[f64; 6]; 6], v: [f64; 6]) -> [f64; 6] {
    m.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2] + row[3] * v[3] + row[4] * v[4] + row[5] * v[5])
}

impl ByHand<13> for Submerged {
    const VELOCITIES: usize = 6;

    #[inline(always)]
    fn rates(&self, y: &[f64; 13]) -> [f64; 13] {
        let (u, omega, q, _) = parts(y);
        let [p1, p2, p3, l1, l2, l3] = times(&self.kinetic, [u[0], u[1], u[2], omega[0], omega[1], omega[2]]);
        let (p, l) = ([p1, p2, p3], [l1, l2, l3]);
        let up = vertical(q);
        let force = cross(p, omega);
        let (spin, slip, weight) = (cross(l, omega), cross(p, u), cross(up, self.moment));
        let [u1, u2, u3, w1, w2, w3] = times(
            &self.inverse,
            [
                force[0] - self.heaviness * up[0],
                force[1] - self.heaviness * up[1],
                force[2] - self.heaviness * up[2],
                spin[0] + slip[0] + weight[0],
                spin[1] + slip[1] + weight[1],
                spin[2] + slip[2] + weight[2],
            ],
        );
        joined([u1, u2, u3], [w1, w2, w3], quaternion_rate(q, omega), turned(q, u))
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
        let (u, omega, q, b) = parts(y);
        let v = [u[0], u[1], u[2], omega[0], omega[1], omega[2]];
        let p = times(&self.kinetic, v);
        let up = vertical(q);
        let kinetic = (0..6).map(|n| 0.5 * v[n] * p[n]).sum::<f64>();
        kinetic + self.heaviness * b[2] + (0..3).map(|n| self.moment[n] * up[n]).sum::<f64>()
    }
}

/// Newton–Euler equations about G: weight, linear drag on u and ω, and a force of constant observer components at a point.
#[derive(Clone, Copy)]
pub struct Dragged {
    /// m, kg.
    pub mass: f64,
    /// About G, principal.
    pub inertia: [f64; 3],
    /// m/s².
    pub gravity: f64,
    /// Drag on u and on ω.
    pub drag: [f64; 2],
    /// Observer axes.
    pub push: [f64; 3],
    /// Where it acts, body axes.
    pub at: [f64; 3],
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
        let [f, g] = self.drag;
        joined(
            [0, 1, 2].map(|n| turn[n] - self.gravity * up[n] + (push[n] - f * u[n]) / self.mass),
            [0, 1, 2].map(|n| (spin[n] + lever[n] - g * omega[n]) / j[n]),
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
