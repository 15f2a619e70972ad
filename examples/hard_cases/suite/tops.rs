//! Bodies that turn about a fixed point: flips, gimbal lock, sleep, speed, chaos.

use std::error::Error;
use std::f64::consts::PI;

use gauss_runtime::chart::convert;
use gauss_runtime::integrate::{Control, Fixed, Form};
use gauss_runtime::prelude::*;

use super::measure::worse;
use super::methods::{end, gauss_6, order_8, order_9, series, splitting, tight};
use super::scenes::{FreeTop, FreeTopKernel, HeavyTop, Scene, State, TopByPrecession, TopByYaw};
use super::truth::{Body, MassData};
use super::{Effort, Measure, naive};

type Measures = Result<Vec<Measure>, Box<dyn Error>>;

/// Twenty turns a second.
const FAST: &str = "bruls_heavy_top";

pub fn large_step(_: Effort) -> Measures {
    let scene = Scene::top(FAST)?;
    let kernel = scene.heavy_top().kernel()?;
    let (start, data) = (scene.initial, MassData::from(&scene));
    // 3.3, 2π and 7.5 rad in a step.
    let steps = [0.022, 2.0 * PI / 150.0, 0.05];
    let taken = steps.iter().filter(|&&h| end(&kernel, VelocityForm, Fixed::new(h), &start, 1.0).is_ok()).count();
    let silent = Measure::new("fixed steps of 3.3, 6.3, 7.5 rad taken", "refused: a typed error", taken as f64, 0.0)
        .naive("RK4 on a quaternion takes them all", steps.len() as f64);

    let tolerance = 1e-8;
    let control = Adaptive::new(tolerance, tolerance);
    let (q, z) = (start.pose().rotation, start.omega);
    let run = Simulation::new(&kernel).control(control).first_step(0.05);
    let mut count = 0.0;
    let last = run.observe(|_| count += 1.0).run_to_end(q, z, 0.0..scene.duration)?;
    let error = State::of(&kernel, &last.q, &last.z).distance(&scene.last);
    // Velocities of 150 rad/s are kept to the tolerance relative to their size; as angles errors sum over the run.
    let target = tolerance * 150.0 * scene.duration;
    let naive = naive::run_top(&data, &start, scene.duration, 0.05).distance(&scene.last);
    let split = end(&kernel, MomentumForm, splitting!(&kernel, 0.05), &start, scene.duration)?.0.distance(&scene.last);
    Ok(vec![
        silent,
        Measure::new("steps of 7.5 rad: error after 48 turns", "splitting 4, exact flow, h = 0.05", split, 1e-5)
            .because("3e-10 at h = 0.004, order 4")
            .naive("RK4 on a quaternion, h = 0.05 s", naive),
        Measure::new("asked for 7.5 rad: error after 48 turns", "adaptive 5(4), 1e-8: subdivided", error, target)
            .because("tolerance × angle turned")
            .naive("RK4 on a quaternion, h = 0.05 s", naive)
            .note(format!("{count} steps")),
    ])
}

/// Largest relative change of T and |L| over a run, and its end.
fn drift<F, C>(kernel: &FreeTopKernel, form: F, control: C, scene: &Scene) -> Result<(f64, State), IntegrationError>
where
    F: Form<FreeTopKernel>,
    C: Control<FreeTopKernel>,
{
    let (q, z) = (scene.initial.pose().rotation, scene.initial.omega);
    let (mut first, mut largest) = (None, 0.0);
    let see = |s: &Sample<FreeTopKernel>| {
        let (energy, momentum) = (kernel.kinetic_energy(s.t, &s.q, &s.z), s.p.norm());
        let (e, m) = *first.get_or_insert((energy, momentum));
        largest = worse(largest, worse((energy / e - 1.0).abs(), (momentum / m - 1.0).abs()));
    };
    let run = Simulation::new(kernel).form(form).control(control).observe(see);
    let last = run.run_to_end(q, z, 0.0..scene.duration)?;
    Ok((largest, State::of(kernel, &last.q, &last.z)))
}

