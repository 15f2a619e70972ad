//! A hundred thousand throws of a body whose inertia and spin are uncertain, and a sweep over its spin: many states at
//! once, in vectors and on all threads. The scatter against the covariance that derivatives of one run predict.
//!
//! `cargo run --release --example monte_carlo [-- FOLDER]` draws the picture into `FOLDER`, by default `target/gauss`.

mod model;

use std::error::Error;
use std::f64::consts::TAU;
use std::time::Instant;

use gauss_adapters::DualNumber;
use gauss_batch::{Batch, Packs, States};
use gauss_charts::drawing::{COLOURS, INK};
use gauss_charts::statistics::Random;
use gauss_examples::plots::{Line, Plot, mosaic, write, write_page};
use gauss_playback::{Playback, Shape};
use gauss_runtime::integrate::Fixed;
use gauss_runtime::prelude::*;
use indicatif::{ProgressBar, ProgressStyle};
use num_dual::{Derivative, DualSVec64};
use wide::f64x8;

use model::{DEVIATIONS, FLIGHT, MEAN, OvalKernel, STEP, kernel, place, start};

/// How many throws.
const THROWS: usize = 100_000;
/// How many of them are drawn.
const DRAWN: usize = 2500;
/// How many spins the sweep has.
const SPINS: usize = 600;

/// Where throws end, with parameters and states of their own in every lane.
fn throw(throws: &[[f64; 6]], bar: &ProgressBar) -> Result<Vec<[f64; 2]>, Box<dyn Error>> {
    let column = |k: usize| Packs::<f64x8>::from_fn(throws.len(), |i| throws[i][k]);
    let columns = [0, 1, 2, 3, 4, 5].map(column);
    let block = |n: usize| columns.each_ref().map(|column| column.blocks()[n]);
    let kernels: Vec<_> = (0..columns[0].blocks().len()).map(|n| kernel(&block(n))).collect::<Result<_, _>>()?;
    let mut states = States::<OvalKernel<f64x8>>::from_fn(throws.len(), |i| start(&throws[i]));
    let batch = Batch::each(&kernels);
    const PARTS: u32 = 20;
    for part in 0..PARTS {
        let time = |part: u32| FLIGHT * f64::from(part) / f64::from(PARTS);
        batch.advance_on_all_threads(&RungeKutta(Classical4), STEP, time(part)..time(part + 1), &mut states)?;
        bar.inc(throws.len() as u64 / u64::from(PARTS));
    }
    Ok(states.iter().map(|(pose, _)| place(&pose)).collect())
}

/// Where the mean throw lands, and the derivatives of that by the uncertain numbers.
type Linearised = ([f64; 2], [[f64; 6]; 2]);

/// The end of the mean throw and its derivatives by the six uncertain numbers, from one run in dual numbers.
fn linearised() -> Result<Linearised, Box<dyn Error>> {
    let number = |value: f64| DualNumber(DualSVec64::from_re(value));
    let variables: [DualNumber<DualSVec64<6>>; 6] = std::array::from_fn(|k| {
        let mut variable = number(MEAN[k]);
        variable.eps = Derivative::some(SVector::from(std::array::from_fn(|i| f64::from(u8::from(i == k)))));
        variable
    });
    let ((q, z), system) = (start(&variables), kernel(&variables)?);
    let run = Simulation::new(&system).control(Fixed::by(RungeKutta(Classical4), number(STEP)));
    let end = run.run_to_end(q, z, number(0.0)..number(FLIGHT))?;
    let ends = place(&end.q);
    let slopes = ends.map(|end| end.eps.0.map_or([0.0; 6], |slopes| std::array::from_fn(|k| slopes[k])));
    Ok((ends.map(|end| end.re), slopes))
}

/// Variances and covariance: xx, xy, yy.
type Covariance = [f64; 3];

