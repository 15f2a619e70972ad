//! `HessianSystem`: second derivatives of the equations along given weights.

use proc_macro2::TokenStream;
use quote::quote;

use crate::kernel::Derivative;
use crate::methods::DerivativeKind;

use crate::emit::derived::Derived;
use crate::emit::dialect::arguments::OF_HESSIAN;

/// The implementation, where it is wanted.
pub fn hessian_system(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    let Derivative { program, .. } = derived.kernel.derivative(DerivativeKind::Hessian)?;
    let (private, ty) = (derived.private(), derived.scalar().ty());
    let (states, inputs) = (derived.increments() + derived.degrees_of_freedom(), derived.formal().inputs.len());
    let (instructions, outputs) = derived.computed(program);
    let [by_state, by_input_and_state, by_input] = blocks(states, inputs).map(|block| {
        let row = |row: &Vec<usize>| {
            let entries = row.iter().map(|&k| &outputs[k]);
            quote!([#(#entries),*])
        };
        block.iter().map(row).collect::<Vec<_>>()
    });
    let body = quote! {
        #instructions
        #private::Hessian::new(
            #private::matrix([#(#by_state),*]),
            #private::matrix([#(#by_input_and_state),*]),
            #private::matrix([#(#by_input),*]),
        )
    };
    let function = derived.function_of("hessian", OF_HESSIAN, quote!(Self::Hessian), body);
    let items = quote! {
        type Hessian = #private::Hessian<#ty, #states, #inputs>;
        #function
    };
    Some(derived.implementation(quote!(HessianSystem), items))
}

/// Numbers of the outputs that are the entries of the matrices by states, by inputs and states, by inputs, row by row.
/// Outputs are rows of the lower triangle.
pub fn blocks(states: usize, inputs: usize) -> [Vec<Vec<usize>>; 3] {
    let output = |i: usize, j: usize| {
        let (row, column) = (i.max(j), i.min(j));
        row * (row + 1) / 2 + column
    };
    let all = states + inputs;
    let block = |rows: std::ops::Range<usize>, columns: std::ops::Range<usize>| {
        rows.map(|i| columns.clone().map(|j| output(i, j)).collect()).collect()
    };
    [block(0..states, 0..states), block(states..all, 0..states), block(states..all, states..all)]
}
