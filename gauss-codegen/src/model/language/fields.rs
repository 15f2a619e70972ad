//! The clauses of the fields: the role of each field, the word for its shape, and its unit.

use super::arguments::{self, UNIT};
use super::attributes::{self, Clause, Content, Owner};
use super::context::Context;
use super::role_words::{ROLES, SYSTEM_ROLES};
use super::shapes::{self, Reading, TypeKind};
use super::statements::{self, STATEMENTS};
use super::struct_clauses::CLAUSES;
use super::{synonyms, units, words};
use crate::terms::{Role, Shape};
use proc_macro2::{Ident, Span};
use syn::{Attribute, Data, DeriveInput, Expr, ExprLit, FieldsNamed, Generics, Lit, Meta, Type};

/// One field as written.
pub struct ReadField<'a> {
    pub ident: &'a Ident,
    pub ty: &'a Type,
    pub reading: Reading,
    pub role: Option<RoleClaim>,
    /// Its scalar is one that the model computes with: it has a role, or an expression names it.
    pub computed: bool,
    /// The unit, if one is written and well.
    pub unit: Option<String>,
    pub documentation: String,
}

/// A role as written on a field.
pub struct RoleClaim {
    pub role: Role,
    pub span: Span,
    /// The word after `=`, when there is a valid one.
    pub form: Option<Form>,
    /// The word after `=` was refused: then a missing shape is not a second mistake.
    pub malformed: bool,
}

/// The word after `=`.
pub struct Form {
    pub word: &'static str,
    pub shape: Shape,
    pub span: Span,
}

/// Every field, and what is known about the roles beyond them.
pub struct Reader<'a> {
    pub fields: Vec<ReadField<'a>>,
    /// Roles that some clause means although it is wrong (misspelt, or second on its field); they are not missing too.
    pub meant: Vec<Role>,
    /// The struct is a system, because of its clauses or because some field is a body.
    pub system: bool,
}

/// Reads the named fields of a struct; `system` if its clauses are those of a system.
pub fn read<'a>(named: &'a FieldsNamed, generics: &Generics, system: bool, context: &mut Context) -> Reader<'a> {
    let mut reader = Reader { fields: Vec::new(), meant: Vec::new(), system };
    for field in &named.named {
        // A field of a struct with named fields has a name.
        let Some(ident) = &field.ident else { continue };
        if ident == "_" {
            context.error(ident.span(), "a field has a name, and `_` is none; write one");
            continue;
        }
        let (role, unit) = reader.role_and_unit(ident, &field.attrs, context);
        let reading = shapes::read(&field.ty, generics);
        let unit = unit.filter(|(unit, span)| match wrong_unit(ident, role.as_ref(), &reading, unit) {
            Some(message) => {
                context.error(*span, message);
                false
            }
            None => true,
        });
        reader.fields.push(ReadField {
            ident,
            ty: &field.ty,
            reading,
            unit: unit.map(|(unit, _)| unit),
            computed: role.is_some(),
            role,
            documentation: documentation(&field.attrs),
        });
    }
    reader
}

/// Whether some field is a body, which makes the struct a system; mistakes are noted when the fields are read.
pub fn any_body(input: &DeriveInput) -> bool {
    let Data::Struct(data) = &input.data else { return false };
    let is_body = |clause: &Clause| clause.word() == Role::Body.word();
    let read = |field: &syn::Field| attributes::clauses(&field.attrs, Owner::Field, &mut Context::default());
    data.fields.iter().any(|field| read(field).iter().any(is_body))
}

