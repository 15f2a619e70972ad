//! `kernel()` of systems refuses what no body, spring or stop has, and accepts bodies without mass where others make up
//! for it; `warnings()` of every struct says what is likely not meant.

use gauss_runtime::error::{Finding, ParameterError, ParameterWarnings, Rule, Violation};
use gauss_runtime::prelude::*;

fn body(mass: f64, inertia: Matrix3<f64>) -> RigidBody<f64> {
    RigidBody { mass, center_of_mass: Vector3::zeros(), inertia }
}

fn diagonal(moments: [f64; 3]) -> Matrix3<f64> {
    Matrix3::from_diagonal(&Vector3::from(moments))
}

fn first<K>(kernel: Result<K, ParameterError>) -> Violation {
    kernel.err().expect("refused").violations()[0]
}

/// A hinge: only the moment about k₃ enters.
#[derive(GaussDynamics)]
#[gauss(coordinates(a), body(arm, rotation = rotation_z(a)))]
struct Hinge {
    #[gauss(body)]
    arm: RigidBody<f64>,
}

#[test]
fn jointed_bodies_are_bodies() {
    let hinge = |inertia: Matrix3<f64>| Hinge { arm: body(1.0, inertia) }.kernel();
    assert!(hinge(diagonal([1.0, 1.0, 1.0])).is_ok());
    // Nothing but the moment that enters: the others are not stated.
    assert!(hinge(diagonal([0.0, 0.0, 5.0])).is_ok());
    assert_eq!(first(hinge(diagonal([1.0, 1.0, -1.0]))).rule, Rule::PositiveDefiniteInertia);
    // Of moments that do not enter nothing is asked.
    assert!(hinge(diagonal([-1.0, 1.0, 1.0])).is_ok() && hinge(diagonal([1.0, 1.0, 3.0])).is_ok());
    let mut skew = diagonal([1.0, 1.0, 1.0]);
    skew[(0, 1)] = 0.1;
    assert_eq!(first(hinge(skew)).rule, Rule::SymmetricInertia { row: 0, col: 1 });
    // About the centre of mass, off the axis.
    let arm = |c: [f64; 3], inertia| RigidBody { mass: 1.0, center_of_mass: Vector3::from(c), inertia };
    let off = |c, moments| Hinge { arm: arm(c, diagonal(moments)) }.kernel();
    assert!(off([1.0, 0.0, 0.0], [0.0, 0.0, 1.1]).is_ok());
    assert_eq!(first(off([1.0, 0.0, 0.0], [0.0, 0.0, 0.9])).rule, Rule::InertiaAboutCenterOfMass);
    assert_eq!(first(off([1.0, 0.0, 0.0], [1.5, 0.9, 0.9])).rule, Rule::InertiaAboutCenterOfMass);
    assert!(off([1.0, 0.0, 0.0], [0.5, 0.9, 1.1]).is_ok());
    // Along the axis, where its place does not matter unless more is stated.
    assert!(off([0.0, 0.0, 1.0], [0.0, 0.0, 0.1]).is_ok());
}

/// A uniform rod of length 1 about its end: the number is its moment about the normal of the plane.
macro_rules! pendulum {
    ($name:ident [$($clause:tt)*] $inertia:ty) => {
        #[derive(GaussDynamics)]
        #[gauss($($clause)*)]
        struct $name {
            #[gauss(mass)]
            m: f64,
            #[gauss(center_of_mass)]
            c: Vector3<f64>,
            #[gauss(inertia)]
            j: $inertia,
            #[gauss(gravity)]
            g: Vector3<f64>,
        }
    };
}

pendulum!(InPlane [motion = planar] f64);
pendulum!(InPlaneByMoments [motion = planar] Vector3<f64>);
pendulum!(OnHinge [coordinates(s), body(rotation = rotation_z(s))] f64);
pendulum!(OnHingeByTensor [coordinates(s), body(rotation = rotation_z(s))] Matrix3<f64>);
pendulum!(OnTurnedHinge [coordinates(s), body(rotation = rotation_x(-pi / 2) * rotation_y(s))] Vector3<f64>);
pendulum!(OnUpper [
    coordinates(a, s),
    particle(mass = m, position = [0, 0, a]),
    body(position = [0, 0, a], rotation = rotation_z(s)),
] Matrix3<f64>);

/// The same with all in its clause.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(s),
    body(rod, rotation = rotation_z(s), mass = m, center_of_mass = [l / 2, 0, 0], inertia = m * l * l / 3),
    gravity = [0, -9.81, 0],
)]
struct ByClause {
    m: f64,
    l: f64,
}

