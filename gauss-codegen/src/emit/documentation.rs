//! Equations and costs as text, LaTeX and rustdoc.

use syn::ext::IdentExt;

use crate::algebra::Notation;
use crate::formulation::Printed;
use crate::mechanics::Method;
use crate::model::{InChart, InputKind, Role};

use super::chart::{chart_name, motion_name};
use super::derived::Derived;
use super::input::{called, input_name};
use super::record::{Part, PartKind};
use super::state::{parts, state_name};

/// The equations as plain text and as one LaTeX environment.
#[derive(Clone, Debug)]
pub struct Equations {
    pub text: String,
    pub latex: String,
}

impl Equations {
    pub fn of(derived: &Derived<'_, '_>) -> Self {
        let [text_lines, latex_lines] = derived.printed;
        Equations { text: text(derived, text_lines), latex: latex(latex_lines) }
    }
}

fn text(derived: &Derived<'_, '_>, printed: &Printed) -> String {
    let mut out = format!(
        "{}: {}
",
        derived.item().ident.unraw(),
        description(derived)
    );
    // A letter that is the name of its field says nothing.
    let letters = legend(derived).into_iter().filter(|(letter, field, _)| letter != field);
    let letters: Vec<String> = letters.map(|(letter, field, _)| format!("{letter} = {field}")).collect();
    if !letters.is_empty() {
        out.push_str(&format!(
            "with {}{}
",
            letters.join(", "),
            if derived.subject.model.one_body().is_some() { "; x̂ = R x + b" } else { "" }
        ));
    }
    for (title, lines) in printed {
        out.push_str(&format!("\n{title}\n"));
        lines.iter().for_each(|line| out.push_str(&format!("  {line}\n")));
    }
    out
}

fn latex(printed: &Printed) -> String {
    let mut out = String::from("\\begin{align*}\n");
    for (title, lines) in printed {
        out.push_str(&format!("&\\text{{{title}}} \\\\\n"));
        lines.iter().for_each(|line| out.push_str(&format!("{} \\\\\n", line.replacen(" = ", " &= ", 1))));
    }
    out.push_str("\\end{align*}\n");
    out
}

/// What the letters of the equations stand for: (letter, field, what its author says of it).
fn legend(derived: &Derived<'_, '_>) -> Vec<(&'static str, String, String)> {
    let fields = derived.subject.model.fields.iter().map(|f| (f.role, &f.ident, &f.documentation, &f.unit));
    fields
        .filter_map(|(role, ident, documentation, unit)| role.map(|role| (role, ident, documentation, unit)))
        .filter(|(role, ..)| *role != Role::Body)
        .map(|(role, ident, documentation, unit)| {
            let letter = match role {
                Role::Mass => "m",
                Role::CenterOfMass => "c",
                Role::Inertia => "I",
                Role::CentralInertia => "IG",
                Role::AddedMass => "X",
                Role::Gravity => "g",
                Role::DisplacedMass => "md",
                Role::CenterOfBuoyancy => "h",
                // The letters of a named body carry its name.
                Role::Body => "B",
            };
            // The first line says what it is; the rest is for the struct's own page.
            let text = documentation.lines().next().unwrap_or_default();
            let text = match unit {
                Some(unit) if text.is_empty() => format!("in {unit}"),
                Some(unit) => format!("{text} ({unit})"),
                None => text.to_owned(),
            };
            (letter, ident.unraw().to_string(), text)
        })
        .collect()
}

/// One line: chart, motion, order of z, where the parameters come from.
fn description(derived: &Derived<'_, '_>) -> String {
    let speeds: Vec<String> = derived.speeds().iter().map(|z| crate::algebra::print(*z, Notation::Text)).collect();
    let speeds = speeds.join(", ");
    if let Some(InChart { chart, motion }) = derived.subject.model.one_body() {
        return format!("chart {}, motion {}, z = ({speeds})", chart_name(chart), motion_name(motion));
    }
    let names = &derived.subject.system.scene.coordinate_names;
    let q: Vec<&str> = names.iter().map(|name| name.text.as_str()).collect();
    format!("q = ({}), z = ({speeds})", q.join(", "))
}

/// The methods that [`Kernel::derivatives`](crate::kernel::Kernel::derivatives) has the programs of.
pub const DERIVATIVES: [&str; 3] = ["linearize", "by_parameters", "regressor"];

/// The loss above which the documentation of a kernel warns of it: three decimal places.
const MUCH: f64 = 1e3;

