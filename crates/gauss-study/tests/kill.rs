//! A study that is killed goes on where it was: also in the middle of a write, also with two workers.

#![cfg(unix)]

mod common;

use std::fs;
use std::path::Path;
use std::process::{Child, Command, ExitCode, Stdio};
use std::time::{Duration, Instant};

use common::{Outcome, contents};
use gauss_study::{Declaration, Study, main_from, uniform};

const CHILD: &str = "GAUSS_STUDY_CHILD";

/// Parts of a megabyte, whose writing takes a while.
fn study<'a>() -> Result<Study<'a>, gauss_study::DeclarationError> {
    let mut declaration = Declaration::new("killed", 8, 60_000).runs_per_part(4000);
    let a = declaration.parameter("a", "", uniform(0.0, 1.0));
    let columns: Vec<_> = (0..40).map(|k| declaration.number(&format!("r{k}"), "")).collect();
    declaration.study(move |sample, row| {
        columns.iter().enumerate().for_each(|(k, column)| row.set(*column, sample[a] + k as f64));
        Ok::<_, String>(())
    })
}

/// The worker, when the tests below start it.
#[test]
fn child() -> Outcome {
    let Some(line) = std::env::var_os(CHILD) else { return Ok(()) };
    let line = line.to_string_lossy().into_owned();
    assert_eq!(main_from(&study()?, line.split('\n').map(Into::into)), ExitCode::SUCCESS);
    Ok(())
}

fn start(folder: &Path, shard: &str) -> std::io::Result<Child> {
    let line = format!("run\n--shard\n{shard}\n--out\n{}", folder.display());
    let mut command = Command::new(std::env::current_exe()?);
    command.args(["child", "--exact"]).env(CHILD, line).stdout(Stdio::null()).stderr(Stdio::null()).spawn()
}

fn unfinished(folder: &Path) -> usize {
    let names = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.file_name());
    names.filter(|name| name.to_string_lossy().starts_with(".gauss-")).count()
}

fn parts(folder: &Path) -> usize {
    let names = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.file_name());
    names.filter(|name| name.to_string_lossy().starts_with("part-")).count()
}

/// Kills it with signal 9 when a file is being written beside more than `whole` finished parts; whether it was alive.
fn kill_while_it_writes(child: &mut Child, folder: &Path, whole: usize) -> std::io::Result<bool> {
    let begun = Instant::now();
    let left = unfinished(folder);
    while child.try_wait()?.is_none() && begun.elapsed() < Duration::from_secs(120) {
        if unfinished(folder) > left && parts(folder) >= whole {
            child.kill()?;
            child.wait()?;
            return Ok(true);
        }
    }
    child.kill()?;
    child.wait()?;
    Ok(false)
}

#[test]
fn a_study_that_is_killed_while_it_writes_ends_in_the_same_bytes() -> Outcome {
    let (whole, killed) = (tempfile::tempdir()?, tempfile::tempdir()?);
    let study = study()?;
    study.run(whole.path(), |_| ())?;
    study.merge(whole.path())?;

    let (mut kills, mut in_the_middle) = (0, 0);
    while parts(killed.path()) < 12 {
        let before = (unfinished(killed.path()), parts(killed.path()));
        let mut children = [start(killed.path(), "1/2")?, start(killed.path(), "2/2")?];
        for child in &mut children {
            kills += usize::from(kill_while_it_writes(child, killed.path(), before.1 + 1)?);
        }
        in_the_middle += usize::from(unfinished(killed.path()) > before.0);
        // Whatever was left is whole or not there.
        let status = study.status(killed.path())?;
        assert!(status.damaged == 0 && status.runs >= 4000 * before.1 as u64, "{status:?}");
    }
    assert!(kills > 0 && in_the_middle > 0, "{kills} kills, {in_the_middle} while a file was written");
    let missing = parts(killed.path()) < 15;
    assert_eq!(study.merge(killed.path()).is_err(), missing);

    for shard in ["1/2", "2/2"] {
        assert!(start(killed.path(), shard)?.wait()?.success());
    }
    study.merge(killed.path())?;
    // Also what the killed ones left is gone.
    assert_eq!(contents(killed.path())?, contents(whole.path())?);
    Ok(())
}
