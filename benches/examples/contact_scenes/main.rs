//! Robots that walk, push and hold, in steps of a millisecond, beside other programs by turns.
//!
//! ```sh
//! RUSTFLAGS="-C target-cpu=native" cargo run --release -p gauss-benches --example contact_scenes --features robots \
//!     -- python3
//! ```
//!
//! That Python has `mujoco`, and `drake` if it shall be there, too: `peers/contact_scenes.py` builds the same scenes
//! from a description that this program sends it. Without an argument ours run alone. `--rounds 5` plays each scene so
//! many times (5); `anymal`, `pusher` and `hand` name scenes.
//!
//! Of each program are printed the median time of a step in batches of 200 with the range of the middle half, and what
//! part of it ours is, the median of batches that were made next to each other; the mean over the run of the medians of
//! each batch by rounds, and ours of that; then what steps do to the laws, in runs of their own. Lowest gap: after any
//! step. Creep: the median slip of feet that bear a load, m/s, or the way in m of the box and of the ball in the last
//! second, in which they should stick. Energy: what it changed by beyond the work of motors and contacts, over all work
//! that these did either way. Way: of trunk, box or ball in all; programs whose ways differ play different scenes.

mod contest;
#[expect(dead_code, reason = "the example's own step and run")]
#[path = "../../../examples/held_ball/hand.rs"]
mod hand;
mod push;
#[expect(dead_code, reason = "the example records torques")]
#[path = "../../../examples/trotting/robot.rs"]
mod robot;
mod scenes;
mod theirs;

use std::cell::RefCell;
use std::rc::Rc;

use gauss_benches::measure::Spread;
use serde_json::Value;

use contest::{BATCH, Contest, HELD, Outcome, Quality, Solves, median};
use theirs::{Python, Theirs};

/// What the arguments say.
struct Wanted {
    python: Option<String>,
    rounds: usize,
    scenes: Vec<String>,
}

fn wanted() -> Outcome<Wanted> {
    let mut wanted = Wanted { python: None, rounds: 5, scenes: Vec::new() };
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--rounds" => {
                let rounds = arguments.next().and_then(|word| word.parse().ok()).filter(|rounds| *rounds > 0);
                wanted.rounds = rounds.ok_or("--rounds wants a number above 0")?;
            }
            "anymal" | "pusher" | "hand" => wanted.scenes.push(argument),
            _ => wanted.python = Some(argument),
        }
    }
    Ok(wanted)
}

/// A scene with all that take part.
struct Match<'a> {
    scene: &'static str,
    batches: usize,
    description: Value,
    contestants: Vec<Box<dyn Contest + 'a>>,
    solves: Solves,
}

impl Match<'_> {
    /// Batches by turns.
    fn times(&mut self, rounds: usize) -> Outcome<Vec<Vec<f64>>> {
        let mut times = vec![Vec::new(); self.contestants.len()];
        for _ in 0..rounds {
            self.contestants.iter_mut().try_for_each(|contestant| contestant.restart())?;
            for number in 0..self.batches {
                for (contestant, times) in self.contestants.iter_mut().zip(&mut times) {
                    times.push(contestant.batch(number)?);
                }
            }
        }
        Ok(times)
    }

    fn report(&mut self, rounds: usize) -> Outcome<()> {
        let times = self.times(rounds)?;
        let means: Vec<f64> = times.iter().map(|times| mean(times, self.batches)).collect();
        println!("\n{}: {rounds} times {} batches of {} steps", self.scene, self.batches, BATCH * HELD);
        println!("| | µs a step | ours of it | mean | ours of it | lowest gap, m | creep | energy | way, m |");
        println!("|---|---|---|---|---|---|---|---|---|");
        for ((contestant, theirs), mean) in self.contestants.iter_mut().zip(&times).zip(&means) {
            let Spread { lower, median: middle, upper, .. } = Spread::of(theirs.clone());
            let ratio = median(times[0].iter().zip(theirs).map(|(ours, theirs)| ours / theirs).collect());
            let Quality { lowest, creep, unaccounted, way, solves } = contestant.quality()?;
            let energy = unaccounted.map_or("".into(), |part| format!("{part:.0e}"));
            println!(
                "| {} | {middle:.1} ({lower:.1}–{upper:.1}) | {ratio:.2} | {mean:.1} | {:.2} | {lowest:.0e} | {creep:.0e} \
                 | {energy} | {way:.4} |",
                contestant.name(),
                means[0] / mean
            );
            if let Some(solves) = solves {
                self.solves = solves;
            }
        }
        let Solves { steps, residual, corrections, sweeps, impacts } = self.solves;
        let each = |count: f64| count / steps as f64;
        println!(
            "ours: residual {residual:.0e} m/s; {:.2} corrections and {:.2} sweeps a step, {:.1} % of them with impacts",
            each(corrections.into()),
            each(sweeps.into()),
            100.0 * each(impacts as f64)
        );
        Ok(())
    }
}

/// The mean over a run of the medians of each of its batches in all rounds.
fn mean(times: &[f64], batches: usize) -> f64 {
    let of_batch = |number: usize| median(times.iter().skip(number).step_by(batches).copied().collect());
    (0..batches).map(of_batch).sum::<f64>() / batches as f64
}

fn main() -> Outcome<()> {
    let Wanted { python, rounds, scenes } = wanted()?;
    let (trotting, pushing, holding) = (scenes::trotting(0.8)?, scenes::pushing(0.5)?, scenes::holding(0.8)?);
    macro_rules! of {
        ($scene:ident) => {
            Match {
                scene: $scene.name,
                batches: $scene.timed / BATCH,
                description: $scene.description(),
                contestants: vec![Box::new($scene.ours()?) as Box<dyn Contest>],
                solves: Solves::default(),
            }
        };
    }
    let mut matches = vec![of!(trotting), of!(pushing), of!(holding)];
    matches.retain(|of| scenes.is_empty() || scenes.iter().any(|name| name == of.scene));
    if let Some(python) = python {
        let descriptions: Vec<Value> = matches.iter().map(|of| of.description.clone()).collect();
        let (python, names) = Python::start(&python, &descriptions)?;
        let python = Rc::new(RefCell::new(python));
        for (scene, (of, names)) in matches.iter_mut().zip(&names).enumerate() {
            for (number, name) in names.iter().enumerate() {
                of.contestants.push(Box::new(Theirs::new(&python, scene, number, name)));
            }
        }
    }
    matches.iter_mut().try_for_each(|of| of.report(rounds))
}
