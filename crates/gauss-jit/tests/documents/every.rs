//! Scenes of examples and those that fuzzing begins with, most of which have no counterpart: each is a document that
//! can be read again, or an error.

use std::path::Path;

use gauss_jit::{DocumentError, Mistakes, Mjcf, Model, Urdf};

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

/// Whether a document can be read again; `None` of what is wrong with the numbers of the scene.
fn is_written(
    source: &str,
    made: Result<String, DocumentError>,
    end: &str,
    read: impl Fn(&Path) -> Result<Model, Mistakes>,
) -> Option<bool> {
    match made {
        Ok(text) => {
            let file = std::env::temp_dir().join(format!("gauss_every_{}.{end}", std::process::id()));
            std::fs::write(&file, &text).expect("a file");
            let again = read(&file);
            std::fs::remove_file(&file).expect("no file");
            assert!(
                again.is_ok(),
                "{source}\n{text}{}",
                again.err().map(|error| error.to_string()).unwrap_or_default()
            );
            Some(true)
        }
        Err(DocumentError::NoCounterpart { list, .. }) => {
            assert!(!list.is_empty() && list.iter().all(|line| !line.is_empty()), "{source}");
            Some(false)
        }
        Err(error) => {
            println!("{error}");
            None
        }
    }
}

#[test]
fn scenes_are_written_or_refused() {
    let (mut mjcf, mut urdf) = ([0; 2], [0; 2]);
    let examples = EXAMPLES.into_iter().flat_map(|place| sources::of(&format!("../examples/{place}")));
    for source in SEEDS.split("\n\n").map(str::to_owned).chain(examples.map(|scene| scene.source)) {
        // Seeds are mistakes as well.
        let Ok(model) = Model::from_source(&source) else { continue };
        let parameters = numbers(&model);
        let parameters: Vec<(&str, &[f64])> = parameters.iter().map(|(name, list)| (&name[..], &list[..])).collect();
        let made = Mjcf::new(&source, &parameters).map(|made| made.xml().to_owned());
        let clauses = ["inputs = actuators", "limits = none", "saturation = none"];
        let written = is_written(&source, made, "xml", |file| Model::from_mjcf(file, &clauses));
        written.into_iter().for_each(|written| mjcf[usize::from(written)] += 1);
        let made = Urdf::new(&source, &parameters).map(|made| made.xml().to_owned());
        let clauses = ["limits = none", "saturation = none", "waive(triangle_inequality)"];
        let written = is_written(&source, made, "urdf", |file| Model::from_urdf(file, &clauses));
        written.into_iter().for_each(|written| urdf[usize::from(written)] += 1);
    }
    assert!(mjcf.iter().chain(&urdf).all(|count| *count > 2), "refused and written: {mjcf:?} and {urdf:?}");
}
