//! The energy–momentum method on derived kernels: bodies in fluid with weight and buoyancy at different points, in
//! space and in the plane, a top on a spring. Energy and momenta over up to 10⁵ steps; the order against reference
//! solutions.

use gauss_long_runs::steps;
use gauss_runtime::integrate::{Composed, Composition, EnergyMomentum, Fixed, OneStep};
use gauss_runtime::prelude::*;
use gauss_tests::scene::{Scene, quaternion_of};
use gauss_tests::top::{Top, TopKernel};

/// A body in fluid, in space or in the plane.
macro_rules! body {
    ($name:ident, $motion:ident) => {
        #[derive(GaussDynamics)]
        #[gauss(chart = left_invariant, motion = $motion)]
        struct $name {
            #[gauss(mass)]
            mass: f64,
            #[gauss(center_of_mass)]
            center: Vector3<f64>,
            #[gauss(inertia)]
            inertia: Matrix3<f64>,
            #[gauss(added_mass)]
            fluid: Matrix6<f64>,
            #[gauss(gravity)]
            field: Vector3<f64>,
            #[gauss(displaced_mass)]
            displaced: f64,
            #[gauss(center_of_buoyancy)]
            buoyancy: Vector3<f64>,
        }

        impl $name {
            /// O is neither the centre of mass nor that of buoyancy, and the fluid couples translation and rotation.
            fn heavy(field: Vector3<f64>) -> Self {
                let mut fluid = Matrix6::from_diagonal(&Vector6::new(0.3, 0.9, 1.4, 0.02, 0.1, 0.06));
                for (i, j, entry) in [(0, 1, 0.05), (0, 4, 0.03), (1, 5, -0.08), (2, 3, 0.04), (3, 4, 0.01)] {
                    fluid[(i, j)] = entry;
                    fluid[(j, i)] = entry;
                }
                Self {
                    mass: 2.0,
                    center: Vector3::new(0.05, -0.1, 0.08),
                    inertia: Matrix3::new(0.4, 0.02, 0.0, 0.02, 0.5, -0.03, 0.0, -0.03, 0.3),
                    fluid,
                    field,
                    displaced: 1.9,
                    buoyancy: Vector3::new(-0.02, 0.06, 0.1),
                }
            }
        }
    };
}

body!(InSpace, free);
body!(InPlane, planar);

/// A top whose tip hangs on a spring: a potential that is not linear in R.
#[derive(GaussDynamics)]
#[gauss(
    motion = fixed_point,
    point(tip, body = body, at = [0.1, 0, 0.5]),
    spring(cord, from = [0, 0, 1], to = tip, stiffness = stiff, length = rest),
)]
struct Tethered {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
    stiff: f64,
    rest: f64,
}

/// Steps of a run.
fn usual() -> u32 {
    steps(100_000)
}

/// What a run of the usual length does to quantities that should not change, given with the size that rounding is
/// relative to: the largest deviation, and the change along the line through a hundred samples, each relative to the
/// largest size.
fn changes<S, M, const K: usize>(
    kernel: &S,
    start: (S::Configuration, S::Speeds),
    method: M,
    step: f64,
    kept: impl Fn(&Sample<S>) -> [(f64, f64); K],
) -> [(f64, f64); K]
where
    S: GaussSystem<Scalar = f64, Input = ()>,
    M: OneStep<S>,
{
    changes_over(usual(), kernel, start, method, step, kept)
}

/// The same of any number of steps.
fn changes_over<S, M, const K: usize>(
    steps: u32,
    kernel: &S,
    (q, z): (S::Configuration, S::Speeds),
    method: M,
    step: f64,
    kept: impl Fn(&Sample<S>) -> [(f64, f64); K],
) -> [(f64, f64); K]
where
    S: GaussSystem<Scalar = f64, Input = ()>,
    M: OneStep<S>,
{
    let mut samples = Vec::new();
    Simulation::new(kernel)
        .momentum_form()
        .control(Fixed::by(method, step))
        .every(u64::from(steps) / 100)
        .observe(|sample| samples.push(kept(sample)))
        .run_to_end(q, z, 0.0..step * f64::from(steps))
        .expect("runs");
    let n = samples.len() as f64;
    core::array::from_fn(|i| {
        let size = samples.iter().fold(0.0_f64, |m, s| m.max(s[i].1));
        let all: Vec<f64> = samples.iter().map(|s| (s[i].0 - samples[0][i].0) / size).collect();
        let (mean, middle) = (all.iter().sum::<f64>() / n, 0.5 * (n - 1.0));
        let over: f64 = all.iter().enumerate().map(|(k, d)| (k as f64 - middle) * (d - mean)).sum();
        let under: f64 = (0..all.len()).map(|k| (k as f64 - middle).powi(2)).sum();
        (all.iter().fold(0.0, |m, d| m.max(d.abs())), (over / under * n).abs())
    })
}

/// A walk of the usual length, each step of which rounds what is kept by some 4ε; it has no slope but the one to where
/// it ends.
fn walks<const K: usize>(changes: [(f64, f64); K]) {
    let walk = 4.0 * f64::EPSILON * f64::from(usual()).sqrt();
    assert!(changes.iter().all(|&(worst, along)| worst < walk && along < walk), "{changes:?} {walk:e}");
}

