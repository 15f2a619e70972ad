//! Splitting methods on derived kernels: reference solutions, errors as measured elsewhere, what long runs keep, what
//! is refused.

mod bodies;

use bodies::{Afloat, Dragged, Observed, OffCentre, Skewed, attitude_error, flying, top};
use gauss_exact::{Scheme, Splitting, SplittingError, TopError, TopFlow};
use gauss_runtime::integrate::{Fixed, OneStep};
use gauss_runtime::prelude::*;
use gauss_tests::scene::Scene;
use gauss_tests::top::TopKernel;

const EPSILON: f64 = f64::EPSILON;

type Top = TopKernel<f64>;

fn run(scene: &Scene, kernel: &Top, method: &(impl OneStep<Top> + Copy), steps: u32) -> Sample<Top> {
    Simulation::new(kernel)
        .momentum_form()
        .control(Fixed::by(*method, scene.duration / f64::from(steps)))
        .run_to_end(scene.initial.pose().rotation, scene.initial.omega, 0.0..scene.duration)
        .expect("the motion is regular")
        .sample
}

/// What rounding may do to the end of a scene: each of `calls` drifts commits some 16 roundings of random sign, of
/// which the motion makes what the scene says of one; parameters are rounded once, so that the angle counts that the
/// body turns through.
fn rounding(scene: &Scene, calls: f64) -> f64 {
    let angle = scene.initial.omega.norm().max(scene.last.omega.norm()) * scene.duration;
    16.0 * (calls.sqrt() + angle) * scene.sensitivity.max(EPSILON)
}

/// The reference solutions of free bodies, in one step over their whole duration.
#[test]
fn free_bodies_in_one_step() {
    for name in ["hlw_free_body", "free_asym_top", "free_near_separatrix"] {
        let scene = Scene::load(name);
        let kernel = top(&scene);
        let exact = Splitting::exact(&kernel, Scheme::STRANG).expect("a body");
        let end = run(&scene, &kernel, &exact, 1);
        let error = attitude_error(&end.q, &scene).max((end.z - scene.last.omega).amax());
        assert!(error <= rounding(&scene, 1.0), "{name}: {error:e}, allowed {:e}", rounding(&scene, 1.0));
    }
}

/// Those of heavy bodies of revolution, whose axes are e₂ and e₃, and what the energy does on the way.
#[test]
fn heavy_tops_of_revolution_in_one_step() {
    for name in ["bruls_heavy_top", "simo_wong_top", "lagrange_top"] {
        let scene = Scene::load(name);
        let kernel = top(&scene);
        let exact = TopFlow::new(&kernel).expect("a heavy body of revolution");
        let end = run(&scene, &kernel, &exact, 1);
        let error = attitude_error(&end.q, &scene).max((end.z - scene.last.omega).amax() / scene.last.omega.amax());
        assert!(error <= rounding(&scene, 1.0), "{name}: {error:e}, allowed {:e}", rounding(&scene, 1.0));
        let before = kernel.energy(0.0, &scene.initial.pose().rotation, &scene.initial.omega);
        let off = (kernel.energy(0.0, &end.q, &end.z) / before - 1.0).abs();
        assert!(off <= 32.0 * EPSILON, "{name}: energy {off:e}");
    }
}

