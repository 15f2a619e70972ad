//! Documents in MuJoCo: it has the accelerations, kinetic energies and gaps of their scenes.

use crate::common::{Random, names};
use crate::python::{agrees, has};
use crate::scenes::{Example, JointState, Motion, examples};

/// Reads states from a file, and prints the largest differences of each scene.
const SCRIPT: &str = include_str!("compare.py");

/// A motion as JSON.
fn state(motion: &Motion) -> String {
    let joint = |own: &JointState| {
        let JointState { name, place, rates, accelerations } = own;
        format!("[{name:?}, {place:?}, {rates:?}, {accelerations:?}]")
    };
    let joints = motion.joints.iter().map(joint).collect::<Vec<_>>().join(", ");
    let gaps: Vec<String> = motion.gaps.iter().map(|(name, gap)| format!("[{name:?}, {gap:?}]")).collect();
    let (inputs, energy, gaps) = (&motion.inputs, motion.energy, gaps.join(", "));
    format!("{{\"u\": {inputs:?}, \"energy\": {energy:?}, \"gaps\": [{gaps}], \"joints\": [{joints}]}}")
}

fn states(example: &Example) -> String {
    let kernel = example.kernel();
    let inputs = names(&kernel.model().description().inputs);
    let mut random = Random(11);
    let states: Vec<String> = (0..10).map(|_| state(&example.motion(kernel, &mut random))).collect();
    let (name, xml, states) = (example.name, example.mjcf().xml().to_owned(), states.join(",\n"));
    format!("{{\"name\": {name:?}, \"xml\": {xml:?}, \"inputs\": {inputs:?}, \"states\": [{states}]}}")
}

#[test]
fn mujoco_has_the_same_motions() {
    if has("mujoco") {
        agrees(SCRIPT, &examples().iter().map(states).collect::<Vec<_>>());
    }
}
