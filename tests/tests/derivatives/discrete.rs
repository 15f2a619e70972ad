//! Derivatives of steps: against dual numbers through the very same step, which agree up to the bounds that both carry
//! on their own rounding; against differences; and what is true of every motion.

use crate::common::Bounded;
use crate::common::agreement::equal;
use crate::common::body::{list, speeds};
use crate::common::dual::Dual;
use gauss_runtime::integrate::{Feedback, OneStep, Problem, RunPart, State, SystemProblem};
use gauss_runtime::linearize::{Linearization, error_matrix};
use gauss_runtime::prelude::*;
use gauss_tests::random::Random;

type Increment<S> = <<S as GaussSystem>::Configuration as Configuration>::Tangent;

/// The end of a step of the method itself, the input being held.
fn step<S: GaussSystem>(
    system: &S,
    t: S::Scalar,
    q: &S::Configuration,
    z: &S::Speeds,
    input: &S::Input,
    h: S::Scalar,
) -> (S::Configuration, S::Speeds) {
    let held = *input;
    let problem = SystemProblem { system, form: VelocityForm, input: Feedback(move |_, _: &_, _: &_| held) };
    let start = State { t, q: *q, y: *z };
    let end = CommutatorFree4.step(&problem, &start, &problem.rates(&start), h).expect("steps").state;
    (end.q, end.y)
}

fn constants(values: &[Bounded]) -> Vec<Dual<Bounded>> {
    values.iter().map(|&value| Dual::new(value, Bounded::zero())).collect()
}

fn along(values: &[Bounded], direction: usize) -> Vec<Dual<Bounded>> {
    let mut duals = constants(values);
    if let Some(dual) = duals.get_mut(direction) {
        dual.rate = Bounded::one();
    }
    duals
}

/// A number of no list.
const NONE: usize = usize::MAX;

/// Compares at random states around `origin`.
fn check<B, D, const N: usize, const U: usize>(origin: B::Configuration, bounded: &B, dual: &D)
where
    B: LinearizedSystem<Scalar = Bounded, Linearization = Linearization<Bounded, N, U>>,
    D: GaussSystem<Scalar = Dual<Bounded>, Input: VectorSpace<Dual<Bounded>>>,
{
    let mut random = Random(7);
    let positions = Increment::<B>::DIM;
    let (mut told, mut all) = (0, 0);
    for _ in 0..6 {
        let q = origin.retract(&random.vector(1.0));
        let (z, input): (B::Speeds, B::Input) = (random.vector(1.0), random.vector(1.0));
        let (t, h) = (Bounded::from_f64(random.number()), Bounded::from_f64(0.2));
        let found = CommutatorFree4.step_linearized(bounded, t, &q, &z, &input, h).expect("steps");
        let (q_end, z_end) = step(bounded, t, &q, &z, &input, h);
        equal("configuration", &list(&found.q.components()), &list(&q_end.components())).unwrap();
        equal("speeds", &list(&found.z), &list(&z_end)).unwrap();
        for direction in 0..N + U + 2 {
            let of = |from: usize| direction.checked_sub(from).unwrap_or(NONE);
            let axis = along(&vec![Bounded::zero(); positions], direction);
            let (t, h) = (along(&[t], of(N + U))[0], along(&[h], of(N + U + 1))[0]);
            let start = D::Configuration::from_components(&speeds(&constants(&list(&q.components()))));
            let (q_dual, z_dual) = step(
                dual,
                t,
                &start.retract(&speeds(&axis)),
                &speeds(&along(&list(&z), of(positions))),
                &speeds(&along(&list(&input), of(N))),
                h,
            );
            let rates = |duals: Vec<Dual<Bounded>>| -> Vec<Bounded> { duals.iter().map(|x| x.rate).collect() };
            let moved: Increment<B> = q_end.tangent(&speeds(&rates(list(&q_dual.components()))));
            let expected = [list(&moved), rates(list(&z_dual))].concat();
            let column: Vec<Bounded> = (0..N)
                .map(|row| match of(N) {
                    NONE => found.by_state[(row, direction)],
                    k if k < U => found.by_input[(row, k)],
                    k if k == U => found.by_time[row],
                    _ => found.by_step[row],
                })
                .collect();
            equal(&format!("direction {direction}"), &column, &expected).unwrap();
            let size = column.iter().fold(1.0_f64, |m, x| m.max(x.value.abs()));
            let sharp = |column: &[Bounded]| column.iter().all(|x| x.bound <= 1e-9 * size);
            told += usize::from(sharp(&column) && sharp(&expected));
            all += 1;
        }
    }
    // Bounds are those of the worst case: most must be small, or agreement would say nothing.
    assert!(10 * told >= 9 * all, "only {told} of {all} columns are known to 1e-9");
}

