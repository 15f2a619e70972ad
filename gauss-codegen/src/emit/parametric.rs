//! `ParametricSystem`: the derivatives of the equations by parameters.

use proc_macro2::TokenStream;
use quote::quote;

use super::arguments::{OF_EQUATIONS, declared};
use super::derived::Derived;
use super::linearized::{pattern, rows};

/// The derivatives by parameters, where they are asked for.
pub fn parametric_system(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    let (linearization, program) = derived.linearization.zip(derived.kernel.by_parameters.as_ref())?;
    let (private, ty) = (derived.private(), derived.scalar().ty());
    let (states, count) = (linearization.increments + linearization.speeds, derived.parameters.len());
    let names = derived.parameters.iter().map(|parameter| &parameter.name);
    let arguments = declared(&private, OF_EQUATIONS);
    let (instructions, outputs) = derived.computed(program);
    let (matrix, pattern) = (rows(&outputs, states, 0..count), pattern(program, states, 0..count));
    let items = quote! {
            type ByParameters = #private::SMatrix<#ty, #states, #count>;
            const PARAMETERS: &'static [&'static ::core::primitive::str] = &[#(#names),*];
            const PARAMETER_PATTERN: &'static [&'static [::core::primitive::bool]] = &[#(#pattern),*];
            fn by_parameters(
                &self,
                __t: Self::Scalar,
                __q: &Self::Configuration,
                #(#arguments,)*
            ) -> Self::ByParameters {
                #instructions
                #private::matrix([#(#matrix),*])
            }
    };
    Some(derived.implementation(quote!(ParametricSystem), items))
}
