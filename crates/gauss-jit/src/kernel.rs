//! Kernels: a model with numbers for its parameters, and its methods by name.

use gauss_codegen::parameters::Parameter;
use gauss_codegen::program::{Argument, Results};
use gauss_runtime::contact::Contact;
use gauss_runtime::error::ParameterWarnings;

use crate::backends::{Compiled, MOST_ARGUMENTS, interpreted};
use crate::checks::{Checks, warnings};
use crate::configuration::Groups;
use crate::error::{CallError, KernelError, Misgiven};
use crate::model::{Derived, Model};

/// A model with numbers for its parameters: what `kernel()` of a compiled struct gives. It needs neither the [`Model`]
/// it was made from nor its text; threads share it.
///
/// Units are those of the parameters; angles are in radians. A configuration has the components of its parts in their
/// order: of rotations those of the unit quaternion, x, y, z, w, of poses these and then the position, of poses in the
/// plane cosine, sine and position; all plain coordinates come last. What is not finite gives what is not finite.
#[derive(Clone, Debug)]
pub struct Kernel {
    model: Model,
    constants: Vec<f64>,
    /// None where there are too many.
    pub(crate) groups: Option<Groups>,
    warnings: ParameterWarnings,
    contacts: &'static [Contact],
}

/// A method of a kernel, compiled.
#[derive(Clone, Copy, Debug)]
pub struct Method<'k> {
    pub(crate) name: &'k str,
    pub(crate) constants: &'k [f64],
    arguments: &'k [Argument],
    results: &'k [Results],
    outputs: usize,
    pub(crate) compiled: &'k dyn Compiled,
    /// Lanes are made when they are first wanted.
    pub(crate) derived: &'k Derived,
    pub(crate) place: usize,
}

impl Model {
    /// A kernel: the parameters by name, in their units, matrices row after row; all in any order. They are checked as
    /// `kernel()` of the compiled struct checks them.
    ///
    /// # Errors
    /// Names and counts that are not the model's, and tables without numbers; parameters that no body has: each all at
    /// once.
    pub fn kernel(&self, parameters: &[(&str, &[f64])]) -> Result<Kernel, KernelError> {
        let mut wrong = Vec::new();
        if !self.derived.tables.has_all(&self.derived.data.parameters.tables) {
            wrong.extend(self.table_constants().into_iter().map(|name| Misgiven::Table(name.to_owned())));
        }
        let numbers = numbers_of(self.parameters(), parameters, wrong).map_err(KernelError::Given)?;
        Kernel::new(self.clone(), &numbers)
    }
}

impl Kernel {
    fn new(model: Model, numbers: &[f64]) -> Result<Self, KernelError> {
        let derived = &model.derived.data;
        let read: Vec<f64> = derived.parameters.read.iter().map(|&k| numbers[k]).collect();
        let run = |program, arguments: &[&[f64]], count: usize| {
            let mut outputs = vec![0.0; count];
            interpreted(program, &model.derived.tables).run(arguments, &mut outputs);
            outputs
        };
        let computed = &derived.parameters.computed;
        let computed = run(computed, &[&read], computed.code.outputs.len());
        let mut checks = Checks::of(&derived.parameters, numbers, &computed)?;
        let constants = run(&derived.constants, &[&read], derived.constants.code.outputs.len());
        let groups = Groups::of(model.description());
        let warnings = warnings(&derived.parameters, numbers, &computed)?;
        let contacts = model.derived.contacts;
        let kernel = Self { model: model.clone(), constants, groups, warnings, contacts };
        if checks.wants_mass_matrix() {
            checks.mass_matrices(&kernel.mass_matrices()?)?;
        }
        checks.finish(&kernel.constants)?;
        Ok(kernel)
    }

    /// The numbers that programs of parameters read, of those that the kernel was made of.
    pub(crate) fn numbers(&self, parameters: &[(&str, &[f64])]) -> Result<Vec<f64>, KernelError> {
        let all = numbers_of(self.model.parameters(), parameters, Vec::new()).map_err(KernelError::Given)?;
        Ok(self.model.derived.data.parameters.read.iter().map(|&k| all[k]).collect())
    }

