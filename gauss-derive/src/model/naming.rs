//! One name, one meaning.

use super::Role;
use super::context::Context;
use super::fields::Field;
use super::functions::FUNCTIONS;
use super::scope::TIME;
use super::statements::Statements;
use proc_macro2::Ident;
use syn::ext::IdentExt;

/// Fields, coordinates, speeds, bodies, frames and points have different names, and none that expressions use already.
pub(super) fn check(statements: &Statements, fields: &[Field<'_>], context: &mut Context) {
    let is_body = |name: &Ident| {
        let role = |field: &Field<'_>| field.role.as_ref().is_some_and(|claim| claim.role == Role::Body);
        fields.iter().any(|field| same(field.ident, name) && role(field))
    };
    let mut taken: Vec<(&Ident, &str)> = Vec::new();
    let coordinates = statements.coordinates.iter().flat_map(|names| &names.names);
    let speeds = statements.speeds.iter().flat_map(|names| &names.names);
    // A named body is its field.
    let bodies = statements.massive().filter_map(|body| body.name.as_ref());
    let bodies = bodies.filter(|name| !fields.iter().any(|field| same(field.ident, name)));
    let all = fields
        .iter()
        .map(|field| (field.ident, "field"))
        .chain(coordinates.map(|coordinate| (&coordinate.ident, "coordinate")))
        .chain(speeds.map(|speed| (&speed.ident, "speed")))
        .chain(bodies.map(|name| (name, "body")))
        .chain(statements.frames().map(|name| (name, "frame")))
        .chain(statements.points.iter().map(|point| (&point.name, "point")));
    for (name, noun) in all {
        let word = name.unraw().to_string();
        if word == TIME {
            context.error(name.span(), format!("`{TIME}` is time in expressions and cannot name a {noun}; rename it"));
        } else if FUNCTIONS.iter().any(|(function, _)| *function == word) {
            context.error(
                name.span(),
                format!("`{word}` is a function of expressions and cannot name a {noun}; rename it"),
            );
        } else if let Some((_, earlier)) = taken.iter().find(|(earlier, _)| same(earlier, name)) {
            match (*earlier, noun) {
                // Two fields of one name are the compiler's to refuse; two bodies are refused with their fields.
                ("field", "field") | ("body", "body") => {}
                ("field", "frame") if is_body(name) => context.error(
                    name.span(),
                    format!(
                        "`{word}` is a body, because its field says so, and a frame has no field; \
                         write `body({word}, …)`, or remove the field"
                    ),
                ),
                (earlier, noun) if earlier == noun => {
                    context.error(name.span(), format!("the {noun} `{word}` is declared twice; remove one of the two"));
                }
                (earlier, noun) => {
                    context
                        .error(name.span(), format!("`{word}` names a {earlier} and a {noun}; rename one of the two"));
                }
            }
        }
        taken.push((name, noun));
    }
}

/// Whether expressions use the word already.
pub(super) fn is_reserved(word: &str) -> bool {
    word == TIME || FUNCTIONS.iter().any(|(function, _)| *function == word)
}

/// The same name, raw or not.
pub(super) fn same(a: &Ident, b: &Ident) -> bool {
    a.unraw() == b.unraw()
}
