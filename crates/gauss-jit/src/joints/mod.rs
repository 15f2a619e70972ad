//! Scenes as trees of joints, found from their numbers: what documents for other programs are written of.
//!
//! `numbers`: the scene where its joints have given values; `motions`: joints of one coordinate, seen in the places of
//! bodies; `tree`: all of them; `masses`: velocities of bodies and armatures; `forces`, `contacts`: what acts, clause
//! by clause; `closures`: loops; `parts`: attributes of joints, tendons, actuators, contacts; `tag`: elements of XML.

mod closures;
mod contacts;
mod forces;
pub mod masses;
pub mod motions;
pub mod numbers;
pub mod parts;
pub mod tag;
pub mod tree;

use std::fmt;

use gauss_codegen::Bodies;
use gauss_codegen::program::{ArgumentKind, Input, Program};

use crate::error::{KernelError, Mistakes};
use crate::model::Model;

use closures::closures;
use contacts::Contacts;
use forces::Forces;
use numbers::{MassData, SceneNumbers, Variable};
use parts::{JointAttributes, Parts};
use tree::JointTree;

/// A scene without a counterpart in the format of a document.
#[derive(Debug)]
#[non_exhaustive]
pub enum DocumentError {
    /// Mistakes of the scene.
    Scene(Mistakes),
    /// Parameters that are not given, given twice, or those of no body: each with its field.
    Parameters(KernelError),
    /// Clauses and bodies without a counterpart.
    #[non_exhaustive]
    NoCounterpart {
        /// The format, such as `MJCF`.
        format: &'static str,
        /// Each in a sentence.
        list: Vec<String>,
    },
}

impl fmt::Display for DocumentError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            DocumentError::Scene(mistakes) => mistakes.fmt(f),
            DocumentError::Parameters(error) => error.fmt(f),
            DocumentError::NoCounterpart { format, list } => {
                let lines = list.iter().map(|line| format!("no counterpart in {format}: {line}"));
                f.write_str(&lines.collect::<Vec<_>>().join("\n"))
            }
        }
    }
}

impl std::error::Error for DocumentError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            DocumentError::Scene(error) => Some(error),
            DocumentError::Parameters(error) => Some(error),
            DocumentError::NoCounterpart { .. } => None,
        }
    }
}

/// A scene as a tree of joints with masses and with what acts on them.
pub struct JointScene {
    pub scene: SceneNumbers,
    pub tree: JointTree,
    pub masses: Vec<MassData>,
    pub parts: Parts,
    format: &'static str,
}

impl JointScene {
    /// Reads the only struct with `#[gauss(…)]` attributes in a text, with its parameters.
    ///
    /// # Errors
    /// Mistakes of the scene and of its parameters; poses that are no products of joints, modes, states of elements,
    /// tables. All else that has no counterpart is among the parts.
    pub fn new(source: &str, parameters: &[(&str, &[f64])], format: &'static str) -> Result<Self, DocumentError> {
        let none = |list: Vec<String>| DocumentError::NoCounterpart { format, list };
        let model = Model::from_source(source).map_err(DocumentError::Scene)?;
        let mut parts = Parts { mistakes: refuse(&model), ..Parts::default() };
        // States of elements stand among coordinates, and tables have no numbers.
        if has_states(&model) || !model.table_constants().is_empty() {
            return Err(none(parts.mistakes));
        }
        let kernel = model.kernel(parameters).map_err(DocumentError::Parameters)?;
        let read = kernel.numbers(parameters).map_err(DocumentError::Parameters)?;
        let bodies = Bodies::of_text(source).map_err(|error| none(vec![error.to_string()]))?;
        let scene = SceneNumbers::new(kernel, bodies, read);
        let tree = JointTree::of(&scene).map_err(|list| none([parts.mistakes.clone(), list].concat()))?;
        let masses = scene.masses();
        let has = |method: &str| model.methods().any(|name| name == method);
        if model.description().is_constrained || has("position_residual") || has("velocity_residual") {
            match closures(&scene, &tree) {
                Ok(found) => parts.closures = found,
                Err(mistake) => parts.mistakes.push(mistake),
            }
        }
        parts.joints = armatures(&scene, &tree, &masses, &mut parts.mistakes);
        match scene.mass_matrix(&scene.origin()) {
            _ if scene.bodies.elements.is_empty() => {}
            Some(_) => Forces::new(&scene, &tree, &mut parts).add(&masses),
            // Unless it was said of all states.
            None if parts.mistakes.is_empty() => parts.mistakes.push(
                "the speeds do not determine the rates of the joints where these are at 0: no force is known there"
                    .to_owned(),
            ),
            None => {}
        }
        parts.lost.extend(model.description().remarks.iter().filter(|own| own.ignored).map(|own| own.text.clone()));
        Contacts::new(&scene, &tree, &mut parts).add();
        Ok(Self { scene, tree, masses, parts, format })
    }

    /// A text of the format with what it has lost.
    ///
    /// # Errors
    /// All that has no counterpart.
    pub fn finished(self, text: String) -> Result<(String, Vec<String>), DocumentError> {
        let Parts { mistakes: list, lost, .. } = self.parts;
        if list.is_empty() { Ok((text, lost)) } else { Err(DocumentError::NoCounterpart { format: self.format, list }) }
    }

    /// Whether places of bodies, what acts or what touches depends on the time, be it anywhere.
    pub fn reads_time(&self) -> bool {
        let methods = self.scene.kernel.model().derived.data.methods.iter();
        let own = methods.filter(|program| ["acceleration", "gaps", "friction"].contains(&&program.name[..]));
        let reads = |program: &Program| {
            let is_time = |input: &Input| match input {
                Input::Component { argument, .. } => program.arguments[*argument].kind == ArgumentKind::Time,
                Input::Number(_) => false,
            };
            program.code.inputs().iter().any(is_time)
        };
        own.chain([&self.scene.bodies.program]).any(reads)
    }

    /// Rounding of places, which are differences of those of bodies from Ω.
    pub fn error_of_places(&self) -> f64 {
        let reach = self.tree.places.iter().map(|place| place.translation.vector.amax());
        1e-15 * reach.fold(1e-3, f64::max)
    }
}

/// Joints with their armatures.
fn armatures(
    scene: &SceneNumbers,
    tree: &JointTree,
    masses: &[MassData],
    mistakes: &mut Vec<String>,
) -> Vec<JointAttributes> {
    let found = masses::armatures(scene, tree, masses).unwrap_or_else(|list| {
        mistakes.extend(list);
        vec![0.0; scene.rates()]
    });
    let attributes = |own: &Variable| {
        if own.rates().any(|k| found[k] != found[own.rate]) {
            mistakes.push(format!("`{}` has an armature about each of its axes", own.name));
        }
        JointAttributes { armature: found[own.rate], ..JointAttributes::default() }
    };
    let mut list: Vec<JointAttributes> = scene.variables.iter().map(attributes).collect();
    // What follows a coordinate has nothing of its own.
    list.resize(tree.joints.len(), JointAttributes::default());
    list
}

fn has_states(model: &Model) -> bool {
    model.methods().any(|name| name == "configuration_rates")
}

/// Clauses that have no counterpart whatever their numbers are.
fn refuse(model: &Model) -> Vec<String> {
    let mut mistakes = Vec::new();
    if has_states(model) {
        mistakes.push("elements with states (`states`) are neither joints nor actuators".to_owned());
    }
    if !model.table_constants().is_empty() {
        mistakes.push(format!("tables ({}) have no counterpart", model.table_constants().join(", ")));
    }
    mistakes
}
