//! A Crazyflie 2.0: airframe, rotors, air, and who flies it.

use gauss_runtime::prelude::*;

/// A quadrotor in wind. O is the centre of mass, e₁ points forward, e₂ to the left, e₃ up along the rotors' axes.
///
/// What acts, beside its weight: the lift `k n²` of each rotor at its hub, the torques of the air on the blades about
/// e₃, the drag of the turning blades, linear in the air speed and proportional to the sum of the rotors' speeds, and
/// the drag of the airframe, quadratic in the air speed.
#[derive(GaussDynamics)]
#[gauss(
    chart = hybrid,
    input(n1, n2, n3, n4),
    define(air = body.relative_velocity, turns = n1 + n2 + n3 + n4),
    medium(velocity = gust * exp(-((t - gust_time) / gust_length).powi(2))),
    force(front_right, at = [a, -a, 0], value = [0, 0, k * n1 * n1]),
    force(back_right, at = [-a, -a, 0], value = [0, 0, k * n2 * n2]),
    force(back_left, at = [-a, a, 0], value = [0, 0, k * n3 * n3]),
    force(front_left, at = [a, a, 0], value = [0, 0, k * n4 * n4]),
    torque(blades, value = [0, 0, torque_ratio * k * (n2 * n2 + n4 * n4 - n1 * n1 - n3 * n3)]),
    force(
        blade_drag,
        at = [0, 0, 0],
        value = [-blade_xy * turns * air.x, -blade_xy * turns * air.y, -blade_z * turns * air.z],
    ),
    drag(airframe, quadratic = [frame_xy, frame_xy, frame_z, 0, 0, 0]),
)]
#[derive(Clone, Copy, Debug)]
pub struct Quadrotor {
    /// kg.
    #[gauss(mass)]
    pub mass: f64,
    /// Principal, about O, kg m².
    #[gauss(inertia)]
    pub inertia: Vector3<f64>,
    /// m/s².
    #[gauss(gravity)]
    pub g: f64,
    /// The rotors are at (±a, ±a, 0), m.
    pub a: f64,
    /// Lift over speed squared, N s²/rad².
    pub k: f64,
    /// Torque of the air on a rotor over its lift, m.
    pub torque_ratio: f64,
    /// Drag of the blades over air speed and the sum of the rotors' speeds, across their axes, kg/rad.
    pub blade_xy: f64,
    /// The same along their axes, kg/rad.
    pub blade_z: f64,
    /// Drag of the airframe over air speed squared, across e₃, kg/m.
    pub frame_xy: f64,
    /// The same along e₃, kg/m.
    pub frame_z: f64,
    /// Velocity of the wind at the peak of the gust, observer axes, m/s.
    pub gust: Vector3<f64>,
    /// When it is strongest, s.
    pub gust_time: f64,
    /// How long it takes to fall to 1/e, s.
    pub gust_length: f64,
}

impl Quadrotor {
    /// The Crazyflie 2.0 as J. Förster identified it (System Identification of the Crazyflie 2.0 Nano Quadrocopter, ETH
    /// Zürich, 2015, doi 10.3929/ethz-b-000214143). Lift and speed of a rotor are functions of one command there; `k`
    /// is lift over speed squared at hover. The drag of the airframe is an estimate: the coefficients are those of the
    /// Crazyflie in RotorPy (S. Folk, J. Paulos, V. Kumar, arXiv:2306.04485, 2023), here component by component, there
    /// times the whole air speed. A gust of 5 m/s to the left.
    pub fn crazyflie() -> Self {
        // Speed in rad/s and lift in N of one rotor at a command.
        let speed = |command: f64| 0.040_765_21 * command + 380.8359;
        let lift = |command: f64| 2.130_295e-11 * command * command + 1.032_633e-6 * command + 5.484_560e-4;
        let (mass, g) = (0.027, 9.81);
        let (half, quarter_weight): (f64, f64) = (1.032_633e-6 / 2.0, mass * g / 4.0);
        let root = (half * half - 2.130_295e-11 * (5.484_560e-4 - quarter_weight)).sqrt();
        let hover = (root - half) / 2.130_295e-11;
        Self {
            mass,
            inertia: Vector3::new(16.571_710e-6, 16.655_602e-6, 29.261_652e-6),
            g,
            a: 0.046 * std::f64::consts::FRAC_1_SQRT_2,
            k: lift(hover) / speed(hover).powi(2),
            torque_ratio: 0.005_964_552,
            blade_xy: 9.1785e-7,
            blade_z: 10.311e-7,
            frame_xy: 5e-3,
            frame_z: 1e-2,
            gust: Vector3::new(0.0, 5.0, 0.0),
            gust_time: 8.4,
            gust_length: 0.4,
        }
    }

