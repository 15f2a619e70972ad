//! What is wrong is a typed error, all of it at once, with its place; what only seems to be wrong is right.

use std::thread;

use gauss_jit::{CallError, Clause, Field, KernelError, Misgiven, Mistake, Mistakes, Model, Notation, Place, Scene};

const PENDULUM: &str =
    "#[gauss(coordinates(angle), particle(mass = m, position = [l * sin(angle), 0, -l * cos(angle)]))]
struct Pendulum { m: f64, l: f64, #[gauss(gravity)] g: f64 }";

fn pendulum() -> Model {
    Model::from_source(PENDULUM).unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

fn refused(source: &str) -> Mistakes {
    Model::from_source(source).expect_err("mistakes")
}

#[test]
fn text_that_is_no_scene() {
    for (source, message) in [
        ("", "1:1: there is no struct with `#[gauss(…)]` in this text; write `#[gauss(…)] struct Name { … }`"),
        (
            "struct A { x: f64 }",
            "1:1: there is no struct with `#[gauss(…)]` in this text; write `#[gauss(…)] struct Name { … }`",
        ),
        ("#[gauss(coordinates(x)", "1:8: nothing closes this `(`"),
        ("#[gauss(coordinates(x)]\nstruct A {}", "1:8: nothing closes this `(` before the next `]`"),
        ("#[gauss(λ = [sin(\"(\"), 0)]\nstruct A {}", "1:13: nothing closes this `[` before the next `)`"),
        ("#[gauss(linearize)]\nstruct A {}}", "2:12: this `}` closes nothing"),
        (
            "#[gauss(linearize)] struct A {}\n#[gauss(linearize)] struct B {}",
            "2:28: a text has one scene, and `B` is another; remove it",
        ),
    ] {
        assert_eq!(refused(source).to_string(), message, "{source}");
    }
    // Whatever nests is refused before it is read.
    for deep in
        [format!("{}{}", "(".repeat(100_000), ")".repeat(100_000)), "#[gauss(a = ".to_owned() + &"-".repeat(100_000)]
    {
        assert!(!refused(&deep).as_slice().is_empty());
    }
}

#[test]
fn mistakes_come_all_at_once_with_their_places() {
    let found = refused(
        "#[gauss(\n    coordinates(x),\n    particle(mass = m, position = [x, 0, y]),\n    spring(along = x),\n)]\nstruct A {}",
    );
    let place = |line, column| Place::Text { line, column };
    let places: Vec<Place> = found.as_slice().iter().map(|mistake| mistake.place.clone()).collect();
    assert_eq!(places, [place(3, 21), place(3, 42), place(4, 5)], "{found}");
    let Mistake { message, .. } = &found.as_slice()[1];
    assert_eq!(message, "unknown name `y`; expected a coordinate (`x`) or `t`");
    // Clauses of a scene are called by their beginnings.
    let scene = Scene::new("A").coordinates(["x"]).potential("k * x").particle("m", ["x", "0", "0"]);
    let found = Model::from_scene(&scene.clone().field(Field::new("m", "f64"))).expect_err("a mistake");
    assert_eq!(found.as_slice()[0].place, Place::Clause("potential".to_owned()), "{found}");
    let scene = scene.field(Field::new("m", "f64")).field(Field::new("k", "f64"));
    assert!(Model::from_scene(&scene.clause(Clause::new("linearize"))).is_ok());
}

#[cfg(feature = "urdf")]
#[test]
fn files_that_are_none() {
    let found = Model::from_urdf("nowhere/no.urdf", &["gravity = 9.81"]).expect_err("no file");
    assert!(found.to_string().contains("no.urdf"), "{found}");
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/robots/panda.urdf");
    let found = Model::from_urdf(file, &["gravity = 9.81", "frames(nobody)", "nonsense"]).expect_err("mistakes");
    assert!(found.as_slice().iter().all(|mistake| matches!(mistake.place, Place::Text { line: 3 | 4, .. })), "{found}");
    assert!(found.source().lines().nth(2).is_some_and(|line| line.contains("nobody")));
}

#[test]
fn functions_of_rust_are_not_there() {
    let source = "#[gauss(coordinates(x), particle(mass = m, position = [x, 0, 0]), potential = lift(x), \
                  function(lift = aero::lift, derivative = aero::slope))] struct Wing { m: f64 }";
    let message = "Wing: the equations call `lift`, a function of Rust, which is not there at run time";
    assert_eq!(refused(source).to_string(), message);
}

#[test]
fn parameters_by_other_names() {
    let given: [(&str, &[f64]); 4] = [("m", &[1.0, 2.0]), ("length", &[1.0]), ("g", &[9.81]), ("g", &[9.81])];
    let Err(KernelError::Given(found)) = pendulum().kernel(&given) else { panic!("a kernel") };
    let count = Misgiven::Count { name: "m".into(), expected: 1, found: 2 };
    let [unknown, missing] = [Misgiven::Unknown("length".into()), Misgiven::Missing("l".into())];
    assert_eq!(found, [unknown, count, missing, Misgiven::Repeated("g".into())]);
}

#[test]
fn calls_of_what_is_not_there() {
    let kernel = pendulum().kernel(&[("m", &[1.0]), ("l", &[0.5]), ("g", &[9.81])]).expect("a pendulum");
    let error = kernel.call("linearize", &[&[0.0], &[0.1], &[0.2], &[]]).expect_err("no clause");
    assert!(matches!(&error, CallError::NoMethod { name, known } if name == "linearize" && known.len() > 5), "{error}");
    let error = kernel.acceleration(0.0, &[0.1, 0.2], &[0.2], &[]).expect_err("two angles");
    assert_eq!(error.to_string(), "`q` of `acceleration` has 1 numbers, and 2 are given");
    let error = kernel.call("acceleration", &[&[0.0], &[0.1]]).expect_err("two lists");
    assert!(error.to_string().ends_with("and 2 lists of numbers are given"), "{error}");
    let method = kernel.method("acceleration").expect("it");
    let error = method.call(&[&[0.0], &[0.1], &[0.2], &[]], &mut [0.0; 2]).expect_err("two results");
    assert!(matches!(&error, CallError::Count { name, expected: 1, found: 2, .. } if name == "results"), "{error}");
    // What is not a number gives what is none, and no panic.
    assert!(kernel.acceleration(0.0, &[f64::NAN], &[0.2], &[]).expect("a call")[0].is_nan());
    assert!(kernel.acceleration(0.0, &[1e300], &[0.2], &[]).expect("a call")[0].is_finite());
}

#[test]
fn kernels_outlive_their_models_and_are_shared_by_threads() {
    let kernel = {
        let model = pendulum();
        assert!(model.equations(Notation::Text).contains("angle") && !model.accuracy().is_empty());
        assert!(model.operations().any(|(name, counts)| name == "acceleration" && counts.transcendentals > 0));
        model.kernel(&[("m", &[1.0]), ("l", &[0.5]), ("g", &[9.81])]).expect("a pendulum")
    };
    let expected = -9.81 / 0.5 * 0.1_f64.sin();
    // Each compiles what it calls first, and some load models of their own meanwhile.
    thread::scope(|scope| {
        for place in 0..8 {
            let kernel = &kernel;
            scope.spawn(move || {
                let own = pendulum().kernel(&[("m", &[2.0]), ("l", &[0.5]), ("g", &[9.81])]).expect("a pendulum");
                for _ in 0..200 {
                    let kernel = if place % 2 == 0 { kernel } else { &own };
                    let found = kernel.acceleration(0.0, &[0.1], &[0.2], &[]).expect("a call")[0];
                    assert!((found - expected).abs() < 1e-14, "{found}");
                }
            });
        }
    });
}

/// Linux refuses a process executable memory that asks it to; a child of this test does.
#[cfg(target_os = "linux")]
#[test]
fn where_executable_memory_is_refused_methods_are_interpreted() {
    const CHILD: &str = "GAUSS_JIT_REFUSED";
    const REFUSING: &str = "import ctypes, os, sys
if ctypes.CDLL(None).prctl(65, 1, 0, 0, 0) != 0: sys.exit(77)
os.execv(sys.argv[1], sys.argv[1:])";
    if std::env::var_os(CHILD).is_some() {
        let kernel = pendulum().kernel(&[("m", &[1.0]), ("l", &[0.5]), ("g", &[9.81])]).expect("a pendulum");
        let found = kernel.acceleration(0.0, &[0.1], &[0.2], &[]).expect("a call")[0];
        assert!((found + 9.81 / 0.5 * 0.1_f64.sin()).abs() < 1e-14, "{found}");
        assert!(!kernel.method("acceleration").expect("it").is_machine_code());
        assert!(!kernel.method("mass_matrix").expect("it").is_machine_code());
        return;
    }
    let own = std::env::current_exe().expect("this program");
    let mut python = std::process::Command::new("python3");
    python.args(["-c", REFUSING]).arg(own).args(["where_executable_memory", "--nocapture"]).env(CHILD, "1");
    let Ok(output) = python.output() else {
        println!("no Python, which asks for it: nothing tested");
        return;
    };
    if output.status.code() == Some(77) {
        println!("this system does not refuse: nothing tested");
        return;
    }
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    assert_eq!(said.matches("methods are interpreted").count(), 1, "{said}");
}
