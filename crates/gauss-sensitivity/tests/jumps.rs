//! Runs that go on from their events in another state: closed forms, and dual numbers through the same run.

use gauss_runtime::dual::Dual;
use gauss_runtime::prelude::*;
use gauss_sensitivity::{At, Cost, Derivatives, Run, SensitivityError, Start};

/// A ball.
#[derive(GaussDynamics)]
#[gauss(coordinates(height), particle(mass = 1, position = [0, 0, height]))]
struct Ball<T> {
    #[gauss(gravity)]
    g: T,
}

/// Derivatives by the height from which it falls, the part of its speed that a bounce keeps, and weight.
struct Bounces;

impl Run<3> for Bounces {
    type System<T: Real> = BallKernel<T>;

    fn instants(&self) -> &[f64] {
        &[0.0, 0.9, 1.5]
    }

    fn system<T: Real>(&self, &[_, _, g]: &[T; 3]) -> Result<BallKernel<T>, ParameterError> {
        Ball { g }.kernel()
    }

    fn start<T: Real>(&self, &[height, _, _]: &[T; 3], _: &BallKernel<T>) -> Start<BallKernel<T>> {
        (SVector::from([height]), SVector::from([T::zero()]))
    }

    fn until<T: Real>(&self, _: &[T; 3], at: &At<'_, BallKernel<T>>) -> Option<(Crossing, T)> {
        Some((Crossing::Falling, at.q[0]))
    }

    fn jump<T: Real>(&self, &[_, kept, _]: &[T; 3], at: &At<'_, BallKernel<T>>) -> Option<Start<BallKernel<T>>> {
        Some((*at.q, SVector::from([-(kept * at.z[0])])))
    }
}

impl Cost<3> for Bounces {
    fn cost<T: Real>(&self, _: &[T; 3], at: &At<'_, BallKernel<T>>) -> T {
        T::from_f64(at.number as f64) * (at.q[0] * at.q[0] + at.z[0])
    }
}

/// Height and speed at a time: a fall of √(2h/g), then flights of 2v/g.
fn closed_form<T: Real>([height, kept, g]: [T; 3], t: f64) -> [T; 2] {
    let (t, two) = (T::from_f64(t), T::from_f64(2.0));
    let mut since = (two * height / g).sqrt();
    let mut v = (two * g * height).sqrt();
    loop {
        v = kept * v;
        let flight = two * v / g;
        let s = t - since;
        if s.lane(0) < flight.lane(0) {
            return [v * s - g * s * s / two, v - g * s];
        }
        since += flight;
    }
}

#[test]
fn a_bouncing_ball_has_the_derivatives_of_its_closed_form() {
    // Falls for 0.44 s, then flights of 0.71 s and 0.57 s: one bounce up to 0.9 s, two up to 1.5 s.
    let numbers = [0.95, 0.8, 9.81];
    let derivatives = Derivatives::adaptive(1e-12, 1e-12);
    let points = derivatives.run(&Bounces, &numbers).expect("bounces");
    let gradient = derivatives.gradient(&Bounces, &numbers).expect("bounces");
    let variables: [Dual<3>; 3] = std::array::from_fn(|k| Dual::variable(numbers[k], k));
    assert!(points.len() == 3 && points.iter().all(|point| !point.ended && point.t_slopes == [0.0; 3]));
    let mut cost = Dual::<3>::constant(0.0);
    for (number, point) in points.iter().enumerate().skip(1) {
        let [height, speed] = closed_form(variables, point.t);
        cost += Dual::constant(number as f64) * (height * height + speed);
        // Some ten tolerances, of slopes up to 10.
        assert!((point.q[0] - height.value).abs() < 1e-10 && (point.z[0] - speed.value).abs() < 1e-10);
        for k in 0..3 {
            assert!((point.q_slopes[0][k] - height.slopes[k]).abs() < 1e-9, "{number} {k}: {height:?}");
            assert!((point.z_slopes[0][k] - speed.slopes[k]).abs() < 1e-9, "{number} {k}: {speed:?}");
        }
    }
    assert!((gradient.value - cost.value).abs() < 1e-10);
    for k in 0..3 {
        assert!((gradient.by_numbers[k] - cost.slopes[k]).abs() < 1e-8, "{k}: {gradient:?} {cost:?}");
    }
    // The same with few states kept, whose steps are made again over the jumps.
    let few = Derivatives::adaptive(1e-12, 1e-12).checkpoints(2).gradient(&Bounces, &numbers).expect("bounces");
    assert!((0..3).all(|k| few.by_numbers[k] == gradient.by_numbers[k]));
}

