//! The page in a browser, where there is one and WebAssembly can be made: it opens, and every scene gives the numbers
//! that the same kernel gives here.

use std::error::Error;
use std::fs;
use std::path::Path;
use std::process::Command;

use gauss_web::{build, page, scenes};

/// Pictures until the numbers are compared, at 60 a second.
const PICTURES: u32 = 30;

#[test]
fn scenes_move_in_the_browser_as_they_do_here() -> Result<(), Box<dyn Error>> {
    if !build::target_is_there() {
        println!("`rustup target add {}` installs the missing target: nothing was tried", build::TARGET);
        return Ok(());
    }
    // Seven scenes are expanded: a macro that is optimised costs more than it saves. Debug information would be the
    // page's.
    let quick = ["--config=profile.dev.package.gauss-codegen.opt-level=0", "--config=profile.dev.debug=false"];
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let file = folder.join("gauss.html");
    fs::write(&file, page::html(&build::kernels(&quick)?))?;

    let programs = ["chromium", "chromium-browser", "google-chrome"];
    let runs = |program: &&str| Command::new(program).arg("--version").output().is_ok_and(|out| out.status.success());
    let Some(browser) = programs.into_iter().find(runs) else {
        println!("there is no browser to open {} with", file.display());
        return Ok(());
    };
    for (n, scene) in scenes::ALL.iter().enumerate() {
        let mut motion = (scene.open)()?;
        for _ in 0..PICTURES {
            motion.advance(1.0 / 60.0, 1e-9)?;
        }
        let shown = numbers(browser, &format!("file://{}#scene={n}&t={}", file.display(), f64::from(PICTURES) / 60.0))?;
        let expected = motion.numbers();
        assert_eq!(shown.len(), expected.len(), "scene {n}");
        for (k, (shown, expected)) in shown.iter().zip(&expected).enumerate() {
            // The same operations in the same order; where the compiler chose fused ones, or functions of the system
            // are others, the last digits differ, and within half a second no scene makes them a million times larger.
            let apart = (shown - expected).abs() / expected.abs().max(1.0);
            assert!(apart < 1e-9, "scene {n}, number {k}: {shown} instead of {expected}");
        }
    }
    Ok(())
}

fn numbers(browser: &str, address: &str) -> Result<Vec<f64>, Box<dyn Error>> {
    let page = Command::new(browser)
        .args(["--headless", "--no-sandbox", "--no-first-run", "--disable-background-networking", "--disable-sync"])
        .args(["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"])
        .arg(format!("--user-data-dir={}", Path::new(env!("CARGO_TARGET_TMPDIR")).join("browser").display()))
        .args(["--virtual-time-budget=1000", "--dump-dom"])
        .arg(address)
        .output()?;
    let page = String::from_utf8(page.stdout)?;
    let of = |name: &str| page.split(&format!("data-{name}=\"")).nth(1).and_then(|rest| rest.split('"').next());
    assert_eq!(of("ready"), Some("yes"), "the scripts of {address} ran to their end");
    Ok(serde_json::from_str(of("numbers").unwrap_or_default())?)
}
