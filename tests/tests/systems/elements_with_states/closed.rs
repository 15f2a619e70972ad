//! Runs against closed solutions.

use super::*;
use gauss_runtime::integrate::{Adams, Collocation, Fixed};

/// The exact state of a linear system after `t` under a constant input: of the matrix with the input beside it.
fn exact(t: f64, start: [f64; 4], command: f64) -> SVector<f64, 4> {
    let (a, b) = matrix(&Servo::ordinary());
    let mut whole = SMatrix::<f64, 5, 5>::zeros();
    whole.fixed_view_mut::<4, 4>(0, 0).copy_from(&a);
    whole.fixed_view_mut::<4, 1>(0, 4).copy_from(&b);
    let [x, force, seen, v] = start;
    let after = (whole * t).exp() * SVector::from([x, force, seen, v, command]);
    after.fixed_rows::<4>(0).into_owned()
}

const START: ([f64; 3], [f64; 1]) = ([0.1, -0.4, 0.2], [0.5]);

fn ends(q: &SVector<f64, 3>, z: &SVector<f64, 1>) -> SVector<f64, 4> {
    SVector::from([q[0], q[1], q[2], z[0]])
}

/// The tolerance of steps over 3 units of time, in which errors grow at most threefold (no eigenvalue is positive).
#[test]
fn an_oscillator_with_a_filter_is_a_matrix_exponential() {
    let kernel = Servo::ordinary().kernel().unwrap();
    let (q, z) = (SVector::from(START.0), SVector::from(START.1));
    let expected = exact(3.0, [q[0], q[1], q[2], z[0]], 2.0);
    let near = |what: &str, end: SVector<f64, 4>, allowed: f64| {
        let off = (end - expected).amax();
        assert!(off < allowed, "{what}: {off:e}");
    };
    let run = || Simulation::new(&kernel).input(|_, _: &_, _: &_| SVector::from([2.0]));
    let end = run().adaptive(1e-12, 1e-12).run_to_end(q, z, 0.0..3.0).unwrap();
    near("adaptive", ends(&end.q, &end.z), 1e-10);
    let end = run().momentum_form().adaptive(1e-12, 1e-12).run_to_end(q, z, 0.0..3.0).unwrap();
    near("momentum form", ends(&end.q, &end.z), 1e-10);
    // Methods of order 6 and 4 with steps of 1/20 of the shortest time: (1/20)⁶ and (1/20)⁴ of the state, which is of
    // order 1, with constants below 1/100.
    let end = run().control(Fixed::by(Collocation::order_6(), 0.0025)).run_to_end(q, z, 0.0..3.0).unwrap();
    near("collocation", ends(&end.q, &end.z), 1e-9);
    let end = run().control(Fixed::by(Rosenbrock, 0.0025)).run_to_end(q, z, 0.0..3.0).unwrap();
    near("Rosenbrock", ends(&end.q, &end.z), 1e-6);
    let end = run().control(Adams::<_, 10>::new(0.0025)).run_to_end(q, z, 0.0..3.0).unwrap();
    near("Adams", ends(&end.q, &end.z), 1e-8);
}

/// ẏ = (u − y)/τ, m v̇ = y.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    taylor,
    particle(mass = m, position = [x, 0, 0]),
    states(y = (u - y) / tau),
    force(at = [x, 0, 0], value = [y, 0, 0])
)]
struct Lag {
    m: f64,
    u: f64,
    tau: f64,
}

#[test]
fn a_lag_of_first_order_is_exact() {
    let (m, u, tau, t) = (2.0, 3.0, 0.4, 1.7);
    let kernel = Lag { m, u, tau }.kernel().unwrap();
    let state = LagState::default();
    let past = 1.0 - f64::exp(-t / tau);
    let y = u * past;
    let v = u / m * (t - tau * past);
    let x = u / m * (t * t / 2.0 - tau * t + tau * tau * past);
    // Rounding of a hundred steps of Taylor's method, and the tolerance of the other, of numbers below 4.
    for (allowed, run) in [
        (4e-14, Simulation::new(&kernel).taylor(1e-16, 1e-16).run_to_end(state.q(), state.z(), 0.0..t).unwrap()),
        (4e-11, Simulation::new(&kernel).adaptive(1e-12, 1e-12).run_to_end(state.q(), state.z(), 0.0..t).unwrap()),
    ] {
        let end = LagState::of(&run.q, &run.z);
        for (found, expected) in [(end.y, y), (end.x, x), (end.x_dot, v)] {
            assert!((found - expected).abs() < allowed, "{found} for {expected}");
        }
    }
}

/// A brake that warms up at constant speed, and its housing: heat is c v², an RC circuit of two nodes.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    speeds(v),
    kinematics(x = v),
    linearize(hessian),
    particle(mass = 1, position = [x, 0, 0]),
    states(pad = (c * v * v - (pad - housing) / r) / c1),
    states(housing = ((pad - housing) / r - housing / ra) / c2, way = abs(v))
)]
struct Brake {
    c: f64,
    r: f64,
    ra: f64,
    c1: f64,
    c2: f64,
}

#[test]
fn heat_flows_as_through_resistors_and_capacitors() {
    let Brake { c, r, ra, c1, c2 } = Brake { c: 0.3, r: 2.0, ra: 5.0, c1: 1.5, c2: 4.0 };
    let kernel = Brake { c, r, ra, c1, c2 }.kernel().unwrap();
    let start = BrakeState { pad: 1.0, v: -2.0, ..Default::default() };
    let t = 6.0;
    let end = Simulation::new(&kernel).adaptive(1e-12, 1e-12).run_to_end(start.q(), start.z(), 0.0..t).unwrap();
    let end = BrakeState::of(&end.q, &end.z);
    let whole = SMatrix::<f64, 3, 3>::from_row_slice(
        &[[-1.0 / (r * c1), 1.0 / (r * c1), c * 4.0 / c1], [1.0 / (r * c2), -(1.0 / r + 1.0 / ra) / c2, 0.0], [0.0; 3]]
            .concat(),
    );
    let expected = (whole * t).exp() * SVector::from([1.0, 0.0, 1.0]);
    // The tolerance, over times in which nothing grows.
    assert!((end.pad - expected[0]).abs() < 1e-10 && (end.housing - expected[1]).abs() < 1e-10, "{end:?} {expected}");
    assert!((end.way - 2.0 * t).abs() < 1e-11 && (end.x + 2.0 * t).abs() < 1e-11, "{end:?}");
    // ∂²(c v²/C₁)/∂v², the only curvature: of the second rate, by the last component of the state.
    let curved = kernel.hessian(0.0, &start.q(), &start.z(), &(), &SVector::from([0.5, 3.0, -1.0, 2.0, 7.0])).by_state;
    let mut expected = SMatrix::<f64, 5, 5>::zeros();
    expected[(4, 4)] = 3.0 * 2.0 * c / c1;
    assert!((curved - expected).amax() < 1e-15, "{curved}");
    assert_eq!(<BrakeKernel as GaussSystem>::SMOOTHNESS, Smoothness::Kinks, "abs(v) is in a rate");
    assert_eq!(<BrakeKernel as GaussSystem>::STATES, 3);
}
