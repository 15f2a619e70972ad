//! `LinearizedSystem` of the kernel: the derivatives of its equations by the state, time and the input.

use std::ops::Range;

use proc_macro2::TokenStream;
use quote::quote;

use crate::algebra::Rational;
use crate::kernel::{LoweredColumns, Operand, Parts, Program, TOGETHER};

use super::arguments::OF_EQUATIONS;
use super::derived::Derived;

/// The implementation, where it is asked for.
pub fn linearized_system(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    let (linearization, program) = derived.linearization.zip(derived.kernel.tangents.as_ref())?;
    let (private, ty) = (derived.private(), derived.scalar().ty());
    let (states, inputs) = (linearization.increments + linearization.speeds, linearization.inputs);
    // Outputs are the rates, and then their derivatives, one column of the matrices after the other.
    let (of_states, of_time, of_inputs) = (1..states + 1, states + 1, states + 2..states + 2 + inputs);
    let body = match &derived.kernel.columns {
        Some(columns) => solved_together(derived, columns, states),
        None => {
            let (instructions, outputs) = derived.computed(program);
            let by_state = rows(&outputs, states, of_states.clone());
            let by_input = rows(&outputs, states, of_inputs.clone());
            let (rate, by_time) = (&outputs[..states], &outputs[states * of_time..states * (of_time + 1)]);
            quote! {
                #instructions
                #private::Linearization {
                    rate: #private::vector([#(#rate),*]),
                    by_state: #private::matrix([#(#by_state),*]),
                    by_time: #private::vector([#(#by_time),*]),
                    by_input: #private::matrix([#(#by_input),*]),
                }
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

/// What a program computes before a linear system is solved, the substitution for bundles of columns, and the results where they
/// belong.
fn solved_together<'g>(derived: &Derived<'_, 'g>, columns: &LoweredColumns<'g>, states: usize) -> TokenStream {
    let (private, scalar) = (derived.private(), derived.scalar());
    let zero = scalar.number(&Rational::zero());
    let (instructions, outputs) = derived.computed(&columns.program);
    let shape = &columns.shape;
    let Parts { values, below, pivots, rights, .. } = shape.parts(&outputs);
    let bundle = |columns: &[Vec<TokenStream>]| {
        let row = |k: usize| {
            let lanes = (0..TOGETHER).map(|lane| columns.get(lane).map_or(&zero, |column| &column[k]));
            quote!([#(#lanes),*])
        };
        let rows = (0..shape.order.len()).map(row);
        quote!([#(#rows),*])
    };
    let rights = rights.chunks(TOGETHER).map(bundle);
    let substitution = substitution(columns, &private);
    // Where a column of derivatives is kept.
    let place = |direction: usize| match direction.checked_sub(states) {
        None => (quote!(by_state), direction),
        Some(0) => (quote!(by_time), 0),
        Some(input) => (quote!(by_input), input - 1),
    };
    let known = known_derivatives(columns, &outputs, &place);
    let (order, first) = (&shape.order, shape.known);
    let targets = [0..states, states..states + 1, states + 1..shape.directions].map(|directions| {
        let solved = shape.solved.iter().enumerate().filter(|(_, direction)| directions.contains(direction));
        let solved: Vec<TokenStream> = solved
            .map(|(slot, &direction)| {
                let column = place(direction).1;
                quote!((#slot, #column))
            })
            .collect();
        let matrix = place(directions.start).0;
        (!solved.is_empty()).then(
            || quote!(#private::add_columns(&mut __linear.#matrix, &__x, &[#(#order),*], #first, &[#(#solved),*]);),
        )
    });
    quote! {
        #instructions
        let mut __x = [#(#rights),*];
        let (__entries, __pivots) = ([#(#below),*], [#(#pivots),*]);
        #substitution
        let mut __linear = #private::Linearization {
            rate: #private::vector([#(#values),*]),
            by_state: #private::zeros(),
            by_time: #private::zeros(),
            by_input: #private::zeros(),
        };
        #known
        #(#targets)*
        __linear
    }
}

/// L D Lᵀ x = right for the bundles of `__x`, with `__entries` of L D and the reciprocals `__pivots`.
fn substitution(columns: &LoweredColumns<'_>, private: &TokenStream) -> TokenStream {
    let below = &columns.shape.below;
    let (mut multiples, mut down, mut up) = (Vec::new(), Vec::new(), Vec::new());
    for (k, rows) in below.iter().enumerate() {
        let entries = multiples.len()..multiples.len() + rows.len();
        multiples.extend(entries.clone().map(|entry| quote!(__entries[#entry] * __pivots[#k])));
        let (each, entries) = (entries.clone(), entries);
        down.push(quote!(if !__idle[#k] {
            let __own = __y[#k];
            #(#private::subtract_multiple(&mut __y[#rows], __multiples[#each], &__own);)*
        }));
        up.push(quote! {
            let mut __own = __y[#k];
            #(#private::subtract_multiple(&mut __own, __entries[#entries], &__y[#rows]);)*
            __y[#k] = #private::multiple(__pivots[#k], &__own);
        });
    }
    up.reverse();
    let idle = columns.idle();
    let bundles = idle.len();
    let idle = idle.iter().map(|steps| quote!([#(#steps),*]));
    // Without methods of iterators, which need not be in scope where this is compiled.
    quote! {
        let (__multiples, __idle) = ([#(#multiples),*], [#(#idle),*]);
        let mut __bundle = 0usize;
        while __bundle < #bundles {
            let (__y, __idle) = (&mut __x[__bundle], &__idle[__bundle]);
            #(#down)*
            #(#up)*
            __bundle += 1;
        }
    }
}

/// What is known of derivatives before the system is solved, entry by entry, but for zeros.
fn known_derivatives(
    columns: &LoweredColumns<'_>,
    outputs: &[TokenStream],
    place: &impl Fn(usize) -> (TokenStream, usize),
) -> TokenStream {
    let zero = Operand::Number(Rational::zero());
    let added = columns.shape.parts(&columns.program.outputs).added;
    let written = columns.shape.parts(outputs).added;
    let mut known = TokenStream::new();
    for (direction, (operands, written)) in added.iter().zip(&written).enumerate() {
        let (matrix, column) = place(direction);
        for (row, value) in written.iter().enumerate().filter(|(row, _)| operands[*row] != zero) {
            known.extend(quote!(__linear.#matrix[(#row, #column)] = #value;));
        }
    }
    known
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
