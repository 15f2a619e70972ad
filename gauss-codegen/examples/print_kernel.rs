//! What is derived from a struct in a Rust file: `cargo run -p gauss-codegen --example print_kernel -- FILE NAME --as FORM`.
//!
//! | form | what is printed |
//! |---|---|
//! | `text` (if none is said) | the equations, and the operations of every method |
//! | `latex` | the equations as one LaTeX environment |
//! | `program` | the programs, one instruction a line; `program=acceleration` one of them |
//! | `c` | a source file in C99 |
//! | `rust` | what the derive writes |
//! | `functions` | functions of `f64` in Rust that need nothing else |

use std::process::ExitCode;

use gauss_codegen::{Derivation, Notation, targets};

const USAGE: &str = "print_kernel FILE NAME [--as text|latex|program|program=METHOD|c|rust|functions]";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let printed = match arguments[..] {
        [file, name] => print(file, name, "text"),
        [file, name, "--as", form] => print(file, name, form),
        _ => Err(USAGE.to_owned()),
    };
    match printed {
        Ok(text) => {
            print!("{text}");
            ExitCode::SUCCESS
        }
        Err(mistakes) => {
            eprintln!("{mistakes}");
            ExitCode::FAILURE
        }
    }
}

fn print(file: &str, name: &str, form: &str) -> Result<String, String> {
    let source = std::fs::read_to_string(file).map_err(|error| format!("{file}: {error}"))?;
    let derivation = Derivation::of_source(&source, name).map_err(|mistakes| said(file, &mistakes))?;
    match form.split_once('=').unwrap_or((form, "")) {
        ("text", "") => Ok(format!("{}\n{}", derivation.equations(Notation::Text), operations(&derivation))),
        ("latex", "") => Ok(derivation.equations(Notation::Latex).to_owned()),
        ("program", "") => {
            let programs = std::iter::once(derivation.constants()).chain(derivation.programs());
            Ok(programs.map(ToString::to_string).collect::<Vec<_>>().join("\n"))
        }
        ("program", method) => {
            let program = derivation.program(method).map(ToString::to_string);
            program.ok_or_else(|| format!("{name} has no method {method}"))
        }
        ("c", "") => Ok(targets::c::source(&derivation)),
        ("rust", "") => pretty(derivation.rust().clone()),
        ("functions", "") => pretty(targets::rust::source(&derivation)),
        _ => Err(USAGE.to_owned()),
    }
}

fn pretty(code: proc_macro2::TokenStream) -> Result<String, String> {
    let file = syn::parse2(code).map_err(|error| format!("what was written is no Rust: {error}"))?;
    Ok(prettyplease::unparse(&file))
}

/// Every mistake with its place.
fn said(file: &str, mistakes: &syn::Error) -> String {
    let lines = mistakes.into_iter().map(|mistake| {
        let start = mistake.span().start();
        format!("{file}:{}:{}: {mistake}", start.line, start.column + 1)
    });
    lines.collect::<Vec<_>>().join("\n")
}

fn operations(derivation: &Derivation) -> String {
    let programs = std::iter::once(derivation.constants()).chain(derivation.programs());
    let rows = programs.map(|program| {
        let cost = program.code.cost();
        format!(
            "{:<22}{:<48} cost {:>5}, chain {:>4}\n",
            program.name,
            program.code.counts().to_string(),
            cost.total(),
            cost.chain
        )
    });
    rows.collect()
}
