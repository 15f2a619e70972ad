//! Laws of impact.

use alloc::vec;
use alloc::vec::Vec;

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::{Contact, ContactResponse, ContactSystem};
use gauss_runtime::forces::Columns;
use gauss_runtime::real::Real;

use crate::dense::Matrix;
use crate::friction::Bounds;
use crate::law::{Law, carrier};
use crate::residual::Residual;
use crate::solution::Failure;
use crate::solver::Contacts;

/// Law of an impact, by which the velocities u⁻ of the contacts that are closed jump: `u⁺ = u⁻ + D Λ` with impulses Λ.
///
/// A gap that opens before the impact may close after it, at e times its rate: it strikes again at once, which takes
/// more energy away. Held to stay open instead, it would give energy: three balls that fall on one another would.
/// Dry friction has no part in impacts: its force is bounded, and so is its impulse by zero in no time. Rolling
/// resistance has: its impulse is bounded by ρ times that of the normal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
#[doc(alias = "impact")]
#[doc(alias = "restitution")]
#[doc(alias = "bounce")]
pub enum Impact {
    /// All contacts at once: `ġ⁺ + e ġ⁻ ≥ 0` complementary to Λ_N, and Coulomb's law between Λ_T and the slip s⁺ after
    /// the impact: no restitution along tangents. With friction it can create energy (T. R. Kane 1984): such a run ends
    /// with an error.
    #[default]
    Newton,
    /// All contacts at once: both laws for the mean `ū = (u⁺ + e u⁻)/(1 + e)`, with one e for normal and tangents of
    /// a contact. Where all contacts have the same e, the energy cannot grow:
    /// `ΔT = Λᵀ ū − ½ (1 − e)/(1 + e) Λᵀ D Λ`, and neither term is positive (J. J. Moreau 1988).
    Moreau,
    /// All contacts at once, in two phases. Compression ends with the laws of Signorini and Coulomb for velocities
    /// without restitution; in restitution each contact passes on e times its normal impulse of compression, or more
    /// if it would close again, with Coulomb's friction between that and the slip at the end (S. D. Poisson; for
    /// several contacts C. Glocker & F. Pfeiffer 1995). Where all contacts have the same e the energy cannot grow,
    /// with friction either: `ΔT ≤ −½ |Λ_R − e Λ_C|² − ½ (1 − e²) |Λ_C|²` in the metric of D, since friction of
    /// restitution could be e times that of compression and takes no less power from the slip at the end.
    Poisson,
    /// Newton's law for one contact after another, that which closes fastest first, as if the others were not there.
    /// Of Newton's cradle the last ball leaves alone.
    Sequential,
}

/// A part of the contacts at an impact, with all velocities before.
pub(crate) struct Struck<'a, K: ContactSystem> {
    pub(crate) kernel: &'a K,
    /// Which, by their numbers.
    pub(crate) contacts: &'a [usize],
    pub(crate) response: &'a ContactResponse<K>,
    pub(crate) rates: &'a K::ContactRows,
    /// The rounding of the rates.
    pub(crate) noise: &'a [f64],
    pub(crate) friction: &'a K::ContactRows,
    pub(crate) restitution: &'a K::Gaps,
}

/// Impulses of all rows, and the residual of each contact that was struck.
pub(crate) struct Blow<T> {
    pub(crate) impulses: Vec<T>,
    pub(crate) residuals: Vec<(usize, Residual)>,
}

/// The rows of some contacts, one contact after the other.
pub(crate) fn rows<K: ContactSystem>(kernel: &K, contacts: &[usize]) -> Vec<usize> {
    contacts.iter().flat_map(|&i| kernel.contacts()[i].rows()).collect()
}

impl<K: ContactSystem> Struck<'_, K> {
    /// The impulses that a law asks for.
    pub(crate) fn solve(&self, law: Impact) -> Result<Blow<K::Scalar>, Failure> {
        if law == Impact::Poisson {
            return self.poisson();
        }
        let (zero, one) = (K::Scalar::zero(), K::Scalar::one());
        let rows = rows(self.kernel, self.contacts);
        let owner: Vec<usize> = self
            .contacts
            .iter()
            .flat_map(|&i| core::iter::repeat_n(i, self.kernel.contacts()[i].rows().len()))
            .collect();
        let e = |i: usize| self.restitution.component(carrier(self.kernel.contacts(), i));
        let delassus = &self.response.delassus;
        let moreau = law == Impact::Moreau;
        let entry = |a: usize, b: usize| {
            let part = if moreau { one + e(owner[a]) } else { one };
            delassus[(rows[a], rows[b])] / part
        };
        let before = |a: usize| {
            let struck = &self.kernel.contacts()[owner[a]];
            let normal = struck.has_gap() && struck.normal == rows[a];
            let part = if normal && !moreau { one + e(owner[a]) } else { one };
            part * self.rates.component(rows[a])
        };
        let laws = self.contacts.iter().map(|&i| self.law(&self.kernel.contacts()[i])).collect();
        let b = (0..rows.len()).map(before).collect();
        let contacts = Contacts::new(laws, Matrix::from_fn(rows.len(), entry), b);
        let solution = contacts.known_to(rows.iter().map(|&row| 2.0 * self.noise[row])).solve()?;
        let mut impulses = vec![zero; K::ContactRows::DIM];
        rows.iter().zip(&solution.forces).for_each(|(&row, impulse)| impulses[row] = *impulse);
        let residuals = self.contacts.iter().copied().zip(solution.residuals).collect();
        Ok(Blow { impulses, residuals })
    }

    pub(crate) fn law(&self, contact: &Contact) -> Law<K::Scalar> {
        Law::new(contact, Bounds::of(contact, self.friction), None).among(contact, self.contacts)
    }
}

/// Velocities after impulses.
pub(crate) fn after<K: ContactSystem>(
    response: &ContactResponse<K>,
    z: &K::Speeds,
    impulses: &[K::Scalar],
) -> K::Speeds {
    let each = impulses.iter().enumerate().filter_map(|(row, impulse)| Some((impulse, response.columns.nth(row)?)));
    each.fold(*z, |z, (impulse, column)| z.add_scaled(*impulse, &column))
}
