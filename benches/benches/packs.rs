//! `cargo bench -p gauss-benches --bench packs`: methods with vectors of four numbers beside the same, number by
//! number.
//!
//! Structs of `f64` are written with packs where the derive's model of cost has them win by a tenth or more; structs of
//! any scalar are not, and differ in nothing else. So a ratio above one is a mistake of that model. *Chained*: each
//! call waits for the one before. That all bits agree is looked at before anything is timed. With
//! `RUSTFLAGS="-C target-cpu=native"`; where products are not fused there are no packs, and ratios are one.

use std::hint::black_box;

use gauss_benches::measure::{Spread, Way, times};
use gauss_benches::scenes::{G, about_pole, numbers};
use gauss_benches::states::of_a_body;
use gauss_runtime::prelude::*;

/// S2, of one scalar or of any.
macro_rules! heavy {
    ($name:ident [$($generics:tt)*] $t:ident) => {
        #[derive(Clone, Copy, GaussDynamics)]
        #[gauss(chart = left_invariant)]
        struct $name $($generics)* {
            #[gauss(mass)]
            mass: $t,
            #[gauss(center_of_mass)]
            center: Vector3<$t>,
            #[gauss(inertia)]
            inertia: Matrix3<$t>,
            #[gauss(gravity)]
            g: $t,
        }
    };
}

/// A body in water, by its clauses and with what else it has.
macro_rules! in_water {
    ($name:ident [$($generics:tt)*] $t:ident ($($clauses:tt)*) { $($others:tt)* }) => {
        #[derive(Clone, Copy, GaussDynamics)]
        #[gauss($($clauses)*)]
        struct $name $($generics)* {
            #[gauss(mass)]
            mass: $t,
            #[gauss(center_of_mass)]
            center: Vector3<$t>,
            #[gauss(inertia)]
            inertia: Vector3<$t>,
            #[gauss(added_mass)]
            added: Matrix6<$t>,
            #[gauss(gravity)]
            g: $t,
            #[gauss(displaced_mass)]
            displaced: $t,
            $($others)*
        }
    };
}

/// S3, in one of the charts.
macro_rules! immersed {
    ($name:ident $generics:tt $t:ident $chart:ident) => {
        in_water!($name $generics $t (chart = $chart) {
            #[gauss(center_of_buoyancy)]
            buoyancy: Vector3<$t>,
        });
    };
}

/// A vehicle, with drag and a fin.
macro_rules! vehicle {
    ($name:ident $generics:tt $t:ident) => {
        in_water!($name $generics $t (
            chart = left_invariant,
            define(v = body.relative_velocity),
            drag(linear = drag),
            force(fin, at = tail, value = [0, lift * v.x * v.y, lift * v.x * v.z])
        ) {
            drag: Matrix6<$t>,
            tail: Vector3<$t>,
            lift: $t,
        });
    };
}

heavy!(Heavy [] f64);
heavy!(HeavyOfAny [<T>] T);
immersed!(Immersed [] f64 left_invariant);
immersed!(ImmersedOfAny [<T>] T left_invariant);
immersed!(Hybrid [] f64 hybrid);
immersed!(HybridOfAny [<T>] T hybrid);
vehicle!(Vehicle [] f64);
vehicle!(VehicleOfAny [<T>] T);

type State = (Isometry3<f64>, Vector6<f64>);
type Method<S> = fn(&S, &State) -> Vector6<f64>;

