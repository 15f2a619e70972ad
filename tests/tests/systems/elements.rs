//! Elements one by one against closed forms: springs and stops along a coordinate, the functions that are not smooth,
//! wrenches at run time; what elements are called, and how smooth a scene is.

use gauss_runtime::prelude::*;

/// A wheel on a torsion spring with a damper.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(theta),
    body(rotation = rotation_z(theta)),
    spring(torsion, along = theta, stiffness = k, length = rest, damping = c)
)]
struct Balance {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: f64,
    k: f64,
    rest: f64,
    c: f64,
}

#[test]
fn a_torsion_spring_has_its_closed_form() {
    let (inertia, k, rest, c) = (0.4, 3.0, 0.7, 0.25);
    let kernel = Balance { mass: 1.0, inertia, k, rest, c }.kernel().unwrap();
    for (theta, rate) in [(0.7, 0.0), (2.5, -1.5), (-40.0, 3.0)] {
        let (q, z, t) = (SVector::from([theta]), SVector::from([rate]), 0.0);
        let (turned, exact) =
            (theta - rest, |a: f64, b: f64| (a - b).abs() <= 8.0 * f64::EPSILON * b.abs().max(1e-300));
        assert!(exact(kernel.acceleration(t, &q, &z, &())[0], -(k * turned + c * rate) / inertia), "{theta}");
        assert!(exact(kernel.potential_energy(t, &q), 0.5 * k * turned * turned), "{theta}");
        // One element: the power of the spring, and of its damper, which alone changes the energy.
        let (spring, damper) = (-k * turned * rate, -c * rate * rate);
        let power = kernel.power("torsion", t, &q, &z, &()).unwrap();
        assert!((power - spring - damper).abs() <= 8.0 * f64::EPSILON * (spring.abs() + damper.abs()), "{theta}");
        assert!(exact(kernel.supplied_power(t, &q, &z, &()), damper), "{theta}");
    }
}

/// A mass between two stops with dampers.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    particle(mass = 1, position = [x, 0, 0]),
    stop(along = x, least = low, most = high, stiffness = k, width = w, damping = c)
)]
struct Stopped {
    low: f64,
    high: f64,
    k: f64,
    w: f64,
    c: f64,
}

/// `s = (x + √(x² + w²))/2` is x ≤ s ≤ x + w²/4x far beyond a limit and 0 ≤ s ≤ w²/4|x| far before it. With x = w sinh
/// a the force is k s ds/dx = (k w/2) e^(2a)/(e^a + e^(−a)), which beyond the limit is k x/(1 − e^(−4a)), and e^|a| ≥
/// 2|x|/w.
#[test]
fn a_stop_is_a_spring_beyond_its_limits_and_nothing_between_them() {
    let (low, high, k, w, c) = (-1.0, 2.0, 50.0, 0.01, 3.0);
    let kernel = Stopped { low, high, k, w, c }.kernel().unwrap();
    let state = |x: f64| {
        // At rest the damper does nothing; it alone changes the energy.
        let (q, rest, z) = (SVector::from([x]), SVector::from([0.0]), SVector::from([1.5]));
        let force = kernel.generalised_force("stop", 0.0, &q, &rest, &()).unwrap()[0];
        (kernel.potential_energy(0.0, &q), force, kernel.supplied_power(0.0, &q, &z, &()))
    };
    // Beyond: 0.1, 1 and 50 past either limit. A spring, and a damper with all of c; the other limit adds what it may.
    let rounding = 1e-13;
    for beyond in [0.1, 1.0, 50.0] {
        let (here, there) = (w / (2.0 * beyond), w / (2.0 * (beyond + high - low)));
        for (x, sign) in [(high + beyond, -1.0), (low - beyond, 1.0)] {
            let (energy, force, power) = state(x);
            let least = 0.5 * k * beyond * beyond;
            let most = 0.5 * k * ((beyond + w * here / 2.0).powi(2) + (w * there / 2.0).powi(2));
            assert!(energy >= least * (1.0 - rounding) && energy <= most * (1.0 + rounding), "{x}: {energy}");
            let excess = sign * force / (k * beyond) - 1.0;
            let range = -(w / 2.0 * there.powi(3) / beyond + rounding)..=here.powi(4) / (1.0 - here.powi(4)) + rounding;
            assert!(range.contains(&excess), "{x}: {excess:e}");
            // ds/dx = 1/(1 + e^(−2a)).
            let loss = 1.0 + power / (c * 1.5 * 1.5);
            let range = -(there.powi(4) + rounding)..=2.0 * here.powi(2) + rounding;
            assert!(range.contains(&loss), "{x}: {loss:e}");
        }
    }
    // Between, nine widths and more from both limits: next to nothing.
    for x in [low + 0.1, 0.3, high - 0.1] {
        let (energy, force, power) = state(x);
        let gap = (x - low).min(high - x);
        assert!(energy <= k * (w * w / (4.0 * gap)).powi(2), "{x}: {energy:e}");
        assert!(force.abs() <= k * w * (w / (2.0 * gap)).powi(3), "{x}: {force:e}");
        assert!(power <= 0.0 && -power <= 2.0 * c * 1.5 * 1.5 * (w / (2.0 * gap)).powi(4), "{x}: {power:e}");
    }
}