/// One body, with what acts on it depending on everything, in a chart.
macro_rules! driven {
    ($name:ident, [$($chart:tt)+], $motion:ident) => {
        #[derive(GaussDynamics)]
        #[gauss(
            linearize,
            chart = $($chart)+,
            motion = $motion,
            input(thrust, turn),
            force(at = [0.3, -0.2, 0.1], value = [thrust * cos(t), thrust + body.body_velocity.x, 0.5 * thrust]),
            torque(value = [turn * sin(t), turn - body.position.y, body.body_angular_velocity.z * turn]),
            spring(from = [3, 1, -2], to = body.position + body.rotation * [0.4, 0, 0], stiffness = k, length = 1, damping = k),
        )]
        struct $name<T> {
            #[gauss(mass)]
            m: T,
            #[gauss(center_of_mass)]
            center: Vector3<T>,
            #[gauss(inertia)]
            inertia: Matrix3<T>,
            #[gauss(gravity)]
            g: T,
            k: T,
        }

        impl<T: Real> $name<T> {
            fn sample() -> Self {
                let n = T::from_f64;
                let inertia = [[1.5, 0.1, -0.2], [0.1, 2.0, 0.15], [-0.2, 0.15, 2.5]];
                Self {
                    m: n(2.0),
                    center: Vector3::from([0.1, -0.2, 0.05].map(n)),
                    inertia: Matrix3::from(inertia.map(|row| row.map(n))),
                    g: n(2.5),
                    k: n(1.5),
                }
            }
        }
    };
}

macro_rules! charts {
    ($($test:ident: $name:ident, [$($chart:tt)+], $motion:ident, $origin:expr;)+) => {$(
        driven!($name, [$($chart)+], $motion);

        #[test]
        fn $test() {
            let (bounded, dual) = ($name::<Bounded>::sample().kernel(), $name::<Dual<Bounded>>::sample().kernel());
            check($origin, &bounded.unwrap(), &dual.unwrap());
        }
    )+};
}

fn coordinates<const N: usize>(values: [f64; N]) -> SVector<Bounded, N> {
    SVector::from(values.map(Bounded::from_f64))
}

fn unturned() -> UnitQuaternion<Bounded> {
    Configuration::from_components(&coordinates([0.0, 0.0, 0.0, 1.0]))
}

fn at_home() -> Isometry3<Bounded> {
    Configuration::from_components(&coordinates([0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]))
}

charts! {
    free_left: FreeLeft, [left_invariant], free, at_home();
    free_right: FreeRight, [right_invariant], free, at_home();
    free_hybrid: FreeHybrid, [hybrid], free, at_home();
    free_euler: FreeEuler, [jet(euler_zyx)], free, coordinates([0.0; 6]);
    held_left: HeldLeft, [left_invariant], fixed_point, unturned();
    held_right: HeldRight, [right_invariant], fixed_point, unturned();
    plane_left: PlaneLeft, [left_invariant], planar, Configuration::from_components(&coordinates([1.0, 0.0, 0.0, 0.0]));
    plane_hybrid: PlaneHybrid, [hybrid], planar, Configuration::from_components(&coordinates([1.0, 0.0, 0.0, 0.0]));
}

fn rigid<T: Real>(mass: f64, x: f64) -> RigidBody<T> {
    let inertia = [[1.3, 0.1, -0.2], [0.1, 1.7, 0.05], [-0.2, 0.05, 2.1]];
    RigidBody {
        mass: T::from_f64(mass),
        center_of_mass: Vector3::from([x, 0.1, -0.05].map(T::from_f64)),
        inertia: Matrix3::from(inertia.map(|row| row.map(T::from_f64))),
    }
}

