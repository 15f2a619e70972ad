//! What is changed: every scene of this project, and scenes that once were too much.

#[allow(dead_code)]
#[path = "../operations/sources.rs"]
mod sources;

use proc_macro2::TokenStream;

use super::mutate::{Tree, mutated};
use super::random::Random;

/// Scenes that once took too long, too much memory or too much of the stack, each an attribute and a struct.
const SEEDS: &str = include_str!("seeds.txt");

pub struct Corpus {
    scenes: Vec<Vec<Tree>>,
}

impl Corpus {
    pub fn gathered() -> Self {
        let places = ["tests/tests", "tests/src", "examples", "benches/src"];
        let gathered = places.into_iter().flat_map(sources::of).map(|scene| scene.source);
        let seeds = SEEDS.split("\n\n").map(str::to_owned);
        let trees = |source: String| Tree::all(source.parse::<TokenStream>().expect("the sources are tokens"));
        Self { scenes: gathered.chain(seeds).map(trees).collect() }
    }

    /// The mutation of that number.
    pub fn mutation(&self, number: u64) -> TokenStream {
        let mut random = Random::new(number);
        // Most scenes are long; short ones are derived in no time.
        let pair = [0; 2].map(|_| random.below(self.scenes.len()));
        let shorter = pair.into_iter().min_by_key(|&k| Tree::count(&self.scenes[k])).unwrap_or(0);
        let other = &self.scenes[random.below(self.scenes.len())];
        Tree::tokens(&mutated(self.scenes[shorter].clone(), other, &mut random))
    }
}
