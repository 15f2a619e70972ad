//! `cargo bench -p gauss-benches --bench batches`: accelerations of many states, one by one and in batches of every
//! kind of pack.
//!
//! With `--features robots` of S7′ and S8 as well. ns per state, medians of times taken in turn, and how many times
//! more states a batch does in the same time.

use std::cell::RefCell;
use std::hint::black_box;

use gauss_batch::{Batch, BatchSystem, Packs, SingleConfiguration, SingleSpeeds, States};
use gauss_benches::measure::{Way, times};
#[cfg(feature = "robots")]
use gauss_benches::packs::{anymal, fingers};
use gauss_benches::packs::{cart_pole, double_pendulum, immersed, top};
#[cfg(feature = "robots")]
use gauss_benches::states::of_a_floating_base;
use gauss_benches::states::{STATES, of_a_body, of_angles, of_the_top};
use gauss_runtime::prelude::*;

/// States one after another, each through a call.
fn one_by_one<S>(kernel: S, states: Vec<(S::Configuration, S::Speeds)>) -> Way
where
    S: GaussSystem<Scalar = f64, Input = ()> + 'static,
{
    fn one<S: GaussSystem<Scalar = f64, Input = ()>>(kernel: &S, (q, z): &(S::Configuration, S::Speeds)) -> S::Speeds {
        kernel.acceleration(0.0, q, z, &())
    }
    Way::new("one by one", kernel, states, one::<S>)
}

/// All states in a batch; times are those of all of them.
fn batch<S>(name: &str, kernel: S, states: &[(SingleConfiguration<S>, SingleSpeeds<S>)]) -> Way
where
    S: BatchSystem<Input = ()> + 'static,
{
    fn all<S: BatchSystem<Input = ()>>(kernel: &S, states: &States<S>, accelerations: &mut Packs<S::Speeds>) {
        Batch::new(kernel).accelerations_into(0.0, states, accelerations);
    }
    let states = States::<S>::from_fn(states.len(), |i| states[i]);
    let accelerations = RefCell::new(Batch::new(&kernel).accelerations(0.0, &states));
    let function: fn(&S, &States<S>, &mut Packs<S::Speeds>) = all::<S>;
    Way::calling(name, vec![states], function, move |function, states| {
        function(black_box(&kernel), states, &mut accelerations.borrow_mut());
    })
}

macro_rules! row {
    ($name:literal, $kernel:ident, $states:expr) => {{
        let states = $states;
        let ways = [
            one_by_one($kernel::<f64>(), states.clone()),
            batch("batch of `f64`", $kernel::<f64>(), &states),
            batch("`Lanes<f64, 4>`", $kernel::<Lanes<f64, 4>>(), &states),
            batch("`Lanes<f64, 8>`", $kernel::<Lanes<f64, 8>>(), &states),
            batch("`wide::f64x4`", $kernel::<wide::f64x4>(), &states),
            batch("`wide::f64x8`", $kernel::<wide::f64x8>(), &states),
        ];
        let times = times(&ways, 300, 1e-4);
        print!("| {} | {:.1} |", $name, times.absolute[0].median);
        for (time, ratio) in times.absolute.iter().zip(&times.ratios).skip(1) {
            let count = STATES as f64;
            print!(" {:.2} ({:.1}) |", time.median / count, ratio.median * count);
        }
        println!();
    }};
}

fn main() {
    println!("| | one by one | batch of `f64` | `Lanes<f64, 4>` | `Lanes<f64, 8>` | `wide::f64x4` | `wide::f64x8` |");
    println!("|---|---|---|---|---|---|---|");
    row!("S3", immersed, of_a_body());
    row!("S4", top, of_the_top());
    row!("S5", double_pendulum, of_angles::<2>());
    row!("S6", cart_pole, of_angles::<2>());
    #[cfg(feature = "robots")]
    {
        row!("S7′", fingers, of_angles::<9>());
        row!("S8", anymal, of_a_floating_base::<12, 18>());
    }
}
