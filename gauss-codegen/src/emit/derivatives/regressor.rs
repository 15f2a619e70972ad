//! `InertialRegressor`: the forces of inertia as a linear function of inertial parameters.

use proc_macro2::TokenStream;
use quote::quote;

use crate::kernel::Derivative;
use crate::methods::{DerivativeKind, Method};

use crate::emit::derivatives::linearized::{columns, pattern};
use crate::emit::derived::Derived;
use crate::emit::dialect::arguments::{OF_REGRESSOR, arguments_of};

/// The regressor, where it is wanted.
pub fn inertial_regressor(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    let Derivative { program, .. } = derived.kernel.derivative(DerivativeKind::Regressor)?;
    let (private, ty) = (derived.private(), derived.scalar().ty());
    let (rates, count) = (derived.degrees_of_freedom(), derived.inertial_parameters.len());
    let names = derived.inertial_parameters.iter().map(|parameter| &parameter.name);
    let (instructions, outputs) = derived.computed(program);
    let (matrix, pattern) = (columns(&outputs, rates, 0..count), pattern(program, rates, 0..count));
    let (parameters, forces) =
        (derived.method_body(Method::InertialParameters)?, derived.method_body(Method::OtherForces)?);
    let body = quote!(#instructions #private::columns([#(#matrix),*]));
    let regressor = derived.function_of("regressor", OF_REGRESSOR, quote!(Self::Regressor), body);
    let of_forces = arguments_of(Method::OtherForces);
    let other_forces = derived.function_of("other_forces", of_forces, quote!(Self::Speeds), forces);
    let items = quote! {
        type Regressor = #private::SMatrix<#ty, #rates, #count>;
        type InertialParameters = #private::SVector<#ty, #count>;
        const INERTIAL_PARAMETERS: &'static [&'static ::core::primitive::str] = &[#(#names),*];
        const REGRESSOR_PATTERN: &'static [&'static [::core::primitive::bool]] = &[#(#pattern),*];
        #regressor
        fn inertial_parameters(&self) -> Self::InertialParameters {
            #parameters
        }
        #other_forces
    };
    Some(derived.implementation(quote!(InertialRegressor), items))
}
