//! Mass that varies against closed forms, against matter that is followed on its way, and the laws of every system.

mod flow;

use gauss_runtime::prelude::*;
use gauss_tests::laws::{Time, forced_laws, laws};

/// A rocket that burns as much in every second, upward.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(height),
    body(hull, position = [0, 0, height], mass = start - burn * t, inertia = 1),
    mass_flow(jet, body = hull, at = [0, 0, -2], velocity = [0, 0, -exhaust]),
    gravity = g,
)]
struct Rocket {
    #[gauss(unit = "kg")]
    start: f64,
    #[gauss(unit = "kg/s")]
    burn: f64,
    #[gauss(unit = "m/s")]
    exhaust: f64,
    #[gauss(unit = "m/s^2")]
    g: f64,
}

/// The velocity that Tsiolkovsky's formula gives, to the tolerance of the run.
#[test]
fn a_rocket_reaches_the_velocity_of_tsiolkovsky() {
    let (start, burn, exhaust, g) = (5.0, 0.4, 300.0, 9.81);
    let kernel = Rocket { start, burn, exhaust, g }.kernel().unwrap();
    let run =
        Simulation::new(&kernel).adaptive(1e-11, 1e-11).run(SVector::from([0.0]), SVector::from([0.0]), 0.0..10.0);
    let end = run.unwrap().last().z[0];
    let expected = exhaust * (start / (start - burn * 10.0)).ln() - g * 10.0;
    assert!((end - expected).abs() < 1e-8 * expected, "{end} {expected}");
}

/// A drop that takes up mist at rest, and one that evaporates.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(fallen, drifted),
    body(drop, position = [0, 0, -fallen], mass = m + k * t, inertia = 1),
    mass_flow(mist, body = drop, velocity = -drop.velocity, axes = observer),
    body(puddle, position = [drifted, 0, 0], mass = m * exp(-t), inertia = 1),
    force(wind, body = puddle, value = [f, 0, 0]),
    gravity = g,
)]
struct Drops {
    m: f64,
    k: f64,
    f: f64,
    g: f64,
}

/// Meshchersky: d(m v)/dt = m g of the drop that takes up matter from rest, and m v̇ = f of the other, whose matter
/// leaves with the velocity that it has. A few roundings.
#[test]
fn drops_have_the_equations_of_meshchersky() {
    let (m, k, f, g) = (0.3, 0.2, 1.5, 9.81);
    let kernel = Drops { m, k, f, g }.kernel().unwrap();
    for (t, v) in [(0.0, 0.0), (0.7, 2.5), (3.0, -1.2)] {
        let z = SVector::from([v, 0.4]);
        let found = kernel.acceleration(t, &SVector::from([1.0, 2.0]), &z, &());
        let expected = [g - k * v / (m + k * t), f / (m * f64::exp(-t))];
        for (found, expected) in [(found[0], expected[0]), (found[1], expected[1])] {
            assert!((found - expected).abs() <= 16.0 * f64::EPSILON * (expected.abs() + g), "{found} {expected}");
        }
    }
}

/// A rocket that turns about a pivot, and whose exit is l away from it.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(angle),
    body(rocket, rotation = rotation_z(angle), mass = start - burn * t, inertia = [1, 1, about - k * t]),
    mass_flow(jet, body = rocket, at = [-l, 0, 0], velocity = [-exhaust, 0, 0]),
)]
struct Pivoted {
    start: f64,
    burn: f64,
    about: f64,
    k: f64,
    l: f64,
    exhaust: f64,
}

/// J ω̇ = −(J̇ − ṁ l²) ω with J = J₀ − k t and ṁ = −μ: ω = ω₀ (J/J₀)^((μ l² − k)/k).
#[test]
fn a_jet_damps_what_turns() {
    let (start, burn, about, k, l) = (5.0, 0.4, 6.0, 0.3, 2.0);
    let kernel = Pivoted { start, burn, about, k, l, exhaust: 250.0 }.kernel().unwrap();
    let run = Simulation::new(&kernel).adaptive(1e-11, 1e-11).run(SVector::from([0.0]), SVector::from([1.0]), 0.0..9.0);
    let end = run.unwrap().last().z[0];
    let expected = ((about - k * 9.0) / about).powf((burn * l * l - k) / k);
    assert!(expected < 0.5 && (end - expected).abs() < 1e-8 * expected, "{end} {expected}");
}

/// A rocket in space by its pose, with everything that flows, in a chart.
macro_rules! rocket_in_space {
    ($name:ident: $($clauses:tt)+) => {
        #[derive(GaussDynamics)]
        #[gauss(
            $($clauses)+, mass = start - burn * t, center_of_mass = [0.1 + shift * t * t, 0.05, 0],
            inertia = [3 - k * t, 9 - t, 8 - 0.5 * t],
            mass_flow(jet, at = [-l, 0.1, 0.05], velocity = [-exhaust, 3, 0], thrust = [press, 0, 0]), gravity = 9.81,
        )]
        struct $name {
            start: f64,
            burn: f64,
            shift: f64,
            k: f64,
            l: f64,
            exhaust: f64,
            press: f64,
        }
    };
}

rocket_in_space!(InSpace: linearize(parameters), chart = left_invariant);
// From the observer's pole.
rocket_in_space!(InOtherSpeeds: chart = hybrid);

