//! Orders on a log–log line, a published reference, control, refusals, and the front.

use nalgebra::{Quaternion, SMatrix, SVector, UnitQuaternion};
use std::string::ToString;
use std::vec::Vec;

use super::*;
use crate::chart::Chart;
use crate::configuration::{Configuration, VectorSpace};
use crate::lie::so3;
use crate::monitor::monitor;
use crate::simd::Lanes;
use crate::system::GaussSystem;
use crate::testing::FreeTop;

/// Hairer, Lubich & Wanner, *Geometric Numerical Integration*, fig. VII.5.3 without forces: I = (0.5, 0.85, 1),
/// body angular momentum (0.2, 1, 0.4), quaternion w + xi + yj + zk = (0.4, 0.2, 0.4, 0.8).
const TOP: FreeTop<f64> = FreeTop { inertia: [0.5, 0.85, 1.0] };

fn initial() -> (UnitQuaternion<f64>, SVector<f64, 3>) {
    let q = UnitQuaternion::new_unchecked(Quaternion::new(0.4, 0.2, 0.4, 0.8));
    (q, SVector::from([0.2 / 0.5, 1.0 / 0.85, 0.4]))
}

/// R and ω at T = 30, rounded to f64, from Taylor integrations of that problem with 256 and 300 bits that agree to 43
/// digits.
const FINAL_ROTATION: [[f64; 3]; 3] = [
    [0.005_029_178_059_065_505_6, -0.717_548_733_151_179_3, 0.696_490_145_602_353_7],
    [0.971_425_653_028_905_6, -0.161_769_207_622_294_08, -0.173_674_765_301_754_46],
    [0.237_290_766_793_431_3, 0.677_461_835_839_032_9, 0.696_231_680_531_841_8],
];
const FINAL_OMEGA: [f64; 3] = [0.474_561_909_977_237_6, 1.120_813_208_397_151, 0.485_877_735_788_319_9];

/// The largest error of an entry of R.
fn attitude_error(q: &UnitQuaternion<f64>) -> f64 {
    let found = q.to_rotation_matrix();
    let mut worst = 0.0_f64;
    for (i, row) in FINAL_ROTATION.iter().enumerate() {
        for (j, expected) in row.iter().enumerate() {
            worst = worst.max((found[(i, j)] - expected).abs());
        }
    }
    worst
}

fn quiet(_: f64, _: &UnitQuaternion<f64>, _: &SVector<f64, 3>) -> [f64; 3] {
    [0.0; 3]
}

/// The least-squares slope of log error against log step.
pub(in crate::integrate) fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let logs: Vec<_> = points.iter().map(|(h, e)| (h.ln(), e.ln())).collect();
    let (mx, my) = (logs.iter().map(|p| p.0).sum::<f64>() / n, logs.iter().map(|p| p.1).sum::<f64>() / n);
    logs.iter().map(|(x, y)| (x - mx) * (y - my)).sum::<f64>() / logs.iter().map(|(x, _)| (x - mx).powi(2)).sum::<f64>()
}

