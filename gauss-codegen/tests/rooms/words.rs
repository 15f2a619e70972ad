//! Words of docs and names of types. "Factors of A⁻¹Wᵀ" names an item, "Those of A⁻¹Wᵀ" does not; `Provenance` names a
//! type, `Given` does not; and four types that are all called `Place` are told apart by their files alone.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;

use crate::{files, here, libraries};

/// Words that begin a sentence without a noun or a verb for the item.
const NAMELESS: [&str; 9] = ["What", "Of", "With", "By", "Those", "That", "For", "Where", "How"];

/// Docs that still begin so, by library; no other has any. The numbers only fall.
const DOCS_LEFT: [(&str, usize); 1] = [
    // It is written into code that users read, and snapshots hold it.
    ("gauss-codegen", 1),
];

/// Participles, pronouns and prepositions that were names of types and said nothing of what these held.
const NO_NOUNS: &str = "About Above Accelerated After Against Ahead Along Around Asked Assigned Before Beside Between \
                        Called Charted Checked Compiled Computed Curved Deciding Declared Dependent Described \
                        Differentiated Driven Expected Facing Factoring Fastest Followed Formal Formed Found Further \
                        Gathered Gave Given Held Here Hoisted Hung Independent Joined Kept Known Leaving Less LetGo \
                        LetGoBy Limited Looking Lost Made Miscompiled Moved Moving Named Near Nested Noted Observed \
                        Opposite Passing Placed Plain Posed Prepared Printed Pushed Reached Read Reduced Relaxed \
                        Rounded Seen Shortened Shown Solved Sought Still Summed Taken Takes Told Touching Traced Tried \
                        Turned Unbound UnderWay Unsolved Wanted Weighted Whole With Working Written WrittenOut";

/// Types that still have one of these names, by library. The numbers only fall.
const TYPES_LEFT: [(&str, usize); 7] = [
    ("crates/gauss-contact", 14),
    ("crates/gauss-jit", 2),
    ("crates/gauss-python", 6),
    // Users write `gauss_parry::Found`, `gauss_robots::Written`, `gauss_robots::description::Turned`,
    // `gauss_codegen::parameters::Given` and `gauss_runtime::table::Joined`.
    ("crates/gauss-parry", 1),
    ("crates/gauss-robots", 2),
    ("gauss-codegen", 1),
    ("gauss-runtime", 1),
];

/// Names that several types of a library have, each in a file of its own. The numbers only fall.
const SHARED_LEFT: [(&str, usize); 4] = [
    ("crates/gauss-contact", 4),
    ("crates/gauss-python", 4),
    // `Clause`, `Content`, `Field` and `Value` of the public `Scene`, `Scalar` of public programs, and those within.
    ("gauss-codegen", 5),
    // `Each` of contacts and of events, which are public, and `Rows` with and without packs.
    ("gauss-runtime", 2),
];

/// The lines, from one, at which docs begin with such a word: of items, fields and modules alike.
fn nameless(text: &str) -> Vec<usize> {
    let mut before = None;
    let mut found = Vec::new();
    for (line, number) in text.lines().zip(1..) {
        let line = line.trim_start();
        let mark = ["///", "//!"].into_iter().find(|mark| line.starts_with(mark) && !line.starts_with("////"));
        if let Some(mark) = mark.filter(|_| before != mark) {
            let mut words = line[mark.len()..].split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
            found.extend(words.next().filter(|word| NAMELESS.contains(word)).map(|_| number));
        }
        before = mark;
    }
    found
}

/// Types that a file defines, but in its inner modules and in the code of its docs, with the words that define them and
/// their lines, from one.
fn types(text: &str) -> Vec<(&str, &str, usize)> {
    let mut found = Vec::new();
    let mut in_docs = false;
    for (line, number) in text.lines().zip(1..) {
        in_docs ^= line.starts_with("```");
        let line = match line.strip_prefix("pub(").and_then(|rest| rest.split_once(") ")) {
            Some((_, rest)) => rest,
            None => line.strip_prefix("pub ").unwrap_or(line),
        };
        let Some((word, rest)) = line.split_once(' ') else { continue };
        if !in_docs && ["struct", "enum", "trait", "type", "union"].contains(&word) {
            let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
            found.push((word, &rest[..end], number));
        }
    }
    found
}

