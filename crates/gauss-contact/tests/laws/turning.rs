//! Friction of drilling and rolling resistance.

use gauss_contact::{ContactError, ContactRun, ContactSteps, ContactTrajectory, EventKind, Impact, Mode};
use gauss_runtime::prelude::*;

/// A homogeneous ball on a plane that may lean along the first axis.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(ball, position = pose.position, rotation = pose.rotation, mass = m, inertia = 0.4 * m * r * r),
    potential = -m * g * lean * pose.position.x,
    contact(table, point = ball.position, radius = r, friction = mu, drilling = patch, rolling = rho,
        restitution = e),
)]
pub struct Ball {
    pub m: f64,
    pub r: f64,
    pub mu: f64,
    pub patch: f64,
    pub rho: f64,
    pub e: f64,
    pub lean: f64,
    #[gauss(gravity)]
    pub g: f64,
}

const BALL: Ball = Ball { m: 0.17, r: 0.03, mu: 0.2, patch: 0.004, rho: 0.0006, e: 0.0, lean: 0.0, g: 9.81 };

type Made<'k> = ContactTrajectory<'k, BallKernel>;

/// A run from the table on at a velocity and an angular velocity along the observer's axes.
fn roll(kernel: &BallKernel, [v, w]: [[f64; 3]; 2], until: f64) -> Result<Made<'_>, ContactError> {
    let start = Isometry3::translation(0.0, 0.0, BALL.r);
    let z = SVector::from([v[0], v[1], v[2], w[0], w[1], w[2]]);
    ContactRun::new(kernel).adaptive(1e-11, 1e-11).run(start, z, 0.0..until)
}

fn stops<'a>(run: &'a Made<'_>, contact: usize) -> Vec<&'a gauss_contact::ContactEvent> {
    run.events().iter().filter(|event| event.contact == contact && event.kind == EventKind::Sticks).collect()
}

/// Energies do not grow from sample to sample by more than steps err: 1e-11 of their terms, a hundred roundings of
/// them.
#[track_caller]
fn loses_energy<K: gauss_runtime::contact::ContactSystem<Scalar = f64>>(kernel: &K, run: &ContactTrajectory<'_, K>) {
    let energies: Vec<f64> = run.iter().map(|s| kernel.energy(s.t, &s.q, &s.z)).collect();
    let most = energies.iter().fold(0.0_f64, |most, e| most.max(e.abs()));
    for pair in energies.windows(2) {
        assert!(pair[1] <= pair[0] + 1e-10 * most, "{pair:?}");
    }
}

#[test]
fn rows_follow_tangents_and_rolling_follows_its_contact() {
    let [table, rolling] = BallKernel::CONTACTS else { panic!("two contacts") };
    assert_eq!((table.name, table.rows(), table.tangent_rows(), table.friction_rows()), ("table", 0..4, 1..3, 1..4));
    assert_eq!((rolling.name, rolling.rows(), rolling.rolls_on()), ("table_rolling", 4..6, Some(0)));
    let kernel = BALL.kernel().unwrap();
    let z = SVector::from([1.0, 2.0, 3.0, 5.0, 7.0, 11.0]);
    let rates = kernel.contact_rates(0.0, &Isometry3::translation(0.0, 0.0, 1.0), &z);
    let r = BALL.r;
    let wanted = [3.0, 1.0 - 7.0 * r, 2.0 + 5.0 * r, 11.0 * BALL.patch, 5.0, 7.0];
    assert!((rates - SVector::from(wanted)).amax() < 1e-14, "{rates}");
    let friction = kernel.friction(0.0, &Isometry3::translation(0.0, 0.0, 1.0), &z, &());
    assert_eq!(friction, SVector::from([0.0, BALL.mu, BALL.mu, BALL.mu, BALL.rho, BALL.rho]));
}

#[test]
fn a_ball_that_spins_on_its_place_stops_when_drilling_has_taken_its_momentum() {
    let kernel = BALL.kernel().unwrap();
    let spin = 20.0;
    let stop = 0.4 * BALL.r * BALL.r * spin / (BALL.mu * BALL.patch * BALL.g);
    let run = roll(&kernel, [[0.0; 3], [0.0, 0.0, spin]], 1.1 * stop).unwrap();
    let [stopped] = stops(&run, 0)[..] else { panic!("{:?}", run.events()) };
    // A slip of several rows ends at 1e-11 (1 + 20): at this deceleration of the row as much time too early.
    let early = 2.2e-10 / (BALL.patch * spin / stop);
    assert!((stopped.time - stop).abs() < early + 1e-10 * stop, "{:e}", stopped.time - stop);
    let half = run.at(0.5 * stop).unwrap();
    assert!((half.z[5] - 0.5 * spin).abs() < 1e-9 * spin);
    assert_eq!(run.last().unwrap().z.amax(), 0.0);
    loses_energy(&kernel, &run);
}

