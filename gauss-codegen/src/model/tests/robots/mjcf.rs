//! MJCF: what is read, what is told, what is refused.

use super::{Scratch, read};
use crate::model::argument::{AT, FORCE, TORQUE, VALUE};
use crate::model::scene::clauses::{RoleClause, RoleValue};
use crate::model::tests::systems::{show, shown};
use crate::model::{ConstraintLevel, ElementKind, ForceClause, Model};
use crate::terms::{Role, ValueOfState};

const INERTIAL: &str = "<inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\"1 1 1\"/>";

/// Reports of a file with this inside its body: mistakes, or remarks.
fn reported(inside: &str, clauses: &str) -> Vec<String> {
    let text = format!("<mujoco>\n<worldbody><body name=\"arm\">{INERTIAL}\n{inside}\n</mujoco>");
    let file = Scratch::called(&text, "xml");
    let place = format!("{}:", file.0.to_string_lossy());
    let texts: Vec<String> = match read(&file.of(clauses, "")) {
        Ok(model) => model.item.described.expect("a file").remarks.into_iter().map(|remark| remark.text).collect(),
        Err(error) => error.into_iter().map(|mistake| mistake.to_string()).collect(),
    };
    texts.into_iter().map(|text| text.replace(&place, "")).collect()
}

#[test]
fn what_is_told_and_refused() {
    let hinge = "<joint name=\"hinge\"/></body></worldbody>";
    let cases = [
        (hinge.to_owned(), "", None),
        (
            "<joint class=\"knes\"/></body></worldbody><default><default class=\"knee\"/></default>".to_owned(),
            "",
            Some("3:1: <joint>: its `class` is `knes`, which is no class; did you mean `knee`?"),
        ),
        (
            "</body><body childclass=\"leg\"/></worldbody>".to_owned(),
            "",
            Some("3:8: <body>: its `childclass` is `leg`, which is no class of this file"),
        ),
        (format!("{hinge}<deformable/>"), "", Some("3:41: <deformable> does not act: what bends is not modelled")),
        (
            format!("{hinge}<contact><pair geom1=\"a\" geom2=\"a\"/></contact>"),
            "",
            Some("3:50: <pair>: it is about `a`, which is no geom of this file"),
        ),
        (format!("{hinge}<tendon><spatial name=\"s\"/></tendon>"), "", None),
        (
            format!("{hinge}<tendon><spatial name=\"s\"><geom geom=\"g\"/></spatial></tendon>"),
            "",
            Some(
                "3:49: <spatial name=\"s\"> does not act: it wraps around a geom; through sites alone tendons are read",
            ),
        ),
        (
            format!("{hinge}<tendon><spatial><site site=\"s\"/></spatial></tendon>"),
            "",
            Some("3:58: <site>: it runs through `s`, which is no site of this file"),
        ),
        (
            "<joint/><body><freejoint/></body></body></worldbody>".to_owned(),
            "",
            Some("3:15: <freejoint>: a body that moves freely hangs in the world, not on another body"),
        ),
        (
            "<site name=\"arm\"/><joint type=\"ball\" frictionloss=\"1\"/></body></worldbody>".to_owned(),
            "",
            Some("3:19: `frictionloss` of <joint> does not act: it has not one coordinate"),
        ),
        (
            format!("{hinge}<actuator><position joint=\"hinge\"/></actuator>"),
            "",
            Some(
                "3:51: the input of `hinge` is the effort of its joint: gears and gains are left to it; \
                 `inputs = actuators` has them",
            ),
        ),
        (
            format!("{hinge}<actuator><motor joint=\"hing\"/></actuator>"),
            "",
            Some("3:51: `hing` drives `hing`, which is no joint; did you mean `hinge`?"),
        ),
        (
            format!("<site name=\"a\"/>{hinge}<actuator><motor site=\"b\"/></actuator>"),
            "",
            Some("3:67: <motor>: it acts at `b`, which is no site; did you mean `a`?"),
        ),
        (
            format!("<site name=\"a\"/>{hinge}<actuator><motor site=\"a\" refsite=\"a\"/></actuator>"),
            "",
            Some("3:67: <motor> does not act: a `refsite` is not read; of sites alone the wrench at `site` is"),
        ),
        (
            format!("{hinge}<actuator><motor joint=\"hinge\"/></actuator><keyframe><key ctrl=\"1 2\"/></keyframe>"),
            "",
            Some("3:94: <key>: `ctrl` is 1 numbers in this file, found 2"),
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
            Some("in an MJCF file <freejoint/> marks bodies that move freely; remove `base`"),
        ),
        (
            "<freejoint/></body></worldbody>".to_owned(),
            ", base(position = [0, 0, 1])",
            Some(
                "`base(…)` moves what the file holds, and `arm_joint` moves freely: it is placed by its pose; remove \
                 `base(…)`",
            ),
        ),
        (
            format!("{hinge}<equality><weld site1=\"arm\"/></equality>"),
            "",
            Some("3:51: <weld> does not act: it joins no two bodies or joints"),
        ),
        (
            "<joint/><body><geom type=\"mesh\"/><joint/></body></body></worldbody>".to_owned(),
            "",
            Some(
                "3:9: the link `body_2` moves, and neither it nor what hangs on it has an <inertial>; add one, \
                 give its joint an `armature`, or fix it (the mass of \
                 <geom> is not read: a <geom> of type `mesh` needs its mesh or sizes)",
            ),
        ),
    ];
    for (inside, clauses, expected) in cases {
        assert_eq!(reported(&inside, clauses), expected.into_iter().collect::<Vec<_>>(), "{inside}");
    }
}

