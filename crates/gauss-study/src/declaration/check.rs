//! Mistakes in a declaration, all of them at once.

use std::collections::HashSet;

use super::content::Declaration;
use crate::distribution::Distribution;
use crate::plan::Plan;

/// Columns that every file has.
const RESERVED: [&str; 3] = ["seed", "run", "cause"];

/// Whether it takes a random number.
pub fn is_random(distribution: &Distribution) -> bool {
    !matches!(distribution, Distribution::Fixed { .. } | Distribution::Grid { .. })
}

pub fn mistakes(declaration: &Declaration) -> Vec<String> {
    let mut mistakes = Vec::new();
    if declaration.runs == 0 || i64::try_from(declaration.runs).is_err() {
        mistakes.push(format!("runs = {}: there should be one at least and less than 2⁶³", declaration.runs));
    }
    if declaration.part == 0 || declaration.part > 1 << 24 {
        mistakes.push(format!("runs_per_part = {}: should be from 1 to 2²⁴", declaration.part));
    }
    names(declaration, &mut mistakes);
    for parameter in &declaration.parameters {
        if let Some(mistake) = parameter.distribution.mistake() {
            mistakes.push(format!("parameter `{}`, {:?}: {mistake}", parameter.name, parameter.distribution));
        }
    }
    plan(declaration, &mut mistakes);
    mistakes
}

fn names(declaration: &Declaration, mistakes: &mut Vec<String>) {
    let parameters = declaration.parameters.iter().map(|parameter| &parameter.name);
    let names = parameters.chain(declaration.columns.iter().map(|column| &column.name));
    let mut seen = HashSet::new();
    for name in names {
        let letters = |c: char| c.is_alphanumeric() || c == '_';
        if name.is_empty() || name.starts_with(|c: char| c.is_numeric()) || !name.chars().all(letters) {
            mistakes.push(format!("`{name}`: a name is of letters, digits and `_`, and begins with no digit"));
        }
        if RESERVED.contains(&name.as_str()) {
            mistakes.push(format!("`{name}`: every file has a column of that name"));
        }
        if !seen.insert(name) {
            mistakes.push(format!("`{name}`: two columns have that name"));
        }
    }
}

fn plan(declaration: &Declaration, mistakes: &mut Vec<String>) {
    let plan = declaration.plan;
    let random = declaration.parameters.iter().filter(|parameter| is_random(&parameter.distribution)).count();
    if random > plan.most() {
        mistakes.push(format!("{plan:?} fills {} parameters at most, not {random}", plan.most()));
    }
    let sweeps = declaration.parameters.iter().any(|parameter| parameter.distribution.steps().is_some());
    if sweeps && matches!(plan, Plan::Sobol | Plan::Saltelli) {
        mistakes
            .push(format!("{plan:?} beside a grid: every number of the grid would get a part of the sequence only"));
    }
    let group = plan.group(random);
    if plan == Plan::Saltelli && (random == 0 || !declaration.runs.is_multiple_of(group)) {
        mistakes.push(format!("Saltelli of {random} random parameters: runs should come in groups of {group}"));
    }
}
