//! Robots from files: what is read, what is refused and where, what is told.

use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::read;
use crate::model::{CoordinateKind, Model};

/// A file that lives as long as a test.
struct Scratch(PathBuf);

impl Scratch {
    fn new(text: &str) -> Self {
        Self::called(text, "urdf")
    }

    fn called(text: &str, end: &str) -> Self {
        static NEXT: AtomicUsize = AtomicUsize::new(0);
        let name = format!("gauss-{}-{}.{end}", std::process::id(), NEXT.fetch_add(1, Ordering::Relaxed));
        let path = std::env::temp_dir().join(name);
        std::fs::write(&path, text).expect("a folder for files that do not stay");
        Self(path)
    }

    /// The struct, with further clauses and fields.
    fn of(&self, clauses: &str, fields: &str) -> String {
        let fields = if fields.is_empty() { ";".to_owned() } else { format!("{{ {fields} }}") };
        let word = if self.0.extension().is_some_and(|end| end == "xml") { "mjcf" } else { "urdf" };
        format!("#[gauss({word} = {:?} {clauses})] struct Robot {fields}", self.0)
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        // What is left behind in the folder for it harms nobody.
        let _ = std::fs::remove_file(&self.0);
    }
}

/// One link, and whatever else.
fn robot(rest: &str) -> String {
    format!("<robot name=\"r\">\n<link name=\"base\"/>\n{rest}\n</robot>")
}

fn link(name: &str) -> String {
    format!(
        "<link name=\"{name}\"><inertial><mass value=\"2\"/>\
         <inertia ixx=\"1\" iyy=\"1\" izz=\"1\"/></inertial></link>\n"
    )
}

fn joint(name: &str, kind: &str, parent: &str, child: &str, inside: &str) -> String {
    format!(
        "<joint name=\"{name}\" type=\"{kind}\"><parent link=\"{parent}\"/><child link=\"{child}\"/>\
         <axis xyz=\"0 0 1\"/>{inside}</joint>\n"
    )
}

/// An arm of one link.
fn arm(inside: &str) -> String {
    robot(&(joint("elbow", "revolute", "base", "arm", inside) + &link("arm")))
}

fn model(text: &str, clauses: &str, fields: &str) -> Model {
    let file = Scratch::new(text);
    read(&file.of(clauses, fields)).unwrap_or_else(|error| panic!("{text}: {error}"))
}

/// All mistakes, without the path of the file.
fn mistakes(text: &str, clauses: &str, fields: &str) -> Vec<String> {
    let file = Scratch::new(text);
    let path = file.0.to_string_lossy().into_owned();
    let Err(error) = read(&file.of(clauses, fields)) else { panic!("accepted: {text}") };
    error.into_iter().map(|mistake| mistake.to_string().replace(&format!("{path}:"), "")).collect()
}

fn remarks(text: &str, clauses: &str) -> Vec<(String, bool)> {
    let described = model(text, clauses, "").described.expect("a file");
    let place = format!("{}:", described.file);
    described.remarks.into_iter().map(|remark| (remark.text.replace(&place, ""), remark.ignored)).collect()
}

#[test]
fn joints_become_coordinates_inputs_and_bodies() {
    let text = arm("<origin xyz=\"0 0 1\"/><dynamics damping=\"0.1\"/>");
    let read = model(&text, "", "");
    let names: Vec<String> = read.coordinates.iter().map(|q| q.ident.to_string()).collect();
    assert_eq!(names, ["elbow"]);
    assert_eq!(read.inputs[0].ident, "elbow_effort");
    assert_eq!(read.inputs[0].unit.as_deref(), Some("N m"));
    let bodies: Vec<(String, bool)> =
        read.bodies.iter().map(|body| (body.name.as_ref().unwrap().to_string(), body.massless)).collect();
    assert_eq!(bodies, [("base".to_owned(), true), ("arm".to_owned(), false)]);
    assert_eq!(read.forces.len(), 2);
    assert!(model(&text, ", inputs = none", "").inputs.is_empty());
    assert!(model(&text, ", inputs = transmissions", "").inputs.is_empty());
}

