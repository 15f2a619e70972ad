//! Slots in packs and in dual numbers: lanes with the bits of single runs, derivatives beside those of the clause and
//! of differences; and their energy.

use gauss_contact::{ContactEnsemble, ContactLanes, ContactRun, ContactStepper, InMode, Mode, Slot, Slots};
use gauss_runtime::dual::Dual;
use gauss_runtime::prelude::*;

/// A crate on its eight corners, by its clause.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(hull, position = pose.position, rotation = pose.rotation, mass = 2, inertia = [0.06, 0.05, 0.04]),
    contact(floor, point = hull.position, edges = [0.4, 0.3, 0.2], friction = mu, restitution = e),
    input(push: Vector3), force(body = hull, value = push),
)]
struct Clause<T> {
    mu: T,
    e: T,
    #[gauss(gravity)]
    g: T,
}

/// The same without contacts.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(hull, position = pose.position, rotation = pose.rotation, mass = 2, inertia = [0.06, 0.05, 0.04]),
    input(push: Vector3), force(body = hull, value = push),
    frames(hull),
)]
struct Bare<T> {
    #[gauss(gravity)]
    g: T,
}

type Corners<'k, T> = Slots<'k, BareKernel<T>, 8, 24, 6>;
type State = (Isometry3<f64>, SVector<f64, 6>);

fn bare<T: Real>(g: T) -> BareKernel<T> {
    Bare { g }.kernel().unwrap()
}

fn clause<T: Real>([mu, e, g]: [T; 3]) -> ClauseKernel<T> {
    Clause { mu, e, g }.kernel().unwrap()
}

/// Slots for points of the hull over a floor at a height, whose normal is of any length.
fn over_floor<'k, T: Real>(
    kernel: &'k BareKernel<T>,
    [mu, e]: [T; 2],
    height: T,
    points: &[[f64; 3]],
) -> Corners<'k, T> {
    let number = T::from_f64;
    let slot = |point: &[f64; 3]| Slot {
        first: Some(BareFrame::hull),
        point: point.map(number).into(),
        radius: T::zero(),
        second: None,
        origin: [number(3.0), number(-1.0), height].into(),
        normal: [T::zero(), T::zero(), number(2.0)].into(),
        friction: mu,
        restitution: e,
    };
    let mut slots = Slots::new(kernel);
    slots.fill(points.iter().map(slot)).unwrap();
    slots
}

/// A slot for each corner.
fn corners<T: Real>(kernel: &BareKernel<T>, surface: [T; 2], height: T) -> Corners<'_, T> {
    let side = |i: usize, k: usize, edge: f64| if i >> k & 1 == 0 { -0.5 * edge } else { 0.5 * edge };
    let points: [_; 8] = std::array::from_fn(|i| [side(i, 0, 0.4), side(i, 1, 0.3), side(i, 2, 0.2)]);
    over_floor(kernel, surface, height, &points)
}

/// Three feet, which do not depend on one another; five slots are not used.
fn tripod<T: Real>(kernel: &BareKernel<T>, surface: [T; 2]) -> Corners<'_, T> {
    over_floor(kernel, surface, T::zero(), &[[-0.2, -0.15, -0.1], [0.2, -0.15, -0.1], [0.0, 0.15, -0.1]])
}

fn thrown() -> State {
    let pose = Isometry3::new(Vector3::new(0.1, -0.2, 0.6), Vector3::new(0.4, -0.7, 0.3));
    (pose, SVector::from([0.7, -0.2, 0.3, 1.0, -2.0, 0.5]))
}

type Eight = Lanes<f64, 8>;
const H: f64 = 4e-3;

/// Data of a lane: friction, restitution, the height of the floor.
fn data(lane: usize) -> [f64; 3] {
    let n = lane as f64;
    [0.2 + 0.1 * n, 0.05 * n, 0.01 * n]
}

fn starts(lane: usize) -> State {
    let (q, z) = thrown();
    if lane.is_multiple_of(3) {
        // It stands, and slides.
        (Isometry3::translation(0.0, 0.0, 0.1 + data(lane)[2]), SVector::from([1.0, 0.2, 0.0, 0.0, 0.0, 0.0]))
    } else {
        (q, z * (1.0 - 0.1 * lane as f64))
    }
}

fn wide(kernel: &BareKernel<Eight>) -> Corners<'_, Eight> {
    let [mu, e, height] = [0, 1, 2].map(|k| Eight::from_fn(|lane| data(lane)[k]));
    corners(kernel, [mu, e], height)
}

fn singles(kernel: &BareKernel<f64>, count: usize) -> Vec<Corners<'_, f64>> {
    let single = |lane: usize| {
        let [mu, e, height] = data(lane % 8);
        corners(kernel, [mu, e], height)
    };
    (0..count).map(single).collect()
}

