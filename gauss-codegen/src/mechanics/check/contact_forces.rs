//! The definition under contact forces: C of (3.1) is stationary with them, and least under gaps that may not close.

use crate::algebra::{Expr, Number};

use crate::mechanics::formula::Method;

use super::agreement::{Comparison, Disagreement, SizedSum, agree};
use super::witness::{Witness, largest};

/// Gaps of which it is tried which close and which open: all combinations.
const MOST_GAPS: usize = 6;

/// The definition with contact forces.
pub struct ContactDefinition<'w, 'a, 'g, N> {
    pub witness: &'w Witness<'a, 'g, N>,
    /// Jacobian of the constraints, speed by speed, and their multipliers without contact forces.
    pub jacobian: &'w [Vec<N>],
    pub multipliers: &'w [N],
}

/// Values of the formulas at one state.
struct FormulaValues<'v, N> {
    /// ż without contact forces, and b.
    still: &'v [N],
    bias: &'v [N],
    /// A⁻¹Wᵀ and D, row by row.
    columns: &'v [N],
    delassus: &'v [N],
}

impl<'g, N: Number> ContactDefinition<'_, '_, 'g, N> {
    /// Rates of gaps are those of dual numbers; motion and rates are right under forces of arbitrary sizes, and under
    /// those with which C is least where no closed gap may close further: λ ≥ 0, g̈ ≥ 0, λ·g̈ = 0 (Karush, Kuhn &
    /// Tucker).
    pub fn compare(&self, claims: &[Vec<Expr<'g>>]) -> Result<Comparison, Disagreement> {
        let system = self.witness.system;
        if claims.is_empty() {
            return Ok(Comparison::Agrees);
        }
        let (n, rows) = (system.scene.speeds.len(), system.contacts.rates.len());
        let normals: Vec<usize> = self.normals();
        let gaps: Vec<Expr<'g>> = system.scene.contacts.iter().filter_map(|contact| contact.gap).collect();
        let normal_rates = self.witness.along(&self.witness.flow(&vec![N::number(0.0); n]), &gaps);
        let expected: Vec<_> = normal_rates.into_iter().map(|rate| SizedSum::of(rate, Vec::new())).collect();
        if !expected.iter().all(SizedSum::is_in_range) {
            return Ok(Comparison::WithoutValue);
        }
        let claimed: Vec<Expr<'g>> = normals.iter().map(|&row| system.contacts.rates[row]).collect();
        agree(Method::ContactRates, &self.witness.values(&claimed), &expected)?;
        let arbitrary: Vec<N> = (0..rows).map(|k| N::number(0.4 + 0.3 * (k % 3) as f64)).collect();
        for claim in claims {
            let (motion, effect) = claim.split_at(n + rows);
            let (effect, delassus) = effect.split_at(effect.len() - rows * rows);
            let columns = system.columns_of(effect);
            let values = self.witness.values(&[motion, &columns, delassus].concat());
            let (still, rest) = values.split_at(n);
            let (bias, rest) = rest.split_at(rows);
            let (columns, delassus) = rest.split_at(n * rows);
            let claim = FormulaValues { still, bias, columns, delassus };
            let Some(_) = self.motion(&claim, &arbitrary)? else { return Ok(Comparison::WithoutValue) };
            // Where no motion opens all gaps there is no such force, as between walls that close in.
            let Some(forces) = claim.complementary(&normals[..normals.len().min(MOST_GAPS)]) else { continue };
            let Some(changes) = self.motion(&claim, &forces)? else { return Ok(Comparison::WithoutValue) };
            let least = normals.iter().take(MOST_GAPS).map(|&row| {
                let pressed = claim.delassus[row * rows + row] * forces[row];
                let terms = changes[row].to_f64().abs() + pressed.to_f64().abs() + largest(values.iter().copied());
                SizedSum { value: if pressed < changes[row] { pressed } else { changes[row] }, terms }
            });
            let least: Vec<_> = least.collect();
            agree(Method::ImpulseDynamics, &vec![N::number(0.0); least.len()], &least)?;
        }
        Ok(Comparison::Agrees)
    }

    /// The rows of gaps.
    fn normals(&self) -> Vec<usize> {
        let mut next = 0;
        let contacts = self.witness.system.scene.contacts.iter();
        let rows = contacts.map(|contact| {
            let first = next;
            next += usize::from(contact.gap.is_some()) + contact.slips.len();
            contact.gap.map(|_| first)
        });
        rows.flatten().collect()
    }

    /// C is stationary at `ż + A⁻¹Wᵀλ` under the forces Wᵀλ, and the rates of gaps and slips change by `D λ + b` there:
    /// W and what changes them by dual numbers. These changes, where they have values.
    fn motion(&self, claim: &FormulaValues<'_, N>, forces: &[N]) -> Result<Option<Vec<N>>, Disagreement> {
        let Self { witness, jacobian, .. } = self;
        let rates = &witness.system.contacts.rates;
        let (zero, rows) = (N::number(0.0), rates.len());
        let transposed = witness.partials(rates);
        let of_constraints = self.multipliers_with(forces);
        let moved = claim.moved(forces);
        let all = [claim.still, claim.bias, claim.columns, claim.delassus];
        // The roundings of Delassus' matrix are those of A⁻¹, larger than what is left of its rows.
        let scale = largest(all.into_iter().flatten().copied()).max(1.0);
        let stationary = witness.stationarity(&moved).into_iter().enumerate().map(|(k, row)| {
            let of_contacts = transposed[k].iter().zip(forces).map(|(w, force)| -(*w * *force));
            let held = jacobian.get(k).into_iter().flatten().zip(&of_constraints).map(|(j, l)| -(*j * *l));
            SizedSum::of(row, of_contacts.chain(held).collect()).over(scale)
        });
        let changes = witness.along(&witness.flow(&moved), rates);
        let sizes = largest(moved.iter().copied()) * largest(transposed.iter().flatten().copied());
        let misses = changes.iter().enumerate().map(|(i, change)| {
            let sum = weighted(claim.bias[i], &claim.delassus[i * rows..(i + 1) * rows], forces);
            SizedSum { value: *change - sum.value, terms: sum.terms + sizes }.over(scale)
        });
        for sums in [stationary.collect::<Vec<_>>(), misses.collect()] {
            if !sums.iter().all(SizedSum::is_in_range) {
                return Ok(None);
            }
            agree(Method::ImpulseDynamics, &vec![zero; sums.len()], &sums)?;
        }
        Ok(Some(changes))
    }

    /// The multipliers of the constraints with contact forces.
    fn multipliers_with(&self, forces: &[N]) -> Vec<N> {
        let mut sum = self.multipliers.to_vec();
        for (of_row, force) in self.witness.system.multipliers_of_contacts().iter().zip(forces) {
            let values = self.witness.values(of_row);
            sum.iter_mut().zip(values).for_each(|(sum, value)| *sum = *sum + value * *force);
        }
        sum
    }
}

/// A number, and a sum of products.
fn weighted<N: Number>(first: N, row: &[N], forces: &[N]) -> SizedSum<N> {
    SizedSum::of(first, row.iter().zip(forces).map(|(x, force)| *x * *force).collect())
}

impl<N: Number> FormulaValues<'_, N> {
    /// ż under contact forces.
    fn moved(&self, forces: &[N]) -> Vec<N> {
        let rows = self.columns.chunks(forces.len());
        self.still.iter().zip(rows).map(|(rate, row)| weighted(*rate, row, forces).value).collect()
    }

