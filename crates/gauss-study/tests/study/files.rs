//! Results as files: the same bytes whoever made them, and every run a row.

use std::fs;
use std::sync::atomic::{AtomicU64, Ordering};

use crate::common::{Outcome, RUNS, contents, declaration, failures, waves};
use gauss_study::{Declaration, Progress, Shard, StudyError, uniform};

fn quiet(_: Progress) {}

#[test]
fn one_worker_and_seven_make_the_same_bytes() -> Outcome {
    let (one, seven) = (tempfile::tempdir()?, tempfile::tempdir()?);
    let study = waves(declaration(5))?;
    study.run(one.path(), quiet)?;
    // Out of order, and at once.
    std::thread::scope(|scope| {
        for number in [7, 2, 5, 1, 3, 6, 4] {
            let (study, folder) = (&study, seven.path());
            scope.spawn(move || {
                let shard = Shard::new(number, 7).expect("of seven");
                study.run_shard(folder, shard, quiet).map(drop).expect("a folder that can be written");
            });
        }
    });
    for folder in [&one, &seven] {
        study.merge(folder.path())?;
    }
    let (one, seven) = (contents(one.path())?, contents(seven.path())?);
    assert_eq!(one.len(), 2 + RUNS.div_ceil(70) as usize);
    assert_eq!(one, seven);
    Ok(())
}

#[test]
fn threads_change_no_bit() -> Outcome {
    let (one, four) = (tempfile::tempdir()?, tempfile::tempdir()?);
    let study = waves(declaration(5))?;
    for (folder, threads) in [(&one, 1), (&four, 4)] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
        pool.install(|| study.run(folder.path(), quiet))?;
    }
    assert_eq!(contents(one.path())?, contents(four.path())?);
    Ok(())
}

#[test]
fn failures_are_rows_with_their_causes() -> Outcome {
    let folder = tempfile::tempdir()?;
    let study = waves(declaration(5))?;
    let end = study.run(folder.path(), quiet)?;
    assert_eq!(end, Progress { runs: RUNS, of: RUNS, failed: failures() as u64, damaged: 0 });
    assert_eq!(study.status(folder.path())?, end);
    let results = study.results(folder.path())?;
    let runs = results.numbers("run")?;
    assert!(runs.into_iter().eq((0..RUNS).map(|run| Some(run as f64))));
    let causes = results.words("cause")?;
    assert_eq!(causes.iter().flatten().count(), failures());
    assert_eq!(causes[13].as_deref(), Some("panicked: run 13 is unlucky"));
    assert_eq!(causes[49].as_deref(), Some("wave 49 is no wave"));
    assert_eq!(causes[89].as_deref(), Some("`speed` is NaN"));
    // A number that is none is a null; what a failed run had written before stays.
    let speeds = results.numbers("speed")?;
    assert!(speeds[89].is_none() && speeds[49].is_some());
    Ok(())
}

#[test]
fn what_is_read_is_what_was_written() -> Outcome {
    let folder = tempfile::tempdir()?;
    // A seed that no signed number of 64 bits holds.
    let study = waves(declaration(u64::MAX))?;
    study.run(folder.path(), quiet)?;
    let file = study.merge(folder.path())?;
    assert!(fs::metadata(file)?.len() > 0);
    let results = study.results(folder.path())?;
    let (lengths, speeds) = (results.numbers("length")?, results.numbers("speed")?);
    let (crests, steep, words) = (results.numbers("crests")?, results.numbers("steep")?, results.words("word")?);
    let events = results.numbers("breaks_at")?;
    // All columns of numbers, as tables take them: nulls are NaN, words are left out.
    let columns = results.columns()?;
    let names: Vec<&str> = columns.iter().map(|(name, _)| name.as_str()).collect();
    assert!(names.contains(&"length") && names.contains(&"speed") && !names.contains(&"word"), "{names:?}");
    for (name, values) in &columns {
        let one = results.numbers(name)?;
        let same =
            |(value, one): (&f64, &Option<f64>)| one.map_or(value.is_nan(), |one| one.to_bits() == value.to_bits());
        assert!(values.len() == one.len() && values.iter().zip(&one).all(same), "{name}");
    }
    assert!(results.units().all(|(name, unit)| names.contains(&name) && !unit.is_empty()));
    for run in [0, 1, 69, 70, 555, 999] {
        let (sample, row) = study.one(run);
        let n = run as usize;
        assert_eq!(lengths[n].map(f64::to_bits), Some(sample.values()[0].to_bits()));
        let kept = |value: Option<f64>| value.map_or_else(|| "none".to_owned(), |value| value.to_string());
        let shown = format!("{row:?}");
        for text in [kept(speeds[n]), kept(crests[n]), words[n].clone().unwrap_or_default()] {
            assert!(shown.contains(&text), "run {run}: {text} of {shown}");
        }
        assert!(steep[n].is_some() && events[n].is_none() == (run % 100 == 0));
    }
    assert!(matches!(results.numbers("word"), Err(StudyError::NoColumn(name)) if name == "word"));
    assert!(matches!(results.words("speeds"), Err(StudyError::NoColumn(_))));
    Ok(())
}

