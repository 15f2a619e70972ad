//! Runs of models that come at run time beside those of compiled kernels of the same structs: charts of one body,
//! rotations, constraints, states of elements, accelerations that are not smooth, and room for more than there is.

use gauss_jit::{Inputs, Kernel, Model, NoSystem, System};
use gauss_runtime::integrate::Adaptive;
use gauss_runtime::linearize::{LinearModel, error_matrix};
use gauss_runtime::prelude::*;

/// A struct with its kernel, and the text of it.
macro_rules! scene {
    ($name:ident, { $($tokens:tt)* }) => {
        mod $name {
            use gauss_runtime::prelude::*;

            #[derive(Clone, Copy, GaussDynamics)]
            $($tokens)*

            pub const SOURCE: &str = stringify!($($tokens)*);
        }
    };
}

scene!(torpedo, {
    #[gauss(chart = hybrid, mass = 2, center_of_mass = [0.1, 0, -0.2], inertia = [1, 2, 2.5], gravity = 9.81)]
    pub struct Torpedo {}
});

scene!(car, {
    #[gauss(motion = planar, mass = 2, center_of_mass = [0.3, 0.1, 0], inertia = [1, 1, 1.5])]
    pub struct Car {}
});

// A pose behind a coordinate, a rotation behind the pose: the coordinate comes last in q.
scene!(carrier, {
    #[gauss(
        coordinates(slide, craft: Pose, head: Rotation),
        body(hull, pose = craft, mass = 5, inertia = [1, 2, 3]),
        body(camera, parent = hull, position = [0.2, 0, slide], rotation = head, mass = 0.5, inertia = [0.1, 0.2, 0.15]),
        spring(along = slide, stiffness = 30, damping = 0.2), gravity = 9.81,
    )]
    pub struct Carrier {}
});

scene!(linkage, {
    #[gauss(
        coordinates(x, y, u), particle(mass = 1, position = [x, 0, y]), particle(mass = 0.3, position = [u, 0, 0]),
        constraint(position = x * x + y * y - 1), constraint(position = (x - u) * (x - u) + y * y - 4),
        gravity = 9.81,
    )]
    pub struct Linkage {}
});

scene!(filter, {
    #[gauss(
        coordinates(x), particle(mass = 2, position = [x, 0, 0]), states(lag = 5 * (x - lag)), input(pull),
        drive(x = pull - 3 * lag),
    )]
    pub struct Filter {}
});

scene!(kink, {
    #[gauss(coordinates(x), particle(mass = 1, position = [x, 0, 0]), drive(x = -4 * x - 2 * abs(x)))]
    pub struct Kink {}
});

// Stiff: the slide comes to its place within 10 µs; a coordinate stands before a rotation.
scene!(damped, {
    #[gauss(
        coordinates(slide, head: Rotation), linearize, input(push),
        body(camera, position = [0.2, 0, slide], rotation = head, mass = 0.5, inertia = [0.1, 0.2, 0.15]),
        spring(along = slide, stiffness = 300, damping = 1e5), drive(slide = push), gravity = 9.81,
    )]
    pub struct Damped {}
});

fn kernel(source: &str) -> Kernel {
    let model = Model::from_source(source).unwrap_or_else(|mistakes| panic!("{mistakes}\n{source}"));
    model.kernel(&[]).unwrap_or_else(|error| panic!("{error}"))
}

fn numbers<V: VectorSpace<f64>>(vector: &V) -> Vec<f64> {
    (0..V::DIM).map(|i| vector.component(i)).collect()
}

/// Both ways agree to this much: a run with tolerances of 1e-12 has errors of some 1e-10, by steps that differ in
/// rounding alone.
const NEAR: f64 = 1e-9;

