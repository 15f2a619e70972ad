//! Events and jumps in products of derivatives of steps: against derivatives of the same run by its initial state, in
//! dual numbers, and against closed forms.

use gauss_runtime::dual::Dual;
use gauss_runtime::integrate::{DiscreteLinearization, Fixed};
use gauss_runtime::prelude::*;
use gauss_sensitivity::{At, Derivatives, InputOf, Run, Saltation, SensitivityError, Start};

/// A ball with a heavy spot on a spring, with jets, over a floor that moves.
#[derive(GaussDynamics)]
#[gauss(
    linearize,
    coordinates(pose: Pose),
    body(ball, position = pose.position, rotation = pose.rotation, mass = 1.2, center_of_mass = [0.1, 0, 0.05],
         inertia = [0.2, 0.3, 0.25]),
    input(lift, turn),
    force(body = ball, value = [turn, 0, lift * (1 + 0.3 * sin(2 * t))]),
    spring(from = [0, 0, 1], to = ball.position + ball.rotation * [0, 0.1, 0], stiffness = 3),
)]
struct Ball<T> {
    #[gauss(gravity)]
    g: T,
}

/// A run by the increment of the pose, the speeds and both inputs; it bounces, or ends at the floor.
struct Bounces {
    instants: [f64; 2],
    ends: bool,
}

const STEP: f64 = 0.05;

/// Radius, and what of the speed is left.
const RADIUS: f64 = 0.2;
const KEPT: f64 = 0.7;

fn number<T: Real>(value: f64) -> T {
    T::from_f64(value)
}

fn floor<T: Real>(t: T) -> [T; 2] {
    let (sine, cosine) = (number::<T>(3.0) * t).sin_cos();
    [number::<T>(0.1) * sine, number::<T>(0.3) * cosine]
}

fn over_floor<T: Real>(t: T, q: &Isometry3<T>) -> T {
    q.translation.vector[2] - floor(t)[0] - number(RADIUS)
}

/// The velocity of O along the upward axis, in body axes, is turned back with a part of it.
fn bounced<T: Real>(t: T, q: &Isometry3<T>, z: &SVector<T, 6>) -> SVector<T, 6> {
    let [x, y, s, w] = q.rotation.as_ref().coords.data.0[0];
    let (one, two) = (T::one(), number::<T>(2.0));
    let up = [two * (x * s - w * y), two * (y * s + w * x), one - two * (x * x + y * y)];
    let speed = (0..3).fold(-floor(t)[1], |sum, i| sum + up[i] * z[i]);
    let mut after = *z;
    (0..3).for_each(|i| after[i] -= number::<T>(1.0 + KEPT) * speed * up[i]);
    after
}

impl Run<14> for Bounces {
    type System<T: Real> = BallKernel<T>;

    fn instants(&self) -> &[f64] {
        &self.instants
    }

    fn system<T: Real>(&self, _: &[T; 14]) -> Result<BallKernel<T>, ParameterError> {
        Ball { g: number(9.81) }.kernel()
    }

    fn start<T: Real>(&self, numbers: &[T; 14], _: &BallKernel<T>) -> Start<BallKernel<T>> {
        let half = number::<T>(0.5);
        let rotation = UnitQuaternion::new_unchecked(Quaternion::from(SVector::from([half, -half, half, half])));
        let translation = SVector::from([0.1, -0.2, 0.8].map(number::<T>)).into();
        let pose = Isometry3 { translation, rotation };
        let sigma = SVector::from(std::array::from_fn(|i| numbers[i]));
        (pose.retract(&sigma), SVector::from(std::array::from_fn(|i| numbers[6 + i])))
    }

    fn input<T: Real>(&self, numbers: &[T; 14], _: &At<'_, BallKernel<T>>) -> InputOf<BallKernel<T>> {
        SVector::from([numbers[12], numbers[13]])
    }

    fn until<T: Real>(&self, _: &[T; 14], at: &At<'_, BallKernel<T>>) -> Option<(Crossing, T)> {
        Some((Crossing::Falling, over_floor(at.t, at.q)))
    }

    fn jump<T: Real>(&self, _: &[T; 14], at: &At<'_, BallKernel<T>>) -> Option<Start<BallKernel<T>>> {
        (!self.ends).then(|| (*at.q, bounced(at.t, at.q, at.z)))
    }
}

const NUMBERS: [f64; 14] = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.3, -0.5, 0.4, 1.0, -2.0, 0.5, 0.6, -0.4];

type Step = DiscreteLinearization<BallKernel<f64>, 12, 2>;

