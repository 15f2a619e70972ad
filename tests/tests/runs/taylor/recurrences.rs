//! The series of one state against a Runge–Kutta method that knows nothing of series, for every operation that programs
//! have.

use gauss_runtime::integrate::{NoInput, OneStep, Problem, Rkmk, State, SystemProblem};
use gauss_runtime::prelude::*;
use gauss_runtime::series::{MAX_ORDER, PowerSeries, state_of};

/// τ beside the radius of convergence: terms fall below rounding just at the highest order, so that each order counts.
const FRACTION: f64 = 0.3;
const STEPS: u32 = 100;

/// The state a time τ after `start` by many short steps of order 8, whose local errors are (0.3/100)⁹ and less.
fn by_short_steps<S: TaylorSystem<Scalar = f64>>(system: &S, start: &State<S>, tau: f64) -> State<S> {
    let method = Rkmk::new(&Tableau::DORMAND_PRINCE_8);
    let problem = SystemProblem { system, form: VelocityForm, input: NoInput };
    let h = tau / f64::from(STEPS);
    let mut state = *start;
    for n in 1..=STEPS {
        state = method.step(&problem, &state, &problem.rates(&state), h).expect("steps").state;
        state.t = start.t + f64::from(n) * h;
    }
    state
}

/// The largest component of the coefficients of order k.
fn size<S: TaylorSystem<Scalar = f64>>(series: &S::Series, k: usize) -> f64 {
    series.coefficient(k).max_norm()
}

/// Forwards and backwards, from a time that is not zero.
fn agrees<S: TaylorSystem<Scalar = f64>>(system: &S, q: S::Configuration, z: S::Speeds) {
    let (q, z) = system.project(0.3, &q, &z).expect("a state of the system");
    let start = State { t: 0.3, q: q.renormalise(), y: z };
    let mut series = S::Series::zero();
    system.expand(start.t, &start.q, &start.y, MAX_ORDER, &mut series);
    assert_eq!(S::GROUPS.iter().sum::<usize>(), <S::Series as PowerSeries<f64>>::Variables::DIM);

    // The same coefficients, whatever was in the arrays before and wherever the series ends.
    let (mut shorter, reached) = (series_of_rubbish::<S>(system, &start), MAX_ORDER / 2);
    system.expand(start.t, &start.q, &start.y, reached, &mut shorter);
    for k in 0..=reached {
        let difference = series.coefficient(k).add_scaled(-1.0, shorter.coefficient(k));
        assert_eq!(difference.max_norm(), 0.0, "order {k}");
    }

    let scale = size::<S>(&series, 0).max(1.0);
    let radius = (MAX_ORDER / 2..=MAX_ORDER).map(|k| (scale / size::<S>(&series, k)).powf(1.0 / k as f64));
    let radius = radius.fold(f64::INFINITY, f64::min);
    assert!(radius.is_finite(), "the motion goes on");
    for tau in [FRACTION * radius, -FRACTION * radius] {
        let (q, z) = state_of::<S>(&series.at(MAX_ORDER, tau));
        let expected = by_short_steps(system, &start, tau);
        let apart = expected.q.difference(&q.renormalise()).max_norm();
        let apart = apart.max(expected.y.add_scaled(-1.0, &z).max_norm());
        // Each short step leaves some roundings of the state and of the rates times h. What the series leaves out,
        // 0.3³¹ of the size and a little more, is less. A coefficient of order k that is wrong by a part in ten shows
        // as 0.1·0.3ᵏ.
        let rates = size::<S>(&series, 1) * tau.abs();
        let allowed = f64::from(STEPS) * 8.0 * f64::EPSILON * (scale + rates);
        assert!(apart <= allowed, "{apart:e} > {allowed:e} at τ = {tau}");
    }
}

/// Arrays that have been used for another state.
fn series_of_rubbish<S: TaylorSystem<Scalar = f64>>(system: &S, start: &State<S>) -> S::Series {
    let mut series = S::Series::zero();
    let other = start.y.scale(-3.7);
    system.expand(start.t + 1.0, &start.q, &other, MAX_ORDER, &mut series);
    series
}

/// A heavy body with O off the centre of mass in some charts, and in its other motions.
macro_rules! bodies {
    ($($name:ident [$($clause:tt)+])+) => {$(
        #[derive(GaussDynamics)]
        #[gauss($($clause)+, taylor)]
        struct $name {
            #[gauss(mass)]
            mass: f64,
            #[gauss(center_of_mass)]
            center: Vector3<f64>,
            #[gauss(inertia)]
            inertia: Matrix3<f64>,
            #[gauss(gravity)]
            gravity: Vector3<f64>,
        }

        impl $name {
            fn example() -> Self {
                Self {
                    mass: 1.3,
                    center: Vector3::new(0.2, -0.1, 0.15),
                    inertia: Matrix3::new(1.0, 0.1, -0.05, 0.1, 1.4, 0.2, -0.05, 0.2, 0.9),
                    gravity: Vector3::new(0.3, -0.4, -9.7),
                }
            }
        }
    )+};
}

