//! Joints of an arm that are locked, at a number and at a parameter, beside the whole arm.

use gauss_runtime::prelude::*;

use super::{EPSILON, Panda};

#[derive(GaussDynamics)]
#[gauss(
    urdf = "robots/panda.urdf",
    gravity = 9.81,
    lock(panda_joint6 = wrist, panda_finger_joint1 = 0.03),
    frames(panda_joint7_link),
    reactions(panda_joint6)
)]
struct Held {
    wrist: f64,
}

/// Without the wrist and one finger.
const FREE: [usize; 7] = [0, 1, 2, 3, 4, 6, 8];

fn whole(free: &SVector<f64, 7>, [wrist, finger]: [f64; 2]) -> SVector<f64, 9> {
    let mut all = SVector::zeros();
    FREE.iter().zip(free.iter()).for_each(|(&k, own)| all[k] = *own);
    (all[5], all[7]) = (wrist, finger);
    all
}

/// Rows of the whole: those that are free need no further force in the motion of what is left, and that of the wrist is
/// the torque with which the lock holds the hand, which is in the reaction there.
#[test]
fn an_arm_with_a_locked_wrist() {
    let (wrist, finger) = (1.2, 0.03);
    let (arm, held) = (Panda.kernel().unwrap(), Held { wrist }.kernel().unwrap());
    assert_eq!(HeldKernel::DOF, 7);
    let numbers = |size: f64, step: f64| SVector::<f64, 7>::from_fn(|k, _| size * (0.3 + step * k as f64).sin());
    for turn in [0.7, 1.9, -2.4] {
        let [q, z, u] = [numbers(0.8, 1.1 * turn), numbers(1.5, 0.7 * turn), numbers(20.0, 1.9 * turn)];
        let at = whole(&q, [wrist, finger]);
        let matrix = arm.mass_matrix(0.0, &at);
        let inner = held.mass_matrix(0.0, &q);
        // Some hundred products for every entry and every force.
        let rounding = 500.0 * EPSILON;
        for (i, &row) in FREE.iter().enumerate() {
            for (k, &column) in FREE.iter().enumerate() {
                let error = (inner[(i, k)] - matrix[(row, column)]).abs();
                assert!(error <= rounding * matrix.amax(), "{error:e}");
            }
        }
        let rates = held.acceleration(0.0, &q, &z, &u);
        let [z_all, rates_all, u_all] = [z, rates, u].map(|free| whole(&free, [0.0; 2]));
        let rest = arm.inverse_dynamics(0.0, &at, &z_all, &rates_all, &u_all);
        let size = matrix.amax() * rates.amax() * 9.0 + u.amax() + 100.0;
        assert!(FREE.iter().all(|&row| rest[row].abs() <= rounding * size), "{rest} of {size}");
        let reaction = held.reaction(HeldJoint::panda_joint6, 0.0, &q, &z, &u);
        assert!((reaction[5] - rest[5]).abs() <= rounding * size, "{} {}", reaction[5], rest[5]);
        let energies = (held.kinetic_energy(0.0, &q, &z), arm.kinetic_energy(0.0, &at, &z_all));
        assert!((energies.0 - energies.1).abs() <= rounding * energies.1, "{energies:?}");
    }
    let state = HeldState { panda_joint1: 0.5, panda_joint7_dot: 1.0, ..Default::default() };
    assert_eq!((state.q()[0], state.z()[5]), (0.5, 1.0));
    let input = HeldInput { panda_joint7: 2.0, ..Default::default() }.input();
    assert_eq!(input[5], 2.0);
}

/// The parameter is checked as all others are.
#[test]
fn a_lock_at_no_number() {
    let refused = Held { wrist: f64::NAN }.kernel().unwrap_err();
    let found = refused.violations()[0];
    assert_eq!((found.field, found.rule), ("wrist", gauss_runtime::error::Rule::Finite));
}
