//! Packed code as statements: vectors by functions of the runtime, everything else as ever.

use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote};

use super::{
    Dialect, NamedResults, angles_together, in_order, operand, pairs_read, row_of_angles, rows_of_angles, statement,
    value,
};
use crate::program::{Code, InputPlace, Instruction, LANES, Operand, Operation, Pack, PackedCode, PackedStep};

/// Tokens of vectors.
pub(crate) trait Vectors<S> {
    /// Path of their functions.
    fn functions(&self) -> TokenStream;
    /// The array in which these stand in memory, where they are constants.
    fn row(&self, operands: &[Operand<S>]) -> Option<TokenStream>;
    /// Tokens that stand in memory behind an input.
    fn behind(&self, input: S) -> Option<TokenStream>;
}

fn vector(pack: usize) -> Ident {
    format_ident!("__p{}", pack, span = Span::mixed_site())
}

/// The name of a lane: of those that are used that of the instruction's result.
fn lane(packed: &[usize], pack: usize, lane: usize) -> Ident {
    let unused = || format_ident!("__p{}_{}", pack, lane, span = Span::mixed_site());
    packed.get(lane).map_or_else(unused, |&k| value(k))
}

/// Code with packs where these win, and its packs.
pub(crate) fn packed<S: Copy + PartialEq>(
    code: &Code<S>,
    dialect: &impl Dialect<S>,
    place: impl Fn(S) -> InputPlace,
) -> Option<(Code<S>, PackedCode<S>)> {
    let code = in_order(code, dialect);
    let packed = code.packed(place, &rows_of_angles(&code))?;
    Some((code, packed))
}

/// The statements of packed code, and its outputs as expressions.
pub(crate) fn statements<S: Copy + PartialEq>(
    code: &Code<S>,
    packed: &PackedCode<S>,
    dialect: &impl Dialect<S>,
    vectors: &impl Vectors<S>,
) -> (TokenStream, Vec<TokenStream>) {
    let (read, apart) = (pairs_read(code, NamedResults::AsRead), taken_apart(code, packed));
    let step = |step: &PackedStep| match *step {
        PackedStep::Instruction(k) => statement(k, &code.instructions[k], read[k], dialect).bound(),
        PackedStep::Angles(first, count) => {
            let (angles, read) = (row_of_angles(code, first), &read[first..]);
            debug_assert_eq!(angles.len(), count, "a row of angles");
            let function = dialect.sines_and_cosines().unwrap_or_default();
            angles_together(first, &angles, read, &function, dialect).bound()
        }
        PackedStep::Pack(p) => {
            let Pack { operation, lanes, operands } = &packed.packs[p];
            let operands = operands.iter().map(|operands| gathered(operands, packed, dialect, vectors));
            let (name, operation, functions) = (vector(p), function(*operation), vectors.functions());
            let lanes = (0..LANES).map(|k| lane(lanes, p, k));
            let apart = apart[p].then(|| quote!(let [#(#lanes),*] = #functions::lanes(#name);));
            quote!(let #name = #functions::#operation(#(#operands),*); #apart)
        }
    };
    let outputs = code.outputs.iter().map(|output| operand(output, dialect)).collect();
    (packed.steps.iter().map(step).collect(), outputs)
}

pub(super) fn function(operation: Operation) -> Ident {
    let name = match operation {
        Operation::Add => "sum",
        Operation::Subtract => "difference",
        Operation::Multiply => "product",
        Operation::MultiplyAdd => "product_plus",
        Operation::MultiplySubtract => "less_product",
        Operation::Negate => "negative",
    };
    Ident::new(name, Span::call_site())
}

/// The pack that all of these are lanes of, and whether they are in place.
fn in_one_pack<S: Copy + PartialEq>(operands: &[Operand<S>], packed: &PackedCode<S>) -> Option<(usize, bool)> {
    let place = |operand: &Operand<S>| match *operand {
        Operand::Value(k) => packed.packs.iter().enumerate().find_map(|(p, pack)| {
            let lane = pack.lanes.iter().position(|&lane| lane == k)?;
            Some((p, lane))
        }),
        _ => None,
    };
    let places: Vec<(usize, usize)> = operands.iter().map(place).collect::<Option<_>>()?;
    let is_one = places.iter().all(|(p, _)| *p == places[0].0);
    is_one.then(|| (places[0].0, places.iter().enumerate().all(|(lane, (_, of))| *of == lane)))
}

/// Whether lanes of each pack are read one by one.
fn taken_apart<S: Copy + PartialEq>(code: &Code<S>, packed: &PackedCode<S>) -> Vec<bool> {
    let mut read = vec![false; code.instructions.len()];
    let mut note = |operand: Operand<S>| {
        if let Operand::Value(k) = operand {
            read[k] = true;
        }
    };
    for step in &packed.steps {
        match *step {
            PackedStep::Instruction(k) => code.instructions[k].operands().for_each(&mut note),
            PackedStep::Angles(first, count) => {
                code.instructions[first..first + count].iter().flat_map(Instruction::operands).for_each(&mut note);
            }
            PackedStep::Pack(p) => {
                let vectors = packed.packs[p].operands.iter();
                let in_place = |vector: &&Vec<Operand<S>>| matches!(in_one_pack(vector, packed), Some((_, true)));
                vectors.filter(|vector| !in_place(vector)).flatten().copied().for_each(&mut note);
            }
        }
    }
    code.outputs.iter().copied().for_each(&mut note);
    packed.packs.iter().map(|pack| pack.lanes.iter().any(|&k| read[k])).collect()
}

/// An operand of a pack: a vector that is there, a row of constants, or what lanes are gathered from.
fn gathered<S: Copy + PartialEq>(
    operands: &[Operand<S>],
    packed: &PackedCode<S>,
    dialect: &impl Dialect<S>,
    vectors: &impl Vectors<S>,
) -> TokenStream {
    let functions = vectors.functions();
    let numbers = |operands: &[Operand<S>]| operands.iter().map(|o| operand(o, dialect)).collect::<Vec<_>>();
    if operands.iter().all(|operand| *operand == operands[0]) {
        let number = operand(&operands[0], dialect);
        return quote!(#functions::spread(#number));
    }
    if let Some(row) = vectors.row(operands) {
        return row;
    }
    let of_one = in_one_pack(operands, packed);
    if let Some((p, true)) = of_one {
        let name = vector(p);
        return quote!(#name);
    }
    let mut written = numbers(operands);
    // What is in a lane that nobody uses is whatever costs least: the lane in place, the next number in memory.
    while written.len() < LANES {
        let last = match (of_one, operands[operands.len() - 1]) {
            (Some((p, _)), _) => {
                let name = lane(&packed.packs[p].lanes, p, written.len());
                quote!(#name)
            }
            (None, Operand::Input(input)) if written.len() == operands.len() => {
                vectors.behind(input).unwrap_or_else(|| written[written.len() - 1].clone())
            }
            _ => written[written.len() - 1].clone(),
        };
        written.push(last);
    }
    quote!(#functions::vector([#(#written),*]))
}
