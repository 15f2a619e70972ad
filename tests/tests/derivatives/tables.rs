//! Tables of two and three numbers in forces and potentials: the same motion by a table as by the formula that the
//! table reproduces, with its derivatives, in every scalar.

use gauss_bounded::Bounded;
use gauss_runtime::prelude::*;
use gauss_runtime::simd::Lanes;
use gauss_runtime::table::{Grid, Joined};

const X: [f64; 5] = [-1.0, -0.2, 0.5, 1.3, 2.0];
const Y: [f64; 4] = [-1.5, -0.3, 0.4, 1.5];
const Z: [f64; 3] = [-1.0, 0.1, 1.0];

const fn lift_at(x: f64, y: f64) -> f64 {
    (0.3 * x * x - x + 2.0) * (0.2 * y * y + y - 1.0)
}

const fn drag_at(x: f64, y: f64, z: f64) -> f64 {
    (0.3 * x * x - x + 2.0) * (y - 0.4 * y * y) + x * y * z * z
}

const fn lift() -> [[f64; 4]; 5] {
    let mut values = [[0.0; 4]; 5];
    let mut i = 0;
    while i < 20 {
        values[i / 4][i % 4] = lift_at(X[i / 4], Y[i % 4]);
        i += 1;
    }
    values
}

const fn drag() -> [[[f64; 3]; 4]; 5] {
    let mut values = [[[0.0; 3]; 4]; 5];
    let mut i = 0;
    while i < 60 {
        values[i / 12][i / 3 % 4][i % 3] = drag_at(X[i / 12], Y[i / 3 % 4], Z[i % 3]);
        i += 1;
    }
    values
}

const LIFT: [[f64; 4]; 5] = lift();
const DRAG: [[[f64; 3]; 4]; 5] = drag();

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y), particle(mass = m, position = [x, y, 0]), linearize(parameters, hessian),
    table(lift, axes = [X, Y], values = LIFT, kind = hermite),
    table(drag, axes = [X, Y, Z], values = DRAG, kind = hermite),
    drive(first, x = c * lift(x, y)), drive(second, y = drag(x, rate(y), c * y)),
)]
struct ByTable<T> {
    m: T,
    c: T,
}

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y), particle(mass = m, position = [x, y, 0]), linearize(parameters, hessian),
    define(
        v = rate(y),
        lift = (0.3 * x * x - x + 2) * (0.2 * y * y + y - 1),
        drag = (0.3 * x * x - x + 2) * (v - 0.4 * v * v) + x * v * (c * y).powi(2),
    ),
    drive(first, x = c * lift), drive(second, y = drag),
)]
struct ByFormula {
    m: f64,
    c: f64,
}

const M: f64 = 2.0;
const C: f64 = 0.7;

/// Coordinates and rates within the grid.
fn states() -> impl Iterator<Item = (SVector<f64, 2>, SVector<f64, 2>)> {
    (0..60).map(|k| {
        let turn = |by: f64| (by * f64::from(k) + 0.3).sin();
        (SVector::from([0.5 + 1.45 * turn(1.7), 1.4 * turn(0.9)]), SVector::from([turn(2.3), 1.45 * turn(0.37)]))
    })
}

/// Parabolas are reproduced: both differ by some dozens of roundings of terms of order ten, of second derivatives by
/// those divided by the square of a cell's width.
#[test]
fn a_table_is_its_formula() {
    let (table, formula) = (ByTable { m: M, c: C }.kernel().unwrap(), ByFormula { m: M, c: C }.kernel().unwrap());
    let weights = SVector::from([0.3, -0.7, 1.0, 0.8]);
    for (q, z) in states() {
        let close = |what: &str, found: &[f64], wanted: &[f64], bound: f64| {
            for (found, wanted) in found.iter().zip(wanted) {
                assert!((found - wanted).abs() < bound, "{what} at {q:?}, {z:?}: {found} {wanted}");
            }
        };
        let both = (table.acceleration(0.0, &q, &z, &()), formula.acceleration(0.0, &q, &z, &()));
        close("acceleration", both.0.as_slice(), both.1.as_slice(), 1e-13);
        let both = (table.linearize(0.0, &q, &z, &()), formula.linearize(0.0, &q, &z, &()));
        close("by state", both.0.by_state.as_slice(), both.1.by_state.as_slice(), 1e-12);
        let both = (table.by_parameters(0.0, &q, &z, &()), formula.by_parameters(0.0, &q, &z, &()));
        close("by parameters", both.0.as_slice(), both.1.as_slice(), 1e-12);
        let both = (table.hessian(0.0, &q, &z, &(), &weights), formula.hessian(0.0, &q, &z, &(), &weights));
        close("second", both.0.by_state.as_slice(), both.1.by_state.as_slice(), 1e-11);
    }
}

/// A run is the same, too.
#[test]
fn a_run_by_a_table() {
    let (q, z) = (SVector::from([0.4, 0.2]), SVector::from([-0.1, 0.2]));
    let table = ByTable { m: M, c: -C }.kernel().unwrap();
    let formula = ByFormula { m: M, c: -C }.kernel().unwrap();
    let by_table = Simulation::new(&table).adaptive(1e-11, 1e-11).run_to_end(q, z, 0.0..0.8).unwrap();
    let by_formula = Simulation::new(&formula).adaptive(1e-11, 1e-11).run_to_end(q, z, 0.0..0.8).unwrap();
    assert!((by_table.q - by_formula.q).norm() < 1e-9, "{:?} {:?}", by_table.q, by_formula.q);
    // Within the grid, so that it was the formula.
    assert!((X[0]..X[4]).contains(&by_table.q[0]) && (Y[0]..Y[3]).contains(&by_table.q[1]), "{:?}", by_table.q);
}

