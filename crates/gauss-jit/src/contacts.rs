//! Kernels with contacts as systems that runs and steps with contacts integrate: rooms as of [`System`], and one for
//! the rows of contacts.

use gauss_codegen::description::ContactDescription;
use gauss_runtime::__private_0_1_0::impulse_terms_of_halves;
use gauss_runtime::contact::{
    Contact, ContactFrame, ContactSystem, ImpulseDynamics, ImpulseResponse, impulse_terms, impulse_velocities,
};
use gauss_runtime::nalgebra::Vector3;
use gauss_runtime::prelude::{GaussSystem, SMatrix, SVector};

use crate::configuration::MixedConfiguration;
use crate::kernel::Kernel;
use crate::system::{Inputs, NoSystem, System, place_of, results};

/// The gap of a contact that the model does not have: it never closes.
const OPEN: f64 = 1.0;

/// A kernel with contacts as a [`ContactSystem`]: a [`System`] with room for R rows of contacts besides.
///
/// Rows that the model does not have are zero, and no contact has them. Matrices of R rows are handed on by value:
/// rooms that fit are faster.
#[derive(Clone, Copy, Debug)]
pub struct SystemWithContacts<'k, const Q: usize, const Z: usize, I, const R: usize, const CONSTRAINED: bool = false> {
    system: System<'k, Q, Z, I, CONSTRAINED>,
    contacts: &'static [Contact],
    /// The model's, in which the frames of contacts are told.
    described: &'k [ContactDescription],
    /// Number of the model's own rows.
    rows: usize,
    /// The numbers below the pivots of A, where A⁻¹Wᵀ comes in halves that there is room for.
    below_pivots: Option<(usize, usize)>,
    /// Count of the numbers of these halves.
    halves: usize,
    restitution: SVector<f64, R>,
}

impl Kernel {
    /// The kernel with its contacts as a system for `ContactRun` and `ContactSteps` of `gauss-contact`, with room for Q
    /// components of the configuration, Z speeds, inputs I, and R rows of contacts.
    ///
    /// # Errors
    /// Less room than the model needs; constraints; no contacts.
    pub fn contact_system<const Q: usize, const Z: usize, I: Inputs, const R: usize>(
        &self,
    ) -> Result<SystemWithContacts<'_, Q, Z, I, R>, NoSystem> {
        SystemWithContacts::new(self)
    }

    /// The same of a model with constraints.
    ///
    /// # Errors
    /// Less room than the model needs; no constraints; no contacts.
    pub fn constrained_contact_system<const Q: usize, const Z: usize, I: Inputs, const R: usize>(
        &self,
    ) -> Result<SystemWithContacts<'_, Q, Z, I, R, true>, NoSystem> {
        SystemWithContacts::new(self)
    }
}

