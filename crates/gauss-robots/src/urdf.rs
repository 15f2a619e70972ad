//! URDF → description, as <https://wiki.ros.org/urdf/XML> has it.

use roxmltree::Node;

use super::collision::{Collision, Shape};
use super::description::{Description, Drive, Fault, Inertial, Joint, JointKind, Link, Mimic, Note};
use super::names::unknown;
use super::rotation::{Rotation, Triple, direction, of_quaternion, turned_tensor};
use super::text::Text;
use super::urdf_reference::ELEMENTS;
use super::xml::{Reading, parse, shown};

/// Turns of a joint without an axis, by the specification.
const AXIS: Triple = [1.0, 0.0, 0.0];

const QUATERNION: &str = "quat_xyzw";

/// # Errors
/// Everything that is wrong in the elements of the file, each by itself.
pub fn read(text: &Text) -> Result<Description, Vec<Fault>> {
    let document = parse(&text.whole).map_err(|fault| vec![fault])?;
    let mut reading = Reading::new(&document, text, ELEMENTS);
    let robot = document.root_element();
    let mut description = Description::default();
    if robot.tag_name().name() != "robot" {
        reading.fault(robot, "a URDF file is a <robot>");
    }
    refuse_macros(robot, &mut reading);
    refuse_version(robot, &mut reading);
    for node in reading.children(robot, "link") {
        let own = link(node, &mut reading);
        if let Some(link) = &own {
            let shapes = reading.children(node, "collision");
            description.collisions.extend(shapes.into_iter().map(|shape| collision(shape, &link.name, &mut reading)));
        }
        description.links.extend(own);
    }
    description.joints =
        reading.children(robot, "joint").into_iter().filter_map(|node| joint(node, &mut reading)).collect();
    for node in reading.children(robot, "transmission") {
        transmission(node, &mut description, &mut reading);
    }
    let Description { joints, drives, .. } = &mut description;
    drives.retain(|drive| {
        let strange = drive.along.iter().find(|(name, _)| !joints.iter().any(|joint| joint.name == *name));
        if let Some((name, _)) = strange {
            let which = unknown("joint", name, joints.iter().map(|joint| joint.name.as_str()));
            let text = format!("the transmission `{}` drives {which}", drive.name);
            reading.notes.push(Note::ignored(drive.at, "transmission", text));
        }
        strange.is_none()
    });
    reading.note_unread();
    description.notes = reading.notes;
    if reading.faults.is_empty() { Ok(description) } else { Err(reading.faults) }
}

/// Refuses macros, which are to become a URDF file first.
fn refuse_macros<'a>(robot: Node<'a, 'a>, reading: &mut Reading<'a>) {
    let is_macro = |node: &Node<'a, 'a>| node.tag_name().namespace().is_some_and(|space| space.contains("xacro"));
    if let Some(first) = robot.descendants().find(is_macro) {
        reading.fault(first, "macros are not read; let `xacro` write the file without them");
    }
}

/// Versions that urdfdom 5.1 reads: 1.0, also without an attribute, and 1.1, which has quaternions and capsules.
fn refuse_version<'a>(robot: Node<'a, 'a>, reading: &mut Reading<'a>) {
    let version = reading.text(robot, "version").unwrap_or("1.0");
    if !matches!(version, "1" | "1.0" | "1.1") {
        let text = format!("`version` is 1.0 or 1.1, found `{version}`; what others mean is not read");
        reading.fault(robot, text);
    }
}

/// Whether the file has what version 1.1 added.
fn has_quaternions(node: Node<'_, '_>) -> bool {
    node.document().root_element().attribute("version").map(str::trim) == Some("1.1")
}

fn link<'a>(node: Node<'a, 'a>, reading: &mut Reading<'a>) -> Option<Link> {
    let name = reading.required(node, "name")?;
    let inertial = reading.child(node, "inertial").and_then(|inertial| mass_data(inertial, reading));
    Some(Link { name, at: reading.at(node), inertial, mass_notes: Vec::new(), held: 0.0 })
}

