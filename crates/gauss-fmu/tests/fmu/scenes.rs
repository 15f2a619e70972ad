//! Scenes of the tests, and programs in C that include the source code of an FMU.

use std::path::PathBuf;
use std::process::Command;

use gauss_fmu::{Fmu, Version};

/// A scene with numbers for its parameters, and start values of states.
pub struct Scene {
    pub name: &'static str,
    pub source: &'static str,
    pub parameters: &'static [(&'static str, &'static [f64])],
    pub start: &'static [(&'static str, f64)],
}

const TENSOR: [f64; 9] = [0.1, 0.0, 0.0, 0.0, 0.1, 0.0, 0.0, 0.0, 0.02];

/// Bodies as fields, frames, reactions, an input, linearize.
pub const ARMS: Scene = Scene {
    name: "arms",
    source: "#[gauss(coordinates(a, b), linearize, frames(lower), reactions(lower), input(motor = \"N m\"),
            body(upper, rotation = rotation_y(a)),
            body(lower, parent = upper, position = [0, 0, -0.71234], rotation = rotation_y(b)),
            spring(along = a - b, stiffness = k, length = 0.1),
            torque(drive, body = lower, value = [0, motor, 0], reaction = upper))]
        struct Arms {
            #[gauss(body)] upper: RigidBody<f64>, #[gauss(body)] lower: RigidBody<f64>, k: f64,
            /// Acceleration of \"free fall\" & more.
            #[gauss(gravity, unit = \"m/s^2\")] g: f64,
        }",
    parameters: &[
        ("upper.mass", &[1.0]),
        ("upper.center_of_mass", &[0.0, 0.0, -0.2]),
        ("upper.inertia", &TENSOR),
        ("lower.mass", &[1.5]),
        ("lower.center_of_mass", &[0.0, 0.0, -0.2]),
        ("lower.inertia", &TENSOR),
        ("k", &[2.0]),
        ("g", &[9.81]),
    ],
    start: &[("a", 0.3), ("b_dot", 1.0)],
};

/// A pose, of which the speeds are in body axes; fluid.
pub const TORPEDO: Scene = Scene {
    name: "torpedo",
    source: "#[gauss(chart = left_invariant, frames(body))] struct Torpedo {
            #[gauss(mass)] m: f64, #[gauss(center_of_mass)] c: Vector3<f64>, #[gauss(inertia)] i: Vector3<f64>,
            #[gauss(added_mass)] x: Vector6<f64>, #[gauss(gravity)] g: f64, #[gauss(displaced_mass)] d: f64 }",
    parameters: &[
        ("m", &[30.0]),
        ("c", &[0.0, 0.0, -0.02]),
        ("i", &[0.2, 3.5, 3.5]),
        ("x", &[0.9, 35.0, 35.0, 0.07, 4.9, 4.9]),
        ("g", &[9.81]),
        ("d", &[30.0]),
    ],
    start: &[("u_x", 1.5), ("omega_x", 0.5), ("omega_y", 1.0)],
};

/// A pose behind a coordinate, a rotation behind the pose: the coordinate comes last in q.
pub const CARRIER: Scene = Scene {
    name: "carrier",
    source: "#[gauss(coordinates(slide, craft: Pose, head: Rotation), linearize,
            body(hull, pose = craft, mass = 5, inertia = [1, 2, 3]),
            body(camera, parent = hull, position = [0.2, 0, slide], rotation = head, mass = 0.5,
                inertia = [0.1, 0.2, 0.15]),
            spring(along = slide, stiffness = 30, damping = 0.2), gravity = g)]
        struct Carrier { g: f64 }",
    parameters: &[("g", &[9.81])],
    start: &[("slide", 0.1), ("craft_omega_x", 0.4), ("head_omega_z", 1.2), ("craft_u_y", -0.3)],
};

/// A pose in the plane.
pub const CAR: Scene = Scene {
    name: "car",
    source: "#[gauss(motion = planar, mass = m, center_of_mass = [0.3, 0.1, 0], inertia = [1, 1, 1.5], frames(body),
            linearize)] struct Car { m: f64 }",
    parameters: &[("m", &[2.0])],
    start: &[],
};

/// A state of an element, an input.
pub const FILTER: Scene = Scene {
    name: "filter",
    source:
        "#[gauss(coordinates(x), particle(mass = m, position = [x, 0, 0]), states(lag = 5 * (x - lag)), input(pull),
            linearize, drive(x = pull - 3 * lag - abs(x) * tanh(x) - powf(1 + x * x, p)))]
        struct Filter { m: f64, p: f64 }",
    parameters: &[("m", &[2.0]), ("p", &[0.7])],
    start: &[("x", 0.5)],
};

