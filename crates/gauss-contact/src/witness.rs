//! Functions that pass through zero where the modes of a segment end.

use alloc::rc::Rc;
use alloc::vec::Vec;
use core::cell::RefCell;

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::integrate::drive::bounded::RateBound;
use gauss_runtime::integrate::problem::state::{Rates, State};
use gauss_runtime::real::Real;

use crate::dense::{dot, norm, value};
use crate::friction::Bounds;
use crate::history::SampledGap;
use crate::law::carrier;
use crate::mode::{InMode, Mode, slip, tangents};
use crate::problem::InModeProblem;

/// Values that are watched, by the number of the contact. All of them fall to zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Watched {
    /// The gap of an open contact.
    Gap(usize),
    /// λ_N of a closed one.
    Force(usize),
    /// The slip along the direction at the start of the segment.
    Slip(usize),
    /// |s| of a contact with several rows of friction, above a level.
    Speed(usize, f64),
    /// μ λ_N − |λ_T| of a contact that sticks, f − |λ| of dry friction.
    Cone(usize),
    /// The reserve of forces to the bounds of contacts that depend on one another, by the number of the first.
    Reserve(usize),
    /// p of a contact that slides: how its normal force, with its friction, moves its gap (P. Painlevé).
    Pushes(usize),
}

impl Watched {
    /// The number of the contact.
    pub(crate) fn contact(self) -> usize {
        match self {
            Self::Gap(i)
            | Self::Force(i)
            | Self::Slip(i)
            | Self::Speed(i, _)
            | Self::Cone(i)
            | Self::Reserve(i)
            | Self::Pushes(i) => i,
        }
    }
}

/// A bound of the rate of an open gap.
pub(crate) struct GapBound<'k, K: ContactSystem> {
    pub(crate) problem: InModeProblem<'k, K>,
    pub(crate) contact: usize,
    /// Gaps that are known by samples alone, and when.
    pub(crate) sampled: Rc<RefCell<Vec<SampledGap>>>,
}

impl<'k, K: ContactSystem> GapBound<'k, K> {
    /// The bound of the gap that a witness watches, if it watches one.
    pub(crate) fn of(witness: &Witness<'k, K>, sampled: &Rc<RefCell<Vec<SampledGap>>>) -> Option<Self> {
        let Watched::Gap(contact) = witness.watched else { return None };
        Some(Self { problem: witness.problem.clone(), contact, sampled: Rc::clone(sampled) })
    }
}

impl<'k, K: ContactSystem> RateBound<InMode<'k, K>> for GapBound<'k, K> {
    fn bound(&self, state: &State<InMode<'k, K>>, rates: &Rates<InMode<'k, K>>) -> [f64; 2] {
        self.problem.bounds(state, rates)[self.contact]
    }

    fn rate(&self, State { t, q, y }: &State<InMode<'k, K>>) -> f64 {
        value(
            self.problem
                .system
                .kernel
                .contact_rates(*t, q, y)
                .component(self.problem.system.kernel.contacts()[self.contact].normal),
        )
    }

    fn look(&self) -> Option<f64> {
        let moves = self.problem.system.kernel.contacts()[self.contact].moves;
        moves.then_some(self.problem.moving.look)
    }

    fn sampled(&self, start: f64, end: f64) {
        let (mut sampled, contact) = (self.sampled.borrow_mut(), self.contact);
        match sampled.last_mut() {
            Some(last) if last.contact == contact && last.end == start => last.end = end,
            _ => sampled.push(SampledGap { contact, start, end }),
        }
    }
}

/// A function with what is added to it.
///
/// What has just changed starts on zero, to rounding. A gap or a slip is shifted to start there exactly: a function
/// that starts on zero is seen to leave it and to come back, however short the flight. Forces are shifted to start
/// above zero: those that fall at once are events at once.
pub(crate) struct Witness<'k, K: ContactSystem> {
    pub(crate) problem: InModeProblem<'k, K>,
    pub(crate) watched: Watched,
    pub(crate) shift: f64,
}

