//! A pole balanced by model-predictive control with a motor that can push so hard and no harder:
//! `cargo run --release --example mpc_step`.
//!
//! The derivatives of a whole step, exact ones, are the model of the sampled plant. Without limits the first push of
//! the plan is that of the discrete regulator; with limits the conditions of Kuhn and Tucker say that the plan is the
//! best one.

use std::error::Error;

use gauss_examples::plots::write_page;
use gauss_examples::stage;
use gauss_playback::Playback;
use gauss_runtime::prelude::*;

/// A cart on a rail, and a pole on its hinge; the angle is from upright.
#[derive(GaussDynamics)]
#[gauss(
    linearize,
    coordinates(x, theta),
    particle(mass = cart, position = [x, 0, 0]),
    particle(mass = bob, position = [x + length * sin(theta), 0, length * cos(theta)]),
    input(push),
    drive(x = push),
)]
struct CartPole {
    cart: f64,
    bob: f64,
    length: f64,
    #[gauss(gravity)]
    g: f64,
}

/// Pushes that are planned.
const AHEAD: usize = 20;
/// Seconds between two of them.
const SAMPLE: f64 = 0.05;

type State = SVector<f64, 4>;
type Square = SMatrix<f64, 4, 4>;
type Plan = SVector<f64, AHEAD>;

/// x⁺ = A x + B u; the cost is the sum of xᵀ Q x + r u², and xᵀ P x of what is left at the end.
struct Plant {
    a: Square,
    b: State,
    q: Square,
    r: f64,
}

impl Plant {
    /// P of the discrete Riccati equation, and the gains K of u = −K x, by going backwards until nothing changes.
    fn regulator(&self) -> (Square, SMatrix<f64, 1, 4>) {
        let Self { a, b, q, r } = self;
        let mut p = *q;
        loop {
            let gains = b.transpose() * p * a / (r + (b.transpose() * p * b)[0]);
            let next = q + a.transpose() * p * (a - b * gains);
            let change = (next - p).amax();
            p = (next + next.transpose()) * 0.5;
            if change <= 1e-12 * p.amax() {
                return (p, gains);
            }
        }
    }

    /// The cost of a plan U from x as ½ Uᵀ H U + Uᵀ F x: H and F, once for all x.
    // ANCHOR: condensed
    fn condensed(&self, end: &Square) -> (SMatrix<f64, AHEAD, AHEAD>, SMatrix<f64, AHEAD, 4>) {
        let (mut hessian, mut slope) = (SMatrix::identity() * (2.0 * self.r), SMatrix::zeros());
        // What each push so far has done to x, and what x at first has.
        let (mut pushed, mut free) = (SMatrix::<f64, 4, AHEAD>::zeros(), Square::identity());
        for k in 0..AHEAD {
            pushed = self.a * pushed;
            pushed.set_column(k, &self.b);
            free = self.a * free;
            let weight = if k + 1 == AHEAD { end } else { &self.q };
            hessian += pushed.transpose() * weight * pushed * 2.0;
            slope += pushed.transpose() * weight * free * 2.0;
        }
        (hessian, slope)
    }
    // ANCHOR_END: condensed
}

/// The least ½ Uᵀ H U + Uᵀ f with every push within the limit. Pushes at the limit are held: the others go to their
/// best as far as the next limit; when they are there, the held one that pulls back most is let go. H is positive
/// definite, so that ends.
fn best(hessian: &SMatrix<f64, AHEAD, AHEAD>, f: &Plan, limit: f64) -> Option<Plan> {
    let (mut plan, mut held) = (Plan::zeros(), [false; AHEAD]);
    for _ in 0..1000 {
        let slope = hessian * plan + f;
        let (mut free, mut right) = (*hessian, -slope);
        for k in (0..AHEAD).filter(|&k| held[k]) {
            free.fill_row(k, 0.0);
            free.fill_column(k, 0.0);
            (free[(k, k)], right[k]) = (1.0, 0.0);
        }
        let step = free.cholesky()?.solve(&right);
        // How much of the step there is room for, and who stops it.
        let room = |k: usize| (limit * step[k].signum() - plan[k]) / step[k];
        let stops = (0..AHEAD).filter(|&k| !held[k] && step[k] != 0.0).min_by(|&i, &j| room(i).total_cmp(&room(j)));
        match stops.filter(|&k| room(k) < 1.0) {
            Some(k) => {
                plan += step * room(k);
                (plan[k], held[k]) = (limit * step[k].signum(), true);
            }
            None => {
                plan += step;
                let pull = |k: usize| (hessian.row(k) * plan + f.row(k))[0] * plan[k].signum();
                let back = (0..AHEAD).filter(|&k| held[k]).max_by(|&i, &j| pull(i).total_cmp(&pull(j)));
                match back.filter(|&k| pull(k) > 1e-12 * f.amax()) {
                    Some(k) => held[k] = false,
                    None => return Some(plan),
                }
            }
        }
    }
    None
}

