//! C99: one function of doubles or floats a program, which needs nothing but `<math.h>` and keeps nothing.
//!
//! Arguments are arrays, but for the time; those without components are left out. A program whose only result is a
//! number returns it, others write their results into the arrays that come last, matrices row after row, after
//! everything is computed: a result may overwrite an argument. Numbers are written without loss. Whether products are
//! fused with sums is the compiler's choice (`-ffp-contract`). Parameters are not checked: what `kernel()` refuses in
//! Rust gives infinities or NaN here.
//!
//! ```
//! use gauss_codegen::targets::c::{self, Precision};
//!
//! let top = "#[gauss(motion = fixed_point)] struct Top { #[gauss(mass)] m: f64, #[gauss(inertia)] i: Vector3<f64> }";
//! let top = gauss_codegen::Derivation::of_source(top, "Top")?;
//! let code = c::source(top.functions(), Precision::Double)?;
//! assert!(code.contains("void top_acceleration("));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use std::collections::BTreeSet;
use std::fmt::Write;

use crate::algebra::{BinaryFunction, Function, OwnFunction};
use crate::program::{Argument, ArgumentKind, Functions, Input, Instruction, Operand, Program, Results};

pub use header::header;
pub use range::BeyondRange;
pub(super) use real::Real;

use super::{is_handed_over, only_scalar, snake};

mod header;
mod range;
mod real;

/// Characters of arguments that still stand in one line.
const LINE: usize = 88;

/// The type of all numbers of a source file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// `double`.
    #[default]
    Double,
    /// `float`: for processors that have no other unit. Nothing is promoted to `double`.
    Single,
}

impl From<Precision> for Real {
    fn from(precision: Precision) -> Self {
        match precision {
            Precision::Double => Self::Double,
            Precision::Single => Self::Single,
        }
    }
}

/// A source file with all programs of a struct: the constants, then every method. Functions are named after the struct
/// and the method, `heavy_top_acceleration`.
///
/// # Errors
/// [`BeyondRange`]: numbers of the scene that a `float` does not hold.
pub fn source(functions: &Functions, precision: Precision) -> Result<String, BeyondRange> {
    let (prefix, real) = (snake(&functions.name), Real::from(precision));
    BeyondRange::check(functions, real)?;
    let mut out = start(&functions.equations, functions.programs(), real);
    for program in functions.programs() {
        write!(out, "\n{}", defined(program, &prefix, real)).ok();
    }
    Ok(out)
}

/// Equations, and functions that programs call: they stand before the programs.
pub(super) fn beginning<'a>(equations: &str, programs: impl Iterator<Item = &'a Program> + Clone) -> String {
    start(equations, programs, Real::Double)
}

fn start<'a>(equations: &str, programs: impl Iterator<Item = &'a Program> + Clone, real: Real) -> String {
    let mut out = comment(equations);
    out.push_str("#include <math.h>\n");
    if programs.clone().any(calls_signum) {
        write!(out, "\nstatic {}", signum(real)).ok();
    }
    let own = own_functions(programs, real);
    if !own.is_empty() {
        write!(out, "\n/* To be provided: functions of the scene, name_n their n-th derivatives. */\n{own}").ok();
    }
    out
}

/// The sign, which the library of C lacks: zero of zero, NaN of NaN.
pub(super) fn signum(real: Real) -> String {
    let (name, number) = (real.name(), |value| real.literal(value));
    let [zero, one, less] = [0.0, 1.0, -1.0].map(number);
    format!("{name} gauss_signum({name} x)\n{{\n    return (x > {zero}) ? {one} : ((x < {zero}) ? {less} : x);\n}}\n")
}

/// One function of doubles, with what it takes, gives and costs in a comment.
pub fn function(program: &Program, prefix: &str) -> String {
    defined(program, prefix, Real::Double)
}

fn defined(program: &Program, prefix: &str, real: Real) -> String {
    let mut out = description(program);
    write!(out, "{}\n{}", signature(program, prefix, real), body(program, "", real)).ok();
    out
}

