//! The programs of one struct together: all that a target reads.

use std::iter;

use super::Program;

/// The functions of one struct, and the text above them. It refers to no scene.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Functions {
    /// The name of the struct.
    pub name: String,
    /// The equations of motion as plain text, for a comment.
    pub equations: String,
    /// Computes the constants of a kernel from the numbers of the fields.
    pub constants: Program,
    /// One program for each method of the kernel.
    pub methods: Vec<Program>,
}

impl Functions {
    /// All programs: the constants, then every method.
    pub fn programs(&self) -> impl Iterator<Item = &Program> + Clone {
        iter::once(&self.constants).chain(&self.methods)
    }
}
