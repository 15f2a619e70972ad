//! The measurement of a scene: errors of every method at every setting, then times, then energies over a long run.
//!
//! Times are taken in rounds: each round runs every setting of every method once, so that a change of the processor's clock or
//! other load hits all of them alike. Medians are reported, with quartiles.

use std::error::Error;
use std::rc::Rc;
use std::time::{Duration, Instant};

use crate::entry::{Ask, Entry, Setting, Side};
use crate::scene::{Scene, Target};
use crate::{bodies, systems};

/// How much is measured.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Rounds of timing, after one that warms up.
    pub rounds: usize,
    /// A time is taken over so many runs that they last this long.
    pub batch: Duration,
    /// Settings that take more evaluations are left out.
    pub most_evaluations: u64,
    /// Settings are this many times as dense.
    pub density: f64,
    /// Energies are watched over this many times the motion of the scene.
    pub long: f64,
}

impl Effort {
    /// For figures to be kept.
    pub const FULL: Self =
        Self { rounds: 9, batch: Duration::from_micros(300), most_evaluations: 300_000, density: 1.0, long: 20.0 };
    /// For a first look.
    pub const QUICK: Self =
        Self { rounds: 3, batch: Duration::from_micros(10), most_evaluations: 15_000, density: 0.4, long: 4.0 };
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
}

impl Point {
    /// The median, µs per simulated second.
    pub fn median(&self) -> f64 {
        self.time[1]
    }
}

/// The energy of one method over a long run: largest deviations, relative to the first value, in equal parts of the run.
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

/// Makes the entries of a scene.
///
/// # Errors
/// When its data are not what they should be.
pub fn entries(scene: &Scene) -> Result<Vec<Entry>, Box<dyn Error>> {
    let mut all = Vec::new();
    let (attitude, pose) = (Rc::new(Target::of(scene, &["R"])), Rc::new(Target::of(scene, &["R", "b"])));
    let particles = Rc::new(Target::of(scene, &["x", "x1", "x2"]));
    match scene.name {
        "hlw_free_body" | "free_asym_top" | "free_near_separatrix" | "trajectory_a" => {
            bodies::free_top(&mut all, scene, &attitude)?;
        }
        "hlw_heavy_top" | "bruls_heavy_top" | "simo_wong_top" | "lagrange_top" | "kovalevskaya" | "trajectory_b" => {
            bodies::heavy_top(&mut all, scene, &attitude)?;
        }
        "kirchhoff_clebsch" | "kirchhoff_nonintegrable" => bodies::ideal(&mut all, scene, &pose)?,
        "kirchhoff_buoyant" | "full_added_mass" | "trajectory_c" => bodies::submerged(&mut all, scene, &pose)?,
        "drag_body" => bodies::dragged(&mut all, scene, &pose)?,
        "spherical_pendulum" => systems::spherical_pendulum(&mut all, scene, &particles)?,
        "double_pendulum" => systems::double_pendulum(&mut all, scene, &particles)?,
        "rolling_disk_falling" => systems::rolling_disk(&mut all, scene, &pose)?,
        "chaplygin_sleigh" => systems::sleigh(&mut all, scene, &pose)?,
        other => return Err(format!("nobody knows how to move {other}").into()),
    }
    Ok(all)
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
        points.extend(found);
        refused += without;
        progress(0.2 * (number + 1) as f64 / entries.len() as f64);
    }
    time(&entries, &mut points, scene.duration, effort, &mut |part| progress(0.2 + 0.7 * part));
    let drifts = if scene.name == "drag_body" { Vec::new() } else { drifts(&entries, scene, effort.long) };
    progress(1.0);
    Ok(Study { scene: scene.clone(), entries, points, refused, drifts })
}

/// The settings of a method from coarse to fine.
fn settings(entry: &Entry, scene: &Scene, effort: &Effort) -> Vec<f64> {
    match entry.setting {
        Setting::Once => vec![scene.duration],
        Setting::Tolerance => {
            let count = (24.0 * effort.density) as i32;
            (0..=count).map(|n| 10.0_f64.powf(-2.0 - 12.0 * f64::from(n) / f64::from(count))).collect()
        }
        Setting::Step(order) => {
            // About two settings for each power of ten of the error, and not less than one for each halving.
            let ratio = 10.0_f64.powf(0.5 / f64::from(order)).powf(1.0 / effort.density).clamp(1.15, 4.0);
            (0..80).map(|n| 1.6 / scene.rate / ratio.powi(n)).collect()
        }
    }
}

