//! One name, one meaning.

use crate::model::language::context::Context;
use crate::model::language::fields::ReadField;
use crate::model::language::functions::FUNCTIONS;
use crate::model::language::statements::Statements;
use crate::model::language::words::{self, PI, TIME, UNNAMED, same, word};
use crate::terms::Role;
use proc_macro2::Ident;
use std::collections::{HashMap, HashSet};
use syn::ext::IdentExt;

/// A name, and what it names.
type NamedItem<'a> = (&'a Ident, &'static str);

/// Refuses names that are used twice, among fields, coordinates, speeds, states, inputs, definitions, functions,
/// bodies, frames and points, and among force elements and contacts; and names that expressions use already.
pub fn check(statements: &Statements, fields: &[ReadField<'_>], context: &mut Context) {
    // Expressions do not name force elements and contacts: a force may have the name of its input.
    let acting = acting(statements);
    let nouns: HashSet<&str> = acting.iter().map(|(_, noun)| *noun).collect();
    let is_element = |noun: &str| nouns.contains(noun);
    // By whether they are elements, and the word.
    let mut taken: HashMap<(bool, String), &str> = HashMap::new();
    let unnamed = statements.has_unnamed_body();
    for (name, noun) in declared(statements, fields).into_iter().chain(acting.iter().copied()) {
        if unnamed {
            check_unnamed(statements, (name, noun), context);
        }
        let key = (is_element(noun), word(name));
        if !check_reserved((name, noun), context)
            && let Some(&earlier) = taken.get(&key)
        {
            let both = (earlier, noun);
            refuse_second(name, both, is_element(noun), is_body(fields, name), context);
        }
        taken.entry(key).or_insert(noun);
    }
}

/// Names of loads, where they have one, and of contacts.
fn acting(statements: &Statements) -> Vec<NamedItem<'_>> {
    let clauses = statements.forces.iter().chain(&statements.attractions);
    let acting = clauses.filter_map(|clause| Some((clause.name.as_ref()?, clause.noun())));
    let contacts = statements.contacts.iter().flat_map(|clause| &clause.names);
    acting.chain(contacts.map(|name| (name, "contact"))).collect()
}

/// Names that expressions can use.
pub(super) fn declared<'a>(statements: &'a Statements, fields: &[ReadField<'a>]) -> Vec<NamedItem<'a>> {
    let coordinates = statements.coordinates.iter().flat_map(|names| &names.names);
    let speeds = statements.speeds.iter().flat_map(|names| &names.names);
    let inputs = statements.inputs.iter().flat_map(|names| &names.names);
    // A named body is its field.
    let bodies = statements.massive().filter_map(|body| body.name.as_ref());
    let own: HashSet<String> = fields.iter().map(|field| word(field.ident)).collect();
    let bodies = bodies.filter(|name| !own.contains(&word(name)));
    fields
        .iter()
        .map(|field| (field.ident, "field"))
        .chain(coordinates.map(|coordinate| (&coordinate.ident, "coordinate")))
        .chain(speeds.map(|speed| (&speed.ident, "speed")))
        .chain(statements.states.iter().map(|state| (&state.name, "state")))
        .chain(inputs.map(|input| (&input.ident, "input")))
        .chain(statements.definitions.iter().map(|definition| (&definition.name, "definition")))
        .chain(statements.functions.iter().map(|function| (&function.name, "function")))
        .chain(bodies.map(|name| (name, "body")))
        .chain(statements.frames().map(|name| (name, "frame")))
        .chain(statements.points.iter().map(|point| (&point.name, "point")))
        .collect()
}

fn is_body(fields: &[ReadField<'_>], name: &Ident) -> bool {
    let role = |field: &ReadField<'_>| field.role.as_ref().is_some_and(|claim| claim.role == Role::Body);
    fields.iter().any(|field| same(field.ident, name) && role(field))
}

/// Nothing else is called as the body without a name is.
fn check_unnamed(statements: &Statements, (name, noun): NamedItem<'_>, context: &mut Context) {
    // A field that nothing names confuses nothing.
    let confused = noun != "field" || statements.name(UNNAMED);
    if name.unraw() == UNNAMED && confused {
        context.error(
            name.span(),
            format!(
                "`{UNNAMED}` is the only body in expressions and clauses, and {}; rename the {noun}",
                words::a(noun)
            ),
        );
    }
}

/// Whether expressions use the name already, which is then noted.
fn check_reserved((name, noun): NamedItem<'_>, context: &mut Context) -> bool {
    let word = name.unraw().to_string();
    let meaning = match word.as_str() {
        TIME => format!("`{TIME}` is time in expressions"),
        PI => format!("`{PI}` is the number π in expressions"),
        _ if is_reserved(&word) => format!("`{word}` is a function of expressions"),
        _ => return false,
    };
    context.error(name.span(), format!("{meaning} and cannot name {}; rename it", words::a(noun)));
    true
}

/// Notes that a name has two meanings.
fn refuse_second(name: &Ident, (earlier, noun): (&str, &str), is_element: bool, is_body: bool, context: &mut Context) {
    let word = name.unraw().to_string();
    let message = match (earlier, noun) {
        // Two bodies are refused with their fields.
        ("body", "body") => return,
        ("field", "frame") if is_body => format!(
            "`{word}` is a body by its field, and a frame has no field; write `body({word}, …)`, or remove \
             the field"
        ),
        ("field", "input") => format!(
            "`{word}` is a field, whose value is fixed when the kernel is made, and an input, whose value arrives at run \
             time; rename or remove one of the two"
        ),
        (element, again) if element == again && is_element => {
            let ending = if again == "wrench" { "es" } else { "s" };
            format!("two {again}{ending} are called `{word}`; rename one of the two")
        }
        (earlier, noun) if earlier == noun => format!("the {noun} `{word}` is declared twice; remove one of the two"),
        (earlier, noun) => {
            format!("`{word}` names {} and {}; rename one of the two", words::a(earlier), words::a(noun))
        }
    };
    context.error(name.span(), message);
}

/// Whether expressions use the word already.
pub fn is_reserved(word: &str) -> bool {
    [TIME, PI].contains(&word) || FUNCTIONS.iter().any(|(function, _)| *function == word)
}