#[test]
fn published_free_body_to_the_published_errors() {
    let (q0, z0) = initial();
    // The table of measured errors says RKMK4 reaches 1e-5, 6e-7, 3.5e-8, 2e-9 at these steps; the method of Runge and
    // Kutta on a quaternion that is brought back to norm 1 reaches 9.1e-5, 5.7e-6, 3.6e-7, 2.2e-8.
    let expected = [(0.2, 1e-5, 9.1e-5), (0.1, 6e-7, 5.7e-6), (0.05, 3.5e-8, 3.6e-7), (0.025, 2e-9, 2.2e-8)];
    let (mut in_the_algebra, mut on_components) = (Vec::new(), Vec::new());
    let run = Simulation::new(&TOP).input(quiet);
    for (h, munthe_kaas, projected) in expected {
        let steps = Fixed::with(&Tableau::RK4, h);
        let found = attitude_error(&run.control(steps).run_to_end(q0, z0, 0.0..30.0).expect("runs").q);
        assert!(found < 1.5 * munthe_kaas, "h = {h}: {found:e}");
        in_the_algebra.push((h, found));
        let end = run.momentum_form().control(steps).run_to_end(q0, z0, 0.0..30.0).expect("runs");
        assert!(attitude_error(&end.q) < 1.5 * munthe_kaas, "momentum form, h = {h}");

        let steps = Fixed::by(RungeKutta(Classical4), h);
        let found = attitude_error(&run.control(steps).run_to_end(q0, z0, 0.0..30.0).expect("runs").q);
        assert!((found / projected - 1.0).abs() < 0.05, "h = {h}: {found:e}");
        on_components.push((h, found));
    }
    for points in [in_the_algebra, on_components] {
        let order = slope(&points);
        assert!((order - 4.0).abs() < 0.2, "order {order}: {points:?}");
    }
}

/// Steps of one length by any tableau, without control, to t = 4.
fn fixed_steps<S, const N: usize>(
    tableau: &Tableau<N>,
    problem: &impl Problem<System = S>,
    start: State<S>,
    steps: u32,
) -> State<S>
where
    S: GaussSystem<Scalar = f64>,
{
    let method = Rkmk::new(tableau);
    let mut state = start;
    for _ in 0..steps {
        let rates = problem.rates(&state);
        state = method.step(problem, &state, &rates, 4.0 / f64::from(steps)).expect("steps").state;
    }
    state
}

/// The fitted order of a tableau, against a solution with 32 times as many steps as the finest of the fit.
fn fitted_order<S, const N: usize>(tableau: &Tableau<N>, problem: &impl Problem<System = S>, start: State<S>) -> f64
where
    S: GaussSystem<Scalar = f64>,
{
    let exact = fixed_steps(&Tableau::DORMAND_PRINCE_5, problem, start, 32 * 160);
    let points: Vec<_> = [40, 80, 160]
        .into_iter()
        .map(|steps| {
            let end = fixed_steps(tableau, problem, start, steps);
            let attitude = end.q.difference(&exact.q).max_norm();
            (4.0 / f64::from(steps), attitude.max(end.y.add_scaled(-1.0, &exact.y).max_norm()))
        })
        .collect();
    slope(&points)
}

#[test]
fn orders_on_the_rotation_group_and_on_a_linear_space() {
    // A torque that depends on everything, so that every order condition is needed.
    let torque = |t: f64, q: &UnitQuaternion<f64>, z: &SVector<f64, 3>| {
        let up = q.inverse() * SVector::from([0.0, 0.0, 1.0]);
        [0.8 * up[1] + 0.3 * t.sin(), -0.7 * up[0], 0.2 * z[0] * z[0]]
    };
    let (q, y) = initial();
    let start = State { t: 0.0, q, y };
    let problem = SystemProblem { system: &TOP, form: VelocityForm, input: Feedback(torque) };
    let momenta = SystemProblem { system: &TOP, form: MomentumForm, input: Feedback(torque) };
    let flat = SystemProblem { system: &Pendulum, form: VelocityForm, input: NoInput };
    let swing = State { t: 0.0, q: SVector::from([1.0]), y: SVector::from([0.3]) };
    for (name, order, found) in [
        ("SO(3), velocities", 4.0, fitted_order(&Tableau::RK4, &problem, start)),
        ("SO(3), momenta", 4.0, fitted_order(&Tableau::RK4, &momenta, State { y: TOP.momentum(0.0, &q, &y), ..start })),
        ("R", 4.0, fitted_order(&Tableau::RK4, &flat, swing)),
        ("SO(3)", 5.0, fitted_order(&Tableau::DORMAND_PRINCE_5, &problem, start)),
        ("R", 5.0, fitted_order(&Tableau::DORMAND_PRINCE_5, &flat, swing)),
    ] {
        assert!((found - order).abs() < 0.25, "{name}: order {found} instead of {order}");
    }
}

