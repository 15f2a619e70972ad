//! Methods that are written with vectors as well, and the rows of constants that these load.
//!
//! Only where the scalar is `f64`: others have no vectors, or are vectors. Which of the two forms is compiled is chosen
//! by the runtime, `with_vectors!`. Where it is known beforehand that there are no vectors, none of this is done
//! (`expand_without_vectors`).

use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote};

use crate::algebra::{Expr, Map};
use crate::kernel::{Kernel, Program};
use crate::mechanics::Method;
use crate::program::{InputPlace, LANES, Operand, PackedCode};
use crate::targets::rust::operand;
use crate::targets::rust::packed::{self, Vectors};

use crate::emit::dialect::arguments::ArrayArgument;
use crate::emit::dialect::program::{KernelDialect, ScalarTokens};

/// Methods that runs call in every step.
pub const PACKED: [Method; 5] =
    [Method::Acceleration, Method::Momentum, Method::Velocity, Method::MomentumRate, Method::GaussResidual];

/// Programs with packs, and their constants in rows.
#[derive(Default)]
pub struct Packs<'g> {
    programs: Vec<(Method, Program<'g>, PackedCode<Expr<'g>>)>,
    rows: Vec<Vec<Operand<Expr<'g>>>>,
}

/// Sources of the symbols of a program, and the tokens that read them.
pub struct Sources<'a, 'g> {
    pub kernel: &'a Kernel<'g>,
    pub arguments: &'a [ArrayArgument<'g>],
    pub names: &'a Map<u32, TokenStream>,
}

impl<'g> Sources<'_, 'g> {
    fn place(&self, symbol: Expr<'g>) -> InputPlace {
        let Kernel { constant_symbols, known_constants, .. } = self.kernel;
        if constant_symbols.contains(&symbol) || known_constants.iter().any(|(known, _)| *known == symbol) {
            return InputPlace::Constant;
        }
        argument(self.arguments, symbol)
            .map_or(InputPlace::Variable, |(array, index)| InputPlace::Argument { array, index })
    }
}

impl<'g> Packs<'g> {
    /// Looks for packs in a method.
    pub fn add(&mut self, method: Method, program: &Program<'g>, sources: &Sources<'_, 'g>, scalar: &ScalarTokens<'_>) {
        let dialect = KernelDialect { symbols: sources.names, scalar };
        let Some((code, packed)) = packed::packed(program, &dialect, |symbol| sources.place(symbol)) else { return };
        for vector in packed.packs.iter().flat_map(|pack| &pack.operands) {
            let is_constant = |operand: &Operand<Expr<'g>>| match *operand {
                Operand::Number(_) => true,
                Operand::Input(symbol) => sources.place(symbol) == InputPlace::Constant,
                _ => false,
            };
            let is_row = vector.iter().any(|operand| *operand != vector[0]) && vector.iter().all(is_constant);
            if is_row && !self.rows.contains(vector) {
                self.rows.push(vector.clone());
            }
        }
        self.programs.push((method, code, packed));
    }

    /// The field of a kernel that holds the rows.
    pub fn field(&self, private: &TokenStream) -> Option<TokenStream> {
        let count = self.rows.len();
        (count > 0).then(|| quote!(rows: #private::Rows<#count>))
    }

    /// The rows, with constants under these names.
    pub fn rows(
        &self,
        private: &TokenStream,
        scalar: &ScalarTokens<'_>,
        names: &Map<u32, TokenStream>,
    ) -> Option<TokenStream> {
        let dialect = KernelDialect { symbols: names, scalar };
        let rows = self.rows.iter().map(|row| {
            let numbers = row.iter().map(|number| operand(number, &dialect));
            let unused = (row.len()..LANES).map(|_| scalar.literal(0.0));
            let row = numbers.chain(unused);
            quote!([#(#row),*])
        });
        (!self.rows.is_empty()).then(|| quote!(rows: #private::Rows::new([#(#rows),*])))
    }

    /// The statements of a method in both forms, of which one is given; its outputs. Nothing where it has that form
    /// alone.
    pub fn in_both_forms(
        &self,
        method: Method,
        (single, outputs): &(TokenStream, Vec<TokenStream>),
        sources: &Sources<'_, 'g>,
        (private, scalar): (&TokenStream, &ScalarTokens<'_>),
    ) -> Option<(TokenStream, Vec<TokenStream>)> {
        let (_, code, packs) = self.programs.iter().find(|(packed, ..)| *packed == method)?;
        let vectors = KernelVectors { packs: self, private, sources };
        let dialect = KernelDialect { symbols: sources.names, scalar };
        let (packed, packed_outputs) = packed::statements(code, packs, &dialect, &vectors);
        let result = |k| format_ident!("__r{}", k, span = Span::mixed_site());
        let results: Vec<Ident> = (0..outputs.len()).map(result).collect();
        let written = quote! {
            let [#(#results),*] = #private::with_vectors! {
                { #packed [#(#packed_outputs),*] }
                { #single [#(#outputs),*] }
            };
        };
        Some((written, results.iter().map(|result| quote!(#result)).collect()))
    }
}

/// The argument that a symbol is an element of, and which.
fn argument<'g>(arguments: &[ArrayArgument<'g>], symbol: Expr<'g>) -> Option<(usize, usize)> {
    arguments.iter().enumerate().find_map(|(array, argument)| {
        let index = argument.symbols.iter().position(|other| *other == symbol)?;
        Some((array, index))
    })
}

/// Writer of vectors in methods of a kernel.
struct KernelVectors<'a, 'g> {
    packs: &'a Packs<'g>,
    private: &'a TokenStream,
    sources: &'a Sources<'a, 'g>,
}

impl<'g> Vectors<Expr<'g>> for KernelVectors<'_, 'g> {
    fn functions(&self) -> TokenStream {
        let private = self.private;
        quote!(#private::packs)
    }

    fn row(&self, operands: &[Operand<Expr<'g>>]) -> Option<TokenStream> {
        let row = self.packs.rows.iter().position(|row| row == operands)?;
        Some(quote!(self.rows.row(#row)))
    }

    fn behind(&self, symbol: Expr<'g>) -> Option<TokenStream> {
        let (array, index) = argument(self.sources.arguments, symbol)?;
        let next = self.sources.arguments[array].symbols.get(index + 1)?;
        self.sources.names.get(&next.key()).cloned()
    }
}
