//! `cargo run --release -p gauss-benches --example rows_at_run_time --features robots`: accelerations of many states by
//! models that are read while the program runs, row by row and in lanes, beside kernels compiled ahead in lanes of
//! eight.
//!
//! Rows lie one behind the other, as arrays of Python have them; all ways read them so, on one thread. Ways take turns;
//! medians, the middle half, and ratios of neighbours in time.

use std::error::Error;
use std::f64::consts::PI;
use std::hint::black_box;

use gauss_benches::measure::{Way, times};
use gauss_benches::packs::fingers;
use gauss_benches::states::Random;
use gauss_codegen::program::Program;
use gauss_jit::{Backend, Compiled, CompiledLanes, Cranelift, Kernel, Method, Model, Tables};
use gauss_runtime::prelude::*;
use gauss_runtime::simd::Packed;

/// Rows of a batch: they stay in the nearest caches.
const ROWS: usize = 512;

type Lanes = wide::f64x8;

/// Machine code with four lanes, as processors have it that know AVX2 and no AVX-512.
#[derive(Debug)]
struct FourLanes;

impl Backend for FourLanes {
    fn compile(&self, program: &Program, tables: &Tables) -> Option<Box<dyn Compiled>> {
        Cranelift::default().compile(program, tables)
    }

    fn compile_lanes(&self, program: &Program, tables: &Tables) -> Option<Box<dyn CompiledLanes>> {
        Cranelift::default().lanes(program, tables, 4)
    }
}

const PENDULUM: &str =
    "#[gauss(coordinates(angle), particle(mass = m, position = [l * sin(angle), 0, -l * cos(angle)]))]
    struct Pendulum { m: f64, l: f64, #[gauss(gravity)] g: f64 }";

/// The same, compiled ahead.
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(coordinates(angle), particle(mass = m, position = [l * sin(angle), 0, -l * cos(angle)]))]
struct Pendulum<T> {
    m: T,
    l: T,
    #[gauss(gravity)]
    g: T,
}

/// Configurations and speeds, row after row.
struct Batch {
    q: Vec<f64>,
    z: Vec<f64>,
}

fn batch<const N: usize>() -> Batch {
    let random = &mut Random::new();
    let mut rows = |size: f64| (0..ROWS).flat_map(|_| random.vector::<N>(size).as_slice().to_vec()).collect();
    Batch { q: rows(PI), z: rows(2.0) }
}

fn one_by_one(method: Method<'_>, batch: &Batch, size: usize, results: &mut [f64]) {
    for row in 0..ROWS {
        let own = row * size..(row + 1) * size;
        let lists: [&[f64]; 4] = [&[0.0], &batch.q[own.clone()], &batch.z[own.clone()], &[]];
        method.call(&lists, &mut results[own]).unwrap_or_default();
    }
}

fn in_lanes(method: Method<'_>, batch: &Batch, _: usize, results: &mut [f64]) {
    method.call_rows(ROWS, &[&[0.0], &batch.q, &batch.z, &[]], results).unwrap_or_default();
}

/// Rows become vectors and results rows again, as batches of compiled kernels do it.
fn compiled_ahead<K, const N: usize>(kernel: &K, batch: &Batch, results: &mut [f64])
where
    K: GaussSystem<Scalar = Lanes, Configuration = SVector<Lanes, N>, Speeds = SVector<Lanes, N>, Input = ()>,
{
    for start in (0..ROWS).step_by(Lanes::WIDTH) {
        let vector = |list: &[f64], i: usize| Lanes::new(std::array::from_fn(|lane| list[(start + lane) * N + i]));
        let [q, z] = [&batch.q, &batch.z].map(|list| SVector::from_fn(|i, _| vector(list, i)));
        let found = kernel.acceleration(Lanes::ZERO, &q, &z, &());
        for lane in 0..Lanes::WIDTH {
            for i in 0..N {
                results[(start + lane) * N + i] = found[i].extract(lane);
            }
        }
    }
}