#[test]
fn what_is_there_is_not_made_again() -> Outcome {
    let folder = tempfile::tempdir()?;
    let count = AtomicU64::new(0);
    let study = |count: &'static AtomicU64| {
        let mut declaration = Declaration::new("counted", 1, 100).runs_per_part(10);
        declaration.parameter("a", "", uniform(0.0, 1.0));
        declaration.study(move |_, _| {
            count.fetch_add(1, Ordering::Relaxed);
            Ok::<_, String>(())
        })
    };
    let count: &'static AtomicU64 = Box::leak(Box::new(count));
    let study = study(count)?;
    study.run_shard(folder.path(), Shard::new(1, 3).ok_or("of three")?, quiet)?;
    assert_eq!(count.swap(0, Ordering::Relaxed), 40);
    // A part that was cut, and one of which the end was written over.
    let part = |k: u32| folder.path().join(format!("part-{k:08}.parquet"));
    let bytes = fs::read(part(0))?;
    fs::write(part(0), &bytes[..bytes.len() - 1])?;
    fs::write(part(3), "nothing")?;
    assert!(matches!(study.merge(folder.path()), Err(StudyError::Damaged { .. })));
    let status = study.status(folder.path())?;
    assert_eq!(status, Progress { runs: 20, of: 100, failed: 0, damaged: 2 });
    study.run(folder.path(), quiet)?;
    assert_eq!(count.load(Ordering::Relaxed), 80);
    assert_eq!(fs::read(part(0))?, bytes);
    Ok(())
}

#[test]
fn a_part_that_a_disk_changed_is_not_merged_and_is_made_anew() -> Outcome {
    let folder = tempfile::tempdir()?;
    let study = waves(declaration(5))?;
    study.run(folder.path(), quiet)?;
    let part = folder.path().join("part-00000003.parquet");
    let bytes = fs::read(&part)?;
    let mut flipped = Vec::new();
    // Numbers, the end that says where they are, and the declaration in it.
    for place in (0..bytes.len()).step_by(bytes.len() / 97) {
        let mut changed = bytes.clone();
        changed[place] ^= 1 << (place % 8);
        flipped.push(changed);
    }
    // The end is as it was; of the pages before it a block was lost.
    let mut torn = bytes.clone();
    torn[4..bytes.len() / 4].fill(0);
    for changed in flipped.into_iter().chain([torn]) {
        fs::write(&part, changed)?;
        let merged = study.merge(folder.path());
        assert!(matches!(&merged, Err(StudyError::Damaged { file, .. }) if *file == part), "{merged:?}");
        // Whoever reads results reads none of a part that is not sound.
        let read = study.results(folder.path())?.numbers("speed");
        let left_out = |read: &Vec<_>| read.len() as u64 == RUNS - 70;
        assert!(matches!(&read, Err(StudyError::Damaged { .. })) || read.as_ref().is_ok_and(left_out), "{read:?}");
        let end = study.run(folder.path(), quiet)?;
        assert_eq!((end.runs, end.damaged), (RUNS, 1));
        assert_eq!(fs::read(&part)?, bytes);
    }
    study.merge(folder.path())?;
    Ok(())
}

/// Of what is written to `/dev/full` nothing has room.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_told_of_and_the_study_goes_on_afterwards() -> Outcome {
    let (folder, whole) = (tempfile::tempdir()?, tempfile::tempdir()?);
    let study = waves(declaration(5))?;
    study.run(whole.path(), quiet)?;
    study.run_shard(folder.path(), Shard::new(1, 2).ok_or("of two")?, quiet)?;
    let there = study.status(folder.path())?.runs;
    let part = folder.path().join("part-00000003.parquet");
    std::os::unix::fs::symlink("/dev/full", &part)?;
    let full = study.run(folder.path(), quiet);
    let named = |file: &std::path::Path, kind| file == part && kind == std::io::ErrorKind::StorageFull;
    assert!(matches!(&full, Err(StudyError::Io { file, source }) if named(file, source.kind())), "{full:?}");
    assert!(study.status(folder.path())?.runs >= there, "what there is stays");
    fs::remove_file(&part)?;
    study.run(folder.path(), quiet)?;
    assert_eq!(contents(folder.path())?, contents(whole.path())?);
    Ok(())
}

