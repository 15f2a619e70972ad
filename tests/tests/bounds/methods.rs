//! Methods of fixed steps, some steps of each: what they round, and what their coefficients are off by. Methods that
//! iterate are left out: what is left when they stop is not rounding.

use gauss_bounded::exact;
use gauss_exact::{MoserVeselov, Scheme, Splitting};
use gauss_runtime::integrate::{
    CommutatorFree4, Compensated, Fixed, IncrementStep, Problem, Rkmk, State, SystemProblem,
};
use gauss_runtime::prelude::*;
use gauss_tests::double_double::DoubleDouble;

use crate::common::Bounded;
use crate::compare::{Excess, Random, run};

/// Forces that grow with time: what a step adds depends on its coefficients alone, and little else is rounded.
#[derive(GaussDynamics)]
#[gauss(coordinates(x), particle(mass = m, position = [x, 0, 0]), potential = -m * x * t)]
struct Pull<T> {
    m: T,
}

#[derive(GaussDynamics)]
#[gauss(coordinates(x), particle(mass = 1, position = [x, 0, 0]), potential = k / 2 * powi(x, 2))]
struct Oscillator<T> {
    k: T,
}

#[derive(GaussDynamics)]
#[gauss(motion = fixed_point, chart = left_invariant)]
struct Top<T> {
    #[gauss(mass)]
    mass: T,
    #[gauss(center_of_mass)]
    center: Vector3<T>,
    #[gauss(inertia)]
    inertia: Vector3<T>,
    #[gauss(gravity)]
    g: T,
}

fn pull<T: Real>() -> PullKernel<T> {
    Pull { m: T::one() }.kernel().expect("a system")
}

fn top<T: Real>() -> TopKernel<T> {
    let vector = |v: [f64; 3]| Vector3::from(v.map(T::from_f64));
    let (mass, g) = (T::from_f64(1.5), T::from_f64(9.81));
    Top { mass, center: vector([0.1, -0.2, 0.4]), inertia: vector([0.9, 1.1, 0.7]), g }.kernel().expect("a top")
}

/// Steps of powers of two and of any length, from states of both kinds.
macro_rules! explore {
    ($kernel:ident, $q:expr, $speeds:literal, $method:literal, |$of:pat_param, $h:pat_param| $control:expr) => {{
        let (plain, wide) = ($kernel::<Bounded>(), $kernel::<DoubleDouble>());
        let (mut excess, mut random) = (Excess::default(), Random(19));
        let what = concat!(stringify!($kernel), ", ", $method);
        for k in 0..100 {
            let (step, z) = match k % 2 {
                0 => (0.5_f64.powi(k / 2 % 9 + 3), [0.5; $speeds]),
                _ => (random.decades(-3.0, -1.0), std::array::from_fn(|_| random.next())),
            };
            let found = run(&plain, (&$q, &z), step, |$h| {
                let $of = &plain;
                $control
            });
            let exact = run(&wide, (&$q, &z), step, |$h| {
                let $of = &wide;
                $control
            });
            excess.check(what, &found, &exact);
        }
        excess.report(what);
    }};
}

const UPRIGHT: [f64; 4] = [0.0, 0.0, 0.0, 1.0];

#[test]
fn explicit_methods() {
    explore!(pull, [0.0], 1, "RK4", |_, h| Fixed::with(&Tableau::RK4, h));
    explore!(pull, [0.0], 1, "RK4, compensated", |_, h| Compensated::with(&Tableau::RK4, h));
    explore!(pull, [0.0], 1, "order 8, compensated", |_, h| Compensated::with(&Tableau::DORMAND_PRINCE_8, h));
    explore!(pull, [0.0], 1, "commutator-free", |_, h| Fixed::by(CommutatorFree4, h));
    explore!(top, UPRIGHT, 3, "RK4", |_, h| Fixed::with(&Tableau::RK4, h));
    explore!(top, UPRIGHT, 3, "RK4, compensated", |_, h| Compensated::with(&Tableau::RK4, h));
    explore!(top, UPRIGHT, 3, "commutator-free", |_, h| Fixed::by(CommutatorFree4, h));
}

#[test]
fn splitting() {
    explore!(top, UPRIGHT, 3, "splitting", |of, h| {
        let body = Splitting::with(of, Scheme::BLANES_MOAN_4, MoserVeselov::new).expect("a body in its own axes");
        Fixed::by(body, h)
    });
}

/// How far bounds of a run reach: forgotten correlations let them grow as e^{βLt}, where L is the norm of the Jacobian
/// of the rates with its signs forgotten, of an oscillator L = ω = 1, and β the sum of the weights |bᵢ| of the method.
#[test]
fn bounds_of_a_run_grow_exponentially() {
    let oscillator = Oscillator { k: Bounded::exact(1.0) }.kernel().expect("a system");
    let digits = |end: f64| {
        let (q, z) = (exact(&SVector::from([1.0])), exact(&SVector::from([0.5])));
        let run = Simulation::new(&oscillator).control(Fixed::with(&Tableau::RK4, Bounded::exact(1.0 / 32.0)));
        let last = run.run_to_end(q, z, Bounded::exact(0.0)..Bounded::exact(end)).expect("runs");
        // Of the two numbers one may be near zero.
        last.q[0].digits().max(last.z[0].digits())
    };
    for end in [1.0_f64, 5.0, 10.0, 20.0] {
        // Each of 32 steps a unit of time rounds some thirty times by half a unit in the last place, of numbers near 1.
        let rounding = (32.0 * end * 30.0 * 0.5 * f64::EPSILON).log10();
        let expected = -rounding - end / std::f64::consts::LN_10;
        assert!(digits(end) > expected, "{end}: {} digits, {expected}", digits(end));
        // And no faster way is known: e^{Lt} times a single rounding has gone.
        let most = -f64::EPSILON.log10() - end / std::f64::consts::LN_10 + 1.0;
        assert!(digits(end) < most, "{end}: {} digits, {most}", digits(end));
    }
    assert_eq!(digits(50.0), 0.0, "as the page says");
}

/// A step alone, before it is added to the state: of stages 0, h/2, h/2, h nothing is rounded but the coefficients and
/// their sum.
#[test]
fn increments() {
    fn increment<T: Real>(step: f64) -> Vec<T> {
        let (kernel, h) = (pull::<T>(), T::from_f64(step));
        let problem = SystemProblem::new(&kernel);
        let state = State { t: T::zero(), q: SVector::from([T::zero()]), y: SVector::from([T::zero()]) };
        let rates = problem.rates(&state);
        let step = Rkmk::new(&Tableau::RK4).increment(&problem, &state, &rates, h).expect("a step");
        vec![step.configuration[0], step.variables[0]]
    }
    let mut excess = Excess::default();
    for k in 1..20 {
        for step in [1.0, 3.0, 5.0, 0.7].map(|m| m * 0.5_f64.powi(k)) {
            excess.check("increment", &increment(step), &increment(step));
        }
    }
    excess.report("increments");
}
