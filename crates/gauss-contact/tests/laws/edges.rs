//! Runs at the edge of what is well behaved: each ends in the right state or with a reason.

use gauss_contact::{ContactErrorKind, ContactRun, ContactTrajectory, EventKind, Impact, Mode};
use gauss_runtime::contact::{Contact, ContactSystem};
use gauss_runtime::nalgebra::SMatrix;

use crate::common::{Layout, Scene, V, numbers};

struct Ground;
impl Layout for Ground {
    const CONTACTS: &'static [Contact] = &[Contact::new("ground", 0, 1)];
}

/// A block of mass m at (x, h) under g = 10: gap h, slip ẋ.
fn block(m: f64, mu: f64, e: f64) -> Scene<Ground, 2, 1, 2> {
    let rows = SMatrix::<f64, 2, 2>::new(0.0, 1.0, 1.0, 0.0);
    Scene::linear(V::repeat(m), V::from([0.0, -10.0 * m]), V::zeros(), rows).friction([mu]).restitution([e])
}

/// No gap is below zero by more than √ε of lengths of 1, and energy is not gained.
fn holds<K: ContactSystem<Scalar = f64>>(kernel: &K, run: &ContactTrajectory<'_, K>) {
    use gauss_runtime::configuration::VectorSpace;
    let mut energy = f64::INFINITY;
    for s in run.iter() {
        let gaps = kernel.gaps(s.t, &s.q);
        assert!((0..kernel.contacts().len()).all(|i| gaps.component(i) > -1e-8), "{} {gaps:?}", s.t);
        let now = kernel.energy(s.t, &s.q, &s.z);
        // Steps of tolerance 1e-9 and their sum.
        assert!(now <= energy + 1e-7 * (1.0 + now.abs()), "{} {energy} {now}", s.t);
        energy = now;
    }
}

#[test]
fn an_event_at_the_very_end_is_taken() {
    let kernel = block(1.0, 0.5, 0.5);
    let run = |end: f64, q: [f64; 2], z: [f64; 2]| {
        ContactRun::new(&kernel).adaptive(1e-9, 1e-9).run(q.into(), z.into(), 0.0..end).expect("runs")
    };
    for height in [0.2, 0.45, 0.7, 1.0, 3.1] {
        // As it is found, and as a user computes it.
        let found = run(2.0, [0.0, height], [0.0; 2]).events()[0].time;
        for end in [found, (height / 5.0_f64).sqrt()] {
            let run = run(end, [0.0, height], [0.0; 2]);
            let last = run.last().expect("a sample");
            assert!(matches!(run.events(), [one] if matches!(one.kind, EventKind::Impact(_))), "{:?}", run.events());
            assert_eq!((last.t, run.at(end).expect("inside").z), (end, last.z));
            assert!((last.z[1] - 0.5 * 10.0 * end).abs() < 1e-13, "{}", last.z);
        }
    }
    for speed in [1.0, 0.7, 3.3] {
        let run = run(speed / 5.0, [0.0; 2], [speed, 0.0]);
        assert_eq!(run.events().last().map(|event| event.kind), Some(EventKind::Sticks), "{:?}", run.events());
        assert_eq!(
            (run.last().expect("a sample").z, run.modes(speed / 5.0)),
            (V::<2>::zeros(), Ok(&[Mode::Sticks][..]))
        );
    }
    // Two at the end: a start on the ground that strikes, in a run of no length.
    let run = run(0.0, [0.0; 2], [0.0, -2.0]);
    assert_eq!((run.events().len(), run.last().expect("a sample").z[1]), (1, 1.0));
}

struct Twice;
impl Layout for Twice {
    const CONTACTS: &'static [Contact] = &[Contact::new("one", 0, 1), Contact::new("same", 2, 1)];
}

