//! Words of the field that the language does not have: one message, which says what is written instead.

use super::{check, check_body, read, with};
use crate::model::language::role_words::ROLES;
use crate::model::language::statements::STATEMENTS;
use crate::model::language::struct_clauses::CLAUSES;
use crate::model::language::synonyms::{FOR_ARGUMENTS, FOR_CLAUSES, FOR_ROLES, LAWS};

#[test]
fn clauses_beside_a_chart() {
    check_body(
        "#[gauss(chart = hybrid, moment(value = [0, 0, 1]))]",
        &[("moment", "unknown clause `moment`; a moment is `torque(body = other, value = [0, 0, m])`")],
    );
    check_body(
        "#[gauss(Thruster = 3)]",
        &[(
            "Thruster",
            "unknown clause `Thruster`; a value that arrives at run time is an input, and acts by a clause: `input(thrust), \
             force(body = hull, at = […], value = [thrust, 0, 0])`; with the mass that it burns `mass_flow(…)`",
        )],
    );
}

#[test]
fn what_would_have_moved_is_not_missing_as_well() {
    check(
        "#[gauss(hinge(angle), body(arm, mass = 1, inertia = 1, rotation = rotation_z(angle)))] struct Arm { l: f64 }",
        &[(
            "hinge",
            "unknown clause `hinge`; a hinge is a body that a coordinate turns: `coordinates(angle), \
             body(arm, parent = other, rotation = rotation_z(angle))`",
        )],
    );
}

/// Each of these words has a clause of its own: one message for all three led to the wrong one.
#[test]
fn what_touches_and_what_joints_bear() {
    let scene = |clause: &str| {
        format!("#[gauss(coordinates(x), particle(mass = 1, position = [0, 0, x]), {clause})] struct Ball {{ e: f64 }}")
    };
    let wanted = [
        ("unilateral(gap = x)", "`contact(name, gap = height)`; a coordinate that stays between"),
        ("impact(gap = x, restitution = e)", "impacts follow from what touches and need no clause: `contact(name, gap"),
        ("reaction(ball)", "what a joint bears is asked for by `reactions(arm)`"),
    ];
    for (clause, remedy) in wanted {
        let Err(error) = read(&scene(clause)).map(drop) else { panic!("{clause} is no clause") };
        let error = error.to_string();
        let word = clause.split('(').next().expect("a word");
        assert!(error.contains(&format!("unknown clause `{word}`")) && error.contains(remedy), "{clause}: {error}");
    }
}

/// Methods of a run, or of a kernel, that are written as clauses are told so, and nothing else of the scene is missing.
#[test]
fn methods_for_clauses() {
    let run = "Simulation::new(&kernel)";
    let delay = format!("`{run}.sampled(period, law).delayed(time)`; a lag of first order is `states(late = (");
    let wanted = [
        ("delay(0.01)", delay.as_str()),
        ("sampled(0.01)", "a control law is given to the run: `input(u)` here, and `Simulation::new(&kernel).input(|t"),
        ("adaptive(1e-9, 1e-9)", "the integrator and its steps are chosen at run time: `Simulation::new(&kernel)"),
        (
            "event(x = 0)",
            "events are those of the run: `Simulation::new(&kernel).event(Crossing::Falling, |t, q, z| …)`",
        ),
        ("until(x = 0)", "`.until(…)` where the run ends"),
        ("noise(gyro = 0.1)", "a `Stream` of `gauss-study`"),
        ("initial(x = 0)", "is told to it: `Simulation::new(&kernel).adaptive(1e-9, 1e-12).run(q, z, 0.0..10.0)`"),
        ("observe(x)", "what comes out is asked of the run: `.observe(|sample| …)`"),
        ("hessian", "words of `linearize`: `linearize(hessian, inverse)`"),
        ("lugre(x, s0 = 3)", "is written as `states(bristle = …)` and `drive(x = …)`"),
    ];
    for (clause, remedy) in wanted {
        let scene = format!("#[gauss(coordinates(x), {clause})] struct Ball {{ e: f64 }}");
        let Err(error) = read(&scene).map(drop) else { panic!("{clause} is no clause") };
        let error = error.to_string();
        let word = clause.split('(').next().expect("a word");
        assert!(
            error.starts_with(&format!("unknown clause `{word}`; ")) && error.contains(remedy),
            "{clause}: {error}"
        );
    }
    check_body(
        "#[gauss(chart = hybrid, gravity_torques)]",
        &[("gravity_torques", "`gravity_torques` is a method of the kernel; write `methods(gravity_torques)`")],
    );
}

