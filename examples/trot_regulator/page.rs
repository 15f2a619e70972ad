//! The run with gains as a page, with what the feet do.

use std::error::Error;

use gauss_contact::Mode;
use gauss_playback::{Playback, Shape, Touch};
use gauss_runtime::prelude::*;

use crate::gait::{PUSHED, Pushed};
use crate::robot::{Kernel, STEP};

/// A picture each so many steps.
const EACH: usize = 5;

/// The skeleton of ANYmal after a push, m/s, and forces at its feet.
///
/// # Errors
/// Where a contact has no place.
pub fn page(kernel: &Kernel, run: &Pushed, push: f64) -> Result<Playback<Kernel>, Box<dyn Error>> {
    let sample = |(n, (q, z)): (usize, &_)| {
        let t = n as f64 * STEP;
        Sample { t, q: *q, z: *z, p: kernel.momentum(t, q, z) }
    };
    let samples = run.states.iter().enumerate().step_by(EACH).map(sample).collect();
    // The step that ends at a time.
    let step = |s: &Sample<Kernel>| ((s.t / STEP).round() as usize).clamp(1, run.feet.len()) - 1;
    let mut page = Playback::of_samples("ANYmal is pushed and held on its gait", samples)
        .si()
        .frames(kernel)
        .shape("base_link", Shape::cuboid([0.5, 0.24, 0.14]));
    for leg in ["LF", "LH", "RF", "RH"] {
        let [hip, thigh, shank] = ["HAA", "HFE", "KFE"].map(|joint| format!("{leg}_{joint}_link"));
        let [fore, left] = [leg.ends_with('F'), leg.starts_with('L')].map(|yes| if yes { 1.0 } else { -1.0 });
        let foot = [0.033 * fore, 0.01305 * left, -0.33797];
        page = page.rod("base_link", &hip, 0.02).rod(&hip, &thigh, 0.025).rod(&thigh, &shank, 0.025);
        let ball = Shape::ball(0.031).at(&Translation3::from(foot).into());
        page = page.shape(&shank, Shape::rod([0.0; 3], foot, 0.018)).shape(&shank, ball);
    }
    for (i, contact) in Kernel::CONTACTS.iter().enumerate() {
        let first = &run.states[0].0;
        kernel.contact_frame(i, 0.0, first).ok_or("a contact without a place")?;
        page = page.contact(contact.name, 1e-3, |s| {
            let (modes, impulses) = &run.feet[step(s)];
            let touch = match modes[i] {
                Mode::Open => Touch::Open,
                Mode::Closed => Touch::Closed,
                Mode::Sticks => Touch::Sticks,
                Mode::Slides(_) => Touch::Slides,
            };
            let rows: Vec<f64> = contact.rows().map(|row| impulses[row] / STEP).collect();
            let frame = kernel.contact_frame(i, s.t, &s.q);
            frame.map_or((touch, Vector3::zeros(), Vector3::zeros()), |frame| (touch, frame.point, frame.force(&rows)))
        });
    }
    // The push, for as long as an eye needs.
    page = page.arrow("push", 0.5, |s| {
        let shown = if (PUSHED..PUSHED + 0.15).contains(&s.t) { push } else { 0.0 };
        let at = s.q.0.translation.vector;
        (at - Vector3::y() * 0.5 * shown, Vector3::y() * shown)
    });
    Ok(page
        .curve("sideways / m", "trunk", |s| s.q.0.translation.y)
        .curve("height / m", "trunk", |s| s.q.0.translation.z))
}
