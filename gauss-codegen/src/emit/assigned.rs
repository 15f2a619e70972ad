//! Mass data that are written in clauses: their values as locals of `kernel()`, checked like those of fields.

use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote};
use syn::ext::IdentExt;

use crate::algebra::Map;
use crate::kernel::Program;
use crate::mechanics::{Assigned, Quantity};
use crate::model::Shape;

use super::derived::Derived;
use super::program::statements;
use super::system::SystemSubject;
use super::system_parameters::{in_plane, inertia_rows};

/// `let name = …;`: the value, or the array of components.
pub fn assigned_local(
    derived: &Derived<'_, '_>,
    name: &Ident,
    assigned: &Assigned<'_>,
    symbols: &Map<u32, TokenStream>,
) -> TokenStream {
    let (compute, values) = statements(&Program::lower(&assigned.values), symbols, &derived.scalar());
    match values.as_slice() {
        [value] => quote!(let #name = { #compute #value };),
        values => quote!(let #name = { #compute [#(#values),*] };),
    }
}

/// Locals and checks of the bodies of a system whose mass data stand in their clauses.
pub fn assigned_bodies(
    derived: &Derived<'_, '_>,
    subject: &SystemSubject<'_, '_>,
    symbols: &Map<u32, TokenStream>,
) -> TokenStream {
    let (ty, real) = (derived.scalar().ty(), derived.scalar().real);
    let mut checks = TokenStream::new();
    for (clause, body) in subject.model.bodies.iter().enumerate() {
        let Some(name) = &body.name else { continue };
        let own = &subject.assigned_to_bodies[clause];
        let value_of = |quantity: Quantity| own.iter().find(|assigned| assigned.quantity == quantity);
        let (Some(mass), Some(inertia)) = (value_of(Quantity::Mass), value_of(Quantity::Inertia)) else { continue };
        let local = |part: &str| format_ident!("__b{}", part, span = Span::mixed_site());
        let [m, c, moments, tensor] = ["mass", "center", "moments", "inertia"].map(local);
        let zero = quote!(<#ty as #real>::zero());
        let mut read = assigned_local(derived, &m, mass, symbols);
        read.extend(match value_of(Quantity::CenterOfMass) {
            Some(center) => assigned_local(derived, &c, center, symbols),
            None => quote!(let #c = [#zero; 3];),
        });
        read.extend(assigned_local(derived, &moments, inertia, symbols));
        let shape = if inertia.values.len() == 1 { Shape::Scalar } else { Shape::Vector3 };
        let rows = inertia_rows(&ty, derived, shape, &moments);
        read.extend(quote!(let #tensor = #rows;));
        let said = |part: &str| format!("{}.{part}", name.unraw());
        let [said_mass, said_center, said_inertia] = ["mass", "center_of_mass", "inertia"].map(said);
        let of_inertia = match subject.only_axis(Some(name)) {
            Some(axis) => in_plane(derived, axis, &said_inertia, [&m, &c, &tensor]),
            None => quote! {
                __check.inertia(#said_inertia, &#tensor);
                __check.central_inertia(#said_inertia, #m, #c, &#tensor);
            },
        };
        checks.extend(quote!({
            #read
            __check.mass(#said_mass, #m);
            __check.finite(#said_center, &#c);
            #of_inertia
        }));
    }
    checks
}
