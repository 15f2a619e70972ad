//! Derivatives of steps against differences, in random scenes, states and modes.

use alloc::vec::Vec;

use gauss_runtime::GaussDynamics;
use gauss_runtime::nalgebra::{Isometry3, SVector, UnitQuaternion, Vector3};
use gauss_runtime::real::Real;

use super::*;
use crate::mode::Mode;
use crate::steps::kept::Kept;
use crate::steps::{Change, StepScheme};

type V<const N: usize> = SVector<f64, N>;

/// Numbers in (−1, 1): a linear congruence with the constants of Knuth's MMIX.
fn numbers(mut seed: u64) -> impl FnMut() -> f64 {
    move || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / 4_503_599_627_370_496.0 - 1.0
    }
}

/// A system in `f64` and in dual numbers, by its parameters.
trait Pair<const P: usize, const N: usize> {
    type Plain: ContactSystem<Scalar = f64, Input: VectorSpace<f64>>;
    type InDuals: ContactSystem<Scalar = Dual<N>, Input: VectorSpace<Dual<N>>>;
    const PARAMETERS: [f64; P];
    fn plain(parameters: [f64; P]) -> Self::Plain;
    fn in_duals(parameters: [Dual<N>; P]) -> Self::InDuals;
}

type Q<S, const P: usize, const N: usize> = <<S as Pair<P, N>>::Plain as GaussSystem>::Configuration;
type Z<S, const P: usize, const N: usize> = <<S as Pair<P, N>>::Plain as GaussSystem>::Speeds;

/// So that the laws are solved to rounding: what is left of them is divided by the steps of differences.
const TIGHT: f64 = 1e-11;

/// Tally of the checks.
#[derive(Debug, Default)]
struct Tally {
    checked: usize,
    at_change: usize,
    /// Contacts that depend on one another only here.
    none: usize,
    shared: usize,
    /// Modes that changed within a difference, or differences that are too coarse.
    left_out: usize,
    open: usize,
    sticks: usize,
    slides: usize,
    closed: usize,
    impacts: usize,
    /// Runs that end where a step was not solved to [`TIGHT`].
    unsolved: usize,
}

fn kinds(modes: &[Mode]) -> Vec<core::mem::Discriminant<Mode>> {
    modes.iter().map(core::mem::discriminant).collect()
}

/// Which gaps are zero to rounding.
fn at_zero<V: VectorSpace<f64>>(gaps: &V) -> Vec<bool> {
    (0..V::DIM).map(|i| gaps.component(i).abs() < 1e-12).collect()
}

impl Tally {
    fn count(&mut self, before: &[Mode], after: &[Mode]) {
        for (was, mode) in before.iter().zip(after) {
            match mode {
                Mode::Open => self.open += 1,
                Mode::Sticks => self.sticks += 1,
                Mode::Slides(_) => self.slides += 1,
                Mode::Closed => self.closed += 1,
            }
            self.impacts += usize::from(mode.is_closed() && !was.is_closed());
        }
    }
}

type Plain<S, const P: usize, const N: usize> = <S as Pair<P, N>>::Plain;
type Input<S, const P: usize, const N: usize> = <Plain<S, P, N> as GaussSystem>::Input;

/// A step that was made, from what was kept before it.
struct Made<'a, S: Pair<P, N>, const P: usize, const N: usize> {
    kept: Kept<S::Plain>,
    end: &'a ContactStepper<'a, S::Plain>,
    h: f64,
    input: Input<S, P, N>,
}