#[test]
fn a_clause_written_twice_is_one_contact() {
    let rows = SMatrix::<f64, 4, 2>::new(0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0);
    for law in [Impact::Newton, Impact::Moreau, Impact::Sequential] {
        let twice: Scene<Twice, 2, 2, 4> = Scene::linear(V::repeat(1.0), V::from([0.0, -10.0]), V::zeros(), rows);
        let (twice, once) = (twice.friction([0.3; 2]).restitution([0.5; 2]), block(1.0, 0.3, 0.5));
        let (q, z) = ([0.0, 0.2].into(), [4.0, 0.0].into());
        let two = ContactRun::new(&twice).law(law).adaptive(1e-9, 1e-9).run(q, z, 0.0..3.0).expect("runs");
        let one = ContactRun::new(&once).law(law).adaptive(1e-9, 1e-9).run(q, z, 0.0..3.0).expect("runs");
        holds(&twice, &two);
        let (a, b) = (two.last().expect("a sample"), one.last().expect("a sample"));
        assert!((a.q - b.q).amax() < 1e-8 && a.z == b.z && a.z == V::<2>::zeros(), "{law:?} {} {}", a.q, b.q);
        // Of least norm: half the weight on each.
        assert!((*two.forces(2.9).expect("inside") - V::from([5.0, 0.0, 5.0, 0.0])).amax() < 1e-12);
    }
}

struct Wall;
impl Layout for Wall {
    const CONTACTS: &'static [Contact] = &[Contact::new("wall", 0, 0)];
}

/// A particle on a line, with a gap of its own.
fn particle(gap: fn(f64) -> f64, slope: fn(f64) -> f64, curvature: fn(f64) -> f64) -> Scene<Wall, 1, 1, 1> {
    Scene {
        gaps: Box::new(move |q| V::from([gap(q[0])])),
        rows: Box::new(move |q| SMatrix::from([[slope(q[0])]])),
        gamma: Box::new(move |q, z| V::from([curvature(q[0]) * z[0] * z[0]])),
        ..Scene::linear(V::repeat(1.0), V::zeros(), V::zeros(), SMatrix::identity()).restitution([1.0])
    }
}

#[test]
fn a_thin_wall_is_not_tunnelled() {
    // The gap is negative for |x| < thin alone, which takes 2 thin of a run of 3.
    let kernel = particle(|x| x * x - 1e-6, |x| 2.0 * x, |_| 2.0);
    let run = ContactRun::new(&kernel).adaptive(1e-9, 1e-9);
    let run = run.run([-1.3].into(), [1.0].into(), 0.0..3.0).expect("bounces");
    let last = run.last().expect("a sample");
    assert!((last.z[0] + 1.0).abs() < 1e-9 && (run.events()[0].time - 1.299).abs() < 1e-9, "{:?}", last.z);
}

#[test]
fn a_gap_that_is_grazed_changes_nothing() {
    // Thrown up at 4 under 8 it rises by 1, to the ceiling or a little more or less.
    for height in [1.0, 1.0 + 1e-12, 1.0 - 1e-14, 1.0 - 1e-12, 1.0 - 1e-9] {
        let rows = SMatrix::<f64, 1, 1>::new(-1.0);
        let kernel: Scene<Wall, 1, 1, 1> = Scene::linear(V::repeat(1.0), V::from([-8.0]), V::from([height]), rows);
        let run = ContactRun::new(&kernel).adaptive(1e-9, 1e-9).run(V::zeros(), [4.0].into(), 0.0..0.75).expect("runs");
        let last = run.last().expect("a sample");
        // The ceiling takes at most the speed √(2 · 8 · 1e-9) at the top.
        assert!((last.z[0] + 2.0).abs() < 2e-4 && (last.q[0] - 0.75).abs() < 1e-4, "{height} {} {}", last.q, last.z);
        if height >= 1.0 + 1e-12 {
            assert!(run.events().is_empty());
        }
    }
}

#[test]
fn a_hop_within_a_step_ends_on_the_ground() {
    // Weight that is lifted for some 2e-3 s around t = 1; a hop of 1e-9 m.
    for (width, by) in [(1e-2, 1.01), (1e-3, 1.5), (1e-4, 3.0)] {
        let lifted =
            move |t: f64, _: &V<2>, _: &V<2>| V::from([0.0, -10.0 + 10.0 * by * (-((t - 1.0) / width).powi(2)).exp()]);
        let kernel = block(1.0, 0.0, 0.0).force(lifted);
        let run = ContactRun::new(&kernel).adaptive(1e-9, 1e-9).run(V::zeros(), V::zeros(), 0.0..2.0).expect("runs");
        let last = run.last().expect("a sample");
        assert_eq!((last.q[1], last.z[1]), (0.0, 0.0), "{width}");
        assert!(run.iter().all(|s| s.q[1] > -1e-12), "{width}");
    }
}

