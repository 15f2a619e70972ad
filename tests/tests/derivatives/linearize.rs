//! `linearize` and `by_parameters` against dual numbers through the same kernel's accelerations and kinematics, in
//! every kind of scene: two ways to each entry, equal up to the bounds that both carry on their own rounding.

use crate::common::Bounded;
use crate::common::agreement::equal;
use crate::common::body::{Parts, list, speeds};
use crate::common::dual::Dual;
use crate::common::groups::{Random, random_configuration};
use gauss_runtime::inverse::InverseLinearization;
use gauss_runtime::linearize::{LinearModel, error_matrix};
use gauss_runtime::prelude::*;

fn constants(values: &[Bounded]) -> Vec<Dual<Bounded>> {
    values.iter().map(|&value| Dual::new(value, Bounded::zero())).collect()
}

fn along(values: &[Bounded], k: usize) -> Vec<Dual<Bounded>> {
    let mut duals = constants(values);
    duals[k].rate = Bounded::one();
    duals
}

/// Values of parameters, in the order in which they are asked for, as numbers of a kind.
type Numbers<'a, T> = dyn FnMut(f64) -> T + 'a;

fn plain<T: Real>(value: f64) -> T {
    T::from_f64(value)
}

/// The parameter of that number moves.
fn moving(parameter: usize) -> impl FnMut(f64) -> Dual<Bounded> {
    let mut count = 0;
    move |value| {
        count += 1;
        Dual::new(Bounded::from_f64(value), Bounded::from_f64(if count == parameter + 1 { 1.0 } else { 0.0 }))
    }
}

fn vector<T: Real, const N: usize>(n: &mut Numbers<'_, T>, values: [f64; N]) -> SVector<T, N> {
    SVector::from(values.map(n))
}

/// Entries below the diagonal, column by column: each is one parameter.
fn symmetric<T: Real, const N: usize>(n: &mut Numbers<'_, T>, values: &[f64]) -> SMatrix<T, N, N> {
    let mut values = values.iter();
    let mut matrix = SMatrix::<T, N, N>::from_element(T::zero());
    for column in 0..N {
        for row in column..N {
            matrix[(row, column)] = n(*values.next().unwrap());
            matrix[(column, row)] = matrix[(row, column)];
        }
    }
    matrix
}

/// The kernel with numbers as they are, and the one with dual numbers of which one parameter moves.
macro_rules! kernels {
    ($name:ident) => {
        (&$name::<Bounded>::sample(&mut plain).kernel().unwrap(), |parameter| {
            $name::<Dual<Bounded>>::sample(&mut moving(parameter)).kernel().unwrap()
        })
    };
}

