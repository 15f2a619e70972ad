//! C99: one function of doubles a program, which needs nothing but `<math.h>` and keeps nothing.
//!
//! Arguments are arrays, but for the time; those without components are left out. A program whose only result is a
//! number returns it, others write their results into the arrays that come last, matrices row after row, after
//! everything is computed: a result may overwrite an argument. Numbers are written without loss. Whether products are
//! fused with sums is the compiler's choice (`-ffp-contract`). Parameters are not checked: what `kernel()` refuses in
//! Rust gives infinities or NaN here.
//!
//! ```
//! let top = "#[gauss(motion = fixed_point)] struct Top { #[gauss(mass)] m: f64, #[gauss(inertia)] i: Vector3<f64> }";
//! let code = gauss_codegen::targets::c::source(gauss_codegen::Derivation::of_source(top, "Top")?.functions());
//! assert!(code.contains("void top_acceleration("));
//! # Ok::<(), syn::Error>(())
//! ```

use std::collections::BTreeSet;
use std::fmt::Write;

use crate::algebra::{BinaryFunction, Function, OwnFunction, Rational};
use crate::program::{Argument, ArgumentKind, Functions, Input, Instruction, Operand, Program, Results};

use super::{header, is_handed_over, only_scalar, snake};

/// Stands before the first function: the sign, which the library of C lacks. Zero of zero, NaN of NaN.
const SIGNUM: &str = "static double gauss_signum(double x)\n{\n    return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : x;\n}\n";

/// Characters of arguments that still stand in one line.
const LINE: usize = 88;

/// A source file with all programs of a struct: the constants, then every method. Functions are named after the struct
/// and the method, `heavy_top_acceleration`.
pub fn source(functions: &Functions) -> String {
    let prefix = snake(&functions.name);
    let mut out = beginning(&functions.equations, functions.programs());
    for program in functions.programs() {
        write!(out, "\n{}", function(program, &prefix)).ok();
    }
    out
}

/// Equations, and functions that programs call: they stand before the programs.
pub(super) fn beginning<'a>(equations: &str, programs: impl Iterator<Item = &'a Program> + Clone) -> String {
    let mut out = comment(equations);
    out.push_str("#include <math.h>\n");
    if programs.clone().any(calls_signum) {
        write!(out, "\n{SIGNUM}").ok();
    }
    let own = own_functions(programs);
    if !own.is_empty() {
        write!(out, "\n/* To be provided: functions of the scene, name_n their n-th derivatives. */\n{own}").ok();
    }
    out
}

/// The declarations of the same functions, for a header.
pub fn declarations(functions: &Functions) -> String {
    let prefix = snake(&functions.name);
    functions.programs().map(|program| format!("{};\n", signature(program, &prefix))).collect()
}