pub fn separatrix(_: Effort) -> Measures {
    let scene = Scene::top("free_near_separatrix")?;
    let kernel = scene.free_top().kernel()?;
    let typed = naive::run_top(&MassData::from(&scene), &scene.initial, scene.duration, 0.05);
    let error = typed.distance(&scene.last);
    let twice = |s: &State| s.omega.dot(&(scene.inertia * s.omega));
    let lost = (twice(&typed) / twice(&scene.initial) - 1.0).abs();
    let runs = [
        ("order 8, velocities", drift(&kernel, VelocityForm, tight(), &scene)?),
        ("order 8, momenta", drift(&kernel, MomentumForm, tight(), &scene)?),
        ("power series", drift(&kernel, VelocityForm, series(), &scene)?),
        ("Gauss 6, momenta, h = 0.01", drift(&kernel, MomentumForm, gauss_6(0.01), &scene)?),
        ("exact free flow, one step", drift(&kernel, MomentumForm, splitting!(&kernel, scene.duration), &scene)?),
    ];
    let ends = runs.iter().map(|(method, (_, last))| {
        Measure::new("60 s: worst error of R and ω", *method, last.distance(&scene.last), 10.0 * scene.floor)
            .because("ten times what one rounding of the start does")
            .naive("RK4 on a quaternion, h = 0.05", error)
            .note("what is rounded at the flip grows as e^(0.58 t) after it")
    });
    let drifts = runs.iter().map(|(method, (largest, _))| {
        Measure::new("T and |L|: largest relative change", *method, *largest, 1e-13).naive("RK4, h = 0.05: of T", lost)
    });
    Ok(ends.chain(drifts).collect())
}

/// Quarter period of Jacobi's functions from the complementary modulus, by the arithmetic–geometric mean.
fn quarter_period(complementary: f64) -> f64 {
    let (mut a, mut b) = (1.0, complementary);
    while (a - b).abs() > 4.0 * f64::EPSILON * a {
        (a, b) = (0.5 * (a + b), f64::sqrt(a * b));
    }
    PI / (a + b)
}

/// Sign changes of a number that is seen over time, and when the last one was.
#[derive(Default)]
struct Flips {
    last: Option<f64>,
    count: u32,
    time: f64,
}

impl Flips {
    /// The value with its derivative: at a flip the second derivative vanishes too, so the tangent hits zero to
    /// third order.
    fn see(&mut self, t: f64, value: f64, rate: f64) {
        if self.last.is_some_and(|before| (before < 0.0) != (value < 0.0)) {
            self.count += 1;
            self.time = t - value / rate;
        }
        self.last = Some(value);
    }
}

