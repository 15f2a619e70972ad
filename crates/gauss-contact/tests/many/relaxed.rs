//! The convex relaxation of Coulomb's law beside it.

use gauss_contact::{ContactRun, ContactStepper, ContactSteps, Mode, StepLaw};
use gauss_runtime::contact::{Contact, ContactSystem};
use gauss_runtime::nalgebra::SMatrix;
use gauss_runtime::system::GaussSystem;

use crate::common::{Layout, Scene, V};

const G: f64 = 9.81;

struct Corners;
impl Layout for Corners {
    const CONTACTS: &'static [Contact] =
        &[Contact::new("a", 0, 2), Contact::new("b", 3, 2), Contact::new("c", 6, 2), Contact::new("d", 9, 2)];
}

/// A cube of edge a that lies on a plate, its angles small: it is thrown flat along the plate, and turns but little.
/// Rows are those of its four lower corners.
fn cube(mu: f64) -> Scene<Corners, 6, 4, 12> {
    let (m, a) = (1.0, 0.2);
    let mut rows = SMatrix::<f64, 12, 6>::zeros();
    for (i, [sx, sy]) in [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]].into_iter().enumerate() {
        let [x, y, z] = [0.5 * a * sx, 0.5 * a * sy, -0.5 * a];
        // v + ω × r: along z, x, y.
        rows.row_mut(3 * i).copy_from_slice(&[0.0, 0.0, 1.0, y, -x, 0.0]);
        rows.row_mut(3 * i + 1).copy_from_slice(&[1.0, 0.0, 0.0, 0.0, z, -y]);
        rows.row_mut(3 * i + 2).copy_from_slice(&[0.0, 1.0, 0.0, -z, 0.0, x]);
    }
    let inertia = m * a * a / 6.0;
    let mass = V::from([m, m, m, inertia, inertia, inertia]);
    Scene::linear(mass, V::from([0.0, 0.0, -m * G, 0.0, 0.0, 0.0]), V::zeros(), rows).friction([mu; 4])
}

#[test]
fn a_cube_thrown_flat_along_a_plate_is_lifted_by_the_relaxed_law_alone() {
    let (mu, v) = (0.5, 6.0);
    let kernel = cube(mu);
    let speeds = V::from([v, 0.0, 0.0, 0.0, 0.0, 0.0]);
    // Event by event and in steps by Coulomb's law it stays on the plate, and stops after v²/2μg.
    let exact = ContactRun::new(&kernel).adaptive(1e-10, 1e-10).run(V::zeros(), speeds, 0.0..2.0).unwrap();
    assert!(exact.iter().all(|state| state.q[2].abs() <= 1e-14), "leaves");
    for h in [1e-2, 1e-3] {
        let steps = ContactSteps::new(&kernel, h).run(V::zeros(), speeds, 0.0..2.0).unwrap();
        assert!(steps.iter().all(|step| step.state.q[2].abs() <= 1e-14), "{h}");
        assert!(steps.iter().all(|step| step.report.from_coulomb == step.report.residual));
        assert!((steps.last().unwrap().state.q[0] - v * v / (2.0 * mu * G)).abs() <= mu * G * h * h);

        // By the relaxed law the first impulse P takes μP of the slip and gives the rate μ times what is left:
        // P − g h = μ (v − μ P). Then it flies.
        let relaxed = ContactSteps::new(&kernel, h).law(StepLaw::ConvexRelaxation);
        let relaxed = relaxed.run(V::zeros(), speeds, 0.0..2.0).unwrap();
        let impulse = (mu * v + G * h) / (1.0 + mu * mu);
        let first = &relaxed[0];
        let up = first.state.z[2];
        // A few roundings of the largest rate.
        assert!((up - (impulse - G * h)).abs() <= 1e-13 && (first.state.z[0] - (v - mu * impulse)).abs() <= 1e-13);
        let along = |mode: &Mode| matches!(mode, Mode::Slides([x, y, _]) if *x == 1.0 && y.abs() <= 1e-15);
        assert!(first.modes.iter().all(along), "{:?}", first.modes);
        assert!(first.report.residual.signorini <= 1e-12, "{:?}", first.report);
        assert!((first.report.from_coulomb.signorini - up).abs() <= 1e-12, "{:?}", first.report);
        let highest = relaxed.iter().map(|step| step.state.q[2]).fold(0.0, f64::max);
        // Half of the first step on its way, then a parabola of which the top is within half a step.
        let wanted = 0.5 * h * up + up * up / (2.0 * G);
        assert!((highest - wanted).abs() <= 0.5 * G * h * h, "{h} {highest} {wanted}");
        // 294 mm however short the steps are.
        assert!((highest - 0.2936).abs() < 3.0 * h, "{h} {highest}");
        assert!(relaxed.iter().all(|step| step.state.q[2] >= -1e-14));
    }
}

