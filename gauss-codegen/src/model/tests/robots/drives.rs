//! Inputs by transmissions: gears, rotors, interfaces.

use super::{arm, joint, link, mistakes, model, remarks, robot};

fn geared(inside: &str) -> String {
    robot(&(joint("elbow", "revolute", "base", "arm", "") + &link("arm") + inside))
}

const TRANSMISSION: &str = "<transmission name=\"t\"><joint name=\"elbow\"/><actuator name=\"motor 1\">\
    <mechanicalReduction>50</mechanicalReduction><rotorInertia>1e-4</rotorInertia></actuator></transmission>";

#[test]
fn motors_behind_gears() {
    let text = geared(TRANSMISSION);
    let read = model(&text, ", inputs = actuators", "");
    let inputs: Vec<_> =
        read.item.inputs.iter().map(|input| (input.ident.to_string(), input.called.to_string())).collect();
    assert_eq!(inputs, [("motor_1".to_owned(), "motor_1".to_owned())]);
    let rates: Vec<_> = read.forces[0].rates().collect();
    assert_eq!(rates[0].0, "elbow");
    // 50² · 1e-4.
    assert_eq!(read.armatures.len(), 1);
    let both = model(&text, ", armature(elbow = 2.0)", "");
    assert_eq!((both.armatures.len(), both.item.inputs[0].ident.to_string()), (1, "elbow_effort".to_owned()));
    let told = remarks(&text, "");
    assert!(told[0].0.starts_with("5:1: the input of `motor 1` is the effort of its joint"), "{told:?}");
    assert!(remarks(&text, ", inputs = actuators").iter().all(|(text, _)| text.contains("is called")));
}

/// The inertia of a rotor, of the file or of the struct, is enough for a joint that nothing hangs on.
#[test]
fn rotors_without_links() {
    let bare = |inside: &str| robot(&(joint("elbow", "revolute", "base", "arm", "") + "<link name=\"arm\"/>" + inside));
    let refused = "4:1: the link `arm` moves, and neither it nor what hangs on it has an <inertial>; add one, give its \
                   joint an `armature`, or fix it";
    assert_eq!(mistakes(&bare(""), "", ""), [refused]);
    assert_eq!(model(&bare(TRANSMISSION), "", "").armatures.len(), 1);
    assert_eq!(model(&bare(""), ", armature(elbow = j)", "j: f64").armatures.len(), 1);
    let still = TRANSMISSION.replace("1e-4", "0");
    assert_eq!(mistakes(&bare(&still), "", ""), [refused]);
    // Of the joint that carries it, nothing is said.
    let both = joint("elbow", "revolute", "base", "arm", "") + &joint("wrist", "revolute", "arm", "hand", "");
    let both = robot(&(both + "<link name=\"arm\"/><link name=\"hand\"/>" + TRANSMISSION));
    assert_eq!(mistakes(&both, "", ""), [refused.replace("4:1", "5:19").replace("`arm`", "`hand`")]);
}

#[test]
fn what_transmissions_say_besides() {
    let velocity = "<transmission name=\"t\"><joint name=\"elbow\"><hardwareInterface>VelocityJointInterface\
        </hardwareInterface></joint></transmission>";
    let told = remarks(&geared(velocity), "");
    assert_eq!(told[0], ("5:44: `VelocityJointInterface` is no effort: the input of `elbow` is".to_owned(), false));
    assert!(!told[1].1 && told[1].0.ends_with("how many times: hardwareInterface (1)"), "{told:?}");
    let several = TRANSMISSION.replace("<actuator", "<joint name=\"elbow\"/><actuator");
    let told = remarks(&geared(&several), "");
    assert!(told[0].1 && told[0].0.contains("joins several"), "{told:?}");
    let unknown = TRANSMISSION.replace("joint name=\"elbow\"", "joint name=\"elbw\"");
    let text = "5:1: the transmission `motor 1` drives `elbw`, which is no joint; did you mean `elbow`?";
    assert_eq!(remarks(&geared(&unknown), ""), [(text.to_owned(), true)]);
    let broken = TRANSMISSION.replace(">50<", ">fifty<");
    assert_eq!(mistakes(&geared(&broken), "", ""), ["5:70: <mechanicalReduction>: expected a number, found `fifty`"]);
    // Without a rotor no inertia depends on it.
    let told = remarks(&geared(&broken.replace("<rotorInertia>1e-4</rotorInertia>", "")), "");
    assert!(told[0].1 && told[0].0.contains("<mechanicalReduction> is no number but `fifty`"), "{told:?}");
}

/// In expressions `input.elbow` is what `ArmInput { elbow }` is, whatever the input is called there itself.
#[test]
fn inputs_by_the_names_of_the_file() {
    let torque = |value: &str| format!(", input(push: Wrench), torque(body = arm, value = {value}, axes = observer)");
    let text = arm("");
    for value in ["[input.elbow, 0, 0]", "rotation_x(0.1) * [0, 2 * input.elbow, 0]"] {
        let whole = format!("{}, torque(body = arm, value = input.push.torque)", torque(value));
        assert_eq!(model(&text, &whole, "").item.inputs.len(), 2);
    }
    let defined = ", define(pushed = 2 * input.elbow), drive(elbow = pushed)";
    assert_eq!(model(&text, defined, "").item.inputs.len(), 1);
    let found = |value: &str| mistakes(&text, &torque(value), "");
    assert_eq!(found("[input.elbw, 0, 0]"), ["there is no input `elbw`; did you mean `input.elbow`?"]);
    assert_eq!(found("[input.gravity, 0, 0]"), ["there is no input `gravity`; `input(gravity)` declares one"]);
}

/// A motor of a joint that mimics another has no effort for an input.
#[test]
fn motors_of_joints_that_mimic() {
    let finger = joint("finger", "revolute", "base", "tip", "<mimic joint=\"elbow\" multiplier=\"2\"/>") + &link("tip");
    let own = TRANSMISSION.replace("elbow", "finger");
    let lost = "`motor 1` drives a joint that mimics another, and has no input: `inputs = actuators` has it";
    let told = |clauses: &str| {
        let all = remarks(&geared(&(finger.clone() + &own)), clauses);
        all.iter().any(|(text, ignored)| text.contains(lost) && *ignored)
    };
    assert!(told("") && told(", inputs = all") && told(", inputs = transmissions"));
    assert!(!told(", inputs = actuators") && !told(", inputs = none"));
    let both = remarks(&geared(&(finger + TRANSMISSION)), ", inputs = all");
    assert!(!both.iter().any(|(text, _)| text.contains("mimics another")));
}