fn steppers<'k>(slots: &'k [Corners<'k, f64>]) -> Vec<ContactStepper<'k, Corners<'k, f64>>> {
    let stepper = |(n, slots): (usize, &'k Corners<'k, f64>)| {
        let (q, z) = starts(n % 8);
        ContactStepper::new(slots, 0.0, q, z * (1.0 + 0.01 * (n / 8) as f64)).unwrap()
    };
    slots.iter().enumerate().map(stepper).collect()
}

fn same(a: &ContactStepper<'_, Corners<'_, f64>>, b: &ContactStepper<'_, Corners<'_, f64>>) -> bool {
    let state = |of: &ContactStepper<'_, Corners<'_, f64>>| (of.time(), *of.configuration(), *of.speeds());
    state(a) == state(b) && a.impulses() == b.impulses() && a.modes() == b.modes() && a.report() == b.report()
}

#[test]
fn lanes_of_slots_have_the_bits_and_the_data_of_single_ones() {
    let (kernel, packs) = (bare(9.81), bare(Eight::splat(9.81)));
    let (slots, wide) = (singles(&kernel, 8), wide(&packs));
    let mut alone = steppers(&slots);
    let mut lanes = ContactLanes::of(&wide, steppers(&slots)).unwrap();
    let push = SVector::from([Eight::splat(0.3), Eight::splat(-0.2), Eight::splat(0.1)]);
    for n in 0..300 {
        let outcomes: Vec<_> = lanes.step(H, &push).to_vec();
        for (lane, single) in alone.iter_mut().enumerate() {
            assert_eq!(outcomes[lane], single.step(H, &SVector::from([0.3, -0.2, 0.1])), "{n} {lane}");
            assert!(same(single, &lanes.steppers()[lane]), "{n} {lane}");
        }
    }
    // Some steps were made alone, most of them together.
    assert!(lanes.alone() > 0 && lanes.alone() < 8 * 300 * 3 / 4, "{}", lanes.alone());
    // Each lane has its own floor.
    let low = |lane: usize| lanes.steppers()[lane].configuration().translation.vector.z;
    assert!((low(6) - low(0) - 0.06).abs() < 1e-12, "{} {}", low(6), low(0));
}

#[test]
fn threads_of_slots_have_the_bits_of_one() {
    let (kernel, packs) = (bare(9.81), bare(Eight::splat(9.81)));
    let (slots, wide) = (singles(&kernel, 19), wide(&packs));
    let mut alone = steppers(&slots);
    let push = |n: usize| SVector::from([0.1 * n as f64, 0.0, 0.2]);
    for (n, single) in alone.iter_mut().enumerate() {
        (0..200).for_each(|_| assert!(single.step(H, &push(n)).is_ok()));
    }
    let mut ensemble = ContactEnsemble::new(&wide, steppers(&slots)).unwrap();
    #[cfg(feature = "rayon")]
    ensemble.advance_on_all_threads(H, 200, |n, _| push(n));
    #[cfg(not(feature = "rayon"))]
    ensemble.advance(H, 200, |n, _| push(n));
    assert_eq!(ensemble.failures().count(), 0);
    assert!(alone.iter().zip(ensemble.steppers()).all(|(a, b)| same(a, b)));
}

/// Friction and impacts take what is lost, as with the clause.
#[test]
fn energy_of_slots_is_accounted_for() {
    let (kernel, (q, z)) = (bare(9.81), thrown());
    let (slots, clause) = (corners(&kernel, [0.5, 0.2], 0.0), clause([0.5, 0.2, 9.81]));
    let push = SVector::from([0.3, -0.2, 0.1]);
    let run = ContactRun::new(&slots).input(move |_, _, _| push).adaptive(1e-11, 1e-11).run(q, z, 0.0..0.5).unwrap();
    let with_clause = ContactRun::new(&clause).input(move |_, _, _| push).adaptive(1e-11, 1e-11);
    let with_clause = with_clause.run(q, z, 0.0..0.5).unwrap().energy_balance().unwrap();
    let balance = run.energy_balance().unwrap();
    assert!(balance.impacts > 1.0 && balance.contacts < -1e-4 && balance.supplied.abs() > 1e-2, "{balance}");
    // Each step is off by 1e-11 of its speeds, and so twice that of the energy, some 15 J.
    assert!(balance.residual().abs() < 2e-11 * 15.0 * run.iter().count() as f64, "{balance}");
    let numbers = |b: gauss_contact::ContactBalance| [b.energy, b.supplied, b.contacts, b.impacts];
    for (a, b) in numbers(balance).into_iter().zip(numbers(with_clause)) {
        // Places agree to 1e-8 after impacts, forces are some 20 N.
        assert!((a - b).abs() < 1e-6, "{balance} {with_clause}");
    }
}

