//! A sweep: eighty thousand double pendulums let go from rest, each run on until one of its arms goes over the top.
//! Steps and events of every run are its own, in vectors and on all threads. The picture is the map of those times.
//!
//! `cargo run --release --example flip_map [-- FOLDER]` draws it into `FOLDER`, by default `target/gauss`. `RUNS=50`: a
//! map of 50 by 50 states.

mod map;
mod picture;

use std::error::Error;
use std::time::Instant;

use gauss_examples::plots::write;
use gauss_examples::runs;
use indicatif::ProgressBar;

use map::{Map, TOLERANCE, flips};

/// Runs a second on some threads, of the same states.
fn throughput(states: &[[f64; 2]], threads: usize) -> Result<f64, Box<dyn Error>> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
    let begun = Instant::now();
    pool.install(|| flips(states, TOLERANCE, &ProgressBar::hidden()).map_err(|error| error.to_string()))?;
    Ok(states.len() as f64 / begun.elapsed().as_secs_f64())
}

fn main() -> Result<(), Box<dyn Error>> {
    let side = runs(400);
    let map = Map::run(side)?;
    map.check()?;

    let some: Vec<_> = (0..side * side / 2).step_by(7).map(|cell| Map::angles(side, cell)).collect();
    let all = std::thread::available_parallelism()?.get();
    let counts = (0..).map(|n| 1 << n).take_while(|&threads| threads < all).chain([all]);
    let mut one = None;
    for threads in counts {
        let rate = throughput(&some, threads)?;
        let gain = rate / *one.get_or_insert(rate);
        println!("{threads} threads: {rate:.0} runs a second, {gain:.2} times those of one");
    }
    write("flip_map", &picture::draw(&map)?)
}
