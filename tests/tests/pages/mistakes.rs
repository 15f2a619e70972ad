//! The likeliest mistakes, each with what is said of it: `docs/mistakes.md` is written from here
//! (`UPDATE_MISTAKES=1`) and compared.

use std::fmt::Write;
use std::path::Path;

use gauss_codegen::Derivation;
use gauss_runtime::prelude::*;

/// What is written, and what it is to be called: clauses of a particle with coordinates x and y, or a struct as a
/// whole.
const WRITTEN: [(&str, &str); 15] = [
    ("a misspelt word", "#[gauss(chart = hybird)] struct Body { #[gauss(mass)] m: f64, #[gauss(inertia)] i: f64 }"),
    ("no inertia", "struct Body { #[gauss(mass)] m: f64 }"),
    ("a role for a clause", "#[gauss(mass)] struct Body { m: f64, #[gauss(inertia)] i: f64 }"),
    ("a body without its field", "#[gauss(coordinates(a), body(arm, rotation = rotation_z(a)))] struct Arm { m: f64 }"),
    ("a name that nothing declares", "potential = stiffness * x * x"),
    ("a value that arrives at run time", "drive(x = thrust)"),
    ("`self`", "potential = self.k * x * x"),
    ("a power", "potential = k * x^2"),
    ("π", "potential = k * sin(x / std::f64::consts::PI)"),
    ("a function of one's own", "potential = k * lift(x)"),
    ("a velocity in a potential", "potential = k * rate(x)"),
    ("two vectors multiplied", "force(at = [x, y, 0], value = [x, 0, 0] * [0, y, 0])"),
    ("a bare constraint", "constraint(x * x + y * y - k)"),
    ("a kink in a potential", "potential = k * abs(x)"),
    ("an angle for a force", "input(rudder = \"rad\"), force(at = [x, y, 0], value = [0, rudder, 0])"),
];

fn refused(written: &str) -> String {
    let source = if written.contains("struct") {
        written.to_owned()
    } else {
        format!(
            "#[gauss(coordinates(x, y), particle(mass = m, position = [x, y, 0]), {written})] \
             struct Scene {{ m: f64, k: f64 }}"
        )
    };
    let item: syn::DeriveInput = syn::parse_str(&source).expect("a struct");
    let error = Derivation::new(&item).expect_err(written);
    error.into_iter().map(|mistake| mistake.to_string()).collect::<Vec<_>>().join("; ")
}

#[derive(GaussDynamics)]
struct Vehicle {
    #[gauss(mass)]
    m: f64,
    #[gauss(center_of_mass)]
    center: Vector3<f64>,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
    #[gauss(added_mass)]
    added: Vector6<f64>,
    #[gauss(gravity)]
    g: f64,
}

fn vehicle(spoil: impl FnOnce(&mut Vehicle)) -> Vehicle {
    let mut vehicle = Vehicle {
        m: 30.0,
        center: Vector3::zeros(),
        inertia: Vector3::new(0.2, 3.5, 3.5),
        added: Vector6::new(0.9, 35.0, 35.0, 0.07, 4.9, 4.9),
        g: 9.81,
    };
    spoil(&mut vehicle);
    vehicle
}

/// What `kernel()` and `warnings()` say.
fn given() -> Vec<(&'static str, &'static str, String)> {
    let kernel = |spoil: fn(&mut Vehicle)| vehicle(spoil).kernel().expect_err("refused").to_string();
    let warning = |spoil: fn(&mut Vehicle)| vehicle(spoil).warnings().to_string();
    vec![
        ("the inertia about the centre of mass", "center: [0, 0, 0.5]", kernel(|v| v.center.z = 0.5)),
        ("moments in the wrong order of magnitude", "inertia: [0.2, 3.5, 35.0]", kernel(|v| v.inertia.z = 35.0)),
        ("SNAME's signs", "added: [-0.9, …]", warning(|v| v.added[0] = -0.9)),
        ("gravity as a component", "g: -9.81", warning(|v| v.g = -9.81)),
    ]
}

/// What the compiler says of calls, from its expectations in `compile_fail`; of closures in words of its own, to which
/// is added what is meant.
fn called() -> [(&'static str, &'static str, String); 3] {
    let law = "Simulation::new(&kernel).input(|_, q, _| { integral += q[0]; SVector::from([-integral]) })";
    let meant = "the words are the compiler's; what samples or remembers is given to `.sampled(period, |t, q, z| …)`, whose \
                 closure may change what it likes, and an integral without sampling is `states(integral = x - goal)`";
    [
        ("a run without steps", "Simulation::new(&kernel).run(q, z, 0.0..1.0)", compiler("run_without_steps", "E0277")),
        (
            "a method without its clause",
            "kernel.linearize(0.0, &q, &z, &())",
            compiler("methods_without_clauses", "E0599"),
        ),
        (
            "a control law that adds up an integral",
            law,
            format!("{}; {meant}", compiler("input_with_a_state", "E0594").trim_end_matches("; ")),
        ),
    ]
}

/// The first error with this code in an expectation, with the first note that says what to add.
fn compiler(file: &str, code: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("compile_fail/{file}.stderr"));
    let text = std::fs::read_to_string(path).expect("the expectation");
    let (_, rest) = text.split_once(&format!("error[{code}]: ")).expect("an error of this kind");
    let block = rest.split("\nerror").next().unwrap_or_default();
    let note = block.lines().find_map(|line| line.trim_start().strip_prefix("= note: add ")).unwrap_or_default();
    format!(
        "{}; {}",
        block.lines().next().unwrap_or_default(),
        if note.is_empty() { String::new() } else { format!("add {note}") }
    )
}

fn page() -> String {
    let mut page = String::from(
        "# The likeliest mistakes\n\nEach with what the compiler says at its token, or what `kernel()` or `warnings()` \
         says.\nWritten by `UPDATE_MISTAKES=1 cargo test -p gauss-tests --test pages`. More of them, with their places: \
         [`tests/compile_fail`](../tests/compile_fail).\n\n",
    );
    let written = WRITTEN.map(|(mistake, written)| (mistake, written, refused(written)));
    for (n, (mistake, written, said)) in written.into_iter().chain(given()).chain(called()).enumerate() {
        write!(page, "{}. **{mistake}**: `{written}`\n\n   > {}\n\n", n + 1, said.replace('\n', " ")).expect("a page");
    }
    wrapped(&page)
}

/// Lines of at most 120 columns, broken at spaces; what follows is indented as the line is.
fn wrapped(text: &str) -> String {
    let mut out = String::new();
    for line in text.lines() {
        let indent = if line.trim_start().starts_with('>') { "   > " } else { "   " };
        let mut width = 0;
        for (k, word) in line.split(' ').enumerate() {
            let columns = word.chars().count();
            if k > 0 && width + 1 + columns > 120 {
                write!(out, "\n{indent}").expect("a line");
                width = indent.len();
            } else if k > 0 {
                out.push(' ');
                width += 1;
            }
            out.push_str(word);
            width += columns;
        }
        out.push('\n');
    }
    out.trim_end().to_owned() + "\n"
}

#[test]
fn mistakes_as_they_are_told() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/mistakes.md");
    let page = page();
    if std::env::var_os("UPDATE_MISTAKES").is_some() {
        std::fs::write(&path, &page).expect("docs can be written");
    }
    assert_eq!(std::fs::read_to_string(path).unwrap_or_default(), page, "UPDATE_MISTAKES=1 writes it anew");
}
