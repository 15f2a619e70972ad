//! Equations and costs as text, LaTeX and rustdoc.

use crate::accuracy::Figure;
use crate::algebra::Notation;
use crate::formulation::PrintedEquations;
use crate::kernel::{Counts, Kernel, LoweredFunction};
use crate::mathml;
use crate::mechanics::Method;
use crate::terms::{BodyChart, InputKind, Item, Role};
use crate::tex;
use crate::words::Unraw;

use crate::emit::chart::{chart_name, motion_name};
use crate::emit::derived::Derived;
use crate::emit::records::input::input_name;
use crate::emit::records::record::{Part, PartKind};
use crate::emit::records::state::{parts, state_name};
use crate::emit::subject::Subject;

/// The equations as plain text and as LaTeX for a page.
#[derive(Clone, Debug)]
pub struct Equations {
    pub text: String,
    pub latex: String,
}

impl Equations {
    pub fn of(derived: &Derived<'_, '_>) -> Self {
        let [text_lines, latex_lines] = derived.printed;
        Equations { text: text(derived, text_lines), latex: tex::environments(latex_lines) }
    }
}

fn text(derived: &Derived<'_, '_>, printed: &PrintedEquations) -> String {
    let mut out = format!(
        "{}: {}
",
        derived.item().ident.unraw(),
        description(derived)
    );
    // A letter that is the name of its field says nothing.
    let letters = legend(derived.item()).into_iter().filter(|(letter, field, _)| letter != field);
    let letters: Vec<String> = letters.map(|(letter, field, _)| format!("{letter} = {field}")).collect();
    if !letters.is_empty() {
        out.push_str(&format!(
            "with {}{}
",
            letters.join(", "),
            if derived.subject.system.scene.chart().is_some() { "; x̂ = R x + b" } else { "" }
        ));
    }
    for (title, lines) in printed {
        out.push_str(&format!("\n{title}\n"));
        lines.iter().for_each(|line| out.push_str(&format!("  {line}\n")));
    }
    out
}

/// Legend of the letters of the equations: (letter, field, what its author says of it).
fn legend(item: &Item) -> Vec<(&'static str, String, String)> {
    let fields = item.fields.iter().map(|f| (f.role, &f.ident, &f.documentation, &f.unit));
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
    if let Some(BodyChart { chart, motion }) = derived.subject.system.scene.chart() {
        return format!("chart {}, motion {}, z = ({speeds})", chart_name(chart), motion_name(motion));
    }
    let names = &derived.subject.system.scene.coordinate_names;
    let q: Vec<&str> = names.iter().map(|name| name.text.as_str()).collect();
    format!("q = ({}), z = ({speeds})", q.join(", "))
}

/// The loss above which the documentation of a kernel warns of it: three decimal places.
const MUCH: f64 = 1e3;

/// LaTeX that is longer is not set in rustdoc: pages of a megabyte are read by nobody, and every compilation writes
/// them.
const TOO_LONG: usize = 12_000;

/// Rustdoc of the kernel: what it is, what it takes, its equations, its costs. What a scene does not have is not on it.
pub struct Documentation {
    /// Sections before the equations.
    pub before: String,
    /// The equations as text: what editors show, which set no formulas.
    pub text: String,
    /// The same as formulas, unless they are very long.
    pub formulas: Option<String>,
    /// Sections after them.
    pub after: String,
}

/// Everything that is known of a kernel, for its page.
pub fn rustdoc(derived: &Derived<'_, '_>, equations: &Equations) -> Documentation {
    let legend =
        legend(derived.item()).into_iter().map(|(letter, field, text)| vec![letter.into(), code(&field), text]);
    let before = format!(
        "Equations of motion of [`{name}`], derived from the Gauss condition (Massa & Vignolo, eq. 3.4).\n\n\
         {description}.\n{states}{input}\n# Equations\n\n{letters}\n",
        name = derived.item().ident,
        description = description(derived),
        states = states(derived),
        input = input(derived),
        letters = letters(&derived.subject, &equations.text),
    );
    let mut after = table(["letter", "field", ""], legend.collect());
    after.push_str(&acting(derived));
    after.push_str(&frames(derived));
    after.push_str(&crate::emit::text::file::documentation(derived.item()));
    after.push_str(&costs(derived));
    let formulas = (equations.latex.len() <= TOO_LONG).then(|| formulas(&derived.printed[1]));
    Documentation { before, text: format!("```text\n{}```\n", equations.text), formulas, after }
}

/// Equations as HTML. No line is empty: an empty one would end it, in Markdown.
fn formulas(printed: &PrintedEquations) -> String {
    let mut out = String::from("<div style=\"overflow-x:auto\">\n");
    for (title, lines) in printed {
        out.push_str(&format!("<p style=\"margin:0.7em 0 0.2em\"><em>{}</em></p>\n", mathml::words(title)));
        for line in lines {
            let set = mathml::line(&line.replacen(" = ", " &= ", 1));
            out.push_str(&format!("<p style=\"margin:0.25em 0;padding-left:4em;text-indent:-2em\">{set}</p>\n"));
        }
    }
    // What follows is Markdown again after an empty line.
    out.push_str("</div>\n\n");
    out
}