/// A hull with a rotor that slides: elements of both groups after a scalar.
#[derive(GaussDynamics)]
#[gauss(
    linearize,
    coordinates(s, base: Pose, wheel: Rotation),
    body(hull, position = base.position, rotation = base.rotation),
    body(rotor, parent = hull, position = [0.2, 0, s], rotation = wheel),
    input(motor, push: Vector3),
    torque(body = rotor, value = [0, cos(t), motor], reaction = hull),
    force(body = hull, value = push),
    spring(along = s, stiffness = k, length = 0.5, damping = k),
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

impl<T: Real> Gyrostat<T> {
    fn sample() -> Self {
        Self { hull: rigid(2.0, 0.3), rotor: rigid(1.0, -0.1), g: T::from_f64(2.5), k: T::from_f64(3.0) }
    }
}

#[test]
fn groups_and_scalars() {
    let (bounded, dual) = (Gyrostat::<Bounded>::sample().kernel(), Gyrostat::<Dual<Bounded>>::sample().kernel());
    check((at_home(), (unturned(), coordinates([0.4]))), &bounded.unwrap(), &dual.unwrap());
}

/// A point of the body keeps to a plane that sways: multipliers; the step is the one before it is projected.
#[derive(GaussDynamics)]
#[gauss(
    linearize,
    coordinates(attitude: Rotation, x),
    body(hull, position = [x, 0, 0], rotation = attitude),
    point(tip, body = hull, at = [0.5, 0.1, 0.6]),
    constraint(velocity = rate(tip).z - 0.3 * sin(t)),
    input(push),
    force(body = hull, value = [push, 0, 0]),
)]
struct Led<T> {
    #[gauss(body)]
    hull: RigidBody<T>,
    #[gauss(gravity)]
    g: T,
}

#[test]
fn constraints_with_multipliers() {
    fn sample<T: Real>() -> Led<T> {
        Led { hull: rigid(2.0, 0.3), g: T::from_f64(2.5) }
    }
    let (bounded, dual) = (sample::<Bounded>().kernel().unwrap(), sample::<Dual<Bounded>>().kernel().unwrap());
    check((unturned(), coordinates([0.2])), &bounded, &dual);
}

/// The state `q ∘ exp(σ), z + δz`.
fn moved<S: GaussSystem<Scalar = f64>, const N: usize>(
    (q, z): &(S::Configuration, S::Speeds),
    x: &SVector<f64, N>,
) -> (S::Configuration, S::Speeds) {
    let positions = Increment::<S>::DIM;
    let components = list(x);
    (q.retract(&speeds(&components[..positions])), z.add_scaled(1.0, &speeds(&components[positions..])))
}

/// (σ, δz) from the first state to the second.
fn apart<S: GaussSystem<Scalar = f64>, const N: usize>(
    from: &(S::Configuration, S::Speeds),
    to: &(S::Configuration, S::Speeds),
) -> SVector<f64, N> {
    let sigma = from.0.difference(&to.0);
    speeds(&[list(&sigma), list(&to.1.add_scaled(-1.0, &from.1))].concat())
}

/// Central differences over e and 2e, extrapolated: they are off by e⁴ times a fifth derivative and some roundings over
/// e.
fn slope<const N: usize>(f: impl Fn(f64) -> SVector<f64, N>) -> SVector<f64, N> {
    let central = |e: f64| (f(e) - f(-e)) / (2.0 * e);
    (central(1e-3) * 4.0 - central(2e-3)) / 3.0
}

/// Fifth derivatives up to 1e3 (springs and gyroscopic terms of some units, over steps shorter than one), and a hundred
/// roundings.
const SLOPE_ERROR: f64 = 4.0 * 1e-12 * 1e3 / 120.0 + 100.0 * f64::EPSILON / 1e-3;

