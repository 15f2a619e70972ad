//! Modes of bodies: in the clause and from files, and what is refused of them.

use super::{check, model, read};
use crate::model::Integral;

/// A craft with a panel, and the modes of that.
fn craft(modes: &str) -> String {
    format!(
        "#[gauss(coordinates(base: Pose, a, b), body(hull, pose = base, mass = 9, inertia = [1, 1, 1]), \
         body(panel, parent = hull, mass = 4, center_of_mass = [1, 0, 0], inertia = [0, 8, 8]), {modes})] \
         struct Craft {{ k: f64, d: Vector3<f64> }}"
    )
}

#[track_caller]
fn mistakes(modes: &str, expected: &[(&str, &str)]) {
    check(&craft(modes), expected);
}

#[test]
fn matrices_by_rows_and_by_diagonals() {
    let model = model(&craft(
        "modes(panel, coordinates = [a, b], translation = [[0, 0, 1], [0, d.y, 0.5]], stiffness = [2 * k, 3], \
         damping = [[1, 0.5], [0.5, 1]])",
    ));
    let [clause] = model.modes.as_slice() else { panic!("one clause") };
    let entries = |integral| clause.find(integral).map(|given| given.entries.len());
    assert_eq!(clause.coordinates.len(), 2);
    assert_eq!(entries(Integral::Translation), Some(6));
    assert_eq!(entries(Integral::Stiffness), Some(4));
    assert_eq!(entries(Integral::Damping), Some(4));
    assert_eq!(entries(Integral::Mass), None);
}

#[test]
fn names() {
    mistakes(
        "modes(coordinates = [a, b], stiffness = [1, 1])",
        &[("modes", "modes are those of a body; write `modes(panel, coordinates = [a, b], file = \"panel.json\")`")],
    );
    mistakes(
        "modes(panel, stiffness = [1, 1])",
        &[
            ("modes", "modes need a coordinate each; add `coordinates = [a, b]` with names of `coordinates(…)`"),
            // Nothing else moves by them.
        ],
    );
    mistakes(
        "modes(panl, coordinates = [a, base], stiffness = [1, 1])",
        &[
            ("panl", "no body is called `panl`; did you mean `panel`?"),
            ("base", "`base` is no scalar, and the coordinate of a mode is one; write it in `coordinates(base)`"),
        ],
    );
    mistakes(
        "modes(panel, coordinates = [a, a], stiffness = [1, 1]), modes(panel, coordinates = [b], stiffness = [1])",
        &[
            ("a", "`a` is the coordinate of a mode already; name another"),
            ("panel", "`panel` has modes already; write all of them in one clause"),
        ],
    );
}

#[test]
fn shapes() {
    mistakes(
        "modes(panel, coordinates = [a, b], translation = [[0, 0, 1]], rotation = [[0, 0], [0, 0, 1]], stiffness = 3, \
         shortening = [[1, 2], [3, 4]])",
        &[
            ("[", "`translation` is a list of 2, one for each mode, found 1"),
            ("[", "`rotation[0]` is a list of 3, found 2"),
            ("3", "`stiffness` is a list of 2, one for each mode, found a scalar"),
            ("1", "`shortening[0][0]` is a list of 3, found a scalar"),
        ],
    );
    mistakes(
        "modes(panel, coordinates = [a, b], stiffness = [a, 1], masses = [1, 1])",
        &[("masses", "unknown argument of `modes`: `masses`; did you mean `mass`?")],
    );
    mistakes(
        "modes(panel, coordinates = [a, b], stiffness = [a, 1])",
        &[("a", "`a` varies, and the integral of modes is constant; write numbers and fields only")],
    );
}

#[test]
fn numbers_that_no_body_has() {
    mistakes(
        "modes(panel, coordinates = [a, b], translation = [[0, 0, 1], [0, 1, 0]])",
        &[("modes", "modes without `stiffness` are not held by anything; give K, or ω² of modes of unit modal mass")],
    );
    mistakes(
        "modes(panel, coordinates = [a, b], mass = [1, 0], damping = [1, -1], stiffness = [[1, 2], [2.001, 9]])",
        &[
            ("stiffness", "`stiffness` is symmetric in its modes, and its entries [0][1] and [1][0] differ"),
            ("mass", "the matrix `mass` of modes is not positive definite; check its signs and units"),
            ("damping", "the matrix `damping` of modes has a negative eigenvalue; check its signs and units"),
        ],
    );
    // The whole panel moves with the first mode: δ₀² ≤ m M. 2.001 of 2 is too much, 2 is all.
    let of = |d: &str| {
        format!(
            "modes(panel, coordinates = [a, b], translation = [[0, 0, {d}], [0, 0, 0]], rotation = [[0, -{d}, 0], [0, 0, 0]], \
             stiffness = [1, 1])"
        )
    };
    assert!(read(&craft(&of("2"))).is_ok());
    mistakes(
        &of("2.001"),
        &[(
            "modes",
            "the modes of `panel` take more of the mass than the body has: with `translation` δ₀, `rotation` δ₁ and `mass` M \
         the matrix [[m, −m c×, δ₀], [m c×, I_O, δ₁], [δ₀ᵀ, δ₁ᵀ, M]] has a negative eigenvalue; check units and the pole \
         O, and that modal masses and participations are of the same normalisation",
        )],
    );
}

