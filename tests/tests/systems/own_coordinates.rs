//! One body in coordinates and speeds of a scene's own, carried to charts and back: same pose, same twist, same
//! momentum and energy; what cannot be expressed is said in words.

use std::fmt::Debug;

use gauss_runtime::chart::{ChartError, MotionRule, convert, convert_at};
use gauss_runtime::prelude::*;

/// The same body in every scene.
macro_rules! body {
    ($name:ident, [$($clauses:tt)*]) => {
        #[derive(GaussDynamics)]
        #[gauss($($clauses)*)]
        struct $name {
            #[gauss(mass)]
            mass: f64,
            #[gauss(center_of_mass)]
            center: Vector3<f64>,
            #[gauss(inertia)]
            inertia: Matrix3<f64>,
            #[gauss(gravity)]
            g: f64,
            /// Of an arm, in the scenes that have one.
            #[allow(dead_code)]
            l: f64,
        }

        impl $name {
            fn made() -> <Self as Made>::Kernel {
                let inertia = Matrix3::new(2.0, 0.1, -0.2, 0.1, 2.5, 0.3, -0.2, 0.3, 3.0);
                let center = Vector3::new(0.1, -0.2, 0.3);
                Self { mass: 2.0, center, inertia, g: 9.81, l: 1.5 }.kernel().expect("a body")
            }
        }
    };
}

/// What `kernel()` makes.
trait Made {
    type Kernel;
}

macro_rules! bodies {
    ($($name:ident $kernel:ident [$($clauses:tt)*])*) => {
        $(body!($name, [$($clauses)*]);
        impl Made for $name {
            type Kernel = $kernel;
        })*
    };
}

bodies! {
    Left LeftKernel [chart = left_invariant]
    Hybrid HybridKernel [chart = hybrid]
    Zyx ZyxKernel [chart = jet(euler_zyx)]
    Plane PlaneKernel [chart = hybrid, motion = planar]

    // Six coordinates with rates as speeds: those of Euler's angles.
    Angles AnglesKernel [
        coordinates(x, y, z, yaw, pitch, roll),
        body(position = [x, y, z], rotation = rotation_z(yaw) * rotation_y(pitch) * rotation_x(roll)),
    ]
    // Distance, longitude and latitude, with speeds that are mixed.
    Spherical SphericalKernel [
        coordinates(r, east, north, turn: Rotation), speeds(v, a, b, w: Vector3),
        kinematics(r = v + a, east = a - 2 * b, north = b, turn = w + [v, 0, 0]),
        body(position = [r * cos(north) * cos(east), r * cos(north) * sin(east), r * sin(north)], rotation = turn),
    ]
    // On an arm without mass that moves on a rail.
    Arm ArmKernel [
        coordinates(x, a, b), frame(arm, position = [x, 0, 0], rotation = rotation_z(a)),
        body(parent = arm, position = [l, 0, 0], rotation = rotation_x(b)),
    ]
    // A point of the body is at Ω.
    Pendulum PendulumKernel [
        coordinates(a), body(position = [l * cos(a), l * sin(a), 0], rotation = rotation_z(a)),
    ]
    // The pivot of the pendulum goes up and down.
    Driven DrivenKernel [
        coordinates(a), body(position = [l * cos(a), l * sin(a) + sin(3 * t), 0], rotation = rotation_z(a)),
    ]
    // A knife edge, by multipliers and by fewer speeds.
    Sleigh SleighKernel [
        coordinates(x, y, a), body(position = [x, y, 0], rotation = rotation_z(a)),
        constraint(velocity = dot(body.velocity, body.rotation * [0, 1, 0])),
    ]
    Steered SteeredKernel [
        coordinates(x, y, a), speeds(v, w), kinematics(x = v * cos(a), y = v * sin(a), a = w),
        body(position = [x, y, 0], rotation = rotation_z(a)),
    ]
    // A chart whose body is held, by multipliers and by fewer speeds.
    Held HeldKernel [chart = jet(euler_zyx), constraint(position = body.position)]
    Cutting CuttingKernel [
        chart = left_invariant, constraint(velocity = dot(body.velocity, body.rotation * [0, 1, 0])), independent(u.x, u.z, omega),
    ]
}