#[test]
fn differences_of_the_same_step() {
    let kernel = FreeHybrid::<f64>::sample().kernel().unwrap();
    let mut random = Random(3);
    let start = (Isometry3::identity().retract(&random.vector(1.0)), random.vector(1.0));
    let (t, h, input) = (0.4, 0.1, random.vector(1.0));
    let found = CommutatorFree4.step_linearized(&kernel, t, &start.0, &start.1, &input, h).unwrap();
    let end = (found.q, found.z);
    type S = FreeHybridKernel<f64>;
    let near = |what: &str, found: SVector<f64, 12>, expected: SVector<f64, 12>| {
        let error = (found - expected).amax();
        assert!(error < SLOPE_ERROR, "{what}: {error:e}");
    };
    for k in 0..12 {
        let by = slope(|e| {
            let (q, z) = moved::<S, 12>(&start, &SVector::from_fn(|i, _| if i == k { e } else { 0.0 }));
            apart::<S, 12>(&end, &step(&kernel, t, &q, &z, &input, h))
        });
        near(&format!("state {k}"), found.by_state.column(k).into(), by);
    }
    for k in 0..2 {
        let by = slope(|e| {
            let mut input: SVector<f64, 2> = input;
            input[k] += e;
            apart::<S, 12>(&end, &step(&kernel, t, &start.0, &start.1, &input, h))
        });
        near(&format!("input {k}"), found.by_input.column(k).into(), by);
    }
    near("t", found.by_time, slope(|e| apart::<S, 12>(&end, &step(&kernel, t + e, &start.0, &start.1, &input, h))));
    near("h", found.by_step, slope(|e| apart::<S, 12>(&end, &step(&kernel, t, &start.0, &start.1, &input, h + e))));
}

/// Many steps as one, against differences of the run that makes them.
#[test]
fn steps_after_one_another() {
    let kernel = Gyrostat::<f64>::sample().kernel().unwrap();
    type S = GyrostatKernel<f64>;
    let mut random = Random(11);
    let home = (Isometry3::identity(), (UnitQuaternion::identity(), SVector::from([0.4])));
    let start: (_, SVector<f64, 10>) = (home.retract(&random.vector(1.0)), random.vector(1.0));
    let held: SVector<f64, 4> = random.vector(1.0);
    let (t, h, steps) = (0.3, 0.05, 12);
    let run = |(q, z): (<S as GaussSystem>::Configuration, SVector<f64, 10>), t: f64, held: SVector<f64, 4>| {
        let mut state = (q, z);
        for n in 0..steps {
            state = step(&kernel, t + f64::from(n) * h, &state.0, &state.1, &held, h);
        }
        state
    };
    let one = |t: f64, q: &_, z: &_| CommutatorFree4.step_linearized(&kernel, t, q, z, &held, h).unwrap();
    let mut found = one(t, &start.0, &start.1);
    for n in 1..steps {
        found = found.then(&one(t + f64::from(n) * h, &found.q, &found.z));
    }
    let end = run(start, t, held);
    // Some hundred roundings a step, of numbers up to 10.
    let rounding = 1e3 * f64::from(steps) * f64::EPSILON;
    assert!(apart::<S, 20>(&end, &(found.q, found.z)).amax() < rounding);
    assert!((found.t - t - f64::from(steps) * h).abs() < rounding);
    // The motion carries on the errors of each step: up to the largest entry.
    let allowed = SLOPE_ERROR * found.by_state.amax() * f64::from(steps);
    for k in 0..20 {
        let by = slope(|e| {
            let start = moved::<S, 20>(&start, &SVector::from_fn(|i, _| if i == k { e } else { 0.0 }));
            apart::<S, 20>(&end, &run(start, t, held))
        });
        assert!((found.by_state.column(k) - by).amax() < allowed, "state {k}");
    }
    for k in 0..4 {
        let by = slope(|e| {
            let mut held = held;
            held[k] += e;
            apart::<S, 20>(&end, &run(start, t, held))
        });
        assert!((found.by_input.column(k) - by).amax() < allowed, "input {k}");
    }
    let by_time = slope(|e| apart::<S, 20>(&end, &run(start, t + e, held)));
    assert!((found.by_time - by_time).amax() < allowed);
}

