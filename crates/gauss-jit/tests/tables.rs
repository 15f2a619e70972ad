//! Tables whose numbers come as arrays: the motion of the compiled struct with the same constants, by every back end
//! with the same bits; and everything that is wrong with the arrays at once.

use gauss_contact::ContactRun;
use gauss_jit::{Array, Cache, Interpreter, Kernel, KernelError, Misgiven, Model, TableMistake};
use gauss_runtime::linearize::LinearModel;
use gauss_runtime::prelude::*;
use gauss_runtime::table::TableFault;

/// A struct with its kernel, and the text of it.
macro_rules! scene {
    ($name:ident, { $($tokens:tt)* }) => {
        mod $name {
            use super::*;

            #[derive(Clone, Copy, GaussDynamics)]
            $($tokens)*

            pub const SOURCE: &str = stringify!($($tokens)*);
        }
    };
}

const POWER: [[f64; 2]; 4] = [[-1.0, 2.5], [0.0, 2.0], [0.5, 1.5], [3.0, 0.0]];
const WELL: [[f64; 2]; 5] = [[-2.0, 3.0], [-0.8, 0.5], [0.1, 0.0], [0.9, 0.7], [2.0, 3.1]];
const ALPHA: [f64; 4] = [-1.0, -0.2, 0.5, 1.3];

mod aero {
    pub const MACH: [f64; 3] = [-1.5, 0.4, 1.5];
    pub const LIFT: [[f64; 3]; 4] = [[0.3, 0.1, -0.7], [1.2, 0.4, 0.0], [0.9, -0.5, 0.2], [-0.3, 0.6, 1.1]];
    pub const HEIGHT: [f64; 2] = [0.0, 2.0];
    pub const DRAG: [[[f64; 2]; 3]; 4] = [
        [[0.1, 0.2], [0.4, -0.3], [0.9, 0.5]],
        [[-0.6, 0.3], [0.2, 0.8], [0.1, 0.4]],
        [[0.7, -0.2], [0.3, 0.6], [-0.4, 0.2]],
        [[0.5, 0.9], [-0.1, 0.3], [0.6, -0.8]],
    ];
}

// Of one, two and three numbers, of all kinds, of a parameter, of constants in a module, in a potential.
scene!(glider, {
    #[gauss(
        coordinates(x, y), particle(mass = m, position = [x, y, 0]), linearize, input(throttle),
        table(power, points = POWER), table(well, points = WELL, kind = cubic),
        table(lift, axes = [ALPHA, aero::MACH], values = aero::LIFT, kind = hermite),
        table(drag, axes = [ALPHA, aero::MACH, aero::HEIGHT], values = aero::DRAG, kind = cubic),
        drive(first, x = throttle * power(rate(x)) + lift(x, y)), drive(second, y = drag(x, rate(y), c * y) - power(c)),
        potential = well(x),
    )]
    pub struct Glider {
        pub m: f64,
        pub c: f64,
    }
});

scene!(bouncer, {
    #[gauss(
        coordinates(x, z), particle(mass = 0.5, position = [x, 0, z]), gravity = 9.81,
        table(power, points = POWER), drive(x = power(rate(x))),
        contact(floor, gap = z, restitution = 0.5, friction = 0.2, slip = rate(x)),
    )]
    pub struct Bouncer {}
});

const POINTS: [Array<'static>; 2] = [("POWER", &[4, 2], POWER.as_flattened()), ("WELL", &[5, 2], WELL.as_flattened())];
const GRIDS: [Array<'static>; 5] = [
    ("ALPHA", &[4], &ALPHA),
    ("aero::MACH", &[3], &aero::MACH),
    ("aero::LIFT", &[4, 3], aero::LIFT.as_flattened()),
    ("aero::HEIGHT", &[2], &aero::HEIGHT),
    ("aero::DRAG", &[4, 3, 2], aero::DRAG.as_flattened().as_flattened()),
];

fn arrays() -> Vec<Array<'static>> {
    // In any order.
    GRIDS.into_iter().chain(POINTS).collect()
}