impl<K: ContactSystem> Witness<'_, K> {
    pub(crate) fn value(&self, t: K::Scalar, q: &K::Configuration, z: &K::Speeds) -> K::Scalar {
        self.bare(t, q, z) + K::Scalar::from_f64(self.shift)
    }

    pub(crate) fn bare(&self, t: K::Scalar, q: &K::Configuration, z: &K::Speeds) -> K::Scalar {
        let kernel = self.problem.system.kernel;
        let slip_of = |i: usize| slip(&self.problem.system.kernel.contacts()[i], &kernel.contact_rates(t, q, z));
        let input = || (self.problem.input)(t, q, z);
        match self.watched {
            Watched::Gap(i) => kernel.gaps(t, q).component(i),
            Watched::Slip(i) => {
                let (s, reference) = (slip_of(i), self.reference(i));
                dot(&s, &reference)
            }
            Watched::Speed(i, level) => {
                let slip = slip_of(i);
                let speed = norm(&slip);
                // Of a slip that has gone straight it falls on beyond zero: its time has derivatives wherever near zero
                // it is found.
                let along = value(dot(&slip, &self.reference(i)));
                let beyond = K::Scalar::DERIVATIVES && along < -0.99 * value(speed);
                (if beyond { -speed } else { speed }) - K::Scalar::from_f64(level)
            }
            Watched::Force(i) => self.problem.loads(t, q, z).forces[self.problem.system.kernel.contacts()[i].normal],
            Watched::Cone(i) => {
                let (loads, contact) = (self.problem.loads(t, q, z), &self.problem.system.kernel.contacts()[i]);
                loads.reserve(kernel.contacts(), contact, Bounds::of(contact, &kernel.friction(t, q, z, &input())))
            }
            Watched::Reserve(_) => {
                let (system, loads) = (&self.problem.system, self.problem.loads(t, q, z));
                // Where forces of least norm keep the laws there is nothing to look for.
                let keeps = system.keeps_laws(&loads, &kernel.friction(t, q, z, &input()));
                let shared = if keeps { None } else { system.reserve((t, q, z), &input()) };
                K::Scalar::from_f64(shared.map_or(1.0, |shared| shared.part))
            }
            Watched::Pushes(i) => self.pushes(i, t, q, z),
        }
    }

    fn reference(&self, i: usize) -> [K::Scalar; 3] {
        match self.problem.system.modes()[i] {
            Mode::Slides(reference) => reference,
            _ => [K::Scalar::zero(); 3],
        }
    }

    /// p over its own first term.
    fn pushes(&self, i: usize, t: K::Scalar, q: &K::Configuration, z: &K::Speeds) -> K::Scalar {
        let kernel = self.problem.system.kernel;
        let normal = self.problem.system.kernel.contacts()[i].normal;
        let input = (self.problem.input)(t, q, z);
        let loads = self.problem.loads(t, q, z);
        let delassus = &loads.dynamics.response.delassus;
        let friction = kernel.friction(t, q, z, &input);
        let mut coupled = K::Scalar::zero();
        // With the resistance to rolling on it.
        for n in (0..self.problem.system.kernel.contacts().len())
            .filter(|&n| carrier(self.problem.system.kernel.contacts(), n) == i)
        {
            let contact = &self.problem.system.kernel.contacts()[n];
            if !matches!(self.problem.system.modes()[n], Mode::Slides(_)) {
                continue;
            }
            let along = self.problem.system.direction(contact, self.reference(n), (t, q, z));
            let against = Bounds::of(contact, &friction).against(along);
            for (row, f) in tangents(contact).zip(against) {
                coupled += f * delassus[(normal, row)];
            }
        }
        let diagonal = delassus[(normal, normal)];
        K::Scalar::one() + coupled / diagonal.max(K::Scalar::from_f64(f64::MIN_POSITIVE))
    }
}