pub fn flips(effort: Effort) -> Measures {
    let duration = if effort == Effort::Quick { 300.0 } else { 3000.0 };
    // About the intermediate axis, δ beside it: ω₂ = sn(Ωt + K), which changes its sign at K/Ω, 3K/Ω, …
    let delta = 1e-6_f64;
    let inertia = Vector3::new(1.0, 2.0, 3.0);
    let rate = ((2.0 + 6.0 * delta * delta) / 6.0).sqrt();
    let quarter = quarter_period((6.0 * delta * delta / (2.0 + 6.0 * delta * delta)).sqrt()) / rate;
    let exact = (0.5 * (duration / quarter + 1.0)).floor();
    let exact_time = (2.0 * exact - 1.0) * quarter;

    let kernel = FreeTop { mass: 1.0, inertia }.kernel()?;
    let (q, z) = (UnitQuaternion::identity(), Vector3::new(0.0, 1.0, delta));
    let mut ours = Flips::default();
    let see = |s: &Sample<FreeTopKernel>| ours.see(s.t, s.z.y, kernel.acceleration(s.t, &s.q, &s.z, &()).y);
    Simulation::new(&kernel).control(order_8(0.05)).observe(see).run_to_end(q, z, 0.0..duration)?;

    let momentum = Vector3::new(0.0, 2.0, 3.0 * delta);
    let mut typed = Flips::default();
    let (h, mut t) = (0.1, 0.0);
    let rate_of = |q: &SVector<f64, 4>| naive::top_from_space(&inertia, q, &momentum).0;
    naive::runge_kutta(rate_of, SVector::from([0.0, 0.0, 0.0, 1.0]), h, (duration / h) as u64, |q| {
        t += h;
        let omega = naive::top_from_space(&inertia, q, &momentum).1;
        typed.see(t, omega.y, omega.z * omega.x);
    });

    let floor = 4.0 * exact * f64::EPSILON / (delta * delta * rate);
    let count = |flips: &Flips| (f64::from(flips.count) - exact).abs();
    Ok(vec![
        Measure::new(format!("flips in {duration} s, off by"), "order 8, h = 0.05", count(&ours), 0.0)
            .naive("RK4 on a quaternion, L kept, h = 0.1", count(&typed))
            .note(format!("{exact} flips by Jacobi's sn")),
        Measure::new("last flip, s", "order 8, h = 0.05", (ours.time - exact_time).abs(), floor)
            .because("each flip's roundings, relative to δ²")
            .naive("RK4 on a quaternion, L kept, h = 0.1", (typed.time - exact_time).abs()),
    ])
}

pub fn gimbal_lock(effort: Effort) -> Measures {
    let scene = Scene::top("gimbal_crossing_top")?;
    let HeavyTop { mass, center, inertia, gravity } = scene.heavy_top();
    let kernel = scene.heavy_top().kernel()?;
    let (start, last, duration) = (scene.initial, scene.last, scene.duration);
    let by_yaw = TopByYaw { mass, center, inertia, gravity }.kernel()?;

    // A little more spin, and the axis passes the upright 4e-7 rad beside it: the angles turn by π in 1e-7 s.
    let near = State { omega: start.omega + Vector3::z() * 1e-5, ..start };
    let truth = Body::held(&MassData::from(&scene)).after(duration, &near.pose(), &near.twist());
    let r = near.rotation;
    let angles = [r[(0, 2)].atan2(-r[(1, 2)]), r[(2, 2)].acos(), r[(2, 0)].atan2(r[(2, 1)])];
    let w = near.omega;
    let y = SVector::from([angles[0], angles[1], angles[2], w.x, w.y, w.z]);
    let h = if effort == Effort::Quick { 1e-3 } else { 1e-4 };
    let steps = (duration / h).round() as u64;
    let y = naive::runge_kutta(naive::top_by_angles(&MassData::from(&scene)), y, h, steps, |_| ());
    let error = (naive::matrix_of_angles(y[0], y[1], y[2]) - truth.rotation).amax();
    let words = format!("Euler angles by hand, RK4, h = {h:e}");

    let through = "6 s through the upright: worst error";
    let beside = "6 s, 4e-7 rad beside it: worst error";
    let mut measures: Vec<Measure> = [
        ("rotations, order 8", end(&kernel, VelocityForm, tight(), &start, duration)?.0),
        ("rotations, order 8, momenta", end(&kernel, MomentumForm, tight(), &start, duration)?.0),
        ("yaw, pitch, roll: regular here", end(&by_yaw, VelocityForm, tight(), &start, duration)?.0),
    ]
    .into_iter()
    .map(|(method, found)| Measure::new(through, method, found.distance(&last), 1e-11))
    .collect();
    for (method, found) in [
        ("rotations, order 8", end(&kernel, VelocityForm, tight(), &near, duration)?.0),
        ("rotations, order 8, momenta", end(&kernel, MomentumForm, tight(), &near, duration)?.0),
    ] {
        measures.push(Measure::new(beside, method, found.distance(&truth), 1e-11).naive(&*words, error));
    }

    // The angles that are singular there: refused; or left in time for rotations.
    let by_precession = TopByPrecession { mass, center, inertia, gravity }.kernel()?;
    let q = by_precession.configuration(&start.pose())?;
    let z = by_precession.speeds(0.0, &q, &start.twist());
    let run = Simulation::new(&by_precession).control(tight()).max_steps(20_000);
    let (path, stopped) = run.attempt(q, z, 0.0..duration);
    let silent = f64::from(u8::from(stopped.is_none()));
    let note = stopped.map(|error| format!("stopped at t = {:.4}", error.time)).unwrap_or_default();
    measures.push(
        Measure::new("precession angles: 0/0 in silence", "refused: a typed error", silent, 0.0)
            .naive("RK4 goes on", 1.0)
            .note(note),
    );
    let regular = |s: &&Sample<_>| by_precession.regularity(s.t, &s.q).abs() < 0.2;
    let sample = path.iter().find(regular).ok_or("the top never comes near the upright")?;
    let (q, z) = convert(&by_precession, &sample.q, &sample.z, &kernel)?;
    let end = Simulation::new(&kernel).control(tight()).run_to_end(q, z, sample.t..duration)?;
    let found = State::of(&kernel, &end.q, &end.z).distance(&last);
    let method = format!("precession angles, then rotations from t = {:.2}", sample.t);
    measures.insert(3, Measure::new(through, method, found, 1e-11));
    Ok(measures)
}