fn model(source: &str) -> Model {
    Model::from_source(source).unwrap_or_else(|mistakes| panic!("{mistakes}\n{source}"))
}

const PARAMETERS: [(&str, &[f64]); 2] = [("m", &[2.0]), ("c", &[0.7])];

fn kernel(model: &Model) -> Kernel {
    model.kernel(&PARAMETERS).unwrap_or_else(|error| panic!("{error}"))
}

/// States within the grids and beyond them.
fn states() -> impl Iterator<Item = ([f64; 2], [f64; 2])> {
    (0..80).map(|k| {
        let turn = |by: f64| (by * f64::from(k) + 0.3).sin();
        ([0.2 + 1.7 * turn(1.7), 1.9 * turn(0.9)], [1.0 + 2.4 * turn(2.3), 1.9 * turn(0.37)])
    })
}

#[test]
fn motions_are_those_of_the_compiled_kernel() {
    let compiled = glider::Glider { m: 2.0, c: 0.7 }.kernel().expect("a glider");
    let model = model(glider::SOURCE);
    assert_eq!(
        model.table_constants(),
        ["POWER", "WELL", "ALPHA", "aero::MACH", "aero::LIFT", "aero::HEIGHT", "aero::DRAG"]
    );
    let loaded = kernel(&model.with_tables(&arrays()).expect("tables"));
    // Some sixty sums of numbers below ten, of which slopes are divided by cells of a tenth and more.
    let tolerance = 600.0 * f64::EPSILON;
    for (q, z) in states() {
        let (vq, vz, vu) = (q.into(), z.into(), SVector::from([0.8]));
        let found = loaded.acceleration(0.1, &q, &z, &[0.8]).expect("a call");
        let expected = compiled.acceleration(0.1, &vq, &vz, &vu);
        assert!((0..2).all(|i| (found[i] - expected[i]).abs() < tolerance), "{found:?} {expected}");
        let energy = loaded.potential_energy(0.1, &q).expect("a call");
        assert!((energy - compiled.potential_energy(0.1, &vq)).abs() < tolerance);
        // Derivatives by the state: the second ones of the potential, slopes along each axis.
        let found = loaded.call("linearize", &[&[0.1], &q, &z, &[0.8]]).expect("a call");
        let linear = compiled.linearize(0.1, &vq, &vz, &vu);
        for (i, j) in (0..4).flat_map(|i| (0..4).map(move |j| (i, j))) {
            assert!((found[4 + 4 * i + j] - linear.by_state(i, j)).abs() < 10.0 * tolerance, "{i} {j} at {q:?} {z:?}");
        }
    }
}

#[test]
fn machine_code_is_what_the_interpreter_computes() {
    let model = model(glider::SOURCE).with_tables(&arrays()).expect("tables");
    // A back end keeps the tables that are given before, and those that are given after keep it.
    let interpreted = kernel(&model.with_backend(Interpreter));
    let compiled = kernel(&model);
    #[cfg(feature = "cranelift")]
    assert!(compiled.method("acceleration").expect("it").is_machine_code());
    let again = model.with_backend(Interpreter).with_tables(&arrays()).expect("tables");
    assert!(!kernel(&again).method("acceleration").expect("it").is_machine_code());
    for (q, z) in states() {
        for (method, lists) in [
            ("acceleration", vec![&[0.1][..], &q, &z, &[0.8]]),
            ("linearize", vec![&[0.1], &q, &z, &[0.8]]),
            ("potential_energy", vec![&[0.1], &q]),
        ] {
            let bits = |kernel: &Kernel| -> Vec<u64> {
                kernel.call(method, &lists).expect("a call").into_iter().map(f64::to_bits).collect()
            };
            assert_eq!(bits(&interpreted), bits(&compiled), "{method} at {q:?} {z:?}");
        }
    }
    assert!(compiled.acceleration(0.1, &[f64::NAN, 0.0], &[0.0; 2], &[0.8]).expect("a call")[0].is_nan());
}

