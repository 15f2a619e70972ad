//! Derivatives of runs through impacts, sticking and rest, against closed forms and against differences.

use gauss_adapters::{DualNumber, linearize};
use gauss_contact::{ContactErrorKind, ContactRun, EventKind, InMode, Mode};
use gauss_runtime::linearize::Linearization;
use gauss_runtime::prelude::*;
use gauss_runtime::real::largest_derivative;
use num_dual::{Dual64, HyperDual64};

use super::events::{Three, closed_form, parts, variables};

/// A block above a floor, thrown along it.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, height),
    particle(mass = 3, position = [x, 0, height]),
    contact(floor, gap = height, slip = rate(x), friction = mu, restitution = e),
)]
struct Block<T> {
    mu: T,
    e: T,
    #[gauss(gravity)]
    g: T,
}

/// A homogeneous ball on a plane.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(ball, position = pose.position, rotation = pose.rotation, mass = 0.2, inertia = 0.08 * r * r),
    contact(table, point = ball.position, radius = r, friction = mu, restitution = e),
)]
struct Billiard<T> {
    r: T,
    mu: T,
    e: T,
    #[gauss(gravity)]
    g: T,
}

/// A mass on a spring, with a wall.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    particle(mass = 1, position = [x, 0, 0]),
    spring(along = x, stiffness = k),
    contact(wall, gap = x + d, restitution = e),
)]
struct Impactor<T> {
    k: T,
    d: T,
    e: T,
}

/// Two balls, that know nothing of one another.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b),
    particle(mass = 2, position = [0, 0, a]),
    particle(mass = 3, position = [1, 0, b]),
    contact(left, gap = a, restitution = 0.5),
    contact(right, gap = b, restitution = 0.5),
)]
struct Both<T> {
    #[gauss(gravity)]
    g: T,
}

/// A wheel with a motor, held by a spring.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, height, turn),
    body(wheel, position = [x, 0, height], rotation = rotation_y(turn), mass = 2, inertia = [1, 0.3, 1]),
    spring(along = x, stiffness = k, damping = c),
    input(motor),
    drive(turn = motor),
    contact(floor, gap = height - r, slip = rate(x) - r * rate(turn), friction = 0.5),
)]
struct Wheel<T> {
    r: T,
    k: T,
    c: T,
    #[gauss(gravity)]
    g: T,
}

/// Something that lies on a table that goes up and down.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    particle(mass = 3, position = [x, 0, y]),
    contact(table, gap = y - a * sin(t), slip = rate(x), friction = 0.5),
)]
struct Shaken<T> {
    a: T,
    #[gauss(gravity)]
    g: T,
}

/// A body in the air, over a floor.
#[derive(GaussDynamics)]
#[gauss(
    linearize(without_contacts),
    coordinates(pose: Pose),
    body(stone, position = pose.position, rotation = pose.rotation, mass = 2, inertia = [0.5, 0.6, 0.6],
         center_of_mass = [0.1, 0, 0.2]),
    input(thrust),
    force(thrust, body = stone, value = [thrust, 0, 0], at = [0, 0.3, 0]),
    contact(floor, point = stone.position, radius = 0.1),
)]
struct Stone<T> {
    #[gauss(gravity)]
    g: T,
}

fn number<T: Real>(x: f64) -> T {
    T::from_f64(x)
}

#[test]
fn bounces_have_the_derivatives_of_their_closed_form() {
    fn run<T: Real>([h, e, g]: [T; 3]) -> (usize, [T; 2]) {
        let kernel = Block { mu: T::zero(), e, g }.kernel().expect("a block");
        let run = ContactRun::new(&kernel).adaptive(1e-11, 1e-11);
        let run = run.run(SVector::from([T::zero(), h]), SVector::from([T::zero(); 2]), T::zero()..number(2.0));
        let run = run.expect("bounces");
        let last = run.last().expect("an end");
        (run.events().len(), [last.q[1], last.z[1]])
    }
    let values = [1.0, 0.8, 9.81];
    let (impacts, end) = run(variables(values));
    assert!(impacts >= 3);
    for (x, y) in end.into_iter().zip(closed_form(variables(values), impacts).1) {
        for (x, y) in parts(x).into_iter().zip(parts(y)) {
            // Numbers up to 10, in some 100 steps.
            assert!((x - y).abs() < 1e-11, "{x} {y}");
        }
    }
    let hyper = |x: f64| DualNumber(HyperDual64::from_re(x));
    let mixed = [DualNumber(hyper(1.0).derivative1()), DualNumber(hyper(0.8).derivative2()), hyper(9.81)];
    for (x, y) in run(mixed).1.into_iter().zip(closed_form(mixed, impacts).1) {
        assert!((x.eps1eps2 - y.eps1eps2).abs() < 1e-10, "{x:?} {y:?}");
    }
}