/// A top whose axis lies askew in the axes of the body.
#[test]
fn an_axis_may_lie_anywhere_in_the_body() {
    let scene = Scene::load("lagrange_top");
    let p = &scene.parameters;
    let axes = UnitQuaternion::from_euler_angles(0.4, -0.7, 1.1);
    let matrix = axes.to_rotation_matrix().into_inner();
    let inertia = matrix * Matrix3::from_diagonal(&p.principal) * matrix.transpose();
    let inertia = (inertia + inertia.transpose()) * 0.5;
    let skewed = Skewed { mass: p.mass, center: axes * p.center, inertia, gravity: p.gravity };
    let skewed = skewed.kernel().expect("the same top");
    let exact = TopFlow::new(&skewed).expect("a heavy body of revolution");
    let (q, z) = (scene.initial.pose().rotation, scene.initial.omega);
    let end = Simulation::new(&skewed)
        .control(Fixed::by(exact, scene.duration))
        .run_to_end(q * axes.inverse(), axes * z, 0.0..scene.duration)
        .expect("the motion is regular");
    let error = attitude_error(&(end.q * axes), &scene);
    assert!(error <= rounding(&scene, 1.0), "{error:e}, allowed {:e}", rounding(&scene, 1.0));
}

#[test]
fn what_is_not_a_heavy_body_of_revolution_is_refused() {
    for (name, expected) in [
        ("hlw_heavy_top", TopError::NotOfRevolution),
        ("kovalevskaya", TopError::NotOfRevolution),
        ("free_asym_top", TopError::Free),
    ] {
        assert_eq!(TopFlow::new(&top(&Scene::load(name))), Err(expected), "{name}");
    }
}

/// A needle in flight: its fall is uniform, so that one kick, one drift and one kick are exact as well.
#[test]
fn a_falling_needle_in_one_step() {
    let scene = Scene::load("needle_free");
    let kernel = flying(&scene);
    let exact = Splitting::exact(&kernel, Scheme::STRANG).expect("a body");
    let end = Simulation::new(&kernel)
        .momentum_form()
        .control(Fixed::by(exact, scene.duration))
        .run_to_end(scene.initial.pose(), scene.initial.twist(), 0.0..scene.duration)
        .expect("the motion is regular");
    let allowed = rounding(&scene, 1.0);
    let error = attitude_error(&end.q.rotation, &scene);
    assert!(error <= allowed, "R: {error:e}, allowed {allowed:e}");
    // Positions and velocities up to 20.
    let error = (end.q.translation.vector - scene.last.b).amax() / 20.0;
    assert!(error <= 16.0 * EPSILON, "b: {error:e}");
    let twist = Vector6::from_fn(|i, _| if i < 3 { scene.last.u[i] } else { scene.last.omega[i - 3] });
    let error = (end.z - twist).amax() / twist.amax();
    assert!(error <= allowed, "twist: {error:e}, allowed {allowed:e}");
}

/// Errors at the end of a scene, measured elsewhere with another implementation of the same methods over the discrete
/// Moser–Veselov method of order 10.
struct Measured {
    scene: &'static str,
    scheme: Scheme,
    /// Steps, max norm of the difference of R.
    errors: &'static [(u32, f64)],
}

const MEASURED: [Measured; 7] = [
    Measured { scene: "hlw_heavy_top", scheme: Scheme::STRANG, errors: &[(150, 5.3e-2), (600, 3.6e-3)] },
    Measured {
        scene: "hlw_heavy_top",
        scheme: Scheme::BLANES_MOAN_4,
        errors: &[(150, 8.5e-7), (300, 7.4e-8), (600, 4.9e-9), (1200, 3.1e-10)],
    },
    Measured {
        scene: "hlw_heavy_top",
        scheme: Scheme::KAHAN_LI_6,
        errors: &[(150, 1.1e-5), (300, 1.7e-7), (600, 2.6e-9), (1200, 4.1e-11)],
    },
    Measured {
        scene: "bruls_heavy_top",
        scheme: Scheme::BLANES_MOAN_4,
        errors: &[(500, 3.4e-10), (1000, 2.8e-13), (2000, 2.1e-14)],
    },
    Measured {
        scene: "bruls_heavy_top",
        scheme: Scheme::KAHAN_LI_6,
        errors: &[(500, 1.9e-9), (1000, 1.7e-12), (2000, 1.3e-14)],
    },
    Measured {
        scene: "simo_wong_top",
        scheme: Scheme::STRANG,
        errors: &[(1000, 9e-6), (2500, 1.4e-6), (5000, 3.6e-7)],
    },
    Measured {
        scene: "simo_wong_top",
        scheme: Scheme::BLANES_MOAN_4,
        errors: &[(1000, 8.9e-11), (2500, 9e-14), (5000, 1e-14)],
    },
];