/// Mass data, turned into the axes of the link.
fn mass_data<'a>(node: Node<'a, 'a>, reading: &mut Reading<'a>) -> Option<Inertial> {
    let (center, rotation) = origin(node, reading);
    let mass = match reading.child(node, "mass") {
        Some(mass) => reading.required_number(mass, "value"),
        None => {
            reading.fault(node, "<mass value=\"…\"/> is missing");
            None
        }
    };
    let Some(tensor) = reading.child(node, "inertia") else {
        reading.fault(node, "<inertia ixx=\"…\" …/> is missing");
        return None;
    };
    let [xx, yy, zz] = ["ixx", "iyy", "izz"].map(|name| reading.required_number(tensor, name));
    let [xy, xz, yz] = ["ixy", "ixz", "iyz"].map(|name| reading.number(tensor, name).unwrap_or(0.0));
    let (mass, xx, yy, zz) = (mass?, xx?, yy?, zz?);
    if mass < 0.0 {
        reading.fault(node, format!("a mass is zero or more, found `{mass}`"));
    }
    let inertia = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    let inertia = if rotation == Rotation::none() { inertia } else { turned_tensor(&rotation.matrix, &inertia) };
    Some(Inertial { mass, center, inertia }.settled())
}

/// A shape that touches; what is none that is read says so.
fn collision<'a>(node: Node<'a, 'a>, link: &str, reading: &mut Reading<'a>) -> Collision {
    let (position, rotation) = place(node, reading);
    let name = reading.text(node, "name").filter(|name| !name.is_empty()).map(str::to_owned);
    let shapes = reading.child(node, "geometry").map(|geometry| reading.elements(geometry)).unwrap_or_default();
    let shape = shapes.first().and_then(|shape| {
        let tag = shape.tag_name().name();
        Some(match tag {
            "sphere" => Shape::Sphere { radius: length(*shape, "radius", reading)? },
            "capsule" => {
                let [radius, along] = ["radius", "length"].map(|name| length(*shape, name, reading));
                Shape::Capsule { radius: radius?, half: along? / 2.0 }
            }
            "cylinder" => {
                let [radius, along] = ["radius", "length"].map(|name| length(*shape, name, reading));
                Shape::Cylinder { radius: radius?, half: along? / 2.0 }
            }
            "box" => Shape::Box { half: edges(*shape, reading)?.map(|edge| edge / 2.0) },
            _ => Shape::Unread(format!("a {tag}")),
        })
    });
    let shape = shape.unwrap_or_else(|| Shape::Unread("an element without a shape".to_owned()));
    let (at, link, rotation) = (reading.at(node), link.to_owned(), rotation.matrix);
    Collision { name, at, link, position, rotation, shape, surface: None }
}

fn length<'a>(node: Node<'a, 'a>, name: &'static str, reading: &mut Reading<'a>) -> Option<f64> {
    if node.attribute(name).is_none() {
        reading.fault(node, format!("the attribute `{name}` is missing"));
        return None;
    }
    Some(reading.amount(node, name))
}

fn edges<'a>(node: Node<'a, 'a>, reading: &mut Reading<'a>) -> Option<Triple> {
    let Some(edges) = reading.numbers::<3>(node, "size") else {
        if node.attribute("size").is_none() {
            reading.fault(node, "the attribute `size` is missing");
        }
        return None;
    };
    if edges.iter().any(|edge| *edge < 0.0) {
        reading.fault(node, "its edges are zero or more");
    }
    Some(edges)
}

/// `<origin xyz="…" rpy="…"/>` of an element; since version 1.1 `quat_xyzw="…"` stands in place of `rpy`.
fn place<'a>(node: Node<'a, 'a>, reading: &mut Reading<'a>) -> (Triple, Rotation) {
    let Some(origin) = reading.child(node, "origin") else { return ([0.0; 3], Rotation::none()) };
    let position = reading.numbers(origin, "xyz").unwrap_or_default();
    let angles = reading.numbers(origin, "rpy").map(Rotation::from_angles);
    let rotation = match reading.numbers::<4>(origin, QUATERNION) {
        None => angles,
        Some([x, y, z, w]) => quaternion(origin, [w, x, y, z], angles, reading),
    };
    (position, rotation.unwrap_or_else(Rotation::none))
}

