//! Sections of Markdown pages that tests write, between `<!-- name:begin -->` and `<!-- name:end -->`.

use std::path::{Path, PathBuf};

/// The folder of the repository.
#[must_use]
pub fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Compares a section of a page of the repository with what it should say; with `UPDATE_BENCHMARKS=1` it is rewritten.
///
/// # Panics
/// When the section is not there, or says something else.
pub fn keep(page: &str, name: &str, contents: &str) {
    let path = repository().join(page);
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{page}: {error}"));
    let wanted = format!("<!-- {name}:begin -->\n{contents}<!-- {name}:end -->");
    let [begin, end] = ["begin", "end"].map(|word| format!("<!-- {name}:{word} -->"));
    let section = text.find(&begin).and_then(|start| Some(start..start + text[start..].find(&end)? + end.len()));
    let Some(section) = section else {
        panic!("{page} has no section `{name}`; paste this where it belongs:\n\n{wanted}\n");
    };
    if text[section.clone()] == wanted {
        return;
    }
    if std::env::var("UPDATE_BENCHMARKS").is_ok_and(|value| value == "1") {
        let mut updated = text;
        updated.replace_range(section, &wanted);
        std::fs::write(path, updated).unwrap_or_else(|error| panic!("{page}: {error}"));
    } else {
        panic!("{page} is out of date; run this test with UPDATE_BENCHMARKS=1, or paste:\n\n{wanted}\n");
    }
}
