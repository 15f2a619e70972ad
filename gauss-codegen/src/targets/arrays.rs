//! The arrays that functions of a scene take, with a name for the place of each number.

use std::collections::BTreeSet;

use crate::program::{ArgumentKind, Functions};

use super::{is_handed_over, snake};

/// An array that functions take.
pub(super) struct Array {
    pub(super) name: String,
    pub(super) size: usize,
    /// Identifiers of its numbers; none where they are constants of a kernel, which nobody names.
    pub(super) places: Vec<String>,
}

/// The arrays of all functions, each once, in the order in which they come.
pub(super) fn arrays(functions: &Functions) -> Vec<Array> {
    let mut all: Vec<Array> = Vec::new();
    for argument in functions.programs().flat_map(|program| &program.arguments).filter(|a| is_handed_over(a)) {
        if argument.kind == ArgumentKind::Time || all.iter().any(|array| array.name == argument.name) {
            continue;
        }
        let named = argument.kind != ArgumentKind::Constants;
        let places = if named { identifiers(&argument.components) } else { Vec::new() };
        all.push(Array { name: argument.name.clone(), size: argument.components.len(), places });
    }
    all
}

/// Names as identifiers, no two of them alike: what would be is followed by its place. How many there are is `count`.
fn identifiers(names: &[String]) -> Vec<String> {
    let mut taken = BTreeSet::from(["count".to_owned()]);
    let identifier = |(place, name): (usize, &String)| {
        let short: Vec<String> =
            snake(&spelled(name)).split('_').filter(|part| !part.is_empty()).map(String::from).collect();
        let mut short = short.join("_");
        if short.is_empty() || short.starts_with(|c: char| c.is_ascii_digit()) {
            short = format!("n{short}");
        }
        while !taken.insert(short.clone()) {
            short = format!("{short}_{place}");
        }
        short
    };
    names.iter().enumerate().map(identifier).collect()
}

/// Names of the letters from α to ω.
const GREEK: [&str; 25] = [
    "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa", "lambda", "mu", "nu", "xi",
    "omicron", "pi", "rho", "sigma", "sigma", "tau", "upsilon", "phi", "chi", "psi", "omega",
];

/// A name with its Greek letters by their names, small ones for capitals, whose arrays have names of their own.
fn spelled(name: &str) -> String {
    let letter = |c: char| {
        let small = c.to_lowercase().next().unwrap_or(c);
        match u32::from(small).checked_sub(u32::from('α')).and_then(|place| GREEK.get(place as usize)) {
            Some(greek) => (*greek).to_owned(),
            None => c.to_string(),
        }
    };
    name.chars().map(letter).collect()
}

#[cfg(test)]
mod tests {
    use super::identifiers;

    #[test]
    fn places_have_names_that_differ() {
        let names = ["arm.angle", "arm_angle", "R.w", "ω1", "Γ2", "→", "2nd", "arm__angle", "count"].map(String::from);
        let expected = ["arm_angle", "arm_angle_1", "r_w", "omega1", "gamma2", "n", "n2nd", "arm_angle_7", "count_8"];
        assert_eq!(identifiers(&names), expected);
    }
}
