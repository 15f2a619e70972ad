//! Tables of a run that is written by hand: names, units, and numbers that are read back.

// Modules that the included ones know as those of their crate.
use gauss_runtime::{chart, configuration, constraint, description, forces, integrate, real, system};

#[path = "../../../gauss-runtime/src/testing/mod.rs"]
#[allow(dead_code, reason = "tests of the runtime need more")]
mod testing;
#[path = "../../../gauss-runtime/src/triple.rs"]
#[allow(dead_code, reason = "the runtime needs more")]
mod triple;

use gauss_runtime::chart::EulerSequence;
use gauss_runtime::prelude::*;
use gauss_tables::{ColumnError, Table, Tabulate};

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

/// Columns without a run: all mistakes at once, chosen columns, functions over every table.
#[test]
fn what_is_no_run_is_a_table_too() {
    fn count<Row>(table: &Table<Row>) -> usize {
        table.len()
    }
    let table = Table::from_columns([("a", vec![1.0, 2.0]), ("b", vec![3.0, f64::NAN])]).expect("of one length");
    let table = table.units([("a", "m")]).expect("is there");
    assert_eq!((count(&table), table.to_string().as_str()), (2, "a / m,b\n1.0,3.0\n2.0,NaN\n"));
    assert_eq!(table.clone().select(["b", "a"]).expect("are there").names().collect::<Vec<_>>(), ["b", "a"]);
    let unknown = table.clone().select(["c", "a", "d"]).expect_err("are not there");
    assert_eq!(unknown.to_string(), "the table has no column `c`, `d`");
    assert_eq!(table.panel(["e"]).expect_err("is not there"), unknown_one("e"));
    let unequal = Table::from_columns([("a", vec![1.0]), ("b", vec![]), ("c", vec![1.0, 2.0])]).expect_err("unequal");
    assert_eq!(unequal.to_string(), "columns are as long as the first one, which has 1 numbers: `b` 0, `c` 2");
    let twice = Table::from_columns([("a", vec![1.0]), ("a", vec![1.0])]).expect_err("twice");
    assert_eq!(twice.to_string(), "two columns are called `a`");
    let records = Table::of(vec![(1_u8, 2.0_f32)]).column("square", |&(_, x)| x * x);
    assert_eq!((records.get("square"), records.rows()), (Some(&[4.0][..]), &[(1, 2.0)][..]));
    assert_eq!(records.without_rows().rows(), [()]);
}

fn unknown_one(name: &str) -> ColumnError {
    ColumnError::Unknown(vec![name.to_owned()])
}

/// A craft with an antenna, so that q has a pose, a rotation and a scalar.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(craft: Pose, dish: Rotation, x),
    body(hull, pose = craft, mass = m, inertia = 1),
    body(antenna, parent = hull, rotation = dish, position = [x, 0, 1], mass = 0.1, inertia = 0.01),
)]
struct Craft {
    m: f64,
}

/// The angles of a state, from the angles that it was made of.
#[test]
fn rotations_have_angles() {
    let kernel = Craft { m: 1.0 }.kernel().expect("a craft");
    let [yaw, pitch, roll] = [0.3, -0.2, 0.1];
    let state = CraftState {
        craft: Isometry3::from_parts(Translation3::identity(), UnitQuaternion::from_euler_angles(roll, pitch, yaw)),
        dish: UnitQuaternion::from_euler_angles(0.0, 0.0, 3.0),
        ..Default::default()
    };
    let run = Simulation::new(&kernel).adaptive(1e-9, 1e-9).run(state.q(), state.z(), 0.0..1.0).expect("runs");
    let table = run.table().euler_angles(EulerSequence::ZYX).expect("there are rotations");
    let table = table.euler_angles_of("same", EulerSequence::ZXZ, |s| s.q.0.rotation).expect("a sequence");
    let names = ["craft_yaw", "craft_pitch", "craft_roll", "dish_yaw", "dish_pitch", "dish_roll"];
    let of = |name: &str| table.get(name).expect("is there")[0];
    assert_eq!(table.names().skip(1).take(6).collect::<Vec<_>>(), names);
    // A product of three quaternions, and arc tangents of sums of their components.
    for (name, angle) in names.into_iter().zip([yaw, pitch, roll, 3.0, 0.0, 0.0]) {
        assert!((of(name) - angle).abs() < 1e-14, "{name}");
    }
    let [a, b, c] = ["precession", "nutation", "spin"].map(|name| of(&format!("same_{name}")));
    let back = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), a)
        * UnitQuaternion::from_axis_angle(&Vector3::x_axis(), b)
        * UnitQuaternion::from_axis_angle(&Vector3::z_axis(), c);
    assert!(back.angle_to(&state.craft.rotation) < 1e-14);
    assert!(table.si().iter().skip(1).all(|column| column.unit == Some("rad")));

    let wrong = run.table().euler_angles(EulerSequence { axes: [2, 2, 7] }).expect_err("not a sequence");
    assert_eq!(
        wrong.to_string(),
        "Euler angles are about axes 0, 1 or 2, neighbours about different ones, and not about 2, 2, 7"
    );
    // At the pole, within rounding, angles are not to be told apart: none are made up.
    let pole = |s: &Sample<CraftKernel>| UnitQuaternion::from_euler_angles(0.0, std::f64::consts::FRAC_PI_2, s.t);
    let table = run.table().euler_angles_of("pole", EulerSequence::ZYX, pole).expect("a sequence");
    assert!(table.get("pole_pitch").expect("is there").iter().all(|angle| angle.is_nan()));
}

/// A system without rotations has no angles of them, and says so.
#[test]
fn no_rotation_no_angles() {
    let table = Table::<Sample<Oscillator<Viscous>>>::new(Vec::new());
    assert!(matches!(table.euler_angles(EulerSequence::ZYX), Err(ColumnError::NoRotation)));
}
