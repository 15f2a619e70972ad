//! The unit in which a constraint is written changes nothing: neither the motion nor the force, however small the row
//! is; and rows without anything in them are rows like others.

use gauss_runtime::prelude::*;

/// A particle on a circle, c (x² + y² − l²) = 0.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    particle(mass = m, position = [x, y, 0]),
    constraint(position = c * (x * x + y * y - l * l)),
    redundant,
)]
struct Circle {
    m: f64,
    l: f64,
    c: f64,
    #[gauss(gravity)]
    g: Vector3<f64>,
}

#[test]
fn a_pendulum_of_any_length_and_unit() {
    let g = Vector3::new(0.0, -9.81, 0.0);
    for (l, c) in [(1.0, 1.0), (1e-6, 1.0), (1.0, 1e-6), (1.0, 1e-9), (1e-6, 1e-9), (1e6, 1e9), (3e-9, 7e-30)] {
        let kernel = Circle { m: 3.0, l, c, g }.kernel().unwrap();
        let q = SVector::from([0.6 * l, -0.8 * l]);
        let speed = 2.0 * l;
        let z = SVector::from([0.8 * speed, 0.6 * speed]);
        let found = kernel.acceleration(0.0, &q, &z, &());
        // Along the tangent (0.8, 0.6) what gravity has, toward the center v²/l.
        let (along, inward) = (-9.81 * 0.6, speed * speed / l);
        let expected = SVector::from([0.8 * along - 0.6 * inward, 0.6 * along + 0.8 * inward]);
        // Some twenty roundings of numbers of this size.
        let rounding = 20.0 * f64::EPSILON * expected.amax().max(9.81);
        assert!((found - expected).amax() <= rounding, "{l:e} {c:e}: {found} {expected}");
        // λ ∂φ/∂(x, y) = m (a − g).
        let force = kernel.multipliers(0.0, &q, &z, &())[0] * 2.0 * c * l;
        let needed = 3.0 * (-9.81 * 0.8 - inward);
        assert!((force - needed).abs() <= 40.0 * f64::EPSILON * needed.abs(), "{l:e} {c:e}: {force} {needed}");
        let (q, z) = kernel.project(0.0, &(q * (1.0 + 1e-9)), &z).unwrap();
        assert!((q.norm() / l - 1.0).abs() <= 4.0 * f64::EPSILON, "{l:e} {c:e}: {q}");
        assert!(q.dot(&z).abs() <= 8.0 * f64::EPSILON * l * speed);
    }
}

/// A beam on three supports, whose constraints are written in units of their own.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, s),
    body(beam, position = [x, y, 0], rotation = rotation_z(s), mass = m, inertia_about_center_of_mass = [0, j, j]),
    point(left, body = beam, at = [-l, 0, 0]),
    point(right, body = beam, at = [l, 0, 0]),
    constraint(position = a * dot(left, [0, 1, 0])),
    constraint(position = b * y),
    constraint(position = c * dot(right, [0, 1, 0])),
    redundant,
)]
struct Beam {
    m: f64,
    j: f64,
    l: f64,
    a: f64,
    b: f64,
    c: f64,
    #[gauss(gravity)]
    g: Vector3<f64>,
}

#[test]
fn supports_share_a_load_whatever_their_units() {
    let g = Vector3::new(0.0, -9.81, 0.0);
    let forces = |[a, b, c]: [f64; 3]| {
        let kernel = Beam { m: 4.0, j: 3.0, l: 1.5, a, b, c, g }.kernel().unwrap();
        let rest = SVector::zeros();
        let rates = kernel.acceleration(0.0, &rest, &rest, &());
        assert!(rates.amax() < 16.0 * f64::EPSILON * 9.81, "{a:e} {b:e} {c:e}: {rates}");
        let multipliers = kernel.multipliers(0.0, &rest, &rest, &());
        [multipliers[0] * a, multipliers[1] * b, multipliers[2] * c]
    };
    let expected = forces([1.0; 3]);
    assert!((expected.iter().sum::<f64>() - 4.0 * 9.81).abs() < 1e-12);
    for units in [[1e-9, 1.0, 1.0], [1.0, 1e-9, 1.0], [1.0, 1.0, 1e-9], [1e9, 1e-9, 1.0], [1e-12, 1e12, 3e-20]] {
        let found = forces(units);
        let apart = (0..3).map(|k| (found[k] - expected[k]).abs()).fold(0.0, f64::max);
        assert!(apart <= 64.0 * f64::EPSILON * 4.0 * 9.81, "{units:?}: {found:?} {expected:?}");
    }
    // Powers of two change nothing at all.
    let scale = [2.0_f64.powi(-40), 2.0_f64.powi(33), 2.0_f64.powi(-7)];
    assert_eq!(forces(scale), expected);
}