/// A rocket with fuel that swings in it: two links, one of which varies.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, angle, swing),
    body(hull, position = [x, y, 0], rotation = rotation_z(angle), mass = dry, inertia = [1, 4, 4]),
    body(tank, parent = hull, position = [0.5, 0, 0], rotation = rotation_z(swing), mass = fuel * exp(-t / tau),
        center_of_mass = [-length, 0, 0], inertia_about_center_of_mass = [0.1, 0.1, 0.1 * exp(-t / tau)]),
    mass_flow(jet, body = tank, at = [-length, 0, 0], velocity = [-exhaust, 0, 0]),
    spring(along = swing, stiffness = stiff),
    gravity = [0, -9.81, 0],
)]
struct Sloshing {
    dry: f64,
    fuel: f64,
    tau: f64,
    length: f64,
    exhaust: f64,
    stiff: f64,
}

/// ṗ is the rate of p along the motion, whatever part of it is that of masses, and dE/dt is what is supplied.
#[test]
fn laws_of_every_system_hold_where_mass_varies() {
    let kernel = Rocket { start: 5.0, burn: 0.4, exhaust: 300.0, g: 9.81 }.kernel().unwrap();
    let (q, z) = (SVector::from([3.0]), SVector::from([20.0]));
    laws(&kernel, 2.0, &q, &z, Time::Explicit);
    forced_laws(&kernel, 2.0, (&q, &z), &());
    let kernel = Drops { m: 0.3, k: 0.2, f: 1.5, g: 9.81 }.kernel().unwrap();
    let (q, z) = (SVector::from([1.0, 2.0]), SVector::from([2.5, -1.0]));
    laws(&kernel, 0.7, &q, &z, Time::Explicit);
    forced_laws(&kernel, 0.7, (&q, &z), &());
    let kernel = Sloshing { dry: 2.0, fuel: 3.0, tau: 4.0, length: 0.4, exhaust: 100.0, stiff: 3.0 }.kernel().unwrap();
    let (q, z) = (SVector::from([1.0, 2.0, 0.3, -0.2]), SVector::from([2.5, -1.0, 0.7, 1.3]));
    laws(&kernel, 0.7, &q, &z, Time::Explicit);
    forced_laws(&kernel, 0.7, (&q, &z), &());
    let kernel = in_space().kernel().unwrap();
    let (q, z) = (pose(), SVector::from([2.5, -1.0, 0.7, 1.3, -0.4, 0.9]));
    laws(&kernel, 0.7, &q, &z, Time::Explicit);
    forced_laws(&kernel, 0.7, (&q, &z), &());
}

fn in_space() -> InSpace {
    InSpace { start: 5.0, burn: 0.4, shift: 0.02, k: 0.3, l: 1.5, exhaust: 40.0, press: 2.0 }
}

fn pose() -> Isometry3<f64> {
    Isometry3::new(Vector3::new(1.0, -0.5, 2.0), Vector3::new(0.4, 0.9, -0.7))
}

/// ḃ = R u, so that b̈ = R (u̇ + ω × u): some hundred roundings of terms below 200.
#[test]
fn charts_agree_where_mass_varies() {
    let InSpace { start, burn, shift, k, l, exhaust, press } = in_space();
    let other = InOtherSpeeds { start, burn, shift, k, l, exhaust, press }.kernel().unwrap();
    let kernel = in_space().kernel().unwrap();
    let (q, u, omega) = (pose(), Vector3::new(2.5, -1.0, 0.7), Vector3::new(1.3, -0.4, 0.9));
    let whole = |a: Vector3<f64>, b: Vector3<f64>| SVector::from([a.x, a.y, a.z, b.x, b.y, b.z]);
    let found = kernel.acceleration(0.7, &q, &whole(u, omega), &());
    let expected = other.acceleration(0.7, &q, &whole(q.rotation * u, omega), &());
    let linear = q.rotation * (Vector3::new(found[0], found[1], found[2]) + omega.cross(&u));
    let angular = Vector3::new(found[3], found[4], found[5]);
    assert!((linear - Vector3::new(expected[0], expected[1], expected[2])).amax() < 1e-12, "{linear} {expected}");
    assert!((angular - Vector3::new(expected[3], expected[4], expected[5])).amax() < 1e-12, "{angular} {expected}");
}

/// Derivatives by time, by the state and by parameters against central differences of order 2.
#[test]
fn derivatives_know_that_mass_varies() {
    let kernel = in_space().kernel().unwrap();
    let (t, q, z) = (0.7, pose(), SVector::from([2.5, -1.0, 0.7, 1.3, -0.4, 0.9]));
    let exact = kernel.linearize(t, &q, &z, &());
    let h = 1e-5;
    let near = |found: SVector<f64, 6>, expected: SVector<f64, 6>, what: &str| {
        assert!((found - expected).amax() < 1e-8 * (1.0 + expected.amax()), "{what}: {found} {expected}");
    };
    let difference = |f: &dyn Fn(f64) -> SVector<f64, 6>| (f(h) - f(-h)) / (2.0 * h);
    let by_time = difference(&|s| kernel.acceleration(t + s, &q, &z, &()));
    assert!(by_time.amax() > 0.1);
    near(exact.by_time.fixed_rows::<6>(6).into_owned(), by_time, "time");
    for k in 0..6 {
        let by_speed = difference(&|s| {
            let mut faster = z;
            faster[k] += s;
            kernel.acceleration(t, &q, &faster, &())
        });
        near(exact.by_state.fixed_view::<6, 1>(6, 6 + k).into_owned(), by_speed, "speed");
    }
}
