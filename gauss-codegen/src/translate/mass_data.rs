//! What clauses say of bodies and of gravity, in the place of symbols.

use crate::error::Result;
use crate::mechanics::QuantityValues;
use crate::model::{BodyClause, Model, Role, RoleClause, RoleValue, Shape};

use super::symbols::{Declared, free_fall};
use super::translated::MassData;
use super::translator::{Translator, bug};
use super::value::Value;

impl<'g> Translator<'_, 'g> {
    /// # Errors
    /// Only what the model should have refused: a bug of this crate.
    pub(super) fn mass_data(&self) -> Result<MassData<'g>> {
        let unnamed = self.quantity_values(&self.model.role_clauses)?;
        let own = |clause: &BodyClause| self.quantity_values(&clause.role_clauses);
        Ok(MassData { unnamed, named: self.model.bodies.iter().map(own).collect::<Result<_>>()? })
    }

    /// The values of mass data in clauses.
    ///
    /// # Errors
    /// Only what the model should have refused: a bug of this crate.
    fn quantity_values(&self, clauses: &[RoleClause]) -> Result<Vec<QuantityValues<'g>>> {
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
            let quantity = clause.role;
            Ok(QuantityValues { quantity, values })
        };
        clauses.iter().map(value).collect()
    }
}

impl<'g> Declared<'g> {
    /// Puts what clauses say in the place of symbols.
    pub(super) fn assign(&mut self, model: &Model, mass_data: &MassData<'g>) {
        if let Some(gravity) = mass_data.unnamed.iter().find(|values| values.quantity == Role::Gravity) {
            let zero = self.time.graph().zero();
            self.gravity = match gravity.values.as_slice() {
                &[x, y, z] => Some([x, y, z]),
                values => values.first().map(|&g| free_fall(model, zero, g)),
            };
        }
        for ((body, clause), named) in self.bodies.iter_mut().zip(&model.bodies).zip(&mass_data.named) {
            let Some(body) = body else { continue };
            let own = if clause.name.is_some() { named } else { &mass_data.unnamed };
            own.iter().for_each(|own| body.assign(own));
            body.gravity = self.gravity;
        }
    }
}
