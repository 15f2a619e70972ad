//! Documents read again: a derivation of the document gives the accelerations of the scene that it was written of.

use gauss_jit::{Kernel, Model};

use crate::common::{Random, names};
use crate::scenes::{Example, Motion, examples};

/// Numbers of a document are right to 2e-16 of the largest beside them, and a mass matrix of condition 1e5, as of legs
/// on a trunk, loses five digits of that. A particle on joints has 1e-14 kg m² in the place of 0, beside moments of
/// 1e-3.
const ROUNDING: f64 = 1e-10;

/// The state of the scene for the kernel of the document, whose joints have the names of the coordinates.
fn state(kernel: &Kernel, motion: &Motion, inputs: &[String]) -> [Vec<f64>; 3] {
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
    let input = |name: &String| {
        let place = inputs.iter().position(|own| own == name);
        motion.inputs[place.unwrap_or_else(|| panic!("no input {name} among {inputs:?}"))]
    };
    [[groups, scalars].concat(), z, names(&description.inputs).iter().map(input).collect()]
}

fn compare(example: &Example) {
    let folder = std::env::temp_dir().join(format!("gauss_mjcf_{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let file = folder.join(format!("{}.xml", example.name.replace(' ', "_")));
    std::fs::write(&file, example.mjcf().xml()).expect("a file");
    let again = Model::from_mjcf(&file, &["inputs = actuators", "limits = none", "saturation = none"]);
    let again = again.unwrap_or_else(|error| panic!("{}: {error}", example.name)).kernel(&[]).expect("a kernel");
    let kernel = example.kernel();
    let inputs = names(&kernel.model().description().inputs);
    let mut random = Random(7);
    for _ in 0..10 {
        let motion = example.motion(&kernel, &mut random);
        let [q, z, u] = state(&again, &motion, &inputs);
        let z_dot = again.acceleration(0.0, &q, &z, &u).expect("accelerations");
        let joints = Example { hybrid: false, ..example.clone() }.joints(&again, &q, &z, &z_dot);
        let all = motion.joints.iter().flat_map(|joint| &joint.accelerations);
        let size = 1.0 + all.fold(0.0, |size: f64, a| size.max(a.abs()));
        for joint in &motion.joints {
            let read = joints.iter().find(|read| read.name == joint.name).expect("a joint");
            for (a, b) in joint.accelerations.iter().zip(&read.accelerations) {
                assert!((a - b).abs() <= ROUNDING * size, "{}, {}: {a} is read as {b}", example.name, joint.name);
            }
        }
    }
    std::fs::remove_dir_all(&folder).expect("no folder");
}

#[test]
fn documents_have_the_accelerations_of_their_scenes() {
    let all = examples();
    let differs = |example: &&Example| std::panic::catch_unwind(|| compare(example)).is_err();
    let wrong: Vec<&str> = all.iter().filter(differs).map(|example| example.name).collect();
    assert!(wrong.is_empty(), "{wrong:?}");
}
