//! Runs of one initial state through any kernel.

use std::error::Error;

use gauss_runtime::integrate::{Control, Fixed, Form, InputSource, NoInput, Rkmk, Sample, Tableau};
use gauss_runtime::monitor::BodyMonitor;
use gauss_runtime::prelude::*;

/// What a run says about itself at one time, in no particular chart.
#[derive(Clone, Copy, Debug)]
pub struct Moment {
    /// Time, s.
    pub t: f64,
    /// Where the vehicle is.
    pub pose: Isometry3<f64>,
    /// How it moves: (u, ω), body axes, pole O.
    pub twist: Vector6<f64>,
    /// (Q̂, Γ̂_Ω), made of pose and twist.
    pub space_momentum: Vector6<f64>,
    /// T + V, J.
    pub energy: f64,
    /// The chart's own momenta p.
    pub p: Vector6<f64>,
}

/// One chart, one method.
#[derive(Clone, Debug)]
pub struct Run {
    /// The chart as its users know it.
    pub name: &'static str,
    /// The states, in order.
    pub moments: Vec<Moment>,
    /// What drift of energy is relative to, J: V has an arbitrary zero, and T + V may pass through it.
    pub largest_kinetic_energy: f64,
    /// Energy and momentum over every step of the run, not only over `moments`.
    pub watched: BodyMonitor,
}

/// How long a run is and how often it is looked at.
#[derive(Clone, Copy, Debug)]
pub struct Plan {
    /// Length, s.
    pub duration: f64,
    /// Distance of the moments that are kept, in steps.
    pub every: u64,
}

/// A rigid body with six speeds and no input: any of the vehicles.
pub trait Vessel: RigidBodySystem<Scalar = f64, Speeds = Vector6<f64>, Input = ()> + DescribedSystem {}

impl<K: RigidBodySystem<Scalar = f64, Speeds = Vector6<f64>, Input = ()> + DescribedSystem> Vessel for K {}

/// Integrates the state of [`initial_state`](crate::vehicle::initial_state) with a form of the equations and a method.
///
/// # Errors
/// When the state is singular in the chart, or the integration stops.
pub fn run<K, F, C>(name: &'static str, kernel: &K, form: F, method: C, plan: Plan) -> Result<Run, Box<dyn Error>>
where
    K: Vessel,
    NoInput: InputSource<K>,
    F: Form<K>,
    C: Control<K>,
{
    let (pose, twist) = crate::vehicle::initial_state();
    let q = kernel.configuration(&pose)?;
    let z = kernel.speeds(0.0, &q, &twist);

    let mut moments = Vec::new();
    let mut watched = BodyMonitor::new();
    let mut largest_kinetic_energy = 0.0_f64;
    let mut count = 0;
    let observe = |sample: &Sample<K>| {
        watched.watch(kernel, sample);
        largest_kinetic_energy = largest_kinetic_energy.max(kernel.kinetic_energy(sample.t, &sample.q, &sample.z));
        if count % plan.every == 0 {
            moments.push(moment(kernel, sample));
        }
        count += 1;
    };
    Simulation::new(kernel).form(form).control(method).observe(observe).run_to_end(q, z, 0.0..plan.duration)?;
    Ok(Run { name, moments, largest_kinetic_energy, watched })
}

fn moment<K: Vessel>(kernel: &K, sample: &Sample<K>) -> Moment {
    let Sample { t, q, z, p } = *sample;
    Moment {
        t,
        pose: kernel.pose(t, &q),
        twist: kernel.body_twist(t, &q, &z),
        space_momentum: kernel.space_momentum(t, &q, &z),
        energy: kernel.energy(t, &q, &z),
        p,
    }
}

/// Equal steps of the method of order 8 by Dormand and Prince, so many a second.
///
/// With 200 a second its error is below the rounding of this vehicle's motion: more steps do not change the results.
#[must_use]
pub fn order_8(steps_per_second: u32) -> Fixed<f64, Rkmk<f64, 12>> {
    Fixed::with(&Tableau::DORMAND_PRINCE_8, 1.0 / f64::from(steps_per_second))
}
