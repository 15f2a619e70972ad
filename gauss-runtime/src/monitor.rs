//! First integrals watched over a run: energy always, the momentum in space for a rigid body; and energy against the
//! work supplied.
//!
//! A first integral measures the accuracy of a simulation without a reference solution. Three numbers describe its
//! error: the largest deviation (accuracy), the slope of a least-squares line (a drift grows without bound; a geometric
//! method oscillates about slope 0), and the initial value that both are relative to.

use core::fmt;

#[cfg(feature = "alloc")]
mod balance;

#[cfg(feature = "alloc")]
pub use balance::{BalancePoint, EnergyBalance, power_balance};

use crate::integrate::Sample;
#[cfg(feature = "alloc")]
use crate::integrate::Trajectory;
use crate::real::Real;
use crate::system::{GaussSystem, RigidBodySystem};

/// A quantity of N components that should be constant, over time. Uses no memory: mean and covariance are updated.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Drift<const N: usize> {
    initial: [f64; N],
    largest: f64,
    count: u64,
    mean_time: f64,
    mean: [f64; N],
    time_square: f64,
    time_product: [f64; N],
}

impl<const N: usize> Default for Drift<N> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const N: usize> Drift<N> {
    /// Nothing seen.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            initial: [0.0; N],
            largest: 0.0,
            count: 0,
            mean_time: 0.0,
            mean: [0.0; N],
            time_square: 0.0,
            time_product: [0.0; N],
        }
    }

    /// Takes the value at a time.
    pub fn watch(&mut self, t: f64, value: [f64; N]) {
        if self.count == 0 {
            self.initial = value;
        }
        // Deviations, not values: the covariance must not cancel against a large constant.
        let deviation: [f64; N] = core::array::from_fn(|i| value[i] - self.initial[i]);
        let size = norm(&deviation);
        // Written so that a NaN wins and stays.
        if size > self.largest || size.is_nan() {
            self.largest = size;
        }
        self.count += 1;
        let weight = 1.0 / self.count as f64;
        let before = t - self.mean_time;
        self.mean_time += before * weight;
        let after = t - self.mean_time;
        self.time_square += before * after;
        for ((mean, product), deviation) in self.mean.iter_mut().zip(&mut self.time_product).zip(deviation) {
            *mean += (deviation - *mean) * weight;
            *product += before * (deviation - *mean);
        }
    }

    /// Number of the values that were seen.
    #[must_use]
    pub fn count(&self) -> u64 {
        self.count
    }

    /// The first value.
    #[must_use]
    pub fn initial(&self) -> [f64; N] {
        self.initial
    }

    /// The largest deviation from the first value (Euclidean norm); NaN when a value was.
    #[must_use]
    pub fn largest(&self) -> f64 {
        self.largest
    }

    /// The largest deviation relative to the first value's norm; `None` when that is zero.
    #[must_use]
    pub fn relative(&self) -> Option<f64> {
        let size = norm(&self.initial);
        (size > 0.0).then(|| self.largest / size)
    }

    /// The slope of the least-squares line through each component, per unit of time; zero for less than two times.
    #[must_use]
    pub fn slopes(&self) -> [f64; N] {
        if self.time_square > 0.0 { self.time_product.map(|p| p / self.time_square) } else { [0.0; N] }
    }

    /// The norm of [`slopes`](Self::slopes); for a scalar the slope with its sign.
    #[must_use]
    pub fn slope(&self) -> f64 {
        match self.slopes().as_slice() {
            [one] => *one,
            several => norm(several),
        }
    }

    fn row(&self, f: &mut fmt::Formatter<'_>, name: &str) -> fmt::Result {
        let initial = match self.initial.as_slice() {
            [one] => *one,
            several => norm(several),
        };
        write!(f, "{name:<16} {initial:>14.6e} {:>12.2e} ", self.largest)?;
        match self.relative() {
            Some(relative) => write!(f, "{relative:>12.2e} ")?,
            None => write!(f, "{:>12} ", "-")?,
        }
        write!(f, "{:>12.2e}", self.slope())
    }
}

fn norm(components: &[f64]) -> f64 {
    Real::sqrt(components.iter().map(|c| c * c).sum::<f64>())
}

fn heading(f: &mut fmt::Formatter<'_>) -> fmt::Result {
    writeln!(f, "{:<16} {:>14} {:>12} {:>12} {:>12}", "quantity", "initial", "deviation", "relative", "slope")
}

/// The energy T + V of any system.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EnergyMonitor {
    /// The energy.
    pub energy: Drift<1>,
    lane: usize,
}

impl EnergyMonitor {
    /// Watches the first lane.
    #[must_use]
    pub const fn new() -> Self {
        Self::of_lane(0)
    }

