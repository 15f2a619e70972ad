//! Tables on grids: values, derivatives, what is reproduced, lanes.

use super::*;
use crate::dual::Dual;
use crate::simd::Lanes;
use crate::table::{Cubic, Linear};

const X: [f64; 5] = [-1.0, 0.0, 0.5, 2.0, 3.0];
const Y: [f64; 4] = [0.0, 1.0, 1.5, 4.0];
const Z: [f64; 3] = [-2.0, 0.0, 0.75];

/// Numbers of order one without a pattern.
const fn values() -> [[[f64; 3]; 4]; 5] {
    let mut values = [[[0.0; 3]; 4]; 5];
    let mut i = 0;
    while i < 60 {
        values[i / 12][i / 3 % 4][i % 3] = ((i * i * 37 + i * 11) % 101) as f64 / 50.0 - 1.0;
        i += 1;
    }
    values
}

const VALUES: [[[f64; 3]; 4]; 5] = values();
const LINEAR: Grid<5, 4, 3, 1> = Grid::of_three(&X, &Y, &Z, &VALUES, Joined::Linear);
const HERMITE: Grid<5, 4, 3, 8> = Grid::of_three(&X, &Y, &Z, &VALUES, Joined::Hermite);
const CUBIC: Grid<5, 4, 3, 8> = Grid::of_three(&X, &Y, &Z, &VALUES, Joined::Cubic);

/// Places within the grid and beyond every face of it, none at a line of it.
fn places() -> impl Iterator<Item = [f64; 3]> {
    (0..13).flat_map(|i| {
        (0..11).flat_map(move |j| {
            (0..7).map(move |l| {
                [-1.97 + 0.4531 * f64::from(i), -0.9 + 0.5473 * f64::from(j), -2.7 + 0.6173 * f64::from(l)]
            })
        })
    })
}

fn is_within([x, y, z]: [f64; 3]) -> bool {
    let within = |axis: &[f64], x: f64| axis[0] <= x && x <= axis[axis.len() - 1];
    within(&X, x) && within(&Y, y) && within(&Z, z)
}

/// A derivative by the number of the table and its orders.
fn of(kind: usize, orders: [u8; 3], x: [f64; 3]) -> f64 {
    [LINEAR.at(orders, x), HERMITE.at(orders, x), CUBIC.at(orders, x)][kind]
}

/// Weights at points of an axis are zero and one, without rounding.
#[test]
fn all_meet_their_values() {
    for (i, x) in X.into_iter().enumerate() {
        for (j, y) in Y.into_iter().enumerate() {
            for (l, z) in Z.into_iter().enumerate() {
                for kind in 0..3 {
                    assert_eq!(of(kind, [0; 3], [x, y, z]), VALUES[i][j][l], "{kind} at {x} {y} {z}");
                }
            }
        }
    }
    assert!(HERMITE.at([0; 3], [f64::NAN, 1.0, 0.0]).is_nan() && CUBIC.at([0; 3], [1.0, 0.0, f64::NAN]).is_nan());
    assert!(CUBIC.at([1, 0, 0], [f64::NAN, 1.0, 0.0]).is_nan() && LINEAR.at([0; 3], [1.0, f64::NAN, 0.0]).is_nan());
}

/// Beyond its faces, edges and corners second differences along each axis vanish.
#[test]
fn all_go_on_straight() {
    for kind in 0..3 {
        for (x, by) in [
            ([5.0, 1.2, 0.1], 0),
            ([-3.0, 9.0, -1.0], 0),
            ([0.3, -2.0, 9.0], 1),
            ([0.3, 7.0, 0.1], 1),
            ([4.0, 5.0, 3.0], 2),
        ] {
            let at = |s: f64| of(kind, [0; 3], core::array::from_fn(|k| if k == by { x[k] + s } else { x[k] }));
            // Sums of some dozens of numbers of order ten.
            assert!((at(1.0) - 2.0 * at(0.0) + at(-1.0)).abs() < 1e-12, "{kind} {x:?}");
            let orders = core::array::from_fn(|k| if k == by { 2 } else { 0 });
            assert_eq!(of(kind, orders, x), 0.0, "{kind} {x:?}");
        }
    }
}

