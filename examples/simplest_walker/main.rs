//! The simplest walker (M. Garcia, A. Chatterjee, A. Ruina & M. Coleman, *The simplest walking model: stability,
//! complexity, and scaling*, J. Biomechanical Engineering 120, 1998): its gaits by Newton's method with derivatives
//! through the heel strike, and the two numbers that tell whether it walks on.
//!
//! `cargo run --release --example simplest_walker [-- FOLDER]` draws the picture and the page that plays into `FOLDER`,
//! by default `target/gauss`.

mod model;
mod page;
mod picture;
#[cfg(test)]
mod tests;

use gauss_examples::plots::{write, write_page};
use gauss_runtime::prelude::*;

use model::{FOOT, Gait, LONG, SHORT, WalkerKernel};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("{}\n", WalkerKernel::<f64>::EQUATIONS);
    let tell = |name: &str, gait: &Gait| {
        let [angle, rate] = gait.start;
        println!("{name}: angle {angle:.14}, rate {rate:.14}");
        gait.multipliers().iter().for_each(|m| println!("    multiplier {:+.12} {:+.12} i", m.re, m.im));
    };
    println!("On a slope of 0.009, just after the heel strike:");
    let long = Gait::find(FOOT, 0.009, LONG)?;
    tell("  long gait", &long);
    tell("  short gait", &Gait::find(FOOT, 0.009, SHORT)?);
    println!(
        "  published, to 1e-10: angle 0.20031090049483, rate -0.19983247291764; the multipliers that stand beside them,"
    );
    println!(
        "  -0.19120868949940 ± 0.55633363687106 i, differ in the third digit: differences of whole steps have those above\n"
    );

    println!("Feet of some mass:");
    let mut gait = long;
    for foot in [1e-8, 1e-4, 1e-3, 1e-2] {
        gait = Gait::find(foot, 0.009, gait.start)?;
        tell(&format!("  {foot:e} of the hip"), &gait);
    }
    write("simplest_walker", &picture::draw(&long)?)?;
    write_page("simplest_walker", &page::page(&long, 6)?)
}
