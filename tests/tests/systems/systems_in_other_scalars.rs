//! A system of a pose, coordinates and a constraint, in other scalars than `f64`: single precision, dual numbers, and
//! numbers with bounds on their rounding.

use crate::common::Bounded;
use crate::common::agreement::{equal, zero};
use crate::common::body::{Parts, constant, duals, list, rates, speeds};
use crate::common::dual::Dual;
use gauss_runtime::prelude::*;
use proptest::prelude::*;
use proptest::test_runner::TestCaseError;

/// A frame and a load, a free particle, on a cable of fixed length.
#[derive(Clone, Copy, Debug, GaussDynamics)]
#[gauss(
    coordinates(pose: Pose, x, y, z),
    body(hull, position = pose.position, rotation = pose.rotation),
    point(hook, body = hull, at = h),
    particle(mass = load, position = [x, y, z]),
    constraint(position = dot([x, y, z] - hook, [x, y, z] - hook) - l * l)
)]
struct Slung<T> {
    #[gauss(body)]
    hull: RigidBody<T>,
    h: Vector3<T>,
    load: T,
    l: T,
    #[gauss(gravity)]
    g: T,
}

type State<T> = ((Isometry3<T>, SVector<T, 3>), SVector<T, 9>);

fn slung<T: Real>() -> SlungKernel<T> {
    let vector = |v: [f64; 3]| Vector3::from(v.map(T::from_f64));
    let inertia = [[0.02, 0.001, -0.0005], [0.001, 0.025, 0.0008], [-0.0005, 0.0008, 0.035]];
    let hull = RigidBody {
        mass: T::from_f64(1.2),
        center_of_mass: vector([0.01, -0.02, 0.03]),
        inertia: Matrix3::from_fn(|i, j| T::from_f64(inertia[i][j])),
    };
    let (load, l, g) = (T::from_f64(0.5), T::from_f64(0.8), T::from_f64(9.81));
    Slung { hull, h: vector([0.05, 0.02, -0.1]), load, l, g }.kernel().expect("it is a body")
}

/// The same state in another scalar.
fn lift<T: Real>((q, z): &State<f64>, make: impl Fn(f64) -> T) -> State<T> {
    let all = |values: Vec<f64>| values.into_iter().map(&make).collect::<Vec<T>>();
    ((Isometry3::assemble(&all(q.0.parts())), SVector::assemble(&all(q.1.parts()))), speeds(&all(list(z))))
}

/// The state with its velocity in the dual parts.
fn moving(kernel: &SlungKernel<f64>, (q, z): &State<f64>) -> State<Dual<f64>> {
    let velocity = kernel.kinematics(0.0, q, z);
    let rate = kernel.acceleration(0.0, q, z, &());
    (
        (
            Isometry3::assemble(&duals(&q.0.parts(), &q.0.rates(&velocity.first))),
            SVector::assemble(&duals(&q.1.parts(), &velocity.second.parts())),
        ),
        speeds(&duals(&list(z), &list(&rate))),
    )
}

prop_compose! {
    /// States on the constraint.
    fn state()(
        turn in prop::array::uniform3(-1.7..1.7_f64), position in prop::array::uniform3(-2.0..2.0_f64),
        cable in prop::array::uniform3(-1.0..1.0_f64)
            .prop_filter("a direction", |v| v.iter().map(|c| c * c).sum::<f64>() > 0.1),
        z in prop::array::uniform9(-2.0..2.0_f64),
    ) -> State<f64> {
        let rotation = UnitQuaternion::from_scaled_axis(Vector3::from(turn));
        let pose = Isometry3 { rotation, translation: Translation3 { vector: Vector3::from(position) } };
        let load = Vector3::from(position) + Vector3::from(cable);
        slung::<f64>().project(0.0, &(pose, load), &SVector::from(z)).expect("the cable has a direction")
    }
}

fn dual_numbers_follow_the_motion(at: &State<f64>) {
    let kernel = slung::<Dual<f64>>();
    let (q, z) = moving(&slung(), at);
    let t = constant(0.0);
    // Along the motion the energy is constant and the constraint holds, twice differentiated; p has the rate ṗ.
    let p = slung::<f64>().momentum(0.0, &at.0, &at.1);
    let rate = slung::<f64>().momentum_rate(0.0, &at.0, &p, &());
    let along = rates(&list(&kernel.momentum(t, &q, &z)));
    // Some hundred roundings of forces of some hundred (the cable may pull strongly: rates up to ten, squared).
    let allowed = 1e3 * f64::EPSILON * rate.amax().max(100.0);
    assert!(list(&rate).iter().zip(&along).all(|(a, b)| (a - b).abs() <= allowed), "{rate} {along:?}");
    assert!(kernel.energy(t, &q, &z).rate.abs() <= 10.0 * allowed);
    assert!(kernel.position_residual(t, &q).component(0).rate.abs() <= allowed);
    assert!(kernel.velocity_residual(t, &q, &z).component(0).rate.abs() <= allowed);
    // Projection keeps derivatives of states on the constraint: the motion is tangent to it.
    let (again, _) = kernel.project(t, &q, &z).expect("it is on the constraint");
    let moved = rates(&again.1.parts()).iter().zip(rates(&q.1.parts())).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
    assert!(moved <= allowed, "{moved:e}");
}

