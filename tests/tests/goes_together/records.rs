//! Runs as tables, plots, pages, balances of energy and rows of studies.

use gauss_playback::{Playback, Shape};
use gauss_runtime::description::DescribedSystem;
use gauss_runtime::forces::ForcedSystem;
use gauss_runtime::monitor::power_balance;
use gauss_runtime::prelude::*;
use gauss_study::{Declaration, uniform};
use gauss_tables::Tabulate;

use crate::runs::{Kernel, input, made};
use crate::scenes::Scene;

/// Runs a scene at a tolerance of 1e-9, as `path` of `kernel`.
macro_rules! run {
    ($scene:ident => $kernel:ident, $path:ident) => {
        let ($kernel, q, z) = made($scene, &S::NUMBERS);
        let $path = Simulation::new(&$kernel).input(input($scene, &$kernel)).adaptive(1e-9, 1e-10);
        let $path = $path.run(q, z, 0.0..1.0).unwrap();
    };
}

/// A row for each sample with its numbers, and a line for each column.
pub fn table_and_plot<S: Scene<System<f64>: DescribedSystem>>(scene: &S) {
    run!(scene => kernel, path);
    let table = path.table().state().energies(&kernel);
    assert_eq!(table.len(), path.len());
    let names = Kernel::<S>::COORDINATE_NAMES.iter().chain(Kernel::<S>::SPEED_NAMES);
    let (q, z) = (path.last().q.components(), path.last().z);
    let of_q = Kernel::<S>::COORDINATE_NAMES.len();
    for (i, name) in names.enumerate() {
        let column = table.get(name).unwrap_or_else(|| panic!("no column {name}"));
        let expected = if i < of_q { q.component(i) } else { z.component(i - of_q) };
        assert_eq!(column.last(), Some(&expected), "{name}");
    }
    let energy = table.get("energy").unwrap();
    assert!(energy.iter().all(|energy| energy.is_finite()));
    let picture = table.svg().unwrap();
    assert!(picture.contains("<svg") && !picture.contains("NaN"));
    for name in Kernel::<S>::COORDINATE_NAMES.iter().chain(Kernel::<S>::SPEED_NAMES) {
        assert!(picture.contains(name), "{name}");
    }
}

/// A page with a body that moves as the first coordinate, and curves of the state.
pub fn page<S: Scene>(scene: &S) {
    run!(scene => kernel, path);
    let pose = |sample: &Sample<Kernel<S>>| Isometry3::translation(sample.q.components().component(0), 0.0, 0.0);
    let playback = Playback::with_pictures("A scene", &path, 5).unwrap();
    let html = playback
        .body("mass", pose, [Shape::ball(0.1)])
        .curve("speed", "first", |sample| sample.z.component(0))
        .energy(&kernel)
        .html()
        .unwrap();
    for part in ["mass", "speed", "first", "energy"] {
        assert!(html.contains(part), "{part}");
    }
}

/// Energy against the work of all elements: to the tolerance of the run, some hundred steps.
pub fn energy<S: Scene<System<f64>: ForcedSystem>>(scene: &S) {
    run!(scene => kernel, path);
    let balance = power_balance(&kernel, &path, input(scene, &kernel));
    let uncertainty = balance.last().uncertainty;
    assert!(balance.largest_residual() < 1e-6 + 10.0 * uncertainty, "{balance}");
    assert!(uncertainty < 1e-6, "{balance}");
}

/// A study whose runs are those that are made alone.
pub fn study<S: Scene>(scene: &S) {
    let [parameter, size] = S::NUMBERS;
    let speed_at_end = |numbers: &[f64; 2]| {
        let (kernel, q, z) = made(scene, numbers);
        let run = Simulation::new(&kernel).input(input(scene, &kernel)).adaptive(1e-9, 1e-10);
        run.run_to_end(q, z, 0.0..1.0).map(|end| end.z.component(0))
    };
    let mut declaration = Declaration::new("sizes", 7, 4);
    let drawn = declaration.parameter("size", "", uniform(0.9 * size, size));
    let speed = declaration.number("speed", "");
    let study = declaration.study(move |sample, row| {
        row.set(speed, speed_at_end(&[parameter, sample[drawn]])?);
        Ok::<(), IntegrationError>(())
    });
    let study = study.unwrap();
    for run in 0..4 {
        let (draw, row) = study.one(run);
        let expected = speed_at_end(&[parameter, draw.values()[0]]).unwrap();
        assert_eq!((row.cause(), row.get(speed)), (None, Some(&gauss_study::Value::Number(expected))));
    }
}
