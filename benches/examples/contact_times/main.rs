//! Runs from event to event beside steps of fixed length: a bouncing ball and the woodpecker toy with the steps and
//! times of published programs.
//!
//! `cargo run --release -p gauss-benches --example contact_times [-- rounds]`: microseconds per simulated second,
//! errors, events and steps. Lengths of steps and the spans are those of the examples of Siconos: `BouncingBallTS`
//! (h = 0.005 s, 10 s) and `WoodPecker` (h = 2·10⁻⁵ s, 0.3 s), both with θ = ½.

#[path = "../../../examples/woodpecker/toy.rs"]
mod toy;

use std::error::Error;
use std::time::Instant;

use gauss_benches::measure::Spread;
use gauss_contact::{ContactError, ContactRun, ContactStepper, ContactTrajectory, EventKind, Mode, Segment};
use gauss_runtime::prelude::*;
use nalgebra::SVector;

use toy::{TOY, WoodpeckerKernel};

/// A ball over a floor.
#[derive(GaussDynamics)]
#[gauss(coordinates(x), particle(mass = 1, position = [0, 0, x]), contact(floor, gap = x, restitution = e))]
struct Ball {
    e: f64,
    #[gauss(gravity)]
    g: f64,
}

const BALL: Ball = Ball { e: 0.9, g: 9.81 };
/// Simulated time of the ball and of the woodpecker, s.
const SPANS: [f64; 2] = [10.0, 0.3];
const TOLERANCES: [f64; 3] = [1e-6, 1e-9, 1e-12];

/// What a run comes to.
struct Outcome {
    /// Steps, and events where they are known.
    steps: usize,
    events: Option<usize>,
    /// Two errors: of the motion, and of a time.
    errors: [f64; 2],
}

/// One way to a motion.
struct Way<'a> {
    name: String,
    span: f64,
    run: Box<dyn Fn() -> Result<(), Box<dyn Error>> + 'a>,
    outcome: Outcome,
}

/// The height of the ball from 1 m, and the time from which it rests, in closed form.
fn closed_form(t: f64) -> (f64, f64) {
    let (e, g) = (BALL.e, BALL.g);
    let first = (2.0 / g).sqrt();
    let ends = first * (1.0 + e) / (1.0 - e);
    if t < first {
        return (1.0 - 0.5 * g * t * t, ends);
    }
    let (mut since, mut speed) = (first, g * first * e);
    while t > since + 2.0 * speed / g && speed > 1e-12 {
        since += 2.0 * speed / g;
        speed *= e;
    }
    let flown = t - since;
    (if speed > 1e-12 { flown * (speed - 0.5 * g * flown) } else { 0.0 }, ends)
}

/// The times at which heights are compared.
fn times() -> impl Iterator<Item = f64> {
    (1..=1000).map(|k| f64::from(k) * SPANS[0] / 1000.0)
}

fn taken<K: ContactSystem<Scalar = f64>>(run: &ContactTrajectory<'_, K>) -> usize {
    run.segments().iter().map(|segment| segment.trajectory().summary().steps as usize).sum()
}

fn ball_by_events(kernel: &BallKernel, tolerance: f64) -> Result<Way<'_>, Box<dyn Error>> {
    let run = move || {
        let run = ContactRun::new(kernel).adaptive(tolerance, tolerance);
        run.run([1.0].into(), [0.0].into(), 0.0..SPANS[0])
    };
    let made = run()?;
    let rests = made.events().iter().find_map(|event| match event.kind {
        EventKind::Rests { remaining, .. } => Some(event.time + remaining),
        _ => None,
    });
    let mut largest = 0.0_f64;
    for t in times() {
        largest = largest.max((made.at(t)?.q[0] - closed_form(t).0).abs());
    }
    let ends = (rests.ok_or("it does not rest")? - closed_form(0.0).1).abs();
    Ok(Way {
        name: format!("ball, events, {tolerance:.0e}"),
        span: SPANS[0],
        outcome: Outcome { steps: taken(&made), events: Some(made.events().len()), errors: [largest, ends] },
        run: Box::new(move || run().map(drop).map_err(Into::into)),
    })
}

