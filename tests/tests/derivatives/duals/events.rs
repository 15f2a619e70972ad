//! Derivatives of runs through their events, against closed forms in the same numbers, and against differences.

use gauss_adapters::DualNumber;
use gauss_runtime::integrate::{Control, Fixed, IntegrationErrorKind, RungeKutta};
use gauss_runtime::prelude::*;
use num_dual::{Derivative, Dual64, DualSVec64, HyperDual64};

/// A particle above a floor.
#[derive(GaussDynamics)]
#[gauss(coordinates(height), particle(mass = 1, position = [0, 0, height]))]
struct Ball<T> {
    #[gauss(gravity)]
    g: T,
}

/// Two of them, that know nothing of one another.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b),
    particle(mass = m, position = [0, 0, a]),
    particle(mass = 3, position = [1, 0, b]),
)]
struct Two<T> {
    m: T,
    #[gauss(gravity)]
    g: T,
}

/// x = sin √k t / √k from (0, 1).
#[derive(GaussDynamics)]
#[gauss(coordinates(x), particle(mass = 1, position = [x, 0, 0]), spring(along = x, stiffness = k))]
struct Spring<T> {
    k: T,
}

/// A point on a ring, as a constraint.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    particle(mass = 1, position = [x, 0, y]),
    constraint(position = x * x + y * y - r * r),
)]
struct Ring<T> {
    r: T,
    #[gauss(gravity)]
    g: T,
}

/// A number with three derivatives, of which one is 1.
pub type Three = DualNumber<DualSVec64<3>>;

pub fn variables(values: [f64; 3]) -> [Three; 3] {
    core::array::from_fn(|i| {
        let mut x = DualSVec64::from_re(values[i]);
        x.eps = Derivative::some(SVector::from_fn(|j, _| f64::from(u8::from(i == j))));
        DualNumber(x)
    })
}

/// The value and the derivatives.
pub fn parts(x: Three) -> [f64; 4] {
    let eps = x.eps.0.unwrap_or_else(SVector::zeros);
    [x.re, eps[0], eps[1], eps[2]]
}

/// Falls from h, keeps e of its speed each time: impacts, height and speed at t = 2.
fn bounces<T: Real>(control: impl Control<BallKernel<T>>, [h, e, g]: [T; 3]) -> (Vec<T>, [T; 2]) {
    let kernel = Ball { g }.kernel().expect("a ball");
    let run = Simulation::new(&kernel)
        .event(Crossing::Falling, |_, q: &SVector<T, 1>, _| q[0])
        .then(|state| state.z[0] = -e * state.z[0])
        .control(control)
        .run(SVector::from([h]), SVector::from([T::zero()]), T::zero()..T::from_f64(2.0))
        .expect("bounces");
    let last = run.last();
    (run.events().iter().map(|event| event.sample.t).collect(), [last.q[0], last.z[0]])
}

/// The same by hand.
pub fn closed_form<T: Real>([h, e, g]: [T; 3], impacts: usize) -> (Vec<T>, [T; 2]) {
    let two = T::from_f64(2.0);
    let (mut t, mut v) = ((two * h / g).sqrt(), (two * h * g).sqrt());
    let mut times = vec![t];
    for _ in 1..impacts {
        v *= e;
        t += two * v / g;
        times.push(t);
    }
    let (left, v) = (two - t, e * v);
    (times, [left * (v - g * left / two), v - g * left])
}

#[test]
fn times_of_impacts_and_the_flight_after_them_have_derivatives() {
    fn compare(control: impl Control<BallKernel<Three>>, values: [f64; 3]) {
        let (times, end) = bounces(control, variables(values));
        assert!(times.len() >= 3, "{times:?}");
        let (expected, last) = closed_form(variables(values), times.len());
        for (x, y) in times.into_iter().chain(end).zip(expected.into_iter().chain(last)) {
            for (x, y) in parts(x).into_iter().zip(parts(y)) {
                // Numbers up to 10, of some 100 steps; parabolas are exact but for rounding.
                assert!((x - y).abs() < 1e-11, "{x} {y}");
            }
        }
    }
    compare(Adaptive::new(1e-10, 1e-10), [1.0, 0.8, 9.81]);
    compare(Adaptive::new(1e-3, 1e-3), [0.3, 0.9, 3.0]);
    compare(Fixed::by(RungeKutta(DormandPrince8), Three::from_f64(0.013)), [1.0, 0.8, 9.81]);
}

