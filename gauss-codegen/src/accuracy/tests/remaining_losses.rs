//! Scenes whose kernels still lose digits at some states, and say so.

use crate::accuracy::figure::NO_DIGIT;
use crate::algebra::{Evaluation, Map, Precise};
use crate::emit::Derived;
use crate::expand::derive;
use crate::mechanics::Method;

use super::{MOST, WITHIN, computed, loss_beside, values_of};

/// A scene, a method that loses digits, and a state where it does.
struct Case {
    name: &'static str,
    clauses: String,
    method: Method,
    configuration: Vec<Vec<f64>>,
    speeds: Vec<f64>,
}

fn cases() -> Vec<Case> {
    let case = |name, clauses: &str, method, configuration: &[&[f64]], speeds: &[f64]| Case {
        name,
        clauses: clauses.to_owned(),
        method,
        configuration: configuration.iter().map(|numbers| numbers.to_vec()).collect(),
        speeds: speeds.to_vec(),
    };
    vec![
        case(
            "hoop that rolls nearly flat, by multipliers",
            "coordinates(x, y, z, heading, lean, spin), gravity = 9.81, body(hoop, position = [x, y, z], mass = 1.5, \
             rotation = rotation_z(heading) * rotation_x(lean) * rotation_z(spin), inertia = [0.06, 0.06, 0.12]), \
             constraint(velocity = rate(x) * cos(heading) + rate(y) * sin(heading) \
             + 0.3 * (rate(spin) + rate(heading) * cos(lean))), \
             constraint(velocity = rate(y) * cos(heading) - rate(x) * sin(heading) + 0.3 * sin(lean) * rate(lean)), \
             constraint(position = z - 0.3 * sin(lean))",
            Method::Acceleration,
            &[&[0.1], &[0.2], &[3e-9], &[0.3], &[1e-8], &[0.7]],
            &[0.1, 0.2, 0.3, 0.4, 0.5, 0.6],
        ),
        case(
            "short tether of a body and a particle",
            "coordinates(craft: Pose, u, v, w), central_gravity(mu = 3.986004418e14), \
             body(hull, pose = craft, mass = 1000.1, inertia = [300, 400, 500]), \
             particle(mass = 1.234, position = craft.position + [u, v, w])",
            Method::Acceleration,
            &[&[0.3, -0.5, 0.7, 0.4, 5e6, 4e6, 3e6], &[0.006], &[0.008], &[0.0001]],
            &[0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.01, 0.02, 0.03],
        ),
        case(
            "arms 1e-3 and 1e6, written from Ω",
            "coordinates(a, b), gravity = [0, -9.81, 0], body(near, rotation = rotation_z(a), mass = 1, \
             inertia = [0, 0, 3e-7], center_of_mass = [0.0005, 0, 0]), \
             body(far, position = [0.001 * cos(a), 0.001 * sin(a), 0], rotation = rotation_z(a) * rotation_z(b), \
             mass = 1, inertia = [0, 0, 3e11], center_of_mass = [5e5, 0, 0])",
            Method::Acceleration,
            &[&[0.4], &[0.9]],
            &[0.3, 0.4],
        ),
        case(
            "arms 1e-3 and 1e6 by a hinge, with a constraint",
            "coordinates(a, b, c), gravity = [0, -9.81, 0], body(near, rotation = rotation_z(a), mass = 1, \
             inertia = [0, 0, 3e-7], center_of_mass = [0.0005, 0, 0]), \
             body(far, parent = near, position = [0.001, 0, 0], rotation = rotation_z(b), mass = 1, \
             inertia = [0, 0, 3e11], center_of_mass = [5e5, 0, 0]), \
             body(wheel, position = [0, 2, 0], rotation = rotation_z(c), mass = 1, inertia = [0, 0, 0.5]), \
             constraint(velocity = rate(c) - 2 * rate(a))",
            Method::Acceleration,
            &[&[0.4], &[0.9], &[0.1]],
            &[0.3, 0.4, 0.6],
        ),
    ]
}

/// The loss, and the figure for it.
fn lost(derived: &Derived<'_, '_>, case: &Case) -> (f64, f64) {
    let values = values_of(derived, &case.configuration, case.speeds.iter().copied());
    let formulas = derived.subject.system.formulas();
    let arrangements = formulas.get(case.method).expect("every scene has it");
    let exact = |state: Map<u32, Precise>| -> Vec<Precise> {
        let mut evaluation = Evaluation::new(&state);
        arrangements[0].iter().map(|e| evaluation.value(*e)).collect()
    };
    let found = computed(derived.kernel, case.method, &values);
    // NaN, where there is a value, has no digit of it.
    let (loss, _) = loss_beside(derived, &values, exact, &found, 7).unwrap_or((NO_DIGIT, 0));
    let function = derived.kernel.functions.get(case.method).expect("every kernel has it");
    let figure = function.figure.as_ref().expect("it has a value");
    println!(
        "| {} | {} | {loss:.0e} | {:e} | {}",
        case.name,
        case.method.name(),
        figure.rounded()[0],
        figure.at.join(", ")
    );
    (loss, figure.rounded()[0])
}

/// A case that loses little is one to strike from here and from docs/benchmarks/digits.md.
#[test]
fn what_is_still_lost_is_said() {
    let of = |case: &Case| {
        let source = format!("#[gauss({})] struct Scene {{}}", case.clauses);
        let input: syn::DeriveInput = syn::parse_str(&source).expect("the source is a struct");
        derive(&input, |derived| Ok(lost(derived, case))).unwrap_or_else(|error| panic!("{error}: {source}"))
    };
    let cases = cases();
    let found: Vec<(f64, f64)> = cases.iter().map(of).collect();
    for (case, (loss, said)) in cases.iter().zip(found) {
        assert!(loss > MOST, "{} loses {loss:e}", case.name);
        assert!(loss <= WITHIN * said, "{} loses {loss:e}, and its kernel says {said:e}", case.name);
    }
}
