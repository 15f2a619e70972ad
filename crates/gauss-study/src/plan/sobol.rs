//! Sobol' sequences, of which each point is computed by itself.

use super::joe_kuo::JOE_KUO;

/// Number of dimensions for which there are numbers.
pub const DIMENSIONS: usize = JOE_KUO.len() + 1;

/// The direction numbers of a dimension, as fractions of 2⁶⁴.
#[derive(Clone, Debug)]
pub struct Directions(Box<[u64; 64]>);

impl Directions {
    /// Direction numbers of the dimension with a number from zero on, less than [`DIMENSIONS`].
    pub fn new(dimension: usize) -> Self {
        let mut v = Box::new([0_u64; 64]);
        let Some(first) = dimension.checked_sub(1) else {
            // Dimension zero: m_k = 1.
            (0..64).for_each(|k| v[k] = 1 << (63 - k));
            return Self(v);
        };
        let (coefficients, initial) = JOE_KUO[first];
        let degree = initial.len();
        for k in 0..64 {
            v[k] = if k < degree {
                u64::from(initial[k]) << (63 - k)
            } else {
                // Bratley and Fox (1988), (2).
                let inner = (1..degree).filter(|i| (coefficients >> (degree - 1 - i)) & 1 == 1);
                inner.fold(v[k - degree] ^ (v[k - degree] >> degree), |sum, i| sum ^ v[k - i])
            };
        }
        Self(v)
    }

    /// Point `i` in the order of Antonov and Saleev (1979): the numbers at the bits of the Gray code of i, together.
    pub fn at(&self, i: u64) -> u64 {
        let mut gray = i ^ (i >> 1);
        let mut point = 0;
        while gray != 0 {
            point ^= self.0[gray.trailing_zeros() as usize];
            gray &= gray - 1;
        }
        point
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points 1, 2, 3 and 1000003 of scipy 1.17.1, `qmc.Sobol(100, scramble=False)`, which has the same direction
    /// numbers, times 2³⁰.
    #[test]
    fn points_are_those_of_scipy() {
        for (dimension, points) in SCIPY {
            let directions = Directions::new(dimension);
            let found = [1, 2, 3, 1_000_003].map(|i| directions.at(i) >> 34);
            assert_eq!(found, points, "dimension {dimension}");
        }
    }

    #[test]
    fn the_first_powers_of_two_fill_every_part_once() {
        for dimension in 0..DIMENSIONS {
            let directions = Directions::new(dimension);
            for bits in [1, 4, 9, 12] {
                let mut parts: Vec<u64> = (0..1_u64 << bits).map(|i| directions.at(i) >> (64 - bits)).collect();
                parts.sort_unstable();
                assert!(parts.into_iter().eq(0..1 << bits), "dimension {dimension}, {bits} bits");
            }
        }
    }

    const SCIPY: [(usize, [u64; 4]); 8] = [
        (0, [536870912, 805306368, 268435456, 296862720]),
        (1, [536870912, 268435456, 805306368, 603356160]),
        (2, [536870912, 268435456, 805306368, 83747840]),
        (3, [536870912, 268435456, 805306368, 449088512]),
        (7, [536870912, 805306368, 268435456, 286467072]),
        (40, [536870912, 268435456, 805306368, 979020800]),
        (77, [536870912, 268435456, 805306368, 997948416]),
        (99, [536870912, 805306368, 268435456, 53261312]),
    ];
}
