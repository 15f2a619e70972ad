//! Result of the translation: plain data.

use proc_macro2::{Ident, Span};

use crate::algebra::{Expr, Rational, Substitution};
use crate::mechanics::{FreedScene, QuantityValues, Readings, SystemScene};
use crate::terms::{Item, Role, Shape, Twin};
use crate::words::Unraw;

use super::drag::DragMatrix;
use super::laws::Law;
use super::parameters::FieldNumber;
use super::state::NamedQuantity;
use super::symbols::ParameterSource;

/// A system in symbols.
pub struct Translated<'g> {
    pub scene: SystemScene<'g>,
    /// The same with joints let go, where their reactions are wanted.
    pub let_go: Option<FreedScene<'g>>,
    pub provenance: Provenance<'g>,
}

/// Names, units and spans of a scene, for messages and print, beside its equations.
pub struct Provenance<'g> {
    pub item: Item,
    /// Places where the symbols of parameters are read.
    pub sources: Vec<ParameterSource<'g>>,
    /// The numbers of fields.
    pub parameters: Vec<FieldNumber<'g>>,
    /// Literal numbers that symbols stand for.
    pub literals: Vec<(Rational, Expr<'g>)>,
    /// Symbols of limbs that are alike.
    pub twins: Vec<(Expr<'g>, Twin)>,
    /// Names of the author, and numbers that are read as something else in print.
    pub readings: Readings<'g>,
    /// Numbers with which checks may not be sure, where they are written.
    pub extreme: Vec<(Span, Rational)>,
    /// Matrices of drag.
    pub drags: Vec<DragMatrix<'g>>,
    /// Constants of elements.
    pub laws: Vec<Law<'g>>,
    /// Mass data and gravity.
    pub mass_data: MassData<'g>,
    /// The links of the frames that are wanted, in their order.
    pub frames: Vec<usize>,
    /// Names of the speeds.
    pub speeds: Vec<SpannedName>,
    /// Coordinates and speeds of a state.
    pub state: [Vec<NamedQuantity>; 2],
    /// The declared coordinates, where their rates are written. Those of a chart come before them.
    pub rates: Vec<SpannedName>,
    /// Clause by clause.
    pub constraints: Vec<ConstraintPlace>,
    /// Clause by clause.
    pub contacts: Vec<ContactPlace>,
    /// The speeds that stay where constraints are solved for the others.
    pub independent: Option<IndependentSpeeds>,
}

/// Mass data and gravity that are written in clauses, and the bodies that have them.
pub struct MassData<'g> {
    /// Values of the body without a name, and gravity.
    pub unnamed: Vec<ClauseValue<'g>>,
    /// Bodies and frames, clause by clause.
    pub bodies: Vec<BodyData<'g>>,
    /// Indices of fields that clauses name as an added mass.
    pub added_masses: Vec<usize>,
    /// A field of attraction acts, which sees all moments of every body.
    pub attracted: bool,
}

/// A body or a frame.
pub struct BodyData<'g> {
    pub name: Option<Ident>,
    /// The word of its clause.
    pub span: Span,
    pub link: usize,
    /// Its principal moments need not obey the triangle inequality.
    pub is_formal: bool,
    /// Values that the clause of a body with a name gives.
    pub values: Vec<ClauseValue<'g>>,
}

/// A quantity of a body that is written in a clause.
pub struct ClauseValue<'g> {
    pub own: QuantityValues<'g>,
    pub shape: Shape,
    /// The word of the role.
    pub span: Span,
}

/// A name, and where it is written.
pub struct SpannedName {
    pub text: String,
    pub span: Span,
}

/// Places where a constraint is written.
pub struct ConstraintPlace {
    /// The word `constraint`.
    pub word: Span,
    pub expression: Span,
    /// In the file of a robot.
    pub in_file: Option<String>,
    /// It is a vector.
    pub is_vector: bool,
}

/// Places where gap and slips of a contact are written.
pub struct ContactPlace {
    /// `None`: it has none.
    pub gap: Option<Span>,
    /// Places of the slips, with the spin.
    pub slips: Vec<Span>,
    /// Places of the rolling resistance that goes with it.
    pub rolls: Vec<Span>,
}

/// The speeds that stay where constraints are solved for the others.
pub struct IndependentSpeeds {
    pub kept: Vec<usize>,
    /// The first of their names.
    pub span: Span,
}

impl<'g> MassData<'g> {
    /// The values of a role in clauses of the body without a name.
    pub fn unnamed(&self, role: Role) -> Option<&ClauseValue<'g>> {
        self.unnamed.iter().find(|value| value.own.quantity == role)
    }
}

impl<'g> Provenance<'g> {
    /// The body of that name (the unnamed one).
    pub fn body(&self, name: Option<&Ident>) -> Option<&BodyData<'g>> {
        self.mass_data.bodies.iter().find(|body| body.name.as_ref() == name)
    }

    /// Whether the equations read the field.
    pub fn is_read(&self, field: usize) -> bool {
        self.sources.iter().any(|source| source.field == field)
    }

    /// Name of a role of a body: by its field, or by its word after the name of the body.
    pub fn role_name(&self, body: Option<&Ident>, role: Role) -> String {
        match (body, self.item.field(role)) {
            (Some(name), _) => format!("{}.{}", name.unraw(), role.word()),
            (None, Some(field)) => field.ident.unraw().to_string(),
            (None, None) => role.word().to_owned(),
        }
    }

    /// The shape of the field or the clause that plays a role of the body without a name; `None` where neither does.
    pub fn shape(&self, role: Role) -> Option<Shape> {
        let clause = || self.mass_data.unnamed(role).map(|value| value.shape);
        self.item.field(role).map(|field| field.shape).or_else(clause)
    }

    /// Puts expressions in the place of symbols, as of speeds that constraints determine.
    pub fn substitute(&mut self, replacement: &Substitution<'g>) {
        let values = self.laws.iter_mut().map(|law| &mut law.values);
        let rows = self.drags.iter_mut().flat_map(|drag| &mut drag.entries);
        values.chain(rows).flatten().for_each(|e| *e = replacement.of(*e));
    }
}
