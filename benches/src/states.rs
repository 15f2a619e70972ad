//! States that vary: 64 of each scene, the same in every run.

use gauss_runtime::prelude::*;

/// How many states are gone through.
pub const STATES: usize = 64;

/// A reproducible stream of numbers in [−1, 1) (Knuth's linear congruential generator).
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// From its beginning.
    pub fn new() -> Self {
        Self(1)
    }

    /// The next number.
    pub fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// Components up to a size.
    pub fn vector<const N: usize>(&mut self, size: f64) -> SVector<f64, N> {
        SVector::from_fn(|_, _| size * self.number())
    }
}

impl Default for Random {
    fn default() -> Self {
        Self::new()
    }
}

/// Poses and twists (u, ω) of a body: any attitude, up to 2 m/s and 2 rad/s an axis.
pub fn of_a_body() -> Vec<(Isometry3<f64>, Vector6<f64>)> {
    let random = &mut Random::new();
    (0..STATES)
        .map(|_| {
            let axis: Vector3<f64> = random.vector(3.0);
            (Isometry3::new(random.vector(1.0), axis), random.vector(2.0))
        })
        .collect()
}

/// Angles and rates: up to π and 2 rad/s.
pub fn of_angles<const N: usize>() -> Vec<(SVector<f64, N>, SVector<f64, N>)> {
    let random = &mut Random::new();
    (0..STATES).map(|_| (random.vector(core::f64::consts::PI), random.vector(2.0))).collect()
}

/// The pose of a base, and N angles of joints.
pub type Floating<const N: usize> = (Isometry3<f64>, SVector<f64, N>);

/// Poses of a base and angles of joints, and their rates: any attitude, up to π, 2 m/s and 2 rad/s.
pub fn of_a_floating_base<const N: usize, const D: usize>() -> Vec<(Floating<N>, SVector<f64, D>)> {
    let random = &mut Random::new();
    let mut state = || {
        let pose = Isometry3::new(random.vector(1.0), random.vector(3.0));
        ((pose, random.vector(core::f64::consts::PI)), random.vector(2.0))
    };
    (0..STATES).map(|_| state()).collect()
}

/// Euler angles whose middle one keeps away from gimbal lock: between 0.4 and π − 0.4.
pub fn of_the_top() -> Vec<(Vector3<f64>, Vector3<f64>)> {
    let mut states = of_angles::<3>();
    for (q, _) in &mut states {
        q[1] = core::f64::consts::FRAC_PI_2 + q[1] * (0.5 - 0.4 / core::f64::consts::PI);
    }
    states
}