/// The rotation of a quaternion (w, x, y, z), beside that of angles, if there are some.
fn quaternion<'a>(
    origin: Node<'a, 'a>,
    q: [f64; 4],
    angles: Option<Rotation>,
    reading: &mut Reading<'a>,
) -> Option<Rotation> {
    let message = match (has_quaternions(origin), angles) {
        (true, None) => match of_quaternion(q) {
            Some(matrix) => return Some(Rotation::from_matrix(&matrix)),
            None => "`quat_xyzw` is zero and has no direction",
        },
        (true, Some(_)) => "`rpy` and `quat_xyzw` say the same; write one of the two",
        (false, None) => "`quat_xyzw` is of version 1.1: write `version=\"1.1\"` in <robot>, or `rpy`",
        // By the specification those who read version 1.0 see the angles alone.
        (false, Some(angles)) => {
            let text = "`quat_xyzw` does not act beside `rpy`: without `version=\"1.1\"` in <robot> angles count";
            reading.notes.push(Note::ignored(reading.at(origin), QUATERNION, text).about(QUATERNION));
            return Some(angles);
        }
    };
    reading.fault(origin, message);
    None
}

/// The same; written angles that are nearly quarter turns are told of.
fn origin<'a>(node: Node<'a, 'a>, reading: &mut Reading<'a>) -> (Triple, Rotation) {
    let (position, rotation) = place(node, reading);
    let origin = reading.children(node, "origin").first().copied().filter(|origin| origin.has_attribute("rpy"));
    let Some(origin) = origin else { return (position, rotation) };
    let quarter = std::f64::consts::FRAC_PI_2;
    for angle in rotation.angles {
        let off = (angle / quarter).round() * quarter - angle;
        if off != 0.0 && off.abs() < 1e-3 && angle.abs() > 0.1 {
            let text = format!(
                "the angle {angle} is taken as it is written, {off:.1e} from a quarter turn; more digits would save operations"
            );
            reading.notes.push(Note::told(reading.at(origin), text).about("angles"));
        }
    }
    (position, rotation)
}

fn joint<'a>(node: Node<'a, 'a>, reading: &mut Reading<'a>) -> Option<Joint> {
    let name = reading.required(node, "name");
    let kind = kind(node, reading);
    let [parent, child] = ["parent", "child"].map(|word| match reading.child(node, word) {
        Some(end) => reading.required(end, "link"),
        None => {
            reading.fault(node, format!("<{word} link=\"…\"/> is missing"));
            None
        }
    });
    let (position, rotation) = origin(node, reading);
    let axis = kind.map(|kind| axis(node, kind, reading));
    let mimic = reading.child(node, "mimic").and_then(|mimic| {
        Some(Mimic {
            at: reading.at(mimic),
            joint: reading.required(mimic, "joint")?,
            multiplier: reading.number(mimic, "multiplier").unwrap_or(1.0),
            offset: reading.number(mimic, "offset").unwrap_or(0.0),
        })
    });
    let [damping, friction] = match reading.child(node, "dynamics") {
        Some(dynamics) => ["damping", "friction"].map(|name| reading.amount(dynamics, name)),
        None => [0.0; 2],
    };
    let scalar = matches!(kind, Some(JointKind::Turning | JointKind::Sliding));
    if !scalar && (damping, friction) != (0.0, 0.0) {
        reading.ignored(node, format!("damping and friction of {} do not act: it has not one coordinate", shown(node)));
    }
    let limit = reading.child(node, "limit");
    let limits = match limit {
        Some(limit) if scalar && reading.text(node, "type") != Some("continuous") => {
            // By the specification what is not said is zero; files that leave out both mean none.
            let limits = ["lower", "upper"].map(|name| reading.number(limit, name));
            if limits == [None; 2] { limits } else { limits.map(|limit| limit.or(Some(0.0))) }
        }
        _ => [None; 2],
    };
    // Zero stands where nothing is known: so MuJoCo reads it, too (`xml_urdf.cc`).
    let most = limit.and_then(|limit| reading.number(limit, "effort")).map(f64::abs);
    let efforts = most.filter(|most| scalar && *most > 0.0).map(|most| [-most, most]);
    let (name, kind, parent, child, axis) = (name?, kind?, parent?, child?, axis?);
    let at = reading.at(node);
    let joint = Joint::new(name, at, kind, parent, child);
    Some(Joint { position, rotation, axis, mimic, limits, damping, friction, efforts, ..joint })
}

