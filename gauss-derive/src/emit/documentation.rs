//! Equations and costs as text, LaTeX and rustdoc.

use crate::algebra::Notation;
use crate::kernel::Counts;
use crate::mechanics::{Method, Section};

use super::kernel::Derived;

/// The equations as plain text.
pub fn text(derived: &Derived<'_, '_>) -> String {
    let mut out = format!("{}: {}\n", derived.model.ident, description(derived));
    for Section { title, lines } in derived.scene.equations(Notation::Text) {
        if lines.is_empty() {
            continue;
        }
        out.push_str(&format!("\n{title}\n"));
        for line in lines {
            out.push_str(&format!("  {line}\n"));
        }
    }
    out
}

/// The equations as one LaTeX environment.
pub fn latex(derived: &Derived<'_, '_>) -> String {
    let mut out = String::from("\\begin{align*}\n");
    for Section { title, lines } in derived.scene.equations(Notation::Latex) {
        if lines.is_empty() {
            continue;
        }
        // Titles are plain text with ASCII formulas; LaTeX has its own words for the same thing.
        let title = title.split(':').next().unwrap_or_default().replace("p = dT/dz", "$p = \\partial T/\\partial z$");
        let title = title.replace("A dz/dt = r", "$A \\dot z = r$");
        out.push_str(&format!("&\\text{{{title}}} \\\\\n"));
        for line in lines {
            out.push_str(&format!("{} \\\\\n", line.replacen(" = ", " &= ", 1)));
        }
    }
    out.push_str("\\end{align*}\n");
    out
}

/// One line: chart, motion, order of z, where the parameters come from.
fn description(derived: &Derived<'_, '_>) -> String {
    let speeds: Vec<String> =
        derived.scene.kinematics.speeds.iter().map(|z| crate::algebra::print(*z, Notation::Text)).collect();
    format!("chart {}, motion {}, z = ({})", derived.chart_name(), derived.motion_name(), speeds.join(", "))
}

/// Rustdoc of the kernel: what it is, its equations, its costs.
pub fn rustdoc(derived: &Derived<'_, '_>) -> String {
    let mut out = format!(
        "Equations of motion of [`{name}`], derived from the Gauss condition (Massa & Vignolo, eq. 3.4).\n\n\
         {description}.\n\n\
         Components marked `^` are in observer's axes k, the others in body axes e; (u, w) is the twist of O, \
         (Q, G) the momentum about O (about the observer's origin where both are marked).\n\n\
         ```text\n{equations}```\n\n# Cost\n\n| method | operations |\n|---|---|\n",
        name = derived.model.ident,
        description = description(derived),
        equations = text(derived),
    );
    for (formula, program) in derived.formulas.iter().zip(&derived.kernel.functions) {
        out.push_str(&format!("| `{}` | {} |\n", method_name(formula.method), operations(program.counts())));
    }
    out
}

fn operations(counts: Counts) -> String {
    let parts = [
        (counts.additions, "add"),
        (counts.multiplications, "mul"),
        (counts.divisions, "div"),
        (counts.roots, "sqrt"),
        (counts.transcendentals, "sin/cos"),
    ];
    let parts: Vec<String> =
        parts.into_iter().filter(|(n, _)| *n > 0).map(|(n, name)| format!("{n} {name}")).collect();
    if parts.is_empty() { "none".to_owned() } else { parts.join(", ") }
}

/// Name of the generated method.
pub fn method_name(method: Method) -> &'static str {
    match method {
        Method::Kinematics => "kinematics",
        Method::Acceleration => "acceleration",
        Method::Momentum => "momentum",
        Method::Velocity => "velocity",
        Method::MomentumRate => "momentum_rate",
        Method::MassMatrix => "mass_matrix",
        Method::KineticEnergy => "kinetic_energy",
        Method::PotentialEnergy => "potential_energy",
        Method::GaussResidual => "gauss_residual",
        Method::ConstraintFunction => "constraint_function",
        Method::BodyTwist => "body_twist",
        Method::Speeds => "speeds",
        Method::BodyMomentum => "body_momentum",
    }
}
