//! Joints of files that are locked.

use super::{Scratch, arm, joint, link, mistakes, model, read, remarks, robot};
use crate::model::Model;

/// Two links, a finger, and one that follows it at −½ of its way.
fn gripper() -> String {
    let follows = "<mimic joint=\"left\" multiplier=\"-0.5\" offset=\"0.01\"/>";
    robot(
        &(joint("elbow", "revolute", "base", "arm", "<limit lower=\"-1\" upper=\"1\" effort=\"0\" velocity=\"0\"/>")
            + &joint("wrist", "continuous", "arm", "hand", "<origin xyz=\"0 0 1\"/>")
            + &joint("left", "prismatic", "hand", "thumb", "<dynamics damping=\"0.1\"/>")
            + &joint("right", "prismatic", "hand", "finger", follows)
            + &["arm", "hand", "thumb", "finger"].map(link).concat()),
    )
}

fn names(read: &Model) -> Vec<String> {
    read.coordinates.iter().map(|q| q.ident.to_string()).collect()
}

fn bodies(read: &Model) -> Vec<String> {
    let massive = read.bodies.iter().filter(|body| !body.massless);
    massive.map(|body| body.name.as_ref().unwrap().to_string()).collect()
}

/// At numbers masses are added, and forces of the joint are gone; followers are held where they stand.
#[test]
fn joints_held_at_numbers() {
    let read = model(&gripper(), ", limits = none, lock(left = 0.02)", "");
    assert_eq!(names(&read), ["elbow", "wrist"]);
    assert_eq!(bodies(&read), ["arm", "hand"]);
    let inputs: Vec<String> = read.item.inputs.iter().map(|input| input.called.to_string()).collect();
    assert_eq!(inputs, ["elbow", "wrist"]);
    assert!(read.forces.iter().all(|force| force.name.as_ref().is_none_or(|name| name != "joint_damping")));
    let read = model(&gripper(), ", limits = none, lock(elbow = 0.5, wrist = pi)", "");
    assert_eq!((names(&read), bodies(&read)), (vec!["left".into()], vec!["thumb".into(), "finger".into()]));
}

/// At parameters links are bodies of their own, which a value of the struct places.
#[test]
fn joints_held_at_parameters() {
    let read = model(&gripper(), ", limits = none, lock(left = open)", "open: f64");
    assert_eq!(
        (names(&read), bodies(&read)),
        (vec!["elbow".into(), "wrist".into()], ["arm", "hand", "thumb", "finger"].map(String::from).to_vec())
    );
    let place = |name: &str| {
        let body = read.bodies.iter().find(|body| body.name.as_ref().is_some_and(|own| own == name));
        super::super::systems::show(body.unwrap().position.as_ref().unwrap())
    };
    assert!(
        place("thumb").contains("open") && place("finger").contains("open"),
        "{} {}",
        place("thumb"),
        place("finger")
    );
    // What hangs on a held base does not move, and weighs nothing.
    let read = model(&gripper(), ", limits = none, lock(elbow = bent)", "bent: f64");
    assert_eq!(bodies(&read), ["hand", "thumb", "finger"]);
}

#[test]
fn what_is_told_of_locks() {
    let told = remarks(&gripper(), ", limits = none, lock(wrist = 0)");
    let text = "4:1: the joint `wrist` is locked: it has no coordinate, no speed and no input, and its limits, springs, \
                damping, friction and armature are left out";
    assert!(told.contains(&(text.to_owned(), false)), "{told:?}");
    let driven = gripper().replace(
        "</robot>",
        "<transmission name=\"motor\"><type>transmission_interface/SimpleTransmission</type><joint name=\"wrist\">\
         <hardwareInterface>x</hardwareInterface></joint><actuator name=\"motor\"/></transmission></robot>",
    );
    let told = remarks(&driven, ", limits = none, lock(wrist = 0)");
    assert!(told.iter().any(|(text, acts)| *acts && text.contains("drives locked joints alone")), "{told:?}");
}

