//! Central gravity: against direct summation over mass points, the gravity-gradient torque, and Kepler's orbits.

use gauss_runtime::prelude::*;
use gauss_tests::laws::{Time, forced_laws, laws};
use gauss_tests::nonholonomic::precise;

/// A body about which all is known that second moments say, in the field of a centre.
#[derive(GaussDynamics)]
#[gauss(chart = left_invariant, central_gravity(planet, mu = mu, center = center))]
struct Satellite {
    #[gauss(mass)]
    mass: f64,
    #[gauss(center_of_mass)]
    c: Vector3<f64>,
    #[gauss(inertia)]
    inertia: Matrix3<f64>,
    mu: f64,
    center: Vector3<f64>,
}

/// Mass points: masses and places in body axes from O, within 1 of O.
const CLOUD: [(f64, [f64; 3]); 7] = [
    (1.0, [0.9, 0.1, -0.2]),
    (0.5, [-0.6, 0.5, 0.3]),
    (0.75, [0.1, -0.8, 0.4]),
    (1.25, [-0.2, 0.3, -0.9]),
    (0.25, [0.5, 0.6, 0.6]),
    (2.0, [0.1, 0.1, 0.2]),
    (0.5, [-0.7, -0.6, 0.1]),
];

const MU: f64 = 3.5;
const CENTER: [f64; 3] = [2.0, -1.0, 0.5];

fn points() -> impl Iterator<Item = (f64, Vector3<f64>)> {
    CLOUD.into_iter().map(|(m, x)| (m, Vector3::from(x)))
}

fn satellite() -> Satellite {
    let mass = points().map(|(m, _)| m).sum();
    let first: Vector3<f64> = points().map(|(m, x)| x * m).sum();
    let inertia = points().map(|(m, x)| (Matrix3::identity() * x.dot(&x) - x * x.transpose()) * m).sum();
    Satellite { mass, c: first / mass, inertia, mu: MU, center: CENTER.into() }
}

/// O at the distance `r` from the centre, in a direction that no axis prefers.
fn pose(r: f64) -> Isometry3<f64> {
    let rotation = UnitQuaternion::from_scaled_axis(Vector3::new(0.7, -1.1, 0.4));
    Isometry3::from_parts((Vector3::from(CENTER) + Vector3::new(2.0, 3.0, 6.0) / 7.0 * r).into(), rotation)
}

/// What direct summation gives: the energy, the force and the torque about O, in body axes.
fn direct(pose: &Isometry3<f64>) -> (f64, Vector3<f64>, Vector3<f64>) {
    let arm = pose.rotation.inverse() * (pose.translation.vector - Vector3::from(CENTER));
    points().fold((0.0, Vector3::zeros(), Vector3::zeros()), |(energy, force, torque), (m, x)| {
        let rho = arm + x;
        let pull = rho * (-MU * m / rho.norm().powi(3));
        (energy - MU * m / rho.norm(), force + pull, torque + x.cross(&pull))
    })
}

/// The errors of energy, force and torque at a distance.
fn errors(r: f64) -> [f64; 3] {
    let kernel = satellite().kernel().expect("a body");
    let (pose, rest) = (pose(r), SVector::from([0.0; 6]));
    let (energy, force, torque) = direct(&pose);
    let found = kernel.generalised_force("planet", 0.0, &pose, &rest, &()).expect("it acts");
    let force = Vector3::new(found[0], found[1], found[2]) - force;
    let torque = Vector3::new(found[3], found[4], found[5]) - torque;
    [(kernel.potential_energy(0.0, &pose) - energy).abs(), force.norm(), torque.norm()]
}

/// The energy of a point is −(μm/r) Σ qⁿ P_n(cos γ) with q = |x|/r; what is left out begins with n = 3. |P_n| ≤ 1, and
/// |dP_n/dγ| ≤ n by Bernstein's inequality, so that the terms of the energy, of the torque and of the force are at most
/// qⁿ, n qⁿ and √((n + 1)² + n²) qⁿ ≤ √2 (n + 1) qⁿ of μm/r, μm/r and μm/r²: geometric series.
fn bounds(r: f64) -> [f64; 3] {
    points().fold([0.0; 3], |[energy, force, torque], (m, x)| {
        let q = x.norm() / r;
        let (cube, rest) = (q.powi(3), 1.0 - q);
        [
            energy + MU * m / r * cube / rest,
            force + MU * m / (r * r) * 2.0_f64.sqrt() * cube * (4.0 - 3.0 * q) / (rest * rest),
            torque + MU * m / r * cube * (3.0 - 2.0 * q) / (rest * rest),
        ]
    })
}

