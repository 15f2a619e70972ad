//! The energy of a run against the work that was supplied to it.

use core::fmt;

use alloc::vec::Vec;

use crate::forces::ForcedSystem;
use crate::integrate::{EventSample, Sample, Trajectory};
use crate::real::Real;

/// Energy and work at one sample of a run, counted from the first; units of energy.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct BalancePoint {
    /// Time.
    pub t: f64,
    /// E(t) − E(t₀), E kinetic and potential energy.
    pub energy: f64,
    /// `∫ supplied_power dt` from t₀.
    pub work: f64,
    /// Energy that jumps of the state gave since t₀; negative where they took it away.
    pub jumps: f64,
    /// About how far the integral is off: the differences of two rules of quadrature, added up over the steps.
    pub uncertainty: f64,
}

impl BalancePoint {
    /// Energy that did not come from anywhere: `energy − work − jumps`.
    #[must_use]
    pub fn residual(&self) -> f64 {
        self.energy - self.work - self.jumps
    }
}

/// The balance `E(t) − E(t₀) = ∫ supplied_power dt` and what jumps gave, over a run: see [`power_balance`].
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct EnergyBalance {
    points: Vec<BalancePoint>,
}

impl EnergyBalance {
    /// One point for each sample of the trajectory, the first with zeros.
    #[must_use]
    pub fn points(&self) -> &[BalancePoint] {
        &self.points
    }

    /// The point of the last sample.
    #[must_use]
    pub fn last(&self) -> &BalancePoint {
        &self.points[self.points.len() - 1]
    }

    /// The largest size of a [residual](BalancePoint::residual); NaN when one is.
    #[must_use]
    pub fn largest_residual(&self) -> f64 {
        let sizes = self.points.iter().map(|point| point.residual().abs());
        // Written so that a NaN wins and stays.
        sizes.fold(0.0, |largest, size| if size > largest || size.is_nan() { size } else { largest })
    }
}

impl fmt::Display for EnergyBalance {
    /// `energy +1.2e0 = work +1.3e0 − 1.0e-1, quadrature within 2.0e-9`: at the end of the run; with what jumps gave,
    /// where there are some.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let end = self.last();
        let sign = if end.residual() < 0.0 { '−' } else { '+' };
        write!(f, "energy {:+.6e} = work {:+.6e}", end.energy, end.work)?;
        if end.jumps != 0.0 {
            write!(f, ", jumps {:+.6e}", end.jumps)?;
        }
        write!(f, " {sign} {:.2e}, quadrature within {:.1e}", end.residual().abs(), end.uncertainty)
    }
}

