//! `cargo bench -p gauss-benches --bench robots --features robots,peers [-- S8 …]`: forward and inverse dynamics of
//! robots from their files, with the feature `robot-derivatives` also the derivatives of both, beside peers. Options as
//! those of `kernels`.

use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    gauss_benches::run::run(gauss_benches::robots::all()?, "robots.md")
}
