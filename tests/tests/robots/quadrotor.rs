//! Thrusts at sites, a ball joint with an armature and a damper, a file that includes another, controls of a keyframe.

use gauss_runtime::prelude::*;

use super::EPSILON;

#[derive(GaussDynamics)]
#[gauss(mjcf = "robots/quadrotor.xml")]
struct Quadrotor;

const THRUSTS: [&str; 4] = ["front_control", "left_control", "rear_control", "right_control"];

/// The controls of the keyframe hold the weight of craft and load.
#[test]
fn it_hovers() {
    let (kernel, hover, controls) = (Quadrotor.kernel().unwrap(), QuadrotorState::hover(), QuadrotorInput::hover());
    assert!((4.0 * controls.rear - 1.6 * 9.81).abs() <= 4.0 * EPSILON * 16.0);
    let found = kernel.acceleration(0.0, &hover.q(), &hover.z(), &controls.input());
    assert!(found.amax() <= 1e3 * EPSILON * 9.81, "{found}");
}

/// A unit of control is a force along the third axis of its site with a torque about it, at the site: the power of
/// these is that of the generalised force.
#[test]
fn thrusts_act_at_their_sites() {
    let kernel = Quadrotor.kernel().unwrap();
    let (q, none) = (QuadrotorState::hover().q(), SVector::zeros());
    let sites = [(0.14, 0.14, -0.02), (-0.14, 0.14, 0.02), (-0.14, -0.14, -0.02), (0.14, -0.14, 0.02)];
    for (k, (x, y, torque)) in sites.into_iter().enumerate() {
        let mut input = SVector::<f64, 4>::zeros();
        input[k] = 2.5;
        let force = kernel.generalised_force(THRUSTS[k], 0.0, &q, &none, &input).unwrap();
        let QuadrotorState { flight_u, flight_omega, swing_omega, .. } = QuadrotorState::of(&q, &force);
        assert!((flight_u - Vector3::new(0.0, 0.0, 2.5)).amax() <= 8.0 * EPSILON, "{force}");
        let expected = Vector3::new(y, -x, torque) * 2.5;
        assert!((flight_omega - expected).amax() <= 8.0 * EPSILON && swing_omega.amax() == 0.0, "{force}");
    }
}

/// On the diagonal of the mass matrix where the ball's speeds are, wherever it is; and a torque against its speed.
#[test]
fn a_ball_with_an_armature() {
    let kernel = Quadrotor.kernel().unwrap();
    let turn = UnitQuaternion::from_euler_angles(0.4, -0.3, 1.1);
    let q = QuadrotorState { swing: turn, ..QuadrotorState::hover() }.q();
    let moving = QuadrotorState { swing_omega: Vector3::new(0.3, -0.5, 0.7), ..QuadrotorState::hover() };
    let only = |vector: &SVector<f64, 9>| QuadrotorState::of(&q, vector).swing_omega;
    // About the pivot: m l² = 0.012 besides the moments of the load, and the armature of 0.004.
    let matrix = kernel.mass_matrix(0.0, &q);
    let expected = Vector3::new(0.017, 0.017, 0.0045).component_mul(&moving.swing_omega);
    assert!((only(&(matrix * moving.z())) - expected).amax() <= 16.0 * EPSILON, "{matrix}");
    let none = SVector::zeros();
    let damping = kernel.generalised_force("joint_damping", 0.0, &q, &moving.z(), &none).unwrap();
    assert!((only(&damping) + moving.swing_omega * 0.01).amax() <= 4.0 * EPSILON, "{damping}");
    // Alone in the air, without thrust, what acts besides weight is the damper: ∂E/∂t is its power.
    let rate = kernel.acceleration(0.0, &q, &moving.z(), &none);
    let power = moving.z().dot(&(matrix * rate));
    let weight = kernel.generalised_force("gravity", 0.0, &q, &moving.z(), &none).unwrap();
    let lost = -0.01 * moving.swing_omega.norm_squared();
    // d/dt ½ zᵀ A z = zᵀ A ż + ½ zᵀ Ȧ z; with the craft at rest A varies along the motion by the coupling alone, which
    // has no part in ½ zᵀ A z.
    assert!((power - lost - moving.z().dot(&weight)).abs() <= 1e3 * EPSILON, "{power} {lost}");
}
