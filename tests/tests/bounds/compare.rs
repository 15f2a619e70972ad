//! Bounds against errors.

use gauss_runtime::integrate::{Control, Fixed};
use gauss_runtime::prelude::*;
use gauss_tests::double_double::DoubleDouble;

use crate::common::Bounded;
use crate::common::body::{list, speeds};

/// Numbers between −1 and 1, the same in every run (a linear congruence of 64 bits; Knuth).
pub struct Random(pub u64);

impl Random {
    /// The next number.
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// A number of 0 … n − 1.
    pub fn below(&mut self, n: usize) -> usize {
        (0.5 * (self.next() + 1.0) * n as f64) as usize % n
    }

    /// 10 to a power between those.
    pub fn decades(&mut self, least: f64, most: f64) -> f64 {
        10.0_f64.powf(0.5 * ((most - least) * self.next() + most + least))
    }
}

/// |value − exact|.
pub fn error(value: f64, exact: DoubleDouble) -> f64 {
    Real::abs(exact - DoubleDouble::new(value)).lane(0)
}

/// What bounds exceed errors by.
#[derive(Default)]
pub struct Excess {
    ratios: Vec<f64>,
    digits: Vec<f64>,
    exact: usize,
}

impl Excess {
    /// Asserts that every bound holds, and notes by how much it exceeds the error.
    ///
    /// The truth is off itself, by 2⁻¹⁰⁴ where the numbers are by 2⁻⁵³: a part in 10¹⁵ of the bound, for which one in
    /// 10¹² is allowed.
    pub fn check(&mut self, what: &str, found: &[Bounded], exact: &[DoubleDouble]) {
        assert_eq!(found.len(), exact.len());
        for (i, (found, exact)) in found.iter().zip(exact).enumerate() {
            assert!(found.bound >= 0.0, "{what}: {found:?}");
            if !(found.value.is_finite() && exact.is_finite()) {
                continue;
            }
            let error = error(found.value, *exact);
            assert!(error <= found.bound * (1.0 + 1e-12), "{what}, component {i}: {found:?} is off by {error:e}");
            self.digits.push(found.digits());
            if error == 0.0 {
                self.exact += 1;
            } else if found.bound.is_finite() {
                self.ratios.push(found.bound / error);
            }
        }
    }

    /// Median and 90th percentile of bound over error; prints them.
    pub fn report(mut self, what: &str) -> f64 {
        let sorted = |list: &mut Vec<f64>| list.sort_by(f64::total_cmp);
        sorted(&mut self.ratios);
        sorted(&mut self.digits);
        let at = |list: &[f64], part: f64| list.get((part * list.len() as f64) as usize).copied().unwrap_or(f64::NAN);
        println!(
            "{what}: {} numbers; bound/error median {:.1}, 90 % {:.1}, least {:.2}; {} without error; \
             digits median {:.1}, 1 % {:.1}",
            self.digits.len(),
            at(&self.ratios, 0.5),
            at(&self.ratios, 0.9),
            at(&self.ratios, 0.0),
            self.exact,
            at(&self.digits, 0.5),
            at(&self.digits, 0.01),
        );
        at(&self.ratios, 0.5)
    }
}

/// A kernel without inputs: its states can be put together from numbers.
pub trait Any<T: Real>: GaussSystem<Scalar = T, Input = ()> {}
impl<T: Real, K: GaussSystem<Scalar = T, Input = ()>> Any<T> for K {}

/// A configuration by its components, and speeds.
fn state<T: Real, K: Any<T>>(_: &K, q: &[f64], z: &[f64]) -> (K::Configuration, K::Speeds) {
    let all = |numbers: &[f64]| numbers.iter().map(|&x| T::from_f64(x)).collect::<Vec<_>>();
    (K::Configuration::from_components(&speeds(&all(q))), speeds(&all(z)))
}

/// The components of the configuration to which an increment leads whose components are drawn.
pub fn moved<K: Any<f64>>(kernel: &K, q: &[f64], mut draw: impl FnMut() -> f64) -> Vec<f64> {
    let (q, _) = state(kernel, q, &[]);
    let mut increment = <K::Configuration as Configuration>::Tangent::zero();
    for i in 0..<K::Configuration as Configuration>::Tangent::DIM {
        increment.set_component(i, draw());
    }
    list(&q.retract(&increment).components())
}

