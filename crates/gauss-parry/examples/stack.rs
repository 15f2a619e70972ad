//! Twenty boxes on one another: what a step costs, and whether they stay.
//!
//! `RUSTFLAGS="-C target-cpu=native" cargo run --release -p gauss-parry --example stack`. Printed are the median of
//! batches of 50 steps of 2 ms with the range of the middle half, how much of it the library took, the lowest gap after
//! a step and how far boxes move in the second half of two seconds.

use std::error::Error;
use std::thread;
use std::time::Instant;

use gauss_parry::parry3d_f64::math::Vector;
use gauss_parry::parry3d_f64::shape::SharedShape;
use gauss_parry::{ParrySteps, Reduction, Shapes, Surface};
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::frames::FrameName;
use gauss_runtime::prelude::*;

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

        fn places(state: &BoxesState) -> Vec<Vector3<f64>> {
            vec![$(state.$pose.translation.vector),*]
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

fn shapes() -> Shapes<BoxesFrame> {
    let wood = Surface { friction: 0.5, restitution: 0.0 };
    let mut shapes = Shapes::new();
    shapes.add(None, SharedShape::halfspace(Vector::Z), Isometry3::identity(), wood);
    for frame in BoxesFrame::ALL {
        let cube = SharedShape::cuboid(0.5 * EDGE, 0.5 * EDGE, 0.5 * EDGE);
        shapes.add(Some(*frame), cube, Isometry3::identity(), wood);
    }
    shapes.reduce(Reduction::Quadrilateral).most(4)
}

fn stand() -> Result<(), Box<dyn Error + Send + Sync>> {
    let kernel = Boxes { m: 1.0, a: EDGE, g: 9.81 }.kernel()?;
    // A little apart and turned, so that they land.
    let start = state(|i| {
        let turn = Vector3::new(0.0, 0.0, 0.02 * (i % 3) as f64);
        Isometry3::new(
            Vector3::new(0.004 * (i % 5) as f64, 0.003 * (i % 4) as f64, (i as f64 + 0.5) * 1.001 * EDGE),
            turn,
        )
    });
    let mut steps = ParrySteps::<_, 80, 240, _>::new(&kernel, shapes(), (0.0, start.q(), start.z()))?;
    let (mut times, mut lowest, mut halfway) = (Vec::new(), 0.0_f64, Vec::new());
    let (mut worst, mut corrections, mut parts) = (0.0_f64, 0, 0);
    for batch in 0..20 {
        if batch == 10 {
            halfway = places(&BoxesState::of(steps.configuration(), steps.speeds()));
        }
        let clock = Instant::now();
        for _ in 0..BATCH {
            let report = steps.step(STEP, &())?;
            worst = worst.max(report.residual.worst());
            corrections += report.corrections;
            parts += report.parts;
        }
        times.push(1e6 * clock.elapsed().as_secs_f64() / BATCH as f64);
        lowest = lowest.min(steps.slots().gaps(0.0, steps.configuration()).min());
    }
    let mut asked = shapes();
    let clock = Instant::now();
    for _ in 0..BATCH {
        asked.update(|frame| kernel.pose_of(frame, 0.0, steps.configuration()))?;
    }
    let library = 1e6 * clock.elapsed().as_secs_f64() / BATCH as f64;
    let end = places(&BoxesState::of(steps.configuration(), steps.speeds()));
    let creep = end.iter().zip(&halfway).map(|(a, b)| (a - b).amax()).fold(0.0, f64::max);
    times.sort_by(f64::total_cmp);
    println!(
        "{:.0} µs a step ({:.0} to {:.0}), {library:.0} of them the library's; {} points",
        times[10],
        times[5],
        times[15],
        steps.shapes().found().len()
    );
    println!("lowest gap {lowest:.0e} m, boxes move {creep:.0e} m in a second, speeds {:.0e}", steps.speeds().amax());
    println!("worst residual {worst:.0e} m/s, {} corrections a step, {parts} parts", f64::from(corrections) / 1000.0);
    Ok(())
}

fn main() -> Result<(), Box<dyn Error + Send + Sync>> {
    // Matrices of 240 rows are handed on by value.
    let thread = thread::Builder::new().stack_size(64 << 20).spawn(stand)?;
    match thread.join() {
        Ok(done) => done,
        Err(_) => Err("the thread ended".into()),
    }
}
