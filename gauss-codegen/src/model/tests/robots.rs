//! Robots from files: what is read, what is refused and where, what is told.

mod drives;
mod ground;
mod locks;
#[cfg(feature = "mjcf")]
mod mjcf;
mod self_contact;

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

/// A chain whose link of every tenth joint starts anew at the base.
fn tree(links: usize) -> String {
    let part = |k: usize| {
        let parent = if k.is_multiple_of(10) { "base".to_owned() } else { format!("l{}", k - 1) };
        joint(&format!("j{k}"), "revolute", &parent, &format!("l{k}"), "<origin xyz=\"0 0.05 0.2\"/>")
            + &link(&format!("l{k}"))
    };
    robot(&(0..links).map(part).collect::<String>())
}

#[test]
fn a_hundred_links() {
    let read = model(&tree(100), "", "");
    assert_eq!((read.bodies.len(), read.coordinates.len(), read.item.inputs.len()), (101, 100, 100));
    let broken = tree(100).replace("child link=\"l57\"", "child link=\"l58\"");
    let found = mistakes(&broken, "", "");
    assert!(
        found[0].starts_with("119:1: the link `l58` hangs by the joint `j58` and by `j57` in line 117"),
        "{found:?}"
    );
}

fn remarks(text: &str, clauses: &str) -> Vec<(String, bool)> {
    let described = model(text, clauses, "").item.described.expect("a file");
    let place = format!("{}:", described.file);
    described.remarks.into_iter().map(|remark| (remark.text.replace(&place, ""), remark.ignored)).collect()
}

#[test]
fn joints_become_coordinates_inputs_and_bodies() {
    let text = arm("<origin xyz=\"0 0 1\"/><dynamics damping=\"0.1\"/>");
    let read = model(&text, "", "");
    let names: Vec<String> = read.coordinates.iter().map(|q| q.ident.to_string()).collect();
    assert_eq!(names, ["elbow"]);
    assert_eq!(read.item.inputs[0].ident, "elbow_effort");
    assert_eq!(read.item.inputs[0].unit.as_deref(), Some("N m"));
    assert_eq!(read.item.inputs[0].called, "elbow");
    let bodies: Vec<(String, bool)> =
        read.bodies.iter().map(|body| (body.name.as_ref().unwrap().to_string(), body.massless)).collect();
    assert_eq!(bodies, [("base".to_owned(), true), ("arm".to_owned(), false)]);
    assert_eq!(read.forces.len(), 2);
    assert!(model(&text, ", inputs = none", "").item.inputs.is_empty());
    assert!(model(&text, ", inputs = transmissions", "").item.inputs.is_empty());
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
    let inputs: Vec<String> = read.item.inputs.iter().map(|input| input.ident.to_string()).collect();
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
    assert_eq!((read.bodies.len(), read.item.inputs.len(), read.forces.len()), (3, 2, 3));
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
                "3:1: the dry friction of the joint `elbow` does not act; write `joint_friction = dry` for exact \
                 friction, which a `ContactRun` runs, `joint_friction = smooth(width)` for a law that is smooth over \
                 this width of its rate, or `joint_friction = none`",
                true
            ),
            told(
                "3:1: the limits of joints and tendons do not act; write `limits = range` for exact stops, which a \
                 `ContactRun` runs, `limits = stop(stiffness = …, width = …)` for stops that give way, or `limits = none`",
                true
            ),
        ]
    );
    for friction in ["smooth(0.01)", "dry", "none"] {
        let laws = format!(", joint_friction = {friction}, limits = stop(stiffness = 1e3, width = 0.01)");
        assert_eq!(remarks(&arm("<dynamics friction=\"0.2\"/><limit lower=\"-1\" upper=\"1\"/>"), &laws), []);
    }
    assert_eq!(
        remarks(&arm("<origin rpy=\"1.5708 0 0\"/>"), ""),
        [told(
            "3:96: the angle 1.5708 is taken as it is written, -3.7e-6 from a quarter turn; more digits would save \
             operations",
            false
        )]
    );
    let limited = arm("<limit effort=\"7\" velocity=\"2\" lower=\"0\" upper=\"0\"/>");
    let text = "3:1: the range -7 to 7 of `elbow` (`effort`) does not act; write `saturation = clamp` to cut off what is \
                beyond, or `saturation = none`";
    assert_eq!(remarks(&limited, ", limits = none")[0], told(text, true));
    for known in ["saturation = clamp", "saturation = none", "inputs = none"] {
        assert!(remarks(&limited, &format!(", limits = none, {known}")).iter().all(|(_, ignored)| !ignored), "{known}");
    }
    let blank = model(&robot(&(joint("left knee", "revolute", "base", "arm", "") + &link("arm"))), "", "");
    let (q, input) = (&blank.coordinates[0].ident, &blank.item.inputs[0]);
    assert_eq!((q.to_string(), input.called.to_string()), ("left_knee".to_owned(), "left_knee".to_owned()));
    assert_eq!(input.ident, "left_knee_effort");
    let named = robot(&(joint("arm", "revolute", "base", "arm", "") + &link("arm") + "<antenna/>"));
    assert_eq!(
        remarks(&named, ""),
        [told("4:1: the link `arm` is called `arm_link`", false), told("5:1: <antenna> is not read", true),]
    );
}

