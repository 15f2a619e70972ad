//! An order of n things, of which each place is computed by itself.

/// A permutation of 0..n by a Feistel network over the next power of four, whose images outside are sent on until one
/// lies inside (Black and Rogaway 2002): at most a few times on average, since at least a quarter lies inside.
#[derive(Clone, Debug)]
pub struct Permutation {
    len: u64,
    /// Bits of each half.
    half: u32,
    keys: [u64; ROUNDS],
}

/// Luby and Rackoff (1988) need four rounds of random functions; the functions here are only well mixed.
const ROUNDS: usize = 6;

impl Permutation {
    /// Permutation of `len` things, at least one, by random keys.
    pub fn new(len: u64, mut key: impl FnMut() -> u64) -> Self {
        let bits = u64::BITS - len.saturating_sub(1).leading_zeros();
        Self { len, half: bits.div_ceil(2).max(1), keys: std::array::from_fn(|_| key()) }
    }

    /// Number of the things.
    pub fn len(&self) -> u64 {
        self.len
    }

    /// Place of thing `i`.
    pub fn at(&self, i: u64) -> u64 {
        let mut place = self.network(i);
        while place >= self.len {
            place = self.network(place);
        }
        place
    }

    fn network(&self, i: u64) -> u64 {
        let mask = u64::MAX >> (u64::BITS - self.half);
        let (mut left, mut right) = (i >> self.half, i & mask);
        for key in self.keys {
            (left, right) = (right, left ^ (mixed(right ^ key) & mask));
        }
        (left << self.half) | right
    }
}

/// The mixing function of SplitMix64 (Steele, Lea, Flood 2014).
fn mixed(mut bits: u64) -> u64 {
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::streams::{Purpose, Stream};

    fn permutation(len: u64, seed: u64) -> Permutation {
        let mut keys = Stream::new(seed, Purpose::Strata, "a", 0);
        Permutation::new(len, || keys.bits())
    }

    #[test]
    fn every_place_is_taken_once() {
        for len in (1..70).chain([100, 1023, 1024, 1025, 4097]) {
            let permutation = permutation(len, len);
            let mut places: Vec<u64> = (0..len).map(|i| permutation.at(i)).collect();
            places.sort_unstable();
            assert!(places.into_iter().eq(0..len), "{len}");
        }
        assert!(permutation(u64::MAX, 1).at(u64::MAX - 1) < u64::MAX);
    }

    #[test]
    fn places_are_uniform_over_seeds() {
        // χ² of 36 pairs (thing, place) over 6000 seeds: (6 − 1)² = 25 degrees of freedom, above 60 with 1e-4.
        let mut counts = [[0_u32; 6]; 6];
        for seed in 0..6000 {
            let permutation = permutation(6, seed);
            (0..6).for_each(|i| counts[i as usize][permutation.at(i) as usize] += 1);
        }
        let square = |count: &u32| (f64::from(*count) - 1000.0).powi(2) / 1000.0;
        let chi: f64 = counts.as_flattened().iter().map(square).sum();
        assert!(chi < 60.0, "{chi}");
    }
}
