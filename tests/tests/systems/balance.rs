//! The balance of power and the right-hand side of (3.4), of systems on which something acts: `laws::forced_laws` on
//! one scene for every kind of element and every way in which bodies hang together. Stops set in over half a unit, so
//! that energies are smooth on the step of the differences, as the laws suppose.

use gauss_runtime::prelude::*;
use gauss_tests::laws::{balance, forced_laws};
use proptest::prelude::*;

/// A cart with a pendulum: a motor, torsion, a stop, Rayleigh dissipation, a potential that changes.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, theta),
    frame(cart, position = [x, 0, 0]),
    particle(mass = big, parent = cart, position = [0, 0, 0]),
    body(parent = cart, rotation = rotation_y(theta)),
    input(motor),
    drive(x = motor),
    drive(friction, theta = -k * rate(theta) / sqrt(rate(theta).powi(2) + 0.01)),
    spring(hinge, along = theta, stiffness = k, length = 0.25, damping = 0.5),
    stop(along = theta, least = -1, most = 1, stiffness = 20, width = 0.5, damping = 0.5),
    stop(wall, along = x, most = 2, stiffness = 40, width = 0.5),
    damping = 0.5 * k * rate(x).powi(2),
    potential = k * x * sin(3 * t)
)]
struct Crane {
    big: f64,
    #[gauss(mass)]
    mass: f64,
    #[gauss(center_of_mass)]
    center: Vector3<f64>,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
    #[gauss(gravity)]
    g: f64,
    k: f64,
}

/// Two arms: motors with reactions, springs between points of both, a wrench at run time, drag in a wind, a push at a
/// point.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b, c),
    body(upper, rotation = rotation_y(a) * rotation_x(c)),
    body(lower, parent = upper, position = [0, 0, -l], rotation = rotation_y(b)),
    point(knee, body = upper, at = [0.1, 0, -0.25]),
    point(heel, body = lower, at = [0.1, 0.2, -0.5]),
    input(shoulder, gust: Wrench, push: Vector3),
    define(slip = lower.relative_velocity),
    torque(motor, body = lower, value = [0, shoulder, 0], reaction = upper),
    torque(brake, body = upper, value = -k * upper.angular_velocity, axes = observer),
    wrench(body = lower, at = [0, 0, -l], force = gust.force, torque = gust.torque, axes = observer),
    wrench(lift, body = lower, force = [abs(slip.z) * slip.z, 0, max(slip.x, 0) * slip.x]),
    force(at = heel, value = push),
    spring(tendon, from = knee, to = heel, stiffness = 50, length = 0.5, damping = k),
    spring(rope, from = [1, 1, 1], to = heel, stiffness = k),
    stop(from = knee, to = [0.5, 0, 0], least = 0.5, stiffness = 30, width = 0.5, damping = k),
    drag(body = lower, linear = [k, k, k, k, k, k], quadratic = [1, 2, 3, 0.1, 0.2, 0.3]),
    drag(air, body = upper, linear = d),
    medium(velocity = [2 * cos(t), 0.5, t])
)]
struct Arms {
    #[gauss(body)]
    upper: RigidBody<f64>,
    #[gauss(body)]
    lower: RigidBody<f64>,
    #[gauss(gravity)]
    field: Vector3<f64>,
    d: Matrix6<f64>,
    l: f64,
    k: f64,
}

/// A body with added mass in a tide, hanging on a frame with three weights that moves freely by quasi-velocities.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose, theta),
    speeds(v: Vector3, w: Vector3, s),
    kinematics(pose = twist(v, w), theta = s),
    frame(buoy, position = pose.position, rotation = pose.rotation),
    particle(mass = 1, parent = buoy, position = [1, 0, 0]),
    particle(mass = weight, parent = buoy, position = [0, 1, 0.5]),
    particle(mass = weight, parent = buoy, position = [-1, -1, 0]),
    body(parent = buoy, position = [0, 0, -l], rotation = rotation_y(theta)),
    medium(velocity = [c * t, 0.5 * c, cos(c * t)]),
    drag(body = body, quadratic = [1, 2, 3, 0.1, 0.2, 0.3]),
    drive(fin, theta = c * abs(s) * s),
    central_gravity(moon, mu = 20, center = [5, 6, 7])
)]
struct Moored {
    weight: f64,
    #[gauss(mass)]
    mass: f64,
    #[gauss(center_of_mass)]
    center: Vector3<f64>,
    #[gauss(inertia)]
    inertia: Matrix3<f64>,
    #[gauss(added_mass)]
    added: Vector6<f64>,
    #[gauss(gravity)]
    g: f64,
    #[gauss(displaced_mass)]
    displaced: f64,
    #[gauss(center_of_buoyancy)]
    buoyancy: Vector3<f64>,
    l: f64,
    c: f64,
}

