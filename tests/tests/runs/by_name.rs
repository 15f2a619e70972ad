//! Methods by name: a run has the bits of one by the method's own type, alone and in lanes.

use std::collections::BTreeSet;

use gauss_batch::{Batch, LaneControl, States};
use gauss_runtime::integrate::{Adams, Control, Fixed, JacobianMethod, Method, MethodControl, Radau, StepSetting};
use gauss_runtime::prelude::*;

/// A heavy top with a damper.
#[derive(GaussDynamics)]
#[gauss(
    motion = fixed_point,
    taylor,
    linearize,
    drag(linear = [0, 0, 0, damping, damping, damping]),
)]
struct Top<T> {
    #[gauss(mass)]
    mass: T,
    #[gauss(center_of_mass)]
    center: Vector3<T>,
    #[gauss(inertia)]
    inertia: Vector3<T>,
    #[gauss(gravity)]
    g: T,
    damping: T,
}

fn top<T: Real>() -> TopKernel<T> {
    let vector = |numbers: [f64; 3]| Vector3::from(numbers.map(T::from_f64));
    let [mass, g, damping] = [1.2, 9.81, 0.02].map(T::from_f64);
    let body = Top { mass, center: vector([0.02, 0.0, 0.3]), inertia: vector([0.2, 0.25, 0.1]), g, damping };
    body.kernel().expect("a body")
}

fn start(i: usize) -> (UnitQuaternion<f64>, Vector3<f64>) {
    let angle = 0.4 + 0.1 * i as f64;
    (UnitQuaternion::from_euler_angles(angle, 0.2, -0.3), Vector3::new(0.3, -0.2 * angle, 6.0))
}

/// Not a part of the interval: the last step is shorter.
const LENGTH: f64 = 0.07;
const INTERVAL: core::ops::Range<f64> = 0.3..1.6;
const TOLERANT: StepSetting<f64> = StepSetting::Tolerant { relative: 1e-8, absolute: 1e-10, largest: Some(0.4) };

/// The bits of all that a run gives: samples, events, states between samples, counts of steps; once by all steps at
/// once, and once step by step.
fn bits<C: Control<TopKernel<f64>> + Copy>(control: C) -> Vec<u64> {
    let (kernel, (q, z)) = (top::<f64>(), start(0));
    let run = || {
        Simulation::new(&kernel)
            .event(Crossing::Any, |_, _, z: &Vector3<f64>| z[0])
            .event(Crossing::Rising, |_, _, z: &Vector3<f64>| z[1])
            .then_through(|state| state.z[1] *= 0.9)
            .control(control)
    };
    let trajectory = run().run(q, z, INTERVAL).expect("runs");
    let mut stepper = run().stepper(q, z, INTERVAL).expect("begins");
    let reached = [0.5, 0.77, 1.3].map(|t| stepper.reach(t).expect("steps"));
    let events = trajectory.events();
    assert!(events.iter().any(|event| event.number == 0) && events.iter().any(|event| event.number == 1));
    let between = [0.31, 0.777, 1.55].map(|t| trajectory.at(t).expect("is within"));
    let samples = trajectory.iter().chain(events.iter().map(|event| &event.sample)).chain(&reached).chain(&between);
    let numbers = samples.flat_map(|s| [s.t].into_iter().chain(s.q.coords.iter().chain(s.z.iter()).copied()));
    let summary = trajectory.summary();
    numbers.map(f64::to_bits).chain([summary.steps, summary.rejected]).collect()
}

