//! Names that are not in a file, with the nearest that are.

use strsim::damerau_levenshtein;

/// `` `elbw`, which is no joint; did you mean `elbow`? ``
pub fn unknown<'a>(noun: &str, name: &str, known: impl Iterator<Item = &'a str>) -> String {
    match nearest(name, known) {
        Some(near) => format!("`{name}`, which is no {noun}; did you mean `{near}`?"),
        None => format!("`{name}`, which is no {noun} of this file"),
    }
}

/// The first of the names with the fewest wrong letters: at most a third of them, one always; case and underscores do
/// not count.
fn nearest<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let plain = |name: &str| name.replace('_', "").to_lowercase();
    let most = (name.chars().count() / 3).max(1);
    let wrong = |other: &str| match plain(name) == plain(other) {
        true => 0,
        false => damerau_levenshtein(&name.to_lowercase(), &other.to_lowercase()),
    };
    known
        .map(|other| (wrong(other), other))
        .filter(|(wrong, _)| *wrong <= most)
        .min_by_key(|(wrong, _)| *wrong)
        .map(|(_, other)| other)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_are_misspelt() {
        let of = |name| unknown("joint", name, ["elbow", "left_hip", "hip"].into_iter());
        assert_eq!(of("elbw"), "`elbw`, which is no joint; did you mean `elbow`?");
        assert_eq!(of("LeftHip"), "`LeftHip`, which is no joint; did you mean `left_hip`?");
        assert_eq!(of("shoulder"), "`shoulder`, which is no joint of this file");
    }
}
