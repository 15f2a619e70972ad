//! Friction along two tangents.

use gauss_contact::{ContactRun, EventKind, Impact, Mode};
use gauss_runtime::contact::Contact;
use gauss_runtime::nalgebra::SMatrix;
use gauss_runtime::system::GaussSystem;

use crate::common::{Layout, Scene, V, numbers};

const G: f64 = 9.81;

pub struct Plane;
impl Layout for Plane {
    const CONTACTS: &'static [Contact] = &[Contact::new("plane", 0, 2)];
}

/// A sphere on a plane: (x, y, h, and three angles), its inertia the same about all axes, its slip v + ω × (−r e₃).
pub fn sphere(m: f64, r: f64, mu: f64) -> Scene<Plane, 6, 1, 3> {
    let inertia = 0.4 * m * r * r;
    let rows = SMatrix::<f64, 3, 6>::from_row_slice(&[
        0., 0., 1., 0., 0., 0., //
        1., 0., 0., 0., -r, 0., //
        0., 1., 0., r, 0., 0.,
    ]);
    let weight = V::from([0.0, 0.0, -m * G, 0.0, 0.0, 0.0]);
    let mass = V::from([m, m, m, inertia, inertia, inertia]);
    Scene::linear(mass, weight, V::from([-r]), rows).friction([mu])
}

#[test]
fn a_sphere_that_is_set_down_sliding_rolls_with_five_sevenths() {
    let (r, mu) = (0.1, 0.3);
    let kernel = sphere(2.0, r, mu);
    let (v, direction) = (2.0, [0.6, 0.8]);
    let start = V::from([0.0, 0.0, r, 0.0, 0.0, 0.0]);
    let speeds = V::from([v * direction[0], v * direction[1], 0.0, 0.0, 0.0, 0.0]);
    let run = ContactRun::new(&kernel).adaptive(1e-10, 1e-10).run(start, speeds, 0.0..2.0).expect("runs");
    let [rolls] = run.events() else { panic!("{:?}", run.events()) };
    assert_eq!(rolls.kind, EventKind::Sticks);
    // The slip ends at a level of 1e-10 (1 + v), at a deceleration of 7/2 μ g.
    assert!((rolls.time - 2.0 * v / (7.0 * mu * G)).abs() < 3.1e-10 / (3.5 * mu * G), "{}", rolls.time);
    let end = run.last().expect("a sample");
    for k in 0..2 {
        assert!((end.z[k] - 5.0 / 7.0 * v * direction[k]).abs() < 3.1e-10, "{}", end.z);
    }
    assert_eq!(run.modes(1.9).expect("inside"), [Mode::Sticks]);
    assert_eq!(run.forces(1.9).expect("inside")[1], 0.0);
}

#[test]
fn a_block_across_an_incline_turns_downhill_and_stops() {
    // Sliding speed v and angle φ from downhill, tan of the incline times its cosine as f, friction as k:
    // v̇ = f cos φ − k, v φ̇ = −f sin φ. A first integral: v sin φ tan(φ/2)^(−k/f) stays.
    let (f, k) = (2.0, 3.0);
    let rows = SMatrix::<f64, 3, 3>::from_row_slice(&[0., 0., 1., 1., 0., 0., 0., 1., 0.]);
    let kernel: Scene<Plane, 3, 1, 3> =
        Scene::linear(V::repeat(1.0), V::from([f, 0.0, -G]), V::zeros(), rows).friction([k / G]);
    let run = ContactRun::new(&kernel).adaptive(1e-11, 1e-11);
    let run = run.run(V::zeros(), [-1.0, 2.0, 0.0].into(), 0.0..4.0).expect("runs");
    let constant = |z: &V<3>| {
        let (v, angle) = (z[0].hypot(z[1]), z[1].atan2(z[0]));
        v * angle.sin() * (0.5 * angle).tan().powf(-k / f)
    };
    let first = constant(&[-1.0, 2.0, 0.0].into());
    let stop = run.events().last().expect("stops");
    assert_eq!(stop.kind, EventKind::Sticks);
    for part in [0.2, 0.5, 0.9] {
        let state = run.at(part * stop.time).expect("inside");
        // Some hundred steps of local errors of 1e-11, and the power of the angle.
        assert!((constant(&state.z) / first - 1.0).abs() < 1e-8, "{part}: {}", constant(&state.z) / first - 1.0);
    }
    // Energy: f x − k ℓ + v²/2 with the length of the path; and the time of the stop by the momentum along v + x:
    // d/dt (v k/f + v cos φ) = f − k²/f.
    let wanted = (5.0_f64.sqrt() * k / f - 1.0) / (k * k / f - f);
    assert!((stop.time - wanted).abs() < 1e-8, "{} {wanted}", stop.time);
    let end = run.last().expect("a sample");
    assert_eq!(end.z, V::<3>::zeros());
}

pub struct Room;
impl Layout for Room {
    const CONTACTS: &'static [Contact] =
        &[Contact::new("floor", 0, 2), Contact::new("wall", 3, 2), Contact::new("other wall", 6, 2)];
}

/// A point in a corner: the normal of each contact is a tangent of the two others.
pub fn room(mass: f64, weight: V<3>) -> Scene<Room, 3, 3, 9> {
    let rows = SMatrix::<f64, 9, 3>::from_row_slice(&[
        0., 0., 1., 1., 0., 0., 0., 1., 0., //
        1., 0., 0., 0., 1., 0., 0., 0., 1., //
        0., 1., 0., 0., 0., 1., 1., 0., 0.,
    ]);
    Scene::linear(V::repeat(mass), weight, V::zeros(), rows)
}

#[test]
fn points_that_are_thrown_into_a_corner_of_a_room_come_to_rest() {
    let mut number = numbers(11);
    for n in 0..30 {
        let (e, law) = ([0.0, 0.4, 0.8][n % 3], [Impact::Newton, Impact::Moreau][n % 2]);
        let (mass, weight) = (1.5, V::from([-4.0 - 3.0 * number(), -4.0 - 3.0 * number(), -1.5 * G]));
        let kernel = room(mass, weight);
        let kernel = kernel.friction([0.3 + 0.3 * number(), 0.2, 0.1]).restitution([e; 3]);
        let start = V::from([1.0 + number(), 1.0 + number(), 1.0 + number()]);
        let speeds = V::from([3.0 * number(), 3.0 * number(), 3.0 * number()]);
        let run = ContactRun::new(&kernel).adaptive(1e-9, 1e-9).law(law);
        let run = run.run(start, speeds, 0.0..20.0).unwrap_or_else(|error| panic!("{n} {error}"));
        let end = run.last().expect("a sample");
        assert_eq!(end.z, V::<3>::zeros(), "{n} {:?}", run.modes(20.0));
        let energies: Vec<f64> = run.iter().map(|s| kernel.energy(s.t, &s.q, &s.z)).collect();
        // Steps have errors of 1e-9 of their terms, at energies below 100.
        assert!(energies.windows(2).all(|pair| pair[1] <= pair[0] + 1e-7), "{n}");
        // Coulomb's law in the end, of the forces as they are given.
        let forces = *run.forces(20.0).expect("inside");
        for i in 0..3 {
            let [normal, x, y] = [0, 1, 2].map(|k| forces[3 * i + k]);
            assert!(x.hypot(y) <= kernel.friction[i] * normal + 1e-9 && normal >= 0.0, "{n} {forces}");
        }
    }
}