/// Compares the end of a run, its steps, and its state between steps, with room for Q and Z numbers.
fn compare<S, I, const Q: usize, const Z: usize, const CONSTRAINED: bool>(
    compiled: &S,
    system: &System<'_, Q, Z, I, CONSTRAINED>,
    (q, z): (S::Configuration, S::Speeds),
    input: impl Fn(f64) -> (S::Input, I),
) where
    S: GaussSystem<Scalar = f64>,
    I: Inputs + VectorSpace<f64>,
{
    let span = 0.0..1.3;
    let expected = Simulation::new(compiled).adaptive(1e-12, 1e-12).input(|t: f64, _: &_, _: &_| input(t).0);
    let expected = expected.run(q, z, span.clone()).expect("a compiled run");
    let start = system.configuration(&numbers(&q.components()));
    let speeds = SVector::from_fn(|i, _| if i < S::Speeds::DIM { z.component(i) } else { 0.0 });
    let tolerance = 1e-12 * system.share();
    let found = Simulation::new(system).adaptive(tolerance, tolerance).input(|t: f64, _: &_, _: &_| input(t).1);
    let found = found.run(start, speeds, span).expect("a run");
    let counts = [expected.summary(), found.summary()].map(|summary| summary.steps + summary.rejected);
    // A step may be longer or shorter by rounding, and what comes after it differs.
    assert!(counts[0].abs_diff(counts[1]) <= 1 + counts[0] / 10, "{counts:?}");
    for t in [0.0, 0.37, 0.9, 1.3] {
        let (a, b) = (expected.at(t).expect("a state"), found.at(t).expect("a state"));
        let own = [numbers(&a.q.components()), numbers(&a.z)];
        let other = [b.q.as_slice(), b.z.as_slice()];
        for (own, other) in own.iter().zip(other) {
            for (k, x) in other.iter().enumerate() {
                let expected = own.get(k).copied().unwrap_or(0.0);
                assert!((x - expected).abs() <= NEAR, "t = {t}, number {k}: {x} for {expected}");
            }
        }
        // An increment has groups first, as a configuration has.
        let rates = [
            numbers(&compiled.configuration_rates(t, &a.q, &a.z, &input(t).0)),
            numbers(&system.configuration_rates(t, &b.q, &b.z, &input(t).1)),
        ];
        assert!(rates[0].iter().zip(&rates[1]).all(|(a, b)| (a - b).abs() <= 100.0 * NEAR), "t = {t}: {rates:?}");
        assert!((system.energy(t, &b.q, &b.z) - compiled.energy(t, &a.q, &a.z)).abs() <= 100.0 * NEAR);
    }
}

type None = SVector<f64, 0>;

fn free<I: VectorSpace<f64>>(_: f64) -> ((), I) {
    ((), I::zero())
}

#[test]
fn a_body_in_a_chart_of_its_own() {
    let (compiled, loaded) = (torpedo::Torpedo {}.kernel().expect("a kernel"), kernel(torpedo::SOURCE));
    let pose = Isometry3::new(Vector3::new(0.1, 0.2, 0.3), Vector3::new(0.3, -0.2, 0.5));
    let start = (pose, SVector::from([0.3, -0.2, 0.1, 2.0, -3.0, 1.0]));
    // Room for what there is, and for more.
    compare(&compiled, &loaded.system::<7, 6, None>().expect("room"), start, free);
    compare(&compiled, &loaded.system::<16, 16, SVector<f64, 16>>().expect("room"), start, free);
    let (compiled, loaded) = (car::Car {}.kernel().expect("a kernel"), kernel(car::SOURCE));
    let start = (Isometry2::new(Vector2::new(0.1, 0.2), 0.3), SVector::from([0.3, -0.2, 2.0]));
    compare(&compiled, &loaded.system::<4, 3, None>().expect("room"), start, free);
}

#[test]
fn rotations_and_poses_among_coordinates() {
    let (compiled, loaded) = (carrier::Carrier {}.kernel().expect("a kernel"), kernel(carrier::SOURCE));
    let state = carrier::CarrierState {
        craft: Isometry3::new(Vector3::new(0.1, 0.2, 0.3), Vector3::new(0.3, -0.2, 0.5)),
        head: UnitQuaternion::from_euler_angles(0.4, 0.1, -0.7),
        slide: 0.25,
        ..Default::default()
    };
    let z = SVector::from_fn(|i, _| [0.4, -0.3, 0.2, 1.0, -2.0, 0.5, 0.8, -0.6, 1.1, 0.3][i]);
    compare(&compiled, &loaded.system::<12, 10, None>().expect("room"), (state.q(), z), free);
    compare(&compiled, &loaded.system::<16, 16, None>().expect("room"), (state.q(), z), free);
}

#[test]
fn constraints_are_projected_onto() {
    let (compiled, loaded) = (linkage::Linkage {}.kernel().expect("a kernel"), kernel(linkage::SOURCE));
    let start = (SVector::from([0.6, -0.8, 0.6 + (4.0f64 - 0.64).sqrt()]), SVector::zeros());
    compare(&compiled, &loaded.constrained_system::<3, 3, None>().expect("room"), start, free);
    compare(&compiled, &loaded.constrained_system::<8, 8, None>().expect("room"), start, free);
    let told = loaded.system::<8, 8, None>().expect_err("constraints");
    assert_eq!(told, NoSystem::Has("constraints: `constrained_system` has them"));
    let told = kernel(car::SOURCE).constrained_system::<8, 8, None>().expect_err("none");
    assert_eq!(told, NoSystem::Has("no constraints: `system` is for it"));
    // A state beside the constraints is refused as of compiled kernels.
    let system = loaded.constrained_system::<4, 4, ()>().expect("room");
    let beside = system.configuration(&[0.7, -0.8, 2.0]);
    let kind = Simulation::new(&system).adaptive(1e-9, 1e-9).run(beside, SVector::zeros(), 0.0..1.0);
    let kind = kind.expect_err("beside").kind;
    assert!(matches!(kind, IntegrationErrorKind::InconsistentStart { .. }), "{kind:?}");
}