/// Every function that is not smooth, and those that expressions share with the standard library, as forces on a mass.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    speeds(v),
    kinematics(x = v),
    particle(mass = 1, position = [x, 0, 0]),
    drive(clamped, x = clamp(v, low, high)),
    drive(rising, x = smooth_step(v, low, high)),
    drive(falling, x = smooth_step(v, high, low)),
    drive(sign, x = signum(v)),
    drive(least, x = min(v, high)),
    drive(most, x = max(low, v)),
    drive(size, x = abs(v)),
    drive(long, x = hypot(v, 3)),
    drive(angle, x = atan2(v, low)),
    drive(power, x = v.powi(3))
)]
struct Functions {
    low: f64,
    high: f64,
}

#[test]
fn functions_have_their_values() {
    let (low, high) = (-0.5, 2.0);
    let kernel = Functions { low, high }.kernel().unwrap();
    let q = SVector::from([0.0]);
    for v in [-1e9, -3.0, low, -0.1, -0.0, 0.0, 1e-12, 0.75, 1.9, high, 2.1, 7.0, 1e9] {
        let found = |name: &str| kernel.generalised_force(name, 0.0, &q, &SVector::from([v]), &()).unwrap()[0];
        assert_eq!(found("clamped"), f64::clamp(v, low, high), "{v}");
        assert_eq!(found("sign"), if v == 0.0 { 0.0 } else { f64::signum(v) }, "{v}");
        assert_eq!(found("least"), f64::min(v, high), "{v}");
        assert_eq!(found("most"), f64::max(v, low), "{v}");
        assert_eq!(found("size"), f64::abs(v), "{v}");
        let s = f64::clamp((v - low) / (high - low), 0.0, 1.0);
        // Polynomials of numbers up to 3 in up to ten operations.
        assert!((found("rising") - s * s * (3.0 - 2.0 * s)).abs() <= 16.0 * f64::EPSILON, "{v}");
        assert!((found("rising") + found("falling") - 1.0).abs() <= 32.0 * f64::EPSILON, "{v}");
        assert!((found("long") - f64::hypot(v, 3.0)).abs() <= 4.0 * f64::EPSILON * f64::hypot(v, 3.0), "{v}");
        assert!((found("angle") - f64::atan2(v, low)).abs() <= 4.0 * f64::EPSILON, "{v}");
        assert!((found("power") - v * v * v).abs() <= 4.0 * f64::EPSILON * (v * v * v).abs(), "{v}");
    }
    // Outside of its limits a step is what it is at them, exactly.
    let found = |name: &str, v: f64| kernel.generalised_force(name, 0.0, &q, &SVector::from([v]), &()).unwrap()[0];
    assert_eq!(
        [found("rising", -2.0), found("rising", 9.0), found("falling", -2.0), found("falling", 9.0)],
        [0.0, 1.0, 1.0, 0.0]
    );
    // What is not a number is not hidden.
    assert!(["clamped", "rising", "sign", "least", "most"].iter().all(|name| found(name, f64::NAN).is_nan()));
}

/// One body and a clause.
macro_rules! body {
    ($name:ident [$($clauses:tt)*]) => {
        #[derive(GaussDynamics)]
        #[gauss($($clauses)*)]
        struct $name {
            #[gauss(mass)]
            mass: f64,
            #[gauss(center_of_mass)]
            center: Vector3<f64>,
            #[gauss(inertia)]
            inertia: Matrix3<f64>,
            at: Vector3<f64>,
            k: f64,
        }

        impl $name {
            fn new() -> Self {
                let inertia = Matrix3::new(1.3, 0.1, -0.2, 0.1, 1.7, 0.05, -0.2, 0.05, 2.1);
                let (center, at) = (Vector3::new(0.1, -0.2, 0.05), Vector3::new(-0.5, 0.3, 0.8));
                Self { mass: 2.0, center, inertia, at, k: 1.5 }
            }
        }
    };
}

