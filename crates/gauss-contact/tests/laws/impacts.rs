//! Poisson's law of impact against enumeration, its theorem, and impacts without collision.

use std::marker::PhantomData;

use gauss_contact::{ContactErrorKind, ContactRun, EventKind, Impact, ImpactRecord, Mode};
use gauss_runtime::nalgebra::{SMatrix, SVector};
use gauss_runtime::system::GaussSystem;

use crate::common::{Scene, V, numbers};
use crate::friction::{Ground, rod, square};

/// Three masses of 1 whose gap and slip have the rows of a matrix.
fn mass(rows: SMatrix<f64, 2, 3>, mu: f64, e: f64) -> Scene<Ground, 3, 1, 2> {
    Scene {
        mass: V::repeat(1.0),
        force: Box::new(|_, _, _| V::zeros()),
        potential: Box::new(|_| 0.0),
        gaps: Box::new(move |q| V::from([(rows.row(0) * q)[0]])),
        rows: Box::new(move |_| rows),
        gamma: Box::new(|_, _| V::zeros()),
        friction: V::from([mu]),
        restitution: V::from([e]),
        layout: PhantomData,
    }
}

/// Impulses (N, T) of one phase: at least `least` along the normal, and Coulomb's friction, by trying all states.
fn phase(d: &SMatrix<f64, 2, 2>, u: &V<2>, mu: f64, least: f64) -> V<2> {
    let mut found = Vec::new();
    for closed in [true, false] {
        for friction in [None, Some(-mu), Some(mu)] {
            // Unknowns are what the state leaves open: the normal impulse, and friction that sticks.
            let impulse = match (closed, friction) {
                (true, None) => -d.try_inverse().unwrap() * u,
                (true, Some(f)) => V::from([1.0, f]) * (-u[0] / (d[(0, 0)] + f * d[(0, 1)])),
                (false, None) => V::from([least, -(u[1] + d[(1, 0)] * least) / d[(1, 1)]]),
                (false, Some(f)) => V::from([1.0, f]) * least,
            };
            let after = u + d * impulse;
            let opens = if closed { impulse[0] >= least - 1e-13 } else { after[0] >= -1e-13 };
            let holds = match friction {
                None => impulse[1].abs() <= mu * impulse[0] + 1e-13,
                Some(f) => f * after[1] <= 1e-13,
            };
            if opens && holds {
                found.push(impulse);
            }
        }
    }
    found[0]
}

fn hit<L: crate::common::Layout, const N: usize, const C: usize, const R: usize>(
    kernel: &Scene<L, N, C, R>,
    law: Impact,
    (q, z): (V<N>, V<N>),
) -> Result<(Vec<ImpactRecord>, V<N>), ContactErrorKind> {
    let run = ContactRun::new(kernel).adaptive(1e-9, 1e-9).law(law).run(q, z, 0.0..1e-9).map_err(|error| error.kind)?;
    let hits = run.events().iter().filter_map(|event| match event.kind {
        EventKind::Impact(hit) => Some(hit),
        _ => None,
    });
    Ok((hits.collect(), run.segments()[0].trajectory().first().z))
}

#[test]
fn poissons_law_has_the_impulses_of_its_two_phases() {
    let mut number = numbers(5);
    let (mut sticks, mut slides) = (0, 0);
    for n in 0..300 {
        // Friction below the paradox.
        let rows = SMatrix::<f64, 2, 3>::from_fn(|_, _| number());
        let d = rows * rows.transpose();
        let (mu, e) = (0.9 * number().abs() * d[(0, 0)] / d[(0, 1)].abs(), [0.0, 0.5, 1.0][n % 3]);
        let mut z = V::<3>::from_fn(|_, _| number());
        if (rows.row(0) * z)[0] > 0.0 {
            z = -z;
        }
        let u = rows * z;
        let compression = phase(&d, &u, mu, 0.0);
        let restitution = phase(&d, &(u + d * compression), mu, e * compression[0]);
        let wanted = compression + restitution;
        let (hits, after) = hit(&mass(rows, mu, e), Impact::Poisson, (V::zeros(), z)).unwrap();
        let found = SVector::from([hits[0].impulse[0], hits[0].impulse[1]]);
        // The determinant of D divides roundings of its entries.
        let rounding = 1e-13 * wanted.amax() * d[(0, 0)] * d[(1, 1)] / d.determinant();
        assert!((found - wanted).amax() <= rounding, "{n} {found} {wanted}");
        assert!((after - z - rows.transpose() * wanted).amax() <= rounding * rows.amax(), "{n}");
        sticks += usize::from((rows * after)[1].abs() < 1e-12);
        slides += usize::from((rows * after)[1].abs() > 1e-3);
    }
    assert!(sticks > 30 && slides > 30, "{sticks} {slides}");
}

