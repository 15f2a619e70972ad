//! The equations of pendulums and rolling bodies by hand.

use gauss_runtime::prelude::*;

use super::baselines::ByHand;
use super::by_hand::{cross, normalise_quaternion, quaternion_rate, turned, vertical};
use super::scene::rows;

/// A spherical pendulum in Cartesian coordinates: v, then x. The thread pulls by λ = (v² + g·x)/ℓ².
#[derive(Clone, Copy)]
pub struct SphericalPendulum {
    /// ℓ.
    pub length: f64,
    /// g.
    pub gravity: f64,
}

impl ByHand<6> for SphericalPendulum {
    const VELOCITIES: usize = 3;

    #[inline(always)]
    fn rates(&self, &[a, b, c, x, y, z]: &[f64; 6]) -> [f64; 6] {
        let pull = (a * a + b * b + c * c - self.gravity * z) / (self.length * self.length);
        [-pull * x, -pull * y, -pull * z - self.gravity, a, b, c]
    }

    #[inline(always)]
    fn normalise(&self, _: &mut [f64; 6]) {}

    fn observe(&self, y: &[f64; 6]) -> Vec<Vec<f64>> {
        vec![y[3..].to_vec()]
    }

    fn energy(&self, &[a, b, c, _, _, z]: &[f64; 6]) -> f64 {
        0.5 * (a * a + b * b + c * c) + self.gravity * z
    }
}

/// A double pendulum in angles from the downward vertical: rates, then angles.
#[derive(Clone, Copy)]
pub struct DoublePendulum {
    /// Masses.
    pub masses: [f64; 2],
    /// Lengths.
    pub lengths: [f64; 2],
    /// g.
    pub gravity: f64,
}

impl ByHand<4> for DoublePendulum {
    const VELOCITIES: usize = 2;

    #[inline(always)]
    fn rates(&self, &[wa, wb, a, b]: &[f64; 4]) -> [f64; 4] {
        let ([m1, m2], [l1, l2], g) = (self.masses, self.lengths, self.gravity);
        let ((sa, ca), (sb, cb)) = (a.sin_cos(), b.sin_cos());
        // Of a − b: cheaper than a third sine.
        let (s, c) = (sa * cb - ca * sb, ca * cb + sa * sb);
        let total = m1 + m2;
        let first = -m2 * l2 * wb * wb * s - total * g * sa;
        let second = l1 * wa * wa * s - g * sb;
        // (m₁ + m₂) l₁ ä + m₂ l₂ c b̈ = first, l₁ c ä + l₂ b̈ = second.
        let scale = 1.0 / (l1 * l2 * (m1 + m2 * s * s));
        [l2 * scale * (first - m2 * c * second), l1 * scale * (total * second - c * first), wa, wb]
    }

    #[inline(always)]
    fn normalise(&self, _: &mut [f64; 4]) {}

    fn observe(&self, &[_, _, a, b]: &[f64; 4]) -> Vec<Vec<f64>> {
        let [l1, l2] = self.lengths;
        let (x, y) = (l1 * a.sin(), -l1 * a.cos());
        vec![vec![x, y], vec![x + l2 * b.sin(), y - l2 * b.cos()]]
    }

    fn energy(&self, &[wa, wb, a, b]: &[f64; 4]) -> f64 {
        let ([m1, m2], [l1, l2], g) = (self.masses, self.lengths, self.gravity);
        let (u, v) = (l1 * wa, l2 * wb);
        let kinetic = 0.5 * (m1 + m2) * u * u + 0.5 * m2 * v * v + m2 * u * v * (a - b).cos();
        kinetic - (m1 + m2) * g * l1 * a.cos() - m2 * g * l2 * b.cos()
    }
}

/// A thin disk that rolls on the plane z = 0: ω in body axes, the quaternion, the centre.
#[derive(Clone, Copy)]
pub struct Disk {
    /// m.
    pub mass: f64,
    /// About a diameter, and about the axis e₃.
    pub inertia: [f64; 2],
    /// Of the rim.
    pub radius: f64,
    /// g.
    pub gravity: f64,
}

impl Disk {
    /// From the centre to the contact, body axes, and γ = Rᵀk₃.
    #[inline(always)]
    fn contact(&self, [x, y, z, w]: [f64; 4]) -> ([f64; 3], [f64; 3]) {
        let up = vertical([x, y, z, w]);
        let scale = -self.radius / (up[0] * up[0] + up[1] * up[1]).sqrt();
        ([scale * up[0], scale * up[1], 0.0], up)
    }
}

impl ByHand<10> for Disk {
    const VELOCITIES: usize = 3;