/// Compares at random states. `origin` is a configuration around which they are drawn; of a number beyond the
/// parameters none moves.
fn check<C, B, D>(origin: &C, (bounded, moved): (&B, impl Fn(usize) -> D))
where
    C: Configuration<Scalar = f64> + Parts<f64>,
    B: ParametricSystem<Scalar = Bounded, Configuration: Parts<Bounded>>,
    D: GaussSystem<Scalar = Dual<Bounded>, Configuration: Parts<Dual<Bounded>>, Input: VectorSpace<Dual<Bounded>>>,
{
    let parameters = B::PARAMETERS.len();
    let (dual, of_parameters) = (moved(parameters), (0..parameters).map(moved).collect::<Vec<_>>());
    let mut random = Random(7);
    let (positions, dof) = (<B::Configuration as Configuration>::Tangent::DIM, B::DOF);
    let inputs = B::Input::DIM;
    let mut told = 0;
    for _ in 0..12 {
        let q: B::Configuration = random_configuration(origin, &mut random);
        let mut draw =
            |count: usize| -> Vec<Bounded> { (0..count).map(|_| Bounded::from_f64(random.number())).collect() };
        let (z, input, t) = (draw(dof), draw(inputs), draw(1)[0]);
        let linear = bounded.linearize(t, &q, &speeds(&z), &speeds(&input));
        let by_parameters = bounded.by_parameters(t, &q, &speeds(&z), &speeds(&input));
        let rates_of =
            |dual: &D, t: Dual<Bounded>, q: &[Dual<Bounded>], z: &[Dual<Bounded>], input: &[Dual<Bounded>]| {
                let (q, z) = (D::Configuration::assemble(q), speeds(z));
                let velocity = list(&dual.kinematics(t, &q, &z));
                [velocity, list(&dual.acceleration(t, &q, &z, &speeds(input)))].concat()
            };
        let rates = |t: Dual<Bounded>, q: &[Dual<Bounded>], z: &[Dual<Bounded>], input: &[Dual<Bounded>]| {
            rates_of(&dual, t, q, z, input)
        };
        let (still, parts) = (Dual::new(t, Bounded::zero()), q.parts());
        let column = |direction: usize| -> Vec<Dual<Bounded>> {
            let fixed = (constants(&parts), constants(&z), constants(&input));
            if direction < positions {
                let mut axis = <B::Configuration as Configuration>::Tangent::zero();
                axis.set_component(direction, Bounded::one());
                let moving: Vec<_> = parts.iter().zip(q.rates(&axis)).map(|(&x, rate)| Dual::new(x, rate)).collect();
                rates(still, &moving, &fixed.1, &fixed.2)
            } else if direction < positions + dof {
                rates(still, &fixed.0, &along(&z, direction - positions), &fixed.2)
            } else if direction == positions + dof {
                rates(Dual::new(t, Bounded::one()), &fixed.0, &fixed.1, &fixed.2)
            } else {
                rates(still, &fixed.0, &fixed.1, &along(&input, direction - positions - dof - 1))
            }
        };
        for direction in 0..=positions + dof + inputs {
            let computed = column(direction);
            let expected: Vec<Bounded> = computed.iter().map(|x| x.rate).collect();
            let states = positions + dof;
            let found: Vec<Bounded> = (0..states)
                .map(|row| match direction.checked_sub(states) {
                    None => linear.by_state(row, direction),
                    Some(0) => linear.by_time().component(row),
                    Some(k) => linear.by_input(row, k - 1),
                })
                .collect();
            equal(&format!("direction {direction}"), &found, &expected).unwrap();
            let rate: Vec<Bounded> = (0..states).map(|row| linear.rate().component(row)).collect();
            let values: Vec<Bounded> = computed.iter().map(|x| x.value).collect();
            equal("rates", &rate, &values).unwrap();
            // What is said to be zero is zero in dual numbers, too.
            for (row, value) in expected.iter().enumerate() {
                let can_change = match direction.checked_sub(states) {
                    None => B::STATE_PATTERN[row][direction],
                    Some(0) => true,
                    Some(k) => B::INPUT_PATTERN[row][k - 1],
                };
                assert!(can_change || value.value.abs() <= value.bound, "({row}, {direction}) is {value:?}");
            }
            let size = found.iter().fold(1.0_f64, |m, x| m.max(x.value.abs()));
            told += usize::from(found.iter().all(|x| x.bound <= 1e-9 * size));
        }
        for (k, dual) in of_parameters.iter().enumerate() {
            let computed = rates_of(dual, still, &constants(&parts), &constants(&z), &constants(&input));
            let expected: Vec<Bounded> = computed.iter().map(|x| x.rate).collect();
            let found: Vec<Bounded> = (0..expected.len()).map(|row| by_parameters[(row, k)]).collect();
            equal(B::PARAMETERS[k], &found, &expected).unwrap();
            for (row, value) in expected.iter().enumerate() {
                let can_change = B::PARAMETER_PATTERN[row][k];
                assert!(can_change || value.value.abs() <= value.bound, "({row}, {}) is {value:?}", B::PARAMETERS[k]);
            }
            let size = found.iter().fold(1.0_f64, |m, x| m.max(x.value.abs()));
            told += usize::from(found.iter().all(|x| x.bound <= 1e-9 * size));
        }
    }
    // Bounds are those of the worst case: most must be small, or agreement would say nothing.
    let all = 12 * (positions + dof + inputs + 1 + parameters);
    assert!(10 * told >= 9 * all, "only {told} of {all} columns are known to 1e-9");
}

