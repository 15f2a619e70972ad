//! Ranges, dry friction and contacts in documents: their numbers, and what is lost. `mujoco` has gaps beside MuJoCo's.

use crate::scenes::examples;

#[test]
fn numbers_of_contacts_are_those_of_the_scene() {
    let hopper = examples().iter().find(|example| example.name == "hopper").expect("a scene").mjcf();
    for part in [
        "<joint name=\"b\" type=\"hinge\" axis=\"0 1 0\" frictionloss=\"0.3\" range=\"-0.5 1\"/>",
        "<joint name=\"z\" type=\"slide\" axis=\"0 0 1\" range=\"-1000000000 2\"/>",
        "<geom name=\"heel_plane\" type=\"plane\" size=\"0 0 1\" pos=\"0.03 0 0.04\" zaxis=\"0.6 0 0.8\"/>",
        "<geom name=\"heel\" type=\"sphere\" pos=\"0 0 0\" size=\"0.07\"/>",
        "<geom name=\"trunk_3\" type=\"sphere\" pos=\"0.2 0 0.1\" size=\"1e-6\"/>",
        "<pair name=\"heel\" geom1=\"heel_plane\" geom2=\"heel\" condim=\"3\" friction=\"0.6 0.6\"/>",
        // One plane for all that meet it.
        "<pair name=\"trunk_0\" geom1=\"tip_plane\" geom2=\"trunk_0\" condim=\"1\"/>",
    ] {
        assert!(hopper.xml().contains(part), "{part}\n{}", hopper.xml());
    }
    let lost = hopper.lost().join("\n");
    for word in [
        "points touch as spheres of 1e-6 m, since MuJoCo has none without size: `tip`, `trunk_0`, `trunk_1`",
        "soft in MuJoCo",
        "friction of drilling and rolling of `heel`",
        "restitution",
        "range of `z` has one side",
    ] {
        assert!(lost.contains(word), "{word}\n{lost}");
    }
}

#[test]
fn spheres_meet_each_other() {
    let balls = examples().iter().find(|example| example.name == "two balls").expect("a scene").mjcf();
    for part in [
        "<geom name=\"balls\" type=\"sphere\" pos=\"0 0 0\" size=\"0.1\"/>",
        "<geom name=\"balls_other\" type=\"sphere\" pos=\"0 0.1 0.2\" size=\"0.2\"/>",
        "<geom name=\"stop_other\" type=\"sphere\" pos=\"0.2 0.3 -1.9\" size=\"0.3\"/>",
        "<pair name=\"balls\" geom1=\"balls_other\" geom2=\"balls\" condim=\"3\" friction=\"0.4 0.4\"/>",
        "<pair name=\"stop\" geom1=\"stop_other\" geom2=\"stop\" condim=\"1\"/>",
    ] {
        assert!(balls.xml().contains(part), "{part}\n{}", balls.xml());
    }
}

/// Whatever is lost is a comment of the document.
#[test]
fn losses_are_comments_of_the_document() {
    for example in examples().iter().filter(|own| ["hopper", "branches", "arms.xml"].contains(&own.name)) {
        let made = example.mjcf();
        assert!(!made.lost().is_empty(), "{}", example.name);
        made.lost().iter().for_each(|line| assert!(made.xml().contains(&format!("<!-- {line} -->")), "{line}"));
    }
}