fn ball_by_steps(kernel: &BallKernel, h: f64) -> Result<Way<'_>, Box<dyn Error>> {
    let count = (SPANS[0] / h).round() as usize;
    let begin = move || ContactStepper::new(kernel, 0.0, [1.0].into(), [0.0].into());
    let mut ball = begin()?;
    let (mut largest, mut rests) = (0.0_f64, 0.0);
    for _ in 0..count {
        ball.step(h, &())?;
        largest = largest.max((ball.configuration()[0] - closed_form(ball.time()).0).abs());
        // It rests from where each step presses.
        rests = if ball.impulses()[0] == 0.0 { ball.time() } else { rests };
    }
    Ok(Way {
        name: format!("ball, steps of {h:.0e} s"),
        span: SPANS[0],
        outcome: Outcome { steps: count, events: None, errors: [largest, (rests - closed_form(0.0).1).abs()] },
        run: Box::new(move || {
            let mut ball = begin()?;
            (0..count).try_for_each(|_| ball.step(h, &()).map(drop))?;
            std::hint::black_box(ball.configuration());
            Ok(())
        }),
    })
}

type Vector = SVector<f64, 3>;

/// The angle of the bird at a turn of the motion that repeats itself, while the sleeve leans on its lower edge and
/// sticks.
///
/// The return map from turn to turn has the eigenvalue −0.84: after 200 turns nothing is left of the start.
fn turn(kernel: &WoodpeckerKernel) -> Result<f64, Box<dyn Error>> {
    let (q, z) = start(-0.53);
    let run = ContactRun::new(kernel).adaptive(1e-13, 1e-13).run(q, z, 0.0..30.0)?;
    let turns = |segment: &&Segment<'_, WoodpeckerKernel>| {
        let speeds = [segment.trajectory().first().z[2], segment.trajectory().last().z[2]];
        segment.modes()[1] == Mode::Sticks && speeds[0] < 0.0 && speeds[1] > 0.0
    };
    let last = run.segments().iter().rfind(turns).ok_or("it does not turn")?;
    let (mut from, mut to) = (last.trajectory().first().t, last.trajectory().last().t);
    while to - from > 4.0 * f64::EPSILON * to {
        let middle = 0.5 * (from + to);
        *(if run.at(middle)?.z[2] < 0.0 { &mut from } else { &mut to }) = middle;
    }
    Ok(run.at(to)?.q[2])
}

/// At rest, leaning.
fn start(bird: f64) -> (Vector, Vector) {
    ([0.0, -0.0006 / 0.0058, bird].into(), Vector::zeros())
}

/// The woodpecker at the end of the span, and from its first peck to the next one.
struct Pecks {
    end: Vector,
    period: f64,
}

fn pecks(times: impl IntoIterator<Item = f64>, end: Vector) -> Option<Pecks> {
    let mut times = times.into_iter();
    let (first, second) = (times.next()?, times.next()?);
    Some(Pecks { end, period: second - first })
}

fn woodpecker(kernel: &WoodpeckerKernel, bird: f64, tolerance: f64) -> Result<(Pecks, usize, usize), Box<dyn Error>> {
    let (q, z) = start(bird);
    let run = ContactRun::new(kernel).adaptive(tolerance, tolerance).run(q, z, 0.0..SPANS[1])?;
    let beak = run.events().iter().filter(|event| event.contact == 0 && matches!(event.kind, EventKind::Impact(_)));
    let end = run.last().ok_or("no end")?.q;
    let pecks = pecks(beak.map(|event| event.time), end).ok_or("it does not peck twice")?;
    Ok((pecks, run.events().len(), taken(&run)))
}

fn off(found: &Pecks, wanted: &Pecks) -> [f64; 2] {
    [(found.end - wanted.end).amax(), (found.period - wanted.period).abs()]
}

