//! The command, as Cargo calls it.

mod documents;
mod languages;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// What `cargo gauss new` writes compiles.
#[allow(dead_code)]
#[path = "../../src/template.rs.txt"]
mod template;

const BODIES: &str = r#"
mod inside {
    #[derive(Debug, gauss_runtime::GaussDynamics)]
    #[gauss(motion = fixed_point, chart = left_invariant)]
    struct Top { #[gauss(mass)] m: f64, #[gauss(inertia)] i: Vector3<f64> }
}
#[derive(GaussDynamics)]
#[gauss(coordinates(x), particle(mass = m, position = [x, 0, 0]), potential = 0.5 * k * x * x)]
struct Swing { m: f64, k: f64 }
struct Other;
"#;

/// A robot of one joint.
const ARM: &str = r#"<robot name="arm"><link name="base"/><link name="upper"><inertial><mass value="1"/>
        <inertia ixx="1" iyy="1" izz="1"/></inertial></link><joint name="elbow" type="continuous"><parent link="base"/>
        <child link="upper"/><axis xyz="0 0 1"/></joint></robot>"#;

/// A file of its own for each test.
fn file(name: &str, text: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::write(&path, text).expect("a folder that can be written");
    path
}

fn gauss(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_cargo-gauss"));
    command.arg("gauss").args(arguments).output().expect("the command runs")
}

fn printed(arguments: &[&str]) -> String {
    let output = gauss(arguments);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("UTF-8")
}

fn refused(arguments: &[&str]) -> String {
    let output = gauss(arguments);
    assert!(!output.status.success());
    String::from_utf8(output.stderr).expect("UTF-8")
}

#[test]
fn all_structs_of_a_file_are_shown() {
    let file = file("all.rs", BODIES);
    let text = printed(&["show", file.to_str().expect("UTF-8")]);
    assert!(text.contains("I1*dω1/dt = (I2 - I3)*ω2*ω3"), "{text}");
    assert!(text.contains("Swing\n=====") && !text.contains("Other"), "{text}");
}

#[test]
fn every_form_is_printed() {
    let file = file("forms.rs", BODIES);
    let of = |form: &str| printed(&["show", file.to_str().expect("UTF-8"), "Swing", "--as", form]);
    assert!(of("latex").starts_with("\\begin{align*}"));
    assert!(of("c").contains("#include <math.h>"));
    assert!(of("header").contains("SWING_Q_COUNT = 1") && of("cpp").contains("namespace swing {"));
    assert!(of("rust").contains("struct SwingKernel"));
    assert!(of("functions").contains("pub fn acceleration"));
    let one = printed(&["show", file.to_str().expect("UTF-8"), "Swing", "--as", "program", "--method", "acceleration"]);
    assert!(one.starts_with("acceleration") && of("program").contains(&one));
    assert!(of("casadi").contains("int jac_swing_acceleration("));
    let of_method = |form: &str, names: &str| {
        ["show", file.to_str().expect("UTF-8"), "Swing", "--as", form, "--method", names].map(str::to_owned)
    };
    let call = |arguments: &[String; 7]| refused(&arguments.each_ref().map(String::as_str));
    assert!(call(&of_method("latex", "acceleration")).contains("`--method` goes with `--as program`"));
    assert!(call(&of_method("c", "nonsense,acceleration")).starts_with("Swing has no method `nonsense`; it has "));
    let single =
        |form: &str| ["show", file.to_str().expect("UTF-8"), "Swing", "--as", form, "--single"].map(str::to_owned);
    let printed_single = |form: &str| printed(&single(form).each_ref().map(String::as_str));
    assert!(printed_single("c").contains("0.5f *") && printed_single("header").contains("const float k["));
    let error = refused(&single("cpp").each_ref().map(String::as_str));
    assert!(error.contains("`--single` goes with `--as c` and `header`"), "{error}");
}

#[test]
fn charts_stand_side_by_side_in_a_page_without_network() {
    let file = file("charts.rs", BODIES);
    let page = file.with_extension("html");
    let [file, page] = [&file, &page].map(|path| path.to_str().expect("UTF-8"));
    let charts = "left_invariant,jet(euler_zyx)";
    assert_eq!(printed(&["show", file, "Top", "--as", "html", "--charts", charts, "--output", page]), "");
    let page = fs::read_to_string(page).expect("the page");
    assert_eq!(page.matches("<section>").count(), 2);
    assert!(page.contains("<h1>Top, left_invariant</h1>") && page.contains("<h1>Top, jet(euler_zyx)</h1>"));
    assert_eq!(page.matches("<math").count(), page.matches("</math>").count());
    // Every formula was set: nothing of LaTeX is left.
    assert!(page.matches("<math").count() > 20 && !page.contains('\\'), "{page}");
    assert!(!page.contains("http://") || page.contains("http://www.w3.org/1998/Math/MathML"));
    assert!(!page.contains("https://") && !page.contains("<script"));
}

#[test]
fn mistakes_have_their_place() {
    let wrong =
        file("wrong.rs", "#[derive(GaussDynamics)]\n#[gauss(chart = sideways)]\nstruct A { #[gauss(mass)] m: f64 }\n");
    let wrong = wrong.to_str().expect("UTF-8");
    let text = refused(&["show", wrong]);
    assert!(text.starts_with(&format!("{wrong}:2:17: ")) && text.contains("sideways"), "{text}");
    assert!(refused(&["show", wrong, "B", "C"]).contains("there is no struct `B` in this file; there is A"));
    assert!(refused(&["show", "no_file.rs"]).starts_with("no_file.rs: "));
}

/// A robot's file is found from the package of the source, wherever the command runs.
#[test]
fn robots_are_those_of_the_package() {
    let package = Path::new(env!("CARGO_TARGET_TMPDIR")).join("with_robot");
    fs::create_dir_all(package.join("src")).expect("a folder that can be written");
    let write = |name: &str, text: &str| fs::write(package.join(name), text).expect("a file that can be written");
    write("Cargo.toml", "[package]\nname = \"with_robot\"\n");
    write("arm.urdf", ARM);
    write("src/main.rs", "#[derive(GaussDynamics)]\n#[gauss(urdf = \"arm.urdf\")]\nstruct Arm;\n");
    let source = package.join("src/main.rs");
    assert!(printed(&["show", source.to_str().expect("UTF-8")]).contains("elbow"));
    write(
        "arm.urdf",
        &ARM.replace("\"base\"/><child", "\"bas\"/><child").replace("child link=\"upper\"", "child link=\"uper\""),
    );
    let text = refused(&["show", source.to_str().expect("UTF-8")]);
    assert!(text.contains("main.rs:2:16: ") && text.contains("did you mean `upper`?"), "{text}");
}

#[test]
fn a_package_is_made_once() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("my_top");
    let _ = fs::remove_dir_all(&folder);
    let clone = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).expect("the workspace");
    let arguments = ["new", folder.to_str().expect("UTF-8"), "--gauss", clone.to_str().expect("UTF-8")];
    printed(&arguments);
    let manifest = fs::read_to_string(folder.join("Cargo.toml")).expect("a manifest");
    assert!(manifest.contains("name = \"my_top\"") && manifest.contains("gauss-runtime\" }"), "{manifest}");
    assert_eq!(
        fs::read_to_string(folder.join("src/main.rs")).expect("a program"),
        include_str!("../../src/template.rs.txt")
    );
    assert!(refused(&arguments).contains("exists"));
    let words =
        ["3d", "std", "core", "alloc", "proc-macro", "test", "fn", "Self", "async", "dyn", "abstract", "typeof"];
    let taken = ["gauss-runtime", "gauss_runtime", "build", "deps", "con", "COM1", "a.b", "a b", "ä", "-", ".."];
    for name in words.into_iter().chain(taken) {
        let folder = format!("{}/{name}", env!("CARGO_TARGET_TMPDIR"));
        assert!(refused(&["new", &folder]).contains("no name of a package"), "{name}");
    }
}

