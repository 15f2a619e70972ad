//! Builds the site: `cargo run -p gauss-web --bin gauss-site [-- FOLDER]`, by default `target/site`. It needs mdBook
//! with KaTeX (`cargo install mdbook mdbook-katex`) and `rustup target add wasm32-unknown-unknown`.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs, io};

use gauss_web::{build, page, site};

/// Crates whose reference is on the site.
const CRATES: &[&str] = &[
    "runtime",
    "derive",
    "adapters",
    "batch",
    "contact",
    "exact",
    "fmu",
    "jit",
    "parry",
    "playback",
    "sensitivity",
    "study",
    "tables",
];
/// Features that their pages are shown with.
const FEATURES: &str = "gauss-runtime/wide,gauss-runtime/serde,gauss-runtime/urdf,gauss-runtime/mjcf,gauss-runtime/modes,\
    gauss-batch/rayon,gauss-playback/contact,gauss-adapters/num-dual,gauss-adapters/ode_solvers,\
    gauss-adapters/differential-equations,gauss-adapters/mint";
/// The section of examples that write tables for a terminal, some of them for hours.
const NUMBERS: &str = "Numbers";

fn main() -> Result<(), Box<dyn Error>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize()?;
    let folder = env::args_os().nth(1).map_or_else(|| root.join("target/site"), PathBuf::from);
    fs::create_dir_all(&folder)?;
    let folder = folder.canonicalize()?;

    let mut book = Command::new("mdbook");
    run(book.arg("build").arg(root.join("guide")).arg("--dest-dir").arg(folder.join("guide")))
        .map_err(|error| format!("{error}; `cargo install mdbook mdbook-katex` installs what makes the guide"))?;
    reference(&root, &folder)?;
    gauss_files::write(folder.join("live.html"), page::html(&build::kernels(&page::SMALL)?))?;

    let sections = site::examples(&fs::read_to_string(root.join("examples/README.md"))?);
    for example in sections.iter().flat_map(|section| &section.examples) {
        if let Some(picture) = &example.picture {
            let from = root.join("examples").join(picture);
            let name = from.file_name().ok_or_else(|| format!("`{picture}` is no file"))?;
            gauss_files::write(folder.join("pictures").join(name), fs::read(&from)?)?;
        }
    }
    gauss_files::write(folder.join("pictures/browser.png"), fs::read(root.join("docs/browser.png"))?)?;
    for section in sections.iter().filter(|section| section.title != NUMBERS) {
        for example in &section.examples {
            let own = folder.join("examples").join(&example.name);
            let kind = if example.name == "gauss-first" { "--bin" } else { "--example" };
            run(cargo(&root).args(["run", "--quiet", kind, &example.name, "--"]).arg(own))?;
        }
    }

    let front = site::html(&sections, &folder)?;
    let broken = site::broken_links(&front, &folder);
    if !broken.is_empty() {
        return Err(format!("the front page leads to what is not there: {}", broken.join(", ")).into());
    }
    gauss_files::write(folder.join("index.html"), front)?;
    println!("written: {}", folder.join("index.html").display());
    Ok(())
}

/// The pages of rustdoc.
fn reference(root: &Path, folder: &Path) -> Result<(), Box<dyn Error>> {
    let crates = CRATES.iter().flat_map(|name| ["-p".to_owned(), format!("gauss-{name}")]);
    run(cargo(root).args(["doc", "--locked", "--no-deps", "--features", FEATURES]).args(crates))?;
    let target = env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from);
    Ok(copy(&target.join("doc"), &folder.join("reference"))?)
}

fn cargo(root: &Path) -> Command {
    let mut cargo = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo.current_dir(root);
    cargo
}

fn run(command: &mut Command) -> Result<(), Box<dyn Error>> {
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("{command:?} ended with {status}").into()),
        Err(error) => Err(format!("{command:?}: {error}").into()),
    }
}

/// Copies a folder with all that is in it.
fn copy(from: &Path, to: &Path) -> io::Result<()> {
    fs::create_dir_all(to)?;
    for entry in fs::read_dir(from)? {
        let entry = entry?;
        let place = to.join(entry.file_name());
        if entry.file_type()?.is_dir() {
            copy(&entry.path(), &place)?
        } else {
            fs::copy(entry.path(), place).map(drop)?
        }
    }
    Ok(())
}
