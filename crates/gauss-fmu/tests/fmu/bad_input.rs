//! What an FMU is not made of, and what it refuses: each with the clause or the field.

use crate::scenes::{ARMS, CARRIER, GYROSCOPE, PRELUDE, Scene, TORPEDO, run};
use gauss_fmu::{Fmu, FmuError, Version};
use gauss_jit::Model;

fn said(source: &str, parameters: &[(&str, &[f64])]) -> String {
    Fmu::new(source, parameters).map(|_| ()).expect_err("it is refused").to_string()
}

#[test]
fn clauses_without_a_counterpart() {
    let rough = "#[gauss(coordinates(x, y), particle(mass = 1, position = [x, 0, y]),
        contact(floor, gap = y, slip = rate(x), friction = 0.5))] struct A {}";
    assert!(said(rough, &[]).contains("`floor`"), "{}", said(rough, &[]));
    let bears = "#[gauss(coordinates(a), body(arm, rotation = rotation_y(a), mass = 1, inertia = 0.1), reactions(arm),
        contact(stop, gap = a))] struct A {}";
    assert!(said(bears, &[]).contains("`stop`"), "{}", said(bears, &[]));
    let dry = "#[gauss(coordinates(x), particle(mass = 1, position = [x, 0, 0]),
        dry_friction(brake, slip = rate(x), bound = 2))] struct A {}";
    assert!(said(dry, &[]).contains("`brake`"), "{}", said(dry, &[]));
    let rod = "#[gauss(coordinates(x, z), particle(mass = 1, position = [x, 0, z]),
        constraint(position = x * x + z * z - 1))] struct Rod {}";
    assert!(said(rod, &[]).contains("`constraint`"), "{}", said(rod, &[]));
    let own = "#[gauss(coordinates(x), particle(mass = 1, position = [x, 0, 0]), potential = lift(x),
        function(lift = aero::lift, derivative = aero::slope))] struct Wing {}";
    assert!(said(own, &[]).contains("`lift`"), "{}", said(own, &[]));
}

#[test]
fn scenes_parameters_and_start_values() {
    assert!(said("#[gauss(coordinates(x), particle(mas = 1, position = [x, 0, 0]))] struct A {}", &[]).contains("mas"));
    assert!(said(TORPEDO.source, &TORPEDO.parameters[1..]).contains('m'));
    let wrong = Fmu::new(CARRIER.source, &[("g", &[f64::NAN])]);
    assert!(matches!(wrong, Err(FmuError::Parameters(_))), "{wrong:?}");
    let fmu = || Fmu::new(CARRIER.source, CARRIER.parameters).expect("a scene");
    let message = fmu().start(&[("slid", 1.0)]).map(|_| ()).expect_err("no state").to_string();
    assert!(message.contains("`slid`") && message.contains("slide"), "{message}");
    assert!(fmu().start(&[("slide", f64::INFINITY)]).is_err());
}

#[test]
fn files_that_cannot_be_written_leave_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let fmu = Fmu::new(CARRIER.source, CARRIER.parameters).expect("a scene");
    for name in ["3arm.fmu", "my-arm.fmu", "arm.zip", "arm"] {
        let error = fmu.write(folder.path().join(name)).expect_err("no name").to_string();
        assert!(error.contains("names no binary"), "{error}");
    }
    // A folder stands where the file would.
    std::fs::create_dir(folder.path().join("arm.fmu")).expect("a folder");
    fmu.write(folder.path().join("arm.fmu")).expect_err("a folder is there");
    let left: Vec<_> = std::fs::read_dir(folder.path()).expect("it is there").collect();
    assert_eq!(left.len(), 1, "{left:?}");
}

/// The message that is logged when a variable is set to a number, and the status of the call that says so.
fn refused(scene: &Scene, name: &str, sets: &[(&str, f64)]) -> Option<Vec<String>> {
    let sets: String = sets
        .iter()
        .map(|(name, value)| format!("    printf(\"%d\\n\", set(a, \"{name}\", {}));\n", number(*value)))
        .collect();
    let main = format!(
        "{PRELUDE}int main(void)\n{{\n    fmi2Component a = make(fmi2CoSimulation);\n\
         fmi2SetupExperiment(a, 0, 0, 0, 0, 0);\n{sets}\
         fmi2EnterInitializationMode(a);\n    printf(\"%d\\n\", fmi2ExitInitializationMode(a));\n    return 0;\n}}\n"
    );
    run(&scene.fmu(Version::Two), &format!("refused_{name}"), &main)
}

fn number(value: f64) -> String {
    if value.is_nan() {
        "NAN".to_owned()
    } else if value.is_infinite() {
        "INFINITY".to_owned()
    } else {
        format!("{value:?}")
    }
}