type RowsFunction = fn(Method<'_>, &Batch, usize, &mut [f64]);

fn at_run_time<const N: usize>(name: &str, kernel: &'static Kernel, function: RowsFunction) -> Way {
    let place = std::cell::RefCell::new(vec![0.0; ROWS * N]);
    Way::calling(name, vec![batch::<N>()], function, move |function, batch| {
        let Ok(method) = kernel.method("acceleration") else { return };
        function(method, batch, N, black_box(&mut place.borrow_mut()));
    })
}

fn table<K, const N: usize>(name: &str, model: &Model, given: &[(&str, &[f64])], ahead: K) -> Result<(), Box<dyn Error>>
where
    K: GaussSystem<Scalar = Lanes, Configuration = SVector<Lanes, N>, Speeds = SVector<Lanes, N>, Input = ()> + 'static,
{
    // It lives as long as the program, as ways do.
    let kernel: &'static Kernel = Box::leak(Box::new(model.kernel(given)?));
    let four: &'static Kernel = Box::leak(Box::new(model.with_backend(FourLanes).kernel(given)?));
    let method = kernel.method("acceleration")?;
    let start = std::time::Instant::now();
    let width = method.width();
    let made = start.elapsed().as_secs_f64() * 1e3;
    // Lanes have the bits of rows alone; code compiled ahead rounds otherwise.
    let states = batch::<N>();
    let mut results = [(); 3].map(|()| vec![0.0; ROWS * N]);
    one_by_one(method, &states, N, &mut results[0]);
    in_lanes(method, &states, N, &mut results[1]);
    compiled_ahead(&ahead, &states, &mut results[2]);
    assert!(results[0].iter().zip(&results[1]).all(|(a, b)| a.to_bits() == b.to_bits()), "bits of {name}");
    let close = |(a, b): (&f64, &f64)| (a - b).abs() <= 1e-9 * (1.0 + a.abs());
    assert!(results[0].iter().zip(&results[2]).all(close), "numbers of {name}");
    let place = std::cell::RefCell::new(vec![0.0; ROWS * N]);
    let function: fn(&K, &Batch, &mut [f64]) = compiled_ahead::<K, N>;
    let ways = [
        at_run_time::<N>(&format!("at run time, {width} lanes"), kernel, in_lanes),
        at_run_time::<N>("at run time, 4 lanes", four, in_lanes),
        at_run_time::<N>("at run time, row by row", kernel, one_by_one),
        Way::calling("compiled ahead, `wide::f64x8`", vec![batch::<N>()], function, move |function, batch| {
            function(black_box(&ahead), batch, black_box(&mut place.borrow_mut()));
        }),
    ];
    let times = times(&ways, 300, 1e-3);
    println!(
        "\n{name}; code in lanes made in {made:.2} ms\n\n| | ns a row | million rows/s | lanes / this |\n|---|---|---|---|"
    );
    for ((way, time), ratio) in ways.iter().zip(&times.absolute).zip(&times.ratios) {
        let rows = ROWS as f64;
        let [low, middle, high] = [time.lower, time.median, time.upper].map(|time| time / rows);
        let ratio = format!("{:.3} ({:.3} to {:.3})", ratio.median, ratio.lower, ratio.upper);
        println!("| {} | {middle:.1} ({low:.1} to {high:.1}) | {:.1} | {ratio} |", way.name, 1e3 / middle);
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/robots/panda.urdf");
    let panda = Model::from_urdf(file, &["gravity = 9.81", "inputs = none"])?;
    table::<_, 9>("Panda with fingers", &panda, &[], fingers::<Lanes>())?;
    let pendulum = Model::from_source(PENDULUM)?;
    let number = Lanes::splat;
    let ahead = Pendulum { m: number(0.7), l: number(0.5), g: number(9.81) }.kernel()?;
    table::<_, 1>("Pendulum", &pendulum, &[("m", &[0.7]), ("l", &[0.5]), ("g", &[9.81])], ahead)
}
