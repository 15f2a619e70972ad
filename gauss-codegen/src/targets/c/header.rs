//! Headers, for C and for C++ that calls C.

use std::fmt::Write;

use crate::program::{Functions, Program};
use crate::targets::arrays::arrays;
use crate::targets::snake;

use super::{Precision, Real, description, signature};

/// The header of a [`source`](super::source): sizes of arrays, names of the places of their numbers, and declarations,
/// each with a comment. A place is named after the scene, the array and the number: `q[ARM_Q_ELBOW]`.
pub fn header(functions: &Functions, precision: Precision) -> String {
    let prefix = snake(&functions.name);
    let upper = prefix.to_uppercase();
    let mut out = format!("#ifndef {upper}_H\n#define {upper}_H\n\n");
    out.push_str(&places(functions, &upper));
    out.push_str("#ifdef __cplusplus\nextern \"C\" {\n#endif\n");
    for program in functions.programs() {
        write!(out, "\n{}", declaration(program, &prefix, precision.into())).ok();
    }
    out.push_str("\n#ifdef __cplusplus\n}\n#endif\n\n");
    writeln!(out, "#endif /* {upper}_H */").ok();
    out
}

fn declaration(program: &Program, prefix: &str, real: Real) -> String {
    format!("{}{};\n", description(program), signature(program, prefix, real))
}

/// An enumeration for each array: the places of its numbers, then how many there are.
fn places(functions: &Functions, prefix: &str) -> String {
    let mut out = String::new();
    for array in arrays(functions) {
        let name = array.name.to_uppercase();
        writeln!(out, "/* Places of the numbers of `{}`, and how many there are. */\nenum {{", array.name).ok();
        for (place, number) in array.places.iter().enumerate() {
            writeln!(out, "    {prefix}_{name}_{} = {place},", number.to_uppercase()).ok();
        }
        writeln!(out, "    {prefix}_{name}_COUNT = {}\n}};\n", array.size).ok();
    }
    out
}
