//! `NameIndex`: where the components of an increment of the state are, by name.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use crate::emit::derived::Derived;
use crate::emit::records::record::PartKind;
use crate::emit::records::state::ordered_parts;

/// A type without values whose constants are the places: a number, or the range of a vector, a rotation, a pose.
pub fn index(derived: &Derived<'_, '_>) -> TokenStream {
    let (name, kernel, visibility) =
        (format_ident!("{}Index", derived.item().ident), derived.kernel_name(), &derived.item().visibility);
    let documentation = format!(
        "Where the components of an increment (σ, δz) of a state of [`{kernel}`] are, by name: coordinates have those of \
         their increments, of a pose velocity before rotation, and then come the speeds."
    );
    let mut next = 0_usize;
    let places = ordered_parts(derived).into_iter().flatten().map(|part| {
        let size = match part.kind {
            PartKind::Scalar => 1,
            PartKind::Vector(size) => size,
            PartKind::Rotation | PartKind::Plane => 3,
            PartKind::Pose => 6,
        };
        let (from, to) = (next, next + size);
        next = to;
        let (ident, label) = (&part.ident, &part.label);
        match part.kind {
            PartKind::Scalar => quote!(#[doc = #label] #visibility const #ident: ::core::primitive::usize = #from;),
            _ => quote! {
                #[doc = #label]
                #visibility const #ident: ::core::ops::Range<::core::primitive::usize> = #from..#to;
            },
        }
    });
    let places: Vec<TokenStream> = places.collect();
    quote! {
        #[doc = #documentation]
        #[allow(dead_code)]
        #visibility enum #name {}

        #[allow(dead_code, non_upper_case_globals)]
        impl #name { #(#places)* }
    }
}
