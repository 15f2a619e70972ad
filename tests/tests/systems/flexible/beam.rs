//! Uniform beams whose modes are known in closed form: frequencies of a free spacecraft with two of them, of a beam in
//! steady spin, and what is conserved.

use gauss_runtime::nalgebra::{DMatrix, SymmetricEigen};
use gauss_runtime::prelude::*;
use gauss_tests::laws::list;

const LENGTH: f64 = 10.0;
const DENSITY: f64 = 1.2;
const STIFFNESS: f64 = 14_000.0;

/// A box of 2 m with a beam on either side; the beams deflect along e₃.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(craft: Pose, a1, a2, a3, a4, b1, b2, b3, b4),
    body(hub, pose = craft, mass = m, inertia = [j, j, j]),
    body(left, parent = hub, position = [1, 0, 0]),
    body(right, parent = hub, position = [-1, 0, 0], rotation = rotation_z(pi)),
    modes(left, coordinates = [a1, a2, a3, a4], file = "flexible/flap.json"),
    modes(right, coordinates = [b1, b2, b3, b4], file = "flexible/flap.json"),
    linearize,
)]
struct Spacecraft {
    m: f64,
    j: f64,
}

/// ω² of M ẍ + K x = 0, ascending.
fn squares(mass: &DMatrix<f64>, stiffness: &DMatrix<f64>) -> Vec<f64> {
    let lower = mass.clone().cholesky().unwrap().l();
    let inverse = lower.try_inverse().unwrap();
    let mut values: Vec<f64> =
        SymmetricEigen::new(&inverse * stiffness * inverse.transpose()).eigenvalues.iter().copied().collect();
    values.sort_by(f64::total_cmp);
    values
}

/// The amplitudes of cos βx, sin βx, cosh βx, sinh βx of a beam with the given deflection and slope at its root and a
/// free tip.
fn shape(beta: f64, deflection: f64, slope: f64) -> [f64; 4] {
    let (s, c) = (beta * LENGTH).sin_cos();
    let (sh, ch) = ((beta * LENGTH).sinh(), (beta * LENGTH).cosh());
    // With C = y − A and D = θ/β − B, of w″(L) = 0 and w‴(L) = 0.
    let turn = slope / beta;
    let (k11, k12, r1) = (-c - ch, -s - sh, -deflection * ch - turn * sh);
    let (k21, k22, r2) = (s - sh, -c - ch, -deflection * sh - turn * ch);
    let determinant = k11 * k22 - k12 * k21;
    let (a, b) = ((r1 * k22 - k12 * r2) / determinant, (k11 * r2 - r1 * k21) / determinant);
    [a, b, deflection - a, turn - b]
}

/// ∫w dx and ∫x w dx.
fn moments(beta: f64, [a, b, c, d]: [f64; 4]) -> [f64; 2] {
    let (l, (s, co)) = (LENGTH, (beta * LENGTH).sin_cos());
    let (sh, ch) = ((beta * LENGTH).sinh(), (beta * LENGTH).cosh());
    let zeroth = (a * s + b * (1.0 - co) + c * sh + d * (ch - 1.0)) / beta;
    let waves = a * (l * s / beta + (co - 1.0) / beta.powi(2)) + b * (s / beta.powi(2) - l * co / beta);
    let rest = c * (l * sh / beta - (ch - 1.0) / beta.powi(2)) + d * (l * ch / beta - sh / beta.powi(2));
    [zeroth, waves + rest]
}

/// The first roots in β of what is left of the momentum of the whole.
fn roots(residual: impl Fn(f64) -> f64, count: usize) -> Vec<f64> {
    let (mut found, mut beta, step) = (Vec::new(), 0.05, 1e-3);
    while found.len() < count {
        let (mut low, mut high) = (beta, beta + step);
        // Not at poles, where the determinant vanishes.
        if residual(low) * residual(high) < 0.0 && residual(low).abs() < 1e3 && residual(high).abs() < 1e3 {
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if residual(low) * residual(middle) <= 0.0 { high = middle } else { low = middle }
            }
            found.push(0.5 * (low + high));
        }
        beta += step;
    }
    found
}