struct Column;
impl Layout for Column {
    const CONTACTS: &'static [Contact] = &[Contact::new("a", 0, 0), Contact::new("b", 1, 0), Contact::new("c", 2, 0)];
}

/// Three balls above one another over the ground.
fn column(mass: [f64; 3], e: [f64; 3]) -> Scene<Column, 3, 3, 3> {
    let rows = SMatrix::<f64, 3, 3>::from_row_slice(&[1., 0., 0., -1., 1., 0., 0., -1., 1.]);
    let mass = V::from(mass);
    Scene::linear(mass, mass * -10.0, V::zeros(), rows).restitution(e)
}

#[test]
fn bounces_of_several_contacts_that_pile_up_at_once_end_in_rest_or_with_a_reason() {
    for (mass, e, start) in [
        ([1.0; 3], [0.5; 3], [0.1, 0.2, 0.3]),
        ([1.0; 3], [0.9; 3], [0.1, 0.1, 0.1]),
        ([1.0, 2.0, 4.0], [0.5, 0.7, 0.9], [0.1, 0.15, 0.3]),
        ([4.0, 1.0, 0.1], [0.3; 3], [1.0, 1.0, 1.0]),
        ([1e-12, 1.0, 1e12], [0.5; 3], [0.1, 0.2, 0.3]),
        ([1e12, 1.0, 1e-12], [0.5; 3], [0.1, 0.2, 0.3]),
    ] {
        let kernel = column(mass, e);
        let run = ContactRun::new(&kernel).adaptive(1e-9, 1e-9).max_events(20_000);
        let (run, error) = run.attempt(start.into(), V::zeros(), 0.0..60.0);
        holds(&kernel, &run);
        match error.map(|error| error.kind) {
            None => {
                let last = run.last().expect("a sample");
                assert_eq!((last.t, last.z), (60.0, V::<3>::zeros()));
            }
            Some(kind) => assert!(
                // Between masses whose ratio is 1e12 directions of contacts are not told apart.
                mass.contains(&1e12) && matches!(kind, ContactErrorKind::Unsolved { .. }),
                "{mass:?} {e:?} {kind:?}"
            ),
        }
    }
}

#[test]
fn masses_of_any_size_make_the_same_motion() {
    let run = |m: f64| {
        let kernel = block(m, 0.3, 0.5);
        let run = ContactRun::new(&kernel).adaptive(1e-9, 1e-9);
        let run = run.run([0.0, 0.3].into(), [4.0, 0.0].into(), 0.0..3.0).expect("runs");
        (run.events().len(), run.last().expect("a sample").q)
    };
    let (count, q) = run(1.0);
    for m in [1e-12, 1e-6, 1e6, 1e12] {
        assert_eq!(run(m).0, count);
        // Only roundings differ.
        assert!((run(m).1 - q).amax() < 1e-12, "{m} {} {q}", run(m).1);
    }
}

#[test]
fn friction_of_zero_is_no_friction_and_of_infinity_is_refused() {
    let kernel = block(1.0, 0.0, 0.0);
    let run = ContactRun::new(&kernel).adaptive(1e-9, 1e-9);
    let run = run.run(V::zeros(), [4.0, 0.0].into(), 0.0..3.0).expect("runs");
    assert_eq!(
        (run.last().expect("a sample").z[0], run.modes(2.0).expect("inside")),
        (4.0, &[Mode::Slides([1.0, 0.0, 0.0])][..])
    );
    for (mu, e) in [(f64::INFINITY, 0.0), (0.1, -0.1), (0.1, 1.0 + 1e-15)] {
        let kernel = block(1.0, mu, e);
        let run = ContactRun::new(&kernel).adaptive(1e-9, 1e-9).run(V::zeros(), V::zeros(), 0.0..1.0);
        let kind = run.err().expect("refused").kind;
        use ContactErrorKind::{InvalidFriction, InvalidRestitution};
        assert!(matches!(kind, InvalidFriction { .. } | InvalidRestitution { .. }), "{kind:?}");
    }
}

struct Plate;
impl Layout for Plate {
    const CONTACTS: &'static [Contact] = &{
        let mut all = [Contact::new("leg", 0, 0); 64];
        let mut n = 0;
        while n < 64 {
            all[n] = Contact::new("leg", n, 0);
            n += 1;
        }
        all
    };
}

