//! Splitting methods on a top under torques: orders, symmetry, the symplectic form, what is refused.

use gauss_exact::{FreeMotion, MoserVeselov, Scheme, Splitting};
use nalgebra::{SMatrix, SVector};

use crate::configuration::Configuration;
use crate::integrate::SystemProblem;
use crate::integrate::{
    Feedback, Fixed, IntegrationErrorKind, MomentumForm, OneStep, Problem, RunPart, Simulation, State, VelocityForm,
};
use crate::system::GaussSystem;
use crate::testing::FreeTop;
use crate::testing::order::{
    NONE, TOP, Torque, WEIGHT, distance, march, measured_order, start_by_momentum, start_by_velocity,
};

const SCHEMES: [Scheme; 5] =
    [Scheme::STRANG, Scheme::BLANES_MOAN_4, Scheme::BLANES_MOAN_6, Scheme::KAHAN_LI_6, Scheme::KAHAN_LI_8];

/// A torque that no potential has, and that changes with time.
const SWINGING: Feedback<Torque> = Feedback(|t, q, _| {
    let up = q.inverse() * SVector::from([0.0, 0.0, 1.0]);
    [0.8 * up[1] + 0.3 * t.sin(), -0.7 * up[0], 0.2 * up[1] * t]
});

#[test]
fn schemes_have_their_orders() {
    let exact = |scheme| Splitting::exact(&TOP, scheme).expect("a body");
    let discrete = |scheme| Splitting::discrete(&TOP, scheme).expect("a body");
    let velocities = SystemProblem { system: &TOP, form: VelocityForm, input: SWINGING };
    let momenta = SystemProblem { system: &TOP, form: MomentumForm, input: SWINGING };
    // The error constant of order 4 is so small that terms of higher order rule beyond h = 0.1.
    let counts = [[40, 80, 160, 320], [60, 90, 120, 180], [24, 36, 54, 80], [20, 40, 80, 120], [14, 17, 20, 24]];
    for (scheme, counts) in SCHEMES.into_iter().zip(counts) {
        for order in [
            measured_order(&exact(scheme), &momenta, &start_by_momentum(), 4.0, &counts),
            measured_order(&discrete(scheme), &momenta, &start_by_momentum(), 4.0, &counts),
            measured_order(&exact(scheme), &velocities, &start_by_velocity(), 4.0, &counts),
        ] {
            let expected = f64::from(scheme.order());
            assert!((order - expected).abs() < 0.1 * expected, "{scheme:?}: {order}");
        }
    }
}

#[test]
fn the_lower_order_of_scheme_and_motion_is_that_of_the_method() {
    let order_of = |method: &dyn Fn(Scheme) -> u32| SCHEMES.map(method);
    let stated = |scheme, order| {
        let method = Splitting::with(&TOP, scheme, |moments| MoserVeselov::of_order(moments, order)).expect("a body");
        OneStep::<FreeTop<f64>>::properties(&method)
    };
    assert_eq!(order_of(&|scheme| stated(scheme, 4).order), [2, 4, 4, 4, 4]);
    assert_eq!(order_of(&|scheme| stated(scheme, 10).order), [2, 4, 6, 6, 8]);
    assert!(stated(Scheme::STRANG, 2).symplectic && !stated(Scheme::STRANG, 10).symplectic);
    let exact = Splitting::exact(&TOP, Scheme::KAHAN_LI_6).expect("a body");
    let properties = OneStep::<FreeTop<f64>>::properties(&exact);
    assert!(properties.order == 6 && properties.symplectic && properties.symmetric && properties.keeps_momentum);
}

/// How far a run of twenty steps and twenty back ends from its start.
fn there_and_back(method: &impl OneStep<FreeTop<f64>>) -> f64 {
    let problem = SystemProblem { system: &TOP, form: MomentumForm, input: SWINGING };
    let start = start_by_momentum();
    let there = march(method, &problem, &start, 2.0, 20);
    distance(&march(method, &problem, &there, -2.0, 20), &start)
}

#[test]
fn a_run_back_undoes_a_run() {
    for scheme in SCHEMES {
        // At most seventeen drifts a step, each of some ten roundings of random sign, four times as much in one of ten
        // thousand walks; the motion magnifies hardly in so short a time.
        let rounding = 4.0 * 10.0 * f64::EPSILON * (2.0 * 20.0 * 17.0_f64).sqrt();
        let exact = there_and_back(&Splitting::exact(&TOP, scheme).expect("a body"));
        let discrete = there_and_back(&Splitting::discrete(&TOP, scheme).expect("a body"));
        assert!(exact < rounding && discrete < rounding, "{scheme:?}: {exact:e} {discrete:e}");
    }
}

/// dθ of θ = p·ξ on the cotangent bundle, left-trivialised: `π₁·ξ₂ − π₂·ξ₁ − p·(ξ₁ × ξ₂)`.
fn symplectic_form(p: &SVector<f64, 3>) -> SMatrix<f64, 6, 6> {
    let mut form = SMatrix::zeros();
    for i in 0..3 {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        (form[(i + 3, i)], form[(i, i + 3)]) = (1.0, -1.0);
        (form[(i, j)], form[(j, i)]) = (-p[k], p[k]);
    }
    form
}

/// The end of a step from a start that is moved along one of the six directions.
fn moved(method: &impl OneStep<FreeTop<f64>>, h: f64, column: usize, by: f64) -> State<FreeTop<f64>> {
    let problem = SystemProblem { system: &TOP, form: MomentumForm, input: WEIGHT };
    let mut state = start_by_momentum();
    let mut change = SVector::<f64, 3>::zeros();
    change[column % 3] = by;
    if column < 3 {
        state.q = state.q.retract(&change);
    } else {
        state.y += change;
    }
    let rates = problem.rates(&state);
    method.step(&problem, &state, &rates, h).expect("a regular step").state
}