/// Files of a package for Python; that it builds, and what its classes do, is tested where there is Python.
#[test]
fn a_package_for_python_is_made() {
    let clone = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).expect("the workspace");
    let made = |name: &str, more: &[&str]| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        let _ = fs::remove_dir_all(&folder);
        let clone = clone.to_str().expect("UTF-8");
        let arguments = ["create", "--python", folder.to_str().expect("UTF-8"), "--gauss", clone];
        printed(&[&arguments[..], more].concat());
        move |file: &str| fs::read_to_string(folder.join(file)).unwrap_or_else(|error| panic!("{file}: {error}"))
    };
    let read = made("my-swings", &[]);
    assert!(read("src/lib.rs").contains("gauss_python::module!(my_swings: Pendulum<f64>);"));
    assert!(read("pyproject.toml").contains("module-name = \"my_swings\""));
    assert!(read("Cargo.toml").contains("name = \"my_swings\"\ncrate-type = [\"cdylib\"]"));
    let robot = file("two.urdf", ARM);
    let read = made("my_robot", &["--robot", robot.to_str().expect("UTF-8")]);
    assert_eq!(read("my_robot.urdf"), ARM);
    assert!(read("Cargo.toml").contains("features = [\"urdf\"]"));
    let source = read("src/lib.rs");
    assert!(source.contains("urdf = \"my_robot.urdf\"") && syn::parse_file(&source).is_ok(), "{source}");
    assert!(read("Cargo.toml").contains("crates/gauss-python\" }"));
    let text = file("robot.txt", "a robot");
    let arguments = ["create", "--python", "--robot", text.to_str().expect("UTF-8"), "no_such_folder"];
    assert!(refused(&arguments).contains("robots are read from files of URDF"));
}

