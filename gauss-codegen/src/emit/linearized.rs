//! `LinearizedSystem` of the kernel: the derivatives of its equations by the state, time and the input.

use std::ops::Range;

use proc_macro2::TokenStream;
use quote::quote;

use crate::algebra::Rational;
use crate::kernel::{Operand, Program};

use super::arguments::{OF_EQUATIONS, declared};
use super::derived::Derived;

/// The implementation, where it is asked for.
pub fn linearized_system(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    let (linearization, program) = derived.linearization.zip(derived.kernel.tangents.as_ref())?;
    let (private, ty) = (derived.private(), derived.scalar().ty());
    let (states, inputs) = (linearization.increments + linearization.speeds, linearization.inputs);
    let arguments = declared(&private, OF_EQUATIONS);
    let (instructions, outputs) = derived.computed(program);
    // Outputs are the rates, and then their derivatives, one column of the matrices after the other.
    let (of_states, of_time, of_inputs) = (1..states + 1, states + 1, states + 2..states + 2 + inputs);
    let (by_state, by_input) = (rows(&outputs, states, of_states.clone()), rows(&outputs, states, of_inputs.clone()));
    let (state_pattern, input_pattern) = (pattern(program, states, of_states), pattern(program, states, of_inputs));
    let (rate, by_time) = (&outputs[..states], &outputs[states * of_time..states * (of_time + 1)]);
    let boolean = quote!(&'static [&'static [::core::primitive::bool]]);
    let items = quote! {
            type Linearization = #private::Linearization<#ty, #states, #inputs>;
            const STATE_PATTERN: #boolean = &[#(#state_pattern),*];
            const INPUT_PATTERN: #boolean = &[#(#input_pattern),*];
            fn linearize(
                &self,
                __t: Self::Scalar,
                __q: &Self::Configuration,
                #(#arguments,)*
            ) -> Self::Linearization {
                #instructions
                #private::Linearization {
                    rate: #private::vector([#(#rate),*]),
                    by_state: #private::matrix([#(#by_state),*]),
                    by_time: #private::vector([#(#by_time),*]),
                    by_input: #private::matrix([#(#by_input),*]),
                }
            }
    };
    Some(derived.implementation(quote!(LinearizedSystem), items))
}

/// The rows of a matrix whose columns are among the outputs, one column of the given height after the other.
pub fn rows(outputs: &[TokenStream], height: usize, columns: Range<usize>) -> Vec<TokenStream> {
    let row = |i: usize| {
        let entries = columns.clone().map(|k| &outputs[height * k + i]);
        quote!([#(#entries),*])
    };
    (0..height).map(row).collect()
}

/// Which entries of such a matrix are other than the number 0.
pub fn pattern(program: &Program<'_>, height: usize, columns: Range<usize>) -> Vec<TokenStream> {
    let zero = Operand::Number(Rational::zero());
    let row = |i: usize| {
        let entries = columns.clone().map(|k| program.outputs[height * k + i] != zero);
        quote!(&[#(#entries),*])
    };
    (0..height).map(row).collect()
}
