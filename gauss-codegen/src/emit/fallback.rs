//! Code that is emitted for a struct with mistakes: the mistakes, and what other code names of the kernel.
//!
//! The type of a kernel depends on clauses that may be the ones that are wrong, so no implementation of a trait would
//! fit the code that uses it. `NameKernel` is a type that contains the first mistake instead, as the length of an
//! array: the compiler reports that one and is silent about whatever depends on it. Only that an array has no fields
//! would be told of `NameState { … }`: `NameState` is therefore what a trait gives of it, which is not even known to be
//! an array.

use proc_macro2::{Ident, TokenStream, TokenTree};
use quote::{format_ident, quote};
use syn::{DeriveInput, Error};

/// The mistakes, each at its token, and stand-ins for `NameKernel` and `Name::kernel()`, so that one mistake is one
/// message.
pub fn fallback(input: &DeriveInput, mistakes: &Error) -> TokenStream {
    let DeriveInput { ident, vis, generics, .. } = input;
    let mut mistakes = mistakes.into_iter().map(|mistake| mistake.into_compile_error());
    let first = mistakes.next();
    let (name, state) = (format_ident!("{}Kernel", ident), format_ident!("{}State", ident));
    let (impl_generics, type_generics, where_clause) = generics.split_for_impl();
    // A generic kernel has one type parameter: its scalar.
    let mut parameters = generics.type_params().map(|parameter| &parameter.ident);
    let scalar = parameters.next().filter(|_| parameters.next().is_none());
    let (declared, element) = match scalar {
        Some(scalar) => (quote!(<#scalar>), quote!(#scalar)),
        None => (quote!(), quote!(())),
    };
    let inputs = names(input, &["input", "urdf", "mjcf"]).then(|| {
        let inputs = format_ident!("{}Input", ident);
        quote! {
            #[allow(non_camel_case_types, dead_code)]
            #vis type #inputs #declared = #name #declared;
        }
    });
    let of_f64 = scalar.map(|_| quote!(<::core::primitive::f64>));
    let words = |alias: Ident| {
        quote! {
            #[allow(non_camel_case_types, dead_code)]
            #vis type #alias = #name #of_f64;
        }
    };
    let frames = names(input, &["frames"]).then(|| words(format_ident!("{}Frame", ident)));
    let index = words(format_ident!("{}Index", ident));
    quote! {
        #frames
        #index
        #inputs
        #[allow(non_camel_case_types, dead_code)]
        #vis type #name #declared = [#element; #first];
        #[allow(non_camel_case_types, dead_code)]
        #vis type #state #declared = <#name #declared as ::core::iter::Iterator>::Item;
        #(#mistakes)*

        const _: () = {
            #[allow(clippy::all, clippy::pedantic)]
            #[allow(dead_code)]
            impl #impl_generics #ident #type_generics #where_clause {
                #vis fn kernel(&self) -> #name #declared {
                    loop {}
                }
            }
        };
    }
}

/// Whether one of these is among the clauses, wherever the mistakes are.
fn names(input: &DeriveInput, words: &[&str]) -> bool {
    let attributes = input.attrs.iter().filter_map(|attribute| attribute.meta.require_list().ok());
    let mut tokens = attributes.flat_map(|list| list.tokens.clone());
    tokens.any(|token| matches!(token, TokenTree::Ident(word) if words.iter().any(|known| word == known)))
}