/// Files of a library with their texts.
fn texts(library: &str) -> Vec<(String, String)> {
    let sources = files().into_iter().filter(|file| file.starts_with(&format!("{library}/src/")));
    let read = |file: String| match fs::read_to_string(here().join("..").join(&file)) {
        Ok(text) => (file, text),
        Err(error) => panic!("{file}: {error}"),
    };
    sources.map(read).collect()
}

/// Refuses a library in which more is found than is left of it, a line each, and numbers that could be lower.
fn compare(left: &[(&str, usize)], complaint: &str, find: impl Fn(&[(String, String)]) -> Vec<String>) {
    let mut wrong = String::new();
    for library in libraries() {
        let found = find(&texts(&library));
        let left = left.iter().find(|(name, _)| *name == library).map_or(0, |(_, left)| *left);
        if found.len() > left {
            wrong += &format!("{library}: {} {complaint}, {left} may:\n{}", found.len(), found.concat());
        } else if found.len() < left {
            wrong += &format!("{library}: {left} {complaint}, and {} are left: lower the number\n", found.len());
        }
    }
    assert!(wrong.is_empty(), "\n{wrong}");
}

#[test]
fn docs_begin_with_what_an_item_is() {
    compare(&DOCS_LEFT, &format!("docs begin with one of {NAMELESS:?}"), |texts| {
        let of_file = |(file, text): &(String, String)| {
            nameless(text).into_iter().map(|line| format!("  {file}:{line}\n")).collect::<Vec<_>>()
        };
        texts.iter().flat_map(of_file).collect()
    });
}

#[test]
fn types_have_nouns_for_names() {
    let refused: BTreeSet<&str> = NO_NOUNS.split_whitespace().collect();
    compare(&TYPES_LEFT, "types are named by a participle, a pronoun or a preposition", |texts| {
        let of_file = |(file, text): &(String, String)| {
            let wrong = types(text).into_iter().filter(|(_, name, _)| refused.contains(name));
            wrong.map(|(word, name, line)| format!("  {file}:{line}: {word} {name}\n")).collect::<Vec<_>>()
        };
        texts.iter().flat_map(of_file).collect()
    });
}

#[test]
fn types_with_one_name_are_one() {
    let is_test = |file: &str| file.ends_with("tests.rs") || file.contains("/tests/");
    compare(&SHARED_LEFT, "names are those of several types", |texts| {
        let mut places: BTreeMap<&str, Vec<String>> = BTreeMap::new();
        for (file, text) in texts.iter().filter(|(file, _)| !is_test(file)) {
            let names: BTreeMap<&str, usize> = types(text)
                .into_iter()
                .filter(|(word, ..)| *word != "type")
                .map(|(_, name, line)| (name, line))
                .collect();
            for (name, line) in names {
                places.entry(name).or_default().push(format!("{file}:{line}"));
            }
        }
        let shared = places.into_iter().filter(|(_, places)| places.len() > 1);
        shared.map(|(name, places)| format!("  {name}: {}\n", places.join(", "))).collect()
    });
}

#[test]
fn first_words_are_told_apart() {
    let text = "//! What it is.\n\nuse a::b;\n/// Of the link.\n/// What follows is no beginning.\npub x: f64,\n";
    assert_eq!(nameless(text), [1, 4]);
    let named = "/// Whatever.\nfn f() {}\n/// `What` and why.\n//// Of no docs.\n// Of no docs.\n/// Half of it.\n";
    assert_eq!(nameless(named), [3]);
}

#[test]
fn types_are_found_where_they_are_defined() {
    let text = "pub struct Given<'g> {\nenum About;\npub(in crate::a) type Known = u8;\n    struct Kept;\n// struct Made\n\
                pub trait Held: Sized {\nfn f() -> Found {\n```\nstruct Pendulum {\n```\n";
    let found = [("struct", "Given", 1), ("enum", "About", 2), ("type", "Known", 3), ("trait", "Held", 6)];
    assert_eq!(types(text), found);
}
