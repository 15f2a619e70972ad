//! Scenes, and random arguments for their programs.

use gauss_codegen::Derivation;
use gauss_codegen::program::{ArgumentKind, Program};

/// One body in each kind of chart, systems with groups, constraints, inputs, literals, and forces that are not smooth.
pub const SCENES: [(&str, &str); 9] = [
    (
        "Rocket",
        "#[gauss(linearize, chart = left_invariant, mass = m * exp(-t / k), center_of_mass = [c - t, 0, 0],
            inertia = [a, b - t, b], mass_flow(at = [-l, 0, 0], velocity = [-v, 0, 0]), gravity = 9.81)]
        struct Rocket { m: f64, k: f64, c: f64, a: f64, b: f64, l: f64, v: f64 }",
    ),
    (
        "Top",
        "#[gauss(motion = fixed_point)] struct Top { #[gauss(mass)] m: f64, #[gauss(inertia)] i: Vector3<f64> }",
    ),
    (
        "Torpedo",
        "#[gauss(chart = hybrid)] struct Torpedo {
            #[gauss(mass)] m: f64, #[gauss(center_of_mass)] c: Vector3<f64>, #[gauss(inertia)] i: Matrix3<f64>,
            #[gauss(added_mass)] x: Matrix6<f64>, #[gauss(gravity)] g: f64,
        }",
    ),
    (
        "Gyroscope",
        "#[gauss(motion = fixed_point, chart = jet(euler_zxz))] struct Gyroscope {
            #[gauss(mass)] m: f64, #[gauss(center_of_mass)] c: Vector3<f64>, #[gauss(inertia)] i: Vector3<f64>,
            #[gauss(gravity)] g: f64,
        }",
    ),
    (
        "Laws",
        "#[gauss(coordinates(x), particle(mass = m, position = [x, 0, 0]), linearize,
            drive(x = -tanh(c * rate(x)) * powf(k, p) + powf(x, p) + asin(x / 4) + pi * acos(x / 5) + atan(x)))]
        struct Laws { m: f64, c: f64, k: f64, p: f64 }",
    ),
    (
        "Vehicle",
        "#[gauss(chart = left_invariant, linearize, input(thrust, rudder), medium(velocity = s * sin(t)),
            define(v = body.relative_velocity), drag(linear = e),
            force(fin, at = a, value = [thrust, l * v.x * abs(v.x) * clamp(rudder, -0.25, 0.3), 0.1]))]
        struct Vehicle {
            #[gauss(mass)] m: f64, #[gauss(center_of_mass)] c: Vector3<f64>, #[gauss(inertia)] i: Vector3<f64>,
            #[gauss(added_mass)] x: Matrix6<f64>, #[gauss(gravity)] g: Vector3<f64>, #[gauss(displaced_mass)] d: f64,
            s: Vector3<f64>, a: Vector3<f64>, l: f64, e: Matrix6<f64>,
        }",
    ),
    (
        "Arms",
        "#[gauss(
            coordinates(a, b), linearize, regressor, taylor,
            body(upper, rotation = rotation_y(a)),
            body(lower, parent = upper, position = [0, 0, -0.71234], rotation = rotation_y(b)),
            spring(along = a - b, stiffness = k, length = 0.1),
        )] struct Arms {
            #[gauss(body)] upper: RigidBody<f64>, #[gauss(body)] lower: RigidBody<f64>, k: f64, #[gauss(gravity)] g: f64,
        }",
    ),
    (
        "Rod",
        "#[gauss(
            coordinates(x, z), particle(mass = m, position = [x, 0, z]), constraint(position = x * x + z * z - l * l),
        )] struct Rod { m: f64, l: f64, #[gauss(gravity)] g: f64 }",
    ),
    (
        "Rolling",
        "#[gauss(chart = hybrid, contact(floor, point = body.position, radius = r, plane = n, along = [1, 0, 0],
            friction = mu, restitution = 0.5))]
        struct Rolling {
            #[gauss(mass)] m: f64, #[gauss(inertia)] i: Vector3<f64>, #[gauss(gravity)] g: f64, r: f64, mu: f64,
            n: Vector3<f64>,
        }",
    ),
];

pub fn derivation(name: &str) -> Derivation {
    let (_, source) = SCENES.iter().find(|(known, _)| *known == name).expect("a scene");
    Derivation::of_source(source, name).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// A reproducible stream of numbers from 0.5 to 1.5.
pub struct Random(pub u64);

impl Random {
    pub fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64 + 0.5
    }
}

/// Constants from random parameters, everything else random.
pub fn random_arguments(derivation: &Derivation, program: &Program, random: &mut Random) -> Vec<Vec<f64>> {
    let numbers = |count: usize, random: &mut Random| -> Vec<f64> { (0..count).map(|_| random.number()).collect() };
    let parameters = numbers(derivation.constants().arguments[0].components.len(), random);
    let constants = derivation.constants().run(&[&parameters]).expect("the parameters");
    let of = |argument: &gauss_codegen::program::Argument| match argument.kind {
        ArgumentKind::Parameters => parameters.clone(),
        ArgumentKind::Constants => constants.clone(),
        _ => numbers(argument.components.len(), random),
    };
    program.arguments.iter().map(of).collect()
}

/// Equal but for some roundings.
pub fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-11 * (1.0 + a.abs() + b.abs())
}
