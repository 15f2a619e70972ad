//! All runs of the comparison, and the numbers that judge them.

use std::error::Error;

use gauss_runtime::integrate::{Control, Fixed, MomentumForm, VelocityForm};
use gauss_runtime::prelude::*;

use crate::simulate::{Moment, Plan, Run, order_8, run};
use crate::vehicle::{
    Hybrid, HybridKernel, Kirchhoff, KirchhoffKernel, Lagrange, LagrangeKernel, NewtonEuler, NewtonEulerKernel,
    Parameters, WeightlessKirchhoff, WeightlessNewtonEuler,
};

/// Steps a second of the precise runs; the reference takes twice as many.
pub const PRECISE_RATE: u32 = 200;
/// The step of the everyday runs, s: the classical Runge–Kutta–Munthe-Kaas method, order 4.
pub const EVERYDAY_STEP: f64 = 0.02;
/// Distance in time of the moments that are compared and drawn, s.
pub const SAMPLING: f64 = 0.1;

/// The vehicle's kernels, one a chart.
#[derive(Clone, Copy, Debug)]
pub struct Fleet {
    /// Left-invariant chart.
    pub kirchhoff: KirchhoffKernel,
    /// Right-invariant chart.
    pub newton_euler: NewtonEulerKernel,
    /// Hybrid chart.
    pub hybrid: HybridKernel,
    /// Jet chart in yaw, pitch, roll.
    pub lagrange: LagrangeKernel,
}

impl Fleet {
    /// The published vehicle.
    ///
    /// # Errors
    /// When the parameters are none that a body can have.
    pub fn published() -> Result<Self, ParameterError> {
        let parameters = Parameters::published();
        Ok(Self {
            kirchhoff: Kirchhoff::from(&parameters).kernel()?,
            newton_euler: NewtonEuler::from(&parameters).kernel()?,
            hybrid: Hybrid::from(&parameters).kernel()?,
            lagrange: Lagrange::from(&parameters).kernel()?,
        })
    }
}

/// Every run.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// Kirchhoff's equations at half the step of the precise runs.
    pub reference: Run,
    /// The four charts at a step where rounding is all that is left.
    pub precise: Vec<Run>,
    /// The four charts at a step that one would take.
    pub everyday: Vec<Run>,
    /// Without gravity: Kirchhoff and Newton–Euler, each in velocity and in momentum form, at the everyday step.
    pub weightless: Vec<Run>,
}

impl Comparison {
    /// Runs everything.
    ///
    /// # Errors
    /// When a run stops before its end.
    pub fn of(fleet: &Fleet, duration: f64) -> Result<Self, Box<dyn Error>> {
        let (precise, everyday) = (order_8(PRECISE_RATE), Fixed::with(&Tableau::RK4, EVERYDAY_STEP));
        let steps = |rate: f64| (SAMPLING * rate).round() as u64;
        let rate = f64::from(PRECISE_RATE);
        let fine = Plan { duration, every: steps(rate) };
        let coarse = Plan { duration, every: steps(1.0 / EVERYDAY_STEP) };

        let half = Plan { duration, every: steps(2.0 * rate) };
        let reference = run("reference", &fleet.kirchhoff, VelocityForm, order_8(2 * PRECISE_RATE), half)?;

        let parameters = Parameters::published();
        let (k, n) =
            (WeightlessKirchhoff::from(&parameters).kernel()?, WeightlessNewtonEuler::from(&parameters).kernel()?);
        Ok(Self {
            reference,
            precise: each_chart(fleet, precise, fine)?,
            everyday: each_chart(fleet, everyday, coarse)?,
            weightless: vec![
                run("Kirchhoff, velocity form", &k, VelocityForm, everyday, coarse)?,
                run("Kirchhoff, momentum form", &k, MomentumForm, everyday, coarse)?,
                run("Newton–Euler, velocity form", &n, VelocityForm, everyday, coarse)?,
                run("Newton–Euler, momentum form", &n, MomentumForm, everyday, coarse)?,
            ],
        })
    }
}

