//! The claims of the example `rattleback`: a stone that friction holds is one that rolls by constraints; less friction
//! lets it slide, which takes energy, and still less lets it forget to turn back.

use gauss_contact::{EventKind, Mode};
use gauss_runtime::prelude::*;

use crate::stone::{AXES, PRODUCT, Rattleback, pose, stone};
use crate::table::{OnTable, OnTableKernel, obliquity, spun, vertical};

fn on_table(mu: f64) -> OnTableKernel {
    OnTable { stone: stone(PRODUCT), a: AXES.into(), mu, g: 9.81 }.kernel().unwrap()
}

fn tilted() -> UnitQuaternion<f64> {
    UnitQuaternion::from_euler_angles(0.009, 0.009, 0.0)
}

#[test]
fn what_friction_holds_rolls_as_by_constraints() {
    let rolling = Rattleback { stone: stone(PRODUCT), a: AXES.into(), g: 9.81 }.kernel().unwrap();
    let kernel = on_table(1.0);
    for spin in [5.0, -5.0] {
        let start = (tilted(), SVector::zeros());
        let path = Simulation::new(&rolling).adaptive(1e-11, 1e-11);
        let path = path.run(start, Vector3::new(0.0, 0.0, spin), 0.0..5.0).unwrap();
        let run = spun(&kernel, tilted(), spin, 1e-11).unwrap();
        assert!(run.events().is_empty() && run.modes(2.0).unwrap() == [Mode::Sticks], "{:?}", run.events());
        for sample in path.iter() {
            let state = run.at(sample.t).unwrap();
            // Some thousand steps of tolerance 1e-11, and 40 oscillations in which errors grow with the rattling, by
            // a factor of about ten (its angle grows from 0.5° to 3°).
            let (place, off) = (pose(&sample.q), 1e-6);
            assert!(state.q.rotation.angle_to(&place.rotation) < off, "{}", state.q.rotation.angle_to(&place.rotation));
            assert!((state.q.translation.vector - place.translation.vector).norm() < off);
            // The multipliers of the constraints are the friction along k₁ and k₂.
            let held = rolling.multipliers(sample.t, &sample.q, &sample.z, &());
            let vectors = run.forces(sample.t).unwrap().vectors();
            let friction = vectors[0].force;
            let near = 1e-4 * 9.81;
            assert!((friction.x - held[0]).abs() < near && (friction.y - held[1]).abs() < near, "{friction} {held}");
        }
        let end = run.last().unwrap();
        assert!(vertical(&end) < -3.5, "{}", vertical(&end));
    }
}

#[test]
fn what_slides_loses_energy() {
    let mut ends = Vec::new();
    for mu in [0.4, 0.1] {
        let kernel = on_table(mu);
        let run = spun(&kernel, tilted(), 5.0, 1e-7).unwrap();
        assert!(run.events().iter().any(|event| matches!(event.kind, EventKind::Slides(_))));
        // Friction is in the cone, to rounding of the quotient of two forces.
        assert!(run.iter().all(|s| obliquity(&run, s.t).unwrap() < mu * (1.0 + 1e-12)));
        let energies: Vec<f64> = run.iter().map(|s| kernel.energy(s.t, &s.q, &s.z)).collect();
        // Of each step up to the tolerance of 1e-7, of energies of a tenth of a joule.
        assert!(energies.windows(2).all(|pair| pair[1] < pair[0] + 1e-7), "{mu}");
        assert!(energies[energies.len() - 1] < energies[0] - 1e-3);
        ends.push(vertical(&run.last().unwrap()));
    }
    assert!(ends[0] < -2.0 && ends[1] > 0.0, "{ends:?}");
}