    #[inline(always)]
    fn rates(&self, &[a, b, c, x, y, z, w, ..]: &[f64; 10]) -> [f64; 10] {
        let (omega, q, m, [i, k]) = ([a, b, c], [x, y, z, w], self.mass, self.inertia);
        let (rho, up) = self.contact(q);
        let turn = cross(up, omega);
        // ρ has a fixed length: ρ̇ is −r/|γ⊥| γ̇⊥ without its part along ρ.
        let scale = -self.radius / (up[0] * up[0] + up[1] * up[1]).sqrt();
        let (n1, n2) = (rho[0] / self.radius, rho[1] / self.radius);
        let along = turn[0] * n1 + turn[1] * n2;
        let rho_rate = [scale * (turn[0] - along * n1), scale * (turn[1] - along * n2), 0.0];
        // (I + m(ρ²1 − ρρᵀ)) ω̇ = Iω × ω + m ρ × (ρ̇ × ω + ω × v + gγ), v = ρ × ω.
        let v = cross(rho, omega);
        let (first, second) = (cross(rho_rate, omega), cross(omega, v));
        let carried = [0, 1, 2].map(|n| first[n] + second[n] + self.gravity * up[n]);
        let torque = cross(rho, carried);
        let t = [(i - k) * b * c + m * torque[0], (k - i) * a * c + m * torque[1], m * torque[2]];
        let across = i + m * self.radius * self.radius;
        let down = 1.0 / (i * across);
        let (r1, r2) = (rho[0], rho[1]);
        let ([x, y, z, w], velocity) = (quaternion_rate(q, omega), turned(q, v));
        [
            down * ((i + m * r1 * r1) * t[0] + m * r1 * r2 * t[1]),
            down * (m * r1 * r2 * t[0] + (i + m * r2 * r2) * t[1]),
            t[2] / (k + m * self.radius * self.radius),
            x,
            y,
            z,
            w,
            velocity[0],
            velocity[1],
            velocity[2],
        ]
    }

    #[inline(always)]
    fn normalise(&self, y: &mut [f64; 10]) {
        normalise_quaternion(&mut y[3..7]);
    }

    fn observe(&self, &[_, _, _, x, y, z, w, b1, b2, b3]: &[f64; 10]) -> Vec<Vec<f64>> {
        vec![rows(&UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z))), vec![b1, b2, b3]]
    }

    fn energy(&self, &[a, b, c, x, y, z, w, _, _, height]: &[f64; 10]) -> f64 {
        let (rho, _) = self.contact([x, y, z, w]);
        let [i, k] = self.inertia;
        let speed: f64 = cross(rho, [a, b, c]).iter().map(|v| v * v).sum();
        0.5 * (self.mass * speed + i * (a * a + b * b) + k * c * c) + self.mass * self.gravity * height
    }
}

/// The same disk with ω in the axes of the first two turns (about k₃ by φ, then about the horizontal diameter by θ),
/// which do not spin with it: ω, then φ, θ, ψ, and x, y of the centre.
#[derive(Clone, Copy)]
pub struct DiskByAngles(pub Disk);

impl ByHand<8> for DiskByAngles {
    const VELOCITIES: usize = 3;

    #[inline(always)]
    fn rates(&self, &[a, b, c, phi, theta, ..]: &[f64; 8]) -> [f64; 8] {
        let Disk { mass, inertia: [i, k], radius: r, gravity } = self.0;
        let ((sp, cp), (st, ct)) = (phi.sin_cos(), theta.sin_cos());
        // The axes turn with (a, b, b cot θ); the contact pushes at −r e₂ with m times the acceleration of the centre
        // and g k₃.
        let about_up = b / st;
        let carried = about_up * ct;
        let rolling = mass * r * r;
        [
            ((carried * i - (k + rolling) * c) * b - mass * gravity * r * ct) / (i + rolling),
            (k * c / i - carried) * a,
            rolling * a * b / (k + rolling),
            about_up,
            a,
            c - carried,
            r * (a * st * sp - c * cp),
            -r * (a * st * cp + c * sp),
        ]
    }

    #[inline(always)]
    fn normalise(&self, _: &mut [f64; 8]) {}

    fn observe(&self, &[_, _, _, phi, theta, psi, x, y]: &[f64; 8]) -> Vec<Vec<f64>> {
        let about = |axis, angle| UnitQuaternion::from_axis_angle(&axis, angle);
        let (up, node) = (Vector3::z_axis(), Vector3::x_axis());
        let rotation = about(up, phi) * about(node, theta) * about(up, psi);
        vec![rows(&rotation), vec![x, y, self.0.radius * theta.sin()]]
    }

    fn energy(&self, &[a, b, c, _, theta, ..]: &[f64; 8]) -> f64 {
        let Disk { mass, inertia: [i, k], radius: r, gravity } = self.0;
        let speed = r * r * (a * a + c * c);
        0.5 * (mass * speed + i * (a * a + b * b) + k * c * c) + mass * gravity * r * theta.sin()
    }
}

/// Chaplygin's sleigh: v along the edge, the turning rate, the heading, the position.
#[derive(Clone, Copy)]
pub struct Sleigh {
    /// m.
    pub mass: f64,
    /// From the edge to G.
    pub lever: f64,
    /// About O.
    pub inertia: f64,
}

impl ByHand<5> for Sleigh {
    const VELOCITIES: usize = 2;

    #[inline(always)]
    fn rates(&self, &[v, omega, theta, ..]: &[f64; 5]) -> [f64; 5] {
        let (s, c) = theta.sin_cos();
        let slow = -self.mass * self.lever / self.inertia;
        [self.lever * omega * omega, slow * v * omega, omega, v * c, v * s]
    }

    #[inline(always)]
    fn normalise(&self, _: &mut [f64; 5]) {}

    fn observe(&self, &[_, _, theta, x, y]: &[f64; 5]) -> Vec<Vec<f64>> {
        vec![rows(&UnitQuaternion::from_axis_angle(&Vector3::z_axis(), theta)), vec![x, y, 0.0]]
    }

    fn energy(&self, &[v, omega, ..]: &[f64; 5]) -> f64 {
        0.5 * (self.mass * v * v + self.inertia * omega * omega)
    }
}
