//! `cargo gauss show`: prints what is derived.

use std::fs;

use gauss_codegen::program::Program;
use gauss_codegen::targets::c::Precision;
use gauss_codegen::{Derivation, Notation, targets};
use proc_macro2::TokenStream;
use syn::{DeriveInput, Error};

use crate::arguments::{Form, Show};
use crate::charts::in_chart;
use crate::shown::{Shown, loss};
use crate::structs::located;
use crate::{documents, page, robots, structs};

/// Prints it, or writes it to a file.
///
/// # Errors
/// What is wrong with the file, the names or the structs, each with its place.
pub fn show(wanted: &Show) -> Result<(), String> {
    if !wanted.methods.is_empty() && !wanted.form.has_methods() {
        return Err("`--method` goes with `--as program`, `c`, `header`, `cpp`, `casadi` or `functions`".to_owned());
    }
    if wanted.single && !matches!(wanted.form, Form::C | Form::Header) {
        return Err("`--single` goes with `--as c` and `header`; functions of `--as cpp` take any type".to_owned());
    }
    if matches!(wanted.form, Form::Mjcf | Form::Urdf) {
        return put(wanted, documents::document(wanted)?);
    }
    if !(wanted.set.is_empty() && wanted.clause.is_empty()) {
        return Err(
            "`--set` and `--clause` go with `--as mjcf` and `urdf`; all other forms keep their parameters".to_owned()
        );
    }
    let file = wanted.file.display().to_string();
    let source = fs::read_to_string(&wanted.file).map_err(|error| format!("{file}: {error}"))?;
    // A first line may name a program that runs the file.
    let source = if source.starts_with("#!/") { source.replacen("#!", "//", 1) } else { source };
    let tokens = source.parse::<TokenStream>().map_err(|error| Error::new(error.span(), "this is no Rust"));
    let items = tokens.and_then(|tokens| structs::find(tokens, &wanted.names));
    let mut items = items.map_err(|mistakes| located(&wanted.file, &mistakes))?;
    if let Some(package) = robots::package_of(&wanted.file) {
        items.iter_mut().for_each(|item| robots::by_whole_paths(item, &package));
    }
    let all = derive(wanted, &items)?;
    let text = match wanted.form {
        Form::Html => page::html(&file, &all),
        _ => all.iter().map(|shown| text(shown, wanted)).collect::<Result<Vec<_>, _>>()?.join("\n"),
    };
    put(wanted, text)
}

/// Prints a text, or writes it to the file that is wanted, whole or not at all.
fn put(wanted: &Show, text: String) -> Result<(), String> {
    match &wanted.output {
        Some(path) => gauss_files::write(path, text).map_err(|error| format!("{}: {error}", path.display())),
        None => {
            print!("{text}");
            Ok(())
        }
    }
}

fn derive(wanted: &Show, items: &[DeriveInput]) -> Result<Vec<Shown>, String> {
    let (mut all, mut mistakes) = (Vec::new(), Vec::new());
    let mut add = |title: String, item: &DeriveInput| match Derivation::new(item) {
        Ok(derivation) => all.push(Shown { title, derivation }),
        Err(error) => mistakes.push(located(&wanted.file, &error)),
    };
    for item in items {
        if wanted.charts.is_empty() {
            add(item.ident.to_string(), item);
        }
        for chart in &wanted.charts {
            add(format!("{}, {chart}", item.ident), &in_chart(item, chart)?);
        }
    }
    if mistakes.is_empty() { Ok(all) } else { Err(mistakes.join("\n")) }
}

fn text(shown: &Shown, wanted: &Show) -> Result<String, String> {
    let (derivation, form, methods) = (&shown.derivation, wanted.form, &wanted.methods);
    let precision = if wanted.single { Precision::Single } else { Precision::Double };
    let functions = derivation.functions().only(methods).map_err(|error| error.to_string())?;
    let touching: Vec<&str> = derivation.description().contacts.iter().map(|contact| contact.name.as_str()).collect();
    if form.has_methods() && form != Form::Program && !touching.is_empty() {
        eprintln!("{}: forces of contacts ({}) are in none of these functions", shown.title, touching.join(", "));
    }
    match form {
        Form::Text => Ok(plain(shown)),
        Form::Latex => Ok(derivation.equations(Notation::Latex).to_owned()),
        Form::Program if methods.is_empty() => Ok(printed(functions.programs())),
        Form::Program => Ok(printed(functions.methods.iter())),
        Form::C => targets::c::source(&functions, precision).map_err(|error| error.to_string()),
        Form::Header => Ok(targets::c::header(&functions, precision)),
        Form::Cpp => Ok(targets::cpp::source(&functions)),
        Form::Casadi => targets::casadi::source(&functions).map_err(|mistake| mistake.to_string()),
        // A derivation of a struct has it.
        Form::Rust => pretty(derivation.rust().cloned().unwrap_or_default()),
        Form::Functions => pretty(targets::rust::source(&functions)),
        // These are no texts of one struct after another.
        Form::Html | Form::Mjcf | Form::Urdf => Ok(String::new()),
    }
}

fn printed<'a>(programs: impl Iterator<Item = &'a Program>) -> String {
    programs.map(ToString::to_string).collect::<Vec<_>>().join("\n")
}

fn pretty(code: proc_macro2::TokenStream) -> Result<String, String> {
    let file = syn::parse2(code).map_err(|error| format!("what was written is no Rust: {error}"))?;
    Ok(prettyplease::unparse(&file))
}

fn plain(shown: &Shown) -> String {
    let derivation = &shown.derivation;
    let mut out = format!(
        "{}\n{}\n\n{}\n",
        shown.title,
        "=".repeat(shown.title.chars().count()),
        derivation.equations(Notation::Text)
    );
    out.push_str(&format!("{:<22}{:<48}{:>6}{:>7}   rounding, at most and mostly\n", "method", "", "cost", "chain"));
    for program in derivation.functions().programs() {
        let cost = program.code.cost();
        let loss = loss(derivation, &program.name);
        let loss = loss.map(|[most, middle]| format!("   {most} × and {middle} ×")).unwrap_or_default();
        let counts = program.code.counts().to_string();
        out.push_str(&format!("{:<22}{counts:<48}{:>6}{:>7}{loss}\n", program.name, cost.total(), cost.chain));
    }
    if !derivation.remarks().is_empty() {
        out.push_str("\nthe file\n");
        derivation.remarks().iter().for_each(|remark| out.push_str(&format!("- {remark}\n")));
    }
    out
}