impl<'k, const Q: usize, const Z: usize, I: Inputs, const R: usize, const CONSTRAINED: bool>
    SystemWithContacts<'k, Q, Z, I, R, CONSTRAINED>
{
    fn new(kernel: &'k Kernel) -> Result<Self, NoSystem> {
        let system = System::new(kernel, true)?;
        let (contacts, described) = (kernel.contacts(), &kernel.model().description().contacts[..]);
        let rows = contacts.last().map_or(0, |contact| contact.rows().end);
        if rows > R {
            return Err(NoSystem::Rows { expected: rows, found: R });
        }
        let halves = kernel.model().arguments("impulse_velocities").unwrap_or_default();
        let halves = halves.get(2).map_or(0, |halves| halves.components.len());
        let factors = kernel.model().description().factors.filter(|_| halves <= Z * R);
        let below_pivots = factors.map(|factors| (system.degrees_of_freedom(), factors));
        // It is a constant of the model, which asks no state.
        let anywhere = [1.0; Q];
        let restitution = SVector::zeros();
        let mut own = Self { system, contacts, described, rows, below_pivots, halves, restitution };
        own.restitution = results!(own.system.vector("restitution", &[0.0], &anywhere[..own.components(kernel)]));
        Ok(own)
    }

    /// Number of components of the model's configuration.
    fn components(&self, kernel: &Kernel) -> usize {
        let arguments = kernel.model().arguments("restitution").unwrap_or_default();
        arguments.iter().find(|argument| argument.name == "q").map_or(0, |argument| argument.components.len())
    }

    /// The system, without its contacts' forces.
    pub fn system(&self) -> &System<'k, Q, Z, I, CONSTRAINED> {
        &self.system
    }

    /// A matrix of the model's own rows by its own columns, in its room.
    fn matrix<const A: usize, const B: usize>(&self, numbers: &[f64], columns: usize) -> SMatrix<f64, A, B> {
        let mut matrix = SMatrix::zeros();
        for (i, row) in numbers.chunks_exact(columns.max(1)).enumerate() {
            row.iter().enumerate().for_each(|(j, entry)| matrix[(i, j)] = *entry);
        }
        matrix
    }

    /// A⁻¹Wᵀ and D from what the program gives: columns, or the halves of them, then D.
    fn response(&self, numbers: &[f64]) -> ImpulseResponse<Self> {
        let (effect, delassus) = numbers.split_at(numbers.len() - self.rows * self.rows);
        let factors = if self.below_pivots.is_some() {
            let mut halves = SMatrix::<f64, Z, R>::zeros();
            halves.as_mut_slice()[..effect.len()].copy_from_slice(effect);
            halves
        } else if self.system.has(const { place_of("impulse_velocities") }) {
            self.columns(effect)
        } else {
            self.matrix(effect, self.rows)
        };
        ImpulseResponse::new(factors, self.matrix(delassus, self.rows))
    }

    /// Velocities of impulses from halves of A⁻¹Wᵀ, which depend on nothing else.
    fn velocities(&self, halves: &[f64], impulses: &[f64]) -> SVector<f64, Z> {
        let anywhere = [0.0; Q];
        results!(self.system.vector("impulse_velocities", &[0.0], self.system.own_of(&anywhere), halves, impulses))
    }

    /// A⁻¹Wᵀ from its halves, by unit impulses.
    fn columns(&self, halves: &[f64]) -> SMatrix<f64, Z, R> {
        let (mut columns, mut impulses) = (SMatrix::<f64, Z, R>::zeros(), [0.0; R]);
        for row in 0..self.rows {
            impulses[row] = 1.0;
            columns.set_column(row, &self.velocities(halves, &impulses[..self.rows]));
            impulses[row] = 0.0;
        }
        columns
    }

    /// The halves of A⁻¹Wᵀ in the room of its columns.
    fn halves<'a>(&self, factors: &'a SMatrix<f64, Z, R>) -> &'a [f64] {
        &factors.as_slice()[..self.halves]
    }
}

impl<'k, const Q: usize, const Z: usize, I: Inputs, const R: usize, const CONSTRAINED: bool> GaussSystem
    for SystemWithContacts<'k, Q, Z, I, R, CONSTRAINED>
{
    gauss_runtime::forward_system!(
        System<'k, Q, Z, I, CONSTRAINED> => system: types motion dynamics momenta energies condition constraints
    );

    const CHART: gauss_runtime::chart::Chart = gauss_runtime::chart::Chart::Own;
    const CONSTRAINED: bool = CONSTRAINED;
    const HAS_CONTACTS: bool = true;

    fn keeps_energy(&self) -> bool {
        self.system.keeps_energy()
    }
}

