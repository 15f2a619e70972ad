//! The measurement of a scene: errors of every method at every setting, then times, then energies over a long run.
//!
//! Times are taken in rounds: each round runs every setting of every method for at least a millisecond, so that a
//! change of the processor's clock or other load hits all of them alike. Medians are reported, with quartiles. Runs
//! that cannot matter, because another is many times as fast and not less accurate, are not in these rounds.

use std::error::Error;
use std::time::{Duration, Instant};

use gauss_charts::statistics::quartiles;

use super::catalogue::entries;
use super::entry::{Ask, Entry, Setting, Side};
use super::scene::Scene;

/// How much is measured.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Rounds of timing.
    pub rounds: usize,
    /// A time is taken over so many runs that they last this long.
    pub batch: Duration,
    /// Steps that take more evaluations for a radian of the fastest rate are left out; tolerances, which end at 1e-15
    /// anyway, where they take four times as many.
    pub most_evaluations: f64,
    /// Settings are this many times as dense.
    pub density: f64,
    /// Energies are watched over this many times the motion of the scene.
    pub long: f64,
    /// Runs that are so many times slower than one that is as accurate are timed once.
    pub hopeless: f64,
}

impl Effort {
    /// For figures to be kept.
    pub const FULL: Self = Self {
        rounds: 7,
        batch: Duration::from_millis(1),
        most_evaluations: 1500.0,
        density: 1.0,
        long: 20.0,
        hopeless: 8.0,
    };
    /// For a first look.
    pub const QUICK: Self = Self {
        rounds: 3,
        batch: Duration::from_micros(200),
        most_evaluations: 250.0,
        density: 0.3,
        long: 2.0,
        hopeless: 3.0,
    };
}

/// One method at one setting.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// The number of the entry.
    pub entry: usize,
    /// The step in s, or the tolerance.
    pub setting: f64,
    /// At the end of the motion.
    pub error: f64,
    /// Evaluations of the right-hand side in the whole run.
    pub evaluations: u64,
    /// Quartiles of µs of computation per s of motion.
    pub time: [f64; 3],
    /// How many rounds they are of.
    pub rounds: usize,
}

impl Point {
    /// The median, µs per simulated second.
    pub fn median(&self) -> f64 {
        self.time[1]
    }
}

/// The energy of one method over a long run: largest deviations, relative to the first value, in equal parts of the
/// run.
#[derive(Clone, Debug)]
pub struct Drift {
    /// What the line is called.
    pub name: String,
    /// Time in s, deviation.
    pub line: Vec<(f64, f64)>,
}

/// All that was found of a scene.
pub struct Study {
    /// The scene.
    pub scene: Scene,
    /// The methods.
    pub entries: Vec<Entry>,
    /// What they reached.
    pub points: Vec<Point>,
    /// Settings that ended with an error, for example at a singularity of the coordinates.
    pub refused: usize,
    /// Energies; none where the energy is not constant.
    pub drifts: Vec<Drift>,
}

/// Measures a scene; `progress` is called with the part that is done, from 0 to 1.
///
/// # Errors
/// When its data are not what they should be.
pub fn study(scene: &Scene, effort: &Effort, progress: &mut dyn FnMut(f64)) -> Result<Study, Box<dyn Error>> {
    let entries = entries(scene)?;
    let (mut points, mut refused) = (Vec::new(), 0);
    for (number, entry) in entries.iter().enumerate() {
        let (found, without) = ladder(number, entry, scene, effort);
        points.extend(useful(found));
        refused += without;
        progress(0.2 * (number + 1) as f64 / entries.len() as f64);
    }
    time(&entries, &mut points, scene.duration, effort, &mut |part| progress(0.2 + 0.7 * part));
    let drifts = drifts(&entries, scene, effort.long);
    progress(1.0);
    Ok(Study { scene: scene.clone(), entries, points, refused, drifts })
}

/// The settings of a method from coarse to fine.
fn settings(entry: &Entry, scene: &Scene, effort: &Effort) -> Vec<f64> {
    match entry.setting {
        Setting::Once => vec![scene.duration],
        Setting::Tolerance => {
            let count = (26.0 * effort.density) as i32;
            (0..=count).map(|n| 10.0_f64.powf(-2.0 - 13.0 * f64::from(n) / f64::from(count))).collect()
        }
        Setting::Step(order) | Setting::LongStep(order) => {
            let longest = if let Setting::Step(_) = entry.setting { 1.6 } else { 25.6 };
            // About two settings for each power of ten of the error, and not less than one for each halving.
            let ratio = 10.0_f64.powf(0.5 / f64::from(order)).powf(1.0 / effort.density).clamp(1.15, 4.0);
            (0..80).map(|n| longest / scene.about.rate / ratio.powi(n)).collect()
        }
    }
}

/// Errors of one method, from coarse to fine, until rounding or the effort ends it; and how many settings were refused.
fn ladder(number: usize, entry: &Entry, scene: &Scene, effort: &Effort) -> (Vec<Point>, usize) {
    let (mut points, mut refused): (Vec<Point>, usize) = (Vec::new(), 0);
    let (mut best, mut vain, mut in_a_row) = (f64::INFINITY, 0, 0);
    let most = effort.most_evaluations * scene.about.rate * scene.duration;
    let most = if entry.setting == Setting::Tolerance { 4.0 * most } else { most };
    for setting in settings(entry, scene, effort) {
        if let Setting::Step(_) | Setting::LongStep(_) = entry.setting
            && scene.duration / setting > most
        {
            break;
        }
        let start = Instant::now();
        let Ok((error, evaluations)) = entry.error(setting, scene.duration) else {
            refused += 1;
            in_a_row += 1;
            // Steps may be too long; where tolerances cannot be kept there is a singularity of the coordinates.
            if entry.setting == Setting::Tolerance && in_a_row == 2 {
                break;
            }
            continue;
        };
        in_a_row = 0;
        if evaluations as f64 > most {
            break;
        }
        if error < 1.0 {
            // Errors below what the reference resolves say nothing.
            let error = error.max(scene.resolution);
            let time = [start.elapsed().as_secs_f64() * 1e6 / scene.duration; 3];
            points.push(Point { entry: number, setting, error, evaluations, time, rounds: 1 });
        }
        vain = if error > 0.7 * best { vain + 1 } else { 0 };
        best = best.min(error);
        if best < 1e-9 && vain == 3 {
            break;
        }
    }
    (points, refused)
}

