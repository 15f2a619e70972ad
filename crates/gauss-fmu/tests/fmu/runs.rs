//! FMUs that run, in programs of C, beside `Simulation` of the same scene.

use crate::scenes::{ARMS, BALL, CAR, CARRIER, FILTER, PRELUDE, SCENES, Scene, TORPEDO, run};
use gauss_fmu::Version;
use gauss_jit::Model;
use gauss_runtime::prelude::*;

/// The end of a run by the FMU: values by name, and what was logged.
fn values(lines: &[String]) -> Vec<(String, f64)> {
    let value = |line: &String| {
        let (status, rest) = line.split_once(' ')?;
        let (name, value) = rest.rsplit_once(' ')?;
        (status == "0").then(|| (name.to_owned(), value.parse().expect("a number")))
    };
    lines.iter().filter_map(value).collect()
}

fn stepped(scene: &Scene, tolerance: f64, input: f64) -> Option<Vec<(String, f64)>> {
    let main = format!(
        "{PRELUDE}int main(void)\n{{\n    fmi2Component a = make(fmi2CoSimulation), b = make(fmi2CoSimulation);\n\
         if (begin(a, {tolerance:?}) + begin(b, 1e-4)) return 1;\n\
         for (int k = 0; k < 20; k++) {{\n\
             for (fmi2ValueReference u = FIRST_INPUT; u < FIRST_STATE; u++) {{\n\
                 const double one = {input:?}, other = -2.0 * k;\n\
                 fmi2SetReal(a, &u, 1, &one);\n        fmi2SetReal(b, &u, 1, &other);\n    }}\n\
             if (fmi2DoStep(b, 0.13 * k, 0.13, 1) + fmi2DoStep(a, 0.1 * k, 0.1, 1)) return 2;\n}}\n\
         print_all(a);\n    if (allocations != 2) return 3;\n\
         fmi2FreeInstance(a);\n    fmi2FreeInstance(b);\n    return 0;\n}}\n"
    );
    let lines = run(&scene.fmu(Version::Two), &format!("stepped_{}", scene.name), &main)?;
    Some(values(&lines))
}

/// Steps in an FMU come to where `Simulation` comes, while a second instance runs with other inputs.
///
/// Each step errs by at most the tolerance, 1e-11 of 1 + |x|; a run of 2 s takes less than 10³ steps, and motions of
/// these scenes drift apart by less than a factor of 100 in that time.
#[test]
fn co_simulation_is_the_motion_of_simulation() {
    let bound = 1e-11 * 1e3 * 100.0;
    for scene in [&ARMS, &TORPEDO, &CARRIER, &CAR, &FILTER] {
        let Some(found) = stepped(scene, 1e-11, 0.3) else { return };
        let model = Model::from_source(scene.source).expect("a scene");
        let kernel = model.kernel(scene.parameters).expect("parameters");
        let system = kernel.system::<16, 16, SVector<f64, 1>>().expect("room for it");
        let value = |name: &str| found.iter().find(|(own, _)| own == name).map(|(_, value)| *value);
        let names = state_names(&model);
        let counts = [kernel.method("acceleration").expect("it").arguments()[1].components.len()];
        let start = |name: &String| {
            let own = scene.start.iter().find(|(own, _)| own == name).map(|(_, value)| *value);
            let at_rest = f64::from(u8::from(name.ends_with("_w") || name.ends_with("_cos")));
            own.unwrap_or(at_rest)
        };
        let all: Vec<f64> = names.iter().map(start).collect();
        let q = system.configuration(&all[..counts[0]]);
        let z = SVector::<f64, 16>::from_fn(|i, _| all.get(counts[0] + i).copied().unwrap_or(0.0));
        let simulation = Simulation::new(&system).adaptive(1e-13, 1e-14);
        let simulation = simulation.input(|_t: f64, _q: &_, _z: &_| SVector::from([0.3]));
        let end = simulation.run_to_end(q, z, 0.0..2.0).expect("a run");
        let reached = end.q.as_slice()[..counts[0]].iter().chain(end.z.as_slice());
        for (name, expected) in names.iter().zip(reached) {
            let found = value(name).unwrap_or(f64::NAN);
            assert!(
                (found - expected).abs() <= bound * (1.0 + expected.abs()),
                "{}, {name}: {found} in the FMU, {expected} by Simulation",
                scene.name
            );
        }
        assert!(
            all.iter().zip(&names).any(|(at, name)| value(name).is_some_and(|end| (end - at).abs() > 0.05))
                || scene.name == "car"
        );
    }
}

