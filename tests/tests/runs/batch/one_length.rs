//! Ensembles by steps of one length, of methods that remember the steps before, too: the bits of single runs, their
//! events, their reasons to stop.

use gauss_exact::{FreeFlow, Scheme, Splitting};
use gauss_runtime::integrate::Adams;

use super::ensembles::{agree, bounce_as_alone, fail_as_alone};
use super::*;

/// More states than lanes; the last step shorter; methods whose beginnings give derivatives, and do not; forwards and
/// backwards.
#[test]
fn every_run_takes_the_steps_that_it_would_take_alone() {
    type Four = Lanes<f64, 4>;
    let start = |i| (pose(i), twist(i));
    let kernels = (&thrown(Four::splat(2.0)), &thrown(2.0));
    let controls = (Adams::<_, 8>::new(Four::splat(0.031)), Adams::<_, 8>::new(0.031));
    agree(kernels, controls, start, (11, 0.3..1.3));
    let controls = (Adams::<_, 4>::new(Four::splat(-0.02)), Adams::<_, 4>::new(-0.02));
    agree(kernels, controls, start, (5, 0.2..-0.4));
    let method = RungeKutta(DormandPrince5);
    agree(kernels, (Fixed::by(method, Four::splat(0.017)), Fixed::by(method, 0.017)), start, (11, 0.3..1.3));
}

/// A lane that begins anew after a jump, or gets another run, begins beside others that are on their way.
#[test]
fn events_are_those_of_each_run() {
    type Eight = wide::f64x8;
    bounce_as_alone((Adams::<_, 8>::new(Eight::splat(0.01)), Adams::<_, 8>::new(0.01)));
    bounce_as_alone((Adams::<_, 4>::new(Eight::splat(0.01)), Adams::<_, 4>::new(0.01)));
    bounce_as_alone((Fixed::new(Eight::splat(0.02)), Fixed::new(0.02)));
}

#[test]
fn runs_that_fail_do_so_as_they_would_alone() {
    type Four = Lanes<f64, 4>;
    let reasons = |kinds: &[&str]| {
        for kind in ["ends", "undefined", "singular"] {
            assert!(kinds.contains(&kind), "{kind} is not among {kinds:?}");
        }
    };
    // Exactly as many steps as are allowed.
    let kinds = fail_as_alone((Adams::<_, 6>::new(Four::splat(0.01)), Adams::<_, 6>::new(0.01)), 120);
    reasons(&kinds);
    reasons(&fail_as_alone((Fixed::new(Four::splat(0.01)), Fixed::new(0.01)), 120));
    let kinds = fail_as_alone((Adams::<_, 6>::new(Four::splat(0.01)), Adams::<_, 6>::new(0.01)), 119);
    assert!(kinds.iter().all(|&kind| kind == "too many" || kind == "undefined"), "{kinds:?}");
    let kinds = fail_as_alone((Fixed::new(Four::zero()), Fixed::new(0.0)), 10);
    assert!(kinds.iter().all(|&kind| kind == "other"), "{kinds:?}");
}

/// Free bodies by their closed form, each lane by itself: one step from beginning to end.
#[test]
fn closed_forms_are_methods_as_well() {
    type Eight = wide::f64x8;
    fn free<T: Real>() -> ThrownKernel<T> {
        let body = Thrown { mass: T::one(), center: vector([0.0; 3]), inertia: vector([1.0, 2.0, 3.0]), g: T::zero() };
        body.kernel().expect("a body")
    }
    let (kernel, alone) = (free::<Eight>(), free::<f64>());
    let in_lanes = Splitting::with(&kernel, Scheme::STRANG, FreeFlow::in_lanes::<_, 8>).expect("a free body");
    let single = Splitting::exact(&alone, Scheme::STRANG).expect("a free body");
    let mut states = States::<ThrownKernel<Eight>>::from_fn(11, |i| (pose(i), twist(i)));
    let ends = Batch::new(&kernel).control(Fixed::by(in_lanes, Eight::splat(40.0))).run(0.0..40.0, &mut states);
    for (i, (q, z)) in states.iter().enumerate() {
        let run = Simulation::new(&alone).control(Fixed::by(single, 40.0));
        let end = run.run_to_end(pose(i), twist(i), 0.0..40.0).expect("runs");
        assert!(q == end.q && z == end.z && ends[i].as_ref().is_ok_and(|end| end.summary.steps == 1), "state {i}");
    }
}
