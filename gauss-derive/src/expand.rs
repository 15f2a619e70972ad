//! The pipeline on one screen: parse → derive → check → lower → emit.

use proc_macro2::TokenStream;
use syn::DeriveInput;

use crate::algebra::{Expr, Graph, Map, Rational};
use crate::emit::{Derived, Plain, Subject, SystemSubject, emit};
use crate::kernel::{Candidates, Cost, Kernel, Literals};
use crate::mechanics::{
    Acting, ConfigurationKind, Elimination, Formula, Linearization, Method, Scene, System, check_against_definition,
    check_system_against_definition, rotation_of_quaternion,
};
use crate::mistakes::{
    bug, eliminate, refuse_curved_kinematics, refuse_idle_speeds, refuse_series, refuse_too_much, system_faults,
};
use crate::model::{self, Model, SystemModel};
use crate::translate::{Translator, body_shape};

/// Expands one struct.
///
/// # Errors
/// Every mistake of the struct, each at the token that is wrong.
pub fn expand(input: &DeriveInput) -> syn::Result<TokenStream> {
    match model::parse_scene(input)? {
        model::Scene::Body(model) => expand_body(&model),
        model::Scene::System(model) => expand_system(&model),
    }
}

fn expand_body(model: &Model) -> syn::Result<TokenStream> {
    let graph = Graph::new();
    let shape = body_shape(|role| model.shape(role));
    let mut translator = model.system.as_deref().map(|system| Translator::new(&graph, system)).transpose()?;
    let given = model.system.as_deref().map_or(&[][..], |system| &system.given);
    let assigned = translator.as_ref().map_or(Ok(Vec::new()), |translator| translator.assigned(given))?;
    let mut scene = Scene::new(&graph, model.motion, model.chart, shape, &assigned);
    if let Some(translator) = translator.as_mut().filter(|_| model.acted_upon) {
        let (observed, elements) = translator.on_one_body()?;
        let parameters = translator.parameters_of(&scene.body);
        let inputs = translator.inputs().to_vec();
        let acting = Acting::new(&observed, &scene.kinematics, &parameters, &elements, inputs);
        scene = scene.acted_upon(acting);
    }
    let mut formulas = scene.formulas();
    check_against_definition(&scene, &formulas).map_err(|error| bug(&model.ident, &error))?;
    let (quaternion, rotation) = rotation_entries(&graph, &scene);
    let linearization = model.wanted.linearize.then(|| Linearization::of_body(&scene, &formulas));
    if model.wanted.taylor.is_some() {
        formulas.push(scene.component_rates(quaternion, &formulas));
    }
    let functions: Vec<_> = formulas.iter().map(candidates).collect();
    let differentiated = linearization.as_ref().map(|l| &l.differentiated);
    let literals = translator.as_ref().map(Translator::literals).unwrap_or_default();
    let folded = foldable(&model.scalar, &literals);
    let kernel = Kernel::lower(&graph, &functions, &joined(&formulas), &rotation, differentiated, folded)
        .map_err(|error| bug(&model.ident, &error))?;
    if graph.overflowed() {
        return Err(bug(&model.ident, &"a coefficient left the range of 64-bit fractions"));
    }
    let has_inputs = translator.as_ref().is_some_and(|translator| !translator.inputs().is_empty());
    refuse_series(model.wanted.taylor.as_ref(), has_inputs, &formulas, &kernel)?;
    let plain = model.system.as_deref().zip(translator.as_ref()).map(|(system, translator)| Plain {
        fields: &system.fields,
        sources: translator.sources(),
        literals: &literals,
        assigned: &assigned,
    });
    Ok(emit(&Derived {
        subject: Subject::Body { model, scene: &scene, quaternion, plain },
        drags: &translator.as_ref().map(Translator::drags).unwrap_or_default(),
        formulas: &formulas,
        kernel: &kernel,
        linearization: linearization.as_ref(),
    }))
}

