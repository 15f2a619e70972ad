//! Steps of fixed length for velocities and impulses: J. J. Moreau's, in the form of M. Jean with θ = ½.
//!
//! They are written for this comparison, with what a kernel offers of its contacts; coordinates have their rates as
//! speeds. A gap counts as closed where it is not positive half a step ahead. All impacts of a step are one: Newton's
//! law for normal velocities and Coulomb's for impulses, by projected Gauss–Seidel sweeps.

use gauss_runtime::contact::ContactSystem;
use nalgebra::{SMatrix, SVector};

/// The least change of an impulse that is swept for, over the largest impulse.
const SWEPT: f64 = 1e-14;

/// Positions, velocities, and the impulses that led to them.
pub struct State<const N: usize, const R: usize> {
    pub t: f64,
    pub q: SVector<f64, N>,
    pub z: SVector<f64, N>,
    pub impulses: SVector<f64, R>,
}

impl<const N: usize, const R: usize> State<N, R> {
    pub fn new(q: SVector<f64, N>, z: SVector<f64, N>) -> Self {
        Self { t: 0.0, q, z, impulses: SVector::zeros() }
    }

    /// One step of length h.
    pub fn advance<K, const C: usize>(&mut self, kernel: &K, h: f64)
    where
        K: ContactSystem<
                Scalar = f64,
                Input = (),
                Configuration = SVector<f64, N>,
                Speeds = SVector<f64, N>,
                Gaps = SVector<f64, C>,
                ContactRows = SVector<f64, R>,
                ContactColumns = SMatrix<f64, N, R>,
                Delassus = SMatrix<f64, R, R>,
            >,
    {
        let middle = self.t + 0.5 * h;
        let q = self.q + self.z * (0.5 * h);
        let free = self.z + kernel.acceleration(middle, &q, &self.z, &()) * h;
        let gaps = kernel.gaps(middle, &q);
        self.impulses = SVector::zeros();
        let mut z = free;
        if (0..C).any(|i| gaps[i] <= 0.0) {
            let response = kernel.contact_response(middle, &q);
            let (friction, restitution) = (kernel.friction(middle, &q, &self.z, &()), kernel.restitution());
            let before = kernel.contact_rates(middle, &q, &self.z);
            let mut rates = kernel.contact_rates(middle, &q, &free);
            for _ in 0..1000 {
                let mut most = 0.0_f64;
                for (i, contact) in K::CONTACTS.iter().enumerate().filter(|(i, _)| gaps[*i] <= 0.0) {
                    let normal = contact.normal;
                    let wanted = rates[normal] + restitution[i] * before[normal];
                    let pressed = (self.impulses[normal] - wanted / response.delassus[(normal, normal)]).max(0.0);
                    let to = core::iter::once((normal, pressed, 0.0));
                    let tangents = contact.tangent_rows().map(|row| (row, 0.0, friction[row] * pressed));
                    for (row, pressed, bound) in to.chain(tangents) {
                        let held = self.impulses[row] - rates[row] / response.delassus[(row, row)];
                        let to = if row == normal { pressed } else { held.clamp(-bound, bound) };
                        let by = to - self.impulses[row];
                        self.impulses[row] = to;
                        rates += response.delassus.column(row) * by;
                        most = most.max(by.abs());
                    }
                }
                if most <= SWEPT * self.impulses.amax() {
                    break;
                }
            }
            z += response.columns * self.impulses;
        }
        self.q += (self.z + z) * (0.5 * h);
        self.z = z;
        self.t += h;
    }
}
