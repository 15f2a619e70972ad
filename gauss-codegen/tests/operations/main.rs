//! The gate: what every method of every scene costs, beside the table of this folder.
//!
//! A row is worse when its operations, its divisions and functions, or its longest chain grew; then the test fails.
//! Their equations in LaTeX, which are in the code as well, are looked at on the way.
//! What became better fails too, until the table says so:
//! `UPDATE_OPERATIONS=1 cargo test -p gauss-codegen --test operations` writes it.

mod counts;
#[path = "../common/latex.rs"]
mod latex;
mod names;
mod scenes;
mod sources;
mod table;
#[path = "../common/tex.rs"]
mod tex;

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use counts::Row;
use gauss_codegen::mathml;
use proc_macro2::{TokenStream, TokenTree};
use sources::Scene;
use table::Table;

/// Expands every scene, on all threads: what it costs, and its equations in LaTeX; or says which ones are refused.
fn measured(scenes: &[Scene]) -> Result<(Table, Vec<(String, String)>), String> {
    let next = AtomicUsize::new(0);
    let found = Mutex::new((Table::default(), Vec::new(), String::new()));
    let work = || {
        while let Some(scene) = scenes.get(next.fetch_add(1, Ordering::Relaxed)) {
            let rows = rows(scene);
            let (table, equations, refused) = &mut *found.lock().expect("no thread panics with the table");
            match rows {
                Ok((rows, latex)) => {
                    table.add(&scene.name, rows);
                    equations.push((scene.name.clone(), latex));
                }
                Err(error) => *refused += &format!("{}: {error}\n", scene.name),
            }
        }
    };
    let threads = thread::available_parallelism().map_or(1, usize::from);
    thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(work);
        }
    });
    let (table, mut equations, refused) = found.into_inner().expect("no thread panics with the table");
    equations.sort();
    if refused.is_empty() { Ok((table, equations)) } else { Err(refused) }
}

fn rows(scene: &Scene) -> syn::Result<(Vec<(String, Row)>, String)> {
    let code = gauss_codegen::expand(&syn::parse_str(&scene.source)?)?;
    let equations = equations(code.clone()).unwrap_or_default();
    let mut complaints = latex::complaints(&equations);
    complaints.extend(mathml::lines(&equations).filter_map(left_of_latex));
    if !complaints.is_empty() {
        return Err(syn::Error::new(proc_macro2::Span::call_site(), complaints.join("\n")));
    }
    Ok((counts::of_code(code)?, equations))
}

/// What MathML has left of a line of LaTeX, which should be nothing.
fn left_of_latex(line: &str) -> Option<String> {
    let set = match line.strip_prefix("&\\text{").and_then(|rest| rest.strip_suffix("}")) {
        Some(words) => mathml::words(words),
        None => mathml::line(line),
    };
    let (_, rest) = set.split_once('\\')?;
    Some(format!("\\{} is not known to MathML: {line}", rest.chars().take(20).collect::<String>()))
}

/// The LaTeX of `Equations::new(text, latex)`.
fn equations(code: TokenStream) -> Option<String> {
    let tokens: Vec<TokenTree> = code.into_iter().collect();
    tokens.iter().enumerate().find_map(|(n, token)| match token {
        TokenTree::Group(group) if n > 3 && tokens[n - 4].to_string() == "Equations" => {
            let latex: syn::LitStr = syn::parse2(group.stream().into_iter().nth(2)?.into()).ok()?;
            Some(latex.value())
        }
        TokenTree::Group(group) => equations(group.stream()),
        _ => None,
    })
}

#[test]
fn no_method_costs_more_than_before() {
    let scenes = scenes::all();
    let (measured, equations) = measured(&scenes).unwrap_or_else(|refused| panic!("\n{refused}"));
    if let Some(complaints) = tex::complaints("all_scenes", &equations) {
        assert!(complaints.is_empty(), "\n{complaints}");
    }
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/operations/table.csv");
    if std::env::var("UPDATE_OPERATIONS").is_ok_and(|value| value == "1") {
        std::fs::write(path, measured.to_csv()).expect("the table can be written");
        return;
    }
    let known =
        Table::from_csv(&std::fs::read_to_string(path).expect("the table is there")).expect("the table is whole");
    let changes = known.changes_to(&measured);
    assert!(
        changes.is_empty(),
        "\n{changes}\nIf all of it is meant: UPDATE_OPERATIONS=1 cargo test -p gauss-codegen --test operations"
    );
}