#[test]
fn a_rod_swings_in_a_plane() {
    let (m, c, g, moment) = (1.0, Vector3::new(0.5, 0.0, 0.0), Vector3::new(0.0, -9.81, 0.0), 1.0 / 3.0);
    // θ̈ = −(3 g/2 l) cos θ.
    let (s, rate) = (0.3_f64, 0.7);
    let expected = -1.5 * 9.81 * s.cos();
    let near = |found: f64, what: &str| assert!((found - expected).abs() <= 1e-14 * expected.abs(), "{what}: {found}");
    let (q, z) = (SVector::from([s]), SVector::from([rate]));
    let hinge = OnHinge { m, c, j: moment, g }.kernel().expect("a rod");
    near(hinge.acceleration(0.0, &q, &z, &())[0], "a hinge");
    near(ByClause { m, l: 1.0 }.kernel().expect("a rod").acceleration(0.0, &q, &z, &())[0], "a clause");
    // Whatever is given of the other moments.
    for (a, b) in [(0.0, 0.0), (0.0, moment), (moment, 0.0), (5.0, -1.0)] {
        let j = diagonal([a, b, moment]);
        let kernel = OnHingeByTensor { m, c, j, g }.kernel().expect("a rod");
        near(kernel.acceleration(0.0, &q, &z, &())[0], "a tensor");
        let kernel = OnUpper { m, c, j, g }.kernel().expect("a rod");
        let (q, z) = (SVector::from([0.2, s]), SVector::from([0.1, rate]));
        near(kernel.acceleration(0.0, &q, &z, &())[1], "a carried rod");
        assert!(kernel.acceleration(0.0, &q, &z, &())[0].abs() <= 1e-15);
        let j = Vector3::new(a, moment, b);
        assert!(OnTurnedHinge { m, c, j, g }.kernel().is_ok(), "a turned hinge: {a} {b}");
        let j = Vector3::new(a, b, moment);
        assert!(InPlaneByMoments { m, c, j, g }.kernel().is_ok(), "in a plane: {a} {b}");
    }
    let pose = Isometry2::new(Vector2::zeros(), s);
    let kernel = InPlane { m, c, j: moment, g }.kernel().expect("a rod");
    let rest = kernel.acceleration(0.0, &pose, &Vector3::zeros(), &());
    assert!((rest[2]).abs() <= 1e-14, "it falls and does not turn: {rest}");
    // The moment about the centre of mass given in its place, and none.
    let short = InPlane { m, c, j: 1.0 / 12.0, g }.kernel();
    assert_eq!(first(short).rule, Rule::InertiaAboutCenterOfMass);
    assert_eq!(first(OnHinge { m, c, j: -1.0, g }.kernel()).rule, Rule::PositiveDefiniteInertia);
}

/// The triangle inequality is waived for one of the two.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b, c),
    body(upper, rotation = rotation_z(a) * rotation_x(c)),
    body(lower, parent = upper, position = [1, 0, 0], rotation = rotation_z(b)),
    waive(triangle_inequality = lower),
)]
struct Formal {
    #[gauss(body)]
    upper: RigidBody<f64>,
    #[gauss(body)]
    lower: RigidBody<f64>,
}

/// For all of them, in a chart.
#[derive(GaussDynamics)]
#[gauss(waive(triangle_inequality))]
struct FormalTop {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    i: Vector3<f64>,
}

#[test]
fn triangle_inequalities_are_waived_by_name() {
    let (well, formal) = (diagonal([1.0, 1.0, 1.0]), diagonal([1.0, 1.0, 3.0]));
    let arms = |upper, lower| Formal { upper: body(1.0, upper), lower: body(1.0, lower) }.kernel();
    assert!(arms(well, formal).is_ok());
    let refused = first(arms(formal, formal));
    assert_eq!(refused.field, "upper.inertia");
    assert!(refused.to_string().contains("waive(triangle_inequality)"), "{refused}");
    assert_eq!(first(arms(well, diagonal([1.0, -1.0, 3.0]))).rule, Rule::PositiveDefiniteInertia);
    let top = |i| FormalTop { m: 1.0, i: Vector3::from(i) }.kernel();
    assert!(top([1.0, 1.0, 4.0]).is_ok());
    assert_eq!(first(top([1.0, 1.0, 0.0])).rule, Rule::PositiveDefiniteInertia);
}

