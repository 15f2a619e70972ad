//! Systems in coordinates of their own: reference solutions, textbook equations, two choices of coordinates for one
//! system, and what holds for every system (residual, momenta, energy).

#[macro_use]
#[path = "../common/mod.rs"]
mod common;

mod arm;
mod armature;
mod balance;
mod elements;
mod elements_with_states;
mod flexible;
mod frames;
mod joint_friction;
mod locks;
mod own_coordinates;
mod parameters_of_systems;
mod sensors;
mod systems_in_other_scalars;
mod whole;

use gauss_runtime::prelude::*;
use gauss_tests::laws::{System, Time, balance, forced_laws, laws, least};
use gauss_tests::trajectory::{Run, Seen, numbers, reference};

#[derive(GaussDynamics)]
#[gauss(
    coordinates(theta, phi),
    particle(mass = m, position = [l * sin(theta) * cos(phi), l * sin(theta) * sin(phi), -l * cos(theta)])
)]
struct SphericalPendulum {
    m: f64,
    l: f64,
    #[gauss(gravity)]
    g: f64,
}

#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b),
    particle(mass = m1, position = [l1 * sin(a), 0, -l1 * cos(a)]),
    particle(mass = m2, position = [l1 * sin(a) + l2 * sin(b), 0, -l1 * cos(a) - l2 * cos(b)])
)]
struct DoublePendulum {
    m1: f64,
    m2: f64,
    l1: f64,
    l2: f64,
    #[gauss(gravity)]
    g: f64,
}

/// The second angle from the first arm: bodies one on the other.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, c),
    body(lower, parent = upper, position = [0, 0, -l1], rotation = rotation_y(-c)),
    body(upper, rotation = rotation_y(-a))
)]
struct Arms {
    #[gauss(body)]
    upper: RigidBody<f64>,
    #[gauss(body)]
    lower: RigidBody<f64>,
    l1: f64,
    #[gauss(gravity)]
    g: f64,
}

/// The same arms with both angles from the vertical, each body placed from Ω.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b),
    body(upper, rotation = rotation_y(-a)),
    body(lower, position = [l1 * sin(a), 0, -l1 * cos(a)], rotation = rotation_y(-b))
)]
struct ArmsFromVertical {
    #[gauss(body)]
    upper: RigidBody<f64>,
    #[gauss(body)]
    lower: RigidBody<f64>,
    l1: f64,
    #[gauss(gravity)]
    g: f64,
}

#[derive(GaussDynamics)]
#[gauss(
    coordinates(theta),
    particle(mass = 1, position = [
        a * sin(theta) * cos(spin * t), a * sin(theta) * sin(spin * t), -a * cos(theta)
    ])
)]
struct BeadOnHoop {
    a: f64,
    spin: f64,
    #[gauss(gravity)]
    g: f64,
}

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, theta),
    speeds(v, omega),
    kinematics(x = v * cos(theta), y = v * sin(theta), theta = omega),
    body(position = [x, y, 0], rotation = rotation_z(theta))
)]
struct ChaplyginSleigh {
    #[gauss(mass)]
    m: f64,
    #[gauss(center_of_mass)]
    a: Vector3<f64>,
    #[gauss(inertia)]
    j: Vector3<f64>,
}

/// ω₃ = 0: the Euler angles follow two components of the angular velocity.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(phi, theta, psi),
    speeds(w1, w2),
    kinematics(
        phi = (w1 * sin(psi) + w2 * cos(psi)) / sin(theta),
        theta = w1 * cos(psi) - w2 * sin(psi),
        psi = -(w1 * sin(psi) + w2 * cos(psi)) / tan(theta),
    ),
    body(rotation = rotation_z(phi) * rotation_x(theta) * rotation_z(psi))
)]
struct Suslov {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    j: Matrix3<f64>,
}

#[derive(GaussDynamics)]
#[gauss(
    coordinates(phi, theta, psi),
    body(rotation = rotation_z(phi) * rotation_x(theta) * rotation_z(psi))
)]
struct TopInCoordinates {
    #[gauss(mass)]
    m: f64,
    #[gauss(center_of_mass)]
    c: Vector3<f64>,
    #[gauss(inertia)]
    i: Vector3<f64>,
    #[gauss(gravity)]
    g: f64,
}

