//! The example `remus100`: its physics against equations written by hand, a closed form, and the published sums.

use gauss_runtime::prelude::*;

use crate::fossen::Fossen;
use crate::manoeuvres::{EVERY, Flight, Leg, Manoeuvre, Pilot, Steering, distance, fly};
use crate::vehicle::{Remus, RemusByAngles, Table};

fn table() -> Table {
    Table::published().unwrap()
}

fn poses(flight: &Flight) -> Vec<Isometry3<f64>> {
    flight.moments.iter().map(|m| m.pose).collect()
}

#[test]
fn accelerations_are_those_of_equations_written_by_hand() {
    let table = table();
    let kernel = Remus::from_table(&table).unwrap().kernel().unwrap();
    let by_hand = Fossen::new(&table, table.number("buoyancy_N").unwrap()).unwrap();
    // Twists and inputs of every sign, angles all around.
    for n in 0..200 {
        let wave = |k: u32, size: f64| size * (f64::from(n) * (1.0 + 0.37 * f64::from(k))).sin();
        let twist = Vector6::from_fn(|k, _| wave(k as u32, if k < 3 { 2.0 } else { 1.0 }));
        let (roll, pitch, yaw) = (wave(6, 3.0), wave(7, 1.5), wave(8, 3.0));
        let inputs = [wave(9, 0.3), wave(10, 0.3), wave(11, 8.0)];
        let pose = Isometry3::from_parts(
            Translation3::new(3.0, -2.0, 5.0),
            UnitQuaternion::from_euler_angles(roll, pitch, yaw),
        );
        let found = kernel.acceleration(0.0, &pose, &twist, &SVector::from(inputs));
        let expected = by_hand.acceleration(&twist, [roll, pitch], inputs);
        // Forces of up to 1000 N and N m in sums of some 30 terms; the least inertia is that of rolling, 0.25 kg m²,
        // and lets their rounding through fourfold.
        let rounding = 30.0 * f64::EPSILON * 1000.0 * 4.0;
        assert!((found - expected).amax() <= rounding, "{found} {expected}");
    }
}

#[test]
fn two_charts_and_the_equations_by_hand_turn_and_dive_alike() {
    let table = table();
    let kernel = Remus::from_table(&table).unwrap().kernel().unwrap();
    let by_angles = RemusByAngles::from_table(&table).unwrap().kernel().unwrap();
    let by_hand = Fossen::new(&table, table.number("buoyancy_N").unwrap()).unwrap();
    for mut manoeuvre in [Manoeuvre::turn(&table).unwrap(), Manoeuvre::dive(&table).unwrap()] {
        manoeuvre.legs[0].seconds = 2.0;
        manoeuvre.legs[1].seconds = 6.0;
        let flight = fly(&kernel, &manoeuvre).unwrap();
        let [fine, coarse] = [40, 20].map(|steps| by_hand.fly(&manoeuvre, steps));
        // The error of the Runge–Kutta method is below what halving the steps changes.
        let change = distance(&fine, &coarse);
        let apart = distance(&poses(&flight), &fine);
        assert!(apart <= change && change < 1e-6, "{}: {apart:e} {change:e}", manoeuvre.name);
        // Both charts are integrated to 1e-11 a step, some 1000 steps, in a motion whose deviations grow by e in a
        // second at most before the turn limits them.
        let other = fly(&by_angles, &manoeuvre).unwrap();
        assert!(distance(&poses(&flight), &poses(&other)) < 1e-8, "{}", manoeuvre.name);
        let [energy, work] = flight.balance;
        // The same tolerance on energies of some 50 J.
        assert!((energy - work).abs() < 1e-8, "{}: {energy} {work}", manoeuvre.name);
    }
}

#[test]
fn a_straight_run_has_its_closed_form() {
    let table = table();
    let published = Remus::from_table(&table).unwrap();
    let [thrust, drag] = ["propeller/Xprop", "drag/Xuu"].map(|path| table.number(path).unwrap().abs());
    // Nothing turns the vehicle when G lies on the line of the thrust and the propeller has no torque.
    let center = Vector3::zeros();
    let kernel = Remus { displaced: published.mass, center, lever: 0.0, ..published }.kernel().unwrap();
    let manoeuvre = Manoeuvre {
        name: "without rolling",
        start: (Isometry3::translation(0.0, 0.0, 2.0), Vector6::zeros()),
        legs: vec![Leg { seconds: 30.0, steering: Steering::Heading(0.0), depth: 2.0 }],
        pilot: Pilot { level: [0.0; 2], thrust },
    };
    let flight = fly(&kernel, &manoeuvre).unwrap();
    assert_eq!(flight.moments.len(), (30.0 / EVERY) as usize + 1);
    let surge = published.mass - table.number("added_mass_derivatives/Xudot").unwrap();
    for moment in &flight.moments {
        let time = moment.t * (thrust * drag).sqrt() / surge;
        let (speed, way) = ((thrust / drag).sqrt() * time.tanh(), surge / drag * time.cosh().ln());
        // 1e-11 a step, less than 1000 steps.
        assert!((moment.twist[0] - speed).abs() < 1e-8, "{} s: {} {speed}", moment.t, moment.twist[0]);
        assert!((moment.pose.translation.x - way).abs() < 1e-8, "{} s", moment.t);
        assert_eq!(moment.inputs, [0.0, 0.0, thrust]);
    }
    // As built it pitches a little while it speeds up, and ends at the same speed: 4.8 time constants, 1 − tanh 4.8 =
    // 1e-4.
    let neutral = Remus { displaced: published.mass, ..published }.kernel().unwrap();
    let flight = fly(&neutral, &Manoeuvre::straight(&table).unwrap()).unwrap();
    let end = &flight.moments[flight.moments.len() - 1];
    assert!((end.twist[0] / (thrust / drag).sqrt() - 1.0).abs() < 2e-4, "{}", end.twist[0]);
    assert_eq!(end.powers.len(), 5);
}

#[test]
fn parts_add_up_to_the_published_sums() {
    let table = table();
    let n = |path: &str| table.number(path).unwrap();
    let cross = |name: &str| n(&format!("published_cross_terms/{name}"));
    let sums = [
        ("Yur", cross("Yura") + n("fins/Yurf")),
        ("Zuq", cross("Zuqa") + n("fins/Zuqf")),
        ("Muw", cross("Muwa") + n("lift/Muwb") + n("fins/Muwf")),
        ("Nuv", -cross("Muwa") + n("lift/Nuvb") + n("fins/Nuvf")),
        ("Muq", cross("Muqa") + n("fins/Muqf")),
        ("Nur", cross("Muqa") + n("fins/Nurf")),
    ];
    for (name, sum) in sums {
        let printed = n(&format!("combined/{name}"));
        // Printed with three digits at most. N_uva = −M_uwa and N_ura = M_uqa in a body of revolution.
        assert!((sum - printed).abs() <= 0.0501, "{name}: {sum} {printed}");
    }
}