/// A steered wheel on a massless fork, on a car that slides along a line.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, steer, roll),
    body(car, position = [x, 0, 0]),
    body(fork, parent = car, rotation = rotation_z(steer)),
    body(wheel, parent = fork, rotation = rotation_y(roll)),
)]
struct Car {
    #[gauss(body)]
    car: RigidBody<f64>,
    #[gauss(body)]
    fork: RigidBody<f64>,
    #[gauss(body)]
    wheel: RigidBody<f64>,
}

#[test]
fn bodies_without_mass_move_with_others() {
    let none = Matrix3::zeros();
    let disk = diagonal([0.1, 0.2, 0.1]);
    let car = |car: (f64, Matrix3<f64>), fork: (f64, Matrix3<f64>), wheel: (f64, Matrix3<f64>)| {
        Car { car: body(car.0, car.1), fork: body(fork.0, fork.1), wheel: body(wheel.0, wheel.1) }.kernel()
    };
    let kernel = car((3.0, none), (0.0, none), (1.0, disk)).expect("a massless fork");
    // The wheel alone is steered: ż = (0, M/C, 0) by hand.
    let q = SVector::from([0.3, 0.7, -0.4]);
    let z = SVector::from([0.1, -0.2, 0.5]);
    assert!(kernel.acceleration(0.0, &q, &z, &()).iter().all(|a| a.is_finite()));
    assert_eq!(kernel.mass_matrix(0.0, &q)[(0, 0)], 4.0);
    assert!((kernel.mass_matrix(0.0, &q)[(1, 1)] - 0.1).abs() < 1e-16);
    // A rotor: inertia without mass.
    assert!(car((3.0, none), (0.0, none), (0.0, disk)).is_ok());
    // Nothing resists steering, rolling, sliding.
    let particle = (1.0, none);
    let found = first(car((3.0, none), (0.0, none), particle));
    assert_eq!((found.field, found.rule), ("fork.mass", Rule::RegularSum));
    assert!(found.to_string().contains("singular"), "{found}");
    let rod = (1.0, diagonal([0.1, 0.0, 0.1]));
    assert_eq!(first(car((3.0, none), (0.0, none), rod)).rule, Rule::RegularSum);
    assert_eq!(first(car((0.0, none), (0.0, none), (0.0, disk))).rule, Rule::RegularSum);
    assert_eq!(first(car((3.0, none), (-1.0, none), (1.0, disk))).rule, Rule::PositiveMass);
}

/// A thin rod on a universal joint cannot spin about itself; a free one can.
#[derive(GaussDynamics)]
#[gauss(coordinates(a, b), body(rod, rotation = rotation_x(a) * rotation_y(b), mass = m, inertia = [i, i, 0]))]
struct Rod {
    m: f64,
    i: f64,
}

#[derive(GaussDynamics)]
#[gauss(coordinates(pose: Pose), body(rod, position = pose.position, rotation = pose.rotation))]
struct FreeRod {
    #[gauss(body)]
    rod: RigidBody<f64>,
}

#[test]
fn rods_and_plates_are_bodies() {
    assert!(Rod { m: 1.0, i: 0.1 }.kernel().is_ok());
    assert_eq!(first(Rod { m: 1.0, i: -0.1 }.kernel()).rule, Rule::PositiveDefiniteInertia);
    assert!(FreeRod { rod: body(1.0, diagonal([0.1, 0.1, 0.2])) }.kernel().is_ok());
    assert_eq!(first(FreeRod { rod: body(1.0, diagonal([0.1, 0.1, 0.0])) }.kernel()).rule, Rule::RegularSum);
}

/// A particle on a spring between stops.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    particle(mass = m, position = [x, 0, 0]),
    spring(coil, along = x, stiffness = k, damping = c),
    stop(buffer, along = x, least = a, most = b, stiffness = 2 * s, width = e, damping = 0.1),
)]
struct Buffered {
    m: f64,
    k: f64,
    c: f64,
    a: f64,
    b: f64,
    s: f64,
    e: f64,
}

fn buffered(spoil: impl FnOnce(&mut Buffered)) -> Buffered {
    let mut buffered = Buffered { m: 1.0, k: 2.0, c: 0.1, a: -1.0, b: 1.0, s: 100.0, e: 1e-3 };
    spoil(&mut buffered);
    buffered
}