fn main() -> Result<(), Box<dyn Error>> {
    let kernel = CartPole { cart: 1.0, bob: 0.2, length: 0.6, g: 9.81 }.kernel()?;
    let (upright, still, none) = (SVector::zeros(), SVector::zeros(), SVector::zeros());
    let step = CommutatorFree4.step_linearized(&kernel, 0.0, &upright, &still, &none, SAMPLE)?;
    let weights = Square::from_diagonal(&State::new(1.0, 10.0, 1.0, 1.0));
    let plant = Plant { a: step.by_state, b: step.by_input.column(0).into(), q: weights, r: 0.1 };
    let (end, gains) = plant.regulator();
    let (hessian, slope) = plant.condensed(&end);

    // Without limits the plan begins as the regulator does.
    let x = State::new(0.1, 0.02, -0.1, 0.05);
    let plan = best(&hessian, &(slope * x), 1e3).ok_or("no plan")?;
    let [free, regulated] = [plan[0], -(gains * x)[0]];
    println!("first push without limits: {free:.6} N; of the regulator {regulated:.6} N");
    if (free - regulated).abs() > 1e-6 * regulated.abs() {
        return Err("the plan is not that of the regulator".into());
    }

    // The true cart, pushed by no more than 4 N; a push holds for a sample.
    let (limit, (mut worst, mut at_limit, mut samples)) = (4.0, (0.0_f64, 0, 0));
    println!("   t/s    x/m  θ/rad  push/N");
    let run = Simulation::new(&kernel)
        .sampled(SAMPLE, |t, q, z| {
            let f = slope * State::new(q[0], q[1], z[0], z[1]);
            // What is no number ends the run.
            let Some(plan) = best(&hessian, &f, limit) else { return SVector::from([f64::NAN]) };
            // Kuhn and Tucker: no slope inside the limits, and at a limit one that pushes against it.
            for (push, slope) in plan.iter().zip(&(hessian * plan + f)) {
                let wrong = if push.abs() < limit { slope.abs() } else { (slope * push.signum()).max(0.0) };
                worst = worst.max(wrong / f.amax());
            }
            at_limit += usize::from(plan[0].abs() == limit);
            if samples % 20 == 0 {
                println!("  {t:4.1} {:6.3} {:6.3} {:7.3}", q[0], q[1], plan[0]);
            }
            samples += 1;
            SVector::from([plan[0]])
        })
        .adaptive(1e-9, 1e-9)
        .run(SVector::from([0.0, 0.3]), still, 0.0..160.0 * SAMPLE)?;
    let (q, z) = (run.last().q, run.last().z);
    println!("at the limit for {at_limit} samples; worst residual of the conditions {worst:.0e}");
    if at_limit < 3 || worst > 1e-9 || q.amax() > 1e-2 || z.amax() > 1e-2 {
        return Err("the pole is not balanced by best plans".into());
    }
    let page = Playback::new("A pole balanced by plans, with at most 4 N", &run)?.si();
    let push = |s: &Sample<CartPoleKernel>| run.input(s.t, &s.q, &s.z)[0];
    write_page("mpc_step", &stage::cart_and_pole(page, 0.6, 0.1, push).energy(&kernel))
}
