//! MJCF → description, as <https://mujoco.readthedocs.io/en/stable/XMLreference.html> has it.
//!
//! | file | what it holds |
//! |---|---|
//! | `classes`, `rotations` | defaults of elements; the ways to write a rotation |
//! | `joints` | the joints of a body |
//! | `collisions`, `pairs` | geoms that touch, and what is kept from touching; pairs that touch in any case |
//! | `masses`, `shells`, `meshes`, `bounds` | mass data: of `<inertial>`, of geoms, of files; what they are at least |
//! | `options`, `disabled` | gravity, what is switched off |
//! | `reference` | of every attribute what becomes of it |
//! | `relations` | equalities and tendons |
//! | `attach` | parts of other models, and of the same |
//! | `include`, `replicate`, `labels` | the text of several files, and with copies, which have names of their own |
//! | `actuators`, `gains`, `ratios` | what drives joints, and by how much |
//! | `keys` | states with names |
//!
//! Of several joints in a body all but the last have a link of their own, without mass; so has one whose anchor is
//! not the origin of its body, which is then fixed to it.

mod actuators;
mod attach;
mod bounds;
mod classes;
mod collisions;
mod disabled;
mod gains;
mod grammar;
mod include;
mod joints;
#[cfg(test)]
mod joints_tests;
mod keys;
mod labels;
mod masses;
mod meshes;
mod options;
mod pairs;
mod ratios;
mod reference;
mod relations;
mod replicate;
mod rotations;
mod shells;
#[cfg(test)]
mod tests;

pub use self::include::included;
use roxmltree::Node;

use self::bounds::Bounds;
use self::classes::Classes;
use self::disabled::Disabled;
use self::grammar::refuse_other_types;
use self::reference::ELEMENTS;
use self::rotations::{Angles, ORIENTATION};
use super::description::{Description, Drive, Fault, Inertial, Joint, JointKind, Link, Note};
use super::rotation::{Matrix, Rotation, Triple, multiply, turned};
use super::text::Text;
use super::xml::{Reading, own_descendants, own_elements, parse, shown};

/// The link that holds all others.
const WORLD: &str = "world";

/// The pose of an element relative to the element around it: position and rotation.
type Place = (Triple, Matrix);

/// An element, the class around it, and the pose of the element around it.
type Framed<'a> = (Node<'a, 'a>, Option<&'a str>, Place);

/// # Errors
/// Everything that is wrong in the elements of the file, each by itself.
pub fn read(text: &Text) -> Result<Description, Vec<Fault>> {
    model(text, None).map(|model| model.description)
}

/// The description in a file, with the data that a file needs which attaches it.
struct Model {
    description: Description,
    sites: Vec<(String, String)>,
    controls: Vec<Option<usize>>,
}

/// A whole file, or a part that another attaches with a prefix.
fn model(text: &Text, around: Option<(&str, &File<'_>)>) -> Result<Model, Vec<Fault>> {
    let document = parse(&text.whole).map_err(|fault| vec![fault])?;
    let mut reading = Reading::new(&document, text, ELEMENTS);
    let root = document.root_element();
    if root.tag_name().name() != "mujoco" {
        reading.fault(root, "an MJCF file is a <mujoco>");
    }
    let mut file = File {
        angles: Angles::read(root, &mut reading),
        classes: Classes::read(root, &mut reading),
        description: Description { only_driven: true, ..Description::default() },
        automatic: true,
        geoms: Geoms::Missing,
        groups: [0.0, 5.0],
        bounds: Bounds::default(),
        disabled: Disabled::default(),
        total_mass: None,
        sites: Vec::new(),
        controls: Vec::new(),
        meshes: Vec::new(),
        mass_notes: Vec::new(),
        is_part: around.is_some(),
        prefix: around.map_or("", |(prefix, _)| prefix).to_owned(),
        attached: Vec::new(),
        tuned: Vec::new(),
        bodies: own_descendants(root)
            .filter(|node| node.has_tag_name("body"))
            .filter_map(|body| body.attribute("name").map(str::to_owned))
            .collect(),
        reading,
    };
    file.classes.refuse_strange(root, &mut file.reading);
    file.options(root, around.map(|(_, file)| file));
    file.compiler(root);
    // What follows names joints, which are all in the world.
    for world in file.reading.children(root, "worldbody") {
        file.world(world);
    }
    // What attaches the file weighs it.
    if around.is_none() {
        file.scale_masses();
    }
    file.tune();
    file.reading.children(root, "tendon").into_iter().for_each(|section| file.tendons(section));
    file.reading.children(root, "equality").into_iter().for_each(|section| file.equalities(section));
    file.reading.children(root, "actuator").into_iter().for_each(|section| file.actuators(section));
    file.add_drives_of_attached();
    file.reading.children(root, "keyframe").into_iter().for_each(|section| file.keys(section));
    file.switch_off();
    // Masses and attached models look for the assets they need; the other assets have no effect on the motion.
    for asset in file.reading.children(root, "asset") {
        for tag in ["mesh", "model"] {
            file.reading.children(asset, tag);
        }
    }
    file.contacts(root);
    refuse_other_types(root, &mut file.reading);
    file.reading.note_unread();
    let File { mut description, reading, sites, controls, .. } = file;
    description.notes = reading.notes;
    if reading.faults.is_empty() { Ok(Model { description, sites, controls }) } else { Err(reading.faults) }
}

/// Which bodies have the masses of their geoms.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Geoms {
    /// Bodies without `<inertial>`.
    Missing,
    All,
    None,
}

