//! `linearize` against dual numbers through the same kernel's accelerations and kinematics, in every kind of scene: two ways to
//! each entry, equal up to the bounds that both carry on their own rounding.

mod common;

use common::agreement::equal;
use common::body::{Parts, list, speeds};
use common::bounded::Bounded;
use common::dual::Dual;
use gauss_runtime::linearize::{LinearModel, error_matrix};
use gauss_runtime::prelude::*;

/// A reproducible stream of numbers in [−1, 1].
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// Pairs, for systems: the parts of the first factor are those of a quaternion or of a pose.
impl<T: Real, A: Grouped<T>, B: Parts<T>> Parts<T> for (A, B) {
    fn parts(&self) -> Vec<T> {
        [self.0.parts(), self.1.parts()].concat()
    }
    fn assemble(parts: &[T]) -> Self {
        let (first, second) = parts.split_at(A::COUNT);
        (A::assemble(first), B::assemble(second))
    }
    fn rates(&self, velocity: &Self::Tangent) -> Vec<T> {
        [self.0.rates(&velocity.first), self.1.rates(&velocity.second)].concat()
    }
}

trait Grouped<T: Real>: Parts<T> {
    const COUNT: usize;
}

impl<T: Real> Grouped<T> for UnitQuaternion<T> {
    const COUNT: usize = 4;
}

impl<T: Real> Grouped<T> for Isometry3<T> {
    const COUNT: usize = 7;
}

/// A configuration near which quaternions have norm 1: rounded components stand for exact ones up to their bounds.
fn random_configuration<C: Configuration<Scalar = f64> + Parts<f64>, B: Parts<Bounded>>(
    origin: &C,
    random: &mut Random,
) -> B {
    let mut tangent = C::Tangent::zero();
    for i in 0..C::Tangent::DIM {
        tangent.set_component(i, 1.2 * random.next());
    }
    let parts = origin.retract(&tangent).renormalise().parts();
    B::assemble(&parts.iter().map(|&x| Bounded::new(x, 4.0 * f64::EPSILON * x.abs().max(1.0))).collect::<Vec<_>>())
}

fn constants(values: &[Bounded]) -> Vec<Dual<Bounded>> {
    values.iter().map(|&value| Dual::new(value, Bounded::zero())).collect()
}

fn along(values: &[Bounded], k: usize) -> Vec<Dual<Bounded>> {
    let mut duals = constants(values);
    duals[k].rate = Bounded::one();
    duals
}