/// Rustdoc of the kernel: what it is, its equations, its costs.
pub fn rustdoc(derived: &Derived<'_, '_>, equations: &str) -> String {
    let mut out = format!(
        "Equations of motion of [`{name}`], derived from the Gauss condition (Massa & Vignolo, eq. 3.4).\n\n\
         {description}.\n\n\
         Components with a hat are in the observer's axes k, the others in body axes e; (u, ω) is the twist of O, \
         (Q, Γ) the momentum, about O, or about Ω where both have hats; (R, M) the resultant and torque of the forces.\n\n\
         ```text\n{equations}```\n\n| letter | field | |\n|---|---|---|\n",
        name = derived.item().ident,
        description = description(derived),
    );
    for (letter, field, text) in legend(derived) {
        out.push_str(&format!("| {letter} | `{field}` | {} |\n", text.replace('|', "\\|")));
    }
    out.push_str(&states(derived));
    out.push_str(&acting(derived));
    out.push_str(&super::file::documentation(derived));
    out.push_str(
        "\n# Cost and rounding\n\nThe loss is the largest error of double precision at sample states (median), in units of what a change of \
         every parameter and argument in its last place does.\n\n| method | operations | loss, at most |\n|---|---|---|\n",
    );
    for ((formula, program), loss) in derived.formulas.iter().zip(&derived.kernel.functions).zip(&derived.kernel.losses)
    {
        let [worst, median] = loss.rounded();
        let warning = if worst > MUCH { ": **digits are lost**" } else { "" };
        let loss = if worst > 0.0 { format!("{worst} ({median}){warning}") } else { String::new() };
        out.push_str(&format!("| `{}` | {} | {loss} |\n", call_of(derived, formula.method), program.counts()));
    }
    out.push_str(&format!("| `evaluate` | {} | |\n", derived.kernel.joined.counts()));
    for (name, program) in DERIVATIVES.into_iter().zip(derived.kernel.derivatives()) {
        if let Some(program) = program {
            out.push_str(&format!("| `{name}` | {} | |\n", program.counts()));
        }
    }
    out
}

/// What a method is called, as it is called: `pose_of(tool)`.
fn call_of(derived: &Derived<'_, '_>, method: Method) -> String {
    match method {
        Method::OfFrame(_, frame) => format!("{}({})", method.name(), derived.frames()[frame].unraw()),
        _ => method.name().to_owned(),
    }
}

/// What a configuration and speeds are made of, in words and in a call.
fn states(derived: &Derived<'_, '_>) -> String {
    let (name, [coordinates, speeds]) = (state_name(derived), parts(derived));
    let listed = |parts: &[Part]| parts.iter().map(|part| format!("`{}`", part.shown())).collect::<Vec<_>>().join(", ");
    let (groups, scalars): (Vec<&Part>, Vec<&Part>) =
        coordinates.iter().partition(|part| part.kind != PartKind::Scalar);
    let mut factors: Vec<String> = groups.iter().map(|part| format!("`{}`", part.ident)).collect();
    if !scalars.is_empty() {
        let names: Vec<String> = scalars.iter().map(|part| part.ident.to_string()).collect();
        factors.push(format!("`SVector[{}]`", names.join(", ")));
    }
    let nested = factors.iter().rev().cloned().reduce(|inner, outer| format!("({outer}, {inner})")).unwrap_or_default();
    let idents = coordinates.iter().chain(&speeds).map(|part| part.ident.to_string()).collect::<Vec<_>>().join(", ");
    format!(
        "\n# State\n\nCoordinates: {}. Speeds: {}. The configuration q is {nested}, the speeds z are one vector; by name \
         both are [`{name}`]:\n\n```text\nlet state = {name} {{ {idents} }};\nlet rates = kernel.acceleration(t, \
         &state.q(), &state.z(), &input);\nlet {name} {{ {idents} }} = {name}::of(&q, &z);\n```\n",
        listed(&coordinates),
        listed(&speeds),
    )
}

/// The components of the input in order, and the elements in the order of their powers.
fn acting(derived: &Derived<'_, '_>) -> String {
    let mut out = String::new();
    let mut next = 0;
    for input in &derived.subject.model.inputs {
        if next == 0 {
            let name = input_name(derived);
            out.push_str(&format!(
                "\n# Input\n\nBy name [`{name}`].\n\n| components | input | unit |\n|---|---|---|\n"
            ));
        }
        let (count, what) = match input.kind {
            InputKind::Scalar => (1, ""),
            InputKind::Vector => (3, ": a vector"),
            InputKind::Wrench => (6, ": a force, then a torque"),
        };
        let range = if count == 1 { next.to_string() } else { format!("{next}–{}", next + count - 1) };
        let unit = input.unit.as_deref().unwrap_or_default();
        let (called, ident) = (called(input).unraw().to_string(), input.ident.unraw().to_string());
        let inside = if called == ident { String::new() } else { format!(", `{ident}` in expressions") };
        out.push_str(&format!("| {range} | `{called}`{what}{inside} | {unit} |\n"));
        next += count;
    }
    let accounts = derived.accounts();
    if !accounts.is_empty() {
        out.push_str("\n# What acts\n\n| element | |\n|---|---|\n");
    }
    for account in accounts {
        let kind = match (account.conservative, account.outside) {
            (true, Some(_)) => "in the potential energy, with a damper",
            (true, None) => "in the potential energy",
            (false, _) => "",
        };
        out.push_str(&format!("| {} | {kind} |\n", account.name));
    }
    out
}
