//! Frames without a window: what is shown is the motion of the kernel, and between its steps what lies between.

use std::time::Duration;

use bevy_app::App;
use bevy_ecs::prelude::Entity;
use bevy_time::{Fixed, Time, TimePlugin, TimeUpdateStrategy};
use bevy_transform::components::Transform;
use gauss_bevy_example::{GaussPlugin, Handle, HandleKernel, Moving, shown};
use gauss_runtime::prelude::*;

fn kernel() -> HandleKernel {
    Handle { mass: 0.3, inertia: Vector3::new(2e-3, 1.5e-2, 1.6e-2) }.kernel().expect("a body")
}

fn start() -> (Isometry3<f64>, Vector6<f64>) {
    (Isometry3::translation(0.1, 0.2, 0.3), Vector6::new(0.3, -0.1, 0.2, 0.01, 8.0, 0.01))
}

/// An app in which physics has 64 steps a second and frames come every so many milliseconds.
fn app(milliseconds: u64) -> (App, Entity) {
    let mut app = App::new();
    app.add_plugins((TimePlugin, GaussPlugin::<HandleKernel>::default()));
    app.insert_resource(Time::<Fixed>::from_hz(64.0));
    app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_millis(milliseconds)));
    let (q, z) = start();
    let entity = app.world_mut().spawn(Moving::new(kernel(), q, z)).id();
    (app, entity)
}

#[test]
fn physics_does_not_know_of_frames() {
    for milliseconds in [7, 20, 33] {
        let (mut app, entity) = app(milliseconds);
        let body = loop {
            app.update();
            let body = app.world().get::<Moving<HandleKernel>>(entity).expect("is there");
            if body.time() >= 1.0 {
                break body;
            }
        };
        let (q, z) = start();
        let alone = Simulation::new(&kernel()).fixed_step(1.0 / 64.0).run_to_end(q, z, 0.0..body.time());
        assert_eq!(body.pose(), alone.expect("a run").q, "frames of {milliseconds} ms");
    }
}

#[test]
fn frames_lie_between_steps() {
    let (mut app, entity) = app(10);
    let mut largest = 0.0_f32;
    // The first update only starts the clock.
    app.update();
    for frame in 1..=100 {
        app.update();
        let body = app.world().get::<Moving<HandleKernel>>(entity).expect("is there");
        let seen = app.world().get::<Transform>(entity).expect("is there");
        // What is shown is one step of physics behind the clock.
        let t = 0.010 * f64::from(frame) - 1.0 / 64.0;
        if t <= 0.0 {
            continue;
        }
        let (q, z) = start();
        let exact = Simulation::new(&kernel()).adaptive(1e-12, 1e-12).run_to_end(q, z, 0.0..t).expect("a run");
        let exact = shown(&exact.q);
        let off = (seen.translation - exact.translation).length() + seen.rotation.angle_between(exact.rotation);
        largest = largest.max(off);
        assert!(body.time() >= t);
    }
    // Between two steps velocities change by ω̇ h at most, so a screw motion is off by ω̇ h²/8: with ω̇ below 8 · 0.9 ·
    // 8 /s² (Euler's equations, moments 2, 15, 16) that is 2e-3; f32 takes 1e-3 in an angle between quaternions, whose
    // cosine is what is known.
    assert!(largest < 3e-3, "{largest}");
}

/// The same numbers in the types of `glam`, both ways.
#[test]
fn poses_in_both_types() {
    use bevy_math::{DMat3, DMat4, DQuat, DVec2, DVec3, Quat, Vec3};
    use gauss_runtime::nalgebra::{Matrix4, Point3};

    let pose = Isometry3::new(Vector3::new(1.0, 2.0, 3.0), Vector3::new(0.1, 0.2, 0.3));
    let (position, orientation): (DVec3, DQuat) = pose.into();
    assert_eq!((position, orientation.w), (DVec3::new(1.0, 2.0, 3.0), pose.rotation.w));
    let apart =
        |a: Isometry3<f64>, b: Isometry3<f64>| ((a.inverse() * b).to_homogeneous() - Matrix4::identity()).norm();
    // Products of rotations and sums of three numbers up to 3: a few dozen roundings.
    let few = 64.0 * f64::EPSILON;
    assert!(apart(Isometry3::from((position, orientation)), pose) < few);
    let arm = Vector3::new(0.3, -0.2, 0.5);
    let turned = Vector3::from(orientation * DVec3::from(arm) + position);
    assert!((turned - (pose * Point3::from(arm)).coords).norm() < few);
    assert!(apart(Isometry3::try_from(DMat4::from(pose)).expect("a pose"), pose) < few);
    let (position, orientation): (Vec3, Quat) = pose.cast::<f32>().into();
    assert_eq!((position.z, orientation.w), (3.0, pose.rotation.w as f32));
    let (place, angle): (DVec2, f64) = Isometry2::new(Vector2::new(1.0, 2.0), 0.7).into();
    assert!(place == DVec2::new(1.0, 2.0) && (angle - 0.7).abs() < few);
    let inertia = Matrix3::new(1.0, 2.0, 3.0, 2.0, 4.0, 5.0, 3.0, 5.0, 6.0);
    assert_eq!(Matrix3::from(DMat3::from(inertia)), inertia);
}
