//! A tippe top with drilling friction and without: runs of seconds at small tolerances.

use std::f64::consts::FRAC_PI_2;

use gauss_contact::{ContactRun, EventKind, Mode};
use gauss_runtime::nalgebra::Unit;
use gauss_runtime::prelude::*;
use gauss_tables::{RunTable, Table};

/// The tippe top of R. I. Leine & Ch. Glocker, *A set-valued force law for spatial Coulomb–Contensou friction*,
/// European Journal of Mechanics A 22 (2003) 193–216: two spheres about points of its axis, on patches of a radius of
/// 0.5 mm. Here friction is the ellipsoid of a uniform pressure on them.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(top, position = pose.position, rotation = pose.rotation, mass = 6e-3, inertia = [8e-7, 8e-7, 7e-7]),
    point(center, body = top, at = [0, 0, 3e-3]),
    point(tip, body = top, at = [0, 0, 1.6e-2]),
    contact(head, point = center, radius = 1.5e-2, friction = mu, drilling = 2 * patch / 3),
    contact(stem, point = tip, radius = 5e-3, friction = mu, drilling = 2 * patch / 3),
)]
struct TippeTop {
    mu: f64,
    patch: f64,
    #[gauss(gravity)]
    g: f64,
}

/// A run of the tippe top from its published start, with the tilt of its axis at a time.
fn spun(kernel: &TippeTopKernel, until: f64) -> gauss_contact::ContactTrajectory<'_, TippeTopKernel> {
    let tilt: f64 = 0.1;
    let (sine, cosine) = (0.5 * tilt).sin_cos();
    let rotation = Unit::new_unchecked(Quaternion::new(cosine, sine, 0.0, 0.0));
    // 1.2015e-2 to the digits that are printed.
    let height = 1.5e-2 - 3e-3 * tilt.cos();
    let start = Isometry3::from_parts(Vector3::new(0.0, 0.0, height).into(), rotation);
    let z = SVector::from([0.0, 0.0, 0.0, 0.0, 0.0, 180.0]);
    ContactRun::new(kernel).adaptive(1e-9, 1e-9).run(start, z, 0.0..until).unwrap()
}

fn tilt(run: &gauss_contact::ContactTrajectory<'_, TippeTopKernel>, t: f64) -> f64 {
    (run.at(t).unwrap().q.rotation * Vector3::z()).z.clamp(-1.0, 1.0).acos()
}

#[test]
fn a_tippe_top_turns_over_and_stands_on_its_stem() {
    let kernel = TippeTop { mu: 0.3, patch: 5e-4, g: 9.81 }.kernel().unwrap();
    let run = spun(&kernel, 2.0);
    let [strikes, leaves, closes] = run.events() else { panic!("{:?}", run.events()) };
    assert!(matches!(strikes.kind, EventKind::Impact(_)) && strikes.name == "stem");
    assert!(leaves.kind == EventKind::Leaves && leaves.name == "head");
    assert!(closes.kind == EventKind::Closes && closes.name == "stem");
    // (own) by tolerances of 1e-8 to 1e-11, whose errors are 93 times as large: directions of slip near zero are known
    // to speeds of the tolerance.
    assert!((strikes.time - 1.373_317_717).abs() < 2e-7, "{}", strikes.time);
    // It goes over the equator, and stands from then on.
    assert!(tilt(&run, 0.0) < 0.11 && tilt(&run, 0.9) < FRAC_PI_2 && tilt(&run, 1.05) > FRAC_PI_2);
    assert!((15..=20).all(|k| tilt(&run, 0.1 * f64::from(k)) > 2.9));
    assert_eq!(run.modes(1.9).unwrap()[0], Mode::Open);
    // The sense of its spin in space is kept, that about its axis is reversed.
    let end = run.last().unwrap();
    assert!(end.z[5] < -90.0 && (end.q.rotation * Vector3::new(end.z[3], end.z[4], end.z[5])).z > 90.0);
    let table: RunTable<TippeTopKernel> = Table::new(run.at_times([0.5]).unwrap());
    let table = table.contacts(&kernel, |s| Some(*run.forces(s.t).ok()?));
    let names: Vec<&str> = table.names().filter(|name| name.starts_with("head")).collect();
    let friction = ["head friction 1", "head friction 2", "head drilling"];
    assert_eq!(names[2..], ["head slip 1", friction[0], "head slip 2", friction[1], "head spin", friction[2]]);
    let of = |name: &str| table.get(name).unwrap()[0];
    // All the friction there is, together.
    let size = friction.iter().map(|name| of(name).powi(2)).sum::<f64>().sqrt();
    assert!((size / (0.3 * of("head force")) - 1.0).abs() < 1e-12, "{size}");
    // Energy falls; where it comes from is known to the errors of steps, 1e-9 of 12 mJ each.
    let energies: Vec<f64> = run.iter().map(|s| kernel.energy(s.t, &s.q, &s.z)).collect();
    assert!(energies.windows(2).all(|pair| pair[1] <= pair[0] + 1e-10 * pair[0]));
    let balance = run.energy_balance().unwrap();
    assert!(balance.residual().abs() < 1e-6 * energies[0] && balance.contacts < -5e-3, "{balance}");
}

#[test]
fn without_drilling_a_tippe_top_does_not_turn_over() {
    let kernel = TippeTop { mu: 0.3, patch: 0.0, g: 9.81 }.kernel().unwrap();
    let run = spun(&kernel, 2.0);
    // It rolls after 36 ms, and then nothing takes its energy any more.
    let [rolls] = run.events() else { panic!("{:?}", run.events()) };
    assert!(rolls.kind == EventKind::Sticks && rolls.time < 0.05, "{rolls:?}");
    assert!((0..=20).all(|k| tilt(&run, 0.1 * f64::from(k)) < 0.11));
    let energy = |t: f64| run.at(t).map(|s| kernel.energy(t, &s.q, &s.z)).unwrap();
    assert!((energy(2.0) / energy(0.1) - 1.0).abs() < 1e-7);
}
