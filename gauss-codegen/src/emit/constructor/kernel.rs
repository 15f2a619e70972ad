//! The kernel struct, and `kernel()` of the user's struct, which makes it.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote, quote_spanned};

use crate::algebra::MOST_VARIABLES;
use crate::emit::constructor::laws::warnings;
use crate::emit::constructor::parameters::kernel_body;
use crate::emit::derived::{Derived, KernelGenerics};
use crate::emit::dialect::program::table_name;
use crate::emit::text::documentation::{Documentation, Equations, rustdoc};
use crate::terms::{Axis, FunctionKind, Generics, Interpolation, Item, Table, UserFunction};

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
    let table = |(index, clause): (usize, &UserFunction)| match &clause.kind {
        FunctionKind::Rust(_) => None,
        FunctionKind::Table(table) => Some(constant(&table_name(index as u16), table, clause.span, &derived.private())),
    };
    derived.item().functions.iter().enumerate().filter_map(table).collect()
}

/// The constant of a table. What is wrong with its numbers is shown where they are named.
fn constant(name: &Ident, table: &Table, span: Span, private: &TokenStream) -> TokenStream {
    let Table { axes, values, joined } = table;
    // The path of what is called, too: a call begins there.
    let there = |span: Span| {
        let at = span.resolved_at(Span::mixed_site());
        let path = private.clone().into_iter().map(|mut token| {
            token.set_span(at);
            token
        });
        (at, path.collect::<TokenStream>())
    };
    let (at, private) = there(span);
    let kind = match joined {
        Interpolation::Linear => quote!(Linear),
        Interpolation::Hermite => quote!(Hermite),
        Interpolation::Cubic => quote!(Cubic),
    };
    if axes.is_empty() && *joined != Interpolation::Hermite {
        return quote_spanned!(at=> const #name: #private::#kind<{ #values.len() }> = #private::#kind::through(&#values););
    }
    let (of, variables) = match axes.len() {
        0 => (quote_spanned!(at=> through), 1),
        1 => (quote_spanned!(at=> of_one), 1),
        2 => (quote_spanned!(at=> of_two), 2),
        _ => (quote_spanned!(at=> of_three), 3),
    };
    let mut lengths: Vec<TokenStream> = axes.iter().map(|Axis { path, .. }| quote!({ #path.len() })).collect();
    let checked: Vec<Ident> = (0..axes.len()).map(|k| format_ident!("{}_AXIS_{}", name, k)).collect();
    let constants = axes.iter().zip(&lengths).zip(&checked).map(|((Axis { path, span, .. }, length), checked)| {
        let (at, private) = there(*span);
        quote_spanned!(at=> const #checked: [f64; #length] = #private::axis(&#path);)
    });
    let constants: TokenStream = constants.collect();
    if axes.is_empty() {
        lengths.push(quote!({ #values.len() }));
    }
    let ones = (lengths.len()..MOST_VARIABLES).map(|_| quote!(1));
    // At each point the value and its slopes along the axes, one after the other.
    let numbers = Literal::usize_unsuffixed(if *joined == Interpolation::Linear { 1 } else { 1 << variables });
    quote_spanned! {at=>
        #constants
        #[allow(long_running_const_eval)]
        const #name: #private::Grid<#(#lengths,)* #(#ones,)* #numbers> =
            #private::Grid::#of(#(&#checked,)* &#values, #private::Joined::#kind);
    }
}

/// Bound of the scalar, where it is a type parameter.
pub fn bound(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    let (ty, real) = (derived.scalar().ty(), derived.scalar().real);
    derived.is_generic().then(|| quote!(#ty: #real,))
}
