//! The energy of runs of all kinds, drawn at random: between samples, in flights, at events.

use gauss_contact::{ContactError, ContactErrorKind, ContactEvent, ContactRun, ContactTrajectory, EventKind, Impact};
use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::prelude::*;

use crate::common::numbers;
use crate::rod::Rod;
use crate::tossed::Crate;
use crate::turning::Ball;

const G: f64 = 9.81;

/// Two balls in a plane above a floor, which meet each other too.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, z, a, u, w, b),
    body(one, position = [x, 0, z], rotation = rotation_y(a), mass = m, inertia = 0.4 * m * r * r),
    body(two, position = [u, 0, w], rotation = rotation_y(b), mass = n, inertia = 0.4 * n * r * r),
    contact(floor, point = one.position, radius = r, friction = mu, restitution = e),
    contact(ground, point = two.position, radius = r, friction = mu, restitution = e),
    contact(pair, point = one.position, radius = r, other = two.position, other_radius = r, friction = mu,
        restitution = e, along = [0, 1, 0]),
)]
struct Balls {
    m: f64,
    n: f64,
    r: f64,
    mu: f64,
    e: f64,
    #[gauss(gravity)]
    g: f64,
}

type Ended<'k, K> = (ContactTrajectory<'k, K>, Option<ContactError>);

/// The energy that a step may err by: its tolerance of each speed, which changes the energy by the momentum, and of the
/// place.
fn room<K: ContactSystem<Scalar = f64>>(kernel: &K, (t, q, z): (f64, &K::Configuration, &K::Speeds), by: f64) -> f64 {
    let p = kernel.momentum(t, q, z);
    (0..K::Speeds::DIM).map(|i| p.component(i).abs() * by * (1.0 + z.component(i).abs())).sum()
}

/// Energy falls or stays from sample to sample and at events, stays in flights; impacts take it; nothing is passed.
/// Newton's law with friction may create energy (T. R. Kane 1984), and says so.
#[track_caller]
fn accounts<K: ContactSystem<Scalar = f64>>(
    kernel: &K,
    (run, error): &Ended<'_, K>,
    (law, tolerance, size): (Impact, f64, f64),
    name: &str,
) {
    let newton = matches!(law, Impact::Newton | Impact::Sequential);
    let told = error.as_ref().map(|error| matches!(error.kind, ContactErrorKind::EnergyGrows { .. }) && newton);
    assert!(told != Some(false), "{name}: {error:?}");
    let (mut most, mut before) = (0.0_f64, f64::INFINITY);
    for segment in run.segments() {
        let flies = !segment.modes().iter().any(|mode| mode.is_closed());
        for (n, s) in segment.trajectory().iter().enumerate() {
            let now = kernel.energy(s.t, &s.q, &s.z);
            most = most.max(now.abs());
            // Where bounces pile up the speed of those that are left out is told.
            let left_out = |event: &ContactEvent| match event.kind {
                EventKind::Rests { speed, .. } if event.time == s.t => speed,
                _ => 0.0,
            };
            let left_out: f64 = run.events().iter().map(left_out).sum();
            let room = |by: f64| room(kernel, (s.t, &s.q, &s.z), by);
            let room = 5.0 * (room(tolerance) + most * (tolerance + 1e-14)) + room(left_out);
            assert!(now <= before + room, "{name}: {} {before:e} {now:e}", s.t);
            assert!(n == 0 || !flies || now >= before - room, "{name}: {} {before:e} {now:e}", s.t);
            let gaps = kernel.gaps(s.t, &s.q);
            let held = |i: usize| !kernel.contacts()[i].has_gap() || gaps.component(i) > -1e-11 * size;
            assert!((0..kernel.contacts().len()).all(held), "{name}: {} {gaps:?}", s.t);
            before = now;
        }
    }
    let end = error.as_ref().map_or(f64::INFINITY, |error| error.time);
    let hits = run.events().iter().filter_map(|event| match event.kind {
        EventKind::Impact(hit) if event.time < end => Some((event.time, hit.energy_lost)),
        _ => None,
    });
    let hits: Vec<(f64, f64)> = hits.collect();
    for hits in hits.chunk_by(|a, b| a.0 == b.0) {
        assert!(hits.iter().map(|hit| hit.1).sum::<f64>() > -1e-9 * most, "{name}: {hits:?}");
    }
}

