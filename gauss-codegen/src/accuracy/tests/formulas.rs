//! Scenes whose results are known in closed form, without a difference that cancels: what is left are the roundings of
//! some dozen operations.

use crate::algebra::Map;
use crate::emit::Derived;
use crate::expand::derive;
use crate::mechanics::{Coordinate, Method};

/// Roundings of each of so many operations, all of one sign.
const OPERATIONS: f64 = 24.0;

/// A method of a scene at scalars and their speeds, as its kernel computes it; of accelerations, at rest if no others
/// are given.
fn computed(clauses: &str, method: Method, q: &[f64], z: &[f64]) -> Vec<f64> {
    let source = format!("#[gauss({clauses})] struct Scene {{}}");
    let input: syn::DeriveInput = syn::parse_str(&source).expect("the source is a struct");
    let run = |derived: &Derived<'_, '_>| {
        let scene = &derived.subject.system.scene;
        let literals = derived.subject.provenance.literals.iter().map(|(value, symbol)| (symbol.key(), value.to_f64()));
        let mut state: Map<u32, f64> = literals.collect();
        let known = derived.kernel.known_constants.iter();
        state.extend(known.map(|(symbol, value)| (symbol.key(), *value)));
        for (coordinate, value) in scene.coordinates.iter().zip(q) {
            let Coordinate::Scalar(symbol) = coordinate else { unreachable!("scenes have scalars") };
            state.insert(symbol.key(), *value);
        }
        state.extend(scene.speeds.iter().zip(z).map(|(symbol, value)| (symbol.key(), *value)));
        derived.program(method).expect("every kernel has it").run(&state)
    };
    derive(&input, |derived| Ok(run(derived))).unwrap_or_else(|error| panic!("{error}: {source}"))
}

#[track_caller]
fn agree(what: &str, found: f64, expected: f64, size: f64) {
    let error = (found - expected).abs() / (f64::EPSILON * size);
    assert!(error <= OPERATIONS, "{what}: {found:e} in place of {expected:e}, {error:e} roundings");
}

/// y = (x − c)ⁿ in gravity g: `(1 + y'²) ẍ = −y' (y'' ẋ² + g)`.
#[test]
fn a_particle_on_a_power_of_a_difference() {
    for (c, n) in [10.0, 100.0, 1e3, 1e4].into_iter().flat_map(|c| [(c, 3), (c, 4), (c, 5)]) {
        let clauses = format!(
            "coordinates(x), particle(mass = 1, position = [x, (x - {c:?}).powi({n}), 0]), gravity = [0, -9, 0]"
        );
        let (x, speed) = (c + 0.3, 1.3);
        let (d, power): (f64, f64) = (x - c, f64::from(n));
        let (slope, curvature) = (power * d.powi(n - 1), power * (power - 1.0) * d.powi(n - 2));
        let expected = -slope * (curvature * speed * speed + 9.0) / (1.0 + slope * slope);
        let found = computed(&clauses, Method::Acceleration, &[x], &[speed]);
        agree(&format!("c = {c}, n = {n}"), found[0], expected, expected.abs());
    }
}

/// z = h (d² + y²)², d = x − c: ∇z = 4 h s (d, y), s = d² + y²; z̈ along the motion is 4 h (s |v|² + 2 (d ẋ + y ẏ)²),
/// and the rows are `a + ∇z (∇z·a + z̈ + g) = 0`.
#[test]
fn a_particle_in_a_bowl() {
    for c in [10.0, 100.0, 1e3, 1e4] {
        let clauses = format!(
            "coordinates(x, y), particle(mass = 1, position = [x, y, 0.5 * ((x - {c:?}).powi(2) + y * y).powi(2)]), \
             gravity = 9"
        );
        let (x, y, speed) = (c + 0.3, 0.4, [1.3, 0.7]);
        let d: f64 = x - c;
        let s = d * d + y * y;
        let gradient = [2.0 * s * d, 2.0 * s * y];
        let along = d * speed[0] + y * speed[1];
        let bent = 2.0 * (s * (speed[0] * speed[0] + speed[1] * speed[1]) + 2.0 * along * along);
        let pull = (bent + 9.0) / (1.0 + gradient[0] * gradient[0] + gradient[1] * gradient[1]);
        let found = computed(&clauses, Method::Acceleration, &[x, y], &speed);
        for (found, slope) in found.iter().zip(gradient) {
            agree(&format!("c = {c}"), *found, -slope * pull, slope.abs() * pull);
        }
    }
}