/// Names of states, in the order of q and z.
fn state_names(model: &Model) -> Vec<String> {
    use gauss_jit::QuantityKind::{Scalar, Vector};
    let coordinates = &model.description().coordinates;
    let is_plain = |own: &&gauss_jit::Quantity| matches!(own.kind, Scalar | Vector(_));
    let groups = coordinates.iter().filter(|own| !is_plain(own));
    let all = groups.chain(coordinates.iter().filter(is_plain)).chain(&model.description().speeds);
    all.flat_map(|own| own.numbers.clone()).collect()
}

/// Rates and outputs of the start, for every scene: the numbers of the kernel's methods.
#[test]
fn rates_and_outputs_are_those_of_the_kernel() {
    for scene in SCENES {
        let main = format!(
            "{PRELUDE}int main(void)\n{{\n    fmi2Component a = make(fmi2ModelExchange);\n\
            if (begin(a, 1e-6)) return 1;\n    print_all(a);\n    return 0;\n}}\n"
        );
        let Some(lines) = run(&scene.fmu(Version::Two), &format!("rates_{}", scene.name), &main) else { return };
        let found = values(&lines);
        let model = Model::from_source(scene.source).expect("a scene");
        let kernel = model.kernel(scene.parameters).expect("parameters");
        let names = state_names(&model);
        let value = |name: &str| found.iter().find(|(own, _)| own == name).map_or(f64::NAN, |(_, value)| *value);
        let states: Vec<f64> = names.iter().map(|name| value(name)).collect();
        let method = kernel.method("acceleration").expect("it");
        let (q, z) = states.split_at(method.arguments()[1].components.len());
        let u = vec![0.0; method.arguments()[3].components.len()];
        let expected = kernel.acceleration(0.0, q, z, &u).expect("it");
        for (name, expected) in names[q.len()..].iter().zip(&expected) {
            let found = value(&format!("der({name})"));
            assert!(
                (found - expected).abs() <= 1e-12 * (1.0 + expected.abs()),
                "{}, {name}: {found}, {expected}",
                scene.name
            );
        }
        let rates = match kernel.call("configuration_rates", &[&[0.0], q, z, &u]) {
            Ok(rates) => rates,
            Err(_) => kernel.call("kinematics", &[&[0.0], q, z]).expect("it"),
        };
        let mut expected = vec![0.0; q.len()];
        kernel.component_rates(q, &rates, &mut expected).expect("groups");
        for (name, expected) in names.iter().zip(&expected) {
            let found = value(&format!("der({name})"));
            assert!(
                (found - expected).abs() <= 1e-12 * (1.0 + expected.abs()),
                "{}, {name}: {found}, {expected}",
                scene.name
            );
        }
        let energy = kernel.kinetic_energy(0.0, q, z).expect("it");
        assert!((value("kinetic_energy") - energy).abs() <= 1e-12 * (1.0 + energy.abs()), "{}", scene.name);
    }
}