pub fn sleeping_top(effort: Effort) -> Measures {
    let top = HeavyTop {
        mass: 1.0,
        center: Vector3::z() * 0.4,
        inertia: Matrix3::from_diagonal(&Vector3::new(0.2, 0.2, 0.05)),
        gravity: 9.81,
    };
    let kernel = top.kernel()?;
    let (couple, tilt) = (top.mass * top.gravity * top.center.z, 1e-3_f64);
    let data = super::truth::MassData {
        mass: top.mass,
        center: top.center,
        inertia: top.inertia,
        added: Matrix6::zeros(),
        gravity: top.gravity,
    };
    let duration = if effort == Effort::Quick { 12.0 } else { 60.0 };
    let rotation = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), tilt);
    let mut measures = Vec::new();
    for ratio in [0.98_f64, 1.02] {
        // (I₃n)² = ratio · 4 I₁ m g ℓ. Let go without nutation at the angle θ₀, it sinks to 1 − cos θ = v.
        let spin = (ratio * 4.0 * top.inertia[(0, 0)] * couple).sqrt() / top.inertia[(2, 2)];
        let v0 = 2.0 * (0.5 * tilt).sin().powi(2);
        let v = (1.0 - ratio) + ((1.0 - ratio).powi(2) + 2.0 * ratio * v0).sqrt();
        let truth = 2.0 * (0.5 * v).sqrt().asin();

        let omega = Vector3::z() * spin;
        let mut largest = 0.0_f64;
        let tilt_of = |x: f64, y: f64| 2.0 * x.hypot(y).min(1.0).asin();
        let see = |s: &Sample<_>| {
            let q: &UnitQuaternion<f64> = &s.q;
            largest = worse(largest, tilt_of(q.coords[0], q.coords[1]));
        };
        Simulation::new(&kernel).control(order_8(0.01)).observe(see).run_to_end(rotation, omega, 0.0..duration)?;

        let zero = Vector3::zeros();
        let start = State { rotation: rotation.to_rotation_matrix().into_inner(), b: zero, u: zero, omega };
        let mut typed = 0.0_f64;
        naive::run_top_implicitly(&data, &start, duration, 1e-3, |y| typed = worse(typed, tilt_of(y[0], y[1])));

        let off = |found: f64| (found / truth - 1.0).abs();
        let what = format!("spin² {} % of critical: largest tilt", (100.0 * ratio).round());
        measures.push(
            Measure::new(what, "order 8, h = 0.01 s", off(largest), 0.01)
                .naive("implicit Euler, h = 1 ms", off(typed))
                .note(format!("truth {:.2}°, naive {:.2}°", truth.to_degrees(), typed.to_degrees())),
        );
    }
    Ok(measures)
}

