//! `kernel()` of a system: role fields, rigid bodies and plain parameters read, checked, and turned into constants.

use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote};
use syn::ext::IdentExt;

use crate::algebra::{Expr, Map};
use crate::kernel::Program;
use crate::mechanics::{Matter, Quantity};
use crate::model::{ExpressionKind, Field, Model, Motion, Role, Shape};
use crate::translate::{DragMatrix, Part, Source};

use super::assigned::{assigned_bodies, assigned_local, fluid};
use super::derived::{Derived, Plain};
use super::parameters::constants;
use super::program::statements;
use super::system::SystemSubject;

/// The local that holds a field, or one part of a rigid body.
fn local(field: usize, part: &str) -> Ident {
    format_ident!("__f{}{}", field, part, span = Span::mixed_site())
}

/// The word of a part of a rigid body: the field of `RigidBody` and the end of the local.
fn word(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Mass => "mass",
        Quantity::CenterOfMass => "center_of_mass",
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
                Quantity::Mass => quote!(#name),
                Quantity::CenterOfMass => quote!(#name[#i]),
                _ => quote!(#name[#i][#j]),
            }
        }
    }
}

/// The body of `kernel()`.
pub fn system_kernel_body(derived: &Derived<'_, '_>, subject: &SystemSubject<'_, '_>) -> TokenStream {
    let SystemSubject { model, system, sources, .. } = *subject;
    let private = derived.private();
    let ty = derived.scalar().ty();
    let mut read = TokenStream::new();
    let mut checks = TokenStream::new();
    let mut symbols: Map<u32, TokenStream> = sources.iter().map(|s| (s.symbol.key(), element(s))).collect();
    let scalar = derived.scalar();
    symbols.extend(subject.literals.iter().map(|(value, symbol)| (symbol.key(), scalar.number(value))));
    let assigned = model.given.iter().zip(subject.assigned);
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
            Shape::RigidBody => {
                let [mass, center, inertia] = ["mass", "center_of_mass", "inertia"].map(|part| local(k, part));
                read.extend(quote! {
                    let #mass = self.#ident.mass;
                    let #center = #private::components(&self.#ident.center_of_mass);
                    let #inertia = #private::entries(&self.#ident.inertia);
                });
                let [said_mass, said_center, said_inertia] =
                    ["mass", "center_of_mass", "inertia"].map(|part| format!("{said}.{part}"));
                checks.extend(quote! {
                    __check.mass(#said_mass, #mass);
                    __check.finite(#said_center, &#center);
                });
                checks.extend(match subject.only_axis(Some(ident)) {
                    Some(axis) => in_plane(derived, axis, &said_inertia, [&mass, &center, &inertia]),
                    None => quote! {
                        __check.inertia(#said_inertia, &#inertia);
                        __check.central_inertia(#said_inertia, #mass, #center, &#inertia);
                    },
                });
            }
            Shape::Other => {}
        }
        checks.extend(match (field.role, field.shape) {
            (_, Shape::RigidBody | Shape::Other) => TokenStream::new(),
            (Some(role), shape) => role_check(derived, model, role, shape, &said, &name),
            _ => finite(derived, k, field),
        });
    }
    for given in &model.given {
        let (said, name) = (given.role.word(), local_of_clause(given.role));
        checks.extend(role_check(derived, model, given.role, given.shape, said, &name));
    }
    read.extend(assigned);
    checks.extend(assigned_bodies(derived, subject, &symbols));
    checks.extend(fluid(derived, subject, &symbols));
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
        (Role::Inertia, shape) => {
            let rows = inertia_rows(&derived.scalar().ty(), derived, shape, name);
            let checks = match model.in_chart.map(|own| own.motion) {
                Some(Motion::Planar) => moment_in_plane(derived, model, said),
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
    if field.shape == Shape::Matrix6 && derived.model().is_added_mass(&field.ident) {
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

/// Plain parameters of one body in a chart: their locals, and what is checked of them.
pub fn plain_fields(derived: &Derived<'_, '_>, fields: &[Field], sources: &[Source<'_>]) -> (TokenStream, TokenStream) {
    let plain = fields.iter().enumerate().filter(|(k, f)| f.role.is_none() && sources.iter().any(|s| s.field == *k));
    plain.map(|(k, field)| (read_field(derived, k, field), finite(derived, k, field))).unzip()
}

/// `warnings()`: what is likely not meant; only of scenes with drag.
pub fn warnings(derived: &Derived<'_, '_>, plain: &Plain<'_, '_>, drags: &[DragMatrix<'_>]) -> TokenStream {
    if drags.is_empty() {
        return TokenStream::new();
    }
    let Plain { fields, sources, literals, .. } = plain;
    let (private, runtime, ty) = (derived.private(), derived.item().runtime, derived.scalar().ty());
    let (visibility, scalar) = (derived.item().visibility, derived.scalar());
    let is_read = |k: usize| sources.iter().any(|s| s.field == k);
    let read = fields.iter().enumerate().filter(|(k, f)| f.shape != Shape::RigidBody && is_read(*k));
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
        #visibility fn warnings(&self) -> #runtime::error::ParameterWarnings {
            #(#read)*
            let mut __warnings = #private::WarningCheck::<#ty>::new();
            #(#checks)*
            __warnings.finish()
        }
    }
}

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

fn evaluate(derived: &Derived<'_, '_>, symbols: &Map<u32, TokenStream>, e: Expr<'_>) -> (TokenStream, TokenStream) {
    let (compute, outputs) = statements(&Program::lower(&[e]), symbols, &derived.scalar());
    (compute, quote!(#(#outputs)*))
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

/// The local of what plays a role of the body without a name.
fn local_of(model: &Model, role: Role) -> Option<Ident> {
    let field = model.fields.iter().position(|f| f.role == Some(role)).map(|k| local(k, ""));
    field.or_else(|| model.given.iter().any(|given| given.role == role).then(|| local_of_clause(role)))
}

/// Of a body in the plane k₁k₂ the moment about k₃ and the centre of mass in the plane.
fn moment_in_plane(derived: &Derived<'_, '_>, model: &Model, said: &str) -> TokenStream {
    let (ty, real) = (derived.scalar().ty(), derived.scalar().real);
    let Some(mass) = local_of(model, Role::Mass) else { return TokenStream::new() };
    let center = local_of(model, Role::CenterOfMass)
        .map_or_else(|| quote!([<#ty as #real>::zero(); 3]), |center| quote!(#center));
    let [center_of_mass, inertia] = ["__center", "__inertia"].map(|name| format_ident!("{name}"));
    let checks = in_plane(derived, 2, said, [&mass, &center_of_mass, &inertia]);
    quote!(let #center_of_mass = #center; #checks)
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
