//! Words of the language, and the nearest of them to a misspelt one.

use super::context::Context;
use strsim::damerau_levenshtein;
use syn::Ident;
use syn::ext::IdentExt;

/// Words with their meanings, in the order in which messages list them.
pub type Table<T> = [(&'static str, T)];

/// Meaning of `ident`.
///
/// # Errors
/// An unknown word is noted as a mistake; the error value is the meaning of the nearest word, when there is one, so
/// that callers need not complain once more about what is merely misspelt.
pub fn resolve<T: Copy>(noun: &str, ident: &Ident, table: &Table<T>, context: &mut Context) -> Result<T, Option<T>> {
    let word = ident.unraw().to_string();
    if let Some(&(_, meaning)) = table.iter().find(|(name, _)| *name == word) {
        return Ok(meaning);
    }
    let near = nearest(&word, table);
    let remedy = match near {
        Some((name, _)) => format!("did you mean `{name}`?"),
        None => format!("expected {}", list(table)),
    };
    context.error(ident.span(), format!("unknown {noun} `{word}`; {remedy}"));
    Err(near.map(|(_, meaning)| meaning))
}

/// The entry whose name is nearest to `word`, if any is near enough: at most a third of the letters wrong, one letter
/// always allowed; case and underscores count for nothing. Of equally near names the first wins.
pub fn nearest<'a, T: Copy>(word: &str, table: &[(&'a str, T)]) -> Option<(&'a str, T)> {
    all_nearest(word, table).into_iter().next()
}

/// All entries whose names are as near to `word` as the [`nearest`], in their order: numbered names often are.
pub fn all_nearest<'a, T: Copy>(word: &str, table: &[(&'a str, T)]) -> Vec<(&'a str, T)> {
    let plain = |name: &str| name.replace('_', "").to_lowercase();
    if let Some(&entry) = table.iter().find(|(name, _)| plain(name) == plain(word)) {
        return vec![entry];
    }
    let limit = (word.chars().count() / 3).max(1);
    let distances = || table.iter().map(|&(name, _)| damerau_levenshtein(&word.to_lowercase(), &name.to_lowercase()));
    let least = distances().min().filter(|&distance| distance <= limit);
    let near = table.iter().zip(distances()).filter(|&(_, distance)| Some(distance) == least);
    near.map(|(&entry, _)| entry).collect()
}

/// `a speed`, `an input`.
pub fn a(noun: &str) -> String {
    let article = if noun.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" };
    format!("{article} {noun}")
}

/// `` `a`, `b` or `c` ``.
pub fn list<T>(table: &[(&str, T)]) -> String {
    let mut text = String::new();
    for (index, (name, _)) in table.iter().enumerate() {
        if index > 0 {
            text.push_str(if index + 1 == table.len() { " or " } else { ", " });
        }
        text.push('`');
        text.push_str(name);
        text.push('`');
    }
    text
}

/// The name of time.
pub const TIME: &str = "t";

/// The name of the ratio of a circle's circumference to its diameter.
pub const PI: &str = "pi";

/// Name of a body without a name of its own, in expressions and clauses.
pub const UNNAMED: &str = "body";

/// Word before the name of an input, `input.elbow`.
pub const INPUT: &str = "input";

/// The name without `r#`.
pub fn word(name: &Ident) -> String {
    name.unraw().to_string()
}

/// The same name, raw or not.
pub fn same(a: &Ident, b: &Ident) -> bool {
    a.unraw() == b.unraw()
}

#[cfg(test)]
mod tests {
    use super::{all_nearest, damerau_levenshtein, list, nearest};

    #[test]
    fn distances_let_neighbours_change_places() {
        assert_eq!(damerau_levenshtein("", ""), 0);
        assert_eq!(damerau_levenshtein("", "mass"), 4);
        assert_eq!(damerau_levenshtein("mass", "mass"), 0);
        assert_eq!(damerau_levenshtein("mas", "mass"), 1);
        assert_eq!(damerau_levenshtein("hybird", "hybrid"), 1);
        assert_eq!(damerau_levenshtein("centre", "center"), 1);
        assert_eq!(damerau_levenshtein("ca", "abc"), 2);
        assert_eq!(damerau_levenshtein("kitten", "sitting"), 3);
    }

    #[test]
    fn suggestions_stop_where_they_would_mislead() {
        let table = [("mass", 1), ("inertia", 2), ("left_invariant", 3)];
        assert_eq!(nearest("mess", &table), Some(("mass", 1)));
        assert_eq!(nearest("LeftInvariant", &table), Some(("left_invariant", 3)));
        assert_eq!(nearest("pos", &[("Pose", 1)]), Some(("Pose", 1)));
        assert_eq!(nearest("weight", &table), None);
        assert_eq!(nearest("moss_", &table), None);
        let numbered = [("base", 0), ("joint1", 1), ("joint2", 2), ("joint_10", 3)];
        assert_eq!(all_nearest("joint9", &numbered), [("joint1", 1), ("joint2", 2)]);
        assert_eq!(all_nearest("JOINT10", &numbered), [("joint_10", 3)]);
        assert_eq!(all_nearest("hand", &numbered), []);
    }

    #[test]
    fn lists() {
        assert_eq!(list(&[("a", ())]), "`a`");
        assert_eq!(list(&[("a", ()), ("b", ()), ("c", ())]), "`a`, `b` or `c`");
    }
}
