//! The clauses and fields of a scene put together: every name known, every kind right, nothing missing.

use crate::model::checks::{bodies, coefficients, constraints, contacts, field_shapes, forces, masses, modes, motion};
use crate::model::language::context::Context;
use crate::model::language::declarations::StateClause;
use crate::model::language::fields::{ReadField, Reader, documentation};
use crate::model::language::shapes::TypeKind;
use crate::model::language::statements::Statements;
use crate::model::language::struct_clauses::Clauses;
use crate::model::language::words::{same, word};
use crate::model::names::expressions;
use crate::model::names::places::ExpressionPlace;
use crate::model::names::{definitions, kinds, naming, scope_entries};
use crate::model::scene::clauses::{BodyClause, ElementState};
use crate::model::scene::expression::Expression;
use crate::model::scene::limbs::Limbs;
use crate::model::scene::model::Model;
use crate::model::units::needs;
use crate::terms::{BodyChart, Field, Generics, Item, KernelOptions, Role, Scalar, Shape};
use proc_macro2::{Ident, Span};
use quote::{ToTokens, quote};
use syn::{DeriveInput, Path};

/// The checked scene; `None` when something is wrong, which is then noted.
pub fn model(input: &DeriveInput, clauses: Clauses, mut reader: Reader<'_>, context: &mut Context) -> Option<Model> {
    let Clauses { in_chart, runtime, mut wanted, mut statements, .. } = clauses;
    let is_empty = statements.is_empty();
    if in_chart.is_some() {
        statements.bodies.insert(0, body_in_chart());
    }
    mark_named(&statements, &mut reader);
    let scalar = field_shapes::common_scalar(&reader.fields);
    let scalar_name = field_shapes::scalar_name(scalar.as_ref(), input);
    let whole = if in_chart.is_some() { "body" } else { "system" };
    let (shapes, owners) = field_shapes::shapes(&reader, scalar.as_ref(), &scalar_name, whole, context);
    let uncertain = statements.missed;

    // A body in a chart about which nothing else is said has no names that anything could confuse.
    if in_chart.is_none() || !is_empty {
        naming::check(&statements, &reader.fields, context);
    }
    motion::check_kinematics(&statements, uncertain, context);
    masses::check_roles(input, &statements, &reader, &owners, &scalar_name, uncertain, context);
    bodies::check(&statements, &reader, &wanted, &scalar_name, context);
    let (unused, definitions) = check_expressions(&mut statements, &reader, &shapes, &scalar_name, uncertain, context);
    if in_chart.is_none() && statements.coordinates.is_none() && !uncertain {
        let span = statements.first.as_ref().map_or(input.ident.span(), Ident::span);
        context.error(span, "the system has no coordinates; add `coordinates(…)` with their names");
    }
    if context.is_clean() {
        motion::check_dependence(&statements, &expressions::all(&statements), context);
        check_effect(&statements, &unused, &owners, context);
    }
    let scalar = match scalar {
        Some(scalar) => scalar,
        None => field_shapes::scalar_without_fields(input, &reader.fields, context)?,
    };
    let fields = fields(&reader, &shapes);
    let driven = std::mem::take(&mut statements.driven);
    wanted.motions.clone_from(&driven);
    let model = assembled(input, (runtime, wanted, scalar, in_chart), fields, statements)?;
    let written = |(name, _): &&(Ident, Expression)| driven.iter().any(|driven| same(driven, name));
    let motions = definitions.iter().filter(written).cloned().collect();
    let (mut bodies, coordinates) = (model.bodies, model.coordinates);
    // Of what is wrong nothing is asked.
    let limbs = if context.is_clean() { Limbs::found(&mut bodies, &coordinates) } else { Limbs::default() };
    Some(Model { bodies, coordinates, motions, limbs, definitions, ..model })
}

/// The body without a name, whose place is given by the chart.
fn body_in_chart() -> BodyClause {
    BodyClause {
        name: None,
        massless: false,
        parent: None,
        position: None,
        rotation: None,
        role_clauses: Vec::new(),
        span: Span::call_site(),
    }
}

/// Checks names and kinds in all expressions, and writes the definitions out; gives back the names that are not used,
/// and what the names stand for.
fn check_expressions(
    statements: &mut Statements,
    reader: &Reader<'_>,
    shapes: &[Shape],
    scalar: &str,
    uncertain: bool,
    context: &mut Context,
) -> (Vec<Ident>, Vec<(Ident, Expression)>) {
    let earlier = context.count();
    if !definitions::check_sizes(statements, context) {
        return Default::default();
    }
    statements.name_rates();
    let mut scope = scope_entries::scope(statements, &reader.fields, shapes, scalar, uncertain);
    definitions::check(&statements.definitions, &mut scope, context);
    for (place, expression) in expressions::all(statements) {
        // Of constraints and mass data the kind is needed as well; contacts are looked at clause by clause.
        let later = matches!(place, ExpressionPlace::Constraint(_) | ExpressionPlace::Role(_))
            || place.is_of_contact()
            || [Role::AddedMass, Role::Inertia].map(expressions::entry).contains(&place);
        if !later {
            kinds::check(expression, place, &scope, context);
        }
    }
    let alone = statements.bodies.len() == 1 && statements.particles.is_empty();
    let all = std::iter::once(&mut statements.role_clauses)
        .chain(statements.bodies.iter_mut().map(|body| &mut body.role_clauses));
    all.for_each(|clauses| masses::check(clauses, alone, &reader.fields, &scope, context));
    forces::check(statements, context);
    modes::check(statements, context);
    coefficients::check(statements, &reader.fields, &scope, scalar, context);
    let well = constraints::check_kinds(statements, &scope, context);
    let in_contacts = contacts::check_kinds(statements, &scope, context);
    let all: Vec<&Expression> = expressions::all(statements).into_iter().map(|(_, expression)| expression).collect();
    let unused = definitions::unused(statements, &all);
    // Only what is well otherwise has dimensions.
    if context.count() == earlier {
        needs::check(statements, &reader.fields, context);
    }
    let definitions = definitions::inline(statements);
    constraints::check(statements, &well, uncertain, context);
    contacts::check(statements, &in_contacts, context);
    (unused, definitions)
}

