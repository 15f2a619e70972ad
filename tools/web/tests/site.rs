//! The front page of the site: a card for each example, with what it has written, and no link into nothing.

use std::error::Error;
use std::fs;
use std::path::Path;

use gauss_runtime::prelude::*;
use gauss_web::page::derived_struct;
use gauss_web::site::{Example, broken_links, examples, html};

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
    let folder =
        tempfile(&["examples/top/plot.svg", "examples/top/a_top.html", "examples/top/top.csv", "pictures/top.png"])?;
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
    let broken = broken_links(&page, &folder);
    // What the guide, rustdoc and the live page are to bring.
    assert!(
        broken.contains(&"guide/index.html".to_owned()) && broken.iter().all(|link| !link.contains("top")),
        "{broken:?}"
    );
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

/// A folder with empty files.
fn tempfile(files: &[&str]) -> Result<std::path::PathBuf, Box<dyn Error>> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("site");
    if folder.exists() {
        fs::remove_dir_all(&folder)?;
    }
    for file in files {
        gauss_files::write(folder.join(file), "")?;
    }
    Ok(folder)
}
