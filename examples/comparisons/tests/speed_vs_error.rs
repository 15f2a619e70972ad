//! The computing part of the example `speed_vs_error`: errors against the references, orders, evaluations, fronts. No
//! times are asserted.

use std::time::Duration;

use gauss_comparisons::measure::catalogue::{entries, scenes};
use gauss_comparisons::measure::comparison::{LEVELS, Total, Verdict};
use gauss_comparisons::measure::entry::{Entry, Setting, Side};
use gauss_comparisons::measure::scene::{Scene, Target};
use gauss_comparisons::measure::study::{Effort, study};
use gauss_runtime::integrate::Method;

fn scene(name: &str) -> Scene {
    scenes().unwrap().into_iter().find(|scene| scene.about.name == name).unwrap()
}

fn named(scene: &Scene, entry: &Entry) -> String {
    format!("{}: {}, {}, {}", scene.about.name, entry.method, entry.chart, entry.form)
}

/// Runs every adaptive method; the error and the most that is allowed of it, a function of the entry and its
/// evaluations.
fn check_adaptive(scene: &Scene, tolerance: f64, allowed: impl Fn(&Entry, u64) -> f64) {
    let mut reached = 0;
    for entry in entries(scene).unwrap().iter().filter(|entry| entry.setting == Setting::Tolerance) {
        // What is refused is refused: a singularity of the coordinates.
        let Ok((error, evaluations)) = entry.error(tolerance, scene.duration) else {
            assert!(entry.chart == "Euler angles" && entry.side == Side::Gauss, "{}", named(scene, entry));
            continue;
        };
        let allowed = allowed(entry, evaluations);
        assert!(error < allowed, "{}: {error:e}, allowed {allowed:e}", named(scene, entry));
        reached += 1;
    }
    assert!(reached >= 8, "{}: {reached}", scene.description);
}

/// A step takes six evaluations or more; Taylor's method one series.
fn most_steps(entry: &Entry, evaluations: u64) -> f64 {
    evaluations as f64 / if entry.method == "Taylor" { 1.0 } else { 6.0 }
}

/// A step commits at most about the tolerance, relative to the state; and the motion magnifies it by what it makes of a
/// relative error of the start.
#[test]
fn every_chart_and_every_baseline_reaches_the_reference() {
    const TOLERANCE: f64 = 1e-10;
    for scene in scenes().unwrap().iter().filter(|scene| scene.about.name != "free_near_separatrix") {
        let Some(growth) = scene.sensitivity else { continue };
        check_adaptive(scene, TOLERANCE, |entry, evaluations| {
            TOLERANCE * most_steps(entry, evaluations) * growth.max(1.0)
        });
    }
}

/// Within 1e-9 of a rotation about the middle axis, errors of that axis grow by e^(λt), λ² = (I₃ − I₂)(I₂ −
/// I₁)/(I₁I₃) = 1/3 (rad/s)², until the body turns over, when they are 1e9 times what they were; only those of the
/// first few steps, within 1/λ, grow by all of that. In body velocities the small components have small errors, so
/// that it is the relative growth that counts there.
#[test]
fn near_the_separatrix_errors_grow_with_the_flip() {
    const TOLERANCE: f64 = 1e-13;
    let scene = scene("free_near_separatrix");
    let relative = scene.sensitivity.unwrap();
    check_adaptive(&scene, TOLERANCE, |entry, evaluations| {
        let steps = most_steps(entry, evaluations);
        if entry.chart == "body velocities" && entry.form == "velocity" {
            TOLERANCE * steps * relative
        } else {
            let within = (steps / scene.duration * 3.0_f64.sqrt()).max(1.0);
            TOLERANCE * within * 1e9
        }
    });
}

/// The trajectories whose ends are known to 13 digits.
#[test]
fn the_published_trajectories_are_reached() {
    for name in ["trajectory_a", "trajectory_b", "trajectory_c"] {
        let scene = scene(name);
        let entries = entries(&scene).unwrap();
        let best = entries.iter().filter(|entry| entry.setting == Setting::Tolerance && entry.side == Side::Gauss);
        let best = best.filter_map(|entry| Some(entry.error(1e-13, scene.duration).ok()?.0)).fold(1.0, f64::min);
        // The last digits of nine entries or four components, and what 1e3 steps round off.
        assert!(best < 1e-12, "{name}: {best:e}");
        assert!(scene.published.unwrap().figures.len() >= 4);
    }
}

