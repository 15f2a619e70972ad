//! Files are whole, or they are the old ones.

use std::fs;
use std::path::PathBuf;

/// A folder that goes when the test ends.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let folder = std::env::temp_dir().join(format!("gauss_files_{name}_{}", std::process::id()));
        fs::create_dir_all(&folder).expect("a folder that can be written");
        Self(folder)
    }

    fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(&self.0).expect("it exists");
        let mut names: Vec<String> =
            entries.map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

#[test]
fn a_file_is_made_with_its_folders_then_replaced() {
    let folder = Folder::new("made");
    let file = folder.0.join("deeper/run.csv");
    for contents in ["a long first text\n", "short\n", ""] {
        gauss_files::write(&file, contents).expect("a folder that can be written");
        assert_eq!(fs::read_to_string(&file).expect("it is there"), contents);
    }
    assert_eq!(fs::read_dir(file.parent().expect("deeper")).expect("it is there").count(), 1, "nothing is left behind");
}

#[test]
fn a_folder_in_the_place_of_the_file_is_an_error() {
    let folder = Folder::new("place");
    assert!(gauss_files::write(&folder.0, "text").is_err());
    assert!(folder.names().is_empty());
}

#[cfg(unix)]
mod unix {
    use super::*;
    use std::os::unix::fs::{PermissionsExt, symlink};
    use std::process::Command;

    const CHILD: &str = "GAUSS_FILES_CHILD";

    /// Writes what the limit of the parent's shell forbids, when it is called by the test below.
    #[test]
    fn child() {
        let Some(file) = std::env::var_os(CHILD) else { return };
        let error = gauss_files::write(file, vec![b'x'; 1 << 16]).expect_err("files have 512 bytes at most");
        println!("refused: {error}");
    }

    #[test]
    fn a_disk_that_is_full_leaves_the_old_file() {
        let folder = Folder::new("full");
        let file = folder.0.join("run.csv");
        gauss_files::write(&file, "the old table").expect("there is room");
        // The shell's limit of 1 block of 512 bytes; its signal is ignored, so that writing is an error, as ENOSPC is.
        let output = Command::new("sh")
            .args(["-c", "trap '' XFSZ; ulimit -f 1; exec \"$0\" --exact unix::child --nocapture"])
            .arg(std::env::current_exe().expect("this program"))
            .env(CHILD, &file)
            .output()
            .expect("a shell");
        let said = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success() && said.contains("refused: "), "{said}");
        assert_eq!(fs::read_to_string(&file).expect("it is there"), "the old table");
        assert_eq!(folder.names(), ["run.csv"], "nothing is left behind");
    }

    #[test]
    fn links_and_permissions_stay() {
        let folder = Folder::new("links");
        let (file, link) = (folder.0.join("run.csv"), folder.0.join("last.csv"));
        fs::write(&file, "old").expect("room");
        fs::set_permissions(&file, fs::Permissions::from_mode(0o640)).expect("our own file");
        symlink(&file, &link).expect("a system with links");
        gauss_files::write(&link, "new").expect("room");
        assert_eq!(fs::read_to_string(&file).expect("it is there"), "new");
        assert!(fs::symlink_metadata(&link).expect("it is there").is_symlink());
        assert_eq!(fs::metadata(&file).expect("it is there").permissions().mode() & 0o777, 0o640);
        assert_eq!(folder.names(), ["last.csv", "run.csv"]);
    }

    #[test]
    fn a_new_file_has_the_permissions_of_any_new_file() {
        let folder = Folder::new("mode");
        let [ours, theirs] = ["ours", "theirs"].map(|name| folder.0.join(name));
        gauss_files::write(&ours, "").expect("room");
        fs::write(&theirs, "").expect("room");
        let mode = |file| fs::metadata(file).expect("it is there").permissions().mode();
        assert_eq!(mode(&ours), mode(&theirs));
    }

    #[test]
    fn a_device_is_written_to() {
        gauss_files::write("/dev/null", "text").expect("it takes everything");
        assert!(!fs::metadata("/dev/null").expect("it is there").is_file(), "it is still a device");
    }
}