#[test]
fn another_study_is_refused_with_what_differs() -> Outcome {
    let folder = tempfile::tempdir()?;
    waves(declaration(5))?.run(folder.path(), quiet)?;
    let before = contents(folder.path())?;
    let refused = |declaration: Declaration, words: &[&str]| -> Outcome {
        let error = waves(declaration)?.run(folder.path(), quiet).expect_err("another one").to_string();
        assert!(words.iter().all(|word| error.contains(word)), "{words:?}: {error}");
        assert!(error.ends_with("choose another folder"), "{error}");
        Ok(())
    };
    refused(declaration(6).version("2"), &["seed: 5 there, 6 here", "version: \"1\" there, \"2\" here"])?;
    refused(declaration(5).plan(gauss_study::Plan::Sobol), &["plan: \"random\" there, \"sobol\" here"])?;
    refused(declaration(5).runs_per_part(71), &["part: 70 there, 71 here"])?;
    let mut other = Declaration::new("waves", 5, RUNS).version("1").runs_per_part(70);
    other.parameter("length", "m", uniform(1.0, 3.5));
    let error = other.study(|_, _| Ok::<_, String>(()))?.status(folder.path()).expect_err("another one").to_string();
    assert!(error.contains("parameters[0, `length`].distribution.uniform.to: 3.0 there, 3.5 here"), "{error}");
    assert!(error.contains("parameters[1, `height`]: {") && error.contains("columns[0, `speed`]"), "{error}");
    assert_eq!(contents(folder.path())?, before, "nothing is written");
    Ok(())
}

#[test]
fn folders_that_hold_no_study_are_told_of() -> Outcome {
    let folder = tempfile::tempdir()?;
    let study = waves(declaration(5))?;
    assert!(matches!(study.status(folder.path()), Err(StudyError::None(_))));
    assert!(matches!(study.merge(&folder.path().join("none")), Err(StudyError::None(_))));
    fs::write(folder.path().join("study.json"), "{")?;
    assert!(matches!(study.run(folder.path(), quiet), Err(StudyError::Unreadable { .. })));
    fs::remove_file(folder.path().join("study.json"))?;
    study.run_shard(folder.path(), Shard::new(2, 2).ok_or("of two")?, quiet)?;
    assert!(matches!(study.merge(folder.path()), Err(StudyError::Missing { parts: 8, of: 15 })));
    // A file in the place of the folder.
    let file = folder.path().join("file");
    fs::write(&file, "")?;
    assert!(matches!(study.run(&file, quiet), Err(StudyError::Io { .. })));
    Ok(())
}

#[test]
fn a_block_that_panics_loses_one_run() -> Outcome {
    let folder = tempfile::tempdir()?;
    let mut declaration = Declaration::new("blocks", 1, 50).runs_per_part(20);
    let a = declaration.parameter("a", "", uniform(0.0, 1.0));
    let (twice, width) = (declaration.number("twice", ""), declaration.integer("width"));
    let study = declaration.study_in_blocks(8, move |samples, rows| {
        for (sample, row) in samples.iter().zip(&mut *rows) {
            assert!(sample.run() != 27, "no run 27");
            row.set(twice, 2.0 * sample[a]);
            row.set(width, samples.len() as i64);
        }
        rows.iter_mut().zip(samples).filter(|(_, sample)| sample.run() == 3).for_each(|(row, _)| row.fail("by itself"));
        Ok::<_, String>(())
    })?;
    let end = study.run(folder.path(), quiet)?;
    assert_eq!((end.runs, end.failed), (50, 2));
    let results = study.results(folder.path())?;
    // Blocks of 8, 8 and 4 in each part; that of run 27 is 20 to 27.
    let widths = results.numbers("width")?;
    assert!(widths[0] == Some(8.0) && widths[16] == Some(4.0) && widths[20] == Some(1.0) && widths[27].is_none());
    let causes = results.words("cause")?;
    assert_eq!([3, 27].map(|run: usize| causes[run].as_deref()), [Some("by itself"), Some("panicked: no run 27")]);
    Ok(())
}

#[test]
fn in_memory_the_runs_are_the_same() -> Outcome {
    let mut declaration = Declaration::new("memory", 2, 300);
    let a = declaration.parameter("a", "", uniform(0.0, 1.0));
    let sampler = declaration.sampler()?;
    let all = sampler.map(|sample| match sample.run() {
        7 => panic!("seven"),
        8 => Err("eight"),
        _ => Ok(sample[a]),
    });
    assert_eq!(all.len(), 300);
    assert_eq!(all[7], Err("panicked: seven".to_owned()));
    assert_eq!(all[8], Err("eight".to_owned()));
    assert_eq!(all[299], Ok(sampler.sample(299)[a]));
    Ok(())
}
