//! The spin-up of a beam (T. R. Kane, R. R. Ryan, A. K. Banerjee 1987): L 10, ρA 1.2, EI 1.4e4, EA 2.8e7, from rest to
//! 6 in 15 s. What is stretched by spin is stiffened by it; a model that is linearised too early falls apart.

use gauss_runtime::prelude::*;

const LENGTH: f64 = 10.0;
const AXIAL: f64 = 2.8e7;
const DENSITY: f64 = 1.2;
const RATE: f64 = 6.0;

/// ω²ρAL³/(3EA).
const STRETCH: f64 = RATE * RATE * DENSITY * LENGTH * LENGTH * LENGTH / (3.0 * AXIAL);

/// Stretching by the shape of a centrifugal load, φ = (3ξ − ξ³)/2, by its integrals. Without what is of second order
/// the load is that of the undeformed beam.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(s),
    body(beam, rotation = rotation_z(w * t), mass = m, center_of_mass = [0.5 * l, 0, 0],
        inertia = [0, m * l * l / 3, m * l * l / 3]),
    modes(beam, coordinates = [s], translation = [[0.625 * m, 0, 0]], mass = [17 * m / 35], stiffness = [1.2 * ea / l],
        inertia = [[0, 0.8 * m * l, 0.8 * m * l, 0, 0, 0]]),
)]
struct Stretched {
    m: f64,
    l: f64,
    ea: f64,
    w: f64,
}

#[test]
fn a_beam_in_steady_spin_stretches() {
    let beam = Stretched { m: DENSITY * LENGTH, l: LENGTH, ea: AXIAL, w: RATE }.kernel().unwrap();
    let (at_rest, none) = (SVector::from([STRETCH]), SVector::<f64, 1>::zeros());
    let rate = beam.acceleration(0.0, &at_rest, &none, &())[0];
    // The load over the modal mass: EA 1.2 s/L is of this size, and rounded a few times.
    let load = 1.2 * AXIAL / LENGTH * STRETCH / (17.0 / 35.0 * DENSITY * LENGTH);
    assert!(rate.abs() < 1e-14 * load, "{rate:e} {load}");
    assert_eq!(format!("{STRETCH:.6e}"), "5.142857e-4");
}

/// ψ₁₁(L), ψ₁₂(L), … of bending modes of unit modal mass would be needed for the end; the file has ∫ψ dm alone.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(s, a1, a2, a3),
    body(beam, rotation = rotation_z(0.4 * (0.5 * t * t + powi(7.5 / pi, 2) * (cos(t * pi / 7.5) - 1)))),
    modes(beam, coordinates = [s, a1, a2, a3], file = "flexible/spin_up.json"),
)]
struct SpinUp {}

/// Once it has its rate: from the angle of 45 rad.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(s, a1, a2, a3),
    body(beam, rotation = rotation_z(6 * t - 45)),
    modes(beam, coordinates = [s, a1, a2, a3], file = "flexible/spin_up.json"),
)]
struct Spinning {}

/// The same without the foreshortening: the modes alone, and the inertia that they have.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a),
    body(beam, rotation = rotation_z(0.4 * (0.5 * t * t + powi(7.5 / pi, 2) * (cos(t * pi / 7.5) - 1))), mass = 12,
        center_of_mass = [5, 0, 0], inertia = [0, 400, 400]),
    modes(beam, coordinates = [a], translation = [[0, 2.712_363, 0]], rotation = [[0, 0, 19.704_701]],
        stiffness = [14.422_757], inertia = [[0, 0, 0, -19.704_701, 0, 0]], second_inertia = [[[2, 0, 2, 0, 0, 0]]]),
)]
struct TooEarly {}

/// φ_k(L) of modes of unit modal mass: ±2/√m.
fn tip(q: &SVector<f64, 4>) -> f64 {
    2.0 / (DENSITY * LENGTH).sqrt() * (q[1] - q[2] + q[3])
}

#[test]
fn a_beam_that_spins_up_lags_and_comes_back() {
    let rest = SVector::<f64, 4>::zeros();
    let (starting, steady) = (SpinUp {}.kernel().unwrap(), Spinning {}.kernel().unwrap());
    let spun = Simulation::new(&starting).adaptive(1e-9, 1e-12).run(rest, rest, 0.0..15.0).unwrap();
    let deflections: Vec<f64> = (0..=300).map(|k| tip(&spun.at(0.05 * f64::from(k)).unwrap().q)).collect();
    let (least, most) = deflections.iter().fold((0.0_f64, 0.0_f64), |(a, b), x| (a.min(*x), b.max(*x)));
    println!("tip from {least} to {most}");
    assert!((-0.60..-0.55).contains(&least) && most < 0.02, "{least} {most}");
    let end = spun.last();
    let after = Simulation::new(&steady).adaptive(1e-9, 1e-12).run(end.q, end.z, 15.0..20.0).unwrap();
    let mean: f64 = (0..=500).map(|k| after.at(15.0 + 0.01 * f64::from(k)).unwrap().q[0]).sum::<f64>() / 501.0;
    for k in 0..=500 {
        let deflection = tip(&after.at(15.0 + 0.01 * f64::from(k)).unwrap().q);
        assert!(deflection.abs() < 5e-3, "{deflection}");
    }
    println!("stretch {mean}");
    assert!((mean / STRETCH - 1.0).abs() < 1e-3, "{mean} {STRETCH}");
}

#[test]
fn without_foreshortening_it_is_thrown_out() {
    let rest = SVector::<f64, 1>::zeros();
    let beam = TooEarly {}.kernel().unwrap();
    let spun = Simulation::new(&beam).adaptive(1e-9, 1e-12).run(rest, rest, 0.0..15.0).unwrap();
    let deflection = 2.0 / (DENSITY * LENGTH).sqrt() * spun.last().q[0];
    println!("{deflection}");
    assert!(deflection.abs() > LENGTH, "{deflection}");
}
