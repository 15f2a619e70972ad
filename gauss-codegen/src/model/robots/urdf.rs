//! URDF → description, as <https://wiki.ros.org/urdf/XML> has it.

use roxmltree::Node;

use super::description::{Description, Fault, Inertial, Joint, JointKind, Link, Mimic, Note};
use super::rotation::{Rotation, Triple, direction, turned_tensor};
use super::xml::{Reading, parse, shown};

/// Turns of a joint without an axis, by the specification.
const AXIS: Triple = [1.0, 0.0, 0.0];

/// Elements that say nothing of the dynamics.
const SILENT: &[&str] = &["material", "gazebo", "sensor", "ros2_control", "version"];

/// # Errors
/// Everything that is wrong in the elements of the file, each by itself.
pub fn read(text: &str) -> Result<Description, Vec<Fault>> {
    let document = parse(text).map_err(|fault| vec![fault])?;
    let mut reading = Reading::new(&document);
    let robot = document.root_element();
    let mut description = Description::default();
    if robot.tag_name().name() != "robot" {
        reading.fault(robot, "a URDF file is a <robot>");
    }
    for node in robot.children().filter(Node::is_element) {
        match node.tag_name().name() {
            "link" => description.links.extend(link(node, &mut reading)),
            "joint" => description.joints.extend(joint(node, &mut reading)),
            "transmission" => transmission(node, &mut description, &mut reading),
            word if SILENT.contains(&word) => {}
            _ => reading.note(node, true, format!("{} is not read", shown(node))),
        }
    }
    description.notes = reading.notes;
    if reading.faults.is_empty() { Ok(description) } else { Err(reading.faults) }
}

fn link<'a>(node: Node<'a, 'a>, reading: &mut Reading<'a>) -> Option<Link> {
    let name = reading.required(node, "name")?;
    let inertial = reading.child(node, "inertial").and_then(|inertial| mass_data(inertial, reading));
    Some(Link { name, at: reading.at(node), inertial })
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
    Some(Inertial { mass, center, inertia })
}

/// `<origin xyz="…" rpy="…"/>` of an element.
fn origin<'a>(node: Node<'a, 'a>, reading: &mut Reading<'a>) -> (Triple, Rotation) {
    let Some(origin) = reading.child(node, "origin") else { return ([0.0; 3], Rotation::none()) };
    let position = reading.numbers(origin, "xyz").unwrap_or_default();
    let angles: Triple = reading.numbers(origin, "rpy").unwrap_or_default();
    let quarter = std::f64::consts::FRAC_PI_2;
    let rotation = Rotation::from_angles(angles);
    for angle in rotation.angles {
        let off = (angle / quarter).round() * quarter - angle;
        if off != 0.0 && off.abs() < 1e-3 && angle.abs() > 0.1 {
            reading.note(
                origin,
                false,
                format!(
                    "the angle {angle} is taken as it is written, {off:.1e} from a quarter turn; more digits \
                 would save operations"
                ),
            );
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
    let limits = match (kind, reading.child(node, "limit")) {
        (Some(JointKind::Turning | JointKind::Sliding), Some(limit))
            if node.attribute("type") != Some("continuous") =>
        {
            // By the specification what is not said is zero; files that leave out both mean none.
            let limits = ["lower", "upper"].map(|name| reading.number(limit, name));
            if limits == [None; 2] { limits } else { limits.map(|limit| limit.or(Some(0.0))) }
        }
        _ => [None; 2],
    };
    let (name, kind, parent, child, axis) = (name?, kind?, parent?, child?, axis?);
    let at = reading.at(node);
    let joint = Joint::new(name, at, kind, parent, child);
    Some(Joint { position, rotation, axis, mimic, limits, damping, friction, ..joint })
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
    if matches!(kind, JointKind::Fixed | JointKind::Floating) {
        return AXIS;
    }
    let Some(element) = reading.child(node, "axis") else {
        reading.note(node, false, format!("{} has no axis: it is 1 0 0 by the specification", shown(node)));
        return AXIS;
    };
    let Some(written) = reading.numbers::<3>(element, "xyz") else {
        if element.attribute("xyz").is_none() {
            reading.fault(element, "the attribute `xyz` is missing");
        }
        return AXIS;
    };
    let length = written.iter().map(|c| c * c).sum::<f64>().sqrt();
    if (length - 1.0).abs() > 1e-3 && length > 0.0 {
        reading.note(
            element,
            false,
            format!("the axis of {} has the length {length}; its direction counts", shown(node)),
        );
    }
    direction(written).unwrap_or_else(|| {
        reading.fault(element, format!("the axis of {} is zero and has no direction", shown(node)));
        AXIS
    })
}

fn transmission<'a>(node: Node<'a, 'a>, description: &mut Description, reading: &mut Reading<'a>) {
    for joint in Reading::children(node, "joint") {
        description.driven.extend(reading.required(joint, "name"));
    }
    let inertias = node.descendants().filter(|inner| inner.tag_name().name().ends_with("rotor_inertia"));
    for rotor in inertias.collect::<Vec<_>>() {
        let text = format!("the rotor inertia in {} does not act; add it to the inertia of the link", shown(node));
        reading.notes.push(Note { at: reading.at(rotor), text, ignored: true });
    }
}
