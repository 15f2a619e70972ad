//! How much faster many states are than one after another: accelerations and steps of three bodies, per core, in packs
//! of every kind.
//!
//! `cargo run --release --example batch_throughput`; with `RUSTFLAGS="-C target-cpu=native"` in the instructions of the
//! machine, and with `-C target-feature=-prefer-256-bit` besides in vectors of 512 bits also where the compiler
//! chooses. Ratios mean something within one run: what is compared is measured in turn.
//!
//! Then what is reached of the machine's limits, measured in the same minute on one thread: the rate of floating-point
//! operations of a loop of nothing but independent multiply-adds (two operations each), and bytes read and written by a
//! copy of arrays that no cache holds. Operations of a kernel are what `OPERATIONS` counts, a fused multiply-add as
//! two; bytes are those of a state's configuration, speeds and result, each moved once. There the fastest round counts.
//! `--states N` sets how many states are beyond all caches.

use std::hint::black_box;
use std::time::Instant;

use gauss_batch::{Batch, BatchSystem, States};
use gauss_charts::statistics::quartiles;
use gauss_runtime::integrate::{Fixed, OneStep};
use gauss_runtime::prelude::*;
use gauss_runtime::simd::Packed;

/// S1: principal axes at the centre of mass, no force.
#[derive(GaussDynamics)]
#[gauss(chart = left_invariant)]
struct Free<T> {
    #[gauss(mass)]
    mass: T,
    #[gauss(inertia)]
    inertia: Vector3<T>,
}

/// S2: O off the centre of mass, weight.
#[derive(GaussDynamics)]
#[gauss(chart = left_invariant)]
struct Heavy<T> {
    #[gauss(mass)]
    mass: T,
    #[gauss(center_of_mass)]
    center: Vector3<T>,
    #[gauss(inertia)]
    inertia: Matrix3<T>,
    #[gauss(gravity)]
    g: T,
}

/// S3: a body in fluid, all 21 added masses, weight and buoyancy at different points.
#[derive(GaussDynamics)]
#[gauss(chart = left_invariant)]
struct Immersed<T> {
    #[gauss(mass)]
    mass: T,
    #[gauss(center_of_mass)]
    center: Vector3<T>,
    #[gauss(inertia)]
    inertia: Matrix3<T>,
    #[gauss(added_mass)]
    added: Matrix6<T>,
    #[gauss(gravity)]
    g: T,
    #[gauss(displaced_mass)]
    displaced: T,
    #[gauss(center_of_buoyancy)]
    buoyancy: Vector3<T>,
}

fn vector<T: Real>(components: [f64; 3]) -> Vector3<T> {
    Vector3::from(components.map(T::from_f64))
}

fn tensor<T: Real>() -> Matrix3<T> {
    let rows = [[1.0, 0.1, -0.05], [0.1, 2.0, 0.2], [-0.05, 0.2, 2.5]];
    Matrix3::from_fn(|i, j| T::from_f64(rows[i][j]))
}

fn free<T: Real>() -> FreeKernel<T> {
    Free { mass: T::from_f64(2.0), inertia: vector([1.0, 2.0, 3.0]) }.kernel().expect("a body")
}

fn heavy<T: Real>() -> HeavyKernel<T> {
    let (mass, g) = (T::from_f64(2.0), T::from_f64(9.81));
    Heavy { mass, center: vector([0.1, -0.05, 0.2]), inertia: tensor(), g }.kernel().expect("a body")
}

fn immersed<T: Real>() -> ImmersedKernel<T> {
    let number = T::from_f64;
    let added = Matrix6::from_fn(|i, j| {
        let (i, j) = (i.min(j), i.max(j));
        number(if i == j { 10.0 + 3.0 * i as f64 } else { 0.3 * ((i * 7 + j * 3) % 5) as f64 - 0.6 })
    });
    let (center, buoyancy) = (vector([0.01, 0.0, 0.02]), vector([0.02, 0.0, -0.03]));
    let body = Immersed {
        mass: number(30.0),
        center,
        inertia: tensor(),
        added,
        g: number(9.81),
        displaced: number(30.3),
        buoyancy,
    };
    body.kernel().expect("a body")
}

const STATES: usize = 128;
const STEPS: usize = 50;
const STEP: f64 = 1e-3;

/// Numbers in [−1, 1] without a pattern.
fn spread(i: usize, k: usize) -> f64 {
    ((i * 7 + k * 13 + 3) as f64 * 0.618_033_988_749_894_9).fract() * 2.0 - 1.0
}

fn state(i: usize) -> (Isometry3<f64>, SVector<f64, 6>) {
    let turn = UnitQuaternion::from_euler_angles(spread(i, 0), spread(i, 1), 3.0 * spread(i, 2));
    let pose = Isometry3::from_parts(Translation3::new(spread(i, 3), spread(i, 4), spread(i, 5)), turn);
    (pose, SVector::from(std::array::from_fn(|k| spread(i, 6 + k))))
}