/// Weight and buoyancy do not touch the horizontal momentum, nor the angular one about the vertical through Ω.
#[test]
fn a_heavy_body_in_fluid_keeps_energy_and_the_momenta_that_it_has() {
    let kernel = InSpace::heavy(Vector3::new(0.0, 0.0, -9.81)).kernel().expect("a body");
    let pose = Isometry3::from_parts(Translation3::identity(), UnitQuaternion::from_euler_angles(0.4, -0.3, 0.2));
    let twist = Vector6::new(0.5, 0.2, 0.1, 0.6, -0.4, 0.8);
    walks(changes(&kernel, (pose, twist), EnergyMomentum::new(), 1e-3, |sample| {
        let momentum = kernel.space_momentum(sample.t, &sample.q, &sample.z);
        let [px, py, pz, _, _, lz] = momentum.data.0[0];
        let (linear, away) = (px.hypot(py).hypot(pz), sample.q.translation.vector.norm());
        let kinetic = kernel.kinetic_energy(sample.t, &sample.q, &sample.z);
        let energy = kernel.energy(sample.t, &sample.q, &sample.z);
        // About Ω, from which the body goes away.
        [(energy, kinetic), (px, linear), (py, linear), (lz, linear * away)]
    }));
}

#[test]
fn a_heavy_body_in_the_plane_keeps_energy_and_horizontal_momentum() {
    let kernel = InPlane::heavy(Vector3::new(0.0, -9.81, 0.0)).kernel().expect("a body");
    let start = (Isometry2::identity(), Vector3::new(0.5, 0.2, 0.7));
    walks(changes(&kernel, start, EnergyMomentum::new(), 1e-3, |sample| {
        let momentum = kernel.space_momentum(sample.t, &sample.q, &sample.z);
        let kinetic = kernel.kinetic_energy(sample.t, &sample.q, &sample.z);
        [(kernel.energy(sample.t, &sample.q, &sample.z), kinetic), (momentum[0], momentum[0].hypot(momentum[1]))]
    }));
}

/// With six points to rounding; with two momentum is kept to rounding all the same, energy to order h⁴ without drift.
#[test]
fn a_potential_that_is_not_linear_in_the_attitude() {
    let top = Tethered { mass: 1.0, inertia: Vector3::new(0.3, 0.35, 0.1), stiff: 5.0, rest: 0.3 };
    let kernel = top.kernel().expect("a top");
    let start = (UnitQuaternion::from_euler_angles(0.9, -0.3, 0.2), Vector3::new(0.5, 1.0, 4.0));
    let kept = |sample: &Sample<TetheredKernel>| {
        let momentum = kernel.space_momentum(sample.t, &sample.q, &sample.z);
        [
            (kernel.energy(sample.t, &sample.q, &sample.z), kernel.kinetic_energy(sample.t, &sample.q, &sample.z)),
            (momentum[5], momentum.norm()),
        ]
    };
    walks(changes(&kernel, start, EnergyMomentum::<f64, 6>::with_points(), 0.02, kept));
    let two = [0.02, 0.01].map(|step| changes(&kernel, start, EnergyMomentum::new(), step, kept));
    two.iter().for_each(|&[_, momentum]| walks([momentum]));
    let [coarse, fine] = two.map(|[energy, _]| energy);
    // The motion is chaotic, and what is left of the energy's error walks: in four times the time twice as far, where a
    // drift would go four times as far.
    let [longer, _] = changes_over(4 * usual(), &kernel, start, EnergyMomentum::new(), 0.02, kept);
    assert!(coarse.0 < 1e-7 && longer.0 < 3.0 * coarse.0, "{coarse:?} {longer:?}");
    let order = (coarse.0 / fine.0).log2();
    // Each of the two is the largest of a hundred samples of one oscillation.
    assert!((order - 4.0).abs() < 1.0, "{order}");
}

/// The largest error of an entry of R at the end of a reference solution.
fn error_on_the_heavy_top(scene: &Scene, method: impl OneStep<TopKernel<f64>>, steps: u32) -> f64 {
    let p = &scene.parameters;
    let top = Top { mass: p.mass, center: p.center, inertia: p.principal, g: p.gravity };
    let kernel = top.kernel().expect("a top");
    let end = Simulation::new(&kernel)
        .control(Fixed::by(method, scene.duration / f64::from(steps)))
        .run_to_end(quaternion_of(&scene.initial.rotation), scene.initial.omega, 0.0..scene.duration)
        .expect("runs");
    (end.q.to_rotation_matrix().into_inner() - scene.last.rotation).amax()
}

#[test]
fn orders_against_a_reference() {
    let scene = Scene::load("hlw_heavy_top");
    let order = |[coarse, fine]: [f64; 2]| (coarse / fine).ln() / 4.0_f64.ln();
    let alone = order([600, 2400].map(|n| error_on_the_heavy_top(&scene, EnergyMomentum::new(), n)));
    let composed = Composed::new(&Composition::KAHAN_LI_6, EnergyMomentum::new());
    let composed = order([300, 1200].map(|n| error_on_the_heavy_top(&scene, composed, n)));
    assert!((alone - 2.0).abs() < 0.2 && (composed - 6.0).abs() < 0.2, "{alone} {composed}");
}
