//! The pipeline on one screen: parse → derive → check → lower → emit.

use std::fmt::Display;

use proc_macro2::{Ident, Span, TokenStream};
use syn::DeriveInput;

use crate::algebra::{Expr, Graph, Map};
use crate::emit::{Derived, Subject, SystemSubject, emit};
use crate::kernel::Kernel;
use crate::mechanics::{
    AddedMassShape, BodyShape, ConfigurationKind, GravityShape, InertiaShape, Scene, System, SystemFault,
    check_against_definition, check_system_against_definition, rotation_of_quaternion,
};
use crate::model::{self, Model, Shape, SystemModel};
use crate::translate::Translator;

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
    let shape = body_shape(model);
    let scene = Scene::new(&graph, model.motion, model.chart, shape);
    let formulas = scene.formulas();
    check_against_definition(&scene, &formulas).map_err(|error| bug(&model.ident, &error))?;
    let (quaternion, rotation) = rotation_entries(&graph, &scene);
    let functions: Vec<_> = formulas.iter().map(|f| f.arrangements.clone()).collect();
    let kernel = Kernel::lower(&graph, &functions, &rotation).map_err(|error| bug(&model.ident, &error))?;
    if graph.overflowed() {
        return Err(bug(&model.ident, &"a coefficient left the range of 64-bit fractions"));
    }
    Ok(emit(&Derived {
        subject: Subject::Body { model, scene: &scene, inertia: shape.inertia, quaternion },
        formulas: &formulas,
        kernel: &kernel,
    }))
}

fn expand_system(model: &SystemModel) -> syn::Result<TokenStream> {
    let graph = Graph::new();
    let mut translator = Translator::new(&graph, model);
    let speeds = translator.speeds().to_vec();
    let all: Vec<usize> = (0..speeds.len()).collect();
    let scene = translator.scene(&speeds, &all)?;
    let mut mistakes = Mistakes::default();
    for k in scene.rates_not_affine() {
        let (coordinate, rate) = &model.kinematics[scene.coordinate_of_rate(k)];
        mistakes.push(
            rate.span,
            format!(
                "the rate of `{coordinate}` is not affine in the speeds, so velocities would not be linear in them; \
                 choose speeds in which every rate is a sum of terms with one speed each"
            ),
        );
    }
    mistakes.finish()?;
    let system = System::new(scene);
    let idle = system.idle_speeds();
    for &k in &idle {
        let (name, span) = speed(model, k);
        mistakes.push(
            span,
            format!("no velocity depends on `{name}`: its row of the mass matrix is zero; give what it moves a mass, or leave it out"),
        );
    }
    mistakes.finish()?;
    let formulas = system.formulas();
    check_system_against_definition(&system, &formulas).map_err(|fault| system_fault(model, &system, &fault))?;
    let (quaternions, definitions) = system_rotations(&graph, &system);
    let functions: Vec<_> = formulas.iter().map(|f| f.arrangements.clone()).collect();
    let kernel = Kernel::lower(&graph, &functions, &definitions).map_err(|error| bug(&model.ident, &error))?;
    if graph.overflowed() {
        return Err(bug(&model.ident, &"a coefficient left the range of 64-bit fractions"));
    }
    let links = translator.links_of_clauses();
    let subject = SystemSubject {
        model,
        system: &system,
        sources: translator.sources(),
        links: &links,
        quaternions: &quaternions,
    };
    Ok(emit(&Derived { subject: Subject::System(subject), formulas: &formulas, kernel: &kernel }))
}

/// What the check of a system finds, at the token that is wrong.
fn system_fault(model: &SystemModel, system: &System<'_>, fault: &SystemFault) -> syn::Error {
    let clause = |k: usize| &model.constraints[system.scene.constraints[k].clause];
    match fault {
        SystemFault::Disagreement(error) => bug(&model.ident, error),
        SystemFault::DependentSpeed(k) => {
            let (name, span) = speed(model, *k);
            let message = format!(
                "`{name}` moves nothing that the speeds before it do not move: the mass matrix is singular; \
                 leave one of them out, or give what it moves a mass"
            );
            syn::Error::new(span, message)
        }
        SystemFault::DependentConstraint(k) => syn::Error::new(
            clause(*k).span,
            "this constraint follows from the coordinates, the speeds and the constraints before it, so its multiplier is \
             undetermined; remove it",
        ),
        SystemFault::InconsistentConstraint(k) => syn::Error::new(
            clause(*k).span,
            "no motion satisfies this constraint together with the coordinates, the speeds and the constraints before it; \
             correct it or remove it",
        ),
    }
}

/// Quaternions behind the rotations among the coordinates, and the entries of R in terms of them.
#[expect(clippy::type_complexity, reason = "two lists that belong together, taken apart at once")]
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

/// The name of a speed, and where it is written: in the jet chart at its coordinate.
fn speed(model: &SystemModel, k: usize) -> (String, Span) {
    match &model.speeds {
        Some(speeds) => (speeds[k].ident.to_string(), speeds[k].ident.span()),
        None => (format!("d{}/dt", model.coordinates[k].ident), model.coordinates[k].ident.span()),
    }
}

/// Mistakes that only the derivation sees, all reported at once.
#[derive(Default)]
struct Mistakes(Option<syn::Error>);

impl Mistakes {
    fn push(&mut self, span: Span, message: String) {
        let error = syn::Error::new(span, message);
        match &mut self.0 {
            Some(all) => all.combine(error),
            none => *none = Some(error),
        }
    }

    fn finish(&mut self) -> syn::Result<()> {
        self.0.take().map_or(Ok(()), Err)
    }
}

/// What the scene has, from the fields that the struct has.
fn body_shape(model: &Model) -> BodyShape {
    let shape = |index: usize| model.parameters[index].shape;
    BodyShape {
        inertia: match shape(model.inertia) {
            Shape::Scalar => InertiaShape::Spherical,
            Shape::Vector3 => InertiaShape::Principal,
            _ => InertiaShape::Full,
        },
        center_of_mass: model.center_of_mass.is_some(),
        added_mass: model.added_mass.map(|k| match shape(k) {
            Shape::Vector6 => AddedMassShape::Diagonal,
            _ => AddedMassShape::Full,
        }),
        gravity: model.gravity.map(|k| match shape(k) {
            Shape::Scalar => GravityShape::Vertical,
            _ => GravityShape::Vector,
        }),
        displaced_mass: model.displaced_mass.is_some(),
        center_of_buoyancy: model.center_of_buoyancy.is_some(),
    }
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

/// A mistake of this crate, said as such at the name of the struct.
fn bug(ident: &Ident, what: &impl Display) -> syn::Error {
    syn::Error::new(ident.span(), format!("bug in gauss-derive: {what}; please report it together with this struct"))
}
