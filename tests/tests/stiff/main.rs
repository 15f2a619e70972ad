//! Methods with Jacobians on kernels: their orders in every kind of scene, what they do where scenes are stiff, and
//! what they refuse.

mod derivatives;
mod scenes;

use std::f64::consts::PI;

use gauss_runtime::integrate::{
    Collocation, EstimatingStep, Fixed, Form, InputSource, NoInput, OneStep, Problem, Radau, RunPart, State,
    SystemProblem,
};
use gauss_runtime::prelude::*;

/// So many steps of one length.
fn march<S: GaussSystem<Scalar = f64>>(
    method: &impl OneStep<S>,
    problem: &impl Problem<System = S>,
    start: &State<S>,
    span: f64,
    steps: u32,
) -> State<S> {
    let mut state = *start;
    let h = span / f64::from(steps);
    for n in 0..steps {
        state.t = start.t + f64::from(n) * h;
        let rates = problem.rates(&state);
        state = method.step(problem, &state, &rates, h).expect("steps").state;
    }
    state
}

/// The least-squares slope of log error against log step, where the errors are far above rounding, over runs of one
/// unit of time. The exact end is that of Gauss' method of order 6 with steps a tenth of the shortest of the other two.
fn slope<S: LinearizedSystem<Scalar = f64>>(
    method: &impl OneStep<S>,
    problem: &impl Problem<System = S>,
    (start, exact): (&State<S>, &State<S>),
    counts: [u32; 5],
) -> f64 {
    let points = counts.map(|n| {
        let end = march(method, problem, start, 1.0, n);
        let error = end.q.difference(&exact.q).max_norm().max(end.y.add_scaled(-1.0, &exact.y).max_norm());
        assert!(error > 1e-12, "{error:e} is rounding");
        (f64::from(n).ln(), error.ln())
    });
    let count = points.len() as f64;
    let (mx, my) = (points.iter().map(|p| p.0).sum::<f64>() / count, points.iter().map(|p| p.1).sum::<f64>() / count);
    -points.iter().map(|(x, y)| (x - mx) * (y - my)).sum::<f64>()
        / points.iter().map(|(x, _)| (x - mx).powi(2)).sum::<f64>()
}

/// Slopes tend to the order as steps tend to 0: what they differ by is the share of the next term of the error, a third
/// at most with these steps.
fn orders<S: LinearizedSystem<Scalar = f64>, F: Form<S>, I: InputSource<S> + Copy>(
    what: &str,
    system: &S,
    (form, input): (F, I),
    q: S::Configuration,
    z: S::Speeds,
) {
    let problem = SystemProblem { system, form, input };
    let start = problem.state(0.3, q, &z);
    let exact = march(&Collocation::order_6(), &problem, &start, 1.0, 1600);
    let four = slope(&Rosenbrock, &problem, (&start, &exact), [40, 56, 80, 112, 160]);
    assert!((four - 4.0).abs() < 0.35, "{what}: {four}");
    let five = slope(&Radau, &problem, (&start, &exact), [10, 14, 20, 28, 40]);
    assert!((five - 5.0).abs() < 0.35, "{what}: {five}");
}

macro_rules! tossed {
    ($name:ident, [$($chart:tt)+], $motion:ident) => {
        /// A body with a thruster, in wind that changes with time.
        #[derive(GaussDynamics)]
        #[gauss(
            linearize,
            chart = $($chart)+,
            motion = $motion,
            medium(velocity = [cos(t), 0.5 * sin(t), 0]),
            input(thrust),
            force(at = [0.3, -0.2, 0], value = [thrust, 0.5 * thrust, 0]),
            torque(body = body, value = [sin(t), 0.3, cos(2 * t)]),
            drag(linear = [1, 1, 2, 1, 1, 1]),
        )]
        struct $name {
            #[gauss(mass)]
            m: f64,
            #[gauss(center_of_mass)]
            center: Vector3<f64>,
            #[gauss(inertia)]
            inertia: Vector3<f64>,
            #[gauss(gravity)]
            g: f64,
        }

        impl $name {
            fn new() -> Self {
                Self { m: 1.0, center: Vector3::new(0.1, 0.2, 0.05), inertia: Vector3::new(1.0, 1.6, 2.0), g: 4.0 }
            }
        }
    };
}

tossed!(Left, [left_invariant], free);
tossed!(Right, [right_invariant], free);
tossed!(Hybrid, [hybrid], free);
tossed!(Euler, [jet(euler_zyx)], free);
tossed!(Held, [left_invariant], fixed_point);
tossed!(Plane, [right_invariant], planar);

