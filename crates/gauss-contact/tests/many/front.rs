//! Contacts chosen in a simulation: what it holds is carried over, and both runs have one record.

use gauss_contact::{ContactErrorKind, ContactRecord, ContactRun, ContactSteps, EventKind, Impact, WithContacts};
use gauss_runtime::integrate::{Adaptive, IntegrationErrorKind};
use gauss_runtime::prelude::*;

const G: f64 = 9.81;

/// A block over a floor with friction, pushed along it.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, height),
    particle(mass = m, position = [x, 0, height]),
    contact(floor, point = [x, 0, height], friction = 0.5, restitution = e),
    input(push),
    drive(x = push),
)]
struct Block {
    m: f64,
    e: f64,
    #[gauss(gravity)]
    g: f64,
}

type Kernel = BlockKernel;

fn block(e: f64) -> Kernel {
    Block { m: 2.0, e, g: G }.kernel().expect("a block")
}

/// Pushed with as much as friction holds and a half, from 1 s on.
fn push(t: f64, _: &SVector<f64, 2>, _: &SVector<f64, 2>) -> SVector<f64, 1> {
    SVector::from([if t < 1.0 { 0.0 } else { 1.5 * 0.5 * 2.0 * G }])
}

const START: ([f64; 2], [f64; 2]) = ([0.0, 0.5], [0.0, 0.0]);

#[test]
fn a_simulation_refuses_and_names_the_way() {
    let kernel = block(0.0);
    let plain = Simulation::new(&kernel).input(push).adaptive(1e-9, 1e-9);
    let error = plain.run(START.0.into(), START.1.into(), 0.0..1.0).map(|_| ()).unwrap_err();
    assert_eq!(error.kind, IntegrationErrorKind::Contacts);
    let text = error.to_string();
    assert!(text.contains("`contact_events()`") && text.contains("`contact_steps(h)`"), "{text}");
    assert!(text.contains("`WithContacts` of the crate `gauss-contact`"), "{text}");
}

/// The same numbers as by the words of the crate, whatever the order in which things are chosen.
#[test]
fn what_a_simulation_holds_is_carried_over() {
    let kernel = block(0.3);
    let (q, z) = (START.0.into(), START.1.into());
    let ready = || Simulation::new(&kernel).input(push).event(Crossing::Rising, |_, q, _| q[0] - 0.1);
    let expected = ContactRun::new(&kernel)
        .input(push)
        .event(Crossing::Rising, |_, q, _| q[0] - 0.1)
        .adaptive(1e-8, 1e-10)
        .law(Impact::Moreau)
        .run(q, z, 0.0..2.0)
        .expect("runs");
    let early = ready().adaptive(1e-8, 1e-10).contact_events().law(Impact::Moreau);
    let late = ready().contact_events().adaptive(1e-8, 1e-10).law(Impact::Moreau);
    let by_control = ready().control(Adaptive::new(1e-8, 1e-10)).contact_events().law(Impact::Moreau);
    for made in [early.run(q, z, 0.0..2.0), late.run(q, z, 0.0..2.0), by_control.run(q, z, 0.0..2.0)] {
        let made = made.expect("runs");
        let [a, b] = [&expected, &made].map(|run| run.iter().map(|s| (s.t, s.q, s.z)).collect::<Vec<_>>());
        assert_eq!(a, b);
        assert_eq!(expected.events(), made.events());
        let [a, b] = [&expected, &made].map(|run| run.passages().iter().map(|p| p.sample.t).collect::<Vec<_>>());
        assert!(a == b && a.len() == 1);
    }
    let expected = ContactSteps::new(&kernel, 1e-2).input(push).run(q, z, 0.0..2.0).expect("steps");
    let made = Simulation::new(&kernel).input(push).contact_steps(1e-2).run(q, z, 0.0..2.0).expect("steps");
    assert!(expected.iter().zip(&made).all(|(a, b)| a.state.q == b.state.q && a.impulses == b.impulses));
    assert_eq!(expected.len(), 200);
}

