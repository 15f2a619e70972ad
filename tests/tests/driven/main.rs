//! Driven coordinates of compiled structs: forces by the names of motions, runs with their energy, lanes, other
//! scalars. `crates/gauss-jit/tests/motions` has the equations and what is refused.

use gauss_runtime::constraint::ConstrainedSystem;
use gauss_runtime::frames::FrameName;
use gauss_runtime::monitor::power_balance;
use gauss_runtime::prelude::*;

macro_rules! crane {
    ($name:ident, $($clauses:tt)+) => {
        #[derive(GaussDynamics)]
        #[gauss(
            coordinates(trolley, angle, hoist),
            input(wind),
            body(carriage, position = [trolley, 0, 0], mass = 2, inertia = 1),
            body(bob, parent = carriage, rotation = rotation_y(angle), position = [0, 0, 0], mass = 0.7,
                 center_of_mass = [0.1, 0, -l], inertia_about_center_of_mass = [0.02, 0.01, 0.02]),
            body(hook, parent = bob, position = [0, 0, -hoist], mass = 0.3, inertia = 0.1),
            spring(rope, along = hoist - l, stiffness = 90, damping = 0.5),
            force(body = hook, value = [wind, 0, 0], axes = observer),
            linearize, $($clauses)+
        )]
        struct $name<T> {
            l: T,
            a: T,
            w: T,
            #[gauss(gravity)]
            g: T,
        }
    };
}

crane!(Driven, motion(trolley = a * sin(w * t)));
crane!(Constrained, constraint(position = trolley - a * sin(w * t)));

fn driven<T: Real>() -> DrivenKernel<T> {
    let [l, a, w, g] = [0.4, 0.3, 2.5, 9.81].map(T::from_f64);
    Driven { l, a, w, g }.kernel().unwrap()
}

/// The multiplier of the constraint is the force, and the two accelerations are the same.
#[test]
fn a_driving_force_is_a_multiplier() {
    let own = driven::<f64>();
    let constrained = Constrained { l: 0.4, a: 0.3, w: 2.5, g: 9.81 }.kernel().unwrap();
    assert_eq!(DrivenKernel::<f64>::DOF, 2);
    assert_eq!(DrivenMotion::ALL.iter().map(|motion| motion.name()).collect::<Vec<_>>(), ["trolley"]);
    for (t, [phi, hoist, phi_rate, hoist_rate]) in [(0.3, [0.4, 0.5, 1.0, -0.3]), (-0.9, [2.0, 0.3, -2.0, 0.6])] {
        let (q, z, wind) = ([phi, hoist].into(), [phi_rate, hoist_rate].into(), [0.8].into());
        let (sine, cosine) = f64::sin_cos(2.5 * t);
        let rate = 0.75 * cosine;
        let (q_all, z_all) = ([0.3 * sine, phi, hoist].into(), [rate, phi_rate, hoist_rate].into());
        let found = own.acceleration(t, &q, &z, &wind);
        let expected = constrained.acceleration(t, &q_all, &z_all, &wind);
        let multiplier = constrained.multipliers(t, &q_all, &z_all, &wind)[0];
        let force = own.driving_forces(t, &q, &z, &wind)[DrivenMotion::trolley];
        // A matrix of condition below a hundred, some fifty products.
        let size = 5e3 * f64::EPSILON * (1.0 + expected.amax() + multiplier.abs());
        assert!((found[0] - expected[1]).abs() <= size && (found[1] - expected[2]).abs() <= size, "{found} {expected}");
        assert!((force.force - multiplier).abs() <= size, "{force:?} {multiplier}");
        assert!((force.power - multiplier * rate).abs() <= size, "{force:?}");
        let again = own.driving_forces_at(t, &q, &z, &found, &wind)[DrivenMotion::trolley];
        assert_eq!(again, force);
    }
}

/// Lanes and single precision: each lane to rounding what it is alone.
#[test]
fn lanes_and_other_scalars() {
    type Four = Lanes<f64, 4>;
    let (packed, single, coarse) = (driven::<Four>(), driven::<f64>(), driven::<f32>());
    let lane = |k: usize| 0.1 + 0.3 * k as f64;
    let pack = |scale: f64| Four::from_fn(|k| scale * lane(k));
    let (q, z) = ([pack(1.0), pack(0.9)].into(), [pack(-1.0), pack(0.2)].into());
    let found = packed.driving_forces(pack(0.7), &q, &z, &[pack(0.4)].into())[DrivenMotion::trolley];
    for k in 0..4 {
        let x = lane(k);
        let (q, z) = ([x, 0.9 * x].into(), [-x, 0.2 * x].into());
        let alone = single.driving_forces(0.7 * x, &q, &z, &[0.4 * x].into())[DrivenMotion::trolley];
        let size = 500.0 * f64::EPSILON * (10.0 + alone.force.abs());
        assert!((found.force.lane(k) - alone.force).abs() <= size, "{found:?} {alone:?}");
        assert!((found.power.lane(k) - alone.power).abs() <= size, "{found:?} {alone:?}");
        let (q, z) = (q.cast::<f32>(), z.cast::<f32>());
        let input = [0.4 * x as f32].into();
        let rough = coarse.driving_forces(0.7 * x as f32, &q, &z, &input)[DrivenMotion::trolley];
        let size = 500.0 * f64::from(f32::EPSILON) * (10.0 + alone.force.abs());
        assert!((f64::from(rough.force) - alone.force).abs() <= size, "{rough:?} {alone:?}");
    }
}

