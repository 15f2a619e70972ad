//! Kernels as systems that `Simulation` integrates: the program has room for so many numbers, the model fills a part.

use std::fmt;

use gauss_codegen::program;
use gauss_runtime::__private_0_1_0::{Chart, ProjectionError, dependence, project};
use gauss_runtime::linearize::Linearization;
use gauss_runtime::prelude::{
    ConstrainedSystem, GaussSystem, LinearizedSystem, SMatrix, SVector, Smoothness, VectorSpace,
};

use crate::configuration::{Groups, MOST_GROUPS, MixedConfiguration, MixedVector};
use crate::kernel::{Kernel, Method};

/// The inputs of a system: `()` or `SVector<f64, U>`.
pub trait Inputs: Copy + fmt::Debug + Send + Sync + 'static {
    /// Count of the numbers.
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
    /// The model has more numbers than the system has room for: of the configuration, speeds, inputs.
    Sizes {
        /// The sizes of the model.
        expected: [usize; 3],
        /// The room that was asked for.
        found: [usize; 3],
    },
    /// The model has more rows of contacts than the system has room for.
    Rows {
        /// The rows of the model.
        expected: usize,
        /// The room that was asked for.
        found: usize,
    },
    /// The model has no equations of motion, more rotations than a system has, or constraints or contacts where the
    /// type says that it has none, or none where it says that it has some.
    Has(&'static str),
}

impl fmt::Display for NoSystem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Sizes { expected: [q, z, u], found } => {
                write!(
                    f,
                    "the model has {q} numbers of the configuration, {z} speeds and {u} inputs, and {found:?} are asked for"
                )
            }
            Self::Rows { expected, found } => {
                write!(f, "the model has {expected} rows of contacts, and room for {found} is asked for")
            }
            Self::Has(what) => write!(f, "the model has {what}"),
        }
    }
}

impl std::error::Error for NoSystem {}

/// A kernel as a [`GaussSystem`]: room for Q components of the configuration, Z speeds, and inputs of the type I.
///
/// The model comes at run time, the room stands in the program, and is compared when the system is made. Numbers that
/// the model does not have are zero and stand still, of unit mass. Adaptive methods take the root of the mean square of
/// all errors: tolerances times [`share`](Self::share) leave these out. A call costs what a call of a [`Method`] costs:
/// some nanoseconds beside the code.
///
/// A model with contacts is a [`SystemWithContacts`](crate::SystemWithContacts). A velocity knows of what groups its
/// configuration is, which the vectors of [`Linearization`] do not: `error_matrix` of it is NaN.
#[derive(Clone, Copy, Debug)]
pub struct System<'k, const Q: usize, const Z: usize, I, const CONSTRAINED: bool = false> {
    methods: [Option<Method<'k>>; METHODS.len()],
    groups: Groups,
    sizes: Sizes,
    smoothness: Smoothness,
    keeps_energy: bool,
    inputs: std::marker::PhantomData<I>,
}

/// The sizes of a model.
#[derive(Clone, Copy, Debug)]
struct Sizes {
    configuration: usize,
    speeds: usize,
    inputs: usize,
    multipliers: usize,
    /// Number of the states of elements.
    states: usize,
}

/// Which models have a method.
#[derive(Clone, Copy, PartialEq)]
enum Of {
    All,
    Some,
    /// Systems with contacts alone have it.
    Contacts,
}

/// Methods by name, each with the models that have it.
const METHODS: [(&str, Of); 27] = [
    ("kinematics", Of::All),
    ("acceleration", Of::All),
    ("momentum", Of::All),
    ("velocity", Of::All),
    ("momentum_rate", Of::All),
    ("mass_matrix", Of::All),
    ("kinetic_energy", Of::All),
    ("potential_energy", Of::All),
    ("gauss_residual", Of::All),
    ("constraint_function", Of::All),
    ("configuration_rates", Of::Some),
    ("regularity", Of::Some),
    ("linearize", Of::Some),
    ("multipliers", Of::Some),
    ("position_residual", Of::Some),
    ("velocity_residual", Of::Some),
    ("position_correction", Of::Some),
    ("velocity_correction", Of::Some),
    ("gaps", Of::Contacts),
    ("contact_rates", Of::Contacts),
    ("contact_jacobian", Of::Contacts),
    ("contact_frames", Of::Contacts),
    ("friction", Of::Contacts),
    ("restitution", Of::Contacts),
    ("impulse_response", Of::Contacts),
    ("impulse_dynamics", Of::Contacts),
    ("impulse_velocities", Of::Contacts),
];