#[test]
fn heavy_tops_as_measured_elsewhere() {
    for Measured { scene: name, scheme, errors } in MEASURED {
        let scene = Scene::load(name);
        let kernel = top(&scene);
        let exact = Splitting::exact(&kernel, scheme).expect("a body");
        let discrete = Splitting::discrete(&kernel, scheme).expect("a body");
        for &(steps, expected) in errors {
            let rounding = rounding(&scene, f64::from(steps) * scheme.drifts().len() as f64);
            // Two digits were given.
            let allowed = 1.2 * expected + rounding;
            let error = attitude_error(&run(&scene, &kernel, &discrete, steps).q, &scene);
            assert!(error <= allowed, "{name}, {scheme:?}, {steps}: {error:e}, allowed {allowed:e}");
            // Without the error of drifts it is smaller on fast tops.
            let error = attitude_error(&run(&scene, &kernel, &exact, steps).q, &scene);
            assert!(error <= allowed, "{name}, {scheme:?}, {steps}, exact drifts: {error:e}, allowed {allowed:e}");
        }
    }
}

/// A hundred thousand steps: the energy swings and does not drift, the momentum about gravity is kept up to rounding of
/// random sign, the quaternion has norm 1.
fn keeps_energy_and_momentum(scene: &Scene, kernel: &Top, method: &(impl OneStep<Top> + Copy)) {
    let (q, z) = (scene.initial.pose().rotation, scene.initial.omega);
    let (steps, h) = (100_000_u32, 0.1);
    let about_gravity = |q: &UnitQuaternion<f64>, p: &Vector3<f64>| (q * p).z;
    let before = (kernel.energy(0.0, &q, &z), about_gravity(&q, &kernel.momentum(0.0, &q, &z)));
    let mut errors = Vec::new();
    let mut momentum = 0.0_f64;
    Simulation::new(kernel)
        .momentum_form()
        .control(Fixed::by(*method, h))
        .observe(|sample| {
            errors.push(kernel.energy(sample.t, &sample.q, &sample.z) / before.0 - 1.0);
            momentum = momentum.max((about_gravity(&sample.q, &sample.p) - before.1).abs());
            let norm: f64 = sample.q.coords.iter().map(|c| c * c).sum();
            assert!((norm - 1.0).abs() <= 4.0 * EPSILON);
        })
        .run_to_end(q, z, 0.0..h * f64::from(steps))
        .expect("the motion is regular");
    let swing = errors.iter().fold(0.0_f64, |m, e| m.max(e.abs()));
    // Measured elsewhere over 150,000 steps: 1.3e-8, two digits.
    assert!(swing < 1.35e-8, "{swing:e}");
    let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
    let quarter = errors.len() / 4;
    let drift = mean(&errors[3 * quarter..]) - mean(&errors[..quarter]);
    // Means over 25,000 samples of a swing that comes back every hundred: a few per cent of it.
    assert!(drift.abs() < 0.05 * swing, "{drift:e} of {swing:e}");
    // Six drifts and seven kicks a step, each a few roundings of numbers near 1.
    let walk = 10.0 * EPSILON * (13.0 * f64::from(steps)).sqrt();
    assert!(momentum < walk, "{momentum:e}, allowed {walk:e}");
}

#[test]
fn long_runs_keep_energy_and_momentum() {
    let scene = Scene::load("hlw_heavy_top");
    let kernel = top(&scene);
    let exact = Splitting::exact(&kernel, Scheme::BLANES_MOAN_4).expect("a body");
    keeps_energy_and_momentum(&scene, &kernel, &exact);
    let discrete = Splitting::discrete(&kernel, Scheme::BLANES_MOAN_4).expect("a body");
    keeps_energy_and_momentum(&scene, &kernel, &discrete);
}

