//! Steps in lanes: the bits of single ones.

use gauss_contact::{ContactEnsemble, ContactErrorKind, ContactLanes, ContactStepper, StepLaw, StepScheme};
use gauss_runtime::prelude::*;

use crate::common::numbers;

/// A crate on a table, on its corners.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(hull, position = pose.position, rotation = pose.rotation, mass = m, inertia = m * a * a / 6),
    contact(table, point = hull.position, edges = [a, a, a], friction = mu, restitution = e),
)]
struct Crate<T> {
    m: T,
    a: T,
    mu: T,
    e: T,
    #[gauss(gravity)]
    g: T,
}

fn crate_of<T: Real>(mu: T, e: T) -> CrateKernel<T> {
    let f = T::from_f64;
    Crate { m: f(2.0), a: f(0.4), mu, e, g: f(9.81) }.kernel().unwrap()
}

type Eight = Lanes<f64, 8>;
type State = (Isometry3<f64>, SVector<f64, 6>);

/// Thrown, standing and sliding.
fn starts(number: &mut dyn FnMut() -> f64) -> Vec<State> {
    let mut start = |i: usize| {
        let (height, turn) = if i.is_multiple_of(3) { (0.2, 0.0) } else { (0.7 + 0.2 * number(), 1.0) };
        let axis = Vector3::new(number(), number(), number());
        let speeds = SVector::from_fn(|k, _| if k < 2 || turn > 0.0 { number() } else { 0.0 });
        (Isometry3::new(Vector3::new(number(), number(), height), turn * axis), speeds)
    };
    (0..8).map(&mut start).collect()
}

fn same(a: &ContactStepper<'_, CrateKernel<f64>>, b: &ContactStepper<'_, CrateKernel<f64>>) -> bool {
    let bits = |stepper: &ContactStepper<'_, CrateKernel<f64>>| {
        let (q, z) = (stepper.configuration().components(), *stepper.speeds());
        let all = q.iter().chain(z.iter()).chain(stepper.impulses().iter());
        all.map(|x| x.to_bits()).collect::<Vec<_>>()
    };
    bits(a) == bits(b) && a.time() == b.time() && a.report() == b.report() && a.modes() == b.modes()
}

#[test]
fn a_lane_has_the_bits_of_a_stepper_of_its_own() {
    let mut number = numbers(41);
    for (scheme, law) in [
        (StepScheme::Midpoint, StepLaw::Coulomb),
        (StepScheme::MoreauJean, StepLaw::Coulomb),
        (StepScheme::Midpoint, StepLaw::ConvexRelaxation),
    ] {
        let (kernel, wide) = (crate_of(0.5, 0.3), crate_of(Eight::splat(0.5), Eight::splat(0.3)));
        let stepper = |(q, z): State| ContactStepper::new(&kernel, 0.0, q, z).unwrap().scheme(scheme).law(law);
        for count in [8, 5] {
            let starts = starts(&mut number);
            let mut singles: Vec<_> = starts.iter().copied().take(count).map(stepper).collect();
            let steppers = starts.iter().copied().take(count).map(stepper).collect();
            let mut lanes = ContactLanes::of(&wide, steppers).unwrap();
            let steps = 250;
            for n in 0..steps {
                let outcomes: Vec<_> = lanes.step(4e-3, &()).to_vec();
                for (lane, single) in singles.iter_mut().enumerate() {
                    assert_eq!(outcomes[lane], single.step(4e-3, &()), "{n} {lane}");
                    assert!(same(single, &lanes.steppers()[lane]), "{n} {lane}");
                }
            }
            // Most of them were made together, and some alone; all where each step is made three times.
            let (alone, all) = (lanes.alone(), (count * steps) as u64);
            match scheme {
                StepScheme::MoreauJean => assert_eq!(alone, all),
                _ => assert!(alone > 0 && alone < all * 3 / 4, "{alone} {count}"),
            }
        }
    }
}

