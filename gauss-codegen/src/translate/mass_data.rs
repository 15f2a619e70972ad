//! Mass data and gravity by clauses, in the place of symbols.

use crate::algebra::Expr;
use crate::error::Result;
use crate::mechanics::{Body, QuantityValues};
use crate::model::{Model, RoleClause, RoleValue};
use crate::terms::{Role, Shape};

use super::symbols::free_fall;
use super::translated::{BodyData, ClauseValue, MassData};
use super::translator::{Translator, bug};
use super::value::Value;

/// Quantities that follow from mass data in clauses.
pub(super) struct MassQuantities<'g> {
    /// Quantities of the body without a name, and gravity.
    pub unnamed: Vec<ClauseValue<'g>>,
    /// Clause by clause of the bodies with names.
    pub named: Vec<Vec<ClauseValue<'g>>>,
    /// Acceleration of free fall, observer's axes.
    pub gravity: Option<[Expr<'g>; 3]>,
    /// One for each clause; none for a frame.
    pub bodies: Vec<Option<Body<'g>>>,
}

impl<'g> Translator<'_, 'g> {
    /// Reads the mass data of clauses, in the place of symbols.
    ///
    /// # Errors
    /// Only what the model should have refused: a bug of this crate.
    pub(super) fn mass_data(&self) -> Result<MassQuantities<'g>> {
        let model = self.model;
        let unnamed = self.quantity_values(&model.role_clauses)?;
        let gravity = match unnamed.iter().find(|value| value.own.quantity == Role::Gravity) {
            None => self.declared.gravity,
            Some(gravity) => match gravity.own.values.as_slice() {
                &[x, y, z] => Some([x, y, z]),
                values => values.first().map(|&g| free_fall(model, self.graph.zero(), g)),
            },
        };
        let mut bodies = self.declared.bodies.clone();
        let mut named = Vec::with_capacity(bodies.len());
        for (body, clause) in bodies.iter_mut().zip(&model.bodies) {
            let own = self.quantity_values(&clause.role_clauses)?;
            if let Some(body) = body {
                let values = if clause.name.is_some() { &own } else { &unnamed };
                values.iter().for_each(|value| body.assign(&value.own));
                body.gravity = gravity;
            }
            named.push(own);
        }
        Ok(MassQuantities { unnamed, named, gravity, bodies })
    }

    /// The values of mass data in clauses.
    ///
    /// # Errors
    /// Only what the model should have refused: a bug of this crate.
    fn quantity_values(&self, clauses: &[RoleClause]) -> Result<Vec<ClauseValue<'g>>> {
        let nothing = self.no_links();
        let value = |clause: &RoleClause| {
            let values = match &clause.value {
                RoleValue::Expression(e) => match self.value(e, &nothing)?.observed() {
                    Value::Scalar(value) => vec![value],
                    Value::Vector(values) => values.to_vec(),
                    _ => return Err(bug(clause.span)),
                },
                RoleValue::Coefficients(coefficients) => {
                    let matrix = self.coefficients(coefficients, &nothing)?;
                    // Of a matrix the entries on and below the diagonal, column by column, as a body has them.
                    let below = |i: usize| (i..6).map(move |j| (j, i));
                    match clause.shape {
                        Shape::Matrix6 => (0..6).flat_map(below).map(|(i, j)| matrix[i][j]).collect(),
                        _ => (0..6).map(|i| matrix[i][i]).collect(),
                    }
                }
            };
            let own = QuantityValues { quantity: clause.role, values };
            Ok(ClauseValue { own, shape: clause.shape, span: clause.span })
        };
        clauses.iter().map(value).collect()
    }
}

impl<'g> MassQuantities<'g> {
    /// Adds the bodies that have them.
    pub(super) fn of_bodies(self, model: &Model, links: &[usize]) -> MassData<'g> {
        let bodies = model.bodies.iter().zip(links).zip(self.named).map(|((clause, &link), values)| BodyData {
            name: clause.name.clone(),
            span: clause.span,
            link,
            is_formal: model.waives_triangle_inequality(clause.name.as_ref()),
            values,
        });
        let is_added_mass = |&field: &usize| model.is_added_mass(&model.item.fields[field].ident);
        let added_masses = (0..model.item.fields.len()).filter(is_added_mass).collect();
        let attracted = !model.attractions.is_empty();
        MassData { unnamed: self.unnamed, bodies: bodies.collect(), added_masses, attracted }
    }
}
