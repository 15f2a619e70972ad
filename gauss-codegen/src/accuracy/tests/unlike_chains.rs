//! Chains whose links are unlike: what their kernels lose, and what is said of it.
//!
//! `SCENES=2000 cargo test --release -p gauss-codegen unlike` tries more random ones than every run does; `FIRST=1000`
//! others.

use crate::accuracy::random::Random;
use crate::algebra::{Notation, print};
use crate::emit::Derived;
use crate::expand::derive;
use crate::mechanics::{Coordinate, Method, acceleration_by_definition};

use super::{MOST, SELDOM, WITHIN, above, computed, loss_beside, number_from, said, values_of};

/// A scene of scalars with the values of its fields.
struct Case {
    clauses: String,
    fields: Vec<(String, f64)>,
}

/// The losses of accelerations at states by seeds, the most first, and what is said.
struct SeedLosses {
    losses: Vec<f64>,
    said: f64,
}

fn lost(case: &Case, states: u64, bend: f64) -> SeedLosses {
    let fields: Vec<String> = case.fields.iter().map(|(name, _)| format!("{name}: f64")).collect();
    let source = format!("#[gauss({})] struct Scene {{ {} }}", case.clauses, fields.join(", "));
    let input: syn::DeriveInput = syn::parse_str(&source).expect("the source is a struct");
    let of = |derived: &Derived<'_, '_>| {
        let at = |seed: u64| loss_at(derived, &case.fields, bend, seed);
        let mut losses: Vec<f64> = (0..states).filter_map(at).collect();
        losses.sort_by(|a, b| b.total_cmp(a));
        Ok(SeedLosses { losses, said: said(derived).expect("accelerations have a value") })
    };
    derive(&input, of).unwrap_or_else(|error| panic!("{error}: {source}"))
}

fn loss_at(derived: &Derived<'_, '_>, fields: &[(String, f64)], bend: f64, seed: u64) -> Option<f64> {
    let system = derived.subject.system;
    let mut random = Random::new(seed ^ 0x7e57);
    let coordinates = system.scene.coordinates.iter().map(|coordinate| match coordinate {
        Coordinate::Scalar(_) => vec![bend * (2.0 * random.fraction() - 1.0)],
        _ => unreachable!("scenes have scalars"),
    });
    let configuration: Vec<Vec<f64>> = coordinates.collect();
    let speeds: Vec<f64> = system.scene.speeds.iter().map(|_| random.signed(0.5)).collect();
    let mut values = values_of(derived, &configuration, speeds.into_iter());
    for source in &derived.subject.provenance.sources {
        let name = print(source.symbol, Notation::Text);
        let (_, value) = fields.iter().find(|(field, _)| *field == name)?;
        values.push((source.symbol.key(), *value));
    }
    let found = computed(derived.kernel, Method::Acceleration, &values);
    let exact = |state| acceleration_by_definition(system, state);
    loss_beside(derived, &values, exact, &found, seed).map(|(loss, _)| loss)
}

/// The joint of a link with the one before it: a hinge about an axis, or a slide along the first axis.
enum Joint {
    Hinge(char),
    Slide,
}

/// Links in a row, by their masses and lengths as they are written.
fn chain(masses: &[String], lengths: &[String], joints: &[Joint]) -> String {
    let names: Vec<String> = (0..masses.len()).map(|k| format!("q{k}")).collect();
    let mut clauses = vec![format!("coordinates({})", names.join(", "))];
    for (k, (m, l)) in masses.iter().zip(lengths).enumerate() {
        let parent = if k == 0 { String::new() } else { format!("parent = b{}, ", k - 1) };
        let at = if k == 0 { "0" } else { &lengths[k - 1] };
        let place = match &joints[k % joints.len()] {
            Joint::Hinge(axis) => format!("position = [{at}, 0, 0], rotation = rotation_{axis}(q{k})"),
            Joint::Slide => format!("position = [q{k} + {at}, 0, 0]"),
        };
        clauses.push(format!(
            "body(b{k}, {parent}{place}, mass = {m}, center_of_mass = [0.5 * {l}, 0, 0.05 * {l}], \
             inertia = [0.03 * {m} * {l} * {l}, 0.36 * {m} * {l} * {l}, 0.37 * {m} * {l} * {l}])"
        ));
    }
    clauses.push("gravity = [0.3, -9.81, 0.2]".into());
    clauses.join(", ")
}