#[test]
fn lanes_have_parameters_and_errors_of_their_own() {
    let frictions = [0.1, 0.3, 0.5, 0.7, 0.9, 0.2, 0.4, 0.6];
    let kernels: Vec<_> = frictions.iter().map(|mu| crate_of(*mu, 0.0)).collect();
    let wide = crate_of(Eight::from_fn(|i| frictions[i]), Eight::splat(0.0));
    let start = Isometry3::translation(0.0, 0.0, 0.2);
    // One spins so fast that the square of its spin is no number.
    let stepper = |(i, kernel)| {
        let slides = SVector::from([1.0, 0.5, 0.0, 0.0, 0.0, if i == 3 { 1e200 } else { 0.0 }]);
        ContactStepper::new(kernel, 0.0, start, slides).unwrap()
    };
    let mut singles: Vec<_> = kernels.iter().enumerate().map(stepper).collect();
    let mut lanes = ContactLanes::of(&wide, kernels.iter().enumerate().map(stepper).collect()).unwrap();
    for _ in 0..300 {
        let outcomes: Vec<_> = lanes.step(2e-3, &()).to_vec();
        for (lane, single) in singles.iter_mut().enumerate() {
            assert_eq!(outcomes[lane], single.step(2e-3, &()), "{lane}");
            assert!(same(single, &lanes.steppers()[lane]), "{lane}");
        }
    }
    let error = lanes.step(2e-3, &())[3].clone().err().unwrap();
    assert_eq!(error.kind, ContactErrorKind::NonFinite);
    // The one of them stays, the others go on: v²/2μg, and of steps what is left of the last one.
    assert_eq!(lanes.steppers()[3].time(), 0.0);
    let way = lanes.steppers()[4].configuration().translation.vector.xy().norm();
    assert!((way - 1.25 / (2.0 * 0.9 * 9.81)).abs() <= 9.81 * 4e-6, "{way}");
    let none: Vec<ContactStepper<'_, CrateKernel<f64>>> = Vec::new();
    let error = ContactLanes::of(&wide, none).err().unwrap();
    assert_eq!(error.kind, ContactErrorKind::Lanes { lanes: 8, given: 0 });
    assert!(lanes.step(-1.0, &()).iter().all(|outcome| outcome.is_err()));
}

#[test]
fn an_ensemble_has_the_bits_of_single_runs_on_one_thread_and_on_all() {
    let mut number = numbers(77);
    let (kernel, wide) = (crate_of(0.5, 0.3), crate_of(Eight::splat(0.5), Eight::splat(0.3)));
    let mut starts: Vec<State> = (0..5).flat_map(|_| starts(&mut number)).take(37).collect();
    // One of them is no number after a step.
    starts[20].1[5] = 1e200;
    let steppers =
        || -> Vec<_> { starts.iter().map(|(q, z)| ContactStepper::new(&kernel, 0.0, *q, *z).unwrap()).collect() };
    let mut singles = steppers();
    let failed: Vec<bool> = singles
        .iter_mut()
        .map(|single| (0..100).try_for_each(|_| single.step(4e-3, &()).map(|_| ())).is_err())
        .collect();
    let hold = |ensemble: &ContactEnsemble<'_, CrateKernel<Eight>, CrateKernel<f64>>| {
        assert_eq!(ensemble.steppers().count(), 37);
        assert!(singles.iter().zip(ensemble.steppers()).all(|(single, stepper)| same(single, stepper)));
        let failures: Vec<usize> = ensemble.failures().map(|(run, _)| *run).collect();
        assert_eq!(failures, (0..37).filter(|i| failed[*i]).collect::<Vec<_>>());
        assert_eq!(failures, [20]);
    };
    let mut ensemble = ContactEnsemble::new(&wide, steppers()).unwrap();
    ensemble.advance(4e-3, 100, |_, _| ());
    hold(&ensemble);
    #[cfg(feature = "rayon")]
    {
        let mut ensemble = ContactEnsemble::new(&wide, steppers()).unwrap();
        ensemble.advance_on_all_threads(4e-3, 60, |_, _| ());
        ensemble.advance_on_all_threads(4e-3, 40, |_, _| ());
        hold(&ensemble);
    }
    let error = ContactEnsemble::new(&wide, Vec::<ContactStepper<'_, CrateKernel<f64>>>::new()).err().unwrap();
    assert_eq!(error.kind, ContactErrorKind::Lanes { lanes: 8, given: 0 });
    // A kernel for each block: too few are told.
    let error = ContactEnsemble::each(core::slice::from_ref(&wide), steppers()).err().unwrap();
    assert_eq!(error.kind, ContactErrorKind::Lanes { lanes: 8, given: 37 });
}
