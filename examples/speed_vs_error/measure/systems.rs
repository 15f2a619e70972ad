//! Pendulums and rolling bodies in coordinates of their own.

use std::error::Error;
use std::rc::Rc;

use gauss_runtime::prelude::*;

use super::baselines::baselines;
use super::by_hand::coordinates;
use super::by_hand_systems as by_hand;
use super::entry::{Entry, Setup};
use super::methods::{exact_top, explicit, further, jacobians, series};
use super::scene::{Scene, Target, rows};

#[derive(GaussDynamics)]
#[gauss(
    taylor,
    linearize,
    coordinates(theta, phi),
    particle(mass = 1, position = [l * sin(theta) * cos(phi), l * sin(theta) * sin(phi), -l * cos(theta)]),
)]
struct SphericalPendulum {
    l: f64,
    #[gauss(gravity)]
    g: f64,
}

/// A rod without mass to a particle, which does not spin: as a body about a fixed point. What it has about its own axis
/// does not enter the motion.
#[derive(GaussDynamics)]
#[gauss(motion = fixed_point, mass = m, center_of_mass = [0, 0, -l], inertia = [m * l * l, m * l * l, m * l * l])]
struct Rod {
    m: f64,
    l: f64,
    #[gauss(gravity)]
    g: f64,
}

/// Without a pole of the coordinates: a thread to a particle that may be anywhere.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, z),
    particle(mass = 1, position = [x, y, z]),
    constraint(position = 0.5 * (x * x + y * y + z * z - l * l)),
)]
struct Thread {
    l: f64,
    #[gauss(gravity)]
    g: f64,
}

#[derive(GaussDynamics)]
#[gauss(
    taylor,
    linearize,
    coordinates(a, b),
    particle(mass = m1, position = [l1 * sin(a), 0, -l1 * cos(a)]),
    particle(mass = m2, position = [l1 * sin(a) + l2 * sin(b), 0, -l1 * cos(a) - l2 * cos(b)]),
)]
struct DoublePendulum {
    m1: f64,
    m2: f64,
    l1: f64,
    l2: f64,
    #[gauss(gravity)]
    g: f64,
}

/// A disk by Euler angles, and the angular velocity in the axes of the first two turns: the rolling is solved by the
/// choice of speeds.
#[derive(GaussDynamics)]
#[gauss(
    taylor,
    linearize,
    coordinates(x, y, phi, theta, psi),
    speeds(w1, w2, w3),
    kinematics(
        x = r * (w1 * sin(theta) * sin(phi) - w3 * cos(phi)),
        y = -r * (w1 * sin(theta) * cos(phi) + w3 * sin(phi)),
        phi = w2 / sin(theta),
        theta = w1,
        psi = w3 - w2 / tan(theta),
    ),
    body(position = [x, y, r * sin(theta)], rotation = rotation_z(phi) * rotation_x(theta) * rotation_z(psi)),
    inertia = [a, a, c],
)]
struct Disk {
    #[gauss(mass)]
    m: f64,
    a: f64,
    c: f64,
    r: f64,
    #[gauss(gravity)]
    g: f64,
}

/// The same without angles: ω in body axes; `up` is the vertical in them.
#[derive(GaussDynamics)]
#[gauss(
    taylor,
    linearize,
    coordinates(x, y, attitude: Rotation),
    speeds(w: Vector3),
    define(
        up = inverse(attitude) * [0, 0, 1],
        height = sqrt(1 - up.z.powi(2)),
        slide = attitude * cross(w, [up.x, up.y, 0]),
    ),
    kinematics(x = r * slide.x / height, y = r * slide.y / height, attitude = w),
    body(position = [x, y, r * height], rotation = attitude),
    inertia = [a, a, c],
)]
struct DiskWithoutAngles {
    #[gauss(mass)]
    m: f64,
    a: f64,
    c: f64,
    r: f64,
    #[gauss(gravity)]
    g: f64,
}

/// On a knife edge at O, which slides along e₁ only.
#[derive(GaussDynamics)]
#[gauss(
    taylor,
    linearize,
    coordinates(x, y, theta),
    speeds(v, omega),
    kinematics(x = v * cos(theta), y = v * sin(theta), theta = omega),
    body(position = [x, y, 0], rotation = rotation_z(theta)),
    center_of_mass = [lever, 0, 0],
)]
struct Sleigh {
    #[gauss(mass)]
    m: f64,
    lever: f64,
    #[gauss(inertia)]
    j: Vector3<f64>,
}