body!(InBody [input(w: Wrench), wrench(at = at, force = w.force, torque = k * w.torque)]);
body!(OfObserver [input(w: Wrench), wrench(at = at, force = w.force, torque = k * w.torque, axes = observer)]);
body!(InParts [
    input(w: Wrench),
    define(turned = inverse(body.rotation) * w.force),
    force(body = body, value = turned),
    torque(lever, value = cross(at, turned)),
    torque(value = k * w.torque, axes = observer)
]);
body!(InSystem [
    coordinates(pose: Pose),
    body(position = pose.position, rotation = pose.rotation),
    input(w: Wrench),
    force(at = pose.position + pose.rotation * at, value = w.force),
    torque(body = body, value = k * w.torque, axes = observer)
]);

/// The wrench of everything that acts: force and torque about O, body axes.
fn total<S>(kernel: &S, pose: &Isometry3<f64>, input: [f64; 6]) -> SVector<f64, 6>
where
    S: ForcedSystem<Scalar = f64, Configuration = Isometry3<f64>, Speeds = SVector<f64, 6>, Input = SVector<f64, 6>>,
{
    let (z, input) = (SVector::from([0.3, -0.2, 0.5, 1.1, -0.7, 0.4]), SVector::from(input));
    let columns = S::ELEMENTS.iter().map(|e| kernel.generalised_force(e.name, 0.0, pose, &z, &input).unwrap());
    columns.fold(SVector::zeros(), |sum, column| sum + column)
}

#[test]
fn a_wrench_has_its_frame_and_its_pole() {
    let rotation = UnitQuaternion::from_scaled_axis(Vector3::new(0.7, -1.9, 0.4));
    let pose = Isometry3::from_parts(Vector3::new(1.0, -2.0, 3.0).into(), rotation);
    let at = InBody::new().at;
    let input = [3.0, -1.0, 2.0, 0.5, 4.0, -2.5];
    let (force, torque) = (Vector3::new(3.0, -1.0, 2.0), Vector3::new(0.5, 4.0, -2.5) * 1.5);
    let about_o = |force: Vector3<f64>, torque: Vector3<f64>| {
        let torque = torque + at.cross(&force);
        SVector::from([force.x, force.y, force.z, torque.x, torque.y, torque.z])
    };
    // Each component is a sum of up to eight products of numbers whose sizes multiply to ten.
    let close = |found: SVector<f64, 6>, expected: SVector<f64, 6>| {
        assert!((found - expected).amax() <= 16.0 * f64::EPSILON * 10.0, "{found} {expected}");
    };
    close(total(&InBody::new().kernel().unwrap(), &pose, input), about_o(force, torque));
    let turned = about_o(rotation.inverse() * force, rotation.inverse() * torque);
    close(total(&OfObserver::new().kernel().unwrap(), &pose, input), turned);
    close(total(&InParts::new().kernel().unwrap(), &pose, input), turned);
    close(total(&InSystem::new().kernel().unwrap(), &pose, input), turned);
}

#[test]
fn a_wrench_is_supplied_at_run_time() {
    // A controller that holds O where it is, in observer's axes, against nothing else: b̈ = −4 (b − b₀) − 4 ḃ of a body
    // that does not turn, since the lever of the force about G is compensated.
    let kernel = OfObserver::new().kernel().unwrap();
    let OfObserver { mass, center, at, k, .. } = OfObserver::new();
    let controller = |_: f64, pose: &Isometry3<f64>, z: &SVector<f64, 6>| {
        let velocity = pose.rotation * Vector3::new(z[0], z[1], z[2]);
        let force = (pose.translation.vector * 4.0 + velocity * 4.0) * -mass;
        let torque = (pose.rotation * (center - at)).cross(&force) / k;
        SVector::from([force.x, force.y, force.z, torque.x, torque.y, torque.z])
    };
    let start = Isometry3::from_parts(Vector3::new(1.0, -0.5, 2.0).into(), UnitQuaternion::identity());
    let run = Simulation::new(&kernel).adaptive(1e-11, 1e-12).input(controller);
    let end = run.run_to_end(start, SVector::zeros(), 0.0..3.0).unwrap();
    // Critically damped: (1 + 2t) e^(−2t).
    let expected = start.translation.vector * (7.0 * (-6.0_f64).exp());
    // Some dozens of steps, each accepted at 1e-11.
    assert!((end.q.translation.vector - expected).amax() < 1e-9, "{}", end.q.translation.vector - expected);
    assert!(end.q.rotation.angle() < 1e-9);
}

