//! `DescribedSystem`: equations as text and LaTeX, the operations of the methods, what they lose.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

use crate::accuracy::Figure;
use crate::kernel::Counts;
use crate::mechanics::Method;

use crate::emit::derived::Derived;
use crate::emit::quantities::framed::frame_operations;
use crate::emit::records::state::component_names;
use crate::emit::text::documentation::{Equations, figures};

pub fn described(derived: &Derived<'_, '_>, equations: &Equations) -> TokenStream {
    let private = derived.private();
    let (Equations { text, latex }, operations, losses) = (equations, operations(derived), losses(derived));
    let [coordinates, speeds] = component_names(derived);
    let items = quote! {
        const EQUATIONS: #private::Equations = #private::Equations::new(#text, #latex);
        const OPERATIONS: #private::Operations = {
            let mut __operations = #private::Operations::NONE;
            #(__operations.#operations;)*
            __operations
        };
        const ACCURACY: #private::Accuracy = {
            let mut __accuracy = #private::Accuracy::NONE;
            #(__accuracy.#losses;)*
            __accuracy
        };
        const COORDINATE_NAMES: &'static [&'static ::core::primitive::str] = &[#(#coordinates),*];
        const SPEED_NAMES: &'static [&'static ::core::primitive::str] = &[#(#speeds),*];
    };
    derived.implementation(quote!(DescribedSystem), items)
}

/// `method = loss`, for every method.
fn losses(derived: &Derived<'_, '_>) -> Vec<TokenStream> {
    let private = derived.private();
    let listed = figures(derived).filter(|(method, ..)| method.is_none_or(|method| method <= Method::Powers));
    let loss = |(_, name, figure): (Option<Method>, &str, &Figure)| {
        let [worst, median] = figure.rounded().map(Literal::f64_unsuffixed);
        let field = Ident::new(name, Span::call_site());
        quote!(#field = #private::Loss::new(#worst, #median))
    };
    listed.map(loss).collect()
}

/// `method = count`, for every method.
fn operations(derived: &Derived<'_, '_>) -> Vec<TokenStream> {
    let count = |name: &str, counts: Counts| {
        let (field, count) = (Ident::new(name, Span::call_site()), derived.count(counts));
        quote!(#field = #count)
    };
    let kernel = &derived.kernel;
    let methods = kernel.functions.iter().filter(|(method, _)| *method <= Method::Powers);
    let methods = methods.map(|(method, function)| count(method.name(), function.program.counts()));
    let whole = [("kernel", &kernel.constants), ("evaluate", &kernel.joined)].into_iter();
    let whole = whole.map(|(name, program)| count(name, program.counts()));
    let derivatives = kernel.derivatives.iter();
    let derivatives = derivatives.map(|derivative| count(derivative.kind.name(), derivative.program.counts()));
    let asked_for = Method::ASKED_FOR.into_iter();
    let asked_for = asked_for.filter_map(|method| Some(count(method.name(), derived.program(method)?.counts())));
    whole.chain(methods).chain(derivatives).chain(asked_for).chain(frame_operations(derived)).collect()
}