/// A control law that depends on everything.
#[derive(Clone, Copy)]
struct Law;

impl<S: GaussSystem<Scalar = f64, Input = SVector<f64, 1>>> InputSource<S> for Law {
    fn input(&self, t: f64, q: &S::Configuration, z: &S::Speeds) -> SVector<f64, 1> {
        let last = S::Speeds::DIM - 1;
        SVector::from([(3.0 * t).sin() - 2.0 * z.component(last) * z.component(0) + 0.5 * q.magnitude(0)])
    }
}

#[test]
fn orders_in_every_chart_with_feedback() {
    let z = SVector::from([0.5, -0.3, 0.2, 1.0, -0.8, 1.2]);
    let pose =
        Isometry3::from_parts(Translation3::new(1.0, 2.0, -1.0), UnitQuaternion::from_euler_angles(0.3, -0.5, 1.0));
    let (left, law) = (Left::new().kernel().unwrap(), (VelocityForm, Law));
    orders("left", &left, law, pose, z);
    orders("left, momenta", &left, (MomentumForm, Law), pose, z);
    orders("right", &Right::new().kernel().unwrap(), law, pose, z);
    orders("hybrid", &Hybrid::new().kernel().unwrap(), law, pose, z);
    let angles = SVector::from([1.0, 2.0, -1.0, 0.3, -0.5, 0.4]);
    orders("Euler angles", &Euler::new().kernel().unwrap(), law, angles, z);
    orders("held", &Held::new().kernel().unwrap(), law, pose.rotation, SVector::from([1.0, -0.8, 1.2]));
    let plane = Isometry2::new(SVector::from([1.0, 2.0]), 0.7);
    orders("plane", &Plane::new().kernel().unwrap(), law, plane, SVector::from([0.5, -0.3, 1.2]));
}

/// A hull with a rotor on a sliding axle.
#[derive(GaussDynamics)]
#[gauss(
    linearize,
    coordinates(s, base: Pose, wheel: Rotation),
    body(hull, position = base.position, rotation = base.rotation),
    body(rotor, parent = hull, position = [0.2, 0, s], rotation = wheel),
    torque(body = rotor, value = [0, sin(3 * t), 1], reaction = hull),
    spring(along = s, stiffness = 20, length = 0.3, damping = 1),
    drag(body = hull, linear = [1, 2, 1, 2, 1, 2]),
)]
struct Gyrostat {
    #[gauss(body)]
    hull: RigidBody<f64>,
    #[gauss(body)]
    rotor: RigidBody<f64>,
}

/// A pendulum as a particle on a sphere.
#[derive(GaussDynamics)]
#[gauss(
    linearize,
    coordinates(x, y, z),
    particle(mass = 1, position = [x, y, z]),
    constraint(position = x * x + y * y + z * z - 1),
    force(at = [x, y, z], value = [-0.2 * rate(x), -0.2 * rate(y), -0.2 * rate(z)]),
)]
struct Bob {
    #[gauss(gravity)]
    g: f64,
}

#[test]
fn orders_of_systems() {
    let body = |mass: f64, x: f64| RigidBody {
        mass,
        center_of_mass: Vector3::new(x, 0.1, 0.0),
        inertia: Matrix3::from_diagonal(&Vector3::new(1.0, 1.5, 2.0)),
    };
    let kernel = Gyrostat { hull: body(2.0, 0.1), rotor: body(1.0, -0.2) }.kernel().unwrap();
    let q = (Isometry3::identity(), (UnitQuaternion::identity(), SVector::from([0.5])));
    let z = SVector::from([0.5, 0.3, -0.2, 0.4, 0.6, -0.5, 0.7, 0.2, -0.4, 1.5]);
    let free = (VelocityForm, NoInput);
    orders("gyrostat", &kernel, free, q, z);
    // Ends off the sphere are compared as they are: the accelerations of the whole space are integrated to the order.
    let bob = Bob { g: 9.81 }.kernel().unwrap();
    orders("bob", &bob, free, SVector::from([1.0, 0.0, 0.0]), SVector::from([0.0, 1.5, 0.5]));
}

/// Brought back onto the sphere after each step.
#[test]
fn constraints_are_kept() {
    let bob = Bob { g: 9.81 }.kernel().unwrap();
    let (q, z) = (SVector::from([1.0, 0.0, 0.0]), SVector::from([0.0, 1.5, 0.5]));
    let runs = [
        Simulation::new(&bob).control(Fixed::by(Rosenbrock, 0.01)).run(q, z, 0.0..5.0).unwrap(),
        Simulation::new(&bob).control(Fixed::by(Radau, 0.01)).run(q, z, 0.0..5.0).unwrap(),
    ];
    for run in runs {
        let worst = run.iter().map(|s| (s.q.norm_squared() - 1.0).abs().max(s.q.dot(&s.z).abs())).fold(0.0, f64::max);
        // Residuals of three products of numbers up to 5.
        assert!(worst < 1e-14, "{worst:e}");
    }
}

