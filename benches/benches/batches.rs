//! `cargo bench -p gauss-benches --bench batches`: accelerations of many states, one by one and in batches of every kind of pack.
//!
//! ns per state, medians of times taken in turn, and how many times more states a batch does in the same time.

use std::cell::RefCell;
use std::hint::black_box;

use gauss_benches::measure::{Way, times};
use gauss_benches::scenes::{G, numbers};
use gauss_benches::states::{STATES, of_a_body, of_angles, of_the_top};
use gauss_runtime::batch::{Batch, BatchSystem, Packs, SingleConfiguration, SingleSpeeds, States};
use gauss_runtime::prelude::*;

/// S3 in any scalar.
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(chart = left_invariant)]
struct Immersed<T> {
    #[gauss(mass)]
    mass: T,
    #[gauss(center_of_mass)]
    center: Vector3<T>,
    #[gauss(inertia)]
    inertia: Vector3<T>,
    #[gauss(added_mass)]
    added: Matrix6<T>,
    #[gauss(gravity)]
    g: T,
    #[gauss(displaced_mass)]
    displaced: T,
    #[gauss(center_of_buoyancy)]
    buoyancy: Vector3<T>,
}

/// S4.
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(chart = jet(euler_zxz), motion = fixed_point, center_of_mass = [0, 0, distance])]
struct Top<T> {
    #[gauss(mass)]
    mass: T,
    #[gauss(inertia)]
    inertia: Vector3<T>,
    distance: T,
    #[gauss(gravity)]
    g: T,
}

/// S5.
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(
    coordinates(a, b),
    body(
        upper, rotation = rotation_y(-a),
        mass = m1, center_of_mass = [0, 0, -c1], inertia_about_center_of_mass = i1
    ),
    body(
        lower, position = [length * sin(a), 0, -length * cos(a)], rotation = rotation_y(-b),
        mass = m2, center_of_mass = [0, 0, -c2], inertia_about_center_of_mass = i2
    ),
)]
struct DoublePendulum<T> {
    m1: T,
    c1: T,
    i1: T,
    m2: T,
    c2: T,
    i2: T,
    length: T,
    #[gauss(gravity)]
    g: T,
}

/// S6.
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(
    coordinates(x, theta),
    particle(mass = cart, position = [x, 0, 0]),
    body(
        pole, position = [x, 0, 0], rotation = rotation_y(theta),
        mass = m, center_of_mass = [0, 0, distance], inertia_about_center_of_mass = moment
    ),
)]
struct CartPole<T> {
    cart: T,
    m: T,
    moment: T,
    distance: T,
    #[gauss(gravity)]
    g: T,
}

fn immersed<T: Real>() -> ImmersedKernel<T> {
    let n = T::from_f64;
    let ((weight, center), (buoyancy, point)) = (numbers::WEIGHT, numbers::BUOYANCY);
    let (mass, center, inertia) = (weight / G, Vector3::from(center), Vector3::new(1.0, 3.0, 3.0));
    let added = numbers::added_mass(mass, center, inertia).map(n);
    let (center, inertia, buoyancy_at) = (center.map(n), inertia.map(n), Vector3::from(point).map(n));
    let (mass, displaced) = (n(mass), n(buoyancy / G));
    Immersed { mass, center, inertia, added, g: n(G), displaced, buoyancy: buoyancy_at }.kernel().expect("a body")
}

fn top<T: Real>() -> TopKernel<T> {
    let n = T::from_f64;
    let (mass, distance, inertia) = numbers::top();
    Top { mass: n(mass), inertia: inertia.map(n), distance: n(distance), g: n(G) }.kernel().expect("a body")
}

fn double_pendulum<T: Real>() -> DoublePendulumKernel<T> {
    let [(m1, c1, i1), (m2, c2, i2)] = [numbers::UPPER, numbers::LOWER].map(in_scalar);
    let (length, g) = (T::from_f64(numbers::LENGTH), T::from_f64(G));
    DoublePendulum { m1, c1, i1, m2, c2, i2, length, g }.kernel().expect("a pendulum")
}

fn cart_pole<T: Real>() -> CartPoleKernel<T> {
    let (m, distance, moment) = in_scalar(numbers::POLE);
    CartPole { cart: T::from_f64(numbers::CART), m, moment, distance, g: T::from_f64(G) }.kernel().expect("a cart")
}

fn in_scalar<T: Real>((m, c, i): numbers::Link) -> (T, T, T) {
    (T::from_f64(m), T::from_f64(c), T::from_f64(i))
}

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
}
