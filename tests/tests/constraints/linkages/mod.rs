//! Bodies in gimbals and in a closed loop: a gyroscope and a four-bar linkage, with coordinates that solve the joints
//! and with constraints that make them.

mod redundant;
mod rows;
mod units;

use gauss_runtime::monitor::EnergyMonitor;
use gauss_runtime::nalgebra::Unit;
use gauss_runtime::prelude::*;
use gauss_tests::laws::{Time, constrained_laws, corresponds, laws, least, position_rates};
use gauss_tests::trajectory::{Run, number, reference, rows, triple};
use proptest::prelude::*;

/// Two gimbals and a rotor, each in the one before.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(phi, theta, psi),
    body(outer, rotation = rotation_z(phi)),
    body(inner, parent = outer, rotation = rotation_x(theta)),
    body(rotor, parent = inner, rotation = rotation_z(psi))
)]
struct Gyroscope {
    #[gauss(body)]
    outer: RigidBody<f64>,
    #[gauss(body)]
    inner: RigidBody<f64>,
    #[gauss(body)]
    rotor: RigidBody<f64>,
    #[gauss(gravity)]
    g: f64,
}

/// Every body placed from Ω, and the spin of the rotor about its own axis as a speed: it is conserved.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(phi, theta, psi),
    speeds(v, w, spin),
    kinematics(phi = v, theta = w, psi = spin - v * cos(theta)),
    body(rotor, rotation = rotation_z(phi) * rotation_x(theta) * rotation_z(psi)),
    body(inner, rotation = rotation_z(phi) * rotation_x(theta)),
    body(outer, rotation = rotation_z(phi))
)]
struct GyroscopeBySpin {
    #[gauss(body)]
    outer: RigidBody<f64>,
    #[gauss(body)]
    inner: RigidBody<f64>,
    #[gauss(body)]
    rotor: RigidBody<f64>,
    #[gauss(gravity)]
    g: f64,
}

/// The rotor by its rotation, its axle by two constraints.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(phi, theta, attitude: Rotation),
    body(outer, rotation = rotation_z(phi)),
    body(inner, parent = outer, rotation = rotation_x(theta)),
    body(rotor, rotation = attitude),
    constraint(position = dot(inner.rotation * [1, 0, 0], attitude * [0, 0, 1])),
    constraint(position = dot(inner.rotation * [0, 1, 0], attitude * [0, 0, 1]))
)]
struct GyroscopeOnAxle {
    #[gauss(body)]
    outer: RigidBody<f64>,
    #[gauss(body)]
    inner: RigidBody<f64>,
    #[gauss(body)]
    rotor: RigidBody<f64>,
    #[gauss(gravity)]
    g: f64,
}

