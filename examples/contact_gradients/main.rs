//! Derivatives through contact by four laws, beside the truth: what is right and what is not.
//!
//! `cargo run --release --example contact_gradients`. A cube is thrown along a table, pushed, dropped, as in Zhong, Han
//! and Brikis, *Differentiable physics simulations with contacts: do they have correct gradients with respect to
//! position, velocity and control?* (arXiv 2207.05060). Where it comes to rest is known in closed form, and so are the
//! derivatives of that.

mod laws;
mod model;
#[cfg(test)]
mod tests;

use laws::{LAWS, difference};
use model::THROWS;

const NAMES: [&str; 4] = ["speed", "height", "friction", "push"];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!(
        "d(place of rest)/d(number); in brackets what differences of the law itself say, where it is another one\n"
    );
    print!("{:<18}{:<10}{:>9}", "throw", "by", "truth");
    LAWS.iter().for_each(|(name, _)| print!("{name:>21}"));
    println!();
    let mut wrong = [0; LAWS.len()];
    for throw in &THROWS {
        let truth = throw.exact();
        let found = LAWS.iter().map(|(_, law)| law(&throw.varied())).collect::<Result<Vec<_>, _>>()?;
        for &k in throw.by {
            print!("{:<18}{:<10}{:>9.4}", throw.name, NAMES[k], truth.slopes[k]);
            for (n, (_, law)) in LAWS.iter().enumerate() {
                let (slope, own) = (found[n].slopes[k], difference(*law, throw, k)?);
                // Two percent of what such a derivative is, or of a millimetre in a unit.
                let off = |a: f64, b: f64| (a - b).abs() > 0.02 * b.abs().max(0.05);
                wrong[n] += usize::from(off(slope, truth.slopes[k]));
                let mark = if off(slope, truth.slopes[k]) { "✗" } else { " " };
                let own = if off(own, slope) { format!("({own:.3})") } else { String::new() };
                print!("{slope:>10.4}{mark}{own:>10}");
            }
            println!();
        }
        print!("{:<28}{:>9.4}", "  rests at, m", truth.value);
        found.iter().for_each(|x| print!("{:>10.4}{:>11}", x.value, ""));
        println!("\n");
    }
    let counts: Vec<String> = LAWS.iter().zip(wrong).map(|((name, _), wrong)| format!("{name} {wrong}")).collect();
    println!("wrong: {} of {}", counts.join(", "), THROWS.iter().map(|throw| throw.by.len()).sum::<usize>());
    // From event to event all are right; a step does not know when within it a body lands.
    if wrong[0] != 0 || wrong[1] != 1 {
        return Err("derivatives are not what the guide says".into());
    }
    Ok(())
}