fn numbers(numbers: &[f64]) -> Vec<String> {
    numbers.iter().map(|number| format!("{number:.12e}")).collect()
}

/// Fields of a struct for numbers, by a name and their places.
fn fields(name: &str, numbers: &[f64]) -> (Vec<String>, Vec<(String, f64)>) {
    let names: Vec<String> = (0..numbers.len()).map(|k| format!("{name}{k}")).collect();
    (names.clone(), names.into_iter().zip(numbers.iter().copied()).collect())
}

const STATES: u64 = 12;
/// Two decimal places: the roundings of some hundred operations, and the factor within which a cheaper arrangement is
/// taken.
const KEPT: f64 = 100.0;

/// Each link a hundred times as heavy as the one before, or a million times, or as many times lighter.
#[test]
fn parallel_hinges_of_unlike_links_keep_their_digits() {
    let hinges = [Joint::Hinge('z')];
    for (n, ratio) in [2, 3, 4].into_iter().flat_map(|n| [1e2, 1e-2, 1e6, 1e-6].map(|ratio: f64| (n, ratio))) {
        let masses: Vec<f64> = (0..n).map(|k| ratio.powi(k)).collect();
        let lengths = numbers(&vec![1.1; n as usize]);
        let by_one: Vec<String> = masses.iter().map(|mass| format!("{mass:e} * m")).collect();
        for case in [
            Case { clauses: chain(&numbers(&masses), &lengths, &hinges), fields: vec![] },
            Case { clauses: chain(&by_one, &lengths, &hinges), fields: vec![("m".into(), 1.3)] },
        ] {
            let SeedLosses { losses, said } = lost(&case, STATES, 3.0);
            println!("{n} links, each {ratio:e} times: {:.1e}, said {said:e}", losses[0]);
            assert!(losses[0] <= KEPT, "{n} links, each {ratio:e} times, lose {:e}: {}", losses[0], case.clauses);
        }
    }
}

/// A slide and three hinges that carry ever lighter links.
#[test]
fn light_ends_behind_a_slide_keep_their_digits() {
    for axes in [['z', 'z', 'z'], ['z', 'y', 'x']] {
        let joints: Vec<Joint> = [Joint::Slide].into_iter().chain(axes.map(Joint::Hinge)).collect();
        let clauses = chain(&numbers(&[1.7, 2.4, 7.7e-4, 2.9e-6]), &numbers(&[0.6, 1.1, 0.7, 0.9]), &joints);
        let SeedLosses { losses, said } = lost(&Case { clauses, fields: vec![] }, STATES, 3.0);
        println!("{axes:?}: {:.1e}, said {said:e}", losses[0]);
        assert!(losses[0] <= KEPT, "{axes:?} loses {:e}", losses[0]);
    }
}

/// Nobody pays for other masses than those that are given: where they are fields, the figure tells.
#[test]
fn what_chains_of_unlike_fields_lose_is_said() {
    for (n, ratio) in [2, 3, 4].into_iter().flat_map(|n| [1e2, 1e-2, 1e6, 1e-6].map(|ratio: f64| (n, ratio))) {
        let masses: Vec<f64> = (0..n).map(|k| ratio.powi(k)).collect();
        let (names, fields) = fields("m", &masses);
        let clauses = chain(&names, &numbers(&vec![1.1; n as usize]), &[Joint::Hinge('z')]);
        let SeedLosses { losses, said } = lost(&Case { clauses, fields }, STATES, 3.0);
        println!("{n} links, each {ratio:e} times: {:.1e}, said {said:e}", losses[0]);
        assert!(losses[0] <= WITHIN * said, "{n} links, each {ratio:e} times, lose {:e} of {said:e}", losses[0]);
    }
}