#[test]
fn every_kind_of_joint() {
    let joints = ["continuous", "prismatic", "planar", "floating", "fixed"];
    let parts: String = joints
        .iter()
        .map(|kind| joint(kind, kind, "base", &format!("l_{kind}"), "") + &link(&format!("l_{kind}")))
        .collect();
    let read = model(&robot(&parts), "", "");
    let names: Vec<String> = read.coordinates.iter().map(|q| q.ident.to_string()).collect();
    assert_eq!(names, ["continuous", "prismatic", "planar_x", "planar_y", "planar_theta", "floating"]);
    assert_eq!(read.coordinates[5].kind, CoordinateKind::Pose);
    let inputs: Vec<String> = read.inputs.iter().map(|input| input.ident.to_string()).collect();
    assert_eq!(inputs, ["continuous_effort", "prismatic_effort"]);
    // What is fixed to a root that is held has no mass that matters.
    assert!(read.bodies.last().is_some_and(|body| body.massless));
    let free = model(&robot(&parts), ", base = floating", "");
    assert_eq!(free.coordinates[0].ident, "base");
    // The name of the pose is taken, so the link has another.
    assert_eq!(free.bodies[0].name.as_ref().unwrap(), "base_link");
    assert!(!free.bodies[0].massless);
}

#[test]
fn clauses_of_the_struct_come_after_those_of_the_file() {
    let text = arm("");
    let clauses = ", coordinates(slider), body(block, position = [slider, 0, 0], mass = 1.0, inertia = 1.0), \
     input(push), \
         spring(from = arm.position, to = block.position, stiffness = k), drive(slider = push), limit = 9000";
    let read = model(&text, clauses, "k: f64");
    let names: Vec<String> = read.coordinates.iter().map(|q| q.ident.to_string()).collect();
    assert_eq!(names, ["elbow", "slider"]);
    assert_eq!((read.bodies.len(), read.inputs.len(), read.forces.len()), (3, 2, 3));
    let own =
        ", coordinates(slider), speeds(v), kinematics(slider = v), particle(mass = 1.0, position = [slider, 0, 0])";
    let read = model(&text, own, "");
    let speeds: Vec<String> = read.speeds.unwrap().iter().map(|z| z.ident.to_string()).collect();
    assert_eq!(speeds, ["elbow_dot", "v"]);
}

#[test]
fn mass_data_from_fields() {
    let text = arm("");
    assert_eq!(model(&text, "", "#[gauss(body)] arm: RigidBody<f64>").bodies[1].role_clauses.len(), 0);
    assert_eq!(
        mistakes(&text, ", parameters = inertial", ""),
        ["with `parameters = inertial` the mass data of links are fields with their names; add `#[gauss(body)] \
             arm: RigidBody<f64>`"]
    );
}

#[test]
fn what_is_told() {
    let told = |text: &str, ignored: bool| (text.to_owned(), ignored);
    assert_eq!(
        remarks(&arm("<dynamics friction=\"0.2\"/><limit lower=\"-1\" upper=\"1\"/>"), ""),
        [
            told(
                "3:1: the dry friction of the joint `elbow` does not act; write `joint_friction = smooth(width)` for a \
                 law that is \
                 smooth over this width of its rate, or `joint_friction = none`",
                true
            ),
            told(
                "3:1: the limits of joints do not act; `limits = stop(stiffness = …, width = …)` makes stops of them",
                false
            ),
        ]
    );
    let laws = ", joint_friction = smooth(0.01), limits = stop(stiffness = 1e3, width = 0.01)";
    assert_eq!(remarks(&arm("<dynamics friction=\"0.2\"/><limit lower=\"-1\" upper=\"1\"/>"), laws), []);
    assert_eq!(
        remarks(&arm("<origin rpy=\"1.5708 0 0\"/>"), ""),
        [told(
            "3:96: the angle 1.5708 is taken as it is written, -3.7e-6 from a quarter turn; more digits would save \
             operations",
            false
        )]
    );
    let named = robot(&(joint("arm", "revolute", "base", "arm", "") + &link("arm") + "<antenna/>"));
    assert_eq!(
        remarks(&named, ""),
        [told("4:1: the link `arm` is called `arm_link`", false), told("5:1: <antenna> is not read", true),]
    );
}

