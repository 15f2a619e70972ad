//! What `kernel()` refuses of modes that are made of fields.

use gauss_runtime::error::Rule;
use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(base: Pose, a, b),
    body(hull, pose = base, mass = 9, inertia = [1, 1, 1]),
    body(panel, parent = hull, mass = 4, center_of_mass = [1, 0, 0], inertia = [1, 8, 8]),
    modes(panel, coordinates = [a, b], translation = [[0, 0, d], [0, 0, 0]], rotation = [[0, -d, 0], [0, 0, 0]],
        mass = [m, 1], stiffness = [[k, c], [c, 1]]),
)]
struct Panel {
    d: f64,
    m: f64,
    k: f64,
    c: f64,
}

const WELL: Panel = Panel { d: 1.0, m: 1.0, k: 2.0, c: 0.5 };

fn broken(panel: &Panel) -> Vec<(&'static str, Rule)> {
    let Err(error) = panel.kernel() else { return Vec::new() };
    error.violations().iter().map(|violation| (violation.field, violation.rule)).collect()
}

#[test]
fn modes_of_fields_fit_the_body() {
    assert_eq!(broken(&WELL), []);
    // All of the mass moves with the mode, and more than all.
    assert_eq!(broken(&Panel { d: 2.0, ..WELL }), []);
    assert_eq!(broken(&Panel { d: 2.001, ..WELL }), [("panel", Rule::SemidefiniteModes)]);
    assert_eq!(broken(&Panel { m: 0.0, ..WELL }), [("panel", Rule::PositiveModalMass)]);
    assert_eq!(broken(&Panel { c: 2.0, ..WELL }), [("panel.stiffness", Rule::SemidefiniteStiffness)]);
    assert_eq!(broken(&Panel { k: f64::NAN, ..WELL }), [("k", Rule::Finite), ("panel.stiffness", Rule::Finite)]);
}
