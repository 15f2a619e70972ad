//! The pipeline on one screen: parse → derive → lower → emit.

use proc_macro2::TokenStream;
use syn::DeriveInput;

use crate::algebra::{Expr, Graph};
use crate::emit::{Derived, emit};
use crate::kernel::Kernel;
use crate::mechanics::{
    AddedMassShape, BodyShape, ConfigurationKind, Formula, GravityShape, InertiaShape, Scene, rotation_of_quaternion,
};
use crate::model::{self, Model, Shape};

/// Expands one struct.
///
/// # Errors
/// Every mistake of the struct, each at the token that is wrong.
pub fn expand(input: &DeriveInput) -> syn::Result<TokenStream> {
    let model = model::parse(input)?;
    let graph = Graph::new();
    let shape = body_shape(&model);
    let scene = Scene::new(&graph, model.motion, model.chart, shape);
    let formulas = scene.formulas();
    let (quaternion, functions) = in_terms_of_quaternion(&graph, &scene, &formulas);
    let kernel = Kernel::lower(&graph, &functions).map_err(|error| bug(&model, &error))?;
    if graph.overflowed() {
        return Err(bug(&model, &"a coefficient left the range of 64-bit fractions"));
    }
    Ok(emit(&Derived {
        model: &model,
        scene: &scene,
        formulas: &formulas,
        kernel: &kernel,
        inertia: shape.inertia,
        quaternion,
    }))
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

/// Outputs of every function, arrangement by arrangement.
type Functions<'g> = Vec<Vec<Vec<Expr<'g>>>>;

/// Entries of R that are coordinates are stored as a unit quaternion: writes them in its components.
fn in_terms_of_quaternion<'g>(
    graph: &'g Graph,
    scene: &Scene<'g>,
    formulas: &[Formula<'g>],
) -> (Option<[Expr<'g>; 4]>, Functions<'g>) {
    let kinematics = &scene.kinematics;
    let quaternion = matches!(kinematics.kind, ConfigurationKind::Pose | ConfigurationKind::Rotation)
        .then(|| ["x", "y", "z", "w"].map(|name| graph.symbol(name, name, false)));
    let entries = quaternion.map(|q| rotation_of_quaternion(graph, q));
    let replacement = entries
        .iter()
        .flatten()
        .flatten()
        .zip(&kinematics.configuration)
        .map(|(entry, symbol)| (symbol.key(), entry.group()))
        .collect();
    let rewrite = |outputs: &Vec<Expr<'g>>| outputs.iter().map(|e| e.substitute(&replacement)).collect();
    let functions = formulas.iter().map(|f| f.arrangements.iter().map(rewrite).collect()).collect();
    (quaternion, functions)
}

/// A mistake of this crate, said as such at the name of the struct.
fn bug(model: &Model, what: &impl std::fmt::Debug) -> syn::Error {
    syn::Error::new(
        model.ident.span(),
        format!("bug in gauss-derive: {what:?}; please report it together with this struct"),
    )
}
