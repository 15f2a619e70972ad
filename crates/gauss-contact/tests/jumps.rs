//! Jumps of the state by events of the user, in runs with contacts: from event to event, in steps, in steps that keep a
//! tolerance.

use gauss_contact::{ContactErrorKind, ContactRecord, EventKind, Mode, WithContacts};
use gauss_runtime::dual::Dual;
use gauss_runtime::integrate::{IntegrationErrorKind, JumpMistake, RunRecord};
use gauss_runtime::prelude::*;

/// A block of 2 kg over a floor.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y), particle(mass = 2, position = [x, 0, y]),
    contact(floor, gap = y, slip = rate(x), friction = mu, restitution = e), gravity = 10,
)]
struct Block<T> {
    mu: T,
    e: T,
}

type State = SVector<f64, 2>;

/// A function whose zeros are events.
type EventFunction = fn(f64, &State, &State) -> f64;

fn block(mu: f64, e: f64) -> BlockKernel<f64> {
    Block { mu, e }.kernel().expect("a block")
}

fn rest() -> [State; 2] {
    [State::zeros(); 2]
}

/// A blow along the floor at a time.
fn blow(speed: f64) -> impl FnMut(&mut Sample<BlockKernel<f64>>) + Clone {
    move |state| state.z[0] += speed
}

/// A block that stuck slides for v/(μ g) and sticks again: places, forces, the history, the account of the energy.
#[test]
fn a_blow_sets_what_sticks_sliding() {
    let kernel = block(0.5, 0.0);
    let [q, z] = rest();
    let run = Simulation::new(&kernel).event(Crossing::Rising, |t, _, _| t - 1.0).then(blow(2.0));
    let run = run.adaptive(1e-10, 1e-10).contact_events().run(q, z, 0.0..3.0).unwrap();
    let place = |t: f64| {
        let since = (t - 1.0).clamp(0.0, 0.4);
        2.0 * since - 0.5 * 5.0 * since * since
    };
    for t in [0.5, 1.0, 1.2, 1.39, 1.5, 3.0] {
        let state = run.at(t).unwrap();
        assert!((state.q[0] - place(t)).abs() < 1e-9 && state.q[1].abs() < 1e-12, "{t}: {state:?}");
        let friction = if (1.0..1.4).contains(&t) { -10.0 } else { 0.0 };
        assert!((run.forces(t).unwrap()[1] - friction).abs() < 1e-8, "{t}");
    }
    let history: Vec<_> = run.events().iter().map(|event| (event.time, event.kind)).collect();
    let [(slides, EventKind::Slides(_)), (sticks, EventKind::Sticks)] = history[..] else { panic!("{history:?}") };
    // Zeros are found to some roundings of the time.
    assert!((slides - 1.0).abs() < 1e-14 && (sticks - 1.4).abs() < 1e-9);
    let [jump] = run.state_jumps() else { panic!("one jump") };
    assert_eq!((jump.number, jump.before.z[0], jump.after.z[0]), (0, 0.0, 2.0));
    assert_eq!(run.passages()[0].sample.z, jump.before.z);
    assert_eq!(RunRecord::jumps(&run), [jump.before.t, sticks]);
    // The states have both, and so has what is drawn.
    let states = run.states();
    assert!(states.windows(2).any(|pair| pair[0].t == pair[1].t && pair[1].z[0] - pair[0].z[0] == 2.0));
    let drawn = run.sampled(7).unwrap();
    assert!(drawn.windows(2).any(|pair| pair[1].t.next_down() == pair[0].t && pair[1].z[0] - pair[0].z[0] > 1.9));
    let balance = run.energy_balance().unwrap();
    // ½ m v² = 4 J, which friction takes.
    assert!((balance.jumps - 4.0).abs() < 1e-12 && (balance.contacts + 4.0).abs() < 1e-8, "{balance}");
    assert!(balance.residual().abs() < 1e-8 && balance.to_string().contains("jumps +4.0"), "{balance}");
}