/// The derivatives of inverse dynamics beside dual numbers through `inverse_dynamics`, at random states and ż.
fn check_inverse<C, B, D, const N: usize, const P: usize, const U: usize>(
    origin: &C,
    (bounded, moved): (&B, impl Fn(usize) -> D),
) where
    C: Configuration<Scalar = f64> + Parts<f64>,
    B: InverseLinearizedSystem<
            Scalar = Bounded,
            Configuration: Parts<Bounded>,
            InverseLinearization = InverseLinearization<Bounded, P, N, U>,
        >,
    D: GaussSystem<Scalar = Dual<Bounded>, Configuration: Parts<Dual<Bounded>>, Input: VectorSpace<Dual<Bounded>>>,
{
    let dual = moved(usize::MAX - 1);
    let mut random = Random(11);
    for _ in 0..6 {
        let q: B::Configuration = random_configuration(origin, &mut random);
        let mut draw =
            |count: usize| -> Vec<Bounded> { (0..count).map(|_| Bounded::from_f64(random.number())).collect() };
        let (z, rate, input, t) = (draw(N), draw(N), draw(U), draw(1)[0]);
        let found = bounded.linearize_inverse(t, &q, &speeds(&z), &speeds(&rate), &speeds(&input));
        let parts = q.parts();
        let column = |[of_q, of_z, of_rate, of_t, of_input]: [Option<usize>; 5]| -> Vec<Dual<Bounded>> {
            let moving = |values: &[Bounded], k: Option<usize>| k.map_or(constants(values), |k| along(values, k));
            let q = match of_q {
                None => constants(&parts),
                Some(k) => {
                    let mut axis = <B::Configuration as Configuration>::Tangent::zero();
                    axis.set_component(k, Bounded::one());
                    parts.iter().zip(q.rates(&axis)).map(|(&x, rate)| Dual::new(x, rate)).collect()
                }
            };
            let (z, rate, input) = (moving(&z, of_z), moving(&rate, of_rate), moving(&input, of_input));
            let t = moving(&[t], of_t)[0];
            list(&dual.inverse_dynamics(
                t,
                &D::Configuration::assemble(&q),
                &speeds(&z),
                &speeds(&rate),
                &speeds(&input),
            ))
        };
        let slopes = |moves| column(moves).iter().map(|x| x.rate).collect::<Vec<_>>();
        let values: Vec<Bounded> = column([None; 5]).iter().map(|x| x.value).collect();
        equal("force", found.force.as_slice(), &values).unwrap();
        for k in 0..P {
            let expected = slopes([Some(k), None, None, None, None]);
            equal(&format!("σ {k}"), found.by_configuration.column(k).as_slice(), &expected).unwrap();
        }
        for k in 0..N {
            let by_speeds = slopes([None, Some(k), None, None, None]);
            equal(&format!("z {k}"), found.by_speeds.column(k).as_slice(), &by_speeds).unwrap();
            let by_rates = slopes([None, None, Some(k), None, None]);
            equal(&format!("ż {k}"), found.by_acceleration.column(k).as_slice(), &by_rates).unwrap();
        }
        equal("time", found.by_time.as_slice(), &slopes([None, None, None, Some(0), None])).unwrap();
        for k in 0..U {
            let expected = slopes([None, None, None, None, Some(k)]);
            equal(&format!("input {k}"), found.by_input.column(k).as_slice(), &expected).unwrap();
        }
    }
}

