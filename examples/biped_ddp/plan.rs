//! The step forward that is planned, and what plans are looked at for.

use std::f64::consts::PI;

use gauss_contact::Mode;
use gauss_examples::ddp::{Plant, Task, Vector};
use gauss_runtime::prelude::ContactSystem;

use crate::model::{LENGTH, STEP, State, Torques, Walker};

/// Of the hip above the ground, and of a foot before or behind it where it stands, m.
const HEIGHT: f64 = 0.54;
const STRIDE: f64 = 0.12;
/// By which parts of the time the right leg swings in the first guess, and how high, m.
const SWING: (f64, f64) = (0.35, 0.85);
const LIFT: f64 = 0.06;
/// How many steps in time there are.
pub const STEPS: usize = 180;

/// Angles of hip and knee that bring a foot so far forward of and below its hip, m.
fn leg(forward: f64, below: f64) -> [f64; 2] {
    let reach = forward.hypot(below).min(1.99 * LENGTH);
    let knee = 2.0 * (reach / (2.0 * LENGTH)).acos();
    [-forward.atan2(below) - 0.5 * knee, knee]
}

/// At rest, with the hip at a place and feet so far forward of it.
fn standing(x: f64, left: f64, right: f64) -> State {
    let ([a, b], [c, d]) = (leg(left, HEIGHT), leg(right, HEIGHT));
    State::from_column_slice(&[x, HEIGHT, 0.0, a, b, c, d, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
}

/// From both feet on the ground, the left one before the right one, to the same in a mirror, a stride ahead. Nothing
/// says when a foot leaves the ground or lands.
#[must_use]
pub fn task() -> Task<14, 4> {
    let places = |place: f64, angle: f64, joint: f64| [place, place, angle, joint, joint, joint, joint];
    let weights = |at: [f64; 7], speed: f64| State::from_fn(|i, _| if i < 7 { at[i] } else { speed * at[i - 7] });
    Task {
        start: standing(0.0, STRIDE, -STRIDE),
        goal: standing(2.0 * STRIDE, -STRIDE, STRIDE),
        effort: Vector::repeat(1e-2 * STEP),
        on_the_way: weights(places(0.0, 2.0, 0.5), 0.02) * STEP,
        at_the_end: weights(places(4000.0, 1000.0, 1000.0), 0.02),
        steps: STEPS,
    }
}

/// Torques of springs at the joints toward a hip that moves ahead and then a right leg that swings; the left hip holds
/// the trunk meanwhile. They carry the biped beyond the goal.
pub fn guess(walker: &Walker, task: &Task<14, 4>) -> Option<Vec<Torques>> {
    let (mut x, mut torques) = (task.start, Vec::new());
    let smooth = |part: f64| 0.5 - 0.5 * (PI * part.clamp(0.0, 1.0)).cos();
    for n in 0..task.steps {
        let part = (n as f64 + 1.0) / task.steps as f64;
        let (hip, swing) = (2.0 * STRIDE * smooth(part / 0.9), (part - SWING.0) / (SWING.1 - SWING.0));
        let lift = LIFT * (PI * swing.clamp(0.0, 1.0)).sin();
        let left = leg(STRIDE - hip, HEIGHT);
        let right = leg(STRIDE * (4.0 * smooth(swing) - 1.0) - hip, HEIGHT - lift);
        let wanted = [left[0], left[1], right[0], right[1]];
        let mut u = Torques::from_fn(|k, _| 300.0 * (wanted[k] - x[3 + k]) - 3.0 * x[10 + k]);
        if (0.0..1.0).contains(&swing) {
            u[0] = 200.0 * x[2] + 20.0 * x[9] - u[2];
        }
        x = walker.step(&x, &u);
        torques.push(u);
    }
    x.iter().all(|x| x.is_finite()).then_some(torques)
}

/// What the contacts of a plan do.
#[derive(Clone, Debug, Default)]
pub struct Looked {
    /// The worst residual of the laws in all steps, m/s.
    pub residual: f64,
    /// Steps that are at a change of a mode, where derivatives are one-sided.
    pub at_change: usize,
    /// What both feet do in each step, and their impulses: along the normal and forward, N s.
    pub modes: Vec<[Mode; 2]>,
    pub impulses: Vec<[[f64; 2]; 2]>,
    /// Both toes after each step: forward and up, m.
    pub toes: Vec<[[f64; 2]; 2]>,
}

impl Looked {
    /// The steps along these states once more; `None` where one is none.
    pub fn at(walker: &Walker, states: &[State], inputs: &[Torques]) -> Option<Self> {
        let mut looked = Self::default();
        for (x, u) in states.iter().zip(inputs) {
            let mut stepper = walker.stepper(x)?;
            let step = walker.linear(&mut stepper, u)?;
            let laws = step.report.residual;
            looked.residual = looked.residual.max(laws.signorini).max(laws.coulomb).max(laws.dissipation);
            looked.at_change += usize::from(step.at_change.is_some());
            looked.modes.push([stepper.modes()[0], stepper.modes()[1]]);
            let impulses = stepper.impulses();
            looked.impulses.push([[impulses[0], impulses[1]], [impulses[2], impulses[3]]]);
            let toe = |i: usize| {
                let frame = walker.plain.contact_frame(i, stepper.time(), stepper.configuration());
                frame.map(|frame| [frame.point.x, frame.point.z])
            };
            looked.toes.push([toe(0)?, toe(1)?]);
        }
        Some(looked)
    }

    /// When a foot changes between the ground and the air: the number of the step, and whether it is on the ground
    /// then.
    #[must_use]
    pub fn changes(&self, foot: usize) -> Vec<(usize, bool)> {
        let closed = |n: usize| self.modes[n][foot].is_closed();
        (1..self.modes.len()).filter(|n| closed(*n) != closed(n - 1)).map(|n| (n, closed(n))).collect()
    }
}

/// Whether costs fall from iteration to iteration, but for what rounding leaves of the last differences.
#[must_use]
pub fn falls(costs: &[f64]) -> bool {
    costs.windows(2).all(|pair| pair[1] <= pair[0] * (1.0 + 1e-12)) && costs.first() > costs.last()
}

/// How far a state is from the goal: the largest difference of coordinates, and of their rates.
#[must_use]
pub fn off(end: &State) -> [f64; 2] {
    let off = end - task().goal;
    [off.fixed_rows::<7>(0).amax(), off.fixed_rows::<7>(7).amax()]
}

/// The derivative of the cost along a change of all inputs: by those of steps, and by differences of whole runs, of
/// fourth order.
pub fn along(walker: &Walker, task: &Task<14, 4>, inputs: &[Torques], seed: usize) -> [f64; 2] {
    let change: Vec<_> =
        (0..inputs.len()).map(|n| Torques::from_fn(|k, _| ((7 * n + 3 * k + 5 * seed) as f64).sin())).collect();
    let slopes = task.slopes(walker, &task.way(walker, inputs), inputs);
    let exact = slopes.iter().zip(&change).map(|(slope, change)| slope.dot(change)).sum();
    let at = |by: f64| {
        let moved: Vec<Torques> = inputs.iter().zip(&change).map(|(u, change)| u + change * by).collect();
        task.cost(&task.way(walker, &moved), &moved)
    };
    let h = 1e-5;
    [exact, (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h)]
}
