//! Scenes that lose their digits where their equations are multiplied out, or formed about the wrong point.
//! Accelerations at one state, beside closed forms in which nothing cancels.

use std::error::Error;
use std::f64::consts::FRAC_PI_2;

use gauss_runtime::prelude::*;

use super::measure::worse;
use super::methods::tight;
use super::{Effort, Measure};

type Measures = Result<Vec<Measure>, Box<dyn Error>>;

/// The roundings of some forty operations that do not amplify each other, √40 units, and three times that.
const ROUNDINGS: f64 = 20.0 * f64::EPSILON;

fn relative(found: f64, expected: f64) -> f64 {
    ((found - expected) / expected).abs()
}

/// On a curve that is flat about a point far away.
#[derive(GaussDynamics)]
#[gauss(coordinates(x), particle(mass = 1, position = [x, (x - c).powi(4), 0]), gravity = [0, -9, 0])]
struct Curve {
    c: f64,
}

/// On a sphere, in longitude and latitude.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(longitude, latitude),
    particle(
        mass = 1,
        position = [
            cos(latitude) * cos(longitude),
            cos(latitude) * sin(longitude),
            sin(latitude)
        ]
    )
)]
struct Sphere {}

/// In polar coordinates whose radius is counted from far outside.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(r, angle),
    particle(mass = 1, position = [(r - 1000) * cos(angle), (r - 1000) * sin(angle), 0])
)]
struct Polar {}

pub fn differences(_: Effort) -> Measures {
    let mut measures = Vec::new();
    for c in [10.0, 100.0, 1000.0] {
        let (x, v): (f64, f64) = (c + 0.3, 1.3);
        // d is exact. With y = d⁴: ẍ (1 + y′²) + y′ y″ ẋ² + g y′ = 0.
        let of_slope = |slope: f64, bend: f64| -slope * (bend * v * v + 9.0) / (1.0 + slope * slope);
        let d = x - c;
        let found = Curve { c }.kernel()?.acceleration(0.0, &SVector::from([x]), &SVector::from([v]), &())[0];
        let expected = of_slope(4.0 * d.powi(3), 12.0 * d * d);
        let slope = 4.0 * x.powi(3) - 12.0 * c * x * x + 12.0 * c * c * x - 4.0 * c.powi(3);
        let typed = of_slope(slope, 12.0 * x * x - 24.0 * c * x + 12.0 * c * c);
        measures.push(
            Measure::new(
                format!("y = (x - {c})⁴, acceleration, relative"),
                "as it is written",
                relative(found, expected),
                ROUNDINGS,
            )
            .because("roundings of d = x − c, which is exact")
            .naive("multiplied out", relative(typed, expected)),
        );
    }
    for distance in [1e-5, 1e-7] {
        let latitude = FRAC_PI_2 - distance;
        let q = SVector::from([0.4, latitude]);
        let found = Sphere {}.kernel()?.mass_matrix(0.0, &q)[(0, 0)];
        let expected = latitude.cos().powi(2);
        measures.push(
            Measure::new(
                format!("sphere, {distance:.0e} from the pole, mass matrix, relative"),
                "latitude",
                relative(found, expected),
                ROUNDINGS,
            )
            .because("roundings of cos²")
            .naive("1 − sin²", relative(1.0 - latitude.sin().powi(2), expected)),
        );
    }
    let r: f64 = 1000.01;
    let found = Polar {}.kernel()?.mass_matrix(0.0, &SVector::from([r, 0.4]))[(1, 1)];
    let expected = (r - 1000.0).powi(2);
    measures.push(
        Measure::new(
            "(r - 1000)², 0.01 from it, mass matrix, relative",
            "polar coordinates",
            relative(found, expected),
            ROUNDINGS,
        )
        .because("roundings of r − 1000, which is exact")
        .naive("multiplied out", relative(r * r - 2000.0 * r + 1e6, expected)),
    );
    Ok(measures)
}

/// A craft with a wheel about its own centre.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose, turn),
    speeds(v: Vector3, w: Vector3, s),
    kinematics(pose = twist(inverse(pose.rotation) * v, w), turn = s),
    body(bus, position = pose.position, rotation = pose.rotation),
    body(wheel, parent = bus, position = [0, 0, 0], rotation = rotation_x(turn)),
    central_gravity(mu = mu)
)]
struct Craft {
    #[gauss(body)]
    bus: RigidBody<f64>,
    #[gauss(body)]
    wheel: RigidBody<f64>,
    mu: f64,
}

