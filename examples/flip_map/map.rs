//! Which pendulums flip, and when: the runs, and what must hold of them.

use std::error::Error;
use std::f64::consts::PI;
use std::time::Instant;

use gauss_batch::{Batch, States};
use gauss_runtime::prelude::*;
use indicatif::{ProgressBar, ProgressStyle};
use wide::f64x8;

/// Two equal weights on two equal rods, in the plane: angles from the vertical.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(upper, lower),
    particle(mass = mass, position = [length * sin(upper), 0, -length * cos(upper)]),
    particle(mass = mass, position = [length * (sin(upper) + sin(lower)), 0, -length * (cos(upper) + cos(lower))]),
)]
struct Pendulums<T> {
    mass: T,
    length: T,
    #[gauss(gravity)]
    gravity: T,
}

/// With masses, lengths and weights of one: times are in √(length / gravity).
fn pendulums<T: Real>() -> Result<PendulumsKernel<T>, ParameterError> {
    Pendulums { mass: T::one(), length: T::one(), gravity: T::one() }.kernel()
}

/// How long a run lasts at most.
pub const LONGEST: f64 = 200.0;
/// Relative and absolute tolerance.
pub const TOLERANCE: f64 = 1e-9;

/// When an arm first goes over the top, and which; `None`: not within [`LONGEST`].
pub type Flip = Option<(f64, usize)>;

/// Flips of states at rest, the largest error of their energies, and the most steps that one of them took.
pub fn flips(starts: &[[f64; 2]], tolerance: f64, bar: &ProgressBar) -> Result<(Vec<Flip>, f64, u64), Box<dyn Error>> {
    let kernel = pendulums::<f64x8>()?;
    let rest = SVector::from([0.0, 0.0]);
    let mut states = States::<PendulumsKernel<f64x8>>::from_fn(starts.len(), |i| (SVector::from(starts[i]), rest));
    // Zero where an angle is a half turn, to either side.
    let top = |angle: f64x8| angle * angle - f64x8::splat(PI * PI);
    let ends = Batch::new(&kernel)
        .adaptive(tolerance, tolerance)
        .until(Crossing::Rising, |_t, q: &SVector<f64x8, 2>, _z| top(q[0]))
        .until(Crossing::Rising, |_t, q: &SVector<f64x8, 2>, _z| top(q[1]))
        .progress(&|_| bar.inc(1))
        .run_on_all_threads(0.0..LONGEST, &mut states);

    let kernel = pendulums::<f64>()?;
    let energy = |q: &_, z: &_| kernel.kinetic_energy(0.0, q, z) + kernel.potential_energy(0.0, q);
    let (mut error, mut steps) = (0.0_f64, 0);
    let mut flips = Vec::with_capacity(starts.len());
    for ((end, start), (q, z)) in ends.into_iter().zip(starts).zip(states.iter()) {
        let end = end?;
        steps = steps.max(end.summary.steps);
        flips.push(end.stopped_by.map(|arm| (end.time, arm)));
        error = error.max((energy(&q, &z) - energy(&SVector::from(*start), &rest)).abs());
    }
    Ok((flips, error, steps))
}

/// Whether the energy at rest suffices for the lower weight to come above the upper one, the lowest place over the top:
/// with potential energy −2 cos θ₁ − cos θ₂ that place has −2 + 1.
fn may_flip([upper, lower]: [f64; 2]) -> bool {
    2.0 * upper.cos() + lower.cos() <= 1.0
}

/// The map: states at rest in the middles of cells, rows of one angle of the lower arm.
pub struct Map {
    pub side: usize,
    pub flips: Vec<Flip>,
}

impl Map {
    pub fn angles(side: usize, cell: usize) -> [f64; 2] {
        // Mirror images to the last bit.
        [cell % side, cell / side].map(|n| PI * ((2 * n + 1) as f64 - side as f64) / side as f64)
    }

    /// Half of the runs; the others are their mirror images.
    pub fn run(side: usize) -> Result<Self, Box<dyn Error>> {
        let half: Vec<_> = (0..side * side / 2).map(|cell| Self::angles(side, cell)).collect();
        let style = ProgressStyle::with_template("{bar:50} {human_pos} of {human_len} runs, {eta} left")?;
        let bar = ProgressBar::new(half.len() as u64).with_style(style);
        let begun = Instant::now();
        let (mut flips, error, steps) = flips(&half, TOLERANCE, &bar)?;
        bar.finish_and_clear();
        let seconds = begun.elapsed().as_secs_f64();
        let time: f64 = flips.iter().map(|flip| flip.map_or(LONGEST, |(time, _)| time)).sum();
        println!(
            "{} runs of at most {LONGEST} √(ℓ/g): {seconds:.2} s, {:.0} ns a run and unit of time; energies are off by at most \
             {error:.0e}",
            half.len(),
            1e9 * seconds / time
        );
        // The error of a step is below the tolerance times numbers of order 1.
        assert!(error < steps as f64 * TOLERANCE);
        flips.extend_from_within(..);
        flips[side * side / 2..].reverse();
        Ok(Self { side, flips })
    }

    /// What must hold whatever the tolerance: energy forbids some flips, and mirror images have the same times.
    pub fn check(&self) -> Result<(), Box<dyn Error>> {
        let states: Vec<_> = (0..self.flips.len()).map(|cell| Self::angles(self.side, cell)).collect();
        let forbidden = states.iter().filter(|&&state| !may_flip(state)).count();
        let flipped = |(state, flip): (&[f64; 2], &Flip)| flip.is_some() && !may_flip(*state);
        assert!(!states.iter().zip(&self.flips).any(flipped), "a pendulum went over the top without the energy to");
        let ever = self.flips.iter().flatten().count();
        println!(
            "{ever} of {} states flip; {forbidden} have too little energy, and none of them does; {} could and do not",
            states.len(),
            states.len() - forbidden - ever
        );

        // All over the map: 7919 is a prime that divides no number of cells asked for.
        let sample: Vec<_> = (0..1000.min(states.len())).map(|n| n * 7919 % states.len()).collect();
        let mirrored: Vec<_> = sample.iter().map(|&cell| states[cell].map(|angle| -angle)).collect();
        let hidden = ProgressBar::hidden();
        let (images, ..) = flips(&mirrored, TOLERANCE, &hidden)?;
        assert!(
            sample.iter().zip(&images).all(|(&cell, image)| self.flips[cell] == *image),
            "an image has another time"
        );

        // Neighbours part exponentially: late times are those of some pendulum nearby, not of this one.
        let asked: Vec<_> = sample.iter().map(|&cell| states[cell]).collect();
        let (finer, ..) = flips(&asked, 1e-3 * TOLERANCE, &hidden)?;
        println!("of flips, the share whose time is the same to 1e-6 at a thousandth of the tolerance:");
        for (from, to) in [(0.0, 10.0), (10.0, 30.0), (30.0, 60.0), (60.0, LONGEST)] {
            let within = |flip: &Flip| flip.is_some_and(|(time, _)| (from..to).contains(&time));
            let pairs: Vec<_> =
                sample.iter().map(|&cell| self.flips[cell]).zip(&finer).filter(|(flip, _)| within(flip)).collect();
            let same = |(flip, finer): &&(Flip, &Flip)| match (flip, finer) {
                (Some((a, _)), Some((b, _))) => (a - b).abs() < 1e-6 * a,
                _ => false,
            };
            let agree = pairs.iter().filter(same).count();
            println!("  between {from:>3} and {to:>3}: {agree} of {}", pairs.len());
        }
        Ok(())
    }
}