/// One state, as a caller has it who knows nothing of others: through a call.
#[inline(never)]
fn one<S>(kernel: &S, q: &Isometry3<f64>, z: &SVector<f64, 6>) -> SVector<f64, 6>
where
    S: GaussSystem<Scalar = f64, Configuration = Isometry3<f64>, Speeds = SVector<f64, 6>, Input = ()>,
{
    kernel.acceleration(0.0, q, z, &())
}

/// Nanoseconds for one acceleration, and for one step of the method, state after state.
fn single<S>(kernel: &S, method: &(impl OneStep<S> + Copy)) -> [f64; 2]
where
    S: GaussSystem<Scalar = f64, Configuration = Isometry3<f64>, Speeds = SVector<f64, 6>, Input = ()>,
{
    let states: Vec<_> = (0..STATES).map(state).collect();
    let mut out = vec![SVector::<f64, 6>::zeros(); STATES];
    let accelerations = time(|| {
        for (out, (q, z)) in out.iter_mut().zip(&states) {
            *out = one(black_box(kernel), q, z);
        }
        black_box(&mut out);
    });
    let steps = time(|| {
        for (q, z) in &states {
            let run = Simulation::new(kernel).control(Fixed::by(*method, STEP));
            black_box(run.run_to_end(*q, *z, 0.0..STEP * STEPS as f64).expect("short steps"));
        }
    });
    [accelerations / STATES as f64, steps / (STATES * STEPS) as f64]
}

/// The same in a batch.
fn batch<S>(kernel: &S, method: &impl OneStep<S>) -> [f64; 2]
where
    S: BatchSystem<Input = ()>,
    S::Configuration: Packed<Single = Isometry3<f64>>,
    S::Speeds: Packed<Single = SVector<f64, 6>>,
{
    let states = States::<S>::from_fn(STATES, state);
    let batch = Batch::new(kernel);
    let accelerations = time(|| {
        black_box(batch.accelerations(0.0, black_box(&states)));
    });
    let mut moving = states.clone();
    let steps = time(|| {
        moving.clone_from(&states);
        batch.advance(method, STEP, 0.0..STEP * STEPS as f64, &mut moving).expect("short steps");
    });
    [accelerations / STATES as f64, steps / (STATES * STEPS) as f64]
}

/// Nanoseconds of one call: as many calls as take a fifth of a millisecond.
fn time(mut work: impl FnMut()) -> f64 {
    let mut repetitions = 1_u32;
    loop {
        let begun = Instant::now();
        (0..repetitions).for_each(|_| work());
        let elapsed = begun.elapsed().as_secs_f64();
        if elapsed > 2e-4 {
            return 1e9 * elapsed / f64::from(repetitions);
        }
        repetitions *= 2;
    }
}

/// Floating-point operations a second in registers, on vectors of eight and of four, whichever is faster.
fn peak() -> f64 {
    /// Chains of multiply-adds that do not wait for one another: enough for two units of latency four, few enough for
    /// sixteen registers.
    const CHAINS: usize = 12;
    const LENGTH: usize = 2000;
    macro_rules! rate {
        ($pack:ty, $lanes:literal) => {{
            let (factor, term) = black_box((<$pack>::splat(0.999_999), <$pack>::splat(1e-6)));
            let nanoseconds = fastest(31, || {
                let mut sums: [$pack; CHAINS] = std::array::from_fn(|k| <$pack>::splat(k as f64));
                for _ in 0..LENGTH {
                    for sum in &mut sums {
                        *sum = sum.mul_add(factor, term);
                    }
                }
                black_box(sums);
            });
            (2 * $lanes * CHAINS * LENGTH) as f64 / nanoseconds * 1e9
        }};
    }
    f64::max(rate!(wide::f64x8, 8), rate!(wide::f64x4, 4))
}

/// Bytes read and written a second by a copy of arrays of this many bytes together.
fn bandwidth(bytes: usize) -> f64 {
    let from = vec![1.0_f64; bytes / 16];
    let mut to = vec![0.0_f64; bytes / 16];
    let nanoseconds = fastest(9, || black_box(&mut to).copy_from_slice(black_box(&from)));
    (from.len() * 16) as f64 / nanoseconds * 1e9
}

/// Nanoseconds of the fastest of some rounds: limits are compared with what is reached when nothing else runs.
fn fastest(rounds: usize, mut work: impl FnMut()) -> f64 {
    (0..rounds).map(|_| time(&mut work)).fold(f64::INFINITY, f64::min)
}

/// Bytes that an acceleration reads and writes: seven numbers of the pose, six speeds, six rates.
const BYTES_OF_AN_ACCELERATION: usize = (7 + 6 + 6) * 8;
/// A step reads and writes pose and speeds.
const BYTES_OF_A_STEP: usize = 2 * (7 + 6) * 8;

