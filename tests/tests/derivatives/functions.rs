//! Functions of expressions: inverse and hyperbolic ones, powers, π, tables, and functions of the user's own, in
//! forces, potentials, derivatives and power series, and in every scalar.

use gauss_bounded::Bounded;
use gauss_runtime::integrate::Taylor;
use gauss_runtime::prelude::*;
use gauss_runtime::table::{Cubic, Linear};

const POINTS: [[f64; 2]; 4] = [[-1.0, 0.5], [0.0, 0.0], [0.7, 0.9], [2.0, 1.0]];

/// A law of the user's own, with two derivatives.
fn hump<T: Real>(x: T) -> T {
    (-x * x).exp()
}

fn hump_slope<T: Real>(x: T) -> T {
    -(x + x) * hump(x)
}

mod laws {
    use super::*;

    pub fn curvature<T: Real>(x: T) -> T {
        (T::from_f64(4.0) * x * x - T::from_f64(2.0)) * hump(x)
    }
}

/// One drive for each function of x.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x), particle(mass = m, position = [x, 0, 0]), linearize(parameters),
    function(hump, derivative = hump_slope), table(line, points = POINTS), table(spline, points = POINTS, kind = cubic),
    drive(arcs, x = asin(x) + 2 * acos(x) + 3 * atan(x)),
    drive(smooth, x = tanh(3 * x) + pi * x.tanh()),
    drive(powers, x = powf(x, p) + 2 * powf(x, 2.5) + powf(x, 3) + 5 * x.powf(-0.5)),
    drive(own, x = 2 * hump(x)),
    drive(tables, x = line(x) + 10 * spline(x)),
)]
struct Functions<T> {
    m: T,
    p: T,
}

/// What the drives are, by the library of the scalar.
fn by_hand<T: Real>(x: T, p: T) -> [T; 5] {
    let n = T::from_f64;
    let (line, spline) = (Linear::through(&POINTS), Cubic::through(&POINTS));
    [
        x.asin() + n(2.0) * x.acos() + n(3.0) * x.atan(),
        (n(3.0) * x).tanh() + n(std::f64::consts::PI) * x.tanh(),
        x.powf(p) + n(2.0) * x.powf(n(2.5)) + x * x * x + n(5.0) / x.sqrt(),
        n(2.0) * hump(x),
        line.value(x) + n(10.0) * spline.value(x),
    ]
}

/// The library's functions differ from these by some ulp, of terms that are of order 10.
const CLOSE: f64 = 64.0 * f64::EPSILON;

#[test]
fn values_and_derivatives() {
    let (m, p) = (2.0, 1.7);
    let kernel = Functions { m, p }.kernel().expect("a particle");
    for k in 1..100 {
        let x = 0.0099 * f64::from(k);
        let (q, z) = (SVector::from([x]), SVector::from([0.3]));
        let forces = kernel.element_forces(0.0, &q, &z, &());
        for (e, wanted) in by_hand(x, p).into_iter().enumerate() {
            assert!((forces[(0, e)] - wanted).abs() <= CLOSE * (1.0 + wanted.abs()), "element {e} at {x}");
        }
        let found = kernel.linearize(0.0, &q, &z, &()).by_state[(1, 0)];
        // Differences of order 4 of step h: h⁴ of the fifth derivative, and rounding over h.
        let h = 2e-4 * x.min(1.0 - x);
        let at = |x: f64| by_hand(x, p).iter().sum::<f64>() / m;
        let wanted = (8.0 * (at(x + h) - at(x - h)) - (at(x + 2.0 * h) - at(x - 2.0 * h))) / (12.0 * h);
        let rounding = 1e-14 * (1.0 + at(x).abs()) / h;
        // Steps over the corner of the table at 0.7 tell nothing.
        if (x - 0.7).abs() > 1e-3 {
            assert!((found - wanted).abs() < 1e-9 * (1.0 + wanted.abs()) + rounding, "{x}: {found} {wanted}");
        }
    }
}

/// By the exponent, too; and at 0, where the power is 0 and so are its derivatives.
#[test]
fn powers_by_base_and_exponent() {
    #[derive(GaussDynamics)]
    #[gauss(coordinates(x), particle(mass = 1, position = [x, 0, 0]), linearize(parameters), drive(x = powf(x, p)))]
    struct Power {
        p: f64,
    }
    let by = |x: f64, p: f64| {
        let kernel = Power { p }.kernel().expect("a particle");
        let (q, z) = (SVector::from([x]), SVector::from([0.0]));
        (kernel.linearize(0.0, &q, &z, &()).by_state[(1, 0)], kernel.by_parameters(0.0, &q, &z, &())[(1, 0)])
    };
    let (x, p) = (0.6_f64, 1.7);
    let (by_base, by_exponent) = by(x, p);
    assert!((by_base - p * x.powf(p - 1.0)).abs() < 1e-15);
    assert!((by_exponent - x.powf(p) * x.ln()).abs() < 1e-15);
    assert_eq!(by(0.0, p), (0.0, 0.0));
}

