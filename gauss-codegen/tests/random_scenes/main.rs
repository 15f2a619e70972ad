//! No valid scene is refused: random ones with offsets, scales from 1e-8 to 1e8 and literals of up to thirty digits, as
//! source, through the whole pipeline.
//!
//! `SCENES=5000 cargo test -p gauss-codegen --test random_scenes` makes more of them than every run does.

mod numbers;
#[allow(dead_code, reason = "the choices of samples are not made here")]
#[path = "../../src/accuracy/random.rs"]
mod random;
mod scene;

/// How many by default: some seconds.
const SCENES: u64 = 300;

#[test]
fn no_valid_scene_is_refused() {
    let count = std::env::var("SCENES").ok().and_then(|count| count.parse().ok()).unwrap_or(SCENES);
    let threads = std::thread::available_parallelism().map_or(1, usize::from) as u64;
    let refused: Vec<String> = std::thread::scope(|scope| {
        let workers: Vec<_> =
            (0..threads).map(|first| scope.spawn(move || refusals((first..count).step_by(threads as usize)))).collect();
        workers.into_iter().flat_map(|worker| worker.join().expect("no scene makes the pipeline panic")).collect()
    });
    assert!(refused.is_empty(), "{} of {count} refused:\n{}", refused.len(), refused.join("\n"));
}

fn refusals(seeds: impl Iterator<Item = u64>) -> Vec<String> {
    seeds
        .filter_map(|seed| {
            let source = scene::source(seed);
            Some(format!("scene {seed}: {}\n    {source}", refusal(&source)?))
        })
        .collect()
}

/// Why a struct is refused, where it is.
fn refusal(source: &str) -> Option<String> {
    let input: syn::DeriveInput = syn::parse_str(source).expect("the source is a struct");
    let error = gauss_codegen::expand(&input).err()?;
    Some(error.into_iter().map(|error| error.to_string()).collect::<Vec<_>>().join("; "))
}

/// A pendulum far from O of a free craft: what the self-check compares cancels to the eighth digit there, and more.
#[test]
fn a_pendulum_far_across_a_craft_is_not_refused() {
    for clauses in [
        "coordinates(pose: Pose, a), body(position = pose.position, rotation = pose.rotation)",
        "coordinates(a), chart = left_invariant",
        "coordinates(a), chart = right_invariant",
        "coordinates(a), chart = hybrid",
    ] {
        let source = format!(
            "#[gauss({clauses}, particle(mass = m, parent = body, position = [l * sin(a), 10000, -l * cos(a)]))] \
             struct S {{ #[gauss(mass)] mass: f64, #[gauss(center_of_mass)] c: Vector3<f64>, \
             #[gauss(inertia)] j: Matrix3<f64>, #[gauss(gravity)] g: f64, m: f64, l: f64 }}"
        );
        assert_eq!(refusal(&source), None, "{source}");
    }
}