impl<const Q: usize, const Z: usize, I: Inputs, const R: usize, const CONSTRAINED: bool> ContactSystem
    for SystemWithContacts<'_, Q, Z, I, R, CONSTRAINED>
{
    type Gaps = SVector<f64, R>;
    type ContactRows = SVector<f64, R>;
    type ContactColumns = SMatrix<f64, Z, R>;
    type ImpulseFactors = Self::ContactColumns;
    type Delassus = SMatrix<f64, R, R>;
    type EachContact<T: Copy + std::fmt::Debug> = [T; R];
    type EachRow<T: Copy + std::fmt::Debug> = [T; R];

    fn contacts(&self) -> &'static [Contact] {
        self.contacts
    }

    fn gaps(&self, t: f64, q: &MixedConfiguration<Q>) -> Self::Gaps {
        let mut gaps: Self::Gaps = results!(self.system.vector("gaps", &[t], self.system.own(q)));
        gaps.as_mut_slice()[self.contacts.len()..].fill(OPEN);
        gaps
    }

    fn contact_rates(&self, t: f64, q: &MixedConfiguration<Q>, z: &SVector<f64, Z>) -> Self::ContactRows {
        results!(self.system.vector("contact_rates", &[t], self.system.own(q), self.system.speeds(z)))
    }

    fn contact_jacobian(&self, t: f64, q: &MixedConfiguration<Q>) -> Self::ContactColumns {
        self.matrix(&results!(self.system.numbers("contact_jacobian", &[t], self.system.own(q))), self.rows)
    }

    fn contact_frame(&self, contact: usize, t: f64, q: &MixedConfiguration<Q>) -> Option<ContactFrame<f64>> {
        let own = self.described.get(contact).filter(|own| own.axes > 0)?;
        // A point and its axes for each that has them.
        let vectors = |own: &ContactDescription| if own.axes > 0 { 1 + own.axes } else { 0 };
        let first: usize = self.described[..contact].iter().map(vectors).sum();
        let numbers = results!(self.system.numbers("contact_frames", &[t], self.system.own(q)));
        let vector = |k: usize| Vector3::from_column_slice(&numbers[3 * (first + k)..3 * (first + k) + 3]);
        let tangents: Vec<_> = (2..=own.axes).map(vector).collect();
        Some(ContactFrame::new(vector(0), vector(1), &tangents))
    }

    fn friction(&self, t: f64, q: &MixedConfiguration<Q>, z: &SVector<f64, Z>, input: &I) -> Self::ContactRows {
        results!(self.system.vector(
            "friction",
            &[t],
            self.system.own(q),
            self.system.speeds(z),
            self.system.inputs(input)
        ))
    }

    fn restitution(&self) -> Self::Gaps {
        self.restitution
    }

    fn impulse_response(&self, t: f64, q: &MixedConfiguration<Q>) -> ImpulseResponse<Self> {
        self.response(&results!(self.system.numbers("impulse_response", &[t], self.system.own(q))))
    }

    fn impulse_dynamics(
        &self,
        t: f64,
        q: &MixedConfiguration<Q>,
        z: &SVector<f64, Z>,
        input: &I,
    ) -> ImpulseDynamics<Self> {
        let (q, z, input) = (self.system.own(q), self.system.speeds(z), self.system.inputs(input));
        let numbers = results!(self.system.numbers("impulse_dynamics", &[t], q, z, input));
        let (acceleration, rest) = numbers.split_at(self.system.degrees_of_freedom());
        let (bias, response) = rest.split_at(self.rows);
        ImpulseDynamics::new(widened(acceleration), widened(bias), self.response(response))
    }

    fn impulse_velocities(&self, factors: &Self::ImpulseFactors, impulses: &Self::ContactRows) -> Self::Speeds {
        match self.below_pivots {
            None => impulse_velocities::<Self>(factors, impulses),
            Some(_) => self.velocities(self.halves(factors), &impulses.as_slice()[..self.rows]),
        }
    }

    fn impulse_terms(&self, factors: &Self::ImpulseFactors, impulses: &Self::ContactRows) -> Self::Speeds {
        match self.below_pivots {
            None => impulse_terms::<Self>(factors, impulses),
            Some((pivots, rows)) => impulse_terms_of_halves(self, (factors, impulses), pivots..rows),
        }
    }

    fn contact_columns(&self, factors: &Self::ImpulseFactors) -> Self::ContactColumns {
        if self.below_pivots.is_some() { self.columns(self.halves(factors)) } else { *factors }
    }
}

/// The numbers, and zeros behind them.
fn widened<const N: usize>(numbers: &[f64]) -> SVector<f64, N> {
    SVector::from_fn(|i, _| numbers.get(i).copied().unwrap_or(0.0))
}
