//! Writes the front page: `cargo run -p gauss-web [-- FILE]`.

use std::env;
use std::error::Error;
use std::path::PathBuf;

use gauss_web::{build, page};

fn main() -> Result<(), Box<dyn Error>> {
    let file = env::args_os().nth(1).map_or_else(|| gauss_files::output_folder().join("gauss.html"), PathBuf::from);
    let page = page::html(&build::kernels(&page::SMALL)?);
    gauss_files::write(&file, &page)?;
    println!("written: {} ({} kB)", file.display(), page.len() / 1000);
    Ok(())
}
