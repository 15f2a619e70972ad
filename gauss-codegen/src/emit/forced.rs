//! `ForcedSystem`: power and generalised forces of what acts, element by element.

use proc_macro2::TokenStream;
use quote::quote;

use crate::mechanics::Method;

use super::derived::Derived;

pub fn forced_system(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    if !derived.has(Method::Powers) {
        return None;
    }
    let (runtime, ty, n) = (derived.item().runtime, derived.scalar().ty(), derived.degrees_of_freedom());
    let accounts = derived.accounts();
    let count = accounts.len();
    let elements = accounts.iter().map(|account| {
        let (name, conservative) = (&account.name, account.conservative);
        quote!(#runtime::forces::Element::new(#name, #conservative))
    });
    let arguments = quote!(z: &Self::Speeds, input: &Self::Input);
    let powers = derived.function(Method::Powers, arguments.clone(), quote!(Self::Powers));
    let forces = derived.function(Method::ElementForces, arguments.clone(), quote!(Self::ElementForces));
    let supplied = derived.function(Method::SuppliedPower, arguments, quote!(Self::Scalar));
    let items = quote! {
        type Powers = #runtime::prelude::SVector<#ty, #count>;
        type ElementForces = #runtime::prelude::SMatrix<#ty, #n, #count>;
        const ELEMENTS: &'static [#runtime::forces::Element] = &[#(#elements),*];
        #powers
        #forces
        #supplied
    };
    Some(derived.implementation(quote!(forces::ForcedSystem), items))
}
