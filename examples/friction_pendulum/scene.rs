//! What is modelled, and what is known about it without any integrator.

use std::f64::consts::PI;

use gauss_runtime::prelude::*;

/// A rod that hangs from a pivot with dry friction, a spiral spring, and a rubber buffer on one side.
///
/// The friction is M v/√(v² + ε²): within 1 ‰ of M above 23 ε, and smooth at rest, where it creeps instead of sticking:
/// as long as a torque τ < M pulls, at ε τ/√(M² − τ²).
#[derive(GaussDynamics)]
#[gauss(
    coordinates(theta),
    frames(rod),
    body(rod, rotation = rotation_y(theta)),
    drive(friction, theta = -dry * rate(theta) / hypot(rate(theta), creep)),
    spring(spiral, along = theta, stiffness = spiral, length = relaxed),
    stop(buffer, along = theta, least = limit, stiffness = rubber, width = soft, damping = loss),
)]
pub struct Pendulum {
    /// O is the pivot.
    #[gauss(body)]
    pub rod: RigidBody<f64>,
    /// M, N m.
    pub dry: f64,
    /// ε, rad/s.
    pub creep: f64,
    /// Stiffness of the spiral spring, N m/rad.
    pub spiral: f64,
    /// Angle at which it is without torque, rad.
    pub relaxed: f64,
    /// Angle of the buffer, rad.
    pub limit: f64,
    /// Its stiffness, N m/rad.
    pub rubber: f64,
    /// Angle over which it sets in, rad.
    pub soft: f64,
    /// Its damping, N m s/rad.
    pub loss: f64,
    #[gauss(gravity)]
    pub g: f64,
}

/// Length of the rod, m.
pub const LENGTH: f64 = 0.5;

impl Pendulum {
    /// A uniform rod of 0.2 kg: a desk model.
    #[must_use]
    pub fn desk() -> Self {
        let (mass, length) = (0.2, LENGTH);
        let rod = RigidBody {
            mass,
            center_of_mass: Vector3::new(0.0, 0.0, -0.5 * length),
            inertia: Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 0.0)) * (mass * length * length / 3.0),
        };
        let friction = (0.015, 1e-3);
        Self {
            rod,
            dry: friction.0,
            creep: friction.1,
            spiral: 0.08,
            relaxed: 0.4,
            limit: -0.5,
            rubber: 30.0,
            soft: 0.01,
            loss: 0.05,
            g: 9.81,
        }
    }
}

/// A mass on a spring on a floor with Coulomb's friction: the force jumps with the direction of sliding.
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(
    coordinates(x),
    particle(mass = m, position = [x, 0, 0]),
    spring(coil, along = x, stiffness = k),
    drive(friction, x = -f * signum(rate(x))),
)]
pub struct Slider {
    /// kg.
    pub m: f64,
    /// N/m.
    pub k: f64,
    /// N.
    pub f: f64,
}

/// The same with the friction made smooth over the speed `creep`.
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(
    coordinates(x),
    particle(mass = m, position = [x, 0, 0]),
    spring(coil, along = x, stiffness = k),
    drive(friction, x = -f * rate(x) / hypot(rate(x), creep)),
)]
pub struct SmoothSlider {
    /// kg.
    pub m: f64,
    /// N/m.
    pub k: f64,
    /// N.
    pub f: f64,
    /// m/s.
    pub creep: f64,
}

/// Where the slider is let go, in units of f/k: it turns ten times, the last time at half a unit, where it sticks.
const RELEASED: f64 = 19.5;
/// Half swings until then.
const SWINGS: f64 = 10.0;

impl Slider {
    /// ω = 10 /s, f/k = 5 mm.
    #[must_use]
    pub fn desk() -> Self {
        Self { m: 0.4, k: 40.0, f: 0.2 }
    }

    /// Where it is let go, m.
    #[must_use]
    pub fn released(&self) -> f64 {
        RELEASED * self.f / self.k
    }

    /// When it comes to rest, s.
    #[must_use]
    pub fn rests(&self) -> f64 {
        SWINGS * PI * (self.m / self.k).sqrt()
    }

    /// The exact position, m: each half swing is a half of a cosine about ±f/k, and so takes 2f/k from the amplitude
    /// (any textbook of vibrations). At rest the spring is weaker than the friction.
    #[must_use]
    pub fn exact(&self, t: f64) -> f64 {
        let half_period = PI * (self.m / self.k).sqrt();
        let swing = (t / half_period).floor().min(SWINGS);
        let sign = if swing % 2.0 == 0.0 { 1.0 } else { -1.0 };
        let turned = sign * (RELEASED - 2.0 * swing);
        let phase = PI * (t / half_period - swing);
        let units = if swing == SWINGS { turned } else { sign + (turned - sign) * phase.cos() };
        units * self.f / self.k
    }

    /// The slider with smooth friction.
    #[must_use]
    pub fn smooth(&self, creep: f64) -> SmoothSlider {
        let Self { m, k, f } = *self;
        SmoothSlider { m, k, f, creep }
    }
}