#[test]
fn mistakes_of_locked_joints() {
    let wheel = gripper().replace("name=\"wrist\" type=\"continuous\"", "name=\"wrist\" type=\"planar\"");
    let found = mistakes(
        &gripper(),
        ", limits = range, lock(elbow = 2.5, right = 0.1, lefft = 0, wrist = 0, wrist = 1), lock(hand = 0)",
        "",
    );
    let mut expected = vec![
        "the joint `elbow` would stand at 2.5, and its range in the file is from -1 to 1; lock it within, or write \
         `limits = none`",
        "`right` follows the joint `left`, and stands where that one is; lock `left`",
        "`wrist` is locked twice; keep one of the two",
        "`lefft` is no coordinate, and a lock holds one; did you mean `left`?",
        "`hand` is no coordinate, and a lock holds one; expected `left`",
    ];
    assert_eq!(found, expected);
    expected = vec!["`wrist` moves by three coordinates; lock those of `wrist_x`, `wrist_y`, `wrist_theta`"];
    assert_eq!(mistakes(&wheel, ", limits = none, lock(wrist = 0)", ""), expected);
    let read = model(&wheel, ", limits = none, lock(wrist_x = 0.1)", "");
    assert_eq!(names(&read), ["elbow", "wrist_y", "wrist_theta", "left"]);
    // Without limits that act no value is beyond them.
    assert_eq!(names(&model(&gripper(), ", limits = none, lock(elbow = 2.5)", "")), ["wrist", "left"]);
    let found = mistakes(&arm(""), ", lock(elbow = 0)", "");
    assert!(found[0].contains("nothing moves: all joints are locked or fixed"), "{found:?}");
    assert_eq!(
        mistakes(&gripper(), ", limits = none, lock(wrist = 0), armature(wrist = 1), drive(push, wrist = 2)", ""),
        [
            "`wrist` is locked, so that nothing drives it; remove this, or the lock",
            "`wrist` is locked, so that nothing turns with it; remove this, or the lock"
        ]
    );
}

/// Tendons and equalities keep what still moves; of locked joints alone they are gone, and a broken one is told.
#[cfg(feature = "mjcf")]
#[test]
fn relations_of_locked_joints() {
    let text = "<mujoco><worldbody><body name=\"a\"><joint name=\"p\" axis=\"0 0 1\"/><geom size=\"0.1\"/>\
                <body name=\"b\" pos=\"1 0 0\"><joint name=\"q\" axis=\"0 0 1\"/><geom size=\"0.1\"/>\
                <body name=\"c\" pos=\"1 0 0\"><joint name=\"r\" axis=\"0 0 1\"/><geom size=\"0.1\"/></body></body></body>\
                </worldbody><tendon><fixed name=\"t\" stiffness=\"3\" springlength=\"0.1\"><joint joint=\"p\" coef=\"2\"/>\
                <joint joint=\"q\" coef=\"1\"/></fixed></tendon>\
                <equality><joint joint1=\"p\" joint2=\"q\" polycoef=\"0 0 1 0 0\"/></equality>\
                <actuator><motor name=\"m\" joint=\"p\"/><motor name=\"n\" joint=\"r\"/></actuator></mujoco>";
    let file = Scratch::called(text, "xml");
    let of = |clauses: &str| read(&file.of(clauses, "")).unwrap_or_else(|error| panic!("{error}"));
    let one = of(", limits = none, inputs = actuators, lock(q = 0.3)");
    assert_eq!((names(&one), one.constraints.len()), (vec!["p".into(), "r".into()], 1));
    assert_eq!(
        super::super::systems::show(&one.constraints[0].expression),
        "(Subtract p (Add 0 (Multiply 1 (Multiply 3/10 3/10))))"
    );
    let both = of(", limits = none, inputs = actuators, lock(p = 0.09, q = 0.3)");
    assert_eq!((names(&both), both.constraints.len()), (vec!["r".into()], 0));
    assert_eq!(both.item.inputs.iter().map(|input| input.ident.to_string()).collect::<Vec<_>>(), ["n"]);
    let told = |read: &Model| -> Vec<String> {
        read.item.described.iter().flat_map(|file| &file.remarks).map(|remark| remark.text.clone()).collect()
    };
    assert!(!told(&both).iter().any(|text| text.contains("does not hold")), "{:?}", told(&both));
    let broken = of(", limits = none, inputs = none, lock(p = 0.3, q = 0.5)");
    assert!(
        told(&broken).iter().any(|text| text.contains("it asks for 0.25, and there is 0.3")),
        "{:?}",
        told(&broken)
    );
    let start = text.find("<tendon>").expect("tendons");
    let joined = "<equality><connect body1=\"a\" body2=\"c\" anchor=\"1 0 0\"/></equality></mujoco>";
    let file = Scratch::called(&(text[..start].to_owned() + joined), "xml");
    let of = |clauses: &str| read(&file.of(clauses, "")).unwrap_or_else(|error| panic!("{error}"));
    let one = of(", limits = none, lock(q = 0.3)");
    assert_eq!((names(&one), one.constraints.len()), (vec!["p".into(), "r".into()], 1));
    let both = of(", limits = none, lock(q = 0.3, r = 0)");
    assert_eq!((names(&both), both.constraints.len()), (vec!["p".into()], 0));
    assert!(told(&both).iter().any(|text| text.contains("`a` and `c` are held to each other")), "{:?}", told(&both));
    let start = text.find("<tendon>").expect("tendons");
    let balls = text[..start].replace("name=\"q\" axis=\"0 0 1\"", "name=\"q\" type=\"ball\"") + "</mujoco>";
    let file = Scratch::called(&balls, "xml");
    let found = read(&file.of(", limits = none, lock(q = 0)", "")).err().map(|error| error.to_string());
    let expected = "`q` is a rotation, and a lock is one number; make the joint of the file a fixed one";
    assert_eq!(found.as_deref(), Some(expected));
}
