//! The REMUS 100: the velocity-product terms of the derived Kirchhoff equations are the published cross terms.
//!
//! Source: T. Prestero, *Verification of a six-degree of freedom simulation model for the REMUS autonomous underwater
//! vehicle*, MIT/WHOI 2001, appendix C. The thesis lists the added mass by its derivatives (X_u̇, …, so M_A is minus
//! their matrix) and the cross terms of the fluid alone as forces, that is on the right-hand side of the equations.

use std::collections::BTreeMap;

use gauss_runtime::prelude::*;
use serde::Deserialize;
use serde_json::Value;

#[derive(Deserialize)]
struct Remus {
    mass_kg: f64,
    center_of_mass_m: [f64; 3],
    #[serde(rename = "inertia_about_O_kg_m2")]
    inertia: [f64; 3],
    added_mass_derivatives: BTreeMap<String, f64>,
    published_cross_terms: BTreeMap<String, Value>,
}

#[derive(GaussDynamics)]
#[gauss(chart = left_invariant)]
struct Immersed {
    #[gauss(mass)]
    mass: f64,
    #[gauss(center_of_mass)]
    center: Vector3<f64>,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
    #[gauss(added_mass)]
    added: Matrix6<f64>,
}

#[derive(GaussDynamics)]
#[gauss(chart = left_invariant)]
struct Dry {
    #[gauss(mass)]
    mass: f64,
    #[gauss(center_of_mass)]
    center: Vector3<f64>,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
}

type Speeds = SVector<f64, 6>;

fn remus() -> Remus {
    let text = include_str!("../../data/remus100.json");
    serde_json::from_str(text).expect("the data of the REMUS 100")
}

/// Position of a letter in a row of letters.
fn position(letters: &str, letter: char) -> usize {
    letters.find(letter).unwrap_or_else(|| panic!("`{letter}` is none of {letters}"))
}

/// `X_u̇` and its like: row by the force, column by the velocity.
fn added_mass(derivatives: &BTreeMap<String, f64>) -> Matrix6<f64> {
    let mut matrix = Matrix6::zeros();
    for (name, value) in derivatives {
        let mut letters = name.chars();
        let (force, velocity) = (letters.next().expect("a force"), letters.next().expect("a velocity"));
        matrix[(position("XYZKMN", force), position("uvwpqr", velocity))] = -value;
    }
    matrix
}

/// The fluid's share of the right-hand side of Kirchhoff's equations, as a function of the velocities.
fn kernels() -> (ImmersedKernel, DryKernel) {
    let data = remus();
    let (mass, center, inertia) = (data.mass_kg, Vector3::from(data.center_of_mass_m), Vector3::from(data.inertia));
    let added = added_mass(&data.added_mass_derivatives);
    let immersed = Immersed { mass, center, inertia, added }.kernel().expect("a vehicle");
    let dry = Dry { mass, center, inertia }.kernel().expect("a body");
    (immersed, dry)
}

/// Two routes to it: the momentum form, and the Gauss residual at ż = 0.
fn fluid_forces(z: &Speeds) -> [Speeds; 2] {
    let (immersed, dry) = kernels();
    let q = Isometry3::identity();
    let rate = immersed.momentum_rate(0.0, &q, &immersed.momentum(0.0, &q, z), &())
        - dry.momentum_rate(0.0, &q, &dry.momentum(0.0, &q, z), &());
    let zero = Speeds::zeros();
    let residual = dry.gauss_residual(0.0, &q, z, &zero, &()) - immersed.gauss_residual(0.0, &q, z, &zero, &());
    [rate, residual]
}

/// The coefficient of z_a z_b, exact because the forces are quadratic in z: by polarisation at unit velocities.
fn coefficients(a: usize, b: usize) -> [Speeds; 2] {
    let unit = |i: usize| Speeds::from_fn(|row, _| f64::from(u8::from(row == i)));
    if a == b {
        return fluid_forces(&unit(a));
    }
    let (sum, one, other) = (fluid_forces(&(unit(a) + unit(b))), fluid_forces(&unit(a)), fluid_forces(&unit(b)));
    [sum[0] - one[0] - other[0], sum[1] - one[1] - other[1]]
}

#[test]
fn cross_terms_are_the_published_ones() {
    let data = remus();
    let mut compared = 0;
    for (name, value) in &data.published_cross_terms {
        let Some(published) = value.as_f64() else { continue };
        // X_wq: the force along x that is proportional to w q. A last letter a says that it comes from the added mass.
        let letters: Vec<char> = name.chars().collect();
        let row = position("XYZKMN", letters[0]);
        let (a, b) = (position("uvwpqr", letters[1]), position("uvwpqr", letters[2]));
        for derived in coefficients(a, b) {
            // Half a unit of the last digit that the thesis prints. Its own rule for M_rp, K_ṗ − N_ṙ, gives 4.8096.
            let printed = if name == "Mrp" { 5e-3 } else { 0.0 };
            // Momenta of the order 70 (mass and added mass) cancel; a handful of roundings of their size remain.
            let rounding = 16.0 * f64::EPSILON * 70.0;
            let error = (derived[row] - published).abs();
            assert!(error <= printed + rounding, "{name}: derived {}, published {published}", derived[row]);
        }
        compared += 1;
    }
    assert_eq!(compared, 14, "terms in the data");
}

/// The thesis' rules, for every product and every force: what it does not print must vanish or follow by symmetry.
#[test]
fn every_product_follows_from_the_added_mass() {
    let added = added_mass(&remus().added_mass_derivatives);
    assert_eq!(added, added.transpose());
    for a in 0..6 {
        for b in a..6 {
            // Q_f × ω and Γ_f × ω + Q_f × u with (Q_f, Γ_f) = M_A (u, ω), polarised.
            let unit = |i: usize| Speeds::from_fn(|row, _| f64::from(u8::from(row == i)));
            let product = |z: &Speeds, w: &Speeds| {
                let momentum = added * z;
                let part = |v: &Speeds, at: usize| Vector3::new(v[at], v[at + 1], v[at + 2]);
                let linear = part(&momentum, 0).cross(&part(w, 3));
                let angular = part(&momentum, 3).cross(&part(w, 3)) + part(&momentum, 0).cross(&part(w, 0));
                Speeds::from_fn(|i, _| if i < 3 { linear[i] } else { angular[i - 3] })
            };
            let expected = if a == b {
                product(&unit(a), &unit(a))
            } else {
                product(&unit(a), &unit(b)) + product(&unit(b), &unit(a))
            };
            for derived in coefficients(a, b) {
                let error = (derived - expected).amax();
                // Rounding as above.
                assert!(error <= 16.0 * f64::EPSILON * 70.0, "products ({a}, {b}): {derived} against {expected}");
            }
        }
    }
}
