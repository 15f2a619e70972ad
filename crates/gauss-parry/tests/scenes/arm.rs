//! An arm that pushes a box over a table.

use gauss_parry::parry3d_f64::math::Vector;
use gauss_parry::parry3d_f64::shape::SharedShape;
use gauss_parry::{ParrySteps, Shapes};
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::prelude::*;

use crate::plane::surface;

/// An upright post that turns, with a bar that slides out of it; its end is a ball.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(turn, reach, pose: Pose),
    body(post, rotation = rotation_z(turn), mass = 5, inertia = [0.1, 0.1, 0.05]),
    body(bar, parent = post, position = [reach, 0, 0.1], mass = 1, inertia = [0.001, 0.02, 0.02]),
    body(cargo, position = pose.position, rotation = pose.rotation, mass = m, inertia = m * a * a / 6),
    input(push, torque),
    drive(motors, reach = push, turn = torque),
    frames(bar, cargo),
)]
struct Arm {
    m: f64,
    a: f64,
    #[gauss(gravity)]
    g: f64,
}

#[test]
fn an_arm_pushes_a_box_over_a_table() {
    let (m, a, g, mu) = (2.0, 0.2, 9.81, 0.3);
    let kernel = Arm { m, a, g }.kernel().unwrap();
    let mut shapes = Shapes::new();
    let still = Isometry3::identity();
    let table = shapes.add(None, SharedShape::halfspace(Vector::Z), still, surface(mu, 0.0));
    let tip = shapes.add(Some(ArmFrame::bar), SharedShape::ball(0.02), still, surface(0.0, 0.0));
    shapes.add(Some(ArmFrame::cargo), SharedShape::cuboid(0.5 * a, 0.5 * a, 0.5 * a), still, surface(mu, 0.0));
    let shapes = shapes.without(table, tip);
    // The ball is a centimetre from the middle of the box.
    let start = ArmState { reach: 0.37, pose: Isometry3::translation(0.5, 0.0, 0.5 * a), ..Default::default() };
    let mut steps = ParrySteps::<_, 8, 24, _>::new(&kernel, shapes, (0.0, start.q(), start.z())).unwrap();
    // The push is μ m g and 1 N for each kg of both.
    let push = mu * m * g + (m + 1.0);
    let input = ArmInput { push, torque: 0.0 }.input();
    let mut touched = None;
    for n in 0..1000 {
        let report = steps.step(1e-3, &input).unwrap();
        // Rounding of places up to 1, and the tolerance of steps.
        let gaps = steps.slots().gaps(0.0, steps.configuration());
        assert!(gaps.min() > -1e-14 && report.residual.worst() < 1e-8, "{n} {report:?} {gaps}");
        let now = ArmState::of(steps.configuration(), steps.speeds());
        if touched.is_none() && now.pose.translation.x > 0.5 {
            touched = Some((now, n));
        }
    }
    // From the impact on both move with 1 m/s² more and more: the ball has no friction, it pushes through the centre.
    let (then, at) = touched.unwrap();
    let now = ArmState::of(steps.configuration(), steps.speeds());
    let time = 1e-3 * f64::from(999 - at);
    let way = then.pose_u.x * time + 0.5 * time * time;
    assert!((now.pose.translation.x - then.pose.translation.x - way).abs() < 1e-9);
    assert!((now.pose.translation.x - now.reach - 0.12).abs() < 1e-12 && now.pose.translation.y.abs() < 1e-9);
    assert!((now.pose.translation.z - 0.5 * a).abs() < 1e-14);
}
