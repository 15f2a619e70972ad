//! A flat mesh, beside the plane that it is.

use gauss_parry::parry3d_f64::math::Vector;
use gauss_parry::parry3d_f64::shape::{SharedShape, Triangle};
use gauss_parry::parry3d_f64::utils::Array2;
use gauss_parry::{ParrySteps, Reduction, Shapes};
use gauss_runtime::prelude::*;

use crate::plane::surface;

/// A box, or what has its mass.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(hull, position = pose.position, rotation = pose.rotation, mass = m, inertia = [m * x, m * y, m * z]),
    frames(hull),
)]
struct Free {
    m: f64,
    /// Squares of radii of gyration.
    x: f64,
    y: f64,
    z: f64,
    #[gauss(gravity)]
    g: f64,
}

/// Units: how many of them are a metre and a kilogram.
#[derive(Clone, Copy, Debug)]
struct Units {
    metre: f64,
    kilogram: f64,
}

const SI: Units = Units { metre: 1.0, kilogram: 1.0 };

/// Half of the edges of the box, in metres.
const HALF: [f64; 3] = [0.2, 0.15, 0.1];
const RADIUS: f64 = 0.1;
const G: f64 = 9.81;

impl Units {
    fn kernel(self, squares: [f64; 3]) -> FreeKernel {
        let [x, y, z] = squares.map(|square| square * self.metre * self.metre);
        Free { m: 2.0 * self.kilogram, x, y, z, g: G * self.metre }.kernel().unwrap()
    }

    fn cuboid(self) -> FreeKernel {
        let [a, b, c] = HALF.map(|half| half * half / 3.0);
        self.kernel([b + c, a + c, a + b])
    }

    fn shapes(self, ground: SharedShape, body: SharedShape, mu: f64) -> Shapes<FreeFrame> {
        self.shapes_at((ground, Isometry3::identity()), body, mu)
    }

    fn shapes_at(self, ground: (SharedShape, Isometry3<f64>), body: SharedShape, mu: f64) -> Shapes<FreeFrame> {
        let mut shapes = Shapes::new();
        shapes.add(None, ground.0, ground.1, surface(mu, 0.0));
        shapes.add(Some(FreeFrame::hull), body, Isometry3::identity(), surface(mu, 0.0));
        shapes.reach(0.02 * self.metre).deepest(0.02 * self.metre)
    }

    /// Triangles at heights over a square of 4 m, in cells of a size.
    fn terrain(self, cell: f64, height: impl Fn(i32, i32) -> f64) -> SharedShape {
        let count = (4.0 / cell).round() as i32;
        let at = |i: i32, j: i32| {
            let (x, y) = (f64::from(i) * cell - 2.0, f64::from(j) * cell - 2.0);
            Vector::new(x, y, height(i, j)) * self.metre
        };
        let vertices = (0..=count).flat_map(|j| (0..=count).map(move |i| (i, j))).map(|(i, j)| at(i, j)).collect();
        let corner = |i: i32, j: i32| ((count + 1) * j + i) as u32;
        let triangles = |(i, j): (i32, i32)| {
            let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
            [[a, b, c], [a, c, d]]
        };
        let cells = (0..count).flat_map(|j| (0..count).map(move |i| (i, j)));
        SharedShape::trimesh(vertices, cells.flat_map(triangles).collect()).unwrap()
    }