/// The same by a run up to the jump and another from there, from event to event and in steps, in which the event is the
/// end of one.
#[test]
fn a_run_cut_by_hand_is_the_same() {
    let kernel = block(0.3, 0.4);
    let (q, z) = (State::from([0.0, 0.7]), State::from([1.3, 0.0]));
    let jump = |state: &mut Sample<BlockKernel<f64>>| state.z = State::from([2.0, -1.5]);
    let passes = |_: f64, q: &State, _: &State| q[0] - 0.4;
    let ends = |run: &dyn ContactRecord<'_, BlockKernel<f64>>| {
        let states = run.states();
        states[states.len() - 1]
    };

    let one = Simulation::new(&kernel).event(Crossing::Rising, passes).then_through(jump);
    let one = one.adaptive(1e-10, 1e-10).contact_events().run(q, z, 0.0..2.0).unwrap();
    let whole = || Simulation::new(&kernel).adaptive(1e-10, 1e-10).contact_events();
    let first = whole().until(Crossing::Rising, passes).run(q, z, 0.0..2.0).unwrap();
    let mut at = first.last().unwrap();
    jump(&mut at);
    let second = whole().run(at.q, at.z, at.t..2.0).unwrap();
    let (a, b) = (ends(&one), ends(&second));
    // Steps are other ones, to the tolerance.
    assert!((a.q - b.q).norm() < 1e-8 && (a.z - b.z).norm() < 1e-8, "{a:?} {b:?}");
    assert_eq!(one.state_jumps().len(), 1);
    assert!((one.state_jumps()[0].before.t - at.t).abs() < 1e-9);
    let of = |run: &gauss_contact::ContactTrajectory<'_, _>| {
        run.events().iter().filter(|event| matches!(event.kind, EventKind::Impact(_))).count()
    };
    assert_eq!(of(&one), of(&first) + of(&second));

    let h = 1e-3;
    let one = Simulation::new(&kernel).event(Crossing::Rising, passes).then_through(jump);
    let one = one.contact_steps(h).run(q, z, 0.0..2.0).unwrap();
    let jumped = one.state_jumps[0].after;
    // It falls with 1.3 m/s along x: the zero is that of a straight line, to a rounding of the place.
    assert!((jumped.t - 0.4 / 1.3).abs() < 1e-13, "{}", jumped.t);
    let second = Simulation::new(&kernel).contact_steps(h).run(jumped.q, jumped.z, jumped.t..2.0).unwrap();
    let (a, c) = (ends(&one), ends(&second));
    // Steps begin at other times: impacts are known to one of them, with speeds of some metres per second.
    assert!((a.q - c.q).norm() < 4.0 * h && (a.q - b.q).norm() < 8.0 * h, "{a:?} {b:?} {c:?}");
}

/// An own wall before a block that slides: the way is v²/(2 μ g), folded at walls.
#[test]
fn walls_of_ones_own_fold_the_way_of_a_block() {
    let kernel = block(0.1, 0.0);
    let (q, z) = (State::zeros(), State::from([3.0, 0.0]));
    let turn = |state: &mut Sample<BlockKernel<f64>>| state.z[0] = -state.z[0];
    let ready = || {
        let right = Simulation::new(&kernel).event(Crossing::Rising, |_, q, _| q[0] - 1.0).then(turn);
        right.event(Crossing::Falling, |_, q, _| q[0] + 0.5).then(turn)
    };
    // 4.5 m between −0.5 and 1: to 1, to −0.5, to 1, and half a metre back.
    let (place, times) = (0.5, [1.0, 2.5, 4.0].map(|way: f64| 3.0 - (9.0 - 2.0 * way).sqrt()));
    let check = |run: &dyn ContactRecord<'_, BlockKernel<f64>>, near: f64| {
        let states = run.states();
        let last = states[states.len() - 1];
        assert!((last.q[0] - place).abs() < near && last.z[0].abs() < 1e-12, "{last:?}");
        assert!(matches!(run.modes(4.0).unwrap(), [Mode::Sticks]));
        let found: Vec<_> = run.state_jumps().iter().map(|jump| (jump.number, jump.before.t)).collect();
        assert_eq!(found.iter().map(|(number, _)| *number).collect::<Vec<_>>(), [0, 1, 0]);
        assert!(found.iter().zip(times).all(|((_, t), wanted)| (t - wanted).abs() < near), "{found:?} {times:?}");
        for jump in run.state_jumps() {
            let at = run.state_at(jump.before.t).unwrap();
            assert_eq!((at.q, at.z), (jump.after.q, jump.after.z));
            assert!(run.jumps().contains(&jump.before.t));
        }
        assert!(states.iter().all(|state| state.q[0] < 1.0 + 1e-13 && state.q[0] > -0.5 - 1e-13));
    };
    let run = ready().adaptive(1e-11, 1e-11).contact_events().run(q, z, 0.0..4.0).unwrap();
    check(&run, 1e-9);
    assert!(run.energy_balance().unwrap().residual().abs() < 1e-8);
    for h in [1e-2, 0.7e-2, 1e-3] {
        // Steps have constant accelerations exactly; when the slip ends is known to a step, where it creeps.
        check(&ready().contact_steps(h).run(q, z, 0.0..4.0).unwrap(), 4.0 * h * h);
    }
    check(&ready().contact_steps(0.1).adaptive(1e-7, 1e-7).run(q, z, 0.0..4.0).unwrap(), 1e-5);
}

