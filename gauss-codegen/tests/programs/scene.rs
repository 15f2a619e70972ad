//! Scenes that are written in Rust: the same programs, equations and code as those of structs, and mistakes by clause.

use gauss_codegen::{Clause, Derivation, Field, Mistake, Notation, Scene};

/// A vehicle in a chart, in a stream, with a rudder.
fn vehicle() -> Scene {
    Scene::new("Vehicle")
        .chart("left_invariant")
        .linearize()
        .inputs(["thrust", "rudder"])
        .clause(Clause::new("medium").with("velocity", "s * sin(t)"))
        .clause(Clause::new("define").with("v", "body.relative_velocity"))
        .clause(Clause::new("drag").with("linear", "e"))
        .clause(
            Clause::new("force")
                .name("fin")
                .with("at", "a")
                .with("value", ["thrust", "l * v.x * abs(v.x) * clamp(rudder, -0.25, 0.3)", "0.1"]),
        )
        .field(Field::new("m", "f64").role("mass"))
        .field(Field::new("c", "Vector3<f64>").role("center_of_mass"))
        .field(Field::new("i", "Vector3<f64>").role("inertia"))
        .field(Field::new("g", "Vector3<f64>").role("gravity"))
        .field(Field::new("s", "Vector3<f64>"))
        .field(Field::new("a", "Vector3<f64>"))
        .field(Field::new("l", "f64"))
        .field(Field::new("e", "Matrix6<f64>"))
}

const VEHICLE: &str = "
    #[gauss(chart = left_invariant, linearize, input(thrust, rudder), medium(velocity = s * sin(t)),
        define(v = body.relative_velocity), drag(linear = e),
        force(fin, at = a, value = [thrust, l * v.x * abs(v.x) * clamp(rudder, -0.25, 0.3), 0.1]))]
    struct Vehicle {
        #[gauss(mass)] m: f64, #[gauss(center_of_mass)] c: Vector3<f64>, #[gauss(inertia)] i: Vector3<f64>,
        #[gauss(gravity)] g: Vector3<f64>, s: Vector3<f64>, a: Vector3<f64>, l: f64, e: Matrix6<f64>,
    }";

/// Two arms and a weight, with a potential and a stop; its scalar is generic.
fn arms() -> Scene {
    let turned = |parent: &str, name: &str, angle: &str| {
        let body = Clause::new("body").name(name);
        let body = if parent.is_empty() { body } else { body.with("parent", parent).with("position", ["l", "0", "0"]) };
        body.with("rotation", format!("rotation_y({angle})"))
    };
    Scene::new("Arms")
        .generic("T")
        .coordinates(["a", "b"])
        .clause(turned("", "upper", "a"))
        .clause(turned("upper", "lower", "b"))
        .particle(0.25, "lower.position + lower.rotation * [l, 0, 0]")
        .clause(Clause::new("stop").with("along", "b").with("least", -1.5).with("stiffness", "k").with("width", 1e-3))
        .potential("k * a * a / 2")
        .clause(Clause::equals("limit", 50_000_i64))
        .field(Field::new("upper", "RigidBody<T>").role("body"))
        .field(Field::new("lower", "RigidBody<T>").role("body"))
        .field(Field::new("l", "T").unit("m").documentation("Of both."))
        .field(Field::new("k", "T").unit("N m"))
        .field(Field::new("g", "T").role("gravity"))
}

const ARMS: &str = "
    #[gauss(coordinates(a, b), body(upper, rotation = rotation_y(a)),
        body(lower, parent = upper, position = [l, 0, 0], rotation = rotation_y(b)),
        particle(mass = 0.25, position = lower.position + lower.rotation * [l, 0, 0]),
        stop(along = b, least = -1.5, stiffness = k, width = 0.001), potential = k * a * a / 2, limit = 50000)]
    struct Arms<T> {
        #[gauss(body)] upper: RigidBody<T>, #[gauss(body)] lower: RigidBody<T>,
        /// Of both.
        #[gauss(unit = \"m\")] l: T,
        #[gauss(unit = \"N m\")] k: T,
        #[gauss(gravity)] g: T,
    }";

/// A knife edge with speeds of its own, by multipliers.
fn sleigh() -> Scene {
    Scene::new("Sleigh")
        .coordinates(["x", "y", "s"])
        .speeds(["v", "w", "u"])
        .kinematics([("x", "v"), ("y", "w"), ("s", "u")])
        .clause(Clause::new("body").name("sleigh").with("position", ["x", "y", "0"]).with("rotation", "rotation_z(s)"))
        .clause(Clause::new("constraint").with("velocity", "dot(sleigh.velocity, sleigh.rotation * [0, 1, 0])"))
        .field(Field::new("sleigh", "RigidBody<f64>").role("body"))
}

