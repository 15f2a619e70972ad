//! The energy of a run with contacts against the work that was done on it.

use core::fmt;

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::forces::ForcedSystem;
use gauss_runtime::real::Real;

use crate::error::ContactError;
use crate::history::EventKind;
use crate::trajectory::ContactTrajectory;

/// Account of the energy of a run with contacts, in units of energy. See [`ContactTrajectory::energy_balance`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct ContactBalance {
    /// Kinetic and potential energy at the end, less those at the start.
    pub energy: f64,
    /// The work of all elements and inputs that are not conservative.
    pub supplied: f64,
    /// The work of contact forces: of friction, and of surfaces that move.
    pub contacts: f64,
    /// Energy that impacts took away.
    pub impacts: f64,
    /// Energy that jumps of the state gave, by events of the run ([`ContactRun::then`](crate::ContactRun::then)).
    pub jumps: f64,
}

impl ContactBalance {
    /// Energy that did not come from anywhere.
    #[must_use]
    pub fn residual(&self) -> f64 {
        self.energy - self.supplied - self.contacts + self.impacts - self.jumps
    }
}

impl fmt::Display for ContactBalance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { energy, supplied, contacts, impacts, jumps } = self;
        write!(f, "energy {energy:+.6e} = supplied {supplied:+.6e}, contacts {contacts:+.6e}, impacts −{impacts:.6e}")?;
        if *jumps != 0.0 {
            write!(f, ", jumps {jumps:+.6e}")?;
        }
        write!(f, ", residual {:+.1e}", self.residual())
    }
}

impl<K: ContactSystem<Scalar = f64> + ForcedSystem> ContactTrajectory<'_, K> {
    /// The balance of energy over the run. Powers are integrated from sample to sample by Gauss' quadrature with three
    /// points, of sixth order. What is left is the error of the integrator and of the quadrature, and the energy of
    /// bounces that were left out ([`EventKind::Rests`]). Surfaces that move may do work in impacts too: then it is in
    /// the residual.
    ///
    /// # Errors
    /// Where a state between two samples cannot be computed.
    pub fn energy_balance(&self) -> Result<ContactBalance, ContactError> {
        let mut balance = ContactBalance::default();
        let (Some(first), Some(last)) = (self.iter().next(), self.last()) else { return Ok(balance) };
        for segment in &self.segments {
            let (system, path) = (&segment.system, &segment.trajectory);
            for (left, right) in path.iter().zip(path.iter().skip(1)) {
                let half = 0.5 * (right.t - left.t);
                for (node, weight) in [(-Real::sqrt(0.6), 5.0 / 9.0), (0.0, 8.0 / 9.0), (Real::sqrt(0.6), 5.0 / 9.0)] {
                    let t = node.fma(half, left.t + half);
                    let state = path.at(t).map_err(|error| crate::trajectory::integration(t, error))?;
                    let input = (self.input)(t, &state.q, &state.z);
                    let loads = system.loads(t, &state.q, &state.z, &input);
                    let force = system.generalised(t, &state.q, &loads.forces);
                    let power: f64 = (0..K::Speeds::DIM).map(|i| force.component(i) * state.z.component(i)).sum();
                    balance.contacts += weight * half * power;
                    let supplied = system.kernel.supplied_power(t, &state.q, &state.z, &input);
                    balance.supplied += weight * half * supplied;
                }
            }
        }
        for event in &self.events {
            if let EventKind::Impact(hit) = event.kind {
                balance.impacts += hit.energy_lost;
            }
        }
        let kernel = self.segments[0].system.kernel;
        balance.jumps = self.state_jumps.iter().map(|jump| jump.energy(kernel)).sum();
        balance.energy = kernel.energy(last.t, &last.q, &last.z) - kernel.energy(first.t, &first.q, &first.z);
        Ok(balance)
    }
}
