//! The history of a run with contacts in tables, and its balance of energy.

use gauss_contact::{ContactRecord, ContactRun, WithContacts};
use gauss_runtime::prelude::*;
use gauss_tables::{RunTable, Table, Tabulate};

use super::{BALL, Ball, BallKernel};

#[test]
fn what_friction_and_impacts_take_is_what_is_lost() {
    let start = |height: f64| Isometry3::translation(0.0, 0.0, BALL.r + height);
    // Set sliding it rolls at 5/7 of its speed: of ½ m v² friction takes two sevenths.
    let (kernel, v) = (BALL.kernel().unwrap(), 2.0);
    let z = SVector::from([v, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let run = ContactRun::new(&kernel).adaptive(1e-11, 1e-11).run(start(0.0), z, 0.0..1.0).unwrap();
    let balance = run.energy_balance().unwrap();
    let wanted = -BALL.m * v * v / 7.0;
    // The slip ends at 3e-11 of its speed; steps have errors of 1e-11 each.
    assert!((balance.contacts / wanted - 1.0).abs() < 1e-8 && balance.impacts == 0.0, "{balance}");
    assert!(balance.residual().abs() < 1e-9 && balance.supplied == 0.0, "{balance}");

    // Dropped it bounces to rest: impacts take m g h.
    let kernel = Ball { e: 0.7, ..BALL }.kernel().unwrap();
    let run = ContactRun::new(&kernel).adaptive(1e-11, 1e-11).run(start(0.5), SVector::zeros(), 0.0..4.0).unwrap();
    let balance = run.energy_balance().unwrap();
    assert!((balance.impacts / (BALL.m * BALL.g * 0.5) - 1.0).abs() < 1e-9, "{balance}");
    assert!(balance.contacts.abs() < 1e-12 && balance.residual().abs() < 1e-10, "{balance}");

    // Thrown so fast that it still slides when it no longer bounces it does both, and the two add up.
    let run = ContactRun::new(&kernel).adaptive(1e-11, 1e-11).run(start(0.5), 10.0 * z, 0.0..2.0).unwrap();
    let balance = run.energy_balance().unwrap();
    // Each step is off by 1e-11 of its speeds, and so twice that of the energy, at the start 35 J.
    let bound = 2e-11 * 35.0 * run.iter().count() as f64;
    assert!(balance.residual().abs() < bound && balance.contacts < -0.01 && balance.impacts > 1.0, "{balance}");
    assert!(balance.to_string().starts_with("energy -"), "{balance}");
}

#[test]
fn a_table_has_the_columns_of_its_contacts() {
    let kernel = BALL.kernel().unwrap();
    let (start, z) = (Isometry3::translation(0.0, 0.0, BALL.r), SVector::from([2.0, 0.0, 0.0, 0.0, 0.0, 0.0]));
    let run = ContactRun::new(&kernel).adaptive(1e-10, 1e-10).run(start, z, 0.0..1.0).unwrap();
    let samples = run.at_times((0..=10).map(|n| 0.1 * f64::from(n).min(10.0))).unwrap();
    let table: RunTable<BallKernel> = Table::new(samples).contacts(&kernel, |s| Some(*run.forces(s.t).ok()?));
    let names: Vec<&str> = table.names().collect();
    let (slips, frictions) = (["table slip 1", "table slip 2"], ["table friction 1", "table friction 2"]);
    assert_eq!(names, ["t", "table gap", "table force", slips[0], frictions[0], slips[1], frictions[1]]);
    let of = |name: &str| table.get(name).unwrap();
    let weight = BALL.m * BALL.g;
    assert!(of("table force").iter().all(|force| (force - weight).abs() < 1e-12));
    assert!(of("table gap").iter().all(|gap| gap.abs() < 1e-15));
    // It slides at first, with all the friction there is, and rolls without any.
    let size = |names: [&str; 2], n: usize| f64::hypot(of(names[0])[n], of(names[1])[n]);
    assert!((size(slips, 0) - 2.0).abs() < 1e-15 && (size(frictions, 0) - BALL.mu * weight).abs() < 1e-12);
    assert!(size(slips, 10) < 1e-9 && size(frictions, 10) < 1e-9);
    // Where forces are not known there is no number.
    let unknown = Table::new(table.samples().to_vec()).contacts(&kernel, |_| None);
    assert!(unknown.get("table force").unwrap().iter().all(|force| force.is_nan()));
}

/// One record: the same words make a table of a run from event to event and of one in steps.
#[test]
fn tables_take_runs_by_events_and_in_steps_alike() {
    let kernel = BALL.kernel().unwrap();
    let (start, z) = (Isometry3::translation(0.0, 0.0, BALL.r), SVector::from([2.0, 0.0, 0.0, 0.0, 0.0, 0.0]));
    let simulation = || Simulation::new(&kernel);
    fn table<'k>(kernel: &BallKernel, run: &impl ContactRecord<'k, BallKernel>) -> RunTable<BallKernel> {
        let times = (0..=10).map(|n| 0.1 * f64::from(n));
        run.table_at(times).unwrap().state().contacts(kernel, |s| Some(*run.forces(s.t).ok()?)).energies(kernel)
    }
    let h = 1e-4;
    let exact = simulation().adaptive(1e-10, 1e-10).contact_events().run(start, z, 0.0..1.0).unwrap();
    let steps = simulation().contact_steps(h).run(start, z, 0.0..1.0).unwrap();
    let (exact, steps) = (table(&kernel, &exact), table(&kernel, &steps));
    assert!(exact.names().eq(steps.names()) && exact.names().count() == 1 + 7 + 6 + 6 + 3);
    // A slip that decays evenly is exact in steps but for the one in which it ends, at a time known to the step: speeds
    // and places are off by μ g h. Forces of the first step are those of the slip.
    for column in ["pose_x", "energy", "table force"] {
        let pairs = exact.get(column).unwrap().iter().zip(steps.get(column).unwrap());
        let off = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 4.0 * BALL.mu * BALL.g * h, "{column}: {off:e}");
    }
}
