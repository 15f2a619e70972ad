//! The example `recorded_inputs`: reading, interpolation, and the replay against equations written by hand.

use gauss_runtime::prelude::*;

use crate::craft::{Craft, apart, replay, replay_by_hand};
use crate::recording::Recording;

fn published() -> Recording {
    Recording::read(include_str!("../data/recorded_inputs.csv").as_bytes()).unwrap()
}

#[test]
fn mistakes_are_found_by_line() {
    let wrong = |rows: &str| {
        let text = format!("time_s,thrust_N,rudder_rad\n{rows}");
        Recording::read(text.as_bytes()).unwrap_err().to_string()
    };
    assert_eq!(wrong("0,1,0\n1,much,0\n2,1,0\n"), "line 3: invalid float literal");
    assert_eq!(wrong("0,1,0\n1,1\n"), "line 3: 2 values where the header has 3 columns");
    assert_eq!(wrong("0,1,0\n\n1,1,0\n1,2,0\n"), "line 5: time 1 s is not later than 1 s in the row before");
    assert_eq!(wrong("0,NaN,0\n"), "line 2: a number is not finite");
    assert_eq!(wrong(""), "line 1: no row follows the header");
    let error = Recording::read("time_s,thrust_N\n0,1\n".as_bytes()).unwrap_err();
    assert_eq!(error.to_string(), "line 2: missing field `rudder_rad`");
}

#[test]
fn values_are_interpolated_between_the_rows() {
    let text = "rudder_rad, time_s, thrust_N\n0.1,1,4\n0.3,3,8\n0.3,4,0\n";
    let recording = Recording::read(text.as_bytes()).unwrap();
    for (t, expected) in
        [(0.0, [4.0, 0.1]), (1.0, [4.0, 0.1]), (2.0, [6.0, 0.2]), (3.0, [8.0, 0.3]), (3.25, [6.0, 0.3])]
    {
        let found = recording.at(t);
        // Numbers below ten, three operations.
        assert!((0..2).all(|n| (found[n] - expected[n]).abs() < 1e-14), "{t}: {found:?}");
    }
    assert_eq!(recording.at(9.0), [0.0, 0.3]);
}

#[test]
fn a_replay_agrees_with_equations_by_hand_and_with_the_closed_form() {
    let (recording, craft) = (published(), Craft::published());
    let kernel = craft.kernel().unwrap();
    let samples = replay(&kernel, &recording).unwrap();
    // Halving the steps of a method of order 4 changes more than its error; where |v| v has its kinks it is of order 3.
    let [fine, coarse] = [80, 40].map(|steps| replay_by_hand(&recording, steps));
    let (near, far) = (apart(&samples, &fine), apart(&samples, &coarse));
    assert!(near < far && near < 1e-6, "{near:e} {far:e}");
    let (thrust, drag, surge) = (3.86_f64, -craft.xuu, craft.mass + craft.added[(0, 0)]);
    for sample in samples.iter().take_while(|sample| sample.t <= 20.0) {
        let speed = (thrust / drag).sqrt() * (sample.t * (thrust * drag).sqrt() / surge).tanh();
        // 1e-11 a step, some hundred steps.
        assert!((sample.z - SVector::from([speed, 0.0, 0.0])).amax() < 1e-9, "{} s", sample.t);
    }
}