/// Limits as contacts: of a joint by its coordinate, of one that follows it by its own name.
#[test]
fn limits_become_ranges() {
    let follows = "<mimic joint=\"elbow\" multiplier=\"2\"/><limit lower=\"-1\" upper=\"3\"/>";
    let text = robot(
        &(joint("elbow", "revolute", "base", "arm", "<limit lower=\"-1\" upper=\"1\"/>")
            + &link("arm")
            + &joint("finger", "revolute", "arm", "hand", follows)
            + &link("hand")),
    );
    let names = |clauses: &str| -> Vec<String> {
        model(&text, clauses, "").contacts.iter().flat_map(|clause| &clause.names).map(ToString::to_string).collect()
    };
    assert_eq!(names(", limits = range"), ["elbow_from", "elbow_to", "finger_from", "finger_to"]);
    assert!(names(", limits = none").is_empty() && names("").is_empty());
    assert_eq!(remarks(&text, ", limits = range"), []);
    assert_eq!(
        mistakes(&text, ", limits = range, range(elbow, to = 0.5)", ""),
        ["two contacts are called `elbow_to`; rename one of the two"]
    );
    assert_eq!(
        mistakes(&text, ", limits = range(1.0)", ""),
        ["`range` takes nothing in brackets; write `limits = range`"]
    );
}

/// Every element and every attribute that is not read is named, once for all of a kind.
#[test]
fn what_is_not_read() {
    let told = |text: &str, ignored: bool| (text.to_owned(), ignored);
    let odd = "<origin xyz=\"0 0 1\" yaw=\"1\"/><dynamics damping=\"1\" backlash=\"2\"/>";
    let text = robot(
        &(joint("a", "revolute", "base", "one", odd)
            + &link("one")
            + "<gazebo/>\n<gazebo reference=\"one\"><spring/></gazebo>\n<gazebo/>\n"
            + "<link name=\"looks\"><visual/><visual/><collision/></link>"
            + &joint("b", "fixed", "one", "looks", "<mimic joint=\"a\"/>")),
    );
    let all = [
        told("3:112: the attribute `yaw` of <origin> is not read", true),
        told("3:143: the attribute `backlash` of <dynamics> is not read", true),
        told("5:1: <gazebo> does not act: what Gazebo adds is not read; likewise in lines 6, 7", true),
        told("8:20: not read, as it has no part in the motion, how many times: visual (2)", false),
        told(
            "8:38: shapes that touch nothing: 1; `ground(…)` lets them touch a plane, `self_contact(…)` each other",
            false,
        ),
    ];
    assert_eq!(remarks(&text, ""), all);
    let known = remarks(&text, ", ignore(gazebo, backlash)");
    assert_eq!(known.iter().map(|(_, ignored)| *ignored).collect::<Vec<_>>(), [true, false, false, false, false]);
    let many: String = (0..5)
        .map(|k| {
            let (parent, child) = (if k == 0 { "base".to_owned() } else { format!("l{}", k - 1) }, format!("l{k}"));
            joint(&format!("j{k}"), "revolute", &parent, &child, "<dynamics friction=\"0.2\"/>") + &link(&child)
        })
        .collect();
    let found = remarks(&robot(&many), "");
    assert_eq!(found.len(), 1);
    assert!(found[0].0.ends_with("or `joint_friction = none`; likewise in lines 5, 7, 9, 11"), "{found:?}");
    let planar = joint("p", "planar", "base", "one", "<dynamics damping=\"1\"/>") + &link("one");
    assert_eq!(
        remarks(&robot(&planar), ""),
        [told("3:1: damping and friction of <joint name=\"p\"> do not act: it has not one coordinate", true)]
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
                "4:1: the link `one` moves, and neither it nor what hangs on it has an <inertial>; add one, give \
                 its joint an `armature`, or fix it",
            ],
        ),
    ];
    for (rest, expected) in cases {
        assert_eq!(mistakes(&robot(&rest), "", ""), expected, "{rest}");
    }
}

