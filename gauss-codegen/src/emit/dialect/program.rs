//! Tokens of kernels: their scalar, their symbols, the user's own functions.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};

use crate::algebra::{Expr, Map, OwnFunction, Rational};
use crate::kernel::Program;
use crate::targets::rust::{self, Dialect, NamedResults};
use crate::terms::{FunctionKind, Interpolation, Scalar, Table, UserFunction};

/// Tokens of numbers for a scalar type.
pub struct ScalarTokens<'a> {
    pub scalar: &'a Scalar,
    /// `::gauss_runtime::real::Real`.
    pub real: TokenStream,
    /// A product and a sum. For primitive types a function of its own: compilers look for an implementation at every
    /// call of a trait's, which was half of the time in which they checked types.
    pub fma: TokenStream,
    /// `::gauss_runtime::__private::apart`.
    pub apart: TokenStream,
    /// Functions of the user's own.
    pub functions: &'a [UserFunction],
}

impl ScalarTokens<'_> {
    pub fn ty(&self) -> TokenStream {
        match self.scalar {
            Scalar::F64 => quote!(::core::primitive::f64),
            Scalar::F32 => quote!(::core::primitive::f32),
            Scalar::Parameter(name) => quote!(#name),
        }
    }

    /// A number of a scalar that is a primitive type; digits enough to read back the same one.
    pub fn literal(&self, value: f64) -> TokenStream {
        let literal = match self.scalar {
            Scalar::F32 if (value as f32).is_finite() => Literal::f32_suffixed(value.abs() as f32),
            Scalar::F64 | Scalar::Parameter(_) if value.is_finite() => Literal::f64_suffixed(value.abs()),
            // Beyond the range of the scalar, as arithmetic at run time would have it.
            _ => {
                let (real, ty, sign) = (&self.real, self.ty(), if value > 0.0 { 1_i64 } else { -1 });
                return quote!(<#ty as #real>::ratio(#sign, 0i64));
            }
        };
        if value.is_sign_negative() { quote!((-#literal)) } else { quote!(#literal) }
    }

    /// A number, rounded once.
    pub fn number(&self, value: &Rational) -> TokenStream {
        let (real, ty) = (&self.real, self.ty());
        let ratio = |p: i64, q: i64| quote!(<#ty as #real>::ratio(#p, #q));
        match (self.scalar, value.parts()) {
            (Scalar::F64, _) | (Scalar::F32, None) => self.literal(value.to_f64()),
            // Rounded twice it could be another one.
            (Scalar::F32, _) if value.is_dyadic() => self.literal(value.to_f64()),
            (_, Some((0, _))) => quote!(<#ty as #real>::zero()),
            (_, Some((1, 1))) => quote!(<#ty as #real>::one()),
            (_, Some((numerator, denominator))) => ratio(numerator, denominator),
            (Scalar::Parameter(_), None) => {
                // As many digits as the scalar may have: the sum of the leading ones, each scaled by powers of two.
                let term = |(mantissa, exponent): (i64, i64)| {
                    let steps = exponent.unsigned_abs() as usize;
                    let powers = std::iter::repeat_n(1_i64 << 62, steps / 62).chain([1 << (steps % 62)]);
                    let factors = powers.map(|power| if exponent < 0 { ratio(1, power) } else { ratio(power, 1) });
                    let mantissa = ratio(mantissa, 1);
                    quote!(#mantissa #(* #factors)*)
                };
                let terms = value.leading_terms().into_iter().rev().map(term);
                quote!((#(#terms)+*))
            }
        }
    }
}

/// The dialect of a kernel. `symbols` says how each symbol is written.
pub struct KernelDialect<'a> {
    pub symbols: &'a Map<u32, TokenStream>,
    pub scalar: &'a ScalarTokens<'a>,
}

impl<'g> Dialect<Expr<'g>> for KernelDialect<'_> {
    fn input(&self, symbol: Expr<'g>) -> TokenStream {
        self.symbols.get(&symbol.key()).cloned().unwrap_or_else(|| {
            // A program reads only symbols that its caller declared; anything else is a bug in this crate.
            let message = format!("bug in gauss-derive: the symbol `{symbol:?}` has no source");
            quote!(::core::compile_error!(#message))
        })
    }

    fn number(&self, value: &Rational) -> TokenStream {
        self.scalar.number(value)
    }

    fn functions(&self) -> TokenStream {
        self.scalar.real.clone()
    }

    fn fma(&self) -> TokenStream {
        self.scalar.fma.clone()
    }

    fn sines_and_cosines(&self) -> Option<TokenStream> {
        let real = &self.scalar.real;
        Some(quote!(#real::sines_and_cosines))
    }

    fn own_function(&self, own: OwnFunction, arguments: &[TokenStream]) -> TokenStream {
        own_function(self.scalar, own, arguments)
    }

    fn apart(&self) -> Option<TokenStream> {
        Some(self.scalar.apart.clone())
    }
}

/// The statements of a program, and its outputs as expressions. `symbols` says how each symbol is written.
pub fn statements<'g>(
    program: &Program<'g>,
    symbols: &Map<u32, TokenStream>,
    scalar: &ScalarTokens<'_>,
) -> (TokenStream, Vec<TokenStream>) {
    rust::statements(program, &KernelDialect { symbols, scalar }, NamedResults::AsRead)
}

/// Call of a function of the user's own, or of a derivative of it: by its path, or as a method of a table.
fn own_function(scalar: &ScalarTokens<'_>, own: OwnFunction, arguments: &[TokenStream]) -> TokenStream {
    let (table, order) = (table_name(own.index), usize::from(own.order()));
    match &scalar.functions[usize::from(own.index)].kind {
        // That the derivative is there was checked.
        FunctionKind::Rust(paths) => {
            let path = paths.get(order);
            quote!(#path(#(#arguments),*))
        }
        FunctionKind::Table(Table { axes, joined, .. }) if axes.is_empty() && *joined != Interpolation::Hermite => {
            let method = ["value", "slope", "second", "third"].get(order);
            let method = Ident::new(method.copied().unwrap_or("third"), Span::call_site());
            quote!(#table.#method(#(#arguments),*))
        }
        FunctionKind::Table(_) => {
            let orders = own.of(&own.orders);
            quote!(#table.at([#(#orders),*], [#(#arguments),*]))
        }
    }
}

/// The constant that holds a table.
pub fn table_name(index: u16) -> Ident {
    format_ident!("__TABLE_{}", index, span = Span::mixed_site())
}