/// A word that cannot be imported, or would hide what a package needs, is no name.
#[test]
fn names_of_packages_are_names_in_python() {
    let create = |name: &str| refused(&["create", "--python", &format!("{}/{name}", env!("CARGO_TARGET_TMPDIR"))]);
    for (names, why) in [
        (&["class", "lambda", "from", "None", "def"][..], "it is a word of Python"),
        (&["json", "random", "queue"], "a module of this name"),
        (&["numpy", "gauss_python", "gauss-python", "jax"], "needs another one of this name"),
    ] {
        for name in names {
            let told = create(name);
            assert!(told.contains(&format!("`{name}` is no name of a package")) && told.contains(why), "{told}");
        }
    }
    // A program in Rust may be called so.
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("class");
    let _ = fs::remove_dir_all(&folder);
    printed(&["new", folder.to_str().expect("UTF-8")]);
}

/// A robot's file is checked before anything is made: what the compiler would say of it is said, and what of it does
/// not act.
#[test]
fn robots_are_checked_before_a_package_is_made() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("checked_robot");
    let _ = fs::remove_dir_all(&folder);
    let made = |robot: &Path| {
        let (folder, robot) = (folder.to_str().expect("UTF-8"), robot.to_str().expect("UTF-8"));
        gauss(&["create", "--python", folder, "--robot", robot])
    };
    let wrong = file("wrong.urdf", &ARM.replace("child link=\"upper\"", "child link=\"uper\""));
    let output = made(&wrong);
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        !output.status.success() && told.contains("wrong.urdf") && told.contains("did you mean `upper`?"),
        "{told}"
    );
    assert!(!folder.exists());
    let limited = file("limited.urdf", &ARM.replace("<axis", "<limit effort=\"7\" velocity=\"2\"/><axis"));
    let output = made(&limited);
    let told = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success() && told.contains("(`effort`) does not act"), "{told}");
    // Without `--gauss` the crates are those of the clone that the command was built from.
    let manifest = fs::read_to_string(folder.join("Cargo.toml")).expect("a manifest");
    assert!(manifest.contains("path = ") && !manifest.contains("gauss-python = { version"), "{manifest}");
    // The command that shows equations says so, too.
    let shown = printed(&["show", folder.join("src/lib.rs").to_str().expect("UTF-8")]);
    assert!(shown.contains("\nthe file\n- ") && shown.contains("(`effort`) does not act"), "{shown}");
    let page = printed(&["show", folder.join("src/lib.rs").to_str().expect("UTF-8"), "--as", "html"]);
    assert!(page.contains("<h2>The file</h2>") && page.contains("does not act"));
}

