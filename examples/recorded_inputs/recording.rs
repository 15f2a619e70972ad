//! Inputs that were recorded: a table read from CSV, checked row by row, and interpolated.

use std::error::Error;
use std::fmt;
use std::io::Read;

use gauss_runtime::prelude::*;
use serde::Deserialize;

/// A row of the file, as its header names the columns.
#[derive(Clone, Copy, Debug, Deserialize)]
pub struct Row {
    #[serde(rename = "time_s")]
    pub time: f64,
    #[serde(rename = "thrust_N")]
    pub thrust: f64,
    #[serde(rename = "rudder_rad")]
    pub rudder: f64,
}

/// Thrust (N) and rudder (rad) over time, linear between the rows and constant before the first and after the last.
#[derive(Clone, Debug)]
pub struct Recording {
    rows: Vec<Row>,
}

/// What is wrong with a file, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RecordingError {
    /// Counted from 1, the header included.
    pub line: u64,
    pub reason: String,
}

impl fmt::Display for RecordingError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: {}", self.line, self.reason)
    }
}

impl Error for RecordingError {}

impl Recording {
    /// Reads a table with the columns `time_s`, `thrust_N` and `rudder_rad`, in any order.
    ///
    /// # Errors
    /// The first row that is not three finite numbers, or whose time is not later than that of the row before.
    pub fn read(source: impl Read) -> Result<Self, RecordingError> {
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(source);
        let at = |line: u64| move |error: csv::Error| RecordingError { line, reason: reason(&error) };
        let header = reader.headers().map_err(at(1))?.clone();
        let mut rows: Vec<Row> = Vec::new();
        let mut line = 1;
        for record in reader.records() {
            let record = record.map_err(|error| at(error.position().map_or(line + 1, csv::Position::line))(error))?;
            line = record.position().map_or(line + 1, csv::Position::line);
            let row: Row = record.deserialize(Some(&header)).map_err(at(line))?;
            let wrong = |reason: String| Err(RecordingError { line, reason });
            if ![row.time, row.thrust, row.rudder].into_iter().all(f64::is_finite) {
                return wrong("a number is not finite".into());
            }
            if let Some(before) = rows.last()
                && row.time <= before.time
            {
                return wrong(format!("time {} s is not later than {} s in the row before", row.time, before.time));
            }
            rows.push(row);
        }
        if rows.is_empty() {
            return Err(RecordingError { line, reason: "no row follows the header".into() });
        }
        Ok(Self { rows })
    }

    /// The rows, at least one.
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// Thrust and rudder at a time.
    pub fn at(&self, t: f64) -> [f64; 2] {
        let after = self.rows.partition_point(|row| row.time <= t);
        let (left, right) = (&self.rows[after.saturating_sub(1)], &self.rows[after.min(self.rows.len() - 1)]);
        if right.time <= left.time {
            return [left.thrust, left.rudder];
        }
        let part = (t - left.time) / (right.time - left.time);
        let between = |from: f64, to: f64| from + part * (to - from);
        [between(left.thrust, right.thrust), between(left.rudder, right.rudder)]
    }
}

/// What the reader says, without the place: that is said once, by its line.
fn reason(error: &csv::Error) -> String {
    match error.kind() {
        csv::ErrorKind::Deserialize { err, .. } => err.kind().to_string(),
        csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
            format!("{len} values where the header has {expected_len} columns")
        }
        _ => error.to_string(),
    }
}

/// A recording steers every scene with the inputs thrust and rudder.
impl<S: GaussSystem<Scalar = f64, Input = SVector<f64, 2>>> InputSource<S> for &Recording {
    fn input(&self, t: f64, _: &S::Configuration, _: &S::Speeds) -> SVector<f64, 2> {
        SVector::from(self.at(t))
    }
}
