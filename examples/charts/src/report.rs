//! The text of the comparison: tables and the sentences that they support.

use std::fmt::{self, Write};

use crate::measure::{
    Comparison, EVERYDAY_STEP, Fleet, PRECISE_RATE, energy_drift, largest_difference, largest_energy_drift,
    momenta_with_the_same_bits, momentum_drift, reversals, symmetric_momentum_drift,
};
use crate::simulate::{Run, Vessel};
use crate::timing::Timing;

/// Lines of equations longer than this are cut; the file that is written has all of them.
const WIDTH: usize = 118;

/// Everything that is printed before anything is run.
///
/// # Errors
/// Never: strings take all that is written.
pub fn introduction(fleet: &Fleet) -> Result<String, fmt::Error> {
    let mut text = String::new();
    writeln!(text, "KIRCHHOFF AGAINST NEWTON AND EULER\n")?;
    writeln!(
        text,
        "The REMUS 100 (a 1.33 m torpedo; Prestero 2001) in an ideal fluid: weight, buoyancy and the full added mass, no"
    )?;
    writeln!(
        text,
        "drag, no fins, motor off. One struct of parameters, four charts, one word changed between them:\n"
    )?;
    writeln!(text, "    #[derive(GaussDynamics)]")?;
    writeln!(text, "    #[gauss(chart = left_invariant)]   // right_invariant | hybrid | jet(euler_zyx)\n")?;
    writeln!(text, "Nobody typed an equation of motion. These were derived while the program was compiled:\n")?;
    equations(&mut text, "Kirchhoff", &fleet.kirchhoff, |_| true)?;
    equations(&mut text, "Newton–Euler", &fleet.newton_euler, |_| true)?;
    // Of the others, the balance of momenta: that is where they differ.
    equations(&mut text, "hybrid", &fleet.hybrid, is_balance)?;
    equations(&mut text, "Lagrange (ψ, θ, φ)", &fleet.lagrange, is_balance)?;
    Ok(text)
}

/// Whether a paragraph of equations says how momenta change.
fn is_balance(paragraph: &str) -> bool {
    paragraph.to_lowercase().contains("gauss condition")
}

fn equations<K: Vessel>(text: &mut String, name: &str, _: &K, keep: impl Fn(&str) -> bool) -> fmt::Result {
    heading(text, name)?;
    // The first paragraph names the variables.
    let paragraphs = K::EQUATIONS.text.trim().split("\n\n");
    for paragraph in paragraphs.enumerate().filter(|(n, paragraph)| *n == 0 || keep(paragraph)).map(|(_, p)| p) {
        paragraph.lines().try_for_each(|line| writeln!(text, "{}", cut(line)))?;
        writeln!(text)?;
    }
    Ok(())
}

/// A line across with words in it.
fn heading(text: &mut String, words: &str) -> fmt::Result {
    writeln!(text, "── {words} {}", "─".repeat(WIDTH.saturating_sub(words.chars().count() + 4)))
}

/// The line, or what fits of it, ended at a space.
fn cut(line: &str) -> String {
    if line.chars().count() <= WIDTH {
        return line.into();
    }
    let fits: String = line.chars().take(WIDTH - 2).collect();
    let end = fits.rfind(' ').unwrap_or(fits.len());
    format!("{} …", fits[..end].trim_end_matches([' ', '+', '-', '−', '·', '*']))
}

/// All equations of all charts, uncut, and what every generated function costs.
///
/// # Errors
/// Never: strings take all that is written.
pub fn all_equations(fleet: &Fleet) -> Result<String, fmt::Error> {
    fn one<K: Vessel>(text: &mut String, name: &str, _: &K) -> fmt::Result {
        let line = "─".repeat(60);
        writeln!(text, "{name}\n{line}\n{}\n\noperations\n{}\n", K::EQUATIONS.text.trim(), K::OPERATIONS)?;
        writeln!(text, "LaTeX\n{}\n\n", K::EQUATIONS.latex.trim())
    }
    let mut text = String::new();
    one(&mut text, "Kirchhoff", &fleet.kirchhoff)?;
    one(&mut text, "Newton–Euler", &fleet.newton_euler)?;
    one(&mut text, "hybrid", &fleet.hybrid)?;
    one(&mut text, "Lagrange (ψ, θ, φ)", &fleet.lagrange)?;
    Ok(text)
}