/// The place of a method in the list.
pub(crate) const fn place_of(name: &str) -> usize {
    let mut place = 0;
    while place < METHODS.len() {
        let (own, name, mut k) = (METHODS[place].0.as_bytes(), name.as_bytes(), 0);
        while k < own.len() && k < name.len() && own[k] == name[k] {
            k += 1;
        }
        if k == own.len() && k == name.len() {
            return place;
        }
        place += 1;
    }
    panic!("no such method")
}

impl Kernel {
    /// The kernel as a system for [`Simulation`](gauss_runtime::prelude::Simulation), with room for Q components of the
    /// configuration, Z speeds, and inputs I: `kernel.system::<9, 9, SVector<f64, 9>>()`. All of its methods are
    /// compiled.
    ///
    /// # Errors
    /// Less room than the model needs; constraints; contacts, which [`without_contacts`](Self::without_contacts) leaves
    /// out.
    pub fn system<const Q: usize, const Z: usize, I: Inputs>(&self) -> Result<System<'_, Q, Z, I>, NoSystem> {
        System::new(self, false)
    }

    /// The same of a model with constraints, onto which runs project states.
    ///
    /// # Errors
    /// Less room than the model needs; no constraints; contacts.
    pub fn constrained_system<const Q: usize, const Z: usize, I: Inputs>(
        &self,
    ) -> Result<System<'_, Q, Z, I, true>, NoSystem> {
        System::new(self, false)
    }
}