/// Bounces with friction that pile up, then a slide to a stop: how far the block comes.
#[test]
fn what_piles_up_keeps_its_derivatives() {
    fn run<T: Real>(v: T, [h, e, mu]: [T; 3]) -> T {
        let kernel = Block { mu, e, g: number(9.81) }.kernel().expect("a block");
        let run = ContactRun::new(&kernel).adaptive(1e-11, 1e-11);
        let run = run.run(SVector::from([T::zero(), h]), SVector::from([v, T::zero()]), T::zero()..number(3.0));
        let run = run.expect("stops");
        let kinds: Vec<_> = run.events().iter().map(|event| event.kind).collect();
        assert!(kinds.iter().any(|kind| matches!(kind, EventKind::Rests { .. })), "{kinds:?}");
        assert_eq!(kinds.last(), Some(&EventKind::Sticks));
        let last = run.last().expect("an end");
        assert!(largest_derivative(last.q[1]) == 0.0 && largest_derivative(last.z[1]) < 1e-12);
        last.q[0]
    }
    fn closed_form<T: Real>(mut v: T, [h, e, mu]: [T; 3]) -> T {
        let (g, two) = (number::<T>(9.81), number::<T>(2.0));
        let mut down = (two * g * h).sqrt();
        let mut x = v * down / g;
        for _ in 0..200 {
            v -= mu * (T::one() + e) * down;
            down *= e;
            x += v * two * down / g;
        }
        x + v * v / (two * mu * g)
    }
    let values = [0.1, 0.5, 0.3];
    let (found, expected) = (run(number(2.0), variables(values)), closed_form(number(2.0), variables(values)));
    for (x, y) in parts(found).into_iter().zip(parts(expected)) {
        // Flights below the tolerance of speeds are left out: some 30 times 1e-11, times some seconds.
        assert!((x - y).abs() < 3e-9, "{x} {y}");
    }
}

#[test]
fn a_block_slides_to_its_stop() {
    let [v, mu, g] = variables([2.0, 0.3, 9.81]);
    let kernel = Block { mu, e: Three::zero(), g }.kernel().expect("a block");
    let run = ContactRun::new(&kernel).adaptive(1e-11, 1e-11);
    let run =
        run.run(SVector::zeros_of(), SVector::from([v, Three::zero()]), Three::zero()..number(1.0)).expect("stops");
    let (last, expected) = (run.last().expect("an end"), v * v / (number::<Three>(2.0) * mu * g));
    for (x, y) in parts(last.q[0]).into_iter().zip(parts(expected)) {
        assert!((x - y).abs() < 1e-12, "{x} {y}");
    }
    assert!(parts(last.z[0]) == [0.0; 4] && parts(last.q[1]) == [0.0; 4]);
    // Its friction while it slid, and none now.
    let forces = *run.forces(number(0.1)).expect("slides");
    for (x, y) in parts(forces[1]).into_iter().zip(parts(number::<Three>(-3.0) * mu * g)) {
        assert!((x - y).abs() < 1e-13, "{x} {y}");
    }
    assert_eq!(run.modes(number(0.9)).expect("stands"), &[Mode::Sticks]);
}

trait Zeros {
    fn zeros_of() -> Self;
}

impl<T: Real, const N: usize> Zeros for SVector<T, N> {
    fn zeros_of() -> Self {
        Self::from([T::zero(); N])
    }
}

fn place<T: Real>(height: T) -> Isometry3<T> {
    let (zero, one) = (T::zero(), T::one());
    let upright = UnitQuaternion::new_unchecked(Quaternion::from(SVector::from([zero, zero, zero, one])));
    Isometry3 { translation: SVector::from([zero, zero, height]).into(), rotation: upright }
}