#[test]
fn first_same_as_last_holds_on_the_group() {
    let method = Rkmk::new(&Tableau::DORMAND_PRINCE_5);
    let problem = SystemProblem { system: &TOP, form: VelocityForm, input: Feedback(quiet) };
    let (q, y) = initial();
    let start = State { t: 0.0, q, y };
    let step = method.step(&problem, &start, &problem.rates(&start), 0.2).expect("steps");
    let (given, computed) = (step.rates.expect("comes with the step"), problem.rates(&step.state));
    assert!((given.configuration - computed.configuration).amax() < 1e-15);
    assert!((given.variables - computed.variables).amax() < 1e-15);
    assert!(step.error.configuration.amax() > 0.0);
}

/// A pendulum in coordinates: q̇ = z, ż = −sin q − t/10; configuration ℝ¹.
struct Pendulum;

impl GaussSystem for Pendulum {
    type Scalar = f64;
    type Configuration = SVector<f64, 1>;
    type Speeds = SVector<f64, 1>;
    type MassMatrix = SMatrix<f64, 1, 1>;
    type Input = ();
    const DOF: usize = 1;
    const CHART: Chart = Chart::Own;

    fn kinematics(&self, _: f64, _: &SVector<f64, 1>, z: &SVector<f64, 1>) -> SVector<f64, 1> {
        *z
    }
    fn acceleration(&self, t: f64, q: &SVector<f64, 1>, _: &SVector<f64, 1>, (): &()) -> SVector<f64, 1> {
        SVector::from([-q[0].sin() - 0.1 * t])
    }
    fn momentum(&self, _: f64, _: &SVector<f64, 1>, z: &SVector<f64, 1>) -> SVector<f64, 1> {
        *z
    }
    fn velocity(&self, _: f64, _: &SVector<f64, 1>, p: &SVector<f64, 1>) -> SVector<f64, 1> {
        *p
    }
    fn momentum_rate(&self, t: f64, q: &SVector<f64, 1>, p: &SVector<f64, 1>, (): &()) -> SVector<f64, 1> {
        self.acceleration(t, q, p, &())
    }
    fn mass_matrix(&self, _: f64, _: &SVector<f64, 1>) -> SMatrix<f64, 1, 1> {
        SMatrix::identity()
    }
    fn kinetic_energy(&self, _: f64, _: &SVector<f64, 1>, z: &SVector<f64, 1>) -> f64 {
        0.5 * z[0] * z[0]
    }
    fn potential_energy(&self, _: f64, q: &SVector<f64, 1>) -> f64 {
        1.0 - q[0].cos()
    }
    fn gauss_residual(
        &self,
        t: f64,
        q: &SVector<f64, 1>,
        z: &SVector<f64, 1>,
        acceleration: &SVector<f64, 1>,
        (): &(),
    ) -> SVector<f64, 1> {
        acceleration - self.acceleration(t, q, z, &())
    }
    fn constraint_function(
        &self,
        t: f64,
        q: &SVector<f64, 1>,
        z: &SVector<f64, 1>,
        acceleration: &SVector<f64, 1>,
        (): &(),
    ) -> f64 {
        0.5 * (acceleration - self.acceleration(t, q, z, &())).norm_squared()
    }
}