/// A state that was got, or serialised, gives the same bits again; bytes of another model are refused.
#[test]
fn states_can_be_gone_back_to() {
    let main = format!(
        "{PRELUDE}int main(void)\n{{\n    fmi2Component a = make(fmi2CoSimulation), b = make(fmi2CoSimulation);\n\
        fmi2FMUstate state = NULL, read = NULL;\n    static char bytes[sizeof(memory) + 100];\n    size_t size;\n\
        if (begin(a, 1e-8) + begin(b, 1e-6)) return 1;\n\
        if (fmi2DoStep(a, 0.0, 0.7, 0) + fmi2GetFMUstate(a, &state)) return 2;\n\
        if (fmi2DoStep(a, 0.7, 1.1, 0)) return 3;\n    const double end = get(a, \"b\");\n\
        if (fmi2SerializedFMUstateSize(a, state, &size) + fmi2SerializeFMUstate(a, state, bytes, size)) return 4;\n\
        if (fmi2SetFMUstate(a, state) + fmi2DoStep(a, 0.7, 1.1, 0)) return 5;\n\
        printf(\"%d\\n\", get(a, \"b\") == end);\n\
        if (fmi2DeSerializeFMUstate(b, bytes, size, &read) + fmi2SetFMUstate(b, read)) return 6;\n\
        if (fmi2DoStep(b, 0.7, 1.1, 0)) return 7;\n    printf(\"%d\\n\", get(b, \"b\") == end);\n\
        bytes[1]++;\n    printf(\"%d\\n\", fmi2DeSerializeFMUstate(b, bytes, size, &read));\n\
        fmi2FreeFMUstate(a, &state);\n    printf(\"%d\\n\", state == NULL);\n    return 0;\n}}\n"
    );
    let Some(lines) = run(&ARMS.fmu(Version::Two), "states", &main) else { return };
    assert_eq!(lines, ["1", "1", "log these bytes are no state of this model", "3", "1"]);
}

/// The derivatives along single directions: those of `linearize` where coordinates are plain, and of all scenes those
/// by differences, of all unknowns by all knowns.
#[test]
fn directional_derivatives() {
    for scene in SCENES {
        let main = format!("{PRELUDE}{DERIVATIVES}");
        let Some(lines) = run(&scene.fmu(Version::Two), &format!("derivatives_{}", scene.name), &main) else { return };
        assert_eq!(lines, ["done"], "{}", scene.name);
    }
}

/// Central differences of second order: the error is h² of the third derivative, and rounding over h; both are below
/// 1e-6 of the size of what is differentiated where h is 1e-5.
const DERIVATIVES: &str = r#"
static double values_at[2][VARIABLES];
/* Constants without the checks, which refuse tensors that are not symmetric. */
static void model_constants_alone(instance *i)
{
    double read[ROOM(MODEL_READ)];
    for (int k = 0; k < MODEL_READ; k++) read[k] = i->now.parameters[read_parameters[k]];
    model_constants(read, i->now.constants);
    i->now.has_constants = 1;
}
int main(void)
{
    fmi2Component a = make(fmi2ModelExchange);
    if (begin(a, 1e-6) + fmi2NewDiscreteStates(a, &(fmi2EventInfo){0})) return 1;
    instance *i = a;
    for (int k = 0; k < STATES; k++) i->now.states[k] += 0.1 * sin(3.0 * k + 1.0);
    for (int k = 0; k < MODEL_U; k++) i->now.inputs[k] = 0.4;
    for (fmi2ValueReference known = 0; known < FIRST_RATE; known++) {
        double one = 1.0, size = 1.0;
        static double exact[VARIABLES];
        static fmi2ValueReference unknowns[VARIABLES];
        const size_t count = VARIABLES - FIRST_RATE;
        for (size_t k = 0; k < count; k++) unknowns[k] = FIRST_RATE + (fmi2ValueReference)k;
        double *own = known == 0 ? &i->now.time : known < FIRST_INPUT ? &i->now.parameters[known - FIRST_PARAMETER] :
                      known < FIRST_STATE ? &i->now.inputs[known - FIRST_INPUT] : &i->now.states[known - FIRST_STATE];
        const double middle = *own, h = 1e-5;
        i->now.has_rates = i->now.has_outputs = 0;
        model_constants_alone(i);
        if (fmi2GetDirectionalDerivative(a, unknowns, count, &known, 1, &one, exact)) return 2;
        for (int side = 0; side < 2; side++) {
            *own = middle + (side ? h : -h);
            i->now.has_rates = i->now.has_outputs = 0;
            model_constants_alone(i);
            if (fmi2GetReal(a, unknowns, count, values_at[side])) return 3;
        }
        *own = middle;
        for (size_t k = 0; k < count; k++) size = fmax(size, fabs(values_at[0][k]));
        for (size_t k = 0; k < count; k++) {
            const double difference = (values_at[1][k] - values_at[0][k]) / (2.0 * h);
            if (!(fabs(difference - exact[k]) <= 1e-6 * (size + fabs(exact[k])))) {
                printf("d %s / d %s: %.12g, by differences %.12g\n", names[unknowns[k]], names[known], exact[k],
                       difference);
            }
        }
    }
    printf("done\n");
    return 0;
}
"#;

