//! The computing part of the example `speed_vs_error`: errors against the references, evaluations, fronts. No times are asserted.

#[path = "../speed_vs_error/baselines.rs"]
mod baselines;
#[path = "../speed_vs_error/bodies.rs"]
mod bodies;
#[path = "../speed_vs_error/by_hand.rs"]
mod by_hand;
#[path = "../speed_vs_error/by_hand_systems.rs"]
mod by_hand_systems;
#[path = "../speed_vs_error/entry.rs"]
mod entry;
#[path = "../speed_vs_error/methods.rs"]
mod methods;
#[path = "../speed_vs_error/scene.rs"]
mod scene;
#[path = "../speed_vs_error/study.rs"]
mod study;
#[path = "../speed_vs_error/systems.rs"]
mod systems;

use entry::{Entry, Setting, Side};
use scene::{Scene, scenes};
use study::{Effort, entries, study};

fn scene(name: &str) -> Scene {
    scenes().unwrap().into_iter().find(|scene| scene.name == name).unwrap()
}

/// A step of order ≥ 5 commits at most about the tolerance, relative to the state, and the motion magnifies it by at most what it makes
/// of an error at the start; a method of more than 7 stages has fewer steps than evaluations.
#[test]
fn every_chart_and_every_baseline_reaches_the_reference() {
    const TOLERANCE: f64 = 1e-10;
    for scene in scenes().unwrap() {
        let Some(sensitivity) = scene.sensitivity else { continue };
        let mut reached = 0;
        for entry in entries(&scene).unwrap().iter().filter(|entry| entry.setting == Setting::Tolerance) {
            // What is refused is refused: a singularity of the coordinates.
            let Ok((error, evaluations)) = entry.error(TOLERANCE, scene.duration) else {
                assert!(
                    entry.chart == "Euler angles" && entry.side == Side::Gauss,
                    "{} by {}",
                    scene.title,
                    entry.method
                );
                continue;
            };
            let allowed = TOLERANCE * evaluations as f64 * sensitivity.max(1.0);
            let name = || format!("{}: {}, {}, {}", scene.name, entry.method, entry.chart, entry.form);
            assert!(error < allowed, "{}: {error:e}, allowed {allowed:e}", name());
            reached += 1;
        }
        assert!(reached >= 6, "{}: {reached}", scene.description);
    }
}

/// The least-squares slope of log error against log step.
fn order(entry: &Entry, scene: &Scene, steps: &[f64]) -> f64 {
    let logs: Vec<(f64, f64)> =
        steps.iter().map(|&h| (h.ln(), entry.error(h, scene.duration).unwrap().0.ln())).collect();
    let n = logs.len() as f64;
    let (mx, my) = (logs.iter().map(|p| p.0).sum::<f64>() / n, logs.iter().map(|p| p.1).sum::<f64>() / n);
    logs.iter().map(|(x, y)| (x - mx) * (y - my)).sum::<f64>() / logs.iter().map(|(x, _)| (x - mx).powi(2)).sum::<f64>()
}

/// Steps at which errors are far from 1 and from rounding. A fifth of an order is the next term of the error at such steps.
#[test]
fn errors_fall_with_the_order() {
    let scene = scene("hlw_free_body");
    for entry in
        entries(&scene).unwrap().iter().filter(|entry| ["body velocities", "ω and quaternion"].contains(&entry.chart))
    {
        let Setting::Step(stated) = entry.setting else { continue };
        let steps: &[f64] = match stated {
            1 => &[0.002, 0.001, 0.0005],
            2 => &[0.1, 0.05, 0.025],
            4 | 5 => &[0.1, 0.08, 0.06, 0.05],
            6 => &[0.3, 0.25, 0.2, 0.15],
            8 => &[0.5, 0.42, 0.36, 0.3],
            _ => &[0.35, 0.3, 0.25, 0.2],
        };
        let found = order(entry, &scene, steps);
        let name = format!("{}, {}", entry.method, entry.form);
        // The free body is kinder to some methods than general equations are.
        assert!(found > f64::from(stated) - 0.3, "{name}: {found} instead of {stated}");
    }
}

#[test]
fn evaluations_are_counted() {
    let scene = scene("hlw_heavy_top");
    let all = entries(&scene).unwrap();
    let count = |method: &str| {
        let entry = all.iter().find(|entry| entry.method == method).unwrap();
        entry.error(0.1, 3.0).unwrap().1
    };
    // One at the start, and of 30 steps three stages and the derivative at the end.
    assert_eq!(count("RKMK 4"), 1 + 30 * 4);
    assert_eq!(count("CF 4"), 1 + 30 * 4);
    // The last stage is the first one of the next step.
    assert_eq!(count("DP 5, fixed"), 1 + 30 * 6);
    assert_eq!(count("RK 4 on quaternions"), 30 * 4);
    assert_eq!(count("semi-implicit Euler"), 30);
}

#[test]
fn a_study_has_fronts_gains_and_energies() {
    let scene = scene("chaplygin_sleigh");
    let mut part = 0.0;
    let found = study(&scene, &Effort::QUICK, &mut |done| {
        assert!(done >= part && done <= 1.0);
        part = done;
    })
    .unwrap();
    assert_eq!((part, found.refused), (1.0, 0));
    let front = found.front(|_| true);
    assert!(front.windows(2).all(|two| two[0].median() <= two[1].median() && two[0].error > two[1].error));
    assert!(front.first().unwrap().error > 1e-3 && front.last().unwrap().error < 1e-12);
    for error in [1e-3, 1e-6, 1e-9, 1e-12] {
        assert!(found.gain(error).is_some_and(|gain| gain.is_finite() && gain > 0.0), "{error:e}");
        assert!(found.fastest(error, |entry| entry.form == "momentum").is_some_and(|point| point.error <= error));
    }
    // Symmetric, and so without drift; the game engine's step changes energy at once.
    let worst = |name: &str| {
        let drift = found.drifts.iter().find(|drift| drift.name == name).unwrap();
        drift.line.iter().fold(0.0_f64, |worst, point| worst.max(point.1))
    };
    assert!(worst("DP 8, fixed") < 1e-12 && worst("semi-implicit Euler") > 1e-3);
    assert!(found.points.iter().all(|point| point.evaluations > 0 && point.setting > 0.0));
    assert!(scene.kind.target() >= 3.0);
    assert_eq!(found.scene.name, scene.name);
}
