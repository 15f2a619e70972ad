//! The regressor: `Y π − other forces` is the residual, Y does not depend on π, and inverse dynamics gives the forces
//! of a motion.
//!
//! Two ways to each number, equal up to the bounds that both carry on their own rounding.

use crate::common::Bounded;
use crate::common::agreement::equal;
use crate::common::body::{Parts, list, speeds};
use gauss_runtime::prelude::*;
use gauss_tests::random::Random;

/// What a kernel is made of: the same geometry, other masses for each scale.
trait Scene {
    type Kernel: InertialRegressor<Scalar = Bounded, Input: VectorSpace<Bounded>>;
    fn kernel_of(scale: f64) -> Self::Kernel;
    fn configuration(random: &mut Random) -> <Self::Kernel as GaussSystem>::Configuration;
}

/// A unit vector: rounded components stand for exact ones up to their bounds.
fn unit<const N: usize>(random: &mut Random) -> [Bounded; N] {
    let parts: [f64; N] = std::array::from_fn(|k| random.number() + if k + 1 == N { 1.5 } else { 0.0 });
    let norm = parts.iter().map(|x| x * x).sum::<f64>().sqrt();
    parts.map(|x| Bounded::measured(x / norm, 4.0 * f64::EPSILON))
}

fn rotation(random: &mut Random) -> UnitQuaternion<Bounded> {
    UnitQuaternion::assemble(&unit::<4>(random))
}

fn pose(random: &mut Random) -> Isometry3<Bounded> {
    let position: Vector3<Bounded> = random.vector(1.0);
    Isometry3::assemble(&[unit::<4>(random).as_slice(), position.as_slice()].concat())
}

fn plane(random: &mut Random) -> Isometry2<Bounded> {
    let position: SVector<Bounded, 2> = random.vector(1.0);
    Isometry2::assemble(&[unit::<2>(random).as_slice(), position.as_slice()].concat())
}

fn coordinates<const N: usize>(random: &mut Random) -> SVector<Bounded, N> {
    random.vector(1.0)
}

fn number(x: f64) -> Bounded {
    Bounded::from_f64(x)
}

fn vector(scale: f64, values: [f64; 3]) -> Vector3<Bounded> {
    Vector3::from(values.map(|x| number(scale * x)))
}

fn inertia(scale: f64) -> Matrix3<Bounded> {
    let rows = [[1.5, 0.1, -0.2], [0.1, 2.0, 0.15], [-0.2, 0.15, 2.5]];
    Matrix3::from(rows.map(|row| row.map(|x| number(scale * x))))
}

fn rigid(scale: f64, x: f64) -> RigidBody<Bounded> {
    RigidBody {
        mass: number(2.0 * scale),
        center_of_mass: vector(1.0 / scale, [x, 0.1, -0.05]),
        inertia: inertia(scale),
    }
}

type Forces = Vec<Bounded>;

fn times<K: InertialRegressor<Scalar = Bounded>>(y: &K::Regressor, pi: &K::InertialParameters) -> Forces {
    let row =
        |i: usize| (0..K::InertialParameters::DIM).fold(Bounded::zero(), |sum, k| sum + y[(i, k)] * pi.component(k));
    (0..K::DOF).map(row).collect()
}

fn minus(a: &[Bounded], b: &[Bounded]) -> Forces {
    a.iter().zip(b).map(|(a, b)| *a - *b).collect()
}

/// Runs a check at random states: kernel, t, q, z, ż and input.
fn at_random<S: Scene>(
    check: impl Fn(
        &S::Kernel,
        Bounded,
        &<S::Kernel as GaussSystem>::Configuration,
        [&<S::Kernel as GaussSystem>::Speeds; 2],
        &<S::Kernel as GaussSystem>::Input,
    ),
) {
    let mut random = Random(11);
    let kernel = S::kernel_of(1.0);
    for _ in 0..20 {
        let q = S::configuration(&mut random);
        let (z, rate, input) = (random.vector(1.0), random.vector(1.0), random.vector(1.0));
        check(&kernel, number(random.number()), &q, [&z, &rate], &input);
    }
}

/// What holds in every scene.
fn laws<S: Scene>() {
    let heavier = S::kernel_of(1.7);
    let pi = S::kernel_of(1.0).inertial_parameters();
    assert_eq!(S::Kernel::INERTIAL_PARAMETERS.len(), list(&pi).len());
    at_random::<S>(|kernel, t, q, [z, rate], _| {
        let y = kernel.regressor(t, q, z, rate);
        let other = heavier.regressor(t, q, z, rate);
        for i in 0..S::Kernel::DOF {
            for k in 0..S::Kernel::INERTIAL_PARAMETERS.len() {
                // The same instructions on the same numbers.
                assert_eq!(y[(i, k)].value, other[(i, k)].value, "({i}, {k})");
                assert!(S::Kernel::REGRESSOR_PATTERN[i][k] || y[(i, k)].value == 0.0, "({i}, {k})");
            }
        }
    });
}

