//! Instructions as `let` statements of Rust: no loops, no branches, no allocation.
//!
//! What inputs, numbers and functions are called is its `Dialect`: kernels read symbols and are generic over the scalar
//! (`emit`), functions that stand alone read arrays of `f64` (`plain`).

use proc_macro2::{Delimiter, Group, Ident, Span, TokenStream, TokenTree};
use quote::{ToTokens, quote};

use crate::algebra::{BinaryFunction, Function, OwnFunction, Rational};
use crate::program::{Code, Instruction, Operand};

pub(crate) mod limbs;
pub(crate) mod packed;
mod plain;

pub use plain::source;

/// Tokens of the operands and functions of code.
pub(crate) trait Dialect<S> {
    /// An input.
    fn input(&self, input: S) -> TokenStream;
    /// A number, exactly where the scalar can hold it.
    fn number(&self, value: &Rational) -> TokenStream;
    /// Path of functions of numbers: `sin_cos`, `fma` and so on are looked for in it.
    fn functions(&self) -> TokenStream;
    /// The function of a product and a sum.
    fn fma(&self) -> TokenStream {
        let functions = self.functions();
        quote!(#functions::fma)
    }
    /// The function of sines and cosines of several angles; nothing: they are computed one by one.
    fn sines_and_cosines(&self) -> Option<TokenStream> {
        None
    }
    /// The value of a function of the user's own, or of a derivative of it.
    fn own_function(&self, own: OwnFunction, arguments: &[TokenStream]) -> TokenStream;
    /// Function that calls a closure as a function of its own, which the compiler keeps apart; nothing: programs stay
    /// whole.
    fn apart(&self) -> Option<TokenStream>;
}

/// Name of the result of an instruction. Underscores keep it apart from constants of the user's, which a `let` must not
/// shadow.
fn value(k: usize) -> Ident {
    Ident::new(&format!("__v{k}"), Span::mixed_site())
}

fn sine(k: usize) -> Ident {
    Ident::new(&format!("__s{k}"), Span::mixed_site())
}

fn cosine(k: usize) -> Ident {
    Ident::new(&format!("__c{k}"), Span::mixed_site())
}

/// Tokens of an operand.
pub(crate) fn operand<S: Copy>(operand: &Operand<S>, dialect: &impl Dialect<S>) -> TokenStream {
    match *operand {
        Operand::Input(input) => dialect.input(input),
        Operand::Number(n) => dialect.number(&n),
        Operand::Value(k) => value(k).into_token_stream(),
        Operand::Sine(k) => sine(k).into_token_stream(),
        Operand::Cosine(k) => cosine(k).into_token_stream(),
    }
}

/// Instructions in a row. Every `let` is a scope within that of the one before it, and compilers recurse into them:
/// thousands overflow their stacks. Longer programs are written in blocks. What later ones read is declared before its
/// block and assigned in it: a tuple that a block hands on is taken apart by rustc, one component after the other, in a
/// function of a hundred thousand statements, which took four of twenty seconds for a humanoid's derivatives.
const BLOCK: usize = 256;

/// Angles whose sines and cosines are computed together: as many as fill the longest vectors that there are.
const TOGETHER: usize = 8;

/// Instructions up to which a program is one function for the compiler. What parts hand on to one another is stored and
/// loaded once more: derivatives of a biped, 22,000 instructions, took a third longer in parts.
const WHOLE: usize = 65_536;

/// Instructions of each function that a longer program is split into.
const PART: usize = 8 * BLOCK;

/// Parts of the results of a program that have a name afterwards.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum NamedResults {
    /// Results that the program itself reads, and its outputs.
    AsRead,
    /// All of it.
    Everything,
}

/// The statements of a program, and its outputs as expressions.
pub(crate) fn statements<S: Copy>(
    code: &Code<S>,
    dialect: &impl Dialect<S>,
    kept: NamedResults,
) -> (TokenStream, Vec<TokenStream>) {
    // Names of everything are known to the caller by their places.
    match kept {
        NamedResults::AsRead => in_this_order(&in_order(code, dialect), dialect, kept),
        NamedResults::Everything => in_this_order(code, dialect, kept),
    }
}