/// The least-squares slope of log error against log step over the finest steps above the plateau of rounding, which
/// is below 1e-10: some thousand steps, each with a rounding and what an iteration leaves, magnified by about 20.
///
/// None where fewer than five steps have errors above it.
fn order(entry: &Entry, scene: &Scene) -> Option<f64> {
    let mut logs: Vec<(f64, f64)> = Vec::new();
    for n in 0..60 {
        let h = 1.2 / scene.about.rate * 0.85_f64.powi(n);
        if scene.duration / h > 3e4 {
            break;
        }
        match entry.error(h, scene.duration) {
            Ok((error, _)) if error < 1e-10 => break,
            Ok((error, _)) => logs.push((h.ln(), error.ln())),
            Err(_) => {}
        }
    }
    let logs = &logs[logs.len().checked_sub(5)?..];
    let n = logs.len() as f64;
    let (mx, my) = (logs.iter().map(|p| p.0).sum::<f64>() / n, logs.iter().map(|p| p.1).sum::<f64>() / n);
    let along = logs.iter().map(|(x, _)| (x - mx).powi(2)).sum::<f64>();
    Some(logs.iter().map(|(x, y)| (x - mx) * (y - my)).sum::<f64>() / along)
}

/// The free body and the heavy top are kinder to some methods than general equations are, so that orders may be
/// higher. Three tenths is what the next term of the error makes of a slope over five steps that halve.
#[test]
fn errors_fall_with_the_order() {
    for name in ["hlw_free_body", "hlw_heavy_top"] {
        let scene = scene(name);
        for entry in entries(&scene).unwrap() {
            let (Setting::Step(stated) | Setting::LongStep(stated)) = entry.setting else { continue };
            // Where its steps are short enough to be stable, its errors are below 1e-10: no slope is to be seen.
            if entry.method == "Adams 12" {
                continue;
            }
            if ["body velocities", "body axes", "ω and quaternion"].contains(&entry.chart) {
                let Some(found) = order(&entry, &scene) else {
                    assert!(stated >= 9, "{} is at rounding with the longest steps", named(&scene, &entry));
                    continue;
                };
                assert!(found > f64::from(stated) - 0.3, "{}: {found} instead of {stated}", named(&scene, &entry));
            }
        }
    }
}

#[test]
fn evaluations_are_counted() {
    let count = |scene: &str, method: &str| {
        let scene = self::scene(scene);
        let entries = entries(&scene).unwrap();
        entries.iter().find(|entry| entry.method == method).unwrap().error(0.1, 3.0).unwrap().1
    };
    let heavy = |method| count("hlw_heavy_top", method);
    // One at the start, and of 30 steps three stages and the derivative at the end.
    assert_eq!(heavy("RK 4"), 1 + 30 * 4);
    assert_eq!(heavy("RKMK 4"), 1 + 30 * 4);
    assert_eq!(heavy("CF 4"), 1 + 30 * 4);
    // The last of seven stages is the first one of the next step; of twelve stages none is.
    assert_eq!(heavy("DP 5, fixed"), 1 + 30 * 6);
    assert_eq!(heavy("DP 8, fixed"), 1 + 30 * 12);
    assert_eq!(heavy("RK 4 on quaternions"), 30 * 4);
    assert_eq!(heavy("semi-implicit Euler"), 30);
    // Six kicks without the last, which may be the first of the next step; at most all seven, and the derivative at
    // the end.
    let splitting = heavy("splitting 4, Moser–Veselov");
    assert!((30 * 6..=1 + 30 * 8).contains(&splitting), "{splitting}");
    // Of free bodies, free motions.
    assert_eq!(count("hlw_free_body", "Moser–Veselov 6"), 30);
    assert_eq!(count("hlw_free_body", "exact free flow"), 1);
}