impl<'k, const Q: usize, const Z: usize, I: Inputs, const CONSTRAINED: bool> System<'k, Q, Z, I, CONSTRAINED> {
    pub(crate) fn new(kernel: &'k Kernel, with_contacts: bool) -> Result<Self, NoSystem> {
        const { assert!(MOST_GROUPS == 31, "the message below names it") };
        let groups = kernel.groups.ok_or(NoSystem::Has("more than 31 rotations and poses"))?;
        let model = kernel.model();
        match (model.description().is_constrained, CONSTRAINED) {
            (true, false) => return Err(NoSystem::Has("constraints: `constrained_system` has them")),
            (false, true) => return Err(NoSystem::Has("no constraints: `system` is for it")),
            _ => {}
        }
        match (kernel.contacts().is_empty(), with_contacts) {
            (false, false) => {
                return Err(NoSystem::Has("contacts: `contact_system` has them, `without_contacts()` leaves them out"));
            }
            (true, true) => return Err(NoSystem::Has("no contacts: `system` is for it")),
            _ => {}
        }
        let mut methods = [None; METHODS.len()];
        let wanted = methods.iter_mut().zip(METHODS).filter(|(_, (_, of))| *of != Of::Contacts || with_contacts);
        for (own, (name, of)) in wanted {
            *own = kernel.method(name).ok();
            if own.is_none() && of == Of::All {
                return Err(NoSystem::Has("no equations of motion"));
            }
        }
        let acceleration = model.method("acceleration").map_err(|_| NoSystem::Has("no equations of motion"))?;
        let program = &model.derived.data.methods[acceleration];
        let counts: Vec<usize> = program.arguments[2..].iter().map(|argument| argument.components.len()).collect();
        let [q, z, u] = counts[..] else { return Err(NoSystem::Has("no equations of motion")) };
        let multipliers = methods[place_of("multipliers")].map_or(0, |method: Method<'_>| method.outputs());
        if q > Q || z > Z || u > I::COUNT || multipliers > Z {
            return Err(NoSystem::Sizes { expected: [q, z.max(multipliers), u], found: [Q, Z, I::COUNT] });
        }
        let smoothness = match program.code.smoothness() {
            program::Smoothness::Smooth => Smoothness::Smooth,
            program::Smoothness::Kinks => Smoothness::Kinks,
            program::Smoothness::Jumps => Smoothness::Jumps,
        };
        let states = model.description().states;
        let sizes = Sizes { configuration: q, speeds: z, inputs: u, multipliers, states };
        let keeps_energy = model.description().keeps_energy;
        Ok(Self { methods, groups, sizes, smoothness, keeps_energy, inputs: std::marker::PhantomData })
    }

    /// The root of the part of the room for increments and speeds that the model fills: the factor of tolerances with
    /// which the mean error is that of the model's own numbers.
    pub fn share(&self) -> f64 {
        ((self.increments() + self.sizes.speeds).max(1) as f64 / (Q + Z).max(1) as f64).sqrt()
    }

    /// Number of components that an increment of the model's configuration has.
    fn increments(&self) -> usize {
        self.methods[const { place_of("kinematics") }].map_or(0, |method| method.outputs())
    }

    /// The configuration with these components: those of rotations have norm 1.
    pub fn configuration(&self, components: &[f64]) -> MixedConfiguration<Q> {
        let list =
            SVector::from_fn(|i, _| components.get(i).copied().filter(|_| i < self.sizes.configuration).unwrap_or(0.0));
        MixedConfiguration::new(list, self.groups)
    }

    /// The numbers of the model among these.
    pub(crate) fn own<'a>(&self, q: &'a MixedConfiguration<Q>) -> &'a [f64] {
        &q.as_slice()[..self.sizes.configuration]
    }

    /// The numbers of the model among components that are in its room.
    pub(crate) fn own_of<'a>(&self, components: &'a [f64; Q]) -> &'a [f64] {
        &components[..self.sizes.configuration]
    }

    pub(crate) fn speeds<'a>(&self, z: &'a SVector<f64, Z>) -> &'a [f64] {
        &z.as_slice()[..self.sizes.speeds]
    }

    pub(crate) fn inputs<'a>(&self, input: &'a I) -> &'a [f64] {
        &input.numbers()[..self.sizes.inputs]
    }

    fn multipliers<'a>(&self, residual: &'a SVector<f64, Z>) -> &'a [f64] {
        &residual.as_slice()[..self.sizes.multipliers]
    }

    /// Number of the model's own speeds.
    pub(crate) fn degrees_of_freedom(&self) -> usize {
        self.sizes.speeds
    }

    /// Whether the model has the method at that place of the list.
    pub(crate) fn has(&self, method: usize) -> bool {
        self.methods[method].is_some()
    }

    /// The results of a method that the model has, one after another; none of others.
    pub(crate) fn numbers(&self, method: usize, arguments: &[&[f64]]) -> Vec<f64> {
        let Some(method) = self.methods[method] else { return Vec::new() };
        let mut numbers = vec![f64::NAN; method.outputs()];
        let called = method.call(arguments, &mut numbers);
        debug_assert_eq!(called, Ok(()));
        numbers
    }

    /// The results of the method at that place of the list, and zeros.
    pub(crate) fn vector<const N: usize>(&self, method: usize, arguments: &[&[f64]]) -> SVector<f64, N> {
        let mut results = SVector::<f64, N>::zeros();
        let called = self.methods[method].is_some_and(|method| {
            let own = &mut results.as_mut_slice()[..method.outputs().min(N)];
            // The sizes were compared when it was made: those of all methods are the same.
            let called = method.call(arguments, own);
            debug_assert_eq!(called, Ok(()));
            called.is_ok()
        });
        if called { results } else { results.map(|_| f64::NAN) }
    }

    fn increment(&self, method: usize, arguments: &[&[f64]]) -> MixedVector<Q> {
        MixedVector::new(self.vector(method, arguments), self.groups)
    }

    fn number(&self, method: usize, arguments: &[&[f64]]) -> f64 {
        self.vector::<1>(method, arguments)[0]
    }
}