/// A blow on what the floor bears is an impact; a lift is a fall.
#[test]
fn closed_gaps_are_struck_or_opened() {
    let kernel = block(0.0, 0.5);
    let [q, z] = rest();
    let ready = |jump: fn(&mut Sample<BlockKernel<f64>>)| {
        Simulation::new(&kernel).event(Crossing::Rising, |t, _, _| t - 0.5).then(jump)
    };
    let struck = || ready(|state| state.z[1] = -3.0);
    let run = struck().adaptive(1e-10, 1e-10).contact_events().run(q, z, 0.0..0.7).unwrap();
    let EventKind::Impact(hit) = run.events()[0].kind else { panic!("{:?}", run.events()) };
    assert!((hit.before[0] + 3.0).abs() < 1e-14 && (hit.after[0] - 1.5).abs() < 1e-14);
    // It flies with 1.5 m/s for 0.3 s.
    let flies = |t: f64| 1.5 * (t - 0.5) - 5.0 * (t - 0.5).powi(2);
    assert!((run.last().unwrap().q[1] - flies(0.7)).abs() < 1e-9);
    assert_eq!(run.state_jumps()[0].after.z[1], -3.0);
    let balance = run.energy_balance().unwrap();
    // ½ m v²: 9 J, of which a quarter stays.
    assert!((balance.jumps - 9.0).abs() < 1e-9 && (balance.impacts - 6.75).abs() < 1e-9, "{balance}");
    assert!(balance.residual().abs() < 1e-8, "{balance}");
    let h = 1e-3;
    let run = struck().contact_steps(h).run(q, z, 0.0..0.7).unwrap();
    // The impact is in the step after the jump: 4.5 m/s are missing in half of it.
    assert!((run.samples.last().unwrap().state.q[1] - flies(0.7)).abs() < 5.0 * h);

    let lifted = || ready(|state| state.q[1] = 0.2);
    let run = lifted().adaptive(1e-10, 1e-10).contact_events().run(q, z, 0.0..0.7).unwrap();
    let [left, struck] = &run.events()[..2] else { panic!("{:?}", run.events()) };
    assert!(left.kind == EventKind::Leaves && (struck.time - 0.7).abs() < 1e-9, "{:?}", run.events());
    assert!((run.at(0.6).unwrap().q[1] - 0.15).abs() < 1e-10);
    assert!((run.energy_balance().unwrap().jumps - 4.0).abs() < 1e-12);
    let run = lifted().contact_steps(h).run(q, z, 0.0..0.69).unwrap();
    // A fall is exact.
    assert!((run.at(0.6).unwrap().q[1] - 0.15).abs() < 1e-11, "{:?}", run.at(0.6));
}

/// An impact that turns the speed is the event of a jump, which takes half of it: as restitution would.
#[test]
fn impacts_lead_over_events_that_jump() {
    let (elastic, half) = (block(0.0, 1.0), block(0.0, 0.5));
    let (q, z) = (State::from([0.0, 0.8]), State::zeros());
    let turned = |jump: fn(&mut Sample<BlockKernel<f64>>)| {
        Simulation::new(&elastic).event(Crossing::Rising, |_, _, z: &State| z[1]).then_through(jump)
    };
    let halves = || turned(|state| state.z[1] *= 0.5);
    let run = halves().adaptive(1e-11, 1e-11).contact_events().run(q, z, 0.0..0.95).unwrap();
    let other = Simulation::new(&half).adaptive(1e-11, 1e-11).contact_events().run(q, z, 0.0..1.0).unwrap();
    for t in [0.3, 0.5, 0.7, 0.9, 0.94] {
        let (a, b) = (run.at(t).unwrap(), other.at(t).unwrap());
        assert!((a.q - b.q).norm() < 1e-8 && (a.z - b.z).norm() < 1e-8, "{t}: {a:?} {b:?}");
    }
    // Falls of 0.4 s, then flights of 0.4 s and 0.2 s.
    let times: Vec<f64> = run.state_jumps().iter().map(|jump| jump.before.t).collect();
    assert!(times.len() == 2 && (times[0] - 0.4).abs() < 1e-9 && (times[1] - 0.8).abs() < 1e-9, "{times:?}");
    let balance = run.energy_balance().unwrap();
    assert!((balance.jumps + 16.0 * (1.0 - 0.0625)).abs() < 1e-7 && balance.residual().abs() < 1e-7, "{balance}");
    let (run, h) = (halves().contact_steps(1e-3).run(q, z, 0.0..0.95).unwrap(), 1e-3);
    assert_eq!(run.state_jumps.len(), 2);
    let (a, b) = (run.at(0.7).unwrap(), other.at(0.7).unwrap());
    assert!((a.q - b.q).norm() < 8.0 * h, "{a:?} {b:?}");
}

