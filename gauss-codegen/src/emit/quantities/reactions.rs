//! `Reactions` and `ContactReactions`: forces and torques of joints, and the names of these.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use crate::mechanics::Method;
use crate::words::Unraw;

use crate::emit::derived::Derived;
use crate::emit::dialect::arguments::arguments_of;

use super::framed::enumerated;

/// The enum of names; the implementations.
pub fn reactions(derived: &Derived<'_, '_>) -> [Option<TokenStream>; 2] {
    let Some(program) = derived.program(Method::Reactions) else { return [None, None] };
    let (private, ty) = (derived.private(), derived.scalar().ty());
    let joints: Vec<Ident> = derived.item().wanted.reactions.iter().map(|joint| joint.name.clone()).collect();
    let (name, count) = (format_ident!("{}Joint", derived.item().ident), joints.len());
    let [names, named] = names(derived, &name, &joints);
    let (instructions, outputs) = derived.computed(program);
    let each = outputs.chunks(6).map(|wrench| quote!(#private::vector([#(#wrench),*])));
    let body = quote!(#instructions #private::ByFrame::new([#(#each),*]));
    let method = Method::Reactions;
    let all = derived.function_of(method.name(), arguments_of(method), quote!(Self::Reactions), body);
    let items = quote! {
        type Joint = #name;
        type Reactions = #private::ByFrame<#name, #private::SVector<#ty, 6>, #count>;
        #[inline]
        #all
    };
    let (reactions, of_contacts) =
        (derived.implementation(quote!(Reactions), items), of_contacts(derived, &name, count));
    [Some(names), Some(quote!(#named #reactions #of_contacts))]
}

fn names(derived: &Derived<'_, '_>, name: &Ident, joints: &[Ident]) -> [TokenStream; 2] {
    let words: Vec<String> = joints.iter().map(|joint| joint.unraw().to_string()).collect();
    let documentation = format!("Joints of [`{}`] whose reactions its kernel computes.", derived.item().ident);
    let labels =
        words.iter().map(|word| format!("The joint `{word}`, or the one that carries the body or frame `{word}`."));
    enumerated(derived, (name, documentation), (joints, &words, labels.collect()))
}

fn of_contacts(derived: &Derived<'_, '_>, name: &Ident, count: usize) -> Option<TokenStream> {
    let (instructions, outputs) = derived.computed(derived.program(Method::ContactReactions)?);
    let (private, ty) = (derived.private(), derived.scalar().ty());
    let rows = derived.subject.system.contacts.rates.len();
    let each = outputs.chunks(6 * rows).map(|of_joint| {
        let lines = of_joint.chunks(rows).map(|line| quote!([#(#line),*]));
        quote!(#private::matrix([#(#lines),*]))
    });
    let body = quote!(#instructions #private::ByFrame::new([#(#each),*]));
    let method = Method::ContactReactions;
    let all = derived.function_of(method.name(), arguments_of(method), quote!(Self::ContactReactions), body);
    let items = quote! {
        type ContactReactions = #private::ByFrame<#name, #private::SMatrix<#ty, 6, #rows>, #count>;
        #[inline]
        #all
    };
    Some(derived.implementation(quote!(ContactReactions), items))
}
