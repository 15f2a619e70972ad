//! Solutions against closed forms, independent and dependent.

use super::*;

#[test]
fn independent_systems_are_solved_to_rounding_whatever_their_units() {
    for unit in [1.0, 1e-6, 1e6] {
        let units = [1.0, unit, unit * unit];
        let entries = [[4.0, 1.0, -0.5], [1.0, 3.0, 0.7], [-0.5, 0.7, 2.0]];
        let matrix = Matrix::from_fn(3, |i, j| entries[i][j] * units[i] * units[j]);
        let wanted = [1.0, -2.0 / unit, 3.0 / (unit * unit)];
        let b: Vec<f64> = (0..3).map(|i| dot(matrix.row(i), &wanted)).collect();
        let found = Decomposition::new(&matrix, |i| matrix.at(i, i));
        assert_eq!(found.rank(), 3);
        for (x, wanted) in found.solve(&b).iter().zip(wanted) {
            // The condition of the scaled matrix is below 3; 3 unknowns with some roundings each.
            assert!((x - wanted).abs() <= 64.0 * f64::EPSILON * wanted.abs(), "{x} {wanted}");
        }
    }
}

#[test]
fn a_table_on_four_legs_stands_on_all_of_them_alike() {
    // Legs at (±1, ±1) of a plate: height and two tilts, with unit masses; each leg has the row (1, x, y).
    let legs = [[1.0, 1.0, 1.0], [1.0, 1.0, -1.0], [1.0, -1.0, 1.0], [1.0, -1.0, -1.0]];
    let matrix = Matrix::from_fn(4, |i, j| dot(&legs[i], &legs[j]));
    let found = Decomposition::new(&matrix, |i| matrix.at(i, i));
    assert_eq!(found.rank(), 3);
    for force in found.solve(&[9.81; 4]) {
        assert!((force - 9.81 / 4.0).abs() < 1e-14, "{force}");
    }
    // Weight at (0.5, 0): forces of least squares are linear in the place.
    let b: Vec<f64> = legs.iter().map(|leg| leg[0] + 0.5 * leg[1]).collect();
    for (force, leg) in found.solve(&b).iter().zip(legs) {
        assert!((force - (1.0 + 0.5 * leg[1]) / 4.0).abs() < 1e-15, "{force}");
    }
}
