//! Who is faster at which error: fronts of runs, and times read between them.

use super::entry::{Entry, Side};
use super::study::{Point, Study};

/// The errors at which methods are compared.
pub const LEVELS: [f64; 10] = [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12];

/// The fastest method at an error.
#[derive(Clone, Copy, Debug)]
pub struct Fastest {
    /// µs per simulated second, read between its runs.
    pub time: f64,
    /// Its run with the next smaller error.
    pub run: Point,
}

/// Both sides at an error.
#[derive(Clone, Copy, Debug)]
pub struct Pair {
    /// The fastest of Gauss, where one gets there.
    pub ours: Option<Fastest>,
    /// The fastest baseline, where one gets there.
    pub theirs: Option<Fastest>,
}

/// How a comparison ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    /// Gauss is so many times as fast.
    Gain(f64),
    /// Only Gauss gets there.
    OnlyOurs,
    /// Only a baseline gets there.
    OnlyTheirs,
    /// Nobody gets there.
    Nobody,
}

impl Pair {
    /// Who is faster.
    pub fn verdict(&self) -> Verdict {
        match (self.ours, self.theirs) {
            (Some(ours), Some(theirs)) => Verdict::Gain(theirs.time / ours.time),
            (Some(_), None) => Verdict::OnlyOurs,
            (None, Some(_)) => Verdict::OnlyTheirs,
            (None, None) => Verdict::Nobody,
        }
    }
}

/// The points that no other point beats in both error and time, from fast to accurate.
pub fn front(points: impl IntoIterator<Item = Point>) -> Vec<Point> {
    let mut points: Vec<Point> = points.into_iter().collect();
    points.sort_by(|a, b| a.median().total_cmp(&b.median()));
    let mut least = f64::INFINITY;
    points.retain(|point| {
        let better = point.error < least;
        least = least.min(point.error);
        better
    });
    points
}

/// The time at which the runs of one method, fast to accurate, have this error, on straight lines of the logarithms
/// between them; where every run is more accurate, the fastest: shorter runs were not tried.
fn between(runs: &[Point], error: f64) -> Option<Fastest> {
    let n = runs.iter().position(|run| run.error <= error)?;
    let run = runs[n];
    let time = match n.checked_sub(1).map(|before| runs[before]) {
        None => run.median(),
        Some(before) => {
            let part = (error / before.error).ln() / (run.error / before.error).ln();
            before.median() * (run.median() / before.median()).powf(part)
        }
    };
    Some(Fastest { time, run })
}

impl Study {
    /// The front of what is kept.
    pub fn front(&self, keep: impl Fn(&Entry) -> bool) -> Vec<Point> {
        front(self.points.iter().filter(|point| keep(&self.entries[point.entry])).copied())
    }

    /// The fastest of one side at this error. Times are read between runs of one method on one chart: a mean of two
    /// methods is none.
    pub fn fastest(&self, error: f64, side: Side) -> Option<Fastest> {
        let of_entry = |number: usize| {
            let runs = front(self.points.iter().filter(|point| point.entry == number).copied());
            between(&runs, error)
        };
        let entries = (0..self.entries.len()).filter(|&number| self.entries[number].side == side);
        entries.filter_map(of_entry).min_by(|a, b| a.time.total_cmp(&b.time))
    }

    /// The fastest of both sides at this error.
    pub fn pair(&self, error: f64) -> Pair {
        Pair { ours: self.fastest(error, Side::Gauss), theirs: self.fastest(error, Side::Baseline) }
    }
}

/// All scenes and errors together.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Total {
    /// Scenes and errors at which both sides, or one, get there.
    pub pairs: usize,
    /// Where the target is met: that includes where only Gauss gets there.
    pub met: usize,
    /// Where Gauss is faster.
    pub faster: usize,
    /// Of the gains where both get there; 1 without any.
    pub geometric_mean: f64,
}

impl Total {
    /// Over some studies.
    pub fn of<'s>(studies: impl IntoIterator<Item = &'s Study>) -> Self {
        let mut total = Self::default();
        let (mut logs, mut gains) = (0.0, 0);
        for study in studies {
            for error in LEVELS {
                let (met, faster) = match study.pair(error).verdict() {
                    Verdict::Nobody => continue,
                    Verdict::OnlyOurs => (true, true),
                    Verdict::OnlyTheirs => (false, false),
                    Verdict::Gain(gain) => {
                        logs += gain.ln();
                        gains += 1;
                        (gain >= study.scene.about.kind.target(), gain >= 1.0)
                    }
                };
                total.pairs += 1;
                total.met += usize::from(met);
                total.faster += usize::from(faster);
            }
        }
        Self { geometric_mean: (logs / f64::from(gains.max(1))).exp(), ..total }
    }
}