/// Against the exact equation of beams on a rigid hub: hub and beams together have neither momentum nor angular
/// momentum. Modes left out follow the hub rigidly: Rayleigh's quotient is too large, by (ω/ω₅)² of it at most.
#[test]
fn a_free_spacecraft_has_the_frequencies_of_its_beams() {
    let (m, j, r) = (40.0, 60.0, 1.0);
    let kernel = Spacecraft { m, j }.kernel().unwrap();
    let rest = SpacecraftState::default();
    let (q, z) = (rest.q(), rest.z());
    let n = 14;
    let matrix = kernel.mass_matrix(0.0, &q);
    let mass = DMatrix::from_fn(n, n, |i, k| matrix[(i, k)]);
    let by_state = kernel.linearize(0.0, &q, &z, &()).by_state;
    let stiffness = -&mass * DMatrix::from_fn(n, n, |i, k| by_state[(n + i, k)]);
    assert!((&stiffness - stiffness.transpose()).norm() < 1e-9 * stiffness.norm());
    let frequencies: Vec<f64> = squares(&mass, &stiffness).into_iter().skip(6).map(f64::sqrt).collect();
    let wave = (STIFFNESS / DENSITY).sqrt();
    let together = |beta: f64| m + 2.0 * DENSITY * moments(beta, shape(beta, 1.0, 0.0))[0];
    let against = |beta: f64| {
        let [zeroth, first] = moments(beta, shape(beta, r, 1.0));
        j + 2.0 * DENSITY * (r * zeroth + first)
    };
    let mut exact: Vec<f64> =
        roots(together, 2).into_iter().chain(roots(against, 2)).map(|beta| beta * beta * wave).collect();
    exact.sort_by(f64::total_cmp);
    let fifth = (4.5 * std::f64::consts::PI / LENGTH).powi(2) * wave;
    for (ours, exact) in frequencies.iter().zip(&exact) {
        let excess = ours / exact - 1.0;
        assert!((-1e-9..(exact / fifth).powi(2)).contains(&excess), "{ours} {exact} {excess:e}");
    }
}

/// Without damping energy, momentum and angular momentum stay, whatever the beams do.
#[test]
fn what_no_force_acts_on_keeps_its_momenta() {
    let kernel = Spacecraft { m: 40.0, j: 60.0 }.kernel().unwrap();
    let start =
        SpacecraftState { a1: 0.3, a2: -0.1, b1: 0.2, craft_omega: Vector3::new(0.3, 0.4, 0.5), ..Default::default() };
    let momenta = |q: &(Isometry3<f64>, SVector<f64, 8>), z: &SVector<f64, 14>| {
        let p = list(&kernel.momentum(0.0, q, z));
        let linear = q.0.rotation * Vector3::new(p[0], p[1], p[2]);
        let angular = q.0.rotation * Vector3::new(p[3], p[4], p[5]) + q.0.translation.vector.cross(&linear);
        let energy = kernel.kinetic_energy(0.0, q, z) + kernel.potential_energy(0.0, q);
        [linear.as_slice(), angular.as_slice(), &[energy]].concat()
    };
    let (q, z) = (start.q(), start.z());
    let run = Simulation::new(&kernel).adaptive(1e-12, 1e-13).run(q, z, 0.0..20.0).unwrap();
    let last = run.last();
    assert!((last.q.1 - q.1).norm() > 0.1);
    // Some hundred steps, each off by the tolerance of the largest component.
    let size = momenta(&q, &z).iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    for (before, after) in momenta(&q, &z).iter().zip(momenta(&last.q, &last.z)) {
        assert!((before - after).abs() < 1e-9 * size, "{before} {after}");
    }
}

/// A beam in steady spin, deflecting along the axis of the spin.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a1, a2, a3, a4),
    body(beam, rotation = rotation_z(w * t)),
    modes(beam, coordinates = [a1, a2, a3, a4], file = "flexible/flap.json"),
    linearize,
)]
struct Rotor {
    w: f64,
}

/// A beam in steady spin, deflecting in its plane, and stretching.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(s, a1, a2, a3),
    body(beam, rotation = rotation_z(w * t)),
    modes(beam, coordinates = [s, a1, a2, a3], file = "flexible/spin_up.json"),
    linearize,
)]
struct Swinging {
    w: f64,
}

/// Spin stiffens: frequencies of a uniform cantilever that turns about its root, in units of √(EI/ρAL⁴), at rates of
/// spin in the same unit (A. D. Wright, C. E. Smith, R. W. Thresher, J. L. C. Wang 1982, "Vibration modes of
/// centrifugally stiffened beams", table 1; `tests/references/beams.py spin` finds the same numbers, and more of their
/// digits).
const FLAPPING: [(f64, [f64; 2]); 4] = [
    (0.0, [3.516_015_268_500_15, 22.034_491_564_666_77]),
    (2.0, [4.137_319_573_025_36, 22.614_921_956_504_05]),
    (4.0, [5.585_001_420_884_82, 24.273_349_394_448_7]),
    (6.0, [7.360_373_019_310_02, 26.809_081_678_497_93]),
];

