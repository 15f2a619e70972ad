//! The programs of one struct together: all that a target reads.

use std::{fmt, iter};

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

    /// The same with these methods alone, in their own order; with all where none is named.
    ///
    /// # Errors
    /// Names of no method.
    pub fn only(&self, names: &[String]) -> Result<Self, UnknownMethods> {
        let known = |name: &String| self.methods.iter().any(|program| program.name == *name);
        let unknown: Vec<String> = names.iter().filter(|name| !known(name)).cloned().collect();
        if !unknown.is_empty() {
            let known = self.methods.iter().map(|program| program.name.clone()).collect();
            return Err(UnknownMethods { scene: self.name.clone(), unknown, known });
        }
        let wanted = |program: &&Program| names.is_empty() || names.contains(&program.name);
        Ok(Self { methods: self.methods.iter().filter(wanted).cloned().collect(), ..self.clone() })
    }
}

/// Names of methods that a struct has not.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct UnknownMethods {
    /// The name of the struct.
    pub scene: String,
    /// The names.
    pub unknown: Vec<String>,
    /// The names of the methods that it has.
    pub known: Vec<String>,
}

impl fmt::Display for UnknownMethods {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let unknown: Vec<String> = self.unknown.iter().map(|name| format!("`{name}`")).collect();
        write!(f, "{} has no method {}; it has {}", self.scene, unknown.join(", "), self.known.join(", "))
    }
}

impl std::error::Error for UnknownMethods {}