/// The names of the methods that were compared so, by steps of one length.
#[test]
fn runs_have_the_bits_of_the_own_type() {
    let [mut of_length, mut tolerant] = [BTreeSet::new(), BTreeSet::new()];
    let named = |method: Method, setting| {
        bits(MethodControl::<f64, JacobianMethod, Taylor>::new(method, setting).expect("a place for it"))
    };
    let mut equal = |method: Method, own: Vec<u64>| {
        assert_eq!(named(method, StepSetting::Equal(LENGTH)), own, "{method}");
        of_length.insert(method.name());
    };
    equal(Method::DormandPrince8, bits(Fixed::by(RungeKutta(DormandPrince8), LENGTH)));
    equal(Method::DormandPrince5, bits(Fixed::by(RungeKutta(DormandPrince5), LENGTH)));
    equal(Method::Verner9, bits(Fixed::by(RungeKutta(Verner9), LENGTH)));
    equal(Method::Rosenbrock, bits(Fixed::by(Rosenbrock, LENGTH)));
    equal(Method::Radau, bits(Fixed::by(Radau, LENGTH)));
    equal(Method::Collocation6, bits(Fixed::by(Collocation::order_6(), LENGTH)));
    equal(Method::Collocation4, bits(Fixed::by(Collocation::order_4(), LENGTH)));
    equal(Method::Collocation2, bits(Fixed::by(Collocation::midpoint(), LENGTH)));
    equal(Method::Classical4, bits(Fixed::by(RungeKutta(Classical4), LENGTH)));
    equal(Method::CommutatorFree4, bits(Fixed::by(CommutatorFree4, LENGTH)));
    equal(Method::Adams10, bits(Adams::<_, 10>::new(LENGTH)));
    equal(Method::Adams12, bits(Adams::<_, 12>::new(LENGTH)));
    let mut keeps = |method: Method, own: Vec<u64>| {
        assert_eq!(named(method, TOLERANT), own, "{method}");
        tolerant.insert(method.name());
    };
    macro_rules! own {
        ($method:expr) => {
            bits(Adaptive::by($method, 1e-8, 1e-10).largest_step(0.4))
        };
    }
    keeps(Method::DormandPrince8, own!(RungeKutta(DormandPrince8)));
    keeps(Method::DormandPrince5, own!(RungeKutta(DormandPrince5)));
    keeps(Method::Verner9, own!(RungeKutta(Verner9)));
    keeps(Method::Rosenbrock, own!(Rosenbrock));
    keeps(Method::Radau, own!(Radau));
    keeps(Method::Taylor, bits(Taylor::new(1e-8, 1e-10).largest_step(0.4)));
    // Every row of the table was there.
    let rows =
        |has: fn(Method) -> bool| Method::ALL.iter().filter(move |&&method| has(method)).map(|method| method.name());
    assert_eq!(of_length, rows(Method::takes_length).collect());
    assert_eq!(tolerant, rows(Method::keeps_tolerances).collect());
}

/// In lanes, each run has the bits that it has alone, whatever the method. Series have one order for the lanes of a
/// block, and fixed-point iterations go on until all lanes are done: of these the own type in lanes is compared.
#[test]
fn lanes_have_the_bits_of_single_runs() {
    type Four = Lanes<f64, 4>;
    fn in_lanes<C: LaneControl<TopKernel<Four>>>(control: C) -> Vec<u64> {
        let kernel = top::<Four>();
        let mut states = States::<TopKernel<Four>>::from_fn(6, start);
        let ends = Batch::new(&kernel).control(control).run(INTERVAL, &mut states);
        let steps = ends.iter().map(|end| end.as_ref().expect("runs").summary.steps);
        let numbers = states.iter().flat_map(|(q, z)| q.coords.iter().chain(z.iter()).copied().collect::<Vec<_>>());
        numbers.map(f64::to_bits).chain(steps).collect()
    }
    fn alone(control: MethodControl<f64, JacobianMethod, Taylor>) -> Vec<u64> {
        let kernel = top::<f64>();
        let ends = (0..6).map(|i| {
            let (q, z) = start(i);
            Simulation::new(&kernel).control(control).run_to_end(q, z, INTERVAL).expect("runs")
        });
        let ends: Vec<_> = ends.collect();
        let numbers = ends.iter().flat_map(|end| end.q.coords.iter().chain(end.z.iter()).copied());
        numbers.map(f64::to_bits).chain(ends.iter().map(|end| end.summary.steps)).collect()
    }
    let mut compared = 0;
    for &method in Method::ALL {
        for setting in [StepSetting::Equal(LENGTH), TOLERANT] {
            let Ok(control) = MethodControl::<f64, JacobianMethod, Taylor>::new(method, setting) else { continue };
            let packs =
                MethodControl::<Four, JacobianMethod, Taylor>::new(method, setting.in_scalar()).expect("the same");
            let expected = match method {
                Method::Taylor => in_lanes(Taylor::new(1e-8, 1e-10).largest_step(0.4)),
                Method::Collocation6 => in_lanes(Fixed::by(Collocation::order_6(), Four::splat(LENGTH))),
                Method::Collocation4 => in_lanes(Fixed::by(Collocation::order_4(), Four::splat(LENGTH))),
                Method::Collocation2 => in_lanes(Fixed::by(Collocation::midpoint(), Four::splat(LENGTH))),
                _ => alone(control),
            };
            assert_eq!(in_lanes(packs), expected, "{method} {setting:?}");
            compared += 1;
        }
    }
    // All rows, of which five make both kinds of steps.
    assert_eq!(compared, Method::ALL.len() + 5);
}