/// One function, with what it takes, gives and costs in a comment.
pub fn function(program: &Program, prefix: &str) -> String {
    let mut out = comment(&header(program, |result| result_name(program, result)));
    write!(out, "{}\n{{\n", signature(program, prefix)).ok();
    let read = program.code.inputs();
    for (index, argument) in program.arguments.iter().enumerate().filter(|(_, argument)| is_handed_over(argument)) {
        let reads = |input: &Input| matches!(input, Input::Component { argument, .. } if *argument == index);
        if !read.iter().any(reads) {
            writeln!(out, "    (void){};", argument.name).ok();
        }
    }
    let operands: Vec<Operand> = program.code.operands().collect();
    for (k, instruction) in program.code.instructions.iter().enumerate() {
        out.push_str(&statement(program, k, instruction, &operands));
    }
    let mut outputs = program.code.outputs.iter().map(|output| operand(program, output));
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

fn signature(program: &Program, prefix: &str) -> String {
    let arguments = program.arguments.iter().filter(|argument| is_handed_over(argument)).map(|argument| {
        let Argument { kind, name, components } = argument;
        match kind {
            ArgumentKind::Time => format!("double {name}"),
            _ => format!("const double {name}[{}]", components.len()),
        }
    });
    let returns = only_scalar(program);
    let results = program.results.iter().filter(|result| !returns && result.len() > 0);
    let results = results.map(|result| format!("double {}[{}]", result_name(program, result), result.len()));
    let all: Vec<String> = arguments.chain(results).collect();
    let kind = if returns { "double" } else { "void" };
    let one_line = if all.is_empty() { "void".to_owned() } else { all.join(", ") };
    let lines = if one_line.len() <= LINE { one_line } else { format!("\n    {}", all.join(",\n    ")) };
    format!("{kind} {prefix}_{}({lines})", program.name)
}

/// Writes a comment in which nothing of the text ends it early.
fn comment(text: &str) -> String {
    let text = text.replace("*/", "* /").replace("/*", "/ *").replace('\\', "/");
    let lines = text.lines().map(|line| format!(" * {line}").trim_end().to_owned() + "\n");
    format!("/*\n{} */\n", lines.collect::<String>())
}

fn calls_signum(program: &Program) -> bool {
    let signum = |instruction: &Instruction| matches!(instruction, Instruction::Call(Function::Signum, _));
    program.code.instructions.iter().any(signum)
}

/// The declaration of the results of an instruction; of a pair only those that are read.
fn statement(program: &Program, k: usize, instruction: &Instruction, operands: &[Operand]) -> String {
    let of = |o: &Operand| operand(program, o);
    let value = match instruction {
        Instruction::Add(a, b) => format!("{} + {}", of(a), of(b)),
        Instruction::Subtract(a, b) => format!("{} - {}", of(a), of(b)),
        Instruction::Multiply(a, b) => format!("{} * {}", of(a), of(b)),
        Instruction::MultiplyAdd(a, b, c) => format!("{} * {} + {}", of(a), of(b), of(c)),
        Instruction::MultiplySubtract(a, b, c) => format!("{} - {} * {}", of(c), of(a), of(b)),
        Instruction::Divide(a, b) => format!("{} / {}", of(a), of(b)),
        Instruction::Negate(a) => format!("-{}", of(a)),
        // Next to each other, so that compilers make one call of them.
        Instruction::SineCosine(a) => {
            let parts = [("sin", Operand::Sine(k)), ("cos", Operand::Cosine(k))];
            let read = parts.into_iter().filter(|(_, part)| operands.contains(part));
            let written = read.map(|(name, part)| format!("{} = {name}({})", of(&part), of(a)));
            return format!("    const double {};\n", written.collect::<Vec<_>>().join(", "));
        }
        Instruction::Call(function, a) => format!("{}({})", name(*function), of(a)),
        Instruction::Binary(function, a, b) => {
            let name = match function {
                BinaryFunction::Atan2 => "atan2",
                BinaryFunction::Min => "fmin",
                BinaryFunction::Max => "fmax",
                BinaryFunction::Powf => "pow",
            };
            format!("{name}({}, {})", of(a), of(b))
        }
        Instruction::Own(function, arguments) => {
            let arguments: Vec<String> = function.of(arguments).iter().map(of).collect();
            format!("{}({})", own_name(program, *function), arguments.join(", "))
        }
    };
    format!("    const double v{k} = {value};\n")
}

fn name(function: Function) -> &'static str {
    match function {
        Function::Ln => "log",
        Function::Abs => "fabs",
        Function::Signum => "gauss_signum",
        Function::Sin | Function::Cos | Function::Exp | Function::Sqrt | Function::Tanh => function.name(),
    }
}

/// A function of the user's own, which whoever links the code provides: `lift`, its derivatives `lift_1`, `lift_2`; of
/// several variables with the order by each, `drag_1_0`.
fn own_name(program: &Program, function: OwnFunction) -> String {
    let name = snake(program.functions.get(usize::from(function.index)).map_or("own", String::as_str));
    name + &function.suffix()
}

/// Declarations of the functions of the user's own that programs call.
fn own_functions<'a>(programs: impl Iterator<Item = &'a Program>) -> String {
    let called = programs.flat_map(|program| {
        let own = |instruction: &Instruction| match instruction {
            Instruction::Own(function, _) => Some((own_name(program, *function), function.variables)),
            _ => None,
        };
        program.code.instructions.iter().filter_map(own)
    });
    let names: BTreeSet<(String, u8)> = called.collect();
    let declared = |(name, variables): (String, u8)| {
        let arguments = ["double x", "double y", "double z"][..usize::from(variables)].join(", ");
        format!("double {name}({arguments});\n")
    };
    names.into_iter().map(declared).collect()
}

fn operand(program: &Program, operand: &Operand) -> String {
    match *operand {
        Operand::Input(Input::Number(number)) => literal(program.numbers[number]),
        Operand::Input(Input::Component { argument, component }) => {
            let Argument { kind, name, .. } = &program.arguments[argument];
            if *kind == ArgumentKind::Time { name.clone() } else { format!("{name}[{component}]") }
        }
        Operand::Number(value) => fraction(value),
        Operand::Value(k) => format!("v{k}"),
        Operand::Sine(k) => format!("s{k}"),
        Operand::Cosine(k) => format!("c{k}"),
    }
}

/// The shortest digits that read back the same number.
fn literal(value: f64) -> String {
    if value.is_sign_negative() { format!("({value:?})") } else { format!("{value:?}") }
}

fn fraction(value: Rational) -> String {
    if value.is_dyadic() {
        return literal(value.to_f64());
    }
    match value.parts() {
        Some((numerator, denominator)) => format!("({:?} / {:?})", numerator as f64, denominator as f64),
        None => literal(value.to_f64()),
    }
}
