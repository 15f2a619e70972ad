//! The front page of the site: a card for each example, with what it has written, and no link into nothing.

use std::error::Error;
use std::fs;
use std::path::Path;

use gauss_runtime::prelude::*;
use gauss_web::links::faults;
use gauss_web::page::derived_struct;
use gauss_web::site::{Example, examples, html};

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

#[derive(GaussDynamics)]
#[gauss(coordinates(angle), gravity = g,
    particle(mass = m, position = [l * sin(angle), 0, -l * cos(angle)]))]
struct Pendulum {
    m: f64,
    l: f64,
    g: f64,
}

#[test]
fn examples_of_the_repository_are_read() -> Result<(), Box<dyn Error>> {
    let readme = fs::read_to_string(Path::new(ROOT).join("examples/README.md"))?;
    let sections = examples(&readme);
    let all: Vec<&Example> = sections.iter().flat_map(|section| &section.examples).collect();
    // Each row of its tables but their heads.
    let rows = readme.lines().filter(|line| line.starts_with('|') && line.contains('`')).count();
    assert_eq!(all.len(), rows);
    assert!(sections.len() >= 6 && sections.iter().all(|section| !section.examples.is_empty()), "{sections:?}");
    for example in &all {
        let picture = example.picture.iter().all(|file| Path::new(ROOT).join("examples").join(file).is_file());
        assert!(picture && !example.text.is_empty(), "{example:?}");
    }
    assert_eq!(all[0].name, "gauss-first");
    Ok(())
}

#[test]
fn cards_lead_to_what_examples_have_written() -> Result<(), Box<dyn Error>> {
    let files = ["examples/top/plot.svg", "examples/top/a_top.html", "examples/top/top.csv", "pictures/top.png"];
    let folder = tempfile("cards", &files.map(|file| (file, "")))?;
    let readme = "# Examples\n\n## Tops\n\n| | |\n|---|---|\n\
        | <img src=\"../docs/top.png\" width=\"300\" alt=\"\"> | `top`: one of `A < C` & [its plot](../docs/top.svg) |\n\
        | | `cargo run --release -p other`: writes nothing |\n";
    let page = html(&examples(readme), &folder)?;
    let gallery = page.split_once("<main>").expect("the gallery").1;
    for part in [
        "<h2>Tops</h2>",
        "<a href=\"examples/top/a_top.html\"><img src=\"pictures/top.png\" alt=\"\" loading=\"lazy\"></a><h3>top</h3>",
        "<p>one of <code>A &lt; C</code> &amp; its plot</p>",
        "<a href=\"examples/top/a_top.html\">▶ a top</a> <a href=\"examples/top/plot.svg\">plot: plot</a>",
        "<article><h3>other</h3><p>writes nothing</p>",
    ] {
        assert!(gallery.contains(part), "{part} is not in {gallery}");
    }
    gauss_files::write(folder.join("index.html"), page)?;
    let faults = faults(&folder)?;
    // What the guide, rustdoc and the live page are to bring; the example's page is empty here.
    assert!(faults.contains(&"index.html leads to guide/index.html".to_owned()), "{faults:?}");
    let of_top: Vec<&String> = faults.iter().filter(|fault| fault.contains("top")).collect();
    assert_eq!(of_top, ["examples/top/a_top.html has no title"]);
    Ok(())
}

#[test]
fn the_program_of_the_front_page_runs() -> Result<(), Box<dyn Error>> {
    let page = html(&[], Path::new("."))?;
    let shown = page.replace("&amp;", "&").replace("&lt;", "<").replace("&gt;", ">");
    assert!(shown.contains(derived_struct(include_str!("site.rs")).trim()), "{shown}");
    let kernel = Pendulum { m: 1.0, l: 0.5, g: 9.81 }.kernel()?;
    assert!(PendulumKernel::EQUATIONS.text.contains("angle"));
    let run =
        Simulation::new(&kernel).adaptive(1e-10, 1e-12).run(SVector::from([1.0]), SVector::from([0.0]), 0.0..10.0)?;
    // The energy at rest, −m g l cos 1: 1e-10 of it a step, in some hundred steps.
    let (end, start) = (run.last(), -9.81 * 0.5 * 1.0_f64.cos());
    let energy = 0.5 * (0.5 * end.z[0]).powi(2) - 9.81 * 0.5 * end.q[0].cos();
    assert!((energy - start).abs() < 1e-8 * start.abs(), "{energy}");
    Ok(())
}

#[test]
fn links_that_lead_nowhere_are_found() -> Result<(), Box<dyn Error>> {
    let head = "<!doctype html><title>A page</title>";
    let good = format!(
        "{head}<h1 id='top'>1 > 0</h1><a class=\"a > b\" href=\"sub/b.html#there\">b</a><a href='#top'>up</a>
        <a href=\"sub/\">folder</a>
        <a href=\"with%20space.svg?x=1&amp;y=2\">plot</a>
        <img alt=\"href='no'\" src=\"with space.svg\">
        <a href=\"https://example.org/nowhere.html\">elsewhere</a><!-- <a href=\"comment.html\"> -->
        <script>const link = '<a href=\"${{name}}\">';</script><pre>a &lt; b href=\"text.html\"</pre>"
    );
    let bad = format!(
        "{head}<a href=\"../none.html\">1</a><script src=\"gone.js\"></script><a href=\"../a.html#gone\">2</a>"
    );
    let files = [
        ("a.html", &*good),
        ("sub/b.html", "<title>B</title><p id=\"there\"><a href=\"../a.html\">a</a><a href=\"../../a.html\">out</a>"),
        ("sub/index.html", &*bad),
        ("with space.svg", ""),
        ("untitled.html", "<svg><path d=\"\"/></svg>"),
    ];
    let expected = [
        "sub/b.html leads to ../../a.html",
        "sub/index.html leads to ../a.html#gone",
        "sub/index.html leads to ../none.html",
        "sub/index.html leads to gone.js",
        "untitled.html has no title",
    ];
    assert_eq!(faults(&tempfile("links", &files)?)?, expected);
    Ok(())
}

/// A folder with files of these contents.
fn tempfile(name: &str, files: &[(&str, &str)]) -> Result<std::path::PathBuf, Box<dyn Error>> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("site").join(name);
    if folder.exists() {
        fs::remove_dir_all(&folder)?;
    }
    for (file, contents) in files {
        gauss_files::write(folder.join(file), contents)?;
    }
    Ok(folder)
}
