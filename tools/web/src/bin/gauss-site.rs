//! Builds the site: `cargo run -p gauss-web --bin gauss-site [-- FOLDER]`, by default `target/site`. It needs mdBook
//! with KaTeX (`cargo install mdbook mdbook-katex`) and `rustup target add wasm32-unknown-unknown`. Studies are of 200
//! runs, or as many as `RUNS` says.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;
use std::{env, fs, io};

use gauss_web::{build, links, page, site};

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
/// Where the pages of rustdoc lead to as their front page.
const REFERENCE: &str = "<!doctype html>\n\
    <html lang=\"en\"><head><meta charset=\"utf-8\"><title>Gauss: reference</title>\n\
    <meta http-equiv=\"refresh\" content=\"0; url=gauss_runtime/index.html\"></head>\n\
    <body><a href=\"gauss_runtime/index.html\">gauss_runtime</a></body></html>\n";
/// Runs of studies that draw pictures, unless `RUNS` says how many: of the numbers that their texts name some examples
/// would take half an hour.
const RUNS: &str = "200";
/// The section of examples that write tables for a terminal, some of them for hours.
const NUMBERS: &str = "Numbers";

fn main() -> Result<(), Box<dyn Error>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize()?;
    let folder = env::args_os().nth(1).map_or_else(|| root.join("target/site"), PathBuf::from);
    fs::create_dir_all(&folder)?;
    let folder = folder.canonicalize()?;

    guide(&root, &folder)?;
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
    let shown = sections.iter().filter(|section| section.title != NUMBERS).flat_map(|section| &section.examples);
    play(&root, &folder, &shown.map(|example| example.name.as_str()).collect::<Vec<_>>())?;

    gauss_files::write(folder.join("index.html"), site::html(&sections, &folder)?)?;
    let faults = links::faults(&folder)?;
    if !faults.is_empty() {
        return Err(format!("the site is not whole:\n{}", faults.join("\n")).into());
    }
    println!("written: {}", folder.join("index.html").display());
    Ok(())
}

/// The pages and plots of examples, which are compiled together, on all cores, before the first one runs.
fn play(root: &Path, folder: &Path, examples: &[&str]) -> Result<(), Box<dyn Error>> {
    let target = |name| [if name == "gauss-first" { "--bin" } else { "--example" }, name];
    run(cargo(root).args(["build", "--quiet"]).args(examples.iter().flat_map(|name| target(name))))?;
    let runs = env::var("RUNS").unwrap_or_else(|_| RUNS.to_owned());
    for name in examples {
        let own = folder.join("examples").join(name);
        emptied(&own)?;
        let clock = Instant::now();
        run(cargo(root).env("RUNS", &runs).args(["run", "--quiet"]).args(target(name)).arg("--").arg(&own))?;
        narrow_plots(&own)?;
        println!("{name}: {:.0} s", clock.elapsed().as_secs_f64());
    }
    Ok(())
}

/// Fits plots of a folder into windows that are narrower than they are, as far as their axes can be read.
fn narrow_plots(folder: &Path) -> io::Result<()> {
    let entries = match fs::read_dir(folder) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
        entries => entries?,
    };
    for entry in entries {
        let file = entry?.path();
        if file.extension().is_some_and(|kind| kind == "svg") {
            let style = "<svg style=\"max-width: max(100%, 800px); height: auto\" ";
            gauss_files::write(&file, fs::read_to_string(&file)?.replacen("<svg ", style, 1))?;
        }
    }
    Ok(())
}

/// The guide, whose title leads to the front page.
fn guide(root: &Path, folder: &Path) -> Result<(), Box<dyn Error>> {
    let own = folder.join("guide");
    let mut book = Command::new("mdbook");
    run(book.arg("build").arg(root.join("guide")).arg("--dest-dir").arg(&own))
        .map_err(|error| format!("{error}; `cargo install mdbook mdbook-katex` installs what makes the guide"))?;
    let title = "<h1 class=\"menu-title\">Gauss</h1>";
    let home = "<h1 class=\"menu-title\"><a href=\"../index.html\" title=\"The front page\">Gauss</a></h1>";
    let mut pages = 0;
    for entry in fs::read_dir(&own)? {
        let file = entry?.path();
        if file.extension().is_some_and(|kind| kind == "html") {
            let page = fs::read_to_string(&file)?;
            pages += u32::from(page.contains(title));
            gauss_files::write(&file, page.replace(title, home))?;
        }
    }
    if pages == 0 {
        Err("pages of mdBook have no title any more that can lead to the front page".into())
    } else {
        Ok(())
    }
}

/// The pages of rustdoc.
fn reference(root: &Path, folder: &Path) -> Result<(), Box<dyn Error>> {
    let target = env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from);
    let (made, own) = (target.join("doc"), folder.join("reference"));
    // rustdoc leads to another crate where that one's folder is there, and Cargo takes a folder away while it is made
    // anew. So all are there beforehand, and one is made at a time; what they need is compiled before, by all cores.
    emptied(&made)?;
    for name in CRATES {
        fs::create_dir_all(made.join(format!("gauss_{name}")))?;
    }
    for command in [&["check"][..], &["doc", "--no-deps", "--jobs=1"]] {
        let crates = CRATES.iter().flat_map(|name| ["-p".to_owned(), format!("gauss-{name}")]);
        run(cargo(root).args(command).args(["--locked", "--features", FEATURES]).args(crates))?;
    }
    emptied(&own)?;
    copy(&made, &own)?;
    Ok(gauss_files::write(own.join("index.html"), REFERENCE)?)
}

/// Takes away what an earlier run has left in a folder.
fn emptied(folder: &Path) -> io::Result<()> {
    match fs::remove_dir_all(folder) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
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