/// Describes what a function takes, gives and costs, as a comment.
pub(super) fn description(program: &Program) -> String {
    comment(&super::header(program, |result| result_name(program, result)))
}

/// The statements of a function in its brackets, behind those that are given.
pub(super) fn body(program: &Program, before: &str, real: Real) -> String {
    let mut out = format!("{{\n{before}");
    let read = program.code.inputs();
    for (index, argument) in program.arguments.iter().enumerate().filter(|(_, argument)| is_handed_over(argument)) {
        let reads = |input: &Input| matches!(input, Input::Component { argument, .. } if *argument == index);
        if !read.iter().any(reads) {
            writeln!(out, "    (void){};", argument.name).ok();
        }
    }
    let operands: Vec<Operand> = program.code.operands().collect();
    for (k, instruction) in program.code.instructions.iter().enumerate() {
        out.push_str(&statement(program, (k, instruction), &operands, real));
    }
    let mut outputs = program.code.outputs.iter().map(|output| operand(program, output, real));
    match only_scalar(program) {
        true => writeln!(out, "    return {};", outputs.next().unwrap_or_default()).ok(),
        false => program.results.iter().try_for_each(|result| {
            let mut values = outputs.by_ref().take(result.len()).enumerate();
            values.try_for_each(|(k, value)| writeln!(out, "    {}[{k}] = {value};", result_name(program, result)).ok())
        }),
    };
    out.push_str("}\n");
    out
}

/// The same, which no other file sees.
pub fn static_function(program: &Program, prefix: &str) -> String {
    // Behind the comment, in which no other `*/` is.
    function(program, prefix).replacen(" */\n", " */\nstatic ", 1)
}

/// Results of the same name as an argument, and as the function itself, are kept apart from them.
pub(super) fn result_name(program: &Program, result: &Results) -> String {
    let taken = program.arguments.iter().any(|argument| argument.name == result.name);
    if taken { format!("{}_out", result.name) } else { result.name.clone() }
}

fn signature(program: &Program, prefix: &str, real: Real) -> String {
    let number = real.name();
    let arguments = program.arguments.iter().filter(|argument| is_handed_over(argument)).map(|argument| {
        let Argument { kind, name, components } = argument;
        match kind {
            ArgumentKind::Time => format!("{number} {name}"),
            _ => format!("const {number} {name}[{}]", components.len()),
        }
    });
    let returns = only_scalar(program);
    let results = program.results.iter().filter(|result| !returns && result.len() > 0);
    let results = results.map(|result| format!("{number} {}[{}]", result_name(program, result), result.len()));
    let all: Vec<String> = arguments.chain(results).collect();
    let kind = if returns { number } else { "void" };
    let one_line = if all.is_empty() { "void".to_owned() } else { all.join(", ") };
    let lines = if one_line.len() <= LINE { one_line } else { format!("\n    {}", all.join(",\n    ")) };
    format!("{kind} {prefix}_{}({lines})", program.name)
}

/// Writes a comment in which nothing of the text ends it early.
pub(super) fn comment(text: &str) -> String {
    let text = text.replace("*/", "* /").replace("/*", "/ *").replace('\\', "/");
    let lines = text.lines().map(|line| format!(" * {line}").trim_end().to_owned() + "\n");
    format!("/*\n{} */\n", lines.collect::<String>())
}

pub(super) fn calls_signum(program: &Program) -> bool {
    let signum = |instruction: &Instruction| matches!(instruction, Instruction::Call(Function::Signum, _));
    program.code.instructions.iter().any(signum)
}

