//! The three scenes: a gait, a box that is pushed, a ball that is held.

use gauss_runtime::prelude::*;
use serde_json::json;

use crate::contest::{HELD, Outcome, STEP, Scene, Sticks};
use crate::hand::{self, Hand, HandKernel};
use crate::push::{self, PusherKernel};
use crate::robot::{self, Anymal, AnymalKernel};

/// So many targets are a second.
const SECOND: usize = (1.0 / (HELD as f64 * STEP)) as usize;

/// ANYmal trots for four seconds by angles of its joints that its controller asked for before: they are recorded in
/// the same steps. Torques alone would not keep it up.
pub fn trotting(friction: f64) -> Outcome<Scene<AnymalKernel, 12>> {
    const WANTED: f64 = 0.3;
    let kernel = Anymal { mu: friction }.kernel()?;
    let start = robot::start(&kernel);
    let mut targets: Vec<SVector<f64, 12>> = Vec::new();
    let gains = robot::GAINS.map(SVector::<f64, 12>::repeat);
    let efforts = |n: usize, q: &robot::Place, z: &robot::Speeds| {
        if n.is_multiple_of(HELD) {
            targets.push(robot::goal(n as f64 * STEP, q, z, WANTED));
        }
        gains[0].component_mul(&(targets[n / HELD] - q.1)) - gains[1].component_mul(&z.fixed_rows::<12>(6))
    };
    robot::run(&kernel, start, 4 * SECOND * HELD, efforts, |_| ())?;
    let parameters = json!({});
    let (start, timed, sticks) = (start.0, 4 * SECOND, Sticks::Feet);
    Ok(Scene { name: "anymal", kernel, start, gains, targets, timed, rates: 6, friction, sticks, parameters })
}

/// A Panda sweeps a box over a table for a second, and stays there for two.
pub fn pushing(friction: f64) -> Outcome<Scene<PusherKernel, 9>> {
    let (pusher, start) = push::start(friction)?;
    let targets = (0..3 * SECOND).map(|n| push::target((n * HELD) as f64 * STEP)).collect();
    let parameters = json!({ "m": pusher.m, "a": pusher.a, "r": pusher.r, "tip": pusher.tip, "h": pusher.h });
    let (kernel, gains) = (pusher.kernel()?, [push::STIFFNESS, push::DAMPING].map(SVector::from));
    let (timed, rates, sticks) = (3 * SECOND, push::RATES, Sticks::FreeBody);
    Ok(Scene { name: "pusher", kernel, start, gains, targets, timed, rates, friction, sticks, parameters })
}

/// A hand of sixteen joints holds a ball for four seconds; timed are 1.6 s, since without NoSlip MuJoCo's hand loses
/// the ball after 1.8 s.
pub fn holding(friction: f64) -> Outcome<Scene<HandKernel, 16>> {
    let hand = Hand::around_a_ball(friction);
    let (start, rest) = hand::start();
    let gains = hand::GAINS.map(SVector::<f64, 16>::repeat);
    // Where fingers would be without the ball: they press by what they are bent back.
    let target = start.1 + hand.torques(&start, &rest) / hand::GAINS[0];
    let Hand { heavy, m, r, w, l1, l2, l3, out, up, .. } = hand;
    let parameters = json!({ "heavy": heavy, "m": m, "r": r, "w": w, "lengths": [l1, l2, l3], "out": out, "up": up });
    let (kernel, targets, timed) = (hand.kernel()?, vec![target; 4 * SECOND], 16 * SECOND / 10);
    let sticks = Sticks::FreeBody;
    Ok(Scene { name: "hand", kernel, start, gains, targets, timed, rates: 6, friction, sticks, parameters })
}
