//! Kernels as systems that `Simulation` integrates, where the program knows the sizes of the model.

use std::fmt;

use gauss_codegen::program::Smoothness;
use gauss_runtime::__private_0_1_0::Chart;
use gauss_runtime::prelude::{GaussSystem, SMatrix, SVector};

use crate::error::CallError;
use crate::kernel::{Kernel, Method};

/// The inputs of a system: `()` or `SVector<f64, U>`.
pub trait Inputs: Copy + fmt::Debug + Send + Sync + 'static {
    /// How many numbers they are.
    const COUNT: usize;

    /// The numbers.
    fn numbers(&self) -> &[f64];
}

impl Inputs for () {
    const COUNT: usize = 0;

    fn numbers(&self) -> &[f64] {
        &[]
    }
}

impl<const U: usize> Inputs for SVector<f64, U> {
    const COUNT: usize = U;

    fn numbers(&self) -> &[f64] {
        self.as_slice()
    }
}

/// Why a kernel is no [`System`].
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NoSystem {
    /// The sizes are others: coordinates, speeds, inputs.
    Sizes {
        /// The sizes of the model.
        expected: [usize; 3],
        /// The sizes that were asked for.
        found: [usize; 3],
    },
    /// The model has what a system of plain coordinates does not tell a run: a rotation, a chart of one body,
    /// constraints, contacts, states of elements, accelerations that are not smooth.
    Has(&'static str),
}

impl fmt::Display for NoSystem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Sizes { expected: [q, z, u], found } => {
                write!(f, "the model has {q} coordinates, {z} speeds and {u} inputs, and {found:?} are asked for")
            }
            Self::Has(what) => write!(f, "the model has {what}; derive its struct where the program is compiled"),
        }
    }
}

impl std::error::Error for NoSystem {}

/// A kernel of plain coordinates as a [`GaussSystem`]: Q coordinates, Z speeds, and inputs of the type I.
///
/// The model comes at run time, its sizes stand in the program, and are compared when the system is made. A call costs
/// what a call of a [`Method`] costs: some nanoseconds beside the code.
#[derive(Clone, Copy, Debug)]
pub struct System<'k, const Q: usize, const Z: usize, I> {
    methods: [Method<'k>; METHODS.len()],
    inputs: std::marker::PhantomData<I>,
}

const METHODS: [&str; 10] = [
    "kinematics",
    "acceleration",
    "momentum",
    "velocity",
    "momentum_rate",
    "mass_matrix",
    "kinetic_energy",
    "potential_energy",
    "gauss_residual",
    "constraint_function",
];

/// Methods that a model has with what no [`System`] can have.
const OTHERS: [(&str, &str); 5] = [
    ("body_twist", "a chart of one body"),
    ("regularity", "a chart of one body"),
    ("multipliers", "constraints"),
    ("contact_rates", "contacts"),
    ("configuration_rates", "states of elements"),
];

impl Kernel {
    /// The kernel as a system for [`Simulation`](gauss_runtime::prelude::Simulation), with Q coordinates, Z speeds, and
    /// inputs I: `kernel.system::<9, 9, SVector<f64, 9>>()`. All of its methods are compiled.
    ///
    /// # Errors
    /// Other sizes; what a system of plain coordinates has not.
    pub fn system<const Q: usize, const Z: usize, I: Inputs>(&self) -> Result<System<'_, Q, Z, I>, NoSystem> {
        let model = self.model();
        if !model.derived.unit_components.is_empty() {
            return Err(NoSystem::Has("rotations"));
        }
        let has = OTHERS.iter().find(|(method, _)| model.methods().any(|name| name == *method));
        if let Some((_, what)) = has {
            return Err(NoSystem::Has(what));
        }
        let missing = |_: CallError| NoSystem::Has("no equations of motion");
        let acceleration = model.method("acceleration").map_err(missing)?;
        let program = &model.derived.methods[acceleration];
        if program.code.smoothness() != Smoothness::Smooth {
            return Err(NoSystem::Has("accelerations that are not smooth"));
        }
        let counts: Vec<usize> = program.arguments[2..].iter().map(|argument| argument.components.len()).collect();
        let [q, z, u] = counts[..] else { return Err(NoSystem::Has("no equations of motion")) };
        if [q, z, u] != [Q, Z, I::COUNT] {
            return Err(NoSystem::Sizes { expected: [q, z, u], found: [Q, Z, I::COUNT] });
        }
        let mut methods = [self.method("acceleration").map_err(missing)?; METHODS.len()];
        for (place, name) in methods.iter_mut().zip(METHODS) {
            *place = self.method(name).map_err(missing)?;
        }
        Ok(System { methods, inputs: std::marker::PhantomData })
    }
}

