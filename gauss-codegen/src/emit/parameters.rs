//! `kernel()`: the fields of the user's struct read, checked, and turned into the constants of the kernel.

use proc_macro2::{Span, TokenStream};
use quote::{format_ident, quote};
use syn::ext::IdentExt;

use crate::algebra::{Map, Rational};
use crate::kernel::Program;
use crate::mechanics::{ParameterSymbol, Quantity};
use crate::model::{Field, Model, Motion, Shape};
use crate::translate::role_of;

use super::assigned::assigned_local;
use super::derived::{BodySubject, Derived, Plain};
use super::program::statements;
use super::system_parameters::{element as source_element, plain_fields};

const QUANTITIES: [Quantity; 7] = [
    Quantity::Mass,
    Quantity::CenterOfMass,
    Quantity::Inertia,
    Quantity::AddedMass,
    Quantity::Gravity,
    Quantity::DisplacedMass,
    Quantity::CenterOfBuoyancy,
];

/// The local that holds a field while `kernel()` works.
fn local(quantity: Quantity) -> proc_macro2::Ident {
    let position = QUANTITIES.iter().position(|q| *q == quantity).unwrap_or_default();
    format_ident!("__p{}", position, span = Span::mixed_site())
}

/// Is the quantity a scalar, a vector, or a matrix?
fn rank(derived: &BodySubject<'_, '_>, quantity: Quantity) -> usize {
    match derived.model.shape(role_of(quantity)) {
        Some(Shape::Matrix3 | Shape::Matrix6) => 2,
        Some(Shape::Vector3 | Shape::Vector6) => 1,
        _ => 0,
    }
}