/// A mass that is not read is told of the link that has it, where it has a part in the motion: not of what is fixed to
/// the world, nor of what has an <inertial>, nor of a link whose mass data are a field.
#[test]
fn masses_that_are_not_read_are_told_where_they_matter() {
    let geom = "<geom type=\"mesh\"/>";
    let moving = |name: &str, inside: &str| format!("<body name=\"{name}\">{inside}</body>");
    let all = format!(
        "<joint/>{}</body>{}{}</worldbody>",
        moving("a", &format!("<joint/>{geom}")),
        moving("b", &format!("<joint/>{geom}")),
        moving("c", &format!("{geom}{}", moving("d", &format!("<joint/>{INERTIAL}{geom}"))))
    );
    let message = |link: &str, column: usize| {
        format!(
            "3:{column}: the link `{link}` moves, and neither it nor what hangs on it has an <inertial>; add one, give \
             its joint an `armature`, or fix it (the mass of <geom> is not read: a <geom> of type `mesh` needs its mesh \
             or sizes)"
        )
    };
    assert_eq!(reported(&all, ""), [message("a", 9), message("b", 65)]);

    let sphere = "<geom size=\"1\"/>";
    let told = |inside: &str, field: &str| {
        let text = format!("<mujoco>\n<worldbody><body name=\"arm\">{INERTIAL}\n{inside}\n</mujoco>");
        let model =
            read(&Scratch::called(&text, "xml").of("", field)).unwrap_or_else(|error| panic!("{text}: {error}"));
        let remarks = model.item.described.expect("a file").remarks.into_iter();
        remarks.filter(|remark| remark.ignored && remark.text.contains("is not read")).count()
    };
    let of = |parts: &str| format!("<joint/></body>{parts}</worldbody>");
    assert_eq!(told(&of(&moving("a", &format!("<joint/>{sphere}{geom}"))), ""), 1);
    assert_eq!(told(&of(&moving("a", &format!("<joint/>{geom}"))), "#[gauss(body)] a: RigidBody<f64>"), 0);
    assert_eq!(told(&of(&moving("a", &format!("<joint/>{INERTIAL}{geom}"))), ""), 0);
    assert_eq!(told(&of(&moving("a", geom)), ""), 0);
    assert_eq!(told(&of(&moving("a", &format!("{geom}{}", moving("b", &format!("<joint/>{sphere}"))))), ""), 0);
}

fn model(inside: &str, clauses: &str) -> Model {
    let text = format!("<mujoco>\n<worldbody><body name=\"arm\">{INERTIAL}\n{inside}\n</mujoco>");
    read(&Scratch::called(&text, "xml").of(clauses, "")).unwrap_or_else(|error| panic!("{text}: {error}"))
}

const TWO: &str = "<joint name=\"a\"/><joint name=\"b\" type=\"slide\"/></body></worldbody>";