    /// Mass matrices at a few configurations of general position: turns of any size, and lengths and coordinates from a
    /// thousandth to a thousand.
    fn mass_matrices(&self) -> Result<[Vec<f64>; 4], KernelError> {
        let derived = &self.model.derived.data;
        let Some(place) = derived.methods.iter().position(|program| program.name == "mass_matrix") else {
            return Ok([const { Vec::new() }; 4]);
        };
        let program = &derived.methods[place];
        let mut seed = 0x9e37_79b9_7f4a_7c15_u64;
        Ok([1.0, 1e-3, 30.0, 1e3].map(|scale| {
            let mut configuration = Vec::new();
            for _ in 0..program.arguments[2].components.len() {
                seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                let size = 0.25 + 0.75 * ((seed >> 12) as f64 / (1_u64 << 52) as f64);
                configuration.push(if seed >> 11 & 1 == 0 { scale * size } else { -scale * size });
            }
            for unit in derived.unit_components.iter().cloned() {
                let length = configuration[unit.clone()].iter().map(|x| x * x).sum::<f64>().sqrt();
                configuration[unit].iter_mut().for_each(|x| *x /= length);
            }
            let mut matrix = vec![0.0; program.code.outputs.len()];
            let program = interpreted(program, &self.model.derived.tables);
            program.run(&[&self.constants, &[0.37], &configuration], &mut matrix);
            matrix
        }))
    }

    /// Warnings about parameters that are likely not meant, although a kernel can be made of them: drag and damping
    /// that feed energy, gravity that points upward, added mass with the sign of hydrodynamic derivatives.
    pub fn warnings(&self) -> &ParameterWarnings {
        &self.warnings
    }

