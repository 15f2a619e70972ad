//! Documents in MuJoCo: it has the accelerations, kinetic energies and gaps of their scenes.

use std::process::Command;

use crate::common::{Random, names};
use crate::scenes::{Example, JointState, Motion, examples};

/// Reads states from a file, and prints the largest differences of each scene.
const SCRIPT: &str = include_str!("compare.py");

/// The interpreter named in `GAUSS_PYTHON`, or `python3`, if it has MuJoCo.
fn python() -> Option<String> {
    let python = std::env::var("GAUSS_PYTHON").unwrap_or_else(|_| "python3".to_owned());
    let there = Command::new(&python).args(["-c", "import mujoco, numpy"]).output();
    let there = there.is_ok_and(|output| output.status.success());
    if !there {
        println!("not tested: {python} has not mujoco");
    }
    there.then_some(python)
}

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
    let states: Vec<String> = (0..10).map(|_| state(&example.motion(&kernel, &mut random))).collect();
    let (name, xml, states) = (example.name, example.mjcf().xml().to_owned(), states.join(",\n"));
    format!("{{\"name\": {name:?}, \"xml\": {xml:?}, \"inputs\": {inputs:?}, \"states\": [{states}]}}")
}

#[test]
fn mujoco_has_the_same_motions() {
    let Some(python) = python() else { return };
    let all: Vec<String> = examples().iter().map(states).collect();
    let file = std::env::temp_dir().join(format!("gauss_mjcf_{}.json", std::process::id()));
    std::fs::write(&file, format!("[{}]", all.join(",\n"))).expect("a file");
    let output = Command::new(python).arg("-c").arg(SCRIPT).arg(&file).output().expect("Python runs");
    std::fs::remove_file(&file).expect("no file");
    let (out, words) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    println!("{out}");
    assert!(output.status.success() && out.ends_with("compared\n"), "{out}{words}");
}