impl<S: Pair<P, N>, const P: usize, const N: usize> Made<'_, S, P, N> {
    /// The end with a direction varied, as (σ⁺, z⁺) from the end as it is; `None` where contacts do something else.
    fn varied<const D: usize, const U: usize>(&self, direction: usize, by: f64) -> Option<V<D>> {
        let components = TangentOf::<S::Plain>::DIM;
        let (t, mut q, mut z) = (self.kept.t, self.kept.q, self.kept.z);
        let (mut input, mut parameters) = (self.input, S::PARAMETERS);
        let varied = |i: usize, x: f64| if i == direction { x + by } else { x };
        let mut along = TangentOf::<S::Plain>::zero();
        (0..components).for_each(|i| along.set_component(i, varied(i, 0.0)));
        q = q.retract(&along);
        (components..D).for_each(|i| z.set_component(i - components, varied(i, z.component(i - components))));
        (0..U).for_each(|i| input.set_component(i, varied(D + i, input.component(i))));
        (0..P).for_each(|i| parameters[i] = varied(D + U + i, parameters[i]));
        let kernel = S::plain(parameters);
        let other = ContactStepper::new(&kernel, t, self.end.q, Z::<S, P, N>::zero()).ok()?;
        let mut other = other.scheme(self.end.scheme).tolerance(TIGHT);
        other.restore(&self.kept);
        (other.q, other.z) = (q, z);
        (other.gaps, other.rates) = (other.kernel.gaps(t, &q), other.kernel.contact_rates(t, &q, &z));
        match other.step(self.h, &input) {
            // The same where joints and a foot that stick jam as a stop strikes.
            Err(ContactError { kind: ContactErrorKind::Unsolved { .. }, .. }) => return None,
            made => drop(made.unwrap()),
        }
        // Gaps that would end below zero are brought to it, whatever their contact does.
        let held = |stepper: &ContactStepper<S::Plain>| at_zero(&stepper.kernel.gaps(0.0, &stepper.q));
        if kinds(other.modes()) != kinds(self.end.modes()) || held(&other) != held(self.end) {
            return None;
        }
        let along = self.end.q.difference(&other.q);
        let faster = other.z.add_scaled(-1.0, &self.end.z);
        Some(V::from_fn(|i, _| if i < components { along.component(i) } else { faster.component(i - components) }))
    }

    /// The derivative by a direction from differences, with what these err; `None` where they are too coarse.
    fn difference<const D: usize, const U: usize>(&self, direction: usize) -> Option<(V<D>, f64)> {
        let end = |by: f64| self.varied::<D, U>(direction, by);
        // Of a step the differences to both sides.
        let of = |step: f64| Some((end(step)? / step, end(-step)? / -step));
        let step = 1e-5;
        let ((ahead, behind), (far_ahead, far_behind)) = (of(step)?, of(2.0 * step)?);
        let (fine, coarse) = ((ahead + behind) / 2.0, (far_ahead + far_behind) / 2.0);
        let expected = (fine * 4.0 - coarse) / 3.0;
        // What the term of third order leaves is much less than all of it. Both sides of a smooth function differ by
        // twice as much for twice the step; by as much for any step where a change of mode is between them.
        let kink = ((ahead - behind) * 2.0 - (far_ahead - far_behind)).amax();
        let own = ((fine - coarse).amax() + kink) / (1.0 + expected.amax());
        (own < 1e-3).then_some((expected, own))
    }
}