/// One body with everything that can act on it, in a chart.
macro_rules! loaded {
    ($test:ident: $name:ident, [$($chart:tt)+], $motion:ident, $origin:expr) => {
        #[derive(GaussDynamics)]
        #[gauss(
            linearize(parameters),
            chart = $($chart)+,
            motion = $motion,
            input(thrust, push: Vector3),
            force(at = [0.3, -0.2, 0.1], value = [thrust * cos(t), thrust + body.body_velocity.x, 0.5 * thrust]),
            force(body = body, value = push, axes = observer),
            torque(value = [sin(t) * body.position.x, exp(-body.position.y), body.body_angular_velocity.z * thrust]),
            spring(from = [3, 1, -2], to = body.position + body.rotation * [0.4, 0, 0], stiffness = k, length = 1, damping = c),
            drag(linear = [c, c, 2, c, c, 3], quadratic = d),
        )]
        struct $name<T> {
            #[gauss(mass)]
            m: T,
            #[gauss(center_of_mass)]
            center: Vector3<T>,
            #[gauss(inertia)]
            inertia: Matrix3<T>,
            #[gauss(added_mass)]
            added: Vector6<T>,
            #[gauss(gravity)]
            g: T,
            k: T,
            c: T,
            d: Vector6<T>,
        }

        impl<T: Real> $name<T> {
            fn sample(n: &mut Numbers<'_, T>) -> Self {
                Self {
                    m: n(2.0),
                    center: vector(n, [0.1, -0.2, 0.05]),
                    inertia: symmetric(n, &[1.5, 0.1, -0.2, 2.0, 0.15, 2.5]),
                    added: vector(n, [0.5, 1.0, 1.5, 0.2, 0.3, 0.4]),
                    g: n(9.81),
                    k: n(4.0),
                    c: n(0.7),
                    d: vector(n, [0.3, 0.6, 0.9, 0.1, 0.2, 0.4]),
                }
            }
        }

        #[test]
        fn $test() {
            check(&$origin, kernels!($name));
        }
    };
}

loaded!(free_left: FreeLeft, [left_invariant], free, Isometry3::<f64>::identity());
loaded!(free_right: FreeRight, [right_invariant], free, Isometry3::<f64>::identity());
loaded!(free_hybrid: FreeHybrid, [hybrid], free, Isometry3::<f64>::identity());
loaded!(free_euler: FreeEuler, [jet(euler_zyx)], free, SVector::<f64, 6>::zeros());
loaded!(free_modified: FreeModified, [jet(modified_rodrigues)], free, SVector::<f64, 6>::zeros());
loaded!(held_left: HeldLeft, [left_invariant], fixed_point, UnitQuaternion::<f64>::identity());
loaded!(held_right: HeldRight, [right_invariant], fixed_point, UnitQuaternion::<f64>::identity());
loaded!(held_euler: HeldEuler, [jet(euler_zxz)], fixed_point, SVector::from([0.0, 1.5, 0.0]));
loaded!(plane_left: PlaneLeft, [left_invariant], planar, Isometry2::<f64>::identity());
loaded!(plane_right: PlaneRight, [right_invariant], planar, Isometry2::<f64>::identity());
loaded!(plane_hybrid: PlaneHybrid, [hybrid], planar, Isometry2::<f64>::identity());
loaded!(plane_jet: PlaneJet, [jet], planar, SVector::<f64, 3>::zeros());

fn rigid<T: Real>(n: &mut Numbers<'_, T>, mass: f64, x: f64) -> RigidBody<T> {
    RigidBody {
        mass: n(mass),
        center_of_mass: vector(n, [x, 0.1, -0.05]),
        inertia: symmetric(n, &[1.3, 0.1, -0.2, 1.7, 0.05, 2.1]),
    }
}

