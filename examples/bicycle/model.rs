//! The bicycle of the benchmark: J. P. Meijaard, J. M. Papadopoulos, A. Ruina, A. L. Schwab, *Linearized dynamics equations for
//! the balance and steer of a bicycle: a benchmark and review*, Proc. R. Soc. A 463 (2007) 1955–1982. Its parameters are
//! those of table 1, its axes k₁ forward, k₂ to the right, k₃ down; SI units.

use gauss_runtime::prelude::*;

/// Two wheels, a rear frame with its rider, and a fork, on the floor z = 0: any lean and steer, wheels that do not slip.
///
/// x, y: where the rear wheel touches. That both wheels touch and roll is a constraint each way; the rates of lean, steer and
/// of the rear wheel are left, and the others are solved for.
#[derive(Clone, Copy, Debug, GaussDynamics)]
#[gauss(
    coordinates(x, y, yaw, lean, pitch, steer, rear, front),
    speeds(vx, vy, w_yaw, w_lean, w_pitch, w_steer, w_rear, w_front),
    kinematics(
        x = vx, y = vy, yaw = w_yaw, lean = w_lean, pitch = w_pitch, steer = w_steer, rear = w_rear, front = w_front,
    ),
    body(
        frame,
        position = [x, y, 0] + rotation_z(yaw) * rotation_x(lean) * [0, 0, -rear_radius],
        rotation = rotation_z(yaw) * rotation_x(lean) * rotation_y(pitch),
    ),
    body(rear_wheel, parent = frame, rotation = rotation_y(rear)),
    body(
        fork, parent = frame, position = [wheelbase + trail, 0, rear_radius],
        rotation = rotation_y(tilt) * rotation_z(steer) * rotation_y(-tilt),
    ),
    body(front_wheel, parent = fork, position = [-trail, 0, -front_radius], rotation = rotation_y(front)),
    define(
        axle = fork.rotation * [0, 1, 0],
        level = sqrt(1 - axle.z * axle.z),
        slip = front_wheel.velocity
            + front_radius / level * cross(front_wheel.angular_velocity, [0, 0, 1] - axle.z * axle),
    ),
    constraint(velocity = vx * cos(yaw) + vy * sin(yaw) + rear_radius * (w_pitch + w_rear)),
    constraint(velocity = vy * cos(yaw) - vx * sin(yaw)),
    constraint(position = front_wheel.position.z + front_radius * level),
    constraint(velocity = slip.x),
    constraint(velocity = slip.y),
    independent(w_lean, w_steer, w_rear),
    gravity = [0, 0, g],
    frames(frame, rear_wheel, fork, front_wheel),
    linearize,
)]
pub struct Bicycle {
    pub wheelbase: f64,
    pub trail: f64,
    /// Of the steering axis from the vertical, backwards.
    pub tilt: f64,
    pub rear_radius: f64,
    pub front_radius: f64,
    pub g: f64,
    /// The rear frame and the rider on it, from the centre of the rear wheel.
    #[gauss(body)]
    pub frame: RigidBody<f64, AboutCenterOfMass<f64>>,
    #[gauss(body)]
    pub rear_wheel: RigidBody<f64, AboutCenterOfMass<f64>>,
    /// Fork and handlebar, from where the steering axis meets the floor.
    #[gauss(body)]
    pub fork: RigidBody<f64, AboutCenterOfMass<f64>>,
    #[gauss(body)]
    pub front_wheel: RigidBody<f64, AboutCenterOfMass<f64>>,
}

/// Table 1 of the paper.
#[must_use]
pub fn benchmark() -> Bicycle {
    let (wheelbase, trail, rear_radius, front_radius) = (1.02, 0.08, 0.3, 0.35);
    let part = RigidBody::about_center_of_mass;
    let wheel = |mass, across, about| {
        part(mass, Vector3::zeros(), Matrix3::from_diagonal(&Vector3::new(across, about, across)))
    };
    Bicycle {
        wheelbase,
        trail,
        tilt: std::f64::consts::PI / 10.0,
        rear_radius,
        front_radius,
        g: 9.81,
        frame: part(
            85.0,
            Vector3::new(0.3, 0.0, -0.9 + rear_radius),
            Matrix3::new(9.2, 0.0, 2.4, 0.0, 11.0, 0.0, 2.4, 0.0, 2.8),
        ),
        rear_wheel: wheel(2.0, 0.0603, 0.12),
        fork: part(
            4.0,
            Vector3::new(0.9 - wheelbase - trail, 0.0, -0.7),
            Matrix3::new(0.05892, 0.0, -0.00756, 0.0, 0.06, 0.0, -0.00756, 0.0, 0.00708),
        ),
        front_wheel: wheel(3.0, 0.1405, 0.28),
    }
}

/// Upright and straight ahead with a speed, and a rate of lean.
#[must_use]
pub fn upright(bicycle: &Bicycle, speed: f64, lean_rate: f64) -> (SVector<f64, 8>, Vector3<f64>) {
    (SVector::zeros(), Vector3::new(lean_rate, 0.0, -speed / bicycle.rear_radius))
}

/// Places of lean and steer among the coordinates, and among all variables of a linearisation.
const COORDINATES: [usize; 2] = [3, 5];
const RATES: [usize; 2] = [8, 9];

/// The equations of lean and steer about the upright ride at a speed, x̄̇ = A x̄ with x̄ = (lean, steer, their rates). The other
/// variables do not enter: neither place nor heading matter, and speed and pitch change to second order only.
#[must_use]
pub fn linear(bicycle: &Bicycle, kernel: &BicycleKernel, speed: f64) -> SMatrix<f64, 4, 4> {
    let (q, z) = upright(bicycle, speed, 0.0);
    let all = kernel.linearize(0.0, &q, &z, &()).by_state;
    let places = [COORDINATES[0], COORDINATES[1], RATES[0], RATES[1]];
    SMatrix::from_fn(|i, j| all[(places[i], places[j])])
}

/// The same from the matrices that the paper prints (its equations 5.3 and (A 20) ff. with these parameters):
/// M q̈ + v C₁ q̇ + (g K₀ + v² K₂) q = 0.
#[must_use]
pub fn published(speed: f64, g: f64) -> SMatrix<f64, 4, 4> {
    type Two = SMatrix<f64, 2, 2>;
    let mass = Two::new(80.817_22, 2.319_413_322_087_09, 2.319_413_322_087_09, 0.297_841_881_996_86);
    let c1 = Two::new(0.0, 33.866_413_914_924_94, -0.850_356_414_569_78, 1.685_403_973_975_60);
    let k0 = Two::new(-80.95, -2.599_516_852_498_72, -2.599_516_852_498_72, -0.803_294_884_586_18);
    let k2 = Two::new(0.0, 76.597_345_895_732_22, 0.0, 2.654_315_237_946_04);
    let inverse = mass.try_inverse().expect("a mass matrix");
    let (stiffness, damping) = (-inverse * (k0 * g + k2 * speed * speed), -inverse * c1 * speed);
    let mut a = SMatrix::<f64, 4, 4>::zeros();
    a.fixed_view_mut::<2, 2>(0, 2).copy_from(&Two::identity());
    a.fixed_view_mut::<2, 2>(2, 0).copy_from(&stiffness);
    a.fixed_view_mut::<2, 2>(2, 2).copy_from(&damping);
    a
}