/// A craft of 11.8 kg at 7000 km with a wheel of 0.2 kg: what the gradient of gravity turns, from rest. Of the wheel,
/// the same all around its axis, nothing turns about that: `(I − I_w a aᵀ) ω̇ = 3μ/r³ u × I u`.
pub fn orbit(_: Effort) -> Measures {
    let body = |mass: f64, moments: [f64; 3]| RigidBody {
        mass,
        center_of_mass: Vector3::zeros(),
        inertia: Matrix3::from_diagonal(&Vector3::from(moments)),
    };
    let (bus, wheel) = ([0.3, 0.4, 0.5], [1e-3, 0.75e-3, 0.75e-3]);
    let mu = 3.986004418e14;
    let kernel = Craft { bus: body(11.8, bus), wheel: body(0.2, wheel), mu }.kernel()?;
    let place = Vector3::new(4.1e6, -3.3e6, 4.612e6);
    let rotation = UnitQuaternion::from_scaled_axis(Vector3::new(0.2, -0.6, 0.4));
    let q = (Isometry3::from_parts(place.into(), rotation), SVector::from([0.7]));
    let found = kernel.acceleration(0.0, &q, &SVector::from([0.0; 7]), &());

    let r = place.norm();
    let up = rotation.inverse() * place / r;
    let whole: [f64; 3] = std::array::from_fn(|i| bus[i] + wheel[i]);
    let torque = |i: usize, j: usize| 3.0 * mu / r.powi(3) * up[i] * up[j] * (whole[j] - whole[i]);
    let expected = [torque(1, 2) / bus[0], torque(2, 0) / whole[1], torque(0, 1) / whole[2]];
    let error = |found: &[f64]| (0..3).map(|i| relative(found[i], expected[i])).fold(0.0, worse);

    // Six points on the axes in the place of all matter: attractions about the centre of the earth, then about O.
    let sum: f64 = whole.iter().sum();
    let (mut about_center, mut force) = (Vector3::zeros(), Vector3::zeros());
    for i in 0..3 {
        let arm = (3.0 * (sum / 2.0 - whole[i]) / 12.0).sqrt();
        for side in [arm, -arm] {
            let point = place + rotation * Vector3::from_fn(|j, _| if i == j { side } else { 0.0 });
            let pull = point * (-mu * 2.0 / point.norm().powi(3));
            about_center += point.cross(&pull);
            force += pull;
        }
    }
    let typed = rotation.inverse() * (about_center - place.cross(&force));
    let typed = [typed.x / bus[0], typed.y / whole[1], typed.z / whole[2]];

    let moving = SVector::from([5.2e3, 4.8e3, -2.1e3, 1e-3, -2e-3, 1.5e-3, 0.02]);
    let run = Simulation::new(&kernel).control(tight()).max_steps(100_000).run_to_end(q, moving, 0.0..600.0);
    let steps = run.map_or(f64::INFINITY, |end| end.summary.steps as f64);
    Ok(vec![
        // The distance and the attitude are rounded, too.
        Measure::new(
            "spin by the gradient of gravity, relative",
            "craft and wheel",
            error(&found.as_slice()[3..6]),
            2.0 * ROUNDINGS,
        )
        .because("roundings of the tide")
        .naive("attractions about Ω", error(&typed)),
        // A radian of the fastest turn takes 50 s, of the orbit 930 s: a few steps each.
        Measure::new("steps for 600 s", "craft and wheel", steps, 600.0).because("a few steps for each radian"),
    ])
}

/// Two particles on rods without mass, by the angles of the rods.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b),
    particle(mass = light, position = [sin(a), 0, -cos(a)]),
    particle(mass = heavy, position = [sin(a) + sin(b), 0, -cos(a) - cos(b)]),
    gravity = 9.81
)]
struct Rods {
    light: f64,
    heavy: f64,
}