/// Poses anywhere, and twists.
fn states() -> Vec<(Isometry3<f64>, SVector<f64, 6>)> {
    let number =
        |k: usize, i: usize| ((k * (2 * i + 1)) as f64 * 0.618_033_988_749 + 0.31 * i as f64) % 1.0 * 2.0 - 1.0;
    let state = |k: usize| {
        let part = |scale: f64, first: usize| {
            Vector3::new(number(k, first), number(k, first + 1), number(k, first + 2)) * scale
        };
        let pose = Isometry3::new(part(3.0, 0), part(2.5, 3));
        (pose, SVector::from(std::array::from_fn(|i| 2.0 * number(k, 6 + i))))
    };
    (1..40).map(state).collect()
}

/// Roundings of the pose, times what the worst of these coordinates make of them: latitudes and pitches here are at
/// least 10⁻² from a quarter turn, and distances 10⁻² from zero.
const ALLOWED: f64 = 1e3 * 64.0 * f64::EPSILON;

/// There and back, with what does not depend on variables.
fn agree<A, B>(a: &A, q: &A::Configuration, z: &A::Speeds, b: &B) -> Result<(), ChartError>
where
    A: RigidBodySystem<Scalar = f64>,
    B: RigidBodySystem<Scalar = f64, Configuration: Debug>,
{
    let (other, speeds) = convert(a, q, z, b)?;
    let pose = a.pose(0.0, q);
    let apart = Configuration::difference(&b.pose(0.0, &other), &pose);
    assert!(apart.amax() < ALLOWED * (1.0 + pose.translation.vector.amax()), "{apart} {other:?}");
    let (twist, there) = (a.body_twist(0.0, q, z), b.body_twist(0.0, &other, &speeds));
    let scale = 1.0 + twist.amax() + speeds.max_norm();
    assert!((twist - there).amax() < ALLOWED * scale, "{twist} {there}");
    let momenta = [a.body_momentum(0.0, q, z), b.body_momentum(0.0, &other, &speeds)];
    // Masses and moments are below 4.
    assert!((momenta[0] - momenta[1]).amax() < 4.0 * ALLOWED * scale, "{} {}", momenta[0], momenta[1]);
    let energies = [a.kinetic_energy(0.0, q, z), b.kinetic_energy(0.0, &other, &speeds)];
    assert!((energies[0] - energies[1]).abs() < 4.0 * ALLOWED * scale * scale, "{energies:?}");
    let (back, again) = convert(b, &other, &speeds, a)?;
    let apart = Configuration::difference(&a.pose(0.0, &back), &pose);
    assert!(apart.amax() < ALLOWED * (1.0 + pose.translation.vector.amax()), "back: {apart}");
    let back = a.body_twist(0.0, &back, &again);
    assert!((twist - back).amax() < ALLOWED * scale, "back: {twist} {back}");
    Ok(())
}

#[test]
fn free_bodies_convert_between_charts_and_coordinates_of_their_own() {
    let (left, angles, spherical) = (Left::made(), Angles::made(), Spherical::made());
    let (hybrid, zyx) = (Hybrid::made(), Zyx::made());
    for (pose, twist) in states() {
        agree(&left, &pose, &twist, &angles).expect("regular");
        agree(&left, &pose, &twist, &spherical).expect("regular");
        let (q, z) = convert(&left, &pose, &twist, &spherical).expect("regular");
        agree(&spherical, &q, &z, &hybrid).expect("regular");
        agree(&spherical, &q, &z, &zyx).expect("regular");
        agree(&spherical, &q, &z, &angles).expect("regular");
        // The speeds of a jet chart are the rates of the same angles.
        let ((_, own), (_, chart)) = (
            convert(&left, &pose, &twist, &angles).expect("regular"),
            convert(&left, &pose, &twist, &zyx).expect("regular"),
        );
        let (own, chart) = (own.fixed_rows::<3>(0) - chart.fixed_rows::<3>(0), own.amax().max(chart.amax()));
        assert!(own.amax() < ALLOWED * (1.0 + chart), "{own}");
    }
}

#[test]
fn bodies_with_fewer_degrees_of_freedom_go_one_way_and_come_back() {
    let (left, plane) = (Left::made(), Plane::made());
    let (arm, pendulum) = (Arm::made(), Pendulum::made());
    for k in 1..30 {
        let x = f64::from(k);
        let (q, z) = (SVector::from([x.sin(), 0.2 * x, 0.3 * x]), SVector::from([1.0 - x.cos(), 0.7, -0.1 * x]));
        agree(&arm, &q, &z, &left).expect("a free body can do it");
        let (q, z) = (SVector::from([0.4 * x]), SVector::from([1.0 - 0.1 * x]));
        agree(&pendulum, &q, &z, &left).expect("a free body can do it");
        agree(&pendulum, &q, &z, &plane).expect("it is in the plane");
        agree(&pendulum, &q, &z, &arm).expect("an arm can do it");
    }
}

