//! Rounds of sweeps and corrections: how impulses of one system are found where corrections alone come to no end.

use super::cones::Cone;
use super::impulses::{Found, Impulses, STRICT, norm};
use super::pull::{Drift, Pull};

/// Rounds of sweeps and corrections.
const ROUNDS: u32 = 11;

impl Impulses<'_> {
    /// Finds the impulses; contacts that others press closed, judged by their number and rate, take part as well, from
    /// the impulses that they had before.
    pub(crate) fn solve_with_more(
        &mut self,
        cones: &mut [Cone],
        tolerance: f64,
        (closes, before): (impl Fn(usize, f64) -> bool, impl Fn(usize) -> f64),
    ) -> Found {
        let mut found = Found::default();
        loop {
            let next = self.solve(cones, tolerance);
            let (corrections, sweeps) = (found.corrections + next.corrections, found.sweeps + next.sweeps);
            found = Found { corrections, sweeps, ..next };
            let mut more = false;
            for i in 0..cones.len() {
                let Cone { normal, pressed, acts, .. } = cones[i];
                let joins = match normal {
                    Some(normal) => closes(i, self.rates[normal]),
                    None => cones.iter().any(|cone| cone.acts && pressed.is_some() && cone.normal == pressed),
                };
                if !acts && joins {
                    cones[i].acts = true;
                    cones[i].rows().for_each(|row| self.impulses[row] = before(row));
                    more = true;
                }
            }
            if !more {
                return found;
            }
        }
    }

    /// Finds the impulses from those that are there.
    pub(crate) fn solve(&mut self, cones: &[Cone], tolerance: f64) -> Found {
        let mut found = Found::default();
        if !self.begin(cones) {
            found.holds = true;
            return found;
        }
        // Also where those of the step before satisfy the laws within the tolerance: what rests is to rest exactly.
        for round in 0..ROUNDS {
            // From the impulses of the step before; from none, since dependent contacts may press against one another
            // up to the bounds of their friction; then from sweeps that go on from where they were.
            if round == 1 {
                self.swept.fill(0.0);
            }
            if round > 0 {
                self.impulses.copy_from_slice(self.swept);
                let sweeps = if round == 1 { 0 } else { 4 << round };
                (0..sweeps).for_each(|_| if self.relaxed { self.sweep_convex(cones) } else { self.sweep(cones) });
                found.sweeps += sweeps;
                self.swept.copy_from_slice(self.impulses);
                self.update(cones);
            }
            self.pull = Pull::new(if round % 2 == 0 && round > 0 { Drift::Long } else { Drift::Short });
            if self.correct(cones, STRICT * tolerance, &mut found) {
                return found;
            }
            if found.corrections == 0 {
                (found.residual, found.holds) = self.worst(cones, tolerance);
            }
            // Where contacts depend on one another rates of places that moved agree only to the order of the step.
            if round > 0 {
                self.impulses.copy_from_slice(self.best);
                self.update(cones);
                (found.residual, found.holds) = self.worst(cones, tolerance);
                if found.holds {
                    return found;
                }
            }
        }
        found
    }

    /// One sweep over the contacts: each impulse is brought to its cone as if the others stayed.
    fn sweep(&mut self, cones: &[Cone]) {
        for cone in cones.iter().filter(|cone| cone.acts) {
            if let Some(normal) = cone.normal {
                let diagonal = self.at(normal, normal);
                if diagonal > 0.0 {
                    self.impulses[normal] = (self.impulses[normal] - self.rate(normal) / diagonal).max(0.0);
                }
            }
            let scale: f64 = cone.tangents().map(|row| self.at(row, row)).sum();
            if scale > 0.0 {
                let largest = cone.radius(self.impulses);
                let mut wanted = [0.0; 3];
                for (wanted, row) in wanted.iter_mut().zip(cone.tangents()) {
                    *wanted = self.impulses[row] - self.rate(row) / scale;
                }
                let size = norm(&wanted);
                let part = if size > largest { largest / size } else { 1.0 };
                cone.tangents().zip(wanted).for_each(|(row, impulse)| self.impulses[row] = part * impulse);
            }
        }
    }
}
