//! Forces of contacts that depend on one another, as four corners of a box on a floor.

use alloc::vec;
use alloc::vec::Vec;

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::{Contact, ContactSystem};
use gauss_runtime::real::Real;

use crate::decide::Instant;
use crate::dense::{Matrix, value};
use crate::friction::Bounds;
use crate::impact::rows;
use crate::law::Law;
use crate::mode::{InMode, Loads, Mode, tangents};
use crate::solution::State;
use crate::solver::Contacts;
use crate::trajectory::ContactTrajectory;
use crate::witness::Watched;

/// The forces that are deepest inside the bounds of their laws, of all that make one motion.
pub(crate) struct Shared<K: ContactSystem> {
    /// The least of what the bounds leave, as a part of the forces; negative where no forces are inside.
    pub(crate) part: f64,
    /// λ, all rows.
    pub(crate) forces: Vec<K::Scalar>,
    /// The weight of the bounds of each contact in that part; together 1.
    weights: Vec<f64>,
}

/// Bounds that have less to do with it do not bind.
const BINDS: f64 = 1e-4;
/// A normal force that is a smaller part of the largest force is none.
const NONE: f64 = 1e-6;

impl<K: ContactSystem> Shared<K> {
    /// The contacts whose bounds are reached first.
    pub(crate) fn binding(&self) -> impl Iterator<Item = usize> {
        (0..self.weights.len()).filter(|&i| self.weights[i] > BINDS)
    }

    /// Whether the contact does not press.
    pub(crate) fn is_free(&self, contact: &Contact) -> bool {
        let size = |force: &K::Scalar| value(*force).abs();
        let largest = self.forces.iter().map(size).fold(0.0, f64::max);
        contact.has_gap() && size(&self.forces[contact.normal]) <= NONE * largest
    }
}

impl<K: ContactSystem> InMode<'_, K> {
    /// Whether forces are within the bounds of what presses and what sticks.
    pub(crate) fn keeps_laws(&self, loads: &Loads<K>, friction: &K::ContactRows) -> bool {
        self.closed().all(|(_, contact, mode)| {
            let rounding = loads.rounding(contact);
            let presses = !contact.has_gap() || value(loads.forces[contact.normal]) >= -rounding;
            let bounds = Bounds::of(contact, friction);
            presses
                && (mode != Mode::Sticks || value(loads.reserve(self.kernel.contacts(), contact, bounds)) >= -rounding)
        })
    }

    /// The forces deepest inside of contacts that stick or stay closed, where they depend on one another and none
    /// slides. Numbers with derivatives follow each force by itself.
    pub(crate) fn reserve(
        &self,
        (t, q, z): (K::Scalar, &K::Configuration, &K::Speeds),
        input: &K::Input,
    ) -> Option<Shared<K>> {
        if K::Scalar::DERIVATIVES || self.closed().any(|(.., mode)| matches!(mode, Mode::Slides(_))) {
            return None;
        }
        let contacts: Vec<usize> = self.closed().map(|(i, ..)| i).collect();
        if contacts.is_empty() {
            return None;
        }
        let friction = self.kernel.friction(t, q, z, input);
        let law = |(_, contact, _): (usize, &Contact, _)| {
            Law::new(contact, Bounds::of(contact, &friction), None).among(contact, &contacts)
        };
        let laws = self.closed().map(law).collect();
        let state = |(.., mode): (usize, &Contact, Mode<K::Scalar>)| {
            if mode == Mode::Sticks { State::Sticks } else { State::Closed }
        };
        let states: Vec<State> = self.closed().map(state).collect();
        let rows = rows(self.kernel, &contacts);
        let dynamics = self.kernel.contact_dynamics(t, q, z, input);
        let matrix = Matrix::from_fn(rows.len(), |i, j| dynamics.response.delassus[(rows[i], rows[j])]);
        let bias = rows.iter().map(|&row| dynamics.bias.component(row)).collect();
        let laws = Contacts::new(laws, matrix, bias);
        let found = laws.values().reserve(&states)?;
        let mut forces = vec![K::Scalar::zero(); K::ContactRows::DIM];
        for ((&row, force), scale) in rows.iter().zip(&found.forces).zip(laws.scales()) {
            forces[row] = K::Scalar::from_f64(*force) * scale;
        }
        let mut weights = vec![0.0; self.kernel.contacts().len()];
        contacts.iter().zip(&found.weights).for_each(|(&i, weight)| weights[i] = *weight);
        Some(Shared { part: found.part, forces, weights })
    }
}

/// A contact that begins to slide, and its direction.
pub(crate) type Slip<T> = (usize, [T; 3]);

impl<'k, K: ContactSystem> Instant<'k, K> {
    /// The contacts whose force has fallen to zero, and those that stuck and begin to slide: against their friction.
    pub(crate) fn gives_way(&self, made: &ContactTrajectory<'k, K>) -> (Vec<usize>, Vec<Slip<K::Scalar>>) {
        let system = InMode::new(self.kernel, &self.modes);
        let input = (made.input)(self.t, &self.q, &self.z);
        let friction = || self.kernel.friction(self.t, &self.q, &self.z, &input);
        match self.fired {
            Some(Watched::Force(i)) => (vec![i], Vec::new()),
            Some(Watched::Cone(i)) => {
                let loads = system.loads(self.t, &self.q, &self.z, &input);
                let contact = &self.kernel.contacts()[i];
                let along = Bounds::of(contact, &friction()).gives_way(&loads.forces[tangents(contact)]);
                (Vec::new(), along.into_iter().map(|along| (i, along)).collect())
            }
            Some(Watched::Reserve(_)) => {
                let Some(reserve) = system.reserve((self.t, &self.q, &self.z), &input) else {
                    return Default::default();
                };
                let friction = friction();
                let (mut leaves, mut slides) = (Vec::new(), Vec::new());
                for i in reserve.binding() {
                    let contact = &self.kernel.contacts()[i];
                    let along = Bounds::of(contact, &friction).gives_way(&reserve.forces[tangents(contact)]);
                    match along.filter(|_| !reserve.is_free(contact)) {
                        Some(along) => slides.push((i, along)),
                        None if contact.has_gap() => leaves.push(i),
                        None => {}
                    }
                }
                (leaves, slides)
            }
            _ => Default::default(),
        }
    }
}
