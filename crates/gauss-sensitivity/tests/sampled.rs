//! Controllers that sample: derivatives through what each sample makes of the state, and what is held in between.

use gauss_runtime::dual::Dual;
use gauss_runtime::integrate::SamplingMistake;
use gauss_runtime::prelude::*;
use gauss_sensitivity::{At, Cost, Derivatives, InputOf, Point, Run, SensitivityError, Start};

const PERIOD: f64 = 0.1;

/// ẍ = push/m.
#[derive(GaussDynamics)]
#[gauss(coordinates(x), particle(mass = m, position = [x, 0, 0]), input(push), drive(x = push))]
struct Cart<T> {
    m: T,
}

/// A cart that a computer brings to rest, by its mass, both gains and where it begins; with a wall at 0 or without.
struct Brought {
    instants: Vec<f64>,
    period: Option<f64>,
    wall: bool,
}

type Numbers<T> = [T; 4];

const NUMBERS: Numbers<f64> = [1.3, 1.0, 1.2, 1.0];

/// The part of its speed that the wall leaves.
const KEPT: f64 = 0.6;

fn law<T: Real>(&[_, k, d, _]: &Numbers<T>, x: T, v: T, t: T) -> T {
    -(k * x) - d * v - T::from_f64(0.3) * t
}

impl Run<4> for Brought {
    type System<T: Real> = CartKernel<T>;

    fn instants(&self) -> &[f64] {
        &self.instants
    }

    fn system<T: Real>(&self, &[m, ..]: &Numbers<T>) -> Result<CartKernel<T>, ParameterError> {
        Cart { m }.kernel()
    }

    fn start<T: Real>(&self, &[.., x]: &Numbers<T>, _: &CartKernel<T>) -> Start<CartKernel<T>> {
        (SVector::from([x]), SVector::from([T::zero()]))
    }

    fn input<T: Real>(&self, numbers: &Numbers<T>, at: &At<'_, CartKernel<T>>) -> InputOf<CartKernel<T>> {
        SVector::from([law(numbers, at.q[0], at.z[0], at.t)])
    }

    fn period(&self) -> Option<f64> {
        self.period
    }

    fn until<T: Real>(&self, _: &Numbers<T>, at: &At<'_, CartKernel<T>>) -> Option<(Crossing, T)> {
        self.wall.then_some((Crossing::Falling, at.q[0]))
    }

    fn jump<T: Real>(&self, _: &Numbers<T>, at: &At<'_, CartKernel<T>>) -> Option<Start<CartKernel<T>>> {
        self.wall.then(|| (*at.q, SVector::from([-(T::from_f64(KEPT) * at.z[0])])))
    }
}

impl Cost<4> for Brought {
    fn cost<T: Real>(&self, _: &Numbers<T>, at: &At<'_, CartKernel<T>>) -> T {
        T::from_f64(at.number as f64) * (at.q[0] * at.q[0] + at.q[0] * at.z[0])
    }
}

fn brought(instants: &[f64], wall: bool) -> Brought {
    Brought { instants: instants.to_vec(), period: Some(PERIOD), wall }
}

fn variables() -> Numbers<Dual<4>> {
    std::array::from_fn(|k| Dual::variable(NUMBERS[k], k))
}

/// The gradient is what the points of the forward run come to.
fn backward_is_forward(found: [f64; 4], points: &[Point<CartKernel<f64>, 4>], rounding: f64) {
    for k in 0..4 {
        let of = |(n, point): (usize, &Point<CartKernel<f64>, 4>)| {
            let [x, v] = [point.q[0], point.z[0]];
            n as f64 * ((2.0 * x + v) * point.q_slopes[0][k] + x * point.z_slopes[0][k])
        };
        let forward: f64 = points.iter().enumerate().map(of).sum();
        assert!((found[k] - forward).abs() < rounding && forward.abs() > 1e-3, "{k}: {found:?} {forward}");
    }
}