/// Derivatives are those of the model's own numbers, and zero beside them. A model without `linearize` has none: NaN.
///
/// The sizes of matrices over states cannot be computed from those of a type, so that this is of a few rooms alone.
macro_rules! linearized {
    ($($room:literal $states:literal),+) => {$(
        impl<const CONSTRAINED: bool> LinearizedSystem
            for System<'_, $room, $room, SVector<f64, $room>, CONSTRAINED>
        {
            type Linearization = Linearization<f64, $states, $room>;

            // Nothing is known of models.
            const STATE_PATTERN: &'static [&'static [bool]] = &[&[true; $states] as &[bool]; $states];
            const INPUT_PATTERN: &'static [&'static [bool]] = &[&[true; $room] as &[bool]; $states];

            fn linearize(
                &self,
                t: f64,
                q: &MixedConfiguration<$room>,
                z: &SVector<f64, $room>,
                input: &SVector<f64, $room>,
            ) -> Self::Linearization {
                let (increments, inputs) = (self.increments(), self.sizes.inputs);
                let states = increments + self.sizes.speeds;
                let mut numbers = vec![f64::NAN; states * (states + inputs + 2)];
                if let Some(method) = self.methods[const { place_of("linearize") }] {
                    let called = method.call(&[&[t], self.own(q), self.speeds(z), self.inputs(input)], &mut numbers);
                    debug_assert_eq!(called, Ok(()));
                }
                // Increments, then speeds, of which each has its room.
                let place = |k: usize| match k {
                    k if k < $room => Some(k).filter(|k| *k < increments),
                    k => Some(increments + k - $room).filter(|k| *k < states),
                };
                let entry = |first: usize, columns: usize, i: usize, j: Option<usize>| {
                    place(i).zip(j).map_or(0.0, |(i, j)| numbers[first + columns * i + j])
                };
                let [by_state, by_time] = [states, states + states * states];
                Linearization::new(
                    SVector::from_fn(|i, _| entry(0, 1, i, Some(0))),
                    SMatrix::from_fn(|i, j| entry(by_state, states, i, place(j))),
                    SVector::from_fn(|i, _| entry(by_time, 1, i, Some(0))),
                    SMatrix::from_fn(|i, j| entry(by_time + states, inputs, i, Some(j).filter(|j| *j < inputs))),
                )
            }
        }
    )+};
}

linearized!(4 8, 8 16, 16 32, 32 64, 64 128);

/// Results of a method by its name, which is looked up when this is compiled.
macro_rules! results {
    ($self:ident$(.$part:ident)+($name:literal, $($argument:expr),*)) => {
        $self$(.$part)+(const { $crate::system::place_of($name) }, &[$($argument),*])
    };
}
pub(crate) use results;
impl<const Q: usize, const Z: usize, I: Inputs, const CONSTRAINED: bool> GaussSystem
    for System<'_, Q, Z, I, CONSTRAINED>
{
    type Scalar = f64;
    type Configuration = MixedConfiguration<Q>;
    type Speeds = SVector<f64, Z>;
    type MassMatrix = SMatrix<f64, Z, Z>;
    type Input = I;

    const CHART: Chart = Chart::Own;
    const CONSTRAINED: bool = CONSTRAINED;

    fn smoothness(&self) -> Smoothness {
        self.smoothness
    }

    fn keeps_energy(&self) -> bool {
        self.keeps_energy
    }

    fn states(&self) -> usize {
        self.sizes.states
    }

    fn kinematics(&self, t: f64, q: &MixedConfiguration<Q>, z: &SVector<f64, Z>) -> MixedVector<Q> {
        results!(self.increment("kinematics", &[t], self.own(q), self.speeds(z)))
    }

    fn configuration_rates(&self, t: f64, q: &MixedConfiguration<Q>, z: &SVector<f64, Z>, input: &I) -> MixedVector<Q> {
        if self.methods[const { place_of("configuration_rates") }].is_none() {
            return self.kinematics(t, q, z);
        }
        results!(self.increment("configuration_rates", &[t], self.own(q), self.speeds(z), self.inputs(input)))
    }

    fn acceleration(&self, t: f64, q: &MixedConfiguration<Q>, z: &SVector<f64, Z>, input: &I) -> SVector<f64, Z> {
        results!(self.vector("acceleration", &[t], self.own(q), self.speeds(z), self.inputs(input)))
    }

    fn momentum(&self, t: f64, q: &MixedConfiguration<Q>, z: &SVector<f64, Z>) -> SVector<f64, Z> {
        results!(self.vector("momentum", &[t], self.own(q), self.speeds(z)))
    }

    fn velocity(&self, t: f64, q: &MixedConfiguration<Q>, p: &SVector<f64, Z>) -> SVector<f64, Z> {
        results!(self.vector("velocity", &[t], self.own(q), self.speeds(p)))
    }

    fn momentum_rate(&self, t: f64, q: &MixedConfiguration<Q>, p: &SVector<f64, Z>, input: &I) -> SVector<f64, Z> {
        results!(self.vector("momentum_rate", &[t], self.own(q), self.speeds(p), self.inputs(input)))
    }

    fn mass_matrix(&self, t: f64, q: &MixedConfiguration<Q>) -> SMatrix<f64, Z, Z> {
        let (count, mut own) = (self.sizes.speeds, SMatrix::<f64, Z, Z>::zeros());
        let method = self.methods[const { place_of("mass_matrix") }];
        let numbers = &mut own.as_mut_slice()[..count * count];
        let called = method.is_some_and(|method| method.call(&[&[t], self.own(q)], numbers).is_ok());
        debug_assert!(called);
        // What the model does not have is of unit mass.
        SMatrix::from_fn(|i, j| match (i < count && j < count, i == j) {
            _ if !called => f64::NAN,
            (true, _) => own.as_slice()[count * i + j],
            (false, is_own) => f64::from(u8::from(is_own)),
        })
    }

    fn kinetic_energy(&self, t: f64, q: &MixedConfiguration<Q>, z: &SVector<f64, Z>) -> f64 {
        results!(self.number("kinetic_energy", &[t], self.own(q), self.speeds(z)))
    }

    fn potential_energy(&self, t: f64, q: &MixedConfiguration<Q>) -> f64 {
        results!(self.number("potential_energy", &[t], self.own(q)))
    }

    fn gauss_residual(
        &self,
        t: f64,
        q: &MixedConfiguration<Q>,
        z: &SVector<f64, Z>,
        acceleration: &SVector<f64, Z>,
        input: &I,
    ) -> SVector<f64, Z> {
        let acceleration = self.speeds(acceleration);
        results!(self.vector("gauss_residual", &[t], self.own(q), self.speeds(z), acceleration, self.inputs(input)))
    }

    fn constraint_function(
        &self,
        t: f64,
        q: &MixedConfiguration<Q>,
        z: &SVector<f64, Z>,
        acceleration: &SVector<f64, Z>,
        input: &I,
    ) -> f64 {
        let acceleration = self.speeds(acceleration);
        results!(self.number(
            "constraint_function",
            &[t],
            self.own(q),
            self.speeds(z),
            acceleration,
            self.inputs(input)
        ))
    }

    fn regularity(&self, t: f64, q: &MixedConfiguration<Q>) -> f64 {
        if self.methods[const { place_of("regularity") }].is_none() {
            return 1.0;
        }
        results!(self.number("regularity", &[t], self.own(q)))
    }

    fn project(
        &self,
        t: f64,
        q: &MixedConfiguration<Q>,
        z: &SVector<f64, Z>,
    ) -> Result<(MixedConfiguration<Q>, SVector<f64, Z>), ProjectionError> {
        if CONSTRAINED { project(self, t, q, z) } else { Ok((*q, *z)) }
    }

    fn dependence(&self, t: f64, q: &MixedConfiguration<Q>, z: &SVector<f64, Z>) -> SVector<f64, Z> {
        if CONSTRAINED { dependence(self, t, q, z) } else { SVector::zero() }
    }
}