/// Jumps lead over zeros of other events, which may end the run; an event that ends it jumps as well.
#[test]
fn jumps_lead_over_events_and_end_runs() {
    let kernel = block(0.2, 0.0);
    let [q, z] = rest();
    let over = || {
        let blown = Simulation::new(&kernel).event(Crossing::Rising, |t, _, _| t - 0.25).then(blow(2.0));
        blown.until(Crossing::Rising, |_, _, z: &State| z[0] - 1.0)
    };
    let ends = || {
        let at = Simulation::new(&kernel).until(Crossing::Rising, |t, _, _| t - 0.25).then(blow(2.0));
        at.event(Crossing::Rising, |_, _, z: &State| z[0] - 1.0)
    };
    let check = |run: &dyn ContactRecord<'_, BlockKernel<f64>>, stopped: usize| {
        let states = run.states();
        let last = states[states.len() - 1];
        assert!((last.t - 0.25).abs() < 1e-15 && last.z[0] == 2.0, "{last:?}");
        assert_eq!((run.stopped_by(), run.state_jumps().len()), (Some(stopped), 1));
        let passed: Vec<_> = run.passages().iter().map(|passage| (passage.number, passage.sample.z[0])).collect();
        assert_eq!(passed, [(0, 0.0), (1, 2.0)]);
    };
    check(&over().adaptive(1e-9, 1e-9).contact_events().run(q, z, 0.0..1.0).unwrap(), 1);
    check(&ends().adaptive(1e-9, 1e-9).contact_events().run(q, z, 0.0..1.0).unwrap(), 0);
    check(&over().contact_steps(0.7e-2).run(q, z, 0.0..1.0).unwrap(), 1);
    check(&ends().contact_steps(0.7e-2).run(q, z, 0.0..1.0).unwrap(), 0);
    check(&over().contact_steps(0.1).adaptive(1e-6, 1e-6).run(q, z, 0.0..1.0).unwrap(), 1);
    // At the end of the interval, which is the end of a step.
    let run = over().contact_steps(0.05).run(q, z, 0.0..0.25).unwrap();
    check(&run, 1);
    check(&over().adaptive(1e-9, 1e-9).contact_events().run(q, z, 0.0..0.25).unwrap(), 1);
}

/// A controller samples after a jump at its instant, and holds through one between two.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y), input(push), particle(mass = 2, position = [x, 0, y]), drive(x = push),
    contact(floor, gap = y, slip = rate(x), friction = 0.0), gravity = 10,
)]
struct Pushed {}

#[test]
fn controllers_sample_what_jumps_leave() {
    let kernel = Pushed {}.kernel().unwrap();
    let [q, z] = rest();
    // It brakes by 4 N for each m/s that was there at the last sample, 0.25 s apart: a blow at 0.3 s of 1 m/s.
    let law = |_: f64, _: &State, z: &State| SVector::from([-4.0 * z[0]]);
    let ready = || {
        let run = Simulation::new(&kernel).sampled(0.25, law).event(Crossing::Rising, |t, _, _| t - 0.3);
        run.then(|state: &mut Sample<PushedKernel>| state.z[0] += 1.0)
    };
    let by_hand = 0.2 + 0.25 - 0.5 * 2.0 * 0.0625;
    let run = ready().adaptive(1e-10, 1e-10).contact_events().run(q, z, 0.0..0.75).unwrap();
    assert!((run.last().unwrap().q[0] - by_hand).abs() < 1e-12, "{:?}", run.last());
    for h in [1e-2, 0.7e-2, 0.04] {
        let run = ready().contact_steps(h).run(q, z, 0.0..0.75).unwrap();
        assert!((run.samples.last().unwrap().state.q[0] - by_hand).abs() < 1e-12, "{h}");
    }
    let run = ready().contact_steps(0.1).adaptive(1e-6, 1e-6).run(q, z, 0.0..0.75).unwrap();
    assert!((run.samples.last().unwrap().state.q[0] - by_hand).abs() < 1e-12);
}