fn sampled(ends: &[[f64; 2]]) -> ([f64; 2], Covariance) {
    let count = ends.len() as f64;
    let mean = [0, 1].map(|i| ends.iter().map(|end| end[i]).sum::<f64>() / count);
    let moment = |i: usize, j: usize| {
        ends.iter().map(|end| (end[i] - mean[i]) * (end[j] - mean[j])).sum::<f64>() / (count - 1.0)
    };
    (mean, [moment(0, 0), moment(0, 1), moment(1, 1)])
}

fn predicted(slopes: &[[f64; 6]; 2]) -> Covariance {
    let sum = |i: usize, j: usize| (0..6).map(|k| slopes[i][k] * slopes[j][k] * DEVIATIONS[k] * DEVIATIONS[k]).sum();
    [sum(0, 0), sum(0, 1), sum(1, 1)]
}

/// The points with (x − m)ᵀ C⁻¹ (x − m) = r²: the images of a circle under the Cholesky factor of C.
fn ellipse([x, y]: [f64; 2], [xx, xy, yy]: Covariance, radius: f64) -> impl Iterator<Item = (f64, f64)> {
    let (a, b) = (xx.sqrt(), xy / xx.sqrt());
    let c = (yy - b * b).sqrt();
    (0..=180).map(move |n| {
        let (sine, cosine) = (TAU * f64::from(n) / 180.0).sin_cos();
        (x + radius * a * cosine, y + radius * (b * cosine + c * sine))
    })
}

/// How many ends lie within an ellipse.
fn share(ends: &[[f64; 2]], [x, y]: [f64; 2], [xx, xy, yy]: Covariance, radius: f64) -> f64 {
    let determinant = xx * yy - xy * xy;
    let within = |end: &&[f64; 2]| {
        let (u, v) = (end[0] - x, end[1] - y);
        (yy * u * u - 2.0 * xy * u * v + xx * v * v) <= radius * radius * determinant
    };
    ends.iter().filter(within).count() as f64 / ends.len() as f64
}

fn main() -> Result<(), Box<dyn Error>> {
    let style = ProgressStyle::with_template("{msg:12} {bar:50} {human_pos} of {human_len} throws, {eta} left")?;
    let bar = ProgressBar::new(THROWS as u64).with_style(style).with_message("Monte Carlo");
    let mut random = Random(20);
    let throws: Vec<[f64; 6]> =
        (0..THROWS).map(|_| std::array::from_fn(|k| MEAN[k] + DEVIATIONS[k] * random.normal())).collect();
    let begun = Instant::now();
    let ends = throw(&throws, &bar)?;
    bar.finish_and_clear();
    let seconds = begun.elapsed().as_secs_f64();
    let steps = THROWS as f64 * FLIGHT / STEP;
    println!(
        "{THROWS} throws of {FLIGHT} s in steps of {STEP} s: {seconds:.2} s, {:.0} ns a step",
        1e9 * seconds / steps
    );

    let (mean, covariance) = sampled(&ends);
    let (centre, slopes) = linearised()?;
    let prediction = predicted(&slopes);
    let deviations = |[xx, xy, yy]: Covariance| (xx.sqrt(), yy.sqrt(), xy / (xx * yy).sqrt());
    for (name, [x, y], covariance) in [("sampled", mean, covariance), ("linearised", centre, prediction)] {
        let (along, aside, correlation) = deviations(covariance);
        println!(
            "{name:11} mean {x:.4} m, {y:+.4} m; deviations {along:.4} m, {aside:.4} m; correlation {correlation:+.3}"
        );
    }
    // A normal distribution in the plane has 1 − exp(−r²/2) within r deviations.
    let within = [1.0, 2.0].map(|radius| share(&ends, centre, prediction, radius));
    println!(
        "within one and two deviations of the prediction: {:.1} % and {:.1} %",
        100.0 * within[0],
        100.0 * within[1]
    );
    println!(
        "  of a normal distribution: {:.1} % and {:.1} %",
        100.0 * (1.0 - (-0.5_f64).exp()),
        100.0 * (1.0 - (-2.0_f64).exp())
    );

    let scatter = scatter(&ends, (mean, covariance), (centre, prediction));
    let (range, drift) = sweep()?;
    let plots = [([0, 0, 1000, 900], scatter), ([1000, 0, 800, 450], range), ([1000, 450, 800, 450], drift)];
    write("monte_carlo", &mosaic("An oval ball of uncertain inertia and spin", (1800, 1000), &plots)?)?;
    write_page("monte_carlo", &mean_throw()?)
}

