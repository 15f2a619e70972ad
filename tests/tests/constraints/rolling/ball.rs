//! Balls that roll on a horizontal plane: a homogeneous one on a turntable, and Chaplygin's with three different
//! moments of inertia. Their centre is at O = G.

use gauss_runtime::prelude::*;
use gauss_tests::laws::{Time, balance, constrained_laws, corresponds, laws, least};
use gauss_tests::nonholonomic::{
    gains_energy, gains_energy_by_constraints, precise, rigid_state, state_of_twist, twist,
};
use gauss_tests::trajectory::{Run, number, reference, rotation, triple};
use proptest::prelude::*;

/// The table turns at a constant rate; speeds are ω in observer's axes.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, attitude: Rotation),
    speeds(w: Vector3),
    kinematics(x = r * w.y - spin * y, y = -r * w.x + spin * x, attitude = inverse(attitude) * w),
    body(position = [x, y, r], rotation = attitude)
)]
struct OnTurntable {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    j: f64,
    r: f64,
    spin: f64,
    #[gauss(gravity)]
    g: f64,
}

/// The table is a frame that turns as it likes; the ball's point at the contact has the velocity of the table's.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    frame(table, rotation = rotation_z(spin * t + sway * sin(2 * t))),
    body(ball, position = pose.position, rotation = pose.rotation),
    constraint(velocity = ball.velocity - cross(ball.angular_velocity, [0, 0, r])
        - cross(table.angular_velocity, ball.position)),
)]
struct OnFrame {
    #[gauss(body)]
    ball: RigidBody<f64>,
    r: f64,
    spin: f64,
    sway: f64,
    #[gauss(gravity)]
    g: f64,
}

/// The rolling solved for two components of ω: what is left are the velocity of the centre and the spin.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, attitude: Rotation),
    speeds(vx, vy, w1, w2, w3),
    kinematics(x = vx, y = vy, attitude = inverse(attitude) * [w1, w2, w3]),
    frame(table, rotation = rotation_z(spin * t)),
    body(ball, position = [x, y, r], rotation = attitude),
    constraint(velocity = ball.velocity - cross(ball.angular_velocity, [0, 0, r])
        - cross(table.angular_velocity, ball.position)),
    independent(vx, vy, w3),
)]
struct ByCentre {
    #[gauss(body)]
    ball: RigidBody<f64>,
    r: f64,
    spin: f64,
    #[gauss(gravity)]
    g: f64,
}

/// Chaplygin's ball with ω in body axes.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, attitude: Rotation),
    speeds(w: Vector3),
    kinematics(x = r * (attitude * w).y, y = -r * (attitude * w).x, attitude = w),
    body(position = [x, y, r], rotation = attitude)
)]
struct Chaplygin {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    j: Vector3<f64>,
    r: f64,
    #[gauss(gravity)]
    g: f64,
}

/// The same on three constraints of velocities.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(ball, position = pose.position, rotation = pose.rotation),
    constraint(velocity = ball.velocity - cross(ball.angular_velocity, [0, 0, r])),
)]
struct ChaplyginOnVelocities {
    #[gauss(body)]
    ball: RigidBody<f64>,
    r: f64,
    #[gauss(gravity)]
    g: f64,
}

/// The same with speeds that are the velocity of the centre and ω, of which the former are solved for.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, attitude: Rotation),
    speeds(vx, vy, w1, w2, w3),
    kinematics(x = vx, y = vy, attitude = [w1, w2, w3]),
    body(ball, position = [x, y, r], rotation = attitude),
    constraint(velocity = ball.velocity - cross(ball.angular_velocity, [0, 0, r])),
    independent(w1, w2, w3),
)]
struct ChaplyginEliminated {
    #[gauss(body)]
    ball: RigidBody<f64>,
    r: f64,
    #[gauss(gravity)]
    g: f64,
}

const G: f64 = 9.81;

fn homogeneous() -> RigidBody<f64> {
    RigidBody { mass: 1.0, center_of_mass: Vector3::zeros(), inertia: Matrix3::identity() * (0.4 * 0.25 * 0.25) }
}

fn on_frame(sway: f64) -> OnFrameKernel {
    OnFrame { ball: homogeneous(), r: 0.25, spin: 1.5, sway, g: G }.kernel().unwrap()
}

fn by_centre() -> ByCentreKernel {
    ByCentre { ball: homogeneous(), r: 0.25, spin: 1.5, g: G }.kernel().unwrap()
}

fn on_turntable() -> OnTurntableKernel {
    OnTurntable { m: 1.0, j: 0.025, r: 0.25, spin: 1.5, g: G }.kernel().unwrap()
}

