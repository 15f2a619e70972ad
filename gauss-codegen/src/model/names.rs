//! Words of the language, and the nearest of them to a misspelt one.

use super::context::Context;
use std::collections::BTreeMap;
use syn::Ident;
use syn::ext::IdentExt;

/// Words with their meanings, in the order in which messages list them.
pub(super) type Table<T> = [(&'static str, T)];

/// Meaning of `ident`.
///
/// # Errors
/// An unknown word is noted as a mistake; the error value is the meaning of the nearest word, when there is one, so
/// that callers need not complain once more about what is merely misspelt.
pub(super) fn resolve<T: Copy>(
    noun: &str,
    ident: &Ident,
    table: &Table<T>,
    context: &mut Context,
) -> Result<T, Option<T>> {
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
pub(super) fn nearest<'a, T: Copy>(word: &str, table: &[(&'a str, T)]) -> Option<(&'a str, T)> {
    let plain = |name: &str| name.replace('_', "").to_lowercase();
    if let Some(&entry) = table.iter().find(|(name, _)| plain(name) == plain(word)) {
        return Some(entry);
    }
    let limit = (word.chars().count() / 3).max(1);
    table
        .iter()
        .map(|&entry| (distance(&word.to_lowercase(), &entry.0.to_lowercase()), entry))
        .filter(|&(distance, _)| distance <= limit)
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, entry)| entry)
}

/// `a speed`, `an input`.
pub(super) fn a(noun: &str) -> String {
    let article = if noun.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" };
    format!("{article} {noun}")
}

/// `` `a`, `b` or `c` ``.
pub(super) fn list<T>(table: &[(&str, T)]) -> String {
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

/// Damerau–Levenshtein distance: insertions, deletions, substitutions and transpositions of neighbours, with edits
/// allowed between the transposed letters (the unrestricted form, by Lowrance and Wagner).
fn distance(a: &str, b: &str) -> usize {
    let a: Vec<char> = a.chars().collect();
    let b: Vec<char> = b.chars().collect();
    let bound = a.len() + b.len();
    // One row and one column more than the usual table: they hold `bound`, which no edit can profit from.
    let mut cost = vec![vec![bound; b.len() + 2]; a.len() + 2];
    for (i, row) in cost.iter_mut().enumerate().skip(1) {
        row[1] = i - 1;
    }
    for (j, cell) in cost[1].iter_mut().enumerate().skip(1) {
        *cell = j - 1;
    }
    // Last row in which each letter of `a` was seen, and last column of this row in which the letters agreed.
    let mut last_row: BTreeMap<char, usize> = BTreeMap::new();
    for i in 1..=a.len() {
        let mut last_column = 0;
        for j in 1..=b.len() {
            let row = last_row.get(&b[j - 1]).copied().unwrap_or(0);
            let column = last_column;
            let same = a[i - 1] == b[j - 1];
            if same {
                last_column = j;
            }
            let substitution = cost[i][j] + usize::from(!same);
            let insertion = cost[i + 1][j] + 1;
            let deletion = cost[i][j + 1] + 1;
            let transposition = cost[row][column] + (i - row - 1) + 1 + (j - column - 1);
            cost[i + 1][j + 1] = substitution.min(insertion).min(deletion).min(transposition);
        }
        last_row.insert(a[i - 1], i);
    }
    cost[a.len() + 1][b.len() + 1]
}

#[cfg(test)]
mod tests {
    use super::{distance, list, nearest};

    #[test]
    fn distances() {
        assert_eq!(distance("", ""), 0);
        assert_eq!(distance("", "mass"), 4);
        assert_eq!(distance("mass", "mass"), 0);
        assert_eq!(distance("mas", "mass"), 1);
        assert_eq!(distance("hybird", "hybrid"), 1);
        assert_eq!(distance("centre", "center"), 1);
        assert_eq!(distance("ca", "abc"), 2);
        assert_eq!(distance("kitten", "sitting"), 3);
    }

    #[test]
    fn suggestions_stop_where_they_would_mislead() {
        let table = [("mass", 1), ("inertia", 2), ("left_invariant", 3)];
        assert_eq!(nearest("mess", &table), Some(("mass", 1)));
        assert_eq!(nearest("LeftInvariant", &table), Some(("left_invariant", 3)));
        assert_eq!(nearest("pos", &[("Pose", 1)]), Some(("Pose", 1)));
        assert_eq!(nearest("weight", &table), None);
        assert_eq!(nearest("moss_", &table), None);
    }

    #[test]
    fn lists() {
        assert_eq!(list(&[("a", ())]), "`a`");
        assert_eq!(list(&[("a", ()), ("b", ()), ("c", ())]), "`a`, `b` or `c`");
    }
}