impl Reader<'_> {
    /// Role and unit by the attributes of a field: of roles the first, of units the first that is well.
    fn role_and_unit(
        &mut self,
        ident: &Ident,
        attributes: &[Attribute],
        context: &mut Context,
    ) -> (Option<RoleClaim>, Option<(String, Span)>) {
        let (mut role, mut unit) = (None, None);
        for clause in attributes::clauses(attributes, Owner::Field, context) {
            if clause.word() == UNIT {
                if unit.is_some() {
                    let message = format!("the unit of the field `{ident}` is given twice; keep one of the two");
                    context.error(clause.name.span(), message);
                }
                let tokens = match &clause.value {
                    Content::Malformed => continue,
                    Content::Equals(tokens) => tokens.clone(),
                    Content::Absent | Content::Brackets(_) => Vec::new(),
                };
                unit = unit.or(arguments::read_unit(&clause.name, &tokens, clause.name.span(), context));
                continue;
            }
            let Some(claim) = self.claim(&clause, context) else { continue };
            match &role {
                None => role = Some(claim),
                Some(first) => self.refuse_second(ident, first, &claim, context),
            }
        }
        (role, unit)
    }

    /// Refuses a second role of a field, and a role that is written twice.
    fn refuse_second(&mut self, ident: &Ident, first: &RoleClaim, claim: &RoleClaim, context: &mut Context) {
        let [earlier, word] = [first.role.word(), claim.role.word()];
        if first.role == claim.role {
            context.error(claim.span, format!("`{word}` is written twice on the field `{ident}`; write it once"));
            return;
        }
        context.error(
            claim.span,
            format!(
                "the field `{ident}` has two roles, first `{earlier}` and now `{word}`; a field plays one role: \
                 make a second field for `{word}`"
            ),
        );
        self.meant.push(claim.role);
    }

    /// The role that a clause gives to its field.
    fn claim(&mut self, clause: &Clause, context: &mut Context) -> Option<RoleClaim> {
        let word = clause.word();
        let span = clause.name.span();
        let Some(&(_, role)) = SYSTEM_ROLES.iter().find(|(name, _)| *name == word) else {
            self.refuse(clause, &word, context);
            return None;
        };
        self.system |= role == Role::Body;
        let (form, malformed) = read_form(role, clause, context);
        Some(RoleClaim { role, span, form, malformed })
    }

    /// Notes why a clause is no role.
    fn refuse(&mut self, clause: &Clause, word: &str, context: &mut Context) {
        let span = clause.name.span();
        if CLAUSES.iter().any(|(name, _)| *name == word) || STATEMENTS.iter().any(|(name, _)| *name == word) {
            let written = match clause.value {
                Content::Absent => statements::form(word).unwrap_or_else(|| clause.written()),
                _ => clause.written(),
            };
            context.error(
                span,
                format!(
                    "`{word}` is a clause of the struct, not of a field; write `#[gauss({written})]` above `struct`"
                ),
            );
            return;
        }
        let owners: Vec<Role> = ROLES
            .iter()
            .map(|&(_, role)| role)
            .filter(|role| role.forms().iter().any(|(form, _)| *form == word))
            .collect();
        if !owners.is_empty() {
            let choices: Vec<String> = owners.iter().map(|role| format!("`{} = {word}`", role.word())).collect();
            context.error(span, format!("`{word}` is a form of a role, not a role; write {}", choices.join(" or ")));
            self.meant.extend(owners);
            return;
        }
        if words::nearest(word, ROLES).is_none() && words::nearest(word, &[(UNIT, ())]).is_some() {
            context.error(span, format!("unknown role `{word}`; did you mean `{UNIT}`?"));
            return;
        }
        if let Some((meant, remedy)) = synonyms::instead(word, synonyms::FOR_ROLES) {
            context.error(span, format!("unknown role `{word}`; {remedy}"));
            self.meant.extend(meant);
            return;
        }
        if let Err(Some(meant)) =
            words::resolve("role", &clause.name, if self.system { SYSTEM_ROLES } else { ROLES }, context)
        {
            self.meant.push(meant);
        }
    }
}

/// Mistake in the unit of a field.
fn wrong_unit(field: &Ident, role: Option<&RoleClaim>, reading: &Reading, unit: &str) -> Option<String> {
    let role = role.map(|claim| claim.role);
    if let Some((implied, dimension)) = role.and_then(Role::unit) {
        let word = role.map_or("", Role::word);
        return (units::read(unit) != Ok(dimension)).then(|| {
            format!("`{word}` is in {implied}, and the unit of `{field}` is {unit}; write `{UNIT} = \"{implied}\"`")
        });
    }
    let parts = match (role, reading.kind) {
        (Some(Role::AddedMass), _) => "the blocks of an added mass are in kg, kg m and kg m^2",
        (_, TypeKind::Known(Shape::Vector6 | Shape::Matrix6)) => {
            "what has six components belongs to forces and torques, which have different units"
        }
        (Some(Role::Body), _) | (_, TypeKind::Known(Shape::RigidBody | Shape::CentralBody)) => {
            "a rigid body has a mass in kg, a centre of mass in m and an inertia in kg m^2"
        }
        _ => return None,
    };
    Some(format!("`{field}` has no one unit: {parts}; remove `{UNIT}`"))
}

/// The word after `=`, and whether something there was refused.
fn read_form(role: Role, clause: &Clause, context: &mut Context) -> (Option<Form>, bool) {
    let name = &clause.name;
    let forms = role.forms();
    match &clause.value {
        Content::Absent => return (None, false),
        Content::Malformed => return (None, true),
        Content::Equals(tokens) if forms.is_empty() => {
            if let Some(first) = tokens.first() {
                context.error(attributes::start(first), format!("`{name}` takes no value; write `#[gauss({name})]`"));
            }
            return (None, true);
        }
        Content::Brackets(group) if forms.is_empty() => {
            context.error(group.span_open(), format!("`{name}` takes nothing in brackets; write `#[gauss({name})]`"));
            return (None, true);
        }
        Content::Equals(_) | Content::Brackets(_) => {}
    }
    let Some(word) = clause.bare_word(forms, context) else {
        return (None, true);
    };
    let noun = format!("`{name}` form");
    let Ok(shape) = words::resolve(&noun, &word.ident, forms, context) else {
        return (None, true);
    };
    if let Some(arguments) = word.arguments {
        let ident = &word.ident;
        context.error(arguments.span_open(), format!("`{ident}` takes nothing in brackets; write `{name} = {ident}`"));
        return (None, true);
    }
    let form = forms.iter().find(|(_, form)| *form == shape).map(|&(form, _)| Form {
        word: form,
        shape,
        span: word.ident.span(),
    });
    (form, false)
}

/// The doc comment of a field or of the struct, each line trimmed, lines joined as they were.
pub fn documentation(attributes: &[Attribute]) -> String {
    let mut lines = Vec::new();
    for attribute in attributes.iter().filter(|attribute| attribute.path().is_ident("doc")) {
        if let Meta::NameValue(pair) = &attribute.meta
            && let Expr::Lit(ExprLit { lit: Lit::Str(text), .. }) = &pair.value
        {
            lines.extend(text.value().lines().map(|line| line.trim().to_string()));
        }
    }
    lines.join("\n").trim().to_string()
}
