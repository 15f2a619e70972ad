//! The pipeline on one screen: parse → translate → derive → lower → emit.

use proc_macro2::TokenStream;
use syn::DeriveInput;

use crate::algebra::Graph;
use crate::emit::{Derived, Equations, emit};
use crate::formulation::Formulation;
use crate::lowering::lower;
use crate::model;
use crate::translate::Translator;

/// Expands one struct.
///
/// # Errors
/// Every mistake of the struct, each at the token that is wrong.
pub fn expand(input: &DeriveInput) -> syn::Result<TokenStream> {
    derive(input, |derived| Ok(emit(derived, &Equations::of(derived))))
}

/// Derives one struct, and hands everything that is known of it to whoever writes it down.
pub fn derive<R>(input: &DeriveInput, write: impl FnOnce(&Derived<'_, '_>) -> syn::Result<R>) -> syn::Result<R> {
    let model = model::parse(input)?;
    let graph = Graph::new();
    let mut translator = Translator::new(&graph, &model)?;
    let formulation = Formulation::of(&model, &mut translator)?;
    let kernel = lower(&graph, &model, &translator, &formulation)?;
    write(&Derived::new(&model, &translator, &formulation, &kernel)?)
}