/// A = diag(l², l² cos² a), also where cos a is as small as numbers near π/2 make it.
#[test]
fn a_particle_on_a_sphere_near_its_pole() {
    for near in [1e-2, 1e-5, 1e-7] {
        let clauses = "coordinates(a, b), \
                       particle(mass = 1, position = [2 * cos(a) * cos(b), 2 * cos(a) * sin(b), 2 * sin(a)])";
        let a = std::f64::consts::FRAC_PI_2 - near;
        let found = computed(clauses, Method::MassMatrix, &[a, 0.7], &[]);
        agree(&format!("{near}"), found[3], 4.0 * a.cos().powi(2), 4.0 * a.cos().powi(2));
        // b̈ = 2 tan a · ȧ ḃ.
        let found = computed(clauses, Method::Acceleration, &[a, 0.7], &[0.3, 0.4]);
        agree(&format!("{near}"), found[1], 0.24 * a.tan(), 0.24 * a.tan().abs());
    }
}

/// Polar coordinates with their origin at r = 1000: A = diag(1, d²), d = r − 1000; b̈ = −2 ṙ ḃ/d.
#[test]
fn a_particle_near_the_origin_of_polar_coordinates() {
    for near in [1.0, 0.01, 1e-5] {
        let clauses = "coordinates(r, b), particle(mass = 1, position = [(r - 1000) * cos(b), (r - 1000) * sin(b), 0])";
        let r = 1000.0 + near;
        let d = r - 1000.0;
        let found = computed(clauses, Method::MassMatrix, &[r, 0.7], &[]);
        agree(&format!("{near}"), found[3], d * d, d * d);
        let found = computed(clauses, Method::Acceleration, &[r, 0.7], &[0.3, 0.4]);
        agree(&format!("{near}"), found[1], -0.24 / d, 0.24 / d);
    }
}

/// A sphere in yaw, pitch and roll, whose angular momentum stands still: `ψ̈ = (θ̇ φ̇ + sin θ θ̇ ψ̇)/cos θ`, without
/// `1 − sin²`.
#[test]
fn a_sphere_near_gimbal_lock() {
    for near in [1e-3, 1e-6] {
        let clauses = "chart = jet(euler_zyx), motion = fixed_point, mass = 1, inertia = 2";
        let pitch = std::f64::consts::FRAC_PI_2 - near;
        let [yaw, turn, roll] = [0.3, 0.4, 0.5];
        let found = computed(clauses, Method::Acceleration, &[0.1, pitch, 0.2], &[yaw, turn, roll]);
        let terms = [turn * roll, pitch.sin() * turn * yaw];
        let expected = (terms[0] + terms[1]) / pitch.cos();
        agree(&format!("{near}"), found[0], expected, expected.abs());
    }
}

/// A body that slides along the axis that it turns about, and nowhere else: `I q̈ = −m g l cos q`, I about O.
#[test]
fn a_body_that_slides_along_its_axis() {
    let clauses = "coordinates(q, x), gravity = 9, body(b, position = [x - 300, 2, 1], rotation = rotation_x(q), mass = 2, \
                   inertia = [4, 5, 6], center_of_mass = [0.1, 0.3, 0])";
    let found = computed(clauses, Method::Acceleration, &[0.4, 300.2], &[1.5, 0.7]);
    let expected = -2.0 * 9.0 * 0.3 * 0.4_f64.cos() / 4.0;
    agree("turning", found[0], expected, expected.abs());
    agree("sliding", found[1], 0.0, 1.0);
}
