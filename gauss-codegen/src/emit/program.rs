//! Instructions as `let` statements: no loops, no branches, no allocation.

use std::collections::BTreeSet;

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};

use crate::algebra::{BinaryFunction, Function, Map, OwnFunction, Rational};
use crate::kernel::{Operand, Operation, Program};
use crate::model::{FunctionClause, FunctionKind, Scalar};

/// How numbers are written for a scalar type.
pub struct ScalarTokens<'a> {
    pub scalar: &'a Scalar,
    /// `::gauss_runtime::real::Real`.
    pub real: TokenStream,
    /// A product and a sum. For primitive types a function of its own: compilers look for an implementation at every call of a
    /// trait's, which was half of the time in which they checked types.
    pub fma: TokenStream,
    /// `::gauss_runtime::__private::apart`.
    pub apart: TokenStream,
    /// Functions of the user's own.
    pub functions: &'a [FunctionClause],
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

    /// A number, exactly where the scalar can hold it.
    pub fn number(&self, value: &Rational) -> TokenStream {
        let (real, ty) = (&self.real, self.ty());
        let ratio = |p: i64, q: i64| quote!(<#ty as #real>::ratio(#p, #q));
        match (self.scalar, value.parts()) {
            (Scalar::F64 | Scalar::F32, None) => self.literal(value.to_f64()),
            (Scalar::F64 | Scalar::F32, _) if value.is_dyadic() => self.literal(value.to_f64()),
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

/// Name of the result of an instruction. Underscores keep it apart from constants of the user's, which a `let` must not
/// shadow.
fn value(k: usize) -> Ident {
    format_ident!("__v{}", k, span = Span::mixed_site())
}

fn sine(k: usize) -> Ident {
    format_ident!("__s{}", k, span = Span::mixed_site())
}

fn cosine(k: usize) -> Ident {
    format_ident!("__c{}", k, span = Span::mixed_site())
}

/// How an operand is written. `symbols` says how each symbol is.
pub fn operand(operand: &Operand<'_>, symbols: &Map<u32, TokenStream>, scalar: &ScalarTokens<'_>) -> TokenStream {
    match operand {
        Operand::Input(e) => symbols.get(&e.key()).cloned().unwrap_or_else(|| {
            // A program reads only symbols that its caller declared; anything else is a bug in this crate.
            let message = format!("bug in gauss-derive: the symbol `{e:?}` has no source");
            quote!(::core::compile_error!(#message))
        }),
        Operand::Number(n) => scalar.number(n),
        Operand::Value(k) => {
            let name = value(*k);
            quote!(#name)
        }
        Operand::Sine(k) => {
            let name = sine(*k);
            quote!(#name)
        }
        Operand::Cosine(k) => {
            let name = cosine(*k);
            quote!(#name)
        }
    }
}

/// Instructions in a row. Every `let` is a scope within that of the one before it, and compilers recurse into them: thousands overflow
/// their stacks. Longer programs are written in blocks that hand on what later ones need.
const BLOCK: usize = 256;

/// Instructions up to which a program is one function for the compiler, whose time grows faster than the function does.
const WHOLE: usize = 16_384;

/// Instructions of each function that a longer program is split into.
const PART: usize = 8 * BLOCK;

/// The statements of a program, and its outputs as expressions. `symbols` says how each symbol is written.
pub fn statements(
    program: &Program<'_>,
    symbols: &Map<u32, TokenStream>,
    scalar: &ScalarTokens<'_>,
) -> (TokenStream, Vec<TokenStream>) {
    statements_kept(program, symbols, scalar, Kept::AsRead)
}

/// What of the results of a program has a name afterwards.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Kept {
    /// What the program itself reads, and its outputs.
    AsRead,
    /// All of it.
    Everything,
}

/// The same, with names for whatever is to be read besides.
pub fn statements_kept<'g>(
    program: &Program<'g>,
    symbols: &Map<u32, TokenStream>,
    scalar: &ScalarTokens<'_>,
    kept: Kept,
) -> (TokenStream, Vec<TokenStream>) {
    let read = pairs_read(program, kept);
    let instructions = program.instructions.iter().enumerate();
    let written = instructions.map(|(k, instruction)| statement(k, instruction, read[k], symbols, scalar));
    (
        in_functions(program, kept, written.collect(), scalar),
        program.outputs.iter().map(|output| operand(output, symbols, scalar)).collect(),
    )
}

/// One instruction; of a sine and a cosine what is read.
fn statement(
    k: usize,
    instruction: &Operation<'_>,
    [sine_read, cosine_read]: [bool; 2],
    symbols: &Map<u32, TokenStream>,
    scalar: &ScalarTokens<'_>,
) -> TokenStream {
    let (real, fma) = (&scalar.real, &scalar.fma);
    let write = |o: &Operand<'_>| operand(o, symbols, scalar);
    let name = value(k);
    match instruction {
        Operation::Add(a, b) => binary(&name, &write(a), &quote!(+), &write(b)),
        Operation::Subtract(a, b) => binary(&name, &write(a), &quote!(-), &write(b)),
        Operation::Multiply(a, b) => binary(&name, &write(a), &quote!(*), &write(b)),
        Operation::Divide(a, b) => binary(&name, &write(a), &quote!(/), &write(b)),
        Operation::MultiplyAdd(a, b, c) => {
            let (a, b, c) = (write(a), write(b), write(c));
            quote!(let #name = #fma(#a, #b, #c);)
        }
        Operation::MultiplySubtract(a, b, c) => {
            let (a, b, c) = (write(a), write(b), write(c));
            quote!(let #name = #fma(-#a, #b, #c);)
        }
        Operation::Negate(a) => {
            let a = write(a);
            quote!(let #name = -#a;)
        }
        Operation::Call(Function::Own(own), a) => {
            let (a, function) = (write(a), own_function(scalar, *own));
            quote!(let #name = #function(#a);)
        }
        Operation::Call(function, a) => {
            let (a, function) = (write(a), function_name(*function));
            quote!(let #name = #real::#function(#a);)
        }
        Operation::Binary(function, a, b) => {
            let (a, b) = (write(a), write(b));
            let function = match function {
                BinaryFunction::Atan2 => quote!(atan2),
                BinaryFunction::Min => quote!(min),
                BinaryFunction::Max => quote!(max),
                BinaryFunction::Powf => quote!(powf),
            };
            quote!(let #name = #real::#function(#a, #b);)
        }
        Operation::SineCosine(a) => {
            let (a, s, c) = (write(a), sine(k), cosine(k));
            let s = if sine_read { quote!(#s) } else { quote!(_) };
            let c = if cosine_read { quote!(#c) } else { quote!(_) };
            quote!(let (#s, #c) = #real::sin_cos(#a);)
        }
    }
}

/// Whether the sine and the cosine of each instruction are read.
fn pairs_read(program: &Program<'_>, kept: Kept) -> Vec<[bool; 2]> {
    let mut read = vec![[kept == Kept::Everything; 2]; program.instructions.len()];
    for operand in program.operands() {
        match operand {
            Operand::Sine(k) => read[k][0] = true,
            Operand::Cosine(k) => read[k][1] = true,
            _ => {}
        }
    }
    read
}

/// The names that each instruction hands on to instructions of later blocks, or to whoever reads on.
fn handed_on(program: &Program<'_>, kept: Kept, size: usize) -> Vec<Vec<TokenStream>> {
    // Values, sines and cosines by the index of their instruction.
    let mut read = vec![BTreeSet::new(); program.instructions.len()];
    let mut note = |operand: Operand<'_>, reader: usize| {
        if let Operand::Value(k) | Operand::Sine(k) | Operand::Cosine(k) = operand
            && k / size < reader
        {
            let kind = match operand {
                Operand::Sine(_) => 1,
                Operand::Cosine(_) => 2,
                _ => 0,
            };
            read[k].insert(kind);
        }
    };
    for (k, instruction) in program.instructions.iter().enumerate() {
        instruction.operands().for_each(|operand| note(operand, k / size));
        if kept == Kept::Everything {
            match instruction {
                Operation::SineCosine(_) => [Operand::Sine(k), Operand::Cosine(k)].map(|o| note(o, usize::MAX)),
                _ => [note(Operand::Value(k), usize::MAX); 2],
            };
        }
    }
    program.outputs.iter().for_each(|operand| note(*operand, usize::MAX));
    let names = [value, sine, cosine];
    let named = |(k, kinds): (usize, BTreeSet<usize>)| {
        let name = |kind: usize| {
            let name = names[kind](k);
            quote!(#name)
        };
        kinds.into_iter().map(name).collect()
    };
    read.into_iter().enumerate().map(named).collect()
}

/// Statements in blocks; of long programs in functions, each with some blocks, which the compiler does not put together again.
fn in_functions(
    program: &Program<'_>,
    kept: Kept,
    written: Vec<TokenStream>,
    ScalarTokens { apart, .. }: &ScalarTokens<'_>,
) -> TokenStream {
    let mut statements: Vec<_> = handed_on(program, kept, BLOCK).into_iter().zip(written).collect();
    if statements.len() <= WHOLE {
        return in_blocks(statements);
    }
    let handed_on = handed_on(program, kept, PART);
    let parts = handed_on.chunks(PART).map(|names| {
        let names: Vec<_> = names.iter().flatten().collect();
        let rest = statements.split_off(PART.min(statements.len()));
        let part = in_blocks(std::mem::replace(&mut statements, rest));
        quote!(let (#(#names,)*) = #apart(|| { #part (#(#names,)*) });)
    });
    parts.collect()
}

/// Statements, each with the names that are read behind its block: one after the other, or block by block where there are many.
pub fn in_blocks(statements: Vec<(Vec<TokenStream>, TokenStream)>) -> TokenStream {
    if statements.len() <= BLOCK {
        return statements.into_iter().map(|(_, statement)| statement).collect();
    }
    let blocks = statements.chunks(BLOCK).map(|block| {
        let names: Vec<_> = block.iter().flat_map(|(names, _)| names).collect();
        let statements = block.iter().map(|(_, statement)| statement);
        quote!(let (#(#names,)*) = { #(#statements)* (#(#names,)*) };)
    });
    blocks.collect()
}

/// How a function of the user's own, or a derivative of it, is called: by its path, or as a method of a table.
fn own_function(scalar: &ScalarTokens<'_>, own: OwnFunction) -> TokenStream {
    let order = usize::from(own.order);
    match &scalar.functions[usize::from(own.index)].kind {
        // That the derivative is there was checked.
        FunctionKind::Rust(paths) => paths.get(order).map_or_else(TokenStream::new, |path| quote!(#path)),
        FunctionKind::Linear(_) | FunctionKind::Cubic(_) => {
            let (table, method) = (table_name(own.index), ["value", "slope", "second", "third"].get(order));
            let method = Ident::new(method.copied().unwrap_or("third"), Span::call_site());
            quote!(#table.#method)
        }
    }
}

/// The constant that holds a table.
pub fn table_name(index: u16) -> Ident {
    format_ident!("__TABLE_{}", index, span = Span::mixed_site())
}

fn function_name(function: Function) -> Ident {
    let name = match function {
        Function::Sin => "sin",
        Function::Cos => "cos",
        Function::Exp => "exp",
        Function::Ln => "ln",
        Function::Sqrt => "sqrt",
        Function::Abs => "abs",
        Function::Signum => "signum",
        Function::Tanh => "tanh",
        Function::Own(_) => unreachable!("functions of the user's own have paths"),
    };
    Ident::new(name, Span::call_site())
}

fn binary(name: &Ident, a: &TokenStream, operator: &TokenStream, b: &TokenStream) -> TokenStream {
    quote!(let #name = #a #operator #b;)
}