/// A table without the columns in which nothing stands; nothing of no rows.
fn table<const N: usize>(headings: [&str; N], rows: Vec<Vec<String>>) -> String {
    let used: Vec<usize> =
        (0..N).filter(|&k| rows.iter().any(|row| row.get(k).is_some_and(|cell| !cell.is_empty()))).collect();
    let line = |cells: &[&str]| format!("| {} |\n", used.iter().map(|&k| cells[k]).collect::<Vec<_>>().join(" | "));
    if rows.is_empty() {
        return String::new();
    }
    let mut out = format!("\n{}|{}\n", line(&headings), "---|".repeat(used.len()));
    for row in &rows {
        let cells: Vec<String> = row.iter().map(|cell| cell.replace('|', "\\|")).collect();
        out.push_str(&line(&cells.iter().map(String::as_str).collect::<Vec<_>>()));
    }
    out
}

fn code(text: &str) -> String {
    format!("`{text}`")
}

/// Explanations of letters and marks of the equations, of those that occur.
fn letters(subject: &Subject<'_, '_>, equations: &str) -> String {
    const HAT: char = '\u{302}';
    let has = |text: &str| equations.contains(text);
    let mut sentences = Vec::new();
    // Every page of one body has the map of points to the observer.
    if equations.replace(&format!("x{HAT} = R x + b"), "").contains(HAT) {
        sentences.push("Components with a hat are in the observer's axes k, those without in body axes e.".to_owned());
    }
    if subject.system.scene.chart().is_some() {
        let hats = ["Q", "Γ"].map(|letter| if has(&format!("{letter}{HAT}")) { "\u{302}" } else { "" });
        let [linear, angular] = hats;
        let both = if angular.is_empty() { "O" } else { "Ω" };
        if has("Γ") {
            sentences.push(format!("(Q{linear}, Γ{angular}) is the momentum about {both}."));
        }
        if has("active forces") && !has("F_") {
            let forces = format!("(R{linear}, M{angular})");
            sentences.push(format!("{forces} is the resultant and the torque of the forces, about {both}."));
        }
    }
    if has("p_") || has("F_") {
        sentences.push("p is ∂T/∂z and F the generalised force, each with the name of its speed.".to_owned());
    }
    sentences.push("The same in LaTeX is `EQUATIONS.latex`.".to_owned());
    sentences.join(" ")
}

/// Names of the programs besides the formulas, with their costs and losses.
fn besides<'d>(kernel: &'d Kernel<'_>) -> impl Iterator<Item = (&'static str, Counts, Option<&'d Figure>)> {
    let derivatives = kernel.derivatives.iter();
    let derivatives =
        derivatives.map(|derivative| (derivative.kind.name(), derivative.program.counts(), derivative.figure.as_ref()));
    std::iter::once(("evaluate", kernel.joined.counts(), kernel.figure_of_joined.as_ref())).chain(derivatives)
}

/// Losses of each method, then of `evaluate` and the derivatives, by their names.
pub fn figures<'d>(derived: &'d Derived<'_, '_>) -> impl Iterator<Item = (Option<Method>, &'static str, &'d Figure)> {
    let functions = derived.kernel.functions.iter();
    let functions =
        functions.filter_map(|(method, function)| Some((Some(method), method.name(), function.figure.as_ref()?)));
    functions.chain(besides(derived.kernel).filter_map(|(name, _, figure)| Some((None, name, figure?))))
}

/// Table of the cost and the loss of each method.
fn costs(derived: &Derived<'_, '_>) -> String {
    let functions = derived.kernel.functions.iter().map(|(method, LoweredFunction { program, figure, .. })| {
        (call_of(derived, method), program.counts(), figure.as_ref())
    });
    let besides = besides(derived.kernel).map(|(name, counts, figure)| (name.to_owned(), counts, figure));
    let row = |(name, counts, figure): (String, Counts, Option<&Figure>)| {
        vec![code(&name), counts.to_string(), figure.map_or_else(|| "none".to_owned(), loss)]
    };
    format!(
        "\n# Cost and rounding\n\nThe loss is the largest error of double precision that a search over states of the \
         scene found (median of sample states), in units of what a change of every parameter and argument in its last \
         place does. Sizes are up to 10⁹ apart there, and sums as near zero as 10⁻⁹ of their terms.\n{}",
        table(["method", "operations", "loss, at most"], functions.chain(besides).map(row).collect())
    )
}

