//! Programs beside the kernels that the derive makes of the same structs: the interpreter, what C is compared with,
//! computes what Rust computes; and programs survive being written and read.

use gauss_codegen::Derivation;
use gauss_codegen::program::Program;
use gauss_runtime::forces::ForcedSystem;
use gauss_runtime::prelude::*;

/// The structs of this file.
const SOURCE: &str = include_str!("programs.rs");

/// A vehicle in water: full inertia and added mass, weight, lift that is not smooth, inputs, a literal without a short
/// fraction.
#[derive(GaussDynamics)]
#[gauss(
    chart = hybrid, input(thrust, rudder), define(v = body.relative_velocity), drag(quadratic = [1.0, 8.0, 8.0, 0.1, 2.0, 2.0]),
    force(fin, at = [-0.7123456789, 0, 0], value = [thrust, lift * v.x * abs(v.x) * clamp(rudder, -0.25, 0.3), 0]),
)]
struct Vehicle {
    #[gauss(mass)]
    mass: f64,
    #[gauss(center_of_mass)]
    center: Vector3<f64>,
    #[gauss(inertia)]
    inertia: Matrix3<f64>,
    #[gauss(added_mass)]
    added: Matrix6<f64>,
    #[gauss(gravity)]
    g: f64,
    lift: f64,
}

/// Two arms with a spring between them.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b),
    body(upper, rotation = rotation_y(a)),
    body(lower, parent = upper, position = [0, 0, -length], rotation = rotation_y(b)),
    spring(along = b, stiffness = k, length = 0.1),
)]
struct Arms {
    #[gauss(body)]
    upper: RigidBody<f64>,
    #[gauss(body)]
    lower: RigidBody<f64>,
    length: f64,
    k: f64,
    #[gauss(gravity)]
    g: f64,
}

fn derivation(name: &str) -> Derivation {
    Derivation::of_source(SOURCE, name).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// Constants from parameters that are said by name, as the equations call them.
fn constants(derivation: &Derivation, value: impl Fn(&str) -> f64) -> Vec<f64> {
    let parameters: Vec<f64> = derivation.constants().arguments[0].components.iter().map(|name| value(name)).collect();
    derivation.constants().run(&[&parameters]).expect("the parameters")
}

fn outputs(derivation: &Derivation, method: &str, arguments: &[&[f64]]) -> Vec<f64> {
    derivation.program(method).expect("a method of every kernel").run(arguments).expect("its arguments")
}

/// Equal but for roundings: generated code may fuse products and sums.
fn assert_same(what: &str, found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len(), "{what}");
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() <= 1e-11 * (1.0 + b.abs()), "{what}: {a} and {b}");
    }
}

/// Numbers between the brackets after a name: `inertia[1][0]` are 1 and 0.
fn indices(name: &str) -> Vec<usize> {
    name.split('[').skip(1).map(|index| index.trim_end_matches(']').parse().expect("an index")).collect()
}