bodies! {
    Left [chart = left_invariant]
    Right [chart = right_invariant]
    Hybrid [chart = hybrid]
    Euler [chart = jet(euler_zyx)]
    Modified [chart = jet(modified_rodrigues)]
    Pivoted [motion = fixed_point]
    PivotedRight [motion = fixed_point, chart = right_invariant]
    PivotedRodrigues [motion = fixed_point, chart = jet(rodrigues)]
    Plane [motion = planar]
    PlaneAngle [motion = planar, chart = jet]
}

fn pose() -> Isometry3<f64> {
    Isometry3 {
        rotation: UnitQuaternion::from_euler_angles(0.4, -0.7, 1.1),
        translation: Translation3::new(0.5, -0.3, 0.8),
    }
}

#[test]
fn of_a_heavy_body_in_every_chart() {
    let z = SVector::from([0.3, -0.5, 0.2, 1.1, -0.8, 0.6]);
    agrees(&Left::example().kernel().expect("a body"), pose(), z);
    agrees(&Right::example().kernel().expect("a body"), pose(), z);
    agrees(&Hybrid::example().kernel().expect("a body"), pose(), z);
    let angles = SVector::from([0.5, -0.3, 0.8, 0.4, -0.7, 1.1]);
    agrees(&Euler::example().kernel().expect("a body"), angles, z);
    agrees(&Modified::example().kernel().expect("a body"), angles * 0.3, z * 0.5);
}

#[test]
fn about_a_point_and_in_the_plane() {
    let omega = Vector3::new(1.1, -0.8, 0.6);
    agrees(&Pivoted::example().kernel().expect("a body"), pose().rotation, omega);
    agrees(&PivotedRight::example().kernel().expect("a body"), pose().rotation, omega);
    agrees(&PivotedRodrigues::example().kernel().expect("a body"), SVector::from([0.2, -0.3, 0.4]), omega);
    let plane = Isometry2::new(nalgebra_vector([0.4, -0.2]), 0.9);
    agrees(&Plane::example().kernel().expect("a body"), plane, Vector3::new(0.3, -0.5, 1.2));
    agrees(
        &PlaneAngle::example().kernel().expect("a body"),
        SVector::from([0.4, -0.2, 0.9]),
        Vector3::new(0.3, -0.5, 1.2),
    );
}

fn nalgebra_vector(components: [f64; 2]) -> SVector<f64, 2> {
    SVector::from(components)
}

/// Fluid, attraction to a moving center, a stream, drag that depends on the speed by a root.
#[derive(GaussDynamics)]
#[gauss(
    taylor,
    medium(velocity = [c * sin(2 * t), 0.1 * exp(-t), c]),
    central_gravity(mu = gm, center = [3, 0, cos(t)]),
    drag(linear = [d, 2 * d, d * hypot(1, body.relative_velocity.x), d, d, d]),
    force(body = body, value = [0, ln(2 + t * t), tan(t / 3)], axes = observer),
)]
struct Submerged {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
    #[gauss(added_mass)]
    added: Vector6<f64>,
    #[gauss(displaced_mass)]
    displaced: f64,
    #[gauss(center_of_buoyancy)]
    buoyancy: Vector3<f64>,
    #[gauss(gravity)]
    gravity: f64,
    c: f64,
    d: f64,
    gm: f64,
}

#[test]
fn of_roots_exponentials_logarithms_and_quotients() {
    let body = Submerged {
        mass: 2.0,
        inertia: Vector3::new(0.5, 0.7, 0.8),
        added: Vector6::new(0.3, 1.2, 1.1, 0.05, 0.2, 0.1),
        displaced: 1.9,
        buoyancy: Vector3::new(0.0, 0.02, 0.1),
        gravity: 9.81,
        c: 0.4,
        d: 0.6,
        gm: 2.0,
    };
    agrees(&body.kernel().expect("a body"), pose(), SVector::from([0.3, -0.5, 0.2, 1.1, -0.8, 0.6]));
}

/// A chain with relative angles, a torsion spring whose law needs an angle from its sine and cosine, and a motor.
#[derive(GaussDynamics)]
#[gauss(
    taylor,
    coordinates(a, b),
    body(upper, rotation = rotation_y(-a)),
    body(lower, parent = upper, position = [0, 0, -l], rotation = rotation_x(b)),
    potential = k * atan2(sin(a) + 0.3, 2 + cos(b)),
    drive(a = k * sin(3 * t) - c * a.sin()),
)]
struct Chain {
    #[gauss(body)]
    upper: RigidBody<f64>,
    #[gauss(body)]
    lower: RigidBody<f64>,
    l: f64,
    k: f64,
    c: f64,
    #[gauss(gravity)]
    g: f64,
}

fn rod() -> RigidBody<f64> {
    RigidBody {
        mass: 0.8,
        center_of_mass: Vector3::new(0.02, 0.0, -0.3),
        inertia: Matrix3::new(0.1, 0.0, 0.005, 0.0, 0.11, 0.0, 0.005, 0.0, 0.02),
    }
}