/// The product of all steps of a run, from event to event; the last saltation, and how many there are.
fn product(instants: [f64; 2], ends: bool) -> (Option<Step>, Option<Saltation<BallKernel<f64>, 12, 2>>, usize) {
    let bounces = Bounces { instants, ends };
    let kernel = bounces.system(&NUMBERS).expect("a ball");
    // Not a divisor of the directions.
    let dual = Ball { g: Dual::<5>::constant(9.81) }.kernel().expect("a ball");
    let input = SVector::from([NUMBERS[12], NUMBERS[13]]);
    let (mut q, mut z) = bounces.start(&NUMBERS, &kernel);
    let run = Simulation::new(&kernel)
        .input(move |_, _, _| input)
        .event(Crossing::Falling, |t, q: &Isometry3<f64>, _| over_floor(t, q))
        .then(|state| state.z = bounced(state.t, &state.q, &state.z))
        .control(Fixed::by(CommutatorFree4, STEP));
    let run = run.run(q, z, instants[0]..instants[1]).expect("bounces");
    let times: Vec<f64> = run.iter().map(|sample| sample.t).collect();
    let (mut whole, mut last, mut count): (Option<Step>, Option<Saltation<_, 12, 2>>, _) = (None, None, 0);
    for pair in times.windows(2) {
        if pair[0] == pair[1] {
            let before = whole.take().expect("steps before it");
            let jump = |at: &At<'_, BallKernel<Dual<5>>>| {
                if ends { (*at.q, *at.z) } else { (*at.q, bounced(at.t, at.q, at.z)) }
            };
            let event = Saltation::after(&before, &dual, |at| over_floor(at.t, at.q), jump).expect("an event");
            // Zeros are found to some roundings of times.
            assert!(event.early.abs() < 1e-14, "{:e}", event.early);
            (q, z, count) = (event.step.q, event.step.z, count + 1);
            last = Some(event);
            if ends {
                break;
            }
            continue;
        }
        let step = CommutatorFree4.step_linearized(&kernel, pair[0], &q, &z, &input, pair[1] - pair[0]).expect("steps");
        (q, z) = (step.q, step.z);
        whole = Some(match (&whole, &last) {
            (Some(whole), _) => whole.then(&step),
            (None, Some(event)) => event.then(&step),
            (None, None) => step,
        });
    }
    (whole, last, count)
}

/// The same entries by dual numbers through the run: a few hundred operations for each of 20 steps, of numbers up to
/// 10, which the motion and each bounce make larger by some ten.
const ROUNDING: f64 = 1e2 * 20.0 * 10.0 * 10.0 * f64::EPSILON;

#[test]
fn the_product_over_bounces_is_the_derivative_by_the_initial_state() {
    for end in [0.75, 1.6] {
        let (whole, _, count) = product([0.2, end], false);
        let whole = whole.expect("steps");
        assert_eq!(count, if end < 1.0 { 1 } else { 3 });
        let derivatives = Derivatives::by(Fixed::by(CommutatorFree4, STEP));
        let points = derivatives.run(&Bounces { instants: [0.2, end], ends: false }, &NUMBERS).expect("bounces");
        let row = |i: usize| if i < 6 { points[1].q_slopes[i] } else { points[1].z_slopes[i - 6] };
        let size = whole.by_state.amax();
        for i in 0..12 {
            for k in 0..14 {
                let found = if k < 12 { whole.by_state[(i, k)] } else { whole.by_input[(i, k - 12)] };
                assert!((found - row(i)[k]).abs() < ROUNDING * size, "{end}, {i}, {k}: {found} {}", row(i)[k]);
            }
        }
        // Without the bounce it is another matrix.
        assert!(size > 1.5, "{size}");
    }
}

#[test]
fn a_run_that_an_event_ends_has_the_derivative_of_its_time() {
    let (_, event, _) = product([0.2, 1.6], true);
    let event = event.expect("an event");
    let derivatives = Derivatives::by(Fixed::by(CommutatorFree4, STEP));
    let points = derivatives.run(&Bounces { instants: [0.2, 1.6], ends: true }, &NUMBERS).expect("ends");
    let point = points.last().expect("an end");
    assert!(point.ended);
    for k in 0..14 {
        let by_time = if k < 12 { event.time_by_state[k] } else { event.time_by_input[k - 12] };
        assert!((by_time - point.t_slopes[k]).abs() < ROUNDING, "{k}: {by_time} {}", point.t_slopes[k]);
        for i in 0..12 {
            let found = if k < 12 { event.step.by_state[(i, k)] } else { event.step.by_input[(i, k - 12)] };
            let expected = if i < 6 { point.q_slopes[i][k] } else { point.z_slopes[i - 6][k] };
            assert!((found - expected).abs() < ROUNDING, "{i} {k}: {found} {expected}");
        }
    }
    assert!(event.time_by_state.amax() > 0.05 && event.time_by_input.amax() > 1e-3);
}