body!(Named [
    potential = k * body.position.x,
    spring(from = [1, 1, 1], to = body.position, stiffness = k, damping = k),
    spring(from = [3, 2, 1], to = body.position, stiffness = k),
    spring(cord, from = [1, 2, 3], to = body.position, stiffness = k),
    force(at = at, value = [k, 0, 0]),
    force(at = at, value = [0, k, 0]),
    torque(value = [k, 0, 0]),
    wrench(at = at, force = [0, 0, k]),
    drag(linear = [k, k, k, k, k, k]),
    central_gravity(mu = k, center = [9, 9, 9]),
    damping = k * dot(body.velocity, body.velocity)
]);

#[test]
fn elements_without_a_name_are_called_by_their_clause() {
    let names = |conservative: bool| -> Vec<&str> {
        let elements = <NamedKernel as ForcedSystem>::ELEMENTS.iter();
        elements.filter(|element| element.conservative == conservative).map(|element| element.name).collect()
    };
    assert_eq!(names(true), ["potential", "central gravity", "spring", "spring 2", "cord"]);
    let others = ["force", "force 2", "torque", "wrench", "drag", "damping"];
    assert_eq!(names(false), others);
    // Those in the potential energy are first.
    let first = <NamedKernel as ForcedSystem>::ELEMENTS.iter().position(|element| !element.conservative);
    assert_eq!(first, Some(5));
    let kernel = Named::new().kernel().unwrap();
    let (q, z) = (Isometry3::identity(), SVector::from([1.0; 6]));
    assert_eq!(kernel.power("springs", 0.0, &q, &z, &()), None);
    assert_eq!(kernel.generalised_force("Drag", 0.0, &q, &z, &()), None);
}

fn smoothness<S: GaussSystem>(_: &S) -> Smoothness {
    S::SMOOTHNESS
}

/// A mass on which one force acts.
macro_rules! mass {
    ($name:ident $force:expr) => {
        #[derive(GaussDynamics)]
        #[gauss(coordinates(x), particle(mass = m, position = [x, 0, 0]), drive(x = $force))]
        struct $name {
            m: f64,
        }
    };
}

mass!(Root sqrt(1 + rate(x).powi(2)) - hypot(rate(x), 1));
mass!(Bent - abs(rate(x)) * rate(x));
mass!(Step smooth_step(x, 0, 1));
mass!(Limited clamp(x, -1, 1) + min(t, 1));
mass!(Dry - signum(rate(x)) * max(1, x));

body!(Plain [chart = hybrid, force(at = at, value = [k, 0, 0])]);
body!(Resisted [chart = hybrid, motion = planar, drag(quadratic = [k, k, k, k, k, k])]);
body!(Rubbed [chart = jet(euler_zyx), define(v = body.velocity), force(at = at, value = [-k * signum(v.x), 0, 0])]);

#[test]
fn scenes_say_how_smooth_they_are() {
    assert_eq!(smoothness(&Root { m: 1.0 }.kernel().unwrap()), Smoothness::Smooth);
    assert_eq!(smoothness(&Bent { m: 1.0 }.kernel().unwrap()), Smoothness::Kinks);
    assert_eq!(smoothness(&Step { m: 1.0 }.kernel().unwrap()), Smoothness::Kinks);
    assert_eq!(smoothness(&Limited { m: 1.0 }.kernel().unwrap()), Smoothness::Kinks);
    assert_eq!(smoothness(&Dry { m: 1.0 }.kernel().unwrap()), Smoothness::Jumps);
    assert_eq!(
        smoothness(&Stopped { low: 0.0, high: 1.0, k: 1.0, w: 1.0, c: 1.0 }.kernel().unwrap()),
        Smoothness::Smooth
    );
    assert_eq!(smoothness(&Plain::new().kernel().unwrap()), Smoothness::Smooth);
    assert_eq!(smoothness(&Resisted::new().kernel().unwrap()), Smoothness::Kinks);
    assert_eq!(smoothness(&Rubbed::new().kernel().unwrap()), Smoothness::Jumps);
}

