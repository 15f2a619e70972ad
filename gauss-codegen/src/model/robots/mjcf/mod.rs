//! MJCF → description, as <https://mujoco.readthedocs.io/en/stable/XMLreference.html> has it.
//!
//! Of several joints in a body all but the last have a link of their own, without mass; so has one whose anchor is
//! not the origin of its body, which is then fixed to it.

mod classes;
mod rotations;

use roxmltree::Node;

use self::classes::Classes;
use self::rotations::Angles;
use super::description::{Closure, Description, Fault, Inertial, Joint, JointKind, Link, Mimic};
use super::rotation::{Rotation, Triple, direction, turned, turned_tensor};
use super::xml::{Reading, parse, shown};

/// Sections and elements that say nothing of the motion.
const SILENT: &[&str] = &[
    "asset",
    "camera",
    "compiler",
    "custom",
    "default",
    "exclude",
    "geom",
    "inertial",
    "joint",
    "freejoint",
    "key",
    "keyframe",
    "light",
    "option",
    "sensor",
    "size",
    "statistic",
    "visual",
];

/// # Errors
/// Everything that is wrong in the elements of the file, each by itself.
pub fn read(text: &str) -> Result<Description, Vec<Fault>> {
    let document = parse(text).map_err(|fault| vec![fault])?;
    let mut reading = Reading::new(&document);
    let root = document.root_element();
    if root.tag_name().name() != "mujoco" {
        reading.fault(root, "an MJCF file is a <mujoco>");
    }
    let mut file = File {
        angles: Angles::read(root, &mut reading),
        classes: Classes::read(root),
        description: Description {
            gravity: Some(gravity(root, &mut reading)),
            only_driven: true,
            ..Description::default()
        },
        reading,
        automatic: true,
    };
    file.automatic = !Reading::children(root, "compiler").any(|node| node.attribute("autolimits") == Some("false"));
    for node in root.children().filter(Node::is_element) {
        match node.tag_name().name() {
            "worldbody" => file.world(node),
            "actuator" => file.actuators(node),
            "equality" => file.equalities(node),
            "contact" => {}
            word if SILENT.contains(&word) => {}
            _ => file.reading.note(node, true, format!("{} is not read", shown(node))),
        }
    }
    let File { mut description, reading, .. } = file;
    description.notes = reading.notes;
    if reading.faults.is_empty() { Ok(description) } else { Err(reading.faults) }
}

/// Observer's axes, m/s²; that of the earth where the file says nothing.
fn gravity<'a>(root: Node<'a, 'a>, reading: &mut Reading<'a>) -> Triple {
    let option = Reading::children(root, "option").find(|node| node.attribute("gravity").is_some());
    option.and_then(|option| reading.numbers(option, "gravity")).unwrap_or([0.0, 0.0, -9.81])
}

/// A file while it is read.
struct File<'a> {
    angles: Angles,
    classes: Classes<'a>,
    description: Description,
    reading: Reading<'a>,
    /// A range limits without being told to.
    automatic: bool,
}

impl<'a> File<'a> {
    fn world(&mut self, node: Node<'a, 'a>) {
        let name = "world".to_owned();
        self.description.links.push(Link { name: name.clone(), at: self.reading.at(node), inertial: None });
        self.inside(node, &name, None);
    }

    /// Bodies and sites of a body.
    fn inside(&mut self, node: Node<'a, 'a>, parent: &str, class: Option<&'a str>) {
        for child in node.children().filter(Node::is_element) {
            match child.tag_name().name() {
                "body" => self.body(child, parent, class),
                "site" => self.site(child, parent, class),
                word if SILENT.contains(&word) => {}
                _ => self.reading.note(child, true, format!("{} is not read", shown(child))),
            }
        }
    }

    /// A named site is a frame.
    fn site(&mut self, node: Node<'a, 'a>, parent: &str, class: Option<&'a str>) {
        let Some(name) = node.attribute("name") else { return };
        let position = self.triple(node, "site", "pos", class);
        let rotation = self.angles.of(node, &mut self.reading);
        self.link(name.to_owned(), node, None);
        self.hang(node, name.to_owned(), (parent, name), JointKind::Fixed, (position, rotation));
    }

    fn body(&mut self, node: Node<'a, 'a>, parent: &str, class: Option<&'a str>) {
        let class = node.attribute("childclass").or(class);
        let name = match node.attribute("name") {
            Some(name) => name.to_owned(),
            None => format!("body_{}", self.description.links.len()),
        };
        let position = self.triple(node, "body", "pos", class);
        let rotation = self.angles.of(node, &mut self.reading);
        let inertial = self.reading.child(node, "inertial").and_then(|inertial| self.mass_data(inertial));
        if inertial.is_none() && Reading::children(node, "geom").next().is_some() {
            self.reading.note(
                node,
                true,
                format!("{} has no <inertial>, and masses of geoms are not read: it has no mass", shown(node)),
            );
        }
        self.link(name.clone(), node, inertial);
        self.joints(node, &name, parent, (position, rotation), class);
        self.inside(node, &name, class);
    }

