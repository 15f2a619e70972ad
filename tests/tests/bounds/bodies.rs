//! The reference scenes of several bodies, and those whose configurations have rotations and poses: as published, and
//! at states drawn about those.

use gauss_runtime::prelude::*;
use gauss_tests::double_double::DoubleDouble;
use gauss_tests::trajectory::{number, numbers, reference, rotation};
use serde_json::Value;

use crate::common::Bounded;
use crate::compare::{Any, Excess, Random, holds, moved};

/// A derived system of any scalar, each of its fields read from the parameters of a reference.
macro_rules! scene {
    (
        $module:ident($of:ident), [$($clause:tt)+],
        { $($(#[$role:meta])* $field:ident: $type:ty = $value:expr),+ $(,)? }
    ) => {
        mod $module {
            use super::*;

            #[derive(GaussDynamics)]
            #[gauss($($clause)+)]
            pub struct System<T> { $($(#[$role])* $field: $type),+ }

            pub fn kernel<T: Real>($of: &Value) -> SystemKernel<T> {
                System { $($field: $value),+ }.kernel().expect("a system")
            }
        }
    };
}

scene!(
    gyroscope(of),
    [
        coordinates(phi, theta, psi),
        body(outer, rotation = rotation_z(phi)),
        body(inner, parent = outer, rotation = rotation_x(theta)),
        body(rotor, parent = inner, rotation = rotation_z(psi))
    ],
    {
        #[gauss(body)] outer: RigidBody<T> = body(&of["outer"]),
        #[gauss(body)] inner: RigidBody<T> = body(&of["inner"]),
        #[gauss(body)] rotor: RigidBody<T> = body(&of["rotor"]),
        #[gauss(gravity)] g: T = scalar(&of["g"]),
    }
);

scene!(
    universal_joints(of),
    [
        coordinates(a1, b1, a2, b2),
        body(upper, rotation = rotation_x(a1) * rotation_y(b1)),
        body(lower, parent = upper, position = [0, 0, -l1], rotation = rotation_x(a2) * rotation_y(b2))
    ],
    {
        #[gauss(body)] upper: RigidBody<T> = body(&of["upper"]),
        #[gauss(body)] lower: RigidBody<T> = body(&of["lower"]),
        l1: T = scalar(&of["l1"]),
        #[gauss(gravity)] g: T = scalar(&of["g"]),
    }
);

scene!(
    four_bars(of),
    [
        coordinates(a, b, c),
        body(crank, rotation = rotation_z(a)),
        body(coupler, position = [l1 * cos(a), l1 * sin(a), 0], rotation = rotation_z(b)),
        body(rocker, position = [d, 0, 0], rotation = rotation_z(c)),
        point(end, body = coupler, at = [l2, 0, 0]),
        point(tip, body = rocker, at = [l3, 0, 0]),
        constraint(position = end - tip)
    ],
    {
        #[gauss(body)] crank: RigidBody<T> = bar(of, 0),
        #[gauss(body)] coupler: RigidBody<T> = bar(of, 1),
        #[gauss(body)] rocker: RigidBody<T> = bar(of, 2),
        l1: T = scalar(&of["lengths"][0]),
        l2: T = scalar(&of["lengths"][1]),
        l3: T = scalar(&of["lengths"][2]),
        d: T = scalar(&of["d"]),
        #[gauss(gravity)] g: Vector3<T> = Vector3::new(T::zero(), -scalar::<T>(&of["g"]), T::zero()),
    }
);

scene!(
    arm(of),
    [
        coordinates(q1, q2, q3, q4, q5, q6, q7),
        body(b1, position = [0, 0, 0.333], rotation = rotation_z(q1)),
        body(b2, parent = b1, rotation = rotation_y(q2)),
        body(b3, parent = b2, position = [0, 0, 0.316], rotation = rotation_z(q3)),
        body(b4, parent = b3, position = [0.0825, 0, 0], rotation = rotation_y(-q4)),
        body(b5, parent = b4, position = [-0.0825, 0, 0.384], rotation = rotation_z(q5)),
        body(b6, parent = b5, rotation = rotation_y(-q6)),
        body(b7, parent = b6, position = [0.088, 0, 0], rotation = rotation_z(-q7))
    ],
    {
        #[gauss(body)] b1: RigidBody<T> = body(&of["straight_links"][0]),
        #[gauss(body)] b2: RigidBody<T> = body(&of["straight_links"][1]),
        #[gauss(body)] b3: RigidBody<T> = body(&of["straight_links"][2]),
        #[gauss(body)] b4: RigidBody<T> = body(&of["straight_links"][3]),
        #[gauss(body)] b5: RigidBody<T> = body(&of["straight_links"][4]),
        #[gauss(body)] b6: RigidBody<T> = body(&of["straight_links"][5]),
        #[gauss(body)] b7: RigidBody<T> = body(&of["straight_links"][6]),
        #[gauss(gravity)] g: T = scalar(&of["gravity"]),
    }
);

scene!(
    turntable(of),
    [
        coordinates(x, y, attitude: Rotation),
        speeds(w: Vector3),
        kinematics(x = r * w.y - spin * y, y = -r * w.x + spin * x, attitude = inverse(attitude) * w),
        body(position = [x, y, r], rotation = attitude)
    ],
    {
        #[gauss(mass)] m: T = scalar(&of["mass"]),
        #[gauss(inertia)] j: T = T::ratio(2, 5) * scalar(&of["mass"]) * scalar::<T>(&of["radius"]).powi(2),
        r: T = scalar(&of["radius"]),
        spin: T = scalar(&of["table_rate"]),
    }
);

scene!(
    chaplygin_ball(of),
    [
        coordinates(x, y, attitude: Rotation),
        speeds(w: Vector3),
        kinematics(x = r * (attitude * w).y, y = -r * (attitude * w).x, attitude = w),
        body(ball, position = [x, y, r], rotation = attitude)
    ],
    {
        #[gauss(body)] ball: RigidBody<T> = body(of),
        r: T = scalar(&of["radius"]),
        #[gauss(gravity)] g: T = scalar(&of["gravity"]),
    }
);

scene!(
    suslov(of),
    [
        coordinates(attitude: Rotation),
        speeds(w: Vector3),
        kinematics(attitude = w),
        body(spider, rotation = attitude),
        constraint(velocity = w.z)
    ],
    { #[gauss(body)] spider: RigidBody<T> = body(of) }
);

scene!(
    rattleback(of),
    [
        coordinates(x, y, attitude: Rotation),
        speeds(vx, vy, w1, w2, w3),
        kinematics(x = vx, y = vy, attitude = [w1, w2, w3]),
        define(up = inverse(attitude) * [0, 0, 1]),
        define(height = sqrt((a.x * up.x).powi(2) + (a.y * up.y).powi(2) + (a.z * up.z).powi(2))),
        define(slip = cross([w1, w2, w3], [a.x * a.x * up.x, a.y * a.y * up.y, a.z * a.z * up.z]) / height),
        body(stone, position = [x, y, height], rotation = attitude),
        constraint(velocity = vx - (attitude * slip).x),
        constraint(velocity = vy - (attitude * slip).y),
        independent(w1, w2, w3)
    ],
    {
        #[gauss(body)] stone: RigidBody<T> = body(of),
        a: Vector3<T> = vector(&of["half_axes"]),
        #[gauss(gravity)] g: T = scalar(&of["gravity"]),
    }
);

scene!(
    gyrostat(of),
    [
        coordinates(pose: Pose, phi),
        body(hull, position = pose.position, rotation = pose.rotation),
        body(wheel, parent = hull, position = axle, rotation = rotation_y(tilt) * rotation_z(phi))
    ],
    {
        #[gauss(body)] hull: RigidBody<T> = body(&of["body"]),
        #[gauss(body)] wheel: RigidBody<T> = body(&of["wheel"]),
        axle: Vector3<T> = vector(&of["wheel_position"]),
        tilt: T = scalar(&of["tilt"]),
    }
);

scene!(
    slung_load(of),
    [
        coordinates(pose: Pose, a1, a2),
        body(hull, position = pose.position, rotation = pose.rotation),
        point(hook, body = hull, at = h),
        particle(mass = load, position = hook + rotation_x(a1) * rotation_y(a2) * [0, 0, -l])
    ],
    {
        #[gauss(body)] hull: RigidBody<T> = body(&of["frame"]),
        h: Vector3<T> = vector(&of["hook"]),
        load: T = scalar(&of["load"]),
        l: T = scalar(&of["l"]),
        #[gauss(gravity)] g: T = scalar(&of["g"]),
    }
);

fn scalar<T: Real>(value: &Value) -> T {
    T::from_f64(number(value))
}

fn vector<T: Real>(value: &Value) -> Vector3<T> {
    Vector3::from_iterator(numbers(value).into_iter().map(T::from_f64))
}

/// A tensor, of its entries or of its principal moments.
fn tensor<T: Real>(value: &Value) -> Matrix3<T> {
    let entries: Vec<T> = numbers(value).into_iter().map(T::from_f64).collect();
    match entries.len() {
        3 => Matrix3::from_fn(|i, j| if i == j { entries[i] } else { T::zero() }),
        _ => Matrix3::from_fn(|i, j| entries[3 * i + j]),
    }
}

/// A body as published.
fn body<T: Real>(of: &Value) -> RigidBody<T> {
    let inertia = ["inertia_about_O", "principal_inertia_about_O"].into_iter().find_map(|key| of.get(key));
    RigidBody {
        mass: scalar(&of["mass"]),
        center_of_mass: vector(&of["centre_of_mass_body_from_O"]),
        inertia: tensor(inertia.expect("moments")),
    }
}

/// A bar of the linkage, of which the reference lists each property by itself.
fn bar<T: Real>(of: &Value, i: usize) -> RigidBody<T> {
    RigidBody {
        mass: scalar(&of["masses"][i]),
        center_of_mass: vector(&of["centres_of_mass_body_from_O"][i]),
        inertia: tensor(&of["inertias_about_O"][i]),
    }
}

/// Components of a configuration, and speeds.
type State = (Vec<f64>, Vec<f64>);

/// A published state by the keys of its components, of which `R` is a rotation.
fn state(at: &Value, q: &[&str], z: &[&str]) -> State {
    let components = |key: &&str| match *key {
        "R" => rotation(&at["R"]).coords.as_slice().to_vec(),
        key => numbers(&at[key]),
    };
    (q.iter().flat_map(components).collect(), z.iter().flat_map(components).collect())
}

/// The initial and the final state.
fn published(name: &str, q: &[&str], z: &[&str]) -> [State; 2] {
    let scene = reference(name);
    ["initial", "final"].map(|when| state(&scene[when], q, z))
}

/// The same of a rolling body: its attitude, and its place without the height, which is no coordinate.
fn rolling(name: &str, z: &str) -> [State; 2] {
    published(name, &["R", "b"], &[z]).map(|(mut q, z)| {
        q.pop();
        (q, z)
    })
}

/// A scene at its published states, with some steps of a run from each; then at states drawn about the first: turned
/// anyhow, near and far, slow and fast.
fn check<P: Any<f64>, B: Any<Bounded>, D: Any<DoubleDouble>>(
    what: &str,
    kernels: (&P, &B, &D),
    published: &[State],
    step: f64,
) {
    let mut excess = Excess::default();
    for (q, z) in published {
        holds(what, kernels, (q, z), Some(step), &mut excess);
    }
    // Bounds forget that errors are correlated, which over the stages of a run and the joints of an arm multiplies.
    assert!(excess.report(&format!("{what}, as published")) < 1e4);
    let (mut excess, mut random) = (Excess::default(), Random(17));
    let (q, z) = &published[0];
    for _ in 0..200 {
        let q = moved(kernels.0, q, || 3.0 * random.next() * random.decades(-6.0, 2.0));
        let z: Vec<_> = z.iter().map(|_| random.next() * random.decades(-2.0, 2.0)).collect();
        holds(what, kernels, (&q, &z), None, &mut excess);
    }
    excess.report(&format!("{what}, spread"));
}

macro_rules! check {
    ($module:ident, $name:expr, $published:expr, $step:expr) => {{
        let parameters = &reference($name)["parameters"];
        let kernels = (
            &$module::kernel::<f64>(parameters),
            &$module::kernel::<Bounded>(parameters),
            &$module::kernel::<DoubleDouble>(parameters),
        );
        check($name, kernels, &$published, $step);
    }};
}

#[test]
fn linkages() {
    let name = "gyroscope_in_gimbals";
    check!(gyroscope, name, published(name, &["q"], &["z"]), 0.001);
    let name = "spatial_double_pendulum_of_rods";
    check!(universal_joints, name, published(name, &["q"], &["z"]), 0.01);
    let name = "four_bar_linkage";
    check!(four_bars, name, published(name, &["q"], &["z"]), 0.005);
    let name = "seven_joint_arm";
    let states = &reference(name)["states"];
    let states: Vec<_> = states.as_array().expect("states").iter().map(|at| state(at, &["q"], &["q_rate"])).collect();
    check!(arm, name, states, 0.002);
}

#[test]
fn rolling_and_rotations() {
    let name = "ball_on_turntable";
    check!(turntable, name, rolling(name, "space_omega"), 0.01);
    let name = "chaplygin_ball";
    check!(chaplygin_ball, name, rolling(name, "body_omega"), 0.01);
    let name = "suslov";
    check!(suslov, name, published(name, &["R"], &["body_omega"]), 0.01);
    let name = "rattleback";
    check!(rattleback, name, rolling(name, "body_omega"), 0.005);
}

#[test]
fn poses() {
    for name in ["body_with_flywheel", "body_with_unbalanced_wheel"] {
        let states = published(name, &["R", "b", "phi"], &["body_u", "body_omega", "phi_rate"]);
        check!(gyrostat, name, states, 0.001);
    }
    let name = "quadrotor_slung_load";
    let states = published(name, &["R", "b", "angles"], &["body_u", "body_omega", "angle_rates"]);
    check!(slung_load, name, states, 0.01);
}
