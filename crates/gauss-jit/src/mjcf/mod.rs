//! Scenes as MJCF files, for MuJoCo and for what reads its format.
//!
//! `masses`: what MuJoCo takes for an inertia; `write`: the document.

mod masses;
mod write;

use crate::joints::parts::SphereContact;
use crate::joints::{DocumentError, JointScene};

use write::{MjcfDocument, POINT};

/// A scene with numbers for its parameters as an MJCF document.
///
/// A joint for each coordinate is found from the places of bodies, whatever clauses wrote them; masses are those of the
/// bodies, and the mass matrix is held to them at states of general position. Each element of the loads is known by its
/// generalised forces. What is none of that is an error with its clause.
#[derive(Clone, Debug)]
pub struct Mjcf {
    text: String,
    lost: Vec<String>,
}

impl Mjcf {
    /// The document of the only struct with `#[gauss(…)]` attributes in a text, with its parameters by name, in their
    /// units, matrices row after row.
    ///
    /// # Errors
    /// Mistakes of the scene and of its parameters; all that has no counterpart: poses that are no products of joints,
    /// constraints, fluids, modes, states of elements, loads that are not linear, tables, contacts other than those of
    /// spheres with planes and with each other.
    pub fn new(source: &str, parameters: &[(&str, &[f64])]) -> Result<Self, DocumentError> {
        let mut own = JointScene::new(source, parameters, "MJCF")?;
        let acting = std::mem::take(&mut own.parts.acting);
        own.parts.mistakes.extend(acting);
        if own.parts.mistakes.is_empty() && own.reads_time() {
            own.parts.mistakes.push("the time `t` enters the equations, of which MJCF has no functions".to_owned());
        }
        lose_softness(&mut own);
        let text = MjcfDocument::new(&mut own).written();
        let (text, lost) = own.finished(text)?;
        Ok(Self { text, lost })
    }

    /// The document.
    #[must_use]
    pub fn xml(&self) -> &str {
        &self.text
    }

    /// Sentences about what MuJoCo does in another way than the scene; they are comments of the document as well.
    #[must_use]
    pub fn lost(&self) -> &[String] {
        &self.lost
    }
}

/// Sentences about contacts and equalities, which are exact here.
fn lose_softness(own: &mut JointScene) {
    let (parts, lost) = (&own.parts, &mut Vec::new());
    for own in parts.contacts.iter().filter(|own| own.turns) {
        lost.push(format!("friction of drilling and rolling of `{}` is lost", own.name));
    }
    let spheres = parts.contacts.iter().flat_map(SphereContact::spheres);
    let points = spheres.filter(|(_, own)| own.radius.is_none()).map(|(name, _)| format!("`{name}`"));
    let points = points.collect::<Vec<_>>().join(", ");
    if !points.is_empty() {
        lost.push(format!("points touch as spheres of {POINT:e} m, since MuJoCo has none without size: {points}"));
    }
    if !own.scene.kernel.model().description().contacts.is_empty() {
        lost.push(
            "contacts, ranges and dry friction are exact here and soft in MuJoCo, by `solref` and `solimp`".to_owned(),
        );
    }
    let bounces = own.scene.kernel.call("restitution", &[&[0.0], &own.scene.configuration(&own.scene.origin())]);
    if bounces.is_ok_and(|all| all.iter().any(|e| *e != 0.0)) {
        lost.push("restitution is lost: in MuJoCo a contact bounces by `solref`".to_owned());
    }
    let follows = own.tree.followers().map(|(place, joint)| {
        let [name, leader] = [place, joint.variable].map(|k| &own.tree.names[k]);
        format!("`{name}` follows `{leader}` exactly here; in MuJoCo it is a joint that a soft equality holds")
    });
    lost.extend(follows);
    if !own.parts.closures.is_empty() {
        lost.push(
            "loops hold exactly here; in MuJoCo they are soft equalities (`solref`, `solimp`) that leave out how their directions turn"
                .to_owned(),
        );
    }
    own.parts.lost.append(lost);
}
