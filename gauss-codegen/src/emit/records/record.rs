//! Structs whose fields are numbers, vectors, rotations and poses by name: states, inputs.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use crate::emit::derived::{Derived, KernelGenerics};
use crate::words::Unraw;

/// One field.
pub use crate::translate::{NamedQuantity as Part, QuantityKind as PartKind};

impl Part {
    fn ty(&self, private: &TokenStream, ty: &TokenStream) -> TokenStream {
        match self.kind {
            PartKind::Scalar => ty.clone(),
            PartKind::Vector(size) => quote!(#private::SVector<#ty, #size>),
            PartKind::Rotation => quote!(#private::UnitQuaternion<#ty>),
            PartKind::Pose => quote!(#private::Isometry3<#ty>),
            PartKind::Plane => quote!(#private::Isometry2<#ty>),
        }
    }

    /// The names of the numbers that it consists of, in the order of `Configuration::components`.
    pub fn names(&self) -> Vec<String> {
        let word = self.ident.unraw().to_string();
        let ends: &[&str] = match self.kind {
            PartKind::Scalar => return vec![word],
            PartKind::Vector(3) => &["x", "y", "z"],
            PartKind::Vector(size) => return (1..=size).map(|k| format!("{word}_{k}")).collect(),
            PartKind::Rotation => &["i", "j", "k", "w"],
            PartKind::Pose => &["i", "j", "k", "w", "x", "y", "z"],
            PartKind::Plane => &["cos", "sin", "x", "y"],
        };
        ends.iter().map(|end| format!("{word}_{end}")).collect()
    }

    /// `craft: Isometry3`, for people.
    pub fn shown(&self) -> String {
        match self.kind {
            PartKind::Scalar => self.ident.to_string(),
            PartKind::Vector(size) => format!("{}: Vector{size}", self.ident),
            PartKind::Rotation => format!("{}: UnitQuaternion", self.ident),
            PartKind::Pose => format!("{}: Isometry3", self.ident),
            PartKind::Plane => format!("{}: Isometry2", self.ident),
        }
    }
}

/// Names of the numbers of parts, each once: scalars have theirs, and where a number of another part has one that is
/// there already, `_2` follows.
pub fn number_names(parts: &[&Part]) -> Vec<Vec<String>> {
    let scalars = parts.iter().filter(|part| part.kind == PartKind::Scalar);
    let mut taken: Vec<String> = scalars.map(|part| part.ident.unraw().to_string()).collect();
    let mut names = |part: &&Part| -> Vec<String> {
        if part.kind == PartKind::Scalar {
            return part.names();
        }
        let free = |name: String| {
            let numbered = (2..).map(|n| format!("{name}_{n}"));
            let free = std::iter::once(name.clone()).chain(numbered).find(|name| !taken.contains(name));
            taken.extend(free.clone());
            free.unwrap_or_default()
        };
        part.names().into_iter().map(free).collect()
    };
    parts.iter().map(&mut names).collect()
}

/// The type with what it is, and `Clone`, `Copy`, `Debug` and `Default`, which is at `rest`.
pub fn record(
    derived: &Derived<'_, '_>,
    name: &Ident,
    [documentation, rest]: [&str; 2],
    parts: &[&Part],
) -> [TokenStream; 2] {
    let (private, ty, visibility) = (derived.private(), derived.scalar().ty(), &derived.item().visibility);
    let KernelGenerics { declared, .. } = derived.kernel_generics();
    let fields = parts.iter().map(|part| {
        let (ident, ty, label) = (&part.ident, part.ty(&private, &ty), &part.label);
        quote!(#[doc = #label] pub #ident: #ty)
    });
    let declaration = quote! {
        #[doc = #documentation]
        #[allow(non_camel_case_types, non_snake_case, dead_code)]
        #visibility struct #name #declared { #(#fields),* }
    };
    [declaration, traits(derived, name, rest, parts)]
}

/// Written out: what is derived would ask scalars for more than configurations do.
fn traits(derived: &Derived<'_, '_>, name: &Ident, rest: &str, parts: &[&Part]) -> TokenStream {
    let KernelGenerics { bounded, used, .. } = derived.kernel_generics();
    let (title, at_rest) = (name.unraw().to_string(), at_rest(derived, parts));
    let shown = parts.iter().map(|Part { ident, .. }| {
        let word = ident.unraw().to_string();
        quote!(.field(#word, &self.#ident))
    });
    quote! {
        #[automatically_derived]
        impl #bounded ::core::clone::Clone for #name #used {
            #[inline(always)]
            fn clone(&self) -> Self { *self }
        }

        #[automatically_derived]
        impl #bounded ::core::marker::Copy for #name #used {}

        #[automatically_derived]
        impl #bounded ::core::fmt::Debug for #name #used {
            fn fmt(&self, __f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
                __f.debug_struct(#title)#(#shown)*.finish()
            }
        }

        #[automatically_derived]
        impl #bounded ::core::default::Default for #name #used {
            #[doc = #rest]
            #[inline]
            fn default() -> Self { #at_rest }
        }
    }
}

fn at_rest(derived: &Derived<'_, '_>, parts: &[&Part]) -> TokenStream {
    let (private, ty, real) = (derived.private(), derived.scalar().ty(), derived.scalar().real);
    let zero = quote!(<#ty as #real>::zero());
    let fields = parts.iter().map(|part| {
        let ident = &part.ident;
        match part.kind {
            PartKind::Scalar => quote!(#ident: #zero),
            PartKind::Vector(size) => quote!(#ident: #private::vector([#zero; #size])),
            PartKind::Rotation => quote!(#ident: #private::unturned()),
            PartKind::Pose => quote!(#ident: #private::unmoved()),
            PartKind::Plane => quote!(#ident: #private::unmoved_in_plane()),
        }
    });
    quote!(Self { #(#fields),* })
}

/// Whole fields from the numbers `of(k)` in their order.
pub fn from_numbers(private: &TokenStream, parts: &[Part], of: impl Fn(usize) -> TokenStream) -> Vec<TokenStream> {
    let mut next = 0_usize;
    let field = |part: &Part| {
        let components: Vec<TokenStream> = (next..next + part.size()).map(&of).collect();
        next += part.size();
        let ident = &part.ident;
        match part.kind {
            PartKind::Scalar => quote!(#ident: #(#components)*),
            _ => quote!(#ident: #private::vector([#(#components),*])),
        }
    };
    parts.iter().map(field).collect()
}

/// Numbers from whole fields, in their order.
pub fn to_numbers(private: &TokenStream, parts: &[Part]) -> Vec<TokenStream> {
    let numbers = parts.iter().flat_map(|part| {
        let ident = &part.ident;
        let component = |k: usize| match part.kind {
            PartKind::Scalar => quote!(self.#ident),
            _ => quote!(#private::components(&self.#ident)[#k]),
        };
        (0..part.size()).map(component).collect::<Vec<_>>()
    });
    numbers.collect()
}