#[test]
fn a_ball_rolls_after_it_has_slid() {
    let [v, mu, r] = variables([2.0, 0.2, 0.03]);
    let (zero, g) = (Three::zero(), number::<Three>(9.81));
    let kernel = Billiard { r, mu, e: zero, g }.kernel().expect("a ball");
    let along = [number::<Three>(0.6), number(-0.8)];
    let z = SVector::from([v * along[0], v * along[1], zero, zero, zero, zero]);
    let run = ContactRun::new(&kernel).adaptive(1e-11, 1e-11).run(place(r), z, zero..Three::one()).expect("rolls");
    let t = number::<Three>(2.0) * v / (number::<Three>(7.0) * mu * g);
    let slid = v * t - mu * g * t * t * number(0.5);
    let way = slid + (Three::one() - t) * v * Three::ratio(5, 7);
    let place = run.last().expect("an end").q.translation.vector;
    for (i, wanted) in [way * along[0], way * along[1], r].into_iter().enumerate() {
        for (x, y) in parts(place[i]).into_iter().zip(parts(wanted)) {
            // The slip ends at a speed of 3e-11; spins have derivatives of 2e3 by r, known to 1e-11 in each step.
            assert!((x - y).abs() < 1e-8, "{i}: {x} {y}");
        }
    }
}

/// [Φ(t − t₁) S Φ(t₁)], with S of the jump v → −e v at the wall: S = [[−e, 0], [(1 + e) a/v, −e]], a the acceleration
/// at the wall and v the speed before (P. C. Müller, *Calculation of Lyapunov exponents for dynamic systems with
/// discontinuities*, Chaos, Solitons & Fractals 5, 1995).
#[test]
fn the_impact_oscillator_has_its_saltation_matrix() {
    let (k, d, e, t): (f64, f64, f64, f64) = (2.0, 0.3, 0.7, 2.2);
    let [x, v, zero] = variables([0.5, 0.1, 0.0]);
    let kernel = Impactor { k: number::<Three>(k), d: number(d), e: number(e) }.kernel().expect("an oscillator");
    let run = ContactRun::new(&kernel).adaptive(1e-12, 1e-12);
    let run = run.run(SVector::from([x]), SVector::from([v]), zero..number(t)).expect("bounces");
    let [hit] = run.events() else { panic!("{:?}", run.events()) };
    let EventKind::Impact(impact) = hit.kind else { panic!("{hit:?}") };
    let w = k.sqrt();
    let flow = |t: f64| SMatrix::<f64, 2, 2>::new((w * t).cos(), (w * t).sin() / w, -w * (w * t).sin(), (w * t).cos());
    let salt = SMatrix::<f64, 2, 2>::new(-e, 0.0, (1.0 + e) * k * d / impact.before[0], -e);
    let expected = flow(t - hit.time) * salt * flow(hit.time);
    let last = run.last().expect("an end");
    for (row, number) in [last.q[0], last.z[0]].into_iter().enumerate() {
        let slopes = parts(number);
        for column in 0..2 {
            // Some ten tolerances; numbers up to 4.
            let off = slopes[1 + column] - expected[(row, column)];
            assert!(off.abs() < 1e-10, "{row} {column}: {off:e}");
        }
    }
}

/// An impact with friction in space, and a second one: against differences of whole runs.
#[test]
fn impacts_with_friction_have_derivatives() {
    fn run<T: Real>([mu, v, spin]: [T; 3]) -> [T; 4] {
        let r = number::<T>(0.03);
        let kernel = Billiard { r, mu, e: number(0.6), g: number(9.81) }.kernel().expect("a ball");
        let z = SVector::from([v, number(0.7), T::zero(), spin, number(-20.0), number(5.0)]);
        let run = ContactRun::new(&kernel).adaptive(1e-12, 1e-12);
        let run = run.run(place(r + number(0.2)), z, T::zero()..number(0.55)).expect("bounces");
        let slips = run.events().iter().filter_map(|event| match event.kind {
            EventKind::Impact(impact) => Some(impact.after[1].abs() + impact.after[2].abs() > 1e-9),
            _ => None,
        });
        let sticks = mu.lane(0) > 0.1;
        assert_eq!(slips.collect::<Vec<_>>(), [!sticks; 2], "{:?}", run.events());
        let last = run.last().expect("an end");
        let place = last.q.translation.vector;
        [place[0], place[1], last.z[3], last.z[4]]
    }
    // The slip goes on through both impacts, or ends in them.
    for values in [[0.05, 1.5, 8.0], [0.25, 1.5, 8.0]] {
        let found = run(variables(values)).map(parts);
        for k in 0..3 {
            let central = |step: f64| {
                let mut both = [values; 2];
                both[0][k] += step;
                both[1][k] -= step;
                let [after, before] = both.map(run);
                [0, 1, 2, 3].map(|i| (after[i] - before[i]) / (2.0 * step))
            };
            let (fine, coarse) = (central(1e-4), central(2e-4));
            for i in 0..4 {
                let slope = (4.0 * fine[i] - coarse[i]) / 3.0;
                // Errors of runs, 1e-11 and for spins 1e-10, over the step.
                assert!((found[i][k + 1] - slope).abs() < 3e-6 * (1.0 + slope.abs()), "{i} {k}: {found:?} {slope}");
            }
        }
    }
}

