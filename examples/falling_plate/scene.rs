//! A plate that falls edge over edge in a fluid: an elliptic cylinder, per length of its axis, which stays level.
//!
//! The forces are those of Andersen, Pesavento & Wang, "Analysis of transitions between fluttering, tumbling and steady
//! descent of falling cards", J. Fluid Mech. 541 (2005) 91–104: added mass, weight, buoyancy, lift by a circulation ∝
//! velocity and rotation, drag, and a torque that resists the rotation. Units: half-width a = 1, density of the fluid ρ
//! = 1, and the speed U = √((m − m_displaced) g/(π ρ a)) = 1, so that what remains of the weight is π.

use std::f64::consts::PI;

use gauss_runtime::prelude::*;

/// The plate with all forces; e₁ along the plate, e₂ across, k₂ up.
#[derive(Clone, GaussDynamics)]
#[gauss(
    chart = left_invariant,
    motion = planar,
    define(
        along = body.body_velocity.x,
        across = body.body_velocity.y,
        spin = body.body_angular_velocity.z,
        speed = hypot(along, across),
        circulation = 2 * (c_r * spin - c_t * along * across / speed),
        resistance = a * speed - b * (along * along - across * across) / speed,
    ),
    force(lift, body = body, value = [-circulation * across, circulation * along, 0]),
    force(drag, body = body, value = [-resistance * along, -resistance * across, 0]),
    torque(braking, body = body, value = [0, 0, -damping * (1 + abs(spin)) * spin]),
)]
pub struct Plate {
    #[gauss(mass)]
    pub mass: f64,
    #[gauss(inertia)]
    pub inertia: f64,
    #[gauss(added_mass)]
    pub added: Vector6<f64>,
    #[gauss(gravity)]
    pub g: f64,
    #[gauss(displaced_mass)]
    pub displaced: f64,
    /// Lift by velocity, C_T, and by rotation, C_R.
    pub c_t: f64,
    pub c_r: f64,
    /// Drag: A − B cos 2α at the angle of attack α.
    pub a: f64,
    pub b: f64,
    /// π μ, with μ₁ = μ₂ = μ.
    pub damping: f64,
}

/// The same plate in an ideal fluid.
#[derive(Clone, GaussDynamics)]
#[gauss(chart = left_invariant, motion = planar)]
pub struct IdealPlate {
    #[gauss(mass)]
    pub mass: f64,
    #[gauss(inertia)]
    pub inertia: f64,
    #[gauss(added_mass)]
    pub added: Vector6<f64>,
    #[gauss(gravity)]
    pub g: f64,
    #[gauss(displaced_mass)]
    pub displaced: f64,
}

/// Thickness over width of the plates of the paper.
pub const THICKNESS: f64 = 1.0 / 14.0;

/// The added mass of an elliptic cylinder with half-axes a = 1 (along e₁) and b in a fluid of density 1, per length: π
/// b² along, π a² across, π (a² − b²)²/8 about its axis (Lamb, Hydrodynamics, § 71). In the plane the other three do
/// not act.
#[must_use]
pub fn added_mass(b: f64) -> Vector6<f64> {
    Vector6::new(b * b, 1.0, 0.0, 0.0, 0.0, 0.125 * (1.0 - b * b).powi(2)) * PI
}

impl IdealPlate {
    /// The plate with a given I* = (b/a) ρ_plate/ρ and b/a = [`THICKNESS`].
    #[must_use]
    pub fn new(ratio: f64) -> Self {
        let b = THICKNESS;
        let mass = PI * ratio;
        Self {
            mass,
            inertia: 0.25 * mass * (1.0 + b * b),
            added: added_mass(b),
            g: 1.0 / (ratio - b),
            displaced: PI * b,
        }
    }
}

impl Plate {
    /// The plate with a given I*, and the coefficients of the paper.
    #[must_use]
    pub fn new(ratio: f64) -> Self {
        let IdealPlate { mass, inertia, added, g, displaced } = IdealPlate::new(ratio);
        Self { mass, inertia, added, g, displaced, c_t: 1.2, c_r: PI, a: 1.4, b: 1.0, damping: 0.2 * PI }
    }
}

/// I* of a plate that flutters, and of one that tumbles: between 1.2 and 1.3 one turns into the other.
pub const FLUTTERING: f64 = 1.1;
/// See [`FLUTTERING`].
pub const TUMBLING: f64 = 1.4;

/// Let go 17° from level, so slowly that it is as good as at rest: the angle of attack has to have a value.
#[must_use]
pub fn released() -> (Isometry2<f64>, Vector3<f64>) {
    (Isometry2::rotation(0.3), Vector3::new(0.01, -0.01, 0.0))
}

/// The angle of the plate over a run, rad, counted through whole turns, and where it is.
#[must_use]
pub fn places<S>(path: &Trajectory<S>) -> Vec<(f64, [f64; 3])>
where
    S: GaussSystem<Scalar = f64, Configuration = Isometry2<f64>>,
{
    let mut angle = path.first().q.rotation.angle();
    let place = |s: &Sample<S>| {
        let turned = s.q.rotation.angle() - angle;
        angle += turned - 2.0 * PI * (turned / (2.0 * PI)).round();
        (s.t, [s.q.translation.x, s.q.translation.y, angle])
    };
    path.iter().map(place).collect()
}