#[cfg(feature = "modes")]
mod files {
    use std::path::PathBuf;
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::super::read;

    /// A file that lives as long as a test.
    struct Scratch(PathBuf);

    impl Scratch {
        fn new(text: &str) -> Self {
            static NEXT: AtomicUsize = AtomicUsize::new(0);
            let number = NEXT.fetch_add(1, Ordering::Relaxed);
            let path = std::env::temp_dir().join(format!("gauss-modes-{}-{number}.json", std::process::id()));
            std::fs::write(&path, text).expect("a folder for files that do not stay");
            Self(path)
        }
    }

    impl Drop for Scratch {
        fn drop(&mut self) {
            // What is left behind in the folder for it harms nobody.
            let _ = std::fs::remove_file(&self.0);
        }
    }

    fn source(file: &Scratch, body: &str) -> String {
        format!(
            "#[gauss(coordinates(base: Pose, a, b), body(hull, pose = base, mass = 9, inertia = [1, 1, 1]), \
             body(panel, parent = hull {body}), modes(panel, coordinates = [a, b], file = {:?}))] struct Craft {{}}",
            file.0
        )
    }

    /// All mistakes, without the path of the file.
    #[track_caller]
    fn mistakes(text: &str, body: &str, expected: &[&str]) {
        let file = Scratch::new(text);
        let error = read(&source(&file, body)).err().unwrap_or_else(|| panic!("accepted: {text}"));
        let path = file.0.to_string_lossy().into_owned();
        let found: Vec<String> =
            error.into_iter().map(|error| error.to_string().replace(&path, "panel.json")).collect();
        assert_eq!(found, expected, "{text}");
    }

    #[test]
    fn a_file_has_the_body_and_its_modes() {
        let file = Scratch::new(
            r#"{"comment": "a panel", "mass": 4, "center_of_mass": [1, 0, 0],
                "inertia": [[0, 0, 0], [0, 8, 0], [0, 0, 8.5]],
                "modes": {"translation": [[0, 0, 1e-1], [0, 0, 0.25]], "stiffness": [2, 3]}}"#,
        );
        let model = read(&source(&file, "")).unwrap_or_else(|error| panic!("{error}"));
        let panel = model.bodies.iter().find(|body| body.word() == "panel").expect("it is there");
        assert_eq!(panel.role_clauses.len(), 3);
        assert_eq!(model.modes[0].integrals.len(), 2);
        assert_eq!(model.item.tracked, [file.0.to_string_lossy()]);
    }

    #[test]
    fn what_is_wrong_in_a_file() {
        mistakes("{\n \"modes\": {,}}", "", &["panel.json:2:12: key must be a string"]);
        mistakes("[1, 2]", "", &["panel.json: expected an object with `modes`, and the mass data of the body"]);
        mistakes(
            r#"{"mas": 4, "inertia": [1, 2], "modes": {"translatoin": [], "rotation": [[0, 0, 1]],
                "stiffness": [[1, 2], [3, "x"]], "damping": [[1, 2], [3]]}}"#,
            "",
            &[
                "panel.json: unknown key `mas`; did you mean `mass`?",
                "panel.json: `inertia` is a list of three numbers, or three of them",
                "panel.json: unknown key `modes.translatoin`; did you mean `translation`?",
                "panel.json: `modes.rotation` is a list of 2, one for each mode, found 1",
                "panel.json: `modes.damping[1]` is a list of 2, found 1",
                "panel.json: `modes.stiffness[1][1]` is a number or a list of numbers",
            ],
        );
        mistakes(r#"{"mass": 4}"#, "", &["panel.json: `modes` is missing; add `\"modes\": {\"stiffness\": […], …}`"]);
        mistakes(
            r#"{"mass": 4, "inertia": [8, 8, 8], "modes": {"stiffness": [1, 1]}}"#,
            ", mass = 3, inertia = 1",
            &["`mass` is given twice; keep one of the two", "`inertia` is given twice; keep one of the two"],
        );
        mistakes(
            r#"{"mass": 4, "inertia": [8, 8, 8], "modes": {"stiffness": [1, -1]}}"#,
            "",
            &["panel.json: the matrix `stiffness` of modes has a negative eigenvalue; check its signs and units"],
        );
    }

    #[test]
    fn a_file_that_is_not_there() {
        let error = read(
            "#[gauss(coordinates(a), body(panel, mass = 1, inertia = 1), \
             modes(panel, coordinates = [a], file = \"nowhere.json\"))] struct Panel {}",
        );
        let message = error.err().map(|error| error.to_string()).unwrap_or_default();
        assert!(message.starts_with("nowhere.json: "), "{message}");
    }
}
