//! How much is measured, and one figure: what it is of, what it should be, what it is, and what a naive program gets.

/// How much is run: for tests, on the command line, and with `--full`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Effort {
    Quick,
    Usual,
    Full,
}

/// Whether a target is reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    Pass,
    Short,
}

/// A figure that is the better the smaller it is.
#[derive(Clone, Debug)]
pub struct Measure {
    /// What was measured, with its unit.
    pub what: String,
    /// How it was computed.
    pub method: String,
    pub reached: f64,
    pub target: f64,
    /// Where the target comes from, when it is not in the table of the design.
    pub reason: String,
    /// What a naive program does, and its figure.
    pub naive: Option<(String, f64)>,
    pub note: String,
}

impl Measure {
    /// A figure and its target.
    pub fn new(what: impl Into<String>, method: impl Into<String>, reached: f64, target: f64) -> Self {
        let (what, method) = (what.into(), method.into());
        Self { what, method, reached, target, reason: String::new(), naive: None, note: String::new() }
    }

    /// Why the target is what it is.
    pub fn because(mut self, reason: impl Into<String>) -> Self {
        self.reason = reason.into();
        self
    }

    /// What a naive program gets.
    pub fn naive(mut self, how: impl Into<String>, figure: f64) -> Self {
        self.naive = Some((how.into(), figure));
        self
    }

    /// What else there is to say.
    pub fn note(mut self, note: impl Into<String>) -> Self {
        self.note = note.into();
        self
    }

    /// Honest about NaN: it is short of every target.
    pub fn verdict(&self) -> Verdict {
        if self.reached <= self.target { Verdict::Pass } else { Verdict::Short }
    }
}

/// The larger of two errors; a NaN wins.
pub fn worse(a: f64, b: f64) -> f64 {
    if b > a || b.is_nan() { b } else { a }
}
