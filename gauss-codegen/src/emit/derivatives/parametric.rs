//! `ParametricSystem`: the derivatives of the equations by parameters.

use proc_macro2::TokenStream;
use quote::quote;

use crate::kernel::Derivative;
use crate::methods::DerivativeKind;

use crate::emit::derivatives::linearized::{columns, pattern};
use crate::emit::derived::Derived;
use crate::emit::dialect::arguments::OF_EQUATIONS;

/// The derivatives by parameters, where they are wanted.
pub fn parametric_system(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    let Derivative { program, .. } = derived.kernel.derivative(DerivativeKind::ByParameters)?;
    let (private, ty) = (derived.private(), derived.scalar().ty());
    let (states, count) =
        (derived.increments() + derived.degrees_of_freedom(), derived.subject.provenance.parameters.len());
    let names = derived.subject.provenance.parameters.iter().map(|parameter| &parameter.name);
    let (instructions, outputs) = derived.computed(program);
    let (matrix, pattern) = (columns(&outputs, states, 0..count), pattern(program, states, 0..count));
    let body = quote!(#instructions #private::columns([#(#matrix),*]));
    let function = derived.function_of("by_parameters", OF_EQUATIONS, quote!(Self::ByParameters), body);
    let items = quote! {
        type ByParameters = #private::SMatrix<#ty, #states, #count>;
        const PARAMETERS: &'static [&'static ::core::primitive::str] = &[#(#names),*];
        const PARAMETER_PATTERN: &'static [&'static [::core::primitive::bool]] = &[#(#pattern),*];
        #function
    };
    Some(derived.implementation(quote!(ParametricSystem), items))
}
