//! How often each face is up, and a page on which a die falls.

use std::error::Error;

use gauss_charts::drawing::{COLOURS, INK};
use gauss_contact::Mode;
use gauss_examples::plots::{Line, Plot, sheet};
use gauss_playback::{Playback, Shape, Touch};
use gauss_runtime::prelude::*;
use gauss_study::Draw;

use crate::die::{Die, DieKernel, Faces, path};

/// A panel for each kind of dice.
///
/// # Errors
/// When a panel cannot be laid out.
pub fn draw(found: &[(&str, Faces)]) -> Result<String, Box<dyn Error>> {
    let count = |faces: &Faces| faces.iter().sum::<usize>() as f64;
    let panels = found.iter().zip(COLOURS).map(|((name, faces), colour)| {
        let total = count(faces);
        let share = |face: usize| faces[face] as f64 / total;
        let cells = (0..6).map(|face| ([(face as f64 + 0.65, 0.0), (face as f64 + 1.35, share(face))], colour));
        // Two deviations of a binomial distribution.
        let wide = 2.0 * (5.0 / 36.0 / total).sqrt();
        let band = |name: &str, height: f64| {
            let line = Line::new(name, INK, [(0.5, height), (6.5, height)]).wide(2);
            if height == 1.0 / 6.0 { line } else { line.dashed() }
        };
        let lines =
            vec![band("1/6", 1.0 / 6.0), band("2 σ of so many throws", 1.0 / 6.0 + wide), band("", 1.0 / 6.0 - wide)];
        let title = if *name == "even" { "Even material" } else { "Center of mass 1.5 mm towards the one" };
        Plot::new(title, ("face that is up", 0.5..6.5), ("share of throws", 0.0..0.4), lines)
            .with_cells(cells.collect())
    });
    let title = format!("{} dropped dice", count(&found[0].1));
    sheet(&title, (1600, 700), &[panels.collect()])
}

/// One throw, with what the corners do.
///
/// # Errors
/// Where a step is one.
pub fn page(die: &Die, draw: &Draw) -> Result<Playback<DieKernel>, Box<dyn Error>> {
    let kernel = die.kernel()?;
    // A picture each two milliseconds.
    let steps: Vec<_> = path(&kernel, draw)?.into_iter().step_by(4).collect();
    let samples = steps.iter().map(|step| step.state).collect();
    let table = Shape::cuboid([0.6, 0.4, 0.01]).at(&Isometry3::translation(0.0, 0.0, -0.005)).colour("#4d7a5a");
    let mut page = Playback::of_samples("A die that is dropped", samples)
        .si()
        .body("die", |s| s.q, [Shape::cuboid([die.a; 3])])
        .body("table", |_| Isometry3::identity(), [table])
        .trace("die", [0.0; 3]);
    for (i, contact) in DieKernel::CONTACTS.iter().enumerate() {
        let shown = |s: &Sample<DieKernel>| {
            let step = steps.iter().find(|step| step.state.t == s.t);
            let mode = step.map_or(Mode::Open, |step| step.modes[i]);
            let touch = match mode {
                Mode::Open => Touch::Open,
                Mode::Closed => Touch::Closed,
                Mode::Sticks => Touch::Sticks,
                Mode::Slides(_) => Touch::Slides,
            };
            let rows: Vec<f64> = contact.rows().map(|row| step.map_or(0.0, |step| step.impulses[row]) / 5e-4).collect();
            let frame = kernel.contact_frame(i, s.t, &s.q);
            let zero = (touch, s.q.translation.vector, Vector3::zeros());
            frame.map_or(zero, |frame| (touch, frame.point, frame.force(&rows)))
        };
        page = page.contact(contact.name, 0.2, shown);
    }
    Ok(page.curve("height / m", "die", |s| s.q.translation.z).energy(&kernel))
}
