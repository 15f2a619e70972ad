//! Armatures against particles that move on lines of their own, across gravity; friction of joints against its law and
//! its power.

use crate::common::Bounded;
use crate::common::agreement::equal;
use crate::common::groups::Random;
use crate::common::kernels::same;
use gauss_runtime::error::Rule;
use gauss_runtime::prelude::*;

macro_rules! pair {
    ($test:ident: $geared:ident $beside:ident, $origin:expr, [$($scene:tt)+] [$($armature:tt)+] [$($particles:tt)+]) => {
        pair!(@ $geared [$($scene)+] [$($armature)+]);
        pair!(@ $beside [$($scene)+] [$($particles)+]);

        #[test]
        fn $test() {
            let [a, g] = [Bounded::from_f64(0.3), Bounded::from_f64(9.81)];
            same(&$origin, &$geared { a, g }.kernel().unwrap(), &$beside { a, g }.kernel().unwrap());
        }
    };
    (@ $name:ident [$($scene:tt)+] [$($clauses:tt)+]) => {
        #[derive(GaussDynamics)]
        #[gauss($($scene)+, $($clauses)+)]
        struct $name<T> {
            a: T,
            #[gauss(gravity)]
            g: T,
        }
    };
}

pair!(in_space: Geared Beside, SVector::from([0.3, -0.4, 0.2]), [
    coordinates(x, y, z),
    body(b0, rotation = rotation_z(x), mass = 2, center_of_mass = [0.1, 0, 0.2], inertia = [1, 1, 0.5]),
    body(b1, parent = b0, position = [0.3, 0, 0], rotation = rotation_y(y), mass = 1, center_of_mass = [0, 0.1, 0.3],
         inertia = [0.5, 0.5, 0.2]),
    body(b2, parent = b1, position = [0, 0, 0.5], rotation = rotation_x(z), mass = 0.5, center_of_mass = [0, 0.1, 0.3],
         inertia = [0.2, 0.3, 0.2])
] [armature(x = 0.2, z = 2 * a)] [
    particle(mass = 0.2, position = [x, 0, 0]), particle(mass = 2 * a, position = [0, z, 0])
]);

pair!(in_the_plane: GearedPlane BesidePlane, SVector::from([0.3, -0.4]), [
    coordinates(x, y),
    body(b0, rotation = rotation_y(x), mass = 2, center_of_mass = [0, 0, 0.2], inertia = [1, 1, 0.5]),
    body(b1, parent = b0, position = [0, 0, 0.5], rotation = rotation_y(y), mass = 1, center_of_mass = [0, 0, 0.3],
         inertia = [0.5, 0.5, 0.2])
] [armature(x = a, y = a * a)] [particle(mass = a, position = [x, 0, 0]), particle(mass = a * a, position = [0, y, 0])]);

// Rates that depend on the configuration and on several speeds: what armatures add to A is not on its diagonal.
pair!(of_quasi_velocities: GearedCraft BesideCraft,
    (Isometry3::<f64>::identity(), SVector::from([0.4, 0.2])), [
    coordinates(base: Pose, s, turn),
    speeds(u: Vector3, w: Vector3, v, bend),
    kinematics(base = twist(u, w), s = v + s * bend, turn = bend * cos(s) - 2 * v),
    body(hull, pose = base, mass = 2, center_of_mass = [0.1, 0, 0.2], inertia = [1, 1, 0.5]),
    body(arm, parent = hull, position = [s, 0, 0], rotation = rotation_y(turn), mass = 1, center_of_mass = [0, 0.1, 0.3],
         inertia = [0.5, 0.5, 0.2])
] [armature(turn = a, s = 0.1)] [particle(mass = a, position = [turn, 0, 0]), particle(mass = 0.1, position = [s, 0, 0])]);

// Of a pose a body that is the same about all axes, without weight; of a rotation a ring of no mass.
pair!(of_poses_and_rotations: GearedBall BesideBall,
    (Isometry3::<f64>::identity(), UnitQuaternion::<f64>::identity()), [
    coordinates(base: Pose, ball: Rotation),
    body(hull, pose = base, mass = 2, center_of_mass = [0.1, 0, 0.2], inertia = [1, 1, 0.5]),
    body(arm, parent = hull, position = [0.3, 0, 0], rotation = ball, mass = 1, center_of_mass = [0, 0.1, 0.3],
         inertia = [0.5, 0.5, 0.2])
] [armature(base = 0.2, ball = a)] [
    body(heavy, pose = base, mass = 0.2, inertia = [0.2, 0.2, 0.2]),
    force(lift, body = heavy, value = [0, 0, 0.2 * g], axes = observer),
    body(ring, rotation = ball, mass = 0, inertia = [a, a, a])
]);

