//! The structs of a file.

use syn::{Attribute, DeriveInput, File, Item, ItemStruct};

/// The structs of these names, wherever in the modules of the file they are; without names all that derive their dynamics.
///
/// # Errors
/// A sentence for every name that no struct has; that there is no struct at all.
pub fn find(file: &File, names: &[String]) -> Result<Vec<DeriveInput>, String> {
    let mut all = Vec::new();
    gather(&file.items, &mut all);
    let known: Vec<String> =
        all.iter().filter(|item| is_derived(&item.attrs)).map(|item| item.ident.to_string()).collect();
    if names.is_empty() {
        let found: Vec<DeriveInput> =
            all.iter().filter(|item| is_derived(&item.attrs)).map(|&item| item.clone().into()).collect();
        return if found.is_empty() {
            Err("no struct of this file derives GaussDynamics".to_owned())
        } else {
            Ok(found)
        };
    }
    let mut mistakes = Vec::new();
    let found = names.iter().filter_map(|name| {
        let item = all.iter().find(|item| item.ident == name);
        if item.is_none() {
            let list = if known.is_empty() { "none that derives GaussDynamics".to_owned() } else { known.join(", ") };
            mistakes.push(format!("there is no struct `{name}` in this file; there is {list}"));
        }
        item.map(|&item| item.clone().into())
    });
    let found = found.collect();
    if mistakes.is_empty() { Ok(found) } else { Err(mistakes.join("\n")) }
}

fn gather<'a>(items: &'a [Item], found: &mut Vec<&'a ItemStruct>) {
    for item in items {
        match item {
            Item::Struct(item) => found.push(item),
            Item::Mod(module) => gather(module.content.as_ref().map_or(&[], |(_, items)| items), found),
            _ => {}
        }
    }
}

fn is_derived(attributes: &[Attribute]) -> bool {
    attributes.iter().filter(|attribute| attribute.path().is_ident("derive")).any(|attribute| {
        let mut found = false;
        // What is no list of paths derives nothing that is known here.
        let _ = attribute.parse_nested_meta(|meta| {
            found |= meta.path.segments.last().is_some_and(|last| last.ident == "GaussDynamics");
            Ok(())
        });
        found
    })
}