#[test]
fn what_has_no_derivative_ends_with_the_contact() {
    let [a, b, g] = variables([1.0, 1.0, 9.81]);
    let kernel = Both { g }.kernel().expect("two balls");
    let run = |q: [Three; 2]| {
        let run = ContactRun::new(&kernel).adaptive(1e-10, 1e-10);
        run.run(SVector::from(q), SVector::zeros_of(), Three::zero()..number(0.6))
    };
    let error = run([a, b]).err().expect("one or the other first");
    assert_eq!((error.contact, error.kind), (Some("right"), ContactErrorKind::Together));
    // Together however high.
    let last = run([a, a]).expect("at once").last().expect("an end");
    let (_, [height, _]) = closed_form_until([a, number(0.5), g]);
    for (x, y) in last.q.iter().zip([height; 2]) {
        assert!(parts(*x).into_iter().zip(parts(y)).all(|(x, y)| (x - y).abs() < 1e-11), "{x:?} {y:?}");
    }
    // A wall that is touched, at the turning point.
    let [k, v, zero] = variables([1.0, 1.0, 0.0]);
    let kernel = Impactor { k, d: number(1.0 - 8e-15), e: zero }.kernel().expect("an oscillator");
    let run = ContactRun::new(&kernel).adaptive(1e-13, 1e-13);
    let error = run.run(SVector::from([zero]), SVector::from([-v]), zero..number(3.0)).err().expect("touches");
    assert!(matches!(error.kind, ContactErrorKind::Grazes { .. }) && error.contact == Some("wall"), "{error}");
}

fn closed_form_until([h, e, g]: [Three; 3]) -> (Three, [Three; 2]) {
    let (two, end) = (number::<Three>(2.0), number::<Three>(0.6));
    let (t, v) = ((two * h / g).sqrt(), e * (two * h * g).sqrt());
    (t, [(end - t) * (v - g * (end - t) / two), v - g * (end - t)])
}

#[test]
fn single_precision_runs_too() {
    let kernel = Block { mu: 0.3_f32, e: 0.5, g: 9.81 }.kernel().expect("a block");
    let run = ContactRun::new(&kernel).adaptive(1e-5, 1e-5);
    let run = run.run(SVector::from([0.0, 0.1]), SVector::from([2.0, 0.0]), 0.0..3.0).expect("stops");
    let last = run.last().expect("an end");
    assert_eq!((last.z[0], last.z[1], run.modes(2.9).expect("stands")), (0.0, 0.0, &[Mode::Sticks][..]));
    let kernel = Block { mu: 0.3_f64, e: 0.5, g: 9.81 }.kernel().expect("a block");
    let wide = ContactRun::new(&kernel).adaptive(1e-10, 1e-10);
    let wide = wide.run(SVector::from([0.0, 0.1]), SVector::from([2.0, 0.0]), 0.0..3.0).expect("stops");
    // The tolerance of speeds, three seconds long.
    assert!((f64::from(last.q[0]) - wide.last().expect("an end").q[0]).abs() < 3e-4);
}