/// A tendon is a spring along a sum; actuators act along joints and tendons, with gains and biases.
#[test]
fn tendons_and_actuators() {
    let rest = format!(
        "{TWO}<tendon><fixed name=\"t\" stiffness=\"2\"><joint joint=\"a\" coef=\"1\"/><joint joint=\"b\" coef=\"-3\"/>\
         </fixed></tendon><actuator><position name=\"p\" tendon=\"t\" kp=\"5\"/><motor joint=\"b\" gear=\"7\"/>\
         <general name=\"m\" joint=\"a\" dyntype=\"integrator\"/></actuator>"
    );
    let read = model(&rest, ", inputs = actuators");
    let inputs: Vec<String> = read.item.inputs.iter().map(|input| input.ident.to_string()).collect();
    assert_eq!(inputs, ["p", "b_control"]);
    assert_eq!(read.forces[0].rates().map(|(q, _)| q.to_string()).collect::<Vec<_>>(), ["a", "b"]);
    assert!(read.forces.iter().any(|force| force.row.kind == ElementKind::Spring));
    let ignored: Vec<String> = read
        .item
        .described
        .unwrap()
        .remarks
        .into_iter()
        .filter(|remark| remark.ignored)
        .map(|remark| remark.text)
        .collect();
    assert!(ignored[0].ends_with("it is not linear in its control, or has a state of its own"), "{ignored:?}");
    assert_eq!(ignored.len(), 1);
    assert_eq!(model(&rest, "").item.inputs.len(), 2);
}

#[test]
fn equalities() {
    let linear = model(&format!("{TWO}<equality><joint joint1=\"a\" joint2=\"b\"/></equality>"), "");
    assert_eq!((linear.coordinates.len(), linear.constraints.len()), (1, 0));
    let squared = "<equality><joint joint1=\"a\" joint2=\"b\" polycoef=\"0 1 2 3 4 5\"/></equality>";
    assert_eq!(reported(&format!("{TWO}{squared}"), ""), ["3:116: <joint>: `polycoef` is five numbers at most"]);
    let squared = squared.replace("0 1 2 3 4 5", "0 1 2");
    let curved = model(&format!("{TWO}{squared}"), "");
    assert_eq!((curved.coordinates.len(), curved.constraints.len()), (2, 1));
    let held = model(&format!("{TWO}<equality><joint joint1=\"a\"/></equality>"), "");
    assert_eq!(held.constraints.len(), 1);
    let tendon =
        "<tendon><fixed name=\"t\"><joint joint=\"a\" coef=\"2\"/><joint joint=\"b\" coef=\"-1\"/></fixed></tendon>";
    let tied = model(&format!("{TWO}{tendon}<equality><tendon tendon1=\"t\"/></equality>"), "");
    assert_eq!((tied.coordinates.len(), tied.constraints.len()), (2, 1));
    assert_eq!(show(&tied.constraints[0].expression), "(Subtract (Add (Multiply 2 a) (Multiply (-1) b)) 0)");
    let strange = format!("{TWO}{tendon}<equality><tendon name=\"e\" tendon1=\"u\"/></equality>");
    let found = reported(&strange, "");
    assert!(
        found[0].ends_with("<tendon name=\"e\"> does not act: it ties tendons that are not linear in joints"),
        "{found:?}"
    );
    let welded = model(&format!("{TWO}<equality><weld body1=\"arm\"/></equality>"), "");
    assert_eq!(welded.constraints.len(), 4);
    assert!(welded.constraints.iter().all(|constraint| constraint.kind == ConstraintLevel::Position));
}

/// Numbers of a file are in units of the SI: its polynomials of metres are sums whose terms have one unit.
#[test]
fn numbers_of_files_have_units() {
    let text = format!(
        "<mujoco>\n<worldbody><body name=\"arm\">{INERTIAL}<joint name=\"a\" type=\"slide\" stiffness=\"10 4\"/>\
         <joint name=\"b\" type=\"slide\" axis=\"0 1 0\"/></body></worldbody>\
         <equality><joint joint1=\"b\" joint2=\"a\" polycoef=\"0 1 2\"/></equality></mujoco>"
    );
    let file = Scratch::called(&text, "xml");
    let load = "#[gauss(unit = \"kg\")] load: f64";
    let loaded = |more: &str| {
        read(&file.of(&format!(", particle(mass = load, parent = arm, position = [0, 0, 0]){more}"), load))
    };
    let model = loaded("").unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(model.constraints.len(), 1);
    // Those of the struct are checked as ever.
    let mistakes = loaded(", drive(a = load + 2 * load * load)").err().expect("a sum of kg and of kg²");
    assert_eq!(mistakes.into_iter().count(), 1);
}