/// A pendulum with drag.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(angle), particle(mass = 0.3, position = [l * sin(angle), 0, -l * cos(angle)]),
    damping = c / 2 * rate(angle) * rate(angle), gravity = 9.81,
)]
struct Pendulum<T> {
    l: T,
    c: T,
}

/// Derivatives by length, drag, the part that a bounce keeps and how far the wall swings, by which the time of a bounce
/// enters the jump.
struct Wall;

/// The angle of the wall and its rate.
fn wall<T: Real>(far: T, t: T) -> [T; 2] {
    let (sine, cosine) = (T::from_f64(3.0) * t).sin_cos();
    [T::from_f64(0.2) + far * sine, T::from_f64(3.0) * far * cosine]
}

fn bounce<T: Real>(kept: T, far: T, t: T, z: T) -> T {
    let [_, rate] = wall(far, t);
    rate - kept * (z - rate)
}

impl Run<4> for Wall {
    type System<T: Real> = PendulumKernel<T>;

    fn instants(&self) -> &[f64] {
        &[0.0, 0.5, 1.0, 2.5]
    }

    fn system<T: Real>(&self, &[l, c, _, _]: &[T; 4]) -> Result<PendulumKernel<T>, ParameterError> {
        Pendulum { l, c }.kernel()
    }

    fn start<T: Real>(&self, _: &[T; 4], _: &PendulumKernel<T>) -> Start<PendulumKernel<T>> {
        (SVector::from([T::from_f64(-0.9)]), SVector::from([T::zero()]))
    }

    fn until<T: Real>(&self, &[_, _, _, far]: &[T; 4], at: &At<'_, PendulumKernel<T>>) -> Option<(Crossing, T)> {
        Some((Crossing::Rising, at.q[0] - wall(far, at.t)[0]))
    }

    fn jump<T: Real>(&self, numbers: &[T; 4], at: &At<'_, PendulumKernel<T>>) -> Option<Start<PendulumKernel<T>>> {
        let &[_, _, kept, far] = numbers;
        Some((*at.q, SVector::from([bounce(kept, far, at.t, at.z[0])])))
    }
}

impl Cost<4> for Wall {
    fn cost<T: Real>(&self, _: &[T; 4], at: &At<'_, PendulumKernel<T>>) -> T {
        at.q[0] * at.z[0] + at.q[0]
    }
}