    /// The speed at which four rotors carry the weight in air at rest, rad/s.
    pub fn hover_speed(&self) -> f64 {
        (self.mass * self.g / (4.0 * self.k)).sqrt()
    }
}

/// Position, velocity, acceleration, observer axes; m, s.
pub struct Wanted {
    pub position: Vector3<f64>,
    pub velocity: Vector3<f64>,
    pub acceleration: Vector3<f64>,
}

/// The path: two seconds of climb by 1 m, then figures of eight, 3 m long, 1.5 m wide, with 1.2 rad/s after two
/// seconds.
pub fn wanted(t: f64) -> Wanted {
    // s⁵ polynomial from rest to rest, and its derivatives by time.
    let s = (t / 2.0).clamp(0.0, 1.0);
    let height = s.powi(3) * (10.0 - 15.0 * s + 6.0 * s * s);
    let climb = 30.0 * s * s * (1.0 - s).powi(2) / 2.0;
    let lift = 60.0 * s * (1.0 - s) * (1.0 - 2.0 * s) / 4.0;

    // Phase of the eight: its rate grows as 3s² − 2s³.
    let (rate, ramp) = (1.2, 2.0);
    let s = ((t - 2.0) / ramp).clamp(0.0, 1.0);
    let phase = rate * (ramp * (s.powi(3) - 0.5 * s.powi(4)) + (t - 2.0 - ramp).max(0.0));
    let first = rate * s * s * (3.0 - 2.0 * s);
    let second = rate * 6.0 * s * (1.0 - s) / ramp;
    let along = |size: f64, times: f64| {
        let (sin, cos) = (times * phase).sin_cos();
        let slope = size * times * cos;
        (size * sin, slope * first, slope * second - size * times * times * sin * first * first)
    };
    let ((x, vx, ax), (y, vy, ay)) = (along(1.5, 1.0), along(0.75, 2.0));
    Wanted {
        position: Vector3::new(x, y, height),
        velocity: Vector3::new(vx, vy, climb),
        acceleration: Vector3::new(ax, ay, lift),
    }
}

/// What a pilot knows: where the craft is and how it moves. Position and velocity in observer axes, ω in body axes.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    pub position: Vector3<f64>,
    pub velocity: Vector3<f64>,
    pub rotation: Matrix3<f64>,
    pub omega: Vector3<f64>,
}

/// The geometric controller of T. Lee, M. Leok and N. H. McClamroch (Geometric Tracking Control of a Quadrotor UAV on
/// SE(3), CDC 2010), e₁ as far north as it can be, without feeding the wanted angular velocity forward. It does not
/// know the wind. Gives the four speeds, rad/s.
pub fn pilot(craft: &Quadrotor, t: f64, seen: &Seen) -> [f64; 4] {
    /// Natural frequencies of position and attitude, rad/s, and the damping ratio of both.
    const POSITION: f64 = 4.0;
    const ATTITUDE: f64 = 25.0;
    const DAMPING: f64 = 0.9;
    /// The most that a rotor lifts, N: Förster's map at full command.
    const MOST: f64 = 0.16;

    let goal = wanted(t);
    let up = Vector3::z() * craft.g;
    let pull = (goal.position - seen.position) * POSITION.powi(2)
        + (goal.velocity - seen.velocity) * (2.0 * DAMPING * POSITION)
        + goal.acceleration
        + up;
    let lift = craft.mass * pull.dot(&seen.rotation.column(2));

    // The attitude with e₃ along the pull and e₁ over k₁.
    let e3 = pull.normalize();
    let e2 = e3.cross(&Vector3::x()).normalize();
    let attitude = Matrix3::from_columns(&[e2.cross(&e3), e2, e3]);
    let skew = attitude.transpose() * seen.rotation - seen.rotation.transpose() * attitude;
    let error = Vector3::new(skew[(2, 1)], skew[(0, 2)], skew[(1, 0)]) * 0.5;
    let turn = error * -ATTITUDE.powi(2) - seen.omega * (2.0 * DAMPING * ATTITUDE);
    let momentum = craft.inertia.component_mul(&seen.omega);
    let torque = craft.inertia.component_mul(&turn) + seen.omega.cross(&momentum);

    // Lift of each rotor: four equations for lift and torque.
    let (x, y, z) = (torque.x / craft.a, torque.y / craft.a, torque.z / craft.torque_ratio);
    let lifts = [lift - x - y - z, lift - x + y + z, lift + x + y - z, lift + x - y + z];
    lifts.map(|four| ((0.25 * four).clamp(0.0, MOST) / craft.k).sqrt())
}
