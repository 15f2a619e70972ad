//! Scripts that compare documents with their scenes.

use std::process::Command;

/// The interpreter named in `GAUSS_PYTHON`, or `python3`.
fn python() -> String {
    std::env::var("GAUSS_PYTHON").unwrap_or_else(|_| "python3".to_owned())
}

/// Whether it has a package, beside NumPy.
pub fn has(package: &str) -> bool {
    let there = Command::new(python()).args(["-c", &format!("import {package}, numpy")]).output();
    let there = there.is_ok_and(|output| output.status.success());
    if !there {
        println!("not tested: {} has not {package}", python());
    }
    there
}

/// Runs a script on scenes in JSON, which prints differences and, where they are small, `compared`.
pub fn agrees(script: &str, scenes: &[String]) {
    let thread = format!("{:?}", std::thread::current().id()).replace(|c: char| !c.is_ascii_digit(), "");
    let file = std::env::temp_dir().join(format!("gauss_documents_{}_{thread}.json", std::process::id()));
    std::fs::write(&file, format!("[{}]", scenes.join(",\n"))).expect("a file");
    let output = Command::new(python()).arg("-c").arg(script).arg(&file).output().expect("Python runs");
    std::fs::remove_file(&file).expect("no file");
    let (out, words) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    println!("{out}");
    assert!(output.status.success() && out.ends_with("compared\n"), "{out}{words}");
}