#[test]
fn mistakes_of_inertias() {
    let with = |moments: &str| arm("").replace("ixx=\"1\" iyy=\"1\" izz=\"1\"", moments);
    let long = "ixx=\"1\" iyy=\"1\" izz=\"5\"";
    assert_eq!(
        mistakes(&with(long), "", ""),
        ["4:1: `arm`, with what is fixed to it, has an inertia that no body has: the principal moments are 1.000e0, \
          1.000e0, 5.000e0, and the largest is at most the sum of the others; mend it, or write \
          `waive(triangle_inequality = arm)`"]
    );
    model(&with(long), ", waive(triangle_inequality = arm)", "");
    model(&with(long), ", waive(triangle_inequality)", "");
    let negative = mistakes(&with("ixx=\"1\" iyy=\"1\" izz=\"1\" ixy=\"2\""), ", waive(triangle_inequality)", "");
    assert!(negative[0].ends_with("-1.000e0, 1.000e0, 3.000e0, and none is negative"), "{negative:?}");
    // What rounding left of a point, and a wheel of which one moment is stated.
    model(&with("ixx=\"-5e-20\" iyy=\"0\" izz=\"1e-20\""), "", "");
    model(&with("ixx=\"0\" iyy=\"0\" izz=\"1\""), "", "");
}

/// A joint that mimics a fixed one is where its offset says.
#[test]
fn followers_of_fixed_joints() {
    let text = robot(
        &(joint("wrist", "fixed", "base", "hand", "")
            + &link("hand")
            + &joint("finger", "revolute", "hand", "tip", "<mimic joint=\"wrist\" offset=\"0.5\"/>")
            + &link("tip")
            + &joint("elbow", "revolute", "tip", "arm", "")
            + &link("arm")),
    );
    let read = model(&text, "", "");
    assert_eq!(read.coordinates.len(), 1);
    let remarks = read.item.described.expect("a file").remarks;
    assert!(remarks[0].text.ends_with("the joint `finger` mimics `wrist`, which is fixed: it is held at its offset"));
}

