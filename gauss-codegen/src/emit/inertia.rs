//! Inertia tensors of one body as rows, and what must hold of one that turns about a single axis.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use crate::model::Shape;

use super::derived::Derived;

/// What must hold of the inertia of a body, about O or about its centre of mass (`central`).
pub fn of_body(
    derived: &Derived<'_, '_>,
    name: Option<&Ident>,
    said: &str,
    [mass, center, inertia]: [&Ident; 3],
    central: bool,
) -> TokenStream {
    let (ty, real) = (derived.scalar().ty(), derived.scalar().real);
    // About the centre of mass there is no lever.
    let arm = if central { quote!([<#ty as #real>::zero(); 3]) } else { quote!(#center) };
    match derived.subject.only_axis(name) {
        Some(axis) => in_plane(derived, axis, said, [mass, inertia], &arm),
        None if central => quote!(__check.central_inertia(#said, #mass, #arm, &#inertia);),
        None => quote! {
            __check.inertia(#said, &#inertia);
            __check.central_inertia(#said, #mass, #arm, &#inertia);
        },
    }
}

/// Of a body that turns about one of its axes alone only the moment of inertia about that axis enters, and the two
/// components of the centre of mass across it.
fn in_plane(
    derived: &Derived<'_, '_>,
    axis: usize,
    said: &str,
    [mass, inertia]: [&Ident; 2],
    center: &TokenStream,
) -> TokenStream {
    let (ty, real) = (derived.scalar().ty(), derived.scalar().real);
    let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
    let zero = quote!(<#ty as #real>::zero());
    quote! {
        let __center = #center;
        for __row in &#inertia {
            __check.finite(#said, __row);
        }
        __check.kinetic_matrix(#said, &[
            [#mass, #zero, -(#mass * __center[#b])],
            [#zero, #mass, #mass * __center[#a]],
            [-(#mass * __center[#b]), #mass * __center[#a], #inertia[#axis][#axis]],
        ]);
    }
}

/// I_O as a matrix, as it is written.
pub fn inertia_rows(ty: &TokenStream, derived: &Derived<'_, '_>, shape: Shape, name: &Ident) -> TokenStream {
    let real = derived.scalar().real;
    let zero = quote!(<#ty as #real>::zero());
    let rows = (0..3usize).map(|i| {
        let row = (0..3usize).map(|j| match shape {
            Shape::Scalar if i == j => quote!(#name),
            Shape::Vector3 if i == j => quote!(#name[#i]),
            Shape::Matrix3 => quote!(#name[#i][#j]),
            _ => zero.clone(),
        });
        quote!([#(#row),*])
    });
    quote!([#(#rows),*])
}
