//! The code of a struct is kept from one build to the next where the compiler keeps its own results: it is used as long
//! as nothing has changed that it depends on, and what the compiler says of it stays where it was.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::SystemTime;

/// A package of one file beside the file of a robot, compiled again and again.
struct Package {
    folder: PathBuf,
}

impl Package {
    fn new(name: &str) -> Self {
        let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("kept_expansions").join(name);
        if folder.exists() {
            fs::remove_dir_all(&folder).expect("what an earlier run left");
        }
        fs::create_dir_all(folder.join("libraries")).expect("a folder");
        let package = Self { folder };
        package.take_libraries();
        package
    }

    /// Libraries that were there before this test. What is compiled beside tests may be half of a file, and another
    /// macro among them is one that the compiler may have loaded.
    fn take_libraries(&self) {
        let this = std::env::current_exe().expect("this test");
        let before = fs::metadata(&this).and_then(|about| about.modified()).expect("a time");
        for entry in fs::read_dir(this.parent().expect("its folder")).expect("libraries") {
            let path = entry.expect("a library").path();
            let kind = path.extension().and_then(|kind| kind.to_str()).unwrap_or_default();
            let is_library = ["rlib", "rmeta", std::env::consts::DLL_EXTENSION].contains(&kind);
            // What is gone meanwhile was not one of them.
            if is_library && fs::metadata(&path).and_then(|about| about.modified()).is_ok_and(|time| time <= before) {
                let own = self.folder.join("libraries").join(path.file_name().expect("a name"));
                fs::hard_link(&path, own).expect("a library");
            }
        }
    }

    /// Checks the package as Cargo would, against the libraries of this test; what the compiler says.
    fn check(&self, source: &str, keeps: bool) -> String {
        fs::write(self.folder.join("lib.rs"), source).expect("a source");
        let libraries = self.folder.join("libraries");
        let named = |path: &Path| path.file_name().and_then(|name| name.to_str()).unwrap_or_default().to_owned();
        let time = |path: &Path| fs::metadata(path).and_then(|about| about.modified()).expect("a time");
        let runtime = fs::read_dir(&libraries)
            .expect("libraries")
            .map(|entry| entry.expect("a library").path())
            .filter(|path| named(path).starts_with("libgauss_runtime-") && named(path).ends_with(".rlib"))
            .max_by_key(|path| time(path))
            .expect("the runtime");
        let mut rustc = Command::new(std::env::var_os("RUSTC").unwrap_or("rustc".into()));
        rustc.current_dir(&self.folder).env("CARGO_MANIFEST_DIR", &self.folder);
        rustc.args(["lib.rs", "--edition=2024", "--crate-type=lib", "--emit=metadata", "-L"]);
        rustc.arg(format!("dependency={}", libraries.display()));
        rustc.arg(format!("--extern=gauss_runtime={}", runtime.display()));
        if keeps {
            rustc.args(["-C", "incremental=debug/incremental"]);
        }
        String::from_utf8(rustc.output().expect("a compiler").stderr).expect("text")
    }

    /// The expansions that are kept, each with the time of its last use.
    fn kept(&self) -> Vec<(PathBuf, SystemTime)> {
        let Ok(entries) = fs::read_dir(self.folder.join("debug/gauss-derive")) else { return Vec::new() };
        let path = |entry: std::io::Result<fs::DirEntry>| entry.expect("an entry").path();
        let mut kept: Vec<_> = entries
            .map(path)
            .map(|path| (path.clone(), fs::metadata(path).and_then(|about| about.modified()).expect("a time")))
            .collect();
        kept.sort_unstable();
        kept
    }

    /// The one expansion that is kept; then it looks as if nobody had used it for long.
    fn aged(&self) -> Vec<u8> {
        let [(path, _)] = &self.kept()[..] else { panic!("{:?}", self.kept()) };
        let file = File::options().append(true).open(path).expect("the file");
        file.set_modified(SystemTime::UNIX_EPOCH).expect("a time");
        fs::read(path).expect("its bytes")
    }

    fn used(&self) -> bool {
        matches!(&self.kept()[..], [(_, time)] if *time > SystemTime::UNIX_EPOCH)
    }
}

const ROBOT: &str = r#"
use gauss_runtime::prelude::*;
#[derive(GaussDynamics)]
#[gauss(urdf = "panda.urdf", gravity = 9.81, linearize)]
pub struct Arm;
"#;

#[test]
fn code_is_kept_while_its_file_stays() {
    let package = Package::new("robot");
    let robot = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/robots/panda.urdf")).expect("a robot");
    // What acts and is left out is a warning.
    let robot = robot.replacen("type=\"continuous\">", "type=\"continuous\"><dynamics friction=\"0.1\"/>", 1);
    let file = package.folder.join("panda.urdf");
    fs::write(&file, &robot).expect("a file");

    let said = package.check(ROBOT, true);
    let first = package.aged();
    // The warnings of the file are said again, at the token that names it.
    assert!(said.contains("warning") && said.contains("lib.rs:4:"), "{said}");
    assert_eq!(package.check(&format!("{ROBOT}pub fn other() {{}}"), true), said);
    assert!(package.used());
    assert_eq!(package.aged(), first);

    // Another mass of a link: other code, in the place of what no longer holds.
    fs::write(&file, robot.replacen("<mass value=\"", "<mass value=\"1", 1)).expect("a file");
    package.check(ROBOT, true);
    assert!(package.used());
    assert_ne!(package.aged(), first);

    // Bytes that something else has changed are not read.
    let (path, _) = package.kept().remove(0);
    let mut bytes = fs::read(&path).expect("bytes");
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    fs::write(&path, &bytes).expect("a file");
    assert_eq!(package.check(ROBOT, true), said);
    assert_ne!(package.aged(), bytes);

    // Another struct has a file of its own.
    package.check(&ROBOT.replace("9.81", "1.62"), true);
    assert_eq!(package.kept().len(), 2);
}

#[test]
fn nothing_is_kept_where_the_compiler_keeps_nothing() {
    let package = Package::new("plain");
    fs::copy(concat!(env!("CARGO_MANIFEST_DIR"), "/robots/panda.urdf"), package.folder.join("panda.urdf"))
        .expect("a robot");
    assert!(!package.check(ROBOT, false).contains("error"));
    assert_eq!(package.kept(), []);
}

/// A macro does not know what a name of the user's stands for; the compiler does.
#[test]
fn errors_of_the_compiler_stay_at_their_tokens() {
    let package = Package::new("mistake");
    let source = "use gauss_runtime::prelude::*;
type Mass = String;
#[derive(GaussDynamics)]
#[gauss(chart = jet(euler_zyx), linearize)]
pub struct Body {
    #[gauss(mass)] m: Mass,
    #[gauss(center_of_mass)] center: Vector3<f64>,
    #[gauss(inertia)] inertia: Matrix3<f64>,
    #[gauss(added_mass)] added: Matrix6<f64>,
    #[gauss(gravity)] g: f64,
}
";
    let said = package.check(source, true);
    assert!(said.contains("expected `f64`, found `String`") && said.contains("lib.rs:3:"), "{said}");
    package.aged();
    assert_eq!(package.check(source, true), said);
    assert!(package.used());

    // A mistake of the struct is found anew, each time.
    let package = Package::new("wrong");
    let wrong = source.replace("euler_zyx", "euler_zyz_");
    let said = package.check(&wrong, true);
    assert!(said.contains("lib.rs:4:"), "{said}");
    assert_eq!(package.check(&wrong, true), said);
    assert_eq!(package.kept(), []);
}