/// The mean throw as a page.
fn mean_throw() -> Result<Playback<OvalKernel<f64>>, Box<dyn Error>> {
    let (kernel, (q, z)) = (kernel(&MEAN)?, start(&MEAN));
    let path = Simulation::new(&kernel).adaptive(1e-9, 1e-9).run(q, z, 0.0..FLIGHT)?;
    let place = |s: &Sample<OvalKernel<f64>>| s.q.translation.vector;
    let mut page = Playback::new("The mean throw", &path)?
        .si()
        .body("ball", |s| s.q, [Shape::ellipsoid([0.14, 0.095, 0.095])])
        .follow("ball")
        .trace("ball", [0.0; 3])
        .trace("ball", [0.14, 0.0, 0.0]);
    for (k, element) in OvalKernel::<f64>::ELEMENTS.iter().enumerate() {
        // The speeds are (u, ω): what acts on them are a force in body axes and a torque.
        let force = |s: &Sample<OvalKernel<f64>>| -> Vector3<f64> {
            kernel.element_forces(s.t, &s.q, &s.z, &()).fixed_view::<3, 1>(0, k).into()
        };
        page = page.arrow(element.name, 0.08, |s| (place(s), s.q.rotation * force(s))).curve(
            "force / N",
            element.name,
            |s| force(s).norm(),
        );
    }
    Ok(page.energy(&kernel))
}

/// Range and drift over the spin.
fn sweep() -> Result<(Plot<'static>, Plot<'static>), Box<dyn Error>> {
    let spins: Vec<[f64; 6]> = (0..SPINS)
        .map(|i| {
            let mut throw = MEAN;
            throw[3] = 40.0 * i as f64 / (SPINS - 1) as f64;
            throw
        })
        .collect();
    let swept = throw(&spins, &ProgressBar::hidden())?;
    let curve = |k: usize| spins.iter().zip(&swept).map(move |(throw, end)| (throw[3] / TAU, end[k]));

    let x = ("spin about the long axis, turns a second", 0.0..40.0 / TAU);
    let bounds = |k: usize| {
        let (low, high) =
            curve(k).fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (_, y)| (low.min(y), high.max(y)));
        let margin = 0.08 * (high - low);
        low - margin..high + margin
    };
    let of = |k: usize, title, what, colour| {
        Plot::new(title, x.clone(), (what, bounds(k)), vec![Line::new("", colour, curve(k))])
    };
    Ok((of(0, "A sweep: the range", "along, m", COLOURS[2]), of(1, "and the drift", "aside, m", INK)))
}

/// Where throws end, and ellipses of their covariance and of that which is predicted.
fn scatter(
    ends: &[[f64; 2]],
    (mean, covariance): ([f64; 2], Covariance),
    (centre, prediction): ([f64; 2], Covariance),
) -> Plot<'static> {
    let reach = |i: usize, radii: f64| {
        let deviation = if i == 0 { prediction[0] } else { prediction[2] }.sqrt();
        centre[i] - radii * deviation..centre[i] + radii * deviation
    };
    let mut curves = Vec::new();
    for radius in [1.0, 2.0] {
        let name = |name: &str| if radius == 1.0 { name.to_owned() } else { String::new() };
        curves.push(Line::new(name("covariance of the throws"), COLOURS[0], ellipse(mean, covariance, radius)));
        curves.push(Line::new(name("linearised"), COLOURS[1], ellipse(centre, prediction, radius)).dashed());
    }
    let (x, y) = (("along the throw, m", reach(0, 4.0)), ("aside, m", reach(1, 4.0)));
    Plot::new("Where throws are after 1.6 s; one and two deviations", x, y, curves)
        .with_dots(ends.iter().take(DRAWN).map(|&[x, y]| (x, y)).collect())
}
