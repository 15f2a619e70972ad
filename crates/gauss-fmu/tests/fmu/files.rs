//! What is in an FMU: descriptions that are well-formed and agree with the code, and the same bytes each time.

use std::collections::BTreeSet;
use std::io::Read;

use gauss_fmu::Version;

use crate::scenes::{ARMS, SCENES, compiler};

#[test]
fn descriptions_are_well_formed_and_name_every_variable_once() {
    for scene in SCENES {
        for (version, tag) in [(Version::Two, "ScalarVariable"), (Version::Three, "Float64")] {
            let text = scene.fmu(version).description("it").expect("a description");
            let document = roxmltree::Document::parse(&text).unwrap_or_else(|error| panic!("{error}\n{text}"));
            let variables: Vec<_> = document.descendants().filter(|node| node.has_tag_name(tag)).collect();
            let names: BTreeSet<_> = variables.iter().filter_map(|node| node.attribute("name")).collect();
            assert_eq!(names.len(), variables.len(), "{}", scene.name);
            for (place, node) in variables.iter().enumerate() {
                assert_eq!(node.attribute("valueReference"), Some(place.to_string().as_str()));
            }
            let rates = document.descendants().filter(|node| node.attribute("derivative").is_some());
            for node in rates {
                let own = if version == Version::Two { node.parent().expect("a variable") } else { node };
                let place: usize = node.attribute("derivative").and_then(|k| k.parse().ok()).expect("a place");
                let state = variables[place - usize::from(version == Version::Two)].attribute("name");
                assert_eq!(own.attribute("name"), state.map(|name| format!("der({name})")).as_deref());
            }
        }
    }
}

#[test]
fn units_and_start_values_are_those_of_the_scene() {
    let text = ARMS.fmu(Version::Three).description("arms").expect("a description");
    let document = roxmltree::Document::parse(&text).expect("well-formed");
    let variable = |name: &str| document.descendants().find(|node| node.attribute("name") == Some(name)).expect("it");
    let g = variable("g");
    assert_eq!(g.attribute("unit"), Some("m/s^2"));
    assert_eq!(g.attribute("start"), Some("9.81"));
    assert_eq!(g.attribute("description"), Some("Acceleration of \"free fall\" & more."));
    assert_eq!(variable("motor").attribute("unit"), Some("N m"));
    assert_eq!(variable("a").attribute("start"), Some("0.3"));
    assert_eq!(variable("lower.inertia[1,1]").attribute("start"), Some("0.1"));
    let unit = document.descendants().find(|node| node.has_tag_name("Unit") && node.attribute("name") == Some("N m"));
    let base = unit.and_then(|unit| unit.first_element_child()).expect("its base units");
    assert_eq!([base.attribute("kg"), base.attribute("m"), base.attribute("s")], [Some("1"), Some("2"), Some("-2")]);
}

/// The archive holds the source code and, where there is a compiler, the binary.
#[test]
fn archives() {
    let folder = tempfile::tempdir().expect("a folder");
    for (version, name) in [(Version::Two, "two"), (Version::Three, "three")] {
        let file = folder.path().join("below").join(format!("{name}.fmu"));
        let written = ARMS.fmu(version).write(&file).expect("it is written");
        assert_eq!(written.platform.is_some(), compiler().is_some() && cfg!(target_os = "linux"));
        let bytes = std::fs::read(&file).expect("the file");
        let mut archive = zip::ZipArchive::new(std::io::Cursor::new(&bytes)).expect("an archive");
        let mut text = String::new();
        archive.by_name("sources/fmu.c").expect("it").read_to_string(&mut text).expect("text");
        assert!(text.contains("#include \"model.c\""));
        assert_eq!(archive.by_name("sources/buildDescription.xml").is_ok(), version == Version::Three);
        if let Some(platform) = written.platform {
            archive.by_name(&format!("binaries/{platform}/{name}.so")).expect("the binary");
        }
        ARMS.fmu(version).write(&file).expect("it is written again");
        assert_eq!(std::fs::read(&file).expect("the file"), bytes, "the same bytes each time");
    }
}

/// A robot's inputs have the names of its joints, as its coordinates have: these keep them.
#[test]
fn states_keep_their_names() {
    let arm = "#[gauss(urdf = \"../../examples/python/arm.urdf\", gravity = 9.81)] struct Robot {}";
    let text = gauss_fmu::Fmu::new(arm, &[]).expect("a robot").start(&[("elbow", 0.2)]).expect("a state");
    let text = text.description("arm").expect("a description");
    let document = roxmltree::Document::parse(&text).expect("well-formed");
    let causality = |name: &str| {
        let found = document.descendants().find(|node| node.attribute("name") == Some(name));
        found.and_then(|node| node.attribute("causality").map(str::to_owned))
    };
    assert_eq!(causality("elbow").as_deref(), Some("output"));
    assert_eq!(causality("input.elbow").as_deref(), Some("input"));
    assert_eq!(causality("der(elbow)").as_deref(), Some("local"));
}
