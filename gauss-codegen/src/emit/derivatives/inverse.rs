//! `InverseLinearizedSystem`: inverse dynamics and its derivatives by the state, ż, time and the input.

use proc_macro2::TokenStream;
use quote::quote;

use crate::kernel::Derivative;
use crate::methods::DerivativeKind;

use crate::emit::derivatives::linearized;
use crate::emit::derived::Derived;
use crate::emit::dialect::arguments::OF_RESIDUAL;

/// The implementation, where it is wanted.
pub fn inverse_linearized_system(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    let Derivative { program, .. } = derived.kernel.derivative(DerivativeKind::OfInverse)?;
    let (private, ty) = (derived.private(), derived.scalar().ty());
    let (increments, speeds) = (derived.increments(), derived.degrees_of_freedom());
    let inputs = derived.formal().inputs.len();
    let (instructions, outputs) = derived.computed(program);
    // Outputs are the forces, and then their derivatives, one column of the matrices after the other.
    let (force, derivatives) = outputs.split_at(speeds);
    let mut start = 0;
    let mut next = |columns: usize| {
        start += columns;
        linearized::columns(derivatives, speeds, start - columns..start)
    };
    let (by_configuration, by_speeds, by_acceleration) = (next(increments), next(speeds), next(speeds));
    let (by_time, by_input) = (next(1), next(inputs));
    let body = quote! {
        #instructions
        #private::InverseLinearization::new(
            #private::vector([#(#force),*]),
            #private::columns([#(#by_configuration),*]),
            #private::columns([#(#by_speeds),*]),
            #private::columns([#(#by_acceleration),*]),
            #private::columns([#(#by_time),*]),
            #private::columns([#(#by_input),*]),
        )
    };
    let function = derived.function_of("linearize_inverse", OF_RESIDUAL, quote!(Self::InverseLinearization), body);
    let items = quote! {
        type InverseLinearization = #private::InverseLinearization<#ty, #increments, #speeds, #inputs>;
        #function
    };
    Some(derived.implementation(quote!(InverseLinearizedSystem), items))
}