/// A load of 10⁶ at the end of a light link, nearly in line with it. By the pulls in the rods over the light mass, in
/// which nothing cancels: with s = sin(b − a), `λ₂ (s² + m₁/m₂) = ω₂² + cos(b − a) (g·e₁ + ω₁²)`.
pub fn heavy_load(_: Effort) -> Measures {
    let (light, heavy, g) = (1e-3, 1e3, 9.81);
    let (a, b, v, w): (f64, f64, f64, f64) = (0.8, 0.803, 0.7, -0.4);
    let (sine, cosine) = (b - a).sin_cos();
    let first = g * a.cos() + v * v;
    let second = (w * w + cosine * first) / (sine * sine + light / heavy);
    let expected = [-g * a.sin() + second * sine, -(first + cosine * second) * sine];
    let found = Rods { light, heavy }.kernel()?.acceleration(0.0, &SVector::from([a, b]), &SVector::from([v, w]), &());
    let error = |found: [f64; 2]| worse(relative(found[0], expected[0]), relative(found[1], expected[1]));
    // A ż = f, by Cramer's rule; the difference of the angles is exact.
    let total = light + heavy;
    let f = [heavy * sine * w * w - total * g * a.sin(), -heavy * sine * v * v - heavy * g * b.sin()];
    let determinant = total * heavy - (heavy * cosine).powi(2);
    let typed =
        [(heavy * f[0] - heavy * cosine * f[1]) / determinant, (total * f[1] - heavy * cosine * f[0]) / determinant];
    // Angles of 0.8 whose difference is 0.003, in a square: what one rounding of them does.
    let target = 4.0 * f64::EPSILON * a / (b - a);
    Ok(vec![
        Measure::new(
            "a load of 1e6 on a light link, acceleration, relative",
            "angles of the rods",
            error([found[0], found[1]]),
            target,
        )
        .because("what rounding the angles does")
        .naive("Cramer's rule, with the difference of the angles", error(typed)),
    ])
}

/// A base that falls, and a link on it.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose, turn),
    body(base, position = pose.position, rotation = pose.rotation),
    body(link, parent = base, position = [0.3, -0.2, 0.5], rotation = rotation_y(turn)),
    gravity = g
)]
struct Falling {
    #[gauss(body)]
    base: RigidBody<f64>,
    #[gauss(body)]
    link: RigidBody<f64>,
    g: f64,
}

pub fn free_fall(_: Effort) -> Measures {
    let body = |mass: f64, x: f64| RigidBody {
        mass,
        center_of_mass: Vector3::new(x, 0.1, -0.05),
        inertia: Matrix3::new(1.3, 0.1, -0.2, 0.1, 1.7, 0.05, -0.2, 0.05, 2.1),
    };
    let rotation = UnitQuaternion::from_scaled_axis(Vector3::new(0.2, -0.6, 0.4));
    let q = (Isometry3::from_parts(Vector3::new(1.0, 2.0, 3.0).into(), rotation), SVector::from([0.7]));
    let z = SVector::from([0.3, -0.2, 0.4, 1e-3, -2e-3, 1.5e-3, 2e-3]);
    let turning = |g: f64| -> Result<[f64; 4], Box<dyn Error>> {
        let found = Falling { base: body(4.0, 0.1), link: body(1.0, -0.2), g }.kernel()?.acceleration(0.0, &q, &z, &());
        Ok(std::array::from_fn(|i| found[3 + i]))
    };
    let (falling, floating) = (turning(9.81)?, turning(0.0)?);
    let error = (0..4).map(|i| relative(falling[i], floating[i])).fold(0.0, worse);
    Ok(vec![
        Measure::new("gravity in the turning of a base and of its joint, relative", "twist of the base", error, 0.0)
            .because("free fall cancels exactly"),
    ])
}

/// A sphere in yaw, pitch and roll.
#[derive(GaussDynamics)]
#[gauss(motion = fixed_point, chart = jet(euler_zyx))]
struct Ball {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: f64,
}

/// The angular momentum stands still: `ψ̈ = θ̇ (φ̇ + sin θ ψ̇)/cos θ`.
pub fn near_gimbal_lock(_: Effort) -> Measures {
    let kernel = Ball { mass: 1.0, inertia: 0.4 }.kernel()?;
    let (pitch, [psi, theta, phi]) = (FRAC_PI_2 - 1e-6, [0.3, 0.5, 0.7]);
    let found = kernel.acceleration(0.0, &SVector::from([0.2, pitch, 0.1]), &SVector::from([psi, theta, phi]), &());
    let (sine, cosine) = pitch.sin_cos();
    let expected = theta * (phi + sine * psi) / cosine;
    let typed = theta * cosine * (phi + sine * psi) / (1.0 - sine * sine);
    Ok(vec![
        Measure::new(
            "ball 1e-6 before gimbal lock, acceleration, relative",
            "yaw, pitch, roll",
            relative(found[0], expected),
            ROUNDINGS,
        )
        .because("roundings of the cosine")
        .naive("over 1 − sin²", relative(typed, expected)),
    ])
}
