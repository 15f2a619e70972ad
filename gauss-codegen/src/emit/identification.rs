//! `ParametricSystem` and `InertialRegressor` of the kernel: what identification of parameters needs of the equations.

use proc_macro2::TokenStream;
use quote::quote;

use crate::mechanics::Method;

use super::kernel::{Derived, Item, count_tokens};
use super::linearize::{pattern, rows};

/// The derivatives by parameters, where they are asked for. `head` is `impl<…>`, `name` the kernel with its generics.
pub fn parametric_system(derived: &Derived<'_, '_>, head: &TokenStream, name: &TokenStream) -> Option<TokenStream> {
    let (linearization, program) = derived.linearization.zip(derived.kernel.by_parameters.as_ref())?;
    let Item { runtime, .. } = derived.item();
    let (private, ty) = (derived.private(), derived.scalar().ty());
    let (states, count) = (linearization.increments + linearization.speeds, derived.parameters.len());
    let names = derived.parameters.iter().map(|parameter| &parameter.name);
    let (instructions, outputs) = derived.computed(program);
    let (matrix, pattern) = (rows(&outputs, states, 0..count), pattern(program, states, 0..count));
    let operations = count_tokens(runtime, program.counts());
    Some(quote! {
        #[automatically_derived]
        #[allow(unused_variables, clippy::all, clippy::pedantic)]
        #head #runtime::identification::ParametricSystem for #name {
            type ByParameters = #runtime::prelude::SMatrix<#ty, #states, #count>;
            const PARAMETERS: &'static [&'static ::core::primitive::str] = &[#(#names),*];
            const PARAMETER_PATTERN: &'static [&'static [::core::primitive::bool]] = &[#(#pattern),*];
            const BY_PARAMETERS_OPERATIONS: #runtime::system::OperationCount = #operations;
            fn by_parameters(
                &self,
                t: Self::Scalar,
                q: &Self::Configuration,
                z: &Self::Speeds,
                input: &Self::Input,
            ) -> Self::ByParameters {
                #instructions
                #private::matrix([#(#matrix),*])
            }
        }
    })
}

/// The regressor, where it is asked for.
pub fn inertial_regressor(derived: &Derived<'_, '_>, head: &TokenStream, name: &TokenStream) -> Option<TokenStream> {
    let (regressor, program) = derived.regressor.zip(derived.kernel.regressor.as_ref())?;
    let Item { runtime, .. } = derived.item();
    let (private, ty) = (derived.private(), derived.scalar().ty());
    let (rates, count) = (derived.degrees_of_freedom(), regressor.parameters.len());
    let names = regressor.parameters.iter().map(|parameter| &parameter.name);
    let (instructions, outputs) = derived.computed(program);
    let (matrix, pattern) = (rows(&outputs, rates, 0..count), pattern(program, rates, 0..count));
    let operations = count_tokens(runtime, program.counts());
    let (parameters, forces) =
        (derived.method_body(Method::InertialParameters), derived.method_body(Method::OtherForces));
    Some(quote! {
        #[automatically_derived]
        #[allow(unused_variables, clippy::all, clippy::pedantic)]
        #head #runtime::identification::InertialRegressor for #name {
            type Regressor = #runtime::prelude::SMatrix<#ty, #rates, #count>;
            type InertialParameters = #runtime::prelude::SVector<#ty, #count>;
            const INERTIAL_PARAMETERS: &'static [&'static ::core::primitive::str] = &[#(#names),*];
            const REGRESSOR_PATTERN: &'static [&'static [::core::primitive::bool]] = &[#(#pattern),*];
            const REGRESSOR_OPERATIONS: #runtime::system::OperationCount = #operations;
            fn regressor(
                &self,
                t: Self::Scalar,
                q: &Self::Configuration,
                z: &Self::Speeds,
                acceleration: &Self::Speeds,
            ) -> Self::Regressor {
                #instructions
                #private::matrix([#(#matrix),*])
            }
            fn inertial_parameters(&self) -> Self::InertialParameters {
                #parameters
            }
            fn other_forces(
                &self,
                t: Self::Scalar,
                q: &Self::Configuration,
                z: &Self::Speeds,
                acceleration: &Self::Speeds,
                input: &Self::Input,
            ) -> Self::Speeds {
                #forces
            }
        }
    })
}
