//! The motion as a page, with what the feet do.

use std::error::Error;

use gauss_contact::Mode;
use gauss_playback::{Playback, Shape, Touch};
use gauss_runtime::prelude::*;

use crate::robot::{AnymalKernel, STEP, Torques, run, start};

/// A picture each so many steps.
const EACH: usize = 10;

/// The skeleton of ANYmal under recorded torques, and forces at its feet.
///
/// # Errors
/// Where a step is one.
pub fn page(kernel: &AnymalKernel, torques: &[Torques]) -> Result<Playback<AnymalKernel>, Box<dyn Error>> {
    let (mut samples, mut feet, mut n) = (Vec::new(), Vec::new(), 0);
    run(
        kernel,
        start(kernel),
        torques.len(),
        |n, _, _| torques[n],
        |stepper| {
            n += 1;
            if n % EACH == 0 {
                let (t, q, z) = (stepper.time(), *stepper.configuration(), *stepper.speeds());
                samples.push(Sample { t, q, z, p: kernel.momentum(t, &q, &z) });
                feet.push((stepper.modes().to_vec(), *stepper.impulses()));
            }
        },
    )?;
    let times: Vec<f64> = samples.iter().map(|sample| sample.t).collect();
    let picture = |s: &Sample<AnymalKernel>| times.partition_point(|t| *t < s.t).min(times.len() - 1);
    let mut page = Playback::of_samples("ANYmal trots by recorded torques", samples)
        .si()
        .frames(kernel)
        .shape("base_link", Shape::cuboid([0.5, 0.24, 0.14]))
        .follow("base_link");
    for leg in ["LF", "LH", "RF", "RH"] {
        let [hip, thigh, shank] = ["HAA", "HFE", "KFE"].map(|joint| format!("{leg}_{joint}_link"));
        let [fore, left] = [leg.ends_with('F'), leg.starts_with('L')].map(|yes| if yes { 1.0 } else { -1.0 });
        let foot = [0.033 * fore, 0.01305 * left, -0.33797];
        page = page.rod("base_link", &hip, 0.02).rod(&hip, &thigh, 0.025).rod(&thigh, &shank, 0.025);
        let ball = Shape::ball(0.031).at(&Translation3::from(foot).into());
        page = page.shape(&shank, Shape::rod([0.0; 3], foot, 0.018)).shape(&shank, ball);
    }
    for (i, contact) in AnymalKernel::CONTACTS.iter().enumerate() {
        page = page.contact(contact.name, 1e-3, |s| {
            let (modes, impulses) = &feet[picture(s)];
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
    for (k, foot) in [(0, "left fore"), (6, "right fore")] {
        page = page.curve("torque of the knee / (N m)", foot, |s| torques[EACH * picture(s)][k + 2]);
    }
    Ok(page.curve("height / m", "base", |s| s.q.0.translation.z))
}