/// A sleigh on a slope with a propeller and drag: a skate that is solved for, and one that stays a constraint.
macro_rules! sleigh {
    ($name:ident [$($clause:tt)*]) => {
        #[derive(GaussDynamics)]
        #[gauss(
            coordinates(x, y, theta),
            body(position = [x, y, 0], rotation = rotation_z(theta)),
            $($clause)*
            input(thrust),
            force(propeller, body = body, at = [-1, 0.25, 0], value = [thrust, 0, 0]),
            drag(body = body, linear = [d, d, d, d, d, d]),
            spring(from = [0, 0, 1], to = body.position, stiffness = d, length = 1, damping = 0.25)
        )]
        struct $name {
            #[gauss(mass)]
            mass: f64,
            #[gauss(center_of_mass)]
            center: Vector3<f64>,
            #[gauss(inertia)]
            inertia: f64,
            #[gauss(gravity)]
            field: Vector3<f64>,
            d: f64,
        }

        impl $name {
            fn new() -> Self {
                let (center, field) = (Vector3::new(0.3, 0.1, 0.0), Vector3::new(1.0, -2.0, -9.0));
                Self { mass: 1.5, center, inertia: 0.8, field, d: 0.7 }
            }
        }
    };
}

sleigh!(Skating [constraint(velocity = cos(theta) * rate(y) - sin(theta) * rate(x)),]);
sleigh!(Reduced [
    speeds(s, r, side),
    kinematics(x = s * cos(theta) - side * sin(theta), y = s * sin(theta) + side * cos(theta), theta = r),
    constraint(velocity = side),
    independent(s, r),
]);

fn body(mass: f64, x: f64) -> RigidBody<f64> {
    RigidBody {
        mass,
        center_of_mass: Vector3::new(x, 0.1, -0.05),
        inertia: Matrix3::new(1.3, 0.1, -0.2, 0.1, 1.7, 0.05, -0.2, 0.05, 2.1),
    }
}

/// A full matrix that is neither symmetric nor positive: the balance holds for drag that feeds energy as well.
fn matrix() -> Matrix6<f64> {
    Matrix6::from_fn(|i, j| 0.25 * (i as f64 - 1.5) + 0.125 * ((i * j) % 5) as f64)
}

type Small = [f64; 2];

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_crane(t in -2.0..2.0_f64, q in [-3.0..3.0_f64, -1.5..1.5], z in [-2.0..2.0_f64, -2.0..2.0], motor in -5.0..5.0_f64) {
        let center = Vector3::new(0.1, 0.0, -0.6);
        let crane = Crane { big: 2.0, mass: 1.0, center, inertia: Vector3::new(0.5, 0.5, 0.2), g: 9.81, k: 1.5 };
        let (q, z): (Small, Small) = (q, z);
        forced_laws(&crane.kernel().unwrap(), t, (&SVector::from(q), &SVector::from(z)), &SVector::from([motor]));
    }

    #[test]
    fn two_arms(
        t in -2.0..2.0_f64,
        q in prop::array::uniform3(-3.0..3.0_f64),
        z in prop::array::uniform3(-2.0..2.0_f64),
        input in prop::array::uniform10(-5.0..5.0_f64),
    ) {
        let field = Vector3::new(0.5, -0.25, -9.81);
        let arms = Arms { upper: body(2.0, 0.1), lower: body(1.0, -0.2), field, d: matrix(), l: 0.75, k: 0.3 };
        forced_laws(&arms.kernel().unwrap(), t, (&SVector::from(q), &SVector::from(z)), &SVector::from(input));
    }

    #[test]
    fn a_moored_body(
        t in -2.0..2.0_f64,
        axis in prop::array::uniform3(-2.0..2.0_f64),
        position in prop::array::uniform3(-1.0..1.0_f64),
        theta in -3.0..3.0_f64,
        z in prop::array::uniform7(-2.0..2.0_f64),
    ) {
        let moored = Moored {
            weight: 0.7,
            mass: 1.2,
            center: Vector3::new(0.1, 0.0, -0.2),
            inertia: body(1.0, 0.0).inertia,
            added: Vector6::new(0.5, 0.7, 0.9, 0.1, 0.2, 0.05),
            g: 9.81,
            displaced: 1.1,
            buoyancy: Vector3::new(0.0, 0.05, 0.1),
            l: 0.9,
            c: 0.8,
        };
        let rotation = UnitQuaternion::from_scaled_axis(Vector3::from(axis));
        let pose = Isometry3::from_parts(Vector3::from(position).into(), rotation);
        let q = (pose, SVector::from([theta]));
        forced_laws(&moored.kernel().unwrap(), t, (&q, &SVector::from(z)), &());
    }

    #[test]
    fn a_sleigh(q in prop::array::uniform3(-3.0..3.0_f64), s in -2.0..2.0_f64, r in -2.0..2.0_f64, thrust in -5.0..5.0_f64) {
        let (sine, cosine) = f64::sin_cos(q[2]);
        let (q, input) = (SVector::from(q), SVector::from([thrust]));
        let (whole, reduced) = (Skating::new().kernel().unwrap(), Reduced::new().kernel().unwrap());
        let (z, few) = (SVector::from([s * cosine, s * sine, r]), SVector::from([s, r]));
        balance(&whole, 0.0, (&q, &z), &input);
        forced_laws(&reduced, 0.0, (&q, &few), &input);
        // The powers are those of the same forces, in both.
        let (a, b) = (whole.powers(0.0, &q, &z, &input), reduced.powers(0.0, &q, &few, &input));
        // Sums of some twenty terms of forces below 40 and velocities below 6.
        prop_assert!((a - b).amax() <= 20.0 * f64::EPSILON * 240.0, "{} {}", a, b);
    }
}