#[test]
fn every_scalar() {
    let (x, p) = (0.4, 1.7);
    let kernel = Functions { m: 2.0_f32, p: p as f32 }.kernel().expect("a particle");
    let forces = kernel.element_forces(0.0, &SVector::from([x as f32]), &SVector::from([0.0]), &());
    for (e, wanted) in by_hand(x, p).into_iter().enumerate() {
        assert!((f64::from(forces[(0, e)]) - wanted).abs() < 1e-5 * (1.0 + wanted.abs()), "element {e}");
    }
    // Guaranteed bounds hold the values of double precision, and stay within some hundred roundings.
    let exact = Bounded::exact;
    let kernel = Functions { m: exact(2.0), p: exact(p) }.kernel().expect("a particle");
    let forces = kernel.element_forces(exact(0.0), &SVector::from([exact(x)]), &SVector::from([exact(0.0)]), &());
    for (e, wanted) in by_hand(x, p).into_iter().enumerate() {
        let bounded: Bounded<f64> = forces[(0, e)];
        assert!((bounded.value - wanted).abs() <= bounded.bound + CLOSE * (1.0 + wanted.abs()), "element {e}");
        assert!(bounded.bound < 1e-12, "element {e}: {}", bounded.bound);
    }
}

/// Smooth functions have power series, and potentials are differentiated: a run by them agrees with steps of order 8.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y), particle(mass = 1, position = [x, y, 0]), taylor,
    potential = powf(1 + x * x, 0.3) + asin(0.3 * sin(x - y)) - 0.2 * acos(0.5 * cos(y)) + k * (x * x + y * y),
    drive(x = -tanh(3 * rate(x)) / 10, y = -tanh(rate(y))), force(at = [x, y, 0], value = [0, atan(t) / pi, 0]),
)]
struct Smooth {
    k: f64,
}

#[test]
fn power_series() {
    let kernel = Smooth { k: 1.0 }.kernel().expect("a particle");
    let (q, z) = (SVector::from([0.3, -0.4]), SVector::from([1.0, 0.5]));
    let taylor = Simulation::new(&kernel).control(Taylor::new(1e-13, 1e-13)).run_to_end(q, z, 0.0..5.0).expect("a run");
    let steps = Simulation::new(&kernel).adaptive(1e-13, 1e-13).run_to_end(q, z, 0.0..5.0).expect("a run");
    assert!((taylor.q - steps.q).norm() < 1e-11 && (taylor.z - steps.z).norm() < 1e-11, "{:?}", taylor.q - steps.q);
}

/// Twice differentiated where a potential is: the second derivative is told by the clause.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x), particle(mass = 1, position = [x, 0, 0]), linearize,
    function(hill = hump, derivative = hump_slope, second = laws::curvature), potential = c * hill(x),
    table(spline, points = POINTS, kind = cubic), spring(along = spline(x), stiffness = 2),
)]
struct Hill {
    c: f64,
}

#[test]
fn potentials_of_own_functions() {
    let kernel = Hill { c: 3.0 }.kernel().expect("a particle");
    let spline = Cubic::through(&POINTS);
    for x in [-2.0, -0.3, 0.1, 0.7, 1.4, 3.0] {
        let (q, z) = (SVector::from([x]), SVector::from([0.0]));
        let (s, ds, dds) = (spline.value(x), spline.slope(x), spline.second(x));
        let energy = 3.0 * hump(x) + s * s;
        assert!((kernel.potential_energy(0.0, &q) - energy).abs() < CLOSE * (1.0 + energy));
        let force = -3.0 * hump_slope(x) - 2.0 * s * ds;
        assert!((kernel.acceleration(0.0, &q, &z, &())[0] - force).abs() < CLOSE * (1.0 + force.abs()), "{x}");
        let slope = -3.0 * laws::curvature(x) - 2.0 * (ds * ds + s * dds);
        let found = kernel.linearize(0.0, &q, &z, &()).by_state[(1, 0)];
        assert!((found - slope).abs() < CLOSE * (1.0 + slope.abs()), "{x}");
    }
    assert!(HillKernel::EQUATIONS.text.contains("hill'(x)"), "{}", HillKernel::EQUATIONS.text);
}

/// Turns by multiples of π/2 are exact.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a), body(arm, rotation = rotation_x(pi / 2) * rotation_z(a), mass = 1, inertia = [1, 2, 2.5]),
    force(at = [0, 0, 0] + arm.rotation * [l, 0, 0], value = [0, 0, cos(2 * pi) + sin(pi)]),
)]
struct Turned {
    l: f64,
}

#[test]
fn quarter_turns_of_pi_are_exact() {
    let kernel = Turned { l: 2.0 }.kernel().expect("a body");
    let q = SVector::from([0.3]);
    let found = kernel.acceleration(0.0, &q, &SVector::from([0.1]), &())[0];
    // The axis e₃ is −k₂: the weight of 1 at l (cos a, 0, sin a) has the moment l cos a.
    let wanted = 2.0 * 0.3_f64.cos() / 2.5;
    assert!((found - wanted).abs() <= 4.0 * f64::EPSILON * wanted, "{found} {wanted}");
    assert_eq!(TurnedKernel::OPERATIONS.acceleration.transcendentals, 2);
}