#[test]
fn limits_are_carried_over() {
    let kernel = block(0.3);
    let (q, z) = (START.0.into(), START.1.into());
    let sparse = || Simulation::new(&kernel).input(push).every(3);
    let all = Simulation::new(&kernel).input(push).adaptive(1e-9, 1e-9).contact_events().run(q, z, 0.0..2.0).unwrap();
    let some = sparse().adaptive(1e-9, 1e-9).contact_events().run(q, z, 0.0..2.0).unwrap();
    let count = |run: &gauss_contact::ContactTrajectory<'_, Kernel>| run.iter().count();
    assert!(count(&some) < count(&all) && some.events() == all.events());
    assert_eq!(some.last().map(|s| s.q), all.last().map(|s| s.q));
    let error = sparse().contact_steps(1e-2).run(q, z, 0.0..2.0).unwrap_err();
    assert_eq!(error.kind, ContactErrorKind::EveryState { every: 3 });

    let few = || Simulation::new(&kernel).input(push).max_steps(5);
    let error = few().adaptive(1e-9, 1e-9).contact_events().run(q, z, 0.0..2.0).map(|_| ()).unwrap_err();
    assert_eq!(error.kind, ContactErrorKind::TooManySteps { limit: 5 });
    let error = few().contact_steps(1e-2).run(q, z, 0.0..2.0).unwrap_err();
    assert_eq!(error.kind, ContactErrorKind::TooManySteps { limit: 5 });
    let error = few().contact_steps(1e-2).adaptive(1e-6, 1e-6).run(q, z, 0.0..2.0).unwrap_err();
    assert_eq!(error.kind, ContactErrorKind::TooManySteps { limit: 5 });
}

/// A fall of √(2h/g), and back up; half of the height is passed in between, exactly at √(h/g).
#[test]
fn steps_find_events_of_the_user() {
    let kernel = block(0.0);
    let (q, z) = (START.0.into(), START.1.into());
    let fall = (2.0 * 0.5 / G).sqrt();
    let half = (0.5 / G).sqrt();
    let falling = Simulation::new(&kernel)
        .input(push)
        .event(Crossing::Falling, |_, q, _| q[1] - 0.25)
        .event(Crossing::Rising, |_, q, _| q[1] - 0.25)
        .until(Crossing::Rising, |_, _, z| z[1] + 1e-3);
    let h = 1e-2;
    let run = falling.contact_steps(h).run(q, z, 0.0..2.0).expect("lands");
    // Free fall is taken exactly by both schemes; its places between the ends of steps are cubics.
    assert!((run.passages[0].sample.t - half).abs() < 1e-12, "{}", run.passages[0].sample.t);
    assert_eq!(run.passages.iter().map(|p| p.number).collect::<Vec<_>>(), [0, 2]);
    assert_eq!(run.stopped_by, Some(2));
    // The impact is known to a step; speeds jump in the middle of it.
    let end = run.last().expect("steps").state;
    assert!((end.t - fall).abs() < h && end.z[1].abs() < 1e-12, "{}", end.t);
    let until = |limit: f64| {
        let steps = Simulation::new(&kernel).input(push).until(Crossing::Falling, move |_, q, _| q[1] - limit);
        let run = steps.contact_steps(h).adaptive(1e-9, 1e-9).run(q, z, 0.0..2.0).expect("falls");
        (run.stopped_by, run.last().expect("steps").state.q[1])
    };
    let (stopped, height) = until(0.3);
    // At zero or beyond it, by a rounding of the time.
    assert!(stopped == Some(0) && height <= 0.3 && height > 0.3 - 4.0 * f64::EPSILON, "{height}");
    let undefined =
        Simulation::new(&kernel).input(push).event(Crossing::Any, |t, _, _| if t > 0.1 { f64::NAN } else { t });
    assert_eq!(undefined.contact_steps(h).run(q, z, 0.0..1.0).unwrap_err().kind, ContactErrorKind::NonFinite);
}

/// It lands, rests, and slides from 1 s on, when friction no longer holds it: by both records.
fn check<'k>(run: &impl ContactRecord<'k, Kernel>, (late, near): (f64, f64)) {
    let (first, last) = run.span().expect("a run");
    assert_eq!((first, last), (0.0, 2.0));
    let weight = 2.0 * G;
    // In the air.
    assert_eq!((run.forces(0.1).unwrap()[0], run.modes(0.1).unwrap()[0].is_closed()), (0.0, false));
    // At rest.
    let rests = run.forces(0.9).unwrap();
    assert!((rests[0] - weight).abs() < near && rests[1].abs() < near && run.modes(0.9).unwrap()[0].is_closed());
    assert_eq!(rests.vectors().len(), 1);
    // Sliding: friction takes a third of the push. The start is known to a step.
    let slides = run.forces(1.9).unwrap();
    assert!((slides[1] + 0.5 * weight).abs() < near, "{}", slides[1]);
    let way = |t: f64| 0.5 * 0.25 * G * (t - 1.0).powi(2);
    for t in [1.5, 1.777] {
        let state = run.state_at(t).unwrap();
        assert!((state.q[0] - way(t)).abs() < late && state.q[1].abs() < near, "{t}: {}", state.q);
    }
    // Pictures have the speed before the impact and that after it, and nothing in between.
    let pictures = run.sampled(100).unwrap();
    assert!(pictures.windows(2).all(|pair| pair[0].t < pair[1].t));
    let strike = pictures.iter().position(|s| s.z[1].abs() < 1e-9 && s.t > 0.01).expect("an impact");
    let fast = -(2.0 * G * 0.5_f64).sqrt();
    assert!((pictures[strike - 1].z[1] - fast).abs() < G * late.max(1e-9), "{}", pictures[strike - 1].z[1]);
    assert_eq!(pictures[strike - 1].t.next_up(), pictures[strike].t);
    assert!(run.state_at(2.5).is_err() && run.forces(-1.0).is_err());
}