/// Two bodies on a hinge and a third one that moves by itself, with elements between them, some beside the same load
/// written otherwise. The seat is where the hinge is.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b, theta, x, y, z, d, e),
    body(one, rotation = rotation_z(a) * rotation_x(b)),
    body(two, parent = one, position = [0, 0, 0.5], rotation = rotation_z(theta)),
    body(three, position = [x, y, z], rotation = rotation_y(d) * rotation_z(e)),
    frame(seat, parent = one, position = [0, 0, 0.5]),
    coupling(joined, body = two, other = one, viscous = c),
    drive(joined_by_rate, theta = -c * rate(theta)),
    coupling(apart, body = three, other = two, viscous = c),
    torque(
        apart_by_hand,
        body = three,
        value = -c * (three.angular_velocity - two.angular_velocity),
        axes = observer,
        reaction = two
    ),
    torsional_spring(twisted, body = two, other = seat, stiffness = k, angle = rest, damping = c),
    spring(twisted_by_angle, along = theta, stiffness = k, length = rest, damping = c),
    torsional_spring(skew, body = three, other = two, stiffness = k, angle = rest, damping = c),
    bushing(mounted, body = two, other = seat, stiffness = [3, 4, 5, 6, 7, k], damping = [1, 1, 1, 1, 1, c]),
    spring(mounted_by_angle, along = theta, stiffness = k, damping = c),
    bushing(loose, body = three, other = two, stiffness = stiffness, damping = damping)
)]
struct Joined {
    #[gauss(body)]
    one: RigidBody<f64>,
    #[gauss(body)]
    two: RigidBody<f64>,
    #[gauss(body)]
    three: RigidBody<f64>,
    k: f64,
    c: f64,
    rest: f64,
    stiffness: Matrix6<f64>,
    damping: Matrix6<f64>,
}

type Eight = SVector<f64, 8>;

fn joined() -> Joined {
    let (center_of_mass, inertia) = (Vector3::new(0.1, 0.0, -0.1), Matrix3::identity());
    let body = || RigidBody { mass: 2.0, center_of_mass, inertia };
    // Diagonally dominant, with every coefficient.
    let full =
        |diagonal: f64| Matrix6::from_fn(|i, j| if i == j { diagonal + i as f64 } else { 0.1 * (i + j) as f64 - 0.3 });
    let (k, c, rest) = (2.5, 0.7, 0.4);
    Joined { one: body(), two: body(), three: body(), k, c, rest, stiffness: full(8.0), damping: full(5.0) }
}

/// The place of the third body relative to the second: displacement and Cardan angles in the axes of the second; and
/// the twist about their third axes, of the quaternion. By nalgebra alone.
fn relative_place(q: &Eight) -> (Vector6<f64>, f64) {
    let about =
        |axis: gauss_runtime::nalgebra::Unit<Vector3<f64>>, angle: f64| UnitQuaternion::from_axis_angle(&axis, angle);
    let (x, y, z) = (Vector3::x_axis(), Vector3::y_axis(), Vector3::z_axis());
    let one = about(z, q[0]) * about(x, q[1]);
    let two = one * about(z, q[2]);
    let place = two.inverse() * (Vector3::new(q[3], q[4], q[5]) - one * Vector3::new(0.0, 0.0, 0.5));
    let relative = two.inverse() * about(y, q[6]) * about(z, q[7]);
    // nalgebra's angles are those of rotation_z(yaw) rotation_y(pitch) rotation_x(roll): of the inverse.
    let (roll, pitch, yaw) = relative.inverse().euler_angles();
    let twist = 2.0 * relative.k.atan2(relative.w);
    (Vector6::new(place.x, place.y, place.z, -roll, -pitch, -yaw), twist)
}

/// States with all angles of the bushings below a quarter turn.
fn states_of_joined() -> [(Eight, Eight); 2] {
    [
        (
            Eight::from([0.3, -0.2, 0.9, 0.4, -0.3, 0.8, 0.5, 0.2]),
            Eight::from([0.5, -0.4, 0.3, 0.2, 0.6, -0.7, 0.8, -0.9]),
        ),
        (
            Eight::from([-0.7, 0.4, -1.2, -0.2, 0.5, 0.1, -0.3, -0.9]),
            Eight::from([-0.3, 0.9, 1.5, -0.6, 0.1, 0.4, -0.2, 0.7]),
        ),
    ]
}