/// Everything that a kernel computes at a state.
fn outputs<T: Real, K: Any<T>>(kernel: &K, q: &[f64], z: &[f64]) -> Vec<(&'static str, Vec<T>)> {
    let (t, (q, z)) = (T::ratio(1, 4), state::<T, K>(kernel, q, z));
    let p = kernel.momentum(t, &q, &z);
    vec![
        ("acceleration", list(&kernel.acceleration(t, &q, &z, &()))),
        ("energy", vec![kernel.kinetic_energy(t, &q, &z), kernel.energy(t, &q, &z)]),
        ("kinematics", list(&kernel.kinematics(t, &q, &z))),
        ("momentum rate", list(&kernel.momentum_rate(t, &q, &p, &()))),
        ("velocity", list(&kernel.velocity(t, &q, &p))),
        ("momentum", list(&p)),
        ("residual", list(&kernel.gauss_residual(t, &q, &z, &z, &()))),
    ]
}

/// All outputs at a state.
fn outputs_hold<B: Any<Bounded>, D: Any<DoubleDouble>>(
    what: &str,
    (bounded, wide): (&B, &D),
    (q, z): (&[f64], &[f64]),
    excess: &mut Excess,
) {
    for ((name, found), (_, exact)) in outputs(bounded, q, z).iter().zip(outputs(wide, q, z)) {
        excess.check(&format!("{what}: {name}"), found, &exact);
    }
}

/// Bit by bit: bounds never decide what is computed.
fn values_are_those_of_the_plain_scalar<K: Any<f64>, B: Any<Bounded>>(
    what: &str,
    (plain, bounded): (&K, &B),
    (q, z): (&[f64], &[f64]),
) {
    for ((name, plain), (_, bounded)) in outputs(plain, q, z).iter().zip(outputs(bounded, q, z)) {
        for (plain, bounded) in plain.iter().zip(bounded) {
            let same = plain.to_bits() == bounded.value.to_bits() || (plain.is_nan() && bounded.value.is_nan());
            assert!(same, "{what}: {name}: {plain:e} without bounds, {bounded:?} with");
        }
    }
}

/// Five steps of some method, from the state on the constraints: published ones are on them as well as numbers of
/// double precision can be, which is not enough for wider ones.
pub fn run<T: Real, K: Any<T>, C: Control<K>>(
    kernel: &K,
    (q, z): (&[f64], &[f64]),
    step: f64,
    control: impl FnOnce(T) -> C,
) -> Vec<T> {
    let (q, z) = state::<T, K>(kernel, q, z);
    let (q, z) = kernel.project(T::zero(), &q, &z).expect("constraints");
    let h = T::from_f64(step);
    let end = T::from_f64(5.0) * h;
    let reached = Simulation::new(kernel).control(control(h)).run_to_end(q, z, T::zero()..end).expect("runs");
    [list(&reached.q.components()), list(&reached.z)].concat()
}

/// The state after some steps.
fn run_holds<B: Any<Bounded>, D: Any<DoubleDouble>>(
    what: &str,
    (bounded, wide): (&B, &D),
    (q, z): (&[f64], &[f64]),
    step: f64,
    excess: &mut Excess,
) {
    let (found, exact) = (run(bounded, (q, z), step, Fixed::new), run(wide, (q, z), step, Fixed::new));
    excess.check(&format!("{what}: run"), &found, &exact);
}

/// Bounds of everything at a state and, for a step, of a run from it; the values are those without bounds.
pub fn holds<P: Any<f64>, B: Any<Bounded>, D: Any<DoubleDouble>>(
    what: &str,
    (plain, bounded, wide): (&P, &B, &D),
    (q, z): (&[f64], &[f64]),
    step: Option<f64>,
    excess: &mut Excess,
) {
    outputs_hold(what, (bounded, wide), (q, z), excess);
    values_are_those_of_the_plain_scalar(what, (plain, bounded), (q, z));
    if let Some(step) = step {
        run_holds(what, (bounded, wide), (q, z), step, excess);
    }
}
