//! What describes a kernel: its equations as text and LaTeX, the operations of its methods.

use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;

use crate::kernel::Counts;
use crate::mechanics::Method;

use super::derived::Derived;
use super::documentation::{Equations, method_name};

pub fn description(derived: &Derived<'_, '_>, equations: &Equations) -> TokenStream {
    let runtime = derived.item().runtime;
    let (Equations { text, latex }, operations) = (equations, operations(derived));
    quote! {
        const EQUATIONS: #runtime::system::Equations = #runtime::system::Equations { text: #text, latex: #latex };
        const OPERATIONS: #runtime::system::Operations = #operations;
    }
}

fn operations(derived: &Derived<'_, '_>) -> TokenStream {
    let runtime = derived.item().runtime;
    let rows = derived.formulas.iter().zip(&derived.kernel.functions).filter(|(f, _)| f.method <= Method::Powers);
    let rows = rows.map(|(f, program)| {
        let (field, count) = (Ident::new(method_name(f.method), Span::call_site()), derived.count(program.counts()));
        quote!(#field: #count)
    });
    let kernel = derived.count(derived.kernel.constants.counts());
    let none = derived.count(Counts::default());
    let multipliers = (!derived.has(Method::Multipliers)).then(|| quote!(multipliers: #none,));
    let powers = (!derived.has(Method::Powers)).then(|| quote!(powers: #none,));
    let evaluate = derived.count(derived.kernel.joined.counts());
    quote!(#runtime::system::Operations { kernel: #kernel, evaluate: #evaluate, #multipliers #powers #(#rows),* })
}
