//! `kernel()`: the fields of the user's struct read, checked, and turned into the constants of the kernel.

use proc_macro2::{Span, TokenStream};
use quote::{ToTokens, format_ident, quote};
use syn::ext::IdentExt;

use crate::algebra::{Expr, Map, Rational};
use crate::kernel::Program;
use crate::mechanics::{InertiaShape, ParameterSymbol, Quantity};
use crate::model::{Model, Motion, Parameter};

use super::kernel::{BodySubject, Derived, Plain};
use super::program::statements;
use super::system_parameters::{element as source_element, plain_fields};

/// The field that gives a quantity.
fn field(model: &Model, quantity: Quantity) -> Option<&Parameter> {
    let index = match quantity {
        Quantity::Mass => Some(model.mass),
        Quantity::CenterOfMass => model.center_of_mass,
        Quantity::Inertia => Some(model.inertia),
        Quantity::AddedMass => model.added_mass,
        Quantity::Gravity => model.gravity,
        Quantity::DisplacedMass => model.displaced_mass,
        Quantity::CenterOfBuoyancy => model.center_of_buoyancy,
    };
    index.and_then(|k| model.parameters.get(k))
}

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

/// Is the field a scalar, a vector, or a matrix?
fn rank(derived: &BodySubject<'_, '_>, quantity: Quantity) -> usize {
    let of: Vec<&ParameterSymbol<'_>> =
        derived.scene.body.parameters.iter().filter(|p| p.quantity == quantity).collect();
    match of.as_slice() {
        [_] => 0,
        several if several.iter().any(|p| p.column > 0) => 2,
        _ => 1,
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

/// The body of `kernel()`.
pub fn kernel_body(derived: &BodySubject<'_, '_>) -> TokenStream {
    let (model, runtime) = (derived.model, &derived.model.runtime);
    let private = quote!(#runtime::__private);
    let mut read = TokenStream::new();
    for quantity in QUANTITIES {
        let Some(parameter) = field(model, quantity) else { continue };
        let (name, ident) = (local(quantity), &parameter.ident);
        read.extend(match rank(derived, quantity) {
            0 => quote!(let #name = self.#ident;),
            1 => quote!(let #name = #private::components(&self.#ident);),
            _ => quote!(let #name = #private::entries(&self.#ident);),
        });
    }
    let mut symbols: Map<u32, TokenStream> =
        derived.scene.body.parameters.iter().map(|p| (p.symbol.key(), element(derived, p))).collect();
    let mut checks = checks(derived, &symbols);
    if let Some(Plain { fields, sources, literals }) = derived.plain {
        let (locals, finite) = plain_fields(derived.derived, fields, sources);
        read.extend(locals);
        checks.extend(finite);
        symbols.extend(sources.iter().map(|s| (s.symbol.key(), source_element(s))));
        let scalar = derived.derived.scalar();
        symbols.extend(literals.iter().map(|(value, symbol)| (symbol.key(), scalar.number(value))));
    }
    let mass_name = field(model, Quantity::Mass).map(|p| p.ident.unraw().to_string()).unwrap_or_default();
    let kernel = constants(derived.derived, &symbols, &mass_name);
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
    let (model, runtime) = (derived.model, &derived.model.runtime);
    let scalar = derived.derived.scalar();
    let ty = scalar.ty();
    let name_of = |quantity| field(model, quantity).map(|p| p.ident.unraw().to_string()).unwrap_or_default();
    let body = &derived.scene.body;
    let entry = |e: Expr<'_>| match symbols.get(&e.key()) {
        Some(tokens) => tokens.clone(),
        None => scalar.number(&Rational::zero()),
    };
    let has = |quantity| field(model, quantity).is_some();
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
    let planar = model.motion == Motion::Planar;
    let rows = (0..3).map(|i| {
        let row = (0..3).map(|j| {
            if planar && i == j {
                entry(body.inertia[2][2])
            } else if planar {
                entry(body.mass.graph().zero())
            } else {
                entry_as_written(derived, i, j, &entry)
            }
        });
        quote!([#(#row),*])
    });
    checks.extend(quote!(let __inertia = [#(#rows),*]; __check.inertia(#inertia_name, &__inertia);));
    if planar {
        let all = derived
            .scene
            .body
            .parameters
            .iter()
            .filter(|p| p.quantity == Quantity::Inertia)
            .map(|p| element(derived, p));
        checks.extend(quote!(__check.finite(#inertia_name, &[#(#all),*]);));
    }
    if model.motion == Motion::Free && has(Quantity::CenterOfMass) {
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
    let translates = model.motion != Motion::FixedPoint;
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
        let mut __check = #runtime::__private::ParameterCheck::<#ty>::new();
        #checks
    }
}

/// An entry of the inertia tensor as the user wrote it, so that an asymmetry is seen.
fn entry_as_written(
    derived: &BodySubject<'_, '_>,
    i: usize,
    j: usize,
    entry: &impl Fn(Expr<'_>) -> TokenStream,
) -> TokenStream {
    if derived.inertia == InertiaShape::Full {
        let name = local(Quantity::Inertia);
        return quote!(#name[#i][#j]).into_token_stream();
    }
    entry(derived.scene.body.inertia[i][j])
}