#[test]
fn moments_replace_the_points_as_well_as_theory_says() {
    for r in [3.0, 10.0, 30.0, 100.0, 300.0] {
        // Sums of seven terms, each rounded some ten times, of energies, forces and torques that are at most this
        // large.
        let total = 6.25 * MU / r;
        let rounding = 100.0 * f64::EPSILON * total;
        let sizes = [rounding, rounding / r, rounding / r];
        for ((error, bound), rounding) in errors(r).into_iter().zip(bounds(r)).zip(sizes) {
            assert!(error <= bound + rounding, "r = {r}: {error:e}, bound {bound:e}");
        }
    }
}

/// The first term left out is the third: relative to weight, errors fall with the third power of the distance.
#[test]
fn errors_fall_with_the_third_power() {
    let (near, far) = (errors(40.0), errors(80.0));
    for ((near, far), power) in near.into_iter().zip(far).zip([4.0, 5.0, 4.0]) {
        // The next term is smaller by 1/40 to begin with, times a number of order one.
        let slope = (near / far).log2();
        assert!((slope - power).abs() < 0.1, "{slope} {power}");
    }
}

#[test]
fn the_gradient_turns_a_satellite_about_its_centre_of_mass() {
    let inertia = Matrix3::new(1.3, 0.1, -0.2, 0.1, 1.7, 0.05, -0.2, 0.05, 2.1);
    let body = Satellite { mass: 4.0, c: Vector3::zeros(), inertia, mu: MU, center: CENTER.into() };
    let kernel = body.kernel().expect("a body");
    for r in [2.0, 5.0, 20.0] {
        let (pose, rest) = (pose(r), SVector::from([0.0; 6]));
        let found = kernel.generalised_force("planet", 0.0, &pose, &rest, &()).expect("it acts");
        let up = pose.rotation.inverse() * (pose.translation.vector - Vector3::from(CENTER)) / r;
        let expected = up.cross(&(inertia * up)) * (3.0 * MU / r.powi(3));
        let error = (Vector3::new(found[3], found[4], found[5]) - expected).norm();
        // Products of a dozen factors in sums of nine terms, of the size of the moments.
        assert!(error <= 50.0 * f64::EPSILON * 3.0 * MU * 2.2 / r.powi(3), "r = {r}: {error:e}");
    }
}

/// A ball, and a mass point, in the field of the centre at Ω.
#[derive(GaussDynamics)]
#[gauss(chart = hybrid, central_gravity(mu = mu))]
struct Ball {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: f64,
    mu: f64,
}

#[derive(GaussDynamics)]
#[gauss(coordinates(x, y, z), particle(mass = m, position = [x, y, z]), central_gravity(mu = mu))]
struct Point {
    m: f64,
    mu: f64,
}

/// Half the major axis 1, the eccentricity of the test orbit, and μ = 1.
const ECCENTRICITY: f64 = 0.5;

/// Place and velocity in the plane of the orbit a time after the pericentre (Kepler's equation by Newton's method).
fn kepler(t: f64) -> [[f64; 2]; 2] {
    let e = ECCENTRICITY;
    let anomaly = (0..50).fold(t, |x, _| x - (x - e * x.sin() - t) / (1.0 - e * x.cos()));
    let (sine, cosine) = anomaly.sin_cos();
    let (minor, rate) = ((1.0 - e * e).sqrt(), 1.0 / (1.0 - e * cosine));
    [[cosine - e, minor * sine], [-sine * rate, minor * cosine * rate]]
}

#[test]
fn orbits_are_keplers() {
    // The plane of the orbit, inclined.
    let tilt = UnitQuaternion::from_scaled_axis(Vector3::new(0.4, 0.9, -0.3));
    let place = |[x, y]: [f64; 2]| tilt * Vector3::new(x, y, 0.0);
    let ([start, velocity], time) = (kepler(0.0), 9.0);
    let (start, velocity, end) = (place(start), place(velocity), kepler(time).map(place));
    // Errors of steps, 1e-12 each and a hundred of them, change the energy, and the phase by 3π times that a
    // revolution, which is another factor of ten in one and a half of them; near the pericentre speeds are twice what
    // they are in the mean.
    let allowed = 1e-8;

    let ball = Ball { mass: 3.0, inertia: 1.2, mu: 1.0 }.kernel().expect("a ball");
    let pose = Isometry3::from_parts(start.into(), UnitQuaternion::identity());
    let spin = Vector3::new(0.3, -0.2, 0.5);
    let z = SVector::from([velocity.x, velocity.y, velocity.z, spin.x, spin.y, spin.z]);
    let last = Simulation::new(&ball).control(precise()).run_to_end(pose, z, 0.0..time).expect("regular");
    assert!((last.q.translation.vector - end[0]).norm() < allowed, "{}", last.q.translation.vector - end[0]);
    assert!((Vector3::new(last.z[0], last.z[1], last.z[2]) - end[1]).norm() < allowed);
    // The field does not turn a ball.
    assert!((Vector3::new(last.z[3], last.z[4], last.z[5]) - spin).norm() < 1e-12);

    let point = Point { m: 3.0, mu: 1.0 }.kernel().expect("a point");
    let run = Simulation::new(&point).control(precise());
    let last = run.run_to_end(start, velocity, 0.0..time).expect("regular");
    assert!((last.q - end[0]).norm() < allowed && (last.z - end[1]).norm() < allowed, "{}", last.q - end[0]);
}

