//! Folder in which examples leave their files.

use std::env;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// Cargo writes a file of this name into every target directory that it makes, but into none that was there before.
const MARK: &str = "CACHEDIR.TAG";
/// Cargo keeps what it knows of a profile's crates in the folder of the profile, one below the target directory.
const KNOWN: &str = ".fingerprint";

/// The folder `gauss` in Cargo's target directory, for what examples write.
///
/// It is in the directory that the running program was built in, wherever `CARGO_TARGET_DIR`, `--target-dir` or a
/// configuration of Cargo has put that; of a program that was copied elsewhere, in `CARGO_TARGET_DIR` or `target`.
/// Below the current folder the path is relative.
#[must_use]
pub fn output_folder() -> PathBuf {
    let (program, here) = (env::current_exe().unwrap_or_default(), env::current_dir().unwrap_or_default());
    let folder = target(&program, env::var_os("CARGO_TARGET_DIR")).join("gauss");
    folder.strip_prefix(here).map(Path::to_owned).unwrap_or(folder)
}

/// The folder that the program is asked to write to by its first argument, else [`output_folder`].
#[must_use]
pub fn output_folder_or_argument() -> PathBuf {
    env::args_os().nth(1).map_or_else(output_folder, PathBuf::from)
}

fn target(program: &Path, variable: Option<OsString>) -> PathBuf {
    let folders = || program.ancestors().skip(1);
    let of_profile = folders().find(|folder| folder.join(KNOWN).is_dir()).and_then(Path::parent);
    let marked = of_profile.or_else(|| folders().find(|folder| folder.join(MARK).is_file()));
    let named = || variable.filter(|name| !name.is_empty()).map_or_else(|| PathBuf::from("target"), PathBuf::from);
    marked.map_or_else(named, Path::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_directory_that_cargo_has_marked_comes_first() {
        let root = tempfile::tempdir().unwrap();
        let built = root.path().join("elsewhere/release/examples");
        std::fs::create_dir_all(&built).unwrap();
        let program = built.join("hello_top");
        let variable = || Some(OsString::from("/named"));
        // No mark yet: a copy of the program.
        assert_eq!(target(&program, variable()), Path::new("/named"));
        assert_eq!(target(&program, Some(OsString::new())), Path::new("target"));
        assert_eq!(target(&program, None), Path::new("target"));
        std::fs::write(root.path().join("elsewhere/CACHEDIR.TAG"), "Signature: 8a477f597d28d172789f06886806bc55")
            .unwrap();
        assert_eq!(target(&program, variable()), root.path().join("elsewhere"));
    }

    /// Somebody else has made the directory, within one that is marked.
    #[test]
    fn a_directory_without_the_mark_is_known_by_its_profile() {
        let root = tempfile::tempdir().unwrap();
        std::fs::create_dir_all(root.path().join("mine/debug/.fingerprint")).unwrap();
        std::fs::write(root.path().join("CACHEDIR.TAG"), "").unwrap();
        for program in ["mine/debug/gauss-first", "mine/debug/examples/hello_top", "mine/debug/deps/gauss_files-1"] {
            assert_eq!(target(&root.path().join(program), None), root.path().join("mine"), "{program}");
        }
    }

    /// This test is itself a program that Cargo has built.
    #[test]
    fn it_is_the_directory_of_this_build() {
        let folder = std::path::absolute(output_folder()).unwrap();
        assert_eq!(folder.file_name().unwrap(), "gauss");
        assert!(env::current_exe().unwrap().starts_with(folder.parent().unwrap()), "{}", folder.display());
    }
}
