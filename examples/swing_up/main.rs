//! Trajectories that are found: a pole swung up by its cart and an arm that reaches, by differential dynamic
//! programming with the exact derivatives that `linearize` generates, of first order (iLQR) and with the second ones of
//! `hessian`, beside a run with finite differences.
//!
//! `cargo run --release --example swing_up [-- FOLDER]` draws into `FOLDER`, by default `target/gauss`.

use std::error::Error;
use std::f64::consts::PI;
use std::time::{Duration, Instant};

use gauss_charts::drawing::COLOURS;
use gauss_examples::ddp::{Plan, Task, Vector};
use gauss_examples::plots::{Line, Plot, sheet, write, write_page};
use gauss_examples::stage;
use gauss_playback::Playback;
use gauss_runtime::prelude::*;

mod check;
mod model;
mod second;

use model::{Arm, CartPole, CartPoleKernel, Differences, Exact, Scalar, joined, parts};
use second::Second;

fn main() -> Result<(), Box<dyn Error>> {
    if cfg!(debug_assertions) {
        println!("Times of a program that is not optimised say nothing: run it with --release.\n");
    }
    let plots = swing_up()?;
    reach()?;
    write("swing_up", &sheet("A pole swung up", (1600, 1200), &plots)?)
}

/// Ways to the same plan, and how long they took.
struct Ways<const D: usize, const U: usize> {
    plans: [(Plan<D, U>, Duration); 3],
}

const WAYS: [&str; 3] = ["first order", "second order", "differences"];

impl<const D: usize, const U: usize> Ways<D, U> {
    fn find<K: Scalar<N, D, U>, const N: usize>(
        task: &Task<D, U>,
        kernel: &K,
        h: f64,
        guess: &[Vector<U>],
    ) -> Result<Self, Box<dyn Error>> {
        let exact = || Exact::<K, N> { kernel, h };
        check::second_order(&Second(exact()), &task.start, &guess[0])?;
        let timed = |plant: &dyn Fn() -> Option<Plan<D, U>>| {
            let start = Instant::now();
            plant().map(|plan| (plan, start.elapsed())).ok_or("the first guess leaves all bounds")
        };
        let first = timed(&|| task.solve(&exact(), guess))?;
        let second = timed(&|| task.solve(&Second(exact()), guess))?;
        let differences = timed(&|| task.solve(&Differences(exact()), guess))?;
        check::times(kernel, &task.start, &guess[0]);
        Ok(Self { plans: [first, second, differences] })
    }

    fn report(&self) {
        println!("derivatives          iterations   final cost   time, ms   of which derivatives");
        for (name, (plan, time)) in WAYS.into_iter().zip(&self.plans) {
            let (iterations, cost) = (plan.costs.len() - 1, plan.costs[plan.costs.len() - 1]);
            let [all, derivatives] = [*time, plan.in_derivatives].map(|time| 1e3 * time.as_secs_f64());
            println!("{name:<20} {iterations:>10} {cost:>12.8} {all:>10.1} {derivatives:>22.1}");
        }
    }

    fn agree(&self) -> bool {
        let [a, b, c] = [0, 1, 2].map(|k| self.plans[k].0.costs[self.plans[k].0.costs.len() - 1]);
        (a - b).abs() <= 1e-6 * a && (a - c).abs() <= 1e-6 * a
    }
}

const H: f64 = 0.02;
const STEPS: usize = 125;
const END: f64 = H * STEPS as f64;

/// The pole hangs; in two and a half seconds it is to stand, the cart where it was.
fn swing_up() -> Result<Vec<Vec<Plot<'static>>>, Box<dyn Error>> {
    println!("A POLE SWUNG UP BY ITS CART\n");
    let kernel = CartPole { cart: 1.0, bob: 0.3, length: 0.5, g: 9.81 }.kernel()?;
    let task = Task {
        start: Vector::from([0.0, PI, 0.0, 0.0]),
        goal: Vector::zeros(),
        effort: Vector::from([0.01 * H]),
        on_the_way: Vector::from([0.1, 0.1, 0.01, 0.01]) * H,
        at_the_end: Vector::from([200.0, 500.0, 50.0, 50.0]),
        steps: STEPS,
    };
    let guess: Vec<_> = (0..STEPS).map(|k| Vector::from([(0.1 * k as f64).sin()])).collect();
    let ways = Ways::find(&task, &kernel, H, &guess)?;
    ways.report();
    let (plan, _) = &ways.plans[0];

    let (way, end) = replay(&kernel, plan, 0.0, false)?;
    let most = plan.inputs.iter().map(|u| u[0].abs()).fold(0.0, f64::max);
    let off = |angle: f64, regulated: bool| replay(&kernel, plan, angle, regulated).map(|(_, x)| x.rows(0, 2).amax());
    let [open, regulated] = [off(0.1, false)?, off(0.1, true)?];
    println!("\nafter {END:.1} s: angle {:.1e} rad, cart {:.1e} m; pushes of up to {most:.1} N", end[1], end[0]);
    println!("started 0.1 rad beside: off by {open:.1e}, with the regulator that was found too by {regulated:.1e}\n");
    if !ways.agree() || end.amax() > 0.05 || regulated > 0.05 {
        return Err("the pole was not swung up".into());
    }
    write_page("swing_up", &page(&kernel, plan, &way))?;
    let [pole, cart, push] = plots_of_way(&way, plan);
    Ok(vec![vec![pole, cart], vec![push, plot_of_costs(&ways)]])
}