/// It leaves where a sin t = g. Friction holds nothing, and its bound is zero there, too.
#[test]
fn what_leaves_has_derivatives() {
    let [a, g, zero] = variables([12.0, 9.81, 0.0]);
    let kernel = Shaken { a, g }.kernel().expect("a table");
    let run = ContactRun::new(&kernel).adaptive(1e-12, 1e-12);
    let run = run.run(SVector::zeros_of(), SVector::from([zero, a]), zero..number(1.5)).expect("leaves");
    let [leaves] = run.events() else { panic!("{:?}", run.events()) };
    assert_eq!(leaves.kind, EventKind::Leaves);
    let wanted = (g / a).asin();
    let (flight, last) = (number::<Three>(1.5) - wanted, run.last().expect("an end"));
    let height = a * wanted.sin() + a * wanted.cos() * flight - g * flight * flight * number(0.5);
    for (x, y) in parts(last.q[1]).into_iter().zip(parts(height)) {
        // Forces are known to 1e-12 of 30 N, over their rate.
        assert!((x - y).abs() < 1e-10, "{x} {y}");
    }
}

/// Rolling: (I/r² + m) ẍ = motor/r − k x − c ẋ, with r the radius.
#[test]
fn a_system_is_linearised_in_its_mode() {
    let (r, k, c) = (0.2, 30.0, 1.5);
    let kernel = Wheel { r: number::<DualNumber<Dual64>>(r), k: number(k), c: number(c), g: number(9.81) };
    let kernel = kernel.kernel().expect("a wheel");
    let vector = |x: [f64; 3]| SVector::from(x.map(number::<DualNumber<Dual64>>));
    let (q, z, motor) =
        (vector([0.1, r, 0.4]), vector([0.3, 0.0, 0.3 / r]), SVector::from([number::<DualNumber<Dual64>>(0.7); 1]));
    let rolls = InMode::new(&kernel, &[Mode::Sticks]);
    let linear: Linearization<f64, 6, 1> = linearize(&rolls, 0.0, &q, &z, &motor);
    let mass = 0.3 / (r * r) + 2.0;
    let off = |found: f64, expected: f64| (found - expected).abs() < 1e-13 * (1.0 + expected.abs());
    assert!(off(linear.rate[3], (0.7 / r - k * 0.1 - c * 0.3) / mass), "{}", linear.rate);
    for (row, part) in [(3, 1.0), (4, 0.0), (5, 1.0 / r)] {
        assert!(off(linear.by_state[(row, 0)], -part * k / mass), "{}", linear.by_state);
        assert!(off(linear.by_state[(row, 3)], -part * c / mass), "{}", linear.by_state);
        assert!([1, 2, 4, 5].into_iter().all(|column| off(linear.by_state[(row, column)], 0.0)), "{}", linear.by_state);
        assert!(off(linear.by_input[row], part / (r * mass)) && linear.by_time[row] == 0.0);
    }
    // Open, it is what the derive writes.
    let (pose, twist) = (place(2.0), [0.3, -0.2, 0.5, 1.0, 2.0, -0.7]);
    let plain = Stone { g: 9.81 }.kernel().expect("a stone");
    let expected = plain.linearize(0.0, &pose, &twist.into(), &SVector::from([0.7]));
    let dual = Stone { g: number::<DualNumber<Dual64>>(9.81) }.kernel().expect("a stone");
    let twist = SVector::from(twist.map(number::<DualNumber<Dual64>>));
    let found: Linearization<f64, 12, 1> =
        linearize(&InMode::new(&dual, &[]), 0.0, &place(number(2.0)), &twist, &motor);
    // Some hundred operations on numbers up to 20.
    assert!((found.by_state - expected.by_state).amax() < 1e-12 && (found.rate - expected.rate).amax() < 1e-12);
    assert!((found.by_input - expected.by_input).amax() < 1e-12);
}

/// A disk on its face, that slides and spins.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, h, angle),
    body(disk, position = [x, y, h], rotation = rotation_z(angle), mass = 0.4, inertia = [0.4, 0.4, 0.2 * r * r]),
    contact(ice, gap = h, slip = [rate(x), rate(y)], spin = rate(angle), friction = mu, drilling = 2 * r / 3),
)]
struct Curling<T> {
    r: T,
    mu: T,
    #[gauss(gravity)]
    g: T,
}

/// A ball that rolls out.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(ball, position = pose.position, rotation = pose.rotation, mass = 0.2, inertia = 0.08 * r * r),
    contact(green, point = ball.position, radius = r, friction = 0.3, drilling = 0.1 * r, rolling = rho),
)]
struct Putt<T> {
    r: T,
    rho: T,
    #[gauss(gravity)]
    g: T,
}

