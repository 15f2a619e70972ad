//! A small satellite in the field of the Earth, and the same one with a reaction wheel far from everything.

use gauss_runtime::prelude::*;

/// A 6U CubeSat at its full mass, uniform: 366 × 226.3 × 100 mm, 12 kg (CubeSat Design Specification, Rev. 14.1, Cal
/// Poly 2022). e₁, e₂, e₃ along its edges, the longest first: moments of inertia in ascending order.
pub fn cubesat() -> (f64, Vector3<f64>) {
    let (mass, edges) = (12.0, Vector3::new(0.366_f64, 0.2263, 0.1));
    let squares = edges.component_mul(&edges);
    (mass, Vector3::repeat(squares.sum()).map(|sum| sum * mass / 12.0) - squares * (mass / 12.0))
}

/// The Earth's μ, m³/s² (IERS Conventions 2010).
pub const MU: f64 = 3.986_004_418e14;
/// Radius of the orbit, m.
pub const RADIUS: f64 = 7.0e6;

/// Mean motion n = √(μ/r³), rad/s.
pub fn mean_motion() -> f64 {
    (MU / RADIUS.powi(3)).sqrt()
}

/// A rigid body in central gravity; Ω is the centre of the Earth.
///
/// SI units: rotations are known to 10⁻¹⁶, places to 10⁻⁹ m, and neither spoils the other, because in the hybrid chart
/// ḃ and ω have equations of their own. The right-invariant chart would not do here: its momentum about Ω is 10¹⁵ times
/// the angular momentum of the body about G, which is lost in the rounding; see [`FromTheCentre`].
// ANCHOR: orbiter
#[derive(GaussDynamics)]
#[gauss(chart = hybrid, central_gravity(earth, mu = mu))]
pub struct Orbiter {
    /// kg.
    #[gauss(mass)]
    pub mass: f64,
    /// Principal, about G, kg m².
    #[gauss(inertia)]
    pub inertia: Vector3<f64>,
    /// m³/s².
    pub mu: f64,
}
// ANCHOR_END: orbiter

/// The same body in the chart whose pole is the centre of the Earth: to show what is lost.
#[derive(GaussDynamics)]
#[gauss(chart = right_invariant, central_gravity(earth, mu = mu))]
pub struct FromTheCentre {
    /// kg.
    #[gauss(mass)]
    pub mass: f64,
    /// Principal, about G, kg m².
    #[gauss(inertia)]
    pub inertia: Vector3<f64>,
    /// m³/s².
    pub mu: f64,
}

/// The kernel of the CubeSat in the field of the Earth.
///
/// # Errors
/// When its numbers make no body.
pub fn orbiter() -> Result<OrbiterKernel, ParameterError> {
    let (mass, inertia) = cubesat();
    Orbiter { mass, inertia, mu: MU }.kernel()
}

/// On the circular orbit over k₁ at t = 0, with e₃ along the normal k₃: e₁ is turned by `pitch` from the upward
/// vertical and rests in the frame of the orbit; then it is turned and leaned by `lean` about e₂ as it flies.
pub fn start(pitch: f64, lean: f64) -> (Isometry3<f64>, SVector<f64, 6>) {
    let n = mean_motion();
    let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), pitch)
        * UnitQuaternion::from_axis_angle(&Vector3::y_axis(), lean);
    let omega = turn.inverse() * Vector3::new(0.0, 0.0, n);
    let q = Isometry3::from_parts(Translation3::new(RADIUS, 0.0, 0.0), turn);
    (q, SVector::from([0.0, n * RADIUS, 0.0, omega.x, omega.y, omega.z]))
}