#[test]
fn what_the_coordinates_cannot_have_is_named() {
    let (left, pendulum, angles, arm) = (Left::made(), Pendulum::made(), Angles::made(), Arm::made());
    let (q, z) = (SVector::from([0.3]), SVector::from([0.8]));
    let (pose, twist) = convert(&pendulum, &q, &z, &left).expect("a free body can do it");
    let mut farther = pose;
    farther.translation.vector *= 1.001;
    let refused = convert(&left, &farther, &twist, &pendulum).expect_err("off the circle");
    match refused {
        ChartError::Inexpressible { rule: MotionRule::Pose, value } => {
            assert!((value - 1.5e-3).abs() < 1e-4, "{value}")
        }
        other => panic!("{other}"),
    }
    let mut sliding = twist;
    sliding[2] = 1e-3;
    let refused = convert(&left, &pose, &sliding, &pendulum).expect_err("out of the plane");
    assert_eq!(refused, ChartError::Inexpressible { rule: MotionRule::Twist { index: 2 }, value: 1e-3 });
    // Gimbal lock of coordinates that nobody called so.
    let quarter = Isometry3::rotation(Vector3::y() * std::f64::consts::FRAC_PI_2);
    let refused = convert(&left, &quarter, &twist, &angles).expect_err("yaw and roll are one");
    assert!(matches!(refused, ChartError::Undetermined { .. }), "{refused:?}");
    let broken = SVector::<f64, 6>::from([f64::NAN; 6]);
    assert_eq!(convert(&left, &pose, &broken, &arm).expect_err("NaN"), ChartError::NonFinite);
}

#[test]
fn constraints_say_what_converts() {
    let (plane, sleigh, steered) = (Plane::made(), Sleigh::made(), Steered::made());
    let (left, held, cutting) = (Left::made(), Held::made(), Cutting::made());
    for k in 1..30 {
        let x = f64::from(k);
        let (q, z) = (SVector::from([x.sin(), x.cos(), 0.2 * x]), SVector::from([1.0 + 0.1 * x, 0.7 - 0.1 * x]));
        agree(&steered, &q, &z, &plane).expect("it is in the plane");
        agree(&steered, &q, &z, &sleigh).expect("both have the edge");
        agree(&steered, &q, &z, &cutting).expect("the edge in space");
        let turned = Isometry3::rotation(Vector3::new(0.1 * x, 0.3, -0.2));
        let spin = SVector::<f64, 6>::from([0.0, 0.0, 0.0, 0.3, 0.1 * x, -0.7]);
        agree(&left, &turned, &spin, &held).expect("O is held");
    }
    let sideways = SVector::<f64, 6>::from([0.0, 1e-3, 0.0, 0.0, 0.0, 0.2]);
    let still = Isometry3::identity();
    for refused in [
        convert(&left, &still, &sideways, &steered).map(|_| ()),
        convert(&left, &still, &sideways, &sleigh).map(|_| ()),
        convert(&left, &still, &sideways, &held).map(|_| ()),
    ] {
        let refused = refused.expect_err("the edge holds");
        assert!(matches!(refused, ChartError::Inexpressible { rule: MotionRule::Twist { .. }, .. }), "{refused:?}");
    }
    let away = Isometry3::translation(1e-3, 0.0, 0.0);
    let refused = convert(&left, &away, &SVector::zeros(), &held).expect_err("O is held");
    assert!(matches!(refused, ChartError::Inexpressible { rule: MotionRule::Constraints, .. }), "{refused:?}");
}

#[test]
fn what_is_moved_converts_at_its_time() {
    let (driven, left) = (Driven::made(), Left::made());
    for k in 1..20 {
        let t = 0.37 * f64::from(k);
        let (q, z) = (SVector::from([0.2 * f64::from(k) - 1.0]), SVector::from([0.8 - t]));
        let (pose, twist) = convert_at(t, &driven, &q, &z, &left).expect("a free body can do it");
        let (there, speeds) = convert_at(t, &left, &pose, &twist, &driven).expect("it came from there");
        let turns = (there[0] - q[0]) / std::f64::consts::TAU;
        assert!((turns - turns.round()).abs() < ALLOWED && (speeds - z).amax() < ALLOWED * 10.0, "{there} {speeds}");
        // At another time the pivot is elsewhere.
        let refused = convert_at(t + 0.1, &left, &pose, &twist, &driven).expect_err("the pivot has moved");
        assert!(matches!(refused, ChartError::Inexpressible { rule: MotionRule::Pose, .. }), "{refused:?}");
    }
}