    /// The joints of a body, in their order.
    fn joints(
        &mut self,
        node: Node<'a, 'a>,
        name: &str,
        parent: &str,
        (mut position, mut rotation): (Triple, Rotation),
        class: Option<&'a str>,
    ) {
        let is_joint = |child: &Node<'a, 'a>| matches!(child.tag_name().name(), "joint" | "freejoint");
        let all: Vec<Node<'a, 'a>> = node.children().filter(is_joint).collect();
        let mut parent = parent.to_owned();
        for (index, &element) in all.iter().enumerate() {
            let own = match element.attribute("name") {
                Some(own) => own.to_owned(),
                None if all.len() == 1 => format!("{name}_joint"),
                None => format!("{name}_joint_{}", index + 1),
            };
            let free = element.tag_name().name() == "freejoint" || self.text(element, "type", class) == Some("free");
            if free {
                // Its pose is that in the world.
                self.hang(element, own, (&parent, name), JointKind::Floating, ([0.0; 3], Rotation::none()));
                return;
            }
            let anchor = self.triple(element, "joint", "pos", class);
            let moved = turned(&rotation.matrix, &anchor);
            position = std::array::from_fn(|i| position[i] + moved[i]);
            let last = index + 1 == all.len() && anchor == [0.0; 3];
            let child = if last { name.to_owned() } else { format!("{own}_frame") };
            if !last {
                self.link(child.clone(), element, None);
            }
            self.joint(element, own, (&parent, &child), (position, rotation), class);
            (parent, position, rotation) = (child, anchor.map(|c| -c), Rotation::none());
        }
        if parent != name {
            self.hang(node, format!("{name}_mount"), (&parent, name), JointKind::Fixed, (position, rotation));
        }
    }

    fn link(&mut self, name: String, node: Node<'a, 'a>, inertial: Option<Inertial>) {
        self.description.links.push(Link { name, at: self.reading.at(node), inertial });
    }

    /// A joint without laws.
    fn hang(
        &mut self,
        node: Node<'a, 'a>,
        name: String,
        (parent, child): (&str, &str),
        kind: JointKind,
        (position, rotation): (Triple, Rotation),
    ) {
        let at = self.reading.at(node);
        let (parent, child) = (parent.to_owned(), child.to_owned());
        self.description.joints.push(Joint { position, rotation, ..Joint::new(name, at, kind, parent, child) });
    }

    fn joint(
        &mut self,
        node: Node<'a, 'a>,
        name: String,
        (parent, child): (&str, &str),
        (position, rotation): (Triple, Rotation),
        class: Option<&'a str>,
    ) {
        let kind = match self.text(node, "type", class) {
            None | Some("hinge") => JointKind::Turning,
            Some("slide") => JointKind::Sliding,
            Some("ball") => JointKind::Ball,
            Some(word) => {
                self.reading.fault(node, format!("a joint is free, ball, slide or hinge, found `{word}`"));
                return;
            }
        };
        let unit = if kind == JointKind::Turning { self.angles.unit } else { 1.0 };
        let axis: Triple = self.numbers(node, "axis", class).unwrap_or([0.0, 0.0, 1.0]);
        let Some(axis) = direction(axis) else {
            self.reading.fault(node, "its axis is zero and has no direction");
            return;
        };
        let amount = |file: &mut Self, name: &str| match file.classes.carrier(node, "joint", name, class) {
            Some(carrier) => file.reading.amount(carrier, name),
            None => 0.0,
        };
        let [damping, friction, stiffness, armature] =
            ["damping", "frictionloss", "stiffness", "armature"].map(|name| amount(self, name));
        let number = |file: &mut Self, name: &str| {
            let carrier = file.classes.carrier(node, "joint", name, class);
            carrier.and_then(|carrier| file.reading.number(carrier, name)).unwrap_or(0.0) * unit
        };
        let [reference, rest] = ["ref", "springref"].map(|name| number(self, name));
        let range = self.numbers::<2>(node, "range", class).map(|range| range.map(|limit| limit * unit));
        let limited = match self.text(node, "limited", class) {
            Some("true") => true,
            Some("false") => false,
            _ => self.automatic,
        };
        let limits = range.filter(|_| limited).map_or([None; 2], |range| range.map(Some));
        let joint = Joint::new(name, self.reading.at(node), kind, parent.to_owned(), child.to_owned());
        if kind == JointKind::Ball && (friction > 0.0 || stiffness > 0.0 || armature > 0.0 || damping > 0.0) {
            self.reading.note(
                node,
                true,
                format!("damping, friction, stiffness and armature of the ball joint `{}` do not act", joint.name),
            );
        }
        let laws = Joint { damping, friction, stiffness, armature, rest, reference, limits, ..joint };
        self.description.joints.push(Joint { position, rotation, axis, ..laws });
    }

