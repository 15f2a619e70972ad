//! Contacts of kernels: gaps against geometry, W and D against one another and the mass matrix, b against the rates of
//! `contact_rates` along the motion (dual numbers, and differences), charts against one another.

mod capsules;
mod ellipsoids;
mod shapes;

use crate::dual::Dual;
use gauss_runtime::contact::{Contact, ContactDynamics};
use gauss_runtime::forces::Columns;
use gauss_runtime::prelude::*;

/// A robot from its file over a table, with stops of a finger.
#[derive(GaussDynamics)]
#[gauss(
    urdf = "robots/panda.urdf",
    gravity = 9.81,
    frames(panda_finger_joint1_link),
    contact(table, point = panda_finger_joint1_link.position, radius = 0.01, height = 0.1, friction = 0.4),
    range(panda_finger_joint1, from = 0, to = 0.04, restitution = 0.2)
)]
struct Panda;

/// A ball on a plane: friction along two tangents.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(ball, position = pose.position, rotation = pose.rotation),
    contact(floor, gap = ball.position.z - r, slip = [
        dot(ball.velocity + cross(ball.angular_velocity, [0, 0, -r]), [1, 0, 0]),
        dot(ball.velocity + cross(ball.angular_velocity, [0, 0, -r]), [0, 1, 0])
    ], friction = mu, restitution = e),
)]
struct Ball {
    #[gauss(body)]
    ball: RigidBody<f64>,
    #[gauss(gravity)]
    g: f64,
    r: f64,
    mu: f64,
    e: f64,
}

fn ball() -> Ball {
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.4, 0.5, 0.6));
    let ball = RigidBody { mass: 2.0, center_of_mass: Vector3::new(0.01, -0.02, 0.03), inertia };
    Ball { ball, g: 9.81, r: 0.3, mu: 0.4, e: 0.7 }
}

/// A double pendulum with stops.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b),
    define(elbow = [l * sin(a), 0, -l * cos(a)]),
    particle(mass = 1, position = elbow),
    particle(mass = m, position = elbow + [l * sin(b), 0, -l * cos(b)]),
    range(a, from = -low, to = high, restitution = e),
    range(knee, along = b - a, from = 0),
    input(torque),
    drive(a = torque),
)]
struct Pendulum<T> {
    m: T,
    l: T,
    #[gauss(gravity)]
    g: T,
    low: T,
    high: T,
    e: T,
}

/// The ball of [`Ball`] by its geometry, in a chart.
macro_rules! in_charts {
    ($($name:ident: $chart:tt;)+) => {$(
        #[derive(GaussDynamics)]
        #[gauss(chart = $chart, contact(floor, point = body.position, radius = r, friction = mu, restitution = e))]
        struct $name {
            #[gauss(mass)]
            mass: f64,
            #[gauss(center_of_mass)]
            center: Vector3<f64>,
            #[gauss(inertia)]
            inertia: Vector3<f64>,
            #[gauss(gravity)]
            g: f64,
            r: f64,
            mu: f64,
            e: f64,
        }

        impl $name {
            fn sample() -> Self {
                let Ball { ball, g, r, mu, e } = ball();
                Self { mass: ball.mass, center: ball.center_of_mass, inertia: ball.inertia.diagonal(), g, r, mu, e }
            }
        }
    )+};
}

in_charts! {
    Hybrid: hybrid;
    LeftInvariant: left_invariant;
    RightInvariant: right_invariant;
}

/// A disk that rolls in the plane k₁k₂, in which weight is along −k₂.
#[derive(GaussDynamics)]
#[gauss(
    chart = left_invariant,
    motion = planar,
    mass = 2,
    inertia = 0.3,
    gravity = 9.81,
    contact(floor, point = body.position, radius = r, friction = 0.5)
)]
struct Disk {
    r: f64,
}

