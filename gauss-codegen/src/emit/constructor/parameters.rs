//! `kernel()`: role fields, rigid bodies and plain parameters checked, and turned into constants.

use proc_macro2::TokenStream;
use quote::quote;

use crate::algebra::Map;
use crate::words::Unraw;

use crate::emit::constructor::laws;
use crate::emit::constructor::locals::{parameters_read, symbols_of_parameters};
use crate::emit::constructor::mass_laws::checked;
use crate::emit::derived::{Derived, KernelGenerics};
use crate::emit::dialect::program::statements;

/// The body of `kernel()`.
pub fn kernel_body(derived: &Derived<'_, '_>) -> TokenStream {
    let given = derived.subject.provenance;
    let (private, ty) = (derived.private(), derived.scalar().ty());
    let symbols = symbols_of_parameters(derived);
    let read = parameters_read(derived, &symbols);
    let mut checks = checked(derived, &derived.mass_laws.of_data, &symbols);
    checks.extend(laws::masses(derived, &symbols));
    checks.extend(checked(derived, &derived.mass_laws.of_motions, &symbols));
    checks.extend(laws::checked(derived, &symbols));
    // The first field that the equations read speaks for all of them.
    let label = given.sources.first().map(|s| given.item.fields[s.field].ident.unraw().to_string()).unwrap_or_default();
    let kernel = constants(derived, &symbols, &label);
    quote! {
        #read
        let mut __check = #private::ParameterCheck::<#ty>::new();
        #checks
        __check.finish()?;
        #kernel
    }
}

/// The constants computed and checked: together, parameters that are fine one by one can overflow. `label` is the field
/// that speaks for them.
pub fn constants(derived: &Derived<'_, '_>, symbols: &Map<u32, TokenStream>, label: &str) -> TokenStream {
    let (compute, outputs) = statements(&derived.kernel.constants, symbols, &derived.scalar());
    let sum = sum(derived);
    let (name, fields) = (derived.kernel_name(), derived.constant_fields());
    let rows = derived.rows(&outputs).into_iter();
    quote! {
        #compute
        let __kernel = #name { #(#fields: #outputs,)* #(#rows)* };
        #sum
        __check.constants(#label, &[#(__kernel.#fields),*]);
        __check.finish()?;
        ::core::result::Result::Ok(__kernel)
    }
}

/// Bodies some of which have no mass have a mass matrix all the same.
fn sum(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    if !derived.mass_laws.in_sum {
        return None;
    }
    let (private, kernel) = (derived.private(), derived.kernel_name());
    let KernelGenerics { used, .. } = derived.kernel_generics();
    let system = quote!(<#kernel #used as #private::GaussSystem>);
    Some(quote! {
        if __check.massless().is_some() {
            let __matrix = |__q| #private::entries(&#system::mass_matrix(&__kernel, #private::sample_time(), &__q));
            __check.regular(&#private::samples::<#system::Configuration>().map(__matrix));
        }
    })
}