/// A contact in model exchange: a first bounce with restitution, one that is too short to be another, rest with the
/// force that bears the ball, and where it would pull it opens; below the floor no run starts.
#[test]
fn a_contact_bounces_rests_and_opens() {
    let main = format!(
        "{PRELUDE}static void put(fmi2Component a, double height, double rate)\n{{\n\
             const double states[] = {{0.0, height, 0.5, rate}};\n\
             if (fmi2EnterContinuousTimeMode(a) + fmi2SetContinuousStates(a, states, 4)) printf(\"no\\n\");\n\
             fmi2EnterEventMode(a);\n}}\n\
         static void event(fmi2Component a)\n{{\n    fmi2EventInfo info;\n    double indicator = NAN;\n\
             if (fmi2NewDiscreteStates(a, &info)) printf(\"refused\\n\");\n\
             fmi2GetEventIndicators(a, &indicator, 1);\n\
             printf(\"%d %.12g %.12g %.12g\\n\", info.valuesOfContinuousStatesChanged, get(a, \"height_dot\"),\n\
                 get(a, \"der(height_dot)\"), indicator);\n}}\n\
         int main(void)\n{{\n    fmi2Component a = make(fmi2ModelExchange);\n    if (begin(a, 1e-6)) return 1;\n\
             event(a);\n    put(a, 0.0, -2.0);\n    event(a);\n    put(a, -1e-9, -1e-5);\n    event(a);\n\
             set(a, \"g\", -3.0);\n    event(a);\n\
             printf(\"%d\\n\", make(fmi2CoSimulation) == NULL);\n    fmi2Reset(a);\n    set(a, \"height\", -0.1);\n\
             printf(\"%d\\n\", begin(a, 1e-6) != 0);\n    return 0;\n}}\n"
    );
    let Some(lines) = run(&BALL.fmu(Version::Two), "contact", &main) else { return };
    // Whether values changed, rate, its rate, indicator.
    let expected = ["0 0 -9.81 1", "1 1.6 -9.81 0", "1 0 0 19.62", "0 0 3 0", "1"];
    assert_eq!(lines[..5], expected, "{lines:?}");
    assert_eq!(lines[5], "log the gap of `floor` is -0.1 at the start: it must be zero or greater");
    assert_eq!(lines[6], "1");
}

/// The code of FMI 3.0 compiles, and an instance of it runs.
#[test]
fn the_code_of_version_3_has_no_warnings() {
    for scene in [&ARMS, &BALL, &CARRIER] {
        let main = "int main(void)\n{\n    bool n, t, v, w, x;\n    double next;\n\
            fmi3Instance a = fmi3InstantiateModelExchange(\"it\", MODEL_TOKEN, \"\", 0, 0, NULL, NULL);\n\
            if (!a || fmi3EnterInitializationMode(a, 0, 0, 0, 0, 0) || fmi3ExitInitializationMode(a)) return 1;\n\
            if (fmi3UpdateDiscreteStates(a, &n, &t, &v, &w, &x, &next) || fmi3EnterContinuousTimeMode(a)) return 2;\n\
            double rates[STATES];\n    if (fmi3GetContinuousStateDerivatives(a, rates, STATES)) return 3;\n\
            printf(\"%d\\n\", fmi3SetTime(a, NAN) == fmi3Error);\n    fmi3FreeInstance(a);\n    return 0;\n}\n";
        let Some(lines) = run(&scene.fmu(Version::Three), &format!("three_{}", scene.name), main) else { return };
        assert_eq!(lines, ["1"]);
    }
}
