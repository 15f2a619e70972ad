//! One vehicle, four charts: the equations, what they cost, and how well they agree.
//!
//! `cargo run --release --example kirchhoff_vs_newton_euler [-- FOLDER]` writes its files into `FOLDER`, by default
//! `target/gauss`. With `--features png` the picture in pixels too.

use gauss_charts::measure::{Comparison, Fleet};
use gauss_charts::{figure, report, timing};

/// Length of the runs, s.
const DURATION: f64 = 30.0;
/// Batches of evaluations that are timed; each of the twelve functions takes about 10 µs for one.
const BATCHES: usize = 2000;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = gauss_files::output_folder_or_argument();

    let fleet = Fleet::published()?;
    println!("{}", report::introduction(&fleet)?);

    let comparison = Comparison::of(&fleet, DURATION)?;
    let timings = timing::time(&fleet, &comparison.reference, BATCHES)?;
    println!("{}", report::costs(&timings)?);
    println!("{}", report::results(&comparison)?);

    let svg = figure::svg(&comparison, &timings)?;
    let page = figure::page(&fleet.kirchhoff, &comparison).html()?;
    let files = [
        ("kirchhoff_vs_newton_euler.svg", svg.clone().into_bytes(), "the picture"),
        #[cfg(feature = "png")]
        ("kirchhoff_vs_newton_euler.png", gauss_charts::drawing::png(&svg)?, "the same in pixels"),
        ("kirchhoff_vs_newton_euler.html", page.into_bytes(), "the motion, as a page that plays"),
        (
            "equations.txt",
            report::all_equations(&fleet)?.into_bytes(),
            "all equations, as text and LaTeX, with their costs",
        ),
    ];
    println!("written:");
    for (name, contents, what) in files {
        let path = folder.join(name);
        gauss_files::write(&path, contents)?;
        println!("  {}   {what}", path.display());
    }
    Ok(())
}