/// Kernels in dual numbers of one length compile once.
type Number = Dual<4>;

fn lifted<A: VectorSpace<f64>, B: VectorSpace<Number>>(from: &A) -> B {
    let mut to = B::zero();
    (0..A::DIM).for_each(|i| to.set_component(i, Number::constant(from.component(i))));
    to
}

fn variables(values: [f64; 3]) -> [Number; 3] {
    std::array::from_fn(|k| Dual::variable(values[k], k))
}

fn constants((q, z): State) -> (Isometry3<Number>, SVector<Number, 6>) {
    (Configuration::from_components(&lifted(&q.components())), lifted(&z))
}

/// Derivatives by friction, restitution and weight through an impact are those of the clause, in the same numbers.
#[test]
fn runs_of_slots_have_derivatives() {
    let [mu, e, g] = variables([0.5, 0.2, 9.81]);
    let (kernel, clause) = (bare(g), clause([mu, e, g]));
    let slots = corners(&kernel, [mu, e], Number::constant(0.0));
    let (q, z) = constants(thrown());
    let no_push = |_: Number, _: &Isometry3<Number>, _: &SVector<Number, 6>| SVector::from([Number::constant(0.0); 3]);
    // Then a slip touches zero, with the clause as well, and has no derivative.
    let span = || Number::constant(0.0)..Number::constant(0.38);
    let a = ContactRun::new(&slots).input(no_push).adaptive(1e-11, 1e-11).run(q, z, span()).unwrap();
    let b = ContactRun::new(&clause).input(no_push).adaptive(1e-11, 1e-11).run(q, z, span()).unwrap();
    assert!(!a.events().is_empty() && a.events().len() == b.events().len());
    let (a, b) = (a.last().unwrap(), b.last().unwrap());
    let all = |q: &Isometry3<Number>, z: &SVector<Number, 6>| -> Vec<Number> {
        q.components().iter().chain(z.iter()).copied().collect()
    };
    let mut largest = [0.0_f64; 3];
    for (a, b) in all(&a.q, &a.z).into_iter().zip(all(&b.q, &b.z)) {
        assert!((a.value - b.value).abs() < 1e-8, "{a:?} {b:?}");
        for (k, largest) in largest.iter_mut().enumerate() {
            // An impact makes differences of 1e-11 some hundred times as large, and derivatives by as much again.
            assert!((a.slopes[k] - b.slopes[k]).abs() < 1e-7 * (1.0 + b.slopes[k].abs()), "{k} {a:?} {b:?}");
            *largest = largest.max(a.slopes[k].abs());
        }
    }
    assert!(largest.iter().all(|slope| *slope > 1e-2), "{largest:?}");
}

/// Accelerations of a crate that turns about a corner: in its modes slots are a system whose derivatives are those of
/// the clause in the same ones.
#[test]
fn slots_in_their_modes_have_derivatives_at_a_state() {
    let (kernel, clause) = (bare(Number::constant(9.81)), clause([0.5, 0.0, 9.81].map(Number::constant)));
    let slots = corners(&kernel, [Number::constant(0.5), Number::constant(0.0)], Number::constant(0.0));
    let modes: [Mode<Number>; 8] = std::array::from_fn(|i| if i < 1 { Mode::Sticks } else { Mode::Open });
    let (slots, clause) = (InMode::new(&slots, &modes), InMode::new(&clause, &modes));
    let push = SVector::from([0.3, -0.2, 0.1].map(Number::constant));
    let (t, mut largest) = (Number::constant(0.0), 0.0_f64);
    for first in (0..12).step_by(4) {
        let (q, mut z) = constants(thrown());
        let direction = |i: usize| match i.checked_sub(first) {
            Some(k) if k < 4 => Dual { value: 0.0, ..Dual::variable(0.0, k) },
            _ => Dual::constant(0.0),
        };
        let q = q.retract(&SVector::from(std::array::from_fn(direction)));
        (0..6).for_each(|i| z[i] += direction(6 + i));
        let (a, b) = (slots.acceleration(t, &q, &z, &push), clause.acceleration(t, &q, &z, &push));
        for (a, b) in a.iter().zip(b.iter()) {
            assert!((a.value - b.value).abs() < 1e-11, "{a:?} {b:?}");
            for k in 0..4 {
                // Some hundred operations on numbers up to 1e2.
                assert!((a.slopes[k] - b.slopes[k]).abs() < 1e-9, "{first} {k}: {a:?} {b:?}");
                largest = largest.max(a.slopes[k].abs());
            }
        }
    }
    assert!(largest > 0.1, "{largest}");
}