#[test]
fn values_are_those_of_plain_numbers() {
    let values = [1.0, 0.8, 9.81];
    let (times, end) = bounces(Adaptive::new(1e-10, 1e-10), variables(values));
    let (plain, plain_end) = bounces(Adaptive::new(1e-10, 1e-10), values);
    for (x, y) in times.into_iter().chain(end).zip(plain.into_iter().chain(plain_end)) {
        // num-dual divides by reciprocals: another rounding in each of some 100 operations.
        assert!((x.re - y).abs() < 1e-13, "{} {y}", x.re);
    }
}

#[test]
fn second_derivatives_pass_events_too() {
    let number = |x: f64| DualNumber(HyperDual64::from_re(x));
    let h = DualNumber(HyperDual64::from_re(1.0).derivative1());
    let e = DualNumber(HyperDual64::from_re(0.8).derivative2());
    for [h, e] in [[h, e], [DualNumber(h.derivative2()), number(0.8)]] {
        let (times, end) = bounces(Adaptive::new(1e-10, 1e-10), [h, e, number(9.81)]);
        let (expected, last) = closed_form([h, e, number(9.81)], times.len());
        for (x, y) in times.into_iter().chain(end).zip(expected.into_iter().chain(last)) {
            assert!((x.eps1eps2 - y.eps1eps2).abs() < 1e-10, "{x:?} {y:?}");
        }
    }
}

/// The first of two events at one time has its own derivative, and so has the second.
#[test]
fn events_at_one_time_have_derivatives_of_their_own() {
    let [a, b, g] = variables([1.0, 1.0, 9.81]);
    let kernel = Two { m: Three::from_f64(2.0), g }.kernel().expect("two balls");
    let (bounce, other) = (Three::from_f64(-0.8), Three::from_f64(-0.5));
    let run = Simulation::new(&kernel)
        .event(Crossing::Falling, |_, q: &SVector<Three, 2>, _| q[0])
        .then(|state| state.z[0] *= bounce)
        .event(Crossing::Falling, |_, q: &SVector<Three, 2>, _| q[1])
        .then(|state| state.z[1] *= other)
        .adaptive(1e-10, 1e-10)
        .run(SVector::from([a, b]), SVector::from([Three::zero(); 2]), Three::zero()..Three::from_f64(0.6))
        .expect("bounce");
    let last = run.last();
    // Both bounce once by then, as each would alone.
    let until = |h: Three, e: f64| {
        let (times, _) = closed_form([h, Three::from_f64(e), g], 1);
        let (v, left) = (Three::from_f64(e) * (Three::from_f64(2.0) * h * g).sqrt(), Three::from_f64(0.6) - times[0]);
        (times[0], left * (v - g * left * Three::from_f64(0.5)))
    };
    let expected = [until(a, 0.8), until(b, 0.5)];
    for (n, event) in run.events().iter().enumerate() {
        for (x, y) in parts(event.sample.t).into_iter().zip(parts(expected[n].0)) {
            assert!((x - y).abs() < 1e-12, "{n}: {x} {y}");
        }
        for (x, y) in parts(last.q[n]).into_iter().zip(parts(expected[n].1)) {
            assert!((x - y).abs() < 1e-12, "{n}: {x} {y}");
        }
    }
}

#[test]
fn a_run_ends_at_a_time_with_derivatives() {
    // Half a period, π/√k, in either form of the equations.
    let k = DualNumber(Dual64::from_re(2.3).derivative());
    let kernel = Spring { k }.kernel().expect("a spring");
    let zero = || SVector::from([DualNumber(Dual64::from_re(0.0))]);
    let one = SVector::from([DualNumber(Dual64::from_re(1.0))]);
    let interval = DualNumber(Dual64::from_re(0.0))..DualNumber(Dual64::from_re(9.0));
    let until = Simulation::new(&kernel).until(Crossing::Falling, |_, q: &SVector<_, 1>, _| q[0]);
    let ends = [
        until.adaptive(1e-12, 1e-12).run_to_end(zero(), one, interval.clone()),
        until.momentum_form().adaptive(1e-12, 1e-12).run_to_end(zero(), one, interval),
    ];
    for end in ends {
        let end = end.expect("turns").sample;
        let expected = -0.5 * std::f64::consts::PI / (2.3 * 2.3_f64.sqrt());
        // Ten tolerances: steps are not differentiated with respect to their lengths, but stages are.
        assert!((end.t.eps - expected).abs() < 1e-11, "{} {expected}", end.t.eps);
        // On zero whatever k is, at −1.
        assert!(end.q[0].eps.abs() < 1e-14 && (end.z[0].eps).abs() < 1e-11, "{} {}", end.q[0].eps, end.z[0].eps);
    }
}

