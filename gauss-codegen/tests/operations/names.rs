//! Names say nothing of the motion: every scene that is written out has the same code, token for token, whatever the
//! order of its names.

use std::collections::{HashMap, HashSet};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use proc_macro2::{Group, Ident, TokenStream, TokenTree};
use syn::{Data, DeriveInput};

use crate::scenes;

/// The code of a scene without its strings, each name by the number of its first place; `None` where it is refused.
fn tokens(input: &DeriveInput) -> Option<Vec<String>> {
    fn put(code: TokenStream, numbers: &mut HashMap<String, usize>, out: &mut Vec<String>) {
        for token in code {
            match token {
                TokenTree::Group(group) => {
                    out.push(format!("{:?}", group.delimiter()));
                    put(group.stream(), numbers, out);
                }
                TokenTree::Ident(name) => {
                    let next = numbers.len();
                    out.push(format!("#{}", numbers.entry(name.to_string()).or_insert(next)));
                }
                other => out.extend(Some(other.to_string()).filter(|text| !text.contains('"'))),
            }
        }
    }
    let (mut numbers, mut out) = (HashMap::new(), Vec::new());
    put(gauss_codegen::expand(input).ok()?, &mut numbers, &mut out);
    Some(out)
}

/// Fields and coordinates, but for words that the scene has as arguments, too.
fn names(input: &DeriveInput) -> HashSet<String> {
    fn coordinates(code: TokenStream, inside: bool, names: &mut HashSet<String>) {
        let tokens: Vec<TokenTree> = code.into_iter().collect();
        for (n, token) in tokens.iter().enumerate() {
            match token {
                TokenTree::Group(group) => {
                    let listed = n > 0 && tokens[n - 1].to_string() == "coordinates";
                    coordinates(group.stream(), listed, names);
                }
                // A kind stands behind a colon.
                TokenTree::Ident(name) if inside && (n == 0 || tokens[n - 1].to_string() == ",") => {
                    names.insert(name.to_string());
                }
                _ => {}
            }
        }
    }
    let mut names = HashSet::new();
    if let Data::Struct(data) = &input.data {
        names.extend(data.fields.iter().filter_map(|field| Some(field.ident.as_ref()?.to_string())));
    }
    for attribute in &input.attrs {
        coordinates(quote::ToTokens::to_token_stream(attribute), false, &mut names);
    }
    names
}

/// The code with other names; what stands behind a point is a property.
fn renamed(code: TokenStream, others: &HashMap<String, String>) -> TokenStream {
    let mut after_point = false;
    let rename = |token: TokenTree| {
        let point =
            std::mem::replace(&mut after_point, matches!(&token, TokenTree::Punct(sign) if sign.as_char() == '.'));
        match token {
            TokenTree::Group(group) => Group::new(group.delimiter(), renamed(group.stream(), others)).into(),
            TokenTree::Ident(name) if !point => match others.get(&name.to_string()) {
                Some(other) => Ident::new(other, name.span()).into(),
                None => name.into(),
            },
            other => other,
        }
    };
    code.into_iter().map(rename).collect()
}

#[test]
fn names_in_another_order_give_the_same_code() {
    let scenes = scenes::written_out();
    let (next, seen) = (AtomicUsize::new(0), Mutex::new((0, Vec::new())));
    let work = || {
        while let Some(scene) = scenes.get(next.fetch_add(1, Ordering::Relaxed)) {
            let input: DeriveInput = syn::parse_str(&scene.source).expect("a struct");
            let mut names: Vec<String> = names(&input).into_iter().collect();
            names.sort();
            let code = |name: &dyn Fn(usize) -> usize| {
                let others = names.iter().enumerate().map(|(n, word)| (word.clone(), format!("w{:03}", name(n))));
                let code = renamed(quote::ToTokens::to_token_stream(&input), &others.collect());
                syn::parse2(code).ok().and_then(|input| tokens(&input))
            };
            // A name that is a word of the language as well makes a scene that is none.
            let Some(forward) = code(&|n| n) else { continue };
            let same = code(&|n| names.len() - n).is_some_and(|backward| backward == forward);
            let (compared, differ) = &mut *seen.lock().expect("no thread panics with it");
            *compared += 1;
            differ.extend((!same).then(|| scene.name.clone()));
        }
    };
    thread::scope(|scope| {
        (0..thread::available_parallelism().map_or(1, usize::from)).for_each(|_| drop(scope.spawn(work)));
    });
    let (compared, differ) = seen.into_inner().expect("no thread panics with it");
    assert!(differ.is_empty(), "{} of {compared}: {differ:#?}", differ.len());
    assert!(2 * compared > scenes.len(), "{compared} of {}", scenes.len());
}
