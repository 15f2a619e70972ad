//! Programs as source text, in Rust, C99 and C++17, for CasADi too. A target is a module that reads [`Program`]s and
//! writes code.

use std::fmt::Write;

use crate::program::{Argument, ArgumentKind, Program, Results};

pub mod c;
pub mod casadi;
pub mod cpp;
pub mod rust;

mod arrays;

/// Arguments without components are left out.
fn is_handed_over(argument: &Argument) -> bool {
    !argument.components.is_empty()
}

/// Whether all that a program gives is one number.
fn only_scalar(program: &Program) -> bool {
    matches!(program.results.as_slice(), [result] if result.is_scalar())
}

/// A function's arguments, results and costs in words. `name` gives the name of a result.
fn header(program: &Program, name: impl Fn(&Results) -> String) -> String {
    let mut out = String::new();
    for argument in program.arguments.iter().filter(|argument| is_handed_over(argument)) {
        let Argument { kind, name, components } = argument;
        match kind {
            ArgumentKind::Time | ArgumentKind::Constants => writeln!(out, "{name}: {kind}").ok(),
            _ => writeln!(out, "{name}: {kind} {}", components.join(", ")).ok(),
        };
    }
    for result in &program.results {
        let (name, Results { rows, columns, .. }) = (name(result), result);
        match (only_scalar(program), columns) {
            (true, _) => writeln!(out, "returns {name}").ok(),
            (_, 1) if *rows == 1 => writeln!(out, "{name}: a number").ok(),
            (_, 1) => writeln!(out, "{name}: {rows} numbers").ok(),
            _ => writeln!(out, "{name}: {rows} rows of {columns}").ok(),
        };
    }
    writeln!(out, "operations: {}", program.code.counts()).ok();
    out
}

/// `HeavyTop` becomes `heavy_top`; what no name in C can have is `_`.
fn snake(name: &str) -> String {
    let mut out = String::new();
    for c in name.chars() {
        if c.is_uppercase() && !out.is_empty() && !out.ends_with('_') {
            out.push('_');
        }
        out.extend(if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' }.to_lowercase());
    }
    out
}
