//! Dry friction of joints of robots' files, exactly: beside limits and armature, from event to event and in steps.

use gauss_contact::{ContactRun, ContactSteps, EventKind, Mode, StepSample};
use gauss_runtime::prelude::*;

const G: f64 = 9.81;
const EPSILON: f64 = f64::EPSILON;

#[derive(GaussDynamics)]
#[gauss(mjcf = "robots/dry.xml", inputs = actuators, joint_friction = dry, limits = range)]
struct Dry;

/// Coordinates: tilt, rail, crank; the pinion follows the crank.
type V = SVector<f64, 3>;

/// Of the cart with its rotor, and of crank and pinion, 0.1 + 0.05 + 2² · 0.02.
const CART: f64 = 2.5 + 1.5;
const CRANK: f64 = 0.15 + 4.0 * 0.02;
/// 0.5 of the crank and twice 0.2 of the pinion, which turns twice as fast.
const HELD: f64 = 0.9;

fn steps(h: f64, pull: f64, turn: f64, end: f64) -> Vec<StepSample<DryKernel>> {
    let kernel = Dry.kernel().unwrap();
    let input = move |_: f64, _: &V, _: &V| DryInput { pull, turn }.input();
    ContactSteps::new(&kernel, h).input(input).run(V::zeros(), V::zeros(), 0.0..end).unwrap().samples
}

#[test]
fn bounds_are_those_of_the_file() {
    let contacts: Vec<_> = DryKernel::CONTACTS.iter().map(|own| (own.name, own.has_gap())).collect();
    let expected = [("rail_from", true), ("rail_to", true), ("tilt", false), ("rail", false), ("crank", false)];
    assert_eq!(contacts, expected);
    let kernel = Dry.kernel().unwrap();
    let friction = kernel.friction(0.0, &V::zeros(), &V::zeros(), &DryInput::default().input());
    assert!((friction - SVector::from([0.0, 0.0, 6.0, 3.0, HELD])).amax() < 2.0 * EPSILON, "{friction}");
    // Armature acts, of the rotor alone on the cart and through the gear on the crank.
    let mass = kernel.mass_matrix(0.0, &V::zeros());
    assert!((mass[(1, 1)] - CART).abs() < 4.0 * EPSILON && (mass[(2, 2)] - CRANK).abs() < 4.0 * EPSILON, "{mass}");
}

/// What friction can hold does not move by a bit, in ten thousand steps.
#[test]
fn what_is_held_does_not_creep() {
    for step in steps(1e-2, 2.9, -0.89, 100.0) {
        assert_eq!((step.state.q, step.state.z), (V::zeros(), V::zeros()), "{}", step.state.t);
        assert_eq!(step.modes, [Mode::Open, Mode::Open, Mode::Sticks, Mode::Sticks, Mode::Sticks]);
        // The lever would fall about +y, to positive angles; forces are those that hold, over the length of the step.
        let held = step.impulses / 1e-2;
        let expected = SVector::from([0.0, 0.0, -2.0 * G * 0.2, -2.9, 0.89]);
        assert!((held - expected).amax() < 1e-11, "{held}");
    }
}

/// Beyond the bound the cart moves by what is left, with its rotor, and stops at its limit; the crank turns.
#[test]
fn what_is_pushed_beyond_moves_by_the_rest() {
    let (pull, turn, end) = (5.0, -1.5, 0.4);
    let (a, w) = ((pull - 3.0) / CART, (turn + HELD) / CRANK);
    let kernel = Dry.kernel().unwrap();
    let input = move |_: f64, _: &V, _: &V| DryInput { pull, turn }.input();
    let run = ContactRun::new(&kernel).input(input).adaptive(1e-11, 1e-11);
    let run = run.run(V::zeros(), V::zeros(), 0.0..2.0).unwrap();
    let now = run.at(end).unwrap();
    let expected = SVector::from([0.0, a, w]) * (0.5 * end * end);
    assert!((now.q - expected).amax() < 1e-10 && now.q[0] == 0.0, "{}", now.q);
    // Forces are constant: steps of the second order have no error but rounding.
    let stepped = steps(1e-2, pull, turn, end);
    let last = stepped.last().unwrap();
    assert!((last.state.q - expected).amax() < 1e-12 && (last.state.z[1] - a * end).abs() < 1e-12, "{}", last.state.q);
    assert_eq!(last.modes[2..], [Mode::Sticks, Mode::Slides([1.0, 0.0, 0.0]), Mode::Slides([-1.0, 0.0, 0.0])]);
    // The limit is at 0.5, without restitution.
    let stop = run.events().iter().find(|event| matches!(event.kind, EventKind::Impact(_))).unwrap();
    assert!((stop.time - (2.0 * 0.5 / a).sqrt()).abs() < 1e-9 && stop.name == "rail_to", "{stop:?}");
    for (at, z) in [(run.last().unwrap().q, run.last().unwrap().z), {
        let last = steps(1e-2, pull, turn, 2.0).pop().unwrap().state;
        (last.q, last.z)
    }] {
        assert!((at[1] - 0.5).abs() < 4.0 * EPSILON && z[1] == 0.0, "{at} {z}");
    }
}

/// It slides on without a push until friction has taken its energy, and rests then.
#[test]
fn what_slides_stops_and_rests() {
    let kernel = Dry.kernel().unwrap();
    let v = -0.9;
    let run = ContactSteps::new(&kernel, 1e-3).input(|_, _: &V, _: &V| DryInput::default().input());
    let run = run.run(V::zeros(), SVector::from([0.0, v, 0.0]), 0.0..2.0).unwrap();
    let end = run.last().unwrap().state.q[1];
    // v²/2a, within the part of a step in which it stops.
    let (a, h) = (3.0 / CART, 1e-3);
    assert!((end + v * v / (2.0 * a)).abs() < a * h * h, "{end}");
    let rest = run.iter().position(|step| step.state.z[1] == 0.0).unwrap();
    assert!((run[rest].state.t - v.abs() / a).abs() < 2.0 * h, "{}", run[rest].state.t);
    assert!(run[rest..].iter().all(|step| step.state.q[1] == end && step.state.z[1] == 0.0));
}

/// The same of a URDF: dry friction of 0.2 in the elbow, which its two fingers have not.
#[derive(GaussDynamics)]
#[gauss(urdf = "robots/gripper.urdf", joint_friction = dry, limits = none, saturation = none)]
struct Gripper;

#[test]
fn friction_of_a_urdf() {
    let kernel = Gripper.kernel().unwrap();
    assert_eq!(GripperKernel::CONTACTS.iter().map(|own| own.name).collect::<Vec<_>>(), ["elbow"]);
    let start = SVector::from([0.3, 0.02]);
    let run = |effort: f64| {
        let input = move |_: f64, _: &SVector<f64, 2>, _: &SVector<f64, 2>| SVector::from([effort, 0.0]);
        ContactSteps::new(&kernel, 1e-3).input(input).run(start, SVector::zeros(), 0.0..0.5).unwrap()
    };
    // Nothing weighs: what is below the bound does not move the elbow, what is above does.
    assert!(run(0.199).iter().all(|step| step.state.q[0] == 0.3));
    assert!(run(-0.199).iter().all(|step| step.state.q[0] == 0.3));
    assert!(run(0.201).last().unwrap().state.q[0] > 0.3);
}
