//! The public face of the pipeline: a struct in; programs, equations and Rust out.

mod bodies;
mod description;
#[cfg(test)]
mod elements_tests;
mod methods;
mod parameters;
#[cfg(test)]
mod pass_tests;
#[cfg(test)]
mod rounding;
#[cfg(test)]
mod rounding_tests;
mod signature;

use std::fmt;
use std::ops::Range;

use proc_macro2::TokenStream;
use syn::DeriveInput;

use crate::algebra::Notation;
use crate::description::Description;
use crate::emit::{Derived, Equations, emit, figures};
use crate::error::Result;
use crate::expand::derive;
use crate::formulation::PrintedEquations;
use crate::mistakes::bug;
use crate::model::{only_struct_in, struct_in};
use crate::parameters::Parameters;
use crate::program::{Functions, Program};
use crate::scene::{Mistake, Scene};
use crate::words::Unraw;

pub use bodies::{Bodies, LinkData, LinkKind};
use methods::programs;
use signature::Signature;

/// Everything that is derived from one struct. It stands alone: nothing in it refers to the scene or to expressions.
#[derive(Clone, Debug)]
pub struct Derivation {
    functions: Functions,
    parameters: Parameters,
    unit_components: Vec<Range<usize>>,
    description: Description,
    accuracy: Vec<(String, [f64; 2])>,
    remarks: Vec<String>,
    files: Vec<String>,
    latex: String,
    sections: [PrintedEquations; 2],
    rust: Option<TokenStream>,
}

impl Derivation {
    /// Derives the equations of motion of a struct with `#[gauss(…)]` attributes.
    ///
    /// # Errors
    /// Every mistake of the struct, each at the token that is wrong.
    pub fn new(input: &DeriveInput) -> syn::Result<Self> {
        derive(input, |derived| Self::of(derived, true))
    }

    /// The same of the struct of that name in the text of a Rust file, wherever in its modules it is.
    ///
    /// # Errors
    /// What is no Rust; the name, if there is no such struct; every mistake of the struct.
    pub fn of_source(source: &str, name: &str) -> syn::Result<Self> {
        Self::new(&struct_in(source, name)?)
    }

    /// The same of the only struct with a `#[gauss(…)]` attribute in a text, without its code in Rust: for programs
    /// that read a scene while they run, and wait for it.
    ///
    /// # Errors
    /// What is no Rust; no such struct, or several; every mistake of the struct.
    pub fn of_text(source: &str) -> syn::Result<Self> {
        derive(&only_struct_in(source)?, |derived| Self::of(derived, false))
    }

    /// The same of a scene that is written in Rust.
    ///
    /// # Errors
    /// Every mistake of the scene, each with the clause or the field that is wrong.
    pub fn of_scene(scene: &Scene) -> std::result::Result<Self, Vec<Mistake>> {
        Self::new(&scene.item()?).map_err(|mistakes| scene.located(&mistakes))
    }

    fn of(derived: &Derived<'_, '_>, writes_rust: bool) -> Result<Self> {
        let ident = &derived.item().ident;
        let signature = Signature::new(derived);
        let refused = |malformed: &dyn fmt::Display| bug(ident, &malformed);
        let constants = signature.constants(derived.kernel).map_err(|malformed| refused(&malformed))?;
        let programs = programs(derived, &signature).map_err(|malformed| refused(&malformed))?;
        let parameters = parameters::parameters(derived, &signature).map_err(|malformed| refused(&malformed))?;
        let unit_components = parameters::unit_components(derived);
        let description = description::description(derived);
        let equations = Equations::of(derived);
        let rust = writes_rust.then(|| emit(derived, &equations));
        let accuracy = figures(derived).map(|(_, name, figure)| (name.to_owned(), figure.rounded())).collect();
        let described = derived.item().described.iter();
        let files = described.clone().flat_map(|file| file.paths.clone()).collect();
        let remarks = described.flat_map(|file| &file.remarks).map(|remark| remark.text.clone()).collect();
        let Equations { text, latex } = equations;
        let functions = Functions { name: ident.unraw().to_string(), equations: text, constants, methods: programs };
        let sections = derived.printed.clone();
        Ok(Self {
            functions,
            parameters,
            unit_components,
            description,
            accuracy,
            remarks,
            files,
            latex,
            sections,
            rust,
        })
    }

    /// The name of the struct.
    pub fn name(&self) -> &str {
        &self.functions.name
    }

    /// Functions that a target writes: the constants, the programs, and the equations as text.
    pub fn functions(&self) -> &Functions {
        &self.functions
    }

    /// Program of the constants that `kernel()` computes from the numbers of the fields.
    pub fn constants(&self) -> &Program {
        &self.functions.constants
    }

    /// The fields of the struct, and what `kernel()` checks of their numbers.
    pub fn parameters(&self) -> &Parameters {
        &self.parameters
    }

    /// The components of a configuration that have the length one together, as those of a unit quaternion have: where
    /// they are among all.
    pub fn unit_components(&self) -> &[Range<usize>] {
        &self.unit_components
    }

    /// The scene in words: names of coordinates, speeds, inputs, frames, joints and contacts.
    pub fn description(&self) -> &Description {
        &self.description
    }

    /// One program for each method of the kernel, then `evaluate`, and `linearize`, `by_parameters`,
    /// `linearize_inverse`, `regressor` and `hessian` if the struct has their clauses. Arguments are those of the
    /// method: constants, time and configuration first.
    pub fn programs(&self) -> &[Program] {
        &self.functions.methods
    }

    /// The program of one method.
    pub fn program(&self, method: &str) -> Option<&Program> {
        self.programs().iter().find(|program| program.name == method)
    }

    /// The rounding error of each method at the worst state that a search finds, and the median at sample states, in
    /// units of the change of the result when every parameter and argument changes in its last place.
    pub fn accuracy(&self) -> &[(String, [f64; 2])] {
        &self.accuracy
    }

    /// Remarks about a robot from a file: names that were changed, and elements that do not act in the equations.
    pub fn remarks(&self) -> &[String] {
        &self.remarks
    }

    /// Whole paths of all files that were read for a robot: its own first, then those that it includes.
    pub fn files(&self) -> &[String] {
        &self.files
    }

    /// The equations of motion: a page of plain text, or LaTeX whose lines fit 16 cm at 10 pt, in `align*`.
    pub fn equations(&self, notation: Notation) -> &str {
        match notation {
            Notation::Text => &self.functions.equations,
            Notation::Latex => &self.latex,
        }
    }

    /// Headings, each with its equations, whole ones, each in one line.
    pub fn sections(&self, notation: Notation) -> &[(String, Vec<String>)] {
        match notation {
            Notation::Text => &self.sections[0],
            Notation::Latex => &self.sections[1],
        }
    }

    /// The kernel in Rust: the items that `#[derive(GaussDynamics)]` adds to the struct; none where it was derived
    /// [of a text](Self::of_text).
    pub fn rust(&self) -> Option<&TokenStream> {
        self.rust.as_ref()
    }
}

impl Bodies {
    /// The bodies of the only struct with a `#[gauss(…)]` attribute in a text.
    ///
    /// # Errors
    /// What is no Rust; no such struct, or several; every mistake of the struct.
    pub fn of_text(source: &str) -> syn::Result<Self> {
        derive(&only_struct_in(source)?, Self::of)
    }
}