/// Rayleigh–Ritz is from above. What modes left out would take of λ is γ⁴B²/(2λ²λ₅²) of it, by perturbation, with λ₅ =
/// 199.86 and coefficients B of the tension of order one: 3e-4 at γ = 6, where it is largest.
#[test]
fn spin_stiffens_a_beam_as_published() {
    let unit = (STIFFNESS / (DENSITY * LENGTH.powi(4))).sqrt();
    for (rate, published) in FLAPPING {
        let kernel = Rotor { w: rate * unit }.kernel().unwrap();
        let rest = SVector::<f64, 4>::zeros();
        let by_state = kernel.linearize(0.0, &rest, &rest, &()).by_state;
        let stiffness = DMatrix::from_fn(4, 4, |i, k| -by_state[(4 + i, k)]);
        let found = squares(&DMatrix::identity(4, 4), &stiffness);
        for (square, published) in found.iter().zip(published) {
            let excess = square.sqrt() / unit / published - 1.0;
            assert!((-1e-9..3e-4).contains(&excess), "{rate}: {} {published} {excess:e}", square.sqrt() / unit);
        }
        // In the plane of the spin the same tension acts, and the centrifugal force along the deflection: ω² less. As
        // the beam stretches, by (ωL)²ρA/EA of its length at most, which is 2e-4, the two are coupled; and there are
        // three modes: the fourth, λ₄ = 120.9, takes 2.4e-3 of λ by the same measure.
        let kernel = Swinging { w: rate * unit }.kernel().unwrap();
        let by_state = kernel.linearize(0.0, &rest, &rest, &()).by_state;
        let values = DMatrix::from_fn(8, 8, |i, k| by_state[(i, k)]).complex_eigenvalues();
        let first = values.iter().map(|value| value.im.abs()).fold(f64::INFINITY, f64::min);
        let excess = first / unit / (published[0].powi(2) - rate.powi(2)).sqrt() - 1.0;
        assert!(excess.abs() < 2.6e-3, "{rate}: {first} {excess:e}");
    }
}

/// The hub with hybrid coordinates, δ₀, δ₁, C and K alone.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(craft: Pose, a, b),
    body(hub, pose = craft, mass = 40, inertia = [60, 70, 80]),
    modes(hub, coordinates = [a, b],
        translation = [[d0.x, d0.y, d0.z], [0, 1, 2]], rotation = [[d1.x, d1.y, d1.z], [3, 0, -1]],
        damping = [0.2, c], stiffness = [k, 9]),
)]
struct Hybrid {
    d0: Vector3<f64>,
    d1: Vector3<f64>,
    c: f64,
    k: f64,
}

/// The equations as they are written for spacecraft (P. W. Likins 1970; S. Di Gennaro 2003): dQ/dt = 0 of the
/// momentum, dΓ/dt + u × Q = 0 of the angular momentum, with Q = mu + ω × δ₀η + δ₀η̇ and Γ = Jω + δ₀η × u + δ₁η̇, and
/// η̈ + Cη̇ + Kη + δ₀ᵀa + δ₁ᵀω̇ = 0 with the acceleration a of O; derivatives are the observer's. The centre of mass
/// moves with the modes, the inertia does not.
#[test]
fn participations_alone_are_the_model_of_hybrid_coordinates() {
    let (d0, d1, c, k) = (Vector3::new(1.0, -2.0, 0.5), Vector3::new(2.0, 0.3, -4.0), 0.4, 5.0);
    let kernel = Hybrid { d0, d1, c, k }.kernel().unwrap();
    let (e0, e1) = (Vector3::new(0.0, 1.0, 2.0), Vector3::new(3.0, 0.0, -1.0));
    let state = HybridState {
        a: 0.3,
        b: -0.7,
        craft_u: Vector3::new(0.4, -0.5, 0.6),
        craft_omega: Vector3::new(1.3, 0.7, -0.9),
        a_dot: 0.8,
        b_dot: -1.1,
        ..Default::default()
    };
    let (q, z) = (state.q(), state.z());
    let rates = kernel.acceleration(0.0, &q, &z, &());
    let (u, w) = (state.craft_u, state.craft_omega);
    let (du, dw) = (Vector3::new(rates[0], rates[1], rates[2]), Vector3::new(rates[3], rates[4], rates[5]));
    let (dda, ddb) = (rates[6], rates[7]);
    let (flow, flow_rate) = (d0 * state.a_dot + e0 * state.b_dot, d0 * dda + e0 * ddb);
    let (turn, turn_rate) = (d1 * state.a_dot + e1 * state.b_dot, d1 * dda + e1 * ddb);
    let inertia = Vector3::new(60.0, 70.0, 80.0);
    let shift = d0 * state.a + e0 * state.b;
    let momentum = 40.0 * u + w.cross(&shift) + flow;
    let force = 40.0 * du + dw.cross(&shift) + w.cross(&flow) + flow_rate + w.cross(&momentum);
    let spin = inertia.component_mul(&w) + shift.cross(&u) + turn;
    let spin_rate = inertia.component_mul(&dw) + flow.cross(&u) + shift.cross(&du) + turn_rate;
    let torque = spin_rate + w.cross(&spin) + u.cross(&momentum);
    let a = du + w.cross(&u);
    let first = dda + 0.2 * state.a_dot + k * state.a + d0.dot(&a) + d1.dot(&dw);
    let second = ddb + c * state.b_dot + 9.0 * state.b + e0.dot(&a) + e1.dot(&dw);
    // Terms of some hundreds, each rounded a few times.
    for residual in force.iter().chain(torque.iter()).chain([&first, &second]) {
        assert!(residual.abs() < 1e-12, "{residual:e}");
    }
}
