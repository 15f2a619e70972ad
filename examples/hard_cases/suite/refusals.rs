//! What is stiff, what is huge or tiny, and what is no number at all.

use std::error::Error;

use gauss_runtime::integrate::{Control, Fixed, Form};
use gauss_runtime::prelude::*;

use super::measure::worse;
use super::scenes::{
    FreeTop, HeavyTop, HeavyTopKernel, Projectile, ProjectileKernel, Scene, Sinking, SinkingKernel, State,
};
use super::truth::MassData;
use super::{Effort, Measure, naive};

type Measures = Result<Vec<Measure>, Box<dyn Error>>;

/// The error of the speed of sinking after `duration` from rest, relative to the final speed; infinite where the run
/// stops.
fn sinking<C: Control<SinkingKernel>>(kernel: &SinkingKernel, control: C, rate: f64, duration: f64) -> (f64, String) {
    let mut steps = -1_i64;
    let run = Simulation::new(kernel).control(control).observe(|_| steps += 1);
    match run.run_to_end(Isometry3::identity(), Vector6::zeros(), 0.0..duration) {
        Ok(end) => {
            // u̇ = −g − rate·u.
            let truth = 9.81 / rate * (-rate * duration).exp_m1();
            ((end.z[2] - truth).abs() / (9.81 / rate), format!("{steps} steps"))
        }
        Err(error) => (f64::INFINITY, error.to_string().split("; ").next().unwrap_or_default().into()),
    }
}

pub fn stiff_drag(effort: Effort) -> Measures {
    let rate = 1000.0;
    let drag = Vector6::from_element(rate);
    let kernel = Sinking { mass: 1.0, inertia: 1.0, g: 9.81, drag }.kernel()?;
    let duration = if effort == Effort::Quick { 2.0 } else { 100.0 };
    let typed = |h: f64| {
        let rate = |u: &SVector<f64, 1>| SVector::from([-9.81 - rate * u[0]]);
        let u = naive::runge_kutta(rate, SVector::from([0.0]), h, (duration / h) as u64, |_| ());
        let error = (u[0] * 1000.0 / 9.81 + 1.0).abs();
        if error.is_finite() { error } else { f64::INFINITY }
    };
    // Methods with steps a thousand times longer than the drag's time: stable is who stays within where it started.
    let mut measures = Vec::new();
    for (method, (reached, note)) in [
        ("RKMK 4, h = 1 s", sinking(&kernel, Fixed::with(&Tableau::RK4, 1.0), rate, duration)),
        ("order 8, h = 1 s", sinking(&kernel, super::methods::order_8(1.0), rate, duration)),
        ("Gauss 6 by fixed point, h = 1 s", sinking(&kernel, super::methods::gauss_6(1.0), rate, duration)),
        ("linearly implicit, h = 1 s", sinking(&kernel, super::methods::linearly_implicit(1.0), rate, duration)),
    ] {
        measures.push(
            Measure::new("h × rate = 1000: speed, relative", method, reached, 1.0)
                .because("bounded by the start; explicit methods are not")
                .naive("RK4 by hand, h = 1 s", typed(1.0))
                .note(note),
        );
    }
    let (reached, note) = sinking(&kernel, Adaptive::with(&Tableau::DORMAND_PRINCE_5, 1e-8, 1e-8), rate, duration);
    measures.push(
        Measure::new("speed with steps by tolerance, relative", "adaptive 5(4), 1e-8", reached, 1e-5)
            .because("tolerance 1e-8 of speeds of 0.01")
            .naive("RK4 by hand, h = 3 ms", typed(3e-3))
            .note(format!("{note}: stability, not accuracy, sets them")),
    );
    let (reached, note) = sinking(&kernel, Adaptive::by(Rosenbrock, 1e-8, 1e-8), rate, duration);
    measures.push(
        Measure::new("speed with steps by tolerance, relative", "linearly implicit, 1e-8", reached, 1e-5)
            .because("tolerance 1e-8 of speeds of 0.01")
            .naive("RK4 by hand, h = 3 ms", typed(3e-3))
            .note(note),
    );
    Ok(measures)
}

/// Powers of two by which masses, lengths and times are multiplied.
#[derive(Clone, Copy)]
struct Units {
    mass: i32,
    length: i32,
    time: i32,
}

fn two(power: i32) -> f64 {
    // In two factors: 2^996 has no intermediate result that overflows.
    2.0_f64.powi(power / 2) * 2.0_f64.powi(power - power / 2)
}

