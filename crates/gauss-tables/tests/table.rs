//! Tables of a run that is written by hand: names, units, and numbers that are read back.

// Modules that the included ones know as those of their crate.
use gauss_runtime::{chart, configuration, constraint, description, forces, integrate, real, system};

#[path = "../../../gauss-runtime/src/testing/mod.rs"]
#[allow(dead_code, reason = "tests of the runtime need more")]
mod testing;
#[path = "../../../gauss-runtime/src/triple.rs"]
#[allow(dead_code, reason = "the runtime needs more")]
mod triple;

use gauss_runtime::prelude::*;
use gauss_tables::{Table, Tabulate};

use crate::testing::oscillator::{Oscillator, Viscous};

type One = SVector<f64, 1>;

impl DescribedSystem for Oscillator<Viscous> {}

#[test]
fn columns_have_names_and_csv_reads_back() {
    let system = Oscillator::<Viscous>::new(0.0);
    let (q, z) = (One::from([1.0]), One::from([0.0]));
    let push = |t: f64, _: &One, _: &One| t.sin();
    let run = Simulation::new(&system).input(push).adaptive(1e-10, 1e-10).run(q, z, 0.0..3.0).expect("runs");
    let table = run.table_at([0.0, 0.125, 1e-17, 3.0]).expect("inside");
    let table = table.state().energies(&system).powers(&system, push).column("a, \"b\"", |s| s.q[0] / 0.0);
    let text = table.to_string();
    let mut lines = text.lines();
    let heading = "t,q1,z1,kinetic energy,potential energy,energy,spring power,law power,drive power,\"a, \"\"b\"\"\"";
    assert_eq!(lines.next(), Some(heading));
    let times = table.get("t").expect("is there");
    assert_eq!((times, table.names().len(), table.get("nothing")), (&[0.0, 0.125, 1e-17, 3.0][..], 10, None));
    for (row, line) in lines.enumerate() {
        let numbers: Vec<f64> = line.split(',').map(|word| word.parse().expect("a number")).collect();
        let sample = &table.samples()[row];
        assert_eq!(numbers[..3], [sample.t, sample.q[0], sample.z[0]]);
        assert_eq!(numbers[8], sample.t.sin() * sample.z[0]);
        assert_eq!(numbers[9], f64::INFINITY);
    }
    assert_eq!(run.table().samples().len(), run.len());
    assert!(run.table_at([0.5, 3.5]).is_err());
    let heading = |table: Table<_>| table.to_string().lines().next().map(str::to_owned);
    let table = table.si().units([("q1", "m"), ("z1", "m/s"), ("a, \"b\"", "N m")]).expect("are there");
    let heads = "t / s,q1 / m,z1 / (m/s),kinetic energy / J,potential energy / J,energy / J,spring power / W,\
                 law power / W,drive power / W,\"a, \"\"b\"\" / (N m)\"";
    assert_eq!(heading(table.clone()).as_deref(), Some(heads));
    let unknown = table.units([("q1", "mm"), ("q2", "m"), ("q 1", "m")]).expect_err("are not there");
    assert_eq!(unknown.to_string(), "the table has no column `q2`, `q 1`");
}
