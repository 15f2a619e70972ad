//! A rattleback: spun one way it goes on, spun the other way it rattles, stops and turns back:
//! `cargo run --release --example rattleback`.

use gauss_examples::plots::write_page;
use gauss_playback::{Playback, Shape};
use gauss_runtime::monitor::monitor;
use gauss_runtime::prelude::*;

mod stone;

use stone::{AXES, PRODUCT, Rattleback, RattlebackKernel, pose, stone};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let rattleback = Rattleback { stone: stone(PRODUCT), a: AXES.into(), g: 9.81 }.kernel()?;

    // A hand does not set it down perfectly flat.
    let tilted = UnitQuaternion::from_euler_angles(0.009, 0.009, 0.0);
    let start = (tilted, SVector::from([0.0, 0.0]));
    let run =
        |spin| Simulation::new(&rattleback).adaptive(1e-10, 1e-12).run(start, Vector3::new(0.0, 0.0, spin), 0.0..5.0);
    let (against, along) = (run(5.0)?, run(-5.0)?);

    println!("   t/s  spun against, rad/s (long axis)  spun along, rad/s");
    let vertical = |sample: &Sample<RattlebackKernel>| (sample.q.0 * sample.z).z;
    for n in 0..=20 {
        let t = 0.25 * f64::from(n);
        let [first, second] = [&against, &along].map(|path| path.at(t).expect("inside the run"));
        // How far the long axis is from level.
        let rattling = (first.q.0 * Vector3::x()).z.asin().to_degrees();
        println!("{t:6.2} {:14.3} ({rattling:+5.1}°) {:25.3}", vertical(&first), vertical(&second));
    }

    let friction = |path: &Trajectory<RattlebackKernel>| {
        path.iter().map(|s| rattleback.multipliers(s.t, &s.q, &s.z, &()).norm()).fold(0.0, f64::max)
    };
    println!(
        "\nnot to slip it needs up to {:.1} N of friction, spun along {:.1} N, and weighs 9.8 N",
        friction(&against),
        friction(&along)
    );
    println!("{}", monitor(&rattleback, &against));
    // The constraints are the velocity of the point that touches: their multipliers are the friction there.
    let touching = |s: &Sample<RattlebackKernel>| {
        let pose = pose(&s.q);
        let up = pose.rotation.inverse() * Vector3::z();
        let squares = Vector3::from(AXES).component_mul(&Vector3::from(AXES));
        pose.translation.vector - pose.rotation * squares.component_mul(&up) / pose.translation.z
    };
    let grip = |s: &Sample<RattlebackKernel>| {
        let force = rattleback.multipliers(s.t, &s.q, &s.z, &());
        (touching(s), Vector3::new(force[0], force[1], 0.0))
    };
    let page = Playback::new("A rattleback, spun against its way", &against)?
        .body("stone", |s| pose(&s.q), [Shape::ellipsoid(AXES)])
        .trace("stone", [AXES[0], 0.0, 0.0])
        .arrow("friction", 0.015, grip)
        .curve("spin about the vertical / (rad/s)", "ω̂₃", vertical)
        .energy(&rattleback);
    write_page("rattleback", &page)
}