fn expand_system(model: &SystemModel) -> syn::Result<TokenStream> {
    let graph = Graph::new();
    let mut translator = Translator::new(&graph, model)?;
    let all: Vec<usize> = (0..translator.speeds().len()).collect();
    let speeds = translator.speeds().to_vec();
    let scene = translator.scene(&speeds, &all)?;
    refuse_curved_kinematics(model, &scene)?;
    let whole = System::new(scene);
    refuse_idle_speeds(model, &translator, &whole)?;
    let (system, elimination) = match &model.independent {
        Some(independent) => {
            let elimination = eliminate(model, &translator, whole, independent)?;
            let kept = translator.indices_of_speeds(independent);
            let mut scene = translator.scene(&elimination.values, &kept)?;
            scene.constraints.clear();
            (System::new(scene), Some(elimination))
        }
        None => (whole, None),
    };
    let mut formulas = system.formulas();
    check_system_against_definition(&system, &formulas)
        .map_err(|faults| system_faults(model, &translator, &system, &faults))?;
    formulas.extend(elimination.iter().flat_map(Elimination::formulas));
    let (quaternions, definitions) = system_rotations(&graph, &system);
    let linearization = model.wanted.linearize.then(|| Linearization::of_system(&system, &formulas));
    if model.wanted.taylor.is_some() {
        formulas.push(system.component_rates(&quaternions, &formulas));
    }
    let functions: Vec<_> = formulas.iter().map(candidates).collect();
    let differentiated = linearization.as_ref().map(|l| &l.differentiated);
    let literals = translator.literals();
    let folded = foldable(&model.scalar, &literals);
    let kernel = Kernel::lower(&graph, &functions, &joined(&formulas), &definitions, differentiated, folded)
        .map_err(|error| bug(&model.ident, &error))?;
    if graph.overflowed() {
        return Err(bug(&model.ident, &"a coefficient left the range of 64-bit fractions"));
    }
    refuse_too_much(model, &kernel)?;
    refuse_series(model.wanted.taylor.as_ref(), !model.inputs.is_empty(), &formulas, &kernel)?;
    let constrained = elimination.as_ref().map_or(&system, |elimination| &elimination.whole);
    let assigned_to_bodies =
        model.bodies.iter().map(|body| translator.assigned(&body.given)).collect::<syn::Result<Vec<_>>>()?;
    let subject = SystemSubject {
        model,
        system: &system,
        constraints: &constrained.constraints,
        can_drift: elimination.as_ref().map_or(!system.constraints.is_empty(), Elimination::can_drift),
        sources: translator.sources(),
        literals: &literals,
        assigned: &translator.assigned(&model.given)?,
        assigned_to_bodies: &assigned_to_bodies,
        links: &translator.links_of_clauses(),
        quaternions: &quaternions,
    };
    let drags = translator.drags();
    Ok(emit(&Derived {
        subject: Subject::System(subject),
        drags: &drags,
        formulas: &formulas,
        kernel: &kernel,
        linearization: linearization.as_ref(),
    }))
}

/// Literals that are numbers when the code is generated: of a generic scalar it is not known how it rounds them.
fn foldable<'a, 'g>(scalar: &model::Scalar, literals: &'a [(Rational, Expr<'g>)]) -> Literals<'a, 'g> {
    (!matches!(scalar, model::Scalar::Parameter(_))).then_some(literals)
}

/// What `evaluate` computes together.
fn joined(formulas: &[Formula<'_>]) -> Vec<usize> {
    let of = |method: &Method| formulas.iter().position(|formula| formula.method == *method);
    Method::EVALUATED.iter().filter_map(of).collect()
}

/// What a formula is lowered from.
fn candidates<'g>(formula: &Formula<'g>) -> Candidates<'g> {
    let cost = if formula.method == Method::ComponentRates { Cost::Series } else { Cost::Values };
    Candidates { arrangements: formula.arrangements.clone(), cost }
}

/// Quaternions behind the rotations among the coordinates, and the entries of R in terms of them.
fn system_rotations<'g>(graph: &'g Graph, system: &System<'g>) -> (Vec<Option<[Expr<'g>; 4]>>, Map<u32, Expr<'g>>) {
    let mut definitions = Map::default();
    let coordinates = system.scene.coordinates.iter().map(|coordinate| {
        let matrix = coordinate.rotation()?;
        let quaternion = ["x", "y", "z", "w"].map(|name| graph.symbol(name, name, false));
        let entries = rotation_of_quaternion(graph, quaternion);
        let symbols = matrix.iter().flatten().map(|symbol| symbol.key());
        definitions.extend(symbols.zip(entries.into_iter().flatten().map(Expr::group)));
        Some(quaternion)
    });
    (coordinates.collect(), definitions)
}

/// Entries of R that are coordinates are stored as a unit quaternion: its components, and the entries in terms of them.
fn rotation_entries<'g>(graph: &'g Graph, scene: &Scene<'g>) -> (Option<[Expr<'g>; 4]>, Map<u32, Expr<'g>>) {
    let kinematics = &scene.kinematics;
    if !matches!(kinematics.kind, ConfigurationKind::Pose | ConfigurationKind::Rotation) {
        return (None, Map::default());
    }
    let quaternion = ["x", "y", "z", "w"].map(|name| graph.symbol(name, name, false));
    let entries = rotation_of_quaternion(graph, quaternion);
    let symbols = kinematics.configuration.iter().map(|symbol| symbol.key());
    (Some(quaternion), symbols.zip(entries.into_iter().flatten().map(Expr::group)).collect())
}
