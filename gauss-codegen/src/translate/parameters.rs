//! The parameters of a scene, number by number: the symbol of each, and what its author calls it.

use syn::ext::IdentExt;

use crate::algebra::Expr;
use crate::mechanics::Body;
use crate::model::{Field, Model, Role, Shape};

use super::{Part, Source};

/// One number of a field.
#[derive(Clone, Debug)]
pub struct Parameter<'g> {
    pub symbol: Expr<'g>,
    /// `m`, `center[2]`, `inertia[1][0]`, `arm.center_of_mass[2]`: indices as in Rust.
    pub name: String,
}

/// Of a system, in the order of the fields.
pub fn parameters_of_system<'g>(fields: &[Field], sources: &[Source<'g>]) -> Vec<Parameter<'g>> {
    in_order(sources.iter().map(|source| of_field(fields, source)).collect())
}

/// Of one body in a chart: its own, and those that only what acts depends on.
pub fn parameters_of_body<'g>(model: &Model, body: &Body<'g>, sources: &[Source<'g>]) -> Vec<Parameter<'g>> {
    let own = body.parameters.iter().filter_map(|p| {
        let role = Some(p.quantity);
        let field = model.fields.iter().position(|field| field.role == role)?;
        let said = model.fields[field].ident.unraw();
        let name = match model.fields[field].shape {
            Shape::Matrix3 | Shape::Matrix6 => format!("{said}[{}][{}]", p.row, p.column),
            Shape::Vector3 | Shape::Vector6 => format!("{said}[{}]", p.row),
            _ => said.to_string(),
        };
        Some((field, Parameter { symbol: p.symbol, name }))
    });
    let mut parameters: Vec<_> = own.collect();
    let without_role = sources.iter().filter(|source| model.fields[source.field].role.is_none());
    parameters.extend(without_role.map(|source| of_field(&model.fields, source)));
    in_order(parameters)
}

fn of_field<'g>(fields: &[Field], source: &Source<'g>) -> (usize, Parameter<'g>) {
    let said = fields[source.field].ident.unraw();
    let name = match source.part {
        Part::Scalar => said.to_string(),
        Part::Component(i) => format!("{said}[{i}]"),
        Part::Entry(i, j) => format!("{said}[{i}][{j}]"),
        Part::Body(Role::Mass, ..) => format!("{said}.mass"),
        Part::Body(Role::CenterOfMass, i, _) => format!("{said}.center_of_mass[{i}]"),
        Part::Body(_, i, j) => format!("{said}.inertia[{i}][{j}]"),
    };
    (source.field, Parameter { symbol: source.symbol, name })
}

fn in_order<'g>(mut parameters: Vec<(usize, Parameter<'g>)>) -> Vec<Parameter<'g>> {
    parameters.sort_by_key(|(field, _)| *field);
    parameters.into_iter().map(|(_, parameter)| parameter).collect()
}