/// A ball in a liquid so thick that it sinks steadily after a millionth of a step.
#[derive(GaussDynamics)]
#[gauss(linearize, drag(linear = drag))]
struct Sinking {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: f64,
    #[gauss(gravity)]
    g: f64,
    drag: Vector6<f64>,
}

/// R(∞) = 0: u̇ = −g − rate·u is left at −g/rate by one step, whatever it was. The stability functions at hλ = −10⁶
/// are of order 1/hλ, with a constant of about 10.
#[test]
fn what_decays_fast_is_gone_after_a_step() {
    fn check(method: impl OneStep<SinkingKernel> + Copy) {
        let rate = 1e6;
        let kernel = Sinking { mass: 1.0, inertia: 1.0, g: 9.81, drag: Vector6::from_element(rate) }.kernel().unwrap();
        let run = Simulation::new(&kernel).control(Fixed::by(method, 1.0));
        let start = Vector6::from([0.3, -0.2, 0.5, 0.1, 0.2, -0.3]);
        let one = run.run_to_end(Isometry3::identity(), start, 0.0..1.0).unwrap();
        assert!(one.z.amax() < 1e-4, "{}", one.z);
        let end = run.run_to_end(Isometry3::identity(), start, 0.0..20.0).unwrap();
        let speed = (end.q.rotation * Vector3::new(end.z[0], end.z[1], end.z[2])).z;
        assert!((speed * rate / 9.81 + 1.0).abs() < 1e-9, "{speed:e}");
    }
    check(Rosenbrock);
    check(Radau);
}

/// A particle that falls off a parabola: ẍ = x.
#[derive(GaussDynamics)]
#[gauss(linearize, coordinates(x), particle(mass = m, position = [x, 0, 0]), potential = -0.5 * m * x * x)]
struct Falling {
    m: f64,
}

#[test]
fn refusals_say_what_is_wrong() {
    // 1/(γh) = 1 is an eigenvalue of the Jacobian: no solution, and no number in silence.
    let falling = Falling { m: 1.0 }.kernel().unwrap();
    let run = Simulation::new(&falling).control(Fixed::by(Rosenbrock, 4.0));
    let error = run.run_to_end(SVector::from([1.0]), SVector::from([0.0]), 0.0..4.0).unwrap_err();
    assert_eq!(error.kind, IntegrationErrorKind::NonFinite { part: RunPart::Step });
    // More than half a turn in a stage.
    let kernel = Sinking { mass: 1.0, inertia: 1.0, g: 0.0, drag: Vector6::zeros() }.kernel().unwrap();
    let spin = Vector6::from([0.0, 0.0, 0.0, 0.0, 0.0, 10.0]);
    let run = Simulation::new(&kernel).control(Fixed::by(Rosenbrock, 1.0));
    let error = run.run_to_end(Isometry3::identity(), spin, 0.0..1.0).unwrap_err();
    assert!(matches!(error.kind, IntegrationErrorKind::IncrementTooLarge { angle } if angle > PI), "{error}");
    let run = Simulation::new(&kernel).control(Fixed::by(Rosenbrock, f64::NAN));
    assert!(run.run_to_end(Isometry3::identity(), spin, 0.0..1.0).is_err());
}