#[test]
fn on_a_linear_space_it_is_plain_runge_kutta_to_the_last_bit() {
    let h = 0.125;
    let f = |t: f64, x: [f64; 2]| [x[1], -x[0].sin() - 0.1 * t];
    let (mut t, mut x) = (0.0, [1.0, 0.3]);
    for _ in 0..80 {
        let shifted = |a: f64, k: [f64; 2]| [x[0] + (h * a) * k[0], x[1] + (h * a) * k[1]];
        let k1 = f(t, x);
        let k2 = f(t + 0.5 * h, shifted(0.5, k1));
        let k3 = f(t + 0.5 * h, shifted(0.5, k2));
        let k4 = f(t + h, shifted(1.0, k3));
        let (sixth, third) = (h * (1.0 / 6.0), h * (1.0 / 3.0));
        x = core::array::from_fn(|i| x[i] + (((sixth * k1[i] + third * k2[i]) + third * k3[i]) + sixth * k4[i]));
        t += h;
    }
    let run = Simulation::new(&Pendulum);
    let (q, z) = (SVector::from([1.0]), SVector::from([0.3]));
    let end = run.control(Fixed::with(&Tableau::RK4, h)).run_to_end(q, z, 0.0..10.0).expect("runs");
    // The same in another order of sums: 80 steps of a few roundings each, which the motion carries on hardly larger.
    let other = run.control(Fixed::by(RungeKutta(Classical4), h)).run_to_end(q, z, 0.0..10.0).expect("runs");
    assert!((other.q - end.q).amax().max((other.z - end.z).amax()) < 80.0 * 4.0 * f64::EPSILON);
    if cfg!(any(target_feature = "fma", target_arch = "aarch64")) {
        assert!((end.q[0] - x[0]).abs() < 1e-14 && (end.z[0] - x[1]).abs() < 1e-14);
    } else {
        assert_eq!([end.q[0], end.z[0]], x);
    }
    assert_eq!(end.t, 10.0);
}

#[test]
fn adaptive_steps_keep_the_tolerance_and_save_work() {
    let (q0, z0) = initial();
    let run = Simulation::new(&TOP).input(quiet);
    let order = |outcome: &dyn Fn(f64) -> Result<Trajectory<'static, FreeTop<f64>>, IntegrationError>| {
        let points: Vec<_> = [8, 9, 10, 11, 12]
            .into_iter()
            .map(|exponent| {
                let tolerance = 10.0_f64.powi(-exponent);
                let trajectory = outcome(tolerance).expect("runs");
                let last = trajectory.last();
                let error = attitude_error(&last.q).max((last.z - SVector::from(FINAL_OMEGA)).amax());
                assert!(error < 60.0 * tolerance, "{tolerance:e}: {error:e} in {} steps", trajectory.len());
                assert_eq!(last.t, 30.0);
                (trajectory.len() as f64, error)
            })
            .collect();
        // Of the error against the number of steps.
        -slope(&points)
    };
    for found in [
        order(&|tolerance| {
            let pair = Adaptive::with(&Tableau::DORMAND_PRINCE_5, tolerance, tolerance);
            run.control(pair).run(q0, z0, 0.0..30.0)
        }),
        order(&|tolerance| {
            let pair = Adaptive::by(RungeKutta(DormandPrince5), tolerance, tolerance);
            run.control(pair).run(q0, z0, 0.0..30.0)
        }),
    ] {
        assert!((found - 5.0).abs() < 0.5, "{found}");
    }
    // Over few steps, whose lengths settle during the first of them.
    let found = order(&|tolerance| run.adaptive(tolerance, tolerance).run(q0, z0, 0.0..30.0));
    assert!((found - 8.0).abs() < 1.0, "{found}");
}

#[test]
fn time_runs_backwards_as_well() {
    let (q0, z0) = initial();
    let there = Simulation::new(&TOP).input(quiet).adaptive(1e-11, 1e-12);
    let end = there.run_to_end(q0, z0, 0.0..5.0).expect("runs");
    let back = there.run_to_end(end.q, end.z, 5.0..0.0).expect("runs");
    assert!(back.q.difference(&q0).norm() < 1e-9 && (back.z - z0).amax() < 1e-9);
    let back = Simulation::new(&TOP).input(quiet).fixed_step(0.01).run(end.q, end.z, 5.0..0.0).expect("runs");
    assert!(back.last().q.difference(&q0).norm() < 1e-7);
    let middle = back.at(2.505).expect("inside");
    let reference = there.run_to_end(q0, z0, 0.0..2.505).expect("runs");
    assert!(middle.q.difference(&reference.q).norm() < 1e-7);
}