#[derive(GaussDynamics)]
#[gauss(motion = fixed_point, chart = jet(euler_zxz))]
struct Top {
    #[gauss(mass)]
    m: f64,
    #[gauss(center_of_mass)]
    c: Vector3<f64>,
    #[gauss(inertia)]
    i: Vector3<f64>,
    #[gauss(gravity)]
    g: f64,
}

/// Every function of the language, in a position and in a potential.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(s),
    particle(mass = m, position = [ln(2 + s.powi(2)), sqrt(1 + s * s), 0.5 * exp(-s)]),
    potential = k * (tan(0.3 * s) + exp(0.2 * s) / sqrt(2 + sin(s)) - ln(3 + cos(s)))
)]
struct Wire {
    m: f64,
    k: f64,
}

fn arm(mass: f64, length: f64) -> RigidBody<f64> {
    // A rod along −e₃ with some thickness, about its upper end.
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.4, 0.41, 0.05)) * (mass * length * length);
    RigidBody { mass, center_of_mass: Vector3::new(0.0, 0.0, -0.5 * length), inertia }
}

fn double_pendulum() -> DoublePendulum {
    DoublePendulum { m1: 1.0, m2: 0.7, l1: 1.0, l2: 0.6, g: 9.81 }
}

fn sleigh() -> ChaplyginSleigh {
    // I_O = I_G + m a² about the two axes across; what is about e₁ and e₂ does not enter the motion.
    let steiner = 1.2 * 0.3 * 0.3;
    let j = Vector3::new(0.4, 0.4 + steiner, 0.5 + steiner);
    ChaplyginSleigh { m: 1.2, a: Vector3::new(0.3, 0.0, 0.0), j }
}

fn suslov() -> Suslov {
    Suslov { m: 1.0, j: Matrix3::new(1.0, 0.0, 0.3, 0.0, 1.5, -0.2, 0.3, -0.2, 2.0) }
}

fn reproduces<S, const N: usize, const D: usize>(
    name: &str,
    system: &S,
    q: [f64; N],
    z: [f64; D],
    observe: impl Fn(f64, &SVector<f64, N>, &SVector<f64, D>) -> Seen,
) where
    S: GaussSystem<Scalar = f64, Configuration = SVector<f64, N>, Speeds = SVector<f64, D>, Input = ()>,
{
    Run { name, system, start: (SVector::from(q), SVector::from(z)) }.agrees(1.0, observe);
}

#[test]
fn spherical_pendulum_as_in_the_reference() {
    let (l, g) = (1.3, 9.81);
    let kernel = SphericalPendulum { m: 1.0, l, g }.kernel().unwrap();
    // x = (0.78, 0, −1.04), v = (0.8, 1.1, 0.6): sin θ = 0.6, and v·e_θ = 1.
    reproduces("spherical_pendulum", &kernel, [0.6_f64.atan2(0.8), 0.0], [1.0 / l, 1.1 / 0.78], |_, q, z| {
        let ((s, c), (sp, cp)) = (q[0].sin_cos(), q[1].sin_cos());
        let (out, up, around) = (l * c * z[0], l * s * z[0], l * s * z[1]);
        vec![
            ("x", vec![l * s * cp, l * s * sp, -l * c]),
            ("v", vec![out * cp - around * sp, out * sp + around * cp, up]),
        ]
    });
}

#[test]
fn double_pendulum_as_in_the_reference() {
    let kernel = double_pendulum().kernel().unwrap();
    reproduces("double_pendulum", &kernel, [2.0, -1.0], [0.5, 1.0], |_, q, z| {
        let ((s1, c1), (s2, c2)) = (q[0].sin_cos(), q[1].sin_cos());
        let (x1, v1) = ([s1, -c1], [c1 * z[0], s1 * z[0]]);
        let x2 = vec![x1[0] + 0.6 * s2, x1[1] - 0.6 * c2];
        let v2 = vec![v1[0] + 0.6 * c2 * z[1], v1[1] + 0.6 * s2 * z[1]];
        vec![("x1", x1.to_vec()), ("x2", x2), ("v1", v1.to_vec()), ("v2", v2)]
    });
}

