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
    // In each step the mean square of the errors, in units of their tolerances, is at most 1, and the projection, which
    // is orthogonal in the kinetic energy, adds no more than that: the energy changes by twice the root of their number
    // times that of the squares of what a tolerance of each number is worth.
    let worth = run.iter().map(|state| {
        let speeds = (0..N).map(|i| state.p[i] * (1.0 + state.z[i].abs()));
        let turned = |i: usize, by: f64| {
            let angles: Vec<f64> = (0..N).map(|k| state.q.as_slice()[k] + if k == i { by } else { 0.0 }).collect();
            system.energy(0.0, &system.configuration(&angles), &state.z)
        };
        let angles = (0..N).map(|i| (turned(i, 1e-5) - turned(i, -1e-5)) / 2e-5 * (1.0 + state.q.as_slice()[i].abs()));
        tolerance * speeds.chain(angles).map(|part| part * part).sum::<f64>().sqrt()
    });
    let most = 2.0 * (2.0 * N as f64).sqrt() * worth.sum::<f64>();
    assert!(lost.abs() <= most, "{N} {tolerance:e}: {lost:e} J of {most:e} in {steps} steps");
    // On the branch by which it came posts stay parallel, and beams level. A loop is closed up to the rounding of eight
    // terms of at most 2, which turns a post by that over the sine of its angle, the more the longer the row.
    let angles = last.q.as_slice();
    let rounding = 16.0 * f64::EPSILON * N as f64 / angles[0].sin().abs();
    let off = (0..N).map(|i| (angles[i] - if 2 * i <= N { angles[0] } else { 0.0 }).abs()).fold(0.0, f64::max);
    println!("energy {:.1e} of {most:.1e} J, angles {off:.1e} of {rounding:.1e} rad", lost.abs());
    assert!(off <= rounding, "{N} {tolerance:e}: {off:e} rad of {rounding:e}");
}

#[test]
fn forty_four_bars_pass_singular_places() {
    passes_singular_places::<5>(1e-6);
    passes_singular_places::<21>(1e-6);
    passes_singular_places::<81>(1e-6);
}