#[test]
fn a_ball_that_rolls_is_slowed_down_and_stops() {
    let kernel = BALL.kernel().unwrap();
    let v = 0.5;
    let deceleration = 5.0 / 7.0 * BALL.rho / BALL.r * BALL.g;
    let stop = v / deceleration;
    let along = [0.6, -0.8];
    let (x, y) = (v * along[0], v * along[1]);
    let run = roll(&kernel, [[x, y, 0.0], [-y / BALL.r, x / BALL.r, 0.0]], 1.1 * stop).unwrap();
    let [stopped] = stops(&run, 1)[..] else { panic!("{:?}", run.events()) };
    // It ends at an angular velocity of 1e-11 (1 + v/r).
    let early = 2e-10 * BALL.r / deceleration;
    assert!((stopped.time - stop).abs() < early + 1e-10 * stop, "{:e}", stopped.time - stop);
    let half = run.at(0.5 * stop).unwrap();
    assert!(half.q.rotation.angle() > 1.0, "the axes of the body have turned");
    // No slip: that of material points is zero all the time.
    for sample in run.iter() {
        let rates = kernel.contact_rates(sample.t, &sample.q, &sample.z);
        assert!(rates.fixed_rows::<3>(1).amax() < 1e-14, "{rates}");
    }
    let end = run.last().unwrap();
    assert_eq!((end.z.amax(), run.modes(1.05 * stop).unwrap()), (0.0, &[Mode::Sticks, Mode::Sticks][..]));
    let path = v * v / (2.0 * deceleration);
    assert!(
        (end.q.translation.x - path * along[0]).abs() < 1e-9 && (end.q.translation.y - path * along[1]).abs() < 1e-9
    );
    loses_energy(&kernel, &run);
}

#[test]
fn a_ball_on_an_incline_rests_below_the_angle_of_rolling_resistance() {
    let slope = BALL.rho / BALL.r;
    let at_rest = [[0.0; 3]; 2];
    let kernel = Ball { lean: 0.999 * slope, ..BALL }.kernel().unwrap();
    let run = roll(&kernel, at_rest, 1.0).unwrap();
    assert!(run.events().is_empty() && run.last().unwrap().q.translation.x == 0.0, "{:?}", run.events());
    let forces = *run.forces(0.5).unwrap();
    let weight = BALL.m * BALL.g;
    assert!((forces[1] + 0.999 * slope * weight).abs() < 1e-14, "{forces}");
    assert!((forces[5] + 0.999 * BALL.rho * weight).abs() < 1e-15, "{forces}");
    // Above it rolls: 5/7 of what is left.
    let kernel = Ball { lean: 1.5 * slope, ..BALL }.kernel().unwrap();
    let run = roll(&kernel, at_rest, 1.0).unwrap();
    let wanted = 5.0 / 7.0 * 0.5 * slope * BALL.g;
    assert!((run.last().unwrap().z.fixed_rows::<3>(0).norm() - wanted).abs() < 1e-9 * wanted);
    assert!(matches!(run.modes(0.5).unwrap(), [Mode::Sticks, Mode::Slides([0.0, 1.0, 0.0])]));
}

/// A disk on its face: three coordinates, and a contact of its own.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, h, angle),
    body(disk, position = [x, y, h], rotation = rotation_z(angle), mass = m, inertia = [m, m, m * r * r / 2]),
    contact(ice, gap = h, slip = [rate(x), rate(y)], spin = rate(angle), friction = mu, drilling = 2 * r / 3),
)]
struct Disk {
    m: f64,
    r: f64,
    mu: f64,
    #[gauss(gravity)]
    g: f64,
}

