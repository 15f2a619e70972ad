//! Random numbers as functions of a seed, a name and the number of a run.
//!
//! The generator is ChaCha with 8 rounds: a block of numbers is a function of a key, a stream and a counter, so that no
//! run waits for another and none has a state to hand on. The key is the seed, a purpose and 128 bits of the name; the
//! stream is the number of the run. Neighbouring seeds are other keys: their streams have nothing in common.

use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};

use crate::normal::normal_quantile;

/// Purpose of the numbers: draws of one parameter for one purpose say nothing of those for another.
#[derive(Clone, Copy)]
pub enum Purpose {
    /// A parameter of a run.
    Parameter = 0,
    /// Numbers that a run draws by itself.
    Within = 1,
    /// The order of strata of a Latin hypercube.
    Strata = 2,
    /// The shift of a Sobol' sequence.
    Shift = 3,
}

/// Random numbers within a run, all that it asks for: [`Draw::stream`](crate::Draw::stream).
#[derive(Debug)]
pub struct Stream(ChaCha8Rng);

impl Stream {
    pub(crate) fn new(seed: u64, purpose: Purpose, name: &str, run: u64) -> Self {
        let mut key = [0; 32];
        key[..8].copy_from_slice(&seed.to_le_bytes());
        key[8..16].copy_from_slice(&(purpose as u64).to_le_bytes());
        key[16..].copy_from_slice(&hash(name).to_le_bytes());
        let mut generator = ChaCha8Rng::from_seed(key);
        generator.set_stream(run);
        Self(generator)
    }

    /// Random numbers by a seed, a name and the number of a run, for what is no study: noise of a sensor, a
    /// disturbance. Those of [`Draw::stream`](crate::Draw::stream) where seed, name and run are the same.
    #[must_use]
    pub fn by(seed: u64, name: &str, run: u64) -> Self {
        Self::new(seed, Purpose::Within, name, run)
    }

    /// 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0.next_u64()
    }

    /// Between 0 and 1, both excluded: the middle of one of 2⁵² equal parts.
    pub fn uniform(&mut self) -> f64 {
        unit(self.bits())
    }

    /// Draws a normally distributed number of mean 0 and standard deviation 1.
    pub fn normal(&mut self) -> f64 {
        normal_quantile(self.uniform())
    }
}

/// A number between 0 and 1, both excluded, from the upper 52 bits. The middles of 2⁵² parts are numbers of 53 bits, so
/// that neither this sum nor this product is rounded.
pub fn unit(bits: u64) -> f64 {
    ((bits >> 12) as f64 + 0.5) * (1.0 / (1_u64 << 52) as f64)
}

/// FNV-1a of 128 bits (Fowler, Noll, Vo; RFC 9923): a name as part of a key.
fn hash(name: &str) -> u128 {
    const OFFSET: u128 = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;
    const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013b;
    name.bytes().fold(OFFSET, |hash, byte| (hash ^ u128::from(byte)).wrapping_mul(PRIME))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Strombergson, draft-strombergson-chacha-test-vectors-01, TC1: a key and a stream of zeros, 256 bits, 8 rounds.
    #[test]
    fn the_generator_gives_the_published_numbers() {
        let published = [
            0x3e, 0x00, 0xef, 0x2f, 0x89, 0x5f, 0x40, 0xd6, 0x7f, 0x5b, 0xb8, 0xe8, 0x1f, 0x09, 0xa5, 0xa1, 0x2c, 0x84,
            0x0e, 0xc3, 0xce, 0x9a, 0x7f, 0x3b, 0x18, 0x1b, 0xe1, 0x88, 0xef, 0x71, 0x1a, 0x1e,
        ];
        let mut bytes = [0; 32];
        ChaCha8Rng::from_seed([0; 32]).fill_bytes(&mut bytes);
        assert_eq!(bytes, published);
    }

    /// draft-agl-tls-chacha20poly1305-04, section 7, with 20 rounds: the stream is where that draft has the nonce.
    #[test]
    fn streams_are_the_nonces_of_the_published_numbers() {
        let published =
            [0xde, 0x9c, 0xba, 0x7b, 0xf3, 0xd6, 0x9e, 0xf5, 0xe7, 0x86, 0xdc, 0x63, 0x97, 0x3f, 0x65, 0x3a];
        let mut generator = chacha20::ChaCha20Rng::from_seed([0; 32]);
        generator.set_stream(u64::from_le_bytes([0, 0, 0, 0, 0, 0, 0, 1]));
        let mut bytes = [0; 16];
        generator.fill_bytes(&mut bytes);
        assert_eq!(bytes, published);
    }

    /// The numbers of RFC 9923, appendix C.
    #[test]
    fn names_are_hashed_as_published() {
        assert_eq!(hash(""), 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d);
        assert_eq!(hash("foobar"), 0x343e_1662_793c_64bf_6f0d_3597_ba44_6f18);
    }

    /// Draws of earlier studies stay: the numbers by an independent ChaCha, `tests/chacha.py`.
    #[test]
    fn draws_stay_what_they_are() {
        let bits = |seed, run| Stream::new(seed, Purpose::Parameter, "slope", run).bits();
        assert_eq!([bits(1, 0), bits(1, 1), bits(2, 0), bits(1, 1 << 40)], KEPT);
    }

    const KEPT: [u64; 4] = [0x23f0_42f0_d947_8710, 0x9903_35a0_4315_d542, 0x2162_34a2_2bb8_2c76, 0x52fc_97c9_7c20_987d];

    #[test]
    fn numbers_are_inside_the_open_interval() {
        assert_eq!(unit(0), 0.5 * f64::powi(2.0, -52));
        assert_eq!(unit(u64::MAX), 1.0 - 0.5 * f64::powi(2.0, -52));
    }
}
