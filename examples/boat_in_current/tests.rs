//! The example `boat_in_current`: drifting, and Galilei's principle, against equations written by hand and closed
//! forms.

use gauss_runtime::prelude::*;

use crate::boat::{Boat, BoatKernel, in_still_water, winding};

type Speeds = SVector<f64, 3>;

fn tidal() -> Boat {
    let (stream, tide) = (Vector3::new(0.05, 0.15, 0.0), Vector3::new(0.1, -0.2, 0.0));
    Boat { stream, tide, frequency: 0.3, ..Boat::cyber_ship() }
}

/// Moving with the water at t = 0.
fn entrained(boat: &Boat, heading: f64) -> (Isometry2<f64>, Speeds) {
    let q = Isometry2::rotation(heading);
    let c = q.rotation.inverse() * boat.stream.xy();
    (q, Speeds::from([c.x, c.y, 0.0]))
}

fn end(
    boat: &Boat,
    (q, z): (Isometry2<f64>, Speeds),
    seconds: f64,
    input: impl Fn(f64, &Isometry2<f64>) -> [f64; 2],
) -> Sample<BoatKernel> {
    let kernel = boat.kernel().unwrap();
    let run = Simulation::new(&kernel).input(|t, q, _| SVector::from(input(t, q))).adaptive(1e-11, 1e-12);
    run.run_to_end(q, z, 0.0..seconds).unwrap().sample
}

fn adrift(_: f64, _: &Isometry2<f64>) -> [f64; 2] {
    [0.0; 2]
}

#[test]
fn what_floats_stays_with_the_water() {
    for heading in [0.0, 0.7, 2.5] {
        for boat in [tidal(), Boat { tide: Vector3::zeros(), ..tidal() }] {
            let last = end(&boat, entrained(&boat, heading), 30.0, adrift);
            // 1e-11 a step, some hundred steps.
            assert!((last.q.translation.vector - boat.drift(30.0).xy()).norm() < 1e-8, "{heading}");
            assert!((last.q.rotation.angle() - heading).abs() < 1e-9, "{heading}");
        }
    }
}

#[test]
fn without_drag_the_water_takes_along_its_share() {
    // (m + a) u̇ = (ρV + a) ċ along an axis of the added mass, through G.
    let nothing = Matrix6::zeros();
    let still =
        Boat { linear: nothing, quadratic: nothing, xuuu: 0.0, yrv: 0.0, yvr: 0.0, nrv: 0.0, nvr: 0.0, ..tidal() };
    let (along, origin) = (Vector3::new(0.2, 0.0, 0.0), Vector3::zeros());
    for mass in [11.9, 23.8, 60.0] {
        let boat = Boat { mass, center: origin, buoyancy: origin, stream: origin, tide: along, ..still };
        let last = end(&boat, (Isometry2::identity(), Speeds::zeros()), 20.0, adrift);
        let share = (23.8 + 2.0) / (mass + 2.0);
        // 1e-11 a step, some hundred steps.
        assert!((last.q.translation.vector.x - share * boat.drift(20.0).x).abs() < 1e-8, "{mass}");
        assert!((last.z[0] - share * 0.2 * (0.3_f64 * 20.0).sin()).abs() < 1e-9, "{mass}");
    }
}

#[test]
fn a_stream_carries_the_motion_in_still_water_along() {
    let [fine, coarse] = [40, 20].map(|steps| in_still_water(0.3, winding, 30, steps));
    // The error of the method of order 4 is below what halving the steps changes.
    let change = (fine[30][0] - coarse[30][0]).hypot(fine[30][1] - coarse[30][1]).max(1e-8);
    for boat in
        [Boat { frequency: 0.0, stream: Vector3::zeros(), ..tidal() }, Boat { frequency: 0.0, ..tidal() }, tidal()]
    {
        let last = end(&boat, entrained(&boat, 0.3), 30.0, |t, q| winding(t, q.rotation.angle()));
        let place = last.q.translation.vector - boat.drift(30.0).xy();
        let apart = (place.x - fine[30][0]).hypot(place.y - fine[30][1]);
        assert!(apart <= change && change < 1e-6, "{apart:e} {change:e}");
        assert!((last.q.rotation.angle() - fine[30][2]).abs() < 1e-6);
    }
}

#[test]
fn coefficients_that_feed_energy_are_named_and_thrust_balances_drag() {
    let boat = Boat::cyber_ship();
    assert_eq!(boat.warnings().iter().count(), 1);
    let thrust = boat.thrust(0.4);
    let kernel = boat.kernel().unwrap();
    let (q, z) = (Isometry2::identity(), Speeds::from([0.4, 0.0, 0.0]));
    let change = kernel.acceleration(0.0, &q, &z, &SVector::from([thrust, 0.0]));
    // Forces of about 1 N on 26 kg.
    assert!(change.amax() < 10.0 * f64::EPSILON / 26.0, "{change}");
}