#[test]
fn the_exact_flow_is_exact() {
    for name in ["hlw_free_body", "free_asym_top", "free_near_separatrix"] {
        let scene = scene(name);
        let entries = entries(&scene).unwrap();
        let entry = entries.iter().find(|entry| entry.setting == Setting::Once).unwrap();
        let (error, _) = entry.error(scene.duration, scene.duration).unwrap();
        // A rounding of each of the six numbers of the start, and a few of the angle.
        let angle = scene.about.rate * scene.duration;
        let allowed = (6.0 * scene.sensitivity.unwrap() + 4.0 * angle) * f64::EPSILON;
        assert!(error < allowed, "{name}: {error:e}, allowed {allowed:e}");
    }
}

#[test]
fn an_attitude_is_off_by_an_angle() {
    let target = Target::of(&scene("free_near_separatrix"), &["R"]);
    let entries = scene("free_near_separatrix").numbers("final/R").unwrap();
    // About the third axis of the observer by 1e-3 rad: rows 1 and 2 mix.
    let (s, c) = 1e-3_f64.sin_cos();
    let turned: Vec<f64> = (0..9)
        .map(|n| match n / 3 {
            0 => c * entries[n] - s * entries[n + 3],
            1 => s * entries[n - 3] + c * entries[n],
            _ => entries[n],
        })
        .collect();
    assert!((target.error(&[turned]) - 1e-3).abs() < 1e-15);
    assert_eq!(target.error(&[]), f64::INFINITY);
    assert_eq!(target.error(&[vec![f64::NAN; 9]]), f64::INFINITY);
}

#[test]
fn a_study_has_fronts_gains_and_energies() {
    let scene = scene("chaplygin_sleigh");
    let mut part = 0.0;
    let effort = Effort { batch: Duration::ZERO, ..Effort::QUICK };
    let found = study(&scene, &effort, &mut |done| {
        assert!(done >= part && done <= 1.0);
        part = done;
    })
    .unwrap();
    assert_eq!((part, found.refused), (1.0, 0));
    let front = found.front(|_| true);
    assert!(front.windows(2).all(|two| two[0].median() <= two[1].median() && two[0].error > two[1].error));
    let least = found.points.iter().fold(1.0_f64, |least, point| least.min(point.error));
    assert!(least < 1e-12 && front.last().unwrap().error == least);
    for error in LEVELS {
        let pair = found.pair(error);
        let (ours, theirs) = (pair.ours.unwrap(), pair.theirs.unwrap());
        assert!(ours.run.error <= error && theirs.run.error <= error);
        // Read between two runs, so not above the more accurate one.
        assert!(ours.time > 0.0 && ours.time <= ours.run.median());
        assert_eq!(pair.verdict(), Verdict::Gain(theirs.time / ours.time));
    }
    let total = Total::of([&found]);
    assert!(total.pairs == LEVELS.len() && total.met <= total.faster && total.geometric_mean > 0.0);

    // Of order 8 with short steps; the game engine's step changes energy at once.
    let worst = |name: &str| {
        let drift = found.drifts.iter().find(|drift| drift.name == name).unwrap();
        drift.line.iter().fold(0.0_f64, |worst, point| worst.max(point.1))
    };
    assert!(worst("DP 8, fixed") < 1e-12 && worst("semi-implicit Euler") > 1e-3);
    assert!(found.points.iter().all(|point| point.evaluations > 0 && point.setting > 0.0));
}

/// With both kinds of steps, by their rows in the table of methods alone.
#[test]
fn methods_with_jacobians_are_in_the_report() {
    let entries = entries(&scene("hlw_heavy_top")).unwrap();
    let mut methods = 0;
    for method in Method::ALL.iter().filter(|method| method.clause() == Some("linearize")) {
        let settings = entries.iter().filter(|entry| entry.method == method.name()).map(|entry| entry.setting);
        let order = method.order().expect("steps of one length");
        assert_eq!(settings.collect::<Vec<_>>(), [Setting::Step(order), Setting::Tolerance], "{method}");
        methods += 1;
    }
    assert!(methods >= 2);
}