fn woodpecker_by_events<'k>(
    kernel: &'k WoodpeckerKernel,
    bird: f64,
    tolerance: f64,
    wanted: &Pecks,
) -> Result<Way<'k>, Box<dyn Error>> {
    let (found, events, steps) = woodpecker(kernel, bird, tolerance)?;
    Ok(Way {
        name: format!("woodpecker, events, {tolerance:.0e}"),
        span: SPANS[1],
        outcome: Outcome { steps, events: Some(events), errors: off(&found, wanted) },
        run: Box::new(move || woodpecker(kernel, bird, tolerance).map(drop)),
    })
}

fn stepped(kernel: &WoodpeckerKernel, bird: f64, h: f64) -> Result<Option<Pecks>, ContactError> {
    let (q, z) = start(bird);
    let (mut toy, mut times, mut struck) = (ContactStepper::new(kernel, 0.0, q, z)?, Vec::new(), false);
    for _ in 0..(SPANS[1] / h).round() as usize {
        toy.step(h, &())?;
        let strikes = toy.impulses()[0] > 0.0;
        if strikes && !struck {
            times.push(toy.time());
        }
        struck = strikes;
    }
    Ok(pecks(times, *toy.configuration()))
}

fn woodpecker_by_steps<'k>(
    kernel: &'k WoodpeckerKernel,
    bird: f64,
    h: f64,
    wanted: &Pecks,
) -> Result<Way<'k>, Box<dyn Error>> {
    let found = stepped(kernel, bird, h)?.ok_or("it does not peck twice")?;
    Ok(Way {
        name: format!("woodpecker, steps of {h:.0e} s"),
        span: SPANS[1],
        outcome: Outcome { steps: (SPANS[1] / h).round() as usize, events: None, errors: off(&found, wanted) },
        run: Box::new(move || {
            std::hint::black_box(stepped(kernel, bird, h)?);
            Ok(())
        }),
    })
}

fn main() -> Result<(), Box<dyn Error>> {
    let rounds: usize = std::env::args().nth(1).map_or(Ok(101), |rounds| rounds.parse())?;
    let (ball, toy) = (BALL.kernel()?, TOY.kernel()?);
    let bird = turn(&toy)?;
    let (wanted, ..) = woodpecker(&toy, bird, 1e-13)?;
    let [y, sleeve, angle] = wanted.end.into();
    println!(
        "woodpecker, events, 1e-13: from, period, end {bird:.14} {:.14} {y:.14} {sleeve:.14} {angle:.14}",
        wanted.period
    );
    let mut ways = Vec::new();
    for tolerance in TOLERANCES {
        ways.push(ball_by_events(&ball, tolerance)?);
    }
    for h in [0.005, 0.0005] {
        ways.push(ball_by_steps(&ball, h)?);
    }
    for tolerance in TOLERANCES {
        ways.push(woodpecker_by_events(&toy, bird, tolerance, &wanted)?);
    }
    for h in [2e-5, 2e-6] {
        ways.push(woodpecker_by_steps(&toy, bird, h, &wanted)?);
    }
    let mut figures = vec![Vec::with_capacity(rounds); ways.len()];
    for round in 0..rounds {
        // A different one begins every time.
        for k in (0..ways.len()).map(|k| (k + round) % ways.len()) {
            let start = Instant::now();
            (ways[k].run)()?;
            figures[k].push(start.elapsed().as_secs_f64() * 1e6 / ways[k].span);
        }
    }
    println!("| way | µs per simulated second | steps | events | error of the motion | error of the time |");
    println!("|---|---|---|---|---|---|");
    for (way, figures) in ways.iter().zip(figures) {
        let (Spread { lower, median, upper, .. }, Outcome { steps, events, errors: [motion, time] }) =
            (Spread::of(figures), &way.outcome);
        let events = events.map_or("–".to_owned(), |events| events.to_string());
        let name = &way.name;
        println!("| {name} | {median:.1} ({lower:.1}–{upper:.1}) | {steps} | {events} | {motion:.1e} | {time:.1e} |");
    }
    Ok(())
}
