//! `ConstrainedSystem`: multipliers, residuals and corrections; and `project` of `GaussSystem`, which needs them.

use proc_macro2::TokenStream;
use quote::quote;

use crate::emit::derived::Derived;
use crate::emit::subject::Subject;

/// The system, where there are constraints.
fn constrained<'a, 'g>(subject: &'a Subject<'a, 'g>) -> Option<&'a Subject<'a, 'g>> {
    Some(subject).filter(|subject| !subject.constraints.is_empty())
}

pub fn constrained_system(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    let subject = constrained(&derived.subject)?;
    let (private, ty, count) = (derived.private(), derived.scalar().ty(), subject.constraints.count());
    let methods = subject.constraint_methods(&derived.private()).into_iter();
    let methods = methods.filter_map(|(method, result)| derived.function(method, result));
    let items = quote! {
        type Multipliers = #private::SVector<#ty, #count>;
        #(#methods)*
    };
    Some(derived.implementation(quote!(ConstrainedSystem), items))
}

/// `project` of `GaussSystem`, where a run can drift away from constraints.
pub fn projection(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    constrained(&derived.subject).map(|subject| subject.projection(&derived.private()))
}