/// Angles that are singular at a pitch of 90°.
pub const GYROSCOPE: Scene = Scene {
    name: "gyroscope",
    source: "#[gauss(motion = fixed_point, chart = jet(euler_zyx))] struct Gyroscope {
            #[gauss(mass)] m: f64, #[gauss(center_of_mass)] c: Vector3<f64>, #[gauss(inertia)] i: Vector3<f64>,
            #[gauss(gravity)] g: f64 }",
    parameters: &[("m", &[1.0]), ("c", &[0.0, 0.0, 0.1]), ("i", &[0.2, 0.25, 0.1]), ("g", &[9.81])],
    start: &[],
};

pub const SCENES: [&Scene; 7] = [&BALL, &ARMS, &TORPEDO, &CARRIER, &CAR, &FILTER, &GYROSCOPE];

impl Scene {
    pub fn fmu(&self, version: Version) -> Fmu {
        let fmu = Fmu::new(self.source, self.parameters).unwrap_or_else(|error| panic!("{}: {error}", self.name));
        fmu.start(self.start).unwrap_or_else(|error| panic!("{}: {error}", self.name)).version(version)
    }
}

pub fn compiler() -> Option<&'static str> {
    let found = ["cc", "gcc", "clang"].into_iter().find(|name| Command::new(name).arg("--version").output().is_ok());
    if found.is_none() {
        println!("no C compiler: nothing tested");
    }
    found
}

/// Lines that a program prints which includes the FMU; `None` where there is no compiler. Every warning is an error.
pub fn run(fmu: &Fmu, name: &str, main: &str) -> Option<Vec<String>> {
    let compiler = compiler()?;
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::create_dir_all(&folder).expect("a folder of the test");
    for (file, text) in fmu.sources().expect("its sources") {
        std::fs::write(folder.join(file), text).expect("a file of the test");
    }
    let source = format!("#include \"fmu.c\"\n{main}");
    std::fs::write(folder.join("main.c"), source).expect("a file of the test");
    let strict = ["-std=c99", "-O1", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-ffp-contract=off"];
    let output = Command::new(compiler)
        .args(strict)
        .args(["main.c", "-o", "main", "-lm"])
        .current_dir(&folder)
        .output()
        .expect("the compiler runs");
    assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
    let output = Command::new(folder.join("main")).output().expect("it runs");
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{name}: {text}");
    Some(text.lines().map(str::to_owned).collect())
}

/// The beginning of every program: a logger that prints, an instance, values of variables by name.
pub const PRELUDE: &str = r#"
static void print_log(void *e, fmi2String name, fmi2Status s, fmi2String category, fmi2String text, ...)
{
    (void)e, (void)name, (void)s, (void)category;
    printf("log %s\n", text);
}
static int allocations = 0;
static void *allocate(size_t count, size_t size) { allocations++; return calloc(count, size); }
static const fmi2CallbackFunctions callbacks = {print_log, allocate, free, NULL, NULL};
static fmi2Component make(fmi2Type type)
{
    return fmi2Instantiate("it", type, MODEL_TOKEN, "", &callbacks, 0, 0);
}
static fmi2ValueReference by_name(const char *name)
{
    for (unsigned k = 0; k < VARIABLES; k++) if (!strcmp(names[k], name)) return k;
    printf("no variable %s\n", name);
    return VARIABLES;
}
static inline fmi2Status set(fmi2Component c, const char *name, double value)
{
    const fmi2ValueReference vr = by_name(name);
    return fmi2SetReal(c, &vr, 1, &value);
}
static inline double get(fmi2Component c, const char *name)
{
    const fmi2ValueReference vr = by_name(name);
    double value = NAN;
    fmi2GetReal(c, &vr, 1, &value);
    return value;
}
static inline int begin(fmi2Component c, double tolerance)
{
    return fmi2SetupExperiment(c, 1, tolerance, 0.0, 0, 0.0) + fmi2EnterInitializationMode(c) +
           fmi2ExitInitializationMode(c);
}
static inline void print_all(fmi2Component c)
{
    for (fmi2ValueReference k = 0; k < VARIABLES; k++) {
        double value = NAN;
        const fmi2Status s = fmi2GetReal(c, &k, 1, &value);
        printf("%d %s %.17g\n", s, names[k], value);
    }
}
"#;

/// A ball that bounces.
pub const BALL: Scene = Scene {
    name: "ball",
    source: "#[gauss(coordinates(x, height), particle(mass = m, position = [x, 0, height]),
            contact(floor, gap = height, restitution = e), gravity = g)] struct Ball { m: f64, e: f64, g: f64 }",
    parameters: &[("m", &[2.0]), ("e", &[0.8]), ("g", &[9.81])],
    start: &[("height", 1.0), ("x_dot", 0.5)],
};
