//! What is changed: every scene of this project, scenes that once were too much, files of robots; and scenes of random
//! expressions.

#[allow(dead_code, reason = "names of scenes are for tables")]
#[path = "../operations/sources.rs"]
mod sources;

use std::fmt;

use proc_macro2::TokenStream;

use super::expressions;
use super::files::{self, Robot};
use super::mutate::{Tree, mutated};
use super::random::Random;

/// Scenes that once took too long, too much memory or too much of the stack, each an attribute and a struct.
const SEEDS: &str = include_str!("seeds.txt");

pub struct Corpus {
    scenes: Vec<Vec<Tree>>,
}

/// What is derived.
pub enum Mutation {
    Scene(TokenStream),
    /// A file, which is read by its name.
    #[cfg_attr(not(all(feature = "urdf", feature = "mjcf")), allow(dead_code))]
    Robot(Robot),
}

impl fmt::Display for Mutation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scene(tokens) => tokens.fmt(f),
            Self::Robot(Robot { format, text }) => write!(f, "{format}:\n{text}"),
        }
    }
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
    pub fn mutation(&self, number: u64) -> Mutation {
        let mut random = Random::new(number);
        match number % 16 {
            0 if cfg!(all(feature = "urdf", feature = "mjcf")) => Mutation::Robot(files::robot(&mut random)),
            1..=4 => Mutation::Scene(expressions::scene(&mut random).parse().expect("tokens")),
            _ => Mutation::Scene(self.changed(random)),
        }
    }

    fn changed(&self, mut random: Random) -> TokenStream {
        // Most scenes are long; short ones are derived in no time.
        let pair = [0; 2].map(|_| random.below(self.scenes.len()));
        let shorter = pair.into_iter().min_by_key(|&k| Tree::count(&self.scenes[k])).unwrap_or(0);
        let other = &self.scenes[random.below(self.scenes.len())];
        Tree::tokens(&mutated(self.scenes[shorter].clone(), other, &mut random))
    }
}