/// The code with sines and cosines that are computed together in a row.
fn in_order<S: Copy>(code: &Code<S>, dialect: &impl Dialect<S>) -> Code<S> {
    if dialect.sines_and_cosines().is_none() {
        return code.clone();
    }
    // By what they are called: q[1] before q[2] and q[10].
    let place = |input| {
        let name = dialect.input(input).to_string();
        (name.len(), name)
    };
    code.clone().with_angles_together(place)
}

/// Names that are bound, and to what.
pub(crate) struct Binding {
    pattern: TokenStream,
    value: TokenStream,
}

impl Binding {
    pub(crate) fn new(pattern: impl ToTokens, value: TokenStream) -> Binding {
        Binding { pattern: pattern.into_token_stream(), value }
    }

    fn bound(self) -> TokenStream {
        let mut tokens = quote!(let);
        tokens.extend(self.assigned());
        tokens
    }

    /// Assignment, where the names have been declared.
    fn assigned(self) -> TokenStream {
        // Moved, not copied: these are most of the tokens that there are.
        let mut tokens = self.pattern;
        tokens.extend(quote!(=));
        tokens.extend(self.value);
        tokens.extend(quote!(;));
        tokens
    }

    fn names(&self) -> Vec<Ident> {
        let mut names = Vec::new();
        collect_names(self.pattern.clone(), &mut names);
        names
    }
}

fn collect_names(pattern: TokenStream, names: &mut Vec<Ident>) {
    for token in pattern {
        match token {
            TokenTree::Ident(name) if name != "_" => names.push(name),
            TokenTree::Group(group) => collect_names(group.stream(), names),
            _ => {}
        }
    }
}

/// A line of a program: names that are read behind its block, and a statement unless another line's binds its names.
pub(crate) type Line = (Vec<Ident>, Option<Binding>);

fn in_this_order<S: Copy>(
    code: &Code<S>,
    dialect: &impl Dialect<S>,
    kept: NamedResults,
) -> (TokenStream, Vec<TokenStream>) {
    let read = pairs_read(code, kept);
    let together = dialect.sines_and_cosines();
    let mut written = Vec::with_capacity(code.instructions.len());
    while written.len() < code.instructions.len() {
        let k = written.len();
        if let (Instruction::SineCosine(_), Some(function)) = (&code.instructions[k], &together) {
            let row = row_of_angles(code, k);
            if row.len() > 1 {
                written.push(Some(angles_together(k, &row, &read[k..], function, dialect)));
                written.resize_with(k + row.len(), || None);
                continue;
            }
        }
        written.push(Some(statement(k, &code.instructions[k], read[k], dialect)));
    }
    (in_functions(code, kept, written, dialect), code.outputs.iter().map(|output| operand(output, dialect)).collect())
}

/// Sines and cosines that are computed together: of each row the first instruction, and how many there are.
pub(crate) fn rows_of_angles<S: Copy>(code: &Code<S>) -> Vec<(usize, usize)> {
    let (mut rows, mut k) = (Vec::new(), 0);
    while k < code.instructions.len() {
        let length = row_of_angles(code, k).len();
        if length > 1 {
            rows.push((k, length));
        }
        k += length.max(1);
    }
    rows
}

/// The angles of the sines and cosines in a row from instruction `first` on, none of which waits for another: at most
/// as many as are computed together, and all in one block.
fn row_of_angles<S: Copy>(code: &Code<S>, first: usize) -> Vec<Operand<S>> {
    let left = BLOCK - first % BLOCK;
    let row = code.instructions[first..].iter().take(left.min(TOGETHER)).map_while(|instruction| match instruction {
        Instruction::SineCosine(a) if a.instruction().is_none_or(|k| k < first) => Some(*a),
        _ => None,
    });
    row.collect()
}