/// Instants between samples, at them, and where 3 · 0.1 is not 0.3.
#[test]
fn a_cart_has_the_derivatives_of_its_recursion() {
    let run = brought(&[0.0, 0.25, 0.3, 1.0, 1.97], false);
    let derivatives = Derivatives::fixed_step(0.04);
    let points = derivatives.run(&run, &NUMBERS).expect("runs");
    let gradient = derivatives.gradient(&run, &NUMBERS).expect("runs");
    // Parabolas from sample to sample, in dual numbers.
    let numbers = variables();
    let number = Dual::<4>::constant;
    for point in &points {
        let (mut x, mut v, mut n) = (numbers[3], number(0.0), 0);
        while PERIOD * f64::from(n) < point.t - 1e-9 {
            let t = PERIOD * f64::from(n);
            let (a, h) = (law(&numbers, x, v, number(t)) / numbers[0], number((point.t - t).min(PERIOD)));
            (x, v, n) = (x + h * v + number(0.5) * h * h * a, v + h * a, n + 1);
        }
        // Of 60 steps of twelve stages, with numbers up to 1.
        let near = |found: f64, expected: f64| (found - expected).abs() < 60.0 * 100.0 * f64::EPSILON;
        assert!(near(point.q[0], x.value) && near(point.z[0], v.value), "{}", point.t);
        for k in 0..4 {
            assert!(near(point.q_slopes[0][k], x.slopes[k]) && near(point.z_slopes[0][k], v.slopes[k]), "{}", point.t);
        }
    }
    backward_is_forward(gradient.by_numbers, &points, 10.0 * 60.0 * 100.0 * f64::EPSILON);
    // The initial state: its place is the fourth number.
    assert!((gradient.by_q[0] - gradient.by_numbers[3]).abs() < 1e-13);
    // With few states kept, what is held between samples is made again.
    for room in [1, 2, 5] {
        let few = derivatives.checkpoints(room).gradient(&run, &NUMBERS).expect("runs");
        assert_eq!((few.by_numbers, few.value), (gradient.by_numbers, gradient.value));
    }
    // A controller at every time is another one.
    let continuous = Brought { period: None, ..brought(&run.instants, false) };
    let other = derivatives.gradient(&continuous, &NUMBERS).expect("runs");
    assert!((other.value - gradient.value).abs() > 1e-3);
}

/// Bounces between samples: what was held goes on after them.
#[test]
fn samples_and_bounces_are_those_of_a_simulation_in_dual_numbers() {
    let run = brought(&[0.0, 1.0, 3.0], true);
    let derivatives = Derivatives::adaptive(1e-12, 1e-12);
    let points = derivatives.run(&run, &NUMBERS).expect("runs");
    let gradient = derivatives.gradient(&run, &NUMBERS).expect("runs");
    backward_is_forward(gradient.by_numbers, &points, 1e-10);

    let (numbers, number) = (variables(), Dual::<4>::constant);
    let kernel = Cart { m: numbers[0] }.kernel().expect("a cart");
    let simulation = Simulation::new(&kernel)
        .sampled(PERIOD, |t, q: &SVector<Dual<4>, 1>, z: &SVector<Dual<4>, 1>| {
            SVector::from([law(&numbers, q[0], z[0], t)])
        })
        .event(Crossing::Falling, |_, q: &SVector<Dual<4>, 1>, _| q[0])
        .then(|state| state.z[0] = -(number(KEPT) * state.z[0]))
        .adaptive(1e-12, 1e-12);
    let (q, z) = (SVector::from([numbers[3]]), SVector::from([number(0.0)]));
    let simulation = simulation.run(q, z, number(0.0)..number(3.0)).expect("runs");
    assert!(!simulation.events().is_empty());
    for point in &points[1..] {
        let state = simulation.at(number(point.t)).expect("within the run");
        for k in 0..4 {
            // Parabolas are exact; times of bounces are found to some roundings, over speeds of some tenths.
            let off = [point.q_slopes[0][k] - state.q[0].slopes[k], point.z_slopes[0][k] - state.z[0].slopes[k]];
            assert!(off.iter().all(|off| off.abs() < 1e-10), "{k} at {}: {off:?} {state:?}", point.t);
        }
    }
}

#[test]
fn samples_that_are_none_are_refused() {
    let derivatives = Derivatives::fixed_step(0.05);
    let refused = |instants: &[f64], period: f64| {
        let error = derivatives.gradient(&Brought { period: Some(period), ..brought(instants, false) }, &NUMBERS);
        match error.expect_err("no samples") {
            SensitivityError::Run(error) => error.kind,
            error => panic!("{error}"),
        }
    };
    let kind = |mistake| IntegrationErrorKind::Sampling { controller: 0, mistake };
    assert_eq!(refused(&[0.0, -1.0], 0.1), kind(SamplingMistake::Backward));
    for period in [0.0, -0.1, f64::INFINITY, 1e-17] {
        assert_eq!(refused(&[0.0, 1.0], period), kind(SamplingMistake::Period(period)));
    }
    assert!(matches!(refused(&[0.0, 1.0], f64::NAN), IntegrationErrorKind::Sampling { .. }));
}