/// Orbits with tolerances of 10⁻¹² (an angle in rad; of the radius: 7 μm; of the speeds) and steps of at most 20 s.
///
/// # Errors
/// When the run does not reach the end.
pub fn orbit(
    kernel: &OrbiterKernel,
    start: (Isometry3<f64>, SVector<f64, 6>),
    seconds: f64,
) -> Result<Trajectory<'_, OrbiterKernel>, IntegrationError> {
    // The absolute one is for speeds that vanish: some 10⁻³ rad/s is what counts.
    Simulation::new(kernel).adaptive(1e-12, 1e-15).largest_step(20.0).run(start.0, start.1, 0.0..seconds)
}

/// The angle of e₁ from the upward vertical, about the normal of the orbit, rad.
pub fn pitch(q: &Isometry3<f64>) -> f64 {
    let e1 = q.rotation * Vector3::x();
    let up = q.translation.vector.normalize();
    Vector3::z().dot(&up.cross(&e1)).atan2(up.dot(&e1))
}

/// In the plane of a circular orbit 2·pitch moves as a pendulum: pitch¨ + 3n² (I₂ − I₁)/I₃ sin(pitch) cos(pitch) = 0.
/// Its frequency n √(3 (I₂ − I₁)/I₃) at small angles, rad/s.
pub fn libration_frequency() -> f64 {
    let i = cubesat().1;
    mean_motion() * (3.0 * (i.y - i.x) / i.z).sqrt()
}

/// The period of a libration of this amplitude from the vertical, exact: 4K(sin amplitude)/frequency, s. K by the mean
/// of Gauss.
pub fn libration_period(amplitude: f64) -> f64 {
    let (mut a, mut b) = (1.0, amplitude.cos());
    for _ in 0..8 {
        (a, b) = (0.5 * (a + b), f64::sqrt(a * b));
    }
    std::f64::consts::TAU / (a * libration_frequency())
}

/// Twice the mean time between zeros of the pitch, s.
pub fn measured_period(path: &Trajectory<OrbiterKernel>) -> f64 {
    let angle = |t: f64| pitch(&path.at(t).expect("inside the run").q);
    let mut zeros = vec![];
    for (a, b) in path.iter().zip(path.iter().skip(1)) {
        if (pitch(&a.q) > 0.0) != (pitch(&b.q) > 0.0) {
            let (mut left, mut right) = (a.t, b.t);
            for _ in 0..60 {
                let middle = 0.5 * (left + right);
                if (angle(middle) > 0.0) == (angle(a.t) > 0.0) { left = middle } else { right = middle }
            }
            zeros.push(left);
        }
    }
    2.0 * (zeros[zeros.len() - 1] - zeros[0]) / (zeros.len() - 1) as f64
}

/// A hub with a wheel about its e₃, driven by a motor; its centre of mass stays where it is.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(attitude: Rotation, turned),
    body(hub, position = [0, 0, 0], rotation = attitude),
    body(wheel, parent = hub, position = [0, 0, 0], rotation = rotation_z(turned)),
    input(motor),
    torque(drive, body = wheel, value = [0, 0, motor], reaction = hub),
)]
pub struct Slewer {
    /// The satellite without the rotor.
    #[gauss(body)]
    pub hub: RigidBody<f64>,
    /// The rotor.
    #[gauss(body)]
    pub wheel: RigidBody<f64>,
}

impl Slewer {
    /// The CubeSat with a brass disc, 40 mm across and 10 mm thick (8500 kg/m³), in its centre.
    pub fn cubesat() -> Self {
        let (mass, inertia) = cubesat();
        let (radius, thick) = (0.02_f64, 0.01_f64);
        let disc = std::f64::consts::PI * radius * radius * thick * 8500.0;
        let across = disc * (3.0 * radius * radius + thick * thick) / 12.0;
        let about = 0.5 * disc * radius * radius;
        let body = |mass, moments: Vector3<f64>| RigidBody {
            mass,
            center_of_mass: Vector3::zeros(),
            inertia: Matrix3::from_diagonal(&moments),
        };
        Self { hub: body(mass, inertia), wheel: body(disc, Vector3::new(across, across, about)) }
    }

