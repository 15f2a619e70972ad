//! The claims of the scene `pusher` of the benchmark `contact_scenes`: what it writes as gaps and slips are those of
//! the material points that touch; the box goes with the fingers and stays where it is left.

use std::error::Error;

#[path = "../../benches/examples/contact_scenes/push.rs"]
mod push;

use gauss_contact::ContactStepper;
use gauss_runtime::prelude::*;
use push::{DAMPING, PusherFrame, PusherKernel, RATES, STIFFNESS, start, target};

const STEP: f64 = 1e-3;

#[test]
fn gaps_and_slips_are_those_of_material_points() -> Result<(), Box<dyn Error>> {
    let (pusher, (cargo, joints)) = start(0.5)?;
    let kernel = pusher.kernel()?;
    let turned = UnitQuaternion::from_scaled_axis(Vector3::new(0.1, -0.2, 0.3));
    let cargo = Isometry3::from_parts(cargo.translation, turned * cargo.rotation);
    let q = (cargo, joints.map(|angle| angle + 0.1 * (3.0 * angle).sin()));
    let z = SVector::<f64, 15>::from_fn(|i, _| (1.7 * i as f64).sin());
    let (gaps, rates) = (kernel.gaps(0.0, &q), kernel.contact_rates(0.0, &q, &z));

    // In axes of the box, from its middle.
    let (moves, turns) = (z.fixed_rows::<3>(9), z.fixed_rows::<3>(12));
    let fingers = [PusherFrame::panda_finger_joint1_link, PusherFrame::panda_finger_joint2_link];
    for (k, finger) in fingers.into_iter().enumerate() {
        let (pose, twist) = (kernel.pose_of(finger, 0.0, &q), kernel.twist_of(finger, 0.0, &q, &z));
        let at = Vector3::new(0.0, 0.0, pusher.tip);
        let place =
            cargo.rotation.inverse() * (pose.translation.vector + pose.rotation * at - cargo.translation.vector);
        let relative = cargo.rotation.inverse().to_rotation_matrix() * pose.rotation;
        let (velocity, angular) = (twist.fixed_rows::<3>(0), twist.fixed_rows::<3>(3));
        let velocity = relative * (velocity + angular.cross(&at));
        let touches = place + Vector3::new(0.0, pusher.r, 0.0);
        let of_finger = velocity + (relative * angular).cross(&Vector3::new(0.0, pusher.r, 0.0));
        let slip = of_finger - (moves + turns.cross(&touches));
        let row = PusherKernel::CONTACTS[4 + k].normal;
        // Some hundred roundings of numbers of the size of 3, joint by joint.
        let same = |a: f64, b: f64| assert!((a - b).abs() < 1e-13, "finger {k}: {a} and {b}");
        same(gaps[4 + k], -touches.y - 0.5 * pusher.a);
        same(rates[row], -slip.y);
        same(rates[row + 1], slip.x);
        same(rates[row + 2], slip.z);
    }
    Ok(())
}

#[test]
fn the_box_goes_with_the_fingers_and_stays() -> Result<(), Box<dyn Error>> {
    let (pusher, begin) = start(0.5)?;
    let kernel = pusher.kernel()?;
    let mut stepper = ContactStepper::new(&kernel, 0.0, begin, SVector::zeros())?;
    let (stiffness, damping) = (SVector::from(STIFFNESS), SVector::from(DAMPING));
    let mut rested = begin.0;
    for n in 0..3000 {
        let t = n as f64 * STEP;
        let rates = stepper.speeds().fixed_rows::<9>(RATES).into_owned();
        let led = stiffness.component_mul(&(target(t) - stepper.configuration().1));
        let report = stepper.step(STEP, &(led - damping.component_mul(&rates)))?;
        // The solver ends within 1e-8 of the largest rate, below a metre a second; gaps are rounded at the size of
        // coordinates, a metre, a few times for each joint of the arm.
        let (residual, gap) = (report.residual, kernel.gaps(t, stepper.configuration()).min());
        let worst = residual.signorini.max(residual.coulomb).max(residual.dissipation);
        assert!(worst < 1e-8 && gap > -1e-14, "{worst} m/s, {gap} m at {t} s");
        if n == 2000 {
            rested = stepper.configuration().0;
        }
    }
    let end = stepper.configuration();
    // Its face lies on the tips of both fingers: it has the yaw of the arm but for what wrist and fingers give, below
    // 1 degree, since at 8 N and 0.6 m from them they give some millimetres on 80.
    let yaw = end.0.rotation.euler_angles().2;
    assert!((yaw - end.1[0]).abs() < 0.0175 && yaw > 0.35, "{yaw} rad, the arm {} rad", end.1[0]);
    // Held by friction: slips are zero at the ends of steps up to the same 1e-8 of what moves, the arm that comes to
    // rest, and a second later nothing does.
    let way = (end.0.translation.vector - rested.translation.vector).norm();
    assert!(way < 1e-8, "it creeps by {way} m in a second");
    Ok(())
}
