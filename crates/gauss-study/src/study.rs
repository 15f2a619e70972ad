//! The runs of a study, on all cores, into files.

use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use rayon::prelude::*;

use crate::declaration::{Declaration, Sampler};
use crate::draw::Draw;
use crate::error::{DeclarationError, StudyError};
use crate::files::{Folder, PartState, Results};
use crate::panics::caught;
use crate::row::Row;

type Runs<'a> = Box<dyn Fn(&[Draw], &mut [Row]) -> Result<(), String> + Send + Sync + 'a>;

/// A study: its declaration and what a run is.
#[must_use = "a study does nothing before `run`"]
pub struct Study<'a> {
    declaration: Declaration,
    sampler: Sampler,
    width: usize,
    runs: Runs<'a>,
}

impl fmt::Debug for Study<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Study").field("declaration", &self.declaration).finish_non_exhaustive()
    }
}

/// One of several workers: number `number` of `of`, from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    number: u64,
    of: u64,
}

impl Shard {
    /// The only one.
    pub const WHOLE: Self = Self { number: 1, of: 1 };

    /// Worker `number` of `of`, from 1; nothing where there is no such worker.
    #[must_use]
    pub fn new(number: u64, of: u64) -> Option<Self> {
        (1..=of).contains(&number).then_some(Self { number, of })
    }
}

/// Progress of a study, or of a shard of it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Progress {
    /// Runs that are in files.
    pub runs: u64,
    /// Number of all runs.
    pub of: u64,
    /// Runs in files that failed.
    pub failed: u64,
    /// Parts that were there, but not whole or of another study, and are made anew.
    pub damaged: u64,
}

impl Declaration {
    /// The study, a run of which is a function of its sample.
    ///
    /// What it returns as an error, or panics with, is the cause in its row, and the other runs go on.
    ///
    /// # Errors
    /// All mistakes of the declaration.
    pub fn study<'a, E: std::fmt::Display>(
        self,
        run: impl Fn(&Draw, &mut Row) -> Result<(), E> + Send + Sync + 'a,
    ) -> Result<Study<'a>, DeclarationError> {
        self.study_in_blocks(1, move |samples, rows| {
            samples.iter().zip(rows).try_for_each(|(sample, row)| run(sample, row))
        })
    }

    /// The same by blocks of up to `width` neighbouring runs, for runs that share vectors as those of `gauss-batch` do.
    /// Which runs are in a block depends on the declaration alone. A block that fails or panics is repeated run by run.
    ///
    /// # Errors
    /// All mistakes of the declaration.
    pub fn study_in_blocks<'a, E: std::fmt::Display>(
        self,
        width: usize,
        run: impl Fn(&[Draw], &mut [Row]) -> Result<(), E> + Send + Sync + 'a,
    ) -> Result<Study<'a>, DeclarationError> {
        let sampler = self.sampler()?;
        let run = move |samples: &[Draw], rows: &mut [Row]| run(samples, rows).map_err(|error| error.to_string());
        Ok(Study::new(self, sampler, width.max(1), Box::new(run)))
    }
}

impl<'a> Study<'a> {
    pub(crate) fn new(declaration: Declaration, sampler: Sampler, width: usize, runs: Runs<'a>) -> Self {
        Self { declaration, sampler, width, runs }
    }

