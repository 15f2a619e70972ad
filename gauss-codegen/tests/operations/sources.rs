//! Scenes that stand in files of this project: structs that derive `GaussDynamics`, also inside of macros.

use std::fs;
use std::path::{Path, PathBuf};

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};
use quote::ToTokens;
use syn::{Item, ItemStruct};

/// A struct and its attribute, as the derive reads them.
pub struct Scene {
    pub name: String,
    pub source: String,
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn parsed(file: &str) -> syn::File {
    let text = fs::read_to_string(root().join(file)).unwrap_or_else(|error| panic!("{file}: {error}"));
    syn::parse_file(&text).unwrap_or_else(|error| panic!("{file}: {error}"))
}

/// Every struct of a file, or of the files below a folder, that is written out.
pub fn of(place: &str) -> Vec<Scene> {
    let mut files = Vec::new();
    collect(&root().join(place), place, &mut files);
    files.sort();
    let scenes = files.iter().flat_map(|file| {
        let mut structs = Vec::new();
        below(parsed(file).items, &mut structs);
        structs.into_iter().map(move |item| scene(file, &item))
    });
    scenes.collect()
}

fn collect(path: &Path, name: &str, files: &mut Vec<String>) {
    if path.is_file() {
        files.extend(name.ends_with(".rs").then(|| name.to_owned()));
        return;
    }
    for entry in fs::read_dir(path).unwrap_or_else(|error| panic!("{name}: {error}")).flatten() {
        collect(&entry.path(), &format!("{name}/{}", entry.file_name().display()), files);
    }
}

fn below(items: Vec<Item>, structs: &mut Vec<ItemStruct>) {
    for item in items {
        match item {
            Item::Struct(item) if derives(&item) => structs.push(item),
            Item::Mod(module) => below(module.content.map(|(_, items)| items).unwrap_or_default(), structs),
            _ => {}
        }
    }
}

fn derives(item: &ItemStruct) -> bool {
    let derive = |attribute: &syn::Attribute| {
        attribute.path().is_ident("derive") && attribute.to_token_stream().to_string().contains("GaussDynamics")
    };
    item.attrs.iter().any(derive)
}

/// As the derive reads it: of the attributes only its own, and what documents.
fn scene(file: &str, item: &ItemStruct) -> Scene {
    let mut item = item.clone();
    item.attrs.retain(|attribute| attribute.path().is_ident("gauss"));
    let name = format!("{}: {}", file.trim_end_matches(".rs"), item.ident);
    Scene { name, source: located(&item.to_token_stream().to_string(), file) }
}

/// With the robot's file of a struct by the folder of its own package, where it is not found from this one.
fn located(source: &str, file: &str) -> String {
    let path = root().join(file);
    let package = path.ancestors().find(|folder| folder.join("Cargo.toml").is_file()).unwrap_or(&path);
    let named = |word: &str| source.split_once(word)?.1.split('"').next();
    match named("urdf = \"").or_else(|| named("mjcf = \"")) {
        Some(robot) if !Path::new(env!("CARGO_MANIFEST_DIR")).join(robot).is_file() => {
            source.replacen(&format!("\"{robot}\""), &format!("{:?}", package.join(robot)), 1)
        }
        _ => source.to_owned(),
    }
}

/// The struct of the first rule of a macro, for given metavariables. Repetitions are written once, those of other
/// metavariables never.
pub fn in_macro(file: &str, name: &str, values: &[(&str, &str)]) -> Scene {
    let rules = parsed(file).items.into_iter().find_map(|item| match item {
        Item::Macro(item) if item.ident.as_ref().is_some_and(|ident| ident == name) => Some(item.mac.tokens),
        _ => None,
    });
    let rules = rules.unwrap_or_else(|| panic!("{file} has no macro `{name}`"));
    // The pattern, `=>`, the code.
    let mut groups = rules.into_iter().filter_map(|token| match token {
        TokenTree::Group(group) => Some(group.stream()),
        _ => None,
    });
    let code = groups.nth(1).unwrap_or_else(|| panic!("{file}: `{name}` has no rule"));
    let code = filled(code, values).unwrap_or_else(|unknown| panic!("{file}: `{name}` wants ${unknown}"));
    let items = syn::parse2::<syn::File>(code).unwrap_or_else(|error| panic!("{file}: `{name}`: {error}")).items;
    let mut structs = Vec::new();
    below(items, &mut structs);
    scene(file, structs.first().unwrap_or_else(|| panic!("{file}: `{name}` has no scene")))
}

/// The code with values in place of metavariables, or the name of one that has none.
fn filled(code: TokenStream, values: &[(&str, &str)]) -> Result<TokenStream, String> {
    let mut out = TokenStream::new();
    let mut tokens = code.into_iter().peekable();
    while let Some(token) = tokens.next() {
        match token {
            TokenTree::Punct(sign) if sign.as_char() == '$' => match tokens.next() {
                Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Parenthesis => {
                    out.extend(filled(group.stream(), values).unwrap_or_default());
                    // The separator, if there is one, and how often.
                    let often = |token: &TokenTree| ["*", "+", "?"].contains(&token.to_string().as_str());
                    while tokens.next().is_some_and(|token| !often(&token)) {}
                }
                Some(name) => {
                    let name = name.to_string();
                    let value = values.iter().find(|(known, _)| *known == name).ok_or(name)?.1;
                    out.extend(value.parse::<TokenStream>().expect("values are tokens"));
                }
                None => {}
            },
            TokenTree::Group(group) => {
                let inner = Group::new(group.delimiter(), filled(group.stream(), values)?);
                out.extend([TokenTree::Group(inner)]);
            }
            other => out.extend([other]),
        }
    }
    Ok(out)
}