/// A hull with a rotor that slides: elements of both groups after a scalar, inputs, and a force in a moving medium.
#[derive(GaussDynamics)]
#[gauss(
    linearize(parameters, inverse),
    coordinates(s, base: Pose, wheel: Rotation),
    body(hull, position = base.position, rotation = base.rotation),
    body(rotor, parent = hull, position = [0.2, 0, s], rotation = wheel),
    medium(velocity = [sin(t), 0.5, 0]),
    input(motor, push: Vector3),
    torque(body = rotor, value = [0, 0, motor], reaction = hull),
    force(body = hull, value = push),
    spring(along = s, stiffness = k, length = l, damping = l),
    drag(body = hull, linear = [k, k, k, l, l, l]),
)]
struct Gyrostat<T> {
    #[gauss(body)]
    hull: RigidBody<T>,
    #[gauss(body)]
    rotor: RigidBody<T>,
    #[gauss(gravity)]
    g: T,
    k: T,
    l: T,
}

impl<T: Real> Gyrostat<T> {
    fn sample(n: &mut Numbers<'_, T>) -> Self {
        Self { hull: rigid(n, 2.0, 0.3), rotor: rigid(n, 1.0, -0.1), g: n(9.81), k: n(3.0), l: n(0.5) }
    }
}

#[test]
fn groups_and_scalars() {
    let origin = (Isometry3::<f64>::identity(), (UnitQuaternion::<f64>::identity(), SVector::from([0.4])));
    check(&origin, kernels!(Gyrostat));
    check_inverse(&origin, kernels!(Gyrostat));
}

/// A body on a rod, one of whose points keeps its height rate: multipliers of both kinds.
#[derive(GaussDynamics)]
#[gauss(
    linearize(parameters, inverse),
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

impl<T: Real> Hung<T> {
    fn sample(n: &mut Numbers<'_, T>) -> Self {
        Self { hull: rigid(n, 2.0, 0.3), h: vector(n, [0.5, 0.1, 0.6]), m: n(0.7), g: n(9.81) }
    }
}

#[test]
fn constraints_with_multipliers() {
    let origin = (Isometry3::<f64>::identity(), SVector::from([0.2]));
    check(&origin, kernels!(Hung));
    check_inverse(&origin, kernels!(Hung));
}

/// A sleigh whose skate is solved for at compile time.
#[derive(GaussDynamics)]
#[gauss(
    linearize(parameters),
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
    center: Vector3<T>,
    #[gauss(inertia)]
    inertia: T,
}

impl<T: Real> Sleigh<T> {
    fn sample(n: &mut Numbers<'_, T>) -> Self {
        Self { m: n(1.5), center: vector(n, [0.3, 0.1, 0.0]), inertia: n(0.8) }
    }
}

#[test]
fn constraints_solved_for() {
    check(&SVector::<f64, 3>::zeros(), kernels!(Sleigh));
}

/// Every function that expressions have, on a cart with a double pendulum, of which a joint is locked.
#[derive(GaussDynamics)]
#[gauss(
    linearize(parameters, inverse),
    coordinates(x, a, b, c),
    lock(c = bent),
    particle(mass = 2, position = [x, 0, 0]),
    body(upper, position = [x, 0, 0], rotation = rotation_y(a)),
    body(lower, parent = upper, position = [0.1 * c, 0, -l], rotation = rotation_y(b + c)),
    input(push),
    drive(x = push * smooth_step(x, -1, 1) - clamp(3 * dx, -1, 1) + signum(x), a = max(a, 0.2) * abs(da) - min(x, t)),
    drive(b = atan2(b, 2 + x * x) + sqrt(1 + da * da) + ln(3 + sin(b)) + hypot(b, 1) + tan(0.3 * b)),
    define(dx = rate(x), da = rate(a)),
)]
struct Cart<T> {
    #[gauss(body)]
    upper: RigidBody<T>,
    #[gauss(body)]
    lower: RigidBody<T>,
    #[gauss(gravity)]
    g: T,
    l: T,
    bent: T,
}

impl<T: Real> Cart<T> {
    fn sample(n: &mut Numbers<'_, T>) -> Self {
        Self { upper: rigid(n, 1.0, 0.2), lower: rigid(n, 0.5, -0.3), g: n(9.81), l: n(0.8), bent: n(0.6) }
    }
}