#[test]
fn energy_of_whatever_is_thrown_is_accounted_for() {
    // Others are drawn by `just throws`.
    let given = |name: &str, without| std::env::var(name).map_or(Ok(without), |text| text.parse());
    let [first, count] = [("FIRST", 0), ("THROWS", 80)].map(|(name, without)| given(name, without).expect("a number"));
    for seed in first..first + count {
        let mut number = numbers(7919 * seed + 3);
        (0..6).for_each(|_| _ = number());
        let mut part = || 0.5 + 0.5 * number();
        let law = [Impact::Newton, Impact::Moreau, Impact::Poisson, Impact::Sequential][(seed / 4 % 4) as usize];
        let m = [1.0, 1e-6, 1e6][(seed % 3) as usize];
        let tolerance = 10.0_f64.powf(-4.0 - 8.0 * part());
        let (mu, e) = ([0.0, 1.0, 1.3][(seed % 7 % 3) as usize] * part(), [0.0, 1.0, part()][(seed % 5 % 3) as usize]);
        let lean: f64 = [0.0, 0.3 * part()][(seed % 2) as usize];
        let size: f64 = [1.0, 0.01, 30.0][(seed / 3 % 3) as usize];
        let (speed, end, g) = (size.sqrt(), size.sqrt(), Vector3::new(G * lean.sin(), 0.0, -G * lean.cos()));
        let (name, how) = (format!("{seed} {law:?} {m:e} {tolerance:e} {mu} {e}"), (law, tolerance, size));
        // Six numbers between −1 and 1, and three between 0.1 and 0.4 of the size.
        let z: [f64; 6] = std::array::from_fn(|_| 2.0 * part() - 1.0);
        let [a, b, c]: [f64; 3] = std::array::from_fn(|_| size * (0.1 + 0.3 * part()));
        let moving = SVector::from_fn(|i, _| z[i] * if i < 3 { 2.0 * speed } else { 8.0 / speed });
        let turned = Isometry3::new(Vector3::new(0.0, 0.0, 0.5 * size), Vector3::from_fn(|i, _| 3.0 * z[5 - i]));
        match seed % 4 {
            0 => {
                let kernel = Crate { m, a, b, c, mu, e, growth: 0.0, g }.kernel().unwrap();
                let run = ContactRun::new(&kernel).adaptive(tolerance, tolerance).law(law);
                accounts(&kernel, &run.attempt(turned, moving, 0.0..end), how, &name);
            }
            1 => {
                let kernel = Rod { m, j: 0.1 * m * size * size, l: 0.5 * size, mu, e, g: G }.kernel().unwrap();
                let run = ContactRun::new(&kernel).adaptive(tolerance, tolerance).law(law);
                let start = SVector::from([0.0, 0.7 * size, 1.5 * z[0]]);
                let z = SVector::from([speed * z[1], 0.0, 3.0 * z[2] / speed]);
                accounts(&kernel, &run.attempt(start, z, 0.0..end), how, &name);
            }
            2 => {
                let r = 0.1 * size;
                let kernel =
                    Ball { m, r, mu, patch: 0.1 * a, rho: 0.01 * b, e, lean: lean.sin(), g: G }.kernel().unwrap();
                let run = ContactRun::new(&kernel).adaptive(tolerance, tolerance).law(law);
                accounts(&kernel, &run.attempt(turned, moving, 0.0..end), how, &name);
            }
            _ => {
                let (r, n) = (0.1 * size, m * [1.0, 0.1, 30.0][(seed % 9 % 3) as usize]);
                let kernel = Balls { m, n, r, mu, e, g: G }.kernel().unwrap();
                let run = ContactRun::new(&kernel).adaptive(tolerance, tolerance).law(law);
                let start = SVector::from([0.0, r + a, 0.0, 2.2 * r + b, r + c, 0.0]);
                let z = SVector::from_fn(|i, _| z[i] * if i % 3 < 2 { speed } else { 5.0 / speed });
                accounts(&kernel, &run.attempt(start, z, 0.0..end), how, &name);
            }
        }
    }
}
