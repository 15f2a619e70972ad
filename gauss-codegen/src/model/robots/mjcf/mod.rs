//! MJCF → description, as <https://mujoco.readthedocs.io/en/stable/XMLreference.html> has it.
//!
//! | file | what it holds |
//! |---|---|
//! | `classes`, `rotations` | defaults of elements; the ways to write a rotation |
//! | `joints` | the joints of a body |
//! | `masses`, `meshes` | mass data: of `<inertial>`, of geoms, of the files of meshes |
//! | `relations` | equalities and tendons |
//! | `attach` | parts of other models |
//! | `include`, `replicate`, `labels` | the text of several files, and with copies, which have names of their own |
//! | `actuators`, `keys` | what drives joints; states with names |
//!
//! Of several joints in a body all but the last have a link of their own, without mass; so has one whose anchor is
//! not the origin of its body, which is then fixed to it.

mod actuators;
mod attach;
mod classes;
mod include;
mod joints;
mod keys;
mod labels;
mod masses;
mod meshes;
mod relations;
mod replicate;
mod rotations;

pub use self::include::included;
use roxmltree::Node;

use self::classes::Classes;
use self::rotations::Angles;
use super::description::{Description, Drive, Fault, Inertial, Joint, JointKind, Link};
use super::rotation::{Matrix, Rotation, Triple, multiply, turned};
use super::text::Text;
use super::xml::{Reading, Silent, parse, shown};

/// What says nothing of the motion: looks, contacts of which none are modelled, and how MuJoCo solves.
const SILENT: Silent = Silent {
    elements: &[
        "asset",
        "camera",
        "custom",
        "exclude",
        "extension",
        "geom",
        "light",
        "material",
        "mesh",
        "sensor",
        "size",
        "statistic",
        "visual",
    ],
    attributes: &[
        "actlimited",
        "actrange",
        "actuatorfrclimited",
        "actuatorfrcrange",
        "align",
        "apirate",
        "assetdir",
        "ccd_iterations",
        "ccd_tolerance",
        "childclass",
        "class",
        "conaffinity",
        "condim",
        "cone",
        "contype",
        "ctrllimited",
        "ctrlrange",
        "discardvisual",
        "exactmeshinertia",
        "file",
        "fitaabb",
        "fitscale",
        "forcelimited",
        "forcerange",
        "fovy",
        "friction",
        "fromto",
        "fusestatic",
        "gap",
        "group",
        "hfield",
        "impratio",
        "inertiagrouprange",
        "integrator",
        "iterations",
        "jacobian",
        "kd",
        "lengthrange",
        "ls_iterations",
        "ls_tolerance",
        "margin",
        "material",
        "mesh",
        "meshdir",
        "model",
        "mpos",
        "mquat",
        "noslip_iterations",
        "noslip_tolerance",
        "priority",
        "rgba",
        "sdf_initpoints",
        "sdf_iterations",
        "size",
        "solimp",
        "solimpfriction",
        "solimplimit",
        "solmix",
        "solref",
        "solreffriction",
        "solreflimit",
        "solver",
        "strippath",
        "texturedir",
        "time",
        "timestep",
        "tolerance",
        "torquescale",
        "type",
        "user",
        "width",
    ],
};

/// The link that holds all others.
const WORLD: &str = "world";

/// Where something is in the axes of what it is in.
type Place = (Triple, Matrix);

/// # Errors
/// Everything that is wrong in the elements of the file, each by itself.
pub fn read(text: &Text) -> Result<Description, Vec<Fault>> {
    model(text, None).map(|model| model.description)
}

/// What a file says, with what those need that attach it.
struct Model {
    description: Description,
    sites: Vec<(String, String)>,
    controls: Vec<Option<usize>>,
}

