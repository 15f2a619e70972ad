//! A study that is killed goes on where it was: also in the middle of a write, also with two workers.

#![cfg(unix)]

use std::fs;
use std::path::Path;
use std::process::{Child, Command, ExitCode, Stdio};
use std::time::{Duration, Instant, SystemTime};

use crate::common::{Outcome, contents};
use gauss_study::{Declaration, Study, main_from, uniform};

const CHILD: &str = "GAUSS_STUDY_CHILD";
const RUNS: u64 = 120_000;
const PART: u64 = 8000;

/// Parts of three megabytes, whose writing takes a while.
fn study<'a>() -> Result<Study<'a>, gauss_study::DeclarationError> {
    let mut declaration = Declaration::new("killed", 8, RUNS).runs_per_part(PART);
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
    command.args(["kill::child", "--exact"]).env(CHILD, line).stdout(Stdio::null()).stderr(Stdio::null()).spawn()
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

/// A folder in which workers were killed again and again, and how many times while a file was written.
fn killed_often(study: &Study<'_>) -> Result<(tempfile::TempDir, usize), Box<dyn std::error::Error>> {
    let folder = tempfile::tempdir()?;
    let path = folder.path();
    let (mut kills, mut in_the_middle) = (0, 0);
    while parts(path) < 12 {
        let before = (unfinished(path), parts(path));
        let mut children = [start(path, "1/2")?, start(path, "2/2")?];
        for child in &mut children {
            kills += usize::from(kill_while_it_writes(child, path, before.1 + 1)?);
        }
        in_the_middle += usize::from(unfinished(path) > before.0);
        // Whatever was left is whole or not there.
        let status = study.status(path)?;
        assert!(status.damaged == 0 && status.runs >= PART * before.1 as u64, "{status:?}");
    }
    assert!(kills > 0);
    Ok((folder, in_the_middle))
}

#[test]
fn a_study_that_is_killed_while_it_writes_ends_in_the_same_bytes() -> Outcome {
    let whole = tempfile::tempdir()?;
    let study = study()?;
    study.run(whole.path(), |_| ())?;
    study.merge(whole.path())?;

    // Where the disk is memory a file may be whole before the signal comes: then another try.
    let killed = (0..10).map(|_| killed_often(&study)).find(|tried| !matches!(tried, Ok((_, 0))));
    let (killed, _) = killed.ok_or("never killed while a file was written")??;
    let missing = (parts(killed.path()) as u64) < RUNS / PART;
    assert_eq!(study.merge(killed.path()).is_err(), missing);

    for shard in ["1/2", "2/2"] {
        assert!(start(killed.path(), shard)?.wait()?.success());
    }
    // What the killed ones left is gone when nobody has written to it for hours; a file of now may be of a worker.
    for entry in fs::read_dir(killed.path())?.flatten() {
        if entry.file_name().to_string_lossy().starts_with(".gauss-") {
            let hours_ago = SystemTime::now() - Duration::from_secs(7200);
            fs::File::options().append(true).open(entry.path())?.set_modified(hours_ago)?;
        }
    }
    let at_work = killed.path().join(".gauss-at-work");
    fs::write(&at_work, "some rows")?;
    study.merge(killed.path())?;
    fs::remove_file(at_work)?;
    assert_eq!(contents(killed.path())?, contents(whole.path())?);
    Ok(())
}