/// Code has the address of its tables, which live as long as it.
#[test]
fn tables_outlive_their_model() {
    let kernel = {
        let other = model(glider::SOURCE).with_tables(&arrays()).expect("tables");
        kernel(&other)
    };
    let compiled = glider::Glider { m: 2.0, c: 0.7 }.kernel().expect("a glider");
    let expected = compiled.acceleration(0.0, &[0.3, 0.1].into(), &[0.2, 0.4].into(), &SVector::from([1.0]));
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                let found = kernel.acceleration(0.0, &[0.3, 0.1], &[0.2, 0.4], &[1.0]).expect("a call");
                assert!((found[0] - expected[0]).abs() < 1e-13 && (found[1] - expected[1]).abs() < 1e-13);
            });
        }
    });
}

#[test]
fn runs_are_those_of_the_compiled_kernel() {
    let loaded = kernel(&model(glider::SOURCE).with_tables(&arrays()).expect("tables"));
    let system = loaded.system::<2, 2, SVector<f64, 1>>().expect("room");
    let compiled = glider::Glider { m: 2.0, c: 0.7 }.kernel().expect("a glider");
    let (q, z, input) = (SVector::from([0.3, 0.1]), SVector::from([0.2, 0.4]), SVector::from([0.8]));
    let expected = Simulation::new(&compiled).adaptive(1e-11, 1e-11).input(move |_: f64, _: &_, _: &_| input);
    let expected = expected.run(q, z, 0.0..3.0).expect("a compiled run");
    let start = system.configuration(q.as_slice());
    let found = Simulation::new(&system).adaptive(1e-11, 1e-11).input(move |_: f64, _: &_, _: &_| input);
    let found = found.run(start, z, 0.0..3.0).expect("a run");
    // Both follow the same curve within their tolerance, over some hundred steps.
    let (found, expected) = (found.last().z, expected.last().z);
    assert!((found - expected).norm() < 1e-8, "{found} {expected}");
}

#[test]
fn contacts_go_on_with_tables() {
    let loaded = model(bouncer::SOURCE).with_tables(&POINTS[..1]).expect("a table").kernel(&[]).expect("a bouncer");
    let system = loaded.contact_system::<2, 2, SVector<f64, 0>, 2>().expect("room");
    let compiled = bouncer::Bouncer {}.kernel().expect("a bouncer");
    let (q, z) = (SVector::from([0.0, 0.4]), SVector::from([0.5, 0.0]));
    let expected = ContactRun::new(&compiled).adaptive(1e-10, 1e-10).run(q, z, 0.0..0.9).expect("a compiled run");
    let found = ContactRun::new(&system).adaptive(1e-10, 1e-10).input(|_: f64, _: &_, _: &_| SVector::zeros());
    let found = found.run(system.system().configuration(q.as_slice()), z, 0.0..0.9).expect("a run");
    assert_eq!(found.events().len(), expected.events().len());
    assert!(!expected.events().is_empty());
    let (found, expected) = (found.last().expect("an end").z, expected.last().expect("an end").z);
    assert!((found - expected).norm() < 1e-7, "{found} {expected}");
}

