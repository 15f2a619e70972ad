//! The claims of the example `hopping`: hand-overs lose nothing, the gait of the literature is stable, and impacts come
//! when they should, until the ball rests.

use gauss_contact::{ContactRun, EventKind};

use crate::model::{Ball, Runner};

#[test]
fn hand_overs_keep_energy_and_stances_are_symmetric_in_a_gait() {
    let runner = Runner::human();
    let run = runner.run(1.0, 5.0, 60).unwrap();
    assert!(run.steps.len() == 60 && !run.stumbled);
    let energy = runner.energy(run.steps[0].apex);
    for step in &run.steps {
        // The leg is at its full length at both ends of a stance: all energy is that of the mass. Tolerances of 1e-12 a
        // step of some hundred, of 1800 J.
        for moment in [step.apex, step.touchdown, step.liftoff] {
            assert!((runner.energy(moment) / energy - 1.0).abs() < 1e-9, "{}", runner.energy(moment) - energy);
        }
        for (_, [x, y], _) in [step.touchdown, step.liftoff] {
            assert!((f64::hypot(x - step.foot, y) - runner.l).abs() < 1e-12);
        }
    }
    // Time and way of a flight from apex to touchdown are those of a throw.
    let (step, (t, [x, y], [u, _])) = (&run.steps[7], run.steps[7].apex);
    let fall = (2.0 * (y - runner.l * runner.attack.sin()) / runner.g).sqrt();
    assert!((step.touchdown.0 - t - fall).abs() < 1e-11 && (step.touchdown.1[0] - x - u * fall).abs() < 1e-11);
    // The path between them is of the same energy in the air.
    assert!(step.path.iter().all(|m| m.0 > step.touchdown.0 || (runner.energy(*m) / energy - 1.0).abs() < 1e-9));
    // Stable: steps converge to one that is its own mirror image.
    let heights: Vec<f64> = run.steps.iter().map(|step| step.apex.1[1]).collect();
    assert!((heights[59] - heights[58]).abs() < 1e-3 * (heights[1] - heights[0]).abs(), "{heights:?}");
    let last = &run.steps[59];
    let (down, off) = (last.touchdown, last.liftoff);
    assert!(((last.foot - down.1[0]) - (off.1[0] - last.foot)).abs() < 1e-3);
    assert!((down.2[1] + off.2[1]).abs() < 1e-2 && (down.2[0] - off.2[0]).abs() < 1e-2);
}

#[test]
fn impacts_come_when_they_should_and_pile_up_to_rest() {
    let kernel = Ball { m: 0.1, g: 9.81 }.kernel().unwrap();
    let bounces = ContactRun::new(&kernel).adaptive(1e-10, 1e-12).run([1.0].into(), [0.0].into(), 0.0..3.0).unwrap();
    let fall = (2.0_f64 / 9.81).sqrt();
    let (mut t, mut flight) = (fall, 2.0 * fall);
    for event in bounces.events().iter().take(20) {
        assert!(matches!(event.kind, EventKind::Impact(_)) && (event.time - t).abs() < 1e-9, "{} {t}", event.time);
        flight *= 0.7;
        t += flight;
    }
    let rests = fall * (1.0 + 2.0 * 0.7 / 0.3);
    let EventKind::Rests { remaining, .. } = bounces.events().last().unwrap().kind else { panic!("it rests") };
    assert!((bounces.events().last().unwrap().time + remaining - rests).abs() < 1e-8);
    let end = bounces.last().unwrap();
    assert!(end.z[0] == 0.0 && end.q[0].abs() < 1e-15 && (bounces.forces(2.9).unwrap()[0] - 0.981).abs() < 1e-14);
}