/// The edge as a constraint with a multiplier.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, theta),
    body(sleigh, position = [x, y, 0], rotation = rotation_z(theta)),
    constraint(velocity = rate(y) * cos(theta) - rate(x) * sin(theta)),
)]
struct Edge {
    #[gauss(body)]
    sleigh: RigidBody<f64>,
}

type Added = Result<(), Box<dyn Error>>;

/// Adds the spherical pendulum.
///
/// # Errors
/// When the data are not those of it.
pub fn spherical_pendulum(entries: &mut Vec<Entry>, scene: &Scene, target: &Rc<Target>) -> Added {
    let (l, g) = (scene.number("parameters/length")?, scene.number("parameters/g")?);
    let (x, v) = (scene.vector("initial/x")?, scene.vector("initial/v")?);
    let out = x.xy().norm();
    let (theta, phi) = (out.atan2(-x.z), x.y.atan2(x.x));
    let along = v.xy().dot(&x.xy()) / out * theta.cos() + v.z * theta.sin();
    let around = (v.y * x.x - v.x * x.y) / out;
    let setup = Setup {
        chart: "angles",
        kernel: SphericalPendulum { l, g }.kernel()?,
        start: (SVector::from([theta, phi]), SVector::from([along / l, around / out])),
        observe: Rc::new(move |q: &SVector<f64, 2>| {
            let ((s, c), (sp, cp)) = (q[0].sin_cos(), q[1].sin_cos());
            vec![vec![l * s * cp, l * s * sp, -l * c]]
        }),
        target: Rc::clone(target),
    };
    explicit(entries, &setup);
    further(entries, &setup);
    series(entries, &setup);
    jacobians(entries, &setup);

    let kernel = Thread { l, g }.kernel()?;
    let setup = Setup {
        chart: "x, y, z on a thread",
        kernel,
        start: kernel.project(0.0, &x, &v)?,
        observe: Rc::new(|q: &Vector3<f64>| vec![q.iter().copied().collect()]),
        target: Rc::clone(target),
    };
    explicit(entries, &setup);

    // The shortest turn from the rod that hangs.
    let bob = x / l;
    let attitude = UnitQuaternion::rotation_between(&-Vector3::z(), &bob).ok_or("the pendulum stands upright")?;
    let setup = Setup {
        chart: "rotation of a rod",
        kernel: Rod { m: 1.0, l, g }.kernel()?,
        start: (attitude, attitude.inverse() * bob.cross(&(v / l))),
        observe: Rc::new(move |q: &UnitQuaternion<f64>| {
            vec![(q * Vector3::new(0.0, 0.0, -l)).iter().copied().collect()]
        }),
        target: Rc::clone(target),
    };
    explicit(entries, &setup);
    exact_top(entries, &setup)?;

    let equations = by_hand::SphericalPendulum { length: l, gravity: g };
    baselines(entries, "x, y, z", equations, [v.x, v.y, v.z, x.x, x.y, x.z], target);
    Ok(())
}

/// Adds the double pendulum.
///
/// # Errors
/// When the data are not those of it.
pub fn double_pendulum(entries: &mut Vec<Entry>, scene: &Scene, target: &Rc<Target>) -> Added {
    let [m1, m2, l1, l2, g] = ["m1", "m2", "l1", "l2", "g"].map(|key| scene.number(&format!("parameters/{key}")));
    let (m1, m2, l1, l2, g) = (m1?, m2?, l1?, l2?, g?);
    let (angles, rates) = (scene.numbers("parameters/theta")?, scene.numbers("parameters/thetadot")?);
    let (&[a, b], &[wa, wb]) = (&angles[..], &rates[..]) else { return Err("a double pendulum has two angles".into()) };
    let setup = Setup {
        chart: "angles",
        kernel: DoublePendulum { m1, m2, l1, l2, g }.kernel()?,
        start: (SVector::from([a, b]), SVector::from([wa, wb])),
        observe: Rc::new(move |q: &SVector<f64, 2>| {
            let (x, y) = (l1 * q[0].sin(), -l1 * q[0].cos());
            vec![vec![x, y], vec![x + l2 * q[1].sin(), y - l2 * q[1].cos()]]
        }),
        target: Rc::clone(target),
    };
    explicit(entries, &setup);
    further(entries, &setup);
    series(entries, &setup);
    jacobians(entries, &setup);
    let equations = by_hand::DoublePendulum { masses: [m1, m2], lengths: [l1, l2], gravity: g };
    baselines(entries, "angles", equations, [wa, wb, a, b], target);
    Ok(())
}

