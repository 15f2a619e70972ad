//! Poses, twists, Jacobians and accelerations of frames against dual numbers through poses and twists, in every kind of
//! scene: two ways to each number, equal up to the bounds that both carry on their own rounding.

use crate::common::Bounded;
use crate::common::agreement::equal;
use crate::common::body::{Parts, cross, list, speeds};
use crate::common::dual::Dual;
use crate::common::groups::{Random, random_configuration};
use gauss_runtime::frames::{FramePose, in_frames_axes, in_observers_axes, moved_to};
use gauss_runtime::prelude::*;

type Moving = Dual<Bounded>;

fn moving(values: &[Bounded], rates: &[Bounded]) -> Vec<Moving> {
    values.iter().zip(rates).map(|(&value, &rate)| Dual::new(value, rate)).collect()
}

fn values(duals: &[Moving]) -> Vec<Bounded> {
    duals.iter().map(|x| x.value).collect()
}

fn rates<const N: usize>(duals: [Moving; N]) -> [Bounded; N] {
    duals.map(|x| x.rate)
}

/// J times a vector.
fn product<J: std::ops::Index<(usize, usize), Output = Bounded>>(jacobian: &J, z: &[Bounded]) -> Vec<Bounded> {
    (0..6).map(|i| z.iter().enumerate().fold(Bounded::zero(), |sum, (k, &z)| sum + jacobian[(i, k)] * z)).collect()
}

fn sums(a: &[Bounded], b: &[Bounded]) -> Vec<Bounded> {
    a.iter().zip(b).map(|(&a, &b)| a + b).collect()
}

/// Along a motion with any ż: the twist is the rate of the pose, the acceleration that of the twist.
fn check<C, B, D>(origin: &C, bounded: &B, dual: &D)
where
    C: Configuration<Scalar = f64> + Parts<f64>,
    B: JacobianRates<Scalar = Bounded, Configuration: Parts<Bounded>>,
    D: JacobianRates<Scalar = Moving, Configuration: Parts<Moving>, Frame = B::Frame>,
{
    let mut random = Random(11);
    let mut told = 0;
    let mut all = 0;
    for _ in 0..8 {
        let q: B::Configuration = random_configuration(origin, &mut random);
        let mut draw = |n: usize| -> Vec<Bounded> { (0..n).map(|_| Bounded::from_f64(random.number())).collect() };
        let (z, acceleration, t) = (draw(B::DOF), draw(B::DOF), draw(1)[0]);
        let (speeds_now, still): (B::Speeds, B::Speeds) = (speeds(&z), speeds(&vec![Bounded::zero(); B::DOF]));
        let velocity = q.rates(&bounded.kinematics(t, &q, &speeds_now));
        let moving_q = D::Configuration::assemble(&moving(&q.parts(), &velocity));
        let moving_z: D::Speeds = speeds(&moving(&z, &acceleration));
        let moving_t = Dual::new(t, Bounded::one());
        let together = bounded.frames(t, &q, &speeds_now);
        for &frame in B::Frame::ALL {
            let what = |part: &str| format!("{part} of {}", frame.name());
            let pose = bounded.pose_of(frame, t, &q);
            let twist = bounded.twist_of(frame, t, &q, &speeds_now);
            let moved = dual.pose_of(frame, moving_t, &moving_q);
            let entries = |m: &SMatrix<Moving, 3, 3>, row: usize| [0, 1, 2].map(|k| m[(row, k)]);
            let matrix = moved.rotation.matrix();
            equal(&what("position"), &list(&pose.translation.vector), &values(&moved.translation.vector.data.0[0]))
                .unwrap();
            // ḃ = R u, Ṙ = R [ω]×: each row of Ṙ is −ω × that of R.
            let observed = in_observers_axes(&pose, &twist);
            let rate = rates(moved.translation.vector.data.0[0]);
            equal(&what("velocity"), &list(&observed)[..3], &rate).unwrap();
            let omega = [twist[3], twist[4], twist[5]];
            for row in 0..3 {
                let turned = cross([0, 1, 2].map(|k| pose.rotation.matrix()[(row, k)]), omega);
                equal(&what("angular velocity"), &turned, &rates(entries(matrix, row))).unwrap();
            }
            // Back in the axes of the frame it is the same, as far as R is a rotation.
            equal(&what("axes"), &list(&in_frames_axes(&pose, &observed)), &list(&twist)).unwrap();
            let jacobian = bounded.jacobian_of(frame, t, &q);
            let guided = bounded.twist_of(frame, t, &q, &still);
            equal(&what("J z"), &sums(&product(&jacobian, &z), &list(&guided)), &list(&twist)).unwrap();
            // a = u̇ + ω × u, and ω̇.
            let moved_twist = dual.twist_of(frame, moving_t, &moving_q, &moving_z).data.0[0];
            let [u1, u2, u3, w1, w2, w3] = rates(moved_twist);
            let turning = cross(omega, [twist[0], twist[1], twist[2]]);
            let expected = [u1 + turning[0], u2 + turning[1], u3 + turning[2], w1, w2, w3];
            let bias = bounded.bias_of(frame, t, &q, &speeds_now);
            let found = sums(&product(&jacobian, &acceleration), &list(&bias));
            equal(&what("acceleration"), &found, &expected).unwrap();
            // J̇ is the rate of J as the observer sees it: of each column that of its components, and ω × both parts.
            let rate = bounded.jacobian_rate_of(frame, t, &q, &speeds_now);
            let moved_jacobian = dual.jacobian_of(frame, moving_t, &moving_q);
            for k in 0..B::DOF {
                let column = [0, 1, 2, 3, 4, 5].map(|i| moved_jacobian[(i, k)]);
                let turned = |first: usize| cross(omega, [0, 1, 2].map(|i| column[first + i].value));
                let expected = sums(&rates(column), &[turned(0), turned(3)].concat());
                equal(&what("J̇"), &[0, 1, 2, 3, 4, 5].map(|i| rate[(i, k)]), &expected).unwrap();
            }
            let size = expected.iter().fold(1.0_f64, |m, x| m.max(x.value.abs()));
            told += usize::from(found.iter().chain(&expected).all(|x| x.bound <= 1e-10 * size));
            all += 1;
            // All at once says the same.
            let at_once = &together[frame];
            equal(&what("twist at once"), &list(&at_once.twist), &list(&twist)).unwrap();
            equal(&what("bias at once"), &list(&at_once.bias), &list(&bias)).unwrap();
            for k in 0..B::DOF {
                let column = |j: &B::Jacobian| [0, 1, 2, 3, 4, 5].map(|i| j[(i, k)]);
                equal(&what("J at once"), &column(&at_once.jacobian), &column(&jacobian)).unwrap();
            }
            let rows = |pose: &FramePose<Bounded>| {
                [&list(&pose.translation.vector)[..], pose.rotation.matrix().as_slice()].concat()
            };
            equal(&what("pose at once"), &rows(&at_once.pose), &rows(&pose)).unwrap();
        }
    }
    assert!(10 * told >= 9 * all, "only {told} of {all} accelerations are known to 1e-10");
}

