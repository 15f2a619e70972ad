//! `LinearizedSystem` of the kernel: the derivatives of its equations by the state, time and the input.

use proc_macro2::TokenStream;
use quote::quote;

use crate::algebra::Rational;
use crate::kernel::Operand;

use super::kernel::{Derived, Item, count_tokens};

/// The implementation, where it is asked for. `head` is `impl<…>`, `name` the kernel with its generics.
pub fn linearized_system(derived: &Derived<'_, '_>, head: &TokenStream, name: &TokenStream) -> Option<TokenStream> {
    let (linearization, program) = derived.linearization.zip(derived.kernel.tangents.as_ref())?;
    let Item { runtime, .. } = derived.item();
    let (private, ty) = (derived.private(), derived.scalar().ty());
    let (states, inputs) = (linearization.increments + linearization.speeds, linearization.inputs);
    let zero = Operand::Number(Rational::zero());
    let (instructions, outputs) = derived.computed(program);
    // Outputs are the rates, and then their derivatives, one column of the matrices after the other.
    let column = |k: usize| states * (k + 1)..states * (k + 2);
    let written = |k: usize| &outputs[column(k)];
    let rows = |columns: std::ops::Range<usize>| -> Vec<TokenStream> {
        let row = |i: usize| {
            let entries = columns.clone().map(|k| &written(k)[i]);
            quote!([#(#entries),*])
        };
        (0..states).map(row).collect()
    };
    let pattern = |columns: std::ops::Range<usize>| -> Vec<TokenStream> {
        let row = |i: usize| {
            let entries = columns.clone().map(|k| program.outputs[column(k)][i] != zero);
            quote!(&[#(#entries),*])
        };
        (0..states).map(row).collect()
    };
    let (of_states, of_inputs) = (0..states, states + 1..states + 1 + inputs);
    let (by_state, by_input) = (rows(of_states.clone()), rows(of_inputs.clone()));
    let (state_pattern, input_pattern) = (pattern(of_states), pattern(of_inputs));
    let (rate, by_time) = (&outputs[..states], written(states));
    let count = count_tokens(runtime, program.counts());
    let boolean = quote!(&'static [&'static [::core::primitive::bool]]);
    Some(quote! {
        #[automatically_derived]
        #[allow(unused_variables, clippy::all, clippy::pedantic)]
        #head #runtime::linearize::LinearizedSystem for #name {
            type Linearization = #runtime::linearize::Linearization<#ty, #states, #inputs>;
            const STATE_PATTERN: #boolean = &[#(#state_pattern),*];
            const INPUT_PATTERN: #boolean = &[#(#input_pattern),*];
            const LINEARIZE_OPERATIONS: #runtime::system::OperationCount = #count;
            fn linearize(
                &self,
                t: Self::Scalar,
                q: &Self::Configuration,
                z: &Self::Speeds,
                input: &Self::Input,
            ) -> Self::Linearization {
                #instructions
                #runtime::linearize::Linearization {
                    rate: #private::vector([#(#rate),*]),
                    by_state: #private::matrix([#(#by_state),*]),
                    by_time: #private::vector([#(#by_time),*]),
                    by_input: #private::matrix([#(#by_input),*]),
                }
            }
        }
    })
}
