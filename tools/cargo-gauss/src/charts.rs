//! The same body in another chart: its clause `chart = …` is another one.

use proc_macro2::{TokenStream, TokenTree};
use syn::{DeriveInput, Meta};

/// The struct with `chart = CHART`, in place of its own chart or as a clause more.
///
/// # Errors
/// That the chart is no Rust.
pub fn in_chart(item: &DeriveInput, chart: &str) -> Result<DeriveInput, String> {
    let chart: TokenStream = chart.parse().map_err(|_| format!("`{chart}` is no chart: its brackets do not match"))?;
    let mut item = item.clone();
    let mut written = false;
    for attribute in item.attrs.iter_mut().filter(|attribute| attribute.path().is_ident("gauss")) {
        if let Meta::List(list) = &mut attribute.meta {
            let (tokens, found) = replaced(&list.tokens, &chart);
            list.tokens = tokens;
            written |= found;
        }
    }
    if !written {
        item.attrs.push(syn::parse_quote!(#[gauss(chart = #chart)]));
    }
    Ok(item)
}

/// The tokens with what follows `chart =`, up to the next comma, exchanged; whether there was such a clause.
fn replaced(tokens: &TokenStream, chart: &TokenStream) -> (TokenStream, bool) {
    let all: Vec<TokenTree> = tokens.clone().into_iter().collect();
    let is = |k: usize, text: &str| all.get(k).is_some_and(|token| token.to_string() == text);
    let starts = |k: usize| is(k, "chart") && is(k + 1, "=") && (k == 0 || is(k - 1, ","));
    let Some(start) = (0..all.len()).find(|&k| starts(k)) else { return (tokens.clone(), false) };
    let end = (start..all.len()).find(|&k| is(k, ",")).unwrap_or(all.len());
    let new = all[..start + 2].iter().cloned().chain(chart.clone()).chain(all[end..].iter().cloned());
    (new.collect(), true)
}