/// Compares at random states. `origin` is a configuration around which they are drawn.
fn check<C, B, D>(origin: &C, bounded: &B, dual: &D)
where
    C: Configuration<Scalar = f64> + Parts<f64>,
    B: LinearizedSystem<Scalar = Bounded, Configuration: Parts<Bounded>>,
    D: GaussSystem<Scalar = Dual<Bounded>, Configuration: Parts<Dual<Bounded>>, Input: VectorSpace<Dual<Bounded>>>,
{
    let mut random = Random(7);
    let (positions, dof) = (<B::Configuration as Configuration>::Tangent::DIM, B::DOF);
    let inputs = B::Input::DIM;
    let mut told = 0;
    for _ in 0..12 {
        let q: B::Configuration = random_configuration(origin, &mut random);
        let mut draw =
            |count: usize| -> Vec<Bounded> { (0..count).map(|_| Bounded::from_f64(random.next())).collect() };
        let (z, input, t) = (draw(dof), draw(inputs), draw(1)[0]);
        let linear = bounded.linearize(t, &q, &speeds(&z), &speeds(&input));
        let rates = |t: Dual<Bounded>, q: &[Dual<Bounded>], z: &[Dual<Bounded>], input: &[Dual<Bounded>]| {
            let (q, z) = (D::Configuration::assemble(q), speeds(z));
            let velocity = list(&dual.kinematics(t, &q, &z));
            [velocity, list(&dual.acceleration(t, &q, &z, &speeds(input)))].concat()
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
    }
    // Bounds are those of the worst case: most must be small, or agreement would say nothing.
    let all = 12 * (positions + dof + inputs + 1);
    assert!(10 * told >= 9 * all, "only {told} of {all} columns are known to 1e-9");
}

/// One body with everything that can act on it, in a chart.
macro_rules! loaded {
    ($test:ident: $name:ident, [$($chart:tt)+], $motion:ident, $origin:expr) => {
        #[derive(GaussDynamics)]
        #[gauss(
            linearize,
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
            fn sample() -> Self {
                let n = T::from_f64;
                let inertia = [[1.5, 0.1, -0.2], [0.1, 2.0, 0.15], [-0.2, 0.15, 2.5]];
                Self {
                    m: n(2.0),
                    center: Vector3::from([0.1, -0.2, 0.05].map(n)),
                    inertia: Matrix3::from(inertia.map(|row| row.map(n))),
                    added: Vector6::from([0.5, 1.0, 1.5, 0.2, 0.3, 0.4].map(n)),
                    g: n(9.81),
                    k: n(4.0),
                    c: n(0.7),
                    d: Vector6::from([0.3, 0.6, 0.9, 0.1, 0.2, 0.4].map(n)),
                }
            }
        }

        #[test]
        fn $test() {
            let (bounded, dual) = ($name::<Bounded>::sample().kernel(), $name::<Dual<Bounded>>::sample().kernel());
            check(&$origin, &bounded.unwrap(), &dual.unwrap());
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

fn rigid<T: Real>(mass: f64, x: f64) -> RigidBody<T> {
    let inertia = [[1.3, 0.1, -0.2], [0.1, 1.7, 0.05], [-0.2, 0.05, 2.1]];
    RigidBody {
        mass: T::from_f64(mass),
        center_of_mass: Vector3::from([x, 0.1, -0.05].map(T::from_f64)),
        inertia: Matrix3::from(inertia.map(|row| row.map(T::from_f64))),
    }
}

/// A hull with a rotor that slides: elements of both groups after a scalar, inputs, and a force in a moving medium.
#[derive(GaussDynamics)]
#[gauss(
    linearize,
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
    fn sample() -> Self {
        let n = T::from_f64;
        Self { hull: rigid(2.0, 0.3), rotor: rigid(1.0, -0.1), g: n(9.81), k: n(3.0), l: n(0.5) }
    }
}

#[test]
fn groups_and_scalars() {
    let origin = (Isometry3::<f64>::identity(), (UnitQuaternion::<f64>::identity(), SVector::from([0.4])));
    let (bounded, dual) = (Gyrostat::<Bounded>::sample().kernel(), Gyrostat::<Dual<Bounded>>::sample().kernel());
    check(&origin, &bounded.unwrap(), &dual.unwrap());
}

/// A body on a rod, one of whose points keeps its height rate: multipliers of both kinds.
#[derive(GaussDynamics)]
#[gauss(
    linearize,
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
    fn sample() -> Self {
        let n = T::from_f64;
        Self { hull: rigid(2.0, 0.3), h: Vector3::from([0.5, 0.1, 0.6].map(n)), m: n(0.7), g: n(9.81) }
    }
}

#[test]
fn constraints_with_multipliers() {
    let origin = (Isometry3::<f64>::identity(), SVector::from([0.2]));
    let (bounded, dual) = (Hung::<Bounded>::sample().kernel(), Hung::<Dual<Bounded>>::sample().kernel());
    check(&origin, &bounded.unwrap(), &dual.unwrap());
}

/// A sleigh whose skate is solved for at compile time.
#[derive(GaussDynamics)]
#[gauss(
    linearize,
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

#[test]
fn constraints_solved_for() {
    fn sample<T: Real>() -> Sleigh<T> {
        let n = T::from_f64;
        Sleigh { m: n(1.5), center: Vector3::from([0.3, 0.1, 0.0].map(n)), inertia: n(0.8) }
    }
    let (bounded, dual) = (sample::<Bounded>().kernel(), sample::<Dual<Bounded>>().kernel());
    check(&SVector::<f64, 3>::zeros(), &bounded.unwrap(), &dual.unwrap());
}

/// Every function that expressions have, on a cart with a double pendulum.
#[derive(GaussDynamics)]
#[gauss(
    linearize,
    coordinates(x, a, b),
    particle(mass = 2, position = [x, 0, 0]),
    body(upper, position = [x, 0, 0], rotation = rotation_y(a)),
    body(lower, parent = upper, position = [0, 0, -l], rotation = rotation_y(b)),
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
}

#[test]
fn every_function() {
    fn sample<T: Real>() -> Cart<T> {
        Cart { upper: rigid(1.0, 0.2), lower: rigid(0.5, -0.3), g: T::from_f64(9.81), l: T::from_f64(0.8) }
    }
    let (bounded, dual) = (sample::<Bounded>().kernel(), sample::<Dual<Bounded>>().kernel());
    check(&SVector::<f64, 3>::zeros(), &bounded.unwrap(), &dual.unwrap());
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