/// In packs every lane has the bits of a kernel of its own, each in another cell, some beyond the grid.
#[test]
fn lanes_have_the_bits_of_single_numbers() {
    let single = ByTable { m: M, c: C }.kernel().unwrap();
    let packed = ByTable { m: Lanes([M; 4]), c: Lanes([C; 4]) }.kernel().unwrap();
    let all: Vec<_> = states().map(|(q, z)| (q * 1.5, z * 1.5)).collect();
    for of in all.chunks_exact(4) {
        let lanes = |pick: &dyn Fn(usize) -> SVector<f64, 2>| {
            SVector::from([0, 1].map(|i| Lanes(core::array::from_fn(|lane| pick(lane)[i]))))
        };
        let (q, z) = (lanes(&|lane| of[lane].0), lanes(&|lane| of[lane].1));
        let zero = Lanes([0.0; 4]);
        let found = packed.acceleration(zero, &q, &z, &());
        let linear = packed.linearize(zero, &q, &z, &()).by_state;
        for (lane, (q, z)) in of.iter().enumerate() {
            let wanted = single.acceleration(0.0, q, z, &());
            (0..2).for_each(|i| assert_eq!(found[i].0[lane].to_bits(), wanted[i].to_bits(), "lane {lane}"));
            let wanted = single.linearize(0.0, q, z, &()).by_state;
            (0..16).for_each(|i| assert_eq!(linear[i].0[lane].to_bits(), wanted[i].to_bits(), "{i} of lane {lane}"));
        }
    }
}

/// Guaranteed bounds hold the numbers of single precision and of double precision; at lines of the grid, too, where it
/// is open which cell counts.
#[test]
fn every_scalar() {
    let single = ByTable { m: M, c: C }.kernel().unwrap();
    let half = ByTable { m: M as f32, c: C as f32 }.kernel().unwrap();
    let exact = Bounded::exact;
    let bounded = ByTable { m: exact(M), c: exact(C) }.kernel().unwrap();
    for (q, z) in states() {
        let wanted = single.acceleration(0.0, &q, &z, &());
        let found = half.acceleration(0.0, &q.map(|x| x as f32), &z.map(|x| x as f32), &());
        let bounds = bounded.acceleration(exact(0.0), &q.map(exact), &z.map(exact), &());
        for i in 0..2 {
            assert!((f64::from(found[i]) - wanted[i]).abs() < 1e-4, "{found:?} {wanted:?}");
            let found: Bounded<f64> = bounds[i];
            assert!((found.value - wanted[i]).abs() <= found.bound, "{found:?} {wanted:?}");
            assert!(found.bound < 1e-12, "{found:?}");
        }
    }
    let grid: Grid<5, 4, 1, 4> = Grid::of_two(&X, &Y, &LIFT, Joined::Hermite);
    // Not known better than to 1e-3: both cells are in the bounds.
    let unsure = Bounded::measured(X[2] + 1e-4, 1e-3);
    let found = grid.at([0, 0], [unsure, exact(0.0)]);
    for x in [X[2] - 9e-4, X[2] + 1.09e-3] {
        assert!((found.value - lift_at(x, 0.0)).abs() <= found.bound, "{found:?}");
    }
}

/// Twice differentiated in a potential; its derivatives are those of the spline.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y), particle(mass = 1, position = [x, y, 0]), linearize, potential = c * well(x, y),
    table(well, axes = [X, Y], values = LIFT, kind = cubic),
)]
struct Well {
    c: f64,
}

#[test]
fn potentials_of_tables() {
    const C: f64 = 3.0;
    let (kernel, well) = (Well { c: C }.kernel().unwrap(), Grid::<5, 4, 1, 4>::of_two(&X, &Y, &LIFT, Joined::Cubic));
    for (q, z) in states().map(|(q, z)| (q * 1.5, z)) {
        let of = |orders: [u8; 2]| -C * well.at(orders, [q[0], q[1]]);
        assert_eq!(kernel.potential_energy(0.0, &q), -of([0, 0]));
        let force = kernel.acceleration(0.0, &q, &z, &());
        assert_eq!([force[0], force[1]], [of([1, 0]), of([0, 1])]);
        let linear = kernel.linearize(0.0, &q, &z, &()).by_state;
        let wanted = [[of([2, 0]), of([1, 1])], [of([1, 1]), of([0, 2])]];
        (0..4).for_each(|i| assert_eq!(linear[(2 + i / 2, i % 2)], wanted[i / 2][i % 2], "{q:?}"));
    }
    let text = WellKernel::EQUATIONS.text;
    assert!(text.contains("c*well_1_0(x, y)"), "{text}");
    assert!(WellKernel::EQUATIONS.latex.contains("\\operatorname{well}^{(0, 1)}\\left(x, y\\right)"));
}

/// Where derivatives jump, adaptive integrators are told.
#[test]
fn smoothness_is_told() {
    #[derive(GaussDynamics)]
    #[gauss(
        coordinates(x, y), particle(mass = 1, position = [x, y, 0]),
        table(flat, axes = [X, Y], values = LIFT), drive(x = c * flat(x, y)),
    )]
    struct Kinks {
        c: f64,
    }
    assert_eq!(KinksKernel::SMOOTHNESS, Smoothness::Kinks);
}