/// A file while it is read.
struct File<'a> {
    angles: Angles,
    classes: Classes<'a>,
    description: Description,
    reading: Reading<'a>,
    /// A range limits without being told to.
    automatic: bool,
    geoms: Geoms,
    /// The least and the largest group of geoms that have masses.
    groups: [f64; 2],
    bounds: Bounds,
    disabled: Disabled,
    /// Mass of all bodies together, where masses are to be scaled to that.
    total_mass: Option<f64>,
    /// Names of bodies.
    bodies: Vec<String>,
    /// Names of sites, with those of their links.
    sites: Vec<(String, String)>,
    /// Index of the drive of each actuator, if it is read.
    controls: Vec<Option<usize>>,
    /// Meshes that were read, of density one; `None` of those with a mistake.
    meshes: Vec<(String, Option<Inertial>)>,
    /// Notes on the masses of geoms of the body that is being read.
    mass_notes: Vec<Note>,
    /// Another file attaches it.
    is_part: bool,
    /// Before the names of bodies that have none.
    prefix: String,
    /// Drives of models that are attached, and their controls: they come after those of the file.
    attached: Vec<(Vec<Drive>, Vec<Option<usize>>)>,
    /// Joints whose springs are said by times and ratios.
    tuned: Vec<(Node<'a, 'a>, String, [f64; 2])>,
}

impl<'a> File<'a> {
    fn compiler(&mut self, root: Node<'a, 'a>) {
        for node in self.reading.children(root, "compiler") {
            self.automatic &= self.reading.text(node, "autolimits") != Some("false");
            match self.reading.text(node, "inertiafromgeom") {
                Some("true") => self.geoms = Geoms::All,
                Some("false") => self.geoms = Geoms::None,
                _ => {}
            }
            self.groups = self.reading.numbers(node, "inertiagrouprange").unwrap_or(self.groups);
            self.bounds.read(node, &mut self.reading);
            // Zero and less mean that nothing is scaled.
            self.total_mass = self.reading.number(node, "settotalmass").filter(|mass| *mass > 0.0).or(self.total_mass);
            if self.reading.text(node, "coordinate").is_some_and(|word| word != "local") {
                self.reading.fault(node, "places are relative to parents, `coordinate=\"local\"`");
            }
        }
    }

    fn world(&mut self, node: Node<'a, 'a>) {
        let name = WORLD.to_owned();
        if !self.description.links.iter().any(|link| link.name == name) {
            self.link(name.clone(), node, None);
        }
        self.inside(node, &name, None, &([0.0; 3], Rotation::none().matrix));
    }

    /// Bodies, frames and sites of a body; those of a frame are placed in it.
    fn inside(&mut self, node: Node<'a, 'a>, parent: &str, class: Option<&'a str>, place: &Place) {
        for child in own_elements(node) {
            match child.tag_name().name() {
                "body" => self.body(child, parent, class, place),
                "site" => self.site(child, parent, class, place),
                "attach" => self.attach(child, parent, place),
                "geom" => self.collision(child, parent, class, place),
                "frame" => {
                    self.reading.see(child);
                    let class = self.reading.text(child, "childclass").or(class);
                    let own = self.placed(child, "frame", class, place);
                    self.inside(child, parent, class, &own);
                }
                _ => {}
            }
        }
    }