#[test]
fn every_function() {
    check(&SVector::<f64, 3>::zeros(), kernels!(Cart));
    check_inverse(&SVector::<f64, 3>::zeros(), kernels!(Cart));
}

/// A whole added mass, buoyancy, and a mass without an effect on the rest.
#[derive(GaussDynamics)]
#[gauss(linearize(parameters), chart = left_invariant)]
struct Vehicle<T> {
    #[gauss(mass)]
    m: T,
    #[gauss(center_of_mass)]
    center: Vector3<T>,
    #[gauss(inertia)]
    inertia: Vector3<T>,
    #[gauss(added_mass)]
    added: Matrix6<T>,
    #[gauss(gravity)]
    g: Vector3<T>,
    #[gauss(displaced_mass)]
    displaced: T,
    #[gauss(center_of_buoyancy)]
    buoyancy: Vector3<T>,
}

impl<T: Real> Vehicle<T> {
    fn sample(n: &mut Numbers<'_, T>) -> Self {
        let added = [
            [0.5, 0.01, -0.02, 0.03, 0.02, 0.01].as_slice(),
            &[1.0, 0.05, -0.03, 0.02, 0.04],
            &[1.5, 0.02, 0.01, -0.05],
            &[0.2, 0.01, 0.02],
            &[0.3, -0.01],
            &[0.4],
        ];
        Self {
            m: n(2.0),
            center: vector(n, [0.1, -0.2, 0.05]),
            inertia: vector(n, [1.5, 2.0, 2.5]),
            added: symmetric(n, &added.concat()),
            g: vector(n, [0.3, -0.2, -9.8]),
            displaced: n(1.9),
            buoyancy: vector(n, [0.0, 0.02, 0.1]),
        }
    }
}

#[test]
fn a_body_in_a_fluid() {
    check(&Isometry3::<f64>::identity(), kernels!(Vehicle));
}

#[test]
fn parameters_have_the_names_of_their_fields() {
    let names = VehicleKernel::<f64>::PARAMETERS;
    let inertia = ["inertia[0]", "inertia[1]", "inertia[2]", "added[0][0]", "added[1][0]"];
    assert_eq!(names[..4], ["m", "center[0]", "center[1]", "center[2]"]);
    assert_eq!(names[4..9], inertia);
    assert_eq!(
        names[27..],
        ["added[5][5]", "g[0]", "g[1]", "g[2]", "displaced", "buoyancy[0]", "buoyancy[1]", "buoyancy[2]"]
    );
    let names = CartKernel::<f64>::PARAMETERS;
    assert_eq!(
        names[..5],
        [
            "upper.mass",
            "upper.center_of_mass[0]",
            "upper.center_of_mass[1]",
            "upper.center_of_mass[2]",
            "upper.inertia[0][0]"
        ]
    );
    assert_eq!(names[5], "upper.inertia[1][0]");
    assert_eq!(names[20..], ["g", "l", "bent"]);
    let names = FreeEulerKernel::<f64>::PARAMETERS;
    assert_eq!(names[names.len() - 9..], ["g", "k", "c", "d[0]", "d[1]", "d[2]", "d[3]", "d[4]", "d[5]"]);
}

/// In the plane of a cart and its pendulums only one moment of inertia of each enters, and what is fixed to the cart's
/// side does not.
#[test]
fn patterns_tell_what_matters() {
    let column = |name: &str| CartKernel::<f64>::PARAMETERS.iter().position(|known| *known == name).unwrap();
    let matters = |name: &str| CartKernel::<f64>::PARAMETER_PATTERN.iter().any(|row| row[column(name)]);
    for name in ["upper.mass", "upper.center_of_mass[0]", "lower.inertia[1][1]", "g", "l", "bent"] {
        assert!(matters(name), "{name}");
    }
    for name in ["upper.center_of_mass[1]", "upper.inertia[0][0]", "lower.inertia[2][1]"] {
        assert!(!matters(name), "{name}");
    }
    // Velocities do not depend on parameters here.
    assert!(CartKernel::<f64>::PARAMETER_PATTERN[..3].iter().all(|row| row.iter().all(|can_change| !can_change)));
}