/// Without constraints all of the residual is there.
fn residuals<S: Scene>() {
    laws::<S>();
    at_random::<S>(|kernel, t, q, [z, rate], input| {
        let forces = times::<S::Kernel>(&kernel.regressor(t, q, z, rate), &kernel.inertial_parameters());
        let found = minus(&forces, &list(&kernel.other_forces(t, q, z, rate, input)));
        equal("residual", &found, &list(&kernel.gauss_residual(t, q, z, rate, input))).unwrap();
        // At the true acceleration the forces are those that act.
        let rate = kernel.acceleration(t, q, z, input);
        let forces = times::<S::Kernel>(&kernel.regressor(t, q, z, &rate), &kernel.inertial_parameters());
        equal("balance", &forces, &list(&kernel.other_forces(t, q, z, &rate, input))).unwrap();
    });
}

/// The constraints J of a system, from its velocities, which are affine in z.
fn jacobian<K>(kernel: &K, t: Bounded, q: &K::Configuration) -> Vec<Vec<Bounded>>
where
    K: ConstrainedSystem<Scalar = Bounded>,
{
    let at = |z: &[Bounded]| list(&kernel.velocity_residual(t, q, &speeds(z)));
    let still = at(&vec![Bounded::zero(); K::DOF]);
    let along = |k: usize| {
        let z: Vec<Bounded> = (0..K::DOF).map(|i| number(if i == k { 1.0 } else { 0.0 })).collect();
        minus(&at(&z), &still)
    };
    (0..K::DOF).map(along).collect()
}

/// With constraints their forces are beside: `Y π = other forces + Jᵀλ`.
fn constrained<S: Scene<Kernel: ConstrainedSystem>>() {
    laws::<S>();
    at_random::<S>(|kernel, t, q, [z, rate], input| {
        let of = |rate: &<S::Kernel as GaussSystem>::Speeds| {
            let forces = times::<S::Kernel>(&kernel.regressor(t, q, z, rate), &kernel.inertial_parameters());
            minus(&forces, &list(&kernel.other_forces(t, q, z, rate, input)))
        };
        // The forces of constraints are the same at every ż.
        let true_rate = kernel.acceleration(t, q, z, input);
        let residual = |rate| list(&kernel.gauss_residual(t, q, z, rate, input));
        let change = minus(&of(rate), &of(&true_rate));
        equal("change", &change, &minus(&residual(rate), &residual(&true_rate))).unwrap();
        let multipliers = list(&kernel.multipliers(t, q, z, input));
        let reactions: Vec<Bounded> = jacobian(kernel, t, q)
            .iter()
            .map(|column| column.iter().zip(&multipliers).fold(Bounded::zero(), |sum, (j, l)| sum + *j * *l))
            .collect();
        equal("forces of constraints", &of(&true_rate), &reactions).unwrap();
    });
}