impl Units {
    fn data(self, data: &MassData) -> MassData {
        let Self { mass, length, time } = self;
        MassData {
            mass: data.mass * two(mass),
            center: data.center * two(length),
            inertia: data.inertia * two(mass) * two(length) * two(length),
            added: data.added,
            gravity: data.gravity * two(length) / two(time) / two(time),
        }
    }

    /// A state in these units, or back.
    fn state(self, state: &State, there: bool) -> State {
        let sign = if there { 1 } else { -1 };
        let (length, time) = (two(sign * self.length), two(sign * self.time));
        State { rotation: state.rotation, b: state.b * length, u: state.u * length / time, omega: state.omega / time }
    }
}

/// Difference of two states in units of ε, each part relative to its size.
fn ulps(a: &State, b: &State) -> f64 {
    let relative = |a: &Vector3<f64>, b: &Vector3<f64>| {
        let size = b.amax();
        if size > 0.0 { (a - b).amax() / size } else { (a - b).amax() }
    };
    let errors =
        [(a.rotation - b.rotation).amax(), relative(&a.b, &b.b), relative(&a.u, &b.u), relative(&a.omega, &b.omega)];
    errors.into_iter().fold(0.0, worse) / f64::EPSILON
}

/// Ten steps of a top or of a projectile.
fn ten_steps<F>(data: &MassData, held: bool, form: F, from: &State, h: f64) -> Result<State, Box<dyn Error>>
where
    F: Form<HeavyTopKernel> + Form<ProjectileKernel>,
{
    let MassData { mass, center, inertia, gravity, .. } = *data;
    if held {
        let kernel = HeavyTop { mass, center, inertia, gravity }.kernel()?;
        Ok(super::methods::end(&kernel, form, Fixed::new(h), from, 10.0 * h)?.0)
    } else {
        let kernel = Projectile { mass, center, inertia, gravity }.kernel()?;
        Ok(super::methods::end(&kernel, form, Fixed::new(h), from, 10.0 * h)?.0)
    }
}

pub fn units(_: Effort) -> Measures {
    let scene = Scene::top("heavy_asym_top")?;
    let data = MassData::from(&scene);
    let h = two(-6);
    let mut measures = Vec::new();
    for (name, unit) in [
        ("masses", Units { mass: 498, length: 0, time: 0 }),
        ("lengths", Units { mass: 0, length: 498, time: 0 }),
        ("times", Units { mass: 0, length: 0, time: 498 }),
    ] {
        let (mut worst, mut typed, mut note) = (0.0_f64, 0.0_f64, String::new());
        for sign in [1, -1] {
            let unit = Units { mass: sign * unit.mass, length: sign * unit.length, time: sign * unit.time };
            for held in [true, false] {
                // A projectile that moves too; a top does not.
                let u = if held { Vector3::zeros() } else { Vector3::new(3.0, -2.0, 5.0) };
                let start = State { u, ..scene.initial };
                let there = unit.state(&start, true);
                let plain = [
                    ten_steps(&data, held, VelocityForm, &start, h)?,
                    ten_steps(&data, held, MomentumForm, &start, h)?,
                ];
                let step = h * two(unit.time);
                let found = [
                    ten_steps(&unit.data(&data), held, VelocityForm, &there, step),
                    ten_steps(&unit.data(&data), held, MomentumForm, &there, step),
                ];
                for (plain, found) in plain.iter().zip(found) {
                    match found {
                        Ok(found) => worst = worse(worst, ulps(&unit.state(&found, false), plain)),
                        Err(error) => {
                            worst = f64::INFINITY;
                            let body = if held { "a top" } else { "a projectile" };
                            let said = format!("{body} × 1e{}: {error}", 150 * sign);
                            let said = said.split("; ").next().unwrap_or_default();
                            if !note.contains(said) {
                                note += &format!("{}{said}", if note.is_empty() { "" } else { "; " });
                            }
                        }
                    }
                }
                if held {
                    let plain = naive::run_top(&data, &start, 10.0 * h, h);
                    let found = naive::run_top(&unit.data(&data), &there, 10.0 * step, step);
                    let off = ulps(&unit.state(&found, false), &plain);
                    typed = worse(typed, if off.is_nan() { f64::INFINITY } else { off });
                }
            }
        }
        measures.push(
            Measure::new(format!("{name} × 1e±150: change in units of ε"), "two bodies, both forms", worst, 4.0)
                .naive("inverse by cofactors", typed)
                .note(note),
        );
    }
    Ok(measures)
}

