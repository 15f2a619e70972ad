//! What no input may bring about, here and in the fuzz target.

use gauss_codegen::{expand, fallback, item};
use proc_macro2::TokenStream;

/// A mistake that blames this library, or code that is no Rust. Panics are left to whoever calls.
pub fn fault(tokens: TokenStream) -> Option<String> {
    let input = item(tokens).ok()?;
    // Which syn reads and rustc refuses, before it asks any derive.
    if input.generics.type_params().any(|parameter| parameter.ident == "_") {
        return None;
    }
    let code = match expand(&input) {
        Ok(code) => code,
        Err(mistakes) => {
            let blame =
                mistakes.clone().into_iter().find(|mistake| mistake.to_string().contains("bug in gauss-derive"));
            if let Some(blame) = blame {
                return Some(blame.to_string().replace('\n', " "));
            }
            fallback(&input, &mistakes)
        }
    };
    syn::parse2::<syn::File>(code).err().map(|error| format!("no Rust: {error}"))
}
