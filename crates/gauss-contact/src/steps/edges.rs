//! Contacts that are at a change of their mode, within what the laws are solved to: derivatives hold on one side there.

use core::fmt;

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::{Contact, ContactSystem};
use gauss_runtime::dual::Dual;

use crate::dense::value;
use crate::mode::Mode;

use super::active::Active;

/// A contact at a change of its mode: the derivatives of the step are those of the mode that the step has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct AtChange {
    /// The contact, by its name.
    pub contact: &'static str,
    /// Between which modes.
    pub change: Change,
}

/// Between which modes a contact is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Change {
    /// Open and closed: the gap would just close in the step, or nothing presses the contact.
    OpenClosed,
    /// Sticking and sliding: friction is at its bound without a slip.
    SticksSlides,
    /// Rest and an impact: a closed gap with restitution, without an approach before the step. Derivatives are those of
    /// an approach.
    RestImpact,
}

impl fmt::Display for AtChange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { contact, change } = self;
        match change {
            Change::OpenClosed => write!(f, "contact `{contact}` is between open and closed"),
            Change::SticksSlides => write!(f, "contact `{contact}` is between sticking and sliding"),
            Change::RestImpact => write!(f, "contact `{contact}` is between rest and an impact"),
        }
    }
}

/// Data of contacts in a step, in values.
pub(super) struct Known<'a> {
    pub(super) contacts: &'a [Contact],
    pub(super) gaps: &'a dyn Fn(usize) -> f64,
    pub(super) restitution: &'a dyn Fn(usize) -> f64,
    /// Rates before the step, and without impulses after it, row by row.
    pub(super) before: &'a dyn Fn(usize) -> f64,
    pub(super) free: &'a dyn Fn(usize) -> f64,
    pub(super) h: f64,
    /// The part of the terms of a rate that is nothing.
    pub(super) tolerance: f64,
}

/// The first open gap that would just be brought to zero at the end of a step, or just not: gaps before that and after.
pub(super) fn of_gaps<L: ContactSystem>(
    kernel: &L,
    (before, after): (&L::Gaps, &L::Gaps),
    rests: &[bool],
    nothing: f64,
) -> Option<AtChange> {
    let at_edge = |(i, contact): &(usize, &Contact)| {
        let [before, after] = [before, after].map(|gaps| value(gaps.component(*i)));
        contact.has_gap() && !rests[*i] && if before < 0.0 { -before <= nothing } else { after <= nothing }
    };
    let found = kernel.contacts().iter().enumerate().find(at_edge);
    found.map(|(_, contact)| AtChange { contact: contact.name, change: Change::OpenClosed })
}

impl Known<'_> {
    /// The gap with which the step would end by a rate.
    fn end(&self, contact: usize, row: usize, rate: f64) -> f64 {
        (self.gaps)(contact) + 0.5 * self.h * ((self.before)(row) + rate)
    }

    /// Whether it is zero.
    fn ends_at_zero(&self, contact: usize, row: usize, rate: f64) -> bool {
        let (gap, way) = ((self.gaps)(contact), 0.5 * self.h);
        self.end(contact, row, rate).abs()
            <= self.tolerance * (gap.abs() + way * ((self.before)(row).abs() + rate.abs()))
    }

    /// The first open gap that would just close; where no contact acts.
    pub(super) fn in_flight(&self) -> Option<AtChange> {
        let open = self.contacts.iter().enumerate().filter(|(_, contact)| contact.has_gap());
        let mut at_zero =
            open.filter(|(i, contact)| self.ends_at_zero(*i, contact.normal, (self.free)(contact.normal)));
        at_zero.next().map(|(_, contact)| AtChange { contact: contact.name, change: Change::OpenClosed })
    }

    /// The first contact at a change of its mode.
    pub(super) fn among<const N: usize, K: ContactSystem<Scalar = Dual<N>>>(
        &self,
        modes: &[Mode],
        active: &Active<K>,
        impulses: &[Dual<N>],
    ) -> Option<AtChange> {
        let find = |(i, mode): (usize, &Mode)| {
            let change = self.normal(i, mode, active, impulses).or_else(|| self.friction(i, mode, active, impulses));
            change.map(|change| AtChange { contact: self.contacts[i].name, change })
        };
        modes.iter().enumerate().find_map(find)
    }

    fn normal<const N: usize, K: ContactSystem<Scalar = Dual<N>>>(
        &self,
        i: usize,
        mode: &Mode,
        active: &Active<K>,
        impulses: &[Dual<N>],
    ) -> Option<Change> {
        let contact = &self.contacts[i];
        if !contact.has_gap() {
            return None;
        }
        let row = contact.normal;
        let nothing = self.tolerance * active.terms(row, impulses);
        // Whether it takes part is decided by the rate without impulses, or by that which others leave.
        let was_open = (self.gaps)(i) > 0.0 && self.ends_at_zero(i, row, (self.free)(row));
        let edge = if mode.is_closed() {
            active.delassus[(row, row)].value * impulses[row].value <= nothing
        } else {
            let rate = active.rate(row, impulses).value;
            let acts = self.end(i, row, (self.free)(row)) <= 0.0;
            let passed = -(self.restitution)(i) * (self.before)(row).min(0.0);
            self.ends_at_zero(i, row, rate) || (acts && (rate - passed).abs() <= nothing)
        };
        let rests = mode.is_closed() && (self.restitution)(i) > 0.0 && (self.before)(row).abs() <= nothing;
        if was_open || edge { Some(Change::OpenClosed) } else { rests.then_some(Change::RestImpact) }
    }

    fn friction<const N: usize, K: ContactSystem<Scalar = Dual<N>>>(
        &self,
        i: usize,
        mode: &Mode,
        active: &Active<K>,
        impulses: &[Dual<N>],
    ) -> Option<Change> {
        let rows = self.contacts[i].friction_rows();
        let nothing = self.tolerance * rows.clone().map(|row| active.terms(row, impulses)).fold(0.0, f64::max);
        let edge = match mode {
            Mode::Sticks => {
                let bounds = active.bounds[i].values();
                let forces: [f64; 3] =
                    core::array::from_fn(|k| impulses.get(rows.start + k).map_or(0.0, |impulse| impulse.value));
                let reserve = bounds.largest * active.pressed(i, impulses).value - bounds.size(&forces[..rows.len()]);
                active.scale(i) * reserve <= nothing
            }
            Mode::Slides(_) => active.slip(i, impulses).iter().all(|s| s.value.abs() <= nothing),
            Mode::Open | Mode::Closed => false,
        };
        edge.then_some(Change::SticksSlides)
    }
}
