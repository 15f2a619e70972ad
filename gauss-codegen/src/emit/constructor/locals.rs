//! Parameters as locals of `kernel()` and `warnings()`: what each is called, and how it is read from the struct.

use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote};

use crate::algebra::Map;
use crate::kernel::Program;
use crate::mass_laws::Datum;
use crate::mechanics::QuantityValues;
use crate::terms::{Field, Role, Shape};
use crate::translate::{ClauseValue, FieldPart, ParameterSource};

use crate::emit::derived::Derived;
use crate::emit::dialect::program::{ScalarTokens, statements};

/// The local that holds a field, or one part of a rigid body.
pub fn local(field: usize, part: &str) -> Ident {
    format_ident!("__f{}{}", field, part, span = Span::mixed_site())
}

/// The word of a part of a rigid body: the field of `RigidBody` and the end of the local.
fn part(quantity: Role) -> &'static str {
    match quantity {
        Role::Mass => "mass",
        Role::CenterOfMass => "center_of_mass",
        _ => "inertia",
    }
}

/// Tokens of the value of a symbol where the locals are.
pub fn element(source: &ParameterSource<'_>) -> TokenStream {
    let plain = local(source.field, "");
    match source.part {
        FieldPart::Scalar => quote!(#plain),
        FieldPart::Component(i) => quote!(#plain[#i]),
        FieldPart::Entry(i, j) => quote!(#plain[#i][#j]),
        FieldPart::Body(quantity, i, j) => {
            let name = local(source.field, part(quantity));
            match quantity {
                Role::Mass => quote!(#name),
                Role::CenterOfMass => quote!(#name[#i]),
                _ => quote!(#name[#i][#j]),
            }
        }
    }
}

/// Tokens of the symbols of parameters, where they are read.
pub fn symbols_of_parameters(derived: &Derived<'_, '_>) -> Map<u32, TokenStream> {
    let (given, scalar) = (derived.subject.provenance, derived.scalar());
    let mut symbols: Map<u32, TokenStream> = given.sources.iter().map(|s| (s.symbol.key(), element(s))).collect();
    symbols.extend(given.literals.iter().map(|(value, symbol)| (symbol.key(), scalar.number(value))));
    symbols
}

/// The locals of all parameters: fields, and what clauses say of the body without a name and of gravity.
pub fn parameters_read(derived: &Derived<'_, '_>, symbols: &Map<u32, TokenStream>) -> TokenStream {
    let given = derived.subject.provenance;
    let fields = given.item.fields.iter().enumerate().filter(|(k, _)| given.is_read(*k));
    let mut read: TokenStream = fields.map(|(k, field)| read_field(&derived.private(), k, field)).collect();
    let scalar = derived.scalar();
    // What varies is in no law.
    let clauses = given.mass_data.unnamed.iter().filter(|value| value.own.is_constant());
    read.extend(
        clauses.map(|ClauseValue { own, .. }| clause_local(&scalar, &local_of_clause(own.quantity), own, symbols)),
    );
    read
}

/// The local of what a clause says.
pub fn local_of_clause(role: Role) -> Ident {
    format_ident!("__given_{}", role.word(), span = Span::mixed_site())
}

/// The local of a field.
fn read_field(private: &TokenStream, k: usize, field: &Field) -> TokenStream {
    let (ident, name) = (&field.ident, local(k, ""));
    match field.shape {
        Shape::Scalar => quote!(let #name = self.#ident;),
        Shape::Vector3 | Shape::Vector6 => quote!(let #name = #private::components(&self.#ident);),
        Shape::Matrix3 | Shape::Matrix6 => quote!(let #name = #private::entries(&self.#ident);),
        Shape::RigidBody | Shape::CentralBody => {
            let [mass, center, inertia] = ["mass", "center_of_mass", "inertia"].map(|part| local(k, part));
            let tensor = if field.shape == Shape::CentralBody { quote!(inertia.0) } else { quote!(inertia) };
            quote! {
                let #mass = self.#ident.mass;
                let #center = #private::components(&self.#ident.center_of_mass);
                let #inertia = #private::entries(&self.#ident.#tensor);
            }
        }
        Shape::Other => TokenStream::new(),
    }
}

/// The local of what a law is about.
pub fn local_of_datum(datum: Datum) -> Ident {
    match datum {
        Datum::Field(field) => local(field, ""),
        Datum::Part(field, role) => local(field, part(role)),
        Datum::Clause(role) => local_of_clause(role),
        Datum::Own(role) => format_ident!("__b{}", role.word(), span = Span::mixed_site()),
    }
}

/// `let name = …;`: the value, or the array of components.
pub fn clause_local(
    scalar: &ScalarTokens<'_>,
    name: &Ident,
    own: &QuantityValues<'_>,
    symbols: &Map<u32, TokenStream>,
) -> TokenStream {
    let (compute, values) = statements(&Program::lower(&own.values), symbols, scalar);
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
