//! The picture: the first guess and the plan as sticks, heights of the feet, forces of the ground, costs.

use std::error::Error;

use gauss_charts::drawing::{COLOURS, INK, PALE};
use gauss_examples::ddp::{Plan, Task};
use gauss_examples::plots::{Line, Plot, mosaic};

use crate::model::{LENGTH, STEP, State};
use crate::plan::Looked;

/// Draws all panels.
///
/// # Errors
/// When a panel cannot be laid out.
pub fn draw(
    task: &Task<14, 4>,
    (guess, plan): (&[State], &Plan<14, 4>),
    looked: &Looked,
) -> Result<String, Box<dyn Error>> {
    let end = STEP * task.steps as f64;
    let sticks = [sticks("The first guess goes on and leans", guess), sticks("The plan", &plan.states)];
    let [guess, planned] = sticks;
    let panels = [
        ([0, 0, 800, 620], guess),
        ([800, 0, 800, 620], planned),
        ([0, 630, 530, 480], heights(end, looked)),
        ([530, 630, 540, 480], forces(end, looked)),
        ([1070, 630, 530, 480], costs(&plan.costs)),
    ];
    mosaic("A step forward that is planned through contacts", (1600, 1210), &panels)
}

/// Hip, trunk and both legs, each 90 ms; the left leg in the first colour.
fn sticks(title: &'static str, states: &[State]) -> Plot<'static> {
    let mut lines = vec![Line::new("", INK, [(-0.35, 0.0), (0.65, 0.0)]).wide(3)];
    let shown = |n: usize| n.is_multiple_of(18) || n + 1 == states.len();
    for (n, x) in states.iter().enumerate().filter(|(n, _)| shown(*n)) {
        let whole = n == 0 || n + 1 == states.len();
        let from =
            |(x, z): (f64, f64), length: f64, angle: f64| (x - length * f64::sin(angle), z - length * f64::cos(angle));
        let hip = (x[0], x[1]);
        let wide = if whole { 6 } else { 2 };
        for (k, colour) in [(5, COLOURS[1]), (3, COLOURS[0])] {
            let knee = from(hip, LENGTH, x[2] + x[k]);
            let toe = from(knee, LENGTH, x[2] + x[k] + x[k + 1]);
            let name = match (n, k) {
                (0, 3) => "left leg",
                (0, _) => "right leg",
                _ => "",
            };
            lines.push(Line::new(name, colour, [hip, knee, toe]).wide(wide));
        }
        lines.push(Line::new("", INK, [hip, from(hip, -0.4, x[2])]).wide(wide));
    }
    Plot::new(title, ("forward, m", -0.35..0.65), ("m", -0.05..1.05), lines).to_scale()
}

fn heights(end: f64, looked: &Looked) -> Plot<'static> {
    let of = |foot: usize| {
        looked.toes.iter().enumerate().map(move |(n, toes)| ((n + 1) as f64 * STEP, 100.0 * toes[foot][1]))
    };
    let lines = vec![Line::new("left", COLOURS[0], of(0)), Line::new("right", COLOURS[1], of(1))];
    Plot::new("Feet", ("time, s", 0.0..end), ("height, cm", 0.0..8.0), lines)
}

fn forces(end: f64, looked: &Looked) -> Plot<'static> {
    let of = |foot: usize| {
        looked.impulses.iter().enumerate().map(move |(n, both)| ((n + 1) as f64 * STEP, both[foot][0] / STEP))
    };
    let weight = 9.81 * 14.6;
    let lines = vec![
        Line::new("", PALE, [(0.0, weight), (end, weight)]).wide(3),
        Line::new("left", COLOURS[0], of(0)),
        Line::new("right", COLOURS[1], of(1)),
    ];
    Plot::new("Forces of the ground", ("time, s", 0.0..end), ("force upward, N", 0.0..900.0), lines)
}

fn costs(costs: &[f64]) -> Plot<'static> {
    let points = costs.iter().enumerate().map(|(n, cost)| (n as f64, cost.log10()));
    let line = Line::new("", COLOURS[2], points);
    Plot::new("What the plan costs", ("iteration", 0.0..costs.len() as f64), ("log₁₀ of it", -1.0..3.0), vec![line])
}