/// Derivatives of one step from where a stepper is, against those of differences of fourth order.
fn compare<S, const P: usize, const N: usize, const D: usize, const U: usize>(
    stepper: &mut ContactStepper<S::Plain>,
    h: f64,
    input: &Input<S, P, N>,
    tally: &mut Tally,
) where
    S: Pair<P, N>,
{
    let dual = S::in_duals(core::array::from_fn(|k| Dual::variable(S::PARAMETERS[k], k)));
    stepper.last = Default::default();
    let kept = stepper.kept();
    let found = match stepper.step_with_derivatives::<S::InDuals, N, D, U, P>(h, input, &dual) {
        Ok(found) => found,
        Err(ContactError { kind: ContactErrorKind::NoDerivative | ContactErrorKind::Unsolved { .. }, .. }) => {
            tally.none += 1;
            return;
        }
        Err(error) => {
            panic!("{error} {:?} {:?} {:?}", kept.modes.as_ref(), stepper.modes(), stepper.report())
        }
    };
    let sliding = stepper.modes().iter().filter(|mode| matches!(mode, Mode::Slides(_))).count();
    // Four corners that slide share their load in a way that no law tells, and what turns them depends on it. Where
    // contacts jam, with impulses of 10⁹ N s, the step itself is known to a few digits.
    let left_out = match found.at_change {
        Some(_) => Some(&mut tally.at_change),
        None if sliding > 3 => Some(&mut tally.shared),
        None => (found.report.residual.worst() > 1e-9).then_some(&mut tally.left_out),
    };
    if let Some(left_out) = left_out {
        *left_out += 1;
        return;
    }
    let made = Made::<S, P, N> { kept, end: stepper, h, input: *input };
    for direction in 0..D + U + P {
        let Some((expected, own)) = made.difference::<D, U>(direction) else {
            tally.left_out += 1;
            continue;
        };
        let column = if direction < D {
            found.by_state.column(direction).into_owned()
        } else if direction < D + U {
            found.by_input.column(direction - D).into_owned()
        } else {
            found.by_parameters.column(direction - D - U).into_owned()
        };
        let error = (column - expected).amax() / (1.0 + expected.amax());
        // Hundreds of roundings of rates of some m/s, over the step of differences; and what differences err. Where
        // ends are settled to a part and no better, each of the four is off by as much in either way, of which `own`
        // shows three sevenths at least.
        assert!(error < 1e-6 + 3.0 * own, "{direction}: {error:e} {own:e} {:?} {column} {expected}", stepper.modes());
        tally.checked += 1;
    }
    tally.count(made.kept.modes.as_ref(), stepper.modes());
}

/// Steps from random states, every few of them with derivatives.
fn compare_along<S, const P: usize, const N: usize, const D: usize, const U: usize>(
    (scheme, h): (StepScheme, f64),
    (runs, steps): (usize, usize),
    start: &mut dyn FnMut() -> (Q<S, P, N>, Z<S, P, N>),
    seed: u64,
) -> Tally
where
    S: Pair<P, N>,
{
    let (mut tally, mut number) = (Tally::default(), numbers(seed));
    for _ in 0..runs {
        let (q, z) = start();
        let kernel = S::plain(S::PARAMETERS);
        let mut stepper = ContactStepper::new(&kernel, 0.0, q, z).unwrap().scheme(scheme).tolerance(TIGHT);
        let mut input = <S::Plain as GaussSystem>::Input::zero();
        for n in 0..steps {
            if n % 13 == 0 {
                (0..U).for_each(|i| input.set_component(i, 3.0 * number()));
            }
            if n % 5 == 4 {
                compare::<S, P, N, D, U>(&mut stepper, h, &input, &mut tally);
            } else {
                match stepper.step(h, &input) {
                    // Within 1e-8, as laws are solved unless said otherwise, it is; or an attempt was not solved
                    // without which the step would gain a tenth of its energy.
                    Err(ContactError { kind: ContactErrorKind::Unsolved { residual }, .. }) => {
                        assert!(residual.worst() < 1e-6, "{residual:?}");
                        tally.unsolved += 1;
                        break;
                    }
                    made => drop(made.unwrap()),
                }
            }
        }
    }
    // Of corners that jam the solver leaves 1e-10 now and then.
    assert!(3 * tally.unsolved <= runs, "{tally:?}");
    tally
}

/// A crate on its eight corners, which bounces and is pushed.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(hull, position = pose.position, rotation = pose.rotation, mass = m, inertia = m * a * a / 6),
    contact(floor, point = hull.position, edges = [a, a, a], friction = mu, restitution = e),
    input(push, lift),
    force(wind, body = hull, value = [push, 0, lift], axes = observer),
)]
struct Crate<T> {
    m: T,
    a: T,
    mu: T,
    e: T,
    #[gauss(gravity)]
    g: T,
}

macro_rules! pair {
    ($of:ident $scene:ident $kernel:ident $count:literal [$($value:expr),+] |$p:ident, $number:ident| $made:expr) => {
        struct $of;

        impl Pair<$count, 8> for $of {
            type Plain = $kernel<f64>;
            type InDuals = $kernel<Dual<8>>;
            const PARAMETERS: [f64; $count] = [$($value),+];
            fn plain($p: [f64; $count]) -> Self::Plain {
                let $number = |x: f64| x;
                $made.kernel().unwrap()
            }
            fn in_duals($p: [Dual<8>; $count]) -> Self::InDuals {
                let $number = Dual::<8>::constant;
                $made.kernel().unwrap()
            }
        }
    };
}