type Planar = (UnitQuaternion<f64>, SVector<f64, 2>);

fn raised((rotation, centre): &Planar, height: f64) -> Isometry3<f64> {
    Isometry3::from_parts(Translation3::new(centre[0], centre[1], height), *rotation)
}

/// The velocity of the centre on the table: ω × r k₃ + Ω k₃ × b.
fn carried(centre: &SVector<f64, 2>, omega: &Vector3<f64>, rate: f64) -> Vector3<f64> {
    Vector3::new(0.25 * omega.y - rate * centre[1], -0.25 * omega.x + rate * centre[0], 0.0)
}

/// The pose at which a reference starts.
fn start_of(name: &str) -> Isometry3<f64> {
    let start = &reference(name)["initial"];
    let b = triple(&start["b"]);
    Isometry3::from_parts(Translation3::from(b), rotation(&start["R"]))
}

#[test]
fn the_turntable_gives_the_reference() {
    let name = "ball_on_turntable";
    let pose = start_of(name);
    let omega = triple(&reference(name)["initial"]["space_omega"]);
    let planar = (pose.rotation, SVector::from([pose.translation.x, pose.translation.y]));
    let velocity = carried(&planar.1, &omega, 1.5);
    Run { name, system: &on_turntable(), start: (planar, omega) }
        .agrees(1.0, |_, q, w| rigid_state(&raised(q, 0.25), carried(&q.1, w, 1.5), q.0.inverse() * w));
    let start = (pose, twist(&pose.rotation, velocity, omega));
    Run { name, system: &on_frame(0.0), start }.agrees(1.0, |_, pose, z| state_of_twist(pose, z));
    let start = (planar, Vector3::new(velocity.x, velocity.y, omega.z));
    Run { name, system: &by_centre(), start }.agrees(1.0, |_, q, z| {
        rigid_state(&raised(q, 0.25), Vector3::new(z.x, z.y, 0.0), q.0.inverse() * rolling(&q.1, z))
    });
}

/// ω of the velocity of the centre and the spin, on the table.
fn rolling(centre: &SVector<f64, 2>, z: &Vector3<f64>) -> Vector3<f64> {
    Vector3::new((1.5 * centre[0] - z.y) / 0.25, (z.x + 1.5 * centre[1]) / 0.25, z.z)
}

#[test]
fn the_centre_goes_round_in_circles() {
    // b̈ = Ω/(1 + m r²/I) k₃ × ḃ: a circle at 2Ω/7 when the ball is homogeneous, at 2Ω/5 when it is a shell (Milne
    // 1948).
    for (inertia, part) in [(0.4, 2.0 / 7.0), (2.0 / 3.0, 2.0 / 5.0)] {
        let (r, spin) = (0.25, 1.5);
        let kernel = OnTurntable { m: 1.0, j: inertia * r * r, r, spin, g: G }.kernel().unwrap();
        let (start, omega) = (SVector::from([0.5, 0.2]), Vector3::new(4.2, 1.6, 0.8));
        let velocity = carried(&start, &omega, spin);
        let rate = part * spin;
        let middle = SVector::from([start[0] - velocity.y / rate, start[1] + velocity.x / rate]);
        let arm: SVector<f64, 2> = start - middle;
        let check = |sample: &Sample<OnTurntableKernel>| {
            let (s, c) = (rate * sample.t).sin_cos();
            let expected = middle + SVector::from([c * arm[0] - s * arm[1], s * arm[0] + c * arm[1]]);
            // Some hundred steps, of which each turns the attitude and moves the centre by a few roundings.
            assert!((sample.q.1 - expected).amax() < 1e-13, "{} {expected}", sample.q.1);
            assert!((sample.z.z - omega.z).abs() < 1e-13, "the spin is constant");
        };
        let period = std::f64::consts::TAU / rate;
        let run = Simulation::new(&kernel).control(precise()).observe(check);
        let last = run.run_to_end((UnitQuaternion::identity(), start), omega, 0.0..period).unwrap();
        assert!((last.q.1 - start).amax() < 1e-13);
    }
}