#[test]
fn elements_between_bodies_are_the_same_loads_written_otherwise() {
    let kernel = joined().kernel().unwrap();
    for (q, z) in states_of_joined() {
        let force = |name: &str| kernel.generalised_force(name, 0.0, &q, &z, &()).unwrap();
        for (name, other) in [
            ("joined", "joined_by_rate"),
            ("apart", "apart_by_hand"),
            ("twisted", "twisted_by_angle"),
            ("mounted", "mounted_by_angle"),
        ] {
            // Coefficients and rates are of order 1, and each component is a sum of less than fifty products of them
            // and of entries of rotations.
            let difference = (force(name) - force(other)).amax();
            assert!(difference <= 64.0 * f64::EPSILON * 8.0, "{name}: {difference:e}");
            let [power, same] = [name, other].map(|name| kernel.power(name, 0.0, &q, &z, &()).unwrap());
            assert!((power - same).abs() <= 64.0 * f64::EPSILON * 8.0, "{name}: {power} {same}");
        }
        assert!(kernel.power("apart", 0.0, &q, &z, &()).unwrap() < -0.1);
    }
}

#[test]
fn torsional_springs_and_bushings_act_by_the_relative_place() {
    let scene = joined();
    let kernel = scene.kernel().unwrap();
    for (q, z) in states_of_joined() {
        let (x, twist) = relative_place(&q);
        let (sine, cosine) = (twist - scene.rest).sin_cos();
        let turned = sine.atan2(cosine);
        // Central differences along the rates: h² times a third derivative and ε/h, both below 1e-9 for numbers of
        // order 1.
        let h = 1e-5;
        let [(ahead, twist_ahead), (behind, twist_behind)] = [h, -h].map(|h| relative_place(&(q + h * z)));
        let (rate, twisting) = ((ahead - behind) / (2.0 * h), (twist_ahead - twist_behind) / (2.0 * h));
        let power = |name: &str| kernel.power(name, 0.0, &q, &z, &()).unwrap();
        let expected = -twisting * (scene.k * turned + scene.c * twisting);
        assert!((power("skew") - expected).abs() <= 1e-7, "{} {expected}", power("skew"));
        let expected = -rate.dot(&(scene.stiffness * x + scene.damping * rate));
        assert!((power("loose") - expected).abs() <= 1e-7, "{} {expected}", power("loose"));
        // The energy of all that has one.
        let hinge = 0.5 * scene.k * ((q[2] - scene.rest).powi(2) * 2.0 + q[2].powi(2) * 2.0);
        let energy = hinge + 0.5 * scene.k * turned * turned + 0.5 * x.dot(&(scene.stiffness * x));
        let found = kernel.potential_energy(0.0, &q);
        assert!((found - energy).abs() <= 256.0 * f64::EPSILON * energy, "{found} {energy}");
    }
}

#[test]
fn matrices_of_bushings_are_checked() {
    let mut scene = joined();
    scene.stiffness[(1, 4)] += 0.5;
    let error = scene.kernel().err().unwrap().to_string();
    assert!(error.contains("`stiffness`: entries (1, 4) and (4, 1) differ by 0.4999"), "{error}");
    // A coupling that is larger than both coefficients.
    scene = joined();
    (scene.stiffness[(0, 1)], scene.stiffness[(1, 0)]) = (20.0, 20.0);
    let error = scene.kernel().err().unwrap().to_string();
    assert!(error.contains("`stiffness` has the eigenvalue -"), "{error}");
    // Of the diagonal [3, 4, 5, 6, 7, k].
    scene = joined();
    scene.k = -2.5;
    let error = scene.kernel().err().unwrap().to_string();
    assert!(error.contains("`mounted.stiffness` has the eigenvalue -2.5:"), "{error}");
    scene = joined();
    (scene.damping[(0, 1)], scene.damping[(1, 0)]) = (20.0, 20.0);
    assert!(scene.kernel().is_ok());
    let warnings = scene.warnings().to_string();
    assert!(warnings.contains("damping feeds energy: `damping` has the eigenvalue -"), "{warnings}");
    scene = joined();
    scene.c = -0.7;
    let warnings = scene.warnings().to_string();
    assert!(warnings.contains("damping feeds energy: `mounted.damping` has the eigenvalue -0.7"), "{warnings}");
}