/// Differences of fourth order with steps of 1e-3, and rounding of values over the step; dual numbers know no step.
#[test]
fn derivatives_are_those_of_the_values() {
    let h = 1e-3;
    let difference = |f: &dyn Fn(f64) -> f64| (8.0 * (f(h) - f(-h)) - (f(2.0 * h) - f(-2.0 * h))) / (12.0 * h);
    let near = |axis: &[f64], x: f64| axis.iter().any(|line| (line - x).abs() < 3.0 * h);
    for x in places().filter(|x| !near(&X, x[0]) && !near(&Y, x[1]) && !near(&Z, x[2])) {
        for kind in 0..3 {
            for (orders, by) in [
                ([0, 0, 0], 0),
                ([0, 0, 0], 1),
                ([0, 0, 0], 2),
                ([1, 0, 0], 1),
                ([0, 1, 1], 0),
                ([1, 0, 0], 0),
                ([0, 1, 0], 1),
                ([0, 1, 2], 2),
                ([2, 1, 0], 0),
            ] {
                let mut higher: [u8; 3] = orders;
                higher[by] += 1;
                let wanted =
                    difference(&|s| of(kind, orders, core::array::from_fn(|k| if k == by { x[k] + s } else { x[k] })));
                let found = of(kind, higher, x);
                assert!((found - wanted).abs() < 1e-8, "{kind} {higher:?} at {x:?}: {found} {wanted}");
            }
        }
        let variables: [Dual<3>; 3] = core::array::from_fn(|k| Dual::variable(x[k], k));
        let dual = CUBIC.at([1, 0, 0], variables);
        for (k, orders) in [[2, 0, 0], [1, 1, 0], [1, 0, 1]].into_iter().enumerate() {
            assert!((dual.slopes[k] - CUBIC.at(orders, x)).abs() < 1e-11, "{orders:?} at {x:?}");
        }
    }
}

/// Across all lines of the grid and its faces values are continuous, of cubics one derivative, of the spline two.
#[test]
fn derivatives_are_continuous() {
    let orders = [
        (0, [0, 0, 0]),
        (1, [1, 0, 0]),
        (1, [0, 1, 0]),
        (1, [0, 0, 1]),
        (1, [1, 1, 1]),
        (2, [2, 0, 0]),
        (2, [0, 2, 0]),
        (2, [0, 0, 2]),
        (2, [2, 1, 2]),
    ];
    let axes: [&[f64]; 3] = [&X, &Y, &Z];
    for x in places() {
        for (by, axis) in axes.into_iter().enumerate() {
            for (line, (continuous, orders)) in axis.iter().flat_map(|line| orders.map(|orders| (line, orders))) {
                for kind in continuous..3 {
                    let at = |s: f64| of(kind, orders, core::array::from_fn(|k| if k == by { line + s } else { x[k] }));
                    // The next derivative is of order 1e3 at most, times the step.
                    assert!((at(-1e-9) - at(1e-9)).abs() < 1e-5, "{kind} {orders:?} at {x:?}, line {line} of {by}");
                }
            }
        }
    }
}

/// Products of straight lines are reproduced by all, of parabolas by parabolas, of splines by the spline.
#[test]
fn what_is_of_their_kind_is_reproduced() {
    fn product(f: impl Fn(f64) -> f64) -> [[[f64; 3]; 4]; 5] {
        X.map(|x| Y.map(|y| Z.map(|z| f(x) * f(y) * f(z))))
    }
    let (parabola, line) = (|x: f64| 0.3 * x * x - x + 2.0, |x: f64| 0.3 * x - 2.0);
    let by_parabolas: Grid<5, 4, 3, 8> = Grid::of_three(&X, &Y, &Z, &product(parabola), Joined::Hermite);
    let lines = product(line);
    let linear: Grid<5, 4, 3, 1> = Grid::of_three(&X, &Y, &Z, &lines, Joined::Linear);
    let [hermite, cubic] =
        [Joined::Hermite, Joined::Cubic].map(|joined| Grid::<5, 4, 3, 8>::of_three(&X, &Y, &Z, &lines, joined));
    for [x, y, z] in places() {
        let wanted = line(x) * line(y) * line(z);
        for found in [linear.at([0; 3], [x, y, z]), hermite.at([0; 3], [x, y, z]), cubic.at([0; 3], [x, y, z])] {
            assert!((found - wanted).abs() < 1e-12, "{x} {y} {z}: {found} {wanted}");
        }
        if is_within([x, y, z]) {
            let wanted = parabola(x) * parabola(y) * parabola(z);
            assert!((by_parabolas.at([0; 3], [x, y, z]) - wanted).abs() < 1e-12 * (1.0 + wanted.abs()));
            let slope = parabola(x) * (0.6 * y - 1.0) * parabola(z);
            assert!((by_parabolas.at([0, 1, 0], [x, y, z]) - slope).abs() < 1e-12 * (1.0 + slope.abs()));
        }
    }
}

