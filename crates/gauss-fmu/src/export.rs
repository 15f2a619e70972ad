//! From a scene in words to a file.

use std::path::Path;

use gauss_codegen::Derivation;
use gauss_codegen::program::{Instruction, Malformed, Operand, Program};
use gauss_jit::Model;

use crate::archive::{self, Entry};
use crate::code::Scene;
use crate::variables::{Role, Variable, variables};
use crate::xml::ModelDescription;
use crate::{FmuError, Version, binary};

/// A scene that becomes an FMU, with numbers for its parameters and start values of its states.
#[derive(Debug)]
pub struct Fmu {
    derivation: Derivation,
    model: Model,
    version: Version,
    variables: Vec<Variable>,
}

/// The contents of an FMU beside its source code.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Report {
    /// The platform that there is a binary for; `None` where there is no C compiler.
    pub platform: Option<&'static str>,
}

impl Fmu {
    /// The FMU of the only struct with `#[gauss(…)]` attributes in a text, with its parameters by name, in their units,
    /// matrices row after row. They are the start values of an instance, which checks what it is given itself.
    ///
    /// # Errors
    /// Mistakes of the scene and of its parameters; clauses without a counterpart: dry friction, contacts with it,
    /// constraints whose runs are projected, functions of Rust, tables.
    pub fn new(source: &str, parameters: &[(&str, &[f64])]) -> Result<Self, FmuError> {
        let model = Model::from_source(source).map_err(FmuError::Scene)?;
        let derivation = Derivation::of_text(source).map_err(|error| FmuError::NoCounterpart(error.to_string()))?;
        refuse(&derivation)?;
        model.kernel(parameters).map_err(FmuError::Parameters)?;
        let own = |name: &str| parameters.iter().find(|(known, _)| *known == name).map(|(_, numbers)| *numbers);
        let list = derivation.parameters().list.iter();
        let numbers: Vec<f64> = list.flat_map(|parameter| own(&parameter.name).unwrap_or_default()).copied().collect();
        let variables = variables(&derivation, &numbers);
        Ok(Self { derivation, model, version: Version::default(), variables })
    }

    /// Another version of FMI than 2.0.
    #[must_use]
    pub fn version(mut self, version: Version) -> Self {
        self.version = version;
        self
    }

    /// Start values of states by the names of their numbers, in place of the origin at rest.
    ///
    /// # Errors
    /// Names that no state has; numbers that are not finite.
    pub fn start(mut self, values: &[(&str, f64)]) -> Result<Self, FmuError> {
        for (name, value) in values {
            let states = || self.variables.iter().filter(|own| own.role == Role::State);
            if !value.is_finite() {
                return Err(FmuError::Start(format!("the start value of `{name}` is {value}: it must be finite")));
            }
            let known: Vec<&str> = states().map(|own| own.name.as_str()).collect();
            let message = format!("there is no state `{name}`; there is {}", known.join(", "));
            let state = self.variables.iter_mut().find(|own| own.role == Role::State && own.name == *name);
            state.ok_or(FmuError::Start(message))?.start = Some(*value);
        }
        Ok(self)
    }

    /// Remarks about a robot's file: names that were changed, elements that do not act in the equations.
    #[must_use]
    pub fn remarks(&self) -> &[String] {
        self.model.remarks()
    }

    /// Files of the source code, by their names in `sources`.
    ///
    /// # Errors
    /// A mistake of this crate.
    pub fn sources(&self) -> Result<Vec<(&'static str, String)>, FmuError> {
        let token = self.token()?;
        let scene = self.scene(&token);
        let mut files = vec![("model.h", scene.header()), ("model.c", scene.source().map_err(bug)?)];
        files.extend(archive::FIXED.map(|(name, text)| (name, text.to_owned())));
        files.push(match self.version {
            Version::Two => ("fmi2.c", archive::FMI2.to_owned()),
            Version::Three => ("fmi3.c", archive::FMI3.to_owned()),
        });
        Ok(files)
    }

    /// `modelDescription.xml`, with a name for the binary.
    ///
    /// # Errors
    /// A name that is no identifier of C.
    pub fn description(&self, identifier: &str) -> Result<String, FmuError> {
        is_identifier(identifier)?;
        let token = self.token()?;
        Ok(self.described(identifier, &token).xml())
    }