/// Along a run the energy changes by the work of the drive, of the wind and of the damper.
#[test]
fn a_run_with_its_energy() {
    let kernel = driven::<f64>();
    let state = DrivenState { angle: 0.5, hoist: 0.4, ..Default::default() };
    let wind = |t: f64, _: &_, _: &_| SVector::from([0.3 * t.cos()]);
    let run = Simulation::new(&kernel).input(wind).adaptive(1e-10, 1e-10);
    let run = run.run(state.q(), state.z(), 0.0..4.0).unwrap();
    let balance = power_balance(&kernel, &run, wind);
    assert!(balance.largest_residual() < 1e-7, "{}", balance.largest_residual());
    // Work of drive, wind and damper by Simpson's rule, whose error at these steps is below 1e-6.
    let count = 4000;
    let power = |n: usize| {
        let t = 4.0 * n as f64 / count as f64;
        let state = run.at(t).unwrap();
        let input = wind(t, &state.q, &state.z);
        let drive = kernel.driving_forces(t, &state.q, &state.z, &input)[DrivenMotion::trolley];
        let [(phi, hoist), (turn, down)] = [&state.q, &state.z].map(|pair| (pair[0], pair[1]));
        // rotation_y(φ) takes [0, 0, −h] to [−h sin φ, 0, −h cos φ].
        let hook = 0.75 * (2.5 * t).cos() - down * phi.sin() - hoist * turn * phi.cos();
        drive.power + input[0] * hook - 0.5 * down * down
    };
    let weight = |n: usize| {
        if n == 0 || n == count {
            1.0
        } else if n % 2 == 1 {
            4.0
        } else {
            2.0
        }
    };
    let work: f64 = (0..=count).map(|n| weight(n) * power(n)).sum::<f64>() * 4.0 / count as f64 / 3.0;
    let last = run.last();
    let gain = kernel.energy(last.t, &last.q, &last.z) - kernel.energy(0.0, &state.q(), &state.z());
    assert!((work - gain).abs() < 1e-6 && gain.abs() > 1e-2, "{work} {gain}");
    // Momenta have a part that is there without speeds.
    let p = kernel.momentum(last.t, &last.q, &last.z);
    assert!((kernel.velocity(last.t, &last.q, &p) - last.z).amax() < 1e-13 * (1.0 + last.z.amax()));
    assert!(kernel.momentum(0.0, &state.q(), &SVector::zeros()).amax() > 0.1);
}

/// Derivatives by the state and time against central differences.
#[test]
fn derivatives_at_a_state() {
    let kernel = driven::<f64>();
    let (t, q, z, u) = (0.4, SVector::from([0.3, 0.5]), SVector::from([0.7, -0.2]), SVector::from([0.6]));
    let linear = kernel.linearize(t, &q, &z, &u);
    let step = 1e-5;
    let rate = |k: usize, h: f64| {
        let unit = |j: usize| if k == j { h } else { 0.0 };
        let q = q + SVector::from([unit(0), unit(1)]);
        let z = z + SVector::from([unit(2), unit(3)]);
        kernel.acceleration(t, &q, &z, &u)
    };
    for k in 0..4 {
        let column = (rate(k, step) - rate(k, -step)) / (2.0 * step);
        for i in 0..2 {
            // The square of the step times third derivatives of some thousand.
            let found = linear.by_state[(2 + i, k)];
            assert!((found - column[i]).abs() < 1e-6, "{i} {k}: {found} {}", column[i]);
        }
    }
}

/// The example of the guide.
mod kapitza {
    use super::*;

    #[derive(GaussDynamics)]
    #[gauss(
        coordinates(pivot, angle),
        body(rod, position = [0, 0, pivot], rotation = rotation_y(angle), mass = m, center_of_mass = [0, 0, -l],
             inertia_about_center_of_mass = 0),
        motion(pivot = a * cos(w * t)),
    )]
    struct Kapitza {
        m: f64,
        l: f64,
        a: f64,
        w: f64,
        #[gauss(gravity)]
        g: f64,
    }

    #[test]
    fn stands_while_it_is_shaken() {
        let of = |w: f64| Kapitza { m: 0.1, l: 0.2, a: 0.02, w, g: 9.81 }.kernel().unwrap();
        let state = KapitzaState { angle: core::f64::consts::PI - 0.2, ..Default::default() };
        // a²ω² is 16, then 3.2: it stands above 2 g l = 3.9.
        let lean = |w: f64| {
            let kernel = of(w);
            let run = Simulation::new(&kernel).adaptive(1e-9, 1e-9).run(state.q(), state.z(), 0.0..2.0).unwrap();
            (0..=200)
                .map(|n| (run.at(0.01 * f64::from(n)).unwrap().q[0] - core::f64::consts::PI).abs())
                .fold(0.0, f64::max)
        };
        let [stands, falls] = [200.0, 90.0].map(lean);
        println!("{stands} {falls}");
        assert!(stands < 0.3 && falls > 1.0, "{stands} {falls}");
        let force =
            of(200.0).driving_forces(0.0, &[core::f64::consts::PI].into(), &[0.0].into(), &())[KapitzaMotion::pivot];
        assert!(
            (force.force - 0.1 * (9.81 - 0.02 * 200.0 * 200.0)).abs() < 1e-12 && force.power.abs() < 1e-12,
            "{force:?}"
        );
    }
}