#[test]
fn a_trajectory_answers_at_its_ends_and_not_beyond() {
    let (q0, z0) = initial();
    let trajectory = Simulation::new(&TOP).input(quiet).fixed_step(0.3).run(q0, z0, 1.0..2.0).expect("runs");
    // Three whole steps and a remainder.
    let times: Vec<_> = trajectory.iter().map(|sample| sample.t).collect();
    assert_eq!(times.len(), 5);
    assert!((times[3] - 1.9).abs() < 1e-15 && times[4] == 2.0);
    assert_eq!(trajectory.at(1.0).expect("inside").q, trajectory.first().q);
    assert_eq!(trajectory.at(2.0).expect("inside").q, trajectory.last().q);
    assert!(trajectory.at(2.1).is_err() && trajectory.at(0.9).is_err() && trajectory.at(f64::NAN).is_err());
    assert_eq!(trajectory.into_iter().count(), 5);
    assert_eq!(trajectory.get(4).map(|sample| sample.t), Some(2.0));
    // An empty interval is one sample.
    let nothing = Simulation::new(&TOP).input(quiet).fixed_step(0.3).run(q0, z0, 1.0..1.0).expect("runs");
    assert_eq!(nothing.len(), 1);
    // Samples carry consistent velocities and momenta.
    for sample in &trajectory {
        assert!((TOP.momentum(sample.t, &sample.q, &sample.z) - sample.p).amax() < 1e-16);
    }
}

#[test]
fn what_is_not_finite_is_an_error() {
    let (q0, z0) = initial();
    let run = Simulation::new(&TOP).input(quiet);
    let bad = SVector::from([0.0, f64::NAN, 0.0]);
    let error = run.fixed_step(0.1).run(q0, bad, 0.0..1.0).expect_err("refused");
    assert_eq!(error.kind, IntegrationErrorKind::NonFinite { part: RunPart::InitialState });
    let error = run.adaptive(1e-6, 1e-6).run(q0, bad, 0.0..1.0).expect_err("refused");
    assert_eq!(error.kind, IntegrationErrorKind::NonFinite { part: RunPart::InitialState });
    let error = run.fixed_step(0.1).run(q0, z0, 0.0..f64::INFINITY).expect_err("refused");
    assert_eq!(error.kind, IntegrationErrorKind::InvalidInterval);

    // An input that breaks at t = 1: the good part is kept, and its last state is finite.
    let broken =
        |t: f64, _: &UnitQuaternion<f64>, _: &SVector<f64, 3>| [if t > 1.0 { f64::NAN } else { 0.0 }, 0.0, 0.0];
    let failing = Simulation::new(&TOP).input(broken);
    let (trajectory, error) = failing.fixed_step(0.1).attempt(q0, z0, 0.0..3.0);
    let error = error.expect("stops");
    assert_eq!(error.kind, IntegrationErrorKind::NonFinite { part: RunPart::Step });
    assert!((error.time - 1.0).abs() < 0.11 && error.time == trajectory.last().t, "{error}");
    assert!(Configuration::is_finite(&trajectory.last().q) && VectorSpace::is_finite(&trajectory.last().z));
    // When, why, and where.
    let last = trajectory.last();
    assert_eq!(error.state(), std::format!("q = {:?}, z = {:?}", last.q, last.z));
    let text = error.to_string();
    assert!(text.starts_with("integration stopped at t = ") && text.ends_with(error.state()), "{text}");
    let (trajectory, error) = failing.adaptive(1e-6, 1e-6).attempt(q0, z0, 0.0..3.0);
    let error = error.expect("stops");
    assert!(matches!(error.kind, IntegrationErrorKind::NonFinite { .. }), "{error}");
    assert!((error.time - 1.0).abs() < 1e-3 && error.time == trajectory.last().t, "{error}");
    // The state handed over is kept when nothing can be integrated.
    let always = |_: f64, _: &UnitQuaternion<f64>, _: &SVector<f64, 3>| [f64::INFINITY; 3];
    let (trajectory, error) = Simulation::new(&TOP).input(always).fixed_step(0.1).attempt(q0, z0, 0.0..1.0);
    assert_eq!(error.expect("stops").kind, IntegrationErrorKind::NonFinite { part: RunPart::Derivative });
    assert_eq!(trajectory.last().z, z0);
}

