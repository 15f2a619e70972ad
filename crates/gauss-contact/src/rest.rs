//! Bounces and rocking that pile up, and how they end in rest.

use alloc::vec;
use alloc::vec::Vec;

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::real::Real;

use crate::decide::{Choice, Instant, Scales, takes_impulses};
use crate::dense::{Matrix, value};
use crate::error::ContactError;
use crate::friction::Bounds;
use crate::history::EventKind;
use crate::impact::{after, rows};
use crate::law::Law;
use crate::solver::Contacts;
use crate::trajectory::ContactTrajectory;

impl<'k, K: ContactSystem> Instant<'k, K> {
    /// Whether the impacts to come are over where a gap has just been left at a small rate: bounces end after
    /// 2 ġ/(|g̈| (1 − e)). Where another contact struck and this one leaves, as of what rocks, each impact leaves the
    /// same part of the rate as this one has.
    pub(crate) fn comes_to_rest(
        &self,
        (i, (struck, approach)): (usize, (usize, f64)),
        (accelerations, choice): (&[f64], &Choice<K::Scalar>),
        scales: &Scales,
    ) -> Option<EventKind> {
        let normal = self.kernel.contacts()[i].normal;
        let sizes = self.sizes(scales);
        let (speed, fall) = (value(sizes.rates.component(normal)), -accelerations[normal]);
        // What others hold as they come to rest.
        if speed <= choice.still[normal] {
            return Some(EventKind::Closes);
        }
        let e = value(self.kernel.restitution().component(i));
        if !(fall > 0.0 && e < 1.0) {
            return None;
        }
        let left = Some(speed / approach).filter(|left| struck != i && *left < 1.0).map_or(e, |left| left.max(e));
        let (height, remaining) = (speed * speed / (2.0 * fall), 2.0 * speed / (fall * (1.0 - left)));
        let over = speed <= scales.rest()
            || height <= 8.0 * sizes.rounding[i]
            || remaining <= 16.0 * scales.resolution(value(self.t));
        over.then_some(EventKind::Rests { speed, height, remaining })
    }

    /// Takes the rate of a gap away at which bounces are left out, while what else rests stays at rest. In all of them
    /// together a contact passes on what it would at rest in that time, less this momentum; so friction of a contact
    /// that slides is less by as much.
    pub(crate) fn leave_out_bounces(
        &mut self,
        i: usize,
        choice: &Choice<K::Scalar>,
        made: &ContactTrajectory<'k, K>,
    ) -> Result<(), ContactError> {
        let rests = |n: &usize| choice.resting[*n] && takes_impulses(&self.kernel.contacts()[*n]);
        let contacts: Vec<usize> = (0..self.kernel.contacts().len()).filter(rests).collect();
        let friction = self.friction(made)?;
        let law = |&n: &usize| {
            let contact = &self.kernel.contacts()[n];
            Law::new(contact, Bounds::of(contact, &friction), self.slides(n, choice)).among(contact, &contacts)
        };
        let laws = contacts.iter().map(law).collect();
        let rates = self.kernel.contact_rates(self.t, &self.q, &self.z);
        let response = self.kernel.contact_response(self.t, &self.q);
        let rows = rows(self.kernel, &contacts);
        let matrix = Matrix::from_fn(rows.len(), |a, b| response.delassus[(rows[a], rows[b])]);
        let before = rows.iter().map(|&row| rates.component(row)).collect();
        let mut impulses = vec![K::Scalar::zero(); K::ContactRows::DIM];
        let stops = Contacts::new(laws, matrix, before).stops();
        rows.iter().zip(stops).for_each(|(&row, impulse)| impulses[row] = impulse);
        // Else the rates alone are taken away, with the projection.
        if value(impulses[self.kernel.contacts()[i].normal]) < 0.0 {
            self.z = after::<K>(&response, &self.z, &impulses);
        }
        Ok(())
    }
}
