//! Scenes as URDF files. `write`: the document.

mod write;

use crate::joints::{DocumentError, JointScene};

use write::UrdfDocument;

/// A scene with numbers for its parameters as a URDF document.
///
/// Links with their masses hang on the joints of the scene, which are found from the places of bodies, whatever clauses
/// wrote them. Ranges are limits, damping and dry friction of single joints are dynamics, coordinates that move several
/// joints are mimicked; inputs along single joints and armatures are transmissions. All other loads and contacts are
/// lost, each with a sentence.
#[derive(Clone, Debug)]
pub struct Urdf {
    text: String,
    lost: Vec<String>,
}

impl Urdf {
    /// The document of the only struct with `#[gauss(…)]` attributes in a text, with its parameters by name, in their
    /// units, matrices row after row.
    ///
    /// # Errors
    /// Mistakes of the scene and of its parameters; motions and masses without a counterpart: poses that are no
    /// products of joints, ball joints, constraints, fluids, modes, states of elements, tables.
    pub fn new(source: &str, parameters: &[(&str, &[f64])]) -> Result<Self, DocumentError> {
        let mut own = JointScene::new(source, parameters, "URDF")?;
        if !own.parts.closures.is_empty() {
            own.parts.mistakes.push("loops (`constraint`) are none of a tree of links".to_owned());
        }
        lose_loads(&mut own);
        let text = UrdfDocument::new(&mut own).written();
        let (text, lost) = own.finished(text)?;
        Ok(Self { text, lost })
    }

    /// The document.
    #[must_use]
    pub fn xml(&self) -> &str {
        &self.text
    }

    /// Sentences about what of the scene the document does not have; they are comments of the document as well.
    #[must_use]
    pub fn lost(&self) -> &[String] {
        &self.lost
    }
}

/// A sentence for each load and each contact that URDF does not have.
fn lose_loads(own: &mut JointScene) {
    let (scene, parts) = (&own.scene, &own.parts);
    let description = scene.kernel.model().description();
    let mut lost = Vec::new();
    let gravity = scene.gravity();
    if gravity.amax() > 0.0 {
        let [x, y, z] = [gravity.x, gravity.y, gravity.z];
        lost.push(format!("gravity is lost, ({x}, {y}, {z}) m/s²: it is for who reads the file"));
    }
    let load = |name| format!("of `{name}` nothing is left but what damps single joints, and inputs along them");
    lost.extend(parts.loads.iter().map(load));
    let is_left = |name: &String| parts.motors.iter().any(|own| own.name == *name && own.joint().is_some());
    let input = |name| format!("the input `{name}` is lost: it is proportional to no force along a single joint");
    lost.extend(scene.inputs.iter().filter(|name| !is_left(name)).map(input));
    let contact = |name| format!("the contact `{name}` is lost: URDF has shapes, not what touches what, nor friction");
    let contacts = description.contacts.iter().map(|own| &own.name).filter(|name| !parts.stops.contains(name));
    lost.extend(contacts.map(contact));
    let bounces = scene.kernel.call("restitution", &[&[0.0], &scene.configuration(&scene.origin())]);
    if bounces.is_ok_and(|all| all.iter().any(|e| *e != 0.0)) {
        lost.push("restitution is lost".to_owned());
    }
    if own.reads_time() {
        lost.push("what depends on the time `t` is lost".to_owned());
    }
    own.parts.lost.extend(lost);
}
