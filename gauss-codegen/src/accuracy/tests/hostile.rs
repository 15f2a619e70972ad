//! Scenes at states where sums nearly vanish whose squares may not be multiplied out, and where functions nearly agree
//! whose difference may not be formed: kernels beside their formulas in 256 binary digits.

use crate::accuracy::Trial;
use crate::accuracy::trial::Point;
use crate::algebra::{Evaluation, Expr, Map, Precise};
use crate::emit::Derived;
use crate::expand::derive;
use crate::kernel::{Candidates, Derivatives, Kernel, Passes};
use crate::mechanics::{Method, rotation_of_quaternion};

use super::{computed, loss_beside, values_of};

/// Largest loss: two digits, in units of the effect of a change of every number in its last place.
const MOST: f64 = 100.0;
const METHODS: [Method; 6] = [
    Method::Acceleration,
    Method::Momentum,
    Method::MassMatrix,
    Method::KineticEnergy,
    Method::PotentialEnergy,
    Method::GaussResidual,
];

/// A scene and one state of it, with the numbers of each coordinate in a list.
struct Case {
    clauses: &'static str,
    configuration: &'static [&'static [f64]],
    speeds: &'static [f64],
}

/// Who knows of the state when arrangements are chosen.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Informant {
    /// Nobody: the arrangement that is taken anyhow keeps the digits.
    No,
    /// The trial: some arrangement keeps them.
    ToTheTrial,
}

#[track_caller]
fn keeps_its_digits(case: &Case, known: Informant) {
    let source = format!("#[gauss({})] struct Scene {{}}", case.clauses);
    let input: syn::DeriveInput = syn::parse_str(&source).expect("the source is a struct");
    let check = |derived: &Derived<'_, '_>| {
        let scene = &derived.subject.system.scene;
        let configuration: Vec<Vec<f64>> = case.configuration.iter().map(|numbers| numbers.to_vec()).collect();
        let mut values = values_of(derived, &configuration, case.speeds.iter().copied());
        values.extend(scene.speed_rates.iter().zip(1..).map(|(rate, k)| (rate.key(), 0.3 * f64::from(k))));
        let again = (known == Informant::ToTheTrial).then(|| lowered_for(derived, &values));
        let kernel = again.as_ref().unwrap_or(derived.kernel);
        let formulas = derived.subject.system.formulas();
        for method in METHODS {
            let arrangements = formulas.get(method).expect("every scene has it");
            let exact = |state: Map<u32, Precise>| -> Vec<Precise> {
                let mut evaluation = Evaluation::new(&state);
                arrangements[0].iter().map(|e| evaluation.value(*e)).collect()
            };
            let found = computed(kernel, method, &values);
            let (loss, row) = loss_beside(derived, &values, exact, &found, 7).expect("the state is regular");
            assert!(loss <= MOST, "{method:?} loses {loss:.1e} in row {row}: {source}");
        }
    };
    let checked = derive(&input, |derived| {
        check(derived);
        Ok(())
    });
    checked.unwrap_or_else(|error| panic!("{error}: {source}"));
}

/// The formulas as they are lowered where the state is among those at which programs are tried.
fn lowered_for<'g>(derived: &Derived<'_, 'g>, values: &[(u32, f64)]) -> Kernel<'g> {
    let scene = &derived.subject.system.scene;
    let mut definitions: Map<u32, Expr<'g>> = Map::default();
    for (coordinate, quaternion) in scene.coordinates.iter().zip(derived.subject.quaternions) {
        let (Some(rotation), Some(quaternion)) = (coordinate.rotation(), quaternion) else { continue };
        let entries = rotation_of_quaternion(scene.graph, *quaternion);
        let pairs = rotation.iter().flatten().zip(entries.into_iter().flatten());
        definitions.extend(pairs.map(|(symbol, entry)| (symbol.key(), entry.group())));
    }
    let units: Vec<Vec<Expr<'g>>> = derived.subject.quaternions.iter().flatten().map(|q| q.to_vec()).collect();
    let named: Vec<(u32, u64, f64)> = values.iter().map(|&(key, value)| (key, key.into(), value)).collect();
    let mut trial = Trial::new(vec![Point::new(&named, &units, &definitions)]);
    let functions = derived.subject.system.formulas().map(|_, arrangements| Candidates::of_values(arrangements));
    let wanted = Derivatives { units: &units, ..Derivatives::default() };
    let literals = Some(&derived.subject.provenance.literals[..]);
    Kernel::lower(scene.graph, &functions, &definitions, &wanted, literals, &mut trial, Passes::default())
        .unwrap_or_else(|error| panic!("{error}"))
}

/// A torus whose tube nearly fills its hole, at the inner rim: `A = diag(m (R + r cos b)², m r²)`.
#[test]
fn a_torus_at_its_inner_rim() {
    keeps_its_digits(
        &Case {
            clauses: "coordinates(a, b), gravity = 9.80665, particle(mass = 1.2345, position = \
                      [(2.000000003 + 2.000000001 * cos(b)) * cos(a), (2.000000003 + 2.000000001 * cos(b)) * sin(a), \
                      2.000000001 * sin(b)])",
            configuration: &[&[0.7], &[3.141_593_653_589_793]],
            speeds: &[0.3, 0.4],
        },
        Informant::No,
    );
}