#[test]
fn both_records_are_read_alike() {
    let kernel = block(0.0);
    let (q, z) = (START.0.into(), START.1.into());
    let simulation = || Simulation::new(&kernel).input(push);
    let exact = simulation().adaptive(1e-10, 1e-10).contact_events().run(q, z, 0.0..2.0).expect("runs");
    assert!(exact.events().iter().any(|event| matches!(event.kind, EventKind::Slides(_))));
    check(&exact, (1e-8, 1e-9));
    let h = 1e-3;
    // A force of 1.5 μ m g that is held begins at the end of the step in which 1 s is, or with it.
    check(&simulation().contact_steps(h).run(q, z, 0.0..2.0).expect("steps"), (3.0 * h, 1e-6));
    check(&simulation().contact_steps(h).adaptive(1e-6, 1e-6).run(q, z, 0.0..2.0).expect("steps"), (3.0 * h, 1e-6));
    let both = simulation().adaptive(1e-10, 1e-10).contact_events().changing_over(h).run(q, z, 0.0..2.0);
    check(&both.expect("runs"), (1e-8, 1e-9));
}

/// Steps that are handed on and forgotten are those of a run that keeps them.
#[test]
fn a_run_that_is_visited_keeps_its_last_step_alone() {
    let kernel = block(0.4);
    let (q, z) = (START.0.into(), START.1.into());
    let steps = || {
        let steps = ContactSteps::new(&kernel, 1e-2).input(push).event(Crossing::Falling, |_, q, _| q[1] - 0.2);
        // A blow from the side, after which the run goes on.
        steps.event(Crossing::Rising, |t, _, _| t - 1.234).then_through(|state| state.z[0] += 1.0)
    };
    let kept = steps().run(q, z, 0.0..3.0).expect("runs");
    let mut seen = Vec::new();
    let mut most = 0;
    let end = steps().visit((q, z), 0.0..3.0, |step| {
        most = most.max(step.report.closed);
        seen.push((step.state.t, step.state.q, step.state.z, step.impulses));
    });
    let end = end.expect("runs");
    let all: Vec<_> = kept.iter().map(|step| (step.state.t, step.state.q, step.state.z, step.impulses)).collect();
    assert_eq!(seen, all);
    assert_eq!((end.samples.len(), end.start.t, most), (1, all[all.len() - 2].0, 1));
    assert_eq!((end.state_jumps.len(), end.passages.len()), (1, kept.passages.len()));
    let t = 0.5 * (end.start.t + 3.0);
    assert_eq!(end.at(t).expect("the last step").q, kept.at(t).expect("a step").q);
    assert_eq!(end.at(1.0).unwrap_err().kind, ContactErrorKind::OutsideRun);
    // What is refused has handed on what was made.
    let (mut count, limited) = (0, steps().max_steps(7));
    let error = limited.visit((q, z), 0.0..3.0, |_| count += 1).unwrap_err();
    assert_eq!((error.kind, count), (ContactErrorKind::TooManySteps { limit: 7 }, 7));
}

/// A slider with a damper that explicit methods cannot pass over, above a floor.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, height),
    particle(mass = 1, position = [x, 0, height]),
    spring(strut, along = x, stiffness = 1, damping = 1e4),
    contact(floor, gap = height),
)]
struct Slow {}

#[test]
fn stiff_runs_from_event_to_event_are_told_of_steps() {
    let kernel = Slow {}.kernel().expect("a slider");
    let run = ContactRun::new(&kernel).adaptive(1e-6, 1e-6).max_steps(1_000);
    let error = run.run([1.0, 1.0].into(), [0.0, 0.0].into(), 0.0..1e3).map(|_| ()).unwrap_err();
    let ContactErrorKind::Integration(cause) = &error.kind else { panic!("{error}") };
    assert!(matches!(cause.kind, IntegrationErrorKind::Stiff { .. }), "{error}");
    assert!(error.to_string().contains("contact steps pass over it"), "{error}");
}
