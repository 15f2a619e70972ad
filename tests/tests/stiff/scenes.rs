//! Stiff scenes of the kinds that users have, by methods with Jacobians and by the explicit method of order 8.

use std::cell::Cell;
use std::time::Instant;

use gauss_runtime::integrate::{Control, Fixed, OneStep, Radau};
use gauss_runtime::prelude::*;

/// A system that counts its accelerations and linearisations.
struct Counted<'k, S> {
    kernel: &'k S,
    counts: Cell<[u64; 2]>,
}

impl<S> Counted<'_, S> {
    fn counting(&self, kind: usize) -> &S {
        let mut counts = self.counts.get();
        counts[kind] += 1;
        self.counts.set(counts);
        self.kernel
    }
}

impl<S: GaussSystem> GaussSystem for Counted<'_, S> {
    gauss_runtime::forward_system! { S => kernel: types constants motion momenta energies condition constraints }

    fn acceleration(&self, t: S::Scalar, q: &S::Configuration, z: &S::Speeds, input: &S::Input) -> S::Speeds {
        self.counting(0).acceleration(t, q, z, input)
    }

    fn momentum_rate(&self, t: S::Scalar, q: &S::Configuration, p: &S::Speeds, input: &S::Input) -> S::Speeds {
        self.counting(0).momentum_rate(t, q, p, input)
    }
}

impl<S: LinearizedSystem> LinearizedSystem for Counted<'_, S> {
    type Linearization = S::Linearization;

    const STATE_PATTERN: &'static [&'static [bool]] = S::STATE_PATTERN;
    const INPUT_PATTERN: &'static [&'static [bool]] = S::INPUT_PATTERN;

    fn linearize(&self, t: S::Scalar, q: &S::Configuration, z: &S::Speeds, input: &S::Input) -> S::Linearization {
        self.counting(1).linearize(t, q, z, input)
    }
}

/// A mass on a spring and damper, the other end of which is shaken: x follows sin 3t, however stiff.
#[derive(GaussDynamics)]
#[gauss(
    linearize,
    coordinates(x),
    particle(mass = 1, position = [x, 0, 0]),
    spring(along = x - sin(3 * t), stiffness = k, damping = c),
)]
struct Shaken {
    k: f64,
    c: f64,
}

/// A bob on a rod that is a stiff spring with a damper, on a pivot that is shaken.
#[derive(GaussDynamics)]
#[gauss(
    linearize,
    coordinates(x, z),
    particle(mass = 1, position = [x, 0, z]),
    spring(from = [0.1 * sin(3 * t), 0, 0], to = [x, 0, z], stiffness = k, length = 1, damping = c),
)]
pub struct Penalty<T> {
    pub k: T,
    pub c: T,
    #[gauss(gravity)]
    pub g: T,
}

/// A crank that drives a slider by a rod without mass, the end of which sits on the pin in a stiff bushing.
#[derive(GaussDynamics)]
#[gauss(
    linearize,
    coordinates(angle, x, z, slider),
    particle(mass = 1, position = [0.2 * cos(angle), 0, 0.2 * sin(angle)]),
    particle(mass = 0.1, position = [x, 0, z]),
    particle(mass = 2, position = [slider, 0, 0]),
    spring(along = x - 0.2 * cos(angle), stiffness = k, damping = c),
    spring(along = z - 0.2 * sin(angle), stiffness = k, damping = c),
    constraint(position = (x - slider).powi(2) + z * z - 0.36),
    drive(angle = 0.5 + cos(2 * t)),
)]
struct SliderCrank {
    k: f64,
    c: f64,
    #[gauss(gravity)]
    g: f64,
}

/// A run: steps, trials that were rejected, evaluations, linearisations, microseconds, and the error of q at its end.
pub struct Figures {
    pub steps: u64,
    rejected: u64,
    counts: [u64; 2],
    micros: f64,
    error: f64,
}

type Start<S> = (<S as GaussSystem>::Configuration, <S as GaussSystem>::Speeds);

fn figures<S, C>(kernel: &S, (q, z): Start<S>, span: f64, control: C, exact: &S::Configuration) -> Figures
where
    S: LinearizedSystem<Scalar = f64, Input = ()>,
    C: for<'k> Control<Counted<'k, S>>,
{
    let counted = Counted { kernel, counts: Cell::new([0; 2]) };
    let clock = Instant::now();
    let end = Simulation::new(&counted).control(control).run_to_end(q, z, 0.0..span).expect("runs");
    let micros = clock.elapsed().as_secs_f64() * 1e6;
    let error = end.q.difference(exact).max_norm();
    let (steps, rejected) = (end.summary.steps, end.summary.rejected);
    Figures { steps, rejected, counts: counted.counts.get(), micros, error }
}