/// A point on an arm of a slider-crank, whose loop is closed by a multiplier or solved for.
macro_rules! cranks {
    ($($name:ident: $($independent:ident)?;)+) => {$(
        #[derive(GaussDynamics)]
        #[gauss(
            coordinates(a, b, x),
            speeds(da, db, dx),
            kinematics(a = da, b = db, x = dx),
            body(crank, rotation = rotation_y(a), mass = 1, center_of_mass = [0.5 * l, 0, 0], inertia = [0.1, 0.9, 0.9]),
            body(rod, position = [l * cos(a), 0, -l * sin(a)], rotation = rotation_y(b), mass = 0.5,
                 center_of_mass = [l, 0, 0], inertia = [0.1, 3, 3]),
            particle(mass = 2, position = [x, 0, 0]),
            point(end, body = rod, at = [2 * l, 0, 0]),
            point(tip, body = rod, at = [1.5 * l, 0, 0.2]),
            constraint(position = end.x - x),
            constraint(position = end.z),
            $(independent($independent),)?
            contact(table, point = tip, plane = [1, 0, 2], height = 0.1 * t, friction = 0.5 + 0.1 * tanh(da)),
            range(slide, along = x, to = 3.5 * l),
        )]
        struct $name<T> {
            l: T,
            #[gauss(gravity)]
            g: Vector3<T>,
        }
    )+};
}

cranks! {
    Crank: ;
    Solved: da;
}

/// A disk whose rim is on an inclined plane, two balls, and a point beside them.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose, x),
    body(disk, position = pose.position, rotation = pose.rotation),
    particle(mass = 1, position = [x, 0.4, 0.1]),
    contact(rim, point = disk.position, rim = r, axis = axis, plane = normal, height = h, along = [0, 1, 0], friction = mu),
    contact(balls, point = [x, 0.4, 0.1], radius = 0.2 * r, other = disk.position, other_radius = 0.1 * r, restitution = 1),
    contact(slope, point = [x, 0.4, 0.1], plane = [0.6, 0, 0.8], friction = mu),
)]
struct Shapes {
    #[gauss(body)]
    disk: RigidBody<f64>,
    #[gauss(gravity)]
    g: f64,
    r: f64,
    h: f64,
    mu: f64,
    axis: Vector3<f64>,
    normal: Vector3<f64>,
}

fn shapes() -> Shapes {
    let (axis, normal) = (Vector3::new(0.3, -0.4, 2.0), Vector3::new(-0.5, 0.2, 1.0));
    Shapes { disk: ball().ball, g: 9.81, r: 0.7, h: -0.2, mu: 0.3, axis, normal }
}

/// A contact of a point of this body.
fn on(body: &'static str, contact: Contact) -> Contact {
    contact.between([Some(body), None])
}

#[test]
fn a_list_of_contacts() {
    assert_eq!(BallKernel::CONTACTS, [Contact::new("floor", 0, 2)]);
    let names = ["a_from", "a_to", "knee_from"].into_iter().enumerate();
    let all: Vec<Contact> = names.map(|(k, name)| Contact::new(name, k, 0)).collect();
    assert_eq!(PendulumKernel::<f64>::CONTACTS, all);
    // Motion in a plane has one tangent, motion along a line on a slope as well.
    // The table rises with the time.
    let table = on("rod", Contact::new("table", 0, 1)).moving();
    assert_eq!(CrankKernel::<f64>::CONTACTS, [table, Contact::new("slide_to", 2, 0)]);
    // A point of no body touches one.
    let balls = Contact::new("balls", 3, 0).between([None, Some("disk")]);
    let shapes = [on("disk", Contact::new("rim", 0, 2)), balls, Contact::new("slope", 4, 1)];
    assert_eq!(ShapesKernel::CONTACTS, shapes);
    assert!(BallKernel::OPERATIONS.impulse_dynamics.total() > BallKernel::OPERATIONS.impulse_response.total());
}

#[test]
fn a_ball_in_every_chart() {
    let kernel = ball().kernel().unwrap();
    let q = Isometry3::new(Vector3::new(1.0, 2.0, 0.5), Vector3::new(0.2, 0.3, -0.4));
    assert!((kernel.gaps(0.0, &q)[0] - 0.2).abs() < 1e-15);
    assert_eq!(
        (kernel.friction(0.0, &q, &SVector::zeros(), &()), kernel.restitution()[0]),
        ([0.0, 0.4, 0.4].into(), 0.7)
    );
    // (u, ω), body axes: speeds of the pose.
    let twist = SVector::from([0.3, -0.2, 0.5, 1.0, -0.7, 0.4]);
    let known = laws(&kernel, &q, &twist, &(), 0.0);
    macro_rules! same {
        ($($name:ident)+) => {$(
            let kernel = $name::sample().kernel().unwrap();
            let z = kernel.speeds(0.0, &q, &twist);
            let found = laws(&kernel, &q, &z, &(), 0.0);
            same(&found.0, &known.0);
            same(&found.1, &known.1);
            same(kernel.gaps(0.0, &q).as_slice(), &[0.2]);
            same(kernel.contact_rates(0.0, &q, &z).as_slice(), &known.2);
        )+};
    }
    same!(Hybrid LeftInvariant RightInvariant);
}