/// A body with products of inertia moves like itself in its principal axes.
#[test]
fn products_of_inertia_are_turned_away() {
    let scene = Scene::load("hlw_heavy_top");
    let p = &scene.parameters;
    let axes = UnitQuaternion::from_euler_angles(0.4, -0.7, 1.1);
    let matrix = axes.to_rotation_matrix().into_inner();
    let inertia = matrix * Matrix3::from_diagonal(&p.principal) * matrix.transpose();
    // Equal off-diagonal entries to the last bit.
    let inertia = (inertia + inertia.transpose()) * 0.5;
    let skewed = Skewed { mass: p.mass, center: axes * p.center, inertia, gravity: p.gravity };
    let skewed = skewed.kernel().expect("the same top");
    let (q, z) = (scene.initial.pose().rotation, scene.initial.omega);
    let method = Splitting::exact(&skewed, Scheme::BLANES_MOAN_4).expect("a body");
    let end = Simulation::new(&skewed)
        .momentum_form()
        .control(Fixed::by(method, 0.1))
        .run_to_end(q * axes.inverse(), axes * z, 0.0..10.0)
        .expect("runs");
    let plain = top(&scene);
    let method = Splitting::exact(&plain, Scheme::BLANES_MOAN_4).expect("a body");
    let expected = Simulation::new(&plain)
        .momentum_form()
        .control(Fixed::by(method, 0.1))
        .run_to_end(q, z, 0.0..10.0)
        .expect("runs");
    let off = ((end.q * axes).to_rotation_matrix().into_inner() - expected.q.to_rotation_matrix().into_inner()).amax();
    // 600 drifts, and parameters that are rounded once.
    assert!(off <= rounding(&scene, 600.0), "{off:e}, allowed {:e}", rounding(&scene, 600.0));
}

#[test]
fn what_is_not_a_free_body_between_kicks_is_refused() {
    let inertia = Vector3::new(1.0, 1.5, 2.0);
    let (mass, gravity) = (2.0, 9.81);
    let center = Vector3::new(0.0, 0.1, 0.0);
    let off_centre = OffCentre { mass, center, principal: inertia, gravity }.kernel().expect("a body");
    let refused = Splitting::exact(&off_centre, Scheme::STRANG).expect_err("O is not the centre of mass");
    assert_eq!(refused, SplittingError::Coupled { coupling: 0.2 });
    assert!(refused.to_string().contains("put O into the centre of mass"), "{refused}");

    let added = Vector6::new(1.0, 2.0, 2.0, 0.1, 0.2, 0.2);
    let afloat = Afloat { mass, principal: inertia, added }.kernel().expect("a body");
    let refused = Splitting::exact(&afloat, Scheme::STRANG).expect_err("mass depends on the direction");
    assert_eq!(refused, SplittingError::AnisotropicMass);

    let observed = Observed { mass, principal: inertia, gravity }.kernel().expect("a body");
    let refused = Splitting::exact(&observed, Scheme::STRANG).expect_err("velocities of the observer");
    assert_eq!(refused, SplittingError::NotBodyVelocities);

    let dragged = Dragged { mass, principal: inertia, drag: Vector6::repeat(1e-6) }.kernel().expect("a body");
    let refused = Splitting::exact(&dragged, Scheme::STRANG).expect_err("drag");
    assert!(matches!(refused, SplittingError::ForcesDependOnVelocity { .. }), "{refused:?}");
    assert!(refused.to_string().contains("Runge–Kutta"), "{refused}");

    let flying = flying(&Scene::load("needle_free"));
    assert!(Splitting::discrete(&flying, Scheme::KAHAN_LI_8).is_ok(), "O is the centre of mass, nothing drags");
}
