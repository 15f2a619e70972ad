//! What the code of a file names.

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::{TokenStream, TokenTree};
use quote::ToTokens;
use syn::Item;

use crate::modules::{Module, Modules, leaves};

/// For each pair of files, the names that the first takes from the second.
pub type Imports = BTreeMap<(String, String), BTreeSet<String>>;

pub fn imports(modules: &Modules) -> Imports {
    let mut imports = Imports::new();
    for (path, module) in modules.iter() {
        for named in paths(module) {
            for file in modules.files(path, &named) {
                if file != module.file {
                    let name = named.last().cloned().unwrap_or_default();
                    imports.entry((module.file.clone(), file)).or_default().insert(name);
                }
            }
        }
    }
    imports
}

/// For each folder, what its parts take from each other: files, and folders with all that is in them. The file of a
/// folder's own module puts its parts together, so that it is none of them.
pub fn between_parts(imports: &Imports) -> Vec<Imports> {
    let mut folders = BTreeSet::from([""]);
    for (file, _) in imports.keys() {
        folders.extend(file.match_indices('/').map(|(end, _)| &file[..=end]));
    }
    let within = |folder: &str| {
        let mut found = Imports::new();
        for ((from, to), names) in imports {
            if let (Some(from), Some(to)) = (part(folder, from), part(folder, to))
                && from != to
            {
                found.entry((from.to_owned(), to.to_owned())).or_default().extend(names.iter().cloned());
            }
        }
        found
    };
    folders.into_iter().map(within).collect()
}

/// The part of a folder that a file belongs to.
fn part<'a>(folder: &str, file: &'a str) -> Option<&'a str> {
    let inside = file.strip_prefix(folder)?;
    match inside.split_once('/') {
        Some((inner, _)) => Some(&file[..folder.len() + inner.len()]),
        None => (!["lib.rs", "mod.rs"].contains(&inside)).then_some(file),
    }
}

/// Every path that a module names, in declarations and in code.
pub fn paths(module: &Module) -> Vec<Vec<String>> {
    let mut paths: Vec<Vec<String>> = module.imports().into_iter().map(|import| import.path).collect();
    for item in module.items.iter().filter(|item| !matches!(item, Item::Use(_))) {
        named(item.to_token_stream(), &mut paths);
    }
    paths
}

/// All paths of some code, names alone among them, and those of `use` declarations within functions.
fn named(code: TokenStream, found: &mut Vec<Vec<String>>) {
    let tokens: Vec<TokenTree> = code.into_iter().collect();
    let is = |k: usize, sign: char| matches!(tokens.get(k), Some(TokenTree::Punct(p)) if p.as_char() == sign);
    let mut k = 0;
    while k < tokens.len() {
        match &tokens[k] {
            TokenTree::Group(group) => named(group.stream(), found),
            TokenTree::Ident(word) if word == "use" && !is(k + 1, '<') => {
                let end = (k..tokens.len()).find(|&end| is(end, ';')).unwrap_or(tokens.len() - 1);
                let declaration: TokenStream = tokens[k..=end].iter().cloned().collect();
                if let Ok(item) = syn::parse2::<syn::ItemUse>(declaration) {
                    let mut inside = Vec::new();
                    leaves(&item.tree, &[], &mut inside);
                    found.extend(inside.into_iter().map(|(path, _)| path));
                }
                k = end;
            }
            // The names of methods where they are defined, and of fields and methods where they are used, are no items.
            TokenTree::Ident(_) if k > 0 && matches!(&tokens[k - 1], TokenTree::Ident(before) if before == "fn") => {}
            TokenTree::Ident(_) if k > 0 && is(k - 1, '.') && !(k > 1 && is(k - 2, '.')) => {}
            TokenTree::Ident(word) => {
                let mut path = vec![word.to_string()];
                while is(k + 1, ':') && is(k + 2, ':') {
                    let Some(TokenTree::Ident(next)) = tokens.get(k + 3) else { break };
                    path.push(next.to_string());
                    k += 3;
                }
                found.push(path);
            }
            _ => {}
        }
        k += 1;
    }
}