/// The place of a free body, references of joints, and keyframes.
#[test]
fn states_with_names() {
    let states = |inside: &str| model(inside, "").item.described.unwrap().states;
    assert!(states(TWO).is_empty());
    let rest = TWO.replace("name=\"a\"", "name=\"a\" ref=\"90\"");
    let keys = "<keyframe><key name=\"home pose\" qpos=\"0.1 0.2\" qvel=\"3 4\"/><key qpos=\"5 6\"/></keyframe>";
    let found = states(&format!("{rest}{keys}"));
    let names: Vec<String> = found.iter().map(|state| state.name.to_string()).collect();
    assert_eq!(names, ["start", "home_pose", "key_1"]);
    let values = |index: usize| -> Vec<(String, f64)> {
        let scalar = |value: &ValueOfState| if let ValueOfState::Scalar(value) = value { *value } else { f64::NAN };
        found[index].values.iter().map(|(name, value)| (name.to_string(), scalar(value))).collect()
    };
    assert_eq!(values(0), [("a".to_owned(), std::f64::consts::FRAC_PI_2), ("b".to_owned(), 0.0)]);
    let home = [("a", 0.1), ("a_dot", 3.0), ("b", 0.2), ("b_dot", 4.0)];
    assert_eq!(values(1), home.map(|(name, value)| (name.to_owned(), value)));
    // What says nothing of places has those of the file, as MuJoCo's `qpos0`.
    let found = states(&format!("{rest}<keyframe><key qvel=\"3 4\"/><key qpos=\"\"/></keyframe>"));
    let all = |index: usize| found[index].values.iter().filter(|(name, _)| name == "a").map(|(_, value)| *value);
    for index in [0, 1, 2] {
        let places: Vec<ValueOfState> = all(index).collect();
        assert!(matches!(places[..], [ValueOfState::Scalar(std::f64::consts::FRAC_PI_2)]), "{index}");
    }
    // A quaternion of no length is none.
    let ball = "<joint name=\"a\" type=\"ball\"/></body></worldbody><keyframe><key qpos=\"0 0 0 0\"/></keyframe>";
    assert!(matches!(states(ball)[0].values[0].1, ValueOfState::Rotation([1.0, 0.0, 0.0, 0.0])));
    let short = format!("{TWO}<keyframe><key qpos=\"1\"/></keyframe>");
    assert_eq!(reported(&short, ""), ["3:77: <key>: `qpos` is 2 numbers in this file, found 1"]);
}

/// Bodies without `<inertial>` weigh what their geoms do; frames place what is in them.
#[test]
fn masses_of_geoms() {
    let inside = "<frame pos=\"0 0 1\"><body name=\"ball\"><joint/><geom size=\"0.1\" density=\"500\"/>\
                  <geom type=\"box\" size=\"1 1 1\" mass=\"2\"/></body></frame></body></worldbody>";
    let read = model(inside, "");
    let ball = read.bodies.iter().find(|body| body.name.as_ref().is_some_and(|name| name == "ball")).unwrap();
    assert!(!ball.massless && ball.position.is_some());
    let mass = |inside: &str| {
        let read = model(&format!("</body><body name=\"ball\"><joint/>{inside}</body></worldbody>"), "");
        let ball = read.bodies.iter().find(|body| body.name.as_ref().is_some_and(|name| name == "ball")).unwrap();
        let clause = ball.role_clauses.iter().find(|clause| clause.role == Role::Mass).unwrap();
        let RoleValue::Expression(value) = &clause.value else { panic!("no number") };
        value.literal().unwrap()
    };
    let geom = "<geom size=\"1\" mass=\"2\"/>";
    assert_eq!(mass(&format!("{geom}<frame pos=\"1 0 0\">{geom}<frame>{geom}</frame></frame>")), 6.0);
    assert_eq!(mass(&format!("{geom}<replicate count=\"3\">{geom}</replicate>")), 8.0);
}

/// `settotalmass` scales all masses, and inertias with them; zero and less do not.
#[test]
fn masses_are_scaled_to_their_total() {
    let masses = |total: &str| -> Vec<f64> {
        let heavy = INERTIAL.replace("mass=\"1\"", "mass=\"3\"");
        let arms = format!("<joint name=\"a\"/><body>{heavy}<joint name=\"b\"/></body></body></worldbody>");
        let read = model(&format!("{arms}<compiler settotalmass=\"{total}\"/>"), "");
        let roles = read.bodies.iter().flat_map(|body| &body.role_clauses);
        let value = |clause: &RoleClause| match &clause.value {
            RoleValue::Expression(value) => value.literal().expect("a number"),
            _ => f64::NAN,
        };
        roles.filter(|clause| clause.role == Role::Mass).map(value).collect()
    };
    assert_eq!(masses("-1"), [1.0, 3.0]);
    assert_eq!(masses("8"), [2.0, 6.0]);
}