pair! { Bouncing Crate CrateKernel 4 [2.0, 0.4, 0.5, 0.3] |p, number|
Crate { m: p[0], a: p[1], mu: p[2], e: p[3], g: number(9.81) } }
pair! { Dropped Crate CrateKernel 3 [2.0, 0.4, 0.5] |p, number|
Crate { m: p[0], a: p[1], mu: p[2], e: number(0.0), g: number(9.81) } }

fn tossed(seed: u64) -> impl FnMut() -> (Isometry3<f64>, V<6>) {
    let mut number = numbers(seed);
    move || {
        let turned = Vector3::from_fn(|_, _| 2.0 * number());
        let z = V::from_fn(|_, _| 2.0 * number());
        (Isometry3::from_parts(Vector3::new(0.0, 0.0, 0.5).into(), UnitQuaternion::new(turned)), z)
    }
}

#[test]
fn a_tossed_crate_has_the_derivatives_of_differences() {
    for scheme in [StepScheme::MoreauJean, StepScheme::Midpoint] {
        let tally = compare_along::<Bouncing, 4, 8, 12, 2>((scheme, 2e-3), (6, 400), &mut tossed(7), 1);
        assert!(tally.checked > 2000 && tally.impacts > 3 && tally.slides > 10, "{tally:?}");
        let tally = compare_along::<Dropped, 3, 8, 12, 2>((scheme, 2e-3), (4, 600), &mut tossed(11), 2);
        // It comes to rest on four corners, which depend on one another.
        assert!(tally.checked > 2000 && tally.sticks > 300, "{tally:?}");
    }
}

/// A disk on its edge and a ball, each with all that resists, on a hilly ground.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(ball, position = pose.position, rotation = pose.rotation, mass = 1, inertia = 0.4 * r * r),
    contact(table, point = ball.position, radius = r, friction = mu, drilling = l, rolling = rho),
    input(push),
    force(wind, body = ball, at = [0, 0, 0.05], value = [push, 0, 0], axes = observer),
)]
struct Ball<T> {
    r: T,
    mu: T,
    l: T,
    rho: T,
    #[gauss(gravity)]
    g: T,
}

pair! { Rolling Ball BallKernel 3 [0.2, 0.3, 0.01] |p, number|
Ball { r: p[0], mu: p[1], l: number(0.05), rho: p[2], g: number(9.81) } }

#[test]
fn drilling_and_rolling_have_the_derivatives_of_differences() {
    let mut number = numbers(5);
    let mut start = || (Isometry3::translation(0.0, 0.0, 0.2), V::from_fn(|i, _| if i == 2 { 0.0 } else { number() }));
    for scheme in [StepScheme::MoreauJean, StepScheme::Midpoint] {
        let tally = compare_along::<Rolling, 3, 8, 12, 1>((scheme, 5e-3), (8, 200), &mut start, 3);
        assert!(tally.checked > 800 && tally.slides > 40 && tally.sticks > 5, "{tally:?}");
    }
}

/// A leg of two links with stops, a dry joint, and a slider that a rod holds; its foot hits the floor.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(hip, knee, slide),
    particle(mass = 1, position = [sin(hip), 0, 2 - cos(hip)]),
    particle(mass = m, position = [sin(hip) + sin(hip + knee), 0, 2 - cos(hip) - cos(hip + knee)]),
    particle(mass = 0.5, position = [slide, 0, 2.5]),
    constraint(position = powi(slide - sin(hip), 2) + powi(0.5 + cos(hip), 2) - 4),
    range(knee, from = -0.5, to = 1.2, restitution = e),
    dry_friction(hip, bound = f),
    contact(foot, gap = 1.9 - cos(hip) - cos(hip + knee) + 0.1 * sin(hip), slip = rate(sin(hip) + sin(hip + knee)),
        friction = mu),
    input(torque),
    drive(knee = torque),
)]
struct Leg<T> {
    m: T,
    e: T,
    f: T,
    mu: T,
    #[gauss(gravity)]
    g: T,
}

