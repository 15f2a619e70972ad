//! The motions as pages that play: contacts in the colour of what they do, with their forces.

use gauss_contact::{ContactError, ContactTrajectory};
use gauss_playback::{Playback, Shape};
use gauss_runtime::contact::ContactFrame;
use gauss_runtime::prelude::*;

use crate::scenes::{BallKernel, BeltKernel, BilliardKernel};

fn at(x: f64, y: f64, z: f64) -> Isometry3<f64> {
    Isometry3::translation(x, y, z)
}

/// A ball of 5 cm that bounces until it rests.
///
/// # Errors
/// Where the run has no steps.
pub fn ball(
    kernel: &BallKernel,
    run: &ContactTrajectory<'_, BallKernel>,
) -> Result<Playback<BallKernel>, ContactError> {
    let floor = Shape::cuboid([0.8, 0.4, 0.02]).at(&at(0.0, 0.0, -0.01)).colour("#bbbbbb");
    Ok(Playback::new("A ball that keeps 0.9 of its speed", run)?
        .si()
        .body("ball", |s| at(0.0, 0.0, s.q[0]), [Shape::ball(0.05).at(&at(0.0, 0.0, 0.05))])
        .body("floor", |_| Isometry3::identity(), [floor])
        .from_the_side()
        .contacts(kernel, 0.03, run)
        .curve("height / m", "ball", |s| s.q[0])
        .energy(kernel))
}

/// A block on a belt over two rollers, held by a spring.
///
/// # Errors
/// Where the run has no steps.
pub fn block(
    kernel: &BeltKernel,
    run: &ContactTrajectory<'_, BeltKernel>,
) -> Result<Playback<BeltKernel>, ContactError> {
    let (speed, radius) = (0.3, 0.08);
    let roller = |s: &Sample<BeltKernel>, x: f64| {
        let turn = UnitQuaternion::from_euler_angles(0.0, speed * s.t / radius, 0.0);
        Isometry3::from_parts(Translation3::new(x, 0.0, -0.01 - radius), turn)
    };
    let lying = Isometry3::rotation(Vector3::x() * std::f64::consts::FRAC_PI_2);
    let drum = || Shape::cylinder(radius, 0.2).at(&lying).colour("#888888");
    let side = |z: f64| Shape::cuboid([1.4, 0.22, 0.01]).at(&at(0.3, 0.0, z)).colour("#444444");
    // The scene knows the slip and not where it is: below the middle of the block.
    let place = |_: usize, s: &Sample<BeltKernel>| {
        Some(ContactFrame::new(Vector3::new(s.q[0], 0.0, s.q[1]), Vector3::z(), &[Vector3::x()]))
    };
    Ok(Playback::new("A block on a belt sticks and slips", run)?
        .si()
        .body("block", |s| at(s.q[0], 0.0, s.q[1] + 0.05), [Shape::cuboid([0.14, 0.14, 0.1])])
        .body("wall", |_| at(-0.7, 0.0, 0.05), [Shape::cuboid([0.02, 0.2, 0.3]).colour("#bbbbbb")])
        .body("belt", |_| Isometry3::identity(), [side(-0.005), side(-0.015 - 2.0 * radius)])
        .body("roller", |s| roller(s, -0.4), [drum()])
        .body("other roller", |s| roller(s, 1.0), [drum()])
        .rod("wall", "block", 0.01)
        .from_the_side()
        .contacts_at(kernel, 0.03, run, place)
        .curve("speed / (m/s)", "block", |s| s.z[0])
        .curve("speed / (m/s)", "belt", |_| speed)
        .curve("friction / N", "friction", |s| run.forces(s.t).map_or(f64::NAN, |forces| forces[1])))
}

/// A billiard ball with side spin.
///
/// # Errors
/// Where the run has no steps.
pub fn billiard(
    kernel: &BilliardKernel,
    run: &ContactTrajectory<'_, BilliardKernel>,
) -> Result<Playback<BilliardKernel>, ContactError> {
    let radius = 0.028;
    let slip = |s: &Sample<BilliardKernel>| {
        let rates = kernel.contact_rates(s.t, &s.q, &s.z);
        rates[1].hypot(rates[2])
    };
    Ok(Playback::new("A billiard ball with side spin", run)?
        .si()
        .body("ball", |s| s.q, [Shape::ball(radius)])
        .trace("ball", [0.0; 3])
        .follow("ball")
        .contacts(kernel, 0.05, run)
        .curve("velocity / (m/s)", "along k₁", |s| (s.q.rotation * Vector3::new(s.z[0], s.z[1], s.z[2])).x)
        .curve("velocity / (m/s)", "along k₂", |s| (s.q.rotation * Vector3::new(s.z[0], s.z[1], s.z[2])).y)
        .curve("velocity / (m/s)", "slip", slip)
        .energy(kernel))
}