/// Twelve links that are nearly straight, and six of which each is a hundred times as heavy as the one before.
#[test]
fn what_long_chains_lose_is_said() {
    let hinges = [Joint::Hinge('z')];
    let straight = chain(&numbers(&[1.0; 12]), &numbers(&[1.0; 12]), &hinges);
    let masses: Vec<f64> = (0..6).map(|k| 100.0_f64.powi(k)).collect();
    let heavy = chain(&numbers(&masses), &numbers(&[1.1; 6]), &hinges);
    let cases = [(straight, vec![1e-1, 1e-3, 1e-5, 1e-7]), (heavy, vec![3.0])];
    for (clauses, bends) in cases {
        for bend in bends {
            let SeedLosses { losses, said } = lost(&Case { clauses: clauses.clone(), fields: vec![] }, 4, bend);
            println!("bent by {bend:e}: {:.1e}, said {said:e}", losses[0]);
            assert!(losses[0] <= WITHIN * said, "bent by {bend:e} it loses {:e} of {said:e}: {clauses}", losses[0]);
        }
    }
}

/// A chain of two to four links with masses over many powers of ten, at random or in a row, and lengths over some;
/// numbers of the scene or fields.
fn random_chain(seed: u64) -> Case {
    let mut random = Random::new(seed ^ 0x0bad_cafe);
    let r = &mut random;
    let n = 2 + r.below(3);
    let spread = |slopes: &[f64], apart: f64, r: &mut Random| -> Vec<f64> {
        let slope = *r.of(slopes);
        let apart = if slope == 0.0 { apart } else { 0.5 };
        (0..n).map(|k| 10.0_f64.powf(slope * k as f64) * r.size(apart)).collect()
    };
    let masses = spread(&[0.0, 1.0, -1.0, 2.0, -2.0, 3.0, -3.0], 3.0, r);
    let lengths = spread(&[0.0, 0.0, 0.0, 1.0, -1.0, 2.0, -2.0], 0.3, r);
    let parallel = r.below(3) == 0;
    let joint = |r: &mut Random| match r.below(4) {
        0 if !parallel => Joint::Slide,
        _ if parallel => Joint::Hinge('z'),
        _ => Joint::Hinge(*r.of(&['x', 'y', 'z'])),
    };
    let joints: Vec<Joint> = (0..n).map(|_| joint(r)).collect();
    if r.below(2) == 0 {
        return Case { clauses: chain(&numbers(&masses), &numbers(&lengths), &joints), fields: vec![] };
    }
    let ((masses, mut all), (lengths, others)) = (fields("m", &masses), fields("l", &lengths));
    all.extend(others);
    Case { clauses: chain(&masses, &lengths, &joints), fields: all }
}

#[test]
fn what_random_chains_of_unlike_links_lose_is_said() {
    /// The number of scenes by default.
    const SCENES: u64 = 400;
    let (first, count) = (number_from("FIRST", 0), number_from("SCENES", SCENES));
    let threads = std::thread::available_parallelism().map_or(1, usize::from) as u64;
    let of = |seed: u64| {
        let case = random_chain(seed);
        let SeedLosses { losses, said } = lost(&case, 2, 3.0);
        losses.first().map(|loss| (*loss, said, format!("scene {seed}: {} {:?}", case.clauses, case.fields)))
    };
    let mut found: Vec<(f64, f64, String)> = std::thread::scope(|scope| {
        let seeds = |worker: u64| (first + worker..first + count).step_by(threads as usize);
        let workers: Vec<_> =
            (0..threads).map(|worker| scope.spawn(move || seeds(worker).filter_map(of).collect::<Vec<_>>())).collect();
        workers.into_iter().flat_map(|worker| worker.join().expect("every scene is valid")).collect()
    });
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    let all: Vec<f64> = found.iter().map(|(loss, ..)| *loss).collect();
    println!("{} scenes, above 30: {}, above 1e3: {}", all.len(), above(&all, SELDOM), above(&all, MOST));
    found.iter().take(20).for_each(|(loss, said, text)| println!("{loss:9.3e} said {said:e}  {text}"));
    for (loss, said, text) in found.iter().filter(|(loss, ..)| *loss > SELDOM) {
        assert!(*loss <= WITHIN * said, "{text} loses {loss:e}, and its kernel says {said:e}");
    }
}