/// The methods by which a run is put together, as they stand in the runtime: each is a clause, or a word that is told
/// what it is.
#[test]
fn all_methods_of_runs() {
    const RUNS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../gauss-runtime/src/integrate/drive/runs");
    // Those that nobody takes for a clause of a scene: constructors, questions to a simulation, what fronts hand on.
    let others = ["new", "of", "problem", "boxed", "control", "events_by", "into_parts", "stepper"];
    let mut found = Vec::new();
    for file in ["simulation.rs", "sampling.rs"] {
        let text = std::fs::read_to_string(format!("{RUNS}/{file}")).expect("the runtime");
        let methods = text.lines().filter_map(|line| line.strip_prefix("    pub fn "));
        found.extend(methods.filter_map(|rest| rest.split(['(', '<']).next()).map(str::to_owned));
    }
    assert!(found.len() > 25, "{found:?}");
    for word in found.iter().filter(|word| !others.contains(&word.as_str())) {
        let is = |table: &[&str]| table.contains(&word.as_str());
        let clauses: Vec<_> = STATEMENTS.iter().map(|(name, _)| *name).collect();
        let told: Vec<_> = FOR_CLAUSES.iter().map(|(name, _)| *name).collect();
        assert!(is(&clauses) || is(&told), "{word}");
    }
}

/// Laws of friction that have a state: as arguments of what has none, and nothing else is missing there.
#[test]
fn laws_with_states() {
    const PLACED: &str = "particle(mass = 1, position = [x, 0, 0])";
    let scene = |clause: &str| format!("#[gauss(coordinates(x), {PLACED}, {clause})] struct Scene {{ k: f64 }}");
    let states = "friction with a state, as LuGre's and Dahl's, is written as `states(bristle = …)` and `drive(x = …)`; LuGre's is \
                  the example of the guide's chapter `Elements with states`";
    for (clause, word) in [
        ("friction(f, lugre = 3)", "lugre"),
        ("friction(f, along = x, dahl = 3)", "dahl"),
        ("friction(f, along = x, viscous = 1, Bristles = 3)", "Bristles"),
        ("dry_friction(x, lugre = 3)", "lugre"),
    ] {
        let owner = clause.split('(').next().expect("a word");
        let message = format!("unknown argument of `{owner}`: `{word}`; {states}");
        check(&scene(clause), &[(word, message.as_str())]);
    }
    check(
        &scene("friction(f, along = x, stribeck = 3)"),
        &[(
            "stribeck",
            "unknown argument of `friction`: `stribeck`; friction that falls with the speed is a law of your own, as \
             `drive(x = -f * exp(-abs(v) / slow) * tanh(v / width))`; LuGre's, with a state, is the example of the guide's \
             chapter `Elements with states`",
        )],
    );
}

#[test]
fn roles() {
    check(
        &with("#[gauss(com)] c: Vector3<f64>, #[gauss(volume)] v: f64"),
        &[
            ("com", "unknown role `com`; write `center_of_mass`, from O in body axes"),
            (
                "volume",
                "unknown role `volume`; write `displaced_mass`: the density of the fluid times the volume, in kg",
            ),
        ],
    );
    // What is meant is not missing as well.
    check(
        "struct Body { #[gauss(mass)] m: f64, #[gauss(inertia_tensor)] j: Matrix3<f64> }",
        &[("inertia_tensor", "unknown role `inertia_tensor`; write `inertia`, about O in body axes")],
    );
}

#[test]
fn arguments() {
    let scene =
        |clauses: &str| format!("#[gauss(coordinates(x), gravity = 9.81, {clauses})] struct Scene {{ k: f64 }}");
    check(
        &scene("body(cart, position = [x, 0, 0], mass = 1, com = [0, 0, 1], moment_of_inertia = 1)"),
        &[
            ("com", "unknown argument of `body`: `com`; write `center_of_mass`, from O in body axes"),
            (
                "moment_of_inertia",
                "unknown argument of `body`: `moment_of_inertia`; write `inertia`, about O in body axes, or \
                 `inertia_about_center_of_mass`",
            ),
        ],
    );
    // What is meant is not missing as well.
    check(
        &scene("particle(bob, m = 1, location = [x, 0, 0])"),
        &[
            ("bob", "a particle has no name: remove it, and write its place where something acts on it"),
            ("m", "unknown argument of `particle`: `m`; write `mass`"),
            ("location", "unknown argument of `particle`: `location`; write `position`"),
        ],
    );
    check(
        &scene("particle(mass = 1, position = [x, 0, 0]), spring(along = x, spring_constant = k)"),
        &[("spring_constant", "unknown argument of `spring`: `spring_constant`; write `stiffness`")],
    );
    check(
        &scene(
            "body(cart, position = [x, 0, 0], mass = 1, inertia = 1), force(body = cart, position = [0, 0, 0], vector = [k, 0, 0])",
        ),
        &[
            ("position", "unknown argument of `force`: `position`; write `at`"),
            ("vector", "unknown argument of `force`: `vector`; write `value`"),
        ],
    );
}

