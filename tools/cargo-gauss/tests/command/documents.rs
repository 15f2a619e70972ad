//! Scenes and robots as models of MuJoCo and as URDF.

use std::fs;
use std::path::Path;

use super::{ARM, BODIES, file, gauss, printed, refused};

const SWING: [&str; 5] = ["--as", "mjcf", "--set", "m=2", "--set"];

#[test]
fn a_struct_is_shown_with_its_numbers() {
    let file = file("mjcf.rs", BODIES);
    let file = file.to_str().expect("UTF-8");
    let text = printed(&[&["show", file, "Swing"], &SWING[..], &["k=3"]].concat());
    for part in
        ["<mujoco model=\"Swing\">", "<joint name=\"x\" type=\"slide\" axis=\"1 0 0\" stiffness=\"3\"/>", "mass=\"2\""]
    {
        assert!(text.contains(part), "{part}\n{text}");
    }
    let top = printed(&["show", file, "Top", "--as", "mjcf", "--set", "m=1", "--set", "i=1,2,2.5"]);
    assert!(top.contains("type=\"ball\"") && top.contains("diaginertia=\"1 2 2.5\""), "{top}");
}

#[test]
fn robots_are_shown_with_gravity_and_clauses() {
    let file = file("mjcf.urdf", ARM);
    let file = file.to_str().expect("UTF-8");
    let text = printed(&["show", file, "--as", "mjcf"]);
    assert!(text.contains("gravity=\"0 0 -9.81\"") && text.contains("<motor name=\"elbow\" joint=\"elbow\""), "{text}");
    let text = printed(&["show", file, "--as", "mjcf", "--set", "g=1.62", "--clause", "frames(upper)"]);
    assert!(text.contains("gravity=\"0 0 -1.62\""), "{text}");
}

#[test]
fn what_is_lost_is_said_line_by_line() {
    let source =
        "#[derive(GaussDynamics)] #[gauss(coordinates(x), particle(mass = 1, position = [x, 0, 0]), range(x, to = 2))]
                  struct Rail {}";
    let file = file("mjcf_lost.rs", source);
    let output = gauss(&["show", file.to_str().expect("UTF-8"), "--as", "mjcf"]);
    let words = String::from_utf8(output.stderr).expect("UTF-8");
    assert!(output.status.success() && words.lines().count() == 2, "{words}");
    assert!(words.lines().all(|line| line.starts_with("remark: ")) && words.contains("soft in MuJoCo"), "{words}");
}

#[test]
fn urdf_says_what_it_lacks() {
    let file = file("documents.rs", BODIES);
    let output =
        gauss(&["show", file.to_str().expect("UTF-8"), "Swing", "--as", "urdf", "--set", "m=2", "--set", "k=3"]);
    let [text, words] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).expect("UTF-8"));
    assert!(text.contains("<robot name=\"Swing\">") && text.contains("<mass value=\"2\"/>"), "{text}{words}");
    assert!(words.contains("remark: of `potential` nothing is left"), "{words}");
    let words =
        refused(&["show", file.to_str().expect("UTF-8"), "Top", "--as", "urdf", "--set", "m=1", "--set", "i=1,2,2.5"]);
    assert!(words.contains("no counterpart in URDF: `rotation` turns about a point"), "{words}");
}

#[test]
fn what_cannot_be_leaves_nothing_behind() {
    let source = "#[derive(GaussDynamics)] #[gauss(coordinates(x), particle(mass = 1, position = [x, 0, 0]),
                  potential = x * x * x * x, drive(gust, x = sin(t)))] struct Rail {}";
    let rail = file("mjcf_refused.rs", source);
    let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join("mjcf_refused.xml");
    let out = out.to_str().expect("UTF-8");
    fs::write(out, "before").expect("a file");
    let words = refused(&["show", rail.to_str().expect("UTF-8"), "--as", "mjcf", "-o", out]);
    assert!(words.contains("no counterpart in MJCF: `potential`, `gust`: no sum of springs"), "{words}");
    assert_eq!(fs::read_to_string(out).expect("a file"), "before");
    // No file can be made below a file.
    let bodies = file("mjcf_written.rs", BODIES);
    let below = format!("{out}/swing.xml");
    let own = ["show", bodies.to_str().expect("UTF-8"), "Swing", "-o", &below];
    let words = refused(&[&own[..], &SWING[..], &["k=3"]].concat());
    assert!(words.contains("swing.xml") && fs::read_to_string(out).expect("a file") == "before", "{words}");
    let folder = Path::new(out).parent().expect("a folder");
    let left = fs::read_dir(folder).expect("a folder").flatten();
    let left = left.filter(|own| own.file_name().to_string_lossy().contains("swing.xml"));
    assert_eq!(left.count(), 0);
}

#[test]
fn wrong_arguments_are_said() {
    let file = file("mjcf_wrong.rs", BODIES);
    let file = file.to_str().expect("UTF-8");
    let cases: [(&[&str], &str); 7] = [
        (&[file, "--as", "mjcf"], "it has several structs; its name behind the file takes one of Top, Swing"),
        (&[file, "Top", "Swing", "--as", "mjcf"], "one struct at a time"),
        (&[file, "Swing", "--as", "mjcf", "--set", "m=2"], "`k` is not given"),
        (&[file, "Swing", "--as", "mjcf", "--set", "m"], "write `name=number`"),
        (&[file, "Swing", "--as", "mjcf", "--clause", "frames(x)"], "`--clause` goes with the file of a robot"),
        (&[file, "Swing", "--as", "c", "--set", "m=2"], "go with `--as mjcf` and `urdf`"),
        (&[file, "Swing", "--as", "mjcf", "--charts", "hybrid"], "`--charts` has no meaning"),
    ];
    for (arguments, words) in cases {
        let found = refused(&[&["show"], arguments].concat());
        assert!(found.contains(words), "{arguments:?}: {found}");
    }
}