/// One line: what a batch reaches of the limits, among states that a cache holds and among `many`.
fn limits<S>(name: &str, kernel: &S, many: usize, [peak, bandwidth]: [f64; 2])
where
    S: BatchSystem<Input = ()> + DescribedSystem,
    S::Configuration: Packed<Single = Isometry3<f64>>,
    S::Speeds: Packed<Single = SVector<f64, 6>>,
{
    let operations = f64::from(S::OPERATIONS.acceleration.total());
    let batch = Batch::new(kernel);
    let accelerations = |count: usize, rounds: usize| {
        let states = States::<S>::from_fn(count, state);
        let mut rates = batch.accelerations(0.0, &states);
        fastest(rounds, || batch.accelerations_into(0.0, black_box(&states), black_box(&mut rates))) / count as f64
    };
    let (near, far) = (accelerations(STATES, 31), accelerations(many, 9));
    let mut states = States::<S>::from_fn(many, state);
    let mut step = || batch.advance(&RungeKutta(Classical4), STEP, 0.0..STEP, &mut states).expect("short steps");
    let step = fastest(9, &mut step) / many as f64;
    let of_peak = |nanoseconds: f64| 100.0 * operations / nanoseconds * 1e9 / peak;
    let of_bandwidth = |bytes: usize, nanoseconds: f64| 100.0 * bytes as f64 / nanoseconds * 1e9 / bandwidth;
    println!(
        "{name:32} | {near:6.2} ns, {:3.0} % of operations | {far:6.2} ns, {:3.0} % of operations, {:3.0} % of bytes | \
         {step:6.1} ns, {:3.0} % of bytes",
        of_peak(near),
        of_peak(far),
        of_bandwidth(BYTES_OF_AN_ACCELERATION, far),
        of_bandwidth(BYTES_OF_A_STEP, step),
    );
}

fn main() {
    let mut arguments = std::env::args().skip_while(|argument| argument != "--states").skip(1);
    // 640 megabytes of states and results.
    let many = arguments.next().map_or(1 << 22, |number| number.parse().expect("a number of states"));
    throughput();
    let measured = [peak(), bandwidth(many * BYTES_OF_AN_ACCELERATION)];
    println!(
        "\nlimits of one thread: {:.1} thousand million operations a second in registers; a copy reads and writes {:.1} GB/s",
        measured[0] * 1e-9,
        measured[1] * 1e-9
    );
    println!(
        "accelerations of {STATES} states | accelerations of {many} states | one step of order 4 of {many} states, in place"
    );
    macro_rules! scene {
        ($name:literal, $kernel:ident) => {
            limits(concat!($name, " batch of f64"), &$kernel::<f64>(), many, measured);
            limits(concat!($name, " Lanes<f64, 4>"), &$kernel::<Lanes<f64, 4>>(), many, measured);
            limits(concat!($name, " Lanes<f64, 8>"), &$kernel::<Lanes<f64, 8>>(), many, measured);
            limits(concat!($name, " wide::f64x4"), &$kernel::<wide::f64x4>(), many, measured);
            limits(concat!($name, " wide::f64x8"), &$kernel::<wide::f64x8>(), many, measured);
        };
    }
    scene!("S1", free);
    scene!("S2", heavy);
    scene!("S3", immersed);
}

/// The table of ratios to single states.
fn throughput() {
    let method = RungeKutta(Classical4);
    println!("ns per state, and how many times faster than one after another; one thread, medians of 31 rounds");
    macro_rules! scene {
        ($name:literal, $kernel:ident) => {{
            let mut rounds = Vec::new();
            let one = $kernel::<f64>();
            let (four, eight) = ($kernel::<Lanes<f64, 4>>(), $kernel::<Lanes<f64, 8>>());
            let (wide_four, wide_eight) = ($kernel::<wide::f64x4>(), $kernel::<wide::f64x8>());
            for _ in 0..31 {
                rounds.push([
                    single(&one, &method),
                    batch(&one, &method),
                    batch(&four, &method),
                    batch(&eight, &method),
                    batch(&wide_four, &method),
                    batch(&wide_eight, &method),
                ]);
            }
            for (k, what) in ["acceleration", "step of order 4"].into_iter().enumerate() {
                let names =
                    ["one by one", "batch of f64", "Lanes<f64, 4>", "Lanes<f64, 8>", "wide::f64x4", "wide::f64x8"];
                print!("{:26}", format!("{} {what}", $name));
                for (n, name) in names.into_iter().enumerate() {
                    let value = quartiles(rounds.iter().map(|round| round[n][k]).collect())[1];
                    let ratio = quartiles(rounds.iter().map(|round| round[0][k] / round[n][k]).collect())[1];
                    print!(" | {name} {value:.2} ({ratio:.2}x)");
                }
                println!();
            }
        }};
    }
    scene!("S1", free);
    scene!("S2", heavy);
    scene!("S3", immersed);
}