fn rigid<T: Real>(mass: f64, x: f64) -> RigidBody<T> {
    let number = T::from_f64;
    RigidBody {
        mass: number(mass),
        center_of_mass: Vector3::new(number(x), number(0.1), number(-0.05)),
        inertia: Matrix3::from_fn(|i, k| number(if i == k { 1.7 } else { 0.1 })),
    }
}

/// Elements of both groups, a joint with a given motion, and frames on the way and at the end.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(s, base: Pose, wheel: Rotation, elbow),
    speeds(u: Vector3, w: Vector3, v, spin: Vector3, bend),
    kinematics(
        base = twist(u + cross([0, s, 0.2], w), w), s = 2 * v - bend, wheel = spin + inverse(wheel) * [v, 0, 0],
        elbow = bend + s * v + sin(t)
    ),
    body(hull, position = base.position, rotation = base.rotation),
    body(rotor, parent = hull, position = [0.2, 0, s], rotation = wheel),
    frame(moved, parent = rotor, position = [0.1 * sin(t), cos(elbow), 0.3], rotation = rotation_x(t) * rotation_z(0.3)),
    body(arm, parent = moved, position = [l, 0, 0], rotation = rotation_y(elbow)),
    frame(tool, parent = arm, position = [0, l, 0.5], rotation = rotation_z(pi / 2) * rotation_x(0.4)),
    frames(tool, hull, moved, arm, rotor),
    methods(jacobian_rates),
)]
struct Gyrostat<T> {
    #[gauss(body)]
    hull: RigidBody<T>,
    #[gauss(body)]
    rotor: RigidBody<T>,
    #[gauss(body)]
    arm: RigidBody<T>,
    l: T,
    #[gauss(gravity)]
    g: T,
}

impl<T: Real> Gyrostat<T> {
    fn sample() -> Self {
        let (hull, rotor, arm) = (rigid(2.0, 0.3), rigid(1.0, -0.1), rigid(0.5, 0.2));
        Self { hull, rotor, arm, l: T::from_f64(0.4), g: T::from_f64(9.81) }
    }
}

macro_rules! both {
    ($name:ident) => {
        (&$name::<Bounded>::sample().kernel().unwrap(), &$name::<Moving>::sample().kernel().unwrap())
    };
}