    /// Watches one lane of a pack.
    #[must_use]
    pub const fn of_lane(lane: usize) -> Self {
        Self { energy: Drift::new(), lane }
    }

    /// Takes a sample.
    pub fn watch<S: GaussSystem>(&mut self, system: &S, sample: &Sample<S>) {
        let energy = system.energy(sample.t, &sample.q, &sample.z);
        self.energy.watch(sample.t.lane(self.lane), [energy.lane(self.lane)]);
    }
}

impl fmt::Display for EnergyMonitor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        heading(f)?;
        self.energy.row(f, "energy")
    }
}

/// The energy and the momentum (Q̂, Γ̂_Ω) in space of a rigid body and its fluid.
///
/// The energy is constant without inputs and drag; Q̂ and Γ̂_Ω are without forces, and components of them along the
/// symmetries of a potential (for gravity along k₃: Q̂₁, Q̂₂ and Γ̂₃).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyMonitor {
    /// The energy.
    pub energy: Drift<1>,
    /// Q̂: linear momentum, observer frame.
    pub linear_momentum: Drift<3>,
    /// Γ̂_Ω: angular momentum, observer frame, pole Ω.
    pub angular_momentum: Drift<3>,
    lane: usize,
}

impl BodyMonitor {
    /// Watches the first lane.
    #[must_use]
    pub const fn new() -> Self {
        Self::of_lane(0)
    }

    /// Watches one lane of a pack.
    #[must_use]
    pub const fn of_lane(lane: usize) -> Self {
        Self { energy: Drift::new(), linear_momentum: Drift::new(), angular_momentum: Drift::new(), lane }
    }

    /// Takes a sample.
    pub fn watch<S: RigidBodySystem>(&mut self, system: &S, sample: &Sample<S>) {
        let (t, lane) = (sample.t.lane(self.lane), self.lane);
        let energy = system.energy(sample.t, &sample.q, &sample.z);
        let momentum = system.space_momentum(sample.t, &sample.q, &sample.z);
        let [a, b, c, d, e, g] = momentum.data.0[0].map(|component| component.lane(lane));
        self.energy.watch(t, [energy.lane(lane)]);
        self.linear_momentum.watch(t, [a, b, c]);
        self.angular_momentum.watch(t, [d, e, g]);
    }
}

impl fmt::Display for BodyMonitor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        heading(f)?;
        self.energy.row(f, "energy")?;
        f.write_str("\n")?;
        self.linear_momentum.row(f, "linear momentum")?;
        f.write_str("\n")?;
        self.angular_momentum.row(f, "angular momentum")
    }
}

/// The energy over a trajectory.
#[cfg(feature = "alloc")]
pub fn monitor<S: GaussSystem>(system: &S, trajectory: &Trajectory<S>) -> EnergyMonitor {
    let mut monitor = EnergyMonitor::new();
    trajectory.iter().for_each(|sample| monitor.watch(system, sample));
    monitor
}

/// Energy and momentum in space over a trajectory.
#[cfg(feature = "alloc")]
pub fn monitor_body<S: RigidBodySystem>(system: &S, trajectory: &Trajectory<S>) -> BodyMonitor {
    let mut monitor = BodyMonitor::new();
    trajectory.iter().for_each(|sample| monitor.watch(system, sample));
    monitor
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::string::ToString;

    #[test]
    fn a_line_has_its_slope_and_a_constant_none() {
        let mut drift = Drift::<2>::new();
        for n in 0..=100 {
            let t = f64::from(n) * 0.1;
            drift.watch(t, [1e6 + 3.0 * t, -4.0]);
        }
        let [a, b] = drift.slopes();
        assert!((a - 3.0).abs() < 1e-9 && b == 0.0, "{a} {b}");
        assert!((drift.largest() - 30.0).abs() < 1e-9);
        assert_eq!(drift.initial(), [1e6, -4.0]);
        assert_eq!(drift.count(), 101);
    }

    #[test]
    fn nan_is_not_hidden() {
        let mut drift = Drift::<1>::new();
        for value in [1.0, f64::NAN, 1.0] {
            drift.watch(0.0, [value]);
        }
        assert!(drift.largest().is_nan());
    }

    #[test]
    fn table() {
        let mut monitor = EnergyMonitor::new();
        monitor.energy.watch(0.0, [2.0]);
        monitor.energy.watch(1.0, [2.5]);
        let text = monitor.to_string();
        assert_eq!(
            text,
            "quantity                initial    deviation     relative        slope\n\
             energy               2.000000e0      5.00e-1      2.50e-1      5.00e-1"
        );
        assert_eq!(Drift::<1>::new().relative(), None);
    }
}