/// Loss of a method, and the state where it is, if it is much.
fn loss(figure: &Figure) -> String {
    let [worst, median] = figure.rounded();
    let at = match &figure.at[..] {
        [] => String::new(),
        at => format!(" ({})", at.join("; ")),
    };
    let warning = if worst > MUCH { format!(": **digits are lost**{at}") } else { String::new() };
    format!("{worst} ({median}){warning}")
}

/// Call of a method as users write it: `pose_of(tool)`.
fn call_of(derived: &Derived<'_, '_>, method: Method) -> String {
    match method {
        Method::OfFrame(_, frame) => format!("{}({})", method.name(), derived.frames()[frame].unraw()),
        _ => method.name().to_owned(),
    }
}

/// Components of a configuration and of speeds, in words and in a call.
fn states(derived: &Derived<'_, '_>) -> String {
    let (name, [coordinates, speeds]) = (state_name(derived.item()), parts(derived));
    let row = |of: &str, part: &Part| vec![of.to_owned(), code(&part.shown()), part.label.clone()];
    let rows = coordinates.iter().map(|part| row("q", part)).chain(speeds.iter().map(|part| row("z", part)));
    let (groups, scalars): (Vec<&Part>, Vec<&Part>) =
        coordinates.iter().partition(|part| part.kind != PartKind::Scalar);
    let mut factors: Vec<String> = groups.iter().map(|part| part.ident.to_string()).collect();
    if !scalars.is_empty() {
        let names: Vec<String> = scalars.iter().map(|part| part.ident.to_string()).collect();
        factors.push(format!("SVector[{}]", names.join(", ")));
    }
    let nested = factors.iter().rev().cloned().reduce(|inner, outer| format!("({outer}, {inner})")).unwrap_or_default();
    let idents = coordinates.iter().chain(&speeds).map(|part| part.ident.to_string()).collect::<Vec<_>>().join(", ");
    let input = if derived.item().inputs.is_empty() { "()" } else { "input" };
    format!(
        "\n# State\n{}\nThe configuration q is `{nested}`, the speeds z are one vector. By name both are [`{name}`]:\n\n\
         ```text\nlet state = {name} {{ {idents} }};\nlet rates = kernel.acceleration(t, &state.q(), &state.z(), \
         &{input});\nlet {name} {{ {idents} }} = {name}::of(&q, &z);\n```\n",
        table(["", "field", "is"], rows.collect()),
    )
}

/// The components of the input in order.
fn input(derived: &Derived<'_, '_>) -> String {
    let mut next = 0;
    let mut rows = Vec::new();
    for input in &derived.item().inputs {
        let (count, what) = match input.kind {
            InputKind::Scalar => (1, ""),
            InputKind::Vector => (3, ": a vector"),
            InputKind::Wrench => (6, ": a force, then a torque"),
        };
        let range = if count == 1 { next.to_string() } else { format!("{next}–{}", next + count - 1) };
        let unit = input.unit.clone().unwrap_or_default();
        let (called, ident) = (input.called.unraw().to_string(), input.ident.unraw().to_string());
        let inside = if called == ident { String::new() } else { format!(", `{ident}` in expressions") };
        rows.push(vec![range, format!("`{called}`{what}{inside}"), unit]);
        next += count;
    }
    let heading = match rows.is_empty() {
        true => String::new(),
        false => format!("\n# Input\n\nBy name [`{}`].\n", input_name(derived.item())),
    };
    format!("{heading}{}", table(["components", "input", "unit"], rows))
}

/// The elements in the order of their powers.
fn acting(derived: &Derived<'_, '_>) -> String {
    let accounts = derived.accounts();
    let rows = accounts.iter().map(|account| {
        let kind = match (account.conservative, account.outside) {
            (true, Some(_)) => "in the potential energy, with a damper",
            (true, None) => "in the potential energy",
            (false, _) => "a force without a potential",
        };
        vec![account.name.to_string(), kind.to_owned()]
    });
    let rows: Vec<Vec<String>> = rows.collect();
    let heading = if rows.is_empty() { "" } else { "\n# What acts\n" };
    format!("{heading}{}", table(["element", ""], rows))
}

/// The quantities of a frame by its name.
fn frames(derived: &Derived<'_, '_>) -> String {
    let names: Vec<String> = derived.frames().iter().map(|frame| frame.unraw().to_string()).collect();
    let Some(first) = names.first() else { return String::new() };
    let listed: Vec<String> = names.iter().map(|name| code(name)).collect();
    format!(
        "\n# Frames\n\nOf {}: R and b, twist, Jacobian and what is left of the acceleration at ż = 0, each in the axes of \
         the frame about its origin:\n\n```text\nlet pose = kernel.pose_of({item}Frame::{first}, t, &q);\nlet twist = \
         kernel.twist_of({item}Frame::{first}, t, &q, &z);\n```\n",
        listed.join(", "),
        item = derived.item().ident,
    )
}