    /// Forces of gaps that are all closed, without friction: those with `0 ≤ λ ⊥ D λ + b ≥ 0`, found among all
    /// combinations of gaps that stay closed.
    fn complementary(&self, normals: &[usize]) -> Option<Vec<N>> {
        let zero = N::number(0.0);
        let rows = self.bias.len();
        let scale = largest(self.delassus.iter().chain(self.bias).copied()).max(1.0);
        let is_negative = |x: N| x.to_f64() < -N::NEGLIGIBLE * scale;
        (0..1_usize << normals.len()).find_map(|combination| {
            let closed: Vec<usize> =
                normals.iter().enumerate().filter(|(k, _)| combination >> k & 1 == 1).map(|(_, row)| *row).collect();
            let mut forces = vec![zero; rows];
            let unknown = self.closing(&closed)?;
            closed.iter().zip(unknown).for_each(|(&row, force)| forces[row] = force);
            let rate = |row: usize| weighted(self.bias[row], &self.delassus[row * rows..(row + 1) * rows], &forces);
            let holds = forces.iter().all(|force| !is_negative(*force))
                && normals.iter().all(|&row| !is_negative(rate(row).value));
            holds.then_some(forces)
        })
    }

    /// λ of gaps that stay closed; `None` where they depend on one another.
    fn closing(&self, closed: &[usize]) -> Option<Vec<N>> {
        let (rows, n) = (self.bias.len(), closed.len());
        let mut system: Vec<Vec<N>> = closed
            .iter()
            .map(|&i| closed.iter().map(|&j| self.delassus[i * rows + j]).chain([-self.bias[i]]).collect())
            .collect();
        for k in 0..n {
            let diagonal = self.delassus[closed[k] * rows + closed[k]].to_f64();
            if system[k][k].to_f64() <= N::NEGLIGIBLE * diagonal {
                return None;
            }
            for i in (0..n).filter(|i| *i != k) {
                let factor = system[i][k] / system[k][k];
                for j in k..=n {
                    system[i][j] = system[i][j] - factor * system[k][j];
                }
            }
        }
        Some((0..n).map(|k| system[k][n] / system[k][k]).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::FormulaValues;

    fn forces(delassus: &[f64], bias: &[f64]) -> Option<Vec<f64>> {
        let normals: Vec<usize> = (0..bias.len()).collect();
        FormulaValues { still: &[], bias, columns: &[], delassus }.complementary(&normals)
    }

    #[test]
    fn gaps_are_closed_by_forces_or_open() {
        // Two gaps apart: one would close, one opens.
        assert_eq!(forces(&[2.0, 0.0, 0.0, 1.0], &[-3.0, 4.0]), Some(vec![1.5, 0.0]));
        // The force that holds the first presses the second open, though both would close.
        assert_eq!(forces(&[1.0, 2.0, 2.0, 8.0], &[-3.0, -1.0]), Some(vec![3.0, 0.0]));
        // Both have to be held.
        assert_eq!(forces(&[2.0, -1.0, -1.0, 2.0], &[-1.0, 0.0]), Some(vec![2.0 / 3.0, 1.0 / 3.0]));
        // Gaps that depend on one another: one of them is enough.
        assert_eq!(forces(&[1.0; 4], &[-2.0, -2.0]), Some(vec![2.0, 0.0]));
        // Walls that close in.
        assert_eq!(forces(&[1.0, -1.0, -1.0, 1.0], &[-1.0, -1.0]), None);
    }
}