/// What the generated code costs.
///
/// # Errors
/// Never: strings take all that is written.
pub fn costs(timings: &[Timing]) -> Result<String, fmt::Error> {
    let mut text = String::new();
    heading(&mut text, "Cost of the generated code")?;
    writeln!(
        text,
        "Flat code without loops, branches or allocation. ns per evaluation: median, and the middle half of all batches.\n"
    )?;
    writeln!(text, "{:<20} {:<14} {:>5}  {:<37} {:>7}   middle half", "chart", "function", "ops", "of which", "ns")?;
    for timing in timings {
        let [low, median, high] = timing.quartiles;
        let (count, parts) = (timing.operations.total(), timing.operations.to_string());
        let spread = format!("{low:.1} … {high:.1}");
        writeln!(text, "{:<20} {:<14} {count:>5}  {parts:<37} {median:>7.1}   {spread}", timing.name, timing.method)?;
    }
    writeln!(
        text,
        "\nAn integrator calls acceleration in velocity form, momentum_rate and velocity, which is z(p), in momentum form."
    )?;
    Ok(text)
}

/// How well the runs agree and what they keep.
///
/// # Errors
/// Never: strings take all that is written.
pub fn results(comparison: &Comparison) -> Result<String, fmt::Error> {
    let mut text = String::new();
    let last = comparison.reference.moments[comparison.reference.moments.len() - 1];
    let from = comparison.reference.moments[0].pose.translation.vector;
    let moved = last.pose.translation.vector - from;
    heading(&mut text, "One motion, four charts")?;
    writeln!(
        text,
        "{:.0} s from one state, the same for every chart. A slender body without fins does not swim straight: it turns broadside and\n\
         swings, going backwards and forwards {} times. It gets {:.1} m north and {:.1} m east, and buoyancy lifts it by {:.1} m.\n\n\
         Largest difference from the reference (Kirchhoff, order 8, {} steps a second); drift of the energy relative to the\n\
         largest kinetic energy; drift of the momenta that vertical gravity leaves constant, relative to |Q̂| and |Γ̂_Ω|:\n",
        last.t,
        reversals(&comparison.reference),
        moved.x,
        moved.y,
        -moved.z,
        2 * PRECISE_RATE
    )?;
    writeln!(
        text,
        "{:<20} {:>12} {:>12} {:>12} {:>12} {:>12}",
        "", "distance m", "angle rad", "energy", "Q̂₁ Q̂₂ ", "Γ̂₃ "
    )?;
    let mut block = |title: String, runs: &[Run]| -> fmt::Result {
        writeln!(text, "{title}")?;
        for run in runs {
            let (metres, radians) = largest_difference(run, &comparison.reference);
            let energy = largest_energy_drift(run);
            let (linear, angular) = symmetric_momentum_drift(run);
            let name = run.name;
            writeln!(
                text,
                "  {name:<18} {metres:>12.1e} {radians:>12.1e} {energy:>12.1e} {linear:>12.1e} {angular:>12.1e}"
            )?;
        }
        Ok(())
    };
    block(format!("order 8, {PRECISE_RATE} steps a second: rounding is all that is left"), &comparison.precise)?;
    block(
        format!("order 4, {:.0} steps a second: each chart makes an error of its own", 1.0 / EVERYDAY_STEP),
        &comparison.everyday,
    )?;

    without_gravity(&mut text, comparison)?;
    Ok(text)
}

/// What is left of the errors, and the momenta that are constant without weight.
fn without_gravity(text: &mut String, comparison: &Comparison) -> fmt::Result {
    writeln!(
        text,
        "\nWhat is left in the first four rows is rounding: more steps do not lessen it. The right-invariant chart has more of it\n\
         because of its pole: Ω is 70 m away, and the velocity of O is a difference of numbers so much larger.\n"
    )?;
    heading(text, "Without gravity: six constants")?;
    writeln!(
        text,
        "The same body without weight and buoyancy, order 4, {:.0} steps a second. Leaving out two fields leaves their terms out of\n\
         the code; then the Newton–Euler equations in momentum form are dp/dt = 0, and p keeps every bit.\n",
        1.0 / EVERYDAY_STEP
    )?;
    writeln!(text, "{:<30} {:>16} {:>22} {:>12}", "", "p, same bits", "(Q̂, Γ̂_Ω) from R, b, z  ", "energy")?;
    for run in &comparison.weightless {
        let (same, of) = momenta_with_the_same_bits(run);
        let drift = largest(&momentum_drift(run));
        let energy = largest(&energy_drift(run));
        // Momenta in body axes turn with the body: for those charts the bits say nothing.
        let bits = if run.name.starts_with("Newton") { format!("{same} of {of}") } else { "(body axes)".into() };
        writeln!(text, "{:<30} {bits:>16} {drift:>22.1e} {energy:>12.1e}", run.name)?;
    }
    Ok(())
}

fn largest(series: &[(f64, f64)]) -> f64 {
    series.iter().map(|&(_, value)| value).fold(0.0, |a, b| if b > a || b.is_nan() { b } else { a })
}