    /// Elements of some names in a body, and in frames of it: each with the class around it and its frame, in the axes
    /// of the body.
    fn framed(&mut self, node: Node<'a, 'a>, class: Option<&'a str>, names: &[&str]) -> Vec<Framed<'a>> {
        let mut all = Vec::new();
        self.gather((node, class, ([0.0; 3], Rotation::none().matrix)), names, &mut all);
        all
    }

    fn gather(&mut self, (node, class, place): Framed<'a>, names: &[&str], all: &mut Vec<Framed<'a>>) {
        for child in own_elements(node) {
            match child.tag_name().name() {
                "frame" => {
                    let class = self.reading.text(child, "childclass").or(class);
                    let own = self.placed(child, "frame", class, &place);
                    self.gather((child, class, own), names, all);
                }
                name if names.contains(&name) => all.push((child, class, place)),
                _ => {}
            }
        }
    }

    /// The pose of an element, from that of the element around it.
    fn placed(&mut self, node: Node<'a, 'a>, tag: &'static str, class: Option<&'a str>, (at, matrix): &Place) -> Place {
        let position = self.triple(node, tag, "pos", class);
        let rotation = self.rotation(node, &[tag], class);
        let moved = turned(matrix, &position);
        (std::array::from_fn(|i| at[i] + moved[i]), multiply(matrix, &rotation.matrix))
    }

    /// The rotation of an element, or of the defaults of its class.
    fn rotation(&mut self, node: Node<'a, 'a>, tags: &[&str], class: Option<&'a str>) -> Rotation {
        let is_written = |element: &Node<'a, 'a>| ORIENTATION.iter().any(|way| element.attribute(*way).is_some());
        let carrier = self.classes.nearest((node, tags), class, &self.reading).find(is_written);
        carrier.map_or(Rotation::none(), |carrier| self.angles.of(carrier, &mut self.reading))
    }

    /// A named site is a frame.
    fn site(&mut self, node: Node<'a, 'a>, parent: &str, class: Option<&'a str>, place: &Place) {
        self.reading.see(node);
        let (position, matrix) = self.placed(node, "site", class, place);
        let Some(name) = self.reading.text(node, "name") else { return };
        // Sites have names of their own.
        let taken = |name: &str| self.bodies.iter().any(|body| body == name);
        let called = if taken(name) { format!("{name}_site") } else { name.to_owned() };
        self.sites.push((name.to_owned(), called.clone()));
        let name = called;
        self.link(name.clone(), node, None);
        let rotation = Rotation::from_matrix(&matrix);
        self.hang(node, format!("{name} mount"), (parent, &name), JointKind::Fixed, (position, rotation));
    }

    fn body(&mut self, node: Node<'a, 'a>, parent: &str, class: Option<&'a str>, place: &Place) {
        self.reading.see(node);
        let class = self.reading.text(node, "childclass").or(class);
        let name = match self.reading.text(node, "name") {
            Some(name) => name.to_owned(),
            None => format!("{}body_{}", self.prefix, self.description.links.len()),
        };
        let (position, matrix) = self.placed(node, "body", class, place);
        let inertial = self.inertial(node, class);
        self.link(name.clone(), node, inertial);
        if let (Some(held), Some(link)) = (self.reading.number(node, "gravcomp"), self.description.links.last_mut()) {
            link.held = held;
        }
        self.joints(node, &name, parent, (position, Rotation::from_matrix(&matrix)), class);
        self.inside(node, &name, class, &([0.0; 3], Rotation::none().matrix));
    }

    fn link(&mut self, name: String, node: Node<'a, 'a>, inertial: Option<Inertial>) {
        let mass_notes = std::mem::take(&mut self.mass_notes);
        self.description.links.push(Link { name, at: self.reading.at(node), inertial, mass_notes, held: 0.0 });
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

    fn triple(&mut self, node: Node<'a, 'a>, tag: &'static str, name: &'static str, class: Option<&'a str>) -> Triple {
        self.numbers(node, &[tag], name, class).unwrap_or_default()
    }

    /// Numbers of an element, or of the defaults of its class.
    fn numbers<const N: usize>(
        &mut self,
        node: Node<'a, 'a>,
        tags: &[&str],
        name: &'static str,
        class: Option<&'a str>,
    ) -> Option<[f64; N]> {
        let carrier = self.classes.carrier((node, tags), name, class, &self.reading)?;
        self.reading.numbers(carrier, name)
    }

    /// The same of any count. An element with fewer numbers than the defaults of its class keeps the rest of theirs.
    fn list(
        &mut self,
        node: Node<'a, 'a>,
        tags: &[&str],
        name: &'static str,
        class: Option<&'a str>,
    ) -> Option<Vec<f64>> {
        let carriers = self.classes.nearest((node, tags), class, &self.reading);
        let carriers: Vec<_> = carriers.filter(|element| element.attribute(name).is_some()).collect();
        let mut numbers: Option<Vec<f64>> = None;
        for carrier in carriers {
            let own = self.reading.list(carrier, name)?;
            let numbers = numbers.get_or_insert_default();
            numbers.extend(own.into_iter().skip(numbers.len()));
        }
        numbers
    }

    fn text(&self, node: Node<'a, 'a>, tags: &[&str], name: &'static str, class: Option<&'a str>) -> Option<&'a str> {
        let carrier = self.classes.carrier((node, tags), name, class, &self.reading)?;
        self.reading.text(carrier, name)
    }

    /// Notes what an element does that is not modelled.
    fn ignored(&mut self, node: Node<'a, 'a>, why: &str) {
        self.reading.ignored(node, format!("{} does not act: {why}", shown(node)));
        self.reading.pass(node);
    }
}