#[test]
fn states_of_elements_and_kinks() {
    let (compiled, loaded) = (filter::Filter {}.kernel().expect("a kernel"), kernel(filter::SOURCE));
    let start = (SVector::from([0.4, -0.2]), SVector::from([1.5]));
    let pull = |t: f64| (SVector::from([t.sin()]), SVector::from([t.sin(), 0.0, 0.0]));
    compare(&compiled, &loaded.system::<5, 4, SVector<f64, 3>>().expect("room"), start, pull);
    let (compiled, loaded) = (kink::Kink {}.kernel().expect("a kernel"), kernel(kink::SOURCE));
    let system = loaded.system::<1, 1, None>().expect("room");
    assert_eq!(system.smoothness(), Smoothness::Kinks);
    compare(&compiled, &system, (SVector::from([1.0]), SVector::from([0.0])), free);
}

#[test]
fn stiff_scenes_have_their_jacobians() {
    let (compiled, loaded) = (damped::Damped {}.kernel().expect("a kernel"), kernel(damped::SOURCE));
    let system = loaded.system::<8, 8, SVector<f64, 8>>().expect("room");
    let head = UnitQuaternion::from_euler_angles(0.4, 0.1, -0.7);
    let state = damped::DampedState { head, slide: 0.25, ..Default::default() };
    let (q, z) = (state.q(), SVector::from([0.0, 0.3, -0.8, 0.5]));
    let start = system.configuration(&numbers(&q.components()));
    let speeds = SVector::from_fn(|i, _| if i < 4 { z[i] } else { 0.0 });
    // Increments of the head, the slide, then the speeds; behind each kind there is room.
    let (own, wide) = (
        compiled.linearize(0.0, &q, &z, &SVector::from([2.0])),
        system.linearize(0.0, &start, &speeds, &SVector::from([2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])),
    );
    let place = |k: usize| if k < 8 { Some(k).filter(|k| *k < 4) } else { Some(k - 4).filter(|k| *k < 8) };
    for i in 0..16 {
        for j in 0..16 {
            let expected = place(i).zip(place(j)).map_or(0.0, |(i, j)| own.by_state(i, j));
            let found = wide.by_state(i, j);
            assert!((found - expected).abs() <= 1e-10 * expected.abs().max(1.0), "({i}, {j}): {found} for {expected}");
        }
        let expected = place(i).map_or(0.0, |i| own.by_input(i, 0));
        assert!((wide.by_input(i, 0) - expected).abs() <= 1e-12 && wide.by_input(i, 1) == 0.0);
        assert!(wide.by_time()[i] == 0.0);
    }
    // Vectors that no configuration made do not know their groups: no bracket of theirs is right, and none is given.
    assert!(error_matrix::<System<'_, 8, 8, SVector<f64, 8>>>(&wide).iter().any(|x| x.is_nan()));
    let push = |_: f64, _: &_, _: &_| SVector::from([2.0]);
    let expected = Simulation::new(&compiled).control(Adaptive::by(Rosenbrock, 1e-8, 1e-8)).input(push);
    let expected = expected.run(q, z, 0.0..2.0).expect("a compiled run");
    let push = |_: f64, _: &_, _: &_| SVector::from([2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let tolerance = 1e-8 * system.share();
    let found = Simulation::new(&system).control(Adaptive::by(Rosenbrock, tolerance, tolerance)).input(push);
    let found = found.run(start, speeds, 0.0..2.0).expect("a run");
    // An explicit method takes 2 s · 2e5 / 3.3 steps at least.
    let counts = [expected.summary().steps, found.summary().steps];
    assert!(counts[0].abs_diff(counts[1]) <= 1 + counts[0] / 10 && counts[1] < 2000, "{counts:?}");
    let own = numbers(&expected.last().q.components());
    for (own, found) in own.iter().zip(found.last().q.as_slice()) {
        assert!((own - found).abs() < 1e-6, "{found} for {own}");
    }
}

#[test]
fn room_is_compared_with_sizes() {
    let loaded = kernel(carrier::SOURCE);
    let told = loaded.system::<12, 9, None>().expect_err("too little");
    assert_eq!(told, NoSystem::Sizes { expected: [12, 10, 0], found: [12, 9, 0] });
    let balls: String = (0..32).map(|k| format!("r{k}: Rotation, ")).collect();
    let bodies: String = (0..32).map(|k| format!("body(b{k}, rotation = r{k}, mass = 1, inertia = 1), ")).collect();
    let many = kernel(&format!("#[gauss(coordinates({balls}), {bodies})] struct Balls {{}}"));
    let told = many.system::<128, 96, None>().expect_err("too many");
    assert_eq!(told, NoSystem::Has("more than 31 rotations and poses"));
}