/// Adds the rolling disk.
///
/// # Errors
/// When the data are not those of it.
pub fn rolling_disk(entries: &mut Vec<Entry>, scene: &Scene, target: &Rc<Target>) -> Added {
    let (m, g, r) =
        (scene.number("parameters/mass")?, scene.number("parameters/gravity")?, scene.number("parameters/radius")?);
    let j = scene.matrix::<3>("parameters/inertia_about_O")?.diagonal();
    let (pose, omega) = (scene.pose()?, scene.vector("initial/body_omega")?);
    let b = pose.translation.vector;

    // It starts at φ = ψ = 0: the axes of the first two turns are those of the body.
    let lean = pose.rotation.euler_angles().0;
    let about = |axis, angle| UnitQuaternion::from_axis_angle(&axis, angle);
    let setup = Setup {
        chart: "Euler angles",
        kernel: Disk { m, a: j.x, c: j.z, r, g }.kernel()?,
        start: (SVector::from([b.x, b.y, 0.0, lean, 0.0]), omega),
        observe: Rc::new(move |q: &SVector<f64, 5>| {
            let rotation =
                about(Vector3::z_axis(), q[2]) * about(Vector3::x_axis(), q[3]) * about(Vector3::z_axis(), q[4]);
            vec![rows(&rotation), vec![q[0], q[1], r * q[3].sin()]]
        }),
        target: Rc::clone(target),
    };
    explicit(entries, &setup);
    series(entries, &setup);
    jacobians(entries, &setup);

    let setup = Setup {
        chart: "rotation and contact",
        kernel: DiskWithoutAngles { m, a: j.x, c: j.z, r, g }.kernel()?,
        start: ((pose.rotation, SVector::from([b.x, b.y])), omega),
        observe: Rc::new(move |(rotation, place): &(UnitQuaternion<f64>, SVector<f64, 2>)| {
            let height = r * (rotation * Vector3::z()).xy().norm();
            vec![rows(rotation), vec![place.x, place.y, height]]
        }),
        target: Rc::clone(target),
    };
    explicit(entries, &setup);
    further(entries, &setup);
    series(entries, &setup);
    jacobians(entries, &setup);

    let [x, y, z, w] = coordinates(&pose.rotation);
    let equations = by_hand::Disk { mass: m, inertia: [j.x, j.z], radius: r, gravity: g };
    let start = [omega.x, omega.y, omega.z, x, y, z, w, b.x, b.y, b.z];
    baselines(entries, "ω, quaternion, centre", equations, start, target);
    let start = [omega.x, omega.y, omega.z, 0.0, lean, 0.0, b.x, b.y];
    baselines(entries, "ω, angles, centre", by_hand::DiskByAngles(equations), start, target);
    Ok(())
}

/// Adds Chaplygin's sleigh.
///
/// # Errors
/// When the data are not those of it.
pub fn sleigh(entries: &mut Vec<Entry>, scene: &Scene, target: &Rc<Target>) -> Added {
    let (m, lever) = (scene.number("parameters/mass")?, scene.vector("parameters/centre_of_mass_body_from_O")?);
    let about_edge = scene.number("parameters/inertia_com_about_z")? + m * lever.x * lever.x;
    // What is about e₁ and e₂ does not enter the motion.
    let j = Vector3::new(1.0, 1.0, about_edge);
    let heading = scene.number("parameters/theta0")?;
    let (v, omega) = (scene.vector("initial/body_u")?.x, scene.vector("initial/body_omega")?.z);
    let observe =
        |q: &Vector3<f64>| vec![rows(&UnitQuaternion::from_axis_angle(&Vector3::z_axis(), q.z)), vec![q.x, q.y, 0.0]];
    let q = Vector3::new(0.0, 0.0, heading);
    let setup = Setup {
        chart: "own speeds",
        kernel: Sleigh { m, lever: lever.x, j }.kernel()?,
        start: (q, SVector::from([v, omega])),
        observe: Rc::new(observe),
        target: Rc::clone(target),
    };
    explicit(entries, &setup);
    further(entries, &setup);
    series(entries, &setup);
    jacobians(entries, &setup);

    let sleigh = RigidBody { mass: m, center_of_mass: lever, inertia: Matrix3::from_diagonal(&j) };
    let kernel = Edge { sleigh }.kernel()?;
    let setup = Setup {
        chart: "multiplier",
        kernel,
        start: kernel.project(0.0, &q, &Vector3::new(v * heading.cos(), v * heading.sin(), omega))?,
        observe: Rc::new(observe),
        target: Rc::clone(target),
    };
    explicit(entries, &setup);

    let equations = by_hand::Sleigh { mass: m, lever: lever.x, inertia: about_edge };
    baselines(entries, "v, ω, heading, x, y", equations, [v, omega, heading, 0.0, 0.0], target);
    Ok(())
}