#[test]
fn a_table_that_sways_keeps_the_integral() {
    // ḃ − (2/7) Ω(t) k₃ × b is constant whatever Ω(t).
    let kernel = on_frame(0.8);
    let rotation = UnitQuaternion::from_scaled_axis(Vector3::new(0.3, -0.5, 0.2));
    let rate = |t: f64| 1.5 + 1.6 * (2.0 * t).cos();
    let omega = Vector3::new(4.2, 1.6, 0.8);
    let velocity = carried(&SVector::from([0.5, 0.2]), &omega, rate(0.0));
    let integral = |t: f64, pose: &Isometry3<f64>, z: &SVector<f64, 6>| {
        let b = pose.translation.vector;
        pose.rotation * Vector3::new(z[0], z[1], z[2]) - Vector3::new(-b.y, b.x, 0.0) * (2.0 / 7.0 * rate(t))
    };
    let pose = Isometry3::from_parts(Translation3::new(0.5, 0.2, 0.25), rotation);
    let start = twist(&rotation, velocity, omega);
    let first = integral(0.0, &pose, &start);
    let check = |sample: &Sample<OnFrameKernel>| {
        let now = integral(sample.t, &sample.q, &sample.z);
        assert!((now - first).amax() < 1e-12, "{now} {first} at {}", sample.t);
        let weight = kernel.multipliers(sample.t, &sample.q, &sample.z, &())[2];
        assert!((weight - G).abs() < 1e-13 * G, "the table carries the weight");
    };
    Simulation::new(&kernel).control(precise()).observe(check).run_to_end(pose, start, 0.0..8.0).unwrap();
}

const RADIUS: f64 = 0.6;
const MOMENTS: Vector3<f64> = Vector3::new(0.2, 0.3, 0.45);

fn uneven() -> RigidBody<f64> {
    RigidBody { mass: 1.5, center_of_mass: Vector3::zeros(), inertia: Matrix3::from_diagonal(&MOMENTS) }
}

fn chaplygin() -> ChaplyginKernel {
    Chaplygin { m: 1.5, j: MOMENTS, r: RADIUS, g: G }.kernel().unwrap()
}

fn chaplygin_on_velocities() -> ChaplyginOnVelocitiesKernel {
    ChaplyginOnVelocities { ball: uneven(), r: RADIUS, g: G }.kernel().unwrap()
}

fn chaplygin_eliminated() -> ChaplyginEliminatedKernel {
    ChaplyginEliminated { ball: uneven(), r: RADIUS, g: G }.kernel().unwrap()
}

/// ω × r k₃ of ω in body axes.
fn rolled(rotation: &UnitQuaternion<f64>, w: &Vector3<f64>) -> Vector3<f64> {
    let omega = rotation * w;
    Vector3::new(RADIUS * omega.y, -RADIUS * omega.x, 0.0)
}

#[test]
fn chaplygins_ball_gives_the_reference() {
    let name = "chaplygin_ball";
    let (pose, w) = (start_of(name), triple(&reference(name)["initial"]["body_omega"]));
    let start = ((pose.rotation, SVector::from([0.0, 0.0])), w);
    let observe = |_: f64, q: &Planar, w: &Vector3<f64>| rigid_state(&raised(q, RADIUS), rolled(&q.0, w), *w);
    Run { name, system: &chaplygin(), start }.agrees(1.0, observe);
    Run { name, system: &chaplygin_eliminated(), start }.agrees(1.0, observe);
    let start = in_space(&start.0, &w);
    Run { name, system: &chaplygin_on_velocities(), start }.agrees(1.0, |_, pose, z| state_of_twist(pose, z));
}

/// The pose and the twist of Chaplygin's ball.
fn in_space(q: &Planar, w: &Vector3<f64>) -> (Isometry3<f64>, SVector<f64, 6>) {
    (raised(q, RADIUS), twist(&q.0, rolled(&q.0, w), q.0 * w))
}