fn single_precision_agrees(at: &State<f64>) {
    let (kernel, single) = (slung::<f64>(), slung::<f32>());
    let (q, z) = lift(at, |x| x as f32);
    let (q, z) = single.project(0.0, &q, &z).expect("it is on the constraint up to rounding");
    let residual = single.position_residual(0.0, &q).component(0);
    assert!(residual.abs() <= 64.0 * f32::EPSILON, "{residual:e}");
    let found = list(&single.acceleration(0.0, &q, &z, &()));
    let expected = list(&kernel.acceleration(0.0, &at.0, &at.1, &()));
    let size = expected.iter().fold(10.0_f64, |m, a| m.max(a.abs()));
    // The moments of the hull are a fiftieth of its mass: that much some tens of roundings are blown up.
    let allowed = 1000.0 * f64::from(f32::EPSILON) * size;
    let error = found.iter().zip(&expected).fold(0.0_f64, |m, (a, b)| m.max((f64::from(*a) - b).abs()));
    assert!(error <= allowed, "{error:e}, allowed {allowed:e}");
    let (found, expected) = (single.multipliers(0.0, &q, &z, &())[0], kernel.multipliers(0.0, &at.0, &at.1, &())[0]);
    assert!((f64::from(found) - expected).abs() <= allowed, "{found} {expected}");
}

/// The residual at ż, the momentum form and the constraint differentiated, within bounds that rounding is proved to
/// keep.
fn bounds_hold(at: &State<f64>) -> Result<(), TestCaseError> {
    let kernel = slung::<Bounded>();
    let (q, z) = lift(at, |x| Bounded::measured(x, 0.0));
    let t = Bounded::zero();
    let acceleration = kernel.acceleration(t, &q, &z, &());
    let residual = list(&kernel.gauss_residual(t, &q, &z, &acceleration, &()));
    zero("residual", &residual)?;
    // The bounds are worst cases of some thousand roundings of forces of a hundred: they say something.
    prop_assert!(residual.iter().all(|r| r.bound <= 1e-11), "{residual:?}");
    let p = kernel.momentum(t, &q, &z);
    equal("z of p", &list(&kernel.velocity(t, &q, &p)), &list(&z))?;
    let twice = kernel.kinetic_energy(t, &q, &z) * Bounded::from_f64(2.0);
    let product = list(&p).into_iter().zip(list(&z)).fold(Bounded::zero(), |sum, (a, b)| sum + a * b);
    equal("2T", &[twice], &[product])
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_system_in_every_scalar(at in state()) {
        dual_numbers_follow_the_motion(&at);
        single_precision_agrees(&at);
        bounds_hold(&at)?;
    }
}

/// A second of motion in single precision ends where the one in double precision does.
#[test]
fn a_run_in_single_precision() {
    let rotation = UnitQuaternion::from_scaled_axis(Vector3::new(0.3, -0.8, 0.5));
    let pose = Isometry3 { rotation, translation: Translation3::new(0.3, -0.4, 10.0) };
    let z = SVector::from([1.0, -0.5, 0.8, 2.0, -1.5, 0.8, 0.5, 0.2, -0.3]);
    let at = slung::<f64>().project(0.0, &(pose, Vector3::new(0.5, -0.1, 9.4)), &z).unwrap();
    let end = Simulation::new(&slung::<f64>()).adaptive(1e-10, 1e-10).run_to_end(at.0, at.1, 0.0..1.0).unwrap();
    let (q, z) = lift(&at, |x| x as f32);
    let (kernel, mut gap) = (slung::<f32>(), 0.0_f32);
    let single = Simulation::new(&kernel)
        .fixed_step(0.005)
        .observe(|sample| gap = gap.max(kernel.position_residual(sample.t, &sample.q)[0].abs()))
        .run_to_end(q, z, 0.0..1.0)
        .unwrap();
    // Heights of ten metres have 1e-6, and differences of them close the cable.
    assert!(gap <= 32.0 * f32::EPSILON * 10.0, "{gap:e}");
    let far = single.q.1.iter().zip(&end.q.1).fold(0.0_f64, |m, (a, b)| m.max((f64::from(*a) - b).abs()));
    // Two hundred steps of some roundings each, in positions of ten.
    assert!(far <= 200.0 * 10.0 * f64::from(f32::EPSILON), "{far:e}");
}
