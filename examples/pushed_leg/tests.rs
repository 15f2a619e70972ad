//! The claims of the example `pushed_leg`: it hops as it is told and catches itself, by the laws of contact; and the
//! page in a browser gives the numbers that the same steps give here.

use std::error::Error;
use std::fs;
use std::process::Command;

use crate::leg::{HOPPER, LIES, Leg, Push, STEP, WANTED, Wanted};
use crate::{leg, page};

const NONE: Push = Push { force: [0.0; 2], at: [0.0; 2] };

#[test]
fn it_hops_at_a_speed_and_catches_itself() -> Result<(), Box<dyn Error>> {
    let wanted = Wanted { speed: 0.0, ..WANTED };
    // At ten places of its hop: 0.9 m/s for the 9 kg.
    for phase in 0..10 {
        let mut leg = Leg::new()?;
        leg.advance(3000 + 50 * phase, &wanted, &NONE)?;
        leg.advance(150, &wanted, &Push { force: [54.0, 0.0], at: [0.0, 0.04] })?;
        leg.advance(6000, &wanted, &NONE)?;
        assert_eq!(leg.falls, 0, "phase {phase}");
        assert!(leg.rates()[0].abs() < 0.05, "phase {phase}: {} m/s", leg.rates()[0]);
        // Laws are solved until a solution is within 1e-12 of the largest rate, which is below 10 m/s, where that can
        // be; gaps at the ends of steps are rounded at the size of coordinates, metres, a few times.
        let [residual, _, below, _] = leg.worst;
        assert!(residual < 1e-11 && below < 1e-14, "phase {phase}: {residual} m/s, {below} m");
    }
    Ok(())
}

#[test]
fn slides_where_the_ground_is_smooth_and_is_set_up_again() -> Result<(), Box<dyn Error>> {
    let ice = Wanted { friction: 0.0, ..WANTED };
    let mut leg = Leg::new()?;
    leg.advance(2000, &ice, &Push { force: [-30.0, 0.0], at: [0.0, 0.08] })?;
    // Without friction nothing but the push acts along the ground: 60 N s for 9 kg. The leg, 1 kg of them, turns by
    // less than 10 rad/s about a hip that is 0.3 m away from its middle.
    let speed = leg.numbers()[6];
    assert!((speed + 60.0 / 9.0).abs() < 10.0 * 0.3 / 9.0 && leg.falls == 0, "{speed} m/s");
    let until = ((LIES + 3.0) / STEP) as u32;
    leg.advance(until, &ice, &NONE)?;
    assert!(leg.falls >= 1);
    Ok(())
}

#[test]
fn the_page_says_what_it_is_without_its_module() {
    let page = page::html(&[]);
    assert!(!page.contains("://"), "a page without network");
    assert!(page.contains("This browser has none of it") && page.matches("</script>").count() == 2);
    // Numbers that the script needs as well.
    let script = include_str!("../pushed_leg/live.js");
    assert!(script.contains(&format!("HALF = {}, RADIUS = {}", HOPPER.half, HOPPER.r)));
    assert!(STEP == 1e-3 && script.contains("STEP = 1e-3") && leg::PLACED == 3 && script.contains("[0, 1, 2].map"));
    assert!(page.contains(&format!("value=\"{}\"", WANTED.speed)), "sliders are at first where the program begins");
    assert!(page.contains(&format!("value=\"{}\"", WANTED.height)));
    assert!(page.contains(&format!("value=\"{}\"", WANTED.friction)));
}

#[test]
fn it_moves_in_the_browser_as_it_does_here() -> Result<(), Box<dyn Error>> {
    if !page::target_is_there() {
        println!("`rustup target add wasm32-unknown-unknown` installs the missing target: nothing was tried");
        return Ok(());
    }
    let folder = gauss_files::output_folder().join("tests");
    fs::create_dir_all(&folder)?;
    let file = folder.join("pushed_leg.html");
    fs::write(&file, page::html(&page::module(false)?))?;

    let programs = ["chromium", "chromium-browser", "google-chrome"];
    let runs = |program: &&str| Command::new(program).arg("--version").output().is_ok_and(|out| out.status.success());
    let Some(browser) = programs.into_iter().find(runs) else {
        println!("there is no browser to open {} with", file.display());
        return Ok(());
    };
    let page = Command::new(browser)
        .args(["--headless", "--no-sandbox", "--no-first-run", "--disable-background-networking", "--disable-sync"])
        .arg(format!("--user-data-dir={}", folder.join("pushed_leg_browser").display()))
        .args(["--virtual-time-budget=1000", "--dump-dom"])
        .arg(format!("file://{}#t=2&push=30", file.display()))
        .output()?;
    let page = String::from_utf8(page.stdout)?;
    let of = |name: &str| page.split(&format!("data-{name}=\"")).nth(1).and_then(|rest| rest.split('"').next());
    assert_eq!(of("ready"), Some("yes"), "the script ran to its end");
    let shown: Vec<f64> = serde_json::from_str(of("numbers").unwrap_or_default())?;

    let mut leg = Leg::new()?;
    for (steps, force) in [(1000, 0.0), (150, 30.0), (850, 0.0)] {
        leg.advance(steps, &WANTED, &Push { force: [force, 0.0], at: [0.0, 0.04] })?;
    }
    let expected = leg.numbers();
    assert_eq!(shown.len(), expected.len());
    for (k, (shown, expected)) in shown.iter().zip(&expected).enumerate() {
        // The same operations in the same order; functions of the system are others, in their last digit. A stance
        // hands a deviation on with a factor of tens at most, and there are three: 1e-16 × 1e4 × forces of 1e3 N.
        let apart = (shown - expected).abs() / expected.abs().max(1.0);
        assert!(apart < 1e-9, "number {k}: {shown} instead of {expected}");
    }
    Ok(())
}