#[test]
fn mistakes_of_structure() {
    let cases = [
        (
            joint("a", "revolute", "base", "arn", "") + &link("arm"),
            vec!["3:1: the joint `a` joins `arn`, which is no link; did you mean `arm`?"],
        ),
        (
            joint("a", "revolute", "one", "two", "")
                + &joint("b", "revolute", "two", "one", "")
                + &link("one")
                + &link("two"),
            vec!["5:1: links hang on each other in a circle: `two` on `one`"],
        ),
        (link("one"), vec!["3:1: the link `one` hangs on nothing, and so does `base` in line 2; join the two"]),
        (
            joint("a", "revolute", "base", "one", "") + &joint("b", "fixed", "base", "one", "") + &link("one"),
            vec![
                "4:1: the link `one` hangs by the joint `b` and by `a` in line 3; in a file each has one parent: \
                 remove one, \
                 and write the other as a `constraint(…)` of the struct",
            ],
        ),
        (
            joint("a", "revolute", "base", "one", "")
                + &joint("a", "fixed", "base", "two", "")
                + &link("one")
                + &link("one"),
            vec![
                "6:1: a second link is called `one`, the first is in line 5; rename one",
                "4:1: a second joint is called `a`, the first is in line 3; rename one",
                "4:1: the joint `a` joins `two`, which is no link of this file",
            ],
        ),
        (
            joint("a", "revolute", "base", "one", "<mimic joint=\"c\"/>") + &link("one"),
            vec!["3:92: the joint `a` mimics `c`, which is no joint of this file"],
        ),
        (
            joint("a", "revolute", "base", "one", "") + "<link name=\"one\"/>",
            vec![
                "4:1: the link `one` moves, and neither it nor what hangs on it has an <inertial>; add one, or fix \
                 its joint",
            ],
        ),
    ];
    for (rest, expected) in cases {
        assert_eq!(mistakes(&robot(&rest), "", ""), expected, "{rest}");
    }
}

#[test]
fn mistakes_of_elements() {
    let cases = [
        ("<robot><link name=\"a\"></robot>", vec!["1:23: this is no XML: expected 'link' tag, not 'robot'"]),
        ("<mujoco/>", vec!["1:1: <mujoco>: a URDF file is a <robot>"]),
        ("<robot/>", vec!["1:1: there are no links"]),
        (
            "<robot>\n<link/>\n<link name=\"a\"><inertial><mass value=\"x\"/></inertial></link></robot>",
            vec![
                "2:1: <link>: the attribute `name` is missing",
                "3:39: <mass>: `value` is one number, found `x`",
                "3:16: <inertial>: <inertia ixx=\"…\" …/> is missing",
            ],
        ),
        (
            "<robot><joint name=\"j\" type=\"hinge\"><parent link=\"a\"/><origin xyz=\"0 0\"/></joint></robot>",
            vec![
                "1:8: <joint name=\"j\">: a joint is revolute, continuous, prismatic, fixed, floating or planar, \
                 found `hinge`",
                "1:8: <joint name=\"j\">: <child link=\"…\"/> is missing",
                "1:68: <origin>: `xyz` is 3 numbers, found `0 0`",
            ],
        ),
    ];
    for (text, expected) in cases {
        assert_eq!(mistakes(text, "", ""), expected, "{text}");
    }
    let zero = arm("").replace("0 0 1", "0 0 0");
    assert_eq!(
        mistakes(&zero, "", ""),
        ["3:77: <axis>: the axis of <joint name=\"elbow\"> is zero and has no direction"]
    );
}

