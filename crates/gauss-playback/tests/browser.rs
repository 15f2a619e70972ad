//! The page in a browser, where there is one: it opens, draws, and its bodies are where the kernel says.

use std::error::Error;
use std::path::Path;
use std::process::Command;

use gauss_playback::{Playback, Shape, Touch};
use gauss_runtime::prelude::*;

/// A body that falls.
#[derive(GaussDynamics)]
#[gauss(chart = hybrid, motion = free)]
struct Stone {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: f64,
    #[gauss(gravity)]
    g: f64,
}

#[test]
fn the_page_shows_where_bodies_are() -> Result<(), Box<dyn Error>> {
    let stone = Stone { mass: 1.0, inertia: 0.1, g: 10.0 }.kernel()?;
    let start = Vector6::new(2.0, 0.0, 5.0, 0.0, 0.0, 3.0);
    let path = Simulation::new(&stone).adaptive(1e-10, 1e-10).run(Isometry3::identity(), start, 0.0..1.0)?;
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let file = folder.join("stone.html");
    Playback::with_pictures("A stone", &path, 101)?
        .body("stone", |s| stone.pose(s.t, &s.q), [Shape::ball(0.3)])
        .trace("stone", [0.3, 0.0, 0.0])
        .contact("ground", 0.1, |s| (Touch::Slides, Vector3::new(s.t, 0.0, 0.0), Vector3::z()))
        .energy(&stone)
        .write(&file)?;

    let programs = ["chromium", "chromium-browser", "google-chrome"];
    let runs = |program: &&str| Command::new(program).arg("--version").output().is_ok_and(|out| out.status.success());
    let Some(browser) = programs.into_iter().find(runs) else {
        // What the file holds is tested without a browser in `page.rs`.
        println!("there is no browser to open {} with", file.display());
        assert!(file.metadata()?.len() > 10_000);
        return Ok(());
    };
    let page = Command::new(browser)
        .args(["--headless", "--no-sandbox", "--no-first-run", "--disable-background-networking", "--disable-sync"])
        .args(["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"])
        .arg(format!("--user-data-dir={}", folder.join("browser").display()))
        .args(["--virtual-time-budget=2000", "--dump-dom"])
        .arg(format!("file://{}#t=0.5", file.display()))
        .output()?;
    let page = String::from_utf8(page.stdout)?;
    let of = |name: &str| page.split(&format!("data-{name}=\"")).nth(1).and_then(|rest| rest.split('"').next());
    assert_eq!(of("ready"), Some("yes"), "the scripts ran to their end");
    let [place]: [[f64; 3]; 1] = serde_json::from_str(of("bodies").unwrap_or_default())?;
    // By hand: 2 t, 0, 5 t − 5 t². Between floats of 24 bits.
    for (shown, expected) in place.into_iter().zip([1.0, 0.0, 1.25]) {
        assert!((shown - expected).abs() < 1e-6, "{shown} instead of {expected}");
    }
    Ok(())
}