/// Sines and cosines of several angles at once; of each what is read.
fn angles_together<S: Copy>(
    first: usize,
    angles: &[Operand<S>],
    read: &[[bool; 2]],
    function: &TokenStream,
    dialect: &impl Dialect<S>,
) -> Binding {
    let named = |(k, read): (usize, bool), name: fn(usize) -> Ident| {
        let name = name(first + k);
        if read { quote!(#name) } else { quote!(_) }
    };
    let part = |part: usize| read[..angles.len()].iter().map(move |read| read[part]).enumerate();
    let (sines, cosines) = (part(0).map(|k| named(k, sine)), part(1).map(|k| named(k, cosine)));
    let angles = angles.iter().map(|angle| operand(angle, dialect));
    Binding::new(quote!(([#(#sines),*], [#(#cosines),*])), quote!(#function([#(#angles),*])))
}

/// One instruction; of a sine and a cosine what is read.
fn statement<S: Copy>(
    k: usize,
    instruction: &Instruction<S>,
    [sine_read, cosine_read]: [bool; 2],
    dialect: &impl Dialect<S>,
) -> Binding {
    let write = |o: &Operand<S>| operand(o, dialect);
    let binary = |a: &Operand<S>, operator: TokenStream, b: &Operand<S>| {
        let (a, b) = (write(a), write(b));
        quote!(#a #operator #b)
    };
    let result = match instruction {
        Instruction::Add(a, b) => binary(a, quote!(+), b),
        Instruction::Subtract(a, b) => binary(a, quote!(-), b),
        Instruction::Multiply(a, b) => binary(a, quote!(*), b),
        Instruction::Divide(a, b) => binary(a, quote!(/), b),
        Instruction::MultiplyAdd(a, b, c) => {
            let (fma, a, b, c) = (dialect.fma(), write(a), write(b), write(c));
            quote!(#fma(#a, #b, #c))
        }
        Instruction::MultiplySubtract(a, b, c) => {
            let (fma, a, b, c) = (dialect.fma(), write(a), write(b), write(c));
            quote!(#fma(-#a, #b, #c))
        }
        Instruction::Negate(a) => {
            let a = write(a);
            quote!(-#a)
        }
        Instruction::Own(own, arguments) => {
            let arguments: Vec<TokenStream> = own.of(arguments).iter().map(write).collect();
            dialect.own_function(*own, &arguments)
        }
        Instruction::Call(function, a) => {
            let (real, a, function) = (dialect.functions(), write(a), function_name(*function));
            quote!(#real::#function(#a))
        }
        Instruction::Binary(function, a, b) => {
            let (real, a, b) = (dialect.functions(), write(a), write(b));
            let function = match function {
                BinaryFunction::Atan2 => quote!(atan2),
                BinaryFunction::Min => quote!(min),
                BinaryFunction::Max => quote!(max),
                BinaryFunction::Powf => quote!(powf),
            };
            quote!(#real::#function(#a, #b))
        }
        Instruction::SineCosine(a) => {
            let (real, a, s, c) = (dialect.functions(), write(a), sine(k), cosine(k));
            let s = if sine_read { quote!(#s) } else { quote!(_) };
            let c = if cosine_read { quote!(#c) } else { quote!(_) };
            return Binding::new(quote!((#s, #c)), quote!(#real::sin_cos(#a)));
        }
    };
    Binding::new(value(k), result)
}

/// Whether the sine and the cosine of each instruction are read.
fn pairs_read<S: Copy>(code: &Code<S>, kept: NamedResults) -> Vec<[bool; 2]> {
    let mut read = vec![[kept == NamedResults::Everything; 2]; code.instructions.len()];
    for operand in code.operands() {
        match operand {
            Operand::Sine(k) => read[k][0] = true,
            Operand::Cosine(k) => read[k][1] = true,
            _ => {}
        }
    }
    read
}

/// The names that each instruction hands on to instructions of later blocks, or to whoever reads on.
fn handed_on<S: Copy>(code: &Code<S>, kept: NamedResults, size: usize) -> Vec<Vec<Ident>> {
    // Of each instruction: value, sine and cosine.
    let mut read = vec![[false; 3]; code.instructions.len()];
    let mut note = |operand: Operand<S>, reader: usize| {
        let (k, kind) = match operand {
            Operand::Value(k) => (k, 0),
            Operand::Sine(k) => (k, 1),
            Operand::Cosine(k) => (k, 2),
            Operand::Input(_) | Operand::Number(_) => return,
        };
        if k / size < reader {
            read[k][kind] = true;
        }
    };
    for (k, instruction) in code.instructions.iter().enumerate() {
        for operand in instruction.operands() {
            note(operand, k / size);
        }
        if kept == NamedResults::Everything {
            match instruction {
                Instruction::SineCosine(_) => [Operand::Sine(k), Operand::Cosine(k)].map(|o| note(o, usize::MAX)),
                _ => [note(Operand::Value(k), usize::MAX); 2],
            };
        }
    }
    code.outputs.iter().for_each(|operand| note(*operand, usize::MAX));
    let names = [value, sine, cosine];
    let mut handed_on = Vec::with_capacity(read.len());
    for (k, kinds) in read.into_iter().enumerate() {
        let mut named = Vec::new();
        for (kind, read) in kinds.into_iter().enumerate() {
            if read {
                named.push(names[kind](k));
            }
        }
        handed_on.push(named);
    }
    handed_on
}

/// Statements in blocks; of long programs in functions, each with some blocks, which the compiler does not put together
/// again.
fn in_functions<S: Copy>(
    code: &Code<S>,
    kept: NamedResults,
    written: Vec<Option<Binding>>,
    dialect: &impl Dialect<S>,
) -> TokenStream {
    let mut statements: Vec<_> = handed_on(code, kept, BLOCK).into_iter().zip(written).collect();
    let Some(apart) = dialect.apart().filter(|_| statements.len() > WHOLE) else {
        return in_blocks(statements);
    };
    let handed_on = handed_on(code, kept, PART);
    let parts = handed_on.chunks(PART).map(|names| {
        let names: Vec<_> = names.iter().flatten().collect();
        let rest = statements.split_off(PART.min(statements.len()));
        let part = in_blocks(std::mem::replace(&mut statements, rest));
        quote!(let (#(#names,)*) = #apart(move || { #part (#(#names,)*) });)
    });
    parts.collect()
}

/// Statements one after the other, or block by block where there are many.
pub(crate) fn in_blocks(lines: Vec<Line>) -> TokenStream {
    if lines.len() <= BLOCK {
        return lines.into_iter().filter_map(|(_, statement)| statement).map(Binding::bound).collect();
    }
    let (mut blocks, mut left, mut lines) = (TokenStream::new(), lines.len(), lines.into_iter());
    while left > 0 {
        blocks.extend(block(lines.by_ref().take(BLOCK)));
        left = left.saturating_sub(BLOCK);
    }
    blocks
}

/// Lines of which the first has a statement: rows of angles are within one block.
fn block(lines: impl Iterator<Item = Line>) -> TokenStream {
    let (mut declared, mut statements) = (Vec::new(), TokenStream::new());
    let mut take = |(statement, is_read): (Binding, bool)| {
        if is_read {
            declared.extend(statement.names());
            statements.extend(statement.assigned());
        } else {
            statements.extend(statement.bound());
        }
    };
    // What binds names of several lines is read where one of these is.
    let mut open: Option<(Binding, bool)> = None;
    for (names, statement) in lines {
        match (statement, &mut open) {
            (Some(statement), _) => open.replace((statement, !names.is_empty())).into_iter().for_each(&mut take),
            (None, Some((_, is_read))) => *is_read |= !names.is_empty(),
            (None, None) => {}
        }
    }
    open.into_iter().for_each(take);
    let statements = Group::new(Delimiter::Brace, statements);
    quote! {
        let (#(#declared,)*);
        #statements
    }
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
    };
    Ident::new(name, Span::call_site())
}
