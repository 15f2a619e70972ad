//! A leg that hops, is pushed, and catches itself: contact in steps of a millisecond, with a controller between them;
//! and a page on which it hops in the browser and can be pushed.
//!
//! `cargo run --release --example pushed_leg [-- FOLDER]` writes the page into `FOLDER`, by default `target/gauss`. The
//! leg on it needs `rustup target add wasm32-unknown-unknown` once.

#[allow(dead_code, reason = "the page asks for more")]
mod leg;
mod page;
#[cfg(test)]
mod tests;

use std::error::Error;

use leg::{Leg, Push, WANTED};

fn main() -> Result<(), Box<dyn Error>> {
    println!("Wanted: {} m/s, hops of {} m. Pushed forward for 0.15 s each time:\n", WANTED.speed, WANTED.height);
    println!("  impulse, N s   speed after it, m/s   4 s later   highest, m   falls");
    let mut worst = [0.0_f64; 3];
    for force in [0.0, 20.0, -40.0, 60.0, 160.0] {
        let mut leg = Leg::new()?;
        leg.advance(4000, &WANTED, &Push::default())?;
        leg.advance(150, &WANTED, &Push { force: [force, 0.0], at: [0.0, 0.04] })?;
        let (pushed, mut highest) = (leg.rates()[0], 0.0_f64);
        for _ in 0..4000 {
            leg.advance(1, &WANTED, &Push::default())?;
            highest = highest.max(leg.coordinates()[1] - leg::HOPPER.l);
        }
        let after = leg.rates()[0];
        println!("  {:>12.1}   {pushed:>19.2}   {after:>9.2}   {highest:>10.3}   {:>5}", 0.15 * force, leg.falls);
        worst = std::array::from_fn(|k| worst[k].max(leg.worst[k]));
    }
    let [residual, deepest, below] = worst;
    println!("\nResiduals of the laws up to {residual:.0e} m/s; gaps down to {:.0e} m at the ends of steps,", -below);
    println!("{:.0e} m before they were closed.", -deepest);

    let module = if page::target_is_there() {
        page::module(!cfg!(debug_assertions))?
    } else {
        println!("`rustup target add wasm32-unknown-unknown` installs what the page is missing.");
        Vec::new()
    };
    let folder = gauss_files::output_folder_or_argument();
    let (file, page) = (folder.join("pushed_leg.html"), page::html(&module));
    gauss_files::write(&file, &page)?;
    println!("written: {} ({} kB)", file.display(), page.len() / 1000);
    Ok(())
}