macro_rules! of_body {
    (
        $test:ident: $name:ident $kernel:ident, [$($clause:tt)+], $configuration:expr,
        { $($(#[$role:meta])* $field:ident: $type:ty = $value:expr,)+ }
    ) => {
        #[derive(GaussDynamics)]
        #[gauss(regressor, $($clause)+)]
        struct $name<T> {
            $($(#[$role])* $field: $type,)+
        }

        impl Scene for $name<()> {
            type Kernel = $kernel<Bounded>;
            fn kernel_of(scale: f64) -> Self::Kernel {
                $name { $($field: $value(scale),)+ }.kernel().unwrap()
            }
            fn configuration(random: &mut Random) -> <Self::Kernel as GaussSystem>::Configuration {
                $configuration(random)
            }
        }

        #[test]
        fn $test() {
            residuals::<$name<()>>();
        }
    };
}

/// A heavy body with drag and a spring.
macro_rules! loaded {
    ($test:ident: $name:ident $kernel:ident, [$($chart:tt)+], $motion:ident, $configuration:expr) => {
        of_body!($test: $name $kernel, [
            chart = $($chart)+,
            motion = $motion,
            input(push: Vector3),
            force(body = body, value = push),
            spring(from = [3, 1, -2], to = body.position + body.rotation * [0.4, 0, 0], stiffness = 4, length = 1),
            drag(linear = [1, 1, 2, 1, 1, 3])
        ], $configuration, {
            #[gauss(mass)] m: T = |s| number(2.0 * s),
            #[gauss(center_of_mass)] c: Vector3<T> = |s: f64| vector(1.0 / s, [0.1, -0.2, 0.05]),
            #[gauss(inertia)] inertia: Matrix3<T> = inertia,
            #[gauss(gravity)] g: T = |_| number(9.81),
        });
    };
}

loaded!(free_left: FreeLeft FreeLeftKernel, [left_invariant], free, pose);
loaded!(free_right: FreeRight FreeRightKernel, [right_invariant], free, pose);
loaded!(free_hybrid: FreeHybrid FreeHybridKernel, [hybrid], free, pose);
loaded!(free_euler: FreeEuler FreeEulerKernel, [jet(euler_zyx)], free, coordinates::<6>);
loaded!(held_left: HeldLeft HeldLeftKernel, [left_invariant], fixed_point, rotation);
loaded!(held_euler: HeldEuler HeldEulerKernel, [jet(euler_xyz)], fixed_point, coordinates::<3>);
loaded!(plane_hybrid: PlaneHybrid PlaneHybridKernel, [hybrid], planar, plane);

of_body!(in_a_fluid: Vehicle VehicleKernel, [chart = left_invariant], pose, {
    #[gauss(mass)] m: T = |s| number(2.0 * s),
    #[gauss(center_of_mass)] c: Vector3<T> = |s: f64| vector(1.0 / s, [0.1, -0.2, 0.05]),
    #[gauss(inertia)] inertia: Vector3<T> = |s| vector(s, [1.5, 2.0, 2.5]),
    #[gauss(added_mass)] added: Vector6<T> = |s: f64| Vector6::from([0.5, 1.0, 1.5, 0.2, 0.3, 0.4].map(|x| number(s * x))),
    #[gauss(gravity)] g: Vector3<T> = |_| vector(1.0, [0.3, -0.2, -9.8]),
    #[gauss(displaced_mass)] displaced: T = |_| number(1.9),
    #[gauss(center_of_buoyancy)] center: Vector3<T> = |_| vector(1.0, [0.0, 0.02, 0.1]),
});

#[test]
fn parameters_have_the_names_of_their_fields() {
    let names = VehicleKernel::<f64>::INERTIAL_PARAMETERS;
    assert_eq!(
        names,
        [
            "m",
            "m * c[0]",
            "m * c[1]",
            "m * c[2]",
            "inertia[0]",
            "inertia[1]",
            "inertia[2]",
            "added[0]",
            "added[1]",
            "added[2]",
            "added[3]",
            "added[4]",
            "added[5]"
        ]
    );
    let names = GyrostatKernel::<f64>::INERTIAL_PARAMETERS;
    assert_eq!(names[..2], ["hull.mass", "hull.mass * hull.center_of_mass[0]"]);
    assert_eq!((names[5], names.len()), ("hull.inertia[1][0]", 20));
    // The mass of the cart is a number, that of the bob a field.
    assert_eq!(CartKernel::<f64>::INERTIAL_PARAMETERS.last(), Some(&"bob"));
}

macro_rules! of_system {
    ($check:ident $test:ident: $name:ident $kernel:ident, $configuration:expr, { $($field:ident: $value:expr,)+ }) => {
        impl Scene for $name<()> {
            type Kernel = $kernel<Bounded>;
            fn kernel_of(scale: f64) -> Self::Kernel {
                $name { $($field: $value(scale),)+ }.kernel().unwrap()
            }
            fn configuration(random: &mut Random) -> <Self::Kernel as GaussSystem>::Configuration {
                $configuration(random)
            }
        }

        #[test]
        fn $test() {
            $check::<$name<()>>();
        }
    };
}

/// Added mass in clauses: a matrix that is a field, and numbers of which some are multiples of others.
#[derive(GaussDynamics)]
#[gauss(
    regressor,
    coordinates(base: Pose, elbow),
    body(hull, position = base.position, rotation = base.rotation, added_mass = fluid, displaced_mass = displaced),
    body(arm, parent = hull, position = [0.4, 0, 0.1], rotation = rotation_z(elbow), added_mass = [a, b, 2 * b, 0, c, 0.5]),
    medium(velocity = [0.3, 0.1 * t, 0])
)]
struct Manipulator<T> {
    #[gauss(body)]
    hull: RigidBody<T>,
    #[gauss(body)]
    arm: RigidBody<T>,
    fluid: Matrix6<T>,
    displaced: T,
    a: T,
    b: T,
    c: T,
    #[gauss(gravity)]
    g: T,
}

fn fluid(scale: f64) -> Matrix6<Bounded> {
    let entry = |i: usize, j: usize| if i == j { 1.0 + 0.2 * i as f64 } else { 0.02 * (1 + i + j) as f64 };
    Matrix6::from(std::array::from_fn(|i| std::array::from_fn(|j| number(scale * entry(i, j)))))
}

of_system!(residuals a_manipulator_in_a_fluid: Manipulator ManipulatorKernel, |random: &mut Random| {
    (pose(random), coordinates::<1>(random))
}, {
    hull: |s| rigid(s, 0.1),
    arm: |s| rigid(s, -0.2),
    fluid: fluid,
    displaced: |_| number(1.9),
    a: |s| number(0.3 * s),
    b: |s| number(0.5 * s),
    c: |s| number(0.2 * s),
    g: |_| number(9.8),
});

/// The added mass of a field is 21 parameters, those of the other body are the fields in its list; the number is none.
#[test]
fn added_mass_in_clauses_is_among_the_parameters() {
    let names = ManipulatorKernel::<f64>::INERTIAL_PARAMETERS;
    assert_eq!(names.iter().filter(|name| name.starts_with("fluid[")).count(), 21);
    for name in ["a", "b", "c"] {
        assert_eq!(names.iter().filter(|other| **other == name).count(), 1, "{names:?}");
    }
    assert_eq!(names.len(), 2 * 10 + 21 + 3);
}

/// Elements of both groups and a scalar.
#[derive(GaussDynamics)]
#[gauss(
    regressor,
    coordinates(s, base: Pose, wheel: Rotation),
    body(hull, position = base.position, rotation = base.rotation),
    body(rotor, parent = hull, position = [0.2, 0, s], rotation = wheel),
    input(motor),
    torque(body = rotor, value = [0, 0, motor], reaction = hull),
    spring(along = s, stiffness = k, length = 1),
)]
struct Gyrostat<T> {
    #[gauss(body)]
    hull: RigidBody<T>,
    #[gauss(body)]
    rotor: RigidBody<T>,
    #[gauss(gravity)]
    g: T,
    k: T,
}

of_system!(residuals groups_and_scalars: Gyrostat GyrostatKernel, |random: &mut Random| {
    (pose(random), (rotation(random), coordinates::<1>(random)))
}, {
    hull: |s| rigid(s, 0.3),
    rotor: |s| rigid(s, -0.1),
    g: |_| number(9.81),
    k: |_| number(3.0),
});

/// A chain with a mass that is a number, one that is a field, and one that is more than a field.
#[derive(GaussDynamics)]
#[gauss(
    regressor,
    coordinates(x, a, b),
    particle(mass = 2, position = [x, 0, 0]),
    body(upper, position = [x, 0, 0], rotation = rotation_y(a)),
    body(lower, parent = upper, position = [0, 0, -l], rotation = rotation_y(b)),
    particle(mass = bob, parent = lower, position = [0, 0, -l]),
    particle(mass = k * l, parent = upper, position = [0.1, 0, -l]),
    input(push),
    drive(x = push - signum(rate(x)), a = -sin(a) * rate(a)),
)]
struct Cart<T> {
    #[gauss(body)]
    upper: RigidBody<T>,
    #[gauss(body)]
    lower: RigidBody<T>,
    bob: T,
    #[gauss(gravity)]
    g: T,
    l: T,
    k: T,
}

