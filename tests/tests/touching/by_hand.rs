//! Steps, accelerations and derivatives that are asked for without a run have no contact forces: they refuse a scene
//! with contacts, unless these are left out on purpose.

use gauss_adapters::FlatSystem;
use gauss_batch::{Batch, States};
use gauss_exact::{Scheme, Splitting, TopFlow};
use gauss_runtime::integrate::{
    Collocation, CommutatorFree4, Composed, Composition, DormandPrince8, EnergyMomentum, IncrementStep,
    IntegrationErrorKind, OneStep, Problem, Rkmk, Rosenbrock, RungeKutta, StepOutcome, SystemProblem, Tableau,
    Variational,
};
use gauss_runtime::prelude::*;
use gauss_runtime::simd::Lanes;

/// A top that turns about O, whose tip may touch a ceiling.
#[derive(GaussDynamics)]
#[gauss(
    motion = fixed_point,
    linearize(without_contacts),
    mass = 2,
    center_of_mass = [0, 0, 0.3],
    inertia = [0.2, 0.2, 0.05],
    point(tip, body = body, at = [0, 0, 0.5]),
    contact(ceiling, gap = 0.4 - tip.z),
)]
struct Top<T> {
    #[gauss(gravity)]
    g: T,
}

type Kernel = TopKernel<f64>;

fn start() -> (UnitQuaternion<f64>, Vector3<f64>) {
    (UnitQuaternion::from_euler_angles(1.2, 0.0, 0.0), Vector3::new(0.1, 0.2, 3.0))
}

/// A step by hand is refused, and made where contacts are left out.
fn check(kernel: &Kernel, method: &impl OneStep<Kernel>) {
    let (q, z) = start();
    let plain = SystemProblem::new(kernel);
    let state = plain.state(0.0, q, &z);
    let step = method.step(&plain, &state, &plain.rates(&state), 1e-3);
    assert_eq!(step.map(|_| ()).unwrap_err(), IntegrationErrorKind::Contacts);
    let open = SystemProblem::new(kernel).without_contacts();
    let made = method.step(&open, &state, &open.rates(&state), 1e-3).expect("a step");
    assert!((made.state.y - z).norm() > 0.0 && made.state.t == 1e-3);
}

/// So is its increment, for steps with compensated rounding.
fn check_increment(kernel: &Kernel, method: &impl IncrementStep<Kernel>) {
    check(kernel, method);
    let (q, z) = start();
    let plain = SystemProblem::new(kernel);
    let state = plain.state(0.0, q, &z);
    let increment = method.increment(&plain, &state, &plain.rates(&state), 1e-3);
    assert_eq!(increment.map(|_| ()).unwrap_err(), IntegrationErrorKind::Contacts);
}

#[test]
fn steps_by_hand_refuse_contacts() {
    let kernel = Top { g: 9.81 }.kernel().expect("a top");
    check(&kernel, &RungeKutta(DormandPrince8));
    check(&kernel, &CommutatorFree4);
    check(&kernel, &Rosenbrock);
    check(&kernel, &Variational);
    check(&kernel, &Composed::new(&Composition::KAHAN_LI_6, Variational));
    check(&kernel, &Splitting::exact(&kernel, Scheme::STRANG).expect("a body"));
    check(&kernel, &TopFlow::new(&kernel).expect("a body of revolution"));
    check_increment(&kernel, &Rkmk::new(&Tableau::DORMAND_PRINCE_8));
    check_increment(&kernel, &Collocation::midpoint());
    check_increment(&kernel, &EnergyMomentum::<f64, 2>::with_points());
    let (q, z) = start();
    let run = Simulation::new(&kernel).fixed_step(1e-3);
    let refused = run.stepper(q, z, 0.0..1.0).expect_err("contacts");
    assert!(matches!(refused.kind, IntegrationErrorKind::Contacts), "{refused}");
    let mut open = run.without_contacts().stepper(q, z, 0.0..1.0).expect("begins");
    assert_eq!(open.step(), Ok(StepOutcome::Step));
}

#[test]
fn derivatives_of_a_step_are_those_that_the_struct_leaves_contacts_out_of() {
    let kernel = Top { g: 9.81 }.kernel().expect("a top");
    let (q, z) = start();
    let step = CommutatorFree4.step_linearized(&kernel, 0.0, &q, &z, &(), 1e-3).expect("a step");
    let open = SystemProblem::new(&kernel).without_contacts();
    let state = open.state(0.0, q, &z);
    let made = CommutatorFree4.step(&open, &state, &open.rates(&state), 1e-3).expect("a step").state;
    assert!(step.q == made.q && step.z == made.y);
}

#[test]
fn other_integrators_have_the_motion_without_contacts_on_purpose() {
    let kernel = Top { g: 9.81 }.kernel().expect("a top");
    let (q, z) = start();
    let system = FlatSystem::new(&kernel).without_contacts();
    let x: [f64; 7] = system.vector(0.0, &q, &z);
    let mut slope = [0.0; 7];
    system.rates(0.0, &x, &mut slope);
    let expected = kernel.acceleration(0.0, &q, &z, &());
    assert!((0..3).all(|i| slope[4 + i] == expected[i]));
}

type Four = Lanes<f64, 4>;

fn states() -> States<TopKernel<Four>> {
    States::from_fn(4, |_| start())
}

#[test]
fn accelerations_of_a_batch_leave_contacts_out_on_purpose() {
    let kernel = Top { g: Four::splat(9.81) }.kernel().expect("a top");
    let all = Batch::new(&kernel).without_contacts().accelerations(0.0, &states());
    let one = Top { g: 9.81 }.kernel().expect("a top");
    let (q, z) = start();
    assert_eq!(all.get(3), one.acceleration(0.0, &q, &z, &()));
}
