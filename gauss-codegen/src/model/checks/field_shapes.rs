//! Rules between the fields: shapes that fit their roles, one scalar, no role missing, doubled or alone.

use crate::model::language::context::Context;
use crate::model::language::fields::{ReadField, Reader, RoleClaim};
use crate::model::language::role_words::ROLES;
use crate::model::language::shapes::{ScalarType, TypeKind};
use crate::model::language::words;
use crate::terms::Scalar;
use crate::terms::{Role, Shape};
use proc_macro2::Span;
use quote::ToTokens;
use syn::{DeriveInput, GenericParam};

/// The shape of every field, and the first field of every role. `whole` is what one scalar serves.
pub fn shapes(
    reader: &Reader<'_>,
    scalar: Option<&Scalar>,
    name: &str,
    whole: &str,
    context: &mut Context,
) -> (Vec<Shape>, Vec<(Role, usize)>) {
    let mut shapes = Vec::new();
    let mut owners: Vec<(Role, usize)> = Vec::new();
    for (index, field) in reader.fields.iter().enumerate() {
        if let Some(claim) = &field.role {
            check_duplicate(field, claim, &owners, &reader.fields, context);
            if !owners.iter().any(|(role, _)| *role == claim.role) {
                owners.push((claim.role, index));
            }
        }
        if field.computed {
            check_scalar(field, scalar, &reader.fields, whole, context);
        }
        shapes.push(match &field.role {
            Some(claim) => role_shape(field, claim, name, context),
            None => plain_shape(field, scalar),
        });
    }
    (shapes, owners)
}

/// Notes that the body lacks a role.
pub fn missing_role(input: &DeriveInput, role: Role, scalar: &str, context: &mut Context) {
    context.error(
        input.ident.span(),
        format!(
            "`{}` has no field with the role `{}`, which every body needs; add `{}`",
            input.ident,
            role.word(),
            role.example(scalar)
        ),
    );
}