/// A wrench at a site by each of its actuators, which have controls of their own whatever inputs are asked for, and
/// keyframes with these.
#[test]
fn actuators_at_sites() {
    let inside = "<joint name=\"a\"/><site name=\"s\"/><site name=\"arm\" pos=\"0 0 1\"/></body></worldbody>\
                  <actuator><motor name=\"lift\" site=\"s\" gear=\"0 0 3 0 0 -0.1\"/><motor joint=\"a\"/>\
                  <velocity site=\"arm\" kv=\"2\"/></actuator><keyframe><key name=\"up\" ctrl=\"4 5 6\"/></keyframe>";
    let read = model(inside, "");
    let inputs: Vec<String> = read.item.inputs.iter().map(|input| input.ident.to_string()).collect();
    assert_eq!(inputs, ["a_effort", "lift", "arm_site_control"]);
    let wrench = |clause: &ForceClause| {
        let has = |word| clause.expression(word).is_some();
        (clause.body().unwrap().to_string(), has(FORCE), has(TORQUE))
    };
    let wrenches = read.forces.iter().filter(|clause| clause.row.kind == ElementKind::Wrench).map(wrench);
    let wrenches: Vec<_> = wrenches.collect();
    assert_eq!(wrenches, [("s".to_owned(), true, true), ("arm_site".to_owned(), true, false)]);
    let controls = |read: Model| -> Vec<(String, f64)> {
        let up = read.item.described.unwrap().states.remove(0);
        up.inputs.into_iter().map(|(name, value)| (name.to_string(), value)).collect()
    };
    assert_eq!(controls(read), [("lift".to_owned(), 4.0), ("arm_site".to_owned(), 6.0)]);
    let all = controls(model(inside, ", inputs = actuators"));
    assert_eq!(all, [("lift".to_owned(), 4.0), ("a".to_owned(), 5.0), ("arm_site".to_owned(), 6.0)]);
}

/// Ranges of controls, forces and efforts act where the struct says so, and are warned of otherwise.
#[test]
fn ranges_of_inputs() {
    let inside = "<joint name=\"a\" actuatorfrcrange=\"-5 6\"/><joint name=\"b\"/></body></worldbody><actuator>\
                  <motor name=\"m\" joint=\"a\" gear=\"3\" ctrlrange=\"-1 1\"/>\
                  <position name=\"p\" joint=\"b\" kp=\"2\" forcerange=\"-3 4\"/></actuator>";
    let warned = |clauses: &str| -> Vec<String> {
        let remarks = model(inside, clauses).item.described.unwrap().remarks.into_iter();
        remarks
            .filter(|remark| remark.ignored)
            .map(|remark| remark.text.split_once(": ").unwrap().1.to_owned())
            .collect()
    };
    assert_eq!(
        warned(", inputs = actuators"),
        [
            "the range -5 to 6 of `a` (`actuatorfrcrange`) does not act; write `saturation = clamp` to cut off what is \
             beyond, or `saturation = none`",
            "the range -1 to 1 of `m` (`ctrlrange`) does not act; write `saturation = clamp` to cut off what is beyond, \
             or `saturation = none`",
            "the range -3 to 4 of `p` (`forcerange`) does not act; write `saturation = clamp` to cut off what is beyond, \
             or `saturation = none`",
        ]
    );
    let efforts = warned(", saturation = clamp");
    assert_eq!(efforts.len(), 2);
    assert!(
        efforts[0].contains("of `m` (`ctrlrange`) does not act; the input is the effort of its joint"),
        "{efforts:?}"
    );
    for clauses in [", inputs = none", ", saturation = none", ", inputs = actuators, saturation = clamp"] {
        assert!(warned(clauses).is_empty(), "{clauses}");
    }
    let drives = |clauses: &str| {
        let read = model(inside, clauses);
        read.forces[0].rates().map(|(q, force)| format!("{q}: {}", show(force))).collect::<Vec<_>>()
    };
    assert_eq!(
        drives(", inputs = actuators, saturation = clamp"),
        ["b: (clamp (Add (Multiply 2 p) (Multiply (-2) b)) (-3) 4)", "a: (clamp (Multiply 3 (clamp m (-1) 1)) (-5) 6)"]
    );
    assert_eq!(drives(", saturation = clamp"), ["b: b_effort", "a: (clamp a_effort (-5) 6)"]);
    assert_eq!(drives(""), ["a: a_effort", "b: b_effort"]);
    let wrong = inside.replace("-1 1", "1 -1");
    assert_eq!(
        reported(&wrong, ""),
        ["3:88: <motor name=\"m\">: a range is from its least to its most, found 1 to -1"]
    );
}