#[test]
fn springs_and_stops_are_checked() {
    assert!(buffered(|_| {}).kernel().is_ok() && buffered(|_| {}).warnings().is_empty());
    let found = |spoil: fn(&mut Buffered)| {
        let found = first(buffered(spoil).kernel());
        (found.field, found.value, found.rule)
    };
    assert_eq!(found(|b| b.k = -1.0), ("k", -1.0, Rule::NonNegativeStiffness));
    assert_eq!(found(|b| b.s = -1.0), ("buffer.stiffness", -2.0, Rule::NonNegativeStiffness));
    assert_eq!(found(|b| b.e = 0.0), ("e", 0.0, Rule::PositiveWidth));
    assert_eq!(found(|b| b.e = -1.0), ("e", -1.0, Rule::PositiveWidth));
    assert_eq!(found(|b| b.a = 2.0), ("a", 2.0, Rule::LimitsInOrder { most: 1.0 }));
    assert_eq!(found(|b| b.c = f64::NAN).2, Rule::Finite);
    assert_eq!(found(|b| b.m = 0.0), ("m", 0.0, Rule::RegularSum));
    let findings = |b: Buffered| b.warnings().into_iter().map(|w| (w.field, w.finding)).collect::<Vec<_>>();
    assert_eq!(findings(buffered(|b| b.c = -0.1)), [("c", Finding::DampingFeedsEnergy)]);
}

/// A spring with a damper is one element, whose power is that of both.
#[test]
fn a_spring_with_a_damper_is_one_element() {
    let names: Vec<_> = BufferedKernel::ELEMENTS.iter().map(|element| element.to_string()).collect();
    let with_damper = ["coil", "buffer"].map(|name| format!("{name} (in the potential energy, with a damper)"));
    assert_eq!(names, with_damper);
    let kernel = buffered(|_| {}).kernel().expect("buffered");
    let (x, v) = (0.5, 0.25);
    let (q, z) = (SVector::from([x]), SVector::from([v]));
    let power = kernel.power("coil", 0.0, &q, &z, &()).expect("the spring");
    assert!((power - (-2.0 * x * v - 0.1 * v * v)).abs() < 1e-15, "{power}");
    // The damper of the buffer is out of reach: its share is (dx/ds)² of 1e-12.
    let supplied = kernel.supplied_power(0.0, &q, &z, &());
    assert!((supplied + 0.1 * v * v).abs() < 1e-10, "{supplied}");
}

#[derive(GaussDynamics)]
#[gauss(
    coordinates(a), body(rod, position = [1, 0, 0], rotation = rotation_z(a), mass = 1, inertia = [1, 1, 1]),
    damping = c * rod.angular_velocity.z * rate(a) / 2, central_gravity(sun, mu = mu),
)]
struct Suspicious {
    #[gauss(gravity)]
    g: f64,
    c: f64,
    mu: f64,
}

#[derive(GaussDynamics)]
struct Hull {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    i: Vector3<f64>,
    #[gauss(added_mass)]
    added: Vector6<f64>,
}

/// As `main` would be: the sentences are what is printed.
fn told(warnings: ParameterWarnings) -> Vec<String> {
    let mut lines = Vec::new();
    for warning in warnings {
        lines.push(warning.to_string());
    }
    lines
}

#[test]
fn what_is_likely_not_meant_is_told() {
    let of = |g, c, mu| told(Suspicious { g, c, mu }.warnings());
    assert_eq!(of(9.81, 0.1, 1.0), [""; 0]);
    let [center, damping, gravity] = &of(-9.81, -0.1, -1.0)[..] else { panic!("{:?}", of(-9.81, -0.1, -1.0)) };
    assert!(damping.starts_with("damping feeds energy: `damping` is -"), "{damping}");
    assert!(center.starts_with("`mu` is -1: a center"), "{center}");
    assert!(gravity.starts_with("`g` is -9.81: a gravity of one number is how fast things fall"), "{gravity}");
    // The sign of SNAME's derivatives.
    let hull =
        |x: f64| Hull { m: 30.0, i: Vector3::new(0.2, 3.5, 3.5), added: Vector6::new(x, 3.0, 3.0, 0.0, 0.0, 0.0) };
    assert!(hull(0.9).warnings().is_empty());
    let [sign] = &told(hull(-0.9).warnings())[..] else { panic!() };
    assert!(sign.starts_with("`added` has -0.9 on its diagonal") && sign.contains("−X_u̇"), "{sign}");
    assert!(first(hull(-40.0).kernel()).to_string().contains("added mass is minus the derivatives"));
}

#[test]
fn errors_read_well_out_of_main() {
    let error =
        Hull { m: -1.0, i: Vector3::new(1.0, 1.0, 1.0), added: Vector6::zeros() }.kernel().expect_err("refused");
    assert_eq!(format!("{error:?}"), error.to_string());
    assert!(format!("{error:?}").starts_with("`m` is -1: a mass must be greater than 0"));
}
