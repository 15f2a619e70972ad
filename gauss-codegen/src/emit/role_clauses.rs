//! Mass data that are written in clauses: their values as locals of `kernel()`, checked like those of fields.

use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote};

use crate::algebra::Map;
use crate::kernel::Program;
use crate::mechanics::{KineticMatrix, QuantityValues};
use crate::terms::{Role, Shape};
use crate::translate::ClauseValue;

use super::derived::Derived;
use super::inertia::{inertia_rows, named_body, own_matrix};
use super::program::statements;

/// `let name = …;`: the value, or the array of components.
pub fn clause_local(
    derived: &Derived<'_, '_>,
    name: &Ident,
    own: &QuantityValues<'_>,
    symbols: &Map<u32, TokenStream>,
) -> TokenStream {
    let (compute, values) = statements(&Program::lower(&own.values), symbols, &derived.scalar());
    match values.as_slice() {
        [value] => quote!(let #name = { #compute #value };),
        // Half of a symmetric matrix, column by column.
        values if values.len() == 21 => {
            let place = |i: usize, j: usize| 6 * i - i * (i + 1) / 2 + j;
            let rows = (0..6).map(|i: usize| {
                let row = (0..6).map(|j: usize| &values[place(i.min(j), i.max(j))]);
                quote!([#(#row),*])
            });
            quote!(let #name = { #compute [#(#rows),*] };)
        }
        // The upper triangle of an inertia, row by row.
        [xx, xy, xz, yy, yz, zz] if own.quantity != Role::AddedMass => {
            quote!(let #name = { #compute [[#xx, #xy, #xz], [#xy, #yy, #yz], [#xz, #yz, #zz]] };)
        }
        values => quote!(let #name = { #compute [#(#values),*] };),
    }
}

/// What must hold of the fluid about the bodies: what clauses of named bodies say of it, and that the body and its
/// added mass together have a positive definite kinetic energy in every motion that the body can have.
pub fn fluid(derived: &Derived<'_, '_>, symbols: &Map<u32, TokenStream>) -> TokenStream {
    let subject = &derived.subject;
    let mut checks = TokenStream::new();
    for written in &subject.given.mass_data.bodies {
        let of_fluid = |value: &&ClauseValue<'_>| !value.own.quantity.is_of_matter();
        for ClauseValue { own, shape, .. } in written.values.iter().filter(of_fluid) {
            let (label, local) =
                (subject.role_name(written, own.quantity), format_ident!("__fluid", span = Span::mixed_site()));
            let value = clause_local(derived, &local, own, symbols);
            let check = match (own.quantity, shape) {
                (Role::DisplacedMass, _) => quote!(__check.non_negative(#label, #local);),
                (_, Shape::Matrix6) => continue,
                _ => quote!(__check.finite(#label, &#local);),
            };
            checks.extend(quote!({ #value #check }));
        }
        let (scene, number) = (&subject.system.scene, written.link);
        let link = &scene.tree.links[number];
        let Some(body) = link.body().filter(|body| body.added_mass.is_some()) else { continue };
        let active = scene.twist_of(number);
        let matrix = KineticMatrix::new(link.frame.graph, body, &[0, 1, 2], &[3, 4, 5]);
        let entries: Vec<_> = active
            .iter()
            .flat_map(|&i| active.iter().map(move |&j| (i, j)))
            .map(|(i, j)| matrix.entries[i][j])
            .collect();
        let (compute, outputs) = statements(&Program::lower(&entries), symbols, &derived.scalar());
        let rows = outputs.chunks(active.len()).map(|row| quote!([#(#row),*]));
        let label = subject.role_name(written, Role::AddedMass);
        checks.extend(own_matrix(derived, quote!({ #compute __check.kinetic_matrix(#label, &[#(#rows),*]); })));
    }
    checks
}

/// Locals and checks of the bodies of a system whose mass data stand in their clauses.
pub fn body_clauses(derived: &Derived<'_, '_>, symbols: &Map<u32, TokenStream>) -> TokenStream {
    let (ty, real, subject) = (derived.scalar().ty(), derived.scalar().real, &derived.subject);
    let mut checks = TokenStream::new();
    for body in &subject.given.mass_data.bodies {
        let Some(name) = &body.name else { continue };
        let own = body.values.iter().map(|value| &value.own);
        let value_of = |quantity: Role| own.clone().find(|own| own.quantity == quantity);
        let central = value_of(Role::CentralInertia);
        let inertia = central.or_else(|| value_of(Role::Inertia));
        let (Some(mass), Some(inertia)) = (value_of(Role::Mass), inertia) else { continue };
        let local = |part: &str| format_ident!("__b{}", part, span = Span::mixed_site());
        let [m, c, moments, tensor] = ["mass", "center", "moments", "inertia"].map(local);
        let zero = quote!(<#ty as #real>::zero());
        let mut read = clause_local(derived, &m, mass, symbols);
        read.extend(match value_of(Role::CenterOfMass) {
            Some(center) => clause_local(derived, &c, center, symbols),
            None => quote!(let #c = [#zero; 3];),
        });
        read.extend(clause_local(derived, &moments, inertia, symbols));
        let shape = match inertia.values.len() {
            1 => Shape::Scalar,
            3 => Shape::Vector3,
            _ => Shape::Matrix3,
        };
        let rows = inertia_rows(&ty, derived, shape, &moments);
        read.extend(quote!(let #tensor = #rows;));
        let check = named_body(derived, name, inertia.quantity.word(), [&m, &c, &tensor], central.is_some());
        checks.extend(quote!({
            #read
            #check
        }));
    }
    checks
}