fn kind<'a>(node: Node<'a, 'a>, reading: &mut Reading<'a>) -> Option<JointKind> {
    let word = reading.required(node, "type")?;
    Some(match word.as_str() {
        "revolute" | "continuous" => JointKind::Turning,
        "prismatic" => JointKind::Sliding,
        "fixed" => JointKind::Fixed,
        "floating" => JointKind::Floating,
        "planar" => JointKind::Planar,
        _ => {
            reading.fault(
                node,
                format!("a joint is revolute, continuous, prismatic, fixed, floating or planar, found `{word}`"),
            );
            return None;
        }
    })
}

fn axis<'a>(node: Node<'a, 'a>, kind: JointKind, reading: &mut Reading<'a>) -> Triple {
    let element = reading.child(node, "axis");
    if matches!(kind, JointKind::Fixed | JointKind::Floating) {
        element.map(|element| reading.text(element, "xyz"));
        return AXIS;
    }
    let Some(element) = element else {
        let text = format!("{} has no axis: it is 1 0 0 by the specification", shown(node));
        reading.notes.push(Note::told(reading.at(node), text).about("no axis"));
        return AXIS;
    };
    let Some(written) = reading.numbers::<3>(element, "xyz") else {
        if reading.text(element, "xyz").is_none() {
            reading.fault(element, "the attribute `xyz` is missing");
        }
        return AXIS;
    };
    let length = written.iter().map(|c| c * c).sum::<f64>().sqrt();
    if (length - 1.0).abs() > 1e-3 && length > 0.0 {
        let text = format!("the axis of {} has the length {length}; its direction counts", shown(node));
        reading.notes.push(Note::told(reading.at(element), text).about("axes"));
    }
    direction(written).unwrap_or_else(|| {
        reading.fault(element, format!("the axis of {} is zero and has no direction", shown(node)));
        AXIS
    })
}

/// A joint behind gears that are simple: one motor, one joint.
fn transmission<'a>(node: Node<'a, 'a>, description: &mut Description, reading: &mut Reading<'a>) {
    node.descendants().for_each(|inner| reading.see(inner));
    reading.text(node, "type");
    let joints: Vec<String> =
        reading.children(node, "joint").into_iter().filter_map(|joint| reading.required(joint, "name")).collect();
    let motors = reading.children(node, "actuator");
    let rotor = written(node, &["rotorInertia", "rotor_inertia", "motorInertia", "motor_inertia"], true, reading);
    let gears = ["mechanicalReduction", "mechanical_reduction", "gear_ratio"];
    let gear = written(node, &gears, rotor.is_some(), reading).unwrap_or(1.0);
    let name = |joint: &String, motor: Option<&Node<'a, 'a>>| {
        motor.and_then(|motor| motor.attribute("name")).unwrap_or(joint).to_owned()
    };
    let at = reading.at(node);
    let simple = joints.len() == 1 && motors.len() <= 1;
    if !simple && (gear != 1.0 || rotor.is_some() || motors.len() > 1) {
        let text = format!("{} joins several: its gears and rotors do not act, its joints have efforts", shown(node));
        reading.ignored(node, text);
    }
    for (index, joint) in joints.iter().enumerate() {
        let (name, gear) = (name(joint, motors.get(index)), if simple { gear } else { 1.0 });
        description.drives.push(Drive {
            name,
            at,
            along: vec![(joint.clone(), gear)],
            at_link: None,
            at_joint: None,
            gain: Drive::DIRECT,
            bias: [0.0; 3],
            controls: None,
            forces: None,
        });
        let own = description.joints.iter_mut().find(|own| own.name == *joint);
        if let (Some(own), Some(rotor), true) = (own, rotor, simple) {
            own.armature += gear * gear * rotor;
        }
    }
    let forces = |text: &str| text.to_ascii_lowercase().contains("effort");
    let interface = node.descendants().find(|inner| {
        inner.tag_name().name() == "hardwareInterface"
            && inner.text().is_some_and(|text| !text.is_empty() && !forces(text))
    });
    if let (Some(interface), [joint, ..]) = (interface, joints.as_slice()) {
        let text = format!("`{}` is no effort: the input of `{joint}` is", interface.text().unwrap_or_default().trim());
        reading.notes.push(Note::told(reading.at(interface), text).about("interfaces"));
    }
}