#[test]
fn chaplygins_ball_keeps_energy_and_the_momentum_about_the_contact() {
    let name = "chaplygin_ball";
    let (pose, w) = (start_of(name), triple(&reference(name)["initial"]["body_omega"]));
    let conserved = &reference(name)["conserved"];
    let momentum = triple(&conserved["M_contact_space"]["value_t0"]);
    let energy = number(&conserved["energy"]["value_t0"]);
    let kernel = chaplygin_on_velocities();
    let check = |sample: &Sample<ChaplyginOnVelocitiesKernel>| {
        let (p, rotation) = (sample.p, sample.q.rotation);
        let about_centre = rotation * Vector3::new(p[3], p[4], p[5]);
        let about_contact =
            about_centre + Vector3::new(0.0, 0.0, RADIUS).cross(&(rotation * Vector3::new(p[0], p[1], p[2])));
        // A few roundings a step, over some hundred steps; terms up to ten.
        assert!((about_contact - momentum).amax() < 1e-12, "{about_contact} {momentum}");
        assert!((kernel.energy(sample.t, &sample.q, &sample.z) - energy).abs() < 1e-12 * energy);
        assert!((sample.q.translation.z - RADIUS).abs() < 1e-13);
    };
    let (pose, z) = in_space(&(pose.rotation, SVector::from([0.0, 0.0])), &w);
    Simulation::new(&kernel).control(precise()).observe(check).run_to_end(pose, z, 0.0..10.0).unwrap();
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn laws_on_the_turntable(
        turn in prop::array::uniform3(-2.0..2.0), centre in prop::array::uniform2(-1.0..1.0),
        omega in prop::array::uniform3(-3.0..3.0), t in 0.0..4.0_f64,
    ) {
        let rotation = UnitQuaternion::from_scaled_axis(Vector3::from(turn));
        let (q, omega) = ((rotation, SVector::from(centre)), Vector3::from(omega));
        let velocity = carried(&q.1, &omega, 1.5);
        let own = on_turntable();
        laws(&own, 0.0, &q, &omega, Time::Explicit);
        balance(&own, 0.0, (&q, &omega), &());
        least(&own, 0.0, &q, &omega);
        // b̈ = (2/7) Ω k₃ × ḃ, so the table's friction works by turning the ball alone.
        let rate = own.acceleration(0.0, &q, &omega, &());
        gains_energy(&own, 0.0, &q, &omega, 0.025 * omega.dot(&rate));
        let acceleration = 3.0 / 7.0 * Vector3::new(-velocity.y, velocity.x, 0.0);
        let expected = Vector3::new(1.5 * velocity.x - acceleration.y, acceleration.x + 1.5 * velocity.y, 0.0) / 0.25;
        prop_assert!((rate - expected).amax() < 1e-12, "{rate} {expected}");

        let z = Vector3::new(velocity.x, velocity.y, omega.z);
        let solved = by_centre();
        laws(&solved, t, &q, &z, Time::Explicit);
        balance(&solved, t, (&q, &z), &());
        least(&solved, t, &q, &z);
        corresponds(&solved, &own, t, (&q, &z), |_, q, z| (*q, rolling(&q.1, z)));
        let found = solved.acceleration(t, &q, &z, &());
        prop_assert!((found - acceleration).amax() < 1e-12, "{found}");

        let (pose, z) = (raised(&q, 0.25), twist(&rotation, velocity, omega));
        let even = on_frame(0.0);
        corresponds(&own, &even, t, (&q, &omega), |_, q, w| {
            (raised(q, 0.25), twist(&q.0, carried(&q.1, w, 1.5), *w))
        });
        let swaying = on_frame(0.8);
        let swayed = twist(&rotation, carried(&q.1, &omega, 1.5 + 1.6 * (2.0 * t).cos()), omega);
        for (kernel, z) in [(even, z), (swaying, swayed)] {
            laws(&kernel, t, &pose, &z, Time::Explicit);
            balance(&kernel, t, (&pose, &z), &());
            constrained_laws(&kernel, t, &pose, &z);
            gains_energy_by_constraints(&kernel, t, &pose, &z);
        }
    }

    #[test]
    fn laws_of_chaplygins_ball(turn in prop::array::uniform3(-2.0..2.0), w in prop::array::uniform3(-3.0..3.0)) {
        let rotation = UnitQuaternion::from_scaled_axis(Vector3::from(turn));
        let (q, w) = ((rotation, SVector::from([0.4, -0.7])), Vector3::from(w));
        let (own, solved, full) = (chaplygin(), chaplygin_eliminated(), chaplygin_on_velocities());
        let (pose, z) = in_space(&q, &w);
        laws(&own, 0.0, &q, &w, Time::Absent);
        least(&own, 0.0, &q, &w);
        laws(&solved, 0.0, &q, &w, Time::Absent);
        least(&solved, 0.0, &q, &w);
        laws(&full, 0.0, &pose, &z, Time::Absent);
        constrained_laws(&full, 0.0, &pose, &z);
        corresponds(&own, &solved, 0.0, (&q, &w), |_, q, w| (*q, *w));
        corresponds(&own, &full, 0.0, (&q, &w), |_, q, w| in_space(q, w));

        // Chaplygin's equation: the momentum about the contact is constant in space, K̇ = K × ω in body axes with
        // K = I ω + m r² (ω − (ω·γ) γ).
        let up = rotation.inverse() * Vector3::z();
        let steiner = 1.5 * RADIUS * RADIUS;
        let momentum = MOMENTS.component_mul(&w) + steiner * (w - up * up.dot(&w));
        let rate = own.acceleration(0.0, &q, &w, &());
        let up_rate = up.cross(&w);
        let relative = MOMENTS.component_mul(&rate)
            + steiner * (rate - up * (up.dot(&rate) + up_rate.dot(&w)) - up_rate * up.dot(&w));
        prop_assert!((relative - momentum.cross(&w)).amax() < 1e-12, "{relative}");
    }
}