/// Everything that is written does something. Asked only where all else is well.
fn check_effect(statements: &Statements, unused: &[Ident], owners: &[(Role, usize)], context: &mut Context) {
    forces::check_effect(statements, context);
    let clauses = statements.all_role_clauses();
    let mut roles = owners.iter().map(|(role, _)| *role).chain(clauses.map(|clause| clause.role));
    let fluid = roles.any(|role| matches!(role, Role::AddedMass | Role::DisplacedMass));
    forces::check_medium(statements, fluid, context);
    for name in unused {
        context.error(name.span(), format!("`{name}` is defined and never used; remove it"));
    }
}

/// The fields with their shapes.
fn fields(reader: &Reader<'_>, shapes: &[Shape]) -> Vec<Field> {
    let field = |(field, &shape): (&ReadField<'_>, &Shape)| Field {
        ident: field.ident.clone(),
        ty: field.ty.to_token_stream(),
        role: field.role.as_ref().map(|claim| claim.role),
        shape,
        unit: field.unit.clone(),
        documentation: field.documentation.clone(),
    };
    reader.fields.iter().zip(shapes).map(field).collect()
}

/// The model; `None` if the coordinates or the kinematics are not known, which is then noted.
fn assembled(
    input: &DeriveInput,
    (runtime, wanted, scalar, in_chart): (Path, KernelOptions, Scalar, Option<BodyChart>),
    fields: Vec<Field>,
    mut statements: Statements,
) -> Option<Model> {
    statements.place_at_points();
    let coordinates = match statements.coordinates {
        Some(coordinates) => coordinates.names,
        None => in_chart.map(|_| Vec::new())?,
    };
    let mut kinematics = Vec::new();
    if let Some(written) = &statements.kinematics {
        for coordinate in &coordinates {
            let (_, rate) = written.rates.iter().find(|(name, _)| same(name, &coordinate.ident))?;
            kinematics.push((coordinate.ident.clone(), rate.clone()?));
        }
    }
    let mut states = Vec::new();
    for StateClause { name, rate } in statements.states {
        states.push(ElementState { ident: name, rate: rate? });
    }
    Some(Model {
        item: Item {
            ident: input.ident.clone(),
            documentation: documentation(&input.attrs),
            visibility: input.vis.to_token_stream(),
            generics: generics(&input.generics),
            scalar,
            runtime: runtime.to_token_stream(),
            wanted,
            fields,
            inputs: statements.inputs.map_or_else(Vec::new, |inputs| inputs.names),
            functions: statements.functions,
            limit: statements.limit.and_then(|(_, limit)| limit),
            described: None,
            tracked: Vec::new(),
        },
        in_chart,
        coordinates,
        speeds: statements.speeds.map(|speeds| speeds.names),
        kinematics,
        states,
        motions: Vec::new(),
        bodies: statements.bodies,
        particles: statements.particles,
        points: statements.points,
        constraints: statements.constraints,
        redundant: statements.redundant.is_some(),
        contacts: statements.contacts,
        independent: statements.independent.map(|independent| independent.names),
        potential: statements.potential.and_then(|(_, potential)| potential),
        role_clauses: statements.role_clauses,
        medium: statements.medium.and_then(|(_, velocity)| velocity),
        attractions: statements.attractions,
        forces: statements.forces,
        armatures: statements.armatures,
        modes: statements.modes.into_iter().map(|read| read.clause).collect(),
        formal: statements.formal,
        limbs: Limbs::default(),
        definitions: Vec::new(),
    })
}

/// Type parameters as an `impl` writes them.
fn generics(written: &syn::Generics) -> Generics {
    let (declared, used, clause) = written.split_for_impl();
    let predicates = clause.iter().flat_map(|clause| &clause.predicates);
    let predicates = quote!(#(#predicates,)*);
    Generics { declared: quote!(#declared), used: quote!(#used), predicates }
}

/// Fields that expressions name are computed with, as those with roles are.
fn mark_named(statements: &Statements, reader: &mut Reader<'_>) {
    let coefficients = coefficients::fields(statements);
    for field in &mut reader.fields {
        field.computed |= match field.reading.kind {
            TypeKind::Known(Shape::Scalar | Shape::Vector3) => statements.name(&word(field.ident)),
            TypeKind::Known(Shape::Vector6 | Shape::Matrix6) => {
                coefficients.iter().any(|(name, _)| same(name, field.ident))
            }
            _ => false,
        };
    }
}
