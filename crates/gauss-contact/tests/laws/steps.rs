//! Steps of fixed length: closed forms, laws after each step, exact runs.

use gauss_contact::{ContactErrorKind, ContactRun, ContactStepper, ContactSteps, Mode, StepScheme};
use gauss_runtime::nalgebra::{SMatrix, SVector};
use gauss_runtime::system::GaussSystem;

use crate::common::{Scene, V, numbers};
use crate::friction::{Ground, rod, square};
use crate::spatial::{room, sphere};

/// A mass of 1 above a floor, with a slip.
fn block(mu: f64, push: f64, e: f64) -> Scene<Ground, 2, 1, 2> {
    let rows = SMatrix::<f64, 2, 2>::new(0.0, 1.0, 1.0, 0.0);
    let scene = Scene::linear(V::from([1.0, 1.0]), V::from([push, -9.81]), V::zeros(), rows);
    scene.friction([mu]).restitution([e])
}

#[test]
fn what_is_held_does_not_creep() {
    // Less than friction holds: not one bit moves.
    let kernel = block(0.5, 4.9, 0.0);
    let run = ContactSteps::new(&kernel, 0.01).run(V::from([0.25, 0.0]), V::zeros(), 0.0..100.0).unwrap();
    for step in &run {
        assert_eq!((step.state.q, step.state.z), (V::from([0.25, 0.0]), V::zeros()));
        assert_eq!(step.modes, [Mode::Sticks]);
    }
    // The forces are the mean ones of a step.
    let impulses = run[0].impulses / 0.01;
    assert!((impulses - V::from([9.81, -4.9])).amax() <= 8.0 * 9.81 * f64::EPSILON, "{impulses}");
}

#[test]
fn what_slides_stops_at_its_time() {
    // v² / 2μg; steps are first order where the slip ends.
    let (mu, v, g) = (0.3, 2.0, 9.81);
    let kernel = block(mu, 0.0, 0.0);
    let way = v * v / (2.0 * mu * g);
    for h in [1e-2, 1e-3] {
        let run = ContactSteps::new(&kernel, h).run(V::zeros(), V::from([v, 0.0]), 0.0..1.0).unwrap();
        let end = run.last().unwrap();
        assert_eq!((end.state.z, end.state.q[1]), (V::zeros(), 0.0));
        // Within the step in which it stops it goes on at less than μ g h for half of it.
        assert!((end.state.q[0] - way).abs() <= mu * g * h * h, "{h} {}", end.state.q[0] - way);
        assert_eq!(run[0].modes, [Mode::Slides([1.0, 0.0, 0.0])]);
    }
}

#[test]
fn a_ball_comes_to_rest_without_events() {
    let kernel = block(0.0, 0.0, 0.5);
    let run = ContactSteps::new(&kernel, 1e-3).run(V::from([0.0, 1.0]), V::zeros(), 0.0..3.0).unwrap();
    // Impacts pile up at √(2h/g)(1 + e)/(1 − e); each is known to a step, and steps go on to rest.
    let end = (2.0_f64 / 9.81).sqrt() * 1.5 / 0.5;
    let rest = run.iter().find(|step| step.state.z == V::<2>::zeros()).unwrap().state.t;
    assert!((rest - end).abs() < 0.02, "{rest} {end}");
    // Rounding of heights of about 1.
    assert!(run.iter().all(|step| step.state.q[1] >= -f64::EPSILON));
    assert_eq!(run.last().unwrap().state.q[1], 0.0);
}