#[test]
fn a_robot_from_its_file() {
    let kernel = Panda.kernel().unwrap();
    let contacts = [
        on("panda_finger_joint1_link", Contact::new("table", 0, 2)),
        Contact::new("panda_finger_joint1_from", 3, 0),
        Contact::new("panda_finger_joint1_to", 4, 0),
    ];
    assert_eq!(PandaKernel::CONTACTS, contacts);
    let q = SVector::from([0.3, -0.5, 0.2, -1.9, 0.4, 1.3, -0.6, 0.03, 0.01]);
    let z = SVector::from([0.4, -0.2, 0.3, 0.1, -0.5, 0.2, 0.6, -0.1, 0.2]);
    let finger = kernel.pose_of(PandaFrame::panda_finger_joint1_link, 0.0, &q).translation;
    same(kernel.gaps(0.0, &q).as_slice(), &[finger.z - 0.11, 0.03, 0.01]);
    assert_eq!(kernel.restitution(), SVector::from([0.0, 0.2, 0.2]));
    laws(&kernel, &q, &z, &SVector::zeros(), 0.0);
}

#[test]
fn a_disk_in_the_plane() {
    let kernel = Disk { r: 0.4 }.kernel().unwrap();
    assert_eq!(DiskKernel::CONTACTS, [Contact::new("floor", 0, 1)]);
    let q = Isometry2::new(Vector2::new(1.0, 0.6), 0.5);
    let (u, w) = (Vector2::new(0.3, -0.2), 1.5);
    same(kernel.gaps(0.0, &q).as_slice(), &[0.2]);
    let z = SVector::from([u.x, u.y, w]);
    let (delassus, bias, rates) = laws(&kernel, &q, &z, &(), 0.0);
    let v = q.rotation * u;
    // At the lowest point v + ω k₃ × (−r k₂).
    assert!((rates[0] - v.y).abs() < 1e-14 && (rates[1].abs() - (v.x + 0.4 * w).abs()).abs() < 1e-14, "{rates:?}");
    same(&delassus, &[0.5, 0.0, 0.0, 0.5 + 0.16 / 0.3]);
    same(&bias, &[-9.81, 0.0]);
}

#[test]
fn a_pendulum_with_stops() {
    let parameters = Pendulum { m: 0.7, l: 1.3, g: 9.81, low: 0.4, high: 0.9, e: 0.5 };
    let kernel = parameters.kernel().unwrap();
    let (q, z) = (SVector::from([0.3, 1.1]), SVector::from([0.7, -0.4]));
    same(kernel.gaps(0.0, &q).as_slice(), &[0.7, 0.6, 0.8]);
    assert_eq!(kernel.restitution(), SVector::from([0.5, 0.5, 0.0]));
    let input = SVector::from([0.3]);
    let (_, bias, _) = laws(&kernel, &q, &z, &input, 0.0);
    let of = |x: f64| Dual::new(x, 0.0);
    let (m, l, g) = (of(0.7), of(1.3), of(9.81));
    let dual = Pendulum { m, l, g, low: of(0.4), high: of(0.9), e: of(0.5) }.kernel().unwrap();
    let acceleration = kernel.acceleration(0.0, &q, &z, &input);
    let rates = dual.contact_rates(of(0.0), &q.zip_map(&z, Dual::new), &z.zip_map(&acceleration, Dual::new));
    same(rates.map(|x| x.rate).as_slice(), &bias);
    let wrong = Pendulum { low: -1.0, e: 1.5, ..parameters }.kernel().unwrap_err().to_string();
    assert!(wrong.contains("`e` is 1.5: a coefficient of restitution is from 0"), "{wrong}");
    assert!(wrong.contains("the lower limit lies below"), "{wrong}");
}