/// Multipliers are as many as there are constraints; what is behind them is zero.
impl<const Q: usize, const Z: usize, I: Inputs, const CONSTRAINED: bool> ConstrainedSystem
    for System<'_, Q, Z, I, CONSTRAINED>
{
    type Multipliers = SVector<f64, Z>;

    fn multipliers(&self, t: f64, q: &MixedConfiguration<Q>, z: &SVector<f64, Z>, input: &I) -> SVector<f64, Z> {
        results!(self.vector("multipliers", &[t], self.own(q), self.speeds(z), self.inputs(input)))
    }

    fn position_residual(&self, t: f64, q: &MixedConfiguration<Q>) -> SVector<f64, Z> {
        results!(self.vector("position_residual", &[t], self.own(q)))
    }

    fn velocity_residual(&self, t: f64, q: &MixedConfiguration<Q>, z: &SVector<f64, Z>) -> SVector<f64, Z> {
        results!(self.vector("velocity_residual", &[t], self.own(q), self.speeds(z)))
    }

    fn position_correction(&self, t: f64, q: &MixedConfiguration<Q>, residual: &SVector<f64, Z>) -> MixedVector<Q> {
        results!(self.increment("position_correction", &[t], self.own(q), self.multipliers(residual)))
    }

    fn velocity_correction(
        &self,
        t: f64,
        q: &MixedConfiguration<Q>,
        z: &SVector<f64, Z>,
        residual: &SVector<f64, Z>,
    ) -> SVector<f64, Z> {
        results!(self.vector("velocity_correction", &[t], self.own(q), self.speeds(z), self.multipliers(residual)))
    }
}
