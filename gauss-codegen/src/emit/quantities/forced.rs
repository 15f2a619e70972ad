//! `ForcedSystem`: power and generalised forces of the loads, element by element.

use proc_macro2::TokenStream;
use quote::quote;

use crate::mechanics::Method;

use crate::emit::derived::Derived;

pub fn forced_system(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    let powers = derived.function(Method::Powers, quote!(Self::Powers))?;
    let (private, ty, n) = (derived.private(), derived.scalar().ty(), derived.degrees_of_freedom());
    let accounts = derived.accounts();
    let count = accounts.len();
    let elements = accounts.iter().map(|account| {
        let (name, conservative) = (&account.name, account.conservative);
        let damper = (conservative && account.outside.is_some()).then(|| quote!(.with_damper()));
        quote!(#private::Element::new(#name, #conservative) #damper)
    });
    let forces = derived.function(Method::ElementForces, quote!(Self::ElementForces));
    let supplied = derived.function(Method::SuppliedPower, quote!(Self::Scalar));
    let items = quote! {
        type Powers = #private::SVector<#ty, #count>;
        type ElementForces = #private::SMatrix<#ty, #n, #count>;
        const ELEMENTS: &'static [#private::Element] = &[#(#elements),*];
        #powers
        #forces
        #supplied
    };
    Some(derived.implementation(quote!(ForcedSystem), items))
}
