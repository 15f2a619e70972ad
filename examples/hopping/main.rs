//! Jumps and hand-overs: a runner on a springy leg, whose flights and stances are two kernels, and a ball that bounces
//! until infinitely many impacts have piled up, and rests.
//!
//! `cargo run --release --example hopping [-- FOLDER]` draws the picture into `FOLDER`, by default `target/gauss`.

mod model;
mod picture;
#[cfg(test)]
mod tests;

use gauss_contact::{ContactRun, EventKind};
use gauss_examples::plots::{write, write_page};
use gauss_tables::Table;

use model::{Ball, Runner};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let runner = Runner::human();
    println!(
        "A runner of {} kg on a leg of {} kN/m, put down at {:.0}°, at 5 m/s:\n",
        runner.m,
        1e-3 * runner.k,
        runner.attack.to_degrees()
    );
    let run = runner.run(1.0, 5.0, 30)?;
    println!("  step   apex, m      speed, m/s   on the ground, s   energy, J");
    for (n, step) in run.steps.iter().enumerate().filter(|(n, _)| *n < 6 || n % 8 == 5) {
        let (_, [_, height], [speed, _]) = step.apex;
        let (down, off) = (step.touchdown.0, step.liftoff.0);
        let energy = runner.energy(step.apex);
        println!("  {n:>4}   {height:.9}  {speed:.8}   {:.9}        {energy:.8}", off - down);
    }
    let lost = run.steps.iter().map(|step| runner.energy(step.apex) - runner.energy(run.steps[0].apex));
    println!("  {} hand-overs, energy within {:.0e} J", 3 * run.steps.len(), lost.map(f64::abs).fold(0.0, f64::max));
    let flat = Runner { attack: 60.0_f64.to_radians(), ..runner }.run(1.0, 5.0, 30)?;
    println!(
        "  with the leg at 60° it {} after {} steps\n",
        if flat.stumbled { "falls" } else { "runs" },
        flat.steps.len()
    );

    let ball = Ball { m: 0.1, g: 9.81 }.kernel()?;
    let bounces = ContactRun::new(&ball).adaptive(1e-10, 1e-12).run([1.0].into(), [0.0].into(), 0.0..3.0)?;
    let impacts = bounces.events().iter().filter(|event| matches!(event.kind, EventKind::Impact(_))).count();
    let rest = bounces.events().last().ok_or("it never lands")?;
    // Flights are 0.7 as long from impact to impact.
    let rests = (2.0_f64 / 9.81).sqrt() * (1.0 + 2.0 * 0.7 / 0.3);
    println!("A ball that keeps 0.7 of its speed: {impacts} impacts, then rest at {:.9} s, as it should", rest.time);
    println!("at {rests:.9} s. The force of the floor is its weight then.");
    let table = Table::new(bounces.at_times((0..=6).map(|n| 0.5 * f64::from(n)))?);
    let table =
        table.column("height", |s| s.q[0]).contacts(&ball, |s| Some(*bounces.forces(s.t).ok()?)).energies(&ball);
    print!("\n{table}");
    write("hopping", &picture::draw(&runner, &run, &ball, &bounces)?)?;
    write_page("hopping", &picture::page(&runner, &run)?)
}