/// A start on the plate with a rate towards it is an impact: the speed that it takes is no acceleration, by which the
/// scheme of second order would take the next step.
#[test]
fn a_start_with_an_approach_is_an_impact() {
    let kernel = cube(0.5);
    for (approach, impacts) in [(-1.0, 4), (0.0, 0)] {
        let speeds = V::from([0.0, 0.0, approach, 0.0, 0.0, 0.0]);
        let mut stepper = ContactStepper::new(&kernel, 0.0, V::zeros(), speeds).unwrap();
        assert_eq!(stepper.step(1e-3, &()).unwrap().impacts, impacts);
    }
}

#[test]
fn where_nothing_slides_both_laws_are_one() {
    let kernel = cube(0.5).force(|_, _, _| V::from([4.0, 0.0, -G, 0.0, 0.0, 0.0]));
    let run = ContactSteps::new(&kernel, 0.01).law(StepLaw::ConvexRelaxation);
    for step in &run.run(V::zeros(), V::zeros(), 0.0..10.0).unwrap() {
        // Corners depend on one another: what one takes to the side another gives back, to rounding of twelve terms of
        // g h; a thousand steps of it.
        let rounding = 12.0 * 4.0 * f64::EPSILON * G * 0.01;
        assert!(step.state.z.amax() <= rounding && step.state.q.amax() <= 1000.0 * 0.01 * rounding, "{:?}", step.state);
        assert_eq!(step.modes, [Mode::Sticks; 4]);
        assert!(step.report.from_coulomb.signorini <= 1e-12);
    }
}

struct Plane;
impl Layout for Plane {
    const CONTACTS: &'static [Contact] = &[Contact::new("plane", 0, 2)];
}

/// A sphere on a plane: (x, y, h, and three angles), its inertia the same about all axes, its slip v + ω × (−r e₃).
fn sphere(m: f64, r: f64, mu: f64) -> Scene<Plane, 6, 1, 3> {
    let inertia = 0.4 * m * r * r;
    let rows = SMatrix::<f64, 3, 6>::from_row_slice(&[
        0., 0., 1., 0., 0., 0., //
        1., 0., 0., 0., -r, 0., //
        0., 1., 0., r, 0., 0.,
    ]);
    let weight = V::from([0.0, 0.0, -m * G, 0.0, 0.0, 0.0]);
    let mass = V::from([m, m, m, inertia, inertia, inertia]);
    Scene::linear(mass, weight, V::from([-r]), rows).friction([mu])
}

#[test]
fn a_sphere_set_sliding_jumps_and_comes_to_roll() {
    let (r, v) = (0.1, 2.0);
    let kernel = sphere(2.0, r, 0.3);
    let start = (V::from([0.0, 0.0, r, 0.0, 0.0, 0.0]), V::from([v, 0.0, 0.0, 0.0, 0.0, 0.0]));
    let run = ContactSteps::new(&kernel, 1e-3).law(StepLaw::ConvexRelaxation).run(start.0, start.1, 0.0..4.0).unwrap();
    let end = run.last().unwrap();
    // Friction of whatever size keeps the angular momentum about a line of the plane: rounding of 4000 steps.
    assert!((end.state.z[0] - 5.0 / 7.0 * v).abs() < 1e-12, "{}", end.state.z);
    assert_eq!(end.modes, [Mode::Sticks]);
    assert!(kernel.gaps(0.0, &end.state.q)[0].abs() <= 1e-15);
    assert!(run.iter().any(|step| step.state.q[2] > r + 1e-4));
    // It takes energy away in every step.
    let energy = |step: &gauss_contact::StepSample<_>| kernel.energy(step.state.t, &step.state.q, &step.state.z);
    assert!(run.windows(2).all(|pair| energy(&pair[1]) <= energy(&pair[0]) + 1e-12));
}