// A coordinate that moves a free body: it floats no more.
pair!(of_what_floats: GearedCart BesideCart, SVector::from([0.3, 1.0, -0.4]), [
    coordinates(x, y, turn),
    body(cart, position = [x, 0, y], mass = 2, inertia = [0, 0, 0]),
    body(pole, parent = cart, rotation = rotation_y(turn), mass = 1, center_of_mass = [0, 0, 0.3], inertia = [0.5, 0.5, 0.2])
] [armature(x = a)] [particle(mass = a, position = [x, 0, 0])]);

// Inertia of its own is all that some coordinates have.
pair!(of_rotors_alone: GearedRotor BesideRotor, SVector::from([0.3, -0.4, 0.2]), [
    linearize, regressor,
    coordinates(x, y, turn),
    body(b0, rotation = rotation_z(x), mass = 2, center_of_mass = [0.1, 0, 0.2], inertia = [1, 1, 0.5]),
    spring(shaft, along = y - x, stiffness = 3, damping = 0.1),
    constraint(velocity = rate(turn) + y * rate(y))
] [armature(y = a, turn = 0.1)] [
    particle(mass = a, position = [y, 0, 0]), particle(mass = 0.1, position = [turn, 0, 0])
]);

pair!(of_balls_alone: GearedSphere BesideSphere,
    (UnitQuaternion::<f64>::identity(), SVector::from([0.3])), [
    coordinates(ball: Rotation, x),
    particle(mass = 2, position = [x, 0, 0]),
    damping = 0.5 * x * x * dot(ball.body_angular_velocity, ball.body_angular_velocity)
] [armature(ball = a)] [body(ring, rotation = ball, mass = 0, inertia = [a, a, a])]);

/// A shaft between two rotors: nothing here has a place.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(motor, wheel),
    armature(motor = a, wheel = b),
    spring(shaft, along = wheel - motor, stiffness = 3, damping = 0.1),
    input(torque),
    drive(motor = torque),
)]
struct Drive {
    a: f64,
    b: f64,
}

/// An armature of a coordinate beside those of a chart.
#[derive(GaussDynamics)]
#[gauss(motion = free, chart = left_invariant, coordinates(wheel), armature(wheel = a))]
struct Craft {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    i: Vector3<f64>,
    a: f64,
}

#[test]
fn rotors_without_bodies() {
    let drive = Drive { a: 2.0, b: 0.5 }.kernel().unwrap();
    let (q, z, u) = (SVector::from([0.25, 0.5]), SVector::from([1.0, -1.0]), SVector::from([4.0]));
    let shaft = 3.0 * 0.25 - 0.1 * 2.0;
    let expected = SVector::from([(4.0 + shaft) / 2.0, -shaft / 0.5]);
    // A few roundings of numbers of order 1.
    assert!((drive.acceleration(0.0, &q, &z, &u) - expected).amax() < 4e-15);
    let energy = 0.5 * (2.0 + 0.5) + 0.5 * 3.0 * 0.0625;
    assert!((drive.energy(0.0, &q, &z) - energy).abs() < 4e-15);
    let refused = Drive { a: 2.0, b: 0.0 }.kernel().unwrap_err();
    let found = refused.violations()[0];
    assert_eq!((found.field, found.rule), ("b", Rule::RegularSum));
    assert!(refused.to_string().contains("the mass matrix is singular"), "{refused}");
    assert_eq!(Drive { a: -2.0, b: 0.0 }.kernel().unwrap_err().violations()[0].rule, Rule::NonNegative);
    let craft = |a: f64| Craft { m: 1.0, i: Vector3::new(1.0, 1.0, 1.0), a }.kernel();
    assert!(craft(0.1).is_ok());
    assert_eq!(craft(0.0).unwrap_err().violations()[0].rule, Rule::RegularSum);
}

/// Where a body turns as well, an armature of zero is none.
#[test]
fn armatures_of_zero() {
    let [a, g] = [Bounded::from_f64(0.0), Bounded::from_f64(9.81)];
    assert!(GearedPlane { a, g }.kernel().is_ok());
    assert!(GearedRotor { a, g }.kernel().is_err());
}

