//! Tables of points that come at run time: they are the constants with the same points, and say all that is wrong.

use super::*;
use crate::table::{Cubic, Grid};
use alloc::string::ToString as _;

const X: [f64; 5] = [-1.0, 0.0, 0.5, 2.0, 3.0];
const Y: [f64; 4] = [0.0, 1.0, 1.5, 4.0];
const Z: [f64; 3] = [-2.0, 0.0, 0.75];
const VALUES: [[[f64; 3]; 4]; 5] = {
    // Numbers of order one without a pattern.
    let mut values = [[[0.0; 3]; 4]; 5];
    let mut i = 0;
    while i < 60 {
        values[i / 12][i / 3 % 4][i % 3] = ((i * i * 37 + i * 11) % 101) as f64 / 50.0 - 1.0;
        i += 1;
    }
    values
};

/// Places within each axis, at its points, and beyond both ends.
fn along(axis: &[f64]) -> impl Iterator<Item = f64> + Clone {
    let last = axis[axis.len() - 1];
    axis.iter().flat_map(|x| [*x, x + 0.21]).chain([axis[0] - 1.3, last + 7.0, f64::INFINITY])
}

fn bits(x: f64) -> u64 {
    if x.is_nan() { f64::NAN } else { x }.to_bits()
}

#[test]
fn grids_of_three_are_the_constants() {
    fn compare<const K: usize>(grid: &Grid<5, 4, 3, K>, joined: Joined) {
        let table = Table::on_grid(&[&X, &Y, &Z], VALUES.as_flattened().as_flattened(), joined).expect("a table");
        assert_eq!(table.variables(), 3);
        for x in along(&X) {
            for y in along(&Y) {
                for z in along(&Z) {
                    for orders in [[0; 3], [1, 0, 0], [0, 1, 1], [2, 1, 3], [1, 1, 1]] {
                        let (own, constant) = (table.at(orders, [x, y, z]), grid.at(orders, [x, y, z]));
                        assert_eq!(bits(own), bits(constant), "{joined:?} {orders:?} at {x} {y} {z}");
                    }
                }
            }
        }
    }
    const LINEAR: Grid<5, 4, 3, 1> = Grid::of_three(&X, &Y, &Z, &VALUES, Joined::Linear);
    const HERMITE: Grid<5, 4, 3, 8> = Grid::of_three(&X, &Y, &Z, &VALUES, Joined::Hermite);
    const CUBIC: Grid<5, 4, 3, 8> = Grid::of_three(&X, &Y, &Z, &VALUES, Joined::Cubic);
    compare(&LINEAR, Joined::Linear);
    compare(&HERMITE, Joined::Hermite);
    compare(&CUBIC, Joined::Cubic);
}

#[test]
fn fewer_variables_are_the_constants_too() {
    const OF_TWO: Grid<4, 3, 1, 4> = Grid::of_two(&Y, &Z, &VALUES[2], Joined::Cubic);
    let table = Table::on_grid(&[&Y, &Z], VALUES[2].as_flattened(), Joined::Cubic).expect("a table");
    for (y, z) in along(&Y).flat_map(|y| along(&Z).map(move |z| (y, z))) {
        // The third number is filling.
        assert_eq!(bits(table.at([1, 1, 0], [y, z, f64::NAN])), bits(OF_TWO.at([1, 1], [y, z])), "{y} {z}");
    }
    const POINTS: [[f64; 2]; 5] = [[-1.0, 2.0], [0.0, 1.0], [0.5, 1.5], [2.0, 0.0], [3.0, 0.25]];
    const OF_ONE: Grid<5, 1, 1, 2> = Grid::through(&POINTS, Joined::Hermite);
    const SPLINE: Cubic<5> = Cubic::through(&POINTS);
    let [hermite, cubic] =
        [Joined::Hermite, Joined::Cubic].map(|joined| Table::through(&POINTS, joined).expect("a table"));
    for x in along(&X).filter(|x| x.is_finite()) {
        assert_eq!(bits(hermite.at([1, 0, 0], [x; 3])), bits(OF_ONE.at([1], [x])));
        // By another form of the same cubics: some roundings of terms of order ten.
        assert!((cubic.at([0; 3], [x; 3]) - SPLINE.value(x)).abs() < 40.0 * f64::EPSILON);
    }
    assert!(cubic.at([0; 3], [f64::NAN; 3]).is_nan());
}

#[test]
fn all_faults_come_at_once() {
    let found = Table::on_grid(&[&[0.0, f64::NAN, 1.0, 1.0], &[2.0]], &[f64::INFINITY, 0.0], Joined::Linear);
    let found = found.expect_err("faults");
    assert!(matches!(found[0], TableFault::NotFinite { axis: Some(0), place: 1, value } if value.is_nan()));
    let rest = [
        TableFault::Order { axis: 0, place: 3 },
        TableFault::Short { axis: 1, count: 1 },
        TableFault::NotFinite { axis: None, place: 0, value: f64::INFINITY },
        TableFault::Values { expected: 4, found: 2 },
    ];
    assert_eq!(found[1..], rest);
    assert_eq!(Table::on_grid(&[], &[0.0], Joined::Linear), Err(alloc::vec![TableFault::Axes(0)]));
    // A number after one that is none is not compared with it.
    let words = found[1].to_string();
    assert_eq!(words, "the numbers of an axis of a table increase, and number 3 of axis 0 does not");
}