    /// Writes the FMU, whole or not at all. The name of the file is that of the binary in it.
    ///
    /// # Errors
    /// A name that is no identifier of C, or does not end in `.fmu`; errors of the operating system. What was there
    /// before is then unchanged.
    pub fn write(&self, file: impl AsRef<Path>) -> Result<Report, FmuError> {
        let file = file.as_ref();
        let identifier = file.file_stem().and_then(|name| name.to_str()).unwrap_or_default();
        is_identifier(identifier)?;
        if file.extension().is_none_or(|end| end != "fmu") {
            return Err(FmuError::Name(file.display().to_string()));
        }
        let sources = self.sources()?;
        let folder = tempfile::tempdir()?;
        for (name, text) in &sources {
            std::fs::write(folder.path().join(name), text)?;
        }
        let platform = binary::platform(self.version);
        let library = if platform.is_some() { binary::compiled(folder.path())? } else { None };
        let token = self.token()?;
        let described = self.described(identifier, &token);
        let mut entries = vec![Entry::new("modelDescription.xml", described.xml())];
        entries.extend(sources.into_iter().map(|(name, text)| Entry::new(&format!("sources/{name}"), text)));
        if self.version == Version::Three {
            entries.push(Entry::new("sources/buildDescription.xml", described.build()));
        }
        let mut written = Report { platform: None };
        if let (Some(library), Some((folder, end))) = (library, platform) {
            entries.push(Entry::new(&format!("binaries/{folder}/{identifier}.{end}"), library));
            written.platform = Some(folder);
        }
        archive::write(file, &entries)?;
        Ok(written)
    }

    fn scene<'a>(&'a self, token: &'a str) -> Scene<'a> {
        Scene { derivation: &self.derivation, variables: &self.variables, token, version: self.version.number() }
    }

    fn described<'a>(&'a self, identifier: &'a str, token: &'a str) -> ModelDescription<'a> {
        let documentation = &self.derivation.description().documentation;
        let name = self.derivation.name();
        let (variables, contacts) = (&self.variables, self.derivation.description().contacts.len());
        ModelDescription { version: self.version, name, identifier, documentation, token, variables, contacts }
    }

    /// A mark of all that the binary depends on: the same scene has the same one.
    fn token(&self) -> Result<String, FmuError> {
        let scene = self.scene("");
        let all = scene.header() + &scene.source().map_err(bug)?;
        // FNV-1a of 128 bits.
        let hash = all.bytes().fold(0x6c62_272e_07bb_0142_62b8_2175_6295_c58d_u128, |hash, byte| {
            (hash ^ u128::from(byte)).wrapping_mul(0x0000_0000_0100_0000_0000_0000_0000_013b)
        });
        let digits = format!("{hash:032x}");
        let [a, b, c, d, e] = [0..8, 8..12, 12..16, 16..20, 20..32].map(|range| digits[range].to_owned());
        Ok(format!("{{{a}-{b}-{c}-{d}-{e}}}"))
    }
}

fn bug(malformed: Malformed) -> FmuError {
    FmuError::Compiler(malformed.to_string())
}

/// Clauses that FMI has no counterpart for.
fn refuse(derivation: &Derivation) -> Result<(), FmuError> {
    let refused = |text: String| Err(FmuError::NoCounterpart(text));
    let called = |program: &Program| {
        program.code.instructions.iter().find_map(|instruction| match instruction {
            Instruction::Own(function, _) => program.functions.get(usize::from(function.index)).cloned(),
            _ => None,
        })
    };
    if let Some(name) = derivation.functions().programs().find_map(called) {
        return refused(format!("the equations call `{name}`, a function of Rust or a table: no FMU has it"));
    }
    let description = derivation.description();
    if let Some(why) = not_bouncing(derivation) {
        let names: Vec<String> = description.contacts.iter().map(|own| format!("`{}`", own.name)).collect();
        return refused(format!("{} cannot be in an FMU: {why}", names.join(", ")));
    }
    if description.is_constrained {
        return refused(
            "the scene has constraints (`constraint`, a loop) whose runs are projected onto them, which has no \
             counterpart in an FMU; with `independent` speeds that solve them they have"
                .to_owned(),
        );
    }
    Ok(())
}

/// Why contacts are none that bounce one at a time: an FMU knows signs of gaps, and has no solver of laws of friction.
fn not_bouncing(derivation: &Derivation) -> Option<&'static str> {
    let contacts = derivation.description().contacts.len();
    if contacts == 0 {
        return None;
    }
    let outputs =
        |method: &str| derivation.program(method).map(|program| &program.code.outputs[..]).unwrap_or_default();
    let is_zero = |operand: &Operand| matches!(operand, Operand::Number(value) if value.is_zero());
    let response = derivation.program("impulse_dynamics");
    let by_columns = response.is_some_and(|program| program.results.iter().any(|result| result.name == "columns"));
    if outputs("friction").iter().any(|bound| !is_zero(bound)) || outputs("contact_rates").len() != contacts {
        Some("dry friction is decided by laws of a solver; friction that gives way is a force, which an FMU has")
    } else if outputs("gaps").len() != contacts || outputs("gaps").iter().any(is_zero) {
        Some("they have no gaps")
    } else if !derivation.description().joints.is_empty() {
        Some("`reactions(…)` does not know the forces of contacts")
    } else if !derivation.description().motions.is_empty() {
        Some("the driving forces of `motion(…)` do not know the forces of contacts")
    } else if !by_columns {
        Some("the equations of a tree as long as this are formed link by link, which the events of an FMU do not use")
    } else {
        None
    }
}

fn is_identifier(name: &str) -> Result<(), FmuError> {
    let fits = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let is_right = name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_') && name.chars().all(fits);
    if is_right { Ok(()) } else { Err(FmuError::Name(name.to_owned())) }
}