    /// The flat one, each triangle with corners of its own and every third one turned over.
    fn soup(self, cell: f64) -> SharedShape {
        let flat = self.flat(cell);
        let triangles = flat.as_trimesh().unwrap().triangles().enumerate();
        let turned = |(i, t): (usize, Triangle)| if i % 3 == 0 { [t.a, t.c, t.b] } else { [t.a, t.b, t.c] };
        let vertices: Vec<_> = triangles.flat_map(turned).collect();
        let numbers = (0..vertices.len() as u32 / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        SharedShape::trimesh(vertices, numbers).unwrap()
    }

    /// The flat one as a height field, which rises along y.
    fn field(self, cell: f64) -> (SharedShape, Isometry3<f64>) {
        let count = (4.0 / cell).round() as usize + 1;
        let size = 4.0 * self.metre;
        let heights = Array2::new(count, count, vec![0.0; count * count]);
        let stood = Isometry3::rotation(Vector3::new(std::f64::consts::FRAC_PI_2, 0.0, 0.0));
        (SharedShape::heightfield(heights, Vector::new(size, 1.0, size)), stood)
    }

    fn flat(self, cell: f64) -> SharedShape {
        self.terrain(cell, |_, _| 0.0)
    }

    fn block(self) -> SharedShape {
        let [a, b, c] = HALF.map(|half| half * self.metre);
        SharedShape::cuboid(a, b, c)
    }

    /// The distance that a box slides on the mesh, in metres, and what its end is off its way.
    fn slide(self, ground: (SharedShape, Isometry3<f64>), (yaw, h): (f64, f64), (mu, speed): (f64, f64)) -> (f64, f64) {
        let kernel = self.cuboid();
        let shapes = self.shapes_at(ground, self.block(), mu).reduce(Reduction::Quadrilateral);
        let place = Vector3::new(-0.613, -0.171, HALF[2]) * self.metre;
        let pose = Isometry3::new(place, Vector3::new(0.0, 0.0, yaw));
        // Along x, in the axes of the box.
        let along = Vector3::new(yaw.cos(), -yaw.sin(), 0.0) * speed * self.metre;
        let z = FreeState { pose_u: along, ..Default::default() }.z();
        let mut steps = ParrySteps::<_, 16, 48, _>::new(&kernel, shapes, (0.0, pose, z)).unwrap();
        let time = 1.1 * speed / (mu * G);
        for _ in 0..(time / h).ceil() as usize {
            steps.step(h, &()).unwrap();
        }
        let end = steps.configuration();
        let moved = (end.translation.vector - place) / self.metre;
        (moved.x, moved.y.abs().max(moved.z.abs()).max(end.rotation.angle_to(&pose.rotation)))
    }
}

/// Numbers from 0 to 1 that differ.
fn random(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x5851_f42d_4c95_7f2d;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let mut x = state ^ (state >> 33);
        x = x.wrapping_mul(0xff51_afd7_ed55_8ccd);
        (x >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Metres and kilograms, and other units of both.
const UNITS: [Units; 3] = [SI, Units { metre: 1e3, kilogram: 1e-3 }, Units { metre: 1e-3, kilogram: 1e3 }];

#[test]
fn a_box_slides_over_a_flat_mesh_in_every_direction() {
    let (mu, speed) = (0.3, 1.12);
    let check = |units: Units, ground: (SharedShape, Isometry3<f64>), (yaw, h): (f64, f64)| {
        let (way, off) = units.slide(ground, (yaw, h), (mu, speed));
        // v²/2μg, but for the step in which it stops: half of it with a speed up to μ g h. Rounding of places up to 1,
        // some tens in each of a few hundred steps.
        let (expected, stops) = (speed * speed / (2.0 * mu * G), mu * G * h * h / 8.0);
        assert!((way - expected).abs() <= stops + 1e-9 && off <= 1e-7, "{units:?} {yaw} {h}: {way} {off:e}");
    };
    let still = Isometry3::identity();
    (0..40).for_each(|k| check(SI, (SI.flat(0.25), still), (0.157 * f64::from(k), 5e-3)));
    for units in UNITS {
        for (k, cell, h) in [(3, 0.08, 1e-2), (11, 0.25, 2e-3), (17, 0.5, 1e-2), (29, 0.25, 1e-2)] {
            let yaw = 0.157 * f64::from(k);
            check(units, (units.flat(cell), still), (yaw, h));
            check(units, (units.soup(cell), still), (yaw, h));
            check(units, units.field(cell), (yaw, h));
        }
    }
}

#[test]
fn normals_lean_over_edges_of_the_surface_alone() {
    let kernel = SI.kernel([0.4 * RADIUS * RADIUS; 3]);
    // A roof with its ridge along y, and the flat square, whose outer edges are free.
    let roof = || SI.terrain(0.25, |i, _| -0.1 * f64::from((i - 8).abs()));
    let slope = 0.1_f64 / 0.25;
    let down = slope / slope.hypot(1.0);
    let normals = |ground: SharedShape, place: [f64; 3]| -> Vec<f64> {
        let pose = Isometry3::translation(place[0], place[1], place[2]);
        let mut shapes = SI.shapes(ground, SharedShape::ball(RADIUS), 0.5);
        let found = shapes.update(|frame| kernel.pose_of(frame, 0.0, &pose)).unwrap();
        found.iter().map(|found| found.slot.normal.x / found.slot.normal.norm()).collect()
    };
    let all_near =
        |found: &[f64], expected: f64| !found.is_empty() && found.iter().all(|x| (x - expected).abs() < 1e-9);
    // Over the ridge it may lean as far as each side does, and not over edges within a side.
    for x in [0.0, 0.02, -0.03] {
        let found = normals(roof(), [x, 0.1, 0.09]);
        assert!(all_near(&found, x / x.hypot(0.09)), "{x} {found:?}");
    }
    let found = normals(roof(), [0.13, 0.1, -0.13 * slope + 0.1]);
    assert!(all_near(&found, down), "{found:?}");
    // Past the end of the square it is the edge that touches.
    let found = normals(SI.flat(0.25), [2.05, 0.1, 0.08]);
    assert!(all_near(&found, 0.05_f64 / 0.05_f64.hypot(0.08)), "{found:?}");
    let found = normals(SI.flat(0.25), [0.24, 0.1, 0.09]);
    assert!(all_near(&found, 0.0), "{found:?}");
}

/// The ground in two kinds, with their shapes of a body.
fn grounds(units: Units, cell: f64, body: &SharedShape, mu: f64) -> [Shapes<FreeFrame>; 2] {
    let grounds = [units.flat(cell), SharedShape::halfspace(Vector::Z)];
    grounds.map(|ground| units.shapes(ground, body.clone(), mu).reduce(Reduction::Quadrilateral))
}

#[test]
fn balls_fall_on_a_flat_mesh_as_on_a_plane() {
    let check = |units: Units, seed: u64, (cell, h, speed): (f64, f64, f64)| {
        let kernel = units.kernel([0.4 * RADIUS * RADIUS; 3]);
        let mut r = random(seed);
        let place = Vector3::new(r() - 0.5, r() - 0.5, 0.3 + 0.3 * r()) * units.metre;
        let pose = Isometry3::new(place, Vector3::zeros());
        let z = FreeState {
            pose_u: Vector3::new(r() - 0.5, r() - 0.5, 0.0) * speed * units.metre,
            pose_omega: Vector3::new(r() - 0.5, r() - 0.5, 0.0) * speed / RADIUS,
            ..Default::default()
        };
        let begin = (0.0, pose, z.z());
        let start = |shapes| ParrySteps::<_, 8, 24, _>::new(&kernel, shapes, begin).unwrap();
        let [mut mesh, mut plane] = grounds(units, cell, &SharedShape::ball(RADIUS * units.metre), 0.4).map(start);
        for n in 0..(0.6 / h) as usize {
            mesh.step(h, &()).unwrap();
            plane.step(h, &()).unwrap();
            let apart = mesh.configuration().translation.vector - plane.configuration().translation.vector;
            // Rounding of places up to 1, some tens in each step.
            assert!(apart.amax() <= 1e-12 * units.metre, "{units:?} {seed} {cell} {h} {n}: {apart}");
        }
    };
    (0..100).for_each(|seed| check(SI, seed, (0.25, 1e-2, 0.0)));
    (0..50).for_each(|seed| check(SI, seed, (0.05, 1e-2, 1.0)));
    for units in UNITS {
        (0..4).for_each(|seed| check(units, seed, (0.25, 2e-3, 1.0)));
    }
}

#[test]
fn tossed_boxes_come_to_rest_on_a_flat_mesh() {
    let check = |units: Units, seed: u64, (cell, h): (f64, f64)| {
        let kernel = units.cuboid();
        let mut r = random(1000 + seed);
        let mut s = || 2.0 * r() - 1.0;
        let place = Vector3::new(0.3 * s(), 0.3 * s(), 0.5) * units.metre;
        let pose = Isometry3::new(place, Vector3::new(s(), s(), s()));
        let z = FreeState {
            pose_u: Vector3::new(s(), s(), s()) * units.metre,
            pose_omega: Vector3::new(s(), s(), s()) * 5.0,
            ..Default::default()
        };
        let [shapes, _] = grounds(units, cell, &units.block(), 0.5);
        // Steps of 10 ms go farther than the reach of 2 cm.
        let shapes = shapes.deepest(0.05 * units.metre);
        let mut steps = ParrySteps::<_, 16, 48, _>::new(&kernel, shapes, (0.0, pose, z.z())).unwrap();
        let weight = 2.0 * units.kilogram * G * units.metre;
        let mut energy = kernel.energy(0.0, steps.configuration(), steps.speeds());
        let first = energy;
        for n in 0..(3.0 / h) as usize {
            let made = steps.step(h, &());
            let report = made.unwrap_or_else(|error| panic!("{units:?} {seed} {h} {n}: {error}"));
            let now = kernel.energy(0.0, steps.configuration(), steps.speeds());
            // What is below zero is lifted; a step errs by the third power of its turn, which is below 20 rad/s.
            let allowed = 2.0 * weight * report.penetration + first * (20.0 * h).powi(3);
            assert!(now <= energy + allowed, "{units:?} {seed} {h} {n}: {now} {energy} {report:?}");
            energy = now;
        }
        let height = steps.configuration().translation.z / units.metre;
        let off = HALF.iter().map(|half| (height - half).abs()).fold(f64::INFINITY, f64::min);
        // On one of its faces, to rounding of a place of 1.
        assert!(off <= 1e-12 && steps.speeds().amax() <= 1e-6 * units.metre, "{units:?} {seed} {h}: {height}");
    };
    (0..24).for_each(|seed| check(SI, seed, (0.25, 1e-2)));
    for units in UNITS {
        check(units, 0, (0.25, 2e-3));
        check(units, 18, (0.08, 1e-2));
    }
}

/// Two boxes.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(p: Pose, q: Pose),
    body(lower, position = p.position, rotation = p.rotation, mass = 2, inertia = [0.022, 0.033, 0.042]),
    body(upper, position = q.position, rotation = q.rotation, mass = 2, inertia = [0.022, 0.033, 0.042]),
    frames(lower, upper),
)]
struct Stacked {
    #[gauss(gravity)]
    g: f64,
}

#[test]
fn a_box_falls_on_a_box() {
    let kernel = Stacked { g: G }.kernel().unwrap();
    let mut refused = Vec::new();
    for seed in 0..24 {
        let mut r = random(3000 + seed);
        let mut s = || 2.0 * r() - 1.0;
        let mut shapes = Shapes::new();
        shapes.add(None, SharedShape::halfspace(Vector::Z), Isometry3::identity(), surface(0.5, 0.0));
        for frame in [StackedFrame::lower, StackedFrame::upper] {
            shapes.add(Some(frame), SI.block(), Isometry3::identity(), surface(0.5, 0.0));
        }
        let shapes = shapes.reduce(Reduction::Quadrilateral).deepest(0.05);
        let upper = Isometry3::new(Vector3::new(0.1 * s(), 0.1 * s(), 0.5), Vector3::new(0.5 * s(), 0.5 * s(), s()));
        let lower = Isometry3::translation(0.0, 0.0, HALF[2]);
        let start = StackedState { p: lower, q: upper, ..Default::default() };
        let mut steps = ParrySteps::<_, 24, 72, _>::new(&kernel, shapes, (0.0, start.q(), start.z())).unwrap();
        for n in 0..150 {
            if let Err(error) = steps.step(1e-2, &()) {
                refused.push((seed, n, error.to_string()));
                break;
            }
        }
        let end = kernel.energy(0.0, steps.configuration(), steps.speeds());
        assert!(end < kernel.energy(0.0, &start.q(), &start.z()), "{seed} {end}");
    }
    assert!(refused.is_empty(), "{refused:#?}");
}

#[test]
fn capsules_do_not_jump_on_rough_ground() {
    for (seed, h) in (0..8).map(|seed| (seed, 2e-3)).chain((0..8).map(|seed| (seed, 1e-2))) {
        let kernel = SI.kernel([0.01, 0.02, 0.02]);
        let mut r = random(2000 + seed);
        let mut s = || 2.0 * r() - 1.0;
        let pose = Isometry3::new(Vector3::new(0.3 * s(), 0.3 * s(), 0.5), Vector3::new(s(), s(), s()));
        let z = FreeState { pose_u: Vector3::new(s(), s(), s()), ..Default::default() };
        let ground = SI.terrain(0.25, |i, j| 0.05 * f64::from(i * 7 + j * 13).sin());
        let shapes = SI.shapes(ground, SharedShape::capsule_x(0.2, 0.08), 0.5).reduce(Reduction::Quadrilateral);
        let shapes = shapes.most(32).deepest(0.05);
        let mut steps = ParrySteps::<_, 32, 96, _>::new(&kernel, shapes, (0.0, pose, z.z())).unwrap();
        let mut energy = kernel.energy(0.0, &pose, &z.z());
        let first = energy;
        for n in 0..(1.5 / h) as usize {
            let (before, fast) = (*steps.configuration(), steps.speeds().fixed_rows::<3>(0).norm());
            let made = steps.step(h, &());
            let report = made.unwrap_or_else(|error| panic!("{seed} {h} {n}: {error}"));
            let moved = (steps.configuration().translation.vector - before.translation.vector).norm();
            let way = h * fast.max(steps.speeds().fixed_rows::<3>(0).norm());
            // What is projected is of the order of the gaps: two planes at a time.
            assert!(moved <= way + 4.0 * report.closure + 1e-12, "{seed} {h} {n}: {moved} {way} {report:?}");
            let now = kernel.energy(0.0, steps.configuration(), steps.speeds());
            let allowed = 2.0 * 2.0 * G * report.closure + first * (20.0 * h).powi(3);
            assert!(now <= energy + allowed, "{seed} {h} {n}: {now} {energy} {report:?}");
            energy = now;
        }
    }
}
