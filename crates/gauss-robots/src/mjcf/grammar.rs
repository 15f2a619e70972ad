//! Types of attributes: how many numbers, which words.
//!
//! The readers of attributes say what they found in words of their own; here is refused what nobody looked at, such as
//! the defaults of a class that nothing has, and what is more than was asked for.

use roxmltree::Node;

use crate::reference::{Element, Verdict};
use crate::xml::{Reading, own_descendants};

use super::reference::ELEMENTS;

/// Elements of MuJoCo's grammar with the types of their attributes.
pub const GRAMMAR: &str = include_str!("grammar.txt");

/// Words of attributes that are one of some, with the elements that these are of; any, if there are none. Gains and
/// biases of other words are warned of.
const WORDS: &[(&str, &str, &str)] = &[
    ("", "ctrllimited forcelimited limited actuatorfrclimited inertiafromgeom", "false true auto"),
    ("geom", "type", "plane hfield sphere capsule ellipsoid cylinder box mesh sdf"),
    (
        "flag",
        "gravity actuation clampctrl spring damper passive equality constraint frictionloss limit contact filterparent",
        "enable disable",
    ),
];

/// Rows of the grammar: the place of an element, `body/joint`, with its attributes and their types.
pub fn rows(joined: &str) -> impl Iterator<Item = (&str, impl Iterator<Item = (&str, &str)>)> {
    let rows = joined.lines().filter_map(|line| line.split_once(": "));
    let places = rows.filter(|(place, _)| place.contains('/') && !place.contains(' '));
    places.map(|(place, all)| (place, all.split_whitespace().filter_map(|own| own.split_once(':'))))
}

/// The grammar with a line for each element.
pub fn joined() -> String {
    GRAMMAR.replace("\n    ", " ")
}

/// Refuses values of attributes that act and are of another type, if nothing is said of them yet.
pub fn refuse_other_types<'a>(root: Node<'a, 'a>, reading: &mut Reading<'a>) {
    let joined = joined();
    let rows: Vec<(&str, Vec<(&str, &str)>)> = rows(&joined).map(|(place, all)| (place, all.collect())).collect();
    for node in own_descendants(root) {
        let name = node.tag_name().name();
        let parent = node.parent_element().map_or("", |parent| parent.tag_name().name());
        let Some(element) = Element::find(ELEMENTS, parent, name).filter(|own| own.verdict == Verdict::Acts) else {
            continue;
        };
        // What stands in the world is as in a body.
        let is_it = |place: &str, parent: &str| place.split_once('/') == Some((parent, name));
        let row = rows.iter().find(|(place, _)| is_it(place, parent));
        let Some((_, types)) = row.or_else(|| rows.iter().find(|(place, _)| is_it(place, "body"))) else { continue };
        for attribute in node.attributes().filter(|attribute| attribute.namespace().is_none()) {
            let own = attribute.name();
            let Some((_, kind)) = types.iter().find(|(other, _)| *other == own) else { continue };
            if element.of(own) != Some(Verdict::Acts) {
                continue;
            }
            let value = attribute.value().trim();
            // What is empty is as if it was not there.
            if value.is_empty() {
                continue;
            }
            if let Some(expected) = expected(name, own, kind, value) {
                reading.other_fault_of_value(node, own, format!("`{own}` is {expected}, found `{value}`"));
            }
        }
    }
}

/// The type that an attribute has, if the value is of another one.
fn expected(element: &str, attribute: &str, kind: &str, value: &str) -> Option<String> {
    let (word, counts) = kind.split_once('(').unwrap_or((kind, ""));
    if matches!(word, "real" | "int") {
        return expected_numbers(word == "int", counts.trim_end_matches(')'), value);
    }
    let has = |words: &str, own: &str| words.split_whitespace().any(|other| other == own);
    let words = match word {
        "bool" => "false true",
        "enum" => {
            let row = |(of, names, _): &&(&str, &str, &str)| (of.is_empty() || *of == element) && has(names, attribute);
            WORDS.iter().find(row)?.2
        }
        _ => return None,
    };
    (!has(words, value))
        .then(|| words.split_whitespace().map(|word| format!("`{word}`")).collect::<Vec<_>>().join(" or "))
}

/// As many numbers as `1..3` says, `*` of any count.
fn expected_numbers(whole: bool, counts: &str, value: &str) -> Option<String> {
    let (least, most) = counts.split_once("..").unwrap_or((counts, counts));
    let [least, most] = [least, most].map(|end| end.parse::<usize>().ok());
    let is_number = |word: &str| {
        let number = word.parse::<f64>().ok().filter(|number| number.is_finite());
        number.is_some_and(|number| !whole || number.fract() == 0.0)
    };
    let count = value.split_whitespace().count();
    let is_well = value.split_whitespace().all(is_number)
        && least.is_none_or(|least| count >= least)
        && most.is_none_or(|most| count <= most);
    let noun = if whole { "whole number" } else { "number" };
    (!is_well).then(|| match (least, most) {
        (Some(1), Some(1)) => format!("one {noun}"),
        (Some(least), Some(most)) if least == most => format!("{least} {noun}s"),
        (Some(least), Some(most)) => format!("{least} to {most} {noun}s"),
        _ => format!("{noun}s"),
    })
}