#[test]
fn all_mistakes_of_arrays_come_at_once() {
    let model = model(glider::SOURCE);
    let found = model.with_tables(&[
        ("POWER", &[4, 3], &[0.0; 12]),
        ("WELL", &[3, 2], &[0.0, 1.0, 2.0, f64::NAN, 1.0, 0.0]),
        ("ALPHA", &[4], &[0.0, 1.0, 1.0, 2.0]),
        ("ALPHA", &[4], &[0.0, 1.0, 2.0, 3.0]),
        ("aero::MACH", &[3], &aero::MACH),
        ("aero::LIFT", &[3, 4], aero::LIFT.as_flattened()),
        ("HEIGHT", &[2], &aero::HEIGHT),
        ("aero::DRAG", &[4, 3, 2], aero::DRAG.as_flattened().as_flattened()),
    ]);
    let found = found.expect_err("mistakes");
    let known = model.table_constants().into_iter().map(str::to_owned).collect();
    let shape = |name: &str, expected, found| TableMistake::Shape { name: name.to_owned(), expected, found };
    let fault = |name: &str, fault| TableMistake::Fault { name: name.to_owned(), fault };
    assert_eq!(
        found.as_slice()[..5],
        [
            TableMistake::Unknown { name: "HEIGHT".to_owned(), known },
            TableMistake::Repeated("ALPHA".to_owned()),
            TableMistake::Missing("aero::HEIGHT".to_owned()),
            shape("POWER", vec![None, Some(2)], vec![4, 3]),
            fault("WELL", TableFault::Order { axis: 0, place: 2 }),
        ]
    );
    let words: Vec<String> = found.as_slice()[5..].iter().map(ToString::to_string).collect();
    assert_eq!(
        words,
        [
            "`WELL`: the numbers of a table are finite, and value 1 is NaN",
            "`aero::LIFT` has shape (3, 4); expected (4, 3)",
        ]
    );
    // Numbers of an axis are looked at where shapes are right.
    let mut turned = arrays();
    turned[0] = ("ALPHA", &[4], &[0.0, 1.0, 1.0, 2.0]);
    let found = model.with_tables(&turned).expect_err("a fault");
    // Two tables share the axis.
    assert_eq!(found.as_slice(), [fault("ALPHA", TableFault::Order { axis: 0, place: 2 })]);
    turned[0] = ("ALPHA", &[4], &[0.0, 1.0]);
    let found = model.with_tables(&turned).expect_err("numbers that are not those of the shape");
    assert_eq!(found.as_slice()[0], shape("ALPHA", vec![None], vec![4]));
}

#[test]
fn kernels_need_the_tables() {
    let model = model(bouncer::SOURCE);
    let Err(KernelError::Given(found)) = model.kernel(&[("m", &[1.0])]) else { panic!("a kernel") };
    assert_eq!(found, [Misgiven::Table("POWER".to_owned()), Misgiven::Unknown("m".to_owned())]);
    assert!(found[0].to_string().contains("`with_tables`"));
    // A model without tables takes none.
    let plain = Model::from_source("#[gauss(coordinates(x), particle(mass = 1, position = [x, 0, 0]))] struct A {}");
    let plain = plain.unwrap_or_else(|mistakes| panic!("{mistakes}"));
    assert!(plain.table_constants().is_empty() && plain.with_tables(&[]).is_ok());
    let found = plain.with_tables(&POINTS[..1]).expect_err("no tables");
    assert_eq!(found.to_string(), "`POWER` is no constant of a table: the model has no tables");
}

#[cfg(feature = "cache")]
#[test]
fn derivations_are_kept_without_their_numbers() {
    let folder = std::env::temp_dir().join(format!("gauss_tables_{}", std::process::id()));
    let cache = Cache::new(&folder);
    let at = |model: &Model, power: f64| {
        let numbers = [0.0, power, 1.0, power];
        let model = model.with_tables(&[("POWER", &[2, 2], &numbers)]).expect("a table");
        model.kernel(&[]).expect("a bouncer").acceleration(0.0, &[0.0, 1.0], &[0.0; 2], &[]).expect("a call")[0]
    };
    let [first, again] = [0, 1].map(|_| cache.from_source(bouncer::SOURCE).expect("a scene"));
    // F / m of half a kilogram.
    assert_eq!([at(&first, 3.0), at(&again, 3.0), at(&again, 4.0)], [6.0, 6.0, 8.0]);
    let _ = std::fs::remove_dir_all(folder);
}
