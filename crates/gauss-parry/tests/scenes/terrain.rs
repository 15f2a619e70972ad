//! A box on a mesh and on a height field.

use gauss_parry::parry3d_f64::math::Vector;
use gauss_parry::parry3d_f64::shape::SharedShape;
use gauss_parry::parry3d_f64::utils::Array2;
use gauss_parry::{ParrySteps, Reduction, Shapes};
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::prelude::*;

use crate::plane::surface;

/// A crate.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(hull, position = pose.position, rotation = pose.rotation, mass = 2, inertia = [0.06, 0.05, 0.04]),
    frames(hull),
)]
struct Crate {
    #[gauss(gravity)]
    g: f64,
}

/// A square of 4 × 4 with 8 × 8 cells, rising along x by the slope, as triangles.
fn mesh(slope: f64) -> SharedShape {
    let at = |i: u32, j: u32| {
        let (x, y) = (f64::from(i) * 0.5 - 2.0, f64::from(j) * 0.5 - 2.0);
        Vector::new(x, y, slope * x)
    };
    let vertices = (0..9).flat_map(|j| (0..9).map(move |i| at(i, j))).collect();
    let corner = |i: u32, j: u32| 9 * j + i;
    let cell = |i, j| {
        let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
        [[a, b, c], [a, c, d]]
    };
    let triangles = (0..8).flat_map(|j| (0..8).flat_map(move |i| cell(i, j))).collect();
    SharedShape::trimesh(vertices, triangles).unwrap()
}

fn on(ground: SharedShape, mu: f64) -> Shapes<CrateFrame> {
    let mut shapes = Shapes::new();
    shapes.add(None, ground, Isometry3::identity(), surface(mu, 0.0));
    shapes.add(Some(CrateFrame::hull), SharedShape::cuboid(0.2, 0.15, 0.1), Isometry3::identity(), surface(mu, 0.0));
    shapes.reduce(Reduction::Quadrilateral).most(8)
}

/// Steps until the end; the deepest gap before projections.
fn go(steps: &mut ParrySteps<'_, CrateKernel, 8, 24, 6>, kernel: &CrateKernel, count: usize) -> f64 {
    let mut deepest = 0.0_f64;
    let mut energy = kernel.energy(0.0, steps.configuration(), steps.speeds());
    for n in 0..count {
        let report = steps.step(1e-3, &()).unwrap();
        deepest = deepest.max(report.penetration);
        let now = kernel.energy(0.0, steps.configuration(), steps.speeds());
        assert!(now <= energy + 1e-9, "{n} {now} {energy}");
        energy = now;
    }
    deepest
}

#[test]
fn a_box_slides_down_a_mesh_as_down_a_plane() {
    let (g, slope, mu) = (9.81, 0.3_f64, 0.2);
    let kernel = Crate { g }.kernel().unwrap();
    let angle = -slope.atan();
    let turn = Vector3::new(0.0, angle, 0.0);
    let up = Vector3::new(-slope, 0.0, 1.0).normalize();
    // On the slope at x = 1.5, askew to all edges of the mesh.
    let place = Vector3::new(1.5, 0.07, 1.5 * slope) + up * 0.1;
    let pose = Isometry3::new(place, turn);
    let begin = (0.0, pose, SVector::zeros());
    let mut steps = ParrySteps::<_, 8, 24, _>::new(&kernel, on(mesh(slope), mu), begin).unwrap();
    let deepest = go(&mut steps, &kernel, 600);
    // It slides with g (sin − μ cos), whatever triangles are below it.
    let (sin, cos) = (angle.abs().sin(), angle.cos());
    let way = 0.5 * g * (sin - mu * cos) * 0.6 * 0.6;
    let moved = (steps.configuration().translation.vector - place).norm();
    // Rounding of places of 2, a few for each of 600 steps.
    let rounding = 600.0 * 8.0 * f64::EPSILON;
    assert!((moved - way).abs() < rounding && deepest < rounding, "{moved} {way} {deepest:e}");
    let height = steps.configuration().translation.vector.dot(&up) - 0.1;
    let turned = steps.configuration().rotation.coords - pose.rotation.coords;
    assert!(height.abs() < rounding && turned.amax() < rounding, "{height:e} {turned}");
    // On a rough one it does not creep.
    let mut steps = ParrySteps::<_, 8, 24, _>::new(&kernel, on(mesh(slope), 0.5), begin).unwrap();
    go(&mut steps, &kernel, 600);
    let moved = (steps.configuration().translation.vector - place).norm();
    assert!(moved < 600.0 * 2.0 * f64::EPSILON, "{moved:e}");
}

#[test]
fn a_box_comes_to_rest_on_hills() {
    let kernel = Crate { g: 9.81 }.kernel().unwrap();
    let heights = Array2::new(9, 9, (0..81).map(|k| 0.1 * ((k % 9) as f64).sin() * ((k / 9) as f64).cos()).collect());
    let ground = SharedShape::heightfield(heights, Vector::new(4.0, 1.0, 4.0));
    // The library's height fields rise along y.
    let mut shapes = Shapes::new();
    let stood = Isometry3::rotation(Vector3::new(std::f64::consts::FRAC_PI_2, 0.0, 0.0));
    shapes.add(None, ground, stood, surface(0.8, 0.0));
    shapes.add(Some(CrateFrame::hull), SharedShape::cuboid(0.2, 0.15, 0.1), Isometry3::identity(), surface(0.8, 0.0));
    let shapes = shapes.reduce(Reduction::Quadrilateral).most(16).reach(0.03);
    let pose = Isometry3::new(Vector3::new(0.1, 0.2, 0.4), Vector3::new(0.2, 0.1, 0.0));
    let mut steps = ParrySteps::<_, 16, 48, _>::new(&kernel, shapes, (0.0, pose, SVector::zeros())).unwrap();
    let mut energy = kernel.energy(0.0, steps.configuration(), steps.speeds());
    let first = energy;
    for n in 0..3000 {
        let report = steps.step(1e-3, &()).unwrap();
        // Rounding of places up to 1, after every step.
        let gaps = steps.slots().gaps(0.0, steps.configuration());
        assert!(gaps.min() > -1e-14, "{n} {gaps}");
        // Where a new edge is met below zero, it is lifted by that; a step errs by the third power of its turn, which
        // is below 20 rad/s.
        let turn = 20.0_f64 * 1e-3;
        let now = kernel.energy(0.0, steps.configuration(), steps.speeds());
        assert!(
            now <= energy + 2.0 * 9.81 * report.penetration + first * turn.powi(3),
            "{n} {now} {energy} {report:?}"
        );
        energy = now;
    }
    assert!(steps.speeds().amax() < 1e-6 && energy < first, "{}", steps.speeds());
}