#[test]
fn mistakes_of_clauses() {
    let text = arm("");
    let cases = [
        (", base = flaoting", "unknown `base` `flaoting`; did you mean `floating`?"),
        (", bsae = fixed", "unknown clause `bsae`; did you mean `base`?"),
        (", joint_friction = smooth", "`smooth` says nothing; write `joint_friction = smooth(0.01)`"),
        (
            ", limits = stop(stiffness = 1.0)",
            "stops at limits need `width`; write `limits = stop(stiffness = 1e4, width = 0.01)`",
        ),
        (", coordinates(elbow)", "the coordinate `elbow` is declared twice; remove one of the two"),
        (
            ", drive(elbw = 1.0)",
            "`elbw` is no coordinate, and a drive acts on rates of scalar coordinates; did you mean `elbow`?",
        ),
    ];
    for (clauses, expected) in cases {
        assert_eq!(mistakes(&text, clauses, ""), [expected], "{clauses}");
    }
    let error = read("#[gauss(urdf = \"no/such.urdf\")] struct Robot;").map(|_| ()).expect_err("there is no such file");
    assert!(error.to_string().starts_with("cannot read `"), "{error}");
    let error = read("#[gauss(urdf = arm)] struct Robot;").map(|_| ()).expect_err("no string");
    assert!(error.to_string().starts_with("`urdf` is the path of a file from the folder of the package"), "{error}");
    let error = read("#[gauss(base = fixed)] struct Robot { m: f64 }").map(|_| ()).expect_err("no file");
    assert!(error.to_string().starts_with("unknown clause `base`"), "{error}");
}

#[cfg(feature = "mjcf")]
mod mjcf {
    use super::{Scratch, read};

    const INERTIAL: &str = "<inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\"1 1 1\"/>";

    /// What is reported of a file with this inside its body: mistakes, or remarks.
    fn reported(inside: &str, clauses: &str) -> Vec<String> {
        let text = format!("<mujoco>\n<worldbody><body name=\"arm\">{INERTIAL}\n{inside}\n</mujoco>");
        let file = Scratch::called(&text, "xml");
        let place = format!("{}:", file.0.to_string_lossy());
        let texts: Vec<String> = match read(&file.of(clauses, "")) {
            Ok(model) => model.described.expect("a file").remarks.into_iter().map(|remark| remark.text).collect(),
            Err(error) => error.into_iter().map(|mistake| mistake.to_string()).collect(),
        };
        texts.into_iter().map(|text| text.replace(&place, "")).collect()
    }

    #[test]
    fn what_is_told_and_refused() {
        let hinge = "<joint name=\"hinge\"/></body></worldbody>";
        let cases = [
            (hinge.to_owned(), "", None),
            (format!("{hinge}<tendon/>"), "", Some("3:41: <tendon> is not read")),
            (
                format!("{hinge}<actuator><position joint=\"hinge\"/></actuator>"),
                "",
                Some("3:51: the input of <position> is the effort of its joint: gains and gears are left to it"),
            ),
            (
                format!("{hinge}<actuator><motor joint=\"hing\"/></actuator>"),
                "",
                Some("1:1: a transmission or an actuator drives `hing`, which is no joint; did you mean `hinge`?"),
            ),
            (
                "<joint type=\"hing\"/></body></worldbody>".to_owned(),
                "",
                Some("3:1: <joint>: a joint is free, ball, slide or hinge, found `hing`"),
            ),
            (
                "<joint axis=\"0 0 0\"/></body></worldbody>".to_owned(),
                "",
                Some("3:1: <joint>: its axis is zero and has no direction"),
            ),
            (
                "<freejoint/></body></worldbody>".to_owned(),
                ", base = floating",
                Some("an MJCF file says by <freejoint/> what moves freely; remove `base`"),
            ),
            (
                format!("{hinge}<equality><weld body1=\"arm\"/></equality>"),
                "",
                Some("3:51: the equality <weld> does not act"),
            ),
            (
                "<joint/><body><geom/><joint/></body></body></worldbody>".to_owned(),
                "",
                Some(
                    "3:9: the link `body_2` moves, and neither it nor what hangs on it has an <inertial>; add one, \
                     or fix its joint",
                ),
            ),
        ];
        for (inside, clauses, expected) in cases {
            assert_eq!(reported(&inside, clauses), expected.into_iter().collect::<Vec<_>>(), "{inside}");
        }
    }
}
