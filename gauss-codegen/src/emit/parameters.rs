//! `kernel()`: role fields, rigid bodies and plain parameters read, checked, and turned into constants.

use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote};
use syn::ext::IdentExt;

use crate::algebra::{Expr, Map, Rational};
use crate::kernel::Program;
use crate::mechanics::Matter;
use crate::model::{ExpressionKind, Field, Model, Motion, Role, Shape};
use crate::translate::{Part, Source};

use super::assigned::{assigned_bodies, assigned_local, fluid};
use super::derived::Derived;
use super::inertia::{inertia_rows, of_body};
use super::program::statements;
use super::subject::Subject;

/// The local that holds a field, or one part of a rigid body.
fn local(field: usize, part: &str) -> Ident {
    format_ident!("__f{}{}", field, part, span = Span::mixed_site())
}

/// The word of a part of a rigid body: the field of `RigidBody` and the end of the local.
fn word(quantity: Role) -> &'static str {
    match quantity {
        Role::Mass => "mass",
        Role::CenterOfMass => "center_of_mass",
        _ => "inertia",
    }
}

/// How the value of a symbol is written where the locals are.
pub fn element(source: &Source<'_>) -> TokenStream {
    let plain = local(source.field, "");
    match source.part {
        Part::Scalar => quote!(#plain),
        Part::Component(i) => quote!(#plain[#i]),
        Part::Entry(i, j) => quote!(#plain[#i][#j]),
        Part::Body(quantity, i, j) => {
            let name = local(source.field, word(quantity));
            match quantity {
                Role::Mass => quote!(#name),
                Role::CenterOfMass => quote!(#name[#i]),
                _ => quote!(#name[#i][#j]),
            }
        }
    }
}

/// The body of `kernel()`.
pub fn kernel_body(derived: &Derived<'_, '_>) -> TokenStream {
    let subject = &derived.subject;
    let Subject { model, system, sources, .. } = subject;
    let private = derived.private();
    let ty = derived.scalar().ty();
    let mut read = TokenStream::new();
    let mut checks = TokenStream::new();
    let mut symbols: Map<u32, TokenStream> = sources.iter().map(|s| (s.symbol.key(), element(s))).collect();
    let scalar = derived.scalar();
    symbols.extend(subject.literals.iter().map(|(value, symbol)| (symbol.key(), scalar.number(value))));
    let assigned = model.given.iter().zip(&subject.assigned);
    let assigned =
        assigned.map(|(given, value)| assigned_local(derived, &local_of_clause(given.role), value, &symbols));
    let assigned: TokenStream = assigned.collect();
    for (k, field) in model.fields.iter().enumerate() {
        if !sources.iter().any(|s| s.field == k) {
            continue;
        }
        let (ident, name, said) = (&field.ident, local(k, ""), field.ident.unraw().to_string());
        match field.shape {
            Shape::Scalar | Shape::Vector3 | Shape::Vector6 | Shape::Matrix3 | Shape::Matrix6 => {
                read.extend(read_field(derived, k, field));
            }
            Shape::RigidBody | Shape::CentralBody => {
                let [mass, center, inertia] = ["mass", "center_of_mass", "inertia"].map(|part| local(k, part));
                read.extend(quote! {
                    let #mass = self.#ident.mass;
                    let #center = #private::components(&self.#ident.center_of_mass);
                });
                let tensor = match field.shape {
                    Shape::CentralBody => quote!(inertia.0),
                    _ => quote!(inertia),
                };
                read.extend(quote!(let #inertia = #private::entries(&self.#ident.#tensor);));
                let [said_mass, said_center, said_inertia] =
                    ["mass", "center_of_mass", "inertia"].map(|part| format!("{said}.{part}"));
                checks.extend(quote! {
                    __check.mass(#said_mass, #mass);
                    __check.finite(#said_center, &#center);
                });
                let central = field.shape == Shape::CentralBody;
                checks.extend(of_body(derived, Some(ident), &said_inertia, [&mass, &center, &inertia], central));
            }
            Shape::Other => {}
        }
        checks.extend(match (field.role, field.shape) {
            (_, Shape::RigidBody | Shape::CentralBody | Shape::Other) => TokenStream::new(),
            (Some(role), shape) => role_check(derived, model, role, shape, &said, &name),
            _ => finite(derived, k, field),
        });
    }
    for given in &model.given {
        let (said, name) = (given.role.word(), local_of_clause(given.role));
        checks.extend(role_check(derived, model, given.role, given.shape, said, &name));
    }
    checks.extend(fluid(derived, &symbols));
    checks.extend(kinetic_matrix(derived, &symbols));
    read.extend(assigned);
    checks.extend(assigned_bodies(derived, &symbols));
    let particles = system.scene.tree.links.iter().filter_map(|link| match link.matter {
        Matter::Particle(mass) => Some(mass),
        _ => None,
    });
    for (clause, mass) in model.particles.iter().zip(particles) {
        let said = match &clause.mass.kind {
            ExpressionKind::Name(name) => name.unraw().to_string(),
            _ => "particle(mass = …)".to_owned(),
        };
        let (compute, mass) = evaluate(derived, &symbols, mass);
        checks.extend(quote!({ #compute __check.mass(#said, #mass); }));
    }
    // The first field that the equations read speaks for all of them.
    let said = sources.first().map(|s| model.fields[s.field].ident.unraw().to_string()).unwrap_or_default();
    let kernel = constants(derived, &symbols, &said);
    quote! {
        #read
        let mut __check = #private::ParameterCheck::<#ty>::new();
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

/// The local of what a clause says.
fn local_of_clause(role: Role) -> Ident {
    format_ident!("__given_{}", role.word(), span = Span::mixed_site())
}

/// What must hold of mass data and gravity, from fields or clauses.
fn role_check(
    derived: &Derived<'_, '_>,
    model: &Model,
    role: Role,
    shape: Shape,
    said: &str,
    name: &Ident,
) -> TokenStream {
    match (role, shape) {
        (Role::Mass, _) => quote!(__check.mass(#said, #name);),
        (Role::DisplacedMass, _) => quote!(__check.non_negative(#said, #name);),
        (Role::Inertia | Role::CentralInertia, shape) => {
            let rows = inertia_rows(&derived.scalar().ty(), derived, shape, name);
            let checks = match model.in_chart.map(|own| own.motion) {
                // In the plane only the moment about k₃ enters.
                Some(Motion::Planar) => {
                    let zero = derived.scalar().number(&Rational::zero());
                    quote!({
                        let __moment = __inertia[2usize][2usize];
                        __check.inertia(#said, &[
                            [__moment, #zero, #zero], [#zero, __moment, #zero], [#zero, #zero, __moment],
                        ]);
                        for __row in &__inertia {
                            __check.finite(#said, __row);
                        }
                    })
                }
                _ if role == Role::CentralInertia => {
                    let (mass, zero) = (local_of(model, Role::Mass), derived.scalar().number(&Rational::zero()));
                    quote!(__check.central_inertia(#said, #mass, [#zero; 3], &__inertia);)
                }
                _ => {
                    let about_center = central_inertia(model, said);
                    quote!(__check.inertia(#said, &__inertia); #about_center)
                }
            };
            quote!({
                let __inertia = #rows;
                #checks
            })
        }
        (Role::AddedMass, Shape::Matrix6) => quote!(__check.symmetric(#said, &#name);),
        _ => finite_value(shape, said, name),
    }
}

/// The local of a field.
fn read_field(derived: &Derived<'_, '_>, k: usize, field: &Field) -> TokenStream {
    let (private, ident, name) = (derived.private(), &field.ident, local(k, ""));
    match field.shape {
        Shape::Scalar => quote!(let #name = self.#ident;),
        Shape::Vector3 | Shape::Vector6 => quote!(let #name = #private::components(&self.#ident);),
        _ => quote!(let #name = #private::entries(&self.#ident);),
    }
}

/// What must hold of a field without a role.
fn finite(derived: &Derived<'_, '_>, k: usize, field: &Field) -> TokenStream {
    let (said, name) = (field.ident.unraw().to_string(), local(k, ""));
    if field.shape == Shape::Matrix6 && derived.subject.model.is_added_mass(&field.ident) {
        return quote!(__check.symmetric(#said, &#name););
    }
    finite_value(field.shape, &said, &name)
}

fn finite_value(shape: Shape, said: &str, name: &Ident) -> TokenStream {
    match shape {
        Shape::Scalar => quote!(__check.finite(#said, &[#name]);),
        Shape::Vector3 | Shape::Vector6 => quote!(__check.finite(#said, &#name);),
        _ => quote!(for __row in &#name { __check.finite(#said, __row); }),
    }
}

/// `warnings()`: what is likely not meant; only of scenes with drag.
pub fn warnings(derived: &Derived<'_, '_>) -> TokenStream {
    let drags = &derived.drags;
    if drags.is_empty() {
        return TokenStream::new();
    }
    let Subject { model, sources, literals, .. } = &derived.subject;
    let (private, ty) = (derived.private(), derived.scalar().ty());
    let (visibility, scalar) = (derived.item().visibility, derived.scalar());
    let is_read = |k: usize| sources.iter().any(|s| s.field == k);
    let read = model.fields.iter().enumerate().filter(|(k, f)| !f.shape.is_body() && is_read(*k));
    let read = read.map(|(k, field)| read_field(derived, k, field));
    let mut symbols: Map<u32, TokenStream> = sources.iter().map(|s| (s.symbol.key(), element(s))).collect();
    symbols.extend(literals.iter().map(|(value, symbol)| (symbol.key(), scalar.number(value))));
    let checks = drags.iter().filter_map(|drag| {
        let program = Program::lower(&drag.entries.concat());
        // Coefficients that depend on the state are no matrix that could be judged here.
        if !program.symbols().iter().all(|s| symbols.contains_key(&s.key())) {
            return None;
        }
        let (compute, outputs) = statements(&program, &symbols, &scalar);
        let rows = outputs.chunks(6).map(|row| quote!([#(#row),*]));
        let (said, kind) = (&drag.said, if drag.quadratic { quote!(Quadratic) } else { quote!(Linear) });
        Some(quote!({
            #compute
            __warnings.drag(#said, #private::DragKind::#kind, &[#(#rows),*]);
        }))
    });
    quote! {
        /// What is likely not meant, although a kernel can be made of it: drag that feeds energy, with its eigenvalue.
        #[allow(unused_variables, dead_code)]
        #visibility fn warnings(&self) -> #private::ParameterWarnings {
            #(#read)*
            let mut __warnings = #private::WarningCheck::<#ty>::new();
            #(#checks)*
            __warnings.finish()
        }
    }
}

fn evaluate(derived: &Derived<'_, '_>, symbols: &Map<u32, TokenStream>, e: Expr<'_>) -> (TokenStream, TokenStream) {
    let (compute, outputs) = statements(&Program::lower(&[e]), symbols, &derived.scalar());
    (compute, quote!(#(#outputs)*))
}

/// The local of what plays a role of the body without a name.
fn local_of(model: &Model, role: Role) -> Option<Ident> {
    let field = model.fields.iter().position(|f| f.role == Some(role)).map(|k| local(k, ""));
    field.or_else(|| model.given.iter().any(|given| given.role == role).then(|| local_of_clause(role)))
}

/// The matrix of the kinetic energy of the body without a name, on the axes of its motion: with a centre of mass off O its parts can be
/// fine one by one, and not together.
fn kinetic_matrix(derived: &Derived<'_, '_>, symbols: &Map<u32, TokenStream>) -> Option<TokenStream> {
    let Subject { model, system, links, .. } = &derived.subject;
    let clause = model.bodies.iter().position(|body| body.name.is_none())?;
    let free = system.free.iter().find(|free| free.link == links[clause])?;
    let active = &free.kinematics.active;
    let fluid = system.scene.tree.links[free.link].body()?.added_mass.is_some();
    // About the centre of mass no part speaks against another.
    let alone = model.shape(Role::CenterOfMass).is_none() || model.shape(Role::CentralInertia).is_some();
    if fluid || active.iter().all(|&k| k >= 3) || alone {
        return None;
    }
    let role = Role::Inertia;
    let said = model.field(role).map_or_else(|| role.word().to_owned(), |field| field.ident.unraw().to_string());
    let entries = active.iter().flat_map(|&i| active.iter().map(move |&j| (i, j)));
    let entries: Vec<Expr<'_>> = entries.map(|(i, j)| free.matrix.entries[i][j]).collect();
    let (compute, outputs) = statements(&Program::lower(&entries), symbols, &derived.scalar());
    let rows = outputs.chunks(active.len()).map(|row| quote!([#(#row),*]));
    Some(quote!({
        #compute
        __check.kinetic_matrix(#said, &[#(#rows),*]);
    }))
}

/// What is left about the centre of mass must be an inertia too, unless O is held at Ω: only m·c and I_O enter then, and m
/// by itself says nothing.
fn central_inertia(model: &Model, said: &str) -> TokenStream {
    let moves = match model.in_chart {
        Some(own) => own.motion == Motion::Free,
        None => model.bodies.iter().any(|body| body.position.is_some()),
    };
    match (local_of(model, Role::Mass), local_of(model, Role::CenterOfMass)) {
        (Some(mass), Some(center)) if moves => {
            quote!(__check.central_inertia(#said, #mass, #center, &__inertia);)
        }
        _ => TokenStream::new(),
    }
}
