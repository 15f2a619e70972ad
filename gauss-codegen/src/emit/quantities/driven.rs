//! `DrivenSystem`: driving forces of motions, and the names of these.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use crate::mechanics::Method;
use crate::words::Unraw;

use crate::emit::derived::Derived;
use crate::emit::dialect::arguments::arguments_of;

use super::framed::enumerated;

/// The enum of names; the implementation.
pub fn driven_system(derived: &Derived<'_, '_>) -> [Option<TokenStream>; 2] {
    let Some(program) = derived.program(Method::DrivingForces) else { return [None, None] };
    let (private, ty) = (derived.private(), derived.scalar().ty());
    let motions: &[Ident] = &derived.item().wanted.motions;
    let (name, count) = (format_ident!("{}Motion", derived.item().ident), motions.len());
    let words: Vec<String> = motions.iter().map(|motion| motion.unraw().to_string()).collect();
    let documentation = format!("Coordinates of [`{}`] that `motion` drives.", derived.item().ident);
    let labels = words.iter().map(|word| format!("The coordinate `{word}`.")).collect();
    let [names, named] = enumerated(derived, (&name, documentation), (motions, &words, labels));
    let (instructions, outputs) = derived.computed(program);
    let each = outputs.chunks(2).map(|own| {
        let (force, power) = (&own[0], &own[1]);
        quote!(#private::DrivingForce { force: #force, power: #power })
    });
    let body = quote!(#instructions #private::ByFrame::new([#(#each),*]));
    let method = Method::DrivingForces;
    let all = derived.function_of(method.name(), arguments_of(method), quote!(Self::DrivingForces), body);
    let items = quote! {
        type Motion = #name;
        type DrivingForces = #private::ByFrame<#name, #private::DrivingForce<#ty>, #count>;
        #[inline]
        #all
    };
    let system = derived.implementation(quote!(DrivenSystem), items);
    [Some(names), Some(quote!(#named #system))]
}
