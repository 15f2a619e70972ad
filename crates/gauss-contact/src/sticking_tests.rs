//! Bodies between walls that could hold them by forces of any size.

use alloc::vec;
use alloc::vec::Vec;

use gauss_runtime::contact::Contact;

use super::*;
use crate::dense::{Matrix, dot};
use crate::friction::Bounds;

/// Coefficients of friction, units of contacts and of forces.
const FRICTION: f64 = 0.5;
const UNITS: [[f64; 2]; 3] = [[1.0, 1.0], [1e-3, 1e3], [1e6, 1e6]];

/// A particle of unit mass between two walls that lean back by an angle, each to its side, in a plane or in space.
fn notch(angle: f64, free: [f64; 3], tangents: usize, units: [f64; 2]) -> Contacts {
    let (sine, cosine) = angle.sin_cos();
    let wall = |side: f64| [[side * cosine, 0.0, sine], [-sine, 0.0, side * cosine], [0.0, 1.0, 0.0]];
    let rows: Vec<Vec<f64>> = [1.0, -1.0]
        .into_iter()
        .zip(units)
        .flat_map(|(side, unit)| {
            wall(side).into_iter().take(1 + tangents).map(move |row| row.map(|x| unit * x).to_vec())
        })
        .collect();
    let b = rows.iter().map(|row| dot(row, &free)).collect();
    let law = Law::new(&Contact::new("", 0, tangents), Bounds { largest: FRICTION, weights: [1.0; 3] }, None);
    Contacts::new(vec![law; 2], Matrix::from_fn(rows.len(), |i, j| dot(&rows[i], &rows[j])), b)
}

#[test]
fn walls_hold_nothing_that_does_not_press_them() {
    // Steeper than the angle of friction: forces along both walls would hold any load.
    for (tangents, units) in [1, 2].into_iter().flat_map(|tangents| UNITS.map(|units| (tangents, units))) {
        // Between upright walls it falls; out of a notch it is pulled.
        for (angle, free) in [(0.0, [0.0, 0.0, -1.0]), (0.0, [0.0, 0.0, 1.0]), (0.2, [0.0, 0.0, 1.0])] {
            let found = notch(angle, free, tangents, units).solve().unwrap();
            assert!(found.forces.iter().all(|force| *force == 0.0), "{angle} {tangents} {units:?}: {found:?}");
        }
    }
}

#[test]
fn what_is_wedged_is_held_by_forces_as_large_as_its_load() {
    for (tangents, units) in [1, 2].into_iter().flat_map(|tangents| UNITS.map(|units| (tangents, units))) {
        // Those of least norm in these cases are outside the cones, or inside.
        for angle in [0.05, 0.2, 0.4] {
            let contacts = notch(angle, [0.0, 0.0, -1.0], tangents, units);
            let found = contacts.solve().unwrap();
            assert_eq!(found.states, [State::Sticks; 2], "{angle} {tangents} {units:?}");
            assert!(found.residuals.iter().all(Residual::holds));
            let rows = 1 + tangents;
            let normal = |i: usize| found.forces[i * rows] * units[i];
            // Each side bears half of the weight: N sin α + T cos α = 1/2, T ≤ μ N, so N ≥ 1/2/(sin α + μ cos α).
            let least = 0.5 / (angle.sin() + FRICTION * angle.cos());
            for i in 0..2 {
                assert!(normal(i) >= 0.999_999 * least && normal(i) < 2.5 * least, "{angle} {tangents}: {found:?}");
            }
        }
    }
}
