//! Poisson's law of impact, in two phases.

use alloc::vec;
use alloc::vec::Vec;

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::real::Real;

use crate::dense::{Matrix, epsilon, value};
use crate::friction::Bounds;
use crate::impact::{Blow, Struck, rows};
use crate::law::{Law, carrier};
use crate::residual::Residual;
use crate::solution::Failure;
use crate::solver::Contacts;

/// The impulses of restitution on the rows that were struck, and the rates after it.
struct Restitution<T> {
    impulses: Vec<T>,
    rates: Vec<T>,
    residuals: Vec<(usize, Residual)>,
}

impl<K: ContactSystem> Struck<'_, K> {
    /// Compression, then restitution.
    pub(crate) fn poisson(&self) -> Result<Blow<K::Scalar>, Failure> {
        let rows = rows(self.kernel, self.contacts);
        let laws = self.contacts.iter().map(|&i| self.law(&self.kernel.contacts()[i])).collect();
        let matrix = Matrix::from_fn(rows.len(), |a, b| self.response.delassus[(rows[a], rows[b])]);
        let before = rows.iter().map(|&row| self.rates.component(row)).collect();
        let noise = rows.iter().map(|&row| self.noise[row]);
        let compression = Contacts::new(laws, matrix.clone(), before).known_to(noise).solve()?;
        let place = |i: &usize| rows.iter().position(|row| *row == self.kernel.contacts()[*i].normal);
        let first: Vec<usize> = self.contacts.iter().filter_map(place).collect();
        let e = |n: usize| self.restitution.component(self.contacts[n]);
        let least: Vec<K::Scalar> = (0..first.len()).map(|n| e(n) * compression.forces[first[n]]).collect();
        // Which contacts pass on more than e times what they did: those that would close again.
        let mut more = vec![false; first.len()];
        let mut worst = Residual::default();
        for _ in 0..2 * first.len() + 2 {
            let found = self.restitution(&first, &matrix, (&compression.rates, &least), &more)?;
            let mut changed = false;
            for n in (0..first.len()).filter(|&n| self.kernel.contacts()[self.contacts[n]].has_gap()) {
                let normal = first[n];
                let terms = matrix.row(normal).iter().zip(&found.impulses).map(|(d, x)| value(*d * *x).abs());
                let size = terms.fold(value(compression.rates[normal]).abs(), |sum, x| sum + x);
                let rounding = (256.0 * epsilon::<K::Scalar>() * size).max(compression.residuals[n].rounding);
                let short = matrix.at(normal, normal) * (least[n] - found.impulses[normal]);
                let wrong = value(if more[n] { short } else { -found.rates[normal] });
                if wrong > rounding {
                    worst = Residual { signorini: wrong, rounding, ..Residual::default() };
                    more[n] = !more[n];
                    changed = true;
                }
            }
            if !changed {
                let mut impulses = vec![K::Scalar::zero(); K::ContactRows::DIM];
                for (k, &row) in rows.iter().enumerate() {
                    impulses[row] = compression.forces[k] + found.impulses[k];
                }
                let each = self.contacts.iter().zip(compression.residuals).enumerate();
                let residuals = each.map(|(n, (&i, residual))| {
                    let later = found.residuals.iter().filter(|(m, _)| *m == n).map(|(_, residual)| *residual);
                    (i, later.fold(residual, Residual::worse))
                });
                return Ok(Blow { impulses, residuals: residuals.collect() });
            }
        }
        Err(Failure::NotFound(worst))
    }

    /// Restitution where the contacts that pass on `more` keep their gaps, and the others have the `least` impulses,
    /// which bound their friction.
    fn restitution(
        &self,
        first: &[usize],
        matrix: &Matrix<K::Scalar>,
        (rates, least): (&[K::Scalar], &[K::Scalar]),
        more: &[bool],
    ) -> Result<Restitution<K::Scalar>, Failure> {
        let mut impulses = vec![K::Scalar::zero(); rates.len()];
        let (mut rows, mut laws, mut owners) = (Vec::new(), Vec::new(), Vec::new());
        for (n, &i) in self.contacts.iter().enumerate() {
            let contact = &self.kernel.contacts()[i];
            let all = first[n]..first[n] + contact.rows().len();
            // The contact with the normal impulse.
            let carries = self.contacts.iter().position(|&c| c == carrier(self.kernel.contacts(), i)).unwrap_or(n);
            if more[carries] {
                rows.extend(all);
                let on = owners.iter().position(|owner| *owner == carries);
                laws.push(Law { on, ..self.law(contact) });
                owners.push(n);
            } else {
                if contact.has_gap() {
                    impulses[first[n]] = least[n];
                }
                if !contact.friction_rows().is_empty() && value(least[carries]) > 0.0 {
                    rows.extend(all.end - contact.friction_rows().len()..all.end);
                    let bounds = Bounds::of(contact, self.friction);
                    laws.push(Law::dry(contact, Bounds { largest: bounds.largest * least[carries], ..bounds }));
                    owners.push(n);
                }
            }
        }
        let rate = |impulses: &[K::Scalar], row: usize| {
            matrix.row(row).iter().zip(impulses).fold(rates[row], |sum, (d, x)| sum + *d * *x)
        };
        let b = rows.iter().map(|&row| rate(&impulses, row)).collect();
        let part = Matrix::from_fn(rows.len(), |a, b| matrix.at(rows[a], rows[b]));
        let all: Vec<usize> = self.contacts.iter().flat_map(|&i| self.kernel.contacts()[i].rows()).collect();
        let noise = rows.iter().map(|&row| 2.0 * self.noise[all[row]]);
        let found = Contacts::new(laws, part, b).known_to(noise).solve()?;
        rows.iter().zip(&found.forces).for_each(|(&row, x)| impulses[row] = *x);
        let rates = (0..rates.len()).map(|row| rate(&impulses, row)).collect();
        Ok(Restitution { impulses, rates, residuals: owners.into_iter().zip(found.residuals).collect() })
    }
}
