//! The script for GNU parallel, `examples/study/cluster/parallel.sh`, with two workers at once: where it is installed.

#![cfg(unix)]

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::process::{Command, ExitCode};

use crate::common::{Outcome, contents, declaration, waves};
use gauss_study::main_from;

const CHILD: &str = "GAUSS_STUDY_WORDS";

/// The program, when the script starts it.
#[test]
fn child() -> Outcome {
    let Some(line) = std::env::var_os(CHILD) else { return Ok(()) };
    let line = line.to_string_lossy().into_owned();
    assert_eq!(main_from(&waves(declaration(5))?, line.split(' ').map(Into::into)), ExitCode::SUCCESS);
    Ok(())
}

#[test]
fn gnu_parallel_makes_the_same_bytes() -> Outcome {
    let (whole, shared, programs) = (tempfile::tempdir()?, tempfile::tempdir()?, tempfile::tempdir()?);
    let study = waves(declaration(5))?;
    study.run(whole.path(), |_| ())?;
    study.merge(whole.path())?;
    if !Command::new("parallel").arg("--version").output().is_ok_and(|output| output.status.success()) {
        println!("not tested: GNU parallel is not installed");
        return Ok(());
    }
    // A program whose words are those of the command: this one.
    let program = programs.path().join("study");
    let this = std::env::current_exe()?;
    fs::write(
        &program,
        format!("#!/bin/sh\n{CHILD}=\"$*\" exec \"{}\" parallel::child --exact --nocapture\n", this.display()),
    )?;
    fs::set_permissions(&program, fs::Permissions::from_mode(0o755))?;
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/study/cluster/parallel.sh");
    let output =
        Command::new("bash").args([script]).arg(&program).arg(shared.path()).arg("5").env("JOBS", "2").output()?;
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(contents(shared.path())?, contents(whole.path())?);
    Ok(())
}