#[test]
fn schemes_are_of_the_order_that_they_say() {
    // A rod whose lower end slides on the ground while it falls: the contact stays closed.
    // Drag makes forces depend on speeds.
    let kernel = rod(0.0).force(|_, _, z| V::from([0.0, -9.81, 0.0]) - 0.8 * z);
    let (q, z) = (V::from([0.0, 1.2_f64.sin(), 1.2]), V::from([0.3, 0.0, 0.0]));
    let exact = ContactRun::new(&kernel).adaptive(1e-12, 1e-12).run(q, z, 0.0..0.3).unwrap().last().unwrap();
    let error = |scheme, h| {
        let run = ContactSteps::new(&kernel, h).scheme(scheme).run(q, z, 0.0..0.3).unwrap();
        let end = run.last().unwrap();
        assert!(run.iter().all(|step| step.modes[0].is_closed()), "{h}");
        let rates = gauss_runtime::contact::ContactSystem::contact_rates(&kernel, 0.3, &end.state.q, &end.state.z);
        // Rounding of the fastest rate, which is left of what rests.
        assert!(rates[0].abs() <= 64.0 * f64::EPSILON * rates.amax().max(1.0), "{h} {rates}");
        (end.state.q - exact.q).amax().max((end.state.z - exact.z).amax())
    };
    for scheme in [StepScheme::Midpoint, StepScheme::MoreauJean] {
        let (coarse, fine) = (error(scheme, 3e-3), error(scheme, 7.5e-4));
        let found = (coarse / fine).log2() / 2.0;
        assert!((found - 2.0).abs() < 0.25, "{scheme:?} {found} {coarse:e} {fine:e}");
    }
}

#[test]
fn a_box_falls_on_a_corner_and_lies_down() {
    for mu in [0.0, 0.4, 1.5] {
        let kernel = square(mu, 0.1);
        let run = ContactSteps::new(&kernel, 1e-3).run(V::from([0.0, 0.2, 0.3]), V::from([0.7, 0.0, 1.0]), 0.0..3.0);
        let run = run.unwrap();
        let energy = |step: &gauss_contact::StepSample<_>| kernel.energy(step.state.t, &step.state.q, &step.state.z);
        let lowest =
            run.iter().map(|step| gauss_runtime::contact::ContactSystem::gaps(&kernel, 0.0, &step.state.q).min());
        // The projection leaves rounding of places of about 1.
        assert!(lowest.fold(0.0, f64::min) > -1e-14, "{mu}");
        assert!(energy(run.last().unwrap()) <= energy(&run[0]), "{mu}");
        assert!(run.iter().all(|step| step.report.residual.signorini <= 1e-10), "{mu}");
    }
}

#[test]
fn mistakes_are_told() {
    let kernel = block(0.5, 0.0, 0.0);
    let error = ContactSteps::new(&kernel, 0.01).run(V::from([0.0, -1.0]), V::zeros(), 0.0..1.0).err().unwrap();
    assert_eq!((error.contact, error.kind), (Some("ground"), ContactErrorKind::NegativeGap { gap: -1.0 }));
    for h in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = ContactSteps::new(&kernel, h).run(V::zeros(), V::zeros(), 0.0..1.0).err();
        assert_eq!(error.map(|error| error.kind), Some(ContactErrorKind::InvalidInterval), "{h}");
    }
    let kernel = block(-0.5, 0.0, 0.0);
    let error = ContactSteps::new(&kernel, 0.01).run(V::zeros(), V::zeros(), 0.0..1.0).err().unwrap();
    assert_eq!(error.kind, ContactErrorKind::InvalidFriction { friction: -0.5 });
}

#[test]
fn steps_need_no_memory_but_what_is_given() {
    let kernel = block(0.5, 4.9, 0.0);
    let start = (0.0, V::zeros(), V::from([1.0, 0.0]));
    const NUMBERS: usize = ContactStepper::<Scene<Ground, 2, 1, 2>, &mut [f64]>::MEMORY;
    let mut memory = [0.0; NUMBERS];
    let mut stepper = ContactStepper::with_memory(&kernel, start, &mut memory[..]).unwrap();
    let mut other = ContactStepper::new(&kernel, start.0, start.1, start.2).unwrap();
    for _ in 0..100 {
        assert_eq!(stepper.step(0.01, &()), other.step(0.01, &()));
    }
    assert_eq!(stepper.configuration(), other.configuration());
    let _: &SVector<f64, 2> = stepper.speeds();
}

