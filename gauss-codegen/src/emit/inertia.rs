//! Inertia tensors of bodies as rows, and what must hold of the mass data of bodies that others move with.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use crate::terms::Shape;
use crate::words::Unraw;

use super::derived::Derived;

/// What must hold of the mass data of a body with a name: mass, centre of mass from O, rows of the inertia about O, or
/// about the centre of mass (`central`), which is called `word`.
pub fn named_body(
    derived: &Derived<'_, '_>,
    body: &Ident,
    word: &str,
    [mass, center, inertia]: [&Ident; 3],
    central: bool,
) -> TokenStream {
    let [said_mass, said_center, said_inertia] =
        ["mass", "center_of_mass", word].map(|part| format!("{}.{part}", body.unraw()));
    let (ty, real) = (derived.scalar().ty(), derived.scalar().real);
    // About the centre of mass there is no lever.
    let arm = if central { quote!([<#ty as #real>::zero(); 3]) } else { quote!(#center) };
    let of_inertia = in_sum(derived, Some(body), &said_inertia, [&quote!(#mass), &arm, &quote!(#inertia)]);
    quote! {
        __check.mass_in_sum(#said_mass, #mass);
        __check.finite(#said_center, &#center);
        #of_inertia
    }
}

/// What must hold of the inertia of the body of that name (the unnamed one), which moves with others.
pub fn in_sum(
    derived: &Derived<'_, '_>,
    body: Option<&Ident>,
    label: &str,
    [mass, center, inertia]: [&TokenStream; 3],
) -> TokenStream {
    let check = match derived.subject.only_axis(body) {
        Some(axis) => quote!(__check.inertia_about_axis(#label, #axis, (#mass, #center), &#inertia);),
        None => quote!(__check.inertia_in_sum(#label, #mass, #center, &#inertia);),
    };
    waived(derived, body, check)
}

/// Checks of the inertia of a body, without the triangle inequality where that is waived.
pub fn waived(derived: &Derived<'_, '_>, body: Option<&Ident>, checks: TokenStream) -> TokenStream {
    let mut bodies = derived.subject.given.mass_data.bodies.iter();
    if !bodies.any(|own| own.is_formal && own.name.as_ref() == body) {
        return checks;
    }
    quote! {
        __check.waive_triangle_inequality(true);
        #checks
        __check.waive_triangle_inequality(false);
    }
}

/// A check of the mass matrix of one body, which says nothing where others make up for what it lacks: their sum is
/// checked then.
pub fn own_matrix(derived: &Derived<'_, '_>, check: TokenStream) -> TokenStream {
    match derived.subject.system.scene.chart() {
        Some(_) => check,
        None => quote!(if __check.massless().is_none() #check),
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