/// Forces at centres of mass hold a part of the weight; what a tendon's spring does over a range of lengths.
#[test]
fn held_weights_and_springs_over_ranges() {
    let held = "<joint name=\"a\"/><body name=\"load\" gravcomp=\"0.5\"><geom size=\"1\" mass=\"4\" pos=\"0 0 2\"/></body>\
                </body></worldbody>";
    let forces = |clauses: &str| -> Vec<String> {
        let shown = |clause: &ForceClause| {
            let [at, value] = [AT, VALUE].map(|word| clause.expression(word).map(show).unwrap_or_default());
            format!("{} at {at}: {value}", clause.body().unwrap())
        };
        let forces = model(held, clauses).forces;
        forces.iter().filter(|clause| clause.row.kind == ElementKind::Force).map(shown).collect()
    };
    assert_eq!(forces(""), ["load at [0 0 2]: (Multiply (-2) [0 0 (-981/100)])"]);
    assert_eq!(forces(", gravity = 1.5"), ["load at [0 0 2]: (Multiply (-2) [0 0 (-3/2)])"]);
    assert_eq!(forces(", gravity = [0, 1, 0]"), ["load at [0 0 2]: (Multiply (-2) [0 1 0])"]);
    let tendon = format!(
        "{TWO}<tendon><fixed stiffness=\"2\" damping=\"3\" springlength=\"-1 1\"><joint joint=\"a\" coef=\"4\"/></fixed></tendon>"
    );
    let read = model(&tendon, "");
    let drive = read.forces.iter().find_map(|clause| clause.rates().next());
    let along = "(Multiply 4 a)";
    let force =
        format!("(Add (Multiply (-2) (Subtract {along} (clamp {along} (-1) 1))) (Multiply (-3) (rate {along})))");
    assert_eq!(show(drive.unwrap().1), format!("(Multiply 4 {force})"));
    assert!(read.item.described.unwrap().remarks.iter().all(|remark| !remark.ignored));
}

/// Armatures and dampers of joints whose coordinates are rotations and poses.
#[test]
fn laws_of_balls_and_free_joints() {
    let inside = "<joint name=\"a\" type=\"ball\" armature=\"0.1\" damping=\"2\"/></body>\
                  <body name=\"b\"><joint name=\"f\" type=\"free\" armature=\"0.2\" damping=\"3\"/>\
                  <geom size=\"1\"/></body></worldbody>";
    let read = model(inside, "");
    assert_eq!(read.armatures.iter().map(|(q, _)| q.to_string()).collect::<Vec<_>>(), ["a", "f"]);
    assert!(read.forces.iter().any(|force| force.row.kind == ElementKind::Dissipation));
    assert!(read.item.described.unwrap().remarks.iter().all(|remark| !remark.ignored));
}

/// Drives of balls and free joints have names, also where a gear is zero; a ball in a chain has a reaction.
#[test]
fn drives_of_balls_and_free_joints() {
    let inside = "<joint name=\"h\"/><body name=\"b\"><joint name=\"a\" type=\"ball\" range=\"0 60\"/><geom size=\"1\"/></body></body>\
                  <body name=\"c\"><freejoint name=\"f\"/><geom size=\"1\"/></body></worldbody><actuator>\
                  <motor name=\"turn\" joint=\"a\" gear=\"1 2 3\"/><motor name=\"none\" joint=\"a\" gear=\"0\"/>\
                  <motor name=\"push\" joint=\"f\"/><motor name=\"still\" joint=\"f\" gear=\"0\"/></actuator>";
    let read = model(inside, ", limits = range");
    let expected = [
        "torque turn: value (Multiply turn [1 2 3]), body b, reaction arm",
        "torque none: value (Multiply none [0 0 0]), body b, reaction arm",
        "wrench push: force (Multiply push [1 0 0]), axes observer, body c",
        "wrench still: force (Multiply still [0 0 0]), axes observer, body c",
    ];
    assert_eq!(read.forces.iter().map(shown).collect::<Vec<_>>(), expected);
    let range = read.contacts.iter().flat_map(|contact| &contact.names).map(ToString::to_string);
    assert_eq!(range.collect::<Vec<_>>(), ["a_to"]);
    assert!(read.item.described.unwrap().remarks.iter().all(|remark| !remark.ignored));
    let warned = reported(inside, "");
    assert!(warned[0].contains("the limits of joints and tendons do not act"), "{warned:?}");
}