const SLEIGH: &str = "
    #[gauss(coordinates(x, y, s), speeds(v, w, u), kinematics(x = v, y = w, s = u),
        body(sleigh, position = [x, y, 0], rotation = rotation_z(s)),
        constraint(velocity = dot(sleigh.velocity, sleigh.rotation * [0, 1, 0])))]
    struct Sleigh { #[gauss(body)] sleigh: RigidBody<f64> }";

#[test]
fn the_same_programs_as_from_tokens() {
    for (scene, name, source) in [(vehicle(), "Vehicle", VEHICLE), (arms(), "Arms", ARMS), (sleigh(), "Sleigh", SLEIGH)]
    {
        let built = Derivation::of_scene(&scene).unwrap_or_else(|mistakes| panic!("{name}: {mistakes:?}"));
        let read = Derivation::of_source(source, name).unwrap_or_else(|mistakes| panic!("{name}: {mistakes}"));
        assert_eq!(built.name(), name);
        assert_eq!(built.constants(), read.constants(), "{name}");
        assert_eq!(built.programs(), read.programs(), "{name}");
        for notation in [Notation::Text, Notation::Latex] {
            assert_eq!(built.equations(notation), read.equations(notation), "{name}");
        }
        assert_eq!(built.rust().expect("code").to_string(), read.rust().expect("code").to_string(), "{name}");
        // What it says in Rust says it again.
        let again =
            Derivation::of_source(&scene.source(), name).unwrap_or_else(|mistakes| panic!("{name}: {mistakes}"));
        assert_eq!(again.programs(), read.programs(), "{name}");
    }
}

fn mistakes(scene: &Scene) -> Vec<Mistake> {
    let Err(mistakes) = Derivation::of_scene(scene) else { panic!("no mistake in\n{}", scene.source()) };
    mistakes
}

/// The clauses of all mistakes, in the order in which they are found.
fn clauses(scene: &Scene) -> Vec<String> {
    mistakes(scene).into_iter().map(|mistake| mistake.clause).collect()
}

#[test]
fn mistakes_are_named_by_their_clause() {
    assert_eq!(clauses(&sleigh().potential("k * x")), ["potential"]);
    assert_eq!(clauses(&sleigh().potential(f64::NAN)), ["potential"]);
    assert_eq!(clauses(&sleigh().clause(Clause::new("bodi").name("other"))), ["bodi(other)"]);
    assert_eq!(clauses(&sleigh().field(Field::new("m", "f64").role("mas"))), ["m"]);
    assert_eq!(clauses(&sleigh().field(Field::new("l", "f64").unit("furlong"))), ["l"]);
    // All at once, each with its own; of expressions over several lines too.
    let force = Clause::new("force").name("push").with("at", "sleigh.position").with("value", "[1,\n2,\nnothing]");
    let wrong = sleigh().clause(force).potential("cos(x");
    assert_eq!(clauses(&wrong), ["potential"]);
    let force = Clause::new("force").name("push").with("at", "sleigh.position").with("value", "[1,\n2,\nnothing]");
    assert_eq!(clauses(&sleigh().clause(force).potential("y * nowhere")), ["force(push, …)", "potential"]);
    // What is of the whole has its name.
    assert_eq!(clauses(&Scene::new("Nothing")), ["Nothing", "Nothing"]);
}

/// A text is one piece: it cannot end its clause and begin another.
#[test]
fn a_text_stands_for_itself() {
    for text in ["x), limit = (3", "x, y", "x // y", "", "x /* y"] {
        let found = mistakes(&sleigh().potential(text));
        assert!(found.iter().all(|mistake| mistake.clause == "potential"), "{text}: {found:?}");
    }
    assert_eq!(clauses(&Scene::new("A {} struct B")), ["A {} struct B"]);
    assert_eq!(clauses(&sleigh().field(Field::new("l", "f64, m: f64"))), ["l"]);
}

/// A motor with a coil.
#[test]
fn states_of_elements() {
    let scene = Scene::new("Motor")
        .coordinates(["x"])
        .inputs(["volts"])
        .particle("m", ["x", "0", "0"])
        .states([("amps", "(volts - r * amps) / l")])
        .clause(Clause::new("drive").with("x", "amps"));
    let scene = ["m", "r", "l"].into_iter().fold(scene, |scene, name| scene.field(Field::new(name, "f64")));
    let derived = Derivation::of_scene(&scene).expect("a scene without mistakes");
    assert!(derived.equations(Notation::Text).contains("damps/dt = volts/l - r*amps/l"));
    let rates = derived.programs().iter().find(|program| program.name == "configuration_rates").expect("it has states");
    assert_eq!(rates.results[0].rows, 2);
    let missing = Derivation::of_scene(&scene.clause(Clause::new("states").name("heat"))).expect_err("no rate");
    assert!(missing[0].message.contains("the state `heat` has no rate"), "{missing:?}");
}