/// Central differences: h² of third derivatives of the order of the size, and roundings over h.
#[test]
fn differences_between_neighbouring_bodies() {
    let (q, z) = (SVector::from([0.3, 0.8, -0.5]), SVector::from([0.4, -1.2, 0.7]));
    let input = SVector::from([0.6]);
    let of = |parameter: usize, step: f64| {
        let mut count = 0;
        let mut numbers = |value: f64| {
            count += 1;
            if count == parameter + 1 { value + step } else { value }
        };
        Cart::<f64>::sample(&mut numbers).kernel().unwrap().acceleration(0.3, &q, &z, &input)
    };
    let exact = Cart::<f64>::sample(&mut plain).kernel().unwrap().by_parameters(0.3, &q, &z, &input);
    let h = 1e-5;
    for (k, name) in CartKernel::<f64>::PARAMETERS.iter().enumerate() {
        let difference = (of(k, h) - of(k, -h)) / (2.0 * h);
        let found = SVector::<f64, 3>::from_fn(|row, _| exact[(3 + row, k)]);
        let size = found.amax().max(of(k, 0.0).amax());
        let error = (difference - found).amax();
        assert!(error <= 1e3 * size * h * h + 1e2 * size * f64::EPSILON / h, "{name}: {error:e}");
    }
}

/// A body in a fluid that turns and is pulled.
#[derive(GaussDynamics)]
#[gauss(
    linearize,
    chart = hybrid,
    drag(linear = [1, 2, 3, 1, 2, 3], quadratic = [1, 1, 1, 1, 1, 1]),
    spring(from = [1, 2, 3], to = body.position + body.rotation * [0.3, 0, 0], stiffness = 5),
)]
struct Pulled {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
}

/// How an increment between two motions changes, found from motions: d/dt log(q⁻¹ q̃) over a time h to both sides.
#[test]
fn small_increments_change_by_the_error_matrix() {
    let kernel = Pulled { m: 1.5, inertia: Vector3::new(1.0, 1.5, 2.0) }.kernel().unwrap();
    let q = Isometry3::from_parts(Translation3::new(0.4, -0.2, 0.7), UnitQuaternion::from_euler_angles(0.3, 0.8, -0.5));
    let z = Vector6::from([1.0, -0.6, 0.8, 0.9, -1.2, 0.7]);
    let matrix = error_matrix::<PulledKernel>(&kernel.linearize(0.0, &q, &z, &()));
    let (h, size) = (1e-3, 1e-5);
    for k in 0..12 {
        let direction = SVector::<f64, 12>::from_fn(|i, _| if i == k { 1.0 } else { 0.0 });
        // Opposite neighbours, so that what is left is of third order in their distance.
        let apart = |t: f64| {
            let run = Simulation::new(&kernel).fixed_step(h / 4.0);
            let to = |sign: f64| {
                let x = direction * (sign * size);
                let moved = q.retract(&x.fixed_rows::<6>(0).into());
                run.run_to_end(moved, z + x.fixed_rows::<6>(6), 0.0..t).unwrap()
            };
            let (here, there, back) = (run.run_to_end(q, z, 0.0..t).unwrap(), to(1.0), to(-1.0));
            let sigma = (here.q.difference(&there.q) - here.q.difference(&back.q)) / (2.0 * size);
            let speeds = (there.z - back.z) / (2.0 * size);
            SVector::<f64, 12>::from_fn(|i, _| if i < 6 { sigma[i] } else { speeds[i - 6] })
        };
        let rate = (apart(h) - apart(-h)) / (2.0 * h);
        let error = (rate - matrix * direction).amax();
        // Third derivatives of up to 100, and roundings of 1e-16 / (size h).
        assert!(error < 100.0 * h * h + 100.0 * f64::EPSILON / (size * h), "direction {k}: {error:e}");
    }
}
