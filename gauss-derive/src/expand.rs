//! The pipeline on one screen: parse → derive → check → lower → emit.

use std::fmt::Display;

use proc_macro2::TokenStream;
use syn::DeriveInput;

use crate::algebra::{Expr, Graph, Map};
use crate::emit::{Derived, emit};
use crate::kernel::Kernel;
use crate::mechanics::{
    AddedMassShape, BodyShape, ConfigurationKind, GravityShape, InertiaShape, Scene, check_against_definition,
    rotation_of_quaternion,
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
    check_against_definition(&scene, &formulas).map_err(|error| bug(&model, &error))?;
    let (quaternion, rotation) = rotation_entries(&graph, &scene);
    let functions: Vec<_> = formulas.iter().map(|f| f.arrangements.clone()).collect();
    let kernel = Kernel::lower(&graph, &functions, &rotation).map_err(|error| bug(&model, &error))?;
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
fn bug(model: &Model, what: &impl Display) -> syn::Error {
    syn::Error::new(
        model.ident.span(),
        format!("bug in gauss-derive: {what}; please report it together with this struct"),
    )
}