/// A file that reads others is copied with them.
#[test]
fn robots_come_with_the_files_that_they_read() {
    let source = Path::new(env!("CARGO_TARGET_TMPDIR")).join("included");
    fs::create_dir_all(source.join("parts")).expect("a folder that can be written");
    let write = |name: &str, text: &str| {
        fs::write(source.join(name), text).expect("a file that can be written");
        source.join(name)
    };
    write(
        "parts/arm.xml",
        "<mujoco><worldbody><body name=\"arm\"><joint name=\"hinge\" axis=\"0 1 0\"/>\
        <geom type=\"sphere\" size=\"0.1\" mass=\"1\"/></body></worldbody></mujoco>",
    );
    let robot = write("robot.xml", "<mujoco><include file=\"parts/arm.xml\"/></mujoco>");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("with_parts");
    let _ = fs::remove_dir_all(&folder);
    let [folder_name, robot] = [&folder, &robot].map(|path| path.to_str().expect("UTF-8"));
    printed(&["create", "--python", folder_name, "--robot", robot]);
    assert!(folder.join("parts/arm.xml").is_file() && folder.join("with_parts.mjcf").is_file());
    assert!(printed(&["show", folder.join("src/lib.rs").to_str().expect("UTF-8")]).contains("hinge"));
}

/// Brackets in brackets, in a struct, beside it and around it.
#[test]
fn what_is_nested_deeply_is_no_overflow() {
    let nested =
        |open: &str, inside: &str, close: &str| format!("{}{inside}{}", open.repeat(20_000), close.repeat(20_000));
    let deep = |text: &str| refused(&["show", file("deep.rs", text).to_str().expect("UTF-8")]);
    let clause = BODIES.replace("0.5 * k", &nested("(", "k", ")"));
    assert!(deep(&clause).contains("nested more than 128 levels deep"));
    let types = BODIES.replace("i: Vector3<f64>", &format!("i: {}", nested("Option<", "f64", ">")));
    assert!(deep(&types).contains("nested more than 128 levels deep"));
    let none = "no struct of this file derives GaussDynamics";
    assert!(deep(&format!("fn f() -> u8 {{ {} }}", nested("(", "1", ")"))).contains(none));
    assert!(deep(&nested("{", "", "}")).contains(none));
    assert!(deep(&"(".repeat(20_000)).contains("this is no Rust"));
    let beside = format!("{BODIES} fn f() -> u8 {{ {} }}", nested("-", "1", ""));
    let modules = nested("mod a {", BODIES, "}");
    for text in [beside, modules] {
        let path = file("deep_beside.rs", &text);
        assert!(printed(&["show", path.to_str().expect("UTF-8"), "Swing"]).contains("Swing\n====="));
    }
}

/// An FMU is made of a robot, of a scene with numbers for its parameters; what is wrong leaves no file.
#[test]
fn fmus_of_robots_and_scenes() {
    let (arm, scene) = (file("fmu_arm.urdf", ARM), file("fmu_bodies.rs", BODIES));
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let path = |name: &str| folder.join(name).to_str().expect("UTF-8").to_owned();
    let [arm, scene] = [&arm, &scene].map(|path| path.to_str().expect("UTF-8"));
    for name in ["fmu_arm.fmu", "fmu_swing.fmu", "fmu_bad.fmu"] {
        let _ = fs::remove_file(folder.join(name));
    }
    let said = printed(&["create", "--fmu", &path("fmu_arm"), "--robot", arm, "--clause", "frames(upper)"]);
    assert!(said.contains("fmu_arm.fmu: source code"), "{said}");
    assert!(folder.join("fmu_arm.fmu").is_file());
    let swing = ["create", "--fmu", &path("fmu_swing.fmu"), "--scene", scene, "--of", "Swing", "--fmi", "3"];
    printed(&[&swing[..], &["--set", "m=2", "--set", "k=3.5", "--start", "x=-0.5"]].concat());
    assert!(folder.join("fmu_swing.fmu").is_file());
    let bad = ["create", "--fmu", &path("fmu_bad"), "--scene", scene];
    assert!(refused(&bad).contains("--of NAME"), "{}", refused(&bad));
    let bad = [&bad[..], &["--of", "Swing"]].concat();
    let with = |more: &[&str]| refused(&[&bad[..], more].concat());
    assert!(with(&["--set", "m=2"]).contains('k'));
    assert!(with(&["--set", "m=-2", "--set", "k=1"]).contains("m"));
    assert!(with(&["--set", "m=2", "--set", "k=1", "--start", "y=1"]).contains("no state `y`"));
    assert!(with(&["--set", "m"]).contains("name=number"));
    assert!(refused(&["create", "--fmu", &path("fmu_bad")]).contains("--robot FILE"));
    assert!(!folder.join("fmu_bad.fmu").exists());
}
