//! The claims of the example `dry_friction`: the exact solution of a slider; energy and friction times way; what is
//! decided at rest.

use crate::model::{Arm, ArmKernel, SWINGS, Slider, SmoothArm};
use gauss_contact::{ContactRun, ContactTrajectory, EventKind, Mode};
use gauss_runtime::prelude::*;

const ARM: Arm = Arm { g: 9.81, f_shoulder: 0.8, f_elbow: 0.3 };
const LIMITS: [f64; 2] = [ARM.f_shoulder, ARM.f_elbow];

#[test]
fn a_slider_moves_as_its_exact_solution_says() {
    let slider = Slider::desk();
    let kernel = slider.kernel().unwrap();
    let end = SWINGS * slider.half_swing() + 1.0;
    let run = ContactRun::new(&kernel).adaptive(1e-12, 1e-12);
    let run = run.run(SVector::from([slider.exact(0.0)]), SVector::zeros(), 0.0..end).unwrap();
    // Nine times it turns, then it stays.
    assert_eq!(run.events().len(), 10);
    for (n, event) in run.events().iter().enumerate() {
        let at = run.at(event.time).unwrap();
        // Some hundred steps, each with an error of 1e-12 of a way of 0.1 m.
        assert!((at.q[0] - slider.exact(at.t)).abs() < 1e-10, "{n}: {at:?}");
        let turns = (n + 1) as f64 * slider.half_swing();
        assert!((event.time - turns).abs() < 1e-9 && at.z[0].abs() < 1e-14, "{n}: {at:?}");
        assert_eq!(event.kind == EventKind::Sticks, n == 9, "{event:?}");
    }
    let (stops, last) = (run.at(run.events()[9].time).unwrap(), run.last().unwrap());
    assert_eq!((last.q, last.z[0]), (stops.q, 0.0));
}

fn arm(kernel: &ArmKernel, end: f64) -> ContactTrajectory<'_, ArmKernel> {
    ContactRun::new(kernel).adaptive(1e-11, 1e-11).run([1.4, 0.9].into(), SVector::zeros(), 0.0..end).unwrap()
}

/// Between two events no rate changes its sign, so what friction takes is its size times how far each joint went.
#[test]
fn energy_is_lost_as_friction_times_way() {
    let kernel = ARM.kernel().unwrap();
    let run = arm(&kernel, 12.0);
    let mut alone = false;
    for part in run.segments() {
        let (from, to) = (part.trajectory().first(), part.trajectory().last());
        let way = to.q - from.q;
        let taken = LIMITS[0] * way[0].abs() + LIMITS[1] * way[1].abs();
        let lost = kernel.energy(from.t, &from.q, &from.z) - kernel.energy(to.t, &to.q, &to.z);
        // Some hundred steps at 1e-11 of some ten joules.
        assert!((lost - taken).abs() < 1e-8, "{from:?} {to:?}");
        alone |= part.modes()[1] == Mode::Sticks && part.modes()[0] != Mode::Sticks;
        for (mode, way) in part.modes().iter().zip(way.iter()) {
            match mode {
                Mode::Slides([along, ..]) => assert!(along * way > 0.0, "{from:?} {to:?}"),
                _ => assert_eq!(*way, 0.0),
            }
        }
    }
    assert!(alone, "{:?}", run.events());
    // At the end both rest, and friction holds the weight.
    assert_eq!(run.modes(12.0).unwrap(), [Mode::Sticks; 2]);
    let (last, held) = (run.last().unwrap(), *run.forces(12.0).unwrap());
    assert!((0..2).all(|k| held[k].abs() <= LIMITS[k]), "{held}");
    let pull = kernel.gauss_residual(12.0, &last.q, &last.z, &SVector::zeros(), &());
    assert!((pull - held).amax() < 1e-12 && last.z.amax() == 0.0, "{pull} {held}");
}

/// At rest the rates are those that make C + Σ f |ż| least, among all others.
#[test]
fn what_is_decided_at_rest_is_a_minimum() {
    let kernel = ARM.kernel().unwrap();
    let z = SVector::zeros();
    for n in 0..40 {
        let angle = 0.157 * f64::from(n);
        let q = SVector::from([angle.sin() * 1.5, 0.3 * angle]);
        let run = ContactRun::new(&kernel).adaptive(1e-9, 1e-9).run(q, z, 0.0..1e-9).unwrap();
        let dynamics = kernel.contact_dynamics(0.0, &q, &z, &());
        let rates = dynamics.acceleration + dynamics.response.columns * *run.forces(0.0).unwrap();
        let cost = |a: &SVector<f64, 2>| {
            kernel.constraint_function(0.0, &q, &z, a, &()) + LIMITS[0] * a[0].abs() + LIMITS[1] * a[1].abs()
        };
        for m in 0..36 {
            let (sin, cos) = (0.1745 * f64::from(m)).sin_cos();
            for size in [1e-3, 1e-1, 10.0] {
                let other = rates + SVector::from([cos, sin]) * size;
                // C is a difference of terms of some hundred.
                assert!(cost(&other) >= cost(&rates) - 1e-12, "{n}, {m}: {:?}", run.modes(0.0));
            }
        }
    }
}

/// Friction that is made smooth comes closer in proportion to its width, while the arm moves.
#[test]
fn smooth_friction_comes_closer() {
    let kernel = ARM.kernel().unwrap();
    let end = arm(&kernel, 0.6).last().unwrap().q;
    let distance = |creep: f64| {
        let smooth = SmoothArm { g: 9.81, f_shoulder: LIMITS[0], f_elbow: LIMITS[1], creep }.kernel().unwrap();
        let run = Simulation::new(&smooth).adaptive(1e-10, 1e-10);
        (run.run_to_end(SVector::from([1.4, 0.9]), SVector::zeros(), 0.0..0.6).unwrap().sample.q - end).amax()
    };
    let [wide, narrow] = [1e-2, 1e-4].map(distance);
    // A hundredth of the width: ε² ln ε while it slides, ε where it turns.
    assert!(narrow < 0.05 * wide, "{wide:e} {narrow:e}");
}