#[test]
fn a_disk_that_slides_and_spins_goes_straight_and_stops_with_both_at_once() {
    // With w = ℓω and n = |(v, w)|: v̇ = −μ g v/n, ẇ = −μ g k w/n, k = m ℓ²/I = 8/9. So v w^(−1/k) stays.
    let disk = Disk { m: 0.4, r: 0.3, mu: 0.25, g: 9.81 };
    let kernel = disk.kernel().unwrap();
    let (radius, k) = (2.0 * disk.r / 3.0, 8.0 / 9.0);
    let (v, w) = ([0.8, -0.6].map(|part| 2.0 * part), 1.5);
    let run = ContactRun::new(&kernel).adaptive(1e-11, 1e-11);
    let z = SVector::from([v[0], v[1], 0.0, w / radius]);
    let run = run.run(SVector::zeros(), z, 0.0..2.0).unwrap();
    let constant = |z: &SVector<f64, 4>| z[0].hypot(z[1]) * (radius * z[3]).powf(-1.0 / k);
    let [stopped] = run.events() else { panic!("{:?}", run.events()) };
    assert_eq!(stopped.kind, EventKind::Sticks);
    for part in [0.2, 0.5, 0.9, 0.99] {
        let state = run.at(part * stopped.time).unwrap();
        // Errors of 1e-11 at each of some hundred steps, over what is left of the speed.
        let left = 1e-9 / (1.0 - part);
        assert!((constant(&state.z) / constant(&z) - 1.0).abs() < left, "{part}");
        assert!((state.z[1] / state.z[0] + 0.75).abs() < left);
        let forces = *run.forces(part * stopped.time).unwrap();
        let size = forces.fixed_rows::<3>(1).norm();
        assert!((size - disk.mu * disk.m * disk.g).abs() < 1e-12, "{forces}");
    }
    // Time by the first integral: v = v₀ s, w = w₀ s^k, dt = −n ds/(μ g s): ∫ √(v₀² + w₀² s^(2k−2)) ds/(μ g), whose
    // integrand is that of s = u⁹: s^(−2/9) ds = 9 u⁶ du, smooth. Simpson's rule.
    let integrand = |u: f64| 9.0 * u.powi(8) * (4.0 + w * w * u.powi(-2)).sqrt();
    let n = 2000;
    let node = |i: i32| if i == 0 { 0.0 } else { integrand(f64::from(i) / f64::from(n)) };
    let sum: f64 = (0..=n).map(|i| node(i) * if i == 0 || i == n { 1.0 } else { f64::from(2 + 2 * (i % 2)) }).sum();
    let wanted = sum / (3.0 * f64::from(n)) / (disk.mu * disk.g);
    assert!((stopped.time - wanted).abs() < 1e-8, "{} {wanted}", stopped.time);
    loses_energy(&kernel, &run);
}

#[test]
fn what_spins_slips_under_any_load() {
    // Friction along a slip s that is small beside the spin w = ℓω is μ m g s/w. With ṡ = g α − 7/2 μ g s/w, and
    // ẇ = −k μ g where k = 5/2 (ℓ/r)², s = c w with c = α/(μ (7/2 − k)).
    let ball = Ball { lean: 0.01, rho: 0.0, ..BALL };
    let kernel = ball.kernel().unwrap();
    let run = roll(&kernel, [[0.0; 3], [0.0, 0.0, 100.0]], 0.5).unwrap();
    let state = run.last().unwrap();
    let rates = kernel.contact_rates(state.t, &state.q, &state.z);
    let k = 2.5 * (ball.patch / ball.r).powi(2);
    let wanted = ball.lean / (ball.mu * (3.5 - k)) * rates[3];
    // Left out are (s/w)² = 2·10⁻⁴, and of the start, with s = 0, (w/w₀)^(7/(2k)) = 10⁻⁴.
    assert!((rates[1] / wanted - 1.0).abs() < 5e-4, "{rates} {wanted}");
    // Without spin it rolls without slip.
    let run = roll(&kernel, [[0.0; 3]; 2], 0.5).unwrap();
    let state = run.last().unwrap();
    assert!(kernel.contact_rates(state.t, &state.q, &state.z)[1].abs() < 1e-15);
}

