//! Derivatives as solutions of one linear system, for bundles of columns: a loop in which every step is written out.

use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote};

use crate::algebra::Rational;
use crate::derivatives::OutputParts;
use crate::kernel::{LoweredColumns, Operand, TOGETHER};

use crate::emit::derived::Derived;

/// Code of the program before a linear system is solved, the substitution for bundles of columns, and the results where
/// they belong.
pub fn solved_together<'g>(derived: &Derived<'_, 'g>, columns: &LoweredColumns<'g>, states: usize) -> TokenStream {
    let (private, scalar) = (derived.private(), derived.scalar());
    let zero = scalar.number(&Rational::zero());
    let (instructions, outputs) = derived.computed(&columns.program);
    let shape = &columns.shape;
    let OutputParts { values, below, pivots, rights, .. } = shape.parts(&outputs);
    let bundle = |columns: &[Vec<TokenStream>]| {
        let row = |k: usize| {
            let lanes = (0..TOGETHER).map(|lane| columns.get(lane).map_or(&zero, |column| &column[k]));
            quote!([#(#lanes),*])
        };
        let rows = (0..shape.order.len()).map(row);
        quote!(#private::Bundle([#(#rows),*]))
    };
    let rights = rights.chunks(TOGETHER).map(bundle);
    let targets = targets(columns, &private, states);
    let substitution = substitution(columns, &private);
    let (known, added) = known_derivatives(columns, &outputs, states);
    quote! {
        #instructions
        let mut __x = [#(#rights),*];
        let (__entries, __reciprocals) = ([#(#below),*], [#(#pivots),*]);
        let (__rate, __known) = ([#(#values),*], [#(#known),*]);
        #private::filled(__rate, |__linear: &mut Self::Linearization| {
            #targets
            #substitution
            #added
        })
    }
}

/// Matrix and column where a column of derivatives is kept.
fn place(states: usize, direction: usize) -> (TokenStream, usize) {
    match direction.checked_sub(states) {
        None => (quote!(by_state), direction),
        Some(0) => (quote!(by_time), 0),
        Some(input) => (quote!(by_input), input - 1),
    }
}

/// Places where the columns of every bundle go: `__targets`. Those that fill up the last bundle go nowhere.
fn targets(columns: &LoweredColumns<'_>, private: &TokenStream, states: usize) -> TokenStream {
    let shape = &columns.shape;
    let name = |direction: usize| format_ident!("__column{}", direction, span = Span::mixed_site());
    let nowhere = |k: usize| format_ident!("__nowhere{}", k, span = Span::mixed_site());
    let all = [0..states, states..states + 1, states + 1..shape.directions];
    let named = all.into_iter().filter(|directions| !directions.is_empty()).map(|directions| {
        let matrix = place(states, directions.start).0;
        let names = directions.map(|direction| match shape.solved.contains(&direction) {
            true => {
                let name = name(direction);
                quote!(#name)
            }
            false => quote!(_),
        });
        quote!(let [#(#names),*] = #private::each_column(&mut __linear.#matrix);)
    });
    let spare = shape.solved.len().next_multiple_of(TOGETHER) - shape.solved.len();
    let spares: Vec<Ident> = (0..spare).map(nowhere).collect();
    let slots: Vec<Ident> = shape.solved.iter().map(|&direction| name(direction)).chain(spares.clone()).collect();
    let bundles = slots.chunks(TOGETHER).map(|bundle| quote!([#(#bundle),*]));
    // None of them has no type.
    let nowhere = (spare > 0).then(|| {
        quote! {
            let mut __nowhere = [#private::zeros::<_, #states, 1usize>(); #spare];
            let [#(#spares),*] = __nowhere.each_mut().map(#private::only_column);
        }
    });
    quote! {
        #(#named)*
        #nowhere
        let mut __targets = [#(#bundles),*];
    }
}

/// L D Lᵀ x = right for the bundles of `__x`, with `__entries` of L and the reciprocals `__reciprocals` of D.
fn substitution(columns: &LoweredColumns<'_>, private: &TokenStream) -> TokenStream {
    let shape = &columns.shape;
    let starts: Vec<usize> =
        shape.below.iter().scan(0, |sum, rows| Some(std::mem::replace(sum, *sum + rows.len()))).collect();
    let entry = |row: usize, k: usize| {
        let place = shape.below[k].iter().position(|&below| below == row);
        starts[k] + place.expect("rows of a group are below all of it")
    };
    let (mut down, mut up) = (Vec::new(), Vec::new());
    for (number, group) in shape.groups().into_iter().enumerate() {
        let last = group.end - 1;
        let rows: Vec<usize> = group.clone().skip(1).chain(shape.below[last].iter().copied()).collect();
        // Every row is loaded and stored once for the whole group.
        let steps = rows.iter().map(|&row| {
            let before: Vec<usize> = group.clone().filter(|&k| k < row).collect();
            let entries = before.iter().map(|&k| entry(row, k));
            quote! {
                let mut __own = __y.0[#row];
                #(#private::subtract_multiple(&mut __own, __entries[#entries], &__y.0[#before]);)*
                __y.0[#row] = __own;
            }
        });
        down.push(quote!(if !__idle[#number] { #(#steps)* }));
    }
    for k in (0..shape.order.len()).rev() {
        // What was found last comes last.
        let rows: Vec<usize> = shape.below[k].iter().rev().copied().collect();
        let entries = rows.iter().map(|&row| entry(row, k));
        up.push(quote! {
            let mut __own = #private::multiple(__reciprocals[#k], &__y.0[#k]);
            #(#private::subtract_multiple(&mut __own, __entries[#entries], &__y.0[#rows]);)*
            __y.0[#k] = __own;
        });
    }
    let idle = columns.idle();
    let bundles = idle.len();
    let idle = idle.iter().map(|steps| quote!([#(#steps),*]));
    let (order, first) = (&shape.order, shape.known);
    // Without methods of iterators, which need not be in scope where this is compiled.
    quote! {
        let (__factors, __idle) = ((__entries, __reciprocals), [#(#idle),*]);
        let mut __bundle = 0usize;
        while __bundle < #bundles {
            // Read where they are used: compilers would spread each of them over lanes beforehand, which is eight times
            // as much to load.
            let (__entries, __reciprocals) = ::core::hint::black_box(&__factors);
            let (__y, __idle) = (&mut __x[__bundle], &__idle[__bundle]);
            #(#down)*
            #(#up)*
            #private::put(&mut __targets[__bundle], __y, &[#(#order),*], #first);
            __bundle += 1;
        }
    }
}

/// Parts of derivatives that are known before the system is solved, entry by entry, but for zeros; and statements that
/// put `__known` where it belongs: beside what is solved for.
fn known_derivatives(
    columns: &LoweredColumns<'_>,
    outputs: &[TokenStream],
    states: usize,
) -> (Vec<TokenStream>, TokenStream) {
    let zero = Operand::Number(Rational::zero());
    let shape = &columns.shape;
    let added = shape.parts(&columns.program.outputs).added;
    let written = shape.parts(outputs).added;
    let (mut known, mut statements) = (Vec::new(), TokenStream::new());
    for (direction, (operands, written)) in added.iter().zip(written).enumerate() {
        let (matrix, column) = place(states, direction);
        for (row, value) in written.into_iter().enumerate().filter(|(row, _)| operands[*row] != zero) {
            let (number, entry) = (known.len(), quote!(__linear.#matrix[(#row, #column)]));
            known.push(value);
            statements.extend(match row >= shape.known && shape.solved.contains(&direction) {
                true => quote!(#entry = #entry + __known[#number];),
                false => quote!(#entry = __known[#number];),
            });
        }
    }
    (known, statements)
}