    /// The name of the study.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.declaration.name
    }

    /// The names and the numbers of the parameters of one run, and its results: to look at one that failed.
    #[must_use]
    pub fn one(&self, run: u64) -> (Draw, Row) {
        let mut samples = vec![self.sampler.sample(run)];
        let mut rows = self.rows(&samples);
        (samples.remove(0), rows.remove(0))
    }

    /// Makes the runs that the folder lacks, on all threads, and writes them part by part. `progress` is called at the
    /// beginning, and after each part by the thread that wrote it, which holds up no other.
    ///
    /// # Errors
    /// [`StudyError::Other`] where the folder holds another study, [`StudyError::Unreadable`], [`StudyError::Io`].
    pub fn run(&self, folder: &Path, progress: impl Fn(Progress) + Sync) -> Result<Progress, StudyError> {
        self.run_shard(folder, Shard::WHOLE, progress)
    }

    /// The same of one worker among several, which need not be at work at once nor be of equal strength: every `of`-th
    /// part is its own.
    ///
    /// # Errors
    /// Those of [`run`](Self::run).
    pub fn run_shard(
        &self,
        folder: &Path,
        shard: Shard,
        progress: impl Fn(Progress) + Sync,
    ) -> Result<Progress, StudyError> {
        let folder = Folder::make(folder, &self.declaration)?;
        let (mut now, mut open) = (Progress::default(), Vec::new());
        for part in (shard.number - 1..self.declaration.parts()).step_by(shard.of as usize) {
            let there = self.count(part, folder.checked(part)?, &mut now);
            if !there {
                open.push(part);
            }
        }
        progress(now);
        let done = Mutex::new(now);
        open.into_par_iter().try_for_each(|part| {
            let runs = self.declaration.runs_of(part);
            let count = runs.end - runs.start;
            let failed = self.make(&folder, part, runs)?;
            // Nothing panics while it holds the lock: what is called of the user's comes after.
            let now = {
                let mut done = done.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
                done.runs += count;
                done.failed += failed;
                *done
            };
            progress(now);
            Ok(())
        })?;
        Ok(done.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner))
    }

    /// Adds a part to what is counted; whether it is there.
    fn count(&self, part: u64, state: PartState, progress: &mut Progress) -> bool {
        let runs = self.declaration.runs_of(part);
        let count = runs.end - runs.start;
        progress.of += count;
        match state {
            PartState::Whole { failed } => {
                progress.runs += count;
                progress.failed += failed;
                return true;
            }
            PartState::Damaged(_) => progress.damaged += 1,
            PartState::Missing => {}
        }
        false
    }

    /// Makes and writes a part; how many of its runs failed.
    fn make(&self, folder: &Folder<'_>, part: u64, runs: Range<u64>) -> Result<u64, StudyError> {
        let samples: Vec<Draw> = runs.into_par_iter().map(|run| self.sampler.sample(run)).collect();
        let rows: Vec<Row> = samples.par_chunks(self.width).flat_map_iter(|samples| self.rows(samples)).collect();
        folder.write(part, &samples, &rows)?;
        Ok(rows.iter().filter(|row| row.cause.is_some()).count() as u64)
    }

    /// The rows of a block.
    fn rows(&self, samples: &[Draw]) -> Vec<Row> {
        let columns = &self.declaration.columns;
        let mut rows = vec![Row::new(columns.len()); samples.len()];
        if let Err(cause) = caught(|| (self.runs)(samples, &mut rows)) {
            if samples.len() > 1 {
                return samples.iter().flat_map(|sample| self.rows(std::slice::from_ref(sample))).collect();
            }
            rows.iter_mut().for_each(|row| row.fail(&cause));
        }
        rows.iter_mut().for_each(|row| row.checked(columns.iter().map(|column| column.name.as_str())));
        rows
    }

    /// Progress of the study in a folder.
    ///
    /// # Errors
    /// [`StudyError::None`] and those of [`run`](Self::run).
    pub fn status(&self, folder: &Path) -> Result<Progress, StudyError> {
        let folder = Folder::open(folder, &self.declaration)?;
        let mut progress = Progress::default();
        for part in 0..self.declaration.parts() {
            self.count(part, folder.state(part)?, &mut progress);
        }
        Ok(progress)
    }

    /// Puts all parts into `study.parquet`, whose bytes depend on the study alone, and says where it is.
    ///
    /// # Errors
    /// [`StudyError::Missing`], [`StudyError::Damaged`], [`StudyError::None`] and those of [`run`](Self::run).
    pub fn merge(&self, folder: &Path) -> Result<PathBuf, StudyError> {
        Folder::open(folder, &self.declaration)?.merge()
    }

    /// Results that are there so far, also while runs are made.
    ///
    /// # Errors
    /// [`StudyError::None`] and those of [`run`](Self::run).
    pub fn results(&self, folder: &Path) -> Result<Results, StudyError> {
        let numbers = self.declaration.numbers();
        Ok(Results { files: Folder::open(folder, &self.declaration)?.whole()?, numbers })
    }

    pub(crate) fn declaration(&self) -> &Declaration {
        &self.declaration
    }
}