macro_rules! four_bars {
    ($(#[$documentation:meta])* $name:ident [$($clause:tt)+]) => {
        $(#[$documentation])*
        #[derive(GaussDynamics)]
        #[gauss($($clause)+)]
        struct $name {
            #[gauss(body)]
            crank: RigidBody<f64>,
            #[gauss(body)]
            coupler: RigidBody<f64>,
            #[gauss(body)]
            rocker: RigidBody<f64>,
            l1: f64,
            l2: f64,
            l3: f64,
            d: f64,
            #[gauss(gravity)]
            g: Vector3<f64>,
        }

        impl $name {
            fn of(Linkage { bars: [crank, coupler, rocker], lengths: [l1, l2, l3], d, g }: Linkage) -> Self {
                Self { crank, coupler, rocker, l1, l2, l3, d, g }
            }
        }
    };
}

four_bars!(
    /// Three angles, and the loop closed by a position constraint: two components, since everything is in the plane
    /// k₁k₂.
    Loop [
        coordinates(a, b, c),
        body(crank, rotation = rotation_z(a)),
        body(coupler, position = [l1 * cos(a), l1 * sin(a), 0], rotation = rotation_z(b)),
        body(rocker, position = [d, 0, 0], rotation = rotation_z(c)),
        point(end, body = coupler, at = [l2, 0, 0]),
        point(tip, body = rocker, at = [l3, 0, 0]),
        constraint(position = end - tip)
    ]
);

four_bars!(
    /// The same, solved for the rate of the crank at compile time.
    ByCrank [
        coordinates(a, b, c),
        speeds(u, v, w),
        kinematics(a = u, b = v, c = w),
        body(crank, rotation = rotation_z(a)),
        body(coupler, position = [l1 * cos(a), l1 * sin(a), 0], rotation = rotation_z(b)),
        body(rocker, position = [d, 0, 0], rotation = rotation_z(c)),
        point(end, body = coupler, at = [l2, 0, 0]),
        point(tip, body = rocker, at = [l3, 0, 0]),
        constraint(position = end - tip),
        independent(u)
    ]
);

four_bars!(
    /// Every bar free in the plane, and eight constraints for four hinges.
    Apart [
        coordinates(x1, y1, a, x2, y2, b, x3, y3, c),
        body(crank, position = [x1, y1, 0], rotation = rotation_z(a)),
        body(coupler, position = [x2, y2, 0], rotation = rotation_z(b)),
        body(rocker, position = [x3, y3, 0], rotation = rotation_z(c)),
        point(elbow, body = crank, at = [l1, 0, 0]),
        point(end, body = coupler, at = [l2, 0, 0]),
        point(tip, body = rocker, at = [l3, 0, 0]),
        constraint(position = crank.position),
        constraint(position = elbow - coupler.position),
        constraint(position = rocker.position - [d, 0, 0]),
        constraint(position = end - tip)
    ]
);

/// What the linkages are made of.
#[derive(Clone, Copy, Debug)]
struct Linkage {
    bars: [RigidBody<f64>; 3],
    lengths: [f64; 3],
    d: f64,
    g: Vector3<f64>,
}

fn about(axis: Unit<Vector3<f64>>, angle: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_axis_angle(&axis, angle)
}

fn gyroscopes() -> (GyroscopeKernel, GyroscopeBySpinKernel, GyroscopeOnAxleKernel) {
    let parameters = &reference("gyroscope_in_gimbals")["parameters"];
    let body = |name: &str| {
        let value = &parameters[name];
        RigidBody {
            mass: number(&value["mass"]),
            center_of_mass: triple(&value["centre_of_mass_body_from_O"]),
            inertia: Matrix3::from_diagonal(&triple(&value["principal_inertia_about_O"])),
        }
    };
    let (outer, inner, rotor, g) = (body("outer"), body("inner"), body("rotor"), number(&parameters["g"]));
    (
        Gyroscope { outer, inner, rotor, g }.kernel().unwrap(),
        GyroscopeBySpin { outer, inner, rotor, g }.kernel().unwrap(),
        GyroscopeOnAxle { outer, inner, rotor, g }.kernel().unwrap(),
    )
}

type Angles = SVector<f64, 3>;

fn to_spin(q: &Angles, z: &Angles) -> (Angles, Angles) {
    (*q, SVector::from([z[0], z[1], z[2] + z[0] * q[1].cos()]))
}

fn from_spin(q: &Angles, z: &Angles) -> (Angles, Angles) {
    (*q, SVector::from([z[0], z[1], z[2] - z[0] * q[1].cos()]))
}

type OnAxle = (UnitQuaternion<f64>, SVector<f64, 2>);

fn to_axle(q: &Angles, z: &Angles) -> (OnAxle, SVector<f64, 5>) {
    let attitude = about(Vector3::z_axis(), q[0]) * about(Vector3::x_axis(), q[1]) * about(Vector3::z_axis(), q[2]);
    let ((s, c), (st, ct)) = (q[2].sin_cos(), q[1].sin_cos());
    let w = [z[0] * st * s + z[1] * c, z[0] * st * c - z[1] * s, z[0] * ct + z[2]];
    ((attitude, SVector::from([q[0], q[1]])), SVector::from([z[0], z[1], w[0], w[1], w[2]]))
}

#[test]
fn gyroscope_in_gimbals_as_in_the_reference() {
    let name = "gyroscope_in_gimbals";
    let (rates, spin, axle) = gyroscopes();
    let (q, z) = (SVector::from([0.3, 0.8, -0.5]), SVector::from([0.5, -1.5, 40.0]));
    let rotor = |(attitude, _): &OnAxle, z: &SVector<f64, 5>| {
        vec![("rotor_R", rows(attitude)), ("rotor_omega", z.as_slice()[2..].to_vec())]
    };
    let see = |(q, z): (Angles, Angles)| {
        let (there, speeds) = to_axle(&q, &z);
        let angles = vec![("q", q.as_slice().to_vec()), ("z", z.as_slice().to_vec())];
        [rotor(&there, &speeds), angles].concat()
    };
    Run { name, system: &rates, start: (q, z) }.agrees(1.0, |_, q, z| see((*q, *z)));
    Run { name, system: &spin, start: to_spin(&q, &z) }.agrees(1.0, |_, q, z| see(from_spin(q, z)));
    let start = to_axle(&q, &z);
    Run { name, system: &axle, start }.agrees(1.0, |_, q, z| rotor(q, z));
}

/// The rotor is symmetric, so nothing turns it about its axis: the spin is constant, and the kernel has no code for its
/// rate.
#[test]
fn the_spin_of_the_rotor_is_kept() {
    let (_, kernel, _) = gyroscopes();
    let (q, z) = to_spin(&SVector::from([0.3, 0.8, -0.5]), &SVector::from([0.5, -1.5, 40.0]));
    let end = Simulation::new(&kernel).adaptive(1e-9, 1e-9).run_to_end(q, z, 0.0..2.0).unwrap();
    let listed = number(&reference("gyroscope_in_gimbals")["conserved"]["rotor_omega_3"]["value_t0"]);
    // A tolerance of 1e-9 in the steps, and a few roundings.
    assert!((end.z[2] - listed).abs() <= 1e-12 * listed, "{} {listed}", end.z[2]);
}

fn linkage() -> Linkage {
    let bar = |mass: f64, center: [f64; 3], inertia: [f64; 9]| RigidBody {
        mass,
        center_of_mass: Vector3::from(center),
        inertia: Matrix3::from_row_slice(&inertia),
    };
    Linkage {
        bars: [
            bar(0.6, [0.2, 0.0, 0.0], [0.001, 0.0, 0.0, 0.0, 0.032, 0.0, 0.0, 0.0, 0.032]),
            bar(1.2, [0.5, 0.05, 0.0], [0.004, -0.03, 0.0, -0.03, 0.4, 0.0, 0.0, 0.0, 0.403]),
            bar(1.0, [0.4, 0.0, 0.0], [0.001, 0.0, 0.0, 0.0, 0.21, 0.0, 0.0, 0.0, 0.21]),
        ],
        lengths: [0.4, 1.0, 0.8],
        d: 1.0,
        g: Vector3::new(0.0, -9.81, 0.0),
    }
}

fn four_bars() -> (LoopKernel, ByCrankKernel, ApartKernel) {
    let linkage = linkage();
    (Loop::of(linkage).kernel().unwrap(), ByCrank::of(linkage).kernel().unwrap(), Apart::of(linkage).kernel().unwrap())
}

/// The angles with the coupler's end above the line from the elbow to the rocker's bearing, by the law of cosines, and
/// their rates.
fn closed(a: f64, rate: f64) -> (Angles, Angles) {
    let ([l1, l2, l3], (s, c)) = ([0.4, 1.0, 0.8], a.sin_cos());
    let (x, y) = (1.0 - l1 * c, -l1 * s);
    let square = x * x + y * y;
    let along = (square + l2 * l2 - l3 * l3) / (2.0 * square);
    let height = (l2 * l2 / square - along * along).sqrt();
    let end = [along * x - height * y, along * y + height * x];
    let (b, c) = (end[1].atan2(end[0]), (end[1] - y).atan2(end[0] - x));
    // l1 e(a) + l2 e(b) − l3 e(c) = (d, 0), differentiated and taken along and across.
    let second = -l1 * (a - c).sin() / (l2 * (b - c).sin()) * rate;
    let third = l1 * (a - b).sin() / (l3 * (c - b).sin()) * rate;
    (SVector::from([a, b, c]), SVector::from([rate, second, third]))
}

type Nine = SVector<f64, 9>;

fn to_parts(q: &Angles, z: &Angles) -> (Nine, Nine) {
    let (s, c) = q[0].sin_cos();
    (
        SVector::from([0.0, 0.0, q[0], 0.4 * c, 0.4 * s, q[1], 1.0, 0.0, q[2]]),
        SVector::from([0.0, 0.0, z[0], -0.4 * s * z[0], 0.4 * c * z[0], z[1], 0.0, 0.0, z[2]]),
    )
}

#[test]
fn four_bar_linkage_as_in_the_reference() {
    let name = "four_bar_linkage";
    let (loops, crank, apart) = four_bars();
    let see = |q: &Angles, z: &Angles| {
        let bar = |k: usize, length: f64| SVector::from([length * q[k].cos(), length * q[k].sin()]);
        let elbow = bar(0, 0.4);
        vec![
            ("q", q.as_slice().to_vec()),
            ("z", z.as_slice().to_vec()),
            ("A", elbow.as_slice().to_vec()),
            ("B", (elbow + bar(1, 1.0)).as_slice().to_vec()),
        ]
    };
    let (q, z) = closed(0.7, 6.0);
    Run { name, system: &loops, start: (q, z) }.agrees(1.0, |_, q, z| see(q, z));
    Run { name, system: &crank, start: (q, SVector::from([6.0])) }
        .agrees(1.0, |t, q, z| see(q, &crank.kinematics(t, q, z)));
    Run { name, system: &apart, start: to_parts(&q, &z) }.agrees(1.0, |_, q, z| {
        let angles = |v: &Nine| SVector::from([v[2], v[5], v[8]]);
        see(&angles(q), &angles(z))
    });
}

/// A hundred revolutions and more in a hundred thousand steps: the loop stays closed to rounding, at every one of them.
#[test]
fn the_loop_stays_closed_for_a_hundred_thousand_steps() {
    let (loops, crank, _) = four_bars();
    let (q, z) = closed(0.7, 6.0);
    let energy = loops.energy(0.0, &q, &z);
    let (mut gap, mut slip, mut steps, mut monitor) = (0.0_f64, 0.0_f64, 0, EnergyMonitor::new());
    let end = Simulation::new(&loops)
        .fixed_step(1e-3)
        .observe(|sample| {
            gap = gap.max(loops.position_residual(sample.t, &sample.q).amax());
            slip = slip.max(loops.velocity_residual(sample.t, &sample.q, &sample.z).amax());
            monitor.watch(&loops, sample);
            steps += 1;
        })
        .run_to_end(q, z, 0.0..100.0)
        .unwrap();
    assert_eq!(steps, 100_001);
    // Sums of a few lengths near one, and of speeds near ten with angles near a thousand, whose rounding is that of
    // their sines.
    assert!(gap <= 8.0 * f64::EPSILON * end.q[0].abs().max(1.0), "{gap:e}");
    assert!(slip <= 64.0 * f64::EPSILON * end.q[0].abs().max(10.0), "{slip:e}");
    assert!(end.q[0] > 200.0, "the crank goes round: {}", end.q[0]);
    // Of order 4: (ω h)⁴ = 1e-9 for rates near ten, a step; measured against the kinetic energy.
    assert!(monitor.energy.largest() <= 1e-6 * energy.abs(), "{monitor}");

    let mut gap = 0.0_f64;
    let end = Simulation::new(&crank)
        .fixed_step(1e-3)
        .observe(|sample| gap = gap.max(crank.position_residual(sample.t, &sample.q).amax()))
        .run_to_end(q, SVector::from([6.0]), 0.0..100.0)
        .unwrap();
    assert!(gap <= 8.0 * f64::EPSILON * end.q[0].abs().max(1.0), "{gap:e}");
}

fn gyroscope_laws(q: Angles, z: Angles, off: [f64; 10]) {
    let (rates, spin, axle) = gyroscopes();
    laws(&rates, 0.0, &q, &z, Time::Absent);
    least(&rates, 0.0, &q, &z);
    corresponds(&rates, &spin, 0.0, (&q, &z), |_, q, z| to_spin(q, z));
    corresponds(&rates, &axle, 0.0, (&q, &z), |_, q, z| to_axle(q, z));
    let (same, speeds) = to_spin(&q, &z);
    laws(&spin, 0.0, &same, &speeds, Time::Absent);
    least(&spin, 0.0, &same, &speeds);
    corresponds(&spin, &rates, 0.0, (&same, &speeds), |_, q, z| from_spin(q, z));
    let (q, z) = to_axle(&q, &z);
    let turn = UnitQuaternion::from_scaled_axis(Vector3::new(off[0], off[1], off[2]));
    let near = (
        (q.0 * turn, SVector::from([q.1[0] + off[3], q.1[1] + off[4]])),
        SVector::from_fn(|i, _| z[i] + 10.0 * off[i + 5]),
    );
    position_rates(&axle, 0.0, &near.0, &near.1);
    let (q, z) = axle.project(0.0, &near.0, &near.1).unwrap();
    laws(&axle, 0.0, &q, &z, Time::Absent);
    constrained_laws(&axle, 0.0, &q, &z);
}

fn linkage_laws(a: f64, rate: f64, off: [f64; 18]) {
    let (loops, crank, apart) = four_bars();
    let (q, z) = closed(a, rate);
    corresponds(&loops, &apart, 0.0, (&q, &z), |_, q, z| to_parts(q, z));
    corresponds(&loops, &crank, 0.0, (&q, &z), |_, q, z| (*q, SVector::from([z[0]])));

    let one = SVector::from([rate]);
    laws(&crank, 0.0, &q, &one, Time::Absent);
    constrained_laws(&crank, 0.0, &q, &one);
    corresponds(&crank, &loops, 0.0, (&q, &one), |_, q, z| (*q, crank.kinematics(0.0, q, z)));
    let difference = crank.multipliers(0.0, &q, &one, &()) - loops.multipliers(0.0, &q, &z, &());
    // Both are the force in the last hinge, from a few hundred operations on forces of this size.
    let size = loops.multipliers(0.0, &q, &z, &()).amax() + 10.0 * (1.0 + rate * rate);
    assert!(difference.amax() <= 1e3 * f64::EPSILON * size, "{difference}");

    let near = (SVector::from_fn(|i, _| q[i] + off[i]), SVector::from_fn(|i, _| z[i] + 10.0 * off[i + 3]));
    position_rates(&loops, 0.0, &near.0, &near.1);
    let (q, z) = loops.project(0.0, &near.0, &near.1).unwrap();
    laws(&loops, 0.0, &q, &z, Time::Absent);
    constrained_laws(&loops, 0.0, &q, &z);

    let (q, z) = to_parts(&q, &z);
    let near = (SVector::from_fn(|i, _| q[i] + off[i]), SVector::from_fn(|i, _| z[i] + 10.0 * off[i + 9]));
    position_rates(&apart, 0.0, &near.0, &near.1);
    let (q, z) = apart.project(0.0, &near.0, &near.1).unwrap();
    laws(&apart, 0.0, &q, &z, Time::Absent);
    constrained_laws(&apart, 0.0, &q, &z);
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn gyroscopes_at_random(
        q in prop::array::uniform3(-3.0..3.0_f64), z in prop::array::uniform3(-3.0..3.0_f64),
        off in prop::array::uniform10(-0.03..0.03_f64)
    ) {
        gyroscope_laws(SVector::from(q), SVector::from(z), off);
    }

    #[test]
    fn linkages_at_random(
        a in -3.0..3.0_f64, rate in -5.0..5.0_f64, off in prop::array::uniform18(-0.02..0.02_f64)
    ) {
        linkage_laws(a, rate, off);
    }
}
