//! Documents in Pinocchio: it has the accelerations and kinetic energies of their scenes.

use crate::common::Random;
use crate::python::{agrees, has};
use crate::scenes::{Example, JointState, Motion, examples};

/// Reads states from a file, and prints the largest differences of each scene.
const SCRIPT: &str = include_str!("compare_pinocchio.py");

/// A motion as JSON, with the forces that joints have beside weight.
fn state(motion: &Motion) -> String {
    let mut first = 0;
    let mut joint = |own: &JointState| {
        let (name, place, rates, accelerations) = (&own.name, &own.place, own.body_rates(), own.body_accelerations());
        let forces = &motion.forces[first..first + rates.len()];
        first += rates.len();
        format!("[{name:?}, {place:?}, {rates:?}, {accelerations:?}, {forces:?}]")
    };
    let joints = motion.joints.iter().map(&mut joint).collect::<Vec<_>>().join(", ");
    format!("{{\"energy\": {:?}, \"joints\": [{joints}]}}", motion.energy)
}

fn states(example: &Example) -> Option<String> {
    let (made, kernel) = (example.urdf()?, example.kernel());
    let mut random = Random(13);
    let states: Vec<String> = (0..10).map(|_| state(&example.motion(kernel, &mut random))).collect();
    let (name, states) = (example.name, states.join(",\n"));
    Some(format!("{{\"name\": {name:?}, \"xml\": {:?}, \"states\": [{states}]}}", made.xml()))
}

#[test]
fn pinocchio_has_the_same_motions() {
    if has("pinocchio") {
        agrees(SCRIPT, &examples().iter().filter_map(states).collect::<Vec<_>>());
    }
}