/// Methods, by name.
fn methods<S>() -> [(&'static str, Method<S>); 5]
where
    S: GaussSystem<Scalar = f64, Configuration = Isometry3<f64>, Speeds = Vector6<f64>, Input = ()>,
{
    [
        ("acceleration", |s, (q, z)| s.acceleration(0.0, q, z, &())),
        ("momentum", |s, (q, z)| s.momentum(0.0, q, z)),
        ("velocity", |s, (q, p)| s.velocity(0.0, q, p)),
        ("momentum_rate", |s, (q, p)| s.momentum_rate(0.0, q, p, &())),
        ("gauss_residual", |s, (q, z)| s.gauss_residual(0.0, q, z, z, &())),
    ]
}

/// Every call moves the next one's speeds by less than their last digits.
fn chained<S: Copy + 'static>(kernel: S, states: &[State], method: Method<S>) -> Way {
    let start = states[0];
    let run = move |(kernel, method): &(S, Method<S>), states: &Vec<State>| {
        let (q, mut z) = start;
        for _ in states {
            z = start.1 + method(kernel, &(q, z)) * 1e-30;
        }
        z
    };
    Way::calling("chained", vec![states.to_vec()], (), move |(), states| run(black_box(&(kernel, method)), states))
}

fn rows<A, B>(scene: &str, packed: A, single: B)
where
    A: GaussSystem<Scalar = f64, Configuration = Isometry3<f64>, Speeds = Vector6<f64>, Input = ()> + Copy + 'static,
    B: GaussSystem<Scalar = f64, Configuration = Isometry3<f64>, Speeds = Vector6<f64>, Input = ()> + Copy + 'static,
{
    let states = of_a_body();
    for ((name, one), (_, other)) in methods::<A>().into_iter().zip(methods::<B>()) {
        for state in &states {
            let bits = |result: Vector6<f64>| result.map(f64::to_bits);
            assert_eq!(bits(one(&packed, state)), bits(other(&single, state)), "{scene}, {name}");
        }
        let free = [Way::new("packed", packed, states.clone(), one), Way::new("single", single, states.clone(), other)];
        let chains = [chained(packed, &states, one), chained(single, &states, other)];
        let [free, chains] = [free, chains].map(|ways| times(&ways, 500, 1e-4));
        let ratio = |spread: &Spread| format!("{:.2} ({:.2}–{:.2})", spread.median, spread.lower, spread.upper);
        let each = |spread: &Spread| spread.median / states.len() as f64;
        println!(
            "| {scene} `{name}` | {:.1} | {:.1} | {} | {:.1} | {:.1} | {} |",
            free.absolute[0].median,
            free.absolute[1].median,
            ratio(&free.ratios[1]),
            each(&chains.absolute[0]),
            each(&chains.absolute[1]),
            ratio(&chains.ratios[1])
        );
    }
}

macro_rules! immersed_body {
    ($name:ident) => {{
        let ((weight, center), (buoyancy, point)) = (numbers::WEIGHT, numbers::BUOYANCY);
        let (mass, center, inertia) = (weight / G, Vector3::from(center), Vector3::new(1.0, 3.0, 3.0));
        let added = numbers::added_mass(mass, center, inertia);
        $name { mass, center, inertia, added, g: G, displaced: buoyancy / G, buoyancy: point.into() }.kernel()
    }};
}

macro_rules! underwater_vehicle {
    ($name:ident) => {{
        let ((weight, center), (buoyancy, _)) = (numbers::WEIGHT, numbers::BUOYANCY);
        let (mass, center, inertia) = (weight / G, Vector3::from(center), Vector3::new(1.0, 3.0, 3.0));
        let added = numbers::added_mass(mass, center, inertia);
        let (drag, tail) = (Matrix6::identity() * 2.0, Vector3::new(-0.6, 0.0, 0.02));
        $name { mass, center, inertia, added, g: G, displaced: buoyancy / G, drag, tail, lift: -9.0 }.kernel()
    }};
}

fn main() -> Result<(), ParameterError> {
    println!("| ns | packed | single | packed / single | chained: packed | single | packed / single |");
    println!("|---|---|---|---|---|---|---|");
    let (mass, center, inertia) = numbers::heavy_body();
    let inertia = about_pole(mass, center, inertia);
    rows("S2", Heavy { mass, center, inertia, g: G }.kernel()?, HeavyOfAny { mass, center, inertia, g: G }.kernel()?);
    rows("S3", immersed_body!(Immersed)?, immersed_body!(ImmersedOfAny)?);
    rows("S3 in observer's axes", immersed_body!(Hybrid)?, immersed_body!(HybridOfAny)?);
    rows("vehicle", underwater_vehicle!(Vehicle)?, underwater_vehicle!(VehicleOfAny)?);
    Ok(())
}
