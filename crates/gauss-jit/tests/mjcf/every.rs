//! Scenes of examples and those that fuzzing begins with, most of which have no counterpart: each is a document that
//! can be read again, or an error.

use gauss_jit::{Mjcf, MjcfError, Model};

#[allow(dead_code, reason = "names of scenes are for tables")]
#[path = "../../../../gauss-codegen/tests/operations/sources.rs"]
mod sources;

const EXAMPLES: [&str; 6] = ["first", "charts", "cart_pole.rs", "hello_top.rs", "mpc_step.rs", "stiff_drag.rs"];

const SEEDS: &str = include_str!("../../../../gauss-codegen/tests/mutations/seeds.txt");

/// Numbers that a body has.
fn numbers(model: &Model) -> Vec<(String, Vec<f64>)> {
    let list = model.parameters().iter().map(|own| {
        let numbers = match own.axes[..] {
            [n, _] => (0..own.count).map(|k| if k % (n + 1) == 0 { 2.0 } else { 0.0 }).collect(),
            // A principal inertia about O has room for that of a centre of mass of the same numbers.
            [3] => vec![0.1; 3],
            _ => vec![1.0; own.count],
        };
        (own.name.clone(), numbers)
    });
    list.collect()
}

#[test]
fn scenes_are_written_or_refused() {
    let (mut written, mut refused) = (0, 0);
    let examples = EXAMPLES.into_iter().flat_map(|place| sources::of(&format!("../examples/{place}")));
    for source in SEEDS.split("\n\n").map(str::to_owned).chain(examples.map(|scene| scene.source)) {
        // Seeds are mistakes as well.
        let Ok(model) = Model::from_source(&source) else { continue };
        let parameters = numbers(&model);
        let parameters: Vec<(&str, &[f64])> = parameters.iter().map(|(name, list)| (&name[..], &list[..])).collect();
        match Mjcf::new(&source, &parameters) {
            Ok(document) => {
                written += 1;
                let file = std::env::temp_dir().join(format!("gauss_every_{}.xml", std::process::id()));
                std::fs::write(&file, document.xml()).expect("a file");
                let again = Model::from_mjcf(&file, &["inputs = actuators", "limits = none", "saturation = none"]);
                std::fs::remove_file(&file).expect("no file");
                assert!(again.is_ok(), "{source}\n{}", document.xml());
            }
            Err(MjcfError::NoCounterpart(list)) => {
                refused += 1;
                assert!(!list.is_empty() && list.iter().all(|line| !line.is_empty()), "{source}");
            }
            Err(error) => println!("{error}"),
        }
    }
    assert!(written > 2 && refused > 2, "{written} written, {refused} refused");
}
