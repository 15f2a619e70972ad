//! Ten thousand dropped dice: a box on its eight corners, in steps of velocities and impulses; of a die of even
//! material, and of one whose center of mass is moved towards the one.
//!
//! `cargo run --release --example dice [-- FOLDER]` draws the picture into `FOLDER`, by default `target/gauss`.
//! `RUNS=200` before it: fewer dice.

mod die;
mod picture;

use std::error::Error;
use std::time::Instant;

use gauss_examples::plots::{write, write_page};
use gauss_examples::runs;
use gauss_study::Declaration;

use die::{Die, Faces, Throw, throw};

fn main() -> Result<(), Box<dyn Error>> {
    let count = runs(10_000);
    let dice = [("even", Die::even()), ("loaded", Die::loaded(1.5e-3))];
    // A throw is a function of its number alone.
    let numbers = Declaration::new("dice", 1, count as u64).sampler()?;
    let mut found = Vec::new();
    for (name, die) in &dice {
        let clock = Instant::now();
        let kernel = die.kernel()?;
        let throws = numbers.map(|sample| throw(&kernel, sample)).into_iter().collect::<Result<Vec<_>, _>>()?;
        let faces = faces(&throws);
        println!("{count} {name} dice in {:.1} s, {} steps:", clock.elapsed().as_secs_f64(), steps(&throws));
        println!("  faces 1 to 6: {faces:?}; χ² of even faces {:.2}, of 5 degrees of freedom", chi_square(&faces));
        let off = throws.iter().filter(|throw| throw.face.is_none()).count();
        println!("  {off} lie on no face, {} still move after 4 s", moving(&throws));
        println!("  residuals up to {:.0e} m/s, gaps down to {:.0e} m\n", residual(&throws), lowest(&throws));
        found.push((*name, faces));
    }
    write("dice", &picture::draw(&found)?)?;
    write_page("dice", &picture::page(&dice[0].1, &numbers.sample(7))?)
}

fn faces(throws: &[Throw]) -> Faces {
    let mut faces = [0; 6];
    throws.iter().filter_map(|throw| throw.face).for_each(|face| faces[face - 1] += 1);
    faces
}

fn moving(throws: &[Throw]) -> usize {
    throws.iter().filter(|throw| !throw.rests).count()
}

fn steps(throws: &[Throw]) -> usize {
    throws.iter().map(|throw| throw.steps).sum()
}

fn residual(throws: &[Throw]) -> f64 {
    throws.iter().map(|throw| throw.residual).fold(0.0, f64::max)
}

fn lowest(throws: &[Throw]) -> f64 {
    throws.iter().map(|throw| throw.lowest).fold(0.0, f64::min)
}

/// Σ (n − m)²/m of faces that are equally likely.
fn chi_square(faces: &Faces) -> f64 {
    let mean = faces.iter().sum::<usize>() as f64 / 6.0;
    faces.iter().map(|&n| (n as f64 - mean).powi(2) / mean).sum()
}