    fn mass_data(&mut self, node: Node<'a, 'a>) -> Option<Inertial> {
        let mass = self.reading.required_number(node, "mass");
        let center: Triple = self.reading.numbers(node, "pos").unwrap_or_default();
        let rotation = self.angles.of(node, &mut self.reading);
        let full: Option<[f64; 6]> = self.reading.numbers(node, "fullinertia");
        let diagonal: Option<Triple> = self.reading.numbers(node, "diaginertia");
        let tensor = match (full, diagonal) {
            (Some([xx, yy, zz, xy, xz, yz]), _) => [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]],
            (None, Some([a, b, c])) => [[a, 0.0, 0.0], [0.0, b, 0.0], [0.0, 0.0, c]],
            (None, None) => {
                self.reading.fault(node, "`diaginertia` or `fullinertia` is missing");
                return None;
            }
        };
        let inertia = if rotation == Rotation::none() { tensor } else { turned_tensor(&rotation.matrix, &tensor) };
        Some(Inertial { mass: mass?, center, inertia })
    }

    fn actuators(&mut self, section: Node<'a, 'a>) {
        for node in section.children().filter(Node::is_element) {
            let tag = node.tag_name().name();
            match node.attribute("joint") {
                Some(joint) => {
                    self.description.driven.push(joint.to_owned());
                    if tag != "motor" || node.attribute("gear").is_some() {
                        let text = format!(
                            "the input of {} is the effort of its joint: gains and gears are left to it",
                            shown(node)
                        );
                        self.reading.note(node, false, text);
                    }
                }
                None => self.reading.note(node, true, format!("{} acts on no joint and is not read", shown(node))),
            }
        }
    }

    fn equalities(&mut self, section: Node<'a, 'a>) {
        for node in section.children().filter(Node::is_element).filter(|node| node.attribute("active") != Some("false"))
        {
            match node.tag_name().name() {
                "connect" if node.attribute("body1").is_some() => {
                    let first = self.reading.required(node, "body1");
                    let second = node.attribute("body2").unwrap_or("world").to_owned();
                    let anchor = self.reading.numbers(node, "anchor");
                    if let (Some(first), Some(anchor)) = (first, anchor) {
                        let at = self.reading.at(node);
                        self.description.closures.push(Closure { at, links: [first, second], anchor });
                    } else {
                        self.reading.fault(node, "`body1` and `anchor` are needed");
                    }
                }
                "joint" => self.coupled(node),
                _ => self.reading.note(node, true, format!("the equality {} does not act", shown(node))),
            }
        }
    }

    /// `joint1 = c₀ + c₁ joint2`, both from their references.
    fn coupled(&mut self, node: Node<'a, 'a>) {
        let Some(first) = self.reading.required(node, "joint1") else { return };
        let coefficients: [f64; 5] = self.reading.numbers(node, "polycoef").unwrap_or([0.0, 1.0, 0.0, 0.0, 0.0]);
        let at = self.reading.at(node);
        let (Some(second), true) = (node.attribute("joint2"), coefficients[2..] == [0.0; 3]) else {
            self.reading.note(
                node,
                true,
                format!("the equality {} does not act: it is not linear in a second joint", shown(node)),
            );
            return;
        };
        let reference = |name: &str| {
            self.description.joints.iter().find(|joint| joint.name == name).map_or(0.0, |joint| joint.reference)
        };
        let [offset, multiplier, ..] = coefficients;
        let offset = reference(&first) + offset - multiplier * reference(second);
        let mimic = Mimic { at, joint: second.to_owned(), multiplier, offset };
        match self.description.joints.iter_mut().find(|joint| joint.name == first) {
            Some(joint) => joint.mimic = Some(mimic),
            None => self.reading.fault(node, format!("`{first}` is no joint of this file")),
        }
    }

    fn triple(&mut self, node: Node<'a, 'a>, tag: &str, name: &str, class: Option<&'a str>) -> Triple {
        let carrier = self.classes.carrier(node, tag, name, class);
        carrier.and_then(|carrier| self.reading.numbers(carrier, name)).unwrap_or_default()
    }

    fn numbers<const N: usize>(&mut self, node: Node<'a, 'a>, name: &str, class: Option<&'a str>) -> Option<[f64; N]> {
        self.classes.carrier(node, "joint", name, class).and_then(|carrier| self.reading.numbers(carrier, name))
    }

    fn text(&self, node: Node<'a, 'a>, name: &str, class: Option<&'a str>) -> Option<&'a str> {
        self.classes.carrier(node, "joint", name, class)?.attribute(name)
    }
}
