//! Scenes as MJCF files, for MuJoCo and for what reads its format.
//!
//! `numbers`: the scene where its joints have given values; `tree`: the joints, found from the places of bodies;
//! `masses`: inertias and armatures; `forces`, `contacts`: what acts, clause by clause; `parts`: attributes of joints,
//! tendons, actuators; `write`: the document, by `tag`.

mod contacts;
mod forces;
mod masses;
mod numbers;
mod parts;
mod tag;
mod tree;
mod write;

use std::fmt;

use gauss_codegen::Bodies;
use gauss_codegen::program::{ArgumentKind, Input, Program};

use crate::error::{KernelError, Mistakes};
use crate::model::Model;

use contacts::Contacts;
use forces::Forces;
use numbers::{MassData, SceneNumbers, Variable};
use parts::{JointAttributes, Parts};
use tree::JointTree;
use write::Document;

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

/// A scene without a counterpart in MJCF.
#[derive(Debug)]
#[non_exhaustive]
pub enum MjcfError {
    /// Mistakes of the scene.
    Scene(Mistakes),
    /// Parameters that are not given, given twice, or those of no body: each with its field.
    Parameters(KernelError),
    /// Clauses and bodies without a counterpart, each in a sentence.
    NoCounterpart(Vec<String>),
}

impl fmt::Display for MjcfError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            MjcfError::Scene(mistakes) => mistakes.fmt(f),
            MjcfError::Parameters(error) => error.fmt(f),
            MjcfError::NoCounterpart(list) => {
                let lines = list.iter().map(|line| format!("no counterpart in MJCF: {line}"));
                f.write_str(&lines.collect::<Vec<_>>().join("\n"))
            }
        }
    }
}

impl std::error::Error for MjcfError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            MjcfError::Scene(error) => Some(error),
            MjcfError::Parameters(error) => Some(error),
            MjcfError::NoCounterpart(_) => None,
        }
    }
}

impl Mjcf {
    /// The document of the only struct with `#[gauss(…)]` attributes in a text, with its parameters by name, in their
    /// units, matrices row after row.
    ///
    /// # Errors
    /// Mistakes of the scene and of its parameters; all that has no counterpart: poses that are no products of joints,
    /// constraints, fluids, modes, states of elements, loads that are not linear, tables, contacts other than those of
    /// spheres with planes.
    pub fn new(source: &str, parameters: &[(&str, &[f64])]) -> Result<Self, MjcfError> {
        let model = Model::from_source(source).map_err(MjcfError::Scene)?;
        let mut parts = Parts { mistakes: refuse(&model), ..Parts::default() };
        // States of elements stand among coordinates, and tables have no numbers.
        if has_states(&model) || !model.table_constants().is_empty() {
            return Err(MjcfError::NoCounterpart(parts.mistakes));
        }
        let kernel = model.kernel(parameters).map_err(MjcfError::Parameters)?;
        let read = kernel.numbers(parameters).map_err(MjcfError::Parameters)?;
        let bodies = Bodies::of_text(source).map_err(|error| MjcfError::NoCounterpart(vec![error.to_string()]))?;
        let scene = SceneNumbers::new(kernel, bodies, read);
        let tree =
            JointTree::of(&scene).map_err(|list| MjcfError::NoCounterpart([parts.mistakes.clone(), list].concat()))?;
        let masses = scene.masses();
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
        if parts.mistakes.is_empty() && reads_time(&scene) {
            parts.mistakes.push("the time `t` enters the equations, of which MJCF has no functions".to_owned());
        }
        let text = Document::new(&scene, &tree, &mut parts, &masses).written();
        if parts.mistakes.is_empty() {
            Ok(Self { text, lost: parts.lost })
        } else {
            Err(MjcfError::NoCounterpart(parts.mistakes))
        }
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
    scene.variables.iter().map(attributes).collect()
}

/// Whether places of bodies, what acts or what touches depends on the time, be it anywhere.
fn reads_time(scene: &SceneNumbers) -> bool {
    let methods = scene.kernel.model().derived.data.methods.iter();
    let own = methods.filter(|program| ["acceleration", "gaps", "friction"].contains(&&program.name[..]));
    let reads = |program: &Program| {
        let is_time = |input: &Input| match input {
            Input::Component { argument, .. } => program.arguments[*argument].kind == ArgumentKind::Time,
            Input::Number(_) => false,
        };
        program.code.inputs().iter().any(is_time)
    };
    own.chain([&scene.bodies.program]).any(reads)
}

fn has_states(model: &Model) -> bool {
    model.methods().any(|name| name == "configuration_rates")
}

/// Clauses that have no counterpart whatever their numbers are.
fn refuse(model: &Model) -> Vec<String> {
    let mut mistakes = Vec::new();
    let has = |method: &str| model.methods().any(|name| name == method);
    if model.description().is_constrained || has("position_residual") || has("velocity_residual") {
        mistakes.push(
            "constraints (`constraint`, a loop) hold exactly here; MuJoCo's equalities are springs with dampers"
                .to_owned(),
        );
    }
    if has_states(model) {
        mistakes.push("elements with states (`states`) are none of MuJoCo's actuators with activations".to_owned());
    }
    if !model.table_constants().is_empty() {
        mistakes.push(format!("tables ({}) have no counterpart", model.table_constants().join(", ")));
    }
    mistakes
}
