//! Twenty boxes on one another, in steps of 2 ms: `gauss-parry` and rapier3d in one run, by turns.
//!
//! `RUSTFLAGS="-C target-cpu=native" cargo run --release --manifest-path benches/rapier/Cargo.toml`. Both have the same
//! shapes, masses, friction and start, a little apart and turned, in double precision, on one thread, and no box goes
//! to sleep. Of each is printed the median time of batches of 50 steps with the range of the middle half; the deepest
//! overlap of neighbours after a step, by one and the same function; and how far boxes move in the last second of two.
//! rapier has its default parameters, then 20 iterations of its solver.

use std::error::Error;
use std::thread;
use std::time::Instant;

use gauss_parry::parry3d_f64::math::{Pose, Rotation, Vector};
use gauss_parry::parry3d_f64::query;
use gauss_parry::parry3d_f64::shape::{Cuboid, SharedShape};
use gauss_parry::{ParrySteps, Reduction, Shapes, Surface};
use gauss_runtime::frames::FrameName;
use gauss_runtime::prelude::*;
use rapier3d_f64::prelude::{ColliderBuilder, PhysicsWorld, RigidBodyBuilder, RigidBodyHandle};

type Failure = Box<dyn Error + Send + Sync>;

macro_rules! boxes {
    ($($name:ident $pose:ident)*) => {
        /// Cubes, each free.
        #[derive(GaussDynamics)]
        #[gauss(
            coordinates($($pose: Pose),*),
            $(body($name, position = $pose.position, rotation = $pose.rotation, mass = m, inertia = m * a * a / 6),)*
            frames($($name),*),
        )]
        struct Boxes {
            m: f64,
            a: f64,
            #[gauss(gravity)]
            g: f64,
        }

        fn state(place: impl Fn(usize) -> Isometry3<f64>) -> BoxesState {
            let mut places = (0..).map(place);
            $(let $pose = places.next().unwrap_or_default();)*
            BoxesState { $($pose,)* ..Default::default() }
        }

        fn places(state: &BoxesState) -> Vec<Isometry3<f64>> {
            vec![$(state.$pose),*]
        }
    };
}

boxes! {
    b0 p0 b1 p1 b2 p2 b3 p3 b4 p4 b5 p5 b6 p6 b7 p7 b8 p8 b9 p9 b10 p10 b11 p11 b12 p12 b13 p13 b14 p14 b15 p15
    b16 p16 b17 p17 b18 p18 b19 p19
}

const EDGE: f64 = 0.2;
const STEP: f64 = 2e-3;
const BATCH: usize = 50;
const BATCHES: usize = 20;

const FRICTION: f64 = 0.5;
const COUNT: usize = 20;

/// A little apart and turned, so that they land.
fn place(i: usize) -> Isometry3<f64> {
    let at = Vector3::new(0.004 * (i % 5) as f64, 0.003 * (i % 4) as f64, (i as f64 + 0.5) * 1.001 * EDGE);
    Isometry3::new(at, Vector3::new(0.0, 0.0, 0.02 * (i % 3) as f64))
}

fn pose(place: &Isometry3<f64>) -> Pose {
    let (b, r) = (&place.translation.vector, &place.rotation.coords);
    Pose::from_parts(Vector::new(b.x, b.y, b.z), Rotation::from_xyzw(r.x, r.y, r.z, r.w))
}

/// What makes steps.
trait Steps {
    fn step(&mut self) -> Result<(), Failure>;
    fn poses(&self) -> Vec<Pose>;
}

struct Ours<'k>(ParrySteps<'k, BoxesKernel, 80, 240, 120>);

impl Steps for Ours<'_> {
    fn step(&mut self) -> Result<(), Failure> {
        self.0.step(STEP, &())?;
        Ok(())
    }

    fn poses(&self) -> Vec<Pose> {
        places(&BoxesState::of(self.0.configuration(), self.0.speeds())).iter().map(pose).collect()
    }
}

fn ours(kernel: &BoxesKernel) -> Result<Ours<'_>, Failure> {
    let wood = Surface { friction: FRICTION, restitution: 0.0 };
    let mut shapes = Shapes::new();
    shapes.add(None, SharedShape::halfspace(Vector::Z), Isometry3::identity(), wood);
    for frame in BoxesFrame::ALL {
        let cube = SharedShape::cuboid(0.5 * EDGE, 0.5 * EDGE, 0.5 * EDGE);
        shapes.add(Some(*frame), cube, Isometry3::identity(), wood);
    }
    let start = state(place);
    let shapes = shapes.reduce(Reduction::Quadrilateral).most(4);
    Ok(Ours(ParrySteps::new(kernel, shapes, (0.0, start.q(), start.z()))?))
}