/// Two centres, one of them moving, and a body that hangs on another in their fields.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, z, alpha, beta),
    body(hub, position = [x, y, z], rotation = rotation_z(alpha)),
    body(arm, parent = hub, position = [l, 0, 0], rotation = rotation_y(beta)),
    particle(mass = m, parent = arm, position = [0, 0, l]),
    central_gravity(sun, mu = mu, center = [far, 0, 0]),
    central_gravity(moon, mu = 0.5 * mu, center = [0, far * cos(t), far * sin(t)]),
)]
struct Station {
    #[gauss(body)]
    hub: RigidBody<f64>,
    #[gauss(body)]
    arm: RigidBody<f64>,
    m: f64,
    l: f64,
    mu: f64,
    far: f64,
}

#[test]
fn two_centres_keep_the_laws() {
    let body = |mass: f64, x: f64| RigidBody {
        mass,
        center_of_mass: Vector3::new(x, 0.1, -0.05),
        inertia: Matrix3::new(1.3, 0.1, -0.2, 0.1, 1.7, 0.05, -0.2, 0.05, 2.1),
    };
    let station = Station { hub: body(2.0, 0.1), arm: body(1.0, -0.3), m: 0.7, l: 1.5, mu: 20.0, far: 9.0 };
    let kernel = station.kernel().expect("bodies");
    for t in [0.0, 0.6] {
        let (q, z) = (SVector::from([0.3, -0.7, 1.1, 0.4, 0.9]), SVector::from([0.5, 0.2, -0.6, 0.8, -1.1]));
        laws(&kernel, t, &q, &z, Time::Explicit);
        forced_laws(&kernel, t, (&q, &z), &());
    }
    let names: Vec<&str> = <StationKernel as ForcedSystem>::ELEMENTS.iter().map(|element| element.name).collect();
    assert_eq!(names, ["sun", "moon"]);
}

/// A craft of 11.8 kg in low orbit with a wheel of 0.2 kg hinged to it.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose, turn),
    speeds(v: Vector3, w: Vector3, s),
    kinematics(pose = twist(inverse(pose.rotation) * v, w), turn = s),
    body(bus, position = pose.position, rotation = pose.rotation),
    body(wheel, parent = bus, position = arm, rotation = rotation_x(turn)),
    central_gravity(mu = mu),
)]
struct Craft {
    #[gauss(body)]
    bus: RigidBody<f64>,
    #[gauss(body)]
    wheel: RigidBody<f64>,
    arm: Vector3<f64>,
    mu: f64,
}

/// Rounding of the attraction, 8 m/s², does not reach attitudes that turn by 1e-6 rad/s²: it would be noise that no
/// step is short enough for.
#[test]
fn steps_of_a_craft_in_orbit_are_as_long_as_its_motion_allows() {
    let bus = RigidBody {
        mass: 11.8,
        center_of_mass: Vector3::new(0.01, -0.02, 0.03),
        inertia: Matrix3::new(0.3, 0.01, -0.02, 0.01, 0.4, 0.015, -0.02, 0.015, 0.5),
    };
    let wheel = RigidBody {
        mass: 0.2,
        center_of_mass: Vector3::new(0.001, 0.002, 0.0015),
        inertia: Matrix3::from_diagonal(&Vector3::new(1e-3, 1.2e-3, 0.9e-3)),
    };
    let craft = Craft { bus, wheel, arm: Vector3::new(0.2, 0.1, -0.05), mu: 3.986004418e14 };
    let kernel = craft.kernel().expect("bodies");
    let rotation = UnitQuaternion::from_scaled_axis(Vector3::new(0.2, -0.6, 0.4));
    let q = (Isometry3::from_parts(Vector3::new(4.1e6, -3.3e6, 4.612e6).into(), rotation), SVector::from([0.7]));
    let z = SVector::from([5.2e3, 4.8e3, -2.1e3, 1e-3, -2e-3, 1.5e-3, 0.02]);
    // A radian of the fastest turn takes 50 s, of the orbit 930 s: a few steps each.
    let run = Simulation::new(&kernel).control(Adaptive::new(1e-13, 1e-13)).max_steps(600);
    let end = run.run_to_end(q, z, 0.0..600.0).expect("few steps");
    assert!((kernel.energy(600.0, &end.q, &end.z) / kernel.energy(0.0, &q, &z) - 1.0).abs() < 1e-13);
}
