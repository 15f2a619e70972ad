//! Functions of `f64` that need nothing but the standard library: for files that a build script writes, and for
//! reading.

use std::collections::BTreeSet;

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};

use crate::algebra::{OwnFunction, Rational};
use crate::program::{Argument, ArgumentKind, Functions, Input, Instruction, Program, Results};

use super::super::{header, is_handed_over, only_scalar, snake};
use super::{Dialect, NamedResults, statements};

/// A file with all programs of a struct: the constants, then every method. Arguments are arrays, but for the time;
/// those without components are left out. Results are numbers, arrays, or arrays of rows; several are a tuple.
///
/// What the equations call of the user's own is taken from the module above: `lift`, its derivatives `lift_1`,
/// `lift_2`. Parameters are not checked: what `kernel()` refuses gives infinities or NaN here.
///
/// ```
/// let top = "#[gauss(motion = fixed_point)] struct Top { #[gauss(mass)] m: f64, #[gauss(inertia)] i: Vector3<f64> }";
/// let code = gauss_codegen::targets::rust::source(gauss_codegen::Derivation::of_source(top, "Top")?.functions());
/// assert!(code.to_string().contains("pub fn acceleration"));
/// # Ok::<(), syn::Error>(())
/// ```
pub fn source(all: &Functions) -> TokenStream {
    let functions = all.programs().map(function);
    let own = own_functions(all.programs());
    let own = (!own.is_empty()).then(|| quote!(use super::{#(#own),*};));
    let arithmetic = arithmetic();
    let equations = all.equations.lines().map(|line| format!(" {line}"));
    quote! {
        #(#![doc = #equations])*
        #own
        #arithmetic
        #(#functions)*
    }
}

/// Functions under the names that instructions call them by.
fn arithmetic() -> TokenStream {
    let unary = ["exp", "ln", "sqrt", "abs", "tanh", "sin", "cos"].map(ident);
    let binary = ["atan2", "min", "max", "powf"].map(ident);
    quote! {
        mod arithmetic {
            #![allow(dead_code, reason = "few equations call all of them")]
            /// a b + c in one rounding where the target has an instruction for it, in two elsewhere.
            pub fn fma(a: f64, b: f64, c: f64) -> f64 {
                if cfg!(target_feature = "fma") { a.mul_add(b, c) } else { a * b + c }
            }
            pub fn sin_cos(x: f64) -> (f64, f64) {
                x.sin_cos()
            }
            /// Zero of zero.
            pub fn signum(x: f64) -> f64 {
                if x == 0.0 { x } else { x.signum() }
            }
            #(pub fn #unary(x: f64) -> f64 {
                x.#unary()
            })*
            #(pub fn #binary(x: f64, y: f64) -> f64 {
                x.#binary(y)
            })*
        }
    }
}

