//! The kernel struct, and `kernel()` of the user's struct, which makes it.

use proc_macro2::{Span, TokenStream};
use quote::{quote, quote_spanned};

use crate::emit::constructor::laws::warnings;
use crate::emit::constructor::parameters::kernel_body;
use crate::emit::derived::{Derived, KernelGenerics};
use crate::emit::dialect::program::table_name;
use crate::emit::text::documentation::{Documentation, Equations, rustdoc};
use crate::terms::{FunctionKind, Generics, Item, UserFunction};

/// The struct: the constants that `kernel()` computes.
pub fn kernel_struct(derived: &Derived<'_, '_>, equations: &Equations) -> TokenStream {
    let (visibility, name, fields) = (&derived.item().visibility, derived.kernel_name(), derived.constant_fields());
    let (ty, KernelGenerics { declared, .. }) = (derived.scalar().ty(), derived.kernel_generics());
    let rows = derived.packs().and_then(|packs| packs.field(&derived.private())).into_iter();
    let Documentation { before, text, formulas, after } = rustdoc(derived, equations);
    let equations = match formulas {
        // Editors show what is compiled, and HTML as it is written.
        Some(formulas) => quote!(#[cfg_attr(doc, doc = #formulas)] #[cfg_attr(not(doc), doc = #text)]),
        None => quote!(#[doc = #text]),
    };
    quote! {
        #[doc = #before]
        #equations
        #[doc = #after]
        #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
        #[allow(non_camel_case_types)]
        #visibility struct #name #declared { #(#fields: #ty,)* #(#rows)* }
    }
}

/// `kernel()` and `warnings()` of the user's struct.
pub fn constructor(derived: &Derived<'_, '_>) -> TokenStream {
    let Item { ident, visibility, generics, .. } = derived.item();
    let private = derived.private();
    let (name, KernelGenerics { used, .. }) = (derived.kernel_name(), derived.kernel_generics());
    let Generics { declared, used: own, predicates } = generics;
    let bound = bound(derived);
    let documentation = format!(
        "Checks the parameters and computes once whatever depends on them alone: the kernel of [`{ident}`].\n\n\
         # Errors\nEvery parameter that no body can have, with its field, value and the rule it breaks."
    );
    let body = kernel_body(derived);
    let warnings = warnings(derived);
    quote! {
        #[allow(clippy::all, clippy::pedantic)]
        impl #declared #ident #own where #predicates #bound {
            #[doc = #documentation]
            #visibility fn kernel(&self) -> ::core::result::Result<#name #used, #private::ParameterError> {
                #body
            }

            #warnings
        }
    }
}

/// Constants that hold the tables.
pub fn tables(derived: &Derived<'_, '_>) -> TokenStream {
    let private = derived.private();
    let table = |(index, clause): (usize, &UserFunction)| {
        let (points, kind) = match &clause.kind {
            FunctionKind::Rust(_) => return None,
            FunctionKind::Linear(points) => (points, quote!(Linear)),
            FunctionKind::Cubic(points) => (points, quote!(Cubic)),
        };
        let name = table_name(index as u16);
        // What is wrong with the points is shown where they are named.
        let at = clause.span.resolved_at(Span::mixed_site());
        Some(quote_spanned!(at=> const #name: #private::#kind<{ #points.len() }> = #private::#kind::through(&#points);))
    };
    derived.item().functions.iter().enumerate().filter_map(table).collect()
}

/// What the scalar must be, where it is a type parameter.
pub fn bound(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    let (ty, real) = (derived.scalar().ty(), derived.scalar().real);
    derived.is_generic().then(|| quote!(#ty: #real,))
}