#[test]
fn what_slides_and_spins_has_the_derivatives_of_its_units() {
    // Lengths are as speeds squared over μ g.
    fn way<T: Real>([mu, v, w]: [T; 3]) -> T {
        let kernel = Curling { r: number(0.3), mu, g: number(9.81) }.kernel().expect("a disk");
        let zero = T::zero();
        let run = ContactRun::new(&kernel).adaptive(1e-11, 1e-11).tolerance(1e-9, 1e-9);
        let run = run.run(SVector::from([zero; 4]), SVector::from([v, zero, zero, w]), zero..number(2.0));
        let run = run.expect("stops");
        assert_eq!(run.modes(number(1.9)).expect("inside"), [Mode::Sticks]);
        run.last().expect("an end").q[0]
    }
    let values @ [mu, v, w] = [0.25, 2.0, 7.0];
    let [x, by_mu, by_v, by_w] = parts(way(variables(values)));
    // The slip ends at 1e-9 (1 + 7), far above the errors of steps, so that its end is seen to pass; what is left of
    // the way is less than that squared. Steps of 1e-11, some hundred.
    assert!((by_mu + x / mu).abs() < 1e-8 && (v * by_v + w * by_w - 2.0 * x).abs() < 1e-8, "{x} {by_mu} {by_v} {by_w}");
    // Spin takes friction away from the slip.
    assert!(by_w > 0.01);
}

#[test]
fn what_rolls_out_has_the_derivatives_of_its_closed_form() {
    fn way<T: Real>([rho, v, r]: [T; 3]) -> T {
        let kernel = Putt { r, rho, g: number(9.81) }.kernel().expect("a ball");
        let zero = T::zero();
        let start = place(r);
        let z = SVector::from([v, zero, zero, zero, v / r, zero]);
        let run = ContactRun::new(&kernel).adaptive(1e-11, 1e-11).tolerance(1e-9, 1e-9);
        let run = run.run(start, z, zero..number(3.0)).expect("stops");
        assert_eq!(run.modes(number(2.9)).expect("inside"), [Mode::Sticks; 2]);
        run.last().expect("an end").q.translation.x
    }
    let values @ [rho, v, r] = [0.001, 0.5, 0.03];
    let found = parts(way(variables(values)));
    let x = 0.7 * v * v * r / (rho * 9.81);
    for (found, wanted) in found.into_iter().zip([x, -x / rho, 2.0 * x / v, x / r]) {
        // Some hundred steps of 1e-11 of angular velocities of 17.
        assert!((found - wanted).abs() < 1e-7 * wanted.abs(), "{found} {wanted}");
    }
}

/// A body above flat ground: its gap is a sum of components along its own axes, whose derivatives are rounded.
#[test]
fn a_body_that_turns_bounces_with_derivatives() {
    for tolerance in [1e-5, 1e-6, 1e-8, 1e-9, 1e-10, 1e-12] {
        for (height, turn) in [(0.6, [1.0, 2.0, 0.5]), (1.1, [-3.0, 0.1, 7.0])] {
            let hits = |e: DualNumber<Dual64>| {
                let number = |x: f64| DualNumber(Dual64::from_re(x));
                let kernel = Billiard { r: number(0.1), mu: number(0.3), e, g: number(9.81) }.kernel().expect("a ball");
                let run = ContactRun::new(&kernel).adaptive(tolerance, tolerance);
                let z = SVector::from([0.3, 0.0, 0.0, turn[0], turn[1], turn[2]].map(number));
                let run = run.run(place(number(height)), z, number(0.0)..number(2.0));
                let run = run.unwrap_or_else(|error| panic!("{tolerance} {height}: {error}"));
                let impacts = run.events().iter().filter(|event| matches!(event.kind, EventKind::Impact(_)));
                impacts.map(|event| run.time_of(event)).take(4).collect::<Vec<_>>()
            };
            let found = hits(DualNumber(Dual64::from_re(0.7).derivative()));
            // t₁ = √(2(h − r)/g), then 2 e^n t₁ each.
            let fall = (2.0 * (height - 0.1) / 9.81_f64).sqrt();
            for (n, time) in found.into_iter().enumerate() {
                let powers = (1..=n).map(|k| k as f64 * 0.7_f64.powi(k as i32 - 1));
                let wanted = 2.0 * fall * powers.sum::<f64>();
                assert!((time.eps - wanted).abs() < 1e3 * tolerance + 1e-9, "{n}: {} {wanted}", time.eps);
            }
        }
    }
}
