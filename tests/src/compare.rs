//! A kernel run from the initial to the final state of a scene, and how far it ends from it.

use core::fmt;

use gauss_runtime::chart::{ChartError, EulerSequence, RotationChart, convert};
use gauss_runtime::integrate::{Form, IntegrationError};
use gauss_runtime::prelude::*;

use crate::integrals::Moment;
use crate::order8::Order8;
use crate::scene::{Scene, State};

/// The most steps of a run, rejected ones included: ten times what the hardest scene needs in a chart that suits it.
const LIMIT: u64 = 100_000;

/// What came out of a run that reached the end.
#[derive(Clone, Copy, Debug)]
pub struct Outcome {
    /// The largest error of the final state: R entry by entry, b, u and ω each relative to its largest component (where
    /// that is above 1).
    pub state: f64,
    /// The largest deviation of a first integral from its reference value on the way, relative to the terms in it.
    pub integrals: f64,
    /// How far rounding and truncation in z are blown up: the largest |z|/|(u, ω)| on the way, or its ratio to the
    /// least if that is more; 1 at least. It is large near a singularity of the coordinates, and in the right-invariant
    /// chart far from Ω, where ξ̂ = ḃ − ω̂×b.
    pub stretch: f64,
    /// Steps taken.
    pub steps: u64,
}

/// Why a run did not reach the end.
#[derive(Clone, Debug)]
pub enum Refusal {
    /// The initial or the final state has no coordinates.
    Chart(ChartError),
    /// The integration stopped, at this distance in radians from the nearest singularity of the coordinates
    /// (infinite where the chart has none).
    Integration(IntegrationError, f64),
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Chart(error) => error.fmt(f),
            Self::Integration(error, distance) => {
                write!(f, "{error} ({distance:.0e} rad from the singularity of the chart)")
            }
        }
    }
}

/// The distance of a rotation from the singularities of a chart, in radians, from the rotation alone.
#[must_use]
pub fn distance_from_singularity(chart: Chart, rotation: &UnitQuaternion<f64>) -> f64 {
    let Chart::Jet(coordinates) = chart else { return f64::INFINITY };
    match coordinates {
        RotationChart::Euler(EulerSequence { axes: [first, second, third] }) => {
            let r = rotation.to_rotation_matrix().into_inner();
            let (first, second, third) = (usize::from(first), usize::from(second), usize::from(third));
            // Singular is where the first axis, which stays in space, and the third, which stays in the body, are
            // parallel. The sine of their angle from the two entries of the row beside the third, which do not cancel.
            let others = if first == third { [second, 3 - first - second] } else { [first, second] };
            let sine = others.map(|i| r[(first, i)] * r[(first, i)]).iter().sum::<f64>().sqrt();
            sine.min(1.0).asin()
        }
        // Half a turn: w = cos(θ/2) = 0.
        RotationChart::Rodrigues => 2.0 * rotation.w.abs().min(1.0).asin(),
        // A full turn: the vector part vanishes, with w < 0 on the branch that started near w = 1. Both branches count.
        RotationChart::ModifiedRodrigues => 2.0 * rotation.imag().norm().min(1.0).asin(),
        _ => f64::INFINITY,
    }
}

/// The largest error of a state, see [`Outcome::state`]. Where O is fixed at Ω its b is not compared: the reference may
/// hold O elsewhere.
#[must_use]
pub fn distance(reference: &State, pose: &Isometry3<f64>, twist: &SVector<f64, 6>, fixed_point: bool) -> f64 {
    let rotation = pose.rotation.to_rotation_matrix().into_inner();
    let relative = |found: Vector3<f64>, expected: Vector3<f64>| (found - expected).amax() / expected.amax().max(1.0);
    let (u, omega) = (Vector3::new(twist[0], twist[1], twist[2]), Vector3::new(twist[3], twist[4], twist[5]));
    let b = if fixed_point { 0.0 } else { relative(pose.translation.vector, reference.b) };
    [(rotation - reference.rotation).amax(), b, relative(u, reference.u), relative(omega, reference.omega)]
        .into_iter()
        // Written so that a NaN wins.
        .fold(0.0, |worst, error| if error > worst || error.is_nan() { error } else { worst })
}

/// Runs `kernel` over the scene and compares. `left` is the same body in the left-invariant chart, in whose variables
/// the reference is given; states go from it to `kernel` and back by [`convert`].
///
/// # Errors
/// When the state has no coordinates in the chart, or the integration stops.
pub fn run<L, B, F>(scene: &Scene, left: &L, kernel: &B, form: F, control: Order8) -> Result<Outcome, Refusal>
where
    L: RigidBodySystem<Scalar = f64, Input = ()>,
    B: RigidBodySystem<Scalar = f64, Input = ()>,
    F: Form<B>,
{
    let (pose, twist) = (scene.initial.pose(), scene.initial.twist());
    // A body with a fixed point is at Ω, wherever the reference holds it: heights count from O in both.
    let fixed_point = L::DOF == 3;
    let pose = if fixed_point { Isometry3 { translation: Translation3::identity(), ..pose } } else { pose };
    let start = left.configuration(&pose).map_err(Refusal::Chart)?;
    let speeds = left.speeds(0.0, &start, &twist);
    let (q, z) = convert(left, &start, &speeds, kernel).map_err(Refusal::Chart)?;

    let (mut integrals, mut largest, mut least, mut steps) = (0.0_f64, 0.0_f64, f64::INFINITY, 0);
    let mut rotation = pose.rotation;
    let outcome = Simulation::new(kernel)
        .form(form)
        .control(control)
        .max_steps(LIMIT)
        .observe(|sample| {
            let moment = Moment::of(kernel, sample.t, &sample.q, &sample.z);
            for conserved in &scene.conserved {
                let (value, size) = moment.integral(&conserved.name, &scene.parameters);
                assert_eq!(value.len(), conserved.value.len(), "{}", conserved.name);
                for (found, expected) in value.iter().zip(&conserved.value) {
                    let error = (found - expected).abs() / size;
                    integrals = if error > integrals || error.is_nan() { error } else { integrals };
                }
            }
            rotation = moment.pose.rotation;
            let twist = kernel.body_twist(sample.t, &sample.q, &sample.z);
            let stretch = sample.z.max_norm() / twist.amax();
            (largest, least, steps) = (largest.max(stretch), least.min(stretch), steps + 1);
        })
        .run_to_end(q, z, 0.0..scene.duration);
    let last = outcome.map_err(|error| Refusal::Integration(error, distance_from_singularity(B::CHART, &rotation)))?;

    let (end, speeds) = convert(kernel, &last.q, &last.z, left).map_err(Refusal::Chart)?;
    let (pose, twist) = (left.pose(last.t, &end), left.body_twist(last.t, &end, &speeds));
    Ok(Outcome {
        state: distance(&scene.last, &pose, &twist, fixed_point),
        integrals,
        stretch: largest.max(largest / least).max(1.0),
        steps: steps - 1,
    })
}