/// A function that passes at no rate has no derivative of its time: cubes, jumps, packs.
#[test]
fn what_has_no_derivative_is_refused() {
    type D = DualNumber<Dual64>;
    let kernel = Spring { k: DualNumber(Dual64::from_re(2.3).derivative()) }.kernel().expect("a spring");
    let number = |x: f64| D::from_f64(x);
    let run = |function: &dyn Fn(D) -> D| {
        let run = Simulation::new(&kernel).until(Crossing::Falling, |_, q: &SVector<D, 1>, _| function(q[0]));
        run.adaptive(1e-10, 1e-10).run(
            SVector::from([number(0.0)]),
            SVector::from([number(1.0)]),
            number(0.0)..number(9.0),
        )
    };
    for function in [&(|x: D| x * x * x) as &dyn Fn(D) -> D, &|x: D| number(if x.re > 0.0 { 1.0 } else { -1.0 })] {
        let error = run(function).expect_err("no derivative");
        assert!(matches!(error.kind, IntegrationErrorKind::NoDerivative { event: 0, .. }), "{error}");
    }
    // Near the turning point at 1/√k it still passes.
    let near = run(&|x: D| number(1.0 / 2.3_f64.sqrt() - 1e-9) - x).expect("passes");
    assert!(near.last().t.eps.is_finite() && near.last().t.eps.abs() > 1e3, "{:?}", near.last().t);
    type Pack = Lanes<D, 2>;
    let kernel = Spring { k: Pack::splat(number(2.3)) }.kernel().expect("a spring");
    let run = Simulation::new(&kernel).until(Crossing::Falling, |_, q: &SVector<Pack, 1>, _| q[0]);
    let pack = |x: f64| SVector::from([Pack::splat(number(x))]);
    let run = run.adaptive(1e-10, 1e-10).run(pack(0.0), pack(1.0), Pack::splat(number(0.0))..Pack::splat(number(9.0)));
    assert!(matches!(run.expect_err("a pack").kind, IntegrationErrorKind::NoDerivative { event: 0, .. }));
}

/// A jump of momenta by nothing that has a derivative is one.
#[test]
fn jumps_of_derivatives_alone_are_jumps() {
    let kick = DualNumber(Dual64::from_re(0.0).derivative());
    let number = |x: f64| DualNumber(Dual64::from_re(x));
    let kernel = Two { m: number(2.0), g: number(0.0) }.kernel().expect("two balls");
    let end = Simulation::new(&kernel)
        .event(Crossing::Rising, |t, _: &SVector<_, 2>, _| t - number(1.0))
        .then(|state| state.p[0] += kick)
        .adaptive(1e-10, 1e-10)
        .run_to_end(SVector::from([number(0.0); 2]), SVector::from([number(1.0); 2]), number(0.0)..number(3.0))
        .expect("runs")
        .sample;
    // 2 kg, for two seconds.
    assert!((end.q[0].eps - 1.0).abs() < 1e-14 && end.q[1].eps == 0.0, "{}", end.q[0].eps);
}

#[test]
fn constrained_runs_keep_derivatives_on_their_constraints() {
    fn swing<T: Real>([r, g, e]: [T; 3]) -> [T; 2] {
        let kernel = Ring { r, g }.kernel().expect("a ring");
        let end = Simulation::new(&kernel)
            .event(Crossing::Rising, |_, q: &SVector<T, 2>, _| q[0])
            .then(|state| state.z = state.z.map(|z| -e * z))
            .adaptive(1e-12, 1e-12)
            .run_to_end(SVector::from([-r, T::zero()]), SVector::from([T::zero(); 2]), T::zero()..T::from_f64(2.0));
        let end = end.expect("swings").sample;
        [end.q[0], end.q[1]]
    }
    let values = [0.5, 9.81, 0.7];
    let found = swing(variables(values));
    for k in 0..3 {
        let central = |step: f64| {
            let mut both = [values; 2];
            both[0][k] += step;
            both[1][k] -= step;
            let [after, before] = both.map(swing);
            [0, 1].map(|i| (after[i] - before[i]) / (2.0 * step))
        };
        let (fine, coarse) = (central(1e-4), central(2e-4));
        for i in 0..2 {
            let slope = (4.0 * fine[i] - coarse[i]) / 3.0;
            // Errors of runs, 1e-11, over the step; h⁴ of a fifth derivative up to 1e5.
            assert!((parts(found[i])[k + 1] - slope).abs() < 1e-6, "{i} {k}: {} {slope}", parts(found[i])[k + 1]);
        }
    }
    // x dx + y dy = r dr.
    let [x, y] = found.map(parts);
    for k in 1..4 {
        let left = x[0] * x[k] + y[0] * y[k] - if k == 1 { 0.5 } else { 0.0 };
        assert!(left.abs() < 1e-13, "{left:e}");
    }
}