pub fn bad_input(_: Effort) -> Measures {
    Ok(vec![numbers_that_are_none()?, impossible_bodies()])
}

fn numbers_that_are_none() -> Result<Measure, Box<dyn Error>> {
    let scene = Scene::top("heavy_asym_top")?;
    let HeavyTop { mass, center, inertia, gravity } = scene.heavy_top();
    let kernel = scene.heavy_top().kernel()?;
    let (q, z) = (scene.initial.pose().rotation, scene.initial.omega);
    let bad = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

    let (mut tried, mut silent) = (0_u32, 0_u32);
    let mut see = |accepted: bool| {
        tried += 1;
        silent += u32::from(accepted);
    };
    for value in bad {
        see(HeavyTop { mass: value, center, inertia, gravity }.kernel().is_ok());
        see(HeavyTop { mass, center, inertia, gravity: value }.kernel().is_ok());
        for i in 0..3 {
            let mut center = center;
            center[i] = value;
            see(HeavyTop { mass, center, inertia, gravity }.kernel().is_ok());
        }
        for i in 0..9 {
            let mut inertia = inertia;
            inertia[i] = value;
            see(HeavyTop { mass, center, inertia, gravity }.kernel().is_ok());
        }
        let run = |q, z, end| {
            let run = Simulation::new(&kernel);
            run.fixed_step(0.01).run_to_end(q, z, 0.0..end).is_ok()
                || run.adaptive(1e-6, 1e-6).run_to_end(q, z, 0.0..end).is_ok()
        };
        for i in 0..4 {
            let mut coordinates = q.into_inner();
            coordinates.coords[i] = value;
            see(run(UnitQuaternion::new_unchecked(coordinates), z, 1.0));
        }
        for i in 0..3 {
            let mut z = z;
            z[i] = value;
            see(run(q, z, 1.0));
        }
        see(run(q, z, value));
        see(Simulation::new(&kernel).fixed_step(value).run_to_end(q, z, 0.0..1.0).is_ok());
        see(Simulation::new(&kernel).adaptive(value, 1e-6).run_to_end(q, z, 0.0..1.0).is_ok());
        see(Simulation::new(&kernel).adaptive(1e-6, value).run_to_end(q, z, 0.0..1.0).is_ok());
    }
    let words = format!("a program without checks takes all {tried}");
    let measure = Measure::new("NaN and ±∞ taken in silence", "parameters, states, times, steps", silent.into(), 0.0);
    Ok(measure.naive(words, tried.into()))
}

/// Moments that no distribution of mass has, and the like.
fn impossible_bodies() -> Measure {
    let tops = [[1.0, 1.0, 3.0], [-1.0, 1.0, 1.0], [1.0, 0.0, 1.0], [1.0, 2.0, 3.001]];
    let messages: Vec<String> = tops
        .into_iter()
        .filter_map(|moments| FreeTop { mass: 1.0, inertia: moments.into() }.kernel().err())
        .map(|error| error.to_string())
        .collect();
    let diagonal = |moments: [f64; 3]| Matrix3::from_diagonal(&moments.into());
    let mut skewed = diagonal([1.0, 1.0, 1.0]);
    skewed[(0, 1)] = 0.1;
    // Asymmetric; less about G than nothing; no mass; a negative one.
    let bodies = [
        Projectile { mass: 1.0, center: Vector3::zeros(), inertia: skewed, gravity: 0.0 },
        Projectile { mass: 1.0, center: Vector3::x() * 2.0, inertia: diagonal([1.0, 1.0, 1.0]), gravity: 0.0 },
        Projectile { mass: 0.0, center: Vector3::zeros(), inertia: diagonal([1.0, 1.0, 1.0]), gravity: 0.0 },
        Projectile { mass: -1.0, center: Vector3::zeros(), inertia: diagonal([1.0, 1.0, 1.0]), gravity: 0.0 },
    ];
    let refused = messages.len() + bodies.iter().filter(|body| body.kernel().is_err()).count();
    let total = tops.len() + bodies.len();
    Measure::new("impossible bodies accepted", "refused by kernel()", (total - refused) as f64, 0.0)
        .naive("a program without checks takes them", total as f64)
        .note(messages.first().cloned().unwrap_or_default())
}