/// Steps that start later, over a floor that moves with time: differences of whole runs.
#[test]
fn a_later_start_moves_the_end() {
    let at = |late: f64| product([0.2 + late, 0.75 + late], false).0.expect("steps");
    let e = 1e-3;
    let (found, ahead, back) = (at(0.0), at(e), at(-e));
    let moved = |end: &Step| {
        let sigma = found.q.difference(&end.q);
        SVector::<f64, 12>::from_fn(|i, _| if i < 6 { sigma[i] } else { (end.z - found.z)[i - 6] })
    };
    let slope = (moved(&ahead) - moved(&back)) / (2.0 * e);
    // Third derivatives of up to some hundred; steps about the event are other ones, off by h⁵ times such.
    let allowed = 300.0 * e * e / 6.0 + 100.0 * STEP.powi(4);
    assert!((found.by_time - slope).amax() < allowed && slope.amax() > 10.0 * allowed, "{} {slope}", found.by_time);
}

/// An event that changes nothing leaves the product as it is, up to the order of the method.
#[test]
fn events_without_jumps_change_nothing() {
    let kernel = Ball { g: 9.81 }.kernel().expect("a ball");
    let dual = Ball { g: Dual::<4>::constant(9.81) }.kernel().expect("a ball");
    let (q, z) = Bounces { instants: [0.0, 1.0], ends: false }.start(&NUMBERS, &kernel);
    let input = SVector::from([0.6, -0.4]);
    let off = |h: f64| {
        let one = |t: f64, q: &_, z: &_| CommutatorFree4.step_linearized(&kernel, t, q, z, &input, h).expect("steps");
        let first = one(0.0, &q, &z);
        let second = one(h, &first.q, &first.z);
        let height = Dual::constant(first.q.translation.vector[2]);
        let event = Saltation::after(&first, &dual, |at| at.q.translation.vector[2] - height, |at| (*at.q, *at.z));
        let event = event.expect("an event");
        assert!(event.early == 0.0 && event.time_by_state.amax() > 0.1);
        let (with, without) = (event.then(&second), first.then(&second));
        (with.by_state - without.by_state).amax().max((with.by_time - without.by_time).amax())
    };
    let (coarse, fine) = (off(0.04), off(0.01));
    // f at the end of a step and at the start of the next one agree up to h⁴, and the next power of h counts little.
    let order = (coarse / fine).ln() / 4.0_f64.ln();
    assert!(order > 3.5 && fine < 1e-6, "order {order}: {coarse:e} {fine:e}");
}

/// A stone that is thrown.
#[derive(GaussDynamics)]
#[gauss(linearize, coordinates(height), particle(mass = m, position = [0, 0, height]), gravity = 10)]
struct Stone<T> {
    m: T,
}

/// At the top of a throw the height touches its largest value; a jump of an infinite speed has no derivative.
#[test]
fn events_without_a_derivative_are_refused() {
    let (kernel, dual) = (Stone { m: 1.0 }.kernel().unwrap(), Stone { m: Dual::<3>::constant(1.0) }.kernel().unwrap());
    let (q, z) = (SVector::from([0.0]), SVector::from([5.0]));
    let step = |h: f64| CommutatorFree4.step_linearized(&kernel, 0.0, &q, &z, &(), h).expect("steps");
    let stays = |at: &At<'_, StoneKernel<Dual<3>>>| (*at.q, *at.z);
    let top = |at: &At<'_, StoneKernel<Dual<3>>>| at.q[0] - Dual::constant(1.25);
    let error = Saltation::after(&step(0.5), &dual, top, stays).expect_err("touches");
    assert!(matches!(error, SensitivityError::NoDerivative { time: 0.5, .. }), "{error}");
    // On the way it passes.
    let on_the_way = Saltation::after(&step(0.3), &dual, top, stays).expect("passes");
    // It lacks 0.2 m at 2 m/s.
    assert!((on_the_way.early - 0.1).abs() < 1e-14, "{on_the_way:?}");
    let root = |at: &At<'_, StoneKernel<Dual<3>>>| (*at.q, SVector::from([(at.z[0] - Dual::constant(2.0)).sqrt()]));
    let error = Saltation::after(&step(0.25), &dual, top, |at| (*at.q, SVector::from([(at.z[0] - at.z[0]).ln()])));
    assert!(matches!(error, Err(SensitivityError::NonFinite { .. })), "{error:?}");
    assert!(Saltation::after(&step(0.25), &dual, top, root).is_ok());
}