    /// Moments of hub and wheel about e₃, kg m².
    pub fn moments(&self) -> (f64, f64) {
        (self.hub.inertia[(2, 2)], self.wheel.inertia[(2, 2)])
    }

    /// Angular momentum about G in observer axes, kg m²/s: constant, whatever the motor does.
    pub fn angular_momentum(&self, attitude: &UnitQuaternion<f64>, z: &SVector<f64, 4>) -> Vector3<f64> {
        let both = self.hub.inertia + self.wheel.inertia;
        attitude * (both * Vector3::new(z[0], z[1], z[2]) + Vector3::z() * (self.moments().1 * z[3]))
    }
}

/// The torque that turns the hub by `angle` in `seconds` from rest to rest, as a sine, N m: J α¨ = −motor, J that of
/// the hub.
pub fn slew_torque(slewer: &Slewer, angle: f64, seconds: f64, t: f64) -> f64 {
    let phase = std::f64::consts::TAU * t / seconds;
    -std::f64::consts::TAU * slewer.moments().0 * angle / (seconds * seconds) * phase.sin()
}

/// Rates of (ω, σ̇) of a gyrostat by hand, σ the wheel's angle: d/dt (Iω + h e₃) + ω × (Iω + h e₃) = 0, and J_w (ω₃˙ +
/// σ̈) = m.
fn gyrostat(slewer: &Slewer, motor: f64, z: &SVector<f64, 4>) -> SVector<f64, 4> {
    let ((_, about), omega) = (slewer.moments(), Vector3::new(z[0], z[1], z[2]));
    let without_spin = slewer.hub.inertia + slewer.wheel.inertia;
    let momentum = without_spin * omega + Vector3::z() * (about * z[3]);
    let mut rate = -omega.cross(&momentum);
    // About e₃ the wheel takes m: only the hub is left.
    rate.z -= motor;
    let turn =
        Vector3::new(rate.x / without_spin[(0, 0)], rate.y / without_spin[(1, 1)], rate.z / slewer.hub.inertia[(2, 2)]);
    SVector::from([turn.x, turn.y, turn.z, motor / about - turn.z])
}

/// ω and σ̇ of the gyrostat after so many classical Runge–Kutta steps, rolling about e₁ with the wheel at rest at
/// first.
pub fn tumble_by_hand(slewer: &Slewer, roll: f64, motor: impl Fn(f64) -> f64, h: f64, steps: usize) -> SVector<f64, 4> {
    let mut z = SVector::from([roll, 0.0, 0.0, 0.0]);
    for n in 0..steps {
        let t = n as f64 * h;
        let k1 = gyrostat(slewer, motor(t), &z);
        let k2 = gyrostat(slewer, motor(t + 0.5 * h), &(z + k1 * (0.5 * h)));
        let k3 = gyrostat(slewer, motor(t + 0.5 * h), &(z + k2 * (0.5 * h)));
        let k4 = gyrostat(slewer, motor(t + h), &(z + k3 * h));
        z += (k1 + k2 * 2.0 + k3 * 2.0 + k4) * (h / 6.0);
    }
    z
}

/// The slew by `angle` in `seconds`, the hub rolling at `roll` rad/s about e₁ at first. Tolerances of 10⁻¹² (an angle
/// in rad; of the speeds).
///
/// # Errors
/// When the run does not reach the end.
pub fn slew<'k>(
    kernel: &'k SlewerKernel,
    slewer: &'k Slewer,
    angle: f64,
    seconds: f64,
    roll: f64,
) -> Result<Trajectory<'k, SlewerKernel>, IntegrationError> {
    let start = (UnitQuaternion::identity(), SVector::from([0.0]));
    let run = Simulation::new(kernel)
        .adaptive(1e-12, 1e-14)
        .largest_step(0.25)
        .input(move |t, _, _| SVector::from([slew_torque(slewer, angle, seconds, t)]));
    run.run(start, SVector::from([roll, 0.0, 0.0, 0.0]), 0.0..seconds)
}