#[test]
fn a_plate_on_sixty_four_legs_lands() {
    // Height and two tilts; legs on a grid of 8 × 8 within ±0.7.
    let leg = |n: usize| ((n % 8) as f64 * 0.2 - 0.7, (n / 8) as f64 * 0.2 - 0.7);
    let rows = SMatrix::<f64, 64, 3>::from_fn(|n, j| [1.0, leg(n).0, leg(n).1][j]);
    let kernel: Scene<Plate, 3, 64, 64> = Scene::linear(V::repeat(1.0), V::from([-10.0, 0.0, 0.0]), V::zeros(), rows);
    let run = ContactRun::new(&kernel).adaptive(1e-9, 1e-9);
    let run = run.run([0.05, 0.0, 0.0].into(), V::zeros(), 0.0..0.2).expect("lands");
    holds(&kernel, &run);
    let last = run.last().expect("a sample");
    assert_eq!((last.z, run.modes(0.15)), (V::<3>::zeros(), Ok(&[Mode::Closed; 64][..])));
    assert!(last.q.amax() < 1e-14, "{}", last.q);
    let forces = *run.forces(0.15).expect("inside");
    // Of least Σ D_ii λ_i²: λ_i D_ii is affine in the place of the leg, and the same for all by symmetry. Each is a sum
    // of 64 terms in three solutions.
    let scaled = |n: usize| (1.0 + leg(n).0.powi(2) + leg(n).1.powi(2)) * forces[n];
    assert!((forces.sum() - 10.0).abs() < 1e-11, "{}", forces.sum());
    assert!((0..64).all(|n| (scaled(n) - scaled(0)).abs() < 1e-11), "{} {}", scaled(0), scaled(9));
}

struct Six;
impl Layout for Six {
    const CONTACTS: &'static [Contact] = &[
        Contact::new("a", 0, 1),
        Contact::new("b", 2, 1),
        Contact::new("c", 4, 1),
        Contact::new("d", 6, 1),
        Contact::new("e", 8, 1),
        Contact::new("f", 10, 1),
    ];
}

#[test]
fn energy_does_not_grow_where_the_theorem_of_the_law_says_so() {
    let mut numbers = numbers(3);
    let (mut struck, mut lost) = (0, 0.0_f64);
    for n in 0..200 {
        let (law, friction) = [(Impact::Newton, 0.0), (Impact::Moreau, 0.4), (Impact::Moreau, 0.0)][n % 3];
        let e = [0.0, 0.3, 0.9][n / 3 % 3];
        // Six contacts in eight dimensions or, with columns left out, in fewer: then they depend on one another.
        let dimensions = 4 + n % 5;
        let rows = SMatrix::<f64, 12, 8>::from_fn(|_, j| if j < dimensions { numbers() } else { 0.0 });
        let mass = V::<8>::from_fn(|_, _| 10.0_f64.powf(3.0 * numbers()));
        let kernel: Scene<Six, 8, 6, 12> = Scene::linear(mass, V::zeros(), V::zeros(), rows);
        let kernel = kernel.friction([friction; 6]).restitution([e; 6]);
        let z = V::<8>::from_fn(|_, _| numbers());
        let (run, error) = ContactRun::new(&kernel).adaptive(1e-9, 1e-9).law(law).attempt(V::zeros(), z, 0.0..0.0);
        let energy = |z: &V<8>| 0.5 * z.component_mul(z).dot(&mass);
        // Impacts that do not end are a reason; what is left of the energy until then must not have grown.
        if let Some(error) = error {
            let ends = matches!(error.kind, ContactErrorKind::Zeno { .. } | ContactErrorKind::Indeterminate);
            assert!(ends, "{n} {law:?} {e} {error}");
            continue;
        }
        let after = run.last().expect("a sample").z;
        // Twelve impulses with some roundings each of the energy of their terms.
        assert!(energy(&after) <= energy(&z) * (1.0 + 1e-12), "{n} {law:?} {e}");
        struck += usize::from(!run.events().is_empty());
        lost = lost.max(1.0 - energy(&after) / energy(&z));
    }
    assert!(struck > 100 && lost > 0.1, "{struck} {lost}");
}