/// Runs of a scene by Radau, Rosenbrock and order 8 at some tolerances, which are printed; each keeps its tolerance.
pub fn compare<S: LinearizedSystem<Scalar = f64, Input = ()>>(
    what: &str,
    kernel: &S,
    start: Start<S>,
    span: f64,
) -> Vec<[Figures; 3]> {
    let exact = Simulation::new(kernel).adaptive(1e-12, 1e-13).run_to_end(start.0, start.1, 0.0..span).expect("runs").q;
    let mut all = Vec::new();
    for tolerance in [1e-4, 1e-6, 1e-8] {
        let radau = figures(kernel, start, span, Adaptive::by(Radau, tolerance, tolerance), &exact);
        let rosenbrock = figures(kernel, start, span, Adaptive::by(Rosenbrock, tolerance, tolerance), &exact);
        let explicit = figures(kernel, start, span, Adaptive::new(tolerance, tolerance), &exact);
        for (method, run) in [("Radau", &radau), ("Rosenbrock", &rosenbrock), ("order 8", &explicit)] {
            println!(
                "{what:<24} {tolerance:.0e} {method:<10} {:>6} steps {:>5} rejected {:>8} evaluations {:>6} Jacobians \
                 {:>9.0} µs, error {:.1e}",
                run.steps, run.rejected, run.counts[0], run.counts[1], run.micros, run.error
            );
        }
        // Errors of steps add up, and none grows much: what is stiff is damped, what is slow swings.
        for run in [&radau, &rosenbrock] {
            assert!(run.error < 10.0 * run.steps as f64 * tolerance, "{what}: {:e}", run.error);
        }
        all.push([radau, rosenbrock, explicit]);
    }
    all
}

#[test]
fn places_that_are_shaken() {
    let kernel = Shaken { k: 1e8, c: 2e4 }.kernel().expect("a spring");
    let all = compare("shaken", &kernel, ([0.0].into(), [3.0].into()), 5.0);
    for [radau, rosenbrock, explicit] in all {
        assert!(40 * radau.steps < rosenbrock.steps.min(explicit.steps));
    }
}

#[test]
fn rods_that_are_stiff_springs() {
    for (k, c) in [(1e6, 20.0), (1e8, 2e4)] {
        let kernel = Penalty { k, c, g: 9.81 }.kernel().expect("a pendulum");
        let all = compare(&format!("rod as a spring, {k:e}"), &kernel, ([1.0, 0.0].into(), [0.3, 0.0].into()), 5.0);
        let [radau, rosenbrock, _] = all.last().expect("the smallest tolerance");
        assert!(5 * radau.steps < rosenbrock.steps && 2 * radau.counts[0] < rosenbrock.counts[0]);
    }
}

#[test]
fn cranks_on_stiff_bushings() {
    let kernel = SliderCrank { k: 1e7, c: 1e4, g: 0.0 }.kernel().expect("a crank");
    let (x, z) = (0.2 * 0.3_f64.cos(), 0.2 * 0.3_f64.sin());
    let q = SVector::from([0.3, x, z, x + (0.36 - z * z).sqrt()]);
    let all = compare("crank on a bushing", &kernel, (q, SVector::zeros()), 2.0);
    let [radau, rosenbrock, explicit] = all.last().expect("the smallest tolerance");
    assert!(20 * radau.steps < rosenbrock.steps.min(explicit.steps));
}

/// Errors after 2 s of steps of a tenth of a second, and of half the length time and again: all a hundred times as long
/// as the spring's own motion.
fn halving(method: impl OneStep<ShakenKernel> + Copy) -> [f64; 4] {
    let kernel = Shaken { k: 1e8, c: 2e4 }.kernel().expect("a spring");
    // ẍ + 2·10⁴ ẋ + 10⁸ x = 2·10⁴ · 3 cos 3t + 10⁸ sin 3t: the motion that does not decay is s sin 3t + c cos 3t.
    let (a, b, d) = (1e8 - 9.0, 6e4, 6e4 * 6e4);
    let (sine, cosine) = ((a * 1e8 + d) / (a * a + d), (a * b - b * 1e8) / (a * a + d));
    let motion = |t: f64| {
        let (s, c) = (3.0 * t).sin_cos();
        (sine * s + cosine * c, 3.0 * (sine * c - cosine * s))
    };
    [0.1, 0.05, 0.025, 0.0125].map(|h| {
        let run = Simulation::new(&kernel).control(Fixed::by(method, h));
        let (x, v) = motion(0.0);
        let end = run.run_to_end([x].into(), [v].into(), 0.0..2.0).expect("runs");
        let (x, v) = motion(2.0);
        (end.q[0] - x).abs().max((end.z[0] - v).abs())
    })
}

/// After Prothero and Robinson: in the stiff limit the power of the step is that of the stages, three, and there is no
/// more of an error than that. Stages of Rosenbrock's method satisfy nothing, and leave more of it.
#[test]
fn stages_keep_their_order_in_the_stiff_limit() {
    let (radau, rosenbrock) = (halving(Radau), halving(Rosenbrock));
    println!("errors of halved steps: Radau {radau:?}, Rosenbrock {rosenbrock:?}");
    for pair in radau.windows(2) {
        assert!(pair[0] / pair[1] > 7.0, "{radau:?}");
    }
    // Of order 2 it would fall to a 64th in an eighth of the step.
    assert!(rosenbrock[0] / rosenbrock[3] < 64.0 && rosenbrock[3] > 100.0 * radau[3], "{rosenbrock:?}");
}
