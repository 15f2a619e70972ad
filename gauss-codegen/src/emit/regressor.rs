//! `InertialRegressor`: the forces of inertia as a linear function of inertial parameters.

use proc_macro2::TokenStream;
use quote::quote;

use crate::mechanics::Method;

use super::arguments::{OF_REGRESSOR, arguments_of, declared};
use super::derived::Derived;
use super::linearized::{pattern, rows};

/// The regressor, where it is asked for.
pub fn inertial_regressor(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    let (regressor, program) = derived.regressor.zip(derived.kernel.regressor.as_ref())?;
    let (private, ty) = (derived.private(), derived.scalar().ty());
    let (rates, count) = (derived.degrees_of_freedom(), regressor.parameters.len());
    let names = regressor.parameters.iter().map(|parameter| &parameter.name);
    let arguments = declared(&private, OF_REGRESSOR);
    let of_forces = declared(&private, arguments_of(Method::OtherForces));
    let (instructions, outputs) = derived.computed(program);
    let (matrix, pattern) = (rows(&outputs, rates, 0..count), pattern(program, rates, 0..count));
    let (parameters, forces) =
        (derived.method_body(Method::InertialParameters), derived.method_body(Method::OtherForces));
    let items = quote! {
            type Regressor = #private::SMatrix<#ty, #rates, #count>;
            type InertialParameters = #private::SVector<#ty, #count>;
            const INERTIAL_PARAMETERS: &'static [&'static ::core::primitive::str] = &[#(#names),*];
            const REGRESSOR_PATTERN: &'static [&'static [::core::primitive::bool]] = &[#(#pattern),*];
            fn regressor(
                &self,
                __t: Self::Scalar,
                __q: &Self::Configuration,
                #(#arguments,)*
            ) -> Self::Regressor {
                #instructions
                #private::matrix([#(#matrix),*])
            }
            fn inertial_parameters(&self) -> Self::InertialParameters {
                #parameters
            }
            fn other_forces(
                &self,
                __t: Self::Scalar,
                __q: &Self::Configuration,
                #(#of_forces,)*
            ) -> Self::Speeds {
                #forces
            }
    };
    Some(derived.implementation(quote!(InertialRegressor), items))
}