#[test]
fn bead_on_a_rotating_hoop_as_in_the_reference() {
    let (a, spin) = (0.8, 5.0);
    let kernel = BeadOnHoop { a, spin, g: 9.81 }.kernel().unwrap();
    reproduces("bead_rotating_hoop", &kernel, [0.3], [0.4], |t, q, z| {
        let ((s, c), (sp, cp)) = (q[0].sin_cos(), (spin * t).sin_cos());
        let (out, around) = (a * c * z[0], a * s * spin);
        vec![
            ("x", vec![a * s * cp, a * s * sp, -a * c]),
            ("v", vec![out * cp - around * sp, out * sp + around * cp, a * s * z[0]]),
        ]
    });
}

#[test]
fn chaplygin_sleigh_as_in_the_reference() {
    let kernel = sleigh().kernel().unwrap();
    reproduces("chaplygin_sleigh", &kernel, [0.0, 0.0, 0.25], [0.4, 1.5], |_, q, z| {
        let (s, c) = q[2].sin_cos();
        vec![
            ("R", vec![c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0]),
            ("b", vec![q[0], q[1], 0.0]),
            ("body_u", vec![z[0], 0.0, 0.0]),
            ("body_omega", vec![0.0, 0.0, z[1]]),
        ]
    });
}

#[test]
fn suslov_as_in_the_reference() {
    let r = numbers(&reference("suslov")["initial"]["R"]);
    let angles = [r[2].atan2(-r[5]), r[8].acos(), r[6].atan2(r[7])];
    reproduces("suslov", &suslov().kernel().unwrap(), angles, [1.2, -0.5], |_, q, z| {
        let axes = [Vector3::z_axis(), Vector3::x_axis(), Vector3::z_axis()];
        let turns: Vec<_> = (0..3).map(|k| UnitQuaternion::from_axis_angle(&axes[k], q[k])).collect();
        let rotation = (turns[0] * turns[1] * turns[2]).to_rotation_matrix().into_inner();
        let rows = rotation.transpose().iter().copied().collect();
        vec![("R", rows), ("body_omega", vec![z[0], z[1], 0.0])]
    });
}

#[test]
fn sleigh_has_the_textbook_equations() {
    // v̇ = a ω², (I_G + m a²) ω̇ = −m a v ω.
    let kernel = sleigh().kernel().unwrap();
    let (v, omega) = (0.7, -1.3);
    let found = kernel.acceleration(0.0, &SVector::from([3.0, -2.0, 0.9]), &SVector::from([v, omega]), &());
    let expected = [0.3 * omega * omega, -1.2 * 0.3 * v * omega / (0.5 + 1.2 * 0.09)];
    // A few products each.
    assert!((0..2).all(|k| (found[k] - expected[k]).abs() < 16.0 * f64::EPSILON), "{found} {expected:?}");
    // The mass matrix is constant, so it is hoisted and nothing is left of the configuration.
    assert_eq!(ChaplyginSleighKernel::OPERATIONS.acceleration.transcendentals, 0);
}

#[test]
fn top_in_coordinates_is_the_top_of_the_jet_chart() {
    let (m, c, i, g) = (1.3, Vector3::new(0.1, -0.2, 0.4), Vector3::new(0.9, 1.1, 1.4), 9.81);
    let system = TopInCoordinates { m, c, i, g }.kernel().unwrap();
    let top = Top { m, c, i, g }.kernel().unwrap();
    for (q, z) in [([0.3, 1.1, -0.7], [0.5, -1.2, 2.0]), ([-2.0, 2.2, 3.0], [-1.5, 0.4, -0.3])] {
        let (q, z) = (SVector::from(q), SVector::from(z));
        let p = top.momentum(0.0, &q, &z);
        let pairs = [
            (system.acceleration(0.0, &q, &z, &()), top.acceleration(0.0, &q, &z, &())),
            (system.momentum(0.0, &q, &z), p),
            (system.velocity(0.0, &q, &p), top.velocity(0.0, &q, &p)),
            (system.momentum_rate(0.0, &q, &p, &()), top.momentum_rate(0.0, &q, &p, &())),
            (system.gauss_residual(0.0, &q, &z, &p, &()), top.gauss_residual(0.0, &q, &z, &p, &())),
        ];
        for (found, expected) in pairs {
            // Some hundred roundings of terms up to ten times the result, divided by sin θ twice.
            let allowed = 1000.0 * f64::EPSILON * expected.amax().max(1.0);
            assert!((found - expected).amax() <= allowed, "{found} {expected}");
        }
        let energies = [system.energy(0.0, &q, &z) - top.energy(0.0, &q, &z)];
        assert!(energies[0].abs() <= 100.0 * f64::EPSILON * top.energy(0.0, &q, &z).abs().max(10.0));
        let difference = system.mass_matrix(0.0, &q) - top.mass_matrix(0.0, &q);
        assert!(difference.amax() <= 32.0 * f64::EPSILON);
    }
}