/// The table of a product of two functions is the product of their tables; of one variable it is the same curve.
#[test]
fn products_and_single_curves() {
    let (f, g) = ([1.0, -1.0, 0.5, 2.0, 0.0], [0.5, 1.0, -2.0, 1.0]);
    let values = f.map(|f| g.map(|g| f * g));
    let points = |axis: &[f64], values: &[f64], i: usize| [axis[i], values[i]];
    let (fs, gs) = (core::array::from_fn(|i| points(&X, &f, i)), core::array::from_fn(|i| points(&Y, &g, i)));
    let (of_x, of_y): (Cubic<5>, Cubic<4>) = (Cubic::through(&fs), Cubic::through(&gs));
    let surface: Grid<5, 4, 1, 4> = Grid::of_two(&X, &Y, &values, Joined::Cubic);
    let flat: Grid<5, 4, 1, 1> = Grid::of_two(&X, &Y, &values, Joined::Linear);
    let (lines, other): (Linear<5>, Linear<4>) = (Linear::through(&fs), Linear::through(&gs));
    let curve: Grid<5, 1, 1, 2> = Grid::through(&fs, Joined::Cubic);
    for [x, y, _] in places() {
        let close = |found: f64, wanted: f64| assert!((found - wanted).abs() < 1e-11, "{x} {y}: {found} {wanted}");
        close(surface.at([0, 0], [x, y]), of_x.value(x) * of_y.value(y));
        close(surface.at([1, 2], [x, y]), of_x.slope(x) * of_y.second(y));
        close(surface.at([3, 1], [x, y]), if X[0] < x { of_x.third(x) * of_y.slope(y) } else { 0.0 });
        close(flat.at([0, 0], [x, y]), lines.value(x) * other.value(y));
        close(flat.at([1, 1], [x, y]), lines.slope(x) * other.slope(y));
        for (order, wanted) in [of_x.value(x), of_x.slope(x), of_x.second(x)].into_iter().enumerate() {
            close(curve.at([order as u8], [x]), wanted);
        }
    }
}

/// Cells that other lanes are in add nothing.
#[test]
fn lanes_find_their_own_cells() {
    let places: [[f64; 4]; 3] = [[-3.0, 0.2, 0.5, 2.7], [5.0, 0.1, 1.0, 1.2], [0.1, -7.0, 0.0, 0.7]];
    for orders in [[0, 0, 0], [1, 0, 0], [0, 2, 1], [3, 1, 0]] {
        let (linear, cubic) = (LINEAR.at(orders, places.map(Lanes)), CUBIC.at(orders, places.map(Lanes)));
        for k in 0..4 {
            let place = places.map(|x| x[k]);
            assert_eq!(linear.0[k].to_bits(), LINEAR.at(orders, place).to_bits(), "lane {k} of {orders:?}");
            assert_eq!(cubic.0[k].to_bits(), CUBIC.at(orders, place).to_bits(), "lane {k} of {orders:?}");
        }
    }
}

/// Just before a point behind which the cell is 10⁶ times narrower, and the slope as many times steeper: there the
/// cubic is `w (s₀ u v² − s₁ u² v)` with the distances u and v from its ends, the values at which are zero.
#[test]
fn a_cell_beside_a_narrow_one_keeps_its_digits() {
    const X: [f64; 3] = [-1.0, 0.0, 1e-6];
    const VALUES: [f64; 3] = [0.0, 0.0, 1.0];
    const FLAT: [f64; 2] = [0.0, 1.0];
    const ONE: Grid<3, 1, 1, 2> = Grid::of_one(&X, &VALUES, Joined::Hermite);
    const THREE: Grid<3, 2, 2, 8> =
        Grid::of_three(&X, &FLAT, &FLAT, &[[[0.0; 2]; 2], [[0.0; 2]; 2], [[1.0; 2]; 2]], Joined::Hermite);
    let [before, behind] = [-1.0, 0.0].map(|x| ONE.at([1], [x]));
    for distance in [0.5, 1e-3, 1e-6, 1e-9, 1e-12] {
        let (u, v) = (1.0 - distance, distance);
        let value = before * u * v * v - behind * u * u * v;
        let slope = before * v * (v - 2.0 * u) + behind * u * (u - 2.0 * v);
        for (found, exact) in [
            (ONE.at([0], [-distance]), value),
            (ONE.at([1], [-distance]), slope),
            (THREE.at([0, 0, 0], [-distance, 0.3, 0.7]), value),
            (THREE.at([1, 0, 0], [-distance, 0.3, 0.7]), slope),
        ] {
            // Some ten roundings, and of both terms of a sum.
            let size = exact.abs().max(behind.abs() * v.min(u) * 1e-3);
            assert!((found - exact).abs() <= 16.0 * f64::EPSILON * size, "{distance:e}: {found:e}, not {exact:e}");
        }
    }
    const LINE: Grid<3, 1, 1, 1> = Grid::of_one(&X, &[1.0, 0.0, 1.0], Joined::Linear);
    assert_eq!(LINE.at([0], [-1e-12]), 1e-12);
}