#[test]
fn impacts_stop_spin_and_roll_by_the_impulse_of_the_normal() {
    for law in [Impact::Newton, Impact::Moreau, Impact::Poisson, Impact::Sequential] {
        let kernel = Ball { e: 0.5, ..BALL }.kernel().unwrap();
        let (down, spin, roll) = (2.0, 30.0, 40.0);
        let start = Isometry3::translation(0.0, 0.0, BALL.r);
        // It rolls about y without slip.
        let z = SVector::from([roll * BALL.r, 0.0, -down, 0.0, roll, spin]);
        let run = ContactRun::new(&kernel).adaptive(1e-10, 1e-10).law(law).run(start, z, 0.0..1e-6).unwrap();
        let hits = run.events().iter().filter_map(|event| match event.kind {
            EventKind::Impact(hit) => Some((event.contact, hit)),
            _ => None,
        });
        let [(0, table), (1, rolling)] = hits.collect::<Vec<_>>()[..] else { panic!("{law:?} {:?}", run.events()) };
        let normal = 1.5 * BALL.m * down;
        assert!((table.impulse[0] - normal).abs() < 1e-13, "{law:?} {table:?}");
        // The sphere of friction is used up; by Poisson's law in two directions, which differ by 10⁻² rad.
        let size = table.impulse[1..].iter().map(|x| x * x).sum::<f64>().sqrt();
        let lost = if law == Impact::Poisson { 1e-5 } else { 1e-12 };
        assert!((0.0..lost).contains(&(1.0 + 1e-14 - size / (BALL.mu * normal))), "{law:?} {table:?}");
        let turned = rolling.impulse[1].hypot(rolling.impulse[2]);
        assert!((turned - BALL.rho * normal).abs() < 1e-13 && rolling.impulse[0] == 0.0, "{law:?} {rolling:?}");
        assert!(rolling.impulse[2] < 0.0 && table.impulse[3] < 0.0);
        let (before, after) = (kernel.energy(0.0, &start, &z), run.last().unwrap());
        let lost = before - kernel.energy(after.t, &after.q, &after.z);
        assert!((lost - table.energy_lost - rolling.energy_lost).abs() < 1e-5 * lost, "{law:?}");
    }
}

#[test]
fn balls_that_are_thrown_lose_energy_and_come_to_rest() {
    let mut number = crate::common::numbers(5);
    for n in 0..12 {
        let law = [Impact::Newton, Impact::Moreau, Impact::Poisson][n % 3];
        let ball = Ball { e: [0.0, 0.4][n % 2], rho: 0.003, patch: 0.02, ..BALL };
        let kernel = ball.kernel().unwrap();
        let start = Isometry3::translation(0.0, 0.0, BALL.r + 0.02 * (1.0 + number()));
        let z = SVector::from([number(), number(), number(), 20.0 * number(), 20.0 * number(), 20.0 * number()]);
        let run = ContactRun::new(&kernel).adaptive(1e-9, 1e-9).law(law).run(start, z, 0.0..8.0);
        let run = run.unwrap_or_else(|error| panic!("{n} {error}"));
        let energies: Vec<f64> = run.iter().map(|s| kernel.energy(s.t, &s.q, &s.z)).collect();
        // Steps err by 1e-9 of speeds below 3.
        assert!(energies.windows(2).all(|pair| pair[1] <= pair[0] + 1e-8), "{n}");
        let end = run.last().unwrap();
        assert_eq!((end.z.amax(), run.modes(8.0).unwrap()), (0.0, &[Mode::Sticks, Mode::Sticks][..]), "{n}");
        // Residuals of all solutions are those of rounding.
        for residual in run.solves().iter().flat_map(|solve| &solve.residuals) {
            let (_, residual) = residual;
            let worst = residual.signorini.max(residual.coulomb).max(residual.dissipation);
            assert!(worst <= residual.rounding, "{n} {residual:?}");
        }
    }
}

/// Friction of a round patch under a pressure that is the same all over, or Hertz', by the definition: each point of it
/// rubs against its own slip (P. Contensou 1963). Force along the slip and torque, over μ λ_N and μ λ_N R, of a slip
/// v e₁ with a spin ω of cos φ, sin φ = v, ωR.
fn contensou(phi: f64, hertz: bool) -> [f64; 2] {
    let (v, w) = (phi.cos(), phi.sin());
    let (rings, parts) = (200, 400);
    let mut sum = [0.0; 2];
    for k in 0..rings {
        // Middle points in ρ = R sin χ, so that Hertz' pressure 3/2 cos χ is smooth; all pressures add up to 1.
        let chi = (f64::from(k) + 0.5) * std::f64::consts::FRAC_PI_2 / f64::from(rings);
        let rho = chi.sin();
        let pressure = if hertz { 1.5 * chi.cos() } else { 1.0 };
        let ring = 2.0 * pressure * rho * chi.cos() * std::f64::consts::FRAC_PI_2 / f64::from(rings);
        for n in 0..parts {
            let angle = (f64::from(n) + 0.5) * std::f64::consts::TAU / f64::from(parts);
            let slip = [v - w * rho * angle.sin(), w * rho * angle.cos()];
            let part = ring / f64::from(parts) / slip[0].hypot(slip[1]);
            sum[0] += part * slip[0];
            sum[1] += part * rho * (angle.cos() * slip[1] - angle.sin() * slip[0]);
        }
    }
    sum
}