pair! { Kicking Leg LegKernel 4 [1.0, 0.4, 0.8, 0.6] |p, number|
Leg { m: p[0], e: p[1], f: p[2], mu: p[3], g: number(9.81) } }

#[test]
fn stops_dry_joints_and_rods_have_the_derivatives_of_differences() {
    let mut number = numbers(13);
    let mut start = || {
        let kernel = Kicking::plain(Kicking::PARAMETERS);
        let hip = 0.5 + 0.1 * number();
        let slide = Real::sin(hip) + Real::sqrt(4.0 - (0.5 + Real::cos(hip)) * (0.5 + Real::cos(hip)));
        let (q, z) = (V::from([hip, 0.4 + 0.3 * number(), slide]), V::from([2.0 * number(), 6.0 * number(), 0.0]));
        GaussSystem::project(&kernel, 0.0, &q, &z).unwrap()
    };
    for scheme in [StepScheme::MoreauJean, StepScheme::Midpoint] {
        let tally = compare_along::<Kicking, 4, 8, 6, 1>((scheme, 5e-3), (20, 300), &mut start, 3);
        assert!(tally.checked > 2000 && tally.slides > 100 && tally.sticks > 10 && tally.impacts > 2, "{tally:?}");
    }
}

/// Two masses on a spring of ωh = 1, one of which bounces: by `Midpoint` forces are taken at mean places, in parts.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    particle(mass = m, position = [x, 0, 0]),
    particle(mass = 1, position = [y, 0, 0]),
    spring(coil, along = y - x, length = 0.2, stiffness = k),
    contact(wall, gap = x, restitution = e),
    input(push),
    drive(y = push),
)]
struct Sprung<T> {
    m: T,
    k: T,
    e: T,
}

pair! { Springing Sprung SprungKernel 3 [1.0, 5e3, 0.5] |p, number|
Sprung { m: p[0], k: number(0.0) + p[1], e: p[2] } }

#[test]
fn stiff_springs_have_the_derivatives_of_differences() {
    let mut number = numbers(17);
    let mut start = || (V::from([0.1, 0.3 + 0.02 * number()]), V::from([-1.0 + 0.5 * number(), number()]));
    // Steps without a memory follow ωh up to 1.
    for (scheme, h) in [(StepScheme::MoreauJean, 0.0095), (StepScheme::Midpoint, 0.01)] {
        let tally = compare_along::<Springing, 3, 8, 4, 1>((scheme, h), (20, 60), &mut start, 3);
        assert!(tally.checked > 1000 && tally.impacts > 2, "{scheme:?} {tally:?}");
    }
}

#[test]
fn a_table_on_four_legs_is_no_failure() {
    // At rest, pressed: gaps stay, slips stay 0, whatever is done to it within friction.
    let kernel = Dropped::plain(Dropped::PARAMETERS);
    let pose = Isometry3::translation(0.0, 0.0, 0.2);
    let mut stepper = ContactStepper::new(&kernel, 0.0, pose, V::zeros()).unwrap();
    let dual = Dropped::in_duals(Dropped::PARAMETERS.map(Dual::constant));
    for _ in 0..3 {
        let step = stepper.step_with_derivatives::<_, 8, 12, 2, 0>(1e-3, &V::from([0.4, 0.0]), &dual).unwrap();
        assert_eq!(step.at_change, None);
        // All rates are held, and of the places height and tilt; places along the floor stay as they were.
        let rounding = 1e-9;
        assert!(step.by_state.rows(6, 6).amax() < rounding && step.by_input.amax() < rounding, "{}", step.by_state);
        for (row, column) in [(0, 0), (1, 1), (5, 5)] {
            assert!((step.by_state[(row, column)] - 1.0).abs() < rounding);
        }
        for row in 2..5 {
            assert!(step.by_state.row(row).amax() < rounding, "{}", step.by_state);
        }
    }
}