#[test]
fn settings_are_checked_and_limits_kept() {
    let (q0, z0) = initial();
    let run = Simulation::new(&TOP).input(quiet);
    for step in [0.0, f64::NAN, f64::INFINITY] {
        let error = run.fixed_step(step).run(q0, z0, 0.0..1.0).expect_err("refused");
        assert!(matches!(error.kind, IntegrationErrorKind::InvalidStep { .. }));
    }
    for (relative, absolute) in [(0.0, 0.0), (-1e-6, 1e-3), (f64::NAN, 1e-3), (1e-6, f64::INFINITY)] {
        let error = run.adaptive(relative, absolute).run(q0, z0, 0.0..1.0).expect_err("refused");
        assert!(matches!(error.kind, IntegrationErrorKind::InvalidTolerance { .. }));
    }
    let error = run.fixed_step(0.1).max_steps(9).run(q0, z0, 0.0..1.0).expect_err("refused");
    assert_eq!(error.kind, IntegrationErrorKind::TooManySteps { limit: 9 });
    assert!(run.fixed_step(0.1).max_steps(10).run(q0, z0, 0.0..1.0).is_ok());
    let error = run.adaptive(1e-10, 0.0).max_steps(5).run(q0, z0, 0.0..10.0).expect_err("refused");
    assert_eq!(error.kind, IntegrationErrorKind::TooManySteps { limit: 5 });
    assert!(error.time > 0.0);
    // A tolerance below rounding is met as far as rounding lets it, and that is told.
    let below = run.adaptive(1e-40, 0.0).run(q0, z0, 1e3..1e3 + 1.0).expect("runs");
    assert!(below.summary().excess > 1e20 && below.summary().rounded > 0 && below.len() < 100, "{}", below.summary());
    let longest = run.adaptive(1e-3, 1e-3).largest_step(0.25).first_step(0.01).run(q0, z0, 0.0..5.0).expect("runs");
    let times: Vec<_> = longest.iter().map(|sample| sample.t).collect();
    assert!((times[1] - 0.01).abs() < 1e-15 && times.windows(2).all(|w| w[1] - w[0] < 0.2526));
}

#[test]
fn more_than_half_a_turn_a_step_is_refused_or_subdivided() {
    let (q0, _) = initial();
    let fast = SVector::from([0.0, 0.0, 40.0]);
    let run = Simulation::new(&TOP).input(quiet);
    let error = run.fixed_step(0.1).run(q0, fast, 0.0..1.0).expect_err("refused");
    match error.kind {
        IntegrationErrorKind::IncrementTooLarge { angle } => assert!((angle - 4.0).abs() < 1e-12),
        other => panic!("{other:?}"),
    }
    // Uniform rotation has no error for the control to see: only the limit of the angle holds it.
    let end = run.adaptive(1e-6, 1e-6).run_to_end(q0, fast, 0.0..1.0).expect("runs");
    let exact = so3::exp(&SVector::from([0.0, 0.0, 40.0]));
    assert!(end.q.difference(&(q0 * exact)).norm() < 1e-6);
}