/// Rows of parameters alone that are nearly parallel: both coordinates are held.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    particle(mass = m, position = [x, y, 0]),
    constraint(position = y),
    constraint(position = y + e * x),
    force(at = [x, y, 0], value = [f, 2 * f, 0]),
    redundant,
)]
struct Wedge {
    m: f64,
    e: f64,
    f: f64,
}

#[test]
fn rows_of_parameters_that_are_nearly_parallel() {
    let rest = SVector::zeros();
    for m in [1.0, 1e6, 1e-6] {
        for e in [1.0, 1e-3, 1e-5, 1e-6, 1e-7, 1e-9, 1e-12] {
            let kernel = Wedge { m, e, f: 3.0 }.kernel().unwrap();
            let rates = kernel.acceleration(0.0, &rest, &rest, &());
            // A rounding of the row is a turn of it by ε/e.
            assert!(rates.amax() <= 8.0 * f64::EPSILON / e * 3.0 / m, "{m:e} {e:e}: {rates}");
        }
        // Of one and the same row there is one: x is free.
        let kernel = Wedge { m, e: 0.0, f: 3.0 }.kernel().unwrap();
        let rates = kernel.acceleration(0.0, &rest, &rest, &());
        assert!((rates[0] - 3.0 / m).abs() <= 4.0 * f64::EPSILON * 3.0 / m && rates[1] == 0.0, "{m:e}: {rates}");
    }
}

macro_rules! held {
    ($name:ident [$($constraint:tt)*]) => {
        #[derive(GaussDynamics)]
        #[gauss(
            coordinates(x, y),
            particle(mass = m, position = [x, y, 0]),
            $($constraint)*
            force(at = [x, y, 0], value = [f, 2 * f, 0]),
            redundant,
        )]
        struct $name {
            m: f64,
            f: f64,
            k: f64,
        }

        impl $name {
            /// Accelerations and multipliers at rest, of a state that the projection leaves where it is.
            fn at_rest() -> (Vec<f64>, Vec<f64>) {
                let kernel = $name { m: 2.0, f: 3.0, k: 0.0 }.kernel().unwrap();
                let rest = SVector::zeros();
                assert_eq!(kernel.project(0.0, &rest, &rest).unwrap(), (rest, rest));
                let rates = kernel.acceleration(0.0, &rest, &rest, &());
                let run = Simulation::new(&kernel).adaptive(1e-9, 1e-9).run_to_end(rest, rest, 0.0..1.0).unwrap();
                assert!((run.z - rates).amax() <= 1e-9, "{} {rates}", run.z);
                (rates.as_slice().to_vec(), kernel.multipliers(0.0, &rest, &rest, &()).as_slice().to_vec())
            }
        }
    };
}

held!(BySpeed [constraint(velocity = rate(x)),]);
held!(BySpeedTwice [constraint(velocity = rate(y)), constraint(velocity = 2 * rate(y)),]);
held!(BothLevels [constraint(velocity = rate(x)), constraint(position = x),]);
held!(ByParameter [constraint(position = k * x), constraint(velocity = k * rate(y)),]);
held!(ByVanishing [constraint(position = k * x), constraint(velocity = rate(y) - k),]);

#[test]
fn velocities_alone_and_rows_without_anything() {
    assert_eq!(BySpeed::at_rest(), (vec![0.0, 3.0], vec![-3.0]));
    // Of λ₁ + 2 λ₂ = −6 the least λ₁² + 4 λ₂².
    assert_eq!(BySpeedTwice::at_rest(), (vec![1.5, 0.0], vec![-3.0, -1.5]));
    assert_eq!(BothLevels::at_rest(), (vec![0.0, 3.0], vec![-1.5, -1.5]));
    assert_eq!(ByParameter::at_rest(), (vec![1.5, 3.0], vec![0.0, 0.0]));
    assert_eq!(ByVanishing::at_rest(), (vec![1.5, 0.0], vec![0.0, -6.0]));
}