of_system!(residuals chains: Cart CartKernel, coordinates::<3>, {
    upper: |s| rigid(s, 0.3),
    lower: |s| rigid(s, -0.1),
    bob: |s| number(s * 0.5),
    g: |_| number(9.81),
    l: |_| number(0.8),
    k: |_| number(0.4),
});

/// Mass data in clauses: numbers, fields that bodies share, and what is made of them.
#[derive(GaussDynamics)]
#[gauss(
    regressor,
    coordinates(a, b),
    body(upper, rotation = rotation_y(a), mass = m, center_of_mass = [0, 0, -c], inertia = [2 * m * c, 2 * m * c, k]),
    body(lower, parent = upper, position = [0, 0, -1], rotation = rotation_y(b), mass = n, center_of_mass = [c, 0, 0.1], inertia = k),
    body(plate, parent = lower, position = [0, 0, -1], mass = 0.5, center_of_mass = [c, 0, 0.2], inertia = [0.2, 0.2, 0.3]),
)]
struct Shared<T> {
    m: T,
    n: T,
    c: T,
    k: T,
    #[gauss(gravity)]
    g: T,
}

of_system!(residuals mass_data_in_clauses: Shared SharedKernel, coordinates::<2>, {
    m: |s| number(2.0 * s),
    n: |s| number(1.5 * s),
    c: |_| number(0.1),
    k: |s| number(0.5 * s),
    g: |_| number(9.81),
});

