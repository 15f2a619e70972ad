//! The kernel struct, and `kernel()` of the user's struct, which makes it.

use proc_macro2::TokenStream;
use quote::quote;

use super::derived::{BodySubject, Derived, Item, KernelGenerics, Plain, Subject};
use super::documentation::{Equations, rustdoc};
use super::parameters::kernel_body;
use super::system::SystemSubject;
use super::system_parameters::{system_kernel_body, warnings};

/// The struct: the constants that `kernel()` computes.
pub fn kernel_struct(derived: &Derived<'_, '_>, equations: &Equations) -> TokenStream {
    let (visibility, name, fields) = (derived.item().visibility, derived.kernel_name(), derived.constant_fields());
    let (ty, KernelGenerics { declared, .. }) = (derived.scalar().ty(), derived.kernel_generics());
    let documentation = rustdoc(derived, &equations.text);
    quote! {
        #[doc = #documentation]
        #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
        #[allow(non_camel_case_types)]
        #visibility struct #name #declared { #(#fields: #ty),* }
    }
}

/// `kernel()` and `warnings()` of the user's struct.
pub fn constructor(derived: &Derived<'_, '_>) -> TokenStream {
    let Item { ident, visibility, generics, .. } = derived.item();
    let private = derived.private();
    let (name, KernelGenerics { used, .. }) = (derived.kernel_name(), derived.kernel_generics());
    let (impl_generics, type_generics, where_clause) = generics.split_for_impl();
    let predicates = where_clause.map(|w| {
        let predicates = w.predicates.iter();
        quote!(#(#predicates,)*)
    });
    let bound = bound(derived);
    let documentation = format!(
        "Checks the parameters and computes once whatever depends on them alone: the kernel of [`{ident}`].\n\n\
         # Errors\nEvery parameter that no body can have, with its field, value and the rule it breaks."
    );
    let (body, plain) = match derived.subject {
        Subject::Body { model, in_chart, scene, quaternion, plain } => {
            (kernel_body(&BodySubject { derived, model, in_chart, scene, quaternion, plain }), plain)
        }
        Subject::System(subject) => {
            let SystemSubject { model, sources, literals, assigned, .. } = subject;
            let plain = Plain { fields: &model.fields, sources, literals, assigned };
            (system_kernel_body(derived, &subject), Some(plain))
        }
    };
    let warnings = plain.map(|plain| warnings(derived, &plain, derived.drags));
    quote! {
        #[automatically_derived]
        impl #impl_generics #ident #type_generics where #predicates #bound {
            #[doc = #documentation]
            #visibility fn kernel(&self) -> ::core::result::Result<#name #used, #private::ParameterError> {
                #body
            }

            #warnings
        }
    }
}

/// What the scalar must be, where it is a type parameter.
fn bound(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    let (ty, real) = (derived.scalar().ty(), derived.scalar().real);
    derived.is_generic().then(|| quote!(#ty: #real,))
}
