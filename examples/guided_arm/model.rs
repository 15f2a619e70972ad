//! An arm from its file, the way that it is to follow, and two laws that keep it there.

use gauss_runtime::prelude::*;

/// An arm with two fingers, each joint with an effort.
#[derive(GaussDynamics)]
#[gauss(
    urdf = "../tests/robots/panda.urdf",
    gravity = 9.81,
    linearize,
    frames(
        base_link,
        panda_joint1_link,
        panda_joint2_link,
        panda_joint3_link,
        panda_joint4_link,
        panda_joint5_link,
        panda_joint6_link,
        panda_joint7_link,
        panda_finger_joint1_link,
        panda_finger_joint2_link,
    )
)]
pub struct Arm;

pub type Joints = SVector<f64, 9>;
pub type State = SVector<f64, 18>;
pub type Square = SMatrix<f64, 18, 18>;
pub type Gains = SMatrix<f64, 9, 18>;

/// Where the joints are to be, with rates and accelerations: sines about a bent arm, fingers open and close.
pub fn wanted(t: f64) -> [Joints; 3] {
    let middle = Joints::from([0.0, -0.4, 0.0, -1.8, 0.0, 1.6, 0.8, 0.02, 0.02]);
    let size = |k: usize| if k < 7 { 0.5 } else { 0.01 };
    let rate = |k: usize| 1.0 + 0.3 * k as f64;
    [
        middle + Joints::from_fn(|k, _| size(k) * (rate(k) * t).sin()),
        Joints::from_fn(|k, _| size(k) * rate(k) * (rate(k) * t).cos()),
        Joints::from_fn(|k, _| -size(k) * rate(k) * rate(k) * (rate(k) * t).sin()),
    ]
}

/// What moves it along the way, were it there: the inverse dynamics of the way.
pub fn nominal(arm: &ArmKernel, t: f64) -> Joints {
    let [place, rate, acceleration] = wanted(t);
    arm.inverse_dynamics(t, &place, &rate, &acceleration, &Joints::zeros())
}

/// How far from the way a state is.
pub fn error(t: f64, q: &Joints, z: &Joints) -> State {
    let [place, rate, _] = wanted(t);
    State::from_fn(|k, _| if k < 9 { q[k] - place[k] } else { z[k - 9] - rate[k - 9] })
}

/// 1/s: errors die like e^(−s t).
pub const GAIN: f64 = 20.0;

/// Computed torque: the inverse dynamics at the acceleration that is wanted, errors of place and rate fed back, so that
/// these obey `ë + 2 s ė + s² e = 0`.
pub fn computed_torque(arm: &ArmKernel, t: f64, q: &Joints, z: &Joints) -> Joints {
    let [place, rate, acceleration] = wanted(t);
    let asked = acceleration + (rate - z) * (2.0 * GAIN) + (place - q) * (GAIN * GAIN);
    arm.inverse_dynamics(t, q, z, &asked, &Joints::zeros())
}

/// What errors e and efforts δu beyond the nominal ones cost: ∫ (eᵀ Q e + |A⁻¹ δu|²) dt, and eᵀ F e at the end, with
/// the mass matrix A where the arm should be: efforts cost the square of what they accelerate. Q and F are diagonal.
pub struct Cost {
    pub error: State,
    pub at_the_end: State,
}

impl Cost {
    /// With which errors die about as fast as with [`GAIN`].
    pub fn new() -> Cost {
        let error = State::from_fn(|k, _| if k < 9 { GAIN.powi(4) } else { GAIN * GAIN });
        Cost { error, at_the_end: error / GAIN }
    }

    pub fn rate(&self, arm: &ArmKernel, t: f64, error: &State, efforts: &Joints) -> f64 {
        let beyond = arm.mass_matrix(t, &wanted(t)[0]).lu().solve(&(efforts - nominal(arm, t)));
        error.component_mul(&self.error).dot(error) + beyond.map_or(f64::NAN, |beyond| beyond.norm_squared())
    }
}

/// The linear–quadratic regulator along the way: δu = −K(t) e, K from `−Ṗ = AᵀP + PA − P B R⁻¹ Bᵀ P + Q`, backward from
/// P = F, with the exact derivatives of the equations on the way.
pub struct Regulator {
    gains: Vec<Gains>,
    /// s, between two of them.
    step: f64,
    /// eᵀ P e is what an error at the start costs in the end, to second order.
    pub at_start: Square,
}

impl Regulator {
    pub fn new(arm: &ArmKernel, cost: &Cost, end: f64, steps: usize) -> Regulator {
        let h = end / steps as f64;
        // A, and B R⁻¹ Bᵀ = 1 of the rates, K = R⁻¹ Bᵀ P = (mass matrix) (lower half of P).
        let along = |t: f64| arm.linearize(t, &wanted(t)[0], &wanted(t)[1], &nominal(arm, t)).by_state;
        let gain = |t: f64, p: &Square| arm.mass_matrix(t, &wanted(t)[0]) * p.fixed_rows::<9>(9);
        let slope = |a: &Square, p: &Square| {
            let (pa, right) = (p * a, p.fixed_columns::<9>(9));
            pa + pa.transpose() - right * right.transpose() + Square::from_diagonal(&cost.error)
        };
        let mut p = Square::from_diagonal(&cost.at_the_end);
        let (mut gains, mut later) = (vec![gain(end, &p)], along(end));
        for k in (0..steps).rev() {
            let t = k as f64 * h;
            let (middle, now) = (along(t + 0.5 * h), along(t));
            let first = slope(&later, &p);
            let second = slope(&middle, &(p + first * (0.5 * h)));
            let third = slope(&middle, &(p + second * (0.5 * h)));
            let fourth = slope(&now, &(p + third * h));
            p += (first + (second + third) * 2.0 + fourth) * (h / 6.0);
            gains.push(gain(t, &p));
            later = now;
        }
        gains.reverse();
        Regulator { gains, step: h, at_start: p }
    }

    /// Between two gains a part of each.
    pub fn efforts(&self, arm: &ArmKernel, t: f64, q: &Joints, z: &Joints) -> Joints {
        let place = (t / self.step).clamp(0.0, (self.gains.len() - 1) as f64);
        let before = (place as usize).min(self.gains.len() - 2);
        let part = place - before as f64;
        let gain = self.gains[before] * (1.0 - part) + self.gains[before + 1] * part;
        nominal(arm, t) - gain * error(t, q, z)
    }
}