#[test]
fn a_loop_with_multipliers_and_solved() {
    let (l, g) = (1.2, Vector3::new(0.0, 0.0, -9.81));
    let (whole, solved) = (Crank { l, g }.kernel().unwrap(), Solved { l, g }.kernel().unwrap());
    // The rod is twice as long as the crank.
    let a: f64 = 0.6;
    let b = -(0.5 * a.sin()).asin();
    let q = SVector::from([a, b, l * a.cos() + 2.0 * l * b.cos()]);
    let da = 0.8;
    let db = -0.5 * a.cos() * da / b.cos();
    let z = SVector::from([da, db, -l * a.sin() * da - 2.0 * l * b.sin() * db]);
    let t = 0.4;
    assert!(whole.position_residual(t, &q).amax() < 1e-14 && whole.velocity_residual(t, &q, &z).amax() < 1e-14);
    let known = laws(&whole, &q, &z, &(), t);
    let found = laws(&solved, &q, &SVector::from([da]), &(), t);
    let of = |x: f64| Dual::new(x, 0.0);
    let dual = Crank { l: of(l), g: g.map(of) }.kernel().unwrap();
    let acceleration = whole.acceleration(t, &q, &z, &());
    let z_dual = z.zip_map(&acceleration, Dual::new);
    let rates = dual.contact_rates(Dual::new(t, 1.0), &q.zip_map(&z, Dual::new), &z_dual);
    same(rates.map(|x| x.rate).as_slice(), &known.1);
    same(&found.0, &known.0);
    same(&found.1, &known.1);
    same(solved.gaps(t, &q).as_slice(), whole.gaps(t, &q).as_slice());
    same(&found.2, &known.2);
    let friction = [whole.friction(t, &q, &z, &()), solved.friction(t, &q, &SVector::from([da]), &())];
    same(friction[0].as_slice(), friction[1].as_slice());
    // The plane has a normal of any length, and rises.
    let tip = Vector3::new(
        l * a.cos() + 1.5 * l * b.cos() + 0.2 * b.sin(),
        0.0,
        -l * a.sin() - 1.5 * l * b.sin() + 0.2 * b.cos(),
    );
    let gap = Vector3::new(1.0, 0.0, 2.0).normalize().dot(&tip) - 0.1 * t;
    same(whole.gaps(t, &q).as_slice(), &[gap, 3.5 * l - q[2]]);
}

#[test]
fn shapes_against_geometry() {
    let parameters = shapes();
    let kernel = parameters.kernel().unwrap();
    let pose = Isometry3::new(Vector3::new(0.4, -0.3, 0.8), Vector3::new(0.5, -0.2, 0.3));
    let x = 0.9;
    let q = (pose, SVector::from([x]));
    let (axis, normal) = (pose.rotation * parameters.axis.normalize(), parameters.normal.normalize());
    let center = pose.translation.vector;
    // The lowest of many points of the rim: quadratic in the angle, so that it is lower by at most r Δ²/8.
    let count = 20_000;
    let e1 = axis.cross(&Vector3::x()).normalize();
    let e2 = axis.cross(&e1);
    let rim = |k: usize| {
        let (sine, cosine) = (k as f64 / count as f64 * std::f64::consts::TAU).sin_cos();
        center + parameters.r * (cosine * e1 + sine * e2)
    };
    let lowest = (0..count).map(|k| normal.dot(&rim(k))).fold(f64::INFINITY, f64::min) - parameters.h;
    let mass = Vector3::new(x, 0.4, 0.1);
    let apart = (mass - center).norm() - 0.3 * parameters.r;
    let gaps = kernel.gaps(0.0, &q);
    let coarse = parameters.r * (std::f64::consts::TAU / count as f64).powi(2) / 8.0;
    assert!(lowest >= gaps[0] - 1e-14 && lowest - gaps[0] <= coarse, "{lowest} against {}", gaps[0]);
    same(&gaps.as_slice()[1..], &[apart, 0.6 * x + 0.08]);
    let z = SVector::from([0.3, -0.2, 0.5, 1.0, -0.7, 0.4, 0.25]);
    laws(&kernel, &q, &z, &(), 0.0);
    // The velocity of the material point at the contact.
    let (v, w) = (pose.rotation * Vector3::new(0.3, -0.2, 0.5), pose.rotation * Vector3::new(1.0, -0.7, 0.4));
    let inward = (normal - axis * axis.dot(&normal)).normalize();
    let velocity = v + w.cross(&(-parameters.r * inward));
    let first = (Vector3::y() - normal * normal.y).normalize();
    let rates = kernel.contact_rates(0.0, &q, &z);
    let slips = [first.dot(&velocity), normal.cross(&first).dot(&velocity)];
    same(&rates.as_slice()[..3], &[normal.dot(&velocity), slips[0], slips[1]]);
    // Along a slope: the only tangent that does not vanish.
    same(&rates.as_slice()[4..], &[0.6 * 0.25, 0.8 * 0.25]);
    let flat = Shapes { normal: Vector3::zeros(), ..parameters }.kernel().unwrap_err().to_string();
    assert!(flat.contains("has no direction"), "{flat}");
}

