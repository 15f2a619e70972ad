//! Documents read again: a derivation of the document gives the accelerations of the scene that it was written of.

use std::path::Path;

use gauss_jit::{Kernel, Mistakes, Model, QuantityKind};

use crate::common::{Random, names};
use crate::scenes::{Example, Motion, examples};

/// Numbers of a document are right to 2e-16 of the largest beside them, and a mass matrix of condition 1e5, as of legs
/// on a trunk, loses five digits of that. A particle on joints has 1e-14 kg m² in the place of 0, beside moments of
/// 1e-3.
const ROUNDING: f64 = 1e-10;

/// The state of the scene for the kernel of the document, whose joints have the names of the coordinates.
fn state(kernel: &Kernel, motion: &Motion, input: &dyn Fn(&Motion, &str) -> f64) -> [Vec<f64>; 3] {
    let description = kernel.model().description();
    let (mut groups, mut scalars, mut z) = (Vec::new(), Vec::new(), Vec::new());
    for own in &description.coordinates {
        let joint = motion.joints.iter().find(|joint| joint.name == own.name);
        let joint = joint.unwrap_or_else(|| panic!("no joint {}", own.name));
        match joint.place.len() {
            1 => scalars.extend(&joint.place),
            count => groups.extend(
                [&joint.place[count - 3..], &joint.place[count - 4..count - 3], &joint.place[..count - 4]].concat(),
            ),
        }
        z.extend(joint.body_rates());
    }
    [[groups, scalars].concat(), z, names(&description.inputs).iter().map(|name| input(motion, name)).collect()]
}

/// A document as a file of its own.
fn with_file<T>(text: &str, end: &str, read: impl FnOnce(&Path) -> T) -> T {
    let thread = format!("{:?}", std::thread::current().id()).replace(|c: char| !c.is_ascii_digit(), "");
    let file = std::env::temp_dir().join(format!("gauss_again_{}_{thread}.{end}", std::process::id()));
    std::fs::write(&file, text).expect("a file");
    let read = read(&file);
    std::fs::remove_file(&file).expect("no file");
    read
}

fn compare(
    example: &Example,
    again: Result<Model, Mistakes>,
    input: &dyn Fn(&Motion, &str) -> f64,
) -> Result<(), String> {
    let again = again.unwrap_or_else(|error| panic!("{}: {error}", example.name)).kernel(&[]).expect("a kernel");
    let kernel = example.kernel();
    let mut random = Random(7);
    for _ in 0..10 {
        let motion = example.motion(kernel, &mut random);
        let [q, z, u] = state(&again, &motion, input);
        let z_dot = again.acceleration(0.0, &q, &z, &u).expect("accelerations");
        let joints = Example { hybrid: false, ..example.clone() }.joints(&again, &q, &z, &z_dot);
        let all = motion.joints.iter().flat_map(|joint| &joint.accelerations);
        let size = 1.0 + all.fold(0.0, |size: f64, a| size.max(a.abs()));
        for joint in &motion.joints {
            let read = joints.iter().find(|read| read.name == joint.name).expect("a joint");
            for (a, b) in joint.accelerations.iter().zip(&read.accelerations) {
                let apart = (a - b).abs();
                if apart.is_nan() || apart > ROUNDING * size {
                    return Err(format!("{}, {}: {a} is read as {b}", example.name, joint.name));
                }
            }
        }
    }
    Ok(())
}

/// Compares all scenes, and names those that differ.
fn all_agree(compare: impl Fn(&Example) -> Result<(), String>) {
    let wrong: Vec<String> = examples().iter().filter_map(|example| compare(example).err()).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn mjcf_has_the_accelerations_of_its_scenes() {
    all_agree(|example| {
        // Loops are between sites, and read between bodies alone.
        if example.closed.is_some() {
            return Ok(());
        }
        let clauses = ["inputs = actuators", "limits = none", "saturation = none"];
        let again = with_file(example.mjcf().xml(), "xml", |file| Model::from_mjcf(file, &clauses));
        let inputs = names(&example.kernel().model().description().inputs);
        compare(example, again, &|motion, name| {
            let place = inputs.iter().position(|own| own == name);
            motion.inputs[place.unwrap_or_else(|| panic!("no input {name} among {inputs:?}"))]
        })
    });
}

/// Efforts of joints are what acts on them beside weight, and beside damping, which the document has.
#[test]
fn urdf_has_the_accelerations_of_its_scenes() {
    all_agree(|example| {
        let Some(made) = example.urdf() else { return Ok(()) };
        let gravity =
            made.lost().iter().find_map(|line| Some(line.strip_prefix("gravity is lost, (")?.split_once(')')?.0));
        let gravity = format!("gravity = [{}]", gravity.expect("a gravity"));
        let clauses = [&gravity[..], "limits = none", "saturation = none", "waive(triangle_inequality)"];
        let again = with_file(made.xml(), "urdf", |file| Model::from_urdf(file, &clauses));
        // A joint that floats has no efforts.
        let floats =
            example.kernel().model().description().coordinates.iter().any(|own| own.kind == QuantityKind::Pose);
        compare(&Example { idle: floats, ..example.clone() }, again, &|motion, name| {
            let before = motion.joints.iter().take_while(|joint| joint.name != name);
            let first = before.map(|joint| joint.rates.len()).sum::<usize>();
            let joint = motion.joints.iter().find(|joint| joint.name == name);
            let joint = joint.unwrap_or_else(|| panic!("no joint {name}"));
            motion.forces[first] + damping(made.xml(), name) * joint.rates[0]
        })
    });
}

/// The damping of a joint in a document.
fn damping(text: &str, joint: &str) -> f64 {
    let own = text.split_once(&format!("<joint name=\"{joint}\"")).and_then(|(_, rest)| rest.split_once("</joint>"));
    let (own, _) = own.unwrap_or_else(|| panic!("no joint {joint}: {text}"));
    let number = own.split_once("damping=\"").and_then(|(_, rest)| rest.split_once('"'));
    number.map_or(0.0, |(number, _)| number.parse().expect("a number"))
}