/// The four charts with one method, all in velocity form: the comparison is of charts.
fn each_chart<C>(fleet: &Fleet, method: C, plan: Plan) -> Result<Vec<Run>, Box<dyn Error>>
where
    C: Control<KirchhoffKernel> + Control<NewtonEulerKernel> + Control<HybridKernel> + Control<LagrangeKernel> + Copy,
{
    Ok(vec![
        run("Kirchhoff", &fleet.kirchhoff, VelocityForm, method, plan)?,
        run("Newton–Euler", &fleet.newton_euler, VelocityForm, method, plan)?,
        run("hybrid", &fleet.hybrid, VelocityForm, method, plan)?,
        run("Lagrange (ψ, θ, φ)", &fleet.lagrange, VelocityForm, method, plan)?,
    ])
}

/// How far a run is from another one: time, metres between the two O, radians between the two attitudes.
#[must_use]
pub fn differences(run: &Run, reference: &Run) -> Vec<(f64, f64, f64)> {
    let pairs = run.moments.iter().zip(&reference.moments);
    pairs.map(|(a, b)| (a.t, distance(a, b), a.pose.rotation.angle_to(&b.pose.rotation))).collect()
}

fn distance(a: &Moment, b: &Moment) -> f64 {
    (a.pose.translation.vector - b.pose.translation.vector).norm()
}

/// The largest distance (m) and angle (rad) between two runs.
#[must_use]
pub fn largest_difference(run: &Run, reference: &Run) -> (f64, f64) {
    let all = differences(run, reference);
    all.iter().fold((0.0, 0.0), |(metres, radians), &(_, m, r)| (larger(metres, m), larger(radians, r)))
}

/// The larger one; a NaN wins, so that nothing hides it.
fn larger(a: f64, b: f64) -> f64 {
    if b > a || b.is_nan() { b } else { a }
}

/// The energy's change since the start over time, relative to the largest kinetic energy.
#[must_use]
pub fn energy_drift(run: &Run) -> Vec<(f64, f64)> {
    let start = run.moments[0].energy;
    run.moments.iter().map(|m| (m.t, (m.energy - start).abs() / run.largest_kinetic_energy)).collect()
}

/// Largest change of the energy at any step, relative to the largest kinetic energy.
#[must_use]
pub fn largest_energy_drift(run: &Run) -> f64 {
    run.watched.energy.largest() / run.largest_kinetic_energy
}

/// What gravity along k₃ leaves constant: Q̂₁, Q̂₂ and Γ̂₃. Largest changes, relative to the largest |Q̂| and |Γ̂_Ω|.
#[must_use]
pub fn symmetric_momentum_drift(run: &Run) -> (f64, f64) {
    let first = run.moments[0].space_momentum;
    let mut sizes = (0.0, 0.0);
    let mut changes = (0.0, 0.0);
    for moment in &run.moments {
        let (now, change) = (moment.space_momentum, moment.space_momentum - first);
        sizes.0 = larger(sizes.0, now.fixed_rows::<3>(0).norm());
        sizes.1 = larger(sizes.1, now.fixed_rows::<3>(3).norm());
        changes.0 = larger(changes.0, change.x.hypot(change.y));
        changes.1 = larger(changes.1, change[5].abs());
    }
    (changes.0 / sizes.0, changes.1 / sizes.1)
}

/// The change of (Q̂, Γ̂_Ω) over time, relative to the first |(Q̂, Γ̂_Ω)| in SI units, recomputed from pose and twist.
#[must_use]
pub fn momentum_drift(run: &Run) -> Vec<(f64, f64)> {
    let first = run.moments[0].space_momentum;
    run.moments.iter().map(|m| (m.t, (m.space_momentum - first).norm() / first.norm())).collect()
}

/// How often the vehicle changes between moving forwards and backwards: the sign of u₁.
#[must_use]
pub fn reversals(run: &Run) -> usize {
    run.moments.windows(2).filter(|pair| pair[0].twist.x * pair[1].twist.x < 0.0).count()
}

/// How many of the moments have the same bits in all six momenta p as the first one, and how many moments there are.
#[must_use]
pub fn momenta_with_the_same_bits(run: &Run) -> (usize, usize) {
    let bits = |m: &Moment| m.p.map(f64::to_bits);
    let first = bits(&run.moments[0]);
    (run.moments.iter().filter(|m| bits(m) == first).count(), run.moments.len())
}
