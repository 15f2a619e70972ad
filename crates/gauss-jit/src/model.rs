//! Models: scenes that come as text, as files of robots, or clause by clause, while a program runs.

use std::ops::Range;
#[cfg(any(feature = "urdf", feature = "mjcf"))]
use std::path::Path;
use std::sync::{Arc, Once, OnceLock};

use gauss_codegen::description::Description;
use gauss_codegen::parameters::{Parameter, Parameters, TableClause};
use gauss_codegen::program::{Argument, Counts, Functions, Instruction, Program, Results};
use gauss_codegen::{Derivation, Notation, Scene};
use gauss_runtime::contact::Contact;

use crate::backends::{Backend, Compiled, CompiledLanes, interpreted};
use crate::error::{CallError, Mistake, Mistakes, Place, TableMistakes};
use crate::names::contacts;
use crate::tables::{self, Array, Tables};

/// A scene with its equations of motion, and the programs that compute them.
///
/// It is what `#[derive(GaussDynamics)]` derives of the same struct, by the same pipeline; the last step is another.
/// Clones share what is derived and compiled. Every method is compiled when it is first called, by any kernel.
#[derive(Clone, Debug)]
pub struct Model {
    pub(crate) derived: Arc<Derived>,
}

/// The derivation that all kernels of a model share.
#[derive(Debug)]
pub(crate) struct Derived {
    pub data: Data,
    pub contacts: &'static [Contact],
    pub tables: Tables,
    compiled: Vec<OnceLock<Box<dyn Compiled>>>,
    lanes: Vec<OnceLock<Option<Box<dyn CompiledLanes>>>>,
    backend: Arc<dyn Backend>,
}

/// A derivation as plain data.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "cache", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Data {
    name: String,
    equations: [String; 2],
    accuracy: Vec<(String, [f64; 2])>,
    remarks: Vec<String>,
    pub files: Vec<String>,
    pub parameters: Parameters,
    pub unit_components: Vec<Range<usize>>,
    description: Description,
    pub constants: Program,
    pub methods: Vec<Program>,
}

#[cfg(feature = "cache")]
impl Data {
    /// All of its programs.
    pub fn programs(&self) -> impl Iterator<Item = &Program> {
        [&self.constants, &self.parameters.computed].into_iter().chain(&self.methods)
    }
}

impl Derived {
    fn new(data: Data, tables: Tables, backend: Arc<dyn Backend>) -> Self {
        let compiled = data.methods.iter().map(|_| OnceLock::new()).collect();
        let lanes = data.methods.iter().map(|_| OnceLock::new()).collect();
        Self { contacts: contacts(&data.description), data, tables, compiled, lanes, backend }
    }

    pub fn compiled(&self, method: usize) -> &dyn Compiled {
        let program = &self.data.methods[method];
        let make = || {
            self.backend.compile(program, &self.tables).unwrap_or_else(|| {
                say_interpreted();
                Box::new(interpreted(program, &self.tables))
            })
        };
        &**self.compiled[method].get_or_init(make)
    }

    /// The method for several rows at once, where the back end has that; made when it is first wanted.
    pub fn lanes(&self, method: usize) -> Option<&dyn CompiledLanes> {
        let make = || self.backend.compile_lanes(&self.data.methods[method], &self.tables);
        self.lanes[method].get_or_init(make).as_deref()
    }
}

/// Machine code, where it is compiled in.
fn default_backend() -> Arc<dyn Backend> {
    #[cfg(feature = "cranelift")]
    return Arc::new(crate::backends::Cranelift::default());
    #[cfg(not(feature = "cranelift"))]
    return Arc::new(crate::backends::Interpreter);
}

/// Once in the life of a process.
fn say_interpreted() {
    static SAID: Once = Once::new();
    SAID.call_once(|| {
        eprintln!(
            "gauss-jit: no machine code can be made here (is executable memory refused?); methods are interpreted"
        );
    });
}

impl Model {
    /// The model of the struct with `#[gauss(…)]` attributes that is in a text. A path of a file in it is relative to
    /// the folder of the package that Cargo runs, or to the working directory.
    ///
    /// # Errors
    /// Every mistake of the scene, with its line and column and the words of the compiler; a text with no such struct,
    /// or with several; functions of Rust that its equations call.
    pub fn from_source(source: &str) -> Result<Self, Mistakes> {
        let derivation = Derivation::of_text(source).map_err(|error| located(source, &error))?;
        Self::new(&derivation).map_err(|mistake| Mistakes { list: vec![mistake], source: source.to_owned() })
    }

    /// The model of a robot in a URDF file, with further clauses: `gravity = 9.81`, `base = floating`, `linearize`.
    ///
    /// # Errors
    /// Every mistake, in the text of [`Mistakes::source`].
    #[cfg(feature = "urdf")]
    pub fn from_urdf(path: impl AsRef<Path>, clauses: &[&str]) -> Result<Self, Mistakes> {
        Self::from_source(&of_file("urdf", path.as_ref(), clauses))
    }