/// A heavy top: a potential is all that acts.
#[derive(GaussDynamics)]
#[gauss(linearize, motion = fixed_point)]
struct Top<T> {
    #[gauss(mass)]
    m: T,
    #[gauss(center_of_mass)]
    center: Vector3<T>,
    #[gauss(inertia)]
    inertia: Vector3<T>,
    #[gauss(gravity)]
    g: T,
}

impl<T: Real> Top<T> {
    fn sample() -> Self {
        let n = T::from_f64;
        let (center, inertia) = ([0.02, -0.01, 0.1].map(n), [0.08, 0.09, 0.04].map(n));
        Self { m: n(1.5), center: center.into(), inertia: inertia.into(), g: n(9.81) }
    }
}

/// The flow keeps the volume of phase space (Liouville), which in body axes is that of (σ, z): momenta are I ω, and the
/// volume of SO(3) is the same seen from either side. So the determinant of a step of order 4 is 1 up to h⁵.
#[test]
fn steps_keep_the_volume_up_to_their_order() {
    let kernel = Top::<f64>::sample().kernel().unwrap();
    let (q, z) = (UnitQuaternion::from_euler_angles(0.4, 0.7, -0.3), Vector3::new(2.0, -1.5, 6.0));
    let excess = |h: f64| {
        let step = CommutatorFree4.step_linearized(&kernel, 0.0, &q, &z, &(), h).unwrap();
        (step.by_state.determinant() - 1.0).abs()
    };
    // A hundredth of a turn and less: the next power of h counts less than a quarter of an order.
    let (coarse, fine) = (excess(0.016), excess(0.004));
    let order = (coarse / fine).ln() / 4.0_f64.ln();
    assert!(fine > 1e3 * f64::EPSILON && (order - 5.0).abs() < 0.25, "order {order}: {coarse:e}, {fine:e}");
}

/// Φ(h) = 1 + hF + …, and the state moves with its rate.
#[test]
fn short_steps_are_the_equations() {
    let kernel = FreeLeft::<f64>::sample().kernel().unwrap();
    let mut random = Random(5);
    let (q, z) = (Isometry3::identity().retract(&random.vector(1.0)), random.vector(1.0));
    let (t, input) = (0.2, random.vector(1.0));
    let linear = kernel.linearize(t, &q, &z, &input);
    let step = |h: f64| CommutatorFree4.step_linearized(&kernel, t, &q, &z, &input, h).unwrap();
    let h = 1e-4;
    let (ahead, back) = (step(h), step(-h));
    // Third derivatives of up to 100; ten roundings over h.
    let allowed = 100.0 * h * h / 6.0 + 10.0 * f64::EPSILON / h;
    let slope = (ahead.by_state - back.by_state) / (2.0 * h);
    assert!((slope - error_matrix::<FreeLeftKernel<f64>>(&linear)).amax() < allowed);
    assert!(((ahead.by_input - back.by_input) / (2.0 * h) - linear.by_input).amax() < allowed);
    let at_once = step(0.0);
    assert!((at_once.by_step - linear.rate).amax() < 10.0 * f64::EPSILON * linear.rate.amax());
    assert_eq!(at_once.by_state, SMatrix::<f64, 12, 12>::identity());
    assert_eq!((at_once.by_input.amax(), at_once.by_time.amax()), (0.0, 0.0));
}

#[test]
fn lanes_and_single_precision() {
    type Pack = Lanes<f64, 4>;
    let (kernel, packs) = (Top::<f64>::sample().kernel().unwrap(), Top::<Pack>::sample().kernel().unwrap());
    let single = Top::<f32>::sample().kernel().unwrap();
    let q = UnitQuaternion::from_euler_angles(0.4, 0.7, -0.3);
    // From no turn at all to more than the short series serve.
    let spin = |lane: usize| Vector3::new(0.3, -0.2, 1.0) * (20.0 * lane as f64);
    let vector = SVector::from(std::array::from_fn(|i| Pack::from_fn(|lane| spin(lane)[i])));
    let wide_q = Configuration::from_components(&SVector::from(q.components().data.0[0].map(Pack::splat)));
    let together =
        CommutatorFree4.step_linearized(&packs, Pack::splat(0.0), &wide_q, &vector, &(), Pack::splat(0.02)).unwrap();
    for lane in 0..4 {
        let alone = CommutatorFree4.step_linearized(&kernel, 0.0, &q, &spin(lane), &(), 0.02).unwrap();
        let roughly = CommutatorFree4.step_linearized(&single, 0.0, &q.cast(), &spin(lane).cast(), &(), 0.02).unwrap();
        let size = alone.by_state.amax();
        for (i, &expected) in alone.by_state.iter().enumerate() {
            // Small lanes take the long series beside others that are not: some roundings of what coefficients
            // multiply.
            assert!((together.by_state[i][lane] - expected).abs() < 100.0 * f64::EPSILON * size, "lane {lane}, {i}");
            let error = (f64::from(roughly.by_state[i]) - expected).abs();
            assert!(error < 1e3 * f64::from(f32::EPSILON) * size, "lane {lane}, {i}: {error:e}");
        }
    }
}

