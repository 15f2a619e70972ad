//! Inertia tensors of one body as rows, and what must hold of one that turns about a single axis.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use crate::model::Shape;

use super::derived::Derived;

/// Of a body that turns about one of its axes alone only the moment of inertia about that axis enters, and the two
/// components of the centre of mass across it.
pub fn in_plane(
    derived: &Derived<'_, '_>,
    axis: usize,
    said: &str,
    [mass, center, inertia]: [&Ident; 3],
) -> TokenStream {
    let (ty, real) = (derived.scalar().ty(), derived.scalar().real);
    let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
    let zero = quote!(<#ty as #real>::zero());
    quote! {
        for __row in &#inertia {
            __check.finite(#said, __row);
        }
        __check.kinetic_matrix(#said, &[
            [#mass, #zero, -(#mass * #center[#b])],
            [#zero, #mass, #mass * #center[#a]],
            [-(#mass * #center[#b]), #mass * #center[#a], #inertia[#axis][#axis]],
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