pub fn fast_top(_: Effort) -> Measures {
    let mut measures = Vec::new();
    for (name, words, step, target) in [(FAST, "150 rad/s", 4e-3, 3e-10), ("simo_wong_top", "50 rad/s", 1e-2, 9e-11)] {
        let scene = Scene::top(name)?;
        let kernel = scene.heavy_top().kernel()?;
        let (start, last, duration) = (scene.initial, scene.last, scene.duration);
        let typed = naive::run_top(&MassData::from(&scene), &start, duration, step).distance(&last);
        let typed_words = format!("RK4 on a quaternion, h = {step}");
        for (method, found) in [
            ("order 8, velocities", end(&kernel, VelocityForm, order_8(step), &start, duration)),
            ("order 8, momenta", end(&kernel, MomentumForm, order_8(step), &start, duration)),
            ("order 9, velocities", end(&kernel, VelocityForm, order_9(step), &start, duration)),
            ("splitting 4, exact flow", end(&kernel, MomentumForm, splitting!(&kernel, step), &start, duration)),
        ] {
            let reached = found.map_or(f64::INFINITY, |(state, _)| state.distance(&last));
            measures.push(
                Measure::new(format!("{words}, h = {step}: worst error"), method, reached, target)
                    .because("splitting of order 4 over the exact free flow")
                    .naive(&*typed_words, typed),
            );
        }
        for (method, (found, steps)) in [
            ("order 8, adaptive", end(&kernel, VelocityForm, tight(), &start, duration)?),
            ("power series", end(&kernel, VelocityForm, series(), &start, duration)?),
        ] {
            measures.push(
                Measure::new(format!("{words}, any step: worst error"), method, found.distance(&last), 1e-12)
                    .naive(&*typed_words, typed)
                    .note(format!("{steps} steps")),
            );
        }
    }
    Ok(measures)
}

pub fn chaos(effort: Effort) -> Measures {
    let scene = Scene::top("heavy_asym_top")?;
    let kernel = scene.heavy_top().kernel()?;
    let (start, data) = (scene.initial, MassData::from(&scene));
    let body = Body::held(&data);
    let (pose, twist) = (start.pose(), start.twist());
    let (tolerance, count) = if effort == Effort::Quick { (1e-13, 60) } else { (1e-3, 150) };
    let truth = body.path(1.0, count, &pose, &twist);
    let off = body.path(1.0, count, &pose, &(twist * (1.0 + f64::EPSILON)));

    let mut ours = Vec::new();
    let see = |s: &Sample<_>| ours.push(State::of(&kernel, &s.q, &s.z));
    let run = Simulation::new(&kernel).control(order_8(0.01)).every(100).observe(see);
    run.run_to_end(pose.rotation, start.omega, 0.0..count as f64)?;
    let mut typed = vec![start];
    let mut n = 0_u64;
    naive::runge_kutta(naive::top(&data), naive::top_state(&start), 0.01, 100 * count as u64, |y| {
        n += 1;
        if n.is_multiple_of(100) {
            typed.push(naive::state_of_top(y));
        }
    });

    // How long a motion is right to the tolerance: at least the first second.
    let horizon = |path: &[State]| {
        let good = truth.iter().zip(path).skip(1).take_while(|(truth, state)| state.distance(truth) < tolerance);
        good.count() as f64
    };
    let (best, found, naive) = (horizon(&off), horizon(&ours), horizon(&typed));
    if best == count as f64 {
        return Err("the run is too short to see chaos".into());
    }
    let target = 100.0_f64.ln() / (tolerance / f64::EPSILON).ln();
    Ok(vec![
        Measure::new(
            format!("share of the time that lasts to {tolerance:e}"),
            "order 8, h = 0.01 s",
            1.0 - found / best,
            target,
        )
        .because("a hundred roundings instead of one")
        .naive("RK4 on a quaternion, h = 0.01 s", 1.0 - naive / best)
        .note(format!("right for {found} s; one rounding of the start: {best} s; naive: {naive} s")),
    ])
}