/// A whole file, or a part that is attached with a prefix.
fn model(text: &Text, prefix: Option<&str>) -> Result<Model, Vec<Fault>> {
    let document = parse(&text.whole).map_err(|fault| vec![fault])?;
    let mut reading = Reading::new(&document, text);
    let root = document.root_element();
    if root.tag_name().name() != "mujoco" {
        reading.fault(root, "an MJCF file is a <mujoco>");
    }
    let mut file = File {
        angles: Angles::read(root, &mut reading),
        classes: Classes::read(root, &reading),
        description: Description { only_driven: true, ..Description::default() },
        automatic: true,
        geoms: Geoms::Missing,
        total_mass: None,
        sites: Vec::new(),
        controls: Vec::new(),
        meshes: Vec::new(),
        prefix: prefix.unwrap_or_default().to_owned(),
        attached: Vec::new(),
        bodies: root
            .descendants()
            .filter(|node| node.tag_name().name() == "body")
            .filter_map(|body| body.attribute("name").map(str::to_owned))
            .collect(),
        reading,
    };
    file.classes.refuse_strange(root, &mut file.reading);
    file.description.gravity = Some(file.gravity(root));
    file.compiler(root);
    // What follows names joints, which are all in the world.
    for world in file.reading.children(root, "worldbody") {
        file.world(world);
    }
    // What attaches the file weighs it.
    if prefix.is_none() {
        file.scale_masses();
    }
    file.reading.children(root, "tendon").into_iter().for_each(|section| file.tendons(section));
    file.reading.children(root, "equality").into_iter().for_each(|section| file.equalities(section));
    file.reading.children(root, "actuator").into_iter().for_each(|section| file.actuators(section));
    file.add_drives_of_attached();
    file.reading.children(root, "keyframe").into_iter().for_each(|section| file.keys(section));
    for contact in file.reading.children(root, "contact") {
        let shown = file.reading.children(contact, "exclude").len();
        if shown > 0 {
            file.reading.note(contact, "contacts are not modelled, so that none is to be excluded");
            file.reading.children(contact, "exclude").into_iter().for_each(|node| file.reading.pass(node));
        }
    }
    file.reading.note_unread(&SILENT);
    let File { mut description, reading, sites, controls, .. } = file;
    description.notes = reading.notes;
    if reading.faults.is_empty() { Ok(Model { description, sites, controls }) } else { Err(reading.faults) }
}

/// Which bodies have the masses of their geoms.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Geoms {
    /// Those without `<inertial>`.
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
    /// What all bodies weigh together, where masses are to be scaled to that.
    total_mass: Option<f64>,
    /// Names of bodies.
    bodies: Vec<String>,
    /// Names of sites, with those of their links.
    sites: Vec<(String, String)>,
    /// Of each actuator the index of its drive, if it is read.
    controls: Vec<Option<usize>>,
    /// Meshes that were read, of density one; `None` of those with a mistake.
    meshes: Vec<(String, Option<Inertial>)>,
    /// Before the names of bodies that have none.
    prefix: String,
    /// Drives of models that are attached, and their controls: they come after those of the file.
    attached: Vec<(Vec<Drive>, Vec<Option<usize>>)>,
}

impl<'a> File<'a> {
    /// Observer's axes, m/s²; that of the earth where the file says nothing.
    fn gravity(&mut self, root: Node<'a, 'a>) -> Triple {
        let mut gravity = [0.0, 0.0, -9.81];
        for option in self.reading.children(root, "option") {
            gravity = self.reading.numbers(option, "gravity").unwrap_or(gravity);
            for flag in self.reading.children(option, "flag") {
                if self.reading.text(flag, "gravity") == Some("disable") {
                    gravity = [0.0; 3];
                }
                if flag.attributes().any(|attribute| attribute.name() != "gravity") {
                    self.reading.note(flag, "of <flag> `gravity` alone is read");
                    self.reading.pass(flag);
                }
            }
        }
        gravity
    }

    fn compiler(&mut self, root: Node<'a, 'a>) {
        for node in self.reading.children(root, "compiler") {
            self.automatic &= self.reading.text(node, "autolimits") != Some("false");
            match self.reading.text(node, "inertiafromgeom") {
                Some("true") => self.geoms = Geoms::All,
                Some("false") => self.geoms = Geoms::None,
                _ => {}
            }
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
            self.description.links.push(Link { name: name.clone(), at: self.reading.at(node), inertial: None });
        }
        self.inside(node, &name, None, &([0.0; 3], Rotation::none().matrix));
    }

    /// Bodies, frames and sites of a body; those of a frame are placed in it.
    fn inside(&mut self, node: Node<'a, 'a>, parent: &str, class: Option<&'a str>, place: &Place) {
        for child in node.children().filter(Node::is_element) {
            match child.tag_name().name() {
                "body" => self.body(child, parent, class, place),
                "site" => self.site(child, parent, class, place),
                "attach" => self.attach(child, parent, place),
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

    /// The place of an element in that of what it is in.
    fn placed(&mut self, node: Node<'a, 'a>, tag: &'static str, class: Option<&'a str>, (at, matrix): &Place) -> Place {
        let position = self.triple(node, tag, "pos", class);
        let rotation = self.angles.of(node, &mut self.reading);
        let moved = turned(matrix, &position);
        (std::array::from_fn(|i| at[i] + moved[i]), multiply(matrix, &rotation.matrix))
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
        self.joints(node, &name, parent, (position, Rotation::from_matrix(&matrix)), class);
        self.inside(node, &name, class, &([0.0; 3], Rotation::none().matrix));
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

    /// The same of any count.
    fn list(
        &mut self,
        node: Node<'a, 'a>,
        tags: &[&str],
        name: &'static str,
        class: Option<&'a str>,
    ) -> Option<Vec<f64>> {
        let carrier = self.classes.carrier((node, tags), name, class, &self.reading)?;
        self.reading.list(carrier, name)
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