/// One function, with what it takes, gives and costs in its documentation.
fn function(program: &Program) -> TokenStream {
    let name = ident(&program.name);
    let text = header(program, |result| result.name.clone());
    let lines = text.lines().map(|line| format!(" {line}  "));
    let read = program.code.inputs();
    let arguments = program.arguments.iter().enumerate().filter(|(_, argument)| is_handed_over(argument));
    let arguments = arguments.map(|(index, argument)| {
        let reads = |input: &Input| matches!(input, Input::Component { argument, .. } if *argument == index);
        let name = if read.iter().any(reads) { ident(&argument.name) } else { format_ident!("_{}", argument.name) };
        let count = count(argument.components.len());
        if argument.kind == ArgumentKind::Time { quote!(#name: f64) } else { quote!(#name: &[f64; #count]) }
    });
    let (instructions, outputs) = statements(&program.code, &PlainDialect { program }, NamedResults::AsRead);
    let mut outputs = outputs.into_iter();
    let results = program.results.iter().filter(|result| only_scalar(program) || result.len() > 0);
    let (types, values): (Vec<_>, Vec<_>) = results.map(|result| written(result, &mut outputs)).unzip();
    let (ty, value) = match (types.as_slice(), values.as_slice()) {
        ([ty], [value]) => (ty.clone(), value.clone()),
        _ => (quote!((#(#types),*)), quote!((#(#values),*))),
    };
    quote! {
        #(#[doc = #lines])*
        #[allow(clippy::all, unused_parens, reason = "written by a program")]
        pub fn #name(#(#arguments),*) -> #ty {
            #instructions
            #value
        }
    }
}

/// The type of a result, and the expression that holds its outputs.
fn written(result: &Results, outputs: &mut impl Iterator<Item = TokenStream>) -> (TokenStream, TokenStream) {
    let Results { rows, columns, .. } = result;
    let [row_count, column_count] = [*rows, *columns].map(count);
    let mut row = |count: usize| outputs.by_ref().take(count).collect::<Vec<_>>();
    match (result.is_scalar(), columns) {
        (true, _) => {
            let value = row(1);
            (quote!(f64), quote!(#(#value)*))
        }
        (_, 1) => {
            let values = row(*rows);
            (quote!([f64; #row_count]), quote!([#(#values),*]))
        }
        _ => {
            let matrix = (0..*rows).map(|_| {
                let values = row(*columns);
                quote!([#(#values),*])
            });
            let matrix: Vec<_> = matrix.collect();
            (quote!([[f64; #column_count]; #row_count]), quote!([#(#matrix),*]))
        }
    }
}

/// Functions of the user's own that programs call.
fn own_functions<'a>(programs: impl Iterator<Item = &'a Program>) -> Vec<Ident> {
    let called = programs.flat_map(|program| {
        let own = |instruction: &Instruction| match instruction {
            Instruction::Own(function, _) => Some(own_name(program, *function)),
            _ => None,
        };
        program.code.instructions.iter().filter_map(own)
    });
    called.collect::<BTreeSet<_>>().into_iter().collect()
}

fn own_name(program: &Program, function: OwnFunction) -> Ident {
    let name = snake(program.functions.get(usize::from(function.index)).map_or("own", String::as_str));
    ident(&(name + &function.suffix()))
}

fn ident(name: &str) -> Ident {
    Ident::new(name, Span::call_site())
}

fn count(numbers: usize) -> Literal {
    Literal::usize_unsuffixed(numbers)
}

struct PlainDialect<'a> {
    program: &'a Program,
}

impl Dialect<Input> for PlainDialect<'_> {
    fn input(&self, input: Input) -> TokenStream {
        match input {
            Input::Number(number) => literal(self.program.numbers[number]),
            Input::Component { argument, component } => {
                let Argument { kind, name, .. } = &self.program.arguments[argument];
                let (name, component) = (ident(name), Literal::usize_unsuffixed(component));
                if *kind == ArgumentKind::Time { quote!(#name) } else { quote!(#name[#component]) }
            }
        }
    }

    fn number(&self, value: &Rational) -> TokenStream {
        match value.parts().filter(|_| !value.is_dyadic()) {
            Some((numerator, denominator)) => {
                let (numerator, denominator) = (literal(numerator as f64), literal(denominator as f64));
                quote!((#numerator / #denominator))
            }
            None => literal(value.to_f64()),
        }
    }

    fn functions(&self) -> TokenStream {
        quote!(arithmetic)
    }

    fn own_function(&self, own: OwnFunction, arguments: &[TokenStream]) -> TokenStream {
        let name = own_name(self.program, own);
        quote!(#name(#(#arguments),*))
    }

    fn apart(&self) -> Option<TokenStream> {
        None
    }
}

/// The shortest digits that read back the same number; beyond the range of `f64` infinity.
fn literal(value: f64) -> TokenStream {
    match value.is_finite() {
        true if value.is_sign_negative() => {
            let literal = Literal::f64_suffixed(-value);
            quote!((-#literal))
        }
        true => {
            let literal = Literal::f64_suffixed(value);
            quote!(#literal)
        }
        false if value > 0.0 => quote!(f64::INFINITY),
        false => quote!(f64::NEG_INFINITY),
    }
}