fn element(derived: &BodySubject<'_, '_>, p: &ParameterSymbol<'_>) -> TokenStream {
    let (name, row, column) = (local(p.quantity), p.row, p.column);
    match rank(derived, p.quantity) {
        0 => quote!(#name),
        1 => quote!(#name[#row]),
        _ => quote!(#name[#row][#column]),
    }
}

/// What speaks for a quantity: its field, or the word of its clause.
fn said(model: &Model, quantity: Quantity) -> String {
    let role = role_of(quantity);
    model.field(role).map_or_else(|| role.word().to_owned(), |field| field.ident.unraw().to_string())
}

/// The body of `kernel()`.
pub fn kernel_body(derived: &BodySubject<'_, '_>) -> TokenStream {
    let (model, private) = (derived.model, derived.derived.private());
    let mut read = TokenStream::new();
    let mut symbols: Map<u32, TokenStream> =
        derived.scene.body.parameters.iter().map(|p| (p.symbol.key(), element(derived, p))).collect();
    let mut finite = TokenStream::new();
    if let Some(Plain { fields, sources, literals, .. }) = derived.plain {
        let locals;
        (locals, finite) = plain_fields(derived.derived, fields, sources);
        read.extend(locals);
        symbols.extend(sources.iter().map(|s| (s.symbol.key(), source_element(s))));
        let scalar = derived.derived.scalar();
        symbols.extend(literals.iter().map(|(value, symbol)| (symbol.key(), scalar.number(value))));
    }
    for quantity in QUANTITIES {
        let name = local(quantity);
        let assigned = derived.plain.and_then(|plain| plain.assigned.iter().find(|a| a.quantity == quantity));
        if let Some(assigned) = assigned {
            read.extend(assigned_local(derived.derived, &name, assigned, &symbols));
        }
        let Some(Field { ident, .. }) = model.field(role_of(quantity)) else { continue };
        read.extend(match rank(derived, quantity) {
            0 => quote!(let #name = self.#ident;),
            1 => quote!(let #name = #private::components(&self.#ident);),
            _ => quote!(let #name = #private::entries(&self.#ident);),
        });
    }
    let mut checks = checks(derived, &symbols);
    checks.extend(finite);
    let kernel = constants(derived.derived, &symbols, &said(model, Quantity::Mass));
    quote! {
        #read
        #checks
        __check.finish()?;
        #kernel
    }
}

/// The constants computed and checked: together, parameters that are fine one by one can overflow. `said` is the field that
/// speaks for them.
pub fn constants(derived: &Derived<'_, '_>, symbols: &Map<u32, TokenStream>, said: &str) -> TokenStream {
    let private = derived.private();
    let ty = derived.scalar().ty();
    let (compute, outputs) = statements(&derived.kernel.constants, symbols, &derived.scalar());
    let (name, fields) = (derived.kernel_name(), derived.constant_fields());
    quote! {
        #compute
        let __kernel = #name { #(#fields: #outputs),* };
        let mut __check = #private::ParameterCheck::<#ty>::new();
        __check.constants(#said, &[#(__kernel.#fields),*]);
        __check.finish()?;
        ::core::result::Result::Ok(__kernel)
    }
}

/// What makes a set of parameters a body: all violations are reported together.
fn checks(derived: &BodySubject<'_, '_>, symbols: &Map<u32, TokenStream>) -> TokenStream {
    let (model, private) = (derived.model, derived.derived.private());
    let scalar = derived.derived.scalar();
    let ty = scalar.ty();
    let name_of = |quantity| said(model, quantity);
    let has = |quantity| model.shape(role_of(quantity)).is_some();
    let mut checks = TokenStream::new();
    let (mass, mass_name) = (local(Quantity::Mass), name_of(Quantity::Mass));
    checks.extend(quote!(__check.mass(#mass_name, #mass);));
    for quantity in [Quantity::CenterOfMass, Quantity::Gravity, Quantity::CenterOfBuoyancy] {
        if has(quantity) {
            let (field, value) = (name_of(quantity), local(quantity));
            checks.extend(match rank(derived, quantity) {
                0 => quote!(__check.finite(#field, &[#value]);),
                _ => quote!(__check.finite(#field, &#value);),
            });
        }
    }
    if has(Quantity::DisplacedMass) {
        let (field, value) = (name_of(Quantity::DisplacedMass), local(Quantity::DisplacedMass));
        checks.extend(quote!(__check.non_negative(#field, #value);));
    }
    // In the plane only the moment about k₃ enters.
    let inertia_name = name_of(Quantity::Inertia);
    let planar = derived.in_chart.motion == Motion::Planar;
    let rows = (0..3).map(|i| {
        let row = (0..3).map(|j| {
            if planar && i == j {
                entry_as_written(derived, 2, 2)
            } else if planar {
                scalar.number(&Rational::zero())
            } else {
                entry_as_written(derived, i, j)
            }
        });
        quote!([#(#row),*])
    });
    checks.extend(quote!(let __inertia = [#(#rows),*]; __check.inertia(#inertia_name, &__inertia);));
    if planar {
        let all = (0..3).flat_map(|i| (i..3).map(move |j| (i, j))).map(|(i, j)| entry_as_written(derived, i, j));
        checks.extend(quote!(__check.finite(#inertia_name, &[#(#all),*]);));
    }
    if derived.in_chart.motion == Motion::Free && has(Quantity::CenterOfMass) {
        let center = local(Quantity::CenterOfMass);
        checks.extend(quote!(__check.central_inertia(#inertia_name, #mass, #center, &__inertia);));
    }
    if has(Quantity::AddedMass) {
        let (field, value) = (name_of(Quantity::AddedMass), local(Quantity::AddedMass));
        checks.extend(match rank(derived, Quantity::AddedMass) {
            1 => quote!(__check.finite(#field, &#value);),
            _ => quote!(__check.symmetric(#field, &#value);),
        });
    }
    let translates = derived.in_chart.motion != Motion::FixedPoint;
    if has(Quantity::AddedMass) || (translates && has(Quantity::CenterOfMass)) {
        let field = if has(Quantity::AddedMass) { name_of(Quantity::AddedMass) } else { inertia_name };
        let active = &derived.scene.kinematics.active;
        let entries: Vec<_> = active
            .iter()
            .flat_map(|&i| active.iter().map(move |&j| (i, j)))
            .map(|(i, j)| derived.scene.matrix.entries[i][j])
            .collect();
        let (compute, outputs) = statements(&Program::lower(&entries), symbols, &scalar);
        let rows = outputs.chunks(active.len()).map(|row| quote!([#(#row),*]));
        checks.extend(quote!({
            #compute
            __check.kinetic_matrix(#field, &[#(#rows),*]);
        }));
    }
    quote! {
        let mut __check = #private::ParameterCheck::<#ty>::new();
        #checks
    }
}

/// An entry of the inertia tensor as the user wrote it, so that an asymmetry is seen.
fn entry_as_written(derived: &BodySubject<'_, '_>, i: usize, j: usize) -> TokenStream {
    let name = local(Quantity::Inertia);
    match rank(derived, Quantity::Inertia) {
        2 => quote!(#name[#i][#j]),
        _ if i != j => derived.derived.scalar().number(&Rational::zero()),
        1 => quote!(#name[#i]),
        _ => quote!(#name),
    }
}