impl<const Q: usize, const Z: usize, I: Inputs> System<'_, Q, Z, I> {
    /// The results of the method at that place of the list.
    fn vector<const N: usize>(&self, method: usize, arguments: &[&[f64]]) -> SVector<f64, N> {
        let mut results = SVector::<f64, N>::zeros();
        // The sizes were compared when it was made: those of all methods are the same three.
        let called = self.methods[method].call(arguments, results.as_mut_slice());
        debug_assert_eq!(called, Ok(()));
        if called.is_ok() { results } else { results.map(|_| f64::NAN) }
    }

    fn number(&self, method: usize, arguments: &[&[f64]]) -> f64 {
        self.vector::<1>(method, arguments)[0]
    }
}

impl<const Q: usize, const Z: usize, I: Inputs> GaussSystem for System<'_, Q, Z, I> {
    type Scalar = f64;
    type Configuration = SVector<f64, Q>;
    type Speeds = SVector<f64, Z>;
    type MassMatrix = SMatrix<f64, Z, Z>;
    type Input = I;

    const CHART: Chart = Chart::Own;

    fn kinematics(&self, t: f64, q: &SVector<f64, Q>, z: &SVector<f64, Z>) -> SVector<f64, Q> {
        self.vector(0, &[&[t], q.as_slice(), z.as_slice()])
    }

    fn acceleration(&self, t: f64, q: &SVector<f64, Q>, z: &SVector<f64, Z>, input: &I) -> SVector<f64, Z> {
        self.vector(1, &[&[t], q.as_slice(), z.as_slice(), input.numbers()])
    }

    fn momentum(&self, t: f64, q: &SVector<f64, Q>, z: &SVector<f64, Z>) -> SVector<f64, Z> {
        self.vector(2, &[&[t], q.as_slice(), z.as_slice()])
    }

    fn velocity(&self, t: f64, q: &SVector<f64, Q>, p: &SVector<f64, Z>) -> SVector<f64, Z> {
        self.vector(3, &[&[t], q.as_slice(), p.as_slice()])
    }

    fn momentum_rate(&self, t: f64, q: &SVector<f64, Q>, p: &SVector<f64, Z>, input: &I) -> SVector<f64, Z> {
        self.vector(4, &[&[t], q.as_slice(), p.as_slice(), input.numbers()])
    }

    fn mass_matrix(&self, t: f64, q: &SVector<f64, Q>) -> SMatrix<f64, Z, Z> {
        let mut results = SMatrix::<f64, Z, Z>::zeros();
        // Symmetric: rows are columns.
        let called = self.methods[5].call(&[&[t], q.as_slice()], results.as_mut_slice());
        debug_assert_eq!(called, Ok(()));
        if called.is_ok() { results } else { results.map(|_| f64::NAN) }
    }

    fn kinetic_energy(&self, t: f64, q: &SVector<f64, Q>, z: &SVector<f64, Z>) -> f64 {
        self.number(6, &[&[t], q.as_slice(), z.as_slice()])
    }

    fn potential_energy(&self, t: f64, q: &SVector<f64, Q>) -> f64 {
        self.number(7, &[&[t], q.as_slice()])
    }

    fn gauss_residual(
        &self,
        t: f64,
        q: &SVector<f64, Q>,
        z: &SVector<f64, Z>,
        acceleration: &SVector<f64, Z>,
        input: &I,
    ) -> SVector<f64, Z> {
        self.vector(8, &[&[t], q.as_slice(), z.as_slice(), acceleration.as_slice(), input.numbers()])
    }

    fn constraint_function(
        &self,
        t: f64,
        q: &SVector<f64, Q>,
        z: &SVector<f64, Z>,
        acceleration: &SVector<f64, Z>,
        input: &I,
    ) -> f64 {
        self.number(9, &[&[t], q.as_slice(), z.as_slice(), acceleration.as_slice(), input.numbers()])
    }
}
