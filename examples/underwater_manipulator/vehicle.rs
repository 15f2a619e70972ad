//! A remotely operated vehicle with an arm of two joints in a current: the scene, and its parameters.

use std::f64::consts::PI;

use gauss_runtime::prelude::*;

/// kg/m³ and m/s²: fresh water and gravity as in the published model of the vehicle.
pub const WATER: f64 = 1000.0;
pub const GRAVITY: f64 = 9.82;
/// The links of the arm: length and radius, m.
pub const LINK: f64 = 0.3;
const RADIUS: f64 = 0.03;
/// The shoulder from O of the hull, hull's axes, m: under the bow.
pub const SHOULDER: [f64; 3] = [0.25, 0.0, 0.12];

/// k₁ north, k₂ east, k₃ down; hull's axes forward, starboard, down, O in its centre of mass.
///
/// The shoulder yaws about e₃ of the hull, the elbow pitches about e₂ of the upper arm. O of each link is in its
/// middle, where its mass, its fluid and its drag are symmetric; e₁ runs along it. All three bodies carry fluid along,
/// weigh, float and are dragged, each relative to the current.
#[derive(Clone, Copy, Debug, GaussDynamics)]
#[gauss(
    chart = left_invariant,
    coordinates(shoulder, elbow),
    input(yaw_torque, pitch_torque),
    // ANCHOR: arm
    medium(velocity = current),
    drag(hull, linear = linear, quadratic = quadratic),
    frame(turret, parent = body, position = mount, rotation = rotation_z(shoulder)),
    body(
        upper, parent = turret, position = [length / 2, 0, 0],
        mass = link_mass, inertia = [along, across, across],
        added_mass = [0, link_added, link_added, 0, link_turning, link_turning], displaced_mass = link_displaced,
    ),
    frame(joint, parent = turret, position = [length, 0, 0], rotation = rotation_y(elbow)),
    body(
        fore, parent = joint, position = [length / 2, 0, 0],
        mass = link_mass, inertia = [along, across, across],
        added_mass = [0, link_added, link_added, 0, link_turning, link_turning], displaced_mass = link_displaced,
    ),
    drag(upper_arm, body = upper, quadratic = [0, link_drag, link_drag, 0, link_swirl, link_swirl]),
    drag(forearm, body = fore, quadratic = [0, link_drag, link_drag, 0, link_swirl, link_swirl]),
    // ANCHOR_END: arm
    drive(motors, shoulder = yaw_torque, elbow = pitch_torque),
)]
pub struct Vehicle {
    /// kg.
    #[gauss(mass)]
    pub mass: f64,
    /// Principal, about O = G, kg m².
    #[gauss(inertia)]
    pub inertia: Vector3<f64>,
    /// In the order (u, ω), pole O; kg, kg m².
    #[gauss(added_mass)]
    pub added: Vector6<f64>,
    /// Mass of the water that the hull displaces, kg.
    #[gauss(displaced_mass)]
    pub displaced: f64,
    /// Centre of buoyancy from O, m: above G.
    #[gauss(center_of_buoyancy)]
    pub buoyancy: Vector3<f64>,
    /// Observer's axes, m/s².
    #[gauss(gravity)]
    pub gravity: Vector3<f64>,
    /// Drag of the hull, −D_i V_i and −D_i |V_i| V_i in the order (u, ω).
    pub linear: Vector6<f64>,
    pub quadratic: Vector6<f64>,
    /// m/s, observer's axes.
    pub current: Vector3<f64>,
    /// From O of the hull to the shoulder, m.
    pub mount: Vector3<f64>,
    /// Of each link: length, m; mass and displaced water, kg; moments about its middle, kg m².
    pub length: f64,
    pub link_mass: f64,
    pub link_displaced: f64,
    pub along: f64,
    pub across: f64,
    /// Water that a link carries along across its axis, kg, and in turning, kg m².
    pub link_added: f64,
    pub link_turning: f64,
    /// Drag of a link across its axis, kg/m, and in turning, kg m².
    pub link_drag: f64,
    pub link_swirl: f64,
}

impl Vehicle {
    /// The hull is the BlueROV2 Heavy as identified by M. von Benzon, F. F. Sørensen, E. Uth, J. Jouffroy, J. Liniger
    /// and S. Pedersen, *An open-source benchmark simulator: control of a BlueROV2 underwater robot*, Journal of Marine
    /// Science and Engineering 10 (2022), 1898, table A1. The links are round tubes of the density of 1.2 of water;
    /// slender-body theory gives their water, `ρπr²` for each metre across the axis (J. N. Newman, *Marine
    /// Hydrodynamics*, 1977, section 4.17), and cross-flow their drag, with a coefficient of 1.1. The hull is trimmed:
    /// with the arm it weighs what it displaces.
    pub fn bluerov2() -> Self {
        let section = PI * RADIUS * RADIUS;
        let (link_displaced, link_mass) = (WATER * section * LINK, 1.2 * WATER * section * LINK);
        let link_drag = 0.5 * WATER * 1.1 * 2.0 * RADIUS * LINK;
        let mass = 13.5;
        Self {
            mass,
            inertia: Vector3::new(0.26, 0.23, 0.37),
            added: Vector6::new(6.36, 7.12, 18.68, 0.189, 0.135, 0.222),
            displaced: mass + 2.0 * (link_mass - link_displaced),
            buoyancy: Vector3::new(0.0, 0.0, -0.01),
            gravity: Vector3::new(0.0, 0.0, GRAVITY),
            linear: Vector6::new(13.7, 0.0, 33.0, 0.0, 0.8, 0.0),
            quadratic: Vector6::new(141.0, 217.0, 190.0, 1.19, 0.47, 1.5),
            current: Vector3::zeros(),
            mount: Vector3::from(SHOULDER),
            length: LINK,
            link_mass,
            link_displaced,
            along: 0.5 * link_mass * RADIUS * RADIUS,
            across: link_mass * (LINK * LINK / 12.0 + 0.25 * RADIUS * RADIUS),
            link_added: WATER * section * LINK,
            link_turning: WATER * section * LINK.powi(3) / 12.0,
            link_drag,
            // ∫ ½ρ c 2r |x|³ dx over the length.
            link_swirl: link_drag * LINK.powi(3) / 32.0,
        }
    }

    /// The same arm in air, as simulators of robots have it: no water is carried along by the links.
    pub fn with_dry_arm(self) -> Self {
        Self { link_added: 0.0, link_turning: 0.0, ..self }
    }
}

/// Configuration of the kernel: pose of the hull, angles of the joints.
pub type Place = (Isometry3<f64>, SVector<f64, 2>);
/// Twist of the hull in its axes, pole O, then the rates of the joints.
pub type Speeds = SVector<f64, 8>;

/// Joint torques, N m, that reach for angles over four seconds and hold them.
pub fn reach(t: f64, q: &Place, z: &Speeds) -> SVector<f64, 2> {
    let part = (t / 4.0).clamp(0.0, 1.0);
    let smooth = part * part * (3.0 - 2.0 * part);
    let target = SVector::from([1.2, -1.1]) * smooth;
    let rates = SVector::from([z[6], z[7]]);
    (target - q.1) * 20.0 - rates * 6.0
}
