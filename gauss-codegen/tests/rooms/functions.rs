//! Functions by the lines between their braces.

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
    let mut found = Vec::new();
    for (_, module) in modules.iter() {
        for item in &module.items {
            of_item(item, &mut |name, block| {
                let span = block.span();
                let lines = (span.end().line - span.start().line).saturating_sub(1);
                found.push(Function { file: module.file.clone(), name, lines });
            });
        }
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
