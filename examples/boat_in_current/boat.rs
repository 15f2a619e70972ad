//! The boat: a scene with a stream, and the same boat in still water written out by hand.

use gauss_runtime::prelude::*;

/// A boat from above: k₁ north, k₂ east, k₃ down; body axes forward, starboard, down.
///
/// The stream is `stream + tide sin(frequency t)`. Gravity does nothing in the plane; it comes with the displaced mass.
#[derive(Clone, Copy, Debug, GaussDynamics)]
#[gauss(
    chart = left_invariant,
    motion = planar,
    input(thrust, turn),
    medium(velocity = stream + tide * sin(frequency * t)),
    define(v = body.relative_velocity, w = body.body_angular_velocity),
    drag(hull, linear = linear, quadratic = quadratic),
    wrench(
        cross_drag,
        force = [xuuu * v.x.powi(3), yrv * abs(w.z) * v.y + yvr * abs(v.y) * w.z, 0],
        torque = [0, 0, nrv * abs(w.z) * v.y + nvr * abs(v.y) * w.z],
    ),
    wrench(propellers, force = [thrust, 0, 0], torque = [0, 0, turn]),
)]
pub struct Boat {
    /// kg.
    #[gauss(mass)]
    pub mass: f64,
    /// G from O, m.
    #[gauss(center_of_mass)]
    pub center: Vector3<f64>,
    /// About the vertical axis through O, kg m².
    #[gauss(inertia)]
    pub inertia: f64,
    /// In the order (u, ω), pole O; kg, kg m².
    #[gauss(added_mass)]
    pub added: Vector6<f64>,
    /// Mass of the displaced water, kg: afloat, it is that of the boat.
    #[gauss(displaced_mass)]
    pub displaced: f64,
    /// Afloat and upright, it is under or over G.
    #[gauss(center_of_buoyancy)]
    pub buoyancy: Vector3<f64>,
    #[gauss(gravity)]
    pub gravity: Vector3<f64>,
    /// −Σ D_ij V_j in the order (u, ω).
    pub linear: Matrix6<f64>,
    /// −Σ D_ij |V_j| V_j.
    pub quadratic: Matrix6<f64>,
    pub xuuu: f64,
    pub yrv: f64,
    pub yvr: f64,
    pub nrv: f64,
    pub nvr: f64,
    /// m/s, observer's axes.
    pub stream: Vector3<f64>,
    /// m/s, observer's axes, and rad/s.
    pub tide: Vector3<f64>,
    pub frequency: f64,
}

impl Boat {
    /// CyberShip II, a model of a supply ship of 1.255 m, in still water: R. Skjetne, Ø. Smogeli and T. I. Fossen, *A
    /// nonlinear ship manoeuvering model: identification and adaptive control with experiments for a model ship*,
    /// Modeling, Identification and Control 25 (2004), tables 1, 2 and 4.
    pub fn cyber_ship() -> Self {
        let center = Vector3::new(0.046, 0.0, 0.0);
        let (mut linear, mut quadratic) = (Matrix6::zeros(), Matrix6::zeros());
        for (row, column, once, twice) in [
            (0, 0, 0.72253, 1.32742),
            (1, 1, 0.88965, 36.47287),
            (1, 5, 7.250, 3.450),
            (5, 1, -0.03130, -3.95645),
            (5, 5, 1.900, 0.750),
        ] {
            (linear[(row, column)], quadratic[(row, column)]) = (once, twice);
        }
        Self {
            mass: 23.8,
            center,
            inertia: 1.76,
            added: Vector6::new(2.0, 10.0, 0.0, 0.0, 0.0, 1.0),
            displaced: 23.8,
            buoyancy: center,
            gravity: Vector3::new(0.0, 0.0, 9.81),
            linear,
            quadratic,
            xuuu: -5.86643,
            yrv: -0.805,
            yvr: -0.845,
            nrv: 0.130,
            nvr: 0.080,
            stream: Vector3::zeros(),
            tide: Vector3::zeros(),
            frequency: 0.0,
        }
    }

    /// The thrust that drives it straight on through the water at a speed.
    pub fn thrust(&self, speed: f64) -> f64 {
        ((-self.xuuu * speed + self.quadratic[(0, 0)]) * speed + self.linear[(0, 0)]) * speed
    }

    /// How far the water has gone since t = 0, m, observer's axes.
    pub fn drift(&self, t: f64) -> Vector3<f64> {
        let swing = if self.frequency == 0.0 { 0.0 } else { (1.0 - (self.frequency * t).cos()) / self.frequency };
        self.stream * t + self.tide * swing
    }
}

/// (x, y, ψ, u, v, r) of CyberShip II in still water over time, from rest with a start heading, as in the paper:
/// `M ν̇ + C(ν) ν + D(ν) ν = τ`, by the classical Runge–Kutta method. Given at every whole second.
pub fn in_still_water(heading: f64, tau: impl Fn(f64, f64) -> [f64; 2], seconds: u32, steps: u32) -> Vec<[f64; 6]> {
    let rate = |t: f64, s: &SVector<f64, 6>| {
        let [_, _, psi, u, v, r]: [f64; 6] = (*s).into();
        let [thrust, turn] = tau(t, psi);
        let (m11, m22, m23, m33) = (23.8 + 2.0, 23.8 + 10.0, 23.8 * 0.046, 1.76 + 1.0);
        let (c13, c23) = (-m22 * v - m23 * r, m11 * u);
        let d11 = 0.72253 + 1.32742 * u.abs() + 5.86643 * u * u;
        let (d22, d23) = (0.88965 + 36.47287 * v.abs() + 0.805 * r.abs(), 7.250 + 0.845 * v.abs() + 3.450 * r.abs());
        let (d32, d33) = (-0.03130 - 3.95645 * v.abs() - 0.130 * r.abs(), 1.900 - 0.080 * v.abs() + 0.750 * r.abs());
        let surge = thrust - c13 * r - d11 * u;
        let sway = -c23 * r - d22 * v - d23 * r;
        let yaw = turn + c13 * u + c23 * v - d32 * v - d33 * r;
        let determinant = m22 * m33 - m23 * m23;
        let (sin, cos) = psi.sin_cos();
        SVector::from([
            cos * u - sin * v,
            sin * u + cos * v,
            r,
            surge / m11,
            (m33 * sway - m23 * yaw) / determinant,
            (m22 * yaw - m23 * sway) / determinant,
        ])
    };
    let mut state = SVector::<f64, 6>::from([0.0, 0.0, heading, 0.0, 0.0, 0.0]);
    let mut states = vec![state.into()];
    let h = 1.0 / f64::from(steps);
    for n in 0..seconds * steps {
        let t = h * f64::from(n);
        let k1 = rate(t, &state);
        let k2 = rate(t + 0.5 * h, &(state + k1 * (0.5 * h)));
        let k3 = rate(t + 0.5 * h, &(state + k2 * (0.5 * h)));
        let k4 = rate(t + h, &(state + k3 * h));
        state += (k1 + (k2 + k3) * 2.0 + k4) * (h / 6.0);
        if (n + 1) % steps == 0 {
            states.push(state.into());
        }
    }
    states
}

/// Thrust and turning torque of a winding course; the heading is steered, the place and the speed are not looked at.
pub fn winding(t: f64, heading: f64) -> [f64; 2] {
    [0.9 + 0.4 * (0.21 * t).sin(), -0.8 * (heading - 1.2 * (0.13 * t).sin())]
}
