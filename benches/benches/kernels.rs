//! `cargo bench -p gauss-benches --bench kernels [-- S1 S4 …]`: accelerations of the scenes, generated, by hand, with
//! matrices.
//!
//! With `--features peers` beside what `benches/peers/install.sh` installed as well. Prints tables and leaves them in
//! `target/gauss/benchmarks.md`. Options: `--rounds 2000`, `--duration 0.0001` (seconds a measurement).

use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    gauss_benches::run::run(gauss_benches::cases::all()?, "benchmarks.md")
}