#[test]
fn energy_does_not_grow_by_poissons_law() {
    // T. R. Kane's rod, for which Newton's law does.
    let mut refused = 0;
    for n in 0..40 {
        let angle = 0.2 + 0.03 * f64::from(n);
        let kernel = Scene { restitution: V::from([0.9]), ..rod(0.6) };
        for spin in [-4.0, -1.0, 2.0] {
            let state = (V::from([0.0, angle.sin(), angle]), V::from([0.4, -1.0, spin]));
            refused += usize::from(hit(&kernel, Impact::Newton, state).is_err());
            let (hits, _) = hit(&kernel, Impact::Poisson, state).unwrap();
            assert!(hits.iter().all(|hit| hit.energy_lost >= 0.0), "{angle} {spin} {hits:?}");
        }
    }
    assert!(refused > 5, "{refused}");
    // Both corners of a square at once, and both with one e.
    let mut number = numbers(9);
    for n in 0..200 {
        let e = [0.0, 0.4, 0.8, 1.0][n % 4];
        let kernel = Scene { restitution: V::from([e; 2]), ..square(0.5 + 0.4 * number(), 0.1) };
        let state = (V::from([0.0, 0.1, 0.0]), V::from([number(), -number().abs(), 3.0 * number()]));
        let (hits, after) = hit(&kernel, Impact::Poisson, state).unwrap_or_else(|error| panic!("{n} {error}"));
        let energy = |z: &V<3>| kernel.kinetic_energy(0.0, &state.0, z);
        assert!(energy(&after) <= energy(&state.1) * (1.0 + 1e-14), "{n} {hits:?}");
        let lost: f64 = hits.iter().map(|hit| hit.energy_lost).sum();
        assert!((energy(&state.1) - energy(&after) - lost).abs() <= 1e-14 * energy(&state.1), "{n}");
    }
}

#[test]
fn painleves_rod_is_stopped_by_an_impulse_where_that_is_wanted() {
    let (mu, angle, slip) = (2.0, 2.0_f64.atan(), 3.0);
    let kernel = rod(mu);
    let state = ([0.0, angle.sin(), angle].into(), V::from([slip, 0.0, 0.0]));
    let start = || ContactRun::new(&kernel).adaptive(1e-9, 1e-9);
    let error = start().run(state.0, state.1, 0.0..1e-3).err().unwrap();
    assert_eq!((error.time, error.kind), (0.0, ContactErrorKind::Inconsistent));

    let run = start().impact_without_collision().run(state.0, state.1, 0.0..1e-3).unwrap();
    let EventKind::Impact(hit) = run.events()[0].kind else { panic!("{:?}", run.events()) };
    // Of D at the angle: the impulse that stops the slip and leaves the gap closed, within the cone since p < 0.
    let (s, c) = angle.sin_cos();
    let (a, b, d) = (1.0 + 3.0 * c * c, 3.0 * s * c, 1.0 + 3.0 * s * s);
    assert!(a - mu * b < 0.0);
    let normal = slip * b / (a * d - b * b);
    assert!((hit.impulse[0] - normal).abs() < 1e-14 && (hit.impulse[1] + normal * a / b).abs() < 1e-14, "{hit:?}");
    assert!(hit.after[0].abs() < 1e-15 && hit.after[1].abs() < 1e-15, "{hit:?}");
    assert!((hit.energy_lost - 0.5 * slip * slip * a / (a * d - b * b)).abs() < 1e-14);
    assert!(run.modes(0.0).unwrap() != [Mode::Slides([1.0, 0.0, 0.0])]);

    // From all angles on, also where the motion leads to such states.
    for n in 1..300 {
        let angle = f64::from(n) * 0.005;
        let run = ContactRun::new(&kernel).adaptive(1e-8, 1e-8).impact_without_collision();
        let (run, error) = run.attempt([0.0, angle.sin(), angle].into(), [slip, 0.0, 0.0].into(), 0.0..0.05);
        assert!(error.is_none(), "{angle} {error:?}");
        let energies: Vec<f64> = run.iter().map(|s| kernel.energy(s.t, &s.q, &s.z)).collect();
        // Steps with errors of 1e-8 of their terms, at energies of about 15.
        assert!(energies.windows(2).all(|pair| pair[1] <= pair[0] + 1.5e-6), "{angle}");
    }
}
