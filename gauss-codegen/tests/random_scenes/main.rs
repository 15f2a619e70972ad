//! No valid scene is refused: random ones with offsets, scales from 1e-8 to 1e8 and literals of up to thirty digits, as source, through
//! the whole pipeline.
//!
//! `SCENES=5000 cargo test -p gauss-codegen --test random_scenes` makes more of them than every run does.

mod numbers;
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
            let input: syn::DeriveInput = syn::parse_str(&source).expect("the source is a struct");
            let error = gauss_codegen::expand(&input).err()?;
            let messages: Vec<String> = error.into_iter().map(|error| error.to_string()).collect();
            Some(format!("scene {seed}: {}\n    {source}", messages.join("; ")))
        })
        .collect()
}