#[test]
fn a_vehicle_in_the_interpreter() {
    let inertia = Matrix3::new(2.0, 0.1, -0.2, 0.1, 2.2, 0.05, -0.2, 0.05, 1.9);
    let added = Matrix6::from_diagonal(&SVector::from([0.3, 4.0, 4.5, 0.1, 0.6, 0.7]));
    let vehicle = Vehicle { mass: 3.5, center: Vector3::new(0.05, 0.0, 0.1), inertia, added, g: 9.81, lift: 2.5 };
    let kernel = vehicle.kernel().expect("a body");
    let derivation = derivation("Vehicle");
    let k = constants(&derivation, |name| match (name.split('[').next(), indices(name).as_slice()) {
        (Some("mass"), _) => vehicle.mass,
        (Some("center"), &[i]) => vehicle.center[i],
        (Some("inertia"), &[i, j]) => vehicle.inertia[(i, j)],
        (Some("added"), &[i, j]) => vehicle.added[(i, j)],
        (Some("g"), _) => vehicle.g,
        (Some("lift"), _) => vehicle.lift,
        _ => panic!("no such parameter: {name}"),
    });
    for turn in 0..8 {
        let turn = f64::from(turn);
        let rotation = UnitQuaternion::from_euler_angles(0.3 * turn, 0.2 - turn, 0.1 + turn);
        let position = Vector3::new(turn, -1.0, 2.0);
        let pose = Isometry3::from_parts(position.into(), rotation);
        let z = SVector::from([0.4 - turn, 0.3, -0.2, 0.5, 0.1 * turn, -0.3]);
        let input = SVector::from([1.5, 0.1 * turn]);
        let q: Vec<f64> = rotation.coords.iter().chain(position.iter()).copied().collect();
        let arguments: [&[f64]; 5] = [&k, &[turn], &q, z.as_slice(), input.as_slice()];
        let expected = kernel.acceleration(turn, &pose, &z, &input);
        assert_same("acceleration", &outputs(&derivation, "acceleration", &arguments), expected.as_slice());
        let expected = kernel.powers(turn, &pose, &z, &input);
        assert_same("powers", &outputs(&derivation, "powers", &arguments), expected.as_slice());
        let expected = kernel.mass_matrix(turn, &pose).transpose();
        assert_same("mass matrix", &outputs(&derivation, "mass_matrix", &arguments[..3]), expected.as_slice());
    }
}

#[test]
fn two_arms_in_the_interpreter() {
    let arm = |mass: f64| {
        let inertia = Matrix3::from_diagonal(&Vector3::new(0.4, 0.5, 0.2)) * mass;
        RigidBody { mass, center_of_mass: Vector3::new(0.0, 0.02, -0.4), inertia }
    };
    let arms = Arms { upper: arm(2.0), lower: arm(1.5), length: 0.8, k: 3.0, g: 9.81 };
    let kernel = arms.kernel().expect("two bodies");
    let derivation = derivation("Arms");
    let k = constants(&derivation, |name| {
        let body = if name.starts_with("upper") { &arms.upper } else { &arms.lower };
        match (name.split('[').next(), indices(name).as_slice()) {
            (Some("length"), _) => arms.length,
            (Some("k"), _) => arms.k,
            (Some("g"), _) => arms.g,
            (Some(part), []) if part.ends_with(".mass") => body.mass,
            (Some(part), &[i]) if part.ends_with(".center_of_mass") => body.center_of_mass[i],
            (Some(part), &[i, j]) if part.ends_with(".inertia") => body.inertia[(i, j)],
            _ => panic!("no such parameter: {name}"),
        }
    });
    for turn in 0..8 {
        let turn = f64::from(turn);
        let (q, z) = (SVector::from([0.3 + turn, 0.2 - 2.0 * turn]), SVector::from([1.0 - turn, 0.7]));
        let arguments: [&[f64]; 5] = [&k, &[0.0], q.as_slice(), z.as_slice(), &[]];
        let expected = kernel.acceleration(0.0, &q, &z, &());
        assert_same("acceleration", &outputs(&derivation, "acceleration", &arguments), expected.as_slice());
        let evaluated = kernel.evaluate(0.0, &q, &z, &());
        let mut expected = evaluated.velocity.as_slice().to_vec();
        expected.extend(evaluated.acceleration.iter());
        expected.extend([evaluated.kinetic_energy, evaluated.potential_energy]);
        assert_same("evaluate", &outputs(&derivation, "evaluate", &arguments), &expected);
    }
}

#[test]
fn programs_are_read_as_they_were_written() {
    for name in ["Vehicle", "Arms"] {
        let derivation = derivation(name);
        for program in derivation.programs().iter().chain([derivation.constants()]) {
            let written = serde_json::to_string(program).expect("a program can be written");
            let read: Program = serde_json::from_str(&written).expect("and read");
            assert_eq!(&read, program, "{name}");
            assert_eq!(read.verify(), Ok(()));
        }
    }
}