#[test]
fn groups_quasi_velocities_and_given_motions() {
    let origin = (Isometry3::<f64>::identity(), (UnitQuaternion::<f64>::identity(), SVector::from([0.4, 0.2])));
    let (bounded, dual) = both!(Gyrostat);
    check(&origin, bounded, dual);
}

/// Everything turns about one axis: components are taken in observer's axes within.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, a, b),
    body(cart, position = [x, 0, 0], mass = 3, inertia = [0, 0, 0]),
    body(upper, parent = cart, position = [0, 0, 0.1], rotation = rotation_y(a), mass = 2, center_of_mass = [0, 0, l],
         inertia = [0.5, 0.5, 0.1]),
    body(lower, parent = upper, position = [0, 0, l], rotation = rotation_y(b - t), mass = 1, center_of_mass = [0, 0, l],
         inertia = [0.5, 0.5, 0.1]),
    frame(tip, parent = lower, position = [0.1, 0.2, l * a], rotation = rotation_y(0.3)),
    frames(tip, lower, cart),
    methods(jacobian_rates),
)]
struct Plane<T> {
    l: T,
    #[gauss(gravity)]
    g: T,
}

impl<T: Real> Plane<T> {
    fn sample() -> Self {
        Self { l: T::from_f64(0.4), g: T::from_f64(9.81) }
    }
}

#[test]
fn in_the_plane() {
    let (bounded, dual) = both!(Plane);
    check(&SVector::<f64, 3>::zeros(), bounded, dual);
}

/// One body in a chart, with a frame on it and without.
macro_rules! charted {
    ($test:ident: $alone:ident $fitted:ident, [$($chart:tt)+], $motion:ident, $origin:expr) => {
        charted!(@ $alone [$($chart)+] $motion frames(body), methods(jacobian_rates));
        charted!(@ $fitted [$($chart)+] $motion
            frame(sensor, parent = body, position = [0.3, 0.1 * t, 0.2], rotation = rotation_x(0.5)), frames(sensor, body), methods(jacobian_rates));

        #[test]
        fn $test() {
            let (bounded, dual) = both!($alone);
            check(&$origin, bounded, dual);
            let (bounded, dual) = both!($fitted);
            check(&$origin, bounded, dual);
        }
    };
    (@ $name:ident [$($chart:tt)+] $motion:ident $($frames:tt)+) => {
        #[derive(GaussDynamics)]
        #[gauss(chart = $($chart)+, motion = $motion, mass = 2, center_of_mass = [0.1, 0.2, 0], inertia = [1, 1.2, 1.5], $($frames)+)]
        struct $name<T> {
            #[gauss(gravity)]
            g: T,
        }

        impl<T: Real> $name<T> {
            fn sample() -> Self {
                Self { g: T::from_f64(9.81) }
            }
        }
    };
}

charted!(free_left: FreeLeft FreeLeftSensor, [left_invariant], free, Isometry3::<f64>::identity());
charted!(free_right: FreeRight FreeRightSensor, [right_invariant], free, Isometry3::<f64>::identity());
charted!(free_hybrid: FreeHybrid FreeHybridSensor, [hybrid], free, Isometry3::<f64>::identity());
charted!(free_euler: FreeEuler FreeEulerSensor, [jet(euler_zyx)], free, SVector::<f64, 6>::zeros());
charted!(held_right: HeldRight HeldRightSensor, [right_invariant], fixed_point, UnitQuaternion::<f64>::identity());
charted!(held_jet: HeldJet HeldJetSensor, [jet(modified_rodrigues)], fixed_point, SVector::<f64, 3>::zeros());
charted!(plane_left: PlaneLeft PlaneLeftSensor, [left_invariant], planar, Isometry2::<f64>::identity());
charted!(plane_right: PlaneRight PlaneRightSensor, [right_invariant], planar, Isometry2::<f64>::identity());
charted!(plane_jet: PlaneJet PlaneJetSensor, [jet], planar, SVector::<f64, 3>::zeros());

/// A wrench at a frame, whose six numbers arrive at run time.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(base: Pose, knee),
    body(hull, pose = base, mass = 5, center_of_mass = [0.1, 0, 0], inertia = [1, 1.2, 1.5]),
    body(leg, parent = hull, position = [0.2, 0.1, 0], rotation = rotation_y(knee), mass = 1,
         center_of_mass = [0, 0, -0.2], inertia = [0.1, 0.1, 0.02]),
    frame(foot, parent = leg, position = [0, 0, -0.5], rotation = rotation_x(0.3)),
    frames(foot),
    input(contact: Wrench),
    wrench(ground, body = foot, force = contact.force, torque = contact.torque),
)]
struct Leg<T> {
    #[gauss(gravity)]
    g: T,
}