struct Theirs(PhysicsWorld, Vec<RigidBodyHandle>);

impl Steps for Theirs {
    fn step(&mut self) -> Result<(), Failure> {
        self.0.step();
        Ok(())
    }

    fn poses(&self) -> Vec<Pose> {
        self.1.iter().map(|body| *self.0.bodies[*body].position()).collect()
    }
}

fn theirs(iterations: Option<usize>) -> Theirs {
    let mut world = PhysicsWorld::new();
    world.gravity = Vector::Z * -9.81;
    world.integration_parameters.dt = STEP;
    if let Some(iterations) = iterations {
        world.integration_parameters.num_solver_iterations = iterations;
    }
    world.insert_collider(ColliderBuilder::new(SharedShape::halfspace(Vector::Z)).friction(FRICTION), None);
    let body = |i: usize| {
        let cube = ColliderBuilder::cuboid(0.5 * EDGE, 0.5 * EDGE, 0.5 * EDGE);
        let body = RigidBodyBuilder::dynamic().pose(pose(&place(i))).can_sleep(false);
        world.insert(body, cube.friction(FRICTION).mass(1.0)).0
    };
    let bodies = (0..COUNT).map(body).collect();
    Theirs(world, bodies)
}

/// How far neighbours overlap.
fn overlap(poses: &[Pose]) -> f64 {
    let cube = Cuboid::new(Vector::splat(0.5 * EDGE));
    let corner = |pose: &Pose, k: usize| {
        let side = |bit: usize| if k >> bit & 1 == 0 { -0.5 * EDGE } else { 0.5 * EDGE };
        (*pose * Vector::new(side(0), side(1), side(2))).z
    };
    let ground = (0..8).map(|k| -corner(&poses[0], k)).fold(0.0, f64::max);
    let of_pair = |pair: &[Pose]| {
        let found = query::contact(&pair[0], &cube, &pair[1], &cube, 0.01);
        found.ok().flatten().map_or(0.0, |contact| -contact.dist)
    };
    poses.windows(2).map(of_pair).fold(ground, f64::max)
}

/// What is measured of one.
struct Measured<'a> {
    name: &'a str,
    steps: Box<dyn Steps + 'a>,
    times: Vec<f64>,
    overlap: f64,
    halfway: Vec<Pose>,
}

impl<'a> Measured<'a> {
    fn new(name: &'a str, steps: impl Steps + 'a) -> Self {
        Self { name, steps: Box::new(steps), times: Vec::new(), overlap: 0.0, halfway: Vec::new() }
    }

    fn batch(&mut self, number: usize) -> Result<(), Failure> {
        if number == BATCHES / 2 {
            self.halfway = self.steps.poses();
        }
        let clock = Instant::now();
        for _ in 0..BATCH {
            self.steps.step()?;
        }
        self.times.push(1e6 * clock.elapsed().as_secs_f64() / BATCH as f64);
        if number >= BATCHES / 2 {
            self.overlap = self.overlap.max(overlap(&self.steps.poses()));
        }
        Ok(())
    }

    fn report(mut self) {
        let end = self.steps.poses();
        let way = |(a, b): (&Pose, &Pose)| (a.translation - b.translation).length();
        let creep = end.iter().zip(&self.halfway).map(way).fold(0.0, f64::max);
        self.times.sort_by(f64::total_cmp);
        let [lower, median, upper] = [1, 2, 3].map(|k| self.times[k * BATCHES / 4]);
        println!(
            "{}: {median:.0} µs a step ({lower:.0} to {upper:.0}); overlap {:.0e} m, moves {creep:.0e} m in a second",
            self.name, self.overlap
        );
    }
}

fn compare() -> Result<(), Failure> {
    let kernel = Boxes { m: 1.0, a: EDGE, g: 9.81 }.kernel()?;
    let mut all = [
        Measured::new("gauss-parry", ours(&kernel)?),
        Measured::new("rapier3d-f64", theirs(None)),
        Measured::new("rapier3d-f64, 20 iterations", theirs(Some(20))),
    ];
    for number in 0..BATCHES {
        for measured in &mut all {
            measured.batch(number)?;
        }
    }
    all.into_iter().for_each(Measured::report);
    Ok(())
}

fn main() -> Result<(), Failure> {
    // Matrices of 240 rows are handed on by value.
    let thread = thread::Builder::new().stack_size(64 << 20).spawn(compare)?;
    match thread.join() {
        Ok(done) => done,
        Err(_) => Err("the thread ended".into()),
    }
}
