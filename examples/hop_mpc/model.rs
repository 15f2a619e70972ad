//! The leg as plans see it, where it should be, and the plant that it is.

use std::error::Error;

use gauss_contact::{ContactStepper, StepScheme};
use gauss_runtime::dual::Dual;
use gauss_runtime::prelude::*;

use crate::plan::{Horizon, Plant, State};

/// A body on a leg whose length a motor changes, between two stops; the foot hits the ground without a bounce.
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(
    coordinates(height, length),
    particle(mass = body, position = [0, 0, height]),
    particle(mass = foot, position = [0, 0, height - length]),
    contact(ground, gap = height - length),
    range(stroke, along = length, from = 0.25, to = 0.6),
    input(thrust),
    drive(length = thrust),
)]
struct Leg<T> {
    #[gauss(unit = "kg")]
    body: T,
    #[gauss(unit = "kg")]
    foot: T,
    #[gauss(gravity, unit = "m/s^2")]
    g: T,
}

const G: f64 = 9.81;
/// A flight and a stance take so long, s.
pub const HALF: f64 = 0.3;
/// The height at touchdown, m.
const TOUCH: f64 = 0.5;
/// Seconds between two thrusts, and how many are planned.
pub const SAMPLE: f64 = 0.01;
const AHEAD: usize = 40;
/// When the body is struck, and how much slower it is then.
pub const STRUCK: (usize, f64) = (150, -0.7);

/// Where body and leg should be: a flight by weight alone, then a stance with as much acceleration upward.
pub fn wanted(t: f64) -> State {
    let phase = t.rem_euclid(2.0 * HALF);
    let speed = 0.5 * G * HALF;
    if phase < HALF {
        let (height, rate) = (TOUCH + speed * phase - 0.5 * G * phase * phase, speed - G * phase);
        // The foot is drawn up.
        let angle = std::f64::consts::PI / HALF;
        State::new(height, TOUCH - 0.06 * (angle * phase).sin(), rate, -0.06 * angle * (angle * phase).cos())
    } else {
        let phase = phase - HALF;
        let (height, rate) = (TOUCH - speed * phase + 0.5 * G * phase * phase, -speed + G * phase);
        State::new(height, height, rate, rate)
    }
}

/// The leg as a plan sees it: a step of contact for each thrust.
pub struct Model {
    plain: LegKernel<f64>,
    dual: LegKernel<Dual<5>>,
}

impl Model {
    /// With a body of this mass, kg.
    ///
    /// # Errors
    /// Where it is not positive.
    pub fn new(body: f64) -> Result<Self, Box<dyn Error>> {
        let number = Dual::constant;
        let dual = Leg { body: number(body), foot: number(0.4), g: number(G) }.kernel()?;
        Ok(Self { plain: Leg { body, foot: 0.4, g: G }.kernel()?, dual })
    }

    fn stepper(&self, x: &State) -> Option<ContactStepper<'_, LegKernel<f64>>> {
        let (q, z) = (SVector::from([x[0], x[1]]), SVector::from([x[2], x[3]]));
        Some(ContactStepper::new(&self.plain, 0.0, q, z).ok()?.scheme(StepScheme::MoreauJean))
    }
}

fn state(stepper: &ContactStepper<LegKernel<f64>>) -> State {
    let (q, z) = (stepper.configuration(), stepper.speeds());
    State::new(q[0], q[1], z[0], z[1])
}

impl Plant for Model {
    fn step(&self, x: &State, thrust: f64) -> Option<State> {
        let mut stepper = self.stepper(x)?;
        stepper.step(SAMPLE, &[thrust].into()).ok()?;
        Some(state(&stepper))
    }

    // ANCHOR: linear
    fn linear(&self, x: &State, thrust: f64) -> Option<(SMatrix<f64, 4, 4>, State)> {
        let mut stepper = self.stepper(x)?;
        let step = stepper.step_with_derivatives::<_, 5, 4, 1, 0>(SAMPLE, &[thrust].into(), &self.dual).ok()?;
        Some((step.by_state, step.by_input))
    }
    // ANCHOR_END: linear
}

/// What became of a run: apexes, and how far the body was from where it should be in the last second, m.
pub struct Run {
    pub apexes: Vec<f64>,
    pub off: f64,
}

/// The plant, under thrusts by sample and state.
///
/// # Errors
/// Where a step or a thrust is none.
pub fn run(samples: usize, mut thrust: impl FnMut(usize, &State) -> Option<f64>) -> Result<Run, Box<dyn Error>> {
    // A tenth heavier than the model.
    let plant = Model::new(4.4)?;
    let mut stepper = plant.stepper(&wanted(0.5 * HALF)).ok_or("no start")?;
    let (mut made, mut apexes, mut rising) = (Run { apexes: Vec::new(), off: 0.0 }, Vec::new(), false);
    for n in 0..samples {
        let mut x = state(&stepper);
        if n == STRUCK.0 {
            x[2] += STRUCK.1;
            x[3] += STRUCK.1;
            stepper = plant.stepper(&x).ok_or("the blow leaves no state")?;
        }
        let held = [thrust(n, &x).ok_or("no plan")?].into();
        for _ in 0..5 {
            stepper.step(0.2 * SAMPLE, &held)?;
            let (height, rate) = (stepper.configuration()[0], stepper.speeds()[0]);
            if rising && rate <= 0.0 {
                apexes.push(height);
            }
            rising = rate > 0.0;
        }
        if n + 100 >= samples {
            let t = 0.5 * HALF + (n + 1) as f64 * SAMPLE;
            made.off = made.off.max((stepper.configuration()[0] - wanted(t)[0]).abs());
        }
    }
    made.apexes = apexes;
    Ok(made)
}

/// Where the leg should be from a sample on.
fn ahead(n: usize) -> Horizon {
    Horizon { wanted: (0..=AHEAD).map(|k| wanted(0.5 * HALF + (n + k) as f64 * SAMPLE)).collect() }
}

/// A plan for the samples after the next one, by one for those after this.
fn later(plan: &[f64]) -> Vec<f64> {
    let mut later = plan.to_vec();
    later.rotate_left(1);
    later[AHEAD - 1] = later[AHEAD - 2];
    later
}

/// The thrusts of the model itself, from guesses that get better piece by piece; `None` where it does not step.
#[must_use]
pub fn thrusts(model: &Model, samples: usize) -> Option<Vec<f64>> {
    let (mut x, mut guess, mut thrusts) = (wanted(0.5 * HALF), vec![0.0; AHEAD], Vec::new());
    for n in 0..samples {
        let iterations = if n == 0 { 30 } else { 3 };
        let plan = ahead(n).improve(model, &x, guess, iterations)?;
        thrusts.push(plan[0]);
        x = model.step(&x, plan[0])?;
        guess = later(&plan);
    }
    Some(thrusts)
}

/// The plant by plans of the model from where it is, the first one from given thrusts; `see` is shown each thrust.
///
/// # Errors
/// Where a step or a plan is none.
pub fn by_plans(
    model: &Model,
    samples: usize,
    thrusts: &[f64],
    mut see: impl FnMut(f64),
) -> Result<Run, Box<dyn Error>> {
    let mut guess = thrusts[..AHEAD].to_vec();
    run(samples, |n, x| {
        let plan = ahead(n).improve(model, x, guess.clone(), 3)?;
        guess = later(&plan);
        see(plan[0]);
        Some(plan[0])
    })
}