/// One without a hole: what nearly vanishes is `2 + 2 cos b = 4 cos²(b/2)`.
#[test]
fn a_torus_without_a_hole() {
    keeps_its_digits(
        &Case {
            clauses: "coordinates(a, b), gravity = 9.80665, particle(mass = 1, position = \
                      [(2 + 2 * cos(b)) * cos(a), (2 + 2 * cos(b)) * sin(a), 2 * sin(b)])",
            configuration: &[&[0.7], &[3.141_593_653_589_793]],
            speeds: &[0.3, 0.4],
        },
        Informant::ToTheTrial,
    );
}

/// `½ k (d − l)²` of springs that are nearly at rest.
#[test]
fn the_energy_of_a_spring_near_its_length() {
    for clauses in [
        "coordinates(x, y), particle(mass = 1.1234, position = [x, y, 0]), gravity = 9.80665, \
         spring(from = [0, 0, 0], to = [x, y, 0], stiffness = 12.345, length = 5.000000001)",
        "coordinates(x, y), particle(mass = 1.1234, position = [x, y, 0]), \
         potential = 12.345 * (sqrt(x * x + y * y) - 5.000000001).powi(2)",
    ] {
        keeps_its_digits(&Case { clauses, configuration: &[&[3.0], &[4.0]], speeds: &[0.1, 0.2] }, Informant::No);
    }
}

/// `√((1000 + x)² + y² + z²) − 1000`, by literals that are exact and by one that is not.
#[test]
fn the_stretch_of_a_long_spring_seen_from_where_it_is_at_rest() {
    for clauses in [
        "coordinates(x, y, z), particle(mass = 1.1234, position = [1000 + x, y, z]), \
         spring(from = [0, 0, 0], to = [1000 + x, y, z], stiffness = 12.345, length = 1000)",
        "coordinates(x, y, z), particle(mass = 1.1234, position = [1000.25 + x, y, z]), \
         spring(from = [0, 0, 0], to = [1000.25 + x, y, z], stiffness = 12.345, length = 1000.25)",
    ] {
        keeps_its_digits(
            &Case { clauses, configuration: &[&[1e-8], &[1e-6], &[2e-6]], speeds: &[0.1, 0.2, 0.3] },
            Informant::No,
        );
    }
}

/// `(1 + x)/√((1 + x)² + y²) − (1 − x)/√((1 − x)² + y²)`.
#[test]
fn a_bead_between_preloaded_springs() {
    keeps_its_digits(
        &Case {
            clauses: "coordinates(x, y), particle(mass = 1.1234, position = [x, y, 0]), \
                      spring(from = [-1.2345, 0, 0], to = [x, y, 0], stiffness = 12.345, length = 0.54321), \
                      spring(from = [1.2345, 0, 0], to = [x, y, 0], stiffness = 12.345, length = 0.54321)",
            configuration: &[&[1e-10], &[1e-9]],
            speeds: &[0.1, 0.2],
        },
        Informant::No,
    );
}

/// `(ρ + d)/|ρ + d|³ − ρ/|ρ|³`: the tide at the end of a tether of one centimetre, 7000 km from the centre.
#[test]
fn a_short_tether_seen_from_one_end() {
    keeps_its_digits(
        &Case {
            clauses: "coordinates(x, y, z, u, v, w), central_gravity(mu = 3.986004418e14), \
                      particle(mass = 1000.1, position = [x, y, z]), \
                      particle(mass = 1.234, position = [x + u, y + v, z + w])",
            configuration: &[&[5e6], &[4e6], &[3e6], &[0.006], &[0.008], &[0.0001]],
            speeds: &[0.1, 0.2, 0.3, 0.01, 0.02, 0.03],
        },
        Informant::No,
    );
}

/// `1 − cos q` of a small angle.
#[test]
fn the_energy_of_a_pendulum_that_is_nearly_at_rest() {
    keeps_its_digits(
        &Case {
            clauses: "coordinates(q), particle(mass = 1.1234, position = [2.345 * sin(q), 0, -2.345 * cos(q)]), \
                      potential = 12.345 * (1 - cos(q))",
            configuration: &[&[1e-6]],
            speeds: &[0.1],
        },
        Informant::No,
    );
}

/// A coin that spins nearly flat: `ψ̇ cos θ + φ̇` is small beside its terms, and the inertia about the line of nodes is
/// `sin²θ` of that about the axis.
#[test]
fn a_disk_that_is_nearly_flat() {
    keeps_its_digits(
        &Case {
            clauses: "coordinates(x, y, psi, theta, phi), gravity = 9.80665, body(disk, mass = 1.1234, \
                      position = [x, y, 0.3456 * sin(theta)], inertia = [1.2345, 1.2345, 2.469], \
                      rotation = rotation_z(psi) * rotation_x(theta) * rotation_z(phi))",
            configuration: &[&[0.1], &[0.2], &[0.3], &[1e-6], &[0.2]],
            speeds: &[0.1, 0.2, 1e6, 0.1, -1e6],
        },
        Informant::No,
    );
}