/// A block slides with v to a gate at x = s, is blown on by w there, and stops at
/// s + (√(v² − 2 μ g s) + w)²/(2 μ g): with the derivatives of that by all four.
#[test]
fn derivatives_pass_through_jumps() {
    type Four = Dual<4>;
    let (v, mu, s, w) = (3.0, 0.2, 0.5, 1.0);
    let [dv, dmu, ds, dw] = [Four::variable(v, 0), Four::variable(mu, 1), Four::variable(s, 2), Four::variable(w, 3)];
    let kernel = Block { mu: dmu, e: Four::constant(0.0) }.kernel().unwrap();
    let run = Simulation::new(&kernel)
        .event(Crossing::Rising, move |_, q: &SVector<Four, 2>, _| q[0] - ds)
        .then_through(move |state: &mut Sample<BlockKernel<Four>>| state.z[0] += dw)
        .adaptive(1e-12, 1e-12)
        .contact_events();
    let [zero, four] = [0.0, 4.0].map(Four::constant);
    let run = run.run(SVector::from([zero; 2]), SVector::from([dv, zero]), zero..four);
    let end = run.unwrap().last().unwrap().q[0];
    let (two, ten) = (Four::constant(2.0), Four::constant(10.0));
    let fast = (dv * dv - two * dmu * ten * ds).sqrt() + dw;
    let wanted = ds + fast * fast / (two * dmu * ten);
    assert!((end.value - wanted.value).abs() < 1e-9, "{end:?} {wanted:?}");
    for (found, wanted) in end.slopes.iter().zip(wanted.slopes) {
        assert!((found - wanted).abs() < 1e-8 * wanted.abs().max(1.0), "{end:?} {wanted:?}");
    }
}

/// Each by both kinds of runs.
fn refused(
    kernel: &BlockKernel<f64>,
    (q, z): (State, State),
    (crossing, function): (Crossing, EventFunction),
    jump: fn(&mut Sample<BlockKernel<f64>>),
) -> [gauss_contact::ContactError; 3] {
    let ready = || Simulation::new(kernel).event(crossing, function).then(jump);
    let by_events = ready().adaptive(1e-10, 1e-10).contact_events().run(q, z, 0.0..4.0).map(|_| ());
    let in_steps = ready().contact_steps(0.013).run(q, z, 0.0..4.0).map(|_| ());
    let adaptive = ready().contact_steps(0.1).adaptive(1e-6, 1e-6).run(q, z, 0.0..4.0).map(|_| ());
    [by_events, in_steps, adaptive].map(Result::unwrap_err)
}

fn kind_of(error: &gauss_contact::ContactError) -> IntegrationErrorKind {
    let ContactErrorKind::Integration(error) = &error.kind else { panic!("{error}") };
    error.kind
}

#[test]
fn jumps_that_cannot_be_are_refused() {
    let kernel = block(0.3, 0.0);
    let [q, z] = rest();
    let after = (Crossing::Rising, (|t, _, _| t - 0.5) as fn(f64, &State, &State) -> f64);
    for error in refused(&kernel, (q, z), after, |state| state.q[1] = -0.1) {
        assert_eq!(
            (error.contact, error.kind.clone()),
            (Some("floor"), ContactErrorKind::JumpPenetrates { event: 0, gap: -0.1 })
        );
        assert!((error.time - 0.5).abs() < 1e-14 && error.to_string().contains("event 0"), "{error}");
    }
    for error in refused(&kernel, (q, z), after, |state| state.t += 0.1) {
        assert_eq!(kind_of(&error), IntegrationErrorKind::InvalidJump { event: 0, mistake: JumpMistake::Time });
    }
    for error in refused(&kernel, (q, z), after, |state| state.z[0] = f64::NAN) {
        assert!(matches!(kind_of(&error), IntegrationErrorKind::NonFinite { .. }), "{error}");
    }
    // A wall that slows down and does not turn back.
    let wall = (Crossing::Rising, (|_, q, _| q[0] - 0.5) as fn(f64, &State, &State) -> f64);
    for error in refused(&kernel, (q, State::from([4.0, 0.0])), wall, |state| state.z[0] *= 0.5) {
        let kind = kind_of(&error);
        assert!(matches!(kind, IntegrationErrorKind::NotTurnedBack { event: 0, .. }), "{error}");
    }
    // A floor of one's own above the other, on which flights end in 0.4 s (1 + 0.8)/(1 − 0.8): from 1 m down to 0.2 m.
    let shelf = (Crossing::Falling, (|_, q, _| q[1] - 0.2) as fn(f64, &State, &State) -> f64);
    for error in refused(&kernel, (State::from([0.0, 1.0]), z), shelf, |state| state.z[1] *= -0.8) {
        assert!(matches!(kind_of(&error), IntegrationErrorKind::Zeno { event: 0, .. }), "{error}");
        assert!((error.time - 3.6).abs() < 1e-5, "{error}");
    }
}