// So many joints that they are eliminated link by link.
pair!(of_a_long_chain: GearedChain BesideChain, SVector::from([0.3, -0.4, 0.2, 0.1, 0.5, -0.3]), [
    linearize,
    coordinates(a0, a1, a2, a3, a4, a5),
    body(b0, rotation = rotation_z(a0), mass = 2, center_of_mass = [0.1, 0, 0.2], inertia = [1, 1, 0.5]),
    body(b1, parent = b0, position = [0.3, 0, 0], rotation = rotation_y(a1), mass = 1, center_of_mass = [0, 0.1, 0.3],
         inertia = [0.5, 0.5, 0.2]),
    body(b2, parent = b1, position = [0, 0, 0.5], rotation = rotation_x(a2), mass = 0.5, center_of_mass = [0, 0.1, 0.3],
         inertia = [0.2, 0.3, 0.2]),
    body(b3, parent = b2, position = [0, 0, 0.5], rotation = rotation_y(a3), mass = 0.5, center_of_mass = [0, 0.1, 0.3],
         inertia = [0.2, 0.3, 0.2]),
    body(b4, parent = b3, position = [0, 0, 0.5], rotation = rotation_x(a4), mass = 0.5, center_of_mass = [0, 0.1, 0.3],
         inertia = [0.2, 0.3, 0.2]),
    body(b5, parent = b4, position = [0, 0, 0.5], rotation = rotation_z(a5), mass = 0.5, center_of_mass = [0, 0.1, 0.3],
         inertia = [0.2, 0.3, 0.2])
] [armature(a0 = 0.1, a1 = a, a2 = 0.2, a3 = a, a4 = 0.1, a5 = a)] [
    particle(mass = 0.1, position = [a0, 0, 0]), particle(mass = a, position = [a1, 0, 0]),
    particle(mass = 0.2, position = [a2, 0, 0]), particle(mass = a, position = [a3, 0, 0]),
    particle(mass = 0.1, position = [a4, 0, 0]), particle(mass = a, position = [a5, 0, 0])
]);

/// Derivatives, too: by recursion over the links where there are armatures, by another way where particles share the
/// speeds.
#[test]
fn derivatives_of_a_long_chain() {
    let [a, g] = [Bounded::from_f64(0.3), Bounded::from_f64(9.81)];
    let (geared, beside) = (GearedChain { a, g }.kernel().unwrap(), BesideChain { a, g }.kernel().unwrap());
    let mut random = Random(9);
    for _ in 0..4 {
        let mut draw = || SVector::<Bounded, 6>::from([(); 6].map(|()| Bounded::from_f64(random.number())));
        let (q, z) = (draw(), draw());
        let [ours, theirs] = [
            geared.linearize(Bounded::zero(), &q, &z, &()).by_state,
            beside.linearize(Bounded::zero(), &q, &z, &()).by_state,
        ];
        equal("derivatives", ours.as_slice(), theirs.as_slice()).unwrap();
        assert!(ours.iter().all(|x| x.bound < 1e-8 * (1.0 + x.value.abs())));
    }
}

/// A wheel that nothing but friction brakes.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(turn),
    body(wheel, rotation = rotation_z(turn), mass = 1, inertia = [1, 1, j]),
    armature(turn = 0.5),
    friction(bearing, along = turn, viscous = d, dry = f, width = w),
    friction(oil, along = turn, viscous = 0.25),
)]
struct Wheel {
    j: f64,
    d: f64,
    f: f64,
    w: f64,
}

#[test]
fn friction_is_what_its_law_says() {
    let wheel = Wheel { j: 1.5, d: 0.5, f: 2.0, w: 0.1 }.kernel().unwrap();
    let q = SVector::from([0.3]);
    for rate in [-3.0_f64, -0.1, 0.0, 0.05, 1.0] {
        let z = SVector::from([rate]);
        let dry = 2.0 * rate / (rate * rate + 0.01).sqrt();
        // A few roundings of numbers of order 1.
        let expected = -(0.75 * rate + dry) / 2.0;
        assert!((wheel.acceleration(0.0, &q, &z, &())[0] - expected).abs() < 1e-15);
        let power = wheel.power("bearing", 0.0, &q, &z, &()).unwrap();
        assert!((power + (0.5 * rate + dry) * rate).abs() < 4e-15 && power <= 0.0);
    }
    // At the width it is 1/√2 of what it is far beyond.
    let at_width = wheel.power("bearing", 0.0, &q, &SVector::from([0.1]), &()).unwrap();
    assert!((at_width + 0.1 * (0.05 + 2.0 / 2.0_f64.sqrt())).abs() < 1e-15);
    assert_eq!(WheelKernel::SMOOTHNESS, Smoothness::Smooth);
}

#[test]
fn constants_are_checked() {
    let refused = Wheel { j: 1.5, d: -0.5, f: -2.0, w: 0.0 }.kernel().unwrap_err();
    let violations: Vec<&str> = refused.violations().iter().map(|violation| violation.field).collect();
    assert_eq!(violations, ["f", "w"]);
    let damping = Wheel { j: 1.5, d: -0.5, f: 2.0, w: 0.1 };
    assert_eq!(damping.warnings().into_iter().count(), 1);
}