/// Where it was, and the state at the end.
type Replay = (Vec<Sample<CartPoleKernel>>, Vector<4>);

/// The equations themselves, by an integrator that chooses its steps, under the pushes that were found, from a start
/// that is `beside` in the angle.
fn replay(kernel: &CartPoleKernel, plan: &Plan<4, 1>, beside: f64, regulated: bool) -> Result<Replay, Box<dyn Error>> {
    let (mut x, mut way) = (plan.states[0] + Vector::from([0.0, beside, 0.0, 0.0]), Vec::new());
    for (k, push) in plan.inputs.iter().enumerate() {
        let regulation = if regulated { plan.gains[k] * (x - plan.states[k]) } else { Vector::zeros() };
        let held = |_: f64, _: &Vector<2>, _: &Vector<2>| push + regulation;
        let (q, z) = parts::<2, 4>(&x);
        let run = Simulation::new(kernel).input(held).adaptive(1e-11, 1e-11).run(q, z, 0.0..H)?;
        // Each interval begins at time zero; the last state of one is the first of the next.
        way.extend(run.iter().skip(usize::from(k > 0)).map(|s| Sample { t: k as f64 * H + s.t, ..*s }));
        x = joined(&run.last().q, &run.last().z);
    }
    Ok((way, x))
}

fn plots_of_way(way: &[Sample<CartPoleKernel>], plan: &Plan<4, 1>) -> [Plot<'static>; 3] {
    let [blue, orange, green] = [COLOURS[0], COLOURS[1], COLOURS[2]];
    let coordinate = |colour, k: usize| Line::new("", colour, way.iter().map(|s| (s.t, s.q[k])));
    let pushes = plan.inputs.iter().enumerate().flat_map(|(k, u)| [k, k + 1].map(|n| (n as f64 * H, u[0])));
    let over_time = |title, unit, ends, line| Plot::new(title, ("time, s", 0.0..END), (unit, ends), vec![line]);
    [
        over_time("The pole", "angle from upright, rad", -1.0..4.0, coordinate(blue, 1)),
        over_time("The cart", "place, m", -1.0..1.0, coordinate(orange, 0)),
        over_time("The push", "N", -20.0..20.0, Line::new("", green, pushes).wide(3)),
    ]
}

/// The pole as it is swung up, and the push on the cart.
fn page(kernel: &CartPoleKernel, plan: &Plan<4, 1>, way: &[Sample<CartPoleKernel>]) -> Playback<CartPoleKernel> {
    let push = |s: &Sample<CartPoleKernel>| plan.inputs[((s.t / H) as usize).min(STEPS - 1)][0];
    let page = Playback::of_samples("A pole swung up by its cart", way.to_vec()).si();
    stage::cart_and_pole(page, 0.5, 0.05, push).energy(kernel)
}

/// Above the least cost that was found, as far as rounding of costs lets it be told.
fn plot_of_costs(ways: &Ways<4, 1>) -> Plot<'static> {
    let costs = |k: usize| ways.plans[k].0.costs.iter().copied();
    let least = (0..WAYS.len()).flat_map(costs).fold(f64::INFINITY, f64::min);
    let curve = |k: usize| {
        let above = costs(k).map(|cost| (cost - least).max(1e-12).log10());
        Line::new(WAYS[k], COLOURS[k], above.enumerate().map(|(n, cost)| (n as f64, cost)))
    };
    let longest = (0..WAYS.len()).map(|k| costs(k).count()).max().unwrap_or(1);
    Plot::new(
        "What the plan costs, above the best",
        ("iteration", 0.0..longest as f64),
        ("log₁₀ of the difference", -12.0..4.0),
        vec![curve(0), curve(1), curve(2).dashed()],
    )
}

/// Seven angles, then two fingers, which are light; of a state places and then rates.
fn by_joint<const N: usize>(arm: f64, finger: f64) -> Vector<N> {
    Vector::from_fn(|k, _| if k % 9 < 7 { arm } else { finger })
}

/// An arm from its file reaches across in 0.8 s and stands: 18 states, 9 efforts.
fn reach() -> Result<(), Box<dyn Error>> {
    println!("AN ARM REACHES ACROSS\n");
    let (kernel, h, steps) = (Arm.kernel()?, 0.02, 40);
    let [from, to] =
        [[0.0, -0.4, 0.0, -1.8, 0.0, 1.6, 0.8, 0.02, 0.02], [1.2, 0.4, 0.2, -1.2, 0.3, 1.8, 0.0, 0.03, 0.03]];
    let at_rest = |q: [f64; 9]| joined::<9, 18>(&q.into(), &Vector::zeros());
    let task = Task {
        start: at_rest(from),
        goal: at_rest(to),
        effort: by_joint(1e-3, 1e-2) * h,
        on_the_way: by_joint(0.01, 1.0) * h,
        at_the_end: by_joint(1e3, 1e5),
        steps,
    };
    // The first guess holds the arm where it is.
    let held = kernel.inverse_dynamics(0.0, &from.into(), &Vector::zeros(), &Vector::zeros(), &Vector::zeros());
    let ways = Ways::find(&task, &kernel, h, &vec![held; steps])?;
    ways.report();
    let end = ways.plans[0].0.states[steps] - task.goal;
    println!(
        "\nat the end off by {:.1e} rad or m, and {:.1e} in a second",
        end.rows(0, 9).amax(),
        end.rows(9, 9).amax()
    );
    if !ways.agree() || end.amax() > 0.02 {
        return Err("the arm did not get there".into());
    }
    Ok(())
}
