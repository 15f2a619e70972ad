//! Systems: the reference scenes of pendulums, of a sleigh and a disk, and each with parameters and states spread at
//! random.

use gauss_runtime::prelude::*;
use gauss_tests::trajectory::{numbers, reference};

use crate::common::Bounded;
use crate::common::body::list;
use crate::compare::{Excess, Random, error, holds};
use gauss_tests::double_double::DoubleDouble;

/// A derived system of any scalar, made from a list of parameters.
macro_rules! system {
    ($module:ident, [$($clause:tt)+], { $($(#[$role:meta])* $field:ident),+ }) => {
        mod $module {
            use gauss_runtime::prelude::*;

            #[derive(GaussDynamics)]
            #[gauss($($clause)+)]
            pub struct System<T> { $($(#[$role])* $field: T),+ }

            pub fn kernel<T: Real>(parameters: &[f64]) -> SystemKernel<T> {
                let [$($field),+] = *parameters else { panic!("as many numbers as fields") };
                System { $($field: T::from_f64($field)),+ }.kernel().expect("a system")
            }
        }
    };
}

system!(
    double_pendulum,
    [
        linearize,
        coordinates(a, b),
        particle(mass = m1, position = [l1 * sin(a), 0, -l1 * cos(a)]),
        particle(mass = m2, position = [l1 * sin(a) + l2 * sin(b), 0, -l1 * cos(a) - l2 * cos(b)])
    ],
    { m1, m2, l1, l2, #[gauss(gravity)] g }
);

system!(
    spatial_double_pendulum,
    [
        coordinates(a1, b1, a2, b2),
        particle(mass = m1, position = rotation_x(a1) * rotation_y(b1) * [0, 0, -l1]),
        particle(
            mass = m2,
            position = rotation_x(a1) * rotation_y(b1) * [0, 0, -l1] + rotation_x(a2) * rotation_y(b2) * [0, 0, -l2],
        )
    ],
    { m1, m2, l1, l2, #[gauss(gravity)] g }
);

system!(
    spherical_pendulum,
    [
        coordinates(theta, phi),
        particle(mass = m, position = [l * sin(theta) * cos(phi), l * sin(theta) * sin(phi), -l * cos(theta)])
    ],
    { m, l, #[gauss(gravity)] g }
);

system!(
    bead,
    [
        coordinates(theta),
        particle(mass = 1, position = [
            a * sin(theta) * cos(spin * t), a * sin(theta) * sin(spin * t), -a * cos(theta)
        ])
    ],
    { a, spin, #[gauss(gravity)] g }
);

system!(
    cart_pole,
    [
        coordinates(x, theta),
        particle(mass = cart, position = [x, 0, 0]),
        particle(mass = bob, position = [x + l * sin(theta), 0, -l * cos(theta)])
    ],
    { cart, bob, l, #[gauss(gravity)] g }
);

system!(
    foucault,
    [
        coordinates(x, y),
        frame(earth, rotation = rotation_z(turn * t) * rotation_x(tilt)),
        particle(mass = m, parent = earth, position = [x, y, -sqrt(l * l - x * x - y * y)]),
        potential = -m * g * sqrt(l * l - x * x - y * y)
    ],
    { m, l, g, turn, tilt }
);

system!(
    rods,
    [
        coordinates(x1, z1, x2, z2),
        particle(mass = m1, position = [x1, 0, z1]),
        particle(mass = m2, position = [x2, 0, z2]),
        constraint(position = x1.powi(2) + z1.powi(2) - l1 * l1),
        constraint(position = (x2 - x1).powi(2) + (z2 - z1).powi(2) - l2 * l2)
    ],
    { m1, m2, l1, l2, #[gauss(gravity)] g }
);

system!(
    sleigh,
    [
        coordinates(x, y, theta),
        speeds(v, omega),
        kinematics(x = v * cos(theta), y = v * sin(theta), theta = omega),
        body(position = [x, y, 0], rotation = rotation_z(theta)),
        mass = m,
        center_of_mass = [a, 0, 0],
        inertia = [j, j + m * a * a, j + m * a * a]
    ],
    { m, a, j }
);

system!(
    disk,
    [
        coordinates(x, y, phi, theta, psi),
        speeds(w1, w2, w3),
        kinematics(
            x = r * (w1 * sin(theta) * sin(phi) - w3 * cos(phi)),
            y = -r * (w1 * sin(theta) * cos(phi) + w3 * sin(phi)),
            phi = w2 / sin(theta),
            theta = w1,
            psi = w3 - w2 / tan(theta),
        ),
        body(position = [x, y, r * sin(theta)], rotation = rotation_z(phi) * rotation_x(theta) * rotation_z(psi)),
        mass = m,
        inertia = [j, j, 2 * j]
    ],
    { m, j, r, #[gauss(gravity)] g }
);

// What loses every digit in floating point: the polynomial is multiplied out.
system!(bowl, [coordinates(x), particle(mass = 1, position = [x, (x - c).powi(4), 0])], { c });

/// Functions of every kind and forces with kinks and jumps.
mod wire {
    use gauss_runtime::prelude::*;

    #[derive(GaussDynamics)]
    #[gauss(
        coordinates(s),
        particle(mass = m, position = [ln(2 + s.powi(2)), sqrt(1 + s * s), 0.5 * exp(-s)]),
        potential = k * (tan(0.3 * s) + exp(0.2 * s) / sqrt(2 + sin(s)) - ln(3 + cos(s))),
        drive(s = -k * abs(rate(s)) * rate(s) + min(k * s, 1) - max(s, 0.1) - m * signum(rate(s)))
    )]
    pub struct System<T> {
        m: T,
        k: T,
    }

    pub fn kernel<T: Real>(p: &[f64]) -> SystemKernel<T> {
        System { m: T::from_f64(p[0]), k: T::from_f64(p[1]) }.kernel().expect("a system")
    }
}

fn published(name: &str, keys: &[&str]) -> Vec<f64> {
    keys.iter().flat_map(|key| numbers(&reference(name)["parameters"][key])).collect()
}

fn started(name: &str) -> (Vec<f64>, Vec<f64>) {
    let start = &reference(name)["initial"];
    (numbers(&start["q"]), numbers(&start["z"]))
}

/// A scene as published, and `count` scenes whose numbers are each multiplied by a random power of ten and whose states
/// are drawn: angles of some turns, often near multiples of a quarter turn; fast and slow.
macro_rules! explore {
    ($module:ident, $name:expr, $parameters:expr, $state:expr, $step:expr, $count:literal, $decades:literal) => {{
        let (parameters, (q, z)): (Vec<f64>, (Vec<f64>, Vec<f64>)) = ($parameters, $state);
        let what = $name;
        let mut excess = Excess::default();
        let check = |parameters: &[f64], q: &[f64], z: &[f64], step: Option<f64>, excess: &mut Excess| {
            let kernels = (
                &$module::kernel::<f64>(parameters),
                &$module::kernel::<Bounded>(parameters),
                &$module::kernel::<DoubleDouble>(parameters),
            );
            holds(what, kernels, (q, z), step, excess);
        };
        check(&parameters, &q, &z, $step, &mut excess);
        assert!(excess.report(&format!("{what}, as published")) < 1e4);
        let (mut excess, mut random) = (Excess::default(), Random(11));
        let count: u32 = $count;
        for _ in 0..count {
            let parameters: Vec<_> = parameters.iter().map(|p| p * random.decades(-$decades, $decades)).collect();
            let mut angle = |_: &f64| {
                let near = f64::from(random.below(9) as u32) - 4.0;
                match random.below(3) {
                    0 => near * std::f64::consts::FRAC_PI_2 + random.next() * random.decades(-9.0, -2.0),
                    1 => 20.0 * random.next(),
                    _ => random.next(),
                }
            };
            let q: Vec<_> = q.iter().map(&mut angle).collect();
            let z: Vec<_> = z.iter().map(|_| random.next() * random.decades(-2.0, 2.0)).collect();
            check(&parameters, &q, &z, None, &mut excess);
        }
        excess.report(&format!("{what}, spread"));
    }};
}

#[test]
fn pendulums() {
    let name = "double_pendulum";
    let start = (published(name, &["theta"]), published(name, &["thetadot"]));
    explore!(double_pendulum, name, published(name, &["m1", "m2", "l1", "l2", "g"]), start, Some(0.01), 500, 3.0);
    let name = "spatial_double_pendulum";
    let parameters = published(name, &["m1", "m2", "l1", "l2", "g"]);
    explore!(spatial_double_pendulum, name, parameters, started(name), Some(0.01), 300, 3.0);
    let (name, start) = ("spherical_pendulum", (vec![0.6_f64.atan2(0.8), 0.0], vec![1.0 / 1.3, 1.1 / 0.78]));
    explore!(spherical_pendulum, name, vec![1.0, 1.3, 9.81], start, Some(0.01), 500, 3.0);
    let (name, start) = ("bead_rotating_hoop", (vec![0.3], vec![0.4]));
    explore!(bead, name, vec![0.8, 5.0, 9.81], start, Some(0.01), 500, 2.0);
    let name = "cart_pole";
    explore!(cart_pole, name, published(name, &["cart", "bob", "l", "g"]), started(name), Some(0.01), 500, 3.0);
    let (name, parameters) = ("foucault_pendulum", vec![0.7, 1.2, 9.81, 0.3, std::f64::consts::FRAC_PI_2 - 0.85]);
    explore!(foucault, name, parameters, started(name), Some(0.01), 300, 0.0);
    let name = "foucault_precession";
    let parameters = vec![28.0, 67.0, 9.81, 0.000_072_921_15, std::f64::consts::FRAC_PI_2 - 0.8526];
    explore!(foucault, name, parameters, started(name), Some(0.01), 0, 0.0);
}

#[test]
fn constraints_and_rolling() {
    // On the constraints: 3-4-5 and its half.
    let start = (vec![0.6, -0.8, 1.0, -1.1], vec![0.8, 0.6, 0.8, 0.6]);
    explore!(rods, "rods", vec![1.0, 0.7, 1.0, 0.5, 9.81], start, Some(0.01), 500, 0.5);
    let (name, start) = ("chaplygin_sleigh", (vec![0.0, 0.0, 0.25], vec![0.4, 1.5]));
    explore!(sleigh, name, vec![1.2, 0.3, 0.5], start, Some(0.01), 500, 3.0);
    let (name, start) = ("rolling_disk_falling", (vec![0.0, 0.0, 0.0, 0.28_f64.acos(), 0.0], vec![0.3, 0.5, -6.0]));
    explore!(disk, name, vec![1.0, 0.0625, 0.5, 9.81], start, Some(0.01), 500, 2.0);
}

#[test]
fn functions_kinks_and_cancellation() {
    explore!(wire, "wire", vec![1.4, 2.0], (vec![0.7], vec![1.3]), Some(0.01), 1000, 1.0);
    explore!(bowl, "bowl", vec![1000.0], (vec![1000.3], vec![1.3]), None, 300, 0.0);
    // What is known of x − 1000 = 0.3 after it was multiplied out: no digit is right, and the bound says so.
    let state = (SVector::from([1000.3]), SVector::from([1.3]));
    let (q, z) = (gauss_bounded::exact(&state.0), gauss_bounded::exact(&state.1));
    let found = bowl::kernel::<Bounded>(&[1000.0]).acceleration(Bounded::zero(), &q, &z, &())[0];
    let lift = |v: &SVector<f64, 1>| SVector::from([DoubleDouble::new(v[0])]);
    let exact = bowl::kernel::<DoubleDouble>(&[1000.0]);
    let exact = exact.acceleration(DoubleDouble::zero(), &lift(&state.0), &lift(&state.1), &())[0];
    assert!(error(found.value, exact) <= found.bound);
}

/// Derivatives by the state.
#[test]
fn linearisations() {
    let (mut random, mut excess) = (Random(13), Excess::default());
    for _ in 0..500 {
        let parameters: Vec<f64> = [1.0, 0.7, 1.0, 0.6, 9.81].iter().map(|p| p * random.decades(-2.0, 2.0)).collect();
        let mut draw = || SVector::from([3.0 * random.next(), 3.0 * random.next()]);
        let (q, z): (SVector<f64, 2>, SVector<f64, 2>) = (draw(), draw());
        fn derivatives<T: Real>(parameters: &[f64], q: &SVector<f64, 2>, z: &SVector<f64, 2>) -> Vec<T> {
            let lift = |v: &SVector<f64, 2>| SVector::from([T::from_f64(v[0]), T::from_f64(v[1])]);
            let linear = double_pendulum::kernel::<T>(parameters).linearize(T::zero(), &lift(q), &lift(z), &());
            let entries = (0..16).map(|k| linear.by_state.data.0[k / 4][k % 4]);
            entries.chain(list(&linear.rate)).collect()
        }
        excess.check("linearize", &derivatives(&parameters, &q, &z), &derivatives(&parameters, &q, &z));
    }
    assert!(excess.report("linearize") < 1e3);
}