#[test]
fn mistakes_of_elements() {
    let cases = [
        ("<robot><link name=\"a\"></robot>", vec!["1:23: this is no XML: expected 'link' tag, not 'robot'"]),
        ("<mujoco/>", vec!["1:1: <mujoco>: a URDF file is a <robot>"]),
        ("<robot/>", vec!["1:1: there are no links"]),
        (
            "<robot xmlns:xacro=\"http://www.ros.org/wiki/xacro\">\n<xacro:property name=\"a\"/></robot>",
            vec!["2:1: <xacro:property name=\"a\">: macros are not read; let `xacro` write the file without them"],
        ),
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
        mistakes(&robot(""), "", ""),
        ["2:1: nothing moves: no joint does, and the root `base` is held; write `base = floating`, or add a joint"]
    );
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
        (", joint_friction = smooth", "`smooth` is empty; write `joint_friction = smooth(0.01)`"),
        (", joint_friction = dry(0.1)", "`dry` takes nothing in brackets; write `joint_friction = dry`"),
        (", joint_friction = dyr", "unknown `joint_friction` `dyr`; did you mean `dry`?"),
        (
            ", joint_friction = lugre(1e5)",
            "unknown `joint_friction` `lugre`; friction with a state, as LuGre's and Dahl's, is written as \
             `states(bristle = …)` and `drive(x = …)`; LuGre's is the example of the guide's chapter `Elements with states`",
        ),
        (
            ", limits = stop(stiffness = 1.0)",
            "stops at limits need `width`; write `limits = stop(stiffness = 1e4, width = 0.01)`",
        ),
        (", base()", "`base(…)` says where the root is held; write `base(position = [0, 0, h])`"),
        (", base(place = [0, 0, 1])", "unknown argument of `base`: `place`; write `position`"),
        (", base = fixed, base(position = [0, 0, 1])", "`base` is given twice; keep one of the two"),
        (
            ", base(rotation = 1.0)",
            "expected a rotation, found a scalar; write `rotation_z(theta)`, or a product of such turns",
        ),
        (", reactions(elbw)", "no body, frame or joint is called `elbw`; did you mean the joint `elbow`?"),
        (
            ", reactions(wrist)",
            "no body, frame or joint is called `wrist`; expected a link (`base` or `arm`) or the joint that carries it \
             (`elbow`)",
        ),
        // What takes no joint does not list any.
        (", frames(wrist)", "no body or frame is called `wrist`; expected `base` or `arm`"),
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

/// Reactions are named by joints and by what they carry; fixed ones are cut, and only these keep their own mass data.
#[test]
fn reactions() {
    let fixed = joint("weld", "fixed", "arm", "hand", "") + &link("hand");
    let text = robot(&(joint("elbow", "revolute", "base", "arm", "") + &link("arm") + &fixed));
    let of = |clauses: &str| {
        let read = model(&text, clauses, "");
        let joints = read.item.wanted.reactions.iter();
        let joints: Vec<_> = joints.map(|joint| format!("{} {}", joint.name, joint.link)).collect();
        (joints, read.bodies.iter().map(|body| !body.massless).collect::<Vec<_>>())
    };
    assert_eq!(of(""), (Vec::new(), vec![false, true, false]));
    assert_eq!(of(", reactions(elbow)"), (vec!["elbow arm".to_owned()], vec![false, true, false]));
    let both = vec!["arm arm".to_owned(), "weld hand".to_owned()];
    assert_eq!(of(", reactions(arm, weld)"), (both, vec![false, true, true]));
    let twice = "`elbow` is named twice; keep one of the two";
    assert_eq!(mistakes(&text, ", reactions(elbow, elbow)", ""), [twice]);
    let same = "`arm` is a joint that is named before by another name; remove it";
    assert_eq!(mistakes(&text, ", reactions(elbow, arm)", ""), [same]);
    let other = joint("arm", "fixed", "arm", "hand", "") + &link("hand");
    let text = robot(&(joint("elbow", "revolute", "base", "arm", "") + &link("arm") + &other));
    let unclear = "`arm` is a link of the file and the joint that carries `hand`; name that link";
    assert_eq!(mistakes(&text, ", reactions(arm)", ""), [unclear]);
}

/// All names that the message tells are taken: of joints without an identifier those of their coordinates.
#[test]
fn names_of_reactions() {
    let named = joint("left-knee", "revolute", "base", "arm", "") + &link("arm");
    let planar = joint("sled", "planar", "arm", "hand", "") + &link("hand");
    let fixed = joint("weld", "fixed", "hand", "tool", "") + &link("tool");
    let text = robot(&(named + &planar + &fixed));
    let list = "no body, frame or joint is called `ankle`; expected a link (`base`, `arm`, `hand` or `tool`) or the joint \
                that carries it (`left_knee`, `sled` or `weld`)";
    assert_eq!(mistakes(&text, ", reactions(ankle)", ""), [list]);
    let read = model(&text, ", reactions(left_knee, sled, weld)", "");
    let links: Vec<_> = read.item.wanted.reactions.iter().map(|joint| joint.link.to_string()).collect();
    assert_eq!(links, ["arm", "hand", "tool"]);
    let numbered = joint("joint1", "revolute", "base", "arm", "") + &link("arm");
    let numbered = robot(&(numbered + &joint("joint2", "revolute", "arm", "hand", "") + &link("hand")));
    let nearest = "no body, frame or joint is called `joint9`; did you mean the joint `joint1` or `joint2`?";
    assert_eq!(mistakes(&numbered, ", reactions(joint9)", ""), [nearest]);
    // A link that only the struct has is taken, and a joint near to it is not suggested for it.
    let own = ", body(ankle, parent = hand, position = [0, 0, 1], mass = 1, inertia = 1), reactions(ankle)";
    assert_eq!(model(&text, own, "").item.wanted.reactions.len(), 1);
}

/// Prefixes that nothing declares, as Drake has them, and what stands before the root.
/// What is called so in the file keeps its name, and what is not is told of where it is asked for.
#[test]
fn names_that_several_have() {
    let hip = |name: &str, child: &str| joint(name, "revolute", "base", child, "") + &link(child);
    let text = robot(&(hip("left-hip", "a") + &hip("left_hip", "b") + &hip("arm", "arm") + &hip("k", "Ärm")));
    let read = model(&text, "", "");
    let coordinates = read.coordinates.iter().map(|q| q.ident.to_string()).collect::<Vec<_>>();
    assert_eq!(coordinates, ["left_hip_joint", "left_hip", "arm", "k"]);
    let found = mistakes(&text, ", frame(tool, parent = arm)", "");
    let called = "the link `arm` of the file is called `arm_link`";
    assert!(found.len() == 1 && found[0].ends_with(called), "{found:?}");
    let ball = "<collision><geometry><sphere radius=\"1\"/></geometry></collision></link>";
    let shaped = text.replace("izz=\"1\"/></inertial></link>", &format!("izz=\"1\"/></inertial>{ball}"));
    let found = mistakes(&shaped, ", ground(links = [arm])", "");
    assert!(found[0].contains("`arm`; this link of the file is called `arm_link`"), "{found:?}");
}

#[test]
fn prefixes() {
    let drake = "<drake:joint name=\"b\" type=\"ball\"><parent link=\"base\"/></drake:joint><transmission name=\"t\">\
                 <joint name=\"elbow\"/><actuator name=\"m\"><drake:rotor_inertia value=\"0.5\"/></actuator></transmission>";
    let text = arm("<drake:screw_thread_pitch value=\"1\"/>").replace("</robot>", &format!("{drake}</robot>"));
    let text = format!("<!-- a\n b --><?xml version=\"1.0\"?>{text}");
    let read = model(&text, "", "");
    assert_eq!((read.coordinates.len(), read.armatures.len()), (1, 1));
    let told = remarks(&text, "");
    assert!(told[0].0.starts_with("4:") && told[0].0.contains("<drake:screw_thread_pitch> is not read; likewise"));
    assert!(told[0].1 && remarks(&text, ", ignore(drake)").iter().all(|(_, ignored)| !ignored));
    // Columns are those of the file, also in the line of the root.
    let line = "<robot name=\"r\"><link/><a:b/></robot>";
    assert_eq!(mistakes(line, "", "")[0], "1:17: <link>: the attribute `name` is missing");
    let macros = mistakes("<robot><xacro:arm/></robot>", "", "");
    assert_eq!(macros[0], "1:8: <xacro:arm>: macros are not read; let `xacro` write the file without them");
}
