//! The walker as a page that plays.

use std::error::Error;

use gauss_playback::{Playback, Shape, Touch};
use gauss_runtime::prelude::*;

use crate::model::{FOOT, Gait, Walker, WalkerKernel, walk};

const SLOPE: f64 = 0.009;

type State = Sample<WalkerKernel<f64>>;

/// Steps of a gait: samples with the time since the first of them, and of each step when it begins, and where its foot
/// stands along the slope.
struct Steps {
    samples: Vec<State>,
    feet: Vec<(f64, f64)>,
}

impl Steps {
    fn of(gait: &Gait, count: usize) -> Result<Self, Box<dyn Error>> {
        let (mut start, mut foot, mut time) = (gait.start, 0.0, 0.0);
        let mut made = Self { samples: Vec::new(), feet: Vec::new() };
        for _ in 0..count {
            made.feet.push((time, foot));
            let first = made.samples.len();
            start = walk(FOOT, SLOPE, start, |s| made.samples.push(Sample { t: time + s.t, ..*s }), 1)?;
            // The last one is that behind the heel strike, of the next foot.
            made.samples.pop();
            time = made.samples.last().map_or(time, |s| s.t);
            // Both sides of a heel strike are shown.
            if let Some(s) = made.samples.get_mut(first) {
                s.t = s.t.next_up();
            }
            foot += 2.0 * start[0].sin();
        }
        Ok(made)
    }

    /// The number of the step at a time, and where its foot stands.
    fn at(&self, t: f64) -> (usize, f64) {
        let step = self.feet.iter().rposition(|(begins, _)| *begins < t).unwrap_or(0);
        (step, self.feet[step].1)
    }
}

/// So many steps of a gait, in lengths of a leg and with a hip of mass 1.
///
/// # Errors
/// Where the walker falls.
pub fn page(gait: &Gait, count: usize) -> Result<Playback<WalkerKernel<f64>>, Box<dyn Error>> {
    let gravity = Vector3::new(SLOPE.sin(), 0.0, -SLOPE.cos());
    let kernel = Walker { foot: FOOT, g: gravity }.kernel()?;
    let steps = Steps::of(gait, count)?;
    let end = steps.at(f64::INFINITY).1;
    let hip = |s: &State| Vector3::new(steps.at(s.t).1 + s.q[0], 0.0, s.q[1]);
    // The leg of a number stands in steps of that parity.
    let foot = |s: &State, leg: usize| {
        let (step, stands) = steps.at(s.t);
        let swings = || hip(s) + Vector3::new(s.q[3].sin(), 0.0, -s.q[3].cos());
        if step % 2 == leg { (true, Vector3::new(stands, 0.0, 0.0)) } else { (false, swings()) }
    };
    // All that acts on the hip, which has all of the mass, is its weight and the force of the ground.
    let ground = |s: &State| {
        let rates = kernel.acceleration(s.t, &s.q, &s.z, &());
        Vector3::new(rates[0], 0.0, rates[1]) - gravity
    };
    let place = |v: Vector3<f64>| Isometry3::from(Translation3::from(v));
    let touch = |s: &State, leg: usize| match foot(s, leg) {
        (true, at) => (Touch::Sticks, at, ground(s)),
        (false, at) => (Touch::Open, at, Vector3::zeros()),
    };
    let slope = Shape::cuboid([end + 2.0, 0.6, 0.02]).at(&Isometry3::translation(0.5 * end, 0.0, -0.02));
    let angle = |s: &State, leg: usize| if foot(s, leg).0 { s.q[2] } else { s.q[3] };
    Ok(Playback::of_samples("The simplest walker on a slope of 0.009", steps.samples.clone())
        .body("hip", |s| place(hip(s)), [Shape::ball(0.07)])
        .body("left foot", |s| place(foot(s, 0).1), [Shape::ball(0.025)])
        .body("right foot", |s| place(foot(s, 1).1), [Shape::ball(0.025)])
        .body("slope", |_| Isometry3::identity(), [slope.colour("#bbbbbb")])
        .rod("hip", "left foot", 0.012)
        .rod("hip", "right foot", 0.012)
        .up((-gravity).into())
        .from_the_side()
        .trace("hip", [0.0; 3])
        .contact("left foot", 0.4, |s| touch(s, 0))
        .contact("right foot", 0.4, |s| touch(s, 1))
        .curve("angle / rad", "left leg", |s| angle(s, 0))
        .curve("angle / rad", "right leg", |s| angle(s, 1))
        .curve("force of the ground / weight", "along the leg", |s| ground(s).norm()))
}
