//! What the methods of a robot give at states, for whoever compares them with another library: plain lines of words.

use std::fmt::Write;
use std::io::BufRead;

use gauss_codegen::Derivation;
use gauss_codegen::program::{ArgumentKind, Program};

/// What a state is made of, in the order in which it is read.
const PARTS: [(ArgumentKind, &str); 5] = [
    (ArgumentKind::Time, "time"),
    (ArgumentKind::Configuration, "configuration"),
    (ArgumentKind::Speeds, "speeds"),
    (ArgumentKind::Accelerations, "accelerations"),
    (ArgumentKind::Inputs, "inputs"),
];

/// Writes the names of components and what programs cost. Then every line that is read is a state, with `|` between its
/// parts, and gives a line `METHOD NUMBER…` for each method that needs nothing else, and an empty one.
pub fn answer(
    derivation: &Derivation,
    seconds: f64,
    read: impl BufRead,
    mut write: impl std::io::Write,
) -> Result<(), String> {
    let failed = |error: std::io::Error| error.to_string();
    let programs: Vec<&Program> = derivation.programs().iter().filter(|program| is_of_state(program)).collect();
    write!(write, "{}", head(derivation, seconds)).map_err(failed)?;
    // Numbers of the file are literals: there are no parameters.
    let constants = derivation.constants().run::<f64>(&[&[]]).map_err(|error| error.to_string())?;
    for line in read.lines() {
        let parts = parts(&line.map_err(failed)?)?;
        for program in &programs {
            let arguments: Vec<&[f64]> = program
                .arguments
                .iter()
                .map(|argument| {
                    let part = PARTS.iter().position(|(kind, _)| *kind == argument.kind);
                    part.map_or(constants.as_slice(), |part| parts[part].as_slice())
                })
                .collect();
            let values = program.run(&arguments).map_err(|error| format!("{}: {error}", program.name))?;
            write!(write, "{}", program.name).map_err(failed)?;
            values.iter().try_for_each(|value| write!(write, " {value:e}")).map_err(failed)?;
            writeln!(write).map_err(failed)?;
        }
        writeln!(write).map_err(failed)?;
    }
    Ok(())
}

fn is_of_state(program: &Program) -> bool {
    let known = |kind| kind == ArgumentKind::Constants || PARTS.iter().any(|(part, _)| *part == kind);
    program.arguments.iter().all(|argument| known(argument.kind))
}

/// Lines of a key and what belongs to it, and an empty one.
fn head(derivation: &Derivation, seconds: f64) -> String {
    let mut out = format!("seconds {seconds}\n");
    for (kind, word) in PARTS {
        let arguments = derivation.programs().iter().flat_map(|program| &program.arguments);
        let components =
            arguments.filter(|argument| argument.kind == kind).map(|argument| argument.components.join(" "));
        let _ = writeln!(out, "{word} {}", components.take(1).collect::<String>());
    }
    for remark in derivation.remarks() {
        let _ = writeln!(out, "remark {remark}");
    }
    for program in derivation.programs() {
        let counts = program.code.counts();
        let all = [counts.additions, counts.multiplications, counts.divisions + counts.roots, counts.transcendentals];
        let all = all.map(|count| count.to_string()).join(" ");
        let _ = writeln!(out, "operations {} {all}", program.name);
    }
    out + "\n"
}

fn parts(line: &str) -> Result<Vec<Vec<f64>>, String> {
    let numbers = |part: &str| {
        let number = |word: &str| word.parse().map_err(|error| format!("`{word}`: {error}"));
        part.split_whitespace().map(number).collect::<Result<Vec<f64>, String>>()
    };
    let parts = line.split('|').map(numbers).collect::<Result<Vec<_>, String>>()?;
    let count = PARTS.len();
    if parts.len() == count { Ok(parts) } else { Err(format!("a state has {count} parts, found {}", parts.len())) }
}