#[test]
fn wrenches_at_frames_act_by_the_jacobian_and_have_their_power() {
    let kernel = Leg { g: Bounded::from_f64(9.81) }.kernel().unwrap();
    let mut random = Random(2);
    let origin = (Isometry3::<f64>::identity(), SVector::from([0.4]));
    let t = Bounded::zero();
    for _ in 0..8 {
        let q = random_configuration(&origin, &mut random);
        let z = SVector::from([(); 7].map(|()| Bounded::from_f64(random.number())));
        let contact = SVector::from([(); 6].map(|()| Bounded::from_f64(random.number())));
        let jacobian = kernel.jacobian_of(LegFrame::foot, t, &q);
        let paired =
            |column: &[Bounded]| column.iter().zip(contact.iter()).fold(Bounded::zero(), |sum, (&a, &b)| sum + a * b);
        let force = kernel.generalised_force("ground", t, &q, &z, &contact).expect("the ground acts");
        let expected: Vec<Bounded> = (0..7).map(|k| paired(&[0, 1, 2, 3, 4, 5].map(|i| jacobian[(i, k)]))).collect();
        equal("generalised force", &list(&force), &expected).unwrap();
        let power = kernel.power("ground", t, &q, &z, &contact).expect("the ground acts");
        equal("power", &[power], &[paired(&list(&kernel.twist_of(LegFrame::foot, t, &q, &z)))]).unwrap();
    }
}

/// Without `chart` and `motion` the body moves in the chart that is the default, also where frames are asked for.
#[derive(GaussDynamics)]
#[gauss(frames(body), methods(centroidal))]
struct Plain {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    inertia: f64,
}

#[test]
fn asking_for_frames_makes_no_system() {
    let kernel = Plain { m: 2.0, inertia: 1.0 }.kernel().unwrap();
    assert_eq!(PlainKernel::CHART, Chart::LeftInvariant);
    let (q, z) = (Isometry3::translation(1.0, 2.0, 3.0), SVector::from([1.0, 0.0, 0.0, 0.0, 0.0, 2.0]));
    assert_eq!(kernel.twist_of(PlainFrame::body, 0.0, &q, &z), z);
    assert_eq!(kernel.center_of_mass(0.0, &q), Vector3::new(1.0, 2.0, 3.0));
}

/// The frame of the body of a chart is what its pose and its twist are.
#[test]
fn the_body_of_a_chart_is_a_frame() {
    let kernel = FreeHybrid::<f64>::sample().kernel().unwrap();
    let q = Isometry3::new(Vector3::new(0.3, -0.2, 1.0), Vector3::new(0.4, 0.1, -0.7));
    let z = SVector::from([0.3, 1.0, -0.4, 0.2, 0.6, -1.0]);
    let (pose, twist) = (kernel.pose_of(FreeHybridFrame::body, 0.0, &q), kernel.body_twist(0.0, &q, &z));
    assert!((pose.rotation.matrix() - q.rotation.to_rotation_matrix().matrix()).amax() < 1e-15);
    assert_eq!(pose.translation, q.translation);
    assert!((kernel.twist_of(FreeHybridFrame::body, 0.0, &q, &z) - twist).amax() < 1e-15);
}

/// A point at x of a frame has the velocity u + ω × x, and so have the columns of its Jacobian.
#[test]
fn poles_can_be_moved() {
    let twist = Vector6::new(1.0, 2.0, 3.0, 0.5, -0.25, 2.0);
    let at = Vector3::new(-1.0, 4.0, 0.5);
    let moved = moved_to(&at, &twist);
    let (u, w) = (Vector3::new(1.0, 2.0, 3.0), Vector3::new(0.5, -0.25, 2.0));
    assert_eq!(moved, Vector6::from_iterator((u + w.cross(&at)).iter().chain(w.iter()).copied()));
    assert_eq!(moved_to(&-at, &moved), twist);
}

/// Nothing costs anything where nothing is asked for, and what is asked for says what it costs.
#[test]
fn operations_are_counted() {
    let operations = PlaneKernel::<f64>::OPERATIONS;
    let names: Vec<&str> = operations.of_frames.iter().map(|frame| frame.name).collect();
    assert_eq!(names, ["tip", "lower", "cart"]);
    let tip = operations.of_frames[0];
    let apart: u32 = operations
        .of_frames
        .iter()
        .flat_map(|f| [f.pose, f.twist, f.jacobian, f.bias])
        .map(|count| count.total())
        .sum();
    assert!(tip.jacobian.total() > 0 && operations.frames.total() < apart, "{operations}");
    assert!(operations.to_string().contains("\ntip                 pose "), "{operations}");
    assert!(tip.jacobian_rate.total() > tip.bias.total(), "{operations}");
}