#[test]
fn two_choices_of_coordinates_give_one_motion() {
    let (upper, lower, l1, g) = (arm(1.5, 0.9), arm(0.8, 0.6), 0.9, 9.81);
    let chain = Arms { upper, lower, l1, g }.kernel().unwrap();
    let apart = ArmsFromVertical { upper, lower, l1, g }.kernel().unwrap();
    for [a, b, va, vb] in [[0.4, 1.3, 0.7, -1.1], [2.5, -0.8, -2.0, 3.0], [0.0, 0.0, 1.0, 1.0]] {
        let (q, z) = (SVector::from([a, b]), SVector::from([va, vb]));
        let (relative, relative_z) = (SVector::from([a, b - a]), SVector::from([va, vb - va]));
        let found = chain.acceleration(0.0, &relative, &relative_z, &());
        let expected = apart.acceleration(0.0, &q, &z, &());
        // A few hundred roundings; the mass matrix is far from singular (condition below a hundred).
        let allowed = 1e4 * f64::EPSILON * expected.amax().max(1.0);
        assert!((found[0] - expected[0]).abs() <= allowed, "{found} {expected}");
        assert!((found[1] - (expected[1] - expected[0])).abs() <= allowed, "{found} {expected}");
        let energies = (chain.energy(0.0, &relative, &relative_z), apart.energy(0.0, &q, &z));
        assert!((energies.0 - energies.1).abs() <= 64.0 * f64::EPSILON * energies.1.abs().max(10.0));
    }
}

fn holds<S, const N: usize, const D: usize>(system: &S, q: [f64; N], z: [f64; D], time: Time)
where
    S: System<Configuration = SVector<f64, N>, Speeds = SVector<f64, D>>,
{
    let (t, q, z) = (0.6, SVector::from(q), SVector::from(z));
    laws(system, t, &q, &z, time);
    least(system, t, &q, &z);
}

#[test]
fn laws_of_every_system() {
    holds(&SphericalPendulum { m: 0.7, l: 1.3, g: 9.81 }.kernel().unwrap(), [0.8, 0.3], [0.5, -1.2], Time::Absent);
    holds(&double_pendulum().kernel().unwrap(), [2.0, -1.0], [0.5, 1.0], Time::Absent);
    let (upper, lower, l1, g) = (arm(1.5, 0.9), arm(0.8, 0.6), 0.9, 9.81);
    holds(&Arms { upper, lower, l1, g }.kernel().unwrap(), [0.4, 1.3], [0.7, -1.1], Time::Absent);
    let bead = BeadOnHoop { a: 0.8, spin: 5.0, g: 9.81 }.kernel().unwrap();
    holds(&bead, [0.3], [0.4], Time::Hidden);
    balance(&bead, 0.6, (&SVector::from([0.3]), &SVector::from([0.4])), &());
    holds(&sleigh().kernel().unwrap(), [1.0, 2.0, 0.4], [0.6, -1.5], Time::Absent);
    holds(&suslov().kernel().unwrap(), [0.2, 1.1, -0.6], [1.2, -0.5], Time::Absent);
    let wire = Wire { m: 1.4, k: 2.0 }.kernel().unwrap();
    holds(&wire, [0.7], [1.3], Time::Absent);
    forced_laws(&wire, 0.6, (&SVector::from([0.7]), &SVector::from([1.3])), &());
}

#[test]
fn parameters_of_systems_are_checked_by_name() {
    let mut arms = Arms { upper: arm(1.5, 0.9), lower: arm(0.8, 0.6), l1: 0.9, g: 9.81 };
    arms.lower.mass = -1.0;
    arms.l1 = f64::NAN;
    let report = arms.kernel().unwrap_err().to_string();
    assert!(report.contains("lower.mass") && report.contains("l1"), "{report}");
    let report = DoublePendulum { m2: 0.0, ..double_pendulum() }.kernel().unwrap_err().to_string();
    assert!(report.contains("m2") && !report.contains("m1"), "{report}");
}