#[test]
fn a_sphere_rolls_with_five_sevenths_whatever_the_step_is() {
    let (r, v) = (0.1, 2.0);
    let kernel = sphere(2.0, r, 0.3);
    let start = (V::from([0.0, 0.0, r, 0.0, 0.0, 0.0]), V::from([0.6 * v, 0.8 * v, 0.0, 0.0, 0.0, 0.0]));
    for h in [1e-1, 1e-2, 1e-3] {
        let run = ContactSteps::new(&kernel, h).run(start.0, start.1, 0.0..1.0).unwrap();
        let end = run.last().unwrap();
        // Friction does not change the angular momentum about a line of the plane: rounding of a thousand steps.
        assert!((end.state.z[0] - 5.0 / 7.0 * 0.6 * v).abs() < 1e-12, "{h} {}", end.state.z);
        assert!((end.state.z[1] - 5.0 / 7.0 * 0.8 * v).abs() < 1e-12, "{h} {}", end.state.z);
        assert_eq!(end.modes, [Mode::Sticks]);
        // In between friction is Coulomb's: μ m g against the slip.
        let friction = run[0].impulses / h;
        let slips = matches!(run[0].modes[0], Mode::Slides(_));
        assert!(!slips || (friction.xy().norm().hypot(friction[2]) - 2.0 * 9.81 * 1.09_f64.sqrt()).abs() < 1e-9);
    }
}

#[test]
fn points_in_a_room_come_to_rest() {
    let mut number = numbers(17);
    for n in 0..30 {
        let e = [0.0, 0.4, 0.8][n % 3];
        let weight = V::from([-4.0 - 3.0 * number(), -4.0 - 3.0 * number(), -15.0]);
        let kernel = room(1.5, weight).friction([0.3 + 0.3 * number(), 0.2, 0.1]).restitution([e; 3]);
        let start = V::from([1.0 + number(), 1.0 + number(), 1.0 + number()]);
        let speeds = V::from([3.0 * number(), 3.0 * number(), 3.0 * number()]);
        let run = ContactSteps::new(&kernel, 2e-3).run(start, speeds, 0.0..20.0).unwrap();
        let end = run.last().unwrap();
        // Where friction holds it, to the last bit; no deeper than two roundings of the largest place, 4.
        assert_eq!(end.state.z, V::<3>::zeros(), "{n}");
        assert!(run.iter().all(|step| step.state.q.min() >= -8.0 * f64::EPSILON), "{n}");
        for i in 0..3 {
            let [normal, x, y] = [0, 1, 2].map(|k| end.impulses[3 * i + k]);
            // A few times the tolerance of steps, 1e-8.
            assert!(normal >= 0.0 && x.hypot(y) <= kernel.friction[i] * normal * (1.0 + 1e-7), "{n}");
        }
    }
}

#[test]
fn the_work_of_impulses_is_what_the_energy_changes_by() {
    let mut number = numbers(31);
    let mut given = 0;
    for n in 0..200 {
        let (mu, e) = ([0.0, 0.4, 0.9][n % 3], [0.0, 0.5, 0.9][n / 3 % 3]);
        let kernel = Scene { restitution: V::from([e]), ..rod(mu) };
        let angle = 0.8 + 0.6 * number();
        let (q, z) = (V::from([0.0, angle.sin(), angle]), V::from([number(), -number().abs(), 3.0 * number()]));
        // So short that weight does nothing: 1e-9 · 9.81 m/s.
        let run = ContactSteps::new(&kernel, 1e-9).run(q, z, 0.0..1e-9);
        // Beyond Painlevé's bound there may be no impulse.
        let Ok(run) = run else { continue };
        let energy = |z: &V<3>| kernel.kinetic_energy(0.0, &q, z);
        let change = energy(&run[0].state.z) - energy(&z);
        assert!((run[0].report.work - change).abs() < 1e-7, "{n} {} {change}", run[0].report.work);
        // Without friction none is given.
        assert!(mu > 0.0 || run[0].report.work <= 1e-12, "{n}");
        given += usize::from(run[0].report.work > 1e-6);
    }
    assert!(given > 0, "{given}");
}