    /// The same of an MJCF file.
    ///
    /// # Errors
    /// Every mistake, in the text of [`Mistakes::source`].
    #[cfg(feature = "mjcf")]
    pub fn from_mjcf(path: impl AsRef<Path>, clauses: &[&str]) -> Result<Self, Mistakes> {
        Self::from_source(&of_file("mjcf", path.as_ref(), clauses))
    }

    /// The model of a scene that is written clause by clause.
    ///
    /// # Errors
    /// Every mistake, with the clause or the field that is wrong; functions of Rust that its equations call.
    pub fn from_scene(scene: &Scene) -> Result<Self, Mistakes> {
        let derived = Derivation::of_scene(scene).map_err(|mistakes| {
            let mistake = |mistake: gauss_codegen::Mistake| {
                let place = Place::Clause(mistake.clause);
                Mistake { place, message: mistake.message }
            };
            mistakes.into_iter().map(mistake).collect::<Vec<_>>()
        });
        let model = derived.and_then(|derivation| Self::new(&derivation).map_err(|mistake| vec![mistake]));
        model.map_err(|list| Mistakes { list, source: scene.source() })
    }

    fn new(derivation: &Derivation) -> Result<Self, Mistake> {
        let functions = derivation.functions();
        let tables = &derivation.parameters().tables;
        if let Some(name) = functions.programs().find_map(|program| called(program, tables)) {
            let message = format!("the equations call `{name}`, a function of Rust, which is not there at run time");
            return Err(Mistake { place: Place::Clause(functions.name.clone()), message });
        }
        Ok(Self::of(Data {
            name: functions.name.clone(),
            equations: [Notation::Text, Notation::Latex].map(|notation| derivation.equations(notation).to_owned()),
            accuracy: derivation.accuracy().to_vec(),
            remarks: derivation.remarks().to_vec(),
            files: derivation.files().to_vec(),
            parameters: derivation.parameters().clone(),
            unit_components: derivation.unit_components().to_vec(),
            description: derivation.description().clone(),
            constants: functions.constants.clone(),
            methods: functions.methods.clone(),
        }))
    }

    /// The model of a derivation.
    pub(crate) fn of(data: Data) -> Self {
        Self { derived: Arc::new(Derived::new(data, Tables::default(), default_backend())) }
    }

    /// The same model whose programs are carried out in another way.
    #[must_use]
    pub fn with_backend(&self, backend: impl Backend + 'static) -> Self {
        let Derived { data, tables, .. } = &*self.derived;
        Self { derived: Arc::new(Derived::new(data.clone(), tables.clone(), Arc::new(backend))) }
    }

    /// The same model with the numbers of its tables: an array for each of [`table_constants`](Self::table_constants),
    /// by its name, with its axes and its numbers row after row. `points` have the axes (n, 2), the arrays of `axes`
    /// one, `values` one for each of these. All before are replaced.
    ///
    /// # Errors
    /// Every array that is missing, is of no table, has another shape, or has numbers that make no table.
    pub fn with_tables(&self, arrays: &[Array<'_>]) -> Result<Self, TableMistakes> {
        let Derived { data, backend, .. } = &*self.derived;
        if arrays.is_empty() && self.table_constants().is_empty() {
            return Ok(self.clone());
        }
        let tables = Tables::of(&data.parameters.tables, arrays).map_err(|list| TableMistakes { list })?;
        Ok(Self { derived: Arc::new(Derived::new(data.clone(), tables, Arc::clone(backend))) })
    }

    /// The paths of the constants that the scene has the numbers of its tables in, as its clauses name them, in their
    /// order: `POWER`, `aero::LIFT`. Constants of Rust are not there at run time: a kernel needs their arrays, by
    /// [`with_tables`](Self::with_tables).
    pub fn table_constants(&self) -> Vec<&str> {
        let mut names = Vec::new();
        for name in self.derived.data.parameters.tables.iter().flatten().flat_map(tables::constants) {
            if !names.contains(&name.as_str()) {
                names.push(name.as_str());
            }
        }
        names
    }

    /// The name of the struct.
    pub fn name(&self) -> &str {
        &self.derived.data.name
    }

    /// The equations of motion: a page of text, or LaTeX.
    pub fn equations(&self, notation: Notation) -> &str {
        match notation {
            Notation::Text => &self.derived.data.equations[0],
            Notation::Latex => &self.derived.data.equations[1],
        }
    }

    /// The programs of all methods and of the constants, as targets read them ([`targets`](crate::targets)).
    pub fn functions(&self) -> Functions {
        let Data { name, equations: [equations, _], constants, methods, .. } = &self.derived.data;
        let (name, equations) = (name.clone(), equations.clone());
        Functions { name, equations, constants: constants.clone(), methods: methods.clone() }
    }

    /// The operations of each method by their kind: `OPERATIONS` of a compiled kernel, counted where no vectors are
    /// formed.
    pub fn operations(&self) -> impl Iterator<Item = (&str, Counts)> {
        self.derived.data.methods.iter().map(|program| (program.name.as_str(), program.code.counts()))
    }

    /// The rounding error of each method at the worst state that a search found, and the median, in units of the change
    /// of the result when every parameter and argument changes in its last place.
    pub fn accuracy(&self) -> &[(String, [f64; 2])] {
        &self.derived.data.accuracy
    }

    /// Remarks about a robot from a file: names that were changed, elements that do not act in the equations.
    pub fn remarks(&self) -> &[String] {
        &self.derived.data.remarks
    }

    /// The files that its scene was read from, by their paths: of robots, and those that these name.
    pub fn files(&self) -> &[String] {
        &self.derived.data.files
    }

    /// The components of a configuration that have the length one together, as those of a unit quaternion have: where
    /// they are among all.
    pub fn unit_components(&self) -> &[Range<usize>] {
        &self.derived.data.unit_components
    }

    /// The scene in words: names of coordinates, speeds, inputs, frames, joints and contacts.
    pub fn description(&self) -> &Description {
        &self.derived.data.description
    }

    /// Contacts, ranges and dry joints, in the order of their rows.
    pub fn contacts(&self) -> &'static [Contact] {
        self.derived.contacts
    }