/// The declaration of the results of an instruction; of a pair only those that are read.
fn statement(program: &Program, (k, instruction): (usize, &Instruction), operands: &[Operand], real: Real) -> String {
    let of = |o: &Operand| operand(program, o, real);
    let (number, called) = (real.name(), |name: &str| real.function(name));
    let value = match instruction {
        Instruction::Add(a, b) => format!("{} + {}", of(a), of(b)),
        Instruction::Subtract(a, b) => format!("{} - {}", of(a), of(b)),
        Instruction::Multiply(a, b) => format!("{} * {}", of(a), of(b)),
        // In brackets that nobody has to think of precedence, as checkers of rules for safety want them.
        Instruction::MultiplyAdd(a, b, c) => format!("({} * {}) + {}", of(a), of(b), of(c)),
        Instruction::MultiplySubtract(a, b, c) => format!("{} - ({} * {})", of(c), of(a), of(b)),
        Instruction::Divide(a, b) => format!("{} / {}", of(a), of(b)),
        Instruction::Negate(a) => format!("-{}", of(a)),
        // Next to each other, so that compilers make one call of them.
        Instruction::SineCosine(a) => {
            let parts = [(called("sin"), Operand::Sine(k)), (called("cos"), Operand::Cosine(k))];
            let read = parts.into_iter().filter(|(_, part)| operands.contains(part));
            let written = read.map(|(name, part)| format!("{} = {name}({})", of(&part), of(a)));
            return format!("    const {number} {};\n", written.collect::<Vec<_>>().join(", "));
        }
        Instruction::Call(function, a) => format!("{}({})", name(*function, real), of(a)),
        Instruction::Binary(function, a, b) => {
            format!("{}({}, {})", called(library_name_of_two(*function)), of(a), of(b))
        }
        Instruction::Own(function, arguments) => {
            let arguments: Vec<String> = function.of(arguments).iter().map(of).collect();
            format!("{}({})", own_name(program, *function), arguments.join(", "))
        }
    };
    format!("    const {number} v{k} = {value};\n")
}

fn name(function: Function, real: Real) -> String {
    match function {
        Function::Signum => "gauss_signum".to_owned(),
        other => real.function(library_name(other)),
    }
}

/// The name in `<math.h>`.
pub(super) fn library_name(function: Function) -> &'static str {
    match function {
        Function::Ln => "log",
        Function::Abs => "fabs",
        _ => function.name(),
    }
}

pub(super) fn library_name_of_two(function: BinaryFunction) -> &'static str {
    match function {
        BinaryFunction::Atan2 => "atan2",
        BinaryFunction::Min => "fmin",
        BinaryFunction::Max => "fmax",
        BinaryFunction::Powf => "pow",
    }
}

/// A function of the user's own, which whoever links the code provides: `lift`, its derivatives `lift_1`, `lift_2`; of
/// several variables with the order by each, `drag_1_0`.
fn own_name(program: &Program, function: OwnFunction) -> String {
    let name = snake(program.functions.get(usize::from(function.index)).map_or("own", String::as_str));
    name + &function.suffix()
}

/// Declarations of the functions of the user's own that programs call.
pub(super) fn own_functions<'a>(programs: impl Iterator<Item = &'a Program>, real: Real) -> String {
    let called = programs.flat_map(|program| {
        let own = |instruction: &Instruction| match instruction {
            Instruction::Own(function, _) => Some((own_name(program, *function), function.variables)),
            _ => None,
        };
        program.code.instructions.iter().filter_map(own)
    });
    let names: BTreeSet<(String, u8)> = called.collect();
    let number = real.name();
    let declared = |(name, variables): (String, u8)| {
        let arguments = ["x", "y", "z"][..usize::from(variables)].iter().map(|name| format!("{number} {name}"));
        format!("{}{number} {name}({});\n", real.template(), arguments.collect::<Vec<_>>().join(", "))
    };
    names.into_iter().map(declared).collect()
}

fn operand(program: &Program, operand: &Operand, real: Real) -> String {
    match *operand {
        Operand::Input(Input::Number(number)) => real.literal(program.numbers[number]),
        Operand::Input(Input::Component { argument, component }) => {
            let Argument { kind, name, .. } = &program.arguments[argument];
            if *kind == ArgumentKind::Time { name.clone() } else { format!("{name}[{component}]") }
        }
        Operand::Number(value) => real.fraction(value),
        Operand::Value(k) => format!("v{k}"),
        Operand::Sine(k) => format!("s{k}"),
        Operand::Cosine(k) => format!("c{k}"),
    }
}