/// The scalar that most computed fields show, the first of equally frequent ones: the others are the odd ones.
pub fn common_scalar(fields: &[ReadField<'_>]) -> Option<Scalar> {
    let mut counts: Vec<(&Scalar, usize)> = Vec::new();
    for (_, scalar) in shown(fields) {
        match counts.iter_mut().find(|(other, _)| *other == scalar) {
            Some((_, count)) => *count += 1,
            None => counts.push((scalar, 1)),
        }
    }
    let most = counts.iter().map(|&(_, count)| count).max()?;
    counts.into_iter().find(|&(_, count)| count == most).map(|(scalar, _)| scalar.clone())
}

/// The computed fields that show their scalar.
fn shown<'a>(fields: &'a [ReadField<'_>]) -> impl Iterator<Item = (&'a ReadField<'a>, &'a Scalar)> {
    fields.iter().filter(|field| field.computed).filter_map(|field| match &field.reading.element {
        ScalarType::Shown(scalar, _) => Some((field, scalar)),
        ScalarType::Hidden | ScalarType::Wrong(..) => None,
    })
}

/// The scalar in types that messages propose.
pub fn scalar_name(scalar: Option<&Scalar>, input: &DeriveInput) -> String {
    let parameter = input.generics.params.iter().find_map(|parameter| match parameter {
        GenericParam::Type(parameter) => Some(parameter.ident.to_string()),
        GenericParam::Lifetime(_) | GenericParam::Const(_) => None,
    });
    scalar.map(Scalar::to_string).or(parameter).unwrap_or_else(|| "f64".into())
}

/// A role belongs to one field, but for that of being a body.
fn check_duplicate(
    field: &ReadField<'_>,
    claim: &RoleClaim,
    owners: &[(Role, usize)],
    fields: &[ReadField<'_>],
    context: &mut Context,
) {
    if claim.role == Role::Body {
        return;
    }
    let first = owners.iter().find(|(role, _)| *role == claim.role).and_then(|&(_, index)| fields.get(index));
    if let Some(first) = first {
        context.error(
            claim.span,
            format!(
                "the role `{}` of the field `{}` is already that of the field `{}`; a body has one: remove one of the two",
                claim.role.word(),
                field.ident,
                first.ident
            ),
        );
    }
}

/// One scalar serves all fields that are computed with, and it is a floating-point type or a type parameter.
fn check_scalar(
    field: &ReadField<'_>,
    common: Option<&Scalar>,
    fields: &[ReadField<'_>],
    whole: &str,
    context: &mut Context,
) {
    match (&field.reading.element, common) {
        (ScalarType::Wrong(found, span), _) => context.error(
            *span,
            format!(
                "the scalar of `{}` is {found}; expected `f64`, `f32` or a type parameter of the struct",
                field.ident
            ),
        ),
        (ScalarType::Shown(scalar, span), Some(common)) if scalar != common => {
            let other =
                shown(fields).find(|(_, scalar)| *scalar == common).map_or(field.ident, |(other, _)| other.ident);
            context.error(
                *span,
                format!(
                    "the scalar of `{}` is `{scalar}`, but that of `{other}` is `{common}`; \
                     one scalar serves the whole {whole}: write `{common}`",
                    field.ident
                ),
            );
        }
        _ => {}
    }
}

/// The shape of a field with a role.
fn role_shape(field: &ReadField<'_>, claim: &RoleClaim, scalar: &str, context: &mut Context) -> Shape {
    let role = claim.role;
    let found = &field.reading.name;
    match (field.reading.kind, &claim.form) {
        (TypeKind::Known(shape), Some(form)) if shape != form.shape => {
            // The word is right for some type and the type may be right for another word: both remedies are named.
            let remedy = match role.forms().iter().find(|(_, other)| *other == shape) {
                Some((word, _)) => {
                    format!("write `{} = {word}` or make the field `{}`", role.word(), form.shape.written(scalar))
                }
                None => format!("make the field `{}`", form.shape.written(scalar)),
            };
            context.error(
                form.span,
                format!(
                    "`{} = {}` contradicts the type {found} of `{}`; {remedy}",
                    role.word(),
                    form.word,
                    field.ident
                ),
            );
            form.shape
        }
        (TypeKind::Known(shape), _) if role.takes(shape) => shape,
        (TypeKind::Known(_) | TypeKind::Foreign, _) => {
            context.error_at(
                field.ty,
                format!(
                    "`{}` cannot be {}; {}: expected {}",
                    role.word(),
                    article(found),
                    role.reason(),
                    role.expected(scalar)
                ),
            );
            Shape::Other
        }
        (TypeKind::Alias, Some(form)) => form.shape,
        (TypeKind::Alias, None) => match role.only_shape() {
            Some(shape) => shape,
            None => {
                if !claim.malformed {
                    context.error_at(
                        field.ty,
                        format!(
                            "the shape of `{}` cannot be read from {found}; say it in the role: write `{} = …` with {}",
                            field.ident,
                            role.word(),
                            words::list(role.forms())
                        ),
                    );
                }
                Shape::Other
            }
        },
    }
}

/// The type in a message, with the article that its name needs when it is read aloud.
fn article(found: &str) -> String {
    let vowels = ["A", "I", "O", "SV", "SM", "f3", "f6", "i"];
    match found.strip_prefix('`') {
        Some(name) if vowels.iter().any(|vowel| name.starts_with(vowel)) => format!("an {found}"),
        Some(_) => format!("a {found}"),
        None => found.into(),
    }
}

/// The shape of a plain parameter: expressions can use it only if its scalar is that of the model.
fn plain_shape(field: &ReadField<'_>, common: Option<&Scalar>) -> Shape {
    match (field.reading.kind, &field.reading.element) {
        (TypeKind::Known(shape), ScalarType::Shown(scalar, _)) if Some(scalar) == common => shape,
        (TypeKind::Known(shape), ScalarType::Hidden) => shape,
        _ => Shape::Other,
    }
}

/// Roles that mean nothing without another.
pub fn check_companion(role: Role, span: Span, known: impl Fn(Role) -> bool, scalar: &str, context: &mut Context) {
    let (needed, why) = match role {
        Role::DisplacedMass => (Role::Gravity, "buoyancy is the displaced mass times gravity"),
        Role::CenterOfBuoyancy => (Role::DisplacedMass, "without a displaced mass nothing acts there"),
        _ => return,
    };
    if !known(needed) {
        context.error(
            span,
            format!(
                "`{}` needs a field with the role `{}`; {why}: add `{}`",
                role.word(),
                needed.word(),
                needed.example(scalar)
            ),
        );
    }
}

/// The scalar where no field shows one. That it is hidden is said only if nothing else is wrong, since any other remedy
/// may show it.
pub fn scalar_without_fields(input: &DeriveInput, fields: &[ReadField<'_>], context: &mut Context) -> Option<Scalar> {
    let generic = input.generics.params.iter().any(|parameter| matches!(parameter, GenericParam::Type(_)));
    let of_role = |role: Role| move |field: &&ReadField<'_>| field.role.as_ref().is_some_and(|c| c.role == role);
    let hidden = |field: &&ReadField<'_>| field.computed && matches!(field.reading.element, ScalarType::Hidden);
    let by_role = ROLES.iter().find_map(|&(_, role)| fields.iter().filter(of_role(role)).find(hidden));
    let hidden = by_role.or_else(|| fields.iter().find(hidden));
    if hidden.is_none() && !generic && fields.iter().all(|field| !field.computed) {
        return Some(Scalar::F64);
    }
    if context.is_clean() {
        let message = "the scalar cannot be read from any field that is computed with, since each type is behind an alias; \
                       write `f64`, `f32` or a type parameter in one of them";
        match hidden {
            Some(field) => context.error_at(field.ty.to_token_stream(), message),
            None => context.error(input.ident.span(), message),
        }
    }
    None
}