/// Contents of the root of an included file stand where it is included; mistakes are in the file where they are
/// written.
#[test]
fn files_that_include_others() {
    let part = |inside: &str| Scratch::called(&format!("<mujocoinclude>\n{inside}\n</mujocoinclude>"), "xml");
    let name = |file: &Scratch| file.0.file_name().unwrap().to_string_lossy().into_owned();
    let include = |file: &Scratch| format!("<include file=\"{}\"/>", name(file));
    let whole = |parts: &str| {
        let text = format!("<mujoco>\n<worldbody><body name=\"arm\">{INERTIAL}\n{parts}</body></worldbody>\n</mujoco>");
        let main = Scratch::called(&text, "xml");
        let names = |text: String| text.replace(&format!("{}/", main.0.parent().unwrap().to_string_lossy()), "");
        let read = read(&main.of("", ""));
        let mistakes = read.as_ref().err().cloned().into_iter().flatten().map(|mistake| names(mistake.to_string()));
        let mistakes = mistakes.collect::<Vec<_>>().join("\n").replace(&name(&main), "main");
        (read.ok(), mistakes)
    };
    let hinge = part("<joint name=\"a\"/><site name=\"s\"/>");
    let both = part(&format!("{}\n<site name=\"t\"/>", include(&hinge)));
    let (read, mistakes) = whole(&include(&both));
    let read = read.unwrap_or_else(|| panic!("{mistakes}"));
    assert_eq!((read.coordinates.len(), read.bodies.len()), (1, 4));
    assert_eq!(read.item.described.unwrap().paths.len(), 3);

    let wrong = part("<joint\n name=\"a\" type=\"hing\"/>");
    let text = format!("{}:2:1: <joint name=\"a\">: a joint is free, ball, slide or hinge, found `hing`", name(&wrong));
    assert_eq!(whole(&include(&wrong)).1, text);
    let broken = part("<joint>");
    assert!(whole(&include(&broken)).1.starts_with(&format!("{}:3:1: this is no XML: ", name(&broken))));
    let twice = format!("{}\n{}", include(&hinge), include(&hinge));
    let text =
        format!("main:4:1: <include>: `{}` is included a second time; each file can be included once", name(&hinge));
    assert_eq!(whole(&twice).1, text);
    let circle = part("");
    std::fs::write(&circle.0, format!("<mujoco>{}</mujoco>", include(&circle))).unwrap();
    let text = format!("{0}:1:9: <include>: files include each other in a circle: `{0}` includes `{0}`", name(&circle));
    assert_eq!(whole(&include(&circle)).1, text);
    assert_eq!(whole("<include/>").1, "main:3:1: <include>: the attribute `file` is missing");
    assert!(whole("<include file=\"nowhere.xml\"/>").1.starts_with("main:3:1: <include>: cannot read `nowhere.xml`"));
    let inner = "<include><include file=\"nowhere.xml\"/></include>";
    let text = "main:3:1: <include>: there is nothing in an <include>; what it stands for is in its file";
    assert_eq!(whole(inner).1, text);
}

