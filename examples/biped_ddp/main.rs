//! A biped steps forward by a plan through contacts: differential dynamic programming of first order (iLQR) over steps
//! of Coulomb's law, whose derivatives are those of `step_with_derivatives`. When a foot leaves the ground or lands,
//! and whether it slides, is found by the laws in each step; nothing prescribes it.
//!
//! `cargo run --release --example biped_ddp [-- FOLDER]` draws the picture and the page that plays into `FOLDER`, by
//! default `target/gauss`.

mod model;
mod page;
mod picture;
mod plan;
#[cfg(test)]
mod tests;

use std::error::Error;
use std::time::Instant;

use gauss_examples::plots::{write, write_page};

use model::{STEP, State, Torques, Walker};
use plan::{Looked, along, falls, guess, off, task};

fn main() -> Result<(), Box<dyn Error>> {
    let walker = Walker::new()?;
    let task = task();
    let first = guess(&walker, &task).ok_or("the first guess makes no way")?;

    println!("The gradient of the cost by all torques of the first guess, along some changes of them:\n");
    println!("  by derivatives of steps   by differences of runs");
    let mut apart = 0.0_f64;
    for seed in 0..4 {
        let [exact, difference] = along(&walker, &task, &first, seed);
        println!("{exact:>26.8} {difference:>24.8}");
        apart = apart.max((exact / difference - 1.0).abs());
    }

    let clock = Instant::now();
    let plan = task.solve(&walker, &first).ok_or("the first guess makes no way")?;
    let time = clock.elapsed();
    println!("\niteration   cost");
    let last = plan.costs.len() - 1;
    for (n, cost) in plan.costs.iter().enumerate().filter(|(n, _)| *n < 8 || n % 8 == 0 || *n == last) {
        println!("{n:>9}   {cost:.8}");
    }
    println!("{:.2} s, of which derivatives {:.2} s\n", time.as_secs_f64(), plan.in_derivatives.as_secs_f64());

    let way = task.way(&walker, &first);
    tell("first guess", &walker, &way, &first)?;
    let looked = tell("plan", &walker, &plan.states, &plan.inputs)?;
    for (foot, name) in ["left", "right"].into_iter().enumerate() {
        let each = looked.changes(foot).into_iter();
        let words =
            each.map(|(n, lands)| format!("{} at {:.3} s", if lands { "lands" } else { "leaves" }, n as f64 * STEP));
        println!("    the {name} foot {}", words.collect::<Vec<_>>().join(", "));
    }
    write("biped_ddp", &picture::draw(&task, (&way, &plan), &looked)?)?;
    write_page("biped_ddp", &page::page(&walker, &plan, &looked))?;

    let [place, speed] = off(&plan.states[task.steps]);
    if !falls(&plan.costs) || place > 0.01 || speed > 0.05 {
        return Err("the plan does not bring the biped to its goal".into());
    }
    // Differences of fourth order at 1e-5 N m: costs of 30 are rounded to some 1e-14 of them in each of 180 steps, and
    // slopes are some thousand.
    if apart > 1e-6 {
        return Err("the gradient is not that of differences".into());
    }
    Ok(())
}

/// Prints how a way ends and what its steps say.
fn tell(name: &str, walker: &Walker, states: &[State], inputs: &[Torques]) -> Result<Looked, Box<dyn Error>> {
    let looked = Looked::at(walker, states, inputs).ok_or("a step along the way is none")?;
    let [place, speed] = off(&states[inputs.len()]);
    println!("{name}: ends {place:.1e} m or rad from the goal, and {speed:.1e} m/s or rad/s;");
    println!(
        "    of {} steps {} are at a change of a mode; residuals of the laws up to {:.0e} m/s",
        inputs.len(),
        looked.at_change,
        looked.residual
    );
    Ok(looked)
}
