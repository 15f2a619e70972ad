//! `kernel()`: role fields, rigid bodies and plain parameters checked, and turned into constants.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use crate::algebra::{Expr, Map, Rational};
use crate::kernel::Program;
use crate::terms::{Field, Role, Shape};
use crate::words::Unraw;

use super::derived::{Derived, KernelGenerics};
use super::inertia::{in_sum, inertia_rows, named_body, own_matrix, waived};
use super::laws;
use super::locals::{is_read, local, local_of, local_of_clause, parameters_read, symbols_of_parameters};
use super::program::statements;
use super::role_clauses::{body_clauses, fluid};
use super::subject::Subject;

/// The body of `kernel()`.
pub fn kernel_body(derived: &Derived<'_, '_>) -> TokenStream {
    let given = derived.subject.given;
    let (private, ty) = (derived.private(), derived.scalar().ty());
    let symbols = symbols_of_parameters(derived);
    let read = parameters_read(derived, &symbols);
    let fields = given.item.fields.iter().enumerate().filter(|(k, _)| is_read(derived, *k));
    let mut checks: TokenStream = fields.map(|(k, field)| field_check(derived, k, field)).collect();
    checks.extend(given.mass_data.unnamed.iter().map(|value| {
        let role = value.own.quantity;
        role_check(derived, role, value.shape, role.word(), &local_of_clause(role))
    }));
    checks.extend(body_clauses(derived, &symbols));
    checks.extend(laws::masses(derived, &symbols));
    checks.extend(fluid(derived, &symbols));
    checks.extend(kinetic_matrix(derived, &symbols));
    checks.extend(laws::checked(derived, &symbols));
    // The first field that the equations read speaks for all of them.
    let label = given.sources.first().map(|s| given.item.fields[s.field].ident.unraw().to_string()).unwrap_or_default();
    let kernel = constants(derived, &symbols, &label);
    quote! {
        #read
        let mut __check = #private::ParameterCheck::<#ty>::new();
        #checks
        __check.finish()?;
        #kernel
    }
}

/// What must hold of a field.
fn field_check(derived: &Derived<'_, '_>, k: usize, field: &Field) -> TokenStream {
    match (field.role, field.shape) {
        (_, Shape::Other) => TokenStream::new(),
        (_, Shape::RigidBody | Shape::CentralBody) => {
            let [mass, center, inertia] = ["mass", "center_of_mass", "inertia"].map(|part| local(k, part));
            let central = field.shape == Shape::CentralBody;
            named_body(derived, &field.ident, "inertia", [&mass, &center, &inertia], central)
        }
        (Some(role), shape) => role_check(derived, role, shape, &field.ident.unraw().to_string(), &local(k, "")),
        _ => finite(derived, k, field),
    }
}

