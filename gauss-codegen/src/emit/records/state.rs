//! `NameState`: coordinates and speeds by name, and the way to and from configurations and speeds, which costs nothing.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use crate::terms::Item;
use crate::words::Unraw;

use crate::emit::derived::{Derived, KernelGenerics};
use crate::emit::records::record::{Part, PartKind, from_numbers, number_names, record, to_numbers};

/// The name of the type.
pub fn state_name(item: &Item) -> Ident {
    format_ident!("{}State", item.ident)
}

/// Coordinates, then speeds, each in their order, with different names.
pub fn parts(derived: &Derived<'_, '_>) -> [Vec<Part>; 2] {
    let mut all = derived.subject.provenance.state.clone();
    let mut taken: Vec<String> = Vec::new();
    for part in all.iter_mut().flatten() {
        let word = part.ident.unraw().to_string();
        let numbered = (2..).map(|n| format!("{word}_{n}"));
        let free = std::iter::once(word.clone()).chain(numbered).find(|name| !taken.contains(name));
        let free = free.unwrap_or_default();
        if free != word {
            part.ident = Ident::new(&free, part.ident.span());
        }
        taken.push(free);
    }
    all
}

/// In the order of their numbers: coordinates that are scalars stand behind all others.
pub fn ordered_parts(derived: &Derived<'_, '_>) -> [Vec<Part>; 2] {
    let [mut coordinates, speeds] = parts(derived);
    coordinates.sort_by_key(|part| part.kind == PartKind::Scalar);
    [coordinates, speeds]
}

/// Names of all numbers of a state: those of the configuration and the speeds.
pub fn component_names(derived: &Derived<'_, '_>) -> [Vec<String>; 2] {
    let all = ordered_parts(derived);
    let mut names = number_names(&all.iter().flatten().collect::<Vec<_>>());
    let speeds = names.split_off(all[0].len());
    [names.concat(), speeds.concat()]
}

/// The type, and what it implements.
pub fn state(derived: &Derived<'_, '_>) -> [TokenStream; 2] {
    let all = parts(derived);
    let (name, kernel) = (state_name(derived.item()), derived.kernel_name());
    let documentation = format!(
        "Coordinates and speeds of [`{kernel}`] by name.\n\n`{name} {{ … }}` has them in any order, `..Default::default()` \
         those that are zero; `q()` and `z()` are what kernels and runs take, `{name}::of(&q, &z)` is the way back."
    );
    let fields: Vec<&Part> = all.iter().flatten().collect();
    let rest = "At rest; coordinates are zero, rotations and poses those of the observer's frame.";
    let [declaration, traits] = record(derived, &name, [&documentation, rest], &fields);
    let conversions = conversions(derived, &all);
    [declaration, quote!(#conversions #traits)]
}

/// To and from configurations and speeds.
fn conversions(derived: &Derived<'_, '_>, all: &[Vec<Part>; 2]) -> TokenStream {
    let (private, name, kernel) = (derived.private(), state_name(derived.item()), derived.kernel_name());
    let KernelGenerics { bounded, used, .. } = derived.kernel_generics();
    let visibility = &derived.item().visibility;
    let system = quote!(<#kernel #used as #private::GaussSystem>);
    let of = conversion_from(derived, all);
    let (q, z) = (configuration_of(derived, &all[0]), speeds_of(&derived.private(), &all[1]));
    quote! {
        #[allow(clippy::all, clippy::pedantic)]
        #[allow(dead_code)]
        impl #bounded #name #used {
            /// The state that has this configuration and these speeds.
            #[inline(always)]
            #visibility fn of(__q: &#system::Configuration, __speeds: &#system::Speeds) -> Self { #of }

            /// The configuration.
            #[inline(always)]
            #visibility fn q(&self) -> #system::Configuration { #q }

            /// The speeds, in their order.
            #[inline(always)]
            #visibility fn z(&self) -> #system::Speeds { #z }
        }
    }
}

/// A literal of the state, from the factors of q and the components of z.
fn conversion_from(derived: &Derived<'_, '_>, [coordinates, speeds]: &[Vec<Part>; 2]) -> TokenStream {
    let private = derived.private();
    let places = derived.subject.places_of_coordinates(&private);
    let of_q = coordinates.iter().zip(places).map(|(Part { ident, .. }, place)| quote!(#ident: #place));
    let of_z = from_numbers(&private, speeds, |k| quote!(__z[#k]));
    quote! {
        let __z = #private::components(__speeds);
        Self { #(#of_q,)* #(#of_z),* }
    }
}

fn configuration_of(derived: &Derived<'_, '_>, coordinates: &[Part]) -> TokenStream {
    let values = coordinates.iter().map(|Part { ident, .. }| quote!(self.#ident)).collect::<Vec<_>>();
    derived.subject.configuration_of(&derived.private(), &values)
}

fn speeds_of(private: &TokenStream, speeds: &[Part]) -> TokenStream {
    let components = to_numbers(private, speeds);
    quote!(#private::vector([#(#components),*]))
}
