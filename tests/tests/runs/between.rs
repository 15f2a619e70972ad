//! States between samples are as accurate as the samples, by every method, and tables of them.

use gauss_exact::{Scheme, Splitting};
use gauss_runtime::integrate::{Compensated, Composed, Composition, Control, Fixed, Radau, Rkmk};
use gauss_runtime::prelude::*;
use gauss_tables::Tabulate;
use gauss_tests::top::{Top, TopKernel};

/// x = cos t from (1, 0).
#[derive(GaussDynamics)]
#[gauss(
    linearize,
    taylor,
    coordinates(x),
    particle(mass = 1, position = [x, 0, 0]),
    spring(spring, along = x, stiffness = 1),
)]
struct Unit {}

type One = SVector<f64, 1>;

fn one(x: f64) -> One {
    One::from([x])
}

fn off(sample: &Sample<UnitKernel>) -> f64 {
    (sample.q[0] - sample.t.cos()).abs().max((sample.z[0] + sample.t.sin()).abs())
}

/// The largest errors of a method at its samples, and at a thousand times.
fn errors<C: Control<UnitKernel>>(control: C, every: u64) -> (f64, f64) {
    let kernel = Unit {}.kernel().expect("a spring");
    let path = Simulation::new(&kernel).control(control).every(every).run(one(1.0), one(0.0), 0.0..20.0).expect("runs");
    let of_samples = path.iter().map(off).fold(0.0, f64::max);
    let times = (0..=1000).map(|n| 0.02 * f64::from(n));
    let states = path.at_times(times).expect("inside");
    (of_samples, states.iter().map(off).fold(0.0, f64::max))
}

#[test]
fn states_between_samples_have_their_error() {
    let tolerance = 1e-12;
    for every in [1, 4] {
        for (name, (samples, between)) in [
            ("Taylor", errors(Taylor::new(tolerance, tolerance), every)),
            ("Taylor, short series", errors(Taylor::new(1e-9, 1e-9).of_order(8), every)),
            ("Dormand–Prince 8", errors(Adaptive::new(tolerance, tolerance), every)),
            ("Dormand–Prince 5", errors(Adaptive::by(RungeKutta(DormandPrince5), 1e-9, 1e-9), every)),
            ("Verner 9", errors(Adaptive::by(RungeKutta(Verner9), tolerance, tolerance), every)),
            ("in the algebra", errors(Adaptive::with(&Tableau::DORMAND_PRINCE_8, tolerance, tolerance), every)),
            ("Rosenbrock", errors(Adaptive::by(Rosenbrock, 1e-7, 1e-7), every)),
            ("Radau", errors(Adaptive::by(Radau, 1e-7, 1e-7), every)),
            ("steps of order 8", errors(Fixed::new(0.5), every)),
            ("Runge–Kutta 4", errors(Fixed::by(RungeKutta(Classical4), 0.1), every)),
            ("commutator-free", errors(Fixed::by(CommutatorFree4, 0.1), every)),
            ("Gauss 6", errors(Fixed::by(Collocation::order_6(), 0.4), every)),
            (
                "composed",
                errors(Fixed::by(Composed::new(&Composition::KAHAN_LI_6, Collocation::midpoint()), 0.4), every),
            ),
            ("compensated", errors(Compensated::by(Rkmk::new(&Tableau::RK4), 0.1), every)),
            (
                "composed to order 8",
                errors(Fixed::by(Composed::new(&Composition::KAHAN_LI_8, Collocation::order_6()), 0.9), every),
            ),
        ] {
            // The error of a phase grows evenly: within the last steps it is that of the samples, and what a step of
            // another length adds is of the same size; rounding by about twenty steps.
            assert!(between < 2.0 * samples + 1e-14, "{name}, {every}: {between:e} between, {samples:e} at samples");
            assert!(samples < 1e-2, "{name}: {samples:e}");
        }
    }
}

#[test]
fn of_tops_as_well_also_where_steps_do_not_resolve_the_spin() {
    let kernel = Top { mass: 1.0, center: Vector3::z() * 0.4, inertia: Vector3::new(0.2, 0.2, 0.05), g: 9.81 };
    let kernel = kernel.kernel().expect("a top");
    let (q, z) = (UnitQuaternion::from_euler_angles(0.3, 0.0, 0.0), Vector3::new(0.1, 0.2, 40.0));
    let run = Simulation::new(&kernel);
    let exact = run.adaptive(1e-13, 1e-13).run(q, z, 0.0..2.0).expect("runs");
    let error = |s: &Sample<TopKernel<f64>>| {
        let truth = exact.at(s.t).expect("inside");
        (s.q.to_rotation_matrix().matrix() - truth.q.to_rotation_matrix().matrix())
            .amax()
            .max((s.z - truth.z).amax() / 40.0)
    };
    let splitting = Splitting::discrete(&kernel, Scheme::BLANES_MOAN_4).expect("a top");
    // A step turns by half a radian; between samples it is two and more.
    for (name, path) in [
        ("splitting", run.momentum_form().control(Fixed::by(splitting, 0.0125)).every(4).run(q, z, 0.0..2.0)),
        ("series", run.taylor(1e-13, 1e-13).run(q, z, 0.0..2.0)),
    ] {
        let path = path.expect("runs");
        let of_samples = path.iter().map(error).fold(0.0, f64::max);
        let states = path.at_times((0..=300).map(|n| 2.0 * f64::from(n) / 300.0)).expect("inside");
        let between = states.iter().map(error).fold(0.0, f64::max);
        assert!(between < 3.0 * of_samples + 1e-12 && of_samples < 1e-3, "{name}: {between:e}, {of_samples:e}");
    }
}

#[test]
fn a_table_is_one_line_and_reads_back() {
    let kernel = Unit {}.kernel().expect("a spring");
    let path = Simulation::new(&kernel).taylor(1e-14, 1e-14).run(one(1.0), one(0.0), 0.0..10.0).expect("runs");
    let table = path.table_at((0..=100).map(|n| 0.1 * f64::from(n))).expect("inside");
    let table = table.columns(["x", "v"], |s| [s.q[0], s.z[0]]).energies(&kernel).powers(&kernel, |_, _, _| ());
    let text = table.to_string();
    assert!(text.starts_with("t,x,v,kinetic energy,potential energy,energy,spring power\n0.0,1.0,"), "{text}");
    for (row, line) in text.lines().skip(1).enumerate() {
        let numbers: Vec<f64> = line.split(',').map(|word| word.parse().expect("a number")).collect();
        let (t, x, v) = (numbers[0], numbers[1], numbers[2]);
        assert!(t == 0.1 * row as f64 && (x - t.cos()).abs() < 1e-13 && (v + t.sin()).abs() < 1e-13);
        assert!((numbers[5] - 0.5).abs() < 1e-13 && (numbers[6] + x * v).abs() < 1e-15);
    }
    // Samples alone outlive the kernel, and travel to other threads.
    let samples = {
        let kernel = Unit {}.kernel().expect("a spring");
        Simulation::new(&kernel).taylor(1e-14, 1e-14).run(one(1.0), one(0.0), 0.0..1.0).expect("runs").into_samples()
    };
    let last = std::thread::spawn(move || samples[samples.len() - 1].q[0]).join().expect("comes back");
    assert!((last - 1.0_f64.cos()).abs() < 1e-14);
}
