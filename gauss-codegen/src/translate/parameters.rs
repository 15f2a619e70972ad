//! The parameters of a scene, number by number: the symbol of each, and what its author calls it.

use crate::algebra::Expr;
use crate::terms::{Field, Role};
use crate::words::Unraw;

use super::symbols::{FieldPart, ParameterSource};

/// One number of a field.
#[derive(Clone, Debug)]
pub struct FieldNumber<'g> {
    pub symbol: Expr<'g>,
    /// `m`, `center[2]`, `inertia[1][0]`, `arm.center_of_mass[2]`: indices as in Rust.
    pub name: String,
}

/// All of them, in the order of the fields.
pub fn parameters<'g>(fields: &[Field], sources: &[ParameterSource<'g>]) -> Vec<FieldNumber<'g>> {
    let mut parameters: Vec<_> = sources.iter().map(|source| of_field(fields, source)).collect();
    parameters.sort_by_key(|(field, _)| *field);
    parameters.into_iter().map(|(_, parameter)| parameter).collect()
}

fn of_field<'g>(fields: &[Field], source: &ParameterSource<'g>) -> (usize, FieldNumber<'g>) {
    let label = fields[source.field].ident.unraw();
    let name = match source.part {
        FieldPart::Scalar => label.to_string(),
        FieldPart::Component(i) => format!("{label}[{i}]"),
        FieldPart::Entry(i, j) => format!("{label}[{i}][{j}]"),
        FieldPart::Body(Role::Mass, ..) => format!("{label}.mass"),
        FieldPart::Body(Role::CenterOfMass, i, _) => format!("{label}.center_of_mass[{i}]"),
        FieldPart::Body(_, i, j) => format!("{label}.inertia[{i}][{j}]"),
    };
    (source.field, FieldNumber { symbol: source.symbol, name })
}