#[test]
fn parts_of_a_step_follow_one_another() {
    let kernel = Dropped::plain(Dropped::PARAMETERS);
    let dual = Dropped::in_duals(core::array::from_fn(|k| Dual::variable(Dropped::PARAMETERS[k], k)));
    let (q, z) = tossed(3)();
    let (h, input) = (0.02, V::from([1.0, -2.0]));
    let new = || ContactStepper::new(&kernel, 0.0, q, z).unwrap().scheme(StepScheme::MoreauJean);
    // In two parts, as a step is made for which no impulses are found.
    let (mut stepper, mut seen) = (new(), Seen::default());
    for _ in 0..2 {
        stepper.watched(h, &input, &mut seen).unwrap();
    }
    let both = stepper.differentiated::<_, 8, 12, 2, 3>(&dual, &(0.0, q, z), &input, &seen).unwrap();
    let mut stepper = new();
    let [one, two] = [0, 1].map(|_| stepper.step_with_derivatives::<_, 8, 12, 2, 3>(h, &input, &dual).unwrap());
    // Sums of a dozen products of numbers of some units.
    let near = |a: f64| a < 1e-12;
    assert!(near((both.by_state - two.by_state * one.by_state).amax()));
    assert!(near((both.by_input - two.by_state * one.by_input - two.by_input).amax()));
    assert!(near((both.by_parameters - two.by_state * one.by_parameters - two.by_parameters).amax()));
    assert_eq!(both.passes, 3);
}

#[test]
fn a_contact_at_a_change_is_named() {
    let dual = Dropped::in_duals(Dropped::PARAMETERS.map(Dual::constant));
    let kernel = Dropped::plain(Dropped::PARAMETERS);
    let step = |kernel: &CrateKernel<f64>, dual: &CrateKernel<Dual<8>>, pose, z: V<6>, push: f64| {
        let mut stepper = ContactStepper::new(kernel, 0.0, pose, z).unwrap();
        stepper.step_with_derivatives::<_, 8, 12, 2, 0>(1e-3, &V::from([push, 0.0]), dual).unwrap().at_change
    };
    let rest = Isometry3::translation(0.0, 0.0, 0.2);
    assert_eq!(step(&kernel, &dual, rest, V::zeros(), 1.0), None);
    // Pulled upward by as much as it weighs, nothing presses it.
    let mut stepper = ContactStepper::new(&kernel, 0.0, rest, V::zeros()).unwrap();
    let found = stepper.step_with_derivatives::<_, 8, 12, 2, 0>(1e-3, &V::from([0.0, 2.0 * 9.81]), &dual).unwrap();
    let at = found.at_change.unwrap();
    assert_eq!((at.contact, at.change), ("floor_0", Change::OpenClosed));
    // What bounces rests at an edge.
    let (kernel, dual) = (Bouncing::plain(Bouncing::PARAMETERS), Bouncing::PARAMETERS.map(Dual::constant));
    let dual = Bouncing::in_duals(dual);
    let at = step(&kernel, &dual, rest, V::zeros(), 0.0).unwrap();
    assert_eq!(at.change, Change::RestImpact);
}

#[test]
fn another_system_is_refused_and_the_state_stays() {
    let kernel = Dropped::plain(Dropped::PARAMETERS);
    let pose = Isometry3::translation(0.0, 0.0, 0.2);
    let z = V::from([1.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let mut stepper = ContactStepper::new(&kernel, 0.0, pose, z).unwrap();
    let dual = Dropped::in_duals([2.0, 0.4, 0.6].map(Dual::constant));
    let error = stepper.step_with_derivatives::<_, 8, 12, 2, 0>(1e-3, &V::zeros(), &dual).unwrap_err();
    assert!(matches!(error.kind, ContactErrorKind::OtherSystem { difference } if difference > 1e-5), "{error}");
    assert_eq!((stepper.time(), *stepper.speeds()), (0.0, z));
}