/// The balance of energy over a trajectory, with the input that it was run with. The first lane speaks for packs of
/// numbers.
///
/// Where controllers sample, that input is `|t, q, z| run.input(t, q, z)`: see [`Trajectory::input`].
///
/// The power is integrated from sample to sample by Kronrod's extension of Gauss–Lobatto quadrature with four nodes
/// (Gander & Gautschi, *Adaptive quadrature – revisited*, BIT 40, 2000), at states of the run ([`Trajectory::at`]). The
/// uncertainty is the difference to the four nodes alone, of sixth order in the distance of samples; it is no bound. A
/// residual far beyond it and rounding is the integrator's error, or a power that is not accounted for. What jumps at
/// events give is told by itself. Run with [`largest_step`](crate::integrate::Simulation::largest_step) where the
/// quadrature limits.
///
/// In systems with something moved as a function of time the residual is the work of whatever moves it: see
/// [`ForcedSystem::supplied_power`].
pub fn power_balance<S: ForcedSystem>(
    system: &S,
    trajectory: &Trajectory<S>,
    input: impl Fn(S::Scalar, &S::Configuration, &S::Speeds) -> S::Input,
) -> EnergyBalance {
    let power_of = |sample: &Sample<S>| {
        let input = input(sample.t, &sample.q, &sample.z);
        system.supplied_power(sample.t, &sample.q, &sample.z, &input).lane(0)
    };
    // The times of the quadrature lie between two samples, so the trajectory covers them.
    let power = |t: S::Scalar| trajectory.at(t).map_or(f64::NAN, |sample| power_of(&sample));
    let energy = |sample: &Sample<S>| system.energy(sample.t, &sample.q, &sample.z).lane(0);

    let first = trajectory.first();
    let initial = energy(first);
    let mut points = Vec::with_capacity(trajectory.len());
    let mut last = BalancePoint { t: first.t.lane(0), energy: 0.0, work: 0.0, jumps: 0.0, uncertainty: 0.0 };
    points.push(last);
    let forward = (trajectory.last().t - first.t).lane(0).signum();
    let mut events = trajectory.events().iter().peekable();
    for (left, after) in trajectory.iter().zip(trajectory.iter().skip(1)) {
        // Where the state jumps, the first event of that time has the one before.
        let is_behind = |event: &&EventSample<S>| forward * (event.sample.t - after.t).lane(0) < 0.0;
        while events.next_if(is_behind).is_some() {}
        let at_once = events.peek().filter(|event| event.sample.t.lane(0) == after.t.lane(0));
        let right = at_once.map_or(after, |event| &event.sample);
        let length = right.t - left.t;
        let h = length.lane(0);
        // Where controllers sample, a step has the input from before its end: some roundings of the time earlier.
        let rounding = 4.0 * S::Scalar::EPSILON * f64::max(left.t.lane(0).abs(), right.t.lane(0).abs());
        let earlier = S::Scalar::from_f64(if trajectory.samples_at(right.t) { rounding } else { 0.0 });
        let (start, end) = (power_of(left), power_of(&Sample { t: right.t - earlier, ..*right }));
        let within = |node: f64| power(left.t + length * S::Scalar::from_f64(0.5 + 0.5 * node));
        // Nodes on [−1, 1] that lie symmetrically.
        let both = |square: f64| within(Real::sqrt(square)) + within(-Real::sqrt(square));
        let (ends, inner) = (start + end, both(0.2));
        let lobatto = h / 12.0 * (ends + 5.0 * inner);
        let kronrod = h / 2940.0 * (77.0 * ends + 432.0 * both(2.0 / 3.0) + 625.0 * inner + 672.0 * within(0.0));
        last = BalancePoint {
            t: right.t.lane(0),
            energy: energy(after) - initial,
            work: last.work + kronrod,
            jumps: last.jumps + (energy(after) - energy(right)),
            uncertainty: last.uncertainty + (kronrod - lobatto).abs(),
        };
        points.push(last);
    }
    EnergyBalance { points }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::ops::Range;
    use nalgebra::SVector;
    use std::string::ToString;

    use crate::integrate::Simulation;
    use crate::testing::oscillator::{Oscillator, Viscous};

    type One = SVector<f64, 1>;

    /// An input that depends on everything.
    fn push(t: f64, q: &One, z: &One) -> f64 {
        (3.0 * t).sin() + 0.2 * q[0] - 0.1 * z[0]
    }

    fn run(system: &Oscillator<Viscous>, step: f64, interval: Range<f64>) -> Trajectory<'_, Oscillator<Viscous>> {
        let run = Simulation::new(system).input(push).fixed_step(step);
        run.run(One::from([1.0]), One::from([0.3]), interval).expect("runs")
    }

    #[test]
    fn energy_is_what_was_supplied_up_to_the_quadrature() {
        let system = Oscillator::<Viscous>::new(0.3);
        for interval in [0.0..10.0, 10.0..0.0] {
            let mut coarser = f64::INFINITY;
            for step in [0.4, 0.2, 0.1, 0.05] {
                let trajectory = run(&system, step, interval.clone());
                let balance = power_balance(&system, &trajectory, push);
                assert_eq!(balance.points().len(), trajectory.len());
                let origin = BalancePoint { t: interval.start, energy: 0.0, work: 0.0, jumps: 0.0, uncertainty: 0.0 };
                assert_eq!(balance.points()[0], origin);
                assert_eq!(balance.last().t, interval.end);
                // The quadrature is of a higher order than its uncertainty, which is of the sixth, as the integrator
                // is; each step rounds an energy and an integral of it.
                let (residual, uncertainty) = (balance.largest_residual(), balance.last().uncertainty);
                let largest = balance.points().iter().map(|point| point.energy.abs()).fold(1.0, f64::max);
                let rounding = 2.0 * f64::EPSILON * largest * trajectory.len() as f64;
                assert!(residual < uncertainty + rounding && uncertainty < coarser / 32.0, "{step}: {balance}");
                coarser = uncertainty;
            }
        }
    }

    #[test]
    fn what_is_not_accounted_for_is_seen() {
        let system = Oscillator::<Viscous>::new(0.3);
        let trajectory = run(&system, 0.01, 0.0..10.0);
        let balance = power_balance(&system, &trajectory, |t, q, z| push(t, q, z) + 1e-3);
        // The work of that force along x alone.
        let expected = -1e-3 * (trajectory.last().q[0] - trajectory.first().q[0]);
        let end = balance.last();
        let rounding = 2.0 * f64::EPSILON * 60.0 * trajectory.len() as f64;
        assert!((end.residual() - expected).abs() < end.uncertainty + rounding, "{balance}");
        assert!(end.residual().abs() > 100.0 * end.uncertainty, "{balance}");
    }

    #[test]
    fn nan_is_not_hidden_and_the_end_is_printed() {
        let point = BalancePoint { t: 1.0, energy: 2.5, work: 2.75, jumps: 0.0, uncertainty: 1e-9 };
        let mut balance = EnergyBalance { points: Vec::from([point]) };
        assert_eq!(balance.to_string(), "energy +2.500000e0 = work +2.750000e0 − 2.50e-1, quadrature within 1.0e-9");
        assert_eq!(balance.largest_residual(), 0.25);
        balance.points[0].jumps = -0.5;
        assert_eq!(
            balance.to_string(),
            "energy +2.500000e0 = work +2.750000e0, jumps -5.000000e-1 + 2.50e-1, quadrature within 1.0e-9"
        );
        balance.points.insert(0, BalancePoint { energy: f64::NAN, ..point });
        assert!(balance.largest_residual().is_nan());
    }
}
