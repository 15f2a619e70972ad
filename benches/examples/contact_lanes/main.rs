//! Steps of eight states at once beside eight single ones.
//!
//! `RUSTFLAGS="-C target-cpu=native" cargo run --release -p gauss-benches --example contact_lanes --features robots`
//!
//! A quadruped that stands (ANYmal of `contact_steps`), and crates that slide on their corners. Printed are
//! microseconds for a step of one state, alone and in lanes, by turns: the least of all batches of five steps, which a
//! busy machine leaves alone, and medians. After each batch all bits are compared.

use std::error::Error;
use std::time::Instant;

use gauss_benches::measure::Spread;
use gauss_contact::{ContactLanes, ContactStepper};
use gauss_runtime::prelude::*;
use gauss_runtime::simd::Packed;

/// A quadruped on spheres of 31 mm.
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(
    urdf = "../tests/robots/anymal.urdf", base = floating, gravity = 9.81,
    point(lf, body = LF_KFE_link, at = [0.033, 0.01305, -0.33797]),
    point(lh, body = LH_KFE_link, at = [-0.033, 0.01305, -0.33797]),
    point(rf, body = RF_KFE_link, at = [0.033, -0.01305, -0.33797]),
    point(rh, body = RH_KFE_link, at = [-0.033, -0.01305, -0.33797]),
    contact(lf_foot, point = lf, radius = 0.031, friction = mu),
    contact(lh_foot, point = lh, radius = 0.031, friction = mu),
    contact(rf_foot, point = rf, radius = 0.031, friction = mu),
    contact(rh_foot, point = rh, radius = 0.031, friction = mu),
)]
struct Anymal<T> {
    mu: T,
}

/// A crate on its corners.
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(hull, position = pose.position, rotation = pose.rotation, mass = m, inertia = m * a * a / 6),
    contact(table, point = hull.position, edges = [a, a, a], friction = mu),
)]
struct Crate<T> {
    m: T,
    a: T,
    mu: T,
    #[gauss(gravity)]
    g: T,
}

type Eight = wide::f64x8;

const STEP: f64 = 1e-3;
const BATCH: usize = 5;

/// Microseconds for a step of one state: alone, and in lanes.
struct Times {
    single: Vec<f64>,
    lanes: Vec<f64>,
    alone: f64,
}

fn times<K, W>(
    (single, wide): (&K, &W),
    starts: &[(K::Configuration, K::Speeds)],
    input: impl Fn(&ContactStepper<'_, K>) -> K::Input,
) -> Result<Times, Box<dyn Error>>
where
    K: ContactSystem<Scalar = f64>,
    W: gauss_contact::LanesOf<K>,
{
    let stepper = |(q, z): &(K::Configuration, K::Speeds)| ContactStepper::new(single, 0.0, *q, *z);
    let mut singles = starts.iter().map(stepper).collect::<Result<Vec<_>, _>>()?;
    let mut lanes = ContactLanes::of(wide, starts.iter().map(stepper).collect::<Result<Vec<_>, _>>()?)?;
    let mut times = Times { single: Vec::new(), lanes: Vec::new(), alone: 0.0 };
    let each = 1e6 / (BATCH * starts.len()) as f64;
    let count = 400;
    for _ in 0..count {
        let clock = Instant::now();
        for _ in 0..BATCH {
            for stepper in &mut singles {
                let input = input(stepper);
                stepper.step(STEP, &input)?;
            }
        }
        times.single.push(each * clock.elapsed().as_secs_f64());
        let clock = Instant::now();
        for _ in 0..BATCH {
            let mut inputs = W::Input::repeat(&input(&lanes.steppers()[0]));
            for lane in 1..starts.len() {
                inputs.replace(lane, &input(&lanes.steppers()[lane]));
            }
            let failed = lanes.step(STEP, &inputs).iter().find_map(|outcome| outcome.clone().err());
            failed.map_or(Ok(()), Err)?;
        }
        times.lanes.push(each * clock.elapsed().as_secs_f64());
        for (a, b) in singles.iter().zip(lanes.steppers()) {
            let numbers = |stepper: &ContactStepper<'_, K>| -> Vec<u64> {
                let z = stepper.speeds();
                (0..K::Speeds::DIM).map(|i| z.component(i).to_bits()).collect()
            };
            assert!(numbers(a) == numbers(b), "a lane has other bits");
        }
    }
    times.alone = lanes.alone() as f64 / (count * BATCH * starts.len()) as f64;
    Ok(times)
}

fn report(name: &str, times: Times) {
    let Times { single, lanes, alone } = times;
    let least = |times: &[f64]| times.iter().copied().fold(f64::INFINITY, f64::min);
    let (least_single, least_lanes) = (least(&single), least(&lanes));
    let [single, lanes] = [single, lanes].map(Spread::of);
    println!(
        "{name}: {least_single:.2} µs a step alone, {least_lanes:.2} in eight lanes: {:.2} times the throughput (medians \
         {:.2}, {:.2}); {:.1} % of the steps of lanes alone",
        least_single / least_lanes,
        single.median,
        lanes.median,
        100.0 * alone
    );
}

fn main() -> Result<(), Box<dyn Error>> {
    let (single, wide) = (Anymal { mu: 0.8 }.kernel()?, Anymal { mu: Eight::splat(0.8) }.kernel()?);
    let leg = |side: f64| [0.0, 0.6 * side, -1.1 * side];
    let angles: Vec<f64> = [1.0, -1.0, 1.0, -1.0].into_iter().flat_map(leg).collect();
    let angles = SVector::<f64, 12>::from_column_slice(&angles);
    // On its feet, pushed a little: each in another direction.
    let q = (Isometry3::translation(0.0, 0.0, 0.6), angles);
    let gaps = single.gaps(0.0, &q);
    let q = (Isometry3::translation(0.0, 0.0, 0.6 - gaps.min()), angles);
    let start = |i: usize| {
        let mut z = SVector::<f64, 18>::zeros();
        (z[3], z[4]) = ((i as f64).sin() * 0.05, (i as f64).cos() * 0.05);
        (q, z)
    };
    let starts: Vec<_> = (0..8).map(start).collect();
    let law = |stepper: &ContactStepper<'_, AnymalKernel<f64>>| {
        (angles - stepper.configuration().1) * 200.0 - stepper.speeds().fixed_rows::<12>(6) * 4.0
    };
    report("ANYmal", times((&single, &wide), &starts, law)?);

    fn of<T: Real>() -> Crate<T> {
        let f = T::from_f64;
        Crate { m: f(2.0), a: f(0.4), mu: f(0.02), g: f(9.81) }
    }
    let (single, wide) = (of::<f64>().kernel()?, of::<Eight>().kernel()?);
    let slides = |i: usize| {
        let speeds = SVector::from([3.0 + 0.1 * i as f64, 0.1 * i as f64, 0.0, 0.0, 0.0, 0.2]);
        (Isometry3::translation(0.0, 0.0, 0.2), speeds)
    };
    let starts: Vec<_> = (0..8).map(slides).collect();
    report("crate", times((&single, &wide), &starts, |_| ())?);
    Ok(())
}
