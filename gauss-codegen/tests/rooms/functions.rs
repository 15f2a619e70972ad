//! Functions by the lines between their braces.

use std::fs;
use std::path::Path;

use syn::spanned::Spanned;
use syn::{Block, ImplItem, Item, TraitItem};

use crate::modules::Modules;

/// A function, the file that it is in, and how many lines its body has.
pub struct Function {
    pub file: String,
    pub name: String,
    pub lines: usize,
}

/// Every function of a crate, but those of tests.
pub fn functions(modules: &Modules) -> Vec<Function> {
    modules.iter().flat_map(|(_, module)| of_items(&module.file, &module.items)).collect()
}

/// Every function in the files of a folder, but those in folders of tests.
pub fn functions_below(folder: &Path) -> Vec<Function> {
    let entries = fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut found = Vec::new();
    for path in entries.map(|entry| entry.expect("an entry").path()) {
        if path.is_dir() && !path.ends_with("tests") && !path.ends_with("target") {
            found.extend(functions_below(&path));
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            let name = path.display().to_string();
            let text = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{name}: {error}"));
            let parsed = syn::parse_file(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
            found.extend(of_items(&name, &parsed.items));
        }
    }
    found
}

fn of_items(file: &str, items: &[Item]) -> Vec<Function> {
    let mut found = Vec::new();
    for item in items {
        of_item(item, &mut |name, block| {
            let span = block.span();
            let lines = (span.end().line - span.start().line).saturating_sub(1);
            found.push(Function { file: file.to_owned(), name, lines });
        });
    }
    found
}

fn of_item(item: &Item, each: &mut impl FnMut(String, &Block)) {
    match item {
        Item::Fn(function) => each(function.sig.ident.to_string(), &function.block),
        Item::Impl(implementation) => {
            for item in &implementation.items {
                if let ImplItem::Fn(function) = item {
                    each(function.sig.ident.to_string(), &function.block);
                }
            }
        }
        Item::Trait(definition) => {
            for item in &definition.items {
                if let TraitItem::Fn(function) = item
                    && let Some(block) = &function.default
                {
                    each(function.sig.ident.to_string(), block);
                }
            }
        }
        _ => {}
    }
}