#[test]
fn of_a_chain_with_an_arc_tangent() {
    let chain = Chain { upper: rod(), lower: rod(), l: 0.6, k: 0.9, c: 0.2, g: 9.81 };
    agrees(&chain.kernel().expect("a chain"), SVector::from([0.5, -0.8]), SVector::from([1.2, -0.7]));
}

/// A pose, a rotation and scalars as coordinates, with a constraint that multipliers enforce.
#[derive(GaussDynamics)]
#[gauss(
    taylor,
    coordinates(x, pose: Pose, attitude: Rotation),
    body(hull, position = pose.position, rotation = pose.rotation),
    body(ball, parent = hull, position = [0, 0, 0.4], rotation = attitude),
    particle(mass = m, position = [x, 0, 0]),
    point(hook, body = hull, at = [0.1, 0.2, 0]),
    constraint(position = dot(hook - [x, 0, 0], hook - [x, 0, 0]) - 1),
)]
struct Coupled {
    #[gauss(body)]
    hull: RigidBody<f64>,
    #[gauss(body)]
    ball: RigidBody<f64>,
    m: f64,
    #[gauss(gravity)]
    g: f64,
}

#[test]
fn of_products_of_groups_with_multipliers() {
    let kernel = Coupled { hull: rod(), ball: rod(), m: 0.4, g: 9.81 }.kernel().expect("a system");
    let q = (pose(), (UnitQuaternion::from_euler_angles(-0.3, 0.2, 0.5), SVector::from([1.2])));
    let z = SVector::from([0.2, 0.3, -0.5, 0.2, 1.1, -0.8, 0.6, 0.4, -0.3, 0.9]);
    agrees(&kernel, q, z);
}

/// Rolling solved for dependent speeds.
#[derive(GaussDynamics)]
#[gauss(
    taylor,
    coordinates(x, y, attitude: Rotation),
    speeds(vx, vy, w1, w2, w3),
    kinematics(x = vx, y = vy, attitude = inverse(attitude) * [w1, w2, w3]),
    frame(table, rotation = rotation_z(spin * t)),
    body(ball, position = [x, y, r], rotation = attitude),
    constraint(velocity = ball.velocity - cross(ball.angular_velocity, [0, 0, r])
        - cross(table.angular_velocity, ball.position)),
    independent(vx, vy, w3),
)]
struct Rolling {
    #[gauss(body)]
    ball: RigidBody<f64>,
    r: f64,
    spin: f64,
    #[gauss(gravity)]
    g: f64,
}

#[test]
fn of_dependent_speeds() {
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.1, 0.13, 0.15));
    let ball = RigidBody { mass: 1.1, center_of_mass: Vector3::zeros(), inertia };
    let kernel = Rolling { ball, r: 0.5, spin: 0.7, g: 9.81 }.kernel().expect("a ball");
    agrees(&kernel, (pose().rotation, SVector::from([0.3, -0.2])), Vector3::new(0.4, -0.6, 1.3));
}

/// Any scalar: packs of numbers and single precision go through the same code.
#[derive(GaussDynamics)]
#[gauss(taylor, motion = fixed_point)]
struct Generic<T> {
    #[gauss(mass)]
    mass: T,
    #[gauss(center_of_mass)]
    center: Vector3<T>,
    #[gauss(inertia)]
    inertia: Vector3<T>,
    #[gauss(gravity)]
    gravity: T,
}

fn generic<T: Real>() -> GenericKernel<T> {
    let vector = |v: [f64; 3]| Vector3::from(v.map(T::from_f64));
    let (mass, gravity) = (T::from_f64(1.0), T::from_f64(9.8125));
    Generic { mass, center: vector([0.0, 0.125, 0.5]), inertia: vector([1.0, 1.5, 0.5]), gravity }
        .kernel()
        .expect("a top")
}

#[test]
fn in_single_precision() {
    let (mut double, mut single) =
        (<GenericKernel<f64> as TaylorSystem>::Series::zero(), <GenericKernel<f32> as TaylorSystem>::Series::zero());
    let omega = [0.5, -1.25, 2.0];
    generic::<f64>().expand(0.0, &UnitQuaternion::identity(), &Vector3::from(omega), 12, &mut double);
    let omega = Vector3::from(omega.map(|x| x as f32));
    generic::<f32>().expand(0.0, &UnitQuaternion::identity(), &omega, 12, &mut single);
    for k in 0..=12 {
        let (double, single) = (double.coefficient(k), single.coefficient(k));
        let difference = (0..7).map(|i| (double[i] - f64::from(single[i])).abs()).fold(0.0, f64::max);
        // Of the sums over k + 1 products that each order has, and of all orders before it.
        let allowed = f64::from(f32::EPSILON) * 8.0 * ((k + 1) * (k + 1)) as f64 * double.amax().max(1.0);
        assert!(difference <= allowed, "order {k}: {difference:e} > {allowed:e}");
    }
}