#[test]
fn observers_see_what_trajectories_keep() {
    let (q0, z0) = initial();
    let mut times = Vec::new();
    let run = Simulation::new(&TOP).input(quiet).fixed_step(0.25).every(3);
    let trajectory = run.observe(|sample| times.push(sample.t)).run(q0, z0, 0.0..2.5).expect("runs");
    assert_eq!(times, [0.0, 0.75, 1.5, 2.25, 2.5]);
    assert_eq!(trajectory.len(), 5);
    let watched = monitor(&TOP, &trajectory);
    assert!((watched.energy.initial()[0] - 0.708_235_294_117_647).abs() < 1e-15);
    assert!(watched.energy.relative().expect("not zero") < 1e-4);
}

#[test]
fn single_precision_and_packs_run_too() {
    let (q0, z0) = initial();
    let exact = Simulation::new(&TOP).input(quiet).fixed_step(0.05).run_to_end(q0, z0, 0.0..3.0).expect("runs");

    let single = FreeTop { inertia: [0.5_f32, 0.85, 1.0] };
    let end = Simulation::new(&single)
        .input(|_, _: &UnitQuaternion<f32>, _: &SVector<f32, 3>| [0.0; 3])
        .fixed_step(0.05)
        .run_to_end(q0.cast(), z0.cast(), 0.0..3.0)
        .expect("runs");
    assert!((end.z.cast::<f64>() - exact.z).amax() < 2e-5);
    let adaptive = Simulation::new(&single)
        .input(|_, _: &UnitQuaternion<f32>, _: &SVector<f32, 3>| [0.0; 3])
        .adaptive(1e-5, 1e-5)
        .run_to_end(q0.cast(), z0.cast(), 0.0..3.0)
        .expect("runs");
    assert!((adaptive.z.cast::<f64>() - exact.z).amax() < 1e-4);

    let both = |x: f64| Lanes([x, x]);
    let pack = FreeTop { inertia: [Lanes([0.5, 0.6]), both(0.85), both(1.0)] };
    let attitude = crate::triple::unit_quaternion(crate::triple::quaternion(&q0).map(both));
    let end = Simulation::new(&pack)
        .input(|_, _: &_, _: &_| [both(0.0); 3])
        .fixed_step(both(0.05))
        .run_to_end(attitude, SVector::from(z0.data.0[0].map(both)), both(0.0)..both(3.0))
        .expect("runs");
    for i in 0..3 {
        assert!((end.z[i].0[0] - exact.z[i]).abs() < 1e-15);
    }
    let other = FreeTop { inertia: [0.6, 0.85, 1.0] };
    let exact = Simulation::new(&other).input(quiet).fixed_step(0.05).run_to_end(q0, z0, 0.0..3.0).expect("runs");
    for i in 0..3 {
        assert!((end.z[i].0[1] - exact.z[i]).abs() < 1e-15);
    }
}

#[test]
fn forms_agree_and_momentum_turns_with_the_body() {
    let (q0, z0) = initial();
    let torque = |t: f64, _: &UnitQuaternion<f64>, z: &SVector<f64, 3>| [0.1 * t.sin(), -0.05 * z[1], 0.02];
    let run = Simulation::new(&TOP).input(torque).adaptive(1e-11, 1e-12);
    let a = run.run_to_end(q0, z0, 0.0..8.0).expect("runs");
    let b = run.momentum_form().run_to_end(q0, z0, 0.0..8.0).expect("runs");
    assert!(a.q.difference(&b.q).norm() < 1e-9 && (a.z - b.z).amax() < 1e-9 && (a.p - b.p).amax() < 1e-9);
    // Without torque R p is constant.
    let end = Simulation::new(&TOP).input(quiet).adaptive(1e-12, 1e-13).run_to_end(q0, z0, 0.0..8.0).expect("runs");
    let p0 = TOP.momentum(0.0, &q0, &z0);
    assert!((q0 * p0 - end.q * end.p).amax() < 1e-10);
}