#[test]
fn numbers_that_an_instance_refuses() {
    let Some(lines) = refused(&TORPEDO, "nan", &[("m", f64::NAN), ("g", f64::INFINITY), ("u_x", f64::NAN)]) else {
        return;
    };
    let found = lines.iter().map(|line| line.replace("-nan", "nan")).collect::<Vec<_>>();
    let log = |name: &str, value: &str| format!("log `{name}` is set to {value}: it must be finite");
    // What was there before stays.
    assert_eq!(
        found,
        [log("m", "nan"), "3".into(), log("g", "inf"), "3".into(), log("u_x", "nan"), "3".into(), "0".into()]
    );
    let poses: Vec<(&str, f64)> = vec![("body_w", 0.0)];
    let names = TORPEDO.fmu(Version::Two).description("torpedo").expect("it");
    let quaternion = names.split('"').find(|word| word.ends_with("_w")).expect("a pose").to_owned();
    let poses = [(quaternion.as_str(), poses[0].1)];
    let lines = refused(&TORPEDO, "quaternion", &poses).expect("a compiler");
    assert!(lines[1].contains("are no rotation"), "{lines:?}");
    assert_eq!(lines.last().map(String::as_str), Some("3"));
}

/// Parameters that `kernel()` refuses are refused by the FMU, with the same field, and those that it takes are taken.
#[test]
fn parameters_are_checked_as_kernels_check_them() {
    let cases: [(&Scene, &str, f64); 14] = [
        (&TORPEDO, "m", 0.0),
        (&TORPEDO, "m", -1.0),
        (&TORPEDO, "m", 1e-3),
        (&TORPEDO, "i[1]", -0.1),
        (&TORPEDO, "i[2]", 8.0),
        (&TORPEDO, "d", -1.0),
        (&TORPEDO, "c[1]", 3.0),
        (&TORPEDO, "x[1]", -31.0),
        (&GYROSCOPE, "m", 30.0),
        (&GYROSCOPE, "i[3]", 0.5),
        (&ARMS, "lower.mass", 0.0),
        (&ARMS, "lower.inertia[1,2]", 0.05),
        (&ARMS, "upper.inertia[2,2]", -0.05),
        (&ARMS, "k", -1.0),
    ];
    for (case, (scene, name, value)) in cases.into_iter().enumerate() {
        let Some(lines) = refused(scene, &format!("check_{case}"), &[(name, value)]) else { return };
        let (field, place) = name.split_once('[').unwrap_or((name, ""));
        let place: Vec<usize> = place.trim_end_matches(']').split(',').filter_map(|k| k.parse().ok()).collect();
        let place = match place[..] {
            [k] => k - 1,
            [i, j] => 3 * (i - 1) + j - 1,
            _ => 0,
        };
        let mut numbers: Vec<(&str, Vec<f64>)> =
            scene.parameters.iter().map(|(own, list)| (*own, list.to_vec())).collect();
        numbers.iter_mut().filter(|(own, _)| *own == field).for_each(|(_, list)| list[place] = value);
        let given: Vec<(&str, &[f64])> = numbers.iter().map(|(own, list)| (*own, &list[..])).collect();
        let kernel = Model::from_source(scene.source).expect("a scene").kernel(&given);
        match kernel {
            Ok(_) => assert_eq!(lines, ["0", "0"], "{name} = {value}: the kernel takes it"),
            Err(error) => {
                assert_eq!(lines.last().map(String::as_str), Some("3"), "{name} = {value}: {lines:?}, and {error}");
                let label = lines[1].split('`').nth(1).unwrap_or_default();
                assert!(error.to_string().contains(label), "{name} = {value}: {lines:?}, and {error}");
            }
        }
    }
}

/// A chart that becomes singular is said, and no step passes over it.
#[test]
fn a_singular_chart() {
    let main = format!(
        "{PRELUDE}int main(void)\n{{\n    fmi2Component a = make(fmi2CoSimulation);\n\
         fmi2SetupExperiment(a, 0, 0, 0, 0, 0);\n    set(a, \"g\", 0.0);\n    set(a, \"c[3]\", 0.0);\n\
         set(a, \"theta_dot\", 1.0);\n    fmi2EnterInitializationMode(a);\n\
         printf(\"%d\\n\", fmi2ExitInitializationMode(a));\n    printf(\"%d\\n\", fmi2DoStep(a, 0.0, 1.0, 1));\n\
         printf(\"%d\\n\", fmi2DoStep(a, 1.0, 1.0, 1));\n\
         printf(\"%d\\n\", fabs(a ? ((instance *)a)->now.time - 1.5708 : 9.0) < 1e-3);\n    return 0;\n}}\n"
    );
    let Some(lines) = run(&GYROSCOPE.fmu(Version::Two), "singular", &main) else { return };
    assert_eq!(lines[..2], ["0", "0"], "{lines:?}");
    assert!(lines.iter().any(|line| line.contains("chart is singular") || line.contains("no step from")), "{lines:?}");
    assert_eq!(lines[lines.len() - 2..], ["3", "1"], "{lines:?}");
}