#[test]
fn backward_and_forward_are_dual_numbers_through_the_same_run() {
    let numbers = [0.5, 0.02, 0.7, 0.05];
    let derivatives = Derivatives::adaptive(1e-12, 1e-12);
    let points = derivatives.run(&Wall, &numbers).expect("swings");
    let gradient = derivatives.gradient(&Wall, &numbers).expect("swings");

    let [l, c, kept, far]: [Dual<4>; 4] = std::array::from_fn(|k| Dual::variable(numbers[k], k));
    let kernel = Pendulum { l, c }.kernel().expect("a pendulum");
    let run = Simulation::new(&kernel)
        .event(Crossing::Rising, move |t, q: &SVector<Dual<4>, 1>, _| q[0] - wall(far, t)[0])
        .then(move |state| state.z[0] = bounce(kept, far, state.t, state.z[0]))
        .adaptive(1e-12, 1e-12);
    let number = Dual::<4>::constant;
    let run = run.run(SVector::from([number(-0.9)]), SVector::from([number(0.0)]), number(0.0)..number(2.5));
    let run = run.expect("swings");
    assert!(run.events().len() >= 3, "{}", run.events().len());
    let mut cost = number(-0.9);
    for point in &points[1..] {
        let state = run.at(number(point.t)).expect("within the run");
        cost = cost + state.q[0] * state.z[0] + state.q[0];
        for k in 0..4 {
            // Steps are other ones: tolerances, times slopes of up to 100 of speeds.
            let off = [point.q_slopes[0][k] - state.q[0].slopes[k], point.z_slopes[0][k] - state.z[0].slopes[k]];
            assert!(off.iter().all(|off| off.abs() < 1e-7), "{k} at {}: {off:?} {state:?}", point.t);
        }
    }
    assert!((gradient.value - cost.value).abs() < 1e-9);
    for k in 0..4 {
        assert!((gradient.by_numbers[k] - cost.slopes[k]).abs() < 1e-7, "{k}: {gradient:?} {cost:?}");
    }
    // By steps of one length as well: exact derivatives of these steps, so that both ways agree to rounding.
    let fixed = Derivatives::fixed_step(0.01);
    let (points, gradient) =
        (fixed.run(&Wall, &numbers).expect("swings"), fixed.gradient(&Wall, &numbers).expect("swings"));
    for k in 0..4 {
        let of = |point: &gauss_sensitivity::Point<PendulumKernel<f64>, 4>| {
            point.q_slopes[0][k] * (point.z[0] + 1.0) + point.q[0] * point.z_slopes[0][k]
        };
        let forward: f64 = points.iter().map(of).sum();
        assert!(
            (gradient.by_numbers[k] - forward).abs() < 1e-10 * forward.abs().max(1.0),
            "{k}: {gradient:?} {forward}"
        );
    }
}

/// A ball that keeps half of its speed comes to rest by infinitely many bounces, at 1.3 s: no run goes over that.
struct Piles;

impl Run<1> for Piles {
    type System<T: Real> = BallKernel<T>;

    fn instants(&self) -> &[f64] {
        &[0.0, 2.0]
    }

    fn system<T: Real>(&self, &[g]: &[T; 1]) -> Result<BallKernel<T>, ParameterError> {
        Ball { g }.kernel()
    }

    fn start<T: Real>(&self, _: &[T; 1], _: &BallKernel<T>) -> Start<BallKernel<T>> {
        (SVector::from([T::one()]), SVector::from([T::zero()]))
    }

    fn until<T: Real>(&self, _: &[T; 1], at: &At<'_, BallKernel<T>>) -> Option<(Crossing, T)> {
        Some((Crossing::Falling, at.q[0]))
    }

    fn jump<T: Real>(&self, _: &[T; 1], at: &At<'_, BallKernel<T>>) -> Option<Start<BallKernel<T>>> {
        Some((*at.q, SVector::from([-(T::from_f64(0.5) * at.z[0])])))
    }
}

impl Cost<1> for Piles {
    fn cost<T: Real>(&self, _: &[T; 1], at: &At<'_, BallKernel<T>>) -> T {
        at.q[0]
    }
}

#[test]
fn jumps_that_pile_up_end_with_an_error() {
    let error = Derivatives::adaptive(1e-10, 1e-10).gradient(&Piles, &[9.81]).expect_err("piles up");
    let SensitivityError::Run(cause) = &error else { panic!("{error}") };
    assert!(matches!(cause.kind, IntegrationErrorKind::Zeno { event: 0, .. }), "{error}");
    assert!((cause.time - 3.0 * (2.0_f64 / 9.81).sqrt()).abs() < 1e-5, "{error}");
}