#[test]
fn shared_mass_data_are_parameters_once() {
    assert_eq!(SharedKernel::<f64>::INERTIAL_PARAMETERS, ["m", "k", "n", "n * c", "c"]);
}

/// Multipliers of both kinds.
#[derive(GaussDynamics)]
#[gauss(
    regressor,
    coordinates(pose: Pose, x),
    body(hull, position = pose.position, rotation = pose.rotation),
    particle(mass = m, position = [x, 0, 3]),
    point(hook, body = hull, at = h),
    constraint(position = dot(hook - [x, 0, 3], hook - [x, 0, 3]) - 4),
    constraint(velocity = hull.velocity.z - rate(x) * sin(t)),
    input(push),
    force(at = [x, 0, 3], value = [push - x, 0, 0]),
)]
struct Hung<T> {
    #[gauss(body)]
    hull: RigidBody<T>,
    h: Vector3<T>,
    m: T,
    #[gauss(gravity)]
    g: T,
}

of_system!(constrained constraints_with_multipliers: Hung HungKernel, |random: &mut Random| {
    (pose(random), coordinates::<1>(random))
}, {
    hull: |s| rigid(s, 0.3),
    h: |_| vector(1.0, [0.5, 0.1, 0.6]),
    m: |s| number(s * 0.7),
    g: |_| number(9.81),
});

/// A sleigh whose skate is solved for at compile time.
#[derive(GaussDynamics)]
#[gauss(
    regressor,
    coordinates(x, y, theta),
    speeds(s, r, side),
    kinematics(x = s * cos(theta) - side * sin(theta), y = s * sin(theta) + side * cos(theta), theta = r),
    body(position = [x, y, 0], rotation = rotation_z(theta)),
    constraint(velocity = side - 0.1 * s * sin(t)),
    independent(s, r),
    input(thrust),
    force(at = [x, y, 0], value = [thrust, exp(-x), 0]),
)]
struct Sleigh<T> {
    #[gauss(mass)]
    m: T,
    #[gauss(center_of_mass)]
    c: Vector3<T>,
    #[gauss(inertia)]
    inertia: T,
}

of_system!(residuals constraints_solved_for: Sleigh SleighKernel, coordinates::<3>, {
    m: |s| number(s * 1.5),
    c: |s: f64| vector(1.0 / s, [0.3, 0.1, 0.0]),
    inertia: |s| number(s * 0.8),
});

/// Two links with motors: what inverse dynamics asks of them gives the motion.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b),
    body(upper, rotation = rotation_y(a)),
    body(lower, parent = upper, position = [0, 0, -1], rotation = rotation_x(b)),
    input(first, second),
    drive(a = first, b = second),
    drag(body = lower, linear = [1, 1, 1, 0, 0, 0]),
)]
struct Driven<T> {
    #[gauss(body)]
    upper: RigidBody<T>,
    #[gauss(body)]
    lower: RigidBody<T>,
    #[gauss(gravity)]
    g: T,
}

#[test]
fn inverse_dynamics_is_the_inverse() {
    let kernel = Driven { upper: rigid(1.0, 0.3), lower: rigid(0.6, -0.1), g: number(9.81) }.kernel().unwrap();
    let mut random = Random(5);
    for _ in 0..20 {
        let (t, q, z) = (number(0.0), coordinates::<2>(&mut random), coordinates::<2>(&mut random));
        let (asked, none) = (coordinates::<2>(&mut random), coordinates::<2>(&mut random) * Bounded::zero());
        let torques = kernel.inverse_dynamics(t, &q, &z, &asked, &none);
        equal("motion", &list(&kernel.acceleration(t, &q, &z, &torques)), &list(&asked)).unwrap();
        // A (ż − ż₀), and their power is the rate of the energy beside what drag takes.
        let free = kernel.acceleration(t, &q, &z, &none);
        let matrix = kernel.mass_matrix(t, &q);
        let row = |i: usize| (0..2).fold(Bounded::zero(), |sum, j| sum + matrix[(i, j)] * (asked[j] - free[j]));
        equal("forces", &list(&torques), &[row(0), row(1)]).unwrap();
        // Torques that act already are not asked for again.
        equal("nothing", &list(&kernel.inverse_dynamics(t, &q, &z, &asked, &torques)), &list(&none)).unwrap();
    }
}
