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

    let Some(browser) = browser() else {
        // What the file holds is tested without a browser in `page.rs`.
        println!("there is no browser to open {} with", file.display());
        assert!(file.metadata()?.len() > 10_000);
        return Ok(());
    };
    let page = opened(browser, folder, &format!("file://{}#t=0.5", file.display()))?;
    let of = |name: &str| value(&page, name);
    assert_eq!(of("ready"), Some("yes"), "the scripts ran to their end");
    let [place]: [[f64; 3]; 1] = serde_json::from_str(of("bodies").unwrap_or_default())?;
    // By hand: 2 t, 0, 5 t − 5 t². Between floats of 24 bits.
    for (shown, expected) in place.into_iter().zip([1.0, 0.0, 1.25]) {
        assert!((shown - expected).abs() < 1e-6, "{shown} instead of {expected}");
    }

    // The eye is moved so that the motion touches two opposite edges of the picture, less 8 % of the distance: of a
    // point in front of the middle that takes more than 8 % of its place.
    let sides: [[f64; 2]; 2] = serde_json::from_str(of("filled").unwrap_or_default())?;
    assert!(sides.iter().all(|[low, high]| *low > -1.0 && *high < 1.0), "all of it is in the picture: {sides:?}");
    assert!(sides.iter().any(|[low, high]| *low < -0.8 && *high > 0.8), "the picture is full: {sides:?}");
    Ok(())
}

/// On the screen of a telephone titles of panels take more lines, and the curves begin below them.
#[test]
fn titles_cover_no_curve_on_a_narrow_screen() -> Result<(), Box<dyn Error>> {
    let stone = Stone { mass: 1.0, inertia: 0.1, g: 10.0 }.kernel()?;
    let path = Simulation::new(&stone).adaptive(1e-10, 1e-10).run(Isometry3::identity(), Vector6::zeros(), 0.0..1.0)?;
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let title = "a quantity whose name is longer than the screen of a telephone is wide / (kg m²/s²)";
    let page = Playback::with_pictures("A stone", &path, 11)?
        .body("stone", |s| stone.pose(s.t, &s.q), [Shape::ball(0.3)])
        .curve(title, "of one stone and of another one", |s| s.t)
        .curve(title, "of both of them together", |s| 2.0 * s.t);
    page.write(folder.join("narrow.html"))?;
    let Some(browser) = browser() else { return Ok(()) };
    // Windows are wider than 390 pixels; a frame in a page is not.
    let frame = r#"<body><iframe src="narrow.html" style="width:390px;height:800px;border:0"></iframe><script>
        onload = () => {
            const boxes = (name) => frames[0].document.querySelector(".panel " + name).getBoundingClientRect();
            document.body.dataset.places = JSON.stringify([boxes("div").height, boxes("div").bottom, boxes("canvas").top]);
        };
        </script></body>"#;
    gauss_files::write(folder.join("frame.html"), frame)?;
    let page = opened(browser, folder, &format!("file://{}", folder.join("frame.html").display()))?;
    let [height, bottom, top]: [f64; 3] = serde_json::from_str(value(&page, "places").unwrap_or_default())?;
    assert!(height > 30.0, "the title takes several lines of 17 pixels: {height}");
    assert!(bottom <= top, "{bottom} {top}");
    Ok(())
}

fn browser() -> Option<&'static str> {
    let runs = |program: &&str| Command::new(program).arg("--version").output().is_ok_and(|out| out.status.success());
    ["chromium", "chromium-browser", "google-chrome"].into_iter().find(runs)
}

/// The page as the browser has it when its scripts have run.
fn opened(browser: &str, folder: &Path, address: &str) -> Result<String, Box<dyn Error>> {
    // Two browsers must not share a folder.
    let name: String = address.chars().filter(char::is_ascii_alphanumeric).collect();
    let page = Command::new(browser)
        .args(["--headless", "--no-sandbox", "--no-first-run", "--disable-background-networking", "--disable-sync"])
        .args(["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"])
        .arg("--allow-file-access-from-files")
        .arg(format!(
            "--user-data-dir={}",
            folder.join("browsers").join(&name[name.len().saturating_sub(40)..]).display()
        ))
        .args(["--virtual-time-budget=2000", "--dump-dom"])
        .arg(address)
        .output()?;
    Ok(String::from_utf8(page.stdout)?)
}

/// What the page has left in an attribute of its body.
fn value<'p>(page: &'p str, name: &str) -> Option<&'p str> {
    page.split(&format!("data-{name}=\"")).nth(1).and_then(|rest| rest.split('"').next())
}