/// By how much a step changes the symplectic form, by central differences.
fn defect(method: &impl OneStep<FreeTop<f64>>, h: f64) -> f64 {
    let end = moved(method, h, 0, 0.0);
    let mut jacobian = SMatrix::<f64, 6, 6>::zeros();
    for column in 0..6 {
        // Richardson's extrapolation leaves an error of order 4.
        for (by, weight) in [(1e-4, 4.0 / 3.0), (2e-4, -1.0 / 3.0)] {
            let (plus, minus) = (moved(method, h, column, by), moved(method, h, column, -by));
            let turned = end.q.difference(&plus.q) - end.q.difference(&minus.q);
            let changed = plus.y - minus.y;
            for row in 0..3 {
                jacobian[(row, column)] += turned[row] * weight / (2.0 * by);
                jacobian[(row + 3, column)] += changed[row] * weight / (2.0 * by);
            }
        }
    }
    (jacobian.transpose() * symplectic_form(&end.y) * jacobian - symplectic_form(&start_by_momentum().y)).amax()
}

#[test]
fn the_symplectic_form_is_kept_where_that_is_stated() {
    // Differences of numbers rounded to 1e-16 over 1e-4, in sums of twelve; the error of order 4 is below.
    let noise = 100.0 * f64::EPSILON / 1e-4;
    for scheme in SCHEMES {
        let exact = Splitting::exact(&TOP, scheme).expect("a body");
        assert!(defect(&exact, 0.4) < noise, "{scheme:?}: {:e}", defect(&exact, 0.4));
    }
    let by_order = |order| Splitting::with(&TOP, Scheme::STRANG, |i| MoserVeselov::of_order(i, order)).expect("a body");
    assert!(defect(&by_order(2), 0.4) < noise);
    // With corrections only as far as these go.
    assert!(defect(&by_order(4), 0.4) > 10.0 * noise, "{:e}", defect(&by_order(4), 0.4));
    assert!(defect(&by_order(10), 0.1) < noise, "{:e}", defect(&by_order(10), 0.1));
}

#[test]
fn without_forces_energy_and_momentum_stay() {
    let problem = SystemProblem { system: &TOP, form: MomentumForm, input: NONE };
    let start = start_by_momentum();
    let energy = |state: &State<FreeTop<f64>>| {
        let z = TOP.velocity(0.0, &state.q, &state.y);
        TOP.kinetic_energy(0.0, &state.q, &z)
    };
    let method = Splitting::discrete(&TOP, Scheme::BLANES_MOAN_4).expect("a body");
    let end = march(&method, &problem, &start, 1000.0, 10_000);
    // Six drifts a step, each a few roundings of random sign.
    let rounding = 10.0 * f64::EPSILON * 6e4_f64.sqrt();
    assert!((energy(&end) / energy(&start) - 1.0).abs() < rounding);
    assert!((end.q * end.y - start.q * start.y).amax() < rounding);
}

#[test]
fn single_precision_runs() {
    let single = FreeTop { inertia: [0.5_f32, 0.85, 1.0] };
    let method = Splitting::discrete(&single, Scheme::BLANES_MOAN_4).expect("a body");
    let start = start_by_velocity();
    let end = Simulation::new(&single)
        .momentum_form()
        .input(|_, _: &_, _: &_| [0.0; 3])
        .control(Fixed::by(method, 0.1))
        .run_to_end(start.q.cast(), start.y.cast(), 0.0..2.0)
        .expect("runs");
    let problem = SystemProblem { system: &TOP, form: MomentumForm, input: NONE };
    let exact = march(&Splitting::exact(&TOP, Scheme::STRANG).expect("a body"), &problem, &start_by_momentum(), 2.0, 1);
    // 20 steps of six drifts, each of some ten roundings.
    let error = (end.p.cast::<f64>() - exact.y).amax();
    assert!(error < 1200.0 * f64::from(f32::EPSILON), "{error:e}");
}

#[test]
fn broken_inputs_and_long_steps_are_refused() {
    let broken = Feedback(|t: f64, _: &_, _: &_| [if t > 0.05 { f64::NAN } else { 0.0 }, 0.0, 0.0]);
    let problem = SystemProblem { system: &TOP, form: VelocityForm, input: broken };
    let start = start_by_velocity();
    let exact = Splitting::exact(&TOP, Scheme::STRANG).expect("a body");
    let error = exact.step(&problem, &start, &problem.rates(&start), 0.1).err();
    assert_eq!(error, Some(IntegrationErrorKind::NonFinite { part: RunPart::Step }));
    let problem = SystemProblem { system: &TOP, form: VelocityForm, input: NONE };
    let discrete = Splitting::discrete(&TOP, Scheme::STRANG).expect("a body");
    let error = discrete.step(&problem, &start, &problem.rates(&start), 20.0).err();
    assert!(matches!(error, Some(IntegrationErrorKind::NotConverged { .. })), "{error:?}");
    // The exact motion has no longest step.
    assert!(exact.step(&problem, &start, &problem.rates(&start), 20.0).is_ok());
}

#[test]
fn a_step_of_no_length_does_nothing() {
    let y = SVector::from([0.2, 1.0, 0.4]);
    let turn = MoserVeselov::new([0.5, 0.85, 1.0]).turn(&y, 0.0).expect("regular");
    assert_eq!((turn.rotation, turn.change), (nalgebra::UnitQuaternion::identity(), SVector::zeros()));
}
