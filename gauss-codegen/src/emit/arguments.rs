//! Where the symbols of a program come from: the arguments of a method taken apart, the fields of the kernel.

use proc_macro2::{Span, TokenStream};
use quote::{format_ident, quote};

use crate::algebra::{Expr, Map};
use crate::kernel::Program;

/// An array of scalars and the symbols that its elements are.
pub struct Argument<'g> {
    pub array: TokenStream,
    pub symbols: Vec<Expr<'g>>,
}

/// `let` statements that name the elements which the program reads, and how each symbol is then written.
pub fn declare(program: &Program<'_>, arguments: &[Argument<'_>], names: &mut Map<u32, TokenStream>) -> TokenStream {
    let read = program.symbols();
    let mut statements = TokenStream::new();
    for (a, argument) in arguments.iter().enumerate() {
        if !argument.symbols.iter().any(|s| read.contains(s)) {
            continue;
        }
        let elements = argument.symbols.iter().enumerate().map(|(k, symbol)| {
            if !read.contains(symbol) {
                return quote!(_);
            }
            let name = format_ident!("__a{}_{}", a, k, span = Span::mixed_site());
            names.insert(symbol.key(), quote!(#name));
            quote!(#name)
        });
        let array = &argument.array;
        statements.extend(quote!(let [#(#elements),*] = #array;));
    }
    statements
}
