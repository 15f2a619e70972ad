//! Rows of four-bar linkages of any number, which pass positions where their constraints depend on one another.

use std::time::Instant;

use gauss_jit::{Interpreter, Model};
use gauss_runtime::prelude::*;

/// Four-bar linkages in a row (IFToMM benchmark A02): posts, then beams, each of 1 m and 1 kg.
fn four_bars(count: usize) -> String {
    let list = |of: &dyn Fn(usize) -> String, count: usize| (0..count).map(of).collect::<Vec<_>>().join(", ");
    let rod = "mass = 1, center_of_mass = [0.5, 0, 0], inertia_about_center_of_mass = [0, 1 / 12, 1 / 12]";
    let post = |i: usize| format!("body(p{i}, position = [{i}, 0, 0], rotation = rotation_z(a{i}), {rod})");
    let beam = |i: usize| {
        format!("body(c{i}, position = [{i} + cos(a{i}), sin(a{i}), 0], rotation = rotation_z(b{i}), {rod})")
    };
    let closed = |i: usize| {
        let n = i + 1;
        format!("constraint(position = [cos(a{i}) + cos(b{i}) - 1 - cos(a{n}), sin(a{i}) + sin(b{i}) - sin(a{n}), 0])")
    };
    format!(
        "#[gauss(coordinates({}, {}), {}, {}, {}, gravity = [0, -9.81, 0])] struct Row {{}}",
        list(&|i| format!("a{i}"), count + 1),
        list(&|i| format!("b{i}"), count),
        list(&post, count + 1),
        list(&beam, count),
        list(&closed, count)
    )
}

/// A row of N rods from upright, with 1 m/s at the top of its first post: ten seconds hold nine passages of the place
/// where its constraints depend on one another.
fn passes_singular_places<const N: usize>(tolerance: f64) {
    let start = Instant::now();
    let model = Model::from_source(&four_bars(N / 2)).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let derived = start.elapsed();
    let loaded = model.with_backend(Interpreter).kernel(&[]).expect("numbers");
    let system = loaded.constrained_system::<N, N, ()>().expect("room");
    let of_posts = |post: f64| SVector::<f64, N>::from_fn(|i, _| if 2 * i <= N { post } else { 0.0 });
    let (upright, z) = (system.configuration(of_posts(std::f64::consts::FRAC_PI_2).as_slice()), of_posts(-1.0));
    let start = Instant::now();
    let run = Simulation::new(&system).adaptive(tolerance, tolerance).run(upright, z, 0.0..10.0).expect("a run");
    let (run_time, steps, last) = (start.elapsed(), run.summary().steps, run.last());
    let lost = system.energy(0.0, &upright, &z) - system.energy(last.t, &last.q, &last.z);
    println!(
        "{} four-bars at {tolerance:e}: derived in {derived:.1?}, {steps} steps in {run_time:.1?}, {lost:.1e} J",
        N / 2
    );
    // In each step a component of the state is off by the root of their number of tolerances, and the projection moves
    // it by ten times that at most. The energy changes with it by a momentum, 0.7 m of each rod at 5 m/s at most, and
    // by a weight of 9.81 N at 1 m.
    let off = 11.0 * (2.0 * N as f64).sqrt() * tolerance * steps as f64;
    assert!(lost.abs() <= off * N as f64 * (0.7 * 5.0 + 9.81), "{N} {tolerance:e}: {lost:e} J in {steps} steps");
    // On the branch by which it came posts stay parallel, and beams level.
    let angles = last.q.as_slice();
    assert!((0..N).all(|i| (angles[i] - if 2 * i <= N { angles[0] } else { 0.0 }).abs() <= off), "{N} {tolerance:e}");
}

#[test]
fn forty_four_bars_pass_singular_places() {
    passes_singular_places::<5>(1e-6);
    passes_singular_places::<21>(1e-6);
    passes_singular_places::<81>(1e-6);
}