/// A file is beside the first one, or else beside the one that includes it.
#[test]
fn included_files_in_folders() {
    let folder = std::env::temp_dir().join(format!("gauss-folders-{}", std::process::id()));
    let write = |name: &str, text: &str| {
        let path = folder.join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, text).unwrap();
        path
    };
    let arm = format!("<worldbody><body name=\"arm\">{INERTIAL}<include file=\"joint.xml\"/></body></worldbody>");
    let main = write("main.xml", "<mujoco><include file=\"parts/arm.xml\"/></mujoco>");
    write("parts/arm.xml", &format!("<!-- of\n a part -->\n<?xml version=\"1.0\"?><mujoco>{arm}</mujoco>"));
    write("parts/joint.xml", "<mujoco><joint name=\"beside\"/></mujoco>");
    let name = |main: &std::path::Path| {
        let read = read(&format!("#[gauss(mjcf = {main:?})] struct Robot;")).unwrap();
        (read.coordinates[0].ident.to_string(), read.item.described.unwrap().paths.len())
    };
    assert_eq!(name(&main), ("beside".to_owned(), 3));
    write("joint.xml", "<mujoco><joint name=\"first\"/></mujoco>");
    assert_eq!(name(&main), ("first".to_owned(), 3));
    // The same file by another name.
    write("joint.xml", "<mujoco><include file=\"parts/../main.xml\"/></mujoco>");
    let error = read(&format!("#[gauss(mjcf = {main:?})] struct Robot;")).map(|_| ()).unwrap_err().to_string();
    assert!(error.contains("files include each other in a circle"), "{error}");
    let _ = std::fs::remove_dir_all(&folder);
}

/// Copies with numbers after their names, and of what refers to them, in the order of MuJoCo 4.0.0.
#[test]
fn copies() {
    let text = format!(
        "<mujoco><worldbody><body name=\"z\">{INERTIAL}<joint name=\"z\"/></body>\n\
         <replicate count=\"4\"><body name=\"b\">{INERTIAL}\
         <joint name=\"j\"/><site name=\"s\"/></body></replicate></worldbody><actuator><motor name=\"m\" joint=\"j\"/>\
         <motor name=\"n\" tendon=\"t\"/><motor name=\"y\" joint=\"z\"/></actuator><tendon><fixed name=\"t\">\
         <joint joint=\"j\" coef=\"1\"/><joint joint=\"z\" coef=\"1\"/></fixed></tendon><equality>\
         <joint name=\"j\" joint1=\"j\" joint2=\"z\" polycoef=\"0 1 2 0 0\"/></equality></mujoco>"
    );
    let file = Scratch::called(&text, "xml");
    let read = read(&file.of(", inputs = actuators", "")).unwrap_or_else(|error| panic!("{error}"));
    let names = |all: &mut dyn Iterator<Item = String>| all.collect::<Vec<_>>().join(" ");
    assert_eq!(names(&mut read.coordinates.iter().map(|q| q.ident.to_string())), "z j0 j1 j2 j3");
    assert_eq!(names(&mut read.item.inputs.iter().map(|input| input.ident.to_string())), "y m0 n0 m1 n1 m2 n2 m3 n3");
    assert_eq!(read.constraints.len(), 4);
}

/// As many digits as the count has; the inner numbers first.
#[test]
fn copies_of_copies() {
    let inside = |copies: &str| format!("</body>{copies}</worldbody>");
    let body = format!("<body name=\"b\">{INERTIAL}<joint name=\"j\"/></body>");
    let twice = format!(
        "<replicate count=\"2\"><frame><replicate count=\"10\" sep=\"_\">{body}</replicate></frame></replicate>"
    );
    let found = model(&inside(&twice), "");
    let names: Vec<String> = found.coordinates.iter().map(|q| q.ident.to_string()).collect();
    assert_eq!(
        (names.len(), names[0].as_str(), names[1].as_str(), names[10].as_str()),
        (20, "j_000", "j_010", "j_001")
    );
    for (count, message) in [
        ("", "3:8: <replicate>: the attribute `count` is missing"),
        ("count=\"0\"", "3:8: <replicate>: `count` is a whole number from 1 to 1000, found `0`"),
        ("count=\"2.5\"", "3:8: <replicate>: `count` is a whole number from 1 to 1000, found `2.5`"),
        ("count=\"1e9\"", "3:8: <replicate>: `count` is a whole number from 1 to 1000, found `1000000000`"),
    ] {
        assert_eq!(reported(&inside(&format!("<replicate {count}>{body}</replicate>")), ""), [message]);
    }
    let loose = inside("<replicate count=\"2\"><joint/></replicate>");
    assert_eq!(reported(&loose, ""), ["3:8: <replicate>: a <joint> cannot stand in it; put it into a <body>"]);
    let wrong = inside(&format!("<replicate count=\"2\">\n<body><joint axis=\"0 0 0\"/>{INERTIAL}</body></replicate>"));
    assert_eq!(reported(&wrong, "")[0], "4:7: <joint>: its axis is zero and has no direction");
}