/// Numbers of order ten and some hundreds of roundings.
#[track_caller]
fn same(a: &[f64], b: &[f64]) {
    assert_eq!(a.len(), b.len());
    let scale = a.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
    assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-11 * scale), "{a:?} against {b:?}");
}

/// D, b and (ġ, s), which do not depend on the chart.
type Found = (Vec<f64>, Vec<f64>, Vec<f64>);

/// D = W A⁻¹Wᵀ and what else holds among the methods, at one state; b against `contact_rates` along the motion.
#[track_caller]
fn laws<const N: usize, const R: usize, S>(
    kernel: &S,
    q: &S::Configuration,
    z: &SVector<f64, N>,
    input: &S::Input,
    t: f64,
) -> Found
where
    S: ContactSystem<
            Scalar = f64,
            Speeds = SVector<f64, N>,
            MassMatrix = SMatrix<f64, N, N>,
            ContactRows = SVector<f64, R>,
            ContactColumns = SMatrix<f64, N, R>,
            Delassus = SMatrix<f64, R, R>,
        >,
    <S::Configuration as Configuration>::Tangent: VectorSpace<f64>,
{
    let ContactDynamics { acceleration, bias, response, .. } = kernel.contact_dynamics(t, q, z, input);
    let transposed = kernel.contact_jacobian(t, q);
    same(acceleration.as_slice(), kernel.acceleration(t, q, z, input).as_slice());
    // Under constraints A X − Wᵀ are their forces, which do no work along X.
    let held = kernel.mass_matrix(t, q) * response.columns - transposed;
    let scale = transposed.amax().max(1.0);
    same((response.columns.transpose() * held / scale).as_slice(), &vec![0.0; R * R]);
    same((transposed.transpose() * response.columns).as_slice(), response.delassus.as_slice());
    assert_eq!(response.delassus, response.delassus.transpose());
    let alone = kernel.contact_response(t, q);
    same(alone.columns.as_slice(), response.columns.as_slice());
    same(alone.delassus.as_slice(), response.delassus.as_slice());
    assert_eq!(transposed.nth(0), Some(transposed.column(0).into_owned()));
    // The rates are affine in z, with W.
    let more = SVector::from_fn(|k, _| 0.3 - 0.2 * k as f64);
    let rates = kernel.contact_rates(t, q, z);
    let difference = kernel.contact_rates(t, q, &(z + more)) - rates;
    same(difference.as_slice(), (transposed.transpose() * more).as_slice());
    // Along the motion to second order: central differences with h 1e-5, errors h² and roundings over h.
    let h = 1e-5;
    let at = |h: f64| kernel.contact_rates(t + h, &moved(kernel, t, q, z, h), &(z + acceleration * h));
    let change = (at(h) - at(-h)) / (2.0 * h);
    assert!((change - bias).amax() < 1e-8 * (1.0 + bias.amax()), "{change} against {bias}");
    (response.delassus.as_slice().to_vec(), bias.as_slice().to_vec(), rates.as_slice().to_vec())
}

/// The configuration a time h later, to first order.
fn moved<S: GaussSystem<Scalar = f64>>(
    kernel: &S,
    t: f64,
    q: &S::Configuration,
    z: &S::Speeds,
    h: f64,
) -> S::Configuration
where
    <S::Configuration as Configuration>::Tangent: VectorSpace<f64>,
{
    q.retract(&kernel.kinematics(t, q, z).scale(h))
}
