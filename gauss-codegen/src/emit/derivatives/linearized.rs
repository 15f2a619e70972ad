//! `LinearizedSystem` of the kernel: the derivatives of its equations by the state, time and the input.

use std::ops::Range;

use proc_macro2::TokenStream;
use quote::quote;

use crate::algebra::Rational;
use crate::kernel::{Derivative, Operand, Program};
use crate::methods::DerivativeKind;

use crate::emit::derivatives::columns::solved_together;
use crate::emit::derived::Derived;
use crate::emit::dialect::arguments::OF_EQUATIONS;

/// The implementation, where it is wanted.
pub fn linearized_system(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    let Derivative { program, columns: solved, .. } = derived.kernel.derivative(DerivativeKind::ByState)?;
    let (private, ty) = (derived.private(), derived.scalar().ty());
    let (states, inputs) = (derived.increments() + derived.degrees_of_freedom(), derived.formal().inputs.len());
    // Outputs are the rates, and then their derivatives, one column of the matrices after the other.
    let (of_states, of_time, of_inputs) = (1..states + 1, states + 1, states + 2..states + 2 + inputs);
    let body = match solved {
        Some(solved) => solved_together(derived, solved, states),
        None => {
            let (instructions, outputs) = derived.computed(program);
            let by_state = columns(&outputs, states, of_states.clone());
            let by_input = columns(&outputs, states, of_inputs.clone());
            let (rate, by_time) = (&outputs[..states], &outputs[states * of_time..states * (of_time + 1)]);
            quote! {
                #instructions
                #private::Linearization::new(
                    #private::vector([#(#rate),*]),
                    #private::columns([#(#by_state),*]),
                    #private::vector([#(#by_time),*]),
                    #private::columns([#(#by_input),*]),
                )
            }
        }
    };
    let (state_pattern, input_pattern) = (pattern(program, states, of_states), pattern(program, states, of_inputs));
    let boolean = quote!(&'static [&'static [::core::primitive::bool]]);
    let function = derived.function_of("linearize", OF_EQUATIONS, quote!(Self::Linearization), body);
    let items = quote! {
        type Linearization = #private::Linearization<#ty, #states, #inputs>;
        const STATE_PATTERN: #boolean = &[#(#state_pattern),*];
        const INPUT_PATTERN: #boolean = &[#(#input_pattern),*];
        #function
    };
    Some(derived.implementation(quote!(LinearizedSystem), items))
}

/// The columns of a matrix that are among the outputs, one column of the given height after the other.
pub fn columns(outputs: &[TokenStream], height: usize, columns: Range<usize>) -> Vec<TokenStream> {
    let column = |k: usize| {
        let entries = &outputs[height * k..height * (k + 1)];
        quote!([#(#entries),*])
    };
    columns.map(column).collect()
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
