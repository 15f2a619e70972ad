//! Numbers of a file that fields and states can begin with: bodies, postures.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use crate::terms::number::shortest;
use crate::terms::{BodyOfFile, Field, Generics, Item, Scalar, Shape, StateOfFile, ValueOfState};
use crate::words::Unraw;

use crate::emit::constructor::kernel::bound;
use crate::emit::derived::{Derived, KernelGenerics};
use crate::emit::dialect::program::ScalarTokens;
use crate::emit::records::input::input_name;
use crate::emit::records::state::{parts, state_name};

/// `Name::from_file(…)` where fields are bodies of the file, and a function of `NameState` for each state of the file.
pub fn of_file(derived: &Derived<'_, '_>) -> TokenStream {
    let Some(file) = &derived.item().described else { return TokenStream::new() };
    let constructor = (!file.bodies.is_empty()).then(|| constructor(derived, &file.bodies));
    let states = (!file.states.is_empty()).then(|| states(derived, &file.states));
    let inputs = inputs(derived, &file.states);
    quote!(#constructor #states #inputs)
}

/// The struct with the mass data of the file; what it does not say are arguments.
fn constructor(derived: &Derived<'_, '_>, bodies: &[BodyOfFile]) -> TokenStream {
    let Item { ident, visibility, generics, .. } = derived.item();
    let Generics { declared, used, predicates } = generics;
    let bound = bound(derived);
    let of_field = |field: &Field| bodies.iter().find(|body| body.field.unraw() == field.ident.unraw());
    let (own, others): (Vec<&Field>, Vec<&Field>) =
        derived.item().fields.iter().partition(|field| of_field(field).is_some());
    let values = own.iter().filter_map(|field| Some((field, of_field(field)?))).map(|(field, body)| {
        let (name, value) = (&field.ident, body_value(derived, body, field.shape));
        quote!(#name: #value)
    });
    let (names, types) = (others.iter().map(|field| &field.ident), others.iter().map(|field| &field.ty));
    let arguments = names.clone().zip(types).map(|(name, ty)| quote!(#name: #ty));
    let file = derived.item().described.as_ref().map(|file| file.file.clone()).unwrap_or_default();
    let documentation = format!("The bodies as `{file}` has them, with the other fields.");
    quote! {
        #[allow(clippy::all, clippy::pedantic)]
        impl #declared #ident #used where #predicates #bound {
            #[doc = #documentation]
            #[allow(dead_code, clippy::too_many_arguments, clippy::excessive_precision)]
            #visibility fn from_file(#(#arguments),*) -> Self {
                Self { #(#values,)* #(#names),* }
            }
        }
    }
}

fn number(scalar: &ScalarTokens<'_>, value: f64) -> TokenStream {
    match scalar.scalar {
        Scalar::Parameter(_) => scalar.number(&shortest(value)),
        _ => scalar.literal(value),
    }
}

fn body_value(derived: &Derived<'_, '_>, body: &BodyOfFile, shape: Shape) -> TokenStream {
    let (private, runtime) = (derived.private(), &derived.item().runtime);
    let number = |value: f64| number(&derived.scalar(), value);
    let c = body.center;
    let square: f64 = c.iter().map(|c| c * c).sum();
    let central = shape == Shape::CentralBody;
    // I_O = I_G + m (c² − c cᵀ).
    let entry = |i: usize, j: usize| {
        let steiner = if i == j { square - c[i] * c[i] } else { -(c[i] * c[j]) };
        body.inertia[i][j] + if central { 0.0 } else { body.mass * steiner }
    };
    let rows = (0..3).map(|i| {
        let entries = (0..3).map(|j| number(entry(i, j)));
        quote!([#(#entries),*])
    });
    let inertia = quote!(#private::matrix([#(#rows),*]));
    let inertia = if central { quote!(#runtime::system::AboutCenterOfMass(#inertia)) } else { inertia };
    let (mass, center) = (number(body.mass), c.map(number));
    quote! {
        #runtime::system::RigidBody {
            mass: #mass,
            center_of_mass: #private::vector([#(#center),*]),
            inertia: #inertia
        }
    }
}

/// Functions of the state, as its coordinates and speeds are called there.
fn states(derived: &Derived<'_, '_>, states: &[StateOfFile]) -> TokenStream {
    let (name, visibility) = (state_name(derived.item()), &derived.item().visibility);
    let KernelGenerics { bounded, used, .. } = derived.kernel_generics();
    let known: Vec<Ident> = parts(derived).iter().flatten().map(|part| part.ident.clone()).collect();
    let functions = states.iter().map(|state| {
        let values = state.values.iter().filter_map(|(field, value)| {
            // Speeds that constraints determine are none of the state.
            let field = known.iter().find(|known| known.unraw() == field.unraw())?;
            let value = state_value(derived, *value);
            Some(quote!(#field: #value))
        });
        let (function, documentation) = (&state.name, format!("`{}` of the file.", state.written));
        quote! {
            #[doc = #documentation]
            #[allow(clippy::needless_update, clippy::excessive_precision)]
            #visibility fn #function() -> Self {
                Self { #(#values,)* ..::core::default::Default::default() }
            }
        }
    });
    quote! {
        #[allow(clippy::all, clippy::pedantic)]
        #[allow(dead_code, non_snake_case)]
        impl #bounded #name #used { #(#functions)* }
    }
}

/// Functions of the inputs, of the states of the file that have some.
fn inputs(derived: &Derived<'_, '_>, states: &[StateOfFile]) -> Option<TokenStream> {
    let (name, visibility) = (input_name(derived.item()), &derived.item().visibility);
    let KernelGenerics { bounded, used, .. } = derived.kernel_generics();
    let functions = states.iter().filter(|state| !state.inputs.is_empty()).map(|state| {
        let values = state.inputs.iter().map(|(field, value)| {
            let value = number(&derived.scalar(), *value);
            quote!(#field: #value)
        });
        let (function, documentation) = (&state.name, format!("The controls of `{}` of the file.", state.written));
        quote! {
            #[doc = #documentation]
            #[allow(clippy::needless_update, clippy::excessive_precision)]
            #visibility fn #function() -> Self {
                Self { #(#values,)* ..::core::default::Default::default() }
            }
        }
    });
    let functions: Vec<TokenStream> = functions.collect();
    (!functions.is_empty()).then(|| {
        quote! {
            #[allow(clippy::all, clippy::pedantic)]
            #[allow(dead_code, non_snake_case)]
            impl #bounded #name #used { #(#functions)* }
        }
    })
}

fn state_value(derived: &Derived<'_, '_>, value: ValueOfState) -> TokenStream {
    let private = derived.private();
    let number = |value: f64| number(&derived.scalar(), value);
    // (x, y, z, w), of length one.
    let unit = |[w, x, y, z]: [f64; 4]| {
        let length = [w, x, y, z].iter().map(|c| c * c).sum::<f64>().sqrt();
        [x, y, z, w].map(|c| number(c / length))
    };
    match value {
        ValueOfState::Scalar(value) => number(value),
        ValueOfState::Vector(value) => {
            let components = value.map(number);
            quote!(#private::vector([#(#components),*]))
        }
        ValueOfState::Rotation(rotation) => {
            let (zero, components) = (number(0.0), unit(rotation));
            quote!(#private::pose_from_quaternion([#(#components),*], [#zero, #zero, #zero]).rotation)
        }
        ValueOfState::Pose(place, rotation) => {
            let (place, components) = (place.map(number), unit(rotation));
            quote!(#private::pose_from_quaternion([#(#components),*], [#(#place),*]))
        }
    }
}
