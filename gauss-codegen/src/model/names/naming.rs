//! One name, one meaning.

use crate::model::language::context::Context;
use crate::model::language::fields::ReadField;
use crate::model::language::functions::FUNCTIONS;
use crate::model::language::statements::Statements;
use crate::model::language::words::{self, TIME, UNNAMED, same};
use crate::model::scene::roles::Role;
use proc_macro2::Ident;
use syn::ext::IdentExt;

/// Fields, coordinates, speeds, inputs, definitions, bodies, frames and points have different names, elements of what acts too
/// among themselves, and none a name that expressions use already.
pub fn check(statements: &Statements, fields: &[ReadField<'_>], context: &mut Context) {
    let is_body = |name: &Ident| {
        let role = |field: &ReadField<'_>| field.role.as_ref().is_some_and(|claim| claim.role == Role::Body);
        fields.iter().any(|field| same(field.ident, name) && role(field))
    };
    // Expressions do not name what acts: a force may have the name of its input.
    let mut taken: Vec<(&Ident, &str)> = Vec::new();
    let coordinates = statements.coordinates.iter().flat_map(|names| &names.names);
    let speeds = statements.speeds.iter().flat_map(|names| &names.names);
    let inputs = statements.inputs.iter().flat_map(|names| &names.names);
    // A named body is its field.
    let bodies = statements.massive().filter_map(|body| body.name.as_ref());
    let bodies = bodies.filter(|name| !fields.iter().any(|field| same(field.ident, name)));
    let forces = statements.forces.iter().filter_map(|clause| Some((clause.name.as_ref()?, clause.noun())));
    let attractions = statements.attractions.iter().filter_map(|clause| Some((clause.name.as_ref()?, "attraction")));
    let acting: Vec<(&Ident, &str)> = forces.chain(attractions).collect();
    let is_element = |noun: &str| acting.iter().any(|(_, known)| *known == noun);
    let all = fields
        .iter()
        .map(|field| (field.ident, "field"))
        .chain(coordinates.map(|coordinate| (&coordinate.ident, "coordinate")))
        .chain(speeds.map(|speed| (&speed.ident, "speed")))
        .chain(inputs.map(|input| (&input.ident, "input")))
        .chain(statements.definitions.iter().map(|definition| (&definition.name, "definition")))
        .chain(bodies.map(|name| (name, "body")))
        .chain(statements.frames().map(|name| (name, "frame")))
        .chain(statements.points.iter().map(|point| (&point.name, "point")))
        .chain(acting.iter().copied());
    for (name, noun) in all {
        let word = name.unraw().to_string();
        // A field that nothing names confuses nothing.
        let confused = statements.has_unnamed_body() && (noun != "field" || statements.name(UNNAMED));
        if word == UNNAMED && confused {
            context.error(
                name.span(),
                format!(
                    "`{word}` is the only body in expressions and clauses, and {}; rename the {noun}",
                    words::a(noun)
                ),
            );
        }
        if word == TIME {
            context.error(
                name.span(),
                format!("`{TIME}` is time in expressions and cannot name {}; rename it", words::a(noun)),
            );
        } else if FUNCTIONS.iter().any(|(function, _)| *function == word) {
            context.error(
                name.span(),
                format!("`{word}` is a function of expressions and cannot name {}; rename it", words::a(noun)),
            );
        } else if let Some((_, earlier)) =
            taken.iter().find(|(earlier, known)| same(earlier, name) && is_element(known) == is_element(noun))
        {
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
                ("field", "input") => context.error(
                    name.span(),
                    format!(
                        "`{word}` is a field, whose value is fixed when the kernel is made, and an input, whose value \
                         arrives at run time; rename or remove one of the two"
                    ),
                ),
                (element, again) if element == again && is_element(element) => {
                    let ending = if again == "wrench" { "es" } else { "s" };
                    let message = format!("two {again}{ending} are called `{word}`; rename one of the two");
                    context.error(name.span(), message);
                }
                (earlier, noun) if earlier == noun => {
                    context.error(name.span(), format!("the {noun} `{word}` is declared twice; remove one of the two"));
                }
                (earlier, noun) => {
                    context.error(
                        name.span(),
                        format!("`{word}` names {} and {}; rename one of the two", words::a(earlier), words::a(noun)),
                    );
                }
            }
        }
        taken.push((name, noun));
    }
}

/// Whether expressions use the word already.
pub fn is_reserved(word: &str) -> bool {
    word == TIME || FUNCTIONS.iter().any(|(function, _)| *function == word)
}