/// The number of an element that has one of these names, as its text or its `value`. What is none is a mistake where
/// inertia depends on it; files that are driven otherwise often have words there.
fn written<'a>(node: Node<'a, 'a>, names: &[&str], matters: bool, reading: &mut Reading<'a>) -> Option<f64> {
    let element = node.descendants().find(|inner| names.contains(&inner.tag_name().name()))?;
    let text = reading.text(element, "value").or(element.text()).unwrap_or_default().trim();
    let number = text.parse::<f64>().ok().filter(|number| number.is_finite());
    match number {
        None if matters => reading.fault(element, format!("expected a number, found `{text}`")),
        None => reading.ignored(element, format!("{} is no number but `{text}`: it does not act", shown(element))),
        Some(_) => {}
    }
    number
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use super::read;
    use crate::collision::{Collision, Shape};
    use crate::description::Fault;
    use crate::text::{Text, Written};

    fn shapes(inside: &str) -> Result<Vec<Collision>, Vec<Fault>> {
        let text = format!("<robot name=\"r\"><link name=\"a\">{inside}</link></robot>");
        let text = Text::of(Written::new(String::new(), PathBuf::new(), text));
        read(&text).map(|description| description.collisions)
    }

    /// Sizes are whole ones by <https://wiki.ros.org/urdf/XML/link>: edges, and the length of a cylinder about its
    /// centre; that of a capsule, which newer versions have, is between the centres of its ends.
    #[test]
    fn shapes_that_touch() {
        let found = shapes(
            r#"<collision name="c"><origin xyz="1 2 3" rpy="0 1.5707963267948966 0"/>
            <geometry><cylinder radius="0.1" length="0.6"/></geometry></collision>
            <collision><geometry><box size="1 2 3"/></geometry></collision>
            <collision><geometry><capsule radius="0.1" length="0.6"/></geometry></collision>
            <collision><geometry><mesh filename="m.stl"/></geometry></collision><collision/>"#,
        )
        .unwrap();
        assert_eq!((found[0].name.as_deref(), found[0].position), (Some("c"), [1.0, 2.0, 3.0]));
        assert_eq!(found[0].rotation, [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]);
        let unread = |what: &str| Shape::Unread(what.to_owned());
        let expected = [
            Shape::Cylinder { radius: 0.1, half: 0.3 },
            Shape::Box { half: [0.5, 1.0, 1.5] },
            Shape::Capsule { radius: 0.1, half: 0.3 },
            unread("a mesh"),
            unread("an element without a shape"),
        ];
        assert!(found.iter().map(|own| &own.shape).eq(&expected), "{found:?}");
        assert!(found.iter().all(|own| own.surface.is_none() && own.link == "a"));
    }

    /// As urdfdom 5.1 has it: its tests `urdf_schema_quaternion_test`, and its README of versions.
    #[test]
    fn quaternions_of_version_1_1() {
        let read = |version: &str, rotation: &str| {
            let text = format!(
                "<robot name=\"r\" {version}><link name=\"a\"/><link name=\"b\"><inertial>\
                 <origin {rotation}/><mass value=\"1\"/><inertia ixx=\"1\" iyy=\"2\" izz=\"2.5\"/></inertial>\
                 <collision><origin {rotation}/><geometry><capsule radius=\"0.1\" length=\"0.6\"/></geometry></collision>\
                 </link><joint name=\"j\" type=\"fixed\"><parent link=\"a\"/><child link=\"b\"/><origin {rotation}/>\
                 </joint></robot>"
            );
            read(&Text::of(Written::new(String::new(), PathBuf::new(), text)))
        };
        let new = r#"version="1.1""#;
        let turned = read(new, r#"xyz="1 2 3" quat_xyzw="1.2 0 0 1.6""#).unwrap();
        // cos φ = 0.8² − 0.6², sin φ = 2 · 0.8 · 0.6 about the first axis.
        let expected = [[1.0, 0.0, 0.0], [0.0, 0.28, -0.96], [0.0, 0.96, 0.28]];
        let near = |found: &[[f64; 3]; 3], expected: &[[f64; 3]; 3]| {
            // A few products of numbers of size one.
            let off = |i: usize, j: usize| (found[i][j] - expected[i][j]).abs();
            (0..9).all(|k| off(k / 3, k % 3) <= 8.0 * f64::EPSILON)
        };
        assert!(near(&turned.joints[0].rotation.matrix, &expected) && turned.joints[0].position == [1.0, 2.0, 3.0]);
        assert!(near(&turned.collisions[0].rotation, &expected));
        assert_eq!(turned.collisions[0].shape, Shape::Capsule { radius: 0.1, half: 0.3 });
        let inertia = turned.links[1].inertial.unwrap().inertia;
        let [a, b, c] =
            [2.0 * 0.28 * 0.28 + 2.5 * 0.96 * 0.96, 2.0 * 0.96 * 0.96 + 2.5 * 0.28 * 0.28, -0.5 * 0.28 * 0.96];
        assert!(near(&inertia, &[[1.0, 0.0, 0.0], [0.0, a, c], [0.0, c, b]]), "{inertia:?}");
        let by_angle = read("", &format!("xyz=\"1 2 3\" rpy=\"{} 0 0\"", 2.0 * 0.6_f64.atan2(0.8))).unwrap();
        assert!(near(&by_angle.joints[0].rotation.matrix, &expected));
        let message = |version: &str, rotation: &str| read(version, rotation).unwrap_err()[0].message.clone();
        let both = r#"rpy="0 0 1" quat_xyzw="0 0 0 1""#;
        assert!(message(new, both).contains("`rpy` and `quat_xyzw` say the same; write one of the two"));
        assert!(message(new, r#"quat_xyzw="0 0 0 0""#).contains("is zero and has no direction"));
        assert!(message(new, r#"quat_xyzw="0 0 1""#).contains("`quat_xyzw` is 4 numbers, found `0 0 1`"));
        for old in ["", r#"version="1.0""#, r#"version="1""#] {
            assert!(
                message(old, r#"quat_xyzw="0 0 0 1""#)
                    .contains("`quat_xyzw` is of version 1.1: write `version=\"1.1\"`")
            );
            let angles = read(old, both).unwrap();
            assert_eq!(angles.joints[0].rotation.angles, [0.0, 0.0, 1.0]);
            assert!(angles.notes.iter().any(|note| note.ignored.as_deref() == Some("quat_xyzw")), "{:?}", angles.notes);
        }
        assert_eq!(
            message(r#"version="2.0""#, ""),
            "<robot name=\"r\">: `version` is 1.0 or 1.1, found `2.0`; what others mean is not read"
        );
    }

    #[test]
    fn sizes_that_are_none() {
        let message = |shape: &str| {
            let found = shapes(&format!("<collision><geometry>{shape}</geometry></collision>"));
            found.unwrap_err()[0].message.clone()
        };
        assert_eq!(message("<sphere/>"), "<sphere>: the attribute `radius` is missing");
        assert_eq!(message("<box/>"), "<box>: the attribute `size` is missing");
        assert_eq!(message("<box size=\"1 -1 1\"/>"), "<box>: its edges are zero or more");
        assert_eq!(message("<sphere radius=\"-1\"/>"), "<sphere>: `radius` is zero or more, found `-1`");
    }
}
