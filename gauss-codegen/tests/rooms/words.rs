//! First words of docs: "Factors of A⁻¹Wᵀ" names an item, "Those of A⁻¹Wᵀ" does not.

use std::fs;

use crate::{files, here, libraries};

/// Words that begin a sentence without a noun or a verb for the item.
const NAMELESS: [&str; 9] = ["What", "Of", "With", "By", "Those", "That", "For", "Where", "How"];

/// Docs that still begin so, by library; no other has any. The numbers only fall.
const LEFT: [(&str, usize); 4] = [
    ("crates/gauss-contact", 220),
    ("crates/gauss-jit", 19),
    ("crates/gauss-python", 117),
    // It is written into code that users read, and snapshots hold it.
    ("gauss-codegen", 1),
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

#[test]
fn docs_begin_with_what_an_item_is() {
    let files = files();
    let mut wrong = String::new();
    for library in libraries() {
        let mut found = Vec::new();
        for file in files.iter().filter(|file| file.starts_with(&format!("{library}/src/"))) {
            let text =
                fs::read_to_string(here().join("..").join(file)).unwrap_or_else(|error| panic!("{file}: {error}"));
            found.extend(nameless(&text).into_iter().map(|line| format!("  {file}:{line}\n")));
        }
        let left = LEFT.iter().find(|(name, _)| *name == library).map_or(0, |(_, left)| *left);
        if found.len() > left {
            let count = found.len();
            wrong +=
                &format!("{library}: {count} docs begin with one of {NAMELESS:?}, {left} may:\n{}", found.concat());
        } else if found.len() < left {
            wrong += &format!("{library}: {left} docs may begin so, and {} do: lower the number\n", found.len());
        }
    }
    assert!(wrong.is_empty(), "\n{wrong}");
}

#[test]
fn first_words_are_told_apart() {
    let text = "//! What it is.\n\nuse a::b;\n/// Of the link.\n/// What follows is no beginning.\npub x: f64,\n";
    assert_eq!(nameless(text), [1, 4]);
    let named = "/// Whatever.\nfn f() {}\n/// `What` and why.\n//// Of no docs.\n// Of no docs.\n/// Half of it.\n";
    assert_eq!(nameless(named), [3]);
}