/// No word of the language has a synonym's message, and each message is about one word.
#[test]
fn words_are_new_and_stand_once() {
    let clauses: Vec<_> = FOR_CLAUSES.iter().chain(LAWS).map(|(word, _)| *word).collect();
    let roles: Vec<_> = FOR_ROLES.iter().map(|(word, _)| *word).collect();
    for word in &clauses {
        assert!(!CLAUSES.iter().any(|(name, _)| name == word), "{word}");
        assert!(!STATEMENTS.iter().any(|(name, _)| name == word), "{word}");
        assert!(!ROLES.iter().any(|(name, _)| name == word), "{word}");
    }
    assert!(roles.iter().all(|word| !ROLES.iter().any(|(name, _)| name == word)));
    let arguments = FOR_ARGUMENTS.iter().map(|(word, _)| *word).collect();
    for words in [clauses, roles, arguments] {
        let mut sorted = words.clone();
        sorted.sort_unstable();
        sorted.dedup();
        assert_eq!(sorted.len(), words.len());
    }
}

/// The clauses that the messages tell to write are clauses: those that stand alone are read without complaint.
#[test]
fn remedies_are_read() {
    let scene = |clauses: &str| {
        format!(
            "#[gauss(coordinates(x), body(hull, position = [x, 0, 0], mass = 1, inertia = 1), {clauses})] \
             struct Scene {{ m: f64, k: f64, e: f64, a: f64, b: f64, c: f64 }}"
        )
    };
    for clauses in [
        "torque(body = hull, value = [0, 0, m])",
        "input(thrust), force(body = hull, at = [0, 0, 0], value = [thrust, 0, 0])",
        "particle(mass = m, position = [x, 0, 0])",
        "gravity = 9.81, body(tank, mass = 1, inertia = 1, position = [0, x, 0], displaced_mass = m, \
         center_of_buoyancy = [0, 0, a])",
        "medium(velocity = [1, 0, 0]), drag(body = hull, linear = [1, 1, 1, 1, 1, 1])",
        "friction(along = x, viscous = c)",
        "stop(along = x, least = 0, stiffness = k, width = e)",
        "stop(along = x, least = a, most = b, stiffness = k, width = e)",
        "armature(x = a)",
        "contact(floor, gap = x)",
        "contact(floor, gap = x, restitution = e)",
        "range(x, from = a, to = b)",
        "range(x, from = a, to = b, restitution = e)",
        "frame(site, parent = hull, position = [1, 0, 0])",
        "input(command), states(late = (command - late) / k), drive(x = late)",
        "define(v = rate(x)), states(bristle = v), drive(x = -bristle)",
        "define(v = rate(x)), drive(x = -a * exp(-abs(v) / b) * tanh(v / e))",
        "linearize(hessian, inverse)",
        "linearize(parameters)",
    ] {
        if let Err(error) = read(&scene(clauses)) {
            panic!("{clauses}: {error}");
        }
    }
    let joints = "#[gauss(coordinates(angle, x, turn: Rotation), body(hull, mass = 1, inertia = 1), \
                  body(arm, parent = hull, rotation = rotation_z(angle), mass = m, inertia = [a, a, c]), \
                  body(cart, parent = hull, position = [x, 0, 0], mass = 1, inertia = 1), \
                  body(ball, parent = hull, rotation = turn, mass = 1, inertia = 1), \
                  coupling(body = arm, other = hull, viscous = c), \
                  torsional_spring(body = arm, other = hull, stiffness = c), \
                  bushing(body = arm, other = hull, stiffness = [a, a, a, c, c, c], damping = [1, 1, 1, 1, 1, 1]), \
                  input(motor), torque(body = arm, value = [0, 0, motor], reaction = hull), drive(angle = motor), \
                  reactions(arm))] \
                  struct Scene { m: f64, a: f64, c: f64 }";
    if let Err(error) = read(joints) {
        panic!("{error}");
    }
}