/// Steps in flight, that land and slide, and on four corners that depend on one another: by state, input and parameters
/// beside the clause.
#[test]
fn steps_of_slots_have_the_derivatives_of_the_clause() {
    let values = [0.3, 0.2, 9.81];
    let [mu, e, g] = variables(values);
    let (kernel, with_clause) = (bare(values[2]), clause(values));
    let (dual, dual_clause) = (bare(g), clause([mu, e, g]));
    let slots = corners(&kernel, [values[0], values[1]], 0.0);
    let dual = corners(&dual, [mu, e], Dual::constant(0.0));
    let push = SVector::from([0.3, -0.2, 0.1]);
    for ((q, z), most, steps) in [(thrown(), 1, 150), (sliding(), 4, 10)] {
        let mut a = ContactStepper::new(&slots, 0.0, q, z).unwrap();
        let mut b = ContactStepper::new(&with_clause, 0.0, q, z).unwrap();
        let (mut closed, mut by_friction) = (0, 0.0_f64);
        for n in 0..steps {
            let found = a.step_with_derivatives::<_, 4, 12, 3, 3>(H, &push, &dual).unwrap();
            let expected = b.step_with_derivatives::<_, 4, 12, 3, 3>(H, &push, &dual_clause).unwrap();
            closed = closed.max(found.report.closed);
            by_friction = by_friction.max(found.by_parameters.column(0).amax());
            if found.at_change.is_some() || expected.at_change.is_some() {
                continue;
            }
            let parts = |of: &gauss_contact::StepDerivatives<12, 3, 3>| {
                [of.by_state.as_slice(), of.by_input.as_slice(), of.by_parameters.as_slice()].concat()
            };
            let (found, expected) = (parts(&found), parts(&expected));
            let size = expected.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
            for (a, b) in found.iter().zip(&expected) {
                // States agree to some 1e-12 until many impacts are made; laws are solved to 1e-9 of speeds.
                assert!((a - b).abs() < 1e-6 * size, "{n}: {a} {b}");
            }
        }
        assert!(closed >= most && by_friction > 1e-3, "{closed} {by_friction}");
    }
}

/// It lies, and slides and spins.
fn sliding() -> State {
    (Isometry3::translation(0.0, 0.0, 0.1), SVector::from([2.0, 0.3, 0.0, 0.0, 0.0, 0.4]))
}

/// The product of steps, of a crate that slides, beside differences of the run that makes them.
#[test]
fn steps_of_slots_after_one_another_are_a_run() {
    let kernel = bare(9.81);
    let slots = tripod(&kernel, [0.3, 0.0]);
    let constant = bare(Number::constant(9.81));
    let dual = tripod(&constant, [Dual::constant(0.3), Dual::constant(0.0)]);
    let (start, steps) = (sliding(), 20);
    let push = SVector::from([0.3, -0.2, 0.1]);
    // Each step is a function of the state.
    let run = |moved: &SVector<f64, 12>| {
        let q = start.0.retract(&moved.fixed_rows::<6>(0).into_owned());
        let stepper = ContactStepper::new(&slots, 0.0, q, start.1 + moved.fixed_rows::<6>(6)).unwrap();
        let (mut stepper, mut whole) = (stepper.tolerance(1e-12), SMatrix::<f64, 12, 12>::identity());
        for _ in 0..steps {
            let step = stepper.step_with_derivatives::<_, 4, 12, 3, 3>(H, &push, &dual).unwrap();
            assert_eq!(step.report.closed, 3);
            whole = step.by_state * whole;
        }
        (*stepper.configuration(), *stepper.speeds(), whole)
    };
    let end = run(&SVector::zeros());
    // What leaves it on the floor: places along it, turns about its normal, and the speeds of these.
    for k in [0, 1, 5, 6, 7, 11] {
        let at = |by: f64| {
            let (q, z, _) = run(&SVector::from_fn(|i, _| if i == k { by } else { 0.0 }));
            let sigma = end.0.difference(&q);
            SVector::<f64, 12>::from_fn(|i, _| if i < 6 { sigma[i] } else { z[i - 6] - end.1[i - 6] })
        };
        // Over e and 2e, extrapolated: off by e⁴ times a fifth derivative.
        let central = |e: f64| (at(e) - at(-e)) / (2.0 * e);
        let slope = (central(1e-3) * 4.0 - central(2e-3)) / 3.0;
        let error = (end.2.column(k) - slope).amax();
        // Laws are solved to 1e-12 of speeds in twenty steps, over e; fifth derivatives of some thousand.
        assert!(error < 20.0 * 1e-12 * 10.0 / 1e-3 + 4e-12 * 1e3, "{k}: {error:e}");
    }
    assert!((end.2[(6, 6)] - 1.0).abs() > 1e-3);
}