/// Errors of one method, from coarse to fine, until rounding or the effort ends it; and how many settings were refused.
fn ladder(number: usize, entry: &Entry, scene: &Scene, effort: &Effort) -> (Vec<Point>, usize) {
    let (mut points, mut refused): (Vec<Point>, usize) = (Vec::new(), 0);
    let (mut best, mut vain) = (f64::INFINITY, 0);
    for setting in settings(entry, scene, effort) {
        if let Setting::Step(_) = entry.setting
            && scene.duration / setting > effort.most_evaluations as f64
        {
            break;
        }
        let Ok((error, evaluations)) = entry.error(setting, scene.duration) else {
            refused += 1;
            continue;
        };
        if evaluations > effort.most_evaluations {
            break;
        }
        if error < 1.0 {
            // Errors below what the reference resolves say nothing.
            let error = error.max(scene.resolution);
            points.push(Point { entry: number, setting, error, evaluations, time: [f64::NAN; 3] });
        }
        vain = if error > 0.7 * best { vain + 1 } else { 0 };
        best = best.min(error);
        if best < 1e-9 && vain == 3 {
            break;
        }
    }
    (points, refused)
}

fn time(entries: &[Entry], points: &mut [Point], duration: f64, effort: &Effort, progress: &mut dyn FnMut(f64)) {
    let once = |point: &Point, runs: u32| {
        let start = Instant::now();
        for _ in 0..runs {
            // It reached the end when its error was found.
            let _ = entries[point.entry].run(point.setting, duration, Ask::Time);
        }
        start.elapsed().as_secs_f64() / f64::from(runs)
    };
    let runs: Vec<u32> = points
        .iter()
        .map(|point| (effort.batch.as_secs_f64() / once(point, 1)).ceil().clamp(1.0, 1e4) as u32)
        .collect();
    let mut times = vec![Vec::with_capacity(effort.rounds); points.len()];
    for round in 0..effort.rounds {
        for ((point, &runs), times) in points.iter().zip(&runs).zip(&mut times) {
            times.push(once(point, runs) * 1e6 / duration);
        }
        progress((round + 1) as f64 / effort.rounds as f64);
    }
    for (point, times) in points.iter_mut().zip(&mut times) {
        times.sort_by(f64::total_cmp);
        point.time = [1, 2, 3].map(|quarter| times[(times.len() - 1) * quarter / 4]);
    }
}

/// Values on a line.
const PARTS: usize = 200;

/// Energies of the methods on the first chart, with steps of 0.15 of the fastest rate or a tolerance of 1e-9.
fn drifts(entries: &[Entry], scene: &Scene, long: f64) -> Vec<Drift> {
    let Some(first) = entries.first() else { return Vec::new() };
    let end = long * scene.duration;
    let step = 0.15 / scene.rate;
    let shown = |entry: &&Entry| match entry.side {
        Side::Gauss => {
            let wanted = [
                ("RKMK 4", "velocity"),
                ("DP 8, fixed", "velocity"),
                ("Gauss 4", "momentum"),
                ("variational", "momentum"),
                ("RKN 4 of Moser–Veselov", "momentum"),
                ("Moser–Veselov 10", "momentum"),
            ];
            entry.chart == first.chart && wanted.contains(&(entry.method, entry.form))
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

impl Study {
    /// The points that no other point beats in both error and time, from fast to accurate.
    pub fn front(&self, keep: impl Fn(&Entry) -> bool) -> Vec<Point> {
        let mut points: Vec<Point> =
            self.points.iter().filter(|point| keep(&self.entries[point.entry])).copied().collect();
        points.sort_by(|a, b| a.median().total_cmp(&b.median()));
        let mut least = f64::INFINITY;
        points.retain(|point| {
            let better = point.error < least;
            least = least.min(point.error);
            better
        });
        points
    }

    /// The fastest point with at most this error.
    pub fn fastest(&self, error: f64, keep: impl Fn(&Entry) -> bool) -> Option<Point> {
        let good = self.points.iter().filter(|point| point.error <= error && keep(&self.entries[point.entry]));
        good.min_by(|a, b| a.median().total_cmp(&b.median())).copied()
    }

    /// How many times as fast as the fastest baseline the fastest method of Gauss is at this error.
    pub fn gain(&self, error: f64) -> Option<f64> {
        let of = |side| self.fastest(error, |entry| entry.side == side);
        Some(of(Side::Baseline)?.median() / of(Side::Gauss)?.median())
    }
}