#[test]
fn refusals_of_newtons_iteration() {
    // The real eigenvalue of the method, over h, is one of the Jacobian: no solution, and no number in silence.
    let falling = Falling { m: 1.0 }.kernel().unwrap();
    let end = |h: f64| {
        let run = Simulation::new(&falling).control(Fixed::by(Radau, h));
        run.run_to_end(SVector::from([1.0]), SVector::from([0.0]), 0.0..h)
    };
    assert!(end(1.0).is_ok());
    let error = end(f64::NAN).unwrap_err();
    assert!(matches!(error.kind, IntegrationErrorKind::InvalidStep { .. }), "{error}");
    // A turn that a step of this length cannot tell, and a pendulum that turns over twice in it.
    let kernel = Sinking { mass: 1.0, inertia: 1.0, g: 0.0, drag: Vector6::zeros() }.kernel().unwrap();
    let spin = Vector6::from([0.0, 0.0, 0.0, 0.0, 0.0, 10.0]);
    let error =
        Simulation::new(&kernel).control(Fixed::by(Radau, 1.0)).run_to_end(Isometry3::identity(), spin, 0.0..1.0);
    let error = error.unwrap_err();
    assert!(matches!(error.kind, IntegrationErrorKind::IncrementTooLarge { angle } if angle > PI), "{error}");
    let swing = Swing { g: 9.81 }.kernel().unwrap();
    let start = ([3.0].into(), [5.0].into());
    let error = Simulation::new(&swing).control(Fixed::by(Radau, 2.5)).run_to_end(start.0, start.1, 0.0..10.0);
    let error = error.unwrap_err();
    assert!(matches!(error.kind, IntegrationErrorKind::NotConverged { iterations: 2.., .. }), "{error}");
    // A shorter step converges: steps that are as long as tolerances allow find it.
    let adaptive = Adaptive::by(Radau, 1e-8, 1e-8).first_step(2.5);
    let found = Simulation::new(&swing).control(adaptive).run_to_end(start.0, start.1, 0.0..10.0).unwrap();
    let exact = Simulation::new(&swing).adaptive(1e-13, 1e-13).run_to_end(start.0, start.1, 0.0..10.0).unwrap();
    // Errors of some hundred steps add up, and those of the speed grow with the time.
    assert!((found.q[0] - exact.q[0]).abs() < 1e-5, "{}", found.q[0] - exact.q[0]);
}

/// A pendulum.
#[derive(GaussDynamics)]
#[gauss(linearize, coordinates(angle), particle(mass = 1, position = [sin(angle), 0, -cos(angle)]))]
struct Swing {
    #[gauss(gravity)]
    g: f64,
}

/// A capsule on a weak spring in oil: its own motions die out within 1/rate, and then it creeps.
#[derive(GaussDynamics)]
#[gauss(
    linearize,
    drag(linear = [c, c, 2 * c, c, c, c]),
    spring(from = [1, 2, 3], to = body.position + body.rotation * [0, 0, 0.3], stiffness = k),
)]
struct Capsule {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
    #[gauss(center_of_mass)]
    center: Vector3<f64>,
    #[gauss(gravity)]
    g: f64,
    c: f64,
    k: f64,
}

#[test]
fn adaptive_steps_know_nothing_of_stiffness() {
    fn check(method: impl EstimatingStep<CapsuleKernel> + Copy) {
        let run = |c: f64, tolerance: f64| {
            let (inertia, center) = (Vector3::new(1.0, 1.2, 0.8), Vector3::new(0.0, 0.01, -0.02));
            let kernel = Capsule { m: 1.0, inertia, center, g: 9.81, c, k: 0.1 * c }.kernel().unwrap();
            let control = Adaptive::by(method, tolerance, tolerance);
            let spin = Vector6::from([0.1, 0.0, 0.0, 0.0, 0.3, 0.0]);
            let run = Simulation::new(&kernel).control(control).run(Isometry3::identity(), spin, 0.0..10.0).unwrap();
            (run.last().q, run.len() - 1)
        };
        for c in [1e2, 1e4, 1e6] {
            let (exact, _) = run(c, 1e-11);
            for tolerance in [1e-4, 1e-6, 1e-8] {
                let (end, steps) = run(c, tolerance);
                let error = exact.difference(&end).amax();
                // Errors of steps add up, and none grows: all motions are damped.
                assert!(error < steps as f64 * tolerance, "{c:e}, {tolerance:e}: {error:e} in {steps} steps");
                // The fourth root of the tolerance, times what there is to see; an explicit method would need 2c steps.
                let most = 5.0 * tolerance.powf(-0.25);
                assert!((steps as f64) < most, "{c:e}, {tolerance:e}: {steps} steps, more than {most}");
            }
        }
    }
    check(Rosenbrock);
    check(Radau);
}

#[test]
fn a_capsule_in_oil_by_all_methods() {
    let (inertia, center) = (Vector3::new(1.0, 1.2, 0.8), Vector3::new(0.0, 0.01, -0.02));
    let kernel = Capsule { m: 1.0, inertia, center, g: 9.81, c: 1e4, k: 1e3 }.kernel().unwrap();
    let start = (Isometry3::identity(), Vector6::from([0.1, 0.0, 0.0, 0.0, 0.3, 0.0]));
    for [radau, rosenbrock, explicit] in scenes::compare("capsule in oil", &kernel, start, 10.0) {
        assert!(radau.steps.max(rosenbrock.steps) * 20 < explicit.steps);
    }
}
