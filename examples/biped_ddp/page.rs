//! The plan as a page that plays.

use gauss_contact::Mode;
use gauss_examples::ddp::Plan;
use gauss_playback::{Playback, Shape, Touch};
use gauss_runtime::prelude::*;

use crate::model::{BipedKernel, LENGTH, STEP, Walker};
use crate::plan::Looked;

type Kernel = BipedKernel<f64>;

/// Each second step of the plan, with the forces at both feet and all torques.
pub fn page(walker: &Walker, plan: &Plan<14, 4>, looked: &Looked) -> Playback<Kernel> {
    let kernel = &walker.plain;
    let sample = |(n, x): (usize, &gauss_examples::ddp::Vector<14>)| {
        let (t, q, z) = (n as f64 * STEP, x.fixed_rows::<7>(0).into_owned(), x.fixed_rows::<7>(7).into_owned());
        Sample { t, q, z, p: kernel.momentum(t, &q, &z) }
    };
    let samples = plan.states.iter().enumerate().step_by(2).map(sample).collect();
    // The step that ends at a time.
    let step = |s: &Sample<Kernel>| ((s.t / STEP).round() as usize).clamp(1, plan.inputs.len()) - 1;
    let trunk = Shape::cuboid([0.14, 0.22, 0.4]).at(&Isometry3::translation(0.0, 0.0, 0.2));
    let mut page = Playback::of_samples("A biped steps forward by a plan through contacts", samples)
        .si()
        .frames(kernel)
        .shape("trunk", trunk)
        .from_the_side();
    for side in ["left", "right"] {
        let [thigh, shank] = ["thigh", "shank"].map(|link| format!("{side}_{link}"));
        let rod = |radius: f64| Shape::rod([0.0; 3], [0.0, 0.0, -LENGTH], radius);
        page = page.shape(&thigh, rod(0.03)).shape(&shank, rod(0.02));
    }
    for (foot, name) in ["left foot", "right foot"].into_iter().enumerate() {
        page = page.contact(name, 2e-3, |s| {
            let touch = match looked.modes[step(s)][foot] {
                Mode::Open => Touch::Open,
                Mode::Closed => Touch::Closed,
                Mode::Sticks => Touch::Sticks,
                Mode::Slides(_) => Touch::Slides,
            };
            let ([normal, forward], [x, z]) = (looked.impulses[step(s)][foot], looked.toes[step(s)][foot]);
            (touch, Vector3::new(x, 0.0, z), Vector3::new(forward, 0.0, normal) / STEP)
        });
    }
    for (k, joint) in ["left hip", "left knee", "right hip", "right knee"].into_iter().enumerate() {
        page = page.curve("torque / (N m)", joint, |s| plan.inputs[step(s)][k]);
    }
    page.curve("height / m", "left foot", |s| looked.toes[step(s)][0][1])
        .curve("height / m", "right foot", |s| looked.toes[step(s)][1][1])
}