/// The ellipsoid has the exact law's force without spin, and its torque without slip. Between them it is larger.
#[test]
fn the_ellipsoid_is_as_near_to_contensous_law_as_the_guide_says() {
    let pi = std::f64::consts::PI;
    for (hertz, radius, wanted) in
        [(false, 2.0 / 3.0, [0.123, 0.151, 0.934]), (true, 3.0 * pi / 16.0, [0.111, 0.140, 0.940])]
    {
        let [_, most] = contensou(pi / 2.0, hertz);
        assert!((most - radius).abs() < 1e-4 && (contensou(0.0, hertz)[0] - 1.0).abs() < 1e-4, "{most}");
        let mut worst = [0.0_f64; 2];
        let mut least = 1.0_f64;
        for k in 1..100 {
            let phi = f64::from(k) * pi / 200.0;
            let (v, w) = (phi.cos(), radius * phi.sin());
            let [f, m] = contensou(phi, hertz);
            let ellipsoid = [v / v.hypot(w), w / v.hypot(w)];
            worst[0] = worst[0].max((ellipsoid[0] - f).abs());
            worst[1] = worst[1].max((ellipsoid[1] - m / radius).abs());
            least = least.min(f.hypot(m / radius));
            assert!(f.hypot(m / radius) < 1.0 + 1e-4);
        }
        // (own) of 100 directions, with sums of 80 000 parts.
        for (found, wanted) in [worst[0], worst[1], least].into_iter().zip(wanted) {
            assert!((found - wanted).abs() < 6e-4, "{worst:?} {least}");
        }
    }
}

#[test]
fn steps_have_the_friction_of_drilling_and_rolling() {
    let kernel = BALL.kernel().unwrap();
    let start = Isometry3::translation(0.0, 0.0, BALL.r);
    // A spin alone falls at μ l m g/I, in every step; the step in which it stops ends at zero.
    let (h, spin) = (1e-3, 20.0);
    let slower = BALL.mu * BALL.patch * BALL.g / (0.4 * BALL.r * BALL.r);
    let z = SVector::from([0.0, 0.0, 0.0, 0.0, 0.0, spin]);
    let run = ContactSteps::new(&kernel, h).run(start, z, 0.0..1.5 * spin / slower).unwrap();
    for step in run.iter().take_while(|step| step.state.t < spin / slower - 2.0 * h) {
        // Rounding of some thousand steps.
        assert!((step.state.z[5] - (spin - slower * step.state.t)).abs() < 1e-11 * spin, "{}", step.state.z);
    }
    assert_eq!(run.last().unwrap().state.z, SVector::<f64, 6>::zeros());
    // A ball that rolls falls at 5/7 ρ/r g, and does not slip.
    let (v, slower) = (1.0, 5.0 / 7.0 * BALL.rho / BALL.r * BALL.g);
    let z = SVector::from([v, 0.0, 0.0, 0.0, v / BALL.r, 0.0]);
    let run = ContactSteps::new(&kernel, h).run(start, z, 0.0..1.2 * v / slower).unwrap();
    for step in run.iter().take_while(|step| step.state.t < v / slower - 2.0 * h) {
        let speed = step.state.z.fixed_rows::<3>(0).norm();
        // Speeds along axes that turn with the ball: of second order in the angle of a step.
        let turn = h * v / BALL.r;
        assert!((speed - (v - slower * step.state.t)).abs() < turn * turn * v, "{speed} {}", step.state.t);
        assert_eq!(step.modes[0], Mode::Sticks);
    }
    let end = run.last().unwrap();
    assert!(end.state.z.amax() < 1e-15, "{}", end.state.z);
    let (way, turn) = (v * v / (2.0 * slower), h * v / BALL.r);
    assert!((end.state.q.translation.x - way).abs() < turn * turn * way, "{}", end.state.q.translation.x - way);
}