/// Second derivatives, by the mass and by what is structurally there but zero at this state: nothing is left out that
/// has a rate.
#[test]
fn dual_numbers_differentiate_once_more() {
    use gauss_adapters::DualNumber;
    use num_dual::Dual64;
    let q = UnitQuaternion::<f64>::from_euler_angles(0.4, 0.7, -0.3);
    // ω₂ = 0 makes entries of the derivatives zero that vary with it.
    let by_state = |mass: f64, omega: f64| {
        let kernel = Top { m: mass, ..Top::<f64>::sample() }.kernel().unwrap();
        let z = Vector3::new(2.0, omega, 6.0);
        CommutatorFree4.step_linearized(&kernel, 0.0, &q, &z, &(), 0.05).unwrap().by_state
    };
    let number = |value: f64| DualNumber(Dual64::from_re(value));
    let dual = |mass: DualNumber<Dual64>, omega: DualNumber<Dual64>| {
        let kernel = Top { m: mass, ..Top::<DualNumber<Dual64>>::sample() }.kernel().unwrap();
        let z = Vector3::new(number(2.0), omega, number(6.0));
        let q = Configuration::from_components(&SVector::from(q.components().data.0[0].map(number)));
        CommutatorFree4.step_linearized(&kernel, number(0.0), &q, &z, &(), number(0.05)).unwrap().by_state
    };
    let variable = |value: f64| DualNumber(Dual64::from_re(value).derivative());
    for (which, found) in [dual(variable(1.5), number(0.0)), dual(number(1.5), variable(0.0))].into_iter().enumerate() {
        let at = |e: f64| if which == 0 { by_state(1.5 + e, 0.0) } else { by_state(1.5, e) };
        let expected = slope(|e| SVector::<f64, 36>::from_column_slice(at(e).as_slice()));
        for (i, entry) in found.iter().enumerate() {
            assert!((entry.eps - expected[i]).abs() < SLOPE_ERROR, "{which}, {i}: {} for {}", entry.eps, expected[i]);
        }
    }
}

#[test]
fn what_cannot_be_stepped_is_refused() {
    let kernel = Top::<f64>::sample().kernel().unwrap();
    let (q, z) = (UnitQuaternion::identity(), Vector3::new(0.0, 0.0, 40.0));
    let error = CommutatorFree4.step_linearized(&kernel, 0.0, &q, &z, &(), 0.2).unwrap_err();
    assert!(matches!(error, IntegrationErrorKind::IncrementTooLarge { angle } if (angle - 4.0).abs() < 1e-12));
    let error = CommutatorFree4.step_linearized(&kernel, 0.0, &q, &(z * f64::NAN), &(), 0.2).unwrap_err();
    assert_eq!(error, IntegrationErrorKind::NonFinite { part: RunPart::Step });
    let angles = FreeEuler::<f64>::sample().kernel().unwrap();
    let locked = SVector::from([0.0, 0.0, 0.0, 0.0, std::f64::consts::FRAC_PI_2, 0.0]);
    let (still, no_input) = (SVector::zeros(), SVector::zeros());
    let error = CommutatorFree4.step_linearized(&angles, 0.0, &locked, &still, &no_input, 0.02).unwrap_err();
    assert!(matches!(error, IntegrationErrorKind::SingularChart { .. }), "{error:?}");
}