/// The settings of one method that no other of it beats in both evaluations and error.
fn useful(points: Vec<Point>) -> Vec<Point> {
    let beaten =
        |point: &Point| points.iter().any(|other| other.evaluations < point.evaluations && other.error <= point.error);
    points.iter().filter(|point| !beaten(point)).copied().collect()
}

/// Seconds of one run, as the mean of some.
fn once(entry: &Entry, point: &Point, duration: f64, runs: u32) -> f64 {
    let start = Instant::now();
    for _ in 0..runs {
        // It reached the end when its error was found.
        let _ = entry.run(point.setting, duration, Ask::Time);
    }
    start.elapsed().as_secs_f64() / f64::from(runs)
}

/// So many runs that they last as long as a batch.
fn batch_of(entry: &Entry, point: &Point, duration: f64, batch: f64) -> u32 {
    let mut runs = 1;
    loop {
        let wanted = (batch / once(entry, point, duration, runs).max(1e-9)).ceil();
        if wanted <= f64::from(runs) {
            return runs;
        }
        // A first run is slower than the next ones.
        runs = (1.3 * wanted).ceil() as u32;
    }
}

/// Whether a point is still so many times slower than another that is as accurate. Very short runs are not judged by
/// their first time.
fn hopeless(point: &Point, points: &[Point], duration: f64, times: f64) -> bool {
    const SHORT: f64 = 50.0;
    let accurate = points.iter().filter(|other| other.error <= point.error);
    let least = accurate.fold(f64::INFINITY, |least, other| least.min(other.median()));
    point.median() * duration > SHORT && point.median() > times * least
}

fn time(entries: &[Entry], points: &mut [Point], duration: f64, effort: &Effort, progress: &mut dyn FnMut(f64)) {
    let batch = effort.batch.as_secs_f64();
    let mut timed = Vec::new();
    for n in 0..points.len() {
        if hopeless(&points[n], points, duration, effort.hopeless) {
            // The first time may have been that of an interruption.
            let again = once(&entries[points[n].entry], &points[n], duration, 1) * 1e6 / duration;
            points[n].time = [again.min(points[n].median()); 3];
        }
        if !hopeless(&points[n], points, duration, effort.hopeless) {
            timed.push(n);
        }
    }
    let runs: Vec<u32> =
        timed.iter().map(|&n| batch_of(&entries[points[n].entry], &points[n], duration, batch)).collect();
    let mut times = vec![Vec::with_capacity(effort.rounds); timed.len()];
    for round in 0..effort.rounds {
        for ((&n, &runs), times) in timed.iter().zip(&runs).zip(&mut times) {
            times.push(once(&entries[points[n].entry], &points[n], duration, runs) * 1e6 / duration);
        }
        progress((round + 1) as f64 / effort.rounds as f64);
    }
    for (&n, times) in timed.iter().zip(times) {
        points[n].rounds = times.len();
        points[n].time = quartiles(times);
    }
}

/// Values on a line.
const PARTS: usize = 200;

/// Energies of the methods on the first chart, with steps of 0.15 of the fastest rate or a tolerance of 1e-9; none
/// where drag takes energy away.
fn drifts(entries: &[Entry], scene: &Scene, long: f64) -> Vec<Drift> {
    if !scene.about.conservative() {
        return Vec::new();
    }
    let Some(first) = entries.first() else { return Vec::new() };
    let end = long * scene.duration;
    let step = 0.15 / scene.about.rate;
    let shown = |entry: &&Entry| match entry.side {
        Side::Gauss => {
            let wanted = [
                ("RK 4", "velocity"),
                ("DP 8, fixed", "velocity"),
                ("Gauss 4", "momentum"),
                ("variational", "momentum"),
                ("splitting 4, Moser–Veselov", "momentum"),
                ("Moser–Veselov 10", "momentum"),
            ];
            (entry.chart == first.chart || entry.method == "Moser–Veselov 10")
                && wanted.contains(&(entry.method, entry.form))
        }
        Side::Baseline => entry.method != "DOP853 of differential-equations",
    };
    let mut all = Vec::new();
    for entry in entries.iter().filter(shown) {
        let setting = if entry.setting == Setting::Tolerance { 1e-9 } else { step };
        let mut line = vec![f64::NAN; PARTS];
        let mut start = None;
        let mut see = |t: f64, energy: f64| {
            let start = *start.get_or_insert(energy);
            let part = ((t / end * PARTS as f64) as usize).min(PARTS - 1);
            // The first comparison replaces the NaN.
            line[part] = line[part].max(((energy - start) / start).abs());
        };
        // What was reached before a failure is shown.
        let _ = entry.run(setting, end, Ask::Energy(&mut see));
        let at = |part: usize| (part as f64 + 0.5) * end / PARTS as f64;
        let line = line.iter().enumerate().filter(|(_, value)| value.is_finite());
        all.push(Drift { name: entry.method.to_owned(), line: line.map(|(part, &value)| (at(part), value)).collect() });
    }
    all
}
