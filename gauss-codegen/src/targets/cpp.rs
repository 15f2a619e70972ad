//! C++17: a header of templates, one function a program, which needs nothing but the standard library.
//!
//! Arguments and results are whatever has `[]`: pointers, `std::array`, vectors and maps of Eigen. Numbers are of any
//! type that has the operators and, found by its argument, the functions of `<cmath>` that a scene calls: `float`,
//! `double`, `long double`, dual numbers. All arrays of a call have numbers of one type. Results are written after
//! everything is computed, so that one may be an argument; matrices are written row after row.
//!
//! ```
//! use gauss_codegen::targets::cpp;
//!
//! let top = "#[gauss(motion = fixed_point)] struct Top { #[gauss(mass)] m: f64, #[gauss(inertia)] i: Vector3<f64> }";
//! let top = gauss_codegen::Derivation::of_source(top, "Top")?;
//! assert!(cpp::source(top.functions()).contains("namespace top {"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use std::collections::BTreeSet;
use std::fmt::Write;

use crate::algebra::Function;
use crate::program::{ArgumentKind, Functions, Instruction, Program};

use super::arrays::arrays;
use super::c::{self, Real};
use super::{is_handed_over, only_scalar, snake};

/// The type of the numbers of an array.
const NUMBER: &str = "/* The type of the numbers of an array. */
template <class Array>
using number = std::remove_cv_t<std::remove_reference_t<decltype(std::declval<Array&>()[0])>>;
";

/// Words of C++ that begin no other way than names in it do.
const WORDS: &str = "alignas alignof and asm auto bitand bitor bool break case catch char class compl concept const \
    consteval constexpr constinit continue decltype default delete do double else enum explicit export extern false float \
    for friend goto if inline int long mutable namespace new noexcept not nullptr operator or private protected public \
    register requires return short signed sizeof static std struct switch template this throw true try typedef typeid \
    typename union unsigned using virtual void volatile while xor";

/// A header with all programs of a struct, in a namespace that is named after it.
pub fn source(functions: &Functions) -> String {
    let mut out = c::comment(&functions.equations);
    out.push_str(
        "#pragma once\n\n#include <cmath>\n#include <cstddef>\n#include <type_traits>\n#include <utility>\n\n",
    );
    writeln!(out, "namespace {} {{\n", namespace(&functions.name)).ok();
    out.push_str(&places(functions));
    out.push_str(NUMBER);
    if functions.programs().any(c::calls_signum) {
        write!(out, "\ntemplate <class Scalar>\n{}", c::signum(Real::Scalar)).ok();
    }
    let own = c::own_functions(functions.programs(), Real::Scalar);
    if !own.is_empty() {
        write!(out, "\n/* To be defined: functions of the scene, name_n their n-th derivatives. */\n{own}").ok();
    }
    for program in functions.programs() {
        write!(out, "\n{}", function(program)).ok();
    }
    out.push_str("\n}\n");
    out
}

/// The name of a struct, with an underscore where that is a word of the language.
fn namespace(name: &str) -> String {
    let name = snake(name);
    let word = WORDS.split_whitespace().any(|word| word == name);
    if word || name.is_empty() { name + "_" } else { name }
}

/// A namespace for each array: the places of its numbers, and how many there are.
fn places(functions: &Functions) -> String {
    let mut out = String::new();
    for array in arrays(functions) {
        writeln!(out, "/* Places of the numbers of `{}`. */\nnamespace {}_place {{", array.name, array.name).ok();
        for (place, number) in array.places.iter().enumerate() {
            // With an underscore behind it no name is a word of the language.
            writeln!(out, "inline constexpr std::size_t {number}_ = {place};").ok();
        }
        writeln!(out, "inline constexpr std::size_t count = {};\n}}\n", array.size).ok();
    }
    out
}

/// An argument or a result of a function, as it stands in its declaration.
struct FunctionParameter {
    name: String,
    /// The parameter of the template; none of a time.
    array: Option<String>,
    result: bool,
}

impl FunctionParameter {
    fn declared(&self, scalar: &str) -> String {
        let Self { name, array, result } = self;
        match array {
            None => format!("const {scalar}& {name}"),
            Some(array) if *result => format!("{array}&& {name}"),
            Some(array) => format!("const {array}& {name}"),
        }
    }
}

fn parameters(program: &Program) -> Vec<FunctionParameter> {
    let arguments = program.arguments.iter().filter(|argument| is_handed_over(argument)).map(|argument| {
        let array = argument.kind != ArgumentKind::Time;
        FunctionParameter { name: argument.name.clone(), array: array.then(String::new), result: false }
    });
    let returns = only_scalar(program);
    let results = program.results.iter().filter(|result| !returns && result.len() > 0);
    let results = results.map(|result| FunctionParameter {
        name: c::result_name(program, result),
        array: Some(String::new()),
        result: true,
    });
    let mut all: Vec<FunctionParameter> = arguments.chain(results).collect();
    for (place, array) in all.iter_mut().filter_map(|parameter| parameter.array.as_mut()).enumerate() {
        *array = format!("Array{}", place + 1);
    }
    all
}

fn function(program: &Program) -> String {
    let parameters = parameters(program);
    let arrays: Vec<&String> = parameters.iter().filter_map(|parameter| parameter.array.as_ref()).collect();
    let scalar = arrays.first().map_or("Scalar".to_owned(), |first| format!("number<{first}>"));
    let template: Vec<String> = match arrays.is_empty() {
        // Nothing tells the type but the caller.
        true => vec!["class Scalar = double".to_owned()],
        false => arrays.iter().map(|array| format!("class {array}")).collect(),
    };
    let declared: Vec<String> = parameters.iter().map(|parameter| parameter.declared(&scalar)).collect();
    let returned = if only_scalar(program) { scalar.as_str() } else { "void" };
    let mut out = c::description(program);
    writeln!(out, "template <{}>", template.join(", ")).ok();
    writeln!(out, "{returned} {}(\n    {})", program.name, declared.join(",\n    ")).ok();
    let body = c::body(program, &beginning(program, &arrays), Real::Scalar);
    out.push_str(&body);
    out
}

/// The type of all numbers, and the functions of `<cmath>`, which a type of one's own may have of its own.
fn beginning(program: &Program, arrays: &[&String]) -> String {
    let mut out = String::new();
    if let Some((first, others)) = arrays.split_first() {
        writeln!(out, "    using Scalar = number<{first}>;").ok();
        for other in others {
            let same = format!("std::is_same<number<{other}>, Scalar>::value");
            writeln!(out, "    static_assert({same}, \"numbers of one type in all arrays\");").ok();
        }
    }
    for name in library_functions(program) {
        writeln!(out, "    using std::{name};").ok();
    }
    out
}

fn library_functions(program: &Program) -> BTreeSet<String> {
    let names = program.code.instructions.iter().map(|instruction| match instruction {
        Instruction::SineCosine(_) => vec!["sin", "cos"],
        Instruction::Call(Function::Signum, _) => vec![],
        Instruction::Call(function, _) => vec![c::library_name(*function)],
        Instruction::Binary(function, ..) => vec![c::library_name_of_two(*function)],
        _ => vec![],
    });
    names.flatten().map(|name| Real::Scalar.function(name)).collect()
}