    /// Contacts, ranges and dry joints, in the order of their rows; none where they are left out.
    pub fn contacts(&self) -> &'static [Contact] {
        self.contacts
    }

    /// The kernel as if all gaps stayed open and no joint had dry friction.
    #[must_use]
    pub fn without_contacts(&self) -> Self {
        Self { contacts: &[], ..self.clone() }
    }

    /// The model that it is of.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// A method by its name, compiled if it was never called: for calls in a loop.
    ///
    /// # Errors
    /// [`CallError::NoMethod`].
    pub fn method(&self, name: &str) -> Result<Method<'_>, CallError> {
        let place = self.model.method(name)?;
        let program = &self.model.derived.data.methods[place];
        Ok(Method {
            name: &program.name,
            constants: &self.constants,
            arguments: &program.arguments,
            results: &program.results,
            outputs: program.code.outputs.len(),
            compiled: self.model.derived.compiled(place),
            derived: &self.model.derived,
            place,
        })
    }

    /// Calls a method: a list of numbers for each of its arguments, time first, then the configuration. Gives its
    /// results one after another, matrices row after row.
    ///
    /// # Errors
    /// A method that is not there; lists of other lengths.
    pub fn call(&self, method: &str, arguments: &[&[f64]]) -> Result<Vec<f64>, CallError> {
        let method = self.method(method)?;
        let mut results = vec![0.0; method.outputs];
        method.call(arguments, &mut results)?;
        Ok(results)
    }

    /// `q ∘ exp(increment)`: the configuration moved by an increment that is seen from the body, rotations at norm 1.
    /// It has as many components as q, and the increment as many as `kinematics` gives.
    ///
    /// # Errors
    /// Lists of other lengths; more than 31 rotations and poses.
    pub fn retract(&self, q: &[f64], increment: &[f64], moved: &mut [f64]) -> Result<(), CallError> {
        let (groups, [components, increments]) = self.groups("retract")?;
        check("retract", [("q", components, q), ("increment", increments, increment), ("results", components, moved)])?;
        groups.retract(q, increment, moved);
        Ok(())
    }

    /// The shortest increment from a configuration to another, seen from the body.
    ///
    /// # Errors
    /// As of [`retract`](Self::retract).
    pub fn difference(&self, q: &[f64], other: &[f64], increment: &mut [f64]) -> Result<(), CallError> {
        let (groups, [components, increments]) = self.groups("difference")?;
        check("difference", [("q", components, q), ("other", components, other), ("results", increments, increment)])?;
        groups.difference(q, other, increment);
        Ok(())
    }

    /// The increment seen from the body that changes the components of q by so much, to first order.
    ///
    /// # Errors
    /// As of [`retract`](Self::retract).
    pub fn tangent(&self, q: &[f64], change: &[f64], increment: &mut [f64]) -> Result<(), CallError> {
        let (groups, [components, increments]) = self.groups("tangent")?;
        check("tangent", [("q", components, q), ("change", components, change), ("results", increments, increment)])?;
        groups.tangent(q, change, increment);
        Ok(())
    }

    /// Rates of the components of q at a velocity seen from the body, as `kinematics` gives it.
    ///
    /// # Errors
    /// As of [`retract`](Self::retract).
    pub fn component_rates(&self, q: &[f64], velocity: &[f64], rates: &mut [f64]) -> Result<(), CallError> {
        let (groups, [components, increments]) = self.groups("component_rates")?;
        let lists = [("q", components, q), ("velocity", increments, velocity), ("results", components, &*rates)];
        check("component_rates", lists)?;
        groups.component_rates(q, velocity, rates);
        Ok(())
    }

    /// The groups of a configuration, and how many components it and an increment of it have.
    fn groups(&self, method: &str) -> Result<(Groups, [usize; 2]), CallError> {
        let kinematics = &self.model.derived.data.methods[self.model.method("kinematics")?];
        let sizes = [kinematics.arguments[2].components.len(), kinematics.code.outputs.len()];
        let groups = self.groups.ok_or_else(|| CallError::Groups { method: method.to_owned() })?;
        Ok((groups, sizes))
    }

    /// ż: the accelerations, at time t, configuration q and speeds z, with the inputs u.
    ///
    /// # Errors
    /// Lists of other lengths.
    pub fn acceleration(&self, t: f64, q: &[f64], z: &[f64], u: &[f64]) -> Result<Vec<f64>, CallError> {
        self.call("acceleration", &[&[t], q, z, u])
    }

    /// The generalised force that must be added to all forces of the scene for the motion to have the given ż.
    ///
    /// # Errors
    /// Lists of other lengths.
    pub fn inverse_dynamics(
        &self,
        t: f64,
        q: &[f64],
        z: &[f64],
        acceleration: &[f64],
        u: &[f64],
    ) -> Result<Vec<f64>, CallError> {
        self.call("inverse_dynamics", &[&[t], q, z, acceleration, u])
    }

    /// A, symmetric, row after row.
    ///
    /// # Errors
    /// Lists of other lengths.
    pub fn mass_matrix(&self, t: f64, q: &[f64]) -> Result<Vec<f64>, CallError> {
        self.call("mass_matrix", &[&[t], q])
    }

    /// Kinetic energy T, that of the fluid included.
    ///
    /// # Errors
    /// Lists of other lengths.
    pub fn kinetic_energy(&self, t: f64, q: &[f64], z: &[f64]) -> Result<f64, CallError> {
        self.number("kinetic_energy", &[&[t], q, z])
    }

    /// Potential energy, 0 where the scene has no potential.
    ///
    /// # Errors
    /// Lists of other lengths.
    pub fn potential_energy(&self, t: f64, q: &[f64]) -> Result<f64, CallError> {
        self.number("potential_energy", &[&[t], q])
    }

    fn number(&self, method: &str, arguments: &[&[f64]]) -> Result<f64, CallError> {
        let mut result = [0.0];
        self.method(method)?.call(arguments, &mut result)?;
        Ok(result[0])
    }
}