    /// The parameters: the fields of the struct; a body is three of them, `arm.mass`, `arm.center_of_mass`,
    /// `arm.inertia`.
    pub fn parameters(&self) -> &[Parameter] {
        &self.derived.data.parameters.list
    }

    /// The numbers of the parameters that the equations have, by which `by_parameters` differentiates, in the order of
    /// its columns: `m`, `center[2]`, `inertia[1][0]`, `arm.center_of_mass[2]`.
    pub fn parameter_names(&self) -> &[String] {
        self.derived.data.constants.arguments.first().map_or(&[], |numbers| &numbers.components)
    }

    /// The names of the methods.
    pub fn methods(&self) -> impl Iterator<Item = &str> {
        self.derived.data.methods.iter().map(|program| program.name.as_str())
    }

    /// The arguments of a method, the constants left out: the name of each, and those of its components.
    ///
    /// # Errors
    /// [`CallError::NoMethod`].
    pub fn arguments(&self, method: &str) -> Result<&[Argument], CallError> {
        Ok(&self.derived.data.methods[self.method(method)?].arguments[1..])
    }

    /// The results of a method: numbers, vectors and matrices, one after another; matrices row after row.
    ///
    /// # Errors
    /// [`CallError::NoMethod`].
    pub fn results(&self, method: &str) -> Result<&[Results], CallError> {
        Ok(&self.derived.data.methods[self.method(method)?].results)
    }

    pub(crate) fn method(&self, name: &str) -> Result<usize, CallError> {
        // One program with two names, as of compiled kernels.
        let own = if name == "inverse_dynamics" { "gauss_residual" } else { name };
        let found = self.derived.data.methods.iter().position(|program| program.name == own);
        found.ok_or_else(|| CallError::NoMethod {
            name: name.to_owned(),
            known: self.methods().map(str::to_owned).collect(),
        })
    }
}

/// The struct of a robot's file, with a line for each clause.
#[cfg(any(feature = "urdf", feature = "mjcf"))]
pub(crate) fn of_file(format: &str, path: &Path, clauses: &[&str]) -> String {
    let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let clauses: String = clauses.iter().map(|clause| format!("\n    {clause},")).collect();
    format!("#[gauss({format} = {:?},{clauses}\n)]\nstruct Robot;\n", path.to_string_lossy())
}

/// The name of a function of Rust that the program calls.
fn called(program: &Program, tables: &[Option<TableClause>]) -> Option<String> {
    program.code.instructions.iter().find_map(|instruction| match instruction {
        Instruction::Own(function, _) if tables.get(usize::from(function.index)).is_none_or(Option::is_none) => {
            program.functions.get(usize::from(function.index)).cloned()
        }
        _ => None,
    })
}

fn located(source: &str, error: &syn::Error) -> Mistakes {
    let mistake = |error: syn::Error| {
        let start = error.span().start();
        Mistake { place: Place::Text { line: start.line, column: start.column + 1 }, message: error.to_string() }
    };
    let mut list: Vec<Mistake> = error.clone().into_iter().map(mistake).collect();
    list.sort_by_key(|mistake| match mistake.place {
        Place::Text { line, column } => (line, column),
        Place::Clause(_) => (0, 0),
    });
    Mistakes { list, source: source.to_owned() }
}