/// The constants computed and checked: together, parameters that are fine one by one can overflow. `label` is the field
/// that speaks for them.
pub fn constants(derived: &Derived<'_, '_>, symbols: &Map<u32, TokenStream>, label: &str) -> TokenStream {
    let (compute, outputs) = statements(&derived.kernel.constants, symbols, &derived.scalar());
    let sum = sum(derived);
    let (name, fields) = (derived.kernel_name(), derived.constant_fields());
    let rows = derived.rows(&outputs).into_iter();
    quote! {
        #compute
        let __kernel = #name { #(#fields: #outputs,)* #(#rows)* };
        #sum
        __check.constants(#label, &[#(__kernel.#fields),*]);
        __check.finish()?;
        ::core::result::Result::Ok(__kernel)
    }
}

/// Bodies some of which have no mass have a mass matrix all the same; where there is one body alone that is checked of
/// it.
fn sum(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    if derived.subject.system.scene.chart().is_some() {
        return None;
    }
    let (private, kernel) = (derived.private(), derived.kernel_name());
    let KernelGenerics { used, .. } = derived.kernel_generics();
    let system = quote!(<#kernel #used as #private::GaussSystem>);
    Some(quote! {
        if __check.massless().is_some() {
            let __matrix = |__q| #private::entries(&#system::mass_matrix(&__kernel, #private::sample_time(), &__q));
            __check.regular(&#private::samples::<#system::Configuration>().map(__matrix));
        }
    })
}

/// What must hold of mass data and gravity, from fields or clauses.
fn role_check(derived: &Derived<'_, '_>, role: Role, shape: Shape, label: &str, name: &Ident) -> TokenStream {
    match (role, shape) {
        (Role::Mass, _) if derived.subject.system.scene.chart().is_some() => quote!(__check.mass(#label, #name);),
        (Role::Mass, _) => quote!(__check.mass_in_sum(#label, #name);),
        (Role::DisplacedMass, _) => quote!(__check.non_negative(#label, #name);),
        (Role::Inertia | Role::CentralInertia, shape) => {
            let rows = inertia_rows(&derived.scalar().ty(), derived, shape, name);
            let checks = inertia_check(derived, role, label);
            quote!({
                let __inertia = #rows;
                #checks
            })
        }
        (Role::AddedMass, Shape::Matrix6) => quote!(__check.symmetric(#label, &#name);),
        _ => finite_value(shape, label, name),
    }
}

/// What must hold of the inertia of the body without a name, which is `__inertia`.
fn inertia_check(derived: &Derived<'_, '_>, role: Role, label: &str) -> TokenStream {
    let zero = derived.scalar().number(&Rational::zero());
    let local = |role: Role| local_of(derived.subject.given, role).map(|name| quote!(#name));
    let (scene, link) = (&derived.subject.system.scene, derived.subject.link(None));
    // Where O is held at Ω only m·c and I_O enter, and m by itself says nothing.
    let held = link.is_some_and(|link| scene.is_held(link));
    let mass = local(Role::Mass).filter(|_| !held).unwrap_or_else(|| zero.clone());
    let central = role == Role::CentralInertia;
    let center = local(Role::CenterOfMass).filter(|_| !held && !central).unwrap_or_else(|| quote!([#zero; 3]));
    if scene.chart().is_none() {
        return in_sum(derived, None, label, [&mass, &center, &quote!(__inertia)]);
    }
    let twist = link.map(|link| scene.twist_of(link)).unwrap_or_default();
    let checks = match twist.as_slice() {
        // In the plane only the moment about k₃ enters, but all that is given is that of a body.
        [0, 1, 5] => quote! {
            let __moment = __inertia[2usize][2usize];
            __check.inertia(#label, &[[__moment, #zero, #zero], [#zero, __moment, #zero], [#zero, #zero, __moment]]);
            __check.inertia_about_axis(#label, 2usize, (#mass, #center), &__inertia);
        },
        _ if central => {
            let mass = local(Role::Mass);
            quote!(__check.central_inertia(#label, #mass, [#zero; 3], &__inertia);)
        }
        _ if !held && local(Role::CenterOfMass).is_some() => quote! {
            __check.inertia(#label, &__inertia);
            __check.central_inertia(#label, #mass, #center, &__inertia);
        },
        _ => quote!(__check.inertia(#label, &__inertia);),
    };
    waived(derived, None, checks)
}

/// What must hold of a field without a role.
fn finite(derived: &Derived<'_, '_>, k: usize, field: &Field) -> TokenStream {
    let (label, name) = (field.ident.unraw().to_string(), local(k, ""));
    if field.shape == Shape::Matrix6 && derived.subject.given.mass_data.added_masses.contains(&k) {
        return quote!(__check.symmetric(#label, &#name););
    }
    finite_value(field.shape, &label, &name)
}

fn finite_value(shape: Shape, label: &str, name: &Ident) -> TokenStream {
    match shape {
        Shape::Scalar => quote!(__check.finite(#label, &[#name]);),
        Shape::Vector3 | Shape::Vector6 => quote!(__check.finite(#label, &#name);),
        _ => quote!(for __row in &#name { __check.finite(#label, __row); }),
    }
}

/// The matrix of the kinetic energy of the body without a name, on the axes of its motion: with a centre of mass off O
/// its parts can be fine one by one, and not together.
fn kinetic_matrix(derived: &Derived<'_, '_>, symbols: &Map<u32, TokenStream>) -> Option<TokenStream> {
    let Subject { given, system, .. } = &derived.subject;
    let link = derived.subject.link(None)?;
    let free = system.free.iter().find(|free| free.link == link)?;
    let active = &free.kinematics.active;
    let fluid = system.scene.tree.links[free.link].body()?.added_mass.is_some();
    // About the centre of mass no part speaks against another.
    let alone = given.shape(Role::CenterOfMass).is_none() || given.shape(Role::CentralInertia).is_some();
    if fluid || active.iter().all(|&k| k >= 3) || alone {
        return None;
    }
    let role = Role::Inertia;
    let label = given.item.field(role).map_or_else(|| role.word().to_owned(), |field| field.ident.unraw().to_string());
    let entries = active.iter().flat_map(|&i| active.iter().map(move |&j| (i, j)));
    let entries: Vec<Expr<'_>> = entries.map(|(i, j)| free.matrix.entries[i][j]).collect();
    let (compute, outputs) = statements(&Program::lower(&entries), symbols, &derived.scalar());
    let rows = outputs.chunks(active.len()).map(|row| quote!([#(#row),*]));
    Some(own_matrix(
        derived,
        quote!({
            #compute
            __check.kinetic_matrix(#label, &[#(#rows),*]);
        }),
    ))
}