impl<'k> Method<'k> {
    /// The arguments of the method, the constants left out.
    pub fn arguments(&self) -> &'k [Argument] {
        &self.arguments[1..]
    }

    /// The results of the method, one after another.
    pub fn results(&self) -> &'k [Results] {
        self.results
    }

    /// Count of the numbers that it gives.
    pub fn outputs(&self) -> usize {
        self.outputs
    }

    /// Whether it is machine code.
    pub fn is_machine_code(&self) -> bool {
        self.compiled.is_machine_code()
    }

    /// Calls it: a list of numbers for each argument; writes the results one after another. Nothing is allocated where
    /// it is machine code.
    ///
    /// # Errors
    /// Lists of other lengths.
    pub fn call(&self, arguments: &[&[f64]], results: &mut [f64]) -> Result<(), CallError> {
        self.check(1, arguments, results)?;
        self.run(arguments, results);
        Ok(())
    }

    /// Refuses other lists than there are arguments, and those that have neither the numbers of so many rows nor those
    /// of one for all.
    pub(crate) fn check(&self, rows: usize, arguments: &[&[f64]], results: &[f64]) -> Result<(), CallError> {
        let wanted = self.arguments();
        if arguments.len() != wanted.len() {
            let expected = wanted.iter().map(|argument| argument.name.clone()).collect();
            return Err(CallError::Lists { method: self.name.to_owned(), expected, found: arguments.len() });
        }
        let counts = wanted.iter().map(|argument| (&argument.name[..], argument.components.len()));
        let counts = counts.zip(arguments).map(|((name, count), list)| (name, count, list.len()));
        let wrong = counts.clone().find(|(_, count, found)| found != count && *found != count.saturating_mul(rows));
        let of_results = ("results", self.outputs, results.len());
        let is_wrong = results.len() != self.outputs.saturating_mul(rows);
        if let Some((name, count, found)) = wrong.or(is_wrong.then_some(of_results)) {
            let (method, name) = (self.name.to_owned(), name.to_owned());
            return Err(CallError::Count { method, name, expected: count.saturating_mul(rows), found });
        }
        Ok(())
    }

    /// Calls it with lists whose lengths were compared.
    pub(crate) fn run(&self, arguments: &[&[f64]], results: &mut [f64]) {
        let mut all: [&[f64]; MOST_ARGUMENTS] = [&[]; MOST_ARGUMENTS];
        all[0] = self.constants;
        all[1..self.arguments.len()].copy_from_slice(arguments);
        self.compiled.run(&all[..self.arguments.len()], results);
    }
}

/// Refuses lists of other lengths: each with its name and the length that it has to have.
fn check(method: &str, lists: [(&str, usize, &[f64]); 3]) -> Result<(), CallError> {
    let wrong = lists.into_iter().find(|(_, expected, list)| list.len() != *expected);
    wrong.map_or(Ok(()), |(name, expected, list)| {
        Err(CallError::Count { method: method.to_owned(), name: name.to_owned(), expected, found: list.len() })
    })
}

/// The numbers of all parameters in their order, unless something was wrong before or is.
fn numbers_of(
    list: &[Parameter],
    given: &[(&str, &[f64])],
    mut wrong: Vec<Misgiven>,
) -> Result<Vec<f64>, Vec<Misgiven>> {
    let is_unknown = |name: &str| list.iter().all(|parameter| parameter.name != name);
    let unknown = given.iter().filter(|(name, _)| is_unknown(name));
    wrong.extend(unknown.map(|(name, _)| Misgiven::Unknown((*name).to_owned())));
    let mut numbers = Vec::new();
    for Parameter { name, count, .. } in list {
        let mut own = given.iter().filter(|(known, _)| known == name).map(|(_, numbers)| *numbers);
        match (own.next(), own.next()) {
            (None, _) => wrong.push(Misgiven::Missing(name.clone())),
            (Some(_), Some(_)) => wrong.push(Misgiven::Repeated(name.clone())),
            (Some(own), None) if own.len() != *count => {
                wrong.push(Misgiven::Count { name: name.clone(), expected: *count, found: own.len() });
            }
            (Some(own), None) => numbers.extend(own),
        }
    }
    if wrong.is_empty() { Ok(numbers) } else { Err(wrong) }
}
