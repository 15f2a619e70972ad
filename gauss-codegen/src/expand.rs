//! The pipeline on one screen: parse → translate → derive → lower → emit.

use proc_macro2::TokenStream;
use syn::DeriveInput;

use crate::algebra::Graph;
use crate::derivation::Derivation;
use crate::emit::{Derived, emit};
use crate::lowering::lower;
use crate::model;
use crate::translate::Translator;

/// Expands one struct.
///
/// # Errors
/// Every mistake of the struct, each at the token that is wrong.
pub fn expand(input: &DeriveInput) -> syn::Result<TokenStream> {
    let model = model::parse(input)?;
    let graph = Graph::new();
    let mut translator = Translator::new(&graph, &model)?;
    let derivation = Derivation::of(&model, &mut translator)?;
    let kernel = lower(&graph, &model, &translator, &derivation)?;
    Ok(emit(&Derived::new(&model, &translator, &derivation, &kernel)?))
}
